//! (7), (8), (C.12) to (C.24): every rule, at every order, is its rows summed by hand; the orders it gains; and where it stops.
//!
//! | rule | roots | shapes |
//! |---|---|---|
//! | first order | 2 | 2 |
//! | original | 3 | 2 |
//! | Recursive 1, order r | r + 1 | r + 1 |
//! | Recursive 2, order r ≥ 2 | 2r − 1 | 2r |

use crate::common::appendix_c::{Rule, errors};
use crate::prelude::*;

/// Largest entry of a change beside its modes' own stiffness: so small that every rule holds.
const SMALL: f64 = 0.02;

/// A change by the rows of (C.16): (k + β)γ − (kΛ + α).
struct Rows {
    a: DMatrix<f64>,
    g: DMatrix<f64>,
}

impl Rows {
    fn recursive_1(&self, order: usize) -> Perturbed {
        let (a, g, n) = (&self.a, &self.g, self.a.nrows());
        let mut roots = g.diagonal().component_div(&a.diagonal());
        let mut shapes = eye(n);
        for _ in 0..order {
            let sum = |i: usize, j: usize| -> f64 {
                let others = (0..n).filter(|&s| s != i);
                others
                    .map(|s| (a[(i, s)] * roots[j] - g[(i, s)]) * shapes[(s, j)])
                    .sum()
            };
            let shape = |i: usize, j: usize| match i == j {
                true => 1.0,
                false => -sum(i, j) / (a[(i, i)] * roots[j] - g[(i, i)]),
            };
            let next = DVector::from_fn(n, |j, _| (g[(j, j)] - sum(j, j)) / a[(j, j)]);
            (shapes, roots) = (DMatrix::from_fn(n, n, shape), next);
        }
        Perturbed { roots, shapes }
    }

    fn explicit(&self, shapes: DMatrix<f64>) -> Perturbed {
        let of = |rows: &DMatrix<f64>, j: usize| rows.row(j).tr_dot(&shapes.column(j));
        let roots = DVector::from_fn(shapes.ncols(), |j, _| of(&self.g, j) / of(&self.a, j));
        Perturbed { roots, shapes }
    }

    fn recursive_2(&self, order: usize) -> Perturbed {
        let mut now = self.recursive_1(1);
        for _ in 1..order {
            let roots = self.explicit(now.shapes).roots;
            let n = roots.len();
            let shapes = DMatrix::from_fn(n, n, |i, j| {
                let rest = (&self.a * roots[j] - &self.g).remove_row(j);
                let others = rest.clone().remove_column(j).try_inverse().unwrap();
                (others * -rest.column(j)).insert_row(j, 1.0)[i]
            });
            now = Perturbed { roots, shapes };
        }
        now
    }
}

/// Two to four modes in any order, a factor of 1.8 apart at least, and changes without symmetry, in any unit of stiffness.
fn unsymmetric() -> impl Strategy<Value = ModalChange> {
    let entry = || prop_oneof![-1.0..-0.3_f64, 0.3..1.0];
    (2..=4_usize).prop_flat_map(move |n| {
        let ratios = prop::collection::vec(1.8..3.0_f64, n);
        let spectrum = (ratios, -3.0..3.0_f64).prop_map(|(ratios, unit)| {
            let after = |k: &mut f64, ratio| {
                *k *= ratio;
                Some(*k)
            };
            ratios
                .into_iter()
                .scan(10_f64.powf(unit), after)
                .collect_vec()
        });
        let full = || {
            prop::collection::vec(entry(), n * n).prop_map(move |all| DMatrix::from_vec(n, n, all))
        };
        (spectrum.prop_shuffle(), full(), full()).prop_map(|(k, beta, alpha)| {
            let k = DVector::from_vec(k);
            let size = k.map(f64::sqrt);
            let beta = SMALL * beta.component_mul(&(&size * size.transpose()));
            ModalChange::of_vibrations(&k, beta, SMALL * alpha)
        })
    })
}

