//! Scenes that a table drives: what their machines are for, they do.

use dbd_kernel::energy::energy;
use dbd_kernel::readouts::Reading;
use dbd_kernel::{F64, Leapfrog, Plant};
use dbd_scene::{Scene, SceneModel};
use dbd_tests::page::figure;
use dbd_tests::scene;

/// What a read-out of the scene shows: a number and zeros, or a vector.
fn read(scene: &Scene, plant: &Plant<&SceneModel<F64>, Leapfrog>, name: &str) -> [f64; 3] {
    match plant.read(&scene.readout(name).unwrap()) {
        Some(Reading::Scalar(value)) => [value, 0.0, 0.0],
        Some(Reading::Vector(vector)) => vector.to_f64(),
        other => panic!("{name}: {other:?}"),
    }
}

fn row(scene: &Scene, body: &str) -> usize {
    scene.body_names.iter().position(|name| name == body).unwrap()
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// The gripper with rigid links and ideal joints, as a function of the cranks' angle from the
/// vertical; half of it, with half of the cylinder.
struct IdealGripper {
    lever: f64,
    rod: f64,
    link: f64,
    /// \[m\] the crank's pivot from the middle, the rod's pin from the middle.
    pivot: f64,
    pin: f64,
}

impl IdealGripper {
    fn piston(&self, angle: f64) -> f64 {
        let (s, c) = angle.sin_cos();
        let across = self.pivot - self.lever * c - self.pin;
        -self.lever * s + (self.rod * self.rod - across * across).sqrt()
    }

    /// How far the finger moves outwards per metre of the piston's way up.
    fn ratio(&self, angle: f64) -> f64 {
        let e = 1e-6;
        let piston = (self.piston(angle + e) - self.piston(angle - e)) / (2.0 * e);
        self.link * angle.cos() / piston
    }
}

pub fn gripper() -> String {
    let scene = scene("gripper");
    let step = scene.step.unwrap();
    let mut plant = Plant::new(&scene.model, Leapfrog, step).unwrap();
    let [right, left] = ["right_finger", "left_finger"];
    // The pads lie 23 mm inside the fingers' centres of mass.
    let gap = |plant: &Plant<&SceneModel<F64>, Leapfrog>| {
        read(&scene, plant, right)[0] - read(&scene, plant, left)[0] - 2.0 * 0.023
    };
    let grip = |plant: &Plant<&SceneModel<F64>, Leapfrog>| {
        [read(&scene, plant, "right_grip")[0], read(&scene, plant, "left_grip")[0]]
    };
    let open = gap(&plant);
    assert!((open - 0.08).abs() < 1e-9, "{open}");
    assert_eq!(grip(&plant), [0.0, 0.0]);

    plant.advance((0.65 / step).round() as u64).unwrap();
    let (pull, closed) = (read(&scene, &plant, "cylinder_force")[0], gap(&plant));
    let [from_right, from_left] = grip(&plant);
    let crank = plant.state().bodies[row(&scene, "right crank")].orientation;
    let angle = 2.0 * crank.v.z.atan2(crank.w) - std::f64::consts::PI;
    let ideal = IdealGripper { lever: 0.02, rod: 0.03, link: 0.06, pivot: 0.035, pin: 0.008 };
    // Half of the pull less the return spring, by the ratio of the ways.
    let spring = scene.model.tsdas[scene.model.tsdas.len() - 3];
    let length = 0.1 - read(&scene, &plant, "piston_point")[1];
    let net = pull + spring.stiffness * (length - spring.free_length);
    let theory = -0.5 * net / ideal.ratio(angle);
    assert!((0.040..0.050).contains(&closed), "{closed}");
    // The weights of links, fingers and piston, 3.5 N in all, close it a little more.
    assert!(from_right > 0.0 && from_left < 0.0, "{from_right} {from_left}");
    for force in [from_right, -from_left] {
        assert!((force / theory - 1.0).abs() < 0.1, "{force} {theory}");
    }
    // The fingers are couplers of parallelograms: they stay upright, by what joints give.
    for finger in ["right finger", "left finger"] {
        let q = plant.state().bodies[row(&scene, finger)].orientation;
        assert!(q.v.dot(q.v).sqrt() < 5e-3, "{finger}: {:?}", q.v);
    }

    plant.advance((0.55 / step).round() as u64).unwrap();
    let reopened = gap(&plant);
    assert!((reopened - open).abs() < 3e-3, "{reopened}");
    assert_eq!(grip(&plant), [0.0, 0.0]);
    let [right, left] = [from_right, -from_left].map(|force| figure(force, 2));
    format!("pads press with {right} and {left} N; rigid, weightless links give {theory:.2} N")
}

/// The tables are inverse dynamics of rigid links; what is left is what joints give and the path
/// between knots.
pub fn delta() -> String {
    let scene = scene("delta-pick-and-place");
    let step = scene.step.unwrap();
    let mut plant = Plant::new(&scene.model, Leapfrog, step).unwrap();
    let home = read(&scene, &plant, "tool_point");
    let start = energy(&scene.model, plant.state(), step).total();
    let places = [
        ("pick", 0.6, 0.75, [-0.16, 0.08, -1.06]),
        ("over the middle", 1.2, 1.2, [0.0, 0.0, -0.96]),
        ("place", 1.65, 1.8, [0.16, -0.08, -1.06]),
        ("home", 2.4, 2.6, home),
    ];
    let mut errors = [0.0_f64; 4];
    let friction = scene.model.torsions[0].damper.row().unwrap();
    let friction = scene.model.dampers[friction];
    let (mut put_in, mut lost) = (0.0, 0.0);
    let steps = (scene.duration / step).round() as u64;
    let mut last = [0.0; 3];
    for n in 1..=steps {
        let torques: Vec<f64> = plant.state().signals.iter().map(|s| s.value).collect();
        plant.step().unwrap();
        let rates = ["rate1", "rate2", "rate3"].map(|name| read(&scene, &plant, name)[0]);
        for i in 0..3 {
            // The torque is held over the step, the rate is not.
            put_in += step * torques[i] * 0.5 * (rates[i] + last[i]);
            lost += step * friction * 0.5 * (rates[i] * rates[i] + last[i] * last[i]);
        }
        last = rates;
        let t = n as f64 * step;
        let tool = read(&scene, &plant, "tool_point");
        for ((_, from, until, place), error) in places.iter().zip(&mut errors) {
            if t > from - 0.5 * step && t < until + 0.5 * step {
                *error = error.max(distance(tool, *place));
            }
        }
    }
    let gained = energy(&scene.model, plant.state(), step).total() - start;
    let rest = put_in - lost - gained;
    for ((name, ..), error) in places.iter().zip(errors) {
        assert!(error < 4e-3, "{name}: {error}");
    }
    // What is missing the joints' dampers took.
    assert!(rest > 0.0 && rest < 0.02 * lost, "{put_in} {lost} {gained}");
    let worst = 1e3 * errors[0].max(errors[2]);
    format!("tool within {worst:.1} mm at pick and place, on torques computed for rigid links")
}
