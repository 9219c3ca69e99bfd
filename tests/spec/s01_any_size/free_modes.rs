//! Free structures and massless degrees of freedom: every mode found once, and counted another way.

use crate::prelude::*;

/// How many squared frequencies lie below a bound.
fn count_below(stiffness: &DMatrix<f64>, mass: &DMatrix<f64>, bound: f64) -> Result<usize, Error> {
    let difference = sparse(&(stiffness - bound * mass))?;
    Factor::new("pencil", &difference).map(|factor| factor.negative_count())
}

impl Draws {
    /// A well-conditioned square matrix: a rotation times factors from a half to two.
    fn basis(&mut self, size: usize) -> DMatrix<f64> {
        let random = DMatrix::from_fn(size, size, |_, _| 2.0 * self.unit() - 1.0);
        let rotation = random.qr().q();
        let scale = DVector::from_fn(size, |_, _| 0.5 + 1.5 * self.unit());
        DMatrix::from_diagonal(&scale) * rotation
    }
}

/// Ten thousand pencils with repeated roots, rigid-body modes and massless motions, their answers known from how they are made.
#[test]
fn random_pencils_are_counted_and_solved_every_time() {
    let mut draws = Draws(2026);
    let (mut repeated, mut free, mut massless_ones) = (0, 0, 0);
    for number in 0..10_000 {
        let (rigid, massless, vibrations) = (draws.below(3), draws.below(3), 1 + draws.below(4));
        let size = rigid + massless + vibrations;
        let mut roots = (0..vibrations)
            .map(|_| [1.0, 1.0, 4.0, 30.0, 30.5, 900.0][draws.below(6)])
            .collect_vec();
        roots.sort_by(f64::total_cmp);
        repeated += usize::from(roots.windows(2).any(|pair| pair[0] == pair[1]));
        (free, massless_ones) = (
            free + usize::from(rigid > 0),
            massless_ones + usize::from(massless > 0),
        );
        let units = [1.0, 1e6, 1e-4][draws.below(3)];
        let basis = draws.basis(size);
        let of = |row: usize| match row {
            row if row < rigid => (0.0, 1.0),
            row if row < rigid + vibrations => (roots[row - rigid], 1.0),
            _ => (3.0, 0.0),
        };
        let diagonal = |value: &dyn Fn(usize) -> f64| {
            DMatrix::from_diagonal(&DVector::from_fn(size, |row, _| value(row)))
        };
        let through = |inner: DMatrix<f64>| units * basis.transpose() * inner * &basis;
        let (stiffness, mass) = (
            through(diagonal(&|row| of(row).0)),
            through(diagonal(&|row| of(row).1)),
        );
        let symmetric = |matrix: &DMatrix<f64>| 0.5 * (matrix + matrix.transpose());
        let (stiffness, mass) = (symmetric(&stiffness), symmetric(&mass));
        let found = counted_modes(&stiffness, &mass)
            .unwrap_or_else(|error| panic!("pencil {number}: {error}"));
        assert_eq!(found.rigid_body.ncols(), rigid, "pencil {number}");
        assert_eq!(found.vibrations.len(), vibrations, "pencil {number}");
        for (omega_squared, root) in found.vibrations.omega_squared().iter().zip(&roots) {
            assert!(
                relative_error(omega_squared, root) < COUNTED_ROOT,
                "pencil {number}: {omega_squared} for {root}"
            );
        }
        for (shape, omega_squared) in found
            .vibrations
            .shapes()
            .column_iter()
            .zip(found.vibrations.omega_squared())
        {
            let residual = &stiffness * shape - *omega_squared * (&mass * shape);
            assert!(
                residual.norm() < COUNTED_ROOT * stiffness.amax() * shape.norm(),
                "pencil {number}"
            );
        }
        assert!(
            (&stiffness * &found.rigid_body).norm()
                <= COUNTED_ROOT * stiffness.amax() * found.rigid_body.norm()
        );
        let shapes = DMatrix::from_fn(size, rigid + vibrations, |row, column| match column {
            column if column < rigid => found.rigid_body[(row, column)],
            column => found.vibrations.shapes()[(row, column - rigid)],
        });
        let generalized = shapes.transpose() * &mass * &shapes;
        let identity = DMatrix::identity(rigid + vibrations, rigid + vibrations);
        assert!(
            (generalized - identity).amax() < COUNTED_ROOT,
            "pencil {number}"
        );
    }
    assert!(repeated > 3000 && free > 3000 && massless_ones > 3000);
}

#[test]
fn a_free_spring_chain_has_the_closed_form() {
    for count in 2..=9 {
        let mut stiffness = zero_square(count);
        for spring in 0..count - 1 {
            let mut ends = DVector::zeros(count);
            (ends[spring], ends[spring + 1]) = (1.0, -1.0);
            stiffness += 100.0 * &ends * ends.transpose();
        }
        let mass = DMatrix::from_diagonal_element(count, count, 0.01);
        let found = counted_modes(&stiffness, &mass).unwrap();
        assert_eq!(found.rigid_body.ncols(), 1);
        let expected = chain_eigenvalues(ChainEnds::FreeFree, count, 100.0, 0.01);
        let expected = expected
            .into_iter()
            .filter(|value| *value > 1e-6)
            .collect_vec();
        assert_eq!(found.vibrations.len(), expected.len());
        assert_alike(
            found.vibrations.omega_squared().iter(),
            &expected,
            COUNTED_ROOT,
        );
        // The chain moves as one.
        let first = found.rigid_body[(0, 0)];
        assert!(
            found
                .rigid_body
                .iter()
                .all(|component| relative_error(component, first) < COUNTED_ROOT)
        );
        for (below, bound) in [
            (0, -1.0),
            (1, 0.45 * expected[0]),
            (count, 2.0 * expected[count - 2]),
        ] {
            assert_eq!(count_below(&stiffness, &mass, bound).unwrap(), below);
        }
    }
}

