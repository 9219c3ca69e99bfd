//! Strategies and small problems for Appendix C in full: changes of stiffness and mass, clusters of roots.

use crate::prelude::*;

/// Modes of vibration on either side: $\lambda = 1/\omega^2$ and $U = V$, for a symmetric pencil is its own transpose.
pub fn on_either_side(modes: &Modes) -> LeftRightModes<f64> {
    LeftRightModes {
        roots: modes.omega_squared().map(f64::recip),
        right: modes.shapes().clone(),
        left: modes.shapes().clone(),
    }
}

/// The pencil of unit shapes of a diagonal stiffness, through which a change is seen as it is.
pub fn diagonal_pencil(
    k: &DVector<f64>,
    beta: &DMatrix<Complex<f64>>,
    alpha: &DMatrix<Complex<f64>>,
) -> Pencil<Complex<f64>> {
    let own = DMatrix::identity(k.len(), k.len());
    let modes = LeftRightModes {
        roots: k.map(|k| Complex::from(1.0 / k)),
        right: own.clone(),
        left: own,
    };
    let stiffness = DMatrix::from_diagonal(&k.map(Complex::from));
    Pencil::new(&stiffness, &modes, beta, alpha).unwrap()
}

/// A function of Appendix C on generalized stiffnesses and β.
pub type Plain = fn(&DVector<f64>, &DMatrix<f64>) -> Result<Perturbed, Error>;

/// A function of Appendix C on a change of stiffness and mass.
pub type General = fn(&ModalChange) -> Result<Perturbed, Error>;

/// Change of stiffness and mass seen through modes of vibration, as a test has it.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalChange {
    /// Squared circular frequencies $k_{ii}$ before it.
    pub generalized_stiffness: DVector<f64>,
    /// $\beta = V^t \Delta K V$.
    pub beta: DMatrix<f64>,
    /// $\alpha = V^t \Delta M V$.
    pub alpha: DMatrix<f64>,
}

impl ModalChange {
    pub fn of_vibrations(k: &DVector<f64>, beta: DMatrix<f64>, alpha: DMatrix<f64>) -> Self {
        let generalized_stiffness = k.clone();
        Self {
            generalized_stiffness,
            beta,
            alpha,
        }
    }

    /// The pencil of the crate.
    ///
    /// # Errors
    /// What [`Pencil::of_vibrations`] refuses.
    pub fn pencil(&self) -> Result<Pencil<f64>, Error> {
        Pencil::of_vibrations(&self.generalized_stiffness, &self.beta, &self.alpha)
    }
}

/// Exact roots and shapes of $k + \beta$ with $I + \alpha$: what the perturbation approaches. Modes stand in the order of the modes they
/// are most like, scaled to $p_{jj} = 1$.
///
/// # Errors
/// What [`solve`] refuses; [`Error::CoalescingModes`] when a new mode has no part in the mode it continues.
pub fn eigensolution(change: &ModalChange) -> Result<Perturbed, Error> {
    let pencil = change.pencil()?;
    let modes = solve(pencil.a(), pencil.g(), pencil.a().nrows())?;
    // Rows of the shape matrix are the old modes, so its transpose is the cross-orthogonality of new with old.
    let partners = pair_modes(&modes.shapes().transpose())?;
    let partners = &partners.analysis_mode;
    let mut shapes = modes.shapes().select_columns(partners);
    for (j, mut shape) in shapes.column_iter_mut().enumerate() {
        let separation = shape[j].abs();
        if separation < 1e-9 {
            return Err(Error::CoalescingModes {
                first: j,
                second: j,
                separation,
            });
        }
        shape /= shape[j];
    }
    let roots = modes.omega_squared().select_rows(partners).map(f64::recip);
    Ok(Perturbed { roots, shapes })
}

/// One way of solving Appendix C, for stiffness alone and in general.
pub struct Rule {
    pub name: &'static str,
    pub plain: Plain,
    pub general: General,
}

/// The formulae of Appendix C, the recursive ones to a few orders and to convergence.
pub const FORMULAE: [Rule; 7] = [
    Rule {
        name: "first order",
        plain: first_order,
        general: |change| change.pencil()?.first_order(),
    },
    Rule {
        name: "original",
        plain: original,
        general: |change| change.pencil()?.original(),
    },
    Rule {
        name: "Recursive 1, order 1",
        plain: |k, beta| recursive_1(k, beta, 1),
        general: |change| change.pencil()?.recursive_1(1),
    },
    Rule {
        name: "Recursive 1, order 4",
        plain: |k, beta| recursive_1(k, beta, 4),
        general: |change| change.pencil()?.recursive_1(4),
    },
    Rule {
        name: "Recursive 2, order 1",
        plain: |k, beta| recursive_2(k, beta, 1),
        general: |change| change.pencil()?.recursive_2(1),
    },
    Rule {
        name: "Recursive 2, order 3",
        plain: |k, beta| recursive_2(k, beta, 3),
        general: |change| change.pencil()?.recursive_2(3),
    },
    Rule {
        name: "Recursive 1, converged",
        plain: |k, beta| Ok(recursive_1_converged(k, beta)?.perturbed),
        general: |change| Ok(change.pencil()?.recursive_1_converged()?.perturbed),
    },
];

/// Those that the loops run on, with functions of their own for a change of stiffness alone.
pub fn stiffness_rules() -> impl Iterator<Item = Rule> {
    FORMULAE
        .into_iter()
        .filter(|rule| rule.name.starts_with("first order") || rule.name.starts_with("Recursive 1"))
}

