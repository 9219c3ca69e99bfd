//! What outputs show of odd names, what a corrected deck says at its head, what killed runs leave, and files without a last line end.

use super::cli::{corfem, text, words};
use crate::common::jobs::universal;
use crate::prelude::*;

/// Characters that turn the direction of what follows.
const TURNS: [char; 12] = [
    '\u{61c}', '\u{200e}', '\u{200f}', '\u{202a}', '\u{202b}', '\u{202c}', '\u{202d}', '\u{202e}',
    '\u{2066}', '\u{2067}', '\u{2068}', '\u{2069}',
];

/// The law: no output turns the direction in which it is read, and each still tells which character was there.
#[test]
fn characters_that_turn_text_around_are_escaped_in_every_output() {
    let all: String = TURNS.iter().collect();
    let files = rods_with("name = \"a\"", &format!("name = \"a{all}b\""));
    let files = with(
        files,
        "job.toml",
        "[model]",
        &format!("title = \"t{all}\"\n[model]"),
    );
    let (folder, path) = placed(&files);
    let out = folder.path().join("out");
    let mut outputs = Vec::new();
    for format in ["text", "markdown", "json", "csv"] {
        for command in ["check", "correlate"] {
            outputs.push(text(
                &corfem(&[command, "-q", "-f", format, words(&path)]).stdout,
            ));
        }
    }
    corfem(&["correlate", "-q", words(&path), "--folder", words(&out)]);
    for file in ["report.html", "factors.csv", "correlation.json"] {
        outputs.push(fs::read_to_string(out.join(file)).unwrap());
    }
    for output in &outputs {
        assert!(!output.contains(TURNS), "{output}");
        assert!(output.to_lowercase().contains("202e"), "{output}");
    }
    // Whoever reads JSON by a program finds the name as it was.
    let document: Value = serde_json::from_str(&outputs[outputs.len() - 1]).unwrap();
    let name = document["parameters"][0]["parameter"].as_str().unwrap();
    assert_eq!(name, format!("a{all}b"));
}

/// The law: an input that ends without a line end is read whole.
#[test]
fn a_file_without_a_last_line_end_is_read_whole() {
    let read = |files: &Files| {
        let job = prepared(files).loaded;
        let (stiffness, mass) = job
            .source
            .whole
            .at(&vec![1.0; job.parameter_names().count()])
            .unwrap();
        (job.data.clone(), stiffness, mass, job.title.clone())
    };
    for files in [rods(), building(), universal(7, 39.37)] {
        let whole = read(&files);
        for place in 0..files.len() {
            let mut cut = files.clone();
            let text = &mut cut[place].1;
            text.truncate(text.trim_end_matches('\n').len());
            assert_eq!(read(&cut), whole, "{}", files[place].0);
        }
    }
}
