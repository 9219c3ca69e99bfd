//! Inner and outer loop of a case in double-double, with the margin of every decision on the way.

use super::analysis::{Box, Errors, Model, Modes, Pairing, errors, pair};
use super::elements::number;
use super::noise::Noise;
use crate::common::double_double::Dd;
use crate::common::double_double_matrices::{Rows, product, rows, transposed_product};
use corfem::method::inner_loop::Stop;
use corfem::method::outer_loop::Settings;
use corfem::method::step::REFERENCE_GAGE;
use corfem::method::step::{LEAST_SHARE, StepRule};
use corfem::torque_box::Case;
use corfem::torque_box::wing_box::{PANEL_COUNT, TEST_GAGE};

/// Relative change of the roots at which Recursive 1 has converged: some hundred units in the last place.
const SETTLED: f64 = 1e-29;

/// Something that the chain decided, and the relative change of the numbers compared that would decide otherwise.
#[derive(Debug, Clone)]
pub struct Decision {
    pub what: String,
    pub margin: f64,
}

/// One pass: what happened in its inner loop, and the exact check.
pub struct Pass {
    pub error_sums: Vec<Dd>,
    pub halvings: Vec<usize>,
    pub stop: Stop,
    pub gages: Vec<Dd>,
    pub omega_squared: Vec<Dd>,
    pub errors: Errors,
}

pub struct History {
    pub passes: Vec<Pass>,
    pub decisions: Vec<Decision>,
}

/// Where an inner loop stands.
struct State {
    share_factors: Vec<Dd>,
    modes: Modes,
    generalized: Rows,
    pairing: Pairing,
    errors: Errors,
}

/// One run of the method.
pub struct Chain<'a> {
    pub settings: &'a Settings,
    pub test: Modes,
    pub noise: Noise,
    pub decisions: Vec<Decision>,
}

/// Runs a case with its lowest test and analysis modes.
pub fn run(
    case: &Case,
    settings: &Settings,
    (tests, analysis): (usize, usize),
    mut noise: Noise,
) -> History {
    let structure = Box::of(case);
    let test = structure
        .modes(&[number(TEST_GAGE); PANEL_COUNT], &mut noise)
        .lowest(tests);
    let mut chain = Chain {
        settings,
        test,
        noise,
        decisions: Vec::new(),
    };
    let first: Vec<Dd> = case.first_gages().into_iter().map(number).collect();
    let ranges = case.gage_range.map(|range| {
        let of = |&gage: &Dd| [number(range.lower) / gage, number(range.upper) / gage];
        first.iter().map(of).collect::<Vec<[Dd; 2]>>()
    });
    let mut base = vec![Dd::ONE; PANEL_COUNT];
    let mut model = structure.analyze(&first, &chain.test, analysis, &mut chain.noise);
    let mut passes = Vec::new();
    let start = errors(&model.modes, &pair(&model.cross), &chain.test);
    let mut converged = chain.meets(&start, "start");
    while passes.len() < settings.most_passes
        && (passes.len() < settings.least_passes || !converged)
    {
        let number_of_pass = passes.len() + 1;
        let mut pass = chain.inner_loop(&model, &base, ranges.as_deref(), number_of_pass);
        for (base, factor) in base.iter_mut().zip(&pass.gages) {
            *base = *base * *factor;
        }
        pass.gages = base
            .iter()
            .zip(&first)
            .map(|(&base, &gage)| base * gage)
            .collect();
        model = structure.analyze(&pass.gages, &chain.test, analysis, &mut chain.noise);
        let pairing = pair(&model.cross);
        pass.omega_squared = pairing
            .mode
            .iter()
            .map(|&i| model.modes.omega_squared[i])
            .collect();
        pass.errors = errors(&model.modes, &pairing, &chain.test);
        chain.decide(
            format!("pass {number_of_pass} check: pairing"),
            pairing.margin,
        );
        converged = chain.meets(
            &pass.errors,
            &format!("pass {number_of_pass} check: tolerances"),
        );
        passes.push(pass);
    }
    History {
        passes,
        decisions: chain.decisions,
    }
}

