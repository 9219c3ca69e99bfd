//! NASTRAN decks: the model as bulk data, written and read.
//!
//! A deck holds what [`crate::method::model::FiniteElementModel`] holds and nothing of the correlation. The dynamic points are grids
//! of their own, tied to the structure by MPC equations whose coefficients are the load distribution $T$, with the masses on
//! them. The points are the dependent DOF, $q_D = T^t q_S$; a program that eliminates them puts
//!
//! $$ M_S = T M T^t $$
//!
//! on the structural DOF beside $K_S$. $M_S$ is singular: of the roots of $(K_S, M_S)$ as many are finite as there are
//! dynamic points, and these are the roots of $(K_D, M)$. With $F = T M^{1/2}$ the nonzero eigenvalues of $K_S^{-1} F F^t$
//! are those of
//!
//! $$ F^t K_S^{-1} F = M^{1/2} K_D^{-1} M^{1/2} $$
//!
//! which is similar to $K_D^{-1} M$. So NASTRAN's own solution of the deck must be the modes of Appendix A, and is.
//!
//! Reading: [`lines`] cuts a file into fields, [`continuation`] joins lines to [`card`]s, [`read()`] makes a model of them;
//! [`modes()`] finds its modes.

pub mod card;
mod constraints;
pub mod continuation;
mod elements;
pub mod lines;
pub mod model;
pub mod number;
mod numbered;
pub mod read;
pub mod write;

pub use model::{BulkData, PointMass, Tie, modes};
pub use read::{Deck, Reason, Unread, read};
pub use write::{Task, write};
