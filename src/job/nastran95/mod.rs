//! The finite element analysis by NASTRAN-95 instead of the crate's own elements: the paper's arrangement, with the
//! inner loop here and the finite elements there.
//!
//! For every analysis a deck is written at the present gages and run once. Beside the structure it holds every element
//! a second time, alone, on fixed grids of its own: its matrix is then a block of KGG, while KAA and MAA are the
//! structure's alone. Each element's stiffness is taken over; their sum is $K_S$, which must equal NASTRAN's own
//! KAA. No mass is taken over, but MAA must equal $T M T^t$ plus the lumped mass of elements with a density.
//!
//! Everything else is computed here: $M_S$ is singular, and NASTRAN's own eigenvalues are good to five or six digits only. It keeps
//! coordinates, gages and material in single precision: its matrices differ from the crate's by up to 1.5e-7 of the largest
//! entry, and by more where its shear panel takes sides that are nearly parallel for parallel.

mod process;

use crate::files::deck::{BulkData, Task, write};
use crate::files::error::FileError;
use crate::files::nastran95::{Matrices, read_output5};
use crate::method::appendix_a::assemble;
use crate::method::error::Error;
use crate::method::linear_algebra::{check_length, check_shape, check_symmetric};
use crate::method::model::FiniteElementModel;
use crate::method::structure::{Element, Grid};
use crate::sparse::elements::lumped_masses;
use nalgebra::{DMatrix, Vector3};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// The program's name in reports.
pub const NAME: &str = "NASTRAN-95";

/// Time that a run may take unless told otherwise; the box takes half a second.
const TIME_LIMIT: Duration = Duration::from_secs(60);
/// Bytes that a run may print, and write on Fortran unit 15, unless told otherwise; the box takes a few thousandths.
const OUTPUT_LIMIT: u64 = 1 << 28;

/// DOF of a grid in KGG: translations, then rotations.
const GRID_DOF: usize = 6;
/// Largest difference of KAA and the sum of the element matrices, relative to its largest entry: they are the same numbers added in
/// another order.
const LARGEST_STIFFNESS_DIFFERENCE: f64 = 1e-9;
/// Largest difference of MAA, relative to its largest entry: NASTRAN-95 holds masses in single precision.
const LARGEST_MASS_DIFFERENCE: f64 = 1e-6;

/// Folder of the Python wheel `nastran95` when it is unpacked by the commands in `golden/nastran95/README.md`.
pub fn default_folder() -> PathBuf {
    std::env::home_dir()
        .unwrap_or_default()
        .join(".cache/nastran95/nastran95/_data")
}

/// The output of a run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Answer {
    /// The printed output.
    pub printed: String,
    /// Text that was written on Fortran unit 15, if any.
    pub unit_15: Option<String>,
}

/// An installed NASTRAN-95.
#[derive(Debug, Clone)]
pub struct Nastran95 {
    home: PathBuf,
    /// Time after which a run counts as hanging and is stopped.
    pub time_limit: Duration,
    /// Bytes of a file of a run above which the run is stopped and nothing read.
    pub output_limit: u64,
    /// Set from outside, for example by a signal, it stops the run and removes its files.
    pub stop: Arc<AtomicBool>,
}

impl Nastran95 {
    /// The program in a folder that holds `bin/nastrn` and `rf/`, the rigid formats.
    ///
    /// # Errors
    /// [`FileError::SolverMissing`] if the folder does not hold them.
    pub fn in_folder(home: &Path) -> Result<Self, FileError> {
        let missing = || FileError::SolverMissing {
            path: home.to_owned(),
        };
        // A relative path would mean another folder once the program runs in its scratch folder.
        let home = home.canonicalize().map_err(|_| missing())?;
        if !home.join(process::PROGRAM).is_file() || !home.join(process::RIGID_FORMATS).is_dir() {
            return Err(missing());
        }
        Ok(Self {
            home,
            time_limit: TIME_LIMIT,
            output_limit: OUTPUT_LIMIT,
            stop: Arc::default(),
        })
    }

    /// The matrices that a deck has NASTRAN write with module OUTPUT5 on Fortran unit 15, of no more than `numbers` entries.
    ///
    /// # Errors
    /// [`FileError::SolverAnswer`] when NASTRAN writes nothing or something else; the errors of [`Self::run`].
    pub fn matrices(&self, deck: &str, numbers: usize) -> Result<Matrices, FileError> {
        let answer = self.run(deck)?;
        let unit_15 = answer.unit_15.ok_or_else(|| {
            let last = process::last_lines(&answer.printed);
            FileError::answer(format!(
                "nothing was written on Fortran unit 15; printed last: {last}"
            ))
        })?;
        read_output5(&unit_15, numbers)
    }

    /// A model with NASTRAN's elements in place of its own, from an analysis at the given parameter factors.
    ///
    /// # Errors
    /// [`FileError::SolverAnswer`] when KAA is not the sum of the elements to 1e-9 or MAA not $T M T^t$ to 1e-6 of its largest
    /// entry; the errors of [`Self::matrices`] and [`BulkData::from_model`].
    pub fn elements(
        &self,
        model: &FiniteElementModel,
        factors: &[f64],
    ) -> Result<FiniteElementModel, FileError> {
        // The position of a dynamic point does not matter: its MPC equation alone ties it to the structure.
        let points = vec![Vector3::zeros(); model.mass().nrows()];
        let bulk = BulkData::from_model(model, factors, &points)?;
        let all = with_single_elements(&bulk);
        let deck = write(&all, "ANALYSIS", &Task::Matrices)?;
        // KGG, KAA and MAA have no more rows than this.
        let rows = GRID_DOF.saturating_mul(all.grids.len());
        let answer = self.matrices(&deck, rows.saturating_mul(rows).saturating_mul(3))?;
        let units = unit_stiffness(model, &bulk, &answer)?;
        let model = model.with_unit_stiffness(units)?;
        check_assembled(&model, factors, &answer)?;
        Ok(model)
    }
}

