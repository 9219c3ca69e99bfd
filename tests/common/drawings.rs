//! What is written on a figure, read back from its SVG.

/// Letters on a figure, with the box they fill: 0.6 em a letter, as wide as digits and most words are in any of the faces asked for.
#[derive(Debug, Clone)]
pub struct Written {
    /// The words.
    pub text: String,
    /// Left, top, right, bottom, px.
    pub bounds: [f64; 4],
    /// Height of an em, px.
    pub em: f64,
}

/// Width and height of a figure, px.
pub fn size(svg: &str) -> (f64, f64) {
    (attribute(svg, "width"), attribute(svg, "height"))
}

/// Everything written on a figure.
pub fn written(svg: &str) -> Vec<Written> {
    svg.split("<text ").skip(1).map(one).collect()
}

fn one(element: &str) -> Written {
    const UNITS: f64 = 10.0;
    let (tag, rest) = element.split_once('>').unwrap();
    let entities = [
        ("&lt;", "<"),
        ("&gt;", ">"),
        ("&quot;", "\""),
        ("&apos;", "'"),
        ("&amp;", "&"),
    ];
    let text = rest.split("</text>").next().unwrap().trim();
    let text = entities
        .iter()
        .fold(text.to_owned(), |text, (entity, letter)| {
            text.replace(entity, letter)
        });
    let em = attribute(tag, "font-size") / UNITS;
    let (x, y) = (attribute(tag, "x") / UNITS, attribute(tag, "y") / UNITS);
    let width = 0.6 * em * text.chars().count() as f64;
    let before = match value(tag, "text-anchor") {
        "start" => 0.0,
        "middle" => 0.5 * width,
        _ => width,
    };
    // From its base line a digit or capital rises 0.72 em.
    let base = em
        * match value(tag, "dy") {
            "0.76em" => 0.76,
            "0.5ex" => 0.26,
            _ => -0.26,
        };
    let (high, low) = (base - 0.72 * em, base);
    let bounds = if tag.contains("rotate(270") {
        [x + high, y + before - width, x + low, y + before]
    } else {
        [x - before, y + high, x - before + width, y + low]
    };
    Written { text, bounds, em }
}

/// The value of an attribute of a tag.
pub fn value<'a>(tag: &'a str, name: &str) -> &'a str {
    let start = format!(" {name}=\"");
    let at = match tag.find(&start) {
        Some(at) => at + start.len(),
        // The first attribute of a tag has no blank before it once the tag's name is cut off.
        None if tag.starts_with(&start[1..]) => start.len() - 1,
        None => panic!("no {name} in {tag}"),
    };
    tag[at..].split('"').next().unwrap()
}

/// A number that a tag has by name.
pub fn attribute(tag: &str, name: &str) -> f64 {
    value(tag, name).parse().unwrap()
}

/// Red, green and blue of a color such as `#0072B2` or `#fff`.
pub fn color(digits: &str) -> [f64; 3] {
    let digits = digits.trim_start_matches('#');
    let long = match digits.len() {
        3 => digits.chars().flat_map(|digit| [digit; 2]).collect(),
        _ => digits.to_owned(),
    };
    [0, 2, 4].map(|at| u8::from_str_radix(&long[at..at + 2], 16).unwrap().into())
}

/// Contrast of two colors, by their relative luminance (WCAG 2.2).
pub fn contrast(one: [f64; 3], other: [f64; 3]) -> f64 {
    let [one, other] = [one, other].map(|color| {
        let linear = color.map(|part| match part / 255.0 {
            part if part <= 0.04045 => part / 12.92,
            part => ((part + 0.055) / 1.055).powf(2.4),
        });
        0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2] + 0.05
    });
    one.max(other) / one.min(other)
}
