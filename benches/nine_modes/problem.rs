//! What is timed: the paper's nine-mode problem, and the passes of its cases.

use corfem::method::analysis::Analysis;
use corfem::method::derivatives::DERIVATIVE_STEP;
use corfem::method::inner_loop::InnerSettings;
use corfem::method::model::{FiniteElementModel, ModalModel};
use corfem::method::modes::Modes;
use corfem::method::step::Bounds;
use corfem::torque_box::{CASES, Case, run_case};
use nalgebra::{DMatrix, DVector};

/// Modes, and dynamic degrees of freedom, of the paper's box.
pub const NINE: usize = 9;

/// Case 2 at its start: membrane covers, shear webs.
pub struct Setting {
    /// The modal problem.
    pub problem: ModalModel,
    /// $M^{-1/2}(K_D + 0.001 K_e)M^{-1/2}$ of every element: what differences of eigensolutions would solve.
    pub element_matrices: Vec<DMatrix<f64>>,
    /// $V^t \Delta K V$ of a step of ten percent up and down.
    pub beta: DMatrix<f64>,
    /// $M^{-1/2}(K_D + \Delta K)M^{-1/2}$ of the same step.
    pub step_matrix: DMatrix<f64>,
}

impl Setting {
    pub fn new() -> Self {
        let case = Case::new(2).expect("a case");
        let model = case.model().expect("a model");
        let factors = vec![1.0; model.parameters().len()];
        let dynamic = model.matrices(&factors).expect("analyzed");
        let test = case.test_modes().expect("test modes");
        let problem = dynamic.analyze(&test, Some(NINE)).expect("reduced");
        // The box's mass is diagonal, so the reduction to a standard problem is a scaling; it is not timed.
        let scale = DMatrix::from_diagonal(&DVector::from_iterator(
            NINE,
            dynamic
                .mass
                .diagonal()
                .iter()
                .map(|mass| mass.sqrt().recip()),
        ));
        let standard = |change: &DMatrix<f64>| &scale * (&dynamic.stiffness + change) * &scale;
        let mut change = DMatrix::zeros(NINE, NINE);
        for (e, share) in dynamic.shares.iter().enumerate() {
            change += if e % 2 == 0 { 0.1 } else { -0.1 } * share;
        }
        let shapes = problem.exact().modes.shapes();
        let shares = dynamic.shares.iter();
        Self {
            element_matrices: shares
                .map(|share| standard(&(DERIVATIVE_STEP * share)))
                .collect(),
            beta: shapes.tr_mul(&(&change * shapes)),
            step_matrix: standard(&change),
            problem,
        }
    }
}

/// One pass of a case, ready to be run again.
pub struct PassSetting {
    /// The case.
    pub case: usize,
    /// The pass, from one.
    pub number: usize,
    /// Inner iterations it takes.
    pub iterations: usize,
    /// The model.
    pub model: FiniteElementModel,
    /// Bounds on its factors.
    pub ranges: Vec<Option<Bounds>>,
    /// Its test modes.
    pub test: Modes,
    /// Factors at its start.
    pub factors: Vec<f64>,
    /// The analysis there.
    pub start: ModalModel,
    /// The inner loop's settings.
    pub settings: InnerSettings,
}

impl PassSetting {
    /// Its name.
    pub fn label(&self) -> String {
        format!("case {} pass {}", self.case, self.number)
    }
}

/// Every pass of Cases 1 to 4.
pub fn passes() -> Vec<PassSetting> {
    let mut passes = Vec::new();
    for number in CASES {
        let case = Case::new(number).expect("a case");
        let result = run_case(&case, |_, _| {}).expect("it runs");
        let model = case.model().expect("a model");
        let mut factors = vec![1.0; model.parameters().len()];
        let mut settings = case.settings.inner.clone();
        for (row, pass) in result.correlation.passes.iter().enumerate() {
            passes.push(PassSetting {
                case: number,
                number: row + 1,
                iterations: pass.inner.iterations.len(),
                ranges: model.factor_ranges().expect("bounds"),
                test: result.test.clone(),
                start: model
                    .analyze(&factors, &result.test, None)
                    .expect("analyzed"),
                factors: factors.clone(),
                settings: settings.clone(),
                model: model.clone(),
            });
            factors.clone_from(&pass.factors);
            settings.tolerance = case.settings.later_inner_tolerance;
        }
    }
    passes
}
