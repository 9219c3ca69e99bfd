//! What a user of the library needs: this crate and nothing beside it.

use crate::prelude::*;

/// The folder of everything this test program was compiled from, and the newest build of the library in it.
fn built() -> (PathBuf, PathBuf) {
    let folder = std::env::current_exe().unwrap();
    let folder = folder.parent().unwrap().to_owned();
    let is_library = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with("libcorfem-") && name.ends_with(".rlib")
    };
    let files = fs::read_dir(&folder).unwrap();
    let files = files.map(|entry| entry.unwrap().path());
    let newest = |path: &PathBuf| fs::metadata(path).and_then(|found| found.modified()).ok();
    let library = files.filter(is_library).max_by_key(newest);
    (folder, library.unwrap())
}

/// What the compiler says of a program that has no dependency but this crate; nothing if it compiles.
fn refused(program: &str) -> Option<String> {
    let (folder, library) = built();
    let scratch = new_folder();
    let source = scratch.path().join("user.rs");
    fs::write(&source, program).unwrap();
    let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let done = Command::new(compiler)
        .args(["--edition", "2024", "--emit", "metadata", "--extern"])
        .arg(format!("corfem={}", library.display()))
        .arg("-L")
        .arg(format!("dependency={}", folder.display()))
        .arg("--out-dir")
        .arg(scratch.path())
        .arg(&source)
        .output()
        .unwrap();
    (!done.status.success()).then(|| String::from_utf8_lossy(&done.stderr).into_owned())
}

/// Code of a document, to the end of its block, as the body of a program's main function.
fn program_of(code: &str) -> String {
    let code = code.split("```").next().unwrap();
    let lines = code
        .lines()
        .map(|line| line.strip_prefix("# ").unwrap_or(line));
    let body = lines.collect_vec().join("\n");
    format!("fn main() -> Result<(), Box<dyn std::error::Error>> {{\n{body}\n}}")
}

fn document(name: &str) -> String {
    let path = in_root(name);
    fs::read_to_string(path).unwrap()
}

#[test]
fn both_programs_need_no_dependency_but_this_crate_and_65_lines() {
    let document = document("paper/library.md");
    let programs = document
        .split("```rust\n")
        .skip(1)
        .map(program_of)
        .collect_vec();
    for program in &programs {
        let lines = program.lines().count();
        assert!(lines <= 65 && refused(program).is_none(), "{lines} lines");
    }
    let program = &programs[1];
    // Without the crate's own, the macros find no nalgebra: there is none beside it.
    let without = program.replace("nalgebra::{self, ", "nalgebra::{");
    assert_ne!(&without, program);
    let said = refused(&without).unwrap();
    assert!(said.contains("nalgebra"), "{said}");
}

#[test]
fn every_macro_of_nalgebra_is_served() {
    let program = "use corfem::nalgebra::{self, dmatrix, dvector, matrix, point, vector};
        fn main() {
            let _ = (dmatrix![1.0, 2.0; 3.0, 4.0], dvector![1.0], matrix![1.0; 2.0], vector![1.0, 2.0], point![1.0, 2.0]);
        }";
    assert_eq!(refused(program), None);
}
