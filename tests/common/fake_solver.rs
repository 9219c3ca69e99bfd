//! NASTRAN-95 played by a small shell script, and its answers written as module OUTPUT5 writes them.

use crate::prelude::*;
use std::fmt::Write;
use std::os::unix::fs::PermissionsExt;

/// A folder that looks like NASTRAN-95, its program the given shell script.
pub fn fake(script: &str) -> TempDir {
    let home = new_folder();
    fs::create_dir_all(home.path().join("bin")).unwrap();
    fs::create_dir_all(home.path().join("rf")).unwrap();
    let program = home.path().join("bin/nastrn");
    fs::write(&program, format!("#!/bin/sh\n{script}\n")).unwrap();
    fs::set_permissions(&program, PermissionsExt::from_mode(0o755)).unwrap();
    home
}

pub fn solver(home: &TempDir) -> Nastran95 {
    let mut solver = Nastran95::in_folder(home.path()).unwrap();
    // A loaded machine takes its time to start a shell.
    solver.time_limit = Duration::from_secs(20);
    solver
}

/// Matrices as module OUTPUT5 writes them.
pub fn output5(matrices: &[(&str, &DMatrix<f64>)]) -> String {
    let mut text = String::from("CORFEM\n");
    for (name, matrix) in matrices {
        let _ = writeln!(text, "{:8}{:8}{:8}", 0, 1, 1);
        let _ = writeln!(
            text,
            "{:26}{:8}{:8}{:8}{:8}{:8}{:8}{name:8}",
            "0.00000000000000000D+00",
            matrix.ncols(),
            matrix.nrows(),
            6,
            2,
            0,
            0
        );
        for (column, entries) in matrix.column_iter().enumerate() {
            let Some(first) = entries.iter().position(|x| *x != 0.0) else {
                continue;
            };
            let last = entries.iter().rposition(|x| *x != 0.0).unwrap();
            let _ = writeln!(text, "{:8}{:8}{:8}", column + 1, first + 1, last + 1);
            for line in entries.as_slice()[first..=last].chunks(5) {
                let fields: String = line
                    .iter()
                    .map(|x| format!("{:>26}", format!("{x:.17e}").replace('e', "D")))
                    .collect();
                text.push_str(&fields);
                text.push('\n');
            }
        }
    }
    text
}
