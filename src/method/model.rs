//! The finite element model as the correlation sees it: a structure, its dynamic points, what may change, and its analysis.
//! Tour: [chapter 11](crate::tour::chapter_11_own_structure).

use super::{
    analysis::{Analysis, State},
    appendix_a::{
        Condensed, ElementMatrix, assemble, condense, element_matrices, generalized_stiffness,
    },
    changed_modes::changed_modes,
    derivatives::{DERIVATIVE_STEP, error_change, stiffness_changes},
    error::{Error, Result, at_least_one, positive},
    error_sum::errors,
    linear_algebra::{
        Matrix, check_length, check_matrix, check_shape, check_symmetric, cholesky, congruence,
        symmetric_part,
    },
    modes::{Modes, solve},
    sorting::{cross_orthogonality, pair_modes},
    step::{Bounds, REFERENCE_GAGE, StepRule},
    structure::{DIRECTIONS, Structure},
};

/// Elements whose stiffness is scaled by one factor: a single one, or a substructure.
#[derive(Debug, Clone)]
pub struct Parameter {
    /// Its name in reports.
    pub name: String,
    /// Labels of its elements.
    pub elements: Vec<usize>,
    /// Bounds on the factor on its first value, if any.
    pub factor_range: Option<Bounds>,
}

impl Parameter {
    /// The stiffness of one element, which may be named by its number, or of a group, without bounds.
    pub fn new(name: impl ToString, elements: &[usize]) -> Self {
        Self {
            name: name.to_string(),
            elements: elements.to_vec(),
            factor_range: None,
        }
    }
}

/// A structure and what may change of it, with its load distribution $T$ (A.3) and the mass $M$ of its dynamic points.
///
/// A parameter scales stiffness alone: in the paper the mass is known and never changes. A gage that a correlation finds is
/// therefore a statement about stiffness and does not make the element heavier.
///
/// # Example
///
/// Two rods whose areas a test knows better:
///
/// ```rust
/// use corfem::method::model::{FiniteElementModel, Parameter};
/// use corfem::method::modes::Modes;
/// use corfem::method::outer_loop::{Settings, correlate};
/// use corfem::method::structure::{Element, ElementKind, Grid, Material, Structure};
/// use nalgebra::{DMatrix, Vector3, dmatrix};
///
/// // Two rods end to end from a wall, 10 in each, free to move along x.
/// let material = Material::isotropic(1.0e7, 0.3)?;
/// let grids = [1, 2, 3].map(|label| {
///     Grid { label, position: Vector3::new(10.0 * label as f64, 0.0, 0.0), constrained: [label == 1, true, true] }
/// });
/// let rods = [1, 2].map(|label| {
///     Element { label, kind: ElementKind::Rod, grids: vec![label, label + 1], size: 0.1, material }
/// });
/// let structure = Structure::new(grids.to_vec(), rods.to_vec())?;
/// let t = DMatrix::identity(2, 2); // measured are the structure's own two DOF
/// let mass = DMatrix::from_diagonal_element(2, 2, 0.01);
/// let parameters = [1, 2].map(|rod| Parameter::new(rod, &[rod]));
/// let model = FiniteElementModel::new(structure, t, mass, parameters.to_vec())?;
///
/// // Frequencies in hertz; shapes of any scale, one a column.
/// let test = Modes::from_measured(&[291.340, 851.875], &dmatrix![0.7208, 1.0; 1.0, -0.7208])?;
/// let settings = Settings { error_sum_tolerance: 0.005, later_inner_tolerance: 0.002, ..Settings::default() };
/// let settings = settings.for_modes(2);
/// let limits = model.factor_ranges()?;
/// let result = correlate(|factors| model.analyze(factors, &test, None), &limits, &settings, |_, _| true)?;
/// let areas = model.sizes(&result.best_factors)?;
/// assert!((areas[0] - 0.08).abs() < 0.001 && (areas[1] - 0.12).abs() < 0.001);
/// # Ok::<(), corfem::method::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct FiniteElementModel {
    structure: Structure,
    parameters: Vec<Parameter>,
    /// Rows of every parameter's elements.
    rows: Vec<Vec<usize>>,
    pub(crate) element_matrices: Vec<ElementMatrix>,
    load_distribution: Matrix,
    mass: Matrix,
}

