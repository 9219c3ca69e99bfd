//! The computed tables and sentences of README.md and `paper/*.md`, made from the goldens.

use crate::evidence::coverage::SEEDS;
use crate::ledgers::{alternative, costs, files_below};
use crate::prelude::*;

/// A line of a golden in CSV.
#[derive(serde::Deserialize)]
struct Entry {
    table: String,
    row: String,
    column: String,
    computed: String,
    published: String,
}

/// Every line of every golden in CSV, by `/golden/table/row/column`.
static ENTRIES: LazyLock<Vec<(String, Entry)>> = LazyLock::new(|| {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = files_below(&root.join("golden/snapshots"));
    files.push(root.join("paper/readings.csv"));
    let mut entries = Vec::new();
    for file in files {
        let text = fs::read_to_string(&file).unwrap();
        let Some(start) = text.find("table,row,column,unit,computed,published\n") else {
            continue;
        };
        let golden = file.file_stem().unwrap().to_string_lossy();
        let lines = csv::Reader::from_reader(&text.as_bytes()[start..]).into_deserialize();
        entries.extend(lines.map(|entry| {
            let entry: Entry = entry.unwrap_or_else(|what| panic!("{}: {what}", file.display()));
            let Entry {
                table, row, column, ..
            } = &entry;
            (format!("/{golden}/{table}/{row}/{column}"), entry)
        }));
    }
    entries
});

/// The one line of a table, which is `golden/table` where several goldens have a table of that name.
fn entry(table: &str, row: &str, column: &str) -> &'static Entry {
    let place = format!("/{table}/{row}/{column}");
    let mut found = ENTRIES.iter().filter(|(name, _)| name.ends_with(&place));
    match (found.next(), found.next()) {
        (Some((_, entry)), None) => entry,
        (found, _) => panic!(
            "{place}: {} entries",
            if found.is_some() { "two" } else { "no" }
        ),
    }
}

/// The computed numbers of all lines that begin in one way and end in another.
fn all(start: &str, end: &str) -> Vec<f64> {
    let found = ENTRIES
        .iter()
        .filter(|(name, _)| name.starts_with(start) && name.ends_with(end));
    let numbers = found
        .map(|(name, entry)| entry.computed.parse().expect(name))
        .collect_vec();
    assert!(!numbers.is_empty(), "{start}…{end}");
    numbers
}

fn rounded(number: f64, decimals: usize) -> String {
    let text = format!("{number:.decimals$}");
    // A rounded zero has no sign.
    match text.strip_prefix('-') {
        Some(zero) if zero.chars().all(|c| "0.".contains(c)) => zero.to_owned(),
        _ => text,
    }
}

fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |m, x| x.abs().max(m))
}

/// A computed number of a golden.
pub fn computed(table: &str, row: &str, column: &str, decimals: usize) -> String {
    rounded(
        entry(table, row, column).computed.parse().expect(row),
        decimals,
    )
}

fn published(table: &str, row: &str, column: &str, decimals: usize) -> String {
    rounded(
        entry(table, row, column).published.parse().expect(row),
        decimals,
    )
}

/// The computed number with the published one behind it.
fn both(table: &str, row: &str, column: &str, decimals: usize) -> String {
    let published = published(table, row, column, decimals);
    format!("{} ({published})", computed(table, row, column, decimals))
}

/// The least and the largest of a row.
fn span(table: &str, row: &str, decimals: usize) -> String {
    let numbers = all(&format!("/truncation/{table}/{row}/"), "");
    let [least, most] = [
        numbers.iter().copied().fold(f64::INFINITY, f64::min),
        numbers.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    ]
    .map(|number| rounded(number, decimals));
    if least == most {
        least
    } else {
        format!("{least} to {most}")
    }
}

/// The cells of a row of one table: its computed numbers in these columns.
fn cells<const N: usize>(
    table: &str,
    row: &str,
    columns: [&str; N],
    decimals: usize,
) -> Vec<String> {
    columns
        .map(|column| computed(table, row, column, decimals))
        .to_vec()
}

/// A table in Markdown: its head, and rows of a label and the cells that belong to what stands beside the label.
pub fn table<L: Display, K>(
    head: &str,
    rows: impl IntoIterator<Item = (L, K)>,
    cells: impl Fn(K) -> Vec<String>,
) -> String {
    let rule = "---|".repeat(head.split(" | ").count());
    let rows = rows
        .into_iter()
        .map(|(label, key)| format!("| {label} | {} |\n", cells(key).join(" | ")));
    format!("| {head} |\n|{rule}\n{}", rows.collect::<String>())
}

/// Structures built after the program.
const BUILT_LATER: [&str; 7] = [
    "portal",
    "girder",
    "free truss",
    "plate",
    "cyclic disk",
    "fine plate",
    "tower",
];

/// A row whose label is its name in the golden.
fn alike(name: &str) -> (&str, &str) {
    (name, name)
}

