//! The computed tables and sentences of README.md and `paper/*.md`: the texts of `tests/computed.toml`, filled from the goldens.

use crate::ledgers::{file, files};
use crate::prelude::*;

/// Computed and published number of every line of every golden in CSV, by `/golden/table/row/column`; and of what a user of SciPy would do
/// instead, by `/least_squares/subject/way/key/place`.
static ENTRIES: LazyLock<Vec<(String, [String; 2])>> = LazyLock::new(|| {
    let mut entries = Vec::new();
    for (name, text) in [
        files("golden/snapshots/", ".snap"),
        files("paper/readings.csv", ""),
    ]
    .concat()
    {
        let Some(start) = text.find("table,row,column,unit,computed,published\n") else {
            continue;
        };
        let golden = Path::new(name).file_stem().unwrap().display();
        for row in csv::Reader::from_reader(&text.as_bytes()[start..]).records() {
            let row = row.unwrap();
            let place = format!("/{golden}/{}/{}/{}", &row[0], &row[1], &row[2]);
            entries.push((place, [4, 5].map(|cell| row[cell].to_owned())));
        }
    }
    let answers: Value = serde_json::from_str(file("golden/least_squares.json")).unwrap();
    for (subject, ways) in answers.as_object().unwrap() {
        for (way, numbers) in ways.as_object().unwrap() {
            for (key, numbers) in numbers.as_object().unwrap() {
                let numbers = numbers.to_string();
                for (number, at) in numbers.trim_matches('"').split(' ').zip(1..) {
                    let place = format!("/least_squares/{subject}/{way}/{key}/{at}");
                    entries.push((place, [number.to_owned(), String::new()]));
                }
            }
        }
    }
    entries
});

/// The computed numbers of a place, or of all that begin and end as `START|END`.
pub fn computed_at(places: &str) -> BTreeMap<&'static str, f64> {
    let (start, end) = places.split_once('|').unwrap_or(("", places));
    let mut found = ENTRIES.iter().collect_vec();
    found.retain(|(name, _)| name.starts_with(start) && name.ends_with(end));
    assert!(!found.is_empty(), "{places}");
    found
        .into_iter()
        .map(|(name, [computed, _])| (&name[..], computed.parse().expect(name)))
        .collect()
}

/// A number of a place, written as it is asked for: its decimals, and behind them `p` if it is the published one, `m` its magnitude, `%` in
/// percent.
pub fn number(place: &str, how: &str) -> String {
    let (decimals, kind) = how.split_at(1);
    let write = |number: f64| {
        let text = format!("{number:.*}", decimals.parse().unwrap());
        // A rounded zero has no sign.
        match text.strip_prefix('-') {
            Some(zero) if zero.chars().all(|c| "0.".contains(c)) => zero.to_owned(),
            _ => text,
        }
    };
    if let Some((what, range)) = place.split_once(" /") {
        let numbers = computed_at(&format!("/{range}")).into_values();
        let numbers = numbers.collect_vec();
        let count = numbers.len() as f64;
        let least = numbers.iter().copied().fold(f64::INFINITY, f64::min);
        let most = numbers.iter().map(|number| number.abs()).largest();
        return match what {
            "least" => write(least),
            "most" => write(most),
            "range" => write(most - least),
            "rms" => write((numbers.iter().map(|x| x * x).sum::<f64>() / count).sqrt()),
            "count" => write(count),
            _ if write(least) == write(most) => write(least),
            _ => format!("{} to {}", write(least), write(most)),
        };
    }
    let value = |place: &str| -> f64 {
        let end = format!("/{place}");
        let found = ENTRIES
            .iter()
            .filter(|(name, _)| name.ends_with(&end))
            .collect_vec();
        let [(_, [computed, published])] = found[..] else {
            panic!("{place}: {} entries", found.len())
        };
        let number = if kind == "p" { published } else { computed };
        number.parse().expect(place)
    };
    let found = match place.split_once(" over ") {
        Some((above, below)) => value(above) / value(below),
        None => value(place),
    };
    write(match kind {
        "m" => found.abs(),
        "%" => 100.0 * found,
        _ => found,
    })
}

/// A text with its numbers.
fn filled(text: &str) -> String {
    let mut parts = text.split('{');
    let mut filled = parts.next().unwrap().to_owned();
    for part in parts {
        let (cell, rest) = part.split_once('}').unwrap();
        let (place, how) = cell.rsplit_once(':').unwrap();
        filled += &(number(place, how) + rest);
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

/// Every computed table by its name.
pub fn tables() -> BTreeMap<String, String> {
    let tables = TEXTS.tables.iter();
    tables
        .map(|(name, text)| (name.clone(), filled(text)))
        .collect()
}

/// Sentences with computed numbers, beside the document in which each stands word for word.
pub fn sentences() -> Vec<(&'static str, String)> {
    let sentences = TEXTS.sentences.iter();
    sentences
        .map(|[document, text]| (&document[..], filled(text)))
        .collect()
}
