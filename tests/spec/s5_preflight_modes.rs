//! The pre-flight: what it says of frequencies, of modes, of settings and of two mistakes at once.

use crate::evidence::specimen::Specimen;
use crate::prelude::*;
use crate::spec::s5_preflight::{case, chain, findings, is_of, wing, with_shapes};
use corfem::job::preflight::LARGEST_TOLERANCE;

#[test]
fn exchanged_frequencies_are_named_where_models_are_closer_than_modes() {
    for specimen in [case(2), wing()] {
        for first in 0..specimen.test.len() - 1 {
            let mut wrong = specimen.clone();
            alter(&mut wrong.test, |squares, _| {
                squares.swap_rows(first, first + 1)
            });
            let found = findings(&wrong);
            let [
                Concern {
                    kind: Kind::FrequenciesExchanged,
                    about,
                    measure,
                    ..
                },
            ] = &found[..]
            else {
                panic!("{} {first}: {found:?}", specimen.name)
            };
            let modes = [first + 1, first + 2].map(|mode| mode.to_string());
            assert_eq!(about[..], modes);
            assert!(measure[1] < measure[0]);
        }
    }
}

#[test]
fn a_mode_measured_twice_is_told() {
    for specimen in [case(2), case(3), wing(), chain()] {
        let mut wrong = specimen.clone();
        let copy = specimen.test.shapes().column(1).into_owned();
        alter(&mut wrong.test, |_, shapes| {
            shapes.set_column(4, &(-3.0 * copy))
        });
        let same = |wrong: &Specimen| {
            let found = findings(wrong);
            let [concern] = &found[..] else {
                panic!("{}: {found:?}", specimen.name)
            };
            assert_eq!(concern.about, ["2", "5"], "{}", specimen.name);
            assert!((concern.measure[0] - 1.0).abs() < ROUND_OFF);
            (concern.measure[1], concern.words())
        };
        let (ratio, words) = same(&wrong);
        assert!(ratio > 1.1 && !words.contains("twice"));
        alter(&mut wrong.test, |squares, _| {
            squares[4] = specimen.test.omega_squared()[1];
        });
        assert!(
            words
                .starts_with("Test modes 2 and 5 are nearly the same shape, modal assurance 1.000"),
            "{words}"
        );
        let (ratio, words) = same(&wrong);
        assert!(
            (ratio - 1.0).abs() < ROUND_OFF && words.contains("measured twice?"),
            "{words}"
        );
    }
}

#[test]
fn more_modes_than_points_are_told_and_nothing_else() {
    let right = chain();
    let points = [0, 2, 4, 6];
    let [stiffness, mass] = [&right.model.stiffness, &right.model.mass]
        .map(|matrix| matrix.select_rows(&points).select_columns(&points));
    let mut few = with_shapes(&right, right.test.shapes().select_rows(&points));
    few.model = DynamicModel {
        stiffness,
        mass,
        shares: Vec::new(),
    };
    let mut found = findings(&few);
    found.retain(|own| own.kind != Kind::NotChecked);
    let (last, others) = found.split_last().unwrap();
    let [modes, points, distinct, smallest] = last.measure[..] else {
        panic!("{found:?}")
    };
    let are_copies = |own: &Concern| [Kind::Alike, Kind::MeasuredTwice].contains(&own.kind);
    assert!(others.iter().all(are_copies), "{found:?}");
    assert_eq!(
        (last.kind, points, distinct),
        (Kind::TooManyModes, 4.0, 4.0)
    );
    assert!(modes as usize + others.len() == 8 && smallest < DEPENDENT_SHAPES);
}

#[test]
fn two_mistakes_at_once_are_both_named() {
    let mut wrong = case(2);
    alter(&mut wrong.test, |squares, _| {
        *squares *= FACTORS[0].factor.powi(2)
    });
    alter(&mut wrong.test, |_, shapes| shapes.row_mut(3).neg_mut());
    let found = findings(&wrong);
    let [factor, change] = &found[..] else {
        panic!("{found:?}")
    };
    assert_eq!(factor.about, [FACTORS[0].name, FACTORS[0].mistake]);
    assert!(is_of(change, &Change::Reversed(3)), "{change:?}");
}

