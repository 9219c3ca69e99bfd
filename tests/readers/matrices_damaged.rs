//! Matrix files that are damaged, complex or too much: each is refused by its line.

use crate::prelude::*;
use corfem::files::matrices::read;

#[track_caller]
fn refused(text: &str, expected: &str) {
    let error = read("m", text.as_bytes(), None)
        .expect_err(expected)
        .to_string();
    let (line, reason) = expected.split_once(": ").unwrap();
    assert!(
        error.starts_with(&format!("m, line {line}: ")) && error.contains(reason),
        "{error}"
    );
}

#[test]
fn matrix_market_is_refused_by_line() {
    let real = "%%MatrixMarket matrix coordinate real general\n% a remark\n\n";
    refused(
        "%%MatrixMarket matrix coordinate complex general\n1 1 1\n1 1 1 .5\n",
        "3: \"1 1 1 .5\" is not a number with an imaginary part of zero",
    );
    refused(
        "%%MatrixMarket matrix coordinate pattern general\n1 1 1\n1 1\n",
        "1: \"%%MatrixMarket matrix coordinate",
    );
    refused(
        "%%MatrixMarket matrix coordinate real unsymmetric\n",
        "1: \"unsymmetric\" is not general, symmetric, hermitian or skew-symmetric",
    );
    refused(real, "4: the file ends before the line of sizes");
    let array = real.replace("coordinate", "array");
    for sizes in ["2 2", "0 2 1", "2 0 1", "2 x 1", "-2 2 1"] {
        refused(
            &format!("{real}{sizes}\n"),
            &format!("4: \"{sizes}\" is not a line of sizes: rows, columns and"),
        );
    }
    for sizes in ["2 2 4", "0 2", "2 0"] {
        refused(
            &format!("{array}{sizes}\n"),
            &format!("4: \"{sizes}\" is not a line of sizes: rows, columns and"),
        );
    }
    refused(
        &format!("{real}2 2 2\n1 1 1.5\n"),
        "6: the file ends after entry 1; the line of sizes promises more",
    );
    refused(
        &format!("{real}2 2 1\n1 1 1.5\n1 2 1.5\n"),
        "6: there are more entries than the line of sizes says",
    );
    refused(
        &format!("{real}2 2 1\n1 3 1.5\n"),
        "5: \"1 3 1.5\" is not an entry within the part of the matrix that is stored",
    );
    refused(
        &format!("{real}2 2 1\n0 1 1.5\n"),
        "5: \"0 1 1.5\" is not an entry within",
    );
    for entry in ["1 1", "1.5", "1 1 1 1"] {
        refused(
            &format!("{real}2 2 1\n{entry}\n"),
            &format!("5: \"{entry}\" is not a row, a column and a value"),
        );
    }
    for value in ["1.5.5", "nan", "inf", "1e999", "x"] {
        refused(
            &format!("{real}2 2 1\n1 1 {value}\n"),
            &format!("5: \"{value}\" is not a real number"),
        );
    }
    let symmetric = real.replace("general", "symmetric");
    refused(
        &format!("{symmetric}2 2 3\n1 2 1.\n2 1 2.\n1 1 1.\n"),
        "1: entries (1, 2) and (2, 1) of a symmetric matrix differ",
    );
    refused(
        &format!("{symmetric}2 3 1\n2 1 1.\n"),
        "4: \"2 3 1\" is not the size of a symmetric matrix",
    );
    refused(
        &format!(
            "{}2 2 1\n1 1 1.\n",
            real.replace("general", "skew-symmetric")
        ),
        "5: \"1 1 1.\" is not an entry within",
    );
    refused(
        &format!("{array}2 1\n1.\n"),
        "6: the file ends after entry 1; the line of sizes promises more",
    );
    refused(
        &format!("{array}2 1\n1.\n2.\n3.\n"),
        "7: there are more entries than the line of sizes says",
    );
    for entry in ["1. 2.", "1 1 1."] {
        refused(
            &format!("{array}2 1\n{entry}\n"),
            &format!("5: \"{entry}\" is not a value"),
        );
    }
}

/// A header may promise what no memory holds: nothing is made ready for it.
#[test]
fn a_promise_takes_no_memory() {
    let most = 1_000_000_000_000_usize;
    refused(
        &format!("%%MatrixMarket matrix coordinate real general\n{most} {most} {most}\n1 1 1.\n"),
        "4: the file ends after entry 1",
    );
    refused(
        &format!("%%MatrixMarket matrix array real general\n{most} {most}\n1.\n"),
        "4: the file ends after entry 1",
    );
    refused(
        "99999999-9999999       2       2A       1P,3E23.16\n       1       0       3\n       3       1\n 1.0\n",
        "5: the file ends before a line of integers",
    );
    let text = format!(
        "%%MatrixMarket matrix coordinate real general\n{most} {most} 1\n{most} {most} 1D0\n"
    );
    assert!(read("m", text.as_bytes(), None).is_err());
    let most = 4_000_000_000_usize;
    let text = format!(
        "%%MatrixMarket matrix coordinate real general\n{most} {most} 1\n{most} {most} 1D0\n"
    );
    let matrix = read("m", text.as_bytes(), None).unwrap().matrix;
    assert_eq!(matrix.entries().collect_vec(), [(most - 1, most - 1, 1.0)]);
}

