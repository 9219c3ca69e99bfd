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
        step::Bounds,
        structure::{StructuralDof, Structure},
    },
    sparse::{
        SparseMatrix, Support, WholeModel, WholeParameter, WholeShare,
        elements::{lumped_masses, moving_mass_entries, stiffness_of, support},
    },
    weighted::identifiability::PRIOR_DEVIATION,
};
use nalgebra::Vector3;
use std::{collections::BTreeMap, path::Path};

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
    /// The place of every grid that has one, in units of length.
    pub places: Places,
    /// The corners of every element, by grid.
    pub elements: Vec<Vec<usize>>,
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
    /// Names of the rows left out, in parts of the model that no sensor sees.
    pub left_out: Vec<String>,
}

/// A parameter, the elements and masses of a deck that it scales, and the deviation of its logarithm before the test.
pub type Part = (WholeParameter, (Members, f64));

/// Places of grids.
pub type Places = BTreeMap<usize, Vector3<f64>>;

/// Rows of a model and their coefficients for every degree of freedom that moves.
pub type Motions = BTreeMap<StructuralDof, Vec<(usize, f64)>>;

impl ModelSource {
    /// The model of a stiffness and a mass with parameters by the job's rules.
    pub(super) fn new(
        job: &Job,
        (stiffness, mass, support): (SparseMatrix, SparseMatrix, Support),
        parts: Vec<Part>,
        (places, motions): (Places, Motions),
        deck: Option<(Vec<u8>, Deck)>,
    ) -> Result<Self, FileError> {
        let (parameters, (members, priors)) = parts.into_iter().unzip();
        let count = job.model.rigid_bodies;
        let support = Support { count, ..support };
        let whole = WholeModel::supported(stiffness, mass, parameters, support)?;
        let mut source = Self {
            all: whole.clone(),
            whole,
            labels: Vec::new(),
            dmig: Default::default(),
            places,
            elements: Vec::new(),
            motions,
            members,
            priors,
            deck,
            mass: Vector3::zeros(),
            left_out: Vec::new(),
        };
        source.mass = source.moving_mass()?;
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
        let watched = Self {
            whole: self.whole.at_rows(&rows)?,
            motions: self.motions.iter().filter_map(motion).collect(),
            left_out: left.map(|row| self.row_name(row)).collect(),
            ..self.clone()
        };
        Ok(Some((watched, sensors.at_columns(&rows)?)))
    }

    /// Mass that moves along x, y and z: in a model given by matrices, what the rows of a direction have of each other's.
    fn moving_mass(&self) -> Result<Vector3<f64>, FileError> {
        if let Some((_, deck)) = &self.deck {
            return Ok(deck.model.placed_masses()?.iter().map(|own| own.1).sum());
        }
        let motions = self
            .motions
            .iter()
            .map(|(dof, rows)| (rows[0].0, dof.direction));
        let direction: BTreeMap<usize, usize> = motions.collect();
        let (_, mass) = self.whole.at(&vec![1.0; self.priors.len()])?;
        let along = |(row, column, value): (usize, usize, f64)| {
            let own = *direction.get(&row)?;
            (own < 3 && direction[&column] == own).then(|| Vector3::ith(own, value))
        };
        Ok(mass.entries().filter_map(along).sum())
    }
}

