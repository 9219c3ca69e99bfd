//! Concerns, which lower the trust in a job's result: each has a kind, names and numbers, and one table makes it a sentence.

use crate::files::error::FileError;
use serde::ser::SerializeStruct;
use serde::{Serialize, Serializer};
use sha2::{Digest, Sha256};

/// A kind of fact that a reader must know before trusting a result, in the order in which all outputs say them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs, reason = "the table below has a sentence for each")]
pub enum Kind {
    Interrupted,
    Mechanisms,
    FreeByDigits,
    MeasuredTwice,
    FrequenciesExchanged,
    NamedFactor,
    UnnamedFactor,
    Reversed,
    Exchanged,
    Reordered,
    Gain,
    Dead,
    Direction,
    Percent,
    ExcludesStart,
    UnitOfPlaces,
    OtherGrid,
    NumberedOtherwise,
    UnitsDisagree,
    NoPair,
    BeyondReach,
    NegativePart,
    NotPart,
    Twin,
    SumOfStiffness,
    SumOfMass,
    Unlike,
    PartnerTaken,
    WouldHarm,
    OutOfReach,
    NotChecked,
    PartNotChecked,
    Parallel,
    Dependent,
    Undecided,
    Joined,
    Blind,
    MostlyPrior,
    AtBound,
    AssumedDeviations,
    NotUsed,
    NotSelected,
    RigidModes,
    AnalysisModes,
    Mass,
    MassByDirection,
    CenterOfMass,
    ChiSquared,
    Misfit,
    BelowNoise,
    HeldOut,
    HeldOutFrequency,
    Unanswered,
    UnseenModes,
    PartsWithoutSensor,
    LooseWithoutSensor,
    HeldDirection,
    SuspensionHidden,
    LargeDeviation,
    FarApart,
    Alike,
    TooManyModes,
    Unbounded,
    FrequenciesAlone,
    CloseModes,
    OwnWeights,
    Covariance,
    Variances,
    Drift,
    Complex,
    NotInEveryMode,
    DatasetsNotRead,
    UnitsOfTest,
}

/// The effect of a concern on a result.
#[doc(hidden)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Grade {
    /// It names a mistake.
    Doubt,
    /// A selected test mode is not compared.
    LeftOut,
    /// It limits what is known.
    Remark,
}

