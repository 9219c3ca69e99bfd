//! Doubts about parameters' matrices that are no parts of the first model's, as far as the digits of the files tell.

use super::{
    LoadedJob,
    concern::{Check, Concern, Grade},
};
use crate::{
    files::error::FileError,
    sparse::{SparseMatrix, WholeShare},
};

impl LoadedJob {
    /// Doubts about parameters' matrices that have negative energy, exceed the first stiffness or mass, or are given twice; remarks where
    /// the signs of pivots do not tell.
    ///
    /// # Errors
    /// Errors of the first matrices and of a factorization's plan.
    pub(super) fn part_concerns(&self) -> Result<Vec<Concern>, FileError> {
        let (whole, check) = (&self.source.whole, Check::PartsOfTheModel);
        let (stiffness, mass) = whole.at(&self.ones())?;
        let mut all = Vec::new();
        for (what, first) in [("stiffness", &stiffness), ("mass", &mass)] {
            let mut parts: Vec<(&String, &SparseMatrix)> = Vec::new();
            for own in whole.parameters() {
                match &own.share {
                    // Elements of a deck are parts of its stiffness, each named once.
                    WholeShare::Stiffness(_) if self.source.deck.is_some() => (),
                    WholeShare::Stiffness(part) if what == "stiffness" => {
                        parts.push((&own.name, part))
                    }
                    WholeShare::Mass(part) if what == "mass" => parts.push((&own.name, part)),
                    _ => (),
                }
            }
            if parts.is_empty() {
                continue;
            }
            for (place, (name, part)) in parts.iter().enumerate() {
                let found = [
                    (
                        "negative-",
                        whole.is_negative(what, first, &[(1.0, part)]),
                        "has negative energy, more than its digits explain",
                    ),
                    (
                        "not-part-",
                        whole.is_negative(what, first, &[(1.0, first), (-1.0, part)]),
                        "is not part of the first model's, which without it has negative energy",
                    ),
                ];
                for (kind, found, what) in found {
                    let (grade, kind, words) = match found {
                        Ok(false) => continue,
                        Ok(true) => {
                            let words = format!("The matrix of parameter \"{name}\" {what}.");
                            (Grade::Doubt, kind, words)
                        }
                        Err(error) => {
                            let words = format!(
                                "Whether parameter \"{name}\" is part of the first model was not checked: {error}."
                            );
                            (Grade::NotChecked, "part-not-checked-", words)
                        }
                    };
                    all.push(Concern::new(grade, check, kind, &[name], words));
                }
                let twins = parts[..place].iter();
                let twins = twins.filter(|(_, twin)| twin.entries().eq(part.entries()));
                all.extend(twins.map(|(other, _)| {
                    let words =
                        format!("Parameters \"{other}\" and \"{name}\" have the same matrix.");
                    Concern::doubt(check, "twin-", &[other, name], words)
                }));
            }
        }
        Ok(all)
    }
}
