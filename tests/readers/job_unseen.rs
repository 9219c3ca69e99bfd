//! What sensors do not see does not exist: parts of the model that no sensor is on change nothing but what is said of them.

use super::job_lists::named;
use crate::common::jobs::{add_parameter, matrix_job, measured_at, of_whole};
use crate::prelude::*;
use corfem::job::LoadedJob;

/// A chain whose springs are three parameters, held at one end, with an exact test of its lowest modes at four masses.
pub struct Chain {
    springs: Vec<(usize, Option<usize>, f64)>,
    masses: Vec<f64>,
    test: TestData,
}

pub fn chain(draws: &mut Draws) -> Chain {
    let count = 6 + draws.below(8);
    let size = |draws: &mut Draws| 10_f64.powf(draws.between(4.0, 5.0));
    let springs_of = (0..count)
        .map(|row: usize| (row, row.checked_sub(1), size(draws)))
        .collect_vec();
    let all = (0..count).map(|_| draws.between(1.0, 3.0)).collect_vec();
    let truth = [0.8, 1.1, 0.9];
    let real = springs_of
        .iter()
        .map(|&(row, other, size)| (row, other, truth[row % 3] * size));
    let real = springs(count, &real.collect_vec());
    let modes = lowest_modes(&real, &masses(&all), 4).unwrap().vibrations;
    let mut rows = (0..count).collect_vec();
    while rows.len() > 4 {
        rows.remove(draws.below(rows.len()));
    }
    Chain {
        springs: springs_of,
        masses: all,
        test: measured_at(&modes, &rows),
    }
}

/// Springs and masses of a block of rows.
pub type Block = (Vec<(usize, Option<usize>, f64)>, Vec<f64>);

/// An uncoupled block: any chain, the model again with all its roots, rows of a boundary, or rows with a root of the model's.
fn block(draws: &mut Draws, chain: &Chain, kind: usize) -> Block {
    let count = 1 + draws.below(20);
    let alone = |spring: f64| (0..count).map(|row| (row, None, spring)).collect_vec();
    match kind {
        0 => {
            let mut size = || 10_f64.powf(draws.between(1.0, 8.0));
            let row = |row: usize| (row, row.checked_sub(1), size());
            let mass = |row| 1.0 + row as f64 / 9.0;
            (
                (0..count).map(row).collect(),
                (0..count).map(mass).collect(),
            )
        }
        1 => (chain.springs.clone(), chain.masses.clone()),
        2 => (alone(1.0), vec![1.0; count]),
        _ => {
            let stiffness = springs(chain.masses.len(), &chain.springs);
            let modes = lowest_modes(&stiffness, &masses(&chain.masses), 3).unwrap();
            let root = modes.vibrations.omega_squared()[2];
            (alone(2.0 * root), vec![2.0; count])
        }
    }
}

/// The job of a chain with more rows behind its own, in an order.
pub fn files(chain: &Chain, (more, heavy): &Block, link: f64, draws: &mut Draws) -> Files {
    let (own, added) = (chain.masses.len(), heavy.len());
    let count = own + added;
    let mut order = (0..count).collect_vec();
    // Rows of both are mixed, each in its own order.
    if added > 0 {
        let mut rows = (0..count).collect_vec();
        let mut first = (0..own)
            .map(|_| rows.remove(draws.below(rows.len())))
            .collect_vec();
        first.sort_unstable();
        order = [first, rows].concat();
    }
    let at = |row: usize| order[row];
    let place = |&(row, other, size): &(usize, Option<usize>, f64), first: usize| {
        (at(first + row), other.map(|other| at(first + other)), size)
    };
    let own_springs = chain.springs.iter().map(|spring| place(spring, 0));
    let own_springs = own_springs.collect_vec();
    let mut all = more.iter().map(|spring| place(spring, own)).collect_vec();
    all.extend(&own_springs);
    if link > 0.0 && added > 0 {
        all.push((at(0), Some(at(own)), link));
    }
    let mut mass = vec![0.0; count];
    let heavy = chain.masses.iter().chain(heavy).enumerate();
    heavy.for_each(|(row, own)| mass[at(row)] = *own);
    let label = |row: usize| match order.iter().position(|&place| place == row) {
        Some(row) if row < own => format!("{},x\n", row + 1),
        Some(row) => format!("{},y\n", 100 + row),
        None => String::new(),
    };
    let model = [&springs(count, &all), &masses(&mass)];
    let mut files = matrix_job(model, (0..count).map(label), &chain.test);
    for kind in 0..3 {
        let part = own_springs.iter().skip(kind).step_by(3).copied();
        let part = springs(count, &part.collect_vec());
        add_parameter(&mut files, &format!("p{kind}"), &part, "");
    }
    comparing(
        files,
        "frequency_deviation = 0.001\nshape_deviation = 0.01\nprior_deviation = 10.0",
    )
}

fn result(files: &Files) -> JobResult {
    finished(&prepared(files))
}

/// What comes of a chain drawn with a seed, alone and with a block of a kind on a link, and the rows of the block.
fn alone_and_beside(seed: u64, kind: usize, link: f64) -> ([JobResult; 2], usize) {
    let mut draws = Draws(seed);
    let chain = chain(&mut draws);
    let more = block(&mut draws, &chain, kind);
    let alone = files(&chain, &Default::default(), 0.0, &mut draws);
    let beside = files(&chain, &more, link, &mut draws);
    ([alone, beside].map(|files| result(&files)), more.1.len())
}

