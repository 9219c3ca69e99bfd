//! The modal model: what a finite element analysis hands to the loops.
//!
//! It holds modes and not matrices: the exact modes at the compared DOF, already paired with the test modes, and each
//! parameter's generalized stiffness or mass. Analysis, scaling of the test modes, pairing and comparison all happen in
//! [`ModalModel::new`], so that the loops and the exact check cannot disagree about any of them.

use super::REFERENCE_GAGE;
use crate::method::error::{Error, positive_setting, setting};
use crate::method::error_sum::{
    Errors, ModeError, ModeWeight, check_error_sum, errors, mode_errors, weighted_errors,
};
use crate::method::linear_algebra::{
    check_length, check_shape, check_symmetric, cholesky, symmetric_part,
};
use crate::method::modes::{ModeSet, Modes, check_count, solve};
use crate::method::pairing::{Pairing, cross_orthogonality, pair_modes, paired, signed_assurance};
use crate::method::state::{SummedChange, with_rigid_bodies};
use crate::method::structure::positive;
use nalgebra::DMatrix;
use std::f64::consts::PI;

/// Part of a variance that must be left when those before have explained what they can of it.
pub(crate) const HALF_THE_DIGITS: f64 = 1e-8;

/// What one parameter holds of a matrix: at d DOF (d × d), or in n modes as $V^t K_e V$ or $V^t M_e V$ (n × n).
#[derive(Debug, Clone, PartialEq)]
pub enum ParameterMatrix {
    /// Of the stiffness, lbf/in, or rad²/s² in mass-orthonormal modes.
    Stiffness(DMatrix<f64>),
    /// Of the mass, lbf·s²/in, or a fraction in mass-orthonormal modes.
    Mass(DMatrix<f64>),
}

impl ParameterMatrix {
    /// The matrix, whatever it is a share of.
    pub fn matrix(&self) -> &DMatrix<f64> {
        match self {
            Self::Stiffness(matrix) | Self::Mass(matrix) => matrix,
        }
    }

    /// A share of the same kind with another matrix made from this one's.
    pub fn map(&self, change: impl FnOnce(&DMatrix<f64>) -> DMatrix<f64>) -> Self {
        match self {
            Self::Stiffness(matrix) => Self::Stiffness(change(matrix)),
            Self::Mass(matrix) => Self::Mass(change(matrix)),
        }
    }
}

/// A model given by its matrices at the dynamic DOF, whatever made them.
#[derive(Debug, Clone, PartialEq)]
pub struct DynamicModel {
    /// Dynamic stiffness $K_D$, lbf/in (d × d).
    pub stiffness: DMatrix<f64>,
    /// Dynamic mass $M$, lbf·s²/in (d × d).
    pub mass: DMatrix<f64>,
    /// Each parameter's present share of either (d × d).
    pub shares: Vec<ParameterMatrix>,
}

impl DynamicModel {
    /// The modal model of the lowest `analysis_modes` modes, of all when none are named.
    ///
    /// # Errors
    /// Those of [`solve`], [`ModeSet::scaled_with`], [`pair_modes`] and [`errors`]; [`Error::Empty`] without parameters;
    /// [`Error::WrongShape`] and [`Error::NotSymmetric`] for a share that does not fit.
    pub fn analyze(
        &self,
        test: &ModeSet,
        analysis_modes: Option<usize>,
    ) -> Result<ModalModel, Error> {
        let dof_count = self.stiffness.nrows();
        for share in &self.shares {
            check_shape("parameter share", share.matrix(), dof_count, dof_count)?;
            check_symmetric("parameter share", share.matrix())?;
        }
        ModalModel::new(
            &self.stiffness,
            &self.mass,
            test,
            analysis_modes,
            |shapes| {
                let through =
                    |matrix: &DMatrix<f64>| symmetric_part(&shapes.tr_mul(&(matrix * shapes)));
                Ok(self.shares.iter().map(|share| share.map(through)).collect())
            },
        )
    }
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
    setting("weight", expected, wrong.unwrap_or(1.0), wrong.is_none())
}

