//! Pairing (4), which the paper calls mode sorting: which analysis mode answers which test mode.
//! Tour: [chapter 3](crate::tour::chapter_03_error_sum).

use crate::method::error::{Error, setting};
use crate::method::linear_algebra::{check_finite, check_length, check_shape, finite};
use crate::method::modes::{ModeSet, check_count};
use crate::method::structure::positive;
use nalgebra::DMatrix;

/// The analysis mode paired with every test mode. A sign is +1 or −1:
///
/// ```compile_fail,E0451
/// let pairing = corfem::method::pairing::Pairing { analysis_mode: vec![0], sign: vec![0.5] };
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Pairing {
    /// For each test mode, the index of its analysis mode.
    pub(crate) analysis_mode: Vec<usize>,
    /// For each test mode, +1 or −1: the sign that turns the analysis shape its way.
    pub(crate) sign: Vec<f64>,
}

impl Pairing {
    /// For each test mode, the index of its analysis mode.
    pub fn analysis_mode(&self) -> &[usize] {
        &self.analysis_mode
    }

    /// For each test mode, +1 or −1: the sign that turns the analysis shape its way.
    pub fn sign(&self) -> &[f64] {
        &self.sign
    }

    /// Pairs of known analysis modes (from zero) and signs, one of each for every test mode.
    ///
    /// # Errors
    /// [`Error::WrongShape`] for lists of different lengths; [`Error::Setting`] for another sign.
    pub fn new(analysis_mode: Vec<usize>, sign: Vec<f64>) -> Result<Self, Error> {
        check_length("signs of paired modes", sign.len(), analysis_mode.len())?;
        for &sign in &sign {
            setting("sign of a paired mode", "1 or -1", sign, sign.abs() == 1.0)?;
        }
        Ok(Self {
            analysis_mode,
            sign,
        })
    }

    /// Refuses analysis modes other than those paired, and another number of test modes.
    pub(crate) fn check(&self, analysis: &ModeSet, test_count: usize) -> Result<(), Error> {
        check_length("paired modes", self.analysis_mode.len(), test_count)?;
        let highest = self.analysis_mode.iter().max();
        // A test of frequencies alone has no pairs.
        highest.map_or(Ok(()), |mode| {
            check_count(
                "paired analysis modes",
                mode.saturating_add(1),
                analysis.len(),
            )
        })
    }
}

/// Cross-orthogonality $m = V_F^t M V_G$ (4), analysis modes by test modes (n × g).
///
/// With mass-orthonormal shapes every entry lies between −1 and 1.
///
/// # Errors
/// [`Error::WrongShape`] when shapes and mass do not fit.
///
/// # Example
///
/// ```rust
/// use corfem::method::modes::ModeSet;
/// use corfem::method::pairing::cross_orthogonality;
/// use nalgebra::{DMatrix, dmatrix, dvector};
///
/// // The test has the second analysis mode first, and the first one upside down.
/// let omega_squared = dvector![1.0, 4.0];
/// let analysis = ModeSet::new(omega_squared.clone(), DMatrix::identity(2, 2))?;
/// let test = ModeSet::new(omega_squared, dmatrix![0.0, -1.0; 1.0, 0.0])?;
/// let cross = cross_orthogonality(&analysis, &test, &DMatrix::identity(2, 2))?;
/// assert_eq!(cross, dmatrix![0.0, -1.0; 1.0, 0.0]);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn cross_orthogonality(
    analysis: &ModeSet,
    test: &ModeSet,
    mass: &DMatrix<f64>,
) -> Result<DMatrix<f64>, Error> {
    let dof_count = mass.nrows();
    check_shape("dynamic mass", mass, dof_count, dof_count)?;
    check_shape(
        "analysis mode shapes",
        &analysis.shapes,
        dof_count,
        analysis.len(),
    )?;
    check_shape("test mode shapes", &test.shapes, dof_count, test.len())?;
    Ok(analysis.shapes.tr_mul(&(mass * &test.shapes)))
}

/// Modal assurance criterion between two sets of shapes (columns), n × g:
///
/// $$ \mathrm{MAC}_{ij} = \frac{(v_i^t w_j)^2}{(v_i^t v_i)(w_j^t w_j)} $$
///
/// Source: Allemang and Brown, *Proc. 1st International Modal Analysis Conference* (1982), 110.
///
/// # Errors
/// [`Error::WrongShape`] when the shapes have different numbers of DOF; [`Error::NotPositive`] naming a shape that is zero;
/// [`Error::NotFinite`].
///
/// # Example
///
/// ```rust
/// use corfem::method::pairing::modal_assurance;
/// use nalgebra::dmatrix;
///
/// // (3 · 1)² / (3² + 4²): neither scale nor sign counts.
/// let assurance = modal_assurance(&dmatrix![3.0; 4.0], &dmatrix![-1.0; 0.0])?;
/// assert!((assurance[0] - 0.36).abs() < 1e-15);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn modal_assurance(
    shapes: &DMatrix<f64>,
    others: &DMatrix<f64>,
) -> Result<DMatrix<f64>, Error> {
    check_shape("mode shapes", others, shapes.nrows(), others.ncols())?;
    for (of, shapes) in [("mode shape", shapes), ("other mode shape", others)] {
        for (mode, shape) in shapes.column_iter().enumerate() {
            positive(
                "largest component",
                || format!("{of} {mode} (from zero)"),
                shape.amax(),
            )?;
        }
    }
    Ok(signed_assurance(shapes, others)?.abs())
}

