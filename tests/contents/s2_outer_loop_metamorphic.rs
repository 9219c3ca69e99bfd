//! Metamorphic relations of whole correlations: what must not change when the same problem is put in another way.
//!
//! Every relation is asked of all four cases, and those that any structure has of random frames too. A correlation of what was put
//! differently must take as many iterations in every pass and end at the same factors and the same error sum.
//!
//! The error sum is a root over all modes and all DOF, so that the steps of two structures that nothing couples depend on each
//! other: that each then comes out as alone is a law of weighted correlations (`weighted_metamorphic.rs`).

use crate::prelude::*;

/// What a correlation is given.
#[derive(Debug, Clone)]
struct Given {
    name: String,
    grids: Vec<Grid>,
    elements: Vec<Element>,
    load_distribution: DMatrix<f64>,
    mass: DMatrix<f64>,
    parameters: Vec<Parameter>,
    test: Modes,
    analysis_modes: Option<usize>,
    settings: Settings,
}

fn given(number: usize) -> Given {
    let case = case_of(number);
    let model = case.model().unwrap();
    let test = case.test_modes().unwrap();
    Given::of(format!("case {number}"), &model, test, case.settings)
}

/// A braced linkage with masses at its two upper corners, and its modes with other areas, from which it can be corrected.
fn frame() -> impl Strategy<Value = Given> {
    let factor = (1.1..1.4_f64, any::<bool>());
    let factor = factor.prop_map(|(factor, is_less)| if is_less { 1.0 / factor } else { factor });
    let masses = prop::collection::vec(1.0..4.0_f64, 4);
    (linkage_data(), masses, prop::collection::vec(factor, 4)).prop_filter_map(
        "modes that stay apart, and a correlation that comes to its end",
        |((apex, areas), masses, truth)| {
            // Areas within a factor of three, so that no rod is beyond what the test sees.
            let structure = linkage(apex, areas.map(|area| area.powf(0.25)), true);
            let mass = diagonal(masses);
            let rods = (1..=4).map(|rod| Parameter::new(rod, &[rod])).collect();
            let model = FiniteElementModel::new(structure, eye(4), mass, rods).unwrap();
            let test = model.modes(&truth).unwrap();
            let settings = Settings {
                error_sum_tolerance: 0.01,
                later_inner_tolerance: 0.005,
                most_passes: 3,
                ..Settings::default()
            };
            let settings = settings.for_modes(test.len());
            let given = Given::of(
                format!("frame {apex:?} {areas:?} {truth:?}"),
                &model,
                test,
                settings,
            );
            // Round-off grows with every step: a loop that wanders for hundreds of them ends elsewhere in the seventh digit.
            let amplified = given.amplification(true)?;
            (amplified <= MOST_AMPLIFIED).then_some(given)
        },
    )
}

impl Given {
    fn of(name: String, model: &FiniteElementModel, test: Modes, settings: Settings) -> Self {
        Self {
            name,
            grids: model.structure().grids().to_vec(),
            elements: model.structure().elements().to_vec(),
            load_distribution: model.load_distribution().clone(),
            mass: model.mass().clone(),
            parameters: model.parameters().to_vec(),
            test,
            analysis_modes: None,
            settings,
        }
    }

    fn structure(&self) -> Structure {
        Structure::new(self.grids.clone(), self.elements.clone()).unwrap()
    }

    fn model(&self) -> FiniteElementModel {
        FiniteElementModel::new(
            self.structure(),
            self.load_distribution.clone(),
            self.mass.clone(),
            self.parameters.clone(),
        )
        .unwrap()
    }

    fn correlated(&self) -> Correlation {
        let found = self.try_correlated();
        found.unwrap_or_else(|error| panic!("{}: {error}", self.name))
    }

    fn try_correlated(&self) -> Result<Correlation, Error> {
        let model = self.model();
        let ranges = model.factor_ranges().unwrap();
        let analyze = |factors: &[f64]| model.analyze(factors, &self.test, self.analysis_modes);
        correlate(analyze, &ranges, &self.settings, |_, _| true)
    }

