//! Many runs of a job: what is drawn, what a file of samples must be, and what its numbers come to.

use crate::common::jobs::{folder_of, rods};
use crate::prelude::*;
use corfem::job::{Samples, Study, Summary, Vary};
use std::io::Write;

/// A job in a folder of its own.
struct Place {
    folder: tempfile::TempDir,
    job: PathBuf,
}

impl Place {
    fn of(files: Files) -> Self {
        let folder = new_folder();
        for (name, text) in files {
            fs::write(folder.path().join(name), text).unwrap();
        }
        let job = folder.path().join("job.toml");
        Self { folder, job }
    }

    fn study(&self, seed: u64, vary: &[Vary]) -> Study {
        Study::new(&self.job, seed, vary, &[]).unwrap()
    }
}

/// The statistics of the samples of a text up to number `last`.
fn summary(study: &Study, text: &str, last: u64) -> Result<Summary, FileError> {
    let mut file = tempfile::NamedTempFile::new().unwrap();
    file.write_all(text.as_bytes()).unwrap();
    Ok(Samples::read(file.path(), study)?.summary(study, last))
}

/// The lines of the first samples.
fn lines(study: &Study, count: u64) -> Vec<String> {
    (1..=count)
        .map(|sample| study.run(sample, || true).unwrap().0)
        .collect()
}

fn factors(line: &str) -> Vec<f64> {
    let cells = line.split(',').collect_vec();
    cells[5..cells.len() - 1]
        .iter()
        .map(|cell| cell.parse().unwrap())
        .collect()
}

/// A study of the rods with their own job of Gauss-Newton steps, and six samples of it.
fn rod_study() -> &'static (Study, Vec<String>) {
    static STUDY: OnceLock<(Study, Vec<String>)> = OnceLock::new();
    STUDY.get_or_init(|| {
        let study = Place::of(rods()).study(7, &[Vary::Noise]);
        let lines = lines(&study, 6);
        (study, lines)
    })
}

#[test]
fn a_sample_is_the_same_whatever_ran_before_and_another_than_its_neighbor() {
    let (place, (study, lines)) = (Place::of(rods()), rod_study());
    let again = place.study(7, &[Vary::Noise, Vary::Noise]);
    for sample in [5, 2, 6] {
        assert_eq!(
            again.run(sample, || true).unwrap().0,
            lines[sample as usize - 1]
        );
    }
    let all = lines.iter().map(|line| factors(line)).collect_vec();
    assert!(
        (1..all.len()).all(|row| !all[..row].contains(&all[row])),
        "{all:?}"
    );
    let (test, other) = (
        &study.draw(1).unwrap().0.test,
        &place.study(8, &[Vary::Noise]),
    );
    assert_ne!(*test, other.draw(1).unwrap().0.test, "of another seed");
}

/// What else varies changes nothing of the noise, and a start nothing of the test.
#[test]
fn noise_start_and_subset_are_drawn_independently() {
    let place = Place::of(building());
    let all = [Vary::Subset, Vary::Start, Vary::Noise];
    let (noise, start_alone, subset) = (
        place.study(1, &all[2..]),
        place.study(1, &all[1..2]),
        place.study(1, &all[..1]),
    );
    let together = place.study(1, &all);
    let (mut fewer_sensors, mut fewer_modes) = (0, 0);
    for sample in 1..=40 {
        let [noise, start, subset, together] =
            [&noise, &start_alone, &subset, &together].map(|study| study.draw(sample).unwrap());
        assert_eq!(
            (&noise.0.loaded.data, &start.1),
            (&together.0.loaded.data, &together.1)
        );
        assert_eq!(start.0.test, start_alone.prepared.test);
        assert_eq!(subset.0.loaded.job, together.0.loaded.job);
        assert_eq!((noise.1, subset.1), (vec![1.0; 10], vec![1.0; 10]));
        assert!(start.1.iter().all(|factor| (0.5..2.0).contains(factor)));
        let (sensors, modes) = (subset.0.loaded.placed.len(), subset.0.test.len());
        assert!(
            sensors == 5 || modes == 5,
            "{sensors} sensors, {modes} modes"
        );
        assert!(
            (2..=5).contains(&sensors) && (2..=5).contains(&modes),
            "half of either are left: {sensors}, {modes}"
        );
        fewer_sensors += usize::from(sensors < 5);
        fewer_modes += usize::from(modes < 5);
    }
    assert!(
        fewer_sensors >= 10 && fewer_modes >= 10,
        "{fewer_sensors} {fewer_modes}"
    );
}

