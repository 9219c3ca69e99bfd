//! An exact analysis of a whole model that can tell more than its modes: their exact slopes at the sensors, and further shapes in which a
//! change is followed.

use super::modes::{FINITE, Flexibility};
use super::random::random_block;
use super::residual_vectors::{leading_loads, residual_vectors};
use super::share::{ParameterMatrix, WholeShare};
use super::visibility::{open_parts, told, visible};
use super::{SparseMatrix, WholeModel, no_modes, take_product, transposed_product};
use crate::method::error::{Error, check_count};
use crate::method::linear_algebra::symmetric_part;
use crate::method::modes::Modes;
use nalgebra::DMatrix;
use std::f64::consts::{PI, TAU};
use std::ops::{Range, RangeInclusive};
use std::sync::{Arc, Mutex};

/// Largest error of what the modes left out add to a slope, relative to it. It moves the end of weighted steps by at most as much times
/// the root of chi-squared, in deviations: by the tolerance of a job's steps at a chi-squared of a hundred.
const SLOPE_ERROR: f64 = 1e-6;
/// Most terms of the series for it: a mode left out within 4 % of one that is compared needs as many.
const MOST_TERMS: usize = 26;
/// Most deflections of one parameter's own: more add less than the lowest mode left out.
const MOST_EACH: usize = 4;
/// Sensors whose deflections are held at once.
const SENSORS_AT_ONCE: usize = 32;
/// Separation of two squared frequencies, relative, at which modes keep their own shapes in slopes. Slopes of closer ones are those of a
/// change by less than a millionth, and with weights of a hundred their squares leave no digit of a prior deviation of one.
const SEPARATION: f64 = 1e-6;

/// Deflections that stand behind the modes in a basis.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Deflections<'a> {
    /// At most so many leading ones of every parameter.
    Each(usize),
    /// Leading ones of one parameter, whose share alone is looked at.
    Own(usize),
    /// So many of all parameters together.
    All(usize),
    /// Deflections of some modes under a change along these logarithms of factors, and so many of all parameters in these modes, of which
    /// each has a weight.
    Along {
        direction: &'a [f64],
        modes: &'a [usize],
        further: usize,
        weights: &'a [f64],
    },
}

/// Shapes of a basis beyond the exact modes: residual vectors with their squared frequencies, and rigid-body modes, at the sensors.
#[derive(Debug)]
pub(crate) struct Further {
    pub residual: Modes,
    pub rigid_body: DMatrix<f64>,
}

/// An exact analysis: the matrices at some factors, their factor and the lowest modes at all degrees of freedom.
#[derive(Debug)]
pub(crate) struct Place {
    whole: WholeModel,
    pub(crate) factors: Vec<f64>,
    stiffness: SparseMatrix,
    mass: SparseMatrix,
    /// The factor, unless its memory was given back.
    flexibility: Mutex<Option<Arc<Flexibility>>>,
    /// The modes at all degrees of freedom, those first that the sensors see, and their shapes times the mass.
    vibrations: Modes,
    weighted: DMatrix<f64>,
    /// Modes that the sensors see, as they see them, and the shares of the parameters in them.
    modes: Modes,
    shares: Vec<ParameterMatrix>,
    /// The lowest squared frequency of the vibrations left out; none where there are no others.
    next: Option<f64>,
    rigid_body: DMatrix<f64>,
    sensors: SparseMatrix,
}

