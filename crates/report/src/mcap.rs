//! A run as an MCAP file, which Foxglove, Lichtblick and PlotJuggler open.
//!
//! `scene, samples => MCAP`. Messages are JSON with JSON schemas: bodies as frames and surfaces (`foxglove.FrameTransforms`,
//! `foxglove.SceneUpdate`), energies, sensors, inputs and extensions as objects of numbers.

use std::collections::BTreeMap;
use std::io::{self, Seek, Write};

use dbd_scene::{BODY_COLUMNS, Scene};
use mcap::records::MessageHeader;
use mcap::{McapError, WriteOptions, Writer};
use serde_json::{Map, Value, json};

use crate::gltf::{Surface, surfaces, upright_z};
use crate::picture::Mechanism;
use crate::recording::Sample;

/// The frame whose z axis is up.
const ROOT: &str = "map";
/// The scene's world.
const WORLD: &str = "world";

/// A file as it grows. Without [`Log::finish`] it lacks its index.
pub struct Log<W: Write + Seek> {
    writer: Writer<W>,
    transforms: u16,
    scene: u16,
    /// `None` where there are no such numbers.
    tables: Vec<Option<Table>>,
    bodies: Vec<String>,
    mechanism: Mechanism,
    /// Scalar first.
    upright: [f64; 4],
    sequence: u32,
}

/// Numbers of one topic.
struct Table {
    channel: u16,
    columns: Branch,
}

impl<W: Write + Seek> Log<W> {
    /// The file of a scene's run; each sample has further numbers with the given names and units.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn new(to: W, scene: &Scene, others: &[(String, String)]) -> io::Result<Self> {
        let options = WriteOptions::new().compression(None).library("dbd");
        let mut writer = options.create(to).map_err(failed)?;
        let transforms =
            channel(&mut writer, "/tf", "foxglove.FrameTransforms", &transforms_schema())?;
        let update = channel(&mut writer, "/scene", "foxglove.SceneUpdate", &scene_schema())?;
        let mechanism = Mechanism::of(scene);
        let sensors = scene.readouts.iter().flat_map(|readout| {
            readout
                .columns
                .iter()
                .map(|(suffix, unit)| (format!("{}{suffix}", readout.name), *unit))
        });
        let inputs = scene.inputs.iter().map(|input| (input.name.clone(), input.unit));
        let bodies = scene.body_names.iter().flat_map(|body| {
            let units = ["m", "", "m/s", "rad/s"];
            let unit =
                move |column: usize| units[[3, 7, 10].iter().filter(|end| column >= **end).count()];
            BODY_COLUMNS
                .iter()
                .enumerate()
                .map(move |(row, column)| (format!("{body}{column}"), unit(row)))
        });
        let joints = mechanism.joints.iter().map(|joint| (joint.name.clone(), "m"));
        let energies = ["kinetic", "potential", "total"].map(|name| (name.to_owned(), "J"));
        let others = others.iter().map(|(name, unit)| (name.clone(), unit.as_str()));
        let tables = [
            ("energy", energies.to_vec()),
            ("sensors", sensors.collect()),
            ("inputs", inputs.collect()),
            ("bodies", bodies.collect()),
            ("extensions", joints.collect()),
            ("controller", others.collect()),
        ];
        let tables = tables.into_iter().map(|(topic, columns): (&str, Vec<(String, &str)>)| {
            if columns.is_empty() {
                return Ok(None);
            }
            let (names, units): (Vec<_>, Vec<_>) = columns.into_iter().unzip();
            let columns = Branch::of(names.into_iter());
            let (topic, name) = (format!("/{topic}"), format!("dbd.{topic}"));
            let channel = channel(&mut writer, &topic, &name, &columns.schema(&units))?;
            Ok(Some(Table { channel, columns }))
        });
        let tables = tables.collect::<io::Result<_>>()?;
        let upright = upright_z(mechanism.gravity);
        let bodies = scene.body_names.clone();
        Ok(Self {
            writer,
            transforms,
            scene: update,
            tables,
            bodies,
            mechanism,
            upright,
            sequence: 0,
        })
    }

    /// Writes a sample.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn push(&mut self, sample: &Sample<'_>) -> io::Result<()> {
        let Sample { time, state, readings, energy, extensions, others } = *sample;
        let stamp = stamp(time);
        if self.sequence == 0 {
            let entities = self.entities(&stamp);
            self.write(self.scene, time, &json!({ "deletions": [], "entities": entities }))?;
        }
        let root = transform(&stamp, ROOT, WORLD, [0.0; 3], self.upright);
        let moved = self.bodies.iter().zip(&state.bodies).map(|(name, body)| {
            let (position, orientation) = (body.position.to_f64(), body.orientation.to_f64());
            transform(&stamp, WORLD, name, position, orientation)
        });
        let all: Vec<Value> = std::iter::once(root).chain(moved).collect();
        self.write(self.transforms, time, &json!({ "transforms": all }))?;
        let mut bodies = Vec::with_capacity(BODY_COLUMNS.len() * state.bodies.len());
        for body in &state.bodies {
            bodies.extend(body.position.to_f64());
            bodies.extend(body.orientation.to_f64());
            bodies.extend(body.velocity.to_f64());
            bodies.extend(body.angular_velocity.to_f64());
        }
        let inputs: Vec<f64> = state.signals.iter().map(|signal| signal.value).collect();
        let energies = [energy.kinetic, energy.potential(), energy.total()];
        let values: [&[f64]; 6] = [&energies, readings, &inputs, &bodies, extensions, others];
        for (row, values) in values.iter().enumerate() {
            if let Some(Table { channel, columns }) = &self.tables[row] {
                let (channel, message) = (*channel, columns.message(values));
                self.write(channel, time, &message)?;
            }
        }
        self.sequence += 1;
        Ok(())
    }

    /// Completes the file.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn finish(mut self) -> io::Result<()> {
        self.writer.finish().map(drop).map_err(failed)
    }

    fn write(&mut self, channel_id: u16, time: f64, message: &Value) -> io::Result<()> {
        let log_time = nanoseconds(time);
        let header =
            MessageHeader { channel_id, sequence: self.sequence, log_time, publish_time: log_time };
        let text = serde_json::to_vec(message)?;
        self.writer.write_to_known_channel(&header, &text).map_err(failed)
    }

    /// The ground and the bodies, each in its frame.
    fn entities(&self, stamp: &Value) -> Vec<Value> {
        let frames = std::iter::once(WORLD).chain(self.bodies.iter().map(String::as_str));
        let entities = surfaces(&self.mechanism).into_iter().zip(frames).map(|(surfaces, frame)| {
            let triangles: Vec<Value> = surfaces.iter().map(triangles).collect();
            json!({
                "timestamp": stamp, "frame_id": frame, "id": frame, "frame_locked": true,
                "lifetime": { "sec": 0, "nsec": 0 }, "metadata": [], "arrows": [], "cubes": [], "spheres": [],
                "cylinders": [], "lines": [], "triangles": triangles, "texts": [], "models": [],
            })
        });
        entities.collect()
    }
}

