//! Matches the sensors of the test with degrees of freedom of the model.

use super::{Job, ModelSource, SensorRule};
use crate::files::error::{FileError, ensure, is_not};
use crate::files::test_data::{DIRECTION, DIRECTIONS, Sensor, TestData, direction};
use crate::method::structure::StructuralDof;
use crate::sparse::SparseMatrix;
use nalgebra::Vector3;
use std::collections::BTreeMap;

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
pub(super) fn place(job: &Job, data: &TestData, source: &ModelSource) -> Result<Placed, FileError> {
    let rules = &job.sensors;
    let named = rules
        .leave_out
        .iter()
        .chain(rules.place.iter().map(|place| &place.sensor));
    for name in named {
        ensure(data.sensors.iter().any(|own| own.name == *name), || {
            job.refused(format!("sensors: the test has no sensor {name}"))
        })?;
    }
    job.once(
        rules.place.iter().map(|place| &place.sensor),
        "sensors.place: sensor",
    )?;
    ensure(
        !source.motions.is_empty() || data.sensors.is_empty(),
        || job.refused("model.rows is missing: these matrices do not name their rows"),
    )?;
    let mut placed = Vec::new();
    for (row, sensor) in data
        .sensors
        .iter()
        .enumerate()
        .filter(|(_, sensor)| !rules.leave_out.contains(&sensor.name))
    {
        let own = rules.place.iter().find(|place| place.sensor == sensor.name);
        // A sensor that the job places measures along an axis of the model.
        let measured = sensor.axis.filter(|_| own.is_none());
        let (grid, direction, sign) = match (own, rules.by) {
            (Some(own), _) => {
                let (direction, sign) = direction(&own.direction).ok_or_else(|| {
                    let reason = is_not(&own.direction, DIRECTION);
                    job.refused(format!("sensor {}: {reason}", sensor.name))
                })?;
                (own.grid, direction, sign)
            }
            (None, SensorRule::Name) => continue,
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
        let axis = measured.unwrap_or_else(|| Vector3::ith(direction % 3, 1.0));
        ensure(
            motion(source, grid, direction, axis).next().is_some(),
            || {
                job.refused(format!(
                "sensor {}: the model has no free degree of freedom at grid {grid}, direction {}",
                sensor.name, DIRECTIONS[direction]
            ))
            },
        )?;
        let place = source.geometry.places.get(&grid).copied();
        let distance = place.zip(sensor.place).map(|(a, b)| (a - b).norm());
        let most = rules.distance.unwrap_or(f64::INFINITY);
        ensure(
            distance.is_none_or(|far| (0.0..=most).contains(&far)),
            || {
                let far = distance.unwrap_or_default();
                job.refused(format!(
                    "sensor {}: grid {grid} is {far:.4} away; sensors.distance allows {most}",
                    sensor.name
                ))
            },
        )?;
        placed.push(PlacedSensor {
            row,
            name: sensor.name.clone(),
            grid,
            direction,
            axis,
            sign,
            place,
            distance,
        });
    }
    let mut first: BTreeMap<StructuralDof, &str> = BTreeMap::new();
    for PlacedSensor {
        name,
        grid,
        direction,
        ..
    } in &placed
    {
        let dof = StructuralDof {
            grid: *grid,
            direction: *direction,
        };
        if let Some(other) = first.insert(dof, name) {
            let direction = DIRECTIONS[*direction];
            return Err(job.refused(format!(
                "sensors {other} and {name} are both at grid {grid}, direction {direction}"
            )));
        }
    }
    let shaped = data.shaped();
    let needs_none = shaped.iter().all(|mode| !job.selects(mode + 1));
    ensure(!placed.is_empty() || needs_none, || {
        job.refused("no sensor of the test is on the model; see [sensors]")
    })?;
    let dof_count = source.whole.dof_count();
    if placed.is_empty() {
        // Frequencies alone are compared: the model keeps its shapes whole.
        let all = (0..dof_count).map(|dof| (dof, dof, 1.0)).collect();
        return Ok((
            placed,
            SparseMatrix::new("sensors", dof_count, dof_count, all)?,
        ));
    }
    let entries = placed.iter().enumerate().flat_map(|(row, sensor)| {
        let motion = motion(source, sensor.grid, sensor.direction, sensor.axis);
        motion.map(move |(dof, coefficient)| (row, dof, coefficient))
    });
    let reading = SparseMatrix::new("sensors", placed.len(), dof_count, entries.collect())?;
    Ok((placed, reading))
}

/// The motion of a grid along an axis, or about it for directions above 2: rows of the model and coefficients.
pub(super) fn motion(
    source: &ModelSource,
    grid: usize,
    direction: usize,
    axis: Vector3<f64>,
) -> impl Iterator<Item = (usize, f64)> {
    let along = (0..3).filter(move |&component| axis[component] != 0.0);
    along.flat_map(move |component| {
        let direction = direction / 3 * 3 + component;
        let motion = source.motions.get(&StructuralDof { grid, direction });
        motion
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
    let places = source.geometry.places.iter();
    let moving = places.filter(|(grid, _)| {
        motion(source, **grid, sensor.direction, axis)
            .next()
            .is_some()
    });
    let nearest = moving.min_by(|a, b| (a.1 - at).norm().total_cmp(&(b.1 - at).norm()));
    nearest
        .map(|(grid, _)| *grid)
        .ok_or_else(|| missing("no grid of the model that could move it has a place"))
}
