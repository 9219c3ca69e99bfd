//! A deck with other sizes: what changes in it, and that nothing else does.

use crate::common::cases::hold;
use crate::prelude::*;
use crate::readers::matrices::{assert_written, table};

const ORIGINAL: &str = include_str!("../../golden/formats/original.bdf");

pub fn elements(deck: &[u8]) -> Vec<Element> {
    deck::read("deck", deck, &[]).unwrap().model.elements
}

/// The elements of a deck, some with another size and another density.
fn with(deck: &str, changes: &[(usize, f64, f64)]) -> Vec<Element> {
    let mut elements = elements(deck.as_bytes());
    for &(label, size, density) in changes {
        let element = elements
            .iter_mut()
            .find(|element| element.label == label)
            .unwrap();
        element.size = nearest_in_field(element.size * size);
        element.material.density = nearest_in_field(element.material.density * density);
    }
    elements
}

fn rewritten(deck: &str, changes: &[(usize, f64, f64)]) -> String {
    let text = rewrite("deck", deck.as_bytes(), &with(deck, changes), &[]).unwrap();
    String::from_utf8(text).unwrap()
}

/// Lines of one text that the other has not.
fn only_in<'a>(text: &'a str, other: &str) -> Vec<&'a str> {
    let known: BTreeSet<&str> = other.lines().collect();
    text.lines().filter(|line| !known.contains(line)).collect()
}

/// A deck with other sizes and densities of some elements, by a number and one or two factors each.
fn of_rewrite(text: &str, changes: &[String]) -> Result<Value, String> {
    let changes = changes.iter().map(|change| {
        let numbers = change
            .split(' ')
            .map(|number| number.parse::<f64>().unwrap());
        let numbers = numbers.collect_vec();
        (
            numbers[0] as usize,
            numbers[1],
            *numbers.get(2).unwrap_or(&1.0),
        )
    });
    let wanted = with(text, &changes.collect_vec());
    let found =
        rewrite("deck", text.as_bytes(), &wanted, &[]).map_err(|error| error.to_string())?;
    let (found, read) = (String::from_utf8(found.clone()).unwrap(), elements(&found));
    let new = only_in(&found, text);
    let materials = new.iter().filter(|line| line.starts_with("MAT1"));
    Ok(json!({
        "materials": materials.collect_vec(),
        "new": new,
        "old": only_in(text, &found),
        "sizes": read.iter().map(|element| element.size).collect_vec(),
        "is_right": read == wanted,
    }))
}

#[test]
fn decks_are_rewritten_as_listed() {
    let original = [("original", ORIGINAL.to_owned())];
    hold(
        include_str!("files/rewrites.toml"),
        &original,
        ROUND_OFF,
        of_rewrite,
    );
}

#[test]
fn line_ends_encoding_and_trailing_text_stay() {
    let deck =
        b"$ F\xfcr Fl\xfcgel\r\nGRID,1\r\nGRID,2,,1.\r\nCROD\t1\t1\t1\t2\r\nCROD    2       1       1       2\r\n\
        MAT1,1,1.,,.3,.5\r\nPROD    1       1       .5      $ d\xfcnn\r\nPARAM,WTMASS,.25\r\nENDDATA\r\nr\xe9sum\xe9";
    let mut wanted = elements(deck);
    wanted[0].size = 0.75;
    wanted[0].material.density *= 0.5;
    let text = rewrite("deck", deck, &wanted, &[]).unwrap();
    let expected = b"$ F\xfcr Fl\xfcgel\r\nGRID,1\r\nGRID,2,,1.\r\nCROD    1       2       1       2\r\nCROD    2       1       1       2\r\n\
        MAT1,1,1.,,.3,.5\r\nMAT1    2       1.              .3      .25\r\nPROD    1       1       .5      $ d\xfcnn\r\n\
        PROD    2       2       .75\r\nPARAM,WTMASS,.25\r\nENDDATA\r\nr\xe9sum\xe9";
    assert_eq!(
        String::from_utf8_lossy(&text),
        String::from_utf8_lossy(expected)
    );
    assert_eq!(text, expected);
    assert_eq!(elements(&text), wanted);
    let marked =
        [b"\xef\xbb\xbfPROD,1,1,.5\nGRID,1\nGRID,2\nMAT1,1,1.,,.3\nCROD,1,1,1,2".as_slice()]
            .concat();
    let mut wanted = elements(&marked);
    wanted[0].size = 0.25;
    let text = rewrite("deck", &marked, &wanted, &[]).unwrap();
    assert_eq!(
        text,
        b"\xef\xbb\xbfPROD,1,1,.25\nGRID,1\nGRID,2\nMAT1,1,1.,,.3\nCROD,1,1,1,2"
    );
}

