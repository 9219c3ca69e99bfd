//! `corfem tables`, and what reports say of the paper's tables in them.

use crate::presentation::program::cli::{corfem, printed};
use serde_json::Value;

#[test]
fn all_thirteen_tables_or_those_asked_for() {
    let all = printed(&["tables"]);
    assert!(all.contains("(Table 1, computed anew)"));
    assert!((2..=13).all(|number| all.contains(&format!("Table {number}. "))));
    let one = printed(&["tables", "13"]);
    assert!(one.starts_with("Table 13. ") && one.contains("1.9") && !one.contains("Table 2. "));
    assert!(printed(&["tables", "1", "-f", "csv"]).contains("\ntable_1,1,First order,%,"));
    assert!(
        printed(&["tables", "13", "-f", "csv"]).contains("\npublished_13,3,Pass 1 time,s,,4.8\n")
    );
    assert!(printed(&["tables", "13", "-f", "markdown"]).contains("| Pass 1 time, s |"));
    let json: Value =
        serde_json::from_str(&printed(&["tables", "1", "13", "-f", "json"])).expect("JSON");
    let tables = json["tables"].as_array().expect("a list");
    assert_eq!(tables.len(), 2);
    for table in tables {
        let columns = table["columns"].as_array().expect("a list").len();
        let rows = table["rows"].as_array().expect("a list");
        assert!(
            rows.iter()
                .all(|row| row["cells"].as_array().map(Vec::len) == Some(columns))
        );
    }
    assert!(tables[0]["rows"][0]["cells"][0]["computed"].is_f64());
    assert_eq!(
        (
            &tables[1]["rows"][2]["label"],
            &tables[1]["rows"][2]["cells"][1]
        ),
        (&"3".into(), &"4.8".into())
    );
}

#[test]
fn other_numbers_are_bad_input() {
    for number in ["0", "14"] {
        let done = corfem(&["tables", number]);
        assert_eq!((done.status.code(), done.stdout.len()), (Some(2), 0));
    }
}

#[test]
fn a_report_says_which_tables_it_holds() {
    let words = |text: String| text.split_whitespace().collect::<Vec<_>>().join(" ");
    for (arguments, numbers) in [
        (&["cases", "--all", "-q"][..], "3, 4, 5, 6, 7, 8, 13"),
        (&["cases", "2", "-q"], "5, 6, 13"),
        (&["cases", "3", "-q", "-f", "markdown"], "7, 8, 13"),
    ] {
        let sentence = format!("Of the paper's tables, here are {numbers}; corfem tables prints");
        assert!(
            words(printed(arguments)).contains(&sentence),
            "{arguments:?}"
        );
    }
}
