//! Every question is answered by yes, no, or not checked.

use super::job_concerns::{HARDLY_HELD, tested};
use super::twice::{numbered, universal, with_places};
use crate::common::jobs::torque_box;
use crate::prelude::*;
use corfem::job::concern::{Answer, Answered, Check, Grade};

/// The account before the first step.
fn before(files: &Files) -> Trust {
    trust_in(&prepared(files))
}

/// The account after a run.
fn after(files: &Files) -> Trust {
    finished(&prepared(files)).trust
}

/// The first sensors of a test alone.
fn few(files: Files, count: usize) -> Files {
    retested(files, |data| {
        data.sensors.truncate(count);
        data.shapes = data.shapes.rows(0, count).into_owned();
    })
}

/// Masses that move along x and y, with sensors along x.
pub fn plane() -> Files {
    let rows = 12;
    let row = |grid: usize, along: usize| 2 * grid + along;
    let mut all = Vec::new();
    for grid in 0..6_usize {
        for along in 0..2 {
            let other = grid.checked_sub(1).map(|grid| row(grid, along));
            all.push((row(grid, along), other, 1e5 * (1.0 + 0.7 * along as f64)));
        }
        if grid > 0 {
            all.push((row(grid, 0), Some(row(grid - 1, 1)), 2e4));
        }
    }
    let stiffness = springs(rows, &all).dense();
    let mass = eye(rows) * 3.0;
    let modes = solve(&stiffness, &mass, 5).unwrap();
    let mut files = of_matrices(&[stiffness], &mass, &modes);
    let lines = (1..=6).flat_map(|grid| ["x", "y"].map(|along| format!("{grid},{along}\n")));
    *file(&mut files, "rows.csv") = lines.collect();
    retested(files, |data| {
        data.shapes = data.shapes.select_rows(&[0, 2, 4, 6, 8, 10]);
        data.sensors.truncate(6);
        for (grid, sensor) in data.sensors.iter_mut().enumerate() {
            sensor.grid = Some(grid + 1);
        }
    })
}

/// Masses in a row on springs between them, held nowhere.
pub fn free() -> Files {
    let links = (1..6).map(|row| (row, Some(row - 1), 1e5)).collect_vec();
    let (stiffness, mass) = (springs(6, &links).dense(), masses(&[3.0; 6]).dense());
    let all = solve(&(&stiffness + 1e-3 * &mass), &mass, 6).unwrap();
    let three = all.omega_squared().rows(1, 3).into_owned();
    let modes = Modes::new(three, all.shapes().columns(1, 3).into_owned()).unwrap();
    of_matrices(&[stiffness], &mass, &modes)
}

/// A job with bounds on its only parameter.
fn bounded(files: Files, lower: f64, upper: f64) -> Files {
    let name = "name = \"all\"\n";
    let bounds = format!("{name}lower = {lower}\nupper = {upper}\n");
    with(files, "job.toml", name, &bounds)
}

/// The same with a mode of frequency alone, and no other.
fn lone() -> Files {
    let mut files = measured_building(10, 1);
    *file(&mut files, "test.csv") = "frequency_hz,1.5\n,mode 1\n".to_owned();
    files
}

/// Questions with an answer that a right job does not have, and a job that has it.
fn others() -> Vec<(Check, Answer, Trust)> {
    use Answer::{No, NotChecked, Yes};
    use Check::*;
    let again = |old: &str, new: &str| with(tested(|_| {}), "job.toml", old, new);
    let one = before(&few(tested(|_| {}), 1));
    let reversed = before(&tested(|data| data.shapes.row_mut(4).neg_mut()));
    let twice = tested(|data| {
        let again = data.shapes.column(1).into_owned();
        data.shapes.set_column(2, &again);
        data.frequencies_hz[2] = 1.001 * data.frequencies_hz[1];
    });
    let scaled = |factor: f64| {
        let scale = |own: &mut f64| *own *= factor;
        tested(|data| data.frequencies_hz.iter_mut().for_each(scale))
    };
    let deviating = |size: f64| {
        before(&tested(|data| {
            data.frequency_deviation = Some(vec![0.01; 4]);
            data.shape_deviation = Some(vec![size; 4]);
        }))
    };
    let half = tested(|data| {
        data.shapes.column_mut(2).fill(0.0);
        data.shapes[(0, 2)] = 1.0;
    });
    let far = bounded(tested(|data| data.frequencies_hz[3] *= 2.0), 0.9, 1.1);
    let mut soft = measured_building(4, 1);
    let second = "3 3 100000.0000020\n4 3 -1e5\n4 4 1e5\n";
    *file(&mut soft, "stiffness.mtx") = HARDLY_HELD.replacen("2 2 3", "4 4 6", 1) + second;
    let all = "matrix = \"stiffness.mtx\"\n";
    let heavy = again(all, &format!("{all}scales = \"mass\"\n"));
    let twin = again(all, &format!("{all}[[parameter]]\nname = \"b\"\n{all}"));
    let alone = lone();
    vec![
        (FreeMotions, Yes, before(&soft)),
        (FreeMotions, NotChecked, before(&free())),
        (ModesMeasuredTwice, Yes, before(&twice)),
        (ModesMeasuredTwice, NotChecked, one.clone()),
        (CommonFactor, Yes, before(&scaled(TAU))),
        (CommonFactor, NotChecked, one),
        (Readings, Yes, reversed.clone()),
        (Readings, NotChecked, before(&few(tested(|_| {}), 2))),
        (Settings, Yes, deviating(5.1)),
        (
            PlacesOfSensors,
            Yes,
            before(&with_places(torque_box(), |places| places.swap(0, 4))),
        ),
        (PlacesOfSensors, No, before(&torque_box())),
        (Units, Yes, before(&universal(7, 1000.0))),
        (Units, No, before(&universal(7, 39.37))),
        (Units, NotChecked, before(&universal(9, 1.0))),
        (Pairs, Yes, before(&half)),
        (Pairs, NotChecked, before(&alone)),
        (Reach, Yes, before(&far)),
        (Reach, NotChecked, reversed),
        (PartsOfTheModel, Yes, before(&heavy)),
        (
            ComplexShapes,
            Yes,
            before(&tested(|data| data.phase_collinearity = vec![0.5; 4])),
        ),
        (Inputs, Yes, before(&numbered([4, 3, 2, 1]))),
        (Deviations, No, deviating(0.01)),
        (Sight, Yes, after(&twin)),
        (
            Fit,
            Yes,
            after(&tested(|data| data.frequencies_hz[2] *= 1.2)),
        ),
        (Fit, NotChecked, after(&alone)),
        (
            Intervals,
            NotChecked,
            after(&comparing(
                bounded(scaled(0.97), 0.5, 2.0),
                "method = \"paper\"",
            )),
        ),
    ]
}

