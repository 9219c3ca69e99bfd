//! The loops through NASTRAN-95: its stored answers against the crate, and NASTRAN-95 itself where it is installed.
//!
//! `golden/nastran95/outer_loop.toml` is what `cargo run --example nastran95` found, and `delta_wing.toml` what the delta wing's correlation
//! with NASTRAN-95 found; `golden/nastran95/README.md` says how they were made and what to expect of them.

use crate::common::delta_wing::{RUN, correlate_wing, test_modes};
use crate::common::outer_loop::program::HEADING;
use crate::common::outer_loop::{StoredWing, StoredWingCheck, read_cases};
use crate::prelude::*;

/// Factors by which NASTRAN-95's panels are stiffer than the crate's: those it snaps, one for the others.
fn snap_factors(case: &Case) -> Vec<f64> {
    let model = case.model().unwrap();
    let structure = model.structure();
    let panels = structure.elements()[..PANEL_COUNT].iter();
    let factor = |(element, corners): (&Element, &Vec<Vector3<f64>>)| match element.kind {
        ElementKind::ShearPanel => snap_factor(corners, &element.material),
        _ => 1.0,
    };
    panels.zip(structure.corners()).map(factor).collect()
}

/// Of the box only panel 14 by 1.0000022, and where they are shear panels the covers 2 and 15 by 0.9972.
#[test]
fn only_three_panels_of_the_box_are_snapped() {
    for number in CASES {
        for (panel, factor) in (1..).zip(snap_factors(&case_of(number))) {
            let (expected, digits) = match (panel, number) {
                (14, _) => (1.000_002_2, NASTRAN_SINGLE_PRECISION),
                (2 | 15, 1) => (0.9972, PRINTED_SNAP_FACTOR),
                _ => (1.0, NASTRAN_EIGENVALUE),
            };
            assert_within(factor, expected, digits);
        }
    }
}

/// NASTRAN-95's frequencies at the gages its own correlation went through are the crate's at the same gages, once
/// the crate's panels have the stiffness of NASTRAN-95's snapped ones.
#[test]
fn stored_frequencies_are_the_crates_at_the_same_gages() {
    for stored in stored() {
        let case = case_of(stored.number);
        let factors = snap_factors(&case);
        let at = |gages: &[f64]| {
            let gages = gages.iter().zip(&factors);
            let gages = gages.map(|(gage, factor)| gage * factor).collect_vec();
            let model = case.model_with(&gages).unwrap();
            model.modes(&[1.0; PANEL_COUNT]).unwrap().frequencies_hz()
        };
        let near = |found: &[f64], gages: &[f64]| {
            let name = format!("case {}", stored.number);
            assert_near(found, &at(gages), NASTRAN_FREQUENCY, &name);
        };
        near(&stored.test_frequencies_hz, &[TEST_GAGE; PANEL_COUNT]);
        assert_eq!(stored.initial.gages_in, case.first_gages());
        assert_eq!(stored.passes.len(), published_passes(case.number));
        for check in once(&stored.initial).chain(&stored.passes) {
            // The report lists frequencies in the order of the test modes.
            near(&ascending(&check.frequencies_hz), &check.gages_in);
        }
    }
}

/// The whole correlation through NASTRAN-95 beside the built-in one: the same iterations and gages as far as the inner
/// loop's path is the same.
#[test]
fn stored_correlations_are_the_crates() {
    // What the paper reached is reached with NASTRAN-95 too: Table 3, 5 and 7's last rows, Case 2's 0.42 % within 0.04.
    let published = [[0.0045, 0.0054], [0.0046, 0.0048], [0.0041, 0.0125]];
    for stored in stored() {
        let own = case_run(&case_of(stored.number));
        let gage = match stored.number {
            1 => NASTRAN_GAGE_CASE_1,
            _ => NASTRAN_GAGE,
        };
        let name = format!("case {}", stored.number);
        let near = |a: &[f64], b: &[f64]| assert_near(a, b, gage, &name);
        let (initial, errors) = (&stored.initial, &own.correlation.initial.errors);
        near(
            &[initial.frequency_rms, initial.shape_rms],
            &[errors.frequency_rms(), errors.shape_rms()],
        );
        let passes = &own.correlation.passes;
        assert_eq!(stored.passes.len(), passes.len());
        for ((check, pass), gages) in stored.passes.iter().zip(passes).zip(&own.pass_gages) {
            near(&check.gages_in, gages);
            near(&check.frequencies_hz, &paired_hz(&pass.check));
            assert_eq!(
                check.iterations,
                Some(pass.inner.iterations.len()),
                "{name}"
            );
        }
        if let Some([frequency, shape]) = published.get(stored.number - 1) {
            let last = stored.passes.last().unwrap();
            assert!(
                last.frequency_rms <= *frequency && last.shape_rms <= *shape,
                "{name}"
            );
        }
    }
}

