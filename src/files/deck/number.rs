//! Real numbers as NASTRAN writes them: `1.+7`, `-.5-3`, `.010`, `2.5E-3`, `1.0D+4`.

/// Width of a field of the small format, in characters.
pub const SMALL_FIELD: usize = 8;
/// Width of a field of the large format, in characters.
pub const LARGE_FIELD: usize = 16;
/// Part of itself by which a number that was changed may be rounded, so that it stays in a field of eight characters: a thousandth of
/// what the best tests tell of a size.
const WRITTEN: f64 = 1e-6;
/// Significant digits that always suffice to tell two numbers apart.
const ALL_DIGITS: usize = 17;

/// The value of a NASTRAN real, or `None` for anything else.
///
/// Only its decimal point tells a real from an integer. An exponent begins with `E`, `D` or its sign alone. Blanks
/// count for nothing, so that `10.4  +6` is $1.04 \cdot 10^7$.
pub fn parse_real(text: &str) -> Option<f64> {
    let text: String = text.chars().filter(|c| *c != ' ').collect();
    let unsigned = text.strip_prefix(['+', '-']).unwrap_or(&text);
    let mantissa_end = unsigned
        .find(|c: char| !c.is_ascii_digit() && c != '.')
        .unwrap_or(unsigned.len());
    let (mantissa, exponent) = unsigned.split_at(mantissa_end);
    let (whole, fraction) = mantissa.split_once('.')?;
    let exponent = if exponent.is_empty() { "0" } else { exponent };
    let exponent = exponent
        .strip_prefix(['E', 'D', 'e', 'd'])
        .unwrap_or(exponent);
    // Rust's own parser finds what is wrong with the digits on either side.
    let sign = if text.starts_with('-') { "-" } else { "" };
    let value: f64 = format!("{sign}{whole}.{fraction}e{exponent}")
        .parse()
        .ok()?;
    value.is_finite().then_some(value)
}

/// Largest number of a model or a test: its square is a number as well.
pub(crate) const LARGEST: f64 = 1e150;

/// A finite number without blanks, as Fortran, NASTRAN or a spreadsheet writes it, with a point or without.
pub(crate) fn real(text: &str) -> Option<f64> {
    let value = || text.replace(['d', 'D'], "e").parse().ok();
    let value = || value().filter(|value: &f64| value.is_finite());
    parse_real(text)
        .or_else(value)
        .filter(|_| !text.contains(' '))
}

/// The reals of a line in columns of one width, or `None` unless each of them holds one; the last may be narrower.
pub fn parse_reals(line: &str, width: usize) -> Option<Vec<f64>> {
    line.as_bytes()
        .chunks(width)
        .map(|column| parse_real(std::str::from_utf8(column).ok()?.trim()))
        .collect()
}

/// The shortest NASTRAN real that reads back as exactly `value`, if it has at most `width` characters.
pub fn exact_real(value: f64, width: usize) -> Option<String> {
    let text = layout(&format!("{value:e}"))?;
    (text.len() <= width).then_some(text)
}

/// A NASTRAN real of at most 16 characters: exact where that suffices, otherwise the nearest that fits.
///
/// At least ten significant digits are kept, and twelve or more of a number between $10^{-9}$ and $10^9$. A number
/// that was read from such a field is always written exactly. A value that is not finite has no such form: `None`.
pub fn large_real(value: f64) -> Option<String> {
    nearest_real(value, LARGE_FIELD)
}

/// The shortest NASTRAN real of at most `width` characters that is exact, or else the nearest that fits.
fn nearest_real(value: f64, width: usize) -> Option<String> {
    exact_real(value, width).or_else(|| {
        (1..ALL_DIGITS)
            .rev()
            .filter_map(|digits| layout(&format!("{value:.*e}", digits - 1)))
            .find(|text| text.len() <= width)
    })
}

/// The nearest NASTRAN real of at most 8 characters, or, where that is farther off than a millionth, of at most 16.
///
/// A value that is not finite has no such form and is given as it is.
pub fn written_real(value: f64) -> String {
    let is_near = |text: &String| {
        parse_real(text).is_some_and(|own| (own - value).abs() <= WRITTEN * value.abs())
    };
    nearest_real(value, SMALL_FIELD)
        .filter(is_near)
        .or_else(|| large_real(value))
        .unwrap_or_else(|| value.to_string())
}

/// The nearest number that a 16-character field can hold; `value` itself if there is none.
pub fn nearest_in_field(value: f64) -> f64 {
    large_real(value)
        .and_then(|text| parse_real(&text))
        .unwrap_or(value)
}

/// The shortest NASTRAN form of a number given as `d.ddde±x`, plain where that is no longer than with an exponent.
fn layout(scientific: &str) -> Option<String> {
    let (mantissa, exponent) = scientific.split_once('e')?;
    let sign = if mantissa.starts_with('-') { "-" } else { "" };
    let digits: String = mantissa.chars().filter(char::is_ascii_digit).collect();
    let digits = digits.trim_end_matches('0');
    if digits.is_empty() {
        return Some(format!("{sign}0."));
    }
    // The number is 0.digits times ten to this power.
    let power = exponent.parse::<i32>().ok()? + 1;
    let count = digits.len() as i32;
    let plain = if power <= 0 {
        format!(".{}{digits}", "0".repeat(power.unsigned_abs() as usize))
    } else if power >= count {
        format!("{digits}{}.", "0".repeat((power - count) as usize))
    } else {
        let (whole, fraction) = digits.split_at(power as usize);
        format!("{whole}.{fraction}")
    };
    // A reader expects the point after the first digit; another place may save a digit of the exponent.
    let with_exponent = (1..=count).chain([0]).map(|point| {
        let (whole, fraction) = digits.split_at(point as usize);
        format!("{whole}.{fraction}{:+}", power - point)
    });
    std::iter::once(plain)
        .chain(with_exponent)
        .min_by_key(String::len)
        .map(|text| format!("{sign}{text}"))
}
