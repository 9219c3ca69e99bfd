//! The modal problem of one inner loop: everything a step needs, reduced to the analysis modes.

use crate::method::appendix_c::{
    ModalChange, Perturbed, UpdateRule, normalize_with_mass, perturb, perturb_with_mass,
};
use crate::method::error::Error;
use crate::method::error_sum::{Errors, errors};
use crate::method::linear_algebra::{
    RankOneTerms, check_length, check_shape, check_symmetric, rank_one_terms, symmetric_part,
};
use crate::method::modes::Modes;
use crate::method::pairing::{Pairing, cross_orthogonality, pair_modes};
use nalgebra::{DMatrix, DVector};

/// One parameter's share of a matrix (d × d at the dynamic DOF, n × n in modes).
#[derive(Debug, Clone, PartialEq)]
pub enum Share {
    /// Of the stiffness, lbf/in or rad²/s².
    Stiffness(DMatrix<f64>),
    /// Of the mass, lbf·s²/in or a fraction.
    Mass(DMatrix<f64>),
}

impl Share {
    /// The matrix, whatever it is a share of.
    pub fn matrix(&self) -> &DMatrix<f64> {
        match self {
            Self::Stiffness(matrix) | Self::Mass(matrix) => matrix,
        }
    }
}

/// What a finite element analysis hands to the correlation: matrices at the dynamic DOF.
#[derive(Debug, Clone)]
pub struct DynamicModel {
    /// Dynamic stiffness $K_D$, lbf/in (d × d).
    pub stiffness: DMatrix<f64>,
    /// Dynamic mass $M$, lbf·s²/in (d × d).
    pub mass: DMatrix<f64>,
    /// Each parameter's present share of either, $B K_e B^t$ or $B M_e B^t$ with the same $B$ for all (d × d).
    pub shares: Vec<Share>,
}

/// The last exact modes, and every share and test mode seen through them.
#[derive(Debug, Clone)]
pub struct ModalProblem {
    /// The exact modes at the start of the inner loop.
    pub start: Modes,
    /// The test modes, scaled to unit generalized mass with the model's mass.
    pub test: Modes,
    /// $V^t K_e V$ (rad²/s²) or $V^t M_e V$ of every parameter's share (n × n).
    pub generalized_shares: Vec<Share>,
    /// The same as sums of rank-one terms, few for an element: what the derivatives work with.
    pub share_terms: Vec<RankOneTerms>,
    /// Generalized stiffness or mass of every share on the test modes relative to theirs,
    /// $V_{Gi}^t K_e V_{Gi}/\omega_{Gi}^2$ or $V_{Gi}^t M_e V_{Gi}$ (test modes × parameters).
    pub test_shares: DMatrix<f64>,
    /// Cross-orthogonality of the start modes with the test modes (n × g).
    pub start_cross: DMatrix<f64>,
}

impl ModalProblem {
    /// Reduces a dynamic model to its lowest `analysis_modes` modes.
    ///
    /// # Errors
    /// Those of [`crate::method::modes::solve`]; [`Error::Empty`] without parameters; [`Error::TooMany`] with more test
    /// modes than analysis modes; [`Error::WrongShape`] and [`Error::NotSymmetric`] for a share that does not fit.
    pub fn new(model: &DynamicModel, test: &Modes, analysis_modes: usize) -> Result<Self, Error> {
        if model.shares.is_empty() {
            return Err(Error::Empty { what: "parameters" });
        }
        let dof_count = model.stiffness.nrows();
        let start = crate::method::modes::solve(&model.stiffness, &model.mass, analysis_modes)?;
        let test = test.scaled_with(&model.mass)?;
        let start_cross = cross_orthogonality(&start, &test, &model.mass)?;
        pair_modes(&start_cross)?;
        let mut generalized_shares = Vec::with_capacity(model.shares.len());
        let mut share_terms = Vec::with_capacity(model.shares.len());
        let mut test_shares = DMatrix::zeros(test.len(), model.shares.len());
        for (e, share) in model.shares.iter().enumerate() {
            let matrix = share.matrix();
            check_shape("parameter share", matrix, dof_count, dof_count)?;
            check_symmetric("parameter share", matrix)?;
            let in_modes = start.shapes.tr_mul(&(matrix * &start.shapes));
            for i in 0..test.len() {
                let shape = test.shapes.column(i);
                test_shares[(i, e)] = shape.dot(&(matrix * shape));
                if let Share::Stiffness(_) = share {
                    test_shares[(i, e)] /= test.omega_squared[i];
                }
            }
            share_terms.push(rank_one_terms(
                "generalized share",
                &symmetric_part(&in_modes),
            )?);
            generalized_shares.push(match share {
                Share::Stiffness(_) => Share::Stiffness(in_modes),
                Share::Mass(_) => Share::Mass(in_modes),
            });
        }
        Ok(Self {
            start,
            test,
            generalized_shares,
            share_terms,
            test_shares,
            start_cross,
        })
    }

