//! Entries of elements in the matrices of a whole model: stiffness, and lumped masses.

use super::{Places, SparseMatrix, Support};
use crate::method::appendix_a::ElementMatrix;
use crate::method::elements::unit_stiffness;
use crate::method::error::Error;
use crate::method::structure::{Element, ElementKind, Point, StructuralDof, Structure};
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// The stiffness $\sum_e s_e K_e$ (`count` × `count`) of some elements with their sizes.
///
/// # Errors
/// [`Error::Value`] for an entry beyond the range of numbers.
pub(crate) fn stiffness_of<'a>(
    count: usize,
    elements: impl Iterator<Item = (&'a ElementMatrix, f64)>,
) -> Result<SparseMatrix, Error> {
    sum("stiffness", count, elements, 0.0)
}

/// The sum (`count` × `count`) of elements' stiffness, each times its number; entries no larger than `least` count as nothing.
fn sum<'a>(
    what: &'static str,
    count: usize,
    elements: impl Iterator<Item = (&'a ElementMatrix, f64)>,
    least: f64,
) -> Result<SparseMatrix, Error> {
    let mut all = Vec::new();
    for (ElementMatrix { dof, unit, .. }, scale) in elements {
        let entries = unit.iter().enumerate();
        let entries =
            entries.map(|(at, own)| (dof[at % dof.len()], dof[at / dof.len()], scale * own));
        all.extend(entries.filter(|entry| entry.2.abs() > least));
    }
    SparseMatrix::new(what, count, count, all)
}

/// Volume an element of unit size lumps at each of its corners, in³ per in of gage or in² of area.
///
/// Times density (lbf·s²/in⁴) and size it is the mass that moves with the corner, alike in x, y and z:
///
/// $$ v_{rod} = \frac{L}{2}, \qquad v_{triangle} = \frac{A}{3}, \qquad v_{quadrilateral, i} = \frac{A + A_i}{6} $$
///
/// where $A_i$ is the area of the triangle of corner $i$ and its two neighbors and $A = |d_{13} \times d_{24}|/2$ the
/// quadrilateral's in its mean plane. As in NASTRAN, the four of a warped panel sum to slightly more than $A$. Source:
/// the lumped masses of NASTRAN, NASA SP-222, and for warped quadrilaterals its routine EMADTQ.
pub fn corner_volumes(kind: ElementKind, corners: &[Point]) -> Vec<f64> {
    let count = corners.len();
    let side = |a: usize, b: usize| corners[b % count] - corners[a % count];
    let triangle = |n: usize| 0.5 * side(n, n + 1).cross(&side(n, n + count - 1)).norm();
    match kind {
        ElementKind::Rod => vec![0.5 * side(0, 1).norm(); 2],
        ElementKind::Triangle => vec![triangle(0) / 3.0; 3],
        ElementKind::ShearPanel | ElementKind::Membrane => {
            let area = 0.5 * side(0, 2).cross(&side(1, 3)).norm();
            (0..4)
                .map(|corner| (area + triangle(corner)) / 6.0)
                .collect()
        }
    }
}

/// Lumped mass of an element at every free DOF it touches: row and mass, lbf·s²/in; none for a material without density.
pub fn lumped_masses(
    structure: &Structure,
    element: &Element,
    corners: &[Point],
) -> Vec<(usize, f64)> {
    let density = element.material.density * element.size;
    let volumes = corner_volumes(element.kind, corners)
        .into_iter()
        .zip(&element.grids);
    let at_corner = |(volume, &grid): (f64, &usize)| {
        let rows = (0..3).filter_map(move |direction| structure.free_dof_index(grid, direction));
        rows.map(move |row| (row, density * volume))
    };
    volumes
        .filter(|_| density > 0.0)
        .flat_map(at_corner)
        .collect()
}

/// Entries (row, column, value) of $m t_1 t_2^t$, a mass that couples two motions of the degrees of freedom, or is that of one.
pub(crate) fn moving_mass_entries(
    motion: &[(usize, f64)],
    other: &[(usize, f64)],
    mass: f64,
) -> Vec<(usize, usize, f64)> {
    let pairs = motion
        .iter()
        .flat_map(|a| other.iter().map(move |b| (a, b)));
    pairs.map(|(a, b)| (a.0, b.0, mass * a.1 * b.1)).collect()
}

/// The largest entry of an element's stiffness at unit size, held degrees of freedom included.
pub(crate) fn largest_entry(matrix: &ElementMatrix, element: &Element, corners: &[Point]) -> f64 {
    // Of an element free of supports it is at hand.
    match matrix.dof.len() == 3 * corners.len() {
        true => matrix.unit.amax(),
        false => unit_stiffness(element.kind, corners, &element.material).amax(),
    }
}

/// Each element's stiffness in units of its own largest entry, summed over the structure. Every $K_e$ is semidefinite, so that the null
/// space is that of any $\sum_e s_e K_e$,
///
/// $$ v^t K v = \sum_e s_e v^t K_e v = 0 \quad \text{if and only if} \quad K_e v = 0 \text{ for all } e, $$
///
/// and no element is stiffer than another. The largest entry is that of the element free of supports; entries at the free ones that
/// are only the round-off of its direction are dropped.
///
/// The places of the free degrees of freedom, which make the elements, are as exact as these.
///
/// # Errors
/// The errors of [`SparseMatrix::new`] for entries beyond the range of numbers.
pub fn support(structure: &Structure, elements: &[ElementMatrix]) -> Result<Support, Error> {
    let place_of: BTreeMap<usize, Vector3<f64>> = structure
        .grids()
        .iter()
        .map(|grid| (grid.label, grid.position))
        .collect();
    let row = |dof: &StructuralDof| (place_of[&dof.grid], dof.direction);
    let rows: Vec<_> = structure.free_dof().iter().map(row).collect();
    Ok(Support {
        resisting: Some(resisting(structure, elements)?),
        places: Some(Places::new(&rows, 0.0)),
        count: None,
    })
}

fn resisting<'a>(
    structure: &Structure,
    elements: &'a [ElementMatrix],
) -> Result<SparseMatrix, Error> {
    let whole = structure.elements().iter().zip(structure.corners());
    let part = |(matrix, (element, corners)): (&'a ElementMatrix, (&Element, &Vec<Point>))| {
        let scale = 1.0 / largest_entry(matrix, element, corners);
        (matrix, scale)
    };
    let parts = elements.iter().zip(whole).map(part);
    let (what, count) = ("stiffness of the elements", structure.free_dof().len());
    sum(what, count, parts, 4.0 * f64::EPSILON)
}
