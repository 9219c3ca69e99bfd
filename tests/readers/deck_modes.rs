//! Modes of decks whose answers are known in closed form.

use crate::prelude::*;

/// Two masses on two rods of 10 in and 1 in² from a fixed grid along x.
fn chain(moduli: [f64; 2], masses: [f64; 2]) -> String {
    let [[e, f], [m, n]] = [moduli, masses].map(|both| both.map(|own| large_real(own).unwrap()));
    format!(
        "GRID,1,,0.,0.,0.,,123\nGRID,2,,10.,0.,0.,,23\nGRID,3,,20.,0.,0.,,23\nCONROD,1,1,2,1,1.\nCONROD,2,2,3,2,1.\n\
         MAT1*,1,{e},,.3\nMAT1*,2,{f},,.3\nCMASS2*,7,{m},2,1\n*,,,,\nCMASS2*,8,{n},3,1\n*,,,,\n"
    )
}

properties! {
    /// However unlike the parts, the lowest mode is right and there are both, or one is counted as lost, or an error says which are too unlike.
    #[test]
    fn no_mode_is_lost_in_silence(
        stiff in -10.0..20.0_f64, unlike in -20.0..20.0_f64, heavy in -3.0..3.0_f64, light in -20.0..20.0_f64,
    ) {
        let moduli = [stiff, stiff + unlike].map(|power| nearest_in_field(10.0_f64.powf(power)));
        let masses = [heavy, heavy + light].map(|power| nearest_in_field(10.0_f64.powf(power)));
        match deck::modes(&read_deck(chain(moduli, masses))?.model, usize::MAX) {
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
