//! The law over all answers: right tests of ten structures raise no doubt, and one mistake in a test is named, and no other sensor.

use super::digits::{job, modes, parts, whole};
use super::job_pairs::normal;
use crate::common::draws::Draws;
use crate::common::free_structures::written;
use crate::common::jobs::{files_of, report_of, sensor, test_data};
use crate::prelude::*;
use corfem::job::History;

/// Structures with one way of sensors, clamped or free, with singular mass, on soft springs, with equal roots, condensed by Craig and
/// Bampton, written with ten digits, with light oscillators, and with sensors along two directions by turns.
const KINDS: usize = 10;
/// Noise of the tests, which they declare, in frequencies and shapes.
const NOISE: [f64; 2] = [0.003, 0.01];
/// What is wrong with a test.
const MISTAKES: [&str; 7] = [
    "none",
    "reversed",
    "exchanged",
    "dead",
    "unit",
    "grid",
    "noise",
];

/// Stiffness and mass of what is known and of the parameters' parts, and the rows with sensors.
fn built(draws: &mut Draws, kind: usize) -> (Vec<[DMatrix<f64>; 2]>, Vec<usize>) {
    let held = [
        true, true, false, true, false, true, true, true, true, false,
    ];
    let plane = [0, 1, 1, 2, 3, 0, 1, 1, 1, 0];
    let count = 2 + draws.below(3);
    let (mut all, _) = parts(draws, plane[kind], 12, held[kind], count);
    let rows = all[0][0].nrows();
    let is_read = |row: &usize| match (kind, row % 3) {
        (_, 2) => false,
        (0, way) => way == 1,
        (9, way) => row / 3 % 2 == way,
        _ => row / 3 % 2 == 1,
    };
    let mut sensors = (0..rows).filter(is_read).collect_vec();
    let mut grow = |by: usize| {
        all.iter_mut().flatten().for_each(|own| {
            *own = own.clone().resize(rows + by, rows + by, 0.0);
        });
    };
    match kind {
        5 => {
            grow(rows);
            for own in all.iter_mut().flatten() {
                let one = own.view((0, 0), (rows, rows)).into_owned();
                own.view_mut((rows, rows), (rows, rows)).copy_from(&one);
            }
            sensors = sensors.iter().flat_map(|row| [*row, row + rows]).collect();
        }
        6 => {
            let inside = (0..rows).filter(|row| !sensors.contains(row)).collect_vec();
            let cut =
                |own: &DMatrix<f64>, a: &[usize], b: &[usize]| own.select_rows(a).select_columns(b);
            let [k, m] = whole(&all, |_, _| 1.0);
            let own = cut(&k, &inside, &inside).cholesky().unwrap();
            let follow = -own.solve(&cut(&k, &inside, &sensors));
            let shapes = solve(&cut(&k, &inside, &inside), &cut(&m, &inside, &inside), 6).unwrap();
            let bound = sensors.len();
            let mut turn = DMatrix::zeros(rows, bound + 6);
            sensors
                .iter()
                .enumerate()
                .for_each(|(at, row)| turn[(*row, at)] = 1.0);
            for (at, row) in inside.iter().enumerate() {
                turn.view_mut((*row, 0), (1, bound))
                    .copy_from(&follow.row(at));
                turn.view_mut((*row, bound), (1, 6))
                    .copy_from(&shapes.shapes().row(at));
            }
            for own in all.iter_mut().flatten() {
                *own = turn.tr_mul(own) * &turn;
                *own = 0.5 * (&*own + own.transpose());
            }
            sensors = (0..bound).collect();
        }
        8 => {
            grow(3);
            for light in 0..3 {
                let (at, mass) = (
                    sensors[draws.below(sensors.len())],
                    draws.between(0.05, 0.5),
                );
                let spring = mass * (TAU * draws.between(10.0, 100.0)).powi(2);
                let both = [
                    (at, at, 1.0),
                    (rows + light, rows + light, 1.0),
                    (at, rows + light, -1.0),
                    (rows + light, at, -1.0),
                ];
                both.iter()
                    .for_each(|(i, j, sign)| all[0][0][(*i, *j)] += sign * spring);
                all[0][1][(rows + light, rows + light)] = mass;
            }
        }
        _ => (),
    }
    (all, sensors)
}

