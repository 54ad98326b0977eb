//! The long form of a scene: every pose and position is a number in SI, with nothing left to assemble or look up.
//!
//! `(tables, values of names, model) => text that reads back to the same bits`. Comments before or after remaining
//! items are kept. It omits `[points]`, `[parameters]`, `[assemble]`, `[defaults]`,
//! `settle`, and other forms of a body's pose and inertia. Bodies that settled have a table in `[start]`.

mod comments;
mod literal;

use std::collections::BTreeMap;

use dbd_kernel::{F64, Vec3};
use toml::de::DeValue;

use crate::assembly::Resolved;
use crate::error::SceneError;
use crate::runtime::SceneModel;
use crate::scene::Scene;
use crate::solid::Solid;
use crate::text::{Kind as _, Measure, Table, Value};
use crate::write::comments::Comments;
use crate::write::literal::{basic_string, direction, key, number, orientation, vector};

/// Tables and keys that the long form omits.
const LEFT_OUT: &[&str] = &["points", "parameters", "assemble", "defaults", "settle", "start"];

/// Lists of tables, in the order of the reference.
const MANY: &[&str] = &[
    "body",
    "joint",
    "tsda",
    "point_on_line",
    "torsion_spring",
    "load",
    "input",
    "readout",
    "geometry",
];

/// Keys with text values; other texts are numbers.
const TEXTS: &[&str] = &[
    "name",
    "description",
    "type",
    "between",
    "body",
    "target",
    "frame",
    "interpolate",
    "over",
    "offsets",
    "about",
    "shape",
    "colour",
    "realisation",
];

/// Keys of a body in the long form, besides its name.
const OF_A_BODY: &[&str] =
    &["mass", "inertia", "position", "orientation", "velocity", "angular_velocity"];

/// No rotation.
const UNTURNED: [f64; 4] = [1.0, 0.0, 0.0, 0.0];

/// Writer of a scene.
pub(crate) struct Writer<'w, 't> {
    root: &'w Table<'t>,
    scene: &'w Scene,
    resolved: &'w BTreeMap<usize, Resolved>,
    comments: Comments<'t>,
    text: String,
}

impl<'w, 't> Writer<'w, 't> {
    /// A writer of the whole scene; `own` is the text of its file.
    pub(crate) fn new(
        root: &'w Table<'t>,
        scene: &'w Scene,
        resolved: &'w BTreeMap<usize, Resolved>,
        own: &'t str,
    ) -> Self {
        Self { root, scene, resolved, comments: Comments::of(own), text: String::new() }
    }

    /// The text.
    pub(crate) fn write(mut self) -> Result<String, SceneError> {
        self.text.push_str(&self.comments.head());
        for (place, name, value) in self.root.values() {
            if LEFT_OUT.contains(&name) || MANY.contains(&name) {
                continue;
            }
            let line = format!("{} = {}", key(name), self.value(name, &value)?);
            self.line(place.start, value.span().end, &line);
        }
        for kind in MANY {
            for (row, table) in self.root.list(kind)?.iter().enumerate() {
                let start = table.start();
                self.text.push('\n');
                self.line(start, self.comments.end_of_header(start), &format!("[[{kind}]]"));
                match *kind {
                    "body" => self.body(table, row)?,
                    "joint" => self.joint(table, row)?,
                    "input" => {
                        crate::input::allow(table).and_then(|()| self.table(table, |_| true))?
                    }
                    "readout" => {
                        crate::readout::allow(table).and_then(|()| self.table(table, |_| true))?;
                    }
                    "geometry" => self.geometry(table, row)?,
                    _ => self.table(table, |_| true)?,
                }
            }
        }
        self.starts();
        Ok(self.text)
    }

    /// Writes the states at t = 0 that differ from those at which the joints are assembled.
    fn starts(&mut self) {
        let states = self.scene.model.initial.iter().zip(&self.scene.assembled_states);
        for ((now, assembled), name) in states.zip(&self.scene.body_names) {
            // −0 is not 0.
            if format!("{now:?}") == format!("{assembled:?}") {
                continue;
            }
            let (position, turn) = (vector(now.position), orientation(now.orientation.to_f64()));
            self.text.push_str(&format!(
                "\n[start.{}]\nposition = {position}\norientation = {turn}\n",
                key(name)
            ));
            let rates = [("velocity", now.velocity), ("angular_velocity", now.angular_velocity)];
            for (name, rate) in rates.into_iter().filter(|(_, rate)| *rate != Vec3::ZERO) {
                self.text.push_str(&format!("{name} = {}\n", vector(rate)));
            }
        }
    }

    /// Writes a line with the comments around its original position.
    fn line(&mut self, start: usize, end: usize, line: &str) {
        self.text.push_str(&self.comments.before(start));
        self.text.push_str(line);
        self.text.push_str(&self.comments.behind(end));
        self.text.push('\n');
    }

    /// Writes the selected keys of a table.
    fn table(
        &mut self,
        table: &Table<'t>,
        wanted: impl Fn(&str) -> bool,
    ) -> Result<(), SceneError> {
        for (place, name, value) in table.values() {
            if wanted(name) {
                let line = format!("{} = {}", key(name), self.value(name, &value)?);
                self.line(place.start, value.span().end, &line);
            }
        }
        Ok(())
    }