impl Place {
    /// The analysis of a model at factors, with at most so many modes that the sensors see, but no fewer than at least, sought from those
    /// `near` that are known.
    ///
    /// Twice as many modes are taken until enough of them are seen.
    pub(super) fn new(
        whole: &WholeModel,
        factors: &[f64],
        sensors: &SparseMatrix,
        counts: RangeInclusive<usize>,
        near: Option<&DMatrix<f64>>,
    ) -> Result<Self, Error> {
        let (stiffness, mass) = whole.at(factors)?;
        let (least, most) = counts.into_inner();
        check_count("modes", least, 1, whole.dof_count())?;
        let mut taken = most;
        let (found, rigid_body, flexibility) = loop {
            let (found, flexibility) = whole.modes_of((&stiffness, &mass), taken, near)?;
            check_count(FINITE, least, 1, found.vibrations.len())?;
            let is_all = found.next.is_none();
            let all = (found.vibrations, found.next);
            let visible = visible([&stiffness, &mass], sensors, all, most)?;
            // A last group left out is missed only where modes are too few without it.
            let is_enough = visible.seen == visible.modes.len() && visible.seen >= least;
            if is_all || is_enough || visible.seen >= most {
                break (visible, found.rigid_body, flexibility);
            }
            taken *= 2;
        };
        check_count(FINITE, least, 1, found.seen)?;
        let mut vibrations = found.modes;
        let seen = sensors.times(&vibrations.shapes)?;
        let modes = Modes::signed(vibrations.omega_squared.clone(), seen.clone());
        turn_alike(&mut vibrations.shapes, &seen, &modes.shapes);
        let modes = modes.select(&(0..found.seen).collect::<Vec<_>>());
        let shapes = vibrations.shapes.columns(0, found.seen).transpose();
        let shares = whole.parts().zip(factors);
        let shares = shares.map(|((share, _), &factor)| {
            told(share.seen_by(factor, &shapes)?, factor, share, &vibrations)
        });
        Ok(Self {
            modes,
            shares: shares.collect::<Result<_, Error>>()?,
            weighted: mass.times(&vibrations.shapes)?,
            next: found.next,
            rigid_body,
            whole: whole.clone(),
            factors: factors.to_vec(),
            sensors: sensors.clone(),
            stiffness,
            mass,
            flexibility: Mutex::new(Some(Arc::new(flexibility))),
            vibrations,
        })
    }

    /// Frequencies (Hz) of the vibrations that the sensors see, and the part of each that the digits of the matrices leave open.
    pub(crate) fn open_frequencies(&self) -> Result<Vec<[f64; 2]>, Error> {
        let parts = open_parts([&self.stiffness, &self.mass], &self.vibrations)?;
        let both = self.modes.frequencies_hz().into_iter().zip(parts);
        Ok(both.map(|(hertz, part)| [hertz, part]).collect())
    }

    /// The flexibility, found again where its memory was given back.
    fn flexibility(&self) -> Result<Arc<Flexibility>, Error> {
        let known = self.flexibility.lock().ok().and_then(|own| own.clone());
        if let Some(known) = known {
            return Ok(known);
        }
        let found = Arc::new(self.whole.flexibility(&self.stiffness, &self.mass)?);
        if let Ok(mut own) = self.flexibility.lock() {
            *own = Some(Arc::clone(&found));
        }
        Ok(found)
    }

    /// Deflections without the modes, whose parts are taken out.
    fn take_modes(&self, mut deflections: DMatrix<f64>) -> DMatrix<f64> {
        let shares = transposed_product(&self.weighted, &deflections);
        take_product(&mut deflections, &self.vibrations.shapes, &shares);
        deflections
    }

    /// Some of the modes as the sensors see them.
    fn some_modes(&self, from: usize, to: usize) -> Modes {
        self.modes.select(&(from..to).collect::<Vec<_>>())
    }

    /// Loads (DOF × m) that make the deflections behind these vibrations.
    fn loads(&self, deflections: Deflections, vibrations: &Modes) -> Result<DMatrix<f64>, Error> {
        match deflections {
            Deflections::Each(most) => self.leading_loads(0..self.factors.len(), most, vibrations),
            Deflections::Own(e) => self.leading_loads(e..e + 1, MOST_EACH, vibrations),
            Deflections::All(most) => {
                let modes: Vec<usize> = (0..vibrations.len()).collect();
                let loads = || self.loads_of(&modes);
                self.loads_of_all(most, loads, &modes, &vec![1.0; modes.len()])
            }
            Deflections::Along {
                direction,
                modes,
                further,
                weights,
            } => {
                let (own, count) = (self.loads_of(modes), modes.len());
                let along = direction
                    .iter()
                    .map(|along| DMatrix::from_diagonal_element(count, count, *along));
                let mut loads = self.combined(&own, count, along);
                let further = self.loads_of_all(further, || own, modes, weights)?;
                loads.extend(further.column_iter());
                Ok(loads)
            }
        }
    }

    /// Leading loads of some parameters in vibrations, at most so many of each.
    fn leading_loads(
        &self,
        parameters: Range<usize>,
        most: usize,
        vibrations: &Modes,
    ) -> Result<DMatrix<f64>, Error> {
        let mut loads = DMatrix::zeros(self.whole.dof_count(), 0);
        if most == 0 {
            return Ok(loads);
        }
        let parts = self.whole.parts().skip(parameters.start);
        for part in parts.take(parameters.len()) {
            let own = leading_loads(part, vibrations, most)?;
            loads.extend(own.column_iter());
        }
        Ok(loads)
    }

