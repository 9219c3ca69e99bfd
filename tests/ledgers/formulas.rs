//! The formulas of the documentation: what is typeset between two `$` is what the source says, and nothing that
//! Markdown has made of it; and every command in them is one that `formulas-as-mathml.html` knows.
//!
//! Markdown knows nothing of formulas. In `(p_{ij})_r ... (p_{ji})_r` it reads the two outer underscores as emphasis,
//! `[K](V)` as a link, `\,` as a comma and `'` as a quotation mark.

use crate::ledgers::files_below;
use crate::prelude::*;

/// The extensions of Markdown that rustdoc turns on.
fn rustdoc_options() -> Options {
    Options::ENABLE_TABLES
        | Options::ENABLE_FOOTNOTES
        | Options::ENABLE_STRIKETHROUGH
        | Options::ENABLE_TASKLISTS
        | Options::ENABLE_SMART_PUNCTUATION
}

/// Text that the browser gets in one piece, and where in the source each piece of it comes from.
#[derive(Default)]
struct TextNode {
    text: String,
    pieces: Vec<(usize, usize)>,
}

impl TextNode {
    fn push(&mut self, text: &str, source_start: usize) {
        self.pieces.push((self.text.len(), source_start));
        self.text.push_str(text);
    }

    /// Place in the source of a place in the text.
    fn source(&self, at: usize) -> usize {
        let (text_start, source_start) = *self
            .pieces
            .iter()
            .rev()
            .find(|(text_start, _)| *text_start <= at)
            .unwrap();
        source_start + at - text_start
    }

    /// Its formulas and, of each, whether it is the source's; an error for a `$` without a partner.
    fn formulas(&self, source: &str) -> Result<Vec<String>, String> {
        let dollars = self.text.match_indices('$').map(|(at, _)| at).collect_vec();
        let mut marks: Vec<(usize, usize)> = Vec::new();
        for at in dollars {
            match marks.last_mut() {
                Some((start, length)) if *start + *length == at && *length == 1 => *length = 2,
                _ => marks.push((at, 1)),
            }
        }
        let mut formulas = Vec::new();
        for pair in marks.chunks(2) {
            let [(start, length), (end, same_length)] = *pair else {
                return Err(format!("a formula does not end: {}", self.text));
            };
            let inside = &self.text[start + length..end];
            let written = &source[self.source(start) + length..self.source(end)];
            let words = |text: &str| text.split_whitespace().collect_vec().join(" ");
            if length != same_length || words(inside) != words(written) {
                return Err(format!(
                    "the source has\n    {written}\nthe reader gets\n    {inside}"
                ));
            }
            formulas.push(inside.to_owned());
        }
        Ok(formulas)
    }
}

/// The formulas of a document, or what is wrong with each that Markdown changes.
fn formulas(markdown: &str) -> Result<Vec<String>, Vec<String>> {
    let (mut nodes, mut node, mut in_code) = (Vec::new(), TextNode::default(), false);
    for (event, range) in Parser::new_ext(markdown, rustdoc_options()).into_offset_iter() {
        match event {
            Event::Start(Tag::CodeBlock(_)) => in_code = true,
            Event::End(TagEnd::CodeBlock) => in_code = false,
            Event::Text(text) if !in_code => {
                node.push(&text, range.start);
                continue;
            }
            Event::SoftBreak => {
                node.push("\n", range.start);
                continue;
            }
            _ => (),
        }
        nodes.push(std::mem::take(&mut node));
    }
    nodes.push(node);
    let (mut found, mut wrong) = (Vec::new(), Vec::new());
    for node in nodes {
        match node.formulas(markdown) {
            Ok(more) => found.extend(more),
            Err(what) => wrong.push(what),
        }
    }
    if wrong.is_empty() {
        Ok(found)
    } else {
        Err(wrong)
    }
}

/// The documentation comments of a Rust file, each as Markdown.
fn documentation(source: &str) -> Vec<String> {
    let mut comments = vec![String::new()];
    for line in source.lines() {
        let line = line.trim_start();
        match line
            .strip_prefix("///")
            .or_else(|| line.strip_prefix("//!"))
        {
            Some(text) => {
                let last = comments.last_mut().unwrap();
                last.push_str(text.strip_prefix(' ').unwrap_or(text));
                last.push('\n');
            }
            None => comments.push(String::new()),
        }
    }
    comments.retain(|comment| !comment.is_empty());
    comments
}

