//! The tables of the paper: of its cases, of fewer modes, and as published.

pub mod cases;
pub mod fewer_modes;
pub mod published;
pub mod stages;
pub mod unlimited;

use corfem::method::structure::ElementKind;
use corfem::present::table::Digits;
pub use corfem::present::table::{HERTZ, RMS_PERCENT};
use corfem::torque_box::published::PublishedTable;

const INCHES: Digits = Digits::Fixed(5);
const PERCENT: Digits = Digits::Fixed(1);
/// Errors under frequencies, with their digits.
const MODE_ERRORS: [(&str, Digits); 2] =
    [("frequency RMS", RMS_PERCENT), ("shape RMS", RMS_PERCENT)];

/// The misprints of a table in the paper, with rows and columns named as a reader sees them.
fn remarks(paper: Option<&PublishedTable>) -> Vec<String> {
    let words = |remark: &String| {
        remark
            .split(' ')
            .map(in_words)
            .collect::<Vec<_>>()
            .join(" ")
    };
    let remarks = paper.into_iter().flat_map(|table| &table.remarks);
    let sentence = |remark: &String| {
        let words = words(remark);
        let (kind, rest) = words.split_once(": ").unwrap_or(("misprint", &words));
        let kind = match kind {
            "inconsistent" => "Inconsistency",
            "borderline" => "Borderline rounding",
            _ => "Misprint",
        };
        format!("{kind} in the paper, {rest}")
    };
    remarks.map(sentence).collect()
}

/// A row or column of the published tables' files as a reader's words: `pass_1_percent` is the pass 1 error.
fn in_words(name: &str) -> String {
    if !name.contains('_') {
        return name.to_owned();
    }
    let word = |part: &str| {
        let (stem, end) = part.split_at(part.trim_end_matches([',', ':', '.']).len());
        let word = match stem {
            "percent" => "error",
            "in" => "gage",
            "seconds" => "time",
            "gvt" => "GVT",
            "hz" => "frequency",
            "rms" => "RMS",
            "fem" => "FEM",
            other => other,
        };
        format!("{word}{end}")
    };
    name.split('_').map(word).collect::<Vec<_>>().join(" ")
}

/// A sentence with the paper's tables that have these names: `table_3` is Table 3.
pub fn paper_tables<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let number = |name: &str| name.strip_prefix("table_")?.parse::<usize>().ok();
    let mut numbers: Vec<usize> = names.into_iter().filter_map(number).collect();
    numbers.sort_unstable();
    let numbers: Vec<String> = numbers.iter().map(usize::to_string).collect();
    format!(
        "Of the paper's tables, here are {}; corfem tables prints Table 1, computed anew, and the others as published, \
        with their CPU seconds.",
        numbers.join(", ")
    )
}

/// The letter that stands for a kind of element.
pub fn kind_letter(kind: ElementKind) -> &'static str {
    match kind {
        ElementKind::Rod => "R",
        ElementKind::ShearPanel => "S",
        ElementKind::Membrane => "M",
        ElementKind::Triangle => "T",
    }
}
