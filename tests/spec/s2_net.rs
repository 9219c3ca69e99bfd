//! The loops as jobs run them: `golden/loops.toml` has where they led before they were written anew, and they must lead there again.
//! `CORFEM_WRITE=loops cargo test s2_net` records the golden again. It does not take the `1` that rewrites documents, after which
//! small differences of many changes could add up.

use crate::prelude::*;
use corfem::chain::rods;
use serde::Serialize;

/// A part of the stiffness or the mass that is scaled by one factor, and the factor that the test's structure has.
#[derive(Debug, Clone)]
struct Part {
    is_mass: bool,
    matrix: DMatrix<f64>,
    range: Option<[f64; 2]>,
    truth: f64,
}

/// A structure given by its matrices.
#[derive(Debug, Clone)]
struct System {
    stiffness: DMatrix<f64>,
    mass: DMatrix<f64>,
    parts: Vec<Part>,
}

/// How sensors see a whole structure: at which rows.
#[derive(Debug, Clone)]
struct Sensing {
    rows: Vec<usize>,
    is_weighted: bool,
    is_greedy: bool,
}

/// How a structure is analyzed.
#[derive(Debug, Clone)]
enum Way {
    /// Whole, as sensors see it.
    AtSensors(System, Sensing),
    /// By its matrices, with so many modes.
    Matrices(System, usize),
    /// As rods condensed to five points, with so many modes.
    Rods { is_bounded: bool, modes: usize },
}

/// One run of the loops.
#[derive(Debug, Clone)]
struct Run {
    name: String,
    way: Way,
    test_modes: usize,
    inner: InnerSettings,
}

/// What a pass came to: the halvings of every iteration, factors on the first values, and the exact error sum.
#[derive(Debug, Default, Serialize, Deserialize)]
struct RecordedPass {
    stop: String,
    halvings: Vec<usize>,
    factors: Vec<f64>,
    error_sum: f64,
}

/// What a run came to: its passes with the best of them, from zero, or the kind of its error with the modes that it names.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(default)]
struct Recorded {
    name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    modes: Vec<usize>,
    converged: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    best: Option<usize>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pass: Vec<RecordedPass>,
}

/// The stored runs.
#[derive(Debug, Serialize, Deserialize)]
struct Golden {
    run: Vec<Recorded>,
}

impl Part {
    fn new(is_mass: bool, matrix: DMatrix<f64>, truth: f64) -> Self {
        Self {
            is_mass,
            matrix,
            range: None,
            truth,
        }
    }

    /// A part that resists, or moves in, one motion alone.
    fn of_motion(is_mass: bool, scale: f64, motion: &[f64], truth: f64) -> Self {
        let motion = DVector::from_column_slice(motion);
        Self::new(is_mass, scale * &motion * motion.transpose(), truth)
    }

    fn bounds(&self) -> Option<Bounds> {
        self.range.map(|[lower, upper]| Bounds { lower, upper })
    }
}

impl System {
    fn truth(&self) -> Vec<f64> {
        self.parts.iter().map(|part| part.truth).collect()
    }

    fn has_mass(&self) -> bool {
        self.parts.iter().any(|part| part.is_mass)
    }

    /// Stiffness, mass, and every part at these factors.
    fn at(&self, factors: &[f64]) -> DynamicModel {
        let (mut stiffness, mut mass) = (self.stiffness.clone(), self.mass.clone());
        let share = |(part, factor): (&Part, &f64)| {
            let matrix = match part.is_mass {
                true => &mut mass,
                false => &mut stiffness,
            };
            *matrix += (factor - 1.0) * &part.matrix;
            *factor * &part.matrix
        };
        let shares = self.parts.iter().zip(factors).map(share).collect();
        DynamicModel {
            stiffness,
            mass,
            shares,
        }
    }

