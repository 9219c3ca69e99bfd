//! Results as plain rows that a script reads: one line a parameter, one line a sensor and mode.

use super::report::{Report, Stage};
use crate::files::test_data::quoted;
use crate::method::error::Error;
use crate::method::modes::Modes;
use crate::weighted::comparison::ExactResult;
use nalgebra::DVectorView;
use std::fmt::Write;

/// A row a parameter, `parameter,first,factor,deviation,low,high,test`: its first and its best factor, the standard deviation of this and
/// the ends of its 95 % interval, empty where there is none, and what the test says of it: `seen`, `mostly prior`, `at bound`, or
/// `group` and the others that it does not tell from it.
pub fn factor_rows(report: &Report) -> String {
    let mut text = "parameter,first,factor,deviation,low,high,test\n".to_owned();
    for (e, (name, factor)) in report.parameters.iter().zip(report.factors()).enumerate() {
        let interval = report.intervals.get(e).and_then(|it| it.as_ref().ok());
        let ends = interval.map_or(",".to_owned(), |ends| {
            format!("{},{}", ends.lower, ends.upper)
        });
        let deviation = report.deviations.as_ref().and_then(|all| all[e]);
        let deviation = deviation.map_or(String::new(), |deviation| deviation.to_string());
        let said = quoted(&said_of(report, e, factor));
        let _ = writeln!(
            text,
            "{},1,{factor},{deviation},{ends},{said}",
            quoted(name)
        );
    }
    text
}

/// Words for a parameter as the test sees it.
fn said_of(report: &Report, e: usize, factor: f64) -> String {
    let Some([_, seen]) = &report.seen else {
        return String::new();
    };
    let groups = seen.untold_groups().into_iter();
    let others = groups
        .filter(|group| group.contains(&e))
        .flatten()
        .filter(|&other| other != e);
    let others: Vec<&str> = others.map(|other| &report.parameters[other][..]).collect();
    match () {
        () if report.is_at_bound(e, factor) => "at bound".to_owned(),
        () if !others.is_empty() => format!("group: {}", others.join(", ")),
        () if seen.is_mostly_prior(e) => "mostly prior".to_owned(),
        () => "seen".to_owned(),
    }
}

/// A row a sensor and mode, `mode,sensor,test,first,corrected`: the shapes of test, first and corrected model, each of a largest component
/// of one and of the test's sign.
///
/// # Errors
/// Errors of [`Pairing::paired`](crate::method::sorting::Pairing::paired).
pub fn shape_rows(report: &Report) -> Result<String, Error> {
    let all = shapes(report)?;
    let mut text = "mode,sensor,test,first,corrected\n".to_owned();
    for mode in 0..report.test.len() {
        let unit = |shape: DVectorView<f64>| shape / shape.amax();
        let [test, first, last] = all.each_ref().map(|modes| unit(modes.shapes.column(mode)));
        for (sensor, point) in report.sensors.iter().enumerate() {
            let (number, name) = (report.mode_numbers[mode], quoted(&point.name));
            let [test, first, last] = [&test, &first, &last].map(|shape| shape[sensor]);
            let _ = writeln!(text, "{number},{name},{test},{first},{last}");
        }
    }
    Ok(text)
}

/// Modes of the test, and those paired with them of the first and of the corrected model, signed alike.
pub(super) fn shapes(report: &Report) -> Result<[Modes; 3], Error> {
    let best = report.best.and_then(|best| report.stages.get(best));
    let last: &ExactResult = best.map_or(&report.initial, |stage: &Stage| &stage.check);
    let paired = |of: &ExactResult| of.pairing.paired(&of.modes);
    Ok([report.test.clone(), paired(&report.initial)?, paired(last)?])
}

/// A row a residual, `mode,sensor,residual`, in standard deviations at the best factors, predicted ones of a mode that is held out, with an
/// empty sensor for a frequency.
pub fn residual_rows(report: &Report) -> String {
    let mut text = "mode,sensor,residual\n".to_owned();
    for own in &report.residuals {
        let _ = writeln!(text, "{},,{}", own.mode, own.frequency);
        for (point, residual) in report.sensors.iter().zip(&own.shape) {
            let _ = writeln!(text, "{},{},{residual}", own.mode, quoted(&point.name));
        }
    }
    text
}
