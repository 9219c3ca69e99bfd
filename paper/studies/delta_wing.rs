//! A second structure: the delta wing of NACA TN 3114, and its gages recovered from its modes by the paper's own loops.
//!
//! The wing is the deck `paper/delta_wing.bdf`; `paper/delta_wing.md` says where its numbers come from, and what the scenario is. The
//! model is the wing with some gages wrong, in [`GROUPS`]; what is to be found are factors on the stiffness of all groups.
//!
//! - **Measured** is $z$ at the 19 upper grids that move. $T$ (86 × 19) selects them: one entry a column.
//! - **Test modes** are ten of the lowest twelve of the right wing, with mass in all directions at all its 86 DOF, sampled at the
//!   measured points: nothing of the model's own condensation is in them. Modes 8 and 9 are left out: at 372.3 and 378.2 Hz they are
//!   1.6 % apart, and the wrong gages exchange and mix them.
//! - **Mass**: the wing was weighed part by part, so that every element of the model has its true mass whatever its gage. The dynamic
//!   mass is $B M_S B^t$, with the new $B$ of every pass. Stiffness alone is corrected.
//! - **Held fixed** are posts and caps, rods of known cross section.

use super::known::{Known, Weighed};
use super::{percents, rows};
use crate::prelude::*;

/// Direction of every load and measurement.
const Z: usize = 2;
/// Load on one grid of the tip, lbf, downward.
const TIP_LOAD: f64 = 500.0;
/// Upper grids whose deflections were measured and printed.
pub const MEASURED_GRIDS: [usize; 9] = [14, 15, 16, 34, 35, 36, 54, 55, 74];
/// The grids of the tip that are loaded one at a time: trailing edge and leading edge.
pub const LOADS: [(&str, usize); 2] = [("te", 16), ("le", 36)];
/// The test modes, by their number among the right wing's.
pub const TEST_MODES: [usize; 10] = [1, 2, 3, 4, 5, 6, 7, 10, 11, 12];
/// Mass of the points of a model that has none there, lbf·s²/in.
const POINT_MASS: f64 = 1e-3;

/// The wing as a deck.
pub fn deck() -> BulkData {
    let deck = include_bytes!("../delta_wing.bdf");
    deck::read("paper/delta_wing.bdf", deck, &[]).unwrap().model
}

/// Deflections along $z$ at [`MEASURED_GRIDS`] under the tip load on a grid, in; downward is negative.
pub fn deflections(loaded: usize) -> Vec<f64> {
    let structure = deck().structure().unwrap();
    let elements = element_matrices(&structure).collect_vec();
    let sizes = structure.elements().iter().map(|own| own.size);
    let count = structure.free_dof().len();
    let stiffness = assemble(&elements, &sizes.collect_vec(), count).unwrap();
    let row = |grid: usize| structure.free_dof_index(grid, Z).unwrap();
    let mut load = DVector::zeros(count);
    load[row(loaded)] = -TIP_LOAD;
    let deflected = stiffness.cholesky().unwrap().solve(&load);
    MEASURED_GRIDS.map(|grid| deflected[row(grid)]).to_vec()
}

/// Deflections that NASTRAN printed in 1995, that were measured, that the analog computer gave.
pub fn known_deflections() -> PublishedTable {
    let text = include_str!("../tables/delta_wing_deflections.csv");
    PublishedTable::parse(0, "delta_wing_deflections.csv", text).unwrap()
}

/// The lowest three frequencies of others.
pub fn known_frequencies() -> PublishedTable {
    let text = include_str!("../tables/delta_wing_frequencies.csv");
    PublishedTable::parse(0, "delta_wing_frequencies.csv", text).unwrap()
}

/// Elements that are scaled together.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Group {
    /// Where they are: coordinates in inches, $x$ outboard and $y$ forward.
    pub name: String,
    /// Their numbers.
    pub elements: Vec<usize>,
    /// Their first gage in the model over the true one.
    pub first_over_true: f64,
}

impl Group {
    /// The factor that makes the model right.
    pub fn true_factor(&self) -> f64 {
        1.0 / self.first_over_true
    }
}

/// All covers and webs, by bay and by span, and what is wrong in the first model.
pub static GROUPS: LazyLock<Vec<Group>> = LazyLock::new(|| {
    let text = include_str!("../delta_wing.toml");
    let mut all: BTreeMap<String, Vec<Group>> = toml::from_str(text).unwrap();
    all.remove("group").unwrap()
});

/// Tolerances of the scenario, sums over its ten test modes: 1 % on the error sum of the first pass, half a percent after and in the exact
/// check. The step is read as own: by matrix thirty iterations a pass end at 0.51 %. All else is the paper's.
pub fn settings() -> Settings {
    Settings {
        inner: InnerSettings {
            tolerance: 0.01,
            step: StepRule::Own,
            ..InnerSettings::default()
        },
        later_inner_tolerance: 0.005,
        // Together they bound either error below its own default.
        error_sum_tolerance: 0.005,
        ..Settings::default()
    }
}

/// The grids whose $z$ is measured: those of the upper surface that move.
pub fn measured_grids(structure: &Structure) -> Vec<usize> {
    let grids = structure.grids().iter();
    let measured = grids.filter(|grid| grid.position.z > 0.0 && !grid.constrained[Z]);
    measured.map(|grid| grid.label).collect()
}

/// Rows of the measured grids among the free DOF.
fn measured_rows(structure: &Structure) -> Vec<usize> {
    let row = |grid| structure.free_dof_index(grid, Z);
    measured_grids(structure)
        .into_iter()
        .filter_map(row)
        .collect()
}

