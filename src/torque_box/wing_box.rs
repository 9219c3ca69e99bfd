//! The paper's wing torque box: topology from its Table 2, coordinates and masses from `paper/reconstruction.toml`.
//!
//! Sixteen grids in four ribs: each rib has two on the rear spar (upper, then lower) and two on the front spar
//! (upper, then lower). Rib 1-4 is the tip, 5-8 outboard, 9-12 inboard, 13-16 the root, which is fixed.
//! Nine dynamic points with z motion alone lie at mid-depth, three to a free rib: rear spar, mid chord, front spar.

use crate::method::error::{Error, positive, require};
use crate::method::linear_algebra::check_length;
use crate::method::structure::{Element, ElementKind, Grid, Material, Structure};
use crate::torque_box::error::{CaseError, read_toml};
use nalgebra::{DMatrix, DVector, Vector3};
use serde::Deserialize;
use std::collections::BTreeMap;

/// Panels of the box, elements 1 to 15.
pub const PANEL_COUNT: usize = 15;
/// Cover panels.
pub const COVERS: [usize; 6] = [2, 4, 8, 9, 11, 15];
/// Gage of every panel in the test configuration, in.
pub const TEST_GAGE: f64 = 0.010;
/// Number of ribs that move.
const FREE_RIBS: usize = 3;
/// Grids per rib.
const RIB_GRIDS: usize = 4;
/// Grids of the box, numbered from 1.
const GRID_COUNT: usize = (FREE_RIBS + 1) * RIB_GRIDS;
/// First grid of the root.
const FIRST_FIXED_GRID: usize = FREE_RIBS * RIB_GRIDS + 1;

/// Coordinates, masses and material of the box, which the paper never printed.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reconstruction {
    /// Young's modulus, lbf/in².
    pub youngs_modulus: f64,
    /// Poisson's ratio.
    pub poissons_ratio: f64,
    /// Position of the mid dynamic point of a rib, as a fraction of the chord from the rear spar.
    pub mid_chord_fraction: f64,
    /// Dynamic masses, lbf·s²/in: tip rear, mid, front; outboard; inboard.
    pub masses: Vec<f64>,
    /// Grid positions, in, by grid number: x aft, y outboard, z up.
    pub grids: BTreeMap<usize, [f64; 3]>,
}

impl Reconstruction {
    /// The box that comes with the crate.
    ///
    /// # Errors
    /// The errors of [`Self::parse`], if the data file were damaged.
    pub fn embedded() -> Result<Self, CaseError> {
        Self::parse(
            "paper/reconstruction.toml",
            include_str!("../../paper/reconstruction.toml"),
        )
    }

    /// Reads a box from TOML text; `name` stands in error messages.
    ///
    /// # Errors
    /// [`CaseError::Toml`] for text of another form; [`Error::WrongShape`] unless there are 16 grids and 9 masses;
    /// [`CaseError::MissingGrid`] unless the grids are 1 to 16;
    /// [`Error::Value`] for a mid-chord fraction not between 0 and 1.
    pub fn parse(name: &str, text: &str) -> Result<Self, CaseError> {
        let read: Self = read_toml(name, "a torque box: material, masses and grids", text)?;
        check_length("box grids", read.grids.len(), GRID_COUNT)?;
        check_length("box masses", read.masses.len(), 3 * FREE_RIBS)?;
        if let Some(grid) = (1..=GRID_COUNT).find(|grid| !read.grids.contains_key(grid)) {
            return Err(CaseError::MissingGrid {
                grid,
                count: GRID_COUNT,
            });
        }
        let fraction = read.mid_chord_fraction;
        let (is_met, owner) = (fraction > 0.0 && fraction < 1.0, || "torque box".into());
        let expected = "a number between 0 and 1";
        require(is_met, "mid_chord_fraction", owner, fraction, expected)?;
        Ok(read)
    }

