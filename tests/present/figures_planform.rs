//! Node lines: the interpolation passes through what was measured, and the lines lie exactly where it vanishes.

use crate::common::tolerances::{NODE_LINE, ROUND_OFF};
use crate::present::figures::results;
use corfem::cases::CaseResult;
use corfem::cases::torque_box::{Reconstruction, TEST_GAGE};
use corfem::method::appendix_a::condense;
use corfem::method::assembly::FactorizedStiffness;
use corfem::present::figures::planform::{PlanPoint, Planform, RibShape};
use proptest::prelude::*;

fn planform() -> Planform {
    Planform::of(&Reconstruction::embedded().expect("the box"))
}

/// Displacements of the nine dynamic points, the largest of order one.
fn shape() -> impl Strategy<Value = [f64; 9]> {
    prop::array::uniform9(-1.0..1.0_f64)
}

/// Lagrange's parabola through three values, the other form of the interpolation along a rib.
fn along_rib(values: &[f64], mid: f64, xi: f64) -> f64 {
    let (a, b, c) = (0.0, mid, 1.0);
    values[0] * (xi - b) * (xi - c) / ((a - b) * (a - c))
        + values[1] * (xi - a) * (xi - c) / ((b - a) * (b - c))
        + values[2] * (xi - a) * (xi - b) / ((c - a) * (c - b))
}

/// Chord and span fraction of a place in a bay, by Newton's iteration on the bilinear map.
fn fractions(planform: &Planform, bay: usize, place: PlanPoint) -> (f64, f64) {
    let (mut xi, mut eta) = (0.5, 0.5);
    for _ in 0..40 {
        let (p, q) = (planform.on_rib(bay, xi), planform.on_rib(bay + 1, xi));
        let at = |k: usize| p[k] + eta * (q[k] - p[k]) - place[k];
        let chord = |rib: usize, k: usize| planform.ribs[rib][1][k] - planform.ribs[rib][0][k];
        let by_xi = |k: usize| (1.0 - eta) * chord(bay, k) + eta * chord(bay + 1, k);
        let by_eta = |k: usize| q[k] - p[k];
        let determinant = by_xi(0) * by_eta(1) - by_xi(1) * by_eta(0);
        xi -= (at(0) * by_eta(1) - at(1) * by_eta(0)) / determinant;
        eta -= (by_xi(0) * at(1) - by_xi(1) * at(0)) / determinant;
    }
    (xi, eta)
}

/// The bay of a node line: the one whose fractions of its middle lie between 0 and 1.
fn bay_of(planform: &Planform, line: &[PlanPoint]) -> usize {
    let k = line.len() / 2;
    let middle = [0, 1].map(|c| 0.5 * (line[k][c] + line[k - 1][c]));
    let inside = |&bay: &usize| {
        let (xi, eta) = fractions(planform, bay, middle);
        let within = -1e-9..=1.0 + 1e-9;
        within.contains(&xi) && within.contains(&eta)
    };
    (0..3).find(inside).expect("a bay")
}

/// Displacement at a place of a bay, the root's zero.
fn displacement(shape: &[f64; 9], mid: f64, bay: usize, (xi, eta): (f64, f64)) -> f64 {
    let rib = |rib: usize| {
        if rib == 3 { 0.0 } else { along_rib(&shape[3 * rib..3 * rib + 3], mid, xi) }
    };
    (1.0 - eta) * rib(bay) + eta * rib(bay + 1)
}

#[test]
fn dynamic_points_lie_on_the_ribs() {
    let planform = planform();
    let points = planform.dynamic_points();
    assert_eq!(points.len(), 9);
    for rib in 0..3 {
        let [rear, front] = planform.ribs[rib];
        assert_eq!((points[3 * rib], points[3 * rib + 2]), (rear, front));
        let mid = points[3 * rib + 1];
        for k in 0..2 {
            let expected = rear[k] + 0.5107 * (front[k] - rear[k]);
            assert!((mid[k] - expected).abs() < 40.0 * ROUND_OFF);
        }
    }
    let grids = &Reconstruction::embedded().expect("the box").grids;
    assert_eq!(planform.ribs[3].map(|[x, y]| (x, y)), [(grids[&13][0], 0.0), (grids[&15][0], 0.0)]);
}

