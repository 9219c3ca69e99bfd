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
    let mut kinds = [0; 3];
    for number in 0..10_000 {
        let (rigid, massless, vibrations) = (draws.below(3), draws.below(3), 1 + draws.below(4));
        let size = rigid + massless + vibrations;
        let roots = (0..vibrations).map(|_| [1.0, 1.0, 4.0, 30.0, 30.5, 900.0][draws.below(6)]);
        let mut roots = roots.collect_vec();
        roots.sort_by(f64::total_cmp);
        let is_repeated = roots.windows(2).any(|pair| pair[0] == pair[1]);
        for (kind, is_there) in kinds.iter_mut().zip([is_repeated, rigid > 0, massless > 0]) {
            *kind += usize::from(is_there);
        }
        let units = [1.0, 1e6, 1e-4][draws.below(3)];
        let basis = draws.basis(size);
        let through = |inner: [Vec<f64>; 3]| {
            let matrix = units * basis.transpose() * diagonal(inner.concat()) * &basis;
            0.5 * (&matrix + matrix.transpose())
        };
        let stiffness = through([vec![0.0; rigid], roots.clone(), vec![3.0; massless]]);
        let mass = through([vec![1.0; rigid], vec![1.0; vibrations], vec![0.0; massless]]);
        let found = counted_modes(&stiffness, &mass).unwrap();
        let (free, modes) = (&found.rigid_body, &found.vibrations);
        assert_eq!(
            (free.ncols(), modes.len()),
            (rigid, vibrations),
            "pencil {number}"
        );
        assert_alike(modes.omega_squared().iter(), &roots, COUNTED_ROOT);
        let bar = COUNTED_ROOT * stiffness.amax();
        for (shape, root) in modes.shapes().column_iter().zip(modes.omega_squared()) {
            let residual = &stiffness * shape - *root * (&mass * shape);
            assert!(residual.norm() < bar * shape.norm(), "pencil {number}");
        }
        assert!((&stiffness * free).norm() <= bar * free.norm());
        let all = free.column_iter().chain(modes.shapes().column_iter());
        let shapes = DMatrix::from_columns(&all.collect_vec());
        let off = shapes.tr_mul(&(&mass * &shapes)) - eye(rigid + vibrations);
        assert!(off.amax() < COUNTED_ROOT, "pencil {number}");
    }
    assert!(kinds.iter().all(|kind| *kind > 3000));
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

#[test]
fn a_soft_suspension_is_a_vibration_and_no_rigid_body_mode() {
    // A hundred-millionth of the other's stiffness, and still no zero.
    let stiffness = diagonal([1e-8, 1.0]);
    let found = counted_modes(&stiffness, &eye(2)).unwrap();
    assert_eq!((found.rigid_body.ncols(), found.vibrations.len()), (0, 2));
    assert_alike([found.vibrations.omega_squared()[0]], [1e-8], COUNTED_ROOT);
}

/// A decomposition loses what vibrates more than three million times as fast as the lowest; the modes below it are counted just above them.
#[test]
fn modes_below_one_that_is_lost_beside_a_far_lower_one_are_counted() {
    let stiffness = diagonal([0.0, 1.0, 0.9e13, 1.1e13]);
    let (stiffness, mass) = (sparse(&stiffness).unwrap(), sparse(&eye(4)).unwrap());
    for count in [1, 2] {
        let found = lowest_modes(&stiffness, &mass, count).unwrap();
        assert_eq!(
            (found.rigid_body.ncols(), found.vibrations.len()),
            (1, count)
        );
    }
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
    let negative = diagonal([1.0, -1.0]);
    assert!(matches!(
        counted_modes(&two, &negative),
        Err(Error::NotPositiveDefinite { what: "mass", .. })
    ));
    // A motion with neither stiffness nor mass.
    let one = diagonal([1.0, 0.0]);
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
