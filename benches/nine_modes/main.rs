//! The paper's Table 13 on today's computers: one set of element derivatives, one modal update and whole cases for nine
//! modes, beside the eigensolutions they replace. The ratios stand at the end of the run.

mod problem;
mod rivals;
mod summary;

use corfem::method::analysis::Analysis;
use corfem::method::inner_loop::run;
use corfem::method::perturbation::recursive_1_converged;
use corfem::torque_box::run_case;
use criterion::{BenchmarkGroup, Criterion, measurement::WallTime};
use nalgebra::DMatrix;
use problem::{NINE, PassSetting, Setting, passes};
use rivals::Rivals;
use std::hint::black_box;
use std::path::Path;
use std::time::Duration;

/// Eigensolutions by every rival.
fn eigensolutions(group: &mut BenchmarkGroup<WallTime>, prefix: &str, matrices: &[DMatrix<f64>]) {
    type Solve = fn(&mut Rivals, &[DMatrix<f64>]);
    let solvers: [Solve; 4] = [
        Rivals::jacobi,
        Rivals::nalgebra,
        Rivals::nalgebra_fixed,
        Rivals::faer,
    ];
    let mut storage = Rivals::new(NINE);
    for matrix in matrices {
        assert!(storage.disagreement(matrix) < 1e-9, "the rivals disagree");
    }
    for (name, solve) in summary::RIVALS.into_iter().zip(solvers) {
        group.bench_function(format!("{prefix}{name}"), |bencher| {
            bencher.iter(|| solve(&mut storage, matrices));
        });
    }
}

/// Derivatives of the error sum with respect to all 15 elements, and the 15 eigensolutions that differences would need.
fn derivatives(criterion: &mut Criterion, setting: &Setting) {
    let mut group = criterion.benchmark_group(summary::DERIVATIVES);
    let problem = &setting.problem;
    group.bench_function(summary::DEFINITION, |bencher| {
        let work = || black_box(problem).error_changes(black_box(problem.exact()));
        bencher.iter(|| work().expect("separate"));
    });
    eigensolutions(
        &mut group,
        summary::EIGENSOLUTION,
        &setting.element_matrices,
    );
    group.finish();
}

/// New roots and shapes after a step of ten percent up and down.
fn update(criterion: &mut Criterion, setting: &Setting) {
    let mut group = criterion.benchmark_group(summary::UPDATE);
    let k = setting.problem.exact().modes.omega_squared();
    for (name, formula) in summary::formulae() {
        group.bench_function(name, |bencher| {
            bencher.iter(|| formula(black_box(k), black_box(&setting.beta)).expect("separate"));
        });
    }
    eigensolutions(
        &mut group,
        summary::EIGENSOLUTION,
        std::slice::from_ref(&setting.step_matrix),
    );
    let from_modes = DMatrix::from_diagonal(k) + &setting.beta;
    eigensolutions(&mut group, summary::FROM_MODES, &[from_modes]);
    group.finish();
}

/// Every pass of Cases 1 to 4: the inner loop, the finite element analysis and the exact check; and the cases whole.
fn cases(criterion: &mut Criterion, passes: &[PassSetting]) {
    let mut group = criterion.benchmark_group(summary::CASES);
    for pass in passes {
        let label = |what: &str| format!("{} {what}", pass.label());
        group.bench_function(label("inner loop"), |bencher| {
            bencher.iter(|| {
                run(
                    black_box(&pass.start),
                    &pass.factors,
                    &pass.ranges,
                    &pass.settings,
                )
                .expect("it runs")
            });
        });
        group.bench_function(label("analysis"), |bencher| {
            bencher.iter(|| {
                pass.model
                    .analyze(black_box(&pass.factors), &pass.test, None)
                    .expect("analyzed")
            });
        });
    }
    for number in corfem::torque_box::CASES {
        let case = corfem::torque_box::Case::new(number).expect("a case");
        group.bench_function(format!("case {number} whole"), |bencher| {
            bencher.iter(|| run_case(black_box(&case), |_, _| {}).expect("it runs"));
        });
    }
    group.finish();
}

fn main() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("criterion");
    let mut criterion = Criterion::default()
        .output_directory(&folder)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_millis(1000))
        .configure_from_args();
    let setting = Setting::new();
    derivatives(&mut criterion, &setting);
    update(&mut criterion, &setting);
    let passes = passes();
    cases(&mut criterion, &passes);
    criterion.final_summary();
    summary::print(&folder, &passes);
    let k = setting.problem.exact().modes.omega_squared();
    let settled = recursive_1_converged(k, &setting.beta).expect("it settles");
    println!("Recursive 1 settles at order {}", settled.order);
}
