//! The figures of documents, the tour's in the order of its chapters: what is drawn is computed here.

use super::diagram::Drawn::{Bars, Dots, Lines};
use super::diagram::{Diagram, Series};
use super::readings::{COUNTED, RULES, name};
use crate::paper::figures::canvas::Dash::{Dashed, Solid};
use crate::prelude::*;

/// Every figure by the name of its file.
pub fn figures() -> [(&'static str, Diagram); 9] {
    [
        ("tour_01", two_springs()),
        ("tour_02", orders()),
        ("tour_03", crease()),
        ("tour_04", first_step()),
        ("counted_gages", counted_gages()),
        ("tour_06", history()),
        ("tour_08", gages()),
        ("tour_09", demands()),
        ("tour_10", deviations()),
    ]
}

/// Two masses between a wall on either side, with the springs between: plain lines.
pub const SPRINGS: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" class="drawn" viewBox="0 0 340 110" width="340" height="110" role="img" font-size="14" fill="none" stroke="black" stroke-width="2">
<title>Two masses, each on a spring to the ground, and a third spring between them</title>
<style>@media screen and (prefers-color-scheme: dark) {
.drawn rect[fill="white"]{fill:#171717}
.drawn[stroke="black"]{stroke:#E4E4E4}
.drawn g[fill="black"]{fill:#E4E4E4}
}</style>
<rect width="340" height="110" fill="white" stroke="none"/>
<path d="M8 20v60M332 20v60" stroke-width="4"/>
<path d="M8 50h8l7 -12l12 24l12 -24l12 24l12 -24l12 24l7 -12h6M140 50h6l6 -12l12 24l12 -24l12 24l6 -12h6M244 50h6l7 -12l12 24l12 -24l12 24l12 -24l12 24l7 -12h8"/>
<rect x="96" y="28" width="44" height="44"/>
<rect x="200" y="28" width="44" height="44"/>
<g stroke="none" fill="black" text-anchor="middle">
<text x="118" y="55">1</text>
<text x="222" y="55">1</text>
<text x="52" y="95">1 + ε</text>
<text x="170" y="95">1</text>
<text x="288" y="95">1</text>
</g>
</svg>"#;

/// Numbers of panels or modes, from one, beside their values.
fn numbered(values: impl IntoIterator<Item = f64>) -> Vec<(f64, f64)> {
    (1..).map(f64::from).zip(values).collect()
}

const PANELS: [f64; 3] = [0.0, 2.0, 16.0];

fn two_springs() -> Diagram {
    let series = |name, mode: usize, drawn, steps: i32| {
        let of = |step: i32| {
            let change = -0.9 + 2.9 * f64::from(step) / f64::from(steps);
            let springs = TwoMasses {
                coupling: 1.0,
                change,
            };
            let first = springs.generalized_stiffness()[mode] + springs.beta()[(mode, mode)];
            (
                change,
                if steps > 1 {
                    1.0 / springs.exact_roots()[mode]
                } else {
                    first
                },
            )
        };
        (name, drawn, (0..=steps).map(of).collect_vec())
    };
    Diagram(
        "Two masses: squared frequencies against the change of a spring",
        ["change of the first spring", "squared frequency"],
        [-1.0, 0.0, 2.0],
        [0.0, 2.0, 8.0],
        vec![
            series("mode 1, exact", 0, Lines(Solid), 58),
            series("mode 1, first order", 0, Lines(Dashed), 1),
            series("mode 2, exact", 1, Lines(Solid), 58),
            series("mode 2, first order", 1, Lines(Dashed), 1),
        ],
    )
}

fn orders() -> Diagram {
    let of_case = |name, number, drawn, is_first: bool| {
        let modal = first_problem(number);
        let factors = &case_run(&case_of(number)).correlation.passes[0]
            .inner
            .last
            .share_factors;
        let changes = modal.shares().iter().zip(factors);
        let beta: DMatrix<f64> = changes.map(|(share, factor)| (factor - 1.0) * share).sum();
        let k = modal.exact().modes.omega_squared();
        let change = ModalChange::of_vibrations(k, beta.clone(), zero_square(9));
        let exact = eigensolution(&change).unwrap();
        let error = |order| {
            let found = match is_first {
                true => recursive_1(k, &beta, order),
                false => change.pencil().unwrap().recursive_2(order),
            };
            let ratios = found.unwrap().roots.component_div(&exact.roots);
            100.0 * ratios.map(|ratio| (1.0 / ratio.sqrt() - 1.0).abs()).max()
        };
        (name, drawn, numbered((1..=6).map(error)))
    };
    Diagram(
        "Frequency errors of the recursions against their order",
        ["order", "largest error of a frequency, %"],
        [1.0, 2.0, 6.0],
        [1e-10, 1e-8, 1e2],
        vec![
            of_case("Case 1, Recursive 1", 1, Lines(Solid), true),
            of_case("Case 2, Recursive 1", 2, Lines(Solid), true),
            of_case("Case 3, Recursive 1", 3, Lines(Solid), true),
            of_case("Case 3, Recursive 2", 3, Lines(Dashed), false),
        ],
    )
}

/// A model of one parameter a share, beside the modes of its stiffness divided by a number.
fn too_stiff(shares: Vec<DMatrix<f64>>, too_stiff: f64) -> ModalModel {
    let stiffness: DMatrix<f64> = shares.iter().sum();
    let mass = eye(stiffness.nrows());
    let test = solve(&(&stiffness / too_stiff), &mass, mass.nrows()).unwrap();
    let model = DynamicModel {
        stiffness,
        mass,
        shares,
    };
    model.analyze(&test, None).unwrap()
}

fn crease() -> Diagram {
    let modal = too_stiff(
        [0, 1]
            .map(|spring| spring_stiffness(2, spring, 1.5))
            .to_vec(),
        1.5,
    );
    let series = |name, drawn, of: fn(&Errors) -> f64| {
        let factors = (0..=40).map(|step| 0.5 + f64::from(step) / 40.0);
        let point = |factor| (factor, of(&modal.at(&[factor, 1.0]).unwrap().errors));
        (name, drawn, factors.map(point).collect_vec())
    };
    Diagram(
        "The crease of the error sum",
        ["factor on the first spring", "error"],
        [0.5, 0.75, 1.5],
        [0.0, 0.25, 1.0],
        vec![
            series("error sum", Lines(Solid), Errors::sum),
            series("frequency error", Lines(Dashed), |errors| errors.frequency),
            series("shape error", Lines(Solid), |errors| errors.shape),
        ],
    )
}

/// First steps for one common factor, in units of Newton's: chapter 4 derives and computes them.
fn first_step() -> Diagram {
    let of = |step: fn(f64) -> f64, most: i32| numbered((1..=most).map(|n| step(f64::from(n))));
    let all = vec![
        ("relative", Lines(Solid), of(|n| n / 4.0, 12)),
        ("matrix", Lines(Solid), of(|n| n.sqrt() / 4.0, 30)),
        ("matrix, as nine modes", Lines(Dashed), of(|_| 0.75, 30)),
    ];
    let labels = ["number of modes", "step in units of Newton's"];
    let title = "The first step beside Newton's";
    Diagram(title, labels, [0.0, 5.0, 30.0], [0.0, 1.0, 3.0], all)
}

fn counted_gages() -> Diagram {
    let of = |rule| {
        let columns = COUNTED.iter().filter(move |column| column.rule == rule);
        columns.map(|column| 100.0 * column.difference())
    };
    Diagram(
        "Gages after the published number of iterations",
        ["column", "RMS difference from the print, points"],
        [0.0, 5.0, 15.0],
        [0.0, 10.0, 40.0],
        RULES
            .map(|rule| (name(rule), Dots, numbered(of(rule))))
            .to_vec(),
    )
}

fn history() -> Diagram {
    let run = case_run(&case_of(2)).correlation;
    let series = |name, drawn, of: fn(&Errors) -> f64| {
        let (mut points, mut count, mut start) = (Vec::new(), 0.0, run.initial.errors);
        // Every pass begins where the exact check of the one before it ends, and ends where its own perturbation does.
        for pass in &run.passes {
            points.push((count, 100.0 * of(&start)));
            for step in &pass.inner.iterations {
                count += 1.0;
                points.push((count, 100.0 * of(&step.errors)));
            }
            start = pass.check.errors;
            points.push((count, f64::NAN));
        }
        points.pop();
        (name, drawn, points)
    };
    let steps = |pass: &Pass| pass.inner.iterations.len() as f64;
    let ends = run.passes.iter().scan(0.0, |count, pass| {
        *count += steps(pass);
        Some((*count, 100.0 * pass.check.errors.sum()))
    });
    Diagram(
        "Case 2 through both passes",
        ["iteration", "error, %"],
        [0.0, 10.0, 60.0],
        [0.1, 1.0, 1000.0],
        vec![
            series("error sum", Lines(Solid), Errors::sum),
            series("frequency error", Lines(Dashed), |errors| errors.frequency),
            series("shape error", Lines(Dashed), |errors| errors.shape),
            ("exact error sum", Dots, ends.collect()),
        ],
    )
}

/// A column of a published table of the fifteen panels.
fn published(table: usize, heading: &str) -> Vec<f64> {
    let table = PublishedTable::number(table).unwrap();
    let of = |panel: usize| table.required(&panel.to_string(), heading).unwrap();
    (1..=PANEL_COUNT).map(of).collect()
}

/// Bars or dots over the fifteen panels.
fn of_panels(
    title: &'static str,
    label: &'static str,
    y: [f64; 3],
    series: Vec<Series>,
) -> Diagram {
    Diagram(title, ["panel", label], PANELS, y, series)
}

/// Gage errors of Case 2 at its end, percent.
fn final_gage_errors() -> Vec<f64> {
    let gages = case_run(&case_of(2)).pass_gages.pop().unwrap();
    gages
        .iter()
        .map(|gage| 100.0 * (gage / TEST_GAGE - 1.0))
        .collect()
}

fn gages() -> Diagram {
    let published = published(6, "pass_2_percent");
    let both = vec![
        ("computed", Bars, numbered(final_gage_errors())),
        ("published", Dots, numbered(published)),
    ];
    of_panels(
        "Case 2: gage errors at the end",
        "gage error, %",
        [-20.0, 0.0, 60.0],
        both,
    )
}

fn demands() -> Diagram {
    let factors = case_run(&case_of(4)).unlimited_factors.clone();
    let bars = vec![("factor asked for", Bars, numbered(factors))];
    let title = "Case 4: unlimited factors of the first iteration";
    of_panels(title, "unlimited factor", [-20.0, 0.0, 60.0], bars)
}

fn deviations() -> Diagram {
    let (case, ones) = (case_of(2), [1.0; PANEL_COUNT]);
    let model = case.model_with(&[TEST_GAGE; PANEL_COUNT]).unwrap();
    let modal = model
        .analyze(&ones, &case.test_modes().unwrap(), None)
        .unwrap();
    let seen = jacobian(&Comparison::from(&modal), &equal_weights(Noise::USUAL, 9))
        .and_then(|jacobian| identifiability(&jacobian, &ones))
        .unwrap();
    let deviations = seen.deviations.iter().map(|deviation| 100.0 * deviation);
    let errors = final_gage_errors().into_iter().map(f64::abs);
    let both = vec![
        (
            "standard deviation of the factor",
            Bars,
            numbered(deviations),
        ),
        ("gage error left in Case 2", Dots, numbered(errors)),
    ];
    let title = "What nine noisy modes know of the panels of Case 2";
    of_panels(title, "%", [0.0, 25.0, 100.0], both)
}
