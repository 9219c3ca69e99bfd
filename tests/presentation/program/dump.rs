//! What `corfem dump` writes, read back: the matrices have the case's modes, and the iterations are those of (13).

use crate::prelude::*;
use crate::presentation::program::cli::{corfem, numbers};
use corfem::files::matrices::read;

/// A case's document.
fn dumped(case: &str) -> Value {
    let output = corfem(&["dump", case]);
    assert_eq!(output.status.code(), Some(0));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn matrix(value: &Value) -> DMatrix<f64> {
    let rows = value
        .as_array()
        .expect("rows")
        .iter()
        .map(numbers)
        .collect_vec();
    DMatrix::from_fn(rows.len(), rows[0].len(), |row, column| rows[row][column])
}

fn entries(value: &Value) -> &Vec<Value> {
    value.as_array().expect("a list")
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
fn the_keys_of_a_dump_stay_what_they_are() {
    let mut found = Vec::new();
    keys(&dumped("2"), "", &mut found);
    assert_golden("dump_keys", &found.join("\n"), Numbers::AS_WRITTEN);
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
                assert!(
                    (frequency * 2.0 * PI / omega_squared.sqrt() - 1.0).abs()
                        < 1e2 * EIGEN_ROUND_OFF
                );
            }
            let one = DMatrix::identity(9, 9);
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
fn dumped_factors_follow_from_the_dumped_changes() {
    for case in ["1", "2", "3", "4"] {
        let dump = dumped(case);
        let inner = &dump["settings"]["inner"];
        let number = |value: &Value| value.as_f64().expect("a number");
        let bounds = [
            &inner["factor_range"]["lower"],
            &inner["factor_range"]["upper"],
        ]
        .map(number);
        let mut count = 0;
        for (pass, analyses) in entries(&dump["passes"])
            .iter()
            .zip(entries(&dump["analyses"]).windows(2))
        {
            let (mut error_sum, mut totals) = (number(&pass["start_error_sum"]), vec![1.0; 15]);
            for (step, iteration) in entries(&pass["iterations"]).iter().enumerate() {
                let relaxation = number(
                    &inner[if step == 0 {
                        "first_relaxation"
                    } else {
                        "relaxation"
                    }],
                );
                let [changes, stiffness, unlimited, factors] = [
                    "error_changes",
                    "stiffness_changes",
                    "unlimited_factors",
                    "factors",
                ]
                .map(|key| numbers(&iteration[key]));
                let fraction = 0.5_f64.powi(number(&iteration["halvings"]) as i32);
                for e in 0..15 {
                    let c = 1.0 - relaxation * error_sum * changes[e] / stiffness[e];
                    assert!((c - unlimited[e]).abs() < MATRIX_ROUND_OFF * c.abs().max(1.0));
                    let limited =
                        totals[e] * (1.0 + fraction * (c.clamp(bounds[0], bounds[1]) - 1.0));
                    let is_at_total = iteration["limits"][e] == "total";
                    assert!(is_at_total || (limited - factors[e]).abs() < MATRIX_ROUND_OFF);
                    count += usize::from(!is_at_total);
                }
                (error_sum, totals) = (number(&iteration["error_sum"]), factors);
            }
            // The pass ends where its iterations led.
            let [before, after] = [0, 1].map(|at| numbers(&analyses[at]["factors"]));
            for e in 0..15 {
                assert!((after[e] / before[e] - totals[e]).abs() < MATRIX_ROUND_OFF);
            }
        }
        assert!(count > 0);
    }
}

#[test]
fn a_folder_gets_every_matrix_as_the_document_has_it() {
    let folder = new_folder();
    let path = folder.path().join("dump");
    let output = corfem(&["dump", "2", "--folder", &path.display().to_string()]);
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stdout.is_empty());
    assert_eq!(
        String::from_utf8_lossy(&output.stderr),
        format!("{} files in {}\n", 3 + 3 * 19, path.display())
    );
    assert!(
        corfem(&[
            "dump",
            "2",
            "--folder",
            &path.display().to_string(),
            "--quiet"
        ])
        .stderr
        .is_empty()
    );
    // T, V_G and the document; K_D, M, V, B and fifteen shares of the start and of both passes.
    assert_eq!(fs::read_dir(&path).expect("a folder").count(), 3 + 3 * 19);
    let mut dump: Value =
        serde_json::from_slice(&fs::read(path.join("dump.json")).expect("a file")).expect("JSON");
    let run = dump.as_object_mut().and_then(|dump| dump.remove("run"));
    assert_eq!(
        run,
        Some(concat!("corfem ", env!("CARGO_PKG_VERSION"), " dump 2").into())
    );
    assert_eq!(dump, dumped("2"));
    let stored = |name: &str| {
        let name = format!("{name}.mtx");
        let bytes = fs::read(Path::new(&path).join(&name)).expect("a file");
        read(&name, &bytes, None).expect("a matrix").matrix.dense()
    };
    // The last digit is the reader's of JSON; of a symmetric matrix the file has the lower triangle alone.
    let is_same = |name: &str, value: &Value| {
        let expected = matrix(value);
        (stored(name) - &expected).amax() < MATRIX_ROUND_OFF * expected.amax()
    };
    assert!(is_same("T", &dump["T"]) && is_same("V_G", &dump["test"]["V_G"]));
    for (number, analysis) in (1..).zip(entries(&dump["analyses"])) {
        for name in ["K_D", "M", "V", "B"] {
            assert!(is_same(
                &format!("analysis_{number}_{name}"),
                &analysis[name]
            ));
        }
        for (panel, share) in (1..).zip(entries(&analysis["shares"])) {
            assert!(is_same(&format!("analysis_{number}_share_{panel}"), share));
        }
    }
}
