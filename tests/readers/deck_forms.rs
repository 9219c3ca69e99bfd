//! One deck in the forms in which programs write it: what is read is the same, or the line is named.

use crate::prelude::*;

/// Two rods in a row and a mass, as fields of cards.
const CARDS: [&str; 9] = [
    "GRID,1,,0.,0.,0.,,123456",
    "GRID,2,,10.5,0.,0.,,23456",
    "GRID,3,,21.25,0.,0.,,23456",
    "CROD,1,5,1,2",
    "CROD,2,5,2,3",
    "PROD,5,9,.0123",
    "MAT1,9,1.05+7,,.3,2.5-4",
    "CMASS2,7,.4,3,1",
    "SPC1,1,12,1,2,3",
];

fn read(text: &str) -> BulkData {
    let found = deck::read("forms.bdf", text.as_bytes(), &[]);
    found
        .unwrap_or_else(|error| panic!("{error}\n{text}"))
        .model
}

fn said(text: &str) -> String {
    let found = deck::read("forms.bdf", text.as_bytes(), &[]);
    found.expect_err(text).to_string()
}

fn all() -> String {
    CARDS.join("\n") + "\n"
}

properties! {
    /// A free real number of any length, with any exponent, is the number that it says.
    #[test]
    fn free_reals_of_any_length_are_read(value in -1e6..1e6_f64, digits in 1..25_usize, letter in prop::sample::select(vec!["E", "D", "e", ""])) {
        let written = format!("{value:.digits$e}").replace('e', "E");
        let (mantissa, exponent) = written.split_once('E').unwrap();
        let exponent: i32 = exponent.parse()?;
        let word = format!("{mantissa}{letter}{exponent:+}");
        let grid = read(&all().replace("10.5", &word)).grids[1].position.x;
        prop_assert_eq!(grid, written.parse::<f64>()?, "{}", word);
    }
}

#[test]
fn what_stands_around_the_bulk_data_may_be_short() {
    let model = read(&all());
    for (head, end) in [
        ("SPC = 1\nBEGIN BULK\n", "ENDDATA\n"),
        ("SPC=1\nBEGIN\n", ""),
        ("SOL 103\nCEND\nSPC=1\nBEGIN BULK SUPER=1\n", "ENDDATA"),
        ("SUBCASE=1\n SPC = 1\nSUBCASE=2\n SPC = 3\nBEGIN BULK\n", ""),
    ] {
        assert_eq!(read(&format!("{head}{}{end}", all())), model, "{head}");
    }
    let two = format!("BEGIN BULK\n{}BEGIN BULK SUPER=2\nGRID,9\n", all());
    assert!(
        said(&two).contains("line 11: this is the second part of bulk data"),
        "{}",
        said(&two)
    );
}

#[test]
fn a_card_repeats_the_one_before() {
    let grids = read("GRID,1,,0.,2.5,0.,,13\n=,*(2),=,*(1.5),==\n=(2)\nGRID,9,,1.\n").grids;
    let found = grids
        .iter()
        .map(|grid| (grid.label, grid.position.x, grid.position.y))
        .collect_vec();
    assert_eq!(
        found,
        [
            (1, 0.0, 2.5),
            (3, 1.5, 2.5),
            (5, 3.0, 2.5),
            (7, 4.5, 2.5),
            (9, 1.0, 0.0)
        ]
    );
    assert!(
        grids[..4]
            .iter()
            .all(|grid| grid.constrained == [true, false, true])
    );
    assert!(said("=,*1\n").contains("no card before of one line"));
    assert!(said("GRID,1\n=(2)\n").contains("repeats no card with changes"));
    assert!(said("GRID,1\n=,*x\n").contains("an increment of the field it repeats"));
}

