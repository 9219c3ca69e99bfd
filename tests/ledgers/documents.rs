//! README.md, `paper/*.md` and the tour against the program.
//!
//! A computed block stands in its document between `<!-- computed: NAME -->` and `<!-- end -->`; `CORFEM_WRITE=1 cargo test` writes all of
//! them anew. `tables.rs` fills them from the goldens. Numbers of other origin stand in tables marked `measured:` (with machine and date) or
//! `stored:` (with the file).

use crate::evidence::tour_figures::{self, SPRINGS};
use crate::ledgers::{documents, file, files, specification, tables, tour, words};
use crate::paper::figures::Figure;
use crate::prelude::*;
use crate::presentation::program::{corfem, printed};

pub fn computed_blocks_are_what_the_program_computes() -> Vec<String> {
    let mut blocks = tables::tables();
    blocks.insert("specification".to_owned(), specification::page());
    let (mut wrong, mut seen) = (Vec::new(), BTreeSet::new());
    for (document, text) in documents() {
        let mut pieces = text.split("<!-- computed: ");
        let mut written = pieces.next().unwrap().to_owned();
        for piece in pieces {
            let (name, rest) = piece.split_once(" -->\n").unwrap();
            let (_, after) = rest.split_once("<!-- end -->").unwrap();
            let block = blocks[name].trim();
            written += &format!("<!-- computed: {name} -->\n{block}\n<!-- end -->{after}");
            seen.insert(name);
        }
        if on_file(document, &written) != written {
            wrong.push(format!(
                "{document}: computed blocks; CORFEM_WRITE=1 writes them anew"
            ));
        }
    }
    let unseen = blocks.keys().filter(|name| !seen.contains(&name[..]));
    wrong.extend(unseen.map(|name| format!("no document has the block {name}")));
    wrong
}

/// Figures of documents are files, so that a host of code shows them as images.
pub fn figures_of_documents_are_what_the_program_draws() -> Vec<String> {
    let mut drawn = vec![("springs".to_owned(), SPRINGS.to_owned())];
    for (name, diagram) in tour_figures::figures() {
        let svg = diagram.svg().unwrap();
        drawn.push((name.to_string(), Figure::drawn(name, "", &svg).svg));
    }
    // This one has nothing computed in it.
    let (mut wrong, mut known) = (Vec::new(), BTreeSet::from(["elements".to_owned()]));
    for (name, svg) in drawn {
        let (path, new) = (
            format!("paper/figures/{name}.svg"),
            format!("{}\n", svg.trim()),
        );
        // Places to a tenth of a pixel: another machine's last digit may round them the other way.
        if !Numbers::DRAWN.agree(&on_file(&path, &new), &new) {
            wrong.push(format!("{path}: CORFEM_WRITE=1 writes it anew"));
        }
        known.insert(name);
    }
    for (path, _) in files("paper/figures/", ".svg") {
        let name = path.trim_start_matches("paper/figures/");
        let shown = format!("figures/{name})");
        let is_shown = documents().iter().any(|(_, text)| text.contains(&shown));
        if !is_shown || !known.contains(name.trim_end_matches(".svg")) {
            wrong.push(format!("{path}: nobody draws or shows it"));
        }
    }
    wrong
}

/// Links are resolved as a host of code does: relative to the file that has them. Paths on the front page are links.
pub fn every_link_leads_to_a_file_and_every_document_is_two_links_from_the_front_page()
-> Vec<String> {
    let root = in_root("").canonicalize().unwrap();
    let mut all = [documents(), files("C", ".md")].concat();
    all.extend(files("golden/", ".md"));
    let (mut wrong, mut leads) = (Vec::new(), BTreeMap::new());
    for (name, text) in &all {
        let folder = in_root(name).parent().unwrap().to_owned();
        let (mut targets, mut in_link) = (BTreeSet::new(), false);
        for event in Parser::new_ext(text, Options::ENABLE_TABLES) {
            match event {
                Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                    in_link = true;
                    let path = folder.join(dest_url.split('#').next().unwrap());
                    match path.canonicalize() {
                        _ if dest_url.starts_with("https://") => (),
                        Ok(path) => {
                            let path = path.strip_prefix(&root).unwrap();
                            targets.insert(path.display().to_string());
                        }
                        Err(_) => wrong.push(format!("{name}: {dest_url} leads nowhere")),
                    }
                }
                Event::End(TagEnd::Link | TagEnd::Image) => in_link = false,
                Event::Code(code)
                    if *name == "README.md"
                        && !in_link
                        && code.contains('/')
                        && in_root(&*code).exists() =>
                {
                    wrong.push(format!("{name}: {code} is no link"));
                }
                _ => (),
            }
        }
        leads.insert(name.to_string(), targets);
    }
    let near = leads["README.md"].clone();
    let far = near.iter().filter_map(|name| leads.get(name)).flatten();
    let reached: BTreeSet<&String> = near.iter().chain(far).collect();
    let lost = leads.keys().filter(|name| !reached.contains(name));
    wrong.extend(lost.map(|name| format!("{name}: more than two links from README.md")));
    wrong
}

