//! A second structure: the delta wing of NACA TN 3114, which nobody here can tune.
//!
//! MacNeal and Benscoter analyzed it on an electric analog computer, Zender tested it (NACA TN 3913), and NASA keeps it
//! as NASTRAN's demonstration problem D01-01-1. Its planform is a rule. Grids lie on five lines along the span, at
//! $y = 0, 20, \dots, 80$ in forward of the trailing edge, where stations at $x = 0, 10, 30, 50, 70, 90$ in outboard of
//! the root's center cross them behind the leading edge
//!
//! $$ x + y \le 110\ \text{in}, $$
//!
//! which is swept by 45°. The wing is a quarter of the whole: the other wing moves alike, and the lower surface is the
//! upper one's mirror image and moves against it in the plane. So mid-plane grids keep to $z$, those of the upper
//! surface at $x = 0$ to $y$ and $z$, and the wing is supported along $z$ where its upper surface crosses the side of
//! the body, $x = 30$ in.
//!
//! Depths and sizes are data, in `paper/delta_wing.toml`; `paper/delta_wing.md` tells where they come from.
//! [`correlation`] corrects a wing of wrong gages with modes of this one.

mod answers;
pub mod correlation;

pub use answers::{MEASURED_GRIDS, TipLoad, known_deflections, known_frequencies};

use corfem::method::error::Error;
use corfem::method::structure::{Element, ElementKind, Grid, Material, Structure};
use nalgebra::Vector3;
use serde::Deserialize;

/// Stations outboard of the root's center, in.
const STATIONS: [f64; 6] = [0.0, 10.0, 30.0, 50.0, 70.0, 90.0];
/// Lines forward of the trailing edge, in.
const LINES: [f64; 5] = [0.0, 20.0, 40.0, 60.0, 80.0];
/// Where the leading edge is: the sum of both coordinates, in.
const LEADING_EDGE: f64 = 110.0;
/// The station at the side of the body, where the wing is supported.
const SUPPORTED_STATION: usize = 2;
/// Grid numbers from one line to the next.
const LINE_STEP: usize = 20;
/// Grid numbers from the mid-plane to the upper surface.
const SURFACE_STEP: usize = 10;

/// Kind, grids and size of an element.
type Member = (ElementKind, Vec<usize>, f64);

/// Material, depths and sizes of the wing.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DeltaWing {
    /// Young's modulus of sheet and rods, lbf/in².
    pub youngs_modulus: f64,
    /// Poisson's ratio.
    pub poissons_ratio: f64,
    /// Mass density of covers and webs, lbf·s²/in⁴.
    pub sheet_density: f64,
    /// Gage of every cover panel, in.
    pub cover_gage: f64,
    /// Gage of every web, in.
    pub web_gage: f64,
    /// Load on one grid of the tip, downward, lbf.
    pub tip_load: f64,
    /// Half depths, in: by line, then by station.
    pub half_depths: Vec<Vec<f64>>,
    /// Areas of the posts between mid-plane and upper surface, in²: by line, then by station.
    pub post_areas: Vec<Vec<f64>>,
    /// Areas of the caps along the lines, in²: by line, from the root out.
    pub spanwise_cap_areas: Vec<Vec<f64>>,
    /// Areas of the caps along the stations, in²: by station from $x = 10$ in, from the trailing edge forward.
    pub chordwise_cap_areas: Vec<Vec<f64>>,
    /// Areas of the caps along the leading edge, in², from the root out.
    pub leading_edge_cap_areas: Vec<f64>,
}

impl DeltaWing {
    /// The wing of `paper/delta_wing.toml`.
    pub fn embedded() -> Self {
        toml::from_str(include_str!("../../../delta_wing.toml")).expect("a delta wing")
    }

    /// The wing as a structure: 48 grids; 14 membranes and 3 triangles (covers, 1 to 17), 36 shear panels (webs, 18 to
    /// 53) and 60 rods (posts, 60 to 83, and caps, 100 to 135), numbered as NASA's deck numbers them.
    ///
    /// # Errors
    /// Those of [`Material::isotropic`] and [`Structure::new`].
    pub fn structure(&self) -> Result<Structure, Error> {
        let rods = Material::isotropic(self.youngs_modulus, self.poissons_ratio)?;
        let sheet = Material {
            density: self.sheet_density,
            ..rods
        };
        let mut elements = Vec::new();
        // From the first numbers of each sort in NASA's deck.
        for (first, members, material) in [
            (1, self.covers(), sheet),
            (18, self.webs(), sheet),
            (60, self.posts(), rods),
            (100, self.caps(), rods),
        ] {
            let element = |(label, (kind, grids, size))| Element {
                label,
                kind,
                grids,
                size,
                material,
            };
            elements.extend((first..).zip(members).map(element));
        }
        Structure::new(self.grids(), elements)
    }

