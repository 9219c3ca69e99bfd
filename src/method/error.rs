//! The method's one error type: every message says what was expected and what was found, and names the offender.

use thiserror::Error;

/// Everything that can go wrong between a structure's description and its correlated model.
///
/// Indices of modes, degrees of freedom, rows and columns count from zero.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A number that must be finite is NaN or infinite.
    #[error("{what}: expected finite numbers, found {value} at entry ({row}, {column})")]
    NotFinite {
        /// The quantity.
        what: &'static str,
        /// Row of the first offending entry.
        row: usize,
        /// Its column.
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
    #[error("{what}: expected symmetry, found ({row}, {column}) off its mirror by {difference:.1e} of the largest")]
    NotSymmetric {
        /// The matrix.
        what: &'static str,
        /// Row of the worst pair.
        row: usize,
        /// Its column.
        column: usize,
        /// Difference of the pair over the largest magnitude in the matrix.
        difference: f64,
    },
    /// A quantity that must be positive (gage, area, mass, modulus) is not.
    #[error("{what} of {owner}: expected a positive finite number, found {value}")]
    NotPositive {
        /// The quantity.
        what: &'static str,
        /// What it belongs to, for example `element 8`.
        owner: String,
        /// The value found.
        value: f64,
    },
    /// A setting or a constant outside its range.
    #[error("{name}: expected {expected}, found {found}")]
    Setting {
        /// The setting or constant.
        name: &'static str,
        /// What it may be.
        expected: &'static str,
        /// What it was.
        found: f64,
    },
    /// Limits that are not positive and finite, or the lower one not below the upper one.
    #[error("{what}: expected a positive lower limit below a finite upper one, found {lower} and {upper}")]
    Limits {
        /// The limits.
        what: String,
        /// Lower limit.
        lower: f64,
        /// Upper limit.
        upper: f64,
    },
    /// Limits on a parameter's factor that exclude where it starts, which is one.
    #[error("{what}: expected limits that hold its start, 1, found {lower} to {upper}")]
    StartOutside {
        /// The limits.
        what: String,
        /// Lower limit.
        lower: f64,
        /// Upper limit.
        upper: f64,
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
    /// Two grids or two elements carry the same number.
    #[error("{what} {label}: expected each {what} once, found it defined again")]
    Duplicate {
        /// `grid` or `element`.
        what: &'static str,
        /// The repeated number.
        label: usize,
    },
    /// A reference to a grid, element or dynamic degree of freedom that does not exist.
    #[error("{owner}: expected an existing {what}, found {what} {label}, which is not defined")]
    Unknown {
        /// What refers to it, for example `element 8`.
        owner: String,
        /// What does not exist.
        what: &'static str,
        /// Its number.
        label: usize,
    },
    /// An element stands in two parameters.
    #[error("element {element}: expected in one parameter at most, found in {first} and in {second}")]
    SharedElement {
        /// The element.
        element: usize,
        /// The first parameter that has it.
        first: String,
        /// The second.
        second: String,
    },
    /// A point mass to be scaled is coupled to another degree of freedom.
    #[error("dynamic mass: expected a point mass at degree of freedom {0} (from zero), found it coupled to others")]
    CoupledMass(usize),
    /// An error inside one element.
    #[error("element {element}: {source}")]
    InElement {
        /// The element's number.
        element: usize,
        /// What is wrong with it.
        source: Box<Error>,
    },
    /// An element has the wrong number of grid points for its kind.
    #[error("expected {expected} grid points, found {found}")]
    WrongCornerCount {
        /// How many its kind needs.
        expected: usize,
        /// How many were given.
        found: usize,
    },
    /// A rod whose ends coincide: the distance between them, in.
    #[error("expected a rod with length, found length {0:.3e} between its ends")]
    ZeroLength(f64),
    /// A triangle or panel without area: its area over the square of its longest side or diagonal.
    #[error("expected a panel with area, found {0:.3e} of the square of its longest diagonal or side")]
    ZeroArea(f64),
    /// A quadrilateral with an angle of 180 degrees or more at a corner, 1 to 4 in the order given.
    #[error("expected a convex panel, found an interior angle of 180 degrees or more at its corner {0}")]
    NotConvex(usize),
    /// Nothing constrains some motion of the structure.
    #[error("stiffness: expected no free motion, found grid {grid} free along {direction} (ratio {ratio:.1e})")]
    SingularStiffness {
        /// The grid that moves most in the free motion.
        grid: usize,
        /// Its direction: `x`, `y` or `z`.
        direction: char,
        /// Smallest eigenvalue of the stiffness scaled to unit diagonal.
        ratio: f64,
    },
    /// A matrix that must be positive definite is not.
    #[error("{what}: expected a positive definite matrix, found a pivot not positive at row {dof} (from zero)")]
    NotPositiveDefinite {
        /// The matrix.
        what: &'static str,
        /// The row where the factorization stopped.
        dof: usize,
    },
    /// A dynamic degree of freedom, rigid-body vector or test mode that is a combination of those before it.
    #[error("{what} {index} (from zero): expected it independent of those before it, found a combination of them")]
    Dependent {
        /// What depends.
        what: &'static str,
        /// The first dependent one.
        index: usize,
    },
    /// Modes that must be orthonormal with the mass, or biorthogonal with the stiffness, and are not.
    #[error("{what} {first} and {second} (from zero): expected {expected}, found {found}")]
    NotOrthonormal {
        /// The measure and the modes.
        what: &'static str,
        /// The one mode, or the left one.
        first: usize,
        /// The other or the same, or the right one.
        second: usize,
        /// The product they must have.
        expected: f64,
        /// The product found.
        found: f64,
    },
    /// A model has a mode that is not a vibration.
    #[error("mode {mode} (from zero): expected a positive eigenvalue, found {value:.6e} rad^2/s^2")]
    NotAVibration {
        /// The mode, in ascending order.
        mode: usize,
        /// Its squared circular frequency.
        value: f64,
    },
    /// Two modes come together under a change, so that a denominator of the perturbation vanishes.
    #[error("modes {first} and {second} (from zero): expected separate roots, found them {separation:.1e} apart")]
    CoalescingModes {
        /// The row of the vanishing denominator.
        first: usize,
        /// The mode being perturbed.
        second: usize,
        /// The denominator over the generalized stiffness.
        separation: f64,
    },
    /// A change so large that a perturbed root loses its sign.
    #[error("mode {mode} (from zero): expected a positive perturbed root, found {value:.3e}")]
    LostRoot {
        /// The mode.
        mode: usize,
        /// The root found, s².
        value: f64,
    },
    /// A change that takes away a mode's generalized stiffness, so that its root has no finite value.
    #[error("mode {mode} (from zero): expected generalized stiffness after the change, found {ratio:.1e} of it left")]
    LostStiffness {
        /// The mode.
        mode: usize,
        /// Magnitude of the generalized stiffness after the change over the one before.
        ratio: f64,
    },
    /// A pencil without a complete set of modes.
    #[error("mode {mode} (from zero): expected independent modes, found left and right orthogonal to {cosine:.1e}")]
    Defective {
        /// The mode.
        mode: usize,
        /// Cosine of the angle between its left and right shapes in the measure of the stiffness.
        cosine: f64,
    },
    /// A recursion that had not reached its tolerance at the most orders allowed.
    #[error("perturbation: expected roots to settle to {largest:.0e} in {orders} orders, found {last_change:.1e}")]
    UnsettledRoots {
        /// Largest relative change allowed.
        largest: f64,
        /// Most orders.
        orders: usize,
        /// Largest relative change of a root in the last of them.
        last_change: f64,
    },
    /// A factorization that does not solve its own matrix.
    #[error("{what}: expected a solution to {allowed:.1e} of its loads, found a residual of {residual:.1e}")]
    WrongSolution {
        /// The matrix.
        what: &'static str,
        /// Residual of a probe over the norm of its loads.
        residual: f64,
        /// The largest that round-off explains.
        allowed: f64,
    },
    /// Modes found that are not as many as an independent count says there are.
    #[error(
        "modes below {bound:.6e} rad^2/s^2: expected {counted} by the inertia of the shifted pencil, found {found}"
    )]
    Miscounted {
        /// The bound on the squared circular frequency.
        bound: f64,
        /// How many there are.
        counted: usize,
        /// How many were found.
        found: usize,
    },
    /// An iterative library routine did not converge.
    #[error("{0}: expected the library's routine to converge, found that it did not")]
    NoConvergence(&'static str),
    /// A structure on supports, where the reactions balance the forces of a mode.
    #[error(
        "test mode {mode} (from zero): expected a free or softly suspended structure, rigid-body stiffness at most \
         {limit} of the mode's inertia, found {ratio:.3e}; supports balance the forces there"
    )]
    Supported {
        /// The first mode with too large a ratio.
        mode: usize,
        /// Largest squared suspension frequency over the mode's.
        ratio: f64,
        /// The largest ratio allowed.
        limit: f64,
    },
}

impl Error {
    /// Wraps an error with the number of the element it belongs to.
    pub(crate) fn in_element(self, element: usize) -> Self {
        Self::InElement { element, source: Box::new(self) }
    }

    /// Whether modes come so close under a change that the perturbation cannot follow them.
    pub(crate) fn is_of_close_modes(&self) -> bool {
        matches!(self, Self::CoalescingModes { .. } | Self::UnsettledRoots { .. })
    }

    /// Says of a bad pivot which of the vectors behind the matrix depends on those before it.
    pub(crate) fn or_dependent(self, what: &'static str) -> Self {
        match self {
            Self::NotPositiveDefinite { dof, .. } => Self::Dependent { what, index: dof },
            other => other,
        }
    }
}

/// Accepts a setting that is a positive finite number.
pub(crate) fn positive_setting(name: &'static str, found: f64) -> Result<(), Error> {
    let expected = "a positive finite number";
    if found > 0.0 && found.is_finite() { Ok(()) } else { Err(Error::Setting { name, expected, found }) }
}
