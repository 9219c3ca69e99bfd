//! What the test still says where the paper's loop ends: one weighted step from there, whose numbers are goldens.

use crate::paper::tables::cases::next_step_table;
use crate::presentation::figures::results;

/// The box is symmetric about its mid-plane: upper and lower covers answer alike. Case 4's single iteration corrects nothing, so nothing is
/// near enough to its end for a linear step.
#[test]
fn the_covers_of_each_bay_cannot_be_indistinct_groups_and_case_4_has_no_next_step() {
    for found in &results()[..3] {
        let groups = found.next_step.as_ref().unwrap().seen.parallel_groups();
        assert_eq!(groups, [[1, 14], [3, 7], [8, 10]]);
    }
    let last = &results()[3];
    assert!(last.next_step.is_none() && next_step_table(last).is_none());
}
