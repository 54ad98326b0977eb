//! The forms of a point: coordinates, or a position relative to other points.
//!
//! `value => place`, world. Computed with 32 digits and rounded once, where the point is used.

use crate::assembly::WORLD;
use crate::direction::least_aligned;
use crate::error::SceneError;
use crate::points::place::{PrecisePlace, unknown};
use crate::points::places::{Frame, Places};
use crate::precise::{Precise, PreciseVector, sine_and_cosine};
use crate::text::{Choice, Direction, Kind as _, Number, Numbers, Table, Text, Value};

/// Every key of every form.
pub(crate) const KEYS: &[&str] = &[
    "from",
    "offset",
    "distance",
    "direction",
    "toward",
    "angle",
    "normal",
    "reference",
    "share",
    "distances",
    "side",
    "about",
    "axis",
    "frame",
    "at",
];

const FORMS: &str = "[x, y, z] in m, the name of a point, or one of { from = \"A\", offset = [x, y, z] }, \
    { from = \"A\", distance = m, direction = [x, y, z] }, { from = \"A\", distance = m, toward = \"B\" }, \
    { from = \"A\", distance = m, angle = rad }, { from = [\"A\", \"B\"], share = 0.5 }, \
    { from = [\"A\", \"B\"], distances = [m, m], side = \"left\" }, \
    { from = \"A\", about = \"O\", axis = [x, y, z], angle = rad } and { frame = \"body\", at = [x, y, z] }";

/// \[m\] Largest coordinate, as everywhere in a scene.
const GREATEST: f64 = 1e150;

/// Relative gap below which two circles touch.
const TOUCHING: f64 = 1e-14;

impl Places {
    /// Reads a point.
    pub(crate) fn read(&mut self, value: &Value<'_>, name: &str) -> Result<(), SceneError> {
        let place = read(value, self)?;
        self.points.insert(name.to_owned(), place);
        Ok(())
    }
}

/// Reads a point that depends on known ones.
fn read(value: &Value<'_>, places: &Places) -> Result<PreciseVector, SceneError> {
    let place = if value.get().is_table() {
        from_others(&value.table(FORMS)?, places)?.unsigned()
    } else if value.get().is_str() || value.get().is_array() {
        PrecisePlace(places).read(value)?
    } else {
        return Err(value.wrong_type(FORMS));
    };
    let within = |number: f64| number.abs() <= GREATEST;
    match place.nearest().to_f64().into_iter().all(within) {
        true => Ok(place),
        false => Err(value.refuse_with("is out of range", "coordinates must not exceed 1e150 m")),
    }
}

fn from_others(table: &Table<'_>, places: &Places) -> Result<PreciseVector, SceneError> {
    table.only(&[KEYS])?;
    if table.has("frame") {
        return in_frame(table, places);
    }
    let Some(from) = table.value("from") else { return Err(table.missing("from", FORMS)) };
    if from.get().as_array().is_some_and(|entries| entries.len() == 2) {
        let [a, b] = pair(&from, places)?;
        return match table.has("distances") || table.has("side") {
            true => at_distances(table, a, b),
            false => between(table, a, b),
        };
    }
    let from = PrecisePlace(places).read(&from)?;
    let has = |keys: &[&str]| keys.iter().any(|key| table.has(key));
    if has(&["about", "axis"]) {
        return turned(table, from, places);
    }
    if table.has("offset") {
        table.only(&[&["from", "offset"]])?;
        let offset: [f64; 3] = table.required("offset", Numbers(Number::any("m")))?;
        return Ok(from + offset.into());
    }
    if !has(&["direction", "toward", "angle"]) {
        let help = "add `offset`, or `distance` with `direction`, `toward` or `angle`, or \
             `axis` with `angle`";
        return Err(table.refuse("has no position relative to `from`", help));
    }
    let direction = if table.has("toward") {
        table.only(&[&["from", "distance", "toward"]])?;
        let toward = table.required("toward", PrecisePlace(places))?;
        (toward - from).unit().ok_or_else(|| {
            let help = "give another point, or a `direction`";
            table.refuse_value("toward", "coincides with `from`", help)
        })?
    } else if table.has("direction") {
        table.only(&[&["from", "distance", "direction"]])?;
        precise_direction(table, "direction")?
    } else {
        table.only(&[&["from", "distance", "angle", "normal", "reference"]])?;
        let normal = normal(table, "normal")?;
        let [e1, e2] = across(table, normal)?;
        let (sine, cosine) = sine_and_cosine(table.required("angle", Number::any("rad"))?);
        e1 * cosine + e2 * sine
    };
    let distance = table.required("distance", Number::any("m"))?;
    Ok(from + direction * distance.into())
}

/// The two points of `from`.
fn pair(value: &Value<'_>, places: &Places) -> Result<[PreciseVector; 2], SceneError> {
    let entries = value.entries(2, || "a point, or an array of two points".into())?;
    let place = |entry: &Value<'_>| PrecisePlace(places).read(entry);
    Ok([place(&entries[0])?, place(&entries[1])?])
}

/// A point at a fraction of the distance between two points.
fn between(
    table: &Table<'_>,
    a: PreciseVector,
    b: PreciseVector,
) -> Result<PreciseVector, SceneError> {
    table.only(&[&["from", "share"]])?;
    let share = table.required("share", Number::any(""))?;
    Ok(a + (b - a) * share.into())
}