/// Cards that have no part in the model are left out whatever their syntax is, and those that are read are not.
#[test]
fn cards_without_part_may_say_anything() {
    let model = read(&all());
    let other = "DEQATN  1       F(A,B,C)=A*B*C+12.0*SIN(A)\n        +3.0*COS(B), very much longer than any field\n";
    assert_eq!(read(&format!("{}{other}", all())), model);
    let error = said(&format!(
        "{}FORCE,1,1,,123456789012\nGRID,4,,verylongword\n",
        all()
    ));
    assert!(
        error.contains("line 11: \"VERYLONGWORD\" is longer than a field"),
        "{error}"
    );
    // What is not read is listed before any slip in what is.
    let error = said(&format!(
        "{}CBAR,8,2,1,2\nGRID,4,,verylongword\nXYZ,1\n{other}",
        all()
    ));
    assert!(
        error.contains("lacks what CBAR (line 10, 1 card)") && error.contains("does not read XYZ"),
        "{error}"
    );
    assert!(
        error.ends_with("; and no part in the model, so left out: DEQATN (line 13, 1 card)"),
        "{error}"
    );
}

#[test]
fn properties_and_materials_may_be_left_to_their_defaults() {
    let own = all()
        .replace("CROD,2,5,", "CROD,2,,")
        .replace("PROD,5,9,.0123", "PROD,5,9,.0123\nPROD,2,9,.5");
    assert_eq!(read(&own).elements[1].size, 0.5);
    let axial = all().replace("MAT1,9,1.05+7,,.3,2.5-4", "MAT1,9,1.05+7");
    assert_eq!(read(&axial).elements[0].material.youngs_modulus, 1.05e7);
    let panel = format!("{axial}GRID,4,,0.,5.,0.\nCTRMEM,5,6,1,2,4\nPTRMEM,6,9,.1\n");
    assert!(
        said(&panel).contains("a material with G or NU, which panels need"),
        "{}",
        said(&panel)
    );
    let mass = all().replace("CMASS2,7,.4,3,1", "CMASS1,7,8,3,1\nPMASS,8,.4,9,.7");
    assert_eq!(read(&mass), read(&all()));
}

/// Grids in coordinate systems are where trigonometry puts them, and move along the axes that theirs turn to.
#[test]
fn coordinate_systems_move_grids_and_turn_their_directions() {
    let systems = "\
CORD2R,1,,1.,2.,3.,1.,2.,4.,+A
+A,1.,3.,3.
CORD2C,2,1,0.,0.,0.,0.,0.,1.,+B
+B,1.,0.,0.
CORD2S,3,,0.,0.,0.,0.,0.,1.,+C
+C,1.,0.,0.
CORD1R,4,11,12,13
GRID,11,,0.,0.,0.
GRID,12,,0.,2.,0.
GRID,13,,0.,0.,2.
";
    let grid = |fields: &str| {
        let grids = read(&format!("{systems}GRID,20,{fields}\n")).grids;
        grids.into_iter().find(|grid| grid.label == 20).unwrap()
    };
    let near = |place: Vector3<f64>, x: f64, y: f64, z: f64| {
        assert!(
            (place - Vector3::new(x, y, z)).amax() < ROUND_OFF,
            "{place}"
        );
    };
    // System 1: z up from (1, 2, 3), x along y; so y along -x.
    near(grid("1,5.,6.,7.").position, 1.0 - 6.0, 2.0 + 5.0, 3.0 + 7.0);
    // Radius 2 at 90 degrees in it is 2 along its y.
    near(grid("2,2.,90.,7.").position, 1.0 - 2.0, 2.0, 3.0 + 7.0);
    // Radius 2 at 30 degrees from z, 90 degrees around.
    near(grid("3,2.,30.,90.").position, 0.0, 1.0, 3.0_f64.sqrt());
    // By grids: z along y, x along z, so y along x.
    near(grid("4,5.,6.,7.").position, 6.0, 7.0, 5.0);
    assert_eq!(
        grid(",1.,0.,0.,1,1").constrained,
        [false, true, false],
        "x of system 1 is y"
    );
    assert_eq!(
        grid("2,2.,90.,0.,2,1").constrained,
        [true, false, false],
        "outward at 90 degrees is -x"
    );
    let said = |fields: &str| said(&format!("{systems}GRID,20,{fields}\n"));
    assert!(
        said("2,2.,45.,0.,2,1").contains("oblique"),
        "{}",
        said("2,2.,45.,0.,2,1")
    );
    assert_eq!(grid("2,2.,45.,0.,2,123").constrained, [true; 3]);
    assert!(said("7,1.").contains("\"7\" is not the number of a coordinate system's card"));
    let circle = said(",1.\nCORD1R,5,20,21,22\nGRID,21,5\nGRID,22,5,1.");
    assert!(
        circle.is_empty() || circle.contains("by itself"),
        "{circle}"
    );
}

