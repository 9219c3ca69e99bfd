//! The model that a job names, as matrices at all degrees of freedom, and the positions of these.

use super::{Job, ParameterRule, Scales};
use crate::files::deck::{self, Deck, Membership};
use crate::files::error::{FileError, ensure};
use crate::files::matrices::Label;
use crate::files::test_data::DIRECTIONS;
use crate::method::appendix_a::element_matrices;
use crate::method::error::Error;
use crate::method::step::Bounds;
use crate::method::structure::StructuralDof;
use crate::sparse::elements::{lumped_masses, moving_mass_entries, stiffness_of, support};
use crate::sparse::{SparseMatrix, Support, WholeModel, WholeParameter, WholeShare};
use crate::weighted::identifiability::PRIOR_DEVIATION;
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

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
    pub motions: BTreeMap<StructuralDof, Vec<(usize, f64)>>,
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

impl ModelSource {
    /// Name of a row of the matrices: the grid and direction that it moves.
    pub(super) fn row_name(&self, row: usize) -> String {
        let is_row = |&(other, coefficient): &(usize, f64)| other == row && coefficient != 0.0;
        let mut motions = self.motions.iter();
        let moves = motions.find(|(_, rows)| rows.iter().any(is_row));
        moves.map_or_else(
            || format!("row {}", row + 1),
            |(dof, _)| format!("{} {}", dof.grid, DIRECTIONS[dof.direction]),
        )
    }

    /// The model without the parts in which no sensor reads a row, and the sensors on it: to them these parts do not exist.
    pub(super) fn watched(
        &self,
        sensors: &SparseMatrix,
    ) -> Result<Option<(Self, SparseMatrix)>, FileError> {
        let rows = self.whole.rows_with_sensor(sensors);
        if rows.len() == self.whole.dof_count() {
            return Ok(None);
        }
        let place = |&(row, coefficient): &(usize, f64)| {
            Some((rows.binary_search(&row).ok()?, coefficient))
        };
        let motion = |(at, own): (&StructuralDof, &Vec<(usize, f64)>)| {
            let own: Vec<_> = own.iter().filter_map(place).collect();
            (!own.is_empty()).then_some((*at, own))
        };
        let left = (0..self.whole.dof_count()).filter(|row| rows.binary_search(row).is_err());
        let (stiffness, _) = self.whole.at(&vec![1.0; self.whole.parameters().len()])?;
        let stiff: BTreeSet<usize> = stiffness
            .entries()
            .filter(|entry| entry.2 != 0.0)
            .map(|entry| entry.0)
            .collect();
        let is_loose = |row: &usize| !stiff.contains(row);
        let named = |row: usize| self.row_name(row);
        let watched = Self {
            whole: self.whole.at_rows(&rows)?,
            motions: self.motions.iter().filter_map(motion).collect(),
            left_out: left.clone().map(named).collect(),
            loose: left.filter(is_loose).map(named).collect(),
            ..self.clone()
        };
        Ok(Some((watched, sensors.at_columns(&rows)?)))
    }

    /// Mass that moves along x, y and z, and its center, if all of it has a place.
    ///
    /// In a model given by matrices, a row counts with its part of the momentum $M r$ of all rows of its direction at unit speed.
    pub(super) fn mass_and_center(
        &self,
    ) -> Result<(Vector3<f64>, Option<Vector3<f64>>), FileError> {
        let placed: Vec<(Option<Vector3<f64>>, Vector3<f64>)> = match &self.deck {
            Some((_, deck)) => {
                let placed = deck.model.placed_masses()?.into_iter();
                placed.map(|(place, mass)| (Some(place), mass)).collect()
            }
            None => {
                let motions = self.motions.iter();
                let dof_of: BTreeMap<usize, StructuralDof> =
                    motions.map(|(&dof, rows)| (rows[0].0, dof)).collect();
                let (_, mass) = self.whole.at(&vec![1.0; self.whole.parameters().len()])?;
                let of_entry = |(row, column, value): (usize, usize, f64)| {
                    let StructuralDof { grid, direction } = *dof_of.get(&row)?;
                    let is_along = direction < 3 && dof_of[&column].direction == direction;
                    let place = self.geometry.places.get(&grid).copied();
                    is_along.then(|| (place, Vector3::ith(direction, value)))
                };
                mass.entries().filter_map(of_entry).collect()
            }
        };
        let total: Vector3<f64> = placed.iter().map(|(_, mass)| mass).sum();
        let moments: Option<Vec<Vector3<f64>>> = placed
            .iter()
            .map(|(place, mass)| Some((*place)? * mass.sum()))
            .collect();
        let places = placed.iter().flat_map(|own| own.0);
        let farthest = places.fold(0.0_f64, |most, place| most.max(place.amax()));
        // What is left of sums that cancel is no distance.
        let told = |own: f64| own * f64::from(own.abs() >= 1e-9 * farthest);
        let center =
            moments.map(|moments| (moments.iter().sum::<Vector3<f64>>() / total.sum()).map(told));
        Ok((total, center.filter(|_| total.sum() > 0.0)))
    }
}

