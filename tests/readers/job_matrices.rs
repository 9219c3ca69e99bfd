//! Models of a job that are matrices: which row is which grid and direction, and mistakes in saying so.

use crate::common::jobs::{placed, said};
use crate::prelude::*;
use crate::readers::job_unseen::{self, chain};
use corfem::job::LoadedJob;

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
    let mut files = rods_with("deck = \"model.bdf\"", model);
    files[0].1 = files[0].1.split("[[parameter]]").next().unwrap().to_owned()
        + "[[parameter]]\nname = \"a\"\nmatrix = \"model.pch#KONE\"\n";
    files.push((
        "model.pch".to_owned(),
        header("KAAX") + &chain + &first + &header("MAAX") + &mass,
    ));
    files
}

#[test]
fn matrices_that_name_their_rows_are_put_into_the_order_of_the_stiffness() {
    let prepared = prepared(&named_matrices(&[(4, 3.0), (3, 2.0)]));
    let (_, mass) = prepared.loaded.source.whole.at(&[1.0]).unwrap();
    assert_eq!(
        mass.entries().collect_vec(),
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
    let source = prepared(&files).loaded.source.clone();
    let (_, mass) = source.whole.at(&[1.0; 10]).unwrap();
    assert_eq!(
        mass.entries()
            .collect_vec()
            .iter()
            .map(|entry| entry.2)
            .collect_vec(),
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
            .unwrap();
        deck.1 += &more;
        said(&files)
    };
    for name in ["KAAX", "KONE", "MAAX"] {
        assert_eq!(
            with_scalar(name),
            format!("job.toml: model.pch#{name}: rows 1 and 2 have the same grid and direction")
        );
    }
}

#[test]
fn a_matrix_of_another_size_is_named_with_its_own() {
    let other = "%%MatrixMarket matrix coordinate real general\n3 2 1\n1 1 1.0\n";
    for (name, entry, wanted) in [
        ("stiffness.mtx", "model.stiffness", 3),
        ("mass.mtx", "model.mass", 10),
        ("story_7.mtx", "parameter \"story 7\"", 10),
    ] {
        let mut files = building();
        *file(&mut files, name) = other.to_owned();
        let words = format!("{name} ({entry}) is 3 x 2; it must be {wanted} x {wanted}");
        assert_eq!(said(&files), format!("job.toml: {words}"));
    }
}

#[test]
fn a_number_without_a_square_is_refused_by_its_place() {
    for value in ["nan", "inf", "-inf", "1.e200", "-1.0e155"] {
        let heading = "%%MatrixMarket matrix coordinate real general\n1 1 1\n";
        for text in [
            format!("{heading}1 1 {value}\n"),
            format!("** of a part\n1,1,1,1,1.0\n1,2,1,2,{value}\n"),
            format!("$ of a part\nDMIG,K,0,6,1\nDMIG,K,1,1,,1,1,{value}\n"),
        ] {
            let mut files = building();
            *file(&mut files, "mass.mtx") = text;
            let error = said(&files);
            let is_placed = match value.contains("e") {
                true => error.contains("mass.mtx: ") && error.contains(" row "),
                false => error.starts_with("mass.mtx, line 3: "),
            };
            assert!(is_placed, "{error}");
        }
        let test = format!("frequency_hz,,1.0\nname,direction,mode 1\na,x,1.0\nb,x,{value}\n");
        let error = test_data::read("t", test.as_bytes()).unwrap_err();
        assert!(error.to_string().starts_with("t, line 4: "), "{error}");
    }
}

/// The law: a job of its own corrected matrices has K(s) and M(s), parts that no sensor sees among them: bit for bit in the format of the
/// Matrix Market, to the last digit of a field as DMIG.
#[test]
fn corrected_matrices_read_back_as_those_at_the_factors() {
    for seed in 0..6 {
        let mut draws = Draws(seed);
        let unseen = (vec![(0, None, 1e6), (1, Some(0), 1e6)], vec![1.0, 2.0]);
        let (mut files, within) = match seed % 2 {
            0 => (
                job_unseen::files(&chain(&mut draws), &unseen, 0.0, &mut draws),
                0.0,
            ),
            _ => (named_matrices(&[(4, 3.0), (3, 2.0)]), FIELD_ROUNDING),
        };
        let load = |files: &Files| {
            let (_folder, path) = placed(files);
            LoadedJob::new(&path).unwrap()
        };
        let first = load(&files);
        let factors = first
            .parameter_names()
            .map(|_| draws.between(0.5, 2.0))
            .collect_vec();
        let (stiffness, mass) = first.source.all.at(&factors).unwrap();
        for (name, bytes) in first.corrected_model(&factors).unwrap() {
            files.retain(|own| own.0 != name);
            files.push((name, String::from_utf8(bytes).unwrap()));
        }
        let job = files[0].1.replace("model.pch#KAAX", "stiffness.pch");
        files[0].1 = job.replace("model.pch#MAAX", "mass.pch");
        let again = load(&files)
            .source
            .all
            .at(&vec![1.0; factors.len()])
            .unwrap();
        for (read, wanted) in [(again.0, stiffness), (again.1, mass)] {
            let (read, wanted) = (read.dense(), wanted.dense());
            assert_eq!(read.shape(), wanted.shape());
            for (read, wanted) in read.iter().zip(&wanted) {
                assert!((read - wanted).abs() <= within * wanted.abs(), "{read}");
            }
        }
    }
}
