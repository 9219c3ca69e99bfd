//! 95 % intervals: by slopes where these tell, by the objective itself elsewhere, and none where neither is true.

use crate::common::known::Known;
use crate::common::measured::equal_weights;
use crate::common::tolerances::{END_OF_INTERVAL, MATRIX_ROUND_OFF};
use corfem::method::error::Error;
use corfem::method::modes::Modes;
use corfem::method::step::Bounds;
use corfem::weighted::comparison::Comparison;
use corfem::weighted::gauss_newton::{WeightedCorrelation, WeightedSettings, gauss_newton};
use corfem::weighted::identifiability::NORMAL_95;
use corfem::weighted::intervals::intervals;
use corfem::weighted::noise::{Noise, with_noise};

type Ranges = [Option<Bounds>; 15];

/// A noisy test of Case 3, whose covers begin unlike and are alike in truth.
struct Noisy {
    known: Known,
    test: Modes,
}

impl Noisy {
    fn new(seed: u64) -> Self {
        let known = Known::of_case(3).unwrap();
        let test = with_noise(&known.test, Noise::USUAL, seed).unwrap();
        Self { known, test }
    }

    fn analyze(&self, factors: &[f64]) -> Result<Comparison, Error> {
        let model = self.known.model.analyze(factors, &self.test, None)?;
        Ok(Comparison::from(&model))
    }

    fn optimum(&self, first: &[f64], ranges: &Ranges) -> WeightedCorrelation {
        let (weights, settings) = (equal_weights(Noise::USUAL, 9), WeightedSettings::default());
        let analyze = |factors: &[f64]| self.analyze(factors);
        gauss_newton(analyze, first, ranges, &weights, &settings).unwrap()
    }

    fn intervals(&self, best: &[f64], ranges: &Ranges, widening: f64) -> Vec<Option<Bounds>> {
        let (weights, settings) = (equal_weights(Noise::USUAL, 9), WeightedSettings::default());
        let analyze = |factors: &[f64]| self.analyze(factors);
        intervals(&analyze, best, ranges, &weights, &settings, widening).unwrap()
    }
}

/// By the lowest objective of all other factors with a factor held there, an interval that is not symmetric, and so not by slopes.
#[test]
fn at_the_ends_of_an_interval_the_objective_is_as_much_higher() {
    let (noisy, free) = (Noisy::new(3), [None; 15]);
    let best = noisy.optimum(&[1.0; 15], &free);
    let all = noisy.intervals(&best.factors, &free, 1.0);
    let [mut by_slope, mut by_objective] = [0; 2];
    for (e, interval) in all.iter().enumerate() {
        let Some(Bounds { lower, upper }) = *interval else {
            continue;
        };
        let middle = (lower * upper / best.factors[e].powi(2)).ln();
        if middle.abs() < MATRIX_ROUND_OFF {
            by_slope += 1;
            continue;
        }
        by_objective += 1;
        for end in [lower, upper] {
            let mut ranges = free;
            ranges[e] = Some(Bounds {
                lower: end,
                upper: end * (1.0 + 1e-12),
            });
            let held = noisy.optimum(&best.factors, &ranges);
            let root = (2.0 * (held.objective - best.objective)).sqrt();
            assert!(
                (root / NORMAL_95 - 1.0).abs() < END_OF_INTERVAL,
                "{e}: {root}"
            );
        }
    }
    assert!(
        by_slope >= 5 && by_objective >= 1,
        "{by_slope} {by_objective}"
    );
}

/// Panel 1 is seen well: its interval is by slopes, and as many times as wide as it is widened. A factor at a bound has none, nor one that
/// only the prior knows.
#[test]
fn intervals_widen_with_the_noise_and_are_withheld_where_none_is_true() {
    let (noisy, free) = (Noisy::new(3), [None; 15]);
    let best = noisy.optimum(&[1.0; 15], &free);
    let width = |widening| {
        let interval = noisy.intervals(&best.factors, &free, widening)[0].unwrap();
        (interval.upper / interval.lower).ln()
    };
    assert!((width(1.5) / width(1.0) - 1.5).abs() < MATRIX_ROUND_OFF);
    let deviation = best.identifiability.deviations[0];
    assert!((width(1.0) / (2.0 * NORMAL_95 * deviation) - 1.0).abs() < MATRIX_ROUND_OFF);
    let mut ranges = free;
    ranges[0] = Some(Bounds {
        lower: 0.5 * best.factors[0],
        upper: 0.9 * best.factors[0],
    });
    let held = noisy.optimum(&[1.0; 15], &ranges);
    assert_eq!(noisy.intervals(&held.factors, &ranges, 1.0)[0], None);
    // Case 2 leaves the ratio of both covers of a bay to the prior.
    let known = Known::of_case(2).unwrap();
    let noisy = Noisy {
        test: known.test.clone(),
        known,
    };
    let best = noisy.optimum(&[1.0; 15], &free);
    let all = noisy.intervals(&best.factors, &free, 1.0);
    assert_eq!(all.len(), 15);
    for (e, interval) in all.iter().enumerate() {
        assert_eq!(
            interval.is_none(),
            best.identifiability.is_mostly_prior(e),
            "{e}"
        );
    }
}