    fn whole(&self) -> Result<WholeModel, Error> {
        let parameter = |part: &Part| {
            let share = match part.is_mass {
                true => WholeShare::Mass,
                false => WholeShare::Stiffness,
            };
            Ok(WholeParameter {
                name: "part".to_owned(),
                share: share(sparse(&part.matrix)?),
                range: part.bounds(),
            })
        };
        let parameters: Result<_, Error> = self.parts.iter().map(parameter).collect();
        WholeModel::new(sparse(&self.stiffness)?, sparse(&self.mass)?, parameters?)
    }
}

/// A caller's own analysis of matrices: the paper's, with masses among the parts, of which the paper has none.
struct WithMasses {
    exact: State,
    test: Modes,
    cross: DMatrix<f64>,
    /// Parts through the exact modes.
    shares: Vec<ParameterMatrix>,
    /// Parts through the test modes, relative to the test's own stiffness and mass.
    test_shares: Vec<DMatrix<f64>>,
}

impl WithMasses {
    fn new(system: &System, factors: &[f64], test: &Modes, modes: usize) -> Result<Self, Error> {
        let DynamicModel {
            stiffness,
            mass,
            shares,
        } = system.at(factors);
        let modes = solve(&stiffness, &mass, modes)?;
        let test = test.scaled_with(&mass)?;
        let through = |part: &Part, share: &DMatrix<f64>, shapes: &DMatrix<f64>| {
            let share = symmetric_part(&shapes.tr_mul(&(share * shapes)));
            match part.is_mass {
                true => ParameterMatrix::Mass(share),
                false => ParameterMatrix::Stiffness(share),
            }
        };
        let omega = test.omega_squared().map(f64::sqrt);
        let relative = |share| match share {
            ParameterMatrix::Stiffness(share) => share.component_div(&(&omega * omega.transpose())),
            ParameterMatrix::Mass(share) => share,
        };
        let all = || system.parts.iter().zip(&shares);
        let through_modes = all().map(|(part, share)| through(part, share, modes.shapes()));
        let through_test = all().map(|(part, share)| through(part, share, test.shapes()));
        let cross = cross_orthogonality(&modes, &test, &mass)?;
        let pairing = pair_modes(&cross)?;
        Ok(Self {
            shares: through_modes.collect(),
            test_shares: through_test.map(relative).collect(),
            exact: State {
                share_factors: vec![1.0; shares.len()],
                generalized_shapes: eye(modes.len()),
                errors: errors(&modes, &pairing, &test)?,
                modes,
                pairing,
            },
            cross,
            test,
        })
    }
}

impl Analysis for WithMasses {
    fn exact(&self) -> &State {
        &self.exact
    }

    fn at(&self, factors: &[f64]) -> Result<State, Error> {
        let modes = &self.exact.modes;
        let mut beta = zero_square(modes.len());
        let mut alpha = beta.clone();
        for (share, factor) in self.shares.iter().zip(factors) {
            let change = match share {
                ParameterMatrix::Stiffness(_) => &mut beta,
                ParameterMatrix::Mass(_) => &mut alpha,
            };
            *change += (factor - 1.0) * share.matrix();
        }
        let pencil = Pencil::of_vibrations(modes.omega_squared(), &beta, &alpha)?;
        let Perturbed { roots, mut shapes } = pencil.recursive_1_converged()?.perturbed;
        if let Some(mode) = roots.iter().position(|root| *root <= 0.0) {
            let value = roots[mode];
            return Err(Error::NotAVibration { mode, value });
        }
        normalize_with_mass(&mut shapes, &alpha)?;
        let modes = Modes::new(roots.map(f64::recip), modes.shapes() * &shapes)?;
        let pairing = pair_modes(&shapes.tr_mul(&self.cross))?;
        Ok(State {
            share_factors: factors.to_vec(),
            errors: errors(&modes, &pairing, &self.test)?,
            generalized_shapes: shapes,
            modes,
            pairing,
        })
    }

