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

/// A list, which a check does not have.
fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

/// The numbers of a list, NaN for what is none.
fn numbers(value: &Value) -> Vec<f64> {
    list(value).iter().map(number).collect()
}

/// The program's answer to the files of a job.
pub fn answered(files: &Files) -> Answer {
    let (_folder, path) = placed(files);
    answer(&path)
}

/// The program's answer to a job.
pub fn answer(job: &Path) -> Answer {
    let run = |format| {
        let mut command = assert_cmd::Command::cargo_bin("corfem").unwrap();
        let command = command.arg("correlate").arg(job);
        command.args(["-q", "-f", format]).output().unwrap()
    };
    let output = run("json");
    let status = output.status.code().unwrap();
    let Ok(found) = serde_json::from_slice::<Value>(&output.stdout) else {
        return Answer {
            status,
            words: String::from_utf8(output.stderr).unwrap(),
            ..Answer::default()
        };
    };
    let deviations = list(&found["standard_deviations"]);
    let end = |interval: &Value, end| interval[end].as_f64();
    let intervals = list(&found["intervals"]).iter();
    let is_against = |own: &&Value| own["grade"] == "doubt" || own["grade"] == "left_out";
    let against = list(&found["trust"]).iter().filter(is_against);
    let best = match found["best_pass"].as_u64() {
        Some(pass) => &found["passes"][pass as usize - 1]["exact"],
        None => &found["initial"],
    };
    Answer {
        status,
        intervals: intervals
            .map(|own| Some([end(own, "lower")?, end(own, "upper")?]))
            .collect(),
        doubts: against
            .map(|own| own["identifier"].as_str().unwrap().to_owned())
            .collect::<BTreeSet<_>>()
            .into_iter()
            .collect(),
        frequencies: numbers(&best["frequencies_hz"]),
        is_stationary: found["verdict"]["stationary"].is_string(),
        chi_squared: number(&found["misfit"]["chi_squared"]),
        factors: numbers(&found["factors"]),
        deviations: deviations.iter().map(Value::as_f64).collect(),
        words: String::from_utf8(run("text").stdout).unwrap(),
    }
}
