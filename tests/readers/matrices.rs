//! Matrices of other programs: what SciPy and pyNastran wrote (golden/formats/), what NASTRAN's manual says, and the way back.

use crate::prelude::*;
use matrices::{Label, LabeledMatrix, read};

pub fn golden(file: &str) -> PathBuf {
    in_root("golden/formats").join(file)
}

/// The lines of a stored table.
pub fn table(file: &str) -> Vec<Vec<String>> {
    let mut reader = csv::Reader::from_path(golden(file)).unwrap();
    reader
        .records()
        .map(|line| line.unwrap().iter().map(str::to_owned).collect())
        .collect()
}

/// Compares what the crate wrote with the file that another program was given; writes that file on request.
pub fn assert_written(file: &str, written: &[u8]) {
    if std::env::var("CORFEM_WRITTEN").is_ok_and(|value| value == "write") {
        fs::write(golden(file), written).unwrap();
    }
    assert_eq!(
        String::from_utf8_lossy(written),
        fs::read_to_string(golden(file)).unwrap(),
        "{file}"
    );
}

/// Labels of these grids and components.
fn labels(all: &[(usize, usize)]) -> Option<Vec<Label>> {
    let label = |&(grid, component): &(usize, usize)| Label { grid, component };
    Some(all.iter().map(label).collect())
}

/// A matrix by the names of its rows and columns.
fn by_name(found: &LabeledMatrix) -> BTreeMap<(String, String), f64> {
    let name = |labels: &Option<Vec<Label>>, place: usize| match labels {
        Some(labels) => format!("{}-{}", labels[place].grid, labels[place].component),
        None => (place + 1).to_string(),
    };
    let entries = found.matrix.entries();
    entries
        .map(|(row, column, value)| {
            (
                (name(&found.rows, row), name(&found.columns, column)),
                value,
            )
        })
        .collect()
}

#[test]
fn matrices_of_the_owners_programs_read_to_the_last_digit() {
    let mut expected: BTreeMap<(String, String), BTreeMap<(String, String), f64>> = BTreeMap::new();
    for line in table("entries.csv") {
        let [file, name, row, column, value] = &line[..] else {
            panic!("{line:?}")
        };
        let value = value.parse().unwrap();
        expected
            .entry((file.clone(), name.clone()))
            .or_default()
            .insert((row.clone(), column.clone()), value);
    }
    let sizes = table("sizes.csv");
    assert_eq!(sizes.len(), 7 + 3 * 2 + 3 * 3);
    for line in sizes {
        let [file, name, rows, columns] = &line[..] else {
            panic!("{line:?}")
        };
        let bytes = fs::read(golden(file)).unwrap();
        let wanted = (!name.is_empty()).then_some(name.as_str());
        let found = read(file, &bytes, wanted).unwrap();
        assert_eq!(
            by_name(&found),
            expected[&(file.clone(), name.clone())],
            "{file} {name}"
        );
        let size = [found.matrix.rows(), found.matrix.columns()].map(|size| size.to_string());
        match rows.as_str() {
            "symmetric" | "square" => assert!(found.rows.is_some() && found.rows == found.columns),
            "rectangular" => {
                assert_eq!(found.columns, labels(&[(1, 0), (2, 0), (3, 0)]));
                assert_eq!(found.matrix.rows(), 20);
            }
            rows => assert_eq!(size, [rows, columns.as_str()], "{file} {name}"),
        }
        if rows == "symmetric" || file.starts_with("symmetric") || name == "KAA" {
            assert!(found.matrix.is_symmetric());
        }
        // The same with the line ends of Windows.
        let text = String::from_utf8(bytes).unwrap().replace('\n', "\r\n");
        assert_eq!(
            read(file, text.as_bytes(), wanted).unwrap(),
            found,
            "{file} {name}"
        );
    }
}

