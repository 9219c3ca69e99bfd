//! The gradient of the error sum by loops over packed numbers.

use crate::method::appendix_c::SMALLEST_SEPARATION;
use crate::method::derivatives::{DERIVATIVE_STEP, DerivativeRule, error_changes};
use crate::method::error::{Error, at_least_one};
use crate::method::inner_loop::Derivative;
use crate::method::linear_algebra::finite_list;
use crate::method::model::{ModalModel, ParameterMatrix};
use crate::method::state::ModalState;
use nalgebra::DMatrix;

/// Numbers that are added up side by side, so that no addition waits for the one before it.
const LANES: usize = 4;

/// A modal model whose shares are packed for [`gradient`](crate::method::derivatives::gradient) at one state after the other.
#[derive(Debug, Clone)]
pub struct PackedModel<'a> {
    model: &'a ModalModel,
    /// The columns' lower parts of every share, those off the diagonal twice, filled up with zeros to a number of lanes.
    shares: Vec<f64>,
    /// The test shapes at unit largest component.
    unit_test: DMatrix<f64>,
    has_mass: bool,
}

impl<'a> PackedModel<'a> {
    /// Packs a model.
    pub fn new(model: &'a ModalModel) -> Self {
        let packed = packed_length(model.basis.len());
        let mut shares = vec![0.0; packed * model.shares.len()];
        for (share, packed) in model.shares.iter().zip(shares.chunks_exact_mut(packed)) {
            let mut doubled = 2.0 * share.matrix();
            doubled.set_diagonal(&share.matrix().diagonal());
            pack(&doubled, packed);
        }
        let mut unit_test = model.test.shapes.clone();
        for mut shape in unit_test.column_iter_mut() {
            shape /= shape.amax();
        }
        let is_mass = |share: &ParameterMatrix| matches!(share, ParameterMatrix::Mass(_));
        let has_mass = model.shares.iter().any(is_mass);
        Self {
            model,
            shares,
            unit_test,
            has_mass,
        }
    }

    /// [`gradient`](crate::method::derivatives::gradient) at a state of this model, to within round-off.
    ///
    /// # Errors
    /// [`Error::WrongShape`] for a state of another model; [`Error::NotFinite`].
    ///
    /// # Example
    ///
    /// ```rust
    /// use corfem::method::derivatives::gradient;
    /// use corfem::method::model::{DynamicModel, ParameterMatrix};
    /// # use corfem::method::modes::ModeSet;
    /// # use corfem::method::state::ModalState;
    /// use corfem::sparse::PackedModel;
    /// # use nalgebra::{dmatrix, dvector};
    ///
    /// let shares = vec![ParameterMatrix::Stiffness(dmatrix![4.0])];
    /// let model = DynamicModel { stiffness: dmatrix![4.0], mass: dmatrix![1.0], shares };
    /// let test = ModeSet::new(dvector![9.0], dmatrix![1.0])?;
    /// let modal = model.analyze(&test, None)?;
    /// let start = ModalState::start(&modal);
    /// let (fast, plain) = (PackedModel::new(&modal).gradient(&start)?, gradient(&modal, &start)?);
    /// assert!((fast[0] - plain[0]).abs() < 1e-14);
    /// # Ok::<(), corfem::method::error::Error>(())
    /// ```
    pub fn gradient(&self, state: &ModalState) -> Result<Vec<f64>, Error> {
        state.check(self.model)?;
        let (dof_count, count) = self.model.basis.shapes.shape();
        let (width, packed) = (count.next_multiple_of(LANES), packed_length(count));
        let mut scratch = vec![0.0; width * (dof_count + count) + 2 * packed];
        let (slopes, rest) = scratch.split_at_mut(width * dof_count);
        let (pull, sensitivities) = rest.split_at_mut(width * count);
        let (of_stiffness, of_mass) = sensitivities.split_at_mut(packed);
        if state.errors.shape > 0.0 {
            self.slopes(state, slopes);
            pull_of(&state.modes.shapes, slopes, pull);
        }
        self.sensitivity(state, pull, |_| 1.0, of_stiffness);
        if self.has_mass {
            self.sensitivity(state, pull, |k| -k, of_mass);
        }
        let parameters = self.model.shares.iter().zip(&state.factors);
        let slope = |((share, factor), packed): ((&ParameterMatrix, &f64), &[f64])| match share {
            ParameterMatrix::Stiffness(_) => factor * product(of_stiffness, packed),
            ParameterMatrix::Mass(_) => factor * product(of_mass, packed),
        };
        let slopes = parameters.zip(self.shares.chunks_exact(packed)).map(slope);
        finite_list("gradient", slopes.collect())
    }

    /// $\partial e_v/\partial v_i$, for each DOF those of all modes.
    fn slopes(&self, state: &ModalState, slopes: &mut [f64]) {
        let (dof_count, count) = state.modes.shapes.shape();
        let (width, per_error) = (
            count.next_multiple_of(LANES),
            1.0 / (dof_count as f64 * state.errors.shape),
        );
        let tests = self.unit_test.as_slice().chunks_exact(dof_count);
        let paired = state.pairing.analysis_mode.iter().zip(&state.pairing.sign);
        for (((&i, sign), test), weight) in paired.zip(tests).zip(&self.model.weights) {
            let shape = &state.modes.shapes.as_slice()[i * dof_count..][..dof_count];
            let (mut largest, mut place) = (0.0, 0);
            for (dof, component) in shape.iter().enumerate() {
                let is_larger = component.abs() > largest;
                largest = if is_larger { component.abs() } else { largest };
                place = if is_larger { dof } else { place };
            }
            let to_unit = sign / largest;
            let scale = weight.shape * weight.shape * to_unit * per_error;
            let mut taken = 0.0;
            for ((slopes, v), w) in slopes.chunks_exact_mut(width).zip(shape).zip(test) {
                let slope = scale * (v * to_unit - w);
                slopes[i] = slope;
                taken += slope * v;
            }
            slopes[place * width + i] -= taken / shape[place];
        }
    }

