//! The worked jobs of `tests/jobs`, what is known of them, and jobs of matrices.

use crate::prelude::*;
use corfem::job::{CorrelatedJob, LoadedJob};

/// Stiffness of every story of the real building over that of the model, from the ground up.
pub const STORIES: [f64; 10] = [0.70, 1.0, 1.2, 0.9, 1.0, 0.8, 1.1, 1.0, 0.85, 1.0];

/// Names and texts of the files of a job.
pub type Files = Vec<(String, String)>;

/// Modes as a test has them: of unit largest component.
pub fn test_data(modes: &Modes, sensors: impl Iterator<Item = Sensor>) -> TestData {
    let mut shapes = modes.shapes().clone();
    shapes
        .column_iter_mut()
        .for_each(|mut shape| shape /= shape.amax());
    TestData {
        frequencies_hz: modes.frequencies_hz(),
        sensors: sensors.collect(),
        shapes,
        ..TestData::default()
    }
}

/// A sensor at a grid.
pub fn sensor(name: String, grid: usize, direction: usize, place: Option<Vector3<f64>>) -> Sensor {
    Sensor {
        name,
        grid: Some(grid),
        direction,
        axis: None,
        place,
    }
}

/// The test of modes at some rows with a sensor each, called by S and the row.
pub fn measured_at(modes: &Modes, rows: &[usize]) -> TestData {
    let sensors = rows.iter();
    let sensors = sensors.map(|row| sensor(format!("S{row}"), row + 1, 0, None));
    let shapes = modes.shapes().select_rows(rows);
    let seen = Modes::new(modes.omega_squared().clone(), shapes);
    test_data(&seen.unwrap(), sensors)
}

/// A folder of `tests/jobs`.
pub fn folder_of(name: &str) -> PathBuf {
    in_root("tests/jobs").join(name)
}

/// A job read, with its first analysis and its pairs.
pub fn prepare(path: &Path) -> Result<PreparedJob, FileError> {
    LoadedJob::new(path)?.prepare()
}

/// What comes of a job, after a look at what is doubtful of it.
pub fn run(
    prepared: &PreparedJob,
    progress: impl FnMut(&str),
    go_on: impl Fn() -> bool,
) -> Result<JobResult, FileError> {
    corfem::job::run(prepared, &Trust::before(prepared)?, progress, go_on)
}

/// The files of a job of `tests/jobs`, by their names.
pub fn files_of(name: &str) -> Files {
    files_in(&folder_of(name))
}

/// The files of a folder, by their names.
pub fn files_in(folder: &Path) -> Files {
    let entries = fs::read_dir(folder).unwrap();
    let texts = entries.map(|entry| {
        let entry = entry.unwrap();
        let text = fs::read_to_string(entry.path()).unwrap();
        (entry.file_name().into_string().unwrap(), text)
    });
    texts.collect::<BTreeMap<_, _>>().into_iter().collect()
}

/// Three rods in a row between a wall and masses of one, as a deck, with the three modes of rods of 0.8, 1.1 and 1 of its areas: a job
/// of few lines, every part of which a test may replace. Rod 1 has property and material 1, rods 2 and 3 have property and material 2;
/// point mass `1k` is at grid k.
pub fn rods() -> Files {
    files_of("rods")
}

/// Ten stories as Matrix Market files, five of them with a sensor.
pub fn building() -> Files {
    files_of("building")
}

/// A job of `tests/jobs`.
pub fn loaded(name: &str) -> PreparedJob {
    let loaded = prepare(&folder_of(name).join("job.toml"));
    loaded.unwrap()
}

/// What comes of a job of `tests/jobs`, each run once for all tests.
pub fn worked(name: &str) -> &'static JobResult {
    static RUNS: [(&str, OnceLock<JobResult>); 5] = [
        ("box", OnceLock::new()),
        ("building", OnceLock::new()),
        ("garteur", OnceLock::new()),
        ("garteur_joints", OnceLock::new()),
        ("wing", OnceLock::new()),
    ];
    let (_, result) = RUNS.iter().find(|(of, _)| *of == name).unwrap();
    result.get_or_init(|| run(&loaded(name), |_| {}, || true).unwrap())
}

/// The paper's box of Case 2 as a deck, and its nine modes with noise.
pub fn torque_box() -> Files {
    files_of("box")
}

/// True gages of the box over those of its deck, panel by panel.
pub fn torque_box_truth() -> Vec<f64> {
    let gages = case_of(2).first_gages();
    gages.iter().map(|gage| TEST_GAGE / gage).collect()
}

/// Where a floor of a building is: ten feet above the one below.
fn floor(row: usize) -> Vector3<f64> {
    Vector3::new(0.0, 0.0, 120.0 * (row + 1) as f64)
}