/// Exact modes compared with the test modes.
#[derive(Debug, Clone)]
pub struct ExactResult {
    /// The exact modes, ascending.
    pub modes: Modes,
    /// Which of them answers which test mode.
    pub pairing: Pairing,
    /// Their frequencies in the order of the test modes, Hz.
    pub frequencies_hz: Vec<f64>,
    /// Frequencies of the test without shapes, none unless [`ModalModel::with_lone_frequencies`].
    pub lone: Vec<LoneFrequency>,
    /// Groups of test modes whose shapes are compared as subspaces, none unless [`ModalModel::with_groups`].
    pub together: Vec<Vec<usize>>,
    /// Weights of the components of every test shape beside that of the mode (d × g), ones unless [`ModalModel::with_component_weights`].
    pub component_weights: DMatrix<f64>,
    /// Cholesky factor of the covariance of the weighted residuals; none where they are independent, see [`ModalModel::with_covariance`].
    pub covariance: Option<DMatrix<f64>>,
    /// Their distance from the test modes.
    pub errors: Errors,
}

/// A frequency of the test without a shape, and the mode of the model that it is compared with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoneFrequency {
    /// Hz.
    pub frequency_hz: f64,
    /// The place of the mode among the model's elastic modes, which ascend, from zero.
    pub partner: usize,
}

impl LoneFrequency {
    /// The partner's frequency over the test's, less one.
    pub(crate) fn error(&self, modes: &ModeSet) -> f64 {
        modes.omega_squared[self.partner].sqrt() / (2.0 * PI * self.frequency_hz) - 1.0
    }
}

/// How test modes are paired with analysis modes by their closeness (n × g), such as [`pair_modes`].
pub type Pair = fn(&DMatrix<f64>) -> Result<Pairing, Error>;

/// A model seen through its exact modes, beside the test modes.
#[derive(Debug, Clone)]
pub struct ModalModel {
    /// The exact modes and how far they are from the test.
    pub(crate) exact: ExactResult,
    /// The test modes, scaled to unit generalized mass with the model's mass.
    pub(crate) test: ModeSet,
    /// The shapes that changes are followed in (N): the exact modes, further ones, and last rigid-body modes, with $\omega^2 = 0$.
    pub(crate) basis: ModeSet,
    /// Cross-orthogonality of the basis with the test modes (4), or the cosine between them, N × g; zero for further shapes.
    pub(crate) cross: DMatrix<f64>,
    /// The rule that pairs them.
    pub(crate) pair: Pair,
    /// Weights of the test modes in the error sum, ones unless [`Self::weighted`].
    pub(crate) weights: Vec<ModeWeight>,
    /// Generalized stiffness or mass of every parameter, $V^t K_e V$ (rad²/s²) or $V^t M_e V$ (N × N).
    pub(crate) shares: Vec<ParameterMatrix>,
    /// The same on the test shapes, relative to the test's own: $V_{Gi}^t K_e V_{Gj}/(\omega_{Gi} \omega_{Gj})$ or
    /// $V_{Gi}^t M_e V_{Gj}$ (g × g).
    pub(crate) test_shares: Vec<DMatrix<f64>>,
    /// Mean gage (in) or area (in²) of every parameter's elements; [`REFERENCE_GAGE`] for one that has none.
    pub(crate) sizes: Vec<f64>,
}

impl ModalModel {
    /// The exact modes and how far they are from the test.
    pub fn exact(&self) -> &ExactResult {
        &self.exact
    }

    /// The test modes, scaled to unit generalized mass with the model's mass.
    pub fn test(&self) -> &ModeSet {
        &self.test
    }

    /// The shapes that changes are followed in (N): the exact modes, further ones, and last rigid-body modes, with $\omega^2 = 0$.
    pub fn basis(&self) -> &ModeSet {
        &self.basis
    }

    /// How many shapes of the basis are no rigid-body modes.
    pub(crate) fn vibration_count(&self) -> usize {
        let k = &self.basis.omega_squared;
        k.iter().filter(|square| **square > 0.0).count()
    }

    /// Cross-orthogonality of the basis with the test modes (4), or the cosine between them, N × g; zero for further shapes.
    pub fn cross(&self) -> &DMatrix<f64> {
        &self.cross
    }

    /// Weights of the test modes in the error sum, ones unless [`Self::weighted`].
    pub fn weights(&self) -> &[ModeWeight] {
        &self.weights
    }

    /// Generalized stiffness or mass of every parameter, $V^t K_e V$ (rad²/s²) or $V^t M_e V$ (N × N).
    pub fn shares(&self) -> &[ParameterMatrix] {
        &self.shares
    }

    /// The same on the test shapes, relative to the test's own: $V_{Gi}^t K_e V_{Gj}/(\omega_{Gi} \omega_{Gj})$ or
    /// $V_{Gi}^t M_e V_{Gj}$ (g × g).
    pub fn test_shares(&self) -> &[DMatrix<f64>] {
        &self.test_shares
    }