    /// $\Sigma$ in the exact modes, packed as the shares are but with nothing doubled, with $\partial\beta_{ri}$ `per_change` of
    /// $\omega_i^2$.
    fn sensitivity(
        &self,
        state: &ModalState,
        pull: &[f64],
        per_change: impl Fn(f64) -> f64,
        sensitivity: &mut [f64],
    ) {
        let k = state.modes.omega_squared.as_slice();
        let (count, width) = (k.len(), k.len().next_multiple_of(LANES));
        let mut columns = &mut *sensitivity;
        for i in 0..count {
            let (column, rest) = columns.split_at_mut(count - i);
            columns = rest;
            let (own, row) = (per_change(k[i]), &pull[i * width..][..count]);
            for r in (i..count).skip(1) {
                let apart = k[i] - k[r];
                let larger = k[i].max(k[r]);
                let both = own * pull[r * width + i] - per_change(k[r]) * row[r];
                let are_apart = apart.abs() > SMALLEST_SEPARATION * larger;
                column[r - i] = if are_apart { 0.5 * both / apart } else { 0.0 };
            }
        }
        if state.errors.frequency > 0.0 {
            let squares = self.model.test.omega_squared.iter();
            let paired = state.pairing.analysis_mode.iter().zip(squares);
            for ((&i, square), weight) in paired.zip(&self.model.weights) {
                let ratio = (k[i] / square).sqrt();
                let error = weight.frequency * weight.frequency * (ratio - 1.0) * ratio;
                let place = i * count - i * i.saturating_sub(1) / 2;
                sensitivity[place] =
                    per_change(k[i]) * error / (2.0 * k[i] * state.errors.frequency);
            }
        }
        if state.factors.iter().any(|&factor| factor != 1.0) {
            let p = &state.generalized_shapes;
            let exact = p * unpacked(sensitivity, count) * p.transpose();
            pack(&exact, sensitivity);
        }
    }
}

/// $v_r^t \partial e_v/\partial v_i$ of the slopes, for each $r$ those of all $i$.
fn pull_of(shapes: &DMatrix<f64>, slopes: &[f64], pull: &mut [f64]) {
    let (dof_count, count) = shapes.shape();
    let width = count.next_multiple_of(LANES);
    let shapes = shapes.as_slice().chunks_exact(dof_count);
    for (shape, pull) in shapes.zip(pull.chunks_exact_mut(width)) {
        for (first, pull) in (0..).step_by(LANES).zip(pull.chunks_exact_mut(LANES)) {
            let mut sums = [0.0; LANES];
            for (component, slopes) in shape.iter().zip(slopes.chunks_exact(width)) {
                let slopes = &slopes[first..][..LANES];
                (0..LANES).for_each(|lane| sums[lane] += component * slopes[lane]);
            }
            pull.copy_from_slice(&sums);
        }
    }
}

/// The lower triangle of a symmetric matrix, column by column.
fn pack(matrix: &DMatrix<f64>, packed: &mut [f64]) {
    let mut rest = packed;
    for (i, column) in matrix.column_iter().enumerate() {
        let (own, later) = rest.split_at_mut(matrix.nrows() - i);
        own.iter_mut()
            .zip(column.iter().skip(i))
            .for_each(|(to, from)| *to = *from);
        rest = later;
    }
}

fn unpacked(packed: &[f64], count: usize) -> DMatrix<f64> {
    let (mut matrix, mut rest) = (DMatrix::zeros(count, count), packed);
    for i in 0..count {
        let (own, later) = rest.split_at(count - i);
        matrix.view_range_mut(i.., i).copy_from_slice(own);
        rest = later;
    }
    matrix.fill_upper_triangle_with_lower_triangle();
    matrix
}

/// How many numbers stand for a symmetric matrix.
fn packed_length(count: usize) -> usize {
    (1..=count).sum::<usize>().next_multiple_of(LANES)
}

/// The inner product of two lists of whole lanes.
fn product(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; LANES];
    for (a, b) in a.chunks_exact(LANES).zip(b.chunks_exact(LANES)) {
        for lane in 0..LANES {
            sums[lane] += a[lane] * b[lane];
        }
    }
    sums.iter().sum()
}

/// [`error_changes`](crate::method::derivatives::error_changes) of one model, by its packed shares where the rule asks for the
/// gradient.
pub fn derivative(model: &ModalModel, rule: DerivativeRule) -> Box<Derivative<'_>> {
    match rule {
        DerivativeRule::Definition => Box::new(move |state| error_changes(model, state, rule)),
        DerivativeRule::Gradient => {
            let packed = PackedModel::new(model);
            Box::new(move |state| {
                at_least_one("parameters", model.shares.len())?;
                let slopes = packed.gradient(state)?.into_iter();
                Ok(slopes.map(|slope| DERIVATIVE_STEP * slope).collect())
            })
        }
    }
}
