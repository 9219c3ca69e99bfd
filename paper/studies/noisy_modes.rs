//! Appendix B in use: the box's test modes with reproducible errors of measurement, correlated as they are and after Appendix B.
//! What is wrong with the gages each time says what its steps are worth.

use super::{PERCENT, RMS_PERCENT, noise_words};
use crate::prelude::*;
use corfem::method::appendix_b::Examination;

/// The case whose test modes get noise.
pub const NOISY_CASE: usize = 2;
/// Seeds of the noise, one run each.
pub const SEEDS: RangeInclusive<u64> = 1..=20;
/// Limits that no mode exceeds, to balance and orthogonalize without deleting.
const NO_LIMITS: MovementLimits = MovementLimits {
    balance: 0.999,
    frequency: f64::MAX,
    shape: f64::MAX,
};
/// Rigid-body motions that points which move along z can show.
const MOTIONS: [Motion; 3] = [Motion::Plunge, Motion::Roll, Motion::Pitch];

/// What a correlation with some test modes leads to; errors are fractions.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// Whether the last pass met the case's tolerances beside the modes given.
    pub converged: bool,
    /// Iterations of all passes.
    pub iterations: usize,
    /// Gages of the best pass, in, elements 1 to 15.
    pub gages_in: Vec<f64>,
    /// RMS gage error of the shear panels.
    pub shear_gage_rms: f64,
    /// RMS gage error of the membranes.
    pub membrane_gage_rms: f64,
    /// RMS gage error of all panels.
    pub gage_rms: f64,
    /// Error sum at these gages beside the modes given.
    pub error_sum: f64,
    /// RMS frequency error at these gages beside the modes without noise.
    pub true_frequency_rms: f64,
    /// RMS shape error at these gages beside the modes without noise.
    pub true_shape_rms: f64,
}

/// The correlations with the test modes of one seed.
#[derive(Debug, Clone, PartialEq)]
pub struct NoisyRun {
    /// The seed; none for modes without noise.
    pub seed: Option<u64>,
    /// Which modes the limits kept, from zero.
    pub kept: Vec<usize>,
    /// With the modes as they are.
    pub raw: Found,
    /// With all modes balanced where that applies, and orthogonal.
    pub orthogonal: Found,
    /// With the modes kept, balanced where that applies, and orthogonal.
    pub screened: Found,
}

/// The study.
#[derive(Debug, Clone, PartialEq)]
pub struct NoisyModes {
    /// Case number.
    pub case: usize,
    /// The noise.
    pub noise: Noise,
    /// Why the modes are not balanced: the stiffness against rigid-body motion relative to $\omega^2$ times its mass, above
    /// [`LARGEST_SUSPENSION_RATIO`]. None when they are.
    pub support_ratio: Option<f64>,
    /// Without noise, then one run for every seed.
    pub runs: Vec<NoisyRun>,
}

/// The study of all seeds.
pub fn study() -> &'static NoisyModes {
    static STUDY: LazyLock<NoisyModes> = LazyLock::new(|| {
        let case = Case::new(NOISY_CASE).expect("a case");
        noisy_modes(&case, Noise::USUAL, SEEDS).expect("it runs")
    });
    &STUDY
}

