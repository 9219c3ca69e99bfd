//! The paper's cases and two wings as subjects.

use super::{Derivatives, SensorPoint, Subject};
use crate::present::PresentError;
use crate::studies::delta_wing::DeltaWing;
use crate::studies::delta_wing::correlation::{
    GROUPS, Group, WingCorrelation, correlate_wing, first_model, measured_grids,
};
use crate::studies::known::recovered;
use crate::torque_box::CaseResult;
use crate::torque_box::wing_box::dynamic_points;
use nalgebra::Vector3;

/// Grids of the box's root, rear and front.
const ROOT: [usize; 2] = [13, 15];

impl Subject {
    /// A case of the paper: its nine dynamic points on the mid-plane of the box.
    ///
    /// # Errors
    /// Those of the model and its analysis.
    pub fn of_case(result: &CaseResult) -> Result<Self, PresentError> {
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
        Ok(Self {
            title: format!("Case {}", case.number),
            solver: result.solver.to_owned(),
            ranges: model.factor_ranges()?,
            sensors: points.iter().enumerate().map(sensor).collect(),
            frame: bays
                .map(|(pair, a, b)| vec![pair[0][a], pair[0][b], pair[1][b], pair[1][a]])
                .collect(),
            supports: root.to_vec(),
            mass: Some(case.reconstruction.mass()),
            tolerances: Some([
                case.settings.inner.tolerance,
                case.settings.later_inner_tolerance,
            ]),
            derivatives: Some(Derivatives::of(&first)?),
            ..Self::of(
                &format!("case_{}", case.number),
                names,
                test,
                &run.initial,
                Some(run),
            )
        })
    }

    /// The delta wing with wrong gages.
    ///
    /// # Errors
    /// Those of its model.
    pub fn of_wing(wing: &DeltaWing, run: &WingCorrelation) -> Result<Self, PresentError> {
        let names = GROUPS.map(|group| group.name.to_owned());
        let model = first_model(wing)?;
        let structure = model.structure();
        let place = |label| {
            structure
                .grids()
                .iter()
                .find(|grid| grid.label == label)
                .map(|grid| grid.position)
        };
        let sensor = |label| up(format!("{label} z"), place(label).unwrap_or_default());
        let held = structure.grids().iter().filter(|grid| grid.constrained[2]);
        let first = model.analyze(&[1.0; GROUPS.len()], &run.test, None)?;
        Ok(Self {
            title: "Delta wing with wrong gages".to_owned(),
            solver: run.solver.to_owned(),
            ranges: model.factor_ranges()?,
            supports: held.map(|grid| grid.position).collect(),
            sensors: measured_grids(structure).into_iter().map(sensor).collect(),
            mass: Some(model.condense(&[1.0; GROUPS.len()])?.mass),
            derivatives: Some(Derivatives::of(&first)?),
            truth: GROUPS.iter().map(Group::true_factor).collect(),
            ..Self::of(
                "delta_wing",
                &names,
                &run.test,
                &run.correlation.initial,
                Some(&run.correlation),
            )
            .on(structure)
        })
    }

    /// Delta wing and the wing of [`recovered`], each correlated from wrong gages.
    ///
    /// # Errors
    /// Those of both correlations, and of [`Self::of_wing`].
    pub fn wings() -> Result<[Self; 2], PresentError> {
        let (wing, (known, run)) = (DeltaWing::embedded()?, recovered()?);
        let names: Vec<String> = known
            .model
            .parameters()
            .iter()
            .map(|group| group.name.clone())
            .collect();
        let (title, ranges) = (
            "Wing of 1,458 DOF with wrong gages".to_owned(),
            known.model.factor_ranges()?,
        );
        let large = Self::of("wing", &names, &known.test, &run.initial, Some(&run))
            .on(known.model.structure());
        let delta = Self::of_wing(&wing, &correlate_wing(&wing, |_, _| {})?)?;
        Ok([
            delta,
            Self {
                title,
                ranges,
                truth: known.truth,
                ..large
            },
        ])
    }
}

/// A sensor that measures upward.
fn up(name: String, place: Vector3<f64>) -> SensorPoint {
    SensorPoint {
        name,
        place: Some(place),
        direction: Vector3::z(),
    }
}
