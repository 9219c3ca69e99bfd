//! Appendix C on a wing section with aileron in a flow: complex and unsymmetric, against the dense complex eigensolution.

use crate::common::appendix_c::largest_root_error;
use crate::common::complex_pencils::{
    Complexes, aeroelastic_section, amax, complex, roots_by_qz, through,
};
use crate::common::log_log_slope;
use crate::common::tolerances::{COMPLEX_EIGEN_ROUND_OFF, EIGEN_ROUND_OFF, ORDER_SLACK, ROUND_OFF};
use corfem::method::appendix_c::general::complex_modes::{LeftRightModes, solve};
use corfem::method::appendix_c::general::{self, ModalChange};
use corfem::method::error::Error;
use nalgebra::{Complex, DMatrix, DVector};

/// The wing section before and after a change of flow and structure.
struct Section {
    stiffness: Complexes,
    modes: LeftRightModes<Complex<f64>>,
    stiffness_change: Complexes,
    change: ModalChange<Complex<f64>>,
    exact: Vec<Complex<f64>>,
}

/// More dynamic pressure, softer torsion, stiffer and damped hinge, heavier aileron.
fn section(size: f64) -> Section {
    let (real_stiffness, g) = aeroelastic_section(0.15);
    let mut stiffness_change = DMatrix::zeros(3, 3);
    stiffness_change[(1, 1)] = Complex::from(-0.4 * size);
    stiffness_change[(2, 2)] = Complex::new(0.04 * size, 0.02 * size);
    let (_, more_pressure) = aeroelastic_section(0.15 * (1.0 + size));
    let mut g_change = more_pressure - &g;
    g_change[(2, 2)] += Complex::from(0.01 * size);
    let modes = solve(&real_stiffness, &g).expect("the section has three modes");
    let stiffness = complex(&real_stiffness);
    let change =
        ModalChange::new(&stiffness, &modes, &stiffness_change, &g_change).expect("it fits");
    let exact = roots_by_qz(&(&stiffness + &stiffness_change), &(&g + &g_change));
    Section {
        stiffness,
        modes,
        stiffness_change,
        change,
        exact,
    }
}

/// The section's flow makes the roots complex and the left shapes other than the right ones.
#[test]
fn wing_section_is_complex_and_unsymmetric() {
    let Section {
        stiffness: k,
        modes,
        change,
        ..
    } = section(0.2);
    assert!(
        modes.roots.iter().all(|root| root.im < -1e-3),
        "{}",
        modes.roots
    );
    assert!(amax(&(&modes.left - &modes.right)) > 0.05);
    assert!(amax(&(&change.alpha - change.alpha.transpose())) > 1e-3);
    assert!(
        amax(&(through(&modes.left, &k, &modes.right) - complex(&DMatrix::identity(3, 3))))
            < EIGEN_ROUND_OFF
    );
    for i in 0..3 {
        assert!((change.generalized_stiffness[i] - 1.0).norm() < EIGEN_ROUND_OFF);
    }
}

/// A 40 % increase of dynamic pressure with its changes of stiffness and mass, by every method.
#[test]
fn wing_section_in_a_faster_flow_has_the_roots_of_the_dense_eigensolution() {
    let Section { change, exact, .. } = section(0.4);
    let error = |roots: &DVector<Complex<f64>>| largest_root_error(roots.as_slice(), &exact);
    let first = error(&general::first_order(&change).unwrap().roots);
    let original = error(&general::original(&change).unwrap().roots);
    let third = error(&general::recursive_1(&change, 3).unwrap().roots);
    let recursive_2 = error(&general::recursive_2(&change, 3).unwrap().roots);
    let converged = error(
        &general::recursive_1_converged(&change, 1e-14, 100)
            .unwrap()
            .perturbed
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
                let Section { change, exact, .. } = section(size);
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
    let change = section(0.3).change;
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
    let refused = ModalChange::new(&k, &same, &none, &none).err();
    let Some(Error::NotOrthonormal {
        what,
        first: 1,
        second: 0,
        expected: 0.0,
        found,
    }) = refused
    else {
        panic!("{refused:?}")
    };
    assert_eq!(
        what,
        "relative generalized stiffness of left and right modes"
    );
    assert!(
        (found * (product[(0, 0)] * product[(1, 1)]).norm().sqrt() - product[(1, 0)].norm()).abs()
            < ROUND_OFF
    );
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
    let Section {
        stiffness: k,
        modes,
        stiffness_change,
        change,
        ..
    } = section(0.3);
    let two = LeftRightModes {
        roots: modes.roots.rows(0, 2).into_owned(),
        right: modes.right.columns(0, 2).into_owned(),
        left: modes.left.columns(0, 2).into_owned(),
    };
    let part = ModalChange::new(&k, &two, &stiffness_change, &DMatrix::zeros(3, 3)).unwrap();
    assert_eq!(part.roots.len(), 2);
    assert_eq!(part.beta.shape(), (2, 2));
    assert!(amax(&(part.beta - change.beta.view((0, 0), (2, 2)))) < ROUND_OFF);
    assert_eq!(part.alpha, DMatrix::zeros(2, 2));
}
