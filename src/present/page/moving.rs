//! The structure of a report, moving in its modes: test, first and corrected model side by side, for `moving.js`.

use super::html::escaped;
use crate::present::PresentError;
use crate::present::frame::{DrawnMode, DrawnModes, extents};
use crate::present::report::Report;
use crate::present::tables::HERTZ;
use nalgebra::Vector3;
use serde_json::{Value, json};

/// Part of the largest extent that a height is drawn as at least, and the most times that it is drawn larger for it.
const HEIGHT: (f64, f64) = (0.3, 7.0);
/// Extent, of the largest, below which there is no height to enlarge.
const FLAT: f64 = 1e-6;

/// Script of all moving structures of a page.
pub const SCRIPT: &str = include_str!("moving.js");

/// The structure as a figure with its controls and data, which calls [`SCRIPT`]; nothing where no place is known.
///
/// # Errors
/// The errors of [`DrawnModes::from_report`] and [`Report::agreement`].
pub fn moving(report: &Report) -> Result<String, PresentError> {
    let Some(drawn) = DrawnModes::from_report(report)? else {
        return Ok(String::new());
    };
    let name = escaped(&report.name);
    let shown = report
        .verdict
        .as_ref()
        .map_or(0, |verdict| verdict.worst_mode);
    let modes = drawn.modes.iter().enumerate().map(|(place, mode)| {
        let checked = if place == shown { " checked" } else { "" };
        let (number, hertz) = (mode.number, HERTZ.write(mode.hertz[0]));
        format!("<label><input type=\"radio\" name=\"{name}-mode\" value=\"{place}\"{checked}>{number}: {hertz} Hz</label>\n")
    });
    let modes: String = modes.collect();
    let mut colors = "<option value=\"motion\">motion</option>".to_owned();
    if drawn
        .frame
        .pieces
        .iter()
        .any(|(_, owners)| !owners.is_empty())
    {
        colors += "<option value=\"factors\">factors</option>";
        for (e, parameter) in report.parameters.iter().enumerate() {
            colors += &format!(
                "<option value=\"{e}\">where {} is</option>",
                escaped(parameter)
            );
        }
    }
    if report.residuals.iter().any(|own| !own.shape.is_empty()) {
        colors += "<option value=\"residuals\">residuals at sensors</option>";
    }
    // A name may hold what ends a script.
    let data = data(report, &drawn)?.to_string().replace('<', "\\u003c");
    // Every second piece is the name of a place to fill; what fills it may hold such a name.
    let title = escaped(&report.title);
    let pieces = include_str!("moving.html").split('@').enumerate();
    let pieces = pieces.map(|(row, piece)| match (row % 2, piece) {
        (0, words) => words,
        (_, "NAME") => &name,
        (_, "TITLE") => &title,
        (_, "MODES") => &modes,
        (_, "COLORS") => &colors,
        (_, "CAPTION") => caption(report),
        _ => &data,
    });
    Ok(pieces.collect())
}

/// A sentence on the test's shapes between the sensors.
fn caption(report: &Report) -> &'static str {
    match &report.moved {
        _ if report.test.len() == 0 => "The test has frequencies alone.",
        Some([test, ..]) if !test.is_empty() => {
            "Between its sensors (dots) the test moves as the corrected model does."
        }
        _ => "What lies between sensors (dots) is interpolated from those near it.",
    }
}

/// Everything that the script draws: places about their middle in units of the largest extent, motions in thousandths of the largest.
fn data(report: &Report, drawn: &DrawnModes) -> Result<Value, PresentError> {
    let frame = &drawn.frame;
    let extent = extents(&frame.nodes);
    let size = extent.max().max(f64::MIN_POSITIVE);
    let low = frame
        .nodes
        .iter()
        .copied()
        .reduce(|low, node| low.inf(&node));
    let middle = low.unwrap_or_default() + 0.5 * extent;
    let (part, most) = HEIGHT;
    let heights = match extent.z > FLAT * size {
        true => (part * size / extent.z).round().clamp(1.0, most),
        false => 1.0,
    };
    let place = |node: &Vector3<f64>| {
        let place = (node - middle) / size;
        place
            .iter()
            .map(|part| (1e4 * part).round() / 1e4)
            .collect::<Value>()
    };
    let thousandths = |moved: &Vec<Vector3<f64>>| -> Value {
        let parts = moved.iter().flat_map(|motion| motion.iter().copied());
        parts.map(|part| (1e3 * part).round() as i64).collect()
    };
    let sensors = frame
        .known
        .iter()
        .flat_map(|(node, sensors)| sensors.iter().map(move |(row, _)| [*node, *row]));
    let factors = report.factors();
    let parameter = |e: usize| json!({ "change": factors[e].ln(), "isSeen": !report.is_unseen(e) });
    let [first, corrected] = [&report.initial, report.corrected()];
    let agreements = [report.agreement(first)?, report.agreement(corrected)?];
    let mode = |(place, mode): (usize, &DrawnMode)| {
        let assurance = (place < report.test.len()).then(|| {
            [(first, &agreements[0]), (corrected, &agreements[1])]
                .map(|(check, found)| found.assurance[(check.pairing.analysis_mode[place], place)])
        });
        let own = report.residuals.get(place).map(|own| &own.shape);
        let off = [1, 2].map(|state| 100.0 * (mode.hertz[state] / mode.hertz[0] - 1.0));
        json!({
            "number": mode.number,
            "hertz": mode.hertz.map(|hertz| HERTZ.write(hertz)),
            "off": off,
            "assurance": assurance,
            "residuals": own.filter(|own| !own.is_empty()),
            "moved": mode.moved.each_ref().map(thousandths),
        })
    };
    let pieces = frame.pieces.iter();
    let pieces = pieces.map(|(nodes, owners)| json!({ "nodes": nodes, "owners": owners }));
    let parameters = (0..report.parameters.len()).map(parameter);
    Ok(json!({
        "heights": heights,
        "places": frame.nodes.iter().map(place).collect::<Vec<Value>>(),
        "pieces": pieces.collect::<Vec<_>>(),
        "sensors": sensors.collect::<Vec<_>>(),
        "parameters": parameters.collect::<Vec<_>>(),
        "modes": drawn.modes.iter().enumerate().map(mode).collect::<Vec<_>>(),
    }))
}
