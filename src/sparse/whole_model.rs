//! A model given by sparse matrices, whatever made them, and what the loops are handed of it.

use super::factorization::{FactorizationPlan, Work};
use super::free::{bracket, slack};
use super::matrix::{ASSEMBLED, GIVEN};
use super::modes::{CountedModes, FINITE, Flexibility, modes_at_most};
use super::place::Place;
use super::sensor_model::{Pair, SensorModel};
use super::share::{Share, WholeShare};
use super::visibility::rows_with_sensor;
use super::{BodyFinding, HalfUnit, RigidBodies, SparseMatrix, Support};
use crate::method::error::{Error, check_count, positive};
use crate::method::linear_algebra::check_length;
use crate::method::modes::Modes;
use crate::method::step::Bounds;
use nalgebra::DMatrix;
use std::ops::RangeInclusive;
use std::sync::{Arc, OnceLock};

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
    /// Rows and places of their parts.
    spots: Vec<Spots>,
    plan: Arc<FactorizationPlan>,
    support: Support,
    bodies: OnceLock<RigidBodies>,
}

/// Rows and places of the entries of a parameter's part among those of the first matrices.
#[derive(Debug)]
struct Spots {
    /// Rows, ascending.
    rows: Vec<usize>,
    /// Places of its entries among those of the whole, with their values.
    values: Vec<(usize, f64)>,
}