#[test]
fn a_nod_of_the_tip_has_one_node_line_across_the_tip_bay() {
    // The tip rib up, the outboard one down by as much: the line lies halfway, and nowhere else is a zero.
    let planform = planform();
    let lines = planform.node_lines(&[1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0, -1.0, -1.0]);
    assert_eq!(lines.len(), 1);
    for place in &lines[0] {
        let (_, eta) = fractions(&planform, 0, *place);
        assert!((eta - 0.5).abs() < NODE_LINE);
    }
    assert_eq!(lines[0].len(), 25);
}

#[test]
fn a_twist_has_its_node_line_along_the_middle_to_the_root() {
    let planform = planform();
    // Linear along each rib with its zero at 0.4 of the chord.
    let mid = planform.mid_chord_fraction;
    let rib = |scale: f64| [-0.4, mid - 0.4, 0.6].map(|w| scale * w);
    let shape: Vec<f64> = [3.0, 2.0, 1.0].into_iter().flat_map(rib).collect();
    let shape: [f64; 9] = shape.try_into().expect("nine");
    let lines = planform.node_lines(&shape);
    // In the outer bays both ribs vanish at the same place, where the line has no width to be drawn in.
    let inboard = lines.last().expect("a line");
    assert_eq!(inboard.len(), 2);
    for (end, rib) in inboard.iter().zip([2, 3]) {
        let expected = planform.on_rib(rib, 0.4);
        assert!((end[0] - expected[0]).hypot(end[1] - expected[1]) < NODE_LINE);
    }
}

proptest! {
    #![proptest_config(crate::common::config())]

    #[test]
    fn interpolation_passes_through_the_nine_points(shape in shape()) {
        let planform = planform();
        let ribs = planform.rib_shapes(&shape);
        for (rib, values) in shape.chunks(3).enumerate() {
            for (xi, value) in [0.0, planform.mid_chord_fraction, 1.0].into_iter().zip(values) {
                prop_assert!((ribs[rib].at(xi) - value).abs() < 100.0 * ROUND_OFF);
            }
        }
        prop_assert_eq!(ribs[3].at(0.3), 0.0, "the root is held");
    }

    #[test]
    fn rib_ends_turn_by_equal_and_opposite_angles_from_the_chord(values in prop::array::uniform3(-1.0..1.0_f64), mid in 0.2..0.8_f64) {
        let rib = RibShape::through(values, mid);
        let chord = values[2] - values[0];
        // A parabola's slope at an end is exact by a one-sided difference of three points.
        let slope = |at: f64, h: f64| (4.0 * rib.at(at + h) - 3.0 * rib.at(at) - rib.at(at + 2.0 * h)) / (2.0 * h);
        let (rear, front) = (slope(0.0, 0.1) - chord, slope(1.0, -0.1) - chord);
        prop_assert!((rear + front).abs() < 1e3 * ROUND_OFF);
        for xi in [0.1, 0.35, 0.9] {
            prop_assert!((rib.at(xi) - along_rib(&values, mid, xi)).abs() < 100.0 * ROUND_OFF);
        }
    }

    #[test]
    fn zeros_of_a_rib_are_all_its_zeros(values in prop::array::uniform3(-1.0..1.0_f64), mid in 0.2..0.8_f64) {
        let rib = RibShape::through(values, mid);
        let zeros = rib.zeros();
        for &xi in &zeros {
            prop_assert!((0.0..=1.0).contains(&xi) && rib.at(xi).abs() < NODE_LINE);
        }
        prop_assert!(zeros.is_sorted());
        // As many as the signs at the ends and at the extremum tell.
        let ends_differ = values[0] * values[2] < 0.0;
        prop_assert_eq!(zeros.len() % 2 == 1, ends_differ);
        if !ends_differ && values[1] * values[0] < 0.0 {
            prop_assert_eq!(zeros.len(), 2);
        }
    }

    #[test]
    fn node_lines_lie_where_the_displacement_vanishes(shape in shape()) {
        let planform = planform();
        for line in planform.node_lines(&shape) {
            let bay = bay_of(&planform, &line);
            for place in line {
                let (xi, eta) = fractions(&planform, bay, place);
                let w = displacement(&shape, planform.mid_chord_fraction, bay, (xi, eta));
                prop_assert!(w.abs() < NODE_LINE, "{w} in bay {bay}");
            }
        }
    }

    #[test]
    fn every_change_of_sign_between_ribs_is_on_a_node_line(shape in shape(), xi in 0.01..0.99_f64) {
        let planform = planform();
        let mid = planform.mid_chord_fraction;
        let lines = planform.node_lines(&shape);
        for bay in 0..2 {
            let (a, b) = (displacement(&shape, mid, bay, (xi, 0.0)), displacement(&shape, mid, bay, (xi, 1.0)));
            let crossing = lines.iter().filter(|line| bay_of(&planform, line) == bay).filter(|line| {
                let first = fractions(&planform, bay, line[0]).0;
                let last = fractions(&planform, bay, line[line.len() - 1]).0;
                first < xi && xi < last
            });
            prop_assert_eq!(crossing.count(), usize::from(a * b < 0.0));
        }
        let inboard = lines.iter().filter(|line| bay_of(&planform, line) == 2).count();
        let rib = RibShape::through([shape[6], shape[7], shape[8]], mid);
        prop_assert_eq!(inboard, rib.zeros().len());
    }

    #[test]
    fn node_lines_do_not_depend_on_scale_or_sign(shape in shape(), scale in prop_oneof![-4.0..-0.25_f64, 0.25..4.0_f64]) {
        let planform = planform();
        let lines = planform.node_lines(&shape);
        let scaled = planform.node_lines(&shape.map(|w| scale * w));
        prop_assert_eq!(lines.len(), scaled.len());
        for (p, q) in lines.iter().flatten().zip(scaled.iter().flatten()) {
            prop_assert!((p[0] - q[0]).hypot(p[1] - q[1]) < 1e3 * NODE_LINE);
        }
    }
}

