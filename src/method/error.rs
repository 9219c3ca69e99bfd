//! The one error type: every message says what was expected and what was found, and names the offender.

use thiserror::Error;

/// Everything that can go wrong between a structure's description and its correlated model.
///
/// The library never panics on input and never prints: it returns one of these.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A number that must be finite is NaN or infinite.
    #[error("{what}: expected finite numbers, found {value} at entry ({row}, {column})")]
    NotFinite {
        /// The quantity.
        what: &'static str,
        /// Row of the first offending entry, from zero.
        row: usize,
        /// Column of the first offending entry, from zero.
        column: usize,
        /// The value found there.
        value: f64,
    },
    /// A matrix or list has the wrong size.
    #[error("{what}: expected {expected_rows} x {expected_columns}, found {rows} x {columns}")]
    WrongShape {
        /// The quantity.
        what: &'static str,
        /// Rows it must have.
        expected_rows: usize,
        /// Columns it must have.
        expected_columns: usize,
        /// Rows it has.
        rows: usize,
        /// Columns it has.
        columns: usize,
    },
    /// A matrix that must be symmetric is not.
    #[error(
        "{what}: expected a symmetric matrix, found entries ({row}, {column}) and ({column}, {row}) apart by {difference:.3e} of the largest entry"
    )]
    NotSymmetric {
        /// The matrix.
        what: &'static str,
        /// Row of the worst pair.
        row: usize,
        /// Column of the worst pair.
        column: usize,
        /// Their difference divided by the largest magnitude in the matrix.
        difference: f64,
    },
    /// A quantity that must be positive (gage, area, mass, modulus) is not.
    #[error("{what} of {owner}: expected a positive finite number, found {value}")]
    NotPositive {
        /// The quantity.
        what: &'static str,
        /// Who has it, for example `element 8`.
        owner: String,
        /// The value found.
        value: f64,
    },
    /// Poisson's ratio outside the range of a stable isotropic material.
    #[error("Poisson's ratio: expected more than -1 and at most 0.5, found {value}")]
    PoissonsRatio {
        /// The value found.
        value: f64,
    },
    /// Two grid points carry the same number.
    #[error("grid {grid}: expected each grid once, found it defined again")]
    DuplicateGrid {
        /// The repeated label.
        grid: usize,
    },
    /// Two elements carry the same number.
    #[error("element {element}: expected each element once, found it defined again")]
    DuplicateElement {
        /// The repeated label.
        element: usize,
    },
    /// An element refers to a grid point that does not exist.
    #[error(
        "element {element}: expected an existing grid, found grid {grid}, which is not defined"
    )]
    UnknownGrid {
        /// The element.
        element: usize,
        /// The missing grid.
        grid: usize,
    },
    /// A parameter refers to an element that does not exist.
    #[error(
        "parameter {parameter}: expected an existing element, found element {element}, which is not defined"
    )]
    UnknownElement {
        /// The parameter.
        parameter: String,
        /// The missing element.
        element: usize,
    },
    /// A parameter refers to a dynamic DOF that does not exist.
    #[error(
        "parameter {parameter}: expected a dynamic degree of freedom below {count}, found {found}"
    )]
    UnknownDynamicDof {
        /// The parameter.
        parameter: String,
        /// The missing DOF, from zero.
        found: usize,
        /// How many there are.
        count: usize,
    },
    /// A point mass to be scaled is coupled to another degree of freedom.
    #[error(
        "dynamic mass: expected a point mass at degree of freedom {dof} (from zero), found it coupled to others"
    )]
    CoupledMass {
        /// The DOF, from zero.
        dof: usize,
    },
    /// An element stands in two parameters.
    #[error(
        "element {element}: expected in one parameter at most, found in {first} and in {second}"
    )]
    SharedElement {
        /// The element.
        element: usize,
        /// The first parameter that has it.
        first: String,
        /// The second.
        second: String,
    },
    /// An element has the wrong number of grid points for its kind.
    #[error("expected {expected} grid points, found {found}")]
    WrongCornerCount {
        /// How many its kind needs.
        expected: usize,
        /// How many were given.
        found: usize,
    },
    /// A rod whose ends coincide.
    #[error("expected a rod with length, found length {length:.3e} between its ends")]
    ZeroLength {
        /// The distance found, in.
        length: f64,
    },
    /// A triangle or panel without area.
    #[error(
        "expected a panel with area, found {area:.3e} of the square of its longest diagonal or side"
    )]
    ZeroArea {
        /// Area over the square of the longest side or diagonal.
        area: f64,
    },
    /// A quadrilateral with a corner of 180 degrees or more.
    #[error(
        "expected a convex panel, found an interior angle of 180 degrees or more at its corner {corner}"
    )]
    NotConvex {
        /// The corner, 1 to 4 in the order given.
        corner: usize,
    },
    /// An error inside one element.
    #[error("element {element}: {source}")]
    InElement {
        /// The element's number.
        element: usize,
        /// What is wrong with it.
        source: Box<Error>,
    },
    /// Nothing constrains some motion of the structure.
    #[error(
        "stiffness: expected every motion constrained, found grid {grid} free to move along {direction} (stiffness ratio {ratio:.1e})"
    )]
    SingularStiffness {
        /// The grid that moves most in the motion that nothing constrains.
        grid: usize,
        /// Its direction: `x`, `y` or `z`.
        direction: char,
        /// Smallest over largest eigenvalue of the stiffness scaled to unit diagonal.
        ratio: f64,
    },
    /// The flexibility at the dynamic DOF cannot be inverted.
    #[error(
        "dynamic flexibility: expected independent dynamic degrees of freedom, found number {dof} (from zero) a combination of those before it"
    )]
    DependentDynamicDof {
        /// The first dependent dynamic DOF, from zero.
        dof: usize,
    },
    /// A mass matrix that is not positive definite.
    #[error(
        "{what}: expected a positive definite matrix, found a pivot that is not positive at degree of freedom {dof} (from zero)"
    )]
    NotPositiveDefinite {
        /// The matrix.
        what: &'static str,
        /// Where the factorization stopped, from zero.
        dof: usize,
    },
    /// A model has a mode that is not a vibration.
    #[error("mode {mode} (from zero): expected a positive eigenvalue, found {value:.6e} rad^2/s^2")]
    NotAVibration {
        /// The mode, from zero in ascending order.
        mode: usize,
        /// Its squared circular frequency.
        value: f64,
    },
    /// No modes, elements or parameters where at least one is needed.
    #[error("{what}: expected at least one, found none")]
    Empty {
        /// What there must be at least one of.
        what: &'static str,
    },
    /// More modes asked for than there are.
    #[error("{what}: expected at most {available}, found {requested}")]
    TooMany {
        /// What was asked for.
        what: &'static str,
        /// How many there are.
        available: usize,
        /// How many were asked for.
        requested: usize,
    },
    /// Test shapes that must be orthonormal with the mass and are not.
    #[error(
        "test modes {first} and {second} (from zero): expected a generalized mass of one for each and none between them, found {found:.9}"
    )]
    NotOrthonormal {
        /// The one mode.
        first: usize,
        /// The other, or the same.
        second: usize,
        /// The generalized mass between them.
        found: f64,
    },
    /// Two modes come together under a change, so that a denominator of the perturbation vanishes.
    #[error(
        "modes {first} and {second} (from zero): expected separate roots, found a denominator of {separation:.1e} of the generalized stiffness"
    )]
    CoalescingModes {
        /// The row of the vanishing denominator.
        first: usize,
        /// The mode being perturbed.
        second: usize,
        /// The denominator relative to the generalized stiffness.
        separation: f64,
    },
    /// A change so large that a perturbed root loses its sign.
    #[error("mode {mode} (from zero): expected a positive perturbed root, found {value:.3e}")]
    LostRoot {
        /// The mode.
        mode: usize,
        /// The root found, s^2.
        value: f64,
    },
    /// A change that takes away a mode's generalized stiffness, so that its root has no finite value.
    #[error(
        "mode {mode} (from zero): expected a generalized stiffness after the change, found {ratio:.1e} of the one before"
    )]
    LostStiffness {
        /// The mode.
        mode: usize,
        /// Magnitude of the generalized stiffness after the change relative to the one before.
        ratio: f64,
    },
    /// Left and right shapes that do not belong together.
    #[error(
        "left mode {left} and right mode {right} (from zero): expected no generalized stiffness between them, found {ratio:.1e} of their own"
    )]
    NotBiorthogonal {
        /// The left mode.
        left: usize,
        /// The right mode.
        right: usize,
        /// Their generalized stiffness relative to the geometric mean of their own ones.
        ratio: f64,
    },
    /// A pencil without a complete set of modes.
    #[error(
        "mode {mode} (from zero): expected as many independent modes as degrees of freedom, found its left and right shapes orthogonal to {cosine:.1e}"
    )]
    Defective {
        /// The mode.
        mode: usize,
        /// Cosine of the angle between its left and right shapes in the measure of the stiffness.
        cosine: f64,
    },
    /// A recursion that had not reached its tolerance at the most orders allowed.
    #[error(
        "perturbation: expected the roots to settle to {largest:.0e} within {orders} orders, found them still changing by {last_change:.1e}"
    )]
    UnsettledRoots {
        /// Largest relative change allowed.
        largest: f64,
        /// Most orders.
        orders: usize,
        /// Largest relative change of a root in the last of them.
        last_change: f64,
    },
    /// An iterative library routine did not converge.
    #[error("{what}: expected the eigenvalue iteration to converge, found that it did not")]
    NoConvergence {
        /// The decomposition.
        what: &'static str,
    },
    /// A lower limit above its upper limit, or limits that exclude the start.
    #[error("{what}: expected a lower limit below the upper one, found {lower} and {upper}")]
    Limits {
        /// The limits.
        what: String,
        /// Lower limit.
        lower: f64,
        /// Upper limit.
        upper: f64,
    },
    /// A setting outside its range.
    #[error("setting {name}: expected {expected}, found {found}")]
    Setting {
        /// The setting.
        name: &'static str,
        /// What it may be.
        expected: &'static str,
        /// What it was.
        found: f64,
    },
    /// A rigid-body vector that is a combination of those before it, so that the balance equations are singular.
    #[error(
        "rigid-body vector {vector} (from zero): expected a motion independent of those before it, found a combination of them at the dynamic degrees of freedom"
    )]
    DependentRigidBody {
        /// The first dependent vector, from zero.
        vector: usize,
    },
    /// A structure on supports, where the reactions balance the forces of a mode.
    #[error(
        "test mode {mode} (from zero): expected a free or softly suspended structure, rigid-body stiffness at most {limit} of the mode's inertia, found {ratio:.3e}; supports balance the forces there, so its modes must not be balanced"
    )]
    Supported {
        /// The first mode with too large a ratio, from zero.
        mode: usize,
        /// Largest squared suspension frequency over the mode's.
        ratio: f64,
        /// The largest ratio allowed.
        limit: f64,
    },
    /// A test shape that is a combination of others.
    #[error(
        "test mode {mode} (from zero): expected a shape independent of those before it, found a combination of them"
    )]
    DependentTestShape {
        /// The first dependent mode, from zero.
        mode: usize,
    },
}

impl Error {
    /// Wraps an error with the number of the element it belongs to.
    pub(crate) fn in_element(self, element: usize) -> Self {
        Self::InElement {
            element,
            source: Box::new(self),
        }
    }
}
