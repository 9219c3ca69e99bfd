//! Appendix C on complex unsymmetric pencils: left and right modes, biorthogonality, and a wing section with aileron in
//! a flow, against dense complex eigensolutions by another route (QZ on the pencil itself).

use crate::common::appendix_c::{
    ComplexPencil, aeroelastic_section, complex_pencil, complex_square, largest_root_error,
    three_mass_chain,
};
use crate::common::tolerances::{COMPLEX_EIGEN_ROUND_OFF, EIGEN_ROUND_OFF, ORDER_SLACK, ROUND_OFF};
use crate::common::{log_log_slope, strategies};
use corfem::complex_modes::{LeftRightModes, solve};
use corfem::error::Error;
use corfem::perturbation::{ModalChange, general};
use nalgebra::{Complex, DMatrix, DVector, dmatrix, dvector};
use proptest::prelude::*;

type Complexes = DMatrix<Complex<f64>>;

fn complex(matrix: &DMatrix<f64>) -> Complexes {
    matrix.map(Complex::from)
}

fn amax(matrix: &Complexes) -> f64 {
    matrix.iter().map(|value| value.norm()).fold(0.0, f64::max)
}

/// Roots of (Kλ − G)v = 0 by faer's QZ, which shares nothing with the Cholesky route of the library.
fn roots_by_qz(stiffness: &Complexes, g: &Complexes) -> Vec<Complex<f64>> {
    let to_faer = |matrix: &Complexes| {
        faer::Mat::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)])
    };
    let eigen = to_faer(g)
        .generalized_eigen(to_faer(stiffness))
        .expect("QZ converges");
    (0..g.nrows())
        .map(|i| eigen.S_a()[i] / eigen.S_b()[i])
        .collect()
}

/// A conjugate-free product of columns, UᵗAV.
fn through(left: &Complexes, matrix: &Complexes, right: &Complexes) -> Complexes {
    left.tr_mul(&(matrix * right))
}

fn identity(size: usize) -> Complexes {
    DMatrix::identity(size, size)
}

proptest! {
    #![proptest_config(crate::common::config())]

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
            let largest = shape.iter().map(|value| value.norm()).fold(0.0, f64::max);
            let first = shape.iter().find(|value| value.norm() > (1.0 - 1e-6) * largest).unwrap();
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
            Err(Error::Defective { mode, cosine }) => prop_assert!(mode < 4 && cosine <= 1e-7),
            Err(other) => prop_assert!(false, "{other}"),
        }
    }

    /// Recursive 1 carried to convergence on the changed complex pencil is its dense eigensolution, left and right.
    #[test]
    fn converged_recursion_is_the_dense_complex_eigensolution(pencil in complex_pencil()) {
        let ComplexPencil { stiffness, g, stiffness_change, g_change } = &pencil;
        let k = complex(stiffness);
        let modes = solve(stiffness, g)?;
        let change = ModalChange::new(&k, &modes, stiffness_change, g_change)?;
        let right = general::recursive_1_converged(&change, 1e-14, 100)?;
        let left = general::recursive_1_converged(&change.transposed(), 1e-14, 100)?;
        let (changed_k, changed_g) = (&k + stiffness_change, g + g_change);
        let exact = roots_by_qz(&changed_k, &changed_g);
        prop_assert!(largest_root_error(right.roots.as_slice(), &exact) < COMPLEX_EIGEN_ROUND_OFF);
        prop_assert!(amax(&DMatrix::from_column_slice(
            change.len(), 1, (&left.roots - &right.roots).as_slice())) < COMPLEX_EIGEN_ROUND_OFF);
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
        let change = ModalChange::new(&k, &solve(stiffness, g)?, stiffness_change, g_change)?;
        let found = general::recursive_2(&change, 12)?;
        let exact = roots_by_qz(&(&k + stiffness_change), &(g + g_change));
        prop_assert!(largest_root_error(found.roots.as_slice(), &exact) < COMPLEX_EIGEN_ROUND_OFF);
    }
}

