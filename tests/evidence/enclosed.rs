//! Every number of the four cases and of Tables 9 to 12, by all readings of the step, against enclosures: `golden/enclosed.json` has the
//! method's own numbers to twenty digits, each proven, and every decision on the way (`golden/enclosure.py`).
//!
//! The crate's distance from a proven number is held to its condition: how much one rounding counts, which the program measures by a noise
//! of 1e-40 in its place. Its iterations, halvings and pairs are those of the enclosure, of which no decision hangs on less than 4e-4.

use crate::prelude::*;

/// Decimals of twenty digits.
type Decimals = Vec<String>;

/// A run, enclosed.
#[derive(Deserialize)]
struct Run {
    test_frequencies: Decimals,
    initial: Stage,
    passes: Vec<Pass>,
    conditions: Conditions,
    decisions: usize,
    nearest: BTreeMap<String, f64>,
}

/// An exact solution.
#[derive(Deserialize)]
struct Stage {
    frequencies: Decimals,
    paired: Vec<usize>,
    errors: Decimals,
}

#[derive(Deserialize)]
struct Pass {
    iterations: usize,
    halvings: Vec<usize>,
    error_sums: Decimals,
    unlimited_factors: Decimals,
    gages: Decimals,
    inner_frequencies: Decimals,
    converged: bool,
    #[serde(flatten)]
    check: Stage,
}

/// Condition of every number, by its name: of the test and the first model, and of every pass.
#[derive(Deserialize)]
struct Conditions {
    initial: BTreeMap<String, f64>,
    passes: Vec<BTreeMap<String, f64>>,
}

static ENCLOSED: LazyLock<BTreeMap<String, Run>> = LazyLock::new(|| {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/golden/enclosed.json");
    let text = fs::read_to_string(file).unwrap();
    serde_json::from_str(&text).unwrap()
});

fn numbers(decimals: &Decimals) -> Vec<f64> {
    let parsed = decimals.iter().map(|digits| digits.parse());
    parsed.collect::<Result<_, _>>().unwrap()
}

/// Numbers of the crate against enclosed ones, as far apart as roundings of this condition go.
fn assert_near(what: &str, found: &[f64], exact: &Decimals, conditions: &BTreeMap<String, f64>) {
    let name = what.rsplit(", ").next().unwrap();
    let allowed = CHAIN_ROUND_OFF * conditions[name].max(1.0);
    assert_eq!(found.len(), exact.len(), "{what}");
    for (found, exact) in found.iter().zip(numbers(exact)) {
        let apart = relative_error(found, exact);
        assert!(
            apart <= allowed,
            "{what}: {found} for {exact}, {apart:e} of {allowed:e}"
        );
    }
}

/// An exact solution against an enclosed one.
fn assert_stage(what: &str, found: &State, exact: &Stage, conditions: &BTreeMap<String, f64>) {
    assert_eq!(found.pairing.analysis_mode, exact.paired, "{what}");
    let hertz = found.modes.frequencies_hz();
    assert_near(
        &format!("{what}, frequencies"),
        &hertz,
        &exact.frequencies,
        conditions,
    );
    let errors = [found.errors.frequency, found.errors.shape];
    assert_near(
        &format!("{what}, errors"),
        &errors,
        &exact.errors,
        conditions,
    );
}

/// A correlation of the crate against an enclosed one.
fn assert_run(name: &str, test: &Modes, found: &Correlation, gages: &[Vec<f64>], met: &Settings) {
    let run = &ENCLOSED[name];
    let first = &run.conditions.initial;
    let hertz = test.frequencies_hz();
    assert_near(
        &format!("{name}, test_frequencies"),
        &hertz,
        &run.test_frequencies,
        first,
    );
    assert_stage(name, &found.initial, &run.initial, first);
    assert_eq!(found.passes.len(), run.passes.len(), "{name}");
    let passes = found.passes.iter().zip(gages).zip(&run.passes);
    for (at, ((pass, gages), exact)) in passes.enumerate() {
        let (what, conditions) = (
            format!("{name}, pass {}", at + 1),
            &run.conditions.passes[at],
        );
        let steps = &pass.inner.iterations;
        let halvings = steps.iter().map(|step| step.halvings).collect_vec();
        assert_eq!(
            (steps.len(), &halvings),
            (exact.iterations, &exact.halvings),
            "{what}"
        );
        assert_eq!(
            met.are_met_by(&pass.check.errors),
            exact.converged,
            "{what}"
        );
        let sums = steps.iter().map(|step| step.errors.sum()).collect_vec();
        let mut inner = pass.inner.last.modes.frequencies_hz();
        inner.sort_by(f64::total_cmp);
        let asked = &pass.inner.iterations[0].unlimited_factors;
        for (number, found, exact) in [
            ("error_sums", &sums, &exact.error_sums),
            ("unlimited_factors", asked, &exact.unlimited_factors),
            ("gages", gages, &exact.gages),
            ("inner_frequencies", &inner, &exact.inner_frequencies),
        ] {
            assert_near(&format!("{what}, {number}"), found, exact, conditions);
        }
        assert_stage(&what, &pass.check, &exact.check, conditions);
    }
}