    /// At most so many loads under changes of any parameters: each parameter's leading ones where two of each are not too many, else
    /// combinations of their loads in some modes, made where they are needed, that have much of the energy.
    ///
    /// With the loads of every parameter in every mode over its $\omega$ in $L$, random combinations $L Y$ are replaced by
    /// $L L^t K^{-1} L Y$, in which those of most energy in their deflections prevail. Source: Halko, Martinsson and Tropp, *SIAM Review*
    /// 53 (2011), 217.
    fn loads_of_all(
        &self,
        most: usize,
        loads: impl FnOnce() -> Vec<DMatrix<f64>>,
        modes: &[usize],
        weights: &[f64],
    ) -> Result<DMatrix<f64>, Error> {
        let each = most / self.factors.len().max(1);
        if each > 1 || most == 0 {
            let all = 0..self.factors.len();
            return self.leading_loads(all, each.min(MOST_EACH), &self.vibrations);
        }
        let mut all = loads();
        for own in &mut all {
            let each = own.row_iter_mut().zip(modes).zip(weights);
            each.for_each(|((mut loads, &mode), weight)| {
                loads *= weight / self.vibrations.omega_squared[mode].sqrt();
            });
        }
        let mut state = 0;
        let random = all
            .iter()
            .map(|_| random_block(most, modes.len(), &mut state));
        let random = self.combined(&all, most, random);
        let deflections = self.take_modes(self.flexibility()?.solve(&random)?);
        let own = self.whole.parts().zip(&all);
        let weights =
            own.map(|((_, rows), loads)| (loads * deflections.select_rows(rows)).transpose());
        Ok(self.combined(&all, most, weights))
    }

    /// Sum over the parameters of combinations of their loads, by weights (`count` × modes) for each (DOF × `count`).
    fn combined(
        &self,
        all: &[DMatrix<f64>],
        count: usize,
        weights: impl Iterator<Item = DMatrix<f64>>,
    ) -> DMatrix<f64> {
        let mut sum = DMatrix::zeros(count, self.whole.dof_count());
        for (((_, rows), loads), weights) in self.whole.parts().zip(all).zip(weights) {
            let loads = weights * loads;
            for (&row, loads) in rows.iter().zip(loads.column_iter()) {
                let mut sum = sum.column_mut(row);
                sum += loads;
            }
        }
        sum.transpose()
    }

    /// Loads of some modes under a change of the logarithm of each parameter's factor, at its rows (modes × rows).
    fn loads_of(&self, modes: &[usize]) -> Vec<DMatrix<f64>> {
        let shapes = self.vibrations.shapes.select_columns(modes).transpose();
        let of_part = |((share, _), factor): ((&WholeShare, &[usize]), &f64)| {
            let mut loads = *factor * share.matrix().loads(&shapes);
            if share.is_mass() {
                for (mut loads, &mode) in loads.row_iter_mut().zip(modes) {
                    loads *= -self.vibrations.omega_squared[mode];
                }
            }
            loads
        };
        let parts = self.whole.parts();
        parts.zip(&self.factors).map(of_part).collect()
    }

    /// Hands out $(K^{-1} M)^t K^{-1}$ times loads, without the modes, for every term t.
    fn deflections(
        &self,
        loads: DMatrix<f64>,
        terms: usize,
        mut take: impl FnMut(usize, &DMatrix<f64>) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let (flexibility, mut loads) = (self.flexibility()?, loads);
        for t in 0..terms {
            let deflections = self.take_modes(flexibility.solve(&loads)?);
            take(t, &deflections)?;
            if t + 1 < terms {
                loads = self.mass.times(&deflections)?;
            }
        }
        Ok(())
    }
}

impl Place {
    /// The lowest modes at the sensors.
    pub(crate) fn modes(&self, count: usize) -> Result<Modes, Error> {
        check_count(FINITE, count, 1, self.modes.len())?;
        Ok(self.some_modes(0, count))
    }

    /// The least number of modes, from so many on, that does not end between modes which keep their own shapes in slopes.
    pub(crate) fn whole_roots(&self, count: usize) -> usize {
        let near = self.modes.omega_squared.as_slice().windows(2);
        let near = near.skip(count - 1);
        count + near.take_while(|pair| is_held(pair[0], pair[1])).count()
    }

    /// The lowest shapes at all degrees of freedom (DOF × n), at most so many.
    pub(crate) fn shapes(&self, count: usize) -> Modes {
        let count = count.min(self.modes.len());
        self.vibrations.select(&(0..count).collect::<Vec<_>>())
    }

