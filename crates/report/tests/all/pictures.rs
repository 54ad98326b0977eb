//! Pictures of every scene that ships and of odd ones: well-formed, within their paper, names apart,
//! the same bytes each time. `DBD_DRAW=folder` leaves them there to look at.

use std::fmt::Write as _;
use std::path::Path;

use dbd_report::picture::{Mechanism, Paper, svg};
use dbd_scene::Scene;
use roxmltree::{Document, Node};

fn shipped() -> Vec<Scene> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut files: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path()).collect();
    files.sort();
    assert!(files.len() > 20);
    files.iter().map(|file| Scene::load(file).unwrap()).collect()
}

fn drawn(scene: &Scene) -> String {
    let text = svg(&Mechanism::of(scene), Paper::File);
    if let Ok(folder) = std::env::var("DBD_DRAW") {
        std::fs::write(format!("{folder}/{}.svg", scene.name), &text).unwrap();
    }
    text
}

/// Left, top, right, bottom of a text's box, as wide as its letters are at most.
fn room(text: &Node<'_, '_>) -> [f64; 4] {
    let number = |name| text.attribute(name).unwrap().parse::<f64>().unwrap();
    let (x, y) = (number("x"), number("y"));
    let wide = |c: char| if c >= '\u{1100}' { 17.0 } else { 9.0 };
    let width: f64 = text.text().unwrap().chars().map(wide).sum();
    let left = match text.attribute("text-anchor") {
        Some("middle") => x - 0.5 * width,
        Some("end") => x - width,
        _ => x,
    };
    [left, y - 12.0, left + width, y + 4.0]
}

/// What holds of every picture.
fn is_sound(scene: &str, text: &str) {
    let document = Document::parse(text).unwrap_or_else(|error| panic!("{scene}: {error}"));
    for word in ["NaN", "inf", "-0 "] {
        let body = text.split("</style>").nth(1).unwrap();
        assert!(!body.contains(word), "{scene}: {word}");
    }
    let root = document.root_element();
    let [width, height] =
        ["width", "height"].map(|name| root.attribute(name).unwrap().parse::<f64>().unwrap());
    assert_eq!(root.attribute("viewBox").unwrap(), format!("0 0 {width} {height}"));
    let inside = |x: f64, y: f64| {
        assert!((0.0..=width).contains(&x) && (0.0..=height).contains(&y), "{scene}: {x} {y}");
    };
    for node in document.descendants().filter(Node::is_element) {
        if let Some(data) = node.attribute("d") {
            let absolute = data.split('h').next().unwrap();
            if data.contains('A') {
                continue;
            }
            let numbers = absolute.split(|c: char| !(c.is_ascii_digit() || "-.".contains(c)));
            let numbers: Vec<f64> =
                numbers.filter(|word| !word.is_empty()).map(|word| word.parse().unwrap()).collect();
            numbers.chunks_exact(2).for_each(|pair| inside(pair[0], pair[1]));
        }
        if let Some(x) = node.attribute("cx") {
            inside(x.parse().unwrap(), node.attribute("cy").unwrap().parse().unwrap());
        }
    }
    let texts: Vec<_> = document.descendants().filter(|node| node.has_tag_name("text")).collect();
    let boxes: Vec<_> = texts.iter().map(room).collect();
    for (i, [left, top, right, bottom]) in boxes.iter().enumerate() {
        inside(*left, *top);
        inside(*right, *bottom);
        for (j, other) in boxes[..i].iter().enumerate() {
            let apart =
                *left >= other[2] || other[0] >= *right || *top >= other[3] || other[1] >= *bottom;
            assert!(apart, "{scene}: {:?} on {:?}", texts[i].text(), texts[j].text());
        }
    }
}

#[test]
fn every_scene_that_ships_has_a_sound_picture() {
    let drawings: Vec<_> = shipped().into_iter().map(|scene| (drawn(&scene), scene)).collect();
    for (text, scene) in drawings {
        is_sound(&scene.name, &text);
        assert!(text.len() < 300_000, "{}: {} bytes", scene.name, text.len());
        assert_eq!(text, svg(&Mechanism::of(&scene), Paper::File), "{}", scene.name);
    }
}

/// A scene of no gravity, of these tables.
fn scene(tables: &str) -> Scene {
    let text = format!("name = \"odd\"\nduration = 1\n{tables}");
    Scene::parse(&text, "odd.toml").unwrap_or_else(|error| panic!("{error}: {text}"))
}

/// A body of 1 kg.
fn body(name: &str, position: [f64; 3]) -> String {
    format!(
        "[[body]]\nname = {name:?}\nmass = 1\ninertia = [0.1, 0.1, 0.1]\nposition = {position:?}\n"
    )
}

