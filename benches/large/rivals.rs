//! Other programs that do the same with the matrices that were written, each in a process of its own and in one thread.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A row of the file of costs, with its cell for one wing.
pub struct Cost {
    pub name: String,
    pub unit: String,
    pub value: String,
}

/// SuperLU is not measured on larger wings, for which it would take the better part of an hour.
const MOST_DOF_FOR_SUPERLU: usize = 200_000;

/// The programs that were asked for and can be started.
pub struct Rivals {
    python: Option<String>,
    has_pardiso: bool,
    cholmod: Option<PathBuf>,
}

impl Rivals {
    /// Looks for PARDISO in Python, and compiles what calls CHOLMOD into the folder.
    pub fn found(python: Option<String>, compiler: Option<String>, folder: &Path) -> Self {
        let has_pardiso = python.as_ref().is_some_and(|python| {
            let import = Command::new(python)
                .args(["-c", "import pypardiso"])
                .status();
            import.is_ok_and(|status| status.success())
        });
        let compile = |compiler| {
            std::fs::create_dir_all(folder).expect("the folder can be written");
            let program = folder.join("cholmod_wing");
            let status = Command::new(compiler)
                .args(["-O3", "-march=native", "-I/usr/include/suitesparse", "-o"])
                .arg(&program)
                .arg("benches/cholmod_wing.c")
                .args(["-lcholmod", "-larpack", "-lopenblas", "-lm"])
                .status();
            let is_compiled = status.expect("the C compiler starts").success();
            assert!(
                is_compiled,
                "CHOLMOD, ARPACK and OpenBLAS are needed, with their headers"
            );
            program
        };
        Self {
            python,
            has_pardiso,
            cholmod: compiler.map(compile),
        }
    }

    /// What they measure of the wing in a folder, as rows of the file of costs.
    pub fn measured(&self, folder: &Path, dof: usize) -> Vec<Cost> {
        let mut commands = Vec::new();
        if let Some(python) = &self.python {
            let script = || {
                let mut command = Command::new(python);
                command.arg("benches/scipy_wing.py");
                command
            };
            if dof <= MOST_DOF_FOR_SUPERLU {
                commands.push(script());
            }
            if self.has_pardiso {
                let mut command = script();
                command.arg("--pardiso");
                commands.push(command);
            }
        }
        commands.extend(self.cholmod.as_ref().map(Command::new));
        commands
            .into_iter()
            .flat_map(|mut command| rows(command.arg(folder)))
            .collect()
    }
}

/// What a program prints, of which every line is a row.
fn rows(command: &mut Command) -> Vec<Cost> {
    let output = command
        .envs(
            [
                "OMP_THREAD_LIMIT",
                "OMP_NUM_THREADS",
                "OPENBLAS_NUM_THREADS",
                "MKL_NUM_THREADS",
            ]
            .map(|name| (name, "1")),
        )
        .stderr(Stdio::inherit())
        .output()
        .expect("it starts");
    assert!(output.status.success(), "{command:?} fails");
    let text = String::from_utf8(output.stdout).expect("text");
    print!("{text}");
    let row = |line: &str| {
        let mut cells = line.split(',').map(str::to_owned);
        let mut next = || cells.next().expect("a row of three cells");
        let (name, unit, value) = (next(), next(), next());
        Cost { name, unit, value }
    };
    text.lines().map(row).collect()
}
