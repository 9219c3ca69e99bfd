//! Standard deviations of components: what jobs make of them.

use crate::prelude::*;

/// The building's test with other deviations.
fn job(change: impl FnOnce(&mut TestData)) -> JobResult {
    let (_folder, path) = placed(&building());
    let mut data = prepare(&path).unwrap().loaded.data.clone();
    change(&mut data);
    corrected(data)
}

fn corrected(data: TestData) -> JobResult {
    let mut files: Files = building();
    let test = files.iter_mut().find(|(name, _)| name == "test.csv");
    test.unwrap().1 = write_csv(&data);
    let loaded = prepared(&files);
    finished(&loaded)
}

/// The noise of a job's test, so that weights matter.
fn noisy(data: &mut TestData) {
    let exact = Modes::from_measured(&data.frequencies_hz, &data.shapes).unwrap();
    let test = with_noise(&exact, Noise::USUAL, 11).unwrap();
    (data.frequencies_hz, data.shapes) = (test.frequencies_hz(), test.shapes().clone());
}

#[test]
fn equal_deviations_of_components_are_the_deviation_of_the_shape() {
    let of_shapes = job(|data| {
        noisy(data);
        data.shape_deviation = Some(vec![0.013; 5]);
    });
    let of_components = job(|data| {
        noisy(data);
        let own = DVector::from_element(5, 0.013);
        data.component_deviation = (0..5).map(|mode| (mode, own.clone())).collect();
        // A column takes the place of the row's number.
        data.shape_deviation = Some(vec![0.4; 5]);
    });
    assert_alike(
        of_shapes.found.factors.iter(),
        &of_components.found.factors,
        WEIGHTED_FACTOR,
    );
    let [one, two] = [&of_shapes, &of_components].map(|of| of.misfit.chi_squared);
    assert!(relative_error(one, two) < WEIGHTED_FACTOR, "{one} {two}");
    let mut assumed = of_components.trust.all().iter();
    let assumed = assumed.find(|own| own.identifier == "assumed-deviations");
    let words = "Standard deviations assumed: 0.5 % of frequencies.";
    assert_eq!(assumed.map(|own| &own.words[..]), Some(words));
}

/// As the deviation of a component grows, the test becomes one without its sensor.
#[test]
fn a_component_of_boundless_deviation_is_as_one_without_a_sensor() {
    let largest = |data: &TestData| data.shapes.column(0).iamax();
    let vague = job(|data| {
        noisy(data);
        let row = largest(data);
        let own = DVector::from_fn(5, |sensor, _| if sensor == row { 1e5 } else { 0.01 });
        data.component_deviation = (0..5).map(|mode| (mode, own.clone())).collect();
    });
    let without = job(|data| {
        noisy(data);
        let row = largest(data);
        // Deviations are fractions of the largest component of all, which the others then lack.
        let scale = |mode: usize| {
            let shape = data.shapes.column(mode);
            shape.amax() / shape.into_owned().remove_row(row).amax()
        };
        let own = |mode: usize| (mode, DVector::from_element(4, 0.01 * scale(mode)));
        let own: BTreeMap<usize, DVector<f64>> = (0..5).map(own).collect();
        data.component_deviation = own;
        data.shapes = data.shapes.clone().remove_row(row);
        data.sensors.remove(row);
    });
    assert_alike(
        vague.found.factors.iter(),
        &without.found.factors,
        WEIGHTED_FACTOR,
    );
}