fn failed(error: McapError) -> io::Error {
    match error {
        McapError::Io(error) => error,
        error => io::Error::other(error),
    }
}

fn channel<W: Write + Seek>(
    writer: &mut Writer<W>,
    topic: &str,
    name: &str,
    schema: &Value,
) -> io::Result<u16> {
    let schema =
        writer.add_schema(name, "jsonschema", &serde_json::to_vec(schema)?).map_err(failed)?;
    writer.add_channel(schema, topic, "json", &BTreeMap::new()).map_err(failed)
}

/// \[ns\].
fn nanoseconds(time: f64) -> u64 {
    (time * 1e9).round() as u64
}

fn stamp(time: f64) -> Value {
    let whole = nanoseconds(time);
    json!({ "sec": whole / 1_000_000_000, "nsec": whole % 1_000_000_000 })
}

fn vector([x, y, z]: [f64; 3]) -> Value {
    json!({ "x": x, "y": y, "z": z })
}

/// A rotation, scalar first.
fn quaternion([w, x, y, z]: [f64; 4]) -> Value {
    json!({ "x": x, "y": y, "z": z, "w": w })
}

fn transform(stamp: &Value, parent: &str, child: &str, at: [f64; 3], turn: [f64; 4]) -> Value {
    json!({
        "timestamp": stamp, "parent_frame_id": parent, "child_frame_id": child,
        "translation": vector(at), "rotation": quaternion(turn),
    })
}

fn triangles(surface: &Surface) -> Value {
    let point = |at: &[f32; 3]| vector(at.map(f64::from));
    let [r, g, b] = surface.colour.map(|part| f64::from(part) / 255.0);
    json!({
        "pose": { "position": vector([0.0; 3]), "orientation": quaternion([1.0, 0.0, 0.0, 0.0]) },
        "points": surface.positions.iter().map(point).collect::<Vec<_>>(),
        "color": { "r": r, "g": g, "b": b, "a": 1.0 }, "colors": [], "indices": surface.triangles,
    })
}

/// Numbers by the parts of their names between dots.
#[derive(Debug, PartialEq)]
enum Branch {
    /// The column.
    Number(usize),
    Below(Vec<(String, Self)>),
}

