//! Decks of every supported card, each in a form of its own: in small, large or free field, with tabs, in lower case, with continuations
//! by tag, by star, by plus and by blanks, and with remarks. They are read back as the model that they were made of.

use crate::prelude::*;

/// Names of all cards that are read.
const CARDS: [&str; 27] = [
    "GRID", "GRDSET", "CORD2R", "CORD2C", "CONROD", "MAT1", "CMASS1", "PMASS", "CMASS2", "CONM2",
    "SPC", "SPC1", "SPCADD", "MPC", "MPCADD", "PARAM", "EIGR", "EIGRL", "CROD", "PROD", "CSHEAR",
    "PSHEAR", "CQDMEM", "PQDMEM", "CTRMEM", "PTRMEM", "FORCE",
];
/// Forms that some deck must have, beside every card in small, large and free field.
const FORMS: [&str; 24] = [
    "a tag that begins with +",
    "a tag that begins with *",
    "a tag that begins with C",
    "a tag that begins with 0",
    "a continuation by star alone",
    "a continuation by plus alone",
    "a continuation by blanks",
    "a continuation of another width",
    "tabs between small fields",
    "tabs between large fields",
    "fields at the right",
    "lower case",
    "a comment",
    "a remark in field 10",
    "text behind column 80",
    "an exponent with a letter",
    "a blank in a number",
    "a free number of more than 16 characters",
    "a blank PID",
    "E alone",
    "a parameter in case control",
    "supports by GRDSET",
    "a grid from one to another",
    "a direction against an axis",
];

/// Directions of a coordinate system as basic ones with their signs: of number 1 these are y, z, x, of number 2 y, -x, z.
fn turned(system: usize) -> ([usize; 3], [f64; 3]) {
    match system {
        1 => ([1, 2, 0], [1.0; 3]),
        2 => ([1, 0, 2], [1.0, -1.0, 1.0]),
        _ => ([0, 1, 2], [1.0; 3]),
    }
}

/// A deck that is being written.
struct Deck {
    draws: Draws,
    /// Cards, in any order.
    cards: Vec<String>,
    /// What stands in case control beside what selects sets.
    control: String,
    tags: usize,
    seen: BTreeSet<String>,
    /// The factor of masses by PARAM,WTMASS.
    weight: f64,
}

impl Deck {
    fn chance(&mut self, of: usize) -> bool {
        self.draws.below(of) == 0
    }

    fn see(&mut self, form: &str) {
        self.seen.insert(form.to_owned());
    }

