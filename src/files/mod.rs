//! Files of other programs: bytes to data and back.

pub mod deck;
pub mod error;
pub mod matrices;
pub mod nastran95;
pub mod test_data;

/// A text with control characters other than line ends and tabs escaped, because a terminal would obey them.
pub fn escaped(text: &str) -> String {
    let shown = |c: char| c.is_control() && c != '\n' && c != '\t';
    text.chars()
        .map(|c| {
            if shown(c) {
                c.escape_default().to_string()
            } else {
                c.to_string()
            }
        })
        .collect()
}
