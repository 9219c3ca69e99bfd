//! The known answers of `golden/vectors.json`, written by numpy: an input and its answer for every equation and sentence, or what must be
//! refused, and fifty-one random structures.
//!
//! This program's answers are left beside its own files for `golden/mark.py`, which marks any implementation's.

use super::formula::Letter;
use crate::common::appendix_c::diagonal_pencil;
use crate::common::structures::of_dense;
use crate::prelude::*;
use serde_json::Map;

/// Bytes of the file at most: a program in another language has it beside itself.
const LARGEST: usize = 150_000;

/// An answer, or why the input is refused.
type Answer = Result<Value, Error>;

pub fn vectors() -> Vec<Value> {
    let text = include_str!("../../golden/vectors.json");
    let document: Value = serde_json::from_str(text).unwrap();
    document["vectors"].as_array().unwrap().clone()
}

/// Numbers of a list, of rows one after the other.
pub fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(parts) => parts.iter().flat_map(flat).collect(),
        number => vec![number.as_f64().unwrap()],
    }
}

/// Verdict that two lists are alike, to a fraction of the largest number of the second.
pub fn is_near(found: &[f64], expected: &[f64], tolerance: f64) -> bool {
    let bar = tolerance * expected.iter().map(|number| number.abs()).largest();
    let mut pairs = found.iter().zip(expected);
    found.len() == expected.len() && pairs.all(|(a, b)| (a - b).abs() <= bar)
}

fn matrix(value: &Value) -> DMatrix<f64> {
    let rows = value.as_array().unwrap();
    DMatrix::from_row_slice(rows.len(), flat(&rows[0]).len(), &flat(value))
}

fn list(value: &Value) -> DVector<f64> {
    DVector::from_vec(flat(value))
}

/// A matrix (a list is a column) with its imaginary part, if there is one.
fn complex(given: &Value, key: &str) -> DMatrix<Complex<f64>> {
    let part = |value: &Value| match value[0] {
        Value::Array(_) => matrix(value),
        _ => DMatrix::from_column_slice(flat(value).len(), 1, &flat(value)),
    };
    let real = part(&given[key]);
    let imaginary = given.get(format!("{key}_imaginary"));
    real.zip_map(&imaginary.map_or(0.0 * &real, part), Complex::new)
}

/// What a letter stands for: the value of a key, or the family of several or of a list of matrices.
pub fn letter(found: &Value, keys: &str) -> Letter {
    let members = |key: &str| match &found[key][0][0] {
        Value::Array(_) => {
            let members = found[key].as_array().into_iter().flatten();
            members
                .map(|member| matrix(member).map(Complex::from))
                .collect()
        }
        _ => vec![complex(found, key)],
    };
    let mut members = keys.split(", ").flat_map(members).collect_vec();
    match members.len() {
        1 => Letter::One(members.remove(0)),
        _ => Letter::Family((0..).zip(members).collect()),
    }
}

fn rows(matrix: &DMatrix<f64>) -> Value {
    let row = |i| matrix.row(i).iter().copied().collect::<Vec<f64>>();
    json!((0..matrix.nrows()).map(row).collect_vec())
}

/// Puts down a matrix, or a column as a list, with its imaginary part if the known answer has one.
fn put(answer: &mut Map<String, Value>, key: &str, found: &DMatrix<Complex<f64>>) {
    for (key, part) in [
        (key.to_owned(), found.map(|z| z.re)),
        (format!("{key}_imaginary"), found.map(|z| z.im)),
    ] {
        let value = if part.ncols() == 1 {
            json!(part.as_slice())
        } else {
            rows(&part)
        };
        answer.insert(key, value);
    }
}

