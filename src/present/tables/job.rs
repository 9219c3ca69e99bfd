//! A job before and after: its sensors on the model, every doubt, the suspects, the parameters as the test sees them, and the
//! scatter over many runs.

use crate::files::error::FileError;
use crate::files::test_data::DIRECTIONS;
use crate::job::concern::Grade;
use crate::job::localization::{by_factor, by_single_fit};
use crate::job::metrics::coordinate_assurance;
use crate::job::{
    Concern, JobResult, Kind, LoadedJob, Method, PlacedSensor, PreparedJob, Study, Summary, Trust,
    Vary,
};
use crate::method::step::Bounds;
use crate::present::report::Report;
use crate::present::table::{Cell, Digits, Table, counted, numbers, percents};
use crate::weighted::identifiability::Identifiability;
use crate::weighted::intervals::MOST_FOLLOWED;
use crate::weighted::residuals::residuals;

/// Most parameters in the table of suspects.
pub const MOST_SUSPECTS: usize = 20;

/// Every sensor with its grid, direction and distance, and the coordinate modal assurance criterion (COMAC) of the first model and of
/// the corrected one there.
///
/// # Errors
/// The errors of [`coordinate_assurance`].
pub fn places_table(loaded: &LoadedJob, result: Option<&JobResult>) -> Result<Table, FileError> {
    let direction = |sensor: &PlacedSensor| {
        let sign = if sensor.sign < 0.0 { "-" } else { "" };
        // An axis of the test's own coordinate system is shown by its components.
        let own = || {
            format!(
                " ({:.2} {:.2} {:.2})",
                sensor.axis.x, sensor.axis.y, sensor.axis.z
            )
        };
        let own = if sensor.axis.amax() < 1.0 {
            own()
        } else {
            String::new()
        };
        Cell::text(format!("{sign}{}{own}", DIRECTIONS[sensor.direction]))
    };
    let placed = || loaded.placed.iter();
    let mut table = Table::new("sensors", "Sensors on the model", "Sensor")
        .labels(placed().map(|sensor| &sensor.name))
        .column("grid", "", placed().map(|sensor| Cell::count(sensor.grid)))
        .column("direction", "", placed().map(direction))
        .column(
            "distance",
            "",
            numbers(placed().map(|sensor| sensor.distance), Digits::Fixed(3)),
        );
    let models = result
        .into_iter()
        .flat_map(|result| [&result.found.first, &result.found.last])
        .filter(|model| model.model.test.len() > 0);
    for (name, model) in ["first COMAC", "corrected COMAC"].into_iter().zip(models) {
        let pairs: Vec<Option<usize>> = model
            .model
            .exact
            .pairing
            .analysis_mode
            .iter()
            .copied()
            .map(Some)
            .collect();
        let assurance = coordinate_assurance(
            &model.model.exact.modes.shapes,
            &model.model.test.shapes,
            &pairs,
        )?;
        table = table.column(
            name,
            "",
            numbers(assurance.iter().copied(), Digits::Fixed(3)),
        );
    }
    let all = loaded.data.sensors.len();
    if all > loaded.placed.len() {
        table.notes.push(format!(
            "{} of the test's {all} sensors are not used.",
            all - loaded.placed.len()
        ));
    }
    Ok(table)
}

/// The inputs of a job: its files, its method for the factors, and the weights of the compared test modes.
///
/// # Errors
pub fn inputs_table(prepared: &PreparedJob) -> Table {
    let loaded = &prepared.loaded;
    let compare = &loaded.job.compare;
    let files: Vec<String> = loaded
        .job
        .files()
        .map(|file| file.display().to_string())
        .collect();
    let mut rows = vec![
        ("files".to_owned(), files.join(", ")),
        ("method".to_owned(), compare.method.name().to_owned()),
    ];
    if compare.method == Method::GaussNewton {
        rows.push(("starts".to_owned(), compare.starts.unwrap_or(1).to_string()));
        rows.push(("seed".to_owned(), compare.seed.to_string()));
    }
    let weights = prepared.weights();
    let digits = Digits::Significant(4);
    rows.extend(prepared.compared().zip(&weights).map(|(mode, weight)| {
        let [frequency, shape] = [weight.frequency, weight.shape].map(|it| digits.write(it));
        (
            format!("weights of test mode {}", mode + 1),
            format!("frequency {frequency}, shape {shape}"),
        )
    }));
    let (labels, words): (Vec<String>, Vec<String>) = rows.into_iter().unzip();
    Table::new("inputs", "What it was run with", "Input")
        .labels(labels)
        .column("Value", "", words.into_iter().map(Cell::Sentence))
}

