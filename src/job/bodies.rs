//! Words about motions that a model leaves free, or resists with negative energy.

use crate::method::error::Error;
use crate::sparse::rigid_bodies::digits;

/// Sentence on what is wrong with matrices whose stiffness is rounded by up to a part, with the way on; none for other errors. Rows have names.
pub(super) fn explained(
    error: &Error,
    rounding: f64,
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
            digits(rounding)
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
            digits(rounding)
        ),
        _ => return None,
    })
}
