//! What is timed: a correlation's stages one by one, each through the library's own functions.

use crate::fill::{self, Fill};
use crate::machine::Machine;
use crate::memory::peak;
use crate::wing::{Wing, planted_factors};
use corfem::method::analysis::Analysis;
use corfem::method::appendix_a::{ElementMatrix, element_matrices};
use corfem::method::modes::Modes;
use corfem::method::sorting::pair_modes;
use corfem::method::structure::Material;
use corfem::sparse::factorization::Factor;
use corfem::sparse::{SensorModel, SparseMatrix};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// Modes of the analysis, and of the test.
const MODES: usize = 20;
const TEST_MODES: usize = 10;
/// Density of the wing, lbf·s²/in⁴: aluminum.
const DENSITY: f64 = 2.6e-4;
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
}

/// A wing and its analysis, as other programs are given it.
pub struct Analyzed {
    pub wing: Wing,
    pub mass: SparseMatrix,
    pub modes: Modes,
    pub model: SensorModel,
}

/// Times every stage of a wing, and hands it back with what an analysis found.
pub fn of(wing: &Wing) -> (Stages, Analyzed) {
    let material = Material {
        density: DENSITY,
        ..wing.material
    };
    let wing = Wing {
        material,
        ..wing.clone()
    };
    let mut stages = Stages {
        dof: 0,
        fill: Fill::default(),
        machine: Machine::measured(),
        all: Vec::new(),
    };
    let structure = stages.time("grids and elements", || wing.structure().expect("a wing"));
    stages.dof = structure.free_dof().len();
    let matrices = || element_matrices(&structure).collect::<Vec<ElementMatrix>>();
    let elements = stages.time("element matrices (once)", matrices);
    drop(structure);
    let (whole, sensors) = wing.whole().expect("a wing");
    let count = whole.parameters().len();
    let (ones, truth) = (vec![1.0; count], planted_factors(count));
    let assemble = || whole.at(&truth).expect("matrices");
    let (stiffness, mass) = stages.time("assembly at changed factors", assemble);
    let factorize = || Factor::new("stiffness", &stiffness).expect("it is held");
    let factor = stages.time("ordering and factorization", factorize);
    stages.fill = fill::of_order(factor.order(), &elements);
    drop((elements, factor, stiffness));
    let right = whole.modes(&truth, TEST_MODES).expect("modes").vibrations;
    let seen = sensors.times(right.shapes()).expect("shapes");
    let test = Modes::new(right.omega_squared().clone(), seen).expect("a test");
    let modes = || whole.modes(&ones, MODES).expect("modes").vibrations;
    let modes = stages.time("20 modes of the whole model (counted)", modes);
    let analyze = || {
        let model = whole.analyze(
            &ones,
            &sensors,
            &test,
            corfem::sparse::Pair::by(|of| pair_modes(of.cross)),
            MODES,
        );
        model.expect("an analysis")
    };
    let model = stages.time("analysis with all shares", analyze);
    stages.time("derivatives by definition", || {
        model.error_changes(model.exact()).expect("derivatives")
    });
    let analyzed = Analyzed {
        wing,
        mass,
        modes,
        model,
    };
    (stages, analyzed)
}