/// The finite element model of a structure, whose first elements are its parameters.
fn model(given: &Value) -> FiniteElementModel {
    let number = |key: &str| given[key].as_f64().unwrap();
    let count = |value: &Value| value.as_u64().unwrap() as usize;
    let entries = |key: &str| given[key].as_array().unwrap().clone();
    let mut material =
        Material::isotropic(number("youngs_modulus"), number("poissons_ratio")).unwrap();
    material.density = number("density");
    let held = entries("held");
    let grids = entries("grids")
        .iter()
        .zip(&held)
        .enumerate()
        .map(|(label, (position, held))| Grid {
            label,
            position: Vector3::from_row_slice(&flat(position)),
            constrained: [count(held) == 1; 3],
        })
        .collect();
    let elements = entries("elements")
        .iter()
        .enumerate()
        .map(|(label, element)| Element {
            label,
            kind: match element[0].as_str() {
                Some("rod") => ElementKind::Rod,
                Some("shear") => ElementKind::ShearPanel,
                _ => ElementKind::Membrane,
            },
            grids: element[1].as_array().unwrap().iter().map(count).collect(),
            size: element[2].as_f64().unwrap(),
            material,
        })
        .collect();
    let structure = Structure::new(grids, elements).unwrap();
    let mut t = DMatrix::zeros(structure.free_dof().len(), count(&given["dynamic_dof"]));
    for entry in entries("load_distribution") {
        t[(count(&entry[0]), count(&entry[1]))] = entry[2].as_f64().unwrap();
    }
    let parameters = (0..count(&given["parameters"])).map(|label| Parameter::new(label, &[label]));
    FiniteElementModel::new(structure, t, matrix(&given["mass"]), parameters.collect()).unwrap()
}

/// The matrices of a model whose elements have the mass of their first sizes, lumped and condensed as its stiffness is.
fn matrices(model: &FiniteElementModel, factors: &[f64]) -> DynamicModel {
    let b = model.condense(factors).unwrap().transformation;
    let lumped = DMatrix::from_diagonal(&lumped_mass(model.structure()));
    let seen = b.tr_mul(&(lumped * &b));
    let mut dynamic = model.matrices(factors).unwrap();
    dynamic.mass += symmetric_part(&seen);
    dynamic
}

fn analysis(given: &Value) -> Answer {
    let (model, factors, loads) = (
        model(&given["structure"]),
        flat(&given["factors"]),
        matrix(&given["loads"]),
    );
    let (elements, free) = (model.element_matrices(), model.structure().free_dof());
    let sizes = model.sizes(&factors)?;
    let stiffness = assemble(elements, &sizes, free.len())?;
    let whole = |element: &ElementMatrix| {
        let mut unit = zero_square(free.len());
        for (b, &column) in element.dof.iter().enumerate() {
            for (a, &row) in element.dof.iter().enumerate() {
                unit[(row, column)] = element.unit[(a, b)];
            }
        }
        rows(&unit)
    };
    let factor = of_dense(&stiffness)?;
    let deflections = factor.solve(&loads)?;
    let t = model.load_distribution();
    let flexibility = t.tr_mul(&factor.solve(t)?);
    let condensed = model.condense(&factors)?;
    let DynamicModel { mass, shares, .. } = matrices(&model, &factors);
    Ok(json!({
        "structural_stiffness": rows(&stiffness),
        "deflections": rows(&deflections),
        "dynamic_deflections": rows(&model.load_distribution().tr_mul(&deflections)),
        "dynamic_flexibility": rows(&flexibility),
        "dynamic_stiffness": rows(&condensed.stiffness),
        "transformation": rows(&condensed.transformation),
        "shares": shares.iter().map(rows).collect_vec(),
        "structures_mass": rows(&(&mass - model.mass())),
        "mass": rows(&mass),
        "load_distribution": rows(t),
        "sizes": sizes,
        "unit_stiffness": elements.iter().map(whole).collect_vec(),
        "structural_mass": rows(&DMatrix::from_diagonal(&lumped_mass(model.structure()))),
    }))
}

fn elements(given: &Value) -> Answer {
    let number = |key: &str| given[key].as_f64().unwrap();
    let material = Material::isotropic(number("youngs_modulus"), number("poissons_ratio"))?;
    let stiffness = |kind, key: &str| {
        let points = matrix(&given[key]);
        let points = points
            .row_iter()
            .map(|row| Vector3::new(row[0], row[1], row[2]));
        rows(&unit_stiffness(kind, &points.collect_vec(), &material))
    };
    Ok(json!({
        "rod": stiffness(ElementKind::Rod, "ends"),
        "shear": stiffness(ElementKind::ShearPanel, "corners"),
        "membrane": stiffness(ElementKind::Membrane, "corners"),
    }))
}

fn box_loads(given: &Value) -> Answer {
    let model = case_of(1).model().unwrap();
    let t = model.load_distribution();
    let loads = t * list(&given["dynamic_loads"]);
    Ok(json!({ "structural_loads": loads.as_slice(), "load_distribution": rows(t) }))
}