/// Every text of the project that a reader sees as Markdown, with its file.
fn documents() -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut documents = Vec::new();
    for folder in ["src", "paper", "golden"] {
        for file in files_below(&root.join(folder)) {
            let name = file.display().to_string();
            let read = || fs::read_to_string(&file).unwrap();
            match file.extension().and_then(|end| end.to_str()) {
                Some("rs") => documents.extend(
                    documentation(&read())
                        .into_iter()
                        .map(|text| (name.clone(), text)),
                ),
                Some("md") => documents.push((name, read())),
                _ => (),
            }
        }
    }
    let readme = fs::read_to_string(root.join("README.md")).unwrap();
    documents.push(("README.md".to_owned(), readme));
    documents
}

/// The commands of a formula, without their backslash.
fn commands(formula: &str) -> BTreeSet<&str> {
    formula
        .split('\\')
        .skip(1)
        .map(|rest| {
            let end = rest.find(|c: char| !c.is_ascii_alphabetic());
            &rest[..end.unwrap_or(rest.len())]
        })
        .filter(|name| !name.is_empty())
        .collect()
}

/// Whether the script in `formulas-as-mathml.html` has the command: as a key of one of its tables or by name.
fn is_typeset(command: &str) -> bool {
    let script = include_str!("../../formulas-as-mathml.html");
    ["begin", "end", "text", "mathrm", "newline"].contains(&command)
        || script.contains(&format!("name === \"{command}\""))
        || [" ", "{"]
            .iter()
            .any(|before| script.contains(&format!("{before}{command}: ")))
}

#[test]
fn markdown_leaves_every_formula_as_it_is_written() {
    let mut count = 0;
    let mut wrong = Vec::new();
    for (file, text) in documents() {
        match formulas(&text) {
            Ok(found) => count += found.len(),
            Err(what) => wrong.extend(what.into_iter().map(|what| format!("{file}: {what}"))),
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(count > 300, "only {count} formulas were read");
}

#[test]
fn every_command_in_a_formula_is_typeset() {
    for (file, text) in documents() {
        for formula in formulas(&text).unwrap_or_default() {
            for command in commands(&formula) {
                assert!(is_typeset(command), "{file}: \\{command} in {formula}");
            }
        }
    }
    assert!(is_typeset("frac") && is_typeset("alpha") && is_typeset("quad"));
    assert!(!is_typeset("overbrace"));
}

#[test]
fn the_check_finds_what_markdown_changes() {
    for broken in [
        r"$$ (\Delta\lambda_i)_r = -\frac{(\gamma_i)_\rho \sum_j \beta_{ij}(p_{ji})_\rho}{k_{ii}} $$",
        r"$\big[k(\gamma_j - \Lambda)\big](p_{sj})_r$ and $(p_{sj})_r$",
        r"The change $[K](V)$ of a matrix",
        r"$a *b* c$ is a product",
        r"$K = 0.001\, c_e K_e$",
        r"$\{1\}^t R$",
        r"rows $a \\ b$ of a matrix",
        r"$P_n'(s)$",
        r"$a <b> c$",
        "a price of $5",
        "$$ a $ and $$ b $",
        "$a `b` c$",
    ] {
        assert!(formulas(broken).is_err(), "{broken}");
    }
}

#[test]
fn the_check_passes_what_markdown_leaves_alone() {
    let sound = r"With $\gamma_i^{(\rho)} = p_{ij}$ and *emphasis* of `a $ in code` and [a link](b):

$$ \begin{bmatrix} 1 & 0 \newline 0 & 1 \end{bmatrix},
   \qquad -1 < \nu \le 1 $$

    $ an indented block

| a table | $x_i$ |
|---|---|
| and | *$y$* |
";
    let found = formulas(sound).unwrap();
    assert_eq!(found.len(), 4, "{found:?}");
    assert_eq!(commands(&found[0]), ["gamma", "rho"].into());
}

#[test]
fn documentation_is_read_comment_by_comment() {
    let source = "//! Of the module.\n\n/// First line\n///   and second.\nfn f() {} // no\n";
    assert_eq!(
        documentation(source),
        ["Of the module.\n", "First line\n  and second.\n"]
    );
}
