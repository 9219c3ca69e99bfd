//! The Garvey shear panel against hand results and against the closed forms of its energy.

use crate::common::closed_forms::analytical::Flat;
use crate::common::panels::{distorted_panel, general_panel, parallelogram, placed, trapezoid};
use crate::prelude::*;

type Corners = [Vector3<f64>; 4];

/// How far a closed form lies from the quadrature, relative.
fn discrepancy(
    closed_form: fn(&Flat, &Material) -> f64,
    corners: &Corners,
    material: &Material,
) -> f64 {
    (closed_form(&mean_plane(corners), material) / energy_coefficient(corners, material) - 1.0)
        .abs()
}

/// Relative change of a panel's energy by the rounding of its corners: each of its eight coordinates in its plane is off
/// by the spacing of numbers at the farthest corner, and its two sides are parallel to so much of the shortest side.
fn rounding_of_place(corners: &Corners) -> f64 {
    let farthest = corners.iter().map(Vector3::norm).fold(0.0, f64::max);
    let sides = (0..4).map(|corner| (corners[(corner + 1) % 4] - corners[corner]).norm());
    8.0 * f64::EPSILON * farthest / sides.fold(f64::INFINITY, f64::min)
}

/// The same corners, named from the second on.
fn next_first([a, b, c, d]: Corners) -> Corners {
    [b, c, d, a]
}

fn aluminum() -> Material {
    Material::isotropic(1e7, 0.3).unwrap()
}

properties! {
    #[test]
    fn quadrature_is_exact_for_parallelograms(corners in placed(parallelogram()), material in material()) {
        let found = discrepancy(parallelogram_energy, &corners, &material);
        prop_assert!(found <= ELEMENT_ROUND_OFF, "{found:e}");
    }

    #[test]
    fn quadrature_equals_the_closed_forms_of_trapezoids(corners in placed(trapezoid()), material in material()) {
        let limit = QUADRATURE_TRAPEZOID + rounding_of_place(&corners);
        let found = discrepancy(sides_12_34_parallel_energy, &corners, &material);
        prop_assert!(found <= limit, "12 and 34: {found:e}");
        let found = discrepancy(sides_14_23_parallel_energy, &next_first(corners), &material);
        prop_assert!(found <= limit, "14 and 23: {found:e}");
    }

    #[test]
    fn quadrature_equals_the_closed_form_of_general_panels(
        corners in placed(general_panel()),
        material in material(),
    ) {
        let found = discrepancy(no_sides_parallel_energy, &corners, &material);
        prop_assert!(found <= CLOSED_FORM_GENERAL, "{found:e}");
    }

    #[test]
    fn quadrature_holds_on_strongly_distorted_panels(
        corners in placed(distorted_panel()),
        material in material(),
    ) {
        let found = discrepancy(no_sides_parallel_energy, &corners, &material);
        prop_assert!(found <= QUADRATURE_DISTORTED, "{found:e}");
    }

    #[test]
    fn corner_forces_are_in_equilibrium(corners in prop_oneof![placed(flat_panel()), placed(warped_panel())]) {
        let forces = corner_forces(&corners);
        prop_assert_eq!(forces.len(), 12);
        let at = |corner: usize| forces.fixed_rows::<3>(3 * corner).into_owned();
        let resultant: Vector3<f64> = (0..4).map(at).sum();
        let moment: Vector3<f64> =
            (0..4).map(|corner| (corners[corner] - corners[0]).cross(&at(corner))).sum();
        let size = (corners[2] - corners[0]).norm();
        prop_assert!(resultant.norm() <= ELEMENT_ROUND_OFF * forces.amax());
        prop_assert!(moment.norm() <= ELEMENT_ROUND_OFF * forces.amax() * size);
    }

    /// Cut free of its other side, each end of side 1-2 receives half the side's resultant, its length times the unit
    /// flow; what else it receives runs along the other side and so has no moment about that side's far end.
    #[test]
    fn a_unit_flow_leaves_half_its_resultant_at_each_end_of_side_12(corners in placed(flat_panel())) {
        let forces = corner_forces(&corners);
        let half_side = 0.5 * (corners[1] - corners[0]);
        for (corner, far) in [(0, 3), (1, 2)] {
            let force = forces.fixed_rows::<3>(3 * corner).into_owned();
            let other_side = corners[far] - corners[corner];
            let excess = (force - half_side).cross(&other_side).norm();
            prop_assert!(excess <= ELEMENT_ROUND_OFF * forces.amax() * other_side.norm(), "{excess:e}");
        }
    }

    /// The panel answers a motion q with the flow a·q/(2Z), so its energy is that flow's: Z times its square.
    #[test]
    fn a_motions_energy_is_that_of_the_flow_it_raises(
        corners in placed(flat_panel()),
        material in material(),
        motion in prop::collection::vec(-1.0..1.0_f64, 12),
    ) {
        let z = energy_coefficient(&corners, &material);
        let motion = DVector::from_vec(motion);
        let flow = corner_forces(&corners).dot(&motion) / (2.0 * z);
        let stiffness = shear_panel(&corners, &material);
        let energy = 0.5 * motion.dot(&(&stiffness * &motion));
        let scale = stiffness.amax() * motion.norm_squared();
        prop_assert!((energy - z * flow * flow).abs() <= ELEMENT_ROUND_OFF * scale);
    }
}

