//! Test modes closer than their deviations tell: what is compared is the subspace of their shapes.

use crate::prelude::*;

/// Two towers of three floors side by side, one stiffer than the other by `split`, and a test of both in which every pair of modes is
/// turned by an angle (radians) and its stiffer tower is stiffer by `truth`.
fn towers([split, truth, angle]: [f64; 3]) -> Files {
    let tower = |stiffness: f64, first: usize, text: &mut String| {
        for floor in 0..3 {
            let (row, below) = (first + floor + 1, first + floor);
            let diagonal = if floor == 2 {
                stiffness
            } else {
                2.0 * stiffness
            };
            *text += &format!("{row} {row} {diagonal:e}\n");
            if floor > 0 {
                *text += &format!("{row} {below} {:e}\n", -stiffness);
            }
        }
    };
    let market = "%%MatrixMarket matrix coordinate real symmetric\n6 6 ";
    let (mut all, mut left, mut right) = (
        format!("{market}10\n"),
        format!("{market}5\n"),
        format!("{market}5\n"),
    );
    for text in [&mut all, &mut left] {
        tower(1e5, 0, text);
    }
    for text in [&mut all, &mut right] {
        tower(1e5 * split, 3, text);
    }
    let mass = format!(
        "{market}6\n{}",
        (1..=6)
            .map(|row| format!("{row} {row} 50\n"))
            .collect::<String>()
    );
    // Roots and shapes of a fixed and free chain of three.
    let (mut hertz, mut shapes) = (Vec::new(), zero_square(6));
    for mode in 0..3 {
        let phase = PI * (2 * mode + 1) as f64 / 7.0;
        let frequency = (2e3_f64 * (2.0 - 2.0 * phase.cos())).sqrt() / TAU;
        hertz.extend([frequency, frequency * truth.sqrt()]);
        for floor in 0..3 {
            let moved = (phase * (floor + 1) as f64).sin();
            let (sine, cosine) = angle.sin_cos();
            shapes[(floor, 2 * mode)] = cosine * moved;
            shapes[(floor + 3, 2 * mode)] = sine * moved;
            shapes[(floor, 2 * mode + 1)] = -sine * moved;
            shapes[(floor + 3, 2 * mode + 1)] = cosine * moved;
        }
    }
    let sensors = (1..=6).map(|grid| Sensor {
        name: grid.to_string(),
        grid: Some(grid),
        direction: 0,
        axis: None,
        place: None,
    });
    let data = TestData {
        frequencies_hz: hertz,
        sensors: sensors.collect(),
        shapes,
        ..TestData::default()
    };
    let parameter =
        |name: &str| format!("[[parameter]]\nname = \"{name}\"\nmatrix = \"{name}.mtx\"\n");
    let job = "[model]\nstiffness = \"all.mtx\"\nmass = \"mass.mtx\"\nrows = \"rows.csv\"\n[test]\nfile = \"test.csv\"\n";
    let files = [
        (
            "job.toml",
            [job, &parameter("left"), &parameter("right")].concat(),
        ),
        ("all.mtx", all),
        ("mass.mtx", mass),
        ("left.mtx", left),
        ("right.mtx", right),
        (
            "rows.csv",
            (1..=6).map(|row| format!("{row},x\n")).collect(),
        ),
        ("test.csv", write_csv(&data)),
    ];
    files.map(|(name, text)| (name.to_owned(), text)).to_vec()
}

fn corrected(files: &Files) -> (PreparedJob, JobResult) {
    let loaded = prepared(files);
    let result = finished(&loaded);
    (loaded, result)
}

