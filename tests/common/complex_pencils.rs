//! Strategies and small problems for complex unsymmetric pencils, and their roots by another route.

use crate::prelude::*;

/// A stiffness and a complex unsymmetric $G$ with their changes.
#[derive(Debug, Clone)]
pub struct ComplexPencil {
    pub stiffness: DMatrix<f64>,
    pub g: DMatrix<Complex<f64>>,
    pub stiffness_change: DMatrix<Complex<f64>>,
    pub g_change: DMatrix<Complex<f64>>,
}

/// A square complex matrix with real and imaginary parts between −1 and 1.
pub fn complex_square(size: usize) -> impl Strategy<Value = DMatrix<Complex<f64>>> {
    prop::collection::vec((-1.0..1.0_f64, -1.0..1.0_f64), size * size).prop_map(move |parts| {
        DMatrix::from_iterator(
            size,
            size,
            parts.iter().map(|&(re, im)| Complex::new(re, im)),
        )
    })
}

/// Three to six DOF, an orthogonally mixed stiffness with separate spectrum, $G$ the unit mass with complex terms of
/// 2 %, changes of 1 %: roots stay a factor 1.3 apart, so the base problem is well conditioned and the recursions
/// converge. The changes are complex and unsymmetric too (structural damping).
pub fn complex_pencil() -> impl Strategy<Value = ComplexPencil> {
    (3..=6_usize)
        .prop_flat_map(|size| {
            (
                separate_spectrum(size),
                orthogonal(size),
                complex_square(size),
                complex_square(size),
                complex_square(size),
            )
        })
        .prop_map(|(k, q, aerodynamic, stiffness_noise, g_noise)| {
            let size = k.len();
            let root =
                (&q * DMatrix::from_diagonal(&k.map(f64::sqrt)) * q.transpose()).map(Complex::from);
            let stiffness = &q * DMatrix::from_diagonal(&k) * q.transpose();
            let small = |factor: f64| Complex::from(factor);
            ComplexPencil {
                stiffness: 0.5 * (&stiffness + stiffness.transpose()),
                g: eye(size) + aerodynamic * small(0.02),
                // Relative to the stiffness of the modes it acts on, as the change of a structure is.
                stiffness_change: &root * stiffness_noise * &root * small(0.01),
                g_change: g_noise * small(0.01),
            }
        })
}

/// A wing section that bends and twists, with an aileron: three DOF in quasi-steady flow at dynamic pressure `q`.
///
/// Springs in bending, torsion and aileron rotation; masses coupled by static unbalance. The flow's lift, moment
/// and hinge moment follow twist and aileron in phase (stiffness-like, here part of $G$ as in the paper) and lag
/// behind them (the imaginary part), and no force on the twist follows bending: complex and unsymmetric.
pub fn aeroelastic_section(q: f64) -> (DMatrix<f64>, DMatrix<Complex<f64>>) {
    let stiffness = dmatrix![1.0, 0.0, 0.0; 0.0, 1.5, -0.05; 0.0, -0.05, 0.4];
    let mass = dmatrix![1.0, 0.2, 0.05; 0.2, 0.5, 0.06; 0.05, 0.06, 0.04];
    let in_phase = dmatrix![0.1, 1.2, 0.5; 0.0, 0.3, 0.2; 0.0, 0.02, 0.05];
    let lagging = dmatrix![0.8, 0.4, 0.1; -0.2, 0.3, 0.05; 0.0, 0.01, 0.02];
    let g = DMatrix::from_fn(3, 3, |i, j| {
        Complex::new(mass[(i, j)] + q * in_phase[(i, j)], -q * lagging[(i, j)])
    });
    (stiffness, g)
}

pub type Complexes = DMatrix<Complex<f64>>;

pub fn complex(matrix: &DMatrix<f64>) -> Complexes {
    matrix.map(Complex::from)
}

pub fn amax(matrix: &Complexes) -> f64 {
    matrix.iter().map(|value| value.norm()).largest()
}

/// Roots of (Kλ − G)v = 0 by faer's QZ, which shares nothing with the Cholesky route of the library.
pub fn roots_by_qz(stiffness: &Complexes, g: &Complexes) -> Vec<Complex<f64>> {
    let to_faer = |matrix: &Complexes| {
        faer::Mat::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)])
    };
    let eigen = to_faer(g).generalized_eigen(to_faer(stiffness)).unwrap();
    (0..g.nrows())
        .map(|i| eigen.S_a()[i] / eigen.S_b()[i])
        .collect()
}

/// A conjugate-free product of columns, UᵗAV.
pub fn through(left: &Complexes, matrix: &Complexes, right: &Complexes) -> Complexes {
    left.tr_mul(&(matrix * right))
}
