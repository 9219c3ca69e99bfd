//! The rooms of `src/`: each imports only from those above it, and `method` from none.

use crate::ledgers::files_below;
use std::fs;
use std::path::Path;

/// From the top down.
const ROOMS: [&str; 8] = [
    "method", "sparse", "weighted", "cases", "studies", "files", "present", "program",
];

/// The rooms that the code of a text names as `crate::room` or `corfem::room`; documentation may point anywhere.
fn rooms_named(text: &str) -> Vec<String> {
    let is_code = |line: &&str| !line.trim_start().starts_with("//");
    let text = text.lines().filter(is_code).collect::<Vec<_>>().join("\n");
    let mut named = Vec::new();
    for root in ["crate::", "corfem::"] {
        for (at, _) in text.match_indices(root) {
            let rest = &text[at + root.len()..];
            let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_');
            named.push(rest[..end.unwrap_or(rest.len())].to_owned());
        }
    }
    named
}

/// The tour, which is no room: it has no code that anything could import, and every room's documentation may point to it.
const TOUR: &str = "tour";

/// What a file of a room imports from rooms that are not above it.
fn imports_from_below(room: usize, text: &str) -> Vec<String> {
    let mut named = rooms_named(text);
    named.retain(|name| name != TOUR && !ROOMS[..=room].contains(&name.as_str()));
    named
}

#[test]
fn every_room_imports_only_from_rooms_above_it() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut count = 0;
    for (room, name) in ROOMS.iter().enumerate() {
        let mut files = files_below(&source.join(name));
        files.retain(|file| file.extension().is_some_and(|end| end == "rs"));
        for file in files {
            let text = fs::read_to_string(&file).expect("it reads");
            let below = imports_from_below(room, &text);
            assert!(below.is_empty(), "{}: {below:?}", file.display());
            count += 1;
        }
    }
    assert!(count > 60, "only {count} files were read");
}

#[test]
fn every_folder_of_the_source_is_a_room() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for entry in fs::read_dir(source).expect("it reads") {
        let path = entry.expect("an entry").path();
        let name = path
            .file_name()
            .expect("a name")
            .to_string_lossy()
            .into_owned();
        assert!(
            ROOMS.contains(&name.as_str())
                || ["chain.rs", "lib.rs", "main.rs", "tour.rs"].contains(&name.as_str()),
            "{name}"
        );
    }
}

#[test]
fn the_tour_is_documentation_alone() {
    let text = include_str!("../../src/tour.rs");
    for line in text.lines().map(str::trim) {
        let is_module = line.starts_with("pub mod chapter_") && line.ends_with('{');
        let is_document =
            line.starts_with("//!") || line.starts_with("#![doc = include_str!(\"../paper/tour/");
        assert!(
            line.is_empty() || line == "}" || is_module || is_document,
            "{line}"
        );
    }
}

#[test]
fn the_check_finds_an_import_from_below() {
    let text = "use crate::method::modes;\nuse crate::{present, cases};\nuse crate::cases::Case;";
    assert_eq!(imports_from_below(0, text), ["", "cases"]);
    assert_eq!(
        imports_from_below(3, "use crate::cases::Case; use corfem::method::modes;"),
        [""; 0]
    );
    assert_eq!(imports_from_below(0, "/// [`crate::cases`]"), [""; 0]);
}
