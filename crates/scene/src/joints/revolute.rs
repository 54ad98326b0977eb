//! Revolute joint: two axis points, three ring points, six TSDAs (Franco & Degani 2026, Fig. 5).
//!
//! The axis points at ±span/2 on the first body, the ring points in the mid plane on the second, at azimuth 120°·j
//! from the reference; each axis point is joined to each ring point, the one at −span/2 first. Free length
//! √((span/2)² + ring²). With the default ring radius span/√2 the three lines of an end are orthogonal, its stiffness
//! is k·I. As a bushing it connects a point and an axis of both bodies; with another ring its axial and radial
//! stiffness differ.

use core::f64::consts::SQRT_2;

use dbd_kernel::Vec3;

use crate::assembly::{Assembly, Defect, Points};
use crate::closure::{Place, Turn};
use crate::error::SceneError;
use crate::hinge::Hinge;
use crate::joints::kind::{Joint, JointType, Realisation};
use crate::joints::triad::Triad;
use crate::pair::Pair;
use crate::spring::Spring;
use crate::text::{Number, Table};

pub(super) const TYPE: JointType = JointType {
    name: "revolute",
    holds: 5,
    brings: 0,
    keys: &[
        "axis",
        "reference",
        "span",
        "ring",
        "clearance",
        "realisation",
        "limits",
        "friction",
        "rotor",
    ],
    asks: (Place::Point, Turn::Axis),
    expand,
};

/// Tolerance within which an end counts as isotropic.
const ISOTROPIC: f64 = 1e-9;

fn expand(
    table: &Table<'_>,
    joint: &Joint,
    assembly: &mut Assembly,
) -> Result<Vec<Hinge>, SceneError> {
    let triad = joint.triad(table)?;
    let size = Size::read(table)?;
    match joint.realisation {
        Realisation::Tsda => add(&joint.pair, joint, triad, size, assembly),
        Realisation::Bushing => add_bushings(joint, triad.axis, size, assembly),
    }
    .map_err(|defect| defect.refuse(table))?;
    Ok(vec![assembly.hinge(&joint.pair, triad.axis)])
}

/// Size of a revolute joint.
#[derive(Clone, Copy)]
pub(super) struct Size {
    span: f64,
    ring: f64,
}

impl Size {
    /// Reads `span` and `ring`.
    pub(super) fn read(table: &Table<'_>) -> Result<Self, SceneError> {
        let span = table.required("span", Number::positive("m"))?;
        let ring = table.optional("ring", Number::positive("m"))?.unwrap_or(span / SQRT_2);
        Ok(Self { span, ring })
    }

    /// \[m\] half the span.
    pub(super) fn half(self) -> f64 {
        0.5 * self.span
    }

    /// \[m\] the length of a TSDA.
    pub(super) fn length(self) -> f64 {
        let (half, ring) = (self.half(), self.ring);
        libm::sqrt(half * half + ring * ring)
    }

    /// Whether an end has equal axial and radial stiffness, as with the default ring.
    pub(super) fn is_isotropic(self) -> bool {
        (self.ratio() - 1.0).abs() < ISOTROPIC
    }

    /// Axial over radial stiffness of an end.
    fn ratio(self) -> f64 {
        let part = self.span / self.ring;
        0.5 * part * part
    }
}

/// Adds the group of a revolute joint between two bodies at the position of a joint.
pub(super) fn add(
    pair: &Pair,
    joint: &Joint,
    Triad { e1, e2, axis }: Triad,
    Size { span, ring }: Size,
    assembly: &mut Assembly,
) -> Result<(), Defect> {
    let half = 0.5 * span;
    let centres = [-half, half].map(|s| assembly.point_in(pair.a, joint.at_w + axis * s));
    let tips = azimuths().map(|[cosine, sine]| {
        let radius = e1 * (ring * cosine) + e2 * (ring * sine);
        assembly.point_in(pair.b, joint.at_w + radius)
    });
    let free_length = libm::sqrt(half * half + ring * ring);
    let points = Points { centres: &centres, tips: &tips, shared: true };
    assembly.add_tsdas(pair, points, free_length, joint.spring)
}

/// Adds the revolute joint as a bushing with the stiffness of the three TSDAs of each end, at that end.
fn add_bushings(
    joint: &Joint,
    axis: Vec3<f64>,
    size: Size,
    assembly: &mut Assembly,
) -> Result<(), Defect> {
    // k·Σu·u over the lines of both ends: radially 3r²/L², axially 3s²/(2L²).
    let part = size.ring / size.length();
    let (across, ratio) =
        if size.is_isotropic() { (2.0, 1.0) } else { (3.0 * part * part, size.ratio()) };
    let Spring { stiffness, damping, clearance } = joint.spring;
    let spring = Spring { stiffness: across * stiffness, damping: across * damping, clearance };
    let lever = axis * size.half();
    assembly.add_revolute(&joint.pair, joint.at_w, (lever, ratio), size.length(), spring)
}

/// Cosine and sine of 0°, 120° and 240°.
fn azimuths() -> [[f64; 2]; 3] {
    let sine = 0.5 * libm::sqrt(3.0);
    [[1.0, 0.0], [-0.5, sine], [-0.5, -sine]]
}

#[cfg(test)]
mod tests {
    use crate::example;

    fn free_length(keys: &str) -> f64 {
        let scene = example::with(&format!(
            "[[joint]]\nname = \"r\"\ntype = \"revolute\"\nbetween = [\"arm\", \"hand\"]\n\
             at = [0.5, 0.2, -0.1]\naxis = [0.1, -2, 0.3]\nstiffness = 1e5\nspan = 0.06\n{keys}"
        ));
        assert!(scene.joints[0].assembly_error < 1e-15);
        scene.model.tsdas[0].free_length
    }

    #[test]
    fn the_ring_may_be_given_and_defaults_to_orthogonal_lines() {
        assert_eq!(free_length("ring = 0.04"), libm::sqrt(0.03 * 0.03 + 0.04 * 0.04));
        assert!((free_length("") - 0.5 * libm::sqrt(3.0) * 0.06).abs() < 1e-16);
        // The reference rotates the ring and changes no length.
        assert_eq!(free_length("reference = [0, 0, 1]"), free_length(""));
    }

    #[test]
    fn the_reference_sets_the_first_azimuth() {
        let scene = example::with(
            "[[joint]]\nname = \"r\"\ntype = \"revolute\"\nbetween = [\"hand\", \"world\"]\n\
             at = [0, 0, 0]\naxis = [0, 3, 0]\nreference = [1, 5, 1]\nstiffness = 1e5\n\
             span = 2\nring = 1",
        );
        // The world is the second body here and has the ring points; y is removed from the reference.
        let [x, y, z] = scene.model.points[2].to_f64();
        let half = core::f64::consts::FRAC_1_SQRT_2;
        assert!((x - half).abs() < 1e-15 && y.abs() < 1e-15 && (z - half).abs() < 1e-15);
        // y × (1, 0, 1)/√2 = (1, 0, −1)/√2: the azimuth grows from z towards x.
        let [x, _, z] = scene.model.points[3].to_f64();
        let (sine, cosine) = libm::sincos(120.0_f64.to_radians());
        assert!((x - half * (cosine + sine)).abs() < 1e-15);
        assert!((z - half * (cosine - sine)).abs() < 1e-15);
    }
}
