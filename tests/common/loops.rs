//! Strategies of inner-loop problems and settings, and the loop told again from its own record.

use crate::prelude::*;
use corfem::sparse::UNSEEN_SHARE;

/// The problem of a chain towards the truth, with all its modes.
pub fn chain_problem(chain: &Chain, truth: &[f64]) -> ModalModel {
    let count = truth.len();
    chain
        .model(&vec![1.0; count])
        .analyze(&chain.modes(truth), Some(count))
        .unwrap()
}

/// Everything an inner loop is given.
#[derive(Debug, Clone)]
pub struct Given {
    /// The structure.
    pub chain: Chain,
    /// Factors on its springs that the test modes have.
    pub truth: Vec<f64>,
    /// Factors of earlier passes.
    pub base: Vec<f64>,
    /// Bounds on the products.
    pub total_ranges: Vec<Option<Bounds>>,
    /// The settings.
    pub settings: InnerSettings,
}

/// Settings from cautious to reckless: relaxations from 0.3 to 3, bounds of one factor from narrow to wide, few
/// iterations so that all three stops occur.
fn settings() -> impl Strategy<Value = InnerSettings> {
    let rule = prop::sample::select(StepRule::ALL.to_vec());
    (
        (0.3..3.0_f64, 0.3..3.0_f64),
        (0.5..0.95_f64, 1.05..2.0_f64),
        0.01..0.1_f64,
        (0..=5_usize, 0..=12_usize),
        rule,
    )
        .prop_map(
            |(relaxations, (lower, upper), tolerance, (halvings, iterations), step)| {
                InnerSettings {
                    first_relaxation: relaxations.0,
                    relaxation: relaxations.1,
                    factor_range: Bounds { lower, upper },
                    tolerance,
                    halvings,
                    iterations,
                    step,
                }
            },
        )
}

/// An inner loop on a chain: some parameters with bounds on their product of 10 to 50 % either way, some without.
pub fn given() -> impl Strategy<Value = Given> {
    (
        chain_and_truth(),
        prop::collection::vec(0.5..2.0_f64, 5),
        prop::collection::vec(prop::option::of((0.5..0.9_f64, 1.1..1.5_f64)), 5),
        settings(),
    )
        .prop_map(|((chain, truth), base, ranges, settings)| {
            let count = truth.len();
            let total_ranges = ranges[..count]
                .iter()
                .zip(&base)
                .map(|(range, base)| {
                    range.map(|(lower, upper)| Bounds {
                        lower: base * lower,
                        upper: base * upper,
                    })
                })
                .collect();
            Given {
                base: base[..count].to_vec(),
                chain,
                truth,
                total_ranges,
                settings,
            }
        })
}

/// Every accepted step lowers the error sum.
pub fn assert_error_sum_only_falls(problem: &ModalModel, run: &InnerRun) {
    let mut before = problem.exact().errors.sum();
    for iteration in &run.iterations {
        assert!(
            iteration.errors.sum() < before,
            "{} {before}",
            iteration.errors.sum()
        );
        before = iteration.errors.sum();
    }
}

/// In every iteration every factor, and every product with the passes before, stays within its bounds.
pub fn assert_limits_hold(
    run: &InnerRun,
    base: &[f64],
    ranges: &[Option<Bounds>],
    factors: Bounds,
) {
    let mut before = vec![1.0; base.len()];
    for iteration in &run.iterations {
        for e in 0..base.len() {
            let ratio = iteration.gage_factors[e] / before[e];
            assert!(ratio >= factors.lower * (1.0 - ROUND_OFF), "{e}: {ratio}");
            assert!(ratio <= factors.upper * (1.0 + ROUND_OFF), "{e}: {ratio}");
            if let Some(range) = ranges[e] {
                let total = base[e] * iteration.gage_factors[e];
                assert!(total >= range.lower * (1.0 - ROUND_OFF), "{e}: {total}");
                assert!(total <= range.upper * (1.0 + ROUND_OFF), "{e}: {total}");
            }
        }
        before.clone_from(&iteration.gage_factors);
    }
}