    fn pick<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.draws.below(all.len())]
    }

    /// A real number of at most 16 characters.
    fn number(&mut self, value: f64) -> String {
        let short = large_real(value).unwrap();
        let exponent = short.rfind(['+', '-']).filter(|at| *at > 0);
        match exponent {
            Some(at) if short.len() < 16 && self.chance(3) => {
                let more = self.pick(&["E", "D", " "]);
                self.see(match more {
                    " " => "a blank in a number",
                    _ => "an exponent with a letter",
                });
                [&short[..at], more, &short[at..]].concat()
            }
            _ => short,
        }
    }

    /// Adds a card in any form.
    fn card(&mut self, name: &str, fields: &[String]) {
        let filled = fields.iter().rposition(|field| !field.is_empty());
        let fields = &fields[..filled.map_or(1, |last| last + 1)];
        let rows = fields.chunks(8).collect_vec();
        // Every row is one small line, or two large ones of which the last may be missing.
        let mut parts: Vec<(&[String], bool)> = Vec::new();
        for (at, row) in rows.iter().enumerate() {
            let fits_small = row.iter().all(|field| field.len() <= 8);
            if fits_small && self.chance(2) {
                parts.push((row, false));
                continue;
            }
            let (first, second) = row.split_at(row.len().min(4));
            parts.push((first, true));
            if !second.is_empty() || at + 1 < rows.len() {
                parts.push((second, true));
            }
        }
        if parts.iter().any(|part| part.1 != parts[0].1) {
            self.see("a continuation of another width");
        }
        let mut lines = Vec::new();
        let mut begin = format!("{name}{}", if parts[0].1 { "*" } else { "" });
        for (at, (cells, is_large)) in parts.iter().enumerate() {
            let next = parts.get(at + 1);
            let (mut end, mut next_begin) = (String::new(), String::new());
            if let Some((_, large)) = next {
                let mark = if *large { "*" } else { "+" };
                (end, next_begin) = match self.draws.below(3) {
                    0 => {
                        self.see(if *large {
                            "a continuation by star alone"
                        } else {
                            "a continuation by plus alone"
                        });
                        (String::new(), mark.to_owned())
                    }
                    1 if !large => {
                        self.see("a continuation by blanks");
                        Default::default()
                    }
                    _ => {
                        self.tags += 1;
                        let first = self.pick(&['+', '*', 'C', '0']);
                        self.see(&format!("a tag that begins with {first}"));
                        let tag = format!("Q{}", self.tags);
                        (format!("{first}{tag}"), format!("{mark}{tag}"))
                    }
                };
            } else if self.chance(6) {
                self.see("a remark in field 10");
                end = "REMARK".to_owned();
            }
            let form = if at == 0 { name } else { "" };
            lines.push(self.line(form, &begin, cells, *is_large, &end));
            begin = next_begin;
        }
        self.cards.push(lines.join("\n"));
    }

    /// One line in a form of its own.
    fn line(
        &mut self,
        name: &str,
        begin: &str,
        cells: &[String],
        is_large: bool,
        end: &str,
    ) -> String {
        let (width, count) = if is_large { (16, 4) } else { (8, 8) };
        let kind = self.draws.below(3);
        let mut line = if kind == 0 {
            let mut all = vec![begin.to_owned()];
            for cell in cells {
                let is_real = cell.contains('.') && !cell.contains(' ');
                all.push(match cell.parse::<f64>() {
                    Ok(_) if is_real && !cell.contains(['E', 'D']) && self.chance(8) => {
                        self.see("a free number of more than 16 characters");
                        format!("{cell}{}", "0".repeat(18 - cell.len()))
                    }
                    _ => cell.clone(),
                });
            }
            if !end.is_empty() {
                all.resize(count + 1, String::new());
                all.push(end.to_owned());
            }
            // A comma says that the format is free.
            all.resize(all.len().max(2), String::new());
            all.join(if self.chance(2) { "," } else { " , " })
        } else {
            let has_tabs = kind == 1 && self.chance(2);
            let is_right = !has_tabs && self.chance(3);
            if has_tabs {
                self.see(if is_large {
                    "tabs between large fields"
                } else {
                    "tabs between small fields"
                });
            }
            if is_right {
                self.see("fields at the right");
            }
            let cell = |text: &str, width: usize, is_right: bool| match (has_tabs, is_right) {
                (true, _) => text.to_owned() + &"\t".repeat((width - text.len()).div_ceil(8)),
                (_, true) => format!("{text:>width$}"),
                _ => format!("{text:width$}"),
            };
            let mut line = cell(begin, 8, false);
            for place in 0..count {
                let text = cells.get(place).map_or("", String::as_str);
                line += &cell(text, width, is_right);
            }
            line += end;
            if !has_tabs && self.chance(6) {
                self.see("text behind column 80");
                line = format!("{line:80}00000012");
            }
            line
        };
        if !name.is_empty() {
            let kind = match kind {
                0 => "free",
                _ if is_large => "large",
                _ => "small",
            };
            self.seen.insert(format!("{name} {kind}"));
        }
        if self.chance(3) {
            self.see("lower case");
            line = line.to_lowercase();
        }
        if self.chance(5) {
            self.see("a comment");
            line += "$ a comment, with commas\n\n$ and another";
        }
        line
    }
}

fn words<const N: usize>(all: [&str; N]) -> Vec<String> {
    all.map(str::to_owned).to_vec()
}

