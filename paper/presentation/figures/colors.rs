//! Colors, and letters that can be read on them.

use plotters::style::{BLACK, RGBColor, WHITE};

// The colors of Okabe and Ito, which people with any common color blindness tell apart. Figures never rely on color
// alone: lines differ in dashes, marks in form, cells carry their numbers.
pub const INK: RGBColor = RGBColor(0x22, 0x22, 0x22);
pub const GRAY: RGBColor = RGBColor(0x8a, 0x8a, 0x8a);
pub const SILVER: RGBColor = RGBColor(0xb4, 0xb4, 0xb4);
pub const PALE: RGBColor = RGBColor(0xdd, 0xdd, 0xdd);
pub const BLUE: RGBColor = RGBColor(0x00, 0x72, 0xb2);
pub const SKY: RGBColor = RGBColor(0x56, 0xb4, 0xe9);
pub const ORANGE: RGBColor = RGBColor(0xe6, 0x9f, 0x00);
pub const VERMILION: RGBColor = RGBColor(0xd5, 0x5e, 0x00);

/// The color for letters that has a contrast of at least 4.5 to 1 on a fill (WCAG 2.2, relative luminance).
pub fn legible_on(fill: RGBColor) -> RGBColor {
    let linear = |value: u8| {
        let value = f64::from(value) / 255.0;
        if value <= 0.04045 {
            value / 12.92
        } else {
            ((value + 0.055) / 1.055).powf(2.4)
        }
    };
    let luminance =
        |RGBColor(r, g, b): RGBColor| 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
    let contrast = |ink: RGBColor| {
        let (one, other) = (luminance(ink) + 0.05, luminance(fill) + 0.05);
        one.max(other) / one.min(other)
    };
    // One of black and white always has it; ink is softer.
    [INK, WHITE]
        .into_iter()
        .find(|&ink| contrast(ink) >= 4.5)
        .unwrap_or(BLACK)
}

/// A color between two, the second's share from 0 to 1.
pub fn between(one: RGBColor, other: RGBColor, share: f64) -> RGBColor {
    let mix = |a: u8, b: u8| (f64::from(a) + share * (f64::from(b) - f64::from(a))).round() as u8;
    RGBColor(
        mix(one.0, other.0),
        mix(one.1, other.1),
        mix(one.2, other.2),
    )
}
