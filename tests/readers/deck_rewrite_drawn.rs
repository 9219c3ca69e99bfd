//! Decks drawn at random with other sizes: what they then say, and their modes.

use super::deck_rewrite::{Factors, elements, rewritten};
use crate::prelude::*;

/// How a card is written: with small fields to either side, with large ones with or without a tag, or in free format.
fn card(name: &str, fields: &[String], style: usize, tag: usize) -> String {
    let large = |ends: [String; 2]| {
        let mut fields = fields.to_vec();
        fields.resize(8, String::new());
        let half = |first: &str, fields: &[String]| {
            fields.iter().fold(format!("{first:8}"), |line, field| {
                line + &format!("{field:>16}")
            })
        };
        let first = half(&format!("{name}*"), &fields[..4]);
        format!(
            "{first}{}\n{}\n",
            ends[0],
            half(&ends[1], &fields[4..]).trim_end()
        )
    };
    match style {
        0 => {
            fields.iter().fold(format!("{name:8}"), |line, field| {
                line + &format!("{field:8}")
            }) + " $ kept\n"
        }
        1 => {
            fields
                .iter()
                .fold(format!("{:8}", name.to_lowercase()), |line, field| {
                    line + &format!("{field:>8}")
                })
                + "\n"
        }
        2 => large([String::new(), "*".to_owned()]),
        3 => large([format!("*T{tag}"), format!("*T{tag}")]),
        _ => format!("{name} , {}\n", fields.join(", ")),
    }
}

/// A deck of up to ten elements of two kinds that share up to three properties of each and two materials, and factors on sizes and
/// densities of some elements.
fn decks() -> impl Strategy<Value = (String, Factors)> {
    let element = (
        any::<bool>(),
        0..3_usize,
        0..5_usize,
        prop::option::of((0..3_usize, 0..3_usize)),
    );
    let property = (0..2_usize, 1..9999_u32, 0..5_usize);
    let weight = prop::option::of(0.001..2.0_f64);
    let factors = (
        prop::array::uniform3(0.2..5.0_f64),
        prop::array::uniform3(0.2..5.0_f64),
    );
    (
        prop::collection::vec(element, 1..10),
        prop::array::uniform6(property),
        weight,
        factors,
        any::<bool>(),
    )
        .prop_map(|(drawn, properties, weight, (sizes, densities), windows)| {
            let mut text = "GRID,1\nGRID,2,,1.\nGRID,3,,1.,1.\n$ properties\n".to_owned();
            for (row, (material, size, style)) in properties.iter().enumerate() {
                let fields = [
                    (row + 5).to_string(),
                    (material + 1).to_string(),
                    format!(".{size:04}"),
                ];
                text += &card(["PROD", "PTRMEM"][row / 3], &fields, *style, row);
            }
            text += "MAT1,1,1.+7,,.3,2.5-4\nMAT1    2       1.+7            .3\n";
            for (row, (is_rod, property, style, _)) in drawn.iter().enumerate() {
                let (name, property) = if *is_rod {
                    ("CROD", 5 + property)
                } else {
                    ("CTRMEM", 8 + property)
                };
                let corners = if *is_rod { 2 } else { 3 };
                let labels = [row + 1, property]
                    .into_iter()
                    .chain(1..=corners)
                    .map(|label| label.to_string());
                text += &card(name, &labels.collect_vec(), *style, 10 + row);
            }
            if let Some(weight) = weight {
                text += &format!("PARAM,WTMASS,{weight:.4}\n");
            }
            let text = if windows {
                text.replace('\n', "\r\n")
            } else {
                text
            };
            let changes = (1..).zip(&drawn).filter_map(|(label, (.., change))| {
                let (size, density) = (*change)?;
                Some((label, [sizes[size], densities[density]]))
            });
            (text, changes.collect())
        })
}

properties! {
    #[test]
    fn a_rewritten_deck_says_the_new_sizes_and_else_the_same((text, factors) in decks()) {
        let result = rewritten(text.as_bytes(), &factors)?;
        // One more property for every other size or density of a property, unless all of it changes alike.
        let result = String::from_utf8(result)?;
        let property = |text: &str| -> Vec<Vec<String>> {
            text.lines().filter(|line| line.to_uppercase().starts_with(['C', 'P']) && !line.starts_with("PARAM"))
                .map(|line| line.replace([',', '*'], " ").split_whitespace().map(str::to_uppercase).collect()).collect()
        };
        let (before, after) = (property(&text), property(&result));
        let mut groups: BTreeMap<&str, BTreeSet<Option<[u64; 2]>>> = BTreeMap::new();
        for element in elements(text.as_bytes()) {
            let own = before.iter().find(|card| card[0].starts_with('C') && card[1] == element.label.to_string());
            let (own, change) = (own.unwrap(), factors.get(&element.label));
            groups.entry(&own[2]).or_default().insert(change.map(|own| own.map(f64::to_bits)));
            // Whose size and density stay, stays with its property.
            prop_assert!(change.is_some() || after.iter().any(|card| card[..3] == own[..3]), "{:?}", own);
        }
        let several = groups.values().filter(|own| own.len() > 1);
        let added: usize = several.map(|own| own.iter().flatten().count()).sum();
        prop_assert_eq!(after.len(), before.len() + added, "{}", result);
        // Every other line stands where it stood.
        let others = |text: &str| -> Vec<String> {
            let other = |line: &&str| !line.to_uppercase().starts_with(['C', 'P', '*', 'M']) && line.trim() != "$ kept";
            text.split_inclusive('\n').filter(other).map(str::to_owned).collect()
        };
        prop_assert_eq!(others(&text), others(&result));
    }

    /// Other point masses, and nothing else.
    #[test]
    fn point_masses_are_rewritten_and_every_other_line_stays(
        model in bulk_data(),
        factors in prop::collection::vec(prop::option::of(1e-3..1e3_f64), 4),
    ) {
        let text = bulk_text(&model)?;
        let points = model.masses.iter().zip(&factors);
        let changes = points.filter_map(|(point, factor)| Some((point.label, (*factor)?))).collect();
        let written = rewrite("deck", text.as_bytes(), &Factors::new(), &changes)?;
        let mut read = deck::read("deck", &written, &[])?.model;
        for (read, point) in read.masses.iter_mut().zip(&model.masses) {
            let wanted = point.mass * changes.get(&point.label).unwrap_or(&1.0);
            prop_assert!((read.mass - wanted).abs() <= WRITTEN * wanted);
            read.mass = point.mass;
        }
        prop_assert_eq!(&read, &model);
        let is_mass = |line: &&str| line.starts_with("CMASS2") || line.starts_with("CONM2") || line.starts_with('*');
        let others = |text: &str| text.lines().filter(|line| !is_mass(line)).map(str::to_owned).collect_vec();
        prop_assert_eq!(others(&String::from_utf8_lossy(&written)), others(&text));
    }
}
