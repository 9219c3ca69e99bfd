//! The rooms of `src/`: what each imports, how much it weighs, and how its documentation begins; and that every test is run.
//!
//! A token weighs one: a name, a number, a string, an operator. Comments, documentation and white space weigh nothing, so that neither
//! layout nor a longer explanation changes a weight.

use crate::ledgers::{file, files, is_word};
use crate::prelude::*;
use toml::Table as Ledger;

/// In order.
const ROOMS: [&str; 8] = [
    "method",
    "sparse",
    "weighted",
    "torque_box",
    "files",
    "job",
    "present",
    "program",
];

/// The paths that a file's `use` lines name, without those that it only hands on.
fn imports(text: &str) -> Vec<String> {
    let mut paths = Vec::new();
    for statement in text.split("\nuse ").skip(1) {
        let tree = statement.split(';').next().unwrap();
        expand("", &tree.replace([' ', '\n'], ""), &mut paths);
    }
    paths
}

/// Every path of a tree such as `a::{b, c::{d, e}}`.
fn expand(before: &str, tree: &str, paths: &mut Vec<String>) {
    let Some((head, rest)) = tree.split_once('{') else {
        return paths.push(format!("{before}{tree}"));
    };
    let (mut depth, mut start) = (0, 0);
    for (at, character) in rest.char_indices() {
        match character {
            '{' => depth += 1,
            ',' | '}' if depth == 0 => {
                if start < at {
                    expand(&format!("{before}{head}"), &rest[start..at], paths);
                }
                start = at + 1;
            }
            '}' => depth -= 1,
            _ => (),
        }
    }
}

/// The paths that every file of `src/` imports, from the root of the crate, by the file's module.
fn modules() -> BTreeMap<String, Vec<String>> {
    let mut modules = BTreeMap::new();
    for (name, text) in files("src/", ".rs") {
        let module = name.trim_start_matches("src/").trim_end_matches(".rs");
        let module = module.trim_end_matches("/mod").replace('/', "::");
        let mut paths = imports(text);
        for path in &mut paths {
            let mut place = module.split("::").collect_vec();
            let mut rest = &path[..];
            while let Some(path) = rest.strip_prefix("super::") {
                place.pop();
                rest = path;
            }
            place.push(rest);
            let absolute = rest.strip_prefix("crate::").map(str::to_owned);
            *path = absolute.unwrap_or_else(|| place.join("::"));
        }
        modules.insert(module, paths);
    }
    modules
}

/// Files beside the rooms are `lib`, `main`, `tour` and the chains of examples.
pub fn every_room_imports_only_from_rooms_before_it() -> Vec<String> {
    let room = |path: &str| {
        let name = path.split("::").next();
        ROOMS.iter().position(|room| Some(*room) == name)
    };
    let mut wrong = Vec::new();
    for (module, imports) in modules() {
        let here = room(&module);
        let is_late = |import: &&String| here.is_some() && room(import) > here;
        let late = imports.iter().filter(is_late);
        wrong.extend(late.map(|import| format!("src/{module}: it imports {import}")));
        if here.is_none() && !["chain", "lib", "main", "tour"].contains(&&*module) {
            wrong.push(format!("src/{module}: it is in no room"));
        }
    }
    wrong
}

pub fn no_two_files_import_each_other() -> Vec<String> {
    let modules = modules();
    let is_part = |module: &str, path: &str| path.starts_with(&format!("{module}::"));
    // The file in which a path ends: that of its longest part that is a module.
    let file = |path: &String| {
        let parts = modules.keys().filter(|module| is_part(module, path));
        parts.max_by_key(|module| module.len())
    };
    let imports = |module: &String| -> BTreeSet<&String> {
        modules[module].iter().filter_map(file).collect()
    };
    let mut wrong = Vec::new();
    for one in modules.keys() {
        for other in imports(one) {
            // A folder's own file hands on what its parts hold, and they share what it has.
            if one < other && !is_part(one, other) && imports(other).contains(one) {
                wrong.push(format!("src/{one}, src/{other}: they import each other"));
            }
        }
    }
    wrong
}

/// Length of what stands at the head of Rust code, and whether it is a token.
fn token(code: &str) -> (usize, bool) {
    let until = |start: usize, end: &str| {
        let found = code[start..].find(end);
        found.map_or(code.len(), |at| start + at + end.len())
    };
    let while_it_is = |start: usize, is: fn(char) -> bool| {
        let rest = &code[start..];
        start + rest.find(|c| !is(c)).unwrap_or(rest.len())
    };
    let first = code.chars().next().unwrap();
    let hashes = while_it_is(1, |c| c == '#');
    if first == 'r' && code[hashes..].starts_with('"') {
        let end = format!("\"{}", &code[1..hashes]);
        return (until(hashes + 1, &end), true);
    }
    if first == 'b' && code[1..].starts_with(['"', '\'']) {
        return (1 + token(&code[1..]).0, true);
    }
    let length = match first {
        ' ' | '\n' => return (1, false),
        '#' if code.starts_with("#[doc =") || code.starts_with("#![doc =") => {
            return (until(0, "]\n"), false);
        }
        '/' if code.starts_with("//") => return (until(0, "\n"), false),
        '"' => {
            let (bytes, mut at) = (code.as_bytes(), 1);
            while bytes[at] != b'"' {
                at += 1 + usize::from(bytes[at] == b'\\');
            }
            at + 1
        }
        '\'' if code[1..].starts_with('\\') => until(3, "'"),
        '\'' => match code[1..].char_indices().nth(1) {
            Some((at, '\'')) => at + 2,
            _ => while_it_is(1, is_word),
        },
        '0'..='9' => while_it_is(0, |c| is_word(c) || c == '.'),
        'a'..='z' | 'A'..='Z' | '_' => {
            let end = while_it_is(0, is_word);
            end + usize::from(code[end..].starts_with('!'))
        }
        _ => {
            let long = "<<= >>= ... ..= :: -> => == != <= >= && || -= += *= /= %= ^= &= |= ..";
            let operator = long.split(' ').find(|operator| code.starts_with(operator));
            operator.map_or(first.len_utf8(), str::len)
        }
    };
    (length, true)
}

