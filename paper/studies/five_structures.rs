//! Corrections of structures that are not shipped, a portal, a girder, a free truss, a plate as matrices, a cyclic disk and two larger
//! ones, by right tests, and of three of them where the model is wrong in a way that no factor undoes.

use crate::common::jobs::of_whole;
use crate::prelude::*;
use corfem::job::{LoadedJob, run};
use corfem::sparse::random::uniform;

/// Standard deviation of the logarithm of the true factors.
const MODEL: f64 = 0.15;

/// Matrices of the parameters, the mass of every row, and the rows that sensors read.
pub type Built = (Vec<DMatrix<f64>>, Vec<f64>, Vec<usize>);

/// What makes a real structure and the model of it, in this order, differ in more than factors.
pub type Wrong = fn(&mut Built, &mut Built);

/// A right model and three wrong ones by name: 8 % of the mass of half of the rows is missing, the last part is no parameter, or the sensor
/// in the middle of the list really is where the next one is.
pub const WRONG: [(&str, Wrong); 4] = [
    ("right", |_, _| ()),
    ("missing mass", |_, (_, mass, _)| {
        let half = mass.len() / 2;
        mass[..half].iter_mut().for_each(|own| *own *= 0.92);
    }),
    ("missing parameter", |_, (parts, ..)| {
        parts.pop();
    }),
    ("sensor beside its grid", |(.., sensors), _| {
        let middle = sensors.len() / 2;
        sensors[middle] = sensors[middle + 1];
    }),
];

/// A structure by name.
pub struct Structure {
    /// Its name.
    pub name: &'static str,
    /// Number of its motions as a rigid body.
    rigid: usize,
    /// Number of test modes.
    modes: usize,
    /// Number of right tests of a study of its corrections.
    pub tests: usize,
    /// What builds it.
    build: fn() -> Built,
}

/// Place of the tower.
pub const TOWER: usize = 6;

/// The five structures, then one of 660 degrees of freedom and one of 32 parameters.
pub const STRUCTURES: [Structure; 7] = [
    held("portal", portal),
    held("girder", girder),
    Structure {
        rigid: 3,
        ..held("free truss", free_truss)
    },
    held("plate", || plate(5, 7, 1, 2)),
    held("cyclic disk", disk),
    Structure {
        tests: 100,
        ..held("fine plate", || plate(22, 30, 4, 7))
    },
    Structure {
        modes: 10,
        tests: 40,
        ..held("tower", tower)
    },
];

/// A structure that is held, with five test modes and three hundred tests.
const fn held(name: &'static str, build: fn() -> Built) -> Structure {
    Structure {
        name,
        rigid: 0,
        modes: 5,
        tests: 300,
        build,
    }
}

/// Bending stiffness of a beam of a length, at the deflections and rotations of its ends.
fn bending(length: f64, stiffness: f64) -> DMatrix<f64> {
    let (l, c) = (length, stiffness / length.powi(3));
    let rows = [
        [12.0, 6.0 * l, -12.0, 6.0 * l],
        [6.0 * l, 4.0 * l * l, -6.0 * l, 2.0 * l * l],
        [-12.0, -6.0 * l, 12.0, -6.0 * l],
        [6.0 * l, 2.0 * l * l, -6.0 * l, 4.0 * l * l],
    ];
    DMatrix::from_fn(4, 4, |row, column| c * rows[row][column])
}

