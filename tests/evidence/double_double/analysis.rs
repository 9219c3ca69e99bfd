//! The finite element analysis of the box, its pairing and its errors, in double-double.

use super::elements::{Material, Point, load_distribution, number};
use super::noise::Noise;
use crate::common::double_double::Dd;
use crate::common::double_double_matrices::{
    Rows, eigen, inverse, product, rows, solve, transposed_product,
};
use corfem::method::structure::ElementKind;
use corfem::torque_box::Case;
use corfem::torque_box::wing_box::{PANEL_COUNT, rod_ends};

/// The box of a case: every panel of unit gage, and all rods together.
pub struct Box {
    panels: Vec<(Vec<usize>, Rows)>,
    rods: Rows,
    t: Rows,
    mass: Vec<Dd>,
}

/// Modes: squared circular frequencies and mass-orthonormal shapes (columns).
#[derive(Clone)]
pub struct Modes {
    pub omega_squared: Vec<Dd>,
    pub shapes: Rows,
}

/// A model seen through its exact modes beside the test modes.
pub struct Model {
    pub modes: Modes,
    pub cross: Rows,
    /// $V^t B K_e B^t V$ of every panel.
    pub shares: Vec<Rows>,
    /// The same on the test shapes relative to the test's stiffness.
    pub test_shares: Vec<Rows>,
    pub gages: Vec<Dd>,
}

/// Frequency and shape error.
#[derive(Debug, Clone, Copy)]
pub struct Errors {
    pub frequency: Dd,
    pub shape: Dd,
}

impl Errors {
    pub fn sum(&self) -> Dd {
        self.frequency + self.shape
    }
}

/// Which mode answers which test mode, with its sign, and by how much the closest pair that was passed over was behind.
#[derive(Debug, Clone)]
pub struct Pairing {
    pub mode: Vec<usize>,
    pub sign: Vec<Dd>,
    pub margin: f64,
}

impl Modes {
    pub fn lowest(&self, count: usize) -> Self {
        let shapes = self
            .shapes
            .iter()
            .map(|row| row[..count].to_vec())
            .collect();
        Self {
            omega_squared: self.omega_squared[..count].to_vec(),
            shapes,
        }
    }
}

impl Box {
    pub fn of(case: &Case) -> Self {
        let reconstruction = &case.reconstruction;
        let material = Material::of(reconstruction);
        let element = |kind: ElementKind, grids: &[usize]| {
            let corners: Vec<Point> = grids
                .iter()
                .map(|grid| reconstruction.grids[grid].map(number))
                .collect();
            let unit = material.element(kind, &corners);
            // The root's grids come last and are held.
            let dof: Vec<usize> = grids
                .iter()
                .flat_map(|grid| (0..3).map(move |axis| 3 * (grid - 1) + axis))
                .collect();
            let free: Vec<usize> = (0..dof.len()).filter(|&local| dof[local] < 36).collect();
            let at_free = rows(free.len(), free.len(), |i, j| unit[free[i]][free[j]]);
            (
                free.iter().map(|&local| dof[local]).collect::<Vec<_>>(),
                at_free,
            )
        };
        let mut rods = rows(36, 36, |_, _| Dd::ZERO);
        for ends in rod_ends() {
            add(
                &mut rods,
                &element(ElementKind::Rod, &ends),
                number(case.rod_area),
            );
        }
        Self {
            panels: case
                .panels
                .iter()
                .map(|panel| element(panel.kind, &panel.grids))
                .collect(),
            rods,
            t: load_distribution(reconstruction),
            mass: reconstruction
                .masses
                .iter()
                .map(|&mass| number(mass))
                .collect(),
        }
    }

    /// $K_D$ and $B^t$ (A.5, A.7) at gages, $K_S$ with a noise relative to its diagonal.
    fn condense(&self, gages: &[Dd], noise: &mut Noise) -> (Rows, Rows) {
        let mut stiffness = self.rods.clone();
        for (panel, &gage) in self.panels.iter().zip(gages) {
            add(&mut stiffness, panel, gage);
        }
        let scale: Vec<Dd> = (0..36).map(|i| stiffness[i][i].sqrt()).collect();
        for i in 0..36 {
            for j in 0..=i {
                let change = noise.next() * scale[i] * scale[j];
                stiffness[i][j] += change;
                stiffness[j][i] = stiffness[i][j];
            }
        }
        let deflections = solve(&stiffness, &self.t);
        let dynamic = inverse(&transposed_product(&self.t, &deflections));
        let transformation = product(&deflections, &dynamic);
        (dynamic, transformation)
    }

    fn modes_of(&self, dynamic: &Rows) -> Modes {
        let root: Vec<Dd> = self.mass.iter().map(|mass| mass.sqrt()).collect();
        let (omega_squared, vectors) =
            eigen(&rows(9, 9, |i, j| dynamic[i][j] / (root[i] * root[j])));
        Modes {
            omega_squared,
            shapes: rows(9, 9, |i, j| vectors[i][j] / root[i]),
        }
    }

