//! The figures of the tour, by the number of their chapter: what is drawn is computed here.

use crate::common::sketch::{Mark, Series, Sketch};
use corfem::cases::published::PublishedTable;
use corfem::cases::table_1::TwoMasses;
use corfem::cases::torque_box::TEST_GAGE;
use corfem::cases::{Case, run_case};
use corfem::closed_forms::spring_chain::spring_stiffness;
use corfem::method::appendix_c::general::{ModalChange, recursive_2};
use corfem::method::appendix_c::{Perturbed, eigensolution, recursive_1};
use corfem::method::derivatives::{DerivativeRule, error_changes};
use corfem::method::error_sum::{ErrorMeasure, Errors};
use corfem::method::model::{DynamicModel, ModalModel, Share};
use corfem::method::modes::solve;
use corfem::method::outer_loop::{Settings, correlate};
use corfem::method::state::{ModalState, UpdateRule};
use corfem::method::step::{StepRule, stiffness_changes, unlimited_factors};
use corfem::studies::noisy_modes::Noise;
use corfem::studies::weighted::identifiability::identifiability;
use corfem::studies::weighted::residuals::{Weights, jacobian};
use nalgebra::DMatrix;
use std::collections::BTreeMap;

/// Every chapter's figure as SVG.
pub fn figures() -> BTreeMap<&'static str, String> {
    let sketches = [
        ("01", two_springs()),
        ("02", orders()),
        ("03", crease()),
        ("04", first_step()),
        ("05", history()),
        ("06", bounds()),
        ("07", gages()),
        ("08", demands()),
        ("09", deviations()),
        ("10", stories()),
    ];
    sketches.into_iter().map(|(number, sketch)| (number, sketch.svg())).collect()
}

/// Numbers from one to another in equal steps.
fn range(low: f64, high: f64, steps: usize) -> impl Iterator<Item = f64> {
    (0..=steps).map(move |step| low + (high - low) * step as f64 / steps as f64)
}

fn two_springs() -> Sketch {
    let exact = |mode: usize| {
        let root = move |change: f64| (change, 1.0 / TwoMasses { coupling: 1.0, change }.exact_roots()[mode]);
        range(-0.9, 2.0, 58).map(root)
    };
    let first_order = |mode: usize| {
        let of = move |change: f64| {
            let springs = TwoMasses { coupling: 1.0, change };
            (change, springs.generalized_stiffness()[mode] + springs.beta()[(mode, mode)])
        };
        range(-0.9, 2.0, 1).map(of)
    };
    Sketch {
        title: "Two masses: squared frequencies against the change of a spring",
        labels: ["change of the first spring", "squared frequency"],
        x: (-1.0, 2.0),
        y: (0.0, 8.0),
        is_logarithmic: false,
        series: vec![
            Series::new("mode 1, exact", Mark::Line, exact(0)),
            Series::new("mode 1, first order", Mark::Dashed, first_order(0)),
            Series::new("mode 2, exact", Mark::Line, exact(1)),
            Series::new("mode 2, first order", Mark::Dashed, first_order(1)),
        ],
    }
}

/// A case's first model, and the change of its first pass in modal coordinates.
fn first_pass(number: usize) -> (ModalModel, DMatrix<f64>) {
    let case = Case::new(number).expect("a case");
    let test = case.test_modes().expect("modes");
    let modal = case.model().and_then(|model| Ok(model.analyze(&[1.0; 15], &test, None)?)).expect("a model");
    let result = run_case(&case, |_, _| {}).expect("a run");
    let factors = &result.correlation.passes[0].inner.last.factors;
    let beta = modal.shares.iter().zip(factors).map(|(share, factor)| (factor - 1.0) * share.matrix()).sum();
    (modal, beta)
}

