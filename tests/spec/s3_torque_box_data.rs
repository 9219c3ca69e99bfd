//! The box's data: the file it comes from, its masses, and data that cannot be a box.

use crate::prelude::*;

const TEXT: &str = include_str!("../../paper/reconstruction.toml");

#[test]
fn the_mass_is_diagonal_in_the_order_of_the_dynamic_points() {
    let data = Reconstruction::embedded().unwrap();
    assert_eq!(data, Reconstruction::parse("the same", TEXT).unwrap());
    let mass = data.mass();
    assert_eq!(mass.shape(), (9, 9));
    assert_eq!(
        mass,
        DMatrix::from_diagonal(&DVector::from_vec(data.masses.clone()))
    );
    assert_eq!((mass[(0, 0)], mass[(8, 8)]), (0.001455, 0.03415));
}

fn refusal(from: &str, to: &str) -> CaseError {
    assert!(TEXT.contains(from), "{from} is not in the file");
    Reconstruction::parse("box.toml", &TEXT.replace(from, to))
        .expect_err("a box that must be refused")
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
        let refused = refusal(from, to);
        let named = matches!(&refused, CaseError::Toml { name, expected: "a torque box: material, masses and grids", .. }
            if name == "box.toml");
        assert!(named, "{refused:?}");
        let message = refused.to_string();
        assert!(
            message.starts_with("box.toml is not a torque box") && message.contains(says),
            "{message}"
        );
    }
}

#[test]
fn missing_masses_and_grids_are_refused_by_count_and_number() {
    let refused = refusal("masses = [0.001455, ", "masses = [");
    assert!(
        matches!(
            refused,
            CaseError::Method(Error::WrongShape {
                what: "box masses",
                expected_rows: 9,
                expected_columns: 1,
                rows: 8,
                columns: 1
            })
        ),
        "{refused:?}"
    );
    let refused = refusal("16 = [-7.607, 0.000, -0.6133]", "");
    assert!(
        matches!(
            refused,
            CaseError::Method(Error::WrongShape {
                what: "box grids",
                expected_rows: 16,
                rows: 15,
                ..
            })
        ),
        "{refused:?}"
    );
    let refused = refusal("16 = [", "17 = [");
    assert!(
        matches!(
            refused,
            CaseError::MissingGrid {
                grid: 16,
                count: 16
            }
        ),
        "{refused:?}"
    );
    assert_eq!(
        refused.to_string(),
        "torque box: grid 16 of 1 to 16 is missing"
    );
    let mut data = Reconstruction::embedded().unwrap();
    data.grids.remove(&6);
    let refused = load_distribution(&data).unwrap_err();
    assert!(
        matches!(refused, CaseError::MissingGrid { grid: 6, count: 16 }),
        "{refused:?}"
    );
}

#[test]
fn a_mid_point_must_lie_between_the_spars() {
    for outside in ["0.0", "1.0", "-0.5", "1.5", "nan"] {
        let refused = refusal(
            "mid_chord_fraction = 0.5107",
            &format!("mid_chord_fraction = {outside}"),
        );
        let value: f64 = outside.parse().unwrap();
        assert!(
            matches!(refused, CaseError::Method(Error::Value { what: "mid_chord_fraction", expected: "a number between 0 and 1", value: found, .. })
                if found.to_bits() == value.to_bits()),
            "{refused:?}"
        );
    }
}

#[test]
fn a_rib_without_chord_or_depth_is_refused() {
    let refused = |change: &dyn Fn(&mut Reconstruction)| {
        let mut data = Reconstruction::embedded().unwrap();
        change(&mut data);
        match load_distribution(&data) {
            Err(CaseError::Method(Error::Value {
                what: "length",
                value,
                ..
            })) => value,
            other => panic!("expected a zero length, found {other:?}"),
        }
    };
    let spars_meet = refused(&|data| {
        let rear = data.grids[&5];
        data.grids.insert(7, [rear[0], rear[1], 0.1]);
    });
    assert_eq!(spars_meet, 0.0);
    assert_eq!(
        refused(&|data| data.grids.extend([(10, data.grids[&9])])),
        0.0
    );
    let upside_down = refused(&|data| data.grids.extend([(4, [6.496, 32.543, 0.2])]));
    assert!((upside_down - (0.1009 - 0.2)).abs() < ROUND_OFF);
    assert!(refused(&|data| data.grids.get_mut(&1).unwrap()[2] = f64::NAN).is_nan());
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
    let mut data = Reconstruction::embedded().unwrap();
    assert_eq!(dynamic_points(&data).unwrap().len(), 9);
    data.grids.remove(&7);
    match dynamic_points(&data) {
        Err(CaseError::MissingGrid { grid, count }) => assert_eq!((grid, count), (7, 16)),
        other => panic!("{other:?}"),
    }
}
