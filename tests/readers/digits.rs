//! Digits of matrices: what they leave open is said, and nothing else changes.

use crate::common::answer::printed;
use crate::common::draws::Draws;
use crate::common::free_structures::written;
use crate::common::jobs::{file, matrix_job, measured_at};
use crate::prelude::*;
use corfem::job::matrix_modes;
use corfem::sparse::BodyFinding;
use corfem::sparse::whole_modes::WholeModes;
use std::f64::consts::FRAC_PI_2;

/// Structures of the table: a beam, a portal frame, one with all its mass in points beside its grids, and one that hangs on soft springs.
const STRUCTURES: [&str; 4] = ["beam", "frame", "points", "soft"];
/// Digits of the table; none stand for six decimals.
const DIGITS: [usize; 7] = [17, 12, 10, 8, 7, 5, 0];

/// Stiffness and mass of what holds a plane structure in stretching and bending and of so many parts of it, and the frequencies at which it
/// swings on springs.
///
/// Its elements are alike, so that entries of parts cancel where they meet.
pub fn parts(
    draws: &mut Draws,
    kind: usize,
    elements: usize,
    is_held: bool,
    count: usize,
) -> (Vec<[DMatrix<f64>; 2]>, Vec<f64>) {
    let (h, angle) = (1.0 / elements as f64, draws.between(0.0, TAU));
    let size = 3 * elements + 3;
    let mut all = vec![[zero_square(size), zero_square(size)]; count + 1];
    let mut rigid = DMatrix::zeros(size, 3);
    rigid.fill_with_identity();
    for element in 0..elements {
        let side = if kind == 0 { 1 } else { 3 * element / elements };
        let (s, c) = (angle + FRAC_PI_2 * (1.0 - side as f64)).sin_cos();
        let turn = dmatrix![c, s, 0.0; -s, c, 0.0; 0.0, 0.0, 1.0];
        let at = 3 * element;
        let (x, y) = (rigid[(at + 1, 2)] + c * h, rigid[(at, 2)] - s * h);
        let next = dmatrix![1.0, 0.0, y; 0.0, 1.0, x; 0.0, 0.0, 1.0];
        rigid.view_mut((at + 3, 0), (3, 3)).copy_from(&next);
        let mut add = |part: usize, which: usize, own: &DMatrix<f64>| {
            let mut view =
                all[part][which].view_range_mut(at..at + own.nrows(), at..at + own.nrows());
            view += own;
        };
        let mut turns = zero_square(6);
        [0, 3]
            .into_iter()
            .for_each(|at| turns.view_mut((at, at), (3, 3)).copy_from(&turn));
        let symmetric = |stretch: [f64; 2], bend: [f64; 6], scale: f64| {
            let [a, b, e, g, k, l] = bend;
            #[rustfmt::skip]
            let own = dmatrix![
                stretch[0], 0.0, 0.0, stretch[1], 0.0, 0.0;
                0.0, a, b * h, 0.0, e, g * h;
                0.0, b * h, k * h * h, 0.0, -g * h, l * h * h;
                stretch[1], 0.0, 0.0, stretch[0], 0.0, 0.0;
                0.0, e, -g * h, 0.0, a, -b * h;
                0.0, g * h, l * h * h, 0.0, -b * h, k * h * h
            ];
            let own = turns.tr_mul(&(scale * own)) * &turns;
            0.5 * (&own + own.transpose())
        };
        let part = 1 + element * count / elements;
        let bar = 1e4 * h * h;
        let own = symmetric(
            [bar, -bar],
            [12.0, 6.0, -12.0, 6.0, 4.0, 2.0],
            1e4 / h.powi(3),
        );
        add(part, 0, &own);
        let own = match kind {
            // Beside its grid a point's motion is that of the grid and its turning.
            2 => {
                let (x, y) = (draws.between(-h, h), draws.between(-h, h));
                let arm = dmatrix![1.0, 0.0, -y; 0.0, 1.0, x];
                1e2 * h * arm.tr_mul(&arm)
            }
            _ => symmetric(
                [140.0, 70.0],
                [156.0, 22.0, 54.0, -13.0, 4.0, -3.0],
                1e2 * h / 420.0,
            ),
        };
        add(part, 1, &own);
    }
    let soft = 10_f64.powf(draws.between(-2.0, 0.5));
    if kind == 3 {
        (0..3).for_each(|row| all[0][0][(row, row)] += soft);
    }
    let mass = all.iter().map(|own| &own[1]).sum::<DMatrix<f64>>();
    let suspended = (rigid.tr_mul(&mass) * rigid / soft).symmetric_eigenvalues();
    let suspended = suspended.map(|own| own.sqrt().recip() / TAU);
    let mut suspended = suspended.iter().copied().collect_vec();
    suspended.sort_by(f64::total_cmp);
    let held = if is_held { 3 } else { 0 };
    let cut = |matrix: DMatrix<f64>| matrix.view_range(held.., held..).into_owned();
    let parts = all.into_iter().map(|both| both.map(cut)).collect();
    (parts, suspended)
}