fn modes(given: &Value) -> Answer {
    let (stiffness, mass) = (matrix(&given["stiffness"]), matrix(&given["mass"]));
    let modes = solve(&stiffness, &mass, mass.nrows())?;
    let test = Modes::from_measured(&flat(&given["frequencies_hz"]), &matrix(&given["shapes"]));
    let test = test.and_then(|test| test.scaled_with(&mass))?;
    Ok(json!({
        "omega_squared": modes.omega_squared().as_slice(),
        "shapes": rows(modes.shapes()),
        "analysis_hz": modes.frequencies_hz(),
        "test_omega_squared": test.omega_squared().as_slice(),
        "test_shapes": rows(test.shapes()),
    }))
}

fn comparison(given: &Value) -> Answer {
    let set =
        |squares: &str, shapes: &str| Modes::new(list(&given[squares]), matrix(&given[shapes]));
    let (analysis, test) = (
        set("omega_squared", "shapes")?,
        set("test_omega_squared", "test_shapes")?,
    );
    let cross = cross_orthogonality(&analysis, &test, &matrix(&given["mass"]))?;
    let pairing = pair_modes(&cross)?;
    let errors = errors(&analysis, &pairing, &test)?;
    let paired = pairing.paired(&analysis)?;
    Ok(json!({
        "paired_omega_squared": paired.omega_squared().as_slice(),
        "paired_shapes": rows(paired.shapes()),
        "cross_orthogonality": rows(&cross),
        "analysis_mode": pairing.analysis_mode,
        "sign": pairing.sign,
        "frequency_error": errors.frequency,
        "shape_error": errors.shape,
    }))
}

fn stiffness_alone(given: &Value) -> Answer {
    let (k, beta) = (list(&given["k"]), matrix(&given["beta"]));
    let mut answer = Map::new();
    for order in [1, 2, 3, 6] {
        let Perturbed { roots, shapes } = recursive_1(&k, &beta, order)?;
        answer.insert(format!("roots_{order}"), json!(roots.as_slice()));
        let changes = roots - k.map(f64::recip);
        answer.insert(format!("root_changes_{order}"), json!(changes.as_slice()));
        answer.insert(format!("shapes_{order}"), rows(&shapes));
    }
    Ok(answer.into())
}

fn with_mass(given: &Value) -> Answer {
    let k = list(&given["k"]);
    let [beta, alpha] = ["beta", "alpha"].map(|key| complex(given, key));
    let pencil = diagonal_pencil(&k, &beta, &alpha);
    let mut answer = Map::new();
    let column = |roots: &DVector<Complex<f64>>| {
        DMatrix::from_column_slice(roots.len(), 1, roots.as_slice())
    };
    let first = pencil.first_order()?;
    let changes = &first.roots - k.map(|k| Complex::from(1.0 / k));
    put(&mut answer, "root_changes", &column(&changes));
    let mut both = |rule: String, found: Perturbed<Complex<f64>>| {
        put(&mut answer, &format!("{rule}_roots"), &column(&found.roots));
        put(&mut answer, &format!("{rule}_shapes"), &found.shapes);
    };
    for order in [1, 2, 4] {
        both(format!("recursive_1_{order}"), pencil.recursive_1(order)?);
        both(format!("recursive_2_{order}"), pencil.recursive_2(order)?);
    }
    both("original".into(), pencil.original()?);
    let settled = pencil.recursive_1_converged()?;
    both("exact".into(), settled.perturbed);
    let [beta, alpha] = [beta, alpha].map(|change| change.map(|z| z.re));
    let vibrations = Pencil::of_vibrations(&k, &beta, &alpha)?;
    let settled = vibrations.recursive_1_converged()?;
    let Perturbed { roots, shapes } = settled.perturbed;
    answer.insert("vibrations_roots".into(), json!(roots.as_slice()));
    answer.insert("vibrations_shapes".into(), rows(&shapes));
    Ok(answer.into())
}

