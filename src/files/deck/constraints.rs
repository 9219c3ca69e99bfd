//! Cards of constraints: what SPC1 fixes to ground and what MPC ties.

use super::card::Card;
use super::lines::Selected;
use super::model::Tie;
use crate::files::error::FileError;
use crate::method::structure::{Grid, StructuralDof};
use std::collections::BTreeMap;

/// The constraints of the selected sets, as cards.
#[derive(Debug)]
pub(super) struct Constraints {
    by_case_control: bool,
    selected: Selected,
    supports: Vec<Card>,
    equations: Vec<Card>,
}

impl Constraints {
    /// None yet; without case control the one set in the deck counts.
    pub fn new(selected: Option<Selected>) -> Self {
        let by_case_control = selected.is_some();
        Self { by_case_control, selected: selected.unwrap_or_default(), supports: Vec::new(), equations: Vec::new() }
    }

    /// Takes an SPC1 or MPC card if its set counts; whether it does. Without case control a second set is an error.
    pub fn take(&mut self, card: &Card) -> Result<bool, FileError> {
        let set = card.label(2)?;
        let (chosen, cards) = match card.name.as_str() {
            "SPC1" => (&mut self.selected.spc, &mut self.supports),
            _ => (&mut self.selected.mpc, &mut self.equations),
        };
        if !self.by_case_control {
            let first = *chosen.get_or_insert(set);
            if first != set {
                return Err(card.error(2, format!("set {first} again, for no case control selects one")));
            }
        }
        let is_chosen = *chosen == Some(set);
        cards.extend(is_chosen.then(|| card.clone()));
        Ok(is_chosen)
    }

    /// Marks what is constrained: the grids of every card one by one, or from the first to the last of `G1 THRU G2`.
    pub fn constrain(&self, grids: &mut BTreeMap<usize, Grid>) -> Result<(), FileError> {
        for card in &self.supports {
            let directions = card.directions(3)?;
            if card.text(3).is_empty() {
                return Err(card.error(3, "components from 1 to 6"));
            }
            let mut fields = card.filled().into_iter().skip_while(|&f| f < 4).peekable();
            if fields.peek().is_none() {
                return Err(card.error(4, "a grid"));
            }
            while let Some(field) = fields.next() {
                let first = card.label(field)?;
                let mut last = first;
                if let Some(word) = fields.next_if(|&word| card.text(word) == "THRU") {
                    let end = fields.next().ok_or_else(|| card.error(word + 1, "a grid after THRU"))?;
                    last = card.label(end)?;
                    if last < first {
                        return Err(card.error(end, format!("a grid after {first}")));
                    }
                }
                let mut run = grids.range_mut(first..=last).peekable();
                if run.peek().is_none() {
                    return Err(card.error(field, "the number of a GRID card"));
                }
                for (_, grid) in run {
                    grid.constrained = std::array::from_fn(|d| grid.constrained[d] || directions[d]);
                }
            }
        }
        Ok(())
    }

    /// The equations, by dependent DOF: it may not be constrained nor in another equation, nor its coefficient zero.
    pub fn ties(&self, grids: &BTreeMap<usize, Grid>) -> Result<Vec<Tie>, FileError> {
        let mut ties: BTreeMap<(usize, usize), (Tie, &Card)> = BTreeMap::new();
        for card in &self.equations {
            let mut terms = terms(card, grids)?.into_iter();
            let (dependent, coefficient) = terms.next().ok_or_else(|| card.error(3, "a grid"))?;
            let key = (dependent.grid, dependent.direction);
            if coefficient == 0.0 {
                return Err(card.error(5, "a coefficient that is not zero"));
            }
            if grids.get(&key.0).is_some_and(|g| g.constrained[key.1]) {
                return Err(card.error(3, "a degree of freedom that no SPC1 card constrains"));
            }
            let tie = Tie { dependent, coefficient, terms: terms.collect() };
            if let Some((_, first)) = ties.insert(key, (tie, card)) {
                return Err(card.error(3, format!("a degree of freedom that line {} does not tie", first.line)));
            }
        }
        for (tie, card) in ties.values() {
            let is_tied = |(term, _): &(StructuralDof, f64)| ties.contains_key(&(term.grid, term.direction));
            if let Some(row) = tie.terms.iter().position(is_tied) {
                let expected = "a degree of freedom that no MPC card makes dependent";
                return Err(card.error(term_field(row + 1), expected));
            }
        }
        Ok(ties.into_values().map(|(tie, _)| tie).collect())
    }
}

/// The terms of an equation, the dependent DOF first.
fn terms(card: &Card, grids: &BTreeMap<usize, Grid>) -> Result<Vec<(StructuralDof, f64)>, FileError> {
    let last = card.filled().pop().unwrap_or(0);
    let fields = (0..).map(term_field).take_while(|&field| field <= last);
    let term = |field| {
        let grid = card.referred(field, grids, "GRID")?.label;
        Ok((StructuralDof { grid, direction: card.direction(field + 1)? }, card.real(field + 2)?))
    };
    fields.map(term).collect()
}

/// Field of the grid of a term, counted from zero: two terms to a line, in fields 3 and 6.
fn term_field(term: usize) -> usize {
    10 * (term / 2) + [3, 6][term % 2]
}