pub fn whole(
    parts: &[[DMatrix<f64>; 2]],
    factors: impl Fn(usize, usize) -> f64,
) -> [DMatrix<f64>; 2] {
    [0, 1].map(|which| {
        let each = parts.iter().enumerate();
        each.map(|(part, own)| factors(part, which) * &own[which])
            .sum()
    })
}

/// The lowest modes of matrices in files.
pub fn modes(files: [String; 2]) -> WholeModes {
    let folder = new_folder();
    let paths = ["k.mtx", "m.mtx"].map(|name| folder.path().join(name));
    paths
        .iter()
        .zip(files)
        .for_each(|(path, text)| fs::write(path, text).unwrap());
    matrix_modes(&paths[0], &paths[1], 6).unwrap()
}

/// The number of motions that digits do not tell from free, and the frequency below which one would not show.
fn open(found: &WholeModes) -> Option<(usize, f64)> {
    found.doubtful.iter().find_map(|own| match own {
        BodyFinding::ByDigits {
            count, hidden_hz, ..
        } => Some((*count, *hidden_hz)),
        _ => None,
    })
}

/// Modes of matrices with fewer digits beside frequencies of all: each is listed, to a thousandth or within what is said, or not told from
/// free; what is held lies below what is said not to show. Entries of elements that are alike are rounded alike: n of them as one, and so √n
/// times as far.
fn agree(all: &[f64], found: &WholeModes, free: usize, alike: usize, case: &str) {
    let (count, hidden_hz) = open(found).unwrap_or((free, 0.0));
    assert!(
        found.rigid_body <= count && free <= count,
        "{case}: {found:?}"
    );
    let (skipped, all) = all.split_at((count - free).min(all.len()));
    assert!(
        skipped.iter().all(|hz| *hz < hidden_hz),
        "{case}: {skipped:?} {hidden_hz}"
    );
    let own = found.modes.frequencies_hz();
    let listed = own.iter().zip(&found.open).skip(count - found.rigid_body);
    for ((own, open), exact) in listed.zip(all) {
        let off = (own / exact - 1.0).abs();
        let said = 4.0 * open * (alike as f64).sqrt() + 1e-3;
        assert!(off <= said, "{case}: {own} {exact} {off} {open}");
    }
}

/// A job of matrices with parameters, each by its entry of the job and its matrix, all as `write` writes them.
pub fn job<'a>(
    whole: &[DMatrix<f64>; 2],
    parts: impl Iterator<Item = (&'a str, DMatrix<f64>)>,
    data: &TestData,
    write: impl Fn(&DMatrix<f64>) -> String,
) -> Files {
    let named = (1..=whole[0].nrows()).map(|row| format!("{row},x\n"));
    let sparse = whole.each_ref().map(|matrix| sparse(matrix).unwrap());
    let mut files = matrix_job([&sparse[0], &sparse[1]], named, data);
    *file(&mut files, "stiffness.mtx") = write(&whole[0]);
    *file(&mut files, "mass.mtx") = write(&whole[1]);
    for (part, (entry, matrix)) in (1..).zip(parts) {
        files[0].1 += &format!("[[parameter]]\nname = \"p{part}\"\n{entry} = \"p{part}.mtx\"\n");
        files.push((format!("p{part}.mtx"), write(&matrix)));
    }
    files
}

