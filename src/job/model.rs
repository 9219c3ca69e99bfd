//! The model that a job names, as matrices at all degrees of freedom, and the positions of these.

use super::{Job, ParameterRule, Scales};
use crate::{
    files::{
        deck::{self, Deck, Membership},
        error::{FileError, ensure},
        matrices::Label,
        test_data::DIRECTIONS,
    },
    method::{
        appendix_a::{ElementMatrix, element_matrices},
        error::Error,
        structure::{StructuralDof, Structure},
    },
    sparse::{
        SparseMatrix, Support, WholeModel, WholeParameter, WholeShare,
        elements::{lumped_masses, moving_mass_entries, stiffness_of, support},
    },
};
use nalgebra::Vector3;
use std::{
    collections::{BTreeMap, BTreeSet},
    path::Path,
};

/// Positions of a model's grids, and the grids that elements join.
#[derive(Debug, Clone, PartialEq)]
pub struct GridLayout {
    /// The place of every grid that has one, in units of length.
    pub places: BTreeMap<usize, Vector3<f64>>,
    /// The corners of every element, by grid.
    pub elements: Vec<Vec<usize>>,
}

/// Elements and point masses of a deck that a parameter scales, by label, ascending.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Members {
    /// Its elements.
    pub elements: Vec<usize>,
    /// Its point masses.
    pub masses: Vec<usize>,
}

/// A model and its degrees of freedom.
#[derive(Debug, Clone)]
pub struct ModelSource {
    /// Matrices of the model.
    pub whole: WholeModel,
    /// Matrices of all of it, parts that no sensor sees among them.
    pub all: WholeModel,
    /// Labels of the rows of a model of matrices.
    pub labels: Vec<Label>,
    /// Names of its stiffness and mass where they came as DMIG.
    pub dmig: [Option<String>; 2],
    /// Grids of the model.
    pub geometry: GridLayout,
    /// Rows of the model and their coefficients for every degree of freedom that moves, rotations (directions 3 to 5) among them.
    pub motions: Motions,
    /// The deck's bytes and the deck read from them, if the model is one.
    pub deck: Option<(Vec<u8>, Deck)>,
    /// Elements and masses of a deck that every parameter scales.
    pub members: Vec<Members>,
    /// Standard deviation of the logarithm of every parameter's factor before the test.
    pub priors: Vec<f64>,
    /// Mass that moves along x, y and z.
    pub mass: Vector3<f64>,
    /// Center of the mass, if all of it has a place.
    pub mass_center: Option<Vector3<f64>>,
    /// Names of the rows left out, in parts of the model that no sensor sees.
    pub left_out: Vec<String>,
    /// Names of those of them that nothing resists.
    pub loose: Vec<String>,
}

/// A parameter by its name, with the first sizes of its elements.
pub struct Part {
    pub name: String,
    pub share: WholeShare,
    pub members: Members,
    pub sizes: Vec<f64>,
}

/// Rows of a model and their coefficients for every degree of freedom that moves.
pub type Motions = BTreeMap<StructuralDof, Vec<(usize, f64)>>;

impl ModelSource {
    /// The model of a stiffness and a mass with parameters by the job's rules.
    pub(super) fn new(
        job: &Job,
        (stiffness, mass, support): (SparseMatrix, SparseMatrix, Support),
        parts: Vec<(&ParameterRule, Part)>,
        (geometry, motions): (GridLayout, Motions),
        deck: Option<(Vec<u8>, Deck)>,
    ) -> Result<Self, FileError> {
        let (mut parameters, mut members, mut priors) = (Vec::new(), Vec::new(), Vec::new());
        for (rule, own) in parts {
            parameters.push(WholeParameter {
                range: rule.range(job, &own.sizes)?,
                name: own.name,
                share: own.share,
            });
            members.push(own.members);
            priors.push(rule.prior(job)?);
        }
        let count = job.model.rigid_bodies;
        let support = Support { count, ..support };
        let whole = WholeModel::supported(stiffness, mass, parameters, support)?;
        let mut source = Self {
            all: whole.clone(),
            whole,
            labels: Vec::new(),
            dmig: Default::default(),
            geometry,
            motions,
            members,
            priors,
            deck,
            mass: Vector3::zeros(),
            mass_center: None,
            left_out: Vec::new(),
            loose: Vec::new(),
        };
        (source.mass, source.mass_center) = source.mass_and_center()?;
        Ok(source)
    }

    /// Name of a row of the matrices: the grid and direction that it moves.
    pub(super) fn row_name(&self, row: usize) -> String {
        let is_row = |&(other, coefficient): &(usize, f64)| other == row && coefficient != 0.0;
        let mut motions = self.motions.iter();
        motions
            .find(|(_, rows)| rows.iter().any(is_row))
            .map_or_else(
                || format!("row {}", row + 1),
                |(dof, _)| format!("{} {}", dof.grid, DIRECTIONS[dof.direction]),
            )
    }

