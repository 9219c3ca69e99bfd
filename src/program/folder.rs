//! Files in a folder, each of which names the run that wrote it.
//!
//! Each file is replaced by itself: after a stop some may be of the new run and others of the one before. Other files
//! and folders are not touched.

use corfem::files::disk::{make_folder, metadata, probe, read_dir, replace, replaceable};
use corfem::files::error::FileError;
use corfem::present::PresentError;
use std::io::{Error, ErrorKind};
use std::path::Path;

/// Files that a command replaces in its folder: names, or endings where they begin with a dot.
const REPLACED: [(&str, &[&str]); 4] = [
    (
        "correlate",
        &[
            "report.html",
            "factors.csv",
            "shapes.csv",
            "shapes.unv",
            "residuals.csv",
            "correlation.json",
            "corrected.bdf",
        ],
    ),
    ("report", &["report.html"]),
    ("figures", &[".svg"]),
    ("dump", &["dump.json", ".mtx"]),
];

/// Refuses a folder that the files of a command could not be written into, before there are any files.
pub fn check_folder(folder: &Path, command: &str) -> Result<(), PresentError> {
    let check = || match metadata(folder) {
        _ if folder.as_os_str() == "-" => Err(Error::new(
            ErrorKind::InvalidInput,
            "standard output is not a folder",
        )),
        Ok(_) => probe(folder),
        Err(_) if folder.is_symlink() => Err(Error::new(
            ErrorKind::InvalidInput,
            "it is a link to a place that does not exist",
        )),
        // Such as an empty name, or the parent of a folder that does not exist.
        Err(error) if folder.file_name().is_none() => Err(error),
        Err(_) => probe(folder.parent().unwrap_or(folder)),
    };
    check().map_err(FileError::of_file(folder, "write"))?;
    let of_command = REPLACED.iter().filter(|(of, _)| *of == command);
    let replaced: Vec<&str> = of_command.flat_map(|(_, names)| *names).copied().collect();
    let is_replaced = |name: &str| {
        let is_of = |end: &&str| name == *end || end.starts_with('.') && name.ends_with(end);
        replaced.iter().any(is_of)
    };
    // A folder that is new or may not be listed holds no known file.
    for entry in read_dir(folder).into_iter().flatten().flatten() {
        if entry.file_name().to_str().is_some_and(is_replaced) {
            let path = entry.path();
            replaceable(&path).map_err(FileError::of_file(&path, "write"))?;
        }
    }
    Ok(())
}

/// Writes the files of a run, by name and text, into a folder, made if it is new. `run` is the command with its inputs, without the
/// time: the same run writes the same bytes.
pub fn write_files(
    folder: &Path,
    files: &[(String, Vec<u8>)],
    run: &str,
) -> Result<(), PresentError> {
    if !folder.is_dir() {
        make_folder(folder).map_err(FileError::of_file(folder, "write"))?;
    }
    for (name, bytes) in files {
        let path = folder.join(name);
        replace(&path, &signed(&path, bytes, run)).map_err(FileError::of_file(&path, "write"))?;
    }
    Ok(())
}

/// Characters of a comment in a deck, which has 72 columns before those that some programs leave out.
const DECK_COLUMNS: usize = 70;

/// The file with the name of its run, where its format has a place for it. Behind that of a corrected deck every byte but its corrected
/// numbers stays.
fn signed(path: &Path, bytes: &[u8], run: &str) -> Vec<u8> {
    let run = format!("corfem {} {run}", env!("CARGO_PKG_VERSION")).replace('\n', " ");
    let kind = path.extension().and_then(|kind| kind.to_str());
    let (place, line) = match kind {
        // Two hyphens would end the comment.
        Some("svg" | "html") => (
            bytes.len(),
            format!("<!-- {} -->\n", run.replace("--", "- -")),
        ),
        Some("csv") => (0, format!("# {run}\n")),
        Some("unv") => (
            0,
            format!("    -1\n   151\n{run}\n{}    -1\n", "NONE\n".repeat(6)),
        ),
        Some("json") => (
            after_line(bytes),
            format!("  \"run\": {},\n", serde_json::json!(run)),
        ),
        Some("bdf") => {
            let mass = "A density changed with the size of its element keeps the mass.";
            let words: Vec<char> = format!("{} ", run).chars().collect();
            let lines = words.chunks(DECK_COLUMNS).map(|line| line.iter().collect());
            let lines: Vec<String> = lines.chain([mass.to_owned()]).collect();
            (
                0,
                lines
                    .iter()
                    .map(|line| format!("$ {}\n", line.trim_end()))
                    .collect(),
            )
        }
        Some("mtx") => (after_line(bytes), format!("% {run}\n")),
        _ => return bytes.to_vec(),
    };
    let (before, after) = bytes.split_at(place);
    [before, line.as_bytes(), after].concat()
}

/// Place where the second line begins.
fn after_line(bytes: &[u8]) -> usize {
    bytes
        .iter()
        .position(|&byte| byte == b'\n')
        .map_or(0, |end| end + 1)
}
