//! The analysis by an external solver, played by small shell scripts: with the crate's elements it agrees to round-off, and however a run ends,
//! the error says so and nothing is left.

#![cfg(unix)]

use crate::common::fake_solver::{fake, output5, solver};
use crate::common::outer_loop::program::Matrices;
use crate::prelude::*;

/// What NASTRAN-95 would answer for a model if its elements were this crate's.
fn own_answer(model: &FiniteElementModel, factors: &[f64]) -> Matrices {
    let sizes = model.sizes(factors).unwrap();
    let structure = model.structure();
    let free = structure.free_dof();
    let mut order = (0..free.len()).collect_vec();
    order.sort_by_key(|&row| (free[row].grid, free[row].direction));
    let sorted = |matrix: &DMatrix<f64>| matrix.select_rows(&order).select_columns(&order);
    let kaa = assemble(model.element_matrices(), &sizes, free.len()).unwrap();
    let t = model.load_distribution();
    // Stiffness factors leave every element the mass of its first size.
    let maa = t * model.mass() * t.transpose() + DMatrix::from_diagonal(&lumped_mass(structure));
    // In KGG the elements stand by themselves after all grids, in the order of their numbers.
    let mut rows = (0..sizes.len()).collect_vec();
    rows.sort_by_key(|&row| structure.elements()[row].label);
    let mut start = 6 * (structure.grids().len() + t.ncols());
    let corners: usize = structure.corners().iter().map(Vec::len).sum();
    let mut kgg = zero_square(start + 6 * corners);
    for row in rows {
        let element = &structure.elements()[row];
        let unit = unit_stiffness(element.kind, &structure.corners()[row], &element.material);
        let places = (0..unit.nrows()).map(|dof| start + 6 * (dof / 3) + dof % 3);
        let places = places.collect_vec();
        for (a, &row_of) in places.iter().enumerate() {
            for (b, &column) in places.iter().enumerate() {
                kgg[(row_of, column)] = sizes[row] * unit[(a, b)];
            }
        }
        start += 6 * element.grids.len();
    }
    [("KGG", kgg), ("KAA", sorted(&kaa)), ("MAA", sorted(&maa))]
        .map(|(name, matrix)| (name.to_owned(), matrix))
        .into()
}

/// A solver that answers every deck with the same matrices.
fn answering(matrices: &Matrices) -> TempDir {
    let home = fake("cat \"$RFDIR/answer\" > \"$FTN15\"");
    let list = matrices.iter();
    let list = list.map(|(name, matrix)| (name.as_str(), matrix));
    fs::write(home.path().join("rf/answer"), output5(&list.collect_vec())).unwrap();
    home
}

/// The box of Case 3 with its grids and elements in reverse, and one element that has mass of its own.
fn reversed() -> FiniteElementModel {
    let first = case_of(3).model().unwrap();
    let old = first.structure();
    let mut elements = old.elements().iter().rev().cloned().collect_vec();
    elements[0].material.density = 1e-4;
    let grids = old.grids().iter().rev().cloned().collect();
    let structure = Structure::new(grids, elements).unwrap();
    let rows = structure.free_dof().iter();
    let rows = rows.map(|own| old.free_dof_index(own.grid, own.direction).unwrap());
    let t = first.load_distribution().select_rows(&rows.collect_vec());
    let (mass, parameters) = (first.mass().clone(), first.parameters().to_vec());
    FiniteElementModel::new(structure, t, mass, parameters).unwrap()
}

const FACTORS: [f64; PANEL_COUNT] = [
    0.8, 0.85, 0.9, 0.95, 1.0, 1.05, 1.1, 1.15, 1.2, 1.25, 1.3, 1.35, 1.4, 1.45, 1.5,
];

#[test]
fn a_solver_with_the_crates_elements_gives_the_crates_analysis() {
    let [one, three] = [1, 3].map(|number| case_of(number).model().unwrap());
    for model in [one, three, reversed()] {
        let home = answering(&own_answer(&model, &FACTORS));
        let found = solver(&home).elements(&model, &FACTORS).unwrap();
        let [found, expected] = [&found, &model].map(|own| {
            let own = own.matrices(&FACTORS).unwrap();
            [vec![own.stiffness, own.mass], own.shares].concat()
        });
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found - expected).amax() <= MATRIX_ROUND_OFF * expected.amax());
        }
    }
}

