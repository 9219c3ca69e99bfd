//! Models of a job that are matrices: which row is which grid and direction, and mistakes in saying so.

use crate::common::jobs::said;
use crate::prelude::*;

#[test]
fn rows_of_matrices_are_a_table_of_grids_and_directions() {
    let wrong = "is not a line of grid, direction and perhaps x, y, z";
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
        assert_eq!(error, format!("rows.csv, line 3: \"{line}\" {wrong}"));
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
        prepare(&path)
            .unwrap_or_else(|error| panic!("{error}"))
            .loaded
            .source
            .motions
            .len(),
        10
    );
    let short = said(&with(building(), "rows.csv", "2,x,0.,0.,240\n", ""));
    assert_eq!(
        short,
        "job.toml: model.rows has 9 rows, but the stiffness 10"
    );
    let twice = said(&with(
        building(),
        "rows.csv",
        "2,x,0.,0.,240",
        "1,x,0.,0.,120",
    ));
    assert!(
        twice.contains("rows 1 and 2 of the matrices have the same grid and direction"),
        "{twice}"
    );
    let none = said(&with(building(), "job.toml", "rows = \"rows.csv\"", ""));
    assert_eq!(
        none,
        "job.toml: model.rows is missing: these matrices do not name their rows"
    );
    let story = "matrix = \"story_1.mtx\"";
    for rule in ["", "matrix = \"story_1.mtx\"\nelements = [1]"] {
        let error = said(&with(building(), "job.toml", story, rule));
        assert_eq!(
            error,
            "job.toml: parameter \"story 1\" needs a matrix, or a whole stiffness or mass with the factor at that it has there, and no \
             entry of a deck"
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
    let prepared = prepare(&path).unwrap_or_else(|error| panic!("{error}"));
    let (_, mass) = prepared.loaded.source.whole.at(&[1.0]).expect("matrices");
    assert_eq!(
        mass.entries().collect::<Vec<_>>(),
        [(1, 1, 2.0), (2, 2, 3.0)],
        "grid 2 has none"
    );
    let stranger = said(&named_matrices(&[(3, 1.0), (9, 1.0)]));
    assert_eq!(
        stranger,
        "job.toml: model.pch#MAAX: the stiffness has no row of grid 9, component 1"
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
        "job.toml: model.pch#KAAX: rows and columns have different names"
    );
    let unknown = said(&with(
        named_matrices(&[(4, 1.0)]),
        "job.toml",
        "#KONE",
        "#KTWO",
    ));
    assert!(
        unknown.contains("model.pch, line 1") && unknown.contains("the file has KAAX, KONE, MAAX"),
        "{unknown}"
    );
    let ambiguous = said(&with(named_matrices(&[(4, 1.0)]), "job.toml", "#KONE", ""));
    assert!(
        ambiguous.contains("the file has KAAX, KONE, MAAX"),
        "{ambiguous}"
    );
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
    let source = prepare(&path)
        .unwrap_or_else(|error| panic!("{error}"))
        .loaded
        .source
        .clone();
    let (_, mass) = source.whole.at(&[1.0; 10]).expect("matrices");
    assert_eq!(
        mass.entries()
            .collect::<Vec<_>>()
            .iter()
            .map(|entry| entry.2)
            .collect::<Vec<_>>(),
        [70., 69., 68., 67., 66., 65., 64., 63., 62., 61.]
    );
}

/// Both are direction x of their grid here: their entries would add up.
#[test]
fn labels_that_fall_on_one_row_are_an_error_in_every_matrix() {
    let with_scalar = |name: &str| {
        let more = format!("DMIG,{name},2,0,,2,0,.1\n");
        let mut files = named_matrices(&[(4, 1.0), (2, 1.0)]);
        let deck = files
            .iter_mut()
            .find(|(name, _)| name == "model.pch")
            .expect("a deck");
        deck.1 += &more;
        said(&files)
    };
    for name in ["KAAX", "KONE", "MAAX"] {
        assert_eq!(
            with_scalar(name),
            format!(
                "job.toml: model.pch#{name}: components 0 and 1 of grid 2 are one degree of freedom, and the matrix has both"
            )
        );
    }
}

#[test]
fn the_table_of_rows_has_its_titles_in_order_and_one_place_for_a_grid() {
    let wrong = "is not a line of grid, direction and perhaps x, y, z";
    for titles in ["grid,direction,z,y,x", "grid,component", "grid,direction,x"] {
        let error = said(&with(
            building(),
            "rows.csv",
            "grid,direction,x,y,z",
            titles,
        ));
        assert_eq!(error, format!("rows.csv, line 1: \"{titles}\" {wrong}"));
    }
    let moved = with(building(), "rows.csv", "2,x,0.,0.,240", "1,y,0.,0.,240");
    assert_eq!(
        said(&moved),
        "rows.csv, line 3: grid 1 was given at another place before"
    );
}
