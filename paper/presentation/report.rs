//! The paper's cases as reports.

use corfem::job::verdict::Verdict;
use corfem::method::structure::Grid;
use corfem::present::PresentError;
use corfem::present::report::{Derivatives, Report, SensorPoint};
use corfem::torque_box::CaseResult;
use corfem::torque_box::wing_box::dynamic_points;
use corfem::weighted::comparison::{Comparison, ExactResult};
use nalgebra::{DMatrix, DVectorView, Vector3};

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

/// A case of the paper with its whole box: elements, the panels that they belong to, and the motion of every grid, which follows the
/// dynamic points by $B$; the test's by that of the last model.
///
/// # Errors
/// Those of the model and its analysis.
pub fn moving_case(result: &CaseResult) -> Result<Report, PresentError> {
    let (model, report) = (result.case.model()?, case_report(result)?);
    let structure = model.structure();
    let owners = structure.elements().iter().map(|element| {
        let parameters = model.parameters().iter().enumerate();
        let of = parameters.filter(|(_, parameter)| parameter.elements.contains(&element.label));
        of.map(|(e, _)| e).collect()
    });
    let followed = |factors: &[f64], shapes: &DMatrix<f64>| -> Result<_, PresentError> {
        let transformation = model.condense(factors)?.transformation;
        let all = transformation * shapes;
        let motion = |shape: DVectorView<f64>, grid: &Grid| {
            Vector3::from_fn(|direction, _| {
                let dof = structure.free_dof_index(grid.label, direction);
                dof.map_or(0.0, |row| shape[row])
            })
        };
        let grids = || structure.grids().iter();
        let of_mode = |shape| grids().map(|grid| motion(shape, grid)).collect();
        Ok(all.column_iter().map(of_mode).collect::<Vec<Vec<_>>>())
    };
    let (ones, last) = (vec![1.0; report.parameters.len()], report.factors());
    let paired = |check: &ExactResult| check.pairing.paired(&check.modes);
    let (first, corrected) = (paired(&report.initial)?, paired(report.corrected())?);
    let moved = [
        followed(&last, result.test.shapes())?,
        followed(&ones, first.shapes())?,
        followed(&last, corrected.shapes())?,
    ];
    Ok(Report {
        owners: owners.collect(),
        moved: Some(moved),
        ..report.with_structure(structure)
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
