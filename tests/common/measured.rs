//! Measured modes: structures without supports and with them, exact modes, and the ways a test goes wrong.

use crate::prelude::*;

/// A structure that nothing holds, with a diagonal mass.
#[derive(Debug, Clone)]
pub struct FreeStructure {
    pub stiffness: DMatrix<f64>,
    pub mass: DMatrix<f64>,
    pub dofs: Vec<MeasuringPoint>,
}

impl FreeStructure {
    /// Position of each DOF along x.
    pub fn x(&self) -> DVector<f64> {
        DVector::from_iterator(self.dofs.len(), self.dofs.iter().map(|dof| dof.position.x))
    }

    /// The same structure on springs to ground at every DOF, `rates` times its mass there (rad²/s²). No suspension mode
    /// lies above the largest rate, by Rayleigh's quotient.
    pub fn suspended(&self, rates: &[f64]) -> DMatrix<f64> {
        let rates = diagonal(rates);
        &self.stiffness + rates * &self.mass
    }

    /// Elastic modes through nalgebra, the lowest `rigid` left out.
    pub fn elastic_modes(&self, rigid: usize) -> Modes {
        let root = self.mass.diagonal().map(|m| m.sqrt().recip());
        let root = DMatrix::from_diagonal(&root);
        let eigen = SymmetricEigen::new(&root * &self.stiffness * &root);
        let mut order = (0..self.dofs.len()).collect_vec();
        order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
        let elastic = &order[rigid..];
        let frequencies = elastic
            .iter()
            .map(|&mode| eigen.eigenvalues[mode].sqrt() / (2.0 * PI))
            .collect_vec();
        let shapes = root * eigen.eigenvectors.select_columns(elastic);
        Modes::from_measured(&frequencies, &shapes)
            .unwrap()
            .scaled_with(&self.mass)
            .unwrap()
    }
}

/// A free–free beam in plunge and pitch: 5 to 8 masses of 0.5 to 1 lbf·s²/in on rigid links of 5 to 40 in, hinged at
/// the masses with springs of 1e5 to 1e7 lbf·in/rad. It starts within 200 in of the reference axis, so that {1} and {x}
/// stay apart; the masses are of one size so that every one of them matters to the balance.
pub fn free_beam() -> impl Strategy<Value = FreeStructure> {
    (5..=8_usize).prop_flat_map(|count| {
        (
            -200.0..200.0_f64,
            prop::collection::vec(5.0..40.0_f64, count - 1),
            prop::collection::vec(5.0..7.0_f64, count - 2),
            prop::collection::vec(0.5..1.0_f64, count),
        )
            .prop_map(move |(start, links, decades, masses)| {
                let mut stiffness = zero_square(count);
                for (hinge, decade) in decades.iter().enumerate() {
                    let (before, after) = (links[hinge].recip(), links[hinge + 1].recip());
                    let mut turn = DVector::zeros(count);
                    turn[hinge] = before;
                    turn[hinge + 1] = -before - after;
                    turn[hinge + 2] = after;
                    stiffness += 10_f64.powf(*decade) * &turn * turn.transpose();
                }
                let mut x = start;
                let dofs = (0..count)
                    .map(|point| {
                        if point > 0 {
                            x += links[point - 1];
                        }
                        MeasuringPoint {
                            position: Vector3::new(x, 0.0, 0.0),
                            direction: Vector3::z_axis(),
                        }
                    })
                    .collect();
                FreeStructure {
                    stiffness,
                    mass: diagonal(masses),
                    dofs,
                }
            })
    })
}

/// A free truss of five joints within 5 in of a tetrahedron of 40 in and its far corner, a rod of 0.1 to 1 in² between
/// every two, masses of 0.5 to 1 lbf·s²/in moving along x, y and z: all six rigid-body motions, nine elastic modes.
pub fn free_truss() -> impl Strategy<Value = FreeStructure> {
    const JOINTS: [[f64; 3]; 5] = [
        [0.0, 0.0, 0.0],
        [40.0, 0.0, 0.0],
        [0.0, 40.0, 0.0],
        [0.0, 0.0, 40.0],
        [40.0, 40.0, 40.0],
    ];
    (
        prop::collection::vec(-5.0..5.0_f64, 15),
        prop::collection::vec(0.1..1.0_f64, 10),
        prop::collection::vec(0.5..1.0_f64, 5),
    )
        .prop_map(|(shift, areas, masses)| {
            let joints = (0..5)
                .map(|j| {
                    Vector3::from(JOINTS[j]) + Vector3::from_column_slice(&shift[3 * j..3 * j + 3])
                })
                .collect_vec();
            let mut stiffness = zero_square(15);
            let mut area = areas.iter();
            for a in 0..5 {
                for b in a + 1..5 {
                    let unit = rod(&[joints[a], joints[b]], 1.0e7);
                    let unit = unit * *area.next().unwrap();
                    for (row, corner_row) in [a, b].into_iter().enumerate() {
                        for (column, corner_column) in [a, b].into_iter().enumerate() {
                            let mut block =
                                stiffness.fixed_view_mut::<3, 3>(3 * corner_row, 3 * corner_column);
                            block += unit.fixed_view::<3, 3>(3 * row, 3 * column);
                        }
                    }
                }
            }
            let axes = [Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()];
            let dofs = joints
                .iter()
                .flat_map(|&position| {
                    axes.map(|direction| MeasuringPoint {
                        position,
                        direction,
                    })
                })
                .collect();
            FreeStructure {
                stiffness,
                mass: DMatrix::from_diagonal(&DVector::from_fn(15, |dof, _| masses[dof / 3])),
                dofs,
            }
        })
}

