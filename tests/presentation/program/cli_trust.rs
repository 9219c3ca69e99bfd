//! What may lower the trust in a job's result, in every output and in the exit status.

use crate::common::jobs::unbroken;
use crate::prelude::*;
use corfem::job::concern::{Check, Grade};
use corfem::job::of_bodies;
use corfem::present::page::report_page;
use corfem::sparse::BodyFinding;

/// An account with a concern of every grade, and words that outputs must quote.
fn full() -> Trust {
    let rib = || "Hardly seen: \"rib\".".to_owned();
    Trust::new(vec![
        Concern::remark(Check::Sight, "blind", &["rib"], rib()),
        Concern::new(
            Grade::NotChecked,
            Check::Fit,
            "not-checked-",
            &["the fit"],
            "Not checked: the fit, of too few numbers.".to_owned(),
        ),
        Concern::new(Grade::LeftOut, Check::Pairs, "not-compared-", &[7], rib()),
        Concern::doubt(Check::Pairs, "no-pair", &[""; 0], "No pair?".to_owned()),
        Concern::doubt(Check::Readings, "reversed-", &["S 7"], rib()),
    ])
}

/// An identifier is one word with the names of what it is about, where it is about some things among many.
#[test]
fn identifiers_are_words_that_differ() {
    let of = |name: &str, about: &[&str]| {
        Concern::doubt(Check::PartsOfTheModel, name, about, String::new()).identifier
    };
    assert_eq!(of("exchanged-", &["a b", "c"]), "exchanged-a-b-c");
    assert_eq!(of("exchanged", &["a b", "c"]), "exchanged");
}

/// A list of many names tells how many it leaves out.
#[test]
fn a_long_list_names_eight_and_counts_the_rest() {
    let free = |count: usize| {
        let names = (1..=count).map(|name| name.to_string()).collect();
        of_bodies(&BodyFinding::Mechanisms(names)).words
    };
    assert!(free(8).starts_with("Motions of 1, 2, 3, 4, 5, 6, 7, 8 are"));
    assert!(free(100).starts_with("Motions of 1, 2, 3, 4, 5, 6, 7, 8 and 92 more are"));
}

#[test]
fn all_that_is_said_of_trust_stands_first_in_text_csv_json_and_html() {
    let loaded = prepared(&rods());
    let mut result = finished(&loaded);
    result.trust = full();
    let report = report_of(&result);
    let table = [trust_table("", &result.trust)];
    let document = serde_json::to_value(&report).unwrap();
    let page = report_page(&report).unwrap();
    assert_eq!(document["concerns"], serde_json::to_value(full()).unwrap());
    for Concern { words, .. } in full().all() {
        assert!(unbroken(&render::text(&table)).contains(words), "{words}");
        let doubled = words.replace('"', "\"\"");
        assert!(unbroken(&render::csv(&table)).contains(&doubled), "{words}");
        let escaped = words.replace('"', "&quot;");
        assert!(unbroken(&page).contains(&escaped), "{words}");
    }
    // Before anything else that was computed.
    let first = page.find("What to know before trusting this").unwrap();
    assert!(first < page.find("Test modes and their partners").unwrap());
    assert!(
        report
            .answer
            .starts_with("Not to be trusted as it stands: ")
    );
}