/// The model of the deck in this file.
pub(super) fn from_deck(job: &Job, file: &Path) -> Result<ModelSource, FileError> {
    let bytes = job.bytes(file, "model.deck")?;
    let deck = deck::read(&file.display().to_string(), &bytes, &job.model.ignore)?;
    let bulk = &deck.model;
    let structure = bulk.structure()?;
    let elements: Vec<_> = element_matrices(&structure).collect();
    let count = structure.free_dof().len();
    let row_of: BTreeMap<usize, usize> = elements
        .iter()
        .enumerate()
        .map(|(row, e)| (e.label, row))
        .collect();
    let sized = |row: usize| (&elements[row], bulk.elements[row].size);
    let stiffness = stiffness_of(count, (0..elements.len()).map(sized))?;
    let moving = bulk.moving_masses(&structure)?;
    let mass = sum_of(
        count,
        moving
            .iter()
            .flat_map(|point| moving_mass_entries(&point.motion, &point.motion, point.mass)),
    )?;
    let motion_of = bulk.motions(&structure);
    let (mut parameters, mut members, mut owner, mut priors) =
        (Vec::new(), Vec::new(), BTreeMap::new(), Vec::new());
    for rule in &job.parameters {
        let files = [&rule.matrix, &rule.stiffness, &rule.mass];
        ensure(files.into_iter().all(Option::is_none), || {
            let name = &rule.name;
            job.refused(format!(
                "parameter \"{name}\": in a deck, name elements or masses instead of a matrix"
            ))
        })?;
        for ElementGroup {
            name,
            elements: labels,
            masses,
        } in groups(job, rule, &deck)?
        {
            let refused = |what| job.refused(format!("parameter \"{name}\": {what}"));
            for label in &labels {
                ensure(row_of.contains_key(label), || {
                    refused(format!("the deck has no element {label}"))
                })?;
            }
            for &element in &labels {
                if let Some(first) =
                    owner.insert((rule.scales == Scales::Mass, element), name.clone())
                {
                    let owner = format!("parameters {first} and {name}");
                    let (what, label) = ("element", element);
                    return Err(Error::Duplicate { owner, what, label }.into());
                }
            }
            let rows: Vec<usize> = labels.iter().map(|label| row_of[label]).collect();
            let share = match rule.scales {
                Scales::Stiffness => {
                    if let Some(label) = masses.first() {
                        let reason = format!("point mass {label} needs scales = \"mass\"");
                        return Err(refused(reason));
                    }
                    let own = rows.iter().map(|&row| sized(row));
                    WholeShare::Stiffness(stiffness_of(count, own)?)
                }
                Scales::Mass => {
                    let lumped = rows.iter().flat_map(|&row| {
                        let (element, corners) = (&bulk.elements[row], &structure.corners()[row]);
                        lumped_masses(&structure, element, corners)
                    });
                    let mut entries: Vec<_> = lumped.map(|(row, own)| (row, row, own)).collect();
                    for label in &masses {
                        ensure(bulk.masses.iter().any(|own| own.label == *label), || {
                            refused(format!("the deck has no point mass {label}"))
                        })?;
                    }
                    for point in bulk
                        .masses
                        .iter()
                        .filter(|point| masses.contains(&point.label))
                    {
                        for dof in point.dof() {
                            let motion = motion_of(dof);
                            entries.extend(moving_mass_entries(&motion, &motion, point.mass));
                        }
                    }
                    WholeShare::Mass(sum_of(count, entries.into_iter())?)
                }
            };
            let sizes: Vec<f64> = rows.iter().map(|&row| bulk.elements[row].size).collect();
            parameters.push(WholeParameter {
                name,
                share,
                range: range(job, rule, &sizes)?,
            });
            members.push(Members {
                elements: labels,
                masses,
            });
            priors.push(prior(job, rule)?);
        }
    }
    let support = Support {
        count: job.model.rigid_bodies,
        ..support(&structure, &elements)?
    };
    let whole = WholeModel::supported(stiffness, mass, parameters, support)?;
    let grids = bulk.grids.iter();
    let motions = bulk.all_motions(&structure).collect();
    let geometry = GridLayout {
        places: grids.map(|grid| (grid.label, grid.position)).collect(),
        elements: bulk
            .elements
            .iter()
            .map(|element| element.grids.clone())
            .collect(),
    };
    drop(motion_of);
    Ok(ModelSource {
        all: whole.clone(),
        labels: Vec::new(),
        dmig: Default::default(),
        whole,
        geometry,
        motions,
        members,
        priors,
        deck: Some((bytes, deck)),
        mass: Default::default(),
        mass_center: None,
        left_out: Vec::new(),
        loose: Vec::new(),
    })
}

