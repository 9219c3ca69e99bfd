//! From a file to its cards: sections, comments, the free, small and large formats, and continuations.

use super::card::{Card, FIELDS_PER_LINE, Field};
use super::number::{LARGE_FIELD, SMALL_FIELD, parse_real};
use crate::files::error::FileError;
use std::sync::Arc;

/// Data fields of a line in the large format.
pub(super) const LARGE_FIELDS_PER_LINE: usize = 4;
/// Statements that read another file, in any section.
pub(super) const INCLUDES: [&str; 2] = ["INCLUDE", "READFILE"];
/// Characters that end the first word of such a statement, or of a parameter.
const WORD_ENDS: [char; 5] = [' ', ',', '=', '\'', '"'];
/// Fault of a line that is no line of a card.
const NO_CARD: &str = "is neither a card's name nor a continuation";
/// Fault of a line that begins by `=`.
const REPLICA: &str = "repeats the card before it, and replication (=, ==, *(n)) is not read; write the cards out, as pyNastran's read_bdf \
                       and write_bdf do";

/// Sets of constraints that case control selects by `SPC = n` and `MPC = n`, each with its line. The first subcase's selection
/// counts, or else the one above all subcases.
pub(super) type Selected = [Option<(usize, usize)>; 2];

/// One line of bulk data, cut into fields.
#[derive(Default)]
pub(super) struct Line {
    /// Number of the line in the file, from one.
    number: usize,
    /// Field 1 in capitals: a name, or of a continuation its tag without `+` or `*`.
    first: String,
    /// True of every line that begins no card.
    continues: bool,
    /// Fields 2 to 9, or four large ones, or those of several such lines.
    data: Vec<Field>,
    /// Fields of a line in its format.
    count: usize,
    /// Field 10.
    tag: String,
    /// Error of the line, if it belongs to a card that is read.
    fault: Option<FileError>,
}

impl Line {
    /// True of a continuation of a line that ends with this tag: columns 2 to 8 of field 10 count, whatever the first is, and programs
    /// leave that away.
    fn follows(&self, tag: &str) -> bool {
        let whole = tag.trim_start_matches(['+', '*']);
        let behind: String = tag.chars().skip(1).collect();
        self.first.is_empty() || [whole, behind.trim()].contains(&self.first.as_str())
    }
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
    let begins = |line: &str, of: &[&str]| {
        let mut words = line
            .split([' ', '\t', ',', '='])
            .filter(|word| !word.is_empty());
        words.next() == Some("BEGIN")
            && words
                .next()
                .is_none_or(|word| of.is_empty() || of.contains(&word))
    };
    // In front of bulk data, other words may follow BEGIN, as in instructions of matrix programs.
    let begin = lines
        .iter()
        .position(|(_, line)| begins(line, &["BULK", "SUPER"]));
    let mut behind = lines.iter().skip(begin.map_or(lines.len(), |row| row + 1));
    if let Some((number, _)) = behind.find(|(_, line)| begins(line, &[])) {
        let reason = "this is the second part of bulk data; corfem has no superelements";
        return Err(FileError::line(file, *number, reason));
    }
    let (control, bulk) = lines.split_at(begin.map_or(0, |row| row + 1));
    let (mut levels, mut subcases) = ([Selected::default(); 2], 0);
    for (number, line) in control {
        subcases += usize::from(statement(line, &["SUBCASE"]).is_some());
        if let Some(level) = levels.get_mut(subcases) {
            select(file, *number, line, level)?;
        }
    }
    let selected = [0, 1].map(|row| levels[1][row].or(levels[0][row]));
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
    Ok((begin.map(|_| selected), bulk.collect()))
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
    /// Places among these of the data fields, of one line or more.
    pub places: Vec<usize>,
    pub is_free: bool,
    /// Fields of a line, and their width.
    pub count: usize,
    pub width: usize,
}

/// Cuts a line. With a comma behind its first word it is in free format; otherwise an asterisk behind the name or in front of a continuation
/// means fields of 16 characters, its absence fields of 8.
pub(super) fn cut(text: &str) -> Cut {
    let first = text.split_once(',').map(|(first, _)| first.trim());
    // A continuation whose first eight columns are blank is in fixed format.
    let is_indented = text.chars().take_while(|c| *c == ' ').count() >= SMALL_FIELD;
    let is_word = |first: &str| {
        let is_name = first.starts_with(|c: char| c.is_ascii_alphabetic());
        !first.contains(char::is_whitespace) && (is_name || !is_indented)
    };
    let is_free = first.is_some_and(is_word);
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
    let parts: Vec<String> = if is_free {
        parts.collect()
    } else {
        fixed.collect()
    };
    // A free line of more fields goes on as the next would, whose field 1 may stand behind field 10 as its tag, or at once.
    let is_tag = |part: &String| part.trim().is_empty() || part.trim().starts_with(['+', '*']);
    let is_tagged = parts.get(count).is_none_or(is_tag);
    let places: Vec<usize> = match parts.len() > count + 1 {
        true if is_tagged => (0..parts.len())
            .filter(|place| place % (count + 1) < count)
            .collect(),
        true => (0..parts.len()).collect(),
        false => (0..count).collect(),
    };
    Cut {
        name,
        parts,
        places,
        is_free,
        count,
        width,
    }
}

