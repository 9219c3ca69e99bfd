//! Real numbers in the fields of a deck.

use crate::common::decks::field_number;
use crate::prelude::*;
use corfem::files::deck::number::{exact_real, parse_real};

#[test]
fn reals_read_as_nastran_reads_them() {
    for (text, value) in [
        ("1.+7", 1.0e7),
        ("-.5-3", -0.5e-3),
        (".010", 0.010),
        ("2.5E-3", 2.5e-3),
        ("1.0D+4", 1.0e4),
        ("1.0d4", 1.0e4),
        ("+1.5e2", 150.0),
        ("10.4  +6", 1.04e7),
        ("0.", 0.0),
        ("-12.", -12.0),
        ("1.-300", 1e-300),
    ] {
        assert_eq!(parse_real(text), Some(value), "{text}");
    }
    for text in [
        "", ".", "-", "1", "1+7", "1E7", "1.E", "1.+", "1.2.3", "--1.", "1.-+2", "E5", ".E5",
        "1.X", "x1.", "NAN", "INF", "1.+999", "1.+7X",
    ] {
        assert_eq!(parse_real(text), None, "{text}");
    }
}

#[test]
fn reals_are_written_short() {
    for (value, text) in [
        (0.0, "0."),
        (-0.0, "-0."),
        (1.0, "1."),
        (-16.0, "-16."),
        (0.01, ".01"),
        (10.107, "10.107"),
        (1e7, "1.+7"),
        (1.04e7, "1.04+7"),
        (-5e-4, "-5.-4"),
        (0.3339, ".3339"),
        (120.0, "120."),
        (1.5e-5, "1.5-5"),
        // The point in front saves a digit of the exponent, the point behind too.
        (1.25e-10, ".125-9"),
        (1.25e11, "125.+9"),
        (2e100, "2.+100"),
    ] {
        assert_eq!(exact_real(value, 8).as_deref(), Some(text), "{value}");
        assert_eq!(large_real(value).as_deref(), Some(text), "{value}");
    }
    assert_eq!(exact_real(1.2345678, 8), None, "nine characters");
    assert_eq!(exact_real(1.234567, 8).as_deref(), Some("1.234567"));
    assert_eq!(large_real(1.0 / 3.0).as_deref(), Some(".333333333333333"));
    assert_eq!(large_real(-2.0 / 3.0).as_deref(), Some("-.66666666666667"));
    assert_eq!(
        large_real(-1.0 / 3.0e-200).as_deref(),
        Some("-3.333333333+199")
    );
    assert_eq!(large_real(f64::NAN), None);
    assert_eq!(large_real(f64::INFINITY), None);
    assert!(nearest_in_field(f64::NAN).is_nan());
}

properties! {
    #[test]
    fn every_number_reads_back_exactly_if_its_field_is_wide_enough(bits in any::<u64>()) {
        let value = f64::from_bits(bits);
        prop_assume!(value.is_finite());
        let text = exact_real(value, 30).unwrap();
        prop_assert_eq!(parse_real(&text), Some(value));
        prop_assert_eq!(exact_real(value, text.len()), Some(text.clone()));
        prop_assert_eq!(exact_real(value, text.len() - 1), None);
    }

    #[test]
    fn a_large_field_keeps_ten_digits_of_any_number(bits in any::<u64>()) {
        let value = f64::from_bits(bits);
        prop_assume!(value.is_normal());
        let text = large_real(value).unwrap();
        prop_assert!(text.len() <= 16, "{}", text);
        let held = nearest_in_field(value);
        prop_assert_eq!(parse_real(&text), Some(held));
        prop_assert!((held - value).abs() <= FIELD_ROUNDING * value.abs(), "{} as {}", value, text);
        prop_assert_eq!(nearest_in_field(held), held);
    }

    #[test]
    fn a_large_field_keeps_twelve_digits_of_an_ordinary_number(
        mantissa in 1.0..10.0_f64,
        exponent in -9..=8_i32,
        is_negative in any::<bool>(),
    ) {
        let value = if is_negative { -mantissa } else { mantissa } * 10.0_f64.powi(exponent);
        let difference = (nearest_in_field(value) - value).abs();
        prop_assert!(difference <= DECK_ROUNDING * value.abs());
    }

    #[test]
    fn a_number_that_fits_a_large_field_is_written_exactly(value in field_number()) {
        prop_assert_eq!(nearest_in_field(value), value);
    }

    /// A free real number of any length, with any exponent, is the number that it says.
    #[test]
    fn free_reals_of_any_length_are_read(value in -1e6..1e6_f64, digits in 1..25_usize, letter in prop::sample::select(vec!["E", "D", "e", ""])) {
        let written = format!("{value:.digits$e}").replace('e', "E");
        let (mantissa, exponent) = written.split_once('E').unwrap();
        let exponent: i32 = exponent.parse()?;
        let grid = read_deck(format!("GRID,1,,{mantissa}{letter}{exponent:+}\n"))?.model.grids[0].position.x;
        prop_assert_eq!(grid, written.parse::<f64>()?);
    }
}