#[test]
fn masses_and_equations_follow_turned_directions() {
    let text = all().replace(
        "GRID,3,,21.25,0.,0.,,23456",
        "CORD2R,1,,0.,0.,0.,0.,0.,1.,+A\n+A,0.,1.,0.\nGRID,3,,21.25,0.,0.,1",
    ) + "GRID,4,,5.,0.,0.\nMPC,1,4,1,1.,3,2,2.\nCMASS2,8,.1,4,1\n";
    let model = read(&text.replace("CMASS2,7,.4,3,1", "CMASS2,7,.4,3,2"));
    // Directions 1 and 2 of system 1 are y and -x.
    assert_eq!(model.masses[0].direction, Some(0));
    let x = StructuralDof {
        grid: 3,
        direction: 0,
    };
    assert_eq!(model.ties[0].terms, [(x, -2.0)], "{}", DIRECTIONS[0]);
}

/// An equation may refer to a direction off the axes, which is a sum of those along them; a support and a mass may not.
#[test]
fn equations_refer_to_turned_directions_as_sums() {
    let text = all()
        + "CORD2R,1,,0.,0.,0.,0.,0.,1.,+A\n+A,.8,.6,0.\nGRID,4,,5.,0.,0.\nGRID,6,,9.,0.,0.,1\n";
    let model = read(&format!("{text}MPC,1,4,1,1.,6,2,2.\n,,6,3,5.\n"));
    let [tie] = &model.ties[..] else {
        panic!("one equation")
    };
    // Direction 2 of a system whose x is along (0.8, 0.6, 0) is (-0.6, 0.8, 0).
    let expected = [(0, -1.2), (1, 1.6), (2, 5.0)];
    assert_eq!(tie.terms.len(), expected.len());
    for ((dof, found), (direction, value)) in tie.terms.iter().zip(expected) {
        assert_eq!((dof.grid, dof.direction), (6, direction));
        assert!((found - value).abs() < ROUND_OFF, "{found}");
    }
    for card in ["MPC,1,6,2,1.,4,1,2.", "SPC1,1,2,6", "CMASS2,8,.1,6,1"] {
        let error = said(&format!("{text}{card}\n"));
        assert!(
            error.contains("corfem has no oblique supports") && error.contains("paper/matrices.md"),
            "{error}"
        );
    }
    let twice =
        said(&format!("{text}MPC,1,4,1,1.,6,2,2.\nMPC,1,6,3,1.\n").replace("6,2,2.\n", "6,3,2.\n"));
    assert!(twice.contains("field 6: another MPC card makes"), "{twice}");
}

#[test]
fn a_grid_that_nothing_touches_is_held_and_said() {
    let found = deck::read(
        "forms.bdf",
        (all() + "GRID,8,,1.\nGRID,9,,2.\n").as_bytes(),
        &[],
    );
    let unread = found.unwrap().unread;
    let said = unread
        .iter()
        .map(|card| (card.place(), card.reason))
        .collect_vec();
    assert_eq!(
        said,
        [("GRID (line 10, 2 cards)".to_owned(), Reason::Untouched)]
    );
}

/// The halves of large lines go together whatever brings them there: a tag, a star, or both in turn.
#[test]
fn halves_of_large_lines_stand_anywhere() {
    let grids: String = (1..=16)
        .map(|label| format!("GRID,{label},,{label}.\n"))
        .collect();
    let whole = "SPC1,1,1,1,2,3,4,5,6,+,7,8,9,10,11,12,13,14,+,15,16\n";
    let parts = "SPC1*,1,1,1,2,+A\n*B,7,8,9,10\n*,11,12,13,14,+C\n*A,3,4,5,6,+B\n+C,15,16\n";
    assert_eq!(read(&(grids.clone() + parts)), read(&(grids + whole)));
}