/// A job of matrices without parameters, with a line for each of their rows, and its test.
pub fn matrix_job(
    [stiffness, mass]: [&SparseMatrix; 2],
    rows: impl Iterator<Item = String>,
    data: &TestData,
) -> Files {
    let job = "[model]\nstiffness = \"stiffness.mtx\"\nmass = \"mass.mtx\"\nrows = \"rows.csv\"\n[test]\nfile = \"test.csv\"\n";
    let files = [
        ("job.toml", job.to_owned()),
        ("stiffness.mtx", write_matrix_market(stiffness)),
        ("mass.mtx", write_matrix_market(mass)),
        ("rows.csv", rows.collect()),
        ("test.csv", write_csv(data)),
    ];
    files.map(|(name, text)| (name.to_owned(), text)).to_vec()
}

/// Adds a parameter with a matrix of its own to a job, and further lines of it.
pub fn add_parameter(files: &mut Files, name: &str, matrix: &SparseMatrix, lines: &str) {
    let file = format!("{name}.mtx");
    files[0].1 += &format!("[[parameter]]\nname = \"{name}\"\nmatrix = \"{file}\"\n{lines}");
    files.push((file, write_matrix_market(matrix)));
}

/// A model of springs and masses as matrices, and the lowest modes of the right one, as `sensors` at some of its rows see them, with
/// deviations of `noise`.
pub fn of_whole(
    model: &WholeModel,
    truth: &[f64],
    sensors: &[usize],
    modes: usize,
    noise: Noise,
) -> Files {
    let count = model.dof_count();
    let real = model.modes(truth, modes).unwrap().vibrations;
    let seen = seen_by(&sensors_at(sensors, count), &real);
    let sensors = sensors.iter();
    let sensors = sensors.map(|row| sensor(format!("{}", row + 1), row + 1, 0, Some(floor(*row))));
    let data = TestData {
        frequency_deviation: Some(vec![noise.frequency; modes]),
        shape_deviation: Some(vec![noise.shape; modes]),
        ..test_data(&seen, sensors)
    };
    let (stiffness, mass) = model.at(&vec![1.0; truth.len()]).unwrap();
    let rows = (0..count).map(|row| format!("{},x,0.,0.,{}\n", row + 1, floor(row).z));
    let mut files = matrix_job([&stiffness, &mass], rows, &data);
    for parameter in model.parameters() {
        let (lines, matrix) = match &parameter.share {
            WholeShare::Stiffness(matrix) => ("", matrix),
            WholeShare::Mass(matrix) => ("scales = \"mass\"\n", matrix),
        };
        add_parameter(&mut files, &parameter.name, matrix, lines);
    }
    files
}

/// A structure whose parts, p1, p2 …, are parameters, with a sensor at every row and some modes as its test.
pub fn of_parts(
    stiffness: &DMatrix<f64>,
    parts: &[DMatrix<f64>],
    mass: &DMatrix<f64>,
    modes: &Modes,
) -> Files {
    let [stiffness, mass] = [stiffness, mass].map(|matrix| sparse(matrix).unwrap());
    let rows = 1..=mass.rows();
    let sensors = rows
        .clone()
        .map(|row| sensor(format!("S{row}"), row, 0, None));
    let data = test_data(modes, sensors);
    let mut files = matrix_job(
        [&stiffness, &mass],
        rows.map(|row| format!("{row},x\n")),
        &data,
    );
    for (number, part) in (1..).zip(parts) {
        add_parameter(
            &mut files,
            &format!("p{number}"),
            &sparse(part).unwrap(),
            "",
        );
    }
    files
}

/// The same of a structure that is the sum of its parts.
pub fn of_matrices(parts: &[DMatrix<f64>], mass: &DMatrix<f64>, modes: &Modes) -> Files {
    of_parts(&parts.iter().sum(), parts, mass, modes)
}

/// A job in a folder of its own.
pub fn placed(files: &Files) -> (TempDir, PathBuf) {
    let folder = new_folder();
    for (name, text) in files {
        fs::write(folder.path().join(name), text).unwrap();
    }
    let path = folder.path().join("job.toml");
    (folder, path)
}

/// One of some files.
pub fn file<'a>(files: &'a mut Files, name: &str) -> &'a mut String {
    let found = files.iter_mut().find(|(of, _)| of == name);
    &mut found.unwrap().1
}

/// The files with one text replaced by another in one of them.
pub fn with(mut files: Files, name: &str, old: &str, new: &str) -> Files {
    let text = file(&mut files, name);
    assert!(text.contains(old), "{old} is not in {text}");
    *text = text.replacen(old, new, 1);
    files
}

/// The files with further entries of `[compare]`.
pub fn comparing(mut files: Files, entries: &str) -> Files {
    match file(&mut files, "job.toml").contains("[compare]") {
        true => with(
            files,
            "job.toml",
            "[compare]",
            &format!("[compare]\n{entries}"),
        ),
        false => with(
            files,
            "job.toml",
            "[[parameter]]",
            &format!("[compare]\n{entries}\n[[parameter]]"),
        ),
    }
}

