//! What a report knows of a job, of a case and of a wing, and what its tables say of sensors, doubts and suspects.

use crate::common::jobs::run;
use crate::paper::report::case_report;
use crate::prelude::*;
use crate::presentation::figures::{results, wings};
use corfem::job::{Spread, Study, Summary, Vary};
use corfem::present::report::Derivatives;
use corfem::present::tables::job::study_table;
use std::sync::Arc;

fn at(x: f64) -> Vector3<f64> {
    Vector3::new(x, 0.0, 0.0)
}

#[test]
fn a_job_has_the_rods_the_grids_and_the_wall_of_its_deck() {
    let prepared = prepared(&with(
        rods(),
        "job.toml",
        "elements = [1]",
        "elements = [1]\nlower = 0.5\nupper = 2.0",
    ));
    let subject = Report::from_job(&prepared, None).expect("a subject");
    // Point masses have one grid, and are no lines.
    assert_eq!(
        subject.frame,
        [0.0, 10.0, 20.0].map(|x| vec![at(x), at(x + 10.0)])
    );
    assert_eq!(
        subject.grids,
        [(1, at(0.0)), (2, at(10.0)), (3, at(20.0)), (4, at(30.0))]
    );
    assert_eq!(subject.supports, [at(0.0)]);
    assert_eq!(subject.ranges, prepared.loaded.source.whole.ranges());
    assert_eq!(
        subject.ranges,
        [
            Some(Bounds {
                lower: 0.5,
                upper: 2.0
            }),
            None
        ]
    );
    let sensors = subject
        .sensors
        .iter()
        .map(|sensor| (sensor.name.as_str(), sensor.place))
        .collect_vec();
    assert_eq!(
        sensors,
        [
            ("S2", Some(at(10.0))),
            ("S3", Some(at(20.0))),
            ("S4", Some(at(30.0)))
        ]
    );
    assert!(
        subject
            .sensors
            .iter()
            .all(|sensor| sensor.direction == Vector3::x())
    );
    assert!(subject.derivatives.is_none());
    assert_eq!(
        (subject.converged(), subject.best, subject.stages.len()),
        (false, None, 0)
    );
    // Without elements the lines of the test are drawn, but for one with an end that stands nowhere.
    let mut lined = prepared.clone();
    let own = Arc::make_mut(&mut lined.loaded);
    Arc::make_mut(&mut own.source).geometry.elements.clear();
    own.data.lines = vec![[1, 2], [2, 99]];
    assert_eq!(
        Report::from_job(&lined, None).expect("a subject").frame,
        [vec![at(0.0), at(10.0)]]
    );
    let mut turned = prepared.clone();
    Arc::make_mut(&mut turned.loaded).placed[0].direction = 3;
    let subject = Report::from_job(&turned, None).expect("a subject");
    assert_eq!(
        subject.sensors[0].direction,
        Vector3::zeros(),
        "a rotation moves nothing that is drawn"
    );
}

