//! The figures of the tour that show the paper's box.

use super::diagram::{Diagram, Series, SeriesMark};
use crate::prelude::*;

/// A case's first model, and the change of its first pass in modal coordinates.
fn first_pass(number: usize) -> (Model, DMatrix<f64>) {
    let case = case_of(number);
    let test = case.test_modes().unwrap();
    let modal = case
        .model()
        .and_then(|model| Ok(model.analyze(&[1.0; 15], &test, None)?))
        .unwrap();
    let result = run_case(&case, |_, _| {}).unwrap();
    let factors = &result.correlation.passes[0].inner.last.factors;
    let beta = modal
        .shares()
        .iter()
        .zip(factors)
        .map(|(share, factor)| (factor - 1.0) * share)
        .sum();
    (modal, beta)
}

pub fn orders() -> Diagram {
    let error = |found: &Perturbed, exact: &Perturbed| {
        100.0
            * found
                .roots
                .zip_map(&exact.roots, |a, b| ((b / a).sqrt() - 1.0).abs())
                .max()
    };
    let of_case = |name, number, mark, is_first: bool| {
        let (modal, beta) = first_pass(number);
        let k = modal.exact().modes.omega_squared();
        let change = ModalChange::of_vibrations(k, beta.clone(), zero_square(9));
        let exact = eigensolution(&change).unwrap();
        let by = |order| {
            if is_first {
                recursive_1(k, &beta, order)
            } else {
                change.pencil()?.recursive_2(order)
            }
        };
        let point = |order| (order as f64, error(&by(order).unwrap(), &exact));
        Series::new(name, mark, (1..=6).map(point).collect_vec())
    };
    Diagram {
        title: "Frequency errors of the recursions against their order",
        labels: ["order", "largest error of a frequency, %"],
        x: (1.0, 6.0),
        y: (1e-10, 1e2),
        is_logarithmic: true,
        series: vec![
            of_case("Case 1, Recursive 1", 1, SeriesMark::Line, true),
            of_case("Case 2, Recursive 1", 2, SeriesMark::Line, true),
            of_case("Case 3, Recursive 1", 3, SeriesMark::Line, true),
            of_case("Case 3, Recursive 2", 3, SeriesMark::Dashed, false),
        ],
    }
}

pub fn history() -> Diagram {
    let result = Case::new(2)
        .and_then(|case| run_case(&case, |_, _| {}))
        .unwrap();
    let run = &result.correlation;
    // Every pass begins where the exact check of the one before it ends, and ends where its own perturbation does.
    let (mut passes, mut checks, mut begin, mut start) =
        (Vec::new(), Vec::new(), 0, run.initial.errors);
    for pass in &run.passes {
        let errors = pass.inner.iterations.iter().map(|step| step.errors);
        passes.push((begin..).zip(once(start).chain(errors)).collect_vec());
        begin += pass.inner.iterations.len();
        start = pass.check.errors;
        checks.push((begin as f64, 100.0 * start.sum()));
    }
    let series = |name, mark, of: fn(&Errors) -> f64| {
        passes.iter().enumerate().map(move |(row, errors)| {
            let points = errors
                .iter()
                .map(|(n, errors)| (*n as f64, 100.0 * of(errors)));
            Series::new(if row == 0 { name } else { "" }, mark, points.collect_vec())
        })
    };
    Diagram {
        title: "Case 2 through both passes",
        labels: ["iteration", "error, %"],
        x: (0.0, 60.0),
        y: (0.1, 1e3),
        is_logarithmic: true,
        series: series("error sum", SeriesMark::Line, Errors::sum)
            .chain(series("frequency error", SeriesMark::Dashed, |errors| {
                errors.frequency
            }))
            .chain(series("shape error", SeriesMark::Dashed, |errors| {
                errors.shape
            }))
            .chain([Series::new("exact error sum", SeriesMark::Dots, checks)])
            .collect(),
    }
}

