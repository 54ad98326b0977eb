//! `[start.BODY]`: the state of a body at t = 0 where it differs from the one at which the joints are assembled.
//!
//! `tables => initial states`; for a planar scene also in the plane, to which it is reduced at the assembled pose.
//! Joints, free lengths and angles refer to the poses of `[[body]]`. A body with a table here ignores the velocities of
//! `[[body]]`.

use dbd_kernel::{BodyIndex, BodyState, F64, Quaternion, Vec3};

use crate::assembly::Assembly;
use crate::error::SceneError;
use crate::orientation::Orientation;
use crate::scene::Scene;
use crate::text::{Number, Numbers, Table};

/// The keys of a body's table.
pub(crate) const KEYS: &[&str] = &["position", "orientation", "velocity", "angular_velocity"];

/// The states at t = 0 given in a scene, with their bodies' rows.
pub(crate) fn read(
    root: &Table<'_>,
    assembly: &Assembly,
) -> Result<Vec<(usize, BodyState<F64>)>, SceneError> {
    let Some(value) = root.value("start") else { return Ok(Vec::new()) };
    let start = value.table("tables of states by body: [start.NAME]")?.called("[start]");
    let mut states = Vec::new();
    for (_, name, value) in start.values() {
        let Some(row) = assembly.body_names().iter().position(|known| known == name) else {
            let help = "use the name of a body, or `JOINT.spider` for a spider; quote a name that \
                contains a space or a dot";
            return Err(start.refuse_key(name, "is not a body of the scene", help));
        };
        let table = value.table("a table with a state")?.called(&format!("[start.{name}]"));
        table.only(&[KEYS])?;
        let body = BodyIndex(row as u16);
        let given = assembly.states()[row];
        let position = table.optional("position", Numbers(Number::any("m")))?;
        let velocity = table.optional("velocity", Numbers(Number::any("m/s")))?;
        let spin = table.optional("angular_velocity", Numbers(Number::any("rad/s")))?;
        let orientation = table.optional("orientation", Orientation)?;
        states.push((
            row,
            BodyState {
                position: position.map_or(given.position, Vec3::from_f64),
                orientation: orientation.map_or(given.orientation, |written| {
                    Quaternion::from_f64(assembly.orientation_of_written(body, written))
                }),
                velocity: Vec3::from_f64(velocity.unwrap_or_default()),
                angular_velocity: assembly
                    .of_written(body, Vec3::from_f64(spin.unwrap_or_default())),
            },
        ));
    }
    Ok(states)
}

/// Largest departure \[fraction of the size, rad\] of a state from the plane of a planar scene.
const ALIKE: f64 = 1e-9;

/// Sets the given states at t = 0.
pub(crate) fn apply(
    root: &Table<'_>,
    scene: &mut Scene,
    started: Vec<(usize, BodyState<F64>)>,
) -> Result<(), SceneError> {
    for (row, state) in started {
        if let Some(planar) = &mut scene.planar {
            if planar.plane.leaves(row, &state, ALIKE) {
                let problem = format!("moves `{}` out of its plane", scene.body_names[row]);
                let help = "give a state in the plane, or omit `planar = true`";
                return Err(root.refuse_value("start", &problem, help));
            }
            planar.model.initial[row] = planar.plane.state_inward(row, &state);
        }
        scene.model.initial[row] = state;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use crate::scene::Scene;

    /// Two links between two pins, in the plane, sagging far from the poses at which the joints are closed.
    const CHAIN: &str = "name = \"chain\"\nduration = 1\ngravity = [0, -9.81, 0]\nplanar = true\n\
        [defaults.joint]\ntype = \"revolute\"\naxis = [0, 0, 1]\nstiffness = 1e5\nspan = 0.1\n\
        [[body]]\nname = \"a\"\nmass = 1\ninertia = [0.01, 0.1, 0.1]\nposition = [0.5, 0, 0]\n\
        [[body]]\nname = \"b\"\nmass = 2\ninertia = [0.01, 0.1, 0.1]\nposition = [1.5, 0, 0]\n\
        [[joint]]\nname = \"p\"\nbetween = [\"world\", \"a\"]\nat = [0, 0, 0]\n\
        [[joint]]\nname = \"q\"\nbetween = [\"a\", \"b\"]\nat = [1, 0, 0]\n";

    #[test]
    fn a_planar_scene_starts_at_rest_with_the_elements_that_it_had() {
        let parse = |text: &str| Scene::parse(text, "chain.toml");
        let before = parse(CHAIN).unwrap();
        let rest = crate::settle::relaxed(&before).unwrap();
        let back = parse(&rest.long_text().unwrap()).unwrap();
        let (before, now) = (before.planar.unwrap().model, back.planar.clone().unwrap().model);
        assert_eq!((before.points, before.tsdas), (now.points, now.tsdas));
        assert_eq!(back.model.initial, rest.model.initial);
        assert!(now.initial[1].position.y.abs() > 1.0 || now.initial[1].position.x.abs() > 1.0);
        let again = crate::settle::relaxed(&back).unwrap().settled.unwrap();
        assert!(again.moved.iter().all(|moved| moved.distance < 1e-8), "{again:?}");
        let out = format!("{CHAIN}[start.a]\nposition = [0.5, 0, 0.1]\n");
        let said = parse(&out).unwrap_err().message();
        assert!(said.contains("moves `a` out of its plane"), "{said}");
    }
}
