//! What the test modes can see of the parameters, and how sure the factors are.

use crate::method::error::{Error, at_least_one, positive};
use crate::method::linear_algebra::{as_faer, check_finite, check_length};
use crate::sparse::{gram, inverse_of_positive};
use nalgebra::{DMatrix, DVector};
use serde::Serialize;

/// Cosine of two parameters' columns above which they are nearly parallel: a fifth of one is what the other cannot imitate.
pub const PARALLEL_COSINE: f64 = 0.98;
/// Standard deviations on either side that hold 95 % of a normal distribution.
pub const NORMAL_95: f64 = 1.959_963_984_540_054;

/// Standard deviation of the logarithm of a factor before the test unless another is given: a factor of $e$, so that it decides alone where
/// the test is silent.
pub const PRIOR_DEVIATION: f64 = 1.0;

/// What a weighted Jacobian $J$ (residuals × p parameters) says of the logarithms of the factors.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Identifiability {
    /// Singular values of $J$, descending: one over the standard deviation of a direction by the data alone.
    pub singular_values: Vec<f64>,
    /// The largest over the smallest; infinite where some combination has no effect.
    pub condition: f64,
    /// Pairs above [`PARALLEL_COSINE`] with their cosine, negative where one undoes the other.
    pub parallel: Vec<(usize, usize, f64)>,
    /// Those that say more than the prior beyond what the ones before can imitate, by QR with column pivoting.
    pub subset: Vec<usize>,
    /// Covariance of the logarithms, $(J^t J + \mathrm{diag}(\tau^{-2}))^{-1}$ (p × p).
    #[serde(skip)]
    pub covariance: DMatrix<f64>,
    /// Standard deviations of the logarithms.
    pub deviations: Vec<f64>,
    /// How much of each prior variance the test has taken away, $1 - s^2/\tau^2$: near one where the data decide.
    pub learned: Vec<f64>,
}

/// Part of the prior variance that a parameter known mostly from the prior keeps at least: the prior then says more of it than the test.
pub const MOSTLY_PRIOR: f64 = 0.5;

/// Singular values, parallel parameters, a subset, and covariance with priors of standard deviations $\tau$, one a
/// parameter.
///
/// The covariance is that of a linear model with normal errors as the weights say, and of logarithms normal about zero
/// with $\tau$ before the test. Where `learned` is near one it is, as closely, that of the estimate over repeated
/// tests. Source: Friswell and Mottershead, *Finite Element Model Updating* (1995); Golub and Van Loan, *Matrix
/// Computations*.
///
/// # Errors
/// [`Error::Value`] for $\tau$ that is not positive; [`Error::Value`]; [`Error::Count`] without parameters or residuals.
pub fn identifiability(jacobian: &DMatrix<f64>, priors: &[f64]) -> Result<Identifiability, Error> {
    let count = jacobian.ncols();
    check_finite("Jacobian", jacobian)?;
    at_least_one("parameters or residuals", jacobian.len())?;
    let gram = gram(jacobian);
    let covariance = covariance(gram.clone(), priors)?;
    let singular_values = as_faer(jacobian).singular_values();
    let mut singular_values =
        singular_values.map_err(|_| Error::no_convergence("singular values of the Jacobian"))?;
    singular_values.resize(count, 0.0);
    // What is round-off of the largest is none.
    let rows = jacobian.nrows().max(count) as f64;
    let round_off = rows * f64::EPSILON * singular_values[0];
    let values = singular_values.iter_mut();
    values
        .filter(|value| **value < round_off)
        .for_each(|value| *value = 0.0);
    let smallest = singular_values[count - 1];
    let lengths: Vec<f64> = jacobian.column_iter().map(|column| column.norm()).collect();
    let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b)));
    let cosine = |(a, b)| {
        let cosine: f64 = gram[(a, b)] / (lengths[a] * lengths[b]);
        cosine.clamp(-1.0, 1.0)
    };
    let parallel = pairs.map(|(a, b)| (a, b, cosine((a, b))));
    let priors = DVector::from_column_slice(priors);
    let deviations: Vec<f64> = covariance
        .diagonal()
        .iter()
        .map(|variance| variance.sqrt())
        .collect();
    Ok(Identifiability {
        condition: if smallest > 0.0 {
            singular_values[0] / smallest
        } else {
            f64::INFINITY
        },
        parallel: parallel
            .filter(|(_, _, cosine)| cosine.abs() > PARALLEL_COSINE)
            .collect(),
        subset: subset(gram.map_with_location(|a, b, product| priors[a] * product * priors[b])),
        learned: deviations
            .iter()
            .zip(&priors)
            .map(|(deviation, prior)| 1.0 - (deviation / prior).powi(2))
            .collect(),
        singular_values,
        covariance,
        deviations,
    })
}