    /// Largest relative change of a factor, and change of an error sum, that a correlation ends with for one of the test frequencies;
    /// none where it takes other iterations then, is refused, or does not come to its end where it must.
    fn amplification(&self, must_converge: bool) -> Option<f64> {
        let mut shaken = self.clone();
        alter(&mut shaken.test, |squares, _| {
            for (mode, square) in squares.iter_mut().enumerate() {
                *square *= if mode % 2 == 0 {
                    1.0 + SHAKE
                } else {
                    1.0 - SHAKE
                };
            }
        });
        let (first, other) = (self.try_correlated().ok()?, shaken.try_correlated().ok()?);
        let is_alike = iterations(&first) == iterations(&other);
        let is_there = is_alike && (first.converged || !must_converge);
        is_there.then(|| difference([&first, &other], in_place) / SHAKE)
    }

    /// Loads the DOF of the structure as it is now as those of before were loaded; others not at all. `from` is what a DOF was
    /// before, if it was there.
    fn loaded_as(
        &mut self,
        before: &[StructuralDof],
        from: impl Fn(StructuralDof) -> Option<StructuralDof>,
    ) {
        let now = self.structure();
        let mut t = DMatrix::zeros(now.free_dof().len(), self.load_distribution.ncols());
        for (row, dof) in now.free_dof().iter().enumerate() {
            let old = from(*dof).and_then(|old| before.iter().position(|dof| *dof == old));
            if let Some(old) = old {
                t.row_mut(row).copy_from(&self.load_distribution.row(old));
            }
        }
        self.load_distribution = t;
    }

    /// Adds a grid that moves along one direction alone, beyond a grid, on a rod of the last one's kind.
    fn add_on_rod(&mut self, beyond: usize, direction: usize) {
        let at = self.grids.iter().find(|grid| grid.label == beyond).unwrap();
        let mut offset = Vector3::zeros();
        offset[direction] = 7.0;
        let mut constrained = [true; 3];
        constrained[direction] = false;
        self.grids.push(Grid {
            label: ADDED,
            position: at.position + offset,
            constrained,
        });
        let rod = self.elements.last().unwrap().clone();
        assert_eq!(rod.kind, ElementKind::Rod);
        self.elements.push(Element {
            label: ADDED,
            grids: vec![beyond, ADDED],
            ..rod
        });
    }
}

/// Label of what a relation adds.
const ADDED: usize = 900;

/// Asserts that two correlations are the same; `place` is where a parameter's factor stands in the other, of so many.
fn assert_same(
    name: &str,
    first: &Correlation,
    other: &Correlation,
    place: impl Fn(usize, usize) -> usize,
) {
    assert_same_within(SAME_CORRELATION, name, [first, other], place);
}

/// Asserts that two correlations are the same within a bar.
fn assert_same_within(
    bar: f64,
    name: &str,
    [first, other]: [&Correlation; 2],
    place: impl Fn(usize, usize) -> usize,
) {
    assert_eq!(iterations(first), iterations(other), "{name}");
    let count = first.best_factors.len();
    let apart = difference([first, other], place);
    assert!(apart <= bar, "{name}: {apart:e} for {bar:e}");
    // What was added has no effect, and so keeps its stiffness.
    for factor in &other.best_factors[count..] {
        assert_within(factor, 1.0, bar);
    }
}

/// Iterations of every pass.
fn iterations(run: &Correlation) -> Vec<usize> {
    let passes = run.passes.iter();
    passes.map(|pass| pass.inner.iterations.len()).collect()
}

/// Largest relative difference of the factors of two correlations of as many passes, and difference of their error sums; `place` is
/// where a parameter's factor stands in the other, of so many.
fn difference([first, other]: [&Correlation; 2], place: impl Fn(usize, usize) -> usize) -> f64 {
    let sum = |pass: &Pass| pass.check.errors.sum();
    let passes = first.passes.iter().zip(&other.passes);
    let sums = passes.map(|(a, b)| (sum(a) - sum(b)).abs());
    let count = first.best_factors.len();
    let factors = first.best_factors.iter().enumerate();
    let factors = factors.map(|(e, a)| relative_error(a, other.best_factors[place(e, count)]));
    // NaN counts as the largest.
    let worse = |a: f64, b: f64| if b <= a { a } else { b };
    sums.chain(factors).fold(0.0, worse)
}

/// Asks of a correlation that putting it in another way changes nothing.
fn stays(first: &Given, put: impl Fn(&mut Given), place: impl Fn(usize, usize) -> usize) {
    let mut other = first.clone();
    put(&mut other);
    assert_same(&first.name, &first.correlated(), &other.correlated(), place);
}

