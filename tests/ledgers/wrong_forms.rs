//! The wrong forms of `paper/equations.toml` that are places of the source, and those of rooms beside the paper in `tests/wrong_forms`: each
//! fits the source, and at least one test named for its equation or law fails for it. Those that are formulas are executed in
//! `tests/equations`.
//!
//! All of them are put into one copy of the crate below `target/`, each behind a switch that the environment sets, so that the copy is
//! built once and its tests run once per form. Nothing of it stands in `src/`.

use crate::ledgers::equations::{entries, strings, test_of};
use crate::ledgers::files_below;
use crate::prelude::*;
use std::sync::atomic::AtomicUsize;
use std::thread;
use toml::{Table, Value};

/// The environment variable that says which form holds, and the function of the copy that asks it. The function reads it once.
const SWITCH: &str = "CORFEM_WRONG_FORM";
const SWITCH_SOURCE: &str = r#"//! Which wrong form holds.

use std::sync::LazyLock;

static FORM: LazyLock<usize> = LazyLock::new(|| {
    let form = std::env::var("CORFEM_WRONG_FORM").ok();
    form.and_then(|form| form.parse().ok()).unwrap_or(0)
});

pub(crate) fn is(form: usize) -> bool {
    *FORM == form
}
"#;

/// The version of the copy.
const VERSION: &str = "0.0.0";
/// Properties draw the same cases for every form.
const SEED: &str = "1986";
/// A form whose tests take longer never ends.
const LONGEST: Duration = Duration::from_secs(300);
/// As many as the specification must have, and each room beside it.
const LEAST: usize = 75;
const LEAST_OF_ROOM: usize = 30;
/// Rooms with lists of their own.
const ROOMS: [&str; 3] = ["weighted", "job", "files"];
/// Rooms of tests that the copy may have.
const TESTS: [&str; 3] = ["spec", "readers", "evidence"];

/// A wrong form of an equation, a sentence or a law.
struct Form {
    /// From one, in the order of the list.
    number: usize,
    /// The equation's number or the sentence's name, and what is wrong.
    what: String,
    file: String,
    within: Option<String>,
    old: String,
    new: String,
    tests: Vec<String>,
}

fn text(table: &Table, key: &str) -> String {
    let value = table.get(key).and_then(Value::as_str);
    value
        .unwrap_or_else(|| panic!("{key} in {table}"))
        .to_owned()
}

fn forms() -> Vec<Form> {
    let mut forms = Vec::new();
    let mut add = |owner: &str, wrong: &Table, tests: &[String]| {
        forms.push(Form {
            number: forms.len() + 1,
            what: format!("{owner}: {}", text(wrong, "what")),
            file: text(wrong, "file"),
            within: wrong.contains_key("within").then(|| text(wrong, "within")),
            old: text(wrong, "old"),
            new: text(wrong, "new"),
            tests: tests.to_vec(),
        });
    };
    for (owner, entry) in entries() {
        let mut tests = strings(&entry, "tests");
        if entry.contains_key("number") {
            tests.push(format!("equations::{}", test_of(&owner)));
        }
        let wrong = entry["wrong"].as_array().unwrap().iter();
        let wrong = wrong.filter_map(Value::as_table);
        for wrong in wrong.filter(|wrong| wrong.contains_key("file")) {
            add(&owner, wrong, &tests);
        }
    }
    for room in ROOMS {
        for law in laws(room) {
            let tests = strings(&law, "tests");
            for wrong in law["wrong"].as_array().unwrap() {
                add(room, wrong.as_table().unwrap(), &tests);
            }
        }
    }
    forms
}

/// The laws of a room, each with its tests and wrong forms.
fn laws(room: &str) -> Vec<Table> {
    let path = root().join(format!("tests/wrong_forms/{room}.toml"));
    let list = fs::read_to_string(path).expect(room);
    let list: Table = list
        .parse()
        .unwrap_or_else(|error| panic!("{room}: {error}"));
    let laws = list["law"].as_array().unwrap().iter();
    laws.map(|law| law.as_table().unwrap().clone()).collect()
}

/// Code as it is compared: without white space, lines of comment, and the comma before a closing parenthesis, which are
/// `rustfmt`'s; each character with its place.
fn code(source: &str) -> Vec<(char, usize)> {
    let mut code: Vec<(char, usize)> = Vec::new();
    let mut start = 0;
    for line in source.split_inclusive('\n') {
        if !line.trim_start().starts_with("//") {
            for (at, character) in line.char_indices().filter(|(_, c)| !c.is_whitespace()) {
                let is_trailing = code.last().is_some_and(|&(last, _)| last == ',');
                if is_trailing && matches!(character, ')' | '}' | ']') {
                    code.pop();
                }
                code.push((character, start + at));
            }
        }
        start += line.len();
    }
    code
}

