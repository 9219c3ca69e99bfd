//! The plan of a factorization, and shares of elements that no theory of elasticity made.

use crate::common::fill::{self, Fill};
use crate::prelude::*;
use corfem::chain::rods;

/// A square net of membranes and rods in the plane, swept, with one edge held and every grid free in x and y.
fn net(cells: usize) -> Structure {
    let label = |i: usize, j: usize| 1 + i + (cells + 1) * j;
    let material = Material::isotropic(1.0e7, 0.3).unwrap();
    let place = |i: usize, j: usize| Vector3::new(i as f64 + 0.5 * j as f64, j as f64, 0.0);
    let all = || (0..=cells).flat_map(|j| (0..=cells).map(move |i| (i, j)));
    let grid = |(i, j)| Grid {
        label: label(i, j),
        position: place(i, j),
        constrained: [j == 0, j == 0, true],
    };
    let corners = |(i, j)| {
        vec![
            label(i, j),
            label(i + 1, j),
            label(i + 1, j + 1),
            label(i, j + 1),
        ]
    };
    let cells = all().filter(|at| at.0 < cells && at.1 < cells).map(corners);
    let element = |(row, grids)| Element {
        label: row + 1,
        kind: ElementKind::Membrane,
        grids,
        size: 0.1,
        material,
    };
    Structure::new(
        all().map(grid).collect(),
        cells.enumerate().map(element).collect(),
    )
    .unwrap()
}

/// A structure with its own elements.
fn of_structure(structure: Structure) -> (Structure, Vec<ElementMatrix>) {
    let elements = element_matrices(&structure).collect();
    (structure, elements)
}

/// The order in which a matrix is eliminated that couples what these elements do.
fn order_of(count: usize, elements: &[ElementMatrix]) -> Vec<usize> {
    let coupled = |element: &ElementMatrix| {
        let pairs = element.dof.iter();
        let pairs = pairs.flat_map(|&a| element.dof.iter().map(move |&b| (a, b)));
        pairs
            .filter(|(a, b)| a != b)
            .flat_map(|(a, b)| [(a, b, -1.0), (a, a, 1.0)])
            .collect_vec()
    };
    let ground = (0..count).map(|row| (row, row, 1.0));
    let entries = elements.iter().flat_map(coupled).chain(ground).collect();
    let matrix = SparseMatrix::new("net", count, count, entries).unwrap();
    Factor::new("net", &matrix).unwrap().order().to_vec()
}

fn fill_of(structure: &Structure) -> Fill {
    let elements = element_matrices(structure).collect_vec();
    let order = order_of(structure.free_dof().len(), &elements);
    let fill = fill::of_order(&order, &elements);
    // Dense blocks store zeros too.
    assert!(fill.needed <= fill.entries);
    fill
}

/// George (1973): by nested dissection the factor of an n × n net has of the order of n² log n entries, and n³ row by row. Between
/// 16 and 128 cells n² log n has the slope 2.3.
#[test]
fn fill_grows_as_nested_dissection_promises() {
    let cells = [16_usize, 32, 64, 128];
    let points: Vec<(f64, f64)> = cells
        .map(|n| (n as f64, fill_of(&net(n)).entries as f64))
        .to_vec();
    let found = log_log_slope(&points);
    assert!((found - 2.3).abs() <= FILL_ORDER, "{found}: {points:?}");
}

/// The same paper: the multiplications grow as n³, to which small nets come from below, where row by row they would as n⁴. The one
/// membrane of a net of one cell couples its four DOF, whose columns have four numbers and less.
#[test]
fn work_grows_as_nested_dissection_promises() {
    assert_eq!(fill_of(&net(1)).operations, 30.0);
    let points = [64_usize, 128].map(|n| (n as f64, fill_of(&net(n)).operations));
    let found = log_log_slope(&points);
    assert!((found - 3.0).abs() <= FILL_ORDER, "{found}: {points:?}");
}

