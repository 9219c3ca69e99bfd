//! NASTRAN-95 itself, for which it must be installed: it answers as stored, and runs the decks as they are written.

use crate::prelude::*;

/// The program, which these tests need: `cargo test nastran -- --include-ignored` runs them too.
fn program() -> Nastran95 {
    let folder = std::env::var_os("NASTRAN95").map_or_else(default_folder, Into::into);
    Nastran95::in_folder(&folder).unwrap_or_else(|error| {
        panic!("{error}; golden/nastran95/README.md says how to install it")
    })
}

#[test]
#[ignore = "needs NASTRAN-95"]
fn nastran_answers_as_stored() {
    let nastran = program();
    for stored in stored() {
        let case = Case::new(stored.number).unwrap();
        for check in once(&stored.initial).chain(&stored.passes) {
            let model = case.model_with(&check.gages_in).unwrap();
            let dynamic = nastran
                .elements(&model, &[1.0; PANEL_COUNT])
                .and_then(|model| Ok(model.matrices(&[1.0; PANEL_COUNT])?))
                .unwrap();
            let found = solve(&dynamic.stiffness, &dynamic.mass, 9)
                .unwrap()
                .frequencies_hz();
            let mut expected = check.frequencies_hz.clone();
            expected.sort_by(f64::total_cmp);
            assert_near(
                &found,
                &expected,
                NASTRAN_AGAIN,
                &format!("case {}", stored.number),
            );
            // The shares are of this stiffness: they and the rods' sum to it.
            let panels: DMatrix<f64> = dynamic.shares.iter().sum();
            let rods = &dynamic.stiffness - panels;
            assert!(rods.symmetric_eigenvalues().min() > -NASTRAN_AGAIN * dynamic.stiffness.amax());
        }
    }
    let case = case_of(2);
    let by_nastran = |model: &_, factors: &[f64]| nastran.elements(model, factors);
    let run = correlate_case(&case, by_nastran).unwrap();
    let expected = &stored()[1].passes[1];
    assert_near(
        &run.pass_gages[1],
        &expected.gages_in,
        NASTRAN_GAGE,
        "case 2",
    );
}

#[test]
#[ignore = "needs NASTRAN-95"]
fn nastran_solves_the_written_deck_for_its_modes() {
    let nastran = program();
    for number in [2, 3] {
        let case = case_of(number);
        let model = case.model().unwrap();
        let (own, bulk) = modes_and_deck(&case, &model);
        // By NASTRAN-95's own eigensolution with the singular mass.
        let printed = nastran
            .run(&deck::write(&bulk, "box", 9, [5.0, 3000.0]).unwrap())
            .unwrap()
            .printed;
        assert_near(
            &printed_eigenvalues(&printed),
            &own,
            NASTRAN_PRINTED_EIGENVALUE,
            "printed",
        );
        // By its matrices: the nine finite roots of (KAA, MAA).
        let matrices = nastran
            .matrices(
                &deck::write(&bulk, "box", 9, [5.0, 3000.0]).unwrap(),
                1_000_000,
            )
            .unwrap();
        let lower = matrices["KAA"].clone().cholesky().unwrap().l();
        let half = lower.solve_lower_triangular(&matrices["MAA"]).unwrap();
        let reduced = lower.solve_lower_triangular(&half.transpose()).unwrap();
        let mut roots = (0.5 * (&reduced + reduced.transpose()))
            .symmetric_eigenvalues()
            .iter()
            .map(|root| root.recip())
            .collect_vec();
        roots.retain(|root| *root > 0.0 && *root < 1e3 * own[8]);
        roots.sort_by(f64::total_cmp);
        assert_near(&roots, &own, NASTRAN_EIGENVALUE, "KAA and MAA");
    }
}

/// Squared circular frequencies of a case's model, and its deck.
fn modes_and_deck(case: &Case, model: &FiniteElementModel) -> (Vec<f64>, BulkData) {
    let dynamic = model.matrices(&[1.0; PANEL_COUNT]).unwrap();
    let modes = solve(&dynamic.stiffness, &dynamic.mass, 9).unwrap();
    let points = dynamic_points(&case.reconstruction).unwrap();
    let bulk = BulkData::from_model(model, &[1.0; PANEL_COUNT], &points).unwrap();
    (modes.omega_squared().as_slice().to_vec(), bulk)
}

