//! Errors, states, steps and the loops.

use super::Entry;
use crate::common::draws::Draws;
use corfem::method::derivatives::{DerivativeRule, by_definition, error_changes, gradient};
use corfem::method::error::Error;
use corfem::method::error_sum::{ErrorMeasure, ModeWeight, errors, mode_errors};
use corfem::method::inner_loop::{InnerSettings, first_factors, run};
use corfem::method::model::{Bounds, LoneFrequency};
use corfem::method::outer_loop::{Settings, correlate};
use corfem::method::state::{ModalState, UpdateRule};
use corfem::method::step::{
    Accumulation, StepRule, limited_factor, stiffness_changes, unlimited_factors,
};
use corfem::weighted::close_modes::turned;
use corfem::weighted::residuals::residuals;
use nalgebra::DMatrix;

pub const LOOPS: &[Entry] = &[
    ("ModalState::at", |d| {
        let model = d.chain().ok_or(Error::Empty { what: "chains" })?;
        let count = d.about(model.shares().len());
        let rule = if d.below(2) == 0 {
            UpdateRule::Recursive1
        } else {
            UpdateRule::Eigensolution
        };
        ModalState::at(&model, d.list(count), rule).map(|state| vec![state.errors().sum()])
    }),
    ("inner_loop::first_factors", |d| {
        let model = d.chain().ok_or(Error::Empty { what: "chains" })?;
        let settings = InnerSettings {
            first_relaxation: d.number(),
            ..InnerSettings::default()
        };
        first_factors(&model, &settings)
    }),
    ("inner_loop::run", |d| {
        let model = d.chain().ok_or(Error::Empty { what: "chains" })?;
        let count = d.about(model.shares().len());
        let base = if d.below(2) == 0 {
            vec![1.0; count]
        } else {
            d.list(count)
        };
        let range = |d: &mut Draws| {
            (d.below(2) == 0).then(|| Bounds {
                lower: d.number(),
                upper: d.number(),
            })
        };
        let ranges: Vec<Option<Bounds>> = (0..count).map(|_| range(d)).collect();
        let mut settings = InnerSettings {
            iterations: d.below(4),
            halvings: d.below(4),
            ..InnerSettings::default()
        };
        if d.below(2) == 0 {
            settings = InnerSettings {
                first_relaxation: d.number(),
                tolerance: d.number(),
                ..settings
            };
            settings.factor_range = Bounds {
                lower: d.number(),
                upper: d.number(),
            };
        }
        run(&model, &base, &ranges, &settings)
            .map(|run| [vec![run.last.errors().sum()], run.factors].concat())
    }),
    ("outer_loop::correlate", |d| {
        let settings = Settings {
            most_passes: d.below(3),
            ..Settings::default()
        };
        // Half of the models are right ones, so that calls come past the analysis.
        let found = if d.below(2) == 0 {
            let model = d.chain().ok_or(Error::Empty { what: "chains" })?;
            let ranges = vec![None; d.about(model.shares().len())];
            correlate(
                |_: &[f64]| Ok::<_, Error>(model.clone()),
                &ranges,
                &settings,
                |_, _| {},
            )?
        } else {
            let model = d.dynamic();
            let (test, ranges) = (
                d.modes(model.mass.nrows())?,
                vec![None; d.about(model.shares.len())],
            );
            correlate(
                |_: &[f64]| model.analyze(&test, None),
                &ranges,
                &settings,
                |_, _| {},
            )?
        };
        Ok([found.best_factors, vec![found.verdict.error_sum]].concat())
    }),
    ("step::unlimited_factors", |d| {
        let count = d.size();
        let other = d.about(count);
        unlimited_factors(&d.list(count), &d.list(other), d.number(), d.number());
        Ok(Vec::new())
    }),
    ("step::limited_factor", |d| {
        let range = Bounds {
            lower: d.number(),
            upper: d.number(),
        };
        limited_factor(
            d.number(),
            d.number(),
            d.number(),
            d.number(),
            range,
            Some(range),
        );
        Ok(Vec::new())
    }),
    ("Errors::sum", |d| Ok(vec![d.errors().sum()])),
    ("Errors::frequency_rms", |d| {
        Ok(vec![d.errors().frequency_rms()])
    }),
    ("Errors::shape_rms", |d| Ok(vec![d.errors().shape_rms()])),
    ("ErrorMeasure::scale", |d| {
        Ok(vec![
            ErrorMeasure::NineModes.scale(d.size()),
            ErrorMeasure::Sum.scale(d.size()),
        ])
    }),
    ("error_sum::mode_errors", |d| {
        let (analysis, pairing, test) = d.compared()?;
        let found = mode_errors(&analysis, &pairing, &test)?;
        Ok(found
            .iter()
            .flat_map(|error| [error.frequency, error.shape.unwrap_or_default()])
            .collect())
    }),
    ("error_sum::errors", |d| {
        let (analysis, pairing, test) = d.compared()?;
        errors(&analysis, &pairing, &test).map(|found| vec![found.frequency, found.shape])
    }),
    ("ModalModel::with_lone_frequencies", |d| {
        let model = d.chain().ok_or(Error::Empty { what: "chains" })?;
        let lone = (0..d.size()).map(|_| LoneFrequency {
            frequency_hz: d.number(),
            partner: d.size(),
        });
        let lone = lone.collect();
        model
            .with_lone_frequencies(lone)
            .map(|model| vec![model.exact().errors.sum()])
    }),
    ("ModalModel::with_groups", |d| {
        let model = d.chain().ok_or(Error::Empty { what: "chains" })?;
        let most = model.test().len() + 1;
        let group = |_| {
            (0..d.size() % 3)
                .map(|_| d.size().saturating_sub(1) % most)
                .collect()
        };
        let groups = (0..3).map(group).collect();
        let model = model.with_groups(groups)?;
        let found = turned(&model.exact().modes, model.exact(), model.test())?;
        Ok(found.shapes().iter().copied().collect())
    }),
    ("ModalModel::with_component_weights", |d| {
        let model = d.chain().ok_or(Error::Empty { what: "chains" })?;
        let (dof, modes) = model.test().shapes().shape();
        let own = DMatrix::from_fn(d.about(dof), d.about(modes), |_, _| d.number().abs());
        let model = model.with_component_weights(own)?;
        let weights = vec![ModeWeight::ONE; model.test().len()];
        residuals(&model, &weights).map(|found| found.data.into())
    }),
    ("ModalModel::with_covariance", |d| {
        let model = d.chain().ok_or(Error::Empty { what: "chains" })?;
        let (dof, modes) = model.test().shapes().shape();
        let count = d.about((1 + dof) * modes);
        let (size, root) = (d.number(), DMatrix::identity(count, count));
        let covariance = root * size;
        let model = model.with_covariance(&covariance)?;
        let weights = vec![ModeWeight::ONE; model.test().len()];
        residuals(&model, &weights).map(|found| found.data.into())
    }),
    ("ModalModel::weighted", |d| {
        let model = d.chain().ok_or(Error::Empty { what: "chains" })?;
        let count = d.about(model.test().len());
        let weights: Vec<ModeWeight> = (0..count)
            .map(|_| ModeWeight {
                frequency: d.number().abs(),
                shape: d.number().abs(),
            })
            .collect();
        model
            .weighted(&weights)
            .map(|model| vec![model.exact().errors.sum()])
    }),
    ("ModalState::start", |d| {
        // It copies the model; what is done with it refuses one that is not whole.
        let model = d.chain().ok_or(Error::Empty { what: "chains" })?;
        ModalState::start(&model);
        Ok(Vec::new())
    }),
    ("derivatives::by_definition", |d| {
        let model = d.chain().ok_or(Error::Empty { what: "chains" })?;
        by_definition(&model, &d.state(&model))
    }),
    ("derivatives::gradient", |d| {
        let model = d.chain().ok_or(Error::Empty { what: "chains" })?;
        gradient(&model, &d.state(&model))
    }),
    ("derivatives::error_changes", |d| {
        let model = d.chain().ok_or(Error::Empty { what: "chains" })?;
        let rule = if d.below(2) == 0 {
            DerivativeRule::Definition
        } else {
            DerivativeRule::Gradient
        };
        error_changes(&model, &d.state(&model), rule)
    }),
    ("step::stiffness_changes", |d| {
        let model = d.chain().ok_or(Error::Empty { what: "chains" })?;
        let [shares, sizes] = [(); 2].map(|()| (0..d.size()).map(|_| d.unit()).collect::<Vec<_>>());
        let rules = [
            StepRule::Norm,
            StepRule::Diagonal,
            StepRule::Relative,
            StepRule::Gage,
        ];
        let rule = rules.get(d.below(4)).copied().unwrap_or(StepRule::Relative);
        Ok(stiffness_changes(&model, &shares, &sizes, rule))
    }),
    ("Accumulation::next_share_factor", |d| {
        for accumulation in [Accumulation::Sum, Accumulation::Product] {
            accumulation.next_share_factor(d.number(), d.number(), d.number());
        }
        Ok(Vec::new())
    }),
];