fn joint(kind: &str, between: [&str; 2], at: [f64; 3], keys: &str) -> String {
    format!(
        "[[joint]]\nname = \"{kind} of {}\"\ntype = \"{kind}\"\nbetween = {between:?}\nat = {at:?}\n\
         stiffness = 1e5\n{keys}\n",
        between[1]
    )
}

#[test]
fn odd_mechanisms_have_sound_pictures() {
    let hinge =
        |between: [&str; 2], at| joint("revolute", between, at, "axis = [0, 0, 1]\nspan = 0.1");
    let ball = |between: [&str; 2], at| joint("spherical", between, at, "arm = 0.1");
    let far = 1e6;
    let chain: String = (0..6)
        .map(|n| {
            let (name, x) = (format!("link {n}"), f64::from(n));
            let at = [x, (0.7 * x).sin(), (1.3 * x).cos()];
            let before = if n == 0 { "world".into() } else { format!("link {}", n - 1) };
            body(&name, [x + 0.5, at[1], at[2]]) + &ball([&before, &name], at)
        })
        .collect();
    let line = |between: [&str; 2], point: [f64; 3], direction: [f64; 3]| {
        format!(
            "[[point_on_line]]\nbetween = {between:?}\nline_point = {point:?}\nline_direction = {direction:?}\n\
             point = [0, 0, 0]\nstiffness = 1\nfree_length = 0\n"
        )
    };
    let odd = [
        (
            "lines far from what they guide",
            body("door", [0.6, 0.0, 0.0])
                + &hinge(["world", "door"], [0.0; 3])
                + &line(["world", "door"], [0.81, 5.0, 0.0], [0.0, 0.0, 1.0])
                + &line(["world", "door"], [-3.0, 0.0, 0.0], [0.0, 1.0, 0.0])
                + &line(["door", "world"], [0.0, 0.0, 4.0], [1.0, 0.0, 0.0]),
        ),
        (
            "shapes larger than all else",
            ["type = \"sphere\", diameter = 9", "type = \"cylinder\", length = 8, diameter = 0.1", "type = \"box\", length = 0.1, section = [7, 0.2]"]
                .iter()
                .enumerate()
                .map(|(n, shape)| {
                    let name = format!("b{n}");
                    format!("[[body]]\nname = {name:?}\nmass = 1\nshape = {{ {shape} }}\nposition = [{n}, 0, 0]\norientation = {{ axis = [1, 1, {n}], angle = 0.7 }}\n")
                        + &hinge(["world", &name], [n as f64, 0.1, 0.0])
                })
                .collect(),
        ),
        (
            "a load on a long arm, a spring without a joint",
            body("a", [0.0; 3])
                + &body("b", [0.3, 0.0, 0.0])
                + "[[torsion_spring]]\nbetween = [\"world\", \"b\"]\naxis = [0, 0, 1]\nstiffness = 1\n\
                   [[input]]\nname = \"push\"\ntype = \"force\"\nbody = \"b\"\npoint = [0, 40, 0]\naxis = [0, 1, 0]\n",
        ),
        ("one body, nothing else", body("stone", [0.0; 3])),
        ("one body on a hinge at its centre", body("disc", [0.0; 3]) + &hinge(["world", "disc"], [0.0; 3])),
        (
            "all in one point",
            body("a", [1.0; 3])
                + &body("b", [1.0; 3])
                + &hinge(["world", "a"], [1.0; 3])
                + &ball(["a", "b"], [1.0; 3]),
        ),
        (
            "far from the origin",
            body("a", [far + 0.5, far, -far])
                + &body("b", [far + 1.5, far, -far])
                + &hinge(["world", "a"], [far, far, -far])
                + &hinge(["a", "b"], [far + 1.0, far, -far]),
        ),
        ("a chain in space", chain),
        ("bodies without any joint", (0..4).map(|n| body(&format!("b{n}"), [f64::from(n), 0.0, 0.0])).collect()),
        ("tiny", body("a", [1e-9, 0.0, 0.0]) + &joint("spherical", ["world", "a"], [0.0; 3], "arm = 1e-10")),
        ("huge", body("a", [1e12, 0.0, 0.0]) + &joint("spherical", ["world", "a"], [0.0; 3], "arm = 1e11")),
        (
            "numbers at their ends",
            [1e-300, 1e-160, 1e160, 1e300]
                .iter()
                .enumerate()
                .map(|(n, size)| {
                    let at = [1e149 * n as f64, -1e149, 1e-149];
                    body(&format!("body {n}"), at)
                        .replace("mass = 1", &format!("mass = {size:e}"))
                        .replace("0.1, 0.1, 0.1", &format!("{size:e}, {size:e}, {size:e}"))
                })
                .collect(),
        ),
        (
            "all types of joint",
            [
                ("fixed", "axis = [0, 1, 1]\nspan = 0.1\narm = 0.1"),
                ("translational", "axis = [1, 0, 1]\nspan = 0.1\ngauge = 0.1\noffset = 0.05"),
                ("cylindrical", "axis = [0, 1, 0]\nspan = 0.1\noffset = 0.05"),
                ("universal", "axes = [[1, 0, 0], [0, 1, 0]]\nspan = 0.1\nspider = { mass = 1, inertia = [1, 1, 1] }"),
            ]
            .iter()
            .enumerate()
            .map(|(n, (kind, keys))| {
                let x = n as f64;
                let name = format!("body {n}");
                body(&name, [x, 0.5, 0.2 * x]) + &joint(kind, ["world", &name], [x, 0.0, 0.0], keys)
            })
            .collect(),
        ),
        (
            "all elements, loads and inputs",
            body("a", [0.0, -1.0, 0.0])
                + &body("b", [1.0, -1.0, 0.3])
                + "[[tsda]]\nname = \"spring\"\nbetween = [\"world\", \"a\"]\npoints = [[0, 0, 0], [0, 0.2, 0]]\n\
                   stiffness = 1\nfree_length = 1\n\
                   [[tsda]]\nbetween = [\"a\", \"b\"]\npoints = [[0.5, 0, 0], [-0.5, 0, 0]]\nstiffness = 1\n\
                   free_length = 0\n\
                   [[point_on_line]]\nbetween = [\"world\", \"b\"]\nline_point = [0, -1, 0.3]\n\
                   line_direction = [1, 0, 0]\npoint = [0.2, 0, 0]\nstiffness = 1\nfree_length = 0\n\
                   [[torsion_spring]]\nbetween = [\"a\", \"b\"]\naxis = [0, 0, 1]\nstiffness = 1\n\
                   [[load]]\nbody = \"a\"\nforce = [0, 0, 1]\ntorque = [1, 0, 0]\n\
                   [[input]]\nname = \"pull\"\ntype = \"actuator\"\ntarget = \"spring\"\n\
                   [[input]]\nname = \"push\"\ntype = \"force\"\nbody = \"b\"\naxis = [0, 1, 0]\n\
                   [[input]]\nname = \"shake\"\ntype = \"anchor\"\ntarget = \"spring\"\naxis = [1, 0, 0]\n",
        ),
    ];
    for (what, tables) in odd {
        let scene = scene(&tables);
        let mechanism = Mechanism::of(&scene);
        for paper in [Paper::File, Paper::Page] {
            is_sound(what, &svg(&mechanism, paper));
        }
        if let Ok(folder) = std::env::var("DBD_DRAW") {
            std::fs::write(format!("{folder}/odd {what}.svg"), svg(&mechanism, Paper::File))
                .unwrap();
        }
    }
}

