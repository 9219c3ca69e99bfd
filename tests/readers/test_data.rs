//! What a test must be, whichever file it comes from.

use crate::prelude::*;

#[test]
fn errors_name_the_offender() {
    type Change = fn(&mut TestData);
    let changes: [(&str, Change); 6] = [
        ("frequency of test mode 1 (from zero)", |data| {
            data.frequencies_hz[1] = -17.0
        }),
        ("largest component of mode 1 (from zero)", |data| {
            data.shapes.column_mut(1).fill(0.0)
        }),
        (
            "test, direction z: sensor at grid 12 is given twice",
            |data| data.sensors[2].direction = 2,
        ),
        ("shape deviation of test mode 1", |data| {
            data.shape_deviation = Some(vec![0.1, 0.0])
        }),
        ("frequency deviation of test mode 0", |data| {
            data.frequency_deviation = Some(vec![-0.1, 0.1])
        }),
        ("test modes: 0 given", |data| data.frequencies_hz.fill(0.0)),
    ];
    let again = |data: &TestData| read("test", write_csv(data).as_bytes());
    // Sensors without a grid may share a direction.
    let mut shared = wing_test();
    (shared.sensors[1].grid, shared.sensors[1].direction) = (None, 0);
    again(&shared).unwrap();
    for (words, change) in changes {
        let mut data = wing_test();
        change(&mut data);
        let said = said(again(&data));
        assert!(said.contains(words), "{words}: {said}");
    }
}
