//! What a report knows of a job and of a case, and what its tables say of sensors, doubts and suspects.

use crate::common::jobs::run;
use crate::paper::report::case_report;
use crate::prelude::*;
use crate::presentation::figures::results;
use corfem::present::report::Derivatives;
use std::sync::Arc;

fn at(x: f64) -> Vector3<f64> {
    Vector3::new(x, 0.0, 0.0)
}

#[test]
fn a_job_has_the_rods_the_grids_and_the_wall_of_its_deck() {
    let bounded = "elements = [1]\nlower = 0.5\nupper = 2.0";
    let mut prepared = prepared(&rods_with("elements = [1]", bounded));
    let of = |prepared: &PreparedJob| Report::from_job(prepared, None).unwrap();
    let subject = of(&prepared);
    // Point masses have one grid, and are no lines.
    let rods = [0.0, 10.0, 20.0].map(|x| vec![at(x), at(x + 10.0)]);
    assert_eq!(subject.frame, rods);
    let grids = [0, 1, 2, 3].map(|k| (k + 1, at(10.0 * k as f64)));
    assert_eq!(
        (&subject.grids[..], &subject.supports[..]),
        (&grids[..], &[at(0.0)][..])
    );
    let (lower, upper) = (0.5, 2.0);
    assert_eq!(subject.ranges, [Some(Bounds { lower, upper }), None]);
    for (sensor, (grid, place)) in subject.sensors.iter().zip(&grids[1..]) {
        assert_eq!(sensor.name, format!("S{grid}"));
        assert_eq!(
            (sensor.place, sensor.direction),
            (Some(*place), Vector3::x())
        );
    }
    assert!(subject.derivatives.is_none() && subject.best.is_none() && !subject.converged());
    // Without elements the lines of the test are drawn, but for one with an end that stands nowhere; a rotation moves nothing.
    let own = Arc::make_mut(&mut prepared.loaded);
    Arc::make_mut(&mut own.source).geometry.elements.clear();
    own.data.lines = vec![[1, 2], [2, 99]];
    own.placed[0].direction = 3;
    let subject = of(&prepared);
    assert_eq!(subject.frame, [vec![at(0.0), at(10.0)]]);
    assert_eq!(subject.sensors[0].direction, Vector3::zeros());
}

#[test]
fn a_job_has_converged_when_its_verdict_says_so_and_has_one_stage_when_it_was_stopped() {
    let each = rods_with("elements = [\"2-3\"]", "elements = [\"2-3\"]\neach = true");
    let precise = "[compare]\nfrequency_deviation = 1e-4\nshape_deviation = 1e-4";
    let two = rods_with("[compare]", precise);
    for (files, is_within) in [(&each, true), (&two, false)] {
        let prepared = prepared(files);
        let finished = finished(&prepared);
        let subject = Report::from_job(&prepared, Some(&finished)).unwrap();
        assert_eq!(
            (finished.verdict.is_within, subject.converged()),
            (is_within, is_within)
        );
        assert_eq!(subject.factors(), finished.found.factors);
    }
    let prepared = prepared(&each);
    let finished = run(&prepared, |_| {}, || false).unwrap();
    let subject = Report::from_job(&prepared, Some(&finished)).unwrap();
    assert_eq!((subject.best, subject.stages.len()), (Some(0), 1));
    assert_eq!(
        (subject.stages[0].stop.as_str(), &subject.stages[0].factors),
        ("request", &finished.found.factors)
    );
}

#[test]
fn sensors_that_point_the_other_way_askew_or_nowhere_are_told() {
    let mut prepared = prepared(&rods());
    let loaded = Arc::make_mut(&mut prepared.loaded);
    loaded.placed[1].sign = -1.0;
    loaded.placed[2].axis = Vector3::new(0.6, 0.0, -0.8);
    let table = places_table(loaded, None).unwrap();
    let directions = table
        .rows
        .iter()
        .map(|row| row.cells[1].computed())
        .collect_vec();
    assert_eq!(directions, ["x", "-x", "x (0.60 0.00 -0.80)"]);
    assert!(table.notes.is_empty());
    loaded.placed.pop();
    let table = places_table(loaded, None).unwrap();
    assert_eq!(table.notes, ["1 of the test's 3 sensors are not used."]);
}

#[test]
fn a_mode_is_doubtful_when_it_is_complex_beyond_the_limit() {
    let mut prepared = prepared(&rods());
    Arc::make_mut(&mut prepared.loaded).data.phase_collinearity = vec![0.95, 0.94, 0.99];
    let doubts = text(&[trust_table(&trust_in(&prepared))]);
    assert!(
        doubts.contains("Test mode 2 is complex: its phase collinearity is 0.94."),
        "{doubts}"
    );
    assert_eq!(doubts.matches("is complex").count(), 1, "{doubts}");
}

/// Each suspect stands beside the slope of its own.
#[test]
fn suspects_have_their_own_unlimited_factors() {
    let each = "elements = [\"2-3\"]\neach = true";
    let prepared = prepared(&rods_with("elements = [\"2-3\"]", each));
    let table = suspects_table(&prepared);
    let first = prepared.analyze(&[1.0; 3]).unwrap();
    let settings = prepared
        .loaded
        .job
        .correlation
        .for_modes(prepared.modes.len());
    let slopes = by_factor(first.model(), &settings.inner).unwrap();
    let parameters = prepared.loaded.source.whole.parameters();
    assert_eq!(table.rows.len(), 3);
    for row in &table.rows {
        let mut slopes = slopes.iter();
        let slope = slopes.find(|slope| parameters[slope.parameter].name == row.label);
        assert_eq!(
            row.cells[2].computed(),
            format!("{:.2}", slope.unwrap().factor)
        );
    }
}

#[test]
fn a_case_has_the_bounds_and_the_places_of_its_model() {
    let result = &results()[1];
    let subject = case_report(result).unwrap();
    let model = result.case.model().unwrap();
    assert_eq!(subject.ranges, model.factor_ranges().unwrap());
    // Held are both ends of the root and the point on the mid-chord line between them.
    let [rear, middle, front] = subject.supports[..] else {
        panic!("three places")
    };
    let along = result.case.reconstruction.mid_chord_fraction;
    assert_relative_eq!(
        middle,
        rear + along * (front - rear),
        max_relative = ROUND_OFF
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
    let size = modes_alone(2);
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