#[test]
fn what_no_deck_can_say_is_refused() {
    let mut wanted = elements(ORIGINAL.as_bytes());
    wanted[0].label = 99;
    let error = rewrite("deck", ORIGINAL.as_bytes(), &wanted, &[]).expect_err("no element 99");
    assert!(
        matches!(
            error,
            FileError::Method(Error::Unknown {
                what: "element",
                label: 99,
                ..
            })
        ),
        "{error}"
    );
    wanted[0].label = 11;
    wanted[0].size = f64::INFINITY;
    let error = rewrite("deck", ORIGINAL.as_bytes(), &wanted, &[]).expect_err("no number");
    assert!(
        matches!(
            error,
            FileError::Method(Error::Value {
                expected: "a finite number",
                ..
            })
        ),
        "{error}"
    );
    wanted = elements(ORIGINAL.as_bytes());
    wanted[7].size = f64::NAN;
    let error = rewrite("deck", ORIGINAL.as_bytes(), &wanted, &[]).expect_err("no number");
    assert!(
        matches!(&error, FileError::DeckField { card, field: 6, .. } if card == "CONROD"),
        "{error}"
    );
}

/// What the crate writes, and what pyNastran reads from it.
#[test]
fn the_owners_programs_read_a_rewritten_deck() {
    let changes = [
        (12, 1.1, 1.0 / 1.1),
        (14, 1.234_567_891, 1.0 / 1.234_567_891),
        (21, 1.3, 1.0),
        (22, 0.7, 1.0),
        (31, 0.9, 1.0),
    ];
    let text = rewritten(ORIGINAL, &changes);
    assert_written("rewritten.bdf", text.as_bytes());
    let stored = table("read_back_elements.csv");
    for (file, expected) in [
        ("original.bdf", elements(ORIGINAL.as_bytes())),
        ("rewritten.bdf", elements(text.as_bytes())),
    ] {
        let read = stored.iter().filter(|line| line[0] == file).map(|line| {
            let number = |text: &str| text.parse::<f64>().unwrap();
            (line[1].parse().unwrap(), number(&line[2]), number(&line[3]))
        });
        let expected = expected
            .iter()
            .map(|element| (element.label, element.size, element.material.density));
        assert_eq!(read.collect_vec(), expected.collect_vec(), "{file}");
    }
}

#[test]
fn a_rewritten_deck_keeps_carriage_returns_as_ends_of_lines() {
    let [deck, other] = ["original", "rewritten"].map(|name| {
        let path = format!("{}/golden/formats/{name}.bdf", env!("CARGO_MANIFEST_DIR"));
        fs::read(path).unwrap()
    });
    let other = deck::read("other", &other, &[]).unwrap().model;
    let write = |bytes: &[u8]| {
        let written = deck::rewrite("deck", bytes, &other.elements, &other.masses);
        String::from_utf8(written.unwrap()).unwrap()
    };
    let old = String::from_utf8(deck.clone()).unwrap().replace('\n', "\r");
    let expected = write(&deck);
    assert_ne!(expected.as_bytes(), deck);
    assert_eq!(write(old.as_bytes()), expected.replace('\n', "\r"));
}