/// Everything said but of what is not seen.
fn said(result: &JobResult) -> Vec<(String, String)> {
    let unseen = [
        "parts-without-sensor",
        "loose-without-sensor",
        "unseen-modes",
    ];
    let all = result.trust.all().iter();
    let all = all.filter(|own| !unseen.contains(&&own.identifier[..]));
    all.map(|own| (own.identifier.clone(), own.words.clone()))
        .collect()
}

/// Largest difference of two answers that must be one.
const SAME: f64 = 1e-8;

properties! {
    #![proptest_config(crate::common::costly_config())]

    #[test]
    fn an_uncoupled_block_changes_nothing_but_what_is_said_of_it(
        (seed, kind) in (any::<u64>(), 0..4_usize),
    ) {
        let ([alone, beside], rows) = alone_and_beside(seed, kind, 0.0);
        for (one, other) in alone.found.factors.iter().zip(&beside.found.factors) {
            prop_assert!(relative_error(one, other) < SAME, "{one} {other}");
        }
        prop_assert_eq!(said(&alone), said(&beside));
        prop_assert_eq!(alone.verdict.end, beside.verdict.end);
        prop_assert_eq!(alone.intervals.len(), beside.intervals.len());
        for (one, other) in alone.intervals.iter().zip(&beside.intervals) {
            prop_assert_eq!(one.is_ok(), other.is_ok());
            if let (Ok(one), Ok(other)) = (one, other) {
                let apart = relative_error(one.lower, other.lower).max(relative_error(one.upper, other.upper));
                prop_assert!(apart < SAME, "{one:?} {other:?}");
            }
        }
        prop_assert_eq!(about(&beside.trust, "parts-without-sensor").len(), rows);
    }

    #[test]
    fn a_block_on_a_link_of_next_to_nothing_changes_next_to_nothing(
        (seed, kind) in (any::<u64>(), prop::sample::select(vec![0, 2])),
    ) {
        let ([alone, beside], _) = alone_and_beside(seed, kind, 1e-8);
        prop_assert_eq!(alone.verdict.is_within, beside.verdict.is_within);
        // Where steps end short of a minimum is a matter of the last digit.
        let is_short = |job: &JobResult| job.verdict.end == End::Short;
        if is_short(&alone) || is_short(&beside) {
            return Ok(());
        }
        prop_assert_eq!(alone.verdict.end, beside.verdict.end);
        let both = alone.found.factors.iter().zip(&beside.found.factors);
        for ((one, other), deviation) in both.zip(&alone.seen.deviations) {
            // A factor that the test hardly sees is as free as its deviation says.
            let moved = (one / other).ln().abs();
            prop_assert!(moved < f64::max(1e-6, 1e-4 * deviation), "{one} {other} {deviation}");
        }
    }
}

/// The law: a job of its own corrected matrices has K(s) and M(s), parts that no sensor sees among them: bit for bit in the format of the
/// Matrix Market, to the last digit of a field as DMIG.
#[test]
fn corrected_matrices_read_back_as_those_at_the_factors() {
    for seed in 0..6 {
        let mut draws = Draws(seed);
        let unseen = (vec![(0, None, 1e6), (1, Some(0), 1e6)], vec![1.0, 2.0]);
        let (mut job, within) = match seed % 2 {
            0 => (files(&chain(&mut draws), &unseen, 0.0, &mut draws), 0.0),
            _ => (named(), FIELD_ROUNDING),
        };
        let load = |job: &Files| {
            let (_folder, path) = placed(job);
            LoadedJob::new(&path).unwrap()
        };
        let first = load(&job);
        let factors = first
            .parameter_names()
            .map(|_| draws.between(0.5, 2.0))
            .collect_vec();
        let (stiffness, mass) = first.source.all.at(&factors).unwrap();
        for (name, bytes) in first.corrected_model(&factors).unwrap() {
            job.retain(|own| own.0 != name);
            job.push((name, String::from_utf8(bytes).unwrap()));
        }
        let text = file(&mut job, "job.toml");
        *text = text
            .replace("model.pch#KAAX", "stiffness.pch")
            .replace("model.pch#MAAX", "mass.pch");
        let again = load(&job).source.all.at(&vec![1.0; factors.len()]).unwrap();
        for (read, wanted) in [(again.0, stiffness), (again.1, mass)] {
            let (read, wanted) = (read.dense(), wanted.dense());
            assert_eq!(read.shape(), wanted.shape());
            for (read, wanted) in read.iter().zip(&wanted) {
                assert!((read - wanted).abs() <= within * wanted.abs(), "{read}");
            }
        }
    }
}

/// The middle of three masses between two walls stands still in their second mode, of ω² = 2 k/m.
#[test]
fn a_mode_that_no_sensor_sees_is_named_by_its_frequency_in_hertz() {
    let stiffness = springs(
        3,
        &[
            (0, None, 1e6),
            (1, Some(0), 1e6),
            (2, Some(1), 1e6),
            (2, None, 1e6),
        ],
    );
    let parts = vec![whole_parameter(0, WholeShare::Stiffness(stiffness.clone()))];
    let model = WholeModel::new(stiffness, masses(&[1.0; 3]), parts).unwrap();
    let job = prepared(&of_whole(&model, &[1.1], &[1], 1, DEVIATIONS));
    assert_eq!(about(&trust_in(&job), "unseen-modes"), ["225.0791"]);
}
