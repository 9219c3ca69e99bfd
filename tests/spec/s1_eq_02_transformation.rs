//! (2), the transformation between dynamic and structural DOF, as printed.

use crate::common::appendix_c::three_mass_chain;
use crate::common::tolerances::MATRIX_ROUND_OFF;
use corfem::method::appendix_a::condense;
use nalgebra::dmatrix;

#[test]
fn transformation_of_2_is_right_as_printed() {
    // (2) prints B = K_D Tᵗ K_S⁻¹: the transpose of (A.7) and (A.8) with T there, for K_S and K_D are symmetric.
    let stiffness = three_mass_chain([1.0, 2.0, 0.5], [1.0, 1.0, 3.0]);
    let t = dmatrix![1.0, 0.5; 0.0, 1.0; 0.25, 0.0];
    let condensed = condense(&stiffness, &t).expect("independent");
    let printed = &condensed.stiffness * t.transpose() * stiffness.try_inverse().expect("held");
    assert!((printed.transpose() - condensed.transformation).amax() < MATRIX_ROUND_OFF);
}
