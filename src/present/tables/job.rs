//! A job before and after: its sensors on the model, every doubt, the suspects, the parameters as the test sees them, and the
//! scatter over many runs.

use crate::files::error::FileError;
use crate::files::test_data::DIRECTIONS;
use crate::job::concern::{Grade, some};
use crate::job::localization::{by_factor, by_single_fit, unexplained};
use crate::job::metrics::coordinate_assurance;
use crate::job::{
    Concern, JobResult, LoadedJob, Method, PlacedSensor, PreparedJob, Trust, mean_deviation,
};
use crate::present::table::{Cell, Digits, Table, counted, numbers};
use crate::weighted::residuals::residuals;
use nalgebra::{DVector, Vector3};

/// Most parameters in the table of suspects.
pub const MOST_SUSPECTS: usize = 20;
/// Most changes of one kind in the table of where to measure next.
const MOST_CHANGES: usize = 3;

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
        let exact = &model.model.exact;
        let paired = exact
            .modes
            .shapes
            .select_columns(&exact.pairing.analysis_mode);
        let assurance = coordinate_assurance(&paired, &model.model.test.shapes);
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

/// The facts of a job's model: modes taken, mass and its center, parameters without bounds.
///
/// # Errors
/// The errors of the count of rigid-body modes.
pub fn model_table(prepared: &PreparedJob) -> Result<Table, FileError> {
    let source = &prepared.loaded.source;
    let (taken, rigid) = (
        prepared.analysis_modes,
        source.whole.rigid_bodies()?.rigid(),
    );
    let write = |at: &Vector3<f64>| {
        let [x, y, z] = <[f64; 3]>::from(*at).map(|own| Digits::Significant(6).write(own));
        format!("{x}, {y}, {z}")
    };
    let unbounded = source.whole.parameters().iter();
    let unbounded = unbounded.filter(|own| own.range.is_none());
    let unbounded: Vec<&str> = unbounded.map(|own| &own.name[..]).collect();
    let mut table = Table::new("model", "The model", "Fact").headings(["value"], "");
    let mut add = |fact: &str, value: String| table.row(fact, [Cell::Text(value)]);
    add(
        "modes taken",
        format!("the lowest {taken}, beside {rigid} rigid-body modes"),
    );
    add("mass along x, y, z", write(&source.mass));
    source
        .mass_center
        .iter()
        .for_each(|own| add("center of gravity", write(own)));
    add("parameters without bounds", some(&unbounded));
    Ok(table)
}

