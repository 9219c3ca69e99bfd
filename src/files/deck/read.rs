//! The reader, from cards to the model that they describe: the cards that are read, those that do not matter to the model, and
//! those that may matter but are unknown.

use super::card::{Card, Numbered};
use super::constraints::Constraints;
use super::coordinates::CoordinateSystems;
use super::elements::{ELEMENT_CARDS, ElementCards, Members, point_mass, take_masses};
use super::lines::{INCLUDES, Joined, NO_CARD, Selected, join, sections};
use super::model::{BulkData, PointMass};
use super::number::nearest_in_field;
use crate::files::error::FileError;
use crate::files::text::readable;
use std::collections::BTreeMap;

/// A deck as it was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Deck {
    /// The model.
    pub model: BulkData,
    pub(crate) members: Members,
    /// Cards that are not part of it, by name in the order of the file.
    pub unread: Vec<Unread>,
}

/// Reads a deck in UTF-8 or Latin-1, without cards of the names `ignored` that are not understood; `file` is its name in messages.
///
/// It may have executive and case control in front of `BEGIN BULK`, or be bulk data alone. Read are GRID, GRDSET,
/// CORD1R, CORD1C, CORD1S, CORD2R, CORD2C, CORD2S, CROD, PROD, CONROD, CSHEAR, PSHEAR, CQDMEM, PQDMEM, CTRMEM, PTRMEM, MAT1,
/// SPC, SPC1, SPCADD, MPC, MPCADD, CMASS1, PMASS, CMASS2, CONM2 and `PARAM,WTMASS`, which multiplies every mass and density,
/// in any order. Cards that say nothing of stiffness, mass,
/// supports or coordinates, such as loads, or properties and points to which no card refers, are listed in [`Deck::unread`], and so are
/// those ignored, except EIGR and EIGRL: they say how to look for eigenvalues. Every other card is an error.
///
/// # Errors
/// [`FileError::DeckCards`] lists all cards that are not read, if one of them is not understood; [`FileError::DeckLine`] and
/// [`FileError::DeckField`] name file, line, card and field; [`FileError::Refused`] if a name to be ignored is that of a card that is read.
pub fn read(file: &str, text: &[u8], ignored: &[String]) -> Result<Deck, FileError> {
    let ignored: Vec<String> = ignored
        .iter()
        .map(|card| card.trim().to_ascii_uppercase())
        .collect();
    if let Some(card) = ignored.iter().find(|name| is_read(name)) {
        return Err(FileError::refused(
            "--ignore",
            format!("corfem reads {card}; only cards that it does not read can be left out"),
        ));
    }
    if text.starts_with(&[0xff, 0xfe]) || text.starts_with(&[0xfe, 0xff]) {
        return Err(FileError::refused(file, "is in UTF-16; save it in UTF-8"));
    }
    let (selected, lines) = sections(file, &readable(file, text)?)?;
    let (cards, others): (Vec<Joined>, Vec<Joined>) = join(&file.into(), lines)?
        .into_iter()
        .partition(|found| is_read(&name(&found.card)));
    let (nameless, others): (Vec<Joined>, Vec<Joined>) = others
        .into_iter()
        .partition(|found| found.card.name == NO_CARD);
    let why = |card: &Card| match name(card) {
        name if is_among(&name, WITHOUT_PART) => Reason::WithoutPart,
        name if ignored.contains(&name) => Reason::Ignored,
        name if is_of_element(&name) => Reason::Lacking,
        name if INCLUDES.contains(&name.as_str()) => Reason::Elsewhere,
        _ => Reason::Unknown,
    };
    let unread = others
        .iter()
        .map(|found| one_unread(&found.card, why(&found.card)));
    let mut unread: Vec<Unread> = unread.collect();
    let refused = [Reason::Lacking, Reason::Elsewhere, Reason::Unknown];
    let is_refused = |card: &&mut Unread| refused.contains(&card.reason);
    let mut left = unread.iter_mut().filter(is_refused);
    if left.any(|card| !is_among(&card.card, BY_REFERENCE)) {
        let (file, cards) = (file.to_owned(), counted(&unread));
        return Err(FileError::DeckCards { file, cards });
    }
    // Nothing refers to these cards: what is read refers to cards that are read, or is refused.
    for card in unread.iter_mut().filter(is_refused) {
        card.reason = Reason::WithoutPart;
    }
    for found in nameless {
        found.sound()?;
    }
    let mut found = Found::default();
    for card in cards {
        found.take(card.sound()?)?;
    }
    found.deck(file, selected, unread)
}

