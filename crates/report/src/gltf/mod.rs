//! The animation as glTF 2.0 (GLB): one file that programs for models open.
//!
//! `(mechanism, frames) => GLB`. A node for each body with its solids, in metres and in the body's axes from its centre
//! of mass; channels move it as in the film. glTF's y axis is up: a root node rotates the scene so that gravity points
//! down; without gravity it is unchanged.

mod file;
mod marks;
mod solids;

use crate::picture::Mechanism;
use crate::picture::mechanism::Place;
use dbd_kernel::{Quaternion, Vec3};
use gltf::json::scene::UnitQuaternion;
use gltf::json::{Index, Material, Node};

use crate::film::Frame;
use crate::measure::size;
use file::{File, Moves};
use marks::Look;
use solids::Solids;

/// The file of a mechanism's film; without movement where there are fewer than two frames.
///
/// # Errors
/// Where it would be larger than 4 GiB.
pub fn glb(mechanism: &Mechanism, frames: &[Frame]) -> std::io::Result<Vec<u8>> {
    let frames = shown(frames);
    let still = Frame {
        poses: mechanism.bodies.iter().map(|body| (body.position, body.orientation)).collect(),
        ..Frame::default()
    };
    let first = frames.first().copied().unwrap_or(&still);
    let mut file = File::default();
    let look = Look::new(&mut file, size(mechanism));
    let mut children = Vec::new();
    let parts = ground_parts(&mut file, mechanism, &look);
    if let Some(mesh) = file.mesh("ground", &parts) {
        let node = Node { name: Some("ground".into()), mesh: Some(mesh), ..Node::default() };
        children.push(file.node(node));
    }
    let bodies = bodies(&mut file, mechanism, &look, first);
    let springs = springs(&mut file, mechanism, &look, first);
    if frames.len() > 1 {
        let times: Vec<f32> = frames.iter().map(|frame| frame.time as f32).collect();
        let input = file.times(&times);
        for (row, node) in bodies.iter().enumerate() {
            let poses = frames.iter().map(|frame| frame.poses[row]);
            let translations = poses.clone().map(|(position, _)| position.map(single));
            file.channel(*node, input, &Moves::Translation(translations.collect()));
            let rotations = rotations(poses.map(|(_, orientation)| orientation));
            file.channel(*node, input, &Moves::Rotation(rotations));
        }
        for (spring, node) in mechanism.springs.iter().zip(&springs) {
            let lines: Vec<Line> =
                frames.iter().map(|frame| Line::between(&spring.ends, frame)).collect();
            let translations = lines.iter().map(|line| line.at).collect();
            file.channel(*node, input, &Moves::Translation(translations));
            let turns = rotations(lines.iter().map(|line| line.turn));
            file.channel(*node, input, &Moves::Rotation(turns));
            let scales = lines.iter().map(|line| [1.0, 1.0, line.length]).collect();
            file.channel(*node, input, &Moves::Scale(scales));
        }
    }
    children.extend(bodies);
    children.extend(springs);
    let top = file.node(Node {
        name: Some(mechanism.name.clone()),
        rotation: Some(UnitQuaternion(scalar_last(upright(mechanism.gravity)))),
        children: (!children.is_empty()).then_some(children),
        ..Node::default()
    });
    file.glb(&mechanism.name, top)
}

/// The frames that a file can show: numbers, at times that single precision tells apart.
fn shown(frames: &[Frame]) -> Vec<&Frame> {
    let mut shown: Vec<&Frame> = Vec::new();
    for frame in frames {
        let later = shown.last().is_none_or(|last| frame.time as f32 > last.time as f32);
        let finite = frame.poses.iter().all(|(position, orientation)| {
            position.iter().chain(orientation).all(|number| (*number as f32).is_finite())
        });
        if later && finite {
            shown.push(frame);
        }
    }
    shown
}

/// Solids with their materials.
type Parts = Vec<(Solids, Index<Material>)>;

fn ground_parts(file: &mut File, mechanism: &Mechanism, look: &Look) -> Parts {
    let mut parts = marks::shapes(file, &mechanism.ground, look.ground);
    parts.push((marks::ground(mechanism, look), look.ground));
    parts
}

