//! What is written on a figure, read back from its SVG.

/// Everything written on a figure.
pub fn written(svg: &str) -> Vec<String> {
    svg.split("<text ").skip(1).map(one).collect()
}

fn one(element: &str) -> String {
    let (_, rest) = element.split_once('>').unwrap();
    let entities = [
        ("&lt;", "<"),
        ("&gt;", ">"),
        ("&quot;", "\""),
        ("&apos;", "'"),
        ("&amp;", "&"),
    ];
    let text = rest.split("</text>").next().unwrap().trim();
    entities
        .iter()
        .fold(text.to_owned(), |text, (entity, letter)| {
            text.replace(entity, letter)
        })
}

/// The value of an attribute of a tag.
pub fn value<'a>(tag: &'a str, name: &str) -> &'a str {
    let start = format!(" {name}=\"");
    let at = match tag.find(&start) {
        Some(at) => at + start.len(),
        // The first attribute of a tag has no blank before it once the tag's name is cut off.
        None if tag.starts_with(&start[1..]) => start.len() - 1,
        None => panic!("no {name} in {tag}"),
    };
    tag[at..].split('"').next().unwrap()
}

/// A number that a tag has by name.
pub fn attribute(tag: &str, name: &str) -> f64 {
    value(tag, name).parse().unwrap()
}
