//! Decks drawn at random with other sizes: what they then say, and their modes.

use super::deck_rewrite::elements;
use crate::prelude::*;
use crate::readers::deck_mass_law::{DOF, roots, whole_box};
use crate::spec::s2_parameters_mass::DENSITY;

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

/// A deck of up to ten elements of two kinds that share up to three properties of each and two materials, and new sizes and
/// densities of some elements.
fn decks() -> impl Strategy<Value = (String, Vec<Element>)> {
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
            let mut wanted = elements(text.as_bytes());
            for (element, (.., change)) in wanted.iter_mut().zip(&drawn) {
                if let Some((size, density)) = change {
                    element.size = nearest_in_field(element.size * sizes[*size]);
                    element.material.density =
                        nearest_in_field(element.material.density * densities[*density]);
                }
            }
            (text, wanted)
        })
}

properties! {
    #[test]
    fn a_rewritten_deck_says_the_new_sizes_and_else_the_same((text, wanted) in decks()) {
        let result = rewrite("deck", text.as_bytes(), &wanted, &[])?;
        let read = elements(&result);
        let first = elements(text.as_bytes());
        prop_assert_eq!(read.len(), wanted.len());
        for (read, wanted) in read.iter().zip(&wanted) {
            // A density is divided by WTMASS and rounded before it is multiplied again.
            let density = wanted.material.density;
            prop_assert!((read.material.density - density).abs() <= 2.0 * DECK_ROUNDING * density);
            let mut read = read.clone();
            read.material.density = density;
            prop_assert_eq!(&read, wanted);
        }
        // One more property for every other size or density of a property, and the fewest connections to it.
        let result = String::from_utf8(result)?;
        let property = |text: &str| -> Vec<Vec<String>> {
            text.lines().filter(|line| line.to_uppercase().starts_with(['C', 'P']) && !line.starts_with("PARAM"))
                .map(|line| line.replace([',', '*'], " ").split_whitespace().map(str::to_uppercase).collect()).collect()
        };
        let (before, after) = (property(&text), property(&result));
        let mut groups: BTreeMap<&str, BTreeMap<(u64, u64), usize>> = BTreeMap::new();
        let mut moved = 0;
        for (element, first) in wanted.iter().zip(&first) {
            let own = before.iter().find(|card| card[0].starts_with('C') && card[1] == element.label.to_string());
            let own = own.unwrap();
            let key = |element: &Element| (element.size.to_bits(), element.material.density.to_bits());
            *groups.entry(&own[2]).or_default().entry(key(element)).or_default() += 1;
            // Whose size and density stay, stays with its property.
            if key(element) == key(first) {
                prop_assert!(after.iter().any(|card| card[..3] == own[..3]), "{:?}", own);
            }
            moved += usize::from(!after.iter().any(|card| card[..3] == own[..3]));
        }
        let added: usize = groups.values().map(|targets| targets.len() - 1).sum();
        prop_assert_eq!(after.len(), before.len() + added, "{}", result);
        let most = |targets: &BTreeMap<(u64, u64), usize>| targets.values().sum::<usize>() - targets.values().min().unwrap_or(&0);
        prop_assert!(moved <= groups.values().map(most).sum::<usize>());
        // Every other line stands where it stood.
        let others = |text: &str| -> Vec<String> {
            let other = |line: &&str| !line.to_uppercase().starts_with(['C', 'P', '*', 'M']);
            text.split_inclusive('\n').filter(other).map(str::to_owned).collect()
        };
        prop_assert_eq!(others(&text), others(&result));
        // Once more with the same wish changes nothing, unless WTMASS rounds.
        if !text.contains("WTMASS") {
            prop_assert_eq!(rewrite("deck", result.as_bytes(), &wanted, &[])?, result.as_bytes());
        }
    }

    /// The modes of the model at some factors and with other densities are those of its first deck with the elements rewritten.
    #[test]
    fn modes_of_the_rewritten_deck_are_those_of_the_model(
        stiffness in prop::array::uniform2(0.3..3.0_f64),
        mass in prop::option::of(prop::array::uniform2(0.3..3.0_f64)),
        has_density in any::<bool>(),
        points in prop::collection::vec(0.002..0.02_f64, DOF),
    ) {
        let density = if has_density { DENSITY } else { 0.0 };
        let model = whole_box([density; 3], &points);
        let (places, ones) = ([Vector3::zeros(); DOF], [1.0; 2]);
        let first = bulk_text(&BulkData::from_model(&model, &ones, &places)?)?;
        let [covers, rods] = mass.unwrap_or(ones);
        let other = whole_box([covers * density, density, rods * density], &points);
        let wanted = BulkData::from_model(&other, &stiffness, &places)?.elements;
        let text = rewrite("box", first.as_bytes(), &wanted, &[])?;
        let read = deck::read("box", &text, &[])?.model;
        let found = deck::modes(&read, usize::MAX)?.modes.omega_squared().clone();
        let own = roots(&other, &stiffness);
        prop_assert_eq!(found.len(), own.len());
        let tolerance = 2.0 * DECK_ROUNDING + ROUND_OFF * own[DOF - 1] / own[0];
        prop_assert!(tolerance < 1e-4);
        for (own, found) in own.iter().zip(&found) {
            prop_assert!(relative_error(own, found) < tolerance, "{own} {found} {tolerance}");
        }
        let untouched = BulkData::from_model(&model, &ones, &places)?.elements;
        prop_assert_eq!(rewrite("box", first.as_bytes(), &untouched, &[])?, first.as_bytes());
    }

    /// Other point masses, and nothing else.
    #[test]
    fn point_masses_are_rewritten_and_every_other_line_stays(
        model in bulk_data(),
        factors in prop::collection::vec(prop::option::of(1e-3..1e3_f64), 4),
    ) {
        let text = bulk_text(&model)?;
        let mut wanted = model.clone();
        for (point, factor) in wanted.masses.iter_mut().zip(factors) {
            point.mass = nearest_in_field(point.mass * factor.unwrap_or(1.0));
        }
        let written = rewrite("deck", text.as_bytes(), &[], &wanted.masses)?;
        prop_assert_eq!(&deck::read("deck", &written, &[])?.model, &wanted);
        let is_mass = |line: &&str| line.starts_with("CMASS2") || line.starts_with("CONM2") || line.starts_with('*');
        let others = |text: &str| text.lines().filter(|line| !is_mass(line)).map(str::to_owned).collect_vec();
        prop_assert_eq!(others(&String::from_utf8_lossy(&written)), others(&text));
    }
}
