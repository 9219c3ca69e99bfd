//! The page of keys, `golden/vectors.md`: every key of the known vectors stands on it with its shape, and no other.

use super::vectors::vectors;
use crate::prelude::*;

/// Shapes by function, side and key.
fn page() -> BTreeMap<String, &'static str> {
    let mut shapes = BTreeMap::new();
    let page = include_str!("../../golden/vectors.md");
    for section in page.split("\n## `").skip(1) {
        let function = section.split('`').next().unwrap();
        for row in section.lines().filter_map(|line| line.strip_prefix("| `")) {
            let cells = row.split(" | ").collect_vec();
            for key in cells[0].trim_end_matches('`').split("`, `") {
                shapes.insert(format!("{function} {} {key}", cells[1]), cells[2]);
            }
        }
    }
    shapes
}

#[test]
fn every_key_stands_on_its_page_with_its_shape() {
    let (page, mut seen) = (page(), BTreeSet::new());
    for vector in &vectors() {
        let (input, mut lengths) = (&vector["input"], BTreeMap::new());
        let sides = [
            ("input", input),
            ("answer", &vector["answer"]),
            ("input", &input["structure"]),
        ];
        for (side, values) in sides {
            for (key, mut value) in values.as_object().into_iter().flatten() {
                let key = key.trim_end_matches("_imaginary");
                let sections = [vector["function"].as_str().unwrap(), "structure"];
                let mut places = sections
                    .iter()
                    .map(|section| format!("{section} {side} {key}"));
                let place = places.find(|place| page.contains_key(place)).expect(key);
                // A letter is one length throughout a vector; words are what has none.
                for letter in page[&place].split(" × ").filter(|letter| letter.len() < 3) {
                    let parts = value.as_array().expect(&place);
                    let first = letter.parse().unwrap_or(parts.len());
                    assert_eq!(
                        *lengths.entry(letter).or_insert(first),
                        parts.len(),
                        "{place}"
                    );
                    value = &parts[0];
                }
                assert!(!value.is_array(), "{place}");
                seen.insert(place);
            }
        }
    }
    assert!(
        seen.iter().eq(page.keys()),
        "{:?}",
        page.keys().filter(|place| !seen.contains(*place))
    );
}
