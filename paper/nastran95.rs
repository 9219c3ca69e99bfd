//! The paper's arrangement: the loops here and the finite elements in a program of its own, NASTRAN-95. It shows how an analysis by a
//! program of yours is handed to the loops.
//!
//! ```sh
//! cargo run --release --example nastran95           # the paper's four cases
//! cargo run --release --example nastran95 -- 2 3    # two of them
//! ```
//!
//! NASTRAN-95 must be installed as `golden/nastran95/README.md` says; the environment variable `NASTRAN95` names another folder with
//! `bin/nastrn` and `rf/`. Gages, frequencies and errors of every pass are printed as in `golden/nastran95/outer_loop.toml`. After an
//! error, which goes to standard error, or SIGINT or SIGTERM the status is 2; no file is left and nothing runs on.
//!
//! [`correlate_case`] is what a caller of the library writes: [`correlate`] is handed a function that is given factors and returns an
//! analysis. Here that function writes a deck at the present gages, runs it once, and reads every element's stiffness from the
//! matrices that NASTRAN-95 wrote; the model with these elements in place of the crate's own makes the analysis.
//!
//! Beside the structure the deck holds every element a second time, alone, on fixed grids of its own: its matrix is then a block of
//! KGG, while KAA and MAA are the structure's alone. The sum of the elements must equal NASTRAN's own KAA. No mass is taken over, but
//! MAA must equal $T M T^t$ plus the lumped mass of elements with a density.
//!
//! Everything else is computed here: $M_S$ is singular, and NASTRAN's own eigenvalues are good to five or six digits only. It keeps
//! coordinates, gages and material in single precision: its matrices differ from the crate's by up to 1.5e-7 of the largest
//! entry, and by more where its shear panel takes sides that are nearly parallel for parallel.

use corfem::files::deck::number::parse_reals;
use corfem::files::deck::{BulkData, write};
use corfem::files::{error::FileError, escaped};
use corfem::method::analysis::State;
use corfem::method::appendix_a::assemble;
use corfem::method::error::Error;
use corfem::method::model::{FiniteElementModel, ModalModel};
use corfem::method::modes::Modes;
use corfem::method::outer_loop::{Correlation, correlate};
use corfem::method::structure::{Element, Grid};
use corfem::sparse::elements::lumped_masses;
use corfem::torque_box::wing_box::{PANEL_COUNT, TEST_GAGE};
use corfem::torque_box::{CASES, Case};
use nalgebra::{DMatrix, Vector3};
#[cfg(unix)]
use rustix::process::{Pid, Signal, WaitId, WaitIdOptions, kill_process_group, waitid};
use signal_hook::{
    consts::{SIGINT, SIGTERM},
    flag,
};
use std::collections::HashMap;
use std::fs::{self, File};
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitCode, ExitStatus, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// The error of a run is a sentence for its user, whatever made it.
pub type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

// A test takes this file as a module.
#[allow(dead_code)]
fn main() -> ExitCode {
    ExitCode::from(status(std::env::args().skip(1)))
}

/// Does what the arguments ask for, and tells of an error; the status of the program.
pub fn status(arguments: impl Iterator<Item = String>) -> u8 {
    match print_cases(arguments) {
        Ok(()) => 0,
        Err(error) => {
            eprintln!("nastran95: {error}");
            2
        }
    }
}

/// The first lines of what is printed.
pub const HEADING: &str =
    "# Cases of the paper by `cargo run --example nastran95`: inner loop in the crate, every finite element analysis, that of the
# test modes too, in NASTRAN-95; see golden/nastran95/README.md. Hz, in; errors as fractions.
";