    fn grids(&self) -> Vec<Grid> {
        let mut grids = Vec::new();
        for (line, depths) in self.half_depths.iter().enumerate() {
            for (station, &depth) in depths.iter().enumerate() {
                let at = |label, z, constrained| {
                    let position = Vector3::new(STATIONS[station], LINES[line], z);
                    Grid {
                        label,
                        position,
                        constrained,
                    }
                };
                let upper = [station == 0, false, station == SUPPORTED_STATION];
                grids.push(at(mid_grid(line, station), 0.0, [true, true, false]));
                grids.push(at(upper_grid(line, station), depth, upper));
            }
        }
        grids.sort_by_key(|grid| grid.label);
        grids
    }

    /// Between two lines a membrane in every bay, and a triangle where the leading edge cuts one.
    fn covers(&self) -> Vec<Member> {
        let mut covers = Vec::new();
        for line in 1..LINES.len() {
            let (aft, forward) = (line - 1, line);
            for station in 1..stations_on(aft) {
                let [root, tip] = [station - 1, station].map(|s| upper_grid(aft, s));
                let inboard = upper_grid(forward, station - 1);
                let (kind, grids) = match station < stations_on(forward) {
                    true => (
                        ElementKind::Membrane,
                        vec![root, tip, upper_grid(forward, station), inboard],
                    ),
                    false => (ElementKind::Triangle, vec![root, tip, inboard]),
                };
                covers.push((kind, grids, self.cover_gage));
            }
        }
        covers
    }

    /// Along the lines, along the stations but the first, and along the leading edge from the tip in.
    fn webs(&self) -> Vec<Member> {
        let mut sides = [along_lines(), along_stations()].concat();
        sides.extend(leading_edge().windows(2).map(|pair| [pair[0], pair[1]]));
        let web = |[a, b]: [usize; 2]| vec![a, b, b + SURFACE_STEP, a + SURFACE_STEP];
        sides
            .into_iter()
            .map(|side| (ElementKind::ShearPanel, web(side), self.web_gage))
            .collect()
    }

    fn posts(&self) -> Vec<Member> {
        let post = |line, station| vec![mid_grid(line, station), upper_grid(line, station)];
        let of_line = |(line, areas): (usize, &Vec<f64>)| {
            (0..)
                .zip(areas.clone())
                .map(move |(station, area)| (ElementKind::Rod, post(line, station), area))
        };
        self.post_areas
            .iter()
            .enumerate()
            .flat_map(of_line)
            .collect()
    }

    /// Over the webs, those of the leading edge from the root out.
    fn caps(&self) -> Vec<Member> {
        let mut sides = [along_lines(), along_stations()].concat();
        sides.extend(
            leading_edge()
                .windows(2)
                .rev()
                .map(|pair| [pair[1], pair[0]]),
        );
        let areas = (self.spanwise_cap_areas.iter().flatten())
            .chain(self.chordwise_cap_areas.iter().flatten())
            .chain(&self.leading_edge_cap_areas);
        let cap = |ends: [usize; 2]| ends.map(|grid| grid + SURFACE_STEP).to_vec();
        sides
            .into_iter()
            .zip(areas)
            .map(|(ends, &area)| (ElementKind::Rod, cap(ends), area))
            .collect()
    }
}

/// How many stations a line has behind the leading edge.
fn stations_on(line: usize) -> usize {
    STATIONS
        .iter()
        .filter(|x| **x + LINES[line] <= LEADING_EDGE)
        .count()
}

/// How many lines a station has behind the leading edge.
fn lines_at(station: usize) -> usize {
    LINES
        .iter()
        .filter(|y| STATIONS[station] + **y <= LEADING_EDGE)
        .count()
}

/// Number of the grid in the mid-plane.
fn mid_grid(line: usize, station: usize) -> usize {
    LINE_STEP * line + station + 1
}

/// Number of the grid on the upper surface.
fn upper_grid(line: usize, station: usize) -> usize {
    mid_grid(line, station) + SURFACE_STEP
}

/// Mid-plane grids at the ends of every member along a line, line by line from the root out.
fn along_lines() -> Vec<[usize; 2]> {
    let side = |line, station| [mid_grid(line, station - 1), mid_grid(line, station)];
    (0..LINES.len())
        .flat_map(|line| (1..stations_on(line)).map(move |station| side(line, station)))
        .collect()
}

/// The same along every station but the first: nothing shears the plane of symmetry.
fn along_stations() -> Vec<[usize; 2]> {
    let side = |line, station| [mid_grid(line - 1, station), mid_grid(line, station)];
    (1..STATIONS.len())
        .flat_map(|station| (1..lines_at(station)).map(move |line| side(line, station)))
        .collect()
}

/// Mid-plane grids on the leading edge, from the tip in.
fn leading_edge() -> Vec<usize> {
    (1..LINES.len())
        .map(|line| mid_grid(line, stations_on(line) - 1))
        .collect()
}