/// Differences below the limits are single precision.
#[test]
fn an_answer_to_another_question_is_refused() {
    let model = reversed();
    let good = own_answer(&model, &FACTORS);
    for (name, part, words) in [
        (
            "KAA",
            2e-9,
            "NASTRAN-95: KAA is 2.0e-9 of its largest entry off the sum of its element matrices, more than 1e-9",
        ),
        (
            "MAA",
            -2e-6,
            "NASTRAN-95: MAA is 2.0e-6 of its largest entry off the masses the MPC equations distribute, more than 1e-6",
        ),
        ("KAA", 0.5e-9, "an answer"),
        ("MAA", 0.5e-6, "an answer"),
    ] {
        let mut answer = good.clone();
        let matrix = answer.get_mut(name).unwrap();
        matrix[(0, 0)] += part * matrix.amax();
        let answered = solver(&answering(&answer)).elements(&model, &FACTORS);
        assert_eq!(said(answered), words);
    }
}

#[test]
fn the_deck_of_an_analysis_has_every_element_twice() {
    let home = fake("cat > \"$RFDIR/deck\"");
    let refused = said(solver(&home).elements(&reversed(), &FACTORS));
    assert!(refused.contains("nothing was written"), "{refused}");
    let text = fs::read_to_string(home.path().join("rf/deck")).unwrap();
    assert!(text.contains("OUTPUT5 KGG,KAA,MAA,,//-1/15/*CORFEM*/1 $\nEXIT $\nENDALTER\n"));
    let read = read_deck(text).unwrap().model;
    let at = |label: &usize| read.grids.iter().find(|own| own.label == *label).unwrap();
    let (once, twice) = read.elements.split_at(read.elements.len() / 2);
    let mut own = BTreeSet::new();
    for (one, other) in once.iter().zip(twice) {
        let of = |own: &Element| (own.kind, own.size, own.material);
        assert_eq!(of(one), of(other));
        for (a, b) in one.grids.iter().zip(&other.grids) {
            assert_eq!(at(a).position, at(b).position);
            assert!(own.insert(b) && at(b).constrained == [true; 3]);
        }
    }
}

#[test]
fn no_run_leaves_anything_behind() {
    for (script, message) in [
        ("exit 0", "nothing was written on Fortran unit 15"),
        (
            "touch a b; mkdir -p c/d; touch c/d/e; exit 9",
            "exit status: 9",
        ),
        (
            "echo ' *** USER FATAL MESSAGE 3'",
            "input: USER FATAL MESSAGE 3",
        ),
        (
            "echo rubbish > \"$FTN15\"; echo rubbish >> \"$FTN15\"",
            "OUTPUT5 file, line 2: \"rubbish\" is not a line of integers",
        ),
    ] {
        let home = fake(&format!("pwd > \"$RFDIR/place\"; {script}"));
        let refused = said(solver(&home).matrices("CEND\n", 10));
        assert!(
            refused.starts_with("NASTRAN-95") && refused.contains(message),
            "{refused}"
        );
        let place = fs::read_to_string(home.path().join("rf/place")).unwrap();
        assert!(!Path::new(place.trim()).exists(), "{script}");
    }
}

#[test]
fn a_file_of_module_output5_is_read_or_refused_by_line() {
    let good = include_str!("../../golden/nastran95/output5_rod.txt");
    let kgg = &read_output5(good, 144).unwrap()["KGG"];
    assert_eq!(
        (kgg.shape(), kgg[(0, 0)]),
        ((12, 12), 0.201_881_637_294_121_43e5)
    );
    assert_eq!(kgg, &kgg.transpose());
    let few = said(read_output5(good, 143));
    assert!(
        few.contains("a matrix within the 143 entries of all"),
        "{few}"
    );
    for (line, text, words) in [
        (2, "  x", "a line of integers"),
        (
            2,
            "       1       1       1",
            "the header that precedes a matrix's columns",
        ),
        (
            4,
            "      13       1       9",
            "a column and rows within the matrix",
        ),
        (
            5,
            "",
            "a line of the column's reals in format D26.17 is missing",
        ),
        (5, "   0.20188163729412143X+05", "format D26.17"),
    ] {
        let mut lines = good.lines().collect_vec();
        lines[line - 1] = text;
        let refused = said(read_output5(&lines.join("\n"), 144));
        let start = format!("NASTRAN-95: OUTPUT5 file, line {line}: ");
        assert!(
            refused.starts_with(&start) && refused.contains(words),
            "{refused}"
        );
    }
}
