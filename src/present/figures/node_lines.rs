//! Mode shapes and node lines of the test, the first model and the correlated one (Figure 6).

use super::canvas::*;
use super::planform::{PlanPoint, Planform};
use super::view::{Plan, View};
use crate::method::linear_algebra::check_shape;
use crate::method::model::Check;
use crate::method::modes::ModeSet;
use crate::method::outer_loop::Correlation;
use crate::method::pairing;
use crate::present::PresentError;
use crate::present::table::Digits;
use crate::present::tables::correlation::last_check;
use nalgebra::Vector3;
use plotters::style::{RGBColor, WHITE};

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
    /// The box in plan.
    pub planform: Planform,
    /// For every test mode: test, first model, last exact solution.
    pub modes: Vec<[ModeState; 3]>,
}

/// Modes of a correlation on the box, in the order and with the signs of the test modes.
///
/// # Errors
/// [`WrongShape`](crate::method::error::Error::WrongShape) unless the modes have nine DOF.
pub fn node_lines(planform: Planform, test: &ModeSet, correlation: &Correlation) -> Result<NodeLines, PresentError> {
    let paired = |check: &Check| pairing::paired(&check.modes, &check.pairing);
    let states = [test.clone(), paired(&correlation.initial)?, paired(last_check(correlation))?];
    check_shape("mode shapes", &test.shapes, 9, test.len())?;
    let state = |modes: &ModeSet, mode: usize| {
        let column = modes.shapes.column(mode);
        let shape = std::array::from_fn(|dof| column[dof] / column.amax());
        ModeState { frequency_hz: modes.frequencies_hz()[mode], shape, node_lines: planform.node_lines(&shape) }
    };
    let modes = (0..test.len()).map(|mode| states.each_ref().map(|modes| state(modes, mode))).collect();
    Ok(NodeLines { modes, planform })
}

