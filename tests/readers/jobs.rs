//! Three worked jobs: their files are what `tests/common/jobs.rs` makes, and their results are known from how they were made.

use crate::common::jobs::{delta_wing, folder_of, loaded, rods, torque_box, torque_box_truth};
use crate::prelude::*;
use corfem::job::Method;
use corfem::present::tables::report::swaps;
use std::sync::Arc;

const NUMBERS: Numbers = Numbers {
    relative: JOB_RESULTS,
    absolute: JOB_RESULTS,
    last_digit: true,
    ..Numbers::AS_WRITTEN
};

/// `CORFEM_JOBS=write` writes the files instead of comparing them.
fn check_files(name: &str, files: &Files) {
    let folder = folder_of(name);
    let writes = std::env::var("CORFEM_JOBS").is_ok_and(|asked| asked == "write");
    for (file, text) in files {
        let path = folder.join(file);
        if writes {
            fs::create_dir_all(&folder).unwrap();
            fs::write(&path, text).unwrap();
        }
        let stored = fs::read_to_string(&path).unwrap();
        // Numbers that were computed may differ in their last digit on another machine.
        let numbers = Numbers {
            relative: JOB_RESULTS,
            absolute: JOB_RESULTS,
            last_digit: false,
            ..Numbers::AS_WRITTEN
        };
        assert!(numbers.agree(&stored, text), "{}", path.display());
    }
}

fn finished(name: &str) -> (PreparedJob, &'static JobResult) {
    let (prepared, finished) = (loaded(name), worked(name));
    let subject = Report::from_job(&prepared, Some(finished)).unwrap();
    let mut tables = vec![
        trust_table(&finished.trust),
        places_table(&prepared.loaded, Some(finished)).unwrap(),
    ];
    tables.extend([
        paired_table(&subject).unwrap(),
        factor_table(&subject),
        history_table(&subject),
    ]);
    let text = render::text(&tables);
    assert!(
        text.lines().all(|line| line.chars().count() <= 100),
        "{text}"
    );
    assert_golden(&format!("job_{name}"), &text, NUMBERS);
    (prepared, finished)
}

/// The worked jobs end after no more exact analyses than these, the first among them, searches for modes (the box's first asks for more
/// modes than it has), and factorizations. Their structures are ordered once. To a gradient of 1e-5 deviations, a hundredth of what is
/// needed for intervals, box and wing take one analysis more, and GARTEUR is left for lower places.
#[test]
fn worked_jobs_take_few_exact_analyses() {
    let most = [
        ("box", 5, 6, 15),
        ("building", 2, 2, 7),
        // At a wall round-off decides; SciPy takes 33 and looks for no lower place.
        ("garteur", 40, 40, 260),
        ("wing", 4, 4, 11),
    ];
    for (name, analyses, eigensolutions, factorizations) in most {
        let (taken, work) = (worked(name).found.analyses, &worked(name).found.work);
        assert!(taken <= analyses, "{name}: {taken}");
        assert!(work.eigensolutions <= eigensolutions, "{name}: {work:?}");
        assert!(work.factorizations <= factorizations, "{name}: {work:?}");
        assert_eq!(work.orderings, 1, "{name}");
    }
}

/// A job's model condensed to its sensors and its test, which no job compares any more.
fn condensed(
    name: &str,
) -> (
    PreparedJob,
    impl Fn(&PreparedJob, &[f64]) -> Result<Model, Error>,
) {
    let prepared = loaded(name);
    let analyze = |job: &PreparedJob, factors: &[f64]| {
        let whole = &job.loaded.source.whole;
        analyze_condensed(whole, factors, &job.loaded.sensors, &job.test, None)
    };
    (prepared, analyze)
}

/// Condensation to five floors raises frequencies, and the loop takes that for soft stories which it cannot tell apart.
#[test]
fn condensed_to_five_floors_the_building_is_not_found() {
    let (job, analyze) = condensed("building");
    let analyze = |factors: &[f64]| analyze(&job, factors);
    let settings = job.loaded.job.correlation.for_modes(job.modes.len());
    let found = correlate(analyze, &[None; 10], &settings, |_, _| true).unwrap();
    // The error sum that nine modes of the same errors would have.
    let errors = &found.best_check().errors;
    let of_nine = 3.0 * (errors.frequency_rms() + errors.shape_rms());
    assert!(of_nine > 0.2 && !found.converged, "{of_nine}");
    let factors = found.best_factors;
    for pair in factors.chunks(2) {
        assert!(
            relative_error(pair[0], pair[1]) < WEIGHTED_FACTOR,
            "{pair:?}"
        );
    }
    let worst = factors
        .iter()
        .zip(&STORIES)
        .map(|(found, truth)| relative_error(found, truth))
        .largest();
    assert!(worst > 0.2, "{worst}");
}

