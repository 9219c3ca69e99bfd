//! Modes of complex unsymmetric pencils, left and right: biorthogonality, order, scale and phase, against dense
//! complex eigensolutions by another route (QZ on the pencil itself).

use crate::common::complex_pencils::{ComplexPencil, complex_pencil, complex_square};
use crate::common::strategies;
use crate::prelude::*;
use appendix_c::solve;

fn identity(size: usize) -> Complexes {
    eye(size)
}

/// Cosine of a mode's left and right shapes, if that is what was refused.
fn defective_cosine(error: &Error, mode: usize) -> Option<f64> {
    match error {
        Error::Value {
            what: "cosine of left and right shapes",
            owner,
            value,
            expected: "above 1e-7",
        } if *owner == format!("mode {mode} (from zero)") => Some(*value),
        _ => None,
    }
}

properties! {
    /// (C.8) to (C.10): UᵗKV = I and UᵗGV = Λ, and both sets solve their own pencil (C.1), (C.2).
    #[test]
    fn left_and_right_modes_are_biorthogonal(pencil in complex_pencil()) {
        let ComplexPencil { stiffness, g, .. } = &pencil;
        let modes = solve(stiffness, g)?;
        let (k, size) = (complex(stiffness), g.nrows());
        prop_assert_eq!(modes.right.shape(), (size, size));
        prop_assert_eq!(modes.left.shape(), (size, size));
        let lambda = DMatrix::from_diagonal(&modes.roots);
        prop_assert!(amax(&(through(&modes.left, &k, &modes.right) - identity(size))) < COMPLEX_EIGEN_ROUND_OFF);
        prop_assert!(amax(&(through(&modes.left, g, &modes.right) - &lambda)) < COMPLEX_EIGEN_ROUND_OFF);
        let scale = amax(&k);
        prop_assert!(amax(&(&k * &modes.right * &lambda - g * &modes.right)) < COMPLEX_EIGEN_ROUND_OFF * scale);
        prop_assert!(
            amax(&(k.transpose() * &modes.left * &lambda - g.transpose() * &modes.left))
                < COMPLEX_EIGEN_ROUND_OFF * scale
        );
    }

    /// The roots are those of QZ on (G, K), in falling order of magnitude.
    #[test]
    fn roots_are_those_of_another_route(pencil in complex_pencil()) {
        let modes = solve(&pencil.stiffness, &pencil.g)?;
        let exact = roots_by_qz(&complex(&pencil.stiffness), &pencil.g);
        prop_assert!(largest_root_error(modes.roots.as_slice(), &exact) < COMPLEX_EIGEN_ROUND_OFF);
        for i in 1..modes.roots.len() {
            prop_assert!(modes.roots[i].norm() < modes.roots[i - 1].norm());
        }
    }

    /// vᴴKv = 1, and the first of the largest components of v is real and positive.
    #[test]
    fn scale_and_phase_are_as_stated(pencil in complex_pencil()) {
        let modes = solve(&pencil.stiffness, &pencil.g)?;
        let k = complex(&pencil.stiffness);
        for shape in modes.right.column_iter() {
            let norm = shape.dotc(&(&k * shape));
            prop_assert!((norm - 1.0).norm() < COMPLEX_EIGEN_ROUND_OFF);
            let largest = shape.iter().map(|value| value.norm()).largest();
            let first = shape.iter().find(|value| value.norm() > (1.0 - EQUALLY_LARGE) * largest).unwrap();
            prop_assert!(first.re > 0.0 && first.im.abs() < ROUND_OFF * first.re, "{first}");
        }
    }

    /// Any complex matrix may be G: unless its shapes nearly coincide, which is refused, the modes solve the pencil.
    #[test]
    fn any_g_gives_modes_or_a_typed_error(
        (stiffness, _) in strategies::positive_definite(4, 3.0),
        g in complex_square(4),
    ) {
        match solve(&stiffness, &g) {
            Ok(modes) => {
                let k = complex(&stiffness);
                let residual = &k * &modes.right * DMatrix::from_diagonal(&modes.roots) - &g * &modes.right;
                // Columns of V are of size one over the root of the smallest stiffness, 1.
                prop_assert!(amax(&residual) < COMPLEX_EIGEN_ROUND_OFF * amax(&k) * amax(&modes.right));
            }
            Err(error) => {
                let found = (0..4).find_map(|mode| defective_cosine(&error, mode));
                prop_assert!(found.is_some_and(|cosine| cosine <= DEFECTIVE_COSINE), "{error}");
            }
        }
    }

    /// Recursive 1 carried to convergence on the changed complex pencil is its dense eigensolution, left and right.
    #[test]
    fn converged_recursion_is_the_dense_complex_eigensolution(pencil in complex_pencil()) {
        let ComplexPencil { stiffness, g, stiffness_change, g_change } = &pencil;
        let k = complex(stiffness);
        let modes = solve(stiffness, g)?;
        let changed = Pencil::new(&k, &modes, stiffness_change, g_change)?;
        let right = changed.recursive_1_converged()?.perturbed;
        let left = changed.transposed().recursive_1_converged()?.perturbed;
        let (changed_k, changed_g) = (&k + stiffness_change, g + g_change);
        let exact = roots_by_qz(&changed_k, &changed_g);
        prop_assert!(largest_root_error(right.roots.as_slice(), &exact) < COMPLEX_EIGEN_ROUND_OFF);
        prop_assert!(amax(&DMatrix::from_column_slice(
            modes.roots.len(), 1, (&left.roots - &right.roots).as_slice())) < COMPLEX_EIGEN_ROUND_OFF);
        let v = &modes.right * &right.shapes;
        let u = &modes.left * &left.shapes;
        let lambda = DMatrix::from_diagonal(&right.roots);
        let residual = &changed_k * &v * &lambda - &changed_g * &v;
        prop_assert!(amax(&residual) < COMPLEX_EIGEN_ROUND_OFF * amax(&k));
        // The changed shapes are biorthogonal again (C.10).
        let mut generalized = through(&u, &changed_k, &v);
        generalized.fill_diagonal(Complex::from(0.0));
        prop_assert!(amax(&generalized) < COMPLEX_EIGEN_ROUND_OFF);
    }

    /// Recursive 2 tends to the same roots.
    #[test]
    fn recursive_2_tends_to_the_dense_complex_eigensolution(pencil in complex_pencil()) {
        let ComplexPencil { stiffness, g, stiffness_change, g_change } = &pencil;
        let k = complex(stiffness);
        let changed = Pencil::new(&k, &solve(stiffness, g)?, stiffness_change, g_change)?;
        let found = changed.recursive_2(12)?;
        let exact = roots_by_qz(&(&k + stiffness_change), &(g + g_change));
        prop_assert!(largest_root_error(found.roots.as_slice(), &exact) < COMPLEX_EIGEN_ROUND_OFF);
    }
}

