//! A model given by sparse matrices, whatever made them, and what the loops are handed of it.

use super::deformations::Deformations;
use super::elements::stiffness_entries;
use super::factorization::{FactorizationPlan, Work};
use super::lowest_modes::{CountedModes, FINITE, Flexibility, modes_at_most};
use super::matrix::ASSEMBLED;
use super::part::Part;
use super::place::Place;
use super::rigid_bodies::BodyFinding;
use super::sensor_model::{Deflections, Pair, ParameterMatrix, SensorModel, Whole};
use super::visibility::rows_with_sensor;
use super::{RigidBodies, SparseMatrix, Support};
use crate::method::error::{Error, check_count, check_places, positive};
use crate::method::linear_algebra::check_length;
use crate::method::modes::Modes;
use crate::method::step::Bounds;
use nalgebra::DMatrix;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, OnceLock};

/// Part of the whole model's matrices.
#[derive(Debug, Clone, PartialEq)]
pub enum WholeShare {
    /// Of the stiffness, lbf/in.
    Stiffness(SparseMatrix),
    /// The stiffness of elements of the given gages (in) and areas (in²).
    Elements(Vec<(Deformations, f64)>),
    /// Of the mass, lbf·s²/in.
    Mass(SparseMatrix),
}

/// What may change: a part of the stiffness or mass that is scaled by one factor.
#[derive(Debug, Clone, PartialEq)]
pub struct WholeParameter {
    /// What it is called in reports.
    pub name: String,
    /// Its part of the first matrices.
    pub share: WholeShare,
    /// Bounds on its factor, if any.
    pub range: Option<Bounds>,
}

/// Size of the basis in which changes of a whole model are followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BasisSize {
    /// Number of exact modes, the lowest.
    pub modes: usize,
    /// Most residual vectors behind them for each parameter.
    pub residual_vectors: usize,
}

/// A structure at all its degrees of freedom.
///
/// $$ K = K_1 + \sum_e (s_e - 1) K_e, \qquad M = M_1 + \sum_e (s_e - 1) M_e $$
///
/// Where all these matrices have entries, and in which order the degrees of freedom are eliminated, is found once. A clone shares it.
#[derive(Debug, Clone)]
pub struct WholeModel(Arc<Parts>);

/// Matrices of a model and what does not change with its factors.
#[derive(Debug)]
struct Parts {
    /// The first stiffness and mass, wherever any of the parameters has an entry.
    first: [SparseMatrix; 2],
    parameters: Vec<WholeParameter>,
    /// The parameters' parts of them.
    own: Vec<Part>,
    plan: Arc<FactorizationPlan>,
    support: Support,
    bodies: OnceLock<RigidBodies>,
}

impl WholeModel {
    /// A model of symmetric matrices of one size: the first stiffness $K_1$ and mass $M_1$, which may be singular, and the
    /// parameters' parts of them.
    ///
    /// # Errors
    /// Those of [`SparseMatrix::check_symmetric`]; [`Error::WrongShape`] for matrices of other sizes; [`Error::Count`] for a row of
    /// an element beyond them; [`Error::Value`] for its size; [`Error::Range`] for a range that excludes one.
    pub fn new(
        stiffness: SparseMatrix,
        mass: SparseMatrix,
        parameters: Vec<WholeParameter>,
    ) -> Result<Self, Error> {
        Self::supported(stiffness, mass, parameters, Support::default())
    }

