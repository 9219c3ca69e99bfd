//! (1), the dynamic stiffness of a load distribution.

use super::sA_eq_05_to_08_condensation::stiffness_and_kept;
use crate::prelude::*;

properties! {
    /// T that only selects DOF makes K_D what static condensation makes it: K_aa − K_ab K_bb⁻¹ K_ba.
    #[test]
    fn selecting_dof_is_static_condensation((stiffness, condition, kept) in stiffness_and_kept()) {
        let count = stiffness.nrows();
        let dropped = (0..count).filter(|row| !kept.contains(row)).collect_vec();
        let t = eye(count).select_columns(&kept);
        let part = |rows: &[usize], columns: &[usize]| stiffness.select_rows(rows).select_columns(columns);
        let mut expected = part(&kept, &kept);
        let mut follow = DMatrix::zeros(dropped.len(), kept.len());
        if !dropped.is_empty() {
            follow = -part(&dropped, &dropped).cholesky().unwrap().solve(&part(&dropped, &kept));
            expected += part(&kept, &dropped) * &follow;
        }
        let found = condense(&stiffness, &t)?;
        // Round-off of the flexibility grows once more in its inverse.
        let spread = expected.symmetric_eigenvalues();
        let bar = CONDITIONED_ROUND_OFF * condition * spread.max() / spread.min();
        let distance = relative_distance(&found.stiffness, &expected);
        prop_assert!(distance <= bar, "{distance:e} at condition {condition:e}");
        // The kept DOF follow themselves, the others as the structure makes them.
        prop_assert_eq!(found.transformation.shape(), (count, kept.len()));
        let identity = eye(kept.len());
        prop_assert!(relative_distance(&found.transformation.select_rows(&kept), &identity) <= bar);
        let others = found.transformation.select_rows(&dropped) - follow;
        prop_assert!(dropped.is_empty() || others.amax() <= bar * found.transformation.amax());
    }
}
