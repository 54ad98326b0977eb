//! `link`: a body between two points.
//!
//! `table, places => centre of mass, orientation, ends`. One axis of the body points from the first point to the
//! second; the rotation about it is the smallest possible or given by a reference.

mod attitude;

pub(crate) use attitude::axes_of;

use dbd_kernel::Vec3;

use crate::error::SceneError;
use crate::points::{Places, PrecisePlace, precise_direction};
use crate::precise::{Precise, PreciseVector};
use crate::text::{Choice, Number, Table, Value};

/// The keys of a link.
pub(crate) const KEYS: &[&str] = &["from", "to", "along", "reference", "centre", "length"];

/// Points closer than this fraction of their coordinates coincide.
const COINCIDENT: f64 = 1e-12;

/// Largest relative difference between a given length and the points' distance.
const FITTING: f64 = 1e-9;

/// A body between two points.
#[derive(Clone, Debug)]
pub(crate) struct Link {
    /// \[m\] centre of mass, world.
    pub(crate) position: PreciseVector,
    /// Body → world, scalar first.
    pub(crate) orientation: [f64; 4],
    /// \[m\] between its ends.
    pub(crate) length: Precise,
    /// The body's axis along it: 0, 1 or 2.
    pub(crate) along: usize,
    /// Its ends that have names.
    pub(crate) ends: Vec<End>,
}

/// An end of a link.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct End {
    /// The point where it is, or to which assembly moves it.
    pub(crate) point: String,
    /// \[m\] position from the centre of mass, body axes.
    pub(crate) place: Vec3<f64>,
}

/// Reads a link. With `is_assembled` an end may lie off its point; assembly moves it there.
pub(crate) fn read(
    table: &Table<'_>,
    places: &Places,
    is_assembled: bool,
) -> Result<Link, SceneError> {
    let from = table.required("from", PrecisePlace(places))?;
    let to = table.required("to", PrecisePlace(places))?;
    let along = table.optional("along", Choice(&["x", "y", "z"]))?.unwrap_or(0);
    let share = table.optional("centre", Number::any(""))?.unwrap_or(0.5);

    let arm = to - from;
    let apart = arm.length().nearest();
    let coordinates = [from, to].map(|place| place.nearest().to_f64());
    let largest = coordinates.as_flattened().iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    let Some(direction) = arm.unit().filter(|_| apart > COINCIDENT * largest) else {
        let problem = format!("coincides with `from`, at most {largest:?} m from the origin");
        let help = "give two different points";
        return Err(table.refuse_value("to", &problem, help));
    };
    let own = own_length(table, apart, is_assembled)?;
    let whole = own.map_or(arm, |length| direction * length.into());
    let length = own.map_or(arm.length(), Precise::from);

    let orientation = match table.has("reference") {
        true => {
            let reference = precise_direction(table, "reference")?;
            attitude::with_reference(direction, along, reference).ok_or_else(|| {
                let help = "give a direction not parallel to the link, e.g. one normal to it";
                table.refuse_value("reference", "is parallel to the link", help)
            })?
        }
        false => attitude::nearest(direction, along),
    };
    let end = |key: &str, share: f64| {
        let point = table.value(key).and_then(|value: Value<'_>| value.get().as_str());
        let mut place = [0.0; 3];
        place[along] = (length * Precise::from(share)).nearest();
        point.map(|point| End { point: point.to_owned(), place: Vec3::from_f64(place) })
    };
    let ends = [end("from", -share), end("to", 1.0 - share)].into_iter().flatten().collect();
    let position = (from + whole * share.into()).unsigned();
    Ok(Link { position, orientation, length, along, ends })
}

/// The link's length, where it is given and differs from the distance of the points.
fn own_length(
    table: &Table<'_>,
    apart: f64,
    is_assembled: bool,
) -> Result<Option<f64>, SceneError> {
    let Some(length) = table.optional("length", Number::positive("m"))? else { return Ok(None) };
    let gap = (length - apart).abs();
    if gap <= FITTING * apart {
        return Ok(None);
    }
    if !is_assembled {
        let problem = format!("is {length:?} m, but its points are {apart:?} m apart");
        let help = "omit `length` to use the distance of the points, move the points, or add \
            [assemble], which moves bodies so that joints close";
        return Err(table.refuse_value("length", &problem, help));
    }
    Ok(Some(length))
}
