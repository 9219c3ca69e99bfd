//! The method's one error type: every message names the offender, its value and what it must be.

use thiserror::Error;

/// Everything that can go wrong between a structure's description and its correlated model.
///
/// The message above a variant is the documentation of its fields. Modes, degrees of freedom, rows and columns count from zero.
#[derive(Debug, Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "a variant's message says what its fields are")]
pub enum Error {
    /// A number that must be finite is NaN or infinite; the first such entry, column by column.
    #[error("{what}: {value} at entry ({row}, {column}) is not a finite number")]
    NotFinite {
        what: &'static str,
        row: usize,
        column: usize,
        value: f64,
    },
    /// A matrix or list has the wrong size.
    #[error("{what}: {rows} x {columns} instead of {expected_rows} x {expected_columns}")]
    WrongShape {
        what: &'static str,
        expected_rows: usize,
        expected_columns: usize,
        rows: usize,
        columns: usize,
    },
    /// A matrix that must be symmetric is not; the worst pair, with its difference over the size of such entries.
    #[error(
        "{what}: entry ({row}, {column}) is off its mirror by {difference:.1e} of its size; the matrix must be symmetric"
    )]
    NotSymmetric {
        what: &'static str,
        row: usize,
        column: usize,
        difference: f64,
    },
    /// A quantity that must be positive (gage, area, mass, modulus) is not.
    #[error("{what} of {owner} is {value}; it must be positive and finite")]
    NotPositive {
        what: &'static str,
        owner: String,
        value: f64,
    },
    /// A setting or a constant outside its range.
    #[error("{name} is {found}; it must be {expected}")]
    Setting {
        name: &'static str,
        expected: &'static str,
        found: f64,
    },
    /// Limits that are not positive and finite, or the lower one not below the upper one.
    #[error(
        "{what}: {lower} to {upper} is no range; the lower limit must be positive, the upper one larger and finite"
    )]
    Limits {
        what: String,
        lower: f64,
        upper: f64,
    },
    /// Limits on a parameter's factor that exclude where it starts, which is one.
    #[error("{what}: bounds {lower} to {upper} exclude the starting factor 1")]
    StartOutside {
        what: String,
        lower: f64,
        upper: f64,
    },
    /// No modes, elements or parameters where at least one is needed.
    #[error("{what}: at least one is needed")]
    Empty { what: &'static str },
    /// More modes asked for than there are.
    #[error("{what}: {requested} asked for, but there are only {available}")]
    TooMany {
        what: &'static str,
        available: usize,
        requested: usize,
    },
    /// Two grids or two elements carry the same number.
    #[error("{what} {label} is defined twice")]
    Duplicate { what: &'static str, label: usize },
    /// A reference to a grid, element or dynamic degree of freedom that does not exist.
    #[error("{owner}: there is no {what} {label}")]
    Unknown {
        owner: String,
        what: &'static str,
        label: usize,
    },
    /// An element stands in two parameters.
    #[error("element {element} is in two parameters, {first} and {second}; it may be in one")]
    SharedElement {
        element: usize,
        first: String,
        second: String,
    },
    /// A point mass to be scaled is coupled to another degree of freedom.
    #[error(
        "dynamic mass: degree of freedom {0} (from zero) is coupled to others; a point mass must stand alone"
    )]
    CoupledMass(usize),
    /// An error inside one element.
    #[error("element {element}: {source}")]
    InElement { element: usize, source: Box<Error> },
    /// An element has the wrong number of grid points for its kind.
    #[error("{found} grid points instead of {expected}")]
    WrongCornerCount { expected: usize, found: usize },
    /// A rod whose ends coincide: the distance between them, in.
    #[error("the rod has no length ({0:.3e} between its ends)")]
    ZeroLength(f64),
    /// A triangle or panel without area: its area over the square of its longest side or diagonal.
    #[error("the panel has no area ({0:.3e} of the square of its longest diagonal or side)")]
    ZeroArea(f64),
    /// A quadrilateral with an angle of 180 degrees or more at a corner, 1 to 4 in the order given.
    #[error("the panel is not convex: its interior angle at corner {0} is 180 degrees or more")]
    NotConvex(usize),
    /// Nothing constrains some motion: the grid that moves most in it, its direction (`x`, `y` or `z`), and the smallest
    /// eigenvalue of the stiffness scaled to unit diagonal.
    #[error("nothing holds grid {grid} along {direction} (stiffness ratio {ratio:.1e})")]
    SingularStiffness {
        grid: usize,
        direction: char,
        ratio: f64,
    },
    /// A matrix that must be positive definite is not; the row where the factorization stopped.
    #[error("{what} is not positive definite: the pivot of row {dof} (from zero) is not positive")]
    NotPositiveDefinite { what: &'static str, dof: usize },
    /// A dynamic degree of freedom, rigid-body vector or test mode that is a combination of those before it.
    #[error("{what} {index} (from zero) is a combination of those before it")]
    Dependent { what: &'static str, index: usize },
    /// Modes that must be orthonormal with the mass, or biorthogonal with the stiffness, and are not.
    #[error(
        "{what} {first} and {second} (from zero) have the product {found} instead of {expected}"
    )]
    NotOrthonormal {
        what: &'static str,
        first: usize,
        second: usize,
        expected: f64,
        found: f64,
    },
    /// A model has a mode that is not a vibration; the value is its squared circular frequency.
    #[error("mode {mode} (from zero) is no vibration: its eigenvalue is {value:.6e} rad^2/s^2")]
    NotAVibration { mode: usize, value: f64 },
    /// Two modes come together under a change, so that a denominator of the perturbation vanishes: that of row `first` for mode
    /// `second`, over the generalized stiffness.
    #[error(
        "modes {first} and {second} (from zero) come too close to tell apart ({separation:.1e})"
    )]
    CoalescingModes {
        first: usize,
        second: usize,
        separation: f64,
    },
    /// A change so large that a perturbed root, s², loses its sign.
    #[error(
        "the change takes the root of mode {mode} (from zero) to {value:.3e}; it must stay positive"
    )]
    LostRoot { mode: usize, value: f64 },
    /// A change that takes away a mode's generalized stiffness, so that its root has no finite value.
    #[error("the change leaves mode {mode} (from zero) {ratio:.1e} of its generalized stiffness")]
    LostStiffness { mode: usize, ratio: f64 },
    /// A pencil without a complete set of modes: the cosine of a mode's left and right shapes in the measure of the stiffness.
    #[error("left and right shapes of mode {mode} (from zero) are orthogonal to {cosine:.1e}")]
    Defective { mode: usize, cosine: f64 },
    /// A recursion that in the most orders allowed had not reached the largest relative change of a root allowed.
    #[error(
        "the roots still change by {last_change:.1e} after {orders} orders; they must settle to {largest:.0e}"
    )]
    UnsettledRoots {
        largest: f64,
        orders: usize,
        last_change: f64,
    },
    /// A factorization that does not solve its own matrix to what round-off explains.
    #[error("{what}: the solution leaves {residual:.1e} of its loads, more than {allowed:.1e}")]
    WrongSolution {
        what: &'static str,
        residual: f64,
        allowed: f64,
    },
    /// Modes found that are not as many as an independent count says there are.
    #[error(
        "{found} modes were found below {bound:.6e} rad^2/s^2, but the shifted pencil's inertia counts {counted}"
    )]
    Miscounted {
        bound: f64,
        counted: usize,
        found: usize,
    },
    /// An iterative library routine did not converge.
    #[error("{0}: the library's routine did not converge")]
    NoConvergence(&'static str),
    /// A structure on supports, where the reactions balance the forces of a mode: the largest squared suspension frequency over
    /// the mode's, and the largest ratio allowed.
    #[error(
        "test mode {mode} (from zero): the rigid-body stiffness is {ratio:.3e} of the mode's inertia; on a free or softly \
         suspended structure it is at most {limit}, and supports balance the forces of any other"
    )]
    Supported { mode: usize, ratio: f64, limit: f64 },
}