/// With elements four times as stiff, those of the test too, it prints as the golden has it what the crate finds, with frequencies twice as high.
#[test]
fn a_history_reads_as_the_golden_does() {
    let golden = include_str!("../../golden/nastran95/outer_loop.toml");
    assert!(golden.starts_with(&format!("{HEADING}\n[[case]]\nnumber = 1\n")));
    for number in [2, 4] {
        let case = case_of(number);
        let own = case_run(&case);
        let stiffer = |model: &FiniteElementModel, _: &[f64]| {
            let elements = model.element_matrices().iter();
            let units = elements.map(|element| 4.0 * &element.unit).collect();
            Ok(model.with_unit_stiffness(units)?)
        };
        let run = correlate_case(&case, stiffer).unwrap();
        let [read] = &read_cases(&run.toml().unwrap())[..] else {
            panic!("case {number}: not one case")
        };
        let near = |found: &[f64], expected: &[f64], times: f64| {
            assert_alike(
                found,
                expected.iter().map(|own| times * own),
                GOLDEN_RELATIVE,
            );
        };
        assert_eq!(read.number, number);
        near(&read.test_frequencies_hz, &own.test.frequencies_hz(), 2.0);
        let first = (
            &read.initial,
            (&own.correlation.initial, case.first_gages()),
        );
        let passes = own.correlation.passes.iter().map(|own| &own.check);
        let passes = read.passes.iter().zip(passes.zip(own.pass_gages));
        for (read, (check, gages)) in once(first).chain(passes) {
            let errors = [check.errors.frequency_rms(), check.errors.shape_rms()];
            near(&read.gages_in, &gages, 1.0);
            near(&read.frequencies_hz, &paired_hz(check), 2.0);
            near(&[read.frequency_rms, read.shape_rms], &errors, 1.0);
        }
        let counts = read.passes.iter().map(|own| own.iterations);
        let passes = own.correlation.passes.iter();
        assert!(counts.eq(passes.map(|own| Some(own.inner.iterations.len()))));
    }
}

/// NASTRAN-95's frequencies at the gages its own correlation went through are the crate's at the same gages: no panel of
/// the wing is snapped.
#[test]
fn stored_frequencies_are_the_crates_at_the_same_factors() {
    let (stored, model, test) = (stored_wing(), first_model(), test_modes());
    assert_eq!(stored.initial.factors, vec![1.0; GROUPS.len()]);
    // They are the crate's own on both sides, perhaps by another processor.
    let own = test.frequencies_hz();
    assert_near(
        &stored.test_frequencies_hz,
        &own,
        NASTRAN_AGAIN,
        "test modes",
    );
    for found in stored.checks() {
        let own = model
            .analyze(&found.factors, &test)
            .unwrap()
            .exact()
            .clone();
        let hertz = paired_hz(&own);
        assert_near(
            &found.frequencies_hz,
            &hertz,
            NASTRAN_FREQUENCY,
            "same factors",
        );
        // An RMS of differences changes by no more than the largest of them does.
        assert_within(
            found.frequency_rms,
            own.errors.frequency_rms(),
            NASTRAN_FREQUENCY,
        );
        assert_within(found.shape_rms, own.errors.shape_rms(), NASTRAN_FREQUENCY);
        // But it is NASTRAN-95's answer: more than round-off is between them.
        let pairs = found.frequencies_hz.iter().zip(&hertz);
        assert!(pairs.map(|(a, b)| relative_error(a, b)).largest() > NASTRAN_AGAIN);
    }
}

/// The wing's correlation as it is stored.
fn as_stored(run: &Correlation) -> StoredWing {
    let check = |iterations, factors: &[f64], of: &State| StoredWingCheck {
        iterations,
        factors: factors.to_vec(),
        frequencies_hz: paired_hz(of),
        frequency_rms: of.errors.frequency_rms(),
        shape_rms: of.errors.shape_rms(),
    };
    let pass = |own: &Pass| check(Some(own.inner.iterations.len()), &own.factors, &own.check);
    StoredWing {
        test_frequencies_hz: test_modes().frequencies_hz(),
        initial: check(None, &vec![1.0; GROUPS.len()], &run.initial),
        passes: run.passes.iter().map(pass).collect(),
    }
}

/// The whole correlation through NASTRAN-95 is the built-in one: the same passes, iterations and factors.
#[test]
fn stored_correlation_is_the_crates() {
    let (stored, own) = (stored_wing(), as_stored(&RUN.0));
    assert_eq!(stored.passes.len(), own.passes.len());
    for (found, own) in stored.checks().zip(own.checks()) {
        assert_eq!(found.iterations, own.iterations);
        assert_near(&found.factors, &own.factors, NASTRAN_GAGE, "factors");
        assert_near(
            &found.frequencies_hz,
            &own.frequencies_hz,
            NASTRAN_FREQUENCY,
            "hertz",
        );
        let errors = |of: &StoredWingCheck| [of.frequency_rms, of.shape_rms];
        assert_near(&errors(found), &errors(own), NASTRAN_GAGE, "errors");
    }
}

