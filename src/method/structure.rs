//! The structure: grid points, materials, elements, and which motions are constrained.
//! Tour: [chapter 8](crate::tour::chapter_08_box).

use super::error::{Error, Result, at_least_one, check_count, positive, require};
use nalgebra::Vector3;
use std::collections::{HashMap, HashSet};

/// Names of the three directions of a grid point's motion, in the order of its DOF.
pub const DIRECTIONS: [char; 3] = ['x', 'y', 'z'];

/// Position in space, in.
pub type Point = Vector3<f64>;

/// Length of a rod over the distance of its ends from the origin below which it is round-off of their coordinates.
const SMALLEST_LENGTH_RATIO: f64 = 1e-12;
/// Area over the square of the longest side or diagonal, or doubled area of a corner's triangle over that of its panel, below which it
/// is none.
const SMALLEST_AREA_RATIO: f64 = 1e-10;

/// A point of the structure with three translations.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// Its number.
    pub label: usize,
    /// Position, in.
    pub position: Point,
    /// Directions x, y, z that a support fixes to ground.
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
    /// Moduli other than $E > 0$ and $-1 < \nu \le 1/2$.
    pub fn isotropic(youngs_modulus: f64, poissons_ratio: f64) -> Result<Self> {
        let shear_modulus = youngs_modulus / (2.0 * (1.0 + poissons_ratio));
        let material = Self {
            youngs_modulus,
            poissons_ratio,
            shear_modulus,
            density: 0.0,
        };
        material.check(|| "the material".into()).map(|()| material)
    }

    /// Refuses moduli, Poisson's ratio or density out of their range.
    pub(crate) fn check(&self, owner: impl Fn() -> String) -> Result<()> {
        positive("Young's modulus", &owner, self.youngs_modulus)?;
        let (nu, density) = (self.poissons_ratio, self.density);
        let is_met = nu > -1.0 && nu <= 0.5;
        let expected = "more than -1 and at most 0.5";
        require(is_met, "Poisson's ratio", &owner, nu, expected)?;
        positive("shear modulus", &owner, self.shear_modulus)?;
        let is_met = density >= 0.0 && density.is_finite();
        require(is_met, "density", owner, density, "positive and finite")
    }
}

/// Kind of an element: what it is made of and what it resists.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ElementKind {
    /// Axial member between two grids; its size is a cross section (area), in².
    Rod,
    /// Garvey shear panel between four grids; its size is a gage (thickness), in.
    ShearPanel,
    /// Membrane panel of four overlapping triangles between four grids; its size is a gage, in.
    Membrane,
    /// Constant-strain triangle between three grids; its size is a gage, in.
    Triangle,
}

impl ElementKind {
    /// Number of grid points that the element joins.
    pub fn corner_count(self) -> usize {
        match self {
            Self::Rod => 2,
            Self::Triangle => 3,
            Self::ShearPanel | Self::Membrane => 4,
        }
    }
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
    /// Material that it is made of.
    pub material: Material,
}

/// A structural DOF: one direction of one grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
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
    corners: Vec<Vec<Point>>,
    free: Vec<StructuralDof>,
    row_of: HashMap<StructuralDof, usize>,
}

impl Structure {
    /// Checks grids and elements and numbers the free DOF.
    ///
    /// # Errors
    /// No elements, a grid or element that is given twice, an element's grid that is not there, a coordinate, size or material out of its
    /// range, and corners that [`check_corners`] refuses.
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
    pub fn new(grids: Vec<Grid>, elements: Vec<Element>) -> Result<Self> {
        at_least_one("elements", elements.len())?;
        let (mut positions, mut free) = (HashMap::new(), Vec::new());
        let twice = |what, label| Error::Duplicate {
            owner: "structure".into(),
            what,
            label,
        };
        for point in &grids {
            let grid = point.label;
            if positions.insert(grid, point.position).is_some() {
                return Err(twice("grid", grid));
            }
            for (direction, &value) in point.position.iter().enumerate() {
                let owner = || format!("grid {grid}");
                require(value.is_finite(), "coordinate", owner, value, "finite")?;
                if !point.constrained[direction] {
                    free.push(StructuralDof { grid, direction });
                }
            }
        }
        let (mut seen, mut corners) = (HashSet::new(), Vec::new());
        for element in &elements {
            let owner = || format!("element {}", element.label);
            if !seen.insert(element.label) {
                return Err(twice("element", element.label));
            }
            positive("gage or area", owner, element.size)?;
            element.material.check(owner)?;
            let corner = |&label: &usize| {
                let (owner, what) = (owner(), "grid");
                let missing = Error::Unknown { owner, what, label };
                positions.get(&label).copied().ok_or(missing)
            };
            let own: Vec<_> = element.grids.iter().map(corner).collect::<Result<_, _>>()?;
            check_corners(element.label, element.kind, &own)?;
            corners.push(own);
        }
        Ok(Self {
            row_of: free.iter().copied().zip(0..).collect(),
            grids,
            elements,
            corners,
            free,
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

    /// Positions of every element's grids, in.
    pub fn corners(&self) -> &[Vec<Point>] {
        &self.corners
    }

    /// The free structural DOF, in the order of every SDOF matrix.
    pub fn free_dof(&self) -> &[StructuralDof] {
        &self.free
    }

    /// Row of a grid's direction among the free DOF; `None` if it is constrained or the grid does not exist.
    pub fn free_dof_index(&self, grid: usize, direction: usize) -> Option<usize> {
        self.row_of.get(&StructuralDof { grid, direction }).copied()
    }
}

/// Refuses corners that have no length or area between them, and a panel that is not convex in its mean plane.
///
/// # Errors
/// Another number of corners than the kind has, a rod whose ends coincide to working precision, a triangle whose corners lie on a line, and
/// a panel with parallel diagonals or an interior angle of 180° or more.
pub fn check_corners(label: usize, kind: ElementKind, corners: &[Point]) -> Result<()> {
    let count = kind.corner_count();
    check_count("corners of an element", corners.len(), count, count)?;
    let side = |a: usize, b: usize| corners[b % count] - corners[a % count];
    let owner = || format!("element {label}");
    if kind == ElementKind::Rod {
        let ratio = side(0, 1).norm() / (corners[0].norm() + corners[1].norm());
        return require(
            ratio > SMALLEST_LENGTH_RATIO,
            "relative length",
            owner,
            ratio,
            "above 1e-12",
        );
    }
    // The diagonals of a panel, or two sides of a triangle, whose third is side 2-3.
    let (d13, d24) = (side(0, 2), side(1, 3));
    let normal = d13.cross(&d24);
    let longest = d13.norm().max(d24.norm()).max(side(1, 2).norm());
    let ratio = 0.5 * normal.norm() / longest.powi(2);
    require(
        ratio > SMALLEST_AREA_RATIO,
        "relative area",
        owner,
        ratio,
        "above 1e-10",
    )?;
    // Every angle of a triangle is less.
    (1..=count).try_for_each(|corner| {
        let turn = side(corner - 1, corner).cross(&side(corner - 1, corner + count - 2));
        let ratio = turn.dot(&normal) / normal.norm_squared();
        let owner = || format!("corner {corner} of element {label}");
        let convex = "above 1e-10, its interior angle below 180 degrees";
        require(
            ratio > SMALLEST_AREA_RATIO,
            "relative area",
            owner,
            ratio,
            convex,
        )
    })
}
