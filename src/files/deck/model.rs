//! What a deck says: grids, elements, ties and masses, whatever the order and the format of its cards.

use crate::method::error::Error;
use crate::method::model::FiniteElementModel;
use crate::method::structure::{Element, Grid, StructuralDof, Structure};
use nalgebra::{DMatrix, DVector, Vector3};
use std::collections::{BTreeMap, HashMap, HashSet};

/// Direction of the DOF that stands for a dynamic point: z.
const DYNAMIC_DIRECTION: usize = 2;
/// Numbers made up here start after the next multiple of this, so that a reader tells them from those given.
const LABEL_STEP: usize = 100;

/// One MPC equation, $a_m u_m + \sum_j a_j u_j = 0$, which makes the DOF $m$ follow the others.
#[derive(Debug, Clone, PartialEq)]
pub struct Tie {
    /// The dependent DOF.
    pub dependent: StructuralDof,
    /// Its coefficient $a_m$, not zero.
    pub coefficient: f64,
    /// The other DOF with their coefficients $a_j$.
    pub terms: Vec<(StructuralDof, f64)>,
}

/// A mass at a grid, lbf·s²/in.
#[derive(Debug, Clone, PartialEq)]
pub struct PointMass {
    /// Its number.
    pub label: usize,
    /// The grid.
    pub grid: usize,
    /// The one direction it moves with (CMASS2), or `None` for all three alike (CONM2).
    pub direction: Option<usize>,
    /// The mass.
    pub mass: f64,
}

/// The model that a deck describes.
///
/// Two decks that say the same in another order, in other formats and with other numbers of properties and materials
/// give equal models. Rotations have no place in it: the crate's elements do not resist them.
#[derive(Debug, Clone, PartialEq)]
pub struct BulkData {
    /// Grids by number, with what SPC1 cards hold.
    pub grids: Vec<Grid>,
    /// Elements by number.
    pub elements: Vec<Element>,
    /// MPC equations, by grid and direction of the dependent DOF.
    pub ties: Vec<Tie>,
    /// Point masses by number.
    pub masses: Vec<PointMass>,
}

/// The DOF that move with mass.
#[derive(Debug, Clone, PartialEq)]
pub struct DynamicDof {
    /// Which they are, grid by grid.
    pub dof: Vec<StructuralDof>,
    /// $T$ (free SDOF × d): $q_D = T^t q_S$.
    pub load_distribution: DMatrix<f64>,
    /// The mass on each, lbf·s²/in.
    pub mass: DVector<f64>,
}

impl BulkData {
    /// A finite element model as a deck can hold it, its parameters scaled by `factors`.
    ///
    /// Every dynamic DOF becomes the z of a grid of its own at the position given in `points` (in), numbered after the
    /// next multiple of a hundred above every grid and element, with the other directions held. Its MPC equation is its column of $T$:
    ///
    /// $$ -u_m + \sum_s T_{sm} u_s = 0 $$
    ///
    /// so that a program's own elimination of the dependent DOF puts $T M T^t$ on the structural ones.
    ///
    /// # Errors
    /// Those of [`FiniteElementModel::sizes`]; [`Error::WrongShape`] unless there is a point per dynamic DOF;
    /// [`Error::CoupledMass`] for a mass matrix that is not diagonal.
    pub fn of(
        model: &FiniteElementModel,
        factors: &[f64],
        points: &[Vector3<f64>],
    ) -> Result<Self, Error> {
        let structure = model.structure();
        let (t, mass) = (model.load_distribution(), model.mass());
        crate::method::linear_algebra::check_length(
            "positions of dynamic points",
            points.len(),
            t.ncols(),
        )?;
        let mut grids = structure.grids().to_vec();
        let mut elements = structure.elements().to_vec();
        for (element, size) in elements.iter_mut().zip(model.sizes(factors)?) {
            element.size = size;
        }
        let labels = grids.iter().map(|grid| grid.label);
        let largest = labels.chain(elements.iter().map(|element| element.label));
        let base = first_free_label(largest.max().unwrap_or(0));
        let (mut ties, mut masses) = (Vec::new(), Vec::new());
        for (column, &position) in points.iter().enumerate() {
            if (0..mass.nrows()).any(|row| row != column && mass[(row, column)] != 0.0) {
                return Err(Error::CoupledMass { dof: column });
            }
            let label = base + column;
            let mut held = [true; 3];
            held[DYNAMIC_DIRECTION] = false;
            grids.push(Grid {
                label,
                position,
                held,
            });
            let free = structure.free_dof().iter().copied();
            ties.push(Tie {
                dependent: StructuralDof {
                    grid: label,
                    direction: DYNAMIC_DIRECTION,
                },
                coefficient: -1.0,
                terms: free
                    .zip(t.column(column).iter().copied())
                    .filter(|(_, coefficient)| *coefficient != 0.0)
                    .collect(),
            });
            masses.push(PointMass {
                label,
                grid: label,
                direction: Some(DYNAMIC_DIRECTION),
                mass: mass[(column, column)],
            });
        }
        grids.sort_by_key(|grid| grid.label);
        elements.sort_by_key(|element| element.label);
        Ok(Self {
            grids,
            elements,
            ties,
            masses,
        })
    }