/// The table: what a concern of each kind does, its identifier, and its sentence.
///
/// `{a}` and `{b}` are the first names that a concern is about, `{all}` all of them, `{rest}` all but the first, `{some}` the first eight, `{and}` joins them by that
/// word, `{id}` by hyphens; `{x}`, `{y}`, `{z}` and `{w}` are its numbers, `{x.3}` with three decimals, `{xe}` as a power of ten, `{x6}` with
/// six significant digits.
const TABLE: [(Kind, Grade, &str, &str); 73] = {
    use Grade::{Doubt, LeftOut, Remark};
    use Kind::*;
    [
        (
            Interrupted,
            Remark,
            "interrupted",
            "Stopped by request; these are the best factors so far.",
        ),
        (
            Mechanisms,
            Doubt,
            "mechanisms",
            "Motions of {some} are none of a rigid body, and the digits of the stiffness do not tell that anything resists them: mechanisms, or springs too soft for it. They count as free; model.rigid_bodies decides.",
        ),
        (
            FreeByDigits,
            Doubt,
            "free-by-digits",
            "Free by {a} of the stiffness: {x}; a suspension below {ye} Hz would not show. Places of the rows, or model.rigid_bodies, decide.",
        ),
        (
            MeasuredTwice,
            Doubt,
            "same-{id}",
            "Test modes {and} are nearly the same shape, modal assurance {x.3}; measured twice?",
        ),
        (
            FrequenciesExchanged,
            Doubt,
            "frequencies-exchanged-{id}",
            "Frequencies of test modes {and} exchanged? It would lower the mean deviation of the ratios from {x.1} to {y.1} %.",
        ),
        (
            NamedFactor,
            Doubt,
            "common-factor",
            "Test frequencies are {x.4} times the model's, near {a}: {b}?",
        ),
        (
            UnnamedFactor,
            Doubt,
            "common-factor",
            "Test frequencies are {x.4} times the model's, by no mistake known here.",
        ),
        (
            Reversed,
            Doubt,
            "reversed-{id}",
            "Sensor {a} reversed? {likely}",
        ),
        (
            Exchanged,
            Doubt,
            "exchanged-{id}",
            "Sensors {and} exchanged? {likely}",
        ),
        (
            Reordered,
            Doubt,
            "reordered",
            "Points in another order ({all})? {likely}",
        ),
        (
            Gain,
            Doubt,
            "gain-{id}",
            "Sensor {a} reads {y.3} times too much? {likely}",
        ),
        (Dead, Doubt, "dead-{id}", "Sensor {a} dead? {likely}"),
        (
            Direction,
            Doubt,
            "direction-{a}",
            "Sensor {a} measures along {b}? {likely}",
        ),
        (
            Percent,
            Doubt,
            "percent-{a}",
            "Setting {a} is {x}, that is {y} %: a percentage where a fraction is meant?",
        ),
        (
            ExcludesStart,
            Doubt,
            "excludes-start-{id}",
            "Bounds on the factor of parameter {a}, {x} to {y}, exclude its first value.",
        ),
        (
            UnitOfPlaces,
            Doubt,
            "unit-of-places",
            "The sensors' places span {x.1} times what the model's do: another unit of length?",
        ),
        (
            OtherGrid,
            Doubt,
            "other-grid",
            "By their places sensors {some} are nearer to other grids than to those that they name; is a place, a grid or a unit of length wrong? sensors.distance says how far a sensor may be.",
        ),
        (
            NumberedOtherwise,
            Doubt,
            "numbered-otherwise",
            "The test's file numbers its modes {some}; here they are counted from 1 in the order of the file, in test.modes too.",
        ),
        (
            UnitsDisagree,
            Doubt,
            "units-disagree",
            "The test's file says that it is in {a}, of {y6} to a meter, but its factor of length is {x6}.",
        ),
        (
            NoPair,
            Doubt,
            "no-pair",
            "No test mode resembles a mode of the model: another structure, other sensors, or several mistakes at once?",
        ),
        (
            BeyondReach,
            Doubt,
            "beyond-reach-{a}",
            "Test mode {a} has {x} Hz, and its partner, mode {b} of the first model, can have {y.4} to {z.4} Hz within the bounds and priors of the parameters: another mode, or another unit?",
        ),
        (
            NegativePart,
            Doubt,
            "negative-{id}",
            "The matrix of parameter \"{a}\" has negative energy, more than its digits explain.",
        ),
        (
            NotPart,
            Doubt,
            "not-part-{id}",
            "The matrix of parameter \"{a}\" is not part of the first model's, which without it has negative energy.",
        ),
        (
            Twin,
            Doubt,
            "twin-{id}",
            "Parameters \"{a}\" and \"{b}\" have the same matrix.",
        ),
        (
            SumOfStiffness,
            Doubt,
            "sum-of-stiffness",
            "The parameters' matrices together are more than the first stiffness, most by {some}: is a part in two of them?",
        ),
        (
            SumOfMass,
            Doubt,
            "sum-of-mass",
            "The parameters' matrices together are more than the first mass, most by {some}: is a part in two of them?",
        ),
        (
            Unlike,
            LeftOut,
            "not-compared-{a}",
            "Test mode {a} is not compared: it resembles no mode of the model (modal assurance {x.2} at most).",
        ),
        (
            PartnerTaken,
            LeftOut,
            "not-compared-{a}",
            "Test mode {a} is not compared: the mode of the model that it resembles belongs to another test mode (modal assurance \
             {x.2} at most).",
        ),
        (
            WouldHarm,
            LeftOut,
            "not-compared-{a}",
            "Test mode {a} is not compared: it resembles a mode of the model (modal assurance {x.2}), and compared it makes the others \
             worse.",
        ),
        (
            OutOfReach,
            LeftOut,
            "not-compared-{a}",
            "Test mode {a} is not compared: no mode of the model that it resembles (modal assurance {x.2} at most) can have its frequency within the bounds and priors of the parameters.",
        ),
        (
            NotChecked,
            Remark,
            "not-checked-{b}",
            "Not checked: {rest}, for {a}.",
        ),
        (
            PartNotChecked,
            Remark,
            "part-not-checked-{a}",
            "Whether parameter \"{a}\" is part of the first model was not checked: {b}.",
        ),
        (
            Parallel,
            Remark,
            "parallel-{id}",
            "The test cannot tell {and} apart; only their combination is known.",
        ),
        (
            Dependent,
            Remark,
            "dependent-{id}",
            "What {a} does to the test the others of {and} do together; only combinations of them are known.",
        ),
        (
            Undecided,
            Remark,
            "undecided",
            "Shapes do not decide which modes of the model are those of test modes {all}; they are paired by their \
             frequencies.",
        ),
        (
            Joined,
            Remark,
            "joined",
            "Test modes left out at first and compared since: {all}. The passes shown are those since.",
        ),
        (
            Blind,
            Remark,
            "blind",
            "Hardly seen by the test, and so not to be trusted: {some}.",
        ),
        (
            MostlyPrior,
            Remark,
            "mostly-prior",
            "Known more from the prior than from the test: {some}.",
        ),
        (AtBound, Remark, "at-bound", "At a bound: {some}."),
        (
            AssumedDeviations,
            Remark,
            "assumed-deviations",
            "Standard deviations assumed: {and}.",
        ),
        (
            NotUsed,
            Remark,
            "not-used",
            "Not used of the inputs: {all}.",
        ),
        (
            NotSelected,
            Remark,
            "not-selected",
            "Test modes that the job does not select: {all}.",
        ),
        (
            RigidModes,
            Remark,
            "rigid-modes",
            "Test modes of 0 Hz, rigid-body modes, are not compared: {all}.",
        ),
        (
            AnalysisModes,
            Remark,
            "analysis-modes",
            "Modes of the model taken: the lowest {x}, beside {y} rigid-body modes.",
        ),
        (Mass, Remark, "mass", "Total mass {x6}."),
        (
            MassByDirection,
            Remark,
            "mass",
            "Mass that moves along x {x6}, along y {y6}, along z {z6}.",
        ),
        (
            CenterOfMass,
            Remark,
            "center-of-mass",
            "Center of gravity ({x6}, {y6}, {z6}).",
        ),
        (
            ChiSquared,
            Remark,
            "chi-squared",
            "Chi-squared is {x.1} for {y.1} degrees of freedom; noise alone leaves at most {z.1} in 999 of 1000 tests.",
        ),
        (
            Misfit,
            Remark,
            "chi-squared",
            "Chi-squared is {x.1} for {y.1} degrees of freedom; noise alone leaves at most {z.1} in 999 of 1000 tests.",
        ),
        (
            BelowNoise,
            Remark,
            "below-noise",
            "Noise alone would leave a chi-squared of {y.1} or more in 999 of 1000 tests, for {x.1} here: the test was computed, or its deviations are too large, and so are the intervals.",
        ),
        (
            HeldOut,
            Remark,
            "held-out-{a}",
            "Test mode {a} was not fitted: its frequency was off by {x.2} % and is by {y.2} %, its shape by {z.2} % and {w.2} % RMS.",
        ),
        (
            HeldOutFrequency,
            Remark,
            "held-out-{a}",
            "Test mode {a} was not fitted: its frequency was off by {x.2} % and is by {y.2} %.",
        ),
        (
            Unanswered,
            Remark,
            "unanswered-modes",
            "Modes of the model between the first and the last frequency of the test that no test mode answers, and the part of other modes' motion that sensors see of them: {some}.",
        ),
        (
            UnseenModes,
            Remark,
            "unseen-modes",
            "Modes of the model that no sensor sees, and that take no part: {x}, at {some} Hz.",
        ),
        (
            PartsWithoutSensor,
            Remark,
            "parts-without-sensor",
            "In parts of the model without a sensor, which are left out: {x} degrees of freedom, {some}.",
        ),
        (
            LooseWithoutSensor,
            Remark,
            "loose-without-sensor",
            "Mechanisms in parts of the model without a sensor, which nothing resists: {some}.",
        ),
        (
            HeldDirection,
            Remark,
            "held-direction",
            "Motions of a rigid body that are free: {x}; one that is not meets most force at {a}: held on purpose?",
        ),
        (
            SuspensionHidden,
            Remark,
            "free-by-digits",
            "Free by {a} of the stiffness: {x}; a suspension below {ye} Hz would not show. Places of the rows, or model.rigid_bodies, decide.",
        ),
        (
            LargeDeviation,
            Remark,
            "large-{a}",
            "Setting {a} is {x}: a standard deviation of {y} % of a shape's largest component?",
        ),
        (
            FarApart,
            Remark,
            "far-apart-{a}",
            "Test mode {a} has {x} Hz, {z.2} times its partner's, mode {b} of the first model, {y.4} Hz.",
        ),
        (
            Alike,
            Remark,
            "same-{id}",
            "Test modes {and} are nearly the same shape, modal assurance {x.3}.",
        ),
        (
            TooManyModes,
            Remark,
            "too-many-modes",
            "{x} test modes at {y} points: only {z} are told apart, the smallest singular value is {w.3}.",
        ),
        (
            Unbounded,
            Remark,
            "unbounded",
            "Parameters without bounds: {some}.",
        ),
        (
            FrequenciesAlone,
            Remark,
            "frequencies-alone",
            "Test modes without shapes are paired by number, which nothing checks: {all}. The model's modes are followed by shape \
             from there.",
        ),
        (
            CloseModes,
            Remark,
            "close-modes-{id}",
            "The frequencies of test modes {and}, or of their partners in the first model, are no further apart than the deviations \
             tell: their shapes are compared as one subspace.",
        ),
        (
            OwnWeights,
            Remark,
            "own-weights",
            "The job's weights count as dividing the standard deviations: chi-squared and intervals hold for deviations so divided.",
        ),
        (
            Covariance,
            Remark,
            "repeats",
            "The test is the mean of {x}; their covariance counts. What all of them have wrong does not scatter.",
        ),
        (
            Variances,
            Remark,
            "repeats",
            "The test is the mean of {x}; their variances alone count, for a covariance of {y} numbers needs {z} tests and no \
             weights of the job's own. What all of them have wrong does not scatter.",
        ),
        (
            Drift,
            Remark,
            "drift",
            "The repeated tests drift: each is like the one before, with a correlation of {x.2}. Their deviations count as {y.1} times as large as if they were independent.",
        ),
        (
            Complex,
            Remark,
            "complex-{a}",
            "Test mode {a} is complex: its phase collinearity is {x.2}.",
        ),
        (
            NotInEveryMode,
            Remark,
            "not-in-every-mode",
            "Sensors left out because some mode of the file has no value at them: {all}.",
        ),
        (
            DatasetsNotRead,
            Remark,
            "datasets-not-read",
            "Datasets of the Universal File that are not read: {all}.",
        ),
        (
            UnitsOfTest,
            Remark,
            "units-of-test",
            "The test's file is in units of {a}; nothing is converted.",
        ),
    ]
};

