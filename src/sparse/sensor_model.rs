//! The analysis of a user's model for the loops: modes as sensors see them and motions that nothing resists,
//! changes of stiffness and of mass, weights of the test modes, and any rule of pairing.

use super::assurance::cosines;
use super::mass_changes::{
    Change, apart_from_rigid_bodies, normalize_with_mass, with_rigid_bodies,
};
use super::place::{Place, added, couplings};
use super::share::{ParameterMatrix, Share};
use crate::method::analysis::{Analysis, State};
use crate::method::appendix_c::Pencil;
use crate::method::derivatives::{DERIVATIVE_STEP, stiffness_changes, without_close_couplings};
use crate::method::error::{Error, require};
use crate::method::error_sum::{Errors, ModeError, errors, mode_errors};
use crate::method::linear_algebra::{check_length, check_shape};
use crate::method::model::ModalModel;
use crate::method::modes::{Modes, check_vibrations};
use crate::method::perturbation::{
    Perturbed, SMALLEST_SEPARATION, first_order, recursive_1_converged,
};
use crate::method::sorting::{Pairing, pair_modes};
use crate::method::step::{REFERENCE_GAGE, StepRule};
use nalgebra::DMatrix;
use std::fmt::{self, Debug, Formatter};
use std::sync::Arc;

/// True of squared frequencies that count as one: their modes are any basis of a subspace.
pub(crate) fn is_one_root(a: f64, b: f64) -> bool {
    (a - b).abs() <= SMALLEST_SEPARATION * a.max(b)
}

/// Slopes (n × p) of the squared frequencies of the modes at the head of a basis by the logarithm of every factor, relative to these: the part
/// that a share has in the stiffness of a mode, or in its mass, negative.
pub(crate) fn moves_of(shares: &[ParameterMatrix], modes: &Modes) -> DMatrix<f64> {
    DMatrix::from_fn(modes.len(), shares.len(), |mode, e| match &shares[e] {
        Share::Stiffness(share) => share[(mode, mode)] / modes.omega_squared[mode],
        Share::Mass(share) => -share[(mode, mode)],
    })
}

/// Factors on the errors of one test mode in the error sum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModeWeight {
    /// Factor on its frequency error.
    pub frequency: f64,
    /// Factor on its shape error.
    pub shape: f64,
}

impl ModeWeight {
    /// The paper's: every test mode counts as much.
    pub const ONE: Self = Self {
        frequency: 1.0,
        shape: 1.0,
    };
    /// Weight of a mode that counts for nothing.
    pub const NONE: Self = Self {
        frequency: 0.0,
        shape: 0.0,
    };
}

/// Requires one finite, non-negative weight per test mode and number, not all zero.
pub(crate) fn check_weights(weights: &[ModeWeight], modes: usize) -> Result<(), Error> {
    check_length("weights", weights.len(), modes)?;
    let all = || {
        weights
            .iter()
            .flat_map(|weight| [weight.frequency, weight.shape])
    };
    let wrong = all().find(|weight| !(0.0..f64::INFINITY).contains(weight));
    let wrong = wrong.or_else(|| all().all(|weight| weight == 0.0).then_some(0.0));
    let expected = "a finite number from zero up, one of them positive";
    let owner = || "the test modes".into();
    require(
        wrong.is_none(),
        "weight",
        owner,
        wrong.unwrap_or(1.0),
        expected,
    )
}

/// Modes of a model among which test modes have their partners.
#[derive(Clone, Copy)]
pub struct Candidates<'a> {
    /// Cosines of their shapes with the test's (n × g).
    pub cross: &'a DMatrix<f64>,
    /// The modes at the sensors.
    pub modes: &'a Modes,
    /// Slopes (n × p) of the squared frequency of each by the logarithm of every factor, relative to it; none where shapes alone are followed.
    pub moves: Option<&'a DMatrix<f64>>,
}

/// A function that pairs.
type Rule = dyn Fn(Candidates) -> Result<Pairing, Error> + Send + Sync;

/// Rule that pairs test modes with modes of a model.
#[derive(Clone)]
pub struct Pair(Arc<Rule>);

impl Pair {
    /// The rule of a function, such as [`pair_modes`] of the cosines.
    pub fn by(rule: impl Fn(Candidates) -> Result<Pairing, Error> + Send + Sync + 'static) -> Self {
        Self(Arc::new(rule))
    }

    pub(crate) fn of(&self, candidates: Candidates) -> Result<Pairing, Error> {
        (self.0)(candidates)
    }
}

impl Debug for Pair {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str("Pair")
    }
}

