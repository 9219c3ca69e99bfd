//! The rows of Appendix C as the paper has them, entry by entry, on exact series or numbers: for stiffness alone (7, 8, C.20 to
//! C.24) and in full (C.14 to C.19).
//!
//! Row $i$ of mode $j$ is $k_i(\gamma - \lambda_i) p_i + \sum_s (\beta_{is}\gamma - \alpha_{is}) p_s = 0$.

use super::rational_series::{Found, IntegerPencil, Matrix, Series, rational};
use num_rational::BigRational;

/// Generalized stiffnesses $k$ and changes $\beta$, $\alpha$, as series of as many terms as one likes.
#[derive(Debug, Clone)]
pub struct Change {
    pub k: Vec<Series>,
    pub beta: Matrix,
    pub alpha: Matrix,
}

impl Change {
    /// $\beta = tB$ and $\alpha = tA$ as series in $t$.
    pub fn series(pencil: &IntegerPencil, terms: usize) -> Self {
        let linear = |matrix: &[Vec<i64>]| {
            matrix
                .iter()
                .map(|row| {
                    row.iter()
                        .map(|&entry| Series::linear(entry, terms))
                        .collect()
                })
                .collect()
        };
        let k = pencil
            .k
            .iter()
            .map(|&k| Series::integer(k, terms))
            .collect();
        Self {
            k,
            beta: linear(&pencil.b),
            alpha: linear(&pencil.a),
        }
    }

    /// The same at one $t$, as numbers.
    pub fn at(pencil: &IntegerPencil, t: &BigRational) -> Self {
        let scaled = |matrix: &[Vec<i64>]| {
            let entry = |&entry: &i64| Series(vec![rational(entry) * t]);
            matrix
                .iter()
                .map(|row| row.iter().map(entry).collect())
                .collect()
        };
        let k = pencil.k.iter().map(|&k| Series::integer(k, 1)).collect();
        Self {
            k,
            beta: scaled(&pencil.b),
            alpha: scaled(&pencil.a),
        }
    }

    fn size(&self) -> usize {
        self.k.len()
    }

    fn number(&self, value: i64) -> Series {
        Series::integer(value, self.k[0].0.len())
    }

    fn lambda(&self, i: usize) -> Series {
        &self.number(1) / &self.k[i]
    }

    /// Rows of what an entry function says, one on the diagonal.
    fn shapes(&self, entry: impl Fn(usize, usize) -> Series) -> Matrix {
        let of = |i: usize, j: usize| if i == j { self.number(1) } else { entry(i, j) };
        (0..self.size())
            .map(|i| (0..self.size()).map(|j| of(i, j)).collect())
            .collect()
    }

    /// The sum over all $s$ but those left out; zero stands for an empty one.
    fn sum(&self, but: [usize; 2], term: impl Fn(usize) -> Series) -> Series {
        let terms = (0..self.size()).filter(|s| !but.contains(s)).map(term);
        Series::sum(std::iter::once(self.number(0)).chain(terms))
    }

    /// First order (C.20, C.21) for stiffness alone.
    pub fn first_order(&self) -> Found {
        let own = |i: usize| self.k[i].clone() + self.beta[i][i].clone();
        let root = |i: usize| self.lambda(i) - &(&self.lambda(i) * &self.beta[i][i]) / &own(i);
        let roots: Vec<Series> = (0..self.size()).map(root).collect();
        let shapes = self.shapes(|i, j| {
            let denominator = own(i) - &self.number(1) / &roots[j];
            self.number(0) - &self.beta[i][j] / &denominator
        });
        Found { roots, shapes }
    }

    /// Recursive 1 (7, 8, C.22) for stiffness alone, order by order from the first.
    pub fn recursive_1(&self) -> impl Iterator<Item = Found> {
        orders(self.first_order(), |before| {
            let own = |i: usize| self.k[i].clone() + self.beta[i][i].clone();
            let root = |i: usize| {
                let sum = self.sum([i, i], |j| &self.beta[i][j] * &before.shapes[j][i]);
                let above = &self.beta[i][i] * &self.lambda(i) + &before.roots[i] * &sum;
                self.lambda(i) - &above / &own(i)
            };
            let shapes = self.shapes(|i, j| {
                let sum = self.sum([i, j], |s| &self.beta[i][s] * &before.shapes[s][j]);
                let denominator = own(i) - &self.number(1) / &before.roots[j];
                self.number(0) - &(self.beta[i][j].clone() + sum) / &denominator
            });
            Found {
                roots: (0..self.size()).map(root).collect(),
                shapes,
            }
        })
    }

    /// The explicit root $\Delta\lambda_i = -\lambda_i S_i/(k_{ii} + S_i)$, $S_i = \sum_j \beta_{ij} p_{ji}$ (C.24).
    fn explicit_roots(&self, shapes: &Matrix) -> Vec<Series> {
        let root = |i: usize| {
            let sum = Series::sum((0..self.size()).map(|j| &self.beta[i][j] * &shapes[j][i]));
            self.lambda(i) - &(&self.lambda(i) * &sum) / &(self.k[i].clone() + sum)
        };
        (0..self.size()).map(root).collect()
    }