    /// The model without the parts in which no sensor reads a row, and the sensors on it: to them these parts do not exist.
    pub(super) fn watched(
        &self,
        sensors: &SparseMatrix,
    ) -> Result<Option<(Self, SparseMatrix)>, FileError> {
        let (rows, all) = (self.whole.rows_with_sensor(sensors), self.whole.dof_count());
        if rows.len() == all {
            return Ok(None);
        }
        let at = |row: usize| rows.binary_search(&row).ok();
        let motion = |(dof, own): (&StructuralDof, &Vec<(usize, f64)>)| {
            let own: Vec<_> = own
                .iter()
                .filter_map(|own| Some((at(own.0)?, own.1)))
                .collect();
            (!own.is_empty()).then_some((*dof, own))
        };
        let left = (0..all).filter(|&row| at(row).is_none());
        let (stiffness, _) = self.whole.at(&vec![1.0; self.whole.parameters().len()])?;
        let stiff: BTreeSet<usize> = stiffness
            .entries()
            .filter(|entry| entry.2 != 0.0)
            .map(|entry| entry.0)
            .collect();
        let watched = Self {
            whole: self.whole.at_rows(&rows)?,
            motions: self.motions.iter().filter_map(motion).collect(),
            left_out: left.clone().map(|row| self.row_name(row)).collect(),
            loose: left
                .clone()
                .filter(|row| !stiff.contains(row))
                .map(|row| self.row_name(row))
                .collect(),
            ..self.clone()
        };
        Ok(Some((watched, sensors.at_columns(&rows)?)))
    }

    /// Mass that moves along x, y and z, and its center, if all of it has a place.
    ///
    /// In a model given by matrices, a row counts with its part of the momentum $M r$ of all rows of its direction at unit speed.
    fn mass_and_center(&self) -> Result<(Vector3<f64>, Option<Vector3<f64>>), FileError> {
        let placed: Vec<(Option<Vector3<f64>>, Vector3<f64>)> = match &self.deck {
            Some((_, deck)) => deck
                .model
                .placed_masses()?
                .into_iter()
                .map(|(place, mass)| (Some(place), mass))
                .collect(),
            None => {
                let dof: BTreeMap<usize, &StructuralDof> = self
                    .motions
                    .iter()
                    .map(|(dof, rows)| (rows[0].0, dof))
                    .collect();
                let (_, mass) = self.whole.at(&vec![1.0; self.whole.parameters().len()])?;
                let of_entry = |(row, column, value): (usize, usize, f64)| {
                    let StructuralDof { grid, direction } = *dof.get(&row)?;
                    let is_along = *direction < 3 && dof[&column].direction == *direction;
                    let place = self.geometry.places.get(grid).copied();
                    is_along.then(|| (place, Vector3::ith(*direction, value)))
                };
                mass.entries().filter_map(of_entry).collect()
            }
        };
        let total: Vector3<f64> = placed.iter().map(|own| own.1).sum();
        let moments: Option<Vector3<f64>> =
            placed.iter().map(|own| Some(own.0? * own.1.sum())).sum();
        let farthest = placed
            .iter()
            .flat_map(|own| own.0)
            .fold(0.0_f64, |most, place| most.max(place.amax()));
        // What is left of sums that cancel is no distance.
        let told = |own: f64| own * f64::from(own.abs() >= 1e-9 * farthest);
        Ok((
            total,
            moments
                .filter(|_| total.sum() > 0.0)
                .map(|own| (own / total.sum()).map(told)),
        ))
    }
}

/// The model of the deck in this file.
pub fn from_deck(job: &Job, file: &Path) -> Result<ModelSource, FileError> {
    let bytes = job.bytes(file, "model.deck")?;
    let deck = deck::read(&file.display().to_string(), &bytes, &job.model.ignore)?;
    let bulk = &deck.model;
    let structure = bulk.structure()?;
    let elements: Vec<_> = element_matrices(&structure).collect();
    let count = structure.free_dof().len();
    let stiffness = stiffness_of(
        count,
        (0..elements.len()).map(|row: usize| (&elements[row], bulk.elements[row].size)),
    )?;
    let mass = bulk
        .moving_masses(&structure)?
        .iter()
        .flat_map(|point| moving_mass_entries(&point.motion, &point.motion, point.mass))
        .collect();
    let motions: Motions = bulk.all_motions(&structure).collect();
    let geometry = GridLayout {
        places: bulk
            .grids
            .iter()
            .map(|own| (own.label, own.position))
            .collect(),
        elements: bulk.elements.iter().map(|own| own.grids.clone()).collect(),
    };
    ModelSource::new(
        job,
        (
            stiffness,
            SparseMatrix::new("matrix of elements", count, count, mass)?,
            support(&structure, &elements)?,
        ),
        deck_parts(job, &deck, (&structure, &elements))?,
        (geometry, motions),
        Some((bytes, deck)),
    )
}

