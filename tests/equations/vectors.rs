//! The known answers of `golden/vectors.json`, written by numpy: an input and its answer for every equation, and fifty random structures.
//!
//! This program's answers are left beside its own files for `golden/mark.py`, which marks any implementation's.

use super::formula::Letter;
use crate::common::appendix_c::diagonal_pencil;
use crate::common::structures::of_dense;
use crate::prelude::*;
use serde_json::Map;

/// Bytes of the file at most: a program in another language has it beside itself.
const LARGEST: usize = 150_000;
/// Random structures among the vectors.
const STRUCTURES: usize = 50;

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

fn analysis(given: &Value) -> Value {
    let (model, factors, loads) = (
        model(&given["structure"]),
        flat(&given["factors"]),
        matrix(&given["loads"]),
    );
    let (elements, free) = (model.element_matrices(), model.structure().free_dof());
    let sizes = model.sizes(&factors).unwrap();
    let stiffness = assemble(elements, &sizes, free.len()).unwrap();
    let whole = |element: &ElementMatrix| {
        let mut unit = zero_square(free.len());
        for (b, &column) in element.dof.iter().enumerate() {
            for (a, &row) in element.dof.iter().enumerate() {
                unit[(row, column)] = element.unit[(a, b)];
            }
        }
        rows(&unit)
    };
    let factor = of_dense(&stiffness).unwrap();
    let deflections = factor.solve(&loads).unwrap();
    let t = model.load_distribution();
    let flexibility = t.tr_mul(&factor.solve(t).unwrap());
    let condensed = model.condense(&factors).unwrap();
    let DynamicModel { mass, shares, .. } = matrices(&model, &factors);
    json!({
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
    })
}

fn box_loads(given: &Value) -> Value {
    let model = case_of(1).model().unwrap();
    let t = model.load_distribution();
    let loads = t * list(&given["dynamic_loads"]);
    json!({ "structural_loads": loads.as_slice(), "load_distribution": rows(t) })
}

fn modes(given: &Value) -> Value {
    let (stiffness, mass) = (matrix(&given["stiffness"]), matrix(&given["mass"]));
    let modes = solve(&stiffness, &mass, mass.nrows()).unwrap();
    let test = Modes::from_measured(&flat(&given["frequencies_hz"]), &matrix(&given["shapes"]));
    let test = test.and_then(|test| test.scaled_with(&mass)).unwrap();
    json!({
        "omega_squared": modes.omega_squared().as_slice(),
        "shapes": rows(modes.shapes()),
        "analysis_hz": modes.frequencies_hz(),
        "test_omega_squared": test.omega_squared().as_slice(),
        "test_shapes": rows(test.shapes()),
    })
}

fn comparison(given: &Value) -> Value {
    let set = |squares: &str, shapes: &str| {
        Modes::new(list(&given[squares]), matrix(&given[shapes])).unwrap()
    };
    let (analysis, test) = (
        set("omega_squared", "shapes"),
        set("test_omega_squared", "test_shapes"),
    );
    let cross = cross_orthogonality(&analysis, &test, &matrix(&given["mass"])).unwrap();
    let pairing = pair_modes(&cross).unwrap();
    let errors = errors(&analysis, &pairing, &test).unwrap();
    let paired = pairing.paired(&analysis).unwrap();
    json!({
        "paired_omega_squared": paired.omega_squared().as_slice(),
        "paired_shapes": rows(paired.shapes()),
        "cross_orthogonality": rows(&cross),
        "analysis_mode": pairing.analysis_mode,
        "sign": pairing.sign,
        "frequency_error": errors.frequency,
        "shape_error": errors.shape,
    })
}

fn stiffness_alone(given: &Value) -> Value {
    let (k, beta) = (list(&given["k"]), matrix(&given["beta"]));
    let mut answer = Map::new();
    for order in [1, 2, 3, 6] {
        let Perturbed { roots, shapes } = recursive_1(&k, &beta, order).unwrap();
        answer.insert(format!("roots_{order}"), json!(roots.as_slice()));
        let changes = roots - k.map(f64::recip);
        answer.insert(format!("root_changes_{order}"), json!(changes.as_slice()));
        answer.insert(format!("shapes_{order}"), rows(&shapes));
    }
    answer.into()
}