/// The job of a test with a mistake, by matrices in so large a unit, and the sensors that are wrong.
fn tested(kind: usize, mistake: &str, seed: u64, unit: f64) -> (Files, Vec<String>) {
    let draws = &mut Draws(seed);
    let (parts, sensors) = built(draws, kind);
    let truth = parts
        .iter()
        .map(|_| (0.15 * normal(draws)).exp())
        .collect_vec();
    let real = whole(&parts, |part, which| {
        if part > 0 && which == 0 {
            truth[part]
        } else {
            1.0
        }
    });
    let real = modes(real.each_ref().map(|own| written(own, 17, false))).modes;
    let first = usize::from(kind == 4) * 3;
    let is_seen = |mode: &usize| {
        let shape = real.shapes().column(*mode);
        shape.select_rows(&sensors).amax() > 0.01 * shape.amax()
    };
    let seen = (first..real.len()).filter(is_seen).collect_vec();
    let mut shapes = real.shapes().select_rows(&sensors).select_columns(&seen);
    shapes
        .column_iter_mut()
        .for_each(|mut own| own /= own.amax());
    let far = |a: usize, b: usize| (shapes.row(a) - shapes.row(b)).amax();
    let loud = (0..sensors.len())
        .filter(|row| shapes.row(*row).amax() > 0.3)
        .collect_vec();
    let one = loud[draws.below(loud.len())];
    let other = (0..sensors.len())
        .max_by(|a, b| far(one, *a).total_cmp(&far(one, *b)))
        .unwrap();
    let times = if mistake == "noise" { 3.0 } else { 1.0 };
    let hertz = |mode: &usize| {
        real.frequencies_hz()[*mode]
            * (1.0 + times * NOISE[0] * normal(&mut Draws(seed + *mode as u64)))
    };
    let mut hertz = seen.iter().map(hertz).collect_vec();
    shapes
        .iter_mut()
        .for_each(|own| *own += times * NOISE[1] * normal(draws));
    let mut grids = sensors.clone();
    let wrong: &[usize] = match mistake {
        "reversed" => {
            shapes.row_mut(one).neg_mut();
            &[one]
        }
        "exchanged" => {
            shapes.swap_rows(one, other);
            &[one, other]
        }
        "dead" => {
            shapes
                .row_mut(one)
                .iter_mut()
                .for_each(|own| *own = NOISE[1] * normal(draws));
            &[one]
        }
        "unit" => {
            hertz.iter_mut().for_each(|own| *own *= TAU);
            &[]
        }
        "grid" => {
            grids[one] = sensors[other];
            grids[other] = sensors[one];
            &[one, other]
        }
        _ => &[],
    };
    let squares = DVector::from_iterator(seen.len(), hertz.iter().map(|own| (TAU * own).powi(2)));
    let own = grids
        .iter()
        .enumerate()
        .map(|(at, row)| sensor(format!("S{at}"), row + 1, 0, None));
    let data = TestData {
        frequency_deviation: Some(vec![NOISE[0]; seen.len()]),
        shape_deviation: Some(vec![NOISE[1]; seen.len()]),
        frequencies_hz: hertz.clone(),
        ..test_data(&Modes::new(squares, shapes).unwrap(), own)
    };
    let own = parts[1..].iter().map(|own| ("matrix", unit * &own[0]));
    let write = |own: &DMatrix<f64>| written(own, if kind == 7 { 10 } else { 17 }, false);
    (
        job(&whole(&parts, |_, _| unit), own, &data, write),
        wrong.iter().map(|at| format!("S{at}")).collect(),
    )
}

/// What is said of it.
fn told(kind: usize, mistake: &str, seed: u64, unit: f64) -> (Answer, Vec<String>) {
    let (files, wrong) = tested(kind, mistake, seed, unit);
    (answered(&files), wrong)
}

/// Right tests, so many of each structure: those with a doubt.
fn doubted(tests: u64) -> Vec<String> {
    let all =
        (0..KINDS).flat_map(|kind| (0..tests).map(move |test| (kind, 1000 * kind as u64 + test)));
    all.filter_map(|(kind, seed)| {
        let (found, _) = told(kind, "none", seed, 1.0);
        (found.status != 0).then(|| format!("{kind} {seed}: {}", found.words))
    })
    .collect()
}

