//! The weight of the code: no room grows beyond its ceiling in `tests/ceilings.toml`, and no function grows long.
//!
//! A token weighs one: a name, a number, a string, an operator. Comments, documentation and white space weigh nothing, so
//! that neither layout nor a longer explanation changes a weight.

use crate::ledgers::files_below;
use crate::ledgers::package::root;
use crate::prelude::*;

/// The ledger, `tests/ceilings.toml`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ceilings {
    weight: Vec<Ceiling>,
    long_functions: BTreeSet<String>,
    /// Documentation lines that begin with a clause, by room.
    pub clauses: BTreeMap<String, usize>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Ceiling {
    room: String,
    ceiling: usize,
    reason: String,
}

pub fn ceilings() -> Ceilings {
    toml::from_str(include_str!("../ceilings.toml")).unwrap()
}

/// The Rust files of `src/` with their texts, by room; files beside the rooms are of the room `.`.
pub fn rooms() -> BTreeMap<String, Vec<(String, String)>> {
    let source = root().join("src");
    let mut rooms: BTreeMap<String, Vec<(String, String)>> = BTreeMap::new();
    for file in files_below(&source) {
        let name = file.strip_prefix(&source).unwrap();
        let name = name.to_string_lossy().replace('\\', "/");
        if name.ends_with(".rs") {
            let room = name.split_once('/').map_or(".", |(room, _)| room);
            let text = fs::read_to_string(&file).unwrap();
            let files = rooms.entry(room.to_owned()).or_default();
            files.push((name, text));
        }
    }
    rooms
}

/// Operators of more than one character, longer ones first.
const OPERATORS: [&str; 22] = [
    "<<=", ">>=", "...", "..=", "::", "->", "=>", "==", "!=", "<=", ">=", "&&", "||", "-=", "+=",
    "*=", "/=", "%=", "^=", "&=", "|=", "..",
];

pub fn is_word(character: char) -> bool {
    character.is_alphanumeric() || character == '_'
}

/// Length of the words at the head of the code.
fn word(code: &str) -> usize {
    code.find(|c| !is_word(c)).unwrap_or(code.len())
}

/// Length of a string in quotation marks at the head of the code.
fn string(code: &str) -> Option<usize> {
    let mut characters = code.strip_prefix('"')?.char_indices();
    while let Some((at, character)) = characters.next() {
        match character {
            '\\' => drop(characters.next()),
            '"' => return Some(at + 2),
            _ => (),
        }
    }
    None
}

/// Length of a string without escapes, such as `r#"..."#`.
fn raw_string(code: &str) -> Option<usize> {
    let marked = code.strip_prefix('r')?;
    let text = marked.trim_start_matches('#');
    let marks = &marked[..marked.len() - text.len()];
    let end = text.strip_prefix('"')?.find(&format!("\"{marks}"))?;
    Some(end + 3 + 2 * marks.len())
}

/// Length of a character in quotation marks; a lifetime is none.
fn character(code: &str) -> Option<usize> {
    let inside = code.strip_prefix('\'')?;
    let first = inside.chars().next()?;
    let rest = &inside[first.len_utf8()..];
    match first {
        '\'' => None,
        '\\' => {
            let escaped = rest.chars().next()?.len_utf8();
            Some(2 + escaped + rest[escaped..].find('\'')? + 1)
        }
        _ => rest.starts_with('\'').then_some(2 + first.len_utf8()),
    }
}

/// Length of the white space, comment or attribute of documentation at the head of the code.
fn blank(code: &str) -> Option<usize> {
    let space = code.len() - code.trim_start().len();
    if space > 0 {
        return Some(space);
    }
    if code.starts_with("//") {
        return Some(code.find('\n').unwrap_or(code.len()));
    }
    if let Some(comment) = code.strip_prefix("/*") {
        return Some(comment.find("*/")? + 4);
    }
    let attribute = code.strip_prefix("#![doc").or(code.strip_prefix("#[doc"))?;
    let value = attribute.trim_start().strip_prefix('=')?.trim_start();
    let included = value.strip_prefix("include_str!(");
    let text = included.unwrap_or(value);
    let end = if included.is_some() { ")]" } else { "]" };
    let rest = text[string(text)?..].strip_prefix(end)?;
    Some(code.len() - rest.len())
}

/// Length of the token at the head of the code.
fn token(code: &str) -> usize {
    let first = code.chars().next().unwrap();
    let unprefixed = code.strip_prefix('b');
    let quoted = |code: &str| string(code).or_else(|| character(code));
    let prefixed = || Some(1 + quoted(unprefixed?)?);
    if let Some(length) = raw_string(code).or_else(prefixed).or_else(|| quoted(code)) {
        return length;
    }
    if first.is_ascii_digit() {
        return code.find(|c| !is_word(c) && c != '.').unwrap_or(code.len());
    }
    let is_name = |c: char| c.is_ascii_alphabetic() || c == '_';
    if is_name(first) {
        let length = word(code);
        return length + usize::from(code[length..].starts_with('!'));
    }
    if first == '\'' && code[1..].starts_with(is_name) {
        return 1 + word(&code[1..]);
    }
    let operator = OPERATORS
        .iter()
        .find(|operator| code.starts_with(**operator));
    operator.map_or(first.len_utf8(), |operator| operator.len())
}

/// The tokens of Rust code, each with its place.
fn tokens(code: &str) -> Vec<(usize, &str)> {
    let (mut found, mut at) = (Vec::new(), 0);
    while at < code.len() {
        let rest = &code[at..];
        let length = blank(rest).unwrap_or_else(|| {
            let length = token(rest);
            found.push((at, &rest[..length]));
            length
        });
        at += length;
    }
    found
}

