//! Modes of decks whose answers are known in closed form.

use crate::prelude::*;

fn modes(text: &str) -> Result<WholeModes, FileError> {
    deck::modes(&read_deck(text)?.model, usize::MAX)
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
        let found = modes(&format!("{ROD}CMASS2,7,{text},2,1")).unwrap();
        assert_eq!(found.modes.shapes().shape(), (1, 1));
        let frequency = (1000.0 / mass).sqrt() / (2.0 * PI);
        assert_relative_eq!(
            found.modes.frequencies_hz()[0],
            frequency,
            max_relative = EIGEN_ROUND_OFF
        );
        assert_relative_eq!(
            found.modes.shapes()[0],
            mass.powf(-0.5),
            max_relative = EIGEN_ROUND_OFF
        );
        assert_eq!((found.dof[0].grid, found.dof[0].direction), (2, 0));
    }
}

#[test]
fn conm2_moves_where_the_grid_can() {
    // Held directions carry mass that does not move; grid 1 none at all.
    let found = modes(&format!(
        "{ROD}CONM2,7,2,,.3\nCONM2,8,1,0,5.\nCMASS2,9,.1,2,1"
    ))
    .unwrap();
    assert_eq!(found.dof.len(), 1);
    let frequency = (1000.0 / 0.4_f64).sqrt() / (2.0 * PI);
    assert_relative_eq!(
        found.modes.frequencies_hz()[0],
        frequency,
        max_relative = EIGEN_ROUND_OFF
    );
}

#[test]
fn density_lumps_half_a_rod_at_either_end() {
    let found = modes(&ROD.replace("1.+6,,.3", "1.+6,,.3,2.-4")).unwrap();
    let mass = 2e-4 * 0.01 * 10.0 / 2.0;
    let frequency = (1000.0_f64 / mass).sqrt() / (2.0 * PI);
    assert_relative_eq!(
        found.modes.frequencies_hz()[0],
        frequency,
        max_relative = EIGEN_ROUND_OFF
    );
}

#[test]
fn masses_that_the_structure_cannot_tell_apart_make_one_mode() {
    // Grid 3 follows grid 2 at twice its motion: mass 0.1 there counts four times.
    let tied = format!(
        "{ROD}GRID,3,,20.,0.,0.,,23\nMPC,1,3,1,-.5,2,1,1.\nCMASS2,7,.4,2,1\nCMASS2,8,.1,3,1"
    );
    let found = modes(&tied).unwrap();
    assert_eq!(found.dof.len(), 2);
    assert_eq!(found.modes.shapes().shape(), (2, 1));
    let frequency = (1000.0 / 0.8_f64).sqrt() / (2.0 * PI);
    assert_relative_eq!(
        found.modes.frequencies_hz()[0],
        frequency,
        max_relative = EIGEN_ROUND_OFF
    );
    assert_relative_eq!(
        found.modes.shapes()[1],
        2.0 * found.modes.shapes()[0],
        max_relative = EIGEN_ROUND_OFF
    );
    assert_relative_eq!(
        found.modes.shapes()[0],
        0.8_f64.powf(-0.5),
        max_relative = EIGEN_ROUND_OFF
    );
}

#[test]
fn two_masses_and_two_rods_in_ascending_order() {
    let chain = format!(
        "{ROD}GRID,3,,20.,0.,0.,,23456\nCONROD,2,2,3,1,.01\nCMASS2,7,1.,2,1\nCMASS2,8,1.,3,1"
    );
    let found = modes(&chain).unwrap();
    // Two equal masses and springs: ω² = (3 ∓ √5)/2 k/m.
    for (root, sign) in found.modes.omega_squared().iter().zip([-1.0, 1.0]) {
        let expected = 1000.0 * (3.0 + sign * 5.0_f64.sqrt()) / 2.0;
        assert_relative_eq!(*root, expected, max_relative = EIGEN_ROUND_OFF);
    }
    assert!(
        found.modes.shapes().column(0).min() > 0.0,
        "the first moves one way"
    );
}

