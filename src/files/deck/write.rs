//! The writer, from the model to a deck that NASTRAN-95 runs unchanged.

use super::card::{FIELDS_PER_LINE, LARGEST_LABEL};
use super::elements::ELEMENT_CARDS;
use super::lines::LARGE_FIELDS_PER_LINE;
use super::model::{BulkData, PointMass, Tie};
use super::number::{LARGE_FIELD, SMALL_FIELD, exact_real, large_real};
use crate::files::error::FileError;
use crate::method::error::{check_count, require};
use crate::method::structure::{Element, Grid, Material};

/// The set of constraints that case control selects, of SPC1 and of MPC.
const SET: usize = 1;

/// Task that a deck sets NASTRAN.
#[derive(Debug, Clone, PartialEq)]
pub enum Task {
    /// Normal modes by the inverse power method, which allows a singular mass matrix.
    Modes {
        /// Number of modes.
        count: usize,
        /// Frequencies between which they lie, Hz.
        range_hz: [f64; 2],
    },
    /// No solution: KGG, KAA and MAA are written on Fortran unit 15 and the run ends.
    Matrices,
}

/// A whole deck: executive control, case control and bulk data; `title` goes into the output's headings.
///
/// `BANDIT=-1` keeps the grids in the order of their numbers, and `DIAG 44` takes the decomposition that gives right
/// answers (the default one of the 1995 release does not).
///
/// Grids have fields of 16 characters, other cards where 8 would lose digits; a number that needs more than 16 is
/// rounded to the nearest that fits ([`large_real`]). Every element has a property card of its own number, every
/// distinct material a MAT1 card.
///
/// # Errors
/// [`Error::Value`](crate::method::error::Error::Value) and [`Error::Count`](crate::method::error::Error::Count) for numbers that no
/// card can hold.
pub fn write(model: &BulkData, title: &str, task: &Task) -> Result<String, FileError> {
    // Rigid format 3 wants a method even where the run ends before it is used.
    let (count, [lower, upper], alter, output) = match task {
        Task::Modes { count, range_hz } => (*count, *range_hz, "", "DISPLACEMENT = ALL\n"),
        Task::Matrices => {
            let alter =
                "INSERT READ,-1 $\nOUTPUT5 KGG,KAA,MAA,,//-1/15/*CORFEM*/1 $\nEXIT $\nENDALTER\n";
            (1, [1.0, 2.0], alter, "")
        }
    };
    let ties = if model.ties.is_empty() {
        String::new()
    } else {
        format!("MPC = {SET}\n")
    };
    let text = format!(
        "NASTRAN BANDIT=-1\nID      CORFEM,DECK\nAPP     DISPLACEMENT\nSOL     3,0\nTIME    5\nDIAG    44\n\
         {alter}CEND\n\
         TITLE = {}\nSPC = {SET}\n{ties}METHOD = {SET}\n{output}BEGIN BULK\n",
        title.to_ascii_uppercase()
    );
    let mut cards = Cards {
        text,
        ..Cards::default()
    };
    cards.model(model)?;
    cards.push(
        "EIGR",
        &format!("{SET},INV,{lower:?},{upper:?},{count},{count},,,MASS"),
    )?;
    cards.text.push_str("ENDDATA\n");
    Ok(cards.text)
}

/// Cards as text.
#[derive(Default)]
pub(crate) struct Cards {
    pub text: String,
    /// Beginning of the names of continuations.
    pub prefix: String,
    /// Number of continuations so far, so that each has a name of its own.
    pub tag: usize,
}

impl Cards {
    /// Cards beside others: no continuation's name and no remark in field 10 of this text begins as theirs.
    pub fn beside(text: &str) -> Self {
        let (text, mut cards) = (text.to_ascii_uppercase(), Self::default());
        while cards.prefix.is_empty() || text.contains(&cards.prefix) {
            cards.prefix.push('Z');
        }
        cards
    }

