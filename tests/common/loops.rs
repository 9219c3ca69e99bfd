//! Strategies of inner-loop problems and settings, and the loop told again from its own record.

use super::tolerances::ROUND_OFF;
use super::vibrations::{Chain, chain_and_truth};
use corfem::method::derivatives::{DerivativeRule, error_changes};
use corfem::method::error_sum::ErrorMeasure;
use corfem::method::inner_loop::{InnerRun, InnerSettings, Stop};
use corfem::method::model::{ModalModel, Range};
use corfem::method::outer_loop::{Correlation, Settings, correlate};
use corfem::method::state::{ModalState, UpdateRule};
use corfem::method::step::{
    Accumulation, LEAST_SHARE, Limit, StepRule, stiffness_changes, unlimited_factors,
};
use proptest::prelude::*;

/// All rules of the step.
pub const STEP_RULES: [StepRule; 4] = [
    StepRule::Norm,
    StepRule::Diagonal,
    StepRule::Relative,
    StepRule::Gage,
];

/// The problem of a chain towards the truth, with all its modes.
pub fn chain_problem(chain: &Chain, truth: &[f64]) -> ModalModel {
    let count = truth.len();
    chain
        .model(&vec![1.0; count])
        .analyze(&chain.modes(truth), Some(count))
        .expect("a chain is a problem")
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
    pub total_ranges: Vec<Option<Range>>,
    /// The settings.
    pub settings: InnerSettings,
}