/// A symmetric real G gives the real modes, left and right alike.
#[test]
fn symmetric_real_pencil_gives_modes_of_vibration() {
    let stiffness = three_mass_chain([1.0, 2.0, 0.5], [1.0, 1.0, 3.0]);
    let mass = diagonal([1.0, 1.5, 0.8]);
    let modes = solve(&stiffness, &complex(&mass)).unwrap();
    let vibrations = on_either_side(&corfem::method::modes::solve(&stiffness, &mass, 3).unwrap());
    for i in 0..3 {
        assert!((modes.roots[i] / vibrations.roots[i] - 1.0).norm() < EIGEN_ROUND_OFF);
        // vᵗKv = 1 against vᵗMv = 1: apart by the root of λ.
        let scale = vibrations.roots[i].sqrt();
        for row in 0..3 {
            let expected = vibrations.right[(row, i)] * scale;
            assert!((modes.right[(row, i)] - expected).norm() < EIGEN_ROUND_OFF);
            assert!((modes.left[(row, i)] - expected).norm() < EIGEN_ROUND_OFF);
        }
    }
}

/// A real unsymmetric G has conjugate pairs: the root with the negative argument stands first, whatever round-off says
/// about which is larger.
#[test]
fn conjugate_pairs_stand_in_the_order_of_their_argument() {
    for angle in [0.3_f64, 1.0, 2.5] {
        let g = complex(&dmatrix![
            angle.cos(), -angle.sin(), 0.1, 0.2;
            angle.sin(), angle.cos(), 0.3, -0.1;
            0.0, 0.0, 2.0, 0.5;
            0.0, 0.0, 0.0, 0.25]);
        let modes = solve(&eye(4), &g).unwrap();
        let turn = Complex::from_polar(1.0, angle);
        let expected = [Complex::from(2.0), turn.conj(), turn, Complex::from(0.25)];
        for (found, expected) in modes.roots.iter().zip(expected) {
            assert!(
                (found - expected).norm() < EIGEN_ROUND_OFF,
                "{found} {expected}"
            );
        }
    }
    // Three of equal magnitude between a larger and a smaller one, in every order.
    let middle = [-1.0, 0.5, 2.0].map(|angle| Complex::from_polar(1.0, angle));
    for [a, b, c] in [
        [0, 1, 2],
        [0, 2, 1],
        [1, 0, 2],
        [1, 2, 0],
        [2, 0, 1],
        [2, 1, 0],
    ] {
        let roots = [
            Complex::from(3.0),
            middle[a],
            middle[b],
            middle[c],
            Complex::from(0.5),
        ];
        let g = diagonal(roots);
        let modes = solve(&eye(5), &g).unwrap();
        let expected = [roots[0], middle[0], middle[1], middle[2], roots[4]];
        for (found, expected) in modes.roots.iter().zip(expected) {
            assert!(
                (found - expected).norm() < EIGEN_ROUND_OFF,
                "{found} {expected}"
            );
        }
    }
    // A one-in-a-million difference of magnitude is not a tie.
    let g = diagonal([
        Complex::from_polar(1.0, -1.0),
        Complex::from_polar(1.0 + 1e-6, 1.0),
    ]);
    let modes = solve(&eye(2), &g).unwrap();
    assert!(modes.roots[0].im > 0.0);
}

