//! The tables of culprits, of two rules side by side, of intervals, and of suspects.

use crate::common::jobs::loaded;
use crate::evidence::coverage::{Coverage, ENOUGH, Held, coverage_tables};
use crate::evidence::localization::{localization, localization_tables};
use crate::ledgers::tables::{COVERED, computed};
use crate::prelude::*;
use corfem::present::render::{WIDTH, markdown};
use corfem::present::tables::job::MOST_SUSPECTS;

fn fits(tables: &[Table]) {
    let text = text(tables);
    assert!(
        text.lines().all(|line| line.chars().count() <= WIDTH),
        "{text}"
    );
    let whole = |table: &Table| {
        table
            .rows
            .iter()
            .all(|row| row.cells.len() == table.columns.len())
    };
    assert!(tables.iter().all(whole));
}

fn written(table: &Table, row: &str) -> Vec<String> {
    let row = table
        .rows
        .iter()
        .find(|found| found.label == row)
        .expect("the row");
    row.cells.iter().map(Cell::computed).collect()
}

#[test]
fn culprits_without_noise_are_those_of_the_golden() {
    let tables = localization_tables(&localization(1..=1).expect("it runs"));
    fits(&tables);
    for table in &tables {
        assert_eq!(table.rows.len(), 16);
        for (row, column) in table
            .rows
            .iter()
            .flat_map(|row| [0, 3].map(|column| (row, column)))
        {
            let name = &table.columns[column].name;
            assert_eq!(
                row.cells[column].computed(),
                computed(&table.name, &row.label, name, 0)
            );
        }
    }
    // All panels are found first by their own fit, with one seed's noise too.
    assert_eq!(written(&tables[0], "all")[3..], ["15", "15", "15"]);
    assert!(csv(&tables).contains("\nlocalization_0.5,all,Fit first,,15,\n"));
    assert!(markdown(&tables).contains("| Panel | Factor, no noise | Factor first |"));
    assert!(
        tables[0].title.starts_with("One panel 0.01 times as thick")
            && tables[0].title.ends_with("of 1 noisy tests")
    );
}

#[test]
fn intervals_are_counted_by_what_the_test_says_of_a_parameter() {
    let held = |parameter: &str, given, tests, learned| Held {
        parameter: parameter.to_owned(),
        given,
        tests,
        learned,
    };
    let of = |parameters| Coverage {
        name: "A box".to_owned(),
        tests: 10,
        parameters,
        chi_squared: 99.0,
        degrees_of_freedom: 100.0,
        explained: 9,
        flagged: 8,
    };
    let parameters = vec![
        held("a", 10, 9, 0.99),
        held("b", 5, 4, 0.95),
        held("c", 1, 1, 0.5),
    ];
    let tables = coverage_tables(&[of(parameters)]);
    fits(&tables);
    assert_eq!(
        written(&tables[0], "A box"),
        [
            "3", "2", "85.0", "80.0", "25.0", "10.0", "0.990", "90.0", "80.0"
        ]
    );
    assert_eq!(
        (tables[1].name.as_str(), written(&tables[1], "c")),
        (
            "coverage_a_box",
            ["100.0", "10.0", "50.0"].map(str::to_owned).to_vec()
        )
    );
    assert_eq!(
        written(
            &coverage_tables(&[of(vec![held("c", 0, 0, 0.1)])])[0],
            "A box"
        )[..5],
        ["1", "0", "", "", ""]
    );
}

/// What three hundred tests came to, on file, is what is asked.
#[test]
fn the_structures_on_file_keep_what_is_asked() {
    let number = |structure: &str, column, decimals| -> f64 {
        computed("coverage", structure, column, decimals)
            .parse()
            .expect("a number")
    };
    for structure in COVERED {
        let of = |column| number(structure, column, 3);
        let asked = if structure == "Case 3" {
            LEAST_COVER
        } else {
            LEAST_PARAMETER_COVERAGE
        };
        assert!(
            (93.0..=97.0).contains(&of("Held")),
            "{structure}: {}",
            of("Held")
        );
        assert!(
            of("Least held") >= 100.0 * asked,
            "{structure}: {}",
            of("Least held")
        );
        let misfit = of("Chi-squared");
        assert!((misfit - 1.0).abs() <= MEAN_MISFIT, "{structure}: {misfit}");
        assert!(of("Explained") >= 95.0, "{structure}: {}", of("Explained"));
        let is_enough = of("Degrees of freedom") >= ENOUGH;
        assert!(
            !is_enough || of("Flagged") >= 99.0,
            "{structure}: {}",
            of("Flagged")
        );
    }
}

#[test]
fn a_job_names_its_suspects() {
    let job = |name: &str| {
        let mut prepared = loaded(name);
        // The test as it would be were the fifth parameter alone wrong: a third of what it is in the model.
        let mut factors = vec![1.0; prepared.loaded.source.whole.parameters().len()];
        factors[4] = 0.3;
        let right = prepared.analyze(&factors).expect("modes");
        let right = right.model().exact();
        for (j, &i) in right.pairing.analysis_mode.iter().enumerate() {
            alter(&mut prepared.test, |squares, _| {
                squares[j] = right.modes.omega_squared()[i];
            });
            let shape = right.modes.shapes().column(i).into_owned();
            alter(&mut prepared.test, |_, shapes| shapes.set_column(j, &shape));
        }
        let table = suspects_table(&prepared).expect("a table");
        fits(from_ref(&table));
        (prepared, table)
    };
    // The building's ten modes are all there are; the wing's 25 of many give the culprit, and its factor roughly.
    for (name, has_all_modes) in [("building", true), ("wing", false)] {
        let (prepared, table) = job(name);
        let parameters = prepared.loaded.source.whole.parameters();
        assert_eq!(table.rows.len(), parameters.len().min(MOST_SUSPECTS));
        assert_eq!(
            table.notes.len(),
            if parameters.len() > MOST_SUSPECTS {
                2
            } else {
                1
            }
        );
        assert_eq!(table.rows[0].label, parameters[4].name);
        let Cell::Number { computed, .. } = table.rows[0].cells[0] else {
            panic!("a number")
        };
        let off = relative_error(computed, 0.3);
        assert!(
            if has_all_modes {
                off < SINGLE_FIT_FACTOR
            } else {
                computed < 1.0
            },
            "{name}: {computed}"
        );
    }
}
