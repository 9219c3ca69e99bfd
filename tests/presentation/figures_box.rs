//! The data of the figures of the box are the model's and Table 2's.

use crate::common::drawings::{words, written};
use crate::paper::figures::box_elements::Layer;
use crate::paper::figures::cover_gages::draw;
use crate::paper::report::case_report;
use crate::prelude::*;
use crate::presentation::figures::results;

#[test]
fn box_points_are_the_grids_and_where_the_load_distribution_acts() {
    let case = &results()[0].case;
    let model = case.model().expect("a model");
    let subject = case_report(&results()[0])
        .expect("a subject")
        .with_structure(model.structure());
    let numbers = subject.grids.iter().map(|(label, _)| *label).collect_vec();
    assert_eq!(numbers, (1..=16).collect_vec());
    for (label, at) in &subject.grids {
        assert_eq!(<[f64; 3]>::from(*at), case.reconstruction.grids[label]);
        assert_eq!(subject.supports.contains(at), *label >= 13);
    }
    // A rigid tilt of the structure moves each dynamic point as the plane through it says.
    for (a, b, c) in [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)] {
        let motion = model.structure().free_dof().iter().map(|dof| {
            let [x, y, z] = case.reconstruction.grids[&dof.grid];
            [b * z, -a * z, a * y - b * x + c][dof.direction]
        });
        let structural = DVector::from_iterator(36, motion);
        let dynamic = model.load_distribution().clone().tr_mul(&structural);
        assert_eq!((dynamic.len(), subject.sensors.len()), (9, 9));
        for (moved, sensor) in dynamic.iter().zip(&subject.sensors) {
            let point = sensor.place.expect("a place");
            assert_eq!((point.z, sensor.direction), (0.0, nalgebra::Vector3::z()));
            let plane = a * point.y - b * point.x + c;
            assert!(
                (moved - plane).abs() < MATRIX_ROUND_OFF * 40.0,
                "{moved} for {plane}"
            );
        }
    }
}

#[test]
fn box_elements_are_the_models_in_three_layers() {
    let case = &results()[1].case;
    let model = case.model().expect("a model");
    let structure = model.structure();
    assert_eq!(structure.elements().len(), 39);
    let on = |layer| {
        let elements = structure.elements().iter().zip(structure.corners());
        let here = elements.filter(|(_, corners)| Layer::from_corners(corners) == layer);
        here.map(|(element, _)| element.label).collect_vec()
    };
    assert_eq!(on(Layer::Upper)[..3], [4, 9, 15]);
    assert_eq!(on(Layer::Lower)[..3], [2, 8, 11]);
    assert_eq!(on(Layer::Webs)[..9], [1, 3, 5, 6, 7, 10, 12, 13, 14]);
    // Nine caps above, nine below, six posts between.
    let counts = [Layer::Upper, Layer::Lower, Layer::Webs].map(|layer| on(layer).len());
    assert_eq!(counts, [3 + 9, 3 + 9, 9 + 6]);
}

#[test]
fn cover_gages_are_those_of_table_2() {
    let cases = results()
        .iter()
        .map(|result| result.case.clone())
        .collect_vec();
    let said = written(&draw(&cases).expect("drawn"));
    let table = PublishedTable::number(2).expect("it reads");
    let names = ["GVT", "Case 1", "Case 2", "Case 3", "Case 4"];
    for (number, name) in names.into_iter().enumerate() {
        let row = said
            .iter()
            .position(|word| word.text == name)
            .expect("its row");
        // In every cover its number and kind, and below them its gage.
        for (pair, label) in said[row + 1..row + 13]
            .chunks_exact(2)
            .zip([2, 4, 8, 9, 11, 15])
        {
            let [above, below] = pair else {
                panic!("a pair")
            };
            assert_eq!(
                above.bounds[2] < 410.0,
                [4, 9, 15].contains(&label),
                "upper covers at the left: {above:?}"
            );
            assert!(above.bounds[3] <= below.bounds[1]);
            let (element, gage) = (
                label.to_string(),
                below.text.parse::<f64>().expect("a gage"),
            );
            if number == 0 {
                assert_eq!((&above.text, gage), (&element, 0.010));
                continue;
            }
            assert_eq!(Some(gage), table.value(&element, &format!("gage_{number}")));
            let kind = table
                .text(&element, &format!("type_{number}"))
                .expect("printed");
            assert_eq!(above.text, format!("{element} {kind}"));
        }
    }
    assert!(
        !words(&draw(&[]).expect("drawn"))
            .iter()
            .any(|word| word == "GVT")
    );
}
