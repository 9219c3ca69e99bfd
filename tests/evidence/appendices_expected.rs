//! Appendix B, the general formulae of Appendix C, and exact checks of truncated sets, against numpy's
//! (golden/reference/appendices.py).

use crate::common::appendix_c::diagonal_pencil;
use crate::prelude::*;
use toml::{Table, Value};

fn expected() -> Table {
    include_str!("../../golden/reference/expected_appendices.toml")
        .parse()
        .unwrap()
}

fn number(value: &Value) -> f64 {
    value
        .as_float()
        .or(value.as_integer().map(|integer| integer as f64))
        .unwrap()
}

/// Rows as a matrix; a list is a column.
fn matrix(value: &Value) -> DMatrix<f64> {
    let rows = value.as_array().unwrap();
    match rows.first().and_then(Value::as_array) {
        Some(first) => DMatrix::from_fn(rows.len(), first.len(), |i, j| {
            number(&rows[i].as_array().unwrap()[j])
        }),
        None => DMatrix::from_fn(rows.len(), 1, |i, _| number(&rows[i])),
    }
}

fn list(value: &Value) -> Vec<f64> {
    matrix(value).as_slice().to_vec()
}

fn assert_near(what: &str, found: &DMatrix<f64>, expected: &Value, tolerance: f64) {
    let distance = relative_distance(found, &matrix(expected));
    assert!(distance < tolerance, "{what}: {distance:e}");
}

fn column(values: &[f64]) -> DMatrix<f64> {
    DMatrix::from_column_slice(values.len(), 1, values)
}

/// Balance by its own two equations, and the combinations that are orthogonal, of a beam on springs.
#[test]
fn appendix_b_is_numpys() {
    let table = &expected()["appendix_b"];
    let (stiffness, mass) = (matrix(&table["stiffness"]), matrix(&table["mass"]));
    let omega_squared = DVector::from_vec(list(&table["omega_squared"]));
    let raw = Modes::new(omega_squared, matrix(&table["raw"])).unwrap();
    let balanced = balance(&raw, &stiffness, &mass, &matrix(&table["rigid_body"])).unwrap();
    assert_near(
        "coefficients",
        &balanced.coefficients,
        &table["coefficients"],
        MATRIX_ROUND_OFF,
    );
    assert_near(
        "balanced",
        &balanced.shapes,
        &table["balanced"],
        MATRIX_ROUND_OFF,
    );
    assert_near(
        "change",
        &column(&balanced.change),
        &table["change"],
        MATRIX_ROUND_OFF,
    );
    let balanced = Modes::new(raw.omega_squared().clone(), balanced.shapes).unwrap();
    let found = orthogonalize(&balanced, &mass).unwrap();
    assert_near(
        "overlap",
        &found.overlap,
        &table["overlap"],
        MATRIX_ROUND_OFF,
    );
    let squares = column(found.modes.omega_squared().as_slice());
    assert_near(
        "squares",
        &squares,
        &table["orthogonal_omega_squared"],
        MATRIX_ROUND_OFF,
    );
    assert_near(
        "orthogonal",
        found.modes.shapes(),
        &table["orthogonal"],
        MATRIX_ROUND_OFF,
    );
    let [frequency, shape] = [0, 1].map(|part| {
        column(
            &found
                .movement
                .iter()
                .map(|moved| [moved.frequency, moved.shape][part])
                .collect_vec(),
        )
    });
    assert_near(
        "frequency movement",
        &frequency,
        &table["frequency_movement"],
        MATRIX_ROUND_OFF,
    );
    assert_near(
        "shape movement",
        &shape,
        &table["shape_movement"],
        MATRIX_ROUND_OFF,
    );
}

/// The changed modes of numpy under a name; imaginary parts where there are any.
fn complex(table: &Value, name: &str) -> DMatrix<Complex<f64>> {
    let real = matrix(&table[name]);
    let imaginary = table
        .get(format!("{name}_imaginary"))
        .map_or(0.0 * &real, matrix);
    real.zip_map(&imaginary, Complex::new)
}

fn assert_perturbed(table: &Value, rule: &str, found: &Perturbed<Complex<f64>>) {
    let (roots, shapes) = (
        complex(table, &format!("{rule}_roots")),
        complex(table, &format!("{rule}_shapes")),
    );
    let apart = (&found.shapes - shapes).map(Complex::norm).max();
    let roots_apart = found
        .roots
        .zip_map(&roots.column(0), |found, root| (found / root - 1.0).norm())
        .max();
    assert!(
        apart.max(roots_apart) < MATRIX_ROUND_OFF,
        "{rule}: {roots_apart:e} {apart:e}"
    );
}

/// Changes of stiffness and mass: symmetric, unsymmetric, and complex.
#[test]
fn the_general_formulae_are_numpys() {
    for name in ["symmetric", "unsymmetric", "complex"] {
        let table = &expected()[&format!("appendix_c_{name}")];
        let k = DVector::from_vec(list(&table["k"]));
        let [beta, alpha] = ["beta", "alpha"].map(|name| complex(table, name));
        let pencil = diagonal_pencil(&k, &beta, &alpha);
        assert_perturbed(table, "original", &pencil.original().unwrap());
        for order in [1, 2, 3, 5] {
            assert_perturbed(
                table,
                &format!("recursive_1_{order}"),
                &pencil.recursive_1(order).unwrap(),
            );
            assert_perturbed(
                table,
                &format!("recursive_2_{order}"),
                &pencil.recursive_2(order).unwrap(),
            );
        }
        let settled = pencil.recursive_1_converged().unwrap();
        assert_perturbed(table, "exact", &settled.perturbed);
        if name == "symmetric" {
            let real = |matrix: &DMatrix<Complex<f64>>| matrix.map(|entry| entry.re);
            let exact = ModalChange::of_vibrations(&k, real(&beta), real(&alpha));
            let Perturbed { roots, shapes } = eigensolution(&exact).unwrap();
            let exact = Perturbed {
                roots: roots.map(Complex::from),
                shapes: shapes.map(Complex::from),
            };
            assert_perturbed(table, "exact", &exact);
        }
    }
}
