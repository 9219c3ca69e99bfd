//! Repeated tests: their mean, and the standard deviations and the covariance that their scatter gives.

use super::prepared::FLOOR;
use super::{Job, PreparedJob};
use crate::files::error::FileError;
use crate::files::test_data::{self, Sensor, TestData};
use crate::method::linear_algebra::{cholesky, symmetric_eigen, symmetric_part};
use crate::sparse::ModeWeight;
use crate::weighted::comparison::HALF_THE_DIGITS;
use nalgebra::{DMatrix, DVector};
use std::path::PathBuf;

/// Fewest repeats that give every number a variance of its own.
///
/// What is fitted by weights $w$ of one over variances estimated from $R$ tests has a variance larger than $1/\sum w$ says by
/// $(R - 3)/(R - 5)$, the mean of $w^2$ over the square of its mean. Intervals of 95 % hold 93 % with 1.17 times, so from $R - 1 = 16$ on.
const OWN_VARIANCES: usize = 17;

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
/// Of $R$ tests the squares $q$ of a number's deviations from the mean give it the variance $q/(R (R - 3))$. One over it is right in the
/// mean; $q/(R - 1)$ would make chi-squared too large by $(R - 1)/(R - 3)$. A shape of $d$ components has $d - 1$ free numbers, so
/// theirs are larger by $d/(d - 1)$. Where fewer than [`OWN_VARIANCES`] tests or a number that is always the same leave none, all
/// components of a shape, or all frequencies, have one variance. Tests of which each is like the one before ([`drift`]) tell less.
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
        job.refuse_if(test.rigid.first(), |mode| {
            let (file, mode) = (file.display(), mode + 1);
            format!("test.repeats: mode {mode} of {file} has a frequency of 0 Hz; leave rigid-body modes out of repeated tests")
        })?;
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
    let mut data = TestData {
        frequency_deviation: None,
        shape_deviation: None,
        scatter: DMatrix::zeros(modes * (1 + sensors), tests.len()),
        ..first.clone()
    };
    for mode in 0..modes {
        let hertz = DVector::from_iterator(
            tests.len(),
            tests.iter().map(|test| test.frequencies_hz[mode]),
        );
        data.frequencies_hz[mode] = hertz.mean();
        let relative = hertz / data.frequencies_hz[mode];
        let row = mode * (1 + sensors);
        data.scatter
            .set_row(row, &relative.add_scalar(-1.0).transpose());
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
        let unlike = (0..tests.len()).find(|&test| along[test].powi(2) < FLOOR);
        job.refuse_if(unlike, |test| {
            let file = repeats[test].display();
            format!(
                "test.repeats: mode {} of {file} is unlike the others: modal assurance {:.2} with their common shape",
                mode + 1,
                along[test].powi(2)
            )
        })?;
        let sign = along[0].signum();
        for (mut shape, along) in shapes.column_iter_mut().zip(&along) {
            shape *= sign / along;
        }
        let mean = shapes.column_mean();
        let largest = mean.amax();
        for (test, shape) in shapes.column_iter().enumerate() {
            let apart = (shape - &mean) / largest;
            data.scatter
                .view_mut((row + 1, test), (sensors, 1))
                .copy_from(&apart);
        }
        data.shapes.set_column(mode, &(mean / largest));
        if sensors > 1 {
            let apart = data.scatter.rows(row + 1, sensors).into_owned();
            let what = format!("the shape of mode {}", mode + 1);
            let own = deviations(job, &apart, sensors - 1, &what)?;
            data.component_deviation.insert(mode, own);
        }
    }
    let frequencies: Vec<usize> = (0..modes).map(|mode| mode * (1 + sensors)).collect();
    let apart = data.scatter.select_rows(&frequencies);
    let own = deviations(job, &apart, modes, "frequencies")?;
    data.frequency_deviation = Some(own.data.into());
    data.drift = drift(&data.scatter);
    if let Some(lag) = data.drift {
        // The mean of R numbers that are alike from one to the next by r has a variance (1 + r)/(1 - r) times as large.
        let wider = ((1.0 + lag) / (1.0 - lag)).sqrt();
        let frequencies = data.frequency_deviation.iter_mut().flatten();
        frequencies.for_each(|deviation| *deviation *= wider);
        let components = data.component_deviation.values_mut();
        components.for_each(|deviations| *deviations *= wider);
        data.scatter *= wider;
    }
    Ok(data)
}

/// Standard deviations by which the likeness of neighboring tests exceeds that of independent ones at least where tests drift.
const RARE: f64 = 3.0;
/// Largest likeness that counts: tests that change by less than this leaves tell nothing of their mean.
const MOST_ALIKE: f64 = 0.95;

/// Correlation of a test's deviations from the mean (numbers × tests) with those of the next, if independent tests hardly have it by chance.
///
/// Every number counts as much. Independent tests have $-1/R$ in the mean, with a deviation of $1/\sqrt{R n}$ of $n$ numbers that are
/// independent of one another; of numbers that scatter together $n$ is $(\sum \mu)^2/\sum \mu^2$ with the eigenvalues $\mu$ of their products.
fn drift(scatter: &DMatrix<f64>) -> Option<f64> {
    let mut unit = scatter.clone();
    for mut row in unit.row_iter_mut().filter(|row| row.amax() > 0.0) {
        let size = row.norm();
        row /= size;
    }
    let (products, tests) = (unit.tr_mul(&unit), scatter.ncols() as f64);
    let total = products.trace();
    let next: f64 = (1..scatter.ncols())
        .map(|test| products[(test - 1, test)])
        .sum();
    let lag = next / total + 1.0 / tests;
    let numbers = total * total / products.norm_squared();
    (lag * (tests * numbers).sqrt() > RARE).then(|| lag.min(MOST_ALIKE))
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
    let (numbers, tests) = apart.shape();
    let squares = apart.map(|apart| apart * apart).column_sum();
    let (count, free) = (tests as f64, free as f64);
    let variances = if tests >= OWN_VARIANCES && squares.min() > 0.0 {
        squares * (numbers as f64 / free / (count - 3.0))
    } else {
        let common = squares.sum() / (free * (count - 1.0) - 2.0);
        DVector::from_element(numbers, common)
    };
    let untold = (!(variances.min() > 0.0 && variances.max() < f64::INFINITY)).then_some(());
    job.refuse_if(untold, |()| {
        format!("test.repeats: {tests} tests do not tell the deviations of {what}; name more, or one as test.file with deviations")
    })?;
    Ok(variances.map(|variance| (variance / count).sqrt()))
}

