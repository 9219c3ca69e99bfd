//! Decks: the identity of writing and reading, and the theorem that NASTRAN's reduction of a deck is Appendix A.

use crate::common::decks::bulk_text as written;
use crate::prelude::*;

properties! {
    #[test]
    fn deck_to_model_to_deck_is_the_identity(model in bulk_data()) {
        let text = written(&model)?;
        let read = deck::read("deck", text.as_bytes(), &[])?;
        prop_assert_eq!(&read.model, &model);
        prop_assert!(read.unread.iter().all(|card| card.reason == deck::Reason::Untouched));
        prop_assert_eq!(written(&read.model)?, text);
    }

    /// $(K_S, T M T^t)$ has d finite roots, those of $(K_D, M)$, for any stiffness, full-rank T and masses.
    #[test]
    fn finite_roots_of_the_singular_pencil_are_those_of_the_dynamic_one(
        (stiffness, _) in positive_definite(6, 3.0),
        directions in orthogonal(6),
        scales in prop::collection::vec(0.1..10.0_f64, 4),
        masses in prop::collection::vec(0.1..10.0_f64, 4),
    ) {
        let t = directions.columns(0, 4) * DMatrix::from_diagonal(&scales.into());
        let mass = DMatrix::from_diagonal(&masses.into());
        let flexibility = t.tr_mul(&stiffness.clone().try_inverse().unwrap()) .clone() * &t;
        let dynamic_stiffness = flexibility.try_inverse().unwrap();
        let dynamic = solve(&symmetric(&dynamic_stiffness), &mass, 4)?;
        let roots = singular_pencil_roots(&stiffness, &(&t * &mass * t.transpose()));
        prop_assert_eq!(roots.len(), 6);
        for (omega_squared, root) in dynamic.omega_squared().iter().zip(&roots) {
            // The condition of the flexibility is that of the stiffness times that of T squared: 1e3 times 1e4.
            prop_assert!((omega_squared * root - 1.0).abs() < SINGULAR_MASS_ROOT, "{} {}", omega_squared, root);
        }
        for root in &roots[4..] {
            prop_assert!(root.abs() < SINGULAR_MASS_ROOT * roots[3], "{:?}", roots);
        }
    }
}

fn symmetric(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    0.5 * (matrix + matrix.transpose())
}

/// All roots $\lambda = 1/\omega^2$ of $\lambda K v = M v$, largest first, by nalgebra: zero where $\omega$ is infinite.
fn singular_pencil_roots(stiffness: &DMatrix<f64>, mass: &DMatrix<f64>) -> Vec<f64> {
    let lower = stiffness.clone().cholesky().unwrap().l();
    let half = lower.solve_lower_triangular(mass).unwrap();
    let reduced = lower.solve_lower_triangular(&half.transpose()).unwrap();
    let mut roots = SymmetricEigen::new(symmetric(&reduced))
        .eigenvalues
        .iter()
        .copied()
        .collect_vec();
    roots.sort_by(|a, b| b.total_cmp(a));
    roots
}

#[test]
fn nine_finite_roots_of_the_box_are_its_dynamic_modes() {
    for number in CASES {
        let case = case_of(number);
        let model = case.model().unwrap();
        let dynamic = model.matrices(&[1.0; 15]).unwrap();
        let modes = solve(&dynamic.stiffness, &dynamic.mass, 9).unwrap();
        let sizes = model.sizes(&[1.0; 15]).unwrap();
        let stiffness = assemble(model.element_matrices(), &sizes, 36).unwrap();
        let t = &model.load_distribution().clone();
        let roots = singular_pencil_roots(&stiffness, &(t * model.mass() * t.transpose()));
        assert_eq!(roots.len(), 36);
        for (omega_squared, root) in modes.omega_squared().iter().zip(&roots) {
            assert_relative_eq!(omega_squared * root, 1.0, epsilon = SINGULAR_MASS_ROOT);
        }
        assert!(
            roots[9].abs() < SINGULAR_MASS_ROOT * roots[8],
            "case {number}: {roots:?}"
        );
    }
}

/// The deck of a case at its first gages times `factors`.
fn box_deck(number: usize, factors: &[f64]) -> (BulkData, String) {
    let case = case_of(number);
    let points = dynamic_points(&case.reconstruction).unwrap();
    let bulk = BulkData::from_model(&case.model().unwrap(), factors, &points).unwrap();
    let task = Task::Modes {
        count: 9,
        range_hz: [5.0, 3000.0],
    };
    let text = deck::write(&bulk, "box", &task).unwrap();
    (bulk, text)
}

