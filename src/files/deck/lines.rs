//! From a file to its cards: sections, comments, the free, small and large formats, and continuations.

use super::card::{Card, FIELDS_PER_LINE, Field};
use super::number::{LARGE_FIELD, SMALL_FIELD};
use crate::files::error::{FileError, ensure};
use std::sync::Arc;

/// Data fields of a line in the large format.
pub const LARGE_FIELDS_PER_LINE: usize = 4;
/// Statements that read another file, in any section.
pub const INCLUDES: [&str; 2] = ["INCLUDE", "READFILE"];
/// Fault of a line in free format with more fields than the others have columns for.
const TOO_MANY: &str =
    "has more than ten fields in its line; go on in another line, which begins by a comma";
/// Characters between words.
const WORD_ENDS: [char; 6] = [' ', '\t', ',', '=', '\'', '"'];
/// Fault of a line that is no line of a card.
const NO_CARD: &str = "is neither a card's name nor a continuation";
/// Fault of a line that begins by `=`.
const REPLICA: &str = "repeats the card before it, and replication (=, ==, *(n)) is not read; write the cards out, as pyNastran's read_bdf \
                       and write_bdf do";

/// Sets of constraints that case control selects by `SPC = n` and `MPC = n`, each with its line, above all subcases
/// or in the first.
pub type Selected = [Option<(usize, usize)>; 2];

/// One line of bulk data, cut into fields.
pub struct Line {
    /// The line as a card: its name is field 1 in capitals, of a continuation its tag without `+` or `*`; its fields are 2 to 9, or four
    /// large ones.
    card: Card,
    /// True of every line that begins no card.
    continues: bool,
    /// Fields of a line in its format.
    count: usize,
    /// Field 10.
    tag: String,
}

impl Line {
    /// True of a continuation of a line that ends with this tag: columns 2 to 8 of field 10 count, whatever the first is, and programs
    /// leave that away.
    fn follows(&self, tag: &str) -> bool {
        let whole = tag.trim_start_matches(['+', '*']);
        let behind: String = tag.chars().skip(1).collect();
        let own = self.card.name.as_str();
        own.is_empty() || [whole, behind.trim()].contains(&own)
    }
}

/// Case control's selection, `None` for a file of bulk data alone, and the lines of bulk data; `$` begins a comment.
///
/// PARAM and INCLUDE statements in front of the bulk data belong to the model too and are among its lines.
pub fn sections(file: &Arc<str>, text: &str) -> Result<(Option<Selected>, Vec<Line>), FileError> {
    let code = |line: &str| {
        line.split('$')
            .next()
            .unwrap_or_default()
            .to_ascii_uppercase()
    };
    let lines: Vec<(usize, String)> = (1..)
        .zip(text.lines().map(code))
        .filter(|(_, line)| !line.trim().is_empty())
        .collect();
    let begins = |line: &str| word(line, 0) == Some("BEGIN");
    // In front of bulk data, other words may follow BEGIN, as in instructions of matrix programs.
    let is_bulk =
        |line: &str| begins(line) && matches!(word(line, 1), None | Some("BULK" | "SUPER"));
    let begin = lines.iter().position(|(_, line)| is_bulk(line));
    let mut behind = lines.iter().skip(begin.map_or(lines.len(), |row| row + 1));
    if let Some((number, _)) = behind.find(|(_, line)| begins(line)) {
        return Err(FileError::line(
            file,
            *number,
            "this is the second part of bulk data; corfem has no superelements",
        ));
    }
    let (control, bulk) = lines.split_at(begin.map_or(0, |row| row + 1));
    let (mut selected, mut subcases) = (Selected::default(), 0);
    for (number, line) in control {
        subcases += usize::from(word(line, 0) == Some("SUBCASE"));
        if subcases < 2 {
            select(file, *number, line, &mut selected)?;
        }
    }
    let is_of_model = |line: &str| word(line, 0) == Some("PARAM") || include(line).is_some();
    // Programs write a checksum or remarks behind the word.
    let is_end = |line: &str| word(line, 0) == Some("ENDDATA");
    let control = control.iter().filter(|(_, line)| is_of_model(line));
    let bulk = bulk.iter().take_while(|(_, line)| !is_end(line));
    let bulk = control
        .chain(bulk)
        .map(|(number, line)| fields(file, *number, line.trim_end()));
    Ok((begin.map(|_| selected), bulk.collect()))
}

/// A word of a line, counted from zero.
fn word(line: &str, place: usize) -> Option<&str> {
    line.split(WORD_ENDS)
        .filter(|word| !word.is_empty())
        .nth(place)
}

/// The word that begins a line which names another file.
fn include(line: &str) -> Option<&'static str> {
    let first = word(line, 0);
    INCLUDES.into_iter().find(|name| first == Some(name))
}

