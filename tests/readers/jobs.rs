//! Worked jobs: their results are known from how they were made.

use crate::common::jobs::{loaded, test_data, torque_box_truth};
use crate::prelude::*;

pub const NUMBERS: Numbers = Numbers {
    relative: JOB_RESULTS,
    absolute: JOB_RESULTS,
    last_digit: true,
    ..Numbers::AS_WRITTEN
};

fn finished(name: &str) -> (PreparedJob, &'static JobResult) {
    let (prepared, finished) = (loaded(name), worked(name));
    let text = text(&report_of(finished).brief());
    assert!(
        text.lines().all(|line| line.chars().count() <= 100),
        "{text}"
    );
    assert_golden(&format!("job_{name}"), &text, NUMBERS);
    (prepared, finished)
}

/// The worked jobs end after no more exact analyses than these, the first among them, searches for modes (the box's first asks for more
/// modes than it has), and factorizations. Their structures are ordered once. To a gradient of 1e-5 deviations, a hundredth of what is
/// needed for intervals, box and wing take one analysis more, and box and GARTEUR are left for lower places.
#[test]
fn worked_jobs_take_few_exact_analyses() {
    let all = [
        // Analyses of the look for a lower place, and of the walk to the ends of intervals, are counted as work alone; of at most 160 rows each
        // is a few milliseconds.
        ("box", 22, 1100, 2200),
        // The two checks of each of ten parts count as well.
        ("building", 2, 150, 310),
        // At a wall round-off decides; SciPy takes 33 and looks for no lower place.
        ("garteur", 90, 100, 300),
        ("wing", 4, 350, 700),
    ];
    for (name, most, eigensolutions, factorizations) in all {
        let (taken, work) = (analyses(&worked(name).found), &worked(name).found.work);
        assert!(taken <= most, "{name}: {taken}");
        assert!(work.eigensolutions <= eigensolutions, "{name}: {work:?}");
        assert!(work.factorizations <= factorizations, "{name}: {work:?}");
        assert_eq!(work.orderings, 1, "{name}");
    }
}

/// A job's model condensed to its sensors and its test, which no job compares any more.
fn condensed(job: &PreparedJob) -> impl Fn(&[f64]) -> Result<ModalModel, Error> {
    |factors| {
        let whole = &job.loaded.source.whole;
        analyze_condensed(whole, factors, &job.loaded.sensors, &job.test, None)
    }
}

/// A job's first model is analyzed once: what prepares it keeps it, unless something else is compared then.
#[test]
fn the_first_model_is_the_one_that_was_prepared() {
    let seven = ("analysis_modes = 10", "analysis_modes = 7");
    let fewer = crate::common::jobs::prepared(&with(building(), "job.toml", seven.0, seven.1));
    let hertz = |job: &PreparedJob| {
        let first = job.analyze(&[1.0; 10]).unwrap();
        first.model().exact().modes.frequencies_hz()
    };
    let near = fewer.loaded.source.whole.modes(&[1.0; 10], 10).unwrap();
    assert_eq!(hertz(&loaded("building")), near.vibrations.frequencies_hz());
    assert_eq!(hertz(&fewer).len(), 7);
}

/// All that the wing's sensors do not see is condensed well: both ways find the same.
#[test]
fn condensed_the_wing_has_the_same_gages() {
    let job = loaded("wing");
    let analyze = condensed(&job);
    let found = gauss_newton(
        |factors| Ok::<_, Error>(Comparison::from(&analyze(factors)?)),
        &[1.0; 21],
        &[None; 21],
        &job.weights(),
        &WeightedSettings::default(),
    );
    assert_alike(
        &finished("wing").1.found.factors,
        found.unwrap().factors,
        CONDENSED_GAGES,
    );
}

#[test]
fn the_building_is_found_story_by_story_from_five_floors() {
    let found = &finished("building").1.found;
    assert_alike(&found.factors, STORIES, WEIGHTED_STORY);
}

#[test]
fn the_wing_is_found_from_ten_modes_at_its_upper_grids() {
    let (prepared, found) = finished("wing");
    let distances = prepared
        .loaded
        .placed
        .iter()
        .map(|sensor| sensor.distance.unwrap());
    assert!(distances.largest() < PLACED_WITHIN);
    shapes_at_all_grids_are_those_of_the_sensors(&prepared, found);
    for (group, found) in GROUPS.iter().zip(&found.found.factors) {
        let error = found * group.first_over_true - 1.0;
        assert!(error.abs() < JOB_WING, "{}: {error}", group.name);
    }
}

