//! Upper and lower covers of a box that is symmetric about its mid-plane: no rule of the step tells them apart, while the print does.

use crate::common::boxes::other_box;
use crate::evidence::readings::{ByRule, COUNTED, correlation};
use crate::prelude::*;

/// The covers of the root, tip and middle bays, elements from zero.
const BAYS: [[usize; 2]; 3] = [[1, 14], [3, 7], [8, 10]];

properties! {
    #![proptest_config(costly_config())]

    /// Any rule that knows $\Delta e$, the element's generalized stiffness and its gage.
    #[test]
    fn covers_of_a_bay_that_begin_alike_stay_alike_under_any_rule(
        reconstruction in other_box(0.12, 0.30),
        kind in 1..=2_usize,
        gages in prop::collection::vec(0.008..0.015_f64, PANEL_COUNT),
        (of_stiffness, of_gage, step) in (0.0..1.5_f64, 0.0..1.5_f64, 0.2..2.0_f64),
    ) {
        let mut case = Case::from_reconstruction(kind, reconstruction)?;
        for (panel, gage) in case.panels.iter_mut().zip(&gages) {
            panel.gage = *gage;
        }
        for [one, other] in BAYS {
            case.panels[other].gage = case.panels[one].gage;
        }
        let model = case.model();
        // Panels must be convex.
        prop_assume!(model.is_ok());
        let (model, test) = (model?, case.test_modes()?);
        let modal = model.analyze(&[1.0; PANEL_COUNT], &test, None)?;
        let shares = modal.shares();
        // Round-off of the condensation is that of the whole structure, however little of it a cover is.
        let largest = shares.iter().map(|share| share.norm()).largest();
        for [one, other] in BAYS {
            let apart = (&shares[one] - &shares[other]).norm();
            prop_assert!(apart < MIRRORED_COVERS * largest);
        }
        let settings = InnerSettings { iterations: 3, ..case.settings.inner.clone() };
        let changes = modal.error_changes(modal.exact());
        let largest = changes?.iter().fold(0.0_f64, |most, e| most.max(e.abs()));
        let rule = |_: &[f64], kappa: &[f64], factors: &[f64]| {
            let divisor = |e: usize| {
                let gage = case.panels[e].gage * factors[e] / TEST_GAGE;
                largest * kappa[e].powf(of_stiffness) * gage.powf(of_gage) / step
            };
            (0..PANEL_COUNT).map(divisor).collect()
        };
        let found = run(&ByRule(&modal, rule), &[1.0; PANEL_COUNT], &[None; PANEL_COUNT], &settings);
        let factors = found?.gage_factors;
        for [one, other] in BAYS {
            prop_assert!(relative_error(factors[one], factors[other]) < SAME_HISTORY);
        }
    }
}

/// Case 1 begins with equal covers, and prints unlike ones after its first pass. Equal covers can come no nearer than their means do.
#[test]
fn the_print_of_case_1_bounds_what_any_rule_can_reach_on_a_symmetric_box() {
    let table = PublishedTable::number(4).unwrap();
    let error =
        |panel: usize| table.required(&panel.to_string(), "pass_1_in").unwrap() / TEST_GAGE - 1.0;
    let printed = (1..=PANEL_COUNT).map(error).collect_vec();
    let mut nearest = printed.clone();
    for [one, other] in BAYS {
        let mean = 0.5 * (printed[one] + printed[other]);
        (nearest[one], nearest[other]) = (mean, mean);
    }
    let apart = nearest
        .iter()
        .zip(&printed)
        .map(|(a, b)| a - b)
        .collect_vec();
    let (most, least) = (correlation(&nearest, &printed), rms(&apart));
    assert_eq!(format!("{most:.2} {:.1}", 100.0 * least), "0.68 5.0");
    let of_column = COUNTED
        .iter()
        .filter(|column| column.name == "Case 1 pass 1");
    for column in of_column {
        assert!(column.difference() >= least && column.correlation() <= most);
    }
}