/// Notes the sets that `SPC = n` and `MPC = n` select.
fn select(file: &str, line: usize, text: &str, [spc, mpc]: &mut Selected) -> Result<(), FileError> {
    let (slot, set) = match text.split_once('=').map(|(name, set)| (name.trim(), set)) {
        Some(("SPC", set)) => (spc, set),
        Some(("MPC", set)) => (mpc, set),
        _ => return Ok(()),
    };
    let set = set.trim().parse().ok();
    let set = set.filter(|set| slot.is_none_or(|(earlier, _)| earlier == *set));
    *slot = set.map(|set| (set, line));
    ensure(slot.is_some(), || {
        let reason =
            "must select one set of constraints by its number, in a subcase the same as above it";
        FileError::line(file, line, format!("\"{}\" {reason}", text.trim()))
    })
}

/// True of a text that begins as a card's name does.
fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic())
}

/// Cuts a line into field 1 and the fields behind it, field 10 among them, and tells the number of a line's fields. It is in free format with
/// a comma behind its first word. Otherwise an asterisk behind the name or in front of a continuation means fields of 16 characters, its
/// absence fields of 8.
fn cut(text: &str) -> (String, Vec<String>, usize) {
    // A continuation whose first eight columns are blank is in fixed format.
    let is_indented = text.starts_with(&" ".repeat(SMALL_FIELD));
    let first = text.split(',').next().unwrap_or_default().trim();
    let is_free = text.contains(',')
        && !first.contains(char::is_whitespace)
        && (is_name(first) || !is_indented);
    let columns = expand_tabs(text);
    let slice = |from: usize, width: usize| columns.iter().skip(from).take(width).collect();
    let mut cells: Vec<String> = text.split(',').map(str::to_owned).collect();
    let name: String = if is_free {
        cells.remove(0)
    } else {
        slice(0, SMALL_FIELD)
    };
    let [width, count] = if name.trim().ends_with('*') || name.trim().starts_with('*') {
        [LARGE_FIELD, LARGE_FIELDS_PER_LINE]
    } else {
        [SMALL_FIELD, FIELDS_PER_LINE]
    };
    if !is_free {
        let starts = (0..count).map(|place| SMALL_FIELD + width * place);
        cells = starts.map(|start| slice(start, width)).collect();
        // Text behind column 80 does not count.
        cells.push(slice(SMALL_FIELD + width * count, SMALL_FIELD));
    }
    (name, cells, count)
}

fn fields(file: &Arc<str>, line: usize, text: &str) -> Line {
    let (name, mut cells, count) = match include(text) {
        Some(name) => (name.to_owned(), Vec::new(), FIELDS_PER_LINE),
        None => cut(text),
    };
    let name = name.trim();
    let wrong = |what: &str| Some((line, format!("\"{name}\" {what}")));
    // What reads the card before a line that is none finds out whether it matters.
    let (first, fault) = match name.chars().next() {
        Some('=') => ("", wrong(REPLICA)),
        None | Some('+' | '*') => (name.trim_start_matches(['+', '*']), None),
        _ if is_name(name) => (name.trim_end_matches('*'), None),
        _ => ("", wrong(NO_CARD)),
    };
    let fault = fault.or(wrong(TOO_MANY).filter(|_| cells.len() > count + 1));
    cells.resize(count + 1, String::new());
    let mut fields = cells.iter().map(|cell| Field {
        text: cell.trim().to_owned(),
        line,
    });
    Line {
        card: Card {
            file: file.clone(),
            line,
            name: first.to_owned(),
            fields: fields.by_ref().take(count).collect(),
            fault,
        },
        continues: !is_name(name),
        count,
        tag: fields.next().map_or_else(String::new, |field| field.text),
    }
}

/// Replaces every tab by blanks up to the next multiple of eight columns.
fn expand_tabs(text: &str) -> Vec<char> {
    let mut columns: Vec<char> = Vec::new();
    for c in text.chars() {
        columns.push(if c == '\t' { ' ' } else { c });
        if c == '\t' {
            columns.resize(columns.len().next_multiple_of(SMALL_FIELD), ' ');
        }
    }
    columns
}

/// The bulk data cards of a text whatever they are, in the order of the file.
pub fn cards(file: &str, text: &str) -> Result<Vec<Card>, FileError> {
    join(sections(&file.into(), text)?.1)?
        .into_iter()
        .map(Card::sound)
        .collect()
}

/// Joins lines to cards, in the order of the file. A continuation stands directly behind its card, with the tag at the end of the line
/// before it or without one.
pub fn join(lines: Vec<Line>) -> Result<Vec<Card>, FileError> {
    let mut cards: Vec<Card> = Vec::new();
    let mut tag = String::new();
    for line in lines {
        match cards.last_mut() {
            _ if !line.continues => cards.push(line.card),
            Some(card) if line.follows(&tag) => {
                // The second half of a card of the large format may be missing.
                if line.count == FIELDS_PER_LINE {
                    let whole = card.fields.len().next_multiple_of(FIELDS_PER_LINE);
                    card.fields.resize(whole, Field::blank(line.card.line));
                }
                card.fields.extend(line.card.fields);
                card.fault = card.fault.take().or(line.card.fault);
            }
            _ => {
                let mut own = line.card;
                let reason = format!(
                    "continuation +{} does not stand directly behind the line that ends with its tag; move it there, or correct its tag",
                    own.name
                );
                own.fault.get_or_insert((own.line, reason));
                own.sound()?;
            }
        }
        // Field 10 without a continuation is a remark.
        tag = line.tag;
    }
    Ok(cards)
}