/// Prints the histories of the cases named, or of all four.
fn print_cases(arguments: impl Iterator<Item = String>) -> Outcome<()> {
    let numbers = case_numbers(arguments)?;
    let named = std::env::var_os("NASTRAN95").filter(|folder| !folder.is_empty());
    let nastran = Nastran95::in_folder(&named.map_or_else(default_folder, PathBuf::from))?;
    for signal in [SIGINT, SIGTERM] {
        flag::register(signal, Arc::clone(&nastran.stop))?;
    }
    print!("{HEADING}");
    for number in numbers {
        let by_nastran = |model: &_, factors: &[f64]| nastran.elements(model, factors);
        let history = correlate_case(&Case::new(number)?, by_nastran)?;
        print!("\n{}", history.toml()?);
    }
    Ok(())
}

/// The numbers of the cases that the arguments name; all of them without arguments.
pub fn case_numbers(arguments: impl Iterator<Item = String>) -> Outcome<Vec<usize>> {
    let number = |text: String| match text.parse() {
        Ok(number) if CASES.contains(&number) => Ok(number),
        _ => Err(format!(
            "\"{}\" is no case of the paper; name cases by their numbers, 1 to 4",
            escaped(&text)
        )),
    };
    let numbers: Vec<usize> = arguments.map(number).collect::<Result<_, _>>()?;
    Ok(if numbers.is_empty() {
        CASES.to_vec()
    } else {
        numbers
    })
}

/// A case that was correlated.
pub struct History {
    pub case: Case,
    pub test: Modes,
    pub correlation: Correlation,
    /// Gages of the panels after every pass, in.
    pub pass_gages: Vec<Vec<f64>>,
}

/// Correlates a case with the elements of another program: `elements` is given the model and the factors on its parameters, and returns
/// the model with that program's element stiffness.
///
/// The test modes come from it too, as in the paper, so that what is peculiar to an element is the same on both sides.
pub fn correlate_case(
    case: &Case,
    mut elements: impl FnMut(&FiniteElementModel, &[f64]) -> Outcome<FiniteElementModel>,
) -> Outcome<History> {
    let (model, tested) = (case.model()?, case.model_with(&[TEST_GAGE; PANEL_COUNT])?);
    let ones = vec![1.0; tested.parameters().len()];
    let test = elements(&tested, &ones)?.modes(&ones)?;
    // The loops know nothing of the program: they ask for the analysis at factors, and this is it.
    let analyze = |factors: &[f64]| -> Outcome<ModalModel> {
        let model = elements(&model, factors)?;
        Ok(model.analyze(factors, &test, None)?)
    };
    let ranges = model.factor_ranges()?;
    let correlation = correlate(analyze, &ranges, &case.settings, |_, _| true)?;
    let passes = correlation.passes.iter();
    let gages = passes.map(|pass| Ok(model.sizes(&pass.factors)?[..PANEL_COUNT].to_vec()));
    Ok(History {
        case: case.clone(),
        pass_gages: gages.collect::<Result<_, Error>>()?,
        test,
        correlation,
    })
}

impl History {
    /// The case as it stands in `golden/nastran95/outer_loop.toml`.
    pub fn toml(&self) -> Outcome<String> {
        let check = |gages: &[f64], exact: &State| -> Outcome<String> {
            Ok(format!(
                "gages_in = {gages:?}\nfrequencies_hz = {:?}\nfrequency_rms = {:?}\nshape_rms = {:?}\n",
                exact.pairing.paired(&exact.modes)?.frequencies_hz(),
                exact.errors.frequency_rms(),
                exact.errors.shape_rms()
            ))
        };
        let mut text = format!(
            "[[case]]\nnumber = {}\ntest_frequencies_hz = {:?}\n\n[case.initial]\n{}",
            self.case.number,
            self.test.frequencies_hz(),
            check(&self.case.first_gages(), &self.correlation.initial)?
        );
        for (pass, gages) in self.correlation.passes.iter().zip(&self.pass_gages) {
            text += &format!(
                "\n[[case.passes]]\niterations = {}\n{}",
                pass.inner.iterations.len(),
                check(gages, &pass.check)?
            );
        }
        Ok(text)
    }
}

// The analysis.

