//! A pose without forces, about which only stiffness causes vibration.
//!
//! `(model, state) => model`, with the state's pose as its initial one, at rest; without gravity,
//! loads, inputs, preloads and clearances; every spring has its present length as free length,
//! every torsion spring its present angle as 0. Dampers are kept.

use dbd_kernel::elements::input::InputKind;
use dbd_kernel::index::{BodyIndex, ClearanceIndex};
use dbd_kernel::model::Law;
use dbd_kernel::{BodyState, F64, Quaternion, State, Vec3};
use dbd_scene::SceneModel;

/// The model at rest in the pose of a state.
#[must_use]
pub fn frozen(model: &SceneModel<F64>, state: &State<SceneModel<F64>>) -> SceneModel<F64> {
    let mut frozen = model.clone();
    frozen.initial.clone_from(&state.bodies);
    for body in &mut frozen.initial {
        (body.velocity, body.angular_velocity) = (Vec3::ZERO, Vec3::ZERO);
    }
    frozen.gravity.clear();
    frozen.loads.clear();
    for row in 0..frozen.groups.len() {
        settle_anchors(&mut frozen, row, state);
        frozen.groups[row].clearance = ClearanceIndex::NONE;
        for element in 0..frozen.groups[row].elements() {
            relax(&mut frozen, row, element);
        }
    }
    frozen.inputs.clear();
    frozen.knots.clear();
    frozen.sources.clear();
    frozen.clearances.clear();
    for spring in &mut frozen.torsions {
        let orientation = |body: BodyIndex| {
            state.bodies.get(body.row()).map_or(Quaternion::IDENTITY, |b| b.orientation)
        };
        let relative = orientation(spring.a).conjugate().product(orientation(spring.b));
        spring.reference = relative.conjugate();
        spring.preload = 0.0;
    }
    frozen
}

/// Makes ground that an input has moved plain ground where it is now.
fn settle_anchors(model: &mut SceneModel<F64>, row: usize, state: &State<SceneModel<F64>>) {
    let group = &mut model.groups[row];
    let first = usize::from(group.point);
    let middle = first + usize::from(group.triples);
    let end = first + group.points();
    for (body, points) in [(&mut group.a, first..middle), (&mut group.b, middle..end)] {
        let Some(input) = body.anchor_row() else { continue };
        if let InputKind::Anchor { direction } = model.inputs[input].kind {
            for point in &mut model.points[points] {
                *point = *point + direction * state.signals[input].value;
            }
        }
        *body = BodyIndex::WORLD;
    }
}

/// A body's axes, or the world's.
struct Axes<'s>(Option<&'s BodyState<F64>>);

impl Axes<'_> {
    fn place(&self, point: Vec3<f64>) -> Vec3<f64> {
        self.0.map_or(point, |s| s.position + s.orientation.rotation().to_world(point))
    }

    fn local(&self, point: Vec3<f64>) -> Vec3<f64> {
        self.0.map_or(point, |s| s.orientation.rotation().to_body(point - s.position))
    }

    fn to_world(&self, v: Vec3<f64>) -> Vec3<f64> {
        self.0.map_or(v, |s| s.orientation.rotation().to_world(v))
    }

    fn to_axes(&self, v: Vec3<f64>) -> Vec3<f64> {
        self.0.map_or(v, |s| s.orientation.rotation().to_body(v))
    }
}

/// Gives element `i` of a group its present length; without a length, its second point is moved to the rest position.
fn relax(model: &mut SceneModel<F64>, row: usize, i: usize) {
    let group = &model.groups[row];
    let (triples, arms) = (usize::from(group.triples), usize::from(group.arms));
    let first = usize::from(group.point);
    let tip = first + triples + if group.shared { i % arms } else { i };
    let [a, b] = [group.a, group.b].map(|body| Axes(model.initial.get(body.row())));
    let from = a.place(model.points[first + i / arms]);
    let d = b.place(model.points[tip]) - from;
    let element = usize::from(group.element) + i;
    match group.law {
        Law::Tsda => model.tsdas[element].free_length = d.dot(d).sqrt(),
        Law::PointBushing => model.points[tip] = b.local(from),
        Law::Revolute => {
            model.points[tip] = b.local(from);
            let [first, second] = &mut model.revolutes[element].levers;
            *second = b.to_axes(a.to_world(*first));
        }
        Law::Universal => {
            model.points[tip] = b.local(from);
            let universal = &mut model.universals[element];
            let (lever, axis) = (a.to_world(universal.lever), b.to_world(universal.axis));
            let square = lever.dot(lever);
            if square > 0.0 {
                let normal = axis - lever * (lever.dot(axis) / square);
                universal.axis = b.to_axes(normal * (1.0 / normal.dot(normal).sqrt()));
            }
        }
        Law::PointOnLine => {
            let line = &mut model.lines[element];
            let along = a.to_world(line.direction);
            let slide = along * along.dot(d);
            let aside = d - slide;
            if line.free_length > 0.0 {
                line.free_length = aside.dot(aside).sqrt();
            } else {
                model.points[tip] = b.local(from + slide);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use dbd_kernel::Plant;
    use dbd_kernel::forces::wrenches;
    use dbd_scene::Scene;

    use super::*;

    /// Every kind of element, all under tension, some of it after a while.
    const SCENE: &str = r#"
        name = "strained"
        duration = 1
        gravity = [0, -9.81, 1]
        [[body]]
        name = "a"
        mass = 1
        inertia = [0.1, 0.2, 0.25]
        position = [0.1, 0.2, 0.3]
        angular_velocity = [1, 2, 3]
        [[body]]
        name = "b"
        mass = 2
        inertia = [0.1, 0.2, 0.15]
        position = [1.1, 0.2, 0.3]
        [[joint]]
        name = "r"
        type = "revolute"
        between = ["a", "b"]
        at = [0.6, 0.2, 0.3]
        axis = [0, 0, 1]
        stiffness = 500
        span = 0.2
        [[tsda]]
        between = ["world", "b"]
        points = [[0, 1, 0], [0.1, 0, 0]]
        stiffness = 50
        free_length = 0
        [[point_on_line]]
        between = ["a", "b"]
        line_point = [0, 0.1, 0]
        line_direction = [1, 0, 0]
        point = [0, 0.3, 0]
        stiffness = 60
        free_length = 0.1
        [[point_on_line]]
        between = ["world", "a"]
        line_point = [0, 0.1, 0]
        line_direction = [1, 0, 1]
        point = [0, 0.3, 0]
        stiffness = 60
        free_length = 0
        [[torsion_spring]]
        between = ["a", "b"]
        axis = [0, 0, 1]
        stiffness = 7
        preload = 3
    "#;

    #[test]
    fn no_force_is_left() {
        let scene = Scene::parse(SCENE, "strained.toml").unwrap_or_else(|e| panic!("{e}"));
        let mut plant = Plant::new(&scene.model, dbd_kernel::Leapfrog, 1e-3).unwrap();
        plant.advance(300).unwrap();
        let loaded = wrenches(&scene.model, plant.state(), 1e-3).unwrap();
        assert!(loaded.iter().all(|wrench| wrench.force.dot(wrench.force).sqrt() > 1.0));
        let frozen = frozen(&scene.model, plant.state());
        let left = wrenches(&frozen, &State::initial(&frozen), 1e-3).unwrap();
        for wrench in left {
            let size = wrench.force.dot(wrench.force) + wrench.torque.dot(wrench.torque);
            assert!(size.sqrt() < 1e-11, "{wrench:?}");
        }
    }
}