    /// A model of which more is known about its free motions.
    ///
    /// # Errors
    /// As [`Self::new`]; [`Error::WrongShape`] for a resisting matrix of another size.
    #[doc(hidden)]
    pub fn supported(
        stiffness: SparseMatrix,
        mass: SparseMatrix,
        parameters: Vec<WholeParameter>,
        support: Support,
    ) -> Result<Self, Error> {
        let count = stiffness.rows();
        let check = |what, matrix: &SparseMatrix| {
            check_length(what, matrix.rows(), count)?;
            matrix.check_symmetric(what)
        };
        check("stiffness", &stiffness)?;
        check("mass", &mass)?;
        if let Some(resisting) = &support.resisting {
            check_length("stiffness of the elements", resisting.rows(), count)?;
        }
        for WholeParameter { name, share, range } in &parameters {
            match share {
                WholeShare::Stiffness(matrix) => check("stiffness of a parameter", matrix)?,
                WholeShare::Elements(members) => {
                    members.iter().try_for_each(|(element, size)| {
                        check_places("degrees of freedom", element.dof(), count)?;
                        positive("size", || format!("element {}", element.label()), *size)
                    })?
                }
                WholeShare::Mass(matrix) => check("mass of a parameter", matrix)?,
            }
            if let Some(Bounds { lower, upper }) = *range {
                let what = format!("factor of parameter {name}");
                if !Bounds::positive(&what, lower, upper)?.contains(1.0) {
                    return Err(Error::Range { what, lower, upper });
                }
            }
        }
        let parts = parameters
            .iter()
            .map(|parameter| Part::of(parameter.is_mass(), parameter.entries(), count));
        let parts = parts.collect::<Result<Vec<_>, Error>>()?;
        let of_matrix = |is_mass: bool, matrix: SparseMatrix| {
            let own = parts.iter().filter(|part| part.is_mass == is_mass);
            matrix.with_places_of(own.flat_map(Part::entries))
        };
        let first = [of_matrix(false, stiffness), of_matrix(true, mass)];
        let starts = [first[0].starts(), first[1].starts()];
        let placed = |part: Part| {
            let at = usize::from(part.is_mass);
            part.placed(&first[at], &starts[at])
        };
        let own = parts
            .into_iter()
            .map(placed)
            .collect::<Result<_, Error>>()?;
        let all: Vec<&SparseMatrix> = first.iter().chain(&support.resisting).collect();
        let plan = Arc::new(FactorizationPlan::of_sum(&all)?);
        Ok(Self(Arc::new(Parts {
            first,
            own,
            parameters,
            plan,
            support,
            bodies: OnceLock::new(),
        })))
    }

    /// The motions that the stiffness leaves free, at the first factors and at any others: all parts of it are semidefinite.
    ///
    /// # Errors
    /// Errors of [`RigidBodies::of`].
    pub fn rigid_bodies(&self) -> Result<&RigidBodies, Error> {
        let Parts {
            first,
            support,
            bodies,
            plan,
            ..
        } = &*self.0;
        if let Some(bodies) = bodies.get() {
            return Ok(bodies);
        }
        let found = RigidBodies::by(plan, "stiffness", &first[0], support)?;
        Ok(bodies.get_or_init(|| found))
    }

    /// Work that analyses of this model have taken so far.
    pub fn work(&self) -> Work {
        self.0.plan.work()
    }

    /// Lets analyses fail once a flag is true, or no longer.
    pub(crate) fn stop_at(&self, flag: Option<Arc<AtomicBool>>) {
        self.0.plan.stop_at(flag);
    }

    /// The largest part of an entry of the first stiffness by which it is rounded.
    pub(crate) fn rounding(&self) -> f64 {
        self.0.first[0].rounding()
    }

    /// Sentences about these motions, with the rows' names.
    ///
    /// # Errors
    /// As [`Self::rigid_bodies`].
    pub(crate) fn body_findings(
        &self,
        name: impl Fn(usize) -> String,
    ) -> Result<Vec<BodyFinding>, Error> {
        Ok(self.rigid_bodies()?.findings(&self.0.first[1], name))
    }

    /// Rows in those parts of the model in which a sensor reads a row. What two parameters couple may cancel, but not at all factors;
    /// couplings below the rounding of doubles are none.
    pub(crate) fn rows_with_sensor(&self, sensors: &SparseMatrix) -> Vec<usize> {
        let Parts {
            first, parameters, ..
        } = &*self.0;
        let mut couplings = Vec::new();
        for (matrix, is_mass) in first.iter().zip([false, true]) {
            let sizes = SparseMatrix::unit_scale(&matrix.diagonal());
            let parts = parameters
                .iter()
                .filter(|parameter| parameter.is_mass() == is_mass);
            let parts = parts.flat_map(WholeParameter::entries);
            let all = matrix.entries().chain(parts);
            let told = all.filter(|&(row, column, value)| {
                value.abs() > ASSEMBLED * sizes[row] * sizes[column]
            });
            couplings.extend(told.map(|(row, column, _)| (row, column)));
        }
        rows_with_sensor(couplings.into_iter(), sensors)
    }

    /// The model at some of its rows, ascending, with which no other is coupled.
    ///
    /// # Errors
    /// Errors of [`Self::supported`].
    pub(crate) fn at_rows(&self, rows: &[usize]) -> Result<Self, Error> {
        let Parts {
            first,
            parameters,
            support,
            ..
        } = &*self.0;
        let part = |matrix: &SparseMatrix| matrix.at_rows(rows);
        let of = |parameter: &WholeParameter| -> Result<WholeParameter, Error> {
            let share = match &parameter.share {
                WholeShare::Stiffness(matrix) => WholeShare::Stiffness(part(matrix)?),
                WholeShare::Mass(matrix) => WholeShare::Mass(part(matrix)?),
                WholeShare::Elements(members) => {
                    let own =
                        |(element, size): &(Deformations, f64)| (element.at_rows(rows), *size);
                    WholeShare::Elements(members.iter().map(own).collect())
                }
            };
            Ok(WholeParameter {
                share,
                ..parameter.clone()
            })
        };
        let support = Support {
            resisting: support.resisting.as_ref().map(part).transpose()?,
            places: support.places.as_ref().map(|places| places.at(rows)),
            count: support.count,
        };
        let parameters = parameters.iter().map(of).collect::<Result<_, Error>>()?;
        Self::supported(part(&first[0])?, part(&first[1])?, parameters, support)
    }

