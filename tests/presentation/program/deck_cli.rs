//! `corfem deck` and `corfem modes` from outside.

use crate::prelude::*;
use crate::presentation::program::cli::{corfem, numbers, text};
use crate::readers::job_concerns::HARDLY_HELD;

fn frequencies(document: &Value) -> Vec<f64> {
    numbers(&document["frequencies_hz"])
}

#[test]
fn a_deck_of_a_pass_has_the_frequencies_of_that_pass() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("box.dat");
    let path = path.to_str().expect("UTF-8");
    let case = Case::new(2).expect("a case");
    let passes = run_case(&case, |_, _| ()).expect("a run").correlation;
    let (model, _) = whole::of(&case.model().expect("a model")).expect("a whole model");
    let stages = [
        ("0", vec![1.0; 15]),
        ("1", passes.passes[0].factors.clone()),
        ("2", passes.passes[1].factors.clone()),
    ];
    for (pass, factors) in stages {
        // By the same eigensolver, so that the digits of the deck are all that differs.
        let expected = model.modes(&factors, 9).expect("modes").vibrations;
        let written = corfem(&["deck", "2", "--pass", pass, "-o", path]);
        assert_eq!(written.status.code(), Some(0), "{}", text(&written.stderr));
        assert!(written.stdout.is_empty());
        let modes = corfem(&["modes", path, "--format", "json"]);
        assert!(modes.stderr.is_empty(), "{}", text(&modes.stderr));
        let document: Value = serde_json::from_slice(&modes.stdout).expect("JSON");
        let found = frequencies(&document);
        assert_eq!(found.len(), 9);
        for (a, b) in found.iter().zip(expected.frequencies_hz()) {
            approx::assert_relative_eq!(*a, b, max_relative = DECK_ROUNDING);
        }
        assert_eq!(document["dof"][0]["grid"], 101);
        assert_eq!(document["dof"][8]["direction"], "z");
        for (shape, mass) in document["shapes"]
            .as_array()
            .expect("a list")
            .iter()
            .zip(document["generalized_masses"].as_array().expect("a list"))
        {
            let shape = numbers(shape);
            let largest = shape.iter().copied().fold(f64::MIN, f64::max);
            assert_eq!((shape.len(), largest), (9, 1.0));
            let generalized: f64 = shape
                .iter()
                .zip(&case.reconstruction.masses)
                .map(|(x, m)| m * x * x)
                .sum();
            approx::assert_relative_eq!(
                mass.as_f64().expect("a number"),
                generalized,
                max_relative = 1e2 * DECK_ROUNDING
            );
        }
    }
}

#[test]
fn a_deck_is_a_whole_run_of_nastran() {
    let deck = text(&corfem(&["deck", "4"]).stdout);
    for line in [
        "NASTRAN BANDIT=-1",
        "SOL     3,0",
        "DIAG    44",
        "CEND",
        "SPC = 1",
        "MPC = 1",
        "METHOD = 1",
        "BEGIN BULK",
        "ENDDATA",
    ] {
        assert!(deck.lines().any(|found| found == line), "{line}");
    }
    assert!(deck.contains("TITLE = CORFEM CASE 4, PASS 0\n"));
    assert!(deck.lines().all(|line| line.len() <= 80));
    let count = |name: &str| {
        deck.lines()
            .filter(|line| line[..8.min(line.len())].trim_end_matches([' ', '*']) == name)
            .count()
    };
    let counts = [
        "GRID", "CROD", "PROD", "CSHEAR", "PSHEAR", "CQDMEM", "PQDMEM", "MAT1", "CMASS2", "MPC",
        "SPC1", "EIGR",
    ]
    .map(count);
    assert_eq!(counts, [25, 24, 24, 9, 9, 6, 6, 1, 9, 9, 3, 1]);
    // Nine modes from below the lowest to above the highest of 7.56 to 878 Hz.
    assert!(
        deck.contains("EIGR    1       INV     6.      966.    9       9"),
        "{deck}"
    );
    assert!(
        deck.contains("GRID*   1                               10.107          32.564          *1\n*1      .2119\n")
    );
}

