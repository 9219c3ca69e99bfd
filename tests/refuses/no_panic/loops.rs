//! Errors, analyses, steps and the loops.

use super::{Entry, Numbers, chain, unseen};
use crate::prelude::*;

/// A chain as sensors see it, with a share of its stiffness or of its mass.
fn sensed(d: &mut Draws) -> Result<SensorModel, Error> {
    let model = chain(d)?;
    if d.below(2) == 0 {
        return Ok(SensorModel::from(&model));
    }
    let count = model.test().len();
    let springs = (0..count).map(|spring| spring_stiffness(count, spring, 100.0));
    let (stiffness, mass) = (springs.sum::<DMatrix<f64>>(), eye(count));
    let shares = [
        ParameterMatrix::Stiffness(stiffness.clone()),
        ParameterMatrix::Mass(spring_stiffness(count, 0, 0.5)),
    ];
    let (whole, sensors) = of_dense(&stiffness, &mass, &shares)?;
    whole.analyze(&[1.0; 2], &sensors, model.test(), by_sorting(), count)
}

fn comparison(d: &mut Draws) -> Result<Comparison, Error> {
    Ok(Comparison::from(&chain(d)?))
}

fn weights(d: &mut Draws, count: usize) -> Vec<ModeWeight> {
    let mut weight = || d.number().abs();
    let both = |_| ModeWeight {
        frequency: weight(),
        shape: weight(),
    };
    (0..count).map(both).collect()
}

/// Gage factors of so many parameters, or of others.
fn gages(d: &mut Draws, count: usize) -> Vec<f64> {
    (0..d.about(count)).map(|_| d.unit()).collect()
}

fn rule(d: &mut Draws) -> StepRule {
    StepRule::ALL[d.below(StepRule::ALL.len())]
}

/// Settings of no more than so many passes.
fn at_most(most_passes: usize) -> Settings {
    Settings {
        most_passes,
        ..Settings::default()
    }
}

