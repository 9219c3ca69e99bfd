//! Decks in any form: in small, large or free field, with tabs, in lower case, with continuations by tag, by star, by plus and by blanks, and
//! with remarks. They are read back as what they say.

use crate::common::decks::bulk_text;
use crate::prelude::*;

/// A deck of every card that is read; what each says is in `files/decks.toml`.
const EVERY_CARD: &str = include_str!("files/every_card.bdf");

/// Name and fields of every card of a deck in free field, or as the crate writes it.
fn cards(text: &str) -> Vec<Vec<String>> {
    let mut all: Vec<Vec<String>> = Vec::new();
    for line in text.lines() {
        let fields = if line.contains(',') {
            line.split(',').map(str::to_owned).collect_vec()
        } else {
            let (line, width) = (
                format!("{line:80}"),
                if line.contains('*') { 16 } else { 8 },
            );
            let fields = (8..72).step_by(width);
            let fields = fields.map(|at| line[at..at + width].trim().to_owned());
            let name = line[..8].trim().trim_end_matches('*').to_owned();
            once(name).chain(fields).collect()
        };
        match (fields[0].chars().next(), all.last_mut()) {
            (None | Some('+' | '*'), Some(card)) => {
                // A line of large fields is half of one.
                card.resize((card.len() - 1).next_multiple_of(4) + 1, String::new());
                card.extend_from_slice(&fields[1..]);
            }
            _ => all.push(fields),
        }
    }
    all
}

/// A card in lines of a form each.
fn formed(draws: &mut Draws, card: &[String], tags: &mut usize) -> String {
    let (name, fields) = card.split_first().unwrap();
    let filled = fields.iter().rposition(|field| !field.is_empty());
    let fields = fields[..filled.map_or(1, |last| last + 1)]
        .iter()
        .map(|field| {
            // An exponent may have a letter, or a blank before its sign.
            let exponent = field
                .rfind(['+', '-'])
                .filter(|at| *at > 0 && field.contains('.'));
            match exponent.filter(|_| field.len() < 16 && draws.below(3) == 0) {
                Some(at) => [&field[..at], ["E", "D", " "][draws.below(3)], &field[at..]].concat(),
                None => field.clone(),
            }
        });
    let fields = fields.collect_vec();
    // Every eight fields are one small line, or two large ones of which the last may be missing.
    let mut parts: Vec<(&[String], bool)> = Vec::new();
    for row in fields.chunks(8) {
        match row.iter().all(|field| field.len() <= 8) && draws.below(2) == 0 {
            true => parts.push((row, false)),
            false => parts.extend(row.chunks(4).map(|half| (half, true))),
        }
    }
    let mut begin = name.clone() + if parts[0].1 { "*" } else { "" };
    let mut lines = Vec::new();
    for (at, (cells, is_large)) in parts.iter().enumerate() {
        let (mut end, mut next) = (String::new(), String::new());
        if let Some((_, large)) = parts.get(at + 1) {
            let mark = if *large { "*" } else { "+" };
            match draws.below(3) {
                0 => next = mark.to_owned(),
                1 if !large => (),
                _ => {
                    *tags += 1;
                    end = format!("{}Q{tags}", ["+", "*", "C", "0"][draws.below(4)]);
                    next = format!("{mark}Q{tags}");
                }
            }
        } else if draws.below(6) == 0 {
            end = "REMARK".to_owned();
        }
        lines.push(line(draws, &begin, cells, *is_large, &end));
        begin = next;
    }
    lines.join("\n")
}

fn line(draws: &mut Draws, begin: &str, cells: &[String], is_large: bool, end: &str) -> String {
    let (width, count) = if is_large { (16, 4) } else { (8, 8) };
    let mut line = if draws.below(3) == 0 {
        let longer = |cell: &String| match cell.parse::<f64>() {
            // A free number may be longer than a field.
            Ok(_) if cell.contains('.') && !cell.contains(['E', 'D']) && draws.below(8) == 0 => {
                format!("{cell}{}", "0".repeat(18 - cell.len()))
            }
            _ => cell.clone(),
        };
        let mut all = once(begin.to_owned())
            .chain(cells.iter().map(longer))
            .collect_vec();
        if !end.is_empty() {
            all.resize(count + 1, String::new());
            all.push(end.to_owned());
        }
        // A comma says that the format is free.
        all.resize(all.len().max(2), String::new());
        all.join([",", " , "][draws.below(2)])
    } else {
        let (has_tabs, is_right) = (draws.below(4) == 0, draws.below(3) == 0);
        let cell = |text: &str, width: usize, is_right: bool| match (has_tabs, is_right) {
            (true, _) => text.to_owned() + &"\t".repeat((width - text.len()).div_ceil(8)),
            (_, true) => format!("{text:>width$}"),
            _ => format!("{text:width$}"),
        };
        let text = |place| cells.get(place).map_or("", String::as_str);
        let cells = (0..count).map(|place| cell(text(place), width, is_right));
        let line = cell(begin, 8, false) + &cells.collect::<String>() + end;
        match !has_tabs && draws.below(6) == 0 {
            true => format!("{line:80}00000012"),
            false => line,
        }
    };
    if draws.below(3) == 0 {
        line = line.to_lowercase();
    }
    if draws.below(5) == 0 {
        line += "$ a comment, with commas\n\n$ and another";
    }
    line
}

properties! {
    #[test]
    fn decks_of_every_card_in_every_form_are_read_back_equal(model in bulk_data(), seed in any::<u64>()) {
        let (mut draws, mut tags) = (Draws(seed), 0);
        let mut drawn = |text: &str| {
            let cards = cards(text);
            let cards = cards.iter().map(|card| (draws.unit(), formed(&mut draws, card, &mut tags)));
            let mut cards = cards.collect_vec();
            cards.sort_by(|a, b| a.0.total_cmp(&b.0));
            cards.into_iter().map(|card| card.1 + "\n").collect::<String>()
        };
        let own = drawn(&bulk_text(&model)?);
        let read = read_deck(&own).unwrap_or_else(|error| panic!("{error}\n{own}"));
        prop_assert_eq!(&read.model, &model, "{}", own);
        let (control, bulk) = EVERY_CARD.split_once("BEGIN BULK\n").unwrap();
        let bulk = drawn(bulk.trim_end_matches("ENDDATA\n"));
        let text = format!("{control}BEGIN BULK\n{bulk}ENDDATA\n");
        let read = read_deck(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        prop_assert_eq!(&read.model, &read_deck(EVERY_CARD)?.model, "{}", text);
        let refused = [Reason::Unknown, Reason::Lacking, Reason::Ignored];
        prop_assert!(read.unread.iter().all(|card| !refused.contains(&card.reason)));
    }
}