/// Numbers of three digits, which small fields hold.
fn shortened(model: &mut BulkData) {
    let short = |value: f64| format!("{value:.2e}").parse::<f64>().unwrap();
    for grid in &mut model.grids {
        grid.position.apply(|value| *value = short(*value));
    }
    for element in &mut model.elements {
        let own = &mut element.material;
        let derived = |of: &Material| Material::isotropic(of.youngs_modulus, of.poissons_ratio);
        let is_derived = derived(own).is_ok_and(|other| other.shear_modulus == own.shear_modulus);
        element.size = short(element.size);
        own.youngs_modulus = short(own.youngs_modulus);
        own.density = short(own.density);
        own.shear_modulus = match is_derived {
            true => derived(own).unwrap().shear_modulus,
            false => short(own.shear_modulus),
        };
    }
    for point in &mut model.masses {
        point.mass = short(point.mass);
    }
    for tie in &mut model.ties {
        tie.coefficient = short(tie.coefficient);
        tie.terms
            .iter_mut()
            .for_each(|(_, value)| *value = short(*value));
    }
}

/// A deck in drawn forms, the model that it describes, and the forms that it has.
fn drawn(mut model: BulkData, seed: u64) -> (String, BulkData, BTreeSet<String>) {
    let mut deck = Deck {
        draws: Draws(seed),
        cards: Vec::new(),
        control: String::new(),
        tags: 0,
        seen: BTreeSet::new(),
        weight: 1.0,
    };
    if deck.chance(2) {
        deck.weight = 10.0;
        if deck.chance(2) {
            deck.see("a parameter in case control");
            deck.control = "PARAM,WTMASS,10.\n".to_owned();
        } else {
            deck.card("PARAM", &words(["WTMASS", "10."]));
        }
    }
    if deck.chance(2) {
        shortened(&mut model);
    }
    for element in &mut model.elements {
        if element.kind == ElementKind::Rod && deck.chance(3) {
            let Material {
                youngs_modulus,
                density,
                ..
            } = element.material;
            let axial = Material::isotropic(youngs_modulus, 0.0).unwrap();
            element.material = Material { density, ..axial };
        }
    }
    let has_common = model.ties.is_empty() && deck.chance(2);
    if has_common {
        model
            .grids
            .iter_mut()
            .for_each(|grid| grid.constrained[0] = true);
    }
    let systems = write_grids(&mut deck, &mut model, has_common);
    write_elements(&mut deck, &model);
    write_masses_and_ties(&mut deck, &model, &systems);
    deck.card("FORCE", &words(["3", "1", "", "1.", "0.", "0.", "1."]));
    deck.card("EIGRL", &words(["1", "", "", "6"]));
    let method = words(["2", "INV", "1.", "90.", "4", "4", "", "", "MASS"]);
    deck.card("EIGR", &method);
    let mut order: Vec<(usize, String)> = Vec::new();
    for card in std::mem::take(&mut deck.cards) {
        order.push((deck.draws.below(1 << 30), card));
    }
    order.sort();
    let bulk = order.into_iter().map(|(_, card)| card).collect_vec();
    let mpc = if model.ties.is_empty() {
        ""
    } else {
        "MPC = 8\n"
    };
    let text = format!(
        "SOL 103\nCEND\nSPC = 7\n{mpc}METHOD = 1\n{}BEGIN BULK\n{}\nENDDATA\n",
        deck.control,
        bulk.join("\n")
    );
    (text, model, deck.seen)
}

