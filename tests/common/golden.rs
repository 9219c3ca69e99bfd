//! Snapshots compared number by number, so that another machine's last digit does not fail them.

use insta::Snapshot;
use insta::comparator::Comparator;
use insta::internals::SnapshotContents;

/// How far numbers may be apart; all text around them must be the same.
#[derive(Debug, Clone, Copy)]
pub struct Numbers {
    /// Relative difference allowed.
    pub relative: f64,
    /// Absolute difference allowed, for numbers that are differences themselves.
    pub absolute: f64,
    /// Whether one unit of the last digit written is allowed too: for numbers rounded for a reader.
    pub last_digit: bool,
}

impl Numbers {
    /// Those a reader sees, a tenth of a pixel of a drawing among them: each to the last digit written.
    pub const AS_WRITTEN: Self = Self {
        relative: 0.0,
        absolute: 0.0,
        last_digit: true,
    };

    /// Whether two texts agree.
    pub fn agree(&self, one: &str, other: &str) -> bool {
        let (one, other) = (tokens(one), tokens(other));
        one.len() == other.len()
            && one
                .iter()
                .zip(&other)
                .all(|(a, b)| match (number(a), number(b)) {
                    (Some(x), Some(y)) => {
                        let unit = if self.last_digit {
                            1.001 * last_unit(a).max(last_unit(b))
                        } else {
                            0.0
                        };
                        let allowed = self.relative * x.abs().max(y.abs()) + self.absolute + unit;
                        (x - y).abs() <= allowed
                    }
                    (None, None) => a == b,
                    _ => false,
                })
    }
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

/// Splits a text into numbers and the runs of other characters between them. Runs of blanks and of rules count as
/// one: they are as long as the numbers are wide.
fn tokens(text: &str) -> Vec<String> {
    let mut tokens: Vec<String> = Vec::new();
    let characters: Vec<char> = text.chars().collect();
    let mut at = 0;
    while at < characters.len() {
        let end = number_end(&characters, at);
        if end > at {
            tokens.push(characters[at..end].iter().collect());
            at = end;
            continue;
        }
        let character = characters[at];
        let same_run = matches!(character, ' ' | '─')
            && tokens.last().is_some_and(|last| last.ends_with(character));
        if !same_run {
            tokens.push(character.to_string());
        }
        at += 1;
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

/// One unit of the last digit a number is written with.
fn last_unit(token: &str) -> f64 {
    match token.split_once('.') {
        Some((_, decimals)) => 10f64.powi(-(decimals.len() as i32)),
        None => 1.0,
    }
}

#[test]
fn golden_comparison_forgives_the_last_digit_and_nothing_else() {
    let numbers = Numbers {
        relative: 1e-6,
        absolute: 0.0,
        last_digit: false,
    };
    assert!(numbers.agree("f 10.0000001 Hz", "f 10.0 Hz"));
    assert!(!numbers.agree("f 10.0001 Hz", "f 10.0 Hz"));
    assert!(!numbers.agree("f 10.0 Hz", "g 10.0 Hz"));
    assert!(!numbers.agree("f 10.0 Hz", "f 10.0 Hz 3"));
    assert!(!numbers.agree("f 1e-3", "f 1e-4"));
    assert!(!numbers.agree("f -1.0", "f 1.0"));
    assert!(
        numbers.agree("a    1.0", "a  1.0"),
        "column widths follow the numbers"
    );
    let rounded = Numbers {
        last_digit: true,
        ..numbers
    };
    assert!(rounded.agree("10.60 (10.66)", "10.61 (10.66)"));
    assert!(!rounded.agree("10.60 (10.66)", "10.62 (10.66)"));
}