fn with_mass(given: &Value) -> Value {
    let k = list(&given["k"]);
    let [beta, alpha] = ["beta", "alpha"].map(|key| complex(given, key));
    let pencil = diagonal_pencil(&k, &beta, &alpha);
    let mut answer = Map::new();
    let column = |roots: &DVector<Complex<f64>>| {
        DMatrix::from_column_slice(roots.len(), 1, roots.as_slice())
    };
    let first = pencil.first_order().unwrap();
    let changes = &first.roots - k.map(|k| Complex::from(1.0 / k));
    put(&mut answer, "root_changes", &column(&changes));
    let mut both = |rule: String, found: Perturbed<Complex<f64>>| {
        put(&mut answer, &format!("{rule}_roots"), &column(&found.roots));
        put(&mut answer, &format!("{rule}_shapes"), &found.shapes);
    };
    for order in [1, 2, 4] {
        both(
            format!("recursive_1_{order}"),
            pencil.recursive_1(order).unwrap(),
        );
        both(
            format!("recursive_2_{order}"),
            pencil.recursive_2(order).unwrap(),
        );
    }
    both("original".into(), pencil.original().unwrap());
    let settled = pencil.recursive_1_converged().unwrap();
    both("exact".into(), settled.perturbed);
    let [beta, alpha] = [beta, alpha].map(|change| change.map(|z| z.re));
    let vibrations = Pencil::of_vibrations(&k, &beta, &alpha).unwrap();
    let settled = vibrations.recursive_1_converged().unwrap();
    let Perturbed { roots, shapes } = settled.perturbed;
    answer.insert("vibrations_roots".into(), json!(roots.as_slice()));
    answer.insert("vibrations_shapes".into(), rows(&shapes));
    answer.into()
}

fn left_and_right(given: &Value) -> Value {
    let real = |key: &str| matrix(&given[key]);
    let modes = appendix_c::solve(&real("stiffness"), &complex(given, "g")).unwrap();
    let [stiffness, stiffness_change, g_change] =
        ["stiffness", "stiffness_change", "g_change"].map(|key| complex(given, key));
    let none = DMatrix::zeros(stiffness.nrows(), stiffness.ncols());
    let before = Pencil::new(&stiffness, &modes, &none, &none).unwrap();
    let after = Pencil::new(&stiffness, &modes, &stiffness_change, &g_change);
    let after = after.unwrap();
    let LeftRightModes { roots, right, left } = &modes;
    // The changed stiffness is not symmetric: its inverse goes to the other side.
    let inverse = (&stiffness + &stiffness_change).try_inverse().unwrap();
    let unit = DMatrix::identity(modes.roots.len(), modes.roots.len());
    let changed = appendix_c::solve(&unit, &(inverse * (complex(given, "g") + &g_change)));
    let changed = changed.unwrap();
    let settled = after.recursive_1_converged().unwrap();
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
    answer.into()
}

fn state_and_step(given: &Value) -> Value {
    let (model, factors) = (model(&given["structure"]), flat(&given["factors"]));
    let test = Modes::new(
        list(&given["test_omega_squared"]),
        matrix(&given["test_shapes"]),
    )
    .unwrap();
    let modal = model
        .analyze(&vec![1.0; factors.len()], &test, None)
        .unwrap();
    let state = modal.at(&factors).unwrap();
    let by = |rule| modal.stiffness_changes(&state, &factors, rule);
    let changes = modal.error_changes(&state).unwrap();
    let settings = Settings::default().for_modes(test.len()).inner;
    let stiffnesses = by(StepRule::Matrix);
    let unlimited = |relaxation| -> Vec<f64> {
        let both = changes.iter().zip(&stiffnesses);
        both.map(|(e, k)| unlimited_factor(*e, *k, state.errors.sum(), relaxation))
            .collect()
    };
    let start = &modal.exact().modes;
    let dynamic = matrices(&model, &vec![1.0; factors.len()]);
    json!({
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
        "start_error_changes": modal.error_changes(modal.exact()).unwrap(),
    })
}

fn appendix_b(given: &Value) -> Value {
    let [stiffness, mass, rigid_body, shapes] =
        ["stiffness", "mass", "rigid_body", "raw"].map(|key| matrix(&given[key]));
    let raw = Modes::new(list(&given["omega_squared"]), shapes).unwrap();
    let balanced = balance(&raw, &stiffness, &mass, &rigid_body).unwrap();
    let test = Modes::new(raw.omega_squared().clone(), balanced.shapes.clone()).unwrap();
    let found = orthogonalize(&test, &mass).unwrap().modes;
    let unit = test.scaled_with(&mass).unwrap();
    json!({
        "coefficients": rows(&balanced.coefficients),
        "balanced": rows(&balanced.shapes),
        "analysis_shapes": rows(solve(&stiffness, &mass, 4).unwrap().shapes()),
        "unit": rows(unit.shapes()),
        "generalized_mass": rows(&generalized_mass(unit.shapes(), &mass).unwrap()),
        "omega_squared": found.omega_squared().as_slice(),
        "orthogonal": rows(found.shapes()),
    })
}

