//! Captions of figures promise nothing but what is to be seen.

use crate::paper::figures::Figure;
use crate::presentation::figures::figures;

/// A caption says in numbers what is to be seen, but for drawings of the structure alone.
#[test]
fn captions_of_results_have_numbers() {
    let structures = ["box_points", "box_elements", "cover_gages", "derivatives"];
    for Figure { name, caption, .. } in figures() {
        if structures.iter().any(|end| name.ends_with(end)) {
            continue;
        }
        let (_, said) = caption.split_once(": ").unwrap();
        let digits = said.split("(the paper's").next().unwrap();
        assert!(
            digits.contains(|letter: char| letter.is_ascii_digit()),
            "{name}: {caption}"
        );
    }
}