/// The same with the sign of the product $v_i^t w_j$, and zero for a shape that is zero.
pub(crate) fn signed_assurance(
    shapes: &DMatrix<f64>,
    others: &DMatrix<f64>,
) -> Result<DMatrix<f64>, Error> {
    check_shape("mode shapes", others, shapes.nrows(), others.ncols())?;
    // Of a largest component of one to two: squares of very large or small ones leave the range of numbers. A power of two is
    // exact.
    let unit = |shapes: &DMatrix<f64>| {
        let mut unit = shapes.clone();
        let scale = |largest: f64| {
            if largest > 0.0 {
                largest.log2().floor().exp2()
            } else {
                1.0
            }
        };
        unit.column_iter_mut()
            .for_each(|mut shape| shape /= scale(shape.amax()));
        unit
    };
    let (shapes, others) = (unit(shapes), unit(others));
    let cross = shapes.tr_mul(&others);
    let assurance = DMatrix::from_fn(cross.nrows(), cross.ncols(), |i, j| match cross[(i, j)] {
        0.0 => 0.0,
        product => {
            product * product.abs()
                / (shapes.column(i).norm_squared() * others.column(j).norm_squared())
        }
    });
    finite("modal assurance", assurance)
}

/// Pairs every test mode with an analysis mode by the cross-orthogonality $m$ (n × g, g ≤ n).
///
/// The pair whose $|m_{ij}|$ is closest to one is made first, then the closest of what is left, and so on: on
/// a conflict the closest keeps its mode and the other takes its next best. A tie goes to the lower test mode, then
/// to the lower analysis mode. The sign of a pair is that of its $m_{ij}$.
///
/// # Errors
/// [`Error::Empty`] without test modes; [`Error::TooMany`] with more test modes than analysis modes;
/// [`Error::NotFinite`].
///
/// # Example
///
/// ```rust
/// use corfem::method::pairing::pair_modes;
/// use nalgebra::dmatrix;
///
/// // Both test modes are closest to the first analysis mode; the second is closer and keeps it.
/// let pairing = pair_modes(&dmatrix![0.8, -0.9; 0.6, 0.3])?;
/// assert_eq!((pairing.analysis_mode(), pairing.sign()), (&[1, 0][..], &[1.0, -1.0][..]));
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
pub fn pair_modes(cross: &DMatrix<f64>) -> Result<Pairing, Error> {
    let (analysis_count, test_count) = cross.shape();
    check_count("test modes", test_count, analysis_count)?;
    check_finite("cross-orthogonality", cross)?;
    let from_one = |(i, j): (usize, usize)| (1.0 - cross[(i, j)].abs()).abs();
    let mut pairs: Vec<_> = (0..test_count)
        .flat_map(|j| (0..analysis_count).map(move |i| (i, j)))
        .collect();
    // The sort is stable, so ties stay in the order of test modes, then analysis modes.
    pairs.sort_by(|&a, &b| from_one(a).total_cmp(&from_one(b)));
    let mut partner: Vec<Option<usize>> = vec![None; test_count];
    for (i, j) in pairs {
        if partner[j].is_none() && !partner.contains(&Some(i)) {
            partner[j] = Some(i);
        }
    }
    let analysis_mode: Vec<usize> = partner.into_iter().flatten().collect();
    let pairs = analysis_mode.iter().enumerate();
    let sign = pairs
        .map(|(j, &i)| if cross[(i, j)] < 0.0 { -1.0 } else { 1.0 })
        .collect();
    Ok(Pairing {
        analysis_mode,
        sign,
    })
}

/// The paired analysis modes, in the order and with the signs of the test modes.
///
/// # Errors
/// [`Error::WrongShape`], [`Error::TooMany`] for a pairing of other modes.
pub fn paired(analysis: &ModeSet, pairing: &Pairing) -> Result<ModeSet, Error> {
    pairing.check(analysis, pairing.sign.len())?;
    let mut paired = analysis.select(&pairing.analysis_mode);
    for (mut shape, &sign) in paired.shapes.column_iter_mut().zip(&pairing.sign) {
        shape *= sign;
    }
    Ok(paired)
}