/// A plane frame of points and members, each of a parameter, without the rows that are held.
fn frame(
    points: &[[f64; 2]],
    members: &[(usize, usize, usize)],
    parameters: usize,
    held: &[usize],
) -> (Vec<DMatrix<f64>>, Vec<f64>, Vec<usize>) {
    let rows = 3 * points.len();
    let (mut parts, mut mass) = (
        vec![DMatrix::zeros(rows, rows); parameters],
        vec![0.0; rows],
    );
    for &(a, b, parameter) in members {
        let along = [points[b][0] - points[a][0], points[b][1] - points[a][1]];
        let length = along[0].hypot(along[1]);
        let (c, s) = (along[0] / length, along[1] / length);
        let mut own = DMatrix::zeros(6, 6);
        let across = bending(length, 2e7);
        for (i, row) in [1, 2, 4, 5].into_iter().enumerate() {
            for (j, column) in [1, 2, 4, 5].into_iter().enumerate() {
                own[(row, column)] = across[(i, j)];
            }
        }
        let axial = 3e9 / length;
        for (row, column, sign) in [(0, 0, 1.0), (3, 3, 1.0), (0, 3, -1.0), (3, 0, -1.0)] {
            own[(row, column)] = sign * axial;
        }
        let mut turn = DMatrix::identity(6, 6);
        for first in [0, 3] {
            turn[(first, first)] = c;
            turn[(first, first + 1)] = s;
            turn[(first + 1, first)] = -s;
            turn[(first + 1, first + 1)] = c;
        }
        let own = turn.transpose() * own * turn;
        let places: Vec<usize> = [a, b]
            .into_iter()
            .flat_map(|point| 3 * point..3 * point + 3)
            .collect();
        for (i, &row) in places.iter().enumerate() {
            for (j, &column) in places.iter().enumerate() {
                parts[parameter][(row, column)] += own[(i, j)];
            }
            let inertia = if row % 3 == 2 {
                length * length / 12.0
            } else {
                1.0
            };
            mass[row] += 125.0 * length * inertia;
        }
    }
    let kept: Vec<usize> = (0..rows).filter(|row| !held.contains(row)).collect();
    let parts = parts
        .iter()
        .map(|part| part.select_rows(&kept).select_columns(&kept))
        .collect();
    (parts, kept.iter().map(|row| mass[*row]).collect(), kept)
}

/// Two columns and a beam, clamped at their feet: sensors along x up the columns and along y on the beam.
fn portal() -> Built {
    let mut points: Vec<[f64; 2]> = (0..5).map(|at| [0.0, f64::from(at)]).collect();
    points.extend((1..6).map(|at| [f64::from(at), 4.0]));
    points.extend((0..4).map(|at| [5.0, f64::from(3 - at)]));
    let last = points.len() - 1;
    let members: Vec<_> = (0..last)
        .map(|at| {
            (
                at,
                at + 1,
                match at {
                    0..2 => 0,
                    2..4 => 1,
                    4..6 => 2,
                    6..9 => 3,
                    9..11 => 4,
                    _ => 5,
                },
            )
        })
        .collect();
    let held: Vec<usize> = (0..3).chain(3 * last..3 * last + 3).collect();
    let (parts, mass, kept) = frame(&points, &members, 6, &held);
    let read = |point: usize, along: usize| {
        kept.iter()
            .position(|row| *row == 3 * point + along)
            .expect("a row")
    };
    let sensors = [
        (1, 0),
        (2, 0),
        (3, 0),
        (5, 1),
        (6, 1),
        (7, 1),
        (8, 1),
        (10, 0),
        (11, 0),
        (12, 0),
    ];
    (
        parts,
        mass,
        sensors.map(|(point, along)| read(point, along)).to_vec(),
    )
}

/// A girder on two supports, in four parts: sensors along y at every other point.
fn girder() -> Built {
    let points: Vec<[f64; 2]> = (0..13).map(|at| [f64::from(at), 0.0]).collect();
    let members: Vec<_> = (0..12).map(|at| (at, at + 1, at / 3)).collect();
    let (parts, mass, kept) = frame(&points, &members, 4, &[0, 1, 3 * 12 + 1]);
    let read = |point: usize| {
        kept.iter()
            .position(|row| *row == 3 * point + 1)
            .expect("a row")
    };
    (parts, mass, (1..12).map(read).collect())
}

/// Six bays of a plane truss that hangs free, a parameter each: sensors along y at every point and along x at the ends.
fn free_truss() -> Built {
    let point = |bay: usize, upper: usize| 2 * bay + upper;
    let place = |at: usize| {
        [
            1.2 * (at / 2) as f64,
            (at % 2) as f64 * (0.8 + 0.05 * (at / 2) as f64),
        ]
    };
    let rows = 28;
    let mut parts = vec![DMatrix::zeros(rows, rows); 6];
    let mut rod = |a: usize, b: usize, part: usize| {
        let along = DVector::from_fn(2, |i, _| place(b)[i] - place(a)[i]);
        let (length, unit) = (along.norm(), along.normalize());
        let mut pull = DVector::zeros(rows);
        for i in 0..2 {
            pull[2 * a + i] = -unit[i];
            pull[2 * b + i] = unit[i];
        }
        parts[part] += 1e6 / length * &pull * pull.transpose();
    };
    for bay in 0..6 {
        rod(point(bay, 0), point(bay + 1, 0), bay);
        rod(point(bay, 1), point(bay + 1, 1), bay);
        rod(point(bay, 0), point(bay + 1, 1), bay);
        rod(point(bay, 0), point(bay, 1), bay);
    }
    rod(point(6, 0), point(6, 1), 5);
    let mass = (0..rows).map(|row| 8.0 + 0.3 * (row / 4) as f64).collect();
    let sensors = (0..14).map(|point| 2 * point + 1).chain([0, 24]).collect();
    (parts, mass, sensors)
}