/// A model seen through its exact modes at sensors, beside the test modes.
#[derive(Debug, Clone)]
pub struct SensorModel {
    /// The exact modes (n) and how far they are from the test.
    pub(crate) exact: State,
    /// The test modes, each of the scale of the mode that it is paired with.
    pub(crate) test: Modes,
    /// The exact modes at the sensors, then motions that nothing resists, where a change of mass couples them (N).
    pub(crate) basis: DMatrix<f64>,
    /// Cosine of every shape of the basis with the test modes; zero beyond the exact modes.
    pub(crate) cross: DMatrix<f64>,
    pub(crate) pair: Pair,
    weights: Vec<ModeWeight>,
    /// Slopes (n × p) of the squared frequency of every exact mode by the logarithm of every factor, relative to it.
    pub(crate) moves: DMatrix<f64>,
    /// Generalized stiffness or mass of every parameter in the basis; none where slopes are all that is known.
    pub(crate) shares: Vec<ParameterMatrix>,
    test_shares: Vec<DMatrix<f64>>,
    gages: Vec<f64>,
    /// The analysis that it is of, if it is one of a whole model.
    place: Option<Arc<Place>>,
    /// Exact slopes (d × p) of the shape of every exact mode that is compared, where they are known.
    pub(crate) slopes: Vec<Option<DMatrix<f64>>>,
}

impl SensorModel {
    /// A parameter's share of the test modes' stiffness or mass (g × g).
    fn on_test(&self, share: &ParameterMatrix) -> DMatrix<f64> {
        let Pairing {
            analysis_mode,
            sign,
        } = &self.exact.pairing;
        let omega = self.test.omega_squared.map(f64::sqrt);
        let matrix = share.matrix();
        let entry = |j: usize, k: usize| {
            let own = sign[j] * sign[k] * matrix[(analysis_mode[j], analysis_mode[k])];
            if share.is_mass() {
                own
            } else {
                own / (omega[j] * omega[k])
            }
        };
        DMatrix::from_fn(sign.len(), sign.len(), entry)
    }

    /// The model of exact modes that some sensors see (d × n), without a mass there, and of motions that nothing resists.
    ///
    /// They are paired by `pair` with the cosine between two shapes in place of their cross-orthogonality; its square is the
    /// modal assurance criterion. Every test mode is scaled by its modal scale factor to the mode it is paired with, whose
    /// generalized stiffness stands for its own.
    pub(super) fn new(
        modes: Modes,
        rigid_body: Option<&DMatrix<f64>>,
        test: &Modes,
        pair: Pair,
        moves: DMatrix<f64>,
    ) -> Result<Self, Error> {
        let cross = cosines(&modes.shapes, &test.shapes)?;
        let pairing = pair.of(Candidates {
            cross: &cross,
            modes: &modes,
            moves: Some(&moves),
        })?;
        let mut scaled = test.clone();
        for (j, mut shape) in scaled.shapes.column_iter_mut().enumerate() {
            let along = modes.shapes.column(pairing.analysis_mode[j]).dot(&shape);
            // A shape with nothing of its partner keeps its scale.
            if along != 0.0 {
                shape *= pairing.sign[j] * along / shape.norm_squared();
            }
        }
        let mut basis = modes.shapes.clone();
        if let Some(rigid_body) = rigid_body {
            basis.extend(rigid_body.column_iter());
        }
        Ok(Self {
            test_shares: Vec::new(),
            gages: vec![REFERENCE_GAGE; moves.ncols()],
            slopes: vec![None; modes.len()],
            exact: State {
                share_factors: vec![1.0; moves.ncols()],
                generalized_shapes: DMatrix::identity(basis.ncols(), modes.len()),
                errors: errors(&modes, &pairing, &scaled)?,
                modes,
                pairing,
            },
            cross: cross.resize_vertically(basis.ncols(), 0.0),
            test: scaled,
            place: None,
            basis,
            pair,
            weights: vec![ModeWeight::ONE; test.len()],
            shares: Vec::new(),
            moves,
        })
    }

    /// The model of the lowest modes of an analysis.
    pub(crate) fn of_whole(
        place: Arc<Place>,
        count: usize,
        test: &Modes,
        pair: Pair,
    ) -> Result<Self, Error> {
        let (modes, shares) = (place.modes(count)?, place.shares_with_rigid(count));
        let rigid_body = place.sensors().times(place.rigid_body())?;
        let moves = moves_of(&shares, &modes);
        let mut model = Self::new(modes, Some(&rigid_body), test, pair, moves)?;
        let on_test = shares.iter().map(|share| model.on_test(share));
        model.test_shares = on_test.collect();
        model.shares = shares;
        model.place = Some(place);
        Ok(model)
    }

    /// The analysis, where it is at hand.
    pub(crate) fn whole(&self) -> Option<&Arc<Place>> {
        self.place.as_ref()
    }