fn left_and_right(given: &Value) -> Answer {
    let real = |key: &str| matrix(&given[key]);
    let modes = appendix_c::solve(&real("stiffness"), &complex(given, "g"))?;
    let [stiffness, stiffness_change, g_change] =
        ["stiffness", "stiffness_change", "g_change"].map(|key| complex(given, key));
    let none = DMatrix::zeros(stiffness.nrows(), stiffness.ncols());
    let before = Pencil::new(&stiffness, &modes, &none, &none)?;
    let after = Pencil::new(&stiffness, &modes, &stiffness_change, &g_change)?;
    let LeftRightModes { roots, right, left } = &modes;
    // The changed stiffness is not symmetric: its inverse goes to the other side.
    let inverse = (&stiffness + &stiffness_change).try_inverse().unwrap();
    let unit = DMatrix::identity(modes.roots.len(), modes.roots.len());
    let changed = appendix_c::solve(&unit, &(inverse * (complex(given, "g") + &g_change)))?;
    let settled = after.recursive_1_converged()?;
    let mut answer = Map::new();
    let column =
        |list: &DVector<Complex<f64>>| DMatrix::from_column_slice(list.len(), 1, list.as_slice());
    for (key, found) in [
        ("roots", &column(roots)),
        ("right", right),
        ("left", left),
        ("k", &column(&before.a().diagonal())),
        ("beta", &(after.a() - before.a())),
        ("alpha", &(after.g() - before.g())),
        ("whole_k", before.a()),
        ("whole_g", before.g()),
        ("changed_roots", &column(&changed.roots)),
        ("changed_right", &changed.right),
        ("perturbed_roots", &column(&settled.perturbed.roots)),
        ("perturbed_shapes", &settled.perturbed.shapes),
    ] {
        put(&mut answer, key, found);
    }
    Ok(answer.into())
}

fn state_and_step(given: &Value) -> Answer {
    let factors = flat(&given["factors"]);
    let shares = given["shares"].as_array().into_iter().flatten();
    let dynamic = DynamicModel {
        stiffness: matrix(&given["stiffness"]),
        mass: matrix(&given["mass"]),
        shares: shares.map(matrix).collect(),
    };
    let test = Modes::new(
        list(&given["test_omega_squared"]),
        matrix(&given["test_shapes"]),
    )?;
    let modal = dynamic.clone().analyze(&test, None)?;
    let state = modal.at(&factors)?;
    let by = |rule| modal.stiffness_changes(&state, &factors, rule);
    let changes = modal.error_changes(&state)?;
    let settings = Settings::default().for_modes(test.len()).inner;
    let stiffnesses = by(StepRule::Matrix);
    let unlimited = |relaxation| -> Vec<f64> {
        let both = changes.iter().zip(&stiffnesses);
        both.map(|(e, k)| unlimited_factor(*e, *k, state.errors.sum(), relaxation))
            .collect()
    };
    let start = &modal.exact().modes;
    Ok(json!({
        "start_omega_squared": start.omega_squared().as_slice(),
        "start_shapes": rows(start.shapes()),
        "generalized_shapes": rows(&state.generalized_shapes),
        "mass": rows(&dynamic.mass),
        "shares": dynamic.shares.iter().map(rows).collect_vec(),
        "omega_squared": state.modes.omega_squared().as_slice(),
        "shapes": rows(state.modes.shapes()),
        "frequencies_hz": state.modes.frequencies_hz(),
        "error_sum": state.errors.sum(),
        "unlimited_factors": unlimited(settings.relaxation),
        "first_unlimited_factors": unlimited(settings.first_relaxation),
        "error_changes": changes,
        "stiffness_changes": stiffnesses,
        "diagonal_stiffness_changes": by(StepRule::Own),
        "start_error_changes": modal.error_changes(modal.exact())?,
    }))
}

fn appendix_b(given: &Value) -> Answer {
    let [stiffness, mass, rigid_body, shapes] =
        ["stiffness", "mass", "rigid_body", "raw"].map(|key| matrix(&given[key]));
    let raw = Modes::new(list(&given["omega_squared"]), shapes)?;
    let balanced = balance(&raw, &stiffness, &mass, &rigid_body)?;
    let test = Modes::new(raw.omega_squared().clone(), balanced.shapes.clone())?;
    let found = orthogonalize(&test, &mass)?.modes;
    let unit = test.scaled_with(&mass)?;
    Ok(json!({
        "coefficients": rows(&balanced.coefficients),
        "balanced": rows(&balanced.shapes),
        "analysis_shapes": rows(solve(&stiffness, &mass, 4)?.shapes()),
        "unit": rows(unit.shapes()),
        "generalized_mass": rows(&generalized_mass(unit.shapes(), &mass)?),
        "omega_squared": found.omega_squared().as_slice(),
        "orthogonal": rows(found.shapes()),
    }))
}

