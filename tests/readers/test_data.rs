//! What a test must be, whichever file it comes from.

use crate::prelude::*;

fn refused(change: impl Fn(&mut TestData)) -> Error {
    let mut data = wing_test();
    change(&mut data);
    data.check().expect_err("refused")
}

#[test]
fn a_test_without_modes_is_refused() {
    wing_test().check().unwrap();
    assert!(matches!(
        TestData::default().check(),
        Err(Error::Count {
            what: "test modes",
            found: 0,
            ..
        })
    ));
}

#[test]
fn errors_name_the_offender() {
    let cases: [(&str, Error); 9] = [
        (
            "frequency of test mode 1 (from zero)",
            refused(|data| data.frequencies_hz[1] = -17.0),
        ),
        (
            "frequency of test mode 0 (from zero)",
            refused(|data| data.frequencies_hz[0] = f64::NAN),
        ),
        (
            "largest component of mode 1 (from zero)",
            refused(|data| data.shapes.column_mut(1).fill(0.0)),
        ),
        (
            "mode shapes of entry (2, 1) is inf; it must be a finite number",
            refused(|data| data.shapes[(2, 1)] = f64::INFINITY),
        ),
        (
            "test mode shapes: 4 x 1 instead of 4 x 2",
            refused(|data| data.shapes = DMatrix::identity(4, 1)),
        ),
        (
            "test: sensor z 12 is given twice",
            refused(|data| data.sensors[2].direction = 2),
        ),
        (
            "direction: 6 given or asked for; there must be 0 to 5",
            refused(|data| data.sensors[3].direction = 6),
        ),
        (
            "shape deviation of test mode 1",
            refused(|data| data.shape_deviation = Some(vec![0.1, 0.0])),
        ),
        (
            "phase collinearity: 1 x 1 instead of 2 x 1",
            refused(|data| data.phase_collinearity = vec![0.5]),
        ),
    ];
    for (words, error) in cases {
        assert!(error.to_string().contains(words), "{words}: {error}");
    }
    let short = refused(|data| data.frequency_deviation = Some(vec![0.1]));
    assert!(
        matches!(
            short,
            Error::WrongShape {
                what: "frequency deviation",
                rows: 1,
                ..
            }
        ),
        "{short}"
    );
}

#[test]
fn sensors_without_a_grid_may_share_a_direction() {
    let mut data = wing_test();
    data.sensors[1].grid = None;
    data.sensors[1].direction = 0;
    data.check().unwrap();
}
