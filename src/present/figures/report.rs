//! The figures of any correlation: its structure, its modes, its history, its factors, and how well they are known.

use super::error_history::{self, error_history};
use super::factors::{DrawnFactor, Factors};
use super::matrices::{HeatMap, draw_by_twos, draw_derivatives};
use super::mode_shapes::DrawnModes;
use super::structure::draw_structure;
use super::{Figure, numbers};
use crate::method::error::Error;
use crate::present::PresentError;
use crate::present::report::Report;
use nalgebra::DMatrix;

/// Every figure of a report: structure, mode shapes and node lines where sensors have places, errors against iteration, factors,
/// agreement of the modes before and after, and derivatives where there are any.
///
/// # Errors
/// Those of [`DrawnModes::from_report`] and [`Report::agreement`]; [`PresentError::Drawing`].
pub fn report_figures(report: &Report) -> Result<Vec<Figure>, PresentError> {
    let mut figures = Vec::new();
    let mut add = |what: &str,
                   title: &str,
                   caption: &str,
                   draw: &dyn Fn(&str, &str) -> Result<String, PresentError>| {
        let name = format!("{}_{what}", report.name);
        let svg = draw(&name, &format!("{}: {title}", report.title))?;
        figures.push(Figure::new(
            &name,
            format!("{}: {caption}.", report.title),
            svg,
        ));
        Ok::<_, PresentError>(())
    };
    if !report.frame.is_empty() || report.sensors.iter().any(|sensor| sensor.place.is_some()) {
        let caption = "the structure, with what is known of its sensors, grids and supports";
        add("structure", "structure", caption, &|name, title| {
            draw_structure(name, title, report)
        })?;
    }
    if let Some(modes) = DrawnModes::from_report(report)? {
        for (part, modes) in modes.parts() {
            let between = match report.moved {
                Some(_) => "the test is expanded by modes of the corrected model",
                None => "what lies between sensors is interpolated from those near it",
            };
            let caption = format!(
                "mode shapes of the test, of the first and of the corrected model, the largest measured displacement of each the \
                 same; {between}"
            );
            add(
                &format!("mode_shapes{part}"),
                "mode shapes",
                &caption,
                &|name, title| modes.draw(name, title),
            )?;
            if let Some(normal) = modes.normal() {
                let caption = "node lines in plan, interpolated between the sensors and left out beside supports, where nothing is \
                    measured; at a sensor, gray is up in the test and larger is farther";
                let draw = |name: &str, title: &str| modes.draw_node_lines(name, title, normal);
                add(&format!("node_lines{part}"), "node lines", caption, &draw)?;
            }
        }
    }
    if !report.stages.is_empty() {
        let history = error_history(report);
        let caption = "errors against iteration. Between exact solutions an inner loop steps by perturbation; the gap at the end \
            of a pass is what freezing the transformation cost";
        add(
            "errors",
            "errors against iteration",
            caption,
            &|name, title| error_history::draw(name, title, &history),
        )?;
    }
    let factors = factors(report);
    let has_bars = report.deviations.iter().flatten().any(Option::is_some);
    let bars = if has_bars {
        "; bars are one standard deviation to either side"
    } else {
        ""
    };
    let caption = format!("factors on the first model, with the bounds of each in blue{bars}");
    add("factors", "factors", &caption, &|name, title| {
        factors.draw(name, title)
    })?;
    let maps = mode_agreement(report)?;
    let cross = if report.mass.is_some() {
        "cross-orthogonality and "
    } else {
        ""
    };
    let caption = format!(
        "{cross}modal assurance criterion (MAC, not mass-weighted) of analysis and test modes, before and after"
    );
    add(
        "agreement",
        "analysis against test modes before and after",
        &caption,
        &|name, title| {
            let note = "Hundredths; an empty cell rounds to zero. Blue is positive, red negative.";
            draw_by_twos(
                name,
                title,
                &maps,
                &[note, "MAC: modal assurance criterion, which knows no mass."],
            )
        },
    )?;
    if let Some(maps) = derivatives(report) {
        let caption = "derivatives of the frequencies and of the error sum at the first model";
        add(
            "derivatives",
            "derivatives of the first model",
            caption,
            &|name, title| draw_derivatives(name, title, &maps),
        )?;
    }
    Ok(figures)
}

/// Factors of the corrected model, with their uncertainties and bounds.
fn factors(report: &Report) -> Factors {
    let row = |(e, (name, value)): (usize, (&String, f64))| DrawnFactor {
        name: name.clone(),
        value,
        deviation: report
            .deviations
            .as_ref()
            .and_then(|deviations| *deviations.get(e)?),
        published: report.truth.get(e).copied(),
        bounds: report.ranges.get(e).copied().flatten(),
        remark: report.is_at_bound(e, value).then_some("at bound"),
    };
    Factors {
        rows: report
            .parameters
            .iter()
            .zip(report.factors())
            .enumerate()
            .map(row)
            .collect(),
        limits: None,
        across: "factor on the first model".to_owned(),
        decimals: 3,
        published: "right",
    }
}

/// Cross-orthogonality $V_F^t M V_G$ (4), where there is a mass, and modal assurance criterion of the exact solutions before and
/// after, analysis modes by test modes.
///
/// # Errors
/// Those of [`Report::agreement`].
pub fn mode_agreement(report: &Report) -> Result<Vec<HeatMap>, Error> {
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
pub fn derivatives(report: &Report) -> Option<[HeatMap; 2]> {
    let derivatives = report.derivatives.as_ref()?;
    let map = |title: &str, rows: &str, columns: &str, labels, values: DMatrix<f64>| HeatMap {
        title: title.to_owned(),
        rows: (rows.to_owned(), report.parameters.clone()),
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
        map(percent, "parameter", "test mode", modes, frequency),
        map(
            "Error sum",
            "",
            "percent points for",
            vec!["one percent of it".to_owned()],
            error_sum,
        ),
    ])
}