/// Parameters of a deck by the job's rules.
fn deck_parts<'a>(
    job: &'a Job,
    deck: &Deck,
    (structure, elements): (&Structure, &[ElementMatrix]),
) -> Result<Vec<(&'a ParameterRule, Part)>, FileError> {
    let (bulk, count) = (&deck.model, structure.free_dof().len());
    let row_of = elements.iter().enumerate().map(|(row, e)| (e.label, row));
    let row_of: BTreeMap<usize, usize> = row_of.collect();
    let (mut parts, mut owner) = (Vec::new(), BTreeMap::new());
    for rule in &job.parameters {
        for (name, members) in groups(job, rule, deck)? {
            let (labels, masses) = (&members.elements, &members.masses);
            let refused = |what| job.refused(format!("parameter \"{name}\": {what}"));
            for &label in labels {
                ensure(row_of.contains_key(&label), || {
                    refused(format!("the deck has no element {label}"))
                })?;
                let own = (rule.scales == Scales::Mass, label);
                if let Some(first) = owner.insert(own, name.clone()) {
                    return Err(Error::Duplicate {
                        owner: format!("parameters {first} and {name}"),
                        what: "element",
                        label,
                    }
                    .into());
                }
            }
            for label in masses {
                ensure(rule.scales == Scales::Mass, || {
                    refused(format!("point mass {label} needs scales = \"mass\""))
                })?;
                ensure(bulk.masses.iter().any(|own| own.label == *label), || {
                    refused(format!("the deck has no point mass {label}"))
                })?;
            }
            let rows: Vec<usize> = labels.iter().map(|label| row_of[label]).collect();
            let sizes: Vec<f64> = rows.iter().map(|&row| bulk.elements[row].size).collect();
            let share = match rule.scales {
                Scales::Stiffness => {
                    let own = rows.iter().map(|&row| &elements[row]);
                    WholeShare::Stiffness(stiffness_of(count, own.zip(sizes.iter().copied()))?)
                }
                Scales::Mass => {
                    let entries = mass_entries(deck, structure, (&rows, masses));
                    WholeShare::Mass(SparseMatrix::new(
                        "mass of elements",
                        count,
                        count,
                        entries,
                    )?)
                }
            };
            let part = Part {
                name,
                share,
                members,
                sizes,
            };
            parts.push((rule, part));
        }
    }
    Ok(parts)
}

/// Entries of the mass of some elements by place, and of point masses by label.
fn mass_entries(
    deck: &Deck,
    structure: &Structure,
    (rows, labels): (&[usize], &[usize]),
) -> Vec<(usize, usize, f64)> {
    let (bulk, motion_of) = (&deck.model, deck.model.motions(structure));
    let lumped = rows.iter().flat_map(|&row| {
        let (element, corners) = (&bulk.elements[row], &structure.corners()[row]);
        lumped_masses(structure, element, corners)
    });
    let mut entries: Vec<_> = lumped.map(|(row, own)| (row, row, own)).collect();
    let points = bulk.masses.iter().filter(|own| labels.contains(&own.label));
    for (point, dof) in points.flat_map(|point| point.dof().map(move |dof| (point, dof))) {
        let motion = motion_of(dof);
        entries.extend(moving_mass_entries(&motion, &motion, point.mass));
    }
    entries
}

/// Names and members of the parameters that a rule makes of a deck.
fn groups(
    job: &Job,
    rule: &ParameterRule,
    deck: &Deck,
) -> Result<Vec<(String, Members)>, FileError> {
    let ParameterRule {
        name,
        properties,
        materials,
        ..
    } = rule;
    ensure(rule.matrix.is_none(), || {
        job.refused(format!(
            "parameter \"{name}\": in a deck, name elements or masses instead of a matrix"
        ))
    })?;
    let (mut elements, masses) = (job.labels(&rule.elements)?, job.labels(&rule.masses)?);
    let is_of = |of: &Membership| {
        of.property.is_some_and(|p| properties.contains(&p)) || materials.contains(&of.material)
    };
    elements.extend(
        deck.members
            .iter()
            .filter(|own| is_of(own.1))
            .map(|own| *own.0),
    );
    let members = || deck.members.values();
    let property = properties
        .iter()
        .find(|label| members().all(|of| of.property != Some(**label)));
    let material = materials
        .iter()
        .find(|label| members().all(|of| of.material != **label));
    if let Some(label) = property.or(material) {
        return Err(job.refused(format!(
            "parameter \"{name}\": no element of the deck has property or material {label}"
        )));
    }
    ensure(elements.len() + masses.len() > 0, || {
        job.refused(format!(
            "parameter \"{name}\" names no elements and no masses"
        ))
    })?;
    let [elements, masses] = [elements, masses].map(Vec::from_iter);
    if !rule.each {
        return Ok(vec![(name.clone(), Members { elements, masses })]);
    }
    let of_element = |&label: &usize| {
        let (elements, masses) = (vec![label], Vec::new());
        (format!("{name} {label}"), Members { elements, masses })
    };
    let of_mass = |&label: &usize| {
        let (elements, masses) = (Vec::new(), vec![label]);
        (format!("{name} mass {label}"), Members { elements, masses })
    };
    Ok(elements
        .iter()
        .map(of_element)
        .chain(masses.iter().map(of_mass))
        .collect())
}
