//! The paper figures are drawn on: an SVG through plotters, its lines, marks and letters.
//!
//! Lengths are in pixels of a figure 760 wide, which printed 17 cm wide makes its smallest letters 7 points high. The plotting library
//! knows whole units only, so a unit is a tenth of a pixel.

pub use super::chart::{axes, chart, placed};
pub use super::colors::{BLUE, GRAY, INK, ORANGE, PALE, SILVER, SKY, VERMILION, hex, tint, toned};
use corfem::files::escaped;
pub use corfem::present::PresentError;
use corfem::present::render::lines;
use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
pub use plotters::style::{RGBColor, WHITE};

/// Units to a pixel.
pub const UNITS: f64 = 10.0;
/// Width of every figure, px.
pub const WIDE: f64 = 760.0;
/// Height that a title fills above everything else, and of a line below another, px.
const HEAD: f64 = 30.0;
pub const LINE: f64 = 18.0;
/// Room left and right of what is written along a figure, px.
pub const EDGE: f64 = 14.0;
/// Faces asked for.
const FACE: &str = "Noto Sans, Arial, Helvetica, sans-serif";
/// The plotting library divides letter heights by this.
const LETTER_SCALE: f64 = 1.24;

pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub type Drawn<T = ()> = Result<T, DrawingAreaErrorKind<std::io::Error>>;
/// A place on a figure: right, down, px.
pub type Place = (f64, f64);

/// Pixels to the library's units. A place midway between two goes to the next, whatever the last bits of its number are.
pub fn units(pixels: f64) -> i32 {
    const LAST_BITS: f64 = 1e-6;
    (UNITS * pixels + LAST_BITS).round() as i32
}

fn place((x, y): Place) -> (i32, i32) {
    (units(x), units(y))
}

/// Style of a line: its color, its width in px, and its dashes.
#[derive(Debug, Clone, Copy)]
pub struct Pen(pub RGBColor, pub f64, pub Dash);

/// Dashes of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dash {
    Solid,
    Dashed,
    Dotted,
}

impl Pen {
    pub fn solid(color: RGBColor, width: f64) -> Self {
        Self(color, width, Dash::Solid)
    }

    pub fn dashed(color: RGBColor, width: f64) -> Self {
        Self(color, width, Dash::Dashed)
    }

    pub fn style(&self) -> ShapeStyle {
        self.0.stroke_width(units(self.1).unsigned_abs())
    }
}

/// A mark: its form, its size as the radius of the circle in px, its fill (open without one) and its outline.
#[derive(Debug, Clone, Copy)]
pub struct Mark(pub Form, pub f64, pub Option<RGBColor>, pub Pen);

/// Forms of a mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    Circle,
    Square,
    Diamond,
}

/// Style of letters; [`START`] and [`MIDDLE`] say which end of them lies at their place.
#[derive(Clone, Copy)]
pub struct Letters {
    pub height: f64,
    pub color: RGBColor,
    pub weight: FontStyle,
    pub across: HPos,
    pub upward: bool,
}

const fn letters(across: HPos) -> Letters {
    Letters {
        height: 13.0,
        color: INK,
        weight: FontStyle::Normal,
        across,
        upward: false,
    }
}

pub const START: Letters = letters(HPos::Left);
pub const MIDDLE: Letters = letters(HPos::Center);

impl Letters {
    pub fn bold(self) -> Self {
        Self {
            weight: FontStyle::Bold,
            ..self
        }
    }

    pub fn small(self) -> Self {
        Self {
            height: 11.0,
            ..self
        }
    }

    pub fn style(self) -> TextStyle<'static> {
        let height = UNITS * LETTER_SCALE * self.height;
        let mut font = FontDesc::new(FontFamily::Name(FACE), height, self.weight);
        if self.upward {
            font = font.transform(FontTransform::Rotate270);
        }
        TextStyle {
            color: self.color.to_backend_color(),
            pos: Pos::new(self.across, VPos::Center),
            ..font.into()
        }
    }
}

/// Draws a figure of a height below its title and returns it as an SVG document that names itself to a screen reader too.
pub fn svg(
    name: &str,
    title: &str,
    height: f64,
    draw: impl FnOnce(&Area) -> Drawn,
) -> Result<String, PresentError> {
    let mut drawn = String::new();
    let bold = Letters {
        height: 14.0,
        ..START.bold()
    };
    let (across, down) = (
        units(WIDE).unsigned_abs(),
        units(HEAD + height).unsigned_abs(),
    );
    {
        let area = SVGBackend::with_string(&mut drawn, (across, down)).into_drawing_area();
        area.fill(&WHITE)
            .and_then(|()| write(&area, title, (EDGE, 16.0), bold))
            .and_then(|()| draw(&area.split_vertically(units(HEAD)).1))
            .and_then(|()| area.present())
            .map_err(|error| PresentError::Drawing {
                figure: name.to_owned(),
                found: error.to_string(),
            })?;
    }
    let body = drawn.split_once('\n').map_or("", |(_, body)| body);
    let title = title.replace('&', "&amp;").replace('<', "&lt;");
    Ok(escaped(&format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"drawn\" width=\"{WIDE}\" height=\"{}\" viewBox=\"0 0 {across} \
        {down}\" role=\"img\">\n<title>{title}</title>\n{body}",
        HEAD + height
    )))
}

