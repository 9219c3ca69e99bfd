//! What of a model goes into the deck of an analysis, and what of an analysis into the correlation.

#![cfg(unix)]

use crate::common::fake_solver::{fake, solver};
use crate::common::outer_loop::program::HEADING;
use crate::common::outer_loop::read_cases;
use crate::prelude::*;
use crate::readers::nastran95_analysis::disordered;

#[test]
fn the_deck_of_an_analysis_has_every_element_twice() {
    let model = disordered();
    let home = fake("cat > \"$RFDIR/deck\"");
    let error = solver(&home)
        .elements(&model, &[2.0, 1.0])
        .expect_err("no answer");
    assert!(error.to_string().contains("nothing was written"), "{error}");
    let text = fs::read_to_string(home.path().join("rf/deck")).unwrap();
    for line in [
        "INSERT READ,-1 $",
        "OUTPUT5 KGG,KAA,MAA,,//-1/15/*CORFEM*/1 $",
        "EXIT $",
        "ENDALTER",
        "DIAG    44",
    ] {
        assert!(text.lines().any(|found| found == line), "{line}");
    }
    let read = corfem::files::deck::read("deck", text.as_bytes(), &[])
        .unwrap()
        .model;
    // Five grids and two dynamic points, then a grid for every corner, after all of them and held.
    let labels = read.grids.iter().map(|grid| grid.label).collect_vec();
    assert_eq!(labels[..7], [1, 3, 5, 7, 9, 101, 102]);
    assert_eq!(labels[7..], (201..=213).collect_vec());
    assert!(
        read.grids[7..]
            .iter()
            .all(|grid| grid.constrained == [true; 3])
    );
    let labels = read
        .elements
        .iter()
        .map(|element| element.label)
        .collect_vec();
    assert_eq!(labels, [2, 4, 6, 8, 12, 40, 201, 202, 203, 204, 205, 206]);
    assert_eq!(read.elements[5].size, 0.2);
    let position = |label: usize| {
        read.grids
            .iter()
            .find(|grid| grid.label == label)
            .map(|grid| grid.position)
    };
    let mut next = 201..;
    for (one, other) in read.elements[..6].iter().zip(&read.elements[6..]) {
        assert_eq!((one.kind, one.size), (other.kind, other.size));
        assert_eq!(one.material, other.material);
        for (&a, &b) in one.grids.iter().zip(&other.grids) {
            assert_eq!(Some(b), next.next());
            assert!(position(a).is_some() && position(a) == position(b));
        }
    }
    assert_eq!(read.masses.len(), 2);
}

#[test]
fn a_deck_holds_point_masses_alone() {
    let mut mass = eye(2);
    mass[(0, 1)] = 0.1;
    mass[(1, 0)] = 0.1;
    let model = disordered();
    let coupled = FiniteElementModel::new(
        model.structure().clone(),
        model.load_distribution().clone(),
        mass,
        model.parameters().to_vec(),
    )
    .unwrap();
    let error = BulkData::from_model(&coupled, &[1.0, 1.0], &[Vector3::zeros(); 2]);
    assert!(matches!(
        error,
        Err(FileError::Method(Error::Value {
            what: "coupling",
            expected: "zero: a deck has point masses alone",
            ..
        }))
    ));
}

