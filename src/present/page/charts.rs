//! Factors as bars, matrices as colored cells, and pairs of frequencies: HTML that is as wide as it is given room.

use super::html::{escaped, scrolling};
use crate::method::error::Error;
use crate::method::step::Bounds;
use crate::present::report::Report;
use crate::present::table::{Digits, counted};
use crate::present::tables::HERTZ;
use crate::weighted::comparison::ExactResult;
use nalgebra::DMatrix;

/// A number with the sign for minus.
fn signed(text: String) -> String {
    text.replace('-', "−")
}

/// Steps of an axis that is logarithmic: those of one, two and five times powers of ten that lie within it, or even ones where it is
/// short.
fn ticks(low: f64, high: f64) -> Vec<f64> {
    let decade = low.log10().floor() as i32;
    let all =
        (decade..decade + 40).flat_map(|ten| [1.0, 2.0, 5.0].map(|part| part * 10f64.powi(ten)));
    let within: Vec<f64> = all.filter(|tick| (low..=high).contains(tick)).collect();
    let many = within.len().div_ceil(5).max(1);
    if within.len() > 2 {
        // One, from which factors are drawn, is always among them.
        let one = within.iter().position(|tick| *tick == 1.0).unwrap_or(0);
        return within.into_iter().skip(one % many).step_by(many).collect();
    }
    let rough = (high - low) / 6.0;
    let ten = 10f64.powf(rough.log10().floor());
    let steps = [1.0, 2.0, 2.5, 5.0, 10.0].map(|part| part * ten);
    let step = steps.into_iter().find(|step| *step >= rough).unwrap_or(ten);
    let first = (low / step).ceil() as i64;
    let last = (high / step).floor() as i64;
    (first..=last).map(|row| step * row as f64).collect()
}

/// A number of an axis in its shortest form.
fn short(tick: f64) -> String {
    let digits = Digits::Significant(3).write(tick);
    match digits.contains('.') {
        true => digits
            .trim_end_matches('0')
            .trim_end_matches('.')
            .to_owned(),
        false => digits,
    }
}

/// The ends of a parameter's interval, if it has one.
fn interval(report: &Report, e: usize) -> Option<&Bounds> {
    report.intervals.get(e)?.as_ref().ok()
}

/// A logarithmic axis from one value to another.
struct Axis(f64, f64);

impl Axis {
    /// An axis that holds all factors of a report, and intervals that are not much longer.
    fn of_factors(report: &Report) -> Self {
        let factors = report.factors();
        let known = (0..factors.len()).filter_map(|e| interval(report, e));
        let known = known.flat_map(|ends| [ends.lower, ends.upper]);
        let known = known.filter(|end| (0.2..5.0).contains(end));
        let all = factors
            .into_iter()
            .filter(|factor| *factor > 0.0)
            .chain(known);
        let (low, high) = all.fold((1.0 / 1.1, 1.1), |(low, high): (f64, f64), value| {
            (low.min(value), high.max(value))
        });
        Self(low / 1.02, high * 1.02)
    }

    /// The part of the axis before a value, 0 to 1.
    fn part(&self, value: f64) -> f64 {
        let Self(low, high) = self;
        ((value / low).ln() / (high / low).ln()).clamp(0.0, 1.0)
    }

    /// The place of a value as a length of a style sheet.
    fn percent(&self, value: f64) -> String {
        format!("{:.2}%", 100.0 * self.part(value))
    }
}

