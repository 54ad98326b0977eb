//! `host-sim new firmware`: a project with a plant in firmware, which builds and runs as it is.
//!
//! `(name, scene) => folder`. The files are those of `templates/firmware/`.

use std::path::PathBuf;

use clap::Args;
use dbd_plant::digits::significant;
use dbd_plant::time::rounded;
use dbd_scene::Scene;
use dbd_scene::export::constant_name;
use dbd_study::costs::Costs;
use dbd_study::estimate::instructions;

use super::core::Core;
use super::plant::Planted;
use super::{NewError, Place, PlantArguments};
use crate::commands::schema;
use crate::terminal::Found;

/// A project for a microcontroller.
#[derive(Clone, Debug, Args)]
pub struct FirmwareArguments {
    /// The plant
    #[command(flatten)]
    pub plant: PlantArguments,
    /// The core: QEMU's machine and the compiler's options
    #[arg(long, value_enum, default_value_t)]
    pub core: Core,
}

/// Constants that the project's page shows of a kind.
const SHOWN: usize = 6;

/// Files of a project and what they are made from.
const TEMPLATES: &[(&str, &str)] = &[
    ("Cargo.toml", include_str!("../../../templates/firmware/Cargo.toml.in")),
    ("build.rs", include_str!("../../../templates/firmware/build.rs.in")),
    ("memory.x", include_str!("../../../templates/firmware/memory.x.in")),
    (".cargo/config.toml", include_str!("../../../templates/firmware/config.toml.in")),
    (".gitignore", include_str!("../../../templates/firmware/gitignore.in")),
    ("README.md", include_str!("../../../templates/firmware/README.md.in")),
    ("src/lib.rs", include_str!("../../../templates/firmware/lib.rs.in")),
    ("src/main.rs", include_str!("../../../templates/firmware/main.rs.in")),
    ("src/bin/cost.rs", include_str!("../../../templates/firmware/cost.rs.in")),
    ("tests/golden.rs", include_str!("../../../templates/firmware/golden.rs.in")),
    ("check.sh", include_str!("../../../templates/firmware/check.sh.in")),
    (".github/workflows/test.yml", include_str!("../../../templates/firmware/github.yml.in")),
    (".gitlab-ci.yml", include_str!("../../../templates/firmware/gitlab.yml.in")),
    ("Dockerfile", include_str!("../../../templates/firmware/Dockerfile.in")),
    (
        ".devcontainer/devcontainer.json",
        include_str!("../../../templates/firmware/devcontainer.json.in"),
    ),
    (".vscode/extensions.json", include_str!("../../../templates/firmware/extensions.json.in")),
    (".vscode/launch.json", include_str!("../../../templates/firmware/launch.json.in")),
    (".vscode/settings.json", include_str!("../../../templates/firmware/settings.json.in")),
    (".taplo.toml", include_str!("../../../templates/firmware/taplo.toml.in")),
    ("Embed.toml", include_str!("../../../templates/firmware/Embed.toml.in")),
];

/// The remark in files for other machines if the project's crates are in a local folder.
const ELSEWHERE: &str = "\n# The crates are in a folder of one machine (Cargo.toml): elsewhere name their repository there, \
                         or write\n# the project with `host-sim new firmware --git URL --rev REV`.";

/// Writes a project of a scene and says what to type next.
///
/// # Errors
/// [`NewError`]; nothing is written then.
pub fn firmware(arguments: &FirmwareArguments, found: &Found) -> Result<String, NewError> {
    let FirmwareArguments { plant, core } = arguments;
    let place = Place::of(&plant.name)?;
    let Planted { scene, choice, dependencies, golden, mut values, file } =
        Planted::of(&place, found, plant)?;
    let counted = instructions(scene, &choice.method, &Costs::shipped());
    let estimate =
        counted.and_then(|count| core.mcu().instructions(choice.method.precision(), count));
    let estimate = estimate.map_or_else(String::new, |count| {
        format!(
            "about {} instructions per step, estimated from bodies and elements",
            significant(rounded(count, 2), 2)
        )
    });
    let suffix = choice.method.precision_name().to_uppercase();
    values.extend([
        ("elsewhere", if dependencies.is_local { ELSEWHERE } else { "" }.to_owned()),
        ("hints", hints(scene, &suffix)),
        ("constants", constants(scene, &suffix)),
    ]);
    values.extend(core.placeholders(&dependencies.kernel));
    let core = core.title();
    let golden_file = (PathBuf::from("tests/golden.txt"), golden);
    let schema_file = (PathBuf::from(format!("scenes/{}", schema::FILE)), schema::text());
    place.write(TEMPLATES, &values, vec![file, golden_file, schema_file])?;
    Ok(format!(
        "{0}: the scene {1} as a plant in firmware: {3}; {2}\n{4}\n  cd {0}\n  cargo test    golden bits on the \
         PC\n  cargo qemu    the same bits on a {core} in QEMU; README.md says what to install\n  cargo \
         cost    instructions of a step there: {5}\n",
        place.folder.display(),
        scene.name,
        dependencies.origin,
        choice.words(),
        choice.reasons.iter().map(|reason| format!("  {reason}\n")).collect::<String>(),
        if estimate.is_empty() {
            "counted there, without an estimate for this scene"
        } else {
            &estimate
        },
    ))
}

