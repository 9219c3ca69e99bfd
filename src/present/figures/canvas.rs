//! The paper figures are drawn on: an SVG through plotters, its lines, marks and letters.
//!
//! Lengths are in pixels of a figure 760 wide, which printed 17 cm wide makes its smallest letters 7 points high. The
//! plotting library knows whole units only, so a unit is a tenth of a pixel.

use crate::present::error::PresentError;
use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Units to a pixel.
const UNITS: f64 = 10.0;
/// Every figure's width, px.
pub(super) const WIDTH: f64 = 760.0;
/// Faces asked for, the last being whatever the reader has.
const FACE: &str = "Noto Sans, Arial, Helvetica, sans-serif";
/// The plotting library divides letter heights by this.
const LETTER_SCALE: f64 = 1.24;

/// Height of ordinary letters, px.
pub(super) const LETTERS: f64 = 13.0;
/// Height of small letters, px.
pub(super) const SMALL: f64 = 11.0;

// The colors of Okabe and Ito, which people with any common color blindness tell apart. Figures never rely on color
// alone: lines differ in dashes, marks in form, cells carry their numbers.
pub(super) const INK: RGBColor = RGBColor(0x22, 0x22, 0x22);
pub(super) const GRAY: RGBColor = RGBColor(0x8a, 0x8a, 0x8a);
pub(super) const SILVER: RGBColor = RGBColor(0xb4, 0xb4, 0xb4);
pub(super) const PALE: RGBColor = RGBColor(0xdd, 0xdd, 0xdd);
pub(super) const BLUE: RGBColor = RGBColor(0x00, 0x72, 0xb2);
pub(super) const SKY: RGBColor = RGBColor(0x56, 0xb4, 0xe9);
pub(super) const ORANGE: RGBColor = RGBColor(0xe6, 0x9f, 0x00);
pub(super) const VERMILION: RGBColor = RGBColor(0xd5, 0x5e, 0x00);

pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(super) type Drawn = Result<(), DrawingAreaErrorKind<std::io::Error>>;
/// A place on a figure: right, down, px.
pub(super) type Place = (f64, f64);

/// Pixels to the library's units.
pub(super) fn units(pixels: f64) -> i32 {
    (UNITS * pixels).round() as i32
}

fn place((x, y): Place) -> (i32, i32) {
    (units(x), units(y))
}

/// How a line is broken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Dash {
    Solid,
    Dashed,
    Dotted,
}

/// How a line is drawn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pen {
    pub color: RGBColor,
    /// px
    pub width: f64,
    pub dash: Dash,
}

impl Pen {
    pub fn solid(color: RGBColor, width: f64) -> Self {
        let dash = Dash::Solid;
        Self { color, width, dash }
    }

    pub fn style(&self) -> ShapeStyle {
        self.color.stroke_width(units(self.width).unsigned_abs())
    }
}

/// Forms of a mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    Circle,
    Square,
    Diamond,
}

/// Where letters lie about their place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// They begin there.
    Right,
    /// They are centered on it.
    Center,
    /// They end there.
    Left,
}

/// How letters look.
#[derive(Debug, Clone, Copy)]
pub(super) struct Letters {
    pub height: f64,
    pub color: RGBColor,
    pub bold: bool,
    pub side: Side,
    /// Whether they read upward.
    pub upward: bool,
}

impl Letters {
    pub fn new(height: f64, side: Side) -> Self {
        Self { height, color: INK, bold: false, side, upward: false }
    }

    pub fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    pub fn color(self, color: RGBColor) -> Self {
        Self { color, ..self }
    }

    /// In the library's terms.
    pub fn style(self) -> TextStyle<'static> {
        let weight = if self.bold { FontStyle::Bold } else { FontStyle::Normal };
        let mut font = FontDesc::new(FontFamily::Name(FACE), UNITS * LETTER_SCALE * self.height, weight);
        if self.upward {
            font = font.transform(FontTransform::Rotate270);
        }
        let across = match self.side {
            Side::Right => HPos::Left,
            Side::Center => HPos::Center,
            Side::Left => HPos::Right,
        };
        let style: TextStyle<'static> = font.into();
        TextStyle { color: self.color.to_backend_color(), pos: Pos::new(across, VPos::Center), ..style }
    }
}

