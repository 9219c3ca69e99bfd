//! A wing of any size: a box of ribs and spars, every member in one group.

use crate::common::wing::MESHES;
use crate::prelude::*;

fn free_dof([ribs, chord, depth]: [usize; 3]) -> usize {
    3 * ribs * (chord + 1) * (depth + 1)
}

#[test]
fn measured_sizes_are_those_of_their_names() {
    let dof = MESHES.map(|(_, bays)| free_dof(bays));
    assert_eq!(dof, [1_458, 10_098, 100_116, 1_002_000]);
    for (name, bays) in &MESHES[..2] {
        let wing = Wing::named(name).unwrap();
        let model = wing.model().unwrap();
        assert_eq!(model.structure().free_dof().len(), free_dof(*bays));
        assert_eq!(model.load_distribution().ncols(), 108);
        assert_eq!(model.parameters().len(), 25);
    }
    assert_eq!(Wing::named("1k"), Some(Wing::default()));
    assert_eq!(Wing::named("2k"), None);
}

#[test]
fn slender_wing_bends_as_a_beam() {
    let material = Material {
        youngs_modulus: 1e7,
        poissons_ratio: 0.0,
        shear_modulus: 5e6,
        density: 0.0,
    };
    let (bays, chords, angles, measured) = ([40, 2, 1], [12.0; 2], [0.0; 2], [20, 3]);
    let wing = Wing {
        bays,
        chords,
        angles,
        thickness: 0.5,
        material,
        measured,
        ..Wing::default()
    };
    let first = wing
        .model()
        .unwrap()
        .modes(&[1.0; 25])
        .unwrap()
        .frequencies_hz()[0];
    // Covers and caps at half the depth; a cantilever's flexibility between masses at twenty stations.
    let [depth, sheet] = [6.0, 2.0 * wing.gages[0] * 12.0];
    let bending = material.youngs_modulus * (sheet + wing.areas[0]) * (0.5 * depth) * (0.5 * depth);
    let flexibility = DMatrix::from_fn(20, 20, |i, j| {
        let (near, far) = (15.0 * (i.min(j) + 1) as f64, 15.0 * (i.max(j) + 1) as f64);
        near * near * (3.0 * far - near) / (6.0 * bending)
    });
    let root = flexibility.symmetric_eigenvalues().max() * wing.mass / 20.0;
    assert_relative_eq!(first, 0.5 / PI / root.sqrt(), max_relative = SLENDER_BEAM);
}

/// All its mass is on the measured points, so that condensation to them costs nothing.
#[test]
fn whole_wing_has_the_modes_of_its_points() {
    let wing = Wing {
        bays: [9, 4, 1],
        measured: [9, 3],
        ..Wing::default()
    };
    let expected = wing.model().unwrap().modes(&[1.0; 25]);
    let expected = expected.unwrap().lowest(8).unwrap();
    let (whole, points) = wing.whole().unwrap();
    let found = whole.modes(&[1.0; 25], 8).unwrap().vibrations;
    for (a, b) in found.frequencies_hz().iter().zip(expected.frequencies_hz()) {
        assert_relative_eq!(*a, b, max_relative = TWO_PROGRAMS);
    }
    let seen = points.times(found.shapes()).unwrap();
    for (a, b) in seen.column_iter().zip(expected.shapes().column_iter()) {
        let apart = (a * a.dot(&b).signum() - b).amax();
        assert!(apart <= TWO_PROGRAMS * b.amax(), "{apart:e}");
    }
}