fn orders() -> Sketch {
    let error = |found: &Perturbed, exact: &Perturbed| {
        100.0 * found.roots.zip_map(&exact.roots, |a, b| ((b / a).sqrt() - 1.0).abs()).max()
    };
    let of_case = |name, number, mark, is_first: bool| {
        let (modal, beta) = first_pass(number);
        let k = &modal.exact.modes.omega_squared;
        let change = ModalChange::of_vibrations(k, beta.clone(), DMatrix::zeros(9, 9));
        let exact = eigensolution(&change).expect("modes");
        let by = |order| if is_first { recursive_1(k, &beta, order) } else { recursive_2(&change, order) };
        let point = |order| (order as f64, error(&by(order).expect("an order"), &exact));
        Series::new(name, mark, (1..=6).map(point).collect::<Vec<_>>())
    };
    Sketch {
        title: "Frequency errors of the recursions against their order",
        labels: ["order", "largest error of a frequency, %"],
        x: (1.0, 6.0),
        y: (1e-10, 1e2),
        is_logarithmic: true,
        series: vec![
            of_case("Case 1, Recursive 1", 1, Mark::Line, true),
            of_case("Case 2, Recursive 1", 2, Mark::Line, true),
            of_case("Case 3, Recursive 1", 3, Mark::Line, true),
            of_case("Case 3, Recursive 2", 3, Mark::Dashed, false),
        ],
    }
}

/// A model of one parameter a share, beside the modes of its stiffness divided by a number.
fn too_stiff(shares: Vec<DMatrix<f64>>, too_stiff: f64) -> ModalModel {
    let stiffness: DMatrix<f64> = shares.iter().sum();
    let count = stiffness.nrows();
    let mass = DMatrix::identity(count, count);
    let test = solve(&(&stiffness / too_stiff), &mass, count).expect("modes");
    let shares = shares.into_iter().map(Share::Stiffness).collect();
    DynamicModel { stiffness, mass, shares }.analyze(&test, None).expect("a model")
}

fn crease() -> Sketch {
    let modal = too_stiff(vec![spring_stiffness(2, 0, 1.5), spring_stiffness(2, 1, 1.5)], 1.5);
    let at =
        |factor: f64| ModalState::at(&modal, vec![factor, 1.0], UpdateRule::Eigensolution).expect("a state").errors;
    let series = |name, mark, of: fn(&Errors) -> f64| {
        Series::new(name, mark, range(0.5, 1.5, 40).map(|factor| (factor, of(&at(factor)))).collect::<Vec<_>>())
    };
    Sketch {
        title: "The crease of the error sum",
        labels: ["factor on the first spring", "error"],
        x: (0.5, 1.5),
        y: (0.0, 1.0),
        is_logarithmic: false,
        series: vec![
            series("error sum", Mark::Line, Errors::sum),
            series("frequency error", Mark::Dashed, |errors| errors.frequency),
            series("shape error", Mark::Line, |errors| errors.shape),
        ],
    }
}

fn first_step() -> Sketch {
    let ratio = |n: usize, rule, measure: ErrorMeasure| {
        let whole = (0..n).map(|spring| spring_stiffness(n, spring, 1.0)).sum();
        let modal = too_stiff(vec![whole], 1.001);
        let start = ModalState::start(&modal);
        let changes = error_changes(&modal, &start, DerivativeRule::Gradient).expect("a slope");
        let stiffness = stiffness_changes(&modal, &[1.0], &[1.0], &changes, rule).expect("a change");
        let error = measure.scale(n) * start.errors.sum();
        // Newton's is the step to the right factor.
        (n as f64, (unlimited_factors(&changes, &stiffness, error, 1.0)[0] - 1.0) / (1.0 / 1.001 - 1.0))
    };
    let series = |name, mark, most: usize, rule, measure| {
        Series::new(name, mark, (1..=most).map(|n| ratio(n, rule, measure)).collect::<Vec<_>>())
    };
    Sketch {
        title: "The first step beside Newton's",
        labels: ["number of modes", "step in units of Newton's"],
        x: (0.0, 30.0),
        y: (0.0, 3.0),
        is_logarithmic: false,
        series: vec![
            series("relative", Mark::Line, 12, StepRule::Relative, ErrorMeasure::Sum),
            series("matrix", Mark::Line, 30, StepRule::Matrix, ErrorMeasure::Sum),
            series("matrix, as nine modes", Mark::Dashed, 30, StepRule::Matrix, ErrorMeasure::NineModes),
        ],
    }
}

