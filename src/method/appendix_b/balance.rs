//! Balance of forces and moments in each test mode (B.1 to B.4).

use super::checked_generalized_masses;
use crate::method::error::Error;
use crate::method::linear_algebra::{
    check_finite, check_shape, check_symmetric, cholesky, finite, reduced, solve_lower_transposed, symmetric_eigen,
    symmetric_part,
};
use crate::method::modes::ModeSet;
use nalgebra::{DMatrix, DVector};

/// Rigid-body stiffness, relative to $\omega^2$ times the rigid-body mass, above which a structure counts as supported:
/// soft suspensions have modes below a fifth of every test frequency, supported structures a ratio of one or more.
pub const LARGEST_SUSPENSION_RATIO: f64 = 0.04;

/// Fraction of a rigid-body vector's generalized mass, independent of the vectors before it, below which it counts as
/// dependent. Round-off leaves about 1e-15; a reference axis a thousand lengths away leaves 1e-7.
const SMALLEST_INDEPENDENT_PART: f64 = 1e-12;

/// Test shapes whose forces and moments balance.
#[derive(Debug, Clone, PartialEq)]
pub struct Balanced {
    /// Balanced shapes $v_i + \Phi r_i$ (d × n), at the scale of the raw ones.
    pub shapes: DMatrix<f64>,
    /// Coefficients $r$ of the rigid-body vectors (m × n); a rotation has a translation's unit per inch.
    pub coefficients: DMatrix<f64>,
    /// Each change relative to its shape in the mass norm, $\sqrt{(\Phi r_i)^t M \Phi r_i} /\sqrt{v_i^t M v_i}$.
    pub change: Vec<f64>,
}

/// Adds to every test shape the rigid-body motion that balances its forces and moments.
///
/// With $R_i = \omega_i^2 M - K$ and the rigid-body vectors in the columns of $\Phi$, the coefficients solve
///
/// $$ \Phi^t R_i  (v_i + \Phi r_i) = 0, $$
///
/// for the symmetric case, $\Phi = (\lbrace 1 \rbrace, \lbrace x \rbrace)$, (B.3) and (B.4). On a free structure $K\Phi = 0$, and the
/// balanced shape is the part of the raw one orthogonal in mass to every rigid-body motion. The equations are solved in
/// the suspension modes $\hat\Phi = \Phi L^{-t} Y$ ($L L^t = \Phi^t M \Phi$), mass-orthonormal and with diagonal $K$:
///
/// $$ \hat\Phi^t K \hat\Phi = \mathrm{diag}(\mu), \qquad
///    \hat r_{ki} = -\frac{\hat\phi_k^t R_i v_i}{\omega_i^2 - \mu_k}, \qquad r_i = L^{-t} Y \hat r_i. $$
///
/// `stiffness` in lbf/in and `mass` in lbf·s²/in (d × d), suspension springs included and aerodynamic forces left out
/// (`paper/interpretation.md`); `rigid_body` $= \Phi$ (d × m), see [`super::rigid_body_vectors`].
///
/// # Errors
/// [`Error::Empty`] without modes or vectors; [`Error::WrongShape`], [`Error::NotFinite`], [`Error::NotSymmetric`],
/// [`Error::NotPositive`], [`Error::NotPositiveDefinite`] for bad data; [`Error::Dependent`] when the balance
/// equations are singular; [`Error::Supported`] when some $\lvert\mu_k\rvert$ exceeds [`LARGEST_SUSPENSION_RATIO`] of a
/// mode's $\omega_i^2$: the structure is held, or the mode is itself a rigid-body mode on the suspension.
pub fn balance(
    raw: &ModeSet,
    stiffness: &DMatrix<f64>,
    mass: &DMatrix<f64>,
    rigid_body: &DMatrix<f64>,
) -> Result<Balanced, Error> {
    let generalized_masses = checked_generalized_masses(raw, mass)?;
    check_shape("dynamic stiffness", stiffness, mass.nrows(), mass.nrows())?;
    check_symmetric("dynamic stiffness", stiffness)?;
    let (suspension, from_suspension) = suspension_modes(stiffness, mass, rigid_body)?;
    let (stiffest, limit) = (suspension.amax(), LARGEST_SUSPENSION_RATIO);
    if let Some(mode) = raw.omega_squared.iter().position(|omega_squared| stiffest > limit * omega_squared) {
        return Err(Error::Supported { mode, ratio: stiffest / raw.omega_squared[mode], limit });
    }
    let motions = rigid_body * &from_suspension;
    let inertia = motions.tr_mul(&(mass * &raw.shapes));
    let elastic = motions.tr_mul(&(stiffness * &raw.shapes));
    let amplitudes = DMatrix::from_fn(suspension.len(), raw.len(), |k, i| {
        let omega_squared = raw.omega_squared[i];
        (elastic[(k, i)] - omega_squared * inertia[(k, i)]) / (omega_squared - suspension[k])
    });
    Ok(Balanced {
        shapes: finite("balanced test mode shapes", &raw.shapes + motions * &amplitudes)?,
        change: (0..raw.len()).map(|i| amplitudes.column(i).norm() / generalized_masses[i].sqrt()).collect(),
        coefficients: from_suspension * amplitudes,
    })
}

/// Squared circular frequencies $\mu$ (rad²/s², zero on a free structure) of the rigid-body modes on the suspension,
/// and these modes in terms of the rigid-body vectors, $L^{-t} Y$ (m × m).
fn suspension_modes(
    stiffness: &DMatrix<f64>,
    mass: &DMatrix<f64>,
    rigid_body: &DMatrix<f64>,
) -> Result<(DVector<f64>, DMatrix<f64>), Error> {
    let count = rigid_body.ncols();
    if count == 0 {
        return Err(Error::Empty { what: "rigid-body vectors" });
    }
    check_shape("rigid-body vectors", rigid_body, mass.nrows(), count)?;
    check_finite("rigid-body vectors", rigid_body)?;
    let rigid_mass = rigid_body.tr_mul(&(mass * rigid_body));
    let lower = cholesky("rigid-body mass", &rigid_mass, SMALLEST_INDEPENDENT_PART)
        .map_err(|error| error.or_dependent("rigid-body vector"))?;
    let reduced = symmetric_part(&reduced(&lower, &rigid_body.tr_mul(&(stiffness * rigid_body))));
    let (squared, mut modes) = symmetric_eigen("rigid-body stiffness", &reduced)?;
    solve_lower_transposed(&lower, &mut modes)?;
    Ok((squared, modes))
}