/// Frequencies of Case 2 at its published gages, by shapes and by loads of the first model, beside the exact ones.
pub fn bounds() -> Diagram {
    let model = Case::new(2).and_then(|case| case.model()).unwrap();
    let table = PublishedTable::number(6).unwrap();
    let gage = |panel: usize| table.required(&panel.to_string(), "pass_1_in").unwrap();
    let factors = (1..=15).map(|panel| gage(panel) / 0.015).collect_vec();
    let first = model.matrices(&[1.0; 15]).unwrap();
    let flexibility = first.stiffness.clone().try_inverse().unwrap();
    let (mut above, mut below) = (first.stiffness.clone(), flexibility.clone());
    for (share, factor) in first.shares.iter().zip(&factors) {
        above += (factor - 1.0) * share;
        below += (1.0 / factor - 1.0) * &flexibility * share * &flexibility;
    }
    let exact = model.modes(&factors).unwrap().frequencies_hz();
    let series = |name, mark, stiffness: DMatrix<f64>| {
        let found = solve(
            &(0.5 * (&stiffness + stiffness.transpose())),
            &first.mass,
            9,
        )
        .unwrap();
        let ratios = found
            .frequencies_hz()
            .into_iter()
            .zip(&exact)
            .map(|(found, exact)| 100.0 * (found / exact - 1.0));
        Series::new(name, mark, (1..).map(f64::from).zip(ratios))
    };
    Diagram {
        title: "Two bounds on the frequencies of Case 2",
        labels: ["mode", "difference from the exact frequency, %"],
        x: (0.0, 10.0),
        y: (-1.0, 1.5),
        is_logarithmic: false,
        series: vec![
            series("shapes frozen (above)", SeriesMark::Bars, above),
            series(
                "loads frozen (below)",
                SeriesMark::Bars,
                below.try_inverse().unwrap(),
            ),
        ],
    }
}

/// Gage errors of Case 2 at its end, percent.
fn final_gage_errors() -> Vec<f64> {
    let result = Case::new(2)
        .and_then(|case| run_case(&case, |_, _| {}))
        .unwrap();
    let gages = result.pass_gages.last().unwrap();
    gages
        .iter()
        .map(|gage| 100.0 * (gage / TEST_GAGE - 1.0))
        .collect()
}

/// Numbers of the fifteen panels beside them.
fn by_panel(values: Vec<f64>) -> Vec<(f64, f64)> {
    (1..).map(f64::from).zip(values).collect()
}

pub fn gages() -> Diagram {
    let table = PublishedTable::number(6).unwrap();
    let published = |panel: usize| {
        table
            .required(&panel.to_string(), "pass_2_percent")
            .unwrap()
    };
    Diagram {
        title: "Case 2: gage errors at the end",
        labels: ["panel", "gage error, %"],
        x: (0.0, 16.0),
        y: (-20.0, 70.0),
        is_logarithmic: false,
        series: vec![
            Series::new("computed", SeriesMark::Bars, by_panel(final_gage_errors())),
            Series::new(
                "published",
                SeriesMark::Dots,
                by_panel((1..=15).map(published).collect()),
            ),
        ],
    }
}

pub fn demands() -> Diagram {
    let result = Case::new(4)
        .and_then(|case| run_case(&case, |_, _| {}))
        .unwrap();
    Diagram {
        title: "Case 4: unlimited factors of the first iteration",
        labels: ["panel", "unlimited factor"],
        x: (0.0, 16.0),
        y: (-20.0, 70.0),
        is_logarithmic: false,
        series: vec![Series::new(
            "factor asked for",
            SeriesMark::Bars,
            by_panel(result.unlimited_factors().to_vec()),
        )],
    }
}

pub fn deviations() -> Diagram {
    let case = case_of(2);
    let test = case.test_modes().unwrap();
    let model = case
        .model_with(&[TEST_GAGE; 15])
        .unwrap()
        .analyze(&[1.0; 15], &test, None)
        .unwrap();
    let weights = equal_weights(Noise::USUAL, 9);
    let seen = jacobian(&Comparison::from(&model), &weights)
        .and_then(|jacobian| identifiability(&jacobian, &[1.0; 15]))
        .unwrap();
    let percents = seen
        .deviations
        .iter()
        .map(|deviation| 100.0 * deviation)
        .collect();
    let errors = final_gage_errors().into_iter().map(f64::abs).collect();
    Diagram {
        title: "What nine noisy modes know of the panels of Case 2",
        labels: ["panel", "%"],
        x: (0.0, 16.0),
        y: (0.0, 100.0),
        is_logarithmic: false,
        series: vec![
            Series::new(
                "standard deviation of the factor",
                SeriesMark::Bars,
                by_panel(percents),
            ),
            Series::new(
                "gage error left in Case 2",
                SeriesMark::Dots,
                by_panel(errors),
            ),
        ],
    }
}
