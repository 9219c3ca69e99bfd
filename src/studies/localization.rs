//! Which parameter is wrong: by the paper's unlimited factor, a slope that says little of gross errors, and by single fits.

use crate::cases::Case;
use crate::cases::error::CaseError;
use crate::cases::torque_box::{PANEL_COUNT, TEST_GAGE};
use crate::method::derivatives::error_changes;
use crate::method::error::Error;
use crate::method::error_sum::ModeWeight;
use crate::method::inner_loop::InnerSettings;
use crate::method::model::ModalModel;
use crate::method::modes::ModeSet;
use crate::method::state::{ModalState, UpdateRule};
use crate::method::step::{stiffness_changes, unlimited_factors};
use crate::studies::noisy_modes::{Noise, with_noise};
use crate::studies::weighted::residuals::{equal_weights, residuals, residuals_of};
use serde::Serialize;
use std::ops::RangeInclusive;

/// Noise of the study: 1 % of shapes, 0.5 % of frequencies.
pub const NOISE: Noise = Noise { shape: 0.01, frequency: 0.005 };
/// Seeds of the noise, one test each.
pub const SEEDS: RangeInclusive<u64> = 1..=100;
/// Gages of the culprit over the true one: Case 4's error, and one that is not gross.
pub const RATIOS: [f64; 2] = [0.01, 0.5];
/// Decades on either side of the best factor so far that are searched, at first about one: 25 factors each, to 1 %.
const DECADES: [f64; 3] = [3.0, 0.375, 0.047];

/// A parameter under suspicion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Suspect {
    /// The parameter, from zero.
    pub parameter: usize,
    /// The factor that it asks for.
    pub factor: f64,
    /// What speaks against it, by the measure of the ranking: the larger, the more.
    pub evidence: f64,
}

/// By the change $|c - 1|$ that the unlimited factors (13) of the first iteration ask for, the largest first.
///
/// # Errors
/// Those of [`error_changes`].
pub fn by_factor(model: &ModalModel, settings: &InnerSettings) -> Result<Vec<Suspect>, Error> {
    let state = ModalState::start(model);
    let changes = error_changes(model, &state, settings.derivatives)?;
    let stiffnesses = stiffness_changes(model, &state.factors, &state.factors, &changes, settings.step)?;
    let error_sum = settings.measure.scale(model.test.len()) * state.errors.sum();
    let factors = unlimited_factors(&changes, &stiffnesses, error_sum, settings.first_relaxation);
    let suspect = |(parameter, factor): (usize, f64)| Suspect { parameter, factor, evidence: (factor - 1.0).abs() };
    Ok(ranked(factors.into_iter().enumerate().map(suspect)))
}

/// By how far each parameter alone can lower $\frac{1}{2} \sum r^2$ of the weighted residuals, the farthest first.
///
/// The modes at a factor are an eigensolution in the modal coordinates of the one exact analysis there is. Factors are tried from
/// $10^{-3}$ to $10^3$, then near the best. A fall is the logarithm of a likelihood ratio: of this one error against none.
///
/// # Errors
/// Those of [`residuals`].
pub fn by_single_fit(model: &ModalModel, weights: &[ModeWeight]) -> Result<Vec<Suspect>, Error> {
    let start = 0.5 * residuals(model, weights)?.norm_squared();
    let objective = |parameter: usize, log: f64| {
        let mut factors = vec![1.0; model.shares.len()];
        factors[parameter] = 10.0_f64.powf(log);
        // Where there are no modes of vibration there is no fit.
        ModalState::at(model, factors, UpdateRule::Eigensolution).map_or(f64::INFINITY, |state| {
            0.5 * residuals_of(&state.modes, &state.pairing, &model.test, weights).norm_squared()
        })
    };
    let best = |parameter: usize| {
        let (mut lowest, mut log) = (f64::INFINITY, 0.0);
        for decades in DECADES {
            let tried = (-12..=12).map(|place| log + decades * f64::from(place) / 12.0);
            let tried = tried.map(|log| (objective(parameter, log), log));
            (lowest, log) = tried.fold((lowest, log), |best, tried| if tried.0 < best.0 { tried } else { best });
        }
        Suspect { parameter, factor: 10.0_f64.powf(log), evidence: start - lowest }
    };
    Ok(ranked((0..model.shares.len()).map(best)))
}

fn ranked(suspects: impl Iterator<Item = Suspect>) -> Vec<Suspect> {
    let mut suspects: Vec<Suspect> = suspects.collect();
    suspects.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
    suspects
}

/// One culprit by both rankings.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Located {
    /// Number of the panel.
    pub panel: usize,
    /// Its gage over the true one.
    pub ratio: f64,
    /// Whether the tests have noise.
    pub is_noisy: bool,
    /// Number of tests.
    pub tests: usize,
    /// Tests in which it stands first by [`by_factor`], with Case 4's settings, and in which among the first three.
    pub by_factor: [usize; 2],
    /// The same by [`by_single_fit`], with weights of [`NOISE`].
    pub by_single_fit: [usize; 2],
}

/// Each panel of Case 4's box in turn too thin, all others right: without noise, then with [`NOISE`] of every seed.
///
/// # Errors
/// Those of the model and of the rankings.
pub fn localization(seeds: RangeInclusive<u64>) -> Result<Vec<Located>, CaseError> {
    let case = Case::new(4)?;
    let exact = ModeSet::from(case.test_modes()?);
    let weights = equal_weights(NOISE, exact.len())?;
    let noisy = seeds.map(|seed| with_noise(&exact, NOISE, seed)).collect::<Result<Vec<_>, Error>>()?;
    let mut located = Vec::new();
    for (ratio, culprit) in RATIOS.into_iter().flat_map(|ratio| (0..PANEL_COUNT).map(move |panel| (ratio, panel))) {
        let mut gages = [TEST_GAGE; PANEL_COUNT];
        gages[culprit] *= ratio;
        let model = case.model_with(&gages)?;
        for (is_noisy, tests) in [(false, std::slice::from_ref(&exact)), (true, &noisy)] {
            let mut found = [[0; 2]; 2];
            for test in tests {
                let modal = model.analyze(&[1.0; PANEL_COUNT], test, None)?;
                let rankings = [by_factor(&modal, &case.settings.inner)?, by_single_fit(&modal, &weights)?];
                for (found, suspects) in found.iter_mut().zip(rankings) {
                    let place = suspects.iter().position(|suspect| suspect.parameter == culprit);
                    found[0] += usize::from(place == Some(0));
                    found[1] += usize::from(place.is_some_and(|place| place < 3));
                }
            }
            let (panel, tests, [by_factor, by_single_fit]) = (case.panels[culprit].label, tests.len(), found);
            located.push(Located { panel, ratio, is_noisy, tests, by_factor, by_single_fit });
        }
    }
    Ok(located)
}