fn history() -> Sketch {
    let result = Case::new(2).and_then(|case| run_case(&case, |_, _| {})).expect("a run");
    let passes = &result.correlation.passes;
    let mut errors = vec![(0.0, result.correlation.initial.errors)];
    let mut checks = Vec::new();
    for pass in passes {
        let before = errors.len();
        errors.extend((before..).map(|n| n as f64).zip(pass.inner.iterations.iter().map(|step| step.errors)));
        checks.push((errors.len() as f64 - 1.0, 100.0 * pass.check.errors.sum()));
    }
    let series = |name, mark, of: fn(&Errors) -> f64| {
        Series::new(name, mark, errors.iter().map(|(n, errors)| (*n, 100.0 * of(errors))).collect::<Vec<_>>())
    };
    Sketch {
        title: "Case 2 through both passes",
        labels: ["iteration", "error, %"],
        x: (0.0, 65.0),
        y: (0.1, 1e3),
        is_logarithmic: true,
        series: vec![
            series("error sum", Mark::Line, Errors::sum),
            series("frequency error", Mark::Dashed, |errors| errors.frequency),
            series("shape error", Mark::Dashed, |errors| errors.shape),
            Series::new("exact error sum", Mark::Dots, checks),
        ],
    }
}

/// Frequencies of Case 2 at its published gages, by shapes and by loads of the first model, beside the exact ones.
fn bounds() -> Sketch {
    let model = Case::new(2).and_then(|case| case.model()).expect("a model");
    let table = PublishedTable::number(6).expect("Table 6");
    let gage = |panel: usize| table.required(&panel.to_string(), "pass_1_in").expect("a gage");
    let factors: Vec<f64> = (1..=15).map(|panel| gage(panel) / 0.015).collect();
    let first = model.matrices(&[1.0; 15]).expect("matrices");
    let flexibility = first.stiffness.clone().try_inverse().expect("regular");
    let (mut above, mut below) = (first.stiffness.clone(), flexibility.clone());
    for (share, factor) in first.shares.iter().zip(&factors) {
        above += (factor - 1.0) * share.matrix();
        below += (1.0 / factor - 1.0) * &flexibility * share.matrix() * &flexibility;
    }
    let exact = model.modes(&factors).expect("modes").frequencies_hz();
    let series = |name, mark, stiffness: DMatrix<f64>| {
        let found = solve(&(0.5 * (&stiffness + stiffness.transpose())), &first.mass, 9).expect("modes");
        let ratios = found.frequencies_hz().into_iter().zip(&exact).map(|(found, exact)| 100.0 * (found / exact - 1.0));
        Series::new(name, mark, (1..).map(f64::from).zip(ratios))
    };
    Sketch {
        title: "Two bounds on the frequencies of Case 2",
        labels: ["mode", "difference from the exact frequency, %"],
        x: (0.0, 10.0),
        y: (-1.0, 1.5),
        is_logarithmic: false,
        series: vec![
            series("shapes frozen (above)", Mark::Bars, above),
            series("loads frozen (below)", Mark::Bars, below.try_inverse().expect("regular")),
        ],
    }
}

/// Gage errors of Case 2 at its end, percent.
fn final_gage_errors() -> Vec<f64> {
    let result = Case::new(2).and_then(|case| run_case(&case, |_, _| {})).expect("a run");
    let gages = result.pass_gages.last().expect("a pass");
    gages.iter().map(|gage| 100.0 * (gage / TEST_GAGE - 1.0)).collect()
}

/// Numbers of the fifteen panels beside them.
fn by_panel(values: Vec<f64>) -> Vec<(f64, f64)> {
    (1..).map(f64::from).zip(values).collect()
}

