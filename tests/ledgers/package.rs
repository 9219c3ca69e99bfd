//! What is published: the package has all that its own text and its own sources name, and nothing of the workshop.

use crate::ledgers::files_below;
use crate::prelude::*;
use std::path::Component;

pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The files that `cargo package` takes.
fn packaged() -> BTreeSet<String> {
    let arguments = [
        "package",
        "--list",
        "--allow-dirty",
        "--locked",
        "--offline",
    ];
    let output = Command::new(env!("CARGO"))
        .args(arguments)
        .current_dir(root())
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let list = String::from_utf8(output.stdout).unwrap();
    list.lines().map(|line| line.replace('\\', "/")).collect()
}

/// Files that the sources are compiled with, from the root.
pub fn included() -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for file in files_below(&root().join("src")) {
        let text = fs::read_to_string(&file).unwrap();
        for rest in text.split("include_str!(\"").skip(1) {
            let name = rest.split('"').next().unwrap();
            let mut path = PathBuf::new();
            for part in file.parent().unwrap().join(name).components() {
                match part {
                    Component::ParentDir => drop(path.pop()),
                    part => path.push(part),
                }
            }
            let below = path.strip_prefix(root()).unwrap();
            found.insert(below.to_string_lossy().into_owned());
        }
    }
    found
}

/// Files that a document names as code or links to, of those that are there.
fn named(document: &str) -> BTreeSet<String> {
    let pieces = document.split(['`', '(', ')', '[', ']', ' ', '\n', '"']);
    let is_file = |piece: &&str| piece.contains('/') && root().join(piece).is_file();
    pieces.filter(is_file).map(str::to_owned).collect()
}

#[test]
fn the_package_has_what_a_user_needs() {
    let list = packaged();
    let mut needed = included();
    assert!(needed.len() > 15, "{needed:?}");
    let readme = named(include_str!("../../README.md"));
    assert!(readme.len() > 10, "{readme:?}");
    needed.extend(readme);
    // Every chapter's code, and what its readers are sent to.
    for file in files_below(&root().join("paper/tour")) {
        needed.extend(named(&fs::read_to_string(file).unwrap()));
    }
    let others = [
        "Cargo.lock",
        "Cargo.toml",
        "README.md",
        "LICENSE-APACHE",
        "LICENSE-MIT",
        "formulas-as-mathml.html",
        "src/main.rs",
    ];
    needed.extend(others.map(str::to_owned));
    let missing = needed.difference(&list).collect_vec();
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn the_package_has_nothing_of_the_workshop() {
    let list = packaged();
    let is_workshop = |file: &&String| {
        file.starts_with(".ci") || file.starts_with("target") || file.ends_with("mutants.toml")
    };
    assert_eq!(list.iter().find(is_workshop), None);
    // What a registry takes at most is ten megabytes when packed.
    let size = |file: &String| fs::metadata(root().join(file)).map_or(0, |found| found.len());
    let bytes: u64 = list.iter().map(size).sum();
    assert!(bytes < 10_000_000, "{bytes} bytes");
}
