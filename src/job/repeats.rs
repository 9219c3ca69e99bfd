//! Repeated tests: their mean, and the standard deviations that their scatter gives.

use super::Job;
use super::prepared::FLOOR;
use crate::files::error::{FileError, ensure};
use crate::files::test_data::{self, Sensor, TestData};
use crate::method::linear_algebra::symmetric_eigen;
use nalgebra::{DMatrix, DVector};
use std::path::PathBuf;

impl Job {
    /// The test, or the mean of its repeats ([`mean_of`]).
    ///
    /// # Errors
    /// [`FileError::Refused`] unless the job names one test or several repeats; the errors of its files.
    pub(super) fn measured(&self) -> Result<TestData, FileError> {
        let read = |file: &PathBuf, entry: &str| {
            let file = self.beside(file);
            test_data::read(&file.display().to_string(), &self.bytes(&file, entry)?)
        };
        match (&self.test.file, &self.test.repeats[..]) {
            (Some(file), []) => read(file, "test.file"),
            (None, repeats @ [_, _, ..]) => {
                let tests = repeats.iter().map(|file| read(file, "test.repeats"));
                mean_of(self, &tests.collect::<Result<Vec<_>, _>>()?)
            }
            _ => Err(self.refused("[test] must name either a file, or two or more repeats")),
        }
    }
}

/// The mean of repeated tests with the deviations of its numbers.
///
/// Sensors go by name, grid and direction in whatever order, modes by their order. A shape has any scale and sign in each test. The
/// common shape $m$ is the one nearest to all of them at unit length, their leading singular vector, and each counts as $a u$ with
/// $m^t a u = m^t m$: one sum for all orders of the tests, and nothing is left of the scale, which is free in the residuals too.
///
/// All components of a shape, and all frequencies, have one variance. Of $R$ tests the squares $q$ of the deviations of $n$ free numbers
/// from the mean give it as $q/(R (n (R - 1) - 2))$: one over it is right in the mean. A shape of $d$ components has $d - 1$ free numbers.
///
/// # Errors
/// [`FileError::Refused`] naming the file for sensors or modes that the first does not have, for shapes of modal assurance below
/// [`FLOOR`] with the common one, and for numbers that never differ.
///
/// Source: Anderson, *An Introduction to Multivariate Statistical Analysis*, 3rd ed. (2003), section 7.7.
fn mean_of(job: &Job, tests: &[TestData]) -> Result<TestData, FileError> {
    let repeats = &job.test.repeats;
    let first = &tests[0];
    let (modes, sensors) = (first.frequencies_hz.len(), first.sensors.len());
    let mut rows = Vec::new();
    for (test, file) in tests.iter().zip(repeats) {
        if let Some(mode) = test.rigid.first() {
            let (file, mode) = (file.display(), mode + 1);
            return Err(job.refused(format!(
                "test.repeats: mode {mode} of {file} has a frequency of 0 Hz; leave rigid-body modes out of repeated tests"
            )));
        }
        let place = |wanted| {
            let known = |sensor| key(sensor) == key(wanted);
            test.sensors.iter().position(known)
        };
        let found: Option<Vec<usize>> = first.sensors.iter().map(place).collect();
        let fits = (test.frequencies_hz.len(), &test.alone, test.sensors.len())
            == (modes, &first.alone, sensors);
        match found.filter(|_| fits) {
            Some(found) => rows.push(found),
            None => {
                let (file, first) = (file.display(), repeats[0].display());
                return Err(job.refused(format!(
                    "test.repeats: {file} has not the sensors, modes and shapes of {first}"
                )));
            }
        }
    }
    let mut of_frequencies = DMatrix::zeros(modes, tests.len());
    let mut data = TestData {
        frequency_deviation: None,
        shape_deviation: None,
        ..first.clone()
    };
    for mode in 0..modes {
        let hertz = DVector::from_iterator(
            tests.len(),
            tests.iter().map(|test| test.frequencies_hz[mode]),
        );
        data.frequencies_hz[mode] = hertz.mean();
        let relative = hertz / data.frequencies_hz[mode];
        of_frequencies.set_row(mode, &relative.add_scalar(-1.0).transpose());
        if data.alone.contains(&mode) {
            continue;
        }
        let shapes = tests.iter().zip(&rows);
        let shapes = shapes.map(|(test, rows)| test.shapes.column(mode).select_rows(rows));
        let mut shapes = DMatrix::from_columns(&shapes.collect::<Vec<_>>());
        shapes
            .column_iter_mut()
            .for_each(|mut shape| shape /= shape.norm());
        let (_, vectors) = symmetric_eigen("closeness of repeats", &shapes.tr_mul(&shapes))?;
        let common = (&shapes * vectors.column(tests.len() - 1)).normalize();
        let along = shapes.tr_mul(&common);
        for (file, along) in repeats.iter().zip(&along) {
            let assurance = along.powi(2);
            ensure(assurance >= FLOOR, || {
                let (file, mode) = (file.display(), mode + 1);
                job.refused(format!(
                    "test.repeats: mode {mode} of {file} is unlike the others: modal assurance {assurance:.2} with their common shape"
                ))
            })?;
        }
        let sign = along[0].signum();
        for (mut shape, along) in shapes.column_iter_mut().zip(&along) {
            shape *= sign / along;
        }
        let mean = shapes.column_mean();
        let largest = mean.amax();
        shapes
            .column_iter_mut()
            .for_each(|mut shape| shape -= &mean);
        let apart = shapes / largest;
        data.shapes.set_column(mode, &(mean / largest));
        if sensors > 1 {
            let what = format!("the shape of mode {}", mode + 1);
            let own = deviations(job, &apart, sensors - 1, &what)?;
            data.component_deviation.insert(mode, own);
        }
    }
    let own = deviations(job, &of_frequencies, modes, "frequencies")?;
    data.frequency_deviation = Some(own.data.into());
    Ok(data)
}

fn key(sensor: &Sensor) -> (&str, Option<usize>, usize) {
    (&sensor.name, sensor.grid, sensor.direction)
}

/// Standard deviations of the means of some numbers that are `apart` from these (numbers × tests), `free` of them independent.
fn deviations(
    job: &Job,
    apart: &DMatrix<f64>,
    free: usize,
    what: &str,
) -> Result<DVector<f64>, FileError> {
    let (tests, count) = (apart.ncols(), apart.ncols() as f64);
    let variance = apart.norm_squared() / (free as f64 * (count - 1.0) - 2.0);
    ensure(variance > 0.0 && variance < f64::INFINITY, || {
        job.refused(format!(
            "test.repeats: {tests} tests do not tell the deviations of {what}; name more, or one as test.file with deviations"
        ))
    })?;
    Ok(DVector::from_element(
        apart.nrows(),
        (variance / count).sqrt(),
    ))
}
