//! Decks of every card that is read, with what programs write around them: all are read, and what has no part in the model is named.

use crate::prelude::*;
use crate::readers::deck_errors::GOOD;

/// Cards of loads, optimization, sets and aerodynamics.
const WITHOUT_PART: [&str; 8] = [
    "DESVAR,1,T1,.1,.01,1.",
    "DVPREL1,1,PSHEAR,1,T,,,,,+V\n+V,1,1.",
    "DRESP1,1,F1,FREQ,,,1",
    "SET1,9,1,2,3",
    "PAERO1,1",
    "CAERO1,1,1,,4,4,,,1",
    "SPLINE1,1,1,1,4,9",
    "FORCE,3,1,,1.,0.,0.,1.",
];

/// What a deck may say beside the model.
#[derive(Debug, Clone)]
struct Around {
    /// Behind ENDDATA on its line, and below it.
    end: String,
    /// How a grid is held, by its place: on its own card, by SPC or by SPC1.
    holds: Vec<u8>,
    explicit_zeros: bool,
    has_torsion: bool,
    is_conrod: bool,
    subcases: bool,
    extra: [bool; 8],
}

fn around() -> impl Strategy<Value = Around> {
    let end = "([ ,\t][ -~]{0,20})?(\n[ -~]{0,30}){0,2}";
    (
        end,
        prop::collection::vec(0..3_u8, 8),
        any::<[bool; 4]>(),
        any::<[bool; 8]>(),
    )
        .prop_map(
            |(end, holds, [explicit_zeros, has_torsion, is_conrod, subcases], extra)| Around {
                end,
                holds,
                explicit_zeros,
                has_torsion,
                is_conrod,
                subcases,
                extra,
            },
        )
}

/// A card of the large format, separated by commas.
fn card(name: &str, fields: &[String]) -> String {
    let lines = fields.chunks(4).enumerate().map(|(row, fields)| {
        let first = if row == 0 {
            format!("{name}*")
        } else {
            "*".to_owned()
        };
        format!("{first},{}\n", fields.join(","))
    });
    lines.collect()
}

fn number(value: f64) -> String {
    large_real(value).unwrap()
}

