//! What a program answers to the known vectors that has an equation wrong: `golden/wrong_answers.json`, by which `golden/mark.py` names the
//! mistake. `CORFEM_WRITE=1 cargo test` writes it anew.

use super::formula::{Letter, Refused};
use super::vectors::{flat, is_near, vectors};
use super::world::{World, clauses};
use super::{EQUATIONS, LETTERS, text, wrong_forms};
use crate::prelude::*;

/// The numbers, row by row, that a wrong formula makes of the right side of a clause.
fn wrong(
    world: &World,
    formula: &str,
    [letter, answer, _]: &[String; 3],
    right: &str,
) -> Result<Vec<Complex<f64>>, Refused> {
    let condition = if formula.contains("\\ne j") {
        ", \\quad i \\ne j"
    } else {
        ""
    };
    let mut world = world.clone();
    world
        .then
        .extend([format!("{letter} = {right}{condition}"), answer.clone()]);
    let mut numbers = Vec::new();
    for index in world.each() {
        let (letters, _) = world.letters(formula, &index)?;
        if let Letter::One(value) = &letters["\\eta"] {
            numbers.extend(value.transpose().iter());
            if value.len() > 1 {
                break;
            }
        }
    }
    Ok(numbers)
}

fn digits(numbers: &[f64]) -> Vec<f64> {
    let six = |x: &f64| format!("{x:.5e}").parse().unwrap();
    numbers.iter().map(six).collect()
}

/// Every wrong answer that differs from the known one.
fn wrong_answers() -> Vec<Value> {
    let (known, mut found) = (vectors(), Vec::new());
    for equation in &*EQUATIONS {
        let number = text(equation, "number");
        let worlds = LETTERS
            .world
            .iter()
            .filter(|world| world.equations.contains(&number));
        let worlds = worlds.collect_vec();
        for (what, formula) in wrong_forms(equation) {
            for (world, (left, right, _)) in worlds
                .iter()
                .flat_map(|world| clauses(&formula).map(move |clause| (world, clause)))
            {
                let Some(answer) = world.answers.get(left) else {
                    continue;
                };
                let Ok(numbers) = wrong(world, &formula, answer, right) else {
                    continue;
                };
                let vector = known
                    .iter()
                    .find(|vector| vector["name"] == *world.vector)
                    .unwrap();
                for (end, part) in [
                    ("", numbers.iter().map(|z| z.re).collect_vec()),
                    ("_imaginary", numbers.iter().map(|z| z.im).collect()),
                ] {
                    let key = format!("{}{end}", answer[2]);
                    let right = vector["answer"].get(&key).map(flat).unwrap_or_default();
                    if right.len() == part.len() && !is_near(&part, &right, WRONG_ANSWER) {
                        found.push(json!({ "vector": world.vector, "key": key, "equation": number, "what": what, "answer": digits(&part) }));
                    }
                }
            }
        }
    }
    found
}

#[test]
fn wrong_answers_name_the_mistake() {
    let found = wrong_answers();
    let lines = found.iter().map(Value::to_string).collect_vec();
    let new = format!("[\n{}\n]\n", lines.join(",\n"));
    let old = on_file("golden/wrong_answers.json", &new);
    let old: Vec<Value> = serde_json::from_str(&old).unwrap();
    assert_eq!(old.len(), found.len());
    for (old, new) in old.iter().zip(&found) {
        let [before, now] = [old, new].map(|entry| flat(&entry["answer"]));
        let is_same = is_near(&before, &now, WRONG_ANSWER);
        assert!(
            is_same && old["what"] == new["what"] && old["key"] == new["key"],
            "{old}\n{new}"
        );
    }
}

/// No two mistakes have the same answers throughout, but for equations that are printed twice.
#[test]
fn no_two_mistakes_have_the_same_answers() {
    let mut answers: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for mut wrong in wrong_answers() {
        let entry = wrong.as_object_mut().unwrap();
        let mistake = [entry.remove("what"), entry.remove("equation")];
        answers
            .entry(json!(mistake).to_string())
            .or_default()
            .insert(wrong.to_string());
    }
    let different: BTreeSet<_> = answers.values().collect();
    assert_eq!(different.len(), answers.len(), "{:?}", answers.keys());
    assert!(answers.len() > 25);
}