/// Writes coordinate systems, grids and supports; the coordinate system of each grid's directions.
fn write_grids(deck: &mut Deck, model: &mut BulkData, has_common: bool) -> BTreeMap<usize, usize> {
    let label = model.first_free_label();
    model.grids.push(Grid {
        label,
        position: Vector3::new(2.5, 0.0, 4.0),
        constrained: [true; 3],
    });
    for (name, number, [along, across]) in [
        ("CORD2R", "5", [["0.", "0.", "1."], ["1.", "0.", "0."]]),
        ("CORD2R", "1", [["2.", "0.", "0."], ["0.", "1.", "0."]]),
        ("CORD2R", "2", [["0.", "0.", "4."], ["0.", "1.", "0."]]),
        ("CORD2C", "3", [["0.", "0.", "1."], ["2.", "0.", "1."]]),
    ] {
        let references = if number == "5" {
            &["", "0"][..]
        } else {
            &["", "5"]
        };
        let mut fields = words([number, deck.pick(references), "0.", "0.", "0."]);
        fields.extend(words(along));
        fields.extend(words(across));
        deck.card(name, &fields);
    }
    let defaults = match has_common {
        true => [0, 0],
        false => [0, 1].map(|_| deck.pick(&[0, 1, 2, 5])),
    };
    let named = |system: usize| {
        if system == 0 {
            String::new()
        } else {
            system.to_string()
        }
    };
    if has_common || defaults != [0, 0] {
        let support = if has_common { "1" } else { "" };
        if has_common {
            deck.see("supports by GRDSET");
        }
        let mut fields = vec![String::new(); 7];
        fields[1] = named(defaults[0]);
        fields[5] = named(defaults[1]);
        fields[6] = support.to_owned();
        deck.card("GRDSET", &fields);
    }
    let mut systems = BTreeMap::new();
    let mut supports: Vec<[String; 2]> = Vec::new();
    let mut lists: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for grid in &model.grids {
        // The last one is at its place in the cylindrical system.
        let is_last = grid.label == label;
        let of_place = if is_last { 3 } else { deck.pick(&[0, 1, 2, 5]) };
        let of_motion = if has_common {
            0
        } else {
            deck.pick(&[0, 1, 2, 5])
        };
        systems.insert(grid.label, of_motion);
        let ((along, signs), at) = (turned(of_place), grid.position);
        let local = [0, 1, 2].map(|axis| signs[axis] * at[along[axis]]);
        let held: String = (0..3)
            .filter(|axis| grid.constrained[turned(of_motion).0[*axis]])
            .map(|axis| (axis + 1).to_string())
            .collect();
        let how = if is_last { 0 } else { deck.draws.below(4) };
        let mut fields = vec![grid.label.to_string()];
        for (system, default) in [of_place, of_motion].into_iter().zip(defaults) {
            let is_blank = system == default && deck.chance(2) || system == 0 && default == 0;
            fields.push(if is_blank {
                String::new()
            } else {
                system.to_string()
            });
        }
        let of_motion = fields.pop().unwrap();
        for value in local {
            fields.push(deck.number(value));
        }
        fields.push(of_motion);
        fields.push(if how == 0 {
            held.clone()
        } else {
            String::new()
        });
        match how {
            1 if !held.is_empty() => supports.push([grid.label.to_string(), held]),
            2 | 3 if !held.is_empty() => lists.entry(held).or_default().push(grid.label),
            _ => {}
        }
        deck.card("GRID", &fields);
    }
    write_supports(deck, model, supports, &lists);
    systems
}

fn write_supports(
    deck: &mut Deck,
    model: &BulkData,
    supports: Vec<[String; 2]>,
    lists: &BTreeMap<String, Vec<usize>>,
) {
    for two in supports.chunks(2) {
        let mut fields = words(["1"]);
        for [grid, held] in two {
            let displacement = deck.pick(&["0.", "", "0."]).to_owned();
            fields.extend([grid.clone(), held.clone(), displacement]);
        }
        deck.card("SPC", &fields);
    }
    for (held, grids) in lists {
        let rotations = deck.pick(&["", "456", "4"]);
        let mut fields = vec!["2".to_owned(), format!("{held}{rotations}")];
        let labels = model.grids.iter().map(|grid| grid.label).collect_vec();
        let mut rest = &grids[..];
        while let [first, more @ ..] = rest {
            fields.push(first.to_string());
            let place = labels.partition_point(|label| label < first);
            let is_next = more
                .first()
                .is_some_and(|second| labels.get(place + 1) == Some(second));
            rest = more;
            if deck.chance(2) {
                deck.see("a grid from one to another");
                let last = if is_next { more[0] } else { *first };
                fields.extend(["THRU".to_owned(), last.to_string()]);
                rest = &more[usize::from(is_next)..];
            }
        }
        deck.card("SPC1", &fields);
    }
    // Sets 1 and 2 must exist; what these hold is held anyway, and set 9 is not selected.
    let last = model.grids.last().unwrap().label.to_string();
    deck.card("SPC", &words(["1", &last, "123456"]));
    let first = model.grids[0].label.to_string();
    deck.card("SPC1", &words(["2", "1", &last]));
    deck.card("SPC1", &words(["9", "123", &first]));
    deck.card("SPCADD", &words(["7", "1", "2"]));
}

