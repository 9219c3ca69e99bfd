//! Whatever numbers and sizes a public function of the method is given, and however little the parts of its structs fit together,
//! it answers with an error or with numbers: it does not panic, and it does not return what is no number.
//!
//! Every public function and method of `src/method` is called, and of the files of other rooms that stand closest to it, some 130, but
//! for the few of [`NOT_CALLED`]. `CORFEM_CALLS=20000 cargo test --release no_panic` makes so many calls of each instead of the usual few
//! hundred.

mod loops;
mod matrices;
mod perturbation;
mod structures;

use crate::common::draws::asked_calls;
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

/// What has numbers to be looked at.
trait Numbers {
    fn numbers(self) -> Vec<f64>;
}

impl Numbers for () {
    fn numbers(self) -> Vec<f64> {
        Vec::new()
    }
}

impl Numbers for DMatrix<f64> {
    fn numbers(self) -> Vec<f64> {
        self.as_slice().to_vec()
    }
}

impl Numbers for Modes {
    fn numbers(self) -> Vec<f64> {
        [self.omega_squared().as_slice(), self.shapes().as_slice()].concat()
    }
}

impl Numbers for Perturbed {
    fn numbers(self) -> Vec<f64> {
        [self.roots.as_slice(), self.shapes.as_slice()].concat()
    }
}

/// The answer of a function.
fn told<T: Numbers>(found: Result<T, Error>) -> Answer {
    found.map(T::numbers)
}

/// What a function gives that is looked at by nobody.
fn unseen<T>(_: T) -> Answer {
    Ok(Vec::new())
}

/// A chain with its analysis.
fn chain(d: &mut Draws) -> Result<ModalModel, Error> {
    d.chain().ok_or_else(|| Error::no_convergence("chains"))
}

/// The public functions of a source file and those of its analyses: by the type of the `impl` they stand in, or by the file's module. One that
/// hands out a field does nothing that could go wrong.
fn public_functions(module: &str, source: &str) -> Vec<String> {
    let (mut owner, mut start, mut found) = (module, "pub fn ", Vec::new());
    let lines = source.lines().collect_vec();
    for (at, &line) in lines.iter().enumerate() {
        if let Some(of) = line.strip_prefix("impl").filter(|of| !of.ends_with("{}")) {
            start = if of.contains(" Analysis for ") {
                "fn "
            } else {
                "pub fn "
            };
            // Without the parameters of the block itself.
            let own = of.split_once("> ").filter(|_| of.starts_with('<'));
            let of = own.map_or(of, |(_, of)| of);
            let of = of.rsplit(" for ").next().unwrap_or(of).trim();
            owner = of.split(['<', ' ']).next().unwrap_or(of);
        } else if line == "}" {
            (owner, start) = (module, "pub fn ");
        }
        let body = lines
            .get(at + 1)
            .map_or("", |body| body.trim().trim_start_matches('&'));
        let is_field = line.contains("(&self) ->")
            && lines.get(at + 2).is_some_and(|end| end.trim() == "}")
            && body
                .strip_prefix("self.")
                .is_some_and(|name| !name.contains(['.', '(', '[', ' ']));
        if let Some(rest) = line.trim_start().strip_prefix(start).filter(|_| !is_field) {
            found.push(format!(
                "{owner}::{}",
                rest.split(['(', '<']).next().unwrap_or(rest)
            ));
        }
    }
    found
}

/// True if an entry of its name calls the function.
fn is_called(function: &str, entries: &str) -> bool {
    let mut entries = entries.split("\n    (\"");
    let entry = entries.find(|entry| entry.starts_with(&format!("{function}\"")));
    let name = function.rsplit("::").next().unwrap_or(function);
    entry.is_some_and(|entry| entry.contains(&format!("{name}(")))
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
    let entries = texts.concat();
    let is_missing =
        |name: &&String| !NOT_CALLED.contains(&&name[..]) && !is_called(name, &entries);
    let missing = functions.iter().filter(is_missing).collect_vec();
    assert!(missing.is_empty(), "nobody calls {missing:?}");
    let known = |name: &&str| functions.iter().any(|function| function == name);
    let called = LISTS.iter().copied().flatten().map(|(name, _)| *name);
    let gone = called
        .chain(NOT_CALLED)
        .filter(|name| !known(name))
        .collect_vec();
    assert!(gone.is_empty(), "no longer public functions: {gone:?}");
}

#[test]
fn no_panic_and_no_answer_that_is_no_number() {
    let calls = asked_calls(300);
    let mut faults = Vec::new();
    for (name, entry) in LISTS.iter().copied().flatten() {
        let mut answers = 0;
        for seed in 0..calls {
            let mut draws = Draws(seed);
            match catch_unwind(AssertUnwindSafe(|| entry(&mut draws))) {
                Err(_) => faults.push(format!("{name}, seed {seed}: panics")),
                Ok(Ok(numbers)) => {
                    answers += 1;
                    if numbers.iter().any(|number| !number.is_finite()) {
                        faults.push(format!("{name}, seed {seed}: {numbers:?}"));
                    }
                }
                Ok(Err(error)) => assert!(!error.to_string().is_empty(), "{name}, seed {seed}"),
            }
        }
        if answers == 0 {
            faults.push(format!("{name}: no call of {calls} came past its checks"));
        }
    }
    faults.truncate(20);
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