impl ParameterRule {
    /// The parameter of this name and share.
    pub(super) fn part(
        &self,
        job: &Job,
        (name, share): (String, WholeShare),
        members: Members,
    ) -> Result<Part, FileError> {
        let range = match (self.lower, self.upper) {
            (None, None) => None,
            (Some(lower), Some(upper)) => Some(Bounds::positive(
                &format!("factor of parameter {}", self.name),
                lower,
                upper,
            )?),
            _ => {
                return Err(job.refused(format!(
                    "parameter \"{}\" needs both lower and upper, or neither",
                    self.name
                )));
            }
        };
        let prior = self.prior_deviation.or(job.compare.prior_deviation);
        let prior = prior.unwrap_or(PRIOR_DEVIATION);
        job.ensure(prior > 0.0 && prior.is_finite(), || {
            format!(
                "parameter \"{}\": prior_deviation is {prior}; it must be positive and finite",
                self.name
            )
        })?;
        Ok((WholeParameter { name, share, range }, (members, prior)))
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
    let places = bulk
        .grids
        .iter()
        .map(|own| (own.label, own.position))
        .collect();
    let elements_at = bulk.elements.iter().map(|own| own.grids.clone()).collect();
    let matrices = (
        stiffness,
        SparseMatrix::new("matrix of elements", count, count, mass)?,
        support(&structure, &elements)?,
    );
    let parts = deck_parts(job, &deck, (&structure, &elements))?;
    Ok(ModelSource {
        elements: elements_at,
        ..ModelSource::new(job, matrices, parts, (places, motions), Some((bytes, deck)))?
    })
}

/// Parameters of a deck by the job's rules.
fn deck_parts(
    job: &Job,
    deck: &Deck,
    (structure, elements): (&Structure, &[ElementMatrix]),
) -> Result<Vec<Part>, FileError> {
    let (bulk, count) = (&deck.model, structure.free_dof().len());
    let row_of = elements.iter().enumerate().map(|(row, e)| (e.label, row));
    let row_of: BTreeMap<usize, usize> = row_of.collect();
    let (mut parts, mut owner) = (Vec::new(), BTreeMap::new());
    for rule in &job.parameters {
        let refused = |what: String| job.refused(format!("parameter \"{}\": {what}", rule.name));
        let members = members(job, rule, deck)?;
        for &label in &members.elements {
            ensure(row_of.contains_key(&label), || {
                refused(format!("the deck has no element {label}"))
            })?;
            let first = owner.insert((rule.scales == Scales::Mass, label), &rule.name);
            if let Some(first) = first {
                return Err(refused(format!(
                    "element {label} is parameter \"{first}\"'s too"
                )));
            }
        }
        for label in &members.masses {
            ensure(rule.scales == Scales::Mass, || {
                refused(format!("point mass {label} needs scales = \"mass\""))
            })?;
            ensure(bulk.masses.iter().any(|own| own.label == *label), || {
                refused(format!("the deck has no point mass {label}"))
            })?;
        }
        let groups = if rule.each {
            members.each(&rule.name)
        } else {
            vec![(rule.name.clone(), members)]
        };
        for (name, members) in groups {
            let rows: Vec<usize> = members.elements.iter().map(|label| row_of[label]).collect();
            let share = match rule.scales {
                Scales::Stiffness => {
                    let own = rows
                        .iter()
                        .map(|&row| (&elements[row], bulk.elements[row].size));
                    WholeShare::Stiffness(stiffness_of(count, own)?)
                }
                Scales::Mass => {
                    let entries = mass_entries(deck, structure, (&rows, &members.masses));
                    WholeShare::Mass(SparseMatrix::new(
                        "mass of elements",
                        count,
                        count,
                        entries,
                    )?)
                }
            };
            parts.push(rule.part(job, (name, share), members)?);
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

/// Elements and masses of a deck that a rule names.
fn members(job: &Job, rule: &ParameterRule, deck: &Deck) -> Result<Members, FileError> {
    let refused = |what: String| job.refused(format!("parameter \"{}\" {what}", rule.name));
    ensure(rule.matrix.is_none(), || {
        refused("names a matrix; in a deck, name elements or masses".into())
    })?;
    let (mut elements, masses) = (job.labels(&rule.elements)?, job.labels(&rule.masses)?);
    for (labels, is_property) in [(&rule.properties, true), (&rule.materials, false)] {
        for &label in labels {
            let is_of = |of: &Membership| {
                if is_property {
                    of.property == Some(label)
                } else {
                    of.material == label
                }
            };
            let own = deck.members.iter().filter(|own| is_of(own.1));
            let mut own = own.map(|own| *own.0).peekable();
            ensure(own.peek().is_some(), || {
                refused(format!(
                    "names {label}, which is property or material of no element"
                ))
            })?;
            elements.extend(own);
        }
    }
    ensure(elements.len() + masses.len() > 0, || {
        refused("names no elements and no masses".into())
    })?;
    let [elements, masses] = [elements, masses].map(Vec::from_iter);
    Ok(Members { elements, masses })
}

impl Members {
    /// Each by itself, with its name.
    fn each(&self, name: &str) -> Vec<(String, Self)> {
        let elements = self.elements.iter();
        let elements = elements.map(|own| (format!("{name} {own}"), vec![*own], Vec::new()));
        let masses = self.masses.iter();
        let masses = masses.map(|own| (format!("{name} mass {own}"), Vec::new(), vec![*own]));
        let all = elements.chain(masses);
        all.map(|(name, elements, masses)| (name, Self { elements, masses }))
            .collect()
    }
}