/// Asks of every case that putting it in another way changes nothing.
fn nothing_changes(put: impl Fn(&mut Given), place: impl Fn(usize, usize) -> usize) {
    for number in CASES {
        stays(&given(number), &put, &place);
    }
}

/// Asks something of random frames.
fn of_frames(ask: impl Fn(&Given)) {
    let mut runner = TestRunner::new(costly_config());
    let asked = runner.run(&frame(), |frame| {
        ask(&frame);
        Ok(())
    });
    asked.unwrap();
}

/// Asks of every case and of random frames that putting it in another way changes nothing.
fn nothing_changes_anywhere(put: impl Fn(&mut Given), place: impl Fn(usize, usize) -> usize) {
    nothing_changes(&put, &place);
    of_frames(|first| stays(first, &put, &place));
}

fn in_place(e: usize, _: usize) -> usize {
    e
}

fn reversed(count: usize) -> Vec<usize> {
    (0..count).rev().collect()
}

#[test]
fn the_order_of_test_modes_does_not_matter() {
    nothing_changes_anywhere(
        |given| {
            let order = reversed(given.test.len());
            alter(&mut given.test, |squares, shapes| {
                (*squares, *shapes) = (squares.select_rows(&order), shapes.select_columns(&order));
            });
        },
        in_place,
    );
}

#[test]
fn the_order_of_parameters_does_not_matter() {
    nothing_changes_anywhere(|given| given.parameters.reverse(), |e, count| count - 1 - e);
}

#[test]
fn the_order_of_sensors_does_not_matter() {
    nothing_changes_anywhere(
        |given| {
            let order = reversed(given.mass.nrows());
            alter(&mut given.test, |_, shapes| {
                *shapes = shapes.select_rows(&order)
            });
            given.load_distribution = given.load_distribution.select_columns(&order);
            given.mass = given.mass.select_rows(&order).select_columns(&order);
        },
        in_place,
    );
}

#[test]
fn the_direction_in_which_a_sensor_counts_does_not_matter() {
    nothing_changes_anywhere(
        |given| {
            alter(&mut given.test, |_, shapes| shapes.row_mut(2).neg_mut());
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
            let before = given.structure().free_dof().to_vec();
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
            for member in given.parameters.iter_mut().flat_map(|of| &mut of.elements) {
                *member = 500 - *member;
            }
            given.loaded_as(&before, |dof| {
                let grid = before.iter().find(|old| grid(old.grid) == dof.grid)?.grid;
                Some(StructuralDof { grid, ..dof })
            });
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
                parameter.elements.push(parameter.elements[0] + 200);
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
            let rod = given.elements.last().unwrap().clone();
            given.elements.push(Element {
                label: ADDED,
                grids: vec![13, 14],
                ..rod
            });
            given.parameters.push(Parameter::new(ADDED, &[ADDED]));
        },
        in_place,
    );
}

#[test]
fn the_unit_of_time_does_not_matter() {
    // Four times the mass, half the frequencies.
    nothing_changes_anywhere(
        |given| {
            alter(&mut given.test, |squares, _| *squares *= 0.25);
            given.mass *= 4.0;
        },
        in_place,
    );
}

#[test]
fn a_modulus_common_to_model_and_test_does_not_matter() {
    nothing_changes_anywhere(
        |given| {
            for element in &mut given.elements {
                element.material.youngs_modulus *= 4.0;
                element.material.shear_modulus *= 4.0;
            }
            alter(&mut given.test, |squares, _| *squares *= 4.0);
        },
        in_place,
    );
}

#[test]
fn the_mirror_image_is_corrected_alike() {
    nothing_changes_anywhere(
        |given| {
            let (structure, x) = (given.structure(), 0);
            for grid in &mut given.grids {
                grid.position[x] = 40.0 - grid.position[x];
            }
            for (row, dof) in structure.free_dof().iter().enumerate() {
                if dof.direction == x {
                    given.load_distribution.row_mut(row).neg_mut();
                }
            }
        },
        in_place,
    );
}

/// A grid at the free end of a rod, without mass: no force reaches it.
#[test]
fn a_dof_without_load_changes_nothing() {
    nothing_changes_anywhere(
        |given| {
            let before = given.structure().free_dof().to_vec();
            let StructuralDof { grid, direction } = before[0];
            given.add_on_rod(grid, direction);
            given.loaded_as(&before, Some);
        },
        in_place,
    );
}
