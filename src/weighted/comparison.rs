//! A model beside a test as weighted steps compare them: with groups of close modes, frequencies without shapes, and what is known of
//! the errors of components.

use super::close_modes::{members, turned};
use crate::method::analysis::State;
use crate::method::error::{Error, check_count, positive, require};
use crate::method::error_sum::{Errors, ModeError, mode_errors};
use crate::method::linear_algebra::check_shape;
use crate::method::model::ModalModel;
use crate::method::modes::Modes;
use crate::method::sorting::Pairing;
#[cfg(feature = "program")]
use crate::method::{analysis::Analysis, derivatives::DERIVATIVE_STEP};
use crate::sparse::{Basis, Candidates, ModeWeight, SensorModel, cosines, is_held, is_one_root};
use nalgebra::{DMatrix, DVector};
use serde::Serialize;
use std::f64::consts::TAU;
use std::sync::Arc;

/// A frequency of the test without a shape, and the mode of the model that it is compared with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoneFrequency {
    /// Hz.
    pub frequency_hz: f64,
    /// Place of the mode among the model's elastic modes, which ascend, from zero.
    pub partner: usize,
}

impl LoneFrequency {
    /// The partner's frequency over the test's, less one.
    pub(crate) fn error(&self, modes: &Modes) -> f64 {
        modes.omega_squared[self.partner].sqrt() / (TAU * self.frequency_hz) - 1.0
    }
}

/// Errors of one test mode, which need not have a shape.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct ModeErrors {
    /// Relative difference of its frequency, with its sign.
    pub frequency: f64,
    /// Root mean square difference of its shape, if it has one.
    pub shape: Option<f64>,
}

impl From<ModeError> for ModeErrors {
    fn from(ModeError { frequency, shape }: ModeError) -> Self {
        Self {
            frequency,
            shape: Some(shape),
        }
    }
}

impl ModeErrors {
    /// Sum of their squares.
    pub(crate) fn square(&self) -> f64 {
        self.frequency.powi(2) + self.shape.unwrap_or_default().powi(2)
    }
}

/// Knowledge of weighted steps about a test beside its modes.
#[derive(Debug, Clone)]
pub struct Test {
    /// Groups of test modes (from zero) whose shapes are compared as subspaces.
    pub(crate) together: Vec<Vec<usize>>,
    /// Weights of the components of every test shape beside that of the mode (d × g).
    pub(crate) component_weights: DMatrix<f64>,
    /// Frequencies without shapes.
    pub(crate) lone: Vec<LoneFrequency>,
    /// The shapes of their partners in the first model (d × lone), by which these are followed.
    pub(crate) partner_shapes: Option<DMatrix<f64>>,
}

/// A model seen by sensors beside a test.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// The model, with the test modes at its sensors.
    pub(crate) model: SensorModel,
    /// Knowledge of the test beside its modes.
    pub(crate) test: Test,
    /// Correction of the residuals in a basis to first order, as long as weights stay the same.
    pub(crate) correction: Option<Correction>,
}

/// Difference of exact slopes of residuals from those in a basis, and the logarithms of the factors since the place where it is so.
#[derive(Debug, Clone)]
pub(crate) struct Correction {
    /// Exact Jacobian less that in the basis (residuals × p).
    pub slopes: Arc<DMatrix<f64>>,
    /// Change of every parameter's logarithm.
    pub moved: DVector<f64>,
}

impl From<SensorModel> for Comparison {
    /// A comparison in which every number of the test is independent and every shape stands alone.
    fn from(model: SensorModel) -> Self {
        let (dof, modes) = model.test.shapes.shape();
        Self {
            test: Test {
                together: Vec::new(),
                component_weights: DMatrix::from_element(dof, modes, 1.0),
                lone: Vec::new(),
                partner_shapes: None,
            },
            correction: None,
            model,
        }
    }
}

impl From<&ModalModel> for Comparison {
    /// The paper's analysis with the dynamic DOF as sensors.
    fn from(model: &ModalModel) -> Self {
        Self::from(SensorModel::from(model))
    }
}

impl Comparison {
    /// The model, with the test modes at its sensors.
    pub fn model(&self) -> &SensorModel {
        &self.model
    }

    /// The model alone, for loops that know nothing else of the test.
    pub fn into_model(self) -> SensorModel {
        self.model
    }

    /// Frequencies of the test without shapes.
    pub fn lone(&self) -> &[LoneFrequency] {
        &self.test.lone
    }

    /// Modes of the model, from zero, that the test modes are paired with, those without shapes last.
    pub(crate) fn partners(&self) -> Vec<usize> {
        let lone = self.lone().iter().map(|lone| &lone.partner);
        let paired = self.model.exact.pairing.analysis_mode.iter();
        paired.chain(lone).copied().collect()
    }