/// Largest difference along the ribs between the interpolation of the nine points and Hermite's cubics with the model's own
/// rotations of the spars, $q_S = B^t q_D$; for every test mode, of its largest displacement.
fn without_rotations(result: &CaseResult) -> [f64; 9] {
    let case = &result.case;
    let model = case.model_with(&[TEST_GAGE; 15]).expect("a model");
    let sizes = model.sizes(&[1.0; 15]).expect("sizes");
    let free = model.structure().free_dof();
    let structural = FactorizedStiffness::new(model.element_matrices(), &sizes, free).expect("held");
    let condensed = condense(&structural, model.load_distribution()).expect("condensed");
    let planform = Planform::of(&case.reconstruction);
    let grids = &case.reconstruction.grids;
    std::array::from_fn(|mode| {
        let column = result.test.shapes.column(mode);
        let v = column / column.amax();
        let q = &condensed.transformation * &v;
        let ribs = planform.rib_shapes(&std::array::from_fn(|dof| v[dof]));
        let mut worst = 0.0_f64;
        for rib in 0..3 {
            let [rear, front] = planform.ribs[rib];
            let chord = [front[0] - rear[0], front[1] - rear[1]];
            let turn = |upper: usize| {
                let depth = grids[&upper][2] - grids[&(upper + 1)][2];
                let along = |grid: usize| chord[0] * q[3 * grid - 3] + chord[1] * q[3 * grid - 2];
                // Times the chord's length already, as Hermite's cubics want it.
                (along(upper + 1) - along(upper)) / depth
            };
            let cubic = |x: f64| {
                (1.0 - 3.0 * x.powi(2) + 2.0 * x.powi(3)) * v[3 * rib]
                    + (x - 2.0 * x.powi(2) + x.powi(3)) * turn(4 * rib + 1)
                    + (3.0 * x.powi(2) - 2.0 * x.powi(3)) * v[3 * rib + 2]
                    + (x.powi(3) - x.powi(2)) * turn(4 * rib + 3)
            };
            // Both pass through the mid point: the load distribution's transpose says so.
            let mid = cubic(planform.mid_chord_fraction);
            assert!((mid - v[3 * rib + 1]).abs() < NODE_LINE);
            for part in 0..=20 {
                let xi = f64::from(part) / 20.0;
                worst = worst.max((cubic(xi) - ribs[rib].at(xi)).abs());
            }
        }
        worst
    })
}

#[test]
fn rotations_that_the_nine_points_lack_matter_to_chordwise_bending_alone() {
    let worst = [&results()[0], &results()[1]].map(without_rotations);
    let of = |modes: &[usize]| {
        let each = worst.iter().flat_map(|case| modes.iter().map(|mode| case[mode - 1]));
        each.fold(0.0, f64::max)
    };
    // As the documentation of the interpolation states.
    assert_eq!(format!("{:.3} {:.2}", of(&[1, 2, 3, 4, 5]), of(&[6, 7, 8, 9])), "0.037 0.31");
}