/// Doubts about a job or its result, and remarks, most important first.
pub fn trust_table(trust: &Trust) -> Table {
    let all = || trust.all().iter();
    let kind = |concern: &Concern| match concern.grade() {
        Grade::Doubt if concern.is_accepted => "doubt, accepted",
        Grade::Doubt => "doubt",
        Grade::LeftOut => "left out",
        Grade::Remark => "remark",
    };
    let standing = "A doubt names a mistake; --accept IDENTIFIER answers for it.";
    Table::new("trust", "What to know before trusting this", "Identifier")
        .labels(all().map(Concern::identifier))
        .column("Kind", "", all().map(|concern| Cell::text(kind(concern))))
        .column(
            "Finding",
            "",
            all().map(|concern| Cell::Sentence(concern.words())),
        )
        .notes(trust.has_doubt().then(|| standing.to_owned()))
}

/// Parameters that may be the one that is wrong, by how much of the test's chi-squared each alone can take away, at most
/// [`MOST_SUSPECTS`]; beside it the paper's unlimited factor of the first iteration.
///
/// # Errors
/// The errors of the rankings.
pub fn suspects_table(prepared: &PreparedJob) -> Result<Table, FileError> {
    let loaded = &prepared.loaded;
    let parameters = loaded.source.whole.parameters();
    let title = "Suspects: what one parameter alone explains";
    if parameters.is_empty() {
        return Ok(Table::new("suspects", title, "Parameter")
            .notes(["The job has no parameters.".to_owned()]));
    }
    let (far, first) = prepared.far_from_first()?;
    let weights = far.weights();
    let suspects = by_single_fit(&first, &weights)?;
    // The paper's step needs shapes.
    let slopes = match prepared.alone() {
        [] => by_factor(
            &first.model,
            &loaded.job.correlation.for_modes(far.modes.len()).inner,
        )?,
        _ => Vec::new(),
    };
    let residuals = residuals(&first, &weights)?;
    let note = format!(
        "Evidence: how far half the weighted squared error, {:.3e} from {} measured numbers, falls when this parameter alone has \
        this factor: the logarithm of a likelihood ratio, in which less than about three says nothing. Where the first leaves much \
        more than half a unit a number, several are wrong, and it need not be among them. Modes are combined from {} of the first \
        model; far from one, factors are rough where these are few. Paper's factor: unlimited, of the first iteration.",
        0.5 * residuals.norm_squared(),
        residuals.len(),
        first.model.exact.modes.len(),
    );
    let left = suspects.len().saturating_sub(MOST_SUSPECTS);
    let less = format!(
        "{} less.",
        counted(left, "parameter explains", "parameters explain")
    );
    let shown = || suspects.iter().take(MOST_SUSPECTS);
    let at_edge: Vec<&str> = shown()
        .filter(|suspect| suspect.is_at_edge())
        .map(|suspect| &parameters[suspect.parameter].name[..])
        .collect();
    let edge = format!(
        "At the edge of the search, beyond which more may be explained: {}.",
        at_edge.join(", ")
    );
    let slope = |parameter: usize| {
        slopes
            .iter()
            .find(|slope| slope.parameter == parameter)
            .map(|slope| slope.factor)
    };
    Ok(Table::new("suspects", title, "Parameter")
        .labels(shown().map(|suspect| &parameters[suspect.parameter].name))
        .column(
            "factor",
            "",
            numbers(
                shown().map(|suspect| suspect.factor),
                Digits::Significant(3),
            ),
        )
        .column(
            "evidence",
            "",
            numbers(
                shown().map(|suspect| suspect.evidence),
                Digits::Significant(3),
            ),
        )
        .column(
            "paper's factor",
            "",
            numbers(
                shown().map(|suspect| slope(suspect.parameter)),
                Digits::Fixed(2),
            ),
        )
        .notes([note])
        .notes((!at_edge.is_empty()).then_some(edge))
        .notes((left > 0).then_some(less)))
}

