//! What a study is known by, and which sensors and modes its samples leave out.

use super::job_errors::{placed, with};
use crate::common::jobs::{building, rods};
use corfem::job::{Study, Vary};

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
