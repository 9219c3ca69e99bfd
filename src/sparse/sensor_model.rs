//! The analysis of a user's model for the loops: modes as sensors see them, in a basis with residual vectors and rigid-body modes,
//! changes of stiffness and of mass, weights of the test modes, and any rule of pairing.

use super::assurance::cosines;
use super::mass_changes::{
    Change, apart_from_rigid_bodies, normalize_with_mass, with_rigid_bodies,
};
use super::place::{Deflections, Further, Place, turn_alike};
use super::share::ParameterMatrix;
use super::transposed_product;
use crate::method::analysis::{
    Analysis, DERIVATIVE_STEP, State, changes_by, without_close_couplings,
};
use crate::method::appendix_c::Pencil;
use crate::method::error::{Error, require};
use crate::method::error_sum::{Errors, ModeError, errors, mode_errors};
use crate::method::linear_algebra::{check_length, check_shape, symmetric_eigen, symmetric_part};
use crate::method::model::Model;
use crate::method::modes::{Modes, check_vibrations, solve};
use crate::method::perturbation::{
    Perturbed, SMALLEST_SEPARATION, first_order, recursive_1_converged,
};
use crate::method::sorting::{Pairing, pair_modes};
use crate::method::step::{REFERENCE_GAGE, StepRule};
use nalgebra::{DMatrix, DVector};
use std::fmt::{self, Debug, Formatter};
use std::sync::Arc;

/// True of squared frequencies that count as one: their modes are any basis of a subspace.
pub(crate) fn is_one_root(a: f64, b: f64) -> bool {
    (a - b).abs() <= SMALLEST_SEPARATION * a.max(b)
}