/// Tests with one mistake: those that end in another status than 3, and those whose mistake is not named, or another sensor too.
fn missed(tests: u64) -> [Vec<String>; 2] {
    let mut missed = [vec![], vec![]];
    for (at, mistake) in MISTAKES.into_iter().enumerate().skip(1) {
        for test in 0..tests {
            let seed = 7000 + 100 * at as u64 + test;
            let (found, wrong) = told(seed as usize % KINDS, mistake, seed, 1.0);
            let words = format!(
                "{mistake} {seed} {wrong:?}: {} {:?} {}",
                found.status, found.doubts, found.words
            );
            let is_wrong = |own: &String| {
                wrong
                    .iter()
                    .any(|wrong| own.split('-').any(|part| part == wrong))
            };
            let mut named = found
                .doubts
                .iter()
                .filter(|own| own.contains("-S"))
                .peekable();
            let is_named = match mistake {
                "unit" => found.doubts.iter().any(|own| own == "common-factor"),
                // It is no part of the pre-flight.
                "dead" => true,
                _ => named.peek().is_some() != wrong.is_empty() && named.all(is_wrong),
            };
            if found.status != 3 {
                missed[0].push(words);
            } else if !is_named {
                missed[1].push(words);
            }
        }
    }
    missed
}

/// So many right tests, and so many with one of six mistakes: one in a hundred may be doubted, and one in twenty not be named.
fn hold(right: u64, wrong: u64) {
    let doubted = doubted(right / KINDS as u64);
    let [quiet, missed] = missed(wrong / 6);
    let most = [right / 100, 0, wrong / 20];
    for (found, most) in [doubted, quiet, missed].iter().zip(most) {
        assert!(found.len() as u64 <= most, "{}", found.join("\n"));
    }
}

#[test]
fn right_tests_raise_no_doubt_and_mistakes_are_named() {
    hold(20, 12);
}

#[test]
#[ignore = "a minute: two hundred right tests and a hundred with a mistake"]
fn two_hundred_right_tests_raise_no_doubt_and_a_hundred_mistakes_are_named() {
    hold(200, 102);
}

/// To the last bit, where the numbers change by a power of two.
#[test]
fn units_of_mass_and_force_change_no_answer() {
    for (kind, mistake) in [(2, "dead"), (5, "reversed"), (8, "none")] {
        let [one, other] = [1.0, 0.5_f64.powi(10)].map(|unit| told(kind, mistake, 1, unit).0);
        assert_eq!(
            (one.doubts, one.factors),
            (other.doubts, other.factors),
            "{kind}"
        );
    }
}

/// The objective at the end, and whether a lower place is said to be possible.
fn end(files: &Files) -> (f64, bool) {
    let found = finished(&prepared(files));
    let words = report_of(&found).verdict;
    let is_said = words.contains("lower place may exist");
    let History::GaussNewton(Some(steps)) = found.found.history else {
        panic!("stopped")
    };
    (steps.best.objective, is_said)
}

/// The law of where a job ends: at the lowest of twenty starts, or where a lower place is said to be possible.
fn ends_low(names: &[&str], drawn: impl Iterator<Item = usize>) {
    let shipped = names.iter().map(|name| files_of(name));
    let drawn = drawn.map(|seed| {
        tested(
            seed % KINDS,
            MISTAKES[seed % MISTAKES.len()],
            seed as u64,
            1.0,
        )
        .0
    });
    let all = shipped.chain(drawn);
    let paired = all.filter(|files| !prepared(files).is_without_pairs());
    for (place, files) in paired.enumerate() {
        let (one, is_said) = end(&files);
        let (many, _) = end(&comparing(files, "starts = 20"));
        assert!(is_said || one < many + 1e-3, "{place}: {one} for {many}");
    }
}

#[test]
fn a_job_ends_at_the_lowest_of_twenty_starts_or_says_that_a_lower_place_may_exist() {
    ends_low(&["box", "building", "rods"], (5..50).step_by(10));
}

#[test]
#[ignore = "a minute: every shipped job and fifty drawn ones from twenty starts"]
fn every_shipped_job_and_fifty_drawn_ones_end_at_the_lowest_of_twenty_starts() {
    let shipped = [
        "box",
        "building",
        "rods",
        "garteur",
        "garteur_joints",
        "wing",
    ];
    ends_low(&shipped, 0..50);
}
