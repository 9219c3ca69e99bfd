//! What may lower the trust in a job's result, in every output and in the exit status.

use crate::common::jobs::unbroken;
use crate::prelude::*;
use corfem::present::json;
use corfem::present::page::report_page;

/// Every kind of concern, in order.
pub const KINDS: [Kind; Kind::UnitsOfTest as usize + 1] = {
    use Kind::*;
    [
        Interrupted,
        Mechanisms,
        FreeByDigits,
        MeasuredTwice,
        FrequenciesExchanged,
        NamedFactor,
        UnnamedFactor,
        Reversed,
        Exchanged,
        Reordered,
        Gain,
        Dead,
        Direction,
        Percent,
        ExcludesStart,
        UnitOfPlaces,
        OtherGrid,
        NumberedOtherwise,
        UnitsDisagree,
        NoPair,
        BeyondReach,
        NegativePart,
        NotPart,
        Twin,
        SumOfStiffness,
        SumOfMass,
        Unlike,
        PartnerTaken,
        WouldHarm,
        OutOfReach,
        NotChecked,
        PartNotChecked,
        Parallel,
        Dependent,
        Undecided,
        Joined,
        Blind,
        MostlyPrior,
        AtBound,
        AssumedDeviations,
        NotUsed,
        NotSelected,
        RigidModes,
        AnalysisModes,
        Mass,
        MassByDirection,
        CenterOfMass,
        ChiSquared,
        Misfit,
        BelowNoise,
        HeldOut,
        HeldOutFrequency,
        Unanswered,
        UnseenModes,
        PartsWithoutSensor,
        LooseWithoutSensor,
        HeldDirection,
        SuspensionHidden,
        LargeDeviation,
        FarApart,
        Alike,
        TooManyModes,
        Unbounded,
        FrequenciesAlone,
        CloseModes,
        OwnWeights,
        Covariance,
        Variances,
        Drift,
        Complex,
        NotInEveryMode,
        DatasetsNotRead,
        UnitsOfTest,
    ]
};

/// An account with a concern of every kind.
fn full() -> Trust {
    let concern = |kind| Concern::new(kind, &["7", "rib"], &[0.31, 2.0, 3.0, 4.0]);
    Trust::new(KINDS.map(concern).to_vec())
}

/// The words of a concern stand alone, in a table or a sentence of their own, and its identifier on a command line.
#[test]
fn every_kind_of_concern_has_a_sentence_and_an_identifier() {
    assert!(KINDS.is_sorted_by(|one, next| one < next));
    for concern in full().all() {
        let (words, identifier) = (concern.words(), concern.identifier());
        assert!(
            words.starts_with(|first: char| first.is_uppercase() || first.is_numeric()),
            "{words}"
        );
        assert!(words.ends_with(['.', '?']), "{words}");
        assert!(
            !words.contains(['{', '}']) && !words.contains("NaN"),
            "{words}"
        );
        let is_plain = |letter: char| letter.is_alphanumeric() || letter == '-';
        assert!(identifier.chars().all(is_plain), "{identifier}");
    }
}

/// Names of any length make identifiers of at most forty characters, and of two long ones that begin alike two.
#[test]
fn identifiers_are_short_and_differ() {
    let long = |end: &str| {
        let name = format!("the upper skin between the ribs at {end}");
        Concern::new(Kind::NotPart, &[name], &[]).identifier()
    };
    let both = [long("station 110"), long("station 120")];
    assert!(both.iter().all(|one| one.chars().count() == 40), "{both:?}");
    assert_ne!(both[0], both[1]);
    assert_eq!(
        Concern::new(Kind::Twin, &["a b", "c"], &[]).identifier(),
        "twin-a-b-c"
    );
}

/// A list of many names tells how many it leaves out.
#[test]
fn a_long_list_names_eight_and_counts_the_rest() {
    let unbounded = |count: usize| {
        let names = (1..=count).collect_vec();
        Concern::new(Kind::Unbounded, &names, &[]).words()
    };
    assert!(unbounded(9).ends_with(": 1, 2, 3, 4, 5, 6, 7, 8, 9."));
    assert!(unbounded(100).ends_with(": 1, 2, 3, 4, 5, 6, 7, 8 and 92 more."));
}

#[test]
fn all_that_is_said_of_trust_stands_first_in_text_csv_json_and_html() {
    let loaded = prepared(&rods());
    let mut result = finished(&loaded);
    result.trust = full();
    let report = Report::from_job(&loaded, Some(&result)).unwrap();
    let table = [trust_table(&result.trust)];
    let document = json::document(json::report(&report).unwrap()).unwrap();
    let page = report_page(&report, &[], "corfem correlate job.toml", "").unwrap();
    let document: Value = serde_json::from_str(&document).unwrap();
    assert_eq!(document["trust"], serde_json::to_value(full()).unwrap());
    for words in full().all().iter().map(Concern::words) {
        assert!(unbroken(&render::text(&table)).contains(&words), "{words}");
        let doubled = words.replace('"', "\"\"");
        assert!(unbroken(&render::csv(&table)).contains(&doubled), "{words}");
        let escaped = words.replace('"', "&quot;");
        assert!(unbroken(&page).contains(&escaped), "{words}");
    }
    // Before anything else that was computed.
    let first = page.find("What to know before trusting this").unwrap();
    assert!(first < page.find("test modes and their partners").unwrap());
    assert!(
        report.words().starts_with(
            "Not to be trusted as it stands (doubt mechanisms, doubt free-by-digits, "
        )
    );
}
