//! The program from outside: by transcripts, and what they cannot say.

#[cfg(unix)]
pub mod stops;
#[cfg(unix)]
mod transcripts;

use crate::common::jobs::folder_of;
use crate::prelude::*;
use corfem::job::Job;

pub fn corfem(arguments: &[&str]) -> std::process::Output {
    let mut program = assert_cmd::Command::cargo_bin("corfem").unwrap();
    program.args(arguments).output().unwrap()
}

/// What it prints, without a word on standard error.
pub fn printed(arguments: &[&str]) -> String {
    let done = corfem(arguments);
    let ended = (done.status.code(), done.stderr.is_empty());
    assert_eq!(ended, (Some(0), true), "{arguments:?}");
    String::from_utf8(done.stdout).unwrap()
}

fn parsed(arguments: &[&str]) -> Value {
    serde_json::from_slice(&corfem(arguments).stdout).unwrap()
}

/// The numbers of a list in JSON.
fn numbers(value: &Value) -> Vec<f64> {
    let numbers = value.as_array().unwrap().iter();
    numbers.map(|number| number.as_f64().unwrap()).collect()
}

/// What every case came to, with a bar for every gage; and modes with every grid that moves, one of them without mass, one tied.
#[test]
fn printed_texts_are_the_stored_ones() {
    assert_golden("cases", &printed(&[]), Numbers::AS_WRITTEN);
    let deck = "GRID,1,,0.,0.,0.,,123\nGRID,2,,10.,0.,0.,,23\nGRID,3,,20.,0.,0.,,23\nGRID,4,,30.,0.,0.,,23\n\
                GRID,9,,15.,1.,0.\nCROD,1,1,1,2\nCROD,2,1,2,3\nCROD,3,1,3,4\nPROD,1,1,.1\nMAT1,1,1.+6\n\
                CMASS2,8,1.,2,1\nCMASS2,7,2.,4,1\nMPC,1,9,3,-1.,2,1,.5\n,,3,1,-2.\nSPC1,1,12,9\n";
    let folder = new_folder();
    let path = folder.path().join("rods.bdf");
    fs::write(&path, deck).unwrap();
    let found = parsed(&["modes", path.to_str().unwrap(), "-f", "json"]);
    let moving = ["moving_dof", "moving_shapes", "dof", "shapes"].map(|key| found[key].to_string());
    assert_golden("modes_moving", &moving.join("\n"), Numbers::AS_WRITTEN);
}

/// The keys of a document, a line each; of a list those of its first entry.
fn keys(value: &Value, path: &str, found: &mut Vec<String>) {
    match value {
        Value::Object(map) => {
            for (key, value) in map {
                keys(value, &format!("{path}.{key}"), found);
            }
        }
        Value::Array(items) if items.first().is_some_and(Value::is_object) => {
            keys(&items[0], &format!("{path}[]"), found);
        }
        Value::Array(items) => {
            let row = items.first().and_then(Value::as_array);
            let columns = row.map_or(String::new(), |row| format!(" × {}", row.len()));
            found.push(format!("{path}: {}{columns}", items.len()));
        }
        _ => found.push(path.to_owned()),
    }
}

#[test]
fn the_keys_of_documents_stay_what_they_are() {
    for (name, arguments) in [
        ("cases_keys", &["cases", "3", "-q", "-f", "json"][..]),
        ("case_4_keys", &["cases", "4", "-q", "-f", "json"]),
        ("fewer_modes_keys", &["fewer-modes", "-f", "json"]),
    ] {
        let mut found = Vec::new();
        keys(&parsed(arguments), "", &mut found);
        assert_golden(name, &found.join("\n"), Numbers::AS_WRITTEN);
    }
}

