//! A later result takes the place of an earlier one only if it explains the numbers of both no worse.

use crate::prelude::*;
use corfem::job::concern::Grade;

/// Largest distance of the factors from those of another result, in deviations.
fn apart(result: &JobResult, from: &JobResult) -> f64 {
    let both = result.found.factors.iter().zip(&from.found.factors);
    let distance = both.map(|(one, other)| (one / other).ln().abs());
    let deviations = &from.seen.deviations;
    distance
        .zip(deviations)
        .map(|(apart, deviation)| apart / deviation)
        .largest()
}

/// The law: a random test mode that the first model has no like of, at any frequency, harms nothing and is named.
#[test]
fn a_random_mode_changes_no_factor_by_more_than_noise_and_is_named() {
    let right = finished(&prepared(&building()));
    let mut draws = Draws(23);
    let (mut left_out, mut alike) = (0, 0);
    for test in 0..80 {
        let hertz =
            right.found.prepared.loaded.data.frequencies_hz[0] * draws.between(-2.0, 4.0).exp();
        let junk = [(); 5].map(|()| draws.between(-1.0, 1.0));
        let job = prepared(&retested(building(), |data| {
            data.frequencies_hz.push(hertz);
            data.shapes = data.shapes.clone().insert_column(5, 0.0);
            data.shapes.set_column(5, &junk.into());
        }));
        if !job.unpaired.iter().any(|left| left.mode == 5) {
            continue;
        }
        left_out += 1;
        let found = finished(&job);
        // The mirror: the right modes are compared, those too that join.
        assert_eq!(found.found.prepared.modes, [0, 1, 2, 3, 4], "test {test}");
        let away = apart(&found, &right);
        assert!(away < 1.0, "test {test}: {away} deviations");
        let left = found
            .trust
            .all()
            .iter()
            .find(|own| own.grade == Grade::LeftOut);
        let left = left.unwrap_or_else(|| panic!("test {test}"));
        assert_eq!(left.identifier, "not-compared-6", "test {test}");
        alike += usize::from(!left.words.contains("it resembles no mode"));
    }
    assert!(
        left_out > 20 && alike > 3,
        "{alike} of {left_out} are like a mode in the end"
    );
}
