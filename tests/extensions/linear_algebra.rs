//! Dense decompositions: each against another library or its own definition, and each refusal by name.

use crate::prelude::*;

/// Any size from a single DOF to the box's.
fn size() -> impl Strategy<Value = usize> {
    1..12_usize
}

properties! {
    #[test]
    fn the_cholesky_factor_is_lower_and_multiplies_back(
        (matrix, _) in size().prop_flat_map(|n| positive_definite(n, 8.0)),
    ) {
        let lower = cholesky("test matrix", &matrix, 0.0)?;
        prop_assert_eq!(lower.upper_triangle(), DMatrix::from_diagonal(&lower.diagonal()));
        prop_assert!(lower.diagonal().min() > 0.0);
        prop_assert!(relative_distance(&(&lower * lower.transpose()), &matrix) <= MATRIX_ROUND_OFF);
    }

    #[test]
    fn cholesky_agrees_with_nalgebra((matrix, _) in size().prop_flat_map(|n| positive_definite(n, 2.0))) {
        let lower = cholesky("test matrix", &matrix, 0.0)?;
        let theirs = matrix.cholesky().unwrap().l();
        prop_assert!(relative_distance(&lower, &theirs) <= MATRIX_ROUND_OFF);
    }

    /// The drawn spectrum comes back, to round-off of the largest eigenvalue.
    #[test]
    fn eigenvalues_ascend_and_are_those_drawn(
        (matrix, exponents) in size().prop_flat_map(|n| positive_definite(n, 10.0)),
    ) {
        let (values, vectors) = symmetric_eigen("test matrix", &matrix)?;
        let mut drawn = exponents.iter().map(|e| 10f64.powf(*e)).collect_vec();
        drawn.sort_by(f64::total_cmp);
        let largest = drawn[drawn.len() - 1];
        prop_assert_eq!(values.len(), drawn.len());
        for (found, drawn) in values.iter().zip(&drawn) {
            prop_assert!((found - drawn).abs() <= MATRIX_ROUND_OFF * largest);
        }
        prop_assert_eq!(vectors.shape(), matrix.shape());
        let identity = eye(matrix.nrows());
        prop_assert!(relative_distance(&vectors.tr_mul(&vectors), &identity) <= MATRIX_ROUND_OFF);
        let restored = &vectors * DMatrix::from_diagonal(&values) * vectors.transpose();
        prop_assert!(relative_distance(&restored, &matrix) <= MATRIX_ROUND_OFF);
    }

    #[test]
    fn eigenvalues_agree_with_nalgebra(matrix in size().prop_flat_map(symmetric)) {
        let (values, _) = symmetric_eigen("test matrix", &matrix)?;
        let mut theirs = matrix.symmetric_eigenvalues().iter().copied().collect_vec();
        theirs.sort_by(f64::total_cmp);
        for (ours, theirs) in values.iter().zip(theirs) {
            prop_assert!((ours - theirs).abs() <= MATRIX_ROUND_OFF);
        }
    }

    #[test]
    fn the_symmetric_part_drops_the_skew_one(
        (matrix, other) in size().prop_flat_map(|n| (symmetric(n), orthogonal(n))),
    ) {
        let skew = &other - other.transpose();
        let found = symmetric_part(&(&matrix + skew));
        prop_assert_eq!(found.shape(), matrix.shape());
        prop_assert!((found - &matrix).amax() <= MATRIX_ROUND_OFF);
    }

    /// The first leading block that is not positive definite is named by its last row, wherever it ends.
    #[test]
    fn an_indefinite_matrix_is_refused_by_its_first_bad_row(
        ((mut matrix, _), dof) in (2..40_usize).prop_flat_map(|n| (positive_definite(n, 2.0), 0..n)),
    ) {
        // Take away what the rows before leave of the diagonal entry, and as much again.
        let left = matrix.view((0, 0), (dof + 1, dof + 1)).into_owned().cholesky().unwrap().l()[(dof, dof)].powi(2);
        matrix[(dof, dof)] -= 2.0 * left;
        let refused = cholesky("test matrix", &matrix, 0.0);
        prop_assert_eq!(said(refused), not_definite("test matrix", dof));
    }

    /// A pivot that is too small hides behind the factorization's own failure at a later one; the first is named.
    #[test]
    fn of_two_bad_pivots_the_first_is_named((size, first, later) in (3..12_usize).prop_flat_map(|n| {
        (Just(n), 1..n - 1).prop_flat_map(|(n, first)| (Just(n), Just(first), first + 1..n))
    })) {
        let mut matrix = eye(size);
        matrix[(first, 0)] = 1.0 - 1e-9;
        matrix[(0, first)] = 1.0 - 1e-9;
        matrix[(later, later)] = -1.0;
        prop_assert_eq!(said(cholesky("test matrix", &matrix, 1e-8)), not_definite("test matrix", first));
        prop_assert_eq!(said(cholesky("test matrix", &matrix, 1e-10)), not_definite("test matrix", later));
    }

    /// Two rows of a diagonal matrix coupled so that the second's pivot is `ratio` of its diagonal entry.
    #[test]
    fn a_pivot_below_the_stated_part_of_its_diagonal_is_refused(
        (size, dof) in (2..12_usize).prop_flat_map(|n| (Just(n), 1..n)),
        decades in 1.0..6.0_f64,
        scale in -3.0..3.0_f64,
    ) {
        let (ratio, scale) = (10f64.powf(-decades), 10f64.powf(scale));
        let mut matrix = eye(size);
        matrix[(dof, dof)] = scale * scale;
        matrix[(dof, dof - 1)] = scale * (1.0 - ratio).sqrt();
        matrix[(dof - 1, dof)] = matrix[(dof, dof - 1)];
        let margin = CONDITIONED_ROUND_OFF / ratio;
        prop_assert!(cholesky("test matrix", &matrix, ratio * (1.0 - margin)).is_ok());
        prop_assert_eq!(said(cholesky("test matrix", &matrix, ratio * (1.0 + margin))), not_definite("test matrix", dof));
    }
}