/// The sentence behind `{likely}`.
const LIKELY: &str =
    "The test's shapes would be 10^{x.0} times as likely, with its noise and a model 30 % wrong.";

// Every kind has its row, at its own place.
const _: () = {
    let mut row = 0;
    while row < TABLE.len() {
        assert!(TABLE[row].0 as usize == row);
        row += 1;
    }
    assert!(TABLE.len() == Kind::UnitsOfTest as usize + 1);
};

/// A question that the look at a job before its first step, or the account after a run, asks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "the list below has a name for each")]
pub enum Check {
    Readings,
    Directions,
    Copies,
    CommonFactor,
    OrderOfFrequencies,
    ToldApart,
    Percentages,
    Bounds,
    Places,
    Numbers,
    Units,
    Pairs,
    Reach,
    FreeMotions,
    Parts,
    Collinearity,
    Sight,
    Fit,
    Intervals,
}

/// The answer to a check.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Answer {
    /// There is something to say.
    Yes,
    /// There is nothing.
    No,
    /// It cannot be told, and a remark says why.
    NotChecked,
}

/// A check and its answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Answered {
    /// The check's name.
    pub check: &'static str,
    /// Its answer.
    pub answer: Answer,
}

/// The list: every check, its name, the kinds of concern that it ends in, and those that say that it could not be made, beside
/// [`Kind::NotChecked`] by its name.
type Checked = (Check, &'static str, &'static [Kind], &'static [Kind]);

impl Check {
    /// All checks, in the order of their numbers.
    pub const ALL: [Checked; 19] = {
        use Check::*;
        use Kind::*;
        [
            (
                Readings,
                "readings",
                &[Reversed, Exchanged, Reordered, Gain, Dead],
                &[],
            ),
            (Directions, "directions of sensors", &[Direction], &[]),
            (Copies, "modes measured twice", &[MeasuredTwice, Alike], &[]),
            (
                CommonFactor,
                "a factor of all frequencies",
                &[NamedFactor, UnnamedFactor],
                &[],
            ),
            (
                OrderOfFrequencies,
                "the order of frequencies",
                &[FrequenciesExchanged],
                &[],
            ),
            (ToldApart, "number of test modes", &[TooManyModes], &[]),
            (Percentages, "percentages", &[Percent, LargeDeviation], &[]),
            (Bounds, "bounds", &[ExcludesStart, Unbounded], &[]),
            (Places, "places of sensors", &[UnitOfPlaces, OtherGrid], &[]),
            (Numbers, "numbers of test modes", &[NumberedOtherwise], &[]),
            (Units, "units of the test", &[UnitsDisagree], &[]),
            (
                Pairs,
                "pairs",
                &[NoPair, Unlike, PartnerTaken, WouldHarm, OutOfReach],
                &[FrequenciesAlone, Undecided],
            ),
            (Reach, "frequencies in reach", &[BeyondReach, FarApart], &[]),
            (
                FreeMotions,
                "free motions",
                &[Mechanisms, LooseWithoutSensor, HeldDirection],
                &[FreeByDigits, SuspensionHidden],
            ),
            (
                Parts,
                "parts of the model",
                &[NegativePart, NotPart, Twin, SumOfStiffness, SumOfMass],
                &[PartNotChecked],
            ),
            (Collinearity, "complex shapes", &[Complex], &[]),
            (
                Sight,
                "what the test sees",
                &[Parallel, Blind, MostlyPrior, AtBound],
                &[],
            ),
            (Fit, "the fit", &[Misfit], &[]),
            (Intervals, "intervals", &[], &[]),
        ]
    };

    /// The remark that checks could not be made, for a reason.
    pub(super) fn skipped(checks: &[Self], reason: &str) -> Concern {
        let names = checks.iter().map(|check| Self::ALL[*check as usize].1);
        let about: Vec<&str> = [reason].into_iter().chain(names).collect();
        Concern::new(Kind::NotChecked, &about, &[])
    }
}

/// Most characters of an identifier, so that a table of 80 columns has room for its sentence.
const LONGEST: usize = 40;

/// Most names that a sentence lists.
const MOST_LISTED: usize = 8;

/// Something that a reader must know before trusting a result.
#[derive(Debug, Clone, PartialEq)]
pub struct Concern {
    /// Its kind.
    pub kind: Kind,
    /// The sensors, parameters or entries that it is about, by name, or the test modes by number.
    pub about: Vec<String>,
    /// The numbers that its sentence tells.
    pub measure: Vec<f64>,
    /// True if the user answers for it, by its identifier.
    pub is_accepted: bool,
}

impl Concern {
    /// A concern that nobody answers for yet.
    pub fn new(kind: Kind, about: &[impl ToString], measure: &[f64]) -> Self {
        Self {
            kind,
            about: about.iter().map(ToString::to_string).collect(),
            measure: measure.to_vec(),
            is_accepted: false,
        }
    }

    /// A doubt about a setting that looks like percent.
    pub(super) fn percent(setting: &str, value: f64) -> Self {
        Self::new(Kind::Percent, &[setting], &[value, 100.0 * value])
    }

    /// A concern about nothing in particular.
    pub(super) fn plain(kind: Kind, measure: &[f64]) -> Self {
        Self::new(kind, &[""; 0], measure)
    }

    /// The name of it on the command line: words, numbers and names joined by hyphens, at most forty characters. A longer one ends in four
    /// hexadecimal digits of its SHA-256 digest, which tell it from others of the same beginning.
    pub fn identifier(&self) -> String {
        let (.., identifier, _) = TABLE[self.kind as usize];
        let whole = self.filled(identifier).replace(char::is_whitespace, "-");
        if whole.chars().count() <= LONGEST {
            return whole;
        }
        let digest = Sha256::digest(&whole);
        let start: String = whole.chars().take(LONGEST - 5).collect();
        format!("{start}-{:02x}{:02x}", digest[0], digest[1])
    }

    /// A sentence that says it.
    pub fn words(&self) -> String {
        let (.., words) = TABLE[self.kind as usize];
        self.filled(&words.replace("{likely}", LIKELY))
    }

    /// The effect that it has on a result.
    #[doc(hidden)]
    pub fn grade(&self) -> Grade {
        TABLE[self.kind as usize].1
    }

    /// True if it names a mistake that nobody answers for.
    pub fn stands(&self) -> bool {
        self.grade() == Grade::Doubt && !self.is_accepted
    }

    /// A template of the table with names and numbers in it.
    fn filled(&self, template: &str) -> String {
        let mut parts = template.split(['{', '}']);
        let mut words = parts.next().unwrap_or_default().to_owned();
        while let Some(field) = parts.next() {
            words += &self.field(field);
            words += parts.next().unwrap_or_default();
        }
        words
    }

    /// The text for a field of a template.
    fn field(&self, field: &str) -> String {
        let about = &self.about[..];
        let name = |place: usize| about.get(place).cloned().unwrap_or_default();
        let more = about.len().saturating_sub(MOST_LISTED);
        match field {
            "a" => return name(0),
            "b" => return name(1),
            "id" => return about.join("-"),
            "and" => return about.join(" and "),
            "some" if more > 1 => {
                return format!("{} and {more} more", about[..MOST_LISTED].join(", "));
            }
            "rest" => return about.get(1..).unwrap_or_default().join(", "),
            "all" | "some" => return about.join(", "),
            _ => (),
        }
        let (place, digits) = field.split_at(1);
        let place = ["x", "y", "z", "w"]
            .into_iter()
            .position(|own| own == place);
        let number = place.and_then(|place| self.measure.get(place).copied());
        let number = number.unwrap_or(f64::NAN);
        match digits {
            "" => number.to_string(),
            "e" => format!("{number:.0e}"),
            "6" => format!("{number:.5e}")
                .parse()
                .unwrap_or(number)
                .to_string(),
            _ => {
                let decimals = digits[1..].parse().unwrap_or_default();
                format!("{number:.decimals$}")
            }
        }
    }
}

impl Serialize for Concern {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let grade = self.grade();
        let mut fields = serializer.serialize_struct("Concern", 7)?;
        fields.serialize_field("identifier", &self.identifier())?;
        fields.serialize_field("kind", &self.kind)?;
        fields.serialize_field("about", &self.about)?;
        fields.serialize_field("measure", &self.measure)?;
        fields.serialize_field("is_doubt", &(grade == Grade::Doubt))?;
        fields.serialize_field("is_accepted", &self.is_accepted)?;
        fields.serialize_field("words", &self.words())?;
        fields.end()
    }
}

