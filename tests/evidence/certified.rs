//! Weighted steps against optima of three fits to fifteen digits, which `golden/certified.py` finds by Newton's steps from two starts
//! each, without a derivative of a mode and without code of the crate.

use crate::prelude::*;

/// A fit and its optimum.
#[derive(Deserialize)]
struct Fit {
    /// The job; empty of the one in `tests/jobs` with this name.
    files: Files,
    factors: Vec<f64>,
    chi_squared: f64,
    deviations: Vec<f64>,
    /// A row a parameter: the slope of the objective, in deviations of the parameter alone, for every logarithm that moves by one. Of a
    /// factor at its bound, which has a slope at the optimum, its own way in such deviations.
    slopes: Vec<Vec<f64>>,
}

/// A stop has slopes within the tolerance of its steps. They leave up to twelve times as many deviations where parameters imitate one
/// another; the factor that is farthest off is so by 8e-6 deviations.
#[test]
fn weighted_steps_end_at_certified_optima() {
    let text = include_str!("../../golden/certified.json");
    let fits: BTreeMap<String, Fit> = serde_json::from_str(text).unwrap();
    assert_eq!(fits.len(), 3);
    for (name, fit) in fits {
        let result = match fit.files[..] {
            [] => worked(&name),
            _ => &finished(&prepared(&fit.files)),
        };
        let pairs = result.found.factors.iter().zip(&fit.factors);
        let moved = pairs
            .map(|(found, exact)| (found / exact).ln())
            .collect_vec();
        let most = STATIONARY + SLOPES_TOLD * fit.chi_squared.sqrt();
        for row in &fit.slopes {
            let slope: f64 = row
                .iter()
                .zip(&moved)
                .map(|(rise, moved)| rise * moved)
                .sum();
            assert!(slope.abs() <= most, "{name}: {slope:e} of {most:e}");
        }
        let apart = result.misfit.chi_squared - fit.chi_squared;
        assert!(apart.abs() <= CERTIFIED_CHI_SQUARED, "{name}: {apart:e}");
        for (found, exact) in result.seen.deviations.iter().zip(&fit.deviations) {
            let apart = relative_error(found, exact);
            assert!(apart <= MEASURED_NEXT, "{name}: {apart:e}");
        }
    }
}
