//! The tour in `paper/tour`: every number in its sentences stands in its code, which the documentation tests compile and run.

use crate::ledgers::files_below;
use crate::prelude::*;

fn folder() -> PathBuf {
    in_root("paper/tour")
}

/// The chapters by the two digits of their number.
fn chapters() -> BTreeMap<String, (PathBuf, String)> {
    let files = fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let chapter = |path: PathBuf| {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let text = fs::read_to_string(&path).unwrap();
        (name[..2].to_owned(), (path, text))
    };
    let is_text = |path: &PathBuf| path.extension().is_some_and(|kind| kind == "md");
    files.filter(is_text).map(chapter).collect()
}

/// Numbers with a decimal point in a text, without their signs.
fn decimals(text: &str) -> Vec<String> {
    let is_number = |c: char| c.is_ascii_digit() || c == '.';
    let words = text
        .split(|c: char| !is_number(c))
        .map(|word| word.trim_matches('.'));
    words
        .filter(|word| word.matches('.').count() == 1)
        .map(str::to_owned)
        .collect()
}

/// What a chapter says in sentences, tables and formulas, and what it computes, each as one text.
fn said_and_computed(markdown: &str) -> (String, String) {
    let (mut said, mut computed, mut in_code) = (String::new(), String::new(), false);
    for event in Parser::new_ext(markdown, Options::ENABLE_TABLES) {
        match event {
            Event::Start(Tag::CodeBlock(_)) => in_code = true,
            Event::End(TagEnd::CodeBlock) => in_code = false,
            Event::Text(text) | Event::Code(text) => {
                let into = if in_code { &mut computed } else { &mut said };
                into.push_str(&text);
                into.push(' ');
            }
            Event::SoftBreak | Event::End(_) => said.push('\n'),
            _ => (),
        }
    }
    // A comment computes nothing.
    let code = computed
        .lines()
        .map(|line| line.split("//").next().unwrap_or_default());
    (said.clone(), code.collect_vec().join("\n"))
}

/// Numbers that are said and stand nowhere in the code.
fn only_said(markdown: &str) -> Vec<String> {
    let (said, computed) = said_and_computed(markdown);
    let computed = decimals(&computed);
    decimals(&said)
        .into_iter()
        .filter(|number| !computed.contains(number))
        .collect()
}

#[test]
fn every_number_said_in_the_tour_stands_in_its_code() {
    for (number, (_, text)) in chapters() {
        // Another test holds computed blocks against the goldens.
        let mut parts = text.split("<!-- computed: ");
        let first = parts.next().unwrap_or_default().to_owned();
        let rest = parts.filter_map(|part| Some(part.split_once("<!-- end -->")?.1));
        let text = (first + &rest.collect::<String>()).replace("C.", "C");
        assert_eq!(only_said(&text), [""; 0], "chapter {number}");
    }
}

#[test]
fn every_chapter_has_its_parts() {
    for (number, (_, text)) in chapters() {
        assert!(
            text.starts_with(&format!("# {}. ", number.trim_start_matches('0'))),
            "chapter {number}"
        );
        for part in [
            "```rust\n",
            "\n*Figure ",
            "\n## Exercise",
            "<details><summary>Answer</summary>",
        ] {
            assert!(text.contains(part), "chapter {number} has no {part:?}");
        }
        let answer = text.split("<summary>Answer</summary>").nth(1).unwrap();
        assert!(
            answer.contains("```rust\n"),
            "the answer of chapter {number} is not computed"
        );
        for fence in text
            .lines()
            .filter(|line| line.starts_with("```") && line.len() > 3)
        {
            assert!(
                ["```rust", "```text", "```sh"].contains(&fence),
                "chapter {number} does not run {fence}"
            );
        }
        // As `src/tour.rs` says, at 115 words a minute, the code among them.
        let minutes = text.split_whitespace().count() / 115;
        assert!((11..20).contains(&minutes), "chapter {number}: {minutes}");
    }
}

/// Lines without what their place adds in front of all of them.
fn dedented(text: &str) -> Vec<String> {
    let margin = |line: &&str| line.len() - line.trim_start().len();
    let lines = text.lines().collect_vec();
    let least = lines
        .iter()
        .filter(|line| !line.trim().is_empty())
        .map(margin)
        .min();
    let cut = |line: &&str| {
        line.get(least.unwrap_or(0)..)
            .unwrap_or_default()
            .to_owned()
    };
    lines.iter().map(cut).collect()
}

#[test]
fn what_the_tour_quotes_are_the_lines_of_the_method() {
    let mut quotes = 0;
    for (number, (_, text)) in chapters() {
        for quote in text.split("<!-- from ").skip(1) {
            let (file, rest) = quote.split_once(" -->\n```text\n").unwrap();
            let lines = dedented(rest.split("```").next().unwrap());
            let path = in_root(file);
            let source = fs::read_to_string(&path).unwrap();
            let source = source.lines().collect_vec();
            let is_there = |window: &[&str]| dedented(&window.join("\n")) == lines;
            let found = source
                .windows(lines.len())
                .filter(|window| is_there(window))
                .count();
            assert!(
                found > 0,
                "chapter {number}: {file} has no such lines:\n{}",
                lines.join("\n")
            );
            assert!(file.starts_with("src/method/"), "{file}");
            quotes += 1;
        }
    }
    assert!(quotes >= 6, "{quotes}");
}

