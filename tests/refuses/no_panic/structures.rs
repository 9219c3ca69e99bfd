//! Elements, structures and models.

use super::{Entry, entries, modes};
use crate::common::draws::Draws;
use crate::common::whole_models::sparse;
use corfem::method::appendix_a;
use corfem::method::assembly::{ElementMatrix, dense_stiffness, element_matrices, lumped_mass};
use corfem::method::elements::membrane::triangle;
use corfem::method::elements::shear::{corner_forces, energy_coefficient, gauss_legendre};
use corfem::method::elements::{corner_volumes, membrane, rod, shear, unit_stiffness};
use corfem::method::error::Error;
use corfem::method::geometry::{Geometry, mean_plane};
use corfem::method::model::{Bounds, FiniteElementModel, ScaledStructure};
use corfem::method::structure::{ElementKind, Material, Structure};

use corfem::sparse::factorization::{Factor, StructuralStiffness};
use corfem::sparse::{Deformations, LargeModel};

fn deformations(elements: &[ElementMatrix]) -> Result<Vec<Deformations>, Error> {
    elements.iter().map(Deformations::of).collect()
}

pub const STRUCTURES: &[Entry] = &[
    // A product of these beyond the largest number is refused by the model that they become part of.
    ("elements::rod", |d| {
        let [a, b, ..] = d.corners();
        rod([a, b], d.number());
        Ok(Vec::new())
    }),
    ("membrane::triangle", |d| {
        let ([a, b, c, _], material) = (d.corners(), d.material());
        triangle([a, b, c], &material);
        Ok(Vec::new())
    }),
    ("membrane::membrane", |d| {
        let (corners, material) = (d.corners(), d.material());
        mean_plane(&corners).map(|panel| membrane::membrane(&panel, &material))?;
        Ok(Vec::new())
    }),
    ("shear::shear_panel", |d| {
        let (corners, material) = (d.corners(), d.material());
        mean_plane(&corners).map(|panel| shear::shear_panel(&panel, &material))?;
        Ok(Vec::new())
    }),
    ("Geometry::new", |d| {
        let kinds = [
            ElementKind::Rod,
            ElementKind::Triangle,
            ElementKind::ShearPanel,
            ElementKind::Membrane,
        ];
        let (kind, corners) = (kinds[d.below(4)], d.corners());
        Geometry::new(kind, &corners[..d.below(5)]).map(|_| Vec::new())
    }),
    ("elements::unit_stiffness", |d| {
        let panel = Geometry::new(ElementKind::ShearPanel, &d.corners())?;
        unit_stiffness(&panel, &d.material());
        Ok(Vec::new())
    }),
    ("elements::corner_volumes", |d| {
        corner_volumes(&Geometry::new(ElementKind::Membrane, &d.corners())?);
        Ok(Vec::new())
    }),
    ("MeanPlane::diagonals", |d| {
        let diagonals = mean_plane(&d.corners())?.diagonals();
        Ok(diagonals.iter().flatten().copied().collect())
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
    ("Bounds::contains", |d| {
        Bounds {
            lower: d.number(),
            upper: d.number(),
        }
        .contains(d.number());
        Ok(Vec::new())
    }),
    ("geometry::mean_plane", |d| {
        let plane = mean_plane(&d.corners())?;
        Ok(plane
            .corners()
            .iter()
            .flatten()
            .chain(plane.diagonals().iter().flatten())
            .copied()
            .chain([plane.area()])
            .collect())
    }),
    ("shear::corner_forces", |d| {
        mean_plane(&d.corners())
            .map(|plane| corner_forces(&plane))
            .map(|_| Vec::new())
    }),
    ("shear::energy_coefficient", |d| {
        let (corners, material) = (d.corners(), d.material());
        mean_plane(&corners)
            .map(|plane| energy_coefficient(&plane, &material))
            .map(|_| Vec::new())
    }),
    ("shear::gauss_legendre", |d| {
        Ok(gauss_legendre(d.below(40))
            .into_iter()
            .flat_map(|(point, weight)| [point, weight])
            .collect())
    }),
    ("Material::with_density", |d| {
        let material = d.material();
        material
            .with_density(d.number())
            .map(|found| vec![found.density])
    }),
    ("Structure::new", |d| {
        let structure = d.structure()?;
        let grids = structure.grids().to_vec();
        Structure::new(grids, structure.elements().to_vec()).map(|_| Vec::new())
    }),
    ("Structure::free_dof_index", |d| {
        let (structure, grid, direction) = (d.structure()?, d.size(), d.size());
        structure.free_dof_index(grid, direction);
        Ok(Vec::new())
    }),
    // A weight that is no number is refused by the model that T becomes part of.
    ("Structure::load_distribution", |d| {
        let (structure, count) = (d.structure()?, d.size());
        let row = |d: &mut Draws| (d.size(), ['x', 'y', 'z', 'w'][d.below(4)], d.number());
        let points: Vec<_> = (0..count).map(|_| vec![row(d), row(d)]).collect();
        structure.load_distribution(&points).map(|_| Vec::new())
    }),
    ("Structure::corners", |d| {
        let (structure, other) = (d.structure()?, d.structure()?);
        let found = other
            .elements()
            .iter()
            .flat_map(|element| structure.corners(element));
        Ok(found
            .flat_map(|corner| [corner.x, corner.y, corner.z])
            .collect())
    }),
    ("assembly::element_matrices", |d| {
        element_matrices(&d.structure()?);
        Ok(Vec::new())
    }),
    ("assembly::dense_stiffness", |d| {
        let (elements, sizes, free) = d.elements()?;
        dense_stiffness(&elements, &sizes, free.len()).map(|_| Vec::new())
    }),
    ("assembly::lumped_mass", |d| {
        let (elements, sizes, free) = d.elements()?;
        lumped_mass(&elements, &sizes, free.len()).map(|_| Vec::new())
    }),
    ("Factor::of_stiffness", |d| {
        let (elements, sizes, free) = d.elements()?;
        Factor::of_stiffness(&elements, &sizes, &free).map(|_| Vec::new())
    }),
    ("Factor::solve", |d| {
        let (elements, sizes, free) = d.elements()?;
        let (rows, columns) = (d.about(free.len()), d.size());
        Factor::of_stiffness(&elements, &sizes, &free)?
            .solve(&d.matrix(rows, columns))
            .map(|found| entries(&found))
    }),
    ("Deformations::of", |d| {
        let (elements, ..) = d.elements()?;
        elements
            .iter()
            .try_for_each(|element| Deformations::of(element).map(drop))?;
        Ok(Vec::new())
    }),
    ("Deformations::count", |d| {
        let (elements, ..) = d.elements()?;
        let found = deformations(&elements)?;
        Ok(found.iter().map(|element| element.count() as f64).collect())
    }),
    ("Deformations::matrix", |d| {
        let (elements, ..) = d.elements()?;
        let found = deformations(&elements)?;
        Ok(found
            .iter()
            .flat_map(|element| entries(&element.matrix().unit))
            .collect())
    }),
    ("StructuralStiffness::new", |d| {
        let structure = d.structure()?;
        let (elements, ..) = d.elements()?;
        StructuralStiffness::new(&structure, deformations(&elements)?).map(|_| Vec::new())
    }),
    ("StructuralStiffness::order", |d| {
        let structure = d.structure()?;
        let elements = deformations(&element_matrices(&structure))?;
        let stiffness = StructuralStiffness::new(&structure, elements)?;
        Ok(stiffness.order().iter().map(|&dof| dof as f64).collect())
    }),
    ("StructuralStiffness::factorized", |d| {
        let structure = d.structure()?;
        let elements = deformations(&element_matrices(&structure))?;
        let (_, sizes, _) = d.elements()?;
        let stiffness = StructuralStiffness::new(&structure, elements)?;
        stiffness.factorized(&sizes).map(|_| Vec::new())
    }),
    ("Factor::flexibility", |d| {
        let (elements, sizes, free) = d.elements()?;
        let loads = sparse(&d.load_distribution(free.len()))?;
        Factor::of_stiffness(&elements, &sizes, &free)?
            .flexibility(&loads)
            .map(|found| entries(&found))
    }),
    ("Factor::new", |d| {
        let size = d.size();
        let matrix = sparse(&d.symmetric(size))?;
        Factor::new("matrix", &matrix).map(|factor| vec![factor.negative_count() as f64])
    }),
    ("Factor::check_positive", |d| {
        let size = d.size();
        let factor = Factor::new("matrix", &sparse(&d.symmetric(size))?)?;
        factor.check_positive("matrix").map(|_| Vec::new())
    }),
    ("appendix_a::condense", |d| {
        let (elements, sizes, free) = d.elements()?;
        let structural = dense_stiffness(&elements, &sizes, free.len())?;
        let load_distribution = d.load_distribution(free.len());
        let found = appendix_a::condense(&structural, &load_distribution)?;
        Ok([entries(&found.stiffness), entries(&found.transformation)].concat())
    }),
    ("ScaledStructure::new", |d| {
        let (structure, size) = (d.structure()?, d.size());
        let mass = d.symmetric(size);
        ScaledStructure::new(structure, mass, d.parameters()).map(|_| Vec::new())
    }),
    ("FiniteElementModel::new", |d| {
        let structure = d.structure()?;
        let load_distribution = d.load_distribution(structure.free_dof().len());
        let mass = d.symmetric(load_distribution.ncols());
        FiniteElementModel::new(structure, load_distribution, mass, d.parameters())
            .map(|_| Vec::new())
    }),
    ("LargeModel::new", |d| {
        let structure = d.structure()?;
        let loads = sparse(&d.load_distribution(structure.free_dof().len()))?;
        let mass = d.symmetric(loads.columns());
        LargeModel::new(structure, loads, mass, d.parameters()).map(|_| Vec::new())
    }),
    ("LargeModel::elements", |d| {
        let (model, _) = d.finite_element()?;
        let model = LargeModel::of(&model)?;
        Ok(vec![model.elements().len() as f64])
    }),
    ("LargeCondensation::structural_shapes", |d| {
        let (model, factors) = d.finite_element()?;
        let (rows, columns) = (d.about(model.mass().nrows()), d.size());
        LargeModel::of(&model)?
            .condense(&factors)?
            .structural_shapes(&d.matrix(rows, columns))
            .map(|found| entries(&found))
    }),
    ("FiniteElementModel::with_unit_stiffness", |d| {
        let (model, factors) = d.finite_element()?;
        let count = d.about(model.element_matrices().len());
        let size = |row: usize| {
            model
                .element_matrices()
                .get(row)
                .map_or(2, |element| element.dof.len())
        };
        let units = (0..count).map(|row| d.symmetric(size(row))).collect();
        model
            .with_unit_stiffness(units)?
            .condense(&factors)
            .map(|found| entries(&found.stiffness))
    }),
    ("ScaledStructure::factor_ranges", |d| {
        let (model, factors) = d.finite_element()?;
        let ranges = model
            .factor_ranges()
            .map(|ranges| ranges.into_iter().flatten().collect::<Vec<_>>())?;
        Ok(ranges
            .iter()
            .flat_map(|range| [range.lower, range.upper])
            .chain(factors)
            .take(2 * ranges.len())
            .collect())
    }),
    ("ScaledStructure::at", |d| {
        let (model, factors) = d.finite_element()?;
        let at = model.at(&factors)?;
        Ok([at.sizes, at.mass_sizes, entries(&at.point_masses)].concat())
    }),
    ("FiniteElementModel::condense", |d| {
        let (model, factors) = d.finite_element()?;
        let found = model.condense(&factors)?;
        let shapes = found.transformation;
        Ok([
            entries(&found.stiffness),
            entries(&found.mass),
            entries(&shapes),
        ]
        .concat())
    }),
    ("FiniteElementModel::analyze", |d| {
        let (model, factors) = d.finite_element()?;
        let test = d.modes(model.mass().nrows())?;
        let test = model.modes(&factors).map_or(test, |found| found.into());
        model
            .analyze(&factors, &test, None)
            .map(|found| vec![found.exact().errors.sum()])
    }),
    ("FiniteElementModel::matrices", |d| {
        let (model, factors) = d.finite_element()?;
        let found = model.matrices(&factors)?;
        Ok(found
            .shares
            .iter()
            .flat_map(|share| entries(share.matrix()))
            .chain(entries(&found.mass))
            .collect())
    }),
    ("FiniteElementModel::modes", |d| {
        let (model, factors) = d.finite_element()?;
        model.modes(&factors).map(|found| modes(&found))
    }),
];
