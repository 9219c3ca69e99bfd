//! Rods in a row against the closed forms of chains and of the uniform rod.

use crate::common::closed_forms::analytical::fixed_free_rod_frequencies_hz;
use crate::prelude::*;
use corfem::method::modes;

properties! {
    /// The whole way: rods, assembly, factorization, condensation with T the identity, and modes.
    #[test]
    fn rods_in_a_row_have_the_spectrum_of_a_chain(
        count in 1..12_usize,
        spring in 1.0..1e6_f64,
        mass in 1e-3..1e3_f64,
        both in prop::bool::ANY,
    ) {
        let (ends, springs) = match both {
            true => (ChainEnds::FixedFixed, count + 1),
            false => (ChainEnds::FixedFree, count),
        };
        let structure = spring_chain(&vec![spring; springs], [true, both]);
        let condensed = condense(&dense(&structure), &eye(count))?;
        let found = modes::solve(&condensed.stiffness, &(mass * eye(count)), count)?;
        let expected = chain_eigenvalues(ends, count, spring, mass);
        prop_assert_eq!(found.len(), expected.len());
        let bar = CONDITIONED_ROUND_OFF * expected[count - 1] / expected[0];
        for (found, expected) in found.omega_squared().iter().zip(&expected) {
            prop_assert!(relative_error(found, expected) <= bar, "{found} {expected}");
        }
    }

    /// Without supports the stiffness is singular, its first eigenvalue zero.
    #[test]
    fn a_free_chain_has_a_rigid_body_motion(count in 2..12_usize, spring in 1.0..1e6_f64) {
        let structure = spring_chain(&vec![spring; count - 1], [false, false]);
        let mut found = dense(&structure).symmetric_eigenvalues().iter().copied().collect_vec();
        found.sort_by(f64::total_cmp);
        let expected = chain_eigenvalues(ChainEnds::FreeFree, count, spring, 1.0);
        prop_assert_eq!(expected[0], 0.0);
        prop_assert_eq!(found.len(), count);
        for (found, expected) in found.iter().zip(&expected) {
            prop_assert!((found - expected).abs() <= MATRIX_ROUND_OFF * spring);
        }
    }
}

/// A uniform rod cut into n elements of lumped mass, half at the free end: frequencies tend to the closed form's with
/// the square of the element length.
#[test]
fn a_rod_cut_finer_tends_to_the_uniform_rod_with_order_two() {
    let (length, modulus, density, area) = (12.0, 1e7, 2.5e-4, 0.3);
    let expected = fixed_free_rod_frequencies_hz(length, modulus, density, 3);
    assert_eq!(expected.len(), 3);
    let errors: Vec<(f64, Vec<f64>)> = [8, 16, 32, 64]
        .map(|count| {
            let piece = length / count as f64;
            let structure = spring_chain(&vec![modulus * area / piece; count], [true, false]);
            assert_eq!(sizes(&structure).len(), count);
            let mut masses = DVector::from_element(count, density * area * piece);
            masses[count - 1] /= 2.0;
            let condensed = condense(&dense(&structure), &eye(count)).unwrap();
            let found =
                modes::solve(&condensed.stiffness, &DMatrix::from_diagonal(&masses), 3).unwrap();
            let error = found
                .frequencies_hz()
                .iter()
                .zip(&expected)
                .map(|(f, e)| 1.0 - f / e)
                .collect();
            (piece, error)
        })
        .to_vec();
    for mode in 0..3 {
        let points = errors
            .iter()
            .map(|(piece, error)| (*piece, error[mode]))
            .collect_vec();
        let slope = log_log_slope(&points);
        assert_within(slope, 2.0, SLOPE);
    }
}

/// A quarter wave fits the rod: at 200 000 in/s and 12 in that is 4166.67 Hz, then three and five times as much.
#[test]
fn a_rods_first_frequency_is_a_quarter_wave() {
    let found = fixed_free_rod_frequencies_hz(12.0, 1e7, 2.5e-4, 3);
    for (found, waves) in found.iter().zip([1.0, 3.0, 5.0]) {
        assert_alike([found], [(waves * 200_000.0 / 48.0)], MATRIX_ROUND_OFF);
    }
    assert!(fixed_free_rod_frequencies_hz(12.0, 1e7, 2.5e-4, 0).is_empty());
    assert!(chain_eigenvalues(ChainEnds::FixedFree, 0, 1.0, 1.0).is_empty());
}