/// Calls of a controller, for the scene's first read-out and input.
fn hints(scene: &Scene, suffix: &str) -> String {
    let prefix = constant_name(&scene.name);
    let readout = scene.readouts.first().map(|readout| {
        let name = constant_name(&readout.name);
        format!("/// plant.read(&model::{prefix}_READOUT_{name}_{suffix})\n")
    });
    let input = scene.inputs.iter().find(|input| !input.table).map(|input| {
        let name = constant_name(&input.name);
        format!("/// plant.set_input_real(model::{prefix}_INPUT_{name}, 0.0)\n")
    });
    let calls: String = readout.into_iter().chain(input).collect();
    if calls.is_empty() { calls } else { format!("///\n/// ```text\n{calls}/// ```\n") }
}

/// The constants that a controller takes, for the project's page.
fn constants(scene: &Scene, suffix: &str) -> String {
    let prefix = constant_name(&scene.name);
    let row = |what: &str, names: Vec<String>| {
        let more = if names.len() > SHOWN { ", …" } else { "" };
        let shown: Vec<String> = names.iter().take(SHOWN).map(|name| format!("`{name}`")).collect();
        (!names.is_empty()).then(|| format!("| {what} | {}{more} |\n", shown.join(", ")))
    };
    let read = format!("_{suffix}");
    let force = format!("_FORCE_{suffix}");
    let name =
        |kind: &str, name: &str, end: &str| format!("{prefix}_{kind}_{}{end}", constant_name(name));
    let inputs = scene.inputs.iter().map(|one| name("INPUT", &one.name, "")).collect();
    let readouts = scene.readouts.iter().map(|one| name("READOUT", &one.name, &read)).collect();
    let bodies = scene.body_names.iter().map(|one| name("BODY", one, "")).collect();
    let joints = scene.joints.iter().map(|one| name("JOINT", &one.name, &force)).collect();
    let rows = [
        row("inputs", inputs),
        row("read-outs", readouts),
        row("bodies", bodies),
        row("joint forces", joints),
    ];
    let rows: String = rows.into_iter().flatten().collect();
    format!("`model` contains the plant and:\n\n| what | constants |\n|---|---|\n{rows}")
}

#[cfg(test)]
mod tests {
    use clap::ValueEnum as _;

    use super::super::DependencyOptions;
    use super::super::choice::ChoiceOptions;
    use super::*;

    /// All placeholders are filled, and none is unknown.
    #[test]
    fn every_name_in_a_template_is_known() {
        let here = tempfile::tempdir().unwrap();
        let folder = here.path();
        let found = crate::terminal::Catalogue::default().load("gyroscope").unwrap();
        let dependencies = DependencyOptions { registry: true, ..DependencyOptions::default() };
        let choice = ChoiceOptions::default();
        let scene = "gyroscope".to_owned();
        let plant = PlantArguments { name: folder.into(), scene, dependencies, choice };
        for core in Core::value_variants() {
            let called = core.to_possible_value().unwrap();
            let name = folder.join(called.get_name());
            let plant = PlantArguments { name, ..plant.clone() };
            let written = plant.name.clone();
            firmware(&FirmwareArguments { plant, core: *core }, &found).unwrap();
            let read = |path: &str| std::fs::read_to_string(written.join(path)).unwrap();
            for (path, _) in TEMPLATES {
                let text = read(path);
                assert!(!text.contains("{{"), "{path}: {text}");
                let other = ["M4F", "an386", "thumbv7em", "STM32F405"];
                let alone =
                    *core == Core::CortexM4f || *core == Core::CortexM7 && text.contains("v7em");
                assert!(alone || !other.iter().any(|word| text.contains(word)), "{path}: {text}");
            }
            let fpu = matches!(core, Core::CortexM7 | Core::Rv32imafc);
            assert_eq!(read("Cargo.toml").contains("features = [\"fpu\"]"), fpu);
        }
    }
}