/// Parts (n × p) that shares have in the stiffness or mass of the modes at the head of their basis. Modes that follow from these have about
/// the same.
pub(crate) fn parts_of(shares: &[ParameterMatrix], modes: &Modes) -> DMatrix<f64> {
    DMatrix::from_fn(modes.len(), shares.len(), |mode, e| {
        shares[e].part(mode, modes.omega_squared[mode])
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
    /// Makes the parts (n × p) that the parameters have in the stiffness or mass of each; none where shapes alone are followed.
    pub parts: Option<&'a dyn Fn() -> DMatrix<f64>>,
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
    /// Squared circular frequencies of the shapes of the basis that vibrate: the exact modes, then residual vectors, rad²/s² (N).
    pub(crate) omega_squared: DVector<f64>,
    /// All shapes of the basis at the sensors: those, then rigid-body modes.
    pub(crate) basis: DMatrix<f64>,
    /// Cosine of every shape of the basis with the test modes; zero beyond the exact modes.
    pub(crate) cross: DMatrix<f64>,
    pub(crate) pair: Pair,
    weights: Vec<ModeWeight>,
    /// Generalized stiffness or mass of every parameter in the basis, or in that from which this one was turned.
    pub(crate) shares: Arc<Vec<ParameterMatrix>>,
    /// Turn from that basis, if there was one.
    turn: Option<Turn>,
    test_shares: Vec<DMatrix<f64>>,
    gages: Vec<f64>,
    /// The analysis that it is of, if it is one of a whole model.
    place: Option<Arc<Place>>,
    /// Parts that the modes left out have in the slopes of each exact mode's shape (d × p), of those that are compared, where they are
    /// known.
    pub(crate) beyond: Vec<Option<DMatrix<f64>>>,
}

/// Turn of a basis by a change of the parameters.
#[derive(Debug, Clone)]
struct Turn {
    /// The shapes in terms of the basis before (N × N).
    shapes: DMatrix<f64>,
    /// Factor of every parameter on its share.
    factors: Vec<f64>,
}

impl SensorModel {
    /// The model of exact modes that some sensors see (d × n), without a mass there.
    ///
    /// They are paired by `pair` with the cosine between two shapes in place of their cross-orthogonality; its square is the
    /// modal assurance criterion. Every test mode is scaled by its modal scale factor to the mode it is paired with, whose
    /// generalized stiffness stands for its own. `further` shapes of the basis, orthonormal to the modes in the whole model's mass and
    /// diagonal in its stiffness, are paired with none. `shares` are $V^t K_e V$ or $V^t M_e V$ with the basis at all DOF.
    pub(crate) fn at_sensors(
        modes: Modes,
        further: &Further,
        test: &Modes,
        pair: Pair,
        shares: Vec<ParameterMatrix>,
    ) -> Result<Self, Error> {
        let mut model = Self::turned(modes, further, test, pair, (Arc::new(shares), None))?;
        model.test_shares = model
            .shares
            .iter()
            .map(|share| model.on_test(share))
            .collect();
        Ok(model)
    }

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

    fn turned(
        modes: Modes,
        further: &Further,
        test: &Modes,
        pair: Pair,
        (shares, turn): (Arc<Vec<ParameterMatrix>>, Option<Turn>),
    ) -> Result<Self, Error> {
        let cross = cosines(&modes.shapes, &test.shapes)?;
        let parts = || parts_of(&shares, &modes);
        let pairing = pair.of(Candidates {
            cross: &cross,
            modes: &modes,
            parts: Some(&parts),
        })?;
        let mut scaled = test.clone();
        for (j, mut shape) in scaled.shapes.column_iter_mut().enumerate() {
            let along = modes.shapes.column(pairing.analysis_mode[j]).dot(&shape);
            // A shape with nothing of its partner keeps its scale.
            if along != 0.0 {
                shape *= pairing.sign[j] * along / shape.norm_squared();
            }
        }
        let (mut omega_squared, mut basis) = (modes.omega_squared.clone(), modes.shapes.clone());
        omega_squared.extend(further.residual.omega_squared.iter().copied());
        basis.extend(further.residual.shapes.column_iter());
        basis.extend(further.rigid_body.column_iter());
        let count = modes.len();
        Ok(Self {
            test_shares: Vec::new(),
            gages: vec![REFERENCE_GAGE; shares.len()],
            exact: State {
                factors: vec![1.0; shares.len()],
                generalized_shapes: DMatrix::identity(basis.ncols(), count),
                errors: errors(&modes, &pairing, &scaled)?,
                modes,
                pairing,
            },
            cross: cross.resize_vertically(basis.ncols(), 0.0),
            test: scaled,
            beyond: vec![None; count],
            place: None,
            omega_squared,
            basis,
            pair,
            weights: vec![ModeWeight::ONE; test.len()],
            shares,
            turn,
        })
    }

    /// The model of the lowest modes of an analysis, with deflections behind them in the basis.
    pub(crate) fn of_whole(
        place: Arc<Place>,
        count: usize,
        test: &Modes,
        pair: Pair,
        deflections: Deflections,
    ) -> Result<Self, Error> {
        let (modes, (further, shares)) = (place.modes(count)?, place.basis(count, deflections)?);
        let mut model = Self::at_sensors(modes, &further, test, pair, shares)?;
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

    /// The model with exact slopes of the shapes that are compared, where no residual vectors stand for them in its basis.
    pub(crate) fn with_slopes(mut self) -> Result<Self, Error> {
        if let Some(place) = &self.place
            && self.omega_squared.len() == self.exact.modes.len()
            && self.beyond.iter().all(Option::is_none)
        {
            let (compared, count) = (self.compared(), self.exact.modes.len());
            let slopes = place.slopes_beyond(place.sensors(), count, &compared)?;
            for (mode, slopes) in compared.into_iter().zip(slopes) {
                self.beyond[mode] = Some(slopes);
            }
        }
        Ok(self)
    }

    /// The model in a basis with other deflections; where the analysis is not at hand, in its own.
    pub(crate) fn in_basis(&self, deflections: Deflections) -> Result<Self, Error> {
        let Some(place) = &self.place else {
            let mut own = self.clone();
            if let Deflections::Own(e) = deflections {
                own.shares = Arc::new(vec![self.shares[e].clone()]);
            }
            return Ok(own);
        };
        let (further, shares) = place.basis(self.exact.modes.len(), deflections)?;
        Self::at_sensors(
            self.exact.modes.clone(),
            &further,
            &self.test,
            self.pair.clone(),
            shares,
        )
    }

    /// The test modes, each of the scale of the mode that it is paired with.
    pub fn test(&self) -> &Modes {
        &self.test
    }

    /// Squared circular frequencies of the vibrations of the basis, rad²/s²: the exact modes, then residual vectors.
    pub fn omega_squared(&self) -> &DVector<f64> {
        &self.omega_squared
    }

    /// Parts (n × p) that the parameters have in the stiffness or mass of the exact modes.
    pub(crate) fn parts(&self) -> DMatrix<f64> {
        parts_of(&self.shares, &self.exact.modes)
    }

    /// All shapes of the basis at the sensors: the exact modes, residual vectors, rigid-body modes.
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
        let (count, size) = (self.omega_squared.len(), self.basis.ncols());
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

    /// The model that follows from this one at `factors` on its shares, exact in its basis: the modes of $k + \beta$ with $I + \alpha$ in
    /// place of an analysis, paired anew as by sensors; and the exact modes' shapes in terms of this basis, which is none that followed
    /// from another itself.
    pub(crate) fn followed(&self, factors: &[f64]) -> Result<(Self, DMatrix<f64>), Error> {
        let (vibrations, mut generalized) = self.solved(factors)?;
        let (count, all) = (self.exact.modes.len(), self.omega_squared.len());
        let seen = &self.basis * &generalized;
        let squares = &vibrations.omega_squared;
        let modes = Modes::signed(
            squares.rows(0, count).into_owned(),
            seen.columns(0, count).into_owned(),
        );
        turn_alike(&mut generalized, &seen, &modes.shapes);
        let rest = |first: usize, size: usize| seen.columns(first, size).into_owned();
        let further = Further {
            residual: Modes {
                omega_squared: squares.rows(count, all - count).into_owned(),
                shapes: rest(count, all - count),
            },
            rigid_body: rest(all, self.basis.ncols() - all),
        };
        let turn = Turn {
            shapes: generalized.clone(),
            factors: factors.to_vec(),
        };
        let shares = (Arc::clone(&self.shares), Some(turn));
        let mut model = Self::turned(modes, &further, &self.test, self.pair.clone(), shares)?;
        model.gages.clone_from(&self.gages);
        model.weights.clone_from(&self.weights);
        Ok((model, generalized))
    }

    /// Shares of the parameters that couple every shape of the basis with some modes, $\beta_{ri}$, or $-\omega_i^2 \alpha_{ri}$ of a mass: one
    /// matrix (N × p) a mode.
    pub(crate) fn couplings(&self, modes: &[usize]) -> Vec<DMatrix<f64>> {
        let (size, count) = (self.basis.ncols(), self.shares.len());
        // Side by side, so that every share is read once.
        let mut all = DMatrix::zeros(size, count * modes.len());
        let own = self
            .turn
            .as_ref()
            .map(|turn| turn.shapes.select_columns(modes));
        for (e, share) in self.shares.iter().enumerate() {
            let (mut columns, mut scale) = (all.columns_mut(e * modes.len(), modes.len()), 1.0);
            match (&own, &self.turn) {
                (Some(own), Some(turn)) => {
                    columns.gemm(1.0, share.matrix(), own, 0.0);
                    scale = turn.factors[e];
                }
                _ => columns.copy_from(&share.matrix().select_columns(modes)),
            }
            for (mut column, &mode) in columns.column_iter_mut().zip(modes) {
                let root = if share.is_mass() {
                    -self.omega_squared[mode]
                } else {
                    1.0
                };
                column *= scale * root;
            }
        }
        let all = match &self.turn {
            None => all,
            Some(turn) => transposed_product(&turn.shapes, &all),
        };
        let of_mode =
            |place: usize| DMatrix::from_fn(size, count, |r, e| all[(r, e * modes.len() + place)]);
        (0..modes.len()).map(of_mode).collect()
    }

    /// Vibrations at factors by an eigensolution in the basis, ascending, and the shapes of all its changed shapes (N × N).
    fn solved(&self, factors: &[f64]) -> Result<(Modes, DMatrix<f64>), Error> {
        let Change { beta, alpha, apart } = self.change(factors)?;
        let (k, size) = (&self.omega_squared, self.omega_squared.len());
        let stiffness = symmetric_part(&(DMatrix::from_diagonal(k) + beta));
        let vibrations = match self.shares.iter().any(ParameterMatrix::is_mass) {
            true => {
                let mass = symmetric_part(&(DMatrix::identity(size, size) + alpha));
                solve(&stiffness, &mass, size)?
            }
            false => {
                let (squares, shapes) = symmetric_eigen("stiffness in the basis", &stiffness)?;
                Modes::new(squares, shapes)?
            }
        };
        let generalized = with_rigid_bodies(&apart, &vibrations.shapes);
        Ok((vibrations, generalized))
    }

    /// The test modes' pairs among modes that follow from the exact ones, of these cosines.
    fn paired(&self, cross: &DMatrix<f64>, modes: &Modes) -> Result<Pairing, Error> {
        let parts = || parts_of(&self.shares, modes);
        self.pair.of(Candidates {
            cross,
            modes,
            parts: Some(&parts),
        })
    }
}

impl From<&Model> for SensorModel {
    /// The paper's analysis with the dynamic DOF as sensors.
    fn from(model: &Model) -> Self {
        let exact = model.exact().clone();
        let shares = model.shares().iter().cloned();
        Self {
            test: model.test().clone(),
            omega_squared: exact.modes.omega_squared.clone(),
            basis: exact.modes.shapes.clone(),
            cross: model.cross().clone(),
            pair: Pair::by(|of| pair_modes(of.cross)),
            weights: vec![ModeWeight::ONE; model.test().len()],
            shares: Arc::new(shares.map(ParameterMatrix::Stiffness).collect()),
            turn: None,
            test_shares: model.test_shares().to_vec(),
            gages: model.gages().to_vec(),
            beyond: vec![None; exact.modes.len()],
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
        let k = &self.omega_squared;
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
            factors: factors.to_vec(),
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
        changes_by(rule, &self.test_shares, state, &self.gages, gage_factors)
    }
}

impl SensorModel {
    /// Modes of a state after a thousandth of each parameter's present stiffness or mass is added, by first order.
    ///
    /// # Errors
    /// [`Error::WrongShape`] for the state of another model; [`Error::NotAVibration`] where a thousandth is too much.
    pub(crate) fn changed_modes(&self, state: &State) -> Result<Vec<Modes>, Error> {
        let (p, k) = (&state.generalized_shapes, &state.modes.omega_squared);
        let (count, size) = (self.omega_squared.len(), self.basis.ncols());
        check_shape("shapes of the state", p, size, count)?;
        let apart = self.change(&state.factors)?.apart;
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
        self.shares.iter().zip(&state.factors).map(change).collect()
    }
}