fn write_elements(deck: &mut Deck, model: &BulkData) {
    let mut of_cards: BTreeMap<&str, Vec<Vec<String>>> = BTreeMap::new();
    let mut materials: Vec<(Material, bool)> = Vec::new();
    for Element {
        label,
        kind,
        grids,
        size,
        material,
    } in &model.elements
    {
        let is_axial = *kind == ElementKind::Rod
            && material.poissons_ratio == 0.0
            && Material::isotropic(material.youngs_modulus, 0.0)
                .is_ok_and(|own| own.shear_modulus == material.shear_modulus);
        let known = materials
            .iter()
            .position(|own| *own == (*material, is_axial));
        let row = known.unwrap_or_else(|| {
            materials.push((*material, is_axial));
            materials.len() - 1
        });
        let (label, material) = (label.to_string(), (row + 1).to_string());
        let size = deck.number(*size);
        let corners = grids.iter().map(usize::to_string).collect_vec();
        let (connection, property) = match kind {
            ElementKind::Rod if deck.chance(2) => {
                let [a, b] = [corners[0].clone(), corners[1].clone()];
                let torsion = deck.pick(&["", "0."]).to_owned();
                let zero = deck.pick(&["", "0.", "0"]).to_owned();
                let fields = [label, a, b, material, size, torsion, zero.clone(), zero];
                deck.card("CONROD", &fields);
                continue;
            }
            ElementKind::Rod => ("CROD", "PROD"),
            ElementKind::ShearPanel => ("CSHEAR", "PSHEAR"),
            ElementKind::Membrane => ("CQDMEM", "PQDMEM"),
            ElementKind::Triangle => ("CTRMEM", "PTRMEM"),
        };
        let number = match deck.chance(3) {
            true => {
                deck.see("a blank PID");
                String::new()
            }
            false => label.clone(),
        };
        let connected = [vec![label.clone(), number], corners].concat();
        of_cards.entry(connection).or_default().push(connected);
        of_cards
            .entry(property)
            .or_default()
            .push(vec![label, material, size]);
    }
    for (name, entries) in &of_cards {
        for entry in entries {
            deck.card(name, entry);
        }
    }
    for (row, (material, is_axial)) in (1..).zip(materials) {
        let Material {
            youngs_modulus: e,
            poissons_ratio: nu,
            shear_modulus: g,
            density,
        } = material;
        let is_derived = Material::isotropic(e, nu).is_ok_and(|other| other.shear_modulus == g);
        let mut fields = vec![row.to_string(), deck.number(e)];
        let ratio = deck.number(nu);
        fields.extend(match (is_axial, is_derived) {
            (true, _) => {
                deck.see("E alone");
                [String::new(), String::new()]
            }
            (_, true) => [String::new(), ratio],
            _ => [deck.number(g), ratio],
        });
        fields.push(match density == 0.0 {
            true => String::new(),
            false => deck.number(density / deck.weight),
        });
        deck.card("MAT1", &fields);
    }
}