    /// All nine modes at gages.
    pub fn modes(&self, gages: &[Dd], noise: &mut Noise) -> Modes {
        self.modes_of(&self.condense(gages, noise).0)
    }

    /// The model of the lowest modes at gages.
    pub fn analyze(
        &self,
        gages: &[Dd],
        test: &Modes,
        analysis_modes: usize,
        noise: &mut Noise,
    ) -> Model {
        let (dynamic, transformation) = self.condense(gages, noise);
        let modes = self.modes_of(&dynamic).lowest(analysis_modes);
        let through = |structural: &Rows, e: usize| {
            let (dof, unit) = &self.panels[e];
            let own: Rows = dof.iter().map(|&row| structural[row].clone()).collect();
            let share = transposed_product(&own, &product(unit, &own));
            rows(share.len(), share.len(), |i, j| gages[e] * share[i][j])
        };
        let [moved, test_moved] =
            [&modes, test].map(|modes| product(&transformation, &modes.shapes));
        let of_test = |e: usize| {
            let (share, squares) = (through(&test_moved, e), &test.omega_squared);
            rows(share.len(), share.len(), |i, j| {
                share[i][j] / (squares[i] * squares[j]).sqrt()
            })
        };
        Model {
            cross: rows(analysis_modes, test.omega_squared.len(), |i, j| {
                (0..9)
                    .map(|d| modes.shapes[d][i] * self.mass[d] * test.shapes[d][j])
                    .sum()
            }),
            shares: (0..PANEL_COUNT).map(|e| through(&moved, e)).collect(),
            test_shares: (0..PANEL_COUNT).map(of_test).collect(),
            gages: gages.to_vec(),
            modes,
        }
    }
}

fn add(sum: &mut Rows, (dof, unit): &(Vec<usize>, Rows), size: Dd) {
    for (a, &row) in dof.iter().enumerate() {
        for (b, &column) in dof.iter().enumerate() {
            sum[row][column] += size * unit[a][b];
        }
    }
}

/// Pairs by closeness to one (4), the closest first.
pub fn pair(cross: &Rows) -> Pairing {
    let (count, tests) = (cross.len(), cross[0].len());
    let distance = |i: usize, j: usize| (Dd::ONE - cross[i][j].abs()).abs();
    let mut mode = vec![usize::MAX; tests];
    let mut margin = f64::INFINITY;
    for _ in 0..tests {
        let open: Vec<(usize, usize)> = (0..tests)
            .filter(|&j| mode[j] == usize::MAX)
            .flat_map(|j| {
                (0..count)
                    .filter(|i| !mode.contains(i))
                    .map(move |i| (i, j))
            })
            .collect();
        let nearer = |a: (usize, usize), b: (usize, usize)| {
            if distance(b.0, b.1) < distance(a.0, a.1) {
                b
            } else {
                a
            }
        };
        let (i, j) = open
            .iter()
            .copied()
            .reduce(nearer)
            .expect("as many modes as tests");
        // Only a pair that shares its mode or its test mode competes with it.
        let rivals = open.iter().filter(|&&(a, b)| (a == i) != (b == j));
        let behind = rivals.map(|&(a, b)| (distance(a, b) - distance(i, j)).to_f64());
        margin = behind.fold(margin, f64::min);
        mode[j] = i;
    }
    let sign = (0..tests)
        .map(|j| {
            if cross[mode[j]][j] < Dd::ZERO {
                -Dd::ONE
            } else {
                Dd::ONE
            }
        })
        .collect();
    Pairing { mode, sign, margin }
}

/// The error sum (5, 6).
pub fn errors(modes: &Modes, pairing: &Pairing, test: &Modes) -> Errors {
    let largest = |shapes: &Rows, j: usize| {
        shapes
            .iter()
            .map(|row| row[j].abs())
            .fold(Dd::ZERO, Dd::larger)
    };
    let dof_count = number(test.shapes.len() as f64);
    let (mut frequency, mut shape) = (Dd::ZERO, Dd::ZERO);
    for (j, (&i, &sign)) in pairing.mode.iter().zip(&pairing.sign).enumerate() {
        let ratio = (modes.omega_squared[i] / test.omega_squared[j]).sqrt() - Dd::ONE;
        frequency += ratio * ratio;
        let (analyzed, tested) = (
            sign / largest(&modes.shapes, i),
            largest(&test.shapes, j).recip(),
        );
        for (v, w) in modes.shapes.iter().zip(&test.shapes) {
            let difference = v[i] * analyzed - w[j] * tested;
            shape += difference * difference / dof_count;
        }
    }
    Errors {
        frequency: frequency.sqrt(),
        shape: shape.sqrt(),
    }
}