/// A thick pale line, a dashed and a thin one can lie on each other and all be seen.
fn pens() -> [(&'static str, Pen); 3] {
    [
        ("test", Pen::solid(between(WHITE, ORANGE, 0.6), 4.5)),
        ("initial", Pen::dashed(BLUE, 1.6)),
        ("correlated", Pen::solid(VERMILION, 1.3)),
    ]
}

fn point(size: f64, fill: RGBColor) -> Mark {
    Mark(Form::Circle, size, Some(fill), Pen::solid(GRAY, 1.2))
}

fn head(area: &Area, what: &str) -> Drawn {
    write(area, what, (14.0, 20.0), START)?;
    let mut x = 24.0 + 6.4 * what.len() as f64;
    for (name, pen) in pens() {
        line(area, &[(x, 20.0), (x + 36.0, 20.0)], pen)?;
        write(area, name, (x + 43.0, 20.0), START)?;
        x += 72.0 + 6.8 * name.len() as f64;
    }
    write(area, "frequencies in Hz: test | initial | correlated", (14.0, 44.0), START)
}

/// Modes side by side.
const ACROSS: usize = 3;
const CELL: (f64, f64) = (WIDTH / ACROSS as f64, 178.0);
const HEAD: f64 = 62.0;

impl NodeLines {
    /// The node lines in plan as SVG.
    pub fn draw(&self, name: &str, title: &str) -> Result<String, PresentError> {
        svg(name, title, self.height(), |area| {
            head(area, "node lines of the")?;
            for (words, x, fill) in [("test up", 440.0, GRAY), ("test down; larger: farther", 525.0, WHITE)] {
                mark(area, (x, 44.0), point(4.0, fill))?;
                write(area, words, (x + 10.0, 44.0), START)?;
            }
            self.each(area, |mode, corner| self.plan(area, mode, corner))
        })
    }

    /// The mode shapes in the quasi-isometric view as SVG.
    pub fn draw_shapes(&self, name: &str, title: &str) -> Result<String, PresentError> {
        svg(name, title, self.height(), |area| {
            head(area, "mid-plane, root at the left:")?;
            self.each(area, |mode, corner| self.bent(area, mode, corner))
        })
    }

    fn height(&self) -> f64 {
        HEAD + CELL.1 * self.modes.len().div_ceil(ACROSS) as f64
    }

    fn each(&self, area: &Area, draw: impl Fn(usize, Place) -> Drawn) -> Drawn {
        for (mode, states) in self.modes.iter().enumerate() {
            let x = CELL.0 * (mode % ACROSS) as f64 + 14.0;
            let y = HEAD + CELL.1 * (mode / ACROSS) as f64;
            write(area, &format!("Mode {}", mode + 1), (x, y + 14.0), START.bold())?;
            let hertz = states.each_ref().map(|state| Digits::Significant(4).write(state.frequency_hz));
            write(area, &hertz.join(" | "), (x + 58.0, y + 14.0), START.small())?;
            draw(mode, (x, y + 26.0))?;
        }
        Ok(())
    }

    fn plan(&self, area: &Area, mode: usize, (left, top): Place) -> Drawn {
        let form = &self.planform;
        let plan = Plan::fitted(form.ribs.as_flattened(), [left, top, CELL.0 - 34.0, CELL.1 - 44.0]);
        let place = |point: PlanPoint| plan.place(point);
        let thin = Pen::solid(GRAY, 1.0);
        for rib in &form.ribs {
            line(area, &rib.map(place), thin)?;
        }
        for side in [0, 1] {
            line(area, &form.ribs.map(|rib| place(rib[side])), thin)?;
        }
        let states = &self.modes[mode];
        for (state, (_, pen)) in states.iter().zip(pens()) {
            for node_line in &state.node_lines {
                let points: Vec<Place> = node_line.iter().copied().map(place).collect();
                line(area, &points, pen)?;
            }
        }
        for (at, value) in form.dynamic_points().into_iter().zip(states[0].shape) {
            let fill = if value > 0.0 { GRAY } else { WHITE };
            mark(area, place(at), point(1.5 + 3.5 * value.abs().sqrt(), fill))?;
        }
        Ok(())
    }

    fn bent(&self, area: &Area, mode: usize, (left, top): Place) -> Drawn {
        let corners = self.planform.ribs.iter().flatten();
        let corners: Vec<_> = corners.map(|&[x, y]| Vector3::new(x, y, 0.0)).collect();
        // The largest displacement is drawn as long as a sixth of the span.
        let span = corners.iter().map(|corner| corner.y).fold(0.0, f64::max);
        let room = [left, top + 12.0, CELL.0 - 26.0, CELL.1 - 52.0];
        let view = View::fitted(&corners, span / 6.0, room);
        let still = ([0.0; 9], Pen::solid(PALE, 1.0));
        let bent = self.modes[mode].iter().zip(pens()).map(|(state, (_, pen))| (state.shape, pen));
        for (shape, pen) in std::iter::once(still).chain(bent) {
            for points in self.mesh(&shape, &view) {
                line(area, &points, pen)?;
            }
        }
        Ok(())
    }

    /// Ribs and spars displaced; one inch of the view for a displacement of one.
    fn mesh(&self, shape: &[f64; 9], view: &View) -> Vec<Vec<Place>> {
        const PARTS: usize = 12;
        let ribs = self.planform.rib_shapes(shape);
        let at = |rib: usize, xi: f64| {
            let [x, y] = self.planform.on_rib(rib, xi);
            view.place(Vector3::new(x, y, ribs[rib].at(xi)))
        };
        let along = |rib| (0..=PARTS).map(|part| at(rib, part as f64 / PARTS as f64)).collect();
        let across = |xi| (0..ribs.len()).map(|rib| at(rib, xi)).collect();
        let spars = [0.0, self.planform.mid_chord_fraction, 1.0];
        (0..ribs.len()).map(along).chain(spars.map(across)).collect()
    }
}
