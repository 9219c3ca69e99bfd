//! What the machine does at most in one thread, against which a stage's own rate says what bounds it.

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par};
use std::hint::black_box;
use std::time::Instant;

/// Order of the matrices that are multiplied. The two of them take 16 MB, so that they may lie in a third-level cache, but not nearer.
const ORDER: usize = 1000;
/// How many numbers are read: 256 MiB, eight times the third-level cache of 32 MiB of the machine that `paper/cost.md` tells of.
const NUMBERS: usize = 32 << 20;
const REPEATS: usize = 5;

/// Rates of one thread.
#[derive(Clone, Copy)]
pub struct Machine {
    /// Multiplications and additions a second in a product of dense matrices.
    pub operations: f64,
    /// Bytes read a second in a sum of numbers that lie one after the other.
    pub bytes: f64,
}

impl Machine {
    /// The best of some repeats.
    pub fn measured() -> Self {
        let matrix =
            Mat::<f64>::from_fn(ORDER, ORDER, |row, column| 1.0 / (1 + row + column) as f64);
        let mut product = Mat::<f64>::zeros(ORDER, ORDER);
        let multiply = || {
            matmul(
                product.as_mut(),
                Accum::Replace,
                black_box(matrix.as_ref()),
                matrix.as_ref(),
                1.0,
                Par::Seq,
            );
        };
        let operations = 2.0 * (ORDER as f64).powi(3) / least(multiply);
        let numbers = vec![1.0_f64; NUMBERS];
        let read = || {
            // Eight sums at once, so that no addition waits for the one before it.
            let mut sums = [0.0; 8];
            for eight in black_box(&numbers).chunks_exact(8) {
                sums.iter_mut()
                    .zip(eight)
                    .for_each(|(sum, number)| *sum += number);
            }
            black_box(sums);
        };
        Self {
            operations,
            bytes: 8.0 * NUMBERS as f64 / least(read),
        }
    }
}

/// The least seconds of some repeats.
fn least(mut work: impl FnMut()) -> f64 {
    let mut seconds = || {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    };
    (0..REPEATS)
        .map(|_| seconds())
        .fold(f64::INFINITY, f64::min)
}
