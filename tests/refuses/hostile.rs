//! Numbers and sizes that fit nothing, given to what stands around the method: each call ends in an answer or a refusal, none in a panic.

use crate::prelude::*;

/// The calls that end in a panic, by name.
#[derive(Default)]
struct Calls(Vec<String>);

impl Calls {
    fn of<T>(&mut self, name: &str, call: impl FnOnce() -> T) {
        if catch_unwind(AssertUnwindSafe(call)).is_err() {
            self.0.push(name.to_owned());
        }
    }
}

fn matrix(dense: &DMatrix<f64>) -> SparseMatrix {
    SparseMatrix::of_dense("matrix", dense).unwrap()
}

#[test]
fn no_call_around_the_method_ends_in_a_panic() {
    let mut calls = Calls::default();
    let stiffness = dmatrix![3.0, -1.0, 0.0; -1.0, 2.0, -1.0; 0.0, -1.0, 1.5];
    let (one, flat) = (eye(3), DMatrix::from_element(2, 3, 1.0));
    let (empty, nan) = (zero_square(0), f64::NAN);
    let share = |dense: &DMatrix<f64>| WholeParameter {
        name: "a".to_owned(),
        share: WholeShare::Stiffness(matrix(dense)),
        range: None,
    };
    let whole = WholeModel::new(matrix(&stiffness), matrix(&one), vec![share(&stiffness)]);
    let whole = whole.unwrap();
    let test = Modes::new(
        DVector::from_vec(vec![1.0, 3.0]),
        one.columns(0, 2).into_owned(),
    );
    let test = test.unwrap();
    let pair = || by_sorting();
    let sensors = matrix(&one);
    let analyze = |modes, residual_vectors| {
        let size = BasisSize {
            modes,
            residual_vectors,
        };
        whole.analyze(&[1.0], &sensors, &test, pair(), size)
    };
    calls.of("analyze 0", || analyze(0, 0));
    calls.of("analyze all", || analyze(usize::MAX, 4));
    calls.of("analyze residual vectors", || analyze(2, usize::MAX));
    let sensors_of_two = matrix(&eye(2));
    let size = BasisSize {
        modes: 2,
        residual_vectors: 0,
    };
    calls.of("analyze sensors", || {
        whole.analyze(&[1.0], &sensors_of_two, &test, pair(), size)
    });
    calls.of("analyze no factor", || {
        whole.analyze(&[], &sensors, &test, pair(), size)
    });
    for factor in [nan, -5.0, f64::INFINITY, 0.0, 1e300] {
        calls.of("modes", || whole.modes(&[factor], 1));
        calls.of("analyze", || {
            whole.analyze(&[factor], &sensors, &test, pair(), size)
        });
    }
    calls.of("modes all", || whole.modes(&[1.0], usize::MAX));
    let model = analyze(3, 0).unwrap();
    let comparison = || Comparison::from(model.clone());
    let weight = |frequency, shape| ModeWeight { frequency, shape };
    let (ones, settings) = ([weight(1.0, 1.0); 2], WeightedSettings::default());
    for (name, weights) in [
        ("none", vec![]),
        ("nan", vec![weight(nan, 1.0); 2]),
        ("infinite", vec![weight(f64::INFINITY, 1.0); 2]),
        ("zero", vec![weight(0.0, 0.0); 2]),
    ] {
        calls.of(&format!("residuals {name}"), || {
            residuals(&comparison(), &weights)
        });
        calls.of(&format!("jacobian {name}"), || {
            jacobian(&comparison(), &weights)
        });
        calls.of(&format!("misfit {name}"), || {
            Misfit::of(&comparison(), &weights, &[1.0], &[])
        });
        calls.of(&format!("by_single_fit {name}"), || {
            by_single_fit(&comparison(), &weights)
        });
    }
    calls.of("misfit without priors", || {
        Misfit::of(&comparison(), &ones, &[], &[])
    });
    calls.of("misfit beyond", || {
        Misfit::of(&comparison(), &ones, &[1.0], &[77])
    });
    calls.of("misfit prior 0", || {
        Misfit::of(&comparison(), &ones, &[0.0], &[])
    });
    calls.of("by_factor", || {
        by_factor(&comparison().into_model(), &InnerSettings::default())
    });
    let lead = |first: &[f64], ranges: &[Option<_>]| {
        let analyze = |_: &[f64]| Ok::<_, Error>(comparison());
        gauss_newton(analyze, first, ranges, &ones, &settings)
    };
    calls.of("steps from nothing", || lead(&[], &[]));
    calls.of("steps from too much", || lead(&[1.0, 1.0], &[None, None]));
    calls.of("steps without range", || lead(&[1.0], &[]));
    calls.of("steps from nan", || lead(&[nan], &[None]));
    calls.of("steps from below", || lead(&[-1.0], &[None]));
    let starts = |count, ranges: &[Option<_>]| {
        let analyze = |_: &[f64]| Ok::<_, Error>(comparison());
        from_several_starts(analyze, ranges, &ones, &settings, count, 1)
    };
    calls.of("no start", || starts(0, &[None]));
    calls.of("starts without range", || starts(2, &[]));
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
    calls.of("intervals of nothing", || ends(&[], &[], 1.0));
    calls.of("intervals without range", || ends(&[1.0], &[], 1.0));
    calls.of("intervals nan", || ends(&[nan], &[None], nan));
    let noise = |shape, frequency| Noise { shape, frequency };
    calls.of("next step", || {
        NextStep::at(&comparison(), noise(0.0, nan), 0.0)
    });
    calls.of("identifiability", || identifiability(&flat, &[1.0]));
    calls.of("identifiability empty", || identifiability(&empty, &[]));
    calls.of("assurance of roots", || {
        assurance_of_roots(&test, &DMatrix::zeros(7, 2))
    });
    calls.of("assurance", || modal_assurance(&flat, &one));
    calls.of("groups", || indistinct_groups(&[1.0, 2.0], &[0.1]));
    for (shape, frequency) in [(nan, 1.0), (f64::INFINITY, f64::INFINITY), (-5.0, -1.0)] {
        calls.of("noise", || with_noise(&test, noise(shape, frequency), 1));
    }
    calls.of("noise by mode", || with_noise_by_mode(&test, &[], 1));
    for (name, closeness, floor) in [
        ("empty", empty.clone(), 0.5),
        ("no modes", DMatrix::zeros(0, 3), 0.5),
        ("nan", dmatrix![nan], 0.5),
        ("nan floor", flat.clone(), nan),
        ("huge", DMatrix::from_element(3, 3, 1e308), 0.5),
    ] {
        calls.of(&format!("pairs {name}"), || {
            pair_optimally(&closeness, floor)
        });
    }
    for (name, shapes) in [
        ("empty", empty.clone()),
        ("wide", flat.clone()),
        ("zero", DMatrix::zeros(3, 2)),
    ] {
        calls.of(&format!("mass by modes {name}"), || mass_by_modes(&shapes));
    }
    calls.of("coordinates beyond", || {
        coordinate_assurance(&stiffness, &one, &[Some(9)])
    });
    calls.of("coordinates of two sizes", || {
        coordinate_assurance(&stiffness, &flat, &[Some(0)])
    });
    calls.of("entry beyond", || {
        SparseMatrix::new("m", 2, 2, vec![(5, 0, 1.0)])
    });
    calls.of("entry nan", || {
        SparseMatrix::new("m", 1, 1, vec![(0, 0, nan)])
    });
    calls.of("entries that overflow", || {
        SparseMatrix::new("m", 1, 1, vec![(0, 0, 1e308); 2])
    });
    calls.of("column beyond", || {
        SparseMatrix::of_columns("m", 1, &[vec![(3, 1.0)]])
    });
    for scale in [0.0, -1.0, 1e-300, 1e300, 5e-324] {
        let scaled = matrix(&(scale * &stiffness));
        let modes = |stiffness: &SparseMatrix, mass: &SparseMatrix| {
            WholeModel::new(stiffness.clone(), mass.clone(), Vec::new())?.modes(&[], 2)
        };
        calls.of("modes of a scale", || modes(&scaled, &matrix(&one)));
        calls.of("modes of a mass", || modes(&matrix(&stiffness), &scaled));
    }
    calls.of("no rows", || SparseMatrix::new("m", 0, 0, Vec::new()));
    {
        let odd = matrix(&flat);
        calls.of("model of no square", || {
            WholeModel::new(odd.clone(), odd.clone(), Vec::new())
        });
        calls.of("times", || odd.times(&zero_square(2)));
        calls.of("through", || odd.through(&zero_square(2)));
        calls.of("is symmetric", || odd.is_symmetric());
        calls.of("symmetric", || odd.check_symmetric("m"));
    }
    assert_eq!(calls.0, [""; 0]);
}