/// How the grids move in a picture: along the sensors as the readings say.
fn shapes_at_all_grids_are_those_of_the_sensors(prepared: &PreparedJob, found: &JobResult) {
    let report = report_of(found);
    let drawing = report.drawing.unwrap();
    let sensors = prepared.loaded.placed.len();
    for (mode, readings) in report.readings.chunks(sensors).enumerate() {
        for (reading, sensor) in readings.iter().zip(&drawing.sensors) {
            let (place, along) = sensor.unwrap();
            for (moved, compared) in drawing.moved.iter().zip([reading.first, reading.corrected]) {
                let motion = moved[mode][place].map(|part| 1e-3 * part as f64);
                let along = motion.iter().zip(along).map(|(part, axis)| part * axis);
                // Drawn are whole thousandths along each axis.
                assert_within(along.sum::<f64>(), compared, 1e-3);
            }
        }
    }
    let is_beside = |motion: &[i64; 3]| motion[0] != 0;
    assert!(
        drawing.moved[1][0].iter().any(is_beside),
        "beside what is measured too"
    );
}

/// Noisy modes of the box as they were measured, those of Case 2 with the usual noise: every panel is within its interval of 95 %.
#[test]
fn the_box_is_corrected_from_noisy_modes_by_its_deck() {
    let (prepared, found) = finished("box");
    assert_eq!((prepared.modes.len(), prepared.test.len()), (9, 9));
    let noisy = with_noise(&case_of(2).test_modes().unwrap(), Noise::USUAL, 4).unwrap();
    let (made, data) = (test_data(&noisy, std::iter::empty()), &prepared.loaded.data);
    assert_alike(&data.frequencies_hz, made.frequencies_hz, JOB_RESULTS);
    assert!((&data.shapes - made.shapes).amax() < JOB_RESULTS);
    let truth = torque_box_truth();
    let off = |factors: &[f64]| -> f64 {
        let both = truth.iter().zip(factors);
        both.map(|(truth, factor)| (factor / truth).ln().powi(2))
            .sum()
    };
    assert!(off(&found.found.factors) < JOB_BOX * off(&[1.0; 15]));
    for (truth, interval) in truth.iter().zip(&found.intervals) {
        let is_held = match interval {
            Ok(ends) => ends.contains(*truth),
            Err(why) => *why == Withheld::MostlyPrior,
        };
        assert!(is_held, "{truth} in {interval:?}");
    }
}

/// Central differences of exact analyses are another way to the optimum than the slopes by which steps end.
#[test]
fn worked_jobs_end_within_a_thousandth_of_a_deviation_of_their_optimum() {
    const STEP: f64 = 1e-4;
    // The airplane's steps end at a wall, and say so.
    for name in ["box", "building", "wing"] {
        let (prepared, result) = (loaded(name), worked(name));
        let weights = prepared.weights();
        let (factors, priors) = (&result.found.factors, &prepared.loaded.source.priors);
        let free = |e: &usize| !result.verdict.at_bound.contains(e);
        let free = (0..factors.len()).filter(free).collect_vec();
        let at = |parameter: usize, step: f64| {
            let mut changed = factors.clone();
            changed[parameter] *= step.exp();
            let model = prepared.analyze(&changed).unwrap();
            residuals(&model, &weights).unwrap()
        };
        let columns = free
            .iter()
            .map(|&e| (at(e, STEP) - at(e, -STEP)) / (2.0 * STEP))
            .collect_vec();
        let jacobian = DMatrix::from_columns(&columns);
        let own = residuals(&result.found.last, &weights).unwrap();
        let of = |e: usize| priors.get(e).unwrap_or(&priors[0]).powi(-2);
        let prior = DVector::from_iterator(free.len(), free.iter().map(|&e| of(e)));
        let logarithms = DVector::from_iterator(free.len(), free.iter().map(|&e| factors[e].ln()));
        let gradient = jacobian.tr_mul(&own) + prior.component_mul(&logarithms);
        let information = jacobian.tr_mul(&jacobian) + DMatrix::from_diagonal(&prior);
        let step = information.cholesky().unwrap().solve(&gradient);
        let away = step.dot(&gradient).sqrt();
        assert!(away < OPTIMUM, "{name}: {away:.1e} deviations");
    }
}
