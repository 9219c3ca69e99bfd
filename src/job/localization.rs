//! Which parameter is wrong, by single fits.

use crate::{
    method::{error::Error, modes::Modes, sorting::Pairing},
    sparse::{ModeWeight, pair_cheaply},
    weighted::{
        comparison::Comparison,
        residuals::{residuals, residuals_of},
    },
};
use nalgebra::DMatrix;
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

impl Suspect {
    /// True if the factor is where the search of [`by_single_fit`] ends: a larger or smaller one may explain more.
    pub fn is_at_edge(&self) -> bool {
        self.factor.log10().abs() > (SPACING * f64::from(PLACES)) - FINEST
    }
}

/// By how far each parameter alone can lower $\frac{1}{2} \sum r^2$ of the weighted residuals, the farthest first.
///
/// The modes at a factor are an eigensolution in the modal coordinates of the one exact analysis there is. Factors are tried from
/// $10^{-3}$ to $10^3$, then halfway to the neighbors of the best, again and again. The fall is the logarithm of the likelihood ratio
/// of this one error against none. At every factor the pairs are those that leave the least.
///
/// # Errors
/// Those of [`residuals`].
pub fn by_single_fit(
    comparison: &Comparison,
    weights: &[ModeWeight],
) -> Result<Vec<Suspect>, Error> {
    let first = unexplained(comparison, weights)?;
    let best = |parameter: usize| {
        let model = comparison.model.in_basis(Some(parameter), |whole| {
            whole.leading(parameter, usize::MAX)
        })?;
        // A factor that leaves no modes of vibration cannot fit.
        let objective = |log: f64| {
            let modes = model.modes(&[10.0_f64.powf(log)]);
            let least = modes.and_then(|modes| least(&modes, comparison, weights));
            least.unwrap_or(f64::INFINITY)
        };
        let better = |best: (f64, f64), log: f64| {
            let value = objective(log);
            if value < best.0 { (value, log) } else { best }
        };
        let mut best = (-PLACES..=PLACES)
            .map(|place| SPACING * f64::from(place))
            .fold((first, 0.0), better);
        let mut step = SPACING;
        while step > FINEST {
            step /= 2.0;
            best = [best.1 - step, best.1 + step]
                .into_iter()
                .fold(best, better);
        }
        let (lowest, log) = best;
        Ok(Suspect {
            parameter,
            factor: 10.0_f64.powf(log),
            evidence: first - lowest,
        })
    };
    let count = comparison.model.moves.ncols();
    let mut suspects = (0..count).map(best).collect::<Result<Vec<_>, Error>>()?;
    // Parameters that symmetry makes alike differ by round-off, which the digits of a single-precision number leave out; they stay in order.
    suspects.sort_by(|a, b| (b.evidence as f32).total_cmp(&(a.evidence as f32)));
    Ok(suspects)
}

/// Half the weighted squared error that no parameter explains yet: that of the first model in the pairs that leave the least.
///
/// # Errors
/// Errors of [`residuals`].
pub fn unexplained(comparison: &Comparison, weights: &[ModeWeight]) -> Result<f64, Error> {
    let own = 0.5 * residuals(comparison, weights)?.norm_squared();
    Ok(least(&comparison.model.exact.modes, comparison, weights)?.min(own))
}

/// The least of $\frac{1}{2} \sum r^2$ over all pairs of these modes with the test's.
///
/// # Errors
/// Errors of [`pair_cheaply`].
fn least(modes: &Modes, comparison: &Comparison, weights: &[ModeWeight]) -> Result<f64, Error> {
    let (rows, tests) = comparison.model.test.shapes.shape();
    let with = |partners| {
        residuals_of(
            modes,
            &Pairing {
                analysis_mode: partners,
                sign: vec![1.0; tests],
            },
            comparison,
            weights,
        )
    };
    // What each mode leaves of every test mode (columns) that it answers.
    let mut costs = DMatrix::zeros(modes.len(), tests);
    for mode in 0..modes.len() {
        let left = with(vec![mode; tests]);
        for test in 0..tests {
            costs[(mode, test)] = left.rows((1 + rows) * test, 1 + rows).norm_squared();
        }
    }
    let (partners, _) = pair_cheaply(&costs)?;
    Ok(0.5 * with(partners.into_iter().flatten().collect()).norm_squared())
}