/// A symmetric real G gives the real modes, left and right alike.
#[test]
fn symmetric_real_pencil_gives_modes_of_vibration() {
    let stiffness = three_mass_chain([1.0, 2.0, 0.5], [1.0, 1.0, 3.0]);
    let mass = DMatrix::from_diagonal(&dvector![1.0, 1.5, 0.8]);
    let modes = solve(&stiffness, &complex(&mass)).unwrap();
    let vibrations = LeftRightModes::from(&corfem::modes::solve(&stiffness, &mass, 3).unwrap());
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
        let modes = solve(&DMatrix::identity(4, 4), &g).unwrap();
        let turn = Complex::from_polar(1.0, angle);
        let expected = [Complex::from(2.0), turn.conj(), turn, Complex::from(0.25)];
        for (found, expected) in modes.roots.iter().zip(expected) {
            assert!(
                (found - expected).norm() < EIGEN_ROUND_OFF,
                "{found} {expected}"
            );
        }
    }
    // A one-in-a-million difference of magnitude is not a tie.
    let g = DMatrix::from_diagonal(&dvector![
        Complex::from_polar(1.0, -1.0),
        Complex::from_polar(1.0 + 1e-6, 1.0)
    ]);
    let modes = solve(&DMatrix::identity(2, 2), &g).unwrap();
    assert!(modes.roots[0].im > 0.0);
}

/// Base and changed flow of the wing section: more dynamic pressure, softer torsion, heavier aileron.
fn section_change(
    size: f64,
) -> (
    Complexes,
    LeftRightModes<Complex<f64>>,
    ModalChange<Complex<f64>>,
    Vec<Complex<f64>>,
) {
    let (stiffness, g) = aeroelastic_section(0.15);
    let mut stiffness_change = DMatrix::zeros(3, 3);
    stiffness_change[(1, 1)] = Complex::from(-0.4 * size);
    stiffness_change[(2, 2)] = Complex::new(0.04 * size, 0.02 * size);
    let (_, more_pressure) = aeroelastic_section(0.15 * (1.0 + size));
    let mut g_change = more_pressure - &g;
    g_change[(2, 2)] += Complex::from(0.01 * size);
    let modes = solve(&stiffness, &g).expect("the section has three modes");
    let k = complex(&stiffness);
    let change = ModalChange::new(&k, &modes, &stiffness_change, &g_change).expect("it fits");
    let exact = roots_by_qz(&(&k + &stiffness_change), &(&g + &g_change));
    (k, modes, change, exact)
}

/// The section's flow makes the roots complex and the left shapes other than the right ones.
#[test]
fn wing_section_is_complex_and_unsymmetric() {
    let (k, modes, change, _) = section_change(0.2);
    assert!(
        modes.roots.iter().all(|root| root.im < -1e-3),
        "{}",
        modes.roots
    );
    assert!(amax(&(&modes.left - &modes.right)) > 0.05);
    assert!(amax(&(&change.alpha - change.alpha.transpose())) > 1e-3);
    assert!(amax(&(through(&modes.left, &k, &modes.right) - identity(3))) < EIGEN_ROUND_OFF);
    for i in 0..3 {
        assert!((change.generalized_stiffness[i] - 1.0).norm() < EIGEN_ROUND_OFF);
    }
}

/// A 40 % increase of dynamic pressure with its changes of stiffness and mass, by every method.
#[test]
fn wing_section_in_a_faster_flow_has_the_roots_of_the_dense_eigensolution() {
    let (_, _, change, exact) = section_change(0.4);
    let error = |roots: &DVector<Complex<f64>>| largest_root_error(roots.as_slice(), &exact);
    let first = error(&general::first_order(&change).unwrap().roots);
    let original = error(&general::original(&change).unwrap().roots);
    let third = error(&general::recursive_1(&change, 3).unwrap().roots);
    let recursive_2 = error(&general::recursive_2(&change, 3).unwrap().roots);
    let converged = error(
        &general::recursive_1_converged(&change, 1e-14, 100)
            .unwrap()
            .roots,
    );
    assert!(first > 1e-3, "{first:e}");
    assert!(original < first / 20.0, "{original:e} {first:e}");
    assert!(third < first / 100.0, "{third:e}");
    assert!(recursive_2 < original / 100.0, "{recursive_2:e}");
    assert!(converged < COMPLEX_EIGEN_ROUND_OFF, "{converged:e}");
}

