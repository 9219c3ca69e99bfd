//! The inner loop far from its start: the least share of a stiffness, factors beyond a half and two, and roots that cross.

use crate::prelude::*;

/// A mass on a spring that is a hundred to a thousand times too stiff: three steps to nearly a half each take more than all of it.
fn much_too_stiff() -> impl Strategy<Value = (f64, f64)> {
    (1000.0..2000.0_f64, 0.001..0.01_f64)
}

fn run_down(stiffness: f64, truth: f64) -> InnerRun {
    let stiffness = dmatrix![stiffness];
    let test = Modes::new(dvector![truth * stiffness[0]], dmatrix![1.0]).unwrap();
    let model = DynamicModel {
        shares: vec![stiffness.clone()],
        stiffness,
        mass: dmatrix![1.0],
    };
    let model = model.analyze(&test, None).unwrap();
    let settings = inner_for_modes(InnerSettings::default(), 1);
    run(&model, &[1.0], &[None], &settings).unwrap()
}

/// The share factors on the way: each step adds to the one before what it takes of the gage.
fn share_factors(inner: &InnerRun) -> Vec<f64> {
    let (mut share, mut gage) = (1.0_f64, 1.0);
    let next = |factor: f64| {
        share = (share + factor / gage - 1.0).max(LEAST_SHARE);
        gage = factor;
        share
    };
    let factors = inner
        .iterations
        .iter()
        .map(|iteration| iteration.gage_factors[0]);
    factors.map(next).collect()
}

#[test]
fn draws_reach_the_least_share() {
    let share = reached(
        "the least share of a stiffness",
        &much_too_stiff(),
        |draw| share_factors(&run_down(draw.0, draw.1)).contains(&LEAST_SHARE),
    );
    assert!(share > LEAST_REACHED, "{share}");
}

properties! {
    #[test]
    fn stiffness_never_falls_below_its_least_share((stiffness, truth) in much_too_stiff()) {
        let inner = run_down(stiffness, truth);
        let shares = share_factors(&inner);
        let (first, last) = (inner.iterations[0].gage_factors[0], inner.last.share_factors[0]);
        prop_assert!((first - 0.55).abs() <= ROUND_OFF && inner.iterations.len() > 2);
        prop_assert!((last - shares[shares.len() - 1]).abs() <= ROUND_OFF);
        prop_assert!(last >= LEAST_SHARE);
        // A gage of which 0.55 is left three times is none that has no stiffness.
        prop_assert_eq!(shares[2], LEAST_SHARE);
        prop_assert!(inner.iterations[2].gage_factors[0] > 0.1);
        let ratio = (LEAST_SHARE / truth).sqrt();
        prop_assert!((inner.iterations[2].errors.frequency - (ratio - 1.0).abs()).abs() <= ROUND_OFF);
    }
}

/// Factors of a third to three, and one of a half to a fifth or of two to five.
fn far_chain() -> impl Strategy<Value = (Chain, Vec<f64>)> {
    (3..=5_usize).prop_flat_map(|count| {
        let anything = (-1.0..1.0_f64).prop_map(f64::exp);
        let far = (2.0..5.0_f64, any::<bool>())
            .prop_map(|(factor, soft)| if soft { 1.0 / factor } else { factor });
        (
            chain(count),
            prop::collection::vec(anything, count),
            far,
            0..count,
        )
            .prop_map(|(chain, mut factors, far, place)| {
                factors[place] = far;
                (chain, factors)
            })
    })
}

fn start(chain: &Chain) -> ModalModel {
    let count = chain.masses.len();
    let (test, ones) = (chain.modes(&vec![1.1; count]), vec![1.0; count]);
    chain.model(&ones).analyze(&test, None).unwrap()
}

#[test]
fn draws_reach_beyond_a_half_and_two() {
    let beyond = reached("a factor beyond 0.5 to 2", &far_chain(), |(_, factors)| {
        factors.iter().any(|factor| !(0.5..=2.0).contains(factor))
    });
    let settled = reached(
        "Recursive 1 beyond 0.5 to 2",
        &far_chain(),
        |(chain, factors)| start(&chain).at(&factors).is_ok(),
    );
    assert!(
        beyond > LEAST_REACHED && settled > LEAST_REACHED,
        "{beyond} {settled}"
    );
}

properties! {
    #[test]
    fn the_state_is_the_exact_solution_far_from_its_start((chain, factors) in far_chain()) {
        let model = start(&chain);
        let there = chain.model(&factors);
        let expected = error_sum_by_definition(&there.stiffness, &there.mass, model.test());
        let exact = exact_state(&model, &factors)?;
        prop_assert!((exact.errors.sum() - expected).abs() <= CONVERGED_STATE * expected);
        // So far off the recursion may not settle; where it has settled, on roots to a millionth, it is at the same place.
        if let Ok(state) = model.at(&factors) {
            prop_assert!((state.errors.sum() - expected).abs() <= FAR_RECURSION * expected);
        }
    }
}