/// The rods' test with axes of its own: node 2 measures along a y that points to where x does not, node 3 along a z that is x, and
/// node 4 along x.
#[test]
fn sensors_along_axes_of_their_own_find_the_same_rods() {
    let folder = new_folder();
    for (name, text) in rods() {
        fs::write(folder.path().join(name), text).unwrap();
    }
    let path = folder.path().join("job.toml");
    let finished = || {
        let prepared = prepare(&path).unwrap();
        let finished = crate::common::jobs::finished(&prepared);
        (prepared, finished.found.factors)
    };
    let (prepared, expected) = finished();
    let text = write_universal(&prepared.loaded.data);
    let mut lines = text.lines().map(str::to_owned).collect_vec();
    let nodes = lines.iter().position(|line| line.trim() == "2411").unwrap() + 1;
    for (row, system) in [(0, 3), (1, 4)] {
        lines[nodes + 2 * row].replace_range(20..30, &format!("{system:10}"));
    }
    let mut at_node = None;
    for line in lines.iter_mut().skip(nodes + 7) {
        let value = line
            .split_whitespace()
            .next()
            .unwrap_or_default()
            .to_owned();
        match (at_node.take(), line.len()) {
            (Some("2"), 39) => *line = format!("{:13}{:>13}{:13}", 0.0, negated(&value), 0.0),
            (Some("3"), 39) => *line = format!("{:13}{:13}{value:>13}", 0.0, 0.0),
            (_, 10) => at_node = ["2", "3"].into_iter().find(|node| *node == value),
            _ => {}
        }
    }
    // By dataset 18 the x of 3 is the global y; by 2420 the x, y, z of 4 are the global y, z, x.
    let points = "         3         0         0         8         1\nSYS\n   0. 0. 0. 0. 1. 0.\n   0. 0. 1.\n";
    let rows = "         1\nPart\n         4         0         8\nCS\n  0. 1. 0.\n  0. 0. 1.\n  1. 0. 0.\n  0. 0. 0.\n";
    let systems = format!("    -1\n    18\n{points}    -1\n    -1\n  2420\n{rows}    -1\n");
    fs::write(
        folder.path().join("test.csv"),
        systems + &lines.join("\n") + "\n",
    )
    .unwrap();
    let (prepared, found) = finished();
    let directions = prepared
        .loaded
        .placed
        .iter()
        .map(|sensor| sensor.direction)
        .collect_vec();
    assert_eq!(directions, [1, 2, 0]);
    for (a, b) in found.iter().zip(&expected) {
        assert!(
            relative_error(a, b) < WEIGHTED_FACTOR,
            "{found:?} {expected:?}"
        );
    }
    let dense = prepared.loaded.sensors.dense();
    assert_eq!(
        (0..3).map(|row| dense[(row, row)]).collect_vec(),
        [-1.0, 1.0, 1.0]
    );
    let table = places_table(&prepared.loaded, None).unwrap();
    let own = table
        .rows
        .iter()
        .map(|row| row.cells[1].computed())
        .collect_vec();
    assert_eq!(own, ["y", "z", "x"]);
}

/// A number of a Universal File with the other sign.
fn negated(value: &str) -> String {
    value
        .strip_prefix('-')
        .map_or_else(|| format!("-{value}"), str::to_owned)
}

/// A job's first model is analyzed once: what prepares it keeps it, unless something else is compared then.
#[test]
fn the_first_model_is_the_one_that_was_prepared() {
    let prepared = loaded("building");
    let first = prepared.analyze(&[1.0; 10]).unwrap();
    let mut fewer = prepared.clone();
    fewer.analysis_modes = 7;
    let other = fewer.analyze(&[1.0; 10]).unwrap();
    let modes_of = |comparison: &Comparison| comparison.model().exact().modes.clone();
    assert_eq!((modes_of(&first).len(), modes_of(&other).len()), (10, 7));
    let near = fewer
        .loaded
        .source
        .whole
        .modes(&[1.0; 10], 10)
        .unwrap()
        .vibrations;
    assert_eq!(modes_of(&first).frequencies_hz(), near.frequencies_hz());
    let mut by_paper = prepared.clone();
    Arc::make_mut(&mut by_paper.loaded).job.compare.method = Method::Paper;
    let finished = crate::common::jobs::finished(&by_paper);
    let History::Paper(run) = &finished.found.history else {
        panic!("by the paper's loops")
    };
    // One a pass; the first is that of the start, and the last that of the best pass.
    assert_eq!(finished.found.analyses, 1 + run.passes.len() + 1);
}

/// All that the wing's sensors do not see is condensed well: both ways find the same.
#[test]
fn condensed_the_wing_has_the_same_gages() {
    let (job, analyze) = condensed("wing");
    let condensed = gauss_newton(
        |factors| Ok::<_, Error>(Comparison::from(&analyze(&job, factors)?)),
        &[1.0; GROUPS.len()],
        &[None; GROUPS.len()],
        &job.weights(),
        &WeightedSettings::default(),
    )
    .unwrap();
    assert_alike(
        finished("wing").1.found.factors.iter(),
        &condensed.factors,
        CONDENSED_GAGES,
    );
}

