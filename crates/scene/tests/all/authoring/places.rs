//! Where points and links lie.

use dbd_kernel::Vec3;
use dbd_scene::Scene;

/// A body of each of these places, with these keys before.
fn scene(before: &str, places: &[&str]) -> Scene {
    let mut text = format!("name = \"s\"\nduration = 1\n{before}\n");
    for (i, place) in places.iter().enumerate() {
        text += &format!("[[body]]\nname = \"b{i}\"\nmass = 1\ninertia = [1, 1, 1]\n{place}\n");
    }
    Scene::parse(&text, "s").unwrap_or_else(|error| panic!("{error}: {}\n{text}", error.help()))
}

/// Where a point lies that stands on O, X, Y, P, at (0, 0, 0), (2, 0, 0), (0, 3, 0), (1, 2, 3).
fn place(point: &str) -> [f64; 3] {
    let points = format!(
        "[points]\nO = [0, 0, 0]\nX = [2, 0, 0]\nY = [0, 3, 0]\nP = [1, 2, 3]\nQ = {point}"
    );
    scene(&points, &["position = \"Q\""]).model.initial[0].position.to_f64()
}

#[test]
fn each_form_of_a_point_lies_where_it_says() {
    let half = 3.0_f64.sqrt() / 2.0;
    for (point, expected) in [
        ("[4, 5, 6]", [4.0, 5.0, 6.0]),
        ("\"P\"", [1.0, 2.0, 3.0]),
        ("{ from = \"P\", offset = [1, -1, 0.5] }", [2.0, 1.0, 3.5]),
        ("{ from = [1, 1, 1], offset = [1, 0, 0] }", [2.0, 1.0, 1.0]),
        ("{ from = \"P\", distance = 10, direction = [0, 3, -4] }", [1.0, 8.0, -5.0]),
        ("{ from = \"Y\", distance = -1, direction = [2, 0, 0] }", [-1.0, 3.0, 0.0]),
        ("{ from = \"X\", distance = 6, toward = \"O\" }", [-4.0, 0.0, 0.0]),
        // 90 and 60 degrees, in radians as a program prints them.
        ("{ from = \"P\", distance = 2, angle = 1.5707963267948966 }", [1.0, 4.0, 3.0]),
        ("{ from = \"O\", distance = 1, angle = 1.0471975511965976 }", [0.5, half, 0.0]),
        ("{ from = \"O\", distance = 1, angle = -2.0943951023931953 }", [-0.5, -half, 0.0]),
        // About y the least aligned axis is x; the next one is −z.
        (
            "{ from = \"O\", distance = 2, angle = 1.5707963267948966, normal = [0, 5, 0] }",
            [0.0, 0.0, -2.0],
        ),
        (
            "{ from = \"O\", distance = 2, angle = 0, normal = [0, 5, 0], reference = [0, 1, 1] }",
            [0.0, 0.0, 2.0],
        ),
        ("{ from = [\"O\", \"P\"], share = 0.5 }", [0.5, 1.0, 1.5]),
        ("{ from = [\"P\", [1, 2, 5]], share = -1 }", [1.0, 2.0, 1.0]),
        ("{ from = [\"O\", [5, 0, 0]], distances = [3, 4], side = \"left\" }", [1.8, 2.4, 0.0]),
        ("{ from = [\"O\", [5, 0, 0]], distances = [3, 4], side = \"right\" }", [1.8, -2.4, 0.0]),
        // Seen against y, left of the x axis is −z.
        (
            "{ from = [\"O\", [5, 0, 0]], distances = [3, 4], side = \"left\", normal = [0, 1, 0] }",
            [1.8, 0.0, -2.4],
        ),
        // They touch: 0.7 + 0.1 is below 0.8 by a rounding.
        (
            "{ from = [\"O\", [0.8, 0, 0]], distances = [0.7, 0.1], side = \"left\" }",
            [0.7, 0.0, 0.0],
        ),
        ("{ from = \"X\", axis = [0, 0, 3], angle = 1.5707963267948966 }", [0.0, 2.0, 0.0]),
        (
            "{ from = \"X\", about = \"P\", axis = [0, 0, -1], angle = 3.141592653589793 }",
            [0.0, 4.0, 0.0],
        ),
        ("{ frame = [\"Y\", [0, 4, 0], [-1, 3, 7]], at = [1, 0, 0] }", [0.0, 4.0, 0.0]),
        (
            "{ frame = [\"Y\", [0, 4, 0], \"O2\"], at = [1, 2, 3] }\nO2 = [-5, 9, 0]",
            [-2.0, 4.0, 3.0],
        ),
        ("{ frame = \"world\", at = [1, 2, 3] }", [1.0, 2.0, 3.0]),
    ] {
        let place = place(point);
        for (p, e) in place.into_iter().zip(expected) {
            // One rounding: not a unit in the last place off what is exact here.
            assert!((p - e).abs() <= 1e-16 * e.abs().max(0.1), "{point}: {place:?}");
        }
    }
}

