//! Rust source of a const model and of a plant made of it, for firmware.
//!
//! `(scene, precisions, scheme, step) => source text`. Every number is written as its bit pattern, so the model that
//! the compiler evaluates has the bits of the run-time-sized one; the compiler checks every index
//! ([`dbd_kernel::Model::checked`]). [`source`] lists the generated items. Build scripts call
//! [`build`](mod@crate::build), users `host-sim export`.

mod laws;
mod model;
mod names;
mod number;
mod plant;
mod preamble;
mod precision;
mod rows;
mod scheme;

pub use model::model;
pub use names::{constant_name, constant_names, type_name};
pub use number::SourceNumber;
pub use preamble::preamble;
pub use precision::ExportPrecision;
pub use scheme::{ExportScheme, MAX_ITERATIONS, SchemeError};

use dbd_kernel::geometry::Float;
use dbd_kernel::planar::Planar;
use dbd_kernel::{F64, Fixed, Vec3};

use number::SourceGeometry;

use crate::planar::Plane;
use crate::runtime::SceneModel;
use crate::scene::Scene;
use crate::time::display;

/// The first words of every exported file.
pub const HEAD: &str = "// Written by dbd-scene from the scene ";

/// Options of the export.
#[derive(Clone, Debug, PartialEq)]
pub struct Export {
    /// The precisions in the order of the output.
    pub precisions: Vec<ExportPrecision>,
    /// The scheme of the plants.
    pub scheme: ExportScheme,
    /// \[s\] step of the plants.
    pub step: f64,
}

/// The whole source. For a scene `four-bar` in f32 it contains, with documentation:
///
/// - `FourBarF32`, `FOUR_BAR_F32`: the model's type and the model, in flash;
/// - `FourBarPlantF32`, `plant_f32()`: the plant's type, and a plant at the initial state; in one
///   precision also `FourBarPlant` and `plant()`;
/// - `FOUR_BAR_STEP`, `FOUR_BAR_SCHEME`: the step \[s\] and the scheme;
/// - `FOUR_BAR_BODY_CRANK`, `FOUR_BAR_INPUT_…`, `FOUR_BAR_READOUT_…_F32`: what the plant's calls take;
/// - `FOUR_BAR_JOINT_A0_BODIES`, `…_GROUPS`, `…_FORCE_F32`: the bodies of a joint, its groups of
///   elements, and the read-out of its force on its second body;
/// - `FOUR_BAR_BODIES`, `…_JOINTS`, `…_INPUTS`, `…_TORSION_SPRINGS`: names by index.
#[must_use]
pub fn source(scene: &Scene, export: &Export) -> String {
    let precisions: Vec<&str> = export.precisions.iter().map(|one| one.name()).collect();
    let head = format!(
        "{HEAD}{:?}: {}, {}, a step of {}.\n",
        scene.name,
        export.scheme.name(),
        precisions.join(" and "),
        display(export.step),
    );
    let plane = scene.planar.as_ref().map(|planar| in_plane(&planar.plane)).unwrap_or_default();
    let mut text = head + &plane + &preamble::shared(scene, export.step) + &preamble::names(scene);
    text += &plant::scheme(scene, &export.scheme);
    for precision in &export.precisions {
        match precision {
            ExportPrecision::F64 => text += &parts_of::<f64>(scene, &export.scheme),
            ExportPrecision::F32 => text += &parts_of::<f32>(scene, &export.scheme),
            ExportPrecision::Fixed => {
                text += &parts::<Fixed>(scene, &scene.model, &export.scheme);
            }
        }
    }
    if let [only] = export.precisions[..] {
        text += &plant::only(scene, only);
    }
    text
}

/// A comment on the vectors of a planar scene.
fn in_plane(plane: &Plane) -> String {
    let axes = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)];
    let [x, y] = axes.map(|axis| plane.outward(axis).to_f64());
    format!(
        "// It moves in the plane {}: three freedoms per body. Vectors are along {x:?} and {y:?} of the\n\
         // world, from the point of the plane that is nearest to its origin; moments are about its normal.\n",
        plane.name(),
    )
}

