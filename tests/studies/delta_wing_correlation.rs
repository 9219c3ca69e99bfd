//! Wrong gages of the delta wing recovered from ten modes at 19 points.

use crate::common::tolerances::{HIDDEN_GAGE, MATRIX_ROUND_OFF, RECOVERED_GAGE, ROUND_OFF, SAME_HISTORY, SEEN_SHARE};
use approx::assert_relative_eq;
use corfem::method::error::Error;
use corfem::method::inner_loop::Stop;
use corfem::method::outer_loop::correlate;
use corfem::method::state::UpdateRule;
use corfem::studies::delta_wing::DeltaWing;
use corfem::studies::delta_wing::correlation::{
    GROUPS, Recovered, TEST_MODES, WingCorrelation, correlate_wing, first_model, settings,
};
use std::sync::LazyLock;

/// The whole scenario, run once for all tests.
static RUN: LazyLock<WingCorrelation> = LazyLock::new(|| correlate_wing(&wing(), |_, _| {}).expect("it runs"));

fn wing() -> DeltaWing {
    DeltaWing::embedded().expect("the wing")
}

#[test]
fn wrong_gages_are_recovered_where_test_modes_see_them() {
    let run = &*RUN;
    assert!(run.correlation.converged);
    assert_eq!(run.groups.len(), 21);
    let hidden: Vec<&str> = run
        .groups
        .iter()
        .filter(|recovered| recovered.share < SEEN_SHARE)
        .map(|recovered| recovered.group.name)
        .collect();
    assert_eq!(hidden, ["webs x 30", "web x 90"]);
    for recovered in &run.groups {
        let allowed = if hidden.contains(&recovered.group.name) { HIDDEN_GAGE } else { RECOVERED_GAGE };
        let (name, error) = (recovered.group.name, recovered.error());
        assert!(error.abs() < allowed, "{name}: {error:.4}");
    }
    // What was right stays right, what was wrong by up to 40 % comes right.
    let of = |value: fn(&Recovered) -> f64| {
        let errors = run.groups.iter().filter(|r| r.share > SEEN_SHARE).map(value);
        errors.fold(0.0_f64, |worst, error| worst.max(error.abs()))
    };
    assert_relative_eq!(of(Recovered::first_error), 0.4, max_relative = ROUND_OFF);
    assert!(of(Recovered::error) > 0.01, "it is no exact answer");
}

#[test]
fn errors_of_a_group_follow_from_its_factors() {
    let group = GROUPS[9];
    assert_eq!((group.name, group.first_over_true), ("webs y 20 outboard", 0.7));
    let recovered = Recovered { group, factor: 1.2, share: 0.1 };
    assert_relative_eq!(recovered.true_factor(), 10.0 / 7.0, max_relative = ROUND_OFF);
    assert_relative_eq!(recovered.error(), -0.16, max_relative = ROUND_OFF);
    assert_relative_eq!(recovered.first_error(), -0.3, max_relative = ROUND_OFF);
}

#[test]
fn history_is_three_passes_to_the_tolerances() {
    let mut told = Vec::new();
    let run = correlate_wing(&wing(), |pass, _| told.push(pass)).expect("it runs");
    assert_eq!(told, [1, 2, 3]);
    let passes = &run.correlation.passes;
    let counts: Vec<(usize, Stop)> = passes.iter().map(|pass| (pass.inner.iterations.len(), pass.inner.stop)).collect();
    assert_eq!(counts, [(68, Stop::Tolerance), (20, Stop::Tolerance), (1, Stop::Tolerance)]);
    assert!(passes[0].inner.last.errors.sum() < 0.01);
    assert!(passes[1].inner.last.errors.sum() < settings().later_inner_tolerance);
    let last = &passes[2].check;
    assert!(last.errors.sum() < 0.005);
    assert_eq!(last.pairing.analysis_mode, TEST_MODES.map(|mode| mode - 1));
    let best: Vec<f64> = run.groups.iter().map(|r| r.factor).collect();
    assert_eq!(best, passes[2].factors);
    let initial = &run.correlation.initial.errors;
    assert_eq!(format!("{:.4} {:.4}", initial.frequency_rms(), initial.shape_rms()), "0.0169 0.0649");
}

#[test]
fn largest_share_is_that_of_the_stiffness_of_a_test_mode() {
    let model = first_model(&wing()).expect("a model");
    let dynamic = model.matrices(&[1.0; 21]).expect("an analysis");
    let run = &*RUN;
    let test = run.test.scaled_with(&dynamic.mass).expect("they fit");
    let mut all = vec![0.0; 10];
    for (share, recovered) in dynamic.shares.iter().zip(&run.groups) {
        let of_mode = |mode: usize| {
            let shape = test.shapes.column(mode);
            shape.dot(&(share.matrix() * shape)) / test.omega_squared[mode]
        };
        let largest = (0..10).map(of_mode).fold(0.0, f64::max);
        assert_relative_eq!(recovered.share, largest, max_relative = MATRIX_ROUND_OFF);
        for (mode, sum) in all.iter_mut().enumerate() {
            *sum += of_mode(mode);
        }
    }
    // Caps and posts have the rest, but for what the wrong gages have too much.
    assert!(all.iter().all(|sum| (0.5..1.2).contains(sum)), "{all:?}");
}

#[test]
fn history_does_not_hang_on_round_off() {
    // A modulus off by 1e-12 changes nothing that can be seen.
    let run = &*RUN;
    let other = DeltaWing { youngs_modulus: wing().youngs_modulus * (1.0 + 1e-12), ..wing() };
    let other = correlate_wing(&other, |_, _| {}).expect("it runs");
    for (a, b) in run.groups.iter().zip(&other.groups) {
        assert_relative_eq!(a.factor, b.factor, max_relative = SAME_HISTORY);
    }
}

/// A pass ends where the plain recursion no longer settles, and the next begins at exact modes: more passes, to another
/// place within the same tolerances of the errors.
#[test]
fn plain_recursion_takes_more_passes_to_gages_nearly_as_good() {
    let (wing, solved) = (wing(), &*RUN);
    let model = first_model(&wing).expect("the model");
    let mut settings = settings();
    settings.inner.update = UpdateRule::default();
    let ranges = model.factor_ranges().expect("ranges");
    let plain = correlate(|factors| model.analyze(factors, &solved.test, None), &ranges, &settings, |_, _| {})
        .expect("it runs");
    assert!(plain.converged);
    assert!(plain.passes.len() > solved.correlation.passes.len());
    assert_eq!(plain.passes[0].inner.stop, Stop::LocalMinimum);
    for (recovered, factor) in solved.groups.iter().zip(plain.best_factors) {
        if recovered.share > SEEN_SHARE {
            let error = factor / recovered.true_factor() - 1.0;
            assert!(error.abs() < 2.0 * RECOVERED_GAGE, "{error:.4}");
        }
    }
}

#[test]
fn a_wing_without_webs_has_no_modes_to_test() {
    let error = correlate_wing(&DeltaWing { web_gage: 0.0, ..wing() }, |_, _| {});
    assert!(matches!(
        error,
        Err(Error::NotPositive { what: "gage", owner, value: 0.0 }) if owner == "element 18"
    ));
}