fn fields(file: &str, number: usize, text: &str) -> Line {
    if let Some(name) = statement(text, &INCLUDES) {
        return Line {
            number,
            first: name.to_owned(),
            ..Line::default()
        };
    }
    let wrong = |text: &str, what: &str| {
        let reason = format!("\"{}\" {what}", text.trim());
        FileError::line(file, number, reason)
    };
    let Cut {
        name,
        mut parts,
        places,
        is_free,
        count,
        width,
    } = cut(text);
    if let (false, Some(tag)) = (is_free, parts.last_mut()) {
        // Text behind column 80 does not count.
        *tag = tag.chars().take(SMALL_FIELD).collect();
    }
    let first = name.trim();
    let continues = !first.starts_with(|c: char| c.is_ascii_alphabetic());
    // What reads the card before a line that is none finds out whether it matters.
    let mut fault = None;
    let first = if !continues {
        first.trim_end_matches('*')
    } else if first.is_empty() || first.starts_with(['+', '*']) {
        first.trim_start_matches(['+', '*'])
    } else {
        let is_replica = first.starts_with('=');
        fault = Some(wrong(first, if is_replica { REPLICA } else { NO_CARD }));
        ""
    }
    .to_owned();
    let field = |place: &usize| Field {
        text: parts.get(*place).map_or("", |part| part.trim()).to_owned(),
        line: number,
    };
    let mut data: Vec<Field> = places.iter().map(field).collect();
    let whole = data.len().next_multiple_of(count);
    data.resize(whole, Field::blank(number));
    // Real numbers of the free format may be longer than others.
    let is_long = |field: &&Field| {
        let is_number = is_free && parse_real(&field.text).is_some();
        field.text.chars().count() > width && !is_number
    };
    if let Some(long) = data.iter().find(is_long) {
        let what = "is longer than a field: 8 characters, or 16 with an asterisk";
        fault.get_or_insert(wrong(&long.text, what));
    }
    let last = parts
        .get(places.len().max(count))
        .filter(|_| parts.len() > count);
    let tag = last.map(|last| last.trim().to_owned()).unwrap_or_default();
    Line {
        number,
        first,
        continues,
        data,
        count,
        tag,
        fault,
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
pub(crate) fn cards(file: &str, text: &str) -> Result<Vec<Card>, FileError> {
    let found = join(&file.into(), sections(file, text)?.1)?;
    found.into_iter().map(Joined::sound).collect()
}

/// A card, and what is wrong with its lines or their order.
pub(super) struct Joined {
    pub card: Card,
    fault: Option<FileError>,
}

impl Joined {
    /// The card, unless something is wrong with it.
    pub fn sound(self) -> Result<Card, FileError> {
        self.fault.map_or(Ok(self.card), Err)
    }
}

/// Joins lines to cards, in the order of the file. A continuation stands directly behind its card, with the tag at the end of the line
/// before it or without one.
pub(super) fn join(file: &Arc<str>, lines: Vec<Line>) -> Result<Vec<Joined>, FileError> {
    let mut cards: Vec<Joined> = Vec::new();
    let mut tag = String::new();
    for line in lines {
        match cards.last_mut() {
            _ if !line.continues => cards.push(Joined {
                card: Card {
                    file: file.clone(),
                    line: line.number,
                    name: line.first,
                    fields: line.data,
                },
                fault: line.fault,
            }),
            Some(Joined { card, fault }) if line.follows(&tag) => {
                // The second half of a card of the large format may be missing.
                if line.count == FIELDS_PER_LINE {
                    let whole = card.fields.len().next_multiple_of(FIELDS_PER_LINE);
                    card.fields.resize(whole, Field::blank(line.number));
                }
                card.fields.extend(line.data);
                *fault = fault.take().or(line.fault);
            }
            _ => {
                let reason = format!(
                    "continuation +{} does not stand directly behind the line that ends with its tag; move it there, or correct its tag",
                    line.first
                );
                let astray = FileError::line(file, line.number, reason);
                return Err(line.fault.unwrap_or(astray));
            }
        }
        // Field 10 without a continuation is a remark.
        tag = line.tag;
    }
    Ok(cards)
}