/// Answers that a question never has, and why.
const NEVER: [(Check, Answer, &str); 7] = [
    (
        Check::Settings,
        Answer::NotChecked,
        "every setting has a value",
    ),
    (
        Check::PartsOfTheModel,
        Answer::NotChecked,
        "only a factorization that ends without a number leaves a part unchecked",
    ),
    (
        Check::ComplexShapes,
        Answer::NotChecked,
        "a real shape has no phase",
    ),
    (Check::Inputs, Answer::NotChecked, "an input is used or not"),
    (
        Check::Deviations,
        Answer::NotChecked,
        "a deviation is given or not",
    ),
    (Check::Sight, Answer::NotChecked, "slopes are always there"),
    (
        Check::Intervals,
        Answer::Yes,
        "an interval is a number and no concern",
    ),
];

/// The law: each of the three answers is seen of every question, or there is a reason why it cannot be.
#[test]
fn every_check_says_yes_no_or_not_checked() {
    let (others, right) = (others(), tested(|_| {}));
    let all = after(&right).answers(true);
    assert_eq!(before(&right).answers(false), all[..13]);
    for Answered {
        check: name,
        answer: of_right,
    } in all
    {
        let mut missing = vec![Answer::Yes, Answer::No, Answer::NotChecked];
        missing.retain(|own| *own != of_right);
        for (_, expected, trust) in others.iter().filter(|own| own.0.name() == name) {
            let found = trust.answers(true);
            let found = found.iter().find(|own| own.check == name);
            assert_eq!(
                found.map(|own| own.answer),
                Some(*expected),
                "{name}: {trust:#?}"
            );
            missing.retain(|own| own != expected);
        }
        let never = NEVER.iter().filter(|own| own.0.name() == name);
        assert_eq!(missing, never.map(|own| own.1).collect_vec(), "{name}");
    }
}

/// Identifiers of doubts and of test modes that are not compared.
fn against(trust: &Trust) -> Vec<String> {
    let is_against =
        |own: &&Concern| own.grade == Grade::Doubt || own.identifier.starts_with("not-compared-");
    let all = trust.all().iter().filter(is_against);
    all.map(|own| own.identifier.clone()).collect()
}

/// The law: a look at a job and the account of its run end in the same doubts.
#[test]
fn a_look_and_a_run_end_in_the_same_doubts() {
    for name in ["box", "building", "garteur", "wing"] {
        let looked = trust_in(&crate::common::jobs::loaded(name));
        let [looked, ran] = [&looked, &worked(name).trust].map(against);
        assert_eq!(looked, ran, "{name}");
    }
    let jobs = [
        tested(|data| data.shapes.row_mut(4).neg_mut()),
        bounded(tested(|data| data.frequencies_hz[3] *= 2.0), 0.9, 1.1),
        tested(|data| {
            data.shapes.column_mut(2).fill(0.0);
            data.shapes[(0, 2)] = 1.0;
        }),
        numbered([4, 3, 2, 1]),
    ];
    for files in jobs {
        let [looked, ran] = [before(&files), after(&files)].map(|own| against(&own));
        assert!(!looked.is_empty());
        assert_eq!(looked, ran);
    }
}
