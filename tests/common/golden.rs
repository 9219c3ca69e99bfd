//! Snapshots compared number by number, so that another machine's last digit does not fail them.

use crate::prelude::*;
use insta::Snapshot;
use insta::comparator::Comparator;
use insta::internals::SnapshotContents;

/// How far numbers may be apart. Everything else must be the same to the letter: words, blanks, rules, and whole numbers.
#[derive(Debug, Clone, Copy)]
pub struct Numbers {
    /// Relative difference allowed.
    pub relative: f64,
    /// Absolute difference allowed, for numbers that are differences themselves.
    pub absolute: f64,
    /// Whether one unit of the last decimal written is allowed too: for places in a drawing.
    pub last_digit: bool,
    /// Whether tables of numbers are compared by the unit of each row instead.
    pub by_unit: bool,
    /// Whether whole numbers may differ too: for counts of what chance decides.
    pub whole: bool,
}

impl Numbers {
    /// Those that a reader sees: to the last digit written, as far as [`GOLDEN_AS_WRITTEN`] tells them apart.
    pub const AS_WRITTEN: Self = Self {
        relative: GOLDEN_AS_WRITTEN,
        absolute: 0.0,
        last_digit: false,
        by_unit: false,
        whole: false,
    };

    /// Places in a drawing, to a tenth of a pixel.
    pub const DRAWN: Self = Self {
        last_digit: true,
        ..Self::AS_WRITTEN
    };

    /// Tables of numbers: each by its unit.
    pub const BY_UNIT: Self = Self {
        by_unit: true,
        ..Self::AS_WRITTEN
    };

    /// Whether two texts agree.
    pub fn agree(&self, one: &str, other: &str) -> bool {
        let (lines, others) = (lines(one), lines(other));
        lines.len() == others.len()
            && lines.iter().zip(others).all(|(a, b)| {
                let numbers = if self.by_unit { Self::of_row(a) } else { *self };
                numbers.same_line(a, b)
            })
    }

    /// The rule for a row `table,row,column,unit,computed,published`.
    fn of_row(row: &str) -> Self {
        // The unit and the numbers are the last three cells; names before them may hold commas.
        let unit = row.rsplit(',').nth(2).unwrap_or_default();
        let (relative, absolute) = match unit {
            "Hz" => (GOLDEN_FREQUENCY, 0.0),
            "in" | "in²" => (GOLDEN_GAGE, 0.0),
            "%" => (0.0, GOLDEN_PERCENT),
            _ => {
                return Self {
                    relative: GOLDEN_RELATIVE,
                    ..Self::AS_WRITTEN
                };
            }
        };
        Self {
            relative,
            absolute,
            whole: true,
            ..Self::AS_WRITTEN
        }
    }

    fn same_line(&self, one: &str, other: &str) -> bool {
        let (one, other) = (tokens(one), tokens(other));
        one.len() == other.len() && one.iter().zip(&other).all(|(a, b)| self.same_token(a, b))
    }

    fn same_token(&self, a: &str, b: &str) -> bool {
        // Digits of a color may be a number beyond all, which no difference tells from itself.
        if a == b {
            return true;
        }
        let is_whole = |token: &str| !token.contains(['.', 'e', 'E']);
        let (Some(x), Some(y)) = (number(a), number(b)) else {
            return a == b;
        };
        if !self.whole && is_whole(a) && is_whole(b) {
            return a == b;
        }
        let decimal = if self.last_digit {
            last_unit(a).max(last_unit(b))
        } else {
            0.0
        };
        let allowed = self.relative * x.abs().max(y.abs()) + self.absolute + 1.001 * decimal;
        (x - y).abs() <= allowed
    }
}

/// The lines of a text, without blanks at its ends.
fn lines(text: &str) -> Vec<&str> {
    text.trim_end().lines().map(str::trim_end).collect()
}

impl Comparator for Numbers {
    fn matches(&self, reference: &Snapshot, test: &Snapshot) -> bool {
        match (reference.contents(), test.contents()) {
            (SnapshotContents::Text(a), SnapshotContents::Text(b)) => {
                self.agree(&a.to_string(), &b.to_string())
            }
            _ => false,
        }
    }

    fn dyn_clone(&self) -> Box<dyn Comparator> {
        Box::new(*self)
    }
}

/// Asserts a golden in `golden/snapshots/`.
pub fn assert_golden(name: &str, text: &str, numbers: Numbers) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../golden/snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.set_comparator(Box::new(numbers));
    settings.bind(|| insta::assert_snapshot!(name, text));
}

/// Asserts the golden of a table: as a reader sees it, with the paper's numbers below, and behind it every number with ten digits.
pub fn assert_table(table: &Table) {
    let one = from_ref(table);
    let golden = format!("{}\n{}", text(one), csv(one));
    assert_golden(&table.name, &golden, Numbers::BY_UNIT);
}

/// What stands in a file that the tests make; `CORFEM_WRITE=1` writes it anew.
pub fn on_file(path: &str, new: &str) -> String {
    let path = in_root(path);
    if std::env::var("CORFEM_WRITE").is_ok_and(|value| value == "1") {
        fs::write(&path, new).unwrap();
    }
    fs::read_to_string(path).unwrap()
}

/// Splits a text into numbers and the single characters between them.
fn tokens(text: &str) -> Vec<String> {
    let mut tokens: Vec<String> = Vec::new();
    let characters = text.chars().collect_vec();
    let mut at = 0;
    while at < characters.len() {
        let end = number_end(&characters, at).max(at + 1);
        tokens.push(characters[at..end].iter().collect());
        at = end;
    }
    tokens
}

/// End of the number that starts at `start`, or `start` if none does.
fn number_end(characters: &[char], start: usize) -> usize {
    let digit = |i: usize| characters.get(i).is_some_and(char::is_ascii_digit);
    let mut at = start;
    if characters.get(at) == Some(&'-') {
        at += 1;
    }
    if !digit(at) {
        return start;
    }
    while digit(at) {
        at += 1;
    }
    if characters.get(at) == Some(&'.') && digit(at + 1) {
        at += 1;
        while digit(at) {
            at += 1;
        }
    }
    if matches!(characters.get(at), Some('e' | 'E')) {
        let sign = usize::from(matches!(characters.get(at + 1), Some('-' | '+')));
        if digit(at + 1 + sign) {
            at += 1 + sign;
            while digit(at) {
                at += 1;
            }
        }
    }
    at
}

fn number(token: &str) -> Option<f64> {
    token
        .chars()
        .any(|c| c.is_ascii_digit())
        .then(|| token.parse().ok())?
}

/// One unit of the last decimal that a number is written with; zero for one without decimals.
fn last_unit(token: &str) -> f64 {
    match token.split_once('.') {
        Some((_, decimals)) => 10f64.powi(-(decimals.len() as i32)),
        None => 0.0,
    }
}
