//! An exact analysis of a whole model that can tell more than its modes: their exact slopes at the sensors, and deflections in which a
//! change is followed.

use super::matrix::GIVEN;
use super::modes::{FINITE, Flexibility};
use super::random::random_block;
use super::share::{ParameterMatrix, Share, WholeShare};
use super::visibility::{open_parts, told, visible};
use super::{SparseMatrix, WholeModel, no_modes, places_above, take_product, transposed_product};
use crate::method::error::{Error, check_count};
use crate::method::linear_algebra::{symmetric_eigen, symmetric_part};
use crate::method::modes::Modes;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::{PI, TAU};
use std::ops::RangeInclusive;
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
    /// Modes that the sensors see, as they see them.
    modes: Modes,
    /// Motions that nothing resists, where a mass is a parameter: no other change couples them with vibrations.
    rigid_body: DMatrix<f64>,
    /// The shares of the parameters in the modes that are seen, and in these motions behind them.
    shares: Vec<ParameterMatrix>,
    /// The lowest squared frequency of the vibrations left out; none where there are no others.
    next: Option<f64>,
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
            let visible = visible(sensors, all, most)?;
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
        let rigid_body = match whole.parts().any(|(share, _)| share.is_mass()) {
            true => rigid_body,
            false => no_modes(whole.dof_count()).shapes,
        };
        let mut place = Self {
            modes,
            weighted: mass.times(&vibrations.shapes)?,
            next: found.next,
            rigid_body,
            shares: Vec::new(),
            whole: whole.clone(),
            factors: factors.to_vec(),
            sensors: sensors.clone(),
            stiffness,
            mass,
            flexibility: Mutex::new(Some(Arc::new(flexibility))),
            vibrations,
        };
        let transposed = place.known_shapes().transpose();
        let share = |(e, (share, _)): (usize, (&WholeShare, &[usize]))| {
            let seen = place.share_in(e, &transposed)?;
            told(seen, place.factors[e], share, &place.known_modes())
        };
        let shares = whole.parts().enumerate().map(share);
        place.shares = shares.collect::<Result<_, Error>>()?;
        Ok(place)
    }

    /// The modes that the sensors see, at all degrees of freedom.
    fn known_modes(&self) -> Modes {
        self.shapes(usize::MAX)
    }

    /// Their shapes, and motions that nothing resists (DOF × N).
    pub(super) fn known_shapes(&self) -> DMatrix<f64> {
        let mut all = self.known_modes().shapes;
        all.extend(self.rigid_body.column_iter());
        all
    }

    /// The present share of a parameter in shapes that are given transposed (N × DOF).
    pub(super) fn share_in(
        &self,
        e: usize,
        transposed: &DMatrix<f64>,
    ) -> Result<ParameterMatrix, Error> {
        self.whole.parameters()[e]
            .share
            .seen_by(self.factors[e], transposed)
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

    /// Deflections (DOF × c), without the modes, of vibrations under changes of the parameters: sums of each parameter's loads in them by
    /// its weights (c × modes), of which a parameter that does not change has none. Source: Coppolino, *SAE Technical Paper* 891082 (1989).
    fn deflections(&self, of: &Modes, weights: &[DMatrix<f64>]) -> Result<DMatrix<f64>, Error> {
        let count = weights.iter().map(DMatrix::nrows).max().unwrap_or(0);
        let mut sum = DMatrix::zeros(count, self.whole.dof_count());
        let shapes = of.shapes.transpose();
        let parts = weights.iter().zip(self.whole.parts()).enumerate();
        for (e, (weights, (_, rows))) in parts.filter(|(_, (weights, _))| !weights.is_empty()) {
            let loads = weights * self.loads_of(e, of, &shapes);
            for (&row, loads) in rows.iter().zip(loads.column_iter()) {
                let mut sum = sum.column_mut(row);
                sum += loads;
            }
        }
        let first = self.flexibility()?.solve(&sum.transpose())?;
        // Once leaves the round-off of what was taken away, twice is enough.
        let mut left = self.take_modes(self.take_modes(first.clone()));
        let (taken, weighted) = (first - &left, self.mass.times(&left)?);
        let modal = transposed_product(&self.weighted, &taken);
        for (column, mut left) in left.column_iter_mut().enumerate() {
            // Of what the modes have to the digits nothing is left.
            let own = left.dot(&weighted.column(column));
            if own <= GIVEN * modal.column(column).norm_squared() {
                left.fill(0.0);
            }
        }
        Ok(left)
    }

    /// Deflections of some modes under a change along these logarithms of factors, each of its own, and so many `further` ones of all
    /// parameters, in modes that have a weight each.
    pub(crate) fn along(
        &self,
        direction: &DVector<f64>,
        modes: &[usize],
        (further, weights): (usize, &[f64]),
    ) -> Result<DMatrix<f64>, Error> {
        let of = self.vibrations.select(modes);
        let each = direction.iter();
        let each = each.map(|own| DMatrix::from_diagonal_element(of.len(), of.len(), *own));
        let mut all = self.deflections(&of, &each.collect::<Vec<_>>())?;
        // The leading ones of each parameter, where two of each are not too many.
        let most = further / self.factors.len().max(1);
        if most > 1 {
            for e in 0..self.factors.len() {
                all.extend(self.leading(e, most)?.column_iter());
            }
        } else if further > 0 {
            let further = self.drawn(None, modes, (further / 2, Some(weights)))?;
            all.extend(further.column_iter());
        }
        Ok(all)
    }

    /// So many deflections of some modes, which may have a weight each, under changes of all parameters drawn by a `root` of their covariance, and
    /// as many that these deflections have under other changes.
    ///
    /// Without a root combinations of loads are drawn that have much of the energy: with the loads of every parameter in every mode over
    /// its $\omega$ in $L$, random ones $L Y$ are replaced by $L L^t K^{-1} L Y$. Source: Halko, Martinsson and Tropp, *SIAM Review* 53
    /// (2011), 217.
    pub(crate) fn drawn(
        &self,
        root: Option<&DMatrix<f64>>,
        modes: &[usize],
        (count, weights): (usize, Option<&[f64]>),
    ) -> Result<DMatrix<f64>, Error> {
        let of = self.vibrations.select(modes);
        let ones = vec![1.0; modes.len()];
        let sizes = DVector::from_column_slice(weights.unwrap_or(&ones));
        let sizes = match root {
            Some(_) => sizes,
            None => sizes.component_div(&of.omega_squared.map(f64::sqrt)),
        };
        let (parameters, mut state) = (self.factors.len(), 0);
        let mut random = |sizes: &DVector<f64>| drawn(root, (parameters, count), sizes, &mut state);
        let mut first = self.deflections(&of, &random(&sizes))?;
        if root.is_none() {
            let (squares, shapes) = (
                DMatrix::from_diagonal(&sizes.map(|own| own * own)),
                of.shapes.transpose(),
            );
            let prevailing = |(e, (_, rows)): (usize, (&WholeShare, &[usize]))| {
                (self.loads_of(e, &of, &shapes) * first.select_rows(rows)).transpose() * &squares
            };
            let prevailing: Vec<_> = self.whole.parts().enumerate().map(prevailing).collect();
            first = self.deflections(&of, &prevailing)?;
        }
        let moved = Modes {
            omega_squared: DVector::from_element(count, of.omega_squared.max()),
            shapes: first,
        };
        let weights = random(&DVector::from_element(1, 1.0));
        let weights = weights
            .iter()
            .map(|own| DMatrix::from_diagonal(&own.column(0)));
        let second = self.deflections(&moved, &weights.collect::<Vec<_>>())?;
        first = moved.shapes;
        first.extend(second.column_iter());
        Ok(first)
    }

    /// Deflections of all modes under a change of one parameter, of most energy, so many and no more than [`MOST_EACH`].
    ///
    /// Of its loads over $\omega_i$, which make modes count alike, these are the combinations $y$ of largest $y^t V^t P V y$, one a deformation
    /// for a part that has fewer.
    pub(crate) fn leading(&self, e: usize, most: usize) -> Result<DMatrix<f64>, Error> {
        let (of, share) = (self.known_modes(), &self.shares[e]);
        let per = DMatrix::from_diagonal(&of.omega_squared.map(|own| own.sqrt().recip()));
        let own = share.matrix().view((0, 0), (of.len(), of.len()));
        let energies = match share.is_mass() {
            true => own.into_owned(),
            false => &per * own * &per,
        };
        let what = "energy of a parameter in the modes";
        let (energies, vectors) = symmetric_eigen(what, &symmetric_part(&energies))?;
        let leading = places_above(&energies, GIVEN * energies.amax());
        let vectors = vectors.select_columns(leading.iter().rev().take(most.min(MOST_EACH)));
        let mut weights = vec![DMatrix::zeros(0, 0); self.factors.len()];
        weights[e] = vectors.transpose() * per;
        self.deflections(&of, &weights)
    }

    /// Loads of vibrations under a change of the logarithm of a parameter's factor, at its rows (modes × rows), from their transposed shapes.
    fn loads_of(&self, e: usize, of: &Modes, transposed: &DMatrix<f64>) -> DMatrix<f64> {
        let share = &self.whole.parameters()[e].share;
        let mut loads = self.factors[e] * share.matrix().loads(transposed);
        if share.is_mass() {
            for (mut loads, square) in loads.row_iter_mut().zip(&of.omega_squared) {
                loads *= -square;
            }
        }
        loads
    }

    /// Hands out $(K^{-1} M)^t K^{-1}$ times loads, without the modes, for every term t.
    fn series(
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
        Ok(self.modes.select(&(0..count).collect::<Vec<_>>()))
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

    /// Every parameter's present share in the shapes that are known.
    pub(crate) fn shares(&self) -> &[ParameterMatrix] {
        &self.shares
    }

    /// Shares in the lowest modes alone, so many.
    pub(crate) fn shares_of(&self, count: usize) -> Vec<ParameterMatrix> {
        self.shares_among(&(0..count.min(self.modes.len())).collect::<Vec<_>>())
    }

    fn shares_among(&self, kept: &[usize]) -> Vec<ParameterMatrix> {
        let part = |share: &ParameterMatrix| {
            share.of(share.matrix().select_rows(kept).select_columns(kept))
        };
        self.shares.iter().map(part).collect()
    }

    /// Shares in the lowest modes, so many, and in motions that nothing resists.
    pub(super) fn shares_with_rigid(&self, count: usize) -> Vec<ParameterMatrix> {
        let rigid = self.modes.len()..self.modes.len() + self.rigid_body.ncols();
        self.shares_among(&(0..count).chain(rigid).collect::<Vec<_>>())
    }

    /// Motions that nothing resists, where a mass is a parameter (DOF × r).
    pub(super) fn rigid_body(&self) -> &DMatrix<f64> {
        &self.rigid_body
    }

    /// Squared frequencies of the modes that the sensors see.
    pub(super) fn squares(&self) -> &DVector<f64> {
        &self.modes.omega_squared
    }

    /// Stiffness and mass.
    pub(super) fn matrices(&self) -> [&SparseMatrix; 2] {
        [&self.stiffness, &self.mass]
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

    /// The lowest modes, at most so many, and rigid-body modes where a basis has them, as other sensors read them, and the modes that this
    /// analysis' sensors do not see.
    pub(crate) fn read_by(
        &self,
        sensors: &SparseMatrix,
        count: usize,
    ) -> Result<[DMatrix<f64>; 2], Error> {
        let mut basis = self.shapes(count).shapes;
        basis.extend(self.rigid_body.column_iter());
        let unseen = self.modes.len()..self.vibrations.len();
        let unseen = self.vibrations.shapes.columns_range(unseen).into_owned();
        Ok([sensors.times(&basis)?, sensors.times(&unseen)?])
    }

    /// Slopes of some modes at sensors, which see none but those of this analysis, by the logarithm of every factor (d × p each).
    ///
    /// Of a mode i, the column of parameter e is the sum over the modes found, as in [`jacobian`](crate::weighted::residuals::jacobian),
    /// and over all others
    ///
    /// $$ -R \sum_t a_t (K^{-1} M)^t K^{-1} f_{ei}, \qquad \sum_t a_t x^t \approx \frac{1}{1 - \lambda_i x} $$
    ///
    /// with the modes taken out of every term. $f_{ei}$ is the load of parameter e in mode i, $R$ reads the sensors. The sum is that of
    /// the exact slope where the series is the fraction at $x = 1/\lambda_r$ of every mode r left out ([`coefficients`]). It is taken from
    /// the sensors' side, $K^{-1} R^t$ and so on, or from the loads', whichever are fewer: no factor but that of $K$ is needed, and no
    /// solution a parameter where these are many.
    pub(crate) fn slopes(
        &self,
        sensors: &SparseMatrix,
        modes: &[usize],
    ) -> Result<Vec<DMatrix<f64>>, Error> {
        let of = self.vibrations.select(modes);
        let roots: Vec<f64> = of.omega_squared.iter().copied().collect();
        let highest = roots.iter().copied().fold(0.0, f64::max);
        let terms = terms(highest, self.next);
        let shapes = of.shapes.transpose();
        let loads = |e| self.loads_of(e, &of, &shapes);
        let all: Vec<DMatrix<f64>> = (0..self.factors.len()).map(loads).collect();
        let seen = sensors.times(&self.known_shapes())?;
        let squares = self.squares().clone().resize_vertically(seen.ncols(), 0.0);
        let own =
            |&mode: &usize| &seen * added(couplings(&self.shares, &squares, mode), &squares, mode);
        let mut slopes: Vec<DMatrix<f64>> = modes.iter().map(own).collect();
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
            self.series(loads, series.len(), |t, deflections| {
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
            self.series(loads, terms, |t, deflections| {
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

/// Couplings (N × p) of mode i with all shapes of a basis by the shares of every parameter in it, of squared frequencies `squares` (N): a mass
/// enters as $-\omega_i^2 \alpha_{ri}$.
pub(super) fn couplings(
    shares: &[ParameterMatrix],
    squares: &DVector<f64>,
    i: usize,
) -> DMatrix<f64> {
    let entry = |r: usize, e: usize| match &shares[e] {
        Share::Stiffness(share) => share[(r, i)],
        Share::Mass(share) => -squares[i] * share[(r, i)],
    };
    DMatrix::from_fn(squares.len(), shares.len(), entry)
}

/// The part of every other shape of a basis that couplings (N × p) add to mode i, by the logarithm of a factor.
pub(super) fn added(mut couplings: DMatrix<f64>, squares: &DVector<f64>, i: usize) -> DMatrix<f64> {
    for (mut row, square) in couplings.row_iter_mut().zip(squares) {
        match is_held(squares[i], *square) {
            true => row.fill(0.0),
            false => row /= squares[i] - square,
        }
    }
    couplings
}

/// Weights (c × modes) of every parameter's loads in modes of these `sizes` for `count` changes, drawn by a root of the covariance of their
/// logarithms, or each by itself.
fn drawn(
    root: Option<&DMatrix<f64>>,
    (parameters, count): (usize, usize),
    sizes: &DVector<f64>,
    state: &mut u64,
) -> Vec<DMatrix<f64>> {
    let random = random_block(parameters, count * sizes.len(), state);
    let changes = match root {
        Some(root) => root * random,
        None => random,
    };
    let sizes = DMatrix::from_diagonal(sizes);
    let own = changes.row_iter().map(|own| {
        DMatrix::from_column_slice(count, sizes.nrows(), own.transpose().as_slice()) * &sizes
    });
    own.collect()
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
