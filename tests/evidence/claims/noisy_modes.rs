//! Noisy test modes: the noise, what Appendix B makes of it, and the numbers of the study by other routes.

use crate::evidence::noisy_modes::{NOISY_CASE, RUNS, SEEDS, test_modes};
use crate::prelude::*;

fn case() -> Case {
    case_of(NOISY_CASE)
}

fn exact() -> Modes {
    case().test_modes().unwrap()
}

/// The changes of all shapes by noise, relative to each shape's largest component, mode by mode.
fn shape_changes(exact: &Modes, noisy: &Modes) -> Vec<f64> {
    let change = |mode: usize| {
        (noisy.shapes().column(mode) - exact.shapes().column(mode))
            / exact.shapes().column(mode).amax()
    };
    (0..exact.len())
        .flat_map(|mode| change(mode).as_slice().to_vec())
        .collect()
}

fn frequency_changes(exact: &Modes, noisy: &Modes) -> Vec<f64> {
    noisy
        .frequencies_hz()
        .iter()
        .zip(exact.frequencies_hz())
        .map(|(noisy, exact)| noisy / exact - 1.0)
        .collect()
}

#[test]
fn the_generator_gives_its_published_numbers() {
    // Outputs for this seed as printed at https://rosettacode.org/wiki/Pseudo-random_numbers/Splitmix64.
    let mut state = 1_234_567;
    let numbers: [u64; 5] = std::array::from_fn(|_| split_mix_64(&mut state));
    let published = [
        6_457_827_717_110_365_317,
        3_203_168_211_198_807_973,
        9_817_491_932_198_370_423,
        4_593_380_528_125_082_431,
        16_408_922_859_458_223_821,
    ];
    assert_eq!(numbers, published);
}

#[test]
fn noise_is_normal_and_of_the_stated_size() {
    let (exact, noise) = (
        exact(),
        Noise {
            shape: 0.02,
            frequency: 0.004,
        },
    );
    let noisy = (1..=100)
        .map(|seed| with_noise(&exact, noise, seed).unwrap())
        .collect_vec();
    let shapes = noisy
        .iter()
        .flat_map(|noisy| shape_changes(&exact, noisy))
        .collect_vec();
    let frequencies = noisy
        .iter()
        .flat_map(|noisy| frequency_changes(&exact, noisy))
        .collect_vec();
    assert_eq!((shapes.len(), frequencies.len()), (8100, 900));
    for (changes, size) in [(shapes, noise.shape), (frequencies, noise.frequency)] {
        let z = changes.iter().map(|change| change / size).collect_vec();
        let n = z.len() as f64;
        let mean = |of: &dyn Fn(f64) -> f64| z.iter().map(|&z| of(z)).sum::<f64>() / n;
        let off = |found: f64, expected: f64, variance: f64| {
            (found - expected).abs() / (variance / n).sqrt()
        };
        let following = z.windows(2).map(|pair| pair[0] * pair[1]).sum::<f64>() / n;
        // Moments of the standard normal distribution, with the variance of what is averaged.
        for (what, found, expected, variance) in [
            ("mean", mean(&|z| z), 0.0, 1.0),
            ("square", mean(&|z| z * z), 1.0, 2.0),
            ("cube", mean(&|z| z.powi(3)), 0.0, 15.0),
            ("fourth power", mean(&|z| z.powi(4)), 3.0, 96.0),
            ("product with the next", following, 0.0, 1.0),
        ] {
            assert!(
                off(found, expected, variance) < STANDARD_ERRORS,
                "{what}: {found}"
            );
        }
    }
}

#[test]
fn noise_that_turns_a_frequency_negative_is_an_error() {
    let far = Noise {
        shape: 0.0,
        frequency: 10.0,
    };
    assert!(matches!(
        with_noise(&exact(), far, 1),
        Err(Error::Value {
            what: "frequency",
            expected: "positive and finite",
            ..
        })
    ));
}

properties! {
    #[test]
    fn noisy_modes_come_out_orthonormal_and_screened_within_the_limits(seed in any::<u64>()) {
        let (mass, limits) = (case().reconstruction.mass(), MovementLimits::default());
        let raw = with_noise(&exact(), Noise::USUAL, seed)?;
        let all = orthogonalize(&raw, &mass)?;
        let screened = examine(&raw, &mass, Supports::Held, &limits)?;
        for modes in [&all.modes, &screened.modes] {
            let off = generalized_mass(modes.shapes(), &mass)? - eye(modes.len());
            prop_assert!(off.amax() < MATRIX_ROUND_OFF, "{}", off.amax());
        }
        let flexibility = |modes: &Modes| modes.omega_squared().map(f64::recip).sum();
        prop_assert!(relative_error(flexibility(&all.modes), flexibility(&raw)) < MATRIX_ROUND_OFF);
        for &mode in &screened.kept {
            let movement = screened.movement[mode].unwrap();
            prop_assert!(movement.shape <= limits.shape && movement.frequency.abs() <= limits.frequency);
        }
    }
}

#[test]
fn without_noise_it_is_the_case_itself_by_the_librarys_own_rule() {
    let mut case = case();
    case.settings.inner.step = StepRule::Matrix;
    let run = case_run(&case);
    let gages = case
        .model()
        .unwrap()
        .sizes(&run.correlation.best_factors)
        .unwrap();
    let passes = run.correlation.passes.iter();
    let iterations: usize = passes.map(|pass| pass.inner.iterations.len()).sum();
    let best = run.correlation.best_check().errors.sum();
    for found in &RUNS[0] {
        assert_eq!(found.numbers[6], iterations as f64);
        assert_alike(&found.gages_in, &gages[..15], SAME_HISTORY);
        assert!(relative_error(found.numbers[3], 100.0 * best) < SAME_HISTORY);
    }
}

#[test]
fn errors_are_those_of_a_model_with_the_gages_found() {
    assert_eq!(RUNS.len(), SEEDS.count() + 1);
    for (run, seed) in RUNS.iter().zip(0..) {
        for (found, test) in run.iter().zip(test_modes(seed)) {
            let model = case().model_with(&found.gages_in).unwrap();
            let errors = |test: &Modes| {
                model
                    .analyze(&[1.0; 15], test, None)
                    .unwrap()
                    .exact()
                    .errors
            };
            let truth = errors(&exact());
            let [all, shear, membrane, sum, frequency, shape, _] = found.numbers;
            // Nine shear panels and six membranes.
            let squares = 9.0 * shear.powi(2) + 6.0 * membrane.powi(2);
            for (found, expected) in [
                (sum, 100.0 * errors(&test).sum()),
                (frequency, 100.0 * truth.frequency_rms()),
                (shape, 100.0 * truth.shape_rms()),
                (all, (squares / 15.0).sqrt()),
            ] {
                assert!(
                    relative_error(found, expected) < DIFFERENCE_ROUND_OFF,
                    "{found} {expected}"
                );
            }
        }
    }
}
