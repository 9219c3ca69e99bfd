//! In which order grid points are eliminated: nested dissection, so that a sparse factor stays sparse.
//!
//! Source: A. George, *Nested Dissection of a Regular Finite Element Mesh*, SIAM J. Numer. Anal. 10 (1973). A set of points is cut
//! in two where few points lie next to the cut; those are eliminated last, and both parts are cut again.

use nalgebra::Vector3;
use std::collections::VecDeque;

/// Parts that are not cut again: a grid's three DOF times this are a dense block, which costs less than more bookkeeping.
const SMALLEST_PART: usize = 24;

/// Grid points joined by elements.
pub(crate) struct Mesh {
    points: Vec<Vector3<f64>>,
    points_of: Vec<Vec<usize>>,
    elements_of: Vec<Vec<usize>>,
}

impl Mesh {
    /// From positions, all alike where they are not known, and the points of every element, which may name a point twice.
    pub(crate) fn new(points: Vec<Vector3<f64>>, mut points_of: Vec<Vec<usize>>) -> Self {
        let mut elements_of = vec![Vec::new(); points.len()];
        for (element, of_element) in points_of.iter_mut().enumerate() {
            of_element.sort_unstable();
            of_element.dedup();
            of_element.iter().for_each(|&point| elements_of[point].push(element));
        }
        Self { points, points_of, elements_of }
    }

    fn neighbors(&self, point: usize) -> impl Iterator<Item = usize> {
        self.elements_of[point].iter().flat_map(|&element| self.points_of[element].iter().copied())
    }

    /// The points in their order of elimination.
    pub(crate) fn nested_dissection(&self) -> Vec<usize> {
        let mut points: Vec<usize> = (0..self.points.len()).collect();
        let mut order = Vec::with_capacity(points.len());
        self.dissect(&mut points, &mut vec![0; self.points.len()], &mut 0, &mut order);
        order
    }

    /// Appends a part to the order. `mark` holds for every point the last mark that was given it.
    fn dissect(&self, part: &mut [usize], mark: &mut [usize], last: &mut usize, order: &mut Vec<usize>) {
        let directions = if part.len() > SMALLEST_PART { 0..4 } else { 0..0 };
        let cuts = directions.filter_map(|direction| {
            let keys: Vec<f64> = match direction {
                3 => self.distances(part, mark, last),
                axis => part.iter().map(|&point| self.points[point][axis]).collect(),
            };
            self.cut(part, &keys, mark, last)
        });
        let Some((sides, _)) = cuts.min_by_key(|cut| cut.1) else {
            order.extend_from_slice(part);
            return;
        };
        let mut sorted: Vec<(u8, usize)> = sides.into_iter().zip(part.iter().copied()).collect();
        sorted.sort_by_key(|pair| pair.0);
        part.iter_mut().zip(&sorted).for_each(|(point, pair)| *point = pair.1);
        let first = sorted.partition_point(|pair| pair.0 < 1);
        let both = sorted.partition_point(|pair| pair.0 < 2);
        drop(sorted);
        let (parts, separator) = part.split_at_mut(both);
        let (one, other) = parts.split_at_mut(first);
        self.dissect(one, mark, last, order);
        self.dissect(other, mark, last, order);
        order.extend_from_slice(separator);
    }

    /// Cuts a part at the median of the keys of its points: for every point 0 or 1 for its side and 2 next to the cut, and how many
    /// those are. None when all keys are alike.
    fn cut(&self, part: &[usize], keys: &[f64], mark: &mut [usize], last: &mut usize) -> Option<(Vec<u8>, usize)> {
        let mut sorted = keys.to_vec();
        let (below, &mut median, _) = sorted.select_nth_unstable_by(part.len() / 2, f64::total_cmp);
        // Points on one line of the mesh stay together; where the median is the lowest key, its line is the first side.
        let is_lowest = below.iter().all(|&key| key >= median);
        let mut sides: Vec<u8> =
            keys.iter().map(|&key| u8::from(key > median || key == median && !is_lowest)).collect();
        if sides.iter().all(|&side| side == sides[0]) {
            return None;
        }
        let marks = [*last + 1, *last + 2];
        *last += 2;
        part.iter().zip(&sides).for_each(|(&point, &side)| mark[point] = marks[usize::from(side)]);
        let next_to = |side: u8| -> Vec<usize> {
            let is_next = |point: usize| self.neighbors(point).any(|near| mark[near] == marks[usize::from(1 - side)]);
            (0..part.len()).filter(|&place| sides[place] == side && is_next(part[place])).collect()
        };
        let (first, second) = (next_to(0), next_to(1));
        let separator = if first.len() < second.len() { first } else { second };
        separator.iter().for_each(|&place| sides[place] = 2);
        // A cut that leaves nearly everything on one side is paid for by the next cuts.
        let smaller = [0, 1].map(|side| sides.iter().filter(|&&found| found == side).count()).into_iter().min()?;
        let lopsided = part.len() / (4 * smaller + 1);
        Some((sides, separator.len() * (1 + lopsided)))
    }

    /// How many elements lie between the points of a part and one at its end; those that cannot be reached come last.
    fn distances(&self, part: &[usize], mark: &mut [usize], last: &mut usize) -> Vec<f64> {
        let (mut start, mut first) = (part[0], 0);
        // From the farthest of the first point's: an end of the part.
        for _ in 0..2 {
            *last += 1;
            let inside = *last;
            first = inside + 1;
            part.iter().for_each(|&point| mark[point] = inside);
            mark[start] = first;
            *last = first;
            let mut queue = VecDeque::from([start]);
            while let Some(point) = queue.pop_front() {
                start = point;
                for near in self.neighbors(point) {
                    if mark[near] == inside {
                        mark[near] = mark[point] + 1;
                        *last = mark[near].max(*last);
                        queue.push_back(near);
                    }
                }
            }
        }
        part.iter().map(|&point| mark[point].checked_sub(first).map_or(f64::MAX, |steps| steps as f64)).collect()
    }
}
