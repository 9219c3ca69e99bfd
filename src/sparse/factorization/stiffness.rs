//! The structural stiffness, factorized anew for every set of sizes.

use super::{Factor, FactorizationPlan};
use crate::method::appendix_a::ElementMatrix;
use crate::method::error::{Error, at_least_one, check_places, positive};
use crate::method::linear_algebra::{check_length, round_off};
use crate::method::structure::{DIRECTIONS, StructuralDof, Structure};
use crate::sparse::Deformations;
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
    /// [`Error::WrongShape`] for a wrong number of sizes; [`Error::Value`] naming the element of a bad size;
    /// [`Error::Count`] without free DOF; [`Error::SingularStiffness`] naming the grid and direction that nothing
    /// constrains, when the smallest eigenvalue of the unit-diagonal stiffness is within round-off of zero;
    /// [`Error::NotPositiveDefinite`] for element matrices that are not semidefinite; [`Error::Failed`] when the
    /// factor does not solve its own matrix.
    ///
    /// # Example
    ///
    /// ```rust
    /// use corfem::chain::rods;
    /// use corfem::method::appendix_a::element_matrices;
    /// use corfem::method::error::Error;
    /// use corfem::sparse::factorization::Factor;
    ///
    /// // Held nowhere, the chain can move along x.
    /// let free = rods(&[100.0, 50.0], [false, false])?;
    /// let elements: Vec<_> = element_matrices(&free).collect();
    /// let found = Factor::of_stiffness(&elements, &[100.0, 50.0], free.free_dof());
    /// assert!(matches!(found, Err(Error::SingularStiffness { direction: 'x', .. })));
    /// # Ok::<(), corfem::method::error::Error>(())
    /// ```
    pub fn of_stiffness(
        elements: &[ElementMatrix],
        sizes: &[f64],
        free: &[StructuralDof],
    ) -> Result<Self, Error> {
        let elements = elements.iter().map(Deformations::of);
        let elements = elements.collect::<Result<_, Error>>()?;
        let nowhere = vec![Vector3::zeros(); free.len()];
        StructuralStiffness::at(free, &nowhere, elements)?.factorized(sizes)
    }
}

/// The structural stiffness $K_S = \sum_e s_e K_e$ of elements, planned once and factorized at any sizes.
#[derive(Debug)]
pub struct StructuralStiffness {
    elements: Vec<Deformations>,
    free: Vec<StructuralDof>,
    plan: Arc<FactorizationPlan>,
    /// Place among the plan's entries of every entry of every element's lower triangle.
    places: Vec<u32>,
}

impl StructuralStiffness {
    /// The stiffness of these elements at the free DOF of a structure, with a plan by nested dissection of its grids' positions.
    ///
    /// # Errors
    /// [`Error::Count`] without free DOF; [`Error::Count`] for elements beyond them, or more entries than are counted here;
    /// [`Error::Failed`] when there is no memory for a plan.
    pub fn new(structure: &Structure, elements: Vec<Deformations>) -> Result<Self, Error> {
        let position = |dof: &StructuralDof| structure.position(dof.grid).unwrap_or_default();
        let free = structure.free_dof();
        Self::at(
            free,
            &free.iter().map(position).collect::<Vec<_>>(),
            elements,
        )
    }

    fn at(
        free: &[StructuralDof],
        position: &[Vector3<f64>],
        elements: Vec<Deformations>,
    ) -> Result<Self, Error> {
        at_least_one("free degrees of freedom", free.len())?;
        elements.iter().try_for_each(|element| {
            check_places("degrees of freedom", element.dof(), free.len())
        })?;
        let plan =
            FactorizationPlan::of_elements(elements.iter().map(Deformations::dof), position)?;
        let mut places = Vec::new();
        for element in &elements {
            let turns: Vec<usize> = element.dof().iter().map(|&dof| plan.turn[dof]).collect();
            for (column, &other) in turns.iter().enumerate() {
                let place = |&turn: &usize| {
                    plan.place(turn.max(other), turn.min(other))
                        .map(|place| place as u32)
                };
                places.extend(turns[column..].iter().filter_map(place));
            }
        }
        places.shrink_to_fit();
        Ok(Self {
            elements,
            free: free.to_vec(),
            plan: Arc::new(plan),
            places,
        })
    }

    /// The elements by their ways to deform.
    pub fn elements(&self) -> &[Deformations] {
        &self.elements
    }

    /// The free DOF in the order in which they are eliminated.
    pub fn order(&self) -> &[usize] {
        &self.plan.order
    }

    /// Assembles and factorizes the stiffness, which must leave nothing free to move. `sizes` are gages (in) and areas (in²), one per
    /// element.
    ///
    /// # Errors
    /// The errors of [`Factor::of_stiffness`] for the sizes and for the stiffness that they make.
    pub fn factorized(&self, sizes: &[f64]) -> Result<Factor, Error> {
        let (what, plan, count) = ("structural stiffness", &self.plan, self.free.len());
        for (element, &size) in self.elements.iter().zip(sizes) {
            positive("size", || format!("element {}", element.label()), size)?;
        }
        check_length("element sizes", sizes.len(), self.elements.len())?;
        let mut entries = self.assembled(sizes);
        let singular = |dof: usize| {
            let StructuralDof { grid, direction } = self.free[dof];
            Err(Error::SingularStiffness {
                grid,
                direction: *DIRECTIONS.get(direction).unwrap_or(&'?'),
            })
        };
        let diagonal = plan.diagonal();
        if let Some(dof) = (0..count).find(|&dof| entries[diagonal[plan.turn[dof]]] <= 0.0) {
            return singular(dof);
        }
        let scale = plan.scale(&mut entries, |entry| entry);
        let found = Factor::of_entries(plan, what, &entries, scale.clone());
        if let Ok(factor) = found
            && factor.is_proved_above(round_off(count), what, &entries)?
        {
            return Ok(factor);
        }
        // Shifted a little, a singular stiffness has its free motion as the weakest.
        diagonal
            .iter()
            .for_each(|&place| entries[place] += SINGULAR_SHIFT);
        let factor = Factor::of_entries(plan, what, &entries, scale)?.check_signs(what)?;
        let (_, motion) = factor.weakest_motion(factor.first_motion(), f64::INFINITY);
        let moved = |dof: usize| (motion[plan.turn[dof]] * factor.scale[plan.turn[dof]]).abs();
        // Ties go to the first.
        let most = (0..count)
            .rev()
            .max_by(|&a, &b| moved(a).total_cmp(&moved(b)));
        singular(most.unwrap_or(0))
    }

    /// The lower triangle's entries of $\sum_e s_e K_e$ in the order of elimination.
    fn assembled(&self, sizes: &[f64]) -> Vec<f64> {
        let mut entries = vec![0.0; self.plan.entry_count()];
        let (mut places, mut triangle) = (self.places.iter(), Vec::new());
        for (element, &size) in self.elements.iter().zip(sizes) {
            element.triangle(size, &mut triangle);
            let placed = triangle.iter().zip(places.by_ref());
            placed.for_each(|(entry, &place)| entries[place as usize] += entry);
        }
        entries
    }
}
