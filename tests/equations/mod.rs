//! The equations of `paper/equations.toml` as they are printed there, executed on what the crate answers to the known vectors.
//!
//! `formula` reads the TeX, `world` and `letters.toml` say what its letters stand for, `vectors` compares the crate's answers with those
//! of another program. A misprint is noticed: it makes the two sides differ, or does not run.

#![allow(
    non_snake_case,
    reason = "appendices keep their letters, and sort after the main text by them"
)]

mod formula;
mod keys;
mod mistakes;
mod vectors;
mod world;

use crate::prelude::*;
use toml::Table;
use world::World;

#[derive(Deserialize)]
struct Letters {
    misprints: Vec<[String; 2]>,
    true_statements: Vec<String>,
    world: Vec<World>,
}

static LETTERS: LazyLock<Letters> = LazyLock::new(|| {
    let letters: Letters = toml::from_str(include_str!("letters.toml")).unwrap();
    let world = letters.world.into_iter().map(World::read).collect();
    Letters { world, ..letters }
});

static EQUATIONS: LazyLock<Vec<Table>> = LazyLock::new(|| {
    let document: Table = include_str!("../../paper/equations.toml").parse().unwrap();
    let equations = document["equation"].as_array().unwrap().iter();
    equations
        .map(|equation| equation.as_table().unwrap().clone())
        .collect()
});

static FORMULAS: LazyLock<BTreeMap<String, String>> = LazyLock::new(|| {
    let pair = |equation: &Table| (text(equation, "number"), text(equation, "formula"));
    EQUATIONS.iter().map(pair).collect()
});

fn text(table: &Table, key: &str) -> String {
    table[key].as_str().unwrap().to_owned()
}

/// The relative differences of a formula's sides wherever its equation must hold; none if it does not run, NaN where nothing is compared.
fn residual(number: &str, formula: &str) -> Option<f64> {
    let worlds = LETTERS
        .world
        .iter()
        .filter(|world| world.equations.iter().any(|own| own == number));
    let residuals = worlds.map(|world| world.residual(formula).ok());
    residuals.reduce(|a, b| Some(a? + b?)).flatten()
}

/// One test an equation, by its number.
macro_rules! equations {
    ($($name:ident)*) => { $(
        #[test]
        fn $name() {
            let number = stringify!($name).replacen("eq_", "", 1).replace('_', ".").replace(".0", ".");
            let number = number.trim_start_matches('0');
            let apart = residual(number, &FORMULAS[number]);
            assert!(apart.is_some_and(|apart| apart <= FORMULA), "({number}): {apart:?}");
        }
    )* };
}

equations! {
    eq_01 eq_02 eq_03 eq_04 eq_05 eq_06 eq_07 eq_08 eq_09 eq_10 eq_11 eq_12 eq_13
    eq_A_01 eq_A_02 eq_A_03 eq_A_04 eq_A_05 eq_A_06 eq_A_07 eq_A_08 eq_A_09
    eq_B_01 eq_B_02 eq_B_03 eq_B_04 eq_B_05 eq_B_06 eq_B_07
    eq_C_01 eq_C_02 eq_C_03 eq_C_04 eq_C_05 eq_C_06 eq_C_07 eq_C_08 eq_C_09 eq_C_10 eq_C_11 eq_C_12
    eq_C_13 eq_C_14 eq_C_15 eq_C_16 eq_C_17 eq_C_18 eq_C_19 eq_C_20 eq_C_21 eq_C_22 eq_C_23 eq_C_24
}

/// Every formula that one change of one place makes.
fn misprints(formula: &str) -> Vec<String> {
    let mut found = Vec::new();
    for [old, new] in &LETTERS.misprints {
        let places = formula.match_indices(old.as_str());
        found.extend(
            places.map(|(at, _)| format!("{}{new}{}", &formula[..at], &formula[at + old.len()..])),
        );
    }
    found.sort();
    found.dedup();
    found
}

#[test]
fn misprints_are_noticed() {
    let (mut unnoticed, mut doubtful) = (Vec::new(), Vec::new());
    for (number, formula) in &*FORMULAS {
        for wrong in misprints(formula) {
            match residual(number, &wrong) {
                Some(apart) if apart <= FORMULA => unnoticed.push(format!("({number}) {wrong}")),
                Some(apart) if apart <= MISPRINT => doubtful.push((wrong, apart)),
                _ => (),
            }
        }
    }
    assert!(doubtful.is_empty(), "{doubtful:?}");
    assert_eq!(unnoticed, LETTERS.true_statements);
}

/// The wrong forms of an equation that are formulas, each with what is wrong.
fn wrong_forms(equation: &Table) -> Vec<(String, String)> {
    let (number, formula) = (text(equation, "number"), text(equation, "formula"));
    let forms = equation["wrong"].as_array().unwrap().iter();
    let forms = forms.filter_map(|form| form.as_table().filter(|form| !form.contains_key("file")));
    let wrong = |form: &Table| {
        let (what, old) = (text(form, "what"), text(form, "old"));
        assert!(formula.contains(&old), "({number}) has no {old}");
        (what, formula.replace(&old, &text(form, "new")))
    };
    forms.map(wrong).collect()
}

#[test]
fn wrong_forms_are_noticed() {
    for equation in &*EQUATIONS {
        let number = text(equation, "number");
        let printed = ["print", "scan"]
            .into_iter()
            .filter_map(|key| equation.get(key));
        let printed = printed.map(|formula| {
            (
                "as printed".to_owned(),
                formula.as_str().unwrap().to_owned(),
            )
        });
        for (what, formula) in wrong_forms(equation).into_iter().chain(printed) {
            let apart = residual(&number, &formula);
            assert!(
                apart.is_none_or(|apart| apart > MISPRINT),
                "({number}) {what}: {apart:?}"
            );
        }
    }
}
