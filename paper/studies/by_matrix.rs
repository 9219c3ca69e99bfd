//! Why elements and not matrices: the same box, the same test modes, and what either correction knows afterwards.
//!
//! A correction of the whole matrix has the measured modes exactly, by the smallest change in a weighted norm. Nothing says which element
//! the change belongs to, nor that any could make it. Both kinds are given the lowest test modes alone, and then predict all modes of the
//! box, as tested and after a design change that is no part of the test: thicker covers.
//!
//! Source: Baruch, "Optimization Procedure to Correct Stiffness and Flexibility Matrices Using Vibration Tests", *AIAA
//! Journal* 16 (1978), 1208–1210.

use super::{percents, rows};
use crate::prelude::*;

/// Test modes given to the corrections: about half, so that there are others to predict.
pub const TEST_MODES: usize = 5;
/// What the design change adds to every cover's gage, in: half of what a tested cover has.
pub const COVER_DOUBLER: f64 = 0.5 * TEST_GAGE;
/// Singular value of the shares, each of unit norm, below which they are combinations of one another: far above
/// round-off, and a thousand times below the smallest of the box's own.
const SMALLEST_SINGULAR_VALUE: f64 = 1e-9;

/// Baruch's correction of the stiffness, lbf/in (d × d):
///
/// $$ K = K_A + \Delta + \Delta^t, \qquad
///    \Delta = \tfrac12 M \Phi (\Phi^t K_A \Phi + \Omega^2) \Phi^t M - K_A \Phi \Phi^t M $$
///
/// with the analysis stiffness $K_A$, the mass $M$, and test shapes $\Phi$ (d × g, $\Phi^t M \Phi = I$) of squared
/// circular frequencies $\Omega^2$. Of all symmetric $K$ with $K\Phi = M\Phi \Omega^2$ it is the one of smallest
/// norm of $M^{-1/2} (K - K_A) M^{-1/2}$.
pub fn baruch_stiffness(
    stiffness: &DMatrix<f64>,
    mass: &DMatrix<f64>,
    test: &Modes,
) -> DMatrix<f64> {
    let (inertia, forces) = (mass * test.shapes(), stiffness * test.shapes());
    let generalized = test.shapes().tr_mul(&forces) + DMatrix::from_diagonal(test.omega_squared());
    let half = 0.5 * &inertia * generalized * inertia.transpose() - forces * inertia.transpose();
    symmetric_part(&(stiffness + &half + half.transpose()))
}

/// $L^{-1} \Delta L^{-t}$ with $M = L L^t$: up to a rotation the same as $M^{-1/2} \Delta M^{-1/2}$, in whose norm the correction is the
/// smallest possible.
pub fn mass_weighted(change: &DMatrix<f64>, mass: &DMatrix<f64>) -> DMatrix<f64> {
    let lower = cholesky("dynamic mass", mass, 0.0).unwrap();
    let half = lower.solve_lower_triangular(change).unwrap();
    lower.solve_lower_triangular(&half.transpose()).unwrap()
}

/// A model and the relative frequency errors of all its modes, in the order of the true ones.
#[derive(Debug, Clone, PartialEq)]
pub struct Corrected {
    /// Which model.
    pub name: &'static str,
    /// Its stiffness as tested, lbf/in.
    pub stiffness: DMatrix<f64>,
    /// Errors as tested, and after the design change.
    pub errors: [Vec<f64>; 2],
}

/// A box with other gages, as tested and with thicker covers.
pub fn tested_and_doubled(case: &Case, gages: &[f64]) -> [DynamicModel; 2] {
    [0.0, COVER_DOUBLER].map(|doubler| {
        let add = |(gage, number)| {
            gage + if COVERS.contains(&number) {
                doubler
            } else {
                0.0
            }
        };
        let gages = gages.iter().copied().zip(1..).map(add).collect_vec();
        let model = case.model_with(&gages).unwrap();
        model.matrices(&[1.0; PANEL_COUNT]).unwrap()
    })
}