/// The loop fits on a screen, and a reader sees all of a line.
#[test]
fn the_whole_loop_has_fifteen_lines_at_most() {
    let (_, text) = &chapters()["06"];
    let (_, rest) = text.split_once("## The whole loop\n\n```text\n").unwrap();
    let lines = rest.split("```").next().unwrap().lines().collect_vec();
    assert!((10..=15).contains(&lines.len()), "{} lines", lines.len());
    assert!(
        lines.iter().all(|line| line.chars().count() <= 100),
        "{lines:#?}"
    );
}

#[test]
fn every_chapter_leads_to_its_neighbors_and_the_last_to_the_plain_program() {
    let chapters = chapters();
    let tour = fs::read_to_string(in_root("src/tour.rs")).unwrap();
    let links = chapters
        .values()
        .map(|(path, text)| {
            let name = path.file_stem().unwrap().to_string_lossy();
            let title = text.lines().next().unwrap().trim_start_matches("# ");
            (
                format!("[{title}]({name}.md)"),
                format!("pub mod chapter_{name} {{"),
            )
        })
        .collect_vec();
    for (at, (_, text)) in chapters.values().enumerate() {
        let end = text.rsplit("</details>").next().unwrap();
        for (word, other) in [("Previous", at.checked_sub(1)), ("Next", Some(at + 1))] {
            let link = other.and_then(|other| links.get(other));
            assert_eq!(
                end.contains(word),
                link.is_some(),
                "{word} in chapter {}",
                at + 1
            );
            if let Some((link, module)) = link {
                assert!(
                    end.contains(&format!("{word}: {link}")) && tour.contains(module),
                    "{link}"
                );
            }
        }
    }
    let (_, last) = chapters.values().last().unwrap();
    assert!(
        last.rsplit("</details>")
            .next()
            .unwrap()
            .contains("`paper/plain.rs`")
    );
}

/// What serves all modules alike, and is the subject of no chapter.
const OF_NO_CHAPTER: [&str; 2] = ["error", "linear_algebra"];

/// Names behind `#[doc(hidden)]` in a source, with the module in front.
fn hidden(module: &str, source: &str) -> Vec<String> {
    let lines = source.split("#[doc(hidden)]\n").skip(1);
    let name = |rest: &str| {
        let line = rest.lines().find(|line| !line.trim().starts_with("#["))?;
        let line = line.split(['(', '<', ';', '{']).next()?.trim();
        let name = line.rsplit([' ', ':']).next()?;
        line.starts_with("pub ")
            .then(|| format!("{module}::{name}"))
    };
    lines.filter_map(name).collect()
}

#[test]
fn every_name_that_the_tour_imports_has_its_page() {
    let mut without = Vec::new();
    for file in files_below(&in_root("src")) {
        let path = file
            .strip_prefix(in_root("src"))
            .unwrap()
            .with_extension("");
        let module = path.display().to_string().replace('/', "::");
        let source = fs::read_to_string(&file).unwrap();
        without.extend(hidden(module.trim_end_matches("::mod"), &source));
    }
    assert!(
        without.iter().any(|name| name == "weighted::close_modes"),
        "{without:?}"
    );
    let is_name = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    for (number, (_, text)) in chapters() {
        for name in text.split("corfem::").skip(1) {
            let name = &name[..name.find(|c| !is_name(c)).unwrap_or(name.len())];
            let is_of = |own: &&String| format!("{name}::").starts_with(&format!("{own}::"));
            assert_eq!(without.iter().find(is_of), None, "chapter {number}: {name}");
        }
    }
}

#[test]
fn every_public_module_of_the_method_points_to_its_chapter() {
    let source = |path: &str| {
        let file = in_root("src").join(path);
        fs::read_to_string(&file).unwrap_or_else(|_| panic!("{path} does not read"))
    };
    let (list, tour) = (source("method/mod.rs"), source("tour.rs"));
    let modules = list
        .lines()
        .filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';'))
        .collect_vec();
    assert!(
        OF_NO_CHAPTER.iter().all(|module| modules.contains(module)),
        "{modules:?}"
    );
    for module in modules
        .into_iter()
        .filter(|module| !OF_NO_CHAPTER.contains(module))
    {
        let folder = format!("method/{module}/mod.rs");
        let is_folder = in_root("src").join(&folder).exists();
        let text = source(&if is_folder {
            folder
        } else {
            format!("method/{module}.rs")
        });
        let pointer = text
            .lines()
            .find_map(|line| line.strip_prefix("//! Tour: [chapter ")?.strip_suffix(")."));
        let (number, path) = pointer
            .and_then(|pointer| pointer.split_once("](crate::tour::"))
            .unwrap_or_default();
        let chapter = format!("chapter_{number:0>2}_");
        let is_there = path.starts_with(&chapter) && tour.contains(&format!("pub mod {path} {{"));
        assert!(
            is_there,
            "method::{module} points to no chapter: {pointer:?}"
        );
    }
}

#[test]
fn the_check_finds_a_number_that_is_said_alone() {
    assert_eq!(
        only_said("It is 1.25.\n\n```rust\nlet x = 1.5; // 1.25\n```\n"),
        ["1.25"]
    );
    assert_eq!(
        only_said("It is −1.5 %, $1.5$.\n\n```rust\nassert_eq!(x, \"1.5\");\n```\n"),
        [""; 0]
    );
}
