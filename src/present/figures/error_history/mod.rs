//! Frequency error, shape error and their sum against iteration (Figures 5, 7 and 8).

mod drawing;

use crate::cases::CaseResult;
use crate::method::error_sum::Errors;

/// Errors at one place of the history.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Accepted iterations since the start of the first pass.
    pub iteration: usize,
    /// SRSS errors there, fractions.
    pub errors: Errors,
}

/// One pass.
#[derive(Debug, Clone, PartialEq)]
pub struct PassHistory {
    /// Its number, from 1.
    pub pass: usize,
    /// The exact solution it starts from, then every iteration by perturbation.
    pub inner: Vec<Moment>,
    /// The exact check at its end.
    pub check: Moment,
    /// Its tolerance on the error sum, a fraction.
    pub tolerance: f64,
}

/// What the figure shows.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorHistory {
    /// Case number.
    pub case: usize,
    /// Its passes.
    pub passes: Vec<PassHistory>,
}

/// The history of a case.
pub fn error_history(result: &CaseResult) -> ErrorHistory {
    let settings = &result.case.settings;
    let mut iteration = 0;
    let mut passes = Vec::new();
    for (row, pass) in result.correlation.passes.iter().enumerate() {
        let mut inner = vec![Moment { iteration, errors: pass.inner.start }];
        for step in &pass.inner.iterations {
            iteration += 1;
            inner.push(Moment { iteration, errors: step.errors });
        }
        passes.push(PassHistory {
            pass: row + 1,
            inner,
            check: Moment { iteration, errors: pass.check.errors },
            tolerance: if row == 0 { settings.inner.tolerance } else { settings.later_inner_tolerance },
        });
    }
    ErrorHistory { case: result.case.number, passes }
}
