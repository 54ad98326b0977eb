//! Instances in lanes against the same instances alone.

use dbd_plant::instance::lockstep::Lockstep;
use dbd_plant::instance::{Blueprint, Instance, InstanceError, Settings};

fn path(name: &str) -> String {
    format!("{}/../../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

fn of(name: &str, precision: &str, scheme: &str, changes: &[&str]) -> Instance {
    let mut blueprint = Blueprint::load(path(name)).unwrap();
    blueprint.changes = changes.iter().map(|change| (*change).to_owned()).collect();
    let (scheme, precision) = (Some(scheme.to_owned()), Some(precision.to_owned()));
    Instance::new(blueprint, Settings { scheme, precision, ..Settings::default() }).unwrap()
}

/// Four instances with other numbers each, one of which fails in its first steps.
fn four(name: &str, precision: &str) -> Vec<Instance> {
    let changes = ["gravity[1]=-9", "gravity[1]=-8", "joint.*.stiffness=1e14", "gravity[1]=-7"];
    changes.iter().map(|change| of(name, precision, "leapfrog", &[change])).collect()
}

#[test]
fn instances_in_lanes_are_the_instances_alone() {
    for (name, precision) in
        [("cart-pendulum", "f64"), ("cart-pendulum", "f32"), ("macpherson", "f64")]
    {
        let (mut together, mut alone) = (four(name, precision), four(name, precision));
        let mut together: Vec<&mut Instance> = together.iter_mut().collect();
        let mut lanes = Lockstep::new(&together).expect(name);
        for (hold, steps) in [1, 70, 64, 30].into_iter().enumerate() {
            for (row, (one, other)) in together.iter_mut().zip(&mut alone).enumerate() {
                for input in 0..one.inputs().len() {
                    let value = 0.001 * (hold + row) as f64;
                    one.set_input(input, value).unwrap();
                    other.set_input(input, value).unwrap();
                }
            }
            let results = lanes.advance(&mut together, steps);
            for (row, result) in results.into_iter().enumerate() {
                let what = format!("{name}, {precision}, instance {row}, hold {hold}");
                let own = alone[row].advance(steps);
                assert_eq!(own.is_err(), row == 2, "{what}");
                let text = |result: Result<(), InstanceError>| result.err().map(|e| e.to_string());
                assert_eq!(text(result), text(own), "{what}");
                assert_eq!(together[row].save().ok(), alone[row].save().ok(), "{what}");
                assert_eq!(together[row].plant().steps(), alone[row].plant().steps(), "{what}");
                let values = |instance: &Instance| instance.values().into_iter().map(f64::to_bits);
                assert!(values(together[row]).eq(values(&alone[row])), "{what}");
            }
        }
    }
}

#[test]
fn lanes_are_refused_where_instances_are_not_alike() {
    let cart = |changes: &[&str]| of("cart-pendulum", "f64", "leapfrog", changes);
    let accepted = |one: Instance, other: Instance| {
        let (mut one, mut other) = (one, other);
        Lockstep::new(&[&mut one, &mut other]).is_some()
    };
    assert!(accepted(cart(&[]), cart(&["gravity[1]=-9"])));
    assert!(!accepted(cart(&[]), cart(&["joint.*.damping=0"])));
    assert!(!accepted(cart(&[]), cart(&["step=1e-4"])));
    assert!(!accepted(cart(&[]), of("cart-pendulum", "f32", "leapfrog", &[])));
    assert!(!accepted(cart(&[]), of("macpherson", "f64", "leapfrog", &[])));
    let rk4 = || of("cart-pendulum", "f64", "rk4", &[]);
    assert!(!accepted(rk4(), rk4()));
    assert_eq!((Lockstep::lanes(&rk4(), 8), Lockstep::lanes(&cart(&[]), 1)), (1, 1));
    assert!(Lockstep::lanes(&cart(&[]), 2) == 2);
    // Stepped in its plane, with other bits than in space.
    let planar = of("four-bar", "f64", "leapfrog", &["planar=true"]);
    assert!(planar.scene().planar.is_some());
    assert_eq!(Lockstep::lanes(&planar, 8), 1);
}
