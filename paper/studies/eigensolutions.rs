//! How many full eigensolutions a correlation takes: perturbation between exact checks against a new analysis after every step.

use super::{delta_wing, rows};
use crate::prelude::*;

/// Error sums to be reached, fractions.
pub const ERRORS: [f64; 2] = [0.05, 0.025];

/// Full finite element analyses, each with its eigensolution, and steps of all parameters, both ways to an exact error sum on one structure, with the rule of the step of given settings: modes that follow the steps by
/// perturbation, so that only the end of an inner loop is analyzed; and an analysis after every single step.
pub fn counted(known: &Known, settings: &Settings, error: f64) -> [(usize, usize); 2] {
    let effort = |inner: InnerSettings| {
        let settings = Settings {
            inner: InnerSettings {
                tolerance: error,
                ..inner
            },
            later_inner_tolerance: 0.5 * error,
            error_sum_tolerance: error,
            // Neither error alone exceeds the sum.
            frequency_tolerance: error,
            shape_tolerance: error,
            most_passes: 200,
            ..settings.clone()
        };
        let (mut analyses, ranges) = (0, known.model.factor_ranges().unwrap());
        let analyze = |factors: &[f64]| {
            analyses += 1;
            known.model.analyze(factors, &known.test)
        };
        let found = correlate(analyze, &ranges, &settings, |_, _| true).unwrap();
        assert!(found.converged, "{}: {error}", known.name);
        let steps = found.passes.iter().map(|pass| pass.inner.iterations.len());
        (analyses, steps.sum())
    };
    let inner = &settings.inner;
    let single = InnerSettings {
        iterations: 1,
        first_relaxation: inner.relaxation,
        ..inner.clone()
    };
    [effort(inner.clone()), effort(single)]
}

/// Full eigensolutions to an exact error sum, by perturbation, with an analysis after every step, and with one for every parameter and step
/// as derivatives by differences would take.
pub fn tables() -> Vec<Table> {
    let cases = (1..=3).map(|number| (Known::of_case(number), case_of(number).settings));
    let all = cases.chain([(Known::delta_wing(), delta_wing::settings())]);
    let found = all.flat_map(|(known, settings)| {
        ERRORS.map(|error| {
            let [(quick, steps), (slow, single)] = counted(&known, &settings, error);
            let differences = slow + single * known.truth.len();
            let counts = [steps, quick, slow, differences].map(|count| count as f64);
            (
                format!("{}, {} %", known.name, 100.0 * error),
                counts.to_vec(),
            )
        })
    });
    let columns = ["Steps", "Perturbation", "Re-analysis", "And differences"];
    vec![rows("eigensolutions", &columns, found)]
}
