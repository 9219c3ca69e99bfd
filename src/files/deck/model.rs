//! The model that a deck describes: grids, elements, ties and masses, whatever the order and the format of its cards.

use crate::files::error::FileError;
use crate::method::error::{Error, at_least_one, require};
use crate::method::linear_algebra::{check_length, check_shape, check_symmetric};
use crate::method::model::FiniteElementModel;
use crate::method::structure::{DIRECTIONS, Element, Grid, Point, StructuralDof, Structure};
use crate::sparse::SparseMatrix;
use crate::sparse::elements::{corner_volumes, lumped_masses};
use crate::sparse::whole_modes::MassDof;
use nalgebra::{DMatrix, DVector, Vector3};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Direction of the DOF that stands for a dynamic point: z.
const DYNAMIC_DIRECTION: usize = 2;
/// Numbers made up here start after the next multiple of this, so that a reader tells them from those given.
const LABEL_STEP: usize = 100;
/// One MPC equation, $a_m u_m + \sum_j a_j u_j = 0$, which makes the DOF $m$ follow the others.
#[derive(Debug, Clone, PartialEq)]
pub struct Tie {
    /// The dependent DOF.
    pub dependent: StructuralDof,
    /// Coefficient $a_m$ of the dependent DOF, not zero.
    pub coefficient: f64,
    /// The other DOF with their coefficients $a_j$.
    pub terms: Vec<(StructuralDof, f64)>,
}

/// A mass at a grid, lbf·s²/in.
#[derive(Debug, Clone, PartialEq)]
pub struct PointMass {
    /// Number of the mass.
    pub label: usize,
    /// The grid.
    pub grid: usize,
    /// The one direction it moves with (CMASS2), or `None` for all three alike (CONM2).
    pub direction: Option<usize>,
    /// The mass.
    pub mass: f64,
}

impl PointMass {
    /// The DOF it moves with.
    pub(crate) fn dof(&self) -> impl Iterator<Item = StructuralDof> + '_ {
        let directions =
            (0..3).filter(|direction| self.direction.is_none_or(|own| own == *direction));
        directions.map(|direction| StructuralDof {
            grid: self.grid,
            direction,
        })
    }
}

/// A mass and the free DOF that it moves with.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MovingMass {
    /// Degree of freedom at which the mass is.
    pub dof: StructuralDof,
    /// The mass, lbf·s²/in.
    pub mass: f64,
    /// Column of $T$ of this DOF by rows and coefficients.
    pub motion: Vec<(usize, f64)>,
}

/// The model that a deck describes.
///
/// Decks that say the same in another order, in other formats and with other numbers of properties and materials give
/// equal models. Rotations have no place in it: the crate's elements do not resist them.
#[derive(Debug, Clone, PartialEq)]
pub struct BulkData {
    /// Grids by number, with what SPC1 cards constrain.
    pub grids: Vec<Grid>,
    /// Elements by number.
    pub elements: Vec<Element>,
    /// MPC equations, by grid and direction of the dependent DOF.
    pub ties: Vec<Tie>,
    /// Point masses by number.
    pub masses: Vec<PointMass>,
}

/// Position of a mass, and the amounts of it that move along x, y and z.
pub type PlacedMass = (Vector3<f64>, Vector3<f64>);

impl FiniteElementModel {
    /// Model with element matrices of another origin, such as the program that was given its deck: stiffness for unit size at each
    /// element's free DOF, lbf/in, in the structure's order.
    ///
    /// # Errors
    /// [`Error::WrongShape`] and [`Error::Value`] for matrices that do not fit or are not symmetric and finite.
    pub fn with_unit_stiffness(&self, units: Vec<DMatrix<f64>>) -> Result<Self, Error> {
        check_length("element matrices", units.len(), self.element_matrices.len())?;
        let mut model = self.clone();
        for (element, unit) in model.element_matrices.iter_mut().zip(units) {
            let dof_count = element.dof.len();
            check_shape("element stiffness", &unit, dof_count, dof_count)?;
            check_symmetric("element stiffness", &unit)?;
            element.unit = unit;
        }
        Ok(model)
    }
}

impl BulkData {
    /// A structure alone, without ties and point masses.
    pub fn from_structure(structure: &Structure) -> Self {
        let (grids, elements) = (structure.grids().to_vec(), structure.elements().to_vec());
        Self {
            grids,
            elements,
            ties: Vec::new(),
            masses: Vec::new(),
        }
    }

