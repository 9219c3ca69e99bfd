//! Table 1: root errors of the original formulae, Recursive 1 and Recursive 2 on two-degree-of-freedom problems, and who
//! wins where. The paper's own numbers are lost in the scan, so the statements and not the digits are tested.

use crate::prelude::*;
use corfem::torque_box::table_1::{Formula, formulae};

fn worst(errors: [f64; 2]) -> f64 {
    errors[0].abs().max(errors[1].abs())
}

fn errors(problem: TwoMasses, formula: Formula) -> [f64; 2] {
    problem.root_errors(formula).unwrap()
}

/// Couplings of a quarter to four ground springs, changes of −50 to +100 %: the range of the table and a little more.
/// A change of less than 1 % is left out: all errors are round-off there.
fn two_masses() -> impl Strategy<Value = TwoMasses> {
    (0.25..4.0_f64, prop_oneof![-0.5..-0.01_f64, 0.01..1.0_f64])
        .prop_map(|(coupling, change)| TwoMasses { coupling, change })
}

properties! {
    /// The closed form is the eigensolution of the two masses' own matrices, and the modes before the change are those
    /// of k and β.
    #[test]
    fn exact_roots_are_those_of_the_structure(problem in two_masses()) {
        let TwoMasses { coupling, change } = problem;
        let stiffness = dmatrix![1.0 + coupling + change, -coupling; -coupling, 1.0 + coupling];
        let modes = solve(&stiffness, &eye(2), 2)?;
        let roots = problem.exact_roots();
        let of_eigensolution = exact(&problem.generalized_stiffness(), &problem.beta())?.roots;
        let modal = DMatrix::from_diagonal(&problem.generalized_stiffness()) + problem.beta();
        let of_modal = ascending(SymmetricEigen::new(modal).eigenvalues.iter());
        for i in 0..2 {
            prop_assert!((roots[i] * modes.omega_squared()[i] - 1.0).abs() < EIGEN_ROUND_OFF);
            prop_assert!((roots[i] * of_modal[i] - 1.0).abs() < EIGEN_ROUND_OFF);
            prop_assert!(relative_error(of_eigensolution[i], roots[i]) < EIGEN_ROUND_OFF);
        }
    }

    /// From third order on Recursive 2 is ahead of Recursive 1 at the same order.
    #[test]
    fn recursive_2_needs_fewer_orders_than_recursive_1(problem in two_masses(), order in 3..7_usize) {
        let one = worst(errors(problem, Formula::Recursive1 { order }));
        let two = worst(errors(problem, Formula::Recursive2 { order }));
        prop_assert!(two < one || two < ROUND_OFF, "{two:e} {one:e}");
    }

    /// First order puts the lower frequency too high and the upper one too low: the two modes repel each other.
    #[test]
    fn first_order_leaves_out_that_modes_repel(problem in two_masses()) {
        let first = errors(problem, Formula::FirstOrder);
        prop_assert!(first[0] < 0.0 && first[1] > 0.0);
    }

    /// The paper sees no need to go beyond second order of the explicit root: with changes to 20 % and a coupling no
    /// weaker than half a ground spring the root is right to 0.012 %, the frequency to 0.006 %.
    #[test]
    fn second_order_is_enough_for_moderate_changes(coupling in 0.5..4.0_f64, change in -0.2..0.2_f64) {
        let error = worst(errors(TwoMasses { coupling, change }, Formula::Original));
        prop_assert!(error < 1.2e-4, "{error:e}");
    }
}

/// Changes of exactly 3/4 with a unit coupling: ω² = (19 ± √73)/8, and Recursive 2 by hand.
#[test]
fn one_problem_by_hand() {
    let problem = TwoMasses {
        coupling: 1.0,
        change: 0.75,
    };
    let [lower, upper] = problem.exact_roots();
    assert_alike([lower * (19.0 - 73.0_f64.sqrt())], [8.0], ROUND_OFF);
    assert_alike([upper * (19.0 + 73.0_f64.sqrt())], [8.0], ROUND_OFF);
    assert_eq!(problem.generalized_stiffness().as_slice(), [1.0, 3.0]);
    assert_eq!(problem.beta(), DMatrix::repeat(2, 2, 0.375));
    // p = −0.375/(3.375 − 1.375), ω² = 1 + 0.375(1 + p).
    let original = errors(problem, Formula::Original);
    let root = 1.0 / (1.375 - 0.375 * 0.375 / 2.0);
    assert_within(original[0], root / lower - 1.0, ROUND_OFF);
}

#[test]
fn springs_that_are_not_positive_are_refused() {
    let refused = |coupling, change, (what, value, expected)| {
        let problem = TwoMasses { coupling, change };
        for formula in formulae(2) {
            assert_refused(
                problem.root_errors(formula),
                Error::Value {
                    what,
                    owner: "two masses".into(),
                    value,
                    expected,
                },
            );
        }
    };
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refused(value, 0.1, ("coupling", value, "a positive finite number"));
    }
    for value in [-1.0, -2.0, f64::NAN, f64::INFINITY] {
        refused(1.0, value, ("change", value, "a finite number above -1"));
    }
    let softest = TwoMasses {
        coupling: 2.0,
        change: -0.99,
    };
    assert!(
        softest
            .root_errors(Formula::Recursive1 { order: 60 })
            .is_ok()
    );
}
