//! Matrices, modes and measured modes.

use super::{Entry, Numbers, chain, unseen};
use crate::prelude::*;
use corfem::method::linear_algebra::check_length;

pub const MATRICES: &[Entry] = &[
    ("linear_algebra::check_finite", |d| {
        let matrix = d.symmetric(3);
        check_finite("matrix", &matrix).map(|()| matrix.numbers())
    }),
    ("linear_algebra::check_symmetric", |d| {
        check_symmetric("matrix", &d.symmetric(3)).map(Numbers::numbers)
    }),
    ("linear_algebra::cholesky", |d| {
        let size = d.size();
        cholesky("matrix", &d.symmetric(size), 0.0).map(Numbers::numbers)
    }),
    ("linear_algebra::symmetric_eigen", |d| {
        let size = d.size();
        symmetric_eigen("matrix", &d.symmetric(size))
            .map(|(values, vectors)| values.iter().chain(vectors.iter()).copied().collect())
    }),
    ("linear_algebra::symmetric_part", |d| {
        unseen(symmetric_part(&d.symmetric(3)))
    }),
    ("modes::solve", |d| {
        let (size, count) = (d.size(), d.size());
        solve(&d.symmetric(size), &d.symmetric(size), count).map(Numbers::numbers)
    }),
    ("Modes::from_measured", |d| {
        let (count, dof) = (d.size(), d.size());
        let (frequencies, columns) = (d.list(count), d.about(count));
        Modes::from_measured(&frequencies, &d.matrix(dof, columns)).map(Numbers::numbers)
    }),
    ("Modes::scaled_with", |d| {
        let size = d.size();
        d.modes(size)?
            .scaled_with(&d.symmetric(size))
            .map(|found| found.shapes().clone().numbers())
    }),
    ("modes::apply_sign_rule", |d| {
        let mut shapes = d.symmetric(3);
        apply_sign_rule(&mut shapes);
        unseen(shapes)
    }),
    ("sorting::cross_orthogonality", |d| {
        let size = d.size();
        let (one, other, mass) = (d.modes(size)?, d.modes(size)?, d.symmetric(size));
        cross_orthogonality(&one, &other, &mass).map(|_| Vec::new())
    }),
    ("assurance::modal_assurance", |d| {
        let (rows, one, other) = (d.size(), d.size(), d.size());
        let others = d.about(rows);
        modal_assurance(&d.matrix(rows, one), &d.matrix(others, other)).map(Numbers::numbers)
    }),
    ("sorting::pair_modes", |d| {
        let (rows, columns) = (d.size(), d.size());
        pair_modes(&d.matrix(rows, columns)).map(|found| found.sign)
    }),
    ("modes::generalized_mass", |d| {
        let size = d.size();
        generalized_mass(d.modes(size)?.shapes(), &d.symmetric(size)).map(Numbers::numbers)
    }),
    ("appendix_b::orthogonalize", |d| {
        let size = d.size();
        orthogonalize(&d.modes(size)?, &d.symmetric(size)).map(|found| found.modes.numbers())
    }),
    ("appendix_b::balance", |d| {
        let (size, rigid) = (d.size(), d.size());
        let (set, mut stiffness, mass) = (d.modes(size)?, d.symmetric(size), d.symmetric(size));
        let mut motions = d.matrix(size, rigid);
        if d.below(2) == 0 {
            // A free structure and its motion, so that some calls are answered.
            (stiffness, motions) = (zero_square(size), DMatrix::from_element(size, 1, 1.0));
        }
        balance(&set, &stiffness, &mass, &motions).map(|found| found.shapes.numbers())
    }),
    ("appendix_b::examine", |d| {
        let size = d.size();
        let limits = MovementLimits {
            balance: d.number(),
            frequency: d.number(),
            shape: d.number(),
        };
        let limits = if d.below(2) == 0 {
            MovementLimits::default()
        } else {
            limits
        };
        examine(&d.modes(size)?, &d.symmetric(size), Supports::Held, &limits)
            .map(|found| found.modes.numbers())
    }),
    ("appendix_b::rigid_body_vectors", |d| {
        let corners = d.corners();
        let points = corners.map(|position| MeasuringPoint {
            position,
            direction: Vector3::z_axis(),
        });
        rigid_body_vectors(&points);
        Ok(Vec::new())
    }),
    ("linear_algebra::check_shape", |d| {
        let (rows, columns) = (d.size(), d.size());
        check_shape("matrix", &d.symmetric(3), rows, columns).map(Numbers::numbers)
    }),
    ("linear_algebra::check_length", |d| {
        check_length("list", d.size(), d.size()).map(Numbers::numbers)
    }),
    ("Modes::frequencies_hz", |d| {
        let (size, count) = (d.size(), d.size());
        let frequencies = d.list(count);
        // Modes that were measured have frequencies; of others the square roots are what they are.
        d.modes(size)?.frequencies_hz();
        Modes::from_measured(&frequencies, &d.matrix(size, count))
            .map(|found| found.frequencies_hz())
    }),
    ("Modes::lowest", |d| {
        let count = d.size();
        chain(d)?.exact().modes.lowest(count).map(Numbers::numbers)
    }),
    ("Pairing::paired", |d| {
        let (size, count) = (d.size(), d.size());
        let analysis = d.modes(size)?;
        let pairing = d.pairing(count, analysis.len())?;
        pairing
            .paired(&analysis)
            .map(|found| found.shapes().clone().numbers())
    }),
];
