//! The figure to play with, in the report and in chapter 6 of the tour: what its script solves in the page is what the program solves.

use crate::prelude::*;
use crate::presentation::figures::results;
use corfem::present::compared::matrix_rows;

/// The data of Case 2's first pass. The script holds the panels' shares $V^t B K_e B^t V$ (9 × 9, lower triangles), and finds modes, pairs
/// and errors from them as the program does, by Jacobi rotations.
fn data() -> Value {
    let CaseResult {
        case,
        test,
        correlation,
        ..
    } = &results()[1];
    let pass = &correlation.passes[0];
    let ones = vec![1.0; PANEL_COUNT];
    let first = case.model().unwrap().analyze(&ones, test, None).unwrap();
    let triangle = |matrix: &DMatrix<f64>| {
        let row = |i| (0..=i).map(move |j| matrix[(i, j)]);
        (0..matrix.nrows()).flat_map(row).collect_vec()
    };
    let steps = pass.inner.iterations.iter().map(|step| &step.gage_factors);
    let modes = &first.exact().modes;
    json!({
        "squares": modes.omega_squared().as_slice(),
        "shares": first.shares().iter().map(triangle).collect_vec(),
        "shapes": matrix_rows(modes.shapes()),
        "test": matrix_rows(test.shapes()),
        "hertz": test.frequencies_hz(),
        "masses": case.reconstruction.masses,
        "steps": once(&ones).chain(steps).collect_vec(),
        "mils": 1000.0 * case.first_gages()[0],
        "truth": 1000.0 * TEST_GAGE,
        "exact": pass.check.errors.sum(),
        "least": LEAST_SHARE,
    })
}

#[test]
fn data_of_the_tour_are_those_of_the_report() {
    let data = format!("const DATA = {};\n", data());
    let stored = on_file("paper/tour/06_play.js", &data);
    assert!(
        Numbers::DRAWN.agree(&stored, &data),
        "CORFEM_WRITE=1 writes it anew"
    );
}

/// Every number that a reader can see along the thirty steps, by both curves.
#[test]
#[ignore = "needs node"]
fn node_solves_the_pages_modes_as_the_program_does() {
    let result = &results()[1];
    let steps = &result.correlation.passes[0].inner.iterations;
    let ones = [1.0; PANEL_COUNT];
    let model = result.case.model().unwrap();
    let modal = model.analyze(&ones, &result.test, None).unwrap();
    let script = include_str!("../../paper/presentation/page/play.js");
    let program = format!(
        "const DATA = {};\n{script}\nconsole.log(JSON.stringify(module.exports.histories))",
        data()
    );
    let output = Command::new("node")
        .args(["-e", &program])
        .output()
        .unwrap();
    let words = String::from_utf8_lossy(&output.stderr);
    let found: Value =
        serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{error}: {words}"));
    // The stiffness on which the loop stands after every step, and that of its gages.
    let (mut stiffness, mut before) = (ones.to_vec(), &ones[..]);
    for (step, at) in steps.iter().zip(1..) {
        for (e, share) in stiffness.iter_mut().enumerate() {
            *share = next_share_factor(*share, before[e], step.gage_factors[e]);
        }
        before = &step.gage_factors;
        for (curve, shares) in [("adds", &stiffness), ("follows", &step.gage_factors)] {
            let state = exact_state(&modal, shares).unwrap();
            let paired = state.pairing.paired(&state.modes).unwrap();
            let here = &found[curve][at];
            let read = here["hertz"].as_array().unwrap().iter();
            let read = read.chain([&here["frequency"], &here["shape"]]);
            let read = read.map(|number| number.as_f64().unwrap()).collect_vec();
            let mut expected = paired.frequencies_hz();
            expected.extend([state.errors.frequency, state.errors.shape]);
            assert_eq!(read.len(), expected.len());
            for (read, expected) in read.into_iter().zip(expected) {
                assert_within(read, expected, PLAYED * expected.max(1.0));
            }
        }
    }
}
