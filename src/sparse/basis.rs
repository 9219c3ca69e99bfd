//! A basis of modes and deflections: a smaller structure, of which the same comparisons are made.

use super::checks::independent;
use super::matrix::GIVEN;
use super::place::{Place, added, turn_alike};
use super::sensor_model::{Pair, SensorModel};
use super::share::Share;
use super::{solve_lower, transposed_product};
use crate::method::error::Error;
use crate::method::linear_algebra::{check_length, cholesky, symmetric_eigen, symmetric_part};
use crate::method::modes::Modes;
use nalgebra::{DMatrix, DMatrixView, DVector};

/// Part of the largest $1/\omega^2$ of a basis below which a motion has no mass.
const MASSLESS: f64 = 1e-13;

/// A structure in a basis $V$ of N shapes, with dense matrices:
///
/// $$ V^t K V + \sum_e (s_e - 1) V^t K_e V, \qquad V^t M V + \sum_e (s_e - 1) V^t M_e V $$
///
/// with factors on its present parts. It has all its modes, and their slopes without a series.
#[derive(Debug)]
pub(crate) struct Basis {
    /// Stiffness and mass as they are (N × N).
    now: [DMatrix<f64>; 2],
    /// The parameters' parts of them side by side (N × N p).
    parts: DMatrix<f64>,
    is_mass: Vec<bool>,
    /// The shapes at the sensors.
    seen: DMatrix<f64>,
    /// Number of modes that test modes are paired with.
    count: usize,
    /// Number of motions that nothing resists.
    rigid: usize,
}

/// All modes of a basis at some factors.
struct Solved {
    /// The lowest at the sensors.
    modes: Modes,
    /// Squared frequencies of all, of those without stiffness last.
    squares: DVector<f64>,
    /// Their shapes in terms of the basis, and at the sensors.
    shapes: DMatrix<f64>,
    seen: DMatrix<f64>,
}

impl Basis {
    /// The modes of an analysis that its sensors see, and deflections (DOF × m) without any of its modes.
    ///
    /// Combinations of the deflections that have no more mass than their digits are left out.
    ///
    /// # Errors
    /// Errors of an eigensolution of their mass.
    pub(super) fn of_place(
        place: &Place,
        count: usize,
        deflections: DMatrix<f64>,
        parameters: &[usize],
    ) -> Result<Self, Error> {
        let [stiffness, mass] = place.matrices();
        let gram = transposed_product(&deflections, &mass.times(&deflections)?);
        let size = gram.diagonal().map(|own| match own > 0.0 {
            true => own.sqrt().recip(),
            false => 0.0,
        });
        let unit = gram.component_mul(&(&size * size.transpose()));
        let (_, own) = independent("mass of deflections", &unit, |_| GIVEN)?;
        let deflections = deflections * (DMatrix::from_diagonal(&size) * own);
        let resisting = transposed_product(&deflections, &stiffness.times(&deflections)?);
        let (known, rigid) = (place.known_shapes(), place.rigid_body().ncols());
        // Deflections stand before the motions that nothing resists.
        let vibrations = known.ncols() - rigid;
        let mut all = known.insert_columns(vibrations, deflections.ncols(), 0.0);
        all.columns_mut(vibrations, deflections.ncols())
            .copy_from(&deflections);
        let n = all.ncols();
        let mut now = DMatrix::zeros(n, n);
        now.view_mut((0, 0), (vibrations, vibrations))
            .set_diagonal(place.squares());
        now.view_mut((vibrations, vibrations), resisting.shape())
            .copy_from(&resisting);
        let transposed = all.transpose();
        let mut parts = DMatrix::zeros(n, n * parameters.len());
        for (at, &e) in parameters.iter().enumerate() {
            let mut own = parts.columns_mut(at * n, n);
            own.copy_from(place.share_in(e, &transposed)?.matrix());
            // Of the modes it is known, with what its digits leave open taken as nothing.
            let told = place.shares()[e].matrix();
            own.view_mut((0, 0), (vibrations, vibrations))
                .copy_from(&told.view((0, 0), (vibrations, vibrations)));
        }
        let shares = place.shares();
        Ok(Self {
            now: [now, DMatrix::identity(n, n)],
            parts,
            is_mass: parameters.iter().map(|&e| shares[e].is_mass()).collect(),
            seen: place.sensors().times(&all)?,
            count,
            rigid,
        })
    }

    /// The modes of a model that has no more.
    pub(super) fn of_modes(model: &SensorModel, parameters: &[usize]) -> Self {
        let (size, squares) = (model.basis.ncols(), &model.exact.modes.omega_squared);
        let shares = parameters.iter().map(|&e| &model.shares[e]);
        let parts: Vec<f64> = shares
            .clone()
            .flat_map(|share| share.matrix().iter().copied())
            .collect();
        let stiffness = squares.clone().resize_vertically(size, 0.0);
        Self {
            now: [
                DMatrix::from_diagonal(&stiffness),
                DMatrix::identity(size, size),
            ],
            parts: DMatrix::from_vec(size, parts.len() / size, parts),
            is_mass: shares.map(Share::is_mass).collect(),
            seen: model.basis.clone(),
            count: squares.len(),
            rigid: size - squares.len(),
        }
    }