properties! {
    /// Other units of every degree of freedom are a congruence.
    #[test]
    fn a_count_does_not_depend_on_units(decades in prop::collection::vec(-9..=9_i32, 6), below in 0..=6_usize) {
        let roots = chain_eigenvalues(ChainEnds::FixedFree, 6, 1.0, 1.0);
        let bound = match below {
            0 => 0.5 * roots[0],
            6 => 2.0 * roots[5],
            _ => 0.5 * (roots[below - 1] + roots[below]),
        };
        let stiffness: DMatrix<f64> = (0..6).map(|spring| spring_stiffness(6, spring, 1.0)).sum();
        let units = DMatrix::from_diagonal(&DVector::from_iterator(6, decades.iter().map(|&ten| 10_f64.powi(ten))));
        prop_assert_eq!(count_below(&(&units * stiffness * &units), &(&units * &units), bound)?, below);
    }
}

#[test]
fn a_free_delta_wing_has_its_rigid_body_modes_and_no_mode_is_lost() {
    let wing = DeltaWing::embedded();
    let held = wing.structure().unwrap();
    let free = held.grids().iter().map(|grid| Grid {
        constrained: [false; 3],
        ..grid.clone()
    });
    let free = Structure::new(free.collect(), held.elements().to_vec()).unwrap();
    let (stiffness, lumped, count) = (dense(&free), lumped_mass(&free), free.free_dof().len());
    let found = counted_modes(&stiffness, &DMatrix::from_diagonal(&lumped)).unwrap();
    let heavy = lumped.iter().filter(|mass| **mass > 0.0).count();
    assert_eq!(found.rigid_body.ncols() + found.vibrations.len(), heavy);
    // Every motion of a rigid body is among the modes without strain.
    for axis in 0..3 {
        let along = DVector::from_fn(count, |row, _| {
            f64::from(u8::from(free.free_dof()[row].direction == axis))
        });
        assert!((&stiffness * &along).amax() < EIGEN_ROUND_OFF * stiffness.amax());
        let massive = DMatrix::from_diagonal(&lumped) * &along;
        let projected = &found.rigid_body * found.rigid_body.tr_mul(&massive);
        let apart = (projected - &along)
            .component_mul(&lumped.map(f64::sqrt))
            .norm();
        assert!(apart < 1e-6 * massive.dot(&along).sqrt(), "{axis}: {apart}");
    }
}

#[test]
fn a_soft_suspension_is_a_vibration_and_no_rigid_body_mode() {
    // A hundred-millionth of the other's stiffness, and still no zero.
    let stiffness = DMatrix::from_diagonal(&DVector::from_vec(vec![1e-8, 1.0]));
    let found = counted_modes(&stiffness, &eye(2)).unwrap();
    assert_eq!((found.rigid_body.ncols(), found.vibrations.len()), (0, 2));
    assert!((found.vibrations.omega_squared()[0] / 1e-8 - 1.0).abs() < COUNTED_ROOT);
}

/// A decomposition loses what vibrates more than three million times as fast as the lowest; the inertia does not.
#[test]
fn a_mode_that_is_lost_beside_a_far_lower_one_is_missed_by_the_count() {
    let stiffness = DMatrix::from_diagonal(&DVector::from_vec(vec![0.0, 1.0, 0.9e13, 1.1e13]));
    let (stiffness, mass) = (sparse(&stiffness).unwrap(), sparse(&eye(4)).unwrap());
    // Above the last that is found, as far as that is from three times itself, half way.
    let refused = lowest_modes(&stiffness, &mass, 2);
    let why = "3 were found below 1.800000e13 rad^2/s^2, but the shifted pencil's inertia counts 4";
    let error = Error::Failed {
        what: "modes",
        why: why.to_owned(),
    };
    assert_refused(refused, error);
    // One mode is told apart from the others well below them.
    let one = lowest_modes(&stiffness, &mass, 1).unwrap();
    assert_eq!((one.rigid_body.ncols(), one.vibrations.len()), (1, 1));
}

#[test]
fn what_is_no_mass_is_named_by_its_row() {
    let stiffness = sparse(&eye(3)).unwrap();
    let coupled = vec![(0, 0, 1.0), (1, 2, 1.0), (2, 1, 1.0)];
    let mass = SparseMatrix::new("mass", 3, 3, coupled).unwrap();
    // Both rows move alike in the motion of negative mass; the first is named.
    let error = Error::NotPositiveDefinite {
        what: "mass",
        row: 1,
    };
    assert_refused(lowest_modes(&stiffness, &mass, 1), error);
}

#[test]
fn what_cannot_be_counted_is_refused() {
    let two = eye(2);
    assert!(matches!(
        counted_modes(&two, &zero_square(2)),
        Err(Error::Count { found: 0, .. })
    ));
    let negative = DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, -1.0]));
    assert!(matches!(
        counted_modes(&two, &negative),
        Err(Error::NotPositiveDefinite { what: "mass", .. })
    ));
    // A motion with neither stiffness nor mass.
    let one = DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, 0.0]));
    assert!(matches!(
        counted_modes(&one, &one),
        Err(Error::NotPositiveDefinite { .. })
    ));
    assert!(matches!(
        counted_modes(&two, &eye(3)),
        Err(Error::WrongShape { .. })
    ));
    assert!(matches!(
        counted_modes(&(f64::NAN * &two), &two),
        Err(Error::Value {
            expected: "a finite number",
            ..
        })
    ));
}