/// The column EIGENVALUE of the table of real eigenvalues.
fn printed_eigenvalues(printed: &str) -> Vec<f64> {
    let table = printed
        .split("R E A L   E I G E N V A L U E S")
        .nth(1)
        .unwrap();
    table
        .lines()
        .map(|line| line.split_whitespace().collect_vec())
        .filter(|fields| {
            fields.len() == 7
                && fields[0].parse::<usize>().is_ok()
                && fields[1].parse::<usize>().is_ok()
        })
        .map(|fields| fields[2].parse().unwrap())
        .take(9)
        .collect()
}

#[test]
#[ignore = "needs NASTRAN-95"]
fn nastran_analyzes_the_delta_wing_as_the_crate_does() {
    let nastran = program();
    let stored = stored_wing();
    let (model, test) = (first_model(), delta_wing::test_modes());
    for expected in stored.checks() {
        let here = model.matrices(&expected.factors).unwrap();
        let elements = nastran.elements(&model, &expected.factors).unwrap();
        let elements = Weighed(elements);
        let there = elements.matrices(&expected.factors).unwrap();
        for (here, there) in [
            (&here.stiffness, &there.stiffness),
            (&here.mass, &there.mass),
        ] {
            assert_eq!(there.shape(), (19, 19));
            assert!((there - here).amax() <= NASTRAN_SINGLE_PRECISION * here.amax());
        }
        let frequencies = |model: &DynamicModel| {
            let modes = solve(&model.stiffness, &model.mass, 19).unwrap();
            modes.frequencies_hz()
        };
        assert_near(
            &frequencies(&there),
            &frequencies(&here),
            NASTRAN_FREQUENCY,
            "delta wing",
        );
        let again = elements
            .analyze(&expected.factors, &test)
            .unwrap()
            .exact()
            .clone();
        assert_near(
            &paired_hz(&again),
            &expected.frequencies_hz,
            NASTRAN_AGAIN,
            "delta wing, stored",
        );
    }
}

#[test]
#[ignore = "needs NASTRAN-95"]
fn nastran_corrects_the_delta_wing_as_stored() {
    let nastran = program();
    let analyze = |model: &Weighed, factors: &[f64]| nastran.elements(model, factors).map(Weighed);
    let (run, _) = delta_wing::correlate_wing(analyze).unwrap();
    let stored = stored_wing();
    if std::env::var_os("CORFEM_WRITE").is_some() {
        let passes = run.passes.iter();
        let passes = passes.map(|of| {
            (
                Some(of.inner.iterations.len()),
                of.factors.clone(),
                &of.check,
            )
        });
        println!(
            "test_frequencies_hz = {:?}",
            delta_wing::test_modes().frequencies_hz()
        );
        let first = (None, vec![1.0; GROUPS.len()], &run.initial);
        for (place, (iterations, factors, check)) in once(first).chain(passes).enumerate() {
            println!(
                "\n{}",
                if place == 0 {
                    "[initial]"
                } else {
                    "[[passes]]"
                }
            );
            if let Some(iterations) = iterations {
                println!("iterations = {iterations}");
            }
            println!(
                "factors = {factors:?}\nfrequencies_hz = {:?}",
                paired_hz(check)
            );
            println!(
                "frequency_rms = {:?}\nshape_rms = {:?}",
                check.errors.frequency_rms(),
                check.errors.shape_rms()
            );
        }
        return;
    }
    assert_eq!(run.passes.len(), stored.passes.len());
    for (pass, expected) in run.passes.iter().zip(&stored.passes) {
        assert_eq!(Some(pass.inner.iterations.len()), expected.iterations);
        assert_near(
            &pass.factors,
            &expected.factors,
            SAME_HISTORY,
            "factors of the delta wing",
        );
    }
}