/// The point of a plane through two points that has these distances from them, on one side of the line.
fn at_distances(
    table: &Table<'_>,
    a: PreciseVector,
    b: PreciseVector,
) -> Result<PreciseVector, SceneError> {
    table.only(&[&["from", "distances", "side", "normal"]])?;
    let [p, q] = table.required("distances", Numbers(Number::positive("m")))?;
    let side = table.required("side", Choice(&["left", "right"]))?;
    let normal = normal(table, "normal")?;
    let apart = (b - a).length();
    let Some(along) = (b - a).unit() else {
        let help = "give two different points";
        return Err(table.refuse_value("from", "names two coincident points", help));
    };
    let Some([_, left]) = along.normals(-normal) else {
        let help = "give a direction not parallel to the line between the two points";
        return Err(table.refuse_value("normal", "is parallel to that line", help));
    };
    let [first, second] = [p, q].map(Precise::from);
    let on_line = (first * first - second * second + apart * apart) / (apart + apart);
    let square = first * first - on_line * on_line;
    if square.nearest() < -TOUCHING * p.max(q) * p.max(q) {
        let apart = apart.nearest();
        let problem = format!("have no point in common: the points are {apart:?} m apart");
        let help = format!(
            "give two distances whose sum is at least {:?} m and whose difference is at most that",
            p + q
        );
        return Err(table.refuse_value("distances", &problem, help));
    }
    let off = if side == 0 { square.root() } else { -square.root() };
    Ok(a + along * on_line + left * off)
}

/// A point rotated about an axis.
fn turned(
    table: &Table<'_>,
    from: PreciseVector,
    places: &Places,
) -> Result<PreciseVector, SceneError> {
    table.only(&[&["from", "about", "axis", "angle"]])?;
    let about = table.optional("about", PrecisePlace(places))?.unwrap_or(PreciseVector::ZERO);
    let axis = precise_direction(table, "axis")?;
    let (sine, cosine) = sine_and_cosine(table.required("angle", Number::any("rad"))?);
    let arm = from - about;
    let along = axis * axis.dot(arm);
    Ok(about + along + (arm - along) * cosine + axis.cross(arm) * sine)
}

/// A point in the frame of a body, or of three points.
fn in_frame(table: &Table<'_>, places: &Places) -> Result<PreciseVector, SceneError> {
    table.only(&[&["frame", "at"]])?;
    let Some(value) = table.value("frame") else { return Err(table.missing("frame", FORMS)) };
    let (origin, axes) = if value.get().is_array() {
        of_points(&value, places)?
    } else {
        let frame = body_frame(&value, places)?;
        (frame.origin, frame.axes)
    };
    let at: [f64; 3] = table.required("at", Numbers(Number::any("m")))?;
    Ok(origin + PreciseVector::from(at).along(axes))
}

/// The frame of a known body.
pub(crate) fn body_frame(value: &Value<'_>, places: &Places) -> Result<Frame, SceneError> {
    let name = Text::Name.read(value)?;
    if name == WORLD {
        return Ok(Frame::world());
    }
    places.frames.get(&name).copied().ok_or_else(|| unknown(value, "body", &name, &places.names[1]))
}

/// Origin, a point on the x axis, a point of the plane of x and y.
fn of_points(
    value: &Value<'_>,
    places: &Places,
) -> Result<(PreciseVector, [PreciseVector; 3]), SceneError> {
    let entries = value.entries(3, || "the name of a body, or an array of three points".into())?;
    let place = |entry: &Value<'_>| PrecisePlace(places).read(entry);
    let [origin, x, y] = [place(&entries[0])?, place(&entries[1])?, place(&entries[2])?];
    let axes = (x - origin).unit().and_then(|x| x.normals(y - origin).map(|[y, z]| [x, y, z]));
    let help = "give three points that are not collinear: the origin, one on the x axis, one in \
        the xy plane";
    let axes = axes.ok_or_else(|| value.refuse_with("does not span a plane", help))?;
    Ok((origin, axes))
}

/// A direction; the world's z by default.
fn normal(table: &Table<'_>, key: &str) -> Result<PreciseVector, SceneError> {
    match table.has(key) {
        true => precise_direction(table, key),
        false => Ok([0.0, 0.0, 1.0].into()),
    }
}

/// The axis from which an angle about `normal` is measured, and the one at 90°.
fn across(table: &Table<'_>, normal: PreciseVector) -> Result<[PreciseVector; 2], SceneError> {
    let reference = match table.has("reference") {
        true => precise_direction(table, "reference")?,
        false => least_aligned(normal.nearest()).into(),
    };
    normal.normals(reference).ok_or_else(|| {
        let help = "give a direction not parallel to the normal, e.g. one perpendicular to \
            it";
        table.refuse_value("reference", "is parallel to the normal", help)
    })
}

/// A unit direction.
pub(crate) fn precise_direction(table: &Table<'_>, key: &str) -> Result<PreciseVector, SceneError> {
    let Some(value) = table.value(key) else {
        return Err(table.missing(key, &Direction.expected()));
    };
    // Checked like any other direction, then normalised with all digits.
    Direction.read(&value)?;
    let numbers = Direction::numbers(&value)?;
    Ok(PreciseVector::from(numbers).unit().unwrap_or(PreciseVector::ZERO))
}
