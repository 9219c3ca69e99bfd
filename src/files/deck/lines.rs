//! From a file to its lines: sections, comments, and the free, small and large formats.

use super::card::{FIELDS_PER_LINE, Field, LARGE_FIELDS_PER_LINE};
use super::number::{LARGE_FIELD, SMALL_FIELD};
use crate::files::error::FileError;

/// Columns of a line that count.
const LINE_WIDTH: usize = 80;

/// Sets of constraints that case control selects.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Selected {
    /// `SPC = n`.
    pub spc: Option<usize>,
    /// `MPC = n`.
    pub mpc: Option<usize>,
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

/// Case control's selection and the lines of bulk data.
pub(super) fn sections(file: &str, text: &str) -> Result<(Option<Selected>, Vec<Line>), FileError> {
    let lines: Vec<(usize, String)> = text
        .lines()
        .enumerate()
        .map(|(row, line)| {
            let code = line.split('$').next().unwrap_or_default();
            (row + 1, code.trim_end().to_ascii_uppercase())
        })
        .filter(|(_, line)| !line.trim().is_empty())
        .collect();
    let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
    let begin = lines
        .iter()
        .position(|(_, line)| words(line) == "BEGIN BULK");
    let mut selected = begin.map(|_| Selected::default());
    let bulk = begin.map_or(0, |row| row + 1);
    if let Some(selected) = &mut selected {
        for (number, line) in &lines[..bulk] {
            select(file, *number, line, selected)?;
        }
    }
    let bulk = lines[bulk..]
        .iter()
        .take_while(|(_, line)| words(line) != "ENDDATA")
        .map(|(number, line)| fields(file, *number, line))
        .collect::<Result<_, _>>()?;
    Ok((selected, bulk))
}

/// Takes notice of `SPC = n` and `MPC = n`.
fn select(file: &str, line: usize, text: &str, selected: &mut Selected) -> Result<(), FileError> {
    let Some((name, set)) = text.split_once('=') else {
        return Ok(());
    };
    let slot = match name.trim() {
        "SPC" => &mut selected.spc,
        "MPC" => &mut selected.mpc,
        _ => return Ok(()),
    };
    match set.trim().parse() {
        Ok(set) if slot.is_none_or(|earlier| earlier == set) => {
            *slot = Some(set);
            Ok(())
        }
        _ => Err(FileError::DeckLine {
            file: file.to_owned(),
            line,
            expected: "one set of constraints, by its number",
            found: text.trim().to_owned(),
        }),
    }
}

/// Cuts a line into its fields.
fn fields(file: &str, number: usize, text: &str) -> Result<Line, FileError> {
    let wrong = |expected, found: &str| FileError::DeckLine {
        file: file.to_owned(),
        line: number,
        expected,
        found: found.trim().to_owned(),
    };
    let free = text.contains(',');
    let mut parts: Vec<String> = if free {
        text.split(',').map(|part| part.trim().to_owned()).collect()
    } else {
        let columns: Vec<char> = expand_tabs(text).chars().take(LINE_WIDTH).collect();
        let name: String = columns.iter().take(SMALL_FIELD).collect();
        let large = name.trim_end().ends_with('*') || name.starts_with('*');
        let width = if large { LARGE_FIELD } else { SMALL_FIELD };
        // The last columns, which a large field would overrun, are the tag of a continuation: a chunk of their own.
        let data = columns.get(SMALL_FIELD..).unwrap_or_default();
        let cut = data.chunks(width).map(|field| field.iter().collect());
        let parts: Vec<String> = std::iter::once(name).chain(cut).collect();
        parts.iter().map(|part| part.trim().to_owned()).collect()
    };
    let first = parts.remove(0);
    let large = first.ends_with('*') || first.starts_with('*');
    let (width, count) = if large {
        (LARGE_FIELD, LARGE_FIELDS_PER_LINE)
    } else {
        (SMALL_FIELD, FIELDS_PER_LINE)
    };
    let named = first.starts_with(|c: char| c.is_ascii_alphabetic());
    if !named && !first.is_empty() && !first.starts_with(['+', '*']) {
        return Err(wrong("a card's name or a continuation", &first));
    }
    if parts.len() > count + 1 {
        return Err(wrong("no more fields than a line has", text));
    }
    parts.resize(count + 1, String::new());
    let tag = parts.pop().unwrap_or_default();
    if let Some(long) = parts.iter().find(|part| part.chars().count() > width) {
        return Err(wrong(
            "a field of 8 characters, or of 16 with an asterisk",
            long,
        ));
    }
    let data = parts.into_iter().map(|text| Field { text, line: number });
    Ok(Line {
        number,
        first,
        data: data.collect(),
        large,
        tag: tag.trim_start_matches(['+', '*']).to_owned(),
    })
}

/// Replaces every tab by blanks up to the next multiple of eight columns.
fn expand_tabs(text: &str) -> String {
    let mut expanded = String::new();
    let mut column = 0;
    for c in text.chars() {
        if c == '\t' {
            let next = (column + 1_usize).next_multiple_of(SMALL_FIELD);
            expanded.extend(std::iter::repeat_n(' ', next - column));
            column = next;
        } else {
            expanded.push(c);
            column += 1;
        }
    }
    expanded
}
