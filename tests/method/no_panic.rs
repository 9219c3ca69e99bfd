//! Whatever numbers and sizes a public function of the method is given, it answers with an error or with numbers: it does not
//! panic, and it does not return what is no number.
//!
//! `CORFEM_CALLS=20000 cargo test --release no_panic` makes so many calls of every entry point instead of the usual few hundred.

use crate::common::draws::Draws;
use corfem::method::appendix_b::{
    MeasuringPoint, Motion, MovementLimits, Supports, balance, examine, generalized_mass, orthogonalize,
    rigid_body_vectors,
};
use corfem::method::appendix_c::general::{self, complex_modes};
use corfem::method::appendix_c::{
    Perturbed, eigensolution, first_order, normalize_with_mass, recursive_1, recursive_1_converged,
};
use corfem::method::elements::{corner_volumes, membrane, rod, shear, unit_stiffness};
use corfem::method::error::Error;
use corfem::method::inner_loop::{InnerSettings, run};
use corfem::method::linear_algebra::{check_finite, check_symmetric, cholesky, symmetric_eigen, symmetric_part};
use corfem::method::model::Range;
use corfem::method::modes::{ModeSet, apply_sign_rule, solve};
use corfem::method::outer_loop::{Settings, correlate};
use corfem::method::pairing::{cross_orthogonality, modal_assurance, pair_modes};
use corfem::method::state::{ModalState, UpdateRule};
use corfem::method::step::{limited_factor, unlimited_factors};
use corfem::method::structure::{ElementKind, Material};
use nalgebra::{DMatrix, Vector3};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// The numbers of an answer, or that there is an error instead.
type Answer = Result<Vec<f64>, Error>;

fn entries(matrix: &DMatrix<f64>) -> Vec<f64> {
    matrix.iter().copied().collect()
}

fn perturbed(found: Result<Perturbed, Error>) -> Answer {
    found.map(|Perturbed { roots, shapes }| roots.iter().chain(shapes.iter()).copied().collect())
}

fn modes(found: &ModeSet) -> Vec<f64> {
    found.omega_squared.iter().chain(found.shapes.iter()).copied().collect()
}