/// Passes from first sizes that a test of the structure with others (`truth`) shows to be wrong: one, if no more are asked for.
fn one_pass(given: &Value) -> Answer {
    let (model, truth) = (model(given), flat(&given["truth"]));
    let right = matrices(&model, &truth);
    let test = solve(&right.stiffness, &right.mass, right.mass.nrows())?;
    let passes = given["passes"].as_u64().unwrap_or(1) as usize;
    let settings = Settings {
        least_passes: passes,
        most_passes: passes,
        ..Settings::default().for_modes(test.len())
    };
    // With the modes of an eigensolution after every step, which is what Recursive 1 approaches.
    let analyze = |factors: &[f64]| -> Result<_, Error> {
        Ok(Eigensolved(matrices(&model, factors).analyze(&test, None)?))
    };
    let found = correlate(analyze, &vec![None; truth.len()], &settings, |_, _| true)?;
    let (
        start,
        Pass {
            inner,
            factors,
            check,
        },
    ) = (&found.initial, &found.passes[0]);
    let sums = inner
        .iterations
        .iter()
        .map(|iteration| iteration.errors.sum());
    let exact = found.passes.iter().map(|pass| pass.check.errors.sum());
    Ok(json!({
        "test_hz": test.frequencies_hz(),
        "start_hz": start.modes.frequencies_hz(),
        "frequency_error": start.errors.frequency,
        "shape_error": start.errors.shape,
        "unlimited_factors": inner.iterations[0].unlimited_factors,
        "inner_error_sums": sums.collect_vec(),
        "factors": factors,
        "exact_hz": check.modes.frequencies_hz(),
        "exact_error_sum": check.errors.sum(),
        "exact_error_sums": exact.collect_vec(),
        "best_pass": found.best,
        "best_factors": found.best_factors,
    }))
}

fn settled(given: &Value) -> Answer {
    let (k, beta) = (list(&given["k"]), matrix(&given["beta"]));
    let settled = recursive_1_converged(&k, &beta)?;
    Ok(json!({ "roots": settled.perturbed.roots.as_slice() }))
}

fn sorting(given: &Value) -> Answer {
    let pairing = pair_modes(&matrix(&given["cross_orthogonality"]))?;
    Ok(json!({ "analysis_mode": pairing.analysis_mode, "sign": pairing.sign }))
}

fn limited_step(given: &Value) -> Answer {
    let [unlimited, total, base, shares, range, total_range] = [
        "unlimited",
        "total",
        "base",
        "share_factors",
        "factor_range",
        "total_range",
    ]
    .map(|key| flat(&given[key]));
    let [range, total_range] = [range, total_range].map(|ends| Bounds {
        lower: ends[0],
        upper: ends[1],
    });
    let fraction = given["fraction"].as_f64().unwrap();
    let step = |e: usize| {
        let next = limited_factor(
            unlimited[e],
            fraction,
            total[e],
            base[e],
            range,
            Some(total_range),
        );
        (next, next_share_factor(shares[e], total[e], next))
    };
    let (factors, shares): (Vec<_>, Vec<_>) = (0..total.len()).map(step).unzip();
    Ok(json!({ "factors": factors, "share_factors": shares }))
}

fn tolerances(given: &Value) -> Answer {
    let number = |key: &str| given[key].as_f64().unwrap();
    let settings = Settings {
        error_sum_tolerance: number("error_sum_tolerance"),
        frequency_tolerance: number("frequency_tolerance"),
        shape_tolerance: number("shape_tolerance"),
        ..Settings::default()
    };
    let [frequencies, shapes] = ["frequency_errors", "shape_errors"].map(|key| flat(&given[key]));
    let is_met = |(frequency, shape)| {
        let errors = Errors::of(&[ModeError { frequency, shape }]).unwrap();
        u8::from(settings.are_met_by(&errors))
    };
    let is_met = frequencies.into_iter().zip(shapes).map(is_met);
    Ok(json!({ "is_met": is_met.collect_vec() }))
}

fn examined(given: &Value) -> Answer {
    let limit = |key: &str| given[key].as_f64().unwrap();
    let limits = MovementLimits {
        balance: limit("balance_limit"),
        frequency: limit("frequency_limit"),
        shape: limit("shape_limit"),
    };
    let raw = Modes::new(list(&given["omega_squared"]), matrix(&given["raw"]))?;
    let [stiffness, rigid_body] = ["stiffness", "rigid_body"].map(|key| given.get(key).map(matrix));
    let supports = match (&stiffness, &rigid_body) {
        (Some(stiffness), Some(rigid_body)) => Supports::Free {
            stiffness,
            rigid_body,
        },
        _ => Supports::Held,
    };
    let found = examine(&raw, &matrix(&given["mass"]), supports, &limits)?;
    Ok(json!({
        "kept": found.kept,
        "omega_squared": found.modes.omega_squared().as_slice(),
        "shape_movement": found.movement.iter().map(|of| of.map_or(0.0, |movement| movement.shape)).collect_vec(),
    }))
}

