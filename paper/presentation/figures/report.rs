//! The figures of any correlation: its structure, its modes, its history, its factors, and their uncertainty.

use super::error_history::{self, error_history};
use super::factors::{DrawnFactor, Factors};
use super::matrices::{HeatMap, draw_by_twos, draw_derivatives};
use super::mode_shapes::{self, differing, farthest};
use super::structure::{MOST_NUMBERS, draw_structure};
use super::{Figure, numbers};
use corfem::method::error::Error;
use corfem::method::error_sum::Errors;
use corfem::present::PresentError;
use corfem::present::frame::DrawnModes;
use corfem::present::report::Report;
use corfem::present::table::Digits;
use corfem::weighted::comparison::ExactResult;
use nalgebra::DMatrix;

/// Every figure of a report: structure, frequencies, mode shapes where sensors have places, errors against iteration, factors,
/// agreement of the modes before and after, and derivatives where there are any.
///
/// # Errors
/// [`PresentError::Drawing`]; the errors of [`DrawnModes::from_report`] and [`Report::agreement`].
pub fn report_figures(report: &Report) -> Result<Vec<Figure>, PresentError> {
    let mut figures = Vec::new();
    let mut add =
        |what: &str,
         title: &str,
         caption: &str,
         draw: &dyn Fn(&str, &str, f64) -> Result<String, PresentError>| {
            let name = format!("{}_{what}", report.name);
            let title = format!("{}: {title}", report.title);
            let caption = format!("{}: {caption}.", report.title);
            figures.push(Figure::drawn(&name, caption, |wide| {
                draw(&name, &title, wide)
            })?);
            Ok::<_, PresentError>(())
        };
    if !report.frame.is_empty() || report.sensors.iter().any(|sensor| sensor.place.is_some()) {
        let mut caption = "the structure".to_owned();
        for (is_drawn, words) in [
            (
                report.sensors.iter().any(|sensor| sensor.place.is_some()),
                ", its sensors named",
            ),
            (!report.supports.is_empty(), ", its supports black"),
            (
                (1..=MOST_NUMBERS).contains(&report.grids.len()),
                ", its grids numbered",
            ),
        ] {
            caption += if is_drawn { words } else { "" };
        }
        add("structure", "structure", &caption, &|name, title, wide| {
            draw_structure(name, title, report, wide)
        })?;
    }
    let frequencies = frequencies(report);
    if !frequencies.rows.is_empty() {
        let most = |off: fn(&DrawnFactor) -> f64| {
            let off = frequencies.rows.iter().map(|row| off(row).abs());
            Digits::Fixed(2).write(off.fold(0.0, f64::max))
        };
        let caption = format!(
            "how far every frequency is from the test's before and after: up to {} % before, up to {} % after",
            most(|row| row.from.unwrap_or_default()),
            most(|row| row.value),
        );
        add(
            "frequencies",
            "frequencies against the test's",
            &caption,
            &|name, title, wide| frequencies.draw(name, title, wide),
        )?;
    }
    if let Some(modes) = DrawnModes::from_report(report)? {
        for (part, modes) in mode_shapes::parts(&differing(&modes)) {
            let between = match report.moved {
                Some(_) => "the test is expanded by modes of the corrected model",
                None => "what lies between sensors is interpolated from those near it",
            };
            let [first, last] = [1, 2].map(|state| Digits::Fixed(2).write(farthest(&modes, state)));
            let caption = format!(
                "mode shapes of the test, of the first and of the corrected model, where the first model's are farther from the test's \
                 than on average: by up to {first} of the largest motion, and the corrected model's by up to {last}; {between}"
            );
            add(
                &format!("mode_shapes{part}"),
                "mode shapes that differ",
                &caption,
                &|name, title, wide| mode_shapes::draw(&modes, name, title, wide),
            )?;
        }
    }
    if !report.stages.is_empty() {
        let history = error_history(report);
        let sum = |errors: &Errors| Digits::Significant(2).write(100.0 * errors.sum());
        let ends = format!(
            "The error sum falls from {} to {} %",
            sum(&report.initial.errors),
            sum(&report.corrected().errors)
        );
        let caption = match history.iter().any(|pass| pass.is_inner) {
            true => format!(
                "errors against iteration. {ends}. Between exact solutions an inner loop steps by perturbation; at the end of a pass \
                the exact solution says what that was worth"
            ),
            false => format!("errors against iteration, every one solved exactly. {ends}"),
        };
        add(
            "errors",
            "errors against iteration",
            &caption,
            &|name, title, wide| error_history::draw(name, title, &history, wide),
        )?;
    }
    let factors = factors(report);
    let far = |row: &DrawnFactor| (row.value - 1.0).abs();
    let most = factors.rows.iter().max_by(|a, b| far(a).total_cmp(&far(b)));
    let most = most.map_or_else(String::new, |row| {
        let value = Digits::Fixed(3).write(row.value);
        format!(", farthest from one that of {}, {value}", row.name)
    });
    let mut caption = format!("factors on the first model{most}");
    for (is_drawn, words) in [
        (
            factors.draws_bounds(),
            "; bounds in blue where the axis reaches them",
        ),
        (
            report.deviations.iter().flatten().any(Option::is_some),
            "; bars are one standard deviation to either side",
        ),
    ] {
        caption += if is_drawn { words } else { "" };
    }
    add("factors", "factors", &caption, &|name, title, wide| {
        factors.draw(name, title, wide)
    })?;
    if report.test.len() > 0 {
        let maps = mode_agreement(report)?;
        let cross = if report.mass.is_some() {
            "cross-orthogonality and "
        } else {
            ""
        };
        let [first, last] = [&report.initial, report.corrected()].map(|check| {
            let found = report.agreement(check)?;
            let pairs = found.partners.iter().enumerate();
            let least = pairs
                .map(|(j, i)| found.assurance[(i - 1, j)])
                .fold(1.0, f64::min);
            Ok::<_, PresentError>(Digits::Fixed(2).write(least))
        });
        let caption = format!(
            "{cross}modal assurance criterion (MAC, not mass-weighted) of analysis and test modes, before and after. The least MAC of a \
             pair is {} before and {} after",
            first?, last?
        );
        add(
            "agreement",
            "analysis against test modes before and after",
            &caption,
            &|name, title, wide| {
                let note =
                    "Hundredths; an empty cell rounds to zero. Blue is positive, red negative.";
                draw_by_twos(
                    name,
                    title,
                    &maps,
                    &[note, "MAC: modal assurance criterion, which knows no mass."],
                    wide,
                )
            },
        )?;
    }
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
        add(
            "derivatives",
            "derivatives of the first model",
            &caption,
            &|name, title, wide| draw_derivatives(name, title, &maps, wide),
        )?;
    }
    Ok(figures)
}

