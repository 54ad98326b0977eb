//! `host-sim new c`: a scene's plant as a static library for C, its header, and a program for the PC and the chip.
//!
//! `(name, scene) => folder`. The files are those of `templates/c/`.

use std::fmt::Write as _;
use std::path::PathBuf;

use dbd_plant::PrecisionName;
use dbd_scene::Scene;
use dbd_scene::export::{constant_name, constant_names};

use super::plant::Planted;
use super::{NewError, Place, PlantArguments};
use crate::commands::schema;
use crate::terminal::Found;

/// Files of a project and what they are made from.
const TEMPLATES: &[(&str, &str)] = &[
    ("Cargo.toml", include_str!("../../../templates/c/Cargo.toml.in")),
    ("build.rs", include_str!("../../../templates/c/build.rs.in")),
    ("src/lib.rs", include_str!("../../../templates/c/lib.rs.in")),
    ("example/main.c", include_str!("../../../templates/c/main.c.in")),
    ("example/pc.c", include_str!("../../../templates/c/pc.c.in")),
    ("example/board.c", include_str!("../../../templates/c/board.c.in")),
    ("example/board.ld", include_str!("../../../templates/c/board.ld.in")),
    ("Makefile", include_str!("../../../templates/c/Makefile.in")),
    ("README.md", include_str!("../../../templates/c/README.md.in")),
    (".gitignore", include_str!("../../../templates/c/gitignore.in")),
];

/// The header, whose file has the project's name.
const HEADER: &str = include_str!("../../../templates/c/header.h.in");

/// Writes a project for C and says what to type next.
///
/// # Errors
/// [`NewError`]; nothing is written then.
pub fn c(arguments: &PlantArguments, found: &Found) -> Result<String, NewError> {
    let place = Place::of(&arguments.name)?;
    let Planted { scene, choice, dependencies, golden, mut values, file } =
        Planted::of(&place, found, arguments)?;
    let prefix = place.name.replace('-', "_");
    let capitals = prefix.to_uppercase();
    let precision = choice.method.precision();
    let suffix = choice.method.precision_name().to_uppercase();
    let model = constant_name(&scene.name);
    let constants = scene
        .readouts
        .iter()
        .map(|readout| format!("model::{model}_READOUT_{}_{suffix}", constant_name(&readout.name)));
    values.extend([
        ("capitals", capitals.clone()),
        ("number", if precision == PrecisionName::F64 { "double" } else { "float" }.to_owned()),
        ("step", format!("{:?}", choice.step)),
        ("readout_count", scene.readouts.len().to_string()),
        ("readouts", constants.collect::<Vec<_>>().join(", ")),
        ("defines", defines(scene, &capitals)),
        ("hints", hints(scene, &prefix, &capitals)),
    ]);
    let header_file =
        (PathBuf::from(format!("include/{prefix}.h")), super::filled(HEADER, &values));
    let golden_file = (PathBuf::from("golden.txt"), golden);
    let schema_file = (PathBuf::from(format!("scenes/{}", schema::FILE)), schema::text());
    place.write(TEMPLATES, &values, vec![file, header_file, golden_file, schema_file])?;
    Ok(format!(
        "{0}: the scene {1} as a plant for C: {3}; {2}\n{4}\n  cd {0}\n  make test    golden bits on the PC\n  make \
         qemu    the same bits on a Cortex-M4F in QEMU; README.md says what to install\n  include/{5}.h    the \
         interface\n",
        place.folder.display(),
        scene.name,
        dependencies.origin,
        choice.words(),
        choice.reasons.iter().map(|reason| format!("  {reason}\n")).collect::<String>(),
        prefix,
    ))
}

