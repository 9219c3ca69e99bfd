//! The computed tables and sentences of README.md and `paper/*.md`: the texts of `tests/computed.toml`, filled from the goldens.

use crate::evidence::coverage::SEEDS;
use crate::ledgers::{alternative, files_below};
use crate::prelude::*;

/// A line of a golden in CSV.
#[derive(serde::Deserialize)]
struct Entry {
    table: String,
    row: String,
    column: String,
    computed: String,
    published: String,
}

/// Every line of every golden in CSV, by `/golden/table/row/column`.
static ENTRIES: LazyLock<Vec<(String, Entry)>> = LazyLock::new(|| {
    let mut files = files_below(&in_root("golden/snapshots"));
    files.push(in_root("paper/readings.csv"));
    let mut entries = Vec::new();
    for file in files {
        let text = fs::read_to_string(&file).unwrap();
        let Some(start) = text.find("table,row,column,unit,computed,published\n") else {
            continue;
        };
        let golden = file.file_stem().unwrap().to_string_lossy();
        let lines = csv::Reader::from_reader(&text.as_bytes()[start..]).into_deserialize();
        entries.extend(lines.map(|entry| {
            let entry: Entry = entry.unwrap_or_else(|what| panic!("{}: {what}", file.display()));
            let place = format!("/{golden}/{}/{}/{}", entry.table, entry.row, entry.column);
            (place, entry)
        }));
    }
    entries
});

/// The one line of a place.
fn entry(place: &str) -> &'static Entry {
    let end = format!("/{place}");
    let mut found = ENTRIES.iter().filter(|(name, _)| name.ends_with(&end));
    match (found.next(), found.next()) {
        (Some((_, entry)), None) => entry,
        (found, _) => panic!(
            "{place}: {} entries",
            if found.is_some() { "two" } else { "no" }
        ),
    }
}

/// The computed numbers of all places that begin in one way and end in another.
fn numbers(start: &str, end: &str) -> BTreeMap<&'static str, f64> {
    let found = ENTRIES
        .iter()
        .filter(|(name, _)| name.starts_with(start) && name.ends_with(end));
    let numbers: BTreeMap<_, _> = found
        .map(|(name, entry)| (&name[..], entry.computed.parse().expect(name)))
        .collect();
    assert!(!numbers.is_empty(), "{start}…{end}");
    numbers
}

fn all(start: &str, end: &str) -> Vec<f64> {
    numbers(start, end).into_values().collect()
}

/// Those of a place, or of all that begin and end as `START|END`.
pub fn computed_at(places: &str) -> BTreeMap<&'static str, f64> {
    let (start, end) = places.split_once('|').unwrap_or(("", places));
    numbers(start, end)
}

fn rounded(number: f64, decimals: usize) -> String {
    let text = format!("{number:.decimals$}");
    // A rounded zero has no sign.
    match text.strip_prefix('-') {
        Some(zero) if zero.chars().all(|c| "0.".contains(c)) => zero.to_owned(),
        _ => text,
    }
}

fn least(numbers: &[f64]) -> f64 {
    numbers.iter().copied().fold(f64::INFINITY, f64::min)
}

fn most(numbers: &[f64]) -> f64 {
    numbers.iter().map(|number| number.abs()).largest()
}

/// A computed number of a golden.
pub fn computed(table: &str, row: &str, column: &str, decimals: usize) -> String {
    number(&format!("{table}/{row}/{column}"), &decimals.to_string())
}

/// A number of a place, written as it is asked for.
pub fn number(place: &str, how: &str) -> String {
    let decimals = how[..1].parse().unwrap();
    let write = |number: f64| rounded(number, decimals);
    let Some((what, range)) = place.split_once(" /") else {
        let entry = entry(place);
        return match &how[1..] {
            "p" => write(entry.published.parse().unwrap()),
            "m" => write(entry.computed.parse::<f64>().unwrap().abs()),
            _ => write(entry.computed.parse().unwrap()),
        };
    };
    let (start, end) = range.split_once('|').unwrap();
    let numbers = all(&format!("/{start}"), end);
    let count = numbers.len() as f64;
    let ends = [least(&numbers), most(&numbers)].map(write);
    match what {
        "least" => ends[0].clone(),
        "most" => ends[1].clone(),
        "rms" => write((numbers.iter().map(|x| x * x).sum::<f64>() / count).sqrt()),
        "count" => write(count),
        _ if ends[0] == ends[1] => ends[0].clone(),
        _ => ends.join(" to "),
    }
}

