//! What a dump holds, read back: the matrices have the case's modes, and the iterations are those of (13).

use crate::prelude::*;
use crate::presentation::program::cli::{numbers, parsed};

/// A case's document.
fn dumped(case: &str) -> Value {
    let case = case_of(case.parse().unwrap());
    serde_json::from_str(&crate::common::dump::dump(&case).unwrap()).unwrap()
}

fn matrix(value: &Value) -> DMatrix<f64> {
    let rows = value.as_array().unwrap().iter().map(numbers).collect_vec();
    DMatrix::from_fn(rows.len(), rows[0].len(), |row, column| rows[row][column])
}

fn entries(value: &Value) -> &Vec<Value> {
    value.as_array().unwrap()
}

/// The keys of a document, a line each; of a list those of its first entry.
fn keys(value: &Value, path: &str, found: &mut Vec<String>) {
    match value {
        Value::Object(map) => map
            .iter()
            .for_each(|(key, value)| keys(value, &format!("{path}.{key}"), found)),
        Value::Array(items) if items.first().is_some_and(|item| item.is_object()) => {
            keys(&items[0], &format!("{path}[]"), found);
        }
        Value::Array(items) => {
            let columns = items
                .first()
                .and_then(Value::as_array)
                .map(|row| format!(" × {}", row.len()));
            found.push(format!(
                "{path}: {}{}",
                items.len(),
                columns.unwrap_or_default()
            ));
        }
        _ => found.push(path.to_owned()),
    }
}

#[test]
fn dumped_matrices_have_the_dumped_modes() {
    for case in ["1", "3"] {
        let dump = dumped(case);
        let t = matrix(&dump["T"]);
        for analysis in entries(&dump["analyses"]) {
            let [k, m, v, b] = ["K_D", "M", "V", "B"].map(|name| matrix(&analysis[name]));
            let (omega_squared, _) = modes_by_nalgebra(&k, &m);
            for (frequency, omega_squared) in numbers(&analysis["frequencies_hz"])
                .into_iter()
                .zip(omega_squared.iter())
            {
                assert_alike(
                    [frequency * 2.0 * PI],
                    [omega_squared.sqrt()],
                    1e2 * EIGEN_ROUND_OFF,
                );
            }
            let one = eye(9);
            assert!((v.tr_mul(&(&m * &v)) - &one).amax() < MATRIX_ROUND_OFF);
            assert!((b * &t - one).amax() < 1e2 * MATRIX_ROUND_OFF);
            // The panels' shares leave those of the rods, which never change.
            let rods = entries(&analysis["shares"])
                .iter()
                .fold(k.clone(), |left, share| left - matrix(share));
            assert!(rods.symmetric_eigenvalues().min() > -MATRIX_ROUND_OFF * k.amax());
        }
    }
}

/// Those of the runs with fewer modes and of cases too.
#[test]
fn the_keys_of_documents_stay_what_they_are() {
    let dump = ("dump_keys", dumped("2"));
    let documents = [
        ("cases_keys", &["cases", "3", "-q", "-f", "json"][..]),
        ("case_4_keys", &["cases", "4", "-q", "-f", "json"]),
        ("fewer_modes_keys", &["fewer-modes", "-f", "json"]),
    ];
    let documents = documents.map(|(name, arguments)| (name, parsed(arguments)));
    for (name, document) in once(dump).chain(documents) {
        let mut found = Vec::new();
        keys(&document, "", &mut found);
        assert_golden(name, &found.join("\n"), Numbers::AS_WRITTEN);
    }
}
