//! Appendix C.

use super::{Entry, Numbers, told};
use crate::prelude::*;

pub const PERTURBATION: &[Entry] = &[
    ("perturbation::first_order", |d| {
        let size = d.size();
        told(first_order(&d.vector(size), &d.symmetric(size)))
    }),
    ("perturbation::recursive_1", |d| {
        let (size, order) = (d.size(), d.size());
        told(recursive_1(&d.vector(size), &d.symmetric(size), order))
    }),
    ("perturbation::recursive_1_converged", |d| {
        let size = d.size();
        let found = recursive_1_converged(&d.vector(size), &d.symmetric(size));
        told(found.map(|found| found.perturbed))
    }),
    // A sum beyond the largest number, and a stiffness that is none, are refused by the formulae.
    ("Pencil::of_vibrations", |d| {
        let size = d.size();
        Pencil::of_vibrations(&d.vector(size), &d.symmetric(size), &d.symmetric(size))
            .map(|_| Vec::new())
    }),
    ("Pencil::new", |d| {
        let size = d.size();
        let (stiffness, change, g_change) =
            (d.symmetric(size), d.symmetric(size), d.symmetric(size));
        let modes = match solve(&stiffness, &eye(size), size) {
            Ok(modes) if d.below(4) > 0 => on_either_side(&modes),
            _ => LeftRightModes {
                roots: d.vector(size),
                right: d.symmetric(size),
                left: d.symmetric(size),
            },
        };
        let found = Pencil::new(&stiffness, &modes, &change, &g_change)?;
        told(found.first_order())
    }),
    ("Pencil::transposed", |d| {
        told(d.change().pencil()?.transposed().first_order())
    }),
    ("Pencil::first_order", |d| {
        told(d.change().pencil()?.first_order())
    }),
    ("Pencil::recursive_1", |d| {
        let found = d.change().pencil()?;
        told(found.recursive_1(d.size()))
    }),
    ("Pencil::recursive_1_converged", |d| {
        let found = d.change().pencil()?.recursive_1_converged();
        told(found.map(|found| found.perturbed))
    }),
    ("Pencil::recursive_2", |d| {
        let found = d.change().pencil()?;
        told(found.recursive_2(d.size()))
    }),
    ("Pencil::original", |d| {
        told(d.change().pencil()?.original())
    }),
    ("appendix_c::solve", |d| {
        let size = d.size();
        let g = d
            .symmetric(size)
            .map(|entry| Complex::new(entry, 0.1 * entry));
        appendix_c::solve(&d.symmetric(size), &g).map(|_| Vec::new())
    }),
    ("mass_changes::normalize_with_mass", |d| {
        let size = d.size();
        let mut shapes = d.symmetric(size);
        normalize_with_mass(&mut shapes, &d.symmetric(size)).map(|()| shapes.numbers())
    }),
];