/// The paper's cases by number, with the tables of their errors and gages and the name of their last pass.
const CASES: [(&str, &str, &str, usize); 3] = [
    ("1", "table_3", "table_4", 2),
    ("2", "table_5", "table_6", 2),
    ("3", "table_7", "table_8", 3),
];

fn cases() -> String {
    let start = |row| {
        CASES
            .map(|(_, errors, _, _)| both(errors, row, "Initial error", 2))
            .to_vec()
    };
    let last = |passes| format!("Pass {passes} error");
    let end = |row| {
        CASES
            .map(|(_, errors, _, passes)| both(errors, row, &last(passes), 2))
            .to_vec()
    };
    let gage = |row| {
        CASES
            .map(|(_, _, gages, passes)| both(gages, row, &last(passes), 1))
            .to_vec()
    };
    let membranes = {
        let row = "membrane RMS";
        vec![
            "none".to_owned(),
            both("table_6", row, &last(2), 1),
            both("table_8", row, &last(3), 1),
        ]
    };
    let iterations = CASES.map(|(case, _, _, passes)| {
        let each = |of: Source| {
            let counts =
                (1..=passes).map(|pass| of("table_13/table_13", case, &format!("Pass {pass}"), 0));
            counts.collect_vec().join(", ")
        };
        format!("{} ({})", each(computed), each(published))
    });
    table(
        "RMS error, % (published) | Case 1 | Case 2 | Case 3",
        [
            ("frequency, start", start("frequency RMS")),
            ("frequency, end", end("frequency RMS")),
            ("mode shape, start", start("shape RMS")),
            ("mode shape, end", end("shape RMS")),
            ("shear panel gage, end", gage("shear RMS")),
            ("membrane gage, end", membranes),
            ("iterations per pass", iterations.to_vec()),
        ],
        |cells| cells,
    )
}

/// Gage errors of the fifteen panels where the loops of Cases 2 and 3 end, and after one weighted step from there.
fn panels() -> String {
    table(
        "gage error, % | Case 2, end | after the step | Case 3, end | after the step",
        (1..=15).map(|panel| (panel, panel.to_string())),
        |panel| {
            let case = |number| {
                let columns = ["Error at the end", "Error after the step"];
                cells(&format!("case_{number}_next_step"), &panel, columns, 1)
            };
            [case(2), case(3)].concat()
        },
    )
}

/// The computed or the published number of a place.
type Source = fn(&str, &str, &str, usize) -> String;