/// Those of each body, in its axes.
fn body_parts(file: &mut File, mechanism: &Mechanism, look: &Look) -> Vec<Parts> {
    let joints = marks::joints(mechanism, look);
    let rows = mechanism.bodies.iter().zip(joints).enumerate();
    let parts = rows.map(|(row, (body, joints))| {
        let mut parts = marks::shapes(file, &body.shapes, look.body(row));
        if parts.is_empty() {
            parts.push((marks::outline(&body.outline, look), look.body(row)));
        }
        parts.push((joints, look.joint));
        parts
    });
    parts.collect()
}

/// Triangles of one colour.
#[cfg(feature = "mcap")]
pub(crate) struct Surface {
    /// \[m\].
    pub(crate) positions: Vec<[f32; 3]>,
    /// Rows of positions, three per triangle.
    pub(crate) triangles: Vec<u32>,
    /// sRGB.
    pub(crate) colour: [u8; 3],
}

/// The surfaces of the ground, then of each body in its axes.
#[cfg(feature = "mcap")]
pub(crate) fn surfaces(mechanism: &Mechanism) -> Vec<Vec<Surface>> {
    let mut file = File::default();
    let look = Look::new(&mut file, size(mechanism));
    let mut all = vec![ground_parts(&mut file, mechanism, &look)];
    all.extend(body_parts(&mut file, mechanism, &look));
    let surface = |(solids, material): (Solids, Index<Material>)| Surface {
        positions: solids.positions,
        triangles: solids.triangles,
        colour: file.colour(material),
    };
    let shown = |parts: Parts| {
        parts.into_iter().filter(|(solids, _)| !solids.triangles.is_empty()).map(surface).collect()
    };
    all.into_iter().map(shown).collect()
}

fn bodies(file: &mut File, mechanism: &Mechanism, look: &Look, first: &Frame) -> Vec<Index<Node>> {
    let parts = body_parts(file, mechanism, look);
    let rows = mechanism.bodies.iter().zip(parts).zip(&first.poses);
    let nodes = rows.map(|((body, parts), (position, orientation))| {
        let mesh = file.mesh(&body.name, &parts);
        let rotation = rotations(std::iter::once(*orientation));
        file.node(Node {
            name: Some(body.name.clone()),
            mesh,
            translation: Some(position.map(single)),
            rotation: rotation.first().copied().map(UnitQuaternion),
            ..Node::default()
        })
    });
    nodes.collect()
}

/// A node for each spring: a rod of length 1 along z, stretched from end to end.
fn springs(file: &mut File, mechanism: &Mechanism, look: &Look, first: &Frame) -> Vec<Index<Node>> {
    if mechanism.springs.is_empty() {
        return Vec::new();
    }
    let mut rod = Solids::default();
    rod.add_rod(Vec3::ZERO, Vec3::new(0.0, 0.0, 1.0), look.thin);
    let [calm, driven] =
        [look.spring, look.driven].map(|material| file.mesh("spring", &[(rod.clone(), material)]));
    let springs = mechanism.springs.iter().enumerate();
    let nodes = springs.map(|(row, spring)| {
        let line = Line::between(&spring.ends, first);
        let name = spring.name.clone().unwrap_or_else(|| format!("spring {}", row + 1));
        file.node(Node {
            name: Some(name),
            mesh: if spring.driven { driven } else { calm },
            translation: Some(line.at),
            rotation: Some(UnitQuaternion(scalar_last(line.turn))),
            scale: Some([1.0, 1.0, line.length]),
            ..Node::default()
        })
    });
    nodes.collect()
}

/// Transform of a rod of length 1 along z between two points.
struct Line {
    at: [f32; 3],
    turn: [f64; 4],
    length: f32,
}

