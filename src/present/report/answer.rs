//! The answer of a report in one line, and its parameters in the order of what is surest.

use super::Report;
use crate::job::verdict::Outcome;
use crate::method::error_sum::Errors;
use crate::method::step::Bounds;
use crate::present::table::Digits;
use crate::present::tables::RMS_PERCENT;
use crate::weighted::identifiability::MOSTLY_PRIOR;

/// Standard deviations of a logarithm beyond which its change is sure: noise alone, which is normal, is beyond them in 1 of 22 tests.
const SURE: f64 = 2.0;
/// Change of a factor that is named where no deviation is known. A frequency goes with the root of a stiffness: less than this moves none
/// by more than 0.25 %, half of the deviation that is assumed of measured frequencies.
const CHANGED: f64 = 0.005;
/// Distance of the ends of a factor's 95 % interval, a fraction of it, within which it counts as known: no frequency is uncertain by more
/// than 2.5 % for its sake, half of what models are customarily asked to come to their test within.
const KNOWN: f64 = 0.05;
/// Most factors that the line names, which is to be one line and a half of a terminal.
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
        let seen = self
            .seen
            .as_ref()
            .map(|[_, best]| best.deviations[parameter]);
        let deviation = || *self.deviations.as_ref()?.get(parameter)?;
        seen.or_else(|| Some(deviation()? / self.factors()[parameter]))
    }

    /// The change of a factor's logarithm in standard deviations; in units of [`CHANGED`] where none is known.
    fn sureness(&self, parameter: usize) -> f64 {
        let change = self.factors()[parameter].ln().abs();
        let unit = self.log_deviation(parameter).unwrap_or(CHANGED / SURE);
        if change == 0.0 { 0.0 } else { change / unit }
    }

    /// Parameters, that with the surest change first, and those that the test hardly sees last, of which nothing is sure. Parameters that
    /// symmetry makes alike differ by round-off, which the digits of a single-precision number leave out; they stay in order.
    pub fn by_sureness(&self) -> Vec<usize> {
        let key = |e: usize| match self.is_unseen(e) {
            true => f32::INFINITY,
            false => -self.sureness(e) as f32,
        };
        let keys: Vec<f32> = (0..self.parameters.len()).map(key).collect();
        let mut order: Vec<usize> = (0..keys.len()).collect();
        order.sort_by(|&a, &b| keys[a].total_cmp(&keys[b]));
        order
    }

    /// The fall of the root mean square errors of `count` modes, those that are held out told apart.
    fn fall(&self, what: &str, rms: [f64; 2], count: usize, held: Vec<[f64; 2]>) -> String {
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

    /// One line: what is against it, the errors before and after, the surest changes, and how many factors are known.
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
        let mut parts = vec![self.fall("frequency", rms, first.frequency_count, of_frequency)];
        if self.test.len() > 0 {
            let rms = [first, last].map(Errors::shape_rms);
            let of_shape = held.filter_map(|own| own.shape).collect();
            parts.push(self.fall("shape", rms, first.shape_count, of_shape));
        }
        let errors = parts.join(", ");
        let surest = self.by_sureness().into_iter().take(NAMED);
        let changed: Vec<String> = surest
            .filter(|&e| self.sureness(e) > SURE && !self.is_unseen(e))
            .map(|e| {
                let percent = 100.0 * (self.factors()[e] - 1.0);
                let sign = if percent < 0.0 { "−" } else { "+" };
                format!(
                    "{} {sign}{} %",
                    self.parameters[e],
                    Digits::Fixed(0).write(percent.abs())
                )
            })
            .collect();
        let changed = match &changed[..] {
            [] if self.stages.is_empty() => None,
            [] => Some("no factor surely changed".to_owned()),
            _ => Some(changed.join(", ")),
        };
        let all = self.intervals.iter().zip(self.factors());
        let off = all.filter_map(|(own, factor)| {
            let Bounds { lower, upper } = own.as_ref().ok()?;
            Some((upper / factor - 1.0).max(1.0 - lower / factor))
        });
        let known = self
            .deviations
            .as_ref()
            .map(|all| match off.clone().count() {
                0 => "no factor has an interval".to_owned(),
                _ => format!(
                    "{} of {} factors known within {:.0} %, if only these are wrong",
                    off.filter(|off| *off <= KNOWN).count(),
                    all.len(),
                    100.0 * KNOWN
                ),
            });
        let parts: Vec<String> = [errors].into_iter().chain(changed).chain(known).collect();
        let line = format!("{against}{}.", parts.join("; "));
        line[..1].to_uppercase() + &line[1..]
    }
}