impl FiniteElementModel {
    /// Puts a model together and forms every unit element matrix, once.
    ///
    /// `load_distribution` is $T$ (free SDOF × d), `mass` the dynamic mass $M$ (d × d, lbf·s²/in).
    ///
    /// # Errors
    /// No parameters, one without elements or with one that is not there, an element in two of them, a $T$ that does not fit or is not
    /// finite, and a mass that is not positive definite.
    pub fn new(
        structure: Structure,
        load_distribution: Matrix,
        mass: Matrix,
        parameters: Vec<Parameter>,
    ) -> Result<Self> {
        let (free, dynamic) = (structure.free_dof().len(), mass.nrows());
        at_least_one("dynamic degrees of freedom", dynamic)?;
        check_matrix("load distribution", &load_distribution, free, dynamic)?;
        cholesky("dynamic mass", &mass, 0.0)?;
        let element_matrices: Vec<_> = element_matrices(&structure).collect();
        at_least_one("parameters", parameters.len())?;
        let (mut rows, mut owners) = (Vec::new(), vec![None; element_matrices.len()]);
        for Parameter { name, elements, .. } in &parameters {
            at_least_one("elements of a parameter", elements.len())?;
            let row = |&label: &usize| {
                let (what, owner) = ("element", format!("parameter {name}"));
                let mut all = structure.elements().iter();
                let row = all.position(|element| element.label == label);
                let row = row.ok_or(Error::Unknown { owner, what, label })?;
                let Some(first) = owners[row].replace(name) else {
                    return Ok(row);
                };
                let owner = format!("parameters {first} and {name}");
                Err(Error::Duplicate { owner, what, label })
            };
            rows.push(elements.iter().map(row).collect::<Result<_, _>>()?);
        }
        Ok(Self {
            rows,
            structure,
            parameters,
            element_matrices,
            load_distribution,
            mass,
        })
    }

    /// The structure with its first sizes.
    pub fn structure(&self) -> &Structure {
        &self.structure
    }

    /// Parameters: what may change.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// Unit matrices of the elements at the free DOF.
    pub fn element_matrices(&self) -> &[ElementMatrix] {
        &self.element_matrices
    }

    /// The load distribution $T$ (free SDOF × d).
    pub fn load_distribution(&self) -> &Matrix {
        &self.load_distribution
    }

    /// The dynamic mass $M$, lbf·s²/in (d × d).
    pub fn mass(&self) -> &Matrix {
        &self.mass
    }

    /// Bounds on each parameter's factor.
    ///
    /// # Errors
    /// Bounds that exclude the first value.
    pub fn factor_ranges(&self) -> Result<Vec<Option<Bounds>>> {
        let range = |parameter: &Parameter| {
            let Some(Bounds { lower, upper }) = parameter.factor_range else {
                return Ok(None);
            };
            let what = format!("factor of parameter {}", parameter.name);
            match Bounds::positive(&what, lower, upper)? {
                range if range.holds_start() => Ok(Some(range)),
                _ => Err(Error::Range { what, lower, upper }),
            }
        };
        self.parameters.iter().map(range).collect()
    }

    /// Gages (in) and areas (in²) of all elements at the parameters' factors, in the structure's order.
    ///
    /// # Errors
    /// Another number of factors, and a factor or size that is not positive and finite.
    pub fn sizes(&self, factors: &[f64]) -> Result<Vec<f64>> {
        check_length("parameter factors", factors.len(), self.parameters.len())?;
        let mut sizes: Vec<f64> = self
            .structure
            .elements()
            .iter()
            .map(|element| element.size)
            .collect();
        for ((parameter, rows), &factor) in self.parameters.iter().zip(&self.rows).zip(factors) {
            let owner = || format!("parameter {}", parameter.name);
            positive("factor", owner, factor)?;
            for &row in rows {
                sizes[row] *= factor;
                positive("scaled size", owner, sizes[row])?;
            }
        }
        Ok(sizes)
    }

    /// $K_D$ and $B^t$ at the given parameter factors: $K_S$ anew.
    ///
    /// # Errors
    /// A bad list of factors, the grid and direction that nothing holds, and a dynamic DOF that is a combination of others.
    pub fn condense(&self, factors: &[f64]) -> Result<Condensed> {
        let free = self.structure.free_dof();
        let structural = assemble(&self.element_matrices, &self.sizes(factors)?, free.len())?;
        condense(&structural, &self.load_distribution).map_err(|error| match error {
            Error::NotPositiveDefinite {
                what: "structural stiffness",
                row,
            } => Error::SingularStiffness {
                grid: free[row].grid,
                direction: DIRECTIONS[free[row].direction],
            },
            other => other,
        })
    }