/// The functions of Rust code with their lines, from `fn` to the closing brace, without documentation.
fn functions(code: &str) -> Vec<(&str, usize)> {
    let tokens = tokens(code);
    let mut found = Vec::new();
    for (place, pair) in tokens.windows(2).enumerate() {
        let [(start, "fn"), (_, name)] = *pair else {
            continue;
        };
        // The type of a function has no name.
        if !name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') {
            continue;
        }
        let (mut depth, mut end) = (0, None);
        for &(at, token) in &tokens[place..] {
            match token {
                "{" | "(" | "[" => depth += 1,
                "}" | ")" | "]" => depth -= 1,
                // A declaration without a body.
                ";" if depth == 0 => break,
                _ => (),
            }
            if token == "}" && depth == 0 {
                end = Some(at);
                break;
            }
        }
        if let Some(end) = end {
            let lines = code[start..=end].lines().map(str::trim_start);
            let is_code = |line: &&str| !line.starts_with("///") && !line.starts_with("//!");
            found.push((name, lines.filter(is_code).count()));
        }
    }
    found
}

/// Lines of the longest function that needs no entry in the ledger.
const LONGEST: usize = 80;

/// Rooms of which the ledger lists no long function.
const SHORT: [&str; 3] = ["method/", "sparse/", "weighted/"];

#[test]
fn no_room_weighs_more_than_its_ceiling() {
    let mut weights: BTreeMap<String, usize> = BTreeMap::new();
    for (room, files) in rooms() {
        let weight = files.iter().map(|(_, text)| tokens(text).len()).sum();
        weights.insert(room, weight);
    }
    weights.insert("src".to_owned(), weights.values().sum());
    for beside in ["paper/presentation", "paper/studies", "tests"] {
        let files = files_below(&root().join(beside)).into_iter();
        let sources = files.filter(|file| file.extension().is_some_and(|own| own == "rs"));
        let weight = sources.map(|file| tokens(&fs::read_to_string(file).unwrap()).len());
        weights.insert(beside.to_owned(), weight.sum());
    }
    let mut listed = BTreeSet::new();
    let mut heavy = Vec::new();
    for Ceiling {
        room,
        ceiling,
        reason,
    } in ceilings().weight
    {
        let weight = weights.get(&room);
        let weight = *weight.unwrap_or_else(|| panic!("tests/ceilings.toml: no room {room}"));
        assert!(
            (1..=100).contains(&reason.len()),
            "tests/ceilings.toml: {room} needs a reason of one line"
        );
        if weight > ceiling {
            heavy.push(format!(
                "{room} weighs {weight} tokens, its ceiling in tests/ceilings.toml is {ceiling}"
            ));
        }
        assert!(
            listed.insert(room.clone()),
            "tests/ceilings.toml: {room} twice"
        );
    }
    assert!(heavy.is_empty(), "{}", heavy.join("\n"));
    let all: BTreeSet<String> = weights.into_keys().collect();
    assert_eq!(listed, all, "rooms of tests/ceilings.toml and of src/");
}

#[test]
fn no_function_is_long_but_those_listed() {
    let mut long = BTreeSet::new();
    for (_, files) in rooms() {
        for (file, text) in files {
            let functions = functions(&text).into_iter();
            let functions = functions.filter(|&(_, lines)| lines > LONGEST);
            long.extend(functions.map(|(name, _)| format!("{file}: {name}")));
        }
    }
    let listed = ceilings().long_functions;
    let new = long.difference(&listed).collect_vec();
    assert!(new.is_empty(), "longer than {LONGEST} lines: {new:#?}");
    let is_short = |name: &&String| SHORT.iter().any(|room| name.starts_with(room));
    assert_eq!(listed.iter().find(is_short), None, "tests/ceilings.toml");
    let gone = listed.difference(&long).collect_vec();
    assert!(
        gone.is_empty(),
        "no longer long, to be taken from tests/ceilings.toml: {gone:#?}"
    );
}

#[test]
fn tokens_are_what_the_compiler_reads() {
    let words = |code| {
        tokens(code)
            .into_iter()
            .map(|(_, token)| token)
            .collect_vec()
    };
    let code =
        "#[doc = \"a // b\"] // c\nfn f<'a>(x: &'a str) -> u8 { /* } */ b'\\'' + 'b' != 0.5e1 }";
    assert_eq!(words(code)[..7], ["fn", "f", "<", "'a", ">", "(", "x"]);
    assert_eq!(
        words(code)[13..],
        ["u8", "{", "b'\\''", "+", "'b'", "!=", "0.5e1", "}"]
    );
    let strings = r####"r#"a " b"# "c \" d" vec![1..2] /// e"####;
    assert_eq!(words(strings)[..2], [r####"r#"a " b"#"####, r#""c \" d""#]);
    assert_eq!(words(strings)[2..], ["vec!", "[", "1..2", "]"]);
    assert_eq!(
        words("#![doc = include_str!(\"../a.md\")]\nmod a;"),
        ["mod", "a", ";"]
    );
}

#[test]
fn a_function_is_measured_without_its_documentation() {
    let code = "trait T {\n    fn a(&self) -> [u8; 2];\n}\n/// B.\nfn b(\n    f: fn(u8),\n) {\n    /// Inner.\n    fn c() {}\n    \"}\";\n}";
    assert_eq!(functions(code), [("b", 6), ("c", 1)]);
}