    fn error_changes(&self, state: &State) -> Result<Vec<f64>, Error> {
        let (k, p) = (state.modes.omega_squared(), &state.generalized_shapes);
        let change = |(share, factor): (&ParameterMatrix, &f64)| {
            let change = DERIVATIVE_STEP * *factor * p.tr_mul(&(share.matrix() * p));
            let own = without_close_couplings(k.as_slice(), &change);
            let Perturbed { roots, shapes } = match share {
                ParameterMatrix::Stiffness(_) => first_order(k, &own)?,
                ParameterMatrix::Mass(_) => {
                    Pencil::of_vibrations(k, &(0.0 * &own), &own)?.first_order()?
                }
            };
            let modes = Modes::new(roots.map(f64::recip), state.modes.shapes() * shapes)?;
            let errors = errors(&modes, &state.pairing, &self.test)?;
            Ok(errors.sum() - state.errors.sum())
        };
        self.shares
            .iter()
            .zip(&state.share_factors)
            .map(change)
            .collect()
    }

    fn stiffness_changes(&self, state: &State, gage_factors: &[f64], rule: StepRule) -> Vec<f64> {
        let both = state.share_factors.iter().zip(gage_factors);
        let change = |(share, (factor, gage_factor)): (_, (&f64, &f64))| {
            DERIVATIVE_STEP * rule.measure(share, *factor, REFERENCE_GAGE * gage_factor)
        };
        self.test_shares.iter().zip(both).map(change).collect()
    }
}

impl Run {
    fn new(name: String, way: Way, test_modes: usize) -> Self {
        let inner = InnerSettings {
            tolerance: 0.002,
            ..InnerSettings::default()
        };
        Self {
            name,
            way,
            test_modes,
            inner,
        }
    }

    /// The same run by another name, with steps of so many halvings, first relaxation, and bounds of one factor.
    fn stepping(
        mut self,
        name: &str,
        halvings: usize,
        first_relaxation: f64,
        [lower, upper]: [f64; 2],
    ) -> Self {
        self.name = name.to_owned();
        self.inner = InnerSettings {
            halvings,
            first_relaxation,
            factor_range: Bounds { lower, upper },
            ..self.inner
        };
        self
    }

    /// The paper's settings with tolerances so tight that there are several passes of several iterations.
    fn settings(&self) -> Settings {
        let of_nine = Settings {
            inner: self.inner.clone(),
            later_inner_tolerance: 0.001,
            error_sum_tolerance: 0.002,
            most_passes: 4,
            ..Settings::default()
        };
        of_nine.for_modes(self.test_modes)
    }

    fn correlation(&self) -> Result<Correlation, Error> {
        match &self.way {
            Way::AtSensors(system, sensing) => self.at_sensors(system, sensing),
            Way::Matrices(system, modes) => self.of_matrices(system, *modes),
            Way::Rods { is_bounded, modes } => self.of_rods(*is_bounded, *modes),
        }
    }

    fn at_sensors(&self, system: &System, sensing: &Sensing) -> Result<Correlation, Error> {
        let (model, pair): (_, Pair) = match sensing.is_greedy {
            true => (system.whole()?, by_sorting()),
            false => (system.whole()?, Pair::by(|of| pair_all(of.cross))),
        };
        let sensors = sensors_at(&sensing.rows, model.dof_count());
        let found = model.modes(&system.truth(), self.test_modes)?;
        let test = seen_by(&sensors, &found.vibrations);
        let weights = (0..self.test_modes).map(weight).collect_vec();
        let analyze = |factors: &[f64]| {
            let modes = self.test_modes + 2;
            let model = model.analyze(factors, &sensors, &test, pair.clone(), modes)?;
            match sensing.is_weighted {
                true => model.weighted(&weights),
                false => Ok(model),
            }
        };
        correlate(analyze, &model.ranges(), &self.settings(), |_, _| true)
    }

    fn of_matrices(&self, system: &System, modes: usize) -> Result<Correlation, Error> {
        let there = system.at(&system.truth());
        let test = solve(&there.stiffness, &there.mass, self.test_modes)?;
        let ranges = system.parts.iter().map(Part::bounds).collect_vec();
        let (settings, all) = (self.settings(), |_: usize, _: &Pass| true);
        if system.has_mass() {
            let analyze = |factors: &[f64]| WithMasses::new(system, factors, &test, modes);
            return correlate(analyze, &ranges, &settings, all);
        }
        let analyze = |factors: &[f64]| system.at(factors).analyze(&test, Some(modes));
        correlate(analyze, &ranges, &settings, all)
    }

