//! Appendix C as the inner loop meets it: the state of a chain by recursion and by eigensolution, near a meeting of two roots and at
//! it, and changes of mass that take too much.

use crate::prelude::*;

/// The chain with λ = 1, 4, 8, its six springs as parameters, and the modes of a stiffer chain as test modes.
fn chain() -> ModalModel {
    let springs = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let grounds = springs.map(|ground| three_mass_chain(ground, [0.0; 3]));
    let couplings = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 3.0]];
    let betweens = couplings.map(|between| three_mass_chain([0.0; 3], between));
    let mass = eye(3);
    let test_stiffness = three_mass_chain([1.2, 1.0, 0.9], [1.1, 1.0, 1.0]);
    let test = solve(&test_stiffness, &mass, 3).unwrap();
    let model = DynamicModel {
        stiffness: three_mass_chain([1.0, 1.0, 1.0], [1.0, 1.0, 3.0]),
        mass,
        shares: grounds.into_iter().chain(betweens).collect(),
    };
    model.analyze(&test, Some(3)).unwrap()
}

/// Ground spring 1 of 1.3 and spring 1-3 of 0.95 bring the first-order roots of modes 1 and 2 to 4.05, coupled: Recursive 1
/// refuses the state and names them, the eigensolution has it, and shapes of unit generalized mass.
#[test]
fn state_where_two_roots_meet_is_the_eigensolutions_alone() {
    let model = chain();
    let meeting = [1.3, 1.0, 1.0, 1.0, 1.0, 0.95 / 3.0];
    assert!(matches!(
        model.at(&meeting),
        Err(Error::CoalescingModes {
            first: 2,
            second: 1,
            ..
        })
    ));
    let found = exact_state(&model, &meeting).unwrap();
    // Both are turned by 45 degrees, 0.3/√12 to either side of 4.05 but for what mode 0 adds.
    for (mode, side) in [(1, -1.0), (2, 1.0)] {
        let expected = 4.05 + side * 0.3 / 12_f64.sqrt();
        let found = found.modes.omega_squared()[mode];
        assert!(relative_error(found, expected) < 0.01, "{found} {expected}");
    }
    let generalized = &found.generalized_shapes;
    let product = generalized.tr_mul(generalized);
    assert!((product - eye(3)).amax() < EIGEN_ROUND_OFF);
    assert!(found.errors.sum().is_finite());
}
