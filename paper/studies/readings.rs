//! What each reading of the step (12, 13) makes of the paper's own tables: every reading is run on the same box, as many passes as the
//! paper prints, and compared with the print gage by gage. That tells which lies nearest, not which it was.

use crate::prelude::*;

/// The readings of the step that the tables are asked about, the library's own first.
pub const READINGS: [StepRule; 4] = [
    StepRule::Matrix,
    StepRule::Own,
    StepRule::Relative,
    StepRule::Gage,
];

/// A column of the paper's gages as one reading has it.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadingColumn {
    /// The reading.
    pub reading: StepRule,
    /// Number of the paper's table of gages.
    pub table: usize,
    /// Stage of the table: `pass_1`, or `fem_7` with seven analysis modes.
    pub stage: String,
    /// Gages, in, elements 1 to 15.
    pub gages_in: Vec<f64>,
    /// The paper's gage errors, fractions of the test gage.
    pub published_errors: Vec<f64>,
    /// Iterations of the inner loop.
    pub iterations: usize,
    /// RMS gage errors of shear panels and of membranes, fractions; NaN without any.
    pub gage_rms: [f64; 2],
    /// RMS frequency and shape errors, fractions: of the exact solution in a pass, of the inner loop with fewer modes, as
    /// printed.
    pub rms: [f64; 2],
}

impl ReadingColumn {
    fn new(
        case: &Case,
        (table, stage): (usize, String),
        gages: &[f64],
        iterations: usize,
        rms: [f64; 2],
    ) -> Result<Self, CaseError> {
        let paper = PublishedTable::number(table)?;
        let printed = |panel: usize| {
            Ok(paper.required(&panel.to_string(), &format!("{stage}_in"))? / TEST_GAGE - 1.0)
        };
        Ok(Self {
            reading: case.settings.inner.step,
            table,
            gages_in: gages.to_vec(),
            published_errors: (1..=PANEL_COUNT)
                .map(printed)
                .collect::<Result<_, CaseError>>()?,
            iterations,
            gage_rms: [ElementKind::ShearPanel, ElementKind::Membrane]
                .map(|kind| gage_rms(&case.panels, gages, kind)),
            rms,
            stage,
        })
    }

    /// Gage errors, fractions of the test gage.
    pub fn errors(&self) -> impl Iterator<Item = f64> + '_ {
        self.gages_in.iter().map(|gage| gage / TEST_GAGE - 1.0)
    }

    /// Correlation coefficient of the gage errors with the printed ones.
    pub fn correlation(&self) -> f64 {
        correlation(self.errors().collect(), self.published_errors.clone())
    }

    /// Root mean square difference of the gage errors from the printed ones, a fraction.
    pub fn difference(&self) -> f64 {
        let pairs = self.errors().zip(&self.published_errors);
        rms(&pairs.map(|(error, printed)| error - printed).collect_vec())
    }
}

/// Correlation coefficient of two lists.
pub fn correlation(one: Vec<f64>, other: Vec<f64>) -> f64 {
    let about_mean = |list: Vec<f64>| {
        let list = DVector::from_vec(list);
        list.add_scalar(-list.mean())
    };
    let (one, other) = (about_mean(one), about_mean(other));
    one.dot(&other) / (one.norm() * other.norm())
}

/// A case by one reading, as many passes as the paper prints.
///
/// # Errors
/// Those of [`run_case`].
pub fn run_by_reading(case: &Case, reading: StepRule) -> Result<CaseResult, CaseError> {
    let passes = published_passes(case.number);
    let settings = Settings {
        least_passes: passes,
        most_passes: passes,
        ..case.settings_by(reading)
    };
    run_case(
        &Case {
            settings,
            ..case.clone()
        },
        |_, _| {},
    )
}

/// The gages of a run beside the paper's, one column a pass that the paper prints; none for Case 4.
///
/// # Errors
/// [`CaseError::Table`] if the published tables were damaged.
pub fn columns_of(result: &CaseResult) -> Result<Vec<ReadingColumn>, CaseError> {
    let case = &result.case;
    let table = match case.number {
        1..=3 => 2 * case.number + 2,
        _ => return Ok(Vec::new()),
    };
    let passes = result
        .correlation
        .passes
        .iter()
        .zip(&result.pass_gages)
        .take(published_passes(case.number));
    let column = |(row, (pass, gages)): (usize, (&Pass, &Vec<f64>))| {
        let rms = [
            pass.check.errors.frequency_rms(),
            pass.check.errors.shape_rms(),
        ];
        ReadingColumn::new(
            case,
            (table, format!("pass_{}", row + 1)),
            gages,
            pass.inner.iterations.len(),
            rms,
        )
    };
    passes.enumerate().map(column).collect()
}

/// What Case 4's first iteration asks for by one reading.
#[derive(Debug, Clone, PartialEq)]
pub struct Detection {
    /// The reading.
    pub reading: StepRule,
    /// Unlimited factor of the faulty element.
    pub factor: f64,
    /// The largest of the others.
    pub next: f64,
}

/// The element that Case 4 has a hundred times too thin.
pub const FAULTY_ELEMENT: usize = 8;

/// Case 4 by one reading.
///
/// # Errors
/// Those of [`run_by_reading`].
pub fn detection(
    reconstruction: &Reconstruction,
    reading: StepRule,
) -> Result<Detection, CaseError> {
    let result = run_by_reading(
        &Case::from_reconstruction(4, reconstruction.clone())?,
        reading,
    )?;
    let factors = result.unlimited_factors().to_vec();
    let faulty = FAULTY_ELEMENT - 1;
    let others = factors
        .iter()
        .enumerate()
        .filter(|(element, _)| *element != faulty)
        .map(|(_, factor)| *factor);
    Ok(Detection {
        reading,
        factor: factors[faulty],
        next: others.fold(f64::MIN, f64::max),
    })
}

/// Those of the reconstructed box.
pub static COLUMNS: LazyLock<Vec<ReadingColumn>> =
    LazyLock::new(|| all_columns(&Reconstruction::embedded().expect("a box")).expect("they run"));

/// Every published column of gages by every reading: Cases 1 to 3 pass by pass, then Tables 10 to 12.
///
/// # Errors
/// Those of [`run_by_reading`] and [`published_runs`].
pub fn all_columns(reconstruction: &Reconstruction) -> Result<Vec<ReadingColumn>, CaseError> {
    let mut columns = Vec::new();
    for reading in READINGS {
        for number in 1..=3 {
            let result = run_by_reading(
                &Case::from_reconstruction(number, reconstruction.clone())?,
                reading,
            )?;
            columns.extend(columns_of(&result)?);
        }
        let mut case = Case::from_reconstruction(PUBLISHED_CASE, reconstruction.clone())?;
        case.settings = case.settings_by(reading);
        for run in published_runs(&case)? {
            let table = [(7, 10), (5, 11), (3, 12)]
                .into_iter()
                .find(|(modes, _)| *modes == run.test_modes);
            let table = table.map_or(0, |(_, table)| table);
            let rms = [run.inner.frequency_rms, run.inner.shape_rms];
            let stage = format!("fem_{}", run.analysis_modes);
            columns.push(ReadingColumn::new(
                &case,
                (table, stage),
                &run.gages_in,
                run.iterations,
                rms,
            )?);
        }
    }
    Ok(columns)
}
