//! The examples of the method: every public function has one, and every file of `paper/examples` is some function's.
//!
//! They are compiled and run with the documentation tests.

use crate::ledgers::files_below;
use crate::ledgers::package::{included, root};
use std::fs;

/// The public functions of a source that neither include an example nor have one in their documentation.
fn without_example(source: &str) -> Vec<&str> {
    let (mut missing, mut has_example) = (Vec::new(), false);
    for line in source.lines().map(str::trim_start) {
        let function = line
            .strip_prefix("pub fn ")
            .or_else(|| line.strip_prefix("pub const fn "));
        missing.extend(
            function
                .filter(|_| !has_example)
                .and_then(|rest| rest.split(['(', '<']).next()),
        );
        let is_example = line.starts_with("/// ```") || line.contains("paper/examples/");
        has_example =
            is_example || has_example && (line.starts_with("///") || line.starts_with("#["));
    }
    missing
}

#[test]
fn every_public_function_of_the_method_has_an_example() {
    let files = files_below(&root().join("src/method"));
    assert!(files.len() > 30, "only {} files were read", files.len());
    for file in files {
        let source = fs::read_to_string(&file).expect("it reads");
        assert_eq!(without_example(&source), [""; 0], "{}", file.display());
    }
}

#[test]
fn every_file_of_an_example_is_included_and_asserts_something() {
    let (included, files) = (included(), files_below(&root().join("paper/examples")));
    assert!(files.len() > 100, "only {} examples were read", files.len());
    for file in files {
        let name = file
            .strip_prefix(root())
            .expect("below the root")
            .to_string_lossy()
            .into_owned();
        let text = fs::read_to_string(&file).expect("it reads");
        assert!(included.contains(&name), "{name} is no function's");
        assert!(
            text.starts_with("# Example\n\n")
                && text.contains("\n```rust\n")
                && text.contains("assert"),
            "{name}"
        );
        assert!(!text.contains("unwrap"), "{name}");
    }
}

#[test]
fn the_check_finds_a_function_without_an_example() {
    let source = "/// ```\n/// a();\n/// ```\npub fn a() {}\n\n/// B.\npub fn b<T>() {}\n\
                  #[doc = include_str!(\"../../paper/examples/c.md\")]\n#[must_use]\npub const fn c() {}\n";
    assert_eq!(without_example(source), ["b"]);
}