/// The inputs of a job: its files, its method for the factors, and the weights of the compared test modes.
///
/// # Errors
pub fn inputs_table(prepared: &PreparedJob, digest: &str) -> Table {
    let loaded = &prepared.loaded;
    let compare = &loaded.job.compare;
    let files: Vec<String> = loaded
        .job
        .files()
        .map(|file| file.display().to_string())
        .collect();
    let mut rows = vec![
        ("files".to_owned(), files.join(", ")),
        (
            "digest of them and of the job".to_owned(),
            digest.to_owned(),
        ),
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
    concerns_table("What to know before trusting this", trust, |_| true)
}

/// Doubts alone with what is left out, and remarks alone.
pub fn doubts_and_remarks(trust: &Trust) -> [Table; 2] {
    let is_remark = |concern: &Concern| concern.grade > Grade::LeftOut;
    let doubts = concerns_table("What stands against it", trust, |concern| {
        !is_remark(concern)
    });
    [
        doubts,
        concerns_table("What to know before trusting this", trust, is_remark),
    ]
}

fn concerns_table(title: &str, trust: &Trust, is_of_it: impl Fn(&Concern) -> bool) -> Table {
    let all = || trust.all().iter().filter(|concern| is_of_it(concern));
    let kind = |concern: &Concern| match concern.grade {
        Grade::Doubt if concern.is_accepted => "doubt, accepted",
        Grade::Doubt => "doubt",
        Grade::LeftOut => "left out",
        Grade::NotChecked => "not checked",
        Grade::Remark => "remark",
    };
    let has_doubt = all().any(|concern| concern.grade == Grade::Doubt);
    let standing = "A doubt names a mistake; --accept IDENTIFIER answers for it.";
    Table::new("trust", title, "Identifier")
        .labels(all().map(|own| &own.identifier))
        .column("Kind", "", all().map(|concern| Cell::text(kind(concern))))
        .column(
            "Finding",
            "",
            all().map(|concern| Cell::Sentence(concern.words.clone())),
        )
        .notes(has_doubt.then(|| standing.to_owned()))
}

/// Parameters that may be the one that is wrong, by how much of the test's chi-squared each alone can take away, at most
/// [`MOST_SUSPECTS`]; beside it the paper's unlimited factor of the first iteration. What keeps them from being ranked is a note.
pub fn suspects_table(prepared: &PreparedJob) -> Table {
    let title = "Suspects: what one parameter alone explains";
    let table = Table::new("suspects", title, "Parameter");
    if prepared.loaded.source.priors.is_empty() {
        return table.notes(["The job has no parameters."]);
    }
    suspects(prepared, table.clone())
        .unwrap_or_else(|why| table.notes([format!("Not ranked: {why}.")]))
}

fn suspects(prepared: &PreparedJob, table: Table) -> Result<Table, FileError> {
    let loaded = &prepared.loaded;
    let parameters = loaded.source.whole.parameters();
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
    let note = format!(
        "Evidence: how far half the weighted squared error, {:.3e} from {} measured numbers, falls when this parameter alone has \
        this factor: the logarithm of a likelihood ratio, in which less than about three says nothing. Where the first leaves much \
        more than half a unit a number, several are wrong, and it need not be among them. Modes are combined from {} of the first \
        model; far from one, factors are rough where these are few. Paper's factor: unlimited, of the first iteration.",
        unexplained(&first, &weights)?,
        residuals(&first, &weights)?.len(),
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
    let mut table = table.headings(["factor", "evidence", "paper's factor"], "");
    for suspect in shown() {
        let own = [suspect.factor, suspect.evidence];
        let cells = numbers(own, Digits::Significant(3));
        let slope = numbers([slope(suspect.parameter)], Digits::Fixed(2));
        table.row(&parameters[suspect.parameter].name, cells.chain(slope));
    }
    Ok(table
        .notes([note])
        .notes((!at_edge.is_empty()).then_some(edge))
        .notes((left > 0).then_some(less)))
}

/// Changes of a test that lower the deviations of the factors most, or raise them least, at most three of a kind. What keeps them from
/// being ranked is a note.
pub fn measurement_table(prepared: &PreparedJob) -> Table {
    let table = Table::new("next_measurement", "Where to measure next", "Test")
        .headings(["deviation", "largest"], "%")
        .headings(["parameter"], "");
    measurements(prepared, table.clone())
        .unwrap_or_else(|why| table.notes([format!("Not ranked: {why}.")]))
}

fn measurements(prepared: &PreparedJob, mut table: Table) -> Result<Table, FileError> {
    let next = prepared.next_measurement()?;
    let names: Vec<&str> = prepared.loaded.parameter_names().collect();
    let shown = next
        .changes
        .into_iter()
        .map(|own| own.into_iter().take(MOST_CHANGES));
    for (words, deviations) in shown.flatten() {
        let worst = DVector::from_column_slice(&deviations).imax();
        let both = [mean_deviation(&deviations), deviations[worst]].map(|own| 100.0 * own);
        let cells = numbers(both, Digits::Significant(3));
        table.row(words, cells.chain([Cell::text(names[worst])]));
    }
    let note = "Deviation: root mean square of the factors' standard deviations (of logarithms, with priors), by the slopes at the \
        first model. A new sensor is taken to read what the model says. Every reading has the noise that it has in this test, a fraction of its \
        largest one, and a new one that of its shape.";
    let is_ranked = !table.rows.is_empty();
    Ok(table.notes(is_ranked.then_some(note)).notes(next.unranked))
}