fn rows(change: &ModalChange) -> Rows {
    let (k, n) = (&change.generalized_stiffness, change.beta.nrows());
    Rows {
        a: DMatrix::from_diagonal(k) + &change.beta,
        g: eye(n) + &change.alpha,
    }
}

properties! {
    /// Left shapes of any scale, and roots that are not 1/k, give every rule the same; α and β are seen through both.
    #[test]
    fn every_rule_is_its_rows(change in unsymmetric(), order in 1..=6_usize, unit in 0.5..2.0_f64) {
        let (k, n) = (&change.generalized_stiffness, change.beta.nrows());
        let scale = DMatrix::from_fn(n, n, |i, j| if i == j { unit - 3.0 * i as f64 } else { 0.0 });
        let back = scale.clone().try_inverse().unwrap();
        let modes = LeftRightModes {
            roots: unit * k.map(f64::recip),
            right: eye(n),
            left: scale,
        };
        let general = Pencil::new(&(&back * DMatrix::from_diagonal(k)), &modes, &(&back * &change.beta), &(unit * &back * &change.alpha))?;
        let in_units = |found: Perturbed| Perturbed { roots: found.roots / unit, ..found };
        let (all, two) = (rows(&change), order.min(3));
        let mut plain = change.clone();
        plain.alpha.fill(0.0);
        let (beta, of_stiffness) = (&plain.beta, rows(&plain));
        let pencil = change.pencil()?;
        let of_first = all.recursive_1(1);
        let original = all.explicit(of_first.shapes.clone());
        for (found, expected) in [
            (pencil.first_order()?, &of_first),
            (pencil.recursive_1(order)?, &all.recursive_1(order)),
            (pencil.recursive_2(two)?, &all.recursive_2(two)),
            (pencil.original()?, &original),
            (in_units(general.recursive_1(order)?), &all.recursive_1(order)),
            (first_order(k, beta)?, &of_stiffness.recursive_1(1)),
            (recursive_1(k, beta, order)?, &of_stiffness.recursive_1(order)),
        ] {
            let (root, shape) = errors(&found, expected);
            // Shapes of stiffnesses a factor of 3⁴ apart are as long as its root.
            prop_assert!(root < MATRIX_ROUND_OFF && shape < 10.0 * MATRIX_ROUND_OFF, "{root:e} {shape:e}");
        }
    }

    /// It ends at the exact modes, after two quiet orders in a row with mass and after one without.
    #[test]
    fn the_converged_recursion_is_the_eigensolution(change in separate_change()) {
        let mut plain = change.clone();
        plain.alpha.fill(0.0);
        let (k, beta) = (&change.generalized_stiffness, &change.beta);
        let (general, of_stiffness) = (change.pencil()?, plain.pencil()?);
        for (settled, pencil, change, quiet) in [
            (general.recursive_1_converged()?, &general, &change, 2),
            (recursive_1_converged(k, beta)?, &of_stiffness, &plain, 1),
        ] {
            let found = &settled.perturbed;
            let residual = pencil.a() * &found.shapes * DMatrix::from_diagonal(&found.roots) - pencil.g() * &found.shapes;
            prop_assert!(residual.amax() < EIGEN_ROUND_OFF, "{:e}", residual.amax());
            prop_assert!(errors(found, &eigensolution(change)?).0 < EIGEN_ROUND_OFF);
            let (omega_squared, _) = modes_by_nalgebra(pencil.a(), pencil.g());
            assert_alike(ascending(found.roots.map(f64::recip).iter()).iter(), omega_squared.iter(), EIGEN_ROUND_OFF);
            let of_order = |order| match quiet {
                1 => recursive_1(k, beta, order),
                _ => pencil.recursive_1(order),
            };
            let moved = |order: usize| largest_change(&of_order(order).unwrap().roots, &of_order(order - 1).unwrap().roots);
            let is_quiet = |order| order > 1 && moved(order) < ROOT_TOLERANCE;
            // A change within round-off of the tolerance may be told either way.
            if (2..=settled.order).any(|order| (moved(order) - ROOT_TOLERANCE).abs() < 8.0 * f64::EPSILON) {
                continue;
            }
            let stop = (2..MOST_ORDERS).find(|&order| is_quiet(order) && is_quiet(order + 1 - quiet));
            prop_assert_eq!(Some(settled.order), stop);
            prop_assert_eq!(found, &of_order(settled.order)?);
            prop_assert!((settled.last_change - moved(settled.order)).abs() < ROUND_OFF && settled.root_error < EIGEN_ROUND_OFF);
        }
    }

    #[test]
    fn normalized_shapes_are_orthonormal_in_the_changed_mass(change in separate_change()) {
        let mut shapes = change.pencil()?.recursive_1_converged()?.perturbed.shapes;
        normalize_with_mass(&mut shapes, &change.alpha)?;
        let size = shapes.nrows();
        let product = shapes.tr_mul(&(rows(&change).g * &shapes));
        prop_assert!((product - eye(size)).amax() < EIGEN_ROUND_OFF);
        prop_assert!(shapes.diagonal().iter().all(|&own| own > 0.0));
    }

    /// More stiffness and as much more mass everywhere, or neither: the modes stay as they are.
    #[test]
    fn no_change_changes_nothing(k in (2..=6_usize).prop_flat_map(separate_spectrum), scale in -0.5..1.0_f64) {
        let (size, k_matrix) = (k.len(), DMatrix::from_diagonal(&k));
        let alike = ModalChange::of_vibrations(&k, scale * k_matrix, scale * eye(size));
        let none = of_stiffness(&k, &zero_square(size));
        for rule in FORMULAE {
            for found in [(rule.general)(&alike)?, (rule.plain)(&k, &none.beta)?] {
                prop_assert!(found.roots.component_mul(&k).add_scalar(-1.0).amax() < MATRIX_ROUND_OFF, "{}", rule.name);
                prop_assert!((found.shapes - eye(size)).amax() < MATRIX_ROUND_OFF);
            }
        }
    }

    #[test]
    fn any_change_gives_finite_modes_or_a_typed_error(change in any_change()) {
        for rule in stiffness_rules() {
            match (rule.plain)(&change.stiffness, &change.beta(1.0)) {
                Ok(Perturbed { roots, shapes }) => {
                    prop_assert!(roots.iter().all(|root| *root > 0.0 && root.is_finite()));
                    prop_assert!(shapes.iter().all(|component| component.is_finite()));
                }
                Err(Error::CoalescingModes { .. } | Error::UnsettledRoots { .. } | Error::NotAVibration { .. }) => {}
                Err(other) => prop_assert!(false, "{}: {other}", rule.name),
            }
        }
    }
}

