//! Measures of how well analysis and test modes agree, beside [`modal_assurance`](crate::method::pairing::modal_assurance) and
//! [`cross_orthogonality`](crate::method::pairing::cross_orthogonality); either side may have more modes than the other.
//!
//! AutoMAC is the modal assurance of a set of shapes with itself: what it has beside its diagonal, sensors cannot tell apart.

use crate::method::error::{Error, at_least_one};
use crate::method::linear_algebra::{
    check_finite, check_length, check_shape, check_symmetric, finite,
};
use crate::method::structure::positive;
use nalgebra::{DMatrix, DVector};

/// Pseudo-orthogonality of analysis shapes (d × n) and test shapes (d × g) of any scale, n × g, by a test-analysis mass $M$ at the
/// sensors (d × d, lbf·s²/in), such as a condensed one; its magnitude is at most one:
///
/// $$ \mathrm{POC}_{ij} = \frac{v_i^t M w_j}{\sqrt{v_i^t M v_i} \sqrt{w_j^t M w_j}} $$
///
/// Source: Ewins, *Modal Testing: Theory, Practice and Application*, 2nd edition (2000), chapter 5.
///
/// # Errors
/// [`Error::NotSymmetric`], [`Error::WrongShape`], [`Error::NotFinite`]; [`Error::NotPositive`] for a generalized mass.
pub fn pseudo_orthogonality(
    analysis: &DMatrix<f64>,
    test: &DMatrix<f64>,
    mass: &DMatrix<f64>,
) -> Result<DMatrix<f64>, Error> {
    check_symmetric("test-analysis mass", mass)?;
    check_shape(
        "analysis mode shapes",
        analysis,
        mass.nrows(),
        analysis.ncols(),
    )?;
    check_shape("test mode shapes", test, mass.nrows(), test.ncols())?;
    let generalized_mass = |shape: &DVector<f64>| shape.dot(&(mass * shape));
    let (v, w) = (
        scaled("analysis", analysis, generalized_mass)?,
        scaled("test", test, generalized_mass)?,
    );
    finite("pseudo-orthogonality", v.tr_mul(&(mass * w)))
}

/// Modal scale factors, n × g: the multiple of the analysis shape $v_i$ (of d × n) that is nearest to the test shape $w_j$ (of d × g),
///
/// $$ \mathrm{MSF}_{ij} = \frac{v_i^t w_j}{v_i^t v_i} . $$
///
/// Source: Allemang and Brown, *Proc. 1st International Modal Analysis Conference* (1982), 110.
///
/// # Errors
/// [`Error::WrongShape`]; [`Error::NotFinite`]; [`Error::NotPositive`] for an analysis shape whose square is zero.
pub fn modal_scale_factors(
    analysis: &DMatrix<f64>,
    test: &DMatrix<f64>,
) -> Result<DMatrix<f64>, Error> {
    check_shape("test mode shapes", test, analysis.nrows(), test.ncols())?;
    let mut factors = analysis.tr_mul(test);
    for (mode, mut row) in factors.row_iter_mut().enumerate() {
        let square = analysis.column(mode).norm_squared();
        positive(
            "square",
            || format!("analysis mode {mode} (from zero)"),
            square,
        )?;
        row /= square;
    }
    finite("modal scale factors", factors)
}

/// Coordinate modal assurance (COMAC) of every DOF over paired modes of analysis (d × n) and test (d × g), d numbers from 0 to 1:
///
/// $$ c_p = \frac{(\sum_l |v_{pl} w_{pl}|)^2}{\sum_l v_{pl}^2 \sum_l w_{pl}^2} $$
///
/// for shapes of unit length, so that scale and sign of none matter. `pairs` has the analysis mode of every test mode,
/// or none, as [`pair_optimally`](crate::studies::assignment::pair_optimally) gives it. A DOF that does not move on
/// either side has 1, one that moves on one side only has 0. A low value names a sensor at fault or a place where the
/// model is wrong, or one that moves little. Source: Lieven and Ewins, *Proc. 6th International Modal Analysis
/// Conference* (1988), 690.
///
/// # Errors
/// [`Error::WrongShape`]; [`Error::Empty`] without a pair; [`Error::Unknown`] for a pair with a mode that is not there;
/// [`Error::NotFinite`]; [`Error::NotPositive`] for a shape that is zero.
pub fn coordinate_assurance(
    analysis: &DMatrix<f64>,
    test: &DMatrix<f64>,
    pairs: &[Option<usize>],
) -> Result<DVector<f64>, Error> {
    check_shape("test mode shapes", test, analysis.nrows(), test.ncols())?;
    check_length("pairs", pairs.len(), test.ncols())?;
    let (tests, modes): (Vec<usize>, Vec<usize>) = pairs
        .iter()
        .enumerate()
        .filter_map(|(j, mode)| Some((j, (*mode)?)))
        .unzip();
    if let Some(&label) = modes.iter().find(|mode| **mode >= analysis.ncols()) {
        return Err(Error::Unknown {
            owner: "pairs".to_owned(),
            what: "analysis mode (from zero)",
            label,
        });
    }
    at_least_one("pairs", modes.len())?;
    let v = scaled(
        "paired analysis",
        &analysis.select_columns(&modes),
        DVector::norm_squared,
    )?;
    let w = scaled(
        "paired test",
        &test.select_columns(&tests),
        DVector::norm_squared,
    )?;
    let assurance = v
        .row_iter()
        .zip(w.row_iter())
        .map(|(v, w)| match (v.norm(), w.norm()) {
            (0.0, 0.0) => 1.0,
            (0.0, _) | (_, 0.0) => 0.0,
            (one, other) => ((v / one).abs().dot(&(w / other).abs())).powi(2).min(1.0),
        });
    Ok(DVector::from_iterator(v.nrows(), assurance))
}

/// The shapes with a square of one each.
fn scaled(
    of: &str,
    shapes: &DMatrix<f64>,
    square: impl Fn(&DVector<f64>) -> f64,
) -> Result<DMatrix<f64>, Error> {
    check_finite("mode shapes", shapes)?;
    let mut scaled = shapes.clone();
    for (mode, mut shape) in scaled.column_iter_mut().enumerate() {
        let (owner, largest) = (|| format!("{of} mode {mode} (from zero)"), shape.amax());
        positive("largest component", owner, largest)?;
        // In two steps: squares of very large or small components leave the range of numbers.
        shape /= largest;
        let square = square(&shape.clone_owned());
        positive("generalized mass", owner, square)?;
        shape /= square.sqrt();
    }
    Ok(scaled)
}
