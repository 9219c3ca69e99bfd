//! Cards of constraints: what SPC and SPC1 fix to ground, what MPC ties, and which sets of them count.

use super::card::Card;
use super::coordinates::{Motions, OBLIQUE};
use super::lines::Selected;
use super::model::Tie;
use crate::files::error::{FileError, ensure};
use crate::method::structure::{Grid, StructuralDof};
use std::collections::{BTreeMap, BTreeSet};

/// The constraints of a deck as cards, from [`Self::select`] on those of the selected sets alone.
#[derive(Debug, Default)]
pub struct Constraints {
    supports: Sets,
    equations: Sets,
}

/// Cards of one kind with their sets: SPC and SPC1, or MPC, and the SPCADD or MPCADD that join sets.
#[derive(Debug, Default)]
struct Sets {
    cards: Vec<(usize, Card)>,
    unions: Vec<(usize, Card)>,
}

impl Sets {
    /// Keeps the cards of the selected set, or of the sets that it joins, and returns the others.
    fn select(&mut self, selected: Option<usize>) -> Result<Vec<Card>, FileError> {
        let chosen: Vec<_> = self
            .unions
            .extract_if(.., |(set, _)| Some(*set) == selected)
            .collect();
        let known: BTreeSet<usize> = self.cards.iter().map(|(set, _)| *set).collect();
        let mut sets = BTreeSet::new();
        for (_, card) in &chosen {
            card.label(3)?;
            for field in card.filled().into_iter().filter(|&field| field > 2) {
                let set = card.label(field)?;
                let what = format!("the set of an {} card", card.name.trim_end_matches("ADD"));
                card.require(known.contains(&set), field, &what)?;
                sets.insert(set);
            }
        }
        // A set that joins others has their cards alone, as in NASTRAN.
        if chosen.is_empty() {
            sets.extend(selected);
        }
        Ok(self
            .cards
            .extract_if(.., |(set, _)| !sets.contains(set))
            .chain(self.unions.drain(..))
            .map(|(_, card)| card)
            .collect())
    }
}

impl Constraints {
    /// Takes an SPC, SPC1, SPCADD, MPC or MPCADD card.
    pub fn take(&mut self, card: Card) -> Result<(), FileError> {
        let sets = if card.name.starts_with("SPC") {
            &mut self.supports
        } else {
            &mut self.equations
        };
        let cards = if card.name.ends_with("ADD") {
            &mut sets.unions
        } else {
            &mut sets.cards
        };
        cards.push((card.label(2)?, card));
        Ok(())
    }

    /// Keeps the cards of the sets that case control selects, and returns the others. Without case control (`None`) the
    /// set of SPCADD counts, or else the one set there is, and every other card is an error.
    ///
    /// A set that case control selects must exist in `file`, unless cards `may_lack`.
    pub fn select(
        &mut self,
        file: &str,
        selected: Option<Selected>,
        may_lack: bool,
    ) -> Result<Vec<Card>, FileError> {
        let mut left_out = Vec::new();
        for (row, sets) in [&mut self.supports, &mut self.equations]
            .into_iter()
            .enumerate()
        {
            let Some(chosen) = selected.map(|selected| selected[row]) else {
                let first = sets
                    .unions
                    .first()
                    .or(sets.cards.first())
                    .map(|(set, _)| *set);
                if let (Some(first), Some(other)) = (first, sets.select(first)?.first()) {
                    return Err(other.error(
                        2,
                        format!("set {} beside set {first}: a deck without case control may have one set", other.text(2)),
                    ));
                }
                continue;
            };
            left_out.extend(sets.select(chosen.map(|(set, _)| set))?);
            if let Some((set, line)) = chosen.filter(|_| sets.cards.is_empty() && !may_lack) {
                return Err(FileError::line(
                    file,
                    line,
                    format!("the deck has no set {set} of constraints"),
                ));
            }
        }
        Ok(left_out)
    }

