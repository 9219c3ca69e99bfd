//! Appendix B in use: the box's test modes with reproducible errors of measurement, correlated as they are and after Appendix B.
//! What is wrong with the gages each time says what its steps are worth.

use super::rows;
use crate::prelude::*;

/// The case whose test modes get noise.
pub const NOISY_CASE: usize = 2;
/// Seeds of the noise, one run each.
pub const SEEDS: RangeInclusive<u64> = 1..=20;
/// Limits that no mode exceeds, to orthogonalize without deleting.
const NO_LIMITS: MovementLimits = MovementLimits {
    balance: 0.999,
    frequency: f64::MAX,
    shape: f64::MAX,
};

/// What a correlation with some test modes leads to.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// Gages of the best pass, in, elements 1 to 15.
    pub gages_in: Vec<f64>,
    /// RMS gage errors of all panels, the shear panels and the membranes; the error sum at these gages beside the modes given; RMS errors
    /// of frequencies and shapes beside the modes without noise, all in percent; iterations of all passes.
    pub numbers: [f64; 7],
}

/// Names of the [`Found::numbers`].
const QUANTITIES: [&str; 7] = [
    "all",
    "shear",
    "membrane",
    "error sum",
    "frequency",
    "shape",
    "iterations",
];

/// Raw test modes of a seed, orthogonal ones, and those that the usual limits of Appendix B keep. A seed of zero makes no noise.
///
/// The structure is held, so that there is nothing to balance: [`balance`] refuses it.
pub fn test_modes(seed: u64) -> [Modes; 3] {
    let case = case_of(NOISY_CASE);
    let (exact, mass) = (case.test_modes().unwrap(), case.reconstruction.mass());
    let raw = if seed == 0 {
        exact
    } else {
        with_noise(&exact, Noise::USUAL, seed).unwrap()
    };
    let [orthogonal, screened] = [NO_LIMITS, MovementLimits::default()]
        .map(|limits| examine(&raw, &mass, Supports::Held, &limits).unwrap().modes);
    [raw, orthogonal, screened]
}

/// A correlation of the case with some test modes by the library's own rule of the step, which finds the gages where the reading of the
/// case leaves some behind.
pub fn correlated(test: &Modes) -> Found {
    let case = case_of(NOISY_CASE);
    let (model, settings) = (case.model().unwrap(), case.settings_by(StepRule::Matrix));
    let ranges = model.factor_ranges().unwrap();
    let analyze = |factors: &[f64]| model.analyze(factors, test, None);
    let run = correlate(analyze, &ranges, &settings, |_, _| true).unwrap();
    let gages_in = model.sizes(&run.best_factors).unwrap()[..PANEL_COUNT].to_vec();
    let errors = |test: &Modes| {
        let found = model.analyze(&run.best_factors, test, None).unwrap();
        found.exact().errors
    };
    let truth = errors(&case.test_modes().unwrap());
    let all = gages_in
        .iter()
        .map(|gage| gage / TEST_GAGE - 1.0)
        .collect_vec();
    let of = |kind| gage_rms(&case.panels, &gages_in, kind);
    let passes = run.passes.iter().map(|pass| pass.inner.iterations.len());
    let numbers = [
        100.0 * rms(&all),
        100.0 * of(ElementKind::ShearPanel),
        100.0 * of(ElementKind::Membrane),
        100.0 * errors(test).sum(),
        100.0 * truth.frequency_rms(),
        100.0 * truth.shape_rms(),
        passes.sum::<usize>() as f64,
    ];
    Found { gages_in, numbers }
}

/// The correlations with the [`test_modes`] of no noise and of every seed.
pub static RUNS: LazyLock<Vec<[Found; 3]>> = LazyLock::new(|| {
    let run = |seed| test_modes(seed).each_ref().map(correlated);
    (0..=*SEEDS.end()).map(run).collect()
});

/// Every number of the three correlations, without noise, and its median and its largest value over the seeds.
pub fn tables() -> Vec<Table> {
    let sides = ["Raw", "Orthogonal", "Screened"];
    let found = QUANTITIES
        .iter()
        .enumerate()
        .flat_map(|(number, quantity)| {
            let of = |side: usize| RUNS.iter().map(move |run| run[side].numbers[number]);
            let ends = [0, 1, 2].map(|side| {
                let mut seeds = of(side).skip(1).collect_vec();
                seeds.sort_by(f64::total_cmp);
                let last = seeds.len() - 1;
                let median = 0.5 * (seeds[last / 2] + seeds[last.div_ceil(2)]);
                [of(side).next().unwrap(), median, seeds[last]]
            });
            let row = |(name, end): (&str, usize)| {
                (
                    format!("{quantity}, {name}"),
                    ends.map(|of| of[end]).to_vec(),
                )
            };
            [("no noise", 0), ("median", 1), ("worst", 2)].map(row)
        });
    vec![rows("noisy_modes", &sides, found)]
}