/// Factors of the corrected model, with their uncertainties and bounds.
fn factors(report: &Report) -> Factors {
    let row = |(e, (name, value)): (usize, (&String, f64))| DrawnFactor {
        name: name.clone(),
        value,
        from: None,
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
        down: "parameter",
        origin: 1.0,
        decimals: 3,
        published: "right",
    }
}

/// Distances of the first and the corrected model's frequencies from the test's, percent.
fn frequencies(report: &Report) -> Factors {
    // Frequencies without shapes stand last.
    let of = |check: &ExactResult| {
        let all = check.modes.frequencies_hz();
        let lone = check.lone.iter().map(|lone| all[lone.partner]);
        check
            .frequencies_hz
            .iter()
            .copied()
            .chain(lone)
            .collect::<Vec<_>>()
    };
    let lone = report.initial.lone.iter().map(|lone| lone.frequency_hz);
    let tested = report.test.frequencies_hz().into_iter().chain(lone);
    let ends = of(&report.initial).into_iter().zip(of(report.corrected()));
    let row = |(mode, (hertz, (first, last))): (usize, (f64, (f64, f64)))| DrawnFactor {
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
        rows: tested.zip(ends).enumerate().map(row).collect(),
        limits: None,
        across: "frequency against the test's, percent".to_owned(),
        down: "test mode",
        origin: 0.0,
        decimals: 2,
        published: "",
    }
}

/// Cross-orthogonality $V_F^t M V_G$ (4), where there is a mass, and modal assurance criterion of the exact solutions before and
/// after, analysis modes by test modes.
///
/// # Errors
/// The errors of [`Report::agreement`].
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