    /// Marks what is constrained: of SPC1 the grids of every card one by one, or from the first to the last of `G1 THRU G2`; of SPC one
    /// or two grids, each with its components and an enforced displacement, which is a load and no part of normal modes.
    pub fn constrain(
        &self,
        grids: &mut BTreeMap<usize, Grid>,
        motions: &Motions,
    ) -> Result<(), FileError> {
        for (_, card) in &self.supports.cards {
            // Fields of components and of the first grid of a run, and its ends.
            let mut runs = Vec::new();
            let mut fields = card.filled().into_iter().skip_while(|&f| f < 4).peekable();
            if card.name == "SPC" {
                let is_double = card.filled().last().is_some_and(|&last| last > 5);
                for &start in if is_double { &[3, 6][..] } else { &[3] } {
                    let label = card.label(start)?;
                    card.optional_real(start + 2)?;
                    runs.push((start + 1, start, label, label));
                }
            } else {
                card.require(fields.peek().is_some(), 4, "a grid")?;
                while let Some(field) = fields.next() {
                    let first = card.label(field)?;
                    let mut last = first;
                    if let Some(word) = fields.next_if(|&word| card.text(word) == "THRU") {
                        // Fields 10 and 11 are no data.
                        let after = if word % 10 == 9 { word + 3 } else { word + 1 };
                        let end = fields
                            .next()
                            .ok_or_else(|| card.wrong(after, "a grid after THRU"))?;
                        last = card.label(end)?;
                        let what = format!("a grid number above {first}");
                        card.require(last >= first, end, &what)?;
                    }
                    runs.push((3, field, first, last));
                }
            }
            for (components, field, first, last) in runs {
                let directions = card.directions(components)?;
                let is_met = !card.text(components).is_empty();
                card.require(is_met, components, "a list of components 1 to 6")?;
                let mut run = grids.range_mut(first..=last).peekable();
                card.require(run.peek().is_some(), field, "the number of a GRID card")?;
                for (_, grid) in run {
                    let held = motions
                        .held(grid.label, directions)
                        .ok_or_else(|| card.error(components, OBLIQUE))?;
                    grid.constrained = std::array::from_fn(|d| grid.constrained[d] || held[d]);
                }
            }
        }
        Ok(())
    }

    /// The equations, by dependent DOF: it may not be constrained nor in another equation, nor its coefficient zero.
    pub fn ties(
        &self,
        grids: &BTreeMap<usize, Grid>,
        motions: &Motions,
    ) -> Result<Vec<Tie>, FileError> {
        let mut ties: BTreeMap<StructuralDof, (Tie, Vec<usize>, &Card)> = BTreeMap::new();
        for (_, card) in &self.equations.cards {
            let last = card.filled().pop().unwrap_or(0);
            // A direction off the axes is a sum of those along them.
            let mut terms = Vec::new();
            for field in (0..).map(term_field).take_while(|&field| field <= last) {
                let grid = card.referred(field, grids, "GRID")?.label;
                let (own, real) = (card.direction(field + 1)?, card.real(field + 2)?);
                let parts = motions.parts(grid, own).into_iter();
                terms.extend(parts.map(|(direction, part)| {
                    (StructuralDof { grid, direction }, part * real, field)
                }));
            }
            ensure(
                terms.get(1).is_none_or(|term| term.2 != term_field(0)),
                || card.error(4, OBLIQUE),
            )?;
            let mut terms = terms.into_iter();
            let (dependent, coefficient, _) =
                terms.next().ok_or_else(|| card.wrong(3, "a grid"))?;
            card.require(coefficient != 0.0, 5, "a coefficient other than zero")?;
            let grid = grids.get(&dependent.grid);
            ensure(
                grid.is_none_or(|grid| !grid.constrained[dependent.direction]),
                || {
                    card.error(3, "an SPC or SPC1 card constrains this degree of freedom; it cannot also depend on others")
                },
            )?;
            let (fields, terms) = terms.map(|(dof, part, field)| (field, (dof, part))).unzip();
            let tie = Tie {
                dependent,
                coefficient,
                terms,
            };
            if let Some((.., first)) = ties.insert(dependent, (tie, fields, card)) {
                let reason = format!("line {} ties this degree of freedom already", first.line);
                return Err(card.error(3, reason));
            }
        }
        for (tie, fields, card) in ties.values() {
            let is_tied = |(term, _): &(StructuralDof, f64)| ties.contains_key(term);
            if let Some(row) = tie.terms.iter().position(is_tied) {
                return Err(card.error(fields[row], "another MPC card makes this degree of freedom dependent; no equation may refer to it"));
            }
        }
        Ok(ties.into_values().map(|(tie, ..)| tie).collect())
    }
}

/// Field of the grid of a term, counted from zero: two terms to a line, in fields 3 and 6.
fn term_field(term: usize) -> usize {
    10 * (term / 2) + [3, 6][term % 2]
}
