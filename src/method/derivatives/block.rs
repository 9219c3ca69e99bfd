//! First order for a block of parameters side by side.

use super::HELD_SEPARATION;
use super::lanes::{LANES, Lanes, ZERO, combinations_into, lanes};
use crate::method::error::Error;
use crate::method::modal::{ModalProblem, Share};
use nalgebra::{DMatrix, DVector};
use std::cmp::Reverse;

/// Parameters that are changed side by side, and their generalized shares as rank-one terms.
///
/// An element's share has a low rank (a shear panel's one, a flat membrane's five), so that
/// $V^t K_e V = \sum_t s_t f_t f_t^t$ has few terms.
#[derive(Debug, Clone)]
pub(super) struct Block {
    /// The parameters, one a lane; lanes beyond them change nothing.
    pub parameters: Vec<usize>,
    /// Whether they change the mass, and not the stiffness.
    pub is_mass: bool,
    /// The vectors $f_t$, one after the other (terms × n).
    vectors: Vec<Lanes>,
    /// The signs $s_t$; zero for a parameter that has fewer terms than its block.
    signs: Vec<Lanes>,
}

impl Block {
    /// All parameters of a problem, in blocks of one kind and of like rank.
    pub fn all(problem: &ModalProblem) -> Vec<Self> {
        let mut blocks = Vec::new();
        for is_mass in [false, true] {
            let of_kind =
                |&e: &usize| matches!(problem.generalized_shares[e], Share::Mass(_)) == is_mass;
            let mut parameters: Vec<usize> =
                (0..problem.parameter_count()).filter(of_kind).collect();
            parameters.sort_by_key(|&e| Reverse(problem.share_terms[e].signs.len()));
            let chunks = parameters.chunks(LANES);
            blocks.extend(chunks.map(|chunk| Self::new(problem, chunk, is_mass)));
        }
        blocks
    }

    fn new(problem: &ModalProblem, parameters: &[usize], is_mass: bool) -> Self {
        let terms = |e: usize| &problem.share_terms[e];
        let ranks = parameters.iter().map(|&e| terms(e).signs.len());
        let most = ranks.max().unwrap_or(0);
        let count = problem.start.len();
        let mut vectors = vec![ZERO; most * count];
        let mut signs = vec![ZERO; most];
        for (lane, &e) in parameters.iter().enumerate() {
            for (t, &sign) in terms(e).signs.iter().enumerate() {
                signs[t][lane] = sign;
                for i in 0..count {
                    vectors[t * count + i][lane] = terms(e).vectors[(i, t)];
                }
            }
        }
        Self {
            parameters: parameters.to_vec(),
            is_mass,
            vectors,
            signs,
        }
    }

    /// The change $h p^t (V^t K_e V) p$ of every parameter, its lower triangle column by column (n × n), for present
    /// shapes $p$ in terms of the start's and relative changes $h$. `vector` is storage for n numbers.
    #[inline(always)]
    pub fn change_into(
        &self,
        present: &DMatrix<f64>,
        relative_change: &Lanes,
        vector: &mut [Lanes],
        change: &mut [Lanes],
    ) {
        let count = vector.len();
        change.fill(ZERO);
        for (start, sign) in self.vectors.chunks_exact(count).zip(&self.signs) {
            // Columns of p are stored one after the other, as rows of its transpose: this is pᵗ f.
            combinations_into(present.as_slice(), start, vector);
            for (j, column) in change.chunks_exact_mut(count).enumerate() {
                let weighted = lanes(|l| relative_change[l] * sign[l] * vector[j][l]);
                for (sum, entry) in column[j..].iter_mut().zip(&vector[j..]) {
                    *sum = lanes(|l| sum[l] + weighted[l] * entry[l]);
                }
            }
        }
    }

    /// First order (C.20, C.21) for every parameter: $x$ and the generalized shapes $p$ (n × n, column by column).
    ///
    /// A change of stiffness has $x_i = \omega_i^2 = k_{ii} + \beta_{ii}$, one of mass $x_i = 1/\omega_i^2 = (1+\alpha_{ii})/k_{ii}$.
    /// Both halves of a pair of modes follow from one division: with $q = \beta_{ij}/(x_i - x_j)$ they are $p_{ij} = -q$ and
    /// $p_{ji} = q$, and for a mass, with $\alpha$ in place of $\beta$, $p_{ij} = -q/k_{ii}$ and $p_{ji} = q/k_{jj}$.
    ///
    /// Two modes closer than [`HELD_SEPARATION`] are held to their own shapes, $p_{ij} = p_{ji} = 0$, as in
    /// [`crate::method::appendix_c::first_order_held`].
    ///
    /// # Errors
    /// [`Error::LostRoot`].
    #[inline(always)]
    pub fn first_order_into(
        &self,
        k: &DVector<f64>,
        change: &[Lanes],
        x: &mut [Lanes],
        shapes: &mut [Lanes],
    ) -> Result<(), Error> {
        let count = k.len();
        for (i, x) in x.iter_mut().enumerate() {
            let own = &change[i * count + i];
            *x = if self.is_mass {
                lanes(|l| (1.0 + own[l]) / k[i])
            } else {
                lanes(|l| k[i] + own[l])
            };
        }
        self.check_roots(x)?;
        let scale = |i: usize| if self.is_mass { 1.0 / k[i] } else { 1.0 };
        for j in 0..count {
            shapes[j * count + j] = [1.0; LANES];
            for i in j + 1..count {
                let (a, b, entry) = (&x[i], &x[j], &change[j * count + i]);
                let q = lanes(|l| {
                    let difference = a[l] - b[l];
                    let is_held = difference.abs() < HELD_SEPARATION * larger(a[l], b[l]);
                    let q = entry[l] / difference;
                    if is_held { 0.0 } else { q }
                });
                shapes[j * count + i] = lanes(|l| -q[l] * scale(i));
                shapes[i * count + j] = lanes(|l| q[l] * scale(j));
            }
        }
        Ok(())
    }

    /// Refuses roots that a change made negative, or too large for a number.
    #[inline(always)]
    fn check_roots(&self, x: &[Lanes]) -> Result<(), Error> {
        if x.iter().flatten().all(|&x| is_root(x)) {
            Ok(())
        } else {
            Err(self.lost_root(x))
        }
    }

    #[cold]
    fn lost_root(&self, x: &[Lanes]) -> Error {
        let values = x.iter().enumerate();
        let mut entries = values.flat_map(|(mode, values)| values.map(|value| (mode, value)));
        let (mode, value) = entries
            .find(|&(_, value)| !is_root(value))
            .unwrap_or((0, f64::NAN));
        let value = if self.is_mass { value } else { 1.0 / value };
        Error::LostRoot { mode, value }
    }
}

/// The larger of two numbers, neither of them NaN.
#[inline(always)]
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

fn is_root(x: f64) -> bool {
    x > 0.0 && x.is_finite()
}