fn gages() -> Sketch {
    let table = PublishedTable::number(6).expect("Table 6");
    let published = |panel: usize| table.required(&panel.to_string(), "pass_2_percent").expect("an error");
    Sketch {
        title: "Case 2: gage errors at the end",
        labels: ["panel", "gage error, %"],
        x: (0.0, 16.0),
        y: (-20.0, 70.0),
        is_logarithmic: false,
        series: vec![
            Series::new("computed", Mark::Bars, by_panel(final_gage_errors())),
            Series::new("published", Mark::Dots, by_panel((1..=15).map(published).collect())),
        ],
    }
}

fn demands() -> Sketch {
    let result = Case::new(4).and_then(|case| run_case(&case, |_, _| {})).expect("a run");
    Sketch {
        title: "Case 4: unlimited factors of the first iteration",
        labels: ["panel", "unlimited factor"],
        x: (0.0, 16.0),
        y: (-20.0, 70.0),
        is_logarithmic: false,
        series: vec![Series::new("factor asked for", Mark::Bars, by_panel(result.unlimited_factors().to_vec()))],
    }
}

fn deviations() -> Sketch {
    let case = Case::new(2).expect("a case");
    let test = case.test_modes().expect("modes");
    let model = case.model_with(&[TEST_GAGE; 15]).expect("a model").analyze(&[1.0; 15], &test, None).expect("a model");
    let weights = Weights::uniform(Noise::USUAL, 9).expect("weights");
    let seen = jacobian(&model, &weights).and_then(|jacobian| identifiability(&jacobian, 1.0)).expect("what is seen");
    let percents = seen.deviations.iter().map(|deviation| 100.0 * deviation).collect();
    let errors = final_gage_errors().into_iter().map(f64::abs).collect();
    Sketch {
        title: "What nine noisy modes know of the panels of Case 2",
        labels: ["panel", "%"],
        x: (0.0, 16.0),
        y: (0.0, 100.0),
        is_logarithmic: false,
        series: vec![
            Series::new("standard deviation of the factor", Mark::Bars, by_panel(percents)),
            Series::new("gage error left in Case 2", Mark::Dots, by_panel(errors)),
        ],
    }
}

fn stories() -> Sketch {
    let analyze = |factors: &[f64]| {
        let share = |(story, factor): (usize, &f64)| Share::Stiffness(spring_stiffness(4, story, 4000.0 * factor));
        let shares: Vec<Share> = factors.iter().enumerate().map(share).collect();
        DynamicModel { stiffness: shares.iter().map(Share::matrix).sum(), mass: DMatrix::identity(4, 4), shares }
    };
    let truth = analyze(&[0.7, 1.0, 1.1, 1.0]);
    let test = solve(&truth.stiffness, &truth.mass, 4).expect("modes").into();
    let settings = Settings { error_sum_tolerance: 0.005, later_inner_tolerance: 0.0025, ..Settings::default() };
    let run = correlate(|factors| analyze(factors).analyze(&test, None), &[None; 4], &settings, |_, _| {});
    let mut history = vec![vec![1.0; 4]];
    for pass in run.expect("a run").passes {
        let base = history.last().expect("a start").clone();
        let product = |factors: &Vec<f64>| base.iter().zip(factors).map(|(base, factor)| base * factor).collect();
        history.extend(pass.inner.iterations.iter().map(|step| product(&step.factors)).collect::<Vec<_>>());
    }
    let names = ["story 1", "story 2", "story 3", "story 4"];
    let of = |story: usize| history.iter().enumerate().map(move |(n, factors)| (n as f64, factors[story]));
    Sketch {
        title: "The factors of four stories",
        labels: ["iteration", "factor"],
        x: (0.0, 20.0),
        y: (0.6, 1.4),
        is_logarithmic: false,
        series: names.into_iter().zip(0..).map(|(name, story)| Series::new(name, Mark::Line, of(story))).collect(),
    }
}
