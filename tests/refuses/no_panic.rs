//! Whatever numbers and sizes a public function of the method is given, and however little the parts of its structs fit together,
//! it answers with an error or with numbers: it does not panic, and it does not return what is no number.
//!
//! Every public function and method of `src/method` is called, and of the files of other rooms that stand closest to it, some 130, but
//! for the few of [`NOT_CALLED`]. `CORFEM_CALLS=20000 cargo test --release no_panic` makes so many calls of each instead of the usual few
//! hundred, and `CORFEM_ENTRIES=step::,Pencil` only of those whose name holds one of these words.

mod loops;
mod matrices;
mod perturbation;
mod structures;

use crate::ledgers::files_below;
use crate::prelude::*;

/// The numbers of an answer, or that there is an error instead.
type Answer = Result<Vec<f64>, Error>;

/// A public function, by its module or type, and a call of it.
type Entry = (&'static str, fn(&mut Draws) -> Answer);

const LISTS: [&[Entry]; 4] = [
    matrices::MATRICES,
    perturbation::PERTURBATION,
    structures::STRUCTURES,
    loops::LOOPS,
];

/// Public functions that no entry calls by itself: they hand out a part, a length or a name, or put parts together unseen.
const NOT_CALLED: [&str; 12] = [
    "Comparison::into_model",
    "Comparison::lone",
    "ElementKind::corner_count",
    "Error::is_of_close_modes",
    "Error::no_convergence",
    "Factor::negative_count",
    "Factor::order",
    "Modes::len",
    "Modes::new",
    "Pair::by",
    "Parameter::new",
    "Share::matrix",
];

fn entries(matrix: &DMatrix<f64>) -> Vec<f64> {
    matrix.iter().copied().collect()
}

fn modes(found: &Modes) -> Vec<f64> {
    found
        .omega_squared()
        .iter()
        .chain(found.shapes().iter())
        .copied()
        .collect()
}

/// A chain with its analysis.
fn chain(d: &mut Draws) -> Result<ModalModel, Error> {
    d.chain().ok_or_else(|| Error::no_convergence("chains"))
}

fn is_name(text: &str) -> bool {
    text.chars().all(|c| c.is_alphanumeric() || c == '_')
}

/// The public functions of a source file and those of its analyses: by the type of the `impl` they stand in, or by the file's module.
fn public_functions(module: &str, source: &str) -> Vec<String> {
    let (mut owner, mut found) = (module.to_owned(), Vec::new());
    let mut is_analysis = false;
    let lines = source.lines().collect_vec();
    for (at, &line) in lines.iter().enumerate() {
        // One that hands out a field does nothing that could go wrong.
        let body = lines
            .get(at + 1)
            .map_or("", |body| body.trim().trim_start_matches('&'));
        let is_all = lines.get(at + 2).is_some_and(|end| end.trim() == "}");
        let is_field = body.strip_prefix("self.").is_some_and(is_name);
        if line.contains("(&self) ->") && is_field && is_all {
            continue;
        }
        if let Some(of) = line.strip_prefix("impl").filter(|of| !of.ends_with("{}")) {
            // Without the parameters of the block itself.
            let of = of
                .split_once("> ")
                .filter(|_| of.starts_with('<'))
                .map_or(of, |(_, of)| of);
            is_analysis = of.trim_start().starts_with("Analysis for ");
            let of = of.rsplit(" for ").next().unwrap_or(of).trim();
            owner = of.split(['<', ' ']).next().unwrap_or(of).to_owned();
        } else if line == "}" {
            owner = module.to_owned();
            is_analysis = false;
        }
        let start = if is_analysis { "fn " } else { "pub fn " };
        if let Some(rest) = line.trim_start().strip_prefix(start) {
            found.push(format!(
                "{owner}::{}",
                rest.split(['(', '<']).next().unwrap_or(rest)
            ));
        }
    }
    found
}

/// The functions that are neither called by an entry of their name nor excused.
fn uncalled<'a>(functions: &'a [String], entries: &str, excused: &[&str]) -> Vec<&'a str> {
    let is_called = |function: &str| {
        let name = function.rsplit("::").next().unwrap_or(function);
        let entry = entries
            .split("\n    (\"")
            .find(|entry| entry.starts_with(&format!("{function}\"")));
        entry.is_some_and(|entry| entry.contains(&format!("{name}(")))
    };
    let is_missing = |function: &&str| !excused.contains(function) && !is_called(function);
    functions
        .iter()
        .map(String::as_str)
        .filter(is_missing)
        .collect()
}