    /// The formulae of 1947 for stiffness alone: first order, then the root once more.
    pub fn original(&self) -> Found {
        let Found { shapes, .. } = self.first_order();
        Found {
            roots: self.explicit_roots(&shapes),
            shapes,
        }
    }

    /// Recursive 2 (C.24) for stiffness alone, order by order.
    pub fn recursive_2(&self) -> impl Iterator<Item = Found> {
        orders(self.first_order(), |before| {
            let roots = self.explicit_roots(&before.shapes);
            let shapes = self.solved_shapes(&roots);
            Found { roots, shapes }
        })
    }

    /// $k_i(\gamma - \lambda_i) + \beta_{ii}\gamma - \alpha_{ii}$, or off the diagonal $\beta_{is}\gamma - \alpha_{is}$.
    fn row(&self, i: usize, s: usize, gamma: &Series) -> Series {
        let change = &self.beta[i][s] * gamma - self.alpha[i][s].clone();
        if i == s {
            &self.k[i] * &(gamma.clone() - self.lambda(i)) + change
        } else {
            change
        }
    }

    /// Every shape from all rows but its own, by Gauss's elimination.
    fn solved_shapes(&self, roots: &[Series]) -> Matrix {
        let columns: Vec<Vec<Series>> = (0..self.size())
            .map(|j| {
                let others: Vec<usize> = (0..self.size()).filter(|&i| i != j).collect();
                let row = |&i: &usize| {
                    let left = others.iter().map(|&s| self.row(i, s, &roots[j]));
                    left.chain([self.number(0) - self.row(i, j, &roots[j])])
                        .collect()
                };
                let mut solution = solved(others.iter().map(row).collect());
                solution.insert(j, self.number(1));
                solution
            })
            .collect();
        (0..self.size())
            .map(|i| columns.iter().map(|column| column[i].clone()).collect())
            .collect()
    }

    /// Recursive 1 in full (C.22 with $\alpha$), order by order, from shapes before the change and Rayleigh's quotients on them.
    pub fn general_recursive_1(&self) -> impl Iterator<Item = Found> {
        let own = move |i: usize| self.k[i].clone() + self.beta[i][i].clone();
        let unchanged = move |i: usize| &self.k[i] * &self.lambda(i) + self.alpha[i][i].clone();
        let start = Found {
            roots: (0..self.size()).map(|i| &unchanged(i) / &own(i)).collect(),
            shapes: self.shapes(|_, _| self.number(0)),
        };
        let next = move |before: &Found| {
            let sum = |i: usize, j: usize| {
                self.sum([i, i], |s| {
                    &self.row(i, s, &before.roots[j]) * &before.shapes[s][j]
                })
            };
            let shapes =
                self.shapes(|i, j| self.number(0) - &sum(i, j) / &self.row(i, i, &before.roots[j]));
            Found {
                roots: (0..self.size())
                    .map(|j| &(unchanged(j) - sum(j, j)) / &own(j))
                    .collect(),
                shapes,
            }
        };
        orders(next(&start), next)
    }

    fn general_explicit_roots(&self, shapes: &Matrix) -> Vec<Series> {
        let root = |i: usize| {
            let of = |matrix: &Matrix| {
                Series::sum((0..self.size()).map(|j| &matrix[i][j] * &shapes[j][i]))
            };
            &(&self.k[i] * &self.lambda(i) + of(&self.alpha))
                / &(self.k[i].clone() + of(&self.beta))
        };
        (0..self.size()).map(root).collect()
    }

    /// The formulae of 1947 in full.
    pub fn general_original(&self) -> Found {
        let Found { shapes, .. } = self.general_first_order();
        Found {
            roots: self.general_explicit_roots(&shapes),
            shapes,
        }
    }

    /// First order in full.
    pub fn general_first_order(&self) -> Found {
        self.general_recursive_1().next().expect("an order")
    }

    /// Recursive 2 in full, order by order.
    pub fn general_recursive_2(&self) -> impl Iterator<Item = Found> {
        orders(self.general_first_order(), |before| {
            let roots = self.general_explicit_roots(&before.shapes);
            let shapes = self.solved_shapes(&roots);
            Found { roots, shapes }
        })
    }
}

/// Order one and those that follow from it.
fn orders(first: Found, next: impl Fn(&Found) -> Found) -> impl Iterator<Item = Found> {
    std::iter::successors(Some(first), move |before| Some(next(before)))
}

/// The solution of linear equations, each row with its right side last. Pivots are the diagonal as it comes: in these rows
/// $k_i(\gamma_j - \lambda_i)$ and what a small change adds.
fn solved(mut rows: Matrix) -> Vec<Series> {
    let size = rows.len();
    for pivot in 0..size {
        let scale = rows[pivot][pivot].clone();
        rows[pivot]
            .iter_mut()
            .for_each(|entry| *entry = &*entry / &scale);
        let pivot_row = rows[pivot].clone();
        for row in (0..size).filter(|&row| row != pivot) {
            let factor = rows[row][pivot].clone();
            for (entry, own) in rows[row].iter_mut().zip(&pivot_row).skip(pivot) {
                *entry = entry.clone() - &factor * own;
            }
        }
    }
    rows.into_iter().map(|mut row| row.remove(size)).collect()
}