#[test]
fn modes_are_tables_with_what_was_not_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("rod.dat");
    let deck = "PARAM,GRDPNT,0\nGRID,1\nGRID,2,,10.\nCROD,1,1,1,2\nPROD,1,1,.01\nMAT1,1,1.+6,,.3\nSPC1,1,123,1\nSPC1,1,23,2\nCMASS2,7,.4,2,1\n";
    std::fs::write(&path, deck).expect("written");
    let path = path.to_str().expect("UTF-8");
    let plain = corfem(&["modes", path]);
    assert_eq!(plain.status.code(), Some(0));
    let sentence =
        "Not read: PARAM (line 1, 1 card), nothing of stiffness, mass, supports or coordinates.";
    assert!(
        text(&plain.stderr).ends_with(&format!("{sentence}\n")),
        "{}",
        text(&plain.stderr)
    );
    let report = text(&plain.stdout);
    assert!(
        report.starts_with("Natural frequencies at 1 degree of freedom with mass\n"),
        "{report}"
    );
    assert!(
        report.contains("1      7.957747     0.400000\n"),
        "{report}"
    );
    let unbroken = report.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(unbroken.contains(sentence));
    assert!(report.contains("2 x   1.00000\n"), "{report}");
    let markdown = text(&corfem(&["modes", path, "-f", "markdown"]).stdout);
    assert!(
        markdown.contains("## Shapes of modes 1 to 1, largest component one"),
        "{markdown}"
    );
    let csv = text(&corfem(&["modes", path, "-f", "csv"]).stdout);
    assert!(csv.contains("frequencies,1,Frequency,Hz,7.957747"), "{csv}");
    assert!(csv.contains("shapes_1_to_1,2 x,Mode 1,,1,"), "{csv}");
    let json: Value =
        serde_json::from_slice(&corfem(&["modes", path, "-f", "json"]).stdout).expect("JSON");
    assert_eq!(json["not_read"][0], sentence);
}

#[test]
fn shapes_are_split_into_tables_of_nine_modes() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("chain.dat");
    let mut deck = String::from("GRID,1,,0.,0.,0.,,123\nPROD,1,1,.01\nMAT1,1,1.+6,,.3\n");
    for label in 2..=12 {
        deck += &format!(
            "GRID,{label},,{label}.,0.,0.,,23\nCROD,{label},1,{},{label}\nCMASS2,{label},1.,{label},1\n",
            label - 1
        );
    }
    std::fs::write(&path, deck).expect("written");
    let path = path.to_str().expect("UTF-8");
    let report = text(&corfem(&["modes", path]).stdout);
    assert!(
        report.contains("Shapes of modes 1 to 9,") && report.contains("Shapes of modes 10 to 11,"),
        "{report}"
    );
    let lowest: Value =
        serde_json::from_slice(&corfem(&["modes", path, "-f", "json", "--count", "2"]).stdout)
            .expect("JSON");
    assert_eq!(frequencies(&lowest).len(), 2);
    assert_eq!(lowest["shapes"].as_array().map(Vec::len), Some(2));
    assert_eq!(
        corfem(&["modes", path, "--count", "11"]).status.code(),
        Some(0)
    );
    let more = corfem(&["modes", path, "--count", "12"]);
    assert_eq!(more.status.code(), Some(0));
    assert_eq!(
        text(&more.stderr),
        "corfem: 12 modes asked for; 11 were found, and how many there are was not counted\n"
    );
    assert_eq!(text(&more.stdout), text(&corfem(&["modes", path]).stdout));
}

/// Shapes at all that moves have those at the masses among them, in the same scale, and follow the equations.
#[test]
fn modes_as_json_have_every_grid_that_moves() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("rods.bdf");
    let deck = "GRID,1,,0.,0.,0.,,123\nGRID,2,,10.,0.,0.,,23\nGRID,3,,20.,0.,0.,,23\nGRID,4,,30.,0.,0.,,23\n\
                GRID,9,,15.,1.,0.\nCROD,1,1,1,2\nCROD,2,1,2,3\nCROD,3,1,3,4\nPROD,1,1,.1\nMAT1,1,1.+6\n\
                CMASS2,8,1.,2,1\nCMASS2,7,2.,4,1\nMPC,1,9,3,-1.,2,1,.5\n,,3,1,-2.\nSPC1,1,12,9\n";
    std::fs::write(&path, deck).expect("written");
    let path = path.to_str().expect("UTF-8");
    let found: Value =
        serde_json::from_slice(&corfem(&["modes", path, "-f", "json"]).stdout).expect("JSON");
    let names = |list: &Value| {
        let list = list.as_array().expect("a list").iter();
        list.map(|dof| {
            format!(
                "{} {}",
                dof["grid"],
                dof["direction"].as_str().expect("a word")
            )
        })
        .collect::<Vec<_>>()
    };
    assert_eq!(names(&found["dof"]), ["2 x", "4 x"]);
    assert_eq!(names(&found["moving_dof"]), ["2 x", "3 x", "4 x", "9 z"]);
    let all = found["moving_shapes"].as_array().expect("a list");
    let at_masses = found["shapes"].as_array().expect("a list");
    assert_eq!((all.len(), at_masses.len()), (2, 2));
    for (shape, at_mass) in all.iter().zip(at_masses) {
        let (shape, at_mass) = (numbers(shape), numbers(at_mass));
        let near = |found: f64, expected: f64| {
            approx::assert_relative_eq!(found, expected, epsilon = ROUND_OFF);
        };
        near(shape[0], at_mass[0]);
        near(shape[2], at_mass[1]);
        // The grid between two equal rods has no mass and stands in the middle; the equation ties the last.
        near(shape[1], 0.5 * (shape[0] + shape[2]));
        near(shape[3], 0.5 * shape[0] - 2.0 * shape[1]);
    }
}