impl Chain<'_> {
    fn decide(&mut self, what: String, margin: f64) {
        self.decisions.push(Decision {
            what,
            margin: margin.abs(),
        });
    }

    /// Whether all three tolerances are met: decided by the one that is nearest to being missed.
    fn meets(&mut self, errors: &Errors, what: &str) -> bool {
        let Settings {
            error_sum_tolerance,
            frequency_tolerance,
            shape_tolerance,
            ..
        } = self.settings;
        let slack = [
            (errors.sum(), error_sum_tolerance),
            (errors.frequency, frequency_tolerance),
            (errors.shape, shape_tolerance),
        ]
        .map(|(error, &tolerance)| (Dd::ONE - error / number(tolerance)).to_f64());
        let least = slack.into_iter().fold(f64::INFINITY, f64::min);
        self.decide(what.to_owned(), least);
        least >= 0.0
    }

    /// One inner loop. The pass it returns has the factors since the last exact solution for gages, and no check yet.
    fn inner_loop(
        &mut self,
        model: &Model,
        base: &[Dd],
        ranges: Option<&[[Dd; 2]]>,
        pass: usize,
    ) -> Pass {
        let inner = &self.settings.inner;
        let tolerance = if pass == 1 {
            inner.tolerance
        } else {
            self.settings.later_inner_tolerance
        };
        let mut state = self.at(model, vec![Dd::ONE; PANEL_COUNT]);
        let mut factors = vec![Dd::ONE; PANEL_COUNT];
        let (mut error_sums, mut halvings) = (Vec::new(), Vec::new());
        let stop = loop {
            if error_sums.len() == inner.iterations {
                break Stop::Iterations;
            }
            let relaxation = if error_sums.is_empty() {
                inner.first_relaxation
            } else {
                inner.relaxation
            };
            let unlimited = self.unlimited_factors(model, &state, &factors, number(relaxation));
            let mut accepted = None;
            for halving in 0..=inner.halvings {
                let fraction = number(0.5_f64.powi(halving as i32));
                let [lower, upper] =
                    [inner.factor_range.lower, inner.factor_range.upper].map(number);
                let next: Vec<Dd> = (0..PANEL_COUNT)
                    .map(|e| {
                        let factor = unlimited[e].larger(lower).smaller(upper);
                        let next = factors[e] * (Dd::ONE + fraction * (factor - Dd::ONE));
                        ranges.map_or(next, |ranges| {
                            (base[e] * next).larger(ranges[e][0]).smaller(ranges[e][1]) / base[e]
                        })
                    })
                    .collect();
                let share = |e: usize| {
                    (state.share_factors[e] + next[e] / factors[e] - Dd::ONE)
                        .larger(number(LEAST_SHARE))
                };
                let trial = self.at(model, (0..PANEL_COUNT).map(share).collect());
                let change = (trial.errors.sum() / state.errors.sum() - Dd::ONE).to_f64();
                let of = format!(
                    "pass {pass}, iteration {}, halving {halving}",
                    error_sums.len() + 1
                );
                self.decide(format!("{of}: lower or not"), change);
                self.decide(format!("{of}: pairing"), trial.pairing.margin);
                if change < 0.0 {
                    accepted = Some((halving, next, trial));
                    break;
                }
            }
            let Some((halving, next, trial)) = accepted else {
                break Stop::LocalMinimum;
            };
            (factors, state) = (next, trial);
            error_sums.push(state.errors.sum());
            halvings.push(halving);
            let over = (state.errors.sum() / number(tolerance) - Dd::ONE).to_f64();
            self.decide(
                format!("pass {pass}, iteration {}: stop", error_sums.len()),
                over,
            );
            if over < 0.0 {
                break Stop::Tolerance;
            }
        };
        Pass {
            error_sums,
            halvings,
            stop,
            gages: factors,
            omega_squared: Vec::new(),
            errors: state.errors,
        }
    }

    /// Factors by (12) and (13), not limited.
    fn unlimited_factors(
        &mut self,
        model: &Model,
        state: &State,
        factors: &[Dd],
        relaxation: Dd,
    ) -> Vec<Dd> {
        let step = number(0.001);
        let (k, p) = (&state.modes.omega_squared, &state.generalized);
        let here = state.errors.sum();
        let factor = |e: usize, noise: &mut Noise| {
            let share = transposed_product(p, &product(&model.shares[e], p));
            let mut beta = rows(k.len(), k.len(), |i, j| {
                step * state.share_factors[e] * share[i][j]
            });
            for i in 0..k.len() {
                for j in 0..k.len() {
                    if i != j && (k[i] - k[j]).abs() < number(0.01) * k[i].larger(k[j]) {
                        beta[i][j] = Dd::ZERO;
                    }
                }
            }
            let (roots, shapes) = recursive_1(k, &beta, 1);
            let modes = Modes {
                omega_squared: roots.iter().map(|root| root.recip()).collect(),
                shapes: product(&state.modes.shapes, &shapes),
            };
            let change =
                errors(&modes, &state.pairing, &self.test).sum() - here + noise.next() * here;
            let share = &model.test_shares[e];
            let norm = |entries: &mut dyn Iterator<Item = Dd>| {
                entries.map(|entry| entry * entry).sum::<Dd>().sqrt()
            };
            let stiffness = match self.settings.inner.step {
                StepRule::Matrix => {
                    state.share_factors[e] * norm(&mut share.iter().flatten().copied())
                }
                StepRule::Own => {
                    state.share_factors[e] * norm(&mut (0..share.len()).map(|i| share[i][i]))
                }
                StepRule::Relative => Dd::ONE,
                StepRule::Gage => factors[e] * model.gages[e] / number(REFERENCE_GAGE),
            };
            Dd::ONE - relaxation * here * change / (step * stiffness)
        };
        (0..PANEL_COUNT)
            .map(|e| factor(e, &mut self.noise))
            .collect()
    }

    /// The state at factors on the shares, by Recursive 1 to convergence.
    fn at(&self, model: &Model, share_factors: Vec<Dd>) -> State {
        let k = &model.modes.omega_squared;
        let beta = rows(k.len(), k.len(), |i, j| {
            model
                .shares
                .iter()
                .zip(&share_factors)
                .map(|(share, &factor)| (factor - Dd::ONE) * share[i][j])
                .sum()
        });
        let (roots, mut generalized) = recursive_1(k, &beta, 60);
        for j in 0..k.len() {
            let norm = generalized
                .iter()
                .map(|row| row[j] * row[j])
                .sum::<Dd>()
                .sqrt();
            generalized
                .iter_mut()
                .for_each(|row| row[j] = row[j] / norm);
        }
        let pairing = pair(&transposed_product(&generalized, &model.cross));
        let modes = Modes {
            omega_squared: roots.iter().map(|root| root.recip()).collect(),
            shapes: product(&model.modes.shapes, &generalized),
        };
        let errors = errors(&modes, &pairing, &self.test);
        State {
            share_factors,
            modes,
            generalized,
            pairing,
            errors,
        }
    }
}