/// Correlates a case with noisy test modes, raw, orthogonal, and screened by the usual limits of Appendix B, for every
/// seed and once without noise.
///
/// Whether the modes are to be balanced is asked of [`balance`], with the first model: a structure that it refuses as
/// supported is held. Settings are the case's own, the step by the library's own rule, which finds the gages where the
/// reading of the case leaves some behind.
///
/// # Errors
/// Those of the model, of Appendix B and of the loops.
pub fn noisy_modes(
    case: &Case,
    noise: Noise,
    seeds: RangeInclusive<u64>,
) -> Result<NoisyModes, CaseError> {
    let model = case.model()?;
    let exact = case.test_modes()?;
    let first = model.matrices(&vec![1.0; model.parameters().len()])?;
    let point = |position| MeasuringPoint {
        position,
        direction: Vector3::z_axis(),
    };
    let points = dynamic_points(&case.reconstruction)?
        .into_iter()
        .map(point)
        .collect_vec();
    let rigid_body = &rigid_body_vectors(&MOTIONS, &points)?;
    let (supports, support_ratio) = match balance(&exact, &first.stiffness, &first.mass, rigid_body)
    {
        Ok(_) => (
            Supports::Free {
                stiffness: &first.stiffness,
                rigid_body,
            },
            None,
        ),
        Err(Error::Supported { ratio, .. }) => (Supports::Held, Some(ratio)),
        Err(error) => return Err(error.into()),
    };
    let found = |test: &Modes| correlated(case, &model, &exact, test);
    let run = |(seed, noise): (Option<u64>, Noise)| {
        let raw = with_noise(&exact, noise, seed.unwrap_or_default())?;
        let orthogonal = examine(&raw, &first.mass, supports, &NO_LIMITS)?.modes;
        let Examination { modes, kept, .. } =
            examine(&raw, &first.mass, supports, &MovementLimits::default())?;
        Ok(NoisyRun {
            seed,
            kept,
            raw: found(&raw)?,
            orthogonal: found(&orthogonal)?,
            screened: found(&modes)?,
        })
    };
    let none = Noise {
        shape: 0.0,
        frequency: 0.0,
    };
    let all = std::iter::once((None, none)).chain(seeds.map(|seed| (Some(seed), noise)));
    Ok(NoisyModes {
        case: case.number,
        noise,
        support_ratio,
        runs: all.map(run).collect::<Result<_, CaseError>>()?,
    })
}

fn correlated(
    case: &Case,
    model: &FiniteElementModel,
    exact: &Modes,
    test: &Modes,
) -> Result<Found, CaseError> {
    let ranges = model.factor_ranges()?;
    let settings = case.settings_by(StepRule::Matrix);
    let correlation = correlate(
        |factors| model.analyze(factors, test, None),
        &ranges,
        &settings,
        |_, _| true,
    )?;
    let factors = &correlation.best_factors;
    let gages = model.sizes(factors)?[..PANEL_COUNT].to_vec();
    let truth = model.analyze(factors, exact, None)?.exact().errors;
    let errors = gages
        .iter()
        .map(|gage| gage / TEST_GAGE - 1.0)
        .collect_vec();
    Ok(Found {
        converged: correlation.converged,
        iterations: correlation
            .passes
            .iter()
            .map(|pass| pass.inner.iterations.len())
            .sum(),
        shear_gage_rms: gage_rms(&case.panels, &gages, ElementKind::ShearPanel),
        membrane_gage_rms: gage_rms(&case.panels, &gages, ElementKind::Membrane),
        gage_rms: rms(&errors),
        error_sum: model.analyze(factors, test, None)?.exact().errors.sum(),
        true_frequency_rms: truth.frequency_rms(),
        true_shape_rms: truth.shape_rms(),
        gages_in: gages,
    })
}

/// A quantity of a correlation: its name, its unit, how it is written, and its value in that unit.
type Quantity = (&'static str, &'static str, Digits, fn(&Found) -> f64);

const GAGES: [Quantity; 3] = [
    ("shear", "%", PERCENT, |found| 100.0 * found.shear_gage_rms),
    ("membrane", "%", PERCENT, |found| {
        100.0 * found.membrane_gage_rms
    }),
    ("all", "%", PERCENT, |found| 100.0 * found.gage_rms),
];
const COURSE: [Quantity; 2] = [
    ("iterations", "", Digits::Fixed(0), |found| {
        found.iterations as f64
    }),
    ("error sum", "%", RMS_PERCENT, |found| {
        100.0 * found.error_sum
    }),
];
const TRUE_ERRORS: [Quantity; 2] = [
    ("frequency", "%", RMS_PERCENT, |found| {
        100.0 * found.true_frequency_rms
    }),
    ("shape", "%", RMS_PERCENT, |found| {
        100.0 * found.true_shape_rms
    }),
];