impl Error {
    /// Wraps an error with the number of the element it belongs to.
    pub(crate) fn in_element(self, element: usize) -> Self {
        Self::InElement {
            element,
            source: Box::new(self),
        }
    }

    /// Whether modes come so close under a change that the perturbation cannot follow them.
    pub(crate) fn is_of_close_modes(&self) -> bool {
        matches!(
            self,
            Self::CoalescingModes { .. } | Self::UnsettledRoots { .. }
        )
    }

    /// Says of a bad pivot which of the vectors behind the matrix depends on those before it.
    pub(crate) fn or_dependent(self, what: &'static str) -> Self {
        match self {
            Self::NotPositiveDefinite { dof, .. } => Self::Dependent { what, index: dof },
            other => other,
        }
    }
}

/// Accepts a setting that is what it must be.
pub(crate) fn setting(
    name: &'static str,
    expected: &'static str,
    found: f64,
    is_met: bool,
) -> Result<(), Error> {
    if is_met {
        Ok(())
    } else {
        Err(Error::Setting {
            name,
            expected,
            found,
        })
    }
}

/// Accepts a setting that is a positive finite number.
pub(crate) fn positive_setting(name: &'static str, found: f64) -> Result<(), Error> {
    setting(
        name,
        "a positive finite number",
        found,
        found > 0.0 && found.is_finite(),
    )
}

/// Errors if `count` is zero.
pub(crate) fn at_least_one(what: &'static str, count: usize) -> Result<(), Error> {
    if count > 0 {
        Ok(())
    } else {
        Err(Error::Empty { what })
    }
}