/// A plate on four edges by differences, in five strips or six of so many rows: the squares of its curvatures. A sensor at every so
/// manyth point.
fn plate(across: usize, along: usize, rows: usize, apart: usize) -> Built {
    let count = across * along;
    let at = |row: usize, column: usize| along * row + column;
    let mut curvature = DMatrix::zeros(count, count);
    for row in 0..across {
        for column in 0..along {
            let own = at(row, column);
            curvature[(own, own)] = 4.0;
            let mut beside = |is_in: bool, other: usize| {
                if is_in {
                    curvature[(own, other)] = -1.0;
                }
            };
            beside(row > 0, own.wrapping_sub(along));
            beside(row + 1 < across, own + along);
            beside(column > 0, own.wrapping_sub(1));
            beside(column + 1 < along, own + 1);
        }
    }
    let strip = |strip: usize| {
        let own = DMatrix::from_fn(count, count, |i, j| {
            f64::from(u8::from(i == j && i / along / rows == strip))
        });
        1e4 * curvature.transpose() * own * &curvature
    };
    let sensors = (0..count).filter(|own| own % apart == 0).collect();
    let strips = (0..across.div_ceil(rows)).map(strip);
    (strips.collect(), vec![2.0; count], sensors)
}

/// A tower of eight stories, clamped at its feet, with a parameter for each column, beam and brace: sensors along both axes at its points.
fn tower() -> Built {
    let points: Vec<[f64; 2]> = (0..18)
        .map(|at| [3.0 * f64::from(at % 2), 2.0 * f64::from(at / 2)])
        .collect();
    let story = |at: usize| {
        let (left, upper) = (2 * at, 2 * at + 2);
        let members = [
            (left, upper),
            (left + 1, upper + 1),
            (upper, upper + 1),
            (left, upper + 1),
        ];
        (4 * at..)
            .zip(members)
            .map(|(parameter, (a, b))| (a, b, parameter))
    };
    let members: Vec<_> = (0..8).flat_map(story).collect();
    let (parts, mass, kept) = frame(&points, &members, 32, &[0, 1, 2, 3, 4, 5]);
    let sensors = (0..kept.len()).filter(|place| kept[*place] % 3 != 2);
    (parts, mass, sensors.collect())
}

/// Twelve sectors of a disk with a blade each: every blade and every part of the rim are two parameters' by turns; sensors at the blades.
fn disk() -> Built {
    let (sectors, rows) = (12, 24);
    let mut parts = vec![DMatrix::zeros(rows, rows); 4];
    let mut spring = |part: usize, a: usize, b: Option<usize>, size: f64| {
        parts[part][(a, a)] += size;
        if let Some(b) = b {
            parts[part][(b, b)] += size;
            parts[part][(a, b)] -= size;
            parts[part][(b, a)] -= size;
        }
    };
    for sector in 0..sectors {
        let next = (sector + 1) % sectors;
        spring(0, 2 * sector, Some(2 * next), 4e5);
        spring(1, 2 * sector, None, 5e4);
        spring(2 + sector / 6, 2 * sector, Some(2 * sector + 1), 6e4);
    }
    let mass = (0..rows)
        .map(|row| if row % 2 == 0 { 3.0 } else { 1.0 })
        .collect();
    (
        parts,
        mass,
        (0..sectors).map(|sector| 2 * sector + 1).collect(),
    )
}

fn files(
    model: &WholeModel,
    parameters: usize,
    (sensors, modes, rigid): (&[usize], usize, usize),
    noise: Noise,
) -> Files {
    let files = of_whole(model, &vec![1.0; parameters], sensors, modes, noise);
    supposing(files, 0.3, rigid)
}

