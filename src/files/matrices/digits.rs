//! The digits with which a file writes its numbers, and the rounding that these leave.

/// Digits from which on numbers come from a program: shorter ones are somebody's own and exact.
const PRINTED: usize = 5;

/// Digits of all numbers of a file.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Digits {
    /// Most significant digits of a number, with the zeros that end a fraction.
    written: usize,
    /// Most of them without the zeros at the end.
    needed: usize,
    /// True once a number has a point or an exponent.
    is_real: bool,
}

impl Digits {
    /// Counts the digits of one more number, in any way that NASTRAN or C write it.
    pub(crate) fn add(&mut self, number: &str) {
        let unsigned = number.trim().trim_start_matches(['+', '-']);
        let end = unsigned.find(|c: char| !c.is_ascii_digit() && c != '.');
        let mantissa = &unsigned[..end.unwrap_or(unsigned.len())];
        let digits = mantissa.replace('.', "");
        let digits = digits.trim_start_matches('0');
        let needed = digits.trim_end_matches('0').len();
        let has_point = mantissa.contains('.');
        self.written = self
            .written
            .max(if has_point { digits.len() } else { needed });
        self.needed = self.needed.max(needed);
        self.is_real |= has_point || end.is_some();
    }

    /// The largest part of a number by which it was rounded when it was written: half a unit of the last of $n$ digits,
    ///
    /// $$ u = \frac{1}{2} \cdot 10^{1 - n} , $$
    ///
    /// and nothing where all numbers are integers or shorter than a program prints them.
    pub(crate) fn rounding(&self) -> f64 {
        if self.is_real && self.needed >= PRINTED {
            0.5 * 10_f64.powf(1.0 - self.written as f64)
        } else {
            0.0
        }
    }
}