/// The cards of a deck that are read, by what they are.
#[derive(Default)]
struct Found {
    grid_default: Option<Card>,
    weight: Option<Card>,
    grids: Numbered<()>,
    elements: ElementCards,
    masses: Numbered<()>,
    mass_properties: Numbered<f64>,
    systems: CoordinateSystems,
    constraints: Constraints,
}

impl Found {
    fn take(&mut self, card: Card) -> Result<(), FileError> {
        let once = |slot: &mut Option<Card>, card: Card, what: &str| {
            let reason = format!("this is the second {what}; a deck may have one");
            let again = FileError::line(&card.file, card.line, reason);
            slot.replace(card).map_or(Ok(()), |_| Err(again))
        };
        match card.name.as_str() {
            "GRID" => card.keep(2, (), &mut self.grids),
            "GRDSET" => once(&mut self.grid_default, card, "GRDSET card"),
            "PARAM" => once(&mut self.weight, card, "PARAM,WTMASS"),
            "PMASS" => take_masses(&card, &mut self.mass_properties),
            "CMASS1" | "CMASS2" | "CONM2" => card.keep(2, (), &mut self.masses),
            name if name.starts_with("CORD") => self.systems.take(card),
            "SPC" | "SPC1" | "SPCADD" | "MPC" | "MPCADD" => self.constraints.take(card),
            _ => self.elements.take(&card),
        }
    }

    /// The deck of these cards and of those that are not read.
    fn deck(
        mut self,
        file: &str,
        selected: Option<Selected>,
        mut unread: Vec<Unread>,
    ) -> Result<Deck, FileError> {
        let may_lack = unread.iter().any(|card| card.reason == Reason::Ignored);
        let left_out = self.constraints.select(file, selected, may_lack)?;
        let left_out = left_out.iter();
        unread.extend(left_out.map(|card| one_unread(card, Reason::NotSelected)));
        unread.extend(self.elements.torsion.iter().map(|card| Unread {
            card: format!("{} J", card.name),
            ..one_unread(card, Reason::Torsion)
        }));
        let (mut grids, motions) = self
            .systems
            .grids(&self.grids, self.grid_default.as_ref())?;
        self.constraints.constrain(&mut grids, &motions)?;
        let masses = self.masses.values().map(|kept| {
            let field = if kept.card.name == "CONM2" { 3 } else { 4 };
            kept.card.referred(field, &grids, "GRID")?;
            point_mass(&kept.card, &self.mass_properties, &motions)
        });
        let mut masses = masses.collect::<Result<Vec<PointMass>, FileError>>()?;
        let (mut elements, members) = self.elements.elements(&grids)?;
        let ties = self.constraints.ties(&grids, &motions)?;
        if let Some(card) = &self.weight {
            let densities = elements.iter_mut().map(|own| &mut own.material.density);
            let points = masses.iter_mut().map(|point| &mut point.mass);
            scale(card, densities.chain(points))?;
        }
        let grids = grids.into_values().collect();
        let model = BulkData {
            grids,
            elements,
            ties,
            masses,
        };
        let untouched = model.untouched().into_iter();
        unread.extend(untouched.map(|grid| one_unread(&self.grids[&grid].card, Reason::Untouched)));
        Ok(Deck {
            model,
            members,
            unread: counted(&unread),
        })
    }
}

/// Multiplies masses by `PARAM,WTMASS`, and rounds them to what a deck can hold, so that writing them loses nothing.
fn scale<'a>(card: &Card, masses: impl Iterator<Item = &'a mut f64>) -> Result<(), FileError> {
    let factor = card.positive(3)?;
    for mass in masses.filter(|mass| **mass > 0.0) {
        *mass = nearest_in_field(factor * *mass);
        card.require(
            mass.is_normal(),
            3,
            "a factor that keeps every mass within the range of numbers",
        )?;
    }
    Ok(())
}

/// Cards that are read, besides `PARAM,WTMASS` and those of elements with their properties. EIGR and EIGRL say how to look for
/// eigenvalues, which is no part of the model and needs no note.
const READ: &str = "\
    GRID GRDSET CORD1R CORD1C CORD1S CORD2R CORD2C CORD2S CONROD MAT1 CMASS1 PMASS CMASS2 CONM2 SPC SPC1 \
    SPCADD MPC MPCADD EIGR EIGRL";
