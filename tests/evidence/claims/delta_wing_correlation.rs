//! Wrong gages of the delta wing recovered from ten modes at 19 points by the paper's own loops.

use crate::common::delta_wing::{RUN, settings};
use crate::prelude::*;

/// Groups of which some test mode has so much of its stiffness, and the others: relative errors of their gages.
fn errors(is_seen: bool) -> Vec<(&'static str, f64)> {
    let (run, shares) = &*RUN;
    let groups = GROUPS.iter().zip(&run.best_factors).zip(shares);
    let groups = groups.filter(|(_, share)| (**share >= SEEN_SHARE) == is_seen);
    groups
        .map(|((group, factor), _)| (&group.name[..], factor / group.true_factor() - 1.0))
        .collect()
}

#[test]
fn wrong_gages_are_recovered_where_test_modes_see_them() {
    assert!(RUN.0.converged);
    let [hidden, seen] = [false, true].map(errors);
    let names = hidden.iter().map(|(name, _)| *name).collect_vec();
    assert_eq!(names, ["webs x 30", "web x 90"]);
    assert_eq!(hidden.len() + seen.len(), 21);
    for (groups, allowed) in [(&hidden, HIDDEN_GAGE), (&seen, RECOVERED_GAGE)] {
        for (name, error) in groups {
            assert!(error.abs() < allowed, "{name}: {error:.4}");
        }
    }
    // What was right stays right, what was wrong by up to 40 % comes right, and it is no exact answer.
    let wrong = GROUPS
        .iter()
        .map(|group| (group.first_over_true - 1.0).abs());
    assert_relative_eq!(wrong.largest(), 0.4, max_relative = ROUND_OFF);
    assert!(seen.iter().map(|(_, error)| error.abs()).largest() > 0.01);
}

/// Everything but the tolerances and the reading is the paper's: Recursive 1, changes that add, at most thirty iterations.
#[test]
fn the_papers_own_loops_take_six_passes() {
    let expected = Settings {
        error_sum_tolerance: 0.005,
        later_inner_tolerance: 0.005,
        ..Settings::default()
    };
    let inner = InnerSettings {
        tolerance: 0.01,
        step: StepRule::Own,
        ..expected.inner.clone()
    };
    assert_eq!(settings(), Settings { inner, ..expected });
    let passes = &RUN.0.passes;
    let ended = |pass: &Pass| (pass.inner.iterations.len(), pass.inner.stop);
    assert_eq!(
        passes.iter().map(ended).collect_vec(),
        [
            (3, Stop::LocalMinimum),
            (6, Stop::LocalMinimum),
            (12, Stop::LocalMinimum),
            (21, Stop::LocalMinimum),
            (30, Stop::Iterations),
            (29, Stop::Tolerance),
        ]
    );
    let last = &passes[5].check;
    assert!(last.errors.sum() < 0.005);
    assert_eq!(last.pairing.analysis_mode, TEST_MODES.map(|mode| mode - 1));
    assert_eq!(RUN.0.best_factors, passes[5].factors);
    let initial = &RUN.0.initial.errors;
    let [frequency, shape] = [initial.frequency_rms(), initial.shape_rms()];
    assert_eq!(format!("{frequency:.4} {shape:.4}"), "0.0169 0.0649");
}