#[test]
fn a_tie_to_a_held_dof_adds_nothing() {
    let tied = format!(
        "{ROD}GRID,3,,20.,0.,0.,,23456\nMPC,1,3,1,-1.,2,1,1.,,+A\n+A,,1,1,7.\nCMASS2,8,.4,3,1"
    );
    let found = modes(&tied).unwrap();
    let frequency = (1000.0 / 0.4_f64).sqrt() / (2.0 * PI);
    assert_relative_eq!(
        found.modes.frequencies_hz()[0],
        frequency,
        max_relative = EIGEN_ROUND_OFF
    );
}

#[test]
fn a_deck_without_mass_is_refused_and_a_grid_that_nothing_touches_is_held() {
    let error = modes(ROD).expect_err("no mass");
    assert!(
        matches!(
            error,
            FileError::Method(Error::Count {
                what: "degrees of freedom with mass",
                found: 0,
                least: 1,
                ..
            })
        ),
        "{error}"
    );
    let loose = format!("{ROD}GRID,3,,20.,0.,0.,,23456\nCMASS2,8,.4,2,1");
    let held = loose.replace(",23456\nCMASS2", ",123456\nCMASS2");
    assert_eq!(modes(&loose).unwrap(), modes(&held).unwrap());
    let unread = deck::read("loose.bdf", loose.as_bytes(), &[])
        .unwrap()
        .unread;
    assert_eq!(
        (unread[0].card.as_str(), unread[0].line, unread[0].reason),
        ("GRID", 8, Reason::Untouched)
    );
}

#[test]
fn an_element_at_a_tied_grid_is_refused() {
    let tied = format!(
        "{ROD}GRID,3,,20.,0.,0.,,23456\nCROD,2,1,1,3\nMPC,1,3,1,-1.,2,1,1.\nCMASS2,8,.4,3,1"
    );
    let error = modes(&tied).expect_err("rod 2 is tied");
    assert!(
        matches!(
            error,
            FileError::TiedElement {
                element: 2,
                grid: 3,
                direction: 'x'
            }
        ),
        "{error}"
    );
    assert_eq!(
        error.to_string(),
        "element 2: an MPC equation ties its grid 3 along x; an element's grids must move freely"
    );
}

/// Two masses on two rods of 10 in and 1 in² from a fixed grid along x.
fn chain(moduli: [f64; 2], masses: [f64; 2]) -> String {
    format!(
        "GRID,1,,0.,0.,0.,,123\nGRID,2,,10.,0.,0.,,23\nGRID,3,,20.,0.,0.,,23\nCONROD,1,1,2,1,1.\nCONROD,2,2,3,2,1.\n\
         MAT1*,1,{},,.3\nMAT1*,2,{},,.3\nCMASS2*,7,{},2,1\n*,,,,\nCMASS2*,8,{},3,1\n*,,,,\n",
        real(moduli[0]),
        real(moduli[1]),
        real(masses[0]),
        real(masses[1])
    )
}

fn real(value: f64) -> String {
    large_real(value).unwrap()
}

properties! {
    /// However unlike the parts, there are both modes and they are right, or an error says which parts are too unlike.
    #[test]
    fn no_mode_is_lost_in_silence(
        stiff in -10.0..20.0_f64, unlike in -20.0..20.0_f64, heavy in -3.0..3.0_f64, light in -20.0..20.0_f64,
    ) {
        let moduli = [stiff, stiff + unlike].map(|power| nearest_in_field(10.0_f64.powf(power)));
        let masses = [heavy, heavy + light].map(|power| nearest_in_field(10.0_f64.powf(power)));
        match modes(&chain(moduli, masses)) {
            Ok(found) => {
                prop_assert_eq!(found.modes.len(), 2);
                // The larger root in closed form, and the smaller by the product of both, k1 k2 / (m1 m2).
                let [k1, k2] = moduli.map(|modulus| modulus / 10.0);
                let half = 0.5 * ((k1 + k2) / masses[0] + k2 / masses[1]);
                let product = k1 / masses[0] * (k2 / masses[1]);
                let larger = half + (half * half - product).max(0.0).sqrt();
                let ratio = found.modes.omega_squared()[0] / (product / larger);
                prop_assert!((ratio - 1.0).abs() < UNLIKE_STIFFNESS, "{}", ratio);
            }
            Err(FileError::StiffnessRange { softest, stiffest, .. }) => {
                prop_assert!(stiffest.0 > 1e10 * softest.0);
                let (soft, stiff) = if unlike > 0.0 { (1, 2) } else { (2, 1) };
                prop_assert_eq!((softest.1, stiffest.1), (soft, stiff));
            }
            Err(FileError::LostModes { expected: 2, found: 1, lightest, heaviest }) => {
                prop_assert!(heaviest.0 > lightest.0);
                prop_assert_eq!(lightest.1, if light > 0.0 { "grid 2 x" } else { "grid 3 x" });
            }
            Err(error) => prop_assert!(false, "{}", error),
        }
    }
}