#[test]
fn bad_input_is_exit_status_2() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("bad.dat");
    std::fs::write(&path, "GRID,1,,x\n").expect("written");
    let path = path.to_str().expect("UTF-8");
    for (arguments, message) in [
        (
            vec!["deck", "7"],
            "corfem: there is no case 7; choose 1 to 4\n".to_owned(),
        ),
        (
            vec!["deck", "4", "--pass", "2"],
            "corfem: pass: 2 given or asked for; there must be 0 to 1\n".to_owned(),
        ),
        (
            vec!["modes", path],
            format!(
                "corfem: {path}, line 1: card GRID, field 4: \"X\" is not a real number with a decimal point\n"
            ),
        ),
    ] {
        let output = corfem(&arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert_eq!(text(&output.stderr), message);
        assert!(output.stdout.is_empty());
    }
    let absent = corfem(&["modes", "no/such.dat"]);
    assert_eq!(absent.status.code(), Some(2));
    assert!(text(&absent.stderr).contains("cannot read no/such.dat: no such file"));
}

/// A rod that holds one mass, with three cards that the crate does not understand.
const BARS: &str = "\
GRID,1,,0.,0.,0.,,123
GRID,2,,10.,0.,0.,,23
CROD,1,1,1,2
PROD,1,1,.01
MAT1,1,1.+6,,.3
CMASS2,7,.4,2,1
CBAR,8,2,1,2,0.,1.,0.
PBAR,2,1,.01
CBAR,9,2,1,2,0.,1.,0.
";

#[test]
fn cards_that_are_not_understood_are_refused_unless_ignored_by_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("bars.dat");
    std::fs::write(&path, BARS).expect("written");
    let path = path.to_str().expect("UTF-8");
    let refused = corfem(&["modes", path]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(refused.stdout.is_empty());
    assert_eq!(
        text(&refused.stderr),
        format!(
            "corfem: {path}: corfem lacks what CBAR (line 7, 2 cards), PBAR (line 8, 1 card) stand for, and without them the modes are \
             others; let the program that the deck is for write the stiffness and mass, and give these (paper/matrices.md)
"
        )
    );
    let some = corfem(&["modes", path, "--ignore", "CBAR"]);
    assert_eq!(some.status.code(), Some(2));
    assert!(
        text(&some.stderr).contains("corfem lacks what PBAR (line 8, 1 card) stand for"),
        "{}",
        text(&some.stderr)
    );
    let read = corfem(&["modes", path, "--ignore", "CROD"]);
    assert_eq!(read.status.code(), Some(2));
    assert_eq!(
        text(&read.stderr),
        "corfem: --ignore: corfem reads CROD; only cards that it does not read can be left out\n"
    );
    let run = |format| corfem(&["modes", path, "--ignore", "cbar,PBAR", "--format", format]);
    let sentence =
        "Not read: CBAR (line 7, 2 cards), left out by request; these modes lack what they say.";
    let report = run("text");
    assert_eq!(report.status.code(), Some(0));
    assert!(
        text(&report.stderr).contains(sentence),
        "{}",
        text(&report.stderr)
    );
    let title = "Cards left out by request: these modes lack what they say";
    assert!(
        text(&report.stdout).starts_with(title),
        "{}",
        text(&report.stdout)
    );
    assert!(
        text(&report.stdout).contains("1      7.957747     0.400000\n"),
        "{}",
        text(&report.stdout)
    );
    let markdown = text(&run("markdown").stdout);
    assert!(
        markdown.contains(title) && markdown.contains("| CBAR | 2 | 7 |\n| PBAR | 1 | 8 |"),
        "{markdown}"
    );
    let csv = text(&run("csv").stdout);
    assert!(
        csv.contains("ignored,CBAR,Cards,,2,\n") && csv.contains("ignored,PBAR,Cards,,1,\n"),
        "{csv}"
    );
    let json: Value = serde_json::from_slice(&run("json").stdout).expect("JSON");
    assert_eq!(json["not_read"][0], sentence);
    assert_eq!(json["not_read"].as_array().map(Vec::len), Some(2));
}

#[test]
fn a_card_of_a_set_that_is_not_selected_is_reported_as_such() {
    let reason = corfem::files::deck::Reason::NotSelected;
    let unread = corfem::files::deck::Unread {
        card: "MPC".into(),
        line: 7,
        count: 2,
        reason,
    };
    assert_eq!(
        corfem::present::tables::deck::not_read(&unread),
        "Not read: MPC (line 7, 2 cards), of a set that the first subcase does not select."
    );
}

