//! Correction of a finite element model from its measured modes.
//!
//! A finite element model (FEM) of a structure never quite has the natural frequencies and mode shapes that a
//! ground vibration test (GVT) measures on the real one. This crate finds factors on the stiffness of the model's
//! *elements* that bring the two together, so that the corrected model is still a structure somebody can build. It
//! is a reference implementation of a method of the 1980s for aerospace structures: derivatives and new modes come
//! from Van de Vooren's perturbation formulae instead of new eigensolutions.
//!
//! # The method, in the order data flows
//!
//! 1. [`structure`]: grids, materials, elements; [`torque_box`]: the paper's wing torque box;
//!    [`delta_wing`]: a larger structure that others have tested and analyzed.
//! 2. [`elements`]: rod, shear panel and membrane stiffness for unit gage ([`quadrature`] for the panel's energy, [`analytical`] for what
//!    it is compared with).
//! 3. [`assembly`]: the structural stiffness $K_S$ and its Cholesky factor.
//! 4. [`condensation`] (Appendix A): the dynamic stiffness $K_D$, and each element's share of it;
//!    [`model`] puts 1 to 4 together, with the [`parameters`] that may change.
//! 5. [`modes`]: frequencies and mass-orthonormal shapes ([`complex_modes`] with aerodynamic terms;
//!    [`spring_chain`]: structures whose modes are known); [`test_modes`] (Appendix B): measured ones made fit to compare.
//! 6. [`sorting`] (4) and [`objective`] (5, 6): which mode is which, and how far apart they are.
//! 7. [`perturbation`] (Appendix C), [`derivatives`] (12), [`step`] (13): what each element does, and how much
//!    to change it; [`table_1`] compares the perturbation formulae on two
//!    modes, where [`two_dof`] is exact.
//! 8. [`modal`], [`inner_loop`], [`outer_loop`]: steps by perturbation, checks by eigensolution, until they agree.
//! 9. [`deck`]: the model as NASTRAN bulk data; [`nastran95`]: the analysis by that program.
//! 10. [`cases`], [`published`], [`fit`], [`report`]: the paper's four cases beside the paper's own numbers;
//!     [`fewer_modes`]: what they lose when modes are left out; [`matrix_correction`], [`matrix_comparison`]: what
//!     corrections of whole matrices do instead.
//!     [`figures`] and [`html_report`] show them.
//!
//! # Units
//!
//! Inch, pound-force, second. Mass is in lbf·s²/in, modulus in lbf/in², stiffness in lbf/in, frequency in hertz,
//! squared circular frequency in rad²/s². Errors are fractions unless a name says percent. The equations hold in
//! any consistent system; nothing in the code converts.
//!
//! # Notation
//!
//! Numbers in parentheses such as (13) or (C.22) are the paper's equations. $K$ is stiffness, $M$ mass, $V$ mode
//! shapes with $V^t M V = I$, $\lambda = 1/\omega^2$ the root of Appendix C, $\beta = V^t \Delta K V$. `paper/errata.md` lists
//! where the print is wrong or ambiguous and what is done here.

#![deny(missing_docs)]
#![forbid(unsafe_code)]

pub mod method;

pub mod closed_forms;

pub mod cases;
pub mod studies;

pub mod files;

#[cfg(feature = "program")]
pub mod present;

/// The matrices and vectors of this crate's interface, so that a user needs no version of their own.
pub use nalgebra;

/// The README's code, compiled and run with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct ReadmeDoctests;
