//! What a wing of any size costs: the tables of `paper/cost.md` are made from `paper/costs.csv`, where the benches store what they
//! measure.

use crate::ledgers::tables::table;
use crate::prelude::*;

const ANALYSIS: &str = "analysis with all shares";
const FACTOR: &str = "ordering and factorization";
const WHOLE_MODES: &str = "20 modes of the whole model (counted)";
const NEEDED: &str = "entries of the factor without padding";
const BY_METIS: &str = "entries of the factor by METIS through CHOLMOD";
/// The programs beside this one.
const RIVALS: [&str; 3] = ["SciPy", "CHOLMOD", "PARDISO"];

/// The lines of the file as text: a head of sizes, then stages with their unit and a cost for each size, or nothing.
static LINES: LazyLock<Vec<Vec<String>>> = LazyLock::new(|| {
    let text = include_str!("../../paper/costs.csv");
    let lines = text.lines().map(|line| line.split(',').map(str::to_owned));
    lines.map(Iterator::collect).collect()
});

/// Degrees of freedom of the wings.
fn sizes() -> Vec<f64> {
    let sizes = LINES[0][2..].iter();
    sizes.map(|dof| dof.parse().unwrap()).collect()
}

fn numbers(line: &[String]) -> Vec<Option<f64>> {
    let costs = line[2..].iter();
    costs
        .map(|cost| (!cost.is_empty()).then(|| cost.parse().unwrap()))
        .collect()
}

/// What a stage costs at a size, if it was measured: the first line of that name, which is of time or of a count.
fn cost(stage: &str, size: usize) -> Option<f64> {
    let line = LINES.iter().find(|line| line[0] == stage);
    numbers(line.unwrap_or_else(|| panic!("{stage}")))[size]
}

/// Three digits, or nothing.
fn written(value: Option<f64>) -> String {
    let digits = |value: f64| {
        let decimals = (2.0 - value.abs().log10().floor()).clamp(0.0, 3.0) as usize;
        format!("{value:.decimals$}")
    };
    value.map(digits).unwrap_or_default()
}

/// The heads of the sizes, with commas between thousands.
fn head(what: &str) -> String {
    let grouped = |dof: f64| {
        let digits = format!("{dof:.0}");
        let comma = |(at, digit): (usize, char)| {
            let is_third = at > 0 && (digits.len() - at).is_multiple_of(3);
            is_third.then_some(',').into_iter().chain([digit])
        };
        digits
            .chars()
            .enumerate()
            .flat_map(comma)
            .collect::<String>()
    };
    let sizes = sizes()
        .into_iter()
        .map(|dof| format!(" | {} DOF", grouped(dof)));
    what.to_owned() + &sizes.collect::<String>()
}

/// Whether a line is of another program.
fn is_rival(line: &[String]) -> bool {
    RIVALS.iter().any(|rival| line[0].contains(rival))
}

/// The lines that are wanted, with exponents of growth; `usual` is the unit that the head names.
fn growth(what: &str, usual: &str, is_wanted: fn(&[String]) -> bool) -> String {
    // Without the sign of a zero. One size has no growth.
    let exponent = |points: &[(f64, f64)]| match points.len() {
        0 | 1 => String::new(),
        _ => format!("{:.2}", log_log_slope(points)).replace("-0.00", "0.00"),
    };
    // A row that was never measured says nothing.
    let is_measured = |line: &&Vec<String>| numbers(line).iter().any(Option::is_some);
    let wanted = LINES[1..]
        .iter()
        .filter(|line| is_wanted(line))
        .filter(is_measured);
    let rows = wanted.map(|line| match line[1] == usual {
        true => (line[0].clone(), line),
        false => (format!("{}, {}", line[0], line[1]), line),
    });
    table(
        &(head(what) + " | from size to size | fitted"),
        rows,
        |line| {
            let costs = numbers(line);
            let known = sizes().into_iter().zip(&costs);
            let known = known
                .filter_map(|(dof, &cost)| Some((dof, cost?)))
                .collect_vec();
            let steps = known.windows(2).map(exponent).collect_vec();
            let mut cells = costs.into_iter().map(written).collect_vec();
            cells.extend([steps.join(", "), exponent(&known)]);
            cells
        },
    )
}

/// A number for each size, where it was measured.
type Bound<'a> = &'a dyn Fn(usize) -> Option<f64>;

/// Rates of the stages, against those of the machine, and shares of one stage in another.
fn bounds() -> String {
    let ratio = |one, other| move |size| Some(cost(one, size)? / cost(other, size)?);
    let percent = |one, other| move |size| Some(100.0 * ratio(one, other)(size)?);
    let each = |stage| move |size: usize| Some(1e3 * cost(stage, size)? / sizes()[size]);
    let entries = |size| cost("entries of the factor", size);
    // Millions a millisecond are thousand millions a second.
    let rate = ratio("operations of the factorization", FACTOR);
    let rows: [(&str, Bound<'_>); 6] = [
        ("entries of the factor for every DOF", &|size| {
            Some(1e6 * entries(size)? / sizes()[size])
        }),
        ("ordering and factorization, GFLOP/s", &rate),
        ("the same, % of a product of dense matrices", &|size| {
            Some(100.0 * rate(size)? / cost("product of dense matrices", size)?)
        }),
        ("the same, % of an analysis", &percent(FACTOR, ANALYSIS)),
        (
            "20 modes of the whole model, % of an analysis",
            &percent(WHOLE_MODES, ANALYSIS),
        ),
        (
            "element matrices, µs for every DOF",
            &each("element matrices (once)"),
        ),
    ];
    at_sizes(
        "what bounds a stage",
        rows.map(|(name, bound)| (name.to_owned(), at_each(bound))),
    )
}

/// How many times as long other programs take for the same, and how much more the factor stores than by their order of elimination.
fn beside_others() -> String {
    let stages = [
        (WHOLE_MODES, "20 modes", " (not counted)"),
        (ANALYSIS, "analysis", ""),
    ];
    let mut rows = Vec::new();
    for (stage, what, end) in stages {
        for rival in RIVALS {
            let theirs = format!("{what} by {rival}{end}");
            let ratio = at_each(&|size| Some(cost(&theirs, size)? / cost(stage, size)?));
            rows.push((format!("{what} by {rival}"), ratio));
        }
    }
    let more = at_each(&|size| Some(100.0 * (cost(NEEDED, size)? / cost(BY_METIS, size)? - 1.0)));
    rows.push((format!("{NEEDED}, % above METIS through CHOLMOD"), more));
    at_sizes("times as long as here", rows)
}

/// A number at every size, where it was measured.
fn at_each(bound: Bound<'_>) -> Vec<Option<f64>> {
    (0..sizes().len()).map(bound).collect()
}

/// A table of numbers at every size.
fn at_sizes(what: &str, rows: impl IntoIterator<Item = (String, Vec<Option<f64>>)>) -> String {
    let is_measured = |(_, values): &(String, Vec<Option<f64>>)| values.iter().any(Option::is_some);
    table(
        &head(what),
        rows.into_iter().filter(is_measured),
        |values| values.into_iter().map(written).collect(),
    )
}

/// The tables of `paper/cost.md`.
pub fn costs() -> String {
    let blocks = [
        growth("stage, ms", "ms", |line| !is_rival(line) && line[1] != "MB"),
        growth("most memory held, MB", "MB", |line| {
            !is_rival(line) && line[1] == "MB"
        }),
        bounds(),
        growth("other programs, ms", "ms", is_rival),
        beside_others(),
    ];
    blocks.join("\n")
}