    /// Rods whose areas are near the gage that one rule of the step measures by, so that its steps are as long as the others'.
    fn of_rods(&self, is_bounded: bool, modes: usize) -> Result<Correlation, Error> {
        let bounds = Bounds::positive("areas", 0.0085, 0.018)?;
        let areas = [12.0, 10.0, 11.0, 13.0, 10.0, 12.5, 14.0, 10.5].map(|area| 1e-3 * area);
        let distribution = sensors_at(&[0, 2, 3, 5, 7], 8).dense().transpose();
        let masses = DMatrix::from_diagonal(&(1e-4 * dvector![1.0, 1.2, 0.9, 1.1, 0.7]));
        let parameters = [&[1][..], &[3, 4], &[5], &[7, 8]].map(|labels| {
            let first = labels.iter().map(|label| areas[label - 1]);
            let (lower, upper) = (
                bounds.lower / first.clone().fold(f64::MAX, f64::min),
                bounds.upper / first.largest(),
            );
            Parameter {
                factor_range: is_bounded.then_some(Bounds { lower, upper }),
                ..Parameter::new("rods", labels)
            }
        });
        let structure = rods(&areas, [true, false])?;
        let model = FiniteElementModel::new(structure, distribution, masses, parameters.to_vec())?;
        let test = model.modes(&[0.75, 1.3, 0.8, 1.2])?;
        let test = test.lowest(self.test_modes)?;
        let analyze = |factors: &[f64]| model.analyze(factors, &test, Some(modes));
        let ranges = model.factor_ranges()?;
        correlate(analyze, &ranges, &self.settings(), |_, _| true)
    }

    fn record(&self) -> Recorded {
        let name = self.name.clone();
        match self.correlation() {
            Ok(found) => Recorded {
                name,
                converged: found.converged,
                best: found.best,
                pass: found.passes.iter().map(RecordedPass::of).collect(),
                ..Recorded::default()
            },
            Err(error) => Recorded {
                name,
                error: format!("{error:?}")
                    .split([' ', '('])
                    .next()
                    .map(str::to_owned),
                modes: match error {
                    Error::CoalescingModes { first, second, .. } => vec![first, second],
                    _ => Vec::new(),
                },
                ..Recorded::default()
            },
        }
    }
}

impl RecordedPass {
    fn of(pass: &Pass) -> Self {
        let iterations = pass.inner.iterations.iter();
        Self {
            stop: format!("{:?}", pass.inner.stop),
            halvings: iterations.map(|iteration| iteration.halvings).collect(),
            factors: pass.factors.clone(),
            error_sum: pass.check.errors.sum(),
        }
    }

    fn is_same(&self, other: &Self) -> bool {
        let near = |(one, other): (&f64, &f64)| relative_error(one, other) <= SAME_LOOPS;
        self.stop == other.stop
            && self.halvings == other.halvings
            && self.factors.len() == other.factors.len()
            && self.factors.iter().zip(&other.factors).all(near)
            // It is a relative difference of frequencies and shapes itself.
            && (self.error_sum - other.error_sum).abs() <= SAME_LOOPS
    }
}

impl Recorded {
    fn is_same(&self, other: &Self) -> bool {
        let end = |run: &Self| {
            (
                run.error.clone(),
                run.modes.clone(),
                run.converged,
                run.best,
            )
        };
        end(self) == end(other)
            && self.pass.len() == other.pass.len()
            && self
                .pass
                .iter()
                .zip(&other.pass)
                .all(|(one, other)| one.is_same(other))
    }
}

/// Weights that differ, one of them zero.
fn weight(mode: usize) -> ModeWeight {
    ModeWeight {
        frequency: 1.0 + 0.2 * mode as f64,
        shape: if mode == 2 { 0.0 } else { 0.5 },
    }
}

