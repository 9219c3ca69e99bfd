//! The eigensolutions that the perturbation replaces: all eigenvalues and eigenvectors of a symmetric matrix.

use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{ComputeEigenvectors, self_adjoint_evd, self_adjoint_evd_scratch};
use faer::{Mat, Par};
use nalgebra::{DMatrix, SMatrix, SymmetricEigen};
use std::hint::black_box;

/// Off-diagonal part, relative to the whole matrix, at which Jacobi's sweeps end.
const JACOBI_TOLERANCE: f64 = 1e-14;
/// Most sweeps; seven or eight are enough for a matrix of nine.
const JACOBI_SWEEPS: usize = 30;

/// Cyclic Jacobi: rotations that zero one off-diagonal pair after the other, row by row, until all are small.
///
/// `matrix` (n × n, symmetric, stored whole) ends diagonal; `vectors` receives the eigenvectors as rows. Returns the
/// number of sweeps. Source: Golub and Van Loan, *Matrix Computations*, section 8.5.
pub fn cyclic_jacobi(matrix: &mut [f64], vectors: &mut [f64], size: usize) -> usize {
    vectors.fill(0.0);
    for i in 0..size {
        vectors[i * size + i] = 1.0;
    }
    let whole: f64 = matrix.iter().map(|entry| entry * entry).sum();
    for sweep in 0..JACOBI_SWEEPS {
        let mut off_diagonal = 0.0;
        for p in 0..size {
            for q in p + 1..size {
                off_diagonal += 2.0 * matrix[p * size + q] * matrix[p * size + q];
            }
        }
        if off_diagonal <= JACOBI_TOLERANCE * JACOBI_TOLERANCE * whole {
            return sweep;
        }
        for p in 0..size {
            for q in p + 1..size {
                rotate(matrix, vectors, size, p, q);
            }
        }
    }
    JACOBI_SWEEPS
}

/// One rotation, zeroing the entries (p, q) and (q, p), p < q.
fn rotate(matrix: &mut [f64], vectors: &mut [f64], size: usize, p: usize, q: usize) {
    let entry = matrix[p * size + q];
    if entry == 0.0 {
        return;
    }
    let (first, second) = (matrix[p * size + p], matrix[q * size + q]);
    let theta = (second - first) / (2.0 * entry);
    let tangent = theta.signum() / (theta.abs() + (1.0 + theta * theta).sqrt());
    let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
    let sine = tangent * cosine;
    turn_rows(matrix, size, p, q, cosine, sine);
    // The columns follow the rows by symmetry.
    for i in 0..size {
        matrix[i * size + p] = matrix[p * size + i];
        matrix[i * size + q] = matrix[q * size + i];
    }
    matrix[p * size + p] = first - tangent * entry;
    matrix[q * size + q] = second + tangent * entry;
    matrix[p * size + q] = 0.0;
    matrix[q * size + p] = 0.0;
    turn_rows(vectors, size, p, q, cosine, sine);
}

fn turn_rows(matrix: &mut [f64], size: usize, p: usize, q: usize, cosine: f64, sine: f64) {
    let (upper, lower) = matrix.split_at_mut(q * size);
    let row_p = &mut upper[p * size..(p + 1) * size];
    for (a, b) in row_p.iter_mut().zip(&mut lower[..size]) {
        (*a, *b) = (cosine * *a - sine * *b, sine * *a + cosine * *b);
    }
}

/// Eigensolutions of many matrices of one size, with all storage made beforehand where the solver allows it.
pub struct Rivals {
    size: usize,
    matrix: Vec<f64>,
    vectors: Vec<f64>,
    faer_values: Diag<f64>,
    faer_vectors: Mat<f64>,
    faer_memory: MemBuffer,
}

/// The paper's problem, where the size is known when compiling.
const NINE: usize = 9;

impl Rivals {
    /// Storage for matrices of a size.
    pub fn new(size: usize) -> Self {
        let scratch = self_adjoint_evd_scratch::<f64>(
            size,
            ComputeEigenvectors::Yes,
            Par::Seq,
            Default::default(),
        );
        Self {
            size,
            matrix: vec![0.0; size * size],
            vectors: vec![0.0; size * size],
            faer_values: Diag::zeros(size),
            faer_vectors: Mat::zeros(size, size),
            faer_memory: MemBuffer::new(scratch),
        }
    }

    /// By cyclic Jacobi.
    pub fn jacobi(&mut self, matrices: &[DMatrix<f64>]) {
        for matrix in matrices {
            self.matrix.copy_from_slice(black_box(matrix).as_slice());
            cyclic_jacobi(&mut self.matrix, &mut self.vectors, self.size);
            black_box((&self.matrix, &self.vectors));
        }
    }

    /// By nalgebra, matrices of any size.
    pub fn nalgebra(&mut self, matrices: &[DMatrix<f64>]) {
        for matrix in matrices {
            black_box(SymmetricEigen::new(black_box(matrix).clone()));
        }
    }

    /// By nalgebra, compiled for nine modes: no allocation.
    pub fn nalgebra_fixed(&mut self, matrices: &[DMatrix<f64>]) {
        for matrix in matrices {
            let fixed = SMatrix::<f64, NINE, NINE>::from_column_slice(black_box(matrix).as_slice());
            black_box(SymmetricEigen::new(fixed));
        }
    }

    /// By faer, with its scratch memory made beforehand.
    pub fn faer(&mut self, matrices: &[DMatrix<f64>]) {
        for matrix in matrices {
            let view = faer::MatRef::from_column_major_slice(
                black_box(matrix).as_slice(),
                self.size,
                self.size,
            );
            self_adjoint_evd(
                view,
                self.faer_values.as_mut(),
                Some(self.faer_vectors.as_mut()),
                Par::Seq,
                MemStack::new(&mut self.faer_memory),
                Default::default(),
            )
            .expect("it converges");
            black_box((&self.faer_values, &self.faer_vectors));
        }
    }

    /// Largest relative difference of Jacobi's eigenvalues from faer's: the rivals solve what they say they solve.
    pub fn disagreement(&mut self, matrix: &DMatrix<f64>) -> f64 {
        self.jacobi(std::slice::from_ref(matrix));
        self.faer(std::slice::from_ref(matrix));
        let mut found: Vec<f64> = (0..self.size)
            .map(|i| self.matrix[i * self.size + i])
            .collect();
        found.sort_by(f64::total_cmp);
        let pairs = found.iter().enumerate();
        pairs
            .map(|(i, value)| (value / self.faer_values[i] - 1.0).abs())
            .fold(0.0, f64::max)
    }
}
