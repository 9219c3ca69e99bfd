//! From the model to a deck that NASTRAN-95 runs unchanged.

use super::card::{FIELDS_PER_LINE, LARGEST_LABEL};
use super::elements::ELEMENT_CARDS;
use super::lines::LARGE_FIELDS_PER_LINE;
use super::model::BulkData;
use super::number::{LARGE_FIELD, SMALL_FIELD, exact_real, large_real};
use crate::files::error::FileError;
use crate::method::error::Error;
use crate::method::structure::{Grid, Material};
use std::fmt::Write;

/// The set of constraints that case control selects, of SPC1 and of MPC.
const SET: usize = 1;

/// What a deck asks of NASTRAN.
#[derive(Debug, Clone, PartialEq)]
pub enum Task {
    /// Normal modes by the inverse power method, which allows a singular mass matrix.
    Modes {
        /// How many.
        count: usize,
        /// Frequencies between which they lie, Hz.
        range_hz: [f64; 2],
    },
    /// No solution: KGG, KAA and MAA are written on Fortran unit 15 and the run ends.
    Matrices,
}

/// A whole deck: executive control, case control and bulk data; `title` stands in the output's headings.
///
/// `BANDIT=-1` keeps the grids in the order of their numbers, and `DIAG 44` takes the decomposition that gives right
/// answers (the default one of the 1995 release does not).
///
/// # Errors
/// Those of [`bulk_data`].
pub fn write(model: &BulkData, title: &str, task: &Task) -> Result<String, FileError> {
    // Rigid format 3 wants a method even where the run ends before it is used.
    let (count, [lower, upper], alter, output) = match task {
        Task::Modes { count, range_hz } => (*count, *range_hz, "", "DISPLACEMENT = ALL\n"),
        Task::Matrices => {
            let alter = "INSERT READ,-1 $\nOUTPUT5 KGG,KAA,MAA,,//-1/15/*CORFEM*/1 $\nEXIT $\nENDALTER\n";
            (1, [1.0, 2.0], alter, "")
        }
    };
    let ties = if model.ties.is_empty() { String::new() } else { format!("MPC = {SET}\n") };
    let text = format!(
        "NASTRAN BANDIT=-1\nID      CORFEM,DECK\nAPP     DISPLACEMENT\nSOL     3,0\nTIME    5\nDIAG    44\n\
         {alter}CEND\n\
         TITLE = {}\nSPC = {SET}\n{ties}METHOD = {SET}\n{output}BEGIN BULK\n",
        title.to_ascii_uppercase()
    );
    let mut cards = Cards { text, ..Cards::default() };
    cards.model(model)?;
    let method = [SET.into(), "INV".into(), lower.into(), upper.into(), count.into(), count.into()];
    cards.put("EIGR", method.into_iter().chain([Entry::Blank, Entry::Blank, "MASS".into()]).collect())?;
    cards.text.push_str("ENDDATA\n");
    Ok(cards.text)
}

/// The bulk data alone, without a `BEGIN BULK` or `ENDDATA`.
///
/// Grids have fields of 16 characters, other cards where 8 would lose digits; a number that needs more than 16 is
/// rounded to the nearest that fits ([`large_real`]). Every element has a property card of its own number, every
/// distinct material a MAT1 card.
///
/// # Errors
/// [`Error::NotFinite`] and [`Error::TooMany`] for numbers that no card can hold.
pub fn bulk_data(model: &BulkData) -> Result<String, FileError> {
    let mut cards = Cards::default();
    cards.model(model)?;
    Ok(cards.text)
}

/// A field to be written: a label is the number of a grid, an element and so on, a word may be a list of components.
#[derive(Clone)]
pub(super) enum Entry {
    Blank,
    Label(usize),
    Word(String),
    Real(f64),
}

impl From<usize> for Entry {
    fn from(label: usize) -> Self {
        Self::Label(label)
    }
}

impl From<&str> for Entry {
    fn from(word: &str) -> Self {
        Self::Word(word.to_owned())
    }
}

impl From<f64> for Entry {
    fn from(value: f64) -> Self {
        Self::Real(value)
    }
}

/// Cards as text.
#[derive(Default)]
pub(super) struct Cards {
    pub text: String,
    /// What the names of continuations begin with.
    pub prefix: String,
    /// Counts the continuations of the deck, so that each has a name of its own.
    pub tag: usize,
}