/// A component is off by as many deviations of its own, in its own mode, as it would be of all components' mean.
#[test]
fn components_are_drawn_by_their_own_deviations() {
    let off = |edit: &dyn Fn(&mut TestData)| {
        let study = Place::of(retested(building(), edit)).study(5, &[Vary::Noise]);
        let drawn = study.draw(1).unwrap().0;
        &drawn.loaded.data.shapes - &study.prepared.loaded.data.shapes
    };
    let (own, times) = (
        dvector![0.01, 0.05, 0.03, 0.02, 0.04],
        [1.0, 3.0, 2.0, 5.0, 4.0],
    );
    let mean = own.norm() / 5.0_f64.sqrt();
    let alike = off(&|data| data.shape_deviation = Some(vec![mean; 5]));
    let each = |data: &mut TestData| {
        let of_mode = |mode| (mode, times[mode] * &own);
        data.component_deviation = (0..5).map(of_mode).collect();
    };
    let expected = diagonal((&own / mean).as_slice()) * alike * diagonal(times);
    assert_relative_eq!(off(&each), expected, epsilon = ROUND_OFF);
}

/// The weights of a job stand for the modes of a subset as for all of them.
#[test]
fn a_subset_of_the_modes_takes_their_weights_along() {
    let weights =
        "method = \"gauss_newton\"\nfrequency_weights = [1, 2, 3]\nshape_weights = [4, 5, 6]";
    let edit =
        |(name, text): (String, String)| (name, text.replace("method = \"gauss_newton\"", weights));
    let place = Place::of(rods().into_iter().map(edit).collect());
    let study = place.study(1, &[Vary::Subset]);
    let whole = study.prepared.weights();
    let mut fewer = 0;
    for sample in 1..=20 {
        let (prepared, _) = study.draw(sample).unwrap();
        let weights = prepared.weights();
        assert_eq!(
            weights,
            prepared.modes.iter().map(|&mode| whole[mode]).collect_vec()
        );
        fewer += usize::from(prepared.modes.len() < 3);
    }
    assert!(fewer > 3, "{fewer}");
}

/// From a start within its bounds, with an exact test, the same building is found.
#[test]
fn a_start_is_brought_within_bounds_and_leads_to_the_same_rods() {
    let edit = |(name, text): (String, String)| {
        (
            name,
            text.replace("elements = [1]", "elements = [1]\nlower = 0.6\nupper = 1.1"),
        )
    };
    let place = Place::of(rods().into_iter().map(edit).collect());
    let study = place.study(2, &[Vary::Start]);
    let found = lines(&study, 8)
        .iter()
        .map(|line| factors(line))
        .collect_vec();
    let starts = (1..=8)
        .map(|sample| study.draw(sample).unwrap().1)
        .collect_vec();
    assert!(
        starts.iter().all(|start| (0.6..=1.1).contains(&start[0])),
        "{starts:?}"
    );
    assert!(
        starts.iter().any(|start| [0.6, 1.1].contains(&start[0])),
        "{starts:?}"
    );
    assert!(
        found
            .iter()
            .all(|found| (found[0] / found[1] - 0.77).abs() < 0.1),
        "{found:?}"
    );
    let paper =
        |(name, text): (String, String)| (name, text.replace("method = \"gauss_newton\"", ""));
    let place = Place::of(rods().into_iter().map(edit).map(paper).collect());
    let study = place.study(2, &[Vary::Start]);
    for line in lines(&study, 8) {
        assert!(
            (0.6..=1.1).contains(&factors(&line)[0]),
            "the bounds are those of the first model: {line}"
        );
    }
}

