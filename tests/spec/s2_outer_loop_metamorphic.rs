//! Metamorphic relations of whole correlations: what must not change when the same problem is put in another way.
//!
//! Every relation is asked of all four cases. A correlation of what was put differently must take as many iterations in every
//! pass and end at the same factors and the same error sum.

use crate::common::tolerances::SAME_CORRELATION;
use corfem::method::model::{Bounds, FiniteElementModel, Parameter};
use corfem::method::modes::ModeSet;
use corfem::method::outer_loop::{Correlation, correlate};
use corfem::method::structure::{Element, ElementKind, Grid, Structure};
use corfem::torque_box::{CASES, Case};
use nalgebra::{DMatrix, Rotation3, Vector3};

/// What a correlation is given.
#[derive(Clone)]
struct Given {
    grids: Vec<Grid>,
    elements: Vec<Element>,
    load_distribution: DMatrix<f64>,
    mass: DMatrix<f64>,
    parameters: Vec<Parameter>,
    test: ModeSet,
}

fn given(case: &Case) -> Given {
    let model = case.model().expect("a model");
    Given {
        grids: model.structure().grids().to_vec(),
        elements: model.structure().elements().to_vec(),
        load_distribution: model.load_distribution().clone(),
        mass: model.mass().clone(),
        parameters: model.parameters().to_vec(),
        test: case.test_modes().expect("test modes").into(),
    }
}

fn correlated(case: &Case, given: Given) -> Correlation {
    let Given {
        grids,
        elements,
        load_distribution,
        mass,
        parameters,
        test,
    } = given;
    let structure = Structure::new(grids, elements).expect("a structure");
    let model =
        FiniteElementModel::new(structure, load_distribution, mass, parameters).expect("a model");
    let ranges = model.factor_ranges().expect("ranges");
    let analyze = |factors: &[f64]| model.analyze(factors, &test, None);
    correlate(analyze, &ranges, &case.settings, |_, _| {}).expect("a correlation")
}

/// Asks of every case that putting it in another way changes nothing; `place` is where a parameter's factor then stands, of so many.
fn nothing_changes(put: impl Fn(&mut Given), place: impl Fn(usize, usize) -> usize) {
    for number in CASES {
        let case = Case::new(number).expect("a case");
        let first = given(&case);
        let count = first.parameters.len();
        let mut other = first.clone();
        put(&mut other);
        let (first, other) = (correlated(&case, first), correlated(&case, other));
        let iterations = |run: &Correlation| -> Vec<usize> {
            run.passes
                .iter()
                .map(|pass| pass.inner.iterations.len())
                .collect()
        };
        assert_eq!(iterations(&first), iterations(&other), "case {number}");
        let error_sums = |run: &Correlation| -> Vec<f64> {
            run.passes
                .iter()
                .map(|pass| pass.check.errors.sum())
                .collect()
        };
        for (a, b) in error_sums(&first).iter().zip(error_sums(&other)) {
            assert!((a - b).abs() <= SAME_CORRELATION, "case {number}: {a} {b}");
        }
        for (e, a) in first.best_factors.iter().enumerate() {
            let b = other.best_factors[place(e, count)];
            assert!(
                (a / b - 1.0).abs() <= SAME_CORRELATION,
                "case {number}, {e}: {a} {b}"
            );
        }
        // What was added has no effect, and so keeps its stiffness.
        for factor in &other.best_factors[count..] {
            assert!(
                (factor - 1.0).abs() <= SAME_CORRELATION,
                "case {number}: {factor}"
            );
        }
    }
}

fn in_place(e: usize, _: usize) -> usize {
    e
}

fn reversed(count: usize) -> Vec<usize> {
    (0..count).rev().collect()
}

#[test]
fn the_order_of_test_modes_does_not_matter() {
    nothing_changes(
        |given| {
            let order = reversed(given.test.len());
            let (squares, shapes) = given.test.clone().into_parts();
            given.test = ModeSet::new(squares.select_rows(&order), shapes.select_columns(&order))
                .expect("modes");
        },
        in_place,
    );
}

#[test]
fn the_order_of_parameters_does_not_matter() {
    nothing_changes(|given| given.parameters.reverse(), |e, count| count - 1 - e);
}

#[test]
fn the_order_of_sensors_does_not_matter() {
    nothing_changes(
        |given| {
            let order = reversed(given.mass.nrows());
            let shapes = given.test.shapes().select_rows(&order);
            given.test = given.test.with_shapes(shapes).expect("modes");
            given.load_distribution = given.load_distribution.select_columns(&order);
            given.mass = given.mass.select_rows(&order).select_columns(&order);
        },
        in_place,
    );
}

