//! Real shapes in place of complex ones, and modal phase collinearity.

use crate::prelude::*;
use test_data::complex_modes::realize;

fn shape(count: usize) -> impl Strategy<Value = DMatrix<Complex<f64>>> {
    prop::collection::vec((-1.0..1.0_f64, -1.0..1.0_f64), count)
        .prop_filter("a shape that is not zero", |parts| {
            parts.iter().any(|(re, im)| re.hypot(*im) > 0.1)
        })
        .prop_map(move |parts| {
            DMatrix::from_iterator(
                count,
                1,
                parts.into_iter().map(|(re, im)| Complex::new(re, im)),
            )
        })
}

/// A factor of any phase, up to a million in size and down to a millionth.
fn factor() -> impl Strategy<Value = Complex<f64>> {
    (-6.0..6.0_f64, -4.0..4.0_f64)
        .prop_map(|(decade, angle)| Complex::from_polar(10_f64.powf(decade), angle))
}

properties! {
    #[test]
    fn a_real_mode_times_any_complex_number_is_collinear_and_comes_back(
        mode in prop::collection::vec(-1.0..1.0_f64, 5).prop_filter("not zero", |mode| mode.iter().any(|x| x.abs() > 0.1)),
        factor in factor(),
    ) {
        let mode = DMatrix::from_vec(5, 1, mode);
        let (real, collinearity) = realize(&mode.map(|x| factor * x))?;
        prop_assert!((collinearity[0] - 1.0).abs() < ROUND_OFF);
        let same = (&real / factor.norm() - &mode).amax().min((&real / factor.norm() + &mode).amax());
        prop_assert!(same < ROUND_OFF, "{}", same);
    }

    #[test]
    fn a_complex_factor_changes_neither_real_shape_nor_collinearity(shape in shape(4), factor in factor()) {
        let (real, collinearity) = realize(&shape)?;
        let (turned, turned_collinearity) = realize(&shape.map(|v| factor * v))?;
        prop_assert!((collinearity[0] - turned_collinearity[0]).abs() < MATRIX_ROUND_OFF);
        // Where all phases do nearly as well, round-off turns the shape by its size over the difference.
        let slack = MATRIX_ROUND_OFF / collinearity[0].sqrt().max(MATRIX_ROUND_OFF);
        let turned = turned / factor.norm();
        let same = (&turned - &real).amax().min((&turned + &real).amax());
        prop_assert!(same <= slack, "{} beside {}", same, slack);
    }

    #[test]
    fn collinearity_is_within_zero_and_one_and_no_phase_has_a_larger_real_part(shape in shape(4), angle in -4.0..4.0_f64) {
        let (real, collinearity) = realize(&shape)?;
        prop_assert!((0.0..=1.0).contains(&collinearity[0]));
        let other = shape.map(|v| (v * Complex::from_polar(1.0, angle)).re);
        prop_assert!(real.norm() >= other.norm() * (1.0 - ROUND_OFF));
        // The eigenvalues of the 2 x 2 matrix are the squares of the two parts, from which MPC follows by its definition.
        let (first, sum) = (real.norm_squared(), shape.map(Complex::norm).norm_squared());
        prop_assert!((((2.0 * first - sum) / sum).powi(2) - collinearity[0]).abs() < ROUND_OFF);
    }
}

#[test]
fn a_wave_that_runs_round_has_no_collinearity_and_a_shape_all_the_same() {
    let wave = DMatrix::from_fn(8, 1, |row, _| {
        Complex::from_polar(1.0, 0.25 * PI * row as f64)
    });
    let (real, collinearity) = realize(&wave).unwrap();
    assert!(collinearity[0] < ROUND_OFF);
    assert_within(real.norm_squared(), 4.0, ROUND_OFF);
}

#[test]
fn numbers_whose_squares_leave_the_range_are_as_good_as_others() {
    let shape = dmatrix![Complex::new(3.0, 4.0); Complex::new(-6.0, -8.0)];
    for unit in [1e-290, 1e290] {
        let (real, collinearity) = realize(&shape.map(|v| v * unit)).unwrap();
        assert_within(collinearity[0], 1.0, ROUND_OFF);
        assert!((real / unit - dmatrix![-5.0; 10.0]).amax() < ROUND_OFF * 10.0);
    }
}

#[test]
fn shapes_that_are_none_are_refused() {
    for (part, words) in [
        (
            0.0,
            "largest component of complex mode 0 (from zero) is 0; it must be positive and finite",
        ),
        (f64::NAN, "it must be a finite number"),
    ] {
        let refused = said(realize(&DMatrix::from_element(
            2,
            1,
            Complex::new(part, part),
        )));
        assert!(refused.ends_with(words), "{refused}");
    }
}