impl WholeModel {
    /// A model of symmetric matrices of one size: the first stiffness $K_1$ and mass $M_1$, which may be singular, and the
    /// parameters' parts of them.
    ///
    /// # Errors
    /// Those of [`SparseMatrix::check_symmetric`]; [`Error::WrongShape`] for matrices of other sizes; [`Error::Range`] for a range that
    /// excludes one.
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
            let what = match share {
                Share::Stiffness(_) => "stiffness of a parameter",
                Share::Mass(_) => "mass of a parameter",
            };
            check(what, share.matrix())?;
            if let Some(Bounds { lower, upper }) = *range {
                let what = format!("factor of parameter {name}");
                if !Bounds::positive(&what, lower, upper)?.holds_start() {
                    return Err(Error::Range { what, lower, upper });
                }
            }
        }
        let of_matrix = |is_mass: bool, matrix: SparseMatrix| {
            let shares = parameters.iter().map(|parameter| &parameter.share);
            let own = shares.filter(|share| share.is_mass() == is_mass);
            matrix.with_places_of(own.flat_map(|share| share.matrix().entries()))
        };
        let first = [of_matrix(false, stiffness), of_matrix(true, mass)];
        let spots = |WholeParameter { share, .. }: &WholeParameter| {
            let (at, part) = (usize::from(share.is_mass()), share.matrix());
            let value = |(row, column, value)| Some((first[at].place(row, column)?, value));
            Spots {
                rows: part.occupied(),
                values: part.entries().filter_map(value).collect(),
            }
        };
        let spots = parameters.iter().map(spots).collect();
        let all: Vec<&SparseMatrix> = first.iter().chain(&support.resisting).collect();
        let plan = Arc::new(FactorizationPlan::of_sum(&all)?);
        Ok(Self(Arc::new(Parts {
            spots,
            first,
            parameters,
            plan,
            support,
            bodies: OnceLock::new(),
        })))
    }

    /// The motions that the stiffness leaves free, at the first factors and at any others: all parts of it are semidefinite.
    ///
    /// # Errors
    /// [`Error::NotPositiveDefinite`] for a matrix that is not semidefinite whatever its rounding; [`Error::Count`] for more motions than
    /// its digits may leave free; the errors of the factorization.
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
        let found = RigidBodies::of(plan, &first[0], support)?;
        Ok(bodies.get_or_init(|| found))
    }

    /// Work that analyses of this model have taken so far.
    pub fn work(&self) -> Work {
        self.0.plan.work()
    }

    /// Half the unit of the last written place of the first stiffness.
    pub(crate) fn half_unit(&self) -> HalfUnit {
        self.0.first[0].half_unit()
    }

    /// Findings about these motions, with the rows' names and the lowest frequency found.
    ///
    /// # Errors
    /// As [`Self::rigid_bodies`].
    pub(crate) fn body_findings(
        &self,
        name: impl Fn(usize) -> String,
        lowest_hz: Option<f64>,
    ) -> Result<Vec<BodyFinding>, Error> {
        let [stiffness, mass] = &self.0.first;
        let bodies = self.rigid_bodies()?;
        bodies.findings([stiffness, mass], name, lowest_hz)
    }

    /// True if a sum of symmetric matrices, each times its number, has negative energy whatever the rounding of all. `whole` is a first matrix
    /// that they are parts of.
    ///
    /// # Errors
    /// Errors of the factorization.
    pub(crate) fn is_negative(
        &self,
        what: &'static str,
        whole: &SparseMatrix,
        terms: &[(f64, &SparseMatrix)],
    ) -> Result<bool, Error> {
        let sizes = SparseMatrix::unit_scale(&whole.diagonal());
        // An entry may be left of a sum whose terms were as large as the diagonal, and carry their rounding as a mirrored one does.
        let mut all = sizes.map(|size| terms.len() as f64 * GIVEN * size * size);
        for (_, matrix) in terms {
            all += slack(matrix, &sizes);
        }
        Ok(bracket(&self.0.plan, what, terms, all)?.negative_count() > 0)
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
            let parts = parameters.iter().map(|parameter| &parameter.share);
            let parts = parts.filter(|share| share.is_mass() == is_mass);
            let parts = parts.flat_map(|share| share.matrix().entries());
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
        let of = |parameter: &WholeParameter| {
            let share = &parameter.share;
            Ok(WholeParameter {
                share: share.of(part(share.matrix())?),
                ..parameter.clone()
            })
        };
        let support = Support {
            resisting: support.resisting.as_ref().map(part).transpose()?,
            places: support.places.as_ref().map(|places| places.at(rows)),
            count: support.count,
        };
        let parameters = parameters.iter().map(of);
        let parameters = parameters.collect::<Result<_, Error>>()?;
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

    /// The parameters' parts of the first matrices, and the rows where they have entries.
    pub(super) fn parts(&self) -> impl ExactSizeIterator<Item = (&WholeShare, &[usize])> {
        let both = self.parameters().iter().zip(&self.0.spots);
        both.map(|(parameter, spots)| (&parameter.share, &spots.rows[..]))
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
        let parts = self.parameters().iter().zip(&self.0.spots);
        for ((WholeParameter { name, share, .. }, Spots { values, .. }), &factor) in
            parts.zip(factors)
        {
            positive("factor", || format!("parameter {name}"), factor)?;
            if factor != 1.0 {
                both[usize::from(share.is_mass())].add(factor - 1.0, values);
            }
        }
        let [stiffness, mass] = both;
        Ok((stiffness, mass))
    }

    /// The `count` lowest vibrations at the given factors, none of them missed, and the rigid-body modes.
    ///
    /// # Errors
    /// Those of [`Self::at`]; [`Error::Count`] for more modes than there are, and without mass; [`Error::NotPositiveDefinite`] for a
    /// motion that has neither stiffness nor mass, or a matrix that is not semidefinite; [`Error::Failed`].
    ///
    /// ```rust
    /// use corfem::sparse::{SparseMatrix, WholeModel};
    ///
    /// // Two masses on a spring, held nowhere: one rigid-body mode, and a vibration at the root of two.
    /// let matrix = |entries: &[(usize, usize, f64)]| SparseMatrix::new("matrix", 2, 2, entries.to_vec());
    /// let spring = matrix(&[(0, 0, 1.0), (0, 1, -1.0), (1, 0, -1.0), (1, 1, 1.0)])?;
    /// let model = WholeModel::new(spring, matrix(&[(0, 0, 1.0), (1, 1, 1.0)])?, Vec::new())?;
    /// let found = model.modes(&[], 1)?;
    /// assert_eq!(found.rigid_body.ncols(), 1);
    /// assert!((found.vibrations.omega_squared()[0] - 2.0).abs() < 1e-12);
    /// # Ok::<(), corfem::method::error::Error>(())
    /// ```
    pub fn modes(&self, factors: &[f64], count: usize) -> Result<CountedModes, Error> {
        check_count("modes", count, 1, self.dof_count())?;
        let (stiffness, mass) = self.at(factors)?;
        let (found, _) = self.modes_of((&stiffness, &mass), count, None)?;
        check_count(FINITE, count, 1, found.vibrations.len())?;
        Ok(found)
    }

    /// The modes of matrices at some factors as by [`modes_at_most`].
    pub(super) fn modes_of(
        &self,
        matrices: (&SparseMatrix, &SparseMatrix),
        most: usize,
        near: Option<&DMatrix<f64>>,
    ) -> Result<(CountedModes, Flexibility), Error> {
        modes_at_most(matrices, most, near, self.rigid_bodies()?, &self.0.plan)
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
    /// Behind `count` modes stand rigid-body modes of a free structure where a mass is a parameter: only a change of
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
    /// use corfem::method::analysis::Analysis;
    /// use corfem::method::modes::solve;
    /// use corfem::method::outer_loop::{Settings, correlate};
    /// use corfem::method::sorting::pair_modes;
    /// use corfem::sparse::{Pair, ParameterMatrix, SparseMatrix, WholeModel, WholeParameter, WholeShare};
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
    /// let sensors = sparse(one)?;
    /// let analyze = |factors: &[f64]| model.analyze(factors, &sensors, &test, Pair::by(|of| pair_modes(of.cross)), 2);
    ///
    /// // The basis: its shapes at the sensors, their squared frequencies, and the spring's share.
    /// let first = analyze(&[1.0])?;
    /// let ParameterMatrix::Stiffness(share) = &first.shares()[0] else { unreachable!() };
    /// let expected = first.basis().tr_mul(&(2.0 * spring * first.basis()));
    /// assert!((share - expected).amax() < 1e-12 && first.exact().modes.omega_squared()[0] < first.test().omega_squared()[0]);
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
        test: &Modes,
        pair: Pair,
        count: usize,
    ) -> Result<SensorModel, Error> {
        // Exact slopes want more modes.
        let most = count.max(2 * test.len());
        let whole = self.exactly(factors, sensors, count..=most, None)?;
        SensorModel::of_whole(whole, count, test, pair)?.with_slopes()
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
        counts: RangeInclusive<usize>,
        near: Option<&DMatrix<f64>>,
    ) -> Result<Arc<Place>, Error> {
        Ok(Arc::new(Place::new(self, factors, sensors, counts, near)?))
    }
}
