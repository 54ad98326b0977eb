//! Masses of meshes. Figures are those of MuJoCo 4.0 for the same meshes.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use dbd_import::{ImportError, Kind, Options, import_text};

use crate::import::loaded;

/// An angle of two arms, 0.05 m thick: not convex, and its centre of area sees none of all its faces.
const PLAN: [[f32; 2]; 6] =
    [[0.0, 0.0], [0.6, 0.0], [0.6, 0.1], [0.1, 0.1], [0.1, 0.6], [0.0, 0.6]];
const TOP: [[usize; 3]; 4] = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]];

type Weight = (f64, [f64; 3], [f64; 3]);

/// Of the angle by each rule: mass, centre, moments.
const RULES: [(&str, Weight); 4] = [
    (
        "legacy",
        (
            8.728785356e+00,
            [1.968635446e-01, 1.968635446e-01, 2.500000037e-02],
            [1.010472788e-01, 3.618524396e-01, 4.598008553e-01],
        ),
    ),
    (
        "convex",
        (
            1.175000105e+01,
            [2.290780226e-01, 2.290780226e-01, 2.500000037e-02],
            [1.586196326e-01, 4.122396523e-01, 5.659634510e-01],
        ),
    ),
    (
        "exact",
        (
            5.500000395e+00,
            [1.863636429e-01, 1.863636429e-01, 2.500000037e-02],
            [7.618372362e-02, 2.807292102e-01, 3.546212669e-01],
        ),
    ),
    (
        "shell",
        (
            3.400000191e+02,
            [1.897058890e-01, 1.897058890e-01, 2.500000037e-02],
            [5.273775202e+00, 1.854583588e+01, 2.349461106e+01],
        ),
    ),
];
/// Of the angle mirrored.
const MIRRORED: Weight = (
    2.500000000e+00,
    [1.669785152e-01, -1.250486873e-01, 3.747009847e-02],
    [1.290528727e-02, 4.103426082e-01, 4.223640816e-01],
);

fn angle() -> (Vec<[f32; 3]>, Vec<[usize; 3]>) {
    let points = [0.0, 0.05].into_iter().flat_map(|z| PLAN.map(|[x, y]| [x, y, z])).collect();
    let mut faces: Vec<[usize; 3]> = TOP.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
    faces.extend(TOP.iter().map(|face| face.map(|corner| corner + 6)));
    for i in 0..6 {
        let j = (i + 1) % 6;
        faces.extend([[i, j, j + 6], [i, j + 6, i + 6]]);
    }
    (points, faces)
}

/// Writes the angle as binary STL, as STL in words, as OBJ beside another object.
fn write(folder: &Path) {
    let (points, faces) = angle();
    let mut binary = vec![b'x'; 80];
    binary.extend(u32::try_from(faces.len()).unwrap().to_le_bytes());
    let (mut words, mut obj) = (String::from("solid angle\n"), String::from("o angle\n"));
    for face in &faces {
        binary.extend([0; 12]);
        words.push_str("facet normal 0 0 0\nouter loop\n");
        for [x, y, z] in face.map(|corner| points[corner]) {
            binary.extend([x, y, z].into_iter().flat_map(f32::to_le_bytes));
            let _ = writeln!(words, "vertex {x} {y} {z}");
        }
        words.push_str("endloop\nendfacet\n");
        binary.extend([0; 2]);
    }
    words.push_str("endsolid angle\n");
    for [x, y, z] in &points {
        let _ = writeln!(obj, "v {x} {y} {z}");
    }
    for (number, face) in faces.iter().enumerate() {
        if number == 4 {
            obj.push_str("usemtl steel\n");
        }
        let _ = writeln!(obj, "f {} {} {}", face[0] + 1, face[1] + 1, face[2] + 1);
    }
    fs::write(folder.join("angle.stl"), binary).unwrap();
    fs::write(folder.join("words.stl"), words).unwrap();
    fs::write(folder.join("other.obj"), format!("{obj}o second\nf 1 2 3\n")).unwrap();
    fs::write(folder.join("angle.obj"), obj).unwrap();
}

fn text(mesh: &str, geom: &str) -> String {
    format!(
        "<mujoco>\n<compiler meshdir='meshes'/>\n<asset>\n<mesh name='m' {mesh}/>\n</asset>\n<worldbody>\
         <body name='b'><freejoint/>\n<geom type='mesh' mesh='m' {geom}/></body></worldbody></mujoco>"
    )
}

/// Mass, centre and moments of the body of a mesh.
fn weighed(folder: &Path, mesh: &str, geom: &str) -> Weight {
    let made = import_text(&text(mesh, geom), "test.xml", folder, &Options::default());
    let scene = loaded(&made.unwrap_or_else(|error| panic!("{mesh}: {error}")));
    let body = &scene.model.bodies[0];
    let mut moments = body.inertia.to_f64();
    moments.sort_by(f64::total_cmp);
    (body.mass, scene.model.initial[0].position.to_f64(), moments)
}

