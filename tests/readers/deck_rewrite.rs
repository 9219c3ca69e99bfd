//! A deck with other sizes: what changes in it, and that nothing else does.

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

#[test]
fn a_size_is_rewritten_in_its_field_and_nowhere_else() {
    let text = rewritten(
        ORIGINAL,
        &[
            (11, 1.5, 1.0),
            (12, 1.5, 1.0),
            (13, 1.5, 1.0),
            (14, 1.5, 1.0),
            (21, 2.0, 1.0),
        ],
    );
    let caps = "PROD    7       1         .25                           $ area, in2";
    let expected = ORIGINAL
        .replace(
            caps,
            "PROD    7       1           .375                        $ area, in2",
        )
        .replace(
            "               2            .032",
            "               2            .064",
        );
    assert_eq!(text, expected);
    let text = rewritten(ORIGINAL, &[(22, 0.5, 1.0), (31, 3.0, 1.0), (32, 1.25, 1.0)]);
    let expected = ORIGINAL
        .replace("PSHEAR,9,2,.04  $", "PSHEAR,9,2,.02  $")
        .replace("       5       1       .1", "       5       1       .3")
        .replace("*       .1\n", "*       .125\n");
    assert_eq!(text, expected);
}

#[test]
fn elements_that_need_other_sizes_get_properties_of_their_own() {
    let text = rewritten(ORIGINAL, &[(12, 2.0, 1.0), (13, 2.0, 1.0), (14, 4.0, 1.0)]);
    let new = only_in(&text, ORIGINAL);
    assert_eq!(
        new,
        [
            "CROD    12      10      2       3",
            "CROD    13      10      4       5",
            "CROD,14,11,5,6",
            "PROD    10      1       .5",
            "PROD    11      1       1."
        ]
    );
    assert_eq!(
        only_in(ORIGINAL, &text).len(),
        3,
        "the first property stays"
    );
    let lines = text.lines().collect_vec();
    let first = lines
        .iter()
        .position(|line| line.starts_with("PROD    7 "))
        .unwrap();
    assert!(
        lines[first + 1].starts_with("PROD    10") && lines[first + 2].starts_with("PROD    11")
    );
    // Where none keeps its size, the property follows the most.
    let text = rewritten(
        ORIGINAL,
        &[
            (11, 2.0, 1.0),
            (12, 3.0, 1.0),
            (13, 3.0, 1.0),
            (14, 4.0, 1.0),
        ],
    );
    let new = only_in(&text, ORIGINAL);
    assert_eq!(
        new.len(),
        5,
        "two connections, their properties and the first property: {new:?}"
    );
}

#[test]
fn a_number_too_long_for_its_field_takes_a_card_of_the_large_format() {
    let factor = 1.234_567_891;
    let changes = [11, 12, 13, 14, 22].map(|label| (label, factor, 1.0));
    let text = rewritten(ORIGINAL, &changes);
    let caps = "PROD*   7               1               .30864197275                    *Z1     $ area, in2\n*Z1\n";
    assert!(text.contains(caps), "{text}");
    assert!(
        text.contains(
            "PSHEAR* 9               2               .04938271564                    *Z2     $ a doubler\n*Z2\n"
        ),
        "{text}"
    );
    assert_eq!(elements(text.as_bytes()), with(ORIGINAL, &changes));
}

/// The mass of an element follows its size in a deck, so that another density makes up for it.
#[test]
fn a_new_density_takes_a_new_material() {
    let text = rewritten(
        ORIGINAL,
        &[
            (11, 2.0, 0.5),
            (12, 2.0, 0.5),
            (13, 2.0, 0.5),
            (14, 2.0, 0.5),
        ],
    );
    let new = only_in(&text, ORIGINAL);
    assert_eq!(
        new,
        [
            "PROD    7       3             .5                        $ area, in2",
            "MAT1    3       1.05+7          .33     1.3-4"
        ]
    );
    let text = rewritten(ORIGINAL, &[(31, 2.0, 1.0)]);
    assert_eq!(
        only_in(&text, ORIGINAL).len(),
        1,
        "no density, no new material"
    );
}

