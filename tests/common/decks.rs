//! Strategies of models that a deck can hold, and of decks that say the same in another way.

use crate::prelude::*;
use corfem::files::deck::{Deck, PointMass};

/// The bulk data alone of the deck that is written of a model.
///
/// # Errors
/// Those of [`deck::write`].
pub fn bulk_text(model: &BulkData) -> Result<String, FileError> {
    let deck = deck::write(model, "", 1, [1.0, 2.0])?;
    let bulk = deck.split_once("BEGIN BULK\n").unwrap().1;
    Ok(bulk
        .split_inclusive('\n')
        .take_while(|line| !line.starts_with("EIGR"))
        .collect())
}

/// A decimal number of up to ten digits between 1e-15 and 1e15: a field of 16 characters holds it exactly, with its
/// sign and an exponent.
pub fn field_number() -> impl Strategy<Value = f64> {
    (-9_999_999_999..=9_999_999_999_i64, -15..=5_i32)
        .prop_map(|(digits, power)| format!("{digits}e{power}").parse().unwrap())
}

fn positive_number() -> impl Strategy<Value = f64> {
    (1..=9_999_999_999_i64, -15..=5_i32)
        .prop_map(|(digits, power)| format!("{digits}e{power}").parse().unwrap())
}

/// Two materials: Poisson's ratio of four digits, a shear modulus that follows from it or one of its own, with or without
/// a density.
fn materials() -> impl Strategy<Value = Vec<Material>> {
    let one = (
        positive_number(),
        -9999..=5000_i32,
        prop::option::of(positive_number()),
        prop::option::of(positive_number()),
    )
        .prop_map(|(e, nu, g, density)| {
            let material = Material::isotropic(e, f64::from(nu) / 1e4).unwrap();
            Material {
                shear_modulus: g.unwrap_or(material.shear_modulus),
                density: density.unwrap_or(0.0),
                ..material
            }
        });
    prop::collection::vec(one, 2)
}

/// Labels in ascending order, with gaps of up to 300.
fn labels(count: usize) -> impl Strategy<Value = Vec<usize>> {
    prop::collection::vec(1..=300_usize, count).prop_map(|steps| {
        steps
            .iter()
            .scan(0, |label, step| {
                *label += step;
                Some(*label)
            })
            .collect()
    })
}

/// Any model that a deck can hold: five structural grids, up to three dynamic points tied to them, up to six elements
/// of every kind, up to four masses. Its geometry means nothing: it is for reading and writing alone.
pub fn bulk_data() -> impl Strategy<Value = BulkData> {
    const STRUCTURAL: usize = 5;
    const POINTS: usize = 3;
    let grids = (
        labels(STRUCTURAL + POINTS),
        prop::collection::vec(
            (prop::array::uniform3(field_number()), any::<[bool; 3]>()),
            STRUCTURAL + POINTS,
        ),
    );
    let elements = (
        labels(6),
        prop::collection::vec(
            (0..4_usize, 0..STRUCTURAL, positive_number(), 0..2_usize),
            0..=6,
        ),
        materials(),
    );
    let term = (0..STRUCTURAL, 0..3_usize, field_number());
    let ties = prop::collection::vec(
        (
            0..3_usize,
            positive_number(),
            prop::collection::vec(term, 0..=7),
        ),
        0..=POINTS,
    );
    let masses = (
        labels(4),
        prop::collection::vec(
            (
                0..STRUCTURAL + POINTS,
                prop::option::of(0..3_usize),
                positive_number(),
            ),
            0..=4,
        ),
    );
    (grids, elements, ties, masses).prop_map(|(grids, elements, ties, masses)| {
        let (labels, places) = grids;
        let mut grids = labels
            .into_iter()
            .zip(places)
            .map(|(label, (position, constrained))| Grid {
                label,
                position: position.into(),
                constrained,
            })
            .collect_vec();
        let (labels, drawn, materials) = elements;
        let kinds = [
            ElementKind::Rod,
            ElementKind::ShearPanel,
            ElementKind::Membrane,
            ElementKind::Triangle,
        ];
        let elements = labels
            .into_iter()
            .zip(drawn)
            .map(|(label, (kind, first, size, material))| Element {
                label,
                kind: kinds[kind],
                grids: (0..kinds[kind].corner_count())
                    .map(|corner| grids[(first + corner) % STRUCTURAL].label)
                    .collect(),
                size,
                material: materials[material],
            })
            .collect();
        let mut tied = Vec::new();
        for (point, (direction, coefficient, terms)) in ties.into_iter().enumerate() {
            let grid = &mut grids[STRUCTURAL + point];
            grid.constrained[direction] = false;
            let dependent = StructuralDof {
                grid: grid.label,
                direction,
            };
            let terms = terms.into_iter().map(|(row, direction, coefficient)| {
                let grid = grids[row].label;
                (StructuralDof { grid, direction }, coefficient)
            });
            tied.push(Tie {
                dependent,
                coefficient: -coefficient,
                terms: terms.collect(),
            });
        }
        let (labels, drawn) = masses;
        let masses = labels
            .into_iter()
            .zip(drawn)
            .map(|(label, (row, direction, mass))| PointMass {
                label,
                grid: grids[row].label,
                direction,
                mass,
            })
            .collect();
        BulkData {
            grids,
            elements,
            ties: tied,
            masses,
        }
    })
}

/// Reads a deck that is called "test", with nothing to ignore.
pub fn read_deck(text: impl AsRef<str>) -> Result<Deck, FileError> {
    deck::read("test", text.as_ref().as_bytes(), &[])
}
