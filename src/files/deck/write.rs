//! The writer, from the model to a deck that NASTRAN-95 runs unchanged.

use super::card::{FIELDS_PER_LINE, LARGEST_LABEL};
use super::elements::ELEMENT_CARDS;
use super::lines::LARGE_FIELDS_PER_LINE;
use super::model::BulkData;
use super::number::{LARGE_FIELD, SMALL_FIELD, exact_real, large_real};
use crate::files::error::FileError;
use crate::method::error::{check_count, require};
use crate::method::structure::{Grid, Material};

/// The set of constraints that case control selects, of SPC1 and of MPC.
const SET: usize = 1;

/// A whole deck that sets NASTRAN the task of so many normal modes between two frequencies, Hz, by the inverse power method, which allows a
/// singular mass matrix: executive control, case control and bulk data; `title` goes into the output's headings.
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
pub fn write(
    model: &BulkData,
    title: &str,
    count: usize,
    [lower, upper]: [f64; 2],
) -> Result<String, FileError> {
    let ties = match model.ties[..] {
        [] => String::new(),
        _ => format!("MPC = {SET}\n"),
    };
    let text = format!(
        "NASTRAN BANDIT=-1\nID      CORFEM,DECK\nAPP     DISPLACEMENT\nSOL     3,0\nTIME    5\nDIAG    44\n\
         CEND\n\
         TITLE = {}\nSPC = {SET}\n{ties}METHOD = {SET}\nDISPLACEMENT = ALL\nBEGIN BULK\n",
        title.to_ascii_uppercase()
    );
    let mut cards = Cards {
        text,
        ..Cards::default()
    };
    cards.model(model)?;
    let method = format!("{SET},INV,{lower:?},{upper:?},{count},{count},,,MASS");
    cards.push("EIGR", &method)?;
    cards.text.push_str("ENDDATA\n");
    Ok(cards.text)
}

/// Cards as text.
#[derive(Default)]
pub struct Cards {
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
        for grid in &model.grids {
            let (label, at) = (grid.label, grid.position);
            self.push(
                "GRID",
                &format!("{label},,{:?},{:?},{:?}", at.x, at.y, at.z),
            )?;
        }
        self.elements(model)?;
        for point in &model.masses {
            let (label, grid, mass) = (point.label, point.grid, point.mass);
            match point.direction.map(|direction| direction + 1) {
                Some(own) => self.push("CMASS2", &format!("{label},{mass:?},{grid},{own}"))?,
                None => self.push("CONM2", &format!("{label},{grid},,{mass:?}"))?,
            }
        }
        for tie in &model.ties {
            let mut entries = SET.to_string();
            let own = [(tie.dependent, tie.coefficient)];
            for (row, (dof, coefficient)) in own.iter().chain(&tie.terms).enumerate() {
                // Two terms to a line; the last field of one and the first of the next stay blank.
                entries += if row > 0 && row % 2 == 0 { ",,," } else { "," };
                entries += &format!("{},{},{coefficient:?}", dof.grid, dof.direction + 1);
            }
            self.push("MPC", &entries)?;
        }
        let alike = |a: &Grid, b: &Grid| a.constrained == b.constrained && a.label + 1 == b.label;
        for run in model.grids.chunk_by(alike) {
            let (first, last) = (&run[0], run[run.len() - 1].label); // A run has at least one.
            let held = (0..3).filter(|direction| first.constrained[*direction]);
            let held: String = held.map(|direction| (direction + 1).to_string()).collect();
            // The rotations of every grid are constrained, for nothing here resists them.
            let mut entries = format!("{SET},{held}456,{}", first.label);
            if run.len() > 1 {
                entries += &format!(",THRU,{last}");
            }
            self.push("SPC1", &entries)?;
        }
        Ok(())
    }

    /// Cards of elements, each with a property, and of their materials.
    fn elements(&mut self, model: &BulkData) -> Result<(), FileError> {
        let mut materials: Vec<Material> = Vec::new();
        for own in &model.elements {
            let known = materials.iter().position(|other| *other == own.material);
            let row = known.unwrap_or(materials.len());
            materials.extend(known.is_none().then_some(own.material));
            for (connection, property, _) in ELEMENT_CARDS.iter().filter(|card| card.2 == own.kind)
            {
                let corners: String = own.grids.iter().map(|grid| format!(",{grid}")).collect();
                self.push(connection, &format!("{0},{0}{corners}", own.label))?;
                self.push(
                    property,
                    &format!("{},{},{:?}", own.label, row + 1, own.size),
                )?;
            }
        }
        for (row, own) in (1..).zip(materials) {
            let (e, nu, g) = (own.youngs_modulus, own.poissons_ratio, own.shear_modulus);
            let is_derived = Material::isotropic(e, nu).is_ok_and(|other| other.shear_modulus == g);
            let text = |value: f64, is_blank| match is_blank {
                true => String::new(),
                false => format!("{value:?}"),
            };
            let (shear, density) = (text(g, is_derived), text(own.density, own.density == 0.0));
            self.push("MAT1", &format!("{row},{e:?},{shear},{nu:?},{density}"))?;
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
                    check_count(
                        "number of a grid or element in a deck",
                        label.unsigned_abs().max(1),
                        1,
                        LARGEST_LABEL,
                    )?;
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
        let (width, per_line, mark, plus) = if is_large {
            (LARGE_FIELD, LARGE_FIELDS_PER_LINE, "*", '*')
        } else {
            (SMALL_FIELD, FIELDS_PER_LINE, "", '+')
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