#[test]
fn a_rectangles_stiffness_is_the_hand_result() {
    let (length, width) = (4.0, 3.0);
    let corners = [(0.0, 0.0), (length, 0.0), (length, width), (0.0, width)]
        .map(|(x, y)| Vector3::new(x, y, 1.0));
    let material = aluminum();
    // A flow of one along each side, half of it to each of the side's corners.
    let (fx, fy) = (length / 2.0, width / 2.0);
    let a = dvector![fx, fy, 0.0, fx, -fy, 0.0, -fx, -fy, 0.0, -fx, fy, 0.0];
    let by_hand = material.shear_modulus / (length * width) * &a * a.transpose();
    let found = shear_panel(&corners, &material);
    assert!(relative_distance(&found, &by_hand) <= ROUND_OFF);
    // A shear strain of one per thousand: half of stress times strain times area.
    let strain = 1e-3;
    let sheared = DVector::from_iterator(12, corners.iter().flat_map(|c| [strain * c.y, 0.0, 0.0]));
    let energy = 0.5 * sheared.dot(&(&found * &sheared));
    let expected = 0.5 * material.shear_modulus * strain * strain * length * width;
    assert!(relative_error(energy, expected) <= ROUND_OFF);
    let z = energy_coefficient(&corners, &material);
    assert_alike(
        [z * 2.0 * material.shear_modulus],
        [(length * width)],
        ROUND_OFF,
    );
}

/// Tilting side 3-4 by ε moves the energy by as much: no band of angles within which sides count as parallel.
#[test]
fn sides_become_parallel_without_a_jump() {
    let material = aluminum();
    let energy = |tilt: f64| {
        let corners = [(0.0, 0.0), (6.0, 0.0), (5.0, 4.0 - tilt), (0.5, 4.0)]
            .map(|(x, y)| Vector3::new(x, y, 0.0));
        energy_coefficient(&corners, &material)
    };
    let parallel = energy(0.0);
    let points: Vec<(f64, f64)> = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6]
        .map(|tilt| (tilt, relative_error(energy(tilt), parallel)))
        .to_vec();
    let slope = log_log_slope(&points);
    assert_within(slope, 1.0, SLOPE);
    assert!(relative_error(energy(1e-12), parallel) < ELEMENT_ROUND_OFF);
}

/// NASTRAN uses the closed form for parallel sides also where they are parallel only nearly, so each of its terms counts.
#[test]
fn parallelogram_formula_has_a_term_for_every_side() {
    let corners = [
        Vector2::new(0.0, 0.0),
        Vector2::new(10.0, 0.0),
        Vector2::new(11.0, 5.0),
        Vector2::new(2.0, 4.0),
    ];
    let plane = mean_plane(&corners.map(|corner: Vector2<f64>| corner.push(0.0)));
    let material = aluminum();
    let d = -0.5 * (2.0 / 4.0 + (11.0 - 10.0) / 5.0 + (5.0 - 4.0) / (11.0 - 2.0));
    let expected = 42.0 / (2.0 * material.shear_modulus)
        * (1.0 + 2.0 * d * d / (1.0 + material.poissons_ratio));
    assert_relative_eq!(
        parallelogram_energy(&plane, &material),
        expected,
        max_relative = ROUND_OFF
    );
}
