//! What is published, and what a user of the library needs.

use crate::ledgers::{file, files, files_of};
use crate::prelude::*;

/// `cargo package` in `.ci/run` builds the package from its own contents: what it is compiled with is in it.
pub fn the_package_has_what_its_documents_lead_to() -> Vec<String> {
    let mut command = Command::new(env!("CARGO"));
    command.args([
        "package",
        "--list",
        "--allow-dirty",
        "--locked",
        "--offline",
    ]);
    let output = command.current_dir(in_root("")).output().unwrap();
    let list = String::from_utf8(output.stdout).unwrap().replace('\\', "/");
    let list: BTreeSet<&str> = list.lines().collect();
    let mut wrong = Vec::new();
    for (name, text) in [files("README.md", ""), files("paper/tour/", "")].concat() {
        let pieces = text.split(['`', '(', ')', '[', ']', ' ', '\n', '"']);
        let paths = pieces.filter(|piece| piece.contains('/') && in_root(piece).is_file());
        let missing = paths.filter(|path| !list.contains(path));
        wrong.extend(missing.map(|path| format!("{name}: the package has no {path}")));
    }
    // What a registry takes at most is ten megabytes when packed.
    let size = |name: &&str| fs::metadata(in_root(name)).map_or(0, |found| found.len());
    let bytes: u64 = list.iter().map(size).sum();
    let is_workshop = |name: &&str| name.starts_with(".ci") || name.starts_with("target");
    if bytes > 10_000_000 || list.iter().any(is_workshop) {
        wrong.push(format!(
            "Cargo.toml: the package has the workshop in it: {bytes} bytes"
        ));
    }
    wrong
}

/// What the compiler says of a program that has no dependency but this crate.
fn refused(program: &str) -> Option<String> {
    let folder = std::env::current_exe().unwrap();
    let folder = folder.parent().unwrap();
    // The newest build of the library, beside everything that this test program was compiled from.
    let mut libraries = files_of(folder);
    libraries.retain(|path| {
        let name = path.file_name().unwrap().to_string_lossy();
        name.starts_with("libcorfem-") && name.ends_with(".rlib")
    });
    libraries.sort_by_key(|path| fs::metadata(path).and_then(|found| found.modified()).ok());
    let (scratch, library) = (new_folder(), libraries.pop().unwrap());
    let source = scratch.path().join("user.rs");
    fs::write(&source, program).unwrap();
    let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let mut command = Command::new(compiler);
    command.args(["--edition", "2024", "--emit", "metadata", "--extern"]);
    command.arg(format!("corfem={}", library.display()));
    command.arg(format!("-Ldependency={}", folder.display()));
    command.arg("--out-dir").arg(scratch.path()).arg(&source);
    let done = command.output().unwrap();
    let said = String::from_utf8_lossy(&done.stderr).into_owned();
    (!done.status.success()).then_some(said)
}

/// Both programs of `paper/library.md`, and every macro of nalgebra.
pub fn programs_of_users_need_no_dependency_but_this_crate() -> Vec<String> {
    let macros = "use corfem::nalgebra::{self, dmatrix, dvector, matrix, point, vector};
        let _ = (dmatrix![1.0, 2.0; 3.0, 4.0], dvector![1.0], matrix![1.0; 2.0], vector![1.0, 2.0], point![1.0, 2.0]); Ok(())";
    let blocks = file("paper/library.md").split("```rust\n").skip(1);
    let blocks = blocks.map(|block| block.split("```").next().unwrap());
    let mut wrong = Vec::new();
    for body in blocks.chain([macros]) {
        let lines = body
            .lines()
            .map(|line| line.strip_prefix("# ").unwrap_or(line));
        let lines = lines.collect_vec();
        let body = lines.join("\n");
        let program = format!("fn main() -> Result<(), Box<dyn std::error::Error>> {{\n{body}\n}}");
        if lines.len() > 63 {
            wrong.push(format!(
                "paper/library.md: a program of {} lines",
                lines.len()
            ));
        }
        wrong.extend(refused(&program));
        // Without the crate's own, the macros find no nalgebra: there is none beside it.
        let without = program.replace("nalgebra::{self, ", "nalgebra::{");
        if without != program && refused(&without).is_none() {
            wrong.push("another nalgebra was found".to_owned());
        }
    }
    wrong
}
