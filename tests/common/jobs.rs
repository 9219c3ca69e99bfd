//! The worked jobs of `tests/jobs`, made anew: what they were made of is known here, and only here.

use crate::prelude::*;
use corfem::job::LoadedJob;

/// Stiffness of every story of the real building over that of the model, from the ground up.
pub const STORIES: [f64; 10] = [0.70, 1.0, 1.2, 0.9, 1.0, 0.8, 1.1, 1.0, 0.85, 1.0];
/// Stiffness of a story of the model, lbf/in, and the mass of a floor, lbf·s²/in.
const STORY: f64 = 1.0e5;
const FLOOR: f64 = 60.0;
/// Seed of the noise on the box's modes.
const SEED: u64 = 4;

/// Names and texts of the files of a job.
pub type Files = Vec<(String, String)>;

fn task() -> Task {
    Task::Modes {
        count: 9,
        range_hz: [1.0, 10_000.0],
    }
}

fn test_data(modes: &Modes, sensors: Vec<Sensor>) -> TestData {
    let mut shapes = modes.shapes().clone();
    // As a test has them: of unit largest component.
    shapes
        .column_iter_mut()
        .for_each(|mut shape| shape /= shape.amax());
    TestData {
        frequencies_hz: modes.frequencies_hz(),
        sensors,
        shapes,
        ..TestData::default()
    }
}

