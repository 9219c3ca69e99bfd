//! Any correlation as tables and a page: a chain, in any place of space.

use crate::prelude::*;
use corfem::present::report::{Derivatives, SensorPoint};

/// A chain of masses whose springs are wrong by these factors, correlated: sensors along it, or anywhere else.
pub fn chain(
    name: &str,
    wrong: &[f64],
    places: impl Fn(usize) -> (Vector3<f64>, Vector3<f64>),
) -> Report {
    let count = wrong.len();
    let chain = Chain {
        springs: wrong.iter().map(|factor| 4e4 * factor).collect(),
        masses: vec![0.5; count],
    };
    let right = wrong.iter().map(|factor| 1.0 / factor).collect_vec();
    let test = chain.modes(&right).lowest(count.min(3)).unwrap();
    let model = |factors: &[f64]| chain.model(factors).analyze(&test, None);
    let (lower, upper) = (0.8, 1.4);
    let ranges = vec![Some(Bounds { lower, upper }); count];
    let settings = Settings::default().for_modes(test.len());
    let run = correlate(model, &ranges, &settings, |_, _| true).unwrap();
    let first = model(&vec![1.0; count]).unwrap();
    let verdict = verdict_of(&run, &first, &ranges);
    let sensors = (0..count).map(|row| {
        let (place, direction) = places(row);
        SensorPoint {
            name: format!("{name} s{row}"),
            place: Some(place),
            direction,
        }
    });
    let sensors = sensors.collect_vec();
    let places = sensors
        .iter()
        .filter_map(|sensor| sensor.place)
        .collect_vec();
    let names = (0..count).map(|e| format!("{name} {e}")).collect_vec();
    Report {
        title: name.to_owned(),
        ranges,
        deviations: Some((0..count).map(|e| Some(0.01 * e as f64)).collect()),
        sensors,
        frame: places.windows(2).map(<[_]>::to_vec).collect(),
        mass: Some(chain.mass()),
        verdict: Some(verdict),
        derivatives: Some(Derivatives::at(&Comparison::from(&first)).unwrap()),
        ..Report::from_correlation("chain", &names, &test, &(&run.initial).into(), Some(&run))
    }
}

/// A chain along x with three of its four springs wrong.
fn wrong_chain() -> Report {
    chain("rod", &[0.9, 1.1, 0.95, 1.0], along)
}

fn along(row: usize) -> (Vector3<f64>, Vector3<f64>) {
    (Vector3::new(row as f64, 0.0, 0.0), Vector3::x())
}

/// The document without its scripts, which hold no tags of it.
pub fn without_scripts(html: &str) -> String {
    let (first, rest) = html.split_once("<script>").unwrap_or((html, ""));
    let rest = rest.split("<script>");
    let behind = rest.filter_map(|part| part.split_once("</script>"));
    first.to_owned() + &behind.map(|(_, behind)| behind).collect::<String>()
}

/// Whether every tag of a document is closed in its order and every `&` begins an entity.
pub fn is_well_formed(xml: &str) -> bool {
    let mut open: Vec<&str> = Vec::new();
    let xml = without_scripts(xml);
    for tag in xml.split('<').skip(1) {
        let Some((tag, words)) = tag.split_once('>') else {
            return false;
        };
        let name = tag
            .split([' ', '\n', '/'])
            .find(|part| !part.is_empty())
            .unwrap_or_default();
        if tag.starts_with('/') {
            if open.pop() != Some(name) {
                return false;
            }
        } else if !tag.ends_with('/') && !["!DOCTYPE", "meta", "br", "input"].contains(&name) {
            open.push(name);
        }
        let is_entity = |after: &str| after.chars().take(7).any(|letter| letter == ';');
        let entities = [tag, words].map(|part| part.split('&').skip(1).all(is_entity));
        if entities != [true; 2] || tag.matches('"').count() % 2 == 1 {
            return false;
        }
    }
    open.is_empty()
}

#[test]
fn pairs_are_marked_by_the_usual_limits_of_cross_orthogonality() {
    let mut subject = chain("rod", &[1.0; 4], along);
    let marks = |subject: &Report| {
        let rows = paired_table(subject).unwrap().rows.into_iter();
        rows.map(|row| row.cells.last().unwrap().computed())
            .take(3)
            .collect_vec()
    };
    assert_eq!(marks(&subject), ["good"; 3]);
    let [first, second] = [0, 1].map(|mode| subject.test.shapes().column(mode).clone_owned());
    // A mode turned by an angle toward the next has its cosine as cross-orthogonality, and its sine as another.
    for (sine, mark) in [(0.04_f64, "good"), (0.09, "acceptable"), (0.2, "poor")] {
        let turned = (1.0 - sine * sine).sqrt() * &first + sine * &second;
        alter(&mut subject.test, |_, shapes| shapes.set_column(0, &turned));
        assert_eq!(marks(&subject)[0], mark, "{sine}");
    }
    subject.mass = None;
    let columns = paired_table(&subject).unwrap().columns;
    assert!(columns.iter().all(|column| !column.name.contains("cross")));
}

