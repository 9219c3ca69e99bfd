//! Wrong gages of the delta wing recovered from ten modes at 19 points.

use crate::prelude::*;

/// The whole scenario, run once for all tests.
static RUN: LazyLock<WingCorrelation> =
    LazyLock::new(|| correlate_wing(&wing(), |_, _| {}).unwrap());

fn wing() -> DeltaWing {
    DeltaWing::embedded()
}

/// Groups, each with its largest share of a test mode and the relative error of its gage.
type Groups = Vec<(&'static Group, f64, f64)>;

/// All of them.
fn recovered() -> Groups {
    let factors = &RUN.correlation.best_factors;
    let error = |(group, factor): (&Group, &f64)| factor / group.true_factor() - 1.0;
    let errors = GROUPS.iter().zip(factors).map(error);
    GROUPS
        .iter()
        .zip(&RUN.shares)
        .zip(errors)
        .map(|((group, share), error)| (group, *share, error))
        .collect()
}

#[test]
fn wrong_gages_are_recovered_where_test_modes_see_them() {
    assert!(RUN.correlation.converged);
    let (hidden, seen): (Groups, Groups) = recovered()
        .into_iter()
        .partition(|(_, share, _)| *share < SEEN_SHARE);
    assert_eq!(hidden.len() + seen.len(), 21);
    assert_eq!(
        hidden.iter().map(|(group, ..)| group.name).collect_vec(),
        ["webs x 30", "web x 90"]
    );
    for (groups, allowed) in [(&hidden, HIDDEN_GAGE), (&seen, RECOVERED_GAGE)] {
        for (group, _, error) in groups {
            assert!(error.abs() < allowed, "{}: {error:.4}", group.name);
        }
    }
    // What was right stays right, what was wrong by up to 40 % comes right.
    let largest = |errors: Vec<f64>| {
        errors
            .into_iter()
            .fold(0.0_f64, |worst, error| worst.max(error.abs()))
    };
    let first = seen.iter().map(|(group, ..)| group.first_over_true - 1.0);
    assert_relative_eq!(largest(first.collect()), 0.4, max_relative = ROUND_OFF);
    assert!(
        largest(seen.iter().map(|(.., error)| *error).collect()) > 0.01,
        "it is no exact answer"
    );
}

#[test]
fn history_is_three_passes_to_the_tolerances() {
    let mut told = Vec::new();
    let run = correlate_wing(&wing(), |pass, _| told.push(pass)).unwrap();
    assert_eq!(told, [1, 2, 3]);
    let passes = &run.correlation.passes;
    let counts = passes
        .iter()
        .map(|pass| (pass.inner.iterations.len(), pass.inner.stop))
        .collect_vec();
    assert_eq!(
        counts,
        [
            (68, Stop::Tolerance),
            (20, Stop::Tolerance),
            (1, Stop::Tolerance)
        ]
    );
    assert!(passes[0].inner.last.errors.sum() < 0.01);
    assert!(passes[1].inner.last.errors.sum() < settings().later_inner_tolerance);
    let last = &passes[2].check;
    assert!(last.errors.sum() < 0.005);
    assert_eq!(last.pairing.analysis_mode, TEST_MODES.map(|mode| mode - 1));
    assert_eq!(run.correlation.best_factors, passes[2].factors);
    let initial = &run.correlation.initial.errors;
    assert_eq!(
        format!("{:.4} {:.4}", initial.frequency_rms(), initial.shape_rms()),
        "0.0169 0.0649"
    );
}