#[test]
fn output4_is_refused_by_line() {
    let header = "       2       2       2       2A       1P,3E23.16\n";
    let one = " 1.0000000000000000E+00";
    let end = format!("       3       1       1\n{one}\n");
    refused("nonsense", "1: \"nonsense\" is not the header of a matrix");
    refused(
        &header.replace("2A", "4A"),
        "1: is not the header of a real matrix (type 1 or 2)",
    );
    refused(
        &header.replace("2       2A", "3       2A"),
        "1: is not the header of a matrix of form 1, 2 or 9",
    );
    refused(
        &header.replace("1P,3E23.16", "1P,3F23.16"),
        "1: is not a header with a format such as 1P,5E16.9",
    );
    refused(
        &header.replace("1P,3E23.16", "1P,3E0.16"),
        "1: is not a header with a format such as 1P,5E16.9",
    );
    refused(
        &header.replace("A       1P,3E23.16", "SHAPE9"),
        "1: is not a header with a format such as 1P,5E16.9",
    );
    refused(
        &header.replacen("       2       2", "       2       0", 1),
        "1: is not a header with a number of rows",
    );
    refused(
        header,
        "2: the file ends before a line of integers of eight characters",
    );
    refused(
        &format!("{header}       1       1       2\n{one}\n{end}"),
        "2: is not a header that counts the numbers below it",
    );
    refused(
        &format!("{header}       1       2       2\n{one}{one}\n{end}"),
        "3: is not a line of numbers that ends within the column",
    );
    refused(
        &format!("{header}       1       1       1\n 1.000000000000x000E+00\n{end}"),
        "3: is not a line of real numbers in the header's format",
    );
    refused(
        &format!("{header}       2       1       1\n{one}\n       2       1       1\n{one}\n{end}"),
        "4: is not the header of a column after the last one",
    );
    refused(
        &format!("{header}       1       0       3\n{end}"),
        "2: is not a header that counts the numbers below it",
    );
    refused(
        &format!(
            "{header}       1       0       3\n{:8}\n{one}\n{end}",
            65536 * 5 + 1
        ),
        "3: is not a header that counts the numbers below it",
    );
    let string = format!("{:8}\n{one}\n", 65536 * 3 + 1);
    refused(
        &format!("{header}       1       0       6\n{string}{string}{end}"),
        "5: is not the header of a string below the last one",
    );
    refused(
        &format!("{header}       1       0       6\n   1   2\n{one}\n{end}"),
        "3: is not the one integer of a string's header",
    );
    let complex = header.replace("2A", "4C");
    let both =
        format!("{complex}       1       1       4\n{one}{one}{one}\n{one}\n{end}{header}{end}");
    assert!(
        read("m", both.as_bytes(), Some("A"))
            .unwrap()
            .matrix
            .entries()
            .collect_vec()
            .is_empty()
    );
}

#[test]
fn dmig_is_refused_by_field() {
    let header = "DMIG,K,0,6,2,0\n";
    refused(
        "DMIG,K,0,8,2,0\n",
        "1: card DMIG, field 4: \"8\" is not a form (1, 2, 6 or 9)",
    );
    refused(
        "DMIG,K,1,1,,1,1,1.\n",
        "1: card DMIG, field 2: \"K\" is not the name of a matrix with a header",
    );
    for (card, field, expected) in [
        (
            "DMIG,K,1,7,,1,1,1.",
            4,
            "\"7\" is not a component from 0 to 6",
        ),
        (
            "DMIG,K,-1,1,,1,1,1.",
            3,
            "\"-1\" is not a positive integer of at most eight digits",
        ),
        ("DMIG,K,1,1,,1,1,", 8, "a real number is missing"),
        (
            "DMIG,K,1,1,,1,1,1",
            8,
            "\"1\" is not a real number with a decimal point",
        ),
        (
            "DMIG,K,1,1,,1,1,1.,2.",
            9,
            "\"2.\" must be blank or zero: corfem has no complex matrices",
        ),
        (
            "DMIG,K,1,1,,1,,1.,,+A\n+A,x,1,1.",
            12,
            "\"X\" is not a positive integer of at most eight digits",
        ),
    ] {
        let line = if field > 9 { 3 } else { 2 };
        refused(
            &format!("{header}{card}\n"),
            &format!("{line}: card DMIG, field {field}: {expected}"),
        );
    }
    let twice = format!("{header}DMIG,K,1,1,,2,1,1.\nDMIG,K,2,1,,1,1,1.\n");
    refused(
        &twice,
        "3: card DMIG, field 6: another entry has this place of the matrix",
    );
    assert!(
        read("m", header.as_bytes(), None).is_err(),
        "a matrix without columns"
    );
}
