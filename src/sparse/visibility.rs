//! Modes that sensors see, and those that exist for nobody.

use super::{ParameterMatrix, Share, SparseMatrix, UNSEEN_SHARE, WholeShare};
use crate::method::error::Error;
use crate::method::modes::Modes;
use nalgebra::{DMatrix, DVector, DVectorView};
use std::f64::consts::SQRT_2;

/// Part of what a sensor reads of other modes that counts as nothing: shapes are found to the root of the rounding of doubles, of which
/// the square is in their frequencies.
const NOTHING: f64 = 1e-8;
/// Distance of neighboring squared frequencies, relative to the higher, that no solver tells from none.
const SAME: f64 = 1e-8;
/// Standard deviations of a rounding that none exceeds.
const RARE: f64 = 4.0;

/// Every mode's visibility, from zero to one: the largest part that a reading of it (sensors × n, unit mass) is of what this sensor reads
/// of any mode, $\nu = \max_s \lvert (S v)_s \rvert / r_s$. A sensor that reads next to nothing of all is no measure: no $r_s$ is below
/// 1e-8 of the largest.
pub(crate) fn visibilities(readings: &DMatrix<f64>) -> Vec<f64> {
    let sizes = sizes(readings);
    let part = |mode: DVectorView<f64>| {
        let each = mode.iter().zip(&sizes);
        each.fold(0.0, |most: f64, (own, size)| most.max(own.abs() / size))
    };
    readings.column_iter().map(part).collect()
}

/// The $r_s$ of [`visibilities`].
fn sizes(readings: &DMatrix<f64>) -> DVector<f64> {
    let least = (NOTHING * readings.amax()).max(f64::MIN_POSITIVE);
    let mut largest = DVector::from_element(readings.nrows(), least);
    for mode in readings.column_iter() {
        largest.zip_apply(&mode, |largest, own| *largest = largest.max(own.abs()));
    }
    largest
}

/// Modes of a pencil, those first that sensors see.
pub(super) struct Visible {
    pub(super) modes: Modes,
    /// Number of those that are seen.
    pub(super) seen: usize,
    /// The lowest squared frequency of the modes left out; none where there are no others.
    pub(super) next: Option<f64>,
}

/// Sorts modes of unit generalized mass by what sensors $S$ see of them; of those seen at most so many stay. `next` is the lowest squared
/// frequency beyond the modes, none where there are no others.
///
/// A mode is unseen where no sensor reads more of it than 1e-8 of what it reads of any, or of its own largest component. Modes of the root
/// of the next are left out with it: a last group cut off by the number taken is no subspace.
///
/// # Errors
/// [`Error::WrongShape`] for matrices that do not fit.
pub(super) fn visible(
    sensors: &SparseMatrix,
    (modes, mut next): (Modes, Option<f64>),
    most: usize,
) -> Result<Visible, Error> {
    let roots = &modes.omega_squared;
    let is_below = |mode: &usize| next.is_none_or(|next| next - roots[*mode] > SAME * next);
    let all: Vec<usize> = (0..modes.len()).take_while(is_below).collect();
    next = roots.as_slice().get(all.len()).copied().or(next);
    let readings = sensors.times(&modes.shapes)?;
    let sizes = sizes(&readings);
    let is_seen = |mode: &usize| {
        let own = modes.shapes.column(*mode).amax();
        let both = readings
            .column(*mode)
            .into_owned()
            .zip_map(&sizes, |reading, size| {
                reading.abs() > NOTHING * size.max(own)
            });
        both.iter().any(|is_seen| *is_seen)
    };
    let (mut seen, unseen): (Vec<usize>, Vec<usize>) = all.into_iter().partition(is_seen);
    if let Some(&first) = seen.get(most) {
        next = Some(roots[first]);
        seen.truncate(most);
    }
    Ok(Visible {
        seen: seen.len(),
        modes: modes.select(&[seen, unseen].concat()),
        next,
    })
}

/// The deviations $\sigma_{il}$ that the rounding of entries by up to $h$, of the stiffness, and $m$, of the mass, leaves in the energy of two
/// modes:
///
/// $$ \sigma_{il}^2 = \frac13 \sum_{pq} (h_{pq}^2 + \omega_i^2 \omega_l^2 m_{pq}^2) v_{ip}^2 v_{lq}^2 $$
fn deviations(pencil: [&SparseMatrix; 2], modes: &Modes) -> Result<DMatrix<f64>, Error> {
    let frequencies = modes.omega_squared.map(f64::sqrt);
    let [stiffness, mass] = pencil.map(|matrix| deviation(matrix, &modes.shapes));
    let mass = mass?.component_mul(&(&frequencies * frequencies.transpose()));
    Ok(stiffness?.zip_map(&mass, f64::hypot))
}

