//! The figures of a case's correlation: its frequencies, its modes, its history and its derivatives.

use super::super::report::CaseReport;
use super::error_history;
use super::factors::{DrawnFactor, Factors};
use super::matrices::{HeatMap, draw_by_twos, draw_derivatives};
use super::mode_shapes::{self, differing, farthest};
use super::{Figure, numbers};
use corfem::method::error_sum::Errors;
use corfem::present::PresentError;
use corfem::present::compared::{Agreement, Derivatives, Mode};
use corfem::present::table::{Digits, HERTZ};
use corfem::torque_box::wing_box::dynamic_points;
use nalgebra::DMatrix;

/// Every figure of a case: frequencies, errors against iteration, mode shapes, agreement of the modes before and after, and derivatives.
///
/// # Errors
/// [`PresentError::Drawing`]; the errors of the report's rows.
pub fn report_figures(report: &CaseReport) -> Result<Vec<Figure>, PresentError> {
    let (compared, derivatives) = (report.compared(), report.derivatives()?);
    let (case, modes) = (&report.result.case, compared.modes()?);
    let mut figures = Vec::new();
    let mut add = |what: &str,
                   title: &str,
                   caption: &str,
                   draw: &dyn Fn(&str, &str) -> Result<String, PresentError>| {
        let name = format!("case_{}_{what}", case.number);
        let title = format!("Case {}: {title}", case.number);
        let caption = format!("Case {}: {caption}.", case.number);
        figures.push(Figure::drawn(&name, caption, &draw(&name, &title)?));
        Ok::<_, PresentError>(())
    };
    let frequencies = frequencies(&modes);
    let most = |off: fn(&DrawnFactor) -> f64| {
        let off = frequencies.rows.iter().map(|row| off(row).abs());
        Digits::Fixed(2).write(off.fold(0.0, f64::max))
    };
    let caption = format!(
        "how far every frequency is from the test's before and after: up to {} % before, up to {} % after",
        most(|row| row.from.unwrap_or_default()),
        most(|row| row.value),
    );
    let title = "frequencies against the test's";
    add("frequencies", title, &caption, &|name, title| {
        frequencies.draw(name, title)
    })?;
    let sum = |errors: &Errors| Digits::Significant(2).write(100.0 * errors.sum());
    let caption = format!(
        "errors against iteration. The error sum falls from {} to {} %. Between exact solutions an inner loop steps by perturbation; at \
         the end of a pass the exact solution says what that was worth",
        sum(&report.first.errors),
        sum(&report.last.errors)
    );
    add(
        "errors",
        "errors against iteration",
        &caption,
        &|name, title| error_history::draw(name, title, report.result),
    )?;
    let (drawn, points) = (differing(report)?, dynamic_points(&case.reconstruction)?);
    let [first, last] = [1, 2].map(|state| Digits::Fixed(2).write(farthest(&drawn, state)));
    let caption = format!(
        "mode shapes of the test, of the first and of the corrected model, where the first model's are farther from the test's \
         than on average: by up to {first} of the largest motion, and the corrected model's by up to {last}; what lies between \
         sensors is interpolated from those near it"
    );
    let title = "mode shapes that differ";
    add("mode_shapes", title, &caption, &|name, title| {
        mode_shapes::draw(&drawn, &points, name, title)
    })?;
    let agreement = [
        compared.agreement(&report.first)?,
        compared.agreement(&report.last)?,
    ];
    let maps = mode_agreement(agreement);
    let least = |mac: fn(&Mode) -> Option<f64>| {
        Digits::Fixed(2).write(modes.iter().filter_map(mac).fold(1.0, f64::min))
    };
    let (first, last) = (least(|own| own.first_mac), least(|own| own.corrected_mac));
    let caption = format!(
        "cross-orthogonality and modal assurance criterion (MAC, not mass-weighted) of analysis and test modes, before and after. The \
         least MAC of a pair is {first} before and {last} after"
    );
    let title = "analysis against test modes before and after";
    let notes = [
        "Hundredths; an empty cell rounds to zero. Blue is positive, red negative.",
        "MAC: modal assurance criterion, which knows no mass.",
    ];
    add("agreement", title, &caption, &|name, title| {
        draw_by_twos(name, title, &maps, &notes)
    })?;
    let maps = derivative_maps(&derivatives, &report.result.parameter_names);
    let caption = derivatives_in_words(&maps[0]);
    let title = "derivatives of the first model";
    add("derivatives", title, &caption, &|name, title| {
        draw_derivatives(name, title, &maps)
    })?;
    Ok(figures)
}