/// A real structure with the job of a model of it, whose test declares a noise.
fn built(
    structure: usize,
    noise: Noise,
    wrong: Wrong,
) -> (WholeModel, LoadedJob, usize, Vec<usize>) {
    let Structure {
        rigid,
        modes,
        build,
        ..
    } = STRUCTURES[structure];
    let (mut real, mut first) = (build(), build());
    wrong(&mut real, &mut first);
    let of_part = |(number, part): (usize, &DMatrix<f64>)| WholeParameter {
        name: format!("p{number}"),
        share: WholeShare::Stiffness(sparse(part).expect("a part")),
        range: None,
    };
    let stiffness = sparse(&real.0.iter().sum()).expect("a stiffness");
    let [model, modeled] = [&real, &first].map(|(parts, mass, _)| {
        let parameters = parts.iter().enumerate().map(of_part).collect();
        WholeModel::new(stiffness.clone(), masses(mass), parameters).expect("a model")
    });
    let of_test = (&first.2[..], modes, rigid);
    let (_folder, path) = placed(&files(&modeled, first.0.len(), of_test, noise));
    let job = LoadedJob::new(&path).unwrap_or_else(|error| panic!("{error}"));
    (model, job, real.0.len(), real.2)
}

/// A normal number (Box and Muller).
fn normal(state: &mut u64) -> f64 {
    let radius = (-2.0 * (1.0 - uniform(state)).ln()).sqrt();
    radius * (TAU * uniform(state)).cos()
}

/// Factors that differ from one as a first model's do.
fn drawn(parameters: usize, state: &mut u64) -> Vec<f64> {
    (0..parameters)
        .map(|_| (MODEL * normal(state)).exp())
        .collect()
}

/// What became of the corrections of right tests.
#[derive(Debug, Clone, Default)]
pub struct Corrections {
    /// Intervals given, of every parameter.
    pub given: Vec<usize>,
    /// Intervals that hold the truth.
    pub held: Vec<usize>,
    /// Intervals given by tests that are accepted, and those of them that hold the truth.
    pub accepted_intervals: [usize; 2],
    /// Parameters known mostly from the prior, which have none for that.
    pub mostly_prior: usize,
    /// Tests that end with nothing against the result, and those that are refused.
    pub accepted: usize,
    pub refused: usize,
    /// Tests with three times the noise that end otherwise.
    pub found: usize,
}

/// Corrections by so many tests of a structure with the noise that is declared times each of some numbers, by turns.
pub fn corrections(
    structure: usize,
    wrong: Wrong,
    (noise, times): (Noise, &[f64]),
    tests: usize,
) -> Corrections {
    let (model, first, parameters, sensors) = built(structure, noise, wrong);
    let mut all = Corrections {
        given: vec![0; parameters],
        held: vec![0; parameters],
        ..Corrections::default()
    };
    let mut state = 11 + structure as u64;
    for times in times.iter().cycle().take(times.len() * tests) {
        let truth = drawn(parameters, &mut state);
        let mut loaded = LoadedJob::clone(&first);
        let noise = Noise {
            shape: times * noise.shape,
            frequency: times * noise.frequency,
        };
        let right = Right {
            model: &model,
            factors: &truth,
            rows: &sensors,
            modes: STRUCTURES[structure].modes,
        };
        measure(&mut loaded, &right, noise, &mut state);
        let found = loaded.prepare().and_then(|prepared| {
            let trust = Trust::before(&prepared)?;
            run(&prepared, &trust, |_| {}, || true)
        });
        let Ok(result) = found else {
            all.refused += 1;
            continue;
        };
        let is_accepted = result.verdict.is_within && !result.trust.stands_against();
        if *times > 1.0 {
            all.found += usize::from(!is_accepted);
            continue;
        }
        all.accepted += usize::from(is_accepted);
        for (e, interval) in result.intervals.iter().enumerate() {
            let own = [
                interval.is_ok(),
                interval.is_ok_and(|ends| ends.contains(truth[e])),
            ];
            all.given[e] += usize::from(own[0]);
            all.held[e] += usize::from(own[1]);
            for (count, own) in all.accepted_intervals.iter_mut().zip(own) {
                *count += usize::from(own && is_accepted);
            }
            all.mostly_prior += usize::from(*interval == Err(Withheld::MostlyPrior));
        }
    }
    all
}

