//! Which sensor of the test is which degree of freedom of the model.

use super::{Geometry, Job, ModelSource, SensorRule};
use crate::files::error::FileError;
use crate::files::test_data::{DIRECTIONS, Sensor, TestData};
use crate::studies::whole_model::SparseMatrix;
use nalgebra::Vector3;
use std::collections::BTreeMap;
use std::path::Path;

/// A sensor on the model.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedSensor {
    /// Its row in the test's shapes.
    pub row: usize,
    /// Its name.
    pub name: String,
    /// The model's grid.
    pub grid: usize,
    /// 0, 1, 2 for x, y, z; 3, 4, 5 for rotations about them.
    pub direction: usize,
    /// The unit vector along which it measures, or about which it turns, in global axes.
    pub axis: Vector3<f64>,
    /// −1 where it points the other way.
    pub sign: f64,
    /// Where the grid is.
    pub place: Option<Vector3<f64>>,
    /// How far the sensor is from it, in units of length, if the places of both are known.
    pub distance: Option<f64>,
}

/// Finds every sensor that is used on the model, and the matrix that reads them (sensors × DOF).
///
/// # Errors
/// [`FileError::Job`] for names that the test does not have, sensors without a grid or farther from one than the job allows,
/// degrees of freedom that do not move, and two sensors at one of them.
pub fn place(
    path: &Path,
    job: &Job,
    data: &TestData,
    source: &ModelSource,
) -> Result<(Vec<PlacedSensor>, SparseMatrix), FileError> {
    let rules = &job.sensors;
    let of_name = |name: &String| data.sensors.iter().position(|sensor| sensor.name == *name);
    let named = rules.leave_out.iter().chain(rules.place.iter().map(|place| &place.sensor));
    if let Some(unknown) = named.into_iter().find(|name| of_name(name).is_none()) {
        return Err(FileError::job(path, "names of sensors that the test has", unknown.clone()));
    }
    let mut placed = Vec::new();
    for (row, sensor) in data.sensors.iter().enumerate().filter(|(_, sensor)| !rules.leave_out.contains(&sensor.name)) {
        let own = rules.place.iter().find(|place| place.sensor == sensor.name);
        // A place of its own has an axis of the model's.
        let measured = sensor.axis.filter(|_| own.is_none());
        let (grid, direction, sign) = match (own, rules.by) {
            (Some(own), _) => {
                let (sign, letters) =
                    own.direction.strip_prefix('-').map_or((1.0, &own.direction[..]), |rest| (-1.0, rest));
                let direction = DIRECTIONS.iter().position(|name| *name == letters.trim());
                let wrong = || {
                    FileError::job(
                        path,
                        format!("a direction x, y, z or -x, -y, -z of sensor {}", sensor.name),
                        own.direction.clone(),
                    )
                };
                (own.grid, direction.ok_or_else(wrong)?, sign)
            }
            (None, SensorRule::Name) => continue,
            (None, SensorRule::Grid) => {
                let none = || FileError::job(path, format!("a grid for sensor {}", sensor.name), "none in the test");
                (sensor.grid.ok_or_else(none)?, sensor.direction, 1.0)
            }
            (None, SensorRule::Nearest) => (nearest(path, sensor, source)?, sensor.direction, 1.0),
        };
        let axis = measured.unwrap_or_else(|| Vector3::ith(direction % 3, 1.0));
        if motion(source, grid, direction, axis).next().is_none() {
            let expected = format!("a degree of freedom of the model that moves for sensor {}", sensor.name);
            return Err(FileError::job(path, expected, format!("grid {grid} {}", DIRECTIONS[direction])));
        }
        let place = source.geometry.places.get(&grid).copied();
        let distance = place.zip(sensor.place).map(|(a, b)| (a - b).norm());
        if let Some((distance, most)) = distance.zip(rules.distance).filter(|(distance, most)| distance > most) {
            let expected = format!("sensor {} within {most} of a grid", sensor.name);
            return Err(FileError::job(path, expected, format!("grid {grid} at {distance:.4}")));
        }
        placed.push(PlacedSensor { row, name: sensor.name.clone(), grid, direction, axis, sign, place, distance });
    }
    let mut first: BTreeMap<(usize, usize), &str> = BTreeMap::new();
    for sensor in &placed {
        if let Some(other) = first.insert((sensor.grid, sensor.direction), &sensor.name) {
            let found = format!("{other} and {} at grid {} {}", sensor.name, sensor.grid, DIRECTIONS[sensor.direction]);
            return Err(FileError::job(path, "one sensor a degree of freedom", found));
        }
    }
    if placed.is_empty() {
        return Err(FileError::job(path, "sensors of the test on the model", "none"));
    }
    let entries = placed.iter().enumerate().flat_map(|(row, sensor)| {
        let motion = motion(source, sensor.grid, sensor.direction, sensor.axis);
        motion.map(move |(dof, coefficient)| (row, dof, coefficient))
    });
    let entries = entries.collect();
    let reading = SparseMatrix::new("sensors", placed.len(), source.whole.dof_count(), entries)?;
    Ok((placed, reading))
}

/// The motion of a grid along an axis, or about it for directions above 2: rows of the model and coefficients.
fn motion(
    source: &ModelSource,
    grid: usize,
    direction: usize,
    axis: Vector3<f64>,
) -> impl Iterator<Item = (usize, f64)> {
    let along = (0..3).filter(move |&component| axis[component] != 0.0);
    along.flat_map(move |component| {
        let motion = source.motions.get(&(grid, direction / 3 * 3 + component)).into_iter().flatten();
        motion.map(move |&(dof, coefficient)| (dof, coefficient * axis[component]))
    })
}

/// The nearest grid that moves in a sensor's direction; of two as near the one with the lower number.
fn nearest(path: &Path, sensor: &Sensor, source: &ModelSource) -> Result<usize, FileError> {
    let missing = |what: &str| {
        FileError::job(path, format!("a place of sensor {} and of the model's grids", sensor.name), what.to_owned())
    };
    let at = sensor.place.ok_or_else(|| missing("none in the test"))?;
    let Geometry { places, .. } = &source.geometry;
    let axis = sensor.axis.unwrap_or_else(|| Vector3::ith(sensor.direction % 3, 1.0));
    let moving = places.iter().filter(|(grid, _)| motion(source, **grid, sensor.direction, axis).next().is_some());
    let nearest = moving.min_by(|a, b| (a.1 - at).norm().total_cmp(&(b.1 - at).norm()));
    nearest.map(|(grid, _)| *grid).ok_or_else(|| missing("none in the model"))
}