#[test]
fn a_matrix_is_chosen_by_its_name() {
    let bytes = fs::read(golden("sparse.op4")).unwrap();
    let [one, other] = ["kaa", "KAA"].map(|name| read("m", &bytes, Some(name)).unwrap());
    assert_eq!(one, other);
    let dmig = fs::read(golden("small.dmig")).unwrap();
    for (bytes, wanted, found) in [
        (&bytes[..], None, "KAA, T"),
        (&bytes[..], Some("MAA"), "KAA, T"),
        (b"", Some("MAA"), "none"),
        (&dmig[..], Some("MAA"), "KAAX, BAAX, PAX"),
    ] {
        let error = read("m", bytes, wanted).expect_err(found).to_string();
        let asked = wanted.map_or("name one matrix".to_owned(), |name| {
            format!("there is not one matrix {name}")
        });
        assert_eq!(error, format!("m, line 1: {asked}; the file has {found}"));
    }
}

/// By hand, with the words that NASTRAN counts: two for every number in double precision.
#[test]
fn strings_with_nastrans_words_read() {
    let is = |words: usize, row: usize| 65536 * (words + 1) + row;
    let text = format!(
        "       3      70       2       2A       1P,2D24.16\n       1       0      10\n{:8}\n\
         -1.0000000000000000D-300  2.5000000000000000D+00\n  3.0000000000000000D+00\n{:8}\n\
         -1.0000000000000000-101\n       3       0       3\n{:8}\n  4.0000000000000000+101\n       4       1       1\n\
         \x201.0000000000000000D+00\n\
         \x20      2  -70000       9       1B       1P,5E16.9\n       2       0       7\n       3   65990\n\
         \x201.000000000E+00-2.000000000E+00\n       2   69999\n 3.000000000E+00\n       3       1       1\n 1.000000000E+00\n\
         \x20      1       2       6       2C\n       2       1       1\n 1.000000000E+00\n",
        is(6, 2),
        is(2, 70),
        is(2, 1),
    );
    let a = read("m", text.as_bytes(), Some("A")).unwrap().matrix;
    assert_eq!((a.rows(), a.columns()), (70, 3));
    assert_eq!(
        a.entries().collect_vec(),
        [
            (1, 0, -1e-300),
            (2, 0, 2.5),
            (3, 0, 3.0),
            (69, 0, -1e-101),
            (0, 2, 4e101)
        ]
    );
    let b = read("m", text.as_bytes(), Some("B")).unwrap().matrix;
    assert_eq!((b.rows(), b.columns()), (70000, 2));
    assert_eq!(
        b.entries().collect_vec(),
        [(65989, 1, 1.0), (65990, 1, -2.0), (69998, 1, 3.0)]
    );
    let error = read("m", text.as_bytes(), Some("C"))
        .expect_err("it is not square")
        .to_string();
    assert!(
        error.ends_with("is not the header of a matrix of form 1, 2 or 9, or 6 if it is square"),
        "{error}"
    );
    let zero = text.replace(
        "       1       2       6       2C",
        "       1       2       2       2C       1P,5E16.9",
    );
    assert!(
        read("m", zero.as_bytes(), Some("C"))
            .unwrap()
            .matrix
            .entries()
            .collect_vec()
            .is_empty()
    );
}

/// Of a matrix that is not asked for nothing is read but where it ends, however wide its numbers are.
#[test]
fn a_matrix_before_the_one_asked_for_is_passed_over() {
    let one = |name: &str, format: &str, number: &str| {
        format!(
            "       1       1       2       2{name:8}{format}\n       1       1       1\n{number}\n       2       1       1\n{number}\n"
        )
    };
    let wide = one(
        "A",
        "1P,2E40.16",
        &format!("{:>40}", "1.0000000000000000E+00"),
    );
    let text = wide + &one("B", "1P,3E23.16", " 2.0000000000000000E+00");
    assert_eq!(
        read("m", text.as_bytes(), Some("B"))
            .unwrap()
            .matrix
            .entries()
            .collect_vec(),
        [(0, 0, 2.0)]
    );
    assert_eq!(
        read("m", text.as_bytes(), Some("A"))
            .unwrap()
            .matrix
            .entries()
            .collect_vec(),
        [(0, 0, 1.0)]
    );
    let none = read("m", text.as_bytes(), Some("C"))
        .expect_err("no such matrix")
        .to_string();
    assert!(none.ends_with("the file has A, B"), "{none}");
}