    /// Position of a grid, in.
    fn at(&self, grid: usize) -> Result<Vector3<f64>, CaseError> {
        let position = self.grids.get(&grid).ok_or(CaseError::MissingGrid {
            grid,
            count: GRID_COUNT,
        })?;
        Ok(Vector3::from(*position))
    }

    /// The diagonal dynamic mass matrix $M$, lbf·s²/in (9 × 9).
    pub fn mass(&self) -> DMatrix<f64> {
        DMatrix::from_diagonal(&DVector::from_column_slice(&self.masses))
    }
}

/// One panel of Table 2: its number, corner grids, kind and gage.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Element number, 1 to 15.
    pub label: usize,
    /// Corner grids in the order of Table 2.
    pub grids: Vec<usize>,
    /// Shear panel or membrane.
    pub kind: ElementKind,
    /// Gage, in.
    pub gage: f64,
}

/// RMS relative error of the gages of one kind of panel against [`TEST_GAGE`]; NaN when there is none of the kind.
pub fn gage_rms(panels: &[Panel], gages: &[f64], kind: ElementKind) -> f64 {
    let gages = panels
        .iter()
        .zip(gages)
        .filter(|(panel, _)| panel.kind == kind);
    rms(&gages
        .map(|(_, gage)| gage / TEST_GAGE - 1.0)
        .collect::<Vec<_>>())
}

/// Root mean square of a list; NaN for an empty one.
pub fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}

/// The 24 rods, by their end grids, elements 16 to 39: twelve spar caps (rear upper, rear lower, front upper,
/// front lower, each from the tip in), then for every free rib its two posts and its two caps.
pub fn rod_ends() -> Vec<[usize; 2]> {
    let mut rods = Vec::new();
    for line in 1..=RIB_GRIDS {
        rods.extend(
            (0..FREE_RIBS).map(|rib| [line + RIB_GRIDS * rib, line + RIB_GRIDS * (rib + 1)]),
        );
    }
    for rib in 0..FREE_RIBS {
        let [rear_upper, rear_lower, front_upper, front_lower] = rib_grids(rib);
        rods.extend([[rear_upper, rear_lower], [front_upper, front_lower]]);
        rods.extend([[rear_upper, front_upper], [rear_lower, front_lower]]);
    }
    rods
}

/// Grid numbers of a rib counted from the tip: rear upper, rear lower, front upper, front lower.
fn rib_grids(rib: usize) -> [usize; 4] {
    std::array::from_fn(|k| RIB_GRIDS * rib + k + 1)
}

/// The box as a structure: given panels, and 24 rods of one area (in²).
///
/// # Errors
/// The errors of [`Material::isotropic`] for the material and of [`Structure::new`] for grids and elements.
pub fn structure(
    reconstruction: &Reconstruction,
    panels: &[Panel],
    rod_area: f64,
) -> Result<Structure, Error> {
    let material =
        Material::isotropic(reconstruction.youngs_modulus, reconstruction.poissons_ratio)?;
    let grids = reconstruction.grids.iter().map(|(&label, &position)| {
        let constrained = [label >= FIRST_FIXED_GRID; 3];
        Grid {
            label,
            position: Vector3::from(position),
            constrained,
        }
    });
    let element = |label, kind, grids, size| Element {
        label,
        kind,
        grids,
        size,
        material,
    };
    let panels = panels
        .iter()
        .map(|panel| element(panel.label, panel.kind, panel.grids.clone(), panel.gage));
    let rods = (PANEL_COUNT + 1..).zip(rod_ends());
    let rods = rods.map(|(label, ends)| element(label, ElementKind::Rod, ends.to_vec(), rod_area));
    Structure::new(grids.collect(), panels.chain(rods).collect())
}