    /// The finite element analysis at the given parameter factors, compared with the test modes: what the loops are handed.
    ///
    /// It takes the lowest `analysis_modes` modes, or as many as there are dynamic DOF.
    ///
    /// # Errors
    /// Every error of [`Self::matrices`] and [`DynamicModel::analyze`].
    ///
    /// # Example
    ///
    /// ```rust
    /// # use corfem::chain::rods;
    /// # use corfem::method::model::{FiniteElementModel, Parameter};
    /// use corfem::method::analysis::Analysis;
    /// use corfem::method::modes::Modes;
    /// use nalgebra::{dmatrix, dvector};
    ///
    /// // A unit mass on a spring of 4 beside a test mode of ω² = 9: a frequency of 2 for 3.
    /// let (spring, parameters) = (rods(&[4.0], [true, false])?, vec![Parameter::new(1, &[1])]);
    /// let model = FiniteElementModel::new(spring, dmatrix![1.0], dmatrix![1.0], parameters)?;
    /// let test = Modes::new(dvector![9.0], dmatrix![1.0])?;
    /// let analysis = model.analyze(&[1.0], &test, None)?;
    /// assert!((analysis.exact().errors.frequency - 1.0 / 3.0).abs() < 1e-14);
    /// # Ok::<(), corfem::method::error::Error>(())
    /// ```
    pub fn analyze(
        &self,
        factors: &[f64],
        test: &Modes,
        analysis_modes: Option<usize>,
    ) -> Result<ModalModel> {
        let mut model = self.matrices(factors)?.analyze(test, analysis_modes)?;
        let sizes = self.sizes(factors)?;
        let mean =
            |rows: &Vec<usize>| rows.iter().map(|&row| sizes[row]).sum::<f64>() / rows.len() as f64;
        model.gages = self.rows.iter().map(mean).collect();
        Ok(model)
    }

    /// $K_D$, $M$ and every parameter's share $B K_e B^t$ of $K_D$ (A.9), at the given parameter factors.
    ///
    /// # Errors
    /// Every error of [`Self::condense`].
    pub fn matrices(&self, factors: &[f64]) -> Result<DynamicModel> {
        let (sizes, condensed) = (self.sizes(factors)?, self.condense(factors)?);
        let b = &condensed.transformation;
        let share =
            |&row: &usize| generalized_stiffness(&self.element_matrices[row], sizes[row], b);
        let sum = |rows: &Vec<usize>| rows.iter().map(share).sum();
        Ok(DynamicModel {
            shares: self.rows.iter().map(sum).collect(),
            stiffness: condensed.stiffness,
            mass: self.mass.clone(),
        })
    }

    /// The exact modes at the given parameter factors, at the dynamic DOF.
    ///
    /// # Errors
    /// Every error of [`Self::condense`], and a mode with $\omega^2 \le 0$.
    pub fn modes(&self, factors: &[f64]) -> Result<Modes> {
        let stiffness = self.condense(factors)?.stiffness;
        solve(&stiffness, &self.mass, self.mass.nrows())
    }
}

/// A model given by its matrices at the dynamic DOF, whatever made them.
#[derive(Debug, Clone)]
pub struct DynamicModel {
    /// Dynamic stiffness $K_D$, lbf/in (d × d).
    pub stiffness: Matrix,
    /// Dynamic mass $M$, lbf·s²/in (d × d).
    pub mass: Matrix,
    /// Each parameter's present share of the stiffness, $B K_e B^t$ (A.9), lbf/in (d × d).
    pub shares: Vec<Matrix>,
}

