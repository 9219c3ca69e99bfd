//! Digits of matrices: what they leave open is said, and nothing else changes.

use crate::common::draws::Draws;
use crate::prelude::*;
use corfem::job::matrix_modes;
use corfem::sparse::whole_modes::WholeModes;

/// Stiffness and mass of a beam with a length of one, the stiffness and mass of every element drawn: their entries are rounded independently.
fn beam(draws: &mut Draws, elements: usize, is_held: bool) -> [DMatrix<f64>; 2] {
    let h = 1.0 / elements as f64;
    let turned = [1.0, h, 1.0, h];
    let own = [
        (
            [12., 6., -12., 6., 4., -6., 2., 12., -6., 4.],
            1e4 / h.powi(3),
        ),
        (
            [156., 22., 54., -13., 4., 13., -3., 156., -22., 4.],
            h / 42.0,
        ),
    ];
    own.map(|(upper, scale)| {
        let mut whole = DMatrix::zeros(2 * elements + 2, 2 * elements + 2);
        for element in 0..elements {
            let scale = scale * draws.between(1.0, 2.0);
            let places = (0..4).flat_map(|i| (i..4).map(move |j| (i, j)));
            for ((i, j), value) in places.zip(upper) {
                let value = scale * value * turned[i] * turned[j];
                whole[(2 * element + i, 2 * element + j)] += value;
                if i != j {
                    whole[(2 * element + j, 2 * element + i)] += value;
                }
            }
        }
        let held = if is_held { 2 } else { 0 };
        whole.view_range(held.., held..).into_owned()
    })
}

/// The modes of matrices in files with such numbers.
fn modes(pencil: &[DMatrix<f64>; 2], write: impl Fn(f64) -> String, zeros: bool) -> WholeModes {
    let folder = new_folder();
    let [stiffness, mass] = ["k.mtx", "m.mtx"].map(|name| folder.path().join(name));
    for (path, matrix) in [&stiffness, &mass].into_iter().zip(pencil) {
        let size = matrix.nrows();
        let places = (0..size).flat_map(|j| (j..size).map(move |i| (i, j)));
        let places = places
            .filter(|&at| zeros || matrix[at] != 0.0)
            .collect_vec();
        let mut text = "%%MatrixMarket matrix coordinate real symmetric\n".to_owned();
        text += &format!("{size} {size} {}\n", places.len());
        for (i, j) in places {
            text += &format!("{} {} {}\n", i + 1, j + 1, write(matrix[(i, j)]));
        }
        fs::write(path, text).unwrap();
    }
    matrix_modes(&stiffness, &mass, 3).unwrap()
}

fn is_not_told(found: &WholeModes) -> bool {
    format!("{:?}", found.doubtful).contains("ByDigits")
}

/// At seventeen digits and fewer, with decimals instead, held and free: a motion is listed, or said to be open, and never said to be free of
/// a beam that is held; a listed frequency is that of all digits within four of the deviations that are said.
#[test]
fn digits_leave_modes_as_they_are_or_say_so() {
    let mut draws = Draws(1);
    let mut told = 0;
    for at in 0..6 {
        let (elements, is_held) = ([6, 14, 30][at / 2], at % 2 == 0);
        let pencil = beam(&mut draws, elements, is_held);
        let exact = modes(&pencil, |value| format!("{value:.16e}"), false);
        let exact = exact.modes.frequencies_hz();
        for digits in [17, 12, 10, 8, 7, 5, 0] {
            let write = |value: f64| match digits {
                0 => format!("{value:.6}"),
                _ => format!("{value:.*e}", digits - 1),
            };
            let found = modes(&pencil, write, false);
            let case = format!("{elements} {is_held} {digits}");
            told += usize::from(is_not_told(&found));
            let free = if is_held { 0 } else { 2 };
            assert!(found.rigid_body == free || is_not_told(&found), "{case}");
            let skipped = found.rigid_body - free.min(found.rigid_body);
            let listed = found.modes.frequencies_hz();
            for ((own, open), exact) in listed.iter().zip(&found.open).zip(&exact[skipped..]) {
                let off = (own / exact - 1.0).abs();
                assert!(off <= 4.0 * open + 1e-6, "{case}: {off} {open}");
            }
        }
    }
    assert!(told > 5, "{told}");
}

/// Rounding of beams that are drawn: half a unit of the last of n digits is a part of a number that falls to a tenth of the said one
/// where its first digits are 9.99, and so is the root of the mean square by which the first frequency is off.
#[test]
fn open_frequencies_are_deviations_of_what_rounding_does() {
    let mut draws = Draws(2);
    let mut of = || {
        let pencil = beam(&mut draws, 12, true);
        let [exact, rounded] =
            [16, 6].map(|digits| modes(&pencil, |value| format!("{value:.digits$e}"), false));
        let off = rounded.modes.frequencies_hz()[0] / exact.modes.frequencies_hz()[0] - 1.0;
        (off / rounded.open[0]).powi(2)
    };
    let mean = (0..60).map(|_| of()).sum::<f64>() / 60.0;
    assert!((0.1..1.0).contains(&mean.sqrt()), "{mean}");
}

#[test]
fn zeros_that_are_written_change_nothing() {
    let pencil = beam(&mut Draws(3), 8, false);
    let [with, without] =
        [true, false].map(|zeros| modes(&pencil, |value| format!("{value:.9e}"), zeros));
    assert_eq!(with, without);
}
