//! Systems and measures that the tests across crates share.

pub mod mechanisms;
pub mod page;
pub mod results;

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
    joints "docs/joints.md"
    laws "docs/laws.md"
    linearise "docs/linearise.md"
    measured "docs/measured.md"
    method "docs/method.md"
    modes "docs/modes.md"
    near_rigid "docs/near-rigid.md"
    paper "docs/paper.md"
    planar "docs/planar.md"
    play "docs/play.md"
    precision "docs/precision.md"
    proof "docs/proof.md"
    python "docs/python.md"
    real_time "docs/real-time.md"
    reference_solvers "docs/reference-solvers.md"
    scene_reference "docs/scene-reference.md"
    schemes "docs/schemes.md"
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

use dbd_kernel::attitude::Attitude as _;
use dbd_kernel::builder::{LineLaw, ModelBuilder, Stars};
use dbd_kernel::{
    BodyIndex, BodyState, F64, Geometry, ModelOwner, Plant, Quaternion, Scheme, State, Vec3,
};
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

/// A builder with room for every test system.
pub type Bench<P> = ModelBuilder<P, 6, 12, 60, 48, 12, 60, 6, 6, 6, 6, 12>;

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

/// World points in the axes of a body of the bench; the ground's stay as they are.
fn local<P: Geometry>(model: &Bench<P>, body: BodyIndex, points: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let Some(state) = model.initial().get(body.row()) else { return points.to_vec() };
    let rotation =
        Quaternion::<f64>::from_f64(P::Orientation::to_f64(&state.orientation)).rotation();
    let centre = Vec3::<f64>::from_f64(P::position_to_f64(&state.position));
    let turn = |p: &[f64; 3]| rotation.to_body(Vec3::from_f64(*p) - centre).to_f64();
    points.iter().map(turn).collect()
}

/// Joins two bodies at a world point: by a revolute about z, or by a spherical joint.
fn join<P: Geometry>(
    model: &mut Bench<P>,
    between: [BodyIndex; 2],
    at: [f64; 3],
    revolute: bool,
    damping: f64,
) {
    let shifted = |d: [f64; 3]| [at[0] + d[0], at[1] + d[1], at[2] + d[2]];
    let ring = |j: u32| {
        let angle = f64::from(j) * 2.0 * std::f64::consts::PI / 3.0;
        shifted([0.2 * angle.cos(), 0.2 * angle.sin(), if revolute { 0.0 } else { 0.1 }])
    };
    let centres =
        if revolute { vec![shifted([0.0, 0.0, -0.2]), shifted([0.0, 0.0, 0.2])] } else { vec![at] };
    let arms: Vec<_> = (0..3).map(ring).collect();
    let height: f64 = if revolute { 0.2 } else { 0.1 };
    let stars = Stars {
        between,
        centres: &local(model, between[0], &centres),
        arms: &local(model, between[1], &arms),
        stiffness: 2_000.0,
        damping,
        free_length: (0.04 + height * height).sqrt(),
        clearance: 0.0,
    };
    model.add_stars(stars).unwrap();
}

/// Three asymmetric bodies, tumbling, joined in a ring by every kind of element, without ground
/// and gravity. Bushing and lines have no damper: their law does not keep angular momentum.
///
/// # Panics
/// Never: the bench has room.
#[must_use]
pub fn free_ring<P: Geometry>(damping: f64) -> Bench<P> {
    let mut model = Bench::new();
    for i in 0..3_u32 {
        let angle = f64::from(i) * 2.0;
        let state = BodyState::from_f64(
            [angle.cos(), angle.sin(), 0.1 * f64::from(i)],
            turned([0.6, 0.0, 0.8], 0.4 * angle),
            [0.3 * angle.sin(), -0.2, 0.1 * angle.cos()],
            [0.8 - 0.2 * angle, 0.5, 0.3],
        );
        let inertia = [0.05, 0.08 + 0.01 * f64::from(i), 0.11];
        model.add_body(1.0 + f64::from(i), inertia, state).unwrap();
    }
    let [a, b, c] = [0, 1, 2].map(BodyIndex);
    join(&mut model, [a, b], [0.3, 0.5, 0.0], true, damping);
    join(&mut model, [b, c], [-0.5, 0.1, 0.1], false, damping);
    model.add_tsda([c, a], [[0.1, 0.2, 0.3], [0.0, -0.2, 0.1]], 150.0, damping, 1.5).unwrap();
    model.add_tsda([a, c], [[-0.4, 0.2, 0.3], [0.3, 0.2, 0.1]], 6.0, 0.0, 0.0).unwrap();
    model.add_torsion_spring([a, b], [0.0, 0.0, 1.0], 20.0, damping * 0.1, 3.0).unwrap();
    let mut hold = |between, points: &[[f64; 3]], free_length| {
        let law = LineLaw { stiffness: 25.0, damping: 0.0, free_length, clearance: 0.0 };
        model.add_points_on_line(between, [0.1, -0.2, 0.3], [0.3, 0.4, 1.2], points, law).unwrap();
    };
    hold([c, b], &[[0.2, 0.1, 0.0], [0.1, -0.3, 0.2]], 0.0);
    hold([a, c], &[[-0.3, 0.1, 0.4]], 0.2);
    model
}

/// [`free_ring`] hung to the ground under gravity.
///
/// # Panics
/// Never: the bench has room.
#[must_use]
pub fn hung_ring<P: Geometry>(damping: f64) -> Bench<P> {
    let mut model = free_ring(damping);
    model.set_gravity([0.3, -9.81, 0.5]).unwrap();
    let world = BodyIndex::WORLD;
    join(&mut model, [world, BodyIndex(0)], [1.1, 0.4, 0.0], true, damping);
    let points = [[0.1, 0.2, -0.1], [-0.6, -0.5, 0.2]];
    model.add_tsda([BodyIndex(2), world], points, 100.0, damping, 0.0).unwrap();
    model.add_torsion_spring([world, BodyIndex(0)], [0.0, 0.0, 1.0], 8.0, 0.0, 0.5).unwrap();
    model
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
        plant.step().ok().unwrap();
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
        for file in fs::read_dir(root.join("docs")).unwrap() {
            let name = file.unwrap().file_name().into_string().unwrap();
            pages.extend(name.ends_with(".md").then(|| format!("docs/{name}")));
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
                assert!(known.contains(&opening.as_str()), "{page}: {opening}");
            }
        }
    }
}