/// One pass from first sizes that a test of the structure with others (`truth`) shows to be wrong.
fn one_pass(given: &Value) -> Value {
    let (model, truth) = (model(given), flat(&given["truth"]));
    let right = matrices(&model, &truth);
    let test = solve(&right.stiffness, &right.mass, right.mass.nrows()).unwrap();
    let ones = vec![1.0; truth.len()];
    let analyze = |factors: &[f64]| matrices(&model, factors).analyze(&test, None);
    // With the modes of an eigensolution after every step, which is what Recursive 1 approaches.
    let start = Eigensolved(analyze(&ones).unwrap());
    let settings = Settings::default().for_modes(test.len()).inner;
    let inner = run(&start, &ones, &vec![None; ones.len()], &settings).unwrap();
    let check = analyze(&inner.factors).unwrap();
    let sums = inner
        .iterations
        .iter()
        .map(|iteration| iteration.errors.sum());
    json!({
        "test_hz": test.frequencies_hz(),
        "start_hz": start.exact().modes.frequencies_hz(),
        "frequency_error": start.exact().errors.frequency,
        "shape_error": start.exact().errors.shape,
        "unlimited_factors": inner.first_unlimited_factors,
        "inner_error_sums": sums.collect::<Vec<f64>>(),
        "factors": inner.factors,
        "exact_hz": check.exact().modes.frequencies_hz(),
        "exact_error_sum": check.exact().errors.sum(),
    })
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
            analysis(&json!({ "structure": input, "factors": ones, "loads": loads }))
        }
        false => answer(vector),
    };
    for (key, value) in input.as_object().unwrap() {
        found[&format!("given {key}")] = value.clone();
    }
    found
}

fn answer(vector: &Value) -> Value {
    let function = match vector["function"].as_str().unwrap() {
        "analysis" => analysis,
        "box_loads" => box_loads,
        "modes" => modes,
        "comparison" => comparison,
        "recursive_1" => stiffness_alone,
        "general" => with_mass,
        "left_and_right" => left_and_right,
        "state_and_step" => state_and_step,
        "appendix_b" => appendix_b,
        "one_pass" => one_pass,
        other => panic!("no function {other}"),
    };
    function(&vector["input"])
}

#[test]
fn every_vector_is_answered_as_numpy_answers_it() {
    let (mut answers, mut wrong) = (Map::new(), Vec::new());
    for vector in vectors() {
        let name = vector["name"].as_str().unwrap();
        let found = answer(&vector);
        for (key, expected) in vector["answer"].as_object().unwrap() {
            let (found, expected) = (flat(&found[key]), flat(expected));
            let largest = expected
                .iter()
                .fold(0.0, |largest: f64, number| largest.max(number.abs()));
            let bar = vector["tolerance"].as_f64().unwrap() * largest;
            let apart = found
                .iter()
                .zip(&expected)
                .map(|(a, b)| (a - b).abs())
                .largest();
            if found.len() != expected.len() || apart.is_nan() || apart > bar {
                wrong.push(format!(
                    "{name}: {key}: {:e} of the largest\n{found:?}\n{expected:?}",
                    apart / largest
                ));
            }
        }
        answers.insert(name.to_owned(), found);
    }
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("vectors_answers.json");
    fs::write(file, Value::from(answers).to_string()).unwrap();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_equation_has_a_vector() {
    assert!(include_str!("../../golden/vectors.json").len() <= LARGEST);
    let (mut names, mut equations, mut structures) = (BTreeSet::new(), BTreeSet::new(), 0);
    for vector in vectors() {
        assert!(
            names.insert(vector["name"].to_string()),
            "{} twice",
            vector["name"]
        );
        structures += usize::from(vector["function"] == "one_pass");
        for equation in vector["equations"].as_array().unwrap() {
            equations.insert(equation.as_str().unwrap().to_owned());
        }
    }
    assert_eq!(structures, STRUCTURES);
    assert_eq!(equations, super::FORMULAS.keys().cloned().collect());
}
