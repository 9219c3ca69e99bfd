//! Why elements and not matrices: the same box, the same test modes, and what either correction knows afterwards.
//!
//! Both corrections are given the lowest test modes alone, and then predict all modes of the box, as tested and after a design change
//! that is no part of the test: thicker covers. The truth is the box with the right gages.

use super::matrix_correction::{baruch_stiffness, berman_nagy_mass, mass_weighted, weighted_norm};
use crate::prelude::*;

/// Test modes given to the corrections unless told otherwise: about half, so that there are others to predict.
pub const USUAL_TEST_MODES: usize = 5;
/// Name of the prediction that is right by definition.
pub const TRUTH: &str = "Truth";
/// What the design change adds to every cover's gage, in: half of what a tested cover has.
pub const COVER_DOUBLER: f64 = 0.5 * TEST_GAGE;
/// Digits of the shapes that the mass correction is given: what is read from a plot of unit amplitude.
const READ_DIGITS: f64 = 100.0;
/// Singular value of the shares, each of unit norm, below which they are combinations of one another: far above
/// round-off, and a thousand times below the smallest of the box's own.
const SMALLEST_SINGULAR_VALUE: f64 = 1e-9;

/// A model and what it says of the box as tested and after the design change.
#[derive(Debug, Clone, PartialEq)]
pub struct Prediction {
    /// Which model.
    pub model: &'static str,
    /// Relative frequency errors of all modes as tested, in the order of the true modes.
    pub as_tested: Vec<f64>,
    /// The same after the design change.
    pub after_change: Vec<f64>,
    /// Change of the stiffness, entry by entry, relative to the diagonal before: $\Delta K_{ij}/\sqrt{K_{ii} K_{jj}}$.
    pub stiffness_change: Vec<Vec<f64>>,
    /// Change of the mass in the same way.
    pub mass_change: Vec<Vec<f64>>,
    /// Weighted norm of what still separates the stiffness from the true one, relative to what did at the start.
    pub distance_left: f64,
    /// The part of the stiffness change, in the weighted norm, that no factors on the elements could make.
    pub beyond_elements: f64,
}

/// Factors on one element's gage.
#[derive(Debug, Clone, PartialEq)]
pub struct ElementFactor {
    /// Element number.
    pub element: usize,
    /// The factor that makes the model true.
    pub truth: f64,
    /// The factor found by the correlation.
    pub found: f64,
    /// The factor in the set that comes nearest to Baruch's change.
    pub nearest_to_baruch: f64,
}

/// A model before it is judged: its name, its stiffness as tested and after the design change, its mass.
type Candidate<'a> = (&'static str, DMatrix<f64>, DMatrix<f64>, &'a DMatrix<f64>);

/// The comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct MatrixComparison {
    /// Case number.
    pub case: usize,
    /// Number of test modes, the lowest; the others are predicted.
    pub test_modes: usize,
    /// Frequencies of the true box as tested, Hz.
    pub as_tested_hz: Vec<f64>,
    /// Frequencies of the true box after the design change, Hz.
    pub after_change_hz: Vec<f64>,
    /// The start, the truth, and each correction.
    pub predictions: Vec<Prediction>,
    /// Factors on the elements, 1 to 15.
    pub factors: Vec<ElementFactor>,
}

/// Corrects a case by elements and by matrices with its lowest `test_modes` test modes, and compares.
///
/// The element factors come from [`correlate`] with the case's settings, the library's own rule of the step, and all
/// analysis modes. Baruch's correction is given the exact test shapes. Berman and Nagy's is given them rounded to two
/// digits, because with exact ones there would be no mass to correct. The design change reaches the matrices as all
/// that is known without elements: the change of $K_D$ in the uncorrected model.
///
/// # Errors
/// Those of the model, the loops and the corrections.
pub fn compare_matrices(case: &Case, test_modes: usize) -> Result<MatrixComparison, CaseError> {
    let first = case.first_gages();
    let start = analysis(case, &first)?;
    let all = case.test_modes()?;
    let test = all.lowest(test_modes)?;
    let model = case.model()?;
    let ranges = model.factor_ranges()?;
    let settings = case.settings_by(StepRule::Matrix);
    let correlation = correlate(
        |factors| model.analyze(factors, &test, None),
        &ranges,
        &settings,
        |_, _| true,
    )?;
    let found = model.sizes(&correlation.best_factors)?[..PANEL_COUNT].to_vec();

    let baruch = baruch_stiffness(&start.stiffness, &start.mass, &test);
    let read = as_read(&test, &start.mass)?;
    let corrected_mass = berman_nagy_mass(&start.mass, read.shapes());
    let berman_nagy = baruch_stiffness(&start.stiffness, &corrected_mass, &read);

    let right = [TEST_GAGE; PANEL_COUNT];
    let tested = |gages: &[f64]| analysis(case, gages).map(|model| model.stiffness);
    let doubled = |gages: &[f64]| tested(&with_doublers(gages));
    let (mass, truth, changed_truth) = (&start.mass, tested(&right)?, doubled(&right)?);
    let design_change = doubled(&first)? - &start.stiffness;
    let (true_modes, true_changed) = (
        solve(&truth, mass, mass.nrows())?,
        solve(&changed_truth, mass, mass.nrows())?,
    );
    let distance = |stiffness: &DMatrix<f64>| weighted_norm(&(stiffness - &truth), mass);
    let predict = |(model, stiffness, changed, own_mass): Candidate| {
        let change = &stiffness - &start.stiffness;
        Ok(Prediction {
            model,
            as_tested: frequency_errors(&stiffness, own_mass, &true_modes)?,
            after_change: frequency_errors(&changed, own_mass, &true_changed)?,
            stiffness_change: relative_entries(&change, &start.stiffness),
            mass_change: relative_entries(&(own_mass - mass), mass),
            distance_left: distance(&stiffness) / distance(&start.stiffness),
            beyond_elements: nearest_factors(&change, &start)?.1,
        })
    };
    let candidates = [
        ("Initial", start.stiffness.clone(), doubled(&first)?, mass),
        (TRUTH, truth.clone(), changed_truth, mass),
        ("Element factors", tested(&found)?, doubled(&found)?, mass),
        ("Baruch", baruch.clone(), &baruch + &design_change, mass),
        (
            "Berman and Nagy",
            berman_nagy.clone(),
            berman_nagy + design_change,
            &corrected_mass,
        ),
    ];
    let nearest = nearest_factors(&(&baruch - &start.stiffness), &start)?.0;
    let factor = |e: usize| ElementFactor {
        element: case.panels[e].label,
        truth: TEST_GAGE / first[e],
        found: found[e] / first[e],
        nearest_to_baruch: 1.0 + nearest[e],
    };
    Ok(MatrixComparison {
        case: case.number,
        test_modes,
        as_tested_hz: true_modes.frequencies_hz(),
        after_change_hz: true_changed.frequencies_hz(),
        predictions: candidates
            .into_iter()
            .map(predict)
            .collect::<Result<_, Error>>()?,
        factors: (0..PANEL_COUNT).map(factor).collect(),
    })
}

