//! The rooms of `src/`: each imports only from those before it, and no two files import each other.

use crate::ledgers::files_below;
use crate::prelude::*;

/// In order.
const ROOMS: [&str; 8] = [
    "method",
    "sparse",
    "weighted",
    "torque_box",
    "files",
    "job",
    "present",
    "program",
];

/// Files beside the rooms.
const FILES: [&str; 4] = ["chain", "lib", "main", "tour"];

/// Pairs of files that still import each other: none may join them, and one that no longer does leaves the list.
const CIRCLES: [[&str; 2]; 0] = [];

/// The paths that a file's `use` lines name, without those that it only hands on.
fn imports(text: &str) -> Vec<String> {
    let mut paths = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if let Some(start) = line.trim_start().strip_prefix("use ") {
            let mut statement = start.to_owned();
            while !statement.ends_with(';') {
                statement += lines.next().unwrap().trim();
            }
            expand("", &statement.replace([' ', ';'], ""), &mut paths);
        }
    }
    paths
}

/// Every path of a tree such as `a::{b, c::{d, e}}`.
fn expand(before: &str, tree: &str, paths: &mut Vec<String>) {
    let Some((head, rest)) = tree.split_once('{') else {
        return paths.push(format!("{before}{tree}"));
    };
    let (mut depth, mut start) = (0, 0);
    for (at, character) in rest.char_indices() {
        match character {
            '{' => depth += 1,
            ',' | '}' if depth == 0 => {
                if start < at {
                    expand(&format!("{before}{head}"), &rest[start..at], paths);
                }
                start = at + 1;
            }
            '}' => depth -= 1,
            _ => (),
        }
    }
}

/// The absolute form of a path in a module such as `method::model`.
fn absolute(module: &str, path: &str) -> String {
    let mut place = module.split("::").collect_vec();
    let mut rest = path;
    if let Some(path) = rest.strip_prefix("crate::") {
        return path.to_owned();
    }
    while let Some(path) = rest.strip_prefix("super::") {
        place.pop();
        rest = path;
    }
    place.push(rest);
    place.join("::")
}

/// The paths that every file of `src/` imports, in absolute form, by the file's module.
fn modules() -> BTreeMap<String, Vec<String>> {
    let source = in_root("src");
    let mut modules = BTreeMap::new();
    for file in files_below(&source) {
        let path = file.strip_prefix(&source).unwrap().with_extension("");
        let module = path.to_string_lossy().replace('/', "::");
        let module = module.trim_end_matches("::mod").to_owned();
        if file.extension().is_some_and(|end| end == "rs") {
            let paths = imports(&fs::read_to_string(file).unwrap());
            let paths = paths.iter().map(|path| absolute(&module, path)).collect();
            modules.insert(module, paths);
        }
    }
    modules
}

#[test]
fn every_room_imports_only_from_rooms_before_it() {
    let room = |path: &str| {
        let name = path.split("::").next();
        ROOMS.iter().position(|room| Some(*room) == name)
    };
    for (module, imports) in modules() {
        let Some(here) = room(&module) else {
            assert!(FILES.contains(&&*module), "{module} is in no room");
            continue;
        };
        for import in imports {
            assert!(
                room(&import).is_none_or(|there| there <= here),
                "{module} imports {import}"
            );
        }
    }
}

#[test]
fn no_two_files_import_each_other() {
    let modules = modules();
    let is_part = |module: &str, path: &str| {
        path.strip_prefix(module)
            .is_some_and(|rest| rest.starts_with("::"))
    };
    // The file in which a path ends: that of its longest part that is a module.
    let file = |path: &String| {
        let parts = modules.keys().filter(|module| is_part(module, path));
        parts.max_by_key(|module| module.len())
    };
    let imports =
        |module: &str, other: &String| modules[module].iter().any(|path| file(path) == Some(other));
    let mut circles = Vec::new();
    for (one, paths) in &modules {
        for other in paths.iter().filter_map(file) {
            // A folder's own file hands on what its parts hold, and they share what it has.
            let is_new = !is_part(one, other) && !circles.contains(&[one, other]);
            if one < other && imports(other, one) && is_new {
                circles.push([one, other]);
            }
        }
    }
    assert_eq!(circles, CIRCLES);
}

