//! Mode sorting (4): the pairing of every test mode with the analysis mode that answers it.
//! Tour: [chapter 3](crate::tour::chapter_03_error_sum).

use super::{
    error::{Result, check_count, check_places},
    linear_algebra::{Matrix, check_finite, check_length, check_shape},
    modes::Modes,
};

/// Pairs of an analysis mode with every test mode.
#[derive(Debug, Clone, PartialEq)]
pub struct Pairing {
    /// Index of the analysis mode of each test mode.
    pub analysis_mode: Vec<usize>,
    /// Sign, +1 or −1, that turns each test mode's analysis shape its way.
    pub sign: Vec<f64>,
}

impl Pairing {
    /// Pairs with the signs of their entries in the cross-orthogonality (n × g).
    pub(crate) fn signed(analysis_mode: Vec<usize>, cross: &Matrix) -> Self {
        let sign = |(j, &i): (usize, &usize)| if cross[(i, j)] < 0.0 { -1.0 } else { 1.0 };
        Self {
            sign: analysis_mode.iter().enumerate().map(sign).collect(),
            analysis_mode,
        }
    }

    /// The paired analysis modes, in the order and with the signs of the test modes.
    ///
    /// # Errors
    /// A pairing of other modes, and one without a sign for every mode.
    pub fn paired(&self, analysis: &Modes) -> Result<Modes> {
        let count = self.analysis_mode.len();
        check_length("signs of paired modes", self.sign.len(), count)?;
        check_places("paired analysis modes", &self.analysis_mode, analysis.len())?;
        let mut paired = analysis.select(&self.analysis_mode);
        paired.shapes *= Matrix::from_diagonal(&self.sign.clone().into());
        Ok(paired)
    }
}

/// Cross-orthogonality $m = V_F^t M V_G$ (4), analysis modes by test modes (n × g).
///
/// With mass-orthonormal shapes every entry lies between −1 and 1.
///
/// # Errors
/// A mass that does not fit the shapes.
///
/// # Example
///
/// ```rust
/// use corfem::method::modes::Modes;
/// use corfem::method::sorting::cross_orthogonality;
/// use nalgebra::{DMatrix, dmatrix, dvector};
///
/// // The test has the second analysis mode first, and the first one upside down.
/// let omega_squared = dvector![1.0, 4.0];
/// let analysis = Modes::new(omega_squared.clone(), DMatrix::identity(2, 2))?;
/// let test = Modes::new(omega_squared, dmatrix![0.0, -1.0; 1.0, 0.0])?;
/// let cross = cross_orthogonality(&analysis, &test, &DMatrix::identity(2, 2))?;
/// assert_eq!(cross, dmatrix![0.0, -1.0; 1.0, 0.0]);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn cross_orthogonality(analysis: &Modes, test: &Modes, mass: &Matrix) -> Result<Matrix> {
    let (v, w) = (&analysis.shapes, &test.shapes);
    check_shape("dynamic mass", mass, v.nrows(), v.nrows())?;
    check_shape("test mode shapes", w, v.nrows(), w.ncols())?;
    Ok(v.tr_mul(&(mass * w)))
}

/// Pairs every test mode with an analysis mode by the cross-orthogonality $m$ (n × g, g ≤ n).
///
/// The pair whose $|m_{ij}|$ is closest to one is made first, then the closest of what is left, and so on: on
/// a conflict the closest keeps its mode and the other takes its next best. A tie goes to the lower test mode, then
/// to the lower analysis mode. The sign of a pair is that of its $m_{ij}$.
///
/// # Errors
/// No test modes, more of them than analysis modes, and an entry that is not finite.
///
/// # Example
///
/// ```rust
/// use corfem::method::sorting::pair_modes;
/// use nalgebra::dmatrix;
///
/// // Both test modes are closest to the first analysis mode; the second is closer and keeps it.
/// let pairing = pair_modes(&dmatrix![0.8, -0.9; 0.6, 0.3])?;
/// assert_eq!((pairing.analysis_mode, pairing.sign), (vec![1, 0], vec![1.0, -1.0]));
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn pair_modes(cross: &Matrix) -> Result<Pairing> {
    let (analysis_count, test_count) = cross.shape();
    check_count("test modes", test_count, 1, analysis_count)?;
    check_finite("cross-orthogonality", cross)?;
    let from_one = |(i, j): (usize, usize)| (1.0 - cross[(i, j)].abs()).abs();
    let mut pairs: Vec<_> = (0..test_count)
        .flat_map(|j| (0..analysis_count).map(move |i| (i, j)))
        .collect();
    // The sort is stable, so ties stay in the order of test modes, then analysis modes.
    pairs.sort_by(|&a, &b| from_one(a).total_cmp(&from_one(b)));
    let mut partner = vec![None; test_count];
    for (i, j) in pairs {
        if partner[j].is_none() && !partner.contains(&Some(i)) {
            partner[j] = Some(i);
        }
    }
    Ok(Pairing::signed(
        partner.into_iter().flatten().collect(),
        cross,
    ))
}
