//! The model the correlation sees: parameters, their sizes and bounds.

use crate::common::structures::chain_model as chain;
use crate::prelude::*;

/// The paper's substructures: covers, spars, ribs, and the rods as one more.
const SUBSTRUCTURES: [(&str, &[usize]); 4] = [
    ("covers", &[2, 4, 8, 9, 11, 15]),
    ("spars", &[1, 3, 5, 6, 10, 14]),
    ("ribs", &[7, 12, 13]),
    (
        "rods",
        &[
            16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37,
            38, 39,
        ],
    ),
];

properties! {
    /// A group's factor is that factor on each of its elements, and its share the sum of theirs.
    #[test]
    fn a_group_is_its_elements_together(case in case(), factors in factors(4)) {
        let groups = with_parameters(&case, SUBSTRUCTURES.map(|(name, elements)| Parameter::new(name, elements)).to_vec());
        let single = with_every_element(&case);
        let mut each = vec![1.0; 39];
        for ((_, elements), factor) in SUBSTRUCTURES.iter().zip(&factors) {
            for &element in *elements {
                each[element - 1] = *factor;
            }
        }
        prop_assert_eq!(groups.sizes(&factors)?, single.sizes(&each)?);
        let (together, apart) = (groups.matrices(&factors)?, single.matrices(&each)?);
        prop_assert_eq!(together.shares.len(), 4);
        prop_assert!(relative_distance(&together.stiffness, &apart.stiffness) <= ROUND_OFF);
        for ((_, elements), share) in SUBSTRUCTURES.iter().zip(&together.shares) {
            let sum: DMatrix<f64> = elements.iter().map(|&element| &apart.shares[element - 1]).sum();
            prop_assert!(relative_distance(share, &sum) <= MATRIX_ROUND_OFF);
        }
        prop_assert_eq!(&together.mass, groups.mass());
    }

    /// Sizes are the first ones times the factors, element by element; those in no parameter stay.
    #[test]
    fn sizes_are_first_sizes_times_factors(case in case(), factors in factors(15)) {
        let model = case.model()?;
        let sizes = model.sizes(&factors)?;
        prop_assert_eq!(sizes.len(), 39);
        for (panel, (size, factor)) in case.panels.iter().zip(sizes.iter().zip(&factors)) {
            prop_assert_eq!(*size, panel.gage * factor);
        }
        prop_assert!(sizes[15..].iter().all(|&area| area == case.rod_area));
    }
}

#[test]
fn factor_ranges_are_those_of_the_parameters_and_keep_the_gages_of_the_box() {
    let bounds = |lower, upper| Some(Bounds { lower, upper });
    let with = |element: usize, factor_range| Parameter {
        factor_range,
        ..Parameter::new(element, &[element])
    };
    let ranges = [bounds(0.5, 1.5), None, bounds(0.5, 1.0)];
    let parameters = (1..=3)
        .zip(ranges)
        .map(|(element, range)| with(element, range));
    let found = chain(parameters.collect()).unwrap().factor_ranges();
    assert_eq!(found.unwrap(), ranges);
    let paper = case_of(3).model().unwrap().factor_ranges().unwrap();
    assert_eq!(paper.len(), 15);
    assert_eq!(
        (paper[0], paper[1]),
        (bounds(0.007 / 0.013, 1.0), bounds(1.0, 0.013 / 0.007))
    );
}