#[test]
fn the_tour_is_documentation_alone() {
    let text = include_str!("../../src/tour.rs");
    for line in text.lines().map(str::trim) {
        let is_module = line.starts_with("pub mod chapter_") && line.ends_with('{');
        // The figures stand behind their chapter.
        let folders = [
            "paper/tour/",
            "paper/presentation/page/play.",
            "paper/figures/",
            "golden/figures/",
        ];
        let is_file = folders
            .iter()
            .any(|folder| line.starts_with(&format!("#![doc = include_str!(\"../{folder}")));
        let is_markup = ["", "<script>", "</script>"].map(|tag| format!("#![doc = \"{tag}\"]"));
        let is_document =
            line.starts_with("//!") || is_file || is_markup.iter().any(|it| it == line);
        let is_lint = line.starts_with("#[allow(rustdoc::");
        assert!(
            line.is_empty() || line == "}" || is_module || is_document || is_lint,
            "{line}"
        );
    }
}

#[test]
fn the_check_finds_every_import() {
    let text = "use crate::method::{modes, model::{Pair,\n    ParameterMatrix}};\nuse super::state;\npub use state::At;";
    let found = imports(text)
        .iter()
        .map(|path| absolute("a::b", path))
        .collect_vec();
    assert_eq!(
        found,
        [
            "method::modes",
            "method::model::Pair",
            "method::model::ParameterMatrix",
            "a::state"
        ]
    );
}

/// A name that is handed on without a page of its own stands in no documented signature but those of its own kind.
#[test]
fn no_documented_signature_has_a_hidden_name() {
    let source = in_root("src");
    let files = files_below(&source).into_iter();
    let files = files.filter(|file| file.extension().is_some_and(|end| end == "rs"));
    let texts = files.map(|file| (fs::read_to_string(&file).unwrap(), file));
    let texts = texts.collect_vec();
    let words = |text: &str| -> BTreeSet<String> {
        let words = text.split(|c: char| !c.is_alphanumeric() && c != '_');
        words.map(str::to_owned).collect()
    };
    let behind = |text: &str, what: &str| {
        let mark = format!("#[doc(hidden)]\npub {what} ");
        let all = text.split(&mark).skip(1);
        all.map(|rest| rest.split(';').next().unwrap().to_owned())
            .collect_vec()
    };
    let uses = texts.iter().flat_map(|(text, _)| behind(text, "use"));
    let hidden: BTreeSet<String> = uses.flat_map(|names| words(&names)).collect();
    let modules = texts.iter().flat_map(|(text, file)| {
        let folder = file.parent().unwrap();
        behind(text, "mod")
            .into_iter()
            .map(|name| folder.join(name))
    });
    let modules = modules.collect_vec();
    let is_shown = |file: &Path| {
        let own = file.with_extension("");
        modules.iter().all(|module| !own.starts_with(module))
    };
    let mut found = Vec::new();
    for (text, file) in texts.iter().filter(|(_, file)| is_shown(file)) {
        let mut owner = BTreeSet::new();
        for part in text.split("\n\n") {
            if !part.starts_with(' ') {
                let own = part.lines().find(|line| line.starts_with("impl"));
                owner = words(own.unwrap_or_default());
            }
            let Some((before, rest)) = part.split_once("pub fn ") else {
                continue;
            };
            let signature = words(rest.split('{').next().unwrap());
            let name = words(rest.split(['(', '<']).next().unwrap());
            let is_hidden = before.contains("doc(hidden)") || !hidden.is_disjoint(&name);
            if before.contains("///") && !is_hidden && hidden.is_disjoint(&owner) {
                let names = signature.intersection(&hidden).cloned();
                found.extend(names.map(|name| format!("{}: {name}", file.display())));
            }
        }
    }
    assert_eq!(found, [""; 0]);
}
