//! The wrong forms of `paper/equations.toml` that are places of the source, and those of rooms beside the paper in `tests/wrong_forms`: each
//! fits the source, and at least one test named for its equation or law fails for it. Those that are formulas are executed in
//! `tests/equations`.
//!
//! All of them are put into one copy of the crate below `target/`, each behind a switch that the environment sets, so that the copy is
//! built once and its tests run once per form. Nothing of it stands in `src/`.

use crate::ledgers::equations::{entries, test_of};
use crate::ledgers::{file, files, files_below, is_word, strings};
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

/// Properties draw the same cases for every form.
const SEED: &str = "1986";
/// A form whose tests take longer never ends.
const LONGEST: Duration = Duration::from_secs(300);
/// Rooms with lists of their own, and as many forms as each must have; the specification must have more.
const ROOMS: [&str; 3] = ["weighted", "job", "files"];
const LEAST_OF_ROOM: usize = 30;
const LEAST: usize = 75;
/// Rooms of tests that the copy may have.
const TESTS: [&str; 4] = ["contents", "extensions", "readers", "evidence"];

/// A wrong form of an equation, a sentence or a law.
struct Form {
    /// From one, in the order of the list.
    number: usize,
    /// The equation's number, the sentence's name or the room, and what is wrong.
    what: String,
    /// Below `src/`.
    file: String,
    /// The place of `old`, if it stands elsewhere too.
    within: String,
    old: String,
    new: String,
    tests: Vec<String>,
}

fn forms() -> Vec<Form> {
    let mut laws = Vec::new();
    for (owner, entry) in entries() {
        let mut tests = strings(&entry, "tests");
        if entry.contains_key("number") {
            tests.push(format!("equations::{}", test_of(&owner)));
        }
        laws.push((owner, tests, entry["wrong"].clone()));
    }
    for room in ROOMS {
        let list: Table = file(&format!("tests/wrong_forms/{room}.toml"))
            .parse()
            .unwrap();
        for law in list["law"].as_array().unwrap() {
            let tests = strings(law.as_table().unwrap(), "tests");
            laws.push((room.to_owned(), tests, law["wrong"].clone()));
        }
    }
    let mut forms = Vec::new();
    for (owner, tests, wrong) in laws {
        let places = wrong.as_array().unwrap().iter();
        for wrong in places.filter(|wrong| wrong.get("file").is_some()) {
            let text = |key: &str| wrong.get(key).and_then(Value::as_str).unwrap_or_default();
            forms.push(Form {
                number: forms.len() + 1,
                what: format!("{owner}: {}", text("what")),
                file: text("file").to_owned(),
                within: text("within").to_owned(),
                old: text("old").to_owned(),
                new: text("new").to_owned(),
                tests: tests.clone(),
            });
        }
    }
    forms
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

/// The part of the code that is a piece of code, if it has it once.
fn place<'a>(code: &'a [(char, usize)], piece: &str) -> Result<&'a [(char, usize)], String> {
    let piece = self::code(piece);
    let is_piece = |window: &&[(char, usize)]| {
        let mut pairs = window.iter().zip(&piece);
        pairs.all(|(one, other)| one.0 == other.0)
    };
    let windows = code.windows(piece.len().max(1)).filter(is_piece);
    match windows.collect_vec()[..] {
        [found] if !piece.is_empty() => Ok(found),
        ref found => Err(format!("stands there {} times", found.len())),
    }
}