/// Errors fall by these powers of a change of stiffness and mass, where every order is above round-off.
#[test]
fn every_rule_gains_its_orders() {
    type Formula = fn(&Pencil<f64>) -> Result<Perturbed, Error>;
    let rules: [(Formula, f64, f64); 7] = [
        (Pencil::first_order, 2.0, 2.0),
        (|pencil| pencil.recursive_1(2), 3.0, 3.0),
        (|pencil| pencil.recursive_1(3), 4.0, 4.0),
        (|pencil| pencil.recursive_1(4), 5.0, 5.0),
        (Pencil::original, 3.0, 2.0),
        (|pencil| pencil.recursive_2(2), 3.0, 4.0),
        (|pencil| pencil.recursive_2(3), 5.0, 6.0),
    ];
    for (place, (rule, roots, shapes)) in rules.into_iter().enumerate() {
        let points = [0.04, 0.02, 0.01].map(|size| {
            let change = four_modes(size);
            let found = rule(&change.pencil().unwrap()).unwrap();
            (size, errors(&found, &eigensolution(&change).unwrap()))
        });
        let root = log_log_slope(&points.map(|(size, (root, _))| (size, root)));
        let shape = log_log_slope(&points.map(|(size, (_, shape))| (size, shape)));
        assert!(
            root > roots - 2.0 * ORDER_SLACK && root < roots + 1.0,
            "{place}: {root}"
        );
        assert!(
            shape > shapes - ORDER_SLACK && shape < shapes + 1.0,
            "{place}: {shape}"
        );
    }
}

