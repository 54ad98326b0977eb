//! Revolute joint: two axis points, three ring points, six TSDAs (Franco & Degani 2026, Fig. 5).
//!
//! The axis points at ±span/2 on the first body, the ring points in the mid plane on the second,
//! at azimuth 120°·j from the reference; each axis point is joined to each ring point, the one
//! at −span/2 first. Free length √((span/2)² + ring²). With the default ring radius span/√2 the
//! three lines of an end are orthogonal, its stiffness is k·I.

use core::f64::consts::SQRT_2;

use crate::assembly::{Assembly, Points};
use crate::direction::{least_aligned, normals};
use crate::error::SceneError;
use crate::joints::{Joint, JointType};
use crate::text::{Direction, Number, Table};

pub(super) const TYPE: JointType =
    JointType { name: "revolute", holds: 5, keys: &["axis", "reference", "span", "ring"], expand };

fn expand(table: &Table<'_>, joint: &Joint, assembly: &mut Assembly) -> Result<(), SceneError> {
    let axis = table.required("axis", Direction)?;
    let reference = table.optional("reference", Direction)?.unwrap_or(least_aligned(axis));
    let [e1, e2] = normals(axis, reference).ok_or_else(|| {
        let help = "a direction across the axis, e.g. one normal to it";
        table.refuse_value("reference", "is parallel to the axis", help)
    })?;
    let span = table.required("span", Number::positive("m"))?;
    let ring = table.optional("ring", Number::positive("m"))?.unwrap_or(span / SQRT_2);

    let pair = &joint.pair;
    let half = 0.5 * span;
    let centres = [-half, half].map(|s| assembly.point_in(pair.a, joint.at_w + axis * s));
    let tips = azimuths().map(|[cosine, sine]| {
        let radius = e1 * (ring * cosine) + e2 * (ring * sine);
        assembly.point_in(pair.b, joint.at_w + radius)
    });
    let free_length = libm::sqrt(half * half + ring * ring);
    let points = Points { centres: &centres, tips: &tips, shared: true };
    assembly
        .add_tsdas(pair, points, free_length, joint.spring)
        .map_err(|defect| defect.refuse(table))
}

/// Cosine and sine of 0°, 120° and 240°.
fn azimuths() -> [[f64; 2]; 3] {
    let sine = 0.5 * libm::sqrt(3.0);
    [[1.0, 0.0], [-0.5, sine], [-0.5, -sine]]
}