/// Over samples the factors scatter as the intervals of one correlation say, and their own intervals hold the truth.
#[test]
fn factors_scatter_as_one_correlation_says_they_do() {
    const COUNT: u64 = 60;
    let precise = "analysis_modes = 10\nmethod = \"gauss_newton\"\nfrequency_deviation = 2e-4\nshape_deviation = 5e-4";
    let edit =
        |(name, text): (String, String)| (name, text.replace("analysis_modes = 10", precise));
    let place = Place::of(building().into_iter().map(edit).collect());
    let study = place.study(3, &[Vary::Noise]);
    let found = finished(&study.prepared);
    let text = lines(&study, COUNT).concat();
    let summary = summary(&study, &text, COUNT).unwrap();
    assert_eq!(
        (summary.within + summary.outside, summary.failed.len()),
        (COUNT as usize, 0)
    );
    for (story, (name, spread)) in summary.spreads.iter().enumerate() {
        let spread = spread.as_ref().unwrap();
        assert!(
            spread.quantiles[0] < STORIES[story] && STORIES[story] < spread.quantiles[2],
            "{name}: {spread:?}"
        );
        // Of the logarithm of a factor, and a sample's own deviation has an error of one in the root of 2 (n - 1).
        let ratio = spread.deviation / (found.found.factors[story] * found.seen.deviations[story]);
        let most = STANDARD_ERRORS / (2.0 * (COUNT - 1) as f64).sqrt();
        assert_within(ratio, 1.0, most);
    }
}

/// Quantiles and bars of a few numbers, by hand.
#[test]
fn a_summary_counts_what_its_file_has_up_to_the_last_sample() {
    let (study, _) = rod_study();
    let line = |sample: u64, is_within: bool, factor: f64| {
        format!(
            "{sample},cap,{is_within},0.5,3,{factor},1,{}\n",
            study.identity
        )
    };
    let failed = format!("4,failed,,,,,,{}\n", study.identity);
    let text = [
        line(5, true, 3.0),
        line(1, true, 1.0),
        failed,
        line(3, false, 2.0),
        line(2, true, 4.0),
        line(9, true, 99.0),
    ];
    let found = summary(study, &text.concat(), 8).unwrap();
    assert_eq!(
        (found.within, found.outside, &found.failed[..]),
        (3, 1, &[4][..])
    );
    let [(a, Some(first)), (b, Some(second))] = &found.spreads[..] else {
        panic!("{found:?}")
    };
    assert_eq!((&a[..], &b[..]), ("a", "b"));
    assert_eq!((first.count, first.mean, first.quantiles[1]), (4, 2.5, 2.5));
    assert_eq!(first.deviation, (5.0_f64 / 3.0).sqrt());
    assert!(
        (first.quantiles[0] - 1.075).abs() < f64::EPSILON
            && (first.quantiles[2] - 3.925).abs() < 4.0 * f64::EPSILON
    );
    assert_eq!((second.deviation, second.quantiles), (0.0, [1.0; 3]));
    let none = summary(study, "", 8).unwrap();
    assert_eq!(none.spreads[0].1, None);
}

#[test]
fn a_summary_counts_the_samples_at_an_end_of_a_factors_range() {
    let bounded = "elements = [1]\nlower = 0.5\nupper = 2.0";
    let place = Place::of(rods_with("elements = [1]", bounded));
    let study = &place.study(7, &[Vary::Noise]);
    let line = |(sample, factor): (usize, f64)| {
        format!("{sample},cap,true,0.5,3,{factor},2,{}\n", study.identity)
    };
    let text: String = [(1, 0.5), (2, 1.9), (3, 2.0)].map(line).concat();
    let found = summary(study, &text, 3).unwrap();
    let counts = found.spreads.iter().map(|(_, spread)| {
        let spread = spread.as_ref().unwrap();
        (spread.count, spread.at_bound)
    });
    assert_eq!(counts.collect_vec(), [(3, 2), (3, 0)]);
}

#[test]
fn what_does_not_belong_to_a_study_is_refused_by_its_line() {
    let place = Place::of(rods());
    let study = &place.study(7, &[Vary::Noise]);
    let lines = lines(study, 2);
    let good = study.header() + &lines[0];
    let other = |seed, vary: &[Vary]| {
        let other = place.study(seed, vary);
        (
            other.run(1, || true).unwrap().0,
            "a sample of this job, seed and choice of what varies",
        )
    };
    let no_line = "is not a line of a sample of this study";
    let [within, sum] = [2, 5].map(|cell| lines[1].split(',').nth(cell).unwrap());
    for (text, expected) in [
        other(8, &[Vary::Noise]),
        other(7, &[Vary::Start]),
        other(7, &[Vary::Noise, Vary::Start]),
        ("hello\n".to_owned(), no_line),
        (lines[1].replacen(',', "", 1), no_line),
        (lines[1].replacen("2,", "-2,", 1), no_line),
        (
            lines[1].replacen(within, "yes", 1),
            "is not a sample with true or false",
        ),
        (
            lines[1].replace(sum, "inf"),
            "error sum, analyses and factors as numbers",
        ),
        (
            lines[0].replacen(",local", ",  local", 1),
            "is not what another line says of this sample",
        ),
    ] {
        let said = said(summary(study, &(good.clone() + &text), 2).map(|_| ""));
        assert!(
            said.contains(", line 3: ") && said.contains(expected),
            "{said}"
        );
    }
    // Another first byte of any file is another job.
    let identity = || place.study(7, &[Vary::Noise]).identity;
    for name in ["job.toml", "test.csv", "model.bdf"] {
        let path = place.folder.path().join(name);
        let before = fs::read(&path).unwrap();
        fs::write(&path, [&before[..], b"\n"].concat()).unwrap();
        assert_ne!(identity(), study.identity, "{name}");
        fs::write(&path, before).unwrap();
    }
    assert_eq!(identity(), study.identity);
}