/// The pairing of all modes at once, as a job's.
fn pair_all(cross: &DMatrix<f64>) -> Result<Pairing, Error> {
    let partners = pair_optimally(&cross.component_mul(cross))?;
    let modes = partners.into_iter().flatten().collect_vec();
    let signs = modes.iter().enumerate();
    let signs = signs.map(|(test, &mode)| 1.0_f64.copysign(cross[(mode, test)]));
    Ok(Pairing {
        sign: signs.collect(),
        analysis_mode: modes.clone(),
    })
}

/// Twelve masses in a row on springs that differ; three springs are parameters, and two masses if so asked.
fn chain(is_held: bool, with_mass: bool) -> System {
    let count = 12;
    let spring = |s: usize| {
        let stiffness = 100.0 * (1.0 + 0.3 * ((s * 7 % 5) as f64));
        spring_stiffness(count, s + 1, stiffness)
    };
    let ground = spring_stiffness(count, 0, if is_held { 150.0 } else { 0.0 });
    let parts = [(1, 0.7), (4, 1.4), (8, 0.8)].map(|(s, truth)| Part {
        range: Some([0.4, 2.5]),
        ..Part::new(false, spring(s), truth)
    });
    let mut parts = parts.to_vec();
    let masses = DVector::from_fn(count, |i, _| 1.0 + 0.1 * ((i * 3 % 4) as f64));
    for (i, truth) in [(3, 1.3), (9, 0.8)].into_iter().filter(|_| with_mass) {
        let mut matrix = zero_square(count);
        matrix[(i, i)] = masses[i];
        parts.push(Part::new(true, matrix, truth));
    }
    System {
        stiffness: (0..count - 1).map(spring).sum::<DMatrix<f64>>() + ground,
        mass: DMatrix::from_diagonal(&masses),
        parts,
    }
}

/// A chain as sensors at these rows see it; one bit a choice.
fn chain_at(rows: &[usize], bits: usize) -> Run {
    let [is_held, with_mass, is_weighted, is_greedy] = [8, 4, 2, 1].map(|bit| bits & bit > 0);
    let sensing = Sensing {
        rows: rows.to_vec(),
        is_weighted,
        is_greedy,
    };
    let name = format!("chain, held {is_held}, masses {with_mass}, {sensing:?}");
    let way = Way::AtSensors(chain(is_held, with_mass), sensing);
    Run::new(name, way, 5)
}

fn chains() -> Vec<Run> {
    let mut runs = (0..16)
        .map(|bits| chain_at(&[0, 2, 4, 5, 7, 9, 11], bits))
        .collect_vec();
    // So few sensors that the two pairings differ.
    for (rows, bits) in [
        ([0, 5, 11], 0b1000),
        ([2, 3, 8], 0b1100),
        ([2, 3, 8], 0b0100),
    ] {
        runs.extend([bits, bits + 1].map(|bits| chain_at(&rows, bits)));
    }
    runs
}

/// The name of a rule of the step when the golden was recorded.
fn recorded(step: StepRule) -> &'static str {
    match step {
        StepRule::Matrix => "Norm",
        StepRule::Own => "Diagonal",
        StepRule::Relative => "Relative",
        StepRule::Gage => "Gage",
    }
}

fn condensed_rods() -> Vec<Run> {
    let mut runs = Vec::new();
    for step in StepRule::ALL {
        for (is_bounded, modes) in [(false, 5), (true, 5), (false, 4)] {
            let way = Way::Rods { is_bounded, modes };
            let mut run = Run::new(format!("{way:?}, step {}", recorded(step)), way, 4);
            run.inner.step = step;
            runs.push(run);
        }
    }
    runs
}

/// Unit masses on springs of their own, with parts that couple them.
fn oscillators(springs: &[f64], parts: Vec<Part>) -> Run {
    let count = springs.len();
    let system = System {
        stiffness: DMatrix::from_diagonal(&DVector::from_column_slice(springs)),
        mass: eye(count),
        parts,
    };
    Run::new(String::new(), Way::Matrices(system, count), count)
}