/// Where the source has a piece of code, if it has it once.
fn place(code: &[(char, usize)], piece: &str) -> Result<Range<usize>, String> {
    let piece = self::code(piece).into_iter().map(|(c, _)| c).collect_vec();
    let is_here = |at: &usize| {
        let here = code[*at..].iter().map(|(character, _)| character);
        here.take(piece.len()).eq(&piece)
    };
    let found = (0..=code.len() - piece.len().min(code.len()))
        .filter(is_here)
        .collect_vec();
    match found[..] {
        [at] if !piece.is_empty() => Ok(at..at + piece.len()),
        _ => Err(format!("stands there {} times", found.len())),
    }
}

impl Form {
    /// The bytes of the source that the form replaces.
    fn bytes(&self, source: &str) -> Result<Range<usize>, String> {
        let code = code(source);
        let refuse =
            |piece: &str, why: String| format!("{}: {}: {piece:?} {why}", self.what, self.file);
        let mut part = &code[..];
        if let Some(within) = &self.within {
            part = &code[place(part, within).map_err(|why| refuse(within, why))?];
        }
        let found = place(part, &self.old).map_err(|why| refuse(&self.old, why))?;
        let (last, start) = part[found.end - 1];
        Ok(part[found.start].1..start + last.len_utf8())
    }
}

/// A source with all its wrong forms behind the switch. Forms of one place are alternatives there; of two that overlap one must
/// contain the other.
fn with_forms(source: &str, forms: &[&Form]) -> Result<String, String> {
    let mut placed = Vec::new();
    for form in forms {
        placed.push((form.bytes(source)?, *form));
    }
    placed.sort_by_key(|(bytes, form)| (bytes.start, usize::MAX - bytes.end, form.number));
    let (mut out, mut done) = (String::new(), 0);
    for (outer, group) in groups(&placed)? {
        out += &source[done..outer.start];
        let own = &source[outer.clone()];
        // A statement or a block needs no parentheses, and may not have any.
        let is_statement = own.ends_with([';', '}']);
        out += if is_statement { "" } else { "(" };
        for (bytes, form) in group {
            let [before, after] =
                [outer.start..bytes.start, bytes.end..outer.end].map(|rest| &source[rest]);
            let number = form.number;
            out += &format!(
                "if crate::wrong_form::is({number}) {{ {before}{}{after} }} else ",
                form.new
            );
        }
        out += &format!("{{ {own} }}{}", if is_statement { "" } else { ")" });
        done = outer.end;
    }
    Ok(out + &source[done..])
}

