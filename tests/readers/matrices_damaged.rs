//! Matrix files that are damaged, complex or too much: each is refused by its line.

use corfem::files::matrices::read;

#[track_caller]
fn refused(text: &str, expected: &str) {
    let error = read("m", text.as_bytes(), None)
        .expect_err(expected)
        .to_string();
    assert!(error.starts_with(&format!("m, line {expected}")), "{error}");
}

#[test]
fn matrix_market_is_refused_by_line() {
    let real = "%%MatrixMarket matrix coordinate real general\n% a remark\n\n";
    refused(
        "%%MatrixMarket matrix coordinate complex general\n1 1 1\n1 1 1 0\n",
        "1: expected a matrix, array or coordinate",
    );
    refused(
        "%%MatrixMarket matrix coordinate pattern general\n1 1 1\n1 1\n",
        "1: expected a matrix, array or coordinate",
    );
    refused(
        "%%MatrixMarket matrix coordinate real hermitian\n",
        "1: expected a general, symmetric or skew-symmetric matrix, found h",
    );
    refused(
        real,
        "4: expected the line of sizes, found the end of the file",
    );
    let array = real.replace("coordinate", "array");
    for sizes in ["2 2", "0 2 1", "2 0 1", "2 x 1", "-2 2 1"] {
        refused(
            &format!("{real}{sizes}\n"),
            "4: expected rows, columns and, in the coordinate format",
        );
    }
    for sizes in ["2 2 4", "0 2", "2 0"] {
        refused(
            &format!("{array}{sizes}\n"),
            "4: expected rows, columns and, in the coordinate format",
        );
    }
    refused(
        &format!("{real}2 2 2\n1 1 1.5\n"),
        "6: expected as many entries as the line of sizes says, found the end of the file after 1",
    );
    refused(
        &format!("{real}2 2 1\n1 1 1.5\n1 2 1.5\n"),
        "6: expected no more entries than the line of sizes says, found 1 2 1.5",
    );
    refused(
        &format!("{real}2 2 1\n1 3 1.5\n"),
        "5: expected a row and column in the part of the matrix that is stored, found 1 3 1.5",
    );
    refused(
        &format!("{real}2 2 1\n0 1 1.5\n"),
        "5: expected a row and column",
    );
    for entry in ["1 1", "1.5", "1 1 1 1"] {
        refused(
            &format!("{real}2 2 1\n{entry}\n"),
            &format!("5: expected a row, a column and a value, found {entry}"),
        );
    }
    for value in ["1.5.5", "nan", "inf", "1e999", "x"] {
        refused(
            &format!("{real}2 2 1\n1 1 {value}\n"),
            &format!("5: expected a real number, found {value}"),
        );
    }
    let symmetric = real.replace("general", "symmetric");
    refused(
        &format!("{symmetric}2 2 1\n1 2 1.\n"),
        "5: expected a row and column in the part",
    );
    refused(
        &format!("{symmetric}2 3 1\n2 1 1.\n"),
        "4: expected as many rows as columns",
    );
    refused(
        &format!(
            "{}2 2 1\n1 1 1.\n",
            real.replace("general", "skew-symmetric")
        ),
        "5: expected a row and column in the part",
    );
    refused(
        &format!("{array}2 1\n1.\n"),
        "6: expected as many entries as the line of sizes says, found the end of the file after 1",
    );
    refused(
        &format!("{array}2 1\n1.\n2.\n3.\n"),
        "7: expected no more entries than places, found 3.",
    );
    for entry in ["1. 2.", "1 1 1."] {
        refused(
            &format!("{array}2 1\n{entry}\n"),
            &format!("5: expected a value, found {entry}"),
        );
    }
}

/// A header may promise what no memory holds: nothing is made ready for it.
#[test]
fn a_promise_takes_no_memory() {
    let most = 1_000_000_000_000_usize;
    refused(
        &format!("%%MatrixMarket matrix coordinate real general\n{most} {most} {most}\n1 1 1.\n"),
        "4: expected as many entries",
    );
    refused(
        &format!("%%MatrixMarket matrix array real general\n{most} {most}\n1.\n"),
        "4: expected as many entries",
    );
    refused(
        "99999999-9999999       2       2A       1P,3E23.16\n       1       0       3\n       3       1\n 1.0\n",
        "5: expected integers",
    );
    let text = format!(
        "%%MatrixMarket matrix coordinate real general\n{most} {most} 1\n{most} {most} 1D0\n"
    );
    let matrix = read("m", text.as_bytes(), None).expect("one entry").matrix;
    assert_eq!(matrix.entries(), [(most - 1, most - 1, 1.0)]);
}

