//! Jobs as lists: what each is refused for, or what is known of it before the first step and after the last.

use super::lone_frequencies::without_shapes;
use super::repeats::{exact, noisy, repeated};
use crate::common::cases::hold;
use crate::common::jobs::{free_masses, in_universal, run, tested, torque_box, unbroken};
use crate::prelude::*;
use corfem::present::report::facts;

/// The files of a job one behind the other.
fn joined(files: &Files) -> String {
    let files = files.iter();
    files
        .map(|(name, text)| format!("=== {name}\n{text}"))
        .collect()
}

/// The files of a job that stand in a text one behind the other.
fn parted(text: &str) -> Files {
    let files = text.split("=== ").skip(1);
    let files = files.map(|file| file.split_once('\n').unwrap());
    files
        .map(|(name, text)| (name.to_owned(), text.to_owned()))
        .collect()
}

/// A job of matrices that name their rows.
pub fn named() -> Files {
    let list: Value = toml::from_str(include_str!("files/models.toml")).unwrap();
    parted(list["texts"]["named"].as_str().unwrap())
}

/// Changes a test by a word and numbers; rows and modes count from one.
fn edited(data: &mut TestData, word: &str, numbers: &[f64]) {
    let at = |place: usize| numbers[place] as usize - 1;
    let of_all = |count: usize| Some(numbers.iter().copied().cycle().take(count).collect_vec());
    let (modes, shapes) = (data.frequencies_hz.len(), &mut data.shapes);
    let (hertz, sensors) = (&mut data.frequencies_hz, &mut data.sensors);
    match word {
        "times" => shapes.row_mut(at(0)).scale_mut(numbers[1]),
        "exchange" => shapes.swap_rows(at(0), at(1)),
        "hertz" if numbers.len() == 1 => hertz.iter_mut().for_each(|own| *own *= numbers[0]),
        "hertz" => (1..numbers.len()).for_each(|place| hertz[at(place)] *= numbers[0]),
        "alone" => {
            shapes.column_mut(at(0)).fill(0.0);
            shapes[(at(1), at(0))] = 1.0;
        }
        "again" => {
            let own = shapes.column(at(0)).into_owned();
            shapes.set_column(at(1), &own);
            hertz[at(1)] = 1.001 * hertz[at(0)];
        }
        "sensors" => {
            sensors.truncate(at(0) + 1);
            *shapes = shapes.rows(0, at(0) + 1).into_owned();
        }
        "frequency_deviation" => data.frequency_deviation = of_all(modes),
        "shape_deviation" => data.shape_deviation = of_all(modes),
        "component_deviation" => {
            let own = DVector::from_vec(of_all(shapes.nrows()).unwrap());
            data.component_deviation = (0..modes).map(|mode| (mode, own.clone())).collect();
        }
        "collinearity" => data.phase_collinearity = numbers.to_vec(),
        "exchange_places" => {
            let place = sensors[at(0)].place;
            sensors[at(0)].place = sensors[at(1)].place;
            sensors[at(1)].place = place;
        }
        "move" | "span" => {
            let moved = |place: Vector3<f64>| match numbers {
                [times] => *times * place,
                _ => place + Vector3::new(numbers[0], numbers[1], numbers[2]),
            };
            let is_one = |row: usize| numbers.get(3).is_none_or(|own| *own as usize == row + 1);
            for (_, own) in sensors.iter_mut().enumerate().filter(|own| is_one(own.0)) {
                own.place = own.place.map(moved);
            }
        }
        _ => panic!("{word}"),
    }
}

/// What is said of a job whose files stand in a text, after edits of its test: without the run where it is looked at alone, and of concerns
/// those whose identifiers begin with one of the words that follow "about".
fn of_job(text: &str, with: &[String]) -> Result<Value, String> {
    let mut files = parted(text);
    let (mut about, mut is_run) = (vec![""], true);
    for own in with {
        let words = own.split(' ').collect_vec();
        match words[0] {
            "about" => about = words[1..].to_vec(),
            "look" => is_run = false,
            word => {
                let numbers = words[1..].iter().map(|own| own.parse().unwrap());
                let numbers = numbers.collect_vec();
                files = retested(files, |data| edited(data, word, &numbers));
            }
        }
    }
    let (folder, path) = placed(&files);
    told(&path, &about, is_run).map_err(|error| {
        let folder = format!("{}/", folder.path().display());
        error.to_string().replace(&folder, "")
    })
}