/// Words for the parameters that move the frequencies most and least.
fn derivatives_in_words(HeatMap { values, rows, .. }: &HeatMap) -> String {
    let size = |row: &usize| -> f64 {
        let row = values.row(*row);
        row.iter().flatten().map(|value| value * value).sum()
    };
    let named = |row: Option<usize>| row.map_or("none", |row| &rows.1[row][..]);
    let by_size = |a: &usize, b: &usize| size(a).total_cmp(&size(b));
    format!(
        "derivatives of the frequencies and of the error sum at the first model. Parameter {} moves the frequencies most, {} least",
        named((0..values.nrows()).max_by(by_size)),
        named((0..values.nrows()).min_by(by_size)),
    )
}

/// Distances of the first and the corrected model's frequencies from the test's, percent.
fn frequencies(modes: &[Mode]) -> Factors {
    let row = |own: &Mode| DrawnFactor {
        name: format!("{}: {} Hz", own.mode, HERTZ.write(own.test_hz)),
        value: own.corrected_error_percent,
        from: Some(own.first_error_percent),
        ..DrawnFactor::default()
    };
    Factors {
        rows: modes.iter().map(row).collect(),
        limits: None,
        across: "frequency against the test's, percent",
        down: "test mode",
        origin: 0.0,
        decimals: 2,
    }
}

/// Cross-orthogonality $V_F^t M V_G$ (4) and modal assurance criterion of the exact solutions before and after, analysis modes by test
/// modes.
fn mode_agreement(both: [Agreement; 2]) -> Vec<HeatMap> {
    let map = |title: String, values: &DMatrix<f64>| HeatMap {
        title,
        rows: ("analysis mode".to_owned(), numbers(values.nrows())),
        columns: ("test mode".to_owned(), numbers(values.ncols())),
        values: values.map(Some),
        full: 1.0,
        written: (100.0, 0),
    };
    let both = || ["before", "after"].into_iter().zip(&both);
    let cross = both().filter_map(|(when, found)| {
        let title = format!("Cross-orthogonality {when}, mass-weighted");
        Some(map(title, found.orthogonality.as_ref()?))
    });
    let assurance =
        both().map(|(when, found)| map(format!("MAC {when}, not mass-weighted"), &found.assurance));
    cross.chain(assurance).collect()
}

/// Derivatives at the first model, parameters by test modes and by the error sum.
fn derivative_maps(derivatives: &Derivatives, names: &[String]) -> [HeatMap; 2] {
    let map = |title: &str, rows, columns: &str, labels, values: DMatrix<f64>| HeatMap {
        title: title.to_owned(),
        rows,
        columns: (columns.to_owned(), labels),
        full: values.amax(),
        values: values.map(Some),
        written: (1.0, 2),
    };
    let (frequency, error_sum) = (derivatives.frequency.clone(), &derivatives.error_sum);
    let error_sum = DMatrix::from_column_slice(error_sum.len(), 1, error_sum);
    let (percent, modes) = (
        "Percent of frequency for one percent of the parameter",
        numbers(frequency.ncols()),
    );
    [
        map(
            percent,
            ("parameter".to_owned(), names.to_vec()),
            "test mode",
            modes,
            frequency,
        ),
        map(
            "Error sum",
            // Those of the frequencies stand beside.
            (String::new(), Vec::new()),
            "percent points for",
            vec!["one percent of it".to_owned()],
            error_sum,
        ),
    ]
}