    /// The structure: its free DOF are those that neither an SPC1 card holds nor an MPC equation makes dependent.
    ///
    /// # Errors
    /// [`Error::TiedElement`] for an element at a dependent DOF; those of [`Structure::new`].
    pub fn structure(&self) -> Result<Structure, Error> {
        let tied: HashSet<(usize, usize)> = self
            .ties
            .iter()
            .map(|tie| (tie.dependent.grid, tie.dependent.direction))
            .collect();
        for element in &self.elements {
            for &grid in &element.grids {
                if let Some(direction) = (0..3).find(|&d| tied.contains(&(grid, d))) {
                    return Err(Error::TiedElement {
                        element: element.label,
                        grid,
                        direction: crate::method::structure::DIRECTIONS[direction],
                    });
                }
            }
        }
        let mut grids = self.grids.clone();
        for grid in &mut grids {
            for direction in 0..3 {
                grid.held[direction] |= tied.contains(&(grid.label, direction));
            }
        }
        Structure::new(grids, self.elements.clone())
    }

    /// The DOF with mass, free or dependent: masses of CMASS2 and CONM2 cards and the lumped ones of elements with a density.
    ///
    /// The column of $T$ of a free DOF selects it; that of a dependent one is its MPC equation, $T_{jm} = -a_j/a_m$.
    /// Masses on held DOF do not move.
    ///
    /// # Errors
    /// The geometry errors of elements with a density.
    pub fn dynamic_dof(&self, structure: &Structure) -> Result<DynamicDof, Error> {
        let mut mass: BTreeMap<(usize, usize), f64> = BTreeMap::new();
        for point in &self.masses {
            for direction in 0..3 {
                if point.direction.is_none_or(|own| own == direction) {
                    *mass.entry((point.grid, direction)).or_default() += point.mass;
                }
            }
        }
        for element in self.elements.iter().filter(|e| e.material.density > 0.0) {
            let corners = structure.corners(element);
            let volumes = crate::method::elements::mass::corner_volumes(element.kind, &corners)
                .map_err(|error| error.in_element(element.label))?;
            for (&grid, volume) in element.grids.iter().zip(volumes) {
                for direction in 0..3 {
                    *mass.entry((grid, direction)).or_default() +=
                        element.material.density * element.size * volume;
                }
            }
        }
        let tie_of: HashMap<(usize, usize), &Tie> = self
            .ties
            .iter()
            .map(|tie| ((tie.dependent.grid, tie.dependent.direction), tie))
            .collect();
        let (mut dof, mut columns, mut masses) = (Vec::new(), Vec::new(), Vec::new());
        for ((grid, direction), mass) in mass {
            let mut column = DVector::zeros(structure.free_dof().len());
            if let Some(tie) = tie_of.get(&(grid, direction)) {
                for (term, coefficient) in &tie.terms {
                    // A held DOF does not move and adds nothing.
                    if let Some(row) = structure.free_dof_index(term.grid, term.direction) {
                        column[row] -= coefficient / tie.coefficient;
                    }
                }
            } else if let Some(row) = structure.free_dof_index(grid, direction) {
                column[row] = 1.0;
            }
            if column.amax() > 0.0 {
                dof.push(StructuralDof { grid, direction });
                columns.push(column);
                masses.push(mass);
            }
        }
        if columns.is_empty() {
            return Err(Error::Empty {
                what: "degrees of freedom with mass",
            });
        }
        Ok(DynamicDof {
            dof,
            load_distribution: DMatrix::from_columns(&columns),
            mass: DVector::from_vec(masses),
        })
    }
}

/// The first number after the next multiple of a hundred above `largest`.
pub(crate) fn first_free_label(largest: usize) -> usize {
    LABEL_STEP * (largest / LABEL_STEP + 1) + 1
}
