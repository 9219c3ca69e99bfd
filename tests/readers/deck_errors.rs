//! What is wrong with a deck is named: file, line, card and field.

use crate::prelude::*;

/// A structure that reads: two grids, a rod, a material, its constraints, a mass.
pub const GOOD: &str = "\
GRID,1,,0.,0.,0.
GRID,2,,10.,0.,0.
CROD,1,1,1,2
PROD,1,1,.01
MAT1,1,1.+6,,.3
SPC1,1,123456,1
CMASS2,7,.4,2,1
";

/// Line replaced (or `-` for one more), the card, and of its error the field and two parts of the reason.
const BAD_FIELDS: &str = "\
1 | GRID,x,,0.,0.,0. | 2 | a positive integer | X
1 | GRID,0,,0.,0.,0. | 2 | a positive integer | 0
1 | GRID,-1,,0.,0.,0. | 2 | a positive integer | -1
1 | GRID*,123456789,,0.,0. | 2 | at most eight digits | 123456789
2 | GRID,2,,10,0.,0. | 4 | a real number with a decimal point | 10
2 | GRID,2,,10.,0.,1.X | 6 | a real number | 1.X
2 | GRID,2,3,10.,0.,0. | 3 | the number of a CORD2R or CORD2C card | 3
2 | GRID,2,,10.,0.,0.,5 | 7 | the number of a CORD2R or CORD2C card | 5
2 | GRID,2,,10.,0.,0.,,127 | 8 | a list of components 1 to 6 | 127
2 | GRID,1,,10.,0.,0. | 2 | the card in line 1 | 1
- | CROD,1,1,2,1 | 2 | the card in line 3 | 1
- | CONROD,1,1,2,1,.5 | 2 | the card in line 3 | 1
- | PROD,1,1,.5 | 2 | the card in line 4 | 1
- | MAT1,1,1.+7,,.3 | 2 | the card in line 5 | 1
- | CONM2,7,2,,1. | 2 | the card in line 7 | 7
3 | CROD,1,9,1,2 | 3 | the number of a PROD card | 9
3 | CROD,1,1,1,3 | 5 | the number of a GRID card | 3
3 | CROD,1,1,,2 | 4 | a positive integer | missing
- | CSHEAR,2,1,1,2,1,2 | 3 | the number of a PSHEAR card | 1
- | CQDMEM,2,1,1,2,1,2 | 3 | the number of a PQDMEM card | 1
- | CTRMEM,2,1,1,2,1 | 3 | the number of a PTRMEM card | 1
- | CONROD,2,1,2,9,.5 | 5 | the number of a MAT1 card | 9
- | CONROD,2,1,9,1,.5 | 4 | the number of a GRID card | 9
4 | PROD,1,8,.01 | 3 | the number of a MAT1 card | 8
7 | CMASS2,7,.4,3,1 | 4 | the number of a GRID card | 3
- | CONM2,8,3,,.4 | 3 | the number of a GRID card | 3
4 | PROD,1,1,0. | 4 | a rod without area | torsion alone
4 | PROD,1,1 | 4 | a positive real number | missing
4 | PROD,1,1,-.5 | 4 | a positive real number | -.5
4 | PROD,1,1,.5,X | 5 | a real number | X
4 | PROD,1,1,.5,,,-.1 | 7 | a nonstructural mass of zero or more | -.1
- | PSHEAR,2,1,.5,-.1 | 5 | a nonstructural mass of zero or more | -.1
- | PSHEAR,2,1,.5,,1.5 | 6 | no factors of shear panels | 1.5
- | PSHEAR,2,1,.5,,,.5 | 7 | no factors of shear panels | .5
- | PSHEAR,2,1,.5,,0.,0.,3 | 8 | no factors of shear panels | 3
- | CROD,2,1,1,2,3 | 6 | a card of its own | 3
- | CONROD,2,1,2,1,-1. | 6 | a positive real number | -1.
- | CONROD,2,1,2,1,1.,1 | 7 | a real number | 1
- | CONROD,2,1,2,1,1.,,,-1. | 9 | a nonstructural mass of zero or more | -1.
7 | CMASS2,7,-.4,2,1 | 3 | a positive real number | -.4
7 | CMASS2,7,.4,2,4 | 5 | component 1, 2 or 3 | 4
7 | CMASS2,7,.4,2,1,1,1 | 6 | no masses between two degrees of freedom | 1
- | CONM2,8,2,,0. | 5 | a positive real number | 0.
- | CONM2,8,2,,.4,1. | 6 | no offsets of masses | 1.
- | CONM2,8,2,,.4,,,1. | 8 | no offsets of masses | 1.
6 | SPC,1,1,1234567 | 4 | a list of components 1 to 6 | 1234567
6 | SPC,1,1 | 4 | a list of components 1 to 6 | missing
6 | SPC,1,5,1 | 3 | the number of a GRID card | 5
6 | SPC,1,1,1,X | 5 | a real number | X
6 | SPC,1,1,1,,2 | 7 | a list of components 1 to 6 | missing
6 | SPC,1,1,1,,,1 | 6 | a positive integer | missing
6 | SPC1,1,1234567,1 | 3 | a list of components 1 to 6 | 1234567
6 | SPC1,1,,1 | 3 | a list of components 1 to 6 | missing
6 | SPC1,1,1 | 4 | a grid | missing
6 | SPC1,1,1,5 | 4 | the number of a GRID card | 5
6 | SPC1,1,1,1,5 | 5 | the number of a GRID card | 5
6 | SPC1,1,1,3,THRU,8 | 4 | the number of a GRID card | 3
6 | SPC1,1,1,2,THRU,1 | 6 | a grid number above 2 | 1
6 | SPC1,1,1,1,1,1,1,1,THRU | 12 | a grid after THRU | missing
6 | SPC1,1,1,1,THRU | 6 | a grid after THRU | missing
6 | SPC1,1,1,THRU,2 | 4 | a positive integer | THRU
- | SPC1,2,1,2 | 2 | set 2 beside set 1 | 2
- | MPC,1 | 3 | a grid | missing
- | MPC,1,3,1,-1.,2,1,1. | 3 | the number of a GRID card | 3
- | MPC,1,2,1,-1.,3,1,1. | 6 | the number of a GRID card | 3
- | MPC,1,2,5,-1.,1,1,1. | 4 | component 1, 2 or 3 | 5
- | MPC,1,2,1,0.,1,1,1. | 5 | a coefficient other than zero | 0.
- | MPC,1,2,1,1,1,1,1. | 5 | a real number with a decimal point | 1
- | MPC,1,1,1,-1.,2,1,1. | 3 | an SPC or SPC1 card constrains this | degree
";

