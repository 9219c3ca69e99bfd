//! What sensors do not see does not exist: parts of the model that no sensor is on change nothing but what is said of them.

use crate::prelude::*;
use corfem::job::verdict::Outcome;

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
    let modes = lowest_modes(&real, &masses(&all), 4)
        .expect("modes")
        .vibrations;
    let mut rows = (0..count).collect_vec();
    while rows.len() > 4 {
        rows.remove(draws.below(rows.len()));
    }
    let sensors = rows.iter().map(|row| Sensor {
        name: format!("S{row}"),
        grid: Some(row + 1),
        direction: 0,
        axis: None,
        place: None,
    });
    let test = TestData {
        frequencies_hz: modes.frequencies_hz(),
        sensors: sensors.collect(),
        shapes: modes.shapes().select_rows(&rows),
        ..TestData::default()
    };
    Chain {
        springs: springs_of,
        masses: all,
        test,
    }
}

/// Springs and masses of a block of rows.
pub type Block = (Vec<(usize, Option<usize>, f64)>, Vec<f64>);

/// An uncoupled block: any chain, the model again with all its roots, rows of a boundary, or rows with a root of the model's.
fn block(draws: &mut Draws, chain: &Chain, kind: usize) -> Block {
    let count = 1 + draws.below(20);
    let own_root = || {
        let stiffness = springs(chain.masses.len(), &chain.springs);
        let modes = lowest_modes(&stiffness, &masses(&chain.masses), 3).expect("modes");
        modes.vibrations.omega_squared()[2]
    };
    match kind {
        0 => {
            let spring = |row: usize| {
                (
                    row,
                    row.checked_sub(1),
                    10_f64.powf(draws.between(1.0, 8.0)),
                )
            };
            (
                (0..count).map(spring).collect(),
                (0..count).map(|row| 1.0 + row as f64 / 9.0).collect(),
            )
        }
        1 => (chain.springs.clone(), chain.masses.clone()),
        2 => (
            (0..count).map(|row| (row, None, 1.0)).collect(),
            vec![1.0; count],
        ),
        _ => {
            let root = own_root();
            (
                (0..count).map(|row| (row, None, 2.0 * root)).collect(),
                vec![2.0; count],
            )
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
    let own_springs = chain
        .springs
        .iter()
        .map(|spring| place(spring, 0))
        .collect_vec();
    let mut all = more.iter().map(|spring| place(spring, own)).collect_vec();
    all.extend(&own_springs);
    if link > 0.0 && added > 0 {
        all.push((at(0), Some(at(own)), link));
    }
    let mut mass = vec![0.0; count];
    (0..own).for_each(|row| mass[at(row)] = chain.masses[row]);
    (0..added).for_each(|row| mass[at(own + row)] = heavy[row]);
    let label = |row: usize| match order.iter().position(|&place| place == row) {
        Some(row) if row < own => format!("{},x\n", row + 1),
        Some(row) => format!("{},y\n", 100 + row),
        None => String::new(),
    };
    let part = |kind: usize| {
        let own = own_springs.iter().enumerate();
        let own = own
            .filter(|(row, _)| row % 3 == kind)
            .map(|(_, spring)| *spring);
        write_matrix_market(&springs(count, &own.collect_vec()))
    };
    let mut job = "[model]\nstiffness = \"k.mtx\"\nmass = \"m.mtx\"\nrows = \"rows.csv\"\n[test]\nfile = \"test.csv\"\n\
                   [compare]\nfrequency_deviation = 0.001\nshape_deviation = 0.01\nprior_deviation = 10.0\n"
        .to_owned();
    for name in ["p0", "p1", "p2"] {
        job += &format!("[[parameter]]\nname = \"{name}\"\nmatrix = \"{name}.mtx\"\n");
    }
    let texts = [
        ("job.toml", job),
        ("k.mtx", write_matrix_market(&springs(count, &all))),
        ("m.mtx", write_matrix_market(&masses(&mass))),
        ("rows.csv", (0..count).map(label).collect()),
        ("test.csv", write_csv(&chain.test)),
        ("p0.mtx", part(0)),
        ("p1.mtx", part(1)),
        ("p2.mtx", part(2)),
    ];
    texts.map(|(name, text)| (name.to_owned(), text)).to_vec()
}

fn result(files: &Files) -> JobResult {
    let loaded = prepared(files);
    finished(&loaded)
}

/// Everything said but of the mass and of what is not seen.
fn said(result: &JobResult) -> Vec<(String, String)> {
    use Kind::*;
    let of_all = [
        Mass,
        MassByDirection,
        CenterOfMass,
        PartsWithoutSensor,
        LooseWithoutSensor,
        UnseenModes,
        ChiSquared,
    ];
    let all = result.trust.all().iter();
    let all = all.filter(|concern| !of_all.contains(&concern.kind));
    all.map(|concern| (concern.identifier(), concern.words()))
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
        let mut draws = Draws(seed);
        let chain = chain(&mut draws);
        let more = block(&mut draws, &chain, kind);
        let alone = result(&files(&chain, &Default::default(), 0.0, &mut draws));
        let beside = result(&files(&chain, &more, 0.0, &mut draws));
        for (one, other) in alone.found.factors.iter().zip(&beside.found.factors) {
            prop_assert!(relative_error(one, other) < SAME, "{one} {other}");
        }
        prop_assert_eq!(said(&alone), said(&beside));
        prop_assert_eq!(alone.verdict.outcome, beside.verdict.outcome);
        prop_assert_eq!(alone.intervals.len(), beside.intervals.len());
        for (one, other) in alone.intervals.iter().zip(&beside.intervals) {
            let ends = |range: &corfem::method::step::Bounds| [range.lower, range.upper];
            let both = [one, other].map(|range| range.as_ref().map(ends));
            prop_assert_eq!(both[0].is_ok(), both[1].is_ok());
            for (one, other) in both[0].into_iter().flatten().zip(both[1].into_iter().flatten()) {
                prop_assert!(relative_error(one, other) < SAME, "{one} {other}");
            }
        }
        let left = beside.trust.of(Kind::PartsWithoutSensor).next();
        prop_assert!(left.is_some_and(|left: &Concern| left.measure == [more.1.len() as f64]));
    }

    #[test]
    fn a_block_on_a_link_of_next_to_nothing_changes_next_to_nothing(
        (seed, kind) in (any::<u64>(), prop::sample::select(vec![0, 2])),
    ) {
        let mut draws = Draws(seed);
        let chain = chain(&mut draws);
        let more = block(&mut draws, &chain, kind);
        let alone = result(&files(&chain, &Default::default(), 0.0, &mut draws));
        let beside = result(&files(&chain, &more, 1e-8, &mut draws));
        prop_assert_eq!(alone.verdict.is_within, beside.verdict.is_within);
        // Where steps end short of a minimum is a matter of the last digit.
        let is_short = |job: &JobResult| matches!(job.verdict.outcome, Outcome::Wall | Outcome::Short);
        if is_short(&alone) || is_short(&beside) {
            return Ok(());
        }
        prop_assert_eq!(alone.verdict.outcome, beside.verdict.outcome);
        let both = alone.found.factors.iter().zip(&beside.found.factors);
        for ((one, other), deviation) in both.zip(&alone.seen.deviations) {
            // A factor that the test hardly sees is as free as its deviation says.
            let moved = (one / other).ln().abs();
            prop_assert!(moved < f64::max(1e-6, 1e-4 * deviation), "{one} {other} {deviation}");
        }
    }
}

/// A pencil of two equal chains side by side, each mode of which the sensors on one of them see in one of two copies.
#[test]
fn of_equal_roots_as_few_as_possible_are_seen() {
    let row = |first: usize| {
        (0..6_usize).map(move |row| (first + row, row.checked_sub(1).map(|row| first + row), 1e4))
    };
    let links = [(0, Some(6), 1e-9)];
    let stiffness = springs(12, &row(0).chain(row(6)).chain(links).collect_vec());
    let model = WholeModel::new(stiffness, masses(&[1.0; 12]), Vec::new()).expect("a model");
    let sensors =
        SparseMatrix::new("sensors", 2, 12, vec![(0, 2, 1.0), (1, 5, 1.0)]).expect("sensors");
    let test = lowest_modes(&springs(6, &row(0).collect_vec()), &masses(&[1.0; 6]), 4)
        .expect("modes")
        .vibrations;
    let seen = crate::common::whole_models::seen_by(
        &SparseMatrix::new("sensors", 2, 6, vec![(0, 2, 1.0), (1, 5, 1.0)]).expect("sensors"),
        &test,
    );
    let size = BasisSize {
        modes: 4,
        residual_vectors: 0,
    };
    let found = model
        .analyze(
            &[],
            &sensors,
            &seen,
            corfem::sparse::Pair::by(|of| pair_modes(of.cross)),
            size,
        )
        .expect("an analysis");
    for mode in 0..4 {
        let (one, other) = (found.omega_squared()[mode], test.omega_squared()[mode]);
        assert!(relative_error(one, other) < 1e-6, "{mode}: {one} {other}");
    }
}