/// Correlates a chain with its truth, without bounds.
pub fn correlate_chain(chain: &Chain, truth: &[f64], settings: &Settings) -> Correlation {
    let (test, ranges) = (chain.modes(truth), vec![None; truth.len()]);
    correlate(
        |factors| chain.model(factors).analyze(&test, None),
        &ranges,
        settings,
        |_, _| true,
    )
    .unwrap()
}

/// Settings of the inner loop for so many test modes, where `inner` is for the paper's nine.
pub fn inner_for_modes(inner: InnerSettings, modes: usize) -> InnerSettings {
    let settings = Settings {
        inner,
        ..Settings::default()
    };
    settings.for_modes(modes).inner
}

/// The verdict on a correlation of this model.
pub fn verdict_of(found: &Correlation, first: &ModalModel, ranges: &[Option<Bounds>]) -> Verdict {
    let best = found.best_check();
    let each = mode_errors(&best.modes, &best.pairing, first.test()).unwrap();
    let each = each.into_iter().map(ModeErrors::from).collect_vec();
    let end = (End::of_loops(found, false), found.converged);
    let (sums, factors) = ((best.errors.sum(), &each[..]), &found.best_factors);
    let shares = first.test_shares().iter().zip(factors).enumerate();
    let unseen =
        shares.filter(|(_, (share, factor))| *factor * share.diagonal().amax() < UNSEEN_SHARE);
    Verdict {
        unseen: unseen.map(|own| own.0).collect(),
        ..Verdict::new(end, sums, factors, ranges)
    }
}

/// Parameters by the change $|c - 1|$ that the unlimited factors (13) of the first iteration ask for, the largest first.
pub fn by_factor(analysis: &dyn Analysis, settings: &InnerSettings) -> Result<Vec<Suspect>, Error> {
    let suspect = |(parameter, factor): (usize, f64)| Suspect {
        parameter,
        factor,
        evidence: (factor - 1.0).abs(),
    };
    let factors = first_factors(analysis, settings)?.into_iter().enumerate();
    let mut suspects = factors.map(suspect).collect_vec();
    // Parameters that symmetry makes alike differ by round-off; they stay in order.
    suspects.sort_by(|a, b| (b.evidence as f32).total_cmp(&(a.evidence as f32)));
    Ok(suspects)
}

/// State of a model at factors by an eigensolution in its modal coordinates, each mode in the place of the exact mode that it is most like.
///
/// # Errors
/// A model that is not a vibration at these factors, or whose modes do not pair with the test's.
pub fn exact_state(model: &ModalModel, factors: &[f64]) -> Result<State, Error> {
    let size = model.exact().modes.len();
    let mut beta = zero_square(size);
    for (share, factor) in model.shares().iter().zip(factors) {
        beta += (factor - 1.0) * share;
    }
    let stiffness = DMatrix::from_diagonal(model.exact().modes.omega_squared()) + beta;
    let found = solve(&stiffness, &eye(size), size)?;
    // Rows of the shapes are the exact modes, so their transpose is the cross-orthogonality of the new modes with these.
    let places = pair_modes(&found.shapes().transpose())?;
    let mut generalized = found.shapes().select_columns(&places.analysis_mode);
    for (mut shape, sign) in generalized.column_iter_mut().zip(&places.sign) {
        shape *= *sign;
    }
    let squares = found.omega_squared().select_rows(&places.analysis_mode);
    let modes = Modes::new(squares, model.exact().modes.shapes() * &generalized)?;
    let pairing = pair_modes(&generalized.tr_mul(model.cross()))?;
    Ok(State {
        share_factors: factors.to_vec(),
        errors: errors(&modes, &pairing, model.test())?,
        generalized_shapes: generalized,
        modes,
        pairing,
    })
}

/// The paper's analysis with an eigensolution where it has Recursive 1.
pub struct Eigensolved(pub ModalModel);

impl Analysis for Eigensolved {
    fn exact(&self) -> &State {
        self.0.exact()
    }

    fn at(&self, factors: &[f64]) -> Result<State, Error> {
        exact_state(&self.0, factors)
    }

    fn error_changes(&self, state: &State) -> Result<Vec<f64>, Error> {
        self.0.error_changes(state)
    }

    fn stiffness_changes(&self, state: &State, gage_factors: &[f64], rule: StepRule) -> Vec<f64> {
        self.0.stiffness_changes(state, gage_factors, rule)
    }
}