/// The header's names of caller-set inputs, read-outs and bodies.
fn defines(scene: &Scene, capitals: &str) -> String {
    let mut text = String::new();
    let mut list = |what: &str, kind: &str, rows: Vec<(String, usize, String)>| {
        if !rows.is_empty() {
            let _ = writeln!(text, "/* {what}. */");
        }
        for (name, number, unit) in &rows {
            let unit = if unit.is_empty() { String::new() } else { format!(" /* {unit} */") };
            let _ = writeln!(text, "#define {capitals}_{kind}_{name} {number}u{unit}");
        }
        if !rows.is_empty() {
            text += "\n";
        }
    };
    // Equal names are numbered as the Rust constants are.
    let names = constant_names(scene.inputs.iter().map(|input| input.name.as_str()));
    let inputs = scene.inputs.iter().zip(names).filter(|(input, _)| !input.table);
    let inputs =
        inputs.map(|(input, name)| (name, usize::from(input.index.0), input.unit.to_owned()));
    list("Inputs, with their units", "INPUT", inputs.collect());
    let names = constant_names(scene.readouts.iter().map(|readout| readout.name.as_str()));
    let readouts = scene.readouts.iter().zip(names).enumerate().map(|(row, (readout, name))| {
        let column = |(part, unit): &(&str, &str)| format!("{part} {unit}").trim().to_owned();
        let columns: Vec<String> = readout.columns.iter().map(column).collect();
        (name, row, columns.join(", "))
    });
    list("Read-outs, with their units", "READOUT", readouts.collect());
    let names = constant_names(scene.body_names.iter().map(String::as_str));
    let bodies = names.into_iter().enumerate().map(|(row, name)| (name, row, String::new()));
    list("Bodies", "BODY", bodies.collect());
    text
}

/// Calls of a controller, for the scene's first read-out and input.
fn hints(scene: &Scene, prefix: &str, capitals: &str) -> String {
    let readout = scene.readouts.first().map(|readout| {
        format!(
            "{prefix}_number values[{capitals}_MOST_VALUES];\n       {prefix}_read({capitals}_READOUT_{}, values);",
            constant_name(&readout.name)
        )
    });
    let names = constant_names(scene.inputs.iter().map(|input| input.name.as_str()));
    let mut inputs = scene.inputs.iter().zip(names).filter(|(input, _)| !input.table);
    let input =
        inputs.next().map(|(_, name)| format!("{prefix}_set_input({capitals}_INPUT_{name}, 0);"));
    let calls: Vec<String> = readout.into_iter().chain(input).collect();
    if calls.is_empty() {
        return String::new();
    }
    format!("    /* {} */\n", calls.join("\n       "))
}

#[cfg(test)]
mod tests {
    use super::super::DependencyOptions;
    use super::super::choice::ChoiceOptions;
    use super::*;

    /// Two names that are equal in C are distinguished, as in Rust.
    #[test]
    fn names_that_would_be_one_get_numbers() {
        let body = |name: &str| {
            format!(
                "[[body]]\nname = \"{name}\"\nmass = 1\ninertia = [1, 1, 1]\nposition = [0, 0, 0]\n"
            )
        };
        let readout = |name: &str| {
            format!("[[readout]]\nname = \"{name}\"\ntype = \"point\"\nbody = \"a-b\"\n")
        };
        let parts = [body("a b"), body("a-b"), readout("p q"), readout("p-q")].concat();
        let scene =
            Scene::parse(&format!("name = \"s\"\nduration = 1\n{parts}"), "s.toml").unwrap();
        let text = defines(&scene, "S");
        for line in ["S_BODY_A_B 0u", "S_BODY_A_B_2 1u", "S_READOUT_P_Q 0u", "S_READOUT_P_Q_2 1u"] {
            assert!(text.contains(&format!("#define {line}")), "{line}: {text}");
        }
    }

    /// All placeholders are filled, and none is unknown.
    #[test]
    fn every_name_in_a_template_is_known() {
        let here = tempfile::tempdir().unwrap();
        let name = here.path().join("my-plant");
        let found = crate::terminal::Catalogue::default().load("cart-pendulum").unwrap();
        let dependencies = DependencyOptions { registry: true, ..DependencyOptions::default() };
        let (choice, scene) = (ChoiceOptions::default(), "cart-pendulum".to_owned());
        c(&PlantArguments { name: name.clone(), scene, dependencies, choice }, &found).unwrap();
        let header = std::fs::read_to_string(name.join("include/my_plant.h")).unwrap();
        assert!(header.contains("#define MY_PLANT_INPUT_DRIVE 0u /* N */"), "{header}");
        let files = TEMPLATES.iter().map(|(path, _)| *path).chain(["include/my_plant.h"]);
        for path in files {
            let text = std::fs::read_to_string(name.join(path)).unwrap();
            assert!(!text.contains("{{"), "{path}: {text}");
        }
    }
}
