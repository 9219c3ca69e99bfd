//! Support conditions (section 3.0 of the paper): fixed-free, fixed-fixed, and free on a soft suspension.
//!
//! ```text
//!   |--A1--o--A2--o--A3--o--A4--o--A5--o  |     axial rods of 10 in, unequal masses at the joints,
//!   1      2      3      4      5      6  7     x alone is free; soft: rods of 1e-6 in² to ground instead of a wall
//! ```
//!
//! The test structure has other areas than the model. All its elastic modes are measured; the method must find the areas.

use crate::prelude::*;

const MASSES: [f64; 6] = [0.010, 0.012, 0.009, 0.014, 0.011, 0.013];
/// Area of a suspension rod: softer than the structure by six decades.
const SOFT_AREA: f64 = 1e-6;
const TRUE_AREAS: [f64; 5] = [1.0, 1.0, 1.0, 1.0, 1.0];
const MODEL_AREAS: [f64; 5] = [1.3, 0.8, 1.2, 0.75, 1.1];

#[derive(Clone, Copy, PartialEq)]
enum Support {
    FixedFree,
    FixedFixed,
    SoftSuspension,
}

/// Rods between joints 1 to 6 along x, joint 1 and 6 supported as asked.
fn chain(areas: [f64; 5], support: Support) -> Result<FiniteElementModel, Error> {
    let material = Material::isotropic(1.0e7, 0.3)?;
    let constrained = |label| match support {
        Support::FixedFree => label == 1,
        Support::FixedFixed => label == 1 || label == 6,
        Support::SoftSuspension => false,
    };
    let mut grids = (1..=6)
        .map(|label| Grid {
            label,
            position: Vector3::new(10.0 * label as f64, 0.0, 0.0),
            constrained: [constrained(label), true, true],
        })
        .collect_vec();
    let rod = |label: usize, ends: [usize; 2], size| Element {
        label,
        kind: ElementKind::Rod,
        grids: ends.to_vec(),
        size,
        material,
    };
    let mut elements = areas
        .iter()
        .enumerate()
        .map(|(k, &area)| rod(k + 1, [k + 1, k + 2], area))
        .collect_vec();
    if support == Support::SoftSuspension {
        for (label, joint, x) in [(101, 1, 0.0), (102, 6, 70.0)] {
            grids.push(Grid {
                label,
                position: Vector3::new(x, 0.0, 0.0),
                constrained: [true; 3],
            });
            elements.push(rod(label, [joint, label], SOFT_AREA));
        }
    }
    let structure = Structure::new(grids, elements)?;
    let free = structure.free_dof().to_vec();
    let masses = free.iter().map(|dof| MASSES[dof.grid - 1]).collect_vec();
    FiniteElementModel::new(
        structure,
        eye(free.len()),
        DMatrix::from_diagonal(&DVector::from_vec(masses)),
        (1..=5)
            .map(|label| Parameter::new(label, &[label]))
            .collect(),
    )
}

/// Correlates the wrong chain with the modes of the right one, its `rigid` lowest left out.
fn correlated(support: Support, rigid: usize) -> (Correlation, Modes) {
    let truth = chain(TRUE_AREAS, support)
        .unwrap()
        .matrices(&[1.0; 5])
        .unwrap();
    let count = truth.mass.nrows();
    let all = solve(&truth.stiffness, &truth.mass, count).unwrap();
    let test = Modes::new(
        all.omega_squared().rows(rigid, count - rigid).into_owned(),
        all.shapes().columns(rigid, count - rigid).into_owned(),
    )
    .unwrap();
    let model = chain(MODEL_AREAS, support).unwrap();
    let mut settings = Settings {
        least_passes: 3,
        ..Settings::default()
    };
    // Exact test modes of a small chain: ask for more than the paper did.
    settings.inner.tolerance = 0.002;
    settings.later_inner_tolerance = 0.002;
    let settings = settings.for_modes(test.len());
    let ranges = model.factor_ranges().unwrap();
    let result = correlate(
        |factors| model.analyze(factors, &test, None),
        &ranges,
        &settings,
        |_, _| true,
    )
    .unwrap();
    (result, all)
}

fn assert_areas_found(result: &Correlation) {
    assert!(result.converged);
    let last = result.passes.last().unwrap();
    for ((factor, model), truth) in last.factors.iter().zip(MODEL_AREAS).zip(TRUE_AREAS) {
        let area = factor * model;
        assert!(
            relative_error(area, truth) < RECOVERED_AREA,
            "{area} for {truth}"
        );
    }
}

#[test]
fn fixed_free_chain_is_found_again() {
    let (result, modes) = correlated(Support::FixedFree, 0);
    assert_eq!(modes.len(), 5);
    assert_areas_found(&result);
}

#[test]
fn fixed_fixed_chain_is_found_again() {
    let (result, modes) = correlated(Support::FixedFixed, 0);
    assert_eq!(modes.len(), 4);
    assert_areas_found(&result);
}

#[test]
fn free_chain_on_a_soft_suspension_is_found_again_without_its_rigid_body_mode() {
    let (result, modes) = correlated(Support::SoftSuspension, 1);
    let frequencies = modes.frequencies_hz();
    // The suspension's own mode lies far below the elastic ones, and all joints move alike in it.
    assert!(frequencies[0] < 0.01 * frequencies[1]);
    let rigid = modes.shapes().column(0);
    assert!((rigid.max() - rigid.min()) / rigid.amax() < RIGID_ON_SUSPENSION);
    assert_areas_found(&result);
    // The test has five modes and the model six: the lowest, rigid one answers none of them.
    assert_eq!(result.initial.modes.len(), 6);
    let last = result.passes.last().unwrap();
    assert!(
        last.check
            .pairing
            .analysis_mode
            .iter()
            .all(|&mode| mode != 0)
    );
}

#[test]
fn chain_that_nothing_holds_is_refused() {
    let model = chain(MODEL_AREAS, Support::FixedFree).unwrap();
    let grids = model.structure().grids().iter().map(|grid| Grid {
        constrained: [false, true, true],
        ..grid.clone()
    });
    let free = Structure::new(grids.collect(), model.structure().elements().to_vec()).unwrap();
    let mass = DMatrix::from_diagonal(&DVector::from_row_slice(&MASSES));
    let parameters = vec![Parameter::new(1, &[1])];
    let model = FiniteElementModel::new(free, eye(6), mass, parameters).unwrap();
    let error = model.matrices(&[1.0]).expect_err("it moves as a whole");
    assert!(
        matches!(error, Error::SingularStiffness { direction: 'x', .. }),
        "{error}"
    );
}
