//! Complex mode shapes, as tests of damped structures find them: how near to real, and the nearest real shape.

use crate::method::error::{Error, positive};
use crate::method::linear_algebra::check_finite;
use crate::method::modes::apply_sign_rule;
use crate::sparse::finite;
use nalgebra::{Complex, DMatrix};

/// Real shapes (columns, d × g) in place of complex ones, and the modal phase collinearity of each, from 0 to 1.
///
/// A complex shape $v = x + i y$ is turned by the phase $\theta$ that makes its real part largest, and that part is taken, with the
/// first of its largest components positive. With $S_{xx} = x^t x$, $S_{xy} = x^t y$, $S_{yy} = y^t y$ the square of the real part
/// of $e^{-i \theta} v$ is the quadratic form of this 2 × 2 matrix in $(\cos \theta, \sin \theta)$; with its eigenvalues $\mu_1 \ge \mu_2$
///
/// $$ \tan 2 \theta = \frac{2 S_{xy}}{S_{xx} - S_{yy}}, \qquad \mathrm{MPC} = \frac{(\mu_1 - \mu_2)^2}{(\mu_1 + \mu_2)^2}
///    = \frac{(S_{xx} - S_{yy})^2 + 4 S_{xy}^2}{(S_{xx} + S_{yy})^2} . $$
///
/// A complex factor of the shape changes neither, up to the real shape's scale. The mean of the components is not taken
/// off. Where MPC is zero every phase does as well, and the real part stays as it is. Source: Pappa, Elliott and
/// Schenk, *Journal of Guidance, Control, and Dynamics* 16 (1993), 852; Heylen, Lammens and Sas, *Modal Analysis Theory
/// and Testing* (1997).
///
/// # Errors
/// [`Error::Value`] for an entry that is not finite, or naming a shape that is zero.
pub fn realize(shapes: &DMatrix<Complex<f64>>) -> Result<(DMatrix<f64>, Vec<f64>), Error> {
    check_finite("complex mode shapes", shapes)?;
    let (mut real, mut collinearity) = (DMatrix::zeros(shapes.nrows(), shapes.ncols()), Vec::new());
    for (mode, shape) in shapes.column_iter().enumerate() {
        let largest = shape.iter().fold(0.0_f64, |largest, v| {
            largest.max(v.re.abs()).max(v.im.abs())
        });
        positive(
            "largest component",
            || format!("complex mode {mode} (from zero)"),
            largest,
        )?;
        // Squares of very large or small components leave the range of numbers. A power of two is exact.
        let unit = largest.log2().floor().exp2();
        let (x, y) = (shape.map(|v| v.re / unit), shape.map(|v| v.im / unit));
        let (difference, twice_product) = (x.norm_squared() - y.norm_squared(), 2.0 * x.dot(&y));
        let spread = difference.hypot(twice_product) / (x.norm_squared() + y.norm_squared());
        collinearity.push(spread.powi(2).min(1.0));
        let (sine, cosine) = (0.5 * twice_product.atan2(difference)).sin_cos();
        real.set_column(mode, &((x * cosine + y * sine) * unit));
    }
    apply_sign_rule(&mut real);
    Ok((finite("real mode shapes", real)?, collinearity))
}
