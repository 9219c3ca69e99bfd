//! Table 1: how fast the roots of two-degree-of-freedom problems converge by the original formulae, by Recursive 1
//! and by Recursive 2.
//!
//! The numbers of the paper's own Table 1, and the problems behind them, are lost in the scan. The problems here are
//! two unit masses on equal springs to the ground, joined by a coupling spring, one ground spring being changed: the
//! modes before the change and the roots after it are known in closed form.

use crate::method::appendix_c::Pencil;
use crate::method::error::{Error, require};
use crate::method::modes::check_vibrations;
use crate::method::perturbation::{first_order, recursive_1};
use nalgebra::{DMatrix, DVector, dmatrix, dvector};

/// A column of the table: one of the formulae of Appendix C, at an order of approximation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Formula {
    /// First order (C.20, C.21).
    FirstOrder,
    /// The original formulae of 1947: roots of second order from first-order shapes.
    Original,
    /// Recursive 1 (C.22).
    Recursive1 {
        /// The order, from 1.
        order: usize,
    },
    /// Recursive 2 (C.24).
    Recursive2 {
        /// The order, from 1.
        order: usize,
    },
}

/// Two unit masses, each on a unit spring to the ground, joined by a coupling spring; the first ground spring is
/// changed. Dimensionless.
///
/// $$ K = \begin{bmatrix} 1 + \kappa & -\kappa \newline -\kappa & 1 + \kappa \end{bmatrix}, \qquad
///    \Delta K = \begin{bmatrix} \varepsilon & 0 \newline 0 & 0 \end{bmatrix}, \qquad M = I $$
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoMasses {
    /// Coupling spring $\kappa$ relative to a ground spring, positive. The weaker, the closer the two roots.
    pub coupling: f64,
    /// Change $\varepsilon$ of the first ground spring relative to itself, above −1.
    pub change: f64,
}

impl TwoMasses {
    /// Generalized stiffness before the change, $k = (1,\ 1 + 2\kappa)$: the masses move together, then against each
    /// other.
    pub fn generalized_stiffness(&self) -> DVector<f64> {
        dvector![1.0, 1.0 + 2.0 * self.coupling]
    }

    /// $\beta = V^t \Delta K V$ (2 × 2), every entry $\varepsilon/2$: both modes move the changed spring alike.
    pub fn beta(&self) -> DMatrix<f64> {
        let half = 0.5 * self.change;
        dmatrix![half, half; half, half]
    }

    /// Exact roots $1/\omega^2$ after the change, the larger first:
    ///
    /// $$ \omega_2^2 = 1 + \kappa + \frac{\varepsilon}{2} + \sqrt{\kappa^2 + \frac{\varepsilon^2}{4}}, \qquad
    ///    \omega_1^2 \omega_2^2 = 1 + \varepsilon + \kappa(2 + \varepsilon). $$
    pub fn exact_roots(&self) -> [f64; 2] {
        let Self { coupling, change } = self;
        let upper = 1.0 + coupling + 0.5 * change + coupling.hypot(0.5 * change);
        // The product and not the difference gives the lower one, so that nothing cancels.
        let product = 1.0 + change + coupling * (2.0 + change);
        [upper / product, 1.0 / upper]
    }

    /// Relative error $\gamma/\gamma_{exact} - 1$ of both roots by one formula.
    ///
    /// # Errors
    /// [`Error::Value`] for springs out of their range; what the formula's function refuses.
    pub fn root_errors(&self, formula: Formula) -> Result<[f64; 2], Error> {
        for (name, value, lowest, expected) in [
            ("coupling", self.coupling, 0.0, "a positive finite number"),
            ("change", self.change, -1.0, "a finite number above -1"),
        ] {
            let (is_met, owner) = (value > lowest && value.is_finite(), || "two masses".into());
            require(is_met, name, owner, value, expected)?;
        }
        let exact = self.exact_roots();
        let (k, beta) = (self.generalized_stiffness(), self.beta());
        let pencil = Pencil::of_vibrations(&k, &beta, &DMatrix::zeros(2, 2))?;
        let perturbed = match formula {
            Formula::FirstOrder => first_order(&k, &beta),
            Formula::Original => pencil.original(),
            Formula::Recursive1 { order } => recursive_1(&k, &beta, order),
            Formula::Recursive2 { order } => pencil.recursive_2(order),
        }?;
        check_vibrations(&perturbed.roots)?;
        Ok([0, 1].map(|i| perturbed.roots[i] / exact[i] - 1.0))
    }
}

/// The columns of the table: first order, the original formulae (roots of second order), then Recursive 1 and Recursive 2 from
/// second order to the order `orders`.
pub fn formulae(orders: usize) -> Vec<Formula> {
    let recursive_1 = (2..=orders).map(|order| Formula::Recursive1 { order });
    let recursive_2 = (2..=orders).map(|order| Formula::Recursive2 { order });
    [Formula::FirstOrder, Formula::Original]
        .into_iter()
        .chain(recursive_1)
        .chain(recursive_2)
        .collect()
}

/// The problems of the printed table: couplings from a quarter to twice a ground spring, changes from −50 to +100 %.
pub fn problems() -> Vec<TwoMasses> {
    let couplings = [0.25, 0.5, 1.0, 2.0];
    let changes = [-0.5, -0.2, 0.1, 0.2, 0.5, 1.0];
    couplings
        .into_iter()
        .flat_map(|coupling| changes.map(|change| TwoMasses { coupling, change }))
        .collect()
}