/// One of a run's three correlations.
type Side = fn(&NoisyRun) -> &Found;

/// The names of the test modes that they are given.
const SIDES: [(&str, Side); 3] = [
    ("Raw", |run| &run.raw),
    ("Orthogonal", |run| &run.orthogonal),
    ("Screened", |run| &run.screened),
];

/// The study's tables: the gages found, how the correlations went, and how far they end from the true modes; a row
/// without noise, one for every seed, and the median and the worst over the seeds.
pub fn noisy_tables(study: &NoisyModes) -> Vec<Table> {
    let noisy = study
        .runs
        .iter()
        .filter(|run| run.seed.is_some())
        .collect_vec();
    let count = |fits: &dyn Fn(&NoisyRun) -> bool| noisy.iter().filter(|run| fits(run)).count();
    let better = |side: Side| count(&|run| side(run).gage_rms < run.raw.gage_rms);
    let [raw, orthogonal, screened] = SIDES.map(|(_, side)| side);
    let converged = |side: Side| count(&|run| side(run).converged);
    let noise = format!(
        "Noise: {}. Orthogonal: by Appendix B. Screened: those that its limits keep.",
        noise_words(study.noise)
    );
    let balance = study.support_ratio.map_or_else(
        || "The modes are balanced first.".to_owned(),
        |ratio| {
            format!(
                "Balancing does not apply, because supports hold the structure: its stiffness against rigid-body motion is \
                {ratio:.0} times the inertia at the lowest frequency, where a suspension's is at most {LARGEST_SUSPENSION_RATIO}."
            )
        },
    );
    let gains = format!(
        "Of {} seeds, orthogonal modes give better gages than raw ones with {}, screened ones with {}.",
        noisy.len(),
        better(orthogonal),
        better(screened)
    );
    let met = format!(
        "Error sum: beside the test modes given. The case's tolerances are met with {} seeds raw, {} orthogonal, {} screened.",
        converged(raw),
        converged(orthogonal),
        converged(screened)
    );
    let kept = study.runs.iter().map(|run| Cell::count(run.kept.len()));
    vec![
        table(study, "gages", "RMS gage errors", &GAGES).notes([noise, balance, gains]),
        table(study, "course", "how the correlations went", &COURSE)
            .column("Modes kept", "", kept)
            .notes([met]),
        table(
            study,
            "truth",
            "RMS errors beside the modes without noise",
            &TRUE_ERRORS,
        ),
    ]
}

/// Quantities of all correlations run by run, and their median and largest value over the seeds.
fn table(study: &NoisyModes, name: &str, what: &str, quantities: &[Quantity]) -> Table {
    let title = format!("Case {} with noisy test modes: {what}", study.case);
    let labels = study.runs.iter().map(|run| {
        run.seed
            .map_or_else(|| "no noise".to_owned(), |seed| seed.to_string())
    });
    let mut table = Table::new(format!("noisy_{name}"), title, "Seed")
        .labels(labels)
        .labels(["median", "worst"]);
    for (name, unit, digits, value) in quantities {
        for (side_name, side) in SIDES {
            let values = study.runs.iter().map(|run| value(side(run)));
            let of_seeds = study
                .runs
                .iter()
                .filter(|run| run.seed.is_some())
                .map(|run| value(side(run)));
            let mut of_seeds = of_seeds.collect_vec();
            of_seeds.sort_by(f64::total_cmp);
            let last = of_seeds.len().checked_sub(1);
            let median = last.map(|last| 0.5 * (of_seeds[last / 2] + of_seeds[last.div_ceil(2)]));
            let all = values.map(Some).chain([median, of_seeds.last().copied()]);
            table = table.column(format!("{side_name} {name}"), unit, numbers(all, *digits));
        }
    }
    table
}