#[test]
fn the_box_read_from_its_deck_has_its_modes() {
    for number in CASES {
        let factors = (0..15).map(|row| 1.0 + f64::from(row) / 7.0).collect_vec();
        let (_, text) = box_deck(number, &factors);
        let read = deck::read("box", text.as_bytes(), &[]).unwrap();
        assert!(read.unread.is_empty(), "{:?}", read.unread);
        let found = deck::modes(&read.model, usize::MAX).unwrap();
        let model = case_of(number).model().unwrap();
        // By the same factorization, so that the digits of the deck are all that differs.
        let (whole, sensors) = whole::of(&model).unwrap();
        let expected = whole.modes(&factors, 9).unwrap().vibrations;
        let mut shapes = sensors.times(expected.shapes()).unwrap();
        apply_sign_rule(&mut shapes);
        let expected = Modes::new(expected.omega_squared().clone(), shapes).unwrap();
        let labels = found.dof.iter().map(|dof| dof.grid).collect_vec();
        assert_eq!(labels, (101..=109).collect_vec());
        assert!(found.dof.iter().all(|dof| dof.direction == 2));
        assert_eq!(found.modes.shapes().shape(), (9, 9));
        // An eigensolution rounds by the largest of its eigenvalues, in the lowest mode 1e5 times its own.
        let highest = expected.omega_squared().max();
        let lowest = expected.omega_squared().iter().map(|value| highest / value);
        for ((a, b), spread) in found
            .modes
            .frequencies_hz()
            .iter()
            .zip(expected.frequencies_hz())
            .zip(lowest)
        {
            assert_relative_eq!(*a, b, max_relative = DECK_ROUNDING + f64::EPSILON * spread);
        }
        // A shape component moves with the tenth digit of T by as much as modes are close.
        let largest = expected.shapes().amax();
        assert_relative_eq!(
            found.modes.shapes(),
            expected.shapes(),
            epsilon = 1e3 * DECK_ROUNDING * largest
        );
        let generalized = found
            .modes
            .shapes()
            .tr_mul(&(model.mass() * found.modes.shapes()));
        assert_relative_eq!(generalized, eye(9), epsilon = 1e3 * ROUND_OFF);
    }
}

#[test]
fn mpc_cards_are_the_load_distribution() {
    let (_, text) = box_deck(2, &[1.0; 15]);
    let read = deck::read("box", text.as_bytes(), &[]).unwrap().model;
    let structure = read.structure().unwrap();
    let model = case_of(2).model().unwrap();
    assert_eq!(structure.free_dof(), model.structure().free_dof());
    let dynamic = read.mass_dof(&structure).unwrap();
    let loads = dynamic.load_distribution.dense();
    assert_eq!(loads.shape(), (36, 9));
    for (read, meant) in loads.iter().zip(model.load_distribution().clone().iter()) {
        assert_eq!(*read, nearest_in_field(*meant));
    }
    assert_eq!(DMatrix::from_diagonal(&dynamic.mass), *model.mass());
    assert_eq!(read.ties.len(), 9);
    assert!(read.ties.iter().all(|tie| tie.coefficient == -1.0));
}

#[test]
fn dynamic_points_lie_at_mid_depth() {
    let case = case_of(1);
    let (bulk, _) = box_deck(1, &[1.0; 15]);
    let grids = &case.reconstruction.grids;
    for (rib, first) in [(0, 1), (1, 5), (2, 9)] {
        let at = |grid: usize| Vector3::from(grids[&grid]);
        let point = |k: usize| bulk.grids[16 + 3 * rib + k].position;
        assert_relative_eq!(
            point(0),
            0.5 * (at(first) + at(first + 1)),
            epsilon = ROUND_OFF
        );
        assert_relative_eq!(
            point(2),
            0.5 * (at(first + 2) + at(first + 3)),
            epsilon = ROUND_OFF
        );
        let fraction = case.reconstruction.mid_chord_fraction;
        assert_relative_eq!(
            point(1) - point(0),
            fraction * (point(2) - point(0)),
            epsilon = 100.0 * ROUND_OFF
        );
    }
}