/// How many entries the factor has when rows are eliminated one by one, as by hand: whatever a row is coupled to is coupled thereafter.
fn eliminated(order: &[usize], elements: &[ElementMatrix]) -> usize {
    let count = order.len();
    let mut coupled = vec![vec![false; count]; count];
    (0..count).for_each(|row| coupled[row][row] = true);
    for dof in elements.iter().map(|element| &element.dof) {
        dof.iter()
            .for_each(|&a| dof.iter().for_each(|&b| coupled[a][b] = true));
    }
    let mut entries = 0;
    for (at, &row) in order.iter().enumerate() {
        let later = order[at..].iter().copied();
        let below = later.filter(|&other| coupled[row][other]).collect_vec();
        entries += below.len();
        for &a in &below {
            below.iter().for_each(|&b| coupled[a][b] = true);
        }
    }
    entries
}

/// Springs between so many grids in a row, whose places say nothing of what is coupled.
fn network(count: usize, springs: &[(usize, usize)]) -> (Structure, Vec<ElementMatrix>) {
    let row = rods(&vec![1.0; count], [true, false]).unwrap();
    let one = element_matrices(&row).last().unwrap();
    let spring = |&(a, b): &(usize, usize)| ElementMatrix {
        dof: vec![a, b],
        ..one.clone()
    };
    (row, springs.iter().map(spring).collect())
}

/// A square net of such springs whose points are numbered at random.
fn shuffled_net(side: usize, draws: &mut Draws) -> Vec<(usize, usize)> {
    let mut label = (0..side * side).collect_vec();
    (1..label.len())
        .rev()
        .for_each(|at| label.swap(at, draws.below(at + 1)));
    let across = (0..side * side).filter(|at| at % side > 0);
    let across = across.map(|at| (label[at], label[at - 1])).collect_vec();
    let along = (side..side * side).map(|at| (label[at], label[at - side]));
    along.chain(across).collect()
}

/// A tree in which every point hangs on one of the three before it, and as many springs again between points not far from each other.
fn branches(count: usize, draws: &mut Draws) -> Vec<(usize, usize)> {
    let tree = (1..count)
        .map(|at| (at, at - 1 - draws.below(at.min(3))))
        .collect_vec();
    let more = (12..count).map(|at| (at, at - 1 - draws.below(12)));
    more.chain(tree).collect()
}

/// Entries of the factors of some meshes by the order of November 2026, which is always the same: the only thing a slip in it changes is
/// how many there are. [`eliminated`] counts each of them too.
const FILL: [(&str, usize); 9] = [
    ("wing of 1k", 109_467),
    ("slender wing", 8334),
    ("flat wing", 8115),
    ("net of 9", 3410),
    ("net of 22", 34_058),
    ("shuffled net", 3848),
    ("two shuffled nets", 962),
    ("branches", 2295),
    ("loops", 189),
];

#[test]
fn fill_is_what_the_cuts_of_nested_dissection_promise_and_elimination_by_hand_counts() {
    let of_wing = |bays: [usize; 3]| {
        let wing = Wing {
            bays,
            ..Wing::default()
        };
        of_structure(wing.structure().unwrap())
    };
    let mut draws = Draws(1973);
    let second =
        |springs: Vec<(usize, usize)>| springs.into_iter().map(|(a, b)| (100 + a, 100 + b));
    let loops = |count: usize| (0..count).map(move |at| (at, (at + 1) % count));
    let two = shuffled_net(10, &mut draws)
        .into_iter()
        .chain(second(shuffled_net(7, &mut draws)))
        .collect_vec();
    let rings = loops(40).chain(loops(25).map(|(a, b)| (40 + a, 40 + b)));
    let meshes = [
        of_wing(Wing::default().bays),
        of_wing([14, 2, 1]),
        of_wing([5, 6, 1]),
        of_structure(net(9)),
        of_structure(net(22)),
        network(400, &shuffled_net(20, &mut draws)),
        network(149, &two),
        network(300, &branches(300, &mut draws)),
        network(65, &rings.collect_vec()),
    ];
    let counted = FILL
        .iter()
        .zip(&meshes)
        .map(|((name, _), (structure, elements))| {
            let order = order_of(structure.free_dof().len(), elements);
            let needed = fill::of_order(&order, elements).needed;
            assert_eq!(needed, eliminated(&order, elements), "{name}");
            (*name, needed)
        });
    assert_eq!(counted.collect_vec(), FILL);
}