/// Everything that may lower the trust in a job's result, what matters most first.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
#[serde(transparent)]
pub struct Trust {
    concerns: Vec<Concern>,
}

impl Trust {
    /// The concerns in the order of their kinds.
    pub fn new(mut concerns: Vec<Concern>) -> Self {
        concerns.sort_by_key(|concern| concern.kind);
        Self { concerns }
    }

    /// The concerns, what matters most first.
    pub fn all(&self) -> &[Concern] {
        &self.concerns
    }

    /// The concerns of one kind.
    pub fn of(&self, kind: Kind) -> impl Iterator<Item = &Concern> {
        self.concerns
            .iter()
            .filter(move |concern| concern.kind == kind)
    }

    /// The answer to a check.
    pub fn answer(&self, check: Check) -> Answer {
        let (_, name, ends, open) = Check::ALL[check as usize];
        let is_open = |own: &Concern| {
            let is_named = own.kind == Kind::NotChecked && own.about.iter().any(|own| own == name);
            is_named || open.contains(&own.kind)
        };
        match &self.concerns {
            all if all.iter().any(|own| ends.contains(&own.kind)) => Answer::Yes,
            all if all.iter().any(is_open) => Answer::NotChecked,
            _ => Answer::No,
        }
    }

    /// The answers to all checks: to those before the first step, and after a run to those of its result.
    pub fn answers(&self) -> Vec<Answered> {
        let is_run = [Kind::ChiSquared, Kind::Misfit];
        let is_run = is_run.iter().any(|kind| self.of(*kind).next().is_some());
        let asked = Check::ALL.iter().take(match is_run {
            true => Check::ALL.len(),
            false => Check::Sight as usize,
        });
        let answered = |&(check, name, ..): &Checked| Answered {
            check: name,
            answer: self.answer(check),
        };
        asked.map(answered).collect()
    }