pub const LOOPS: &[Entry] = &[
    ("ModalModel::at", |d| {
        let model = chain(d)?;
        let count = d.about(model.shares().len());
        let state = model.at(&d.list(count))?;
        Ok(vec![state.errors.sum()])
    }),
    ("ModalModel::error_changes", |d| {
        let model = chain(d)?;
        model.error_changes(&d.state(&model))
    }),
    ("ModalModel::stiffness_changes", |d| {
        let model = chain(d)?;
        let (gages, state) = (gages(d, model.shares().len()), d.state(&model));
        Ok(model.stiffness_changes(&state, &gages, rule(d)))
    }),
    ("SensorModel::at", |d| {
        let model = sensed(d)?;
        let count = d.about(model.shares().len());
        let state = model.at(&d.list(count))?;
        Ok(vec![state.errors.sum()])
    }),
    ("SensorModel::error_changes", |d| {
        let model = sensed(d)?;
        let own = model.at(&vec![1.1; model.shares().len()])?;
        let other = sensed(d)?.exact().clone();
        model.error_changes(if d.below(6) == 0 { &other } else { &own })
    }),
    ("SensorModel::stiffness_changes", |d| {
        let model = sensed(d)?;
        let gages = gages(d, model.shares().len());
        Ok(model.stiffness_changes(model.exact(), &gages, rule(d)))
    }),
    ("SensorModel::weighted", |d| {
        let model = sensed(d)?;
        let count = d.about(model.test().len());
        let model = model.weighted(&weights(d, count))?;
        Ok(vec![model.exact().errors.sum()])
    }),
    // A change whose entries are no numbers is refused by the formulae.
    ("derivatives::without_close_couplings", |d| {
        let size = d.size();
        unseen(without_close_couplings(
            &d.list(size),
            &d.matrix(size, size),
        ))
    }),
    ("derivatives::error_change", |d| {
        let model = chain(d)?;
        let (state, size) = (d.state(&model), d.size());
        error_change(&state, &d.symmetric(size), model.test()).map(|found| vec![found])
    }),
    ("changed_modes::changed_modes", |d| {
        let (count, size) = (d.size(), d.size());
        let (found, p) = changed_modes(&d.modes(count)?, &d.symmetric(size))?;
        Ok([found.numbers(), p.numbers()].concat())
    }),
    ("inner_loop::first_factors", |d| {
        let model = chain(d)?;
        let settings = InnerSettings {
            first_relaxation: d.number(),
            ..InnerSettings::default()
        };
        first_factors(&model, &settings)
    }),
    ("inner_loop::run", |d| {
        let model = chain(d)?;
        let count = d.about(model.shares().len());
        let base = if d.below(2) == 0 {
            vec![1.0; count]
        } else {
            d.list(count)
        };
        let range = |_| (d.below(2) == 0).then(|| d.bounds());
        let ranges = (0..count).map(range).collect_vec();
        let mut settings = InnerSettings {
            iterations: d.below(4),
            halvings: d.below(4),
            step: rule(d),
            ..InnerSettings::default()
        };
        if d.below(2) == 0 {
            settings = InnerSettings {
                first_relaxation: d.number(),
                tolerance: d.number(),
                factor_range: d.bounds(),
                ..settings
            };
        }
        run(&model, &base, &ranges, &settings)
            .map(|run| [vec![run.last.errors.sum()], run.gage_factors].concat())
    }),
    ("outer_loop::correlate", |d| {
        let settings = at_most(d.below(3));
        // Half of the models are right ones, so that calls come past the analysis.
        let found = if d.below(2) == 0 {
            let model = chain(d)?;
            let ranges = vec![None; d.about(model.shares().len())];
            let analyze = |_: &[f64]| Ok::<_, Error>(model.clone());
            correlate(analyze, &ranges, &settings, |_, _| true)?
        } else {
            let model = d.dynamic();
            let (test, ranges) = (
                d.modes(model.mass.nrows())?,
                vec![None; d.about(model.shares.len())],
            );
            let analyze = |_: &[f64]| model.analyze(&test, None);
            correlate(analyze, &ranges, &settings, |_, _| true)?
        };
        Ok([found.best_factors, vec![found.initial.errors.sum()]].concat())
    }),
    ("Correlation::best_check", |d| {
        let (model, settings) = (chain(d)?, at_most(d.below(3)));
        let ranges = vec![None; model.shares().len()];
        let analyze = |_: &[f64]| Ok::<_, Error>(model.clone());
        let found = correlate(analyze, &ranges, &settings, |_, _| true)?;
        let best = found.best_check();
        Ok([best.share_factors.clone(), vec![best.errors.sum()]].concat())
    }),
    ("Settings::for_modes", |d| {
        let found = Settings::default().for_modes([d.size(), usize::MAX][d.below(2)]);
        Ok(vec![
            found.inner.first_relaxation,
            found.inner.relaxation,
            found.inner.tolerance,
            found.later_inner_tolerance,
            found.error_sum_tolerance,
            found.frequency_tolerance,
            found.shape_tolerance,
        ])
    }),
    ("Settings::are_met_by", |d| {
        let settings = Settings {
            error_sum_tolerance: d.number(),
            ..Settings::default()
        };
        unseen(settings.are_met_by(&d.errors()))
    }),
    ("step::unlimited_factor", |d| {
        unseen(unlimited_factor(
            d.number(),
            d.number(),
            d.number(),
            d.number(),
        ))
    }),
    ("step::limited_factor", |d| {
        let range = d.bounds();
        unseen(limited_factor(
            d.number(),
            d.number(),
            d.number(),
            d.number(),
            range,
            Some(range),
        ))
    }),
    // The measure of numbers that are none is none; the analysis has refused them.
    ("StepRule::measure", |d| {
        let (rows, columns, rule) = (d.size(), d.size(), rule(d));
        unseen(rule.measure(&d.matrix(rows, columns), d.number(), d.number()))
    }),
    ("Errors::of", |d| {
        let each = (0..d.size())
            .map(|_| ModeError {
                frequency: d.number(),
                shape: d.number(),
            })
            .collect_vec();
        Errors::of(&each).map(|found| vec![found.frequency, found.shape])
    }),
    ("Errors::sum", |d| Ok(vec![d.errors().sum()])),
    ("Errors::frequency_rms", |d| {
        Ok(vec![d.errors().frequency_rms()])
    }),
    ("Errors::shape_rms", |d| Ok(vec![d.errors().shape_rms()])),
    ("error_sum::mode_errors", |d| {
        let (analysis, pairing, test) = d.compared()?;
        let found = mode_errors(&analysis, &pairing, &test)?;
        Ok(found
            .iter()
            .flat_map(|error| [error.frequency, error.shape])
            .collect())
    }),
    ("error_sum::errors", |d| {
        let (analysis, pairing, test) = d.compared()?;
        errors(&analysis, &pairing, &test).map(|found| vec![found.frequency, found.shape])
    }),
    ("Comparison::result", |d| {
        let found = Comparison::from(sensed(d)?).result()?;
        Ok([found.frequencies_hz, vec![found.errors.sum()]].concat())
    }),
    ("Comparison::with_lone_frequencies", |d| {
        let comparison = comparison(d)?;
        let lone = (0..d.size()).map(|_| LoneFrequency {
            frequency_hz: d.number(),
            partner: d.size(),
        });
        let lone = lone.collect();
        let found = comparison.with_lone_frequencies(lone)?.result()?;
        Ok(vec![found.errors.sum()])
    }),
    ("Comparison::with_groups", |d| {
        let comparison = comparison(d)?;
        let most = comparison.model().test().len() + 1;
        let group = |_| {
            (0..d.size() % 3)
                .map(|_| d.size().saturating_sub(1) % most)
                .collect()
        };
        let groups = (0..3).map(group).collect_vec();
        let found = comparison.with_groups(groups.clone())?;
        let (exact, test) = (found.model().exact(), found.model().test());
        let turned = turned(&exact.modes, &exact.pairing, &groups, test)?;
        let numbers = turned.shapes().iter().copied();
        Ok(numbers.chain([found.result()?.errors.sum()]).collect())
    }),
    ("Comparison::with_component_weights", |d| {
        let comparison = comparison(d)?;
        let (dof, modes) = comparison.model().test().shapes().shape();
        let own = DMatrix::from_fn(d.about(dof), d.about(modes), |_, _| d.number().abs());
        let comparison = comparison.with_component_weights(own)?;
        residuals(&comparison, &vec![ModeWeight::ONE; modes]).map(|found| found.data.into())
    }),
    ("step::next_share_factor", |d| {
        next_share_factor(d.number(), d.number(), d.number());
        Ok(Vec::new())
    }),
];