#[test]
fn output4_is_refused_by_line() {
    let header = "       2       2       2       2A       1P,3E23.16\n";
    let one = " 1.0000000000000000E+00";
    let end = format!("       3       1       1\n{one}\n");
    refused(
        "nonsense",
        "1: expected the header of a matrix, found nonsense",
    );
    refused(
        &header.replace("2A", "4A"),
        "1: expected a matrix of type 1 or 2, which is real",
    );
    refused(
        &header.replace("2       2A", "3       2A"),
        "1: expected a matrix of form 1, 2, 6 or 9",
    );
    refused(
        &header.replace("1P,3E23.16", "1P,3F23.16"),
        "1: expected a format such as 1P,5E16.9",
    );
    refused(
        &header.replace("1P,3E23.16", "1P,3E0.16"),
        "1: expected a format such as 1P,5E16.9",
    );
    refused(
        &header.replace("A       1P,3E23.16", "SHAPE9"),
        "1: expected a format such as 1P,5E16.9, found 2",
    );
    refused(
        &header.replacen("       2       2", "       2       0", 1),
        "1: expected a number of rows",
    );
    refused(
        header,
        "2: expected integers of eight characters, found the end of the file",
    );
    refused(
        &format!("{header}       1       1       2\n{one}\n{end}"),
        "2: expected a column with as many numbers as it says",
    );
    refused(
        &format!("{header}       1       2       2\n{one}{one}\n{end}"),
        "3: expected no more numbers than rows",
    );
    refused(
        &format!("{header}       1       1       1\n 1.000000000000x000E+00\n{end}"),
        "3: expected real numbers in the header's format",
    );
    refused(
        &format!("{header}       2       1       1\n{one}\n       2       1       1\n{one}\n{end}"),
        "4: expected a column after the one before",
    );
    refused(
        &format!("{header}       1       0       3\n{end}"),
        "2: expected a column with as many numbers as it says",
    );
    refused(
        &format!(
            "{header}       1       0       3\n{:8}\n{one}\n{end}",
            65536 * 5 + 1
        ),
        "3: expected a string with as many numbers as it says",
    );
    let string = format!("{:8}\n{one}\n", 65536 * 3 + 1);
    refused(
        &format!("{header}       1       0       6\n{string}{string}{end}"),
        "5: expected a string after the one before",
    );
    refused(
        &format!("{header}       1       0       6\n   1   2\n{one}\n{end}"),
        "3: expected the one integer of a string",
    );
    let complex = header.replace("2A", "4C");
    let both =
        format!("{complex}       1       1       4\n{one}{one}{one}\n{one}\n{end}{header}{end}");
    assert!(
        read("m", both.as_bytes(), Some("A"))
            .expect("the other one")
            .matrix
            .entries()
            .is_empty()
    );
}

#[test]
fn dmig_is_refused_by_field() {
    let header = "DMIG,K,0,6,2,0\n";
    refused(
        "DMIG,K,0,8,2,0\n",
        "1: card DMIG, field 4: expected form 1, 2, 6 or 9, found 8",
    );
    refused(
        "DMIG,K,1,1,,1,1,1.\n",
        "1: card DMIG, field 2: expected the name of a matrix with a header, found K",
    );
    for (card, field, expected) in [
        ("DMIG,K,1,7,,1,1,1.", 4, "a component from 0 to 6, found 7"),
        (
            "DMIG,K,-1,1,,1,1,1.",
            3,
            "a positive integer of at most eight digits, found -1",
        ),
        ("DMIG,K,1,1,,1,1,", 8, "a real number, found a blank"),
        (
            "DMIG,K,1,1,,1,1,1",
            8,
            "a real number with a decimal point, found 1",
        ),
        (
            "DMIG,K,1,1,,1,1,1.,2.",
            9,
            "a blank or zero, for the crate has no complex matrices, found 2.",
        ),
        (
            "DMIG,K,1,1,,1,,1.,,+A\n+A,x,1,1.",
            12,
            "a positive integer of at most eight digits, found X",
        ),
    ] {
        let line = if field > 9 { 3 } else { 2 };
        refused(
            &format!("{header}{card}\n"),
            &format!("{line}: card DMIG, field {field}: expected {expected}"),
        );
    }
    let twice = format!("{header}DMIG,K,1,1,,2,1,1.\nDMIG,K,2,1,,1,1,1.\n");
    refused(
        &twice,
        "3: card DMIG, field 6: expected a place of the matrix that no other entry has, found 1",
    );
    assert!(
        read("m", header.as_bytes(), None).is_err(),
        "a matrix without columns"
    );
}
