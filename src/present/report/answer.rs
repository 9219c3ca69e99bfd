//! The answer of a report in one line, and its parameters in the order of what is surest.

use super::Report;
use crate::job::verdict::Outcome;
use crate::method::error_sum::Errors;
use crate::present::tables::RMS_PERCENT;
use crate::weighted::identifiability::MOSTLY_PRIOR;

/// Change of a factor that is named where no deviation is known. A frequency goes with the root of a stiffness: less than this moves none
/// by more than 0.25 %, half of the deviation that is assumed of measured frequencies.
const CHANGED: f64 = 0.005;
/// Most factors that the line names where no interval tells which of them differ.
const NAMED: usize = 3;

impl Report {
    /// The part of every parameter's prior variance that is left, where it is known.
    pub fn prior_shares(&self) -> Option<Vec<f64>> {
        let [_, best] = self.seen.as_ref()?;
        Some(best.learned.iter().map(|learned| 1.0 - learned).collect())
    }

    /// True of a parameter that the test modes hardly move, or that is known more from its prior than from the test.
    pub fn is_unseen(&self, parameter: usize) -> bool {
        let mut verdict = self.verdict.iter();
        let shares = self.prior_shares();
        verdict.any(|verdict| verdict.unseen.contains(&parameter))
            || shares.is_some_and(|shares| shares[parameter] > MOSTLY_PRIOR)
    }

    /// The standard deviation of the logarithm of a parameter's best factor, from data and prior, where it is known.
    pub fn log_deviation(&self, parameter: usize) -> Option<f64> {
        let [_, best] = self.seen.as_ref()?;
        Some(best.deviations[parameter])
    }

    /// The change of a factor's logarithm in standard deviations; in units of [`CHANGED`] where none is known.
    fn sureness(&self, parameter: usize) -> f64 {
        let change = self.factors()[parameter].ln().abs();
        let unit = self.log_deviation(parameter).unwrap_or(CHANGED);
        if change == 0.0 { 0.0 } else { change / unit }
    }

    /// Parameters, that with the surest change first, and those that the test hardly sees last, of which nothing is sure. Parameters that
    /// symmetry makes alike differ by round-off, which the digits of a single-precision number leave out; they stay in order.
    pub fn by_sureness(&self) -> Vec<usize> {
        let key = |e: usize| match self.is_unseen(e) {
            true => f32::INFINITY,
            false => -self.sureness(e) as f32,
        };
        let mut order: Vec<usize> = (0..self.parameters.len()).collect();
        order.sort_by(|&a, &b| key(a).total_cmp(&key(b)));
        order
    }

    /// One line: what is against it, the errors before and after, the factors that differ from 1, the surest change first, and how many do not.
    pub fn answer(&self) -> String {
        let against = match &self.verdict {
            _ if self.trust.iter().any(|trust| trust.stands_against()) => {
                "Not to be trusted as it stands: "
            }
            _ if self.missed.is_some() => "The model does not hold where it was not fitted: ",
            Some(verdict) if !verdict.is_within && self.is_judged_by_noise => {
                match (
                    self.misfit.is_some_and(|own| own.is_by_noise()),
                    verdict.outcome,
                ) {
                    (false, _) => "The model does not explain the test: ",
                    (_, Outcome::Untested) => "The test confirms nothing: ",
                    _ => "Steps ended short: ",
                }
            }
            Some(verdict) if !verdict.is_within => "Outside tolerance: ",
            _ => "",
        };
        let (first, last) = (&self.initial.errors, &self.corrected().errors);
        let rms = [first, last].map(Errors::frequency_rms);
        let held = self.held_out.iter();
        let of_frequency = held.clone().map(|own| own.frequency).collect();
        let mut parts = vec![fall("frequency", rms, first.frequency_count, of_frequency)];
        if self.test.len() > 0 {
            let rms = [first, last].map(Errors::shape_rms);
            let of_shape = held.filter_map(|own| own.shape).collect();
            parts.push(fall("shape", rms, first.shape_count, of_shape));
        }
        let errors = parts.join(", ");
        let interval = |e: usize| self.intervals.get(e)?.as_ref().ok();
        let is_judged = self.deviations.is_some();
        let differs = |e: &usize| match is_judged {
            true => interval(*e).is_some_and(|own| own.lower > 1.0 || own.upper < 1.0),
            false => self.sureness(*e) > 1.0 && !self.is_unseen(*e),
        };
        let named = |e: usize| {
            let percent = format!("{:+.1}", 100.0 * (self.factors()[e] - 1.0));
            format!("{} {} %", self.parameters[e], percent.replace('-', "−"))
        };
        let order = self.by_sureness();
        let all = order.len();
        let told = order.iter().filter(|e| interval(**e).is_some()).count();
        let most = if is_judged { all } else { NAMED };
        let changed: Vec<String> = order
            .into_iter()
            .filter(differs)
            .map(named)
            .take(most)
            .collect();
        let (count, names) = (changed.len(), changed.join(", "));
        let changed = match told {
            0 if is_judged => "no factor has an interval".to_owned(),
            0 => names,
            _ => format!(
                "{count} of {all} factors differ from 1 beyond their interval, if only these are wrong{}{names}; {} unchanged, {} unknown",
                if count > 0 { ": " } else { "" },
                told - count,
                all - told
            ),
        };
        let between = if changed.is_empty() { "" } else { "; " };
        let line = format!("{against}{errors}{between}{changed}.");
        line[..1].to_uppercase() + &line[1..]
    }
}

/// The fall of the root mean square errors of `count` modes, those that are held out told apart.
fn fall(what: &str, rms: [f64; 2], count: usize, held: Vec<[f64; 2]>) -> String {
    let squares = [0, 1].map(|end| held.iter().map(|own| own[end].powi(2)).sum::<f64>());
    let words = |squares: [f64; 2], count: usize| {
        let [first, last] =
            squares.map(|sum| RMS_PERCENT.write((sum.max(0.0) / count as f64).sqrt()));
        format!("{first} → {last} %")
    };
    let rest = [0, 1].map(|end| count as f64 * (100.0 * rms[end]).powi(2) - squares[end]);
    match held.len() {
        0 => format!("{what} error {}", words(rest, count)),
        out => format!(
            "{what} error {}, held out {}",
            words(rest, count - out),
            words(squares, out)
        ),
    }
}
