//! Which cards are read, which say nothing of the model, and which may but are not understood.

use super::card::Card;
use super::elements::ELEMENT_CARDS;
use std::collections::BTreeMap;

/// Cards that are read, besides those of elements with their properties. EIGR and EIGRL say how to look for
/// eigenvalues, which is no part of the model and needs no note.
#[rustfmt::skip]
const READ: [&str; 13] = [
    "GRID", "GRDSET", "CONROD", "MAT1", "CMASS2", "CONM2", "SPC1", "SPCADD", "MPC", "MPCADD", "PARAM WTMASS", "EIGR", "EIGRL",
];
/// Cards that carry no stiffness, mass, support or coordinates in a search for normal modes: loads, temperatures,
/// damping, output, the order of equations and other solutions' methods.
#[rustfmt::skip]
const WITHOUT_PART: &[&str] = &[
    "PARAM", "PLOTEL", "SEQGP",
    "FORCE", "FORCE1", "FORCE2", "MOMENT", "MOMENT1", "MOMENT2", "PLOAD", "PLOAD1", "PLOAD2", "PLOAD3", "PLOAD4",
    "LOAD", "GRAV", "RFORCE", "SLOAD", "SPCD", "DEFORM", "TEMP", "TEMPD", "TEMPP1", "TEMPP2", "TEMPP3", "TEMPRB",
    "DLOAD", "RLOAD1", "RLOAD2", "TLOAD1", "TLOAD2", "DAREA", "DELAY", "DPHASE", "RANDPS", "RANDT1", "TIC",
    "FREQ", "FREQ1", "FREQ2", "TSTEP", "TABDMP1", "TABLED1", "TABLED2", "TABLED3", "TABLED4", "TABRND1",
    "CVISC", "PVISC", "CDAMP1", "CDAMP2", "CDAMP3", "CDAMP4", "PDAMP", "EIGB", "EIGC", "EIGP",
];
/// Parameters that change stiffness or mass; the last only with a positive value.
const OF_THE_MODEL: [&str; 6] = ["WTMASS", "CK1", "CK2", "CM1", "CM2", "COUPMASS"];

/// Cards of one name that were not read, for one reason.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unread {
    /// Their name; `PARAM COUPMASS` and its like for a parameter that changes stiffness or mass.
    pub card: String,
    /// The line of the first, from one.
    pub line: usize,
    /// How many there are.
    pub count: usize,
    /// Why.
    pub reason: Reason,
}

/// Why a card was not read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reason {
    /// The crate does not know it: it may be part of the model, and the deck is refused.
    Unknown,
    /// The same, but whoever asked for the deck takes responsibility for leaving it out.
    Ignored,
    /// It says nothing of stiffness, mass, supports or coordinates.
    WithoutPart,
    /// It belongs to a set of constraints that case control does not select.
    NotSelected,
}

impl Unread {
    /// The name with first line and count: `CBAR (line 7, 2 cards)`.
    pub fn place(&self) -> String {
        let cards = if self.count == 1 { "card" } else { "cards" };
        format!("{} (line {}, {} {cards})", self.card, self.line, self.count)
    }
}

/// The name that decides about a card: its own, with the parameter behind it for a PARAM that changes the model.
pub(super) fn name(card: &Card) -> String {
    let (parameter, value) = (card.text(2), card.text(3));
    let is_off = parameter == "COUPMASS" && (value == "NO" || value.parse::<i64>().is_ok_and(|value| value <= 0));
    let changes = card.name == "PARAM" && OF_THE_MODEL.contains(&parameter) && !is_off;
    if changes { format!("PARAM {parameter}") } else { card.name.clone() }
}

/// Whether cards of this [`name`] are read.
pub(super) fn is_read(name: &str) -> bool {
    READ.contains(&name) || ELEMENT_CARDS.iter().any(|known| name == known.0 || name == known.1)
}

/// Why cards of this [`name`] are not read, where those of the names `ignored` are left out by request.
pub(super) fn reason(name: &str, ignored: &[String]) -> Reason {
    match name {
        _ if WITHOUT_PART.contains(&name) => Reason::WithoutPart,
        _ if ignored.iter().any(|ignored| ignored == name) => Reason::Ignored,
        _ => Reason::Unknown,
    }
}

/// Cards given by name, line and reason, put together by name and reason in the order of the file.
pub(super) fn counted(cards: Vec<(String, usize, Reason)>) -> Vec<Unread> {
    let mut groups: BTreeMap<(String, Reason), Unread> = BTreeMap::new();
    for (card, line, reason) in cards {
        let none = Unread { card: card.clone(), line, count: 0, reason };
        let group = groups.entry((card, reason)).or_insert(none);
        group.count += 1;
        group.line = group.line.min(line);
    }
    let mut groups: Vec<Unread> = groups.into_values().collect();
    groups.sort_by_key(|group| group.line);
    groups
}
