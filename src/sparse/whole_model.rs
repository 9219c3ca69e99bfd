//! A model given by sparse matrices, whatever made them, and what the loops are handed of it.

use super::deformations::{Deformations, sum_of_stiffness};
use super::elements::stiffness_entries;
use super::lowest_modes::{CountedModes, FINITE, Flexibility, modes_at_most};
use super::residual_vectors::{leading_loads, residual_vectors};
use super::sensor_model::{Further, Pair, ParameterMatrix, SensorModel, turn_alike};
use super::{RigidBodies, SparseMatrix, no_modes};
use crate::method::error::{Error, check_count, check_places, positive};
use crate::method::linear_algebra::check_length;
use crate::method::modes::Modes;
use crate::method::step::Bounds;
use nalgebra::DMatrix;

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

/// The entries (row, column, value) of elements of these sizes, each times a number.
fn entries_of(members: &[(Deformations, f64)], number: f64) -> Vec<(usize, usize, f64)> {
    let of_element = |(element, size): &(Deformations, f64)| {
        stiffness_entries(&element.matrix(), number * size).collect::<Vec<_>>()
    };
    members.iter().flat_map(of_element).collect()
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
#[derive(Debug, Clone, PartialEq)]
pub struct WholeModel {
    stiffness: SparseMatrix,
    mass: SparseMatrix,
    parameters: Vec<WholeParameter>,
    /// A matrix with the null space of $K$ at any factors, if one better than $K$ is known.
    resisting: Option<SparseMatrix>,
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
        let count = stiffness.rows();
        let check = |what, matrix: &SparseMatrix| {
            check_length(what, matrix.rows(), count)?;
            matrix.check_symmetric(what)
        };
        check("stiffness", &stiffness)?;
        check("mass", &mass)?;
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
        Ok(Self {
            stiffness,
            mass,
            parameters,
            resisting: None,
        })
    }

    /// The same model with a symmetric matrix whose null space is that of the stiffness at any factors, for rigid-body modes.
    ///
    /// # Errors
    /// [`Error::WrongShape`] for one of another size.
    #[doc(hidden)]
    pub fn with_resisting(self, resisting: SparseMatrix) -> Result<Self, Error> {
        check_length(
            "stiffness of the elements",
            resisting.rows(),
            self.dof_count(),
        )?;
        Ok(Self {
            resisting: Some(resisting),
            ..self
        })
    }

    /// The rigid-body motions of the first model, as its matrices tell them.
    ///
    /// # Errors
    /// Those of [`RigidBodies::of`].
    pub fn rigid_bodies(&self) -> Result<RigidBodies, Error> {
        RigidBodies::of(
            "stiffness",
            self.resisting.as_ref().unwrap_or(&self.stiffness),
        )
    }

    /// Number of degrees of freedom.
    pub fn dof_count(&self) -> usize {
        self.stiffness.rows()
    }

    /// What may change.
    pub fn parameters(&self) -> &[WholeParameter] {
        &self.parameters
    }

    /// The bounds on every parameter's factor.
    pub fn ranges(&self) -> Vec<Option<Bounds>> {
        self.parameters
            .iter()
            .map(|parameter| parameter.range)
            .collect()
    }

    /// Stiffness and mass at the given parameter factors.
    ///
    /// # Errors
    /// [`Error::WrongShape`] unless there is one factor per parameter; [`Error::Value`] for a factor that is not.
    pub fn at(&self, factors: &[f64]) -> Result<(SparseMatrix, SparseMatrix), Error> {
        check_length("parameter factors", factors.len(), self.parameters.len())?;
        let (mut stiffness, mut mass) = (
            self.stiffness.entries().to_vec(),
            self.mass.entries().to_vec(),
        );
        for (parameter, &factor) in self.parameters.iter().zip(factors) {
            positive("factor", || format!("parameter {}", parameter.name), factor)?;
            let change = factor - 1.0;
            match &parameter.share {
                _ if change == 0.0 => {}
                WholeShare::Stiffness(matrix) => stiffness.extend(matrix.times_number(change)),
                WholeShare::Elements(members) => {
                    stiffness.extend(entries_of(members, change));
                }
                WholeShare::Mass(matrix) => mass.extend(matrix.times_number(change)),
            }
        }
        let sum =
            |what, entries| SparseMatrix::new(what, self.dof_count(), self.dof_count(), entries);
        Ok((sum("stiffness", stiffness)?, sum("mass", mass)?))
    }

    /// The `count` lowest vibrations at the given factors, and the rigid-body modes.
    ///
    /// # Errors
    /// Those of [`Self::at`] and [`lowest_modes`](super::lowest_modes()).
    pub fn modes(&self, factors: &[f64], count: usize) -> Result<CountedModes, Error> {
        let (stiffness, mass) = self.at(factors)?;
        Ok(self.modes_of(&stiffness, &mass, count)?.0)
    }

    fn modes_of(
        &self,
        stiffness: &SparseMatrix,
        mass: &SparseMatrix,
        count: usize,
    ) -> Result<(CountedModes, Flexibility), Error> {
        check_count("modes", count, 1, self.dof_count())?;
        let resisting = self.resisting.as_ref().unwrap_or(stiffness);
        let found = modes_at_most(stiffness, mass, count, resisting)?;
        check_count(FINITE, count, 1, found.0.vibrations.len())?;
        Ok(found)
    }

    /// The same, or all modes where they are fewer than `most`.
    pub(crate) fn modes_at_most(
        &self,
        stiffness: &SparseMatrix,
        mass: &SparseMatrix,
        most: usize,
    ) -> Result<CountedModes, Error> {
        let resisting = self.resisting.as_ref().unwrap_or(stiffness);
        Ok(modes_at_most(stiffness, mass, most, resisting)?.0)
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
    /// use corfem::sparse::{BasisSize, ParameterMatrix, SparseMatrix, WholeModel, WholeParameter, WholeShare};
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
    /// let analyze = |factors: &[f64]| model.analyze(factors, &sensors, (&test, pair_modes), size);
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
        let (stiffness, mass) = self.at(factors)?;
        let (mut found, flexibility) = self.modes_of(&stiffness, &mass, size.modes)?;
        let vibrations = &mut found.vibrations;
        let seen = sensors.times(&vibrations.shapes)?;
        let modes = Modes::signed(vibrations.omega_squared.clone(), seen.clone());
        turn_alike(&mut vibrations.shapes, &seen, &modes.shapes);
        let (residual, rigid_body) = self.further(
            &stiffness,
            &mass,
            (&found, &flexibility),
            size.residual_vectors,
        )?;
        let mut basis = found.vibrations.shapes;
        basis.extend(residual.shapes.column_iter());
        basis.extend(rigid_body.column_iter());
        let shares = self.shares(factors, &basis)?;
        let further = Further {
            residual: Modes {
                shapes: sensors.times(&residual.shapes)?,
                ..residual
            },
            rigid_body: sensors.times(&rigid_body)?,
        };
        SensorModel::at_sensors(modes, &further, test, pair, shares)
    }

    /// Shapes of the basis that are no modes of it: at most `most` residual vectors a parameter, and rigid-body modes.
    fn further(
        &self,
        stiffness: &SparseMatrix,
        mass: &SparseMatrix,
        (found, flexibility): (&CountedModes, &Flexibility),
        most: usize,
    ) -> Result<(Modes, DMatrix<f64>), Error> {
        let is_mass = |parameter: &WholeParameter| matches!(parameter.share, WholeShare::Mass(_));
        let mut loads = DMatrix::zeros(self.dof_count(), 0);
        for parameter in self.parameters.iter().filter(|_| most > 0) {
            let elements;
            let part = match &parameter.share {
                WholeShare::Stiffness(matrix) | WholeShare::Mass(matrix) => matrix,
                WholeShare::Elements(members) => {
                    let (what, count) = ("stiffness of a parameter", self.dof_count());
                    elements = SparseMatrix::new(what, count, count, entries_of(members, 1.0))?;
                    &elements
                }
            };
            let leading = leading_loads(part, &found.vibrations, is_mass(parameter), most)?;
            loads.extend(leading.column_iter());
        }
        let deflections = flexibility.solve(&loads)?;
        let further = residual_vectors(stiffness, mass, &found.vibrations, deflections)?;
        let has_mass = self.parameters.iter().any(is_mass);
        let rigid_body = match has_mass {
            true => found.rigid_body.clone(),
            false => no_modes(self.dof_count()).shapes,
        };
        Ok((further, rigid_body))
    }

    /// Every parameter's present share in shapes $V$ at all DOF, $s_e V^t K_e V$ or $s_e V^t M_e V$.
    pub(crate) fn shares(
        &self,
        factors: &[f64],
        shapes: &DMatrix<f64>,
    ) -> Result<Vec<ParameterMatrix>, Error> {
        let transposed = shapes.transpose();
        let share = |(parameter, &factor): (&WholeParameter, &f64)| {
            Ok(match &parameter.share {
                WholeShare::Stiffness(matrix) => {
                    ParameterMatrix::Stiffness(factor * matrix.through(&transposed)?)
                }
                WholeShare::Elements(members) => {
                    let present = members
                        .iter()
                        .map(|(element, size)| (element, factor * size));
                    ParameterMatrix::Stiffness(sum_of_stiffness(&transposed, present))
                }
                WholeShare::Mass(matrix) => {
                    ParameterMatrix::Mass(factor * matrix.through(&transposed)?)
                }
            })
        };
        self.parameters.iter().zip(factors).map(share).collect()
    }
}