    /// Every parameter's present share in the lowest shapes, at most so many.
    pub(crate) fn shares(&self, count: usize) -> Vec<ParameterMatrix> {
        let count = count.min(self.modes.len());
        let part = |share: &ParameterMatrix| {
            share.of(share.matrix().view((0, 0), (count, count)).into_owned())
        };
        self.shares.iter().map(part).collect()
    }

    /// The matrix that reads its sensors.
    pub(super) fn sensors(&self) -> &SparseMatrix {
        &self.sensors
    }

    /// Gives back memory that can be filled again.
    pub(super) fn release(&self) {
        if let Ok(mut own) = self.flexibility.lock() {
            *own = None;
        }
    }

    /// Frequencies of modes found that no sensor sees, ascending, Hz.
    pub(crate) fn unseen(&self) -> Vec<f64> {
        let seen = self.modes.len();
        let highest = self.modes.omega_squared.iter().next_back();
        let all = self.vibrations.omega_squared.iter().skip(seen);
        let below = all.filter(|root| highest.is_none_or(|highest| *root < highest));
        below.map(|root| root.sqrt() / TAU).collect()
    }

    /// Shapes of a basis behind a number of modes, and the shares in all of them.
    pub(super) fn basis(
        &self,
        count: usize,
        deflections: Deflections,
    ) -> Result<(Further, Vec<ParameterMatrix>), Error> {
        let parameters = match deflections {
            Deflections::Own(e) => e..e + 1,
            _ => 0..self.factors.len(),
        };
        // The loops' basis is what its size says.
        let own = match deflections {
            Deflections::Each(_) => count,
            _ => self.modes.len(),
        };
        // Only a change of mass couples rigid-body modes with vibrations.
        let has_mass = self.whole.parts().any(|(share, _)| share.is_mass());
        let rigid_body = match has_mass {
            true => self.rigid_body.clone(),
            false => no_modes(self.whole.dof_count()).shapes,
        };
        let vibrations = self.shapes(own);
        let loads = self.loads(deflections, &vibrations)?;
        if loads.ncols() + rigid_body.ncols() == 0 {
            let further = Further {
                residual: self.some_modes(count, own),
                rigid_body: DMatrix::zeros(self.sensors.rows(), 0),
            };
            let mut shares = self.shares(own);
            return Ok((further, shares.drain(parameters).collect()));
        }
        let flexibility = self.flexibility()?;
        let (deflections, loads) = (flexibility.solve(&loads)?, flexibility.balanced(loads));
        // What is left has no part of modes that the sensors do not see.
        let without = match own == self.modes.len() {
            true => &self.vibrations,
            false => &vibrations,
        };
        let weighted = self.weighted.columns(0, without.len()).into_owned();
        let residual = residual_vectors(&self.mass, (without, &weighted), (deflections, loads))?;
        let mut transposed = residual.shapes.transpose();
        let first = transposed.nrows();
        transposed = transposed.resize_vertically(first + rigid_body.ncols(), 0.0);
        let mut last = transposed.rows_mut(first, rigid_body.ncols());
        last.tr_copy_from(&rigid_body);
        let shares = self.shares_beside(&vibrations.shapes, &transposed, parameters);
        let mut behind = self.some_modes(count, own);
        let squares = residual.omega_squared.iter().copied();
        behind.omega_squared.extend(squares);
        let seen = self.sensors.times(&residual.shapes)?;
        behind.shapes.extend(seen.column_iter());
        let further = Further {
            residual: behind,
            rigid_body: self.sensors.times(&rigid_body)?,
        };
        Ok((further, shares))
    }

    /// Shares of some parameters in the lowest shapes (DOF × n), where they are known, and in further ones, given transposed (m × DOF).
    fn shares_beside(
        &self,
        shapes: &DMatrix<f64>,
        further: &DMatrix<f64>,
        parameters: Range<usize>,
    ) -> Vec<ParameterMatrix> {
        let (count, size) = (shapes.ncols(), shapes.ncols() + further.nrows());
        let parts = self.whole.parts().zip(&self.factors);
        let all = self.shares(count).into_iter().zip(parts);
        let share = |(known, ((share, rows), factor)): (
            ParameterMatrix,
            ((&WholeShare, &[usize]), &f64),
        )| {
            let loads = *factor * share.matrix().loads(further);
            let coupled = &loads * shapes.select_rows(rows);
            let own = symmetric_part(&(loads * further.select_columns(rows).transpose()));
            let mut matrix = known.matrix().clone().resize(size, size, 0.0);
            matrix
                .view_mut((count, 0), coupled.shape())
                .copy_from(&coupled);
            let mut mirror = matrix.view_mut((0, count), (count, own.nrows()));
            mirror.tr_copy_from(&coupled);
            matrix.view_mut((count, count), own.shape()).copy_from(&own);
            known.of(matrix)
        };
        let some = all.skip(parameters.start).take(parameters.len());
        some.map(share).collect()
    }