    /// Mean gage (in) or area (in²) of every parameter's elements; [`REFERENCE_GAGE`] for one that has none.
    pub fn sizes(&self) -> &[f64] {
        &self.sizes
    }

    /// Solves for the lowest `analysis_modes` modes (all when none are named), compares them with the test modes, and takes
    /// every parameter's share through both sets of shapes.
    ///
    /// `stiffness` (lbf/in) and `mass` (lbf·s²/in) are those of the compared DOF (d × d). The test modes may have any scale.
    /// `shares` returns $V^t K_e V$ or $V^t M_e V$ of every parameter for given shapes (d × m).
    pub(crate) fn new(
        stiffness: &DMatrix<f64>,
        mass: &DMatrix<f64>,
        test: &ModeSet,
        analysis_modes: Option<usize>,
        shares: impl FnOnce(&DMatrix<f64>) -> Result<Vec<ParameterMatrix>, Error>,
    ) -> Result<Self, Error> {
        let modes = solve(stiffness, mass, analysis_modes.unwrap_or(stiffness.nrows()))?;
        let test = test.scaled_with(mass)?;
        let cross = cross_orthogonality(&modes, &test, mass)?;
        // Both sets of shapes go through an element at once; the two diagonal blocks of the result are what is wanted.
        let (count, test_count) = (modes.len(), test.len());
        let mut both = modes
            .shapes
            .clone()
            .resize_horizontally(count + test_count, 0.0);
        both.columns_mut(count, test_count).copy_from(&test.shapes);
        let through_both = shares(&both)?;
        let block = |matrix: &DMatrix<f64>, first, size| {
            matrix.view((first, first), (size, size)).into_owned()
        };
        let of_test =
            |share: &ParameterMatrix| share.map(|matrix| block(matrix, count, test_count));
        let test_shares = through_both.iter().map(of_test).collect();
        let shares = through_both
            .iter()
            .map(|share| share.map(|matrix| block(matrix, 0, count)))
            .collect();
        let pairing = pair_modes(&cross)?;
        let basis = modes.clone().into();
        Self::compared(
            (modes, test),
            (basis, cross),
            (pair_modes, pairing),
            shares,
            test_shares,
        )
    }

    /// The same of exact modes that some sensors see (d × n), without a mass there.
    ///
    /// They are paired by `pair` with the cosine between two shapes in place of their cross-orthogonality; its square is the
    /// modal assurance criterion. Every test mode is scaled by its modal scale factor to the mode it is paired with, whose
    /// generalized stiffness stands for its own. `further` shapes of the basis, orthonormal to the modes in the whole model's mass and
    /// diagonal in its stiffness, are paired with none; rigid-body modes are the last of them. `shares` are $V^t K_e V$ or $V^t M_e V$
    /// (N × N) with the basis at all DOF.
    pub(crate) fn at_sensors(
        modes: Modes,
        further: &ModeSet,
        test: &ModeSet,
        pair: Pair,
        shares: Vec<ParameterMatrix>,
    ) -> Result<Self, Error> {
        let cross =
            signed_assurance(&modes.shapes, &test.shapes)?.map(|a| a.signum() * a.abs().sqrt());
        let pairing = pair(&cross)?;
        let mut scaled = test.clone();
        for (j, mut shape) in scaled.shapes.column_iter_mut().enumerate() {
            let partner = modes.shapes.column(pairing.analysis_mode[j]);
            shape *= pairing.sign[j] * partner.dot(&shape) / shape.norm_squared();
        }
        let Pairing {
            analysis_mode,
            sign,
        } = &pairing;
        let of_pairs = |matrix: &DMatrix<f64>| {
            let entry = |j: usize, k: usize| {
                sign[j] * sign[k] * matrix[(analysis_mode[j], analysis_mode[k])]
            };
            DMatrix::from_fn(sign.len(), sign.len(), entry)
        };
        let test_shares = shares.iter().map(|share| share.map(of_pairs)).collect();
        let mut basis: ModeSet = modes.clone().into();
        basis
            .omega_squared
            .extend(further.omega_squared.iter().copied());
        basis.shapes.extend(further.shapes.column_iter());
        let cross = cross.resize_vertically(basis.len(), 0.0);
        Self::compared(
            (modes, scaled),
            (basis, cross),
            (pair, pairing),
            shares,
            test_shares,
        )
    }