    fn model(&mut self, model: &BulkData) -> Result<(), FileError> {
        for Grid {
            label,
            position: at,
            ..
        } in &model.grids
        {
            self.push(
                "GRID",
                &format!("{label},,{:?},{:?},{:?}", at.x, at.y, at.z),
            )?;
        }
        let mut materials: Vec<Material> = Vec::new();
        for Element {
            label,
            kind,
            grids,
            size,
            material,
        } in &model.elements
        {
            let known = materials.iter().position(|other| other == material);
            let row = known.unwrap_or_else(|| {
                materials.push(*material);
                materials.len() - 1
            });
            for (connection, property, _) in ELEMENT_CARDS.iter().filter(|card| card.2 == *kind) {
                let corners: String = grids.iter().map(|grid| format!(",{grid}")).collect();
                self.push(connection, &format!("{label},{label}{corners}"))?;
                self.push(property, &format!("{label},{},{size:?}", row + 1))?;
            }
        }
        for (row, material) in (1..).zip(materials) {
            let Material {
                youngs_modulus: e,
                poissons_ratio: nu,
                shear_modulus: g,
                density,
            } = material;
            let is_derived = Material::isotropic(e, nu).is_ok_and(|other| other.shear_modulus == g);
            let shear = if is_derived {
                String::new()
            } else {
                format!("{g:?}")
            };
            let density = if density == 0.0 {
                String::new()
            } else {
                format!(",{density:?}")
            };
            self.push("MAT1", &format!("{row},{e:?},{shear},{nu:?}{density}"))?;
        }
        for PointMass {
            label,
            grid,
            direction,
            mass,
        } in &model.masses
        {
            match direction {
                Some(direction) => self.push(
                    "CMASS2",
                    &format!("{label},{mass:?},{grid},{}", direction + 1),
                ),
                None => self.push("CONM2", &format!("{label},{grid},,{mass:?}")),
            }?;
        }
        for Tie {
            dependent,
            coefficient,
            terms,
        } in &model.ties
        {
            let mut entries = SET.to_string();
            let own = std::iter::once((*dependent, *coefficient));
            for (row, (dof, coefficient)) in own.chain(terms.iter().copied()).enumerate() {
                // Two terms to a line; the last field of one and the first of the next stay blank.
                entries += if row > 0 && row % 2 == 0 { ",,," } else { "," };
                entries += &format!("{},{},{coefficient:?}", dof.grid, dof.direction + 1);
            }
            self.push("MPC", &entries)?;
        }
        let alike = |a: &Grid, b: &Grid| a.constrained == b.constrained && a.label + 1 == b.label;
        for run in model.grids.chunk_by(alike) {
            let (first, last) = (&run[0], run[run.len() - 1].label); // A run has at least one.
            // The rotations of every grid are constrained, for nothing here resists them.
            let named = ["1", "2", "3", "456"]
                .into_iter()
                .zip(first.constrained.into_iter().chain([true]));
            let components: String = named
                .filter(|(_, is_constrained)| *is_constrained)
                .map(|named| named.0)
                .collect();
            let through = if run.len() > 1 {
                format!(",THRU,{last}")
            } else {
                String::new()
            };
            self.push(
                "SPC1",
                &format!("{SET},{components},{}{through}", first.label),
            )?;
        }
        Ok(())
    }

    /// A card with these fields, as in free format but with numbers as Rust writes them; a number with a decimal point or an
    /// exponent is a real one. Fields of 8 characters are taken if they hold all exactly and it is no GRID, else of 16.
    pub fn push(&mut self, name: &str, entries: &str) -> Result<(), FileError> {
        let mut is_large = name == "GRID";
        let mut fields = Vec::new();
        for (column, entry) in entries.split(',').enumerate() {
            let (label, real) = (entry.parse::<isize>(), entry.parse::<f64>());
            is_large |= entry.len() > SMALL_FIELD && real.is_err();
            fields.push(match (label, real) {
                (Ok(label), _) => {
                    let what = "number of a grid or element in a deck";
                    check_count(what, label.unsigned_abs().max(1), 1, LARGEST_LABEL)?;
                    entry.to_owned()
                }
                (Err(_), Ok(value)) => {
                    is_large |= exact_real(value, SMALL_FIELD).is_none();
                    let owner = || format!("card {name}, entry {column}");
                    let is_met = value.is_finite();
                    require(is_met, "number", owner, value, "a finite number")?;
                    large_real(value).unwrap_or_default()
                }
                _ => entry.to_owned(),
            });
        }
        let (width, per_line, mark, plus) = match is_large {
            true => (LARGE_FIELD, LARGE_FIELDS_PER_LINE, "*", '*'),
            false => (SMALL_FIELD, FIELDS_PER_LINE, "", '+'),
        };
        // NASTRAN-95 takes a line of the large format for half a card and wants the other half too.
        let whole = fields.len().next_multiple_of(FIELDS_PER_LINE);
        fields.resize(whole, String::new());
        let mut first = format!("{name}{mark}");
        for (row, line) in (1..).zip(fields.chunks(per_line)) {
            let mut written = format!("{first:SMALL_FIELD$}");
            written.extend(line.iter().map(|field| format!("{field:width$}")));
            if row * per_line < whole {
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