#[test]
fn names_are_escaped_and_long_ones_shortened() {
    let long = "<a> & \"quoted\" 'name' that nobody would write on a drawing, 梁の長い名前";
    let scene = scene(&body(long, [0.0; 3]));
    let text = svg(&Mechanism::of(&scene), Paper::File);
    is_sound("escaped", &text);
    let document = Document::parse(&text).unwrap();
    let titles: Vec<_> = document.descendants().filter(|node| node.has_tag_name("title")).collect();
    assert!(titles.iter().any(|title| title.text() == Some(&format!("{long}, 1 kg"))));
    let labels = document.descendants().filter(|node| node.has_tag_name("text"));
    let label = labels.filter_map(|node| node.text()).find(|text| text.contains('…')).unwrap();
    assert!(label.starts_with("<a> &") && label.ends_with("名前") && label.chars().count() < 24);
}

/// Universal joints are crosses: their spiders are neither drawn nor named.
#[test]
fn spiders_are_no_bodies_of_a_picture() {
    let scene = shipped().into_iter().find(|scene| scene.name == "3ruu").unwrap();
    let text = drawn(&scene);
    assert_eq!(scene.model.bodies.len(), 13);
    assert!(!text.contains("spider"));
    let document = Document::parse(&text).unwrap();
    let bars = |node: &Node<'_, '_>| {
        node.attribute("class").is_some_and(|c| c.starts_with("bar ") || c.starts_with("plate "))
    };
    let main = document.descendants().find(|node| node.has_tag_name("g")).unwrap();
    assert_eq!(main.descendants().filter(bars).count(), 7);
}

