//! (A.7) and (A.8) as printed.

use crate::common::appendix_c::three_mass_chain;
use crate::common::tolerances::{MATRIX_ROUND_OFF, WRONG_FORM};
use corfem::method::appendix_a::condense;
use corfem::torque_box::Case;
use nalgebra::{DMatrix, dmatrix};

#[test]
fn print_of_a_7_and_a_8_has_a_transpose_too_many() {
    // (A.7), (A.8) print Bᵗ = K_S⁻¹ Tᵗ K_D, where Tᵗ has not as many rows as K_S.
    let model = Case::new(1).expect("a case").model().expect("a model");
    let t = &model.load_distribution().clone();
    assert_eq!(t.nrows(), model.structure().free_dof().len());
    assert_ne!(t.transpose().nrows(), t.nrows());
    // Where it has as many, the product exists and is not the inverse of q_D = Tᵗ q_S (A.4), as q_S = Bᵗ q_D has to be.
    let stiffness = three_mass_chain([1.0, 2.0, 0.5], [1.0, 1.0, 3.0]);
    let t = dmatrix![1.0, 0.5, 0.0; 0.0, 1.0, 0.0; 0.25, 0.0, 1.0];
    let condensed = condense(&stiffness, &t).expect("independent");
    let there_and_back = |b: &DMatrix<f64>| (t.tr_mul(b) - DMatrix::identity(3, 3)).amax();
    let printed = stiffness.try_inverse().expect("held") * t.transpose() * &condensed.stiffness;
    assert!(there_and_back(&condensed.transformation) < MATRIX_ROUND_OFF);
    assert!(there_and_back(&printed) > WRONG_FORM);
}