type Entry = (&'static str, fn(&mut Draws) -> Answer);

/// Every entry point that takes numbers or matrices as they come.
const ENTRIES: &[Entry] = &[
    ("check_finite", |d| {
        let matrix = d.symmetric(3);
        check_finite("matrix", &matrix).map(|()| entries(&matrix))
    }),
    ("check_symmetric", |d| check_symmetric("matrix", &d.symmetric(3)).map(|()| Vec::new())),
    ("cholesky", |d| {
        let size = d.size();
        cholesky("matrix", &d.symmetric(size), 0.0).map(|found| entries(&found))
    }),
    ("symmetric_eigen", |d| {
        let size = d.size();
        symmetric_eigen("matrix", &d.symmetric(size))
            .map(|(values, vectors)| values.iter().chain(vectors.iter()).copied().collect())
    }),
    ("symmetric_part", |d| {
        symmetric_part(&d.symmetric(3));
        Ok(Vec::new())
    }),
    ("modes::solve", |d| {
        let (size, count) = (d.size(), d.size());
        solve(&d.symmetric(size), &d.symmetric(size), count).map(|found| modes(&found))
    }),
    ("from_measured", |d| {
        let (count, dof) = (d.size(), d.size());
        let (frequencies, columns) = (d.list(count), d.about(count));
        ModeSet::from_measured(&frequencies, &d.matrix(dof, columns)).map(|found| modes(&found))
    }),
    ("scaled_with", |d| {
        let size = d.size();
        d.modes(size).scaled_with(&d.symmetric(size)).map(|found| entries(&found.shapes))
    }),
    ("apply_sign_rule", |d| {
        apply_sign_rule(&mut d.symmetric(3));
        Ok(Vec::new())
    }),
    ("cross_orthogonality", |d| {
        let size = d.size();
        let (one, other, mass) = (d.modes(size), d.modes(size), d.symmetric(size));
        cross_orthogonality(&one, &other, &mass).map(|_| Vec::new())
    }),
    ("modal_assurance", |d| {
        let (rows, one, other) = (d.size(), d.size(), d.size());
        let others = d.about(rows);
        modal_assurance(&d.matrix(rows, one), &d.matrix(others, other)).map(|found| entries(&found))
    }),
    ("pair_modes", |d| {
        let (rows, columns) = (d.size(), d.size());
        pair_modes(&d.matrix(rows, columns)).map(|found| found.sign)
    }),
    ("first_order", |d| {
        let size = d.size();
        perturbed(first_order(&d.vector(size), &d.symmetric(size)))
    }),
    ("recursive_1", |d| {
        let (size, order) = (d.size(), d.size());
        perturbed(recursive_1(&d.vector(size), &d.symmetric(size), order))
    }),
    ("recursive_1_converged", |d| {
        let size = d.size();
        perturbed(recursive_1_converged(&d.vector(size), &d.symmetric(size), 1e-13, 60).map(|found| found.perturbed))
    }),
    ("general::first_order", |d| perturbed(general::first_order(&d.change()))),
    ("general::recursive_1", |d| {
        let change = d.change();
        perturbed(general::recursive_1(&change, d.size()))
    }),
    ("general::recursive_1_converged", |d| {
        perturbed(general::recursive_1_converged(&d.change(), 1e-13, 60).map(|found| found.perturbed))
    }),
    ("general::recursive_2", |d| {
        let change = d.change();
        perturbed(general::recursive_2(&change, d.size()))
    }),
    ("general::original", |d| perturbed(general::original(&d.change()))),
    ("eigensolution", |d| perturbed(eigensolution(&d.change()))),
    ("complex_modes", |d| {
        let size = d.size();
        let g = d.symmetric(size).map(|entry| nalgebra::Complex::new(entry, 0.1 * entry));
        complex_modes::solve(&d.symmetric(size), &g).map(|_| Vec::new())
    }),
    ("normalize_with_mass", |d| {
        let size = d.size();
        let mut shapes = d.symmetric(size);
        normalize_with_mass(&mut shapes, &d.symmetric(size)).map(|()| entries(&shapes))
    }),
    ("generalized_mass", |d| {
        let modes = d.modes(3);
        if modes.shapes.nrows() == 3 {
            generalized_mass(&modes.shapes, &DMatrix::identity(3, 3));
        }
        Ok(Vec::new())
    }),
    ("orthogonalize", |d| {
        let size = d.size();
        orthogonalize(&d.modes(size), &d.symmetric(size)).map(|found| modes(&found.modes))
    }),
    ("balance", |d| {
        let (size, rigid) = (d.size(), d.size());
        let (set, mut stiffness, mass) = (d.modes(size), d.symmetric(size), d.symmetric(size));
        let mut motions = d.matrix(size, rigid);
        if d.below(2) == 0 {
            // A free structure and its motion, so that some calls are answered.
            (stiffness, motions) = (DMatrix::zeros(size, size), DMatrix::from_element(size, 1, 1.0));
        }
        balance(&set, &stiffness, &mass, &motions).map(|found| entries(&found.shapes))
    }),
    ("examine", |d| {
        let size = d.size();
        let limits = MovementLimits { balance: d.number(), frequency: d.number(), shape: d.number() };
        let limits = if d.below(2) == 0 { MovementLimits::default() } else { limits };
        examine(&d.modes(size), &d.symmetric(size), Supports::Held, &limits).map(|found| modes(&found.modes))
    }),
    ("rigid_body_vectors", |d| {
        let corners = d.corners();
        let points = corners.map(|position| MeasuringPoint { position, direction: Vector3::z_axis() });
        rigid_body_vectors(&[Motion::Plunge, Motion::Roll, Motion::Pitch], &points).map(|found| entries(&found))
    }),
    ("rod", |d| {
        let [a, b, ..] = d.corners();
        let modulus = d.number();
        rod([a, b], modulus).map(|found| entries(&found))
    }),
    ("triangle", |d| {
        let ([a, b, c, _], material) = (d.corners(), d.material());
        membrane::triangle([a, b, c], &material).map(|found| entries(&found))
    }),
    ("membrane", |d| {
        let (corners, material) = (d.corners(), d.material());
        membrane::membrane(&corners, &material).map(|found| entries(&found))
    }),
    ("shear_panel", |d| {
        let (corners, material) = (d.corners(), d.material());
        shear::shear_panel(&corners, &material).map(|found| entries(&found))
    }),
    ("unit_stiffness", |d| {
        let kinds = [ElementKind::Rod, ElementKind::Triangle, ElementKind::ShearPanel, ElementKind::Membrane];
        let (kind, corners, material) = (kinds[d.below(4)], d.corners(), d.material());
        unit_stiffness(kind, &corners[..d.below(5)], &material).map(|found| entries(&found))
    }),
    ("corner_volumes", |d| {
        let kinds = [ElementKind::Rod, ElementKind::Triangle, ElementKind::ShearPanel, ElementKind::Membrane];
        let (kind, corners) = (kinds[d.below(4)], d.corners());
        corner_volumes(kind, &corners[..d.below(5)])
    }),
    ("isotropic", |d| {
        let (modulus, ratio) = (d.number(), d.number());
        Material::isotropic(modulus, ratio).map(|found| vec![found.shear_modulus])
    }),
    ("Range::positive", |d| {
        let (lower, upper) = (d.number(), d.number());
        Range::positive("range", lower, upper).map(|found| vec![found.lower, found.upper])
    }),
    ("DynamicModel::analyze", |d| {
        let (model, count) = (d.dynamic(), d.size());
        let test = d.modes(model.mass.nrows());
        let count = Some(count).filter(|count| *count > 0);
        model.analyze(&test, count).map(|found| vec![found.exact.errors.sum()])
    }),
    ("ModalState::at", |d| {
        let model = d.chain().ok_or(Error::Empty { what: "chains" })?;
        let count = d.about(model.shares.len());
        let rule = if d.below(2) == 0 { UpdateRule::Recursive1 } else { UpdateRule::Eigensolution };
        ModalState::at(&model, d.list(count), rule).map(|state| vec![state.errors.sum()])
    }),
    ("inner_loop::run", |d| {
        let model = d.chain().ok_or(Error::Empty { what: "chains" })?;
        let count = d.about(model.shares.len());
        let base = if d.below(2) == 0 { vec![1.0; count] } else { d.list(count) };
        let range = |d: &mut Draws| (d.below(2) == 0).then(|| Range { lower: d.number(), upper: d.number() });
        let ranges: Vec<Option<Range>> = (0..count).map(|_| range(d)).collect();
        let mut settings = InnerSettings { iterations: d.below(4), halvings: d.below(4), ..InnerSettings::default() };
        if d.below(2) == 0 {
            settings = InnerSettings { first_relaxation: d.number(), tolerance: d.number(), ..settings };
            settings.factor_range = Range { lower: d.number(), upper: d.number() };
        }
        run(&model, &base, &ranges, &settings).map(|run| [vec![run.last.errors.sum()], run.factors].concat())
    }),
    ("correlate", |d| {
        let settings = Settings { most_passes: d.below(3), ..Settings::default() };
        // Half of the models are right ones, so that calls come past the analysis.
        let found = if d.below(2) == 0 {
            let model = d.chain().ok_or(Error::Empty { what: "chains" })?;
            let ranges = vec![None; d.about(model.shares.len())];
            correlate(|_: &[f64]| Ok::<_, Error>(model.clone()), &ranges, &settings, |_, _| {})?
        } else {
            let model = d.dynamic();
            let (test, ranges) = (d.modes(model.mass.nrows()), vec![None; d.about(model.shares.len())]);
            correlate(|_: &[f64]| model.analyze(&test, None), &ranges, &settings, |_, _| {})?
        };
        Ok([found.best_factors(), vec![found.verdict.error_sum]].concat())
    }),
    ("unlimited_factors", |d| {
        let count = d.size();
        let other = d.about(count);
        unlimited_factors(&d.list(count), &d.list(other), d.number(), d.number());
        Ok(Vec::new())
    }),
    ("limited_factor", |d| {
        let range = Range { lower: d.number(), upper: d.number() };
        limited_factor(d.number(), d.number(), d.number(), d.number(), range, Some(range));
        Ok(Vec::new())
    }),
];

#[test]
fn no_panic_and_no_answer_that_is_no_number() {
    let calls = std::env::var("CORFEM_CALLS").ok().and_then(|calls| calls.parse().ok()).unwrap_or(300);
    let mut faults = Vec::new();
    for (name, entry) in ENTRIES {
        let mut answers = 0;
        for seed in 0..calls {
            let mut draws = Draws(seed);
            match catch_unwind(AssertUnwindSafe(|| entry(&mut draws))) {
                Err(panic) => {
                    let said = panic.downcast_ref::<&str>().map(|said| (*said).to_owned());
                    let said = panic.downcast_ref::<String>().cloned().or(said).unwrap_or_default();
                    faults.push(format!("{name}, seed {seed}: panics: {said}"));
                }
                Ok(Ok(numbers)) => {
                    answers += 1;
                    if numbers.iter().any(|number| !number.is_finite()) {
                        faults.push(format!("{name}, seed {seed}: {numbers:?}"));
                    }
                }
                Ok(Err(error)) => {
                    if error.to_string().is_empty() {
                        faults.push(format!("{name}, seed {seed}: an error without words"));
                    }
                }
            }
        }
        if answers == 0 {
            faults.push(format!("{name}: no call of {calls} came past its checks"));
        }
    }
    let mut first: Vec<String> = Vec::new();
    for fault in &faults {
        let name = fault.split(',').next().unwrap_or_default();
        if first.iter().filter(|known| known.starts_with(name)).count() < 2 {
            first.push(fault.chars().take(200).collect());
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), first.join("\n"));
}