/// The roots that print has in (C.24), beside the corrected ones, when every element of Case 2 changes by ten percent, up and down in turn.
#[test]
fn printed_indices_and_the_old_root_lose_the_second_order() {
    let (first, test) = (
        case_of(2).model().unwrap(),
        case_of(2).test_modes().unwrap(),
    );
    let first = first.analyze(&[1.0; PANEL_COUNT], &test, None).unwrap();
    let k = first.exact().modes.omega_squared();
    let shares = first.shares().iter().zip([0.1, -0.1].into_iter().cycle());
    let beta: DMatrix<f64> = shares.map(|(share, change)| change * share).sum();
    let change = ModalChange::of_vibrations(k, beta, zero_square(k.len()));
    let (rows, exact) = (rows(&change), eigensolution(&change).unwrap());
    let first_order = rows.recursive_1(0).roots;
    let shapes = rows.recursive_1(1).shapes;
    let printed = rows.explicit(shapes.transpose()).roots;
    let corrected = rows.explicit(shapes).roots;
    let old = DVector::from_fn(k.len(), |i, _| {
        let p = exact.shapes.column(i) / exact.shapes[(i, i)];
        (1.0 - change.beta.row(i).tr_dot(&p) / rows.a[(i, i)]) / k[i]
    });
    for (roots, expected) in [
        (printed, 6.7e-3),
        (first_order, 3.4e-3),
        (corrected, 5.2e-5),
        (old, 8.7e-5),
    ] {
        let wrong = roots.component_div(&exact.roots).add_scalar(-1.0).amax();
        assert_eq!(format!("{wrong:.1e}"), format!("{expected:.1e}"));
    }
}

/// One mode has no others: every rule gives Rayleigh's quotient, (1 + 0.2)/(2 + 0.5), and the shape itself.
#[test]
fn one_mode_alone_is_exact() {
    let change = ModalChange::of_vibrations(&dvector![2.0], dmatrix![0.5], dmatrix![0.2]);
    for rule in FORMULAE {
        let plain = (rule.plain)(&dvector![2.0], &change.beta).unwrap();
        for (found, root) in [((rule.general)(&change).unwrap(), 0.48_f64), (plain, 0.4)] {
            assert_within(found.roots[0], root, ROUND_OFF);
            assert_eq!(found.shapes, dmatrix![1.0], "{}", rule.name);
        }
    }
}

