//! A wing of any size: a swept, tapered, twisted box of ribs and spars.
//!
//! Rods lie between neighboring grids, a shear panel in every cell of a rib or spar, membranes on both surfaces; the root is held.
//! So no grid can move freely, whatever the numbers are. $x$ points aft, $y$ outboard, $z$ up; ribs lie along the stream.

pub mod whole;

use corfem::method::error::Error;
use corfem::method::model::{FiniteElementModel, Parameter};
use corfem::method::structure::{Element, ElementKind, Grid, Material, Structure};
use corfem::sparse::{SparseMatrix, WholeModel};
use nalgebra::{DMatrix, Vector3};
use whole::of_elements;

/// Factors from 0.75 to 1.3 that the groups of a wing want.
pub fn planted_factors(count: usize) -> Vec<f64> {
    let pattern = [1.0, 1.2, 0.8, 1.1, 0.75, 1.0, 1.3, 0.9];
    pattern.into_iter().cycle().take(count).collect()
}

/// Sorts of members, each of which is divided into zones along the span.
pub const SORTS: [&str; 5] = [
    "covers",
    "spar webs",
    "rib webs",
    "spanwise caps",
    "posts and rib caps",
];
/// Names and bays of the wings whose costs are measured: 1,458, 10,098, 100,116 and 1,002,000 structural DOF.
pub const MESHES: [(&str, [usize; 3]); 4] = [
    ("1k", [27, 8, 1]),
    ("10k", [99, 16, 1]),
    ("100k", [309, 53, 1]),
    ("1M", [1000, 166, 1]),
];

/// Dimensions and numbers of a wing; by default those of one like the paper's large example, with 108 measured points and 25
/// groups. Webs and rods are given as totals that all of a sort share alike: wings of unlike meshes weigh and bend alike.
#[derive(Debug, Clone, PartialEq)]
pub struct Wing {
    /// Bays between ribs, bays between spars, cells between lower and upper surface.
    pub bays: [usize; 3],
    /// Chord of the box at root and tip, in.
    pub chords: [f64; 2],
    /// Span of one wing, in.
    pub span: f64,
    /// Sweep aft of the line at half the chord, and twist of the tip about it, nose up, degrees.
    pub angles: [f64; 2],
    /// Depth of the box over its chord.
    pub thickness: f64,
    /// Gage of the covers, of the spar webs of a section together, and of all rib webs together, in.
    pub gages: [f64; 3],
    /// Areas together of the spanwise caps of a section, of all caps of the ribs, of all posts, in².
    pub areas: [f64; 3],
    /// What everything is made of.
    pub material: Material,
    /// Mass on all measured points together, alike on each, lbf·s²/in.
    pub mass: f64,
    /// Zones of equal numbers of bays along the span; each sort has a group in each.
    pub zones: usize,
    /// Ribs with measured points, from the tip in at equal distances, and points on each, from the leading edge on.
    pub measured: [usize; 2],
}

impl Default for Wing {
    fn default() -> Self {
        Self {
            bays: MESHES[0].1,
            chords: [80.0, 32.0],
            span: 300.0,
            angles: [25.0, -3.0],
            thickness: 0.12,
            gages: [0.08, 0.54, 1.08],
            areas: [5.4, 5.4, 24.3],
            material: Material {
                youngs_modulus: 1.04e7,
                poissons_ratio: 0.3,
                shear_modulus: 4.0e6,
                density: 0.0,
            },
            mass: 6.0,
            zones: 5,
            measured: [27, 4],
        }
    }
}

impl Wing {
    /// The wing of one of the [`MESHES`]; none for another name.
    pub fn named(name: &str) -> Option<Self> {
        let &(_, bays) = MESHES.iter().find(|(known, _)| *known == name)?;
        Some(Self {
            bays,
            ..Self::default()
        })
    }

    /// Number of a grid by its rib from the root, line from the leading edge and level from the lower surface, each from zero.
    pub fn grid(&self, [rib, line, level]: [usize; 3]) -> usize {
        1 + level + (self.bays[2] + 1) * (line + (self.bays[1] + 1) * rib)
    }

    /// Where a grid is, in.
    fn position(&self, place: [usize; 3]) -> Vector3<f64> {
        let [outboard, line, level] =
            [0, 1, 2].map(|axis| place[axis] as f64 / self.bays[axis] as f64);
        let (y, chord) = (
            self.span * outboard,
            self.chords[0] + (self.chords[1] - self.chords[0]) * outboard,
        );
        let (aft, up) = (chord * (line - 0.5), chord * self.thickness * (level - 0.5));
        let [sweep, twist] = self.angles.map(f64::to_radians);
        let (sin, cos) = (twist * outboard).sin_cos();
        Vector3::new(
            y * sweep.tan() + cos * aft + sin * up,
            y,
            cos * up - sin * aft,
        )
    }

