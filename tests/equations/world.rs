//! What the letters of a formula stand for, by `letters.toml`: numbers of the crate, and what formulas make of them.

use super::FORMULAS;
use super::formula::{Formula, Letter, Letters, Places, Refused, Value, add};
use super::vectors::{found, letter};
use crate::prelude::*;

/// Known answers in which equations must hold.
#[derive(Clone, Deserialize)]
pub struct World {
    pub vector: String,
    pub equations: Vec<String>,
    ranges: Places,
    /// An index that the formulas do not write.
    each: Option<char>,
    /// By letter, keys of the vector's answer or, with "given" before them, of its input; with commas those of a family.
    given: BTreeMap<String, String>,
    /// Definitions of more letters; those of an equation by its number.
    pub then: Vec<String>,
    /// By the left side of a clause, the known answer that it leads to: a letter for the right side, what defines `\\eta` by it, a key.
    #[serde(default)]
    pub answers: BTreeMap<String, [String; 3]>,
    #[serde(skip)]
    letters: Letters,
}

/// The sides of a formula's equations, and whether they hold for different modes alone (rule 1).
pub fn clauses(formula: &str) -> impl Iterator<Item = (&str, &str, bool)> {
    let is_apart = formula.contains("i \\ne j");
    let parts = formula
        .split("\\qquad")
        .flat_map(|part| part.split("\\quad"));
    let sides = parts.filter_map(|part| part.trim_end_matches([' ', ',']).split_once('='));
    sides.map(move |(left, right)| (left.trim(), right, is_apart))
}

pub type Clause<'a> = (&'a str, &'a str, bool);

impl World {
    /// Looks up the letters that are given.
    pub fn read(mut self) -> Self {
        let found = found(&self.vector);
        let given = self.given.iter();
        self.letters = given
            .map(|(name, keys)| (name.clone(), letter(&found, keys)))
            .collect();
        self
    }

    /// The letters with those that the world and a formula define, and what is left of the formula to be compared.
    pub fn letters<'a>(
        &self,
        formula: &'a str,
        index: &Places,
    ) -> Result<(Letters, Vec<Clause<'a>>), Refused> {
        let then = self
            .then
            .iter()
            .map(|line| FORMULAS.get(line).unwrap_or(line));
        let then = then.flat_map(|line| clauses(line)).collect_vec();
        let mut letters = self.letters.clone();
        // What the formula defines may need what the world defines, or the other way round.
        for clause in &then {
            _ = self.define(&mut letters, clause, index);
        }
        let is_new = |clause: &Clause| self.defined(clause, &letters).is_some();
        let (new, checks): (Vec<_>, _) = clauses(formula).partition(is_new);
        for clause in new.iter().chain(&then) {
            self.define(&mut letters, clause, index)?;
        }
        Ok((letters, checks))
    }

    /// Where the index stands that the formulas do not write, one after the other.
    pub fn each(&self) -> impl Iterator<Item = Places> {
        let at = |at| self.each.map(|each| (each, at)).into_iter().collect();
        (0..self.each.map_or(1, |each| self.ranges[&each])).map(at)
    }

    /// The differences of the two sides of a formula's equations, relative to the larger of them or to the terms that cancel.
    pub fn residual(&self, formula: &str) -> Result<f64, Refused> {
        let mut residual = 0.0;
        for index in self.each() {
            let (letters, checks) = self.letters(formula, &index)?;
            if checks.is_empty() {
                return Err("nothing is compared".into());
            }
            for clause in &checks {
                self.everywhere(clause, &index, &mut |here| {
                    let side = |text| Formula::new(text, &letters, &self.ranges, here);
                    let (left, right) = (side(clause.0).value()?, side(clause.1).value()?);
                    let size = side(clause.0).size()?.max(right.camax());
                    residual += add(left, -right)?.camax() / size;
                    Ok(())
                })?;
            }
        }
        Ok(residual)
    }

    /// The letter and indices that a clause defines.
    fn defined(&self, clause: &Clause, letters: &Letters) -> Option<(String, Vec<char>)> {
        Formula::new(clause.0, letters, &self.ranges, &Places::new()).defines()
    }

    /// Runs something of a clause at all values of the indices that it turns out to need.
    fn everywhere(
        &self,
        clause: &Clause,
        index: &Places,
        run: &mut dyn FnMut(&Places) -> Result<(), Refused>,
    ) -> Result<(), Refused> {
        let [i, j] = ['i', 'j'].map(|mode| index.get(&mode));
        if clause.2 && i.is_some() && i == j {
            return Ok(());
        }
        run(index).or_else(|why| {
            let free = why.parse().ok();
            let free = free.and_then(|free| self.ranges.get_key_value(&free));
            let (free, range) = free.ok_or(why)?;
            (0..*range).try_for_each(|at| {
                let mut there = index.clone();
                there.insert(*free, at);
                self.everywhere(clause, &there, run)
            })
        })
    }

    fn define(
        &self,
        letters: &mut Letters,
        clause: &Clause,
        index: &Places,
    ) -> Result<(), Refused> {
        let known = letters.clone();
        let Some((name, indices)) = self.defined(clause, &self.letters) else {
            return Ok(());
        };
        let range = |at| indices.get(at).map_or(1, |index| self.ranges[index]);
        self.everywhere(clause, index, &mut |here| {
            let place = |index: &char| here.get(index).copied().ok_or(index.to_string());
            let mut place = indices.iter().map(place).collect::<Result<Vec<_>, _>>()?;
            place.push(0);
            let value = Formula::new(clause.1, &known, &self.ranges, here).value()?;
            let empty = match value.len() {
                1 => Letter::One(Value::zeros(range(0), range(1))),
                _ => Letter::Family(BTreeMap::new()),
            };
            match (letters.entry(name.clone()).or_insert(empty), indices.len()) {
                (letter, 0) => *letter = Letter::One(value),
                (Letter::Family(members), _) => _ = members.insert(place[0], value),
                (Letter::One(entries), _) => entries[(place[0], place[1])] = value[0],
            }
            Ok(())
        })
    }
}