    /// This comparison with groups of test modes (from zero) whose shapes are compared as subspaces.
    ///
    /// # Errors
    /// [`Error::Count`] for a test mode that there is not.
    pub fn with_groups(mut self, together: Vec<Vec<usize>>) -> Result<Self, Error> {
        for mode in together.iter().flatten() {
            check_count(
                "test modes",
                mode.saturating_add(1),
                1,
                self.model.test.len(),
            )?;
        }
        self.test.together = together;
        Ok(self)
    }

    /// This comparison with weights of the components of every test shape (d × g), which multiply those of the modes.
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless there is one a component and test mode; [`Error::Value`] for one that is not positive and finite.
    pub fn with_component_weights(mut self, weights: DMatrix<f64>) -> Result<Self, Error> {
        let (dof, modes) = self.model.test.shapes.shape();
        check_shape("component weights", &weights, dof, modes)?;
        for &weight in &weights {
            positive("component weight", || "a test shape".into(), weight)?;
        }
        self.test.component_weights = weights;
        Ok(self)
    }

    /// This comparison with frequencies of the test that have no shapes as well.
    ///
    /// # Errors
    /// [`Error::Value`] for a frequency that is not positive; [`Error::Count`] for a partner that the model has not.
    pub fn with_lone_frequencies(mut self, lone: Vec<LoneFrequency>) -> Result<Self, Error> {
        let modes = self.model.exact.modes.len();
        for (place, frequency) in lone.iter().enumerate() {
            let owner = || format!("frequency {place} without a shape (from zero)");
            positive("frequency", owner, frequency.frequency_hz)?;
            check_count("modes", frequency.partner.saturating_add(1), 1, modes)?;
        }
        self.test.lone = lone;
        Ok(self)
    }

    /// This comparison with partners of the frequencies without shapes that are most like these shapes (d × frequencies): the modes of the
    /// largest sum of modal assurance with them, except modes that a test mode's shape has chosen.
    ///
    /// # Errors
    /// [`Error::WrongShape`] for shapes at other sensors; the errors of the pairing.
    pub(crate) fn followed_by_shape(mut self, shapes: DMatrix<f64>) -> Result<Self, Error> {
        let exact = &self.model.exact;
        let mut cross = cosines(&exact.modes.shapes, &shapes)?;
        for &mode in &exact.pairing.analysis_mode {
            cross.row_mut(mode).fill(0.0);
        }
        let candidates = Candidates {
            cross: &cross,
            modes: &exact.modes,
            moves: None,
        };
        let partners = self.model.pair.of(candidates)?.analysis_mode;
        for (lone, partner) in self.test.lone.iter_mut().zip(partners) {
            lone.partner = partner;
        }
        self.test.partner_shapes = Some(shapes);
        Ok(self)
    }

    /// The comparisons of the structure in a basis about this one, whose factors are `from`; with slopes corrected to those of this one where
    /// its Jacobian is given with weights.
    ///
    /// # Errors
    /// Errors of [`jacobian`](super::residuals::jacobian) in the basis.
    pub(crate) fn within(
        &self,
        basis: Basis,
        from: &[f64],
        exact: Option<(&DMatrix<f64>, &[ModeWeight])>,
    ) -> Result<impl Fn(&[f64]) -> Result<Self, Error> + use<>, Error> {
        let (mut test, modes, pair) = (
            self.test.clone(),
            self.model.test.clone(),
            self.model.pair.clone(),
        );
        if !test.lone.is_empty() && test.partner_shapes.is_none() {
            let partners: Vec<usize> = test.lone.iter().map(|lone| lone.partner).collect();
            let shapes = &self.model.exact.modes.shapes;
            test.partner_shapes = Some(shapes.select_columns(&partners));
        }
        let at = move |change: &[f64], correction| {
            let own = Self {
                model: basis.at(change, &modes, &pair)?,
                test: test.clone(),
                correction,
            };
            match &test.partner_shapes {
                Some(shapes) => own.followed_by_shape(shapes.clone()),
                None => Ok(own),
            }
        };
        let slopes = match exact {
            Some((jacobian, weights)) => {
                let own = at(&vec![1.0; from.len()], None)?;
                Some(Arc::new(
                    jacobian - super::residuals::jacobian(&own, weights)?,
                ))
            }
            None => None,
        };
        let from = from.to_vec();
        Ok(move |factors: &[f64]| {
            let change: Vec<f64> = factors
                .iter()
                .zip(&from)
                .map(|(at, from)| at / from)
                .collect();
            let correction = slopes.clone().map(|slopes| Correction {
                moved: DVector::from_column_slice(&change).map(f64::ln),
                slopes,
            });
            at(&change, correction)
        })
    }

    /// True if a compared mode meets another one that is not compared together with it: apart, but by so little that each keeps its
    /// own shape in slopes.
    pub(super) fn meets(&self) -> bool {
        let State { modes, pairing, .. } = &self.model.exact;
        let roots = &modes.omega_squared;
        let meets = |i: usize, r: usize, members: &[usize]| {
            let (own, other) = (roots[i], roots[r]);
            !members.contains(&r) && is_held(own, other) && !is_one_root(own, other)
        };
        (0..self.model.test.len()).any(|j| {
            let members = members(roots, pairing, &self.test.together, j);
            members
                .iter()
                .any(|&i| (0..modes.len()).any(|r| meets(i, r, &members)))
        })
    }

