//! From lines to cards: every continuation joined to the card it belongs to.

use super::card::{Card, FIELDS_PER_LINE, Field};
use super::lines::{Line, Selected, sections};
use crate::files::error::FileError;
use std::collections::HashMap;
use std::sync::Arc;

/// What a file holds, before any card is understood.
#[derive(Debug, Clone, PartialEq)]
pub struct Cards {
    /// Bulk data cards in the order of the file.
    pub cards: Vec<Card>,
    /// The sets that case control selects; `None` for a file of bulk data alone.
    pub selected: Option<Selected>,
}

/// Cuts a deck into cards. `file` is its name in messages.
///
/// A line with a comma is in free format; otherwise an asterisk behind the name or in front of a continuation means
/// fields of 16 characters, its absence fields of 8. `$` begins a comment. A continuation belongs to the card
/// that ends with its tag, wherever it stands; without a tag, to the line before it.
///
/// # Errors
/// [`FileError::DeckLine`] for a line that is none of these, a continuation without a card and two cards or two
/// continuations with one tag.
pub fn cut(file: &str, text: &str) -> Result<Cards, FileError> {
    let file: Arc<str> = file.into();
    let (selected, lines) = sections(&file, text)?;
    let mut cards: Vec<Card> = Vec::new();
    // Continuations may stand before their card: they wait by tag until all lines are known.
    let mut waiting: HashMap<String, Line> = HashMap::new();
    let mut ends = Vec::new();
    let mut open: Option<usize> = None;
    for line in lines {
        if !line.continues() {
            let name = line.first.trim_end_matches('*').to_owned();
            ends.push(line.tag.clone());
            open = line.tag.is_empty().then_some(cards.len());
            cards.push(Card {
                file: file.clone(),
                line: line.number,
                name,
                fields: line.data,
            });
        } else if line.own_tag().is_empty() {
            let Some(card) = open else {
                return Err(no_parent(&file, &line));
            };
            append(&mut cards[card], &line);
            open = line.tag.is_empty().then_some(card);
            ends[card] = line.tag;
        } else {
            open = None;
            let tag = line.own_tag().to_owned();
            let number = line.number;
            if let Some(first) = waiting.insert(tag.clone(), line) {
                return Err(FileError::DeckLine {
                    file: file.to_string(),
                    line: number,
                    expected: "a continuation with a tag of its own",
                    found: format!("{tag}, which the one in line {} has", first.number),
                });
            }
        }
    }
    let mut taken: HashMap<String, usize> = HashMap::new();
    for (card, mut tag) in cards.iter_mut().zip(ends) {
        // Field 10 without a continuation is a remark, and the card ends here.
        while let Some(line) = waiting.remove(&tag) {
            append(card, &line);
            taken.insert(tag, card.line);
            tag = line.tag;
        }
        if let Some(first) = taken.get(&tag) {
            return Err(FileError::DeckLine {
                file: file.to_string(),
                line: card.line,
                expected: "a card with continuations of its own",
                found: format!("tag {tag}, which continues the card of line {first}"),
            });
        }
    }
    match waiting.values().min_by_key(|line| line.number) {
        Some(orphan) => Err(no_parent(&file, orphan)),
        None => Ok(Cards { cards, selected }),
    }
}

fn no_parent(file: &str, line: &Line) -> FileError {
    FileError::DeckLine {
        file: file.to_owned(),
        line: line.number,
        expected: "a card that this line continues",
        found: match line.own_tag() {
            "" => "none before it".to_owned(),
            tag => format!("none that ends with tag {tag}"),
        },
    }
}

fn append(card: &mut Card, line: &Line) {
    // The second half of a card of the large format may be missing.
    if !line.large {
        let whole = card.fields.len().next_multiple_of(FIELDS_PER_LINE);
        let blank = Field {
            text: String::new(),
            line: line.number,
        };
        card.fields.resize(whole, blank);
    }
    card.fields.extend(line.data.iter().cloned());
}
