//! What the readers of decks, matrices and tests say of files, by the lists in `files`.

use crate::common::cases::hold;
use crate::prelude::*;
use corfem::files::test_data::DIRECTIONS;

/// A deck as JSON.
fn of_deck(text: &str, ignore: &[String]) -> Result<Value, String> {
    let found = deck::read("file", text.as_bytes(), ignore).map_err(|error| error.to_string())?;
    let BulkData {
        grids,
        elements,
        ties,
        masses,
    } = &found.model;
    let moves = |dof: &StructuralDof| format!("{} {}", dof.grid, DIRECTIONS[dof.direction]);
    let held = |grid: &Grid| -> String {
        let of = |&place: &usize| grid.constrained[place];
        (0..3).filter(of).map(|place| DIRECTIONS[place]).collect()
    };
    let ties = ties.iter().map(|tie| {
        let terms = tie
            .terms
            .iter()
            .map(|(dof, value)| json!([moves(dof), value]));
        json!([moves(&tie.dependent), terms.collect_vec()])
    });
    Ok(json!({
        "labels": grids.iter().map(|grid| grid.label).collect_vec(),
        "places": grids.iter().map(|grid| grid.position.as_slice().to_vec()).collect_vec(),
        "held": grids.iter().map(held).collect_vec(),
        "elements": elements.iter().map(|element| &element.grids).collect_vec(),
        "sizes": elements.iter().map(|element| element.size).collect_vec(),
        "materials": elements.iter().map(|element| {
            let of = element.material;
            [of.youngs_modulus, of.shear_modulus, of.poissons_ratio, of.density]
        }).collect_vec(),
        "mass": found.model.placed_masses().map_or(0.0, |all| all.iter().map(|own| own.1.x).sum()),
        "masses": masses.iter().map(|own| json!([own.grid, own.direction.map(|of| DIRECTIONS[of]), own.mass])).collect_vec(),
        "ties": ties.collect_vec(),
        "unread": found.unread.iter().map(|card| format!("{} {:?}", card.place(), card.reason)).collect_vec(),
    }))
}

/// A matrix of a name as JSON.
fn of_matrix(text: &str, wanted: &[String]) -> Result<Value, String> {
    let wanted = wanted.first().map(String::as_str);
    let found =
        matrices::read("file", text.as_bytes(), wanted).map_err(|error| error.to_string())?;
    let labels = |labels: &Option<Vec<matrices::Label>>| {
        let labels = labels.iter().flatten();
        labels
            .map(|label| (label.grid, label.component))
            .collect_vec()
    };
    Ok(json!({
        "size": [found.matrix.rows(), found.matrix.columns()],
        "entries": found.matrix.entries().collect_vec(),
        "rows": labels(&found.rows),
        "columns": labels(&found.columns),
    }))
}

/// A test as JSON.
fn of_test(text: &str, _: &[String]) -> Result<Value, String> {
    let found = read("file", text.as_bytes()).map_err(|error| error.to_string())?;
    let sensors = &found.sensors;
    let row = |at: Vector3<f64>| [at.x, at.y, at.z];
    Ok(json!({
        "hertz": found.frequencies_hz,
        "names": sensors.iter().map(|own| &own.name).collect_vec(),
        "grids": sensors.iter().filter_map(|own| own.grid).collect_vec(),
        "directions": sensors.iter().map(|own| DIRECTIONS[own.direction]).collect_vec(),
        "places": sensors.iter().filter_map(|own| own.place).map(row).collect_vec(),
        "axes": sensors.iter().filter_map(|own| own.axis).map(row).collect_vec(),
        "shapes": found.shapes.row_iter().map(|row| row.iter().copied().collect_vec()).collect_vec(),
        "frequency_deviation": found.frequency_deviation,
        "shape_deviation": found.shape_deviation,
        "component_deviation": found.component_deviation.values().map(|own| own.as_slice()).collect_vec(),
        "collinearity": found.phase_collinearity,
        "alone": found.alone,
        "lines": found.lines,
        "numbers": found.numbers,
        "units": found.units,
        "incomplete": found.incomplete,
        "skipped": found.skipped,
    }))
}

#[test]
fn decks_are_read_or_refused_as_listed() {
    hold(include_str!("files/decks.toml"), &[], ROUND_OFF, of_deck);
}

#[test]
fn matrices_are_read_or_refused_as_listed() {
    let sparse = include_str!("../../golden/formats/sparse.op4").to_owned();
    let dmig = include_str!("../../golden/formats/small.dmig").to_owned();
    let made = [("sparse.op4", sparse), ("small.dmig", dmig)];
    hold(
        include_str!("files/matrices.toml"),
        &made,
        ROUND_OFF,
        of_matrix,
    );
}

#[test]
fn tables_of_tests_are_read_or_refused_as_listed() {
    hold(include_str!("files/tables.toml"), &[], ROUND_OFF, of_test);
}

#[test]
fn universal_files_are_read_or_refused_as_listed() {
    hold(
        include_str!("files/universal.toml"),
        &[],
        ROUND_OFF,
        of_test,
    );
}

/// The modes of a deck as JSON, all of them or so many.
fn of_modes(text: &str, most: &[String]) -> Result<Value, String> {
    let model = read_deck(text).map_err(|error| error.to_string())?.model;
    let most = most
        .first()
        .map_or(usize::MAX, |most| most.parse().unwrap());
    let found = deck::modes(&model, most).map_err(|error| error.to_string())?;
    let shapes = found.modes.shapes();
    Ok(json!({
        "hertz": found.modes.frequencies_hz(),
        "shapes": shapes.column_iter().map(|shape| shape.iter().copied().collect_vec()).collect_vec(),
        "dof": found.dof.iter().map(|dof| (dof.grid, DIRECTIONS[dof.direction])).collect_vec(),
        "rigid_bodies": found.rigid_body,
        "counted": found.counted,
    }))
}

#[test]
fn decks_have_the_modes_that_are_listed() {
    hold(
        include_str!("files/modes.toml"),
        &[],
        EIGEN_ROUND_OFF,
        of_modes,
    );
    let printed = include_str!("files/printed_modes.toml");
    hold(printed, &[], PRINTED_SEVEN_DIGITS, of_modes);
}
