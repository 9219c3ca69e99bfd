//! Groups: the paper's substructures, all elements of one scaled together.

use crate::prelude::*;

fn grouped(number: usize) -> CaseResult {
    let mut case = case_of(number);
    case.grouping = Grouping::Substructures;
    case_run(&case)
}

/// Panels of each substructure, from the geometry: covers join upper or lower grids alone (odd or even), ribs four
/// consecutive grids, spars the rest.
fn by_geometry(case: &Case) -> [Vec<usize>; 3] {
    let mut found = [Vec::new(), Vec::new(), Vec::new()];
    for panel in &case.panels {
        let same_parity = panel
            .grids
            .iter()
            .all(|grid| grid % 2 == panel.grids[0] % 2);
        let same_rib = panel
            .grids
            .iter()
            .all(|grid| (grid - 1) / 4 == (panel.grids[0] - 1) / 4);
        let group = if same_parity {
            0
        } else if same_rib {
            2
        } else {
            1
        };
        found[group].push(panel.label);
    }
    found
}

#[test]
fn substructures_are_what_the_geometry_says() {
    let case = Case {
        grouping: Grouping::Substructures,
        ..case_of(2)
    };
    let model = case.model().unwrap();
    let names = model
        .parameters()
        .iter()
        .map(|p| p.name.as_str())
        .collect_vec();
    assert_eq!(names, ["covers", "spars", "ribs"]);
    for (parameter, expected) in model.parameters().iter().zip(by_geometry(&case)) {
        assert_eq!(parameter.elements, expected);
    }
}

#[test]
fn one_factor_moves_every_element_of_a_group() {
    for number in CASES {
        let result = grouped(number);
        assert_eq!(result.parameter_names.len(), 3);
        assert_eq!(result.unlimited_factors.len(), 3);
        let groups = by_geometry(&result.case);
        for (pass, gages) in result.correlation.passes.iter().zip(&result.pass_gages) {
            for (group, &factor) in groups.iter().zip(&pass.factors) {
                for &label in group {
                    let first = result.case.panels[label - 1].gage;
                    assert_relative_eq!(
                        gages[label - 1],
                        first * factor,
                        max_relative = 0.1 * ROUND_OFF
                    );
                }
            }
        }
    }
}

#[test]
fn error_common_to_a_group_is_found() {
    // Cases 1 and 2 start 50 % thick everywhere, so three factors of 2/3 are the whole answer.
    for number in [1, 2] {
        let result = grouped(number);
        assert!(result.correlation.converged, "Case {number}");
        let covers = result.pass_gages.last().unwrap()[1];
        assert!(
            relative_error(covers, TEST_GAGE) < GROUPED_GAGE,
            "Case {number}: covers at {covers}"
        );
    }
}

/// A group may have panels at both gage bounds, and the factor that takes one bound to the other is allowed.
#[test]
fn a_groups_factor_may_take_a_gage_from_bound_to_bound() {
    let mut case = case_of(3);
    case.grouping = Grouping::Substructures;
    let gages = case.gage_range.unwrap();
    let model = case.model().unwrap();
    assert_eq!(model.parameters().len(), 3);
    for parameter in model.parameters() {
        let range = parameter.factor_range.unwrap();
        assert_eq!(range.lower, gages.lower / gages.upper);
        assert_eq!(range.upper, gages.upper / gages.lower);
        assert!(range.lower < 1.0 && 1.0 < range.upper);
    }
}

#[test]
fn there_is_a_gage_for_every_panel() {
    let case = case_of(1);
    for count in [14, 16] {
        match case.model_with(&vec![TEST_GAGE; count]) {
            Err(CaseError::Method(Error::WrongShape {
                what,
                expected_rows,
                rows,
                ..
            })) => {
                assert_eq!((what, expected_rows, rows), ("panel gages", 15, count))
            }
            other => panic!("{other:?}"),
        }
    }
}

/// What steps are taken in: a group's size is the mean of its elements', and a model by its matrices has none.
#[test]
fn the_size_of_a_group_is_the_mean_of_its_elements() {
    let case = case_of(1);
    let own = case.model().unwrap();
    let structure = own.structure();
    let (panel, other, rod) = (
        &structure.elements()[0],
        &structure.elements()[1],
        &structure.elements()[20],
    );
    assert_ne!(panel.size, rod.size);
    let expected = [panel.size + rod.size, 3.0 * other.size];
    let parameters = vec![
        Parameter::new("two", &[panel.label, rod.label]),
        Parameter::new(other.label, &[other.label]),
    ];
    let (model, test) = (
        with_parameters(&case, parameters),
        case.test_modes().unwrap(),
    );
    let by_gage = |analysis: ModalModel| {
        let changes = analysis.stiffness_changes(analysis.exact(), &[1.0; 2], StepRule::Gage);
        let gage = |change| REFERENCE_GAGE * change / DERIVATIVE_STEP;
        changes.into_iter().map(gage).collect_vec()
    };
    let found = by_gage(model.analyze(&[2.0, 3.0], &test, None).unwrap());
    assert_alike(&found, expected, ROUND_OFF);
    let matrices = model.matrices(&[2.0, 3.0]).unwrap();
    let found = by_gage(matrices.analyze(&test, None).unwrap());
    assert_alike(&found, [REFERENCE_GAGE; 2], ROUND_OFF);
}
