//! 95 % intervals: by slopes where these tell, by the objective itself elsewhere, and none where neither is true.

use crate::prelude::*;
use corfem::weighted::identifiability::PRIOR_DEVIATION;

type Ranges = [Option<Bounds>; 15];

/// A noisy test of Case 3, whose covers begin unlike and are alike in truth.
struct Noisy {
    known: Known,
    test: Modes,
}

impl Noisy {
    fn new(seed: u64) -> Self {
        let known = Known::of_case(3);
        let test = with_noise(&known.test, Noise::USUAL, seed).unwrap();
        Self { known, test }
    }

    fn analyze(&self, factors: &[f64]) -> Result<Comparison, Error> {
        let model = self.known.model.analyze(factors, &self.test)?;
        Ok(Comparison::from(&model))
    }

    fn optimum(&self, first: &[f64], ranges: &Ranges) -> WeightedCorrelation {
        let (weights, settings) = (equal_weights(Noise::USUAL, 9), WeightedSettings::default());
        let analyze = |factors: &[f64]| self.analyze(factors);
        gauss_newton(analyze, first, ranges, &weights, &settings).unwrap()
    }

    fn intervals(
        &self,
        best: &[f64],
        ranges: &Ranges,
        widening: f64,
    ) -> Vec<Result<Bounds, Withheld>> {
        let (weights, settings) = (equal_weights(Noise::USUAL, 9), WeightedSettings::default());
        let analyze = |factors: &[f64]| self.analyze(factors);
        intervals(&analyze, best, ranges, &weights, &settings, widening).unwrap()
    }
}

/// By the lowest objective of all other factors with a factor held there.
#[test]
fn at_the_ends_of_an_interval_the_objective_is_as_much_higher() {
    let (noisy, free) = (Noisy::new(3), [None; 15]);
    let best = noisy.optimum(&[1.0; 15], &free);
    let all = noisy.intervals(&best.factors, &free, 1.0);
    let mut given = 0;
    for (e, interval) in all.iter().enumerate() {
        let Ok(Bounds { lower, upper }) = *interval else {
            continue;
        };
        given += 1;
        for end in [lower, upper] {
            let mut ranges = free;
            ranges[e] = Some(Bounds {
                lower: end,
                upper: end * (1.0 + 1e-12),
            });
            let held = noisy.optimum(&best.factors, &ranges);
            let root = (2.0 * (held.objective - best.objective)).sqrt();
            assert!(
                relative_error(root, NORMAL_95) < END_OF_INTERVAL,
                "{e}: {root}"
            );
        }
    }
    assert!(given >= 10, "{given}");
}

/// No interval is wider than the prior's, however large the deviations, and those of parameters that are mostly the prior's are withheld.
#[test]
fn widening_never_scales_the_prior() {
    let (noisy, free) = (Noisy::new(3), [None; 15]);
    let best = noisy.optimum(&[1.0; 15], &free);
    let slopes = jacobian(
        &noisy.analyze(&best.factors).unwrap(),
        &equal_weights(Noise::USUAL, 9),
    )
    .unwrap();
    let prior = 2.0 * NORMAL_95 * PRIOR_DEVIATION;
    for widening in [1.0, 1.5, 4.0, 30.0] {
        let all = noisy.intervals(&best.factors, &free, widening);
        let seen = identifiability(&(&slopes / widening), &[PRIOR_DEVIATION; 15]).unwrap();
        let width = |interval: &Bounds| (interval.upper / interval.lower).ln();
        for (e, interval) in all.iter().enumerate() {
            match interval {
                Ok(interval) => assert!(width(interval) <= prior, "{widening}, {e}"),
                Err(withheld) => assert_eq!(
                    *withheld == Withheld::MostlyPrior,
                    seen.is_mostly_prior(e),
                    "{widening}, {e}: {withheld:?}"
                ),
            }
        }
    }
}

/// Where the factors are not the optimum, an end that is sought finds lower places instead.
#[test]
fn no_interval_stands_where_the_objective_falls_below_that_at_the_factors() {
    let (noisy, free) = (Noisy::new(3), [None; 15]);
    let best = noisy.optimum(&[1.0; 15], &free).factors;
    let beside = (0..15).map(|e| best[e] * [0.93, 1.08][e % 2]).collect_vec();
    let withheld = |factors: &[f64]| {
        let all = noisy.intervals(factors, &free, 1.0).into_iter();
        all.filter(|interval| *interval == Err(Withheld::Lower))
            .count()
    };
    assert_eq!(withheld(&best), 0);
    assert!(withheld(&beside) > 0);
}

/// A factor at a bound has none, nor one that only the prior knows.
#[test]
fn intervals_are_withheld_where_none_is_true() {
    let (noisy, free) = (Noisy::new(3), [None; 15]);
    let best = noisy.optimum(&[1.0; 15], &free);
    let mut ranges = free;
    ranges[0] = Some(Bounds {
        lower: 0.5 * best.factors[0],
        upper: 0.9 * best.factors[0],
    });
    let held = noisy.optimum(&[1.0; 15], &ranges);
    let at_bound = noisy.intervals(&held.factors, &ranges, 1.0)[0];
    assert_eq!(at_bound, Err(Withheld::AtBound));
    // Case 2 leaves the ratio of both covers of a bay to the prior.
    let known = Known::of_case(2);
    let noisy = Noisy {
        test: known.test.clone(),
        known,
    };
    let best = noisy.optimum(&[1.0; 15], &free);
    let all = noisy.intervals(&best.factors, &free, 1.0);
    assert_eq!(all.len(), 15);
    for (e, interval) in all.iter().enumerate() {
        assert_eq!(
            *interval == Err(Withheld::MostlyPrior),
            best.identifiability.is_mostly_prior(e),
            "{e}"
        );
    }
}