fn near(found: Weight, expected: Weight, what: &str) {
    let relative = |a: f64, b: f64| (a / b - 1.0).abs();
    let (mass, centre, moments) = found;
    assert!(relative(mass, expected.0) < 1e-6, "{what}: {mass}");
    for axis in 0..3 {
        assert!((centre[axis] - expected.1[axis]).abs() < 1e-6, "{what}: {centre:?}");
        assert!(relative(moments[axis], expected.2[axis]) < 1e-6, "{what}: {moments:?}");
    }
}

/// MuJoCo's four rules, from each kind of file and from numbers in the model.
#[test]
fn meshes_weigh_what_they_weigh_in_mujoco() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("meshes")).unwrap();
    write(&folder.path().join("meshes"));
    for file in ["angle.stl", "words.stl", "angle.obj", "other.obj"] {
        for (rule, expected) in RULES {
            let found = weighed(folder.path(), &format!("file='{file}' inertia='{rule}'"), "");
            near(found, expected, &format!("{file} {rule}"));
        }
    }
    let (points, faces) = angle();
    let numbers = |all: Vec<String>| all.join(" ");
    let vertex = numbers(points.iter().flatten().map(f32::to_string).collect());
    let face = numbers(faces.iter().flatten().map(usize::to_string).collect());
    let found = weighed(folder.path(), &format!("vertex='{vertex}' face='{face}'"), "");
    near(found, RULES[0].1, "numbers");
    // Without faces it is the hull, whatever the rule.
    let found = weighed(folder.path(), &format!("vertex='{vertex}' inertia='exact'"), "");
    near(found, RULES[1].1, "points");
    // Mirrored and turned, with a mass of its own.
    let mesh =
        "file='angle.stl' inertia='exact' scale='-0.5 2 1' refpos='.1 .2 .3' refquat='1 .2 .3 .4'";
    let found = weighed(folder.path(), mesh, "mass='2.5' pos='.1 .2 .3' euler='10 20 30'");
    near(found, MIRRORED, "mirrored");
}

/// The reason why a mesh has no mass, by the line of its geom.
fn refused(folder: &Path, mesh: &str) -> String {
    match import_text(&text(mesh, ""), "test.xml", folder, &Options::default()) {
        Err(ImportError::Refused(refusal)) => {
            assert_eq!(refusal.line, 7, "{refusal}");
            assert!(refusal.help.contains("saveinertial"), "{}", refusal.help);
            refusal.message.clone()
        }
        other => panic!("{mesh}: {other:?}"),
    }
}

#[test]
fn meshes_without_a_mass_are_refused_by_their_reason() {
    let outer = tempfile::tempdir().unwrap();
    let folder = outer.path().join("model");
    fs::create_dir_all(folder.join("meshes")).unwrap();
    write(&folder.join("meshes"));
    fs::write(outer.path().join("secret.stl"), "secret line").unwrap();
    fs::write(folder.join("meshes/part.msh"), "").unwrap();
    fs::write(folder.join("meshes/broken.stl"), "solid a\nfacet").unwrap();
    fs::write(folder.join("meshes/broken.obj"), "v 1 2\n").unwrap();
    let cube = "vertex='0 0 0 1 0 0 0 1 0 0 0 1'";
    for (mesh, why) in [
        ("file='none.stl'", "cannot read meshes/none.stl"),
        ("file='../../secret.stl'", "outside the model's folder"),
        ("file='part.msh'", "neither STL nor OBJ"),
        ("file='broken.stl'", "cannot read meshes/broken.stl"),
        ("file='broken.obj'", "cannot read meshes/broken.obj"),
        ("builtin='sphere'", "generated by MuJoCo"),
        ("vertex='0 0 0 1 0 0 0 1 0 1 1 0'", "span no volume"),
        (&format!("{cube} face='0 1 9'"), "refers to vertex 9"),
        (
            &format!("{cube} inertia='exact' face='0 1 2 0 1 3 1 2 3 0 3 2'"),
            "oriented inconsistently",
        ),
        (&format!("{cube} inertia='exact' face='0 1 2 0 3 1 0 2 3 1 3 2'"), "oriented inwards"),
    ] {
        let found = refused(&folder, mesh);
        assert!(found.contains(why) && !found.contains("secret line"), "{mesh}: {found}");
    }
    // Beside another mass it can be left out; with an <inertial> its file is not even looked for.
    let beside = text("file='none.stl'", "/><geom size='0.1' contype='0' conaffinity='0'");
    let ignored = vec![Kind::Mesh];
    let made =
        import_text(&beside, "test.xml", &folder, &Options { ignored, ..Options::default() });
    assert_eq!(made.unwrap().omitted.len(), 1);
    let inertial = "/><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'";
    let made =
        import_text(&text("file='none.stl'", inertial), "test.xml", &folder, &Options::default());
    assert!(made.unwrap().omitted.is_empty());
}
