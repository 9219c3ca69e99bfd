//! Files of other programs: bytes to data and back.

mod axes;
pub mod deck;
#[doc(hidden)]
pub mod disk;
pub mod error;
pub mod matrices;
pub mod test_data;
pub(crate) mod text;

use std::io::{Error, ErrorKind};
use std::path::Path;

/// Size in bytes of the longest file that is read, 2 GiB: enough for a matrix of sixty million entries. The text and the data read
/// from it take some three times as much memory.
pub const MOST_BYTES: u64 = 1 << 31;

/// The bytes of a regular file of at most [`MOST_BYTES`]. Anything else, such as a device or a pipe, is refused before it is
/// opened.
///
/// # Errors
/// The operating system's error; `InvalidInput` for anything but a regular file, `FileTooLarge` for a longer one.
#[doc(hidden)]
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, Error> {
    let found = path.metadata()?;
    if !found.is_file() {
        let reason = if found.is_dir() {
            "it is a folder; name a file in it"
        } else {
            "it is not a regular file; copy what it gives into one"
        };
        return Err(Error::new(ErrorKind::InvalidInput, reason));
    }
    if found.len() > MOST_BYTES {
        let reason = format!("it is longer than {MOST_BYTES} bytes, the most that corfem reads");
        return Err(Error::new(ErrorKind::FileTooLarge, reason));
    }
    std::fs::read(path)
}

/// A text with control characters other than line ends and tabs escaped, because a terminal would obey them.
#[doc(hidden)]
pub fn escaped(text: &str) -> String {
    escape(text, |c| is_obeyed(c) && c != '\n' && c != '\t')
}

/// True of a character that is obeyed and not shown: a control character, or one that turns the direction of what follows.
fn is_obeyed(c: char) -> bool {
    c.is_control() || turns(c)
}

/// True of a character that says in which direction text is read: letters behind it may stand before others.
pub(crate) fn turns(c: char) -> bool {
    matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// A text on one line: line ends and tabs are escaped too, because they would break out of a table's row.
#[doc(hidden)]
pub fn one_line(text: &str) -> String {
    escape(text, is_obeyed)
}

/// A text on one line that a spreadsheet shows as text: a leading apostrophe keeps it from reading a formula. Numbers stay numbers.
pub(crate) fn inert(text: &str) -> String {
    let is_formula = text.starts_with(['=', '+', '-', '@']) && text.parse::<f64>().is_err();
    if is_formula { "'" } else { "" }.to_owned() + &one_line(text)
}

fn escape(text: &str, is_shown: impl Fn(char) -> bool) -> String {
    let own = |c: char| match is_shown(c) {
        true => c.escape_default().to_string(),
        false => c.into(),
    };
    text.chars().map(own).collect()
}
