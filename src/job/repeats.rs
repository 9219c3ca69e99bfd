//! Repeated tests: their mean, and the standard deviations that their scatter gives.

use super::{Job, pairs::FLOOR};
use crate::{
    files::{
        error::FileError,
        test_data::{self, Sensor, TestData},
    },
    method::linear_algebra::symmetric_eigen,
};
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
            (None, repeats @ [_, _, ..]) => mean_of(
                self,
                &repeats
                    .iter()
                    .map(|file| read(file, "test.repeats"))
                    .collect::<Result<Vec<_>, _>>()?,
            ),
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
    let (rows, count) = (matched(job, tests)?, tests.len());
    let mut data = TestData {
        shape_deviation: None,
        ..tests[0].clone()
    };
    let (modes, sensors) = (data.frequencies_hz.len(), data.sensors.len());
    let mut hertz = DMatrix::from_fn(modes, count, |mode, test| tests[test].frequencies_hz[mode]);
    for (mut own, mean) in hertz.row_iter_mut().zip(&mut data.frequencies_hz) {
        *mean = own.mean();
        own /= *mean;
        own.add_scalar_mut(-1.0);
    }
    for mode in (0..modes).filter(|mode| !tests[0].alone.contains(mode)) {
        let shapes = tests.iter().zip(&rows);
        let shapes =
            shapes.map(|(own, rows)| own.shapes.column(mode).select_rows(rows).normalize());
        let mut shapes = DMatrix::from_columns(&shapes.collect::<Vec<_>>());
        let (_, vectors) = symmetric_eigen("closeness of repeats", &shapes.tr_mul(&shapes))?;
        let along = shapes.tr_mul(&(&shapes * vectors.column(count - 1)).normalize());
        for (file, along) in job.test.repeats.iter().zip(&along) {
            let assurance = along.powi(2);
            job.ensure(assurance >= FLOOR, || {
                let (file, mode) = (file.display(), mode + 1);
                format!(
                    "test.repeats: mode {mode} of {file} is unlike the others: modal assurance {assurance:.2} with their common shape"
                )
            })?;
        }
        for (mut shape, along) in shapes.column_iter_mut().zip(&along) {
            shape /= *along;
        }
        let mean = shapes.column_mean();
        let largest = along[0].signum() * mean.amax();
        for mut shape in shapes.column_iter_mut() {
            shape -= &mean;
        }
        data.shapes.set_column(mode, &(mean / largest));
        if sensors > 1 {
            let what = format!("the shape of mode {}", mode + 1);
            let own = deviation(job, &(shapes / largest), sensors - 1, &what)?;
            let own = DVector::from_element(sensors, own);
            data.component_deviation.insert(mode, own);
        }
    }
    let own = deviation(job, &hertz, modes, "frequencies")?;
    data.frequency_deviation = Some(vec![own; modes]);
    Ok(data)
}

/// Rows of the shapes of every test in the order of the first one's sensors.
fn matched(job: &Job, tests: &[TestData]) -> Result<Vec<Vec<usize>>, FileError> {
    let (repeats, first) = (&job.test.repeats, &tests[0]);
    let of_test = |(test, file): (&TestData, &PathBuf)| {
        let key = |own: &Sensor| (own.name.clone(), own.grid, own.direction);
        let place = |own: &Sensor| test.sensors.iter().position(|other| key(other) == key(own));
        let found: Option<Vec<usize>> = first.sensors.iter().map(place).collect();
        let size = |own: &TestData| (own.frequencies_hz.len(), own.sensors.len());
        let fits = size(test) == size(first) && test.alone == first.alone && test.rigid.is_empty();
        found.filter(|_| fits).ok_or_else(|| {
            let (file, first) = (file.display(), repeats[0].display());
            job.refused(format!(
                "test.repeats: {file} has not the sensors, modes and shapes of {first}, or a mode of 0 Hz, which repeated tests leave out"
            ))
        })
    };
    tests.iter().zip(repeats).map(of_test).collect()
}

/// Standard deviation of the means of some numbers that are `apart` from these (numbers × tests), `free` of them independent.
fn deviation(job: &Job, apart: &DMatrix<f64>, free: usize, what: &str) -> Result<f64, FileError> {
    let (tests, count) = (apart.ncols(), apart.ncols() as f64);
    let variance = apart.norm_squared() / (free as f64 * (count - 1.0) - 2.0);
    job.ensure(variance > 0.0 && variance < f64::INFINITY, || {
        format!(
            "test.repeats: {tests} tests do not tell the deviations of {what}; name more, or one as test.file with deviations"
        )
    })?;
    Ok((variance / count).sqrt())
}
