//! How much a factorization stores and computes, by the order of elimination of its plan.

use corfem::method::assembly::ElementMatrix;
use corfem::sparse::factorization::FactorizationPlan;
use faer::Side;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMat, Triplet};

/// How many numbers the factor holds, and how many multiplications and additions it takes in its leading order: the squares of the lengths
/// of its columns.
pub fn of_factor(plan: &FactorizationPlan, elements: &[ElementMatrix]) -> (usize, f64) {
    let count = plan.order.len();
    let mut turn = vec![0; count];
    (plan.order.iter().enumerate()).for_each(|(place, &dof)| turn[dof] = place);
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
    let symbolic = factorize_symbolic_cholesky(
        upper.expect("a matrix").symbolic(),
        Side::Upper,
        SymmetricOrdering::Identity,
        CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..CholeskySymbolicParams::default()
        },
    );
    let symbolic = symbolic.expect("a factor");
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
    (
        symbolic.len_val(),
        lengths.map(|length| length.powi(2)).sum(),
    )
}
