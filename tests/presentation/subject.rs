//! Any correlation as tables, figures, JSON and a page: a chain, a spatial frame, and the delta wing.

use crate::common::drawings::{size, written};
use crate::evidence::wing_subjects::wing_subject;
use crate::paper::figures::{Figure, report_figures};
use crate::prelude::*;
use corfem::present::json;
use corfem::present::page::report_page;
use corfem::present::render::WIDTH;
use corfem::present::report::{Derivatives, SensorPoint};
use corfem::present::tables::report::derivative_table;

/// A chain of masses whose springs are wrong by these factors, correlated: sensors along it, or anywhere else.
pub fn chain(
    name: &str,
    wrong: &[f64],
    places: impl Fn(usize) -> (Vector3<f64>, Vector3<f64>),
) -> Report {
    let count = wrong.len();
    let shares = (0..count)
        .map(|spring| spring_stiffness(count, spring, 4e4 * wrong[spring]))
        .collect_vec();
    let right = (0..count).fold(DMatrix::zeros(count, count), |sum, spring| {
        sum + spring_stiffness(count, spring, 4e4)
    });
    let mass = DMatrix::from_diagonal_element(count, count, 0.5);
    let test = solve(&right, &mass, count.min(3)).expect("solved");
    let model = |factors: &[f64]| {
        let shares = shares.iter().zip(factors).map(|(share, f)| share * *f);
        let shares = shares.collect_vec();
        DynamicModel {
            stiffness: shares.iter().sum(),
            mass: mass.clone(),
            shares,
        }
        .analyze(&test, None)
    };
    let ranges = vec![
        Some(Bounds {
            lower: 0.8,
            upper: 1.4
        });
        count
    ];
    let (names, run_settings): (Vec<String>, _) = (
        (0..count).map(|e| format!("{name} {e}")).collect(),
        Settings::default().for_modes(test.len()),
    );
    let run = correlate(model, &ranges, &run_settings, |_, _| true).expect("it runs");
    let (first, best) = (
        model(&vec![1.0; count]).expect("analyzed"),
        run.best_check(),
    );
    let shares = first.test_shares().iter();
    let seen = shares.map(|share| share.diagonal().amax()).collect_vec();
    let judged = Judged {
        seen: &seen,
        ranges: &ranges,
    };
    let errors = mode_errors(&best.modes, &best.pairing, &test).expect("errors");
    // Told as the error sum that nine modes of the same errors would have.
    let of_nine = |errors: &Errors| 3.0 * (errors.frequency_rms() + errors.shape_rms());
    let verdict = judged.of_loops(&run, &errors, of_nine, false);
    let sensor = |row: usize| {
        let (place, direction) = places(row);
        SensorPoint {
            name: format!("{name} s{row}"),
            place: Some(place),
            direction,
        }
    };
    let sensors = (0..count).map(sensor).collect_vec();
    let frame = sensors
        .windows(2)
        .map(|pair| pair.iter().filter_map(|sensor| sensor.place).collect())
        .collect();
    Report {
        title: name.to_owned(),
        ranges,
        deviations: Some((0..count).map(|e| Some(0.01 * e as f64)).collect()),
        sensors,
        frame,
        mass: Some(mass.clone()),
        verdict: Some(verdict),
        derivatives: Some(Derivatives::at(&Comparison::from(&first)).expect("taken")),
        ..Report::from_correlation("chain", &names, &test, &(&run.initial).into(), Some(&run))
    }
}

fn along(row: usize) -> (Vector3<f64>, Vector3<f64>) {
    (Vector3::new(row as f64, 0.0, 0.0), Vector3::x())
}

static WING: LazyLock<Report> = LazyLock::new(|| {
    let wing = DeltaWing::embedded();
    let run = correlate_wing(&wing, |_, _| {}).expect("it runs");
    wing_subject(&wing, &run).expect("a subject")
});