/// Points and bodies may stand on what is further below in the file, and on each other.
#[test]
fn places_may_stand_on_what_comes_later() {
    let points = "[points]\nA = { from = \"B\", offset = [1, 0, 0] }\nB = { from = \"C\", offset = [1, 0, 0] }\n\
                  C = { frame = \"b1\", at = [0, 1, 0] }\nD = [0, 0, 5]";
    let turned = "orientation = { axis = [0, 0, 1], angle = 1.5707963267948966 }";
    let scene = scene(points, &["position = \"A\"", &format!("position = \"D\"\n{turned}")]);
    let [a, d] = [0, 1].map(|row| scene.model.initial[row].position.to_f64());
    assert_eq!(d, [0.0, 0.0, 5.0]);
    // The body's y is the world's −x.
    for (p, e) in a.into_iter().zip([1.0, 0.0, 5.0]) {
        assert!((p - e).abs() < 1e-15, "{a:?}");
    }
}

/// A chain of points, each on the next: no stack grows with it.
#[test]
fn a_long_chain_of_points_is_followed() {
    let mut points = "[points]\n".to_owned();
    for i in 0..20_000 {
        points += &format!("p{i} = {{ from = \"p{}\", offset = [0.5, 0, 0] }}\n", i + 1);
    }
    points += "p20000 = [0, 0, 0]";
    let scene = scene(&points, &["position = \"p0\""]);
    assert_eq!(scene.model.initial[0].position.to_f64(), [10_000.0, 0.0, 0.0]);
}

/// The axes of a body, world.
fn axes(scene: &Scene) -> [Vec3<f64>; 3] {
    let rotation = scene.model.initial[0].orientation.rotation();
    Vec3::axes().map(|axis| rotation.to_world(axis))
}

fn near(a: Vec3<f64>, b: [f64; 3]) -> bool {
    let d = a - Vec3::from_f64(b);
    d.dot(d) < 1e-30
}

#[test]
fn a_link_lies_between_its_points() {
    for (i, along) in ["x", "y", "z"].into_iter().enumerate() {
        for to in
            [[4.0, 0.0, 0.0], [-4.0, 0.0, 0.0], [1.0, -3.0, 2.0], [0.0, 2.0, 0.0], [0.0, 0.0, -1.0]]
        {
            let points =
                format!("points = {{ A = [1, 1, 1], B = {{ from = \"A\", offset = {to:?} }} }}");
            let link = format!(
                "link = {{ from = \"A\", to = \"B\", along = \"{along}\", centre = 0.25 }}"
            );
            let scene = scene(&points, &[&link]);
            let expected = to.map(|c| 1.0 + 0.25 * c);
            assert_eq!(scene.model.initial[0].position.to_f64(), expected);
            let length = to.iter().map(|c| c * c).sum::<f64>().sqrt();
            let axes = axes(&scene);
            assert!(near(axes[i], to.map(|c| c / length)), "{along} {to:?}: {axes:?}");
            // The shortest turn: an axis across both stays.
            let along = Vec3::<f64>::axes()[i];
            let across = along.cross(Vec3::from_f64(to));
            if across.dot(across) > 0.0 {
                let unturned = scene.model.initial[0].orientation.rotation().to_world(across);
                let moved = unturned - across;
                assert!(moved.dot(moved) < 1e-28 * across.dot(across), "{along:?} {to:?}");
            }
        }
    }
}

