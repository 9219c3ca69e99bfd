//! The report as a story: the answer, every case with its figure and what to see in it, then the method and the appendix.

use crate::paper::tables::cases::summary;
use crate::presentation::figures::{figures, results};
use crate::presentation::page::html;

/// Ids of all sections with what stands in them.
fn sections(html: &str) -> Vec<(&str, &str)> {
    let sections = html.split("<section id=\"").skip(1);
    sections.map(|rest| rest.split_once('"').unwrap()).collect()
}

#[test]
fn the_answer_comes_first_then_the_cases_then_method_and_tables() {
    let html = html();
    let found: Vec<&str> = sections(&html).into_iter().map(|(id, _)| id).collect();
    let story = ["case-1", "case-2", "case-3", "case-4", "method"];
    let mut expected = vec!["try".to_owned()];
    expected.extend(story.iter().map(|part| format!("story-{part}")));
    expected.extend(["appendix", "box"].map(String::from));
    expected.extend((1..=4).map(|case| format!("case-{case}")));
    expected.extend(["fewer-modes", "cost", "differences", "made"].map(String::from));
    assert_eq!(found, expected);
    // Before all sections: a sentence with the summary's numbers, the summary, frequencies and gages before and after.
    let (head, _) = html.split_once("<section").unwrap();
    let summary = summary(results()).unwrap();
    let corrected = |cell: usize| {
        let cells = summary.rows[..3]
            .iter()
            .map(|row| row.cells[cell].computed());
        cells.collect::<Vec<_>>().join(", ")
    };
    let sentence = format!(
        "errors of {} % RMS fall to {} %",
        corrected(0),
        corrected(1)
    );
    assert!(head.contains(&sentence), "{sentence}");
    for part in [
        "<figure class=\"moving\" id=\"case_2_structure\"",
        "<figure class=\"bars\" id=\"case_2_factors\"",
        "<table id=\"summary\"",
        "<figure id=\"case_2_frequencies\"",
        "<figure id=\"box_gages\"",
    ] {
        assert!(head.contains(part), "{part}");
    }
    // No other table of numbers stands before the appendix.
    let appendix = html.find("<section id=\"appendix\"").unwrap();
    assert_eq!(html[..appendix].matches("<table id=").count(), 1);
}

#[test]
fn every_case_has_its_figures_with_a_sentence_on_each() {
    let (html, words) = (html(), include_str!("../../paper/report.md"));
    let told: Vec<_> = sections(&html)
        .into_iter()
        .filter(|(id, _)| id.starts_with("story-"))
        .collect();
    assert_eq!(told.len(), words.matches("\n## ").count());
    for (id, body) in &told[..4] {
        let captions: Vec<&str> = body.split("<figcaption><strong>").skip(1).collect();
        // Beside it the case moves; that of the first screen does so there.
        let moving = usize::from(*id != "story-case-2");
        assert_eq!(
            (captions.len(), body.matches("<figure ").count()),
            (1, 1 + moving),
            "{id}"
        );
        for caption in captions {
            let (see, rest) = caption.split_once("</strong> ").unwrap();
            assert!(see.ends_with('.') && see.len() > 40, "{id}: {see}");
            assert!(rest.starts_with("Case"), "{rest}");
        }
        assert!(
            body.contains("class=\"note\"") || body.contains("class=\"finding\""),
            "{id} says what it came to"
        );
    }
    // Every name in the words is one of a figure.
    for name in words
        .split("\n- `")
        .skip(1)
        .filter_map(|line| line.split('`').next())
    {
        assert!(figures().iter().any(|figure| figure.name == name), "{name}");
    }
}

#[test]
fn the_method_has_its_flow_five_equations_and_the_words_it_uses() {
    let html = html();
    let (id, method) = sections(&html)[5];
    assert_eq!((id, method.matches("<li>").count()), ("story-method", 6));
    for number in ["(1, 2)", "(4)", "(5, 6)", "(7, 8)", "(12, 13)"] {
        let row = method
            .split("<tr>")
            .find(|row| row.contains(number))
            .unwrap();
        assert!(row.contains("<math>"), "{number}");
    }
    for word in ["GVT", "SRSS, RMS", "<i>T</i>", "<i>B</i>", "MAC"] {
        assert!(method.contains(&format!("<tr><td>{word}</td>")), "{word}");
    }
}
