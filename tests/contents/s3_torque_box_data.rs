//! The box's data: the file it comes from, its masses, and data that cannot be a box.

use crate::prelude::*;

const TEXT: &str = include_str!("../../paper/reconstruction.toml");

#[test]
fn the_mass_is_diagonal_in_the_order_of_the_dynamic_points() {
    let data = Reconstruction::embedded().unwrap();
    assert_eq!(data, Reconstruction::parse("the same", TEXT).unwrap());
    assert_eq!(data.mass(), diagonal(&data.masses));
    assert_eq!(
        (data.masses.len(), data.masses[0], data.masses[8]),
        (9, 0.001455, 0.03415)
    );
}

/// What is said of the file with one text replaced, there or where its load distribution is made.
fn refusal(from: &str, to: &str) -> String {
    assert!(TEXT.contains(from), "{from} is not in the file");
    let data = Reconstruction::parse("box.toml", &TEXT.replace(from, to));
    said(data.and_then(|data| load_distribution(&data)))
}

#[test]
fn text_of_another_form_is_refused_by_the_files_name() {
    for (from, to, says) in [
        ("youngs_modulus", "elastic_modulus", "elastic_modulus"),
        ("poissons_ratio = 0.3339", "", "poissons_ratio"),
        (
            "7 = [4.519, 26.129, 0.1153]",
            "7 = [4.519, 26.129]",
            "invalid length 2",
        ),
        ("masses = [", "masses = [\"light\", ", "string"),
    ] {
        let said = refusal(from, to);
        assert!(
            said.starts_with("box.toml is not a torque box") && said.contains(says),
            "{said}"
        );
    }
}

#[test]
fn what_cannot_be_a_box_is_refused_by_count_number_and_value() {
    for (from, to, says) in [
        (
            "masses = [0.001455, ",
            "masses = [",
            "box masses: 8 x 1 instead of 9 x 1",
        ),
        ("16 = [-7.607, 0.000, -0.6133]", "", "box grids: 15 x "),
        (
            "16 = [",
            "17 = [",
            "torque box: grid 16 of 1 to 16 is missing",
        ),
        (
            "mid_chord_fraction = 0.5107",
            "mid_chord_fraction = 0.0",
            "mid_chord_fraction",
        ),
        (
            "mid_chord_fraction = 0.5107",
            "mid_chord_fraction = 1.0",
            "mid_chord_fraction",
        ),
        (
            "mid_chord_fraction = 0.5107",
            "mid_chord_fraction = -0.5",
            "mid_chord_fraction",
        ),
        (
            "mid_chord_fraction = 0.5107",
            "mid_chord_fraction = 1.5",
            "mid_chord_fraction",
        ),
        (
            "mid_chord_fraction = 0.5107",
            "mid_chord_fraction = nan",
            "mid_chord_fraction",
        ),
    ] {
        let said = refusal(from, to);
        assert!(said.contains(says), "{said}");
    }
}

#[test]
fn a_rib_without_chord_or_depth_is_refused() {
    let refused = |change: fn(&mut BTreeMap<usize, [f64; 3]>)| {
        let mut data = Reconstruction::embedded().unwrap();
        change(&mut data.grids);
        match load_distribution(&data) {
            Err(CaseError::Method(Error::Value {
                what: "length",
                value,
                ..
            })) => value,
            other => panic!("expected a zero length, found {other:?}"),
        }
    };
    let spars_meet = refused(|grids| {
        let rear = grids[&5];
        grids.insert(7, [rear[0], rear[1], 0.1]);
    });
    assert_eq!(spars_meet, 0.0);
    assert_eq!(refused(|grids| grids.extend([(10, grids[&9])])), 0.0);
    let upside_down = refused(|grids| grids.extend([(4, [6.496, 32.543, 0.2])]));
    assert_within(upside_down, 0.1009 - 0.2, ROUND_OFF);
    assert!(refused(|grids| grids.get_mut(&1).unwrap()[2] = f64::NAN).is_nan());
}

#[test]
fn numbers_that_cannot_be_are_refused_where_they_are_used() {
    let panels = case_of(2).panels;
    let mut data = Reconstruction::embedded().unwrap();
    data.youngs_modulus = -1.0;
    let refused = structure(&data, &panels, 0.01).unwrap_err();
    assert!(
        matches!(
            refused,
            Error::Value {
                what: "Young's modulus",
                value: -1.0,
                ..
            }
        ),
        "{refused:?}"
    );
    let refused = structure(&Reconstruction::embedded().unwrap(), &panels, 0.0).unwrap_err();
    assert!(
        matches!(&refused, Error::Value { what: "gage or area", owner, .. } if owner == "element 16"),
        "{refused:?}"
    );
}

#[test]
fn dynamic_points_lie_between_grids_that_are_there() {
    let whole = Reconstruction::embedded().unwrap();
    assert_eq!(dynamic_points(&whole).unwrap().len(), 9);
    for grid in [7, 6] {
        let mut data = whole.clone();
        data.grids.remove(&grid);
        let words = format!("torque box: grid {grid} of 1 to 16 is missing");
        assert_eq!(said(load_distribution(&data)), words);
        assert_eq!(said(dynamic_points(&data)), words);
    }
}