/// The chain of [`BARS`] and another mass, as a deck, as Matrix Market and as DMIG.
#[test]
fn modes_of_matrices_are_those_of_their_deck() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let write = |name: &str, text: &str| std::fs::write(path(name), text).expect("written");
    write(
        "chain.dat",
        "GRID,1,,0.,0.,0.,,123\nGRID,2,,10.,0.,0.,,23\nGRID,3,,20.,0.,0.,,23\nCROD,1,1,1,2\nCROD,2,1,2,3\nPROD,1,1,.01\n\
         MAT1,1,1.+6,,.3\nCMASS2,7,.4,2,1\nCMASS2,8,.1,3,1\n",
    );
    let market = "%%MatrixMarket matrix coordinate real symmetric\n2 2";
    write(
        "k.mtx",
        &format!("{market} 3\n1 1 2000.\n2 1 -1000.\n2 2 1000.\n"),
    );
    write("m.mtx", &format!("{market} 2\n1 1 .4\n2 2 .1\n"));
    write(
        "both.pch",
        "DMIG,K,0,6,2,0\nDMIG,K,2,1,,2,1,2000.\nDMIG,K,2,1,,3,1,-1000.\nDMIG,K,3,1,,3,1,1000.\n\
         DMIG,M,0,6,2,0\nDMIG,M,2,1,,2,1,.4\nDMIG,M,3,1,,3,1,.1\n",
    );
    let modes = |arguments: &[&str]| {
        let output = corfem(&[&["modes", "-f", "json"], arguments].concat());
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        serde_json::from_slice::<Value>(&output.stdout).expect("JSON")
    };
    let matrices = |stiffness: &str, mass: &str| {
        modes(&["--stiffness", &path(stiffness), "--mass", &path(mass)])
    };
    let deck = modes(&[&path("chain.dat")]);
    let [plain, named] = [
        matrices("k.mtx", "m.mtx"),
        matrices("both.pch#K", "both.pch#M"),
    ];
    for found in [&plain, &named] {
        for (found, expected) in frequencies(found).iter().zip(frequencies(&deck)) {
            approx::assert_relative_eq!(*found, expected, max_relative = DECK_ROUNDING);
        }
        assert_eq!(frequencies(found).len(), 2);
        assert_eq!(
            found["units"],
            "the model's own units, hertz; errors are fractions"
        );
    }
    write("k.mtx", HARDLY_HELD);
    let weak = matrices("k.mtx", "m.mtx");
    let doubtful = weak["doubtful"][0].as_str().expect("a sentence");
    assert!(
        doubtful.starts_with("Free by 13 digits of the stiffness: 1; "),
        "{doubtful}"
    );
    let in_words = corfem(&[
        "modes",
        "--stiffness",
        &path("k.mtx"),
        "--mass",
        &path("m.mtx"),
    ]);
    assert!(text(&in_words.stdout).contains("Free by 13 digits of the stiffness: 1; "));
    assert_eq!(plain["doubtful"], serde_json::json!([]));
    assert_eq!(
        (&named["dof"], plain["dof"].as_array().map(Vec::len)),
        (&deck["dof"], Some(0))
    );
    let arguments = [
        "modes",
        "--stiffness",
        &path("k.mtx"),
        "--mass",
        &path("m.mtx"),
        "-c",
        "5",
    ];
    let report = corfem(&arguments);
    assert!(
        text(&report.stdout).contains("\nrow 1 "),
        "{}",
        text(&report.stdout)
    );
    assert_eq!(
        text(&report.stderr),
        "corfem: 5 modes asked for; all 1 of finite frequency are given\n"
    );
    for (arguments, said) in [
        (vec!["--stiffness", &path("k.mtx")], "--mass"),
        (vec!["--mass", &path("m.mtx")], "--stiffness"),
        (
            vec![
                &path("chain.dat")[..],
                "--stiffness",
                &path("k.mtx"),
                "--mass",
                &path("m.mtx"),
            ],
            "cannot be used with",
        ),
        (
            vec!["--stiffness", &path("no.mtx"), "--mass", &path("m.mtx")],
            "no.mtx (--stiffness",
        ),
        (
            vec![
                "--stiffness",
                &path("both.pch#K"),
                "--mass",
                &path("both.pch"),
            ],
            "the file has K, M",
        ),
        (vec![], "DECK"),
    ] {
        let refused = corfem(&[&["modes"], &arguments[..]].concat());
        assert_eq!(refused.status.code(), Some(2), "{arguments:?}");
        assert!(
            text(&refused.stderr).contains(said),
            "{}",
            text(&refused.stderr)
        );
    }
}
