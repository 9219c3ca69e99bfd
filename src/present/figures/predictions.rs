//! What the corrected models say of frequencies, as tested and after a design change.

use super::canvas::{
    Area, BLUE, Dash, Drawn, GRAY, INK, LETTERS, Letters, ORANGE, PALE, Pen, SMALL, Side, WIDTH, bar, line,
    name_upright, svg, write,
};
use crate::present::error::PresentError;
use crate::studies::matrix_comparison::{COVER_DOUBLER, MatrixComparison, Prediction, TRUTH};
use plotters::style::{RGBColor, WHITE};

/// Frequency errors of one model, fractions, mode by mode.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelErrors {
    /// Which model.
    pub model: String,
    /// Of the box as tested.
    pub as_tested: Vec<f64>,
    /// Of the box after the design change.
    pub after_change: Vec<f64>,
}

/// What the figure shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Predictions {
    /// Case number.
    pub case: usize,
    /// Number of test modes, the lowest; the others no model was shown.
    pub test_modes: usize,
    /// The start and the corrections.
    pub models: Vec<ModelErrors>,
}

/// Frequency errors from a comparison, all but those of the truth, which has none.
pub fn predictions(comparison: &MatrixComparison) -> Predictions {
    let errors = |prediction: &Prediction| ModelErrors {
        model: prediction.model.to_owned(),
        as_tested: prediction.as_tested.clone(),
        after_change: prediction.after_change.clone(),
    };
    Predictions {
        case: comparison.case,
        test_modes: comparison.test_modes,
        models: comparison.predictions.iter().filter(|prediction| prediction.model != TRUTH).map(errors).collect(),
    }
}

/// Height of the figure, of a panel, and upper edges of the two, px.
const HEIGHT: f64 = 580.0;
const PANEL: f64 = 190.0;
const TOP: [f64; 2] = [80.0, 336.0];
/// Left and right edge of the panels, px.
const EDGES: [f64; 2] = [66.0, 746.0];
/// Most steps of the vertical axis.
const MOST_STEPS: f64 = 6.0;
/// Bars of the models, in their order.
const FILLS: [RGBColor; 4] = [WHITE, BLUE, ORANGE, GRAY];

impl Predictions {
    /// The figure as SVG.
    ///
    /// # Errors
    /// [`PresentError::Drawing`].
    pub fn draw(&self) -> Result<String, PresentError> {
        let title = format!("Case {}: frequency errors of the corrected models", self.case);
        svg("matrices_frequencies", &title, (WIDTH, HEIGHT), |area| self.on(area))
    }

    fn on(&self, area: &Area) -> Drawn {
        let change = format!("Every cover {COVER_DOUBLER:.3} in thicker, untested");
        self.panel(area, TOP[0], "As tested", |model| &model.as_tested)?;
        self.panel(area, TOP[1], &change, |model| &model.after_change)?;
        let words = Letters::new(LETTERS, Side::Center);
        let center = 0.5 * (EDGES[0] + EDGES[1]);
        write(area, "mode", (center, TOP[1] + PANEL + 40.0), words)?;
        name_upright(area, "frequency error, percent", 0.5 * (TOP[0] + TOP[1] + PANEL))?;
        let mut x = EDGES[0];
        for (model, fill) in self.models.iter().zip(FILLS) {
            bar(area, (x, 15.0), (x + 16.0, 29.0), fill)?;
            let words = Letters::new(LETTERS, Side::Right);
            write(area, &model.model, (x + 23.0, 22.0), words)?;
            x += 150.0;
        }
        Ok(())
    }

    /// Lower and upper end of the vertical axis and its step, percent: both panels have the same, with a little room.
    fn scale(&self) -> (f64, f64, f64) {
        let all = || {
            let both = |model: &ModelErrors| [model.as_tested.clone(), model.after_change.clone()];
            self.models.iter().flat_map(both).flatten()
        };
        let low = 100.0 * all().fold(0.0, f64::min);
        let high = 100.0 * all().fold(0.0, f64::max);
        // Steps of 1, 2 or 5 times a power of ten; for errors of round-off alone the axis still has a length.
        let least = ((high - low) / MOST_STEPS).max(1e-3);
        let power = 10.0_f64.powf(least.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0]
            .into_iter()
            .map(|digit| digit * power)
            .find(|step| *step >= least)
            .unwrap_or(10.0 * power);
        let room = 0.2 * step;
        (low - room, high + room, step)
    }

    fn panel(&self, area: &Area, top: f64, title: &str, errors: fn(&ModelErrors) -> &[f64]) -> Drawn {
        let [left, right] = EDGES;
        let (low, high, step) = self.scale();
        let height = |percent: f64| top + PANEL * (high - percent) / (high - low);
        let bold = Letters::new(LETTERS, Side::Right).bold();
        write(area, title, (left, top - 14.0), bold)?;
        let decimals = (-step.log10().floor()).max(0.0) as usize;
        for k in (low / step).ceil() as i64..=(high / step).floor() as i64 {
            let percent = step * k as f64;
            let y = height(percent);
            line(area, &[(left, y), (right, y)], Pen::solid(PALE, 0.8))?;
            let text = format!("{percent:.decimals$}").replace('-', "−");
            write(area, &text, (left - 8.0, y), Letters::new(LETTERS, Side::Left))?;
        }
        let count = self.models.first().map_or(0, |model| errors(model).len());
        let wide = (right - left) / count.max(1) as f64;
        for mode in 0..count {
            let from = left + wide * mode as f64;
            let number = Letters::new(LETTERS, Side::Center);
            let at = (from + 0.5 * wide, top + PANEL + 15.0);
            write(area, &(mode + 1).to_string(), at, number)?;
            let thick = 0.84 * wide / self.models.len() as f64;
            for (row, (model, fill)) in self.models.iter().zip(FILLS).enumerate() {
                let percent = 100.0 * errors(model)[mode];
                let x = from + 0.08 * wide + thick * row as f64;
                let (upper, lower) = (height(percent.max(0.0)), height(percent.min(0.0)));
                bar(area, (x, upper), (x + thick, lower), fill)?;
            }
        }
        line(area, &[(left, height(0.0)), (right, height(0.0))], Pen::solid(INK, 1.2))?;
        line(area, &[(left, top), (left, top + PANEL)], Pen::solid(INK, 1.0))?;
        if self.test_modes < count {
            let x = left + wide * self.test_modes as f64;
            let dashed = Pen { dash: Dash::Dashed, ..Pen::solid(INK, 1.0) };
            line(area, &[(x, top - 22.0), (x, top + PANEL)], dashed)?;
            for (words, shift, side) in [("test modes", -8.0, Side::Left), ("not shown to any model", 8.0, Side::Right)]
            {
                let small = Letters::new(SMALL, side);
                write(area, words, (x + shift, top - 14.0), small)?;
            }
        }
        Ok(())
    }
}