/// `paper/json.md` has every key of the document and no other, and in the row of each all keys within it.
#[test]
fn the_json_of_a_correlation_has_the_keys_of_its_page() {
    let page = include_str!("../../../paper/json.md").lines();
    let mut rows = BTreeMap::new();
    for row in page.filter(|line| line.starts_with("| `")) {
        let own = row.split('|').nth(1).unwrap().split('`');
        rows.extend(own.skip(1).step_by(2).map(|key| (key, row)));
    }
    for name in ["box", "building", "wing"] {
        let job = folder_of(name).join("job.toml");
        let found = parsed(&["correlate", "-q", "-f", "json", job.to_str().unwrap()]);
        let found = found.as_object().unwrap();
        assert!(
            found
                .keys()
                .collect::<BTreeSet<_>>()
                .into_iter()
                .eq(rows.keys()),
            "{name}"
        );
        for (key, value) in found {
            let mut inner = Vec::new();
            keys(&json!([{"": value}]), "", &mut inner);
            let names = inner
                .iter()
                .flat_map(|path| path.split(['.', '[', ']', ':', ' ']));
            let is_key = |name: &&str| name.starts_with(|c: char| c.is_ascii_lowercase());
            for name in names.filter(is_key) {
                assert!(
                    rows[&key[..]].contains(&format!("`{name}`")),
                    "{key}: {name}"
                );
            }
        }
    }
}

/// The template with every example and default taken is a job; and it explains every entry that a job may have, as the reader itself lists
/// them when it finds another.
#[test]
fn init_explains_every_entry_that_a_job_may_have() {
    let template = printed(&["init"]);
    let lines = template
        .lines()
        .skip_while(|line| !line.starts_with("title"));
    let taken = lines.map(|line| {
        let entry = line.strip_prefix("# ");
        entry
            .filter(|entry| entry.split(' ').nth(1) == Some("="))
            .unwrap_or(line)
    });
    toml::from_str::<Job>(&taken.collect_vec().join("\n")).unwrap();
    let base = "[model]\n[test]\nfile = \"t\"\n";
    let mut count = 0;
    for table in [
        "",
        "[model]",
        "[test]",
        "[sensors]",
        "[[parameter]]",
        "[compare]",
        "[[sensors.place]]",
        "[correlation]",
        "[correlation.inner]",
    ] {
        let strange = format!("{table}\nstranger = 1\n");
        let job = match table {
            "" => strange + base,
            _ if base.contains(table) => base.replace(table, &strange),
            _ => base.to_owned() + &strange,
        };
        let error = toml::from_str::<Job>(&job).expect_err(table).to_string();
        let (_, list) = error.split_once("expected ").unwrap();
        for entry in list.split('`').skip(1).step_by(2) {
            let ways = [
                format!("{entry} = "),
                format!("[{entry}]"),
                format!("correlation.{entry}]"),
            ];
            assert!(
                ways.iter().any(|way| template.contains(way)),
                "{table}: {entry}"
            );
            count += 1;
        }
    }
    assert_eq!(count, 57);
    let test = printed(&["init", "--test"]);
    let data = read("test.csv", test.as_bytes()).unwrap();
    assert_eq!((data.sensors.len(), data.frequencies_hz.len()), (2, 2));
}

#[test]
fn a_deck_of_a_pass_has_the_frequencies_of_that_pass() {
    let folder = new_folder();
    let path = folder.path().join("box.dat");
    let path = path.to_str().unwrap();
    let case = case_of(2);
    let passes = case_run(&case).correlation.passes;
    let (model, _) = whole::of(&case.model().unwrap()).unwrap();
    for (pass, factors) in [&vec![1.0; 15], &passes[0].factors, &passes[1].factors]
        .into_iter()
        .enumerate()
    {
        // By the same eigensolver, so that the digits of the deck are all that differs.
        let expected = model.modes(factors, 9).unwrap().vibrations;
        printed(&["deck", "2", "--pass", &pass.to_string(), "-o", path]);
        let document = parsed(&["modes", path, "--format", "json"]);
        let found = numbers(&document["frequencies_hz"]);
        assert_eq!(found.len(), 9);
        assert_alike(found, expected.frequencies_hz(), DECK_ROUNDING);
        for (mode, mass) in numbers(&document["generalized_masses"])
            .into_iter()
            .enumerate()
        {
            let shape = numbers(&document["shapes"][mode]);
            assert_eq!(shape.iter().copied().fold(f64::MIN, f64::max), 1.0);
            let masses = shape.iter().zip(&case.reconstruction.masses);
            let generalized: f64 = masses.map(|(x, m)| m * x * x).sum();
            assert_alike([mass], [generalized], 1e2 * DECK_ROUNDING);
        }
    }
}

