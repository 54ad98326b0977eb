//! Pictures of every scene that ships and of odd ones: well-formed, within their paper, names apart,
//! the same bytes each time. `DBD_DRAW=folder` leaves them there to look at.

use std::path::Path;

use dbd_picture::{Mechanism, Paper, svg};
use dbd_scene::Scene;
use roxmltree::{Document, Node};

fn shipped() -> Vec<Scene> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
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
    let wide = |c: char| if c >= '\u{1100}' { 15.0 } else { 8.0 };
    let width: f64 = text.text().unwrap().chars().map(wide).sum();
    let left = match text.attribute("text-anchor") {
        Some("middle") => x - 0.5 * width,
        Some("end") => x - width,
        _ => x,
    };
    [left, y - 11.0, left + width, y + 3.0]
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