/// One row of [`factor_bars`].
fn factor_row(report: &Report, axis: &Axis, e: usize, factor: f64) -> String {
    let place = |value: f64| axis.percent(value);
    let class = match () {
        () if report.is_unseen(e) => " class=\"unseen\"",
        () if report.is_at_bound(e, factor) => " class=\"bound\"",
        () => "",
    };
    let interval = interval(report, e).map_or(String::new(), |ends| {
        let (left, right) = (place(ends.lower), place(ends.upper));
        format!("<s style=\"left:{left};right:calc(100% - {right})\"></s>")
    });
    let deviation = report.log_deviation(e).map_or(String::new(), |deviation| {
        let percent = Digits::Significant(2).write(100.0 * deviation);
        format!(" <small>± {percent} %</small>")
    });
    format!(
        "<tr{class}><th scope=\"row\">{}</th><td class=\"track\"><u style=\"left:{}\"></u><i style=\"left:{};right:calc(100% - {})\"></i>{interval}\
        <b style=\"left:{}\"></b></td><td>{}{deviation}</td></tr>\n",
        escaped(&report.parameters[e]),
        place(1.0),
        place(factor.min(1.0)),
        place(factor.max(1.0)),
        place(factor),
        Digits::Fixed(3).write(factor),
    )
}

/// Factors as bars from one on a logarithmic axis, the surest change first: gray where known mostly from the prior, open at a bound, a
/// line over the 95 % interval.
pub fn factor_bars(report: &Report) -> String {
    let (factors, axis) = (report.factors(), Axis::of_factors(report));
    // Letters at an end would stand in the next column.
    let is_inside = |tick: &f64| (0.03..0.97).contains(&axis.part(*tick));
    let ticks: String = ticks(axis.0, axis.1)
        .into_iter()
        .filter(is_inside)
        .map(|tick| {
            format!(
                "<span style=\"left:{}\">{}</span>",
                axis.percent(tick),
                short(tick)
            )
        })
        .collect();
    let order = report.by_sureness().into_iter();
    let rows: String = order
        .map(|e| factor_row(report, &axis, e, factors[e]))
        .collect();
    let mut caption =
        "Factors on the first model, the surest change first, on a logarithmic axis.".to_owned();
    let any = |is_so: &dyn Fn(usize) -> bool| (0..factors.len()).any(is_so);
    for (is_so, words) in [
        (
            any(&|e| interval(report, e).is_some()),
            " Lines: 95 % intervals.",
        ),
        (
            any(&|e| report.is_unseen(e)),
            " Gray: the test hardly sees it.",
        ),
        (
            any(&|e| report.is_at_bound(e, factors[e])),
            " Open: at a bound.",
        ),
    ] {
        caption += if is_so { words } else { "" };
    }
    format!(
        "<figure class=\"bars\" id=\"{}_factors\">\n<table>\n<thead><tr><th scope=\"col\">Parameter</th><td class=\"ticks\">{ticks}</td>\
        <th scope=\"col\">Factor</th></tr></thead>\n<tbody>\n{rows}</tbody>\n</table>\n<figcaption>{caption}</figcaption>\n</figure>\n",
        escaped(&report.name),
    )
}

/// A matrix as a table of colored cells.
struct Heat<'a> {
    id: &'a str,
    caption: String,
    corner: &'a str,
    rows: Vec<String>,
    columns: Vec<String>,
    values: DMatrix<f64>,
    /// Magnitude that has the full color.
    full: f64,
    /// Factor on a number that is written, and its decimals.
    written: (f64, usize),
    /// Row of the cell of each column that has a frame.
    framed: &'a [usize],
}

impl Heat<'_> {
    fn draw(&self) -> String {
        let heads: String = self
            .columns
            .iter()
            .map(|name| format!("<th scope=\"col\">{}</th>", escaped(name)))
            .collect();
        let mut rows = String::new();
        for (i, name) in self.rows.iter().enumerate() {
            rows += &format!("<tr><th scope=\"row\">{}</th>", escaped(name));
            for (j, value) in self.values.row(i).iter().enumerate() {
                let (factor, decimals) = self.written;
                let number = signed(Digits::Fixed(decimals).write(factor * value));
                let strength = (value.abs() / self.full.max(f64::MIN_POSITIVE)).min(1.0);
                let is_zero = number.chars().all(|c| matches!(c, '0' | '.'));
                let sign = if *value < 0.0 { "minus" } else { "plus" };
                let framed = if self.framed.get(j) == Some(&i) {
                    " framed"
                } else {
                    ""
                };
                rows += &format!(
                    "<td class=\"{sign}{framed}\" style=\"--v:{strength:.2}\">{}</td>",
                    if is_zero { "" } else { &number }
                );
            }
            rows += "</tr>\n";
        }
        let body = format!(
            "<table class=\"heat\">\n<thead><tr><th scope=\"col\">{}</th>{heads}</tr></thead>\n<tbody>\n{rows}</tbody>\n</table>",
            self.corner
        );
        format!(
            "<figure id=\"{}\">\n{}<figcaption>{}</figcaption>\n</figure>\n",
            escaped(self.id),
            scrolling(&self.caption, &body),
            escaped(&self.caption)
        )
    }
}