/// The stored answer is that of pyuff 2.5.8 and of SDynPy 0.23.0 (`golden/formats/shapes_read.py`), digit for digit the same: this crate's
/// reader finds it in the file of the building too.
#[test]
fn other_programs_read_the_shapes_that_a_correlation_writes() {
    let answer = include_str!("../../../golden/formats/shapes_read.json");
    let answer: Value = serde_json::from_str(answer).unwrap();
    let folder = new_folder();
    let job = folder_of("building").join("job.toml");
    let arguments = ["correlate", "-q", job.to_str().unwrap(), "--folder"];
    printed(&[&arguments[..], &[folder.path().to_str().unwrap()]].concat());
    let file = fs::read(folder.path().join("shapes.unv")).unwrap();
    let data = read("shapes.unv", &file).unwrap();
    let near = |found: &Value, value: f64| {
        assert_within(found.as_f64().unwrap(), value, 2.0 * UNIVERSAL_ROUNDING);
    };
    for (mode, hertz) in data.frequencies_hz.iter().enumerate() {
        near(&answer["frequencies_hz"][mode], *hertz);
    }
    for (row, sensor) in data.sensors.iter().enumerate() {
        let node = sensor.grid.unwrap().to_string();
        let place = sensor.place.unwrap();
        (0..3).for_each(|axis| near(&answer["nodes"][&node][axis], place[axis]));
        for mode in 0..data.frequencies_hz.len() {
            let shape = &answer["shapes"][mode][&node];
            near(&shape[sensor.direction], data.shapes[(row, mode)]);
        }
    }
    assert_eq!(data.lines, [[1, 3], [3, 4], [4, 7], [7, 10]]);
}

/// The law: no output turns the direction in which it is read, and each still tells which character was there.
#[test]
fn characters_that_turn_text_around_are_escaped_in_every_output() {
    let turns = [
        '\u{61c}', '\u{200e}', '\u{200f}', '\u{202a}', '\u{202b}', '\u{202c}', '\u{202d}',
        '\u{202e}', '\u{2066}', '\u{2067}', '\u{2068}', '\u{2069}',
    ];
    let all: String = turns.iter().collect();
    let files = rods_with("name = \"a\"", &format!("name = \"a{all}b\""));
    let titled = format!("title = \"t{all}\"\n[model]");
    let (folder, path) = placed(&with(files, "job.toml", "[model]", &titled));
    let (path, out) = (path.to_str().unwrap(), folder.path().join("out"));
    let mut outputs = Vec::new();
    for format in ["text", "markdown", "json", "csv"] {
        let both =
            ["check", "correlate"].map(|command| corfem(&[command, "-q", "-f", format, path]));
        outputs.extend(both.map(|done| String::from_utf8(done.stdout).unwrap()));
    }
    corfem(&["correlate", "-q", path, "--folder", out.to_str().unwrap()]);
    for file in ["report.html", "factors.csv", "correlation.json"] {
        outputs.push(fs::read_to_string(out.join(file)).unwrap());
    }
    for output in &outputs {
        assert!(!output.contains(turns), "{output}");
        assert!(output.to_lowercase().contains("202e"), "{output}");
    }
    // Whoever reads JSON by a program finds the name as it was.
    let document: Value = serde_json::from_str(outputs.last().unwrap()).unwrap();
    assert_eq!(document["parameters"][0]["parameter"], format!("a{all}b"));
}