/// Cards that carry no stiffness, mass, support or coordinates in a search for normal modes: loads, temperatures, heat, tables,
/// damping, output, the order of equations, elements that are alike, other solutions' methods, optimization, sets and aerodynamics.
const WITHOUT_PART: &str = "\
    PARAM MDLPRM PLOTEL SEQGP CNGRNT FORCE FORCE1 FORCE2 MOMENT MOMENT1 MOMENT2 PLOAD PLOAD1 PLOAD2 \
    PLOAD3 PLOAD4 LOAD GRAV RFORCE ACCEL ACCEL1 LSEQ SLOAD SPCD DEFORM TEMP TEMPD TEMPP1 TEMPP2 TEMPP3 \
    TEMPRB TEMPBC QVOL QBDY1 QBDY2 QBDY3 QHBDY QVECT MAT4 MAT5 MATS1 TABLES1 TABLEM1 TABLEM2 TABLEM3 \
    TABLEM4 NLPARM TSTEPNL PLFACT DLOAD RLOAD1 RLOAD2 TLOAD1 TLOAD2 DAREA DELAY DPHASE RANDPS RANDT1 TIC \
    FREQ FREQ1 FREQ2 FREQ3 FREQ4 FREQ5 TSTEP TABDMP1 TABLED1 TABLED2 TABLED3 TABLED4 TABRND1 CVISC PVISC \
    CDAMP1 CDAMP2 CDAMP3 CDAMP4 PDAMP EIGB EIGC EIGP DESVAR DVPREL1 DVPREL2 DVMREL1 DVMREL2 DVCREL1 \
    DVCREL2 DVGRID DRESP1 DRESP2 DRESP3 DCONSTR DCONADD DLINK DEQATN DTABLE DDVAL DOPTPRM DSCREEN DSCONS \
    DTI USET USET1 RVDOF RVDOF1 SET1 SET2 SET3 AERO AEROS AEFACT AELINK AELIST AEPARM AESTAT AESURF \
    AESURFS CAERO1 CAERO2 CAERO3 CAERO4 CAERO5 PAERO1 PAERO2 PAERO3 PAERO4 PAERO5 SPLINE1 SPLINE2 \
    SPLINE3 SPLINE4 SPLINE5 MKAERO1 MKAERO2 FLUTTER FLFACT TRIM GUST DIVERG CSSCHD MONPNT1 MONPNT2 \
    MONPNT3 MONDSP1";
/// Cards that elements and other cards which the crate lacks refer to: they mean nothing where no such card is.
const BY_REFERENCE: &str = "\
    PBAR PBARL PBEAM PBEAML PBCOMP PBUSH PBUSH1D PBUSHT PELAS PELAST PGAP PSHELL PCOMP PCOMPG PCOMPP PSOLID PLSOLID PLPLANE PSHEARN \
    PTUBE PTRIA1 PTRIA2 PQUAD1 PQUAD2 PTRPLT PQDPLT PTRBSC PQDMEM1 PQDMEM2 PTORDRG PTOROD PIHEX PVISCO PWELD PFAST PCONEAX PBEND \
    MAT2 MAT3 MAT8 MAT9 MAT10 BAROR BEAMOR SPOINT";
/// Cards of the model that the crate lacks, beside these and all whose names begin with C, R, Q or S as those of elements and
/// superelements do: none can be left out and leave the modes as they are.
const OF_ELEMENTS: &str = "MATT1 MAT11 GENEL ASET ASET1 OMIT OMIT1 SUPORT SUPORT1 DMIG DMI EPOINT";
/// Beginnings of the names of elements and of superelements' cards.
const ELEMENTS: &str = "\
    CBAR CBEAM CBEND CBUSH CCONEAX CELAS CFAST CGAP CHEX CIHEX CMASS3 CMASS4 CONM1 CPENTA CPYRAM CQDMEM1 \
    CQDMEM2 CQDPLT CQUAD CTETRA CTORDRG CTRAPRG CTRBSC CTRIA CTRPLT CTUBE CWEDGE CWELD RBAR RBE RROD RSPLINE \
    RTRPLT SEB SEC SEE SEL SEM SENQ SEQSET SESET SESUP SETREE CSUP";

