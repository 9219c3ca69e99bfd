//! From the model to a deck that NASTRAN-95 runs unchanged.

use super::card::{Entry, write_card};
use super::elements::ELEMENT_CARDS;
use super::model::{BulkData, PointMass};
use crate::files::error::FileError;
use crate::method::structure::{Grid, Material};

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

/// A whole deck: executive control, case control and bulk data.
///
/// What makes a run of NASTRAN-95 right is in the executive control: `BANDIT=-1` keeps the grids in the order of their
/// numbers, and `DIAG 44` takes the decomposition that gives right answers (the default one of the 1995 release does not).
/// `title` stands in the output's headings.
///
/// # Errors
/// Those of [`bulk_data`].
pub fn write(model: &BulkData, title: &str, task: &Task) -> Result<String, FileError> {
    let mut text = String::from(
        "NASTRAN BANDIT=-1\nID      CORFEM,DECK\nAPP     DISPLACEMENT\nSOL     3,0\nTIME    5\nDIAG    44\n",
    );
    if *task == Task::Matrices {
        text.push_str(
            "INSERT READ,-1 $\nOUTPUT5 KGG,KAA,MAA,,//-1/15/*CORFEM*/1 $\nEXIT $\nENDALTER\n",
        );
    }
    text.push_str(&format!("CEND\nTITLE = {}\n", title.to_ascii_uppercase()));
    text.push_str(&format!("SPC = {SET}\n"));
    if !model.ties.is_empty() {
        text.push_str(&format!("MPC = {SET}\n"));
    }
    text.push_str(&format!("METHOD = {SET}\n"));
    if let Task::Modes { .. } = task {
        text.push_str("DISPLACEMENT = ALL\n");
    }
    text.push_str("BEGIN BULK\n");
    let mut tag = 0;
    text.push_str(&bulk_data(model, &mut tag)?);
    // Rigid format 3 wants a method even where the run ends before it is used.
    let (count, [lower, upper]) = match task {
        Task::Modes { count, range_hz } => (*count, *range_hz),
        Task::Matrices => (1, [1.0, 2.0]),
    };
    let eigenvalues = [
        Entry::Label(SET),
        Entry::Word("INV".into()),
        Entry::Real(lower),
        Entry::Real(upper),
        Entry::Label(count),
        Entry::Label(count),
        Entry::Blank,
        Entry::Blank,
        Entry::Word("MASS".into()),
    ];
    text.push_str(&write_card("EIGR", &eigenvalues, false, &mut tag)?);
    text.push_str("ENDDATA\n");
    Ok(text)
}

/// The bulk data alone, without a `BEGIN BULK` or `ENDDATA`. `tag` counts continuations.
///
/// Grids have fields of 16 characters, other cards where 8 would lose digits; a number that needs more than 16
/// characters is rounded to the nearest that fits (see [`super::number::large_real`]). Every element has a property card of its
/// own number, every distinct material a MAT1 card.
///
/// # Errors
/// [`Error::NotFinite`] and [`Error::TooMany`] for numbers that no card can hold.
pub fn bulk_data(model: &BulkData, tag: &mut usize) -> Result<String, FileError> {
    let mut text = String::new();
    let mut put = |name: &str, entries: &[Entry], large: bool| -> Result<(), FileError> {
        text.push_str(&write_card(name, entries, large, tag)?);
        Ok(())
    };
    for grid in &model.grids {
        let mut entries = vec![Entry::Label(grid.label), Entry::Blank];
        entries.extend(grid.position.iter().map(|&x| Entry::Real(x)));
        put("GRID", &entries, true)?;
    }
    let mut materials: Vec<Material> = Vec::new();
    for element in &model.elements {
        let number = match materials
            .iter()
            .position(|known| *known == element.material)
        {
            Some(row) => row + 1,
            None => {
                materials.push(element.material);
                materials.len()
            }
        };
        let mut connection = vec![Entry::Label(element.label); 2];
        connection.extend(element.grids.iter().map(|&grid| Entry::Label(grid)));
        let property = [
            Entry::Label(element.label),
            Entry::Label(number),
            Entry::Real(element.size),
        ];
        for (connection_card, property_card, kind) in ELEMENT_CARDS {
            if kind == element.kind {
                put(connection_card, &connection, false)?;
                put(property_card, &property, false)?;
            }
        }
    }
    for (row, material) in materials.iter().enumerate() {
        let Material {
            youngs_modulus: e,
            poissons_ratio: nu,
            shear_modulus: g,
            density,
        } = *material;
        let derived = Material::isotropic(e, nu).is_ok_and(|other| other.shear_modulus == g);
        let optional = |blank: bool, value| {
            if blank {
                Entry::Blank
            } else {
                Entry::Real(value)
            }
        };
        let entries = [
            Entry::Label(row + 1),
            Entry::Real(e),
            optional(derived, g),
            Entry::Real(nu),
            optional(density == 0.0, density),
        ];
        put("MAT1", &entries, false)?;
    }
    for PointMass {
        label,
        grid,
        direction,
        mass,
    } in &model.masses
    {
        let (label, grid, mass) = (
            Entry::Label(*label),
            Entry::Label(*grid),
            Entry::Real(*mass),
        );
        match direction {
            Some(direction) => {
                let component = Entry::Label(direction + 1);
                put("CMASS2", &[label, mass, grid, component], false)?;
            }
            None => put("CONM2", &[label, grid, Entry::Blank, mass], false)?,
        }
    }
    for tie in &model.ties {
        let own = std::iter::once((tie.dependent, tie.coefficient));
        let mut entries = vec![Entry::Label(SET)];
        for (row, (dof, coefficient)) in own.chain(tie.terms.iter().copied()).enumerate() {
            // Two terms to a line; the last field of one and the first of the next stay blank.
            if row > 0 && row % 2 == 0 {
                entries.extend([Entry::Blank, Entry::Blank]);
            }
            entries.push(Entry::Label(dof.grid));
            entries.push(Entry::Label(dof.direction + 1));
            entries.push(Entry::Real(coefficient));
        }
        put("MPC", &entries, false)?;
    }
    for entries in constraint_cards(&model.grids) {
        put("SPC1", &entries, false)?;
    }
    Ok(text)
}

/// Fields of the SPC1 cards, one for every run of grids that are constrained alike. The rotations of every grid are constrained, for
/// nothing here resists them.
fn constraint_cards(grids: &[Grid]) -> Vec<Vec<Entry>> {
    grids
        .chunk_by(|a, b| a.constrained == b.constrained && a.label + 1 == b.label)
        .map(|run| {
            let (first, last) = (&run[0], &run[run.len() - 1]); // A run has at least one.
            let constrained = (0..3).filter(|&direction| first.constrained[direction]);
            let mut components: String = constrained
                .map(|direction| (b'1' + direction as u8) as char)
                .collect();
            components.push_str("456");
            let mut entries = vec![
                Entry::Label(SET),
                Entry::Word(components),
                Entry::Label(first.label),
            ];
            if run.len() > 1 {
                entries.extend([Entry::Word("THRU".into()), Entry::Label(last.label)]);
            }
            entries
        })
        .collect()
}