#[test]
fn one_triangle_of_a_symmetric_matrix_is_mirrored() {
    let text = |more: &str| {
        format!(
            "       2       2       6       2K       1P,3E23.16\n       1       1       2\n 1.0000000000000000E+00 \
             2.0000000000000000E+00\n{more}       3       1       1\n 1.0000000000000000E+00\n"
        )
    };
    let whole = [(0, 0, 1.0), (1, 0, 2.0), (0, 1, 2.0), (1, 1, 3.0)];
    for (row, numbers) in [
        (2, " 3.0000000000000000E+00"),
        (1, " 2.0000000000000000E+00 3.0000000000000000E+00"),
    ] {
        let second = format!("       2{row:8}{:8}\n{numbers}\n", 3 - row);
        assert_eq!(
            read("m", text(&second).as_bytes(), None)
                .unwrap()
                .matrix
                .entries()
                .collect_vec(),
            whole
        );
    }
    let upper = text("       2       1       2\n 2.0000000000000000E+00 3.0000000000000000E+00\n");
    let upper = upper.replace(
        "       1       1       2\n 1.0000000000000000E+00 2.0000000000000000E+00\n",
        "       1       1       1\n 1.0000000000000000E+00\n",
    );
    assert_eq!(
        read("m", upper.as_bytes(), None)
            .unwrap()
            .matrix
            .entries()
            .collect_vec(),
        whole
    );
}

#[test]
fn fields_without_blanks_and_scalar_points_of_dmig_read() {
    let text = "$ punched\nDMIG    K       0       6       2       0                       4\n\
                DMIG*   K                      123456780               2                *A1\n\
                *A1            123456780               2 1.000000000D+02                *A2\n\
                *A2                    7                -2.000000000D-03\n\
                DMIG,K,7,0,,7,,1.5\n\
                DMIG    C       0       6       3       0\nDMIG    C       1       1               1       1       1.      2.\n"
        .replace("123456780", " 12345678");
    let found = read("m", text.as_bytes(), Some("K")).unwrap();
    assert_eq!(found.rows, labels(&[(7, 0), (12_345_678, 2)]));
    assert_eq!(
        found.matrix.entries().collect_vec(),
        [(0, 0, 1.5), (1, 0, -2e-3), (0, 1, -2e-3), (1, 1, 100.0)]
    );
    let error = read("m", text.as_bytes(), Some("C"))
        .expect_err("complex")
        .to_string();
    assert_eq!(
        error,
        "m, line 7: card DMIG, field 5: \"3\" is not the type of a real matrix (1 or 2)"
    );
    // Three entries on a card, and a place for one that has none.
    let text = "DMIG,K,0,2,2,0\nDMIG,K,1,1,,2,1,2.,,+A\n+A,,,,,3,1,3.,,+B\n+B,4,1,4.\n";
    let found = read("m", text.as_bytes(), None).unwrap();
    assert_eq!(found.rows, labels(&[(2, 1), (3, 1), (4, 1)]));
    assert_eq!(
        found.matrix.entries().collect_vec(),
        [(0, 0, 2.0), (1, 0, 3.0), (2, 0, 4.0)]
    );
    // Fields of eight characters that touch.
    let text = "DMIG    K       0       1       1       0\nDMIG    K       12345678       3        12345679       1-1.234-3\n";
    let found = read("m", text.as_bytes(), None).unwrap();
    assert_eq!(found.rows, labels(&[(12_345_678, 3), (12_345_679, 1)]));
    assert_eq!(found.matrix.entries().collect_vec(), [(1, 0, -1.234e-3)]);
}

