//! Modes of decks whose answers are known in closed form.

use crate::common::tolerances::EIGEN_ROUND_OFF;
use corfem::files::deck;
use corfem::files::error::FileError;
use corfem::method::error::Error;
use corfem::studies::whole_modes::WholeModes;
use std::f64::consts::PI;

fn modes(text: &str) -> Result<WholeModes, FileError> {
    deck::modes(&deck::read("test", text)?.model)
}

/// A rod of E A/L = 1000 lbf/in from a fixed grid 1 along x to grid 2, which moves along x alone.
const ROD: &str = "\
GRID,1,,0.,0.,0.
GRID,2,,10.,0.,0.
CROD,1,1,1,2
PROD,1,1,.01
MAT1,1,1.+6,,.3
SPC1,1,123456,1
SPC1,1,23456,2
";

#[test]
fn one_mass_on_one_rod() {
    // From one cycle in a minute to a megahertz.
    for (text, mass) in [(".4", 0.4_f64), ("4.-11", 4e-11), ("4.+4", 4e4)] {
        let found = modes(&format!("{ROD}CMASS2,7,{text},2,1")).expect("modes");
        assert_eq!(found.modes.shapes.shape(), (1, 1));
        let frequency = (1000.0 / mass).sqrt() / (2.0 * PI);
        approx::assert_relative_eq!(found.modes.frequencies_hz()[0], frequency, max_relative = EIGEN_ROUND_OFF);
        approx::assert_relative_eq!(found.modes.shapes[0], mass.powf(-0.5), max_relative = EIGEN_ROUND_OFF);
        assert_eq!((found.dof[0].grid, found.dof[0].direction), (2, 0));
    }
}

#[test]
fn conm2_moves_where_the_grid_can() {
    // Held directions carry mass that does not move; grid 1 none at all.
    let found = modes(&format!("{ROD}CONM2,7,2,,.3\nCONM2,8,1,0,5.\nCMASS2,9,.1,2,1")).expect("modes");
    assert_eq!(found.dof.len(), 1);
    let frequency = (1000.0 / 0.4_f64).sqrt() / (2.0 * PI);
    approx::assert_relative_eq!(found.modes.frequencies_hz()[0], frequency, max_relative = EIGEN_ROUND_OFF);
}

#[test]
fn density_lumps_half_a_rod_at_either_end() {
    let found = modes(&ROD.replace("1.+6,,.3", "1.+6,,.3,2.-4")).expect("modes");
    let mass = 2e-4 * 0.01 * 10.0 / 2.0;
    let frequency = (1000.0_f64 / mass).sqrt() / (2.0 * PI);
    approx::assert_relative_eq!(found.modes.frequencies_hz()[0], frequency, max_relative = EIGEN_ROUND_OFF);
}

#[test]
fn masses_that_the_structure_cannot_tell_apart_make_one_mode() {
    // Grid 3 follows grid 2 at twice its motion: mass 0.1 there counts four times.
    let tied = format!("{ROD}GRID,3,,20.,0.,0.,,23\nMPC,1,3,1,-.5,2,1,1.\nCMASS2,7,.4,2,1\nCMASS2,8,.1,3,1");
    let found = modes(&tied).expect("modes");
    assert_eq!(found.dof.len(), 2);
    assert_eq!(found.modes.shapes.shape(), (2, 1));
    let frequency = (1000.0 / 0.8_f64).sqrt() / (2.0 * PI);
    approx::assert_relative_eq!(found.modes.frequencies_hz()[0], frequency, max_relative = EIGEN_ROUND_OFF);
    approx::assert_relative_eq!(found.modes.shapes[1], 2.0 * found.modes.shapes[0], max_relative = EIGEN_ROUND_OFF);
    approx::assert_relative_eq!(found.modes.shapes[0], 0.8_f64.powf(-0.5), max_relative = EIGEN_ROUND_OFF);
}

#[test]
fn two_masses_and_two_rods_in_ascending_order() {
    let chain = format!("{ROD}GRID,3,,20.,0.,0.,,23456\nCONROD,2,2,3,1,.01\nCMASS2,7,1.,2,1\nCMASS2,8,1.,3,1");
    let found = modes(&chain).expect("modes");
    // Two equal masses and springs: ω² = (3 ∓ √5)/2 k/m.
    for (root, sign) in found.modes.omega_squared.iter().zip([-1.0, 1.0]) {
        let expected = 1000.0 * (3.0 + sign * 5.0_f64.sqrt()) / 2.0;
        approx::assert_relative_eq!(*root, expected, max_relative = EIGEN_ROUND_OFF);
    }
    assert!(found.modes.shapes.column(0).min() > 0.0, "the first moves one way");
}

#[test]
fn a_tie_to_a_held_dof_adds_nothing() {
    let tied = format!("{ROD}GRID,3,,20.,0.,0.,,23456\nMPC,1,3,1,-1.,2,1,1.,,+A\n+A,,1,1,7.\nCMASS2,8,.4,3,1");
    let found = modes(&tied).expect("modes");
    let frequency = (1000.0 / 0.4_f64).sqrt() / (2.0 * PI);
    approx::assert_relative_eq!(found.modes.frequencies_hz()[0], frequency, max_relative = EIGEN_ROUND_OFF);
}

#[test]
fn a_deck_without_mass_or_with_a_loose_grid_is_refused() {
    let error = modes(ROD).expect_err("no mass");
    assert!(matches!(error, FileError::Method(Error::Empty { what: "degrees of freedom with mass" })), "{error}");
    let loose = format!("{ROD}GRID,3,,20.,0.,0.,,23456\nCMASS2,8,.4,2,1");
    let error = modes(&loose).expect_err("grid 3 is loose");
    assert!(matches!(error, FileError::Method(Error::SingularStiffness { grid: 3, direction: 'x', .. })), "{error}");
}

#[test]
fn an_element_at_a_tied_grid_is_refused() {
    let tied = format!("{ROD}GRID,3,,20.,0.,0.,,23456\nCROD,2,1,1,3\nMPC,1,3,1,-1.,2,1,1.\nCMASS2,8,.4,3,1");
    let error = modes(&tied).expect_err("rod 2 is tied");
    assert!(matches!(error, FileError::TiedElement { element: 2, grid: 3, direction: 'x' }), "{error}");
    assert_eq!(error.to_string(), "element 2: expected its grids free of MPC equations, found grid 3 tied along x");
}
