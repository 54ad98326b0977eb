//! Raw TSDAs in groups move as the same TSDAs one by one, by every method.

use dbd_plant::{DampingName, Method, Named as _, PrecisionName, SchemeName, plant};
use dbd_scene::Scene;

/// Two bodies, the first on two points of the ground or of its own, the second on one of the first.
fn text(grounded_tips: bool, damping: f64, name: impl Fn(usize) -> String) -> String {
    let (centres, tips) = (
        [[0.0, 0.0, 0.05], [0.0, 0.0, -0.05]],
        [[0.1, 0.0, 0.0], [-0.05, 0.08, 0.0], [-0.05, -0.08, 0.0]],
    );
    let mut legs: Vec<(&str, [[f64; 3]; 2])> = Vec::new();
    for (centre, tip) in centres.iter().flat_map(|centre| tips.map(|tip| (*centre, tip))) {
        let away = |point: [f64; 3]| [point[0] - 0.2, point[1], point[2]];
        legs.push(if grounded_tips {
            ("\"world\", \"arm\"", [tip, away(centre)])
        } else {
            ("\"world\", \"arm\"", [centre, away(tip)])
        });
    }
    let from = [0.2, 0.0, 0.0];
    legs.extend(tips.map(|[x, y, z]| ("\"arm\", \"hand\"", [from, [x, y, z + 0.04]])));
    let body = |name: &str, x: f64| {
        format!(
            "[[body]]\nname = \"{name}\"\nmass = 1\ninertia = [0.01, 0.02, 0.02]\nposition = [{x}, 0, 0]\n\
             angular_velocity = [0.1, -0.2, 0.5]\n"
        )
    };
    let mut text = format!(
        "name = \"legs\"\nduration = 1\ngravity = [0, -9.81, 0]\n{}{}",
        body("arm", 0.2),
        body("hand", 0.4)
    );
    for (row, (between, points)) in legs.iter().enumerate() {
        text += &format!(
            "[[tsda]]\n{}between = [{between}]\npoints = {points:?}\nstiffness = 1e4\nfree_length = 0.1\n\
             damping = {damping:?}\n",
            name(row)
        );
    }
    text
}

#[test]
fn a_list_moves_as_its_tsdas_one_by_one() {
    for (grounded_tips, damping) in [(false, 0.0), (false, 3.0), (true, 0.0), (true, 3.0)] {
        let scenes = [text(grounded_tips, damping, |_| String::new()), {
            text(grounded_tips, damping, |row| format!("name = \"leg {row}\"\n"))
        }];
        let scenes = scenes.map(|text| Scene::parse(&text, "legs.toml").unwrap());
        assert_eq!(scenes.each_ref().map(|scene| scene.model.groups.len()), [2, 9]);
        for method in methods() {
            let ends = scenes.each_ref().map(|scene| {
                let mut plant = plant(scene, &method, 2e-4).unwrap();
                plant.advance(100).unwrap_or_else(|failure| panic!("{method:?}: {failure:?}"));
                plant.state().bodies
            });
            let starts = &scenes[0].model.initial;
            for ((grouped, alone), start) in ends[0].iter().zip(&ends[1]).zip(starts) {
                let [apart, moved] =
                    [grouped.position - alone.position, grouped.position - start.position]
                        .map(|way| way.dot(way).sqrt());
                // Joint-wise damping knows the modes of a group, and damps single TSDAs by sweeps.
                let near = match (method.precision_name(), method.foreign_damping()) {
                    (_, Some(of))
                        if of.name() == DampingName::JointWise.name() && damping > 0.0 =>
                    {
                        2e-2
                    }
                    ("f64", _) => 1e-10,
                    ("fixed", _) => 1e-5,
                    _ => 1e-4,
                };
                assert!(moved > 1e-3 && apart < near * moved, "{method:?}: {apart:e} of {moved:e}");
            }
        }
    }
}

fn methods() -> impl Iterator<Item = Method> {
    PrecisionName::ALL.iter().flat_map(|precision| {
        SchemeName::ALL.iter().flat_map(|scheme| {
            let own = Method::new(*scheme, None, *precision).unwrap();
            let others =
                DampingName::ALL.iter().filter_map(move |name| own.with_damping(*name).ok());
            [own].into_iter().chain(others.filter(move |other| *other != own))
        })
    })
}
