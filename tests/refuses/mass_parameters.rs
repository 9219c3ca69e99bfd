//! Mass parameters that cannot be are refused.

use crate::spec::s2_parameters_mass::{DENSITY, boxed, point_masses};
use corfem::method::error::Error;
use corfem::method::model::{FiniteElementModel, Parameter, Scaled};

#[test]
fn bad_mass_parameters_name_the_offender() {
    let unknown = boxed(
        vec![Parameter::of("far", Scaled::PointMass, &[9])],
        DENSITY,
        [1.0; 9],
    );
    let Err(Error::Unknown {
        owner,
        what: "dynamic degree of freedom",
        label: 9,
    }) = unknown
    else {
        panic!("{:?}", unknown.err())
    };
    assert_eq!(owner, "parameter far");
    let unknown = boxed(
        vec![Parameter::of("far", Scaled::ElementMass, &[40])],
        DENSITY,
        [1.0; 9],
    );
    assert!(
        matches!(unknown, Err(Error::Unknown { ref owner, what: "element", label: 40 }) if owner == "parameter far")
    );
    let twice = vec![
        Parameter::of("a", Scaled::PointMass, &[3]),
        Parameter::of("b", Scaled::PointMass, &[4, 3]),
    ];
    let shared = boxed(twice, DENSITY, [1.0; 9]);
    assert!(
        matches!(shared, Err(Error::SharedElement { element: 3, ref first, ref second }) if first == "a" && second == "b")
    );
    // The same element may have its stiffness in one parameter and its mass in another.
    let both = vec![
        Parameter::element(3, None),
        Parameter::of("mass of 3", Scaled::ElementMass, &[3]),
    ];
    assert!(boxed(both, DENSITY, [1.0; 9]).is_ok());
    let empty = boxed(
        vec![Parameter::of("none", Scaled::PointMass, &[])],
        DENSITY,
        [1.0; 9],
    );
    assert!(matches!(
        empty,
        Err(Error::Empty {
            what: "members of a parameter"
        })
    ));
    assert!(matches!(
        boxed(vec![], DENSITY, [1.0; 9]),
        Err(Error::Empty { what: "parameters" })
    ));
    assert!(matches!(
        boxed(point_masses(), -1.0, [1.0; 9]),
        Err(Error::NotPositive {
            what: "density",
            ..
        })
    ));
}

#[test]
fn point_mass_coupled_to_others_cannot_be_scaled() {
    let model = boxed(point_masses(), DENSITY, [1.0; 9]).expect("a model");
    let mut mass = model.mass().clone();
    mass[(4, 6)] = 0.001;
    mass[(6, 4)] = 0.001;
    let parameters = |dof| vec![Parameter::of("p", Scaled::PointMass, &[dof])];
    let make = |dof| {
        let t = model.load_distribution().clone();
        FiniteElementModel::new(model.structure().clone(), t, mass.clone(), parameters(dof))
    };
    assert!(matches!(make(6), Err(Error::CoupledMass(6))));
    assert!(make(5).is_ok());
}
