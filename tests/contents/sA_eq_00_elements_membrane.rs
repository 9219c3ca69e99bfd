//! Triangle, membrane and rod against hand results and constant strain.

use crate::common::panels::placed;
use crate::prelude::*;

/// Any displacement gradient: nine numbers, of which the strain in a plane sees three.
fn gradient() -> impl Strategy<Value = Matrix3<f64>> {
    prop::collection::vec(-1.0..1.0_f64, 9).prop_map(|entries| Matrix3::from_column_slice(&entries))
}

/// The motion u = H x of the corners.
fn linear_motion(corners: &[Vector3<f64>], gradient: &Matrix3<f64>) -> DVector<f64> {
    let from = corners[0];
    DVector::from_iterator(
        3 * corners.len(),
        corners
            .iter()
            .flat_map(|corner| (gradient * (corner - from)).data.0[0]),
    )
}

fn energy(stiffness: &DMatrix<f64>, motion: &DVector<f64>) -> f64 {
    0.5 * motion.dot(&(stiffness * motion))
}

/// Plane-stress energy per area and thickness of the strain that a gradient makes in the plane of three points, by
/// invariants: E/(2(1−ν²))·(tr² − 2(1−ν)·det).
fn energy_density(plane: [Vector3<f64>; 3], gradient: &Matrix3<f64>, material: &Material) -> f64 {
    let along = (plane[1] - plane[0]).normalize();
    let normal = along.cross(&(plane[2] - plane[0])).normalize();
    let across = normal.cross(&along);
    let strain = |u: &Vector3<f64>, v: &Vector3<f64>| {
        0.5 * (u.dot(&(gradient * v)) + v.dot(&(gradient * u)))
    };
    let trace = strain(&along, &along) + strain(&across, &across);
    let determinant =
        strain(&along, &along) * strain(&across, &across) - strain(&along, &across).powi(2);
    let nu = material.poissons_ratio;
    material.youngs_modulus / (2.0 * (1.0 - nu * nu))
        * (trace * trace - 2.0 * (1.0 - nu) * determinant)
}

fn triangle_area([a, b, c]: [Vector3<f64>; 3]) -> f64 {
    0.5 * (b - a).cross(&(c - a)).norm()
}

properties! {
    #[test]
    fn a_triangle_holds_the_energy_of_constant_strain(
        corners in placed(flat_panel()),
        gradient in gradient(),
        material in material(),
    ) {
        let corners = [corners[0], corners[1], corners[2]];
        let stiffness = triangle(&corners, &material);
        let motion = linear_motion(&corners, &gradient);
        let expected = triangle_area(corners) * energy_density(corners, &gradient, &material);
        let scale = stiffness.amax() * motion.norm_squared();
        prop_assert!((energy(&stiffness, &motion) - expected).abs() <= ELEMENT_ROUND_OFF * scale);
    }

    #[test]
    fn a_flat_membrane_holds_the_energy_of_constant_strain(
        corners in placed(flat_panel()),
        gradient in gradient(),
        material in material(),
    ) {
        let stiffness = membrane(&corners, &material);
        let motion = linear_motion(&corners, &gradient);
        let [a, b, c, d] = corners;
        let area = triangle_area([a, b, c]) + triangle_area([a, c, d]);
        let expected = area * energy_density([a, b, d], &gradient, &material);
        let scale = stiffness.amax() * motion.norm_squared();
        prop_assert!((energy(&stiffness, &motion) - expected).abs() <= ELEMENT_ROUND_OFF * scale);
    }

    /// Half of each of the two ways to cut the panel along a diagonal, each triangle in its own plane.
    #[test]
    fn a_warped_membrane_is_the_mean_of_its_two_triangulations(
        corners in placed(warped_panel()),
        gradient in gradient(),
        material in material(),
    ) {
        let [a, b, c, d] = corners;
        let expected: f64 = [[a, b, c], [a, c, d], [a, b, d], [b, c, d]]
            .into_iter()
            .map(|cut| 0.5 * triangle_area(cut) * energy_density(cut, &gradient, &material))
            .sum();
        let stiffness = membrane(&corners, &material);
        let motion = linear_motion(&corners, &gradient);
        let scale = stiffness.amax() * motion.norm_squared();
        prop_assert!((energy(&stiffness, &motion) - expected).abs() <= ELEMENT_ROUND_OFF * scale);
    }
}

/// Right triangle with unit legs along x and y; the constant strains are differences of corner motions.
#[test]
fn a_right_triangles_stiffness_is_the_hand_result() {
    let material = Material {
        youngs_modulus: 1.0,
        poissons_ratio: 0.25,
        shear_modulus: 0.4,
        density: 0.0,
    };
    let found = triangle(&[Vector3::zeros(), Vector3::x(), Vector3::y()], &material);
    let strain = DMatrix::from_row_slice(
        3,
        9,
        &[
            -1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, // u2 − u1
            0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, // v3 − v1
            -1.0, -1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, // u3 − u1 + v2 − v1
        ],
    );
    // E/(1 − ν²) = 16/15, ν times it 4/15, and G as given.
    let elasticity =
        dmatrix![16.0 / 15.0, 4.0 / 15.0, 0.0; 4.0 / 15.0, 16.0 / 15.0, 0.0; 0.0, 0.0, 0.4];
    let by_hand = 0.5 * strain.transpose() * elasticity * strain;
    assert!(relative_distance(&found, &by_hand) <= ROUND_OFF);
}

/// A rod from the origin to (3, 4, 0), five long: direction cosines 0.6 and 0.8.
#[test]
fn a_rods_stiffness_is_the_hand_result() {
    let found = rod(&[Vector3::zeros(), Vector3::new(3.0, 4.0, 0.0)], 10.0);
    let quarter = [0.72, 0.96, 0.0, 0.96, 1.28, 0.0, 0.0, 0.0, 0.0];
    let by_hand = DMatrix::from_fn(6, 6, |row, column| {
        let sign = if (row < 3) == (column < 3) { 1.0 } else { -1.0 };
        sign * quarter[3 * (row % 3) + column % 3]
    });
    assert!(relative_distance(&found, &by_hand) <= ROUND_OFF);
}

/// Plane stress knows no length: a triangle of a millionth of the size is as stiff, and no degenerate one.
#[test]
fn stiffness_of_a_triangle_does_not_depend_on_its_size() {
    let material = Material::isotropic(1e7, 0.3).unwrap();
    let corners = [
        Vector3::new(0.0, 0.0, 0.0),
        Vector3::new(4.0, 1.0, 0.0),
        Vector3::new(1.0, 3.0, 2.0),
    ];
    let stiffness = triangle(&corners, &material);
    for scale in [1e-6, 1e6] {
        let scaled = triangle(&corners.map(|corner| scale * corner), &material);
        assert!(relative_distance(&scaled, &stiffness) <= ELEMENT_ROUND_OFF);
    }
}

/// A material may have another G than E/(2(1 + ν)). Half a square inch that is sheared by one holds G/4.
#[test]
fn a_sheared_triangle_has_the_shear_modulus_of_its_material() {
    let material = Material {
        shear_modulus: 3.0,
        ..Material::isotropic(10.0, 0.25).unwrap()
    };
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(Vector3::from);
    let sheared = Matrix3::new(0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    let motion = linear_motion(&corners, &sheared);
    let held = energy(&triangle(&corners, &material), &motion);
    assert_alike([held], [0.75], ROUND_OFF);
}
