//! Appendix B, the general formulae of Appendix C, gradients, and exact checks of truncated sets, against numpy's
//! (golden/reference/appendices.py).

use crate::common::matrices::relative_distance;
use crate::common::tolerances::{
    EXPECTED_FREQUENCY, EXPECTED_GRADIENT, EXPECTED_HISTORY, MATRIX_ROUND_OFF,
};
use approx::assert_relative_eq;
use corfem::method::appendix_b::{balance, orthogonalize};
use corfem::method::appendix_c::Perturbed;
use corfem::method::appendix_c::eigensolution;
use corfem::method::appendix_c::general::{
    ModalChange, original, recursive_1, recursive_1_converged, recursive_2,
};
use corfem::method::derivatives::gradient;
use corfem::method::model::{DynamicModel, ModalModel, ParameterMatrix};
use corfem::method::modes::ModeSet;
use corfem::method::state::ModalState;
use corfem::torque_box::Case;
use corfem::torque_box::fewer_modes::{PUBLISHED_CASE, published_runs};
use nalgebra::{Complex, DMatrix, DVector};
use toml::{Table, Value};

fn expected() -> Table {
    include_str!("../../golden/reference/expected_appendices.toml")
        .parse()
        .expect("the golden reads")
}

fn number(value: &Value) -> f64 {
    value
        .as_float()
        .or(value.as_integer().map(|integer| integer as f64))
        .expect("a number")
}

/// Rows as a matrix; a list is a column.
fn matrix(value: &Value) -> DMatrix<f64> {
    let rows = value.as_array().expect("a list");
    match rows.first().and_then(Value::as_array) {
        Some(first) => DMatrix::from_fn(rows.len(), first.len(), |i, j| {
            number(&rows[i].as_array().expect("a row")[j])
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
    let raw = ModeSet::new(omega_squared, matrix(&table["raw"])).expect("modes");
    let balanced =
        balance(&raw, &stiffness, &mass, &matrix(&table["rigid_body"])).expect("balanced");
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
    let found = orthogonalize(
        &raw.with_shapes(balanced.shapes).expect("shapes that fit"),
        &mass,
    )
    .expect("orthogonal");
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
                .collect::<Vec<_>>(),
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
        let change = ModalChange {
            generalized_stiffness: k.map(Complex::from),
            roots: k.map(|k| Complex::from(1.0 / k)),
            beta: complex(table, "beta"),
            alpha: complex(table, "alpha"),
        };
        assert_perturbed(table, "original", &original(&change).expect("apart"));
        for order in [1, 2, 3, 5] {
            assert_perturbed(
                table,
                &format!("recursive_1_{order}"),
                &recursive_1(&change, order).expect("apart"),
            );
            assert_perturbed(
                table,
                &format!("recursive_2_{order}"),
                &recursive_2(&change, order).expect("apart"),
            );
        }
        let settled = recursive_1_converged(&change, 1e-15, 200)
            .expect("it settles")
            .perturbed;
        assert_perturbed(table, "exact", &settled);
        if name == "symmetric" {
            let real = |matrix: &DMatrix<Complex<f64>>| matrix.map(|entry| entry.re);
            let exact = ModalChange::of_vibrations(&k, real(&change.beta), real(&change.alpha));
            let Perturbed { roots, shapes } = eigensolution(&exact).expect("solved");
            let exact = Perturbed {
                roots: roots.map(Complex::from),
                shapes: shapes.map(Complex::from),
            };
            assert_perturbed(table, "exact", &exact);
        }
    }
}

fn assert_gradient(what: &str, model: &ModalModel, expected: &Value) {
    let found = gradient(model, &ModalState::start(model)).expect("a gradient");
    assert_near(what, &column(&found), expected, EXPECTED_GRADIENT);
}

/// Gradients by gages and by point masses where the cases begin, with all modes and with fewer.
#[test]
fn gradients_are_numpys() {
    for (number, tests, analysis) in [
        (1, 9, 9),
        (2, 9, 9),
        (3, 9, 9),
        (4, 9, 9),
        (2, 5, 9),
        (2, 5, 5),
        (2, 3, 7),
    ] {
        let table = &expected()
            [&format!("gradient, case {number}, {tests} test and {analysis} analysis modes")];
        let case = Case::new(number).expect("a case");
        let test = ModeSet::from(
            case.test_modes()
                .expect("solved")
                .lowest(tests)
                .expect("as many"),
        );
        let (model, ones) = (case.model().expect("a model"), [1.0; 15]);
        let modal = model.analyze(&ones, &test, Some(analysis)).expect("solved");
        assert_gradient("stiffness", &modal, &table["stiffness"]);
        let DynamicModel {
            stiffness, mass, ..
        } = model.matrices(&ones).expect("solved");
        let of_point = |dof: usize| {
            ParameterMatrix::Mass(DMatrix::from_fn(9, 9, |i, j| {
                if i == dof { mass[(i, j)] } else { 0.0 }
            }))
        };
        let shares = (0..9).map(of_point).collect();
        let modal = DynamicModel {
            stiffness,
            mass: mass.clone(),
            shares,
        }
        .analyze(&test, Some(analysis));
        assert_gradient("mass", &modal.expect("solved"), &table["mass"]);
    }
}

#[test]
fn exact_checks_of_truncated_sets_are_numpys() {
    for run in published_runs(&Case::new(PUBLISHED_CASE).expect("a case")).expect("they run") {
        let table = &expected()[&format!(
            "case 2, {} test and {} analysis modes",
            run.test_modes, run.analysis_modes
        )];
        let frequencies = column(&run.exact.frequencies_hz[..run.test_modes]);
        assert_near(
            "frequencies",
            &frequencies,
            &table["frequencies"],
            EXPECTED_FREQUENCY,
        );
        let [frequency, shape] = list(&table["rms"])[..] else {
            panic!("two errors")
        };
        assert_relative_eq!(
            run.exact.frequency_rms,
            frequency,
            max_relative = EXPECTED_HISTORY
        );
        assert_relative_eq!(run.exact.shape_rms, shape, max_relative = EXPECTED_HISTORY);
    }
}