#[test]
fn parts_too_unlike_are_named() {
    for power in [14, 16] {
        let error =
            modes(&chain([1e6, 1e6 * 10.0_f64.powi(power)], [1.0; 2])).expect_err("too unlike");
        let stiff = 1e5 * 10.0_f64.powi(power);
        assert_eq!(
            error.to_string(),
            format!(
                "element 2 ({stiff:.3e} lbf/in) is more than 1e10 times as stiff as element 1 (1.000e5 lbf/in): double \
                 precision loses the softer one"
            )
        );
    }
    assert!(modes(&chain([1e6, 1e16], [1.0; 2])).is_ok());
    // Of elements alike the first is named.
    let both = chain([1e16, 1e5], [1.0; 2]) + "CONROD,3,1,2,1,1.\nCONROD,4,2,3,2,1.\n";
    let error = modes(&both).expect_err("too unlike").to_string();
    assert!(
        error.starts_with(
            "element 1 (1.000e15 lbf/in) is more than 1e10 times as stiff as element 2 (1.000e4"
        ),
        "{error}"
    );
    let error = modes(&chain([1e6; 2], [1.0, 1e-16])).expect_err("a mode is lost");
    assert_eq!(
        error.to_string(),
        "modes: found only 1 of 2, one for each mass that moves independently; frequencies some three million times \
         the lowest are lost, and the masses range from 1.000e-16 at grid 3 x to 1.000e0 at grid 2 x"
    );
}

#[test]
fn an_element_that_no_free_motion_stretches_may_be_stiff() {
    let deck = chain([1e6; 2], [1.0; 2]);
    let held = format!("{deck}GRID,4,,30.,0.,0.,,123\nCONROD,9,1,4,9,1.\nMAT1,9,1.+30,,.3\n");
    assert_eq!(modes(&held).unwrap(), modes(&deck).unwrap());
}

#[test]
fn numbers_beyond_the_range_are_refused() {
    for (modulus, mass, message) in [
        (
            "1.+306",
            "1.-6",
            "squared frequencies of entry (0, 0) is inf; it must be a finite number",
        ),
        (
            "1.-303",
            "1.+300",
            "deflections of entry (0, 0) is inf; it must be a finite number",
        ),
        (
            "1.+300",
            "1.-40",
            "modes: found only 0 of 1, one for each mass that moves independently; ",
        ),
    ] {
        let deck = format!("{ROD}CMASS2,7,{mass},2,1")
            .replace("MAT1,1,1.+6", &format!("MAT1,1,{modulus}"));
        let error = modes(&deck).expect_err("beyond the range").to_string();
        assert!(error.starts_with(message), "{error}");
    }
    // Together 2e308, which is no number.
    let pair = format!(
        "{ROD}GRID,3,,20.,0.,0.,,23\nMPC,1,3,1,-1.,2,1,1.\nCMASS2,7,1.+308,2,1\nCMASS2,8,1.+308,3,1"
    );
    let error = modes(&pair.replace("MAT1,1,1.+6", "MAT1,1,1.+13"))
        .expect_err("beyond the range")
        .to_string();
    assert_eq!(
        error,
        "mass of entry (0, 0) is inf; it must be a finite number"
    );
}