    /// The model that follows from this one at `factors` on its shares, exact in its basis: the modes of $k + \beta$ with $I + \alpha$ in
    /// place of an analysis, paired anew as [`Self::at_sensors`] does.
    pub(crate) fn followed(&self, factors: &[f64]) -> Result<Self, Error> {
        check_length("parameter factors", factors.len(), self.shares.len())?;
        let SummedChange {
            k,
            beta,
            alpha,
            apart,
        } = SummedChange::new(self, factors)?;
        let identity = DMatrix::identity(k.len(), k.len());
        let stiffness = symmetric_part(&(DMatrix::from_diagonal(&k) + beta));
        let vibrations = solve(&stiffness, &symmetric_part(&(identity + alpha)), k.len())?;
        let mut generalized = with_rigid_bodies(apart, vibrations.shapes.clone());
        let (count, size) = (self.exact.modes.len(), self.basis.len());
        let shapes = &self.basis.shapes * &generalized;
        let squares = vibrations
            .omega_squared
            .clone()
            .resize_vertically(size, 0.0);
        let further = ModeSet {
            omega_squared: squares.rows(count, size - count).into_owned(),
            shapes: shapes.columns(count, size - count).into_owned(),
        };
        let seen = shapes.columns(0, count).into_owned();
        let squares = squares.rows(0, count).into_owned();
        let modes = Modes::seen(squares, &seen, &mut generalized);
        let transposed = generalized.transpose();
        let through = |matrix: &DMatrix<f64>, factor: f64| {
            symmetric_part(&(factor * &transposed * (matrix * &generalized)))
        };
        let shares = self.shares.iter().zip(factors);
        let shares = shares.map(|(share, &factor)| share.map(|matrix| through(matrix, factor)));
        let model = Self::at_sensors(modes, &further, &self.test, self.pair, shares.collect())?;
        let mut lone = self.exact.lone.clone();
        if !lone.is_empty() {
            // What a partner has become is most of it in the coordinates of the modes, in which the mass is one.
            let partners: Vec<usize> = lone.iter().map(|lone| lone.partner).collect();
            let became = generalized
                .columns(0, count)
                .select_rows(&partners)
                .transpose();
            let became = pair_modes(&became)?.analysis_mode;
            lone.iter_mut()
                .zip(became)
                .for_each(|(lone, mode)| lone.partner = mode);
        }
        let mut model = model
            .with_sizes(self.sizes.clone())
            .with_groups(self.exact.together.clone())?
            .with_component_weights(self.exact.component_weights.clone())?
            .with_lone_frequencies(lone)?;
        model.exact.covariance.clone_from(&self.exact.covariance);
        Ok(model)
    }

    /// The modal model of exact modes and test modes paired by a rule: their distance, and the shares in the basis and on the test
    /// shapes.
    fn compared(
        (modes, test): (Modes, ModeSet),
        (basis, cross): (ModeSet, DMatrix<f64>),
        (pair, pairing): (Pair, Pairing),
        shares: Vec<ParameterMatrix>,
        on_test: Vec<ParameterMatrix>,
    ) -> Result<Self, Error> {
        let omega = test.omega_squared.map(f64::sqrt);
        let relative = |share: ParameterMatrix| match share {
            ParameterMatrix::Stiffness(matrix) => {
                matrix.component_div(&(&omega * omega.transpose()))
            }
            ParameterMatrix::Mass(matrix) => matrix,
        };
        let test_shares = on_test.into_iter().map(relative).collect();
        let frequencies_hz = paired(&modes, &pairing)?.frequencies_hz();
        let errors = errors(&modes, &pairing, &test)?;
        let exact = ExactResult {
            modes,
            pairing,
            frequencies_hz,
            lone: Vec::new(),
            together: Vec::new(),
            component_weights: DMatrix::from_element(test.shapes.nrows(), test.len(), 1.0),
            covariance: None,
            errors,
        };
        let (sizes, weights) = (
            vec![REFERENCE_GAGE; shares.len()],
            vec![ModeWeight::ONE; test.len()],
        );
        Ok(Self {
            exact,
            test,
            basis,
            cross,
            pair,
            weights,
            shares,
            test_shares,
            sizes,
        })
    }

    /// The same model with weights of the test modes: in all errors $w_i e_i$ stands for $e_i$ of (5) and (6).
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless there is one weight per test mode; [`Error::Setting`] for one that is negative or not finite, and when
    /// all are zero.
    pub fn weighted(mut self, weights: &[ModeWeight]) -> Result<Self, Error> {
        check_weights(weights, self.test.len())?;
        self.weights = weights.to_vec();
        self.exact.errors = self.errors_of(&self.exact.modes, &self.exact.pairing)?;
        Ok(self)
    }