fn told(path: &Path, about: &[&str], is_run: bool) -> Result<Value, FileError> {
    let job = prepare(path)?;
    let (before, loaded) = (Trust::before(&job)?, &job.loaded);
    let is_of = |own: &&Concern| about.iter().any(|name| own.identifier.starts_with(name));
    let lines = |trust: &Trust| {
        let all = trust.all().iter().filter(is_of);
        all.map(|own| format!("{}: {}", own.identifier, own.words))
            .collect_vec()
    };
    let answers = |trust: &Trust| {
        let all = trust.answers(is_run).into_iter();
        json!(
            all.map(|own| (own.check, own.answer))
                .collect::<BTreeMap<_, _>>()
        )
    };
    let (source, rows) = (&loaded.source, |of: &DMatrix<f64>| {
        let rows = of.row_iter();
        rows.map(|row| row.iter().copied().collect_vec())
            .collect_vec()
    });
    let facts: BTreeMap<_, _> = facts(&job)?
        .into_iter()
        .map(|own| (own.fact, own.value))
        .collect();
    let placed = loaded.placed.iter();
    let mut told = json!({
        "title": loaded.title,
        "names": loaded.parameter_names().collect_vec(),
        "members": source.members.iter().map(|own| (&own.elements, &own.masses)).collect_vec(),
        "priors": source.priors,
        "motions": source.motions.len(),
        "masses": source.whole.at(&vec![1.0; loaded.parameter_names().count()])?.1.entries().collect_vec(),
        "rigid": source.whole.rigid_bodies()?.rigid(),
        "mass": facts["mass along x, y, z"],
        "modes_taken": facts["modes taken"],
        "unbounded": facts.get("parameters without bounds"),
        "modes": job.modes,
        "alone": loaded.alone,
        "placed": placed.map(|own| (own.grid, own.direction, own.distance)).collect_vec(),
        "sensors": rows(&loaded.sensors.dense()),
        "shapes": rows(job.test.shapes()),
        "unused": crate::prelude::about(&before, "not-used"),
        "before": lines(&before),
        "doubts": before.all().iter().filter(is_of).filter(|own| own.stands()).map(|own| &own.identifier).collect_vec(),
        "answers": answers(&before),
    });
    if is_run {
        let found = run(&job, |_| {}, || true)?;
        let withheld = found.intervals.iter();
        let withheld =
            withheld.map(|own| own.err().map_or(String::new(), |why| format!("{why:?}")));
        told["after"] = json!(lines(&found.trust));
        told["answers"] = answers(&found.trust);
        told["at_bound"] = json!(found.verdict.at_bound);
        told["unseen"] = json!(found.verdict.unseen);
        told["withheld"] = json!(withheld.collect_vec());
        let report = report_of(&found);
        told["text"] = json!(unbroken(&text(&report.brief())));
        told["report"] = json!(report);
    }
    Ok(told)
}

fn hold_jobs(list: &str) {
    let tests = (1..=4).map(|seed| noisy(&exact(), seed)).collect_vec();
    let texts = [
        ("rods", rods()),
        ("building", building()),
        ("box", torque_box()),
        ("tall", tested(|_| {})),
        ("thirty", measured_building(30, 6)),
        ("sixteen", measured_building(16, 10)),
        ("two", measured_building(2, 2)),
        ("two of one mode", measured_building(2, 1)),
        ("four", measured_building(4, 1)),
        ("free", free_masses()),
        ("universal", in_universal()),
        ("lone", without_shapes(&[2, 4])),
        ("repeated", repeated(&tests, "[1, 2, 3, 4, 5]")),
    ];
    let texts = texts.map(|(name, files)| (name, joined(&files)));
    hold(list, &texts, WEIGHTED_FACTOR, of_job);
}

#[test]
fn jobs_are_refused_or_remarked_on_as_listed() {
    hold_jobs(include_str!("files/jobs.toml"));
}

#[test]
fn models_of_matrices_are_refused_or_read_as_listed() {
    hold_jobs(include_str!("files/models.toml"));
}

#[test]
fn sensors_are_those_of_the_test_at_what_moves() {
    hold_jobs(include_str!("files/sensors.toml"));
}

/// By numbers that are worked out by hand, and on both sides of every limit.
#[test]
fn mistakes_are_named_before_the_first_step_as_listed() {
    hold_jobs(include_str!("files/concerns.toml"));
}

#[test]
fn results_say_what_is_known_of_them_as_listed() {
    hold_jobs(include_str!("files/results.toml"));
}

/// The law: each of the three answers is seen of every question, or there is a reason why it cannot be.
#[test]
fn every_check_says_yes_no_or_not_checked() {
    let list = include_str!("files/checks.toml");
    hold_jobs(list);
    for check in Trust::default().answers(true) {
        for answer in ["yes", "no", "not_checked"] {
            let said = format!("\"{}\" = \"{answer}\"", check.check);
            assert!(list.contains(&said), "{said}");
        }
    }
}