fn write_masses_and_ties(deck: &mut Deck, model: &BulkData, systems: &BTreeMap<usize, usize>) {
    // The direction of a grid's own that is along a basic one, and its sign.
    let own = |grid: usize, direction: usize| {
        let (along, signs) = turned(systems.get(&grid).copied().unwrap_or(0));
        let axis = along.iter().position(|basic| *basic == direction);
        let axis = axis.unwrap();
        ((axis + 1).to_string(), signs[axis])
    };
    let mut properties: Vec<String> = Vec::new();
    for point in &model.masses {
        let (label, grid) = (point.label.to_string(), point.grid.to_string());
        let mass = deck.number(point.mass / deck.weight);
        let Some(direction) = point.direction else {
            let system = deck.pick(&["", "0", "-1", "1"]).to_owned();
            let mut fields = vec![label, grid, system, mass];
            // Offsets and inertia of zero go on in the next line.
            let zeros = deck.pick(&[0, 3, 10]);
            fields.extend(vec!["0.".to_owned(); zeros]);
            if zeros > 3 {
                fields[7] = String::new();
            }
            deck.card("CONM2", &fields);
            continue;
        };
        let (axis, _) = own(point.grid, direction);
        if deck.chance(2) {
            properties.extend([label.clone(), mass]);
            deck.card("CMASS1", &[label.clone(), label, grid, axis]);
        } else {
            deck.card("CMASS2", &[label, mass, grid, axis]);
        }
    }
    let count = deck.pick(&[2, 8]);
    for fields in properties.chunks(count) {
        deck.card("PMASS", fields);
    }
    let mut used: BTreeSet<String> = BTreeSet::new();
    for Tie {
        dependent,
        coefficient,
        terms,
    } in &model.ties
    {
        let all =
            once((dependent, coefficient)).chain(terms.iter().map(|(dof, value)| (dof, value)));
        let set = deck.pick(&["3", "4"]);
        used.insert(set.to_owned());
        let mut fields = words([set]);
        for (row, (dof, coefficient)) in all.enumerate() {
            if row > 0 && row % 2 == 0 {
                fields.extend([String::new(), String::new()]);
            }
            let (axis, sign) = own(dof.grid, dof.direction);
            if sign < 0.0 {
                deck.see("a direction against an axis");
            }
            let coefficient = deck.number(sign * coefficient);
            fields.extend([dof.grid.to_string(), axis, coefficient]);
        }
        deck.card("MPC", &fields);
    }
    // An equation of a set that nothing selects.
    let last = model.grids.last().unwrap().label.to_string();
    deck.card("MPC", &words(["9", &last, "1", "1."]));
    if !model.ties.is_empty() {
        let fields = words(["8"]).into_iter().chain(used).collect_vec();
        deck.card("MPCADD", &fields);
    }
}

properties! {
    #[test]
    fn decks_of_every_card_in_every_form_are_read_back_equal(model in bulk_data(), seed in any::<u64>()) {
        let (text, model, _) = drawn(model, seed);
        let read = deck::read("drawn.bdf", text.as_bytes(), &[]);
        let read = read.unwrap_or_else(|error| panic!("{error}\n{text}"));
        prop_assert_eq!(&read.model, &model, "{}", text);
        let refused = [Reason::Unknown, Reason::Lacking, Reason::Ignored];
        prop_assert!(read.unread.iter().all(|card| !refused.contains(&card.reason)));
    }
}

/// The draws reach every card in small, large and free field, and every form.
#[test]
fn drawn_decks_have_every_card_in_every_form() {
    let mut runner = TestRunner::deterministic();
    let mut seen = BTreeSet::new();
    for seed in 0..300 {
        let model = bulk_data().new_tree(&mut runner).unwrap().current();
        seen.extend(drawn(model, seed).2);
    }
    let cards = CARDS
        .iter()
        .flat_map(|card| ["small", "large", "free"].map(|form| format!("{card} {form}")));
    let all = cards.chain(FORMS.map(str::to_owned));
    let missing = all.filter(|form| !seen.contains(form)).collect_vec();
    assert!(missing.is_empty(), "{missing:?}");
}
