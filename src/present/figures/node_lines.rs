//! Mode shapes and node lines of the test, the first model and the correlated one (Figure 6).

use super::canvas::{
    Area, BLUE, Dash, Drawn, Form, GRAY, LETTERS, Letters, ORANGE, PALE, Pen, Place, SMALL, Side, VERMILION, WIDTH,
    between, line, mark, svg, write,
};
use super::planform::{PlanPoint, Planform, RibShape};
use super::view::{Plan, View};
use crate::cases::CaseResult;
use crate::method::linear_algebra::check_shape;
use crate::method::model::Check;
use crate::method::modes::ModeSet;
use crate::method::pairing::paired;
use crate::present::error::PresentError;
use crate::present::report::table::Digits;
use nalgebra::Vector3;
use plotters::style::WHITE;

/// One mode of one state.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeState {
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Displacement of the nine dynamic points, its largest one.
    pub shape: [f64; 9],
    /// Where the displacement vanishes, in plan, in.
    pub node_lines: Vec<Vec<PlanPoint>>,
}

/// What the figures show.
#[derive(Debug, Clone, PartialEq)]
pub struct NodeLines {
    /// Case number.
    pub case: usize,
    /// The box in plan.
    pub planform: Planform,
    /// For every test mode: test, first model, last exact solution.
    pub modes: Vec<[ModeState; 3]>,
}

/// Modes of a case in the order and with the signs of the test modes.
///
/// # Errors
/// [`Error::WrongShape`] unless the modes have nine DOF.
pub fn node_lines(result: &CaseResult) -> Result<NodeLines, PresentError> {
    let planform = Planform::of(&result.case.reconstruction);
    let correlation = &result.correlation;
    let last = correlation.passes.last().map_or(&correlation.initial, |pass| &pass.check);
    let paired = |check: &Check| paired(&check.modes, &check.pairing);
    let states = [result.test.clone(), paired(&correlation.initial), paired(last)];
    check_shape("mode shapes", &states[0].shapes, 9, result.test.len())?;
    let state = |modes: &ModeSet, mode: usize| {
        let column = modes.shapes.column(mode);
        let largest = column.amax();
        let shape = std::array::from_fn(|dof| column[dof] / largest);
        ModeState { frequency_hz: modes.frequencies_hz()[mode], shape, node_lines: planform.node_lines(&shape) }
    };
    let modes = (0..result.test.len()).map(|mode| [0, 1, 2].map(|which| state(&states[which], mode))).collect();
    Ok(NodeLines { case: result.case.number, modes, planform })
}

