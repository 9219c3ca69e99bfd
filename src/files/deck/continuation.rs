//! From lines to cards: every continuation joined to the card it belongs to.

use super::card::{Card, FIELDS_PER_LINE, Field};
use super::lines::{Line, sections};
use crate::files::error::FileError;
use std::collections::HashMap;
use std::sync::Arc;

/// The bulk data cards of a text whatever they are, in the order of the file.
pub(in crate::files) fn cards(file: &str, text: &str) -> Result<Vec<Card>, FileError> {
    join(&file.into(), sections(file, text)?.1)
}

/// Joins lines to cards, in the order of the file. `file` is its name in messages.
///
/// A continuation belongs to the card that ends with its tag, wherever it stands; without a tag, to the line before it.
///
/// # Errors
/// [`FileError::DeckLine`] for a continuation without a card and two cards or two continuations with one tag.
pub(super) fn join(file: &Arc<str>, lines: Vec<Line>) -> Result<Vec<Card>, FileError> {
    let mut cards: Vec<Card> = Vec::new();
    // Continuations may stand before their card: they wait by tag until all lines are known.
    let mut waiting: HashMap<String, Line> = HashMap::new();
    let mut ends = Vec::new();
    let mut open: Option<usize> = None;
    for line in lines {
        if !line.continues() {
            ends.push(line.tag.clone());
            open = line.tag.is_empty().then_some(cards.len());
            cards.push(Card {
                file: file.clone(),
                line: line.number,
                name: line.first.trim_end_matches('*').to_owned(),
                fields: line.data,
            });
        } else if line.own_tag().is_empty() {
            let card = open.ok_or_else(|| no_parent(file, &line))?;
            append(&mut cards[card], &line);
            open = line.tag.is_empty().then_some(card);
            ends[card] = line.tag;
        } else {
            open = None;
            let (tag, number) = (line.own_tag().to_owned(), line.number);
            if let Some(first) = waiting.insert(tag.clone(), line) {
                let found = format!("{tag}, which the one in line {} has", first.number);
                return Err(FileError::line(file, number, "a continuation with a tag of its own", found));
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
            let found = format!("tag {tag}, which continues the card of line {first}");
            return Err(FileError::line(file, card.line, "a card with continuations of its own", found));
        }
    }
    match waiting.values().min_by_key(|line| line.number) {
        Some(orphan) => Err(no_parent(file, orphan)),
        None => Ok(cards),
    }
}

fn no_parent(file: &str, line: &Line) -> FileError {
    let found = match line.own_tag() {
        "" => "none before it".to_owned(),
        tag => format!("none that ends with tag {tag}"),
    };
    FileError::line(file, line.number, "a card that this line continues", found)
}

fn append(card: &mut Card, line: &Line) {
    // The second half of a card of the large format may be missing.
    if !line.large {
        let whole = card.fields.len().next_multiple_of(FIELDS_PER_LINE);
        let blank = Field { text: String::new(), line: line.number };
        card.fields.resize(whole, blank);
    }
    card.fields.extend(line.data.iter().cloned());
}