#[test]
fn a_number_that_is_not_finite_is_refused_by_its_place() {
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let words = |row: usize, column: usize| {
            format!("test matrix of entry ({row}, {column}) is {value}; it must be a finite number")
        };
        let mut matrix = DMatrix::zeros(3, 4);
        matrix[(1, 2)] = value;
        assert_eq!(said(check_finite("test matrix", &matrix)), words(1, 2));
        // Of a complex number the part is named.
        let complex = matrix.map(|entry| Complex::new(1.0, entry));
        assert_eq!(said(check_finite("test matrix", &complex)), words(1, 2));
        let mut square = eye(3);
        square[(2, 1)] = value;
        for refused in [
            said(check_symmetric("test matrix", &square)),
            said(cholesky("test matrix", &square, 0.0)),
            said(symmetric_eigen("test matrix", &square)),
        ] {
            assert_eq!(refused, words(2, 1));
        }
    }
    assert!(check_finite("test matrix", &DMatrix::<f64>::zeros(3, 4)).is_ok());
}

#[test]
fn another_shape_is_refused_with_both() {
    let matrix = DMatrix::zeros(3, 4);
    assert!(check_shape("test matrix", &matrix, 3, 4).is_ok());
    for (rows, columns) in [(4, 4), (3, 3), (4, 3)] {
        assert_eq!(
            said(check_shape("test matrix", &matrix, rows, columns)),
            format!("test matrix: 3 x 4 instead of {rows} x {columns}")
        );
    }
    for refused in [
        said(check_symmetric("test matrix", &matrix)),
        said(cholesky("test matrix", &matrix, 0.0)),
        said(symmetric_eigen("test matrix", &matrix)),
    ] {
        assert_eq!(refused, "test matrix: 3 x 4 instead of 3 x 3");
    }
    assert_eq!(
        said(symmetric_eigen("test matrix", &zero_square(0))),
        "test matrix: 0 given or asked for; there must be at least 1"
    );
}

#[test]
fn asymmetry_beyond_a_part_in_ten_to_the_eighth_is_refused_by_its_size() {
    let skewed = |by: f64| {
        let mut matrix =
            DMatrix::from_fn(4, 4, |row, column| if row == column { 100.0 } else { 1.0 });
        matrix[(3, 1)] += by;
        matrix[(0, 2)] -= 0.1 * by;
        matrix
    };
    assert!(check_symmetric("test matrix", &skewed(0.0)).is_ok());
    assert!(check_symmetric("test matrix", &skewed(0.9e-6)).is_ok());
    for by in [1.1e-6, -1.1e-6, 2.0] {
        let refused = check_symmetric("test matrix", &skewed(by));
        assert!(
            matches!(&refused, Err(Error::Value { what: "relative asymmetry", owner, value, expected: "at most 1e-8" })
                if owner == "test matrix" && (value * 100.0 / by.abs() - 1.0).abs() <= DIFFERENCE_ROUND_OFF),
            "{refused:?}"
        );
    }
}

#[test]
fn eigenvalues_of_very_large_and_small_matrices_scale() {
    // Large matrices are divided before they are solved.
    for (size, power) in [4, 100]
        .into_iter()
        .flat_map(|size| [-300, -200, 200, 300].map(|power| (size, power)))
    {
        let matrix = DMatrix::from_fn(size, size, |i, j| 1.0 / (1 + i + j) as f64);
        let (expected, _) = symmetric_eigen("test matrix", &matrix).unwrap();
        let scale = 10_f64.powi(power);
        let (found, shapes) = symmetric_eigen("test matrix", &(&matrix * scale)).unwrap();
        assert!(
            (found / scale - &expected).amax() <= MATRIX_ROUND_OFF,
            "{size}, {power}"
        );
        assert!(
            (shapes.tr_mul(&shapes) - eye(size)).amax() <= MATRIX_ROUND_OFF,
            "{size}, {power}"
        );
    }
}