#[test]
fn a_factor_at_its_bound_says_so_and_one_within_does_not() {
    let subject = chain("rod", &[0.5, 1.0, 1.0, 1.0], along);
    let Table { columns, rows, .. } = factor_table(&subject);
    let cell = |e: usize, name: &str| {
        let column = columns
            .iter()
            .position(|column| column.name == name)
            .unwrap();
        let row = rows.iter().find(|row| row.label == subject.parameters[e]);
        row.unwrap().cells[column].computed()
    };
    let factors = subject.factors();
    assert_eq!((&cell(0, "Remark")[..], factors[0]), ("at bound", 1.4));
    for (e, factor) in factors.iter().enumerate().skip(1) {
        let is_said = cell(e, "Remark").contains("at bound");
        assert_eq!(is_said, subject.is_at_bound(e, *factor));
    }
}

/// The surest change stands first: by deviations where they are known, else by size.
#[test]
fn factors_stand_in_the_order_of_how_sure_their_changes_are() {
    let subject = wrong_chain();
    for deviations in [
        None,
        Some(vec![Some(0.9), Some(0.01), Some(0.02), Some(0.5)]),
    ] {
        let subject = Report {
            deviations,
            ..subject.clone()
        };
        let sure = |e: usize| {
            let change = subject.factors()[e].ln().abs();
            change / subject.log_deviation(e).unwrap_or(1.0)
        };
        let order = subject.by_sureness();
        let key = |e: usize| (subject.is_unseen(e), -sure(e));
        assert!(order.is_sorted_by(|&a, &b| key(a) <= key(b)));
        let table = factor_table(&subject);
        let labels = table.rows.iter().map(|row| &row.label).collect_vec();
        let expected = order.iter().map(|&e| &subject.parameters[e]).collect_vec();
        assert_eq!(labels, expected);
    }
}

/// What stands against it first, then the errors, the surest changes, and what is known.
#[test]
fn the_answer_says_what_is_sure_and_no_more() {
    let subject = wrong_chain();
    let [first, last] = [&subject.initial, subject.corrected()].map(|check| check.errors);
    let rms = |of: fn(&Errors) -> f64| [&first, &last].map(|errors| 100.0 * of(errors));
    let ([f, fs], [s, ss]) = (rms(Errors::frequency_rms), rms(Errors::shape_rms));
    let errors = format!("Frequency error {f:.2} → {fs:.2} %, shape error {s:.2} → {ss:.2} %; ");
    let surest = |deviations: Option<Vec<Option<f64>>>| {
        let each = deviations.iter().flatten().zip(subject.factors());
        let intervals = each.map(|(own, factor)| {
            let off = 2.0 * own.ok_or(Withheld::NoOptimum)?;
            let ends = [1.0 - off, 1.0 + off].map(|end| factor * end);
            Ok(Bounds {
                lower: ends[0],
                upper: ends[1],
            })
        });
        let subject = Report {
            intervals: intervals.collect(),
            deviations,
            ..subject.clone()
        };
        subject.answer().replace(&errors, "")
    };
    // A tenth of every factor is nothing sure, a thousandth is, and where none is known only the errors and changes are told.
    let of = |count: usize| {
        format!("{count} of 4 factors differ from 1 beyond their interval, if only these are wrong")
    };
    let unsure = format!("{}; 4 unchanged, 0 unknown.", of(0));
    assert_eq!(surest(Some(vec![Some(0.1); 4])), unsure);
    let sure = surest(Some(vec![Some(0.001), Some(0.001), None, None]));
    let mut parts = vec![of(2), "; 0 unchanged, 2 unknown.".to_owned()];
    for e in [0, 1] {
        let percent = 100.0 * (subject.factors()[e] - 1.0);
        let sign = if percent < 0.0 { "−" } else { "+" };
        parts.push(format!("rod {e} {sign}{:.1} %", percent.abs()));
    }
    assert!(
        parts.iter().all(|part| sure.contains(part)),
        "{sure}: {parts:?}"
    );
    assert_eq!(surest(Some(vec![None; 4])), "no factor has an interval.");
    let named = surest(None);
    assert!(
        named.starts_with("rod ") && !named.contains("interval"),
        "{named}"
    );
    let mut failed = subject.clone();
    failed.verdict.as_mut().unwrap().is_within = false;
    for words in ["Outside tolerance", "The model does not explain the test"] {
        let words = format!("{words}: frequency error ");
        assert!(failed.answer().starts_with(&words));
        failed.is_judged_by_noise = true;
    }
}