impl Branch {
    fn of(names: impl Iterator<Item = String>) -> Self {
        let mut all = Vec::new();
        for (column, name) in names.enumerate() {
            insert(&mut all, &name, column);
        }
        Self::Below(all)
    }

    /// An object; undefined numbers are null.
    fn message(&self, values: &[f64]) -> Value {
        match self {
            Self::Number(column) => json!(values.get(*column)),
            Self::Below(below) => {
                let parts = below.iter().map(|(name, part)| (name.clone(), part.message(values)));
                Value::Object(parts.collect())
            }
        }
    }

    /// Its schema, with a unit per column.
    fn schema(&self, units: &[&str]) -> Value {
        match self {
            Self::Number(column) => {
                json!({ "type": "number", "description": format!("[{}]", units[*column]) })
            }
            Self::Below(below) => {
                let parts = below.iter().map(|(name, part)| (name.clone(), part.schema(units)));
                json!({ "type": "object", "properties": parts.collect::<Map<_, _>>() })
            }
        }
    }
}

fn insert(into: &mut Vec<(String, Branch)>, name: &str, column: usize) {
    let parts = name.split_once('.').filter(|(first, rest)| !first.is_empty() && !rest.is_empty());
    let Some((first, rest)) = parts else {
        return into.push((name.into(), Branch::Number(column)));
    };
    match into.iter_mut().find(|(name, _)| name == first) {
        Some((_, Branch::Below(below))) => insert(below, rest, column),
        // A number has this name: both are at this level.
        Some((_, Branch::Number(_))) => into.push((name.into(), Branch::Number(column))),
        None => {
            let mut below = Vec::new();
            insert(&mut below, rest, column);
            into.push((first.into(), Branch::Below(below)));
        }
    }
}

/// The schema of an object.
fn object(properties: &Value) -> Value {
    json!({ "type": "object", "properties": properties })
}

fn list(items: &Value) -> Value {
    json!({ "type": "array", "items": items })
}

fn numbers(names: &[&str]) -> Value {
    object(&names.iter().map(|name| ((*name).to_owned(), json!({ "type": "number" }))).collect())
}

fn time_schema() -> Value {
    let part = json!({ "type": "integer", "minimum": 0 });
    object(&json!({ "sec": part, "nsec": part }))
}

/// That part of the schema `foxglove.FrameTransforms` that is written.
fn transforms_schema() -> Value {
    let text = json!({ "type": "string" });
    object(&json!({ "transforms": list(&object(&json!({
        "timestamp": time_schema(), "parent_frame_id": text, "child_frame_id": text,
        "translation": numbers(&["x", "y", "z"]), "rotation": numbers(&["x", "y", "z", "w"]),
    }))) }))
}

/// That part of the schema `foxglove.SceneUpdate` that is written.
fn scene_schema() -> Value {
    let (text, point) = (json!({ "type": "string" }), numbers(&["x", "y", "z"]));
    let pose = object(&json!({ "position": point, "orientation": numbers(&["x", "y", "z", "w"]) }));
    let colour = numbers(&["r", "g", "b", "a"]);
    let triangles = object(&json!({
        "pose": pose, "points": list(&point), "color": colour, "colors": list(&colour),
        "indices": list(&json!({ "type": "integer", "minimum": 0 })),
    }));
    let entity = object(&json!({
        "timestamp": time_schema(), "frame_id": text, "id": text, "lifetime": time_schema(),
        "frame_locked": { "type": "boolean" }, "triangles": list(&triangles),
    }));
    object(&json!({ "deletions": list(&object(&json!({}))), "entities": list(&entity) }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_with_dots_are_objects() {
        let names = ["tip.x", "tip.y", "rate", "rate.of", ".odd", "tip.far.z"];
        let tree = Branch::of(names.iter().map(|name| (*name).to_owned()));
        let message = tree.message(&[1.0, 2.0, f64::NAN, 4.0, 5.0, 6.0]);
        let expected = json!({
            "tip": { "x": 1.0, "y": 2.0, "far": { "z": 6.0 } },
            "rate": null, "rate.of": 4.0, ".odd": 5.0,
        });
        assert_eq!(message, expected);
        let schema = tree.schema(&["m", "m", "rad/s", "", "N", "m"]);
        assert_eq!(schema["properties"]["tip"]["properties"]["x"]["description"], "[m]");
        assert_eq!(schema["properties"]["rate"]["type"], "number");
    }

    #[test]
    fn times_are_whole_nanoseconds() {
        assert_eq!(stamp(1.5e-3), json!({ "sec": 0, "nsec": 1_500_000 }));
        assert_eq!(stamp(2.000_000_001), json!({ "sec": 2, "nsec": 1 }));
    }
}
