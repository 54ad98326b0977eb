//! Resolved values of the scene text: coordinates of named points, directions after bodies have moved.
//!
//! Stored by position in the text, for the long form of the scene.

use std::collections::BTreeMap;

use dbd_kernel::Vec3;

use crate::assembly::Assembly;
use crate::text::Value;

/// A resolved value.
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
    /// Stores the resolved form of a value.
    pub(crate) fn resolve(&self, value: &Value<'_>, resolved: Resolved) {
        self.resolved.borrow_mut().insert(value.span().start, resolved);
    }

    /// Stores the resolved form of a direction if it differs from the written one.
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

    /// The resolved values by their position in the text.
    pub(crate) fn resolved(&self) -> BTreeMap<usize, Resolved> {
        self.resolved.borrow().clone()
    }

    /// Whether a body has been moved from its given pose.
    pub(crate) fn has_moved(&self, row: usize) -> bool {
        self.given.contains_key(&row)
    }
}
