//! Rankings of suspects: by the first iteration's own factors, and by what one parameter alone explains.

use crate::extensions::weighted::at;
use crate::prelude::*;

#[test]
fn the_first_ranking_is_by_what_the_first_iteration_asks_for() {
    for (number, modes) in [(1, 9), (2, 9), (3, 5)] {
        let known = Known::of_case(number);
        let lowest = (0..modes).collect_vec();
        let (omega_squared, shapes) = (
            known.test.omega_squared().select_rows(&lowest),
            known.test.shapes().select_columns(&lowest),
        );
        let test = Modes::new(omega_squared, shapes).unwrap();
        let model = known.model.analyze(&[1.0; 15], &test).unwrap();
        let settings = InnerSettings {
            iterations: 1,
            ..InnerSettings::default()
        };
        let settings = inner_for_modes(settings, modes);
        let run = run(&model, &[1.0; 15], &[None; 15], &settings).unwrap();
        let asked = &run.iterations[0].unlimited_factors;
        let suspects = by_factor(&model, &settings).unwrap();
        for suspect in &suspects {
            assert_eq!(suspect.factor, asked[suspect.parameter], "case {number}");
            assert_eq!(suspect.evidence, (suspect.factor - 1.0).abs());
        }
        assert!(
            suspects
                .windows(2)
                .all(|pair| pair[0].evidence as f32 >= pair[1].evidence as f32)
        );
        let mut all = suspects
            .iter()
            .map(|suspect| suspect.parameter)
            .collect_vec();
        all.sort_unstable();
        assert_eq!(all, (0..15).collect_vec());
    }
}

#[test]
fn evidence_is_what_the_objective_falls_by_at_the_factor_named() {
    let case = case_of(2);
    let (first, test) = (
        case.model().unwrap().matrices(&[1.0; 15]).unwrap(),
        case.test_modes().unwrap(),
    );
    let weights = equal_weights(Noise::USUAL, test.len());
    let objective = |factors: &[f64]| {
        let model = at(&first, factors).analyze(&test, None).unwrap();
        let residuals = residuals(&Comparison::from(&model), &weights);
        0.5 * residuals.unwrap().norm_squared()
    };
    let ones = [1.0; 15];
    let start = objective(&ones);
    let here = Comparison::from(&first.analyze(&test, None).unwrap());
    for suspect in by_single_fit(&here, &weights).unwrap() {
        let fall = |factor: f64| {
            let mut factors = ones;
            factors[suspect.parameter] = factor;
            start - objective(&factors)
        };
        // The box has all its modes, whose combinations are exact.
        assert_within(
            suspect.evidence,
            fall(suspect.factor),
            MATRIX_ROUND_OFF * start,
        );
        // No factor near by, to the search's one percent, does better; one at the search's end would be smaller still.
        for factor in [
            0.9,
            1.0 - 2.0 * SINGLE_FIT_FACTOR,
            1.0 + 2.0 * SINGLE_FIT_FACTOR,
            1.1,
        ] {
            let is_at_the_end = suspect.factor < 1e-3;
            assert!(
                is_at_the_end || fall(suspect.factor * factor) < suspect.evidence,
                "{suspect:?} {factor}"
            );
        }
    }
}

/// Factors are tried from a thousandth to a thousand; an end may ask for more.
#[test]
fn a_suspect_at_an_end_of_the_factors_tried_is_at_the_edge() {
    let is_at_edge = |factor| {
        let suspect = Suspect {
            parameter: 0,
            factor,
            evidence: 1.0,
        };
        suspect.is_at_edge()
    };
    let edges = [1e-3, 1.1e-3, 900.0, 1e3].map(is_at_edge);
    assert_eq!(edges, [true, false, false, true]);
}