/// The model with the wrong gages of [`GROUPS`], one parameter a group. Its points have no masses: those that a finite element model must
/// have are [`POINT_MASS`], of which its matrices know nothing.
pub fn first_model() -> Weighed {
    let mut wrong = deck();
    for element in &mut wrong.elements {
        let group = GROUPS
            .iter()
            .find(|of| of.elements.contains(&element.label));
        let ratio = group.map_or(1.0, |group| group.first_over_true);
        element.size *= ratio;
        element.material.density /= ratio;
    }
    let structure = wrong.structure().unwrap();
    let rows = measured_rows(&structure);
    let mut loads = DMatrix::zeros(structure.free_dof().len(), rows.len());
    (0..)
        .zip(&rows)
        .for_each(|(column, row)| loads[(*row, column)] = 1.0);
    let mass = POINT_MASS * DMatrix::identity(rows.len(), rows.len());
    let parameters = GROUPS
        .iter()
        .map(|of| Parameter::new(&of.name, &of.elements));
    let model = FiniteElementModel::new(structure, loads, mass, parameters.collect());
    Weighed(model.unwrap())
}

/// The test modes at the measured grids.
pub fn test_modes() -> Modes {
    let whole = deck::modes(&deck(), usize::MAX).unwrap().modes;
    let (places, hz) = (TEST_MODES.map(|mode| mode - 1), whole.frequencies_hz());
    // Each of the free DOF has mass of covers and webs: nothing is condensed.
    let rows = measured_rows(&deck().structure().unwrap());
    let shapes = whole.shapes().select_rows(&rows).select_columns(&places);
    Modes::from_measured(&places.map(|place| hz[place]), &shapes).unwrap()
}

/// The scenario run to its end, and what the test modes can see of each of the [`GROUPS`]: its largest share of a test mode's generalized
/// stiffness in the first model, $\max_i V_{Gi}^t K_e V_{Gi}/\omega_{Gi}^2$.
pub type WingCorrelation = (Correlation, Vec<f64>);

/// The model of wrong gages corrected by the paper's loops, with the finite element analysis of this crate or of another program: `elements`
/// is given the model and the factors on its groups, and returns the model with that program's element stiffness.
///
/// The test modes stay those of [`test_modes`]: a test knows nothing of the program that analyzes the model.
///
/// # Errors
/// Those of `elements`, of the analysis and of the loops.
pub fn correlate_wing<E: From<Error>>(
    mut elements: impl FnMut(&Weighed, &[f64]) -> Result<Weighed, E>,
) -> Result<WingCorrelation, E> {
    let Known { model, test, .. } = Known::delta_wing();
    let mut analyze = |factors: &[f64]| -> Result<ModalModel, E> {
        Ok(elements(&model, factors)?.analyze(factors, &test)?)
    };
    let first = analyze(&vec![1.0; GROUPS.len()])?;
    let shares = first.test_shares().iter().map(|of| of.diagonal().max());
    let shares = shares.collect();
    let ranges = model.factor_ranges()?;
    let run = correlate(analyze, &ranges, &settings(), |_, _| true)?;
    Ok((run, shares))
}

/// By this crate's own analysis.
pub static RUN: LazyLock<WingCorrelation> =
    LazyLock::new(|| correlate_wing(|model, _| Ok::<_, Error>(model.clone())).unwrap());

/// Deflections and frequencies beside those of others, and what the correlation finds.
pub fn tables() -> Vec<Table> {
    let differences = |known: &PublishedTable, found: &[f64], others: &[String]| {
        let of = |(label, found): (&String, &f64)| {
            let off = |of: &String| found / known.required(label, of).unwrap() - 1.0;
            let mut row = vec![*found];
            row.extend(percents(others.iter().map(off)));
            (label.clone(), row)
        };
        known.labels.iter().zip(found).map(of).collect_vec()
    };
    let columns = ["Computed", "Measured difference %", "Analog difference %"];
    let mut tables = LOADS
        .map(|(short, grid)| {
            let others = ["experiment", "analog"].map(|who| format!("{short}_{who}_in"));
            let found = differences(&known_deflections(), &deflections(grid), &others);
            rows(&format!("delta_wing_deflections_{short}"), &columns, found)
        })
        .to_vec();
    let hz = deck::modes(&deck(), 3).unwrap().modes.frequencies_hz();
    let found = differences(&known_frequencies(), &hz, &["analog_hz".to_owned()]);
    tables.push(rows(
        "delta_wing_frequencies",
        &[columns[0], columns[2]],
        found,
    ));
    let (run, shares) = &*RUN;
    let groups = GROUPS.iter().zip(&run.best_factors).zip(shares);
    let groups = groups.map(|((of, factor), share)| {
        let last = factor / of.true_factor() - 1.0;
        (&of.name, percents([of.first_over_true - 1.0, last, *share]))
    });
    let columns = ["First gage error %", "Last gage error %", "Largest share %"];
    tables.push(rows("delta_wing_groups", &columns, groups));
    let ends = [&run.initial.errors, &run.best_check().errors];
    let errors = [
        ("frequency", percents(ends.map(Errors::frequency_rms))),
        ("shape", percents(ends.map(Errors::shape_rms))),
    ];
    tables.push(rows(
        "delta_wing_errors",
        &["First %", "Corrected %"],
        errors,
    ));
    let passes = (1..).zip(&run.passes);
    let passes = passes.map(|(n, pass)| (n, vec![pass.inner.iterations.len() as f64]));
    tables.push(rows("delta_wing_passes", &["Iterations"], passes));
    tables
}