/// The program, which these tests need: `cargo test nastran -- --include-ignored` runs them too.
fn program() -> Nastran95 {
    let folder = std::env::var_os("NASTRAN95").map_or_else(default_folder, Into::into);
    Nastran95::in_folder(&folder).unwrap()
}

#[test]
#[ignore = "needs NASTRAN-95"]
fn nastran_answers_as_stored_and_solves_the_written_deck() {
    let (nastran, ones) = (program(), [1.0; PANEL_COUNT]);
    for stored in stored() {
        for check in once(&stored.initial).chain(&stored.passes) {
            let model = case_of(stored.number).model_with(&check.gages_in).unwrap();
            let found = nastran.elements(&model, &ones).unwrap();
            let found = found.modes(&ones).unwrap().frequencies_hz();
            let expected = ascending(&check.frequencies_hz);
            assert_near(
                &found,
                &expected,
                NASTRAN_AGAIN,
                &format!("case {}", stored.number),
            );
        }
    }
    let by_nastran = |model: &_, factors: &[f64]| nastran.elements(model, factors);
    let run = correlate_case(&case_of(2), by_nastran).unwrap();
    let expected = &stored()[1].passes[1].gages_in;
    assert_near(&run.pass_gages[1], expected, NASTRAN_GAGE, "case 2");
    // By NASTRAN-95's own eigensolution with the singular mass.
    for number in [2, 3] {
        let case = case_of(number);
        let model = case.model().unwrap();
        let points = dynamic_points(&case.reconstruction).unwrap();
        let bulk = BulkData::from_model(&model, &ones, &points).unwrap();
        let text = deck::write(&bulk, "box", 9, [5.0, 3000.0]).unwrap();
        let printed = printed_eigenvalues(&nastran.run(&text).unwrap().printed);
        let own = model.modes(&ones).unwrap();
        let own = own.omega_squared().as_slice();
        assert_near(&printed, own, NASTRAN_PRINTED_EIGENVALUE, "printed");
    }
}

/// The column EIGENVALUE of the table of real eigenvalues.
fn printed_eigenvalues(printed: &str) -> Vec<f64> {
    let table = printed.split("R E A L   E I G E N V A L U E S").nth(1);
    let lines = table.unwrap().lines();
    let lines = lines.map(|line| line.split_whitespace().collect_vec());
    let is_number = |word: &&str| word.parse::<usize>().is_ok();
    let rows = lines.filter(|own| own.len() == 7 && own[..2].iter().all(is_number));
    rows.map(|own| own[2].parse().unwrap()).take(9).collect()
}

#[test]
#[ignore = "needs NASTRAN-95"]
fn nastran_analyzes_the_delta_wing_as_the_crate_does() {
    let (nastran, model, test) = (program(), first_model(), test_modes());
    for expected in stored_wing().checks() {
        let factors = &expected.factors;
        let elements = Weighed(nastran.elements(&model, factors).unwrap());
        let (here, there) = (
            model.matrices(factors).unwrap(),
            elements.matrices(factors).unwrap(),
        );
        for (here, there) in [
            (&here.stiffness, &there.stiffness),
            (&here.mass, &there.mass),
        ] {
            assert_eq!(there.shape(), (19, 19));
            assert!((there - here).amax() <= NASTRAN_SINGLE_PRECISION * here.amax());
        }
        let again = elements.analyze(factors, &test).unwrap();
        let again = paired_hz(again.exact());
        assert_near(
            &again,
            &expected.frequencies_hz,
            NASTRAN_AGAIN,
            "delta wing",
        );
    }
}

#[test]
#[ignore = "needs NASTRAN-95"]
fn nastran_corrects_the_delta_wing_as_stored() {
    let nastran = program();
    let analyze = |model: &Weighed, factors: &[f64]| nastran.elements(model, factors).map(Weighed);
    let (run, stored) = (correlate_wing(analyze).unwrap().0, stored_wing());
    let found = as_stored(&run);
    if std::env::var_os("CORFEM_WRITE").is_some() {
        return println!("{}", toml::to_string(&found).unwrap());
    }
    assert_eq!(found.passes.len(), stored.passes.len());
    for (found, stored) in found.passes.iter().zip(&stored.passes) {
        assert_eq!(found.iterations, stored.iterations);
        assert_near(
            &found.factors,
            &stored.factors,
            SAME_HISTORY,
            "factors of the delta wing",
        );
    }
}
