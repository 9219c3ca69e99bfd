//! The analysis by an external solver whose elements are the crate's own, so that it must agree to round-off.

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
    let t = &model.load_distribution().clone();
    // Stiffness factors leave every element the mass of its first size.
    let lumped = DMatrix::from_diagonal(&lumped_mass(structure));
    let maa = t * model.mass() * t.transpose() + lumped;
    // In KGG the elements stand by themselves after all grids, in the order of their numbers.
    let mut rows = (0..structure.elements().len()).collect_vec();
    rows.sort_by_key(|&row| structure.elements()[row].label);
    let corners: usize = structure
        .elements()
        .iter()
        .map(|element| element.grids.len())
        .sum();
    let mut start = 6 * (structure.grids().len() + t.ncols());
    let mut kgg = DMatrix::zeros(start + 6 * corners, start + 6 * corners);
    for row in rows {
        let element = &structure.elements()[row];
        let unit = unit_stiffness(element.kind, &structure.corners()[row], &element.material);
        for (a, b) in (0..unit.nrows()).flat_map(|a| (0..unit.nrows()).map(move |b| (a, b))) {
            let place = |dof: usize| start + 6 * (dof / 3) + dof % 3;
            kgg[(place(a), place(b))] = sizes[row] * unit[(a, b)];
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
    let list = matrices
        .iter()
        .map(|(name, matrix)| (name.as_str(), matrix))
        .collect_vec();
    fs::write(home.path().join("rf/answer"), output5(&list)).unwrap();
    home
}

fn assert_same(found: &DynamicModel, expected: &DynamicModel) {
    let same = |a: &DMatrix<f64>, b: &DMatrix<f64>| {
        assert_relative_eq!(a, b, epsilon = MATRIX_ROUND_OFF * b.amax())
    };
    same(&found.stiffness, &expected.stiffness);
    same(&found.mass, &expected.mass);
    assert_eq!(found.shares.len(), expected.shares.len());
    for (a, b) in found.shares.iter().zip(&expected.shares) {
        same(a, b);
    }
}

#[test]
fn a_solver_with_the_crates_elements_gives_the_crates_analysis() {
    for number in [1, 3] {
        let model = case_of(number).model().unwrap();
        let factors = (0..15).map(|row| 0.8 + f64::from(row) / 20.0).collect_vec();
        let home = answering(&own_answer(&model, &factors));
        let found = solver(&home)
            .elements(&model, &factors)
            .and_then(|model| Ok(model.matrices(&factors)?))
            .unwrap();
        assert_same(&found, &model.matrices(&factors).unwrap());
    }
}

#[test]
fn elements_and_grids_in_any_order_find_their_matrices() {
    // Grids and elements as they come, not by number; one element has mass of its own.
    let model = disordered();
    let factors = [1.5, 0.5];
    let home = answering(&own_answer(&model, &factors));
    let found = solver(&home)
        .elements(&model, &factors)
        .and_then(|model| Ok(model.matrices(&factors)?))
        .unwrap();
    assert_same(&found, &model.matrices(&factors).unwrap());
}

/// A frame of three rods and a triangle on grids 7, 3, 9, 5 with z at two dynamic points.
pub fn disordered() -> FiniteElementModel {
    let grid = |label, position: [f64; 3], constrained| Grid {
        label,
        position: position.into(),
        constrained: [constrained; 3],
    };
    let light = Material::isotropic(1e7, 0.3).unwrap();
    let heavy = Material {
        density: 1e-4,
        ..light
    };
    let element = |label, kind, grids: &[usize], material| Element {
        label,
        kind,
        grids: grids.to_vec(),
        size: 0.1,
        material,
    };
    let structure = Structure::new(
        vec![
            grid(7, [0.0, 0.0, 4.0], false),
            grid(3, [5.0, 0.0, 0.0], true),
            grid(9, [-3.0, 4.0, 0.0], true),
            grid(5, [-3.0, -4.0, 0.0], true),
            grid(1, [1.0, 1.0, 8.0], false),
        ],
        vec![
            element(40, ElementKind::Rod, &[7, 3], light),
            element(4, ElementKind::Rod, &[9, 7], heavy),
            element(12, ElementKind::Triangle, &[5, 7, 9], light),
            element(2, ElementKind::Rod, &[1, 3], light),
            element(8, ElementKind::Rod, &[1, 9], light),
            element(6, ElementKind::Rod, &[5, 1], light),
        ],
    )
    .unwrap();
    let mut t = DMatrix::zeros(6, 2);
    t[(2, 0)] = 1.0;
    t[(5, 1)] = 0.5;
    t[(3, 1)] = 0.25;
    let mass = diagonal([0.5, 0.25]);
    FiniteElementModel::new(
        structure,
        t,
        mass,
        vec![
            Parameter::new(40, &[40]),
            Parameter::new("others", &[4, 12, 6]),
        ],
    )
    .unwrap()
}

#[test]
fn an_answer_to_another_question_is_refused() {
    let model = disordered();
    let good = own_answer(&model, &[1.0, 1.0]);
    let refused = |change: &dyn Fn(&mut Matrices)| {
        let mut answer = good.clone();
        change(&mut answer);
        let answered = solver(&answering(&answer)).elements(&model, &[1.0, 1.0]);
        answered.expect_err("another answer").to_string()
    };
    let entry = |name: &'static str, part: f64| {
        move |answer: &mut Matrices| {
            let matrix = answer.get_mut(name).unwrap();
            let largest = matrix.amax();
            matrix[(0, 0)] += part * largest;
        }
    };
    assert_eq!(
        refused(&entry("KAA", 2e-9)),
        "NASTRAN-95: KAA is 2.0e-9 of its largest entry off the sum of its element matrices, more than 1e-9"
    );
    assert_eq!(
        refused(&entry("MAA", -2e-6)),
        "NASTRAN-95: MAA is 2.0e-6 of its largest entry off the masses the MPC equations distribute, more than 1e-6"
    );
    assert_eq!(
        refused(&|answer| drop(answer.remove("MAA"))),
        "NASTRAN-95: matrix MAA is missing; the model has 6 rows and columns"
    );
    let size = 6 * (5 + 2 + 13);
    assert_eq!(
        refused(&|answer| drop(answer.insert("KGG".into(), DMatrix::identity(12, 13)))),
        format!("NASTRAN-95: matrix KGG is 12 x 13; the model has {size} rows and columns")
    );
    // Differences below the limits are single precision.
    for change in [entry("KAA", 0.5e-9), entry("MAA", 0.5e-6)] {
        let mut answer = good.clone();
        change(&mut answer);
        assert!(
            solver(&answering(&answer))
                .elements(&model, &[1.0, 1.0])
                .is_ok()
        );
    }
    assert!(matches!(
        BulkData::from_model(&model, &[1.0, 1.0], &[]),
        Err(FileError::Method(Error::WrongShape {
            what: "positions of dynamic points",
            expected_rows: 2,
            rows: 0,
            ..
        }))
    ));
}
