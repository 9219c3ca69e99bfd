//! Appendix B: measured modes made fit for correlation.
//! Tour: [chapter 10](crate::tour::chapter_10_noise).
//!
//! Measured modes violate equilibrium and orthogonality by the errors of the test. Three steps, in order:
//!
//! 1. [`balance`] adds to every shape the rigid-body motion that brings its forces and moments to zero (B.1 to B.4);
//!    [`rigid_body_vectors`] writes those motions for given measuring points.
//! 2. [`orthogonalize`] solves for the combinations of the shapes that are orthogonal in mass (B.5 to B.7).
//! 3. [`examine`] does both, reports how far each mode moved, and leaves out the modes that moved past the limits.
//!
//! Only free and softly suspended structures are balanced: where supports hold the structure, their reactions balance
//! the forces, which are then not zero at the dynamic DOF.

use super::{
    error::{Result, at_least_one, positive, require},
    linear_algebra::{
        Matrix, check_finite, check_matrix, check_shape, check_symmetric, cholesky, congruence,
        pencil_eigen, symmetric_part,
    },
    modes::{Modes, generalized_mass, mode, solve},
    sorting::pair_modes,
    structure::Point,
};
use nalgebra::Unit;

/// Rigid-body stiffness, relative to $\omega^2$ times the rigid-body mass, above which a structure counts as supported:
/// soft suspensions have modes below a fifth of every test frequency, supported structures a ratio of one or more.
pub const LARGEST_SUSPENSION_RATIO: f64 = 0.04;

/// Fraction of the generalized mass of a rigid-body vector or a shape, independent of those before it, below which it counts as
/// dependent: the squared sine of the angle between it and their span. Round-off leaves about 1e-15; a reference axis a thousand
/// lengths away leaves 1e-7.
const SMALLEST_INDEPENDENT_PART: f64 = 1e-12;

/// Test shapes whose forces and moments balance.
#[derive(Debug)]
pub struct Balanced {
    /// Balanced shapes $v_i + \Phi r_i$ (d × n), at the scale of the raw ones.
    pub shapes: Matrix,
    /// Coefficients $r$ of the rigid-body vectors (m × n); a rotation has a translation's unit per inch.
    pub coefficients: Matrix,
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
/// (`paper/print_and_box.md`); `rigid_body` $= \Phi$ (d × m), see [`rigid_body_vectors`].
///
/// # Errors
/// Data that does not fit or is not finite, rigid-body vectors that depend on each other, and $\lvert\mu_k\rvert$ above
/// [`LARGEST_SUSPENSION_RATIO`] of a mode's $\omega_i^2$: the structure is held, or the mode is itself a rigid-body mode on the suspension.
///
/// # Example
///
/// ```rust
/// use corfem::method::appendix_b::balance;
/// use corfem::method::modes::Modes;
/// use nalgebra::{DMatrix, dmatrix, dvector};
///
/// // Two free unit masses on a spring move against each other; measured with 0.05 of both together.
/// let raw = Modes::new(dvector![2.0], dmatrix![1.0; -0.9])?;
/// let stiffness = dmatrix![1.0, -1.0; -1.0, 1.0];
/// let balanced = balance(&raw, &stiffness, &DMatrix::identity(2, 2), &dmatrix![1.0; 1.0])?;
/// assert!((balanced.shapes - dmatrix![0.95; -0.95]).amax() < 1e-14);
/// assert!((balanced.coefficients[0] + 0.05).abs() < 1e-14);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn balance(
    raw: &Modes,
    stiffness: &Matrix,
    mass: &Matrix,
    rigid_body: &Matrix,
) -> Result<Balanced> {
    let (dof_count, motion_count) = (mass.nrows(), rigid_body.ncols());
    cholesky("dynamic mass", mass, 0.0)?;
    let size = generalized_mass(&raw.shapes, mass)?.diagonal();
    check_shape("dynamic stiffness", stiffness, dof_count, dof_count)?;
    check_symmetric("dynamic stiffness", stiffness)?;
    check_matrix("rigid-body vectors", rigid_body, dof_count, motion_count)?;
    let of_motions = congruence(mass, rigid_body);
    let lower = cholesky("rigid-body mass", &of_motions, SMALLEST_INDEPENDENT_PART)?;
    // μ, zero on a free structure, and L⁻ᵗ Y (m × m).
    let (mu, from_suspension) = pencil_eigen(
        "rigid-body stiffness",
        &congruence(stiffness, rigid_body),
        &lower,
        motion_count,
    )?;
    let omega_squared = &raw.omega_squared;
    for (place, square) in omega_squared.iter().enumerate() {
        let ratio = mu.amax() / square;
        require(
            ratio <= LARGEST_SUSPENSION_RATIO,
            "rigid-body stiffness over inertia",
            || mode(place),
            ratio,
            "at most 0.04, as on a free or softly suspended structure: supports balance the forces of any other",
        )?;
    }
    let motions = rigid_body * &from_suspension;
    let inertia = motions.tr_mul(&(mass * &raw.shapes));
    let elastic = motions.tr_mul(&(stiffness * &raw.shapes));
    let amplitudes = Matrix::from_fn(motion_count, raw.len(), |k, i| {
        (elastic[(k, i)] - omega_squared[i] * inertia[(k, i)]) / (omega_squared[i] - mu[k])
    });
    let shapes = &raw.shapes + motions * &amplitudes;
    check_finite("balanced test mode shapes", &shapes)?;
    Ok(Balanced {
        change: (0..raw.len())
            .map(|i| amplitudes.column(i).norm() / size[i].sqrt())
            .collect(),
        coefficients: from_suspension * &amplitudes,
        shapes,
    })
}

