//! What a study is known by, and which sensors and modes its samples leave out.

use super::job_errors::{placed, with};
use crate::common::jobs::{building, rods};
use crate::common::tolerances::{MATRIX_ROUND_OFF, ROUND_OFF};
use corfem::job::{Study, Vary};
use corfem::sparse::random::split_mix_64;

/// The digest FNV-1a of 64 bits (RFC 9923) of bytes, from this first state.
fn fnv_1a(bytes: &[u8], first: u64) -> u64 {
    let mut state = first;
    for byte in bytes {
        state ^= u64::from(*byte);
        state = state.wrapping_mul(1_099_511_628_211);
    }
    state
}

const OFFSET: u64 = 14_695_981_039_346_656_037;

/// The published digests of a few words are those of the function above, and a study's is its chain over what the study is made of.
#[test]
fn a_study_is_known_by_the_digest_of_its_files_seed_and_choice() {
    for (word, published) in [
        ("", OFFSET),
        ("a", 0xaf63_dc4c_8601_ec8c),
        ("foobar", 0x8594_4171_f739_67e8),
    ] {
        assert_eq!(fnv_1a(word.as_bytes(), OFFSET), published, "{word}");
    }
    let (folder, path) = placed(&rods());
    let study = Study::new(&path, 7, &[Vary::Start, Vary::Noise], &[])
        .unwrap_or_else(|error| panic!("{error}"));
    let head = format!("{} 7 [Noise, Start]", env!("CARGO_PKG_VERSION"));
    let digest = ["model.bdf", "test.csv", "job.toml"].iter().fold(
        fnv_1a(head.as_bytes(), OFFSET),
        |before, name| {
            fnv_1a(
                &std::fs::read(folder.path().join(name)).expect("it reads"),
                before ^ OFFSET,
            )
        },
    );
    assert_eq!(study.identity, digest);
}

/// Of five sensors one to three are left out, and each of them sometimes is and sometimes is not; so of five modes.
#[test]
fn any_sensor_and_any_mode_may_be_left_out() {
    let (_folder, path) = placed(&building());
    let study =
        Study::new(&path, 3, &[Vary::Subset], &[]).unwrap_or_else(|error| panic!("{error}"));
    let (mut left, mut counts) = ([[[0; 2]; 5]; 2], [[0; 5]; 2]);
    for sample in 1..=60 {
        let (prepared, _) = study.draw(sample).expect("a draw");
        let sensors: Vec<usize> = prepared.placed.iter().map(|sensor| sensor.row).collect();
        let (what, there) = if sensors.len() < 5 {
            (0, &sensors)
        } else {
            (1, &prepared.modes)
        };
        counts[what][5 - there.len()] += 1;
        (0..5).for_each(|one| left[what][one][usize::from(there.contains(&one))] += 1);
    }
    assert!(
        counts
            .iter()
            .all(|counts| counts[0] == 0 && counts[1..=3].iter().all(|count| *count > 0)),
        "{counts:?}"
    );
    assert!(
        left.iter().flatten().flatten().all(|count| *count > 0),
        "{left:?}"
    );
}

/// Whether a sample is within tolerance is one of two words.
#[test]
fn a_sample_that_is_neither_within_nor_outside_is_refused() {
    let (folder, path) = placed(&with(
        rods(),
        "job.toml",
        "[compare]",
        "[compare]\nanalysis_modes = 3",
    ));
    let study = Study::new(&path, 7, &[Vary::Noise], &[]).unwrap_or_else(|error| panic!("{error}"));
    let samples = folder.path().join("samples.csv");
    let read = |within: &str| {
        std::fs::write(
            &samples,
            format!("1,cap,{within},0.5,3,1.0,1.0,{:016x}\n", study.identity),
        )
        .expect("written");
        corfem::job::Samples::read(&samples, &study)
    };
    assert!(read("true").is_ok() && read("false").is_ok());
    let error = read("yes").expect_err("neither").to_string();
    assert!(
        error.ends_with(
            "is not a sample with true or false, and error sum, analyses and factors as numbers"
        ),
        "{error}"
    );
}

/// The first numbers of SplitMix64 from the state 1234567, as other programs have them.
#[test]
fn the_generator_is_the_published_one() {
    let mut state = 1_234_567;
    let first: [u64; 5] = std::array::from_fn(|_| split_mix_64(&mut state));
    assert_eq!(
        first,
        [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
            4_593_380_528_125_082_431,
            16_408_922_859_458_223_821,
        ]
    );
}

/// What a seed draws never changes, so that a study can be made again years later. The numbers are those of another program
/// (Python), by the same formulas: SplitMix64 from the chain over seed, sample and purpose, Box and Muller's variates of it.
#[test]
fn a_seed_draws_the_same_numbers_for_ever() {
    let deviations = "[compare]\nfrequency_deviation = 0.004\nshape_deviation = 0.02";
    let files = with(rods(), "job.toml", "[compare]", deviations);
    let (_folder, path) = placed(&files);
    let study = Study::new(&path, 7, &[Vary::Noise, Vary::Start], &[])
        .unwrap_or_else(|error| panic!("{error}"));
    for (sample, starts, noise) in [
        (
            1,
            [0.578_517_841_861_954_4, 1.215_369_512_003_140_7],
            [
                1.145_340_083_225_18,
                -1.203_320_818_533_592,
                -0.130_233_393_019_648,
            ],
        ),
        (
            2,
            [0.595_383_019_058_052_9, 1.563_193_270_121_229_7],
            [
                1.020_072_602_348_639_7,
                -1.197_088_354_473_382_4,
                -1.807_835_125_549_679_2,
            ],
        ),
    ] {
        let (drawn, start) = study.draw(sample).expect("a draw");
        for (found, expected) in start.iter().zip(starts) {
            assert!((found - expected).abs() <= ROUND_OFF, "{sample}: {start:?}");
        }
        let exact = &study.loaded.data.frequencies_hz;
        for ((drawn, exact), variate) in drawn.data.frequencies_hz.iter().zip(exact).zip(noise) {
            let found = (drawn / exact - 1.0) / 0.004;
            assert!(
                (found - variate).abs() <= MATRIX_ROUND_OFF,
                "{sample}: {found}"
            );
        }
    }
    let (_folder, path) = placed(&building());
    let study =
        Study::new(&path, 3, &[Vary::Subset], &[]).unwrap_or_else(|error| panic!("{error}"));
    for (sample, is_sensors, kept) in [
        (1, true, &[0, 1, 3, 4][..]),
        (2, true, &[0, 1, 2, 3]),
        (3, true, &[1, 3]),
        (4, false, &[0, 3, 4]),
        (5, true, &[1, 2, 3, 4]),
        (6, false, &[0, 1, 4]),
    ] {
        let (drawn, _) = study.draw(sample).expect("a draw");
        let sensors: Vec<usize> = drawn.placed.iter().map(|sensor| sensor.row).collect();
        let found = if is_sensors { &sensors } else { &drawn.modes };
        assert_eq!(
            (&found[..], sensors.len() < 5),
            (kept, is_sensors),
            "{sample}"
        );
    }
}