    /// Number of degrees of freedom.
    pub fn dof_count(&self) -> usize {
        self.0.first[0].rows()
    }

    /// What may change.
    pub fn parameters(&self) -> &[WholeParameter] {
        &self.0.parameters
    }

    /// The parameters' parts of the first matrices.
    pub(super) fn parts(&self) -> &[Part] {
        &self.0.own
    }

    /// The bounds on every parameter's factor.
    pub fn ranges(&self) -> Vec<Option<Bounds>> {
        let parameters = self.parameters().iter();
        parameters.map(|parameter| parameter.range).collect()
    }

    /// Stiffness and mass at the given parameter factors.
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless there is one factor per parameter; [`Error::Value`] for a factor that is not.
    pub fn at(&self, factors: &[f64]) -> Result<(SparseMatrix, SparseMatrix), Error> {
        check_length("parameter factors", factors.len(), self.parameters().len())?;
        let mut both = self.0.first.clone();
        let parts = self.parameters().iter().zip(self.parts());
        for ((parameter, part), &factor) in parts.zip(factors) {
            positive("factor", || format!("parameter {}", parameter.name), factor)?;
            if factor != 1.0 {
                part.add_to(&mut both[usize::from(part.is_mass)], factor - 1.0);
            }
        }
        let [stiffness, mass] = both;
        Ok((stiffness, mass))
    }

    /// The `count` lowest vibrations at the given factors, and the rigid-body modes.
    ///
    /// # Errors
    /// Those of [`Self::at`] and [`lowest_modes`](super::lowest_modes()).
    pub fn modes(&self, factors: &[f64], count: usize) -> Result<CountedModes, Error> {
        let (stiffness, mass) = self.at(factors)?;
        Ok(self.modes_of(&stiffness, &mass, (count, count), None)?.0)
    }

    /// The modes of matrices at some factors, at least and at most so many, sought from those `near` that are known.
    pub(super) fn modes_of(
        &self,
        stiffness: &SparseMatrix,
        mass: &SparseMatrix,
        (least, most): (usize, usize),
        near: Option<&DMatrix<f64>>,
    ) -> Result<(CountedModes, Flexibility), Error> {
        check_count("modes", least, 1, self.dof_count())?;
        let found = modes_at_most(
            (stiffness, mass),
            (least, most),
            near,
            self.rigid_bodies()?,
            &self.0.plan,
        )?;
        check_count(FINITE, least, 1, found.0.vibrations.len())?;
        Ok(found)
    }

    /// The flexibility at a stiffness and mass.
    pub(super) fn flexibility(
        &self,
        stiffness: &SparseMatrix,
        mass: &SparseMatrix,
    ) -> Result<Flexibility, Error> {
        Flexibility::of(&self.0.plan, stiffness, mass, self.rigid_bodies()?)
    }