    /// The lowest modes, at most so many, and rigid-body modes where a basis has them, as other sensors read them, and the modes that this
    /// analysis' sensors do not see.
    pub(crate) fn read_by(
        &self,
        sensors: &SparseMatrix,
        count: usize,
    ) -> Result<[DMatrix<f64>; 2], Error> {
        let mut basis = self.shapes(count).shapes;
        if self.whole.parts().any(|(share, _)| share.is_mass()) {
            basis.extend(self.rigid_body.column_iter());
        }
        let unseen = self.modes.len()..self.vibrations.len();
        let unseen = self.vibrations.shapes.columns_range(unseen).into_owned();
        Ok([sensors.times(&basis)?, sensors.times(&unseen)?])
    }

    /// Parts that all but a number of modes have in the slopes of these modes at sensors, which see none but
    /// those of this analysis (d × p each).
    ///
    /// Of a mode i, the column of parameter e is the sum over the modes found beyond `count`, as in [`jacobian`](crate::weighted::residuals::jacobian),
    /// and over all others
    ///
    /// $$ -R \sum_t a_t (K^{-1} M)^t K^{-1} f_{ei}, \qquad \sum_t a_t x^t \approx \frac{1}{1 - \lambda_i x} $$
    ///
    /// with the modes taken out of every term. $f_{ei}$ is the load of parameter e in mode i, $R$ reads the sensors. The sum is that of
    /// the exact slope where the series is the fraction at $x = 1/\lambda_r$ of every mode r left out ([`coefficients`]). It is taken from
    /// the sensors' side, $K^{-1} R^t$ and so on, or from the loads', whichever are fewer: no factor but that of $K$ is needed, and no
    /// solution a parameter where these are many.
    pub(crate) fn slopes_beyond(
        &self,
        sensors: &SparseMatrix,
        count: usize,
        modes: &[usize],
    ) -> Result<Vec<DMatrix<f64>>, Error> {
        let roots = modes
            .iter()
            .map(|&mode| self.vibrations.omega_squared[mode]);
        let roots: Vec<f64> = roots.collect();
        let highest = roots.iter().copied().fold(0.0, f64::max);
        let terms = terms(highest, self.next);
        let all = self.loads_of(modes);
        let mut slopes = vec![DMatrix::zeros(sensors.rows(), all.len()); modes.len()];
        let beyond = self
            .vibrations
            .select(&(count..self.modes.len()).collect::<Vec<_>>());
        let seen = sensors.times(&beyond.shapes)?;
        for (e, share) in self.shares.iter().enumerate() {
            for ((slopes, &mode), root) in slopes.iter_mut().zip(modes).zip(&roots) {
                let scale = if share.is_mass() { -root } else { 1.0 };
                let own = share.matrix().view((count, mode), (beyond.len(), 1));
                let apart = beyond
                    .omega_squared
                    .map(|other| match is_held(*root, other) {
                        true => f64::INFINITY,
                        false => root - other,
                    });
                let shares = scale * own.component_div(&apart);
                slopes.set_column(e, &(&seen * shares));
            }
        }
        let series = roots.iter();
        let series: Vec<_> = series
            .map(|&root| coefficients(root, self.next, terms))
            .collect();
        if all.len() * modes.len() < sensors.rows() {
            self.add_from_loads(sensors, &mut slopes, &all, &series)?;
        } else {
            self.add_from_sensors(sensors, &mut slopes, &all, &series)?;
        }
        Ok(slopes)
    }

