//! Cards of constraints: what SPC1 holds and what MPC ties.

use super::card::Card;
use super::lines::Selected;
use super::model::Tie;
use crate::files::error::FileError;
use crate::method::structure::{Grid, StructuralDof};
use std::collections::BTreeMap;

/// Fields of the groups G, C, A on every line of an MPC card.
const TERM_FIELDS: [usize; 2] = [3, 6];

/// The constraints of the selected sets, as cards.
#[derive(Debug)]
pub(super) struct Constraints {
    /// Whether case control says which sets count.
    by_case_control: bool,
    selected: Selected,
    holds: Vec<Card>,
    equations: Vec<Card>,
}

impl Constraints {
    /// None yet; without case control the one set in the deck counts.
    pub fn new(selected: Option<Selected>) -> Self {
        Self {
            by_case_control: selected.is_some(),
            selected: selected.unwrap_or_default(),
            holds: Vec::new(),
            equations: Vec::new(),
        }
    }

    /// Takes an SPC1 or MPC card if its set counts; whether it does.
    ///
    /// # Errors
    /// [`FileError::DeckField`] for a second set where there is no case control to select one.
    pub fn take(&mut self, card: Card) -> Result<bool, FileError> {
        let set = card.label(2)?;
        let (chosen, cards) = if card.name == "SPC1" {
            (&mut self.selected.spc, &mut self.holds)
        } else {
            (&mut self.selected.mpc, &mut self.equations)
        };
        if !self.by_case_control {
            let first = *chosen.get_or_insert(set);
            if first != set {
                let expected = format!("set {first} again, for no case control selects one");
                return Err(card.error(2, expected));
            }
        }
        if *chosen != Some(set) {
            return Ok(false);
        }
        cards.push(card);
        Ok(true)
    }

    /// Marks what is constrained.
    ///
    /// # Errors
    /// [`FileError::DeckField`] for a grid that does not exist.
    pub fn hold(&self, grids: &mut BTreeMap<usize, Grid>) -> Result<(), FileError> {
        for card in &self.holds {
            let directions = card.directions(3)?;
            if card.text(3).is_empty() {
                return Err(card.error(3, "components from 1 to 6"));
            }
            let fields: Vec<usize> = (4..=card.last_field())
                .filter(|&field| !card.text(field).is_empty())
                .collect();
            if fields.is_empty() {
                return Err(card.error(4, "a grid"));
            }
            let mut at = 0;
            while let Some(&field) = fields.get(at) {
                let first = card.label(field)?;
                let mut last = first;
                if let Some(&word) = fields.get(at + 1)
                    && card.text(word) == "THRU"
                {
                    let Some(&end) = fields.get(at + 2) else {
                        return Err(card.error(word + 1, "a grid after THRU"));
                    };
                    last = card.label(end)?;
                    if last < first {
                        return Err(card.error(end, format!("a grid after {first}")));
                    }
                    at += 2;
                }
                at += 1;
                let mut is_known = false;
                for (_, grid) in grids.range_mut(first..=last) {
                    is_known = true;
                    for (constrained, direction) in grid.constrained.iter_mut().zip(directions) {
                        *constrained |= direction;
                    }
                }
                if !is_known {
                    return Err(card.error(field, "the number of a GRID card"));
                }
            }
        }
        Ok(())
    }

    /// The equations, by dependent DOF; `grid` checks the grid named in a field of a card.
    ///
    /// # Errors
    /// [`FileError::DeckField`] for a DOF that does not exist, a dependent DOF that is constrained, has another equation or stands in one
    /// as a term, and a zero coefficient of a dependent DOF.
    pub fn ties(&self, grids: &BTreeMap<usize, Grid>) -> Result<Vec<Tie>, FileError> {
        let mut ties: BTreeMap<(usize, usize), (Tie, &Card)> = BTreeMap::new();
        for card in &self.equations {
            let mut terms = terms(card, grids)?.into_iter();
            let Some((dependent, coefficient)) = terms.next() else {
                return Err(card.error(3, "a grid"));
            };
            if coefficient == 0.0 {
                return Err(card.error(5, "a coefficient that is not zero"));
            }
            let key = (dependent.grid, dependent.direction);
            if grids
                .get(&key.0)
                .is_some_and(|grid| grid.constrained[key.1])
            {
                return Err(card.error(3, "a degree of freedom that no SPC1 card constrains"));
            }
            let tie = Tie {
                dependent,
                coefficient,
                terms: terms.collect(),
            };
            if let Some((_, first)) = ties.insert(key, (tie, card)) {
                let line = first.line;
                let expected = format!("a degree of freedom that line {line} does not tie");
                return Err(card.error(3, expected));
            }
        }
        for (tie, card) in ties.values() {
            let is_tied =
                |(term, _): &(StructuralDof, f64)| ties.contains_key(&(term.grid, term.direction));
            if let Some(row) = tie.terms.iter().position(is_tied) {
                let expected = "a degree of freedom that no MPC card makes dependent";
                return Err(card.error(term_field(row + 1), expected));
            }
        }
        Ok(ties.into_values().map(|(tie, _)| tie).collect())
    }
}

/// The terms of an equation, the dependent DOF first.
fn terms(
    card: &Card,
    grids: &BTreeMap<usize, Grid>,
) -> Result<Vec<(StructuralDof, f64)>, FileError> {
    let mut terms = Vec::new();
    while term_field(terms.len()) <= card.last_field() {
        let field = term_field(terms.len());
        let grid = card.label(field)?;
        if !grids.contains_key(&grid) {
            return Err(card.error(field, "the number of a GRID card"));
        }
        let direction = card.direction(field + 1)?;
        let coefficient = card.real(field + 2)?;
        terms.push((StructuralDof { grid, direction }, coefficient));
    }
    Ok(terms)
}

/// Field of the grid of a term, counted from zero: two terms to a line, in fields 3 and 6.
fn term_field(term: usize) -> usize {
    10 * (term / TERM_FIELDS.len()) + TERM_FIELDS[term % TERM_FIELDS.len()]
}
