//! Lists of raw springs: springs in a row between the same bodies are evaluated together, with the bits of each by
//! itself.

use std::fmt::Write as _;

use dbd_plant::{DampingName, Method, PrecisionName, SchemeName, plant};
use dbd_scene::Scene;

/// Two bodies on raw springs, an odd and an even number of them in a row, to the ground in either order, one with a
/// damper, some on moved ground; and a ball that touches neither.
fn springs(between_all: bool) -> Scene {
    let mut text = String::from(
        "name = \"raw\"\nduration = 1\ngravity = [0, -9.81, 0]\nstep = 1e-4\n\
         [defaults]\nbody = { mass = 1, inertia = [0.02, 0.03, 0.04] }\n\
         [[body]]\nname = \"a\"\nposition = [0.1, 0.2, 0.3]\n[[body]]\nname = \"b\"\nposition = [0.6, 0.1, 0.2]\n\
         [[body]]\nname = \"ball\"\nposition = [3, 0, 0]\n",
    );
    let mut number = 0;
    let mut spring = |ends: [&str; 2], further: &str| {
        let at = |salt: i32| {
            let coordinate =
                |i: i32| f64::from((number * 37 + salt * 17 + i * 29) % 41 - 20) / 100.0;
            [coordinate(1), coordinate(2), coordinate(3)]
        };
        let stiffness = 500 + 10 * number;
        write!(
            text,
            "[[tsda]]\nname = \"s{number}\"\nbetween = {ends:?}\npoints = [{:?}, {:?}]\nfree_length = 0.3\n\
             stiffness = {stiffness}\n{further}\n",
            at(1),
            at(2)
        )
        .unwrap();
        if between_all {
            let place = [3, 0, number + 1];
            write!(
                text,
                "[[tsda]]\nname = \"between{number}\"\nbetween = [\"world\", \"ball\"]\n\
                 points = [{place:?}, [0, 0, 0]]\nfree_length = 0.5\nstiffness = 10\n"
            )
            .unwrap();
        }
        number += 1;
    };
    for (ends, count) in [
        (["world", "a"], 7),
        (["a", "b"], 4),
        (["b", "a"], 1),
        (["b", "world"], 3),
        (["a", "b"], 2),
    ] {
        for _ in 0..count {
            spring(ends, "");
        }
    }
    spring(["a", "b"], "damping = 3");
    spring(["a", "b"], "");
    spring(["a", "b"], "");
    text += "[[input]]\nname = \"shake\"\ntype = \"anchor\"\ntarget = [\"s2\", \"s3\", \"s4\"]\naxis = [0, 1, 0]\n\
             sine = { amplitude = \"10 mm\", frequency = \"5 Hz\" }\n";
    Scene::parse(&text, "raw.toml").unwrap()
}

#[test]
fn springs_in_a_row_have_the_bits_of_each_by_itself() {
    let (row, alone) = (springs(false), springs(true));
    for scheme in [SchemeName::Leapfrog, SchemeName::Rk4] {
        for precision in [PrecisionName::F64, PrecisionName::F32, PrecisionName::Fixed] {
            let method = Method::new(scheme, None, precision).unwrap();
            let bodies = [&row, &alone].map(|scene| {
                let mut plant = plant(scene, &method, 1e-4).unwrap();
                plant.advance(2_000).unwrap();
                plant.state().bodies[..2].to_vec()
            });
            assert_eq!(bodies[0], bodies[1], "{scheme:?} {precision:?}");
            let moved = (bodies[0][0].position.to_f64()[1] - 0.2).abs();
            assert!(moved > 1e-3, "{scheme:?} {precision:?} {moved}");
        }
    }
    let explicit = Method::default().with_damping(DampingName::Explicit).unwrap();
    let bodies = [&row, &alone].map(|scene| {
        let mut plant = plant(scene, &explicit, 1e-4).unwrap();
        plant.advance(2_000).unwrap();
        plant.state().bodies[..2].to_vec()
    });
    assert_eq!(bodies[0], bodies[1], "dampers as forces");
}
