//! The figures of the tour, in the order of its chapters: what is drawn is computed here. Those of the box stand beside.

use super::diagram::{Diagram, Series, SeriesMark};
use super::tour_figures_box::{bounds, demands, deviations, gages, history, orders};
use crate::prelude::*;

/// Every chapter's own figure by the chapter's number. Chapter 5 shows one of the readings.
pub fn figures() -> [(&'static str, Diagram); 10] {
    [
        ("01", two_springs()),
        ("02", orders()),
        ("03", crease()),
        ("04", first_step()),
        ("06", history()),
        ("07", bounds()),
        ("08", gages()),
        ("09", demands()),
        ("10", deviations()),
        ("11", stories()),
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

/// Numbers from one to another in equal steps.
fn range(low: f64, high: f64, steps: usize) -> impl Iterator<Item = f64> {
    (0..=steps).map(move |step| low + (high - low) * step as f64 / steps as f64)
}

fn two_springs() -> Diagram {
    let exact = |mode: usize| {
        let root = move |change: f64| {
            (
                change,
                1.0 / TwoMasses {
                    coupling: 1.0,
                    change,
                }
                .exact_roots()[mode],
            )
        };
        range(-0.9, 2.0, 58).map(root)
    };
    let first_order = |mode: usize| {
        let of = move |change: f64| {
            let springs = TwoMasses {
                coupling: 1.0,
                change,
            };
            (
                change,
                springs.generalized_stiffness()[mode] + springs.beta()[(mode, mode)],
            )
        };
        range(-0.9, 2.0, 1).map(of)
    };
    Diagram {
        title: "Two masses: squared frequencies against the change of a spring",
        labels: ["change of the first spring", "squared frequency"],
        x: (-1.0, 2.0),
        y: (0.0, 8.0),
        is_logarithmic: false,
        series: vec![
            Series::new("mode 1, exact", SeriesMark::Line, exact(0)),
            Series::new("mode 1, first order", SeriesMark::Dashed, first_order(0)),
            Series::new("mode 2, exact", SeriesMark::Line, exact(1)),
            Series::new("mode 2, first order", SeriesMark::Dashed, first_order(1)),
        ],
    }
}

/// A model of one parameter a share, beside the modes of its stiffness divided by a number.
fn too_stiff(shares: Vec<DMatrix<f64>>, too_stiff: f64) -> Model {
    let stiffness: DMatrix<f64> = shares.iter().sum();
    let count = stiffness.nrows();
    let mass = eye(count);
    let test = solve(&(&stiffness / too_stiff), &mass, count).unwrap();
    DynamicModel {
        stiffness,
        mass,
        shares,
    }
    .analyze(&test, None)
    .unwrap()
}

fn crease() -> Diagram {
    let modal = too_stiff(
        vec![spring_stiffness(2, 0, 1.5), spring_stiffness(2, 1, 1.5)],
        1.5,
    );
    let at = |factor: f64| {
        let state = exact_state(&modal, &[factor, 1.0]);
        state.unwrap().errors
    };
    let series = |name, mark, of: fn(&Errors) -> f64| {
        Series::new(
            name,
            mark,
            range(0.5, 1.5, 40)
                .map(|factor| (factor, of(&at(factor))))
                .collect_vec(),
        )
    };
    Diagram {
        title: "The crease of the error sum",
        labels: ["factor on the first spring", "error"],
        x: (0.5, 1.5),
        y: (0.0, 1.0),
        is_logarithmic: false,
        series: vec![
            series("error sum", SeriesMark::Line, Errors::sum),
            series("frequency error", SeriesMark::Dashed, |errors| {
                errors.frequency
            }),
            series("shape error", SeriesMark::Line, |errors| errors.shape),
        ],
    }
}

fn first_step() -> Diagram {
    let ratio = |n: usize, rule, settings: &Settings| {
        let whole = (0..n).map(|spring| spring_stiffness(n, spring, 1.0)).sum();
        let modal = too_stiff(vec![whole], 1.001);
        let start = modal.exact();
        // At c = 1, of n frequencies that are each √(1.001 c) of the test's, and of shapes that do not change.
        let slope = 0.5 * (1.001 * n as f64).sqrt();
        let stiffness = modal.stiffness_changes(start, &[1.0], rule)[0];
        let (sum, relaxation) = (start.errors.sum(), settings.inner.relaxation);
        let factor = unlimited_factor(DERIVATIVE_STEP * slope, stiffness, sum, relaxation);
        // Newton's is the step to the right factor.
        (n as f64, (factor - 1.0) / (1.0 / 1.001 - 1.0))
    };
    type Scaled = fn(&Settings, usize) -> Settings;
    let as_it_is: Scaled = |settings, _| settings.clone();
    let series = |name, mark, most: usize, rule, scaled: Scaled| {
        let of = |n| ratio(n, rule, &scaled(&Settings::default(), n));
        Series::new(name, mark, (1..=most).map(of).collect_vec())
    };
    Diagram {
        title: "The first step beside Newton's",
        labels: ["number of modes", "step in units of Newton's"],
        x: (0.0, 30.0),
        y: (0.0, 3.0),
        is_logarithmic: false,
        series: vec![
            series(
                "relative",
                SeriesMark::Line,
                12,
                StepRule::Relative,
                as_it_is,
            ),
            series("matrix", SeriesMark::Line, 30, StepRule::Matrix, as_it_is),
            series(
                "matrix, as nine modes",
                SeriesMark::Dashed,
                30,
                StepRule::Matrix,
                Settings::for_modes,
            ),
        ],
    }
}

fn stories() -> Diagram {
    let analyze = |factors: &[f64]| {
        let share = |(story, factor)| spring_stiffness(4, story, 4000.0 * factor);
        let shares = factors.iter().enumerate().map(share).collect_vec();
        DynamicModel {
            stiffness: shares.iter().sum(),
            mass: eye(4),
            shares,
        }
    };
    let truth = analyze(&[0.7, 1.0, 1.1, 1.0]);
    let test = solve(&truth.stiffness, &truth.mass, 4).unwrap();
    let settings = Settings {
        error_sum_tolerance: 0.005,
        later_inner_tolerance: 0.0025,
        ..Settings::default()
    }
    .for_modes(4);
    let run = correlate(
        |factors| analyze(factors).analyze(&test, None),
        &[None; 4],
        &settings,
        |_, _| true,
    );
    let mut history = vec![vec![1.0; 4]];
    for pass in run.unwrap().passes {
        let base = history.last().unwrap().clone();
        let product = |factors: &Vec<f64>| {
            base.iter()
                .zip(factors)
                .map(|(base, factor)| base * factor)
                .collect()
        };
        history.extend(
            pass.inner
                .iterations
                .iter()
                .map(|step| product(&step.factors))
                .collect_vec(),
        );
    }
    let names = ["story 1", "story 2", "story 3", "story 4"];
    let of = |story: usize| {
        history
            .iter()
            .enumerate()
            .map(move |(n, factors)| (n as f64, factors[story]))
    };
    Diagram {
        title: "The factors of four stories",
        labels: ["iteration", "factor"],
        x: (0.0, 20.0),
        y: (0.6, 1.4),
        is_logarithmic: false,
        series: names
            .into_iter()
            .zip(0..)
            .map(|(name, story)| Series::new(name, SeriesMark::Line, of(story)))
            .collect(),
    }
}