/// Draws a figure and returns it as an SVG document that names itself to a screen reader.
pub(super) fn svg(
    name: &str,
    title: &str,
    (width, height): (f64, f64),
    draw: impl FnOnce(&Area) -> Drawn,
) -> Result<String, PresentError> {
    let mut drawn = String::new();
    let size = (units(width).unsigned_abs(), units(height).unsigned_abs());
    {
        let area = SVGBackend::with_string(&mut drawn, size).into_drawing_area();
        area.fill(&WHITE)
            .and_then(|()| draw(&area))
            .and_then(|()| area.present())
            .map_err(|error| PresentError::Drawing { figure: name.to_owned(), found: error.to_string() })?;
    }
    let body = drawn.split_once('\n').map_or("", |(_, body)| body);
    let (across, down) = size;
    let title = title.replace('&', "&amp;").replace('<', "&lt;");
    Ok(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {across} {down}\" role=\"img\">\n<title>{title}</title>\n{body}"
    ))
}

pub(super) fn line(area: &Area, points: &[Place], pen: Pen) -> Drawn {
    let points: Vec<(i32, i32)> = points.iter().copied().map(place).collect();
    let (on, off) = match pen.dash {
        Dash::Solid => return area.draw(&PathElement::new(points, pen.style())),
        Dash::Dashed => (7.0, 3.5),
        Dash::Dotted => (1.5, 2.5),
    };
    area.draw(&DashedPathElement::new(points, units(on), units(off), pen.style()))
}

pub(super) fn polygon(area: &Area, points: &[Place], fill: RGBColor) -> Drawn {
    let points: Vec<(i32, i32)> = points.iter().copied().map(place).collect();
    area.draw(&Polygon::new(points, fill.filled()))
}

pub(super) fn outline(area: &Area, points: &[Place], pen: Pen) -> Drawn {
    let mut closed = points.to_vec();
    closed.extend(points.first());
    line(area, &closed, pen)
}

pub(super) fn rectangle(area: &Area, from: Place, to: Place, fill: RGBColor) -> Drawn {
    area.draw(&Rectangle::new([place(from), place(to)], fill.filled()))
}

/// A bar of a bar chart between two opposite corners.
pub(super) fn bar(area: &Area, (left, top): Place, (right, bottom): Place, fill: RGBColor) -> Drawn {
    rectangle(area, (left, top), (right, bottom), fill)?;
    let corners = [(left, top), (right, top), (right, bottom), (left, bottom)];
    outline(area, &corners, Pen::solid(INK, 0.7))
}

/// A mark of a form, its size the radius of the circle; open when it has no fill.
pub(super) fn mark(area: &Area, at: Place, (form, size): (Form, f64), fill: Option<RGBColor>, pen: Pen) -> Drawn {
    let (x, y) = at;
    if form == Form::Circle {
        let radius = units(size);
        if let Some(fill) = fill {
            area.draw(&Circle::new(place(at), radius, fill.filled()))?;
        }
        return area.draw(&Circle::new(place(at), radius, pen.style()));
    }
    let corners = match form {
        Form::Square => [(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)].to_vec(),
        _ => [(0.0, -1.3), (1.3, 0.0), (0.0, 1.3), (-1.3, 0.0)].to_vec(),
    };
    let corners: Vec<Place> = corners.iter().map(|(dx, dy)| (x + size * dx, y + size * dy)).collect();
    if let Some(fill) = fill {
        polygon(area, &corners, fill)?;
    }
    outline(area, &corners, pen)
}

/// Part of their height by which the library sets centered letters too high.
const SET_HIGH: f64 = 0.1;

pub(super) fn write(area: &Area, text: &str, at: Place, letters: Letters) -> Drawn {
    let lower = SET_HIGH * letters.height;
    let at = if letters.upward { (at.0 + lower, at.1) } else { (at.0, at.1 + lower) };
    area.draw(&Text::new(text.to_owned(), place(at), letters.style()))
}

/// The name of a vertical axis, along the left edge.
pub(super) fn name_upright(area: &Area, text: &str, middle: f64) -> Drawn {
    let letters = Letters { upward: true, ..Letters::new(LETTERS, Side::Center) };
    write(area, text, (13.0, middle), letters)
}

/// A color between two, the second's share from 0 to 1.
pub(super) fn between(one: RGBColor, other: RGBColor, share: f64) -> RGBColor {
    let mix = |a: u8, b: u8| (f64::from(a) + share * (f64::from(b) - f64::from(a))).round() as u8;
    RGBColor(mix(one.0, other.0), mix(one.1, other.1), mix(one.2, other.2))
}
