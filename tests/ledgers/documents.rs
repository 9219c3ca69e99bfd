//! The numbers and figures of README.md, `paper/*.md` and the tour that the program computes.
//!
//! A computed block stands in its document between `<!-- computed: NAME -->` and `<!-- end -->`;
//! `CORFEM_WRITE=1 cargo test` writes all of them anew. `tables.rs` fills tables from the goldens, and sentences, which must
//! stand in their document word for word and are changed by hand. Numbers of other origin stand in tables marked `measured:`
//! (with machine and date) or `stored:` (with the file).

use crate::evidence::diagram::Diagram;
use crate::evidence::tour_figures::{SPRINGS, figures};
use crate::ledgers::{files_below, specification, tables};
use crate::paper::figures::Figure;
use crate::prelude::*;

/// README.md, the texts in `paper/` and the tour, by their path.
pub fn documents() -> BTreeMap<String, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = vec![root.join("README.md")];
    files.extend(files_below(&root.join("paper")));
    files.retain(|file| file.extension().is_some_and(|end| end == "md"));
    texts(files)
}

/// These and the READMEs of `golden`.
pub fn documents_and_readmes() -> BTreeMap<String, String> {
    let mut readmes = files_below(&in_root("golden"));
    readmes.retain(|file| file.file_name().is_some_and(|name| name == "README.md"));
    documents().into_iter().chain(texts(readmes)).collect()
}

/// Every document, also those of the workshop.
fn all_documents() -> BTreeMap<String, String> {
    let mut files = files_below(&in_root("golden"));
    files.retain(|file| file.extension().is_some_and(|end| end == "md"));
    files.extend(["CONTRIBUTING.md", "CHANGELOG.md"].map(in_root));
    documents().into_iter().chain(texts(files)).collect()
}

/// Texts of files by their path in the project.
pub fn texts(files: Vec<PathBuf>) -> BTreeMap<String, String> {
    let text = |file: PathBuf| {
        let name = file.strip_prefix(in_root("")).unwrap();
        let text = fs::read_to_string(&file).unwrap();
        (name.display().to_string(), text)
    };
    files.into_iter().map(text).collect()
}

fn is_to_be_written() -> bool {
    std::env::var("CORFEM_WRITE").is_ok_and(|value| value == "1")
}

#[test]
fn computed_blocks_are_what_the_program_computes() {
    let (start, end) = ("<!-- computed: ", "<!-- end -->");
    let mut blocks = tables::tables();
    blocks.insert("specification".to_owned(), specification::page());
    let (mut seen, mut wrong) = (BTreeSet::new(), Vec::new());
    for (document, text) in documents() {
        let mut pieces = text.split(start);
        let mut written = pieces.next().unwrap_or_default().to_owned();
        for piece in pieces {
            let (name, rest) = piece.split_once(" -->\n").unwrap();
            let (old, after) = rest.split_once(end).unwrap();
            let block = blocks
                .get(name)
                .unwrap_or_else(|| panic!("{document}: {name}"));
            let new = format!("{}\n", block.trim());
            if old != new {
                wrong.push(format!("{document}: {name}"));
            }
            written += &format!("{start}{name} -->\n{new}{end}{after}");
            seen.insert(name.to_owned());
        }
        if is_to_be_written() {
            let path = in_root(&document);
            fs::write(path, written).unwrap();
            wrong.clear();
        }
    }
    assert!(
        wrong.is_empty(),
        "{wrong:?}: CORFEM_WRITE=1 writes them anew"
    );
    assert!(
        blocks.keys().eq(&seen),
        "not every block stands in a document"
    );
}

/// The figures of documents are files, so that a host of code shows them as images, and each stands in a document.
#[test]
fn figures_of_documents_are_what_the_program_draws() {
    let file = |name: &str, diagram: Diagram| {
        let svg = diagram.svg().unwrap();
        (name.to_owned(), Figure::drawn(name, "", &svg).svg)
    };
    let springs = ("springs".to_owned(), SPRINGS.to_owned());
    let drawn = figures().into_iter().map(|(name, drawn)| file(name, drawn));
    let drawn = drawn.chain([springs]);
    let (documents, mut names) = (documents(), BTreeSet::new());
    for (name, svg) in drawn {
        let (path, new) = (
            in_root(format!("paper/figures/{name}.svg")),
            format!("{}\n", svg.trim()),
        );
        if is_to_be_written() {
            fs::write(&path, &new).unwrap();
        }
        // Places to a tenth of a pixel: another machine's last digit may round them the other way.
        let old = fs::read_to_string(&path).unwrap();
        assert!(
            Numbers::DRAWN.agree(&old, &new),
            "{name}: CORFEM_WRITE=1 writes it anew"
        );
        let shown = format!("figures/{name}.svg)");
        assert!(
            documents.values().any(|text| text.contains(&shown)),
            "{name}"
        );
        names.insert(path);
    }
    // This one has nothing computed in it.
    let by_hand = "figures/elements.svg";
    let shown = |text: &String| text.contains(&format!("{by_hand})"));
    assert!(documents.values().any(shown));
    names.insert(in_root("paper").join(by_hand));
    let files = files_below(&in_root("paper/figures"));
    assert!(files.into_iter().collect::<BTreeSet<_>>() == names);
    let inline = documents.iter().filter(|(_, text)| text.contains("<svg"));
    assert_eq!(inline.map(|(name, _)| name).collect_vec(), [""; 0]);
}

/// Where the links and images of a text lead.
pub fn links(markdown: &str) -> Vec<String> {
    let links = Parser::new_ext(markdown, Options::ENABLE_TABLES).filter_map(|event| match event {
        Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
            Some(dest_url.into_string())
        }
        _ => None,
    });
    links.collect()
}

