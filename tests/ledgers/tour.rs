//! The tour in `paper/tour`, whose code the documentation tests compile and run.

use crate::ledgers::{file, files};
use crate::prelude::*;

fn chapters() -> Vec<(&'static str, &'static str)> {
    files("paper/tour/", ".md")
}

/// Numbers with a decimal point in a text, without their signs.
pub fn decimals(text: &str) -> Vec<&str> {
    let words = text.split(|c: char| !c.is_ascii_digit() && c != '.');
    let words = words.map(|word| word.trim_matches('.'));
    words
        .filter(|word| word.matches('.').count() == 1)
        .collect()
}

pub fn every_number_said_in_the_tour_stands_in_its_code() -> Vec<String> {
    let mut wrong = Vec::new();
    for (name, text) in chapters() {
        // Another ledger holds computed blocks against the goldens.
        let parts = text.split("<!-- computed: ");
        let outside = parts.map(|part| {
            part.split_once("<!-- end -->")
                .map_or(part, |(_, rest)| rest)
        });
        let text = outside.collect::<String>().replace("C.", "C");
        let (mut said, mut code, mut in_code) = (String::new(), String::new(), false);
        for event in Parser::new_ext(&text, Options::ENABLE_TABLES) {
            match event {
                Event::Start(Tag::CodeBlock(_)) => in_code = true,
                Event::End(TagEnd::CodeBlock) => in_code = false,
                Event::Text(text) | Event::Code(text) if in_code => code += &text,
                Event::Text(text) | Event::Code(text) => said += &format!("{text} "),
                _ => said += "\n",
            }
        }
        // A comment computes nothing.
        let code = code.lines().map(|line| line.split("//").next().unwrap());
        let code = code.collect_vec().join("\n");
        let computed = decimals(&code);
        let alone = decimals(&said)
            .into_iter()
            .filter(|own| !computed.contains(own));
        wrong.extend(alone.map(|number| format!("{name}: {number} is said alone")));
    }
    wrong
}

pub fn every_chapter_has_its_parts_and_leads_to_its_neighbors() -> Vec<String> {
    let (mut wrong, tour) = (Vec::new(), file("src/tour.rs"));
    let links = chapters().into_iter().map(|(path, text)| {
        let name = path.trim_start_matches("paper/tour/");
        let title = text.lines().next().unwrap().trim_start_matches("# ");
        format!("[{title}]({name})")
    });
    let links = links.collect_vec();
    for (at, (path, text)) in chapters().into_iter().enumerate() {
        let name = path
            .trim_start_matches("paper/tour/")
            .trim_end_matches(".md");
        let (body, end) = text.rsplit_once("</details>").unwrap();
        let mut parts = vec!["\n*Figure ".to_owned(), "\n## Exercise".to_owned()];
        parts.extend(links.get(at + 1).map(|next| format!("Next: {next}")));
        parts.extend(
            at.checked_sub(1)
                .map(|before| format!("Previous: {}", links[before])),
        );
        let is_whole = parts.iter().all(|part| text.contains(part))
            && body
                .rsplit("<summary>Answer</summary>")
                .next()
                .unwrap()
                .contains("```rust\n")
            && tour.contains(&format!("pub mod chapter_{name} {{"))
            && (at + 1 < links.len() || end.contains("`paper/plain.rs`"));
        let mut fences = text
            .lines()
            .filter(|line| line.starts_with("```") && line.len() > 3);
        let is_run = fences.all(|line| ["```rust", "```text", "```sh"].contains(&line));
        // As `src/tour.rs` says, at 115 words a minute, the code among them.
        let minutes = text.split_whitespace().count() / 115;
        if !is_whole || !is_run || !(11..20).contains(&minutes) {
            wrong.push(format!("{path}: {minutes} minutes; it must have {parts:?}"));
        }
    }
    wrong
}

pub fn what_the_tour_quotes_are_the_lines_of_the_method() -> Vec<String> {
    let trimmed = |text: &str| text.lines().map(str::trim).collect_vec().join("\n");
    let mut wrong = Vec::new();
    for (name, text) in chapters() {
        for quote in text.split("<!-- from ").skip(1) {
            let (path, rest) = quote.split_once(" -->\n```text\n").unwrap();
            let lines = trimmed(rest.split("\n```").next().unwrap());
            if !path.starts_with("src/method/") || !trimmed(file(path)).contains(&lines) {
                wrong.push(format!("{name}: {path} has no such lines:\n{lines}"));
            }
        }
    }
    wrong
}

/// What serves all modules alike is the subject of no chapter. Rustdoc follows the links.
pub fn every_public_module_of_the_method_points_to_its_chapter() -> Vec<String> {
    let lines = file("src/method/mod.rs").lines();
    let modules = lines.filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';'));
    let mut wrong = modules
        .map(|module| format!("src/method/{module}"))
        .collect_vec();
    wrong.retain(|module| {
        let others = ["src/method/error", "src/method/linear_algebra"];
        let points = |text: &str| text.contains("//! Tour: [chapter ");
        !others.contains(&&**module) && !files(module, ".rs").iter().any(|(_, text)| points(text))
    });
    wrong
}