#[test]
fn a_job_has_converged_when_its_verdict_says_so_and_has_one_stage_when_it_was_stopped() {
    let each = with(
        rods(),
        "job.toml",
        "elements = [\"2-3\"]",
        "elements = [\"2-3\"]\neach = true",
    );
    let precise = "[compare]\nfrequency_deviation = 1e-4\nshape_deviation = 1e-4";
    let two = with(rods(), "job.toml", "[compare]", precise);
    for (files, is_within) in [(&each, true), (&two, false)] {
        let prepared = prepared(files);
        let finished = finished(&prepared);
        let subject = Report::from_job(&prepared, Some(&finished)).expect("a subject");
        assert_eq!(
            (finished.verdict.is_within, subject.converged()),
            (is_within, is_within)
        );
        assert_eq!(subject.factors(), finished.found.factors);
    }
    let prepared = prepared(&each);
    let finished = run(&prepared, |_| {}, || false).expect("it runs");
    let subject = Report::from_job(&prepared, Some(&finished)).expect("a subject");
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
    let table = places_table(loaded, None).expect("a table");
    let directions = table
        .rows
        .iter()
        .map(|row| row.cells[1].computed())
        .collect_vec();
    assert_eq!(directions, ["x", "-x", "x (0.60 0.00 -0.80)"]);
    assert!(table.notes.is_empty());
    loaded.placed.pop();
    let table = places_table(loaded, None).expect("a table");
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

/// Samples that failed are counted among all, and the first of them is named.
#[test]
fn a_study_counts_what_failed_among_its_samples() {
    let (_folder, path) = placed(&rods());
    let study = Study::new(&path, 3, &[Vary::Noise], &[]).expect("a study");
    let summary = Summary {
        within: 4,
        outside: 1,
        failed: vec![2, 6],
        spreads: vec![("a".to_owned(), None)],
    };
    let notes = study_table(&study, &summary).notes;
    assert_eq!(
        notes[0],
        "7 samples, seed 3, with noise on the test: 4 within tolerance, 1 not, 2 failed."
    );
    assert!(notes[1].contains("--sample 2 says"), "{}", notes[1]);
}

/// A factor that a bound holds in every sample has no scatter of its own; one that it holds in some has.
#[test]
fn a_study_counts_the_samples_at_a_bound() {
    let (_folder, path) = placed(&rods());
    let study = Study::new(&path, 3, &[Vary::Noise], &[]).expect("a study");
    let of = |at_bound| {
        Some(Spread {
            count: 7,
            at_bound,
            mean: 0.8,
            deviation: 0.0,
            quantiles: [0.8; 3],
        })
    };
    let summary = Summary {
        spreads: [("all", 7), ("some", 2)]
            .map(|(name, at_bound)| (name.to_owned(), of(at_bound)))
            .into(),
        within: 7,
        outside: 0,
        failed: Vec::new(),
    };
    let table = study_table(&study, &summary);
    let cells = |row: usize| -> Vec<String> {
        table.rows[row]
            .cells
            .iter()
            .map(|cell| cell.computed())
            .collect()
    };
    assert_eq!(cells(0)[1..], ["", "0.8000", "0.8000", "0.8000", "7"]);
    assert_eq!(cells(1)[1..], ["0.0000", "0.8000", "0.8000", "0.8000", "2"]);
}

/// Each suspect stands beside the slope of its own.
#[test]
fn suspects_have_their_own_unlimited_factors() {
    let prepared = prepared(&with(
        rods(),
        "job.toml",
        "elements = [\"2-3\"]",
        "elements = [\"2-3\"]\neach = true",
    ));
    let table = suspects_table(&prepared).expect("a table");
    let first = prepared.analyze(&[1.0; 3]).expect("analyzed");
    let settings = prepared
        .loaded
        .job
        .correlation
        .for_modes(prepared.modes.len());
    let slopes = corfem::job::localization::by_factor(first.model(), &settings.inner);
    let slopes = slopes.expect("factors");
    let parameters = prepared.loaded.source.whole.parameters();
    assert_eq!(table.rows.len(), 3);
    for row in &table.rows {
        let parameter = parameters
            .iter()
            .position(|parameter| parameter.name == row.label)
            .expect("a parameter");
        let slope = slopes
            .iter()
            .find(|slope| slope.parameter == parameter)
            .expect("a slope");
        assert_eq!(row.cells[2].computed(), format!("{:.2}", slope.factor));
    }
}

#[test]
fn a_case_and_both_wings_have_the_bounds_and_the_places_of_their_models() {
    let result = &results()[1];
    let subject = case_report(result).expect("a subject");
    assert_eq!(
        subject.ranges,
        result
            .case
            .model()
            .expect("a model")
            .factor_ranges()
            .expect("bounds")
    );
    // Held are both ends of the root and the point on the mid-chord line between them.
    let [rear, middle, front] = subject.supports[..] else {
        panic!("three places")
    };
    let along = (middle - rear).norm() / (front - rear).norm();
    assert_relative_eq!(
        along,
        result.case.reconstruction.mid_chord_fraction,
        max_relative = ROUND_OFF
    );
    assert_relative_eq!(
        middle,
        rear + along * (front - rear),
        max_relative = ROUND_OFF
    );
    let [delta, large] = wings() else {
        panic!("two wings")
    };
    let model = first_model(&DeltaWing::embedded()).expect("a model");
    let grids = model.structure().grids();
    assert_eq!(delta.ranges, model.factor_ranges().expect("bounds"));
    let held = grids
        .iter()
        .filter(|grid| grid.constrained[2])
        .map(|grid| grid.position);
    assert_eq!(delta.supports, held.collect_vec());
    let position = |label: usize| {
        grids
            .iter()
            .find(|grid| grid.label == label)
            .map(|grid| grid.position)
    };
    let places = measured_grids(model.structure())
        .into_iter()
        .map(position)
        .collect_vec();
    assert_eq!(
        delta
            .sensors
            .iter()
            .map(|sensor| sensor.place)
            .collect_vec(),
        places
    );
    let known = planted(&Wing::default()).expect("a model");
    assert_eq!(large.ranges, known.model.factor_ranges().expect("bounds"));
}

/// A frequency's derivative by the mass of a parameter, against frequencies of a model with a little more of it.
#[test]
fn a_derivative_by_a_mass_is_the_change_of_frequency_with_it() {
    let (stiffness, share) = (
        DMatrix::from_row_slice(2, 2, &[3.0, -1.0, -1.0, 2.0]),
        DMatrix::from_row_slice(2, 2, &[0.4, 0.1, 0.1, 0.6]),
    );
    let mass = DMatrix::identity(2, 2) + &share;
    let test = solve(&stiffness, &mass, 2).expect("solved");
    let (whole, sensors) =
        of_dense(&stiffness, &mass, &[ParameterMatrix::Mass(share)]).expect("a model");
    let model = |factor: f64| {
        whole.analyze(
            &[factor],
            &sensors,
            &test,
            corfem::sparse::Pair::by(|of| pair_modes(of.cross)),
            BasisSize {
                modes: 2,
                residual_vectors: 0,
            },
        )
    };
    let found = model(1.0)
        .and_then(|first| Derivatives::at(&Comparison::from(first)))
        .expect("taken");
    const STEP: f64 = 1e-5;
    let hertz = |factor: f64| Ok::<_, Error>(model(factor)?.exact().modes.frequencies_hz());
    let (more, less) = (
        hertz(1.0 + STEP).expect("solved"),
        hertz(1.0 - STEP).expect("solved"),
    );
    for mode in 0..2 {
        let difference = (more[mode] / less[mode]).ln() / (2.0 * STEP);
        assert_relative_eq!(
            found.frequency[(0, mode)],
            difference,
            max_relative = CENTRAL_DIFFERENCE_GRADIENT
        );
    }
}
