//! What is timed: a correlation's stages one by one, each through the library's own functions.

use crate::fill::{self, Fill};
use crate::known::delta_wing::correlation;
use crate::known::eigensolved::Eigensolved;
use crate::known::wing::Wing;
use crate::known::{Known, planted};
use crate::machine::Machine;
use crate::memory::peak;
use corfem::method::analysis::Analysis;
use corfem::method::appendix_a::{ElementMatrix, element_matrices};
use corfem::method::inner_loop::{InnerSettings, run};
use corfem::method::model::Model;
use corfem::method::modes::solve;
use corfem::method::outer_loop::{Settings, correlate};
use corfem::method::structure::Material;
use corfem::sparse::elements::lumped_masses;
use corfem::sparse::factorization::{Factor, StructuralStiffness};
use corfem::sparse::{SparseMatrix, WholeModel};
use nalgebra::DMatrix;
use std::hint::black_box;
use std::time::{Duration, Instant};

/// Modes of the analysis and of the test.
pub const MODES: usize = 10;
/// Modes of the whole model, and its density, lbf·s²/in⁴: aluminum, where the wing of the other stages has point masses alone.
const WHOLE_MODES: usize = 20;
const DENSITY: f64 = 2.6e-4;
/// Stages that are named more than once.
const CONDENSED: &str = "condensed model: these two and $K_D$";
const ANALYSIS: &str = "analysis with all shares";
/// The exact error sum to which a whole correlation goes.
const ERROR: f64 = 0.05;
/// A stage is repeated until it has taken so long together, but not more often than this; and done twice at least, for the first time
/// pays for memory that was never touched, unless that alone takes too long.
const LONG_ENOUGH: Duration = Duration::from_millis(400);
const MOST_REPEATS: usize = 50;
const TOO_LONG: Duration = Duration::from_secs(30);

/// One stage: its name, its least time and the most memory held meanwhile.
pub struct Stage {
    pub name: &'static str,
    pub seconds: f64,
    pub bytes: usize,
}

/// All stages of one wing.
pub struct Stages {
    pub dof: usize,
    /// What the factor of the stiffness takes.
    pub fill: Fill,
    /// What the machine does at most in one thread.
    pub machine: Machine,
    pub all: Vec<Stage>,
}

impl Stages {
    /// Does a piece of work again and again and keeps the least time.
    fn time<T>(&mut self, name: &'static str, mut work: impl FnMut() -> T) -> T {
        let (mut least, mut total, mut repeats) = (Duration::MAX, Duration::ZERO, 0);
        let mut bytes = 0;
        loop {
            let start = Instant::now();
            let (done, held) = peak(&mut work);
            let took = start.elapsed();
            (least, total, repeats, bytes) =
                (least.min(took), total + took, repeats + 1, bytes.max(held));
            if repeats == MOST_REPEATS || total >= TOO_LONG || (total >= LONG_ENOUGH && repeats > 1)
            {
                self.all.push(Stage {
                    name,
                    seconds: least.as_secs_f64(),
                    bytes,
                });
                return black_box(done);
            }
        }
    }

    /// Seconds of a stage.
    pub fn seconds(&self, name: &str) -> f64 {
        self.all
            .iter()
            .find(|stage| stage.name == name)
            .map_or(f64::NAN, |stage| stage.seconds)
    }
}

/// Settings of a whole correlation.
fn settings() -> Settings {
    let usual = correlation::settings();
    let inner = InnerSettings {
        tolerance: ERROR,
        ..usual.inner
    };
    Settings {
        inner,
        later_inner_tolerance: 0.5 * ERROR,
        error_sum_tolerance: ERROR,
        frequency_tolerance: ERROR,
        shape_tolerance: ERROR,
        ..usual
    }
}

/// Times every stage of a wing, and hands it back with what an analysis found.
pub fn of(wing: &Wing) -> (Stages, Known, Model) {
    let machine = Machine::measured();
    let mut stages = Stages {
        dof: 0,
        fill: Fill::default(),
        machine,
        all: Vec::new(),
    };
    let structure = stages.time("grids and elements", || wing.structure().expect("a wing"));
    stages.dof = structure.free_dof().len();
    let matrices = || element_matrices(&structure).collect::<Vec<ElementMatrix>>();
    drop(stages.time("element matrices (once)", matrices));
    drop(structure);
    let known = planted(wing).expect("a wing");
    let (model, test) = (&known.model.0, &known.test);
    let ones = vec![1.0; model.parameters().len()];
    let sizes = model.sizes(&ones).expect("sizes");
    let plan = || {
        let elements = model.elements().to_vec();
        StructuralStiffness::new(model.structure(), elements).expect("a plan")
    };
    let planned = stages.time("ordering and pattern (once)", plan);
    stages.fill = fill::of_factor(&planned);
    let factorize = || planned.factorized(&sizes).expect("it is held");
    let structural = stages.time("assembly and factorization", factorize);
    let flexibility = || {
        structural
            .flexibility(model.load_distribution())
            .expect("a flexibility")
    };
    stages.time("flexibility by forward substitution", flexibility);
    drop((structural, planned));
    let condensed = stages.time(CONDENSED, || model.condense(&ones).expect("it condenses"));
    let modes = stages.time("modes: 10 of 108", || {
        solve(&condensed.stiffness, model.mass(), MODES).expect("modes")
    });
    stages.time("shapes of the structure: 10 solutions", || {
        condensed.structural_shapes(modes.shapes()).expect("shapes")
    });
    drop(condensed);
    let analyze = |factors: &[f64]| model.analyze(factors, test, Some(MODES));
    let modal = stages.time(ANALYSIS, || analyze(&ones).expect("analyzed"));
    stages.time("derivatives by definition", || {
        modal.error_changes(modal.exact()).expect("derivatives")
    });
    let (settings, ranges) = (settings(), model.factor_ranges().expect("bounds"));
    let solved = Eigensolved(modal.clone());
    let inner = || run(&solved, &ones, &ranges, &settings.inner).expect("it runs");
    let run = stages.time("inner loop of the first pass", inner);
    stages.time("pass with its analysis", || {
        inner();
        analyze(&run.factors).expect("analyzed")
    });
    let analyze = |factors: &[f64]| analyze(factors).map(Eigensolved);
    stages.time("correlation to an error sum of 5 %", || {
        correlate(analyze, &ranges, &settings, |_, _| true).expect("it runs")
    });
    (stages, known, modal)
}