/// At its last order the recursion stops: without an error when roots hardly moved in it, with one that says how far otherwise.
#[test]
fn the_recursion_stops_at_its_last_order_and_says_how_far_it_was() {
    for (size, with_mass, is_settled) in [
        (0.85, false, true),
        (0.9, false, true),
        (1.0, false, false),
        (0.63, true, true),
        (0.7, true, false),
    ] {
        let change = four_modes(size);
        let (k, beta, pencil) = (
            &change.generalized_stiffness,
            &change.beta,
            change.pencil().unwrap(),
        );
        let of_order = |order| {
            if with_mass {
                pencil.recursive_1(order)
            } else {
                recursive_1(k, beta, order)
            }
            .unwrap()
        };
        let moved = largest_change(
            &of_order(MOST_ORDERS).roots,
            &of_order(MOST_ORDERS - 1).roots,
        );
        let settled = if with_mass {
            pencil.recursive_1_converged()
        } else {
            recursive_1_converged(k, beta)
        };
        match settled {
            Ok(found) => {
                assert!(
                    is_settled && (ROOT_TOLERANCE..LARGEST_UNSETTLED_CHANGE).contains(&moved),
                    "{size}"
                );
                let exact = match with_mass {
                    true => modes_by_nalgebra(pencil.a(), pencil.g()).0,
                    false => modes_by_nalgebra(&(DMatrix::from_diagonal(k) + beta), &eye(4)).0,
                };
                let roots = ascending(found.perturbed.roots.map(f64::recip).iter());
                let errors = roots.iter().zip(&exact);
                let error = errors
                    .map(|(found, exact)| relative_error(*found, *exact))
                    .fold(0.0, f64::max);
                assert!(
                    error <= found.root_error + EIGEN_ROUND_OFF
                        && found.root_error <= 100.0 * error,
                    "{size} {error} {found:?}"
                );
                assert_within(found.last_change, moved, ROUND_OFF);
                assert_eq!(
                    (found.order, found.perturbed),
                    (MOST_ORDERS, of_order(MOST_ORDERS))
                );
            }
            Err(refused) => {
                assert!(!is_settled && moved > LARGEST_UNSETTLED_CHANGE, "{size}");
                let Error::UnsettledRoots {
                    last_change,
                    root_error,
                    ..
                } = refused
                else {
                    panic!("{refused:?}")
                };
                assert_within(last_change, moved, ROUND_OFF);
                let words = format!(
                    "the roots still change by {moved:.1e} after 60 orders and may err by {root_error:.1e}; they must settle to 1e-6 \
                     and be proven to 1e-4"
                );
                assert_eq!(refused.to_string(), words);
            }
        }
    }
}

/// Two modes coupled by mass alone move their roots in every second order only, and the recursion waits for it.
#[test]
fn quiet_order_between_two_others_does_not_stop_the_recursion() {
    let alpha = dmatrix![0.0, 0.02; 0.02, 0.0];
    let change = ModalChange::of_vibrations(&dvector![1.0, 1.5], zero_square(2), alpha);
    let pencil = change.pencil().unwrap();
    let of_order = |order| pencil.recursive_1(order).unwrap().roots;
    assert_eq!(of_order(3), of_order(2));
    assert!(largest_change(&of_order(4), &of_order(3)) > 1e-7);
    let found = pencil.recursive_1_converged().unwrap();
    assert!(errors(&found.perturbed, &eigensolution(&change).unwrap()).0 < EIGEN_ROUND_OFF);
    assert!(found.order > 4);
}

/// A massless motion has λ = 0: a change of stiffness leaves it there, and the recursion comes to rest beside it, in any unit of time.
#[test]
fn root_of_a_massless_motion_stays_zero() {
    let one = eye(2);
    let (stiffness, change) = (dmatrix![1.0, 0.0; 0.0, 2.0], dmatrix![0.1, 0.2; 0.2, 0.3]);
    for root in [1.0, 1e6] {
        let modes = LeftRightModes {
            roots: dvector![root, 0.0],
            right: one.clone(),
            left: one.clone(),
        };
        let pencil = Pencil::new(&stiffness, &modes, &change, &zero_square(2)).unwrap();
        // (k + β)x λ = diag(root, 0)x: λ is so much of the first entry of the flexibility.
        let exact = root * dmatrix![1.1_f64, 0.2; 0.2, 2.3].try_inverse().unwrap()[(0, 0)];
        let converged = pencil.recursive_1_converged().unwrap();
        assert!(relative_error(converged.perturbed.roots[0], exact) < ROUND_OFF);
        assert_eq!(converged.perturbed.roots[1], 0.0);
        assert!(converged.order < MOST_ORDERS);
    }
}

