//! Rigid-body modes are the null space of the stiffness, whatever its stiffest part.

use crate::prelude::*;
use corfem::chain::rods;
use matrices::read;

fn of(stiffness: &SparseMatrix) -> RigidBodies {
    free_motions(stiffness, &Support::default()).unwrap()
}

/// Whole model of a structure with a mass at its first degree of freedom.
fn whole(structure: Structure, point: f64) -> WholeModel {
    let count = structure.free_dof().len();
    let t = SparseMatrix::new("T", count, 1, vec![(0, 0, 1.0)]).unwrap();
    let first = structure.elements()[0].label;
    let mass = DMatrix::from_element(1, 1, point);
    let parameters = [Parameter::new(first, &[first])];
    of_elements(&structure, &t, &mass, &parameters, &[None]).unwrap()
}

#[test]
fn one_stiff_spring_never_changes_the_count_of_a_model_of_elements() {
    for decades in 0..=16 {
        for (stiff, held) in (0..5).flat_map(|stiff| [(stiff, true), (stiff, false)]) {
            let mut sizes = [1e4; 5];
            sizes[stiff] *= 10_f64.powi(decades);
            let chain = whole(rods(&sizes, [held, false]).unwrap(), 1.0);
            let found = chain.rigid_bodies().unwrap();
            assert_eq!(
                found.rows.len(),
                usize::from(!held),
                "1e{decades} at {stiff}"
            );
        }
    }
}

#[test]
fn one_stiff_or_soft_spring_of_a_matrix_never_changes_the_count_to_ratios_that_doubles_tell() {
    let mut draws = Draws(7);
    for decades in -12..=12 {
        for size in [2, 5, 40, 200] {
            for is_held in [true, false] {
                let ground = is_held.then_some((0, None, draws.between(1e4, 9e4)));
                let tree =
                    (1..size).map(|row| (draws.below(row), Some(row), draws.between(1e4, 9e4)));
                let mut all = tree.collect_vec();
                all.extend(ground);
                // Of the network, or of the supports.
                let odd = if draws.unit() < 0.5 {
                    all.len() - 1
                } else {
                    draws.below(all.len())
                };
                all[odd].2 *= 10_f64.powi(decades);
                let stiffness = springs(size, &all);
                let found = of(&stiffness);
                // A ground below the rounding of the links counts as none, and is said to.
                let is_told = decades > -11 || !is_held;
                let expected = if is_told {
                    usize::from(!is_held)
                } else {
                    found.rows.len()
                };
                assert!(found.rows.len() >= usize::from(!is_held) && !found.is_told);
                assert_eq!(
                    found.rows.len(),
                    expected,
                    "1e{decades}, {size} rows, held {is_held}, {found:?}"
                );
                let modes = lowest_modes(
                    &stiffness,
                    &masses(&vec![2.0; size]),
                    size.min(3) - expected,
                )
                .unwrap_or_else(|error| {
                    panic!("1e{decades}, {size} rows, held {is_held}: {error}")
                });
                assert_eq!(modes.rigid_body.ncols(), expected);
            }
        }
    }
}

/// A truss whose every point is held to six before it, free but for its first `held` points.
fn truss(
    draws: &mut Draws,
    held: usize,
    points: usize,
    [length, modulus, density]: [f64; 3],
) -> Structure {
    let mut places: Vec<Vector3<f64>> = vec![];
    while places.len() < points {
        let place = Vector3::from_fn(|_, _| draws.between(-1.0, 1.0));
        if places.iter().all(|other| (place - other).norm() > 0.3) {
            places.push(place);
        }
    }
    let grid = |(at, place): (usize, &Vector3<f64>)| Grid {
        label: at + 1,
        position: length * place,
        constrained: [at < held; 3],
    };
    let grids = places.iter().enumerate().map(grid).collect();
    let material = Material {
        density,
        ..Material::isotropic(modulus, 0.3).unwrap()
    };
    let mut rods = Vec::new();
    for point in 1..points {
        let mut others = (0..point).collect_vec();
        while others.len() > 6 {
            others.remove(draws.below(others.len()));
        }
        for other in others {
            rods.push(Element {
                label: rods.len() + 1,
                kind: ElementKind::Rod,
                grids: vec![point + 1, other + 1],
                size: length * length * 10_f64.powf(draws.between(-5.0, -2.0)),
                material,
            });
        }
    }
    Structure::new(grids, rods).unwrap()
}

#[test]
fn a_thousand_structures_have_neither_one_too_many_nor_one_too_few() {
    for number in 0..500_u64 {
        let mut frequencies = Vec::new();
        let (mut of, held) = (Draws(number), (number % 4) as usize);
        let points = 4 + of.below(30);
        // In millimeters and tons, and in meters and kilograms.
        for units in [[1e3, 2.1e5, 7.8e-9], [1.0, 2.1e11, 7.8e3]] {
            let structure = truss(&mut Draws(1000 + number), held, points, units);
            // A millionth of a unit cube: next to nothing.
            let point = 1e-6 * units[2] * units[0].powi(3);
            let t = DMatrix::from_fn(structure.free_dof().len(), 1, |row, _| f64::from(row == 0));
            let mass = DMatrix::from_element(1, 1, point);
            let model = FiniteElementModel::new(structure, t, mass, vec![Parameter::new(1, &[1])]);
            let model = model.unwrap();
            let deck = BulkData::from_model(&model, &[1.0], &[Vector3::zeros()]).unwrap();
            let found = deck::modes(&deck, 3).unwrap_or_else(|error| panic!("{number}: {error}"));
            // Three points hold six motions of a body and more; two let it turn about their line.
            let expected = [6, 3, 1, 0][held];
            assert_eq!(found.rigid_body, expected, "truss {number}");
            frequencies.push(found.modes.frequencies_hz());
        }
        for (one, other) in frequencies[0].iter().zip(&frequencies[1]) {
            assert!(
                relative_error(one, other) < DIFFERENCE_ROUND_OFF,
                "truss {number}: {one} and {other}"
            );
        }
    }
}

#[test]
fn where_there_is_no_stiffness_every_motion_is_free() {
    // As many as are sought at first, fewer, and more than twice as many.
    for size in [3, 8, 9, 20] {
        let nothing = SparseMatrix::new("nothing", size, size, Vec::new()).unwrap();
        let found = of(&nothing);
        let mut rows = found.rows.clone();
        rows.sort_unstable();
        assert_eq!(rows, (0..size).collect_vec());
    }
}

#[test]
fn one_in_the_seventh_digit_may_be_rounding_and_four_may_not() {
    // Rounding leaves half a unit of the last digit in each of four numbers, whatever the units of the second row.
    for (spring, unit) in [(1.234_567, 1.0), (1.234_56, 1.0), (1.234_567, 1e4)] {
        for (part, free) in [(1e-6, 1), (4e-6, 0)] {
            let rows = [spring + part, -spring * unit, spring * unit * unit];
            let lines = rows.iter().zip(["1 1", "2 1", "2 2"]);
            let lines = lines.map(|(value, place)| format!("{place} {value:.6e}\n"));
            let text = lines.collect::<String>();
            let text = format!("%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n{text}");
            let matrix = read("k.mtx", text.as_bytes(), None).unwrap().matrix;
            let found = of(&matrix);
            assert_eq!(found.rows.len(), free, "{spring} {part:e}: {found:?}");
            assert!(found.is_sure);
        }
    }
}