impl Line {
    fn between(ends: &[Place; 2], frame: &Frame) -> Self {
        let [from, to] = ends.map(|end| {
            let point: Vec3<f64> = Vec3::from_f64(end.point);
            match end.body.and_then(|row| frame.poses.get(row)) {
                Some((position, orientation)) => {
                    let rotation = Quaternion::from_f64(*orientation).rotation();
                    Vec3::from_f64(*position) + rotation.to_world(point)
                }
                None => point,
            }
        });
        let way = to - from;
        let length = way.dot(way).sqrt();
        let turn = between(Vec3::new(0.0, 0.0, 1.0), way);
        // A length of zero would make a node that cannot be undone.
        Self { at: from.to_f64().map(single), turn, length: single(length.max(1e-9)) }
    }
}

/// The shortest rotation, scalar first, from a unit vector to the direction of another vector.
fn between(from: Vec3<f64>, to: Vec3<f64>) -> [f64; 4] {
    let length = to.dot(to).sqrt();
    if length <= 0.0 || !length.is_finite() {
        return [1.0, 0.0, 0.0, 0.0];
    }
    let to = to * (1.0 / length);
    let cosine = from.dot(to);
    // A rotation by 180° is about any perpendicular axis.
    let axis = if cosine < -1.0 + 1e-12 { from.normals()[0] } else { from.cross(to) };
    let scalar = if cosine < -1.0 + 1e-12 { 0.0 } else { 1.0 + cosine };
    let size = (scalar * scalar + axis.dot(axis)).sqrt();
    [scalar, axis.x, axis.y, axis.z].map(|part| part / size)
}

/// The rotation from the up direction to y; none without gravity.
fn upright(gravity: Option<[f64; 3]>) -> [f64; 4] {
    raised(gravity, Vec3::new(0.0, 1.0, 0.0))
}

/// The rotation from the up direction to z, scalar first; none without gravity.
#[cfg(feature = "mcap")]
pub(crate) fn upright_z(gravity: Option<[f64; 3]>) -> [f64; 4] {
    raised(gravity, Vec3::new(0.0, 0.0, 1.0))
}

fn raised(gravity: Option<[f64; 3]>, axis: Vec3<f64>) -> [f64; 4] {
    let up = gravity.map_or(axis, |gravity| -Vec3::from_f64(gravity));
    let [w, x, y, z] = between(axis, up);
    [w, -x, -y, -z]
}

/// Orientations as unit quaternions, scalar last, each with the sign nearer to the previous one.
fn rotations(orientations: impl Iterator<Item = [f64; 4]>) -> Vec<[f32; 4]> {
    let mut last = [0.0; 4];
    let rotation = |orientation: [f64; 4]| {
        let dot = |a: [f64; 4], b: [f64; 4]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let size = dot(orientation, orientation).sqrt();
        let way = if dot(orientation, last) < 0.0 { -1.0 } else { 1.0 };
        last = if size > 0.0 {
            orientation.map(|part| way * part / size)
        } else {
            [1.0, 0.0, 0.0, 0.0]
        };
        scalar_last(last)
    };
    orientations.map(rotation).collect()
}

fn scalar_last([w, x, y, z]: [f64; 4]) -> [f32; 4] {
    [x, y, z, w].map(single)
}

fn single(number: f64) -> f32 {
    number as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gravity_points_down_in_the_file() {
        for gravity in [[0.0, 0.0, -9.81], [0.0, -9.81, 0.0], [0.0, 3.0, 0.0], [1.0, 2.0, -3.0]] {
            let turn = Quaternion::from_f64(upright(Some(gravity))).rotation();
            let down: Vec3<f64> = turn.to_world(Vec3::from_f64(gravity));
            let given: Vec3<f64> = Vec3::from_f64(gravity);
            let size = given.dot(given).sqrt();
            assert!((down.y + size).abs() < 1e-9, "{gravity:?} {down:?}");
        }
        assert_eq!(upright(None), [1.0, 0.0, 0.0, 0.0]);
    }

    #[test]
    fn quaternions_take_the_short_way() {
        let far = [[1.0, 0.0, 0.0, 0.0], [-0.9, -0.1, 0.0, 0.0], [0.0; 4]];
        let found = rotations(far.into_iter());
        assert!(found[1][3] > 0.98 && found[1][0] > 0.1, "{found:?}");
        assert_eq!(found[2], [0.0, 0.0, 0.0, 1.0]);
    }
}
