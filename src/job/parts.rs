//! Doubts about parameters' matrices that are no parts of the first model's, as far as the digits of the files tell.

use super::LoadedJob;
use super::concern::{Check, Concern, Grade};
use crate::files::error::FileError;
use crate::method::error::Error;
use crate::sparse::brackets::Excess;
use crate::sparse::{SparseMatrix, WholeShare};
use nalgebra::DVector;

/// A parameter's name and matrix.
type Part<'a> = (&'a str, &'a SparseMatrix);

impl LoadedJob {
    /// Doubts about parameters' matrices that have negative energy, exceed the first stiffness or mass, or are given twice; remarks where the signs of pivots do not tell.
    ///
    /// # Errors
    /// Errors of the first matrices and of a factorization's plan.
    pub(super) fn part_concerns(&self) -> Result<Vec<Concern>, FileError> {
        let (stiffness, mass) = self.source.whole.at(&self.ones())?;
        let (mut of_stiffness, mut of_mass): (Vec<Part>, Vec<Part>) = Default::default();
        for parameter in self.source.whole.parameters() {
            match &parameter.share {
                // Elements of a deck are parts of its stiffness, each named once.
                WholeShare::Stiffness(_) if self.source.deck.is_some() => (),
                WholeShare::Stiffness(part) => of_stiffness.push((&parameter.name, part)),
                WholeShare::Mass(part) => of_mass.push((&parameter.name, part)),
            }
        }
        let mut all = concerns_of("stiffness", &stiffness, &of_stiffness)?;
        all.extend(concerns_of("mass", &mass, &of_mass)?);
        Ok(all)
    }
}

fn doubt(name: &str, about: &[&str], words: String) -> Concern {
    Concern::doubt(Check::PartsOfTheModel, name, about, words)
}

fn concerns_of(
    what: &'static str,
    whole: &SparseMatrix,
    parts: &[Part],
) -> Result<Vec<Concern>, Error> {
    let mut all = Vec::new();
    if parts.is_empty() {
        return Ok(all);
    }
    let excess = Excess::beside(what, whole)?;
    for (place, (name, part)) in parts.iter().enumerate() {
        let own = excess.of(0.0, &[(1.0, part)]);
        let rest = excess.of(1.0, &[(-1.0, part)]);
        for (found, kind, what) in [
            (
                own,
                "negative-",
                "has negative energy, more than its digits explain",
            ),
            (
                rest,
                "not-part-",
                "is not part of the first model's, which without it has negative energy",
            ),
        ] {
            let words = format!("The matrix of parameter \"{name}\" {what}.");
            all.extend(answer(found, doubt(kind, &[name], words), name));
        }
        let twins = parts[..place].iter();
        let twins = twins.filter(|(_, twin)| twin.entries().eq(part.entries()));
        all.extend(twins.map(|(other, _)| {
            let words = format!("Parameters \"{other}\" and \"{name}\" have the same matrix.");
            doubt("twin-", &[other, name], words)
        }));
    }
    Ok(all)
}

/// The doubt where there is a motion of negative energy, or a remark where there is no answer.
fn answer(
    found: Result<Option<DVector<f64>>, Error>,
    doubt: Concern,
    name: &str,
) -> Option<Concern> {
    match found {
        Ok(motion) => motion.map(|_| doubt),
        Err(error) => {
            let words = format!(
                "Whether parameter \"{name}\" is part of the first model was not checked: {error}."
            );
            Some(Concern::new(
                Grade::NotChecked,
                Check::PartsOfTheModel,
                "part-not-checked-",
                &[name],
                words,
            ))
        }
    }
}