/// Times the modes of the whole model without any condensation, counted by inertia; with them its mass and their frequencies, Hz.
///
/// What an analysis at the points would have, elements by elements, is given away before.
pub fn whole_modes(wing: &Wing, stages: &mut Stages) -> (SparseMatrix, Vec<f64>) {
    let material = Material {
        density: DENSITY,
        ..wing.material
    };
    let model = Wing {
        material,
        ..wing.clone()
    }
    .model()
    .expect("a wing");
    let ones = vec![1.0; model.parameters().len()];
    let (points, _) = WholeModel::of(&model).expect("a whole model");
    let (stiffness, points) = points.at(&ones).expect("matrices");
    let structure = model.structure();
    let elements = structure.elements().iter().zip(structure.corners());
    let lumped = elements.flat_map(|(element, own)| lumped_masses(structure, element, own));
    let lumped = lumped.map(|(row, mass)| (row, row, mass));
    let all = points.entries().iter().copied().chain(lumped).collect();
    let mass = SparseMatrix::new("mass", points.rows(), points.rows(), all).expect("a mass");
    drop((model, points));
    let whole = WholeModel::new(stiffness, mass.clone(), Vec::new()).expect("a whole model");
    let modes = || whole.modes(&[], WHOLE_MODES).expect("modes").vibrations;
    let found = stages.time("20 modes of the whole model (counted)", modes);
    (mass, found.frequencies_hz())
}

/// The paper's costs of its wing of 1326 SDOF in seconds, then and now: what it lists, what is done here in its place.
pub fn papers_costs(known: &Known, stages: &Stages) -> Vec<(&'static str, f64, f64)> {
    let model = &known.model.0;
    let ones = vec![1.0; model.parameters().len()];
    let sizes = model.sizes(&ones).expect("sizes");
    let elements: Vec<_> = element_matrices(model.structure()).collect();
    let structural = Factor::of_stiffness(&elements, &sizes, model.structure().free_dof());
    let structural = structural.expect("it is held");
    let stiffness = model.condense(&ones).expect("it condenses").stiffness;
    let mut now = Stages {
        all: Vec::new(),
        ..*stages
    };
    let identity = DMatrix::identity(stages.dof, stages.dof);
    drop(now.time("K_S", || structural.solve(&identity).expect("an inverse")));
    drop(now.time("K_D", || {
        stiffness.clone().cholesky().expect("definite").inverse()
    }));
    let loads = model.load_distribution();
    let t = loads.dense();
    drop(now.time("B", || {
        let flexibility = structural.flexibility(loads).expect("a flexibility");
        let stiffness = flexibility.cholesky().expect("definite").inverse();
        structural.solve(&(&t * stiffness)).expect("deflections")
    }));
    drop(now.time("shares", || model.matrices(&ones).expect("shares")));
    let of = |name| stages.seconds(name);
    let (condensed, flexibility) = (of(CONDENSED), of("flexibility by forward substitution"));
    let shares =
        (now.seconds("shares") - condensed - (now.seconds("B") - flexibility)) / ones.len() as f64;
    let generalized = of(ANALYSIS) - condensed - of("modes: 10 of 108");
    vec![
        (
            "(i) K_S inverted, order 1326 (1458)",
            60.0,
            of("assembly and factorization") + now.seconds("K_S"),
        ),
        ("(ii) K_D inverted, order 108", 4.5, now.seconds("K_D")),
        ("(iii) B", 53.0, now.seconds("B")),
        ("(iv) B K_S B^t, one substructure", 30.0, shares),
        (
            "generalized stiffness, 25 substructures, 10 modes",
            7.0,
            generalized,
        ),
        (
            "derivatives, 25 substructures, 10 modes",
            1.0,
            of("derivatives by definition"),
        ),
    ]
}
