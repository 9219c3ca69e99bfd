//! A user's reading of a run: laws and golden runs read every job through it, and it alone knows how the program tells a result.

use crate::prelude::*;

/// What `corfem correlate` says of a job.
#[derive(Debug, Clone, Default)]
pub struct Answer {
    /// The exit status.
    pub status: i32,
    /// The best factors; none of a job that is refused.
    pub factors: Vec<f64>,
    /// The standard deviations of the factors; none of those that the prior knows rather than the test.
    pub deviations: Vec<Option<f64>>,
    /// The ends of the 95 % intervals; none where one is withheld.
    pub intervals: Vec<Option<[f64; 2]>>,
    /// Identifiers of doubts and of test modes that are not compared, in alphabetical order.
    pub doubts: Vec<String>,
    /// Frequencies of the best model's partners of the test modes, Hz.
    pub frequencies: Vec<f64>,
    /// True if steps ended where the objective is stationary.
    pub is_stationary: bool,
    /// The sum of squares of the residuals, in deviations.
    pub chi_squared: f64,
    /// Everything that is said: the report, or the words of the refusal.
    pub words: String,
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

/// What a command of the program prints of a job in a format.
pub fn printed(command: &str, job: &Path, format: &str) -> std::process::Output {
    let mut program = assert_cmd::Command::cargo_bin("corfem").unwrap();
    let program = program.arg(command).arg(job);
    program.args(["-q", "-f", format]).output().unwrap()
}

/// The program's answer to the files of a job.
pub fn answered(files: &Files) -> Answer {
    let (_folder, path) = placed(files);
    answer(&path)
}

/// The program's answer to a job.
pub fn answer(job: &Path) -> Answer {
    let output = printed("correlate", job, "json");
    let status = output.status.code().unwrap();
    let Ok(found) = serde_json::from_slice::<Value>(&output.stdout) else {
        return Answer {
            status,
            words: String::from_utf8(output.stderr).unwrap(),
            ..Answer::default()
        };
    };
    // A check has concerns alone.
    let rows = |kind: &str| found[kind].as_array().cloned().unwrap_or_default();
    let parameters = rows("parameters");
    let interval = |own: &Value| Some([own["low"].as_f64()?, own["high"].as_f64()?]);
    // Those of the factors themselves, where an interval tells them.
    let deviation = |own: &Value| {
        interval(own)?;
        Some(0.01 * number(&own["factor"]) * number(&own["deviation_percent"]))
    };
    let is_against = |own: &&Value| own["grade"] == "doubt" || own["grade"] == "left out";
    let against = rows("concerns");
    let shaped = rows("modes")
        .into_iter()
        .filter(|own| own["corrected_mac"].is_number());
    Answer {
        status,
        factors: parameters
            .iter()
            .map(|own| number(&own["factor"]))
            .collect(),
        deviations: parameters.iter().map(deviation).collect(),
        intervals: parameters.iter().map(interval).collect(),
        doubts: against
            .iter()
            .filter(is_against)
            .map(|own| own["identifier"].as_str().unwrap().to_owned())
            .collect::<BTreeSet<_>>()
            .into_iter()
            .collect(),
        frequencies: shaped.map(|own| number(&own["corrected_hz"])).collect(),
        is_stationary: found["end"] == "lowest" || found["end"] == "stationary",
        chi_squared: number(&found["misfit"]["chi_squared"]),
        words: String::from_utf8(printed("correlate", job, "text").stdout).unwrap(),
    }
}
