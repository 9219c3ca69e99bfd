//! Modes so close in frequency that a small change mixes their shapes: what is compared is the subspace that they span.

use crate::method::error::Error;
use crate::method::linear_algebra::check_length;
use crate::method::modes::Modes;
use crate::method::sorting::Pairing;
use crate::sparse::{is_one_root, modal_assurance};
use nalgebra::{DMatrix, DVector};

/// Standard deviations of a difference of two frequencies within which the test does not tell which is the higher.
const TOLD: f64 = 2.0;
/// Part of the largest singular value of some shapes, each of unit length, below which a sensor set sees a combination of them as
/// nothing: half the digits of a double.
const SEEN: f64 = 1e-8;

/// Test modes in groups, each of which is compared as a subspace: every two neighbors in frequency (Hz) are within twice the standard
/// deviation of their difference, by the relative `deviations` of each.
pub fn indistinct_groups(frequencies_hz: &[f64], deviations: &[f64]) -> Vec<Vec<usize>> {
    let mut ascending: Vec<usize> = (0..frequencies_hz.len()).collect();
    ascending.sort_by(|&a, &b| frequencies_hz[a].total_cmp(&frequencies_hz[b]));
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for mode in ascending {
        let own = |mode: usize| deviations.get(mode).copied().unwrap_or_default();
        let deviation = |mode: usize| own(mode) * frequencies_hz[mode];
        let joins = |group: &&mut Vec<usize>| {
            group.last().is_some_and(|&last| {
                let apart = frequencies_hz[mode] - frequencies_hz[last];
                apart <= TOLD * deviation(mode).hypot(deviation(last))
            })
        };
        match groups.last_mut().filter(joins) {
            Some(group) => group.push(mode),
            None => groups.push(vec![mode]),
        }
    }
    groups
}

/// The analysis modes, of squared frequencies `k`, with which the shape of test mode `j` is compared: its partner, then those of the others
/// of its group, then modes of the same roots that are nobody's partner.
pub(crate) fn members(
    k: &DVector<f64>,
    pairing: &Pairing,
    together: &[Vec<usize>],
    j: usize,
) -> Vec<usize> {
    let group = together.iter().find(|group| group.contains(&j));
    let others = group.into_iter().flatten().filter(|&&other| other != j);
    let tests = [j].into_iter().chain(others.copied());
    let partners = &pairing.analysis_mode;
    let mut members: Vec<usize> = tests.map(|test| partners[test]).collect();
    let own = members.clone();
    let is_at_root = |i: &usize| own.iter().any(|&member| is_one_root(k[*i], k[member]));
    let unpaired = (0..k.len()).filter(|i| !partners.contains(i) && is_at_root(i));
    members.extend(unpaired);
    members
}

/// The combination of some shapes nearest to another $u$, in the least squares of its components.
pub(crate) struct Nearest {
    /// $V^+$, one row a shape.
    pub inverse: DMatrix<f64>,
    /// $a = V^+ u$.
    pub shares: DVector<f64>,
    /// $V a - u$, orthogonal to all of them.
    pub apart: DVector<f64>,
}

/// Of shapes (d × m).
pub(crate) fn nearest(shapes: &DMatrix<f64>, u: &DVector<f64>) -> Nearest {
    let mut unit = shapes.clone();
    let sizes: Vec<f64> = unit
        .column_iter()
        .map(|shape| shape.norm().max(f64::MIN_POSITIVE))
        .collect();
    for (mut shape, size) in unit.column_iter_mut().zip(&sizes) {
        shape /= *size;
    }
    // Of one shape this is its transpose.
    let mut inverse = if unit.ncols() == 1 {
        unit.transpose()
    } else {
        let parts = unit.clone().svd(true, true);
        let least = SEEN * parts.singular_values.amax();
        parts
            .pseudo_inverse(least)
            .unwrap_or_else(|_| unit.transpose())
    };
    let apart = &unit * (&inverse * u) - u;
    for (mut row, size) in inverse.row_iter_mut().zip(sizes) {
        row /= size;
    }
    Nearest {
        shares: &inverse * u,
        inverse,
        apart,
    }
}

/// Modal assurance (n × g) in which modes of one root count as the subspace that they span: of a test shape $u$ each has
/// $\lVert V V^+ u \rVert^2/\lVert u \rVert^2$. Shapes of one root are any basis of it.
///
/// # Errors
/// Those of [`modal_assurance`].
pub fn assurance_of_roots(modes: &Modes, shapes: &DMatrix<f64>) -> Result<DMatrix<f64>, Error> {
    let mut assurance = modal_assurance(&modes.shapes, shapes)?;
    let k = &modes.omega_squared;
    for i in 0..k.len() {
        let members = (0..k.len()).filter(|r| is_one_root(k[*r], k[i]));
        let members: Vec<usize> = members.collect();
        if members.len() > 1 {
            let members = modes.shapes.select_columns(&members);
            for (j, shape) in shapes.column_iter().enumerate() {
                let apart = nearest(&members, &shape.normalize()).apart;
                assurance[(i, j)] = 1.0 - apart.norm_squared();
            }
        }
    }
    Ok(assurance)
}

/// The same modes with the shapes of every group that is compared as one turned within the subspace to those of the test: $V Q$ with $Q$
/// the orthogonal matrix nearest to $V^+ U$ of shapes of unit length.
///
/// # Errors
/// [`Error::WrongShape`] for a pairing of another number of test modes.
///
/// Source: Golub and Van Loan, *Matrix Computations*, 4th ed. (2013), section 6.4.1.
pub fn turned(
    modes: &Modes,
    pairing: &Pairing,
    together: &[Vec<usize>],
    test: &Modes,
) -> Result<Modes, Error> {
    check_length("paired modes", pairing.analysis_mode.len(), test.len())?;
    let mut turned = modes.clone();
    for group in together {
        let roots = &modes.omega_squared;
        let members = group.first().map(|&j| members(roots, pairing, together, j));
        let members = members.unwrap_or_default();
        if members.len() < 2 {
            continue;
        }
        let own = modes.shapes.select_columns(&members);
        let mut wanted = DMatrix::zeros(members.len(), members.len());
        for (place, &j) in group.iter().enumerate() {
            let shares = nearest(&own, &test.shapes.column(j).normalize()).shares;
            if let Some(shares) = shares.try_normalize(0.0) {
                wanted.set_column(place, &(pairing.sign[j] * shares));
            }
        }
        let parts = wanted.svd(true, true);
        if let (Some(left), Some(right)) = (parts.u, parts.v_t) {
            let shapes = own * (left * right);
            for (shape, &member) in shapes.column_iter().zip(&members) {
                turned.shapes.set_column(member, &shape);
            }
        }
    }
    Ok(turned)
}
