//! Places for numbers in a text, filled in from the goldens.
//!
//! A place is `{table|row|column|format}`, or `{golden|table|row|column|format}` where a golden holds several tables.
//! `*` stands for every row or column. A format is a number of decimals, after `both` with the published number behind it in
//! parentheses, after `published` that number alone, after `to` the least and the largest of what `*` stands for, after
//! `max` the largest magnitude, after `rms` the root mean square.

use crate::ledgers::files_below;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// A line of a golden in CSV.
#[derive(serde::Deserialize)]
pub struct Entry {
    table: String,
    row: String,
    column: String,
    computed: String,
    published: String,
}

/// The goldens in CSV by name.
pub type Goldens = BTreeMap<String, Vec<Entry>>;

/// Every golden in CSV.
pub fn goldens() -> Goldens {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/snapshots");
    let mut goldens = BTreeMap::new();
    let stored = Path::new(env!("CARGO_MANIFEST_DIR")).join("paper/readings.csv");
    for file in files_below(&folder).into_iter().chain([stored]) {
        let text = fs::read_to_string(&file).expect("it reads");
        let Some(start) = text.find("table,row,column,unit,computed,published\n") else {
            continue;
        };
        let rows = csv::Reader::from_reader(&text.as_bytes()[start..]).into_deserialize();
        let rows = rows.map(|row| row.unwrap_or_else(|what| panic!("{}: {what}", file.display())));
        let name = file.file_stem().expect("a name").to_string_lossy();
        goldens.insert(name.into_owned(), rows.collect());
    }
    goldens
}

/// The text of one place.
fn filled_in(place: &str, goldens: &Goldens) -> Result<String, String> {
    let parts: Vec<&str> = place.split('|').collect();
    let (golden, table, row, column, format) = match parts[..] {
        [table, row, column, format] => (table, table, row, column, format),
        [golden, table, row, column, format] => (golden, table, row, column, format),
        _ => return Err(format!("{place}: four or five parts")),
    };
    let golden = goldens
        .get(golden)
        .ok_or_else(|| format!("{place}: no golden {golden}"))?;
    let fits = |pattern: &str, name: &str| pattern == "*" || pattern == name;
    let found: Vec<_> = golden
        .iter()
        .filter(|entry| {
            entry.table == table && fits(row, &entry.row) && fits(column, &entry.column)
        })
        .collect();
    let digits = format.trim_start_matches(|c: char| !c.is_ascii_digit());
    let decimals: usize = digits.parse().map_err(|_| format!("{place}: decimals"))?;
    let number = |text: &str| {
        text.parse::<f64>()
            .map_err(|_| format!("{place}: {text} is no number"))
    };
    // A rounded zero has no sign.
    let rounded = |value: f64| {
        let text = format!("{value:.decimals$}");
        match text.strip_prefix('-') {
            Some(zero) if zero.chars().all(|c| "0.".contains(c)) => zero.to_owned(),
            _ => text,
        }
    };
    let computed: Vec<f64> = found
        .iter()
        .map(|entry| number(&entry.computed))
        .collect::<Result<_, _>>()?;
    let only = || match found[..] {
        [entry] => Ok(entry),
        _ => Err(format!("{place}: {} entries", found.len())),
    };
    if computed.is_empty() {
        return Err(format!("{place}: nothing"));
    }
    match format.strip_suffix(digits).unwrap_or_default() {
        "" => Ok(rounded(number(&only()?.computed)?)),
        "published" => Ok(rounded(number(&only()?.published)?)),
        "both" => {
            let entry = only()?;
            let (computed, published) = (number(&entry.computed)?, number(&entry.published)?);
            Ok(format!("{} ({})", rounded(computed), rounded(published)))
        }
        "to" => {
            let least = computed.iter().copied().fold(f64::INFINITY, f64::min);
            let largest = computed.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let (least, largest) = (rounded(least), rounded(largest));
            Ok(if least == largest {
                least
            } else {
                format!("{least} to {largest}")
            })
        }
        "max" => Ok(rounded(computed.iter().fold(0.0, |m, x| x.abs().max(m)))),
        "rms" => {
            let mean = computed.iter().map(|x| x * x).sum::<f64>() / computed.len() as f64;
            Ok(rounded(mean.sqrt()))
        }
        other => Err(format!("{place}: unknown format {other}")),
    }
}

/// A text with all its places filled in.
pub fn filled(template: &str, goldens: &Goldens) -> Result<String, String> {
    let mut out = String::new();
    let mut rest = template;
    while let Some((before, after)) = rest.split_once('{') {
        let (place, after) = after
            .split_once('}')
            .ok_or_else(|| format!("an open brace: {after}"))?;
        out.push_str(before);
        out.push_str(&filled_in(place, goldens)?);
        rest = after;
    }
    out.push_str(rest);
    Ok(out)
}
