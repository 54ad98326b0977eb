//! `[points]`: named places, and where a name may stand for one.
//!
//! `table => places`, world, at the initial pose. Points and bodies may stand on each other: a point in a
//! body's frame, a body between two points. They are read in an order in which each stands on what
//! is there.

mod forms;
mod heading;
mod order;
mod place;

use std::collections::BTreeMap;

use dbd_kernel::Vec3;

use crate::error::SceneError;
use crate::precise::PreciseVector;
use crate::text::{Table, Value};

pub(crate) use forms::{KEYS, body_frame, precise_direction};
pub(crate) use heading::Heading;
pub(crate) use order::{Node, order};
pub(crate) use place::{Place, PlaceOf, PrecisePlace};

/// Where points are, and the frames of bodies, as far as they are known.
#[derive(Default)]
pub(crate) struct Places {
    points: BTreeMap<String, PreciseVector>,
    frames: BTreeMap<String, Frame>,
    /// The names of all points and of all bodies, those included that are not read yet.
    names: [Vec<String>; 2],
}

/// The frame of a body: a place, axes and how it moves, world.
#[derive(Clone, Copy)]
pub(crate) struct Frame {
    /// \[m\].
    pub(crate) origin: PreciseVector,
    /// Right-handed unit vectors.
    pub(crate) axes: [PreciseVector; 3],
    /// The turn that they come from, scalar first.
    pub(crate) orientation: [f64; 4],
    /// \[m/s\] of the origin.
    pub(crate) velocity: Vec3<f64>,
    /// \[rad/s\].
    pub(crate) spin_w: Vec3<f64>,
}

impl Frame {
    /// Where coordinates in it are.
    pub(crate) fn place(&self, at: PreciseVector) -> PreciseVector {
        self.origin + at.along(self.axes)
    }

    /// That of the world.
    fn world() -> Self {
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
    /// None known yet, of points and bodies of these names.
    pub(crate) fn new(points: Vec<String>, bodies: Vec<String>) -> Self {
        Self { names: [points, bodies], ..Self::default() }
    }

    /// Adds a body's frame.
    pub(crate) fn add_frame(&mut self, body: &str, frame: Frame) {
        self.frames.insert(body.to_owned(), frame);
    }

    /// Reads a point.
    pub(crate) fn read(&mut self, value: &Value<'_>, name: &str) -> Result<(), SceneError> {
        let place = forms::read(value, self)?;
        self.points.insert(name.to_owned(), place);
        Ok(())
    }

    /// The places of all points, rounded once.
    pub(crate) fn rounded(&self) -> BTreeMap<String, Vec3<f64>> {
        self.points.iter().map(|(name, place)| (name.clone(), place.nearest())).collect()
    }
}

/// The points of a scene as they are written, in their order.
pub(crate) fn written<'t>(root: &Table<'t>) -> Result<Vec<(String, Value<'t>)>, SceneError> {
    let Some(value) = root.value("points") else { return Ok(Vec::new()) };
    let expected = "a table of names and places: A = [x, y, z]";
    value.table(expected)?.called("[points]").named()
}
