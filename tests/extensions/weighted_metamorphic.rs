//! Metamorphic relations of whole weighted correlations: what must not change when the same problem is put in another way.

use crate::prelude::*;

/// Steps until nothing moves by more than a ten-billionth of its standard deviation.
fn settings(unit: f64) -> WeightedSettings {
    WeightedSettings {
        prior_deviations: vec![unit],
        tolerance: 1e-10 / unit,
        ..WeightedSettings::default()
    }
}

/// A correlation whose standard deviations, and that of the prior, are so many times the usual.
fn correlated(
    analyze: impl Fn(&[f64]) -> Result<ModalModel, Error>,
    modes: usize,
    parameters: usize,
    unit: f64,
) -> WeightedCorrelation {
    let Noise { shape, frequency } = Noise::USUAL;
    let noise = Noise {
        shape: unit * shape,
        frequency: unit * frequency,
    };
    let weights: Vec<ModeWeight> = vec![noise.weight(); modes];
    let (first, ranges) = (vec![1.0; parameters], vec![None; parameters]);
    let compare = |factors: &[f64]| analyze(factors).map(|model| Comparison::from(&model));
    gauss_newton(compare, &first, &ranges, &weights, &settings(unit)).unwrap()
}

fn assert_same(one: &[f64], other: &[f64]) {
    assert_eq!(one.len(), other.len());
    for (a, b) in one.iter().zip(other) {
        assert!(relative_error(a, b) <= SAME_ON_THE_WAY, "{one:?} {other:?}");
    }
}

/// Noise, and with it the prior, in another unit: the factors are the same, and their deviations scale.
fn assert_unit_does_not_matter(
    analyze: impl Fn(&[f64]) -> Result<ModalModel, Error>,
    modes: usize,
    parameters: usize,
) {
    let [one, other] = [1.0, 0.125].map(|unit| correlated(&analyze, modes, parameters, unit));
    assert_same(&one.factors, &other.factors);
    assert_eq!(one.iterations.len(), other.iterations.len());
    let relative = (one.objective / (other.objective / 64.0) - 1.0).abs();
    assert!(relative <= SAME_ON_THE_WAY, "{relative}");
    let scaled = other
        .identifiability
        .deviations
        .iter()
        .map(|of| 8.0 * of)
        .collect_vec();
    assert_same(&one.identifiability.deviations, &scaled);
}

/// Matrices with another's behind them on the diagonal.
fn both(one: &DMatrix<f64>, other: &DMatrix<f64>) -> DMatrix<f64> {
    let (n, m) = (one.shape(), other.shape());
    let mut both = DMatrix::zeros(n.0 + m.0, n.1 + m.1);
    both.view_mut((0, 0), n).copy_from(one);
    both.view_mut(n, m).copy_from(other);
    both
}

properties! {
    #![proptest_config(costly_config())]

    #[test]
    fn the_unit_of_all_deviations_does_not_matter_on_chains((chain, truth) in chain_and_truth(), seed in any::<u64>()) {
        let test = with_noise(&chain.modes(&truth), Noise::USUAL, seed)?;
        let analyze = |factors: &[f64]| chain.model(factors).analyze(&test, None);
        assert_unit_does_not_matter(analyze, test.len(), truth.len());
    }

    /// What weighted steps minimize is a sum over modes: two structures that nothing couples are each corrected as alone.
    #[test]
    fn two_uncoupled_structures_together_are_each_corrected_as_alone(
        (one, truth) in chain_and_truth(),
        (other, others) in chain_and_truth(),
        seed in any::<u64>(),
    ) {
        // The other's frequencies a hundred times as high: no mode of the one is close to one of it.
        let other = Chain { masses: other.masses.iter().map(|mass| 1e-4 * mass).collect(), ..other };
        let test = |chain: &Chain, truth: &[f64], seed| with_noise(&chain.modes(truth), Noise::USUAL, seed).unwrap();
        let (test, tests) = (test(&one, &truth, seed), test(&other, &others, seed ^ 1));
        let alone = |chain: &Chain, test: &Modes| {
            correlated(|factors: &[f64]| chain.model(factors).analyze(test, None), test.len(), chain.masses.len(), 1.0).factors
        };
        let apart = [alone(&one, &test), alone(&other, &tests)].concat();
        let count = truth.len();
        let squares = test.omega_squared().iter().chain(tests.omega_squared()).copied().collect_vec();
        let all = Modes::new(DVector::from_vec(squares), both(test.shapes(), tests.shapes()))?;
        let together = |factors: &[f64]| {
            let (a, b) = (one.model(&factors[..count]), other.model(&factors[count..]));
            let (n, m) = (a.mass.nrows(), b.mass.nrows());
            let first = a.shares.iter().map(|share| both(share, &zero_square(m)));
            let second = b.shares.iter().map(|share| both(&zero_square(n), share));
            DynamicModel {
                stiffness: both(&a.stiffness, &b.stiffness),
                mass: both(&a.mass, &b.mass),
                shares: first.chain(second).collect(),
            }
            .analyze(&all, None)
        };
        assert_same(&apart, &correlated(together, all.len(), apart.len(), 1.0).factors);
    }
}
