//! Figures of small made-up data, as stored: what the cases' own figures have no example of. A golden compares numbers to their last
//! digit only, so that words that have to be exact are looked for by themselves.

use crate::common::drawings::words;
use crate::paper::figures::canvas::WIDE;
use crate::paper::figures::error_history::{self, PassHistory};
use crate::paper::figures::factors::{DrawnFactor, Factors};
use crate::paper::figures::matrices::{HeatMap, draw_by_twos};
use crate::prelude::*;

fn factor(name: &str, value: f64) -> DrawnFactor {
    DrawnFactor {
        name: name.to_owned(),
        value,
        ..DrawnFactor::default()
    }
}

#[test]
fn factors_with_bounds_deviations_and_remarks() {
    let range = |lower, upper| Some(Bounds { lower, upper });
    let long = "a name that has fifty letters is cut off after forty";
    let rows = vec![
        DrawnFactor {
            deviation: Some(0.05),
            published: Some(0.5),
            bounds: range(0.5, 2.0),
            ..factor("below", 0.62)
        },
        DrawnFactor {
            deviation: Some(0.9),
            published: Some(1.2),
            bounds: range(0.5, 50.0),
            ..factor("above", 1.9)
        },
        DrawnFactor {
            deviation: Some(f64::NAN),
            remark: Some("at bound"),
            ..factor(&long[..41], 1.5)
        },
        DrawnFactor {
            published: Some(0.7),
            ..factor(&long[..40], f64::NAN)
        },
        DrawnFactor {
            deviation: Some(0.3),
            published: Some(0.5),
            ..factor("as it was", 1.0)
        },
        DrawnFactor {
            deviation: Some(0.01),
            published: Some(0.3),
            remark: Some("at bound"),
            ..factor(long, 0.9)
        },
        DrawnFactor {
            deviation: Some(0.75),
            published: Some(0.9),
            ..factor("unsure", 0.8)
        },
    ];
    let figure = |rows, limits| Factors {
        rows,
        limits,
        across: "factor".into(),
        down: "parameter",
        origin: 1.0,
        decimals: 2,
        published: "right",
    };
    assert_golden(
        "drawing_factors",
        &figure(rows.clone(), None)
            .draw("factors", "Factors", WIDE)
            .unwrap(),
        Numbers::DRAWN,
    );
    let drawn = figure(rows[..6].to_vec(), range(0.6, 1.4))
        .draw("factors", "Factors", WIDE)
        .unwrap();
    assert_golden("drawing_factors_limited", &drawn, Numbers::DRAWN);
    let alike = figure(vec![factor("one", 1.0), factor("other", 1.004)], None)
        .draw("factors", "Factors", WIDE);
    assert_golden("drawing_factors_alike", &alike.unwrap(), Numbers::DRAWN);
}

/// A pass of as many iterations, its errors falling from one to another.
fn pass(
    from: usize,
    iterations: usize,
    [first, last]: [f64; 2],
    tolerance: Option<f64>,
    is_inner: bool,
) -> PassHistory {
    let share = |row: usize| row as f64 / iterations.max(1) as f64;
    let errors = |row: usize| {
        let sum = first * (last / first).powf(share(row));
        Errors {
            frequency: 0.25 * sum,
            shape: 0.75 * sum,
            frequency_count: 9,
            shape_count: 9,
        }
    };
    let inner = (0..if is_inner { iterations + 1 } else { 1 })
        .map(errors)
        .collect();
    PassHistory {
        from,
        inner,
        check: errors(iterations),
        tolerance,
        is_inner,
    }
}

#[test]
fn histories_with_long_and_short_passes() {
    let passes = [
        pass(0, 14, [0.9, 0.1], Some(0.12), true),
        pass(14, 3, [0.1, 0.05], Some(0.02), true),
        pass(17, 1, [0.05, 0.04], None, true),
        pass(18, 12, [0.04, 0.01], None, true),
        pass(30, 1, [0.01, 0.008], None, false),
    ];
    let draw =
        |passes: &[PassHistory]| error_history::draw("errors", "Errors", passes, WIDE).unwrap();
    assert_golden("drawing_errors", &draw(&passes), Numbers::DRAWN);
    let said = words(&draw(&passes));
    for name in ["pass 1 (tolerance 12.0 %)", "pass 2", "3", "pass 4"] {
        assert!(said.iter().any(|word| word == name), "{name}: {said:?}");
    }
    // From beyond one end of the axis to beyond the other; and no iterations at all.
    let far = [
        pass(0, 4, [200.0, 1e-3], Some(1e-12), true),
        pass(4, 2, [1e-3, 1e-12], Some(1e-6), true),
    ];
    assert_golden("drawing_errors_far", &draw(&far), Numbers::DRAWN);
    // What is less than a thousandth of a percent stands on the foot of the axis, which says so.
    let said = words(&draw(&far));
    assert!(said.iter().any(|word| word == "≤ 0.001"), "{said:?}");
    let is_long = |word: &&String| word.contains("0.000") || word.contains("e-");
    assert_eq!(said.iter().find(is_long), None);
    assert_golden(
        "drawing_errors_short",
        &draw(&[pass(0, 1, [0.2, 0.1], None, true)]),
        Numbers::DRAWN,
    );
    assert!(draw(&[]).contains("SRSS error"));
}

fn map(
    title: &str,
    (rows, columns): (usize, usize),
    written: (f64, usize),
    value: fn(usize, usize) -> f64,
) -> HeatMap {
    let labels = |what: &str, count: usize| {
        (
            what.to_owned(),
            (1..=count).map(|row| format!("{what} {row}")).collect(),
        )
    };
    HeatMap {
        title: title.to_owned(),
        rows: labels("a row", rows),
        columns: (String::from("column"), labels("", columns).1),
        values: DMatrix::from_fn(rows, columns, |i, j| (i != j + 2).then(|| value(i, j))),
        full: 1.0,
        written,
    }
}

#[test]
fn matrices_with_cells_too_small_for_their_numbers() {
    let wave = |i: usize, j: usize| ((3 * i + 5 * j) % 21) as f64 / 10.0 - 1.0;
    let maps = [
        map(
            "Two digits fit, and this title is longer than its matrix",
            (9, 20),
            (10.0, 0),
            wave,
        ),
        map("Three do not", (9, 20), (100.0, 0), |i, j| {
            ((3 * i + 5 * j) % 11) as f64 / 10.0
        }),
        map("Rows are too low", (30, 9), (1.0, 0), wave),
        map(
            "A title much longer than the one column below it, which it does not leave",
            (2, 1),
            (10.0, 1),
            wave,
        ),
        map("An odd one", (3, 3), (1.0, 1), wave),
    ];
    let drawn = draw_by_twos("maps", "Maps", &maps, &["One note.", "And another."], WIDE).unwrap();
    assert_golden("drawing_matrices", &drawn, Numbers::DRAWN);
}