/// DOF of a grid in KGG: translations, then rotations.
const GRID_DOF: usize = 6;
/// Largest difference of KAA and the sum of the element matrices, relative to its largest entry: they are the same numbers added in
/// another order.
const LARGEST_STIFFNESS_DIFFERENCE: f64 = 1e-9;
/// Largest difference of MAA, relative to its largest entry: NASTRAN-95 holds masses in single precision.
const LARGEST_MASS_DIFFERENCE: f64 = 1e-6;

impl Nastran95 {
    /// A model with NASTRAN's elements in place of its own, from an analysis at the given parameter factors.
    ///
    /// It refuses an answer whose KAA is not the sum of the elements, or whose MAA is not the mass of the model.
    pub fn elements(
        &self,
        model: &FiniteElementModel,
        factors: &[f64],
    ) -> Outcome<FiniteElementModel> {
        // The position of a dynamic point does not matter: its MPC equation alone ties it to the structure.
        let points = vec![Vector3::zeros(); model.mass().nrows()];
        let bulk = BulkData::from_model(model, factors, &points)?;
        let all = with_single_elements(&bulk);
        let deck = write(&all, "ANALYSIS", 1, [1.0, 2.0])?;
        // KGG, KAA and MAA have no more rows than this.
        let rows = GRID_DOF.saturating_mul(all.grids.len());
        let answer = self.matrices(&deck, rows.saturating_mul(rows).saturating_mul(3))?;
        let model = model.with_unit_stiffness(unit_stiffness(model, &bulk, &answer)?)?;
        check_assembled(&model, factors, &answer)?;
        Ok(model)
    }

    /// The matrices KGG, KAA and MAA of a deck that NASTRAN writes with module OUTPUT5 on Fortran unit 15 before it looks for modes, of no more
    /// than `numbers` entries.
    pub fn matrices(&self, deck: &str, numbers: usize) -> Outcome<Matrices> {
        let alter =
            "INSERT READ,-1 $\nOUTPUT5 KGG,KAA,MAA,,//-1/15/*CORFEM*/1 $\nEXIT $\nENDALTER\nCEND\n";
        let answer = self.run(&deck.replacen("CEND\n", alter, 1))?;
        let unit_15 = answer.unit_15.ok_or_else(|| {
            let last = last_lines(&answer.printed);
            format!("NASTRAN-95: nothing was written on Fortran unit 15; printed last: {last}")
        })?;
        read_output5(&unit_15, numbers)
    }
}