#[test]
fn tolerances_in_percent_and_bounds_that_exclude_the_start_are_named() {
    for right in [case(3), wing(), chain()] {
        let ranges = vec![
            Some(Bounds {
                lower: 0.5,
                upper: 2.0
            });
            right.ranges.len()
        ];
        let found = |settings: &Settings, ranges: &[Option<Bounds>]| {
            let specimen = Specimen {
                settings: settings.clone(),
                ranges: ranges.to_vec(),
                ..right.clone()
            };
            specimen.findings().unwrap()
        };
        assert_eq!(found(&right.settings, &ranges), []);
        let mut settings = right.settings.clone();
        settings.inner.tolerance = 2.5;
        settings.shape_tolerance = 4.0;
        settings.frequency_tolerance = LARGEST_TOLERANCE;
        let percent =
            |setting: &str, value| Concern::new(Kind::Percent, &[setting], &[value, 100.0 * value]);
        assert_eq!(
            found(&settings, &ranges),
            [
                percent("inner.tolerance", 2.5),
                percent("shape_tolerance", 4.0)
            ]
        );
        settings = Settings {
            later_inner_tolerance: 1.5,
            error_sum_tolerance: 5.0,
            ..right.settings.clone()
        };
        let expected = [
            percent("later_inner_tolerance", 1.5),
            percent("error_sum_tolerance", 5.0),
        ];
        assert_eq!(found(&settings, &ranges), expected);
        settings = Settings {
            frequency_tolerance: 1.5,
            ..right.settings.clone()
        };
        assert_eq!(
            found(&settings, &ranges),
            [percent("frequency_tolerance", 1.5)]
        );
        let mut wrong = ranges.clone();
        wrong[2] = Some(Bounds {
            lower: 55.0,
            upper: 150.0,
        });
        wrong[5] = None;
        let expected = [
            Concern::new(Kind::ExcludesStart, &[3], &[55.0, 150.0]),
            Concern::new(Kind::Unbounded, &[6], &[]),
        ];
        assert_eq!(found(&right.settings, &wrong), expected);
    }
}

#[test]
fn findings_are_said_with_places_from_one() {
    let mut wrong = case(2);
    alter(&mut wrong.test, |_, shapes| shapes.row_mut(3).neg_mut());
    alter(&mut wrong.test, |squares, _| squares.swap_rows(0, 1));
    alter(&mut wrong.test, |squares, _| {
        *squares *= FACTORS[0].factor.powi(2)
    });
    wrong.settings.shape_tolerance = 4.0;
    wrong.ranges[2] = Some(Bounds {
        lower: 55.0,
        upper: 150.0,
    });
    let said = wrong
        .findings()
        .unwrap()
        .iter()
        .map(Concern::words)
        .collect_vec();
    let all = said.join("\n");
    for words in [
        "times the model's, near 2π: the test is in rad/s?",
        "Sensor 4 reversed? The test's shapes would be 10^",
        "Frequencies of test modes 1 and 2 exchanged? It would lower the mean deviation of the ratios from ",
        "Setting shape_tolerance is 4, that is 400 %: a percentage where a fraction is meant?",
        "Bounds on the factor of parameter 3, 55 to 150, exclude its first value.",
        "Parameters without bounds: 1, 2, 4, 5, ",
    ] {
        assert!(all.contains(words), "{words} in {all}");
    }
    for (change, question) in [
        (Change::Exchanged([0, 4]), "Sensors 1 and 5 exchanged? "),
        (
            Change::Reordered(vec![2, 0, 1]),
            "Points in another order (3, 1, 2)? ",
        ),
    ] {
        let said = change.concern(7.0, &Names::default()).words();
        assert!(said.starts_with(question), "{said}");
    }
}
