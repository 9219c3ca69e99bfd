//! NASTRAN decks: the model as bulk data, written and read.
//!
//! A deck contains what [`crate::method::model::FiniteElementModel`] contains and nothing of the correlation. The
//! dynamic points are grids of their own with the masses, tied to the structure by MPC equations whose coefficients are
//! the load distribution $T$. They are the dependent DOF, $q_D = T^t q_S$; a program that eliminates them puts
//!
//! $$ M_S = T M T^t $$
//!
//! on the structural DOF beside $K_S$. $M_S$ is singular: of the roots of $(K_S, M_S)$ as many are finite as there are
//! dynamic points, and these are the roots of $(K_D, M)$. With $F = T M^{1/2}$ the nonzero eigenvalues of
//! $K_S^{-1} F F^t$ are those of
//!
//! $$ F^t K_S^{-1} F = M^{1/2} K_D^{-1} M^{1/2} $$
//!
//! which is similar to $K_D^{-1} M$. So NASTRAN's own solution of the deck must be the modes of Appendix A, and is.
//!
//! Reading: `lines` cuts a file into fields and joins lines to cards, [`read()`] makes a model of those it knows, and
//! [`modes()`] finds its modes.

mod card;
mod constraints;
mod coordinates;
mod elements;
mod lines;
mod model;
mod modes;
#[doc(hidden)]
pub mod number;
mod read;
mod rewrite;
mod write;

pub(super) use card::Card;
pub(crate) use elements::Membership;
pub(super) use lines::cards;
pub(super) use write::Cards;

pub use model::{BulkData, PointMass, Tie};
#[doc(hidden)]
pub use modes::{modes, moving};
pub use read::{Deck, Reason, Unread, read};
pub use rewrite::rewrite;
#[doc(hidden)]
pub use write::write;