    /// This comparison with exact slopes ([`SensorModel::with_slopes`]).
    pub(crate) fn with_slopes(self) -> Result<Self, Error> {
        Ok(Self {
            model: self.model.with_slopes()?,
            ..self
        })
    }

    /// The exact modes with those of every group turned to the test's.
    pub(crate) fn turned(&self) -> Result<Modes, Error> {
        let State { modes, pairing, .. } = &self.model.exact;
        turned(modes, pairing, &self.test.together, &self.model.test)
    }

    /// Errors of every test mode, then of the frequencies without shapes.
    pub(crate) fn mode_errors(&self) -> Result<Vec<ModeErrors>, Error> {
        let modes = self.turned()?;
        let paired = mode_errors(&modes, &self.model.exact.pairing, &self.model.test)?;
        let lone = self.test.lone.iter().map(|lone| ModeErrors {
            frequency: lone.error(&modes),
            shape: None,
        });
        Ok(paired
            .into_iter()
            .map(ModeErrors::from)
            .chain(lone)
            .collect())
    }

    /// Errors of paired modes, with those of the frequencies without shapes.
    fn with_lone(&self, mut errors: Errors, modes: &Modes) -> Errors {
        for lone in &self.test.lone {
            errors.frequency = errors.frequency.hypot(lone.error(modes));
        }
        errors.frequency_count += self.test.lone.len();
        errors
    }

    /// Changes $\Delta e_e$ (12) of the error sum over all numbers that are compared, at the exact modes.
    ///
    /// # Errors
    /// [`Error::CoalescingModes`] and [`Error::NotAVibration`] where a thousandth of a parameter is too much.
    #[cfg(feature = "program")]
    pub(crate) fn error_changes(&self) -> Result<Vec<f64>, Error> {
        let state = self.model.at(&vec![1.0; self.model.shares.len()])?;
        let sum = |errors, modes: &Modes| self.with_lone(errors, modes).sum();
        let before = sum(state.errors, &state.modes);
        let change = |modes: &Modes| {
            let errors = self.model.errors_of(modes, &state.pairing)?;
            Ok(sum(errors, modes) - before)
        };
        let mut changed = self.model.changed_modes(&state)?;
        for (e, modes) in changed.iter_mut().enumerate() {
            let known = self.model.slopes.iter().enumerate();
            for (mode, slopes) in known.filter_map(|own| Some((own.0, own.1.as_ref()?))) {
                let mut shape = modes.shapes.column_mut(mode);
                shape.copy_from(&state.modes.shapes.column(mode));
                shape.axpy(DERIVATIVE_STEP, &slopes.column(e), 1.0);
            }
        }
        changed.iter().map(change).collect()
    }

    /// The exact solution, with errors over all numbers that are compared.
    ///
    /// # Errors
    /// [`Error::Value`] for modes so far from the test that their errors are not finite.
    pub fn result(&self) -> Result<ExactResult, Error> {
        let State { modes, pairing, .. } = &self.model.exact;
        let errors = self.with_lone(self.model.errors_of(&self.turned()?, pairing)?, modes);
        let (sum, owner) = (errors.sum(), || "these modes".into());
        require(sum.is_finite(), "error sum", owner, sum, "a finite number")?;
        Ok(ExactResult {
            lone: self.test.lone.clone(),
            together: self.test.together.clone(),
            errors,
            ..ExactResult::from(&self.model.exact)
        })
    }
}

/// Exact modes compared with the test modes: what histories and reports keep of an analysis.
#[derive(Debug, Clone)]
pub struct ExactResult {
    /// The exact modes, ascending.
    pub modes: Modes,
    /// Pairs of these with the test modes.
    pub pairing: Pairing,
    /// Frequencies of the paired modes in the order of the test modes, Hz.
    pub frequencies_hz: Vec<f64>,
    /// Frequencies of the test without shapes.
    pub lone: Vec<LoneFrequency>,
    /// Groups of test modes whose shapes are compared as subspaces.
    pub together: Vec<Vec<usize>>,
    /// Their distance from the test modes.
    pub errors: Errors,
}

impl From<&State> for ExactResult {
    /// An exact solution of the loops.
    fn from(state: &State) -> Self {
        let hertz = state.modes.frequencies_hz();
        let paired = state.pairing.analysis_mode.iter();
        Self {
            modes: state.modes.clone(),
            frequencies_hz: paired.map(|&mode| hertz[mode]).collect(),
            pairing: state.pairing.clone(),
            lone: Vec::new(),
            together: Vec::new(),
            errors: state.errors,
        }
    }
}