#[test]
fn the_building_is_found_story_by_story_from_five_floors() {
    check_files("building", &building());
    let (_, found) = finished("building");
    assert!(found.found.analyses <= 6, "{}", found.found.analyses);
    for (story, (found, truth)) in found.found.factors.iter().zip(&STORIES).enumerate() {
        assert!(
            relative_error(found, truth) < WEIGHTED_STORY,
            "story {}: {found} for {truth}",
            story + 1
        );
    }
}

#[test]
fn the_wing_is_found_from_ten_modes_at_its_upper_grids() {
    check_files("wing", &delta_wing());
    let (prepared, found) = finished("wing");
    assert!(found.found.analyses <= 4, "{}", found.found.analyses);
    assert!(prepared.loaded.placed.iter().all(|sensor| {
        sensor
            .distance
            .is_some_and(|distance| distance < PLACED_WITHIN)
    }));
    shapes_at_all_grids_are_those_of_the_sensors(&prepared, found);
    // Modes 8 and 9 are 1.6 % apart: where another mode of the model answers than before, the report says so.
    let mut subject = Report::from_job(&prepared, Some(found)).unwrap();
    subject.stages = vec![subject.stages[0].clone(); 3];
    let mut exchanged = subject.clone();
    let pairing = &mut exchanged.stages[1].check.pairing;
    let mut places = pairing.analysis_mode.to_vec();
    places.swap(0, 1);
    pairing.analysis_mode = places;
    let new = swaps(&exchanged)
        .into_iter()
        .filter(|swap| !swaps(&subject).contains(swap))
        .map(|swap| [swap.stage, swap.test_mode, swap.from, swap.to])
        .collect_vec();
    assert_eq!(
        new,
        [[2, 1, 1, 2], [2, 2, 2, 1], [3, 1, 2, 1], [3, 2, 1, 2]]
    );
    assert!(history_table(&exchanged).notes[0].contains("in pass 2 test mode 1 from 1 to 2"));
    for (group, found) in GROUPS.iter().zip(&found.found.factors) {
        let error = found * group.first_over_true - 1.0;
        assert!(error.abs() < JOB_WING, "{}: {error}", group.name);
    }
}

/// How the grids move in a picture: along the sensors as is compared, and in the test nearly as in the corrected model.
fn shapes_at_all_grids_are_those_of_the_sensors(prepared: &PreparedJob, found: &JobResult) {
    let subject = Report::from_job(prepared, Some(found)).unwrap();
    let moved = subject.moved.as_ref().unwrap();
    let states = [&found.found.first, &found.found.last].map(|comparison| {
        let exact = comparison.model().exact();
        exact.pairing.paired(&exact.modes).unwrap()
    });
    let row = |grid: usize| {
        subject
            .grids
            .iter()
            .position(|(label, _)| *label == grid)
            .unwrap()
    };
    for mode in 0..subject.test.len() {
        let (test, last) = (&moved[0][mode], &moved[2][mode]);
        for (sensor, point) in prepared.loaded.placed.iter().zip(&subject.sensors) {
            for (state, shapes) in moved[1..].iter().zip(&states) {
                let along = state[mode][row(sensor.grid)].dot(&point.direction);
                let compared = shapes.shapes()[(sensor.row, mode)];
                assert!(
                    (along - compared).abs() < WHOLE_SHAPE * shapes.shapes().column(mode).amax(),
                    "{along} {compared}"
                );
            }
        }
        let largest = |state: &[Vector3<f64>]| state.iter().map(Vector3::amax).largest();
        // The two are scaled by their own masses; the shape is the same.
        let scale = largest(last) / largest(test);
        let apart = test
            .iter()
            .zip(last)
            .map(|(test, last)| (test * scale - last).amax())
            .largest();
        assert!(
            apart < CONDENSED_GAGES * largest(last),
            "mode {}: {apart}",
            mode + 1
        );
    }
    assert!(
        moved[0][0].iter().any(|motion| motion.x != 0.0),
        "beside what is measured too"
    );
}

/// Noisy modes of the box as they were measured: every panel is within its interval of 95 %.
#[test]
fn the_box_is_corrected_from_noisy_modes_by_its_deck() {
    check_files("box", &torque_box());
    let (prepared, found) = finished("box");
    assert_eq!((prepared.modes.len(), prepared.test.len()), (9, 9));
    let start: f64 = torque_box_truth()
        .iter()
        .map(|truth| truth.ln().powi(2))
        .sum();
    let end: f64 = torque_box_truth()
        .iter()
        .zip(&found.found.factors)
        .map(|(truth, found)| (found / truth).ln().powi(2))
        .sum();
    assert!(end < JOB_BOX * start, "{end} of {start}");
    for (panel, (truth, interval)) in torque_box_truth().iter().zip(&found.intervals).enumerate() {
        assert!(
            interval.is_ok_and(|interval| interval.contains(*truth))
                || *interval == Err(Withheld::MostlyPrior),
            "panel {}: {truth} in {interval:?}",
            panel + 1
        );
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
