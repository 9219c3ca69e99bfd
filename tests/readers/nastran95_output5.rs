//! The formatted file of NASTRAN's module OUTPUT5.

#![cfg(unix)]

use crate::common::fake_solver::output5;
use crate::prelude::*;

#[test]
fn a_file_of_module_output5_reads() {
    let text = include_str!("../../golden/nastran95/output5_rod.txt");
    let matrices = read_output5(text, 144).unwrap();
    assert_eq!(matrices.len(), 1);
    let kgg = &matrices["KGG"];
    assert_eq!(kgg.shape(), (12, 12));
    assert_eq!(kgg[(0, 0)], 0.201_881_637_294_121_43e5);
    assert_eq!(kgg[(8, 1)], 0.982_844_813_142_433_3e4);
    assert_eq!(kgg, &kgg.transpose());
    assert_eq!(kgg.row(3).amax(), 0.0);
    let two = output5(&[
        (
            "A",
            &DMatrix::from_row_slice(2, 3, &[0.0, 2.0, 0.0, 1.0, -3.0, 0.0]),
        ),
        ("B", &zero_square(1)),
    ]);
    let read = read_output5(&two, 7).unwrap();
    assert_eq!(
        read["A"],
        DMatrix::from_row_slice(2, 3, &[0.0, 2.0, 0.0, 1.0, -3.0, 0.0])
    );
    assert_eq!(read["B"], zero_square(1));
    // No header is too large, but both together are.
    let error = read_output5(&two, 6).expect_err("seven entries");
    assert!(error.to_string().contains("line 9: "), "{error}");
}

#[test]
fn a_damaged_file_of_module_output5_is_refused_by_line() {
    let good = include_str!("../../golden/nastran95/output5_rod.txt");
    let lines = good.lines().collect_vec();
    let refused = |line: usize, text: &str, expected: &str| {
        let mut lines = lines.clone();
        lines[line - 1] = text;
        let error = read_output5(&lines.join("\n"), 144).expect_err(text);
        let reason = error.to_string();
        let (what, line) = expected.rsplit_once(" in ").unwrap();
        assert!(
            reason.starts_with(&format!("NASTRAN-95: OUTPUT5 file, {line}: "))
                && reason.contains(what),
            "{text}: {reason}"
        );
    };
    let header = |columns: usize, kind: usize| {
        format!(
            "   0.00000000000000000D+00{columns:8}      12       6{kind:8}      12    2500KGG     "
        )
    };
    refused(2, "  x", "a line of integers in line 2");
    refused(
        2,
        "       1       1       1",
        "the header that precedes a matrix's columns in line 2",
    );
    refused(
        3,
        "   0.00000000000000000D+00      1x",
        "a line of integers in line 3",
    );
    refused(
        3,
        &header(12, 1),
        "the header of a real double precision matrix in line 3",
    );
    for columns in [13, 99_999_999] {
        refused(
            3,
            &header(columns, 2),
            "the header of a matrix within the 144 entries of all in line 3",
        );
    }
    for outside in [
        "      13       1       9",
        "       1       0       9",
        "       1       1      13",
        "       1       3       2",
    ] {
        refused(4, outside, "a column and rows within the matrix in line 4");
    }
    refused(
        5,
        "",
        "a line of the column's reals in format D26.17 is missing in line 5",
    );
    refused(
        5,
        "   0.20188163729412143X+05",
        "is not a line of the column's reals in format D26.17 in line 5",
    );
    refused(
        4,
        "       1       1       4",
        "is not a line of the column's reals in format D26.17 in line 5",
    );
    refused(
        4,
        "       1       1       7",
        "is not a line of the column's reals in format D26.17 in line 6",
    );
    let cut = lines[..4].join("\n");
    let error = read_output5(&cut, 144).expect_err("its end");
    let ended = "NASTRAN-95: OUTPUT5 file, line 5: the file ends before";
    assert!(error.to_string().starts_with(ended), "{error}");
}
