//! A symmetric matrix as a sum of rank-one terms, as few as its rank.

use crate::common::strategies::{orthogonal, symmetric};
use crate::common::tolerances::MATRIX_ROUND_OFF;
use corfem::method::error::Error;
use corfem::method::linear_algebra::{RankOneTerms, rank_one_terms};
use nalgebra::{DMatrix, DVector, dmatrix};
use proptest::prelude::*;

const SIZE: usize = 7;

fn sum(terms: &RankOneTerms) -> DMatrix<f64> {
    assert_eq!(terms.vectors.ncols(), terms.signs.len());
    let signs = DMatrix::from_diagonal(&DVector::from_column_slice(&terms.signs));
    &terms.vectors * signs * terms.vectors.transpose()
}

/// Q·diag·Qᵗ with as many eigenvalues as given, from 0.1 to 10 in magnitude: a rank that no rounding can blur.
fn of_rank(positive_only: bool) -> impl Strategy<Value = (DMatrix<f64>, Vec<f64>)> {
    let magnitude = 0.1..10.0_f64;
    let eigenvalue = (magnitude, any::<bool>()).prop_map(move |(size, negative)| {
        if negative && !positive_only {
            -size
        } else {
            size
        }
    });
    (
        orthogonal(SIZE),
        prop::collection::vec(eigenvalue, 0..=SIZE),
    )
        .prop_map(|(q, values)| {
            let mut diagonal = DVector::zeros(SIZE);
            diagonal.rows_mut(0, values.len()).copy_from_slice(&values);
            let matrix = &q * DMatrix::from_diagonal(&diagonal) * q.transpose();
            (0.5 * (&matrix + matrix.transpose()), values)
        })
}

proptest! {
    #![proptest_config(crate::common::config())]

    #[test]
    fn a_semidefinite_matrix_has_as_many_terms_as_its_rank((matrix, values) in of_rank(true)) {
        let terms = rank_one_terms("matrix", &matrix).unwrap();
        prop_assert_eq!(terms.vectors.nrows(), SIZE);
        prop_assert_eq!(terms.signs.len(), values.len());
        prop_assert!(terms.signs.iter().all(|&sign| sign == 1.0));
        prop_assert!((sum(&terms) - &matrix).amax() <= MATRIX_ROUND_OFF * matrix.amax());
    }

    #[test]
    fn an_indefinite_matrix_has_terms_of_both_signs((matrix, values) in of_rank(false)) {
        let terms = rank_one_terms("matrix", &matrix).unwrap();
        prop_assert_eq!(terms.signs.len(), values.len());
        let negative = terms.signs.iter().filter(|&&sign| sign == -1.0).count();
        // Sylvester's law of inertia.
        prop_assert_eq!(negative, values.iter().filter(|&&value| value < 0.0).count());
        prop_assert!((sum(&terms) - &matrix).amax() <= MATRIX_ROUND_OFF * matrix.amax());
    }

    #[test]
    fn any_symmetric_matrix_is_the_sum_of_its_terms(matrix in symmetric(SIZE)) {
        let terms = rank_one_terms("matrix", &matrix).unwrap();
        prop_assert!(terms.signs.len() <= SIZE);
        prop_assert!((sum(&terms) - &matrix).amax() <= MATRIX_ROUND_OFF * matrix.amax());
    }
}

#[test]
fn pivots_and_signs_by_hand() {
    let terms = rank_one_terms("matrix", &dmatrix![1.0, 2.0; 2.0, 4.0]).unwrap();
    assert_eq!(terms.vectors, dmatrix![1.0; 2.0]);
    assert_eq!(terms.signs, [1.0]);
    // No diagonal to pivot on: by eigenvectors, of eigenvalues −1 and 1.
    let terms = rank_one_terms("matrix", &dmatrix![0.0, 1.0; 1.0, 0.0]).unwrap();
    assert_eq!(terms.signs, [-1.0, 1.0]);
    let terms = rank_one_terms("matrix", &DMatrix::zeros(3, 3)).unwrap();
    assert_eq!((terms.vectors.shape(), terms.signs.len()), ((3, 0), 0));
}

#[test]
fn a_matrix_that_is_not_symmetric_is_named() {
    match rank_one_terms("share", &dmatrix![1.0, 1.0; 0.0, 1.0]) {
        Err(Error::NotSymmetric {
            what, row, column, ..
        }) => {
            assert_eq!((what, row, column), ("share", 1, 0));
        }
        other => panic!("{other:?}"),
    }
}