/// Lines of a table of rates by the corrections of a structure: intervals given of parameters that the test decides, that hold the
/// truth, in the mean and of the parameter that is held least often, and in the mean of tests that are accepted, right tests accepted, and tests with three times the noise found.
pub fn interval_rates(structure: usize, noise: Noise) -> String {
    let Structure { name, tests, .. } = STRUCTURES[structure];
    let all = corrections(structure, WRONG[0].1, (noise, &[1.0, 3.0]), tests);
    let given: usize = all.given.iter().sum();
    let decided = all.given.len() * tests - all.mostly_prior;
    let each = all.held.iter().zip(&all.given);
    let each = each.filter(|(_, given)| 2 * **given > tests);
    let percent = |count: usize, of: usize| 100.0 * count as f64 / of as f64;
    let least = each.map(|(held, given)| percent(*held, *given));
    let row = format!(
        "{name} {}/{} %",
        100.0 * noise.frequency,
        100.0 * noise.shape
    );
    let cells = [
        ("Tests", tests as f64),
        ("Parameters", all.given.len() as f64),
        ("Given", percent(given, decided)),
        ("Held", percent(all.held.iter().sum(), given)),
        ("Least held", least.fold(100.0, f64::min)),
        (
            "Held of accepted",
            percent(all.accepted_intervals[1], all.accepted_intervals[0]),
        ),
        ("Accepted", percent(all.accepted, tests)),
        ("Found", percent(all.found, tests)),
    ];
    let line = |(column, value)| format!("intervals_structures,{row},{column},,{value},\n");
    cells.map(line).concat()
}

/// Lines of a table of a structure's right and wrong models, each corrected by forty tests of the same draws: how the tests end, and the
/// part of true factors that their intervals hold.
pub fn wrong_rates(structure: usize, noise: Noise) -> String {
    let tests = 40;
    let of = |(wrong, differ): (&str, Wrong)| {
        let all = corrections(structure, differ, (noise, &[1.0]), tests);
        let percent = |[of, count]: [usize; 2]| 100.0 * count as f64 / of as f64;
        let name = STRUCTURES[structure].name;
        let of_all = [&all.given, &all.held].map(|own| own.iter().sum());
        let cells = [
            ("Status 0", all.accepted as f64),
            ("Status 2", all.refused as f64),
            ("Status 3", (tests - all.accepted - all.refused) as f64),
            ("Intervals", of_all[0] as f64),
            ("Held", percent(of_all)),
            ("Held of accepted", percent(all.accepted_intervals)),
        ];
        // Where no test is accepted, none of its intervals are.
        let told = cells.into_iter().filter(|cell| cell.1.is_finite());
        let line = |(column, value)| format!("wrong_models,{name} {wrong},{column},,{value},\n");
        told.map(line).collect::<String>()
    };
    WRONG.map(of).concat()
}

/// Lines of a table of rates by the corrections of a structure, each by the mean of so many repeats of a test that declare no deviations.
pub fn repeat_rates(structure: usize, noise: Noise, repeats: usize, tests: usize) -> String {
    let Structure { name, modes, .. } = STRUCTURES[structure];
    let (model, first, parameters, sensors) = built(structure, noise, WRONG[0].1);
    let mut state = 31 + repeats as u64;
    let (mut given, mut held, mut accepted) = (0, vec![0; parameters], 0);
    for _ in 0..tests {
        let factors = drawn(parameters, &mut state);
        let right = Right {
            model: &model,
            factors: &factors,
            rows: &sensors,
            modes,
        };
        let mut files = files(&model, parameters, (&sensors, modes, 0), noise);
        let names: Vec<String> = (0..repeats).map(|at| format!("\"{at}.csv\"")).collect();
        let names = format!("repeats = [{}]", names.join(", "));
        files = with(files, "job.toml", "file = \"test.csv\"", &names);
        for at in 0..repeats {
            let mut loaded = LoadedJob::clone(&first);
            measure(&mut loaded, &right, noise, &mut state);
            let data = TestData {
                frequency_deviation: None,
                shape_deviation: None,
                ..loaded.data
            };
            files.push((format!("{at}.csv"), write_csv(&data)));
        }
        let (_folder, path) = placed(&files);
        let prepared = LoadedJob::new(&path).and_then(LoadedJob::prepare);
        let prepared = prepared.unwrap_or_else(|error| panic!("{error}"));
        let trust = Trust::before(&prepared).unwrap_or_else(|error| panic!("{error}"));
        let result = run(&prepared, &trust, |_| {}, || true);
        let result = result.unwrap_or_else(|error| panic!("{error}"));
        accepted += usize::from(result.verdict.is_within && !result.trust.stands_against());
        for ((held, interval), truth) in held.iter_mut().zip(&result.intervals).zip(&factors) {
            given += usize::from(interval.is_ok());
            *held += usize::from(interval.is_ok_and(|ends| ends.contains(*truth)));
        }
    }
    let percent = |count: usize, of: usize| 100.0 * count as f64 / of as f64;
    let least = held.iter().copied().min().unwrap_or_default();
    let cells = [
        ("Given", percent(given, parameters * tests)),
        ("Held", percent(held.iter().sum(), given)),
        ("Least held", percent(least, given / parameters)),
        ("Accepted", percent(accepted, tests)),
    ];
    let line = |(column, value)| {
        format!("intervals_repeats,{name} of {repeats} files,{column},,{value},\n")
    };
    cells.map(line).concat()
}