    /// Every element but those in the held root, numbered from one, sort by sort; with its sort and its bay along the span.
    fn members(&self) -> Vec<(usize, usize, Element)> {
        let [none, along, aft, up] = [[0; 3], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
        let (ribs, lines, levels) = (self.bays[0], self.bays[1] + 1, self.bays[2] + 1);
        let ([covers, spars, rib_webs], [caps, rib_caps, posts]) = (self.gages, self.areas);
        let mut members = Vec::new();
        for (sort, kind, [one, other], total, sharing) in [
            (0, ElementKind::Membrane, [along, aft], covers, 1),
            (1, ElementKind::ShearPanel, [along, up], spars, lines),
            (2, ElementKind::ShearPanel, [aft, up], rib_webs, ribs),
            (3, ElementKind::Rod, [along, none], caps, lines * levels),
            (4, ElementKind::Rod, [aft, none], rib_caps, ribs * levels),
            (4, ElementKind::Rod, [up, none], posts, ribs * lines),
        ] {
            // Of the levels covers have the outer two.
            let step = if kind == ElementKind::Membrane {
                self.bays[2]
            } else {
                1
            };
            let (lines, size) = (lines - one[1] - other[1], total / sharing as f64);
            for (bay, line) in (0..ribs).flat_map(|bay| (0..lines).map(move |line| (bay, line))) {
                for level in (0..levels - one[2] - other[2]).step_by(step) {
                    // What does not run along the span stands at the outer end of its bay.
                    let first = [bay + 1 - one[0], line, level];
                    let at = |(m, n)| {
                        self.grid(
                            [0, 1, 2].map(|axis| first[axis] + m * one[axis] + n * other[axis]),
                        )
                    };
                    let corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(at);
                    let (label, grids) =
                        (members.len() + 1, corners[..kind.corner_count()].to_vec());
                    members.push((
                        sort,
                        bay,
                        Element {
                            label,
                            kind,
                            grids,
                            size,
                            material: self.material,
                        },
                    ));
                }
            }
        }
        members
    }

    /// The wing as a structure.
    ///
    /// # Errors
    /// Those of [`Structure::new`].
    pub fn structure(&self) -> Result<Structure, Error> {
        let (lines, levels) = (self.bays[1] + 1, self.bays[2] + 1);
        let grid = |n: usize| {
            let place = [n / (lines * levels), n / levels % lines, n % levels];
            Grid {
                label: self.grid(place),
                position: self.position(place),
                constrained: [place[0] == 0; 3],
            }
        };
        let grids = (0..(self.bays[0] + 1) * lines * levels).map(grid).collect();
        Structure::new(
            grids,
            self.members()
                .into_iter()
                .map(|(.., element)| element)
                .collect(),
        )
    }

    /// Rib and line of every measured point, rib by rib from the root out.
    fn points(&self) -> Vec<[usize; 2]> {
        let ([ribs, chord, _], [on_span, on_rib]) = (self.bays, self.measured);
        let nearest = |k: usize, parts: usize, of: usize| (2 * k * of + parts) / (2 * parts);
        let on = |rib| (0..on_rib).map(move |k| [rib, nearest(k, on_rib.max(2) - 1, chord)]);
        (1..=on_span)
            .flat_map(|k| on(nearest(k, on_span, ribs)))
            .collect()
    }

    /// $T$: the deflection $z$ of the wing at every measured point, the mean of both surfaces.
    ///
    /// # Errors
    /// Those of [`SparseMatrix::new`].
    fn load_distribution(&self, structure: &Structure) -> Result<SparseMatrix, Error> {
        let points = self.points();
        let entries = points.iter().enumerate().flat_map(|(at, &[rib, line])| {
            [0, self.bays[2]].into_iter().filter_map(move |level| {
                let row = structure.free_dof_index(self.grid([rib, line, level]), 2)?;
                Some((row, at, 0.5))
            })
        });
        let count = structure.free_dof().len();
        SparseMatrix::new("load distribution", count, points.len(), entries.collect())
    }

    /// The mass of the measured points.
    fn point_mass(&self) -> DMatrix<f64> {
        let count = self.points().len();
        DMatrix::from_diagonal_element(count, count, self.mass / count as f64)
    }

    /// A parameter per group.
    pub fn parameters(&self) -> Vec<Parameter> {
        let (ribs, zones) = (self.bays[0], self.zones);
        let mut groups = vec![Vec::new(); SORTS.len() * zones];
        for (sort, bay, element) in self.members() {
            groups[sort * zones + bay * zones / ribs].push(element.label);
        }
        let name = |group: usize| format!("{} {}", SORTS[group / zones], group % zones + 1);
        let groups = groups.iter().enumerate();
        groups
            .map(|(group, labels)| Parameter::new(name(group), labels))
            .collect()
    }

    /// The wing as a model: a parameter per group, the measured points as dynamic DOF with the mass on them.
    ///
    /// # Errors
    /// Those of [`Self::structure`] and [`FiniteElementModel::new`].
    pub fn model(&self) -> Result<FiniteElementModel, Error> {
        let structure = self.structure()?;
        let t = self.load_distribution(&structure)?.dense();
        FiniteElementModel::new(structure, t, self.point_mass(), self.parameters())
    }

    /// The same model at all its degrees of freedom, and what reads the measured points.
    ///
    /// # Errors
    /// Those of [`Self::structure`] and of the whole model.
    pub fn whole(&self) -> Result<(WholeModel, SparseMatrix), Error> {
        let (structure, parameters) = (self.structure()?, self.parameters());
        let (t, ranges) = (
            self.load_distribution(&structure)?,
            vec![None; parameters.len()],
        );
        let whole = of_elements(&structure, &t, &self.point_mass(), &parameters, &ranges)?;
        Ok((whole, t.transposed()))
    }
}
