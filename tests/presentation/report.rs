//! The report of a job: every view says the same, a terminal has room for it, and no name breaks its page.

use crate::common::jobs::unbroken;
use crate::prelude::*;
use corfem::job::concern::Check;
use corfem::job::of_bodies;
use corfem::present::page::report_page;
use corfem::present::render::WIDTH;
use corfem::present::report::{facts, places};
use corfem::present::table::separated;
use corfem::sparse::BodyFinding;
use std::sync::Arc;

/// Text, CSV, JSON and page are views of one value.
#[test]
fn every_view_tells_the_same_factors_and_errors() {
    for name in ["box", "building", "wing"] {
        let report = report_of(worked(name));
        let document = serde_json::to_value(&report).unwrap();
        let (plain, page) = (text(&report.brief()), report_page(&report).unwrap());
        let rows = separated(&report.parameters);
        let mut rows = csv::Reader::from_reader(rows.as_bytes());
        let rows: Vec<BTreeMap<String, String>> = rows.deserialize().map(Result::unwrap).collect();
        assert_eq!(document["answer"], report.answer);
        assert!(unbroken(&plain).starts_with(&report.answer), "{plain}");
        for (e, own) in report.parameters.iter().enumerate() {
            assert_eq!(document["parameters"][e]["factor"], own.factor);
            assert_eq!(rows[e]["factor"].parse(), Ok(own.factor));
            let four = Digits::Fixed(4).write(own.factor);
            let mut lines = plain.lines().skip_while(|line| !line.is_empty());
            let line = lines.find(|line| line.starts_with(&format!("{} ", own.parameter)));
            assert!(line.is_some_and(|line| line.contains(&four)), "{plain}");
            assert!(page.contains(&format!("<td>{four}</td>")), "{four}");
        }
    }
}

/// The surest change stands first, and what the test hardly sees last; all has room on one page of a terminal.
#[test]
fn factors_stand_in_the_order_of_how_sure_their_changes_are() {
    for name in ["box", "garteur", "wing"] {
        let report = report_of(worked(name));
        let key = |e: usize| report.surest[e].sureness.map_or(1.0, |own| -own as f32);
        assert!(
            (1..report.surest.len()).all(|e| key(e - 1) <= key(e)),
            "{name}"
        );
    }
    let plain = text(&report_of(worked("garteur")).brief());
    let is_narrow = plain.lines().all(|line| line.chars().count() <= WIDTH);
    assert!(is_narrow && plain.lines().count() <= 60, "{plain}");
}

#[test]
fn no_name_ends_the_script_or_a_tag() {
    let name = "</script><b a='x'>&amp;@DATA@";
    let title = format!("title = \"{name}\"\n[model]");
    let files = rods_with("name = \"a\"", &format!("name = \"{name}\""));
    let files = with(files, "job.toml", "[model]", &title);
    let page = report_page(&report_of(&finished(&prepared(&files)))).unwrap();
    assert!(!page.contains("<b a") && !page.contains("</script><b"));
    // Charts are drawn from the report in the page.
    let (_, rest) = page.split_once("<script>const report = ").unwrap();
    let (data, _) = rest.split_once(";</script>").unwrap();
    let found: Value = serde_json::from_str(data).unwrap();
    assert_eq!(found["parameters"][0]["parameter"], name);
    assert_eq!(found["modes"].as_array().map(Vec::len), Some(3));
}

