//! Matrices, modes and models that nobody means: of any size, of extreme numbers, of what is no number.

use super::draws::Draws;
use corfem::closed_forms::spring_chain::spring_stiffness;
use corfem::method::appendix_c::general::ModalChange;
use corfem::method::model::{DynamicModel, ModalModel, Share};
use corfem::method::modes::{ModeSet, solve};
use corfem::method::structure::Material;
use nalgebra::{DMatrix, DVector, Vector3};

/// Numbers that break things: zeros, ends of the range, and what is no number.
const NASTY: [f64; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    2.0,
    0.5,
    1e-9,
    1e9,
    1e160,
    1e-160,
    1e300,
    1e-300,
    -1e300,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
];

impl Draws {
    /// Half of all numbers are ordinary ones, so that calls come past the first check.
    pub fn number(&mut self) -> f64 {
        if self.below(2) == 0 { NASTY[self.below(NASTY.len())] } else { self.below(2000) as f64 / 100.0 - 8.0 }
    }

    /// Sizes from none to four.
    pub fn size(&mut self) -> usize {
        self.below(5)
    }

    pub fn list(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.number()).collect()
    }

    pub fn vector(&mut self, count: usize) -> DVector<f64> {
        DVector::from_vec(self.list(count))
    }

    pub fn matrix(&mut self, rows: usize, columns: usize) -> DMatrix<f64> {
        DMatrix::from_vec(rows, columns, self.list(rows * columns))
    }

    /// Of the size wanted, or now and then of another.
    pub fn about(&mut self, size: usize) -> usize {
        if self.below(8) == 0 { self.size() } else { size }
    }

    /// A matrix that is meant to be symmetric: often it is, often definite, and scaled by anything.
    pub fn symmetric(&mut self, size: usize) -> DMatrix<f64> {
        let (rows, columns) = (self.about(size), self.about(size));
        let matrix = self.matrix(rows, columns);
        match self.below(4) {
            0 => matrix,
            1 if rows == columns => &matrix + matrix.transpose(),
            _ if rows == columns => {
                let tame = matrix.map(|entry| if entry.abs() < 1e3 { entry } else { 1.0 });
                let scale = [1.0, 1.0, 1e160, 1e-160, 1e300, 1e-300][self.below(6)];
                (&tame * tame.transpose() + DMatrix::identity(rows, rows)) * scale
            }
            _ => matrix,
        }
    }

    pub fn modes(&mut self, dof: usize) -> ModeSet {
        let (rows, count) = (self.about(dof), self.size());
        let length = self.about(count);
        ModeSet { omega_squared: self.vector(length), shapes: self.matrix(rows, count) }
    }

    pub fn corners(&mut self) -> [Vector3<f64>; 4] {
        let flat = self.below(2) == 0;
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        square.map(|[x, y]| {
            let moved = if self.below(4) == 0 { self.number() } else { 0.0 };
            Vector3::new(10.0 * x + moved, 7.0 * y, if flat { 0.0 } else { self.number() })
        })
    }

    pub fn material(&mut self) -> Material {
        let mut metal = Material::isotropic(1e7, 0.3).expect("a metal");
        if self.below(2) == 0 {
            (metal.youngs_modulus, metal.poissons_ratio) = (self.number(), self.number());
            (metal.shear_modulus, metal.density) = (self.number(), self.number());
        }
        metal
    }

    pub fn shares(&mut self, size: usize) -> Vec<Share> {
        let share = |draws: &mut Self| {
            let matrix = draws.symmetric(size);
            if draws.below(3) == 0 { Share::Mass(matrix) } else { Share::Stiffness(matrix) }
        };
        (0..self.below(4)).map(|_| share(self)).collect()
    }

    pub fn dynamic(&mut self) -> DynamicModel {
        let size = self.size();
        DynamicModel { stiffness: self.symmetric(size), mass: self.symmetric(size), shares: self.shares(size) }
    }

    /// A spring chain and its modal model: what comes out of a constructor, for the loops to be given bad settings and factors.
    pub fn chain(&mut self) -> Option<ModalModel> {
        let count = 1 + self.below(4);
        let share = |spring: usize| Share::Stiffness(spring_stiffness(count, spring, 100.0));
        let shares: Vec<Share> = (0..count).map(share).collect();
        let stiffness = shares.iter().map(Share::matrix).sum::<DMatrix<f64>>();
        let mass = DMatrix::identity(count, count);
        let test = solve(&(1.2 * &stiffness), &mass, count).ok()?;
        DynamicModel { stiffness, mass, shares }.analyze(&test, None).ok()
    }

    /// A change of stiffness and mass that fits together or does not.
    pub fn change(&mut self) -> ModalChange<f64> {
        let size = self.size();
        let (alpha, beta, length) = (self.symmetric(size), self.symmetric(size), self.about(size));
        ModalChange::of_vibrations(&self.vector(length), beta, alpha)
    }
}
