//! From the bytes of a file to its text.

use super::error::FileError;
use std::borrow::Cow;

/// The byte order mark of UTF-8.
const MARK: &[u8] = "\u{feff}".as_bytes();

/// The text of a file in UTF-8, with or without a byte order mark, in UTF-16 with one, or else in Latin-1. Lines that a carriage return
/// alone ends, as in old files, end by a line feed.
pub(crate) fn decoded(bytes: &[u8]) -> Cow<'_, str> {
    let text = in_characters(bytes);
    if text.contains('\n') {
        text
    } else {
        text.replace('\r', "\n").into()
    }
}

fn in_characters(bytes: &[u8]) -> Cow<'_, str> {
    let wide = |order: fn([u8; 2]) -> u16| {
        let units = bytes[2..]
            .chunks_exact(2)
            .map(|two| order([two[0], two[1]]));
        let text = char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER));
        Cow::from(text.collect::<String>())
    };
    match bytes {
        [0xff, 0xfe, ..] => return wide(u16::from_le_bytes),
        [0xfe, 0xff, ..] => return wide(u16::from_be_bytes),
        _ => {}
    }
    let bytes = bytes.strip_prefix(MARK).unwrap_or(bytes);
    let latin_1 = || {
        bytes
            .iter()
            .map(|&byte| char::from(byte))
            .collect::<String>()
    };
    std::str::from_utf8(bytes).map_or_else(|_| latin_1().into(), Cow::from)
}

/// A text in the encoding and with the ends of lines of a file from which it was [`decoded`].
pub(crate) fn encoded(text: String, file: &[u8]) -> Vec<u8> {
    let text = if file.contains(&b'\n') {
        text
    } else {
        text.replace('\n', "\r")
    };
    let mark = if file.starts_with(MARK) { MARK } else { b"" };
    // Text that is not in UTF-8 was read as Latin-1, which has no character above 255.
    let bytes = match std::str::from_utf8(file) {
        Ok(_) => text.into_bytes(),
        Err(_) => text.chars().map(|c| u32::from(c) as u8).collect(),
    };
    [mark, &bytes].concat()
}

/// The text of a file, as by [`decoded`], unless its first bytes say that it is compressed or its bytes that it is binary.
///
/// # Errors
/// [`FileError::Refused`] naming the file and what it is.
pub(crate) fn readable<'a>(name: &str, bytes: &'a [u8]) -> Result<Cow<'a, str>, FileError> {
    let what = match bytes {
        [0x1f, 0x8b, ..] => Some("is compressed by gzip; unpack it first"),
        [b'P', b'K', 3, 4, ..] => {
            Some("is an archive, such as zip or npz; unpack it or write text")
        }
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => None,
        _ if bytes.contains(&0) => Some("is binary; let the program that made it write text"),
        _ => None,
    };
    what.map_or_else(
        || Ok(decoded(bytes)),
        |what| Err(FileError::refused(name, what)),
    )
}