fn subject_tables(subject: &Report) -> Vec<Table> {
    vec![
        paired_table(subject).expect("a table"),
        factor_table(subject),
        history_table(subject),
    ]
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

fn escaped(name: &str) -> String {
    let name = name
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;");
    name.replace('"', "&quot;").replace('\'', "&apos;")
}

/// What must be true of the figures of any subject.
fn check_figures(subject: &Report, figures: &[Figure]) {
    let all: String = figures.iter().map(|figure| figure.svg.as_str()).collect();
    for figure in figures {
        assert!(is_well_formed(&figure.svg), "{}", figure.name);
        assert!(
            !figure.svg.contains("NaN") && !figure.svg.contains("inf"),
            "{}",
            figure.name
        );
        assert!(
            figure.svg.contains("<title>") && figure.caption.starts_with(&subject.title),
            "{}",
            figure.name
        );
        let (width, height) = size(&figure.svg);
        for word in written(&figure.svg) {
            let [left, top, right, bottom] = word.bounds;
            let is_on = left > -1.0 && top > -1.0 && right < width + 1.0 && bottom < height + 1.0;
            assert!(is_on, "{}: {word:?}", figure.name);
        }
    }
    for name in subject
        .parameters
        .iter()
        .chain(subject.sensors.iter().map(|sensor| &sensor.name))
    {
        assert!(all.contains(&escaped(name)), "{name}");
    }
}

fn names(figures: &[Figure]) -> Vec<&str> {
    figures.iter().map(|figure| figure.name.as_str()).collect()
}

#[test]
fn a_chain_has_all_its_figures_with_names_from_a_users_file() {
    let subject = chain("rod <\"&'> x", &[0.9, 1.1, 0.95, 1.0], along);
    let figures = report_figures(&subject).expect("drawn");
    check_figures(&subject, &figures);
    assert_eq!(
        names(&figures),
        [
            "structure",
            "frequencies",
            "mode_shapes",
            "errors",
            "factors",
            "agreement",
            "derivatives"
        ]
        .map(|what| format!("chain_{what}"))
    );
    let page =
        report_page(&subject, &[], "corfem correlate <job>", "[model] # <&>\n").expect("a page");
    assert!(is_well_formed(&page));
    for parameter in &subject.parameters {
        assert!(
            page.contains(&escaped(parameter).replace("&apos;", "'")),
            "{parameter}"
        );
    }
    assert!(
        page.contains("<code>corfem correlate &lt;job&gt;</code>")
            && page.contains("<code>[model] # &lt;&amp;&gt;\n</code>")
            && page.contains("<h1>rod &lt;&quot;&amp;")
    );
}

#[test]
fn the_wing_is_a_spatial_frame_with_its_grids_sensors_and_modes() {
    let figures = report_figures(&WING).expect("drawn");
    check_figures(&WING, &figures);
    let words = written(&figures[0].svg)
        .into_iter()
        .map(|word| word.text)
        .collect_vec();
    for (label, _) in &WING.grids {
        assert!(words.contains(&label.to_string()), "{label}");
    }
    assert!(words.iter().any(|word| word.contains("depth drawn")));
    let page = report_page(&WING, &[], "corfem", "").expect("a page");
    assert!(is_well_formed(&page) && page.contains("MAC is not mass-weighted"));
}

#[test]
fn tables_hold_every_mode_and_factor_and_fit_a_page() {
    for subject in [&*WING, &chain("rod", &[0.9, 1.1, 0.95, 1.0], along)] {
        let mut tables = subject_tables(subject);
        tables.extend(derivative_table(subject));
        assert_eq!(tables[3].rows.len(), subject.parameters.len());
        for line in text(&tables).lines() {
            assert!(line.chars().count() <= WIDTH, "{line}");
        }
        assert_eq!(tables[0].rows.len(), subject.test.len() + 2);
        assert_eq!(tables[1].rows.len(), subject.parameters.len());
        assert_eq!(tables[2].rows.len(), subject.stages.len());
        assert!(tables.iter().all(|table| {
            table
                .rows
                .iter()
                .all(|row| row.cells.len() == table.columns.len())
        }));
        let json = json::report(subject).expect("a value");
        assert_eq!(
            json["factors"].as_array().map(Vec::len),
            Some(subject.parameters.len())
        );
        assert_eq!(
            json["initial"]["agreement"]["modal_assurance"][0]
                .as_array()
                .map(Vec::len),
            Some(subject.test.len())
        );
        assert!(csv(&tables).lines().count() > subject.parameters.len());
    }
}

/// The mark of every row of the paired table.
fn marks(subject: &Report) -> Vec<String> {
    let table = paired_table(subject).expect("a table");
    table
        .rows
        .iter()
        .filter_map(|row| row.cells.last())
        .map(Cell::computed)
        .take(subject.test.len())
        .collect()
}

#[test]
fn pairs_are_marked_by_the_usual_limits_of_cross_orthogonality() {
    let mut subject = chain("rod", &[1.0, 1.0, 1.0, 1.0], along);
    assert_eq!(marks(&subject), ["good"; 3]);
    let (first, second) = (
        subject.test.shapes().column(0).clone_owned(),
        subject.test.shapes().column(1).clone_owned(),
    );
    // A mode turned by an angle toward the next has its cosine as cross-orthogonality, and its sine as another.
    for (sine, mark) in [(0.04_f64, "good"), (0.09, "acceptable"), (0.2, "poor")] {
        let turned = (1.0 - sine * sine).sqrt() * &first + sine * &second;
        alter(&mut subject.test, |_, shapes| shapes.set_column(0, &turned));
        assert_eq!(marks(&subject)[0], mark, "{sine}");
    }
    subject.mass = None;
    assert!(
        paired_table(&subject)
            .expect("a table")
            .columns
            .iter()
            .all(|column| !column.name.contains("cross"))
    );
}

#[test]
fn a_factor_at_its_bound_says_so_and_one_within_does_not() {
    let subject = chain("rod", &[0.5, 1.0, 1.0, 1.0], along);
    let table = factor_table(&subject);
    let column = |name: &str| {
        let mut columns = table.columns.iter();
        columns
            .position(|column| column.name == name)
            .expect("the column")
    };
    let cell = |e: usize, name: &str| {
        let mut rows = table.rows.iter();
        let row = rows
            .find(|row| row.label == subject.parameters[e])
            .expect("a row");
        row.cells[column(name)].computed()
    };
    assert_eq!(
        (cell(0, "Remark").as_str(), subject.factors()[0]),
        ("at bound", 1.4)
    );
    for (e, factor) in subject.factors().into_iter().enumerate().skip(1) {
        assert_eq!(
            cell(e, "Remark").contains("at bound"),
            subject.is_at_bound(e, factor)
        );
    }
    let percent = 100.0 * 0.02 / subject.factors()[2];
    assert_eq!(cell(2, "Deviation"), Digits::Significant(3).write(percent));
    let without = Report {
        deviations: None,
        ..subject.clone()
    };
    let columns = factor_table(&without).columns;
    assert!(columns.iter().all(|column| column.name != "Deviation"));
}

/// The surest change stands first: by deviations where they are known, else by size.
#[test]
fn factors_stand_in_the_order_of_how_sure_their_changes_are() {
    let subject = chain("rod", &[0.9, 1.1, 0.95, 1.0], along);
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
    let subject = chain("rod", &[0.9, 1.1, 0.95, 1.0], along);
    let of = |deviations: Option<Vec<Option<f64>>>| {
        let subject = Report {
            deviations,
            ..subject.clone()
        };
        subject.answer()
    };
    let [first, last] = [&subject.initial, subject.corrected()].map(|check| check.errors);
    let errors = format!(
        "Frequency error {:.2} → {:.2} %, shape error {:.2} → {:.2} %; ",
        100.0 * first.frequency_rms(),
        100.0 * last.frequency_rms(),
        100.0 * first.shape_rms(),
        100.0 * last.shape_rms()
    );
    let surest = |deviations: Option<Vec<Option<f64>>>| of(deviations).replace(&errors, "");
    // A tenth of every factor is nothing sure, a thousandth is, and where none is known only the errors and changes are told.
    assert_eq!(
        surest(Some(vec![Some(0.1); 4])),
        "no factor surely changed; 0 of 4 factors known within 5 %."
    );
    let sure = surest(Some(vec![Some(0.001); 4]));
    assert!(
        sure.ends_with("; 4 of 4 factors known within 5 %."),
        "{sure}"
    );
    for e in [0, 1] {
        let percent = 100.0 * (subject.factors()[e] - 1.0);
        let sign = if percent < 0.0 { "−" } else { "+" };
        let words = format!("rod {e} {sign}{:.0} %", percent.abs());
        assert!(sure.contains(&words), "{sure}: {words}");
    }
    assert!(surest(Some(vec![None; 4])).ends_with("; no factor has an interval."));
    assert!(!surest(None).contains("known"));
    let mut failed = subject.clone();
    if let Some(verdict) = &mut failed.verdict {
        verdict.is_within = false;
    }
    assert!(
        failed
            .answer()
            .starts_with("Outside tolerance: frequency error ")
    );
    failed.is_judged_by_noise = true;
    let words = "The model does not explain the test: frequency error ";
    assert!(failed.answer().starts_with(words));
}

#[test]
fn stages_without_an_inner_loop_are_one_iteration_each() {
    let mut subject = chain("rod", &[0.9, 1.1, 0.95, 1.0], along);
    subject
        .stages
        .iter_mut()
        .for_each(|stage| stage.inner = None);
    let table = history_table(&subject);
    let columns = table.columns.iter().map(|of| &of.name[..]).collect_vec();
    assert_eq!(columns, ["Iterations", "Stopped by", "Error sum exact"]);
    assert!(table.rows.iter().all(|row| row.cells[0] == Cell::count(1)));
    let figures = report_figures(&subject).expect("drawn");
    check_figures(&subject, &figures);
    let errors = figures
        .iter()
        .find(|figure| figure.name == "chain_errors")
        .expect("drawn");
    assert!(!errors.svg.contains("tolerance of the pass"));
}

#[test]
fn more_than_twelve_modes_are_drawn_in_several_figures() {
    let mut subject = chain("rod", &[0.9, 1.1, 0.95, 1.0], |row| {
        (Vector3::new(row as f64, 0.0, 0.0), Vector3::z())
    });
    // Of three shapes at least one is farther off than their mean.
    let places = (0..45).map(|mode| mode % 3).collect_vec();
    subject.test = Modes::new(
        subject.test.omega_squared().select_rows(&places),
        subject.test.shapes().select_columns(&places),
    )
    .expect("modes");
    for check in [&mut subject.initial]
        .into_iter()
        .chain(subject.stages.iter_mut().map(|stage| &mut stage.check))
    {
        let pairs = places.iter().map(|&mode| check.pairing.analysis_mode[mode]);
        let signs = places.iter().map(|&mode| check.pairing.sign[mode]);
        check.pairing = Pairing {
            analysis_mode: pairs.collect(),
            sign: signs.collect(),
        };
        check.frequencies_hz = places
            .iter()
            .map(|&mode| check.frequencies_hz[mode])
            .collect();
    }
    let figures = report_figures(&Report {
        derivatives: None,
        ..subject
    })
    .expect("drawn");
    assert!(
        names(&figures).contains(&"chain_mode_shapes_1")
            && names(&figures).contains(&"chain_mode_shapes_2")
    );
}

properties! {
    #![proptest_config(crate::common::costly_config())]

    /// Names, places and directions as a user's file may have them.
    #[test]
    fn any_subject_has_sound_figures_tables_and_page(
        wrong in prop::collection::vec(0.8..1.25_f64, 2..6),
        // Not a name like "inf", which the drawings are searched for.
        name in "[ -~äß°]{1,30}".prop_filter("a number", |name| !name.contains("inf") && !name.contains("NaN")),
        places in prop::array::uniform32(-1e3..1e3_f64),
        flat in prop::array::uniform3(any::<bool>()),
        is_rotation in any::<bool>(),
    ) {
        let place = |row: usize| Vector3::from_fn(|axis, _| if flat[axis] { 0.0 } else { places[3 * row + axis] });
        let direction = |row: usize| if is_rotation { Vector3::zeros() } else { Vector3::ith(row % 3, 1.0) };
        let subject = chain(name.trim(), &wrong, |row| (place(row), direction(row)));
        let figures = report_figures(&subject).expect("drawn");
        check_figures(&subject, &figures);
        prop_assert_eq!(names(&figures).contains(&"chain_mode_shapes"), !is_rotation);
        prop_assert!(is_well_formed(&report_page(&subject, &[], &name, &name).expect("a page")));
        prop_assert!(text(&subject_tables(&subject)).lines().all(|line| line.chars().count() <= WIDTH));
    }
}
