//! The ledgers: lists, documents and the rooms of the code, held against the code, the tests and the goldens. All files are read once; a
//! ledger tells what is wrong, a line each: the file, and what.

pub mod code;
pub mod documents;
pub mod equations;
pub mod package;
pub mod programs;
pub mod sentences;
pub mod specification;
pub mod tables;
pub mod tour;
pub mod wrong_forms;

use crate::prelude::*;

/// One test a ledger.
macro_rules! ledgers {
    ($($module:ident: $($ledger:ident)+;)+) => { $($(
        #[test]
        fn $ledger() {
            let wrong: Vec<String> = $module::$ledger();
            assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
        }
    )+)+ };
}

ledgers! {
    code:
        every_room_imports_only_from_rooms_before_it
        no_two_files_import_each_other
        no_room_weighs_more_than_its_ceiling
        documentation_begins_with_its_noun
        every_file_of_tests_is_part_of_the_test_program;
    documents:
        computed_blocks_are_what_the_program_computes
        figures_of_documents_are_what_the_program_draws
        every_link_leads_to_a_file_and_every_document_is_two_links_from_the_front_page
        every_table_of_numbers_says_where_they_come_from
        contributing_names_every_variable_and_only_files_that_are_there
        no_document_has_more_words_than_its_ceiling
        what_the_front_page_shows_is_what_the_program_prints
        markdown_leaves_every_formula_as_it_is_written;
    equations:
        every_equation_has_its_function_its_tests_and_a_wrong_form
        every_entry_of_the_errata_is_shown_by_a_test
        every_number_has_two_routes_and_tests_that_exist;
    package:
        the_package_has_what_its_documents_lead_to
        programs_of_users_need_no_dependency_but_this_crate;
    sentences:
        every_sentence_on_the_step_or_on_case_4_has_its_test
        every_sentence_with_a_number_says_where_it_comes_from
        every_superlative_is_of_all_its_rivals
        sentences_are_what_the_program_computes;
    tour:
        every_number_said_in_the_tour_stands_in_its_code
        what_the_tour_quotes_are_the_lines_of_the_method
        every_chapter_has_its_parts_and_leads_to_its_neighbors
        every_public_module_of_the_method_points_to_its_chapter;
}

/// Files of a folder alone.
fn files_of(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    let paths = entries.map(|entry| entry.path());
    paths.filter(|path| path.is_file()).collect()
}

/// Every file of a folder and of those in it.
pub fn files_below(folder: &Path) -> Vec<PathBuf> {
    let mut files = files_of(folder);
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(files_below(&path));
        }
    }
    files
}

/// Texts of the project by their path.
static FILES: LazyLock<BTreeMap<String, String>> = LazyLock::new(|| {
    let mut paths = files_of(&in_root(""));
    for folder in ["golden", "paper", "src", "tests"] {
        paths.extend(files_below(&in_root(folder)));
    }
    let mut files = BTreeMap::new();
    for path in paths {
        let name = path.strip_prefix(in_root("")).unwrap().display();
        if let Ok(text) = fs::read_to_string(&path) {
            files.insert(name.to_string(), text);
        }
    }
    files
});

/// The text of a file.
pub fn file(name: &str) -> &'static str {
    let text = FILES.get(name);
    text.unwrap_or_else(|| panic!("there is no {name}"))
}

/// Names and texts of the files that begin and end so.
pub fn files(start: &str, end: &str) -> Vec<(&'static str, &'static str)> {
    let all = FILES.iter().map(|(name, text)| (&name[..], &text[..]));
    all.filter(|(name, _)| name.starts_with(start) && name.ends_with(end))
        .collect()
}

/// README.md, the texts in `paper/` and the tour.
pub fn documents() -> Vec<(&'static str, &'static str)> {
    [files("README.md", ""), files("paper/", ".md")].concat()
}

/// These and the READMEs of `golden`.
pub fn documents_and_readmes() -> Vec<(&'static str, &'static str)> {
    [documents(), files("golden/", "README.md")].concat()
}

pub fn is_word(character: char) -> bool {
    character.is_alphanumeric() || character == '_'
}

/// Words of a text on one line.
pub fn words(text: &str) -> String {
    text.split_whitespace().collect_vec().join(" ")
}

/// Whether a folder has a function, type or test by its full name, behind one of these keywords.
pub fn defines(folder: &str, name: &str, keywords: &[&str]) -> bool {
    let Some((module, name)) = name.rsplit_once("::") else {
        return false;
    };
    let path = format!("{folder}/{}", module.replace("::", "/"));
    let text = FILES
        .get(&format!("{path}.rs"))
        .or(FILES.get(&format!("{path}/mod.rs")));
    let text = text.map_or("", |text| text);
    keywords.iter().any(|keyword| {
        let item = format!("{keyword}{name}");
        let mut rests = text.split(&item).skip(1);
        rests.any(|rest| !rest.starts_with(is_word))
    })
}

pub fn is_test(name: &str) -> bool {
    defines("tests", name, &["]\nfn ", "]\n    fn "])
}

/// The strings of a list in a table.
pub fn strings(entry: &toml::Table, key: &str) -> Vec<String> {
    let list = entry[key].as_array().unwrap().iter();
    list.map(|value| value.as_str().unwrap().to_owned())
        .collect()
}