/// The print is quoted in three documents, and another ledger holds the tour's numbers against its code.
pub fn every_table_of_numbers_says_where_they_come_from() -> Vec<String> {
    let others = ["errata.md", "print_and_box.md", "tables/", "tour/"];
    let mut wrong = Vec::new();
    for (name, text) in documents() {
        let path = name.trim_start_matches("paper/");
        if others.iter().any(|other| path.starts_with(other)) {
            continue;
        }
        let mut has_origin = false;
        for (line, number) in text.lines().zip(1..) {
            if let Some(marker) = line.strip_prefix("<!-- ") {
                let kinds = ["computed: ", "measured: ", "stored: "];
                has_origin = kinds.iter().any(|kind| marker.starts_with(kind));
            }
            if line.starts_with('|') && !has_origin && !tour::decimals(line).is_empty() {
                wrong.push(format!("{name}:{number}: {line}"));
            }
        }
    }
    wrong
}

pub fn contributing_names_every_variable_and_only_files_that_are_there() -> Vec<String> {
    let page = file("CONTRIBUTING.md");
    let mut wrong = Vec::new();
    for (name, text) in [files("tests/", ""), files("golden/", "")].concat() {
        for rest in text.split("CORFEM_").skip(1) {
            let end = rest.find(|c: char| !c.is_ascii_uppercase() && c != '_');
            let variable = &rest[..end.unwrap_or(rest.len())];
            if !page.contains(&format!("CORFEM_{variable}")) {
                wrong.push(format!("CONTRIBUTING.md: {name} has CORFEM_{variable}"));
            }
        }
    }
    let code = page.split('`').skip(1).step_by(2);
    let paths = code.filter(|word| word.contains('/') && !word.contains(['*', ' ']));
    let missing = paths.filter(|path| !in_root(path).exists());
    wrong.extend(missing.map(|path| format!("CONTRIBUTING.md: there is no {path}")));
    wrong
}

/// What is folded does not count.
pub fn no_document_has_more_words_than_its_ceiling() -> Vec<String> {
    let ceilings: toml::Table = file("tests/ceilings.toml").parse().unwrap();
    let mut wrong = Vec::new();
    for (name, ceiling) in ceilings["words"].as_table().unwrap() {
        let folds = file(name).split("<details>").enumerate();
        let open = folds.map(|(place, part)| match place {
            0 => part,
            _ => part.split_once("</details>").unwrap().1,
        });
        let count = open.collect::<String>().split_whitespace().count() as i64;
        if ceiling.as_integer() < Some(count) {
            wrong.push(format!("{name}: {count} words of {ceiling}"));
        }
    }
    wrong
}