fn weight(mut code: &str) -> i64 {
    let mut count = 0;
    while !code.is_empty() {
        let (length, is_token) = token(code);
        count += i64::from(is_token);
        code = &code[length..];
    }
    count
}

fn ceilings() -> Ledger {
    file("tests/ceilings.toml").parse().unwrap()
}

/// The room of a file of `src/`; `.` is that of files beside the rooms.
fn room_of(name: &str) -> &str {
    let path = name.trim_start_matches("src/");
    path.split_once('/').map_or(".", |(room, _)| room)
}

pub fn no_room_weighs_more_than_its_ceiling() -> Vec<String> {
    let mut weights = BTreeMap::new();
    for folder in ["src", "paper/presentation", "paper/studies", "tests"] {
        for (name, text) in files(folder, ".rs") {
            let weight = weight(text);
            *weights.entry(folder).or_insert(0) += weight;
            if folder == "src" {
                *weights.entry(room_of(name)).or_insert(0) += weight;
            }
        }
    }
    let mut wrong = Vec::new();
    for ceiling in ceilings()["weight"].as_array().unwrap() {
        let room = ceiling["room"].as_str().unwrap();
        let weight = weights.remove(room).unwrap_or(i64::MAX);
        let reason = ceiling["reason"].as_str().unwrap();
        if Some(weight) > ceiling["ceiling"].as_integer() || !(1..=100).contains(&reason.len()) {
            wrong.push(format!(
                "tests/ceilings.toml: {room}: it weighs {weight}; a reason has one line"
            ));
        }
    }
    wrong.extend(
        weights
            .keys()
            .map(|room| format!("tests/ceilings.toml: it has no {room}")),
    );
    wrong
}

/// "What the test sees of a parameter" leaves the reader to find the noun: an interval, a share, an answer of yes or no. Counted are the
/// first line of every block of documentation and the first below its heading "Errors".
pub fn documentation_begins_with_its_noun() -> Vec<String> {
    let openings = "What|How|Whether|Where|Which|Those|The same|That|These|They|Such";
    let is_clause = |line: &str| {
        let mut openings = openings.split('|');
        openings.any(|own| {
            line.strip_prefix(own)
                .is_some_and(|rest| !rest.starts_with(is_word))
        })
    };
    let mut found: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for (name, text) in files("src/", ".rs") {
        let (mut before, mut is_below_errors) = ("", false);
        let clauses = found.entry(room_of(name)).or_default();
        for (line, number) in text.lines().map(str::trim).zip(1..) {
            let mark = line.get(..3).filter(|mark| ["///", "//!"].contains(mark));
            let mark = mark.unwrap_or("");
            let words = line[mark.len()..].trim();
            if !mark.is_empty() && (mark != before || is_below_errors) && is_clause(words) {
                clauses.push(format!("    {name}:{number}: {words}"));
            }
            // A heading has an empty line below it.
            let goes_on = is_below_errors && words.is_empty();
            is_below_errors = !mark.is_empty() && (words == "# Errors" || goes_on);
            before = mark;
        }
    }
    let ceilings = ceilings();
    found.retain(|room, clauses| {
        ceilings["clauses"]
            .get(room)
            .and_then(toml::Value::as_integer)
            != Some(clauses.len() as i64)
    });
    let tell = |(room, clauses): (&str, Vec<String>)| {
        let places = clauses.join("\n");
        format!(
            "tests/ceilings.toml: {room} has {} clauses:\n{places}",
            clauses.len()
        )
    };
    found.into_iter().map(tell).collect()
}

/// A file that nobody lists is a test that never runs, and a failure that a property once found is kept beside it.
pub fn every_file_of_tests_is_part_of_the_test_program() -> Vec<String> {
    let mut wrong = Vec::new();
    for (name, _) in files("tests/", ".rs") {
        let module = name.trim_end_matches(".rs").trim_end_matches("/mod");
        let (folder, module) = module.rsplit_once('/').unwrap();
        let lists = [
            format!("{folder}/mod.rs"),
            format!("{folder}.rs"),
            "tests/main.rs".to_owned(),
        ];
        let listed = format!("mod {module};");
        let mut lists = lists.iter().flat_map(|list| files(list, ""));
        if module != "main" && !lists.any(|(_, list)| list.contains(&listed)) {
            wrong.push(format!("{name}: it is in no list"));
        }
    }
    for (name, _) in files("tests/", ".proptest-regressions") {
        let source = files(&name.replace(".proptest-regressions", ".rs"), "");
        if !source.iter().any(|(_, text)| text.contains("properties!")) {
            wrong.push(format!("{name}: it belongs to no property"));
        }
    }
    wrong
}