/// A vector's input, each key with "given" before it, and this program's answers; of a random structure its matrices.
pub fn found(name: &str) -> Value {
    let vectors = vectors();
    let vector = vectors
        .iter()
        .find(|vector| vector["name"] == name)
        .expect(name);
    let input = &vector["input"];
    let mut found = match vector["function"] == "one_pass" {
        true => {
            let ones = vec![1.0; flat(&input["truth"]).len()];
            let loads = &input["mass"];
            analysis(&json!({ "structure": input, "factors": ones, "loads": loads })).unwrap()
        }
        false => answer(vector).unwrap(),
    };
    for (key, value) in input.as_object().unwrap() {
        found[&format!("given {key}")] = value.clone();
    }
    found
}

fn answer(vector: &Value) -> Answer {
    let function = match vector["function"].as_str().unwrap() {
        "analysis" => analysis,
        "box_loads" => box_loads,
        "elements" => elements,
        "modes" => modes,
        "comparison" => comparison,
        "recursive_1" => stiffness_alone,
        "general" => with_mass,
        "left_and_right" => left_and_right,
        "state_and_step" => state_and_step,
        "appendix_b" => appendix_b,
        "one_pass" => one_pass,
        "settled" => settled,
        "sorting" => sorting,
        "limited_step" => limited_step,
        "tolerances" => tolerances,
        "examine" => examined,
        other => panic!("no function {other}"),
    };
    function(&vector["input"])
}

/// The kind of an error, as vectors that must be refused name it.
fn kind(error: &Error, function: &Value) -> &'static str {
    match error {
        Error::NotAVibration { .. } => "lost root",
        // A recursion that runs to its end is refused for where it ends.
        Error::CoalescingModes { .. } if function == "settled" => "one mode twice",
        Error::CoalescingModes { .. } => "close modes",
        Error::UnsettledRoots { .. } => "unsettled roots",
        Error::NotPositiveDefinite { .. } => "not definite",
        Error::Value {
            what: "rigid-body stiffness over inertia",
            ..
        } => "supported",
        _ => "of no kind",
    }
}

#[test]
fn every_vector_is_answered_or_refused_as_numpy_does() {
    let (mut answers, mut wrong) = (Map::new(), Vec::new());
    for vector in vectors() {
        let name = vector["name"].as_str().unwrap();
        let found = answer(&vector);
        let error = found.as_ref().err();
        let refused = error.map(|error| kind(error, &vector["function"]));
        if vector.get("refused").and_then(Value::as_str) != refused {
            wrong.push(format!("{name}: refused as {refused:?}: {found:?}"));
        }
        let Ok(found) = found else {
            answers.insert(name.to_owned(), json!({ "refused": refused }));
            continue;
        };
        for (key, expected) in vector["answer"].as_object().into_iter().flatten() {
            let (found, expected) = (flat(&found[key]), flat(expected));
            if !is_near(&found, &expected, vector["tolerance"].as_f64().unwrap()) {
                wrong.push(format!("{name}: {key}\n{found:?}\n{expected:?}"));
            }
        }
        answers.insert(name.to_owned(), found);
    }
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("vectors_answers.json");
    fs::write(file, Value::from(answers).to_string()).unwrap();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_equation_and_sentence_has_a_vector() {
    assert!(include_str!("../../golden/vectors.json").len() <= LARGEST);
    let (mut names, mut found) = (BTreeSet::new(), BTreeSet::new());
    for vector in vectors() {
        assert!(
            names.insert(vector["name"].to_string()),
            "{} twice",
            vector["name"]
        );
        let both = ["equations", "sentences"].map(|key| vector[key].as_array().cloned());
        let both = both.into_iter().flatten().flatten();
        found.extend(both.map(|one| one.as_str().unwrap().to_owned()));
    }
    let document: toml::Table = include_str!("../../paper/equations.toml").parse().unwrap();
    for (entries, key) in [("equation", "number"), ("sentence", "name")] {
        for entry in document[entries].as_array().unwrap() {
            assert!(found.remove(entry[key].as_str().unwrap()), "{}", entry[key]);
        }
    }
    assert!(found.is_empty(), "{found:?}");
}
