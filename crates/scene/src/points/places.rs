//! Positions of points and frames of bodies, as far as they are known.

use std::collections::BTreeMap;

use dbd_kernel::Vec3;

use crate::precise::PreciseVector;

/// Positions of points and frames of bodies, as far as they are known.
#[derive(Default)]
pub(crate) struct Places {
    pub(super) points: BTreeMap<String, PreciseVector>,
    pub(super) frames: BTreeMap<String, Frame>,
    /// The names of all points and of all bodies, including those not yet read.
    pub(super) names: [Vec<String>; 2],
}

/// The frame of a body: origin, axes and velocities, world.
#[derive(Clone, Copy)]
pub(crate) struct Frame {
    /// \[m\].
    pub(crate) origin: PreciseVector,
    /// Right-handed unit vectors.
    pub(crate) axes: [PreciseVector; 3],
    /// The rotation of the axes, scalar first.
    pub(crate) orientation: [f64; 4],
    /// \[m/s\] of the origin.
    pub(crate) velocity: Vec3<f64>,
    /// \[rad/s\].
    pub(crate) spin_w: Vec3<f64>,
}

impl Frame {
    /// The world point of coordinates in the frame.
    pub(crate) fn place(&self, at: PreciseVector) -> PreciseVector {
        self.origin + at.along(self.axes)
    }

    /// The world frame.
    pub(super) fn world() -> Self {
        Self {
            origin: PreciseVector::ZERO,
            axes: PreciseVector::axes(),
            orientation: [1.0, 0.0, 0.0, 0.0],
            velocity: Vec3::ZERO,
            spin_w: Vec3::ZERO,
        }
    }
}

impl Places {
    /// No positions yet, for points and bodies of these names.
    pub(crate) fn new(points: Vec<String>, bodies: Vec<String>) -> Self {
        Self { names: [points, bodies], ..Self::default() }
    }

    /// Adds a body's frame.
    pub(crate) fn add_frame(&mut self, body: &str, frame: Frame) {
        self.frames.insert(body.to_owned(), frame);
    }

    /// The positions of all points, rounded once.
    pub(crate) fn rounded(&self) -> BTreeMap<String, Vec3<f64>> {
        self.points.iter().map(|(name, place)| (name.clone(), place.nearest())).collect()
    }
}