/// Half a turn has no shortest way: about z, of the body's z axis about x.
#[test]
fn a_link_against_its_axis_turns_about_z() {
    for (along, to, about) in
        [("x", "[-1, 0, 0]", 2), ("y", "[0, -1, 0]", 2), ("z", "[0, 0, -1]", 0)]
    {
        let link = format!("link = {{ from = [0, 0, 0], to = {to}, along = \"{along}\" }}");
        let axes = axes(&scene("", &[&link]));
        let expected = Vec3::<f64>::axes()[about].to_f64();
        assert!(near(axes[about], expected), "{along}: {axes:?}");
    }
}

#[test]
fn a_reference_turns_a_link_about_itself() {
    for (i, along) in ["x", "y", "z"].into_iter().enumerate() {
        let link = format!(
            "link = {{ from = [0, 0, 0], to = [0, 0, 2], along = \"{along}\", reference = [0, 5, 5] }}"
        );
        let axes = axes(&scene("", &[&link]));
        assert!(near(axes[i], [0.0, 0.0, 1.0]), "{along}: {axes:?}");
        assert!(near(axes[(i + 1) % 3], [0.0, 1.0, 0.0]), "{along}: {axes:?}");
        assert!(near(axes[(i + 2) % 3], [-1.0, 0.0, 0.0]), "{along}: {axes:?}");
    }
}

/// A name stands for a point wherever a place does, in the body's axes where they are wanted.
#[test]
fn a_name_stands_wherever_a_place_does() {
    let rest = |a: &str, b: &str| {
        format!(
            "points = {{ A = [1, 0, 0], B = [1, 2, 0] }}\n[[body]]\nname = \"bar\"\nmass = 1\n\
             inertia = [1, 1, 1]\nlink = {{ from = \"A\", to = \"B\" }}\n\
             [[tsda]]\nbetween = [\"world\", \"bar\"]\npoints = [{a}, {b}]\nstiffness = 1\nfree_length = 1\n\
             [[point_on_line]]\nbetween = [\"world\", \"bar\"]\nline_point = {a}\nline_direction = [0, 0, 1]\n\
             point = {b}\nstiffness = 1\nfree_length = 0\n\
             [[input]]\nname = \"push\"\ntype = \"force\"\nbody = \"bar\"\npoint = {b}\naxis = [1, 0, 0]\n\
             [[readout]]\nname = \"tip\"\ntype = \"point\"\nbody = \"bar\"\npoint = {b}\n"
        )
    };
    let read = |text: &str| {
        let text = format!("name = \"s\"\nduration = 1\n{text}");
        Scene::parse(&text, "s").unwrap_or_else(|error| panic!("{error}: {}", error.help()))
    };
    let named = read(&rest("\"A\"", "\"B\""));
    let numbers = read(&rest("[1, 0, 0]", "[1, 0, 0]"));
    assert_eq!(named.model, numbers.model);
    assert_eq!(named.readouts, numbers.readouts);
}

/// Numbers or two points, for a joint, the two axes of a universal one and a torsion spring: the same model.
#[test]
fn two_points_are_a_direction() {
    let model = |axes: [&str; 5]| {
        let [revolute, reference, one, other, spring] = axes;
        let joints = format!(
            "points = {{ A = [1, 1, 0], B = [1, 1, 2], C = [5, 1, 0], D = [1, 4, 0] }}\n\
             defaults.joint = {{ stiffness = 1e5, span = 0.1, spider = {{ mass = 1, inertia = [1, 1, 1] }} }}\n\
             joint = [{{ name = \"r\", type = \"revolute\", between = [\"world\", \"b0\"], at = \"A\", axis = {revolute}, \
             reference = {reference} }},\n\
             {{ name = \"u\", type = \"universal\", between = [\"b0\", \"b1\"], at = \"B\", axes = [{one}, {other}] }}]\n\
             torsion_spring = [{{ between = [\"world\", \"b0\"], axis = {spring}, stiffness = 10 }}]"
        );
        scene(&joints, &["position = \"A\"", "position = \"B\""]).model
    };
    let named =
        ["[\"A\", \"B\"]", "[\"A\", \"C\"]", "[\"C\", \"A\"]", "[\"A\", \"D\"]", "[\"B\", \"A\"]"];
    let numbers = ["[0, 0, 1]", "[1, 0, 0]", "[-1, 0, 0]", "[0, 3, 0]", "[0, 0, -5]"];
    assert_eq!(model(named), model(numbers));
    assert_ne!(model(named), model(["[1, 0, 1]", numbers[1], numbers[2], numbers[3], numbers[4]]));
}