    /// A finite element model as a deck can express it, its parameters scaled by `factors`: an element that becomes larger becomes as much
    /// less dense.
    /// Every dynamic DOF becomes the z of a grid of its own at its position in `points` (in), numbered after the next
    /// multiple of a hundred above every grid and element, constrained in the other directions, with a point mass
    /// unless that is zero. Its MPC equation is its column of $T$:
    ///
    /// $$ -u_m + \sum_s T_{sm} u_s = 0 $$
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless there is a factor per parameter and a point per dynamic
    /// DOF; [`Error::Value`] for a factor that is not
    /// positive, or a mass matrix that is not diagonal.
    pub fn from_model(
        model: &FiniteElementModel,
        factors: &[f64],
        points: &[Vector3<f64>],
    ) -> Result<Self, FileError> {
        let structure = model.structure();
        let (t, mass) = (model.load_distribution(), model.mass());
        check_length("positions of dynamic points", points.len(), t.ncols())?;
        let mut all = Self::from_structure(structure);
        for (element, size) in all.elements.iter_mut().zip(model.sizes(factors)?) {
            element.material.density *= element.size / size;
            element.size = size;
        }
        let base = all.first_free_label();
        let coupling = (mass - DMatrix::from_diagonal(&mass.diagonal())).amax();
        let owner = || "the dynamic mass".into();
        let wanted = "zero: a deck has point masses alone";
        require(coupling == 0.0, "coupling", owner, coupling, wanted)?;
        for (column, &position) in points.iter().enumerate() {
            let label = base + column;
            all.grids.push(Grid {
                label,
                position,
                constrained: [0, 1, 2].map(|d| d != DYNAMIC_DIRECTION),
            });
            let dependent = StructuralDof {
                grid: label,
                direction: DYNAMIC_DIRECTION,
            };
            let loads = t.column(column);
            let terms = structure
                .free_dof()
                .iter()
                .zip(&loads)
                .filter(|(_, factor)| **factor != 0.0)
                .map(|(&dof, &factor)| (dof, factor))
                .collect();
            all.ties.push(Tie {
                dependent,
                coefficient: -1.0,
                terms,
            });
            let own = mass[(column, column)];
            let point = PointMass {
                label,
                grid: label,
                direction: Some(DYNAMIC_DIRECTION),
                mass: own,
            };
            all.masses.extend((own != 0.0).then_some(point));
        }
        all.grids.sort_by_key(|grid| grid.label);
        all.elements.sort_by_key(|element| element.label);
        Ok(all)
    }

    /// The first number after the next multiple of a hundred above every grid, element and mass.
    pub fn first_free_label(&self) -> usize {
        let grids = self.grids.iter().map(|grid| grid.label);
        let elements = self.elements.iter().map(|element| element.label);
        let masses = self.masses.iter().map(|mass| mass.label);
        let largest = grids.chain(elements).chain(masses).max().unwrap_or(0);
        LABEL_STEP * (largest / LABEL_STEP + 1) + 1
    }

    /// Grids that no element, mass or equation touches and no support holds: nothing would resist their motion.
    pub(crate) fn untouched(&self) -> BTreeSet<usize> {
        let of_elements = self.elements.iter().flat_map(|own| &own.grids);
        let of_masses = self.masses.iter().map(|mass| &mass.grid);
        let of_ties = self.ties.iter().flat_map(|tie| {
            tie.terms
                .iter()
                .map(|(dof, _)| &dof.grid)
                .chain([&tie.dependent.grid])
        });
        let touched: BTreeSet<&usize> = of_elements.chain(of_masses).chain(of_ties).collect();
        let is_untouched =
            |grid: &&Grid| grid.constrained != [true; 3] && !touched.contains(&grid.label);
        self.grids
            .iter()
            .filter(is_untouched)
            .map(|grid| grid.label)
            .collect()
    }

    /// The structure: its free DOF are those that neither an SPC1 card constrains nor an MPC equation makes dependent, of grids that
    /// something touches.
    ///
    /// # Errors
    /// [`FileError::Refused`] for an element at a dependent DOF; the errors of [`Structure::new`].
    pub fn structure(&self) -> Result<Structure, FileError> {
        let tied = self.tie_of();
        let corners = self
            .elements
            .iter()
            .flat_map(|element| element.grids.iter().map(|&grid| (element.label, grid)));
        for (element, grid) in corners {
            let is_tied =
                |&direction: &usize| tied.contains_key(&StructuralDof { grid, direction });
            if let Some(direction) = (0..3).find(is_tied) {
                let along = DIRECTIONS[direction];
                return Err(FileError::refused(
                    format!("element {element}"),
                    format!(
                        "an MPC equation ties its grid {grid} along {along}; an element's grids must move freely"
                    ),
                ));
            }
        }
        let untouched = self.untouched();
        let grids = self.grids.iter().map(|grid| {
            let constrained = [0, 1, 2].map(|direction| {
                let grid_dof = StructuralDof {
                    grid: grid.label,
                    direction,
                };
                grid.constrained[direction]
                    || tied.contains_key(&grid_dof)
                    || untouched.contains(&grid.label)
            });
            Grid {
                constrained,
                ..grid.clone()
            }
        });
        Ok(Structure::new(grids.collect(), self.elements.clone())?)
    }

    /// The equation of every dependent DOF.
    fn tie_of(&self) -> HashMap<StructuralDof, &Tie> {
        self.ties.iter().map(|tie| (tie.dependent, tie)).collect()
    }

