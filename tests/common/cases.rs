//! Laws whose cases stand in TOML: what they begin with, what is put into it, and what is then said of it or read from it.

use crate::prelude::*;

/// The laws of a list, and the texts that its cases begin with.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct List {
    #[serde(default)]
    texts: BTreeMap<String, String>,
    laws: Vec<Law>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Law {
    law: String,
    /// Text that the cases begin with, by its name.
    #[serde(default)]
    of: String,
    cases: Vec<Case>,
}

/// What is done, and what must come of it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Case {
    /// Another text in the place of the law's.
    text: Option<String>,
    /// Texts, old and new, that each replace the other where it first stands.
    #[serde(default)]
    put: Vec<[String; 2]>,
    /// Lines that follow.
    #[serde(default)]
    add: String,
    /// Names given with the call.
    #[serde(default)]
    with: Vec<String>,
    /// Part of the words of a refusal.
    says: Option<String>,
    /// Line that a refusal names.
    line: Option<usize>,
    /// Some of what is read, by name.
    #[serde(default)]
    reads: Value,
    /// Text that reads the same, by its name.
    same: Option<String>,
}

/// Whether a value has all that another one asks for: numbers within a part of them, of an object the keys asked for, and of words those
/// around "…".
fn has(found: &Value, asked: &Value, within: f64) -> bool {
    match (found, asked) {
        (_, Value::Null) => true,
        (Value::Object(found), Value::Object(asked)) => asked.iter().all(|(key, asked)| {
            found
                .get(key)
                .is_some_and(|found| has(found, asked, within))
        }),
        (Value::Array(found), Value::Array(asked)) => {
            found.len() == asked.len() && found.iter().zip(asked).all(|(a, b)| has(a, b, within))
        }
        (Value::String(found), Value::String(asked)) => {
            let mut pieces = asked.split('…');
            let rest = found.strip_prefix(pieces.next().unwrap_or_default());
            let rest = pieces.fold(rest, |rest, piece| Some(rest?.split_once(piece)?.1));
            rest.is_some_and(|rest| rest.is_empty() || asked.contains('…'))
        }
        _ => match (found.as_f64(), asked.as_f64()) {
            (Some(a), Some(b)) => (a - b).abs() <= within * if b == 0.0 { 1.0 } else { b.abs() },
            _ => found == asked,
        },
    }
}

/// Asserts all laws of a list by what reads a text, with the names that a case gives; some texts may be made, and numbers
/// may be apart by a part of them.
pub fn hold(
    list: &str,
    made: &[(&str, String)],
    within: f64,
    read: impl Fn(&str, &[String]) -> Result<Value, String>,
) {
    let mut list: List = toml::from_str(list).unwrap();
    let made = made
        .iter()
        .map(|(name, text)| (name.to_string(), text.clone()));
    list.texts.extend(made);
    let mut broken = Vec::new();
    for Law { law, of, cases } in &list.laws {
        for case in cases {
            let mut text = case
                .text
                .as_ref()
                .unwrap_or_else(|| &list.texts[of])
                .clone();
            for [old, new] in &case.put {
                assert!(text.contains(old), "{law}: {old} is not in {text}");
                text = text.replacen(old, new, 1);
            }
            let found = read(&(text.clone() + &case.add), &case.with);
            let is_held = match (&found, &case.says, &case.same) {
                (Err(said), Some(says), _) => {
                    let line = |line| said.contains(&format!(", line {line}: "));
                    said.contains(says) && case.line.is_none_or(line)
                }
                (Ok(_), None, Some(same)) => found == read(&list.texts[same], &case.with),
                (Ok(found), None, None) => has(found, &case.reads, within),
                _ => false,
            };
            if !is_held {
                broken.push(format!(
                    "{law}: {:?}\n{text}{}\n{found:?}",
                    case.says, case.add
                ));
            }
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n\n"));
}
