//! Every stage of a pass, ready to be done again: of the paper's box, and of the wing of 1,458 structural DOF.

use crate::wing::{Wing, planted_factors};
use corfem::method::analysis::Analysis;
use corfem::method::appendix_a::{ElementMatrix, element_matrices};
use corfem::method::inner_loop::{InnerSettings, run};
use corfem::method::model::FiniteElementModel;
use corfem::method::modes::{Modes, solve};
use corfem::method::step::StepRule;
use corfem::torque_box::Case;
use std::hint::black_box;

/// The structures.
pub const STRUCTURES: [&str; 2] = ["box", "wing"];

/// A stage: its name, and what does it once.
pub type Stage = (&'static str, Box<dyn FnMut()>);

/// Case 2 with its nine modes, or the wing with ten and an inner loop to an error sum of 5 %.
fn problem(structure: &str) -> (FiniteElementModel, Modes, usize, InnerSettings) {
    if structure == "box" {
        let case = Case::new(2).expect("a case");
        return (
            case.model().expect("a model"),
            case.test_modes().expect("test modes"),
            9,
            case.settings.inner,
        );
    }
    let model = Wing::default().model().expect("a wing");
    let truth = planted_factors(model.parameters().len());
    let test = model.modes(&truth).and_then(|all| all.lowest(10));
    let settings = InnerSettings {
        tolerance: 0.05,
        step: StepRule::Own,
        ..InnerSettings::default()
    };
    (model, test.expect("modes"), 10, settings)
}

fn stage<T: 'static>(name: &'static str, work: impl Fn() -> T + 'static) -> Stage {
    (name, Box::new(move || drop(black_box(work()))))
}

/// All stages of a structure, in the order of a pass.
pub fn stages(structure: &str) -> Vec<Stage> {
    // What the stages share lives as long as the program.
    let (model, test, modes, settings) = problem(structure);
    let (model, test): (&'static _, &'static _) =
        (Box::leak(Box::new(model)), Box::leak(Box::new(test)));
    let ones: &'static [f64] = vec![1.0; model.parameters().len()].leak();
    let condensed = model.condense(ones).expect("it condenses");
    let analyze = move || model.analyze(ones, test, Some(modes)).expect("analyzed");
    let modal = &*Box::leak(Box::new(analyze()));
    let ranges = model.factor_ranges().expect("bounds");
    let inner = move || run(modal, ones, &ranges, &settings).expect("it runs");
    let factors = inner().gage_factors;
    let pass = inner.clone();
    vec![
        stage("element matrices", move || {
            element_matrices(model.structure()).collect::<Vec<ElementMatrix>>()
        }),
        stage("condensation", move || {
            model.condense(ones).expect("it condenses")
        }),
        stage("modes", move || {
            solve(&condensed.stiffness, model.mass(), modes).expect("modes")
        }),
        stage("analysis with all shares", analyze),
        stage("derivatives by definition", move || {
            modal.error_changes(modal.exact()).expect("derivatives")
        }),
        stage("inner loop of the first pass", inner),
        stage("pass with its analysis", move || {
            pass();
            model
                .analyze(&factors, test, Some(modes))
                .expect("analyzed")
        }),
    ]
}
