//! The tables of what the method saves, and of how far its steps can be trusted.

use crate::evidence::eigensolutions::{Counted, Effort, eigensolution_table};
use crate::prelude::*;

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
    let written = table.rows[0].cells.iter().map(Cell::computed).collect_vec();
    assert_eq!(written, ["4", "3", "4", "5+", "45+"]);
}