pub fn what_the_front_page_shows_is_what_the_program_prints() -> Vec<String> {
    let page = file("README.md");
    let block = |kind: &str, place: usize| {
        let (_, rest) = page.split_once(kind).unwrap();
        let block = rest.split(kind).nth(place).unwrap();
        block.split("```").next().unwrap()
    };
    assert_eq!(page.matches("```text\n").count(), 2);
    let scratch = new_folder();
    let mine = scratch.path().join("mine");
    let path = |name: &str| mine.join(name).to_str().unwrap().to_owned();
    corfem(&["init", "-q", "--example", "building", &path("")]);
    let correlated = |job: &str| words_of_lines(&text_of(&["correlate", "-q", job]));
    let airplane = correlated("tests/jobs/garteur_joints/job.toml");
    let cases = words_of_lines(&printed(&["-q"]));
    let mut wrong = Vec::new();
    for (place, printed) in [correlated(&path("job.toml")), [cases, airplane].concat()]
        .into_iter()
        .enumerate()
    {
        let shown = words_of_lines(block("```text\n", place));
        let others = shown.into_iter().filter(|line| !printed.contains(line));
        wrong.extend(others.map(|line| format!("README.md: not printed: {line}")));
    }
    // The job on the page is one of the same files.
    fs::write(path("short.toml"), block("```toml\n", 0)).unwrap();
    let checked = corfem(&["check", "-q", &path("short.toml")]);
    if checked.status.code() == Some(2) {
        wrong.push(format!("README.md: its job: {checked:?}"));
    }
    wrong
}

fn text_of(arguments: &[&str]) -> String {
    String::from_utf8(corfem(arguments).stdout).unwrap()
}

fn words_of_lines(text: &str) -> Vec<String> {
    text.lines().map(words).collect()
}

/// Markdown of every document, and of every comment of documentation in a source.
fn markdown() -> Vec<(&'static str, String)> {
    let texts = [documents(), files("golden/", ".md")].concat();
    let mut all: Vec<_> = texts
        .iter()
        .map(|(name, text)| (*name, text.to_string()))
        .collect();
    for (name, text) in [files("src/", ".rs"), files("paper/", ".rs")].concat() {
        all.push((name, String::new()));
        for line in text.lines().map(str::trim_start) {
            let comment = line.strip_prefix("///").or(line.strip_prefix("//!"));
            match comment {
                Some(comment) => {
                    let last = &mut all.last_mut().unwrap().1;
                    *last += comment.strip_prefix(' ').unwrap_or(comment);
                    *last += "\n";
                }
                None => all.push((name, String::new())),
            }
        }
    }
    all
}

/// Markdown knows nothing of formulas. In `(p_{ij})_r ... (p_{ji})_r` it reads the two outer underscores as emphasis, `[K](V)` as a link,
/// `\,` as a comma and `'` as a quotation mark. Every command in a formula is one that `formulas-as-mathml.html` knows.
pub fn markdown_leaves_every_formula_as_it_is_written() -> Vec<String> {
    let script = file("formulas-as-mathml.html");
    let is_typeset = |command: &str| {
        ["begin", "end", "text", "mathrm", "newline"].contains(&command)
            || [
                format!("name === \"{command}\""),
                format!(" {command}: "),
                format!("{{{command}: "),
            ]
            .iter()
            .any(|entry| script.contains(entry))
    };
    let options = Options::ENABLE_TABLES
        | Options::ENABLE_FOOTNOTES
        | Options::ENABLE_STRIKETHROUGH
        | Options::ENABLE_TASKLISTS
        | Options::ENABLE_SMART_PUNCTUATION;
    let mut wrong = Vec::new();
    for (name, source) in markdown() {
        // Text that the browser gets in one piece.
        let (mut pieces, mut in_code) = (vec![String::new()], false);
        for event in Parser::new_ext(&source, options) {
            match event {
                Event::Text(text) if !in_code => *pieces.last_mut().unwrap() += &text,
                Event::SoftBreak => *pieces.last_mut().unwrap() += " ",
                event => {
                    in_code &= event != Event::End(TagEnd::CodeBlock);
                    in_code |= matches!(event, Event::Start(Tag::CodeBlock(_)));
                    pieces.push(String::new());
                }
            }
        }
        let source = words(&source).replace("$$", "$");
        for piece in pieces {
            let piece = words(&piece).replace("$$", "$");
            let is_closed = piece.matches('$').count().is_multiple_of(2);
            for formula in piece.split('$').skip(1).step_by(2) {
                let mut commands = formula.split('\\').skip(1).map(|rest| {
                    let end = rest.find(|c: char| !c.is_ascii_alphabetic());
                    &rest[..end.unwrap_or(rest.len())]
                });
                let is_known = commands.all(|command| command.is_empty() || is_typeset(command));
                if !is_closed || !is_known || !source.contains(&format!("${formula}$")) {
                    wrong.push(format!("{name}: the reader gets {formula}"));
                }
            }
        }
    }
    wrong
}
