//! The wings with wrong gages, correlated, as a report shows a correlation.

use super::known::recovered;
use crate::prelude::*;
use corfem::present::report::{Derivatives, SensorPoint};

/// The delta wing with wrong gages.
///
/// # Errors
/// Those of its model.
pub fn wing_subject(wing: &DeltaWing, run: &WingCorrelation) -> Result<Report, PresentError> {
    let names = GROUPS.map(|group| group.name.to_owned());
    let model = first_model(wing)?;
    let structure = model.structure();
    let place = |label| {
        structure
            .grids()
            .iter()
            .find(|grid| grid.label == label)
            .map(|grid| grid.position)
    };
    let sensor = |label| up(format!("{label} z"), place(label).unwrap_or_default());
    let held = structure.grids().iter().filter(|grid| grid.constrained[2]);
    let first = model.analyze(&[1.0; GROUPS.len()], &run.test, None)?;
    Ok(Report {
        title: "Delta wing with wrong gages".to_owned(),
        ranges: model.factor_ranges()?,
        supports: held.map(|grid| grid.position).collect(),
        sensors: measured_grids(structure).into_iter().map(sensor).collect(),
        mass: Some(model.matrices(&[1.0; GROUPS.len()])?.mass),
        derivatives: Some(Derivatives::at(&Comparison::from(&first))?),
        truth: GROUPS.iter().map(Group::true_factor).collect(),
        verdict: Some(judged(
            &run.correlation,
            &run.test,
            &run.shares,
            &model.factor_ranges()?,
        )?),
        ..Report::from_correlation(
            "delta_wing",
            &names,
            &run.test,
            &ExactResult::from(&run.correlation.initial),
            Some(&run.correlation),
        )
        .with_structure(structure)
    })
}

/// Delta wing and the wing of [`recovered`], each correlated from wrong gages.
///
/// # Errors
/// Those of both correlations, and of [`wing_subject`].
pub fn wing_subjects() -> Result<[Report; 2], PresentError> {
    let (wing, (known, run)) = (DeltaWing::embedded(), recovered()?);
    let names = known
        .model
        .parameters()
        .iter()
        .map(|group| group.name.clone())
        .collect_vec();
    let (title, ranges) = (
        "Wing of 1,458 DOF with wrong gages".to_owned(),
        known.model.factor_ranges()?,
    );
    let initial = ExactResult::from(&run.initial);
    let first =
        known
            .model
            .analyze(&vec![1.0; names.len()], &known.test, Some(known.test.len()))?;
    let seen: Vec<f64> = parts(&first);
    let verdict = judged(&run, &known.test, &seen, &ranges)?;
    let large = Report::from_correlation("wing", &names, &known.test, &initial, Some(&run))
        .with_structure(known.model.structure());
    let delta = wing_subject(&wing, &correlate_wing(&wing, |_, _| ())?)?;
    Ok([
        delta,
        Report {
            title,
            ranges,
            truth: known.truth,
            verdict: Some(verdict),
            ..large
        },
    ])
}

/// Largest part of a test mode's generalized stiffness that each parameter has.
fn parts(first: &Model) -> Vec<f64> {
    let shares = first.test_shares().iter();
    shares.map(|share| share.diagonal().amax()).collect()
}

/// The verdict on a correlation whose tolerances are sums over its modes.
///
/// # Errors
/// What [`mode_errors`] refuses.
fn judged(
    run: &Correlation,
    test: &Modes,
    seen: &[f64],
    ranges: &[Option<Bounds>],
) -> Result<Verdict, Error> {
    let best = run.best_check();
    let errors = mode_errors(&best.modes, &best.pairing, test)?;
    Ok(Judged { seen, ranges }.of_loops(run, &errors, Errors::sum, false))
}

/// A sensor that measures upward.
fn up(name: String, place: Vector3<f64>) -> SensorPoint {
    SensorPoint {
        name,
        place: Some(place),
        direction: Vector3::z(),
    }
}
