//! The numbers and figures of README.md, `paper/*.md` and the tour that the program computes.
//!
//! A computed block stands in its document between `<!-- computed: NAME -->` and `<!-- end -->`;
//! `CORFEM_WRITE=1 cargo test` writes all of them anew. `tables.rs` makes the tables from the goldens, and sentences, which must
//! stand in their document word for word and are changed by hand. Numbers of other origin stand in tables marked `measured:`
//! (with machine and date) or `stored:` (with the file).

use crate::evidence::counted_figures::counted_figures;
use crate::evidence::diagram::Diagram;
use crate::evidence::tour_figures::{figures, pictures};
use crate::ledgers::{files_below, specification, tables};
use crate::prelude::*;

/// README.md, the texts in `paper/` and the tour, by their path.
pub fn documents() -> BTreeMap<String, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = vec![root.join("README.md")];
    files.extend(files_below(&root.join("paper")));
    files.retain(|file| file.extension().is_some_and(|end| end == "md"));
    files
        .into_iter()
        .map(|file| {
            let name = file.strip_prefix(root).unwrap();
            let text = fs::read_to_string(&file).unwrap();
            (name.display().to_string(), text)
        })
        .collect()
}

/// How the names of diagrams and of other drawings begin.
const FIGURE: &str = "figure_";
const PICTURE: &str = "picture_";

#[test]
fn computed_blocks_are_what_the_program_computes() {
    let (start, end) = ("<!-- computed: ", "<!-- end -->");
    let mut blocks = tables::tables();
    blocks.insert("specification".to_owned(), specification::page());
    let svg = |(name, diagram): (&str, Diagram)| {
        let svg = diagram.svg().unwrap();
        (format!("{FIGURE}{name}"), svg)
    };
    // The documentation's header lets them scroll, and turns them over on a dark page.
    let drawing = |(name, svg): (String, String)| {
        let svg = format!("<div class=\"drawing\">\n{}\n</div>", svg.trim());
        (name, svg)
    };
    let of_tour = figures().into_iter().map(svg).chain(pictures());
    blocks.extend(of_tour.map(drawing));
    blocks.extend(counted_figures().into_iter().map(svg));
    let (mut seen, mut wrong) = (BTreeSet::new(), Vec::new());
    for (document, text) in documents() {
        let mut pieces = text.split(start);
        let mut written = pieces.next().unwrap_or_default().to_owned();
        for piece in pieces {
            let (name, rest) = piece.split_once(" -->\n").expect("the end of a marker");
            let (old, after) = rest.split_once(end).expect("the end of a block");
            let block = blocks
                .get(name)
                .unwrap_or_else(|| panic!("{document}: {name}"));
            let new = format!("{}\n", block.trim());
            // Places in a figure to a tenth of a pixel: another machine's last digit may round them the other way.
            let is_drawn = [FIGURE, PICTURE].iter().any(|kind| name.starts_with(kind))
                && Numbers::DRAWN.agree(old, &new);
            if old != new && !is_drawn {
                wrong.push(format!("{document}: {name}"));
            }
            written += &format!("{start}{name} -->\n{new}{end}{after}");
            seen.insert(name.to_owned());
        }
        if std::env::var("CORFEM_WRITE").is_ok_and(|value| value == "1") {
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
    "paper/interpretation.md",
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