/// Order r of Recursive 1 leaves an error of order r + 1 in complex roots too.
#[test]
fn orders_of_recursive_1_hold_for_complex_roots() {
    for order in 1..=3 {
        let points: Vec<(f64, f64)> = [0.08, 0.04, 0.02]
            .into_iter()
            .map(|size| {
                let (_, _, change, exact) = section_change(size);
                let found = general::recursive_1(&change, order).expect("separate roots");
                (size, largest_root_error(found.roots.as_slice(), &exact))
            })
            .collect();
        let slope = log_log_slope(&points);
        assert!(
            slope > order as f64 + 1.0 - ORDER_SLACK,
            "order {order}: {slope}"
        );
    }
}

/// The transposed change exchanges rows and columns and nothing else.
#[test]
fn transposed_change_belongs_to_the_left_shapes() {
    let (_, _, change, _) = section_change(0.3);
    let transposed = change.transposed();
    assert_eq!(transposed.beta, change.beta.transpose());
    assert_eq!(transposed.alpha, change.alpha.transpose());
    assert_eq!(transposed.roots, change.roots);
    assert_eq!(
        transposed.generalized_stiffness,
        change.generalized_stiffness
    );
}

#[test]
fn defective_pencil_is_refused_and_its_mode_named() {
    // One shape for the double root 1, behind the root 2.
    let g = complex(&dmatrix![1.0, 1.0, 0.0; 0.0, 1.0, 0.0; 0.0, 0.0, 2.0]);
    assert!(matches!(
        solve(&DMatrix::identity(3, 3), &g),
        Err(Error::Defective { mode: 1, cosine }) if cosine < 1e-7
    ));
    // Nearly defective is told from defective: shapes a millionth apart are kept.
    let near = complex(&dmatrix![1.0, 1.0, 0.0; 0.0, 1.0 + 1e-6, 0.0; 0.0, 0.0, 2.0]);
    assert!(solve(&DMatrix::identity(3, 3), &near).is_ok());
    let nearer = complex(&dmatrix![1.0, 1.0, 0.0; 0.0, 1.0 + 2e-8, 0.0; 0.0, 0.0, 2.0]);
    assert!(matches!(
        solve(&DMatrix::identity(3, 3), &nearer),
        Err(Error::Defective { mode: 1, .. })
    ));
}

#[test]
fn pencils_that_do_not_fit_are_refused() {
    let identity = DMatrix::identity(2, 2);
    let g = complex(&identity);
    assert!(matches!(
        solve(&DMatrix::zeros(0, 0), &DMatrix::zeros(0, 0)),
        Err(Error::Empty {
            what: "degrees of freedom"
        })
    ));
    assert!(matches!(
        solve(&identity, &DMatrix::zeros(2, 3)),
        Err(Error::WrongShape {
            what: "mass and aerodynamic terms",
            expected_rows: 2,
            expected_columns: 2,
            rows: 2,
            columns: 3
        })
    ));
    let mut not_finite = g.clone();
    not_finite[(1, 0)] = Complex::new(0.0, f64::NEG_INFINITY);
    assert!(matches!(
        solve(&identity, &not_finite),
        Err(Error::NotFinite {
            what: "mass and aerodynamic terms",
            row: 1,
            column: 0,
            value: f64::NEG_INFINITY
        })
    ));
    not_finite[(1, 0)] = Complex::new(f64::INFINITY, 0.0);
    assert!(matches!(
        solve(&identity, &not_finite),
        Err(Error::NotFinite {
            value: f64::INFINITY,
            ..
        })
    ));
    assert!(matches!(
        solve(&dmatrix![1.0, 2.0; 2.0, 1.0], &g),
        Err(Error::NotPositiveDefinite {
            what: "stiffness",
            dof: 1
        })
    ));
    assert!(matches!(
        solve(&dmatrix![1.0, 0.5; 0.0, 1.0], &g),
        Err(Error::NotSymmetric {
            what: "stiffness",
            row: 1,
            column: 0,
            ..
        })
    ));
}

