//! One set of element derivatives, one modal update and one whole case for the paper's nine modes, beside the
//! eigensolutions they replace.

use corfem::cases::{Case, run_case};
use corfem::derivatives::{DERIVATIVE_STEP, Workspace, error_changes_into};
use corfem::modal::ModalProblem;
use corfem::perturbation::{UpdateRule, perturb};
use criterion::{Criterion, criterion_group, criterion_main};
use nalgebra::DMatrix;
use std::hint::black_box;

fn problem(case: usize) -> ModalProblem {
    let case = Case::new(case).expect("a case");
    let model = case.model().expect("a model");
    let dynamic = model.analyze(&[1.0; 15]).expect("analyzed");
    let test = case.test_modes().expect("test modes");
    ModalProblem::new(&dynamic, &test, 9).expect("reduced")
}

/// Derivatives of the error sum with respect to all 15 elements.
fn derivatives(criterion: &mut Criterion) {
    let problem = problem(2);
    let state = problem.start_state().expect("a state");
    let mut group = criterion.benchmark_group("15 element derivatives");
    let mut workspace = Workspace::new(&problem);
    let mut changes = vec![0.0; problem.parameter_count()];
    group.bench_function("first order", |bencher| {
        bencher.iter(|| {
            error_changes_into(black_box(&problem), &state, &mut workspace, &mut changes)
                .expect("separate modes");
        });
    });
    group.bench_function("eigensolutions", |bencher| {
        bencher.iter(|| {
            for parameter in 0..problem.parameter_count() {
                let mut factors = vec![1.0; problem.parameter_count()];
                factors[parameter] += DERIVATIVE_STEP;
                let state = problem
                    .state_at(factors, UpdateRule::Eigensolution)
                    .expect("solved");
                black_box(state.errors.sum());
            }
        });
    });
    group.finish();
}

/// New roots and shapes after a step of ten percent.
fn update(criterion: &mut Criterion) {
    let problem = problem(2);
    let k = &problem.start.omega_squared;
    let mut beta = DMatrix::zeros(k.len(), k.len());
    for (e, share) in problem.generalized_shares.iter().enumerate() {
        beta += 0.1 * if e % 2 == 0 { 1.0 } else { -1.0 } * share.matrix();
    }
    let mut group = criterion.benchmark_group("modal update");
    for (name, rule) in [
        ("first order", UpdateRule::FirstOrder),
        ("Recursive 1, order 2", UpdateRule::Recursive1 { order: 2 }),
        ("Recursive 1, order 4", UpdateRule::Recursive1 { order: 4 }),
        ("Recursive 1, order 8", UpdateRule::Recursive1 { order: 8 }),
        ("Recursive 1, converged", UpdateRule::default()),
        ("Recursive 2, order 2", UpdateRule::Recursive2 { order: 2 }),
        ("eigensolution", UpdateRule::Eigensolution),
    ] {
        group.bench_function(name, |bencher| {
            bencher.iter(|| perturb(black_box(k), black_box(&beta), rule).expect("separate modes"));
        });
    }
    group.finish();
}

/// Cases 1 to 4 whole, from element definitions to the last exact check.
fn whole_cases(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("whole case");
    for number in 1..=4 {
        let case = Case::new(number).expect("a case");
        group.bench_function(number.to_string(), |bencher| {
            bencher.iter(|| run_case(black_box(&case), |_, _| {}).expect("it runs"));
        });
    }
    group.finish();
}

criterion_group!(benches, derivatives, update, whole_cases);
criterion_main!(benches);
