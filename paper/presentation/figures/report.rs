//! The figures of a case's correlation: its frequencies, its modes, its history and its derivatives.

use super::error_history;
use super::factors::{DrawnFactor, Factors};
use super::matrices::{HeatMap, draw_by_twos, draw_derivatives};
use super::mode_shapes::{self, differing, farthest};
use super::{Figure, numbers};
use corfem::method::error::Error;
use corfem::method::error_sum::Errors;
use corfem::present::PresentError;
use corfem::present::frame::DrawnModes;
use corfem::present::report::Report;
use corfem::present::table::Digits;
use nalgebra::DMatrix;

/// Every figure of a report: frequencies, errors against iteration, mode shapes, agreement of the modes before and after, and
/// derivatives where there are any.
///
/// # Errors
/// [`PresentError::Drawing`]; the errors of [`DrawnModes::from_report`] and [`Report::agreement`].
pub fn report_figures(report: &Report) -> Result<Vec<Figure>, PresentError> {
    let mut figures = Vec::new();
    let mut add = |what: &str,
                   title: &str,
                   caption: &str,
                   draw: &dyn Fn(&str, &str) -> Result<String, PresentError>| {
        let name = format!("{}_{what}", report.name);
        let title = format!("{}: {title}", report.title);
        let caption = format!("{}: {caption}.", report.title);
        figures.push(Figure::drawn(&name, caption, &draw(&name, &title)?));
        Ok::<_, PresentError>(())
    };
    let frequencies = frequencies(report);
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
        sum(&report.initial.errors),
        sum(&report.corrected().errors)
    );
    add(
        "errors",
        "errors against iteration",
        &caption,
        &|name, title| error_history::draw(name, title, report),
    )?;
    if let Some(modes) = DrawnModes::from_report(report)? {
        let modes = differing(&modes);
        let [first, last] = [1, 2].map(|state| Digits::Fixed(2).write(farthest(&modes, state)));
        let caption = format!(
            "mode shapes of the test, of the first and of the corrected model, where the first model's are farther from the test's \
             than on average: by up to {first} of the largest motion, and the corrected model's by up to {last}; what lies between \
             sensors is interpolated from those near it"
        );
        let title = "mode shapes that differ";
        add("mode_shapes", title, &caption, &|name, title| {
            mode_shapes::draw(&modes, name, title)
        })?;
    }
    let maps = mode_agreement(report)?;
    let [first, last] = [&report.initial, report.corrected()].map(|check| {
        let found = report.agreement(check)?;
        let pairs = found.partners.iter().enumerate();
        let least = pairs
            .map(|(j, i)| found.assurance[(i - 1, j)])
            .fold(1.0, f64::min);
        Ok::<_, PresentError>(Digits::Fixed(2).write(least))
    });
    let caption = format!(
        "cross-orthogonality and modal assurance criterion (MAC, not mass-weighted) of analysis and test modes, before and after. The \
         least MAC of a pair is {} before and {} after",
        first?, last?
    );
    let title = "analysis against test modes before and after";
    let notes = [
        "Hundredths; an empty cell rounds to zero. Blue is positive, red negative.",
        "MAC: modal assurance criterion, which knows no mass.",
    ];
    add("agreement", title, &caption, &|name, title| {
        draw_by_twos(name, title, &maps, &notes)
    })?;
    if let Some(maps) = derivatives(report) {
        let sizes: Vec<f64> = maps[0]
            .values
            .row_iter()
            .map(|row| row.iter().flatten().map(|value| value * value).sum())
            .collect();
        let named = |row: Option<usize>| {
            row.and_then(|row| report.parameters.get(row))
                .map_or("none", String::as_str)
        };
        let by_size = |&a: &usize, &b: &usize| sizes[a].total_cmp(&sizes[b]);
        let caption = format!(
            "derivatives of the frequencies and of the error sum at the first model. Parameter {} moves the frequencies most, {} least",
            named((0..sizes.len()).max_by(by_size)),
            named((0..sizes.len()).min_by(by_size)),
        );
        let title = "derivatives of the first model";
        add("derivatives", title, &caption, &|name, title| {
            draw_derivatives(name, title, &maps)
        })?;
    }
    Ok(figures)
}

/// Distances of the first and the corrected model's frequencies from the test's, percent.
fn frequencies(report: &Report) -> Factors {
    let tested = report.test.frequencies_hz().into_iter();
    let ends = [&report.initial, report.corrected()].map(|check| check.frequencies_hz.iter());
    let [first, last] = ends;
    let row = |(mode, (hertz, (first, last))): (usize, (f64, (&f64, &f64)))| DrawnFactor {
        name: format!(
            "{}: {} Hz",
            report.mode_number(mode),
            Digits::Significant(4).write(hertz)
        ),
        value: 100.0 * (last / hertz - 1.0),
        from: Some(100.0 * (first / hertz - 1.0)),
        ..DrawnFactor::default()
    };
    Factors {
        rows: tested.zip(first.zip(last)).enumerate().map(row).collect(),
        limits: None,
        across: "frequency against the test's, percent",
        down: "test mode",
        origin: 0.0,
        decimals: 2,
    }
}

/// Cross-orthogonality $V_F^t M V_G$ (4), where there is a mass, and modal assurance criterion of the exact solutions before and
/// after, analysis modes by test modes.
fn mode_agreement(report: &Report) -> Result<Vec<HeatMap>, Error> {
    let map = |title: String, values: &DMatrix<f64>| {
        let rows = ("analysis mode".to_owned(), numbers(values.nrows()));
        let columns = (
            "test mode".to_owned(),
            mode_labels(report, report.test.len()),
        );
        HeatMap {
            title,
            rows,
            columns,
            values: values.map(Some),
            full: 1.0,
            written: (100.0, 0),
        }
    };
    let both = [
        ("before", report.agreement(&report.initial)?),
        ("after", report.agreement(report.corrected())?),
    ];
    let cross = both.iter().filter_map(|(when, found)| {
        Some(map(
            format!("Cross-orthogonality {when}, mass-weighted"),
            found.orthogonality.as_ref()?,
        ))
    });
    let assurance = both
        .iter()
        .map(|(when, found)| map(format!("MAC {when}, not mass-weighted"), &found.assurance));
    Ok(cross.chain(assurance).collect())
}

/// The numbers of the test modes in the test's file.
fn mode_labels(report: &Report, count: usize) -> Vec<String> {
    (0..count)
        .map(|place| report.mode_number(place).to_string())
        .collect()
}

/// Derivatives at the first model, parameters by test modes and by the error sum.
fn derivatives(report: &Report) -> Option<[HeatMap; 2]> {
    let derivatives = report.derivatives.as_ref()?;
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
        mode_labels(report, frequency.ncols()),
    );
    Some([
        map(
            percent,
            ("parameter".to_owned(), report.parameters.clone()),
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
    ])
}