/// A case by a reading of the step, with as many passes as its enclosure has.
fn case(number: usize, step: StepRule) -> Case {
    let case = case_of(number);
    let passes = ENCLOSED[&format!("case {number}, {}", step.name())]
        .passes
        .len();
    Case {
        settings: Settings {
            least_passes: passes,
            most_passes: passes,
            ..case.settings_by(step)
        },
        ..case
    }
}

#[test]
fn every_reading_has_a_name_help_a_golden_and_an_enclosure() {
    let names = StepRule::ALL.map(StepRule::name);
    assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), names.len());
    let read = |path: &str| fs::read_to_string(in_root(path)).unwrap_or_default();
    let (help, template) = (
        read("src/program/settings.rs"),
        read("src/job/template.toml"),
    );
    let of_step = template.lines().find(|line| line.starts_with("# step = "));
    for name in names {
        assert!(help.contains(&format!("    ///   {name} ")), "{name}");
        assert!(of_step.is_some_and(|line| line.contains(name)), "{name}");
        assert_ne!(read(&format!("golden/reference/expected_{name}.toml")), "");
        for number in CASES {
            assert!(ENCLOSED.contains_key(&format!("case {number}, {name}")));
        }
    }
}

#[test]
fn the_cases_by_every_reading_are_the_enclosed_ones() {
    for number in CASES {
        for step in StepRule::ALL {
            let case = case(number, step);
            let found = case_run(&case);
            let (name, met) = (format!("case {number}, {}", step.name()), &case.settings);
            assert_run(
                &name,
                &found.test,
                &found.correlation,
                &found.pass_gages,
                met,
            );
        }
    }
}

#[test]
fn passes_with_fewer_modes_by_every_reading_are_the_enclosed_ones() {
    for step in StepRule::ALL {
        let (reading, case) = (step.name(), case(PUBLISHED_CASE, step));
        let settings = Settings {
            least_passes: 1,
            most_passes: 1,
            ..case.settings.clone()
        };
        let (model, all) = (case.model().unwrap(), case.test_modes().unwrap());
        let ranges = model.factor_ranges().unwrap();
        for (tests, modes) in PUBLISHED_RUNS {
            let test = all.lowest(tests).unwrap();
            let analyze = |factors: &[f64]| model.analyze(factors, &test, Some(modes));
            let found = correlate(analyze, &ranges, &settings, |_, _| true).unwrap();
            let of_pass = |factors: &[f64]| model.sizes(factors).unwrap()[..PANEL_COUNT].to_vec();
            let gages = found
                .passes
                .iter()
                .map(|pass| of_pass(&pass.factors))
                .collect_vec();
            let name = format!(
                "case {PUBLISHED_CASE}, {reading}, {tests} test and {modes} analysis modes"
            );
            assert_run(&name, &test, &found, &gages, &settings);
        }
    }
}

/// Every decision was proven, and none hangs on round-off.
#[test]
fn no_decision_of_a_run_is_near_to_falling_otherwise() {
    assert_eq!(ENCLOSED.len(), 4 * (CASES.len() + PUBLISHED_RUNS.len()));
    let decisions: usize = ENCLOSED.values().map(|run| run.decisions).sum();
    assert_eq!(decisions, 2_317_269);
    for (name, run) in &*ENCLOSED {
        for (kind, &margin) in &run.nearest {
            assert!(margin > NEAREST_DECISION, "{name}, {kind}: {margin:e}");
        }
    }
}
