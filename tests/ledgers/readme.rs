//! The front page: its length, its links, and that what it prints is what the program prints.

use crate::prelude::*;
use crate::presentation::program::cli::{corfem, text};

const README: &str = include_str!("../../README.md");

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn the_front_page_has_1100_words_at_most() {
    let words = README.split_whitespace().count();
    assert!(words <= 1100, "{words}");
}

/// Where links lead, and files and folders that are named outside of one.
fn links_and_names(markdown: &str) -> (BTreeSet<String>, Vec<String>) {
    let (mut links, mut names) = (BTreeSet::new(), Vec::new());
    let (mut in_link, mut in_block) = (false, false);
    for event in Parser::new(markdown) {
        match event {
            Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                in_link = true;
                links.insert(dest_url.into_string());
            }
            Event::End(TagEnd::Link | TagEnd::Image) => in_link = false,
            Event::Start(Tag::CodeBlock(_)) => in_block = true,
            Event::End(TagEnd::CodeBlock) => in_block = false,
            Event::Text(text) | Event::Code(text) if !in_link && !in_block => {
                let words = text.split(|c: char| c.is_whitespace() || "()`,;".contains(c));
                let is_file = |word: &&str| {
                    word.contains(['/', '.']) && root().join(word.trim_end_matches('.')).exists()
                };
                let is_path =
                    |word: &&str| !word.trim_matches(['.', '/']).is_empty() && is_file(word);
                names.extend(words.filter(is_path).map(str::to_owned));
            }
            _ => (),
        }
    }
    (links, names)
}

#[test]
fn every_path_of_the_front_page_is_a_link_that_leads_somewhere() {
    let (links, names) = links_and_names(README);
    assert!(links.len() > 15, "{links:?}");
    let nowhere = links
        .iter()
        .filter(|link| !root().join(link).is_file())
        .collect_vec();
    assert!(nowhere.is_empty(), "{nowhere:?}");
    assert!(names.is_empty(), "not links: {names:?}");
    let (links, names) = links_and_names("See `src/lib.rs`, [here](src/main.rs) and README.md.");
    assert_eq!(
        (links.len(), names),
        (1, vec!["src/lib.rs".to_owned(), "README.md.".to_owned()])
    );
}

#[test]
fn what_the_front_page_shows_is_what_the_program_prints() {
    let cells = |line: &str| line.split_whitespace().collect_vec().join(" ");
    let scratch = new_folder();
    let mine = scratch.path().join("mine");
    let path = |name: &str| mine.join(name).to_str().unwrap().to_owned();
    assert!(
        corfem(&["init", "-q", "--example", "building", &path("")])
            .status
            .success()
    );
    let correlated = |job: &str| text(&corfem(&["correlate", "-q", job]).stdout);
    let airplane = correlated("tests/jobs/garteur_joints/job.toml");
    let cases = text(&corfem(&["-q"]).stdout);
    let printed = [correlated(&path("job.toml")), cases + &airplane];
    let blocks = README.split("```text\n").skip(1).collect_vec();
    assert_eq!(blocks.len(), printed.len());
    for (block, printed) in blocks.into_iter().zip(&printed) {
        let shown = printed.lines().map(cells).collect_vec();
        for line in block.split("```").next().unwrap().lines() {
            assert!(shown.contains(&cells(line)), "{line}\n{printed}");
        }
    }
    // The job on the page is one of the same files.
    let job = README.split("```toml\n").nth(1).unwrap();
    fs::write(path("short.toml"), job.split("```").next().unwrap()).unwrap();
    let checked = corfem(&["check", "-q", &path("short.toml")]);
    assert_ne!(checked.status.code(), Some(2), "{}", text(&checked.stderr));
}

/// The front page tells times of the program as it is installed, from the table of the commands.
#[test]
fn the_time_of_the_front_page_is_the_measured_one() {
    let cost = include_str!("../../paper/cost.md");
    let row = cost.lines().find(|line| line.starts_with("| 10,098 DOF |"));
    let cell = row.unwrap().split('|').nth(4).unwrap();
    let seconds: f64 = cell.split(',').next().unwrap().trim().parse().unwrap();
    let words = README.split_whitespace().collect_vec().join(" ");
    assert!(
        words.contains(&format!("`corfem correlate` takes {seconds:.1} s")),
        "{words}"
    );
}