impl DynamicModel {
    /// The analysis of the lowest `analysis_modes` modes, of all when none are named, beside test modes of any scale.
    ///
    /// # Errors
    /// Matrices or test modes that do not fit or are not finite, shares that are not symmetric, what [`solve`] refuses, and more test modes
    /// than modes.
    pub fn analyze(&self, test: &Modes, analysis_modes: Option<usize>) -> Result<ModalModel> {
        let dof_count = self.stiffness.nrows();
        for share in &self.shares {
            check_shape("parameter share", share, dof_count, dof_count)?;
            check_symmetric("parameter share", share)?;
        }
        let modes = solve(
            &self.stiffness,
            &self.mass,
            analysis_modes.unwrap_or(dof_count),
        )?;
        check_shape("test mode shapes", &test.shapes, dof_count, test.len())?;
        let test = test.scaled_with(&self.mass)?;
        let through = |share, v| symmetric_part(&congruence(share, v));
        let omega = test.omega_squared.map(f64::sqrt);
        let own = &omega * omega.transpose();
        let relative = |share| through(share, &test.shapes).component_div(&own);
        let cross = cross_orthogonality(&modes, &test, &self.mass)?;
        let (pairing, count) = (pair_modes(&cross)?, self.shares.len());
        Ok(ModalModel {
            shares: self
                .shares
                .iter()
                .map(|share| through(share, &modes.shapes))
                .collect(),
            test_shares: self.shares.iter().map(relative).collect(),
            gages: vec![REFERENCE_GAGE; count],
            exact: State {
                share_factors: vec![1.0; count],
                generalized_shapes: Matrix::identity(modes.len(), modes.len()),
                errors: errors(&modes, &pairing, &test)?,
                modes,
                pairing,
            },
            test,
            cross,
        })
    }
}

/// A model seen through its exact modes, beside the test modes: the paper's analysis.
#[derive(Debug, Clone)]
pub struct ModalModel {
    exact: State,
    test: Modes,
    cross: Matrix,
    shares: Vec<Matrix>,
    test_shares: Vec<Matrix>,
    /// Mean gage (in) or area (in²) of every parameter's elements; [`REFERENCE_GAGE`] for one that has none.
    pub(crate) gages: Vec<f64>,
}

impl ModalModel {
    /// The test modes, scaled to unit generalized mass with the model's mass.
    pub fn test(&self) -> &Modes {
        &self.test
    }

    /// Cross-orthogonality of the exact modes with the test modes (4), n × g.
    pub fn cross(&self) -> &Matrix {
        &self.cross
    }

    /// Generalized stiffness $V^t K_e V$ of every parameter, rad²/s² (n × n).
    pub fn shares(&self) -> &[Matrix] {
        &self.shares
    }

    /// Generalized stiffness of every parameter on the test modes, relative to the test's own,
    /// $V_{Gi}^t K_e V_{Gj}/(\omega_{Gi} \omega_{Gj})$ (g × g).
    pub fn test_shares(&self) -> &[Matrix] {
        &self.test_shares
    }
}

impl Analysis for ModalModel {
    fn exact(&self) -> &State {
        &self.exact
    }

    /// The modes after $\beta = \sum_e (s_e - 1) V^t K_e V$.
    fn at(&self, share_factors: &[f64]) -> Result<State> {
        check_length("parameter factors", share_factors.len(), self.shares.len())?;
        let before = &self.exact.modes;
        let mut beta = Matrix::zeros(before.len(), before.len());
        for (share, s) in self.shares.iter().zip(share_factors) {
            beta += (s - 1.0) * share;
        }
        let (modes, p) = changed_modes(before, &beta)?;
        let pairing = pair_modes(&p.tr_mul(&self.cross))?;
        Ok(State {
            errors: errors(&modes, &pairing, &self.test)?,
            share_factors: share_factors.to_vec(),
            modes,
            generalized_shapes: p,
            pairing,
        })
    }

    /// For each parameter, $\beta = 0.001 s_e V^t K_e V$ with the present modes $V$.
    fn error_changes(&self, state: &State) -> Result<Vec<f64>> {
        let (p, count) = (&state.generalized_shapes, state.modes.len());
        check_shape("shapes of the state", p, self.exact.modes.len(), count)?;
        check_length(
            "parameter factors",
            state.share_factors.len(),
            self.shares.len(),
        )?;
        let change = |(share, s): (&Matrix, &f64)| {
            let beta = DERIVATIVE_STEP * *s * congruence(share, p);
            error_change(state, &beta, &self.test)
        };
        self.shares
            .iter()
            .zip(&state.share_factors)
            .map(change)
            .collect()
    }

    fn stiffness_changes(&self, state: &State, gage_factors: &[f64], rule: StepRule) -> Vec<f64> {
        stiffness_changes(rule, &self.test_shares, state, &self.gages, gage_factors)
    }
}
