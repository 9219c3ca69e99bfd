//! The loops as jobs run them: `golden/snapshots/loops.snap` has where they led before they were written anew, and they must lead there
//! again.

use crate::prelude::*;
use crate::spec::s5_weighted::at;

/// One run of the loops.
struct Run {
    name: String,
    model: WholeModel,
    /// Factors that the test's structure has.
    truth: Vec<f64>,
    sensors: SparseMatrix,
    test_modes: usize,
    residual_vectors: usize,
    is_weighted: bool,
    is_greedy: bool,
    /// The same by dense matrices, which the method analyzes itself.
    dense: Option<DynamicModel>,
    inner: InnerSettings,
}

impl Run {
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

    /// By the paper's settings with tolerances so tight that there are several passes of several iterations.
    fn correlation(&self) -> Result<Correlation, Error> {
        let of_nine = Settings {
            inner: self.inner.clone(),
            later_inner_tolerance: 0.001,
            error_sum_tolerance: 0.002,
            most_passes: 4,
            ..Settings::default()
        };
        let settings = of_nine.for_modes(self.test_modes);
        if let Some(first) = &self.dense {
            let there = at(first, &self.truth);
            let test = solve(&there.stiffness, &there.mass, self.test_modes)?;
            let analyze = |factors: &[f64]| at(first, factors).analyze(&test, None);
            return correlate(analyze, &self.model.ranges(), &settings, |_, _| true);
        }
        let pair = match self.is_greedy {
            true => by_sorting(),
            false => Pair::by(|of| pair_all(of.cross)),
        };
        let found = self.model.modes(&self.truth, self.test_modes)?;
        let test = seen_by(&self.sensors, &found.vibrations);
        let weights = (0..self.test_modes).map(weight).collect_vec();
        let analyze = |factors: &[f64]| {
            let size = BasisSize {
                modes: (self.test_modes + 2).min(self.model.dof_count()),
                residual_vectors: self.residual_vectors,
            };
            let model = self
                .model
                .analyze(factors, &self.sensors, &test, pair.clone(), size)?;
            match self.is_weighted {
                true => model.weighted(&weights),
                false => Ok(model),
            }
        };
        correlate(analyze, &self.model.ranges(), &settings, |_, _| true)
    }

