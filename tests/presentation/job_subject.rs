//! What a report knows of a job and of a case, and what its tables say of sensors, doubts and suspects.

use crate::common::jobs::run;
use crate::prelude::*;
use corfem::present::report::{facts, places};
use std::sync::Arc;

#[test]
fn a_job_is_drawn_with_the_rods_the_grids_and_the_bounds_of_its_deck() {
    let bounded = "elements = [1]\nlower = 0.5\nupper = 2.0";
    let mut found = finished(&prepared(&rods_with("elements = [1]", bounded)));
    let report = report_of(&found);
    let drawing = report.drawing.unwrap();
    // Point masses have one grid, and are no lines.
    let rods = [0, 1, 1].into_iter().enumerate();
    let rods = rods.map(|(row, of)| (vec![row, row + 1], vec![of]));
    assert_eq!(drawing.pieces, rods.collect_vec());
    assert_eq!(
        drawing.places,
        [0.0, 10.0, 20.0, 30.0].map(|x| [x, 0.0, 0.0])
    );
    let sensors = [1, 2, 3].map(|place| Some((place, [1.0, 0.0, 0.0])));
    assert_eq!(drawing.sensors, sensors);
    let bounds = report
        .parameters
        .iter()
        .map(|own| own.lower_bound.zip(own.upper_bound));
    assert_eq!(bounds.collect_vec(), [Some((0.5, 2.0)), None]);
    // Without elements the lines of the test are drawn, but for one with an end that stands nowhere; a rotation moves nothing.
    let own = Arc::make_mut(&mut found.found.prepared.loaded);
    own.source.elements.clear();
    own.data.lines = vec![[1, 2], [2, 99]];
    own.placed[0].direction = 3;
    let drawing = report_of(&found).drawing.unwrap();
    assert_eq!(drawing.pieces, [(vec![0, 1], Vec::new())]);
    assert_eq!(drawing.sensors[0], Some((1, [0.0; 3])));
}

#[test]
fn a_report_ends_as_its_verdict_says_and_a_stopped_one_has_no_step() {
    let each = rods_with("elements = [\"2-3\"]", "elements = [\"2-3\"]\neach = true");
    let precise = "[compare]\nfrequency_deviation = 1e-4\nshape_deviation = 1e-4";
    for (files, is_within) in [(&each, true), (&rods_with("[compare]", precise), false)] {
        let found = finished(&prepared(files));
        let report = report_of(&found);
        assert_eq!(
            (found.verdict.is_within, report.is_within),
            (is_within, is_within)
        );
        let factors = report.parameters.iter().map(|own| own.factor).collect_vec();
        assert_eq!(factors, found.found.factors);
        let last = report.history.last().unwrap();
        assert_eq!(last.stop, Some(report.end));
        // The last step's chi-squared is that of the end.
        assert!(
            relative_error(last.chi_squared.unwrap(), found.misfit.chi_squared) < MATRIX_ROUND_OFF
        );
    }
    let stopped = report_of(&run(&prepared(&each), |_| {}, || false).unwrap());
    assert_eq!((stopped.end, stopped.history.len()), (End::Request, 0));
}

#[test]
fn sensors_that_point_the_other_way_askew_or_nowhere_are_told() {
    let mut prepared = prepared(&rods());
    let loaded = Arc::make_mut(&mut prepared.loaded);
    loaded.placed[1].sign = -1.0;
    loaded.placed[2].axis = Vector3::new(0.6, 0.0, -0.8);
    let directions = places(loaded).into_iter().map(|own| own.direction);
    assert_eq!(directions.collect_vec(), ["x", "-x", "x (0.60 0.00 -0.80)"]);
    loaded.placed.pop();
    let facts = facts(&prepared).unwrap();
    assert!(
        facts
            .iter()
            .any(|own| own.fact == "sensors that are not used" && own.value == "1")
    );
}

#[test]
fn a_mode_is_doubtful_when_it_is_complex_beyond_the_limit() {
    let mut prepared = prepared(&rods());
    Arc::make_mut(&mut prepared.loaded).data.phase_collinearity = vec![0.95, 0.94, 0.99];
    let doubts = text(&[trust_table("", &trust_in(&prepared))]);
    assert!(
        doubts.contains("Complex test modes, with their phase collinearity: 2 (0.94)."),
        "{doubts}"
    );
}

/// A frequency's derivative by stiffness and by mass, against frequencies of a model with a little more of it.
#[test]
fn derivatives_are_the_changes_of_frequencies_with_stiffness_and_mass() {
    let [stiffness, stiff, heavy] =
        [[3.0, -1.0, 2.0], [1.0, -1.0, 1.0], [0.4, 0.1, 0.6]].map(|[a, b, c]| dmatrix![a, b; b, c]);
    let mass = eye(2) + &heavy;
    let test = solve(&stiffness, &mass, 2).unwrap();
    let parameters = [
        ParameterMatrix::Stiffness(stiff),
        ParameterMatrix::Mass(heavy),
    ];
    let (whole, sensors) = of_dense(&stiffness, &mass, &parameters).unwrap();
    let size = 2;
    let model = |factors: [f64; 2]| {
        let model = whole.analyze(&factors, &sensors, &test, by_sorting(), size);
        model.unwrap()
    };
    let found = Derivatives::at(&Comparison::from(model([1.0; 2]))).unwrap();
    const STEP: f64 = 1e-5;
    for e in 0..2 {
        let hertz = |step: f64| {
            let mut factors = [1.0; 2];
            factors[e] += step;
            model(factors).exact().modes.frequencies_hz()
        };
        let (more, less) = (hertz(STEP), hertz(-STEP));
        for mode in 0..2 {
            assert_relative_eq!(
                found.frequency[(e, mode)],
                (more[mode] / less[mode]).ln() / (2.0 * STEP),
                max_relative = CENTRAL_DIFFERENCE_GRADIENT
            );
        }
    }
}