/// The model with every element a second time, alone, on fixed grids of its own after all others.
fn with_single_elements(bulk: &BulkData) -> BulkData {
    let mut all = bulk.clone();
    let base = bulk.first_free_label();
    let grids = bulk.grids.iter();
    let position: HashMap<usize, _> = grids.map(|grid| (grid.label, grid.position)).collect();
    for (row, element) in bulk.elements.iter().enumerate() {
        let first = base + all.grids.len() - bulk.grids.len();
        let corners = element.grids.iter().filter_map(|grid| position.get(grid));
        let fixed = (first..).zip(corners).map(|(label, &position)| Grid {
            label,
            position,
            constrained: [true; 3],
        });
        all.grids.extend(fixed);
        all.elements.push(Element {
            label: base + row,
            grids: (first..).take(element.grids.len()).collect(),
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
) -> Outcome<Vec<DMatrix<f64>>> {
    let mut block_of = HashMap::new();
    let mut start = GRID_DOF * bulk.grids.len();
    for element in &bulk.elements {
        block_of.insert(element.label, (start, element.size));
        start += GRID_DOF * element.grids.len();
    }
    let kgg = matrix(answer, "KGG", start)?;
    let structure = model.structure();
    let unit = |element: &Element| {
        let (start, size) = block_of[&element.label];
        let places = (0..3 * element.grids.len()).map(|dof| (dof / 3, dof % 3));
        let free = places.filter(|&(corner, direction)| {
            let row = structure.free_dof_index(element.grids[corner], direction);
            row.is_some()
        });
        let rows: Vec<usize> = free
            .map(|(corner, direction)| start + GRID_DOF * corner + direction)
            .collect();
        kgg.select_rows(&rows).select_columns(&rows) / size
    };
    Ok(structure.elements().iter().map(unit).collect())
}

/// Refuses an answer whose assembled matrices are not those of the model it was asked about: elements are told apart by
/// their place in KGG alone, and this check is what makes that safe.
fn check_assembled(model: &FiniteElementModel, factors: &[f64], answer: &Matrices) -> Outcome<()> {
    let (structure, t) = (model.structure(), model.load_distribution());
    let free = structure.free_dof();
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
    let same = |name: &str, meaning: &str, here: DMatrix<f64>, limit: f64| -> Outcome<()> {
        let there = matrix(answer, name, free.len())?;
        let here = here.select_rows(&order).select_columns(&order);
        let difference = (there - &here).amax() / here.amax();
        if difference <= limit {
            return Ok(());
        }
        Err(format!(
            "NASTRAN-95: {name} is {difference:.1e} of its largest entry off {meaning}, more than {limit:.0e}"
        )
        .into())
    };
    let (sum, masses) = (
        "the sum of its element matrices",
        "the masses the MPC equations distribute",
    );
    same("KAA", sum, stiffness, LARGEST_STIFFNESS_DIFFERENCE)?;
    same("MAA", masses, mass, LARGEST_MASS_DIFFERENCE)
}

fn matrix<'a>(answer: &'a Matrices, name: &str, size: usize) -> Outcome<&'a DMatrix<f64>> {
    let found = match answer.get(name) {
        Some(matrix) if matrix.shape() == (size, size) => return Ok(matrix),
        Some(matrix) => format!("is {} x {}", matrix.nrows(), matrix.ncols()),
        None => "is missing".to_owned(),
    };
    Err(format!("NASTRAN-95: matrix {name} {found}; the model has {size} rows and columns").into())
}

// The formatted file of module OUTPUT5.

/// Matrices by name, such as `KGG`.
pub type Matrices = HashMap<String, DMatrix<f64>>;

/// Widths of the integers of a record and of its reals, format D26.17.
const INTEGER: usize = 8;
const REAL: usize = 26;
/// Columns where a matrix's header begins its sizes and, after them, its name.
const HEADER_SIZES: usize = 26;
const HEADER_NAME: usize = 74;

/// Reads matrices that OUTPUT5 wrote with formatted records.
///
/// After a title line every matrix has a header (number of columns, of rows, form, type, name), then a record for every
/// nonzero column: its number, its first and last nonzero row, and the entries between them; column number zero begins the
/// next matrix. Together they have at most `numbers` entries: a damaged header must not ask for all memory.
pub fn read_output5(text: &str, numbers: usize) -> Outcome<Matrices> {
    let lines: Vec<&str> = text.lines().collect();
    let wrong = |line: usize, what: &str| {
        let reason = match lines.get(line).map(|line| line.trim()) {
            None => format!("the file ends before {what}"),
            Some("") => format!("{what} is missing"),
            Some(text) => format!("\"{}\" is not {what}", shown(text)),
        };
        format!("NASTRAN-95: OUTPUT5 file, line {}: {reason}", line + 1)
    };
    let integer = |line: usize, start: usize| -> Result<usize, String> {
        let field = lines.get(line).and_then(|l| l.get(start..start + INTEGER));
        let value = field.and_then(|text| text.trim().parse().ok());
        value.ok_or_else(|| wrong(line, "a line of integers"))
    };
    let mut matrices = Matrices::new();
    let (mut name, mut left, mut at) = ("", numbers, 1);
    while at < lines.len() {
        let number = |place: usize| integer(at, place * INTEGER);
        let (column, first, last) = (number(0)?, number(1)?, number(2)?);
        at += 1;
        if column == 0 {
            let size = |place: usize| integer(at, HEADER_SIZES + place * INTEGER);
            let (columns, rows, kind) = (size(0)?, size(1)?, size(3)?);
            if kind != 2 {
                Err(wrong(at, "the header of a real double precision matrix"))?;
            }
            let entries = columns.checked_mul(rows);
            let fewer = entries.and_then(|entries| left.checked_sub(entries));
            let within = format!("the header of a matrix within the {numbers} entries of all");
            left = fewer.ok_or_else(|| wrong(at, &within))?;
            name = lines[at].get(HEADER_NAME..).unwrap_or_default().trim();
            matrices.insert(name.to_owned(), DMatrix::zeros(rows, columns));
            at += 1;
            continue;
        }
        let matrix = matrices.get_mut(name);
        let matrix =
            matrix.ok_or_else(|| wrong(at - 1, "the header that precedes a matrix's columns"))?;
        if column > matrix.ncols() || first == 0 || last > matrix.nrows() || last < first {
            Err(wrong(at - 1, "a column and rows within the matrix"))?;
        }
        let mut row = first - 1;
        while row < last {
            let line = lines.get(at).map(|line| line.trim_end());
            let reals = line
                .filter(|line| !line.is_empty())
                .and_then(|line| parse_reals(line, REAL))
                .filter(|reals| reals.len() <= last - row)
                .ok_or_else(|| wrong(at, "a line of the column's reals in format D26.17"))?;
            let mut entries = matrix.column_mut(column - 1);
            entries.rows_mut(row, reals.len()).copy_from_slice(&reals);
            (at, row) = (at + 1, row + reals.len());
        }
    }
    Ok(matrices)
}

/// Most characters of the program's words in an error.
const MESSAGE_LENGTH: usize = 300;

/// The beginning of the program's words, with control characters escaped: a terminal would obey them.
fn shown(words: &str) -> String {
    let start: String = words.chars().take(MESSAGE_LENGTH).collect();
    escaped(&start) + if start.len() < words.len() { "..." } else { "" }
}

// A run of the program: its files in a temporary folder, its time limited.

/// The program and the rigid formats in its folder.
const PROGRAM: &str = "bin/nastrn";
const RIGID_FORMATS: &str = "rf";
/// Interval at which a running program is looked at.
const POLL: Duration = Duration::from_millis(5);
/// Words of memory the program takes: the defaults of its own scripts.
const MEMORY: [(&str, &str); 2] = [("DBMEM", "12000000"), ("OCMEM", "2000000")];
/// Files that it asks for by variables.
const FILES: [(&str, &str); 5] = [
    ("LOGNM", "log"),
    ("NPTPNM", "nptp"),
    ("DICTNM", "dict"),
    ("PLTNM", "plt"),
    ("PUNCHNM", "punch"),
];
/// Fortran units that are given files; OUTPUT5 writes on 15.
const UNITS: std::ops::RangeInclusive<u32> = 11..=23;
const ANSWER: &str = "ftn15";
/// Files of a run that are looked at while it runs and read when it has ended.
const PRINTED: &str = "printed";
const ERRORS: &str = "errors";
/// Lines of a fatal message, and of the end of the output of a crashed run, that an error carries.
const MESSAGE_LINES: usize = 3;

/// Folder of the Python wheel `nastran95` when it is unpacked by the commands in `golden/nastran95/README.md`.
pub fn default_folder() -> PathBuf {
    let home = std::env::home_dir().unwrap_or_default();
    home.join(".cache/nastran95/nastran95/_data")
}

/// An installed NASTRAN-95.
#[derive(Debug, Clone)]
pub struct Nastran95 {
    home: PathBuf,
    /// Time after which a run counts as hanging and is stopped; the box takes half a second.
    pub time_limit: Duration,
    /// Bytes of a file of a run above which the run is stopped and nothing read; the box writes a few thousandths.
    pub output_limit: u64,
    /// Set from outside, for example by a signal, it stops the run and removes its files.
    pub stop: Arc<AtomicBool>,
}

/// The output of a run: what it printed, and what it wrote on Fortran unit 15, if anything.
#[derive(Debug)]
pub struct Answer {
    pub printed: String,
    pub unit_15: Option<String>,
}

impl Nastran95 {
    /// The program in a folder that holds `bin/nastrn` and `rf/`, the rigid formats.
    pub fn in_folder(folder: &Path) -> Outcome<Self> {
        // A relative path would mean another folder once the program runs in its scratch folder.
        let home = folder.canonicalize().unwrap_or_default();
        if !home.join(PROGRAM).is_file() || !home.join(RIGID_FORMATS).is_dir() {
            let folder = folder.display();
            return Err(format!(
                "NASTRAN-95: no folder with bin/nastrn and rf/ at {folder}; golden/nastran95/README.md says how to install it, \
                 or name its folder by the environment variable NASTRAN95"
            )
            .into());
        }
        Ok(Self {
            home,
            time_limit: Duration::from_secs(60),
            output_limit: 1 << 28,
            stop: Arc::default(),
        })
    }

    /// Runs a deck in a temporary folder, its owner's alone, that is removed however the run ends.
    pub fn run(&self, deck: &str) -> Outcome<Answer> {
        let mut builder = tempfile::Builder::new();
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o700));
        let scratch = builder.prefix("corfem-nastran95-").tempdir();
        let scratch = scratch.map_err(FileError::of_file(&std::env::temp_dir(), "write"))?;
        let answer = self.run_in(scratch.path(), deck);
        let failed = FileError::of_file(scratch.path(), "remove");
        let removed = scratch.close();
        // An error of the run matters more than one of tidying up.
        let answer = answer?;
        removed.map_err(failed)?;
        Ok(answer)
    }

    fn run_in(&self, scratch: &Path, deck: &str) -> Outcome<Answer> {
        let path = |name: &str| scratch.join(name);
        let create =
            |name: &str| File::create(path(name)).map_err(FileError::of_file(&path(name), "write"));
        fs::write(path("deck"), deck).map_err(FileError::of_file(&path("deck"), "write"))?;
        let input = File::open(path("deck")).map_err(FileError::of_file(&path("deck"), "read"))?;
        let program = self.home.join(PROGRAM);
        let mut command = Command::new(&program);
        command
            .current_dir(scratch)
            .stdin(Stdio::from(input))
            .stdout(Stdio::from(create(PRINTED)?))
            .stderr(Stdio::from(create(ERRORS)?))
            .envs(MEMORY)
            .env("RFDIR", self.home.join(RIGID_FORMATS))
            .env("DIRCTY", scratch)
            .env("OPTPNM", "none")
            .envs(FILES.map(|(variable, name)| (variable, path(name))))
            .envs((1..*UNITS.start()).map(|unit| (format!("SOF{unit}"), "none")))
            .envs(UNITS.map(|unit| (format!("FTN{unit}"), path(&format!("ftn{unit}")))));
        // The program and what it may start are stopped together.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let child = command.spawn();
        let child = child.map_err(FileError::of_file(&program, "run"))?;
        let status = self.wait(child, &program, scratch)?;
        let printed = self.read(&path(PRINTED))?.unwrap_or_default();
        if let Some(message) = fatal_message(&printed) {
            return Err(format!("NASTRAN-95 refused its input: {message}").into());
        }
        if !status.success() {
            let errors = self.read(&path(ERRORS))?.unwrap_or_default();
            let message = last_lines(&format!("{printed}\n{errors}"));
            return Err(format!("NASTRAN-95 ended with {status}: {message}").into());
        }
        let unit_15 = self.read(&path(ANSWER))?;
        Ok(Answer { printed, unit_15 })
    }

    /// Waits for the program, within its time limit, and kills whatever is left of it, so that nothing writes into the folder
    /// that is read and removed next.
    fn wait(&self, mut child: Child, program: &Path, scratch: &Path) -> Outcome<ExitStatus> {
        let ended = self.watch(&mut child, program, scratch);
        // Its children are in its group, whose number is not reused before the program is reaped.
        #[cfg(unix)]
        let _ = kill_process_group(Pid::from_child(&child), Signal::KILL);
        let _ = child.kill();
        let status = child.wait().map_err(FileError::of_file(program, "run"))?;
        ended.map(|()| status)
    }

    /// Returns when the program has ended, or an error when it is to be stopped.
    fn watch(&self, child: &mut Child, program: &Path, scratch: &Path) -> Outcome<()> {
        let start = Instant::now();
        while !has_ended(child).map_err(FileError::of_file(program, "run"))? {
            if self.stop.load(Ordering::Relaxed) {
                return Err("NASTRAN-95 was stopped by request".into());
            }
            if start.elapsed() >= self.time_limit {
                let limit = self.time_limit.as_secs_f64();
                return Err(format!(
                    "NASTRAN-95 was stopped: it was still running after {limit} s"
                )
                .into());
            }
            for name in [PRINTED, ERRORS, ANSWER] {
                let found = scratch.join(name).symlink_metadata();
                self.check_size(name, found.map_or(0, |found| found.len()))?;
            }
            std::thread::sleep(POLL);
        }
        Ok(())
    }

    /// A file's text, if it is there; bytes that are not UTF-8 are replaced.
    fn read(&self, path: &Path) -> Outcome<Option<String>> {
        // Only a regular file is opened, since opening a pipe would block. The program has ended and cannot swap it.
        let found = match path.symlink_metadata() {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            found => found.map_err(FileError::of_file(path, "read"))?,
        };
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if !found.is_file() {
            return Err(format!("NASTRAN-95: its {name} is not a regular file").into());
        }
        self.check_size(&name, found.len())?;
        let mut bytes = Vec::new();
        let read =
            File::open(path).and_then(|file| file.take(self.output_limit).read_to_end(&mut bytes));
        read.map_err(FileError::of_file(path, "read"))?;
        Ok(Some(String::from_utf8_lossy(&bytes).into_owned()))
    }

    fn check_size(&self, name: &str, bytes: u64) -> Outcome<()> {
        let most = self.output_limit;
        if bytes <= most {
            return Ok(());
        }
        Err(
            format!("NASTRAN-95: its file {name} has {bytes} bytes, more than the {most} allowed")
                .into(),
        )
    }
}

