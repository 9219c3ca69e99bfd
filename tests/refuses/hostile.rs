//! Numbers and sizes that fit nothing, given to what stands around the method: each call ends in an answer or a refusal, none in a panic.

use crate::prelude::*;

/// Calls, each of which ends in an answer or a refusal; a panic names it.
macro_rules! no_panic {
    ($($call:expr;)+) => { $(
        let ended = catch_unwind(AssertUnwindSafe(|| {
            _ = $call;
        }));
        assert!(ended.is_ok(), "{}", stringify!($call));
    )+ };
}

fn matrix(dense: &DMatrix<f64>) -> SparseMatrix {
    SparseMatrix::of_dense("matrix", dense).unwrap()
}

#[test]
fn no_call_around_the_method_ends_in_a_panic() {
    let stiffness = dmatrix![3.0, -1.0, 0.0; -1.0, 2.0, -1.0; 0.0, -1.0, 1.5];
    let (one, flat) = (eye(3), DMatrix::from_element(2, 3, 1.0));
    let (empty, nan) = (zero_square(0), f64::NAN);
    let share = |dense: &DMatrix<f64>| whole_parameter("a", WholeShare::Stiffness(matrix(dense)));
    let whole = WholeModel::new(matrix(&stiffness), matrix(&one), vec![share(&stiffness)]);
    let whole = whole.unwrap();
    let test = Modes::new(dvector![1.0, 3.0], one.columns(0, 2).into_owned());
    let test = test.unwrap();
    let sensors = matrix(&one);
    let analyze = |modes| whole.analyze(&[1.0], &sensors, &test, by_sorting(), modes);
    no_panic! {
        analyze(0);
        analyze(usize::MAX);
        whole.analyze(&[1.0], &matrix(&eye(2)), &test, by_sorting(), 2);
        whole.analyze(&[], &sensors, &test, by_sorting(), 2);
        whole.modes(&[1.0], usize::MAX);
    }
    for factor in [nan, -5.0, f64::INFINITY, 0.0, 1e300] {
        no_panic! {
            whole.modes(&[factor], 1);
            whole.analyze(&[factor], &sensors, &test, by_sorting(), 2);
        }
    }
    let model = analyze(3).unwrap();
    let comparison = || Comparison::from(model.clone());
    let weight = |frequency, shape| ModeWeight { frequency, shape };
    let (ones, settings) = ([weight(1.0, 1.0); 2], WeightedSettings::default());
    for weights in [
        vec![],
        vec![weight(nan, 1.0); 2],
        vec![weight(f64::INFINITY, 1.0); 2],
        vec![weight(0.0, 0.0); 2],
    ] {
        no_panic! {
            residuals(&comparison(), &weights);
            jacobian(&comparison(), &weights);
            Misfit::of(&comparison(), &weights, &[1.0], &[]);
            by_single_fit(&comparison(), &weights);
        }
    }
    no_panic! {
        Misfit::of(&comparison(), &ones, &[], &[]);
        Misfit::of(&comparison(), &ones, &[1.0], &[77]);
        Misfit::of(&comparison(), &ones, &[0.0], &[]);
        by_factor(&comparison().into_model(), &InnerSettings::default());
    }
    let lead = |first: &[f64], ranges: &[Option<_>]| {
        let analyze = |_: &[f64]| Ok::<_, Error>(comparison());
        gauss_newton(analyze, first, ranges, &ones, &settings)
    };
    no_panic! {
        lead(&[], &[]);
        lead(&[1.0, 1.0], &[None, None]);
        lead(&[1.0], &[]);
        lead(&[nan], &[None]);
        lead(&[-1.0], &[None]);
    }
    let starts = |count, ranges: &[Option<_>]| {
        let analyze = |_: &[f64]| Ok::<_, Error>(comparison());
        from_several_starts(analyze, ranges, &ones, &settings, (count, 1), || true)
    };
    no_panic! {
        starts(0, &[None]);
        starts(2, &[]);
    }
    let ends = |factors: &[f64], ranges: &[Option<_>], widening| {
        intervals(
            &|_| Ok(comparison()),
            factors,
            ranges,
            &ones,
            &settings,
            widening,
        )
    };
    no_panic! {
        ends(&[], &[], 1.0);
        ends(&[1.0], &[], 1.0);
        ends(&[nan], &[None], nan);
    }
    let noise = |shape, frequency| Noise { shape, frequency };
    no_panic! {
        NextStep::at(&comparison(), noise(0.0, nan), 0.0);
        identifiability(&flat, &[1.0]);
        identifiability(&empty, &[]);
        assurance_of_roots(&test, &DMatrix::zeros(7, 2));
        indistinct_groups(&[1.0, 2.0], &[0.1]);
    }
    for (shape, frequency) in [(nan, 1.0), (f64::INFINITY, f64::INFINITY), (-5.0, -1.0)] {
        no_panic! {
            with_noise(&test, noise(shape, frequency), 1);
        }
    }
    no_panic! {
        with_noise_by_mode(&test, &[], 1);
    }
    no_panic! {
        pair_optimally(&empty);
        pair_optimally(&dmatrix![nan]);
        pair_optimally(&flat);
        pair_optimally(&DMatrix::from_element(3, 3, 1e308));
        SparseMatrix::new("m", 2, 2, vec![(5, 0, 1.0)]);
        SparseMatrix::new("m", 1, 1, vec![(0, 0, 1e308); 2]);
        SparseMatrix::of_columns("m", 1, &[vec![(3, 1.0)]]);
        SparseMatrix::new("m", 0, 0, Vec::new());
    }
    for scale in [0.0, -1.0, 1e-300, 1e300, 5e-324] {
        let scaled = matrix(&(scale * &stiffness));
        let modes = |stiffness: &SparseMatrix, mass: &SparseMatrix| {
            WholeModel::new(stiffness.clone(), mass.clone(), Vec::new())?.modes(&[], 2)
        };
        no_panic! {
            modes(&scaled, &matrix(&one));
            modes(&matrix(&stiffness), &scaled);
        }
    }
    let odd = matrix(&flat);
    no_panic! {
        WholeModel::new(odd.clone(), odd.clone(), Vec::new());
        odd.times(&zero_square(2));
        odd.through(&zero_square(2));
        odd.is_symmetric();
        odd.check_symmetric("m");
    }
}