fn sensor(name: String, grid: usize, direction: usize, place: Option<Vector3<f64>>) -> Sensor {
    Sensor {
        name,
        grid: Some(grid),
        direction,
        axis: None,
        place,
    }
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

/// The files of a job of `tests/jobs`.
pub fn files_of(name: &str) -> Files {
    let entries = fs::read_dir(folder_of(name)).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    let text = |path: PathBuf| {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        (name, fs::read_to_string(path).unwrap())
    };
    paths.map(text).collect()
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

/// The paper's box of Case 2 from its deck, and its nine modes with noise.
pub fn torque_box() -> Files {
    let case = Case::new(2).unwrap();
    let model = case.model().unwrap();
    let points = dynamic_points(&case.reconstruction).unwrap();
    let ones = vec![1.0; model.parameters().len()];
    let bulk = BulkData::from_model(&model, &ones, &points).unwrap();
    let grids = bulk.ties.iter().map(|tie| tie.dependent.grid).collect_vec();
    let noisy = with_noise(&case.test_modes().unwrap(), Noise::USUAL, SEED).unwrap();
    let sensors = grids
        .iter()
        .zip(&points)
        .enumerate()
        .map(|(row, (&grid, &place))| sensor(format!("D{}", row + 1), grid, 2, Some(place)));
    let mut data = test_data(&noisy, sensors.collect());
    data.frequency_deviation = Some(vec![Noise::USUAL.frequency; noisy.len()]);
    data.shape_deviation = Some(vec![Noise::USUAL.shape; noisy.len()]);
    let ranges = model.factor_ranges().unwrap();
    let mut job = "title = \"torque box\"\n\n[model]\ndeck = \"model.bdf\"\n\n[test]\nfile = \"test.csv\"\n\n\
                   [compare]\nmethod = \"gauss_newton\"\n"
        .to_owned();
    for (parameter, range) in model.parameters().iter().zip(ranges) {
        let range = range.map_or_else(String::new, |range| {
            format!("lower = {}\nupper = {}\n", range.lower, range.upper)
        });
        job += &format!(
            "\n[[parameter]]\nname = \"panel {0}\"\nelements = [{0}]\n{range}",
            parameter.name
        );
    }
    let deck = deck::write(&bulk, "torque box", &task()).unwrap();
    vec![
        ("job.toml".to_owned(), job),
        ("model.bdf".to_owned(), deck),
        ("test.csv".to_owned(), write_csv(&data)),
    ]
}

/// True gages of the box over those of its deck, panel by panel.
pub fn torque_box_truth() -> Vec<f64> {
    Case::new(2)
        .unwrap()
        .first_gages()
        .iter()
        .map(|gage| TEST_GAGE / gage)
        .collect()
}

/// Ten stories as Matrix Market files, five of them with a sensor.
pub fn building() -> Files {
    let model = shear_building(&[STORY; 10], FLOOR, None);
    let real = shear_building(&STORIES.map(|factor| factor * STORY), FLOOR, None);
    let measured = [1, 3, 5, 7, 9];
    let sensors = sensors_at(&measured, 10);
    let modes = real.modes(&[1.0; 10], 5).unwrap().vibrations;
    let seen = seen_by(&sensors, &modes);
    let places =
        measured.map(|row| sensor(format!("floor {}", row + 1), row + 1, 0, Some(floor(row))));
    let mut job = "title = \"ten-story building\"\n\n[model]\nstiffness = \"stiffness.mtx\"\nmass = \"mass.mtx\"\n\
                   rows = \"rows.csv\"\n\n[test]\nfile = \"test.csv\"\n\n[compare]\nanalysis_modes = 10\n"
        .to_owned();
    let (stiffness, mass) = model.at(&[1.0; 10]).unwrap();
    let rows = (0..10)
        .map(|row| format!("{},x,0.,0.,{}\n", row + 1, floor(row).z))
        .collect::<String>();
    let mut files = vec![
        ("stiffness.mtx".to_owned(), write_matrix_market(&stiffness)),
        ("mass.mtx".to_owned(), write_matrix_market(&mass)),
        (
            "rows.csv".to_owned(),
            format!("grid,direction,x,y,z\n{rows}"),
        ),
        (
            "test.csv".to_owned(),
            write_csv(&test_data(&seen, places.to_vec())),
        ),
    ];
    for (number, parameter) in (1..).zip(model.parameters()) {
        let file = format!("story_{number}.mtx");
        job += &format!(
            "\n[[parameter]]\nname = \"{}\"\nmatrix = \"{file}\"\n",
            parameter.name
        );
        let WholeShare::Stiffness(share) = &parameter.share else {
            unreachable!("stories are stiffness")
        };
        files.push((file, write_matrix_market(share)));
    }
    files.push(("job.toml".to_owned(), job));
    files
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
    let sensors = sensors
        .iter()
        .map(|row| sensor(format!("{}", row + 1), row + 1, 0, Some(floor(*row))));
    let mut data = test_data(&seen, sensors.collect());
    data.frequency_deviation = Some(vec![noise.frequency; modes]);
    data.shape_deviation = Some(vec![noise.shape; modes]);
    let (stiffness, mass) = model.at(&vec![1.0; truth.len()]).unwrap();
    let rows = (0..count).map(|row| format!("{},x,0.,0.,{}\n", row + 1, floor(row).z));
    let mut job = "[model]\nstiffness = \"stiffness.mtx\"\nmass = \"mass.mtx\"\nrows = \"rows.csv\"\n[test]\n\
                   file = \"test.csv\"\n"
        .to_owned();
    let mut files = vec![
        ("stiffness.mtx".to_owned(), write_matrix_market(&stiffness)),
        ("mass.mtx".to_owned(), write_matrix_market(&mass)),
        ("rows.csv".to_owned(), rows.collect()),
        ("test.csv".to_owned(), write_csv(&data)),
    ];
    for (number, parameter) in (1..).zip(model.parameters()) {
        let (scales, matrix) = match &parameter.share {
            WholeShare::Stiffness(matrix) => ("stiffness", matrix),
            WholeShare::Mass(matrix) => ("mass", matrix),
        };
        let file = format!("part_{number}.mtx");
        job += &format!(
            "[[parameter]]\nname = \"{}\"\nmatrix = \"{file}\"\nscales = \"{scales}\"\n",
            parameter.name
        );
        files.push((file, write_matrix_market(matrix)));
    }
    files.push(("job.toml".to_owned(), job));
    files
}

/// A structure of one matrix a parameter, p1, p2 …, with a sensor at every row and some modes as its test.
pub fn of_matrices(parts: &[DMatrix<f64>], mass: &DMatrix<f64>, modes: &Modes) -> Files {
    let text = |matrix: &DMatrix<f64>| {
        write_matrix_market(&SparseMatrix::of_dense("matrix", matrix).unwrap())
    };
    let rows = 1..=mass.nrows();
    let sensors = rows
        .clone()
        .map(|row| sensor(format!("S{row}"), row, 0, None));
    let listed: String = rows.map(|row| format!("{row},x\n")).collect();
    let mut files = vec![
        ("stiffness.mtx".to_owned(), text(&parts.iter().sum())),
        ("mass.mtx".to_owned(), text(mass)),
        ("rows.csv".to_owned(), format!("grid,direction\n{listed}")),
        (
            "test.csv".to_owned(),
            write_csv(&test_data(modes, sensors.collect())),
        ),
    ];
    let mut job = "[model]\nstiffness = \"stiffness.mtx\"\nmass = \"mass.mtx\"\nrows = \"rows.csv\"\n[test]\nfile = \"test.csv\"\n"
        .to_owned();
    for (number, part) in (1..).zip(parts) {
        job += &format!("[[parameter]]\nname = \"p{number}\"\nmatrix = \"p{number}.mtx\"\n");
        files.push((format!("p{number}.mtx"), text(part)));
    }
    files.push(("job.toml".to_owned(), job));
    files
}

/// Where a floor of the building is: ten feet above the one below.
fn floor(row: usize) -> Vector3<f64> {
    Vector3::new(0.0, 0.0, 120.0 * (row + 1) as f64)
}

/// The delta wing with wrong gages, and the ten lowest modes of its right half as a Universal File.
pub fn delta_wing() -> Files {
    let wing = DeltaWing::embedded();
    let model = first_model(&wing).unwrap();
    let whole = wing.modes().unwrap();
    let lowest = whole.modes.lowest(10).unwrap();
    let grids = measured_grids(model.structure());
    let row = |grid: &usize| {
        whole
            .dof
            .iter()
            .position(|dof| dof.grid == *grid && dof.direction == 2)
            .unwrap()
    };
    let rows = grids.iter().map(row).collect_vec();
    let modes = Modes::new(
        lowest.omega_squared().clone(),
        lowest.shapes().select_rows(&rows),
    )
    .unwrap();
    let place = |grid: &usize| {
        model
            .structure()
            .grids()
            .iter()
            .find(|own| own.label == *grid)
            .map(|own| own.position)
    };
    // The test counts its nodes in its own way; they are found by their places.
    let sensors = grids
        .iter()
        .zip(501..)
        .map(|(grid, node)| sensor(format!("{node} z"), node, 2, place(grid)));
    let data = test_data(&modes, sensors.collect());
    let mut job = "title = \"delta wing\"\n\n[model]\ndeck = \"model.bdf\"\n\n[test]\nfile = \"test.unv\"\n\n\
                   [sensors]\nby = \"nearest\"\ndistance = 0.01\n\n[compare]\nanalysis_modes = 25\n\
                   method = \"gauss_newton\"\nfrequency_deviation = 0.001\nshape_deviation = 0.005\n"
        .to_owned();
    for parameter in model.parameters() {
        let list = parameter
            .elements
            .iter()
            .map(usize::to_string)
            .collect_vec();
        job += &format!(
            "\n[[parameter]]\nname = \"{}\"\nelements = [{}]\n",
            parameter.name,
            list.join(", ")
        );
    }
    let deck = deck::write(
        &BulkData::from_structure(model.structure()),
        "delta wing",
        &task(),
    )
    .unwrap();
    vec![
        ("job.toml".to_owned(), job),
        ("model.bdf".to_owned(), deck),
        ("test.unv".to_owned(), write_universal(&data)),
    ]
}

/// Three rods in a row between a wall and masses of one, as a deck, with the three modes of rods of other areas: a job of few
/// lines, every part of which a test may replace. Rod 1 has property and material 1, rods 2 and 3 have property and material 2;
/// point mass `1k` is at grid k.
pub fn rods() -> Files {
    let real = shear_building(&[0.8e4, 1.1e4, 1.0e4], 1.0, None);
    let modes = real.modes(&[1.0; 3], 3).unwrap().vibrations;
    let place = |grid: usize| Vector3::new(10.0 * (grid - 1) as f64, 0.0, 0.0);
    let sensors = (2..=4).map(|grid| sensor(format!("S{grid}"), grid, 0, Some(place(grid))));
    let deck = "GRID,1,,0.,0.,0.,,123456\nGRID,2,,10.,0.,0.,,23456\nGRID,3,,20.,0.,0.,,23456\nGRID,4,,30.,0.,0.,,23456\n\
                CROD,1,1,1,2\nCROD,2,2,2,3\nCROD,3,2,3,4\nPROD,1,1,.1\nPROD,2,2,.1\nMAT1,1,1.+6,,.3\nMAT1,2,1.+6,,.3\n\
                CMASS2,12,1.,2,1\nCMASS2,13,1.,3,1\nCMASS2,14,1.,4,1\n";
    let job = "[model]\ndeck = \"model.bdf\"\n[test]\nfile = \"test.csv\"\n[sensors]\n[compare]\nmethod = \"gauss_newton\"\n\
               [[parameter]]\nname = \"a\"\nelements = [1]\n[[parameter]]\nname = \"b\"\nelements = [\"2-3\"]\n";
    let data = test_data(&modes, sensors.collect());
    let files = [
        ("job.toml", job.to_owned()),
        ("model.bdf", deck.to_owned()),
        ("test.csv", write_csv(&data)),
    ];
    files.map(|(name, text)| (name.to_owned(), text)).to_vec()
}

/// A job in a folder of its own.
pub fn placed(files: &Files) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    files
        .iter()
        .for_each(|(name, text)| fs::write(folder.path().join(name), text).expect("written"));
    let path = folder.path().join("job.toml");
    (folder, path)
}

/// The files with one text replaced by another in one of them.
pub fn with(mut files: Files, file: &str, old: &str, new: &str) -> Files {
    let text = &mut files
        .iter_mut()
        .find(|(name, _)| name == file)
        .expect("a file")
        .1;
    assert!(text.contains(old), "{old} is not in {text}");
    *text = text.replacen(old, new, 1);
    files
}

/// A job with another test.
pub fn retested(mut files: Files, edit: impl FnOnce(&mut TestData)) -> Files {
    let test = files.iter_mut().find(|(name, _)| name == "test.csv");
    let text = &mut test.expect("a test").1;
    let mut data = test_data::read("test.csv", text.as_bytes()).expect("a test");
    edit(&mut data);
    *text = write_csv(&data);
    files
}

/// A job that names its prior's deviation, and its rigid bodies where there are any.
pub fn supposing(files: Files, prior: f64, rigid: usize) -> Files {
    let compare = format!("[compare]\nprior_deviation = {prior:?}\n[[parameter]]");
    let files = with(files, "job.toml", "[[parameter]]", &compare);
    match rigid {
        0 => files,
        count => {
            let test = format!("rigid_bodies = {count}\n[test]");
            with(files, "job.toml", "[test]", &test)
        }
    }
}

/// What is said of a job, without its folder.
pub fn said(files: &Files) -> String {
    let (folder, path) = placed(files);
    let error = prepare(&path)
        .and_then(|prepared| run(&prepared, |_| {}, || true))
        .map(drop);
    let error = error.expect_err("a mistake").to_string();
    error.replace(&format!("{}/", folder.path().display()), "")
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
    let found = model.modes(&ones, modes).expect("modes").vibrations;
    let sensors = (1..=stories).map(|floor| Sensor {
        name: floor.to_string(),
        grid: Some(floor),
        direction: 0,
        axis: None,
        place: None,
    });
    let frequencies_hz = found.frequencies_hz();
    let data = TestData {
        frequencies_hz,
        sensors: sensors.collect(),
        shapes: found.shapes().clone(),
        ..TestData::default()
    };
    let (stiffness, mass) = model.at(&ones).expect("matrices");
    let job = "[model]\nstiffness = \"stiffness.mtx\"\nmass = \"mass.mtx\"\nrows = \"rows.csv\"\n[test]\nfile = \"test.csv\"\n\
               [[parameter]]\nname = \"all\"\nmatrix = \"stiffness.mtx\"\n";
    let files = [
        ("job.toml", job.to_owned()),
        ("stiffness.mtx", write_matrix_market(&stiffness)),
        ("mass.mtx", write_matrix_market(&mass)),
        (
            "rows.csv",
            (1..=stories).map(|floor| format!("{floor},x\n")).collect(),
        ),
        ("test.csv", write_csv(&data)),
    ];
    files.map(|(name, text)| (name.to_owned(), text)).to_vec()
}

/// A folder of its own, which goes with it.
pub fn new_folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

/// What is known of a job before the first step.
pub fn trust_in(job: &PreparedJob) -> Trust {
    Trust::before(job).unwrap()
}

/// What comes of a job that nobody stops.
pub fn finished(job: &PreparedJob) -> JobResult {
    run(job, |_| {}, || true).unwrap()
}