/// True if the program has ended. On Unix it is not reaped yet, so that its number is not given to another process.
fn has_ended(child: &mut Child) -> std::io::Result<bool> {
    #[cfg(unix)]
    let ended = waitid(
        WaitId::Pid(Pid::from_child(child)),
        WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT,
    );
    #[cfg(not(unix))]
    let ended = child.try_wait();
    Ok(ended?.is_some())
}

/// The first fatal message in NASTRAN's printed output, its lines joined.
fn fatal_message(printed: &str) -> Option<String> {
    let mut lines = printed.lines().skip_while(|line| !line.contains("FATAL"));
    let first = lines.next()?;
    // A message ends with a blank line, or where the next one begins.
    let rest = lines
        .take(MESSAGE_LINES - 1)
        .take_while(|line| !line.trim().is_empty() && !line.contains("***"));
    let lines = std::iter::once(first).chain(rest);
    let words: Vec<&str> = lines.flat_map(str::split_whitespace).collect();
    // The first column is the printer's carriage control.
    Some(shown(
        words.join(" ").trim_start_matches(['0', '1', '*', ' ']),
    ))
}

/// The last lines that are not blank.
fn last_lines(text: &str) -> String {
    let lines = text.lines().map(str::trim);
    let lines: Vec<&str> = lines.filter(|line| !line.is_empty()).collect();
    match &lines[lines.len().saturating_sub(MESSAGE_LINES)..] {
        [] => "nothing printed".to_owned(),
        last => shown(&last.join(" / ")),
    }
}