    /// What it comes to: its passes with the best of them, from zero, the halvings of every iteration, factors on the first values, and
    /// one more than the exact error sum; or the kind of its error with the modes that it names.
    fn record(&self) -> String {
        let end = match self.correlation() {
            Ok(found) => {
                let pass = |pass: &Pass| {
                    let steps = pass.inner.iterations.iter();
                    let halvings = steps.map(|step| step.halvings).collect_vec();
                    let (stop, sum) = (pass.inner.stop, 1.0 + pass.check.errors.sum());
                    format!("  {stop:?} {halvings:?} {:?} {sum:?}\n", pass.factors)
                };
                let passes: String = found.passes.iter().map(pass).collect();
                format!(
                    "  converged {}, best {:?}\n{passes}",
                    found.converged, found.best
                )
            }
            Err(Error::CoalescingModes { first, second, .. }) => {
                format!("  CoalescingModes {first} {second}\n")
            }
            Err(error) => format!(
                "  {}\n",
                format!("{error:?}").split([' ', '(']).next().unwrap()
            ),
        };
        format!("{}\n{end}", self.name)
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
    let partners = pair_optimally(&cross.component_mul(cross), 0.0)?;
    let modes = partners.into_iter().flatten().collect_vec();
    let signs = modes.iter().enumerate();
    let signs = signs.map(|(test, &mode)| 1.0_f64.copysign(cross[(mode, test)]));
    Ok(Pairing {
        sign: signs.collect(),
        analysis_mode: modes.clone(),
    })
}

fn inner() -> InnerSettings {
    InnerSettings {
        tolerance: 0.002,
        ..InnerSettings::default()
    }
}

/// Twelve masses in a row on springs that differ; three springs are parameters, and two masses if so asked.
fn chain(is_held: bool, with_mass: bool) -> (WholeModel, Vec<f64>) {
    let spring = |s: usize| (s + 1, Some(s), 100.0 * (1.0 + 0.3 * ((s * 7 % 5) as f64)));
    let mass = |i: usize| 1.0 + 0.1 * ((i * 3 % 4) as f64);
    let part = |share, range| WholeParameter {
        name: "part".to_owned(),
        share,
        range,
    };
    let (lower, upper) = (0.4, 2.5);
    let stiff = |s| {
        part(
            WholeShare::Stiffness(springs(12, &[spring(s)])),
            Some(Bounds { lower, upper }),
        )
    };
    let heavy = |i: usize| SparseMatrix::new("mass", 12, 12, vec![(i, i, mass(i))]).unwrap();
    let mut parts = [1, 4, 8].map(stiff).to_vec();
    if with_mass {
        parts.extend([3, 9].map(|i| part(WholeShare::Mass(heavy(i)), None)));
    }
    let ground = is_held.then_some((0, None, 150.0));
    let all = (0..11).map(spring).chain(ground).collect_vec();
    let truth = [0.7, 1.4, 0.8, 1.3, 0.8][..parts.len()].to_vec();
    let all_masses = masses(&(0..12).map(mass).collect_vec());
    (
        WholeModel::new(springs(12, &all), all_masses, parts).unwrap(),
        truth,
    )
}

/// A chain as sensors at these rows see it; one bit a choice.
fn chain_at(rows: &[usize], bits: usize) -> Run {
    let [is_held, with_mass, with_further, is_weighted, is_greedy] =
        [16, 8, 4, 2, 1].map(|bit| bits & bit > 0);
    let (model, truth) = chain(is_held, with_mass);
    let residual_vectors = if with_further { 2 } else { 0 };
    Run {
        name: format!(
            "chain, held {is_held}, masses {with_mass}, Sensing {{ rows: {rows:?}, further: {residual_vectors}, \
             is_weighted: {is_weighted}, is_greedy: {is_greedy} }}"
        ),
        model,
        truth,
        sensors: sensors_at(rows, 12),
        test_modes: 5,
        residual_vectors,
        is_weighted,
        is_greedy,
        dense: None,
        inner: inner(),
    }
}

fn chains() -> impl Iterator<Item = Run> {
    let all = (0..32).map(|bits| chain_at(&[0, 2, 4, 5, 7, 9, 11], bits));
    // So few sensors that the two pairings differ.
    let few = [
        ([0, 5, 11], 0b10100),
        ([2, 3, 8], 0b11100),
        ([2, 3, 8], 0b01100),
    ];
    let few = few.into_iter();
    all.chain(few.flat_map(|(rows, bits)| [bits, bits + 1].map(|bits| chain_at(&rows, bits))))
}

/// Unit masses on springs of their own, with parts that couple them.
fn oscillators(springs: &[f64], parts: Vec<(ParameterMatrix, f64)>) -> Run {
    let count = springs.len();
    let (parts, truth): (Vec<_>, _) = parts.into_iter().unzip();
    let stiffness = diagonal(springs);
    let (model, sensors) = of_dense(&stiffness, &eye(count), &parts).unwrap();
    let has_mass = parts
        .iter()
        .any(|part| matches!(part, ParameterMatrix::Mass(_)));
    let dense = DynamicModel {
        stiffness,
        mass: eye(count),
        shares: parts.iter().map(|part| part.matrix().clone()).collect(),
    };
    Run {
        name: String::new(),
        model,
        truth,
        sensors,
        test_modes: count,
        residual_vectors: 0,
        is_weighted: false,
        is_greedy: true,
        dense: (!has_mass).then_some(dense),
        inner: inner(),
    }
}

/// Runs that come to what guards the perturbation, found among random systems.
fn guarded() -> Vec<Run> {
    // Parts that resist, or move in, one motion alone.
    let square = |motion: &[f64]| {
        let motion = DVector::from_column_slice(motion);
        &motion * motion.transpose()
    };
    let given = |matrix, truth| vec![(ParameterMatrix::Stiffness(matrix), truth)];
    let stiffness =
        |springs: &[f64], motion: &[f64], truth| oscillators(springs, given(square(motion), truth));
    let mass = |motion: &[f64], truth| vec![(ParameterMatrix::Mass(0.5 * square(motion)), truth)];
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
    let text: String = chains().chain(guarded()).map(|run| run.record()).collect();
    let numbers = Numbers {
        relative: SAME_LOOPS,
        ..Numbers::AS_WRITTEN
    };
    assert_golden("loops", &text, numbers);
}
