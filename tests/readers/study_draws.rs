//! What a study is known by, and which sensors and modes its samples leave out.

use crate::prelude::*;
use corfem::job::{Study, Vary};
use sha2::{Digest, Sha256};

/// Bytes in hexadecimal.
fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The digest is over what the study is made of, each part after its length.
#[test]
fn a_study_is_known_by_the_digest_of_its_files_seed_and_choice() {
    let (folder, path) = placed(&rods());
    let identity = || {
        Study::new(&path, 7, &[Vary::Start, Vary::Noise], &[])
            .unwrap()
            .identity
    };
    let head = format!("{} 7 [Noise, Start]", env!("CARGO_PKG_VERSION"));
    let names = ["model.bdf", "test.csv", "job.toml"].map(|name| folder.path().join(name));
    let file = |path: &PathBuf| fs::read(path).unwrap();
    let mut all = Vec::new();
    for part in once(head.into_bytes()).chain(names.iter().map(file)) {
        all.extend((part.len() as u64).to_be_bytes());
        all.extend(part);
    }
    assert_eq!(identity(), hexadecimal(&Sha256::digest(&all)[..16]));
    // An empty line at the end of one file, or at the beginning of the next.
    let texts = names.each_ref().map(file);
    let with_line = |at: usize, place: usize| {
        let mut text = texts[at].clone();
        text.insert(place, b'\n');
        fs::write(&names[at], text).unwrap();
        let identity = identity();
        fs::write(&names[at], &texts[at]).unwrap();
        identity
    };
    assert_ne!(with_line(1, texts[1].len()), with_line(2, 0));
}

/// Of five sensors one to three are left out, and each of them sometimes is and sometimes is not; so of five modes.
#[test]
fn any_sensor_and_any_mode_may_be_left_out() {
    let (_folder, path) = placed(&building());
    let study = Study::new(&path, 3, &[Vary::Subset], &[]).unwrap();
    let (mut left, mut counts) = ([[[0; 2]; 5]; 2], [[0; 5]; 2]);
    for sample in 1..=60 {
        let (prepared, _) = study.draw(sample).unwrap();
        let sensors = prepared
            .loaded
            .placed
            .iter()
            .map(|sensor| sensor.row)
            .collect_vec();
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

/// What a seed draws never changes, so that a study can be made again years later. The numbers are those of another program
/// (Python), by the same formulas: SplitMix64 from the chain over seed, sample and purpose, Box and Muller's variates of it.
#[test]
fn a_seed_draws_the_same_numbers_for_ever() {
    let deviations = "[compare]\nfrequency_deviation = 0.004\nshape_deviation = 0.02";
    let files = rods_with("[compare]", deviations);
    let (_folder, path) = placed(&files);
    let study = Study::new(&path, 7, &[Vary::Noise, Vary::Start], &[]).unwrap();
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
        let (drawn, start) = study.draw(sample).unwrap();
        for (found, expected) in start.iter().zip(starts) {
            assert_within(found, expected, ROUND_OFF);
        }
        let exact = &study.prepared.loaded.data.frequencies_hz;
        for ((drawn, exact), variate) in drawn
            .loaded
            .data
            .frequencies_hz
            .iter()
            .zip(exact)
            .zip(noise)
        {
            let found = (drawn / exact - 1.0) / 0.004;
            assert_within(found, variate, MATRIX_ROUND_OFF);
        }
    }
    let (_folder, path) = placed(&building());
    let study = Study::new(&path, 3, &[Vary::Subset], &[]).unwrap();
    for (sample, is_sensors, kept) in [
        (1, true, &[0, 1, 3, 4][..]),
        (2, true, &[0, 1, 2, 3]),
        (3, true, &[1, 3]),
        (4, false, &[0, 3, 4]),
        (5, true, &[1, 2, 3, 4]),
        (6, false, &[0, 1, 4]),
    ] {
        let (drawn, _) = study.draw(sample).unwrap();
        let sensors = drawn
            .loaded
            .placed
            .iter()
            .map(|sensor| sensor.row)
            .collect_vec();
        let found = if is_sensors { &sensors } else { &drawn.modes };
        assert_eq!(
            (&found[..], sensors.len() < 5),
            (kept, is_sensors),
            "{sample}"
        );
    }
}
