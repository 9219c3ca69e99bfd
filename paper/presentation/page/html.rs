//! Figures and the project's Markdown texts as HTML.

use super::super::figures::Figure;
use corfem::present::page::escaped;
use pulldown_cmark::{Event, HeadingLevel, Options, Parser, Tag, TagEnd, html};

/// A figure; `see` says before the caption what to look for.
pub(super) fn figure(drawn: &Figure, see: &str) -> String {
    let (caption, name) = (escaped(&drawn.caption), escaped(&drawn.name));
    let drawing = format!("<div class=\"drawing\">\n{}</div>\n", drawn.svg);
    let see = if see.is_empty() {
        String::new()
    } else {
        format!("<strong>{}</strong> ", escaped(see))
    };
    format!("<figure id=\"{name}\">\n{drawing}<figcaption>{see}{caption}</figcaption>\n</figure>\n")
}

/// Figures side by side where there is room.
pub(super) fn figures(class: &str, figures: impl Iterator<Item = String>) -> String {
    let figures: String = figures.collect();
    if figures.is_empty() {
        figures
    } else {
        format!("<div class=\"{class}\">\n{figures}</div>\n")
    }
}

/// A section of a Markdown document without its heading, as HTML.
pub(super) fn section_of(markdown: &str, heading: &str) -> String {
    let after = markdown
        .split_once(&format!("## {heading}\n"))
        .map_or("", |(_, after)| after);
    prose(after.split("\n## ").next().unwrap_or_default())
}

/// Markdown as HTML; headings stand one level lower.
pub(super) fn prose(markdown: &str) -> String {
    let events = Parser::new_ext(markdown, Options::ENABLE_TABLES).flat_map(|event| match event {
        Event::Start(Tag::Table(alignment)) => {
            vec![
                Event::Html("<div class=\"scroll prose\" tabindex=\"0\">".into()),
                Event::Start(Tag::Table(alignment)),
            ]
        }
        Event::End(TagEnd::Table) => vec![Event::End(TagEnd::Table), Event::Html("</div>".into())],
        Event::Start(Tag::Heading {
            id, classes, attrs, ..
        }) => {
            vec![Event::Start(Tag::Heading {
                level: HeadingLevel::H3,
                id,
                classes,
                attrs,
            })]
        }
        // Comments mark computed tables in the source.
        Event::Html(_) => Vec::new(),
        Event::End(TagEnd::Heading(_)) => vec![Event::End(TagEnd::Heading(HeadingLevel::H3))],
        other => vec![other],
    });
    let mut out = String::new();
    html::push_html(&mut out, events);
    out
}
