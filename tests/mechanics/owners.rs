//! One model in owners of two kinds: what steps it is the same code, so the bits are the same.

use dbd_kernel::{BodyIndex, Dbd, F64, Leapfrog};
use dbd_tests::{Bench, run};

#[test]
fn fixed_capacity_and_heap_give_the_same_bits() {
    // One TSDA, one bushing and a torsion spring on a body, in both owners.
    let text = r#"
name = "same"
gravity = [0.0, -9.81, 0.0]
duration = 1.0
[[body]]
name = "bob"
mass = 2.0
inertia = [0.1, 0.2, 0.25]
position = [1.0, 0.5, -0.25]
[[tsda]]
between = ["world", "bob"]
points = [[0.0, 1.0, 0.0], [0.0, 0.1, 0.2]]
stiffness = 300.0
damping = 1.5
free_length = 0.9
[[tsda]]
between = ["bob", "world"]
points = [[0.1, 0.0, 0.0], [1.0, 0.0, 0.0]]
stiffness = 40.0
damping = 0.5
free_length = 0.0
[[torsion_spring]]
between = ["world", "bob"]
axis = [0.0, 0.0, 1.0]
stiffness = 3.0
damping = 0.25
preload = 0.5
"#;
    let scene = dbd_scene::Scene::parse(text, "same.toml").unwrap();
    let mut bench = Bench::<F64>::new();
    bench.set_gravity([0.0, -9.81, 0.0]).unwrap();
    let bob = bench.add_body(2.0, [0.1, 0.2, 0.25], dbd_tests::at([1.0, 0.5, -0.25])).unwrap();
    let world = BodyIndex::WORLD;
    let points = [[0.0, 1.0, 0.0], [0.0, 0.1, 0.2]];
    bench.add_tsda([world, bob], points, 300.0, 1.5, 0.9).unwrap();
    bench.add_tsda([bob, world], [[0.1, 0.0, 0.0], [1.0, 0.0, 0.0]], 40.0, 0.5, 0.0).unwrap();
    bench.add_torsion_spring([world, bob], [0.0, 0.0, 1.0], 3.0, 0.25, 0.5).unwrap();
    let hashes = |newton| {
        let dbd = Dbd { newton };
        (run(&scene.model, dbd, 1e-3, 500).hash(), run(&bench, dbd, 1e-3, 500).hash())
    };
    for newton in [0, 2] {
        let (heap, fixed) = hashes(newton);
        assert_eq!(heap, fixed);
    }
    let (heap, fixed) =
        (run(&scene.model, Leapfrog, 1e-3, 500).hash(), run(&bench, Leapfrog, 1e-3, 500).hash());
    assert_eq!(heap, fixed);
}