/// Twenty thousand masses, each hung on the one before it, as no dense matrix could hold them.
#[test]
fn a_long_chain_has_the_lowest_modes_of_the_closed_form() {
    let count = 20_000;
    let mut deck = String::from("GRID,1,,0.,0.,0.,,123\nPROD,1,1,.01\nMAT1,1,1.+6,,.3\n");
    for label in 2..=count + 1 {
        deck += &format!(
            "GRID,{label},,{0}.,0.,0.,,23\nCROD,{label},1,{0},{label}\nCONM2,{label},{label},,1.\n",
            label - 1
        );
    }
    let read = deck::read("chain", deck.as_bytes(), &[]).unwrap();
    let found = deck::modes(&read.model, 5).unwrap();
    assert_eq!((found.dof.len(), found.modes.len()), (count, 5));
    let expected = chain_eigenvalues(ChainEnds::FixedFree, count, 1e4, 1.0);
    for (found, expected) in found.modes.omega_squared().iter().zip(&expected) {
        assert_relative_eq!(*found, *expected, max_relative = DIFFERENCE_ROUND_OFF);
    }
}

#[test]
fn a_free_structure_has_its_rigid_body_modes_counted_and_left_out() {
    // Two masses and a rod between them: ω² = k(1/m₁ + 1/m₂).
    let free = "GRID,1,,0.,0.,0.,,23\nGRID,2,,10.,0.,0.,,23\nCONROD,1,1,2,1,1.\nMAT1,1,1.+4,,.3\n\
                CMASS2,7,.4,1,1\nCMASS2,8,.1,2,1";
    let found = modes(free).unwrap();
    assert_eq!((found.rigid_body, found.modes.len()), (1, 1));
    assert_relative_eq!(
        found.modes.omega_squared()[0],
        1000.0 * (2.5 + 10.0),
        max_relative = COUNTED_ROOT
    );
    // They move against each other, the lighter one four times as far.
    let ratio = found.modes.shapes()[1] / found.modes.shapes()[0];
    assert_relative_eq!(ratio, -4.0, max_relative = COUNTED_ROOT);
}

#[test]
fn a_stiff_link_of_a_free_structure_takes_none_of_its_vibrations() {
    // Four masses in a row on two springs of 1e4 and a link ten billion times as stiff.
    let free = "GRID,1,,0.,0.,0.,,23\nGRID,2,,10.,0.,0.,,23\nGRID,3,,20.,0.,0.,,23\nGRID,4,,30.,0.,0.,,23\n\
                CONROD,1,1,2,1,.01\nCONROD,2,2,3,1,.01\nCONROD,3,3,4,1,1.+8\nMAT1,1,1.+7,,.3\n\
                CONM2,1,1,,1.\nCONM2,2,2,,1.\nCONM2,3,3,,1.\nCONM2,4,4,,1.";
    let found = modes(free).unwrap();
    assert_eq!((found.rigid_body, found.modes.len()), (1, 3));
    // The last two masses move as one: a free chain of masses 1, 1 and 2, whose roots have this sum and product.
    let (k, m): (f64, [f64; 3]) = (1e4, [1.0, 1.0, 2.0]);
    let sum = k * (1.0 / m[0] + 2.0 / m[1] + 1.0 / m[2]);
    let product = k * k * (m[0] + m[1] + m[2]) / (m[0] * m[1] * m[2]);
    let root = (sum * sum / 4.0 - product).sqrt();
    for (found, expected) in found
        .modes
        .omega_squared()
        .iter()
        .zip([sum / 2.0 - root, sum / 2.0 + root])
    {
        assert_relative_eq!(*found, expected, max_relative = UNLIKE_STIFFNESS);
    }
    let frequencies = found.modes.frequencies_hz();
    assert_eq!(
        format!("{:.4} {:.4}", frequencies[0], frequencies[1]),
        "13.4975 26.5401"
    );
}