type Placed<'a> = (Range<usize>, &'a Form);
/// A place and the forms in it.
type Group<'a> = (Range<usize>, &'a [Placed<'a>]);

/// Forms that share a place, each group with the place that contains all of it.
fn groups<'a>(placed: &'a [Placed<'a>]) -> Result<Vec<Group<'a>>, String> {
    let (mut groups, mut start) = (Vec::new(), 0);
    while let Some((outer, first)) = placed.get(start) {
        let rest = &placed[start..];
        let count = rest
            .iter()
            .take_while(|(bytes, _)| bytes.start < outer.end)
            .count();
        if let Some((_, other)) = rest[..count]
            .iter()
            .find(|(bytes, _)| bytes.end > outer.end)
        {
            return Err(format!("{} overlaps {}", first.what, other.what));
        }
        groups.push((outer.clone(), &rest[..count]));
        start += count;
    }
    Ok(groups)
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Every file of `src/` that has wrong forms, with them.
fn sources(forms: &[Form]) -> Result<BTreeMap<PathBuf, String>, String> {
    let mut by_file: BTreeMap<&str, Vec<&Form>> = BTreeMap::new();
    for form in forms {
        by_file.entry(&form.file).or_default().push(form);
    }
    let mut sources = BTreeMap::new();
    for (file, forms) in by_file {
        let path = Path::new("src").join(file);
        let source =
            fs::read_to_string(root().join(&path)).map_err(|why| format!("{file}: {why}"))?;
        sources.insert(path, with_forms(&source, &forms)?);
    }
    Ok(sources)
}

#[test]
fn every_wrong_form_stands_once_in_its_file() {
    let forms = forms();
    for room in ROOMS {
        let of_room = forms.iter().filter(|form| form.file.starts_with(room));
        assert!(of_room.count() >= LEAST_OF_ROOM, "{room}");
    }
    let of_rooms = ROOMS.len() * LEAST_OF_ROOM;
    assert!(
        forms.len() >= LEAST + of_rooms,
        "{} wrong forms",
        forms.len()
    );
    let mut wrong = Vec::new();
    for form in &forms {
        let path = root().join("src").join(&form.file);
        let source = fs::read_to_string(&path).expect(&form.file);
        wrong.extend(form.bytes(&source).err());
        let pieces = [&form.old, &form.new]
            .map(|piece| code(piece).into_iter().map(|(c, _)| c).collect::<String>());
        if pieces[0] == pieces[1] || form.tests.is_empty() {
            wrong.push(format!("{} changes nothing, or has no test", form.what));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    let sources = sources(&forms).unwrap();
    let switches: usize = sources
        .values()
        .map(|text| text.matches("wrong_form::is(").count())
        .sum();
    assert_eq!(switches, forms.len());
}

#[test]
fn forms_of_one_place_are_alternatives_there() {
    let form = |number, old: &str, new: &str| Form {
        number,
        what: number.to_string(),
        file: String::new(),
        within: None,
        old: old.to_owned(),
        new: new.to_owned(),
        tests: Vec::new(),
    };
    let source = "let a = b\n    // c\n    + c;\nd(\n    e,\n);\n";
    let (sum, part, call) = (
        form(1, "b + c", "b"),
        form(2, "c", "-c"),
        form(3, "d(e);", ""),
    );
    let found = with_forms(source, &[&part, &call, &sum]).unwrap();
    let expected = "let a = (if crate::wrong_form::is(1) { b } else if crate::wrong_form::is(2) { b\n    // c\n    + -c } else { b\n    // c\n    + c });\nif crate::wrong_form::is(3) {  } else { d(\n    e,\n); }\n";
    assert_eq!(found, expected);
    assert!(with_forms(source, &[&sum, &form(4, "+ c; d(e)", "")]).is_err());
    assert!(with_forms(source, &[&form(5, "f", "")]).is_err());
    assert!(with_forms("a + a", &[&form(6, "a", "")]).is_err());
}

/// Writes a file unless it says the same already, so that nothing is built twice.
fn write(path: &Path, text: &[u8]) {
    if fs::read(path).is_ok_and(|old| old == text) {
        return;
    }
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, text).unwrap();
}

/// The modules that the forms need, by their rooms: those of their tests, and what these use.
fn modules(forms: &[Form]) -> BTreeMap<String, BTreeSet<String>> {
    let is_name = |c: &char| c.is_alphanumeric() || *c == '_';
    let name = |rest: &str| rest.chars().take_while(is_name).collect::<String>();
    let tests = forms.iter().flat_map(|form| &form.tests);
    let mut wanted = tests
        .filter(|test| !test.starts_with("equations::"))
        .map(|test| {
            let mut parts = test.split("::").map(str::to_owned);
            let mut part = || parts.next().unwrap();
            (part(), part())
        })
        .collect_vec();
    let mut modules: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    while let Some((room, module)) = wanted.pop() {
        assert!(
            TESTS.contains(&&*room),
            "{room}::{module} is not in the copy"
        );
        let file = root()
            .join("tests")
            .join(&room)
            .join(format!("{module}.rs"));
        let text = fs::read_to_string(file).unwrap_or_default();
        for other in ["presentation", "ledgers", "refuses"] {
            assert!(
                !text.contains(&format!("{other}::")),
                "{module} needs {other}, which the copy has not"
            );
        }
        if modules.entry(room.clone()).or_default().insert(module) {
            for other in TESTS {
                let path = format!("crate::{other}::");
                let used = text.split(&path).skip(1).map(name);
                wanted.extend(used.map(|module| (other.to_owned(), module)));
            }
            let used = text.split("use super::").skip(1).map(name);
            wanted.extend(used.map(|module| (room.clone(), module)));
        }
    }
    modules
}

/// A list of modules without those that are not wanted.
fn list_of(room: &str, wanted: &BTreeSet<String>) -> String {
    let path = root().join("tests").join(room).join("mod.rs");
    let text = fs::read_to_string(path).expect(room);
    let is_wanted = |line: &&str| {
        let module = line
            .strip_prefix("pub ")
            .unwrap_or(line)
            .strip_prefix("mod ");
        let module = module.and_then(|rest| rest.strip_suffix(';'));
        module.is_none_or(|module| wanted.contains(module))
    };
    text.lines()
        .filter(is_wanted)
        .map(|line| format!("{line}\n"))
        .collect()
}

/// The copy: the library with its wrong forms, and of the tests the specification.
fn copy(forms: &[Form], folder: &Path) {
    let sources = sources(forms).unwrap();
    let mut manifest: Table = fs::read_to_string(root().join("Cargo.toml"))
        .unwrap()
        .parse()
        .unwrap();
    for part in ["bin", "bench", "example"] {
        manifest.remove(part);
    }
    // Of another version, so that cargo keeps what it builds of the two apart.
    let package = manifest["package"].as_table_mut().unwrap();
    let version = package.insert("version".to_owned(), VERSION.into());
    let version = version.unwrap().as_str().unwrap().to_owned();
    let lock = fs::read_to_string(root().join("Cargo.lock")).unwrap();
    let own = |version: &str| {
        format!(
            "name = \"{}\"\nversion = \"{version}\"\n",
            env!("CARGO_PKG_NAME")
        )
    };
    assert_eq!(lock.matches(&own(&version)).count(), 1);
    let lock = lock.replace(&own(&version), &own(VERSION));
    for key in ["autobins", "autobenches", "autoexamples"] {
        package.insert(key.to_owned(), false.into());
    }
    write(&folder.join("Cargo.toml"), manifest.to_string().as_bytes());
    let lists = modules(forms);
    let rooms: String = lists.keys().map(|room| format!("mod {room};\n")).collect();
    let main = format!(
        "#![allow(warnings, reason = \"a copy\")]\n#[macro_use]\nmod common;\nmod equations;\n{rooms}use common::prelude;\nuse common::presentation::paper;\n"
    );
    let mut changed = BTreeMap::from([
        (PathBuf::from("tests/main.rs"), main),
        (PathBuf::from("src/wrong_form.rs"), SWITCH_SOURCE.to_owned()),
        (PathBuf::from("Cargo.lock"), lock),
    ]);
    for (room, modules) in &lists {
        changed.insert(
            format!("tests/{room}/mod.rs").into(),
            list_of(room, modules),
        );
    }
    let library = fs::read_to_string(root().join("src/lib.rs")).unwrap();
    changed.insert("src/lib.rs".into(), format!("{library}\nmod wrong_form;\n"));
    changed.extend(sources);
    for (path, text) in &changed {
        write(&folder.join(path), text.as_bytes());
    }
    let mut files = vec![root().join("README.md")];
    let tests = ["common", "equations", "jobs"].into_iter().chain(TESTS);
    let tests = tests.map(|room| format!("tests/{room}"));
    for part in ["src", "golden", "paper", "benches/wing"]
        .map(str::to_owned)
        .into_iter()
        .chain(tests)
    {
        files.extend(files_below(&root().join(part)));
    }
    // Failures that properties of an earlier run have kept are those of its wrong forms, and a file that is gone would be a second one of
    // its module.
    for part in ["src", "tests"].map(|part| folder.join(part)) {
        for file in part
            .is_dir()
            .then(|| files_below(&part))
            .into_iter()
            .flatten()
        {
            let path = file.strip_prefix(folder).unwrap();
            let is_gone = !changed.contains_key(path) && !root().join(path).exists();
            if is_gone
                || path
                    .extension()
                    .is_some_and(|end| end == "proptest-regressions")
            {
                fs::remove_file(&file).unwrap();
            }
        }
    }
    for file in files {
        let path = file.strip_prefix(root()).unwrap();
        if !changed.contains_key(path) {
            write(&folder.join(path), &fs::read(&file).unwrap());
        }
    }
}

/// Builds the tests of the copy with what this program was built with, and returns their program.
fn build(folder: &Path, target: &Path) -> PathBuf {
    let built = Command::new(env!("CARGO"))
        .args([
            "test",
            "--no-run",
            "--locked",
            "--offline",
            "--test",
            "specification",
        ])
        .args(["--message-format", "json"])
        .current_dir(folder)
        .env("CARGO_TARGET_DIR", target)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&built.stdout);
    let messages = said
        .lines()
        .filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok());
    let (mut program, mut errors) = (None, String::new());
    for message in messages {
        if message["target"]["name"] == "specification" && message["executable"].is_string() {
            program = message["executable"].as_str().map(PathBuf::from);
        }
        if message["message"]["level"] == "error" {
            errors += message["message"]["rendered"].as_str().unwrap_or_default();
        }
    }
    assert!(
        built.status.success(),
        "the copy does not build:\n{errors}{}",
        String::from_utf8_lossy(&built.stderr)
    );
    program.unwrap()
}

/// Which of the tests fail with a form; an error when they do not end or none runs.
fn failures(
    program: &Path,
    folder: &Path,
    form: usize,
    tests: &[String],
) -> Result<Vec<String>, String> {
    let log = folder.join(format!("form_{form}.log"));
    let mut child = Command::new(program)
        .args(["--exact", "--test-threads=1"])
        .args(tests)
        .current_dir(folder)
        .env(SWITCH, form.to_string())
        .env("PROPTEST_RNG_SEED", SEED)
        .env("PROPTEST_MAX_SHRINK_ITERS", "0")
        .env("INSTA_UPDATE", "no")
        .stdin(Stdio::null())
        .stdout(fs::File::create(&log).unwrap())
        .stderr(Stdio::null())
        .spawn()
        .map_err(|why| why.to_string())?;
    let start = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().map_err(|why| why.to_string())? {
            break status;
        }
        if start.elapsed() > LONGEST {
            _ = child.kill();
            _ = child.wait();
            return Err(format!("no end after {LONGEST:?}"));
        }
        thread::sleep(Duration::from_millis(20));
    };
    let said = fs::read_to_string(&log).unwrap();
    let counted = format!("running {} test", tests.len());
    if !said.contains(&counted) {
        return Err(format!("not all of {tests:?} were run:\n{said}"));
    }
    let failed = said
        .lines()
        .filter_map(|line| line.strip_prefix("test ")?.split_once(" ... FAILED"));
    let failed = failed.map(|(test, _)| test.to_owned()).collect_vec();
    match (status.success(), failed.is_empty()) {
        (true, true) | (false, false) => Ok(failed),
        _ => Err(format!("{status} without a failed test:\n{said}")),
    }
}

/// `CORFEM_WRONG_FORM` may name some forms, with commas, instead of all.
#[test]
#[ignore = "builds a copy of the crate and runs its specification once per wrong form, some minutes; .ci/run starts it"]
fn every_wrong_form_is_noticed_by_a_test_named_for_its_equation() {
    let program = std::env::current_exe().unwrap();
    let target = program.ancestors().nth(3).unwrap().to_owned();
    let folder = target.join("wrong_forms");
    let forms = forms();
    copy(&forms, &folder);
    let program = build(&folder, &target);
    let all: BTreeSet<String> = forms.iter().flat_map(|form| form.tests.clone()).collect();
    let all = all.into_iter().collect_vec();
    let right = failures(&program, &folder, 0, &all).unwrap();
    assert!(right.is_empty(), "fail without a wrong form: {right:?}");
    let named: Option<Vec<usize>> = std::env::var(SWITCH).ok().map(|list| {
        list.split(',')
            .map(|number| number.trim().parse().unwrap())
            .collect()
    });
    let wanted = forms
        .iter()
        .filter(|form| {
            named
                .as_ref()
                .is_none_or(|named| named.contains(&form.number))
        })
        .collect_vec();
    let next = AtomicUsize::new(0);
    let work = || {
        let mut unnoticed = Vec::new();
        while let Some(form) = wanted.get(next.fetch_add(1, Ordering::Relaxed)) {
            let (number, what) = (form.number, &form.what);
            match failures(&program, &folder, number, &form.tests) {
                Ok(failed) if failed.is_empty() => unnoticed.push(format!("{number}, {what}")),
                Ok(failed) => println!("{number}, {what}: noticed by {}", failed.join(", ")),
                Err(why) => unnoticed.push(format!("{number}, {what}: {why}")),
            }
        }
        unnoticed
    };
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let unnoticed: Vec<String> = thread::scope(|scope| {
        let workers = (0..threads).map(|_| scope.spawn(work)).collect_vec();
        let results = workers.into_iter().map(|worker| worker.join().unwrap());
        results.flatten().collect()
    });
    println!(
        "{} of {} wrong forms noticed",
        wanted.len() - unnoticed.len(),
        wanted.len()
    );
    assert!(unnoticed.is_empty(), "no test notices {unnoticed:#?}");
}
