//! The digits with which a file writes its numbers, and the rounding that these leave.

use crate::sparse::HalfUnit;

/// Digits from which on numbers come from a program: shorter ones are somebody's own and exact.
const PRINTED: usize = 5;

/// Digits of all numbers of a file.
#[derive(Debug, Clone, Copy, Default)]
pub struct Digits {
    /// Most significant digits of a number, with the zeros that end a fraction.
    written: usize,
    /// Most of them without the zeros at the end.
    needed: usize,
    /// Decimals of the numbers so far, if they are alike and none has an exponent; none before the first.
    decimals: Option<Option<usize>>,
}

impl Digits {
    /// Counts the digits of one more number, in any way that NASTRAN or C write it.
    pub fn add(&mut self, number: &str) {
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
        let decimals = mantissa.split_once('.').map_or(0, |(_, own)| own.len());
        let own = Some(decimals).filter(|_| end.is_none());
        self.decimals = Some(own.filter(|_| self.decimals.is_none_or(|before| before == own)));
    }

    /// Half the unit of the last written place: of numbers with as many decimals each, integers among them, that of the last decimal; of
    /// others, with $n$ digits, a part of each number,
    ///
    /// $$ u = \frac{1}{2} \cdot 10^{1 - n} . $$
    ///
    /// Numbers shorter than a program prints them are exact.
    pub fn half_unit(&self) -> HalfUnit {
        match self.decimals.flatten() {
            _ if self.needed < PRINTED => HalfUnit::of_each(0.0),
            Some(decimals) => HalfUnit::of_all(0.5 * 10_f64.powf(-(decimals as f64))),
            None => HalfUnit::of_each(0.5 * 10_f64.powf(1.0 - self.written as f64)),
        }
    }
}
