//! Free motions are counted by signs of pivots within what the digits of a file leave open: a structure written with fewer digits
//! gives the same answer or a doubt.

use crate::common::free_structures::{Drawn, KINDS, drawn, rewritten};
use crate::prelude::*;

fn bodies(of: &Drawn, digits: usize, support: &Support) -> RigidBodies {
    let stiffness = rewritten(&of.stiffness, digits);
    let found = free_motions(&stiffness, support);
    found.unwrap_or_else(|error| panic!("{digits} digits: {error}"))
}

properties! {
    #[test]
    fn fewer_digits_give_the_same_count_or_a_doubt(
        (seed, kind, is_held) in (any::<u64>(), 0..KINDS, any::<bool>()),
        (digits, of_places) in (7..17_usize, 7..17_usize),
    ) {
        let of = drawn(&mut Draws(seed), kind, is_held);
        let found = bodies(&of, digits, &of.support(of_places));
        let bound = found.rows.len();
        prop_assert!(bound >= of.free, "{bound} for {}", of.free);
        let is_doubtful = !found.mechanisms.is_empty();
        prop_assert!(found.rigid() == of.free || is_doubtful, "{} for {}", found.rigid(), of.free);
        prop_assert!(!is_doubtful || digits < 12, "a doubt at {digits} digits");
        prop_assert_eq!(found.held, None);
    }

    #[test]
    fn without_places_a_sure_count_is_right_or_a_bound(
        (seed, kind, is_held, digits) in (any::<u64>(), 0..KINDS, any::<bool>(), 7..17_usize),
    ) {
        let of = drawn(&mut Draws(seed), kind, is_held);
        let found = bodies(&of, digits, &Support::default());
        // Those that are taken as held, for want of a gap, count as well.
        let count = found.motions.ncols();
        prop_assert!(count >= of.free && !found.is_told);
        prop_assert!(count == of.free || digits < 12, "{count} for {} at {digits}", of.free);
        let said = Support { count: Some(of.free), ..Support::default() };
        let told = bodies(&of, digits, &said);
        prop_assert!(told.is_told && told.rows.len() == of.free);
    }

    #[test]
    fn a_grid_on_one_bar_is_named_as_a_mechanism(
        (seed, digits) in (any::<u64>(), 9..17_usize),
    ) {
        let mut of = drawn(&mut Draws(seed), 1, false);
        let count = of.rows.len();
        let (at, beside) = (of.rows[3].0, Vector3::new(0.7, 0.2, 0.1));
        let way: DMatrix<f64> = DMatrix::from_fn(6, 1, |row, _| if row < 3 { -beside[row % 3] } else { beside[row % 3] });
        let mut stiffness = of.stiffness.clone().resize(count + 3, count + 3, 0.0);
        let bar = 1e6 * &way * way.transpose();
        let places = (3..6).chain(count..count + 3).collect_vec();
        for (i, &row) in places.iter().enumerate() {
            places.iter().enumerate().for_each(|(j, &column)| stiffness[(row, column)] += bar[(i, j)]);
        }
        of.stiffness = stiffness;
        of.rows.extend((0..3).map(|direction| (at + beside, direction)));
        let found = bodies(&of, digits, &of.support(12));
        prop_assert_eq!((found.rigid(), found.rows.len()), (6, 8));
        prop_assert!(found.mechanisms.iter().all(|row| *row >= count), "{:?}", found.mechanisms);
    }

    #[test]
    fn one_spring_to_the_ground_by_mistake_is_named_by_its_row(
        (seed, row, decade) in (any::<u64>(), any::<prop::sample::Index>(), -4..2_i32),
    ) {
        let mut of = drawn(&mut Draws(seed), 1, false);
        let row = row.index(of.rows.len());
        of.stiffness[(row, row)] += 1e6 * 10_f64.powi(decade);
        let found = bodies(&of, 12, &of.support(12));
        prop_assert_eq!((found.rigid(), found.mechanisms.len(), found.held), (5, 0, Some(row)));
    }
}

#[test]
fn more_free_motions_than_the_bound_are_refused() {
    let of = drawn(&mut Draws(1), 0, false);
    let said = Support {
        count: Some(4),
        ..Support::default()
    };
    let refused = free_motions(&rewritten(&of.stiffness, 10), &said);
    let error = refused.expect_err("four of three").to_string();
    assert!(
        error.contains("motions that the stiffness leaves free: 4"),
        "{error}"
    );
}