/// $J^t J + \mathrm{diag}(\tau^{-2})$, the inverse of the covariance, from the inverse squares of the prior deviations.
pub(super) fn information(jacobian: &DMatrix<f64>, tikhonov: &DVector<f64>) -> DMatrix<f64> {
    gram(jacobian) + DMatrix::from_diagonal(tikhonov)
}

/// The covariance of the logarithms from $J^t J$ and the prior deviations.
///
/// # Errors
/// [`Error::Value`] for a deviation that is not positive; [`Error::WrongShape`] for another number of them.
pub(super) fn covariance(gram: DMatrix<f64>, priors: &[f64]) -> Result<DMatrix<f64>, Error> {
    check_length("prior deviations", priors.len(), gram.ncols())?;
    for prior in priors {
        positive("prior_deviation", || "the parameters".into(), *prior)?;
    }
    let information = gram + DMatrix::from_diagonal(&tikhonov(priors));
    inverse_of_positive("information", &information)
}

/// $1/\tau^2$ of every prior deviation.
pub(super) fn tikhonov(priors: &[f64]) -> DVector<f64> {
    DVector::from_column_slice(priors).map(|prior| prior.powi(-2))
}

/// Lengths between which round-off does not choose, relative to the longer.
const TIE: f64 = 1e-9;

/// Columns with these products, in prior deviations, in the order of QR with column pivoting, while what those before cannot imitate is
/// longer than one. Of equally long ones the first comes first.
fn subset(mut left: DMatrix<f64>) -> Vec<usize> {
    let mut subset = Vec::new();
    loop {
        let longest = left.diagonal().max();
        let is_longest = |e: &usize| left[(*e, *e)] >= (1.0 - TIE) * longest;
        let Some(next) = (0..left.nrows()).find(is_longest).filter(|_| longest > 1.0) else {
            return subset;
        };
        subset.push(next);
        let imitated = left.column(next) / left[(next, next)].sqrt();
        left.ger(-1.0, &imitated, &imitated, 1.0);
        left.row_mut(next).fill(0.0);
        left.column_mut(next).fill(0.0);
    }
}

impl Identifiability {
    /// True if the prior says more of a parameter than the test.
    pub fn is_mostly_prior(&self, e: usize) -> bool {
        1.0 - self.learned[e] > MOSTLY_PRIOR
    }

    /// Parameters that are parallel to one another, directly or through others, in groups.
    pub fn parallel_groups(&self) -> Vec<Vec<usize>> {
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for &(a, b, _) in &self.parallel {
            let (mut joined, apart): (Vec<Vec<usize>>, _) = groups
                .into_iter()
                .partition(|group| group.contains(&a) || group.contains(&b));
            let mut group = joined.concat();
            group.extend([a, b]);
            group.sort_unstable();
            group.dedup();
            joined = apart;
            joined.push(group);
            groups = joined;
        }
        groups.sort();
        groups
    }

    /// Groups of parallel parameters of which each is known more from the prior than from the test: it tells their combinations alone.
    pub fn untold_groups(&self) -> Vec<Vec<usize>> {
        let mut groups = self.parallel_groups();
        groups.retain(|group| group.iter().all(|&e| self.is_mostly_prior(e)));
        groups
    }
}
