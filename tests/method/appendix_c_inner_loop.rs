//! Close roots as the inner loop meets them: the state of a chain whose changed springs bring two roots together.

use crate::common::appendix_c::three_mass_chain;
use crate::common::tolerances::EIGEN_ROUND_OFF;
use corfem::method::appendix_c::{CloseRootsSettings, UpdateRule};
use corfem::method::error::Error;
use corfem::method::model::{DynamicModel, ModalProblem};
use nalgebra::DMatrix;

/// The chain with λ = 1, 4, 8, its six springs as parameters, and the modes of a stiffer chain as test modes.
fn chain() -> ModalProblem {
    let springs = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let grounds = springs.map(|ground| three_mass_chain(ground, [0.0; 3]));
    let couplings = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 3.0]];
    let betweens = couplings.map(|between| three_mass_chain([0.0; 3], between));
    let mass = DMatrix::identity(3, 3);
    let test_stiffness = three_mass_chain([1.2, 1.0, 0.9], [1.1, 1.0, 1.0]);
    let test = corfem::method::modes::solve(&test_stiffness, &mass, 3).expect("a held chain");
    let model = DynamicModel {
        stiffness: three_mass_chain([1.0, 1.0, 1.0], [1.0, 1.0, 3.0]),
        mass,
        shares: grounds
            .into_iter()
            .chain(betweens)
            .map(corfem::method::model::Share::Stiffness)
            .collect(),
    };
    ModalProblem::new(&model, &test, 3).expect("a held chain")
}

/// A third of spring 1-3 turns λ = 1, 4, 8 into 1, 4, 4. With springs near that the errors of the state are those of the
/// eigensolution, at it they are finite, and the default rule refuses it.
#[test]
fn state_where_two_roots_meet_is_that_of_the_eigensolution() {
    let problem = chain();
    let close = UpdateRule::CloseRoots(CloseRootsSettings::default());
    for distance in [0.1, 1e-2, -1e-3, 1e-4] {
        let factors = vec![1.0, 1.0, 1.0 - distance, 1.0, 1.0, 1.0 / 3.0 + distance];
        let found = problem.state_at(factors.clone(), close).unwrap();
        let exact = problem
            .state_at(factors, UpdateRule::Eigensolution)
            .unwrap();
        // Shapes turn by round-off over the distance of the roots.
        let tolerance = EIGEN_ROUND_OFF / distance.abs();
        assert!((found.errors.frequency - exact.errors.frequency).abs() < EIGEN_ROUND_OFF);
        assert!(
            (found.errors.shape - exact.errors.shape).abs() < tolerance,
            "{distance}"
        );
        let product = found.generalized_shapes.tr_mul(&found.generalized_shapes);
        assert!((product - DMatrix::identity(3, 3)).amax() < EIGEN_ROUND_OFF);
    }
    let meeting = vec![1.0, 1.0, 1.0, 1.0, 1.0, 1.0 / 3.0];
    let found = problem.state_at(meeting.clone(), close).unwrap();
    assert!((found.modes.omega_squared[1] / 4.0 - 1.0).abs() < EIGEN_ROUND_OFF);
    assert!((found.modes.omega_squared[2] / 4.0 - 1.0).abs() < EIGEN_ROUND_OFF);
    assert!(found.errors.sum().is_finite());
    assert!(matches!(
        problem.state_at(meeting, UpdateRule::default()),
        Err(Error::CoalescingModes { .. })
    ));
}