impl Form {
    /// The bytes of the source that the form replaces.
    fn bytes(&self, source: &str) -> Result<Range<usize>, String> {
        let code = code(source);
        let part = match &self.within[..] {
            "" => Ok(&code[..]),
            within => place(&code, within),
        };
        let found = part.and_then(|part| place(part, &self.old));
        let found = found.map_err(|why| format!("src/{}: {}: it {why}", self.file, self.what))?;
        let (last, end) = found[found.len() - 1];
        Ok(found[0].1..end + last.len_utf8())
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
    let (mut out, mut done, mut rest) = (String::new(), 0, &placed[..]);
    while let Some((outer, first)) = rest.first() {
        let count = rest.iter().take_while(|(bytes, _)| bytes.start < outer.end);
        let (group, others) = rest.split_at(count.count());
        rest = others;
        out += &source[done..outer.start];
        let own = &source[outer.clone()];
        // A statement or a block needs no parentheses, and may not have any.
        let is_statement = own.ends_with([';', '}']);
        out += if is_statement { "" } else { "(" };
        for (bytes, form) in group {
            if bytes.end > outer.end {
                return Err(format!("{} overlaps {}", first.what, form.what));
            }
            let (before, after) = (
                &source[outer.start..bytes.start],
                &source[bytes.end..outer.end],
            );
            let (number, new) = (form.number, &form.new);
            out += &format!("if crate::wrong_form::is({number}) {{ {before}{new}{after} }} else ");
        }
        out += &format!("{{ {own} }}{}", if is_statement { "" } else { ")" });
        done = outer.end;
    }
    Ok(out + &source[done..])
}

/// Every file of `src/` that has wrong forms, with them.
fn sources(forms: &[Form]) -> Result<BTreeMap<String, String>, String> {
    let mut by_file: BTreeMap<&str, Vec<&Form>> = BTreeMap::new();
    for form in forms {
        by_file.entry(&form.file).or_default().push(form);
    }
    let mut sources = BTreeMap::new();
    for (name, forms) in by_file {
        let path = format!("src/{name}");
        let source = with_forms(file(&path), &forms)?;
        sources.insert(path, source);
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
    assert!(forms.len() >= LEAST + ROOMS.len() * LEAST_OF_ROOM);
    let piece = |text: &str| code(text).into_iter().map(|(c, _)| c).collect_vec();
    for form in &forms {
        let changes = piece(&form.old) != piece(&form.new);
        assert!(changes && !form.tests.is_empty(), "{}", form.what);
    }
    let switches = |text: &String| text.matches("wrong_form::is(").count();
    let sources = sources(&forms).unwrap();
    assert_eq!(sources.values().map(switches).sum::<usize>(), forms.len());
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
    let name = |rest: &str| rest.split(|c| !is_word(c)).next().unwrap().to_owned();
    let tests = forms.iter().flat_map(|form| &form.tests);
    let mut wanted = Vec::new();
    for test in tests.filter(|test| !test.starts_with("equations::")) {
        let (room, rest) = test.split_once("::").unwrap();
        wanted.push((room.to_owned(), name(rest)));
    }
    let mut modules: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    while let Some((room, module)) = wanted.pop() {
        assert!(TESTS.contains(&&*room), "{room}::{module} is not copied");
        let own = files(&format!("tests/{room}/{module}.rs"), "");
        let text = own.first().map_or("", |(_, text)| text);
        if modules.entry(room.clone()).or_default().insert(module) {
            for other in TESTS {
                let path = format!("crate::{other}::");
                let used = text.split(&path).skip(1);
                wanted.extend(used.map(|rest| (other.to_owned(), name(rest))));
            }
            let used = text.split("use super::").skip(1);
            wanted.extend(used.map(|rest| (room.clone(), name(rest))));
        }
    }
    modules
}

/// The copy: the library with its wrong forms, and of the tests the specification.
fn copy(forms: &[Form], folder: &Path) {
    let mut changed = sources(forms).unwrap();
    let mut manifest: Table = file("Cargo.toml").parse().unwrap();
    for part in ["bin", "bench", "example"] {
        manifest.remove(part);
    }
    // Of another version, so that cargo keeps what it builds of the two apart.
    let package = manifest["package"].as_table_mut().unwrap();
    for key in ["autobins", "autobenches", "autoexamples"] {
        package.insert(key.to_owned(), false.into());
    }
    package.insert("version".to_owned(), "0.0.0".into());
    let own = |version: &str| format!("name = \"corfem\"\nversion = \"{version}\"\n");
    let lock = file("Cargo.lock").replace(&own(env!("CARGO_PKG_VERSION")), &own("0.0.0"));
    let mut main = "#![allow(warnings, reason = \"a copy\")]\n#[macro_use]\nmod common;\nmod equations;\nuse common::prelude;\nuse common::presentation::paper;\n".to_owned();
    for (room, wanted) in modules(forms) {
        main += &format!("mod {room};\n");
        let list = format!("tests/{room}/mod.rs");
        let mut lines = file(&list).lines().collect_vec();
        lines.retain(|line| {
            let module = line.trim_start_matches("pub ").strip_prefix("mod ");
            module.is_none_or(|module| wanted.contains(module.trim_end_matches(';')))
        });
        changed.insert(list, lines.join("\n"));
    }
    let library = format!("{}\nmod wrong_form;\n", file("src/lib.rs"));
    changed.extend([
        ("Cargo.toml".to_owned(), manifest.to_string()),
        ("Cargo.lock".to_owned(), lock),
        ("tests/main.rs".to_owned(), main),
        ("src/lib.rs".to_owned(), library),
        ("src/wrong_form.rs".to_owned(), SWITCH_SOURCE.to_owned()),
    ]);
    // Failures that properties of an earlier run have kept are those of its wrong forms, and a file that is gone would be a second one of
    // its module.
    let parts = ["src", "tests", "paper"].map(|part| folder.join(part));
    for part in parts.iter().filter(|part| part.is_dir()) {
        for path in files_below(part) {
            let name = path.strip_prefix(folder).unwrap().to_string_lossy();
            let is_there = changed.contains_key(&*name) || in_root(&*name).exists();
            if !is_there || name.ends_with("proptest-regressions") {
                fs::remove_file(&path).unwrap();
            }
        }
    }
    for (name, text) in &changed {
        write(&folder.join(name), text.as_bytes());
    }
    let rooms = ["common", "equations", "jobs"].into_iter().chain(TESTS);
    let rooms = rooms.map(|room| format!("tests/{room}"));
    let parts = ["src", "golden", "paper", "benches/wing"].map(str::to_owned);
    let copied = parts
        .into_iter()
        .chain(rooms)
        .flat_map(|part| files_below(&in_root(part)));
    for path in copied.chain([in_root("README.md")]) {
        let name = path.strip_prefix(in_root("")).unwrap();
        if !changed.contains_key(&*name.to_string_lossy()) {
            write(&folder.join(name), &fs::read(&path).unwrap());
        }
    }
}

/// Builds the tests of the copy with what this program was built with, and returns their program.
fn build(folder: &Path, target: &Path) -> PathBuf {
    let arguments = "test --no-run --locked --offline --test specification --message-format json";
    let mut command = Command::new(env!("CARGO"));
    command.args(arguments.split(' ')).current_dir(folder);
    let built = command.env("CARGO_TARGET_DIR", target).output().unwrap();
    let (mut program, mut errors) = (None, String::new());
    for line in String::from_utf8_lossy(&built.stdout).lines() {
        let message: serde_json::Value = serde_json::from_str(line).unwrap_or_default();
        if message["target"]["name"] == "specification" && message["executable"].is_string() {
            program = message["executable"].as_str().map(PathBuf::from);
        }
        if message["message"]["level"] == "error" {
            errors += message["message"]["rendered"].as_str().unwrap_or_default();
        }
    }
    let said = String::from_utf8_lossy(&built.stderr);
    assert!(built.status.success(), "no copy:\n{errors}{said}");
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
