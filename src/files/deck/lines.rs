//! From a file to its lines: sections, comments, and the free, small and large formats.

use super::card::{FIELDS_PER_LINE, Field};
use super::number::{LARGE_FIELD, SMALL_FIELD};
use crate::files::error::FileError;
use std::borrow::Cow;

/// Data fields of a line in the large format.
pub(super) const LARGE_FIELDS_PER_LINE: usize = 4;
/// Columns of a line that count.
const LINE_WIDTH: usize = 80;

/// Statements that read another file, in any section.
const INCLUDES: [&str; 2] = ["INCLUDE", "READFILE"];
/// What stands behind the first word of such a statement, or of a parameter.
const WORD_ENDS: [char; 4] = [' ', ',', '\'', '"'];

/// Sets of constraints that case control selects by `SPC = n` and `MPC = n`, each with the line that does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Selected {
    pub spc: Option<(usize, usize)>,
    pub mpc: Option<(usize, usize)>,
}

/// One line of bulk data, cut into fields.
pub(super) struct Line {
    /// Its number in the file, from one.
    pub number: usize,
    /// Field 1 in capitals: a name, or `+`, `*` or nothing before a continuation's tag.
    pub first: String,
    /// Fields 2 to 9, or four large ones.
    pub data: Vec<Field>,
    /// Whether they are large.
    pub large: bool,
    /// Field 10, without its `+` or `*`.
    pub tag: String,
}

impl Line {
    /// Whether this is a continuation.
    pub fn continues(&self) -> bool {
        self.first.is_empty() || self.first.starts_with(['+', '*'])
    }

    /// The tag of a continuation, as field 1 has it.
    pub fn own_tag(&self) -> &str {
        self.first.trim_start_matches(['+', '*'])
    }
}

/// The text of a file in UTF-8, with or without a byte order mark, or else in Latin-1.
pub(in crate::files) fn decoded(bytes: &[u8]) -> Cow<'_, str> {
    let bytes = bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(bytes);
    let latin_1 = || bytes.iter().map(|&byte| char::from(byte)).collect::<String>();
    std::str::from_utf8(bytes).map_or_else(|_| latin_1().into(), Cow::from)
}

/// Case control's selection, `None` for a file of bulk data alone, and the lines of bulk data; `$` begins a comment.
///
/// What stands in front of the bulk data and yet is part of the model, parameters and other files, is among its lines.
///
/// # Errors
/// [`FileError::DeckLine`] for a line that is neither card nor continuation and for a selection that is not one set.
pub(super) fn sections(file: &str, text: &str) -> Result<(Option<Selected>, Vec<Line>), FileError> {
    let code = |line: &str| line.split('$').next().unwrap_or_default().to_ascii_uppercase();
    let lines = (1..).zip(text.lines().map(code)).filter(|(_, line)| !line.trim().is_empty());
    let lines: Vec<(usize, String)> = lines.collect();
    let begin = lines.iter().position(|(_, line)| line.split_whitespace().eq(["BEGIN", "BULK"]));
    let (control, bulk) = lines.split_at(begin.map_or(0, |row| row + 1));
    let mut selected = begin.map(|_| Selected::default());
    if let Some(selected) = &mut selected {
        for (number, line) in control {
            select(file, *number, line, selected)?;
        }
    }
    let of_model = |(_, line): &&(usize, String)| statement(line, &["PARAM"]).or(statement(line, &INCLUDES)).is_some();
    let bulk = bulk.iter().take_while(|(_, line)| line.trim() != "ENDDATA");
    let bulk = control.iter().filter(of_model).chain(bulk).map(|(number, line)| fields(file, *number, line.trim_end()));
    Ok((selected, bulk.collect::<Result<_, _>>()?))
}

/// Which of these words a line begins with.
fn statement(line: &str, names: &[&'static str]) -> Option<&'static str> {
    let begins = |name: &&&str| line.trim_start().strip_prefix(**name).is_some_and(|rest| rest.starts_with(WORD_ENDS));
    names.iter().find(begins).copied()
}

/// Takes notice of `SPC = n` and `MPC = n`.
fn select(file: &str, line: usize, text: &str, selected: &mut Selected) -> Result<(), FileError> {
    let (slot, set) = match text.split_once('=').map(|(name, set)| (name.trim(), set)) {
        Some(("SPC", set)) => (&mut selected.spc, set),
        Some(("MPC", set)) => (&mut selected.mpc, set),
        _ => return Ok(()),
    };
    match set.trim().parse() {
        Ok(set) if slot.is_none_or(|(earlier, _)| earlier == set) => *slot = Some((set, line)),
        _ => return Err(FileError::line(file, line, "one set of constraints, by its number", text.trim())),
    }
    Ok(())
}

/// Cuts a line into its fields. With a comma it is in free format; otherwise an asterisk behind the name or in front of
/// a continuation means fields of 16 characters, its absence fields of 8.
fn fields(file: &str, number: usize, text: &str) -> Result<Line, FileError> {
    if let Some(name) = statement(text, &INCLUDES) {
        return Ok(Line { number, first: name.to_owned(), data: Vec::new(), large: false, tag: String::new() });
    }
    let wrong = |expected, found: &str| FileError::line(file, number, expected, found.trim());
    let is_large = |name: &str| name.ends_with('*') || name.starts_with('*');
    let mut parts: Vec<String> = if text.contains(',') {
        text.split(',').map(|part| part.trim().to_owned()).collect()
    } else {
        let mut columns = expand_tabs(text);
        columns.truncate(LINE_WIDTH);
        let (name, data) = columns.split_at(SMALL_FIELD.min(columns.len()));
        let field = |columns: &[char]| columns.iter().collect::<String>().trim().to_owned();
        let large = is_large(name.iter().collect::<String>().trim_end());
        let width = if large { LARGE_FIELD } else { SMALL_FIELD };
        // The last columns, which a large field would overrun, are the tag of a continuation: a chunk of their own.
        std::iter::once(name).chain(data.chunks(width)).map(field).collect()
    };
    let first = parts.remove(0);
    let large = is_large(&first);
    let (width, count) = if large { (LARGE_FIELD, LARGE_FIELDS_PER_LINE) } else { (SMALL_FIELD, FIELDS_PER_LINE) };
    let is_named = first.starts_with(|c: char| c.is_ascii_alphabetic());
    if !is_named && !first.is_empty() && !first.starts_with(['+', '*']) {
        return Err(wrong("a card's name or a continuation", &first));
    }
    if parts.len() > count + 1 {
        return Err(wrong("no more fields than a line has", text));
    }
    parts.resize(count + 1, String::new());
    let tag = parts.pop().unwrap_or_default();
    if let Some(long) = parts.iter().find(|part| part.chars().count() > width) {
        return Err(wrong("a field of 8 characters, or of 16 with an asterisk", long));
    }
    let data = parts.into_iter().map(|text| Field { text, line: number });
    Ok(Line { number, first, data: data.collect(), large, tag: tag.trim_start_matches(['+', '*']).to_owned() })
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