/// Settings from cautious to reckless: relaxations from 0.3 to 3, bounds of one factor from narrow to wide, few
/// iterations so that all three stops occur.
fn settings() -> impl Strategy<Value = InnerSettings> {
    let rule = prop::sample::select(STEP_RULES.to_vec());
    let accumulation = prop_oneof![Just(Accumulation::Sum), Just(Accumulation::Product)];
    let update = prop_oneof![Just(UpdateRule::default()), Just(UpdateRule::Eigensolution),];
    let derivatives = prop_oneof![
        3 => Just(DerivativeRule::Definition),
        1 => Just(DerivativeRule::Gradient),
    ];
    (
        (0.3..3.0_f64, 0.3..3.0_f64),
        (0.5..0.95_f64, 1.05..2.0_f64),
        0.01..0.1_f64,
        (0..=5_usize, 0..=12_usize),
        (
            derivatives,
            rule,
            accumulation,
            update,
            prop_oneof![Just(ErrorMeasure::Sum), Just(ErrorMeasure::NineModes)],
        ),
    )
        .prop_map(
            |(relaxations, (lower, upper), tolerance, (halvings, iterations), rules)| {
                let (derivatives, step, accumulation, update, measure) = rules;
                InnerSettings {
                    first_relaxation: relaxations.0,
                    relaxation: relaxations.1,
                    factor_range: Range { lower, upper },
                    tolerance,
                    halvings,
                    iterations,
                    derivatives,
                    step,
                    accumulation,
                    measure,
                    update,
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
                    range.map(|(lower, upper)| Range {
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

/// New total factor and what limited it, written out case by case: the bounds of one iteration first, then the halvings, then
/// the bounds of the product.
fn limited(
    total: f64,
    base: f64,
    (unlimited, fraction): (f64, f64),
    factor_range: Range,
    total_range: Option<Range>,
) -> (f64, Limit) {
    let (factor, mut limit) = if unlimited < factor_range.lower {
        (factor_range.lower, Limit::Factor)
    } else if unlimited > factor_range.upper {
        (factor_range.upper, Limit::Factor)
    } else {
        (unlimited, Limit::None)
    };
    let mut next = total * (1.0 + fraction * (factor - 1.0));
    if let Some(range) = total_range {
        if base * next < range.lower {
            (next, limit) = (range.lower / base, Limit::Total);
        } else if base * next > range.upper {
            (next, limit) = (range.upper / base, Limit::Total);
        }
    }
    (next, limit)
}

/// Where a loop stands: factors on gages, and the state with those on the shares.
type Place = (Vec<f64>, ModalState);

/// Factors, limits and place of a trial step halved so many times.
fn trial(
    problem: &ModalModel,
    given: &Given,
    (totals, state): &Place,
    unlimited: &[f64],
    halvings: usize,
) -> (Vec<Limit>, Vec<f64>, Option<Place>) {
    let settings = &given.settings;
    let fraction = 0.5_f64.powi(i32::try_from(halvings).expect("few halvings"));
    let next = |e: usize| {
        let (step, range) = ((unlimited[e], fraction), given.total_ranges[e]);
        limited(totals[e], given.base[e], step, settings.factor_range, range)
    };
    let (factors, limits): (Vec<f64>, Vec<Limit>) = (0..unlimited.len()).map(next).unzip();
    let added = |e: usize| (state.factors()[e] + factors[e] / totals[e] - 1.0).max(LEAST_SHARE);
    let on_shares = match settings.accumulation {
        Accumulation::Sum => (0..factors.len()).map(added).collect(),
        Accumulation::Product => factors.clone(),
    };
    let next = ModalState::at(problem, on_shares, settings.update).ok();
    let lower = next.filter(|next| next.errors().sum() < state.errors().sum());
    (limits, factors.clone(), lower.map(|state| (factors, state)))
}

/// Tells the loop again step by step and asserts that the record says the same.
pub fn assert_record_is_the_loop(problem: &ModalModel, given: &Given, run: &InnerRun) {
    let settings = &given.settings;
    let mut place = (vec![1.0; given.base.len()], ModalState::start(problem));
    assert_eq!(run.start, place.1.errors());
    assert!(run.iterations.len() <= settings.iterations);
    // Written out: nine modes count as they are.
    let scale = match settings.measure {
        ErrorMeasure::Sum => 1.0,
        ErrorMeasure::NineModes => 3.0 / (problem.test().len() as f64).sqrt(),
    };
    let asks = |(totals, state): &Place, relaxation: f64| {
        let errors = error_changes(problem, state, settings.derivatives).expect("separate modes");
        let stiffnesses = stiffness_changes(problem, state.factors(), totals, settings.step);
        let sum = scale * state.errors().sum();
        let unlimited = unlimited_factors(&errors, &stiffnesses, sum, relaxation);
        ((errors, stiffnesses), unlimited)
    };
    let relaxation = |number: usize| {
        if number == 0 {
            settings.first_relaxation
        } else {
            settings.relaxation
        }
    };
    for (number, iteration) in run.iterations.iter().enumerate() {
        assert!(number == 0 || scale * place.1.errors().sum() >= settings.tolerance);
        let ((errors, stiffnesses), unlimited) = asks(&place, relaxation(number));
        assert_eq!(iteration.error_changes, errors);
        assert_eq!(iteration.stiffness_changes, stiffnesses);
        assert_eq!(iteration.unlimited_factors, unlimited);
        if number == 0 {
            assert_eq!(run.first_unlimited_factors, unlimited);
        }
        assert!(iteration.halvings <= settings.halvings);
        for halvings in 0..iteration.halvings {
            let (_, _, lower) = trial(problem, given, &place, &unlimited, halvings);
            assert!(lower.is_none(), "halved although the longer step was good");
        }
        let (limits, factors, lower) =
            trial(problem, given, &place, &unlimited, iteration.halvings);
        assert_eq!(iteration.factors, factors);
        assert_eq!(iteration.limits, limits);
        place = lower.expect("an accepted step lowers the error sum");
        assert_eq!(iteration.errors, place.1.errors());
    }
    let (totals, state) = &place;
    assert_eq!(&run.factors, totals);
    assert_eq!(run.last.factors(), state.factors());
    assert_eq!(run.last.modes(), state.modes());
    assert_eq!(run.last.pairing(), state.pairing());
    assert_eq!(run.last.errors(), state.errors());
    let count = run.iterations.len();
    let within = count > 0 && scale * state.errors().sum() < settings.tolerance;
    match run.stop {
        Stop::Tolerance => assert!(within),
        Stop::Iterations => assert!(!within && count == settings.iterations),
        Stop::LocalMinimum => {
            assert!(!within && count < settings.iterations);
            let (_, unlimited) = asks(&place, relaxation(count));
            for halvings in 0..=settings.halvings {
                let (_, _, lower) = trial(problem, given, &place, &unlimited, halvings);
                assert!(lower.is_none(), "stopped although a step was good");
            }
            if count == 0 {
                assert_eq!(run.first_unlimited_factors, unlimited);
            }
        }
    }
    if settings.iterations == 0 {
        assert!(run.first_unlimited_factors.is_empty());
    }
}

/// Every accepted step lowers the error sum.
pub fn assert_error_sum_only_falls(run: &InnerRun) {
    let mut before = run.start.sum();
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
pub fn assert_limits_hold(run: &InnerRun, base: &[f64], ranges: &[Option<Range>], factors: Range) {
    let mut before = vec![1.0; base.len()];
    for iteration in &run.iterations {
        for e in 0..base.len() {
            let ratio = iteration.factors[e] / before[e];
            assert!(ratio >= factors.lower * (1.0 - ROUND_OFF), "{e}: {ratio}");
            assert!(ratio <= factors.upper * (1.0 + ROUND_OFF), "{e}: {ratio}");
            if let Some(range) = ranges[e] {
                let total = base[e] * iteration.factors[e];
                assert!(total >= range.lower * (1.0 - ROUND_OFF), "{e}: {total}");
                assert!(total <= range.upper * (1.0 + ROUND_OFF), "{e}: {total}");
            }
        }
        before.clone_from(&iteration.factors);
    }
}

/// Correlates a chain with its truth, without bounds.
pub fn correlate_chain(chain: &Chain, truth: &[f64], settings: &Settings) -> Correlation {
    let (test, ranges) = (chain.modes(truth), vec![None; truth.len()]);
    correlate(
        |factors| chain.model(factors).analyze(&test, None),
        &ranges,
        settings,
        |_, _| {},
    )
    .expect("a chain can be correlated")
}
