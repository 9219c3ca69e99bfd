//! Models of a job that are matrices: which row is which grid and direction, and mistakes in saying so.

use super::job_errors::{placed, said, with};
use crate::common::jobs::{Files, building, rods};
use corfem::job::Prepared;

#[test]
fn rows_of_matrices_are_a_table_of_grids_and_directions() {
    let wrong = "rows.csv: expected lines of grid, direction and perhaps x, y, z, found line 3: ";
    for line in [
        "2",
        "2,q",
        "x,x",
        "2,x,1.",
        "2,x,0.,a,0.,0.",
        "2,x,,0.,0.,240",
        "2,x,0.,0.,inf",
        "-2,x",
    ] {
        let error = said(&with(building(), "rows.csv", "2,x,0.,0.,240", line));
        assert_eq!(error, format!("{wrong}{line}"));
    }
    // As a spreadsheet may write it, with a remark.
    let mark = with(
        building(),
        "rows.csv",
        "grid,direction",
        "\u{feff}\"grid\",direction",
    );
    let (_folder, path) = placed(&with(
        mark,
        "rows.csv",
        "2,x,",
        "\n# the second floor\n2,x,",
    ));
    assert_eq!(
        Prepared::new(&path)
            .unwrap_or_else(|error| panic!("{error}"))
            .source
            .motions
            .len(),
        10
    );
    let short = said(&with(building(), "rows.csv", "2,x,0.,0.,240\n", ""));
    assert_eq!(
        short,
        "job.toml: expected 10 rows in model.rows, one a row of the stiffness, found 9"
    );
    let twice = said(&with(
        building(),
        "rows.csv",
        "2,x,0.,0.,240",
        "1,x,0.,0.,240",
    ));
    assert!(
        twice.contains("expected every grid and direction in one row of the matrices"),
        "{twice}"
    );
    let none = said(&with(building(), "job.toml", "rows = \"rows.csv\"", ""));
    assert_eq!(
        none,
        "job.toml: expected model.rows for matrices that do not name their rows, found none"
    );
    let story = "matrix = \"story_1.mtx\"";
    for (rule, found) in [
        ("", "no matrix"),
        (
            "matrix = \"story_1.mtx\"\nelements = [1]",
            "entries of a deck",
        ),
    ] {
        let error = said(&with(building(), "job.toml", story, rule));
        assert_eq!(
            error,
            format!(
                "job.toml: expected a matrix, and nothing of a deck, in parameter story 1, found {found}"
            )
        );
    }
}

/// DMIG of the chain of the rods: the stiffness names its rows in ascending order, the mass misses one.
fn named_matrices(mass: &[(usize, f64)]) -> Files {
    let card = |name: &str, a: usize, b: usize, value: f64| {
        format!("DMIG,{name},{a},1,,{b},1,{value:?}\n")
    };
    let header = |name: &str| format!("DMIG,{name},0,6,2,0\n");
    let chain: String = (2..=4)
        .rev()
        .flat_map(|grid| {
            let own = card("KAAX", grid, grid, if grid < 4 { 2e4 } else { 1e4 });
            [
                Some(own),
                (grid > 2).then(|| card("KAAX", grid - 1, grid, -1e4)),
            ]
            .into_iter()
            .flatten()
        })
        .collect();
    let first = header("KONE") + &card("KONE", 2, 2, 1e4);
    let mass = mass
        .iter()
        .map(|&(grid, value)| card("MAAX", grid, grid, value))
        .collect::<String>();
    let model = "stiffness = \"model.pch#KAAX\"\nmass = \"model.pch#MAAX\"";
    let mut files = with(rods(), "job.toml", "deck = \"model.bdf\"", model);
    files[0].1 = files[0]
        .1
        .split("[[parameter]]")
        .next()
        .expect("a beginning")
        .to_owned()
        + "[[parameter]]\nname = \"a\"\nmatrix = \"model.pch#KONE\"\n";
    files.push((
        "model.pch".to_owned(),
        header("KAAX") + &chain + &first + &header("MAAX") + &mass,
    ));
    files
}

#[test]
fn matrices_that_name_their_rows_are_put_into_the_order_of_the_stiffness() {
    let (_folder, path) = placed(&named_matrices(&[(4, 3.0), (3, 2.0)]));
    let prepared = Prepared::new(&path).unwrap_or_else(|error| panic!("{error}"));
    let (_, mass) = prepared.source.whole.at(&[1.0]).expect("matrices");
    assert_eq!(
        mass.entries(),
        [(1, 1, 2.0), (2, 2, 3.0)],
        "grid 2 has none"
    );
    let stranger = said(&named_matrices(&[(3, 1.0), (9, 1.0)]));
    assert_eq!(
        stranger,
        "job.toml: expected rows of the stiffness in model.pch#MAAX, found grid 9 component 1"
    );
    let columns = with(
        named_matrices(&[(4, 1.0)]),
        "model.pch",
        "KAAX,0,6",
        "KAAX,0,2",
    );
    let others = said(&with(
        columns,
        "model.pch",
        "DMIG,KAAX,4,1,,4,1",
        "DMIG,KAAX,5,1,,4,1",
    ));
    assert_eq!(
        others,
        "job.toml: expected rows and columns of the same names in model.pch#KAAX, found others"
    );
    let unknown = said(&with(
        named_matrices(&[(4, 1.0)]),
        "job.toml",
        "#KONE",
        "#KTWO",
    ));
    assert!(
        unknown.contains("model.pch, line 1") && unknown.contains("found KAAX, KONE, MAAX"),
        "{unknown}"
    );
    let ambiguous = said(&with(named_matrices(&[(4, 1.0)]), "job.toml", "#KONE", ""));
    assert!(ambiguous.contains("found KAAX, KONE, MAAX"), "{ambiguous}");
}

/// Matrices without names of their own beside one with: the table of rows gives the order of both.
#[test]
fn a_table_of_rows_orders_matrices_that_name_theirs() {
    let dmig: String = (1..=10)
        .map(|grid| format!("DMIG,M,{grid},1,,{grid},1,{:?}\n", 60.0 + grid as f64))
        .collect();
    let mut files = with(building(), "job.toml", "mass.mtx", "mass.pch");
    let rows: String = (1..=10).rev().map(|row| format!("{row},x\n")).collect();
    files
        .iter_mut()
        .filter(|(name, _)| name == "rows.csv")
        .for_each(|(_, text)| text.clone_from(&rows));
    files.push(("mass.pch".to_owned(), format!("DMIG,M,0,6,2,0\n{dmig}")));
    let (_folder, path) = placed(&files);
    let source = Prepared::new(&path)
        .unwrap_or_else(|error| panic!("{error}"))
        .source;
    let (_, mass) = source.whole.at(&[1.0; 10]).expect("matrices");
    assert_eq!(
        mass.entries()
            .iter()
            .map(|entry| entry.2)
            .collect::<Vec<_>>(),
        [70., 69., 68., 67., 66., 65., 64., 63., 62., 61.]
    );
}
