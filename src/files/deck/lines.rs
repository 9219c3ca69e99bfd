//! From a file to its cards: sections, comments, the free, small and large formats, and continuations.

use super::card::{Card, FIELDS_PER_LINE, Field};
use super::number::{LARGE_FIELD, SMALL_FIELD};
use crate::files::error::FileError;
use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::Arc;

/// Data fields of a line in the large format.
pub(super) const LARGE_FIELDS_PER_LINE: usize = 4;
/// Statements that read another file, in any section.
const INCLUDES: [&str; 2] = ["INCLUDE", "READFILE"];
/// Characters that end the first word of such a statement, or of a parameter.
const WORD_ENDS: [char; 4] = [' ', ',', '\'', '"'];

/// Sets of constraints that case control selects by `SPC = n` and `MPC = n`, each with its line. The first subcase's selection
/// counts, or else the one above all subcases.
pub(super) type Selected = [Option<(usize, usize)>; 2];

/// One line of bulk data, cut into fields.
pub(super) struct Line {
    /// Number of the line in the file, from one.
    number: usize,
    /// Field 1 in capitals: a name, or of a continuation its tag without `+` or `*`.
    first: String,
    continues: bool,
    /// Fields 2 to 9, or four large ones.
    data: Vec<Field>,
    /// Field 10, without its `+` or `*`.
    tag: String,
}

/// The text of a file in UTF-8, with or without a byte order mark, or else in Latin-1.
pub(crate) fn decoded(bytes: &[u8]) -> Cow<'_, str> {
    let bytes = bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(bytes);
    let latin_1 = || {
        bytes
            .iter()
            .map(|&byte| char::from(byte))
            .collect::<String>()
    };
    std::str::from_utf8(bytes).map_or_else(|_| latin_1().into(), Cow::from)
}

/// Case control's selection, `None` for a file of bulk data alone, and the lines of bulk data; `$` begins a comment.
///
/// PARAM and INCLUDE statements in front of the bulk data belong to the model too and are among its lines.
pub(super) fn sections(file: &str, text: &str) -> Result<(Option<Selected>, Vec<Line>), FileError> {
    let code = |line: &str| {
        line.split('$')
            .next()
            .unwrap_or_default()
            .to_ascii_uppercase()
    };
    let lines = (1..)
        .zip(text.lines().map(code))
        .filter(|(_, line)| !line.trim().is_empty());
    let lines: Vec<(usize, String)> = lines.collect();
    let begin = lines
        .iter()
        .position(|(_, line)| line.split_whitespace().eq(["BEGIN", "BULK"]));
    let (control, bulk) = lines.split_at(begin.map_or(0, |row| row + 1));
    let (mut selected, mut levels) = (Selected::default(), [Selected::default(); 2]);
    let mut subcases = 0;
    for (number, line) in control {
        subcases += usize::from(statement(line, &["SUBCASE"]).is_some());
        if let Some(level) = levels.get_mut(subcases) {
            select(file, *number, line, level)?;
        }
    }
    for (row, chosen) in selected.iter_mut().enumerate() {
        *chosen = levels[1][row].or(levels[0][row]);
    }
    let of_model = |(_, line): &&(usize, String)| {
        statement(line, &["PARAM"])
            .or(statement(line, &INCLUDES))
            .is_some()
    };
    // Programs write a checksum or remarks behind the word.
    let is_end =
        |line: &str| line.split(WORD_ENDS).find(|word| !word.is_empty()) == Some("ENDDATA");
    let bulk = bulk
        .iter()
        .take_while(|(_, line)| !is_end(&line.replace('\t', " ")));
    let bulk = control
        .iter()
        .filter(of_model)
        .chain(bulk)
        .map(|(number, line)| fields(file, *number, line.trim_end()));
    Ok((begin.map(|_| selected), bulk.collect::<Result<_, _>>()?))
}

