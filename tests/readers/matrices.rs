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
    if std::env::var("CORFEM_WRITE").is_ok_and(|value| value == "formats") {
        fs::write(golden(file), written).unwrap();
    }
    assert_eq!(
        String::from_utf8_lossy(written),
        fs::read_to_string(golden(file)).unwrap(),
        "{file}"
    );
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
    assert_eq!(sizes.len(), 5 + 3 * 2 + 3 * 3);
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
            "rectangular" => assert_eq!(size, ["20", "3"]),
            rows => assert_eq!(size, [rows, columns.as_str()], "{file} {name}"),
        }
        if rows == "symmetric" || file.starts_with("symmetric") || name == "KAA" {
            assert!(found.matrix.is_symmetric());
        }
    }
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

/// The law: a file that ends inside its last number is refused, wherever in it, and one that lacks its last line end alone is read.
#[test]
fn a_file_that_ends_inside_a_number_is_refused() {
    for [one, other, last] in [
        ["1.250000e+05", "-3.500000e-02", "2.000000e+03"],
        ["125.000000", "-0.035000", "2000.123456"],
        ["1.25e5", "-3.5e-2", "2.5e3"],
    ] {
        let market = format!(
            "%%MatrixMarket matrix coordinate real general\n2 2 3\n1 1 {one}\n1 2 {other}\n2 2 {last}"
        );
        let labeled = format!("1,1,1,1,{one}\n1,2,1,2,{other}\n1,3,1,3,{last}");
        let bulk = (1..).zip([one, other, last]);
        let bulk = bulk.map(|(grid, value)| format!("DMIG,K,{grid},1,,{grid},1,{value}"));
        let bulk = bulk.collect_vec().join("\n");
        for text in [market, labeled, format!("DMIG,K,0,6,1\n{bulk}")] {
            assert!(read("m", text.as_bytes(), None).is_ok(), "{text}");
            for cut in 1..last.len() {
                let left = &text[..text.len() - cut];
                let error = read("m", left.as_bytes(), None).expect_err(left);
                let line = format!("m, line {}: ", text.lines().count());
                assert!(error.to_string().starts_with(&line), "{error}");
            }
        }
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
    fn a_file_that_ends_early_is_refused(part in 0.02..0.98_f64, which in 0..7_usize) {
        let files = ["general.mtx", "general_array.mtx", "symmetric.mtx", "symmetric_array.mtx",
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
