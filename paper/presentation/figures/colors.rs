//! Colors on light and on dark pages, and letters that can be read on them.

use plotters::style::{BLACK, RGBColor, WHITE};
use std::collections::BTreeMap;

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

/// Page and letters in the dark, those of the pages' style sheet.
const NIGHT: RGBColor = RGBColor(0x17, 0x17, 0x17);
const PENCIL: RGBColor = RGBColor(0xe4, 0xe4, 0xe4);
/// A color on a white page, and on a dark one as a fill and as a line or letter. Fills are dark enough for light letters to have a
/// contrast of 4.5 to 1 on them, and light enough to have one of 3 to 1 on the page; lines and letters have 4.5 there.
const IN_THE_DARK: [[RGBColor; 3]; 10] = [
    // White letters stand on cells, whose letters are light in the dark.
    [WHITE, NIGHT, PENCIL],
    [BLACK, PENCIL, PENCIL],
    [INK, PENCIL, PENCIL],
    [GRAY, RGBColor(0x68, 0x68, 0x68), RGBColor(0x8c, 0x8c, 0x8c)],
    [
        SILVER,
        RGBColor(0x50, 0x50, 0x50),
        RGBColor(0x80, 0x80, 0x80),
    ],
    [PALE, RGBColor(0x30, 0x30, 0x30), RGBColor(0x44, 0x44, 0x44)],
    [BLUE, RGBColor(0x2a, 0x6a, 0x96), RGBColor(0x6c, 0xb8, 0xea)],
    [SKY, RGBColor(0x18, 0x6a, 0x8c), RGBColor(0x3d, 0x9c, 0xd0)],
    [
        ORANGE,
        RGBColor(0x85, 0x5e, 0x00),
        RGBColor(0xe6, 0xa6, 0x2e),
    ],
    [
        VERMILION,
        RGBColor(0xa5, 0x4a, 0x14),
        RGBColor(0xf0, 0x8a, 0x4b),
    ],
];
/// Tints of a color.
const TINTS: u8 = 20;

/// White with a share of a color from 0 to 1, rounded to one of its tints.
pub fn tint(color: RGBColor, share: f64) -> RGBColor {
    let tints = f64::from(TINTS);
    between(WHITE, color, (tints * share).round() / tints)
}

/// Blue for what is positive and red for what is negative, one in magnitude in the full color.
pub fn toned(value: f64) -> RGBColor {
    let full = if value < 0.0 { VERMILION } else { BLUE };
    tint(full, value.abs().min(1.0))
}

/// A color as SVG has it.
pub fn hex(RGBColor(red, green, blue): RGBColor) -> String {
    format!("#{red:02X}{green:02X}{blue:02X}")
}

/// A drawing with a style for dark screens, where a tint is as far from the page toward a color's partner as it is from white toward
/// the color.
pub fn with_dark(svg: &str) -> String {
    let mut rules = BTreeMap::new();
    for [light, fill, line] in IN_THE_DARK {
        for share in (1..=TINTS).map(|tint| f64::from(tint) / f64::from(TINTS)) {
            let digits = hex(tint(light, share));
            // Letters are lines; the lines of cells close the gaps between them.
            for (tag, attribute, dark) in [
                ("", "fill", fill),
                ("", "stroke", line),
                ("text", "fill", line),
                ("path", "stroke", fill),
            ] {
                let drawn = format!("{attribute}=\"{digits}\"");
                if svg.contains(&drawn) {
                    let dark = hex(between(NIGHT, dark, share));
                    rules.insert(format!(".drawn {tag}[{drawn}]"), (attribute, dark));
                }
            }
        }
    }
    let rules: String = rules
        .into_iter()
        .map(|(what, (attribute, dark))| format!("{what}{{{attribute}:{dark}}}\n"))
        .collect();
    let style = "<style>@media screen and (prefers-color-scheme: dark) {";
    svg.replacen(
        "</title>\n",
        &format!("</title>\n{style}\n{rules}}}</style>\n"),
        1,
    )
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