impl FiniteElementModel {
    /// Model with element matrices of another origin, such as another program's: stiffness for unit size at each
    /// element's free DOF, lbf/in, in the structure's order.
    ///
    /// # Errors
    /// [`Error::WrongShape`] and [`Error::Value`] for matrices that do not fit or are not symmetric and finite.
    pub fn with_unit_stiffness(&self, units: Vec<DMatrix<f64>>) -> Result<Self, Error> {
        check_length("element matrices", units.len(), self.element_matrices.len())?;
        let mut model = self.clone();
        for (element, unit) in model.element_matrices.iter_mut().zip(units) {
            let dof_count = element.dof.len();
            check_shape("element stiffness", &unit, dof_count, dof_count)?;
            check_symmetric("element stiffness", &unit)?;
            element.unit = unit;
        }
        Ok(model)
    }
}

/// The model with every element a second time, alone, on fixed grids of its own after all others.
fn with_single_elements(bulk: &BulkData) -> BulkData {
    let mut all = bulk.clone();
    let base = bulk.first_free_label();
    let position: HashMap<usize, _> = bulk
        .grids
        .iter()
        .map(|grid| (grid.label, grid.position))
        .collect();
    for (row, element) in bulk.elements.iter().enumerate() {
        let first = base + all.grids.len() - bulk.grids.len();
        let corners = element.grids.iter().filter_map(|grid| position.get(grid));
        let corners = (first..).zip(corners);
        all.grids.extend(corners.map(|(label, &position)| Grid {
            label,
            position,
            constrained: [true; 3],
        }));
        let grids = (first..).take(element.grids.len()).collect();
        all.elements.push(Element {
            label: base + row,
            grids,
            ..element.clone()
        });
    }
    all
}

/// Unit stiffness of every element at its free DOF, in the order of the model's structure, from the blocks of KGG.
fn unit_stiffness(
    model: &FiniteElementModel,
    bulk: &BulkData,
    answer: &Matrices,
) -> Result<Vec<DMatrix<f64>>, FileError> {
    let mut block_of = HashMap::new();
    let mut start = GRID_DOF * bulk.grids.len();
    for element in &bulk.elements {
        block_of.insert(element.label, (start, element.size));
        start += GRID_DOF * element.grids.len();
    }
    let kgg = matrix(answer, "KGG", start)?;
    let structure = model.structure();
    let unit = |element: &Element| {
        let unknown = || Error::Unknown {
            owner: "the deck".into(),
            what: "element",
            label: element.label,
        };
        let &(start, size) = block_of.get(&element.label).ok_or_else(unknown)?;
        let dof = (0..3 * element.grids.len()).map(|dof| (dof / 3, dof % 3));
        let is_free = |corner: usize, direction| {
            structure
                .free_dof_index(element.grids[corner], direction)
                .is_some()
        };
        let free = dof.filter(|&(corner, direction)| is_free(corner, direction));
        let rows: Vec<usize> = free
            .map(|(corner, direction)| start + GRID_DOF * corner + direction)
            .collect();
        Ok(kgg.select_rows(&rows).select_columns(&rows) / size)
    };
    structure.elements().iter().map(unit).collect()
}

/// Refuses an answer whose assembled matrices are not those of the model it was asked about: elements are told apart by
/// their place in KGG alone, and this check is what makes that safe.
fn check_assembled(
    model: &FiniteElementModel,
    factors: &[f64],
    answer: &Matrices,
) -> Result<(), FileError> {
    let free = model.structure().free_dof();
    let (structure, t) = (model.structure(), model.load_distribution());
    let sizes = model.sizes(factors)?;
    let stiffness = assemble(model.element_matrices(), &sizes, free.len())?;
    let mut mass = t * model.mass() * t.transpose();
    for (element, corners) in structure.elements().iter().zip(structure.corners()) {
        for (row, own) in lumped_masses(structure, element, corners) {
            mass[(row, row)] += own;
        }
    }
    // NASTRAN's order is that of the grids' numbers.
    let mut order: Vec<usize> = (0..free.len()).collect();
    order.sort_by_key(|&row| (free[row].grid, free[row].direction));
    let same = |name: &str, meaning: &str, here: DMatrix<f64>, limit: f64| {
        let there = matrix(answer, name, free.len())?;
        let here = here.select_rows(&order).select_columns(&order);
        let difference = (there - &here).amax() / here.amax();
        if difference <= limit {
            return Ok(());
        }
        Err(FileError::answer(format!(
            "{name} is {difference:.1e} of its largest entry off {meaning}, more than {limit:.0e}"
        )))
    };
    same(
        "KAA",
        "the sum of its element matrices",
        stiffness,
        LARGEST_STIFFNESS_DIFFERENCE,
    )?;
    same(
        "MAA",
        "the masses the MPC equations distribute",
        mass,
        LARGEST_MASS_DIFFERENCE,
    )
}

fn matrix<'a>(
    answer: &'a Matrices,
    name: &str,
    size: usize,
) -> Result<&'a DMatrix<f64>, FileError> {
    let found = match answer.get(name) {
        Some(matrix) if matrix.shape() == (size, size) => return Ok(matrix),
        Some(matrix) => format!("is {} x {}", matrix.nrows(), matrix.ncols()),
        None => "is missing".to_owned(),
    };
    Err(FileError::answer(format!(
        "matrix {name} {found}; the model has {size} rows and columns"
    )))
}