/// The first model, the true one and each correction of a case, and the gages that correction by elements finds, in.
///
/// The element factors come from [`correlate`] with the case's settings, the library's own rule of the step, and all
/// analysis modes. Baruch's correction is given the exact test shapes; the design change reaches it as all that is known without elements:
/// the change of $K_D$ in the uncorrected model.
pub fn compare(case: &Case) -> ([Corrected; 4], Vec<f64>) {
    let test = case.test_modes().unwrap().lowest(TEST_MODES).unwrap();
    let (model, settings) = (case.model().unwrap(), case.settings_by(StepRule::Matrix));
    let ranges = model.factor_ranges().unwrap();
    let analyze = |factors: &[f64]| model.analyze(factors, &test, None);
    let run = correlate(analyze, &ranges, &settings, |_, _| true).unwrap();
    let found = model.sizes(&run.best_factors).unwrap()[..PANEL_COUNT].to_vec();
    let stiffness = |gages: &[f64]| tested_and_doubled(case, gages).map(|own| own.stiffness);
    let [first, doubled] = stiffness(&case.first_gages());
    let mass = &case.reconstruction.mass();
    let right = stiffness(&[TEST_GAGE; PANEL_COUNT]);
    let truth = right
        .clone()
        .map(|own| solve(&own, mass, mass.nrows()).unwrap());
    let corrected = |(name, own): (_, [DMatrix<f64>; 2])| {
        let errors = [0, 1].map(|state| {
            let truth = &truth[state];
            let modes = solve(&own[state], mass, truth.len()).unwrap();
            let cross = cross_orthogonality(&modes, truth, mass).unwrap();
            let pairs = pair_modes(&cross).unwrap().paired(&modes).unwrap();
            let pairs = pairs
                .frequencies_hz()
                .into_iter()
                .zip(truth.frequencies_hz());
            pairs.map(|(own, truth)| own / truth - 1.0).collect()
        });
        let [stiffness, _] = own;
        Corrected {
            name,
            stiffness,
            errors,
        }
    };
    let baruch = baruch_stiffness(&first, mass, &test);
    let after = &baruch + &doubled - &first;
    let all = [
        ("Initial", [first, doubled]),
        ("Truth", right),
        ("Element factors", stiffness(&found)),
        ("Baruch", [baruch, after]),
    ];
    (all.map(corrected), found)
}

/// Factors on the elements whose change of stiffness comes nearest to a change, and the part of it that is left, both in the weighted norm.
///
/// On a box that is symmetric about its mid-plane upper and lower cover have like shares, so that only their sum is
/// determined: of all nearest sets it is the smallest, each weighted with the norm of its share.
fn nearest_factors(change: &DMatrix<f64>, start: &DynamicModel) -> (Vec<f64>, f64) {
    let weighted = |matrix: &DMatrix<f64>| {
        DVector::from_column_slice(mass_weighted(matrix, &start.mass).as_slice())
    };
    let mut shares = start.shares.iter().map(weighted).collect_vec();
    let norms = shares.iter_mut().map(DVector::normalize_mut).collect_vec();
    let (shares, target) = (DMatrix::from_columns(&shares), weighted(change));
    let nearest = shares.clone().svd(true, true);
    let nearest = nearest.solve(&target, SMALLEST_SINGULAR_VALUE).unwrap();
    let left = (&target - shares * &nearest).norm() / target.norm();
    (
        nearest
            .iter()
            .zip(&norms)
            .map(|(c, norm)| 1.0 + c / norm)
            .collect(),
        left,
    )
}

/// What the models know, how far they are from the truth, and the factors that they stand for.
pub fn tables(number: usize) -> Vec<Table> {
    let case = case_of(number);
    let (all, found) = compare(&case);
    let first = case.first_gages();
    let [start, _] = tested_and_doubled(&case, &first);
    let names = all.each_ref().map(|own| own.name);
    let columns = names.map(|name| format!("{name} %"));
    let columns = columns.each_ref().map(String::as_str);
    let frequencies = ["as_tested", "after_a_change"]
        .iter()
        .zip(0..)
        .map(|(state, of)| {
            let rms_of = |modes: Range<usize>| {
                percents(all.iter().map(|own| rms(&own.errors[of][modes.clone()])))
            };
            let both = [
                ("RMS test modes", rms_of(0..TEST_MODES)),
                ("RMS others", rms_of(TEST_MODES..9)),
            ];
            rows(&format!("matrix_frequencies_{state}"), &columns, both)
        });
    let distance =
        |own: &Corrected| mass_weighted(&(&own.stiffness - &all[1].stiffness), &start.mass).norm();
    let change = |own: &Corrected| &own.stiffness - &start.stiffness;
    let distances = all[1..].iter().map(|own| {
        let beyond = nearest_factors(&change(own), &start).1;
        (
            own.name,
            percents([distance(own) / distance(&all[0]), beyond]),
        )
    });
    let nearest = nearest_factors(&change(&all[3]), &start).0;
    let factors = (0..PANEL_COUNT).map(|e| (e + 1, vec![found[e] / first[e], nearest[e]]));
    frequencies
        .chain([
            rows(
                "matrix_distance",
                &["Left %", "Beyond elements %"],
                distances,
            ),
            rows("matrix_factors", &["Found", "Nearest to Baruch"], factors),
        ])
        .collect()
}
