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