#[test]
fn the_direction_in_which_a_sensor_counts_does_not_matter() {
    nothing_changes(
        |given| {
            let mut shapes = given.test.shapes().clone();
            shapes.row_mut(2).neg_mut();
            given.test = given.test.with_shapes(shapes).expect("modes");
            given.load_distribution.column_mut(2).neg_mut();
            given.mass.row_mut(2).neg_mut();
            given.mass.column_mut(2).neg_mut();
        },
        in_place,
    );
}

#[test]
fn numbers_of_grids_and_elements_do_not_matter() {
    nothing_changes(
        |given| {
            let grid = |label: usize| 1000 - 7 * label;
            let old = Structure::new(given.grids.clone(), given.elements.clone());
            let old = old.expect("a structure").free_dof().to_vec();
            given.grids.reverse();
            given
                .grids
                .iter_mut()
                .for_each(|at| at.label = grid(at.label));
            given.elements.reverse();
            for element in &mut given.elements {
                element.label = 500 - element.label;
                element
                    .grids
                    .iter_mut()
                    .for_each(|label| *label = grid(*label));
            }
            for member in given.parameters.iter_mut().flat_map(|of| &mut of.members) {
                *member = 500 - *member;
            }
            let new = Structure::new(given.grids.clone(), given.elements.clone());
            let new = new.expect("a structure");
            let mut t = DMatrix::zeros(old.len(), given.load_distribution.ncols());
            for (row, dof) in old.iter().enumerate() {
                let to = new
                    .free_dof_index(grid(dof.grid), dof.direction)
                    .expect("a free DOF");
                t.row_mut(to).copy_from(&given.load_distribution.row(row));
            }
            given.load_distribution = t;
        },
        in_place,
    );
}

#[test]
fn millimeters_and_newtons_give_the_same_factors() {
    nothing_changes(
        |given| {
            let (length, force) = (25.4, 4.448_221_6);
            given
                .grids
                .iter_mut()
                .for_each(|grid| grid.position *= length);
            for element in &mut given.elements {
                element.material.youngs_modulus *= force / (length * length);
                element.material.shear_modulus *= force / (length * length);
                let is_rod = element.kind == ElementKind::Rod;
                element.size *= if is_rod { length * length } else { length };
            }
            for range in given
                .parameters
                .iter_mut()
                .flat_map(|of| &mut of.size_range)
            {
                *range = Bounds {
                    lower: range.lower * length,
                    upper: range.upper * length,
                };
            }
            given.mass *= force / length;
        },
        in_place,
    );
}

#[test]
fn where_the_structure_stands_and_how_it_is_turned_does_not_matter() {
    nothing_changes(
        |given| {
            let turn = Rotation3::from_euler_angles(0.3, -1.1, 2.0);
            for grid in &mut given.grids {
                grid.position = turn * grid.position + Vector3::new(30.0, -20.0, 5.0);
            }
            let t = &mut given.load_distribution;
            for block in 0..t.nrows() / 3 {
                let turned = turn.matrix() * t.fixed_rows::<3>(3 * block);
                t.fixed_rows_mut::<3>(3 * block).copy_from(&turned);
            }
        },
        in_place,
    );
}

#[test]
fn a_panel_is_two_of_half_its_gage() {
    nothing_changes(
        |given| {
            let mut twins = Vec::new();
            for element in given
                .elements
                .iter_mut()
                .filter(|of| of.kind != ElementKind::Rod)
            {
                element.size *= 0.5;
                twins.push(Element {
                    label: element.label + 200,
                    ..element.clone()
                });
            }
            given.elements.extend(twins);
            for parameter in &mut given.parameters {
                parameter.members.push(parameter.members[0] + 200);
                let half = |range: Bounds| Bounds {
                    lower: 0.5 * range.lower,
                    upper: 0.5 * range.upper,
                };
                parameter.size_range = parameter.size_range.map(half);
            }
        },
        in_place,
    );
}

#[test]
fn a_parameter_without_effect_changes_nothing() {
    nothing_changes(
        |given| {
            // A rod between two fixed grids.
            let rod = given.elements.last().expect("a rod").clone();
            given.elements.push(Element {
                label: 900,
                grids: vec![13, 14],
                ..rod
            });
            given.parameters.push(Parameter::element(900, None));
        },
        in_place,
    );
}

#[test]
fn the_unit_of_time_does_not_matter() {
    // Four times the mass, half the frequencies.
    nothing_changes(
        |given| {
            let (squares, shapes) = given.test.clone().into_parts();
            given.test = ModeSet::new(0.25 * squares, shapes).expect("modes");
            given.mass *= 4.0;
        },
        in_place,
    );
}

#[test]
fn a_modulus_common_to_model_and_test_does_not_matter() {
    nothing_changes(
        |given| {
            for element in &mut given.elements {
                element.material.youngs_modulus *= 4.0;
                element.material.shear_modulus *= 4.0;
            }
            let (squares, shapes) = given.test.clone().into_parts();
            given.test = ModeSet::new(4.0 * squares, shapes).expect("modes");
        },
        in_place,
    );
}