#[test]
fn a_job_is_drawn_with_the_rods_the_grids_and_the_bounds_of_its_deck() {
    let bounded = "elements = [1]\nlower = 0.5\nupper = 2.0";
    let mut found = finished(&prepared(&rods_with("elements = [1]", bounded)));
    let report = report_of(&found);
    let drawing = report.drawing.unwrap();
    // Point masses have one grid, and are no lines.
    let rods = [(0, 0), (1, 1), (2, 1)].map(|(row, of)| (vec![row, row + 1], vec![of]));
    assert_eq!(drawing.pieces, rods);
    assert_eq!(
        drawing.places,
        [0.0, 10.0, 20.0, 30.0].map(|x| [x, 0.0, 0.0])
    );
    let sensors = [1, 2, 3].map(|place| Some((place, [1.0, 0.0, 0.0])));
    assert_eq!(drawing.sensors, sensors);
    let first = &report.parameters[0];
    assert_eq!(
        (first.lower_bound, first.upper_bound),
        (Some(0.5), Some(2.0))
    );
    // Without elements the lines of the test are drawn, but for one with an end that stands nowhere; a rotation moves nothing.
    let own = Arc::make_mut(&mut found.found.prepared.loaded);
    own.source.elements.clear();
    own.data.lines = vec![[1, 2], [2, 99]];
    own.placed[0].direction = 3;
    let drawing = report_of(&found).drawing.unwrap();
    assert_eq!(drawing.pieces, [(vec![0, 1], Vec::new())]);
    assert_eq!(drawing.sensors[0], Some((1, [0.0; 3])));
}

#[test]
fn sensors_that_point_the_other_way_askew_or_nowhere_are_told() {
    let mut prepared = prepared(&rods());
    let loaded = Arc::make_mut(&mut prepared.loaded);
    loaded.placed[1].sign = -1.0;
    loaded.placed[2].axis = Vector3::new(0.6, 0.0, -0.8);
    let directions = places(loaded).into_iter().map(|own| own.direction);
    assert_eq!(directions.collect_vec(), ["x", "-x", "x (0.60 0.00 -0.80)"]);
    loaded.placed.pop();
    let facts = facts(&prepared).unwrap();
    let mut unused = facts
        .iter()
        .filter(|own| own.fact == "sensors that are not used");
    assert!(unused.any(|own| own.value == "1"));
}

/// A list of many names tells how many it leaves out, and an identifier is one word with the names of what it is about, where it is about
/// some things among many.
#[test]
fn a_concern_names_what_it_is_about() {
    let free = |count: usize| {
        let names = (1..=count).map(|name| name.to_string()).collect();
        of_bodies(&BodyFinding::Mechanisms(names)).words
    };
    assert!(free(8).starts_with("Motions of 1, 2, 3, 4, 5, 6, 7, 8 are"));
    assert!(free(100).starts_with("Motions of 1, 2, 3, 4, 5, 6, 7, 8 and 92 more are"));
    let named = |name| Concern::doubt(Check::Pairs, name, &["a b", "c"], String::new()).identifier;
    let both = ["exchanged-", "exchanged"].map(named);
    assert_eq!(both, ["exchanged-a-b-c", "exchanged"]);
}

/// A frequency's derivative by stiffness and by mass, against frequencies of a model with a little more of it.
#[test]
fn derivatives_are_the_changes_of_frequencies_with_stiffness_and_mass() {
    let [stiffness, stiff, heavy] =
        [[3.0, -1.0, 2.0], [1.0, -1.0, 1.0], [0.4, 0.1, 0.6]].map(|[a, b, c]| dmatrix![a, b; b, c]);
    let mass = eye(2) + &heavy;
    let test = solve(&stiffness, &mass, 2).unwrap();
    let parameters = [
        ParameterMatrix::Stiffness(stiff),
        ParameterMatrix::Mass(heavy),
    ];
    let (whole, sensors) = of_dense(&stiffness, &mass, &parameters).unwrap();
    let model = |factors: [f64; 2]| {
        whole
            .analyze(&factors, &sensors, &test, by_sorting(), 2)
            .unwrap()
    };
    let found = Derivatives::at(&Comparison::from(model([1.0; 2]))).unwrap();
    const STEP: f64 = 1e-5;
    for e in 0..2 {
        let [more, less] = [STEP, -STEP].map(|step| {
            let mut factors = [1.0; 2];
            factors[e] += step;
            model(factors).exact().modes.frequencies_hz()
        });
        for mode in 0..2 {
            let slope = (more[mode] / less[mode]).ln() / (2.0 * STEP);
            assert_relative_eq!(
                found.frequency[(e, mode)],
                slope,
                max_relative = CENTRAL_DIFFERENCE_GRADIENT
            );
        }
    }
}