/// A change of stiffness alone.
pub fn of_stiffness(k: &DVector<f64>, beta: &DMatrix<f64>) -> ModalChange {
    ModalChange::of_vibrations(k, beta.clone(), zero_square(k.len()))
}

/// The eigensolution for a change of stiffness alone.
pub fn exact(k: &DVector<f64>, beta: &DMatrix<f64>) -> Result<Perturbed, Error> {
    eigensolution(&of_stiffness(k, beta))
}

/// Recursive 2 for a change of stiffness alone.
pub fn recursive_2(
    k: &DVector<f64>,
    beta: &DMatrix<f64>,
    order: usize,
) -> Result<Perturbed, Error> {
    of_stiffness(k, beta).pencil()?.recursive_2(order)
}

/// The formulae of 1947 for a change of stiffness alone.
pub fn original(k: &DVector<f64>, beta: &DMatrix<f64>) -> Result<Perturbed, Error> {
    of_stiffness(k, beta).pencil()?.original()
}

/// Largest change of a root relative to itself.
pub fn largest_change(new: &DVector<f64>, old: &DVector<f64>) -> f64 {
    let changes = new
        .iter()
        .zip(old.iter())
        .map(|(new, old)| relative_error(new, old));
    changes.largest()
}

/// Largest entry of a generalized change relative to its modes' own stiffness or mass. With roots a factor 1.5 apart
/// and six modes the sum of a row's $|p_{ij}|$ stays below one half, so the recursions converge, by a digit in
/// three or four orders at worst.
pub const LARGEST_CHANGE: f64 = 0.02;

/// Squared circular frequencies from 1 up, each `1.5` to `4` times the one before: apart at every size.
pub fn separate_spectrum(size: usize) -> impl Strategy<Value = DVector<f64>> {
    prop::collection::vec(1.5..4.0_f64, size).prop_map(|ratios| {
        let mut value = 1.0;
        DVector::from_iterator(
            ratios.len(),
            ratios.iter().map(|ratio| {
                let present = value;
                value *= ratio;
                present
            }),
        )
    })
}

/// β with $\beta_{ij}$ within `largest` of $\sqrt{k_i k_j}$ and α with entries within `largest`, both symmetric.
pub fn change_of(k: DVector<f64>, largest: f64) -> impl Strategy<Value = ModalChange> {
    (symmetric(k.len()), symmetric(k.len())).prop_map(move |(b, a)| {
        let root = DMatrix::from_diagonal(&k.map(f64::sqrt));
        let beta = largest * &root * b * &root;
        // The product of three matrices is symmetric to round-off only.
        let beta = 0.5 * (&beta + beta.transpose());
        ModalChange::of_vibrations(&k, beta, largest * a)
    })
}

/// A change of two to six separate modes in which every rule converges.
pub fn separate_change() -> impl Strategy<Value = ModalChange> {
    (2..=6_usize)
        .prop_flat_map(separate_spectrum)
        .prop_flat_map(|k| change_of(k, LARGEST_CHANGE))
}

/// A chain of three masses: springs to the ground, and between masses 1-2, 2-3 and 1-3.
pub fn three_mass_chain(ground: [f64; 3], between: [f64; 3]) -> DMatrix<f64> {
    let mut stiffness = diagonal(ground);
    for ((i, j), spring) in [(0, 1), (1, 2), (0, 2)].into_iter().zip(between) {
        stiffness[(i, i)] += spring;
        stiffness[(j, j)] += spring;
        stiffness[(i, j)] -= spring;
        stiffness[(j, i)] -= spring;
    }
    stiffness
}

/// Real numbers in ascending order.
pub fn ascending<'a>(values: impl IntoIterator<Item = &'a f64>) -> Vec<f64> {
    let mut sorted = values.into_iter().copied().collect_vec();
    sorted.sort_by(f64::total_cmp);
    sorted
}

/// Largest relative distance from each root to the nearest of `exact`, every exact one being used once.
///
/// Panics when two roots are nearest to the same exact one.
pub fn largest_root_error(roots: &[Complex<f64>], exact: &[Complex<f64>]) -> f64 {
    assert_eq!(roots.len(), exact.len());
    let mut used = vec![false; exact.len()];
    roots
        .iter()
        .map(|root| {
            let (nearest, distance) = exact
                .iter()
                .enumerate()
                .map(|(i, other)| (i, (root - other).norm() / other.norm()))
                .min_by(|a, b| a.1.total_cmp(&b.1))
                .unwrap();
            assert!(
                !used[nearest],
                "two roots are nearest to {}",
                exact[nearest]
            );
            used[nearest] = true;
            distance
        })
        .largest()
}

/// Four modes, stiffness and mass changed together, every entry of both changes at work.
pub fn four_modes(size: f64) -> ModalChange {
    let beta = dmatrix![
        0.3, 0.5, -0.4, 0.6;
        0.5, -0.8, 0.9, 0.7;
        -0.4, 0.9, 1.1, -1.3;
        0.6, 0.7, -1.3, 1.7];
    let alpha = dmatrix![
        -0.2, 0.15, 0.1, -0.25;
        0.15, 0.3, -0.2, 0.1;
        0.1, -0.2, 0.25, 0.05;
        -0.25, 0.1, 0.05, -0.1];
    ModalChange::of_vibrations(&dvector![1.0, 2.5, 6.0, 14.0], size * beta, size * alpha)
}

/// Largest relative error of a root and largest error of a shape against the exact solution.
pub fn errors(perturbed: &Perturbed, exact: &Perturbed) -> (f64, f64) {
    let roots = perturbed
        .roots
        .component_div(&exact.roots)
        .add_scalar(-1.0)
        .amax();
    (roots, (&perturbed.shapes - &exact.shapes).amax())
}
