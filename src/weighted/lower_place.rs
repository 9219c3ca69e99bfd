//! A lower place than an end of weighted steps, looked for from random ones.

use super::comparison::Comparison;
use super::gauss_newton::{LOWER, Problem, WeightedCorrelation, WeightedSettings};
use super::second_order::SecondOrder;
use super::starts::draw;
use crate::method::error::Error;
use crate::method::step::Bounds;
use crate::sparse::ModeWeight;

/// Random places from which steps start.
pub const PLACES: usize = 20;
/// Parts of the range of [`draw`], in logarithms, from which places nearer to the first model are drawn.
const NEARER: [f64; 2] = [1.0 / 3.0, 2.0 / 3.0];
/// Most steps from a place.
const TRIALS: usize = 24;

/// The factors of the lowest place that steps from [`PLACES`] random ones ([`draw`]) find by `follow`, if it is lower there than where they
/// end from the end itself by more than a thousandth. In a basis about the end frequencies far from it are too high, never too low: an exact
/// analysis decides what the place is worth. An end that `is_doubted` is left from places nearer to the first model, too, where none was
/// lower.
///
/// # Errors
/// The errors at the end itself; [`Error::Value`], [`Error::Range`] and [`Error::WrongShape`] for settings and lists out of range.
pub(crate) fn lower_place(
    end: &WeightedCorrelation,
    follow: &mut dyn FnMut(&[f64]) -> Result<Comparison, Error>,
    ranges: &[Option<Bounds>],
    weights: &[ModeWeight],
    settings: &WeightedSettings,
    seed: u64,
    is_doubted: bool,
) -> Result<Option<Vec<f64>>, Error> {
    let settings = WeightedSettings {
        trials: TRIALS,
        ..settings.clone()
    };
    let problem = Problem::new(end.factors.len(), ranges, weights, &settings)?;
    let mut lowest = |first: &[f64]| {
        let second_order = &mut SecondOrder::new(first.len());
        problem.lowest(second_order, follow, first, (LOWER, 0.0))
    };
    // A basis has a minimum of its own near the end.
    let (own, _) = lowest(&end.factors)?;
    let (mut least, mut place) = (own - LOWER, None);
    let nearer = if is_doubted { &NEARER[..] } else { &[] };
    for (width, seed) in [1.0].iter().chain(nearer).zip(seed..) {
        let mut state = seed;
        for _ in 0..PLACES {
            let first = draw(ranges.len(), &mut state).into_iter();
            let first: Vec<f64> = first.map(|factor| factor.powf(*width)).collect();
            let found = lowest(&first).ok().filter(|(found, _)| *found < least);
            if let Some((objective, factors)) = found {
                (least, place) = (objective, Some(factors));
            }
        }
        if place.is_some() {
            break;
        }
    }
    Ok(place)
}