/// What the crate writes, and what SciPy reads from it.
#[test]
fn the_owners_programs_read_what_the_crate_writes() {
    let general = vec![
        (0, 0, 1e-300),
        (3, 0, -1.5e10),
        (1, 1, 0.1 + 0.2),
        (4, 2, f64::MAX),
        (0, 2, PI),
    ];
    let mut symmetric = (0..12)
        .map(|row| (row, row, 2.0 + 1.0 / (row + 1) as f64))
        .collect_vec();
    symmetric.extend((1..12).flat_map(|row| {
        [
            (row, row - 1, -1.0 / row as f64),
            (row - 1, row, -1.0 / row as f64),
        ]
    }));
    let written = [
        ("written_general.mtx", 5, 3, general),
        ("written_symmetric.mtx", 12, 12, symmetric),
    ]
    .map(|(file, rows, columns, entries)| {
        let matrix = SparseMatrix::new("test", rows, columns, entries).unwrap();
        assert_written(file, write_matrix_market(&matrix).as_bytes());
        (file, matrix)
    });
    let stored = table("read_back_matrices.csv");
    for (file, matrix) in written {
        let read = stored.iter().filter(|line| line[0] == file);
        let number = |text: &str| text.parse::<usize>().unwrap() - 1;
        let read = read.map(|line| (number(&line[1]), number(&line[2]), line[3].parse().unwrap()));
        assert_eq!(
            SparseMatrix::new("test", matrix.rows(), matrix.columns(), read.collect()).unwrap(),
            matrix,
            "{file}"
        );
    }
}

properties! {
    #[test]
    fn a_written_matrix_reads_back_exactly(
        size in (1..30_usize, 1..30_usize),
        entries in prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>(), prop::num::f64::NORMAL), 0..60),
        is_symmetric in any::<bool>(),
    ) {
        let (rows, columns) = if is_symmetric { (size.0, size.0) } else { size };
        let mut places = BTreeMap::new();
        for (row, column, value) in entries {
            let (row, column) = (row.index(rows), column.index(columns));
            places.insert((row, column), value);
            if is_symmetric {
                places.insert((column, row), value);
            }
        }
        let entries = places.into_iter().map(|((row, column), value)| (row, column, value)).collect();
        let matrix = SparseMatrix::new("test", rows, columns, entries)?;
        let text = write_matrix_market(&matrix);
        prop_assert_eq!(text.starts_with("%%MatrixMarket matrix coordinate real symmetric\n"), matrix.is_symmetric());
        prop_assert!(!is_symmetric || matrix.is_symmetric());
        let back = read("test", text.as_bytes(), None)?.matrix;
        prop_assert_eq!((back.rows(), back.columns()), (rows, columns));
        prop_assert!(back.entries().eq(matrix.entries()));
    }

    /// Every text that ends early is refused, and the error names a line of what is left or the one after it.
    #[test]
    fn a_file_that_ends_early_is_refused(part in 0.02..0.98_f64, which in 0..9_usize) {
        let files = ["general.mtx", "general_array.mtx", "symmetric.mtx", "symmetric_array.mtx", "skew.mtx", "skew_array.mtx",
            "dense.op4", "sparse.op4", "bigmat.op4"];
        let file = files[which];
        let text = fs::read_to_string(golden(file))?;
        let wanted = file.ends_with("op4").then_some("T");
        let lines = text.lines().collect_vec();
        // What follows the last record of OUTPUT4 says nothing.
        let left = ((part * lines.len() as f64) as usize).clamp(1, lines.len() - 2);
        let error = read(file, lines[..left].join("\n").as_bytes(), wanted).expect_err("it is cut off");
        // Where the second matrix's header is gone, there is none of its name.
        let named = matches!(&error, FileError::DeckLine { line, .. } if *line <= left + 1);
        prop_assert!(named, "{error}");
    }
}
