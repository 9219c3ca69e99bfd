//! The three readers of files, decks, matrices and tests: they say the same whatever ends a line, whole or damaged, and cut off anywhere
//! they answer.
//!
//! `CORFEM_CALLS=100000 cargo test --release damaged_files_say_the_same` makes so many calls of every file.

use super::readers_survive::asked;
use crate::prelude::*;

/// What a reader says of a file, its error among it.
type Reader = fn(&[u8]) -> Result<String, String>;

fn of_deck(bytes: &[u8]) -> Result<String, String> {
    let found = deck::read("file", bytes, &[]);
    found
        .map(|own| format!("{own:?}"))
        .map_err(|error| error.to_string())
}

fn of_matrix(bytes: &[u8]) -> Result<String, String> {
    // Of a file with several, one that it has.
    let named = |name| matrices::read("file", bytes, name);
    let names = ["KAA", "KAAX", "T"].into_iter();
    let found = named(None).or_else(|error| {
        let mut found = names.filter_map(|name| named(Some(name)).ok());
        found.next().ok_or(error)
    });
    found
        .map(|own| format!("{own:?}"))
        .map_err(|error| error.to_string())
}

fn of_test(bytes: &[u8]) -> Result<String, String> {
    let found = test_data::read("file", bytes);
    found
        .map(|own| format!("{own:?}"))
        .map_err(|error| error.to_string())
}

macro_rules! files {
    ($($reader:ident: $($name:literal)*;)*) => {
        [$($(($name, include_bytes!(concat!("../../", $name)).as_slice(), $reader as Reader)),*),*]
    };
}

/// Files of this repository, most of them by other programs.
const FILES: [(&str, &[u8], Reader); 18] = files! {
    of_deck: "golden/formats/original.bdf" "golden/formats/rewritten.bdf" "tests/jobs/box/model.bdf" "golden/nastran95/decks/box_case_1_gvt.inp";
    of_matrix: "golden/formats/symmetric.mtx" "golden/formats/general_array.mtx" "golden/formats/symmetric_array.mtx" "golden/formats/small.dmig"
        "golden/formats/large.dmig" "golden/formats/dense.op4" "golden/formats/sparse.op4" "golden/formats/bigmat.op4";
    of_test: "golden/formats/universal_real.unv" "golden/formats/universal_complex.unv" "golden/formats/universal_axes.unv"
        "golden/formats/shapes.unv" "tests/jobs/building/test.csv" "tests/jobs/wing/test.unv";
};

/// The bytes with other ends of lines.
fn ended(bytes: &[u8], end: &[u8]) -> Vec<u8> {
    let lines = bytes.split(|byte| *byte == b'\n').collect_vec();
    lines.join(end)
}

/// Asserts that ends of lines change nothing that a reader says.
fn check(name: &str, bytes: &[u8], read: Reader) -> Result<String, String> {
    let said = read(bytes);
    let open = bytes.strip_suffix(b"\n").unwrap_or(bytes).to_vec();
    for (end, other) in [
        ("CR LF", ended(bytes, b"\r\n")),
        ("CR", ended(bytes, b"\r")),
        ("no last end", open),
    ] {
        let others = read(&other);
        // Damage may leave a last number as one that the end of the file cut.
        let is_cut = others
            .as_ref()
            .is_err_and(|own| own.contains("ends inside"));
        let is_same = others == said || end == "no last end" && is_cut;
        assert!(is_same, "{name} with {end}: {said:?}, {others:?}");
    }
    said
}

#[test]
fn ends_of_lines_change_nothing() {
    for (name, bytes, read) in FILES {
        assert!(!bytes.contains(&b'\r'), "{name}");
        let said = check(name, bytes, read);
        assert!(said.is_ok(), "{name}: {said:?}");
    }
}

#[test]
fn damaged_files_say_the_same_whatever_ends_their_lines() {
    let calls = asked("CORFEM_CALLS", 60);
    for (name, bytes, read) in FILES {
        let mut refused = 0;
        for seed in 0..calls {
            let mut damaged = Draws(seed).damaged(bytes);
            damaged.retain(|byte| *byte != b'\r');
            // Bytes that say how wide a character is are no text of one byte each.
            if !damaged.starts_with(&[0xff]) && !damaged.starts_with(&[0xfe]) {
                refused += usize::from(check(name, &damaged, read).is_err());
            }
        }
        assert!(refused > 0, "{name}: damage is noticed");
    }
}

#[test]
fn files_cut_off_anywhere_are_answered() {
    const SMALL: usize = 3000;
    for (name, bytes, read) in FILES {
        let all = 0..bytes.len().min(SMALL);
        for end in all {
            let answer = catch_unwind(AssertUnwindSafe(|| read(&bytes[..end])));
            assert!(answer.is_ok(), "{name} cut off behind byte {end}");
        }
    }
}
