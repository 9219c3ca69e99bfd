//! Words about motions that a model leaves free, or resists with negative energy.

use crate::method::error::Error;
use crate::sparse::HalfUnit;

/// Sentence on what is wrong with matrices whose stiffness is rounded so, with the way on; none for other errors. Rows have names.
pub(super) fn explained(
    error: &Error,
    half_unit: HalfUnit,
    name: impl Fn(usize) -> String,
) -> Option<String> {
    Some(match *error {
        Error::NotPositiveDefinite {
            what: "stiffness",
            row,
        } => format!(
            "model.stiffness has negative energy in a motion of {}, more than {} explain: is a number cut off, a sign wrong or a row \
             exchanged? Write it with all its digits",
            name(row),
            half_unit.words()
        ),
        Error::NotPositiveDefinite {
            what: "mass of rigid-body motions",
            row,
        } => format!(
            "a motion of {} has neither stiffness nor mass: hold it, give it a mass, or leave its row out of the matrices",
            name(row)
        ),
        Error::Count {
            what: "motions that the stiffness leaves free",
            found,
            most,
            ..
        } => format!(
            "model.rigid_bodies is {found}, but {} of model.stiffness leave at most {most} motions free",
            half_unit.words()
        ),
        _ => return None,
    })
}
