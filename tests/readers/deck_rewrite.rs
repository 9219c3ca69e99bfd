//! A deck with other sizes: what changes in it, and that nothing else does.

use crate::common::cases::hold;
use crate::prelude::*;
use crate::readers::matrices::{assert_written, table};

const ORIGINAL: &str = include_str!("../../golden/formats/original.bdf");

pub fn elements(deck: &[u8]) -> Vec<Element> {
    deck::read("deck", deck, &[]).unwrap().model.elements
}

/// Factors on the size and the density of elements, by number.
pub type Factors = BTreeMap<usize, [f64; 2]>;

/// A deck with these factors on its elements: what they then say is theirs times the factors, to a millionth.
pub fn rewritten(deck: &[u8], factors: &Factors) -> Result<Vec<u8>, FileError> {
    let written = rewrite("deck", deck, factors, &BTreeMap::new())?;
    let read = elements(&written);
    assert_eq!(read.len(), elements(deck).len());
    for (first, read) in elements(deck).iter().zip(&read) {
        let [size, density] = *factors.get(&first.label).unwrap_or(&[1.0; 2]);
        let mut wanted = read.clone();
        for (own, of, factor) in [
            (&mut wanted.size, first.size, size),
            (
                &mut wanted.material.density,
                first.material.density,
                density,
            ),
        ] {
            assert!(
                (*own - of * factor).abs() <= WRITTEN * *own,
                "{own} {of} {factor}"
            );
            *own = of;
        }
        assert_eq!(&wanted, first);
    }
    Ok(written)
}

/// Lines of one text that the other has not.
fn only_in<'a>(text: &'a str, other: &str) -> Vec<&'a str> {
    let known: BTreeSet<&str> = other.lines().collect();
    text.lines().filter(|line| !known.contains(line)).collect()
}

/// A deck with other sizes and densities of some elements, by a number and one or two factors each.
fn of_rewrite(text: &str, changes: &[String]) -> Result<Value, String> {
    let factors = changes.iter().map(|change| {
        let numbers = change.split(' ').map(|own| own.parse::<f64>().unwrap());
        let numbers = numbers.collect_vec();
        let density = *numbers.get(2).unwrap_or(&1.0);
        (numbers[0] as usize, [numbers[1], density])
    });
    let found = rewritten(text.as_bytes(), &factors.collect());
    let found = String::from_utf8(found.map_err(|error| error.to_string())?).unwrap();
    let new = only_in(&found, text);
    let materials = new.iter().filter(|line| line.starts_with("MAT1"));
    let sizes = elements(found.as_bytes());
    Ok(json!({
        "materials": materials.collect_vec(),
        "new": new,
        "old": only_in(text, &found),
        "sizes": sizes.iter().map(|element| element.size).collect_vec(),
        "is_right": true,
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
    let text = rewritten(deck, &Factors::from([(1, [1.5, 0.5])])).unwrap();
    let expected = b"$ F\xfcr Fl\xfcgel\r\nGRID,1\r\nGRID,2,,1.\r\nCROD    1       3       1       2\r\nCROD    2       1       1       2\r\n\
        MAT1    2       1.              .3      .25\r\nMAT1,1,1.,,.3,.5\r\nPROD    3       2       .75\r\n\
        PROD    1       1       .5      $ d\xfcnn\r\nPARAM,WTMASS,.25\r\nENDDATA\r\nr\xe9sum\xe9";
    assert_eq!(text, expected);
    let marked =
        [b"\xef\xbb\xbfPROD,1,1,.5\nGRID,1\nGRID,2\nMAT1,1,1.,,.3\nCROD,1,1,1,2".as_slice()]
            .concat();
    let text = rewritten(&marked, &Factors::from([(1, [0.5, 1.0])])).unwrap();
    assert_eq!(
        text,
        b"\xef\xbb\xbfPROD    1       1       .25\nGRID,1\nGRID,2\nMAT1,1,1.,,.3\nCROD,1,1,1,2"
    );
}

#[test]
fn what_no_deck_can_say_is_refused() {
    for (label, factor) in [(11, f64::INFINITY), (31, f64::NAN)] {
        let factors = Factors::from([(label, [factor, 1.0])]);
        let refused = said(rewrite(
            "deck",
            ORIGINAL.as_bytes(),
            &factors,
            &BTreeMap::new(),
        ));
        assert!(refused.ends_with("it must be a finite number"), "{refused}");
    }
}

/// What the crate writes, and what pyNastran reads from it.
#[test]
fn the_owners_programs_read_a_rewritten_deck() {
    let changes = [
        (12, [1.1, 1.0 / 1.1]),
        (14, [1.234_567_891, 1.0 / 1.234_567_891]),
        (21, [1.3, 1.0]),
        (22, [0.7, 1.0]),
        (31, [0.9, 1.0]),
    ];
    let text = rewritten(ORIGINAL.as_bytes(), &changes.into()).unwrap();
    assert_written("rewritten.bdf", &text);
    let stored = table("read_back_elements.csv");
    for (file, expected) in [
        ("original.bdf", elements(ORIGINAL.as_bytes())),
        ("rewritten.bdf", elements(&text)),
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
    let write = |text: &str| {
        let written = rewritten(text.as_bytes(), &Factors::from([(12, [1.1, 0.7])]));
        String::from_utf8(written.unwrap()).unwrap()
    };
    let expected = write(ORIGINAL);
    assert_ne!(expected, ORIGINAL);
    assert_eq!(
        write(&ORIGINAL.replace('\n', "\r")),
        expected.replace('\n', "\r")
    );
}
