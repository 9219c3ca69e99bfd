//! Errors of the method: every message names the offender, its value and what it must be.

use thiserror::Error;

/// Result of a step of the method.
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// Reasons why a constructor refuses its input or the paper's steps cannot go on.
///
/// The message above a variant is the documentation of its fields. Modes, degrees of freedom, rows and columns count from zero.
#[derive(Debug, Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "a variant's message says what its fields are")]
pub enum Error {
    /// A number that is not what it must be.
    #[error("{what} of {owner} is {value}; it must be {expected}")]
    Value {
        what: &'static str,
        owner: String,
        value: f64,
        expected: &'static str,
    },
    /// A matrix or list of the wrong size.
    #[error("{what}: {rows} x {columns} instead of {expected_rows} x {expected_columns}")]
    WrongShape {
        what: &'static str,
        expected_rows: usize,
        expected_columns: usize,
        rows: usize,
        columns: usize,
    },
    /// Too few or too many of something.
    #[error("{what}: {found} given or asked for; there must be {}", match *most {
        usize::MAX => format!("at least {least}"),
        most => format!("{least} to {most}"),
    })]
    Count {
        what: &'static str,
        found: usize,
        least: usize,
        most: usize,
    },
    /// Bounds that are not positive and ascending, or that exclude where a factor starts, which is one.
    #[error(
        "{what}: {lower} to {upper} is no range; the lower limit must be positive, the upper one larger and finite, and the starting \
         factor 1 between them"
    )]
    Range {
        what: String,
        lower: f64,
        upper: f64,
    },
    /// A grid or an element that is given twice.
    #[error("{owner}: {what} {label} is given twice")]
    Duplicate {
        owner: String,
        what: &'static str,
        label: usize,
    },
    /// A reference to what does not exist.
    #[error("{owner}: there is no {what} {label}")]
    Unknown {
        owner: String,
        what: &'static str,
        label: usize,
    },
    /// A motion that nothing resists, of a grid along a direction, `x`, `y` or `z`.
    #[error("nothing holds grid {grid} along {direction}")]
    SingularStiffness { grid: usize, direction: char },
    /// A matrix that must be positive definite and is not; the row where the factorization stopped.
    #[error(
        "{what} is not positive definite: row {row} (from zero) is a combination of those before it, or not positive"
    )]
    NotPositiveDefinite { what: &'static str, row: usize },
    /// A mode that is not a vibration, as after a change that is too large; the value is $\omega^2$, rad²/s², or the root
    /// $1/\omega^2$, s².
    #[error(
        "mode {mode} (from zero) is no vibration: its eigenvalue is {value:.6e}; it must be positive and finite"
    )]
    NotAVibration { mode: usize, value: f64 },
    /// Two modes that a change brings together, so that a denominator of the perturbation vanishes: that of row `first` for mode
    /// `second`, over the generalized stiffness.
    #[error(
        "modes {first} and {second} (from zero) come too close to tell apart ({separation:.1e})"
    )]
    CoalescingModes {
        first: usize,
        second: usize,
        separation: f64,
    },
    /// A recursion that has not settled in the most orders allowed, or whose residuals do not prove its roots.
    #[error(
        "the roots still change by {last_change:.1e} after {orders} orders and may err by {root_error:.1e}; they must settle to 1e-6 \
         and be proven to 1e-4"
    )]
    UnsettledRoots {
        orders: usize,
        last_change: f64,
        root_error: f64,
    },
    /// A computation that a library could not finish, or whose result fails its own proof.
    #[error("{what}: {why}")]
    Failed { what: &'static str, why: String },
}

impl Error {
    /// Error of an iterative library routine that did not converge.
    pub fn no_convergence(what: &'static str) -> Self {
        let why = "the library's routine did not converge".into();
        Self::Failed { what, why }
    }

    /// Verdict that modes come so close under a change that the perturbation cannot follow them.
    pub fn is_of_close_modes(&self) -> bool {
        matches!(
            self,
            Self::CoalescingModes { .. } | Self::UnsettledRoots { .. }
        )
    }
}

/// Accepts a number that is what it must be.
pub(crate) fn require(
    is_met: bool,
    what: &'static str,
    owner: impl FnOnce() -> String,
    value: f64,
    expected: &'static str,
) -> Result<()> {
    if is_met {
        return Ok(());
    }
    Err(Error::Value {
        what,
        owner: owner(),
        value,
        expected,
    })
}

/// Accepts a positive finite number.
pub(crate) fn positive(
    what: &'static str,
    owner: impl FnOnce() -> String,
    value: f64,
) -> Result<()> {
    require(
        value > 0.0 && value.is_finite(),
        what,
        owner,
        value,
        "positive and finite",
    )
}

/// Accepts a number of things from `least` to `most`.
pub(crate) fn check_count(
    what: &'static str,
    found: usize,
    least: usize,
    most: usize,
) -> Result<()> {
    if (least..=most).contains(&found) {
        return Ok(());
    }
    Err(Error::Count {
        what,
        found,
        least,
        most,
    })
}

/// Accepts places, counted from zero, among `count` things.
pub(crate) fn check_places(what: &'static str, places: &[usize], count: usize) -> Result<()> {
    places
        .iter()
        .try_for_each(|place| check_count(what, place.saturating_add(1), 1, count))
}

/// Accepts one or more.
pub(crate) fn at_least_one(what: &'static str, count: usize) -> Result<()> {
    check_count(what, count, 1, usize::MAX)
}