/// A thick pale line, a dashed and a thin one can lie on each other and all be seen.
fn pens() -> [(&'static str, Pen); 3] {
    let dash = Dash::Dashed;
    let initial = Pen { color: BLUE, width: 1.6, dash };
    [
        ("test", Pen::solid(between(WHITE, ORANGE, 0.6), 4.5)),
        ("initial", initial),
        ("correlated", Pen::solid(VERMILION, 1.3)),
    ]
}

/// Modes side by side.
const ACROSS: usize = 3;
const CELL: (f64, f64) = (WIDTH / ACROSS as f64, 178.0);
const HEAD: f64 = 62.0;

impl NodeLines {
    /// The node lines in plan as SVG.
    ///
    /// # Errors
    /// [`PresentError::Drawing`].
    pub fn draw(&self) -> Result<String, PresentError> {
        let name = format!("case_{}_node_lines", self.case);
        let title = format!("Case {}: node lines", self.case);
        let size = (WIDTH, HEAD + CELL.1 * self.rows());
        svg(&name, &title, size, |area| {
            self.head(area, "node lines of the")?;
            let words = Letters::new(LETTERS, Side::Right);
            let pen = Pen::solid(GRAY, 1.2);
            for (name, x, fill) in [("test up", 440.0, GRAY), ("test down; larger: farther", 525.0, WHITE)] {
                mark(area, (x, 44.0), (Form::Circle, 4.0), Some(fill), pen)?;
                write(area, name, (x + 10.0, 44.0), words)?;
            }
            self.each(area, |mode, corner| self.plan(area, mode, corner))
        })
    }

    /// The mode shapes in the quasi-isometric view as SVG.
    ///
    /// # Errors
    /// [`PresentError::Drawing`].
    pub fn draw_shapes(&self) -> Result<String, PresentError> {
        let name = format!("case_{}_mode_shapes", self.case);
        let title = format!("Case {}: mode shapes", self.case);
        let size = (WIDTH, HEAD + CELL.1 * self.rows());
        svg(&name, &title, size, |area| {
            self.head(area, "mid-plane, root at the left:")?;
            self.each(area, |mode, corner| self.bent(area, mode, corner))
        })
    }

    fn rows(&self) -> f64 {
        self.modes.len().div_ceil(ACROSS) as f64
    }

    fn head(&self, area: &Area, what: &str) -> Drawn {
        let words = Letters::new(LETTERS, Side::Right);
        write(area, what, (14.0, 20.0), words)?;
        let mut x = 24.0 + 6.4 * what.len() as f64;
        for (name, pen) in pens() {
            line(area, &[(x, 20.0), (x + 36.0, 20.0)], pen)?;
            write(area, name, (x + 43.0, 20.0), words)?;
            x += 72.0 + 6.8 * name.len() as f64;
        }
        write(area, "frequencies in Hz: test | initial | correlated", (14.0, 44.0), words)
    }

    fn each(&self, area: &Area, draw: impl Fn(usize, Place) -> Drawn) -> Drawn {
        for (mode, states) in self.modes.iter().enumerate() {
            let corner = (CELL.0 * (mode % ACROSS) as f64 + 14.0, HEAD + CELL.1 * (mode / ACROSS) as f64);
            let name = format!("Mode {}", mode + 1);
            let at = (corner.0, corner.1 + 14.0);
            write(area, &name, at, Letters::new(LETTERS, Side::Right).bold())?;
            let frequencies = states.each_ref().map(|state| Digits::Significant(4).write(state.frequency_hz));
            let at = (corner.0 + 58.0, corner.1 + 14.0);
            write(area, &frequencies.join(" | "), at, Letters::new(SMALL, Side::Right))?;
            draw(mode, (corner.0, corner.1 + 26.0))?;
        }
        Ok(())
    }

    fn plan(&self, area: &Area, mode: usize, (left, top): Place) -> Drawn {
        let form = &self.planform;
        let plan = Plan::fitted(form.ribs.as_flattened(), [left, top, CELL.0 - 34.0, CELL.1 - 44.0]);
        let place = |point: PlanPoint| plan.place(point);
        for rib in &form.ribs {
            line(area, &rib.map(place), Pen::solid(GRAY, 1.0))?;
        }
        for side in [0, 1] {
            let spar = form.ribs.map(|rib| place(rib[side]));
            line(area, &spar, Pen::solid(GRAY, 1.0))?;
        }
        for (state, (_, pen)) in self.modes[mode].iter().zip(pens()) {
            for node_line in &state.node_lines {
                let points: Vec<Place> = node_line.iter().copied().map(place).collect();
                line(area, &points, pen)?;
            }
        }
        for (point, value) in form.dynamic_points().into_iter().zip(self.modes[mode][0].shape) {
            let fill = if value > 0.0 { GRAY } else { WHITE };
            let size = 1.5 + 3.5 * value.abs().sqrt();
            mark(area, place(point), (Form::Circle, size), Some(fill), Pen::solid(GRAY, 1.2))?;
        }
        Ok(())
    }

    fn bent(&self, area: &Area, mode: usize, (left, top): Place) -> Drawn {
        let corners = self.planform.ribs.as_flattened();
        let corners: Vec<_> = corners.iter().map(|&[x, y]| Vector3::new(x, y, 0.0)).collect();
        // The largest displacement is drawn as long as a sixth of the span.
        let span = corners.iter().map(|corner| corner.y).fold(0.0, f64::max);
        let room = [left, top + 12.0, CELL.0 - 26.0, CELL.1 - 52.0];
        let view = View::fitted(&corners, span / 6.0, room);
        let flat = |[x, y]: PlanPoint, z: f64| view.place(Vector3::new(x, y, z));
        let still = Planform::rib_shapes(&self.planform, &[0.0; 9]);
        for points in self.mesh(&still, &flat) {
            line(area, &points, Pen::solid(PALE, 1.0))?;
        }
        for (state, (_, pen)) in self.modes[mode].iter().zip(pens()) {
            let ribs = self.planform.rib_shapes(&state.shape);
            for points in self.mesh(&ribs, &flat) {
                line(area, &points, pen)?;
            }
        }
        Ok(())
    }

    /// Ribs and spars displaced; one inch of the view for a displacement of one.
    fn mesh(&self, ribs: &[RibShape; 4], flat: &dyn Fn(PlanPoint, f64) -> Place) -> Vec<Vec<Place>> {
        const PARTS: usize = 12;
        let at = |rib: usize, xi: f64| flat(self.planform.on_rib(rib, xi), ribs[rib].at(xi));
        let mut lines: Vec<Vec<Place>> =
            (0..ribs.len()).map(|rib| (0..=PARTS).map(|part| at(rib, part as f64 / PARTS as f64)).collect()).collect();
        for xi in [0.0, self.planform.mid_chord_fraction, 1.0] {
            lines.push((0..ribs.len()).map(|rib| at(rib, xi)).collect());
        }
        lines
    }
}
