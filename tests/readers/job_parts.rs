//! Parameters' matrices are parts of the first model's as far as digits tell, one by one and together.

use super::job_unseen::{chain, files};
use crate::prelude::*;

/// The files with the numbers of all matrices written with so many digits, those of one after a factor.
fn written(files: &Files, digits: usize, (name, factor): (&str, f64)) -> Files {
    let number = |of: &str, line: &str| {
        let (place, value) = line.rsplit_once(' ')?;
        let value: f64 = value.parse().ok()?;
        let factor = if of == name { factor } else { 1.0 };
        Some(format!("{place} {:.*e}\n", digits - 1, factor * value))
    };
    let shortened = |(of, text): &(String, String)| {
        let mut lines = text.lines();
        let head: String = lines
            .by_ref()
            .take(2)
            .map(|line| format!("{line}\n"))
            .collect();
        let rest: String = lines.filter_map(|line| number(of, line)).collect();
        let text = if of.ends_with(".mtx") {
            head + &rest
        } else {
            text.clone()
        };
        (of.clone(), text)
    };
    files.iter().map(shortened).collect()
}

/// Doubts about parts.
fn doubts(files: &Files) -> Vec<String> {
    let prepared = prepared(files);
    let trust = trust_in(&prepared);
    let of_parts = ["negative-", "not-part-", "sum-of-", "twin-"];
    let all = trust.all().iter().map(Concern::identifier);
    all.filter(|identifier| of_parts.iter().any(|part| identifier.starts_with(part)))
        .collect()
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

    #[test]
    fn a_part_in_two_parameters_is_named_by_both(
        (seed, digits) in (any::<u64>(), 7..17_usize),
    ) {
        let mut draws = Draws(seed);
        let of = chain(&mut draws);
        let mut again = files(&of, &Default::default(), 0.0, &mut draws);
        let half = again.iter().find(|(name, _)| name == "p1.mtx").expect("a part").1.clone();
        again.push(("half.mtx".to_owned(), half));
        again[0].1 += "[[parameter]]\nname = \"again\"\nmatrix = \"half.mtx\"\n";
        let again = written(&again, digits, ("half.mtx", 0.5));
        prop_assert_eq!(doubts(&again), ["sum-of-stiffness"]);
        let (_folder, path) = placed(&again);
        let prepared = prepare(&path).unwrap();
        let trust = trust_in(&prepared);
        let words = trust.of(Kind::SumOfStiffness).next().expect("a doubt").words();
        prop_assert!(words.contains("p1") || words.contains("again"), "{words}");
    }
}
