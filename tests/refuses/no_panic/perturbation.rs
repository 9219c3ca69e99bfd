//! Appendix C.

use super::{Answer, Entry, entries};
use corfem::method::appendix_c::general::complex_modes::LeftRightModes;
use corfem::method::appendix_c::general::{self, ModalChange, complex_modes};
use corfem::method::appendix_c::{
    Perturbed, eigensolution, first_order, normalize_with_mass, recursive_1, recursive_1_converged,
};
use corfem::method::error::Error;
use corfem::method::modes::solve;
use nalgebra::DMatrix;

fn perturbed(found: Result<Perturbed, Error>) -> Answer {
    found.map(|Perturbed { roots, shapes }| roots.iter().chain(shapes.iter()).copied().collect())
}

pub const PERTURBATION: &[Entry] = &[
    ("recursive::first_order", |d| {
        let size = d.size();
        perturbed(first_order(&d.vector(size), &d.symmetric(size)))
    }),
    ("recursive::recursive_1", |d| {
        let (size, order) = (d.size(), d.size());
        perturbed(recursive_1(&d.vector(size), &d.symmetric(size), order))
    }),
    ("recursive::recursive_1_converged", |d| {
        let size = d.size();
        perturbed(
            recursive_1_converged(&d.vector(size), &d.symmetric(size), 1e-13, 60)
                .map(|found| found.perturbed),
        )
    }),
    ("general::first_order", |d| {
        perturbed(general::first_order(&d.change()))
    }),
    ("general::recursive_1", |d| {
        let change = d.change();
        perturbed(general::recursive_1(&change, d.size()))
    }),
    ("general::recursive_1_converged", |d| {
        perturbed(
            general::recursive_1_converged(&d.change(), 1e-13, 60).map(|found| found.perturbed),
        )
    }),
    ("general::recursive_2", |d| {
        let change = d.change();
        perturbed(general::recursive_2(&change, d.size()))
    }),
    ("general::original", |d| {
        perturbed(general::original(&d.change()))
    }),
    ("appendix_c::eigensolution", |d| {
        perturbed(eigensolution(&d.change()))
    }),
    ("complex_modes::solve", |d| {
        let size = d.size();
        let g = d
            .symmetric(size)
            .map(|entry| nalgebra::Complex::new(entry, 0.1 * entry));
        complex_modes::solve(&d.symmetric(size), &g).map(|_| Vec::new())
    }),
    ("appendix_c::normalize_with_mass", |d| {
        let size = d.size();
        let mut shapes = d.symmetric(size);
        normalize_with_mass(&mut shapes, &d.symmetric(size)).map(|()| entries(&shapes))
    }),
    ("ModalChange::of_vibrations", |d| {
        let size = d.size();
        ModalChange::of_vibrations(&d.vector(size), d.symmetric(size), d.symmetric(size));
        Ok(Vec::new())
    }),
    ("ModalChange::new", |d| {
        let size = d.size();
        let (stiffness, change, g_change) =
            (d.symmetric(size), d.symmetric(size), d.symmetric(size));
        let modes = match solve(&stiffness, &DMatrix::identity(size, size), size) {
            Ok(modes) if d.below(4) > 0 => LeftRightModes::from(&modes),
            _ => LeftRightModes {
                roots: d.vector(size),
                right: d.symmetric(size),
                left: d.symmetric(size),
            },
        };
        // Whatever takes a change refuses one that is not whole.
        perturbed(general::first_order(&ModalChange::new(
            &stiffness, &modes, &change, &g_change,
        )?))
    }),
    ("ModalChange::transposed", |d| {
        perturbed(general::first_order(&d.change().transposed()))
    }),
];