/// The dynamic model of a case at other gages.
fn analysis(case: &Case, gages: &[f64]) -> Result<DynamicModel, CaseError> {
    let model = case.model_with(gages)?;
    Ok(model.matrices(&vec![1.0; model.parameters().len()])?)
}

fn with_doublers(gages: &[f64]) -> Vec<f64> {
    let doubled = |(gage, number)| {
        if COVERS.contains(&number) {
            gage + COVER_DOUBLER
        } else {
            gage
        }
    };
    gages.iter().copied().zip(1..).map(doubled).collect()
}

/// Modes as read from a plot: shapes of unit largest component times [`READ_DIGITS`], rounded to whole numbers,
/// then of unit generalized mass.
fn as_read(modes: &Modes, mass: &DMatrix<f64>) -> Result<Modes, Error> {
    let mut shapes = modes.shapes().clone();
    for mut shape in shapes.column_iter_mut() {
        let largest = shape.amax();
        shape.apply(|value| *value = (*value / largest * READ_DIGITS).round());
    }
    Modes::new(modes.omega_squared().clone(), shapes)?.scaled_with(mass)
}

/// Relative frequency errors of a model, its modes paired with the true ones.
fn frequency_errors(
    stiffness: &DMatrix<f64>,
    mass: &DMatrix<f64>,
    truth: &Modes,
) -> Result<Vec<f64>, Error> {
    let modes = solve(stiffness, mass, truth.len())?;
    let pairing = pair_modes(&cross_orthogonality(&modes, truth, mass)?)?;
    let pairs = pairing.paired(&modes)?.frequencies_hz();
    Ok(pairs
        .iter()
        .zip(truth.frequencies_hz())
        .map(|(found, truth)| found / truth - 1.0)
        .collect())
}

/// $\Delta_{ij}/\sqrt{A_{ii} A_{jj}}$, row by row.
fn relative_entries(change: &DMatrix<f64>, before: &DMatrix<f64>) -> Vec<Vec<f64>> {
    let size = before.nrows();
    let entry = |i: usize, j: usize| change[(i, j)] / (before[(i, i)] * before[(j, j)]).sqrt();
    (0..size)
        .map(|i| (0..size).map(|j| entry(i, j)).collect())
        .collect()
}

/// Relative changes $c_e$ of the elements whose $\sum_e c_e K_e$ comes nearest to a change of stiffness, and the part
/// of it that is left, both in the weighted norm.
///
/// On a box that is symmetric about its mid-plane upper and lower cover have like shares, so that only their sum is
/// determined: of all nearest sets it is the smallest, each $c_e$ weighted with the norm of its share.
fn nearest_factors(change: &DMatrix<f64>, start: &DynamicModel) -> Result<(Vec<f64>, f64), Error> {
    let weighted = |matrix: &DMatrix<f64>| {
        let weighted = mass_weighted(matrix, &start.mass);
        Ok::<_, Error>(DVector::from_column_slice(weighted.as_slice()))
    };
    let mut shares: Vec<_> = start
        .shares
        .iter()
        .map(weighted)
        .collect::<Result<_, _>>()?;
    let norms = shares.iter_mut().map(DVector::normalize_mut).collect_vec();
    let shares = DMatrix::from_columns(&shares);
    let target = weighted(change)?;
    let nearest = shares
        .clone()
        .svd(true, true)
        .solve(&target, SMALLEST_SINGULAR_VALUE);
    let coefficients = nearest.map_err(|_| Error::no_convergence("element shares"))?;
    let (left, whole) = ((&target - shares * &coefficients).norm(), target.norm());
    let factors = coefficients.iter().zip(&norms).map(|(c, norm)| c / norm);
    Ok((
        factors.collect(),
        if whole > 0.0 { left / whole } else { 0.0 },
    ))
}
