//! Modes of decks whose answers are known in closed form.

use crate::prelude::*;

fn modes(text: &str) -> Result<WholeModes, FileError> {
    deck::modes(&read_deck(text)?.model, usize::MAX)
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
    /// However unlike the parts, the lowest mode is right and there are both, or one is counted as lost, or an error says which are too unlike.
    #[test]
    fn no_mode_is_lost_in_silence(
        stiff in -10.0..20.0_f64, unlike in -20.0..20.0_f64, heavy in -3.0..3.0_f64, light in -20.0..20.0_f64,
    ) {
        let moduli = [stiff, stiff + unlike].map(|power| nearest_in_field(10.0_f64.powf(power)));
        let masses = [heavy, heavy + light].map(|power| nearest_in_field(10.0_f64.powf(power)));
        match modes(&chain(moduli, masses)) {
            Ok(found) => {
                // The larger root in closed form, and the smaller by the product of both, k1 k2 / (m1 m2).
                let [k1, k2] = moduli.map(|modulus| modulus / 10.0);
                let half = 0.5 * ((k1 + k2) / masses[0] + k2 / masses[1]);
                let product = k1 / masses[0] * (k2 / masses[1]);
                let larger = half + (half * half - product).max(0.0).sqrt();
                // A frequency some three million times the other, with a root of its square, may be lost and is counted.
                let is_lost = found.modes.len() == 1 && found.counted == Some(2) && larger * larger / product > 1e12;
                prop_assert!(found.modes.len() == 2 || is_lost, "{:?} {}", found.counted, larger * larger / product);
                let ratio = found.modes.omega_squared()[0] / (product / larger);
                prop_assert!((ratio - 1.0).abs() < UNLIKE_STIFFNESS, "{}", ratio);
            }
            Err(FileError::Refused { of, reason }) => {
                prop_assert!(unlike.abs() > 9.9);
                let (soft, stiff) = if unlike > 0.0 { (1, 2) } else { (2, 1) };
                prop_assert!(of.starts_with(&format!("element {stiff} (")), "{}", of);
                prop_assert!(reason.contains(&format!("as element {soft} (")), "{}", reason);
            }
            Err(error) => prop_assert!(false, "{}", error),
        }
    }
}

/// As many modes as there are degrees of freedom with mass are all, and are known to be.
#[test]
fn modes_of_every_degree_of_freedom_with_mass_are_counted() {
    let model = read_deck(chain([1e6; 2], [0.1, 0.2])).unwrap().model;
    let counted = [1, 2, 3].map(|most| deck::modes(&model, most).unwrap().counted);
    assert_eq!(counted, [None, Some(2), Some(2)]);
}

/// The 72-bar truss, held at its four feet: the deck testing/system_verification/004_72_bar_truss of the public repository
/// vtpasquale/NASTRAN_CoFE, and the frequencies that MSC Nastran 2019 printed for it, with two pairs that symmetry makes alike.
///
/// ```text
///   1 -- 2      z = 240, four stories of 60; a square of side 120 in each of the five levels,
///   | \/ |      numbered around; in every story 4 posts, 8 diagonals in its walls, 4 sides and
///   | /\ |      2 diagonals of the level above, one property each
///   4 -- 3
/// ```
#[test]
fn the_72_bar_truss_has_the_printed_frequencies() {
    let printed = [
        25.45570, 25.45570, 38.94089, 68.55535, 73.70520, 73.70520, 111.0227, 127.6247, 136.6591,
        136.6591,
    ];
    let mut deck = String::from("MDLPRM,HDF5,0\nMAT1,101,1.+7,3759398.,.33,2.59-4\n");
    for label in 1..=20 {
        let (x, y) = [(0, 0), (120, 0), (120, 120), (0, 120)][(label - 1) % 4];
        let z = 240 - 60 * ((label - 1) / 4);
        let held = if z == 0 { "123456" } else { "456" };
        deck += &format!("GRID,{label},0,{x}.,{y}.,{z}.,0\nSPC1,1,{held},{label}\n");
    }
    let mut rods = 0;
    for story in 0..4 {
        let (top, next) = (
            |of: usize| 4 * story + 1 + of % 4,
            |of: usize| 4 * story + 5 + of % 4,
        );
        let around = |from: &dyn Fn(usize) -> [usize; 2]| (0..4).map(from).collect_vec();
        let walls = [
            around(&|of| [top(of + 1), next(of)]),
            around(&|of| [top(of), next(of + 1)]),
        ];
        let parts = [
            around(&|of| [top(of), next(of)]),
            walls.concat(),
            around(&|of| [top(of), top(of + 1)]),
            vec![[top(0), top(2)], [top(1), top(3)]],
        ];
        for (part, ends) in parts.iter().enumerate() {
            let property = 4 * story + part + 1;
            deck += &format!("PROD,{property},101,.5,999.\n");
            for [a, b] in ends {
                rods += 1;
                deck += &format!("CROD,{rods},{property},{a},{b}\n");
            }
        }
    }
    assert_eq!(rods, 72);
    let found = deck::modes(&read_deck(deck).unwrap().model, printed.len()).unwrap();
    assert_eq!(found.modes.len(), printed.len());
    for (found, printed) in found.modes.frequencies_hz().iter().zip(printed) {
        assert_relative_eq!(*found, printed, max_relative = PRINTED_SEVEN_DIGITS);
    }
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
