//! The delta wing's correlation through NASTRAN-95: its stored answers against the crate.
//!
//! `golden/nastran95/delta_wing.toml` is what its correlation with NASTRAN-95 found; `golden/nastran95/README.md` says how
//! it was made and what to expect of it.

use crate::common::delta_wing::{RUN, correlate_wing, test_modes};
use crate::prelude::*;

/// NASTRAN-95's frequencies at the gages its own correlation went through are the crate's at the same gages: no panel of
/// the wing is snapped.
#[test]
fn stored_frequencies_are_the_crates_at_the_same_factors() {
    let stored = stored_wing();
    let model = first_model();
    assert_eq!(stored.initial.factors, vec![1.0; GROUPS.len()]);
    let test = test_modes();
    // They are the crate's own on both sides, perhaps by another processor.
    assert_near(
        &stored.test_frequencies_hz,
        &test.frequencies_hz(),
        NASTRAN_AGAIN,
        "test modes",
    );
    for found in stored.checks() {
        let own = model
            .analyze(&found.factors, &test)
            .unwrap()
            .exact()
            .clone();
        assert_near(
            &found.frequencies_hz,
            &paired_hz(&own),
            NASTRAN_FREQUENCY,
            "same factors",
        );
        // An RMS of differences changes by no more than the largest of them does.
        let errors = [
            (found.frequency_rms, own.errors.frequency_rms()),
            (found.shape_rms, own.errors.shape_rms()),
        ];
        for (a, b) in errors {
            assert_within(a, b, NASTRAN_FREQUENCY);
        }
        // But it is NASTRAN-95's answer: more than round-off is between them.
        let own = paired_hz(&own);
        let pairs = found.frequencies_hz.iter().zip(&own);
        let apart = pairs.map(|(a, b)| relative_error(a, b)).largest();
        assert!(apart > NASTRAN_AGAIN, "{apart}");
    }
}

/// The whole correlation through NASTRAN-95 is the built-in one: the same passes, iterations and factors.
#[test]
fn stored_correlation_is_the_crates() {
    let (stored, own) = (stored_wing(), &RUN.0);
    assert_near(
        &[stored.initial.frequency_rms, stored.initial.shape_rms],
        &[
            own.initial.errors.frequency_rms(),
            own.initial.errors.shape_rms(),
        ],
        NASTRAN_GAGE,
        "start",
    );
    assert_eq!(stored.initial.iterations, None);
    assert_eq!(stored.passes.len(), own.passes.len());
    for (found, pass) in stored.passes.iter().zip(&own.passes) {
        assert_eq!(found.iterations, Some(pass.inner.iterations.len()));
        assert_near(&found.factors, &pass.factors, NASTRAN_GAGE, "factors");
        assert_near(
            &found.frequencies_hz,
            &paired_hz(&pass.check),
            NASTRAN_FREQUENCY,
            "frequencies",
        );
        let errors = &pass.check.errors;
        assert_near(
            &[found.frequency_rms, found.shape_rms],
            &[errors.frequency_rms(), errors.shape_rms()],
            NASTRAN_GAGE,
            "errors",
        );
    }
}

#[test]
fn another_analysis_is_asked_for_every_model() {
    let mut asked = Vec::new();
    let run = correlate_wing(|model, factors| {
        asked.push(factors.to_vec());
        Ok::<_, Error>(model.clone())
    });
    let passes = run.unwrap().0.passes;
    assert_eq!(passes.len(), RUN.0.passes.len());
    // For the shares of the first model, at the start of the loop, and after every pass.
    let mut expected = vec![vec![1.0; GROUPS.len()]; 2];
    expected.extend(passes.iter().map(|pass| pass.factors.clone()));
    assert_eq!(asked, expected);
}

#[test]
fn what_an_analysis_cannot_do_is_the_correlations_error() {
    for answered in [0, 1, 2] {
        let mut left = answered;
        let error = correlate_wing(|model, _| {
            if left == 0 {
                return Err(FileError::Interrupted);
            }
            left -= 1;
            Ok(model.clone())
        });
        assert!(matches!(error, Err(FileError::Interrupted)), "{answered}");
    }
}