    /// Gives back the memory of a factor, which bases and slopes make again.
    pub(crate) fn release(&self) {
        if let Some(place) = &self.place {
            place.release();
        }
    }

    /// Modes, ascending, that are compared with test modes or have the root of one that is: shapes of one root are any basis of it.
    pub(crate) fn compared(&self) -> Vec<usize> {
        let k = &self.exact.modes.omega_squared;
        let partners = &self.exact.pairing.analysis_mode;
        let is_at_root = |i: &usize| partners.iter().any(|&own| is_one_root(k[*i], k[own]));
        (0..k.len()).filter(is_at_root).collect()
    }

    /// The model with exact slopes of the shapes that are compared.
    pub(crate) fn with_slopes(mut self) -> Result<Self, Error> {
        if let Some(place) = &self.place
            && self.slopes.iter().all(Option::is_none)
        {
            let compared = self.compared();
            let slopes = place.slopes(place.sensors(), &compared)?;
            for (mode, slopes) in compared.into_iter().zip(slopes) {
                self.slopes[mode] = Some(slopes);
            }
        }
        Ok(self)
    }

    /// Slopes (d × p) of the shape of an exact mode by the logarithm of every factor: the exact ones, or those within its basis.
    pub(crate) fn slopes_of(&self, mode: usize) -> DMatrix<f64> {
        let squares = &self.exact.modes.omega_squared;
        self.slopes[mode].clone().unwrap_or_else(|| {
            let squares = squares.clone().resize_vertically(self.basis.ncols(), 0.0);
            &self.basis * added(couplings(&self.shares, &squares, mode), &squares, mode)
        })
    }

    /// The test modes, each of the scale of the mode that it is paired with.
    pub fn test(&self) -> &Modes {
        &self.test
    }

    /// All shapes of the basis at the sensors: the exact modes, motions that nothing resists.
    pub fn basis(&self) -> &DMatrix<f64> {
        &self.basis
    }

    /// Generalized stiffness (rad²/s²) or mass of every parameter in the basis.
    pub fn shares(&self) -> &[ParameterMatrix] {
        &self.shares
    }

    /// Model with weights of the test modes: in all errors $w_i e_i$ stands for $e_i$ of (5) and (6).
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless there is one weight per test mode; [`Error::Value`] for one that is negative or not finite, and when
    /// all are zero.
    pub fn weighted(mut self, weights: &[ModeWeight]) -> Result<Self, Error> {
        check_weights(weights, self.test.len())?;
        self.weights = weights.to_vec();
        self.exact.errors = self.errors_of(&self.exact.modes, &self.exact.pairing)?;
        Ok(self)
    }

    /// Distance of paired modes from the test modes, with the weights.
    pub(crate) fn errors_of(&self, modes: &Modes, pairing: &Pairing) -> Result<Errors, Error> {
        let each = mode_errors(modes, pairing, &self.test)?;
        let weighted = |(error, weight): (&ModeError, &ModeWeight)| ModeError {
            frequency: weight.frequency * error.frequency,
            shape: weight.shape * error.shape,
        };
        let each = each.iter().zip(&self.weights).map(weighted);
        Errors::of(&each.collect::<Vec<_>>())
    }

    /// The change of all parameters together.
    fn change(&self, factors: &[f64]) -> Result<Change, Error> {
        check_length("parameter factors", factors.len(), self.shares.len())?;
        let (count, size) = (self.exact.modes.len(), self.basis.ncols());
        let (mut beta, mut alpha) = (DMatrix::zeros(size, size), DMatrix::zeros(size, size));
        for (e, s) in factors.iter().enumerate().filter(|(_, s)| **s != 1.0) {
            let add = |sum: &mut DMatrix<f64>, matrix: &DMatrix<f64>| {
                sum.zip_apply(matrix, |sum, own| *sum += (s - 1.0) * own);
            };
            match &self.shares[e] {
                ParameterMatrix::Stiffness(matrix) => add(&mut beta, matrix),
                ParameterMatrix::Mass(matrix) => add(&mut alpha, matrix),
            }
        }
        let (apart, rigid) = (DMatrix::identity(size, size), size - count);
        if rigid == 0 {
            return Ok(Change { beta, alpha, apart });
        }
        let apart = apart_from_rigid_bodies(apart, &alpha, count)?;
        Ok(Change {
            beta: beta.resize(count, count, 0.0),
            alpha: (alpha * &apart).resize(count, count, 0.0),
            apart,
        })
    }

    fn paired(&self, cross: &DMatrix<f64>, modes: &Modes) -> Result<Pairing, Error> {
        let moves = moves_of(&self.shares, modes);
        self.pair.of(Candidates {
            cross,
            modes,
            moves: Some(&moves),
        })
    }
}

