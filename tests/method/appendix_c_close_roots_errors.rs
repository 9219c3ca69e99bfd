//! What the rule for close roots refuses, and that the offender is named.

use crate::common::close_roots::{repeated_chain, separate_chain, spring_change};
use crate::common::tolerances::{CANCELLED_DIFFERENCE, ROUND_OFF};
use corfem::method::appendix_c::close_roots::{CloseRootsSettings, close_roots};
use corfem::method::appendix_c::general::ModalChange;
use corfem::method::error::Error;
use nalgebra::{DMatrix, DVector, dvector};

#[test]
fn settings_out_of_range_are_refused() {
    let (_, _, modes) = separate_chain();
    let change = spring_change(&modes, [0.1, 0.0, 0.0], [0.0; 3]);
    for separation in [-0.1, 1.1, f64::NAN] {
        assert!(matches!(
            close_roots(&change, CloseRootsSettings { separation, ..CloseRootsSettings::default() }),
            Err(Error::Setting { name: "separation", expected: "between 0 and 1", found }) if found.to_bits() == separation.to_bits()
        ));
    }
    assert!(matches!(
        close_roots(
            &change,
            CloseRootsSettings {
                orders: 0,
                ..CloseRootsSettings::default()
            }
        ),
        Err(Error::Setting { name: "order", .. })
    ));
    for separation in [0.0, 1.0] {
        assert!(
            close_roots(
                &change,
                CloseRootsSettings {
                    separation,
                    ..CloseRootsSettings::default()
                }
            )
            .is_ok()
        );
    }
}

#[test]
fn changes_that_are_no_vibrations_are_refused() {
    let good = ModalChange::of_vibrations(
        &dvector![1.0, 1.0, 3.0],
        DMatrix::zeros(3, 3),
        DMatrix::zeros(3, 3),
    );
    let error = |edit: fn(&mut ModalChange<f64>)| {
        let mut change = good.clone();
        edit(&mut change);
        close_roots(&change, CloseRootsSettings::default()).expect_err("no vibrations")
    };
    assert!(matches!(
        error(|change| change.beta[(2, 0)] = 0.1),
        Error::NotSymmetric {
            what: "generalized stiffness change",
            row: 2,
            column: 0,
            ..
        }
    ));
    assert!(matches!(
        error(|change| change.alpha[(0, 1)] = 0.1),
        Error::NotSymmetric {
            what: "generalized mass change",
            row: 1,
            column: 0,
            ..
        }
    ));
    assert!(matches!(
        error(|change| change.alpha[(1, 1)] = -1.1),
        Error::NotPositiveDefinite {
            what: "changed generalized mass",
            dof: 1
        }
    ));
    assert!(matches!(
        error(|change| change.beta[(2, 2)] = -4.0),
        Error::LostRoot {
            mode: 2,
            value: -1.0
        }
    ));
    assert!(matches!(
        error(|change| change.beta[(1, 1)] = -1.0),
        Error::LostStiffness { mode: 1, .. }
    ));
    assert!(matches!(
        error(|change| change.beta[(0, 0)] = f64::NAN),
        Error::NotFinite {
            what: "generalized stiffness change",
            row: 0,
            column: 0,
            ..
        }
    ));
    assert!(matches!(
        error(|change| change.roots = DVector::zeros(0)),
        Error::Empty { what: "modes" }
    ));
    // The pair's own problem loses a root: [[1, 1.5], [1.5, 1]] has eigenvalues −0.5 and 2.5.
    let mut coupled = good.clone();
    coupled.generalized_stiffness = dvector![3.0, 1.0, 1.0];
    coupled.roots = dvector![1.0 / 3.0, 1.0, 1.0];
    coupled.beta[(1, 2)] = 1.5;
    coupled.beta[(2, 1)] = 1.5;
    assert!(matches!(
        close_roots(&coupled, CloseRootsSettings::default()),
        Err(Error::LostRoot { mode: 1, value }) if (value + 2.0).abs() < ROUND_OFF
    ));
}

/// With separation zero nothing is a block, and a repeated root is the typed error of Recursive 1.
#[test]
fn without_blocks_a_repeated_root_is_refused_and_named() {
    let (_, _, modes) = repeated_chain();
    let mut change = spring_change(&modes, [0.0; 3], [0.0; 3]);
    change.generalized_stiffness = dvector![1.0, 4.0, 4.0];
    change.roots = dvector![1.0, 0.25, 0.25];
    change.beta.fill(0.0);
    let settings = CloseRootsSettings {
        separation: 0.0,
        ..CloseRootsSettings::default()
    };
    assert!(matches!(
        close_roots(&change, settings),
        Err(Error::CoalescingModes {
            first: 2,
            second: 1,
            separation: 0.0
        })
    ));
    // Two parts in a thousand million are enough for the denominator; a tenth of that is not.
    change.generalized_stiffness[2] = 4.0 * (1.0 + 2e-9);
    change.roots[2] = 0.25 / (1.0 + 2e-9);
    assert!(close_roots(&change, settings).is_ok());
    change.generalized_stiffness[2] = 4.0 * (1.0 + 2e-10);
    change.roots[2] = 0.25 / (1.0 + 2e-10);
    assert!(matches!(
        close_roots(&change, settings),
        Err(Error::CoalescingModes { first: 2, second: 1, separation }) if (separation / 2e-10 - 1.0).abs() < CANCELLED_DIFFERENCE
    ));
}
