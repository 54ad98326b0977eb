//! Deflections of joints under the forces at t = 0, before a run.
//!
//! `scene => per joint the longest deformation`. The pose at t = 0, at rest: M·a = Q − Jᵀ·K·J·u, with J
//! the directions of the joints' elements, K their stiffnesses and u the displacements of the bodies. In the
//! directions constrained by joints, a is 0: u = M^(−½)·A⁺·M^(−½)·Q with A = M^(−½)·Jᵀ·K·J·M^(−½), by the eigenvectors
//! of A. Elements much softer than the joints count as free. A joint that starts at free length
//! overshoots up to twice as far. Later loads, inputs and motion are not included.

use dbd_kernel::{State, Vec3};
use dbd_scene::{JointElement, Scene};
use nalgebra::{DMatrix, DVector, SymmetricEigen};

use crate::modes::weighted_forces;

/// Largest number of bodies: the time grows with the third power.
const MAX_BODIES: usize = 60;

/// Modes below this fraction of the softest joint's frequency are motions resisted by springs, not joints,
/// or by intentionally soft rubber.
const SOFT: f64 = 0.05;

/// The deflection of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deformation {
    /// The row of the joint.
    pub joint: usize,
    /// \[m\] the extension of its most extended element.
    pub extension: f64,
    /// \[m\] that element's free length.
    pub free_length: f64,
}

impl Deformation {
    /// The extension as a fraction of the free length.
    #[must_use]
    pub fn share(&self) -> f64 {
        self.extension / self.free_length
    }
}

/// The deflections of the joints, in scene order, without those of no length; empty for
/// too many bodies.
#[must_use]
pub fn stretches(scene: &Scene) -> Vec<Deformation> {
    let bodies = scene.model.bodies.len();
    if bodies > MAX_BODIES {
        return Vec::new();
    }
    let elements = dbd_scene::joint_elements(scene);
    let joints = dbd_scene::element_frequencies(scene).into_iter().take(scene.joints.len());
    let frequencies = joints.map(|joint| joint.frequency).filter(|frequency| *frequency > 0.0);
    let softest = frequencies.fold(f64::INFINITY, f64::min);
    if elements.is_empty() {
        return Vec::new();
    }
    let roots = roots(scene);
    let rows: Vec<Row> = elements.iter().map(|element| row(element, &roots)).collect();
    let mut stiffness = DMatrix::zeros(6 * bodies, 6 * bodies);
    for (element, row) in elements.iter().zip(&rows) {
        for (i, a) in row {
            for (j, b) in row {
                stiffness[(*i, *j)] += element.stiffness * a * b;
            }
        }
    }
    let eigen = SymmetricEigen::new(stiffness);
    let Ok(pull) = weighted_forces(&scene.model, &State::initial(&scene.model)) else {
        return Vec::new();
    };
    let mut way = DVector::zeros(6 * bodies);
    for (square, mode) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        if *square > (SOFT * softest) * (SOFT * softest) {
            way += mode * (mode.dot(&pull) / square);
        }
    }
    let mut stretches: Vec<Deformation> = Vec::new();
    for (element, row) in elements.iter().zip(&rows).filter(|(e, _)| e.free_length > 0.0) {
        let extension = row.iter().map(|(i, a)| way[*i] * a).sum::<f64>().abs();
        let JointElement { joint, free_length, .. } = *element;
        match stretches.last_mut().filter(|last| last.joint == joint) {
            Some(last) if last.extension >= extension => {}
            Some(last) => (last.extension, last.free_length) = (extension, free_length),
            None => stretches.push(Deformation { joint, extension, free_length }),
        }
    }
    stretches
}

/// The entries of an element's row of J·M^(−½).
type Row = Vec<(usize, f64)>;

fn row(element: &JointElement, roots: &[f64]) -> Row {
    let mut row = Vec::new();
    let ends = element.bodies.iter().zip(element.moments);
    for ((body, moment), sign) in ends.zip([-1.0, 1.0]) {
        let Some(body) = body else { continue };
        // n·R(ω × p) = ω·(p × n), in body axes.
        let parts = [element.direction_w, moment].map(Vec3::to_f64);
        for (i, part) in parts.as_flattened().iter().enumerate() {
            row.push((6 * body + i, sign * part / roots[6 * body + i]));
        }
    }
    row
}

/// √M: of mass and principal inertias, per body.
fn roots(scene: &Scene) -> Vec<f64> {
    let of = |body: &dbd_kernel::Body<f64>| {
        let [x, y, z] = body.inertia.to_f64();
        [body.mass, body.mass, body.mass, x, y, z].map(f64::sqrt)
    };
    scene.model.bodies.iter().flat_map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_joint_gives_way_by_the_weight_that_it_carries_over_its_stiffness() {
        // The springs of a spherical joint are at right angles: 2e4 N/m in every direction.
        let text = "name = \"plumb\"\nduration = 1\ngravity = [0, 0, -10]\n[[body]]\nname = \"bob\"\n\
                    mass = 4\ninertia = [0.1, 0.2, 0.3]\nposition = [0, 0, -0.5]\n\
                    orientation = { axis = [1, 2, 2], angle = 0.8 }\n[[joint]]\nname = \"hook\"\n\
                    type = \"spherical\"\nbetween = [\"world\", \"bob\"]\nat = [0, 0, 0]\n\
                    stiffness = 2e4\narm = 0.03\n";
        let scene = Scene::parse(text, "plumb.toml").unwrap();
        let steepest = dbd_scene::joint_elements(&scene)
            .iter()
            .map(|e| e.direction_w.z.abs())
            .fold(0.0, f64::max);
        let [hook] = stretches(&scene)[..] else { panic!() };
        assert!((hook.extension - 4.0 * 10.0 / 2e4 * steepest).abs() < 1e-12, "{hook:?}");
        assert_eq!((hook.joint, hook.free_length), (0, 0.03));
        // A stop compressed by 4 mm carries 40 N instead.
        let held = format!(
            "{text}[[interaction]]\nlaw = \"end-stop\"\nbetween = [\"world\", \"bob\"]\n\
             points = [[0, 0, -0.496], [0, 0, 0]]\nnormal = [0, 0, 1]\nstiffness = 1e4\ndissipation = 0\n"
        );
        let [hook] = stretches(&Scene::parse(&held, "held.toml").unwrap())[..] else { panic!() };
        assert!(hook.extension < 1e-12, "{hook:?}");
        // Horizontal, it falls at first: the joint carries m·g·I/(I + m·r²) = 1/11 of the weight.
        let level = text
            .replace("position = [0, 0, -0.5]", "position = [-0.5, 0, 0]")
            .replace("[0.1, 0.2, 0.3]", "[0.1, 0.1, 0.1]");
        let [hook] = stretches(&Scene::parse(&level, "level.toml").unwrap())[..] else { panic!() };
        assert!((hook.extension - 40.0 / 11.0 / 2e4 * steepest).abs() < 1e-12, "{hook:?}");
    }
}
