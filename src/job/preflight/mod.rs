//! A pre-flight: what looks wrong with model and test before the first step, each finding with its evidence.
//!
//! The loops fit gages to whatever data they get: with one reversed sensor the gages are silently wrong. So a job's test is judged
//! at its sensors by the modes of the whole model: each common mistake in the readings is undone on trial, and the one that
//! explains the shapes best is named, if it does so well enough (`readings.rs` has the equations). Frequencies tell modes of like shapes
//! apart there; their ratios are judged after shapes have been paired.

mod frequencies;
mod readings;
mod shapes;
mod words;

pub use frequencies::{CommonFactor, FACTORS, FrequenciesExchanged, NamedFactor};
pub use readings::SeenModes;
pub use shapes::Change;
pub use words::Names;

use crate::job::concern::{Check, Concern};
use crate::method::error::Error;
use crate::method::linear_algebra::{symmetric_eigen, symmetric_part};
use crate::method::modes::Modes;
use crate::method::outer_loop::Settings;
use crate::method::sorting::pair_modes;
use crate::method::step::Bounds;
use crate::sparse::modal_assurance;
use crate::weighted::noise::Noise;
use nalgebra::DMatrix;
use readings::{FALSE_ALARMS, LEAST, explain};
use shapes::changed;
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Modal assurance of two test modes from which they are nearly one shape. Two modes of the box, whose masses differ
/// several hundredfold, have 0.75 with noise of 1 %, and a mode measured twice has 0.99. It does not depend on the
/// order and signs of the points, so that a mistake in these does not look like a mode measured twice.
pub const NEARLY_SAME: f64 = 0.9;
/// Singular value of the test shapes, of unit length, below which the points do not distinguish them: orthogonal shapes have one.
pub const LEAST_SINGULAR: f64 = 0.3;
/// Tolerance beyond which a percentage was probably meant: a fifth of the frequency, or of the largest component.
pub const LARGEST_TOLERANCE: f64 = 0.2;

/// Reason why test modes have no partners that could be compared.
pub(in crate::job) const FEWER: &str = "the model has fewer modes than the test";

/// Two test modes of nearly the same shape.
struct Copies {
    modes: [usize; 2],
    assurance: f64,
    /// True if noise alone, in all but one of a thousand tests, makes one mode differ so much from itself.
    /// None if it makes one mode of shapes at right angles as well.
    is_measured_twice: Option<bool>,
}

impl Copies {
    /// Two test modes of a modal assurance $m$, with the sum of the squares of their deviations. A reading of either differs from the
    /// other's by noise of both, so that with the first shape $a$, of unit largest component,
    ///
    /// $$ \chi^2 = \frac{\lvert a \rvert^2 (1 - m)}{\sigma_v^2} + \frac{\ln^2 (f_2/f_1)}{\sigma_f^2} $$
    ///
    /// has as many degrees of freedom as there are sensors: one less for the scale of the shapes, one more for the frequency.
    fn new(test: &Modes, modes: [usize; 2], assurance: f64, noise: [Noise; 2]) -> Self {
        let ([a, b], hertz) = (modes, test.frequencies_hz());
        let frequency_ratio = hertz[b] / hertz[a];
        let sum = |of: fn(&Noise) -> f64| noise.iter().map(|own| of(own).powi(2)).sum::<f64>();
        let shape = test.shapes.column(a);
        let size = shape.norm_squared() / shape.amax().powi(2);
        let unlike = size / sum(|own| own.shape);
        let chi_squared =
            unlike * (1.0 - assurance) + frequency_ratio.ln().powi(2) / sum(|own| own.frequency);
        let law = ChiSquared::new(shape.len() as f64);
        let largest = law.map_or(0.0, |law| law.inverse_cdf(1.0 - FALSE_ALARMS));
        Self {
            modes,
            assurance,
            is_measured_twice: (unlike > largest).then_some(chi_squared <= largest),
        }
    }

    /// A doubt where a mode was measured twice, and else a remark: few sensors may see two modes alike.
    fn concern(&self, names: &Names) -> Concern {
        let modes = self.modes.map(|mode| names.mode(mode));
        let words = format!(
            "Test modes {} and {} are nearly the same shape, modal assurance {:.3}",
            modes[0], modes[1], self.assurance
        );
        let check = Check::ModesMeasuredTwice;
        match self.is_measured_twice {
            None => Concern::not_checked(check, "by these deviations all shapes are alike"),
            Some(true) => Concern::doubt(check, "same-", &modes, words + "; measured twice?"),
            Some(false) => Concern::remark(check, "same-", &modes, words + "."),
        }
    }
}