    /// The DOF with mass, free or dependent, grid by grid: masses of CMASS2 and CONM2 cards and the lumped ones of
    /// elements with a density, given by their matrices. Masses on constrained DOF do not move.
    ///
    /// The column of $T$ of a free DOF selects it; that of a dependent one is its MPC equation, $T_{jm} = -a_j/a_m$.
    ///
    /// # Errors
    /// [`Error::Count`](crate::method::error::Error::Count) when no mass can move.
    pub fn mass_dof(&self, structure: &Structure) -> Result<MassDof, FileError> {
        let moving = self.moving_masses(structure)?;
        Ok(MassDof {
            dof: moving.iter().map(|point| point.dof).collect(),
            mass: DVector::from_iterator(moving.len(), moving.iter().map(|point| point.mass)),
            load_distribution: SparseMatrix::of_columns(
                "load distribution",
                structure.free_dof().len(),
                &moving
                    .into_iter()
                    .map(|point| point.motion)
                    .collect::<Vec<_>>(),
            )?,
        })
    }

    /// Every mass of elements and points, at free and constrained grids alike: its position and the amounts of it that move along
    /// x, y and z.
    ///
    /// # Errors
    /// The errors of [`Self::structure`].
    pub fn placed_masses(&self) -> Result<Vec<PlacedMass>, FileError> {
        let structure = self.structure()?;
        let of_element = |(element, corners): (&Element, &Vec<Point>)| {
            let volumes = corner_volumes(element.kind, corners);
            let density = element.material.density * element.size;
            let masses = volumes.into_iter().map(move |volume| density * volume);
            corners
                .iter()
                .copied()
                .zip(masses.map(Vector3::repeat))
                .collect::<Vec<_>>()
        };
        let elements = self.elements.iter().zip(structure.corners());
        let of_point = |point: &PointMass| {
            let along = |dof: StructuralDof| Vector3::ith(dof.direction, point.mass);
            let mut grids = structure.grids().iter();
            let grid = grids.find(|grid| grid.label == point.grid)?;
            Some((grid.position, point.dof().map(along).sum()))
        };
        let points = self.masses.iter().filter_map(of_point);
        Ok(elements.flat_map(of_element).chain(points).collect())
    }

    /// The DOF with mass, each with the free DOF that it follows: its column of $T$ by rows and coefficients.
    pub(crate) fn moving_masses(
        &self,
        structure: &Structure,
    ) -> Result<Vec<MovingMass>, FileError> {
        let free = structure.free_dof();
        let mut mass: BTreeMap<StructuralDof, f64> = BTreeMap::new();
        for (element, corners) in self.elements.iter().zip(structure.corners()) {
            for (row, own) in lumped_masses(structure, element, corners) {
                *mass.entry(free[row]).or_default() += own;
            }
        }
        for point in &self.masses {
            point
                .dof()
                .for_each(|dof| *mass.entry(dof).or_default() += point.mass);
        }
        mass.retain(|_, mass| *mass > 0.0);
        let motion_of = self.motions(structure);
        let moving: Vec<MovingMass> = mass
            .into_iter()
            .map(|(dof, mass)| MovingMass {
                dof,
                mass,
                motion: motion_of(dof),
            })
            .filter(|point| !point.motion.is_empty())
            .collect();
        at_least_one("degrees of freedom with mass", moving.len())?;
        Ok(moving)
    }

    /// Motion of a DOF: the free DOF that it is or follows, by row and coefficient; none for a constrained one.
    pub(crate) fn motions<'a>(
        &'a self,
        structure: &'a Structure,
    ) -> impl Fn(StructuralDof) -> Vec<(usize, f64)> + 'a {
        let tie_of = self.tie_of();
        move |own| {
            let terms = match tie_of.get(&own) {
                Some(tie) => tie
                    .terms
                    .iter()
                    .map(|(dof, a)| (*dof, -a / tie.coefficient))
                    .collect(),
                None => vec![(own, 1.0)],
            };
            // A constrained DOF does not move and adds nothing; one that the equation names twice counts twice.
            let mut motion: BTreeMap<usize, f64> = BTreeMap::new();
            for (term, coefficient) in terms {
                if let Some(row) = structure.free_dof_index(term.grid, term.direction) {
                    *motion.entry(row).or_default() += coefficient;
                }
            }
            motion
                .into_iter()
                .filter(|(_, coefficient)| *coefficient != 0.0)
                .collect()
        }
    }

    /// Every degree of freedom that moves, with its motion as by [`Self::motions`].
    pub(crate) fn all_motions<'a>(
        &'a self,
        structure: &'a Structure,
    ) -> impl Iterator<Item = (StructuralDof, Vec<(usize, f64)>)> + 'a {
        let motion_of = self.motions(structure);
        let grids = self.grids.iter().map(|grid| grid.label);
        let all =
            grids.flat_map(|grid| (0..3).map(move |direction| StructuralDof { grid, direction }));
        all.map(move |dof| (dof, motion_of(dof)))
            .filter(|(_, motion)| !motion.is_empty())
    }
}