/// The deck of a model.
fn written(model: &BulkData, around: &Around) -> String {
    let blank = String::new;
    let zero = || {
        if around.explicit_zeros {
            "0.".to_owned()
        } else {
            blank()
        }
    };
    let mut text = String::from("GRDSET,,0,,,,0\nPARAM,WTMASS,1.\nPARAM,POST,0\n");
    for (grid, hold) in model.grids.iter().zip(&around.holds) {
        let label = grid.label.to_string();
        let components: String = (1..)
            .zip(grid.constrained)
            .filter(|held| held.1)
            .map(|held: (usize, bool)| held.0.to_string())
            .collect();
        let own = if *hold == 0 {
            components.clone()
        } else {
            blank()
        };
        let [x, y, z] = [grid.position.x, grid.position.y, grid.position.z].map(number);
        text += &card("GRID", &[label.clone(), blank(), x, y, z, blank(), own]);
        match hold {
            1 if !components.is_empty() => {
                text += &format!("SPC,1,{label},{components},{}\n", zero())
            }
            2 if !components.is_empty() => text += &format!("SPC1,1,{components},{label}\n"),
            _ => {}
        }
    }
    let first = model.grids[0].label;
    text += &format!("SPC,1,{first},456,,{first},4\nSPC1,2,123,{first}\nSPCADD,7,1\n");
    for (row, element) in (1..).zip(&model.elements) {
        let Material {
            youngs_modulus: e,
            poissons_ratio: nu,
            shear_modulus: g,
            density,
        } = element.material;
        let is_derived = Material::isotropic(e, nu).is_ok_and(|other| other.shear_modulus == g);
        let shear = if is_derived { blank() } else { number(g) };
        text += &card(
            "MAT1",
            &[
                row.to_string(),
                number(e),
                shear,
                number(nu),
                number(density),
            ],
        );
        let [label, material, size] = [
            element.label.to_string(),
            row.to_string(),
            number(element.size),
        ];
        let corners = element.grids.iter().map(usize::to_string).collect_vec();
        let torsion = if around.has_torsion {
            ".25".to_owned()
        } else {
            zero()
        };
        let (connection, property) = match element.kind {
            ElementKind::Rod if around.is_conrod => {
                let [a, b] = [corners[0].clone(), corners[1].clone()];
                text += &card(
                    "CONROD",
                    &[label, a, b, material, size, torsion, zero(), zero()],
                );
                continue;
            }
            ElementKind::Rod => {
                text += &card(
                    "PROD",
                    &[label.clone(), material, size, torsion, zero(), zero()],
                );
                text += &format!("CROD,{label},{label},{}\n", corners.join(","));
                continue;
            }
            ElementKind::ShearPanel => ("CSHEAR", "PSHEAR"),
            ElementKind::Membrane => ("CQDMEM", "PQDMEM"),
            ElementKind::Triangle => ("CTRMEM", "PTRMEM"),
        };
        let mut fields = vec![label.clone(), material, size, zero()];
        if property == "PSHEAR" {
            fields.extend([zero(), zero()]);
        }
        text += &card(property, &fields);
        text += &format!("{connection},{label},{label},{}\n", corners.join(","));
    }
    for point in &model.masses {
        let [label, grid, mass] = [
            point.label.to_string(),
            point.grid.to_string(),
            number(point.mass),
        ];
        text += &match point.direction {
            Some(direction) => card("CMASS2", &[label, mass, grid, (direction + 1).to_string()]),
            None => card(
                "CONM2",
                &[label, grid, blank(), mass, zero(), zero(), zero()],
            ),
        };
    }
    for Tie {
        dependent,
        coefficient,
        terms,
    } in &model.ties
    {
        let all =
            once((dependent, coefficient)).chain(terms.iter().map(|(dof, value)| (dof, value)));
        let mut fields = vec!["3".to_owned()];
        for (row, (dof, coefficient)) in all.enumerate() {
            if row > 0 && row % 2 == 0 {
                fields.extend([blank(), blank()]);
            }
            fields.extend([
                dof.grid.to_string(),
                (dof.direction + 1).to_string(),
                number(*coefficient),
            ]);
        }
        text += &card("MPC", &fields);
    }
    text += if model.ties.is_empty() {
        ""
    } else {
        "MPCADD,8,3\n"
    };
    for (extra, _) in WITHOUT_PART
        .iter()
        .zip(around.extra)
        .filter(|extra| extra.1)
    {
        text += &format!("{extra}\n");
    }
    let mpc = if model.ties.is_empty() {
        ""
    } else {
        "MPC = 8\n"
    };
    let control = if around.subcases {
        format!("{mpc}SPC = 2\nSUBCASE 1\n  SPC = 7\nSUBCASE 2\n  SPC = 2\n  MPC = 9\n")
    } else {
        format!("SPC = 7\n{mpc}")
    };
    format!(
        "SOL 103\nCEND\nTITLE = A WING\n{control}METHOD = 1\nBEGIN BULK\n{text}EIGRL,1,,,6\nENDDATA{}",
        around.end
    )
}

properties! {
    #[test]
    fn decks_of_every_supported_card_are_read_whatever_stands_around_them(model in bulk_data(), around in around()) {
        let text = written(&model, &around);
        let read = deck::read("wing.bdf", text.as_bytes(), &[]);
        let read = read.unwrap_or_else(|error| panic!("{error}\n{text}"));
        prop_assert_eq!(&read.model, &model, "{}", text);
        let count = |reason: Reason| read.unread.iter().filter(|card| card.reason == reason).map(|card| card.count).sum::<usize>();
        let rods = model.elements.iter().filter(|element| element.kind == ElementKind::Rod).count();
        prop_assert_eq!(count(Reason::Torsion), if around.has_torsion { rods } else { 0 });
        prop_assert_eq!(count(Reason::NotSelected), 1);
        prop_assert_eq!(count(Reason::WithoutPart), 1 + around.extra.iter().filter(|extra| **extra).count());
        prop_assert_eq!(count(Reason::Unknown), 0);
    }
}