/// A dynamic degree of freedom: a measuring point and the direction measured there.
#[derive(Debug, Clone, Copy)]
pub struct MeasuringPoint {
    /// Position, in: x aft, y outboard, z up, from the reference axes.
    pub position: Point,
    /// Direction of motion.
    pub direction: Unit<Point>,
}

/// Rigid-body vectors $\Phi$ (points × 6) of the motions along x, y and z (fore and aft, to the side, plunge) and about them (roll, pitch,
/// yaw): what a motion of 1 in, or of one radian in the linear theory, shows at a point $x$ in the direction $n$ measured there.
///
/// That is the component of $n$ for a translation, and $n \cdot (e \times x) = e \cdot (x \times n)$ for a rotation about an axis $e$.
/// Roll turns y towards z, yaw x towards y, and pitch x towards z, which lifts the tail. Translations have no unit, rotations are in
/// inches per radian.
pub fn rigid_body_vectors(points: &[MeasuringPoint]) -> Matrix {
    Matrix::from_fn(points.len(), 6, |i, motion| {
        let MeasuringPoint {
            position,
            direction: n,
        } = points[i];
        let turn = position.cross(&n);
        [n.x, n.y, n.z, turn.x, -turn.y, turn.z][motion]
    })
}

/// Columns of the symmetric boundary condition, plunge and pitch: with z alone measured, $\lbrace 1 \rbrace$ and $\lbrace x \rbrace$ of
/// (B.1) and (B.2). Where x is measured, add the first, which is symmetric too.
pub const SYMMETRIC: [usize; 2] = [2, 4];

/// Columns of the antisymmetric boundary condition, to the side, roll and yaw. Where z alone is measured only roll is seen, and the
/// other two must be left out.
pub const ANTISYMMETRIC: [usize; 3] = [1, 3, 5];

/// Overlap of unit shapes that is the round-off of a product over some hundreds of DOF and counts as none: it would
/// turn two modes of one frequency by any angle.
const OVERLAP_ROUND_OFF: f64 = 1e-12;

/// Movement of a mode by orthogonalization.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Movement {
    /// Change of frequency relative to the raw one, $(f - f_G)/f_G$.
    pub frequency: f64,
    /// Mass norm of the change of shape, $\sqrt{(w - v)^t M (w - v)}$ with both scaled to unit generalized mass and
    /// signed alike: $2\sin(\theta/2)$ for an angle $\theta$ between them, about the fraction of other modes mixed in.
    pub shape: f64,
}

/// Orthogonal test modes and how far each one moved.
#[derive(Debug)]
pub struct Orthogonalized {
    /// The modes, $V^t M V = I$, in the order and with the signs of the raw ones.
    pub modes: Modes,
    /// Overlaps of the raw shapes: $m_1$ (B.6) with every shape scaled to unit generalized mass (n × n).
    pub overlap: Matrix,
    /// Each mode's movement.
    pub movement: Vec<Movement>,
}