#[test]
fn a_bad_field_is_named_with_file_line_and_card() {
    for row in BAD_FIELDS.lines() {
        let [line, card, field, expected, found] = row.split(" | ").collect_vec()[..] else {
            panic!("{row}");
        };
        let mut lines = GOOD.lines().collect_vec();
        let line = line.parse().unwrap_or(8);
        lines.splice(line - 1..line.min(7), [card]);
        let said = said(deck::read("wing.dat", lines.join("\n").as_bytes(), &[]));
        let name = card.split([',', '*']).next().unwrap();
        let place = format!("wing.dat, line {line}: card {name}, field {field}: ");
        let reason = said.strip_prefix(&place).expect(&said);
        assert!(
            reason.contains(expected) && reason.contains(found),
            "{card}: {said}"
        );
    }
}

#[test]
fn what_no_deck_can_hold_is_refused() {
    let mut model = read_deck(GOOD).unwrap().model;
    let write = |model: &BulkData| said(deck::write(model, "", 1, [1.0, 2.0]));
    model.grids[0].position.y = f64::NAN;
    let number = "number of card GRID, entry 3 is NaN; it must be a finite number";
    assert_eq!(write(&model), number);
    (model.grids[0].position.y, model.grids[0].label) = (0.0, 100_000_000);
    let label = "number of a grid or element in a deck: 100000000 given or asked for; there must be 1 to 99999999";
    assert_eq!(write(&model), label);
    model.grids[0].label -= 1;
    assert_eq!(write(&model), "an answer");
    let model = case_of(1).model().unwrap();
    let (mut mass, parameters) = (model.mass().clone(), model.parameters().to_vec());
    mass[(0, 1)] = 0.1 * mass[(0, 0)];
    mass[(1, 0)] = mass[(0, 1)];
    let (structure, t) = (model.structure().clone(), model.load_distribution().clone());
    let coupled = FiniteElementModel::new(structure, t, mass, parameters).unwrap();
    let refused = said(BulkData::from_model(
        &coupled,
        &[1.0; 15],
        &[Vector3::zeros(); 9],
    ));
    assert!(
        refused.contains("zero: a deck has point masses alone"),
        "{refused}"
    );
}