    /// Analysis for the loops without any condensation: the lowest modes of the whole model as the sensors see them, and every
    /// parameter's share $V^t K_e V$ or $V^t M_e V$ with the whole shapes.
    ///
    /// Behind the modes stand residual vectors, and rigid-body modes of a free structure where a mass is a parameter: only a change of
    /// mass couples them with vibrations. `sensors` reads the sensors' motions off the model's, $q_G = R q$ (sensors × DOF).
    ///
    /// # Errors
    /// [`Error::Count`] for more modes than there are; whatever the eigensolution or the pairing of modes refuses.
    ///
    /// # Example
    ///
    /// Two unit masses in a row on springs of 3 and 2 from a wall. The second spring was built with 3.
    ///
    /// ```rust
    /// use corfem::method::modes::solve;
    /// use corfem::method::outer_loop::{Settings, correlate};
    /// use corfem::method::sorting::pair_modes;
    /// use corfem::sparse::{BasisSize, Pair, ParameterMatrix, SparseMatrix, WholeModel, WholeParameter, WholeShare};
    /// use nalgebra::{DMatrix, dmatrix};
    ///
    /// let sparse = |matrix| SparseMatrix::of_dense("matrix", &matrix);
    /// let (one, spring) = (DMatrix::identity(2, 2), dmatrix![1.0, -1.0; -1.0, 1.0]);
    /// let stiffness = |second: f64| dmatrix![3.0, 0.0; 0.0, 0.0] + second * &spring;
    /// let share = WholeShare::Stiffness(sparse(2.0 * &spring)?);
    /// let second = WholeParameter { name: "second spring".into(), share, range: None };
    /// let model = WholeModel::new(sparse(stiffness(2.0))?, sparse(one.clone())?, vec![second])?;
    ///
    /// let test = solve(&stiffness(3.0), &one, 2)?;
    /// let (sensors, size) = (sparse(one)?, BasisSize { modes: 2, residual_vectors: 0 });
    /// let analyze = |factors: &[f64]| model.analyze(factors, &sensors, (&test, Pair::by(|of| pair_modes(of.cross))), size);
    ///
    /// // The basis: its shapes at the sensors, their squared frequencies, and the spring's share.
    /// let first = analyze(&[1.0])?;
    /// let ParameterMatrix::Stiffness(share) = &first.shares()[0] else { unreachable!() };
    /// let expected = first.basis().tr_mul(&(2.0 * spring * first.basis()));
    /// assert!((share - expected).amax() < 1e-12 && first.omega_squared()[0] < first.test().omega_squared()[0]);
    ///
    /// let settings = Settings { error_sum_tolerance: 1e-4, later_inner_tolerance: 1e-4, ..Settings::default() };
    /// let found = correlate(analyze, &[None], &settings.for_modes(2), |_, _| true)?;
    /// assert!((found.best_factors[0] - 1.5).abs() < 1e-3);
    /// # Ok::<(), corfem::method::error::Error>(())
    /// ```
    pub fn analyze(
        &self,
        factors: &[f64],
        sensors: &SparseMatrix,
        (test, pair): (&Modes, Pair),
        size: BasisSize,
    ) -> Result<SensorModel, Error> {
        let model = self.analyze_near(factors, sensors, (test, pair), size, None)?;
        match size.residual_vectors {
            0 => model.with_slopes(),
            _ => Ok(model),
        }
    }

    /// The analysis of [`Self::analyze`] without slopes, its modes sought from shapes `near` them.
    pub(crate) fn analyze_near(
        &self,
        factors: &[f64],
        sensors: &SparseMatrix,
        (test, pair): (&Modes, Pair),
        size: BasisSize,
        near: Option<&DMatrix<f64>>,
    ) -> Result<SensorModel, Error> {
        // Only exact slopes want more modes than the basis has.
        let most = match size.residual_vectors {
            0 => size.modes.max(2 * test.len()),
            _ => size.modes,
        };
        let whole = self.exactly(factors, sensors, (size.modes, most), near)?;
        let deflections = Deflections::Each(size.residual_vectors);
        SensorModel::of_whole(whole, size.modes, (test, pair), deflections)
    }

    /// Exact analysis seen by sensors that further looks can be taken at, with at least and at most so many modes, sought from shapes
    /// `near` them.
    ///
    /// # Errors
    /// As [`Self::analyze`].
    pub(crate) fn exactly(
        &self,
        factors: &[f64],
        sensors: &SparseMatrix,
        counts: (usize, usize),
        near: Option<&DMatrix<f64>>,
    ) -> Result<Arc<dyn Whole>, Error> {
        Ok(Arc::new(Place::new(self, factors, sensors, counts, near)?))
    }

    /// Every parameter's present share in shapes $V$ at all DOF, $s_e V^t K_e V$ or $s_e V^t M_e V$.
    pub(crate) fn shares(
        &self,
        factors: &[f64],
        shapes: &DMatrix<f64>,
    ) -> Result<Vec<ParameterMatrix>, Error> {
        let both = self.parts().iter().zip(factors);
        both.map(|(part, &factor)| part.seen_by(factor, shapes))
            .collect()
    }
}

impl WholeParameter {
    /// True of a part of the mass.
    pub(super) fn is_mass(&self) -> bool {
        matches!(self.share, WholeShare::Mass(_))
    }

    /// The entries (row, column, value) of its part of the first matrices; places may be given twice.
    fn entries(&self) -> Vec<(usize, usize, f64)> {
        match &self.share {
            WholeShare::Stiffness(matrix) | WholeShare::Mass(matrix) => matrix.entries().collect(),
            WholeShare::Elements(members) => {
                let of_element = |(element, size): &(Deformations, f64)| {
                    stiffness_entries(&element.matrix(), *size).collect::<Vec<_>>()
                };
                members.iter().flat_map(of_element).collect()
            }
        }
    }
}