/// Combinations of the test shapes that are orthogonal in mass, and their frequencies (B.7).
///
/// In the raw shapes, scaled to unit generalized mass, the equations of motion are the symmetric-definite eigenproblem
///
/// $$ \mathrm{diag}(\omega_{Gi}^2  m_{1,ii})  q = \omega^2  m_1  q, \qquad q^t m_1 q = 1. $$
///
/// with the test frequencies $\omega_{Gi}$. Each new shape $V q$ takes the place and sign of the raw one it is paired
/// with. An overlap $e$ of two modes moves shapes by the order of $e$ and frequencies, mostly the higher, by that of
/// $e^2$; the sum of $1/\omega^2$ never changes. `mass` in lbf·s²/in (d × d).
///
/// # Errors
/// Data that does not fit or is not finite, a mass that is not positive definite, and a shape that is a combination of those before it.
///
/// # Example
///
/// ```rust
/// use corfem::method::appendix_b::orthogonalize;
/// use corfem::method::modes::{Modes, generalized_mass};
/// use nalgebra::{DMatrix, dmatrix, dvector};
///
/// // The second shape has a tenth of the first in it.
/// let raw = Modes::new(dvector![1.0, 4.0], dmatrix![1.0, 0.1; 0.0, 1.0])?;
/// let mass = DMatrix::identity(2, 2);
/// let modes = orthogonalize(&raw, &mass)?.modes;
/// assert!((generalized_mass(modes.shapes(), &mass)? - &mass).amax() < 1e-14);
/// // The sum of 1/ω² is that of the raw modes, 1 + 1/4.
/// assert!((modes.omega_squared().map(f64::recip).sum() - 1.25).abs() < 1e-14);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn orthogonalize(raw: &Modes, mass: &Matrix) -> Result<Orthogonalized> {
    cholesky("dynamic mass", mass, 0.0)?;
    let unit = raw.scaled_with(mass)?.shapes;
    let overlap = symmetric_part(&generalized_mass(&unit, mass)?)
        .map(|m| if m.abs() < OVERLAP_ROUND_OFF { 0.0 } else { m });
    cholesky(
        "overlap of the test shapes",
        &overlap,
        SMALLEST_INDEPENDENT_PART,
    )?;
    let combined = solve(
        &Matrix::from_diagonal(&raw.omega_squared),
        &overlap,
        raw.len(),
    )?;
    let combined = pair_modes(&combined.shapes.tr_mul(&overlap))?.paired(&combined)?;
    let modes = Modes {
        shapes: &unit * combined.shapes,
        omega_squared: combined.omega_squared,
    };
    let difference = generalized_mass(&(&modes.shapes - unit), mass)?.diagonal();
    let moved = |mode: usize| Movement {
        frequency: (modes.omega_squared[mode] / raw.omega_squared[mode]).sqrt() - 1.0,
        shape: difference[mode].sqrt(),
    };
    Ok(Orthogonalized {
        movement: (0..raw.len()).map(moved).collect(),
        modes,
        overlap,
    })
}

/// Movements beyond which a mode is deleted, in fractions chosen by engineering judgment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovementLimits {
    /// Change of shape by balancing, [`Balanced::change`], which is never more than 1.
    pub balance: f64,
    /// Change of frequency by orthogonalization, up or down, [`Movement::frequency`].
    pub frequency: f64,
    /// Change of shape by orthogonalization, [`Movement::shape`].
    pub shape: f64,
}

impl Default for MovementLimits {
    /// 10 % of shape for each step, the customary bound on the off-diagonal generalized masses of test modes, and 2 %
    /// of frequency, several times what a resonance is measured to.
    fn default() -> Self {
        Self {
            balance: 0.10,
            frequency: 0.02,
            shape: 0.10,
        }
    }
}

/// Supports of the tested structure.
#[derive(Debug, Clone, Copy)]
pub enum Supports<'a> {
    /// By supports, whose reactions balance the forces: the modes are not balanced.
    Held,
    /// Not at all, or by a soft suspension: the modes are balanced first.
    Free {
        /// Dynamic stiffness with the suspension's springs, lbf/in (d × d).
        stiffness: &'a Matrix,
        /// Rigid-body vectors (d × m), see [`rigid_body_vectors`].
        rigid_body: &'a Matrix,
    },
}

