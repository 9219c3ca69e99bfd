//! The formatted file of NASTRAN's module OUTPUT5.

#![cfg(unix)]

use crate::common::fake_solver::output5;
use crate::prelude::*;

#[test]
fn a_file_of_module_output5_reads() {
    let text = include_str!("../../golden/nastran95/output5_rod.txt");
    let matrices = read_output5(text, 144).unwrap();
    assert_eq!(matrices.len(), 1);
    let kgg = &matrices["KGG"];
    assert_eq!(kgg.shape(), (12, 12));
    assert_eq!(kgg[(0, 0)], 0.201_881_637_294_121_43e5);
    assert_eq!(kgg[(8, 1)], 0.982_844_813_142_433_3e4);
    assert_eq!(kgg, &kgg.transpose());
    assert_eq!(kgg.row(3).amax(), 0.0);
    let two = output5(&[
        ("A", &dmatrix![0.0, 2.0, 0.0; 1.0, -3.0, 0.0]),
        ("B", &zero_square(1)),
    ]);
    let read = read_output5(&two, 7).unwrap();
    assert_eq!(read["A"], dmatrix![0.0, 2.0, 0.0; 1.0, -3.0, 0.0]);
    assert_eq!(read["B"], zero_square(1));
    // No header is too large, but both together are.
    let error = read_output5(&two, 6).expect_err("seven entries");
    assert!(error.to_string().contains("line 9: "), "{error}");
}
