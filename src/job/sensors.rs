//! Matches the sensors of the test with degrees of freedom of the model.

use super::{Job, ModelSource, SensorRule};
use crate::{
    files::{
        error::{FileError, is_not},
        test_data::{DIRECTION, DIRECTIONS, Sensor, TestData, direction},
    },
    method::structure::StructuralDof,
    sparse::SparseMatrix,
};
use nalgebra::Vector3;

/// A sensor on the model.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedSensor {
    /// Row of the sensor in the test's shapes.
    pub row: usize,
    /// Name of the sensor.
    pub name: String,
    /// The model's grid.
    pub grid: usize,
    /// 0, 1, 2 for x, y, z; 3, 4, 5 for rotations about them.
    pub direction: usize,
    /// The unit vector along which it measures, or about which it turns, in global axes.
    pub axis: Vector3<f64>,
    /// Sign of its readings: −1 where it points the other way.
    pub sign: f64,
    /// Distance of the sensor from its grid, in units of length, if the positions of both are known.
    pub distance: Option<f64>,
}

/// The sensors in use on the model, and the matrix that reads them (sensors × DOF).
pub fn place(
    job: &Job,
    data: &TestData,
    source: &ModelSource,
) -> Result<(Vec<PlacedSensor>, SparseMatrix), FileError> {
    let rules = &job.sensors;
    let placed = rules.place.iter().map(|place| &place.sensor);
    for name in rules.leave_out.iter().chain(placed.clone()) {
        job.ensure(data.sensors.iter().any(|own| own.name == *name), || {
            format!("sensors: the test has no sensor {name}")
        })?;
    }
    job.once(placed, "sensors.place: sensor")?;
    job.ensure(
        !source.motions.is_empty() || data.sensors.is_empty(),
        || "model.rows is missing: these matrices do not name their rows",
    )?;
    let mut placed: Vec<PlacedSensor> = Vec::new();
    for (row, sensor) in data.sensors.iter().enumerate() {
        if rules.leave_out.contains(&sensor.name) {
            continue;
        }
        let Some(own) = on_model(job, (row, sensor), source)? else {
            continue;
        };
        let at = |other: &PlacedSensor| (other.grid, other.direction);
        if let Some(other) = placed.iter().find(|other| at(other) == at(&own)) {
            return Err(job.refused(format!(
                "sensors {} and {} are both at grid {}, direction {}",
                other.name, own.name, own.grid, DIRECTIONS[own.direction]
            )));
        }
        placed.push(own);
    }
    let shaped = data.shaped();
    let needs_none = shaped.iter().all(|mode| !job.selects(mode + 1));
    job.ensure(
        !placed.is_empty() || needs_none,
        || "no sensor of the test is on the model; see [sensors]",
    )?;
    let size = source.whole.dof_count();
    let of_row = |(row, own): (usize, &PlacedSensor)| {
        let motion = motion(source, own.grid, own.direction, own.axis);
        motion.map(move |(dof, coefficient)| (row, dof, coefficient))
    };
    let (mut rows, mut entries) = (placed.len(), Vec::new());
    entries.extend(placed.iter().enumerate().flat_map(of_row));
    if placed.is_empty() {
        // Frequencies alone are compared: the model keeps its shapes whole.
        (rows, entries) = (size, (0..size).map(|dof| (dof, dof, 1.0)).collect());
    }
    let reading = SparseMatrix::new("sensors", rows, size, entries)?;
    Ok((placed, reading))
}

/// A sensor, of a row of the test's shapes, on the model; none where the job places others by name alone.
fn on_model(
    job: &Job,
    (row, sensor): (usize, &Sensor),
    source: &ModelSource,
) -> Result<Option<PlacedSensor>, FileError> {
    let rules = &job.sensors;
    let own = rules.place.iter().find(|place| place.sensor == sensor.name);
    let refused = |reason: &str| job.refused(format!("sensor {}: {reason}", sensor.name));
    let (direction, sign) = match own {
        Some(own) => {
            direction(&own.direction).ok_or_else(|| refused(&is_not(&own.direction, DIRECTION)))?
        }
        None => (sensor.direction, 1.0),
    };
    // A sensor that the job places measures along an axis of the model.
    let axis = sensor.axis.filter(|_| own.is_none());
    let axis = axis.unwrap_or_else(|| Vector3::ith(direction % 3, 1.0));
    let moves = |grid: usize| motion(source, grid, direction, axis).next().is_some();
    let grid = match (own, rules.by) {
        (Some(own), _) => own.grid,
        (None, SensorRule::Name) => return Ok(None),
        (None, SensorRule::Grid) => sensor
            .grid
            .ok_or_else(|| refused("it has no grid in the test; place it in [sensors]"))?,
        (None, SensorRule::Nearest) => {
            let at = sensor.place.ok_or_else(|| {
                refused("the test does not say where it is, and by = \"nearest\"")
            })?;
            let moving = source.places.iter().filter(|own| moves(*own.0));
            let nearest = moving.min_by(|a, b| (a.1 - at).norm().total_cmp(&(b.1 - at).norm()));
            *nearest
                .ok_or_else(|| refused("no grid of the model that could move it has a place"))?
                .0
        }
    };
    if !moves(grid) {
        let direction = DIRECTIONS[direction];
        return Err(refused(&format!(
            "the model has no free degree of freedom at grid {grid}, direction {direction}"
        )));
    }
    let place = source.places.get(&grid).zip(sensor.place);
    let distance = place.map(|(a, b)| (a - b).norm());
    let most = rules.distance.unwrap_or(f64::INFINITY);
    let far = distance.unwrap_or_default();
    if !(0.0..=most).contains(&far) {
        return Err(refused(&format!(
            "grid {grid} is {far:.4} away; sensors.distance allows {most}"
        )));
    }
    Ok(Some(PlacedSensor {
        row,
        name: sensor.name.clone(),
        grid,
        direction,
        axis,
        sign,
        distance,
    }))
}

/// The motion of a grid along an axis, or about it for directions above 2: rows of the model and coefficients.
pub fn motion(
    source: &ModelSource,
    grid: usize,
    direction: usize,
    axis: Vector3<f64>,
) -> impl Iterator<Item = (usize, f64)> {
    (0..3)
        .filter(move |&component| axis[component] != 0.0)
        .flat_map(move |component| {
            let direction = direction / 3 * 3 + component;
            let motion = source.motions.get(&StructuralDof { grid, direction });
            let motion = motion.into_iter().flatten();
            motion.map(move |&(dof, coefficient)| (dof, coefficient * axis[component]))
        })
}