/// One parameter of a deck, its elements and point masses ascending.
struct ElementGroup {
    name: String,
    elements: Vec<usize>,
    masses: Vec<usize>,
}

/// The parameters that a rule makes of a deck.
fn groups(job: &Job, rule: &ParameterRule, deck: &Deck) -> Result<Vec<ElementGroup>, FileError> {
    let ParameterRule {
        name,
        properties,
        materials,
        each,
        ..
    } = rule;
    let (mut elements, masses) = (job.labels(&rule.elements)?, job.labels(&rule.masses)?);
    let is_of = |of: &Membership| {
        of.property.is_some_and(|p| properties.contains(&p)) || materials.contains(&of.material)
    };
    elements.extend(
        deck.members
            .iter()
            .filter(|(_, of)| is_of(of))
            .map(|(label, _)| *label),
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
    if !each {
        let [elements, masses] = [elements, masses].map(|labels| labels.into_iter().collect());
        return Ok(vec![ElementGroup {
            name: name.clone(),
            elements,
            masses,
        }]);
    }
    let of_element = |label| ElementGroup {
        name: format!("{name} {label}"),
        elements: vec![label],
        masses: Vec::new(),
    };
    let of_mass = |label| ElementGroup {
        name: format!("{name} mass {label}"),
        elements: Vec::new(),
        masses: vec![label],
    };
    Ok(elements
        .into_iter()
        .map(of_element)
        .chain(masses.into_iter().map(of_mass))
        .collect())
}

/// The bounds on a parameter's factor: its own, and those that keep elements of the given first sizes within the bounds on sizes.
pub(super) fn range(
    job: &Job,
    rule: &ParameterRule,
    sizes: &[f64],
) -> Result<Option<Bounds>, FileError> {
    let name = &rule.name;
    let both = |[lower, upper]: [Option<f64>; 2], names: &str, what: &str| match (lower, upper) {
        (None, None) => Ok(None),
        (Some(lower), Some(upper)) => Ok(Some(Bounds::positive(
            &format!("{what} of parameter {name}"),
            lower,
            upper,
        )?)),
        _ => Err(job.refused(format!(
            "parameter \"{name}\" needs both {names}, or neither"
        ))),
    };
    let own = both([rule.lower, rule.upper], "lower and upper", "factor")?;
    let of_sizes = both(
        [rule.lower_size, rule.upper_size],
        "lower_size and upper_size",
        "sizes",
    )?;
    let Some(of_sizes) = of_sizes else {
        return Ok(own);
    };
    ensure(
        !sizes.is_empty() && rule.scales == Scales::Stiffness,
        || {
            job.refused(format!(
                "parameter \"{name}\": bounds on sizes are for the stiffness of a deck's elements"
            ))
        },
    )?;
    let (lower, upper) = own.map_or((0.0, f64::INFINITY), |own| (own.lower, own.upper));
    let lower = sizes
        .iter()
        .fold(lower, |lower, size| lower.max(of_sizes.lower / size));
    let upper = sizes
        .iter()
        .fold(upper, |upper, size| upper.min(of_sizes.upper / size));
    Ok(Some(Bounds::positive(
        &format!("factor of parameter {name}"),
        lower,
        upper,
    )?))
}

/// The prior deviation of a parameter: its own, or that of all.
pub(super) fn prior(job: &Job, rule: &ParameterRule) -> Result<f64, FileError> {
    let given = rule.prior_deviation.or(job.compare.prior_deviation);
    let prior = given.unwrap_or(PRIOR_DEVIATION);
    ensure(prior > 0.0 && prior.is_finite(), || {
        let name = &rule.name;
        job.refused(format!(
            "parameter \"{name}\": prior_deviation is {prior}; it must be positive and finite"
        ))
    })?;
    Ok(prior)
}

fn sum_of(
    count: usize,
    entries: impl Iterator<Item = (usize, usize, f64)>,
) -> Result<SparseMatrix, FileError> {
    Ok(SparseMatrix::new(
        "matrix of elements",
        count,
        count,
        entries.collect(),
    )?)
}
