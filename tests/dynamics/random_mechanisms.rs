//! Mechanisms at random against the reference, which integrates by itself.

use dbd_plant::{Frequencies, Method, PrecisionName, SchemeName};
use dbd_scene::Scene;
use dbd_study::reference::reference_solution::{Integrator, integrate};
use dbd_study::reference::trajectory::{Positions, sample_times};
use dbd_study::reference::{Mechanism, Trajectory};
use dbd_tests::mechanisms::{JOINTS, Kind, TICK, mechanism};

/// \[s\] the window, and how many samples it has: knots and windows lie on steps.
const WINDOW: f64 = 8.0 * TICK;
const SAMPLES: u32 = 4;

const SPATIAL: Kind =
    Kind { planar: false, joints: JOINTS, damping: [0.0, 0.2], driven: true, approximate: false };
const UNDAMPED: Kind = Kind { damping: [0.0; 2], ..SPATIAL };
const PLANAR: Kind =
    Kind { planar: true, joints: &["revolute", "translational", "fixed"], ..SPATIAL };
/// A clearance has a kink at its edge, which no step resolves to its order.
const APPROXIMATE: Kind = Kind { approximate: true, ..SPATIAL };

/// \[m\] what the classical scheme of order 4 and the limits of two schemes of order 2 may differ by from the
/// reference: leapfrog, whose dampers are passes, and generalised-α, which solves.
const SMOOTH: [f64; 3] = [2e-9, 2e-7, 2e-6];
const KINKED: [f64; 3] = [2e-6; 3];

/// Where the bodies are by the reference.
fn reference_solution(scene: &Scene) -> Trajectory {
    let (mechanism, start) = Mechanism::of(scene);
    let times = sample_times(WINDOW, SAMPLES);
    let states = integrate(Integrator::Dop853, &mechanism, &start, &times).unwrap();
    let uncertainty = vec![0.0; times.len()];
    Trajectory { times, states, uncertainty }
}

/// Where the bodies are by a scheme whose steps are `product` over the highest frequency.
fn run(
    scene: &Scene,
    reference_solution: &Trajectory,
    scheme: SchemeName,
    product: f64,
) -> Vec<Positions> {
    let method = Method::new(scheme, None, PrecisionName::F64).unwrap();
    let interval = WINDOW / f64::from(SAMPLES);
    let steps = interval * Frequencies::of(scene).bound / product;
    reference_solution.run(scene, &method, 2 * (0.5 * steps).ceil() as u64)
}

/// The limit of a scheme of order 2 from a step and its half.
fn limit(scene: &Scene, reference_solution: &Trajectory, scheme: SchemeName) -> Vec<Positions> {
    let [coarse, fine] =
        [0.05, 0.025].map(|product| run(scene, reference_solution, scheme, product));
    let ahead = |(coarse, fine): (&Positions, &Positions)| {
        coarse.iter().zip(fine).map(|(coarse, fine)| fine + (fine - coarse) / 3.0).collect()
    };
    coarse.iter().zip(&fine).map(ahead).collect()
}

/// Every joint of every realisation, in space and in a plane, with single elements, loads, inputs and tables.
#[test]
fn every_mechanism_moves_as_the_reference_does() {
    let mut texts = String::new();
    let mut off = Vec::new();
    for (kind, count, most) in [
        (SPATIAL, 30, SMOOTH),
        (UNDAMPED, 10, SMOOTH),
        (PLANAR, 12, SMOOTH),
        (APPROXIMATE, 6, KINKED),
    ] {
        for seed in 1..=count {
            let text = mechanism(seed, kind);
            let scene = Scene::parse(&text, "random.toml").unwrap_or_else(|why| panic!("{why}"));
            let reference_solution = reference_solution(&scene);
            let errors = [
                reference_solution.error(&run(&scene, &reference_solution, SchemeName::Rk4, 0.03)),
                reference_solution.error(&limit(&scene, &reference_solution, SchemeName::Leapfrog)),
                reference_solution.error(&limit(
                    &scene,
                    &reference_solution,
                    SchemeName::GeneralizedAlpha,
                )),
            ];
            // An error that is no number is not near either.
            let near = errors.iter().zip(most).all(|(error, most)| *error < most);
            if !near {
                off.push(format!("{errors:?} of\n{text}"));
            }
            texts += &text;
        }
    }
    assert!(off.is_empty(), "{} mechanisms differ: {}", off.len(), off.join("\n\n"));
    let joints: Vec<&str> = texts.split("\n[[").filter(|part| part.starts_with("joint")).collect();
    for kind in JOINTS {
        for bushing in [false, true] {
            let slides = matches!(*kind, "cylindrical" | "translational");
            let made = joints.iter().any(|joint| {
                joint.contains(&format!("\"{kind}\"")) && joint.contains("\"bushing\"") == bushing
            });
            assert_eq!(made, !(bushing && slides), "{kind}, bushing: {bushing}");
        }
    }
    for part in [
        "[[tsda]]",
        "[[point_on_line]]",
        "[[torsion_spring]]",
        "[[load]]",
        "\"anchor\"",
        "\"actuator\"",
        "\"force\"",
        "\"torque\"",
        "\"joint_torque\"",
        "\"held\"",
        "\"linear\"",
        "\"outward\"",
        "clearance",
        "free_length = 0.0",
    ] {
        assert!(texts.contains(part), "no mechanism has {part}");
    }
}
