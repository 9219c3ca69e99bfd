//! The inner loop: steps by perturbation that only ever lower the error sum, within their limits, until one of
//! three reasons to stop.

use crate::common::loops::Given;
use crate::prelude::*;
use corfem::torque_box::wing_box::Panel;

/// A run as given; where roots are so close that no first step settles there is nothing to look at.
fn run_given(given: &Given) -> Result<(ModalModel, InnerRun), TestCaseError> {
    let problem = chain_problem(&given.chain, &given.truth);
    match run(&problem, &given.base, &given.total_ranges, &given.settings) {
        Ok(run) => Ok((problem, run)),
        Err(Error::UnsettledRoots { .. } | Error::CoalescingModes { .. }) => {
            Err(TestCaseError::reject("close roots"))
        }
        Err(error) => Err(TestCaseError::fail(error.to_string())),
    }
}

/// A box corrected between 0.007 and 0.013 in of every panel.
fn limited_run(case: &Case) -> (InnerRun, Vec<Option<Bounds>>) {
    let of_panel = |panel: &Panel| {
        Some(Bounds {
            lower: 0.007 / panel.gage,
            upper: 0.013 / panel.gage,
        })
    };
    let ranges = case.panels.iter().map(of_panel).collect_vec();
    let run = run(
        &problem_of(case),
        &[1.0; 15],
        &ranges,
        &InnerSettings::default(),
    )
    .unwrap();
    (run, ranges)
}

/// A single step without halvings, its relaxation about a thousandth of the usual for so many test modes.
fn small_step(modes: usize) -> InnerSettings {
    let inner = InnerSettings {
        first_relaxation: 1e-3,
        halvings: 0,
        iterations: 1,
        ..InnerSettings::default()
    };
    inner_for_modes(inner, modes)
}

properties! {
    #[test]
    fn a_small_step_lowers_the_error_sum((chain, truth) in chain_and_truth()) {
        let problem = chain_problem(&chain, &truth);
        let count = truth.len();
        let start = problem.exact().errors;
        // Near zero either error has a kink, and no slope to go down.
        prop_assume!(start.frequency > 0.02 && start.shape > 0.02);
        let run = run(&problem, &vec![1.0; count], &vec![None; count], &small_step(count))?;
        prop_assert_eq!(run.iterations.len(), 1);
        prop_assert!(run.last.errors.sum() < start.sum());
    }

    #[test]
    fn the_error_sum_only_falls(given in given()) {
        let (problem, run) = run_given(&given)?;
        assert_error_sum_only_falls(&problem, &run);
    }

    #[test]
    fn limits_hold_in_every_iteration(given in given()) {
        let (_, run) = run_given(&given)?;
        assert_limits_hold(&run, &given.base, &given.total_ranges, given.settings.factor_range);
    }

    #[test]
    fn earlier_passes_matter_only_through_the_limits(given in given()) {
        let count = given.truth.len();
        let free = Given { total_ranges: vec![None; count], ..given.clone() };
        let first = Given { base: vec![1.0; count], ..free.clone() };
        let (free, first) = (run_given(&free)?, run_given(&first)?);
        prop_assert_eq!(free.1.last.share_factors, first.1.last.share_factors);
    }
}

properties! {
    #![proptest_config(costly_config())]

    #[test]
    fn a_small_step_lowers_the_error_sum_of_a_box(case in uneven_box()) {
        let problem = problem_of(&case);
        let run = run(&problem, &[1.0; 15], &[None; 15], &small_step(9))?;
        prop_assert_eq!(run.iterations.len(), 1);
        prop_assert!(run.last.errors.sum() < problem.exact().errors.sum());
    }

    #[test]
    fn boxes_go_down_within_limits(case in uneven_box()) {
        let (run, ranges) = limited_run(&case);
        let settings = InnerSettings::default();
        assert_error_sum_only_falls(&problem_of(&case), &run);
        assert_limits_hold(&run, &[1.0; 15], &ranges, settings.factor_range);
        prop_assert_eq!(run.stop == Stop::Tolerance, run.last.errors.sum() < settings.tolerance);
        prop_assert!(run.stop != Stop::Iterations || run.iterations.len() == settings.iterations);
    }
}

#[test]
fn nearly_all_of_three_hundred_boxes_reach_the_tolerance_within_limits() {
    let mut runner = TestRunner::deterministic();
    let draw = |_| uneven_box().new_tree(&mut runner).unwrap().current();
    let stops = (0..300)
        .map(draw)
        .map(|case| limited_run(&case).0.stop)
        .collect_vec();
    let reached = stops
        .iter()
        .filter(|stop| **stop == Stop::Tolerance)
        .count();
    assert!(reached >= 297, "{reached} of 300");
}
