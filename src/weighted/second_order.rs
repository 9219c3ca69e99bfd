//! Second-order part of the curvature of a sum of squares, which Gauss and Newton leave out, learned from gradients.

use nalgebra::{DMatrix, DVector};

/// Estimate of $S = \sum r_i H_i$ with the second derivatives $H_i$ of the residuals at a place, a secant update a step.
///
/// Source: Dennis, Gay and Welsch, *ACM Transactions on Mathematical Software* 7 (1981), 348.
#[derive(Debug)]
pub struct SecondOrder {
    sum: DMatrix<f64>,
    is_told: bool,
}

impl SecondOrder {
    /// Nothing learned yet of `count` parameters.
    pub fn new(count: usize) -> Self {
        Self {
            sum: DMatrix::zeros(count, count),
            is_told: false,
        }
    }

    /// The estimate, if it foretold the gradient after the last step better than nothing in its place.
    pub fn told(&self) -> Option<&DMatrix<f64>> {
        self.is_told.then_some(&self.sum)
    }

    /// Learns from a step $h$ on which the gradient gained $y$ and $z = (J_+ - J)^t r_+$ of it is of second order: afterwards $S h = z$,
    ///
    /// $$ S_+ = S + \frac{w y^t + y w^t}{y^t h} - \frac{w^t h}{(y^t h)^2} y y^t, \qquad w = z - S h , $$
    ///
    /// with $S$ taken smaller first where $|h^t S h| > |h^t z|$. A step along which the gradient falls teaches nothing.
    pub fn learn(&mut self, step: &DVector<f64>, gained: &DVector<f64>, own: DVector<f64>) {
        let (foretold, along) = (&self.sum * step, gained.dot(step));
        self.is_told = (&own - &foretold).norm() < own.norm();
        if along <= 0.0 {
            return;
        }
        let size = step.dot(&own).abs() / step.dot(&foretold).abs();
        if size < 1.0 {
            self.sum *= size;
        }
        let wrong = own - &self.sum * step;
        let turned = &wrong * gained.transpose();
        self.sum += (&turned + turned.transpose()) / along
            - gained * gained.transpose() * (wrong.dot(step) / along.powi(2));
    }
}