impl Cards {
    fn model(&mut self, model: &BulkData) -> Result<(), FileError> {
        for grid in &model.grids {
            let mut entries = vec![grid.label.into(), Entry::Blank];
            entries.extend(grid.position.iter().map(|&x| Entry::Real(x)));
            self.put_sized("GRID", entries, true)?;
        }
        let mut materials: Vec<Material> = Vec::new();
        for element in &model.elements {
            let known = materials.iter().position(|m| *m == element.material);
            let row = known.unwrap_or_else(|| {
                materials.push(element.material);
                materials.len() - 1
            });
            for (connection, property, _) in ELEMENT_CARDS.iter().filter(|card| card.2 == element.kind) {
                let labels = [element.label; 2].into_iter().chain(element.grids.iter().copied());
                self.put(connection, labels.map(Entry::Label).collect())?;
                self.put(property, vec![element.label.into(), (row + 1).into(), element.size.into()])?;
            }
        }
        for (row, material) in materials.into_iter().enumerate() {
            let Material { youngs_modulus: e, poissons_ratio: nu, shear_modulus: g, density } = material;
            let is_derived = Material::isotropic(e, nu).is_ok_and(|other| other.shear_modulus == g);
            let shear = if is_derived { Entry::Blank } else { g.into() };
            let mut entries = vec![(row + 1).into(), e.into(), shear, nu.into()];
            entries.extend((density != 0.0).then_some(Entry::Real(density)));
            self.put("MAT1", entries)?;
        }
        for point in &model.masses {
            let (label, grid, mass) = (point.label.into(), point.grid.into(), point.mass.into());
            match point.direction {
                Some(direction) => self.put("CMASS2", vec![label, mass, grid, (direction + 1).into()]),
                None => self.put("CONM2", vec![label, grid, Entry::Blank, mass]),
            }?;
        }
        for tie in &model.ties {
            let own = std::iter::once((tie.dependent, tie.coefficient));
            let mut entries = vec![SET.into()];
            for (row, (dof, coefficient)) in own.chain(tie.terms.iter().copied()).enumerate() {
                // Two terms to a line; the last field of one and the first of the next stay blank.
                if row > 0 && row % 2 == 0 {
                    entries.extend([Entry::Blank, Entry::Blank]);
                }
                entries.extend([dof.grid.into(), (dof.direction + 1).into(), coefficient.into()]);
            }
            self.put("MPC", entries)?;
        }
        let alike = |a: &Grid, b: &Grid| a.constrained == b.constrained && a.label + 1 == b.label;
        for run in model.grids.chunk_by(alike) {
            let (first, last) = (&run[0], &run[run.len() - 1]); // A run has at least one.
            // The rotations of every grid are constrained, for nothing here resists them.
            let named = ["1", "2", "3", "456"].into_iter().zip(first.constrained.into_iter().chain([true]));
            let components = named.filter_map(|(component, is_constrained)| is_constrained.then_some(component));
            let components = components.collect();
            let mut entries = vec![SET.into(), Entry::Word(components), first.label.into()];
            if run.len() > 1 {
                entries.extend(["THRU".into(), last.label.into()]);
            }
            self.put("SPC1", entries)?;
        }
        Ok(())
    }

    /// A card with fields of 8 characters if they hold every number exactly, of 16 otherwise.
    pub fn put(&mut self, name: &str, entries: Vec<Entry>) -> Result<(), FileError> {
        let is_long_word = |entry: &Entry| matches!(entry, Entry::Word(word) if word.len() > SMALL_FIELD);
        let is_long = |entry: &Entry| matches!(entry, Entry::Real(x) if exact_real(*x, SMALL_FIELD).is_none());
        let large = entries.iter().any(|entry| is_long(entry) || is_long_word(entry));
        self.put_sized(name, entries, large)
    }

    fn put_sized(&mut self, name: &str, entries: Vec<Entry>, large: bool) -> Result<(), FileError> {
        let (width, per_line, mark, plus) = match large {
            true => (LARGE_FIELD, LARGE_FIELDS_PER_LINE, "*", '*'),
            false => (SMALL_FIELD, FIELDS_PER_LINE, "", '+'),
        };
        let written = entries.into_iter().enumerate().map(|entry| match entry {
            (_, Entry::Blank) => Ok(String::new()),
            (_, Entry::Label(label)) if label > LARGEST_LABEL => Err(Error::TooMany {
                what: "number of a grid or element in a deck",
                available: LARGEST_LABEL,
                requested: label,
            }),
            (_, Entry::Label(label)) => Ok(label.to_string()),
            (_, Entry::Word(word)) => Ok(word),
            (column, Entry::Real(value)) => {
                large_real(value).ok_or(Error::NotFinite { what: "number on a bulk data card", row: 0, column, value })
            }
        });
        let mut fields = written.collect::<Result<Vec<String>, _>>()?;
        // NASTRAN-95 takes a line of the large format for half a card and wants the other half too.
        let whole = fields.len().next_multiple_of(FIELDS_PER_LINE);
        fields.resize(whole, String::new());
        let mut first = format!("{name}{mark}");
        for (row, line) in fields.chunks(per_line).enumerate() {
            let mut written = format!("{first:SMALL_FIELD$}");
            for field in line {
                let _ = write!(written, "{field:width$}");
            }
            if (row + 1) * per_line < whole {
                self.tag += 1;
                first = format!("{plus}{}{}", self.prefix, self.tag);
                written.push_str(&first);
            }
            self.text.push_str(written.trim_end());
            self.text.push('\n');
        }
        Ok(())
    }
}