/// The parameters as the test sees them, at the first model and at the best factors: 95 % intervals, and the blind and the parallel
/// ones.
pub fn seen_table(result: &JobResult) -> Table {
    let loaded = &result.found.prepared.loaded;
    let names: Vec<&str> = loaded.parameter_names().collect();
    let (before, after) = (&result.seen_first, &result.seen);
    let intervals = &result.intervals;
    let apart = format!(
        "Of {}, the test tells {} apart (singular values {:.3e} to {:.3e}). Deviations are those of the logarithm of the factor, \
         from the standard deviations of the measurement{}{}.",
        counted(names.len(), "parameter", "parameters"),
        after.subset.len(),
        after.singular_values.first().copied().unwrap_or_default(),
        after.singular_values.last().copied().unwrap_or_default(),
        match &result.trust.about(Kind::AssumedDeviations)[..] {
            [] => String::new(),
            assumed => format!(", assumed: {}", assumed.join(" and ")),
        },
        match result.misfit.widening() {
            1.0 => String::new(),
            widening => format!(", at the best factors {widening:.2} times as large"),
        },
    );
    let ends = |end: fn(&Bounds) -> f64| {
        let ends = intervals
            .iter()
            .map(move |interval| interval.as_ref().ok().map(end));
        numbers(ends, Digits::Fixed(4))
    };
    let withheld = intervals.iter().filter(|interval| interval.is_err());
    let withheld = match withheld.count() {
        0 => None,
        count => Some(format!(
            "{} without an interval; the remarks say why.",
            counted(count, "parameter", "parameters")
        )),
    };
    let is_by_slope = names.len() > MOST_FOLLOWED && intervals.iter().any(Result::is_ok);
    let by_slope =
        format!("Intervals of more than {MOST_FOLLOWED} parameters are by slopes alone.");
    let learned = after.learned.iter().map(|learned| 1.0 - learned);
    let deviations =
        |seen: &Identifiability| percents(seen.deviations.clone(), Digits::Significant(3));
    Table::new("seen", "What the test sees of the parameters", "Parameter")
        .labels(&names)
        .column(
            "factor",
            "",
            numbers(result.found.factors.iter().copied(), Digits::Fixed(4)),
        )
        .column("least (95 %)", "", ends(|interval| interval.lower))
        .column("most (95 %)", "", ends(|interval| interval.upper))
        .column("deviation", "%", deviations(after))
        .column("deviation before", "%", deviations(before))
        .column("prior's share", "%", percents(learned, Digits::Fixed(1)))
        .notes([apart])
        .notes(withheld)
        .notes(is_by_slope.then_some(by_slope))
        .filled()
}

/// The minima that noise allows, one column each, with their chi-squared, the number of starts that end there, and their factors;
/// none for a single start.
pub fn minima_table(report: &Report) -> Option<Table> {
    let minima = || report.minima.iter();
    let mut table = Table::new("minima", "Minima that noise allows", "Minimum")
        .headings((1..=minima().count()).map(|place| place.to_string()), "")
        .notes([format!(
            "{} failed. Any other that ends in none of them came to no minimum, or to one that this test excludes.",
            counted(report.failed_starts(), "start", "starts")
        )]);
    let chi_squared = minima().map(|minimum| minimum.chi_squared);
    table.row("chi-squared", numbers(chi_squared, Digits::Fixed(2)));
    let starts = minima().map(|minimum| Cell::count(minimum.starts));
    table.row("starts", starts);
    for (e, name) in report.parameters.iter().enumerate() {
        let factors = minima().map(|minimum| minimum.factors[e]);
        table.row(name, numbers(factors, Digits::Fixed(4)));
    }
    minima().next().map(|_| table)
}

/// Mean, standard deviation and quantiles of every factor over the samples that did not fail.
pub fn study_table(study: &Study, summary: &Summary) -> Table {
    let name = |vary: &Vary| match vary {
        Vary::Noise => "noise on the test",
        Vary::Start => "the first point",
        Vary::Subset => "sensors or modes left out",
    };
    let (
        Summary {
            spreads,
            within,
            outside,
            failed,
        },
        vary,
    ) = (summary, study.vary.iter().map(name));
    let count = within + outside + failed.len();
    let note = format!(
        "{}, seed {}, with {}: {within} within tolerance, {outside} not, {} failed.",
        counted(count, "sample", "samples"),
        study.seed,
        vary.collect::<Vec<_>>().join(" and "),
        failed.len(),
    );
    let why = |first| {
        format!("Failed samples do not count; --sample {first} says why sample {first} failed.")
    };
    let mut table = Table::new(
        "study",
        format!("{}: factors over many runs", study.prepared.loaded.title),
        "Parameter",
    )
    .headings(["mean", "deviation", "2.5 %", "median", "97.5 %"], "")
    .headings(["at a bound"], "samples")
    .notes([note])
    .notes(failed.first().map(why));
    for (name, spread) in spreads {
        let spread = spread.iter().flat_map(|spread| {
            // Factors that a bound holds have no scatter of their own.
            let deviation = (spread.at_bound < spread.count).then_some(spread.deviation);
            let [low, median, high] = spread.quantiles.map(Some);
            let all = [Some(spread.mean), deviation, low, median, high];
            numbers(all, Digits::Fixed(4)).chain([Cell::count(spread.at_bound)])
        });
        table.row(name, spread);
    }
    table
}