    /// The lowest modes at the sensors, with factors on the present parts.
    ///
    /// # Errors
    /// [`Error::WrongShape`]; [`Error::NotPositiveDefinite`] for a structure that does not resist a motion any more.
    pub(crate) fn modes(&self, factors: &[f64]) -> Result<Modes, Error> {
        Ok(self.solved(factors)?.modes)
    }

    /// All modes, as those of $M$ over $K$ with what is least resisted known best. Motions that nothing resists have the mass as a spring
    /// meanwhile, as stiff as the lowest vibration.
    fn solved(&self, factors: &[f64]) -> Result<Solved, Error> {
        check_length("parameter factors", factors.len(), self.is_mass.len())?;
        let size = self.seen.ncols();
        let [mut stiffness, mut mass] = self.now.clone();
        let parts = factors.iter().zip(&self.is_mass).enumerate();
        for (e, (factor, is_mass)) in parts.filter(|own| *own.1.0 != 1.0) {
            let sum = if *is_mass { &mut mass } else { &mut stiffness };
            let own = self.parts.columns(e * size, size);
            sum.zip_apply(&own, |sum, own| *sum += (factor - 1.0) * own);
        }
        let spring = match self.rigid {
            0 => 0.0,
            _ => self.now[0][(0, 0)],
        };
        let stiffness = symmetric_part(&(stiffness + spring * &mass));
        let lower = cholesky("stiffness in a basis", &stiffness, 0.0)?;
        let inverse = solve_lower(&lower, DMatrix::identity(size, size));
        let half = transposed_product(&symmetric_part(&mass), &inverse.transpose());
        let flexible = symmetric_part(&transposed_product(&inverse.transpose(), &half));
        let (roots, vectors) = symmetric_eigen("mass in a basis", &flexible)?;
        let vectors = transposed_product(&inverse, &vectors);
        let least = MASSLESS * roots.max();
        // Ascending in frequency, those that nothing resists last.
        let moving = (0..size).rev().filter(|&own| roots[own] > least);
        let moving: Vec<usize> = moving.collect();
        let (free, vibrating) = moving.split_at(self.rigid.min(moving.len()));
        let order = [vibrating, free].concat();
        let mut shapes = vectors.select_columns(&order);
        for (mut shape, &own) in shapes.column_iter_mut().zip(&order) {
            shape /= roots[own].sqrt();
        }
        let square = |own: &usize| roots[*own].recip() - spring;
        let squares = vibrating.iter().map(square);
        let squares = DVector::from_iterator(vibrating.len(), squares);
        let (mut seen, count) = (&self.seen * &shapes, self.count.min(squares.len()));
        let modes = Modes::signed(
            squares.rows(0, count).into_owned(),
            seen.columns(0, count).into_owned(),
        );
        turn_alike(&mut shapes, &seen, &modes.shapes);
        seen.columns_mut(0, count).copy_from(&modes.shapes);
        Ok(Solved {
            modes,
            squares: squares.resize_vertically(order.len(), 0.0),
            shapes,
            seen,
        })
    }

    /// The model of its lowest modes beside the test, with the slopes of those that are compared.
    ///
    /// # Errors
    /// As [`Self::modes`]; what the pairing refuses.
    pub(crate) fn at(
        &self,
        factors: &[f64],
        test: &Modes,
        pair: &Pair,
    ) -> Result<SensorModel, Error> {
        let Solved {
            modes,
            squares,
            shapes,
            seen,
        } = self.solved(factors)?;
        let (size, count, parameters) = (shapes.nrows(), modes.len(), factors.len());
        let mut loads = transposed_product(&self.parts, &shapes.columns(0, count).into_owned());
        for (mut loads, square) in loads.column_iter_mut().zip(&squares) {
            for (e, (factor, is_mass)) in factors.iter().zip(&self.is_mass).enumerate() {
                let mut own = loads.rows_mut(e * size, size);
                own *= factor * if *is_mass { -square } else { 1.0 };
            }
        }
        let loads = |mode: usize| {
            let own = &loads.as_slice()[mode * size * parameters..];
            DMatrixView::from_slice(&own[..size * parameters], size, parameters)
        };
        let moves = DMatrix::from_fn(count, parameters, |mode, e| {
            shapes.column(mode).dot(&loads(mode).column(e)) / squares[mode]
        });
        let mut model = SensorModel::new(modes, None, test, pair.clone(), moves)?;
        for mode in model.compared() {
            let couplings = transposed_product(&shapes, &loads(mode).into_owned());
            model.slopes[mode] = Some(&seen * added(couplings, &squares, mode));
        }
        Ok(model)
    }
}

impl SensorModel {
    /// All parameters of the model, or one, in a basis of its modes and of deflections of its analysis; of its modes alone where that is not at hand.
    pub(crate) fn in_basis(
        &self,
        parameter: Option<usize>,
        deflections: impl FnOnce(&Place) -> Result<DMatrix<f64>, Error>,
    ) -> Result<Basis, Error> {
        let all: Vec<usize> = (0..self.moves.ncols()).collect();
        let parameters = parameter.map_or(&all[..], |own| &all[own..=own]);
        match self.whole() {
            Some(place) => {
                let count = self.exact.modes.len();
                Basis::of_place(place, count, deflections(place)?, parameters)
            }
            None => Ok(Basis::of_modes(self, parameters)),
        }
    }
}
