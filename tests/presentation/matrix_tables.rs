//! The comparison of matrices and elements as tables, number by number.

use crate::evidence::claims::matrix_comparison::compared;
use crate::evidence::matrix_comparison::compare_matrices;
use crate::evidence::matrix_tables::matrix_tables;
use crate::prelude::*;

#[test]
fn comparison_as_numbers() {
    let numbers = Numbers::BY_UNIT;
    for case in 1..=3 {
        let tables = matrix_tables(&Case::new(case).unwrap(), &compared(case));
        let names: Vec<&str> = tables.iter().map(|table| table.name.as_str()).collect();
        assert_eq!(
            names,
            [
                "matrix_frequencies_as_tested",
                "matrix_frequencies_after_a_change",
                "matrix_distance",
                "stiffness_change_truth",
                "stiffness_change_element_factors",
                "stiffness_change_baruch",
                "stiffness_change_berman_and_nagy",
                "mass_change_berman_and_nagy",
                "matrix_factors"
            ]
        );
        assert_golden(&format!("matrices_case_{case}"), &csv(&tables), numbers);
    }
    let all = compare_matrices(&Case::new(2).unwrap(), 9).unwrap();
    let tables = matrix_tables(&Case::new(2).unwrap(), &all);
    let labels = |table: usize| {
        tables[table]
            .rows
            .iter()
            .map(|row| row.label.as_str())
            .collect::<Vec<_>>()
    };
    assert_eq!(
        labels(0).last(),
        Some(&"RMS test modes"),
        "there are no others"
    );
}