/// One cell of the table, whether it is told that a motion may be free.
fn cell(draws: &mut Draws, [kind, held, count, way, digits]: [usize; 5]) -> bool {
    let is_held = held == 0 && kind != 3;
    let free = if is_held || kind == 3 { 0 } else { 3 };
    let elements = 6 + draws.below(25);
    let (parts, suspended) = parts(draws, kind, elements, is_held, count);
    let truth = (0..=count).map(|_| draws.between(0.8, 1.25)).collect_vec();
    let scaled = usize::from(way == 2);
    let real = whole(&parts, |part, which| match part > 0 && which == scaled {
        true => truth[part],
        false => 1.0,
    });
    let first = whole(&parts, |_, _| 1.0);
    let write = |matrix: &DMatrix<f64>| written(matrix, DIGITS[digits], false);
    let case = format!(
        "{} of {elements}, held {is_held}, {count} parts, {way}, {} digits",
        STRUCTURES[kind], DIGITS[digits]
    );
    let exact = |of: &[DMatrix<f64>; 2]| {
        let found = modes(of.each_ref().map(|matrix| written(matrix, 17, false)));
        let swings = if kind == 3 { 3 - found.rigid_body } else { 0 };
        let count = found.modes.len() - swings;
        let squares = found.modes.omega_squared().rows(swings, count).into_owned();
        Modes::new(
            squares,
            found.modes.shapes().columns(swings, count).into_owned(),
        )
        .unwrap()
    };
    let own = exact(&first).frequencies_hz();
    let all = [&suspended[..if kind == 3 { 3 } else { 0 }], &own].concat();
    let found = modes(first.each_ref().map(write));
    agree(&all, &found, free, elements, &case);
    let hidden_hz = open(&found).map_or(0.0, |own| own.1);
    let is_sure = found.doubtful.iter().all(|own| match own {
        BodyFinding::ByDigits { is_sure, .. } => *is_sure,
        _ => false,
    });
    assert!(
        is_sure || DIGITS[digits] < 12 || kind == 3,
        "{case}: {:?}",
        found.doubtful
    );

    let real = exact(&real);
    let rows = (0..first[0].nrows())
        .filter(|row| row % 3 != 2)
        .collect_vec();
    let data = TestData {
        frequency_deviation: Some(vec![0.002; real.len()]),
        shape_deviation: Some(vec![0.02; real.len()]),
        ..measured_at(&real, &rows)
    };
    let of_part = |own: &[DMatrix<f64>; 2]| match way {
        0 => ("matrix", own[0].clone()),
        1 => ("at = 2.0\nstiffness", &first[0] + &own[0]),
        _ => ("scales = \"mass\"\nmatrix", own[1].clone()),
    };
    let (_folder, job) = placed(&job(&first, parts[1..].iter().map(of_part), &data, write));
    let found = answer(&job);
    let case = format!("{case}: {:?} {}", found.doubts, found.words);
    // What may be free is not listed, and so not compared.
    let is_open = |mode: usize| data.frequencies_hz[mode - 1] < hidden_hz;
    let is_told = |own: &String| match own.strip_prefix("not-compared-") {
        Some(mode) => is_open(mode.parse().unwrap()),
        None => own == "free-by-digits" && hidden_hz > 0.0,
    };
    // A test of which the digits leave most open is told so, and may look like another's.
    let is_most = 2 * (1..=real.len()).filter(|mode| is_open(*mode)).count() > real.len();
    assert!(is_most || found.doubts.iter().all(is_told), "{case}");
    assert_eq!(
        found.status,
        if found.doubts.is_empty() { 0 } else { 3 },
        "{case}"
    );
    let told = found.factors.iter().zip(&found.deviations);
    for ((factor, deviation), truth) in told.zip(&truth[1..]) {
        let off = (factor / truth).ln().abs();
        let is_right = deviation.is_none_or(|own| off < 4.0 * own);
        assert!(is_right || !found.doubts.is_empty(), "{truth}, {case}");
    }
    let status = printed("check", &job, "text").status;
    assert!(
        status.code() == Some(found.status) || status.success() && hidden_hz > 0.0,
        "{case}"
    );
    !found.doubts.is_empty()
}