/// The one of these words with which a line begins.
fn statement(line: &str, names: &[&'static str]) -> Option<&'static str> {
    let begins = |name: &&&str| {
        line.trim_start()
            .strip_prefix(**name)
            .is_some_and(|rest| rest.starts_with(WORD_ENDS))
    };
    names.iter().find(begins).copied()
}

/// Notes the sets that `SPC = n` and `MPC = n` select.
fn select(file: &str, line: usize, text: &str, [spc, mpc]: &mut Selected) -> Result<(), FileError> {
    let (slot, set) = match text.split_once('=').map(|(name, set)| (name.trim(), set)) {
        Some(("SPC", set)) => (spc, set),
        Some(("MPC", set)) => (mpc, set),
        _ => return Ok(()),
    };
    match set.trim().parse() {
        Ok(set) if slot.is_none_or(|(earlier, _)| earlier == set) => *slot = Some((set, line)),
        _ => {
            return Err(FileError::line(
                file,
                line,
                format!(
                    "\"{}\" must select one set of constraints by its number",
                    text.trim()
                ),
            ));
        }
    }
    Ok(())
}

/// A line cut into parts.
pub(super) struct Cut {
    pub name: String,
    /// Fields behind the name: in free format as many as there are, else all of a line and then the rest of it.
    pub parts: Vec<String>,
    pub is_free: bool,
    /// Fields of a line, and their width.
    pub count: usize,
    pub width: usize,
}

/// Cuts a line. With a comma it is in free format; otherwise an asterisk behind the name or in front of a continuation
/// means fields of 16 characters, its absence fields of 8.
pub(super) fn cut(text: &str) -> Cut {
    let is_free = text.contains(',');
    let columns = expand_tabs(text);
    let slice = |from: usize, to: usize| columns.iter().take(to).skip(from).collect::<String>();
    let mut parts = text.split(',').map(str::to_owned);
    let name = if is_free {
        parts.next().unwrap_or_default()
    } else {
        slice(0, SMALL_FIELD)
    };
    let is_large = name.trim().ends_with('*') || name.trim().starts_with('*');
    let (width, count) = if is_large {
        (LARGE_FIELD, LARGE_FIELDS_PER_LINE)
    } else {
        (SMALL_FIELD, FIELDS_PER_LINE)
    };
    let start = |place: usize| SMALL_FIELD + width * place;
    let fixed = (0..count)
        .map(|place| slice(start(place), start(place + 1)))
        .chain([slice(start(count), usize::MAX)]);
    let parts = if is_free {
        parts.collect()
    } else {
        fixed.collect()
    };
    Cut {
        name,
        parts,
        is_free,
        count,
        width,
    }
}

fn fields(file: &str, number: usize, text: &str) -> Result<Line, FileError> {
    if let Some(name) = statement(text, &INCLUDES) {
        return Ok(Line {
            number,
            first: name.to_owned(),
            continues: false,
            data: Vec::new(),
            tag: String::new(),
        });
    }
    let wrong = |text: &str, what: &str| {
        Err(FileError::line(
            file,
            number,
            format!("\"{}\" {what}", text.trim()),
        ))
    };
    let Cut {
        name,
        mut parts,
        is_free,
        count,
        width,
    } = cut(text);
    if let (false, Some(tag)) = (is_free, parts.last_mut()) {
        // Text behind column 80 does not count.
        *tag = tag.chars().take(SMALL_FIELD).collect();
    }
    let first = name.trim();
    let continues = first.is_empty() || first.starts_with(['+', '*']);
    if !continues && !first.starts_with(|c: char| c.is_ascii_alphabetic()) {
        return wrong(first, "is neither a card's name nor a continuation");
    }
    let first = if continues {
        first.trim_start_matches(['+', '*'])
    } else {
        first.trim_end_matches('*')
    }
    .to_owned();
    if parts.len() > count + 1 {
        return wrong(text, "has more fields than a line may have");
    }
    let field = |part: &String| Field {
        text: part.trim().to_owned(),
        line: number,
    };
    let mut data: Vec<Field> = parts.iter().map(field).collect();
    data.resize(
        count + 1,
        Field {
            text: String::new(),
            line: number,
        },
    );
    let tag = data.pop().map(|last| last.text).unwrap_or_default();
    if let Some(long) = data.iter().find(|field| field.text.chars().count() > width) {
        return wrong(
            &long.text,
            "is longer than a field: 8 characters, or 16 with an asterisk",
        );
    }
    let tag = tag.trim_start_matches(['+', '*']).to_owned();
    Ok(Line {
        number,
        first,
        continues,
        data,
        tag,
    })
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
pub(crate) fn cards(file: &str, text: &str) -> Result<Vec<Card>, FileError> {
    join(&file.into(), sections(file, text)?.1)
}

/// Joins lines to cards, in the order of the file. A continuation belongs to the card that ends with its tag, wherever it
/// stands; without a tag, to the line before it.
pub(super) fn join(file: &Arc<str>, lines: Vec<Line>) -> Result<Vec<Card>, FileError> {
    let mut cards: Vec<Card> = Vec::new();
    // Continuations may stand before their card: they wait by tag until all lines are known.
    let mut waiting: HashMap<String, Line> = HashMap::new();
    let mut ends = Vec::new();
    let mut open: Option<usize> = None;
    for line in lines {
        if !line.continues {
            ends.push(line.tag.clone());
            open = line.tag.is_empty().then_some(cards.len());
            cards.push(Card {
                file: file.clone(),
                line: line.number,
                name: line.first,
                fields: line.data,
            });
        } else if line.first.is_empty() {
            let card = open.ok_or_else(|| no_parent(file, &line))?;
            append(&mut cards[card], &line);
            open = line.tag.is_empty().then_some(card);
            ends[card] = line.tag;
        } else {
            open = None;
            let (tag, number) = (line.first.clone(), line.number);
            if let Some(first) = waiting.insert(tag.clone(), line) {
                let reason = format!(
                    "the continuation in line {} has the tag {tag} already",
                    first.number
                );
                return Err(FileError::line(file, number, reason));
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
            let reason = format!("tag {tag} continues the card of line {first} already");
            return Err(FileError::line(file, card.line, reason));
        }
    }
    match waiting.values().min_by_key(|line| line.number) {
        Some(orphan) => Err(no_parent(file, orphan)),
        None => Ok(cards),
    }
}

fn no_parent(file: &str, line: &Line) -> FileError {
    let reason = match line.first.as_str() {
        "" => "this line continues a card, but there is none before it".to_owned(),
        tag => format!("this line continues a card that ends with tag {tag}, but none does"),
    };
    FileError::line(file, line.number, reason)
}

fn append(card: &mut Card, line: &Line) {
    // The second half of a card of the large format may be missing.
    if line.data.len() == FIELDS_PER_LINE {
        let whole = card.fields.len().next_multiple_of(FIELDS_PER_LINE);
        let blank = Field {
            text: String::new(),
            line: line.number,
        };
        card.fields.resize(whole, blank);
    }
    card.fields.extend(line.data.iter().cloned());
}
