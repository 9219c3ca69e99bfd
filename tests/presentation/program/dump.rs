//! What `corfem dump` writes, read back: the matrices have the case's modes, and the iterations are those of (13).

use crate::prelude::*;
use crate::presentation::program::cli::{corfem, numbers, parsed};
use corfem::files::matrices::read;

/// A case's document.
fn dumped(case: &str) -> Value {
    parsed(&["dump", case])
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

#[test]
fn a_folder_gets_every_matrix_as_the_document_has_it() {
    let folder = new_folder();
    let path = folder.path().join("dump");
    let place = path.to_str().unwrap();
    // T, V_G and the document; K_D, M, V, B and fifteen shares of the start and of both passes.
    const FILES: usize = 3 + 3 * 19;
    for (more, said) in [
        (&[][..], format!("{FILES} files in {place}\n")),
        (&["--quiet"], String::new()),
    ] {
        let output = corfem(&[&["dump", "2", "--folder", place], more].concat());
        assert_eq!((output.status.code(), output.stdout.len()), (Some(0), 0));
        assert_eq!(String::from_utf8_lossy(&output.stderr), said);
    }
    assert_eq!(fs::read_dir(&path).unwrap().count(), FILES);
    let file = |name: String| fs::read(path.join(name)).unwrap();
    let dump: Value = serde_json::from_slice(&file("dump.json".to_owned())).unwrap();
    assert_eq!(dump, dumped("2"));
    // The last digit is the reader's of JSON; of a symmetric matrix the file has the lower triangle alone.
    let assert_same = |name: &str, value: &Value| {
        let name = format!("{name}.mtx");
        let stored = read(&name, &file(name.clone()), None)
            .unwrap()
            .matrix
            .dense();
        let expected = matrix(value);
        assert!(
            (stored - &expected).amax() < MATRIX_ROUND_OFF * expected.amax(),
            "{name}"
        );
    };
    assert_same("T", &dump["T"]);
    assert_same("V_G", &dump["test"]["V_G"]);
    for (number, analysis) in (1..).zip(entries(&dump["analyses"])) {
        for name in ["K_D", "M", "V", "B"] {
            assert_same(&format!("analysis_{number}_{name}"), &analysis[name]);
        }
        for (panel, share) in (1..).zip(entries(&analysis["shares"])) {
            assert_same(&format!("analysis_{number}_share_{panel}"), share);
        }
    }
}

/// Those of the runs with fewer modes and of cases too.
#[test]
fn the_keys_of_documents_stay_what_they_are() {
    for (name, arguments) in [
        ("dump_keys", &["dump", "2"][..]),
        ("cases_keys", &["cases", "3", "-q", "-f", "json"]),
        ("case_4_keys", &["cases", "4", "-q", "-f", "json"]),
        ("fewer_modes_keys", &["fewer-modes", "-f", "json"]),
    ] {
        let mut found = Vec::new();
        keys(&parsed(arguments), "", &mut found);
        assert_golden(name, &found.join("\n"), Numbers::AS_WRITTEN);
    }
}