/// The places of test modes without near copies of earlier ones, and each such copy.
fn distinct_shapes(test: &Modes, noise: &[Noise]) -> Result<(Vec<usize>, Vec<Copies>), Error> {
    let assurance = modal_assurance(&test.shapes, &test.shapes)?;
    let own = |mode: usize| noise.get(mode).copied().unwrap_or(LEAST);
    let (mut apart, mut copies) = (Vec::<usize>::new(), Vec::new());
    for b in 0..test.len() {
        let Some(&a) = apart.iter().find(|&&a| assurance[(a, b)] >= NEARLY_SAME) else {
            apart.push(b);
            continue;
        };
        copies.push(Copies::new(
            test,
            [a, b],
            assurance[(a, b)],
            [own(a), own(b)],
        ));
    }
    Ok((apart, copies))
}

/// Concerns about the frequencies of test modes (at these places) and of their partners.
fn judge_frequencies(
    test: &Modes,
    analysis_hz: &[f64],
    partners: &[usize],
    places: &[usize],
    names: &Names,
) -> Vec<Concern> {
    let mut test = test.frequencies_hz();
    let analysis: Vec<f64> = partners.iter().map(|&mode| analysis_hz[mode]).collect();
    // Modes are numbered as their frequencies ascend: only where these do not may two be exchanged.
    let found = frequencies::exchanged(&test, &analysis)
        .filter(|found| test[found.modes[0]] > test[found.modes[1]]);
    let exchanged = found.map(|found| {
        let [a, b] = found.modes;
        test.swap(a, b);
        let modes = found.modes.map(|mode| names.mode(places[mode]));
        let words = format!(
            "Frequencies of test modes {} and {} exchanged? It would lower the mean deviation of the ratios from {:.1} to {:.1} %.",
            modes[0], modes[1], 100.0 * found.before, 100.0 * found.after
        );
        Concern::doubt(Check::OrderOfFrequencies, "frequencies-exchanged-", &modes, words)
    });
    let common = frequencies::common_factor(&test, &analysis).map(|common| {
        let why = common
            .named
            .map_or("by no mistake known here.".to_owned(), |own| {
                format!("near {}: {}?", own.name, own.mistake)
            });
        let words = format!(
            "Test frequencies are {:.4} times the model's, {why}",
            common.median
        );
        Concern::doubt(Check::CommonFactor, "common-factor", &[""; 0], words)
    });
    exchanged.into_iter().chain(common).collect()
}

