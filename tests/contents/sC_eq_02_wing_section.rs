//! Appendix C on a wing section with aileron in a flow: complex and unsymmetric, against the dense complex eigensolution.

use crate::common::complex_pencils::aeroelastic_section;
use crate::prelude::*;
use appendix_c::solve;

/// The wing section before and after a change of flow and structure.
struct Section {
    stiffness: Complexes,
    modes: LeftRightModes<Complex<f64>>,
    stiffness_change: Complexes,
    g_change: Complexes,
    changed: Pencil<Complex<f64>>,
    exact: Vec<Complex<f64>>,
}

/// More dynamic pressure, softer torsion, stiffer and damped hinge, heavier aileron.
fn section(size: f64) -> Section {
    let (real_stiffness, g) = aeroelastic_section(0.15);
    let mut stiffness_change = zero_square(3);
    stiffness_change[(1, 1)] = Complex::from(-0.4 * size);
    stiffness_change[(2, 2)] = Complex::new(0.04 * size, 0.02 * size);
    let (_, more_pressure) = aeroelastic_section(0.15 * (1.0 + size));
    let mut g_change = more_pressure - &g;
    g_change[(2, 2)] += Complex::from(0.01 * size);
    let modes = solve(&real_stiffness, &g).unwrap();
    let stiffness = complex(&real_stiffness);
    let changed = Pencil::new(&stiffness, &modes, &stiffness_change, &g_change).unwrap();
    let exact = roots_by_qz(&(&stiffness + &stiffness_change), &(&g + &g_change));
    Section {
        stiffness,
        modes,
        stiffness_change,
        g_change,
        changed,
        exact,
    }
}

/// The section's flow makes the roots complex and the left shapes other than the right ones.
#[test]
fn wing_section_is_complex_and_unsymmetric() {
    let Section {
        stiffness: k,
        modes,
        stiffness_change,
        g_change,
        changed,
        ..
    } = section(0.2);
    assert!(
        modes.roots.iter().all(|root| root.im < -1e-3),
        "{}",
        modes.roots
    );
    assert!(amax(&(&modes.left - &modes.right)) > 0.05);
    let alpha = through(&modes.left, &g_change, &modes.right);
    assert!(amax(&(&alpha - alpha.transpose())) > 1e-3);
    let identity = complex(&eye(3));
    assert!(amax(&(through(&modes.left, &k, &modes.right) - &identity)) < EIGEN_ROUND_OFF);
    // A = k + β and G = kΛ + α, with k = I.
    let beta = through(&modes.left, &stiffness_change, &modes.right);
    assert!(amax(&(changed.a() - beta - identity)) < EIGEN_ROUND_OFF);
    let lambda = DMatrix::from_diagonal(&modes.roots);
    assert!(amax(&(changed.g() - alpha - lambda)) < EIGEN_ROUND_OFF);
}

/// A 40 % increase of dynamic pressure with its changes of stiffness and mass, by every method.
#[test]
fn wing_section_in_a_faster_flow_has_the_roots_of_the_dense_eigensolution() {
    let Section { changed, exact, .. } = section(0.4);
    let error = |roots: &DVector<Complex<f64>>| largest_root_error(roots.as_slice(), &exact);
    let first = error(&changed.first_order().unwrap().roots);
    let original = error(&changed.original().unwrap().roots);
    let third = error(&changed.recursive_1(3).unwrap().roots);
    let recursive_2 = error(&changed.recursive_2(3).unwrap().roots);
    let converged = error(&changed.recursive_1_converged().unwrap().perturbed.roots);
    assert!(first > 1e-3, "{first:e}");
    assert!(original < first / 20.0, "{original:e} {first:e}");
    assert!(third < first / 100.0, "{third:e}");
    assert!(recursive_2 < original / 100.0, "{recursive_2:e}");
    assert!(converged < COMPLEX_EIGEN_ROUND_OFF, "{converged:e}");
}

/// The transposed change exchanges rows and columns and nothing else.
#[test]
fn transposed_change_belongs_to_the_left_shapes() {
    let changed = section(0.3).changed;
    let transposed = changed.transposed();
    assert_eq!(*transposed.a(), changed.a().transpose());
    assert_eq!(*transposed.g(), changed.g().transpose());
    assert_eq!(transposed.transposed(), changed);
}

#[test]
fn changes_that_do_not_fit_their_modes_are_refused() {
    let (stiffness, g) = aeroelastic_section(0.15);
    let k = complex(&stiffness);
    let modes = solve(&stiffness, &g).unwrap();
    let none = zero_square(3);
    assert!(Pencil::new(&k, &modes, &none, &none).is_ok());
    // The right shapes are not the left ones here.
    let same = LeftRightModes {
        left: modes.right.clone(),
        ..modes.clone()
    };
    let product = through(&modes.right, &k, &modes.right);
    let refused = Pencil::new(&k, &same, &none, &none).err();
    let Some(Error::Value {
        what: "coupling of left and right shapes",
        owner,
        value,
        expected: "zero",
    }) = refused
    else {
        panic!("{refused:?}")
    };
    assert_eq!(owner, "modes 1 and 0");
    assert_within(
        value * (product[(0, 0)] * product[(1, 1)]).norm().sqrt(),
        product[(1, 0)].norm(),
        ROUND_OFF,
    );
    let wrong = DMatrix::zeros(2, 3);
    for (what, stiffness, stiffness_change, g_change) in [
        ("stiffness", &wrong, &none, &none),
        ("stiffness change", &k, &wrong, &none),
        ("change of G", &k, &none, &wrong),
    ] {
        assert_refused(
            Pencil::new(stiffness, &modes, stiffness_change, g_change),
            Error::WrongShape {
                what,
                expected_rows: 3,
                expected_columns: 3,
                rows: 2,
                columns: 3,
            },
        );
    }
    let mut not_a_number = none.clone();
    not_a_number[(2, 1)] = Complex::new(f64::NAN, 0.0);
    assert_refused(
        Pencil::new(&k, &modes, &none, &not_a_number),
        Error::Value {
            what: "change of G",
            owner: "entry (2, 1)".into(),
            value: f64::NAN,
            expected: "a finite number",
        },
    );
    let fewer = LeftRightModes {
        left: modes.left.columns(0, 2).into_owned(),
        ..modes.clone()
    };
    assert_refused(
        Pencil::new(&k, &fewer, &none, &none),
        Error::WrongShape {
            what: "left shapes",
            expected_rows: 3,
            expected_columns: 3,
            rows: 3,
            columns: 2,
        },
    );
}

/// Two of three modes are enough to see a change through.
#[test]
fn fewer_modes_than_degrees_of_freedom_see_their_part_of_a_change() {
    let Section {
        stiffness: k,
        modes,
        stiffness_change,
        changed,
        ..
    } = section(0.3);
    let two = LeftRightModes {
        roots: modes.roots.rows(0, 2).into_owned(),
        right: modes.right.columns(0, 2).into_owned(),
        left: modes.left.columns(0, 2).into_owned(),
    };
    let part = Pencil::new(&k, &two, &stiffness_change, &zero_square(3)).unwrap();
    assert_eq!(part.a().shape(), (2, 2));
    assert!(amax(&(part.a() - changed.a().view((0, 0), (2, 2)))) < ROUND_OFF);
    // Without a change of G it is kΛ.
    let own = DMatrix::from_diagonal(&through(&two.left, &k, &two.right).diagonal());
    assert_eq!(*part.g(), own * DMatrix::from_diagonal(&two.roots));
}