/// A structure with `shapes` raw test shapes of it, as far from modes as a test could be, at 1 to 1000 rad/s. Each has a
/// component of at least one, so that none vanishes.
pub fn with_raw_shapes(
    structure: impl Strategy<Value = FreeStructure>,
    shapes: usize,
) -> impl Strategy<Value = (FreeStructure, Modes)> {
    structure.prop_flat_map(move |structure| {
        let size = structure.dofs.len();
        (
            noise(size, shapes),
            prop::collection::vec(0.0..3.0_f64, shapes),
        )
            .prop_map(move |(mut raw, decades)| {
                for mode in 0..shapes {
                    raw[(mode, mode)] += 2.0;
                }
                let omega = DVector::from_vec(decades).map(|decade| 10_f64.powf(2.0 * decade));
                let modes = Modes::new(omega, raw).unwrap();
                (structure.clone(), modes)
            })
    })
}

/// Entries between −1 and 1.
pub fn noise(rows: usize, columns: usize) -> impl Strategy<Value = DMatrix<f64>> {
    prop::collection::vec(-1.0..1.0_f64, rows * columns)
        .prop_map(move |entries| DMatrix::from_vec(rows, columns, entries))
}

/// Mass-orthonormal shapes of `size` DOF with a full mass matrix of condition 10, and `modes` frequencies, each 1.2 to
/// 2 times the one before: apart enough for a first-order theory to hold at the noise used.
pub fn orthonormal_modes(
    size: usize,
    modes: usize,
) -> impl Strategy<Value = (Modes, DMatrix<f64>)> {
    (
        super::strategies::positive_definite(size, 1.0),
        super::strategies::orthogonal(size),
        10.0..1000.0_f64,
        prop::collection::vec(1.2..2.0_f64, modes),
    )
        .prop_map(move |((mass, _), orthogonal, lowest, ratios)| {
            let lower = mass.clone().cholesky().unwrap().l();
            let shapes = lower.transpose().try_inverse().unwrap() * orthogonal.columns(0, modes);
            let omega_squared = DVector::from_iterator(
                modes,
                ratios.iter().scan(lowest, |omega, ratio| {
                    *omega *= ratio;
                    Some(omega.powi(2))
                }),
            );
            let modes = Modes::new(omega_squared, shapes).unwrap();
            (modes, mass)
        })
}

/// A fixed–free chain: `size` masses of 0.5 to 2 lbf·s²/in, springs of 1e3 to 1e5 lbf/in, the first to ground.
pub fn held_chain(size: usize) -> impl Strategy<Value = (DMatrix<f64>, DMatrix<f64>)> {
    (
        prop::collection::vec(3.0..5.0_f64, size),
        prop::collection::vec(0.5..2.0_f64, size),
    )
        .prop_map(move |(decades, masses)| {
            let mut stiffness = zero_square(size);
            for (end, decade) in decades.iter().enumerate() {
                let spring = 10_f64.powf(*decade);
                stiffness[(end, end)] += spring;
                if end > 0 {
                    stiffness[(end - 1, end - 1)] += spring;
                    stiffness[(end, end - 1)] -= spring;
                    stiffness[(end - 1, end)] -= spring;
                }
            }
            (stiffness, diagonal(masses))
        })
}

/// A mode measured wrong: two other modes mixed in.
#[derive(Debug, Clone, Copy)]
pub struct Mixture {
    /// The wrong mode and the two in it.
    pub modes: [usize; 3],
    /// Fractions of the two, 0.3 to 0.5 either way: far above noise, and the mode is still most like itself.
    pub fractions: [f64; 2],
}

impl Mixture {
    /// Spoils the mode in a set of mass-orthonormal shapes. The others overlap it by the fractions.
    pub fn spoil(&self, exact: &Modes) -> Modes {
        let [wrong, first, second] = self.modes;
        let [a, b] = self.fractions;
        let own = (1.0 - a * a - b * b).sqrt();
        let shape = own * exact.shapes().column(wrong)
            + a * exact.shapes().column(first)
            + b * exact.shapes().column(second);
        let mut spoiled = exact.clone();
        alter(&mut spoiled, |_, shapes| shapes.set_column(wrong, &shape));
        spoiled
    }
}

/// A mixture among `modes` modes.
pub fn mixture(modes: usize) -> impl Strategy<Value = Mixture> {
    let fraction =
        || (0.3..0.5_f64, any::<bool>()).prop_map(|(size, up)| if up { size } else { -size });
    (
        Just((0..modes).collect_vec()).prop_shuffle(),
        fraction(),
        fraction(),
    )
        .prop_map(|(order, a, b)| Mixture {
            modes: [order[0], order[1], order[2]],
            fractions: [a, b],
        })
}

/// The same weights for every one of `modes` test modes: one over the standard deviations.
pub fn equal_weights(deviations: Noise, modes: usize) -> Vec<ModeWeight> {
    vec![deviations.weight(); modes]
}