impl PreparedJob {
    /// Covariance of the weighted residuals of repeated tests, where there are enough of them; none where variances are all that is
    /// known, and the residuals count as independent.
    ///
    /// Of $p$ numbers that $R$ tests have beside the scales of shapes, with the deviations $X$ ($p \times R$) over the standard
    /// deviations, it is $X X^t/(R (R - p - 2))$: its inverse is right in the mean, and there is none without at least $p + 3$ tests. A
    /// shape's own direction, in which nothing is left, gets the variance one, which the free scale takes away again. Modes that are held
    /// out have no part in it. Weights of the job's own leave the residuals independent.
    pub(super) fn covariance(&self) -> Option<DMatrix<f64>> {
        let (sensors, tests) = (
            self.loaded.data.sensors.len(),
            self.loaded.data.scatter.ncols(),
        );
        let numbers = self.free_numbers();
        let (weights, fitted) = (self.own_weights(), self.fitted());
        let mut own = weights.iter().zip(&fitted);
        if own.any(|(own, is_fitted)| *is_fitted && *own != ModeWeight::ONE) || tests < numbers + 3
        {
            return None;
        }
        // For every residual its row of the scatter, one over its deviation, and the component of the shape that it measures.
        type MeasuredNumber = (usize, f64, Option<(usize, f64)>);
        let mut rows: Vec<MeasuredNumber> = Vec::new();
        for (place, mode) in self.compared().enumerate() {
            let (row, noise) = (mode * (1 + sensors), self.loaded.deviations(mode));
            let is_fitted = f64::from(u8::from(fitted[place]));
            rows.push((row, is_fitted / noise.frequency, None));
            let own = self.loaded.data.component_deviation.get(&mode);
            for sensor in self
                .loaded
                .placed
                .iter()
                .filter(|_| place < self.modes.len())
            {
                let deviation = own.map_or(noise.shape, |own| own[sensor.row]);
                let component = self.loaded.data.shapes[(sensor.row, mode)];
                let of_shape = Some((place, component));
                let scale = is_fitted * sensor.sign / deviation;
                rows.push((row + 1 + sensor.row, scale, of_shape));
            }
        }
        let apart = DMatrix::from_fn(rows.len(), tests, |number, test| {
            let (row, scale, _) = rows[number];
            scale * self.loaded.data.scatter[(row, test)]
        });
        let mut along = DMatrix::from_fn(rows.len(), self.modes.len(), |number, mode| {
            let (_, scale, of_shape) = rows[number];
            of_shape.map_or(0.0, |(place, component)| {
                if place == mode {
                    scale * component
                } else {
                    0.0
                }
            })
        });
        for mut along in along.column_iter_mut() {
            along /= along.norm().max(f64::MIN_POSITIVE);
        }
        let sizes = (tests * (tests - numbers - 2)) as f64;
        let covariance = &apart * apart.transpose() / sizes + &along * along.transpose();
        let mut covariance = symmetric_part(&covariance);
        // Residuals of modes that are held out weigh nothing, and stay apart from the others.
        for number in (0..rows.len()).filter(|number| rows[*number].1 == 0.0) {
            covariance[(number, number)] = 1.0;
        }
        // Files that are given twice leave it singular.
        let is_whole = cholesky("covariance", &covariance, HALF_THE_DIGITS).is_ok();
        is_whole.then_some(covariance)
    }

    /// Factor on chi-squared by an estimated covariance, after a fit that leaves these degrees of freedom.
    ///
    /// The least over the fitted parameters is chi-squared by the covariance of what is left, $\nu$ of the $p$ numbers, and one over
    /// that of $R$ tests is right in the mean with $R - \nu - 2$ for $R - p - 2$. The parameters' own deviations need the latter.
    pub(super) fn estimate_scale(&self, freedom: f64) -> f64 {
        let room = self.loaded.data.scatter.ncols() as f64 - 2.0;
        let all = self.free_numbers() as f64;
        match self.covariance() {
            Some(_) => (room - freedom) / (room - all),
            None => 1.0,
        }
    }

    /// True of every test mode that has any weight.
    fn fitted(&self) -> Vec<bool> {
        let weights = self.own_weights().into_iter();
        weights
            .map(|own| own.frequency > 0.0 || own.shape > 0.0)
            .collect()
    }

    /// Count of the test's numbers for a covariance: all that are fitted, less a scale a shape.
    pub(super) fn free_numbers(&self) -> usize {
        let (fitted, of_mode) = (self.fitted(), self.loaded.placed.len().max(1));
        let (shaped, alone) = fitted.split_at(self.modes.len());
        let count = |of: &[bool]| of.iter().filter(|is_fitted| **is_fitted).count();
        count(shaped) * of_mode + count(alone)
    }
}
