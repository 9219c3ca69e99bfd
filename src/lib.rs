//! Correction of a finite element model from its measured modes.
//!
//! A finite element model (FEM) of a structure never quite has the natural frequencies and mode shapes that a
//! ground vibration test (GVT) measures on the real one. This crate finds factors on the stiffness of the model's
//! *elements* that bring the two together, so that the corrected model is still a structure somebody can build. It
//! is a reference implementation of a method of the 1980s for aerospace structures: derivatives and new modes come
//! from Van de Vooren's perturbation formulae instead of new eigensolutions.
//!
//! # Contents
//!
//! The crate is a house of rooms; each imports only from those above it in this list, and [`method`] from none.
//!
//! - [`method`]: the paper, in its own order: plain functions over dense matrices. Read this first, and read it as a text:
//!   1. [`structure`](method::structure) and [`elements`](method::elements): the finite element model;
//!   2. [`appendix_a`](method::appendix_a): its stiffness $K_S$, and from structural to dynamic degrees of freedom (1, 2);
//!   3. [`modes`](method::modes) (3) and [`appendix_b`](method::appendix_b): exact modes, and measured ones made fit to compare;
//!   4. [`sorting`](method::sorting) (4) and [`error_sum`](method::error_sum) (5, 6): which mode is which, and how far apart;
//!   5. [`perturbation`](method::perturbation) (7, 8): new modes after a change of stiffness, without an eigensolution;
//!      [`appendix_c`](method::appendix_c): the same with changes of mass, and of complex modes;
//!   6. [`changed_modes`](method::changed_modes) (9 to 11): frequencies and shapes of the new modes;
//!   7. [`analysis`](method::analysis): four questions that the loops ask; [`derivatives`](method::derivatives) (12) and
//!      [`step`](method::step) (13): from errors to stiffness factors and their limits;
//!   8. [`model`](method::model), which answers the questions as the paper does;
//!   9. [`inner_loop`](method::inner_loop) and [`outer_loop`](method::outer_loop).
//!
//!   Under them all lie [`error`](method::error) and [`linear_algebra`](method::linear_algebra).
//! - [`sparse`]: the same analysis at any size, modes of whole models, counted, and their comparison at sensors.
//! - [`weighted`]: residuals in units of their standard deviations, noise on test modes, weighted steps, and what the test
//!   sees of the parameters.
//! - [`torque_box`]: the paper's wing torque box, its four cases, its tables. [`chain`] has the smallest structures, for examples.
//! - [`files`]: NASTRAN decks, matrices, tests.
//! - [`job`]: a user's structure, from its files to the corrected model and its [`verdict`](job::verdict), with a pre-flight that
//!   names mistakes in model and test before the first step.
//! - [`tour`]: twelve chapters that teach the method, with code that runs. Read this first if the paper is new to you.
//! - [`specification`]: every equation on one page, with its tests and the wrong forms that they notice.
//! - `present` and the program `corfem`, with the feature `program`: tables, figures, a page, commands. How the paper's own cases are
//!   shown stands beside the paper, in `paper/presentation`.
//!
//! ```text
//!  structure           grids, gages                     ◄─────────────────┐
//!      │                                                                  │
//!      ▼                                                                  │
//!  element stiffness   rod, shear panel, membrane                         │
//!      │                                                                  │
//!      ▼                                                                  │
//!  condensation        K_S, then K_D and every share (A)                  │
//!      │                                                       outer loop:│
//!      ▼                                                        new gages,│
//!  exact modes (3)                                             exact check│
//!      │                                                                  │
//!      ▼                                                                  │
//!  sorting (4)         with the test modes (B)                            │
//!      │                                                                  │
//!      ▼                                                                  │
//!  error sum (5, 6) ◄────────────────────────┐                            │
//!      │                          inner loop │                            │
//!      ▼                                     │                            │
//!  derivatives (12) ──► factors (13) ──► new modes (C)                    │
//!                                            │ e_S small, or a minimum    │
//!                                            └────────────────────────────┘
//! ```
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
//! shapes with $V^t M V = I$, $\lambda = 1/\omega^2$ the root of Appendix C, $\beta = V^t \Delta K V$.
//! `paper/errata.md` lists where print or scan is wrong, `paper/print_and_box.md` where the text leaves a choice.
//!
#![doc = include_str!("../paper/library.md")]
#![deny(missing_docs)]
#![forbid(unsafe_code)]
#![warn(clippy::too_many_lines)]

pub mod method;
pub mod sparse;
pub mod weighted;
pub mod chain;
pub mod torque_box;
pub mod files;
pub mod job;
#[cfg(feature = "program")]
pub mod present;
pub mod tour;

pub mod specification {
    #![doc = include_str!("../paper/specification.md")]
}

/// The matrices and vectors of this crate's interface, so that a user needs no version of their own. `use corfem::nalgebra;` makes
/// the paths resolve that macros such as `dvector!` expand to.
pub use nalgebra;

/// The README's code, compiled and run with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct ReadmeDoctests;