#[test]
fn a_factor_that_overflows_is_refused_by_its_row() {
    let coupled = vec![(0, 0, 1.0), (1, 1, 1.0), (0, 1, 1e200), (1, 0, 1e200)];
    let matrix = SparseMatrix::new("pair", 2, 2, coupled).unwrap();
    let error = Error::NotPositiveDefinite {
        what: "pair",
        row: 1,
    };
    assert_refused(Factor::new("pair", &matrix), error);
}

/// Nothing is exchanged: below a pivot that is round-off alone the third row is as wrong as that is small.
#[test]
fn a_factor_that_does_not_solve_its_own_matrix_is_refused() {
    let third = 1.0 / 3.0;
    let rows = [
        [1.0, third, 0.3],
        [third, third * third, 0.7],
        [0.3, 0.7, 1.0],
    ];
    let matrix = DMatrix::from_fn(3, 3, |row, column| {
        rows[row][column] + 1e-15 * f64::from(u8::from(row == 1 && column == 1))
    });
    assert!(matrix.clone().lu().is_invertible());
    let matrix = SparseMatrix::of_dense("weak", &matrix).unwrap();
    let Err(Error::Failed { what: "weak", why }) = Factor::new("weak", &matrix) else {
        panic!("it solves")
    };
    // How much of its loads the solution leaves, and how much is allowed.
    let numbers = why.split(' ').filter_map(|word| word.parse().ok());
    let numbers: Vec<f64> = numbers.collect();
    assert!(
        matches!(numbers[..], [residual, allowed] if residual > allowed),
        "{why}"
    );
}

#[test]
fn a_load_distribution_says_what_is_wrong_with_it() {
    let columns = |columns: &[Vec<(usize, f64)>]| {
        SparseMatrix::of_columns("load distribution", 3, columns).unwrap_err()
    };
    let refused = columns(&[vec![(0, 1.0)], vec![(3, 1.0)]]);
    assert_eq!(
        refused.to_string(),
        "rows of a matrix: 4 given or asked for; there must be 1 to 3"
    );
    let refused = columns(&[vec![(2, f64::NAN)]]);
    assert!(
        matches!(
            refused,
            Error::Value {
                what: "load distribution",
                ref owner,
                expected: "a finite number",
                ..
            } if owner == "entry (2, 0)"
        ),
        "{refused:?}"
    );
    let t = DMatrix::from_row_slice(3, 2, &[1.0, 0.0, 0.0, 0.0, 0.5, 2.0]);
    let sparse = SparseMatrix::of_dense("load distribution", &t).unwrap();
    assert_eq!(
        sparse.entries().collect_vec(),
        [(0, 0, 1.0), (2, 0, 0.5), (2, 1, 2.0)]
    );
    assert_eq!((sparse.dense(), sparse.rows()), (t, 3));
}

properties! {
    /// An element's share needs no theory of elasticity: matrices of another origin, indefinite ones among them, give B Kₑ Bᵗ,
    /// and all shares sum to K_D.
    #[test]
    fn shares_of_any_element_matrix_are_its_congruence(change in symmetric(12), strength in 0.0..0.02_f64) {
        let model = case_of(1).model()?;
        let units = model.element_matrices().iter().map(|element| {
            let count = element.dof.len();
            &element.unit + strength * element.unit.amax() * change.view((0, 0), (count, count))
        });
        let units = units.collect_vec();
        let model = model.with_unit_stiffness(units.clone())?;
        let ones = vec![1.0; model.parameters().len()];
        // Changes beyond what the structure bears are refused, and are not this property's matter.
        let Ok(matrices) = model.matrices(&ones) else { return Ok(()) };
        let b = model.condense(&ones)?.transformation;
        for (row, share) in matrices.shares.iter().enumerate() {
            let label = model.parameters()[row].elements[0];
            let at = model.structure().elements().iter().position(|element| element.label == label).unwrap();
            let rows = b.select_rows(&model.element_matrices()[at].dof);
            let expected = model.structure().elements()[at].size * rows.tr_mul(&(&units[at] * &rows));
            let scale = model.structure().elements()[at].size * units[at].amax() * rows.amax().powi(2);
            prop_assert!((share - expected).amax() <= MATRIX_ROUND_OFF * scale);
        }
    }
}