#[test]
fn defective_pencil_is_refused_and_its_mode_named() {
    // One shape for the double root 1, behind the root 2.
    let solved = |g: DMatrix<f64>| solve(&eye(3), &complex(&g));
    let refused = |g| defective_cosine(&solved(g).expect_err("one shape too few"), 1);
    let double = refused(dmatrix![1.0, 1.0, 0.0; 0.0, 1.0, 0.0; 0.0, 0.0, 2.0]);
    assert!(double.is_some_and(|cosine| cosine < DEFECTIVE_COSINE));
    // Nearly defective is told from defective: shapes a millionth apart are kept.
    let near = dmatrix![1.0, 1.0, 0.0; 0.0, 1.0 + 1e-6, 0.0; 0.0, 0.0, 2.0];
    assert!(solved(near).is_ok());
    assert!(refused(dmatrix![1.0, 1.0, 0.0; 0.0, 1.0 + 2e-8, 0.0; 0.0, 0.0, 2.0]).is_some());
}

#[test]
fn pencils_that_do_not_fit_are_refused() {
    let (what, identity) = ("mass and aerodynamic terms", eye(2));
    assert_refused(
        solve(&zero_square(0), &zero_square(0)),
        Error::Count {
            what: "degrees of freedom",
            found: 0,
            least: 1,
            most: usize::MAX,
        },
    );
    assert_refused(
        solve(&identity, &DMatrix::zeros(2, 3)),
        Error::WrongShape {
            what,
            expected_rows: 2,
            expected_columns: 2,
            rows: 2,
            columns: 3,
        },
    );
    let g = complex(&identity);
    for value in [f64::NEG_INFINITY, f64::INFINITY, f64::NAN] {
        for entry in [Complex::new(0.0, value), Complex::new(value, 0.0)] {
            let mut not_finite = g.clone();
            not_finite[(1, 0)] = entry;
            assert_refused(
                solve(&identity, &not_finite),
                Error::Value {
                    what,
                    owner: "entry (1, 0)".into(),
                    value,
                    expected: "a finite number",
                },
            );
        }
    }
    assert_refused(
        solve(&dmatrix![1.0, 2.0; 2.0, 1.0], &g),
        Error::NotPositiveDefinite {
            what: "stiffness",
            row: 1,
        },
    );
    assert_refused(
        solve(&dmatrix![1.0, 0.5; 0.0, 1.0], &g),
        Error::Value {
            what: "relative asymmetry",
            owner: "stiffness".into(),
            value: 0.5,
            expected: "at most 1e-8",
        },
    );
}
