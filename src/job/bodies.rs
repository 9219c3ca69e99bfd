//! Words about motions that a model leaves free, or resists with negative energy.

use super::concern::{Check, Concern, Grade, NONE, some};
use crate::{
    files::error::FileError,
    method::error::Error,
    sparse::{BodyFinding, FINITE, HalfUnit},
};
use std::fmt::Display;

/// What an analysis finds with so many modes, or with all of finite frequency where there are fewer, and their number.
pub fn with_as_many<T>(
    most: usize,
    analyze: impl Fn(usize) -> Result<T, Error>,
) -> Result<(usize, T), Error> {
    let modes = match analyze(most) {
        Err(Error::Count {
            what: FINITE,
            most: available,
            ..
        }) if available > 0 => available,
        found => return Ok((most, found?)),
    };
    Ok((modes, analyze(modes)?))
}

/// The error of an analysis in words on what is wrong with matrices whose stiffness is rounded so, with the way on. Rows have names.
pub fn explained(
    error: Error,
    file: impl Display,
    half_unit: HalfUnit,
    name: impl Fn(usize) -> String,
) -> FileError {
    let reason = match error {
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
        other => return other.into(),
    };
    FileError::refused(file, reason)
}

/// What the digits of a stiffness leave open, as a concern.
pub fn of_bodies(finding: &BodyFinding) -> Concern {
    let check = Check::FreeMotions;
    match finding {
        BodyFinding::Mechanisms(rows) => {
            let words = format!(
                "Motions of {} are none of a rigid body, and the digits of the stiffness do not tell that anything resists them: \
                 mechanisms, or springs too soft for it. They count as free; model.rigid_bodies decides.",
                some(rows)
            );
            Concern::doubt(check, "mechanisms", rows, words)
        }
        BodyFinding::Held { row, free } => {
            let words = format!(
                "Motions of a rigid body that are free: {free}; one that is not meets most force at {row}: held on purpose?"
            );
            Concern::remark(check, "held-direction", &[row], words)
        }
        BodyFinding::ByDigits {
            count,
            digits,
            if_held,
            hidden_hz,
            is_sure,
        } => {
            let held: Vec<String> = if_held
                .iter()
                .map(|[own, open]: &[f64; 2]| format!("{own:.1e} ± {open:.0e}"))
                .collect();
            let held = match &held[..] {
                [] => "taken as held".to_owned(),
                held => format!("at {} Hz if held", held.join(", ")),
            };
            let words = format!(
                "Not told from free by {digits} of the stiffness: {count}, {held}; a suspension below {hidden_hz:.0e} Hz would not show. \
                 Places of the rows, or model.rigid_bodies, decide."
            );
            Concern::new(
                if *is_sure {
                    Grade::NotChecked
                } else {
                    Grade::Doubt
                },
                check,
                "free-by-digits",
                &NONE,
                words,
            )
        }
    }
}
