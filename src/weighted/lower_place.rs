//! A lower place than an end of weighted steps, looked for in a basis about it.

use super::gauss_newton::{Problem, WeightedCorrelation, WeightedSettings};
use super::starts::draw;
use crate::method::error::Error;
use crate::method::step::Bounds;
use crate::sparse::{Deflections, ModeWeight};

/// Random places in the basis from which steps start.
pub const PLACES: usize = 20;
/// Fall of the objective below an end that is worth to go on: a chi-squared of two thousandths, which no test can tell.
pub(crate) const LOWER: f64 = 1e-3;
/// Most steps in the basis from a place.
const TRIALS: usize = 12;

/// The factors of the lowest place that steps from [`PLACES`] random ones ([`draw`]) find in a basis of the modes at an end and of so many
/// deflections of all parameters, if it is lower there than the end by more than a thousandth. In the basis frequencies far from the end
/// are too high, never too low: an exact analysis decides what the place is worth.
///
/// # Errors
/// The errors of the basis; [`Error::Value`], [`Error::Range`] and [`Error::WrongShape`] for settings and lists out of range.
pub(crate) fn lower_place(
    end: &WeightedCorrelation,
    deflections: usize,
    ranges: &[Option<Bounds>],
    weights: &[ModeWeight],
    settings: &WeightedSettings,
    seed: u64,
) -> Result<Option<Vec<f64>>, Error> {
    let basis = end.last.model.in_basis(Deflections::All(deflections))?;
    let basis = end.last.with_model(basis);
    let settings = WeightedSettings {
        trials: TRIALS,
        ..settings.clone()
    };
    let problem = Problem::new(end.factors.len(), ranges, weights, &settings)?;
    let mut follow = basis.about(&end.factors);
    // The basis has a minimum of its own near the end.
    let (own, _) = problem.lowest(&mut follow, &end.factors, (LOWER, 0.0))?;
    let (mut least, mut place, mut state) = (own - LOWER, None, seed);
    for _ in 0..PLACES {
        let first = draw(ranges.len(), &mut state);
        let found = problem.lowest(&mut follow, &first, (LOWER, 0.0));
        if let Some((objective, factors)) = found.ok().filter(|(found, _)| *found < least) {
            (least, place) = (objective, Some(factors));
        }
    }
    Ok(place)
}