/// The load distribution $T$ of the box (36 × 9), columns rear, mid, front of each free rib from the tip in.
///
/// A point on a spar shares its load equally between the spar's upper and lower grid. The mid point rides on the
/// rib as on a beam clamped to both spars: with $\xi$ its fraction of the rib length $L$ from the rear spar and
/// Hermite's cubics
///
/// $$ H_1 = 1-3\xi^2+2\xi^3, \quad H_2 = \xi-2\xi^2+\xi^3, \quad H_3 = 3\xi^2-2\xi^3, \quad H_4 = \xi^3-\xi^2, $$
/// $$ w = H_1 w_r + H_2 L\theta_r + H_3 w_f + H_4 L\theta_f, \qquad w_r = \tfrac12(z_u + z_l), \qquad
///    \theta_r = -\frac{u_u - u_l}{h_r}, $$
///
/// $u$ the motion along the rib and $h$ the depth. So a load there becomes the clamped beam's end forces and end
/// moments, the moments as couples of in-plane forces on upper and lower grid. An average of the two spars
/// instead would make the dynamic flexibility singular.
///
/// # Errors
/// [`Error::Value`] when the spars of a rib meet or a spar has no depth there; [`CaseError::MissingGrid`].
pub fn load_distribution(reconstruction: &Reconstruction) -> Result<DMatrix<f64>, CaseError> {
    let xi = reconstruction.mid_chord_fraction;
    let hermite = [
        1.0 - 3.0 * xi.powi(2) + 2.0 * xi.powi(3),
        xi - 2.0 * xi.powi(2) + xi.powi(3),
        3.0 * xi.powi(2) - 2.0 * xi.powi(3),
        xi.powi(3) - xi.powi(2),
    ];
    let at = |grid| reconstruction.at(grid);
    let mut t = DMatrix::zeros(3 * RIB_GRIDS * FREE_RIBS, 3 * FREE_RIBS);
    for rib in 0..FREE_RIBS {
        let [rear_upper, rear_lower, front_upper, front_lower] = rib_grids(rib);
        let chord = (at(front_upper)? - at(rear_upper)?).xy();
        let length = nonzero(chord.norm())?;
        let along = chord / length;
        let [rear, mid, front] = [3 * rib, 3 * rib + 1, 3 * rib + 2];
        for (upper, lower, own, displacement, rotation) in [
            (rear_upper, rear_lower, rear, hermite[0], hermite[1]),
            (front_upper, front_lower, front, hermite[2], hermite[3]),
        ] {
            let depth = nonzero(at(upper)?.z - at(lower)?.z)?;
            let couple = rotation * length / depth;
            for (grid, sign) in [(upper, -1.0), (lower, 1.0)] {
                let row = 3 * (grid - 1);
                t[(row + 2, own)] = 0.5;
                t[(row + 2, mid)] = displacement / 2.0;
                t[(row, mid)] = sign * couple * along.x;
                t[(row + 1, mid)] = sign * couple * along.y;
            }
        }
    }
    Ok(t)
}

fn nonzero(length: f64) -> Result<f64, Error> {
    positive("length", || "a rib's chord or depth".into(), length).map(|()| length)
}

/// Positions of the nine dynamic points, in: at mid-depth of every free rib, rear, mid, front, from the tip in.
///
/// # Errors
/// [`CaseError::MissingGrid`] for a box without a grid it must have.
pub fn dynamic_points(reconstruction: &Reconstruction) -> Result<Vec<Vector3<f64>>, CaseError> {
    let middle = |one, other| {
        Ok::<_, CaseError>(0.5 * (reconstruction.at(one)? + reconstruction.at(other)?))
    };
    let of_rib = |rib| {
        let [rear_upper, rear_lower, front_upper, front_lower] = rib_grids(rib);
        let (rear, front) = (
            middle(rear_upper, rear_lower)?,
            middle(front_upper, front_lower)?,
        );
        Ok([
            rear,
            rear + reconstruction.mid_chord_fraction * (front - rear),
            front,
        ])
    };
    Ok((0..FREE_RIBS)
        .map(of_rib)
        .collect::<Result<Vec<_>, CaseError>>()?
        .concat())
}
