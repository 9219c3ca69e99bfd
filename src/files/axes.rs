//! Coordinate systems of grids and of nodes, Cartesian or cylindrical.

use nalgebra::{Matrix3, Vector3};

/// A coordinate system; a spherical one is known and not used.
#[derive(Debug, Clone, Copy)]
pub struct Axes {
    /// 0 of a Cartesian one, 1 of a cylindrical one, 2 of a spherical one.
    pub kind: usize,
    pub origin: Vector3<f64>,
    /// Unit vectors along the axes, in columns.
    pub rotation: Matrix3<f64>,
}

impl Axes {
    /// The global axes.
    pub const GLOBAL: Self = Self {
        kind: 0,
        origin: Vector3::new(0.0, 0.0, 0.0),
        rotation: Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
    };

    /// The system of an origin, of a point on its x or z axis, the place of which in columns is 0 or 2, and of a third in its xz plane, all in
    /// coordinates of this one; none where the three lie on a line but for this part of their distance.
    pub fn through(
        &self,
        points: [Vector3<f64>; 3],
        kind: usize,
        axis: usize,
        round_off: f64,
    ) -> Option<Self> {
        let [origin, along, across] = points.map(|point| self.place(point));
        let (along, across) = (along - origin, across - origin);
        let first = along.try_normalize(0.0)?;
        // The y axis, or, where x is given, against it.
        let normal = first
            .cross(&across)
            .try_normalize(round_off * across.norm())?;
        let last = normal.cross(&first);
        let columns = match axis {
            0 => [first, -normal, last],
            _ => [last, normal, first],
        };
        Some(Self {
            kind,
            origin,
            rotation: Matrix3::from_columns(&columns),
        })
    }

    /// The global place of coordinates in the system: of a cylindrical one radius, angle in degrees and height.
    pub fn place(&self, at: Vector3<f64>) -> Vector3<f64> {
        let (sine, cosine) = at.y.to_radians().sin_cos();
        let at = match self.kind {
            1 => Vector3::new(at.x * cosine, at.x * sine, at.z),
            _ => at,
        };
        self.origin + self.rotation * at
    }

    /// Unit vectors along the system's directions at a global place, in columns: of a cylindrical one outward, around and along its axis;
    /// none on that axis, whose distance is round-off up to this part of the place's.
    pub fn directions(&self, place: Vector3<f64>, round_off: f64) -> Option<Matrix3<f64>> {
        if self.kind == 0 {
            return Some(self.rotation);
        }
        let own = self.rotation.tr_mul(&(place - self.origin));
        let outward = own.xy().try_normalize(round_off * own.norm())?;
        let turn = Matrix3::new(
            outward.x, -outward.y, 0.0, outward.y, outward.x, 0.0, 0.0, 0.0, 1.0,
        );
        Some(self.rotation * turn)
    }
}
