//! A wing of any size: a box of ribs and spars, every member in one group.

use crate::common::known::wing::{MESHES, SORTS};
use crate::common::structures::wings;
use crate::prelude::*;

/// Numbers of covers, spar webs, rib webs, spanwise caps, and posts with rib caps.
fn counts([ribs, chord, depth]: [usize; 3]) -> [usize; 5] {
    let (lines, levels) = (chord + 1, depth + 1);
    [
        2 * chord,
        lines * depth,
        chord * depth,
        lines * levels,
        lines * depth + chord * levels,
    ]
    .map(|count| ribs * count)
}

fn free_dof([ribs, chord, depth]: [usize; 3]) -> usize {
    3 * ribs * (chord + 1) * (depth + 1)
}

/// Area of an element for unit size: its volume.
fn area(structure: &Structure, label: usize) -> f64 {
    let (row, elements) = (label - 1, structure.elements());
    corner_volumes(elements[row].kind, &structure.corners()[row])
        .iter()
        .sum()
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
fn sizes_of_a_sort_sum_to_what_was_given() {
    let wing = Wing {
        bays: [6, 4, 2],
        measured: [6, 3],
        ..Wing::default()
    };
    let model = wing.model().unwrap();
    let [covers, spars, ribs] = wing.gages;
    let [caps, rib_caps, posts] = wing.areas;
    // Webs of two cells stand on each other; every bay along the span has its own caps and spar webs.
    let expected = [
        covers * 48.0,
        spars * 12.0,
        ribs * 8.0,
        caps * 6.0,
        posts * 2.0 + rib_caps * 4.0,
    ];
    for (sort, expected) in expected.iter().enumerate() {
        let of_sort = model.parameters()[sort * wing.zones..]
            .iter()
            .take(wing.zones);
        let size = |label: usize| model.structure().elements()[label - 1].size;
        let total: f64 = of_sort
            .flat_map(|p| &p.elements)
            .map(|&label| size(label))
            .sum();
        assert_relative_eq!(total, *expected, max_relative = ROUND_OFF);
    }
}

#[test]
fn covers_and_ribs_fill_planform_and_sections() {
    for (twist, depth) in [(0.0, 1), (0.0, 3), (8.0, 2)] {
        let wing = Wing {
            bays: [7, 3, depth],
            angles: [35.0, twist],
            ..Wing::default()
        };
        let structure = wing.structure().unwrap();
        let [root, tip] = wing.chords;
        let [covers, spars, ribs, ..] = counts(wing.bays);
        if twist == 0.0 {
            let slope = 0.5 * wing.thickness * (tip - root) / wing.span;
            let total: f64 = (1..=covers).map(|label| area(&structure, label)).sum();
            let expected = 2.0 * wing.span * 0.5 * (root + tip) * slope.hypot(1.0);
            assert_relative_eq!(total, expected, max_relative = ELEMENT_ROUND_OFF);
        }
        let total: f64 = (1..=ribs)
            .map(|label| area(&structure, covers + spars + label))
            .sum();
        let section =
            |rib: usize| wing.thickness * (root + (tip - root) * rib as f64 / 7.0).powi(2);
        assert_relative_eq!(
            total,
            (1..=7).map(section).sum(),
            max_relative = ELEMENT_ROUND_OFF
        );
    }
}

#[test]
fn tip_is_swept_and_twisted_about_half_the_chord() {
    let wing = Wing {
        bays: [4, 2, 2],
        angles: [30.0, 10.0],
        ..Wing::default()
    };
    let structure = wing.structure().unwrap();
    let at = |place| structure.grids()[wing.grid(place) - 1].position;
    let middle = at([4, 1, 1]);
    assert_relative_eq!(middle.x, 300.0 * (PI / 6.0).tan(), max_relative = ROUND_OFF);
    assert_relative_eq!(middle.z, 0.0, epsilon = ROUND_OFF);
    let (leading, trailing) = (at([4, 0, 1]), at([4, 2, 1]));
    assert_relative_eq!(
        (leading - trailing).norm(),
        wing.chords[1],
        max_relative = ROUND_OFF
    );
    // Nose up by ten degrees.
    assert_relative_eq!(
        leading.z - trailing.z,
        wing.chords[1] * (PI / 18.0).sin(),
        max_relative = ROUND_OFF
    );
    assert_eq!(at([0, 0, 1]).z, at([0, 2, 1]).z);
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

#[test]
fn lowest_modes_hardly_depend_on_the_mesh() {
    let frequencies = |bays| {
        let wing = Wing {
            bays,
            measured: [9, 3],
            ..Wing::default()
        };
        let modes = wing.model().unwrap().modes(&[1.0; 25]).unwrap();
        modes.lowest(4).unwrap().frequencies_hz()
    };
    // Of the same depth: caps in mid-depth would bend less.
    let (coarse, fine) = (frequencies([9, 4, 1]), frequencies([18, 8, 1]));
    for (coarse, fine) in coarse.iter().zip(&fine) {
        assert_relative_eq!(coarse, fine, max_relative = COARSE_WING);
    }
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

properties! {
    #[test]
    fn every_wing_is_held_and_counted(wing in wings()) {
        let model = wing.model()?;
        let structure = model.structure();
        let [ribs, chord, depth] = wing.bays;
        prop_assert_eq!(structure.grids().len(), (ribs + 1) * (chord + 1) * (depth + 1));
        prop_assert_eq!(structure.free_dof().len(), free_dof(wing.bays));
        let expected = counts(wing.bays);
        prop_assert_eq!(structure.elements().len(), expected.iter().sum::<usize>());
        let of = |kind| structure.elements().iter().filter(|element| element.kind == kind).count();
        prop_assert_eq!(of(ElementKind::Membrane), expected[0]);
        prop_assert_eq!(of(ElementKind::ShearPanel), expected[1] + expected[2]);
        factorized(structure)?;
        let factors = vec![1.0; model.parameters().len()];
        let modes = model.modes(&factors)?;
        prop_assert_eq!(modes.len(), wing.measured[0] * wing.measured[1]);
    }

    #[test]
    fn every_element_is_in_one_group(wing in wings()) {
        let model = wing.model()?;
        prop_assert_eq!(model.parameters().len(), SORTS.len() * wing.zones);
        let members = |sort: usize| {
            let zones = &model.parameters()[sort * wing.zones..(sort + 1) * wing.zones];
            zones.iter().flat_map(|p| p.elements.clone()).collect_vec()
        };
        let mut all = (0..SORTS.len()).flat_map(members).collect_vec();
        for (sort, expected) in counts(wing.bays).into_iter().enumerate() {
            prop_assert_eq!(members(sort).len(), expected, "{}", SORTS[sort]);
        }
        all.sort_unstable();
        prop_assert_eq!(all, (1..=model.structure().elements().len()).collect_vec());
    }

    #[test]
    fn measured_is_the_mean_of_both_surfaces_up_to_the_tip(wing in wings()) {
        let model = wing.model()?;
        let (t, free) = (model.load_distribution(), model.structure().free_dof());
        for column in t.column_iter() {
            let rows = (0..t.nrows()).filter(|&row| column[row] != 0.0).collect_vec();
            prop_assert_eq!(rows.len(), 2);
            prop_assert!(rows.iter().all(|&row| column[row] == 0.5 && free[row].direction == 2));
            prop_assert_eq!(free[rows[1]].grid - free[rows[0]].grid, wing.bays[2]);
        }
        prop_assert!(t.row_iter().all(|row| row.sum() <= 0.5), "a point measured twice");
        let tip = wing.grid([wing.bays[0], 0, 0]);
        prop_assert!(t.row_iter().zip(free).any(|(row, dof)| dof.grid == tip && row.sum() > 0.0));
    }
}
