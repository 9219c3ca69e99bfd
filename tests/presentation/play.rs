//! The figure to play with: its script is short and needs nothing, and what it solves in the page is what the program solves.

use crate::prelude::*;
use crate::presentation::figures::results;
use corfem::present::compared::matrix_rows;

/// A case's first pass as HTML with its script and data, to stand in any page.
///
/// The script holds the panels' shares $V^t B K_e B^t V$ (9 × 9, lower triangles), and finds modes, pairs and errors from them as
/// the program does, by Jacobi rotations.
///
/// # Errors
/// The errors of the case's model and its analysis.
fn play(result: &CaseResult) -> Result<String, PresentError> {
    let pass = &result.correlation.passes[0];
    let (case, test) = (&result.case, &result.test);
    let ones = vec![1.0; result.parameter_names.len()];
    let first = case.model()?.analyze(&ones, test, None)?;
    let rows = matrix_rows;
    let triangle = |matrix: &DMatrix<f64>| -> Vec<f64> {
        (0..matrix.nrows())
            .flat_map(|i| (0..=i).map(move |j| matrix[(i, j)]))
            .collect()
    };
    let shares = first.shares().iter().map(triangle);
    let steps = pass.inner.iterations.iter().map(|step| &step.gage_factors);
    let mils = 1000.0 * case.first_gages().first().copied().unwrap_or(TEST_GAGE);
    let modes = &first.exact().modes;
    let data = json!({
        "squares": modes.omega_squared().as_slice(),
        "shares": shares.collect::<Vec<_>>(),
        "shapes": rows(modes.shapes()),
        "test": rows(test.shapes()),
        "hertz": test.frequencies_hz(),
        "masses": case.reconstruction.masses,
        "steps": std::iter::once(&ones).chain(steps).collect::<Vec<_>>(),
        "mils": mils,
        "truth": 1000.0 * TEST_GAGE,
        "exact": pass.check.errors.sum(),
        "least": LEAST_SHARE,
    });
    Ok([
        include_str!("../../paper/presentation/page/play.html"),
        "<script>\nconst DATA = ",
        &data.to_string(),
        ";\n",
        include_str!("../../paper/presentation/page/play.js"),
        "</script>\n",
    ]
    .concat())
}

fn html() -> String {
    play(&results()[1]).unwrap()
}

fn script(html: &str) -> &str {
    let (_, rest) = html.split_once("<script>").unwrap();
    rest.split_once("</script>").unwrap().0
}

/// The JSON that a program writes in node.
pub fn by_node(program: &str) -> Value {
    let output = Command::new("node").args(["-e", program]).output().unwrap();
    let words = String::from_utf8_lossy(&output.stderr);
    serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{error}: {words}"))
}

/// Chapter 6 of the tour has the same figure, with data of its own.
#[test]
fn data_of_the_tour_are_those_of_the_report() {
    let path = in_root("paper/tour/06_play.js");
    let html = html();
    let data = html.lines().find(|line| line.starts_with("const DATA = "));
    let data = data.unwrap().to_owned() + "\n";
    if std::env::var("CORFEM_WRITE").is_ok_and(|value| value == "1") {
        fs::write(&path, &data).unwrap();
    }
    let stored = fs::read_to_string(&path).unwrap();
    assert!(
        Numbers::DRAWN.agree(&stored, &data),
        "CORFEM_WRITE=1 writes it anew"
    );
}

/// Node runs the script as it stands in the page; every number that a reader can see along the thirty steps, and at gages dragged by
/// hand, is the program's.
#[test]
#[ignore = "needs node"]
fn node_solves_the_pages_modes_as_the_program_does() {
    let result = &results()[1];
    let modal = result
        .case
        .model()
        .unwrap()
        .analyze(&[1.0; 15], &result.test, None)
        .unwrap();
    let steps = &result.correlation.passes[0].inner.iterations;
    let mut draws = Draws(30);
    let dragged: Vec<Vec<f64>> = (0..40)
        .map(|_| (0..15).map(|_| draws.between(0.27, 1.2)).collect())
        .collect();
    let folder = new_folder();
    let path = folder.path().join("play.js");
    fs::write(&path, script(&html())).unwrap();
    let program = format!(
        "const page = require({}), dragged = {};\
         console.log(JSON.stringify({{ ...page.histories, dragged: dragged.map((gages, at) => page.at(at % 31, gages, at % 2 === 0)) }}))",
        json!(path),
        json!(dragged)
    );
    let found = by_node(&program);
    let mut compared = 0;
    let mut compare = |found: &Value, state: &State, what: &str| {
        let paired = state.pairing.paired(&state.modes).unwrap();
        let errors = [state.errors.frequency, state.errors.shape];
        let expected = paired.frequencies_hz().into_iter().chain(errors);
        let read = found["hertz"].as_array().unwrap().iter();
        let read: Vec<f64> = read
            .chain([&found["frequency"], &found["shape"]])
            .map(|number| number.as_f64().unwrap())
            .collect();
        assert_eq!(read.len(), 11);
        for (number, (read, expected)) in read.into_iter().zip(expected).enumerate() {
            let off = (read - expected).abs() / expected.abs().max(1.0);
            assert!(
                off < PLAYED,
                "{what}, number {number}: {read} for {expected}"
            );
            compared += 1;
        }
    };
    let by_gages = |gages: &[f64]| exact_state(&modal, gages).unwrap();
    // The stiffness on which the loop stands after every step, and that of its gages.
    let ones = vec![1.0; 15];
    let (mut stiffness, mut before) = (vec![ones.clone()], &ones);
    let add = |shares: &[f64], from: &[f64], to: &[f64]| -> Vec<f64> {
        let ends = shares.iter().zip(from).zip(to);
        ends.map(|((share, from), to)| next_share_factor(*share, *from, *to))
            .collect()
    };
    assert_eq!(found["adds"].as_array().map(Vec::len), Some(31));
    for (at, step) in steps.iter().enumerate() {
        let last = add(&stiffness[at], before, &step.gage_factors);
        let state = by_gages(&last);
        assert_within(state.errors.sum(), step.errors.sum(), PLAYED);
        compare(&found["adds"][at + 1], &state, &format!("step {}", at + 1));
        let follows = by_gages(&step.gage_factors);
        compare(
            &found["follows"][at + 1],
            &follows,
            &format!("gages of step {}", at + 1),
        );
        stiffness.push(last);
        before = &step.gage_factors;
    }
    let at_step = |step: usize| {
        step.checked_sub(1)
            .map_or(&ones, |row| &steps[row].gage_factors)
    };
    for (at, gages) in dragged.iter().enumerate() {
        let step = at % 31;
        let shares = if at % 2 == 0 {
            add(&stiffness[step], at_step(step), gages)
        } else {
            gages.clone()
        };
        compare(
            &found["dragged"][at],
            &by_gages(&shares),
            &format!("dragged {at}"),
        );
    }
    assert_eq!(compared, 11 * (60 + dragged.len()));
}