    /// Number of parameters.
    pub fn parameter_count(&self) -> usize {
        self.generalized_shares.len()
    }

    /// The state before any change: all factors one, the start modes.
    pub fn start_state(&self) -> Result<ModalState, Error> {
        let count = self.start.len();
        self.state(
            vec![1.0; self.parameter_count()],
            &self.start.omega_squared,
            DMatrix::identity(count, count),
            0.0,
        )
    }

    /// The state at `factors` on the shares, the cumulative change since the last exact modes taken at once:
    ///
    /// $$ \beta = \sum_{stiffness} (c_e - 1) V^t K_e V, \qquad \alpha = \sum_{mass} (c_e - 1) V^t M_e V $$
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless there is one factor per parameter; those of [`perturb`] and
    /// [`perturb_with_mass`]; [`Error::UnsettledRoots`] when a rule with a tolerance stays far from it, as plain
    /// Recursive 1 does where roots are close.
    pub fn state_at(&self, factors: Vec<f64>, rule: UpdateRule) -> Result<ModalState, Error> {
        check_length("parameter factors", factors.len(), self.parameter_count())?;
        let count = self.start.len();
        let (mut beta, mut alpha) = (DMatrix::zeros(count, count), DMatrix::zeros(count, count));
        for (share, factor) in self.generalized_shares.iter().zip(&factors) {
            match share {
                Share::Stiffness(matrix) => beta += (factor - 1.0) * matrix,
                Share::Mass(matrix) => alpha += (factor - 1.0) * matrix,
            }
        }
        let k = &self.start.omega_squared;
        let has_mass = self
            .generalized_shares
            .iter()
            .any(|share| matches!(share, Share::Mass(_)));
        // The real stiffness-only path is the plain one; the general one serves changes of mass.
        let Perturbed {
            roots,
            mut shapes,
            last_change,
            ..
        } = if has_mass {
            perturb_with_mass(&ModalChange::of_vibrations(k, beta, alpha.clone()), rule)?
        } else {
            perturb(k, &beta, rule)?
        };
        rule.check_settled(last_change)?;
        normalize_with_mass(&mut shapes, &alpha)?;
        self.state(factors, &roots.map(f64::recip), shapes, last_change)
    }

    fn state(
        &self,
        factors: Vec<f64>,
        omega_squared: &DVector<f64>,
        generalized_shapes: DMatrix<f64>,
        last_change: f64,
    ) -> Result<ModalState, Error> {
        let pairing = pair_modes(&generalized_shapes.tr_mul(&self.start_cross))?;
        let modes = Modes {
            omega_squared: omega_squared.clone(),
            shapes: &self.start.shapes * &generalized_shapes,
        };
        let errors = errors(&modes, &pairing, &self.test);
        Ok(ModalState {
            factors,
            modes,
            generalized_shapes,
            pairing,
            errors,
            last_change,
        })
    }
}

/// Where an inner loop stands: the factors so far and the modes and errors they give.
#[derive(Debug, Clone)]
pub struct ModalState {
    /// Total factor on each parameter's share since the last exact modes.
    pub factors: Vec<f64>,
    /// Modes, by perturbation from the last exact ones.
    pub modes: Modes,
    /// The same shapes in terms of the last exact ones, of unit generalized mass (n × n).
    pub generalized_shapes: DMatrix<f64>,
    /// Which mode answers which test mode.
    pub pairing: Pairing,
    /// Distance from the test modes.
    pub errors: Errors,
    /// Largest relative change of a root in the perturbation's last order, zero after an eigensolution: how far the
    /// recursion had still to go when it reached its tolerance or the most orders allowed.
    pub last_change: f64,
}