    /// Names and numbers that the concerns of one kind are about.
    pub fn about(&self, kind: Kind) -> Vec<String> {
        self.of(kind)
            .flat_map(|concern| concern.about.clone())
            .collect()
    }

    /// The account after a run, with what is known since; test modes are left out, and modes of the model unanswered, by what it ended
    /// with.
    pub(super) fn after(&self, concerns: Vec<Concern>) -> Self {
        let before = self.concerns.iter();
        let before = before.filter(|concern| {
            concern.grade() != Grade::LeftOut && concern.kind != Kind::Unanswered
        });
        Self::new(before.cloned().chain(concerns).collect())
    }

    /// The account after the user answers for the doubts of these identifiers.
    ///
    /// # Errors
    /// [`FileError::Refused`] for an identifier that names no doubt, with those that there are.
    pub fn accepting(mut self, accepted: &[String]) -> Result<Self, FileError> {
        let is_doubt = |concern: &Concern| concern.grade() == Grade::Doubt;
        let doubts: Vec<String> = self
            .concerns
            .iter()
            .filter(|own| is_doubt(own))
            .map(Concern::identifier)
            .collect();
        if let Some(unknown) = accepted.iter().find(|own| !doubts.contains(own)) {
            let reason = match &doubts[..] {
                [] => "nothing is doubtful".to_owned(),
                _ => format!("the doubts are {}", doubts.join(", ")),
            };
            return Err(FileError::refused(format!("--accept {unknown}"), reason));
        }
        for concern in self.concerns.iter_mut().filter(|own| is_doubt(own)) {
            concern.is_accepted = accepted.contains(&concern.identifier());
        }
        Ok(self)
    }

    /// True if a doubt stands that nobody answers for.
    pub fn has_doubt(&self) -> bool {
        self.concerns.iter().any(Concern::stands)
    }

    /// True if a doubt or a selected mode that is not compared stands against the result.
    #[doc(hidden)]
    pub fn stands_against(&self) -> bool {
        self.has_doubt() || !self.are_all_compared()
    }

    /// True if every selected test mode is compared.
    pub(super) fn are_all_compared(&self) -> bool {
        let is_left = |concern: &Concern| concern.grade() == Grade::LeftOut;
        !self.concerns.iter().any(is_left)
    }

    /// True if nothing stands against the result: neither a doubt, nor a selected mode that is not compared, nor a request to stop.
    pub fn is_clear(&self) -> bool {
        let is_interrupted = self.of(Kind::Interrupted).next().is_some();
        !self.stands_against() && !is_interrupted
    }
}