/// Runs that come to what guards the perturbation, found among random systems.
fn guarded() -> Vec<Run> {
    let stiffness = |springs: &[f64], motion: &[f64], truth| {
        oscillators(springs, vec![Part::of_motion(false, 1.0, motion, truth)])
    };
    let given = |matrix, truth| vec![Part::new(false, matrix, truth)];
    let mass = |motion: &[f64], truth| vec![Part::of_motion(true, 0.5, motion, truth)];
    // Half of the part takes the first spring to the second.
    let meeting = given(dmatrix![200.0, 20.0; 20.0, 0.0], 3.0);
    let meeting = oscillators(&[100.0, 200.0], meeting);
    let coupled = stiffness(&[100.0, 101.0], &[1.0, 1.0], 21.0);
    let merging = stiffness(&[100.0, 161.0, 323.0], &[2.0, 13.0, -11.0], 0.6);
    let far = stiffness(&[100.0, 251.0, 553.0], &[7.0, -2.0, 7.0], 4.5);
    let beside = given(dmatrix![40.0, -33.0; -33.0, 48.0], 1.9);
    let moved = oscillators(&[100.0, 121.0], [mass(&[1.0, 1.0], 1.7), beside].concat());
    let up = stiffness(&[100.0, 171.0, 360.0], &[9.0, -9.0, -11.0], 4.5);
    let down = [3.0, 12.0, 0.0, 12.0];
    let down = stiffness(&[100.0, 181.0, 363.0, 582.0], &down, 0.3);
    let heavy = mass(&[0.9, 1.1, 0.4, 2.4], 1.7);
    let heavy = oscillators(&[100.0, 191.0, 421.0, 927.0], heavy);
    let second = stiffness(&[100.0, 111.0], &[2.0, 1.0], 3.5);
    let fourth = stiffness(&[100.0, 201.0], &[7.0, 7.0], 3.7);
    let masses = [mass(&[0.9, 0.5], 1.6), mass(&[0.2, -0.8], 0.5)].concat();
    let masses = oscillators(&[100.0, 240.0], masses);
    vec![
        meeting.stepping("modes meet", 0, 1e3, [0.5, 1.5]),
        coupled.stepping("roots do not settle", 0, 1e3, [0.05, 8.0]),
        merging.stepping("two modes led to one", 0, 0.8, [0.2, 7.0]),
        far.stepping("the same by a long step", 0, 1e3, [0.2, 6.1]),
        moved.stepping("the same with a mass", 0, 1e3, [0.2, 5.0]),
        up.stepping("the same, halved", 5, 1e3, [0.2, 3.0]),
        down.stepping("the same, halved down", 5, 1e3, [0.2, 5.3]),
        heavy.stepping("the same of a mass, halved", 5, 1e3, [0.2, 1.6]),
        second.stepping("close in the second pass", 0, 0.8, [0.2, 1.8]),
        fourth.stepping("close in the fourth pass", 0, 1e3, [0.2, 1.7]),
        // The roots move in every second order.
        masses.stepping("two masses alone", 5, 0.8, [0.55, 1.5]),
    ]
}

#[test]
fn the_loops_lead_where_they_led() {
    let runs = [chains(), condensed_rods(), guarded()].concat();
    let found = runs.iter().map(Run::record).collect_vec();
    let path = in_root("golden/loops.toml");
    if std::env::var("CORFEM_WRITE").is_ok_and(|value| value == "loops") {
        let golden = toml::to_string(&Golden { run: found }).unwrap();
        return fs::write(path, golden).unwrap();
    }
    let text = fs::read_to_string(path).unwrap();
    let Golden { run: stored } = toml::from_str(&text).unwrap();
    let names = |runs: &[Recorded]| runs.iter().map(|run| run.name.clone()).collect_vec();
    assert_eq!(names(&found), names(&stored));
    let pairs = found.iter().zip(&stored);
    let wrong = pairs
        .filter(|(found, stored)| !found.is_same(stored))
        .collect_vec();
    assert!(
        wrong.is_empty(),
        "{} runs, each as found and as stored: {wrong:#?}",
        wrong.len()
    );
}
