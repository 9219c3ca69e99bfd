//! Parameters' matrices are parts of the first model's as far as digits tell, one by one and together.

use super::job_unseen::{chain, files};
use crate::prelude::*;
use corfem::job::concern::Check;

/// The files with the numbers of all matrices written with so many digits, those of one after a factor.
pub fn written(files: &Files, digits: usize, (name, factor): (&str, f64)) -> Files {
    let number = |of: &str, line: &str| {
        let (place, value) = line.rsplit_once(' ')?;
        let factor = if of == name { factor } else { 1.0 };
        let value = factor * value.parse::<f64>().ok()?;
        Some(format!("{place} {value:.*e}\n", digits - 1))
    };
    let shortened = |(of, text): (String, String)| {
        if !of.ends_with(".mtx") {
            return (of, text);
        }
        let lines = text.lines().enumerate();
        let lines = lines.filter_map(|(row, line)| match row {
            0 | 1 => Some(format!("{line}\n")),
            _ => number(&of, line),
        });
        let text = lines.collect();
        (of, text)
    };
    files.iter().cloned().map(shortened).collect()
}

/// Doubts about parts.
fn doubts(files: &Files) -> Vec<String> {
    let trust = trust_in(&prepared(files));
    let all = trust.all().iter();
    let all = all.filter(|own| own.check == Check::PartsOfTheModel);
    all.map(|own| own.identifier.clone()).collect()
}

properties! {
    #![proptest_config(crate::common::config())]

    #[test]
    fn right_parts_are_never_doubted_and_wrong_ones_are_named(
        (seed, digits, wrong) in (any::<u64>(), 7..17_usize, 0..3_usize),
    ) {
        let mut draws = Draws(seed);
        let of = chain(&mut draws);
        let right = files(&of, &Default::default(), 0.0, &mut draws);
        prop_assert_eq!(doubts(&written(&right, digits, ("", 1.0))), [""; 0]);
        let name = format!("p{wrong}.mtx");
        // Springs in a row have all of the energy of some motion.
        for factor in [2.0, 1.01] {
            let found = doubts(&written(&right, digits, (&name, factor)));
            prop_assert_eq!(found, [format!("not-part-p{wrong}")]);
        }
        let found = doubts(&written(&right, digits, (&name, -0.1)));
        prop_assert_eq!(found, [format!("negative-p{wrong}")]);
    }
}