    /// Writes a body; numbers that are still valid are kept as written.
    fn body(&mut self, table: &Table<'t>, row: usize) -> Result<(), SceneError> {
        self.table(table, |key| ["name", "driven"].contains(&key))?;
        let model: &SceneModel<F64> = &self.scene.model;
        let (Some(body), Some(state)) =
            (model.bodies.get(row), self.scene.assembled_states.get(row))
        else {
            return Ok(());
        };
        let at_rest = Vec3::ZERO;
        for name in OF_A_BODY {
            let now = match *name {
                "mass" => Some(number(body.mass)),
                "inertia" => Some(vector(body.inertia)),
                "position" => Some(vector(state.position)),
                "orientation" => Some(orientation(state.orientation.to_f64()))
                    .filter(|_| state.orientation.to_f64() != UNTURNED),
                "velocity" => Some(vector(state.velocity)).filter(|_| state.velocity != at_rest),
                _ => Some(vector(state.angular_velocity))
                    .filter(|_| state.angular_velocity != at_rest),
            };
            let entry = table.values().into_iter().find(|(_, key, _)| key == name);
            match entry {
                Some((place, _, value)) => {
                    let written = self.value(name, &value)?;
                    // A quaternion may be written differently with the same bits.
                    let kept = match (*name, &now) {
                        ("orientation", _) => self.is_turned_as(&written, row),
                        (_, Some(now)) => is_same(&written, now),
                        (_, None) => true,
                    };
                    let text = if kept { written } else { now.unwrap_or(written) };
                    self.line(place.start, value.span().end, &format!("{name} = {text}"));
                }
                None => {
                    if let Some(now) = now {
                        self.text.push_str(&format!("{name} = {now}\n"));
                    }
                }
            }
        }
        Ok(())
    }

    /// Whether a written orientation equals that of a body.
    fn is_turned_as(&self, written: &str, row: usize) -> bool {
        let own = self.scene.assembled_states[row].orientation;
        let bits = |q: [f64; 4]| q.map(f64::to_bits);
        literal::read_orientation(written).is_some_and(|q| bits(q) == bits(own.to_f64()))
    }

    /// Writes a joint; a moving spider gets its angular velocity.
    fn joint(&mut self, table: &Table<'t>, row: usize) -> Result<(), SceneError> {
        crate::joints::allow(table)?;
        let info = self.scene.joints.get(row);
        let spider = info.and_then(|info| info.spider.as_ref());
        let body = spider.and_then(|name| self.scene.body_names.iter().position(|n| n == name));
        for (place, name, value) in table.values() {
            let mut written = self.value(name, &value)?;
            let is_given = value.get().get("angular_velocity").is_some();
            let is_set = self.scene.assembled.is_some() && !is_given;
            if let (Some(body), "spider", true) = (body, name, is_set) {
                let turning = vector(self.scene.assembled_states[body].angular_velocity);
                let open = written.trim_end_matches('}').trim_end().to_owned();
                written = format!("{open}, angular_velocity = {turning} }}");
            }
            let line = format!("{} = {written}", key(name));
            self.line(place.start, value.span().end, &line);
        }
        Ok(())
    }

    /// Writes a solid; a block is rotated back if the body's axes differ from the written ones.
    fn geometry(&mut self, table: &Table<'t>, row: usize) -> Result<(), SceneError> {
        crate::geometry::allow(table)?;
        self.table(table, |_| true)?;
        let solid = self.scene.geometry.get(row).map(|geometry| &geometry.solid);
        if let Some(Solid::Box { turn, .. }) = solid
            && *turn != UNTURNED
            && !table.has("orientation")
        {
            self.text.push_str(&format!("orientation = {}\n", orientation(*turn)));
        }
        Ok(())
    }

    /// A value on one line.
    fn value(&self, name: &str, value: &Value<'t>) -> Result<String, SceneError> {
        match self.resolved.get(&value.span().start) {
            Some(Resolved::Point(point)) => return Ok(vector(*point)),
            Some(Resolved::Direction(axis)) => return Ok(direction(*axis)),
            Some(Resolved::Turn(turn)) => return Ok(orientation(*turn)),
            Some(Resolved::Directions([a, b])) => {
                return Ok(format!("[{}, {}]", direction(*a), direction(*b)));
            }
            None => {}
        }
        Ok(match value.get() {
            DeValue::String(text) if TEXTS.contains(&name) => basic_string(text),
            // A text that is not a number is a name.
            DeValue::String(text) => match Measure.read(value) {
                Ok(quantity) => number(quantity.value),
                Err(_) => basic_string(text),
            },
            DeValue::Array(_) => {
                let entries = value.array(String::new)?;
                let entries: Result<Vec<_>, _> =
                    entries.iter().map(|entry| self.value(name, entry)).collect();
                format!("[{}]", entries?.join(", "))
            }
            DeValue::Table(_) => {
                let mut entries = Vec::new();
                for (_, name, value) in value.table("")?.values() {
                    entries.push(format!("{} = {}", key(name), self.value(name, &value)?));
                }
                match entries.is_empty() {
                    true => "{}".to_owned(),
                    false => format!("{{ {} }}", entries.join(", ")),
                }
            }
            _ => value.written().to_owned(),
        })
    }
}

/// Whether two texts are the same numbers.
fn is_same(a: &str, b: &str) -> bool {
    let numbers = |text: &str| {
        let parts = text.trim_matches(['[', ']', ' ']).split(',');
        let parts = parts.map(|part| literal::read_number(part.trim()).map(f64::to_bits));
        parts.collect::<Option<Vec<_>>>()
    };
    numbers(a).is_some_and(|a| numbers(b) == Some(a))
}
