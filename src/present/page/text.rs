//! Texts of the project, written in Markdown, as HTML.

use pulldown_cmark::{Event, HeadingLevel, Options, Parser, Tag, TagEnd, html};

/// A Markdown document without its title, or one of its sections without its heading, as HTML; headings that are left
/// stand one level lower.
pub(super) fn section(markdown: &str, heading: &str) -> String {
    let body = if heading.is_empty() {
        markdown.split_once('\n').map_or("", |(_, body)| body)
    } else {
        let start = format!("## {heading}\n");
        let after = markdown.split_once(&start).map_or("", |(_, after)| after);
        after.split("\n## ").next().unwrap_or_default()
    };
    let events = Parser::new_ext(body, Options::ENABLE_TABLES).flat_map(|event| match event {
        // A table wider than the page scrolls inside it.
        Event::Start(Tag::Table(alignment)) => vec![
            Event::Html("<div class=\"scroll prose\" tabindex=\"0\">".into()),
            Event::Start(Tag::Table(alignment)),
        ],
        Event::End(TagEnd::Table) => {
            vec![Event::End(TagEnd::Table), Event::Html("</div>".into())]
        }
        Event::Start(Tag::Heading {
            id, classes, attrs, ..
        }) => vec![Event::Start(Tag::Heading {
            level: HeadingLevel::H3,
            id,
            classes,
            attrs,
        })],
        // Comments, which mark computed tables.
        Event::Html(_) => Vec::new(),
        Event::End(TagEnd::Heading(_)) => vec![Event::End(TagEnd::Heading(HeadingLevel::H3))],
        other => vec![other],
    });
    let mut out = String::new();
    html::push_html(&mut out, events);
    out
}
