//! What a test must be, whichever file it comes from.

use crate::prelude::*;

#[test]
fn errors_name_the_offender() {
    type Change = fn(&mut TestData);
    let changes: [(&str, Change); 11] = [
        ("frequency of test mode 1 (from zero)", |data| {
            data.frequencies_hz[1] = -17.0
        }),
        ("frequency of test mode 0 (from zero)", |data| {
            data.frequencies_hz[0] = f64::NAN
        }),
        ("largest component of mode 1 (from zero)", |data| {
            data.shapes.column_mut(1).fill(0.0)
        }),
        (
            "mode shapes of entry (2, 1) is inf; it must be a finite number",
            |data| {
                data.shapes[(2, 1)] = f64::INFINITY;
            },
        ),
        ("test mode shapes: 4 x 1 instead of 4 x 2", |data| {
            data.shapes = data.shapes.columns(0, 1).into_owned();
        }),
        ("test: sensor z 12 is given twice", |data| {
            data.sensors[2].direction = 2
        }),
        (
            "direction: 6 given or asked for; there must be 0 to 5",
            |data| data.sensors[3].direction = 6,
        ),
        ("shape deviation of test mode 1", |data| {
            data.shape_deviation = Some(vec![0.1, 0.0])
        }),
        ("phase collinearity: 1 x 1 instead of 2 x 1", |data| {
            data.phase_collinearity = vec![0.5]
        }),
        ("frequency deviation: 1 x 1 instead of 2 x 1", |data| {
            data.frequency_deviation = Some(vec![0.1])
        }),
        ("test modes: 0 given", |data| *data = TestData::default()),
    ];
    // Sensors without a grid may share a direction.
    let mut shared = wing_test();
    (shared.sensors[1].grid, shared.sensors[1].direction) = (None, 0);
    shared.check().unwrap();
    for (words, change) in changes {
        let mut data = wing_test();
        change(&mut data);
        let said = said(data.check());
        assert!(said.contains(words), "{words}: {said}");
    }
}