/// The standard deviations of a matrix of half units in shapes.
fn deviation(half_units: &SparseMatrix, shapes: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
    // Squares of very large or small numbers leave the range of numbers.
    let size = shapes.amax();
    let squares = shapes.map(|value| (value / size).powi(2));
    let (largest, parts) = half_units.squares();
    let sums = squares.tr_mul(&parts.times(&squares)?);
    Ok(sums.map(|sum| largest * size * size * (sum / 3.0).sqrt()))
}

/// Standard deviations of the squared frequencies of modes of unit generalized mass by the rounding of a pencil's entries as [`deviations`]
/// has it: $\sqrt2 \sigma_{ii}$, for both triangles of a matrix have one rounding.
///
/// # Errors
/// [`Error::WrongShape`] for matrices that do not fit.
pub(super) fn open_squares(
    pencil: [&SparseMatrix; 2],
    modes: &Modes,
) -> Result<DVector<f64>, Error> {
    let [stiffness, mass] = pencil.map(SparseMatrix::half_units);
    Ok(deviations([&stiffness, &mass], modes)?.diagonal() * SQRT_2)
}

/// Standard deviations of the frequencies, relative to them, by the digits of matrices from files; zeros for other matrices.
///
/// # Errors
/// [`Error::WrongShape`] for matrices that do not fit.
pub(crate) fn open_parts(pencil: [&SparseMatrix; 2], modes: &Modes) -> Result<Vec<f64>, Error> {
    if !pencil.iter().any(|matrix| matrix.half_unit().is_written()) {
        return Ok(vec![0.0; modes.len()]);
    }
    let parts = open_squares(pencil, modes)?.component_div(&modes.omega_squared) / 2.0;
    Ok(parts.as_slice().to_vec())
}

/// A share at a factor, in modes of unit generalized mass, that is nothing of a mode in which the digits of its matrix make it negative and
/// that is no more than [`UNSEEN_SHARE`] of the mode: a part is semidefinite, and steps would soften the mode by making the part stiffer. Of a larger
/// one the digits leave the frequency itself open, which has so little weight.
///
/// # Errors
/// [`Error::WrongShape`] for matrices that do not fit.
pub(super) fn told(
    mut seen: ParameterMatrix,
    factor: f64,
    share: &WholeShare,
    modes: &Modes,
) -> Result<ParameterMatrix, Error> {
    let is_unseen = |mode: &usize| {
        let part = match &seen {
            Share::Stiffness(own) => own[(*mode, *mode)] / modes.omega_squared[*mode],
            Share::Mass(own) => own[(*mode, *mode)],
        };
        part < 0.0 && -part < UNSEEN_SHARE
    };
    let negative: Vec<usize> = (0..modes.len()).filter(is_unseen).collect();
    if share.matrix().half_unit().is_written() && !negative.is_empty() {
        let shapes = modes.shapes.select_columns(&negative);
        let open = deviation(&share.matrix().half_units(), &shapes)?;
        let (Share::Stiffness(own) | Share::Mass(own)) = &mut seen;
        for (at, &mode) in negative.iter().enumerate() {
            if -own[(mode, mode)] < RARE * factor * open[(at, at)] {
                own[(mode, mode)] = 0.0;
            }
        }
    }
    Ok(seen)
}

/// Rows that couplings join, one by one or by others, to a row that a sensor reads.
pub(super) fn rows_with_sensor(
    couplings: impl Iterator<Item = (usize, usize)>,
    sensors: &SparseMatrix,
) -> Vec<usize> {
    let mut near = vec![Vec::new(); sensors.columns()];
    couplings.for_each(|(row, other)| near[row].push(other));
    let mut next: Vec<usize> = sensors.entries().map(|entry| entry.1).collect();
    let mut is_joined = vec![false; near.len()];
    while let Some(row) = next.pop() {
        if !is_joined[row] {
            is_joined[row] = true;
            next.append(&mut near[row]);
        }
    }
    (0..near.len()).filter(|&row| is_joined[row]).collect()
}