#[test]
fn every_public_function_of_the_method_is_called() {
    let mut functions = Vec::new();
    let source = in_root("src");
    let mut files = files_below(&source.join("method"));
    files.extend(files_below(&source.join("sparse/factorization")));
    let others = [
        "sparse/assurance.rs",
        "sparse/checks.rs",
        "sparse/elements.rs",
        "sparse/mass_changes.rs",
        "sparse/sensor_model.rs",
        "sparse/share.rs",
        "weighted/comparison.rs",
    ];
    files.extend(others.map(|name| source.join(name)));
    for file in files {
        let stem = |path: &Path| path.file_stem().unwrap().to_string_lossy().into_owned();
        let module = if stem(&file) == "mod" {
            stem(file.parent().unwrap())
        } else {
            stem(&file)
        };
        functions.extend(public_functions(
            &module,
            &fs::read_to_string(&file).unwrap(),
        ));
    }
    assert!(
        functions.len() > 80,
        "only {} public functions were found",
        functions.len()
    );
    let tests = ["matrices", "perturbation", "structures", "loops"];
    let folder = in_root("tests/refuses/no_panic");
    let texts =
        tests.map(|name| fs::read_to_string(folder.join(name).with_extension("rs")).unwrap());
    let missing = uncalled(&functions, &texts.concat(), &NOT_CALLED);
    assert!(
        missing.is_empty(),
        "of {} public functions nobody calls {missing:?}",
        functions.len()
    );
    let known = |name: &&str| functions.iter().any(|function| function == name);
    let called = LISTS.iter().copied().flatten().map(|(name, _)| *name);
    let gone = called
        .chain(NOT_CALLED)
        .filter(|name| !known(name))
        .collect_vec();
    assert!(gone.is_empty(), "no longer public functions: {gone:?}");
}

#[test]
fn the_list_finds_a_function_that_is_not_called() {
    let source = "pub fn free<T>(x: T) {}\nimpl<T: Number> Box<T> {\n    pub fn held(&self) {}\n}\npub fn last() {}\n";
    let functions = public_functions("room", source);
    assert_eq!(functions, ["room::free", "Box::held", "room::last"]);
    let entries = "x = [\n    (\"room::free\", |d| free(d)),\n    (\"Box::held\", |d| other(d)),\n";
    assert_eq!(
        uncalled(&functions, entries, &["room::last"]),
        ["Box::held"]
    );
    assert_eq!(
        public_functions("a", "impl fmt::Display for Verdict {\n    pub fn b() {}\n"),
        ["Verdict::b"]
    );
    // What a caller reaches through the trait.
    let source = "impl Analysis for ModalModel {\n    fn at(&self) {}\n}\nimpl Clone for ModalModel {\n    fn clone(&self) {}\n}\n";
    assert_eq!(public_functions("a", source), ["ModalModel::at"]);
}

#[test]
fn no_panic_and_no_answer_that_is_no_number() {
    let calls = std::env::var("CORFEM_CALLS")
        .ok()
        .and_then(|calls| calls.parse().ok())
        .unwrap_or(300);
    let mut faults = Vec::new();
    let words = std::env::var("CORFEM_ENTRIES").unwrap_or_default();
    let is_asked_for = |name: &str| words.split(',').any(|word| name.contains(word));
    let mut made = 0;
    for (name, entry) in LISTS
        .iter()
        .copied()
        .flatten()
        .filter(|(name, _)| is_asked_for(name))
    {
        let mut answers = 0;
        made += calls;
        for seed in 0..calls {
            let mut draws = Draws(seed);
            match catch_unwind(AssertUnwindSafe(|| entry(&mut draws))) {
                Err(panic) => {
                    let said = panic.downcast_ref::<&str>().map(|said| (*said).to_owned());
                    let said = panic
                        .downcast_ref::<String>()
                        .cloned()
                        .or(said)
                        .unwrap_or_default();
                    faults.push(format!("{name}, seed {seed}: panics: {said}"));
                }
                Ok(Ok(numbers)) => {
                    answers += 1;
                    if numbers.iter().any(|number| !number.is_finite()) {
                        faults.push(format!("{name}, seed {seed}: {numbers:?}"));
                    }
                }
                Ok(Err(error)) => {
                    if error.to_string().is_empty() {
                        faults.push(format!("{name}, seed {seed}: an error without words"));
                    }
                }
            }
        }
        if answers == 0 {
            faults.push(format!("{name}: no call of {calls} came past its checks"));
        }
    }
    println!("{made} calls");
    let mut first: Vec<String> = Vec::new();
    for fault in &faults {
        let name = fault.split(',').next().unwrap_or_default();
        if first.iter().filter(|known| known.starts_with(name)).count() < 2 {
            first.push(fault.chars().take(200).collect());
        }
    }
    assert!(
        faults.is_empty(),
        "{} faults:\n{}",
        faults.len(),
        first.join("\n")
    );
}