/// Recursive 1 (C.22) to a given order, or until the roots stay where they are.
fn recursive_1(k: &[Dd], beta: &Rows, orders: usize) -> (Vec<Dd>, Rows) {
    let size = k.len();
    let own: Vec<Dd> = (0..size).map(|i| k[i] + beta[i][i]).collect();
    let mut roots: Vec<Dd> = own.iter().map(|own| own.recip()).collect();
    let mut shapes = rows(size, size, |i, j| if i == j { Dd::ONE } else { Dd::ZERO });
    for order in 1..=orders {
        let sums = rows(size, size, |i, j| {
            let others = (0..size).filter(|&s| s != i);
            match order {
                // The shapes before are those of the modes themselves.
                1 if i == j => Dd::ZERO,
                1 => beta[i][j],
                _ => others.map(|s| beta[i][s] * shapes[s][j]).sum(),
            }
        });
        let before = roots.clone();
        if order > 1 {
            for j in 0..size {
                let lambda = k[j].recip();
                roots[j] = lambda - (beta[j][j] * lambda + before[j] * sums[j][j]) / own[j];
            }
        }
        shapes = rows(size, size, |i, j| {
            if i == j {
                Dd::ONE
            } else {
                -sums[i][j] / (own[i] - before[j].recip())
            }
        });
        let changes = roots
            .iter()
            .zip(&before)
            .map(|(&new, &old)| (new / old - Dd::ONE).abs().to_f64());
        if order > 1 && changes.fold(0.0, f64::max) < SETTLED {
            break;
        }
    }
    (roots, shapes)
}