/// A job with another test.
pub fn retested(mut files: Files, edit: impl FnOnce(&mut TestData)) -> Files {
    let text = file(&mut files, "test.csv");
    let mut data = test_data::read("test.csv", text.as_bytes()).unwrap();
    edit(&mut data);
    *text = write_csv(&data);
    files
}

/// A job that names its prior's deviation, and its rigid bodies where there are any.
pub fn supposing(files: Files, prior: f64, rigid: usize) -> Files {
    let files = comparing(files, &format!("prior_deviation = {prior:?}"));
    match rigid {
        0 => files,
        count => with(
            files,
            "job.toml",
            "[test]",
            &format!("rigid_bodies = {count}\n[test]"),
        ),
    }
}

/// Text without the breaks of lines.
pub fn unbroken(text: &str) -> String {
    text.split_whitespace().collect_vec().join(" ")
}

/// What is said of a job, without its folder.
pub fn said(files: &Files) -> String {
    let (folder, path) = placed(files);
    let found = prepare(&path).and_then(|prepared| run(&prepared, |_| {}, || true));
    found
        .err()
        .unwrap()
        .to_string()
        .replace(&format!("{}/", folder.path().display()), "")
}

/// A job that has no mistake, ready to run.
pub fn prepared(files: &Files) -> PreparedJob {
    let (_folder, path) = placed(files);
    prepare(&path).unwrap()
}

/// A building whose stories are scaled as one, with its lowest modes measured at every floor.
pub fn measured_building(stories: usize, modes: usize) -> Files {
    let model = shear_building(&vec![1e5; stories], 60.0, None);
    let ones = vec![1.0; stories];
    let found = model.modes(&ones, modes).unwrap().vibrations;
    let floors = 1..=stories;
    let sensors = floors
        .clone()
        .map(|floor| sensor(floor.to_string(), floor, 0, None));
    let (stiffness, mass) = model.at(&ones).unwrap();
    let rows = floors.map(|floor| format!("{floor},x\n"));
    let mut files = matrix_job([&stiffness, &mass], rows, &test_data(&found, sensors));
    files[0].1 += "[[parameter]]\nname = \"all\"\nmatrix = \"stiffness.mtx\"\n";
    files
}

/// A building of ten stories, and its test after an edit.
pub fn tested(edit: impl FnOnce(&mut TestData)) -> Files {
    retested(measured_building(10, 4), edit)
}

/// Masses in a row on springs between them, held nowhere.
pub fn free_masses() -> Files {
    let links = (1..6).map(|row| (row, Some(row - 1), 1e5)).collect_vec();
    let (stiffness, mass) = (springs(6, &links).dense(), masses(&[3.0; 6]).dense());
    let all = solve(&(&stiffness + 1e-3 * &mass), &mass, 6).unwrap();
    let three = all.omega_squared().rows(1, 3).into_owned();
    let modes = Modes::new(three, all.shapes().columns(1, 3).into_owned()).unwrap();
    of_matrices(&[stiffness], &mass, &modes)
}

/// A building of ten stories whose test is a Universal File.
pub fn in_universal() -> Files {
    let mut files = with(tested(|_| {}), "job.toml", "test.csv", "test.unv");
    let (name, text) = files.last_mut().unwrap();
    let data = test_data::read("test.csv", text.as_bytes()).unwrap();
    (*name, *text) = ("test.unv".to_owned(), write_universal(&data));
    files
}

/// A folder of its own, which goes with it.
pub fn new_folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

/// What is known of a job before the first step.
pub fn trust_in(job: &PreparedJob) -> Trust {
    Trust::before(job).unwrap()
}

/// The number of a model's rigid-body modes.
pub fn rigid_bodies(job: &PreparedJob) -> usize {
    job.loaded.source.whole.rigid_bodies().unwrap().rigid()
}

/// Names of what a concern is about, none where nobody says it.
pub fn about(trust: &Trust, identifier: &str) -> Vec<String> {
    let mut all = trust.all().iter();
    let found = all.find(|own| own.identifier == identifier);
    found.map_or_else(Vec::new, |own| own.about.clone())
}

/// What comes of a job that nobody stops.
pub fn finished(job: &PreparedJob) -> JobResult {
    run(job, |_| {}, || true).unwrap()
}

/// The job of the rods with one text of it replaced.
pub fn rods_with(old: &str, new: &str) -> Files {
    with(rods(), "job.toml", old, new)
}

/// The report on what came of a job.
pub fn report_of(found: &JobResult) -> Report {
    Report::new(found, "corfem correlate job.toml").unwrap()
}

/// Exact analyses of the weighted steps that found the factors, the first among them.
pub fn analyses(found: &CorrelatedJob) -> usize {
    let History::GaussNewton(Some(steps)) = &found.history else {
        panic!("by weighted steps")
    };
    steps.best.analyses
}