/// Numbers of sentences that are made of several.
fn named() -> BTreeMap<String, String> {
    let number = |place: &str| number(place, "6").parse::<f64>().unwrap();
    let mut named = BTreeMap::from([("tests".to_owned(), SEEDS.count().to_string())]);
    let mut put = |name: &str, value: f64, decimals| {
        named.insert(name.to_owned(), rounded(value, decimals));
    };
    let of = |when: &str| {
        let place = |panel| format!("case_2_next_step/{panel}/Error {when}");
        ["12", "13", "14"].map(|panel| number(&place(panel)))
    };
    put("panels_least", least(&of("at the end")), 0);
    put("panels_most", most(&of("at the end")), 0);
    put("panels_after", most(&of("after the step")).ceil(), 0);
    // Of weighted steps over the paper's rule.
    for (name, column, unit, decimals) in [
        ("steps", "Steps", 100.0, 0),
        ("analyses", "Analyses", 1.0, 2),
    ] {
        let ratio = |case: &str| {
            let of = |rule: &str| number(&format!("rules/{case}, {rule}/{column}"));
            unit * of("weighted") / of("paper's rule")
        };
        let ratios = ["Case 1", "Case 2", "Case 3", "Delta wing"].map(ratio);
        put(&format!("{name}_least"), least(&ratios), decimals);
        put(&format!("{name}_most"), most(&ratios), decimals);
    }
    // The widest range of a gage RMS over the numbers of analysis modes.
    for of in ["shear", "membrane"] {
        let range = |modes: usize| {
            let numbers = all(&format!("/truncation/truncation_{of}/{modes}/"), "");
            most(&numbers) - least(&numbers)
        };
        let widest = (1..=9).max_by(|one, other| range(*one).total_cmp(&range(*other)));
        put(&format!("widest_{of}"), range(widest.unwrap()), 1);
        put(&format!("widest_{of}_at"), widest.unwrap() as f64, 0);
    }
    named
}

/// A text with its numbers.
fn filled(text: &str) -> String {
    let mut parts = text.split('{');
    let mut filled = parts.next().unwrap().to_owned();
    for part in parts {
        let (place, rest) = part.split_once('}').unwrap();
        filled += &match place.rsplit_once(':') {
            Some((place, how)) => number(place, how),
            None => named()[place].clone(),
        };
        filled += rest;
    }
    filled
}

#[derive(Deserialize)]
struct Texts {
    sentences: Vec<[String; 2]>,
    tables: BTreeMap<String, String>,
}

static TEXTS: LazyLock<Texts> =
    LazyLock::new(|| toml::from_str(include_str!("../computed.toml")).unwrap());

/// A table in Markdown: its head, and rows of a label and the cells that belong to what stands beside the label.
pub fn table<L: Display, K>(
    head: &str,
    rows: impl IntoIterator<Item = (L, K)>,
    cells: impl Fn(K) -> Vec<String>,
) -> String {
    let rule = "---|".repeat(head.split(" | ").count());
    let rows = rows
        .into_iter()
        .map(|(label, key)| format!("| {label} | {} |\n", cells(key).join(" | ")));
    format!("| {head} |\n|{rule}\n{}", rows.collect::<String>())
}

/// Every computed table by its name.
pub fn tables() -> BTreeMap<String, String> {
    let of_texts = TEXTS
        .tables
        .iter()
        .map(|(name, text)| (name.clone(), filled(text)));
    let least_squares = ("least_squares".to_owned(), alternative::least_squares());
    of_texts.chain([least_squares]).collect()
}

/// Sentences with computed numbers, beside the document in which each stands word for word.
pub fn sentences() -> Vec<(&'static str, String)> {
    let of_texts = TEXTS
        .sentences
        .iter()
        .map(|[name, text]| (&name[..], filled(text)));
    let tailplane = ("paper/cost.md", alternative::tailplane());
    of_texts.chain([tailplane]).collect()
}
