//! Every check says yes, no, or not checked, before the first step and after a run.

use super::job_concerns::tested;
use super::twice::{numbered, universal, with_places};
use crate::common::jobs::{rods, run, torque_box};
use crate::prelude::*;
use corfem::job::concern::{Answer, Check, Grade};

/// The account before the first step.
fn before(files: &Files) -> Trust {
    trust_in(&prepared(files))
}

/// The account after a run.
fn after(files: &Files) -> Trust {
    let loaded = prepared(files);
    let result = run(&loaded, |_| {}, || true);
    result.unwrap().trust
}

/// The first sensors of a test alone.
fn few(files: Files, count: usize) -> Files {
    retested(files, |data| {
        data.sensors.truncate(count);
        data.shapes = data.shapes.rows(0, count).into_owned();
    })
}

/// Masses that move along x and y, with sensors along x; at one of them a sensor along y is taken for one along x.
pub fn plane(is_turned: bool) -> Files {
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
    let name = |files: &mut Files, file: &str, text: String| {
        let own = files.iter_mut().find(|(name, _)| name == file);
        own.unwrap().1 = text;
    };
    let lines = (0..6).flat_map(|grid| ["x", "y"].map(|along| format!("{},{along}\n", grid + 1)));
    name(&mut files, "rows.csv", lines.collect());
    retested(files, |data| {
        let read = (0..6)
            .map(|grid| row(grid, usize::from(is_turned && grid == 3)))
            .collect_vec();
        data.shapes = data.shapes.select_rows(&read);
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
    let files = retested(measured_building(10, 1), |data| {
        data.frequencies_hz[0] *= 1.1;
    });
    let mut files = files;
    let text = "frequency_hz,1.5\n,mode 1\n";
    let test = files.iter_mut().find(|(name, _)| name == "test.csv");
    test.unwrap().1 = text.to_owned();
    files
}

/// What must be answered, and a job of which it must be.
type Case = (Answer, Trust);

/// Jobs with the answers of a check, or the reason why there are none of the other answers.
fn cases(check: Check) -> (Vec<Case>, &'static str) {
    use Answer::{No, NotChecked, Yes};
    let right = || before(&tested(|_| {}));
    let one = || before(&few(tested(|_| {}), 1));
    // Four shapes of three sensors, no two alike.
    let many = retested(few(tested(|_| {}), 3), |data| {
        data.shapes = dmatrix![1.0, 0.0, 0.0, 0.6; 0.0, 1.0, 0.0, 0.6; 0.0, 0.0, 1.0, 0.6];
    });
    let shapes = "a test with shapes and sensors always tells";
    match check {
        Check::Readings => (
            vec![
                (
                    Yes,
                    before(&tested(|data| data.shapes.row_mut(4).neg_mut())),
                ),
                (No, right()),
                (NotChecked, before(&few(tested(|_| {}), 2))),
            ],
            "",
        ),
        Check::Directions => (
            vec![
                (Yes, before(&plane(true))),
                (No, before(&plane(false))),
                (NotChecked, right()),
            ],
            "",
        ),
        Check::Copies => {
            let twice = tested(|data| {
                let again = data.shapes.column(1).into_owned();
                data.shapes.set_column(2, &again);
                data.frequencies_hz[2] = 1.001 * data.frequencies_hz[1];
            });
            (
                vec![(Yes, before(&twice)), (No, right()), (NotChecked, one())],
                "",
            )
        }
        Check::CommonFactor => {
            let turned = tested(|data| data.frequencies_hz.iter_mut().for_each(|own| *own *= TAU));
            (
                vec![(Yes, before(&turned)), (No, right()), (NotChecked, one())],
                "",
            )
        }
        Check::OrderOfFrequencies => {
            let swapped = tested(|data| data.frequencies_hz.swap(0, 1));
            (
                vec![(Yes, before(&swapped)), (No, right()), (NotChecked, one())],
                "",
            )
        }
        Check::ToldApart => (vec![(Yes, before(&many)), (No, right())], shapes),
        Check::Percentages => {
            let percent = |size| tested(|data| data.shape_deviation = Some(vec![size; 4]));
            (
                vec![
                    (Yes, before(&percent(0.5))),
                    (Yes, before(&percent(5.0))),
                    (No, right()),
                ],
                "every setting has a value",
            )
        }
        Check::Bounds => (
            vec![
                (Yes, right()),
                (No, before(&bounded(tested(|_| {}), 0.5, 2.0))),
            ],
            "bounds are there or not",
        ),
        Check::Places => (
            vec![
                (
                    Yes,
                    before(&with_places(torque_box(), |places| places.swap(0, 4))),
                ),
                (No, before(&torque_box())),
                (NotChecked, right()),
            ],
            "",
        ),
        Check::Numbers => (
            vec![
                (Yes, before(&numbered([4, 3, 2, 1]))),
                (No, before(&numbered([1, 2, 3, 4]))),
            ],
            "a file that does not number its modes says nothing twice",
        ),
        Check::Units => (
            vec![
                (Yes, before(&universal(7, 1000.0))),
                (No, before(&universal(7, 39.37))),
                (NotChecked, before(&universal(9, 1.0))),
            ],
            "",
        ),
        Check::Pairs => {
            let half = tested(|data| {
                data.shapes.column_mut(2).fill(0.0);
                data.shapes[(0, 2)] = 1.0;
            });
            (
                vec![
                    (Yes, before(&half)),
                    (No, right()),
                    (NotChecked, before(&lone())),
                ],
                "",
            )
        }
        Check::Reach => {
            let far = bounded(tested(|data| data.frequencies_hz[3] *= 2.0), 0.9, 1.1);
            let reversed = tested(|data| data.shapes.row_mut(4).neg_mut());
            (
                vec![
                    (Yes, before(&far)),
                    (No, right()),
                    (NotChecked, before(&reversed)),
                ],
                "",
            )
        }
        Check::FreeMotions => {
            let held = with(
                rods(),
                "model.bdf",
                "GRID,4,,30.,0.,0.,,23456",
                "GRID,4,,30.,0.,0.,,2456",
            );
            let held = with(
                held,
                "model.bdf",
                "CMASS2,14",
                "CMASS2,15,1.,4,3\nCMASS2,14",
            );
            (
                vec![
                    (Yes, before(&held)),
                    (No, right()),
                    (NotChecked, before(&free())),
                ],
                "",
            )
        }
        Check::Parts => {
            let files = measured_building(10, 4);
            let own = |factor: f64| {
                let stiffness = springs(10, &[(0, None, factor * 1e5)]);
                let mut files = with(
                    files.clone(),
                    "job.toml",
                    "matrix = \"stiffness.mtx\"",
                    "matrix = \"part.mtx\"",
                );
                let text = corfem::files::matrices::write_matrix_market(&stiffness);
                files.push(("part.mtx".to_owned(), text));
                before(&files)
            };
            (
                vec![(Yes, own(3.0)), (No, own(1.0))],
                "only a factorization that ends without a number leaves a part unchecked",
            )
        }
        Check::Collinearity => {
            let complex = |size| tested(|data| data.phase_collinearity = vec![size; 4]);
            (
                vec![(Yes, before(&complex(0.5))), (No, before(&complex(1.0)))],
                "a real shape has no phase",
            )
        }
        Check::Sight => (
            vec![
                (
                    Yes,
                    after(&with(
                        tested(|_| {}),
                        "job.toml",
                        "name = \"all\"\n",
                        "name = \"all\"\nprior_deviation = 1e-6\n",
                    )),
                ),
                (No, after(&tested(|_| {}))),
            ],
            "slopes are always there",
        ),
        Check::Fit => (
            vec![
                (Yes, after(&tested(|data| data.frequencies_hz[2] *= 1.2))),
                (No, after(&tested(|_| {}))),
                (NotChecked, after(&lone())),
            ],
            "",
        ),
        Check::Intervals => {
            let paper = with(
                bounded(
                    tested(|data| data.frequencies_hz.iter_mut().for_each(|own| *own *= 0.97)),
                    0.5,
                    2.0,
                ),
                "job.toml",
                "[[parameter]]",
                "[compare]\nmethod = \"paper\"\n[[parameter]]",
            );
            (
                vec![(No, after(&tested(|_| {}))), (NotChecked, after(&paper))],
                "an interval is a number and no concern",
            )
        }
    }
}

/// The law: each of the three answers is seen of every check, or there is a reason why it cannot be.
#[test]
fn every_check_says_yes_no_or_not_checked() {
    for (place, (check, name, ..)) in Check::ALL.into_iter().enumerate() {
        assert_eq!(place, check as usize, "{name} stands at its number");
        let (cases, reason) = cases(check);
        let mut missing = vec![Answer::Yes, Answer::No, Answer::NotChecked];
        for (expected, trust) in cases {
            let said = trust.all().iter().map(Concern::words).collect_vec();
            assert_eq!(trust.answer(check), expected, "{name}: {said:#?}");
            missing.retain(|own| *own != expected);
        }
        assert_eq!(missing.is_empty(), reason.is_empty(), "{name}: {missing:?}");
    }
}

/// Whatever makes the status 3 is the end of one check.
#[test]
fn every_doubt_is_of_one_check() {
    let all = super::super::presentation::program::cli_trust::KINDS;
    for kind in all {
        let grade = Concern::new(kind, &["a", "b"], &[1.0; 4]).grade();
        let of = Check::ALL
            .iter()
            .filter(|(.., ends, open)| ends.contains(&kind) || open.contains(&kind));
        match grade {
            Grade::Doubt | Grade::LeftOut => assert_eq!(of.count(), 1, "{kind:?}"),
            Grade::Remark => assert!(of.count() <= 1, "{kind:?}"),
        }
    }
}

/// Identifiers of what stands against a result.
fn against(trust: &Trust) -> Vec<String> {
    let all = trust.all().iter();
    let all = all.filter(|own| own.grade() != Grade::Remark);
    all.map(Concern::identifier).collect()
}

/// The law: a look at a job and the account of its run end in the same doubts.
#[test]
fn a_look_and_a_run_end_in_the_same_doubts() {
    for name in ["box", "building", "garteur", "wing"] {
        let result = worked(name);
        let doubts = |trust: &Trust| -> Vec<String> {
            let stands = trust.all().iter().filter(|own| own.grade() == Grade::Doubt);
            stands.map(Concern::identifier).collect()
        };
        let looked = Trust::before(&crate::common::jobs::loaded(name));
        let looked = looked.unwrap();
        assert_eq!(doubts(&looked), doubts(&result.trust), "{name}");
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
        let looked = against(&before(&files));
        assert!(!looked.is_empty());
        assert_eq!(looked, against(&after(&files)));
    }
}
