//! A point in a scene: three coordinates, or the name of a point.

use std::collections::BTreeMap;

use dbd_kernel::{BodyIndex, Vec3};

use crate::assembly::{Assembly, Resolved};
use crate::error::SceneError;
use crate::nearest::nearest;
use crate::points::places::Places;
use crate::precise::PreciseVector;
use crate::shortened::shortened;
use crate::text::{Kind, Number, Numbers, Value};

/// Most names listed in a message.
const SHOWN: usize = 12;

/// A world point, while bodies and points are being read.
#[derive(Clone, Copy)]
pub(crate) struct PrecisePlace<'p>(pub(crate) &'p Places);

impl Kind for PrecisePlace<'_> {
    type Output = PreciseVector;

    fn expected(&self) -> String {
        format!("{}, or the name of a point", Numbers::<3>(Number::any("m")).expected())
    }

    fn read(&self, value: &Value<'_>) -> Result<PreciseVector, SceneError> {
        match value.get().as_str() {
            Some(name) => {
                let place = self.0.points.get(name).copied();
                place.ok_or_else(|| unknown(value, "point", name, &self.0.names[0]))
            }
            None if value.get().is_array() => {
                Numbers(Number::any("m")).read(value).map(|at: [f64; 3]| at.into())
            }
            None => Err(value.wrong_type(&self.expected())),
        }
    }
}

/// A world point.
#[derive(Clone, Copy)]
pub(crate) struct Place<'a>(pub(crate) &'a Assembly);

impl Kind for Place<'_> {
    type Output = Vec3<f64>;

    fn expected(&self) -> String {
        format!("{}, or the name of a point", Numbers::<3>(Number::any("m, world")).expected())
    }

    fn read(&self, value: &Value<'_>) -> Result<Vec3<f64>, SceneError> {
        match value.get().as_str() {
            Some(name) => {
                let place = named(self.0.points(), name, value)?;
                self.0.resolve(value, Resolved::Point(place));
                Ok(place)
            }
            None if value.get().is_array() => {
                Numbers(Number::any("m, world")).read(value).map(Vec3::from_f64)
            }
            None => Err(value.wrong_type(&self.expected())),
        }
    }
}

/// A point of a body: coordinates in its axes, or a named point: one of its own ends or a point in the world at the
/// initial pose.
#[derive(Clone, Copy)]
pub(crate) struct PlaceOf<'a> {
    pub(crate) assembly: &'a Assembly,
    pub(crate) body: BodyIndex,
}

impl Kind for PlaceOf<'_> {
    type Output = Vec3<f64>;

    fn expected(&self) -> String {
        let numbers = Numbers::<3>(Number::any("m, body axes")).expected();
        format!("{numbers}, or the name of a point")
    }

    fn read(&self, value: &Value<'_>) -> Result<Vec3<f64>, SceneError> {
        let Self { assembly, body } = *self;
        match value.get().as_str() {
            Some(name) => {
                let place = named(assembly.points(), name, value)?;
                let end = assembly.end(body, name);
                let place = end.unwrap_or_else(|| assembly.given_point_in(body, place));
                assembly.resolve(value, Resolved::Point(place));
                Ok(place)
            }
            None if value.get().is_array() => {
                let written = Vec3::from_f64(Numbers(Number::any("m, body axes")).read(value)?);
                let place = assembly.of_written(body, written);
                if place != written {
                    assembly.resolve(value, Resolved::Point(place));
                }
                Ok(place)
            }
            None => Err(value.wrong_type(&self.expected())),
        }
    }
}

/// The point of a name.
fn named(
    points: &BTreeMap<String, Vec3<f64>>,
    name: &str,
    value: &Value<'_>,
) -> Result<Vec3<f64>, SceneError> {
    points.get(name).copied().ok_or_else(|| unknown(value, "point", name, points.keys()))
}

/// The error of an unknown name.
pub(super) fn unknown<'n>(
    value: &Value<'_>,
    what: &str,
    name: &str,
    known: impl IntoIterator<Item = &'n String>,
) -> SceneError {
    let known: Vec<&str> = known.into_iter().map(String::as_str).collect();
    let all = if what == "body" { "bodies" } else { "points" };
    let mut help = match nearest(name, known.iter().copied()) {
        Some(meant) => format!("did you mean \"{meant}\"? known {all}: "),
        None if known.is_empty() => format!("the scene has no {what}"),
        None => format!("known {all}: "),
    };
    let shown: Vec<_> = known.iter().take(SHOWN).map(|name| format!("\"{name}\"")).collect();
    help += &shown.join(", ");
    if known.len() > SHOWN {
        help += &format!(" and {} more", known.len() - SHOWN);
    }
    value.refuse_with(&format!("names no {what}: \"{}\"", shortened(name)), help)
}
