//! The structural stiffness, factorized anew for every set of sizes.

use super::{Factor, FactorizationPlan};
use crate::method::assembly::{ElementMatrix, check_elements};
use crate::method::error::Error;
use crate::method::linear_algebra::{check_length, round_off};
use crate::method::structure::{DIRECTIONS, StructuralDof, positive};
use nalgebra::Vector3;
use std::sync::Arc;

/// Shift of the unit-diagonal stiffness that makes a singular one factorizable to find its free motion.
const SINGULAR_SHIFT: f64 = 1e-10;

impl Factor {
    /// Assembles and factorizes the structural stiffness $K_S = \sum_e s_e K_e$, which must leave nothing free to move.
    ///
    /// `sizes` are gages (in) and areas (in²), one per element; `free` the free DOF of the structure.
    ///
    /// # Errors
    /// [`Error::WrongShape`] for a wrong number of sizes; [`Error::NotPositive`] naming the element of a bad size;
    /// [`Error::Empty`] without free DOF; [`Error::SingularStiffness`] naming the grid and direction that nothing
    /// constrains, when the smallest eigenvalue of the unit-diagonal stiffness is within round-off of zero;
    /// [`Error::NotPositiveDefinite`] for element matrices that are not semidefinite; [`Error::WrongSolution`] when the
    /// factor does not solve its own matrix.
    ///
    /// # Example
    ///
    /// ```rust
    /// use corfem::chain::rods;
    /// use corfem::method::assembly::element_matrices;
    /// use corfem::method::error::Error;
    /// use corfem::sparse::factorization::Factor;
    ///
    /// // Held nowhere, the chain can move along x.
    /// let free = rods(&[100.0, 50.0], [false, false])?;
    /// let found = Factor::of_stiffness(&element_matrices(&free), &[100.0, 50.0], free.free_dof());
    /// assert!(matches!(found, Err(Error::SingularStiffness { direction: 'x', .. })));
    /// # Ok::<(), corfem::method::error::Error>(())
    /// ```
    pub fn of_stiffness(
        elements: &[ElementMatrix],
        sizes: &[f64],
        free: &[StructuralDof],
    ) -> Result<Self, Error> {
        let plan = FactorizationPlan::of(elements, free, |_| Vector3::zeros())?;
        Self::of_planned_stiffness(&Arc::new(plan), elements, sizes, free)
    }

    /// The same by a plan that was made for these elements.
    ///
    /// # Errors
    /// Those of [`Self::of_stiffness`]; [`Error::WrongShape`] for a plan of other elements.
    pub fn of_planned_stiffness(
        plan: &Arc<FactorizationPlan>,
        elements: &[ElementMatrix],
        sizes: &[f64],
        free: &[StructuralDof],
    ) -> Result<Self, Error> {
        let (what, count) = ("structural stiffness", free.len());
        for (element, &size) in elements.iter().zip(sizes) {
            positive("size", || format!("element {}", element.label), size)?;
        }
        check_elements(elements, sizes, count)?;
        check_length("degrees of freedom of the plan", plan.order.len(), count)?;
        if !plan.is_of(elements) {
            check_length("elements of the plan", 0, elements.len())?;
        }
        let mut entries = plan.assembled(elements, sizes);
        let singular = |dof: usize, ratio| {
            let StructuralDof { grid, direction } = free[dof];
            Err(Error::SingularStiffness {
                grid,
                direction: *DIRECTIONS.get(direction).unwrap_or(&'?'),
                ratio,
            })
        };
        let diagonal = plan.diagonal();
        if let Some(dof) = (0..count).find(|&dof| entries[diagonal[plan.turn[dof]]] <= 0.0) {
            return singular(dof, 0.0);
        }
        let scale = plan.scale(&mut entries, |entry| entry);
        let found = Factor::of_entries(plan, what, &entries, scale.clone());
        if let Ok(factor) = found
            && factor.is_above(round_off(count))
        {
            factor.check(what, &entries)?;
            return Ok(factor);
        }
        // Shifted a little, a singular stiffness has the motion that is free as its weakest.
        diagonal
            .iter()
            .for_each(|&place| entries[place] += SINGULAR_SHIFT);
        let factor = Factor::of_entries(plan, what, &entries, scale)?.check_signs(what)?;
        let (smallest, motion) = factor.weakest_motion(f64::INFINITY);
        let moved = |dof: usize| (motion[plan.turn[dof]] * factor.scale[plan.turn[dof]]).abs();
        // Ties go to the first.
        let most = (0..count)
            .rev()
            .max_by(|&a, &b| moved(a).total_cmp(&moved(b)));
        singular(most.unwrap_or(0), smallest - SINGULAR_SHIFT)
    }
}