/// The place of the largest of numbers, the first place without any.
fn largest(numbers: impl Iterator<Item = f64>) -> usize {
    let largest = numbers.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
    largest.map_or(0, |(place, _)| place)
}

/// The numbers of the test modes in the test's file.
fn mode_labels(report: &Report, count: usize) -> Vec<String> {
    (0..count)
        .map(|place| report.mode_number(place).to_string())
        .collect()
}

/// Modal assurance of the modes of the first and of the corrected model and the test's, the pairs framed; nothing without shapes.
///
/// # Errors
/// The errors of [`Report::agreement`].
pub fn assurance_maps(report: &Report) -> Result<String, Error> {
    if report.test.len() == 0 {
        return Ok(String::new());
    }
    let [first, last] = [&report.initial, report.corrected()];
    let maps = [("before", first), ("after", last)].map(|(when, check)| {
        let found = report.agreement(check)?;
        let pairs = &check.pairing.analysis_mode;
        let (mut worst, mut most, mut least) = ((0, 0), 0.0, 1.0_f64);
        for (j, column) in found.assurance.column_iter().enumerate() {
            for (i, value) in column.iter().enumerate() {
                if pairs[j] == i {
                    least = least.min(*value);
                } else if *value > most {
                    (worst, most) = ((i, j), *value);
                }
            }
        }
        let caption = format!(
            "Modal assurance (MAC) of analysis modes (down) and test modes (across), in hundredths, {when} the correction; pairs are \
            framed. The least of a pair is {least:.2}; the most of any other is {most:.2}, analysis mode {} with test mode {}.",
            worst.0 + 1,
            report.mode_number(worst.1)
        );
        let rows = (1..=found.assurance.nrows()).map(|number| number.to_string());
        let heat = Heat {
            id: &format!("{}_agreement_{when}", report.name),
            caption,
            corner: when,
            rows: rows.collect(),
            columns: mode_labels(report, pairs.len()),
            values: found.assurance,
            full: 1.0,
            written: (100.0, 0),
            framed: pairs,
        };
        Ok(heat.draw())
    });
    maps.into_iter().collect()
}

/// Residuals at the best factors in standard deviations, by sensor and test mode; nothing where they are not known.
pub fn residual_map(report: &Report) -> String {
    /// Deviations that have the full color: noise alone is beyond them in 3 of 1000 residuals.
    const FULL: f64 = 3.0;
    if report.residuals.is_empty() {
        return String::new();
    }
    let sensors = report
        .residuals
        .iter()
        .map(|own| own.shape.len())
        .max()
        .unwrap_or(0);
    let names = report
        .sensors
        .iter()
        .take(sensors)
        .map(|sensor| sensor.name.clone());
    let rows: Vec<String> = ["frequency".to_owned()].into_iter().chain(names).collect();
    let values = DMatrix::from_fn(rows.len(), report.residuals.len(), |i, j| {
        let own = &report.residuals[j];
        match i {
            0 => own.frequency,
            _ => own.shape.get(i - 1).copied().unwrap_or(0.0),
        }
    });
    let rms = |i: usize| values.row(i).norm() / (values.ncols() as f64).sqrt();
    let worst = largest((0..rows.len()).map(rms));
    let caption = format!(
        "Residuals at the best factors in standard deviations, by sensor (down) and test mode (across); {FULL:.0} and more have the full \
        color. Largest over all modes: {}, {:.1} deviations RMS.",
        rows[worst],
        rms(worst)
    );
    Heat {
        id: &format!("{}_residuals", report.name),
        caption,
        corner: "Sensor",
        rows,
        columns: mode_labels(report, values.ncols()),
        values,
        full: FULL,
        written: (1.0, 1),
        framed: &[],
    }
    .draw()
}

