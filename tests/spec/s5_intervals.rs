//! 95 % intervals: by slopes where these tell, by the objective itself elsewhere, and none where neither is true.

use crate::common::known::Known;
use crate::common::measured::equal_weights;
use corfem::method::error::Error;
use corfem::method::model::{Bounds, ModalModel};
use corfem::weighted::gauss_newton::{WeightedCorrelation, WeightedSettings, gauss_newton};
use corfem::weighted::identifiability::NORMAL_95;
use corfem::weighted::intervals::intervals;
use corfem::weighted::noise::{Noise, with_noise};

/// A noisy test of Case 3, whose covers begin unlike and are alike in truth: the optimum of its fifteen factors within `ranges`, from
/// `first`, and the model there.
fn optimum(
    seed: u64,
    first: &[f64],
    ranges: &[Option<Bounds>],
) -> (WeightedCorrelation, ModalModel) {
    let known = Known::of_case(3).unwrap();
    let test = with_noise(&known.test, Noise::USUAL, seed).unwrap();
    let analyze = |factors: &[f64]| -> Result<ModalModel, Error> {
        known.model.analyze(factors, &test, None)
    };
    let weights = equal_weights(Noise::USUAL, 9);
    let settings = WeightedSettings::default();
    let found = gauss_newton(analyze, first, ranges, &weights, &settings).unwrap();
    let model = analyze(&found.factors).unwrap();
    (found, model)
}

fn intervals_at(
    (found, model): &(WeightedCorrelation, ModalModel),
    ranges: &[Option<Bounds>],
    widening: f64,
) -> Vec<Option<Bounds>> {
    let (weights, settings) = (equal_weights(Noise::USUAL, 9), WeightedSettings::default());
    intervals(model, &found.factors, ranges, &weights, &settings, widening).unwrap()
}

/// By exact analyses, the factor of a cover held there: the objective is higher by half the square of 1.96, to what the slopes (a tenth of
/// the root) and the basis of one model leave.
#[test]
fn at_the_ends_of_an_interval_the_objective_is_as_much_higher() {
    let free = [None; 15];
    let best = optimum(3, &[1.0; 15], &free);
    let all = intervals_at(&best, &free, 1.0);
    let mut by_slope = 0;
    for e in [1, 3, 7, 8, 10, 14, 0] {
        let Some(interval) = all[e] else { continue };
        for end in [interval.lower, interval.upper] {
            let mut ranges = free;
            ranges[e] = Some(Bounds {
                lower: end,
                upper: end * (1.0 + 1e-12),
            });
            let held = optimum(3, &best.0.factors, &ranges).0;
            let root = (2.0 * (held.objective - best.0.objective)).sqrt();
            assert!((root / NORMAL_95 - 1.0).abs() < 0.15, "{e}: {root}");
        }
        let ratio =
            (interval.upper / best.0.factors[e]).ln() / (best.0.factors[e] / interval.lower).ln();
        by_slope += usize::from((ratio - 1.0).abs() < 1e-9);
    }
    assert!((1..7).contains(&by_slope), "{by_slope}");
}

/// Panel 1 is seen well: its interval is by slopes, and as many times as wide as it is widened. A factor at a bound has none.
#[test]
fn intervals_widen_with_the_noise_and_stop_at_bounds() {
    let free = [None; 15];
    let best = optimum(3, &[1.0; 15], &free);
    let width = |widening| {
        let interval = intervals_at(&best, &free, widening)[0].unwrap();
        (interval.upper / interval.lower).ln()
    };
    assert!((width(2.0) / width(1.0) - 2.0).abs() < 1e-9);
    let deviation = best.0.identifiability.deviations[0];
    assert!((width(1.0) / (2.0 * NORMAL_95 * deviation) - 1.0).abs() < 1e-9);
    let mut ranges = free;
    ranges[0] = Some(Bounds {
        lower: 0.5 * best.0.factors[0],
        upper: 0.9 * best.0.factors[0],
    });
    let held = optimum(3, &[1.0; 15], &ranges);
    assert_eq!(intervals_at(&held, &ranges, 1.0)[0], None);
}