#[test]
fn element_matrices_of_another_origin_must_fit() {
    let model = disordered();
    let own = model
        .element_matrices()
        .iter()
        .map(|element| element.unit.clone())
        .collect_vec();
    let doubled = own.iter().map(|unit| 2.0 * unit).collect();
    let stiffer = model.with_unit_stiffness(doubled).unwrap();
    let (once, twice) = (
        model.matrices(&[1.0, 1.0]).unwrap(),
        stiffer.matrices(&[1.0, 1.0]).unwrap(),
    );
    let expected = 2.0 * once.stiffness;
    assert_relative_eq!(
        twice.stiffness,
        expected,
        epsilon = MATRIX_ROUND_OFF * expected.amax()
    );
    let changed = |change: &dyn Fn(&mut Vec<DMatrix<f64>>)| {
        let mut units = own.clone();
        change(&mut units);
        model
            .with_unit_stiffness(units)
            .expect_err("they do not fit")
    };
    let error = changed(&|units| drop(units.pop()));
    assert!(
        matches!(
            error,
            Error::WrongShape {
                what: "element matrices",
                expected_rows: 6,
                rows: 5,
                ..
            }
        ),
        "{error}"
    );
    let error = changed(&|units| units[1] = eye(4));
    assert!(
        matches!(
            error,
            Error::WrongShape {
                what: "element stiffness",
                expected_rows: 3,
                rows: 4,
                columns: 4,
                ..
            }
        ),
        "{error}"
    );
    let error = changed(&|units| units[0][(0, 1)] += 1e7);
    assert!(
        matches!(
            error,
            Error::Value {
                what: "relative asymmetry",
                ref owner,
                ..
            } if owner == "element stiffness"
        ),
        "{error}"
    );
    let error = changed(&|units| units[0][(0, 0)] = f64::NAN);
    assert!(
        matches!(
            error,
            Error::Value {
                what: "element stiffness",
                expected: "a finite number",
                ..
            }
        ),
        "{error}"
    );
}

/// Test modes and passes come from the analysis that is given: four times the stiffness on both sides doubles every
/// frequency and leaves every factor alone.
#[test]
fn a_case_runs_with_the_analysis_it_is_given() {
    let case = case_of(2);
    let stiffer = |model: &FiniteElementModel, _: &[f64]| {
        let elements = model.element_matrices().iter();
        let units = elements.map(|element| 4.0 * &element.unit).collect();
        Ok(model.with_unit_stiffness(units)?)
    };
    let own = run_case(&case, |_, _| ()).unwrap();
    let other = correlate_case(&case, stiffer).unwrap();
    for (a, b) in [
        (&own.test, &other.test),
        (
            &own.correlation.passes[1].check.modes,
            &other.correlation.passes[1].check.modes,
        ),
    ] {
        let doubled = b.omega_squared().map(|root| root / 4.0);
        assert_relative_eq!(doubled, a.omega_squared(), max_relative = GOLDEN_RELATIVE);
    }
    for (a, b) in own.pass_gages[1].iter().zip(&other.pass_gages[1]) {
        assert_relative_eq!(a, b, max_relative = GOLDEN_RELATIVE);
    }
}

/// With the crate's own elements it prints, as the golden has it, what the crate finds.
#[test]
fn a_history_reads_as_the_golden_does() {
    let golden = include_str!("../../golden/nastran95/outer_loop.toml");
    assert!(golden.starts_with(&format!("{HEADING}\n[[case]]\nnumber = 1\n")));
    for number in [2, 4] {
        let case = case_of(number);
        let own = run_case(&case, |_, _| ()).unwrap();
        let run = correlate_case(&case, |model, _| Ok(model.clone())).unwrap();
        let [read] = &read_cases(&run.toml().unwrap())[..] else {
            panic!("case {number}: not one case")
        };
        assert_eq!(read.number, number);
        assert_eq!(read.test_frequencies_hz, own.test.frequencies_hz());
        assert_eq!(read.initial.gages_in, case.first_gages());
        assert_eq!(read.passes.len(), own.correlation.passes.len());
        let gages = read.passes.iter().map(|pass| &pass.gages_in);
        assert!(gages.eq(&own.pass_gages), "case {number}");
        for (pass, expected) in read.passes.iter().zip(&own.correlation.passes) {
            let errors = &expected.check.errors;
            assert_eq!(pass.iterations, Some(expected.inner.iterations.len()));
            assert_eq!(pass.frequencies_hz, paired_hz(&expected.check));
            assert_eq!(pass.frequency_rms, errors.frequency_rms());
            assert_eq!(pass.shape_rms, errors.shape_rms());
        }
    }
}
