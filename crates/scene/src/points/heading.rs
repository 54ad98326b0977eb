//! A direction in a scene: three numbers, or two points.

use dbd_kernel::Vec3;

use crate::assembly::{Assembly, Resolved};
use crate::direction::unit;
use crate::error::SceneError;
use crate::points::place::Place;
use crate::text::{Direction, Kind, Value};

/// A unit vector, world.
#[derive(Clone, Copy)]
pub(crate) struct Heading<'a>(pub(crate) &'a Assembly);

impl Kind for Heading<'_> {
    type Output = Vec3<f64>;

    fn expected(&self) -> String {
        format!(
            "{}, or the names of two points, from the first to the second",
            Direction.expected()
        )
    }

    fn read(&self, value: &Value<'_>) -> Result<Vec3<f64>, SceneError> {
        let entries = value.array(|| self.expected())?;
        // Three texts are components with units or names of parameters.
        if entries.len() == 3 || !entries.iter().any(|entry| entry.get().is_str()) {
            return Direction.read(value);
        }
        let entries = value.entries(2, || self.expected())?;
        let (from, to) = (&entries[0], &entries[1]);
        let [a, b] = [Place(self.0).read(from)?, Place(self.0).read(to)?];
        let heading = unit(b - a)
            .ok_or_else(|| value.refuse("has points that coincide", &self.expected()))?;
        self.0.resolve(value, Resolved::Direction(heading));
        Ok(heading)
    }
}
