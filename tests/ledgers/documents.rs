//! The numbers of README.md and `paper/*.md` that the program computes, held against the goldens, which other tests hold
//! against the program.
//!
//! `documents.toml` lists tables and sentences with places for numbers. A table stands in its document between
//! `<!-- computed: NAME -->` and `<!-- end -->`; `CORFEM_DOCUMENTS=write cargo test documents` writes it anew. A sentence
//! has to stand in its document word for word, and is changed by hand. Numbers of other origin stand in tables marked
//! `measured:` (with machine and date) or `stored:` (with the file).
//!
//! A place is `{table|row|column|format}`, or `{golden|table|row|column|format}` where a golden holds several tables.
//! `*` stands for every row or column. A format is a number of decimals, after `both` with the published number behind it in
//! parentheses, after `published` that number alone, after `to` the least and the largest of what `*` stands for, after
//! `max` the largest magnitude, after `rms` the root mean square.

use crate::ledgers::files_below;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use toml::Table;

/// A line of a golden in CSV.
#[derive(serde::Deserialize)]
struct Entry {
    table: String,
    row: String,
    column: String,
    computed: String,
    published: String,
}

/// The goldens in CSV by name.
type Goldens = BTreeMap<String, Vec<Entry>>;

fn goldens() -> Goldens {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/snapshots");
    let mut goldens = BTreeMap::new();
    for file in files_below(&folder) {
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
fn filled(template: &str, goldens: &Goldens) -> Result<String, String> {
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

fn ledger() -> Table {
    include_str!("documents.toml").parse().expect("it reads")
}

fn entries(key: &str) -> Vec<(String, String)> {
    let ledger = ledger();
    let list = ledger[key].as_array().expect("a list");
    let string = |value: &toml::Value| value.as_str().expect("a string").to_owned();
    list.iter()
        .map(|entry| {
            let name = entry.get("name").unwrap_or_else(|| &entry["document"]);
            (string(name), string(&entry["text"]))
        })
        .collect()
}

/// README.md and the texts in `paper/`, by their path.
fn documents() -> BTreeMap<String, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = vec![root.join("README.md")];
    for entry in fs::read_dir(root.join("paper")).expect("it reads") {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|end| end == "md") {
            files.push(path);
        }
    }
    files
        .into_iter()
        .map(|file| {
            let name = file.strip_prefix(root).expect("below the root");
            let text = fs::read_to_string(&file).expect("it reads");
            (name.display().to_string(), text)
        })
        .collect()
}

/// A document with the blocks of one name replaced, and how many there are.
fn with_block(document: &str, name: &str, block: &str) -> (String, usize) {
    let (start, end) = (format!("<!-- computed: {name} -->\n"), "<!-- end -->");
    let mut pieces = document.split(&start);
    let mut out = pieces.next().unwrap_or_default().to_owned();
    let mut count = 0;
    for piece in pieces {
        let (_, after) = piece
            .split_once(end)
            .unwrap_or_else(|| panic!("{name} has no end"));
        out.push_str(&format!("{start}{}\n{end}{after}", block.trim()));
        count += 1;
    }
    (out, count)
}

#[test]
fn tables_in_documents_are_what_the_program_computes() {
    let goldens = goldens();
    let mut documents = documents();
    let before = documents.clone();
    for (name, template) in entries("table") {
        let block = filled(&template, &goldens).unwrap_or_else(|what| panic!("{name}: {what}"));
        let mut count = 0;
        for text in documents.values_mut() {
            let (now, found) = with_block(text, &name, &block);
            *text = now;
            count += found;
        }
        assert!(count > 0, "no document has the table {name}");
    }
    for (name, text) in documents {
        if text == before[&name] {
            continue;
        }
        if std::env::var("CORFEM_DOCUMENTS").is_ok_and(|value| value == "write") {
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(&name);
            fs::write(path, text).expect("it can be written");
        } else {
            panic!(
                "{name} is not what the goldens say; CORFEM_DOCUMENTS=write writes its tables anew"
            );
        }
    }
}

#[test]
fn sentences_in_documents_are_what_the_program_computes() {
    let goldens = goldens();
    let documents = documents();
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let wrong: Vec<String> = entries("sentence")
        .into_iter()
        .filter_map(|(document, template)| {
            let sentence =
                filled(&template, &goldens).unwrap_or_else(|what| panic!("{document}: {what}"));
            let said = words(&documents[&document]).contains(&words(&sentence));
            (!said).then(|| format!("{document} should say: {sentence}"))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The print is quoted there, not computed.
const QUOTATIONS: [&str; 2] = ["paper/errata.md", "paper/interpretation.md"];

#[test]
fn every_table_of_numbers_says_where_they_come_from() {
    for (name, text) in documents() {
        if QUOTATIONS.contains(&name.as_str()) {
            continue;
        }
        let mut origin = None;
        for line in text.lines() {
            if let Some(marker) = line.strip_prefix("<!-- ") {
                origin = ["computed: ", "measured: ", "stored: "]
                    .iter()
                    .find(|kind| marker.starts_with(**kind));
            }
            let has_decimals = line
                .as_bytes()
                .windows(3)
                .any(|w| w[0].is_ascii_digit() && w[1] == b'.' && w[2].is_ascii_digit());
            assert!(
                origin.is_some() || !line.starts_with('|') || !has_decimals,
                "{name}: {line}"
            );
        }
    }
}

#[test]
fn places_are_filled_in() {
    let csv = "table,row,column,unit,computed,published\nt,a,c,,-3.004,2.9\nt,b,c,,4,\n";
    let golden = csv::Reader::from_reader(csv.as_bytes()).into_deserialize();
    let golden = golden.map(|row| row.expect("a row")).collect();
    let goldens = BTreeMap::from([("t".to_owned(), golden)]);
    let text = |place: &str| filled(place, &goldens);
    assert_eq!(text("x {t|a|c|1} y").as_deref(), Ok("x -3.0 y"));
    assert_eq!(text("{t|t|a|c|both2}").as_deref(), Ok("-3.00 (2.90)"));
    assert_eq!(text("{t|a|c|published1}").as_deref(), Ok("2.9"));
    assert_eq!(text("{t|*|c|to0}").as_deref(), Ok("-3 to 4"));
    assert_eq!(text("{t|a|c|to0}").as_deref(), Ok("-3"));
    assert_eq!(text("{t|*|c|max1}").as_deref(), Ok("4.0"));
    assert_eq!(text("{t|*|c|rms2}").as_deref(), Ok("3.54"));
    for wrong in [
        "{t|*|c|1}",
        "{t|d|c|1}",
        "{u|a|c|1}",
        "{t|a|c|x}",
        "{t|b|c|both1}",
        "{t|a",
    ] {
        assert!(text(wrong).is_err(), "{wrong}");
    }
    let document = "a\n<!-- computed: n -->\nold\n<!-- end -->\nb";
    let (now, count) = with_block(document, "n", "new");
    assert_eq!(now, document.replace("old", "new"));
    assert_eq!(count, 1);
}
