//! Which parameter is wrong: by the paper's unlimited factor, a slope that tells little about gross errors, and by single fits.

use crate::method::error::Error;
use crate::method::error_sum::ModeWeight;
use crate::method::inner_loop::{InnerSettings, first_factors};
use crate::method::model::ModalModel;
use crate::method::pairing::{Pairing, signed_assurance};
use crate::method::state::{ModalState, UpdateRule};
use crate::weighted::residuals::{residuals, residuals_of};
use serde::Serialize;

/// Factors tried first on either side of one, three decades of them.
const PLACES: i32 = 12;
/// Decades from one of them to the next.
const SPACING: f64 = 0.25;
/// Decades between neighbors at last: 1 %.
const FINEST: f64 = 0.004;

/// A parameter under suspicion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Suspect {
    /// The parameter, from zero.
    pub parameter: usize,
    /// The factor that it asks for.
    pub factor: f64,
    /// The evidence against it, by the measure of the ranking: the larger, the stronger.
    pub evidence: f64,
}

/// By the change $|c - 1|$ that the unlimited factors (13) of the first iteration ask for, the largest first.
///
/// # Errors
/// Those of [`first_factors`].
pub fn by_factor(model: &ModalModel, settings: &InnerSettings) -> Result<Vec<Suspect>, Error> {
    let suspect = |(parameter, factor): (usize, f64)| Suspect {
        parameter,
        factor,
        evidence: (factor - 1.0).abs(),
    };
    let factors = first_factors(model, settings)?;
    Ok(ranked(factors.into_iter().enumerate().map(suspect)))
}

/// By how far each parameter alone can lower $\frac{1}{2} \sum r^2$ of the weighted residuals, the farthest first.
///
/// The modes at a factor are an eigensolution in the modal coordinates of the one exact analysis there is. Factors are tried from
/// $10^{-3}$ to $10^3$, then halfway to the neighbors of the best, again and again. The fall is the logarithm of the likelihood ratio
/// of this one error against none.
///
/// # Errors
/// Those of [`residuals`].
pub fn by_single_fit(model: &ModalModel, weights: &[ModeWeight]) -> Result<Vec<Suspect>, Error> {
    let first = 0.5 * residuals(model, weights)?.norm_squared();
    let objective = |parameter: usize, log: f64| {
        let mut factors = vec![1.0; model.shares.len()];
        factors[parameter] = 10.0_f64.powf(log);
        let squares = || {
            let state = ModalState::at(model, factors, UpdateRule::Eigensolution)?;
            let pairing = pairing(model, &state)?;
            let residuals = residuals_of(&state.modes, &pairing, model, weights);
            Ok::<_, Error>(0.5 * residuals.norm_squared())
        };
        // A factor that leaves no modes of vibration cannot fit.
        squares().unwrap_or(f64::INFINITY)
    };
    // Other pairs alone are no evidence against a parameter.
    let start = match model.shares.is_empty() {
        true => first,
        false => first.min(objective(0, 0.0)),
    };
    let best = |parameter: usize| {
        let better = |best: (f64, f64), log: f64| {
            let value = objective(parameter, log);
            if value < best.0 { (value, log) } else { best }
        };
        let everywhere = (-PLACES..=PLACES).map(|place| SPACING * f64::from(place));
        let mut best = everywhere.fold((f64::INFINITY, 0.0), better);
        let mut step = SPACING;
        while step > FINEST {
            step /= 2.0;
            best = [best.1 - step, best.1 + step]
                .into_iter()
                .fold(best, better);
        }
        let (lowest, log) = best;
        Suspect {
            parameter,
            factor: 10.0_f64.powf(log),
            evidence: start - lowest,
        }
    };
    Ok(ranked((0..model.shares.len()).map(best)))
}

/// Pairs at a state far from the exact modes: there a mode of the test may continue none of them but a residual vector, of which
/// `cross` knows nothing.
fn pairing(model: &ModalModel, state: &ModalState) -> Result<Pairing, Error> {
    let count = model.vibration_count();
    if count == model.exact.modes.len() {
        return Ok(state.pairing.clone());
    }
    let vibrations = state.modes.shapes.columns(0, count).into_owned();
    let assurance = signed_assurance(&vibrations, &model.test.shapes)?;
    (model.pair)(&assurance.map(|close| close.signum() * close.abs().sqrt()))
}

fn ranked(suspects: impl Iterator<Item = Suspect>) -> Vec<Suspect> {
    let mut suspects: Vec<Suspect> = suspects.collect();
    suspects.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
    suspects
}