#[test]
fn changes_that_do_not_fit_their_modes_are_refused() {
    let (stiffness, g) = aeroelastic_section(0.15);
    let k = complex(&stiffness);
    let modes = solve(&stiffness, &g).unwrap();
    let none = DMatrix::zeros(3, 3);
    assert!(ModalChange::new(&k, &modes, &none, &none).is_ok());
    // The right shapes are not the left ones here.
    let same = LeftRightModes {
        left: modes.right.clone(),
        ..modes.clone()
    };
    let product = through(&modes.right, &k, &modes.right);
    assert!(matches!(
        ModalChange::new(&k, &same, &none, &none),
        Err(Error::NotBiorthogonal { left: 1, right: 0, ratio })
            if (ratio * (product[(0, 0)] * product[(1, 1)]).norm().sqrt() - product[(1, 0)].norm()).abs() < ROUND_OFF
    ));
    for (what, stiffness, stiffness_change, g_change) in [
        ("stiffness", &DMatrix::zeros(2, 3), &none, &none),
        ("stiffness change", &k, &DMatrix::zeros(2, 3), &none),
        (
            "change of mass and aerodynamic terms",
            &k,
            &none,
            &DMatrix::zeros(2, 3),
        ),
    ] {
        assert!(matches!(
            ModalChange::new(stiffness, &modes, stiffness_change, g_change),
            Err(Error::WrongShape { what: found, expected_rows: 3, expected_columns: 3, rows: 2, columns: 3 }) if found == what
        ));
    }
    let mut not_a_number = none.clone();
    not_a_number[(2, 1)] = Complex::new(f64::NAN, 0.0);
    assert!(matches!(
        ModalChange::new(&k, &modes, &none, &not_a_number),
        Err(Error::NotFinite {
            what: "change of mass and aerodynamic terms",
            row: 2,
            column: 1,
            ..
        })
    ));
    let fewer = LeftRightModes {
        left: modes.left.columns(0, 2).into_owned(),
        ..modes.clone()
    };
    assert!(matches!(
        ModalChange::new(&k, &fewer, &none, &none),
        Err(Error::WrongShape {
            what: "left shapes",
            expected_columns: 3,
            columns: 2,
            ..
        })
    ));
}

/// Two of three modes are enough to see a change through.
#[test]
fn fewer_modes_than_degrees_of_freedom_see_their_part_of_a_change() {
    let (k, modes, change, _) = section_change(0.3);
    let two = LeftRightModes {
        roots: modes.roots.rows(0, 2).into_owned(),
        right: modes.right.columns(0, 2).into_owned(),
        left: modes.left.columns(0, 2).into_owned(),
    };
    let mut stiffness_change = DMatrix::zeros(3, 3);
    stiffness_change[(1, 1)] = Complex::from(-0.4 * 0.3);
    stiffness_change[(2, 2)] = Complex::new(0.04 * 0.3, 0.02 * 0.3);
    let part = ModalChange::new(&k, &two, &stiffness_change, &DMatrix::zeros(3, 3)).unwrap();
    assert_eq!(part.len(), 2);
    assert_eq!(part.beta.shape(), (2, 2));
    assert!(amax(&(part.beta - change.beta.view((0, 0), (2, 2)))) < ROUND_OFF);
    assert_eq!(part.alpha, DMatrix::zeros(2, 2));
}
