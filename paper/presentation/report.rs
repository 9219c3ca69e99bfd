//! The paper's cases as reports.

use corfem::job::verdict::Verdict;
use corfem::present::PresentError;
use corfem::present::report::{Derivatives, Report, SensorPoint};
use corfem::torque_box::CaseResult;
use corfem::torque_box::wing_box::dynamic_points;
use corfem::weighted::comparison::{Comparison, ExactResult};
use nalgebra::Vector3;

/// Grids of the box's root, rear and front.
const ROOT: [usize; 2] = [13, 15];

/// A case of the paper: its nine dynamic points on the mid-plane of the box.
///
/// # Errors
/// Those of the model and its analysis.
pub fn case_report(result: &CaseResult) -> Result<Report, PresentError> {
    let CaseResult {
        case,
        parameter_names: names,
        test,
        correlation: run,
        ..
    } = result;
    let model = case.model()?;
    let first = model.analyze(&vec![1.0; names.len()], test, None)?;
    let points = dynamic_points(&case.reconstruction)?;
    let [rear, front] = ROOT.map(|grid| {
        case.reconstruction
            .grids
            .get(&grid)
            .copied()
            .unwrap_or_default()
    });
    let [rear, front] = [rear, front].map(|[x, y, _]| Vector3::new(x, y, 0.0));
    let root = [
        rear,
        rear + case.reconstruction.mid_chord_fraction * (front - rear),
        front,
    ];
    let rows: Vec<&[Vector3<f64>]> = points.chunks(3).chain([&root[..]]).collect();
    let bays = rows
        .windows(2)
        .flat_map(|pair| [[0, 1], [1, 2]].map(|[a, b]| (pair, a, b)));
    let sensor = |(row, &at)| up(format!("D{}", row + 1), at);
    Ok(Report {
        title: format!("Case {}", case.number),
        ranges: model.factor_ranges()?,
        sensors: points.iter().enumerate().map(sensor).collect(),
        frame: bays
            .map(|(pair, a, b)| vec![pair[0][a], pair[0][b], pair[1][b], pair[1][a]])
            .collect(),
        supports: root.to_vec(),
        mass: Some(case.reconstruction.mass()),
        settings: Some(case.settings.clone()),
        derivatives: Some(Derivatives::at(&Comparison::from(&first))?),
        verdict: Some(Verdict::of_case(result)),
        ..Report::from_correlation(
            &format!("case_{}", case.number),
            names,
            test,
            &ExactResult::from(&run.initial),
            Some(run),
        )
    })
}

/// A sensor that measures upward.
fn up(name: String, place: Vector3<f64>) -> SensorPoint {
    SensorPoint {
        name,
        place: Some(place),
        direction: Vector3::z(),
    }
}
