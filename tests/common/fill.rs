//! How much a factorization stores and computes, by its order of elimination.

use corfem::method::appendix_a::ElementMatrix;
use faer::Side;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMat, Triplet};

/// What a factor takes.
#[derive(Clone, Copy, Default)]
pub struct Fill {
    /// How many numbers it stores, with the zeros of its dense blocks.
    pub entries: usize,
    /// How many of them can be other than zero.
    pub needed: usize,
    /// Multiplications and additions that make it, in their leading order: the squares of the lengths of its columns.
    pub operations: f64,
}

/// The fill of a matrix of elements by an order of elimination.
pub fn of_order(order: &[usize], elements: &[ElementMatrix]) -> Fill {
    let count = order.len();
    let mut turn = vec![0; count];
    (order.iter().enumerate()).for_each(|(place, &dof)| turn[dof] = place);
    let coupled = |element: &ElementMatrix| {
        let turns: Vec<usize> = element.dof.iter().map(|&dof| turn[dof]).collect();
        let all = turns
            .iter()
            .flat_map(|&row| turns.iter().map(move |&column| (row, column)));
        all.filter(|(row, column)| row <= column)
            .collect::<Vec<_>>()
    };
    let entries = elements
        .iter()
        .flat_map(coupled)
        .chain((0..count).map(|at| (at, at)));
    let entries: Vec<_> = entries
        .map(|(row, column)| Triplet::new(row, column, 1.0))
        .collect();
    let upper = SparseColMat::<usize, f64>::try_new_from_triplets(count, count, &entries);
    let upper = upper.unwrap();
    let symbolic = |threshold| {
        let parameters = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: threshold,
            ..CholeskySymbolicParams::default()
        };
        let identity = SymmetricOrdering::Identity;
        factorize_symbolic_cholesky(upper.symbolic(), Side::Upper, identity, parameters).unwrap()
    };
    let needed = symbolic(SupernodalThreshold::FORCE_SIMPLICIAL).len_val();
    let symbolic = symbolic(SupernodalThreshold::FORCE_SUPERNODAL);
    let SymbolicCholeskyRaw::Supernodal(blocks) = symbolic.raw() else {
        panic!("supernodes are forced")
    };
    let ends = blocks.supernode_begin().iter().zip(blocks.supernode_end());
    let widths = ends.map(|(begin, end)| end - begin);
    let blocks = widths.zip(blocks.col_ptr_for_val().windows(2));
    let lengths = blocks.flat_map(|(width, at)| {
        let length = (at[1] - at[0]) / width;
        (0..width).map(move |column| (length - column) as f64)
    });
    Fill {
        entries: symbolic.len_val(),
        needed,
        operations: lengths.map(|length| length.powi(2)).sum(),
    }
}
