//! `corfem deck` and `corfem modes` from outside.

use crate::prelude::*;
use crate::presentation::program::cli::{corfem, numbers, parsed};

#[test]
fn a_deck_of_a_pass_has_the_frequencies_of_that_pass() {
    let folder = new_folder();
    let path = folder.path().join("box.dat");
    let path = path.to_str().unwrap();
    let case = case_of(2);
    let passes = case_run(&case).correlation.passes;
    let (model, _) = whole::of(&case.model().unwrap()).unwrap();
    for (pass, factors) in [&vec![1.0; 15], &passes[0].factors, &passes[1].factors]
        .into_iter()
        .enumerate()
    {
        // By the same eigensolver, so that the digits of the deck are all that differs.
        let expected = model.modes(factors, 9).unwrap().vibrations;
        let written = corfem(&["deck", "2", "--pass", &pass.to_string(), "-o", path]);
        assert_eq!((written.status.code(), written.stdout.len()), (Some(0), 0));
        let document = parsed(&["modes", path, "--format", "json"]);
        let found = numbers(&document["frequencies_hz"]);
        assert_eq!(found.len(), 9);
        assert_alike(found, expected.frequencies_hz(), DECK_ROUNDING);
        assert_eq!(document["dof"][0]["grid"], 101);
        assert_eq!(document["dof"][8]["direction"], "z");
        for (mode, mass) in numbers(&document["generalized_masses"])
            .into_iter()
            .enumerate()
        {
            let shape = numbers(&document["shapes"][mode]);
            assert_eq!(
                (shape.len(), shape.iter().copied().fold(f64::MIN, f64::max)),
                (9, 1.0)
            );
            let masses = shape.iter().zip(&case.reconstruction.masses);
            let generalized: f64 = masses.map(|(x, m)| m * x * x).sum();
            assert_alike([mass], [generalized], 1e2 * DECK_ROUNDING);
        }
    }
}

/// Shapes at all that moves have those at the masses among them, in the same scale, and follow the equations.
#[test]
fn modes_as_json_have_every_grid_that_moves() {
    let folder = new_folder();
    let path = folder.path().join("rods.bdf");
    let deck = "GRID,1,,0.,0.,0.,,123\nGRID,2,,10.,0.,0.,,23\nGRID,3,,20.,0.,0.,,23\nGRID,4,,30.,0.,0.,,23\n\
                GRID,9,,15.,1.,0.\nCROD,1,1,1,2\nCROD,2,1,2,3\nCROD,3,1,3,4\nPROD,1,1,.1\nMAT1,1,1.+6\n\
                CMASS2,8,1.,2,1\nCMASS2,7,2.,4,1\nMPC,1,9,3,-1.,2,1,.5\n,,3,1,-2.\nSPC1,1,12,9\n";
    fs::write(&path, deck).unwrap();
    let path = path.to_str().unwrap();
    let found: Value =
        serde_json::from_slice(&corfem(&["modes", path, "-f", "json"]).stdout).unwrap();
    let names = |list: &Value| {
        let list = list.as_array().unwrap().iter();
        list.map(|dof| format!("{} {}", dof["grid"], dof["direction"].as_str().unwrap()))
            .collect_vec()
    };
    assert_eq!(names(&found["dof"]), ["2 x", "4 x"]);
    assert_eq!(names(&found["moving_dof"]), ["2 x", "3 x", "4 x", "9 z"]);
    let all = found["moving_shapes"].as_array().unwrap();
    let at_masses = found["shapes"].as_array().unwrap();
    assert_eq!((all.len(), at_masses.len()), (2, 2));
    for (shape, at_mass) in all.iter().zip(at_masses) {
        let (shape, at_mass) = (numbers(shape), numbers(at_mass));
        let near = |found: f64, expected: f64| {
            assert_relative_eq!(found, expected, epsilon = ROUND_OFF);
        };
        near(shape[0], at_mass[0]);
        near(shape[2], at_mass[1]);
        // The grid between two equal rods has no mass and stands in the middle; the equation ties the last.
        near(shape[1], 0.5 * (shape[0] + shape[2]));
        near(shape[3], 0.5 * shape[0] - 2.0 * shape[1]);
    }
}
