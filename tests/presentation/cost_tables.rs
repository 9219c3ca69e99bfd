//! The tables of what the method saves, and of how far its steps can be trusted.

use crate::evidence::eigensolutions::{Counted, ERRORS, Effort, count_all, eigensolution_table};
use crate::evidence::linearization::linearization_table;
use crate::evidence::predictions::{Exact, METHODS, both_structures};
use crate::prelude::*;
use corfem::present::render::WIDTH;

fn fits(table: &Table) {
    let text = text(std::slice::from_ref(table));
    assert!(
        text.lines().all(|line| line.chars().count() <= WIDTH),
        "{text}"
    );
    assert!(
        table
            .rows
            .iter()
            .all(|row| row.cells.len() == table.columns.len())
    );
}

#[test]
fn eigensolutions_are_those_of_the_golden() {
    let table = eigensolution_table(&count_all(&ERRORS).expect("they run"));
    fits(&table);
    let numbers = Numbers {
        relative: GOLDEN_STEPS,
        absolute: GOLDEN_COUNT,
        last_digit: false,
        whole: true,
        ..Numbers::AS_WRITTEN
    };
    assert_golden("eigensolutions", &csv(&[table]), numbers);
}

#[test]
fn what_is_not_reached_says_so() {
    let effort = |analyses, reached| Effort {
        analyses,
        steps: 4,
        reached,
    };
    let (perturbation, reanalysis) = (effort(3, true), effort(5, false));
    let counted = Counted {
        name: "A box".to_owned(),
        error: 0.025,
        parameters: 10,
        perturbation,
        reanalysis,
    };
    let table = eigensolution_table(&[counted]);
    assert_eq!(table.rows[0].label, "A box, 2.5 %");
    let written: Vec<String> = table.rows[0].cells.iter().map(Cell::computed).collect();
    assert_eq!(written, ["4", "3", "4", "5+", "45+"]);
}

#[test]
fn errors_of_steps_are_those_of_the_golden() {
    for exact in [Exact::SameCondensation, Exact::NewCondensation] {
        let table = linearization_table(&both_structures(exact).expect("they run"), exact);
        fits(&table);
        assert_eq!((table.rows.len(), table.columns.len()), (12, METHODS.len()));
        let numbers = Numbers {
            relative: JOB_RESULTS,
            absolute: 100.0 * ROUND_OFF_FLOOR,
            last_digit: true,
            ..Numbers::AS_WRITTEN
        };
        assert_golden(&table.name.clone(), &csv(&[table]), numbers);
    }
}