/// The items of one precision, spatial or planar.
fn parts_of<R: SourceNumber>(scene: &Scene, scheme: &ExportScheme) -> String {
    match &scene.planar {
        Some(planar) => parts::<Planar<R>>(scene, &planar.model, scheme),
        None => parts::<Float<R>>(scene, &scene.model, scheme),
    }
}

/// The items of one precision.
fn parts<P: SourceGeometry>(
    scene: &Scene,
    exact: &SceneModel<F64>,
    scheme: &ExportScheme,
) -> String {
    let model = model::model_in::<P>(scene, exact);
    let plan = if scheme.has_matrix { model::plan::<P>(scene, exact) } else { String::new() };
    model + &plan + &model::joint_forces::<P>(scene) + &plant::plant::<P>(scene, scheme)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn export(precisions: &[ExportPrecision]) -> Export {
        let scheme = ExportScheme::named("leapfrog", None, None).unwrap();
        Export { precisions: precisions.into(), scheme, step: 2e-5 }
    }

    const ELEMENTS: &str = r#"
        [[joint]]
        name = "w1"
        type = "revolute"
        between = ["world", "arm"]
        at = [0, 0, 0]
        axis = [0, 0, 1]
        stiffness = 40
        span = 0.1
        [[input]]
        name = "motor"
        type = "joint_torque"
        target = "w1"
        [[readout]]
        name = "angle"
        type = "joint_angle"
        target = "w1"
    "#;

    #[test]
    fn what_a_scene_names_are_constants_and_a_plant_is_one_call_away() {
        let scene = crate::example::with(ELEMENTS);
        let text = source(&scene, &export(&[ExportPrecision::F32]));
        for part in [
            "// Written by dbd-scene from the scene \"two bodies\": leapfrog, f32, a step of 20us.\n",
            "pub const TWO_BODIES_BODY_HAND: BodyIndex = BodyIndex(1);",
            "pub const TWO_BODIES_INPUT_MOTOR: InputIndex = InputIndex(0);",
            "pub const TWO_BODIES_READOUT_ANGLE_F32: Readout<F32> = ",
            "pub const TWO_BODIES_JOINT_W1_BODIES: [BodyIndex; 2] = [BodyIndex::WORLD, BodyIndex(0)];",
            "pub const TWO_BODIES_JOINT_W1_GROUPS: core::ops::Range<u16> = 0..1;",
            "pub const TWO_BODIES_JOINT_W1_FORCE_F32: Readout<F32> = Readout::JointForce { group: GroupIndex(0) };",
            "pub type TwoBodiesPlantF32 = dbd_kernel::generated::Plant<&'static TwoBodiesF32, dbd_kernel::Leapfrog>;",
            "pub type TwoBodiesPlant = TwoBodiesPlantF32;",
            "pub fn plant() -> Result<TwoBodiesPlant, dbd_kernel::generated::PlantError> {",
            "pub const TWO_BODIES_STEP: f64 = f64::from_bits(0x3ef4f8b588e368f1);",
        ] {
            assert!(text.contains(part), "{part}: {text}");
        }
    }

    /// With two precisions nothing is named `plant`.
    #[test]
    fn each_precision_has_a_plant_of_its_own() {
        let scene = crate::example::with("");
        let text = source(&scene, &export(&ExportPrecision::ALL));
        assert!(text.contains("pub fn plant_f64()") && text.contains("pub fn plant_f32()"));
        assert!(!text.contains("pub fn plant()") && !text.contains("TwoBodiesPlant ="));
    }

    /// A given step takes precedence over that of the scene.
    #[test]
    fn the_step_asked_for_is_the_plants() {
        let text = "name = \"s\"\nduration = 1\nstep = 1e-3\n[[body]]\nname = \"b\"\nmass = 1\n\
                    inertia = [1, 1, 1]\nposition = [0, 0, 0]\n";
        let scene = Scene::parse(text, "s.toml").unwrap();
        let line = |step: f64| format!("S_STEP: f64 = {};", step.number());
        assert!(source(&scene, &export(&[ExportPrecision::F32])).contains(&line(2e-5)));
        assert!(preamble(&scene, 2e-5).contains(&line(1e-3)));
    }
}