/// Derivatives of the frequencies at the first model, parameters by test modes; nothing where they were not taken.
pub fn derivative_map(report: &Report) -> String {
    let Some(derivatives) = &report.derivatives else {
        return String::new();
    };
    let values = derivatives.frequency.clone();
    let most = largest(values.row_iter().map(|row| row.norm()));
    let caption = format!(
        "Percent of a test mode's frequency (across) for one percent of a parameter (down), at the first model. {} moves them most.",
        report.parameters.get(most).map_or("None", String::as_str)
    );
    Heat {
        id: &format!("{}_derivatives", report.name),
        caption,
        corner: "Parameter",
        rows: report.parameters.clone(),
        columns: mode_labels(report, values.ncols()),
        full: values.amax(),
        values,
        written: (1.0, 2),
        framed: &[],
    }
    .draw()
}

/// Frequencies of a model paired with the test modes, those without shapes last, Hz, and those of its other modes.
fn paired_hertz(check: &ExactResult) -> (Vec<f64>, Vec<f64>) {
    let all = check.modes.frequencies_hz();
    let lone: Vec<usize> = check.lone.iter().map(|lone| lone.partner).collect();
    let paired = check.frequencies_hz.iter().copied();
    let own = paired
        .chain(lone.iter().map(|&partner| all[partner]))
        .collect();
    let taken = |mode: usize| lone.contains(&mode) || check.pairing.analysis_mode.contains(&mode);
    let others = all.iter().enumerate().filter(|(mode, _)| !taken(*mode));
    (own, others.map(|(_, hertz)| *hertz).collect())
}

/// Side of the plot of pairs, room of its axes, and radius of its marks.
const PLOT: [f64; 3] = [400.0, 54.0, 4.5];
/// Distance from equal frequencies that lines of the plot of pairs mark, a fraction: as near as models are customarily asked to come to
/// their test.
const NEAR: f64 = 0.05;

impl Axis {
    /// Place along the plot of pairs.
    fn x(&self, hertz: f64) -> f64 {
        PLOT[1] + (PLOT[0] - PLOT[1] - 8.0) * self.part(hertz)
    }

    /// Place down the plot of pairs.
    fn y(&self, hertz: f64) -> f64 {
        PLOT[0] - self.x(hertz)
    }

    /// A line of the plot of pairs.
    fn line(&self, class: &str, [a, b]: [f64; 2], [c, d]: [f64; 2]) -> String {
        let (x1, y1, x2, y2) = (self.x(a), self.y(b), self.x(c), self.y(d));
        format!("<path class=\"{class}\" d=\"M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}\"/>\n")
    }

    /// Axes of the plot of pairs, the line of equal frequencies, and those near it.
    fn frame(&self) -> String {
        let (&Self(low, high), [size, room, _]) = (self, PLOT);
        let mut svg = String::new();
        for tick in ticks(low, high) {
            svg += &self.line("grid", [tick, low], [tick, high]);
            svg += &self.line("grid", [low, tick], [high, tick]);
            let (word, x, y) = (short(tick), self.x(tick), self.y(tick) + 5.0);
            let (down, left) = (size - room + 19.0, room - 6.0);
            svg += &format!(
                "<text x=\"{x:.1}\" y=\"{down:.1}\" text-anchor=\"middle\">{word}</text>\n"
            );
            svg +=
                &format!("<text x=\"{left:.1}\" y=\"{y:.1}\" text-anchor=\"end\">{word}</text>\n");
        }
        let near = 1.0 + NEAR;
        svg += &self.line("equal", [low, low], [high, high]);
        svg += &self.line("near", [low, low * near], [high / near, high]);
        svg += &self.line("near", [low * near, low], [high, high / near]);
        let (middle, end, up) = (0.5 * (size + room), size - 6.0, 0.5 * (size - room));
        svg += &format!(
            "<text x=\"{middle:.1}\" y=\"{end:.1}\" text-anchor=\"middle\">measured, Hz</text>\n"
        );
        svg += &format!(
            "<text transform=\"translate(11 {up:.1})rotate(-90)\" text-anchor=\"middle\">computed, Hz</text>\n"
        );
        svg
    }
}

