//! Arrays in NumPy's format 1.0, and a wing's problem written with them for other programs.

use crate::stages::Analyzed;
use corfem::method::appendix_a::element_matrices;
use corfem::method::structure::ElementKind;
use std::fs::{File, create_dir_all};
use std::io::{BufWriter, Result, Write};
use std::path::Path;

/// Writes an array, last index fastest; `kind` is `<f8` or `<i8`.
fn array(
    path: &Path,
    kind: &str,
    shape: &[usize],
    bytes: impl Iterator<Item = [u8; 8]>,
) -> Result<()> {
    let shape: String = shape.iter().map(|length| format!("{length}, ")).collect();
    let header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({shape}), }}");
    let length = (header.len() + 1 + 10).next_multiple_of(64) - 10;
    let mut file = BufWriter::new(File::create(path)?);
    file.write_all(b"\x93NUMPY\x01\x00")?;
    file.write_all(&(length as u16).to_le_bytes())?;
    file.write_all(format!("{header:<width$}\n", width = length - 1).as_bytes())?;
    bytes
        .into_iter()
        .try_for_each(|number| file.write_all(&number))?;
    file.flush()
}

fn numbers(path: &Path, shape: &[usize], values: impl Iterator<Item = f64>) -> Result<()> {
    array(path, "<f8", shape, values.map(f64::to_le_bytes))
}

fn integers(path: &Path, shape: &[usize], values: impl Iterator<Item = usize>) -> Result<()> {
    // What is not there is -1.
    array(
        path,
        "<i8",
        shape,
        values.map(|value| (value as i64).to_le_bytes()),
    )
}

/// Writes what an analysis begins with, and the frequencies and shares that it ends with.
///
/// Of rods and panels each: unit matrices (n × m × m) filled up with zeros, DOF (n × m) with -1 where one is held, size and
/// group.
pub fn write(folder: &Path, analyzed: &Analyzed) -> Result<()> {
    create_dir_all(folder)?;
    let at = |name: &str| folder.join(format!("{name}.npy"));
    let structure = &analyzed.wing.structure().expect("a wing");
    let mut group_of = vec![0; structure.elements().len()];
    for (group, parameter) in analyzed.wing.parameters().iter().enumerate() {
        parameter
            .elements
            .iter()
            .for_each(|&label| group_of[label - 1] = group);
    }
    let matrices: Vec<_> = element_matrices(structure).collect();
    for (name, is_rod) in [("rod", true), ("panel", false)] {
        let all = (0..).zip(structure.elements()).zip(&matrices);
        let of_kind = || {
            all.clone()
                .filter(|((_, element), _)| (element.kind == ElementKind::Rod) == is_rod)
        };
        let (count, size) = (of_kind().count(), if is_rod { 6 } else { 12 });
        let units = of_kind().flat_map(|(_, matrices)| {
            let there = matrices.dof.len();
            let entry = move |k: usize| (k / size, k % size);
            (0..size * size).map(move |k| match entry(k) {
                (row, column) if row < there && column < there => matrices.unit[(row, column)],
                _ => 0.0,
            })
        });
        numbers(&at(&format!("{name}_unit")), &[count, size, size], units)?;
        let dof = of_kind().flat_map(|(_, matrices)| {
            (0..size).map(|k| matrices.dof.get(k).copied().unwrap_or(usize::MAX))
        });
        integers(&at(&format!("{name}_dof")), &[count, size], dof)?;
        numbers(
            &at(&format!("{name}_size")),
            &[count],
            of_kind().map(|((_, element), _)| element.size),
        )?;
        integers(
            &at(&format!("{name}_group")),
            &[count],
            of_kind().map(|((row, _), _)| group_of[row]),
        )?;
    }
    let entries = analyzed.mass.entries();
    integers(
        &at("mass_place"),
        &[entries.len(), 2],
        entries.clone().flat_map(|(row, column, _)| [row, column]),
    )?;
    numbers(
        &at("mass_value"),
        &[entries.len()],
        entries.clone().map(|entry| entry.2),
    )?;
    let frequencies = analyzed.modes.frequencies_hz();
    numbers(
        &at("frequencies"),
        &[frequencies.len()],
        frequencies.iter().copied(),
    )?;
    let shares = analyzed.model.shares();
    let diagonals = shares
        .iter()
        .flat_map(|share| share.matrix().diagonal().data.as_vec().clone());
    numbers(&at("shares"), &[shares.len(), frequencies.len()], diagonals)
}
