//! The order in which grid points are eliminated: nested dissection, so that a sparse factor stays sparse.
//!
//! Source: A. George, *Nested Dissection of a Regular Finite Element Mesh*, SIAM J. Numer. Anal. 10 (1973). A set of points is cut
//! in two where few points lie next to the cut; those are eliminated last, and both parts are cut again.

use std::collections::VecDeque;

/// Parts that are not cut again: a grid's three DOF times this are one small dense block.
const SMALLEST_PART: usize = 6;
/// Tenths of a part's points after which cuts are tried.
const TENTHS: [usize; 3] = [4, 5, 6];

/// The next mark, which no point has yet; `last` is the largest in use.
fn next(last: &mut usize) -> usize {
    *last += 1;
    *last
}

/// The points of a mesh, with those coupled to each, in their order of elimination: both sides of a cut, then what lies next to it.
pub(crate) fn nested_dissection(near: &[Vec<usize>]) -> Vec<usize> {
    let (mut order, mut mark): (Vec<usize>, _) = ((0..near.len()).collect(), vec![0; near.len()]);
    let (mut last, mut parts) = (0, Vec::from_iter(Some(0..order.len())));
    while let Some(range) = parts.pop() {
        let part = &mut order[range.clone()];
        if part.len() <= SMALLEST_PART {
            continue;
        }
        let keys = distances(near, part, &mut mark, &mut last);
        let cuts = TENTHS.map(|tenths| cut(near, part, &keys, tenths, &mut mark, &mut last));
        let Some((sides, _)) = cuts.into_iter().flatten().min_by_key(|cut| cut.1) else {
            continue;
        };
        let mut sorted: Vec<(u8, usize)> = sides.into_iter().zip(part.iter().copied()).collect();
        sorted.sort_by_key(|pair| pair.0);
        part.iter_mut()
            .zip(&sorted)
            .for_each(|(point, pair)| *point = pair.1);
        let [first, both] =
            [1, 2].map(|side| range.start + sorted.partition_point(|pair| pair.0 < side));
        parts.extend([range.start..first, first..both]);
    }
    order
}

/// Cuts a part after some tenths of its points in the order of their keys: for every point 0 or 1 for its side and 2 next to
/// the cut, and the cost of the cut, the number of points next to it, multiplied when the cut is lopsided. None when all keys
/// are alike.
fn cut(
    near: &[Vec<usize>],
    part: &[usize],
    keys: &[usize],
    tenths: usize,
    mark: &mut [usize],
    last: &mut usize,
) -> Option<(Vec<u8>, usize)> {
    if keys.iter().all(|&key| key == keys[0]) {
        return None;
    }
    let mut sorted = keys.to_vec();
    let place = part.len() * tenths / 10;
    let (below, &mut middle, _) = sorted.select_nth_unstable(place);
    // Points on one line of the mesh stay together; where the middle is the lowest key, its line is the first side.
    let is_lowest = below.iter().all(|&key| key >= middle);
    let mut sides: Vec<u8> = keys
        .iter()
        .map(|&key| u8::from(key > middle || key == middle && !is_lowest))
        .collect();
    let marks = [next(last), next(last)];
    part.iter()
        .zip(&sides)
        .for_each(|(&point, &side)| mark[point] = marks[usize::from(side)]);
    let next_to = |side: u8| -> Vec<usize> {
        let is_next = |point: usize| {
            near[point]
                .iter()
                .any(|&near| mark[near] == marks[usize::from(1 - side)])
        };
        (0..part.len())
            .filter(|&place| sides[place] == side && is_next(part[place]))
            .collect()
    };
    let (first, second) = (next_to(0), next_to(1));
    let separator = if first.len() < second.len() {
        first
    } else {
        second
    };
    separator.iter().for_each(|&place| sides[place] = 2);
    // The next cuts pay for a cut that leaves nearly everything on one side.
    let smaller = [0, 1]
        .map(|side| sides.iter().filter(|&&found| found == side).count())
        .into_iter()
        .min()?;
    let lopsided = part.len() / (4 * smaller + 1);
    Some((sides, separator.len() * (1 + lopsided)))
}

/// Graph distance of each point of a part from one at its end, up to a constant; pieces that do not hang together follow one
/// another.
fn distances(
    near: &[Vec<usize>],
    part: &[usize],
    mark: &mut [usize],
    last: &mut usize,
) -> Vec<usize> {
    let mut start = part[0];
    // The second time from the point farthest from the first: an end of the part.
    for _ in 0..2 {
        let inside = next(last);
        part.iter().for_each(|&point| mark[point] = inside);
        let mut queue = VecDeque::new();
        for piece in [start].iter().chain(part) {
            if mark[*piece] == inside {
                mark[*piece] = next(last);
                queue.push_back(*piece);
            }
            while let Some(point) = queue.pop_front() {
                start = point;
                for &near in &near[point] {
                    if mark[near] == inside {
                        mark[near] = mark[point] + 1;
                        *last = mark[near].max(*last);
                        queue.push_back(near);
                    }
                }
            }
        }
    }
    part.iter().map(|&point| mark[point]).collect()
}