/// Numbers in NASTRAN's own form go along as they stand: those of eight characters on a card of the small format.
#[test]
fn a_new_material_has_the_other_numbers_as_they_were_written() {
    let with_modulus =
        |card: &str| ORIGINAL.replace("MAT1    1       1.05+7          .33     2.6-4", card);
    let new = |card: &str| {
        let deck = with_modulus(card);
        let text = rewritten(&deck, &[(31, 1.0, 0.5)]);
        assert_eq!(elements(text.as_bytes()), with(&deck, &[(31, 1.0, 0.5)]));
        only_in(&text, &deck)
            .into_iter()
            .filter(|line| line.starts_with("MAT1"))
            .collect_vec()
            .concat()
    };
    assert_eq!(
        new("MAT1,1,1.0500+7,,.33,2.6-4"),
        "MAT1    3       1.0500+7        .33     1.3-4"
    );
    let long = new("MAT1*   1               1.0500001+7                     .33\n*       2.6-4");
    assert_eq!(
        long,
        "MAT1*   3               1.0500001+7                     .33             *Z1"
    );
}

#[test]
fn nothing_to_change_gives_back_the_same_bytes() {
    for deck in [
        ORIGINAL,
        "\u{feff}CROD,1,1,1,2\r\nPROD,1,1,.5\r\nMAT1,1,1.,,.3\r\nGRID,1\r\nGRID,2\r\nPARAM,WTMASS,.00259",
    ] {
        assert_eq!(
            rewrite("deck", deck.as_bytes(), &elements(deck.as_bytes()), &[]).unwrap(),
            deck.as_bytes()
        );
        assert_eq!(
            rewrite("deck", deck.as_bytes(), &[], &[]).unwrap(),
            deck.as_bytes()
        );
    }
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
fn two_on_a_card_are_rewritten_one_by_one() {
    let deck = "GRID,1\nGRID,2\nGRID,3\nCTRMEM,1,30,1,2,3\nCTRMEM,2,31,1,2,3\nCROD    3       10      1       2       4       10      2       3\n\
        PTRMEM  30      1       .1      0.      31      1       .2\nPROD,10,1,.5\nMAT1,1,1.,,.3\n";
    let text = rewritten(deck, &[(2, 2.0, 1.0), (4, 2.0, 1.0)]);
    let connection = "CROD    3       10      1       2       4       32      2       3";
    let new = [
        connection,
        "PTRMEM  30      1       .1      0.      31      1       .4",
        "PROD    32      1       1.",
    ];
    assert_eq!(only_in(&text, deck), new);
    assert_eq!(
        elements(text.as_bytes()),
        with(deck, &[(2, 2.0, 1.0), (4, 2.0, 1.0)])
    );
    let long = rewritten(deck, &[(1, 1.0 + 1e-9, 1.0)]);
    let sizes = elements(long.as_bytes())
        .iter()
        .map(|element| element.size)
        .collect_vec();
    assert_eq!(sizes, [0.100_000_000_1, 0.2, 0.5, 0.5]);
    assert_eq!(only_in(&long, deck).len(), 2);
}

/// What a property says beside size and material goes along, and no more: behind it on a card stands another.
#[test]
fn a_property_that_is_divided_keeps_its_other_fields() {
    let deck = "GRID,1\nGRID,2\nGRID,3\nGRID,4\nCROD,1,10,1,2\nCROD,2,10,2,3\nPROD,10,1,.5,0.,.25,0.\nMAT1,1,1.,,.3\n\
                CSHEAR,3,30,1,2,3,4\nCSHEAR,4,30,1,2,3,4\nCSHEAR,5,31,1,2,3,4\nPSHEAR,30,1,.1,0.,31,1,.2,0.\n";
    let text = rewritten(deck, &[(2, 2.0, 1.0), (4, 2.0, 1.0)]);
    let new = only_in(&text, deck);
    assert!(
        new.contains(&"PROD    32      1       1.      0.      .25     0."),
        "{new:?}"
    );
    assert!(
        new.contains(&"PSHEAR  33      1       .2      0."),
        "{new:?}"
    );
    assert_eq!(
        (new.len(), elements(text.as_bytes())),
        (4, with(deck, &[(2, 2.0, 1.0), (4, 2.0, 1.0)]))
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
    let full = ORIGINAL.replace("PROD    7 ", "PROD,99999999,1,.25\nPROD    7 ");
    let error = rewrite(
        "deck",
        full.as_bytes(),
        &with(&full, &[(11, 2.0, 1.0)]),
        &[],
    )
    .expect_err("no number is free");
    assert!(
        matches!(error, FileError::Method(Error::Count { .. })),
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