/// Checks a test, with the deviations of every mode or none, against a model's modes at its sensors; no condensed model is needed, so structures
/// may hang free.
///
/// # Errors
/// The errors of the comparison of shapes.
pub fn preflight_at_sensors(
    seen: &SeenModes,
    (test, noise): (&Modes, &[Noise]),
    settings: &Settings,
    ranges: &[Option<Bounds>],
    names: &Names,
) -> Result<Vec<Concern>, Error> {
    // A mode measured twice has no second partner. A sensor that drowns all others makes shapes alike, but not frequencies.
    let copies = match test.shapes.nrows() {
        1 => Vec::new(),
        _ => distinct_shapes(test, noise)?.1,
    };
    let is_copy = |mode: &usize| {
        let mut twice = copies
            .iter()
            .filter(|own| own.is_measured_twice == Some(true));
        twice.any(|copies| copies.modes[1] == *mode)
    };
    let once: Vec<usize> = (0..test.len()).filter(|mode| !is_copy(mode)).collect();
    let of_once = once.iter().filter_map(|&mode| noise.get(mode).copied());
    let of_once: Vec<Noise> = of_once.collect();
    let told = explain(seen, (&test.select(&once), &of_once))?;
    let suspected = told.mistake;
    let mut test = test.clone();
    if let Some((change, _)) = &suspected {
        test.shapes = changed(&test.shapes, change);
    }
    let mut concerns: Vec<Concern> = Vec::new();
    concerns.extend(
        told.silent
            .map(|reason| Concern::not_checked(Check::Readings, reason)),
    );
    // At one sensor all shapes are alike, and say nothing of partners.
    let alike = "at one sensor all shapes are alike";
    let is_one = test.shapes.nrows() == 1;
    let (places, copies) = match is_one {
        true => ((0..test.len()).collect(), Vec::new()),
        false => distinct_shapes(&test, noise)?,
    };
    concerns.extend(is_one.then(|| Concern::not_checked(Check::ModesMeasuredTwice, alike)));
    concerns.extend(copies.iter().map(|copies| copies.concern(names)));
    let test = test.select(&places);
    if is_one || test.len() > seen.modes.len() {
        let reason = if is_one { alike } else { FEWER };
        let both = [Check::CommonFactor, Check::OrderOfFrequencies];
        concerns.extend(both.map(|check| Concern::not_checked(check, reason)));
    } else {
        let analysis = seen.modes.frequencies_hz();
        let judge =
            |partners: &[usize]| judge_frequencies(&test, &analysis, partners, &places, names);
        let likely = |place: &usize| {
            let at = once.binary_search(place).ok()?;
            Some(told.partners.as_ref()?[at])
        };
        let assurance = modal_assurance(&seen.modes.shapes, &test.shapes)?;
        let mut found = judge(&pair_modes(&assurance)?.analysis_mode);
        // Shapes of two modes may be one at the sensors: what the likely partners do not say too is their mistake.
        if let Some(likely) = places.iter().map(likely).collect::<Option<Vec<_>>>() {
            let is_order = |own: &Concern| own.check == Check::OrderOfFrequencies;
            let also: Vec<bool> = judge(&likely).iter().map(is_order).collect();
            found.retain(|own| also.contains(&is_order(own)));
        }
        concerns.extend(found);
    }
    concerns.extend(suspected.map(|(change, evidence)| change.concern(evidence, names)));
    if test.len() > test.shapes.nrows() {
        let mut unit = test;
        unit.shapes.column_iter_mut().for_each(|mut shape| {
            shape.normalize_mut();
        });
        concerns.extend(too_many_modes(&unit.shapes)?);
    }
    concerns.extend(check_settings(settings, ranges, names));
    Ok(concerns)
}

/// A doubt about a setting that looks like percent.
pub(in crate::job) fn percent(setting: &str, value: f64) -> Concern {
    let words = format!(
        "Setting {setting} is {value}, that is {} %: a percentage where a fraction is meant?",
        100.0 * value
    );
    Concern::doubt(Check::Settings, "percent-", &[setting], words)
}

/// A remark on test modes, whose shapes have unit length, that the points do not distinguish.
fn too_many_modes(shapes: &DMatrix<f64>) -> Result<Option<Concern>, Error> {
    let (points, modes) = shapes.shape();
    let overlap = symmetric_part(&shapes.tr_mul(shapes));
    let (squares, _) = symmetric_eigen("overlap of test modes", &overlap)?;
    let smallest = squares[0].max(0.0).sqrt();
    let least = LEAST_SINGULAR.powi(2);
    let distinct = squares.iter().filter(|square| **square >= least).count();
    let words = format!(
        "{modes} test modes at {points} points: only {distinct} are told apart, the smallest singular value is {smallest:.3}."
    );
    Ok((distinct < modes)
        .then(|| Concern::remark(Check::NumberOfModes, "too-many-modes", &[""; 0], words)))
}

/// Doubts about tolerances that look like percent and about bounds.
pub(in crate::job) fn check_settings(
    settings: &Settings,
    ranges: &[Option<Bounds>],
    names: &Names,
) -> Vec<Concern> {
    let tolerances = [
        ("inner.tolerance", settings.inner.tolerance),
        ("later_inner_tolerance", settings.later_inner_tolerance),
        ("error_sum_tolerance", settings.error_sum_tolerance),
        ("frequency_tolerance", settings.frequency_tolerance),
        ("shape_tolerance", settings.shape_tolerance),
    ];
    let large = tolerances
        .into_iter()
        .filter(|(_, value)| *value > LARGEST_TOLERANCE);
    let percent = large.map(|(setting, value)| percent(setting, value));
    let excluding = ranges.iter().enumerate().filter_map(|(parameter, range)| {
        let Bounds { lower, upper } = range.filter(|range| !range.holds_start())?;
        let parameter = names.parameter(parameter);
        let words = format!("Bounds on the factor of parameter {parameter}, {lower} to {upper}, exclude its first value.");
        Some(Concern::doubt(Check::Settings, "excludes-start-", &[parameter], words))
    });
    percent.chain(excluding).collect()
}
