//! Systems and measures that the tests across crates share.

pub mod mechanisms;
pub mod page;
pub mod results;
#[cfg(feature = "systems")]
mod systems;
#[cfg(feature = "systems")]
pub use systems::{Bench, free_ring, hung_ring, uneven_ring};

/// Pages whose programs compile. The README's stand in the firmware, which has what they include.
macro_rules! pages {
    ($($module:ident $page:literal)*) => {
        $(
            #[cfg(doctest)]
            #[doc = include_str!(concat!("../", $page))]
            pub mod $module {}
        )*
        /// Pages whose programs compile.
        pub const PAGES: &[&str] = &[$($page),*];
    };
}

pages! {
    contributing "CONTRIBUTING.md"
    the_book "docs/README.md"
    advise "docs/advise.md"
    architecture "docs/architecture.md"
    authoring "docs/authoring.md"
    board "docs/board.md"
    command_line "docs/command-line.md"
    compare "docs/compare.md"
    cookbook "docs/cookbook.md"
    development "docs/development.md"
    elements "docs/elements.md"
    ensembles "docs/ensembles.md"
    examples "docs/examples.md"
    extremes "docs/extremes.md"
    fmu "docs/fmu.md"
    glossary "docs/glossary.md"
    golden "docs/golden.md"
    hil "docs/hil.md"
    import "docs/import.md"
    integration "docs/integration.md"
    joints "docs/joints.md"
    laws "docs/laws.md"
    linearise "docs/linearise.md"
    measured "docs/measured.md"
    method "docs/method.md"
    modes "docs/modes.md"
    near_rigid "docs/near-rigid.md"
    paper "docs/paper.md"
    peers "docs/validation/peers.md"
    planar "docs/planar.md"
    play "docs/play.md"
    precision "docs/precision.md"
    proof "docs/proof.md"
    python "docs/python.md"
    real_time "docs/real-time.md"
    reference_solvers "docs/reference-solvers.md"
    scene_reference "docs/scene-reference.md"
    schemes "docs/schemes.md"
    schemes_measured "docs/schemes-measured.md"
    speed "docs/speed.md"
    step "docs/step.md"
    contents "docs/SUMMARY.md"
    sweeps "docs/sweeps.md"
    target "docs/target.md"
    trade "docs/trade.md"
    tutorial "docs/tutorial.md"
}

/// The page whose program compiles in the firmware, too, for it includes a model.
pub const IN_FIRMWARE: &str = "docs/controllers.md";

use std::path::Path;

use dbd_kernel::{BodyState, F64, Geometry, Plant, Scheme, State, Vec3};
use dbd_scene::Scene;

/// The names of the scenes that ship, in order.
///
/// # Panics
/// Where their folder cannot be read.
#[must_use]
pub fn scene_names() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let files = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path());
    let mut names: Vec<_> =
        files.map(|file| file.file_stem().unwrap().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// A scene that ships.
///
/// # Panics
/// Where there is none of that name, or it is refused.
#[must_use]
pub fn scene(name: &str) -> Scene {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    Scene::load(scenes.join(name).with_extension("toml")).unwrap()
}

/// The text of a scene that ships.
///
/// # Panics
/// Where there is none of that name.
#[must_use]
pub fn scene_text(name: &str) -> String {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    std::fs::read_to_string(scenes.join(name).with_extension("toml")).unwrap()
}

/// The unit quaternion of a turn by `angle` \[rad\] about a unit axis.
#[must_use]
pub fn turned(axis: [f64; 3], angle: f64) -> [f64; 4] {
    let (s, c) = (angle / 2.0).sin_cos();
    [c, s * axis[0], s * axis[1], s * axis[2]]
}

/// A body at rest at a position, unturned.
#[must_use]
pub fn at<P: Geometry>(position: [f64; 3]) -> BodyState<P> {
    BodyState::from_f64(position, [1.0, 0.0, 0.0, 0.0], [0.0; 3], [0.0; 3])
}

/// Linear momentum and angular momentum about the origin, both world.
#[must_use]
pub fn momenta<const N: usize>(
    bodies: &[(f64, [f64; 3]); N],
    states: &[BodyState<F64>],
) -> (Vec3<f64>, Vec3<f64>) {
    let (mut linear, mut angular) = (Vec3::ZERO, Vec3::ZERO);
    for ((mass, inertia), state) in bodies.iter().zip(states) {
        let p = state.velocity * *mass;
        let spin = Vec3::from_f64(*inertia).scale(state.angular_velocity);
        linear = linear + p;
        angular = angular + state.position.cross(p) + state.orientation.rotation().to_world(spin);
    }
    (linear, angular)
}

/// The state after `steps` steps.
///
/// # Panics
/// Where the plant fails.
pub fn run<M: dbd_kernel::ModelOwner, S: Scheme>(
    model: &M,
    scheme: S,
    step: f64,
    steps: u64,
) -> State<M> {
    let mut plant = Plant::new(model, scheme, step).unwrap();
    for _ in 0..steps {
        plant.step().unwrap();
    }
    plant.state().clone()
}

/// The largest distance \[m\] between the bodies' positions of two states.
pub fn distance(a: &[BodyState<F64>], b: &[BodyState<F64>]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| {
            let d = a.position - b.position;
            d.dot(d).sqrt()
        })
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    /// Every page is compiled, and none of its programs is left out of that.
    #[test]
    fn every_program_of_the_pages_is_compiled() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let mut pages: Vec<String> = vec!["CONTRIBUTING.md".into()];
        for folder in ["docs", "docs/validation"] {
            for file in fs::read_dir(root.join(folder)).unwrap() {
                let name = file.unwrap().file_name().into_string().unwrap();
                pages.extend(name.ends_with(".md").then(|| format!("{folder}/{name}")));
            }
        }
        pages.sort();
        let mut compiled = [PAGES, &[IN_FIRMWARE]].concat();
        compiled.sort_unstable();
        assert_eq!(pages, compiled);
        let fences = |page: &str| {
            let text = fs::read_to_string(root.join(page)).unwrap();
            let fences = text.lines().filter(|line| line.starts_with("```"));
            fences.map(str::to_owned).collect::<Vec<_>>()
        };
        for page in pages.iter().map(String::as_str).chain(["README.md"]) {
            for opening in fences(page).iter().step_by(2) {
                let known =
                    ["```python", "```rust", "```rust,no_run", "```sh", "```toml", "```text"];
                // The cookbook's C is compiled by its own test.
                let is_known = known.contains(&opening.as_str())
                    || page == "docs/cookbook.md" && opening == "```c";
                assert!(is_known, "{page}: {opening}");
            }
        }
    }
}
