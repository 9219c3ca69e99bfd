//! Matrices as other programs write them: Matrix Market, DMIG cards of NASTRAN, and the text of its module OUTPUT4.
//!
//! Memory is bounded by a file's own size: no room is reserved for what a header promises.

mod digits;
mod dmig;
mod matrix_market;
mod output4;

pub(crate) use digits::Digits;
#[doc(hidden)]
pub use matrix_market::write_matrix_market;

use crate::files::deck::decoded;
use crate::files::error::FileError;
use crate::sparse::SparseMatrix;

/// A grid and its component, 1 to 6, or 0 for a scalar point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Label {
    /// Number of the grid.
    pub grid: usize,
    /// The component.
    pub component: usize,
}

/// A matrix of a file, with the labels of its rows and columns where the file has them.
#[derive(Debug, Clone, PartialEq)]
pub struct LabeledMatrix {
    /// Labels of the rows, ascending. Only DMIG has them.
    pub rows: Option<Vec<Label>>,
    /// Labels of the columns; a square or symmetric matrix has one list for both, of all labels in either.
    pub columns: Option<Vec<Label>>,
    /// The matrix, a symmetric one with both triangles.
    pub matrix: SparseMatrix,
}

/// Reads a real matrix from a file, `name` in messages: in Matrix Market's format if it begins with `%%MatrixMarket`, as
/// bulk data if a line begins with `DMIG`, and otherwise in that of OUTPUT4. `wanted` is the matrix's name in capitals or not,
/// which may be left out where the file has one alone; Matrix Market has no names. Matrices of other names may be complex.
///
/// # Errors
/// [`FileError::DeckLine`] and [`FileError::DeckField`] name the line of what is damaged, complex or cut off, line 1 without such a
/// matrix; the errors of [`SparseMatrix::new`].
pub fn read(name: &str, bytes: &[u8], wanted: Option<&str>) -> Result<LabeledMatrix, FileError> {
    let text = decoded(bytes);
    if begins(text.trim_start(), "%%MatrixMarket") {
        let matrix = matrix_market::read(name, &text)?;
        return Ok(LabeledMatrix {
            rows: None,
            columns: None,
            matrix,
        });
    }
    let is_dmig = text.lines().any(|line| begins(line.trim_start(), "DMIG"));
    let read = if is_dmig { dmig::read } else { output4::read };
    let (names, mut found) = read(name, &text, wanted)?;
    let one = found.pop().filter(|_| found.is_empty());
    one.ok_or_else(|| {
        let asked = wanted.map_or("name one matrix".to_owned(), |name| {
            format!("there is not one matrix {name}")
        });
        let names = if names.is_empty() {
            "none".to_owned()
        } else {
            names.join(", ")
        };
        FileError::line(name, 1, format!("{asked}; the file has {names}"))
    })
}

/// Names of all matrices of a file, and those among them that are wanted.
type FoundMatrices = (Vec<String>, Vec<LabeledMatrix>);

fn is_wanted(name: &str, wanted: Option<&str>) -> bool {
    wanted.is_none_or(|wanted| wanted.eq_ignore_ascii_case(name))
}

fn begins(text: &str, word: &str) -> bool {
    text.get(..word.len())
        .is_some_and(|start| start.eq_ignore_ascii_case(word))
}
