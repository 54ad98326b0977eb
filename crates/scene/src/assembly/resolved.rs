//! What values of a scene's text stand for: points by their coordinates, directions where bodies have come to.
//!
//! Kept where a value was read, for the long form of the scene.

use std::collections::BTreeMap;

use dbd_kernel::Vec3;

use crate::assembly::Assembly;
use crate::text::Value;

/// What a value stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Resolved {
    /// \[m\] coordinates.
    Point(Vec3<f64>),
    /// A unit vector.
    Direction(Vec3<f64>),
    /// A unit quaternion, scalar first.
    Turn([f64; 4]),
    /// Two unit vectors.
    Directions([Vec3<f64>; 2]),
}

impl Assembly {
    /// Says what a value stands for.
    pub(crate) fn resolve(&self, value: &Value<'_>, resolved: Resolved) {
        self.resolved.borrow_mut().insert(value.span().start, resolved);
    }

    /// Says it of a direction, where that is another than the one that is written.
    pub(crate) fn resolve_direction(
        &self,
        value: Option<Value<'_>>,
        written: Vec3<f64>,
        now: Vec3<f64>,
    ) {
        if let Some(value) = value.filter(|_| written != now) {
            self.resolve(&value, Resolved::Direction(now));
        }
    }

    /// What values stand for, by where they begin in the text.
    pub(crate) fn resolved(&self) -> BTreeMap<usize, Resolved> {
        self.resolved.borrow().clone()
    }

    /// Whether a body is elsewhere than where it was given.
    pub(crate) fn has_moved(&self, row: usize) -> bool {
        self.given.contains_key(&row)
    }
}