/// Distance of what is drawn on from the top of its figure, px.
pub fn top(area: &Area) -> f64 {
    f64::from(area.get_pixel_range().1.start) / UNITS
}

/// Words in lines that a figure has room for.
pub fn paragraph(words: &str) -> Vec<String> {
    let across = (WIDE - 2.0 * EDGE) / (0.6 * START.height);
    lines(words.split(' '), across as usize)
}

/// Lines below each other, the first at a place.
pub fn write_lines(area: &Area, lines: &[String], (x, y): Place, letters: Letters) -> Drawn {
    let rows = lines.iter().zip(0..);
    rows.into_iter()
        .try_for_each(|(words, row)| write(area, words, (x, y + LINE * f64::from(row)), letters))
}

pub fn line(area: &Area, points: &[Place], pen: Pen) -> Drawn {
    let points: Vec<(i32, i32)> = points.iter().copied().map(place).collect();
    let (on, off) = match pen.2 {
        Dash::Solid => return area.draw(&PathElement::new(points, pen.style())),
        Dash::Dashed => (units(7.0), units(3.5)),
        Dash::Dotted => (units(1.5), units(2.5)),
    };
    area.draw(&DashedPathElement::new(points, on, off, pen.style()))
}

/// A polygon, filled and with its outline.
pub fn polygon(area: &Area, corners: &[Place], fill: Option<RGBColor>, pen: Pen) -> Drawn {
    if let Some(fill) = fill {
        area.draw(&Polygon::new(
            corners.iter().copied().map(place).collect::<Vec<_>>(),
            fill.filled(),
        ))?;
    }
    let closed: Vec<Place> = corners.iter().chain(corners.first()).copied().collect();
    line(area, &closed, pen)
}

pub fn rectangle(area: &Area, from: Place, to: Place, fill: RGBColor) -> Drawn {
    area.draw(&Rectangle::new([place(from), place(to)], fill.filled()))
}

/// The corners of an upright rectangle between two opposite ones.
pub fn corners((left, top): Place, (right, bottom): Place) -> [Place; 4] {
    [(left, top), (right, top), (right, bottom), (left, bottom)]
}

pub fn mark(area: &Area, at: Place, Mark(form, size, fill, pen): Mark) -> Drawn {
    let corners = match form {
        Form::Circle => {
            let circle = |style: ShapeStyle| area.draw(&Circle::new(place(at), units(size), style));
            fill.map_or(Ok(()), |fill| circle(fill.filled()))?;
            return circle(pen.style());
        }
        Form::Square => [(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
        Form::Diamond => [(0.0, -1.3), (1.3, 0.0), (0.0, 1.3), (-1.3, 0.0)],
    };
    let corners = corners.map(|(dx, dy)| (at.0 + size * dx, at.1 + size * dy));
    polygon(area, &corners, fill, pen)
}

pub fn write(area: &Area, text: &str, (x, y): Place, letters: Letters) -> Drawn {
    // The library sets centered letters too high by a tenth of their height.
    let lower = 0.1 * letters.height;
    let at = if letters.upward {
        (x + lower, y)
    } else {
        (x, y + lower)
    };
    area.draw(&Text::new(text.to_owned(), place(at), letters.style()))
}

/// A mark of a legend with its meaning.
pub fn marked(area: &Area, at: Place, form: Mark, words: &str) -> Drawn {
    mark(area, at, form)?;
    write(area, words, (at.0 + 12.0, at.1), START)
}

/// Name of a line or a mark, from the place where that ends, with the pen and the mark that stand before the name.
#[derive(Clone, Copy)]
pub struct Named<'a>(pub Place, pub &'a str, pub Option<Pen>, pub Option<Mark>);

/// From the end of a line to its name, px.
pub const KEY: f64 = 32.0;

/// Names behind the ends of their lines, pushed apart where two would meet.
pub fn name_ends(area: &Area, mut ends: Vec<Named>) -> Drawn {
    ends.sort_by(|one, other| one.0.1.total_cmp(&other.0.1));
    for _ in 0..100 {
        for next in 1..ends.len() {
            let lacking = (17.0 - (ends[next].0.1 - ends[next - 1].0.1)).max(0.0);
            ends[next - 1].0.1 -= 0.5 * lacking;
            ends[next].0.1 += 0.5 * lacking;
        }
    }
    for Named((x, y), name, pen, form) in ends {
        if let Some(pen) = pen {
            line(area, &[(x + 9.0, y), (x + KEY - 6.0, y)], pen)?;
        }
        if let Some(form) = form {
            mark(area, (x + 0.5 * (KEY + 3.0), y), form)?;
        }
        write(area, name, (x + KEY, y), START)?;
    }
    Ok(())
}

/// The name of a vertical axis, along the left edge.
pub fn name_upright(area: &Area, text: &str, middle: f64) -> Drawn {
    write(
        area,
        text,
        (13.0, middle),
        Letters {
            upward: true,
            ..MIDDLE
        },
    )
}

/// A number with the sign for minus.
pub fn signed(text: String) -> String {
    text.replace('-', "−")
}
