//! The paper's cases as reports: rows that figures, page and JSON share, and the box as the page draws it.

use corfem::job::verdict::Verdict;
use corfem::method::structure::Grid;
use corfem::present::PresentError;
use corfem::present::compared::{Compared, Derivatives};
use corfem::present::drawing::{Drawing, thousandths};
use corfem::present::page::{in_script, moving};
use corfem::present::report::Parameter;
use corfem::torque_box::CaseResult;
use corfem::torque_box::wing_box::dynamic_points;
use corfem::weighted::comparison::{Comparison, ExactResult};
use nalgebra::{DMatrix, DVectorView, Vector3};
use serde_json::json;
use std::collections::BTreeMap;

/// Change of a factor that is worth to be told: less than this moves no frequency by more than 0.25 %.
const CHANGED: f64 = 0.005;

/// A case with the exact solutions of its first model and of its best.
pub struct CaseReport<'a> {
    pub result: &'a CaseResult,
    pub first: ExactResult,
    pub last: ExactResult,
    pub mass: DMatrix<f64>,
}

impl<'a> CaseReport<'a> {
    pub fn new(result: &'a CaseResult) -> Self {
        let run = &result.correlation;
        Self {
            result,
            first: (&run.initial).into(),
            last: run.best_check().into(),
            mass: result.case.reconstruction.mass(),
        }
    }

    /// The nine test modes beside those of both models.
    pub fn compared(&self) -> Compared<'_> {
        let test = &self.result.test;
        Compared {
            test,
            numbers: (1..=test.len()).collect(),
            first: &self.first,
            last: &self.last,
            mass: Some(&self.mass),
        }
    }

    /// Derivatives at the first model.
    ///
    /// # Errors
    /// Those of the model and its analysis.
    pub fn derivatives(&self) -> Result<Derivatives, PresentError> {
        let CaseResult {
            case,
            parameter_names: names,
            test,
            ..
        } = self.result;
        let first = case.model()?.analyze(&vec![1.0; names.len()], test, None)?;
        Ok(Derivatives::at(&Comparison::from(&first))?)
    }

    /// Rows of the factors.
    pub fn parameters(&self) -> Vec<Parameter> {
        let (result, verdict) = (self.result, Verdict::of_case(self.result));
        let row = |(e, (name, &factor)): (usize, (&String, &f64))| {
            let range = result.ranges.get(e).copied().flatten();
            let is_unseen = verdict.unseen.contains(&e);
            Parameter {
                parameter: name.clone(),
                first: 1.0,
                factor,
                change_percent: 100.0 * (factor - 1.0),
                remark: match () {
                    () if verdict.at_bound.contains(&e) => "at bound",
                    () if is_unseen => "hardly seen",
                    () => "",
                },
                sureness: (!is_unseen).then_some(factor.ln().abs() / CHANGED),
                lower_bound: range.map(|range| range.lower),
                upper_bound: range.map(|range| range.upper),
                ..Parameter::default()
            }
        };
        let factors = &result.correlation.best_factors;
        let names = &result.parameter_names;
        names.iter().zip(factors).enumerate().map(row).collect()
    }

    /// The box moving: its elements, the panels that they belong to, and the motion of every grid, which follows the dynamic points by $B$.
    ///
    /// # Errors
    /// Those of the model and its analysis.
    pub fn moving(&self) -> Result<String, PresentError> {
        let CaseResult {
            case,
            correlation: run,
            ..
        } = self.result;
        let (model, points) = (case.model()?, dynamic_points(&case.reconstruction)?);
        let structure = model.structure();
        let grids = || structure.grids().iter();
        let row: BTreeMap<usize, usize> = grids().map(|grid| grid.label).zip(0..).collect();
        let pieces = structure.elements().iter().map(|element| {
            let parameters = model.parameters().iter().enumerate();
            let of = parameters.filter(|(_, own)| own.elements.contains(&element.label));
            let corners = element.grids.iter().filter_map(|grid| row.get(grid));
            (corners.copied().collect(), of.map(|(e, _)| e).collect())
        });
        let followed = |factors: &[f64], check: &ExactResult| -> Result<_, PresentError> {
            let mut shapes = check.pairing.paired(&check.modes)?.shapes().clone();
            shapes
                .column_iter_mut()
                .for_each(|mut shape| shape /= shape.amax());
            let all = model.condense(factors)?.transformation * &shapes;
            let motion = |shape: DVectorView<f64>, grid: &Grid| {
                thousandths(Vector3::from_fn(|direction, _| {
                    let dof = structure.free_dof_index(grid.label, direction);
                    dof.map_or(0.0, |row| shape[row])
                }))
            };
            let of_mode = |(mode, at_points): (usize, DVectorView<f64>)| {
                let of_grids = grids().map(|grid| motion(all.column(mode), grid));
                let of_points = at_points.iter().map(|&up| thousandths(up * Vector3::z()));
                of_grids.chain(of_points).collect()
            };
            Ok(shapes
                .column_iter()
                .enumerate()
                .map(of_mode)
                .collect::<Vec<Vec<_>>>())
        };
        let places = grids()
            .map(|grid| grid.position)
            .chain(points.iter().copied());
        let drawing = Drawing {
            places: places.map(Into::into).collect(),
            pieces: pieces.collect(),
            sensors: (0..points.len())
                .map(|point| Some((row.len() + point, Vector3::z().into())))
                .collect(),
            moved: [
                followed(&vec![1.0; run.best_factors.len()], &self.first)?,
                followed(&run.best_factors, &self.last)?,
            ],
        };
        let names: Vec<String> = (1..=points.len())
            .map(|point| format!("D{point}"))
            .collect();
        let (compared, parameters) = (self.compared(), self.parameters());
        let (modes, readings) = (compared.modes()?, compared.readings(&names)?);
        let data = json!({"drawing": drawing, "modes": modes, "parameters": parameters, "readings": readings});
        Ok(moving(&in_script(&data)?))
    }

    /// The charts that the page of a job has: factors, frequencies, modal assurance before and after, derivatives.
    ///
    /// # Errors
    /// Those of the model and its analysis.
    pub fn charts(&self) -> Result<String, PresentError> {
        let compared = self.compared();
        let data = in_script(&json!({
            "parameters": self.parameters(),
            "modes": compared.modes()?,
            "first": compared.agreement(&self.first)?,
            "corrected": compared.agreement(&self.last)?,
            "derivatives": self.derivatives()?,
        }))?;
        Ok(format!("<script>charts({data})</script>\n"))
    }
}
