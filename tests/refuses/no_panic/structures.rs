//! Elements, structures and models.

use super::{Entry, Numbers, unseen};
use crate::common::structures::of_dense;
use crate::prelude::*;
use corfem::method::appendix_a;

/// A kind of element and as many corners as it has.
fn element(d: &mut Draws) -> (ElementKind, Vec<Point>) {
    let kind = kind(d);
    (kind, d.corners()[..kind.corner_count()].to_vec())
}

fn kind(d: &mut Draws) -> ElementKind {
    let kinds = [
        ElementKind::Rod,
        ElementKind::Triangle,
        ElementKind::ShearPanel,
        ElementKind::Membrane,
    ];
    kinds[d.below(4)]
}

pub const STRUCTURES: &[Entry] = &[
    // Corners without length or area, and a product of these beyond the largest number, are refused by the structure and the model that
    // they become part of.
    ("elements::rod", |d| {
        unseen(rod(&d.corners()[..2], d.number()))
    }),
    ("elements::triangle", |d| {
        unseen(triangle(&d.corners()[..3], &d.material()))
    }),
    ("elements::membrane", |d| {
        unseen(membrane(&d.corners(), &d.material()))
    }),
    ("elements::shear_panel", |d| {
        unseen(shear_panel(&d.corners(), &d.material()))
    }),
    ("structure::check_corners", |d| {
        let (kind, corners) = (kind(d), d.corners());
        check_corners(1, kind, &corners[..d.below(5)]).map(Numbers::numbers)
    }),
    ("elements::unit_stiffness", |d| {
        let (kind, corners) = element(d);
        unseen(unit_stiffness(kind, &corners, &d.material()))
    }),
    ("elements::corner_volumes", |d| {
        let (kind, corners) = element(d);
        unseen(corner_volumes(kind, &corners))
    }),
    ("elements::lumped_masses", |d| {
        let structure = d.structure()?;
        for (element, corners) in structure.elements().iter().zip(structure.corners()) {
            lumped_masses(&structure, element, corners);
        }
        Ok(Vec::new())
    }),
    ("Material::isotropic", |d| {
        let (modulus, ratio) = (d.number(), d.number());
        Material::isotropic(modulus, ratio).map(|found| vec![found.shear_modulus])
    }),
    ("Bounds::positive", |d| {
        let (lower, upper) = (d.number(), d.number());
        Bounds::positive("range", lower, upper).map(|found| vec![found.lower, found.upper])
    }),
    ("DynamicModel::analyze", |d| {
        let (model, count) = (d.dynamic(), d.size());
        let test = d.modes(model.mass.nrows())?;
        let count = Some(count).filter(|count| *count > 0);
        model
            .analyze(&test, count)
            .map(|found| vec![found.exact().errors.sum()])
    }),
    ("Bounds::holds_start", |d| unseen(d.bounds().holds_start())),
    ("Bounds::contains", |d| {
        unseen(d.bounds().contains(d.number()))
    }),
    ("elements::mean_plane", |d| {
        let corners = d.corners();
        mean_plane(&corners);
        check_corners(1, ElementKind::ShearPanel, &corners)?;
        Ok(mean_plane(&corners).iter().flatten().copied().collect())
    }),
    ("elements::corner_forces", |d| {
        unseen(corner_forces(&d.corners()))
    }),
    ("elements::energy_coefficient", |d| {
        unseen(energy_coefficient(&d.corners(), &d.material()))
    }),
    ("Structure::new", |d| {
        let structure = d.structure()?;
        let grids = structure.grids().to_vec();
        Structure::new(grids, structure.elements().to_vec()).map(|_| Vec::new())
    }),
    ("Structure::free_dof_index", |d| {
        let (structure, grid, direction) = (d.structure()?, d.size(), d.size());
        unseen(structure.free_dof_index(grid, direction))
    }),
    ("appendix_a::element_matrices", |d| {
        unseen(element_matrices(&d.structure()?).collect_vec())
    }),
    ("appendix_a::assemble", |d| {
        let (elements, sizes, free) = d.elements()?;
        assemble(&elements, &sizes, free.len()).map(|_| Vec::new())
    }),
    // Shapes that are no numbers have no stiffness that is one.
    ("appendix_a::generalized_stiffness", |d| {
        let structure = d.structure()?;
        let (count, columns) = (structure.free_dof().len(), d.size());
        let shapes = d.matrix(count, columns);
        for element in element_matrices(&structure) {
            generalized_stiffness(&element, d.number(), &shapes);
        }
        Ok(Vec::new())
    }),
    ("Factor::solve", |d| {
        let (elements, sizes, free) = d.elements()?;
        let (rows, columns) = (d.about(free.len()), d.size());
        let stiffness = assemble(&elements, &sizes, free.len())?;
        of_dense(&stiffness)?
            .solve(&d.matrix(rows, columns))
            .map(Numbers::numbers)
    }),
    ("Factor::new", |d| {
        let size = d.size();
        let matrix = sparse(&d.symmetric(size))?;
        Factor::new("matrix", &matrix).map(|factor| vec![factor.negative_count() as f64])
    }),
    ("appendix_a::condense", |d| {
        let (elements, sizes, free) = d.elements()?;
        let structural = assemble(&elements, &sizes, free.len())?;
        let load_distribution = d.load_distribution(free.len());
        let found = appendix_a::condense(&structural, &load_distribution)?;
        Ok([found.stiffness, found.transformation]
            .map(Numbers::numbers)
            .concat())
    }),
    ("appendix_a::dynamic_mass", |d| {
        let size = d.size();
        dynamic_mass(&d.symmetric(size), d.modes(size)?.shapes()).map(Numbers::numbers)
    }),
    ("FiniteElementModel::new", |d| {
        let structure = d.structure()?;
        let load_distribution = d.load_distribution(structure.free_dof().len());
        let mass = d.symmetric(load_distribution.ncols());
        FiniteElementModel::new(structure, load_distribution, mass, d.parameters())
            .map(|_| Vec::new())
    }),
    ("elements::support", |d| {
        let structure = d.structure()?;
        let elements = element_matrices(&structure).collect_vec();
        let found = support(&structure, &elements)?;
        let entries = found.resisting.iter().flat_map(|matrix| matrix.entries());
        Ok(entries.map(|entry| entry.2).collect())
    }),
    ("FiniteElementModel::factor_ranges", |d| {
        let ranges = d.finite_element()?.0.factor_ranges()?.into_iter();
        Ok(ranges
            .flatten()
            .flat_map(|own| [own.lower, own.upper])
            .collect())
    }),
    ("FiniteElementModel::sizes", |d| {
        let (model, factors) = d.finite_element()?;
        model.sizes(&factors)
    }),
    ("FiniteElementModel::condense", |d| {
        let (model, factors) = d.finite_element()?;
        let found = model.condense(&factors)?;
        Ok([found.stiffness, found.transformation]
            .map(Numbers::numbers)
            .concat())
    }),
    ("FiniteElementModel::analyze", |d| {
        let (model, factors) = d.finite_element()?;
        let test = d.modes(model.mass().nrows())?;
        let test = model.modes(&factors).unwrap_or(test);
        model
            .analyze(&factors, &test, None)
            .map(|found| vec![found.exact().errors.sum()])
    }),
    ("FiniteElementModel::matrices", |d| {
        let (model, factors) = d.finite_element()?;
        let found = model.matrices(&factors)?;
        let all = [found.shares, vec![found.mass]].concat().into_iter();
        Ok(all.flat_map(Numbers::numbers).collect())
    }),
    ("FiniteElementModel::modes", |d| {
        let (model, factors) = d.finite_element()?;
        model.modes(&factors).map(Numbers::numbers)
    }),
];