/// A sample that cannot be run is a result, and its line reads.
#[test]
fn a_sample_that_fails_says_why_and_counts_as_done() {
    let edit = |(name, text): (String, String)| {
        (
            name,
            text.replace("[compare]", "[compare]\nfrequency_deviation = 5.0"),
        )
    };
    let place = Place::of(rods().into_iter().map(edit).collect());
    let study = place.study(1, &[Vary::Noise]);
    let failed = (1..=10)
        .map(|sample| study.run(sample, || true).unwrap())
        .filter(|(_, why)| why.is_some())
        .collect_vec();
    assert!(!failed.is_empty());
    for (line, why) in &failed {
        assert!(
            line.contains(",failed,")
                && why
                    .as_ref()
                    .is_some_and(|why| why.to_string().contains("positive")),
            "{why:?}"
        );
    }
    let text: String = failed.iter().map(|(line, _)| line.as_str()).collect();
    let summary = summary(&study, &text, 10).unwrap();
    assert_eq!(summary.failed.len(), failed.len());
}

#[test]
fn a_request_to_stop_leaves_no_line() {
    let (study, _) = rod_study();
    assert!(matches!(
        study.run(1, || false),
        Err(FileError::Interrupted)
    ));
}

/// None of 200 noisy tests of the building leaves the factors where they began.
#[test]
fn no_noisy_test_of_the_building_is_stuck_at_the_start() {
    let path = folder_of("building").join("job.toml");
    let study = Study::new(&path, 27, &[Vary::Noise], &[]).unwrap();
    for sample in 0..200 {
        let (line, error) = study.run(sample, || true).unwrap();
        assert!(error.is_none(), "{line} {error:?}");
        let cells = line.split(',').collect_vec();
        assert_ne!(cells[1], "nothing", "{line}");
        let analyses: usize = cells[4].parse().unwrap();
        let factors = cells[5..15].iter().map(|cell| cell.parse::<f64>().unwrap());
        assert!(
            analyses > 1 && factors.clone().all(|factor| factor != 1.0),
            "{line}"
        );
    }
}

properties! {
    #![proptest_config(costly_config())]

    /// Cut anywhere and gone on with, a file has every sample once, and the same summary.
    #[test]
    fn a_file_cut_at_any_byte_is_gone_on_with(share in 0.0..1.0_f64, order in Just((0..6).collect::<Vec<usize>>()).prop_shuffle()) {
        let (study, lines) = rod_study();
        let folder = new_folder();
        let path = folder.path().join("samples.csv");
        let whole = study.header() + &order.iter().map(|&row| lines[row].as_str()).collect::<String>();
        fs::write(&path, &whole).unwrap();
        let expected = Samples::read(&path, study).unwrap().summary(study, 6);
        let cut = (share * whole.len() as f64) as usize;
        fs::write(&path, &whole[..cut]).unwrap();
        let found = Samples::read(&path, study).unwrap();
        prop_assert_eq!(found.whole as usize, whole[..cut].rfind('\n').map_or(0, |end| end + 1));
        let missing = (1..=6).filter(|&sample| !found.contains(sample));
        let more: String = missing.map(|sample| lines[sample as usize - 1].as_str()).collect();
        // Other machines' files behind it, with headers of their own and samples that are there already.
        let text = whole[..found.whole as usize].to_owned() + &more + &study.header() + &lines[order[0]] + "\r\n";
        fs::write(&path, text).unwrap();
        let samples = Samples::read(&path, study).unwrap();
        prop_assert_eq!(samples.summary(study, 6), expected);
    }
}