/// The separation that an error names is the denominator relative to $(k_{ii} + \beta_{ii})\gamma_j$, here ten.
#[test]
fn separation_is_relative_to_the_rows_own_stiffness_times_the_root() {
    // A slight coupling, for modes without any may meet.
    let meeting_at = |separation: f64| {
        let alpha = dmatrix![0.0, 1e-12; 1e-12, 9.0 - 10.0 * separation];
        let change = ModalChange::of_vibrations(&dvector![1.0, 10.0], zero_square(2), alpha);
        change.pencil().unwrap().first_order()
    };
    let refused = meeting_at(1e-10);
    assert!(
        matches!(refused, Err(Error::CoalescingModes { first: 1, second: 0, separation }) if (separation / 1e-10 - 1.0).abs() < CANCELLED_DIFFERENCE),
        "{refused:?}"
    );
    assert!(meeting_at(1e-8).is_ok());
}

/// A change of mass that takes all of a mode's inertia, or more, leaves a root that is zero or negative. Such roots are those
/// of massless motions, or of a $G$ that is no mass: here they are roots like others, and the loops refuse them.
#[test]
fn roots_that_are_not_positive_are_roots_here() {
    for (taken, root) in [(-1.0, 0.0), (-1.5, -0.125)] {
        let alpha = dmatrix![0.0, 0.0; 0.0, taken];
        let change = ModalChange::of_vibrations(&dvector![1.0, 4.0], zero_square(2), alpha);
        for rule in FORMULAE {
            let found = (rule.general)(&change).unwrap();
            assert_eq!(found.roots, dvector![1.0, root], "{}", rule.name);
            assert_eq!(found.shapes, eye(2), "{}", rule.name);
        }
    }
}

/// Two modes so coupled that the shapes of order two are still numbers and the roots no longer.
#[test]
fn a_root_beyond_all_numbers_is_refused() {
    let alpha = dmatrix![0.0, 1e200; 1e200, 0.0];
    let change = ModalChange::of_vibrations(&dvector![1.0, 4.0], zero_square(2), alpha);
    let words = said(change.pencil().unwrap().recursive_1(2));
    assert!(
        words.starts_with("perturbed roots of entry (0, 0) is ")
            && words.ends_with("it must be a finite number"),
        "{words}"
    );
}

/// Modes that a change does not couple turn nowhere, however close their roots: first order and Recursive 1 follow them
/// where another mode is coupled to both.
#[test]
fn uncoupled_modes_may_have_equal_roots() {
    let k = dvector![1.0, 4.0, 4.0, 14.0];
    // Modes 1 and 2 rise to 5 together, neither with the other nor with anything else.
    let beta = dmatrix![
        0.1, 0.0, 0.0, 0.05;
        0.0, 1.0, 0.0, 0.0;
        0.0, 0.0, 1.0, 0.0;
        0.05, 0.0, 0.0, 0.2];
    let change = of_stiffness(&k, &beta);
    // Recursive 2 solves a linear system for all other modes from its second order on, which an equal root makes singular.
    let others = |rule: &Rule| rule.name != "Recursive 2, order 3";
    for rule in FORMULAE.into_iter().filter(others) {
        for found in [(rule.plain)(&k, &beta), (rule.general)(&change)] {
            let found = found.unwrap();
            for mode in [1, 2] {
                assert_within(found.roots[mode], 0.2, ROUND_OFF);
                let mut own = found.shapes.column(mode).into_owned();
                own[mode] -= 1.0;
                assert_eq!(own.amax(), 0.0, "{}", rule.name);
            }
            assert!(found.shapes[(0, 3)] > 0.0 && found.shapes[(3, 0)] < 0.0);
        }
    }
    // A change of mass that moves the two alike does not part them either.
    for moved in [0.0, 0.1] {
        let alpha = diagonal([0.0, moved, moved, 0.0]);
        let with_mass = ModalChange::of_vibrations(&k, beta.clone(), alpha)
            .pencil()
            .unwrap();
        let found = with_mass.recursive_1_converged().unwrap().perturbed.roots;
        let (exact, _) = modes_by_nalgebra(with_mass.a(), with_mass.g());
        assert_alike(
            ascending(found.map(f64::recip).iter()).iter(),
            exact.iter(),
            EIGEN_ROUND_OFF,
        );
    }
}