/// Computed against measured frequencies on logarithmic axes, with lines of ±5 %: open circles of the first model, full ones of the
/// corrected one, and open squares at the edges of what has no partner between the first and the last frequency.
pub fn pairing_plot(report: &Report) -> String {
    let [size, room, radius] = PLOT;
    let lone = report.initial.lone.iter().map(|lone| lone.frequency_hz);
    let test: Vec<f64> = report
        .test
        .frequencies_hz()
        .into_iter()
        .chain(lone)
        .collect();
    let (first, _) = paired_hertz(&report.initial);
    let (last, others) = paired_hertz(report.corrected());
    let all = test.iter().chain(&first).chain(&last).copied();
    let (least, most) = all.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), hertz| {
        (low.min(hertz), high.max(hertz))
    });
    if test.is_empty() || least <= 0.0 {
        return String::new();
    }
    let is_within = |hertz: &f64| (least..=most).contains(hertz);
    let others: Vec<f64> = others.into_iter().filter(is_within).collect();
    let axis = Axis(least / 1.12, most * 1.12);
    let mut svg = axis.frame();
    for (class, hertz) in [("open", &first), ("full", &last)] {
        for (place, (&test, &hertz)) in test.iter().zip(hertz).enumerate() {
            let (x, y, mode) = (axis.x(test), axis.y(hertz), report.mode_number(place));
            let [test, hertz] = [test, hertz].map(|hertz| HERTZ.write(hertz));
            svg += &format!(
                "<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\"><title>mode {mode}: {test} Hz measured, {hertz} Hz \
                computed</title></circle>\n"
            );
        }
    }
    let square = |x: f64, y: f64| {
        let (x, y) = (x - radius, y - radius);
        format!("<rect class=\"open\" x=\"{x:.1}\" y=\"{y:.1}\" width=\"9\" height=\"9\"/>\n")
    };
    let left_out = report.left_out.iter().filter(|(_, hertz)| is_within(hertz));
    svg.extend(others.iter().map(|&hertz| square(room, axis.y(hertz))));
    svg.extend(left_out.map(|&(_, hertz)| square(axis.x(hertz), size - room)));
    let off = last.iter().zip(&test).map(|(last, test)| last / test - 1.0);
    let caption = pairing_caption(report, &off.collect::<Vec<_>>(), others.len());
    format!(
        "<figure class=\"pairing\" id=\"{}_frequencies\">\n<svg viewBox=\"0 0 {size} {size}\" role=\"img\" aria-label=\"Computed against measured \
        frequencies\">\n{svg}</svg>\n<figcaption>{caption}</figcaption>\n</figure>\n",
        escaped(&report.name),
    )
}

/// Words under the plot of pairs: how many are near, which is farthest off, and how many modes of the model have no partner.
fn pairing_caption(report: &Report, off: &[f64], others: usize) -> String {
    let within = off.iter().filter(|off| off.abs() <= NEAR).count();
    let far = largest(off.iter().map(|off| off.abs()));
    // Rounding first keeps a minus sign off zero.
    let percent = (1e4 * off[far]).round() / 100.0 + 0.0;
    let mut caption = format!(
        "Computed against measured frequencies, Hz: open before, full after the correction. {within} of {} lie within the dashed ±5 %; \
        farthest is mode {}, {} %.",
        off.len(),
        report.mode_number(far),
        signed(format!("{percent:+.2}"))
    );
    for (count, words) in [
        (
            others,
            "of the model at the left edge, between the first and the last frequency",
        ),
        (report.left_out.len(), "of the test at the lower edge"),
    ] {
        if count > 0 {
            caption += &format!(
                " Without a partner: {} {words}.",
                counted(count, "mode", "modes")
            );
        }
    }
    caption
}