/// The tables of `paper/matrix_correction.md`.
fn matrices() -> [(&'static str, String); 4] {
    let golden = |case: usize, table: &str| format!("matrices_case_{case}/{table}");
    let mut frequencies = Vec::new();
    for case in 1..=3 {
        for (when, name) in [("as_tested", ""), ("after_a_change", ", after the change")] {
            for (modes, row) in [("1 to 5", "RMS test modes"), ("6 to 9", "RMS others")] {
                let of = golden(case, &format!("matrix_frequencies_{when}"));
                frequencies.push((format!("Case {case}{name}, modes {modes}"), (of, row)));
            }
        }
    }
    let methods = ["Initial", "Element factors", "Baruch", "Berman and Nagy"];
    let diagonal = [
        ("the right change", "truth"),
        ("by elements", "element_factors"),
        ("by Baruch", "baruch"),
    ];
    let distances = [
        ("left by element factors", ("Element factors", "Left")),
        ("left by Baruch", ("Baruch", "Left")),
        (
            "of the right change, beyond any factors",
            ("Truth", "Beyond elements"),
        ),
        (
            "of Baruch's change, beyond any factors",
            ("Baruch", "Beyond elements"),
        ),
        (
            "of Berman and Nagy's change, beyond any factors",
            ("Berman and Nagy", "Beyond elements"),
        ),
    ];
    let factors = [
        ("Case 1, found", (1, "Found")),
        ("Case 1, nearest to Baruch", (1, "Nearest to Baruch")),
        ("Case 2, found", (2, "Found")),
        ("Case 2, nearest to Baruch", (2, "Nearest to Baruch")),
    ];
    [
        (
            "matrix_frequencies",
            table(
                "RMS frequency error, % | start | elements | Baruch | Berman and Nagy",
                frequencies,
                |(of, row)| cells(&of, row, methods, 2),
            ),
        ),
        (
            "matrix_diagonal",
            table(
                "diagonal entry of $K_D$ | 1 | 2 | 3 | 4 | 5 | 6 | 7 | 8 | 9",
                diagonal,
                |change| {
                    let of = golden(2, &format!("stiffness_change_{change}"));
                    (1..=9)
                        .map(|i| i.to_string())
                        .map(|i| computed(&of, &i, &i, 1))
                        .collect()
                },
            ),
        ),
        (
            "matrix_distance",
            table(
                "% | Case 1 | Case 2 | Case 3",
                distances,
                |(row, column)| {
                    (1..=3)
                        .map(|case| computed(&golden(case, "matrix_distance"), row, column, 1))
                        .collect()
                },
            ),
        ),
        (
            "matrix_factors",
            table(
                "element | 1 | 2 | 3 | 7 | 9 | 10 | 13 | 14",
                factors,
                |(case, column)| {
                    let of = golden(case, "matrix_factors");
                    ["1", "2", "3", "7", "9", "10", "13", "14"]
                        .map(|element| computed(&of, element, column, 3))
                        .to_vec()
                },
            ),
        ),
    ]
}

/// The tables of `paper/delta_wing.md`.
fn delta_wing() -> [(&'static str, String); 2] {
    let groups = [
        ("covers, x 30 to 50 in, forward", "covers x 30-50 forward"),
        ("covers, x 70 to 90 in", "covers x 70-90"),
        ("webs along y = 20 in, outboard", "webs y 20 outboard"),
        ("webs along y = 60 in, inboard", "webs y 60 inboard"),
        ("webs along x = 50 in", "webs x 50"),
        ("webs along the leading edge", "webs leading edge"),
        ("webs along x = 30 in, at the supports", "webs x 30"),
        ("web along x = 90 in, at the tip", "web x 90"),
    ];
    let errors = [("frequency", "frequency RMS"), ("shape", "shape RMS")];
    [
        (
            "delta_wing_groups",
            table(
                "group | wrong by, % | left, % | share, %",
                groups,
                |group| {
                    let number =
                        |column, decimals| computed("delta_wing_groups", group, column, decimals);
                    vec![
                        number("First gage error", 0),
                        number("Last gage error", 1),
                        number("Largest share", 1),
                    ]
                },
            ),
        ),
        (
            "delta_wing_errors",
            table("RMS error, % | start | end", errors, |row| {
                cells(
                    "delta_wing_modes",
                    row,
                    ["First error", "Corrected error"],
                    2,
                )
            }),
        ),
    ]
}

/// The tables of `paper/fewer_modes.md`.
fn fewer_modes() -> [(&'static str, String); 3] {
    let tables = ["table_12", "table_11", "table_10"];
    let gage = |row| {
        let mut cells = tables.map(|of| both(of, row, "FEM 9 error", 1)).to_vec();
        cells.push(both("table_6", row, "Pass 1 error", 1));
        cells
    };
    let inner = |row| {
        let mut cells = tables.map(|of| both(of, row, "FEM 9 error", 2)).to_vec();
        cells.push(String::new());
        cells
    };
    let iterations = |tested: &str, of: &str| both("fewer_modes_iterations", tested, of, 0);
    let [three, five, seven] = ["3", "5", "7"].map(|tested| iterations(tested, "FEM 9"));
    [
        (
            "fewer_modes",
            table(
                "nine analysis modes, one pass; computed (published) | 3 test modes | 5 | 7 | 9",
                [
                    ("gage RMS, shear, %", gage("shear RMS")),
                    ("gage RMS, membrane, %", gage("membrane RMS")),
                    ("inner frequency RMS, %", inner("inner frequency RMS")),
                    ("inner shape RMS, %", inner("inner shape RMS")),
                    (
                        "iterations",
                        vec![
                            three,
                            five,
                            seven,
                            both("table_13/table_13", "2", "Pass 1", 0),
                        ],
                    ),
                ],
                |cells| cells,
            ),
        ),
        (
            "fewer_modes_iterations",
            table(
                "iterations, computed (published) | 5 analysis modes | 7 | 9",
                [3, 5, 7].map(|tested| (format!("{tested} test modes"), tested)),
                |tested| {
                    let cell = |analyzed| match analyzed < tested {
                        true => String::new(),
                        false => iterations(&tested.to_string(), &format!("FEM {analyzed}")),
                    };
                    [5, 7, 9].map(cell).to_vec()
                },
            ),
        ),
        (
            "truncation",
            table(
                "test modes | gage RMS, shear, % | gage RMS, membrane, % | exact frequency RMS of nine modes, % | \
                 exact shape RMS of nine modes, % | iterations",
                (1..=9).rev().map(|modes| (modes, modes.to_string())),
                |modes| {
                    let of = [
                        ("shear", 1),
                        ("membrane", 1),
                        ("frequency", 2),
                        ("shape", 2),
                        ("iterations", 0),
                    ];
                    of.map(|(what, decimals)| span(&format!("truncation_{what}"), &modes, decimals))
                        .to_vec()
                },
            ),
        ),
    ]
}

/// The tables of `paper/interpretation.md`.
fn readings() -> [(&'static str, String); 2] {
    const READINGS: [&str; 4] = ["matrix", "own", "relative", "gage"];
    let runs = || {
        let passes = [(1, 1), (1, 2), (2, 1), (2, 2), (3, 1), (3, 2), (3, 3)];
        let fewer = [
            (10, 7),
            (10, 9),
            (11, 5),
            (11, 7),
            (11, 9),
            (12, 5),
            (12, 7),
            (12, 9),
        ];
        let passes = passes.map(|(case, pass)| format!("Case {case} pass {pass}"));
        let fewer = fewer.map(|(table, modes)| format!("Table {table} FEM {modes}"));
        passes
            .into_iter()
            .chain(fewer)
            .map(|run| (run.clone(), run))
    };
    let faulty = [
        ("element 8 (published: about 60)", "Faulty element"),
        ("the next largest", "Next largest"),
    ];
    [
        (
            "readings_agreement",
            table(
                "correlation r; difference d, points | matrix | own | relative | gage",
                runs(),
                |run| {
                    let number = |what, reading, decimals| {
                        computed(
                            "readings_agreement",
                            &run,
                            &format!("{what} {reading}"),
                            decimals,
                        )
                    };
                    READINGS
                        .map(|reading| {
                            format!("{}; {}", number("r", reading, 2), number("d", reading, 1))
                        })
                        .to_vec()
                },
            ),
        ),
        (
            "readings_case_4",
            table(
                "Case 4, unlimited factor | matrix | own | relative | gage",
                faulty,
                |column| {
                    READINGS
                        .map(|reading| computed("case_4_readings", reading, column, 1))
                        .to_vec()
                },
            ),
        ),
    ]
}

/// The structures of the coverage tables.
pub const COVERED: [&str; 12] = [
    "Case 2",
    "Case 2 by bays",
    "Case 3",
    "Delta wing",
    "Building",
    "Chain of 8, 8 sensors, 0.1/0.3 %",
    "Chain of 8, 8 sensors, 0.5/2 %",
    "Chain of 8, 4 sensors, 0.1/0.3 %",
    "Chain of 8, 4 sensors, 0.5/2 %",
    "60 DOF, truncated",
    "Free chain with masses",
    "Four decades",
];

/// The tables at the published counts and of changes that add in `paper/interpretation.md`, and both rates of detection in
/// `paper/localization.md`.
fn step() -> [(&'static str, String); 3] {
    const RULES: [&str; 5] = ["relative", "own", "matrix", "gage", "half"];
    let ends = ["2 %, masses 5 %", "5 %, masses 10 %", "12 %, masses 30 %"]
        .into_iter()
        .flat_map(|size| ["least", "largest"].map(|end| format!("{size}: {end}")));
    let mut named: Vec<(String, [String; 6])> = Vec::new();
    for size in ["2 %, masses 5 %", "5 %, masses 10 %", "12 %, masses 30 %"] {
        let count = |reading| computed("detection_boxes", &format!("{size}, of 300"), reading, 0);
        let counts = ["gage", "own", "matrix"].map(count);
        let [gage, own, matrix] = counts;
        let blank = String::new;
        named.push((
            format!("boxes off by {size}"),
            ["300".to_owned(), gage, own, matrix, blank(), blank()],
        ));
    }
    for structure in ["Chain", "Ring", "Net", "Light oscillators"] {
        let count = |column| computed("detection_jobs", structure, column, 0);
        let blank = String::new;
        let (fit, factor) = (count("Fit first"), count("Factor first"));
        named.push((
            structure.to_lowercase(),
            ["30".to_owned(), blank(), blank(), blank(), fit, factor],
        ));
    }
    [
        (
            "counted_gages",
            table(
                "difference, points | relative | own | matrix | gage | half",
                [alike("all")],
                |run| cells("counted_gages", run, RULES, 1),
            ),
        ),
        (
            "accumulation",
            table(
                "mean difference of 21 frequencies, % | changes add | they multiply",
                once("this box".to_owned())
                    .chain(ends)
                    .map(|row| (row.clone(), row)),
                |row| cells("accumulation", &row, ["changes add", "they multiply"], 2),
            ),
        ),
        (
            "detection",
            table(
                "a hundred times too thin | of | named by gage | by own | by matrix | first by single fit | first by the paper's factor",
                named,
                |counts| counts.to_vec(),
            ),
        ),
    ]
}

/// The tables of `paper/noise.md`, `localization.md` and `weighted.md`.
fn noise() -> [(&'static str, String); 8] {
    let noise = [
        (
            "gage RMS, no noise, %",
            ("noisy_gages", "no noise", "all", 1),
        ),
        ("gage RMS, median, %", ("noisy_gages", "median", "all", 1)),
        ("gage RMS, worst, %", ("noisy_gages", "worst", "all", 1)),
        (
            "shear gage RMS, median, %",
            ("noisy_gages", "median", "shear", 1),
        ),
        (
            "membrane gage RMS, median, %",
            ("noisy_gages", "median", "membrane", 1),
        ),
        (
            "error sum beside these modes, median, %",
            ("noisy_course", "median", "error sum", 1),
        ),
        (
            "frequency RMS beside exact modes, median, %",
            ("noisy_truth", "median", "frequency", 2),
        ),
        (
            "shape RMS beside exact modes, median, %",
            ("noisy_truth", "median", "shape", 2),
        ),
        (
            "iterations, median",
            ("noisy_course", "median", "iterations", 0),
        ),
    ];
    let panels = (1..=15).map(|panel| (format!("panel {panel}"), (panel.to_string(), "first")));
    let all = [
        ("all 1500 tests", "first"),
        ("the same, among the first three", "in three"),
        ("without noise, of 15 tests", ", no noise"),
    ];
    let all = all.map(|(label, what)| (label.to_owned(), ("all".to_owned(), what)));
    [
        (
            "noise",
            table(
                "twenty seeds | raw | orthogonal | screened",
                noise,
                |(of, row, what, decimals)| {
                    ["Raw", "Orthogonal", "Screened"]
                        .map(|modes| computed(of, row, &format!("{modes} {what}"), decimals))
                        .to_vec()
                },
            ),
        ),
        (
            "localization",
            table(
                "first of 100 tests | 0.01: by factor | 0.01: by fit | 0.5: by factor | 0.5: by fit",
                panels.chain(all),
                |(row, what)| {
                    let by = [
                        ("0.01", "Factor"),
                        ("0.01", "Fit"),
                        ("0.5", "Factor"),
                        ("0.5", "Fit"),
                    ];
                    by.map(|(thick, by)| {
                        let column = format!("{by} {what}").replace(" ,", ",");
                        computed(&format!("localization_{thick}"), &row, &column, 0)
                    })
                    .to_vec()
                },
            ),
        ),
        (
            "rules",
            table(
                "without noise | error at first, % | paper's rule: steps, analyses | error, % | \
                 weighted: steps, analyses | error, %",
                ["Case 1", "Case 2", "Case 3", "Delta wing"].map(alike),
                |structure| {
                    let number = |rule, column, decimals| {
                        computed("rules", &format!("{structure}, {rule}"), column, decimals)
                    };
                    let effort = |rule| {
                        format!(
                            "{}, {}",
                            number(rule, "Steps", 0),
                            number(rule, "Analyses", 0)
                        )
                    };
                    let error = |rule| number(rule, "Factor RMS", 1);
                    let (paper, weighted) = ("paper's rule", "weighted");
                    vec![
                        error("first model"),
                        effort(paper),
                        error(paper),
                        effort(weighted),
                        error(weighted),
                    ]
                },
            ),
        ),
        (
            "coverage",
            table(
                "of 300 tests | parameters | seen | held, mean of those seen, % | held, least, % | withheld, %",
                COVERED.map(alike),
                |structure| {
                    let mut row = cells("coverage", structure, ["Parameters", "Seen"], 0);
                    row.extend(cells(
                        "coverage",
                        structure,
                        ["Held", "Least held", "Withheld"],
                        1,
                    ));
                    row
                },
            ),
        ),
        (
            "intervals_structures",
            table(
                "structure | tests | parameters | given, % | held, mean, % | held, least, % | held of status 0, % | status 0, % | three times the noise found, %",
                BUILT_LATER
                    .iter()
                    .flat_map(|name| [".2/1 %", ".5/3 %"].map(|noise| format!("{name}, {noise}")))
                    .map(|row| (row.clone(), row.replace(", .", " 0."))),
                |row| {
                    let mut all = cells("intervals_structures", &row, ["Tests", "Parameters"], 0);
                    all.extend(cells(
                        "intervals_structures",
                        &row,
                        [
                            "Given",
                            "Held",
                            "Least held",
                            "Held of accepted",
                            "Accepted",
                            "Found",
                        ],
                        1,
                    ));
                    all
                },
            ),
        ),
        (
            "intervals_repeats",
            table(
                "150 tests | given, % | held, mean, % | held, least, % | status 0, %",
                ["portal", "girder"]
                    .iter()
                    .flat_map(|name| {
                        [2, 3, 5, 10, 40].map(|files| format!("{name} of {files} files"))
                    })
                    .map(|row| (row.clone(), row)),
                |row| {
                    let columns = ["Given", "Held", "Least held", "Accepted"];
                    cells("intervals_repeats", &row, columns, 1)
                },
            ),
        ),
        (
            "explained",
            table(
                "of 300 tests | degrees of freedom ν | mean χ²/ν | explained, % | three times the noise flagged, %",
                COVERED.map(alike),
                |structure| {
                    let mut row = cells("coverage", structure, ["Degrees of freedom"], 1);
                    row.extend(cells("coverage", structure, ["Chi-squared"], 3));
                    row.extend(cells("coverage", structure, ["Explained", "Flagged"], 1));
                    row
                },
            ),
        ),
        (
            "coverage_case_3",
            table(
                "Case 3, cover | interval holds the truth, % | given, % | learned, %",
                ["2", "15", "9", "11", "4", "8"].map(alike),
                |cover| cells("coverage_case_3", cover, ["Held", "Given", "Learned"], 1),
            ),
        ),
    ]
}

/// The tables of counted and of approximate analyses in `paper/perturbation.md`.
fn analyses() -> [(&'static str, String); 2] {
    let structures = ["Case 1", "Case 2", "Case 3", "Delta wing", "Wing"];
    let reached = structures.into_iter().flat_map(|structure| {
        ["5 %", "2.5 %"]
            .map(|sum| format!("{structure}, {sum}"))
            .map(|row| (row.clone(), row))
    });
    let mut steps = Vec::new();
    for structure in ["Case 2", "Delta wing"] {
        for what in ["frequencies", "shapes"] {
            for (step, size) in [("whole step", "1"), ("a quarter", "0.25")] {
                steps.push((
                    format!("{structure}, {step}, {what}"),
                    format!("{structure}, {size}, {what}"),
                ));
            }
        }
    }
    [
        (
            "eigensolutions",
            table(
                "error sum to be reached | perturbation: eigensolutions in steps | an analysis after every step | \
                 and derivatives by differences",
                reached,
                |row| {
                    let count = |column| computed("eigensolutions", &row, column, 0);
                    let perturbation = format!("{} in {}", count("Perturbation"), count("Steps"));
                    vec![perturbation, count("Re-analysis"), count("And differences")]
                },
            ),
        ),
        (
            "linearization",
            table(
                "RMS error, %: same condensation, condensed anew | first order | Recursive 1, order 4 | Taylor in ω² | \
                 Taylor in 1/ω²",
                steps,
                |row| {
                    let by = [
                        "first order",
                        "Recursive 1, order 4",
                        "Taylor in ω²",
                        "Taylor in 1/ω²",
                    ];
                    by.map(|by| {
                        ["linearization", "linearization_new"]
                            .map(|of| computed(of, &row, by, 3))
                            .join(", ")
                    })
                    .to_vec()
                },
            ),
        ),
    ]
}

/// The tables of `paper/real_test.md`.
fn real_test() -> [(&'static str, String); 5] {
    let words = [
        "two-node wing bending",
        "fuselage rotation",
        "antisymmetric wing torsion",
        "symmetric wing torsion",
        "three-node wing bending",
        "four-node wing bending",
        "wing in its plane",
        "wing in its plane, symmetric",
        "held out",
        "held out",
    ];
    let modes = |name: &'static str, count: usize| {
        table(
            "mode | published, Hz | first, Hz | error, % | corrected, Hz | error, %",
            words.into_iter().zip(1..).take(count),
            |mode: usize| {
                let of = |column, digits| computed(name, &mode.to_string(), column, digits);
                vec![
                    of("Test", 2),
                    of("First", 2),
                    of("First error", 1),
                    of("Corrected", 2),
                    of("Corrected error", 1),
                ]
            },
        )
    };
    let seen = |golden: &'static str, parameters: &[&'static str]| {
        table(
            "parameter | factor | deviation before, % | deviation after, %",
            parameters.iter().map(|name| alike(name)),
            |name| {
                let of = |column, digits| computed(golden, name, column, digits);
                vec![
                    of("Factor", 2),
                    of("Deviation before", 0),
                    of("Deviation", 0),
                ]
            },
        )
    };
    let rigid = [
        "wing bending",
        "wing torsion",
        "damping layer",
        "fuselage",
        "fin",
        "tailplane",
        "joint",
        "drums' mass",
    ];
    let springs = [
        "wing bending",
        "wing in its plane",
        "wing torsion",
        "damping layer",
        "wing root roll",
        "wing root yaw",
        "fin root roll",
        "tail roll",
    ];
    let acts = [
        "rigid, first",
        "rigid, corrected",
        "springs, first",
        "springs, corrected",
    ];
    let acts = table(
        "model | eight, % RMS | ninth, % | tenth, % | chi-squared of the eight",
        acts.map(alike),
        |name| {
            let of = |column, digits| computed("garteur_acts", name, column, digits);
            vec![
                of("Eight", 1),
                of("Ninth", 1),
                of("Tenth", 1),
                of("Chi-squared", 0),
            ]
        },
    );
    [
        ("garteur_modes", modes("garteur_modes", 8)),
        ("garteur_seen", seen("garteur_seen", &rigid)),
        ("garteur_joints_modes", modes("garteur_joints_modes", 10)),
        ("garteur_joints_seen", seen("garteur_joints_seen", &springs)),
        ("garteur_acts", acts),
    ]
}

/// Every computed table by its name.
pub fn tables() -> BTreeMap<String, String> {
    let mut tables = vec![
        ("cases", cases()),
        ("panels", panels()),
        ("costs", costs::costs()),
        ("least_squares", alternative::least_squares()),
    ];
    tables.extend(matrices());
    tables.extend(delta_wing());
    tables.extend(fewer_modes());
    tables.extend(readings());
    tables.extend(step());
    tables.extend(noise());
    tables.extend(analyses());
    tables.extend(real_test());
    tables
        .into_iter()
        .map(|(name, text)| (name.to_owned(), text))
        .collect()
}

/// Sentences with computed numbers, beside the document in which each stands word for word.
pub fn sentences() -> Vec<(&'static str, String)> {
    let deflection = computed("delta_wing_deflections_te", "16", "Measured difference", 1);
    let analog = |mode| computed("delta_wing_frequencies", mode, "Analog difference", 1);
    let iterations = |pass| computed("delta_wing_passes", pass, "Iterations", 0);
    let left = |group| {
        let error = computed("delta_wing_groups", group, "Last gage error", 1);
        error.trim_start_matches('-').to_owned()
    };
    let measured = all(
        "/delta_wing/delta_wing_deflections_",
        "/Measured difference",
    );
    let analog_deflection = |edge: &str, grid: &str| {
        let table = format!("delta_wing_deflections_{edge}");
        let difference = computed(&table, grid, "Analog difference", 1);
        difference.trim_start_matches('-').to_owned()
    };
    let first_errors = largest(&all("/delta_wing/delta_wing_groups/", "/First gage error"));
    let (fit, worst) = (all("/fit/fit/", "/RMS"), all("/fit/fit/", "/Largest"));
    let rms = (fit.iter().map(|x| x * x).sum::<f64>() / fit.len() as f64).sqrt();
    let difference = format!(
        "the difference is {rms:.3} % RMS and {:.2} % at most",
        largest(&worst)
    );
    let held =
        |structure: &str| -> f64 { computed("coverage", structure, "Held", 3).parse().unwrap() };
    let tests = SEEDS.count();
    let faulty = [
        computed("case_4_factors", "8", "Factor", 1),
        published("case_4_factors", "8", "Factor", 0),
    ];
    let others = |method| {
        computed(
            "matrices_case_2/matrix_frequencies_as_tested",
            "RMS others",
            method,
            2,
        )
    };
    let covers = |of: Source| {
        ["2", "15"]
            .map(|cover| of("table_8", cover, "Pass 3 error", 1))
            .join(" and ")
    };
    let left_behind = |panels: &[&str]| {
        let of = |column| {
            panels
                .iter()
                .map(move |panel| computed("case_2_next_step", panel, column, 1))
        };
        let number = |text: String| text.parse::<f64>().unwrap();
        let ends = of("Error at the end").map(number).collect_vec();
        let after = largest(&of("Error after the step").map(number).collect_vec());
        let least = ends.iter().copied().fold(f64::INFINITY, f64::min);
        [least.round(), largest(&ends).round(), after.ceil()]
    };
    let [least, most, after] = left_behind(&["7", "12", "13", "14"]);
    let [report_least, report_most, report_after] = left_behind(&["12", "13", "14"]);
    let of_later = |end: &str| -> Vec<f64> {
        let of = |name: &&str| {
            all(
                &format!("/intervals_structures/intervals_structures/{name} "),
                end,
            )
        };
        BUILT_LATER.iter().flat_map(of).collect()
    };
    let later = of_later("/Held");
    // The widest range of a gage RMS over the numbers of analysis modes.
    let widest = |of: &str| {
        let range = |modes: usize| {
            let numbers = all(&format!("/truncation/truncation_{of}/{modes}/"), "");
            let least = numbers.iter().copied().fold(f64::INFINITY, f64::min);
            largest(&numbers) - least
        };
        (1..=9).map(range).largest()
    };
    let nearer = |run: &str, other: &str, used: &str| {
        let points = |reading: &str| -> f64 {
            let difference = computed("readings_agreement", run, &format!("d {reading}"), 6);
            difference.parse().unwrap()
        };
        points(used) - points(other)
    };
    let worst_held = all("/coverage/coverage/", "/Least held")
        .into_iter()
        .fold(f64::INFINITY, f64::min);
    let (readme, results, wing) = ("README.md", "paper/results.md", "paper/delta_wing.md");
    vec![
        (readme, alternative::sentence()),
        ("paper/cost.md", alternative::tailplane()),
        (
            readme,
            format!(
                "hold the true factor in {:.1} to {:.1} % of {tests} noisy tests",
                COVERED.map(held).into_iter().fold(f64::INFINITY, f64::min),
                COVERED.map(held).into_iter().largest(),
            ),
        ),
        (
            readme,
            format!(
                "{:.1} to {:.1} % on seven built after the program",
                later.iter().copied().fold(f64::INFINITY, f64::min),
                largest(&later),
            ),
        ),
        (
            readme,
            format!(
                "the worst parameter's in {:.1} %",
                of_later("/Least held")
                    .into_iter()
                    .fold(worst_held, f64::min)
            ),
        ),
        (
            "paper/weighted.md",
            format!("The worst cover's intervals hold {worst_held:.1} % of the time"),
        ),
        (
            readme,
            format!(
                "Its unlimited stiffness factor in the first iteration is {} (published: about {})",
                faulty[0], faulty[1]
            ),
        ),
        (readme, format!("({difference})")),
        (
            readme,
            format!(
                "the largest computed deflection is {deflection} % off the measured one, the worst of {} is {:.1} % off.",
                measured.len(),
                largest(&measured)
            ),
        ),
        (
            readme,
            format!(
                "stay {} % wrong (RMS); by element factors they come within {} %",
                others("Baruch"),
                others("Element factors"),
            ),
        ),
        (readme, format!("start up to {first_errors:.0} % wrong")),
        (
            readme,
            format!(
                "recover six within {} %; groups that the modes hardly see end up to {} % off",
                left("webs y 60 inboard"),
                left("webs x 30"),
            ),
        ),
        (
            readme,
            format!(
                "differ from the published ones by {} % RMS, those of the corrected one by {} %; with springs at the joints, to which the \
                 first errors point, by {} %",
                computed("garteur_modes", "frequency RMS", "First error", 1),
                computed("garteur_modes", "frequency RMS", "Corrected error", 1),
                computed("garteur_acts", "springs, corrected", "Eight", 1),
            ),
        ),
        (
            readme,
            format!(
                "two frequencies that were held out stay {} and {} % off",
                computed("garteur_acts", "springs, corrected", "Ninth", 1).trim_start_matches('-'),
                computed("garteur_acts", "springs, corrected", "Tenth", 1),
            ),
        ),
        (
            "paper/real_test.md",
            format!(
                "chi-squared is {}, of which noise alone leaves at most {} in 999 of 1000 tests",
                computed("garteur_acts", "springs, corrected", "Chi-squared", 1),
                computed("garteur_noise", "springs, corrected", "Largest", 1),
            ),
        ),
        (
            "paper/real_test.md",
            format!(
                "chi-squared falls from {} to {}",
                computed("garteur_chi_squared", "First", "Chi-squared", 0),
                computed("garteur_chi_squared", "Corrected", "Chi-squared", 0),
            ),
        ),
        (
            readme,
            format!("takes the panels that stay {least} to {most} % too thick to within {after} %"),
        ),
        (
            "paper/report.md",
            format!(
                "leaves these panels {report_least} to {report_most} percent too thick. The test still sees them: one weighted step \
                 from there brings them within {report_after} percent."
            ),
        ),
        (
            "paper/weighted.md",
            format!(
                "Case 3 keeps {} %",
                computed("rules", "Case 3, weighted", "Factor RMS", 1)
            ),
        ),
        (
            "paper/localization.md",
            format!(
                "It stood first in {} of 1500 tests with noise where the panel is half as thick",
                computed("localization_0.5", "all", "Fit first", 0),
            ),
        ),
        (
            results,
            format!(
                "after Case 1's second pass those of `matrix` lie {:.1} points nearer, after Case 2's first those of `gage` {:.1}.",
                nearer("Case 1 pass 2", "matrix", "own"),
                nearer("Case 2 pass 1", "gage", "relative")
            ),
        ),
        (
            "paper/fewer_modes.md",
            format!(
                "gage RMS changes by at most {:.1} points in shear panels and {:.1} in membranes",
                widest("shear"),
                widest("membrane")
            ),
        ),
        (
            results,
            format!(
                "The inboard rib (element 13) ends with an error of {} %",
                computed("table_4", "13", "Pass 2 error", 1),
            ),
        ),
        (
            results,
            format!(
                "Element 8 asks for {} times its stiffness, where the paper has about {}",
                faulty[0], faulty[1]
            ),
        ),
        (
            results,
            format!(
                "the inboard covers, elements 2 and 15, which end with errors of {} %. The published ones are {} %.",
                covers(computed),
                covers(published),
            ),
        ),
        (
            "paper/reconstruction.md",
            format!("Over the 108 frequencies {difference}"),
        ),
        (
            wing,
            format!(
                "The largest differs by {deflection} %, the others by 0.6 to {:.1} % in magnitude",
                largest(&measured)
            ),
        ),
        (
            wing,
            format!(
                "At grids 55 and 74 they differ by {} and {} % under the load on the trailing edge, by {} and {} % under that on the \
                 leading edge.",
                analog_deflection("te", "55"),
                analog_deflection("te", "74"),
                analog_deflection("le", "55"),
                analog_deflection("le", "74")
            ),
        ),
        (
            wing,
            format!(
                "The analog frequencies differ by {}, {} and {} %.",
                analog("1"),
                analog("2"),
                analog("3")
            ),
        ),
        (
            wing,
            format!(
                "in three passes of {}, {} and {} iterations",
                iterations("1"),
                iterations("2"),
                iterations("3")
            ),
        ),
        (
            wing,
            format!(
                "The other nineteen end within {} %",
                left("webs y 0 inboard")
            ),
        ),
        (
            "paper/matrix_correction.md",
            format!(
                "elements 2 and 15, end with gage errors of {} % even by all nine modes",
                covers(computed)
            ),
        ),
        (
            "paper/matrix_correction.md",
            format!(
                "A cover {} times as thick",
                computed(
                    "matrices_case_1/matrix_factors",
                    "2",
                    "Nearest to Baruch",
                    1
                )
            ),
        ),
    ]
}