/// The table of laws, every `step`th of its cells: right within what the digits allow, or told; never refused, and no other doubt.
fn table(step: usize) {
    let sizes = [STRUCTURES.len(), 2, 3, 3, DIGITS.len()];
    let (mut told, mut wrong) = (0, Vec::new());
    let all = sizes.iter().product::<usize>();
    for at in (0..all).step_by(step) {
        let mut rest = at;
        let place = sizes.map(|size| {
            let own = rest % size;
            rest /= size;
            own
        });
        let [kind, held, count, way, digits] = place;
        let mut draws = Draws(at as u64);
        let found = std::panic::catch_unwind(move || {
            cell(&mut draws, [kind, held, count + 1, way, digits])
        });
        match found {
            Ok(own) => told += usize::from(own),
            Err(_) => wrong.push(place),
        }
    }
    assert!(
        wrong.is_empty() && 40 * told > all / step,
        "{told} {wrong:?}"
    );
}

#[test]
fn digits_leave_answers_right_or_say_so() {
    table(11);
}

#[test]
#[ignore = "the whole table takes minutes"]
fn digits_leave_answers_right_or_say_so_in_the_whole_table() {
    table(1);
}

/// A beam whose elements differ, so that their entries are rounded independently.
fn beam(draws: &mut Draws, is_held: bool) -> [DMatrix<f64>; 2] {
    let (parts, _) = parts(draws, 0, 12, is_held, 12);
    let sizes = (0..26).map(|_| draws.between(1.0, 2.0)).collect_vec();
    whole(&parts, |part, which| sizes[2 * part + which])
}

/// Rounding of beams that are drawn: half a unit of the last of n digits is a part of a number that falls to a tenth of the said one
/// where its first digits are 9.99, and so is the root of the mean square by which the first frequency is off.
#[test]
fn open_frequencies_are_deviations_of_what_rounding_does() {
    let mut draws = Draws(2);
    let mut of = || {
        let beam = beam(&mut draws, true);
        let [exact, rounded] =
            [17, 7].map(|digits| modes(beam.each_ref().map(|own| written(own, digits, false))));
        let off = rounded.modes.frequencies_hz()[0] / exact.modes.frequencies_hz()[0] - 1.0;
        (off / rounded.open[0]).powi(2)
    };
    let mean = (0..60).map(|_| of()).sum::<f64>() / 60.0;
    assert!((0.1..1.0).contains(&mean.sqrt()), "{mean}");
}

#[test]
fn zeros_that_are_written_change_nothing() {
    let beam = beam(&mut Draws(3), false);
    let [with, without] =
        [true, false].map(|zeros| modes(beam.each_ref().map(|own| written(own, 10, zeros))));
    assert_eq!(with, without);
}

/// A string of masses that is held at both ends, of five digits: its frequencies are known, and the lowest is open among others.
#[test]
fn modes_of_a_held_string_are_exact_where_the_lowest_is_open() {
    let (count, spring) = (400, 1.2345);
    let string = DMatrix::from_fn(count, count, |i, j| match i.abs_diff(j) {
        0 => 2.0 * spring,
        1 => -spring,
        _ => 0.0,
    });
    let found = modes([written(&string, 5, false), written(&eye(count), 17, false)]);
    let hertz = |wave: usize| {
        let part = PI * wave as f64 / (count + 1) as f64;
        (spring * (2.0 - 2.0 * part.cos())).sqrt() / TAU
    };
    let own = found.modes.frequencies_hz();
    for (own, known) in own.into_iter().zip((1..).map(hertz)) {
        assert!((own / known - 1.0).abs() < 1e-9, "{own} {known}");
    }
    assert!(found.rigid_body == 0 && open(&found).is_some());
}