    /// The same model that is also compared with frequencies of the test that have no shapes. They count among the frequencies of the
    /// error sum and of the residuals, and nowhere else.
    ///
    /// # Errors
    /// [`Error::NotPositive`] for a frequency; [`Error::TooMany`] for a partner that the model has not; [`Error::NotFinite`].
    pub fn with_lone_frequencies(mut self, lone: Vec<LoneFrequency>) -> Result<Self, Error> {
        for (place, frequency) in lone.iter().enumerate() {
            let owner = || format!("frequency {place} without a shape (from zero)");
            positive("frequency", owner, frequency.frequency_hz)?;
            check_count(
                "modes",
                frequency.partner.saturating_add(1),
                self.exact.modes.len(),
            )?;
        }
        self.exact.lone = lone;
        self.exact.errors = self.errors_of(&self.exact.modes, &self.exact.pairing)?;
        Ok(self)
    }

    /// The same model with groups of test modes (from zero) whose shapes are compared as subspaces: weighted residuals alone do so.
    ///
    /// # Errors
    /// [`Error::TooMany`] for a test mode that there is not.
    pub fn with_groups(mut self, together: Vec<Vec<usize>>) -> Result<Self, Error> {
        for mode in together.iter().flatten() {
            check_count("test modes", mode.saturating_add(1), self.test.len())?;
        }
        self.exact.together = together;
        Ok(self)
    }

    /// The same model with weights of the components of every test shape (d × g), which multiply those of the modes: weighted residuals
    /// alone have them.
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless there is one a component and test mode; [`Error::Setting`] for one that is not positive and finite.
    pub fn with_component_weights(mut self, weights: DMatrix<f64>) -> Result<Self, Error> {
        let (dof, modes) = self.test.shapes.shape();
        check_shape("component weights", &weights, dof, modes)?;
        weights
            .iter()
            .try_for_each(|&weight| positive_setting("component weight", weight))?;
        self.exact.component_weights = weights;
        Ok(self)
    }

    /// The same model with the covariance of its weighted residuals (N × N, in their order), which then are not independent.
    ///
    /// # Errors
    /// [`Error::WrongShape`] and those of [`cholesky`], also where less than half the digits of a variance are its own.
    pub fn with_covariance(mut self, covariance: &DMatrix<f64>) -> Result<Self, Error> {
        let (dof, modes) = self.test.shapes.shape();
        let numbers = (1 + dof) * modes + self.exact.lone.len();
        check_shape("covariance of residuals", covariance, numbers, numbers)?;
        let factor = cholesky("covariance of residuals", covariance, HALF_THE_DIGITS)?;
        self.exact.covariance = Some(factor);
        Ok(self)
    }

    /// Errors of every test mode, then of the frequencies without shapes.
    pub(crate) fn mode_errors(&self, modes: &ModeSet) -> Result<Vec<ModeError>, Error> {
        let ExactResult { pairing, lone, .. } = &self.exact;
        let mut all = mode_errors(modes, pairing, &self.test)?;
        all.extend(lone.iter().map(|lone| ModeError {
            frequency: lone.error(modes),
            shape: None,
        }));
        Ok(all)
    }

    /// The largest part of a test mode's stiffness or mass that each parameter has.
    pub(crate) fn largest_parts(&self) -> Vec<f64> {
        let part = |(share, on_test): (&ParameterMatrix, &DMatrix<f64>)| {
            let of_lone = |lone: &LoneFrequency| match share {
                ParameterMatrix::Stiffness(beta) => {
                    beta[(lone.partner, lone.partner)]
                        / self.exact.modes.omega_squared[lone.partner]
                }
                ParameterMatrix::Mass(alpha) => alpha[(lone.partner, lone.partner)],
            };
            let lone = self.exact.lone.iter().map(of_lone);
            lone.fold(on_test.diagonal().amax(), f64::max)
        };
        self.shares
            .iter()
            .zip(&self.test_shares)
            .map(part)
            .collect()
    }

    /// The same model with the mean gage or area of every parameter's elements.
    pub(crate) fn with_sizes(self, sizes: Vec<f64>) -> Self {
        Self { sizes, ..self }
    }

    /// How far paired modes are from the test modes, with the weights.
    pub(crate) fn errors_of(&self, modes: &ModeSet, pairing: &Pairing) -> Result<Errors, Error> {
        let mut errors = weighted_errors(modes, pairing, &self.test, &self.weights)?;
        errors.lone_count = self.exact.lone.len();
        for lone in &self.exact.lone {
            errors.frequency = errors.frequency.hypot(lone.error(modes));
        }
        check_error_sum(errors.sum()).map(|()| errors)
    }
}