/// True if a list of words has this one.
fn is_among(name: &str, all: &str) -> bool {
    all.split(' ').any(|known| known == name)
}

/// True of a card that only elements which the crate lacks have.
fn is_of_element(name: &str) -> bool {
    is_among(name, OF_ELEMENTS)
        || is_among(name, BY_REFERENCE)
        || name.starts_with("PARAM ")
        || ELEMENTS.split(' ').any(|start| name.starts_with(start))
}

/// Parameters that change stiffness or mass; the last only with a positive value.
const OF_THE_MODEL: &str = "WTMASS CK1 CK2 CM1 CM2 COUPMASS";
/// Parameters of MDLPRM that say what is printed and how equations are solved; others may choose the formulation of elements.
const OF_OUTPUT: &str = "\
    HDF5 H5GM34 H5INFO H5MDL H5MTX H5NORDOF H5XHH NONUPIV PIVTHRSH PRDIDPVT PRDITRFN PRDMTYPE PRDOOC PRDWMTCH \
    PRTELAS PRTFAST PRTMASS PRTSEAM PRTWELD";

/// Cards of one name that were not read, for one reason.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unread {
    /// Name of the cards; `PARAM COUPMASS` and its like for a parameter that changes stiffness or mass or may do so.
    pub card: String,
    /// The line of the first, from one.
    pub line: usize,
    /// Number of the cards.
    pub count: usize,
    /// Reason for which they were not read.
    pub reason: Reason,
}

/// Reason for which a card was not read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reason {
    /// A card of an element, or of what only such elements have, that the crate lacks: the deck is refused.
    Lacking,
    /// A statement that names another file, which is not read: the deck is refused.
    Elsewhere,
    /// A card that the crate does not know: it may be part of the model, and the deck is refused.
    Unknown,
    /// An unknown card that whoever asked for the deck takes responsibility for leaving out.
    Ignored,
    /// A card that says nothing of stiffness, mass, supports or coordinates.
    WithoutPart,
    /// A card of a set of constraints that the first subcase of case control does not select.
    NotSelected,
    /// A card that gives rods torsion, which no stiffness includes.
    Torsion,
    /// A grid that no element, mass or equation touches: it is held.
    Untouched,
}

impl Unread {
    /// The name with first line and count: `CBAR (line 7, 2 cards)`.
    pub fn place(&self) -> String {
        let cards = if self.count == 1 { "card" } else { "cards" };
        format!("{} (line {}, {} {cards})", self.card, self.line, self.count)
    }
}

/// The name that decides about a card: its own, with the parameter behind it for one that changes the model or may do so.
pub(super) fn name(card: &Card) -> String {
    let (parameter, value) = (card.text(2), card.text(3));
    let is_off = parameter == "COUPMASS"
        && (value == "NO" || value.parse::<i64>().is_ok_and(|value| value <= 0));
    let changes = match card.name.as_str() {
        "PARAM" if !is_off => Some(parameter).filter(|own| is_among(own, OF_THE_MODEL)),
        // Pairs of names and values: the names are in even fields.
        "MDLPRM" => {
            let names = card.filled().into_iter().filter(|field| field % 2 == 0);
            let mut names = names.map(|field| card.text(field));
            names.find(|own| !is_among(own, OF_OUTPUT))
        }
        _ => None,
    };
    changes.map_or(card.name.clone(), |own| format!("{} {own}", card.name))
}

/// True if cards of this [`name`] are read.
fn is_read(name: &str) -> bool {
    name == "PARAM WTMASS"
        || is_among(name, READ)
        || ELEMENT_CARDS
            .iter()
            .any(|known| name == known.0 || name == known.1)
}

fn one_unread(card: &Card, reason: Reason) -> Unread {
    Unread {
        card: name(card),
        line: card.line,
        count: 1,
        reason,
    }
}

/// Cards put together by name and reason, in the order of the file.
fn counted<'a>(cards: impl IntoIterator<Item = &'a Unread>) -> Vec<Unread> {
    let mut groups: BTreeMap<(&str, Reason), Unread> = BTreeMap::new();
    for card in cards {
        let group = groups.entry((&card.card, card.reason)).or_insert(Unread {
            count: 0,
            ..card.clone()
        });
        group.count += 1;
        group.line = group.line.min(card.line);
    }
    let mut groups: Vec<Unread> = groups.into_values().collect();
    groups.sort_by_key(|group| group.line);
    groups
}
