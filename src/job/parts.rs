//! Doubts about parameters' matrices that are no parts of the first model's, as far as the digits of the files tell.

use super::LoadedJob;
use super::concern::{Check, Concern, Grade, some};
use crate::files::error::FileError;
use crate::method::error::Error;
use crate::sparse::brackets::Excess;
use crate::sparse::{SparseMatrix, WholeShare};
use nalgebra::DVector;

/// Part of the energy of an offending motion that the parameters named have together.
const NAMED: f64 = 0.9;

/// A parameter's name and matrix.
type Part<'a> = (&'a str, &'a SparseMatrix);

impl LoadedJob {
    /// Doubts about parameters' matrices that have negative energy, exceed the first stiffness or mass, one by one or together, or are
    /// given twice; remarks where the signs of pivots do not tell.
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
            all.extend(answer(found, |_| doubt(kind, &[name], words), name));
        }
        let twins = parts[..place].iter();
        let twins = twins.filter(|(_, twin)| twin.entries().eq(part.entries()));
        all.extend(twins.map(|(other, _)| {
            let words = format!("Parameters \"{other}\" and \"{name}\" have the same matrix.");
            doubt("twin-", &[other, name], words)
        }));
    }
    if !all.iter().any(Concern::stands) {
        let together: Vec<_> = parts.iter().map(|(_, part)| (-1.0, *part)).collect();
        let too_much = |motion: DVector<f64>| {
            let most = most_energy(parts, &motion);
            let words = format!(
                "The parameters' matrices together are more than the first {what}, most by {}: is a part in two of them?",
                some(&most)
            );
            doubt(&format!("sum-of-{what}"), &most, words)
        };
        all.extend(answer(excess.of(1.0, &together), too_much, "all"));
    }
    Ok(all)
}

/// The doubt about a motion of negative energy, or a remark where there is no answer.
fn answer(
    found: Result<Option<DVector<f64>>, Error>,
    doubt: impl FnOnce(DVector<f64>) -> Concern,
    name: &str,
) -> Option<Concern> {
    match found {
        Ok(motion) => motion.map(doubt),
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

/// The parameters that have most of the energy of all in a motion.
fn most_energy<'a>(parts: &[Part<'a>], motion: &DVector<f64>) -> Vec<&'a str> {
    let energy = |part: &SparseMatrix| {
        let all = part.entries();
        all.map(|(row, column, value)| motion[row] * value * motion[column])
            .sum::<f64>()
    };
    let mut energies: Vec<_> = parts
        .iter()
        .map(|(name, part)| (energy(part), *name))
        .collect();
    energies.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut left = NAMED * energies.iter().map(|(energy, _)| energy).sum::<f64>();
    let is_named = |(energy, _): &&(f64, &str)| {
        let is_named = left > 0.0;
        left -= energy;
        is_named
    };
    energies
        .iter()
        .take_while(is_named)
        .map(|(_, name)| *name)
        .collect()
}
