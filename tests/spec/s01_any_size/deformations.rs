//! Elements by their ways to deform: the same matrix, and as many as elasticity says.

use crate::common::matrices::rank_of_semidefinite;
use crate::common::strategies::symmetric;
use crate::common::structures::wings;
use crate::common::tolerances::ROUND_OFF;
use corfem::method::appendix_a::{ElementMatrix, element_matrices};
use corfem::method::structure::ElementKind;
use corfem::sparse::Deformations;
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;

fn element(unit: DMatrix<f64>) -> ElementMatrix {
    let count = unit.nrows();
    ElementMatrix {
        label: 4,
        dof: (0..count).rev().collect(),
        unit,
    }
}

properties! {
    #![proptest_config(crate::common::config())]

    /// Whatever a symmetric matrix is, its ways to deform sum to it, and with them come its label and DOF.
    #[test]
    fn ways_to_deform_sum_to_the_matrix(unit in (1..=6_usize).prop_flat_map(symmetric), decades in -290..=290_i32) {
        let element = element(unit * 10.0_f64.powi(decades));
        let found = Deformations::of(&element).unwrap();
        let matrix = found.matrix();
        prop_assert!((&matrix.unit - &element.unit).amax() <= ROUND_OFF * element.unit.amax());
        prop_assert!(matrix.unit == matrix.unit.transpose());
        prop_assert_eq!((found.label(), found.dof()), (4, element.dof.as_slice()));
        prop_assert_eq!((matrix.label, matrix.dof), (4, element.dof));
    }

    /// A semidefinite one has as many as its rank.
    #[test]
    fn a_semidefinite_matrix_has_as_many_ways_as_its_rank(
        columns in prop::collection::vec(prop::collection::vec(-1.0..1.0_f64, 6), 1..=6),
    ) {
        let columns: Vec<DVector<f64>> = columns.into_iter().map(DVector::from_vec).collect();
        let unit: DMatrix<f64> = columns.iter().fold(DMatrix::zeros(6, 6), |sum, way| sum + way * way.transpose());
        let (rank, found) = (rank_of_semidefinite(&unit), Deformations::of(&element(unit.clone())).unwrap());
        prop_assert!(found.count() >= rank && found.count() <= columns.len());
        prop_assert!((found.matrix().unit - &unit).amax() <= ROUND_OFF * unit.amax());
    }

    /// A rod and a shear panel deform in one way. A membrane has twelve motions: in its plane eight less the three rigid ones resist;
    /// if it is warped, all but the six rigid ones in space.
    #[test]
    fn elements_of_a_wing_deform_in_as_many_ways_as_elasticity_says(wing in wings()) {
        let structure = wing.structure().unwrap();
        for (matrix, element) in element_matrices(&structure).zip(structure.elements()) {
            let found = Deformations::of(&matrix).unwrap();
            let ways = if element.kind == ElementKind::Membrane { 5..=6 } else { 1..=1 };
            prop_assert!(found.count() <= *ways.end(), "{} of {:?}", found.count(), element.kind);
            let is_whole = matrix.dof.len() == 3 * element.grids.len();
            prop_assert!(!is_whole || ways.contains(&found.count()), "{} of {:?}", found.count(), element.kind);
            prop_assert!((found.matrix().unit - &matrix.unit).amax() <= ROUND_OFF * matrix.unit.amax());
        }
    }
}

#[test]
fn a_matrix_that_leans_or_is_of_no_number_is_refused() {
    for (entry, words) in [
        (0.5, "relative asymmetry of element stiffness is 1.5;"),
        (f64::NAN, "element stiffness of entry (1, 0) is NaN;"),
        (f64::INFINITY, "element stiffness of entry (1, 0) is inf;"),
    ] {
        let unit = DMatrix::from_row_slice(2, 2, &[1.0, -1.0, entry, 1.0]);
        let refused = Deformations::of(&element(unit)).unwrap_err();
        assert!(refused.to_string().starts_with(words), "{refused}");
    }
}

/// Less than 1e-14 of the largest entry is what round-off leaves of a rigid motion.
#[test]
fn what_round_off_leaves_is_no_way_to_deform() {
    let found = |smaller: f64| {
        let unit = DMatrix::from_diagonal(&DVector::from_column_slice(&[4.0, 4.0 * smaller]));
        Deformations::of(&element(unit)).unwrap().count()
    };
    assert_eq!([0.9e-14, 1.1e-14].map(found), [1, 2]);
}

/// An element whose DOF are all held has no way to deform.
#[test]
fn an_element_without_dof_has_no_ways() {
    let found = Deformations::of(&element(DMatrix::zeros(0, 0))).unwrap();
    assert_eq!((found.count(), found.matrix().unit.len()), (0, 0));
}