#[test]
fn turned_shapes_of_close_modes_are_no_error() {
    // Equal in the model or a little apart; in the test apart by half the least that it tells.
    for (split, angle) in [(1.0, 0.6), (1.0, 0.785), (1.002, -0.4)] {
        let (loaded, result) = corrected(&towers([split, 1.014, angle]));
        assert_eq!(loaded.together(), [vec![0, 1], vec![2, 3], vec![4, 5]]);
        assert!(!result.trust.has_doubt(), "{:?}", result.trust);
        let mut close = result.trust.of(Kind::CloseModes);
        let named = close.any(|concern| concern.identifier() == "close-modes-3-4");
        assert!(named && result.trust.is_clear());
        assert_eq!(result.verdict.outcome, Outcome::Tolerance);
        // Turned shapes leave nothing: every factor follows the frequencies of both towers.
        assert!(
            result
                .found
                .factors
                .iter()
                .all(|factor| (factor - 1.007).abs() < 0.01),
            "{:?}",
            result.found.factors
        );
        let report = Report::from_job(&loaded, Some(&result)).unwrap();
        let agreement = report.agreement(report.corrected()).unwrap();
        for (mode, &partner) in report.corrected().pairing.analysis_mode.iter().enumerate() {
            assert!(
                agreement.assurance[(partner, mode)] > 1.0 - 1e-9,
                "mode {mode}"
            );
        }
        assert!(paired_table(&report).is_ok());
        assert!(result.misfit.chi_squared < 1.0);
    }
}

/// Two towers that are equal in the model begin as one subspace, for no shape of theirs is their own; once they have parted they are
/// compared one by one.
#[test]
fn modes_that_model_and_test_tell_apart_are_compared_alone() {
    let (loaded, result) = corrected(&towers([1.0, 1.2, 0.0]));
    assert_eq!(loaded.together().len(), 3);
    assert_eq!(
        result.found.prepared.together(),
        (0..6).map(|mode| vec![mode]).collect_vec()
    );
    let factors = &result.found.factors;
    assert!((factors[1] / factors[0] - 1.2).abs() < 1e-3, "{factors:?}");
}

/// A ring of six masses has two shapes at each of two roots, and its parameters leave it a ring: a test that has one of the two may have
/// any of their combinations.
#[test]
fn one_mode_of_a_double_root_is_compared_with_the_whole_of_it() {
    let ring = DMatrix::from_fn(6, 6, |a, b| match (a + 6 - b) % 6 {
        0 => 6e4,
        1 | 5 => -3e4,
        _ => 0.0,
    });
    let (parts, mass) = (
        [ring, 1e4 * DMatrix::identity(6, 6)],
        DMatrix::identity(6, 6),
    );
    let truth = [1.12, 0.9];
    let all = solve(&(truth[0] * &parts[0] + truth[1] * &parts[1]), &mass, 6).unwrap();
    for angle in [0.3_f64, 1.0, 2.2] {
        let mix = |first: usize| {
            let both = all.shapes().columns(first, 2);
            both * dvector![angle.cos(), angle.sin()]
        };
        let shapes = DMatrix::from_columns(&[all.shapes().column(0).into_owned(), mix(1), mix(3)]);
        let squares = all.omega_squared();
        let test = Modes::new(dvector![squares[0], squares[1], squares[3]], shapes).unwrap();
        let (loaded, result) = corrected(&of_matrices(&parts, &mass, &test));
        assert!(!result.trust.has_doubt(), "{:?}", result.trust);
        // What is left is the pull of the prior.
        assert!(
            result.misfit.chi_squared < 1e-3,
            "{}",
            result.misfit.chi_squared
        );
        let report = Report::from_job(&loaded, Some(&result)).unwrap();
        let (shown, agreement) = (
            report.corrected(),
            report.agreement(report.corrected()).unwrap(),
        );
        for (mode, &partner) in shown.pairing.analysis_mode.iter().enumerate() {
            assert!(agreement.assurance[(partner, mode)] > 1.0 - 1e-9);
        }
        for (factor, truth) in result.found.factors.iter().zip(truth) {
            assert!((factor / truth - 1.0).abs() < 1e-3, "{factor} {truth}");
        }
    }
}