/// Test modes fit for correlation, and how far all of them moved.
#[derive(Debug)]
pub struct Examination {
    /// The modes kept, balanced and orthonormal, in the order of the raw ones.
    pub modes: Modes,
    /// Places of these among the raw modes, from zero.
    pub kept: Vec<usize>,
    /// Relative change of every raw mode's shape by balancing; zero when the structure was held.
    pub change: Vec<f64>,
    /// Movement of every raw mode by orthogonalization among those not yet deleted; none when balancing deleted it.
    pub movement: Vec<Option<Movement>>,
}

/// Balances the test modes, orthogonalizes them, and deletes those that do not fit.
///
/// A mode that balancing changes by more than its limit is deleted at once. Orthogonalization moves good modes with a
/// wrong one that overlaps them, and may move them farther. So while any mode moves past a limit, the one is deleted (ours)
/// that overlaps most with all others together, $\max_i \sum_{j \ne i} m_{1,ij}^2$ (on a tie the one that moved
/// farthest, the higher of two), and the rest are orthogonalized anew from their balanced shapes. This finds a single
/// wrong mode anywhere in the spectrum; several that are mixed with each other are not always told from good ones.
///
/// # Errors
/// A limit that is not positive, no mode left within the limits, and what [`balance`] and [`orthogonalize`] refuse.
///
/// # Example
///
/// ```rust
/// use corfem::method::appendix_b::{MovementLimits, Supports, examine};
/// use corfem::method::modes::Modes;
/// use nalgebra::{DMatrix, dmatrix, dvector};
///
/// // The third shape has a fifth of either of the others in it.
/// let shapes = dmatrix![1.0, 0.0, 0.2; 0.0, 1.0, 0.2; 0.0, 0.0, 1.0];
/// let raw = Modes::new(dvector![1.0, 4.0, 9.0], shapes)?;
/// let mass = DMatrix::identity(3, 3);
/// let examination = examine(&raw, &mass, Supports::Held, &MovementLimits::default())?;
/// assert_eq!(examination.kept, [0, 1]);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn examine(
    raw: &Modes,
    mass: &Matrix,
    supports: Supports,
    limits: &MovementLimits,
) -> Result<Examination> {
    let owner = || "the movement limits".into();
    positive("balance", owner, limits.balance)?;
    positive("frequency", owner, limits.frequency)?;
    positive("shape", owner, limits.shape)?;
    let (mut balanced, mut change) = (raw.clone(), vec![0.0; raw.len()]);
    if let Supports::Free {
        stiffness,
        rigid_body,
    } = supports
    {
        let found = balance(raw, stiffness, mass, rigid_body)?;
        balanced.shapes = found.shapes;
        change = found.change;
    }
    let is_kept = |&mode: &usize| change[mode] <= limits.balance;
    let mut kept: Vec<usize> = (0..raw.len()).filter(is_kept).collect();
    let mut moved = vec![None; raw.len()];
    loop {
        at_least_one("test modes within the limits", kept.len())?;
        let found = orthogonalize(&balanced.select(&kept), mass)?;
        for (&mode, &movement) in kept.iter().zip(&found.movement) {
            moved[mode] = Some(movement);
        }
        // The larger movement in units of its limit.
        let excess = |place: usize| {
            let Movement { frequency, shape } = found.movement[place];
            (frequency.abs() / limits.frequency).max(shape / limits.shape)
        };
        if (0..kept.len()).all(|place| excess(place) <= 1.0) {
            return Ok(Examination {
                modes: found.modes,
                kept,
                change,
                movement: moved,
            });
        }
        let m = &found.overlap;
        let overlaps = |i: usize| m.column(i).norm_squared() - m[(i, i)].powi(2);
        let rank = |&a: &usize, &b: &usize| {
            let most = overlaps(a).total_cmp(&overlaps(b));
            most.then(excess(a).total_cmp(&excess(b)))
        };
        kept.remove((0..kept.len()).max_by(rank).unwrap_or(0));
    }
}