#[test]
fn ten_thousand_bodies_fit_into_a_small_file_that_says_what_is_left_out() {
    let mut tables = String::new();
    for n in 0..10_000 {
        let (x, y) = (f64::from(n % 100), f64::from(n / 100));
        tables += &body(&format!("b{n}"), [x + 0.4, y, 0.001 * x * y]);
        if n < 4000 {
            let (a, b) = (format!("b{n}"), format!("b{}", n + 1));
            tables += &joint("spherical", [&a, &b], [x + 0.9, y, 0.001 * x * y], "arm = 0.05");
        } else {
            let _ = write!(
                tables,
                "[[tsda]]\nbetween = [\"world\", \"b{n}\"]\npoints = [[{x}, {y}, 0], [0, 0, 0]]\n\
                 stiffness = 1\nfree_length = 1\n"
            );
        }
    }
    let scene = scene(&tables);
    let text = svg(&Mechanism::of(&scene), Paper::File);
    is_sound("ten thousand", &text);
    assert!(text.len() < 500_000, "{}", text.len());
    for words in
        ["2000 of 10000 bodies", "2000 of 4000 joints", "2000 of 6000 TSDAs", "Omitted: names"]
    {
        assert!(text.contains(words), "{words}");
    }
}

/// Numbers from a seed (Knuth's linear congruence), for mechanisms that nobody would think of.
struct Dice(u64);

impl Dice {
    fn below(&mut self, count: u64) -> u64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % count
    }

    /// From −1 to 1, of few values, so that points coincide.
    fn share(&mut self) -> f64 {
        self.below(9) as f64 / 4.0 - 1.0
    }

    fn point(&mut self, scale: f64) -> [f64; 3] {
        [self.share() * scale, self.share() * scale, self.share() * scale]
    }
}

#[test]
fn any_mechanism_has_a_sound_picture() {
    for seed in 0..60 {
        let mut dice = Dice(seed);
        let scale = [1e-6, 1e-2, 1.0, 1e4][dice.below(4) as usize];
        let count = 1 + dice.below(9);
        let gravity = dice.point(9.81);
        let mut tables = format!("gravity = {gravity:?}\n");
        for n in 0..count {
            let turn = dice.share();
            let name = format!(
                "{} {n}",
                ["a", "a rather long name of a body", "梁"][dice.below(3) as usize]
            );
            tables += &body(&name, dice.point(scale)).replace(
                "[[body]]",
                &format!("[[body]]\norientation = {{ axis = [1, 2, -1], angle = {turn} }}"),
            );
            for _ in 0..dice.below(3) {
                let size = 0.1 * scale;
                let (kind, keys) = match dice.below(6) {
                    0 => ("spherical", format!("arm = {size:?}")),
                    1 => ("revolute", format!("axis = [0, 0, 1]\nspan = {size:?}")),
                    2 => ("fixed", format!("axis = [0, 1, 1]\nspan = {size:?}\narm = {size:?}")),
                    3 => (
                        "cylindrical",
                        format!("axis = [1, 0, 0]\nspan = {size:?}\noffset = {size:?}"),
                    ),
                    4 => (
                        "translational",
                        format!(
                            "axis = [0, 1, 0]\nspan = {size:?}\ngauge = {size:?}\noffset = {size:?}"
                        ),
                    ),
                    _ => (
                        "universal",
                        format!(
                            "axes = [[1, 0, 0], [0, 1, 0]]\nspan = {size:?}\n\
                             spider = {{ mass = 1, inertia = [1, 1, 1] }}"
                        ),
                    ),
                };
                let number = tables.len();
                tables += &joint(kind, ["world", &name], dice.point(scale), &keys)
                    .replace("name = \"", &format!("name = \"{number} "));
            }
            let axis = [[1, 0, 0], [0, 1, 0], [0, 0, 1]][dice.below(3) as usize];
            let _ = write!(
                tables,
                "[[tsda]]\nbetween = [\"world\", {name:?}]\npoints = [{:?}, {:?}]\nstiffness = 1\nfree_length = 0\n\
                 [[torsion_spring]]\nbetween = [\"world\", {name:?}]\naxis = {axis:?}\nstiffness = 1\n\
                 [[input]]\nname = \"input {n}\"\ntype = \"torque\"\nbody = {name:?}\naxis = {axis:?}\n",
                dice.point(scale),
                dice.point(scale),
            );
        }
        let scene = scene(&tables);
        let text = svg(&Mechanism::of(&scene), Paper::File);
        is_sound(&format!("seed {seed}"), &text);
    }
}