/// As a host of code resolves it: relative to the file that has it.
#[test]
fn every_link_of_a_document_leads_to_a_file() {
    let (mut count, mut nowhere) = (0, Vec::new());
    for (name, text) in all_documents() {
        for link in links(&text) {
            let path = link.split('#').next().unwrap();
            let folder = in_root(&name).parent().unwrap().to_owned();
            count += 1;
            if !link.starts_with("https://") && (link.contains("::") || !folder.join(path).exists())
            {
                nowhere.push(format!("{name}: {link}"));
            }
        }
    }
    assert!(nowhere.is_empty() && count > 80, "{count}: {nowhere:#?}");
}

/// Documents to which those of a list lead.
fn next(all: &BTreeMap<String, String>, from: &BTreeSet<String>) -> BTreeSet<String> {
    let root = in_root("").canonicalize().unwrap();
    let resolved = |name: &String| {
        let folder = in_root(name).parent().unwrap().to_owned();
        let found = links(&all[name]).into_iter();
        found
            .filter_map(|link| folder.join(link.split('#').next()?).canonicalize().ok())
            .filter_map(|path| Some(path.strip_prefix(&root).ok()?.display().to_string()))
            .collect_vec()
    };
    let found = from.iter().flat_map(resolved);
    found.filter(|name| all.contains_key(name)).collect()
}

#[test]
fn every_document_is_two_links_from_the_front_page_at_most() {
    let all = all_documents();
    let one = next(&all, &BTreeSet::from(["README.md".to_owned()]));
    let near = next(&all, &one);
    let far = all
        .keys()
        .filter(|name| !one.contains(*name) && !near.contains(*name));
    assert_eq!(far.collect_vec(), [""; 0]);
}

/// Bytes of what a reader has before her: what is folded does not count.
fn open_bytes(text: &str) -> usize {
    let mut parts = text.split("<details>");
    let first = parts.next().map_or(0, str::len);
    first
        + parts
            .map(|part| {
                part.split_once("</details>")
                    .map_or(0, |(_, rest)| rest.len())
            })
            .sum::<usize>()
}

#[test]
fn the_long_documents_are_short() {
    let documents = documents();
    let of_paper = documents.iter().filter(|(name, _)| {
        name.starts_with("paper/")
            && name.matches('/').count() == 1
            && !name.ends_with("specification.md")
    });
    let bytes: usize = of_paper.map(|(_, text)| text.len()).sum();
    assert!(bytes <= 80_000, "{bytes}");
    for (name, most) in [
        ("print_and_box", 14),
        ("cost", 9),
        ("own_structure", 9),
        ("specification", 16),
    ] {
        let bytes = open_bytes(&documents[&format!("paper/{name}.md")]);
        assert!(bytes <= 1000 * most, "{name}: {bytes}");
    }
    assert_eq!(open_bytes("ab<details>cde</details>f"), 3);
}

#[test]
fn sentences_in_documents_are_what_the_program_computes() {
    let documents = documents();
    let words = |text: &str| text.split_whitespace().collect_vec().join(" ");
    let mut wrong = tables::sentences();
    wrong.retain(|(document, sentence)| !words(&documents[*document]).contains(&words(sentence)));
    assert!(wrong.is_empty(), "these documents should say: {wrong:#?}");
}

/// The print is quoted there, not computed.
const QUOTATIONS: [&str; 3] = [
    "paper/errata.md",
    "paper/print_and_box.md",
    "paper/tables/README.md",
];

#[test]
fn every_table_of_numbers_says_where_they_come_from() {
    for (name, text) in documents() {
        // Another test holds the tour's numbers against its code.
        if QUOTATIONS.contains(&name.as_str()) || name.starts_with("paper/tour/") {
            continue;
        }
        let mut origin = None;
        for line in text.lines() {
            if let Some(marker) = line.strip_prefix("<!-- ") {
                origin = ["computed: ", "measured: ", "stored: "]
                    .iter()
                    .find(|kind| marker.starts_with(**kind));
            }
            let has_decimals = line
                .as_bytes()
                .windows(3)
                .any(|w| w[0].is_ascii_digit() && w[1] == b'.' && w[2].is_ascii_digit());
            assert!(
                origin.is_some() || !line.starts_with('|') || !has_decimals,
                "{name}: {line}"
            );
        }
    }
}

/// Words of a text that begin in one way, as far as letters of a name go.
fn names<'a>(text: &'a str, start: &str) -> Vec<&'a str> {
    let end = |rest: &str| rest.find(|c: char| !c.is_ascii_uppercase() && c != '_');
    let found = text.match_indices(start).map(|(at, _)| &text[at..]);
    found
        .map(|rest| &rest[..end(rest).unwrap_or(rest.len())])
        .collect()
}

/// Every variable of the tests, and every file that is to be written for something new.
#[test]
fn contributing_names_every_variable_and_only_files_that_are_there() {
    let text = &all_documents()["CONTRIBUTING.md"];
    let (known, start) = (names(text, "CORFEM_"), "CORFEM_");
    for file in ["tests", "golden"]
        .map(in_root)
        .iter()
        .flat_map(|folder| files_below(folder))
    {
        let source = fs::read_to_string(&file).unwrap_or_default();
        let unknown = names(&source, start)
            .into_iter()
            .find(|name| name.len() > start.len() && !known.contains(name));
        assert_eq!(unknown, None, "{}", file.display());
    }
    let words = text.split('`').skip(1).step_by(2);
    let is_path = |word: &&str| word.contains('/') && !word.contains(['*', ' ']);
    let missing = words.filter(is_path).filter(|word| !in_root(word).exists());
    assert_eq!(missing.collect_vec(), [""; 0]);
}