impl From<&ModalModel> for SensorModel {
    /// The paper's analysis with the dynamic DOF as sensors.
    fn from(model: &ModalModel) -> Self {
        let exact = model.exact().clone();
        let shares = model.shares().iter().cloned();
        let shares: Vec<_> = shares.map(ParameterMatrix::Stiffness).collect();
        Self {
            test: model.test().clone(),
            basis: exact.modes.shapes.clone(),
            cross: model.cross().clone(),
            pair: Pair::by(|of| pair_modes(of.cross)),
            weights: vec![ModeWeight::ONE; model.test().len()],
            moves: moves_of(&shares, &exact.modes),
            shares,
            test_shares: model.test_shares().to_vec(),
            gages: model.gages.clone(),
            slopes: vec![None; exact.modes.len()],
            place: None,
            exact,
        }
    }
}

impl Analysis for SensorModel {
    fn exact(&self) -> &State {
        &self.exact
    }

    /// Recursive 1 in the basis: the modes are the vibrations of the basis, each in the place of the exact mode or residual vector that it
    /// continues.
    fn at(&self, factors: &[f64]) -> Result<State, Error> {
        let Change { beta, alpha, apart } = self.change(factors)?;
        let k = &self.exact.modes.omega_squared;
        let settled = match self.shares.iter().any(ParameterMatrix::is_mass) {
            true => Pencil::of_vibrations(k, &beta, &alpha)?.recursive_1_converged()?,
            false => recursive_1_converged(k, &beta)?,
        };
        check_vibrations(&settled.perturbed.roots)?;
        let Perturbed { roots, mut shapes } = settled.perturbed;
        normalize_with_mass(&mut shapes, &alpha)?;
        let generalized = with_rigid_bodies(&apart, &shapes);
        let generalized_shapes = generalized.columns(0, k.len()).into_owned();
        let close = generalized_shapes.tr_mul(&self.cross);
        let modes = Modes {
            omega_squared: roots.map(f64::recip),
            shapes: &self.basis * &generalized_shapes,
        };
        let count = self.exact.modes.len();
        let lowest = modes.select(&(0..count).collect::<Vec<_>>());
        let cross = close.rows(0, count).into_owned();
        let pairing = self.paired(&cross, &lowest)?;
        let errors = self.errors_of(&modes, &pairing)?;
        Ok(State {
            share_factors: factors.to_vec(),
            modes,
            generalized_shapes,
            pairing,
            errors,
        })
    }

    fn error_changes(&self, state: &State) -> Result<Vec<f64>, Error> {
        let change = |modes: &Modes| {
            let errors = self.errors_of(modes, &state.pairing)?;
            Ok(errors.sum() - state.errors.sum())
        };
        self.changed_modes(state)?.iter().map(change).collect()
    }

    fn stiffness_changes(&self, state: &State, gage_factors: &[f64], rule: StepRule) -> Vec<f64> {
        stiffness_changes(rule, &self.test_shares, state, &self.gages, gage_factors)
    }
}

impl SensorModel {
    /// Modes of a state after a thousandth of each parameter's present stiffness or mass is added, by first order.
    ///
    /// # Errors
    /// [`Error::WrongShape`] for the state of another model; [`Error::NotAVibration`] where a thousandth is too much.
    pub(crate) fn changed_modes(&self, state: &State) -> Result<Vec<Modes>, Error> {
        let (p, k) = (&state.generalized_shapes, &state.modes.omega_squared);
        let (count, size) = (self.exact.modes.len(), self.basis.ncols());
        check_shape("shapes of the state", p, size, count)?;
        let apart = self.change(&state.share_factors)?.apart;
        let rigid = apart.columns(count, size - count);
        let change = |(share, s): (&ParameterMatrix, &f64)| {
            let moved = DERIVATIVE_STEP * *s * (share.matrix() * p);
            let own = without_close_couplings(k.as_slice(), &p.tr_mul(&moved));
            let now = &state.modes.shapes;
            let (roots, shapes) = if share.is_mass() {
                let perturbed = Pencil::of_vibrations(k, &(0.0 * &own), &own)?.first_order()?;
                check_vibrations(&perturbed.roots)?;
                let Perturbed { roots, shapes } = perturbed;
                // With ω² = 0 the first order of a rigid-body mode in a vibration is -α_Ri.
                (
                    roots,
                    now * shapes - &self.basis * rigid * rigid.tr_mul(&moved),
                )
            } else {
                let Perturbed { roots, shapes } = first_order(k, &own)?;
                (roots, now * shapes)
            };
            Ok(Modes {
                omega_squared: roots.map(f64::recip),
                shapes,
            })
        };
        self.shares
            .iter()
            .zip(&state.share_factors)
            .map(change)
            .collect()
    }
}
