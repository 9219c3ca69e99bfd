//! The assignment of all test modes at once, where the method's own (4) takes the closest pair first and may leave a bad one for the last.

use crate::method::error::Error;
use crate::method::linear_algebra::check_finite;
use nalgebra::DMatrix;

/// The analysis mode of every test mode, or none, such that the `closeness` (n × g, larger for closer, as the modal assurance) of all
/// pairs has the largest total,
///
/// $$ \max_a \sum_j c_{a(j) j}, \qquad c_{a(j) j} \ge 0, $$
///
/// with no analysis mode in two pairs; g may exceed n. Test modes enter in their order, each by the shortest path that
/// makes room for it; ties go to the lowest analysis mode, or else leave an earlier test mode's pair alone. So the same
/// numbers always give the same pairs. Source: Kuhn, *Naval Research Logistics Quarterly* 2 (1955),
/// 83; shortest paths by Jonker and Volgenant, *Computing* 38 (1987), 325.
///
/// # Errors
/// [`Error::Value`] for an entry that is not finite.
pub fn pair_optimally(closeness: &DMatrix<f64>) -> Result<Vec<Option<usize>>, Error> {
    check_finite("closeness", closeness)?;
    // After the analysis modes, every test mode (the last one first) has a place of its own at no cost: it means no partner.
    let (analysis_count, test_count) = closeness.shape();
    let places = analysis_count + test_count;
    let cost = |test: usize, place: usize| match closeness.get((place, test)) {
        Some(&close) if place < analysis_count && close >= 0.0 => -close,
        _ if place + test + 1 == places => 0.0,
        _ => f64::INFINITY,
    };
    let mut owner: Vec<Option<usize>> = vec![None; places];
    let (mut test_price, mut place_price) = (vec![0.0; test_count], vec![0.0; places]);
    for start in 0..test_count {
        let (mut distance, mut before) = (vec![f64::INFINITY; places], vec![None; places]);
        let (mut open, mut visited): (Vec<usize>, Vec<usize>) = ((0..places).collect(), Vec::new());
        let (mut next_test, mut reached) = (Some(start), 0.0);
        while let Some(test) = next_test {
            for &place in &open {
                let length = reached + cost(test, place) - test_price[test] - place_price[place];
                if length < distance[place] {
                    (distance[place], before[place]) = (length, visited.last().copied());
                }
            }
            let nearest = open
                .iter()
                .copied()
                .min_by(|&a, &b| distance[a].total_cmp(&distance[b]));
            visited.extend(nearest);
            open.retain(|place| Some(*place) != nearest);
            reached = nearest.map_or(reached, |place| distance[place]);
            next_test = nearest.and_then(|place| owner[place]);
        }
        test_price[start] += reached;
        for &place in &visited {
            place_price[place] -= reached - distance[place];
            owner[place]
                .into_iter()
                .for_each(|other: usize| test_price[other] += reached - distance[place]);
        }
        let mut last = visited.pop();
        while let Some(place) = last {
            last = before[place];
            owner[place] = last.map_or(Some(start), |earlier: usize| owner[earlier]);
        }
    }
    let of = |test| (0..analysis_count).find(|place| owner[*place] == Some(test));
    Ok((0..test_count).map(of).collect())
}

/// The mode of the model of every test mode, in as many pairs as there are, of the least total of their costs (n × g), and this total.
///
/// # Errors
/// Errors of [`pair_optimally`].
pub(crate) fn pair_cheaply(costs: &DMatrix<f64>) -> Result<(Vec<Option<usize>>, f64), Error> {
    let dearest = costs.max() + 1.0;
    let partners = pair_optimally(&costs.map(|cost| dearest - cost))?;
    let cost = |(test, mode): (usize, &Option<usize>)| Some(costs[((*mode)?, test)]);
    let total = partners.iter().enumerate().filter_map(cost).sum();
    Ok((partners, total))
}
