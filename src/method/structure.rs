//! The structure: grid points, materials, elements, and which motions are constrained.
//! Tour: [chapter 7](crate::tour::chapter_07_box).

use crate::method::error::{Error, at_least_one, setting};
pub use crate::method::geometry::ElementKind;
use crate::method::geometry::Geometry;
use nalgebra::{DMatrix, Vector3};
use std::collections::{HashMap, HashSet};

/// Names of the three directions of a grid point's motion, in the order of its DOF.
pub const DIRECTIONS: [char; 3] = ['x', 'y', 'z'];

/// A point of the structure with three translations.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// Its number.
    pub label: usize,
    /// Position, in.
    pub position: Vector3<f64>,
    /// Which of x, y, z a support fixes to ground.
    pub constrained: [bool; 3],
}

/// A linear elastic isotropic material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Young's modulus $E$, lbf/in².
    pub youngs_modulus: f64,
    /// Poisson's ratio $\nu$.
    pub poissons_ratio: f64,
    /// Shear modulus $G$, lbf/in².
    pub shear_modulus: f64,
    /// Mass density $\rho$, lbf·s²/in⁴; zero for elements without mass of their own.
    pub density: f64,
}

impl Material {
    /// A material without mass from $E$ (lbf/in²) and $\nu$: $G = E/\big(2(1+\nu)\big)$.
    ///
    /// # Errors
    /// [`Error::NotPositive`] unless $E > 0$; [`Error::Setting`] unless $-1 < \nu \le 1/2$.
    pub fn isotropic(youngs_modulus: f64, poissons_ratio: f64) -> Result<Self, Error> {
        let shear_modulus = youngs_modulus / (2.0 * (1.0 + poissons_ratio));
        let material = Self {
            youngs_modulus,
            poissons_ratio,
            shear_modulus,
            density: 0.0,
        };
        material.check().map(|()| material)
    }

    /// The same material with a mass density, lbf·s²/in⁴.
    ///
    /// # Errors
    /// [`Error::NotPositive`] unless the density is positive.
    pub fn with_density(self, density: f64) -> Result<Self, Error> {
        positive("density", material, density)?;
        Ok(Self { density, ..self })
    }

    fn check(&self) -> Result<(), Error> {
        positive("Young's modulus", material, self.youngs_modulus)?;
        let nu = self.poissons_ratio;
        setting(
            "Poisson's ratio",
            "more than -1 and at most 0.5",
            nu,
            nu > -1.0 && nu <= 0.5,
        )?;
        positive("shear modulus", material, self.shear_modulus)?;
        if self.density == 0.0 {
            Ok(())
        } else {
            positive("density", material, self.density)
        }
    }
}

fn material() -> String {
    "the material".into()
}

/// One finite element.
#[derive(Debug, Clone, PartialEq)]
pub struct Element {
    /// Its number.
    pub label: usize,
    /// Its kind.
    pub kind: ElementKind,
    /// Labels of its grids, in order around the perimeter of a panel.
    pub grids: Vec<usize>,
    /// Gage in inches or area in square inches; stiffness is proportional to it.
    pub size: f64,
    /// What it is made of.
    pub material: Material,
}

impl Element {
    /// Where the element lies, from the positions of all grids.
    fn geometry(
        &self,
        position: impl Fn(usize) -> Option<Vector3<f64>>,
    ) -> Result<Geometry, Error> {
        let owner = || format!("element {}", self.label);
        let corner = |&label: &usize| {
            position(label).ok_or_else(|| Error::Unknown {
                owner: owner(),
                what: "grid",
                label,
            })
        };
        let corners: Vec<_> = self.grids.iter().map(corner).collect::<Result<_, _>>()?;
        let is_rod = self.kind == ElementKind::Rod;
        positive(if is_rod { "area" } else { "gage" }, owner, self.size)?;
        (self.material.check())
            .and_then(|()| Geometry::new(self.kind, &corners))
            .map_err(|error| error.in_element(self.label))
    }
}

/// A structural DOF: one direction of one grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StructuralDof {
    /// The grid's label.
    pub grid: usize,
    /// 0, 1, 2 for x, y, z.
    pub direction: usize,
}

/// A checked structure: grids and elements that refer to each other correctly and have a length or an area.
///
/// Its free structural DOF (SDOF) are the directions that are not constrained, grid by grid in the order given,
/// x before y before z. Every matrix over SDOF in this crate has its rows in that order.
#[derive(Debug, Clone)]
pub struct Structure {
    grids: Vec<Grid>,
    elements: Vec<Element>,
    geometry: Vec<Geometry>,
    index_of_grid: HashMap<usize, usize>,
    free: Vec<StructuralDof>,
    free_index: HashMap<(usize, usize), usize>,
}