    /// Adds the series for every mode to its slopes by the deflections under the loads of every parameter.
    fn add_from_loads(
        &self,
        sensors: &SparseMatrix,
        slopes: &mut [DMatrix<f64>],
        all: &[DMatrix<f64>],
        series: &[Vec<f64>],
    ) -> Result<(), Error> {
        for (place, (slopes, series)) in slopes.iter_mut().zip(series).enumerate() {
            let mut loads = DMatrix::zeros(self.whole.dof_count(), all.len());
            for (e, ((_, rows), own)) in self.whole.parts().zip(all).enumerate() {
                for (at, &row) in rows.iter().enumerate() {
                    loads[(row, e)] = own[(place, at)];
                }
            }
            self.deflections(loads, series.len(), |t, deflections| {
                *slopes -= series[t] * sensors.times(deflections)?;
                Ok(())
            })?;
        }
        Ok(())
    }

    /// Adds the same series by the deflections under loads at the sensors.
    fn add_from_sensors(
        &self,
        sensors: &SparseMatrix,
        slopes: &mut [DMatrix<f64>],
        all: &[DMatrix<f64>],
        series: &[Vec<f64>],
    ) -> Result<(), Error> {
        let (count, reading) = (sensors.rows(), sensors.transposed());
        let terms = series.first().map_or(0, Vec::len);
        for first in (0..count).step_by(SENSORS_AT_ONCE) {
            let some = first..count.min(first + SENSORS_AT_ONCE);
            let mut loads = DMatrix::zeros(self.whole.dof_count(), some.len());
            for (place, sensor) in some.clone().enumerate() {
                reading
                    .column(sensor)
                    .for_each(|(row, value)| loads[(row, place)] = value);
            }
            self.deflections(loads, terms, |t, deflections| {
                for (e, ((_, rows), own)) in self.whole.parts().zip(all).enumerate() {
                    let read = own * deflections.select_rows(rows);
                    for (i, (slopes, series)) in slopes.iter_mut().zip(series).enumerate() {
                        let mut slopes = slopes.column_mut(e);
                        slopes.rows_mut(first, some.len()).axpy(
                            -series[t],
                            &read.row(i).transpose(),
                            1.0,
                        );
                    }
                }
                Ok(())
            })?;
        }
        Ok(())
    }
}

/// True of squared frequencies so near that their modes keep their own shapes in slopes.
pub(crate) fn is_held(a: f64, b: f64) -> bool {
    (a - b).abs() <= SEPARATION * a.max(b)
}

/// Turns the columns of shapes at all DOF whose counterparts at the sensors the sign rule has turned.
pub(crate) fn turn_alike(whole: &mut DMatrix<f64>, seen: &DMatrix<f64>, signed: &DMatrix<f64>) {
    let is_turned = |mode: &usize| signed.column(*mode) != seen.column(*mode);
    for mode in (0..signed.ncols()).filter(is_turned) {
        whole.column_mut(mode).neg_mut();
    }
}

/// Terms that [`coefficients`] need for a root, for an error of [`SLOPE_ERROR`] relative to their sum.
fn terms(root: f64, next: Option<f64>) -> usize {
    let Some(next) = next.filter(|next| *next > root) else {
        return if next.is_some() { MOST_TERMS } else { 1 };
    };
    let needed = (1.0 / SLOPE_ERROR).acosh() / (2.0 * next / root - 1.0).acosh();
    (needed.ceil() as usize).clamp(1, MOST_TERMS)
}

/// Coefficients $a_t$ of the polynomial in $x$ that is $1/(1 - \lambda x)$ at Chebyshev's points between zero and the inverse of the
/// `next` root, which is above $\lambda$: with $\rho$ their ratio it errs there by no more than
///
/// $$ \frac{1}{T_n(2/\rho - 1)} $$
///
/// of its value, $T_n$ being Chebyshev's polynomial of as many terms as there are. With $y = \lambda x$ and $w$ the product of $y - y_k$ over
/// the points, one at $y = 1$, it is $(1 - w(y))/(1 - y)$.
fn coefficients(root: f64, next: Option<f64>, terms: usize) -> Vec<f64> {
    let ratio = next.map_or(0.0, |next| (root / next).min(1.0));
    let mut product = vec![1.0];
    for k in 0..terms {
        let angle = PI * (2 * k + 1) as f64 / (2 * terms) as f64;
        let point = 0.5 * ratio * (1.0 + angle.cos());
        let mut longer = vec![0.0; product.len() + 1];
        for (power, value) in product.iter().enumerate() {
            longer[power] -= point * value / (1.0 - point);
            longer[power + 1] += value / (1.0 - point);
        }
        product = longer;
    }
    let mut sum = 1.0;
    let own = product.iter().take(terms).enumerate();
    own.map(|(power, value)| {
        sum -= value;
        sum * root.powi(power as i32)
    })
    .collect()
}