/// Columns of the tables of rates.
const COLUMNS: &str = "table,row,column,unit,computed,published\n";

/// All structures, with .2 and 1 % of noise and with .5 and 3 %: half an hour.
pub fn all_interval_rates() -> String {
    let noises = [(0.002, 0.01), (0.005, 0.03)];
    let noises = noises.map(|(frequency, shape)| Noise { shape, frequency });
    let lines: Vec<String> = std::thread::scope(|scope| {
        let of =
            |structure| noises.map(|noise| scope.spawn(move || interval_rates(structure, noise)));
        let runs = (0..STRUCTURES.len()).flat_map(of).collect_vec();
        let runs = runs.into_iter();
        runs.map(|run| run.join().expect("rates")).collect()
    });
    COLUMNS.to_owned() + &lines.concat()
}

/// Right and wrong models of a portal, a girder and a plate, with .5 and 3 % of noise: twenty seconds.
pub fn all_wrong_rates() -> String {
    let noise = Noise {
        shape: 0.03,
        frequency: 0.005,
    };
    COLUMNS.to_owned()
        + &[0, 1, 3]
            .map(|structure| wrong_rates(structure, noise))
            .concat()
}

/// Repeats of two to forty files that declare no deviations, of a portal and of a girder: minutes.
pub fn all_repeat_rates() -> String {
    let noise = Noise {
        shape: 0.03,
        frequency: 0.005,
    };
    let of = |structure| {
        let of = |files| repeat_rates(structure, noise, files, 150);
        [2, 3, 5, 10, 40].map(of).concat()
    };
    COLUMNS.to_owned() + &of(0) + &of(1)
}

/// True model, and the rows and modes of it that a test has.
struct Right<'a> {
    model: &'a WholeModel,
    factors: &'a [f64],
    rows: &'a [usize],
    modes: usize,
}

/// A test of a true model with noise: the lowest modes that move the sensors by a twentieth of their largest motion, for others no test
/// finds.
fn measure(loaded: &mut LoadedJob, right: &Right, noise: Noise, state: &mut u64) {
    let most = (2 * right.modes).min(right.model.dof_count() - 1);
    let real = right.model.modes(right.factors, most);
    let real = real.expect("modes").vibrations;
    let is_seen = |mode: &usize| {
        let shape = real.shapes().column(*mode);
        shape.select_rows(right.rows).amax() > 0.05 * shape.amax()
    };
    let seen: Vec<usize> = (0..real.len()).filter(is_seen).take(right.modes).collect();
    let data = &mut loaded.data;
    let mut shapes = real.shapes().select_rows(right.rows).select_columns(&seen);
    for mut shape in shapes.column_iter_mut() {
        shape /= shape.amax();
        shape.apply(|own| *own += noise.shape * normal(state));
    }
    let hertz = seen.iter().map(|&mode| real.frequencies_hz()[mode]);
    data.frequencies_hz = hertz
        .map(|hertz| hertz * (1.0 + noise.frequency * normal(state)))
        .collect();
    data.shapes = shapes;
}