impl Structure {
    /// Checks grids and elements and numbers the free DOF.
    ///
    /// # Errors
    /// [`Error::Empty`] without elements; [`Error::Duplicate`], [`Error::Unknown`], [`Error::NotFinite`] (a
    /// coordinate), [`Error::NotPositive`] (a size), and [`Error::InElement`] around a bad material or geometry.
    ///
    /// # Example
    ///
    /// ```rust
    /// use corfem::method::structure::{Element, ElementKind, Grid, Material, Structure};
    /// use nalgebra::Vector3;
    ///
    /// // A rod of 10 in from a wall, free to move along itself.
    /// let wall = Grid { label: 1, position: Vector3::zeros(), constrained: [true; 3] };
    /// let tip = Grid { label: 2, position: 10.0 * Vector3::x(), constrained: [false, true, true] };
    /// let material = Material::isotropic(1.0e7, 0.3)?;
    /// let rod = Element { label: 1, kind: ElementKind::Rod, grids: vec![1, 2], size: 0.1, material };
    /// let structure = Structure::new(vec![wall, tip], vec![rod])?;
    /// assert_eq!(structure.free_dof().len(), 1);
    /// # Ok::<(), corfem::method::error::Error>(())
    /// ```
    pub fn new(grids: Vec<Grid>, elements: Vec<Element>) -> Result<Self, Error> {
        at_least_one("elements", elements.len())?;
        let (mut index_of_grid, mut free, mut free_index) =
            (HashMap::new(), Vec::new(), HashMap::new());
        for (
            row,
            &Grid {
                label,
                position,
                constrained,
            },
        ) in grids.iter().enumerate()
        {
            if index_of_grid.insert(label, row).is_some() {
                return Err(Error::Duplicate {
                    what: "grid",
                    label,
                });
            }
            for (direction, (&value, constrained)) in position.iter().zip(constrained).enumerate() {
                if !value.is_finite() {
                    return Err(Error::NotFinite {
                        what: "grid coordinates",
                        row,
                        column: direction,
                        value,
                    });
                }
                if !constrained {
                    free_index.insert((label, direction), free.len());
                    free.push(StructuralDof {
                        grid: label,
                        direction,
                    });
                }
            }
        }
        let position = |label| {
            index_of_grid
                .get(&label)
                .map(|&row: &usize| grids[row].position)
        };
        let mut seen = HashSet::new();
        let mut geometry = Vec::new();
        for element in &elements {
            if !seen.insert(element.label) {
                return Err(Error::Duplicate {
                    what: "element",
                    label: element.label,
                });
            }
            geometry.push(element.geometry(position)?);
        }
        Ok(Self {
            grids,
            elements,
            geometry,
            index_of_grid,
            free,
            free_index,
        })
    }

    /// The grids, in the order given.
    pub fn grids(&self) -> &[Grid] {
        &self.grids
    }

    /// The elements, in the order given.
    pub fn elements(&self) -> &[Element] {
        &self.elements
    }

    /// Where every element lies.
    pub fn geometry(&self) -> &[Geometry] {
        &self.geometry
    }

    /// The free structural DOF, in the order of every SDOF matrix.
    pub fn free_dof(&self) -> &[StructuralDof] {
        &self.free
    }

    /// Row of a grid's direction among the free DOF; `None` if it is constrained or the grid does not exist.
    pub fn free_dof_index(&self, grid: usize, direction: usize) -> Option<usize> {
        self.free_index.get(&(grid, direction)).copied()
    }

    /// The load distribution $T$ (A.3), free SDOF × d: a dynamic DOF for every list of `points`, each of whose rows, (grid, `'x'`,
    /// `'y'` or `'z'`, weight), takes that part of its load, and gives it that part of its motion: $q_D = T^t q_S$.
    ///
    /// # Errors
    /// [`Error::Unknown`] for a grid that does not exist or is not free to move so.
    pub fn load_distribution(
        &self,
        points: &[Vec<(usize, char, f64)>],
    ) -> Result<DMatrix<f64>, Error> {
        let mut t = DMatrix::zeros(self.free.len(), points.len());
        for (column, rows) in points.iter().enumerate() {
            for &(grid, direction, weight) in rows {
                let direction_index = DIRECTIONS.iter().position(|name| *name == direction);
                let row = direction_index.and_then(|index| self.free_dof_index(grid, index));
                let row = row.ok_or_else(|| Error::Unknown {
                    owner: format!("dynamic DOF {column}, direction {direction}"),
                    what: "free grid",
                    label: grid,
                })?;
                t[(row, column)] += weight;
            }
        }
        Ok(t)
    }

    /// Positions of an element's grids, in.
    pub fn corners(&self, element: &Element) -> Vec<Vector3<f64>> {
        element
            .grids
            .iter()
            .filter_map(|&grid| self.position(grid))
            .collect()
    }

    /// Position of the grid of a number, in.
    pub(crate) fn position(&self, grid: usize) -> Option<Vector3<f64>> {
        self.index_of_grid
            .get(&grid)
            .map(|&row| self.grids[row].position)
    }
}

/// Accepts a positive finite number.
pub(crate) fn positive(
    what: &'static str,
    owner: impl Fn() -> String,
    value: f64,
) -> Result<(), Error> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(Error::NotPositive {
            what,
            owner: owner(),
            value,
        })
    }
}