/// Several programs write a checksum there.
#[test]
fn what_follows_enddata_does_not_count() {
    let good = deck::read("wing.bdf", GOOD.as_bytes(), &[]).unwrap().model;
    for end in [
        "ENDDATA 13664a4e",
        "enddata",
        "  ENDDATA\t7",
        "ENDDATA,1",
        "ENDDATA $ the end",
    ] {
        let text = format!("{GOOD}{end}\nCBAR,9\nnonsense, \"\n");
        assert_eq!(
            deck::read("wing.bdf", text.as_bytes(), &[])
                .expect(end)
                .model,
            good
        );
    }
    let text = format!("{GOOD}ENDDATAX\n");
    assert!(deck::read("wing.bdf", text.as_bytes(), &[]).is_err());
}

/// Two subcases with supports of their own are two models; the first counts, and cards of the other are named.
#[test]
fn of_several_subcases_the_first_selects_the_constraints() {
    let held = |control: &str| {
        let text = format!("{control}BEGIN BULK\n{GOOD}SPC,2,2,123\n");
        let read = deck::read("wing.bdf", text.as_bytes(), &[]).expect(control);
        (
            read.model.grids[1].constrained[0],
            read.unread[0].card.clone(),
        )
    };
    let [first, second] = [(false, "SPC".to_owned()), (true, "SPC1".to_owned())];
    assert_eq!(held("SUBCASE 1\nSPC = 1\nSUBCASE 2\nSPC = 2\n"), first);
    assert_eq!(held("SUBCASE 1\nSPC = 2\nSUBCASE 2\nSPC = 1\n"), second);
    assert_eq!(held("SPC = 1\nSUBCASE 1\nSUBCASE 2\nSPC = 2\n"), first);
    assert_eq!(held("SPC = 1\nSUBCASE 1\nSPC = 2\nSUBCASE 2\n"), second);
}

/// NASTRAN-95 has a second panel's property in field 6, later programs a factor, which must be zero here.
#[test]
fn a_property_of_shear_panels_may_end_in_zeros_or_in_another_property() {
    let read = |card: &str| {
        let text =
            format!("{GOOD}{card}\nGRID,3,,10.,10.,0.\nGRID,4,,0.,10.,0.\nCSHEAR,5,2,1,2,3,4\n");
        deck::read("wing.bdf", text.as_bytes(), &[]).map(|read| read.model.elements[1].size)
    };
    for card in [
        "PSHEAR,2,1,.5",
        "PSHEAR,2,1,.5,0.",
        "PSHEAR,2,1,.5,0.,0.,0.",
        "PSHEAR,2,1,.5,,0,0",
        "PSHEAR,2,1,.5,,,0.",
    ] {
        assert_eq!(read(card).unwrap_or_else(|error| panic!("{error}")), 0.5);
    }
    assert_eq!(read("PSHEAR,3,1,.1,,2,1,.25").unwrap(), 0.25);
    assert!(read("PSHEAR,2,1,.5,0.,1.,0.").is_err());
}

#[test]
fn torsion_of_rods_is_named_and_in_no_stiffness() {
    let text = GOOD.replace("PROD,1,1,.01", "PROD,1,1,.01,.5") + "CONROD,2,1,2,1,.5,.25\n";
    let read = deck::read("wing.bdf", text.as_bytes(), &[]).unwrap();
    let said = read
        .unread
        .iter()
        .map(corfem::present::tables::deck::not_read)
        .collect_vec();
    assert_eq!(
        said,
        [
            "Not read: PROD J (line 4, 1 card), torsion of rods: grids have no rotations here.",
            "Not read: CONROD J (line 8, 1 card), torsion of rods: grids have no rotations here."
        ]
    );
    let plain = deck::read(
        "wing.bdf",
        text.replace(",.5,.25", ",.5")
            .replace(",.01,.5", ",.01")
            .as_bytes(),
        &[],
    );
    assert_eq!(read.model, plain.unwrap().model);
}
