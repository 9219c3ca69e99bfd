//! A page as a document.

/// The document without its scripts, which hold no tags of it.
pub fn without_scripts(html: &str) -> String {
    let (first, rest) = html.split_once("<script>").unwrap_or((html, ""));
    let rest = rest.split("<script>");
    let behind = rest.filter_map(|part| part.split_once("</script>"));
    first.to_owned() + &behind.map(|(_, behind)| behind).collect::<String>()
}

/// Whether every tag of a document is closed in its order and every `&` begins an entity.
pub fn is_well_formed(xml: &str) -> bool {
    let mut open: Vec<&str> = Vec::new();
    let xml = without_scripts(xml);
    for tag in xml.split('<').skip(1) {
        let Some((tag, words)) = tag.split_once('>') else {
            return false;
        };
        let name = tag
            .split([' ', '\n', '/'])
            .find(|part| !part.is_empty())
            .unwrap_or_default();
        if tag.starts_with('/') {
            if open.pop() != Some(name) {
                return false;
            }
        } else if !tag.ends_with('/') && !["!DOCTYPE", "meta", "br", "input"].contains(&name) {
            open.push(name);
        }
        let is_entity = |after: &str| after.chars().take(7).any(|letter| letter == ';');
        let entities = [tag, words].map(|part| part.split('&').skip(1).all(is_entity));
        if entities != [true; 2] || tag.matches('"').count() % 2 == 1 {
            return false;
        }
    }
    open.is_empty()
}
