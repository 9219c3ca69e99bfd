//! Matches the sensors of the test with degrees of freedom of the model.

use super::{Job, ModelSource, SensorRule};
use crate::{
    files::{
        error::{FileError, ensure, is_not},
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
    /// Position of the grid.
    pub place: Option<Vector3<f64>>,
    /// Distance of the sensor from its grid, in units of length, if the positions of both are known.
    pub distance: Option<f64>,
}

/// The sensors on the model, and the matrix that reads them (sensors × DOF).
type Placed = (Vec<PlacedSensor>, SparseMatrix);

/// Places every sensor in use on the model.
pub fn place(job: &Job, data: &TestData, source: &ModelSource) -> Result<Placed, FileError> {
    let rules = &job.sensors;
    let placed = rules.place.iter().map(|place| &place.sensor);
    for name in rules.leave_out.iter().chain(placed.clone()) {
        ensure(data.sensors.iter().any(|own| own.name == *name), || {
            job.refused(format!("sensors: the test has no sensor {name}"))
        })?;
    }
    job.once(placed, "sensors.place: sensor")?;
    ensure(
        !source.motions.is_empty() || data.sensors.is_empty(),
        || job.refused("model.rows is missing: these matrices do not name their rows"),
    )?;
    let mut placed: Vec<PlacedSensor> = Vec::new();
    for (row, sensor) in data.sensors.iter().enumerate() {
        if rules.leave_out.contains(&sensor.name) {
            continue;
        }
        let Some(own) = on_model(job, (row, sensor), source)? else {
            continue;
        };
        let is_there =
            |other: &&PlacedSensor| (other.grid, other.direction) == (own.grid, own.direction);
        if let Some(other) = placed.iter().find(is_there) {
            let (direction, grid) = (DIRECTIONS[own.direction], own.grid);
            let (other, name) = (&other.name, &own.name);
            return Err(job.refused(format!(
                "sensors {other} and {name} are both at grid {grid}, direction {direction}"
            )));
        }
        placed.push(own);
    }
    let shaped = data.shaped();
    let needs_none = shaped.iter().all(|mode| !job.selects(mode + 1));
    ensure(!placed.is_empty() || needs_none, || {
        job.refused("no sensor of the test is on the model; see [sensors]")
    })?;
    let size = source.whole.dof_count();
    let (rows, entries) = match placed.is_empty() {
        // Frequencies alone are compared: the model keeps its shapes whole.
        true => (size, (0..size).map(|dof| (dof, dof, 1.0)).collect()),
        false => {
            let of_row = |(row, own): (usize, &PlacedSensor)| {
                let motion = motion(source, own.grid, own.direction, own.axis);
                motion.map(move |(dof, coefficient)| (row, dof, coefficient))
            };
            let entries = placed.iter().enumerate().flat_map(of_row);
            (placed.len(), entries.collect())
        }
    };
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
    let (grid, direction, sign) = match (own, rules.by) {
        (Some(own), _) => {
            let (direction, sign) = direction(&own.direction).ok_or_else(|| {
                let reason = is_not(&own.direction, DIRECTION);
                job.refused(format!("sensor {}: {reason}", sensor.name))
            })?;
            (own.grid, direction, sign)
        }
        (None, SensorRule::Name) => return Ok(None),
        (None, SensorRule::Grid) => {
            let none = || {
                job.refused(format!(
                    "sensor {} has no grid in the test; place it in [sensors]",
                    sensor.name
                ))
            };
            (sensor.grid.ok_or_else(none)?, sensor.direction, 1.0)
        }
        (None, SensorRule::Nearest) => (nearest(job, sensor, source)?, sensor.direction, 1.0),
    };
    // A sensor that the job places measures along an axis of the model.
    let measured = sensor.axis.filter(|_| own.is_none());
    let axis = measured.unwrap_or_else(|| Vector3::ith(direction % 3, 1.0));
    let mut moves = motion(source, grid, direction, axis);
    ensure(moves.next().is_some(), || {
        job.refused(format!(
            "sensor {}: the model has no free degree of freedom at grid {grid}, direction {}",
            sensor.name, DIRECTIONS[direction]
        ))
    })?;
    let place = source.geometry.places.get(&grid).copied();
    let distance = place.zip(sensor.place).map(|(a, b)| (a - b).norm());
    let most = rules.distance.unwrap_or(f64::INFINITY);
    let far = distance.unwrap_or_default();
    ensure((0.0..=most).contains(&far), || {
        job.refused(format!(
            "sensor {}: grid {grid} is {far:.4} away; sensors.distance allows {most}",
            sensor.name
        ))
    })?;
    Ok(Some(PlacedSensor {
        row,
        name: sensor.name.clone(),
        grid,
        direction,
        axis,
        sign,
        place,
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
            source
                .motions
                .get(&StructuralDof {
                    grid,
                    direction: direction / 3 * 3 + component,
                })
                .into_iter()
                .flatten()
                .map(move |&(dof, coefficient)| (dof, coefficient * axis[component]))
        })
}

/// The nearest grid that moves in a sensor's direction; ties go to the lower number.
fn nearest(job: &Job, sensor: &Sensor, source: &ModelSource) -> Result<usize, FileError> {
    let missing = |reason| {
        let name = &sensor.name;
        job.refused(format!(
            "sensor {name} cannot be placed at the nearest grid: {reason}"
        ))
    };
    let at = sensor
        .place
        .ok_or_else(|| missing("the test does not say where it is"))?;
    let axis = sensor
        .axis
        .unwrap_or_else(|| Vector3::ith(sensor.direction % 3, 1.0));
    let moving = source.geometry.places.iter().filter(|(grid, _)| {
        motion(source, **grid, sensor.direction, axis)
            .next()
            .is_some()
    });
    let nearest = moving.min_by(|a, b| (a.1 - at).norm().total_cmp(&(b.1 - at).norm()));
    nearest
        .map(|(grid, _)| *grid)
        .ok_or_else(|| missing("no grid of the model that could move it has a place"))
}
