//! Items that leave a plane, and by how much.
//!
//! `part of a scene, distance => text; its table => error with its position`.

use crate::error::SceneError;
use crate::scene::Scene;
use crate::text::Table;
use dbd_kernel::readouts::Readout;

/// A part of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The field of gravity.
    Gravity,
    /// A body by its row, spiders after those of the file.
    Body(usize),
    /// A joint by its row.
    Joint(usize),
    /// A raw element by its row: TSDAs, then points on lines.
    Raw(usize),
    /// A torsion spring by its row, those that only count revolutions after those of the file.
    TorsionSpring(usize),
    /// A load by its row.
    Load(usize),
    /// An input by its row.
    Input(usize),
    /// An interaction by the row of its law.
    Law(usize),
}

/// A part of a scene that leaves a plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Departure {
    /// Which.
    pub part: Part,
    /// The key that causes it, if any.
    pub key: &'static str,
    /// By how much, to be read after its name: "leaves the plane z = 0 by 0.02 m".
    pub problem: String,
}

/// The items that leave the best candidate plane; at least one.
#[derive(Clone, Debug, PartialEq)]
pub struct Unplanar {
    /// The name of the plane in messages: `z = 0`.
    pub plane: String,
    /// In the order of gravity, bodies, joints and raw elements, torsion springs, loads, inputs.
    pub departures: Vec<Departure>,
}

/// Called for each part that leaves the plane, with the key of its table and the amount.
pub(super) type Leaves<'l> = dyn FnMut(Part, &'static str, &str) + 'l;

impl Departure {
    /// The name of the part in messages, and by how much it leaves the plane.
    #[must_use]
    pub fn text(&self, scene: &Scene) -> String {
        let named = |kind: &str, name: Option<&String>| match name {
            Some(name) => format!("{kind} `{name}`"),
            None => kind.to_owned(),
        };
        let name = match self.part {
            Part::Gravity => "gravity".into(),
            Part::Body(row) => named("body", scene.body_names.get(row)),
            Part::Joint(row) => named("joint", scene.joints.get(row).map(|joint| &joint.name)),
            Part::Raw(row) => scene.raw_names.get(row).cloned().unwrap_or_default(),
            Part::TorsionSpring(row) => scene.torsion_names.get(row).cloned().unwrap_or_default(),
            Part::Load(row) => format!("load {}", row + 1),
            Part::Input(row) => named("input", scene.inputs.get(row).map(|input| &input.name)),
            Part::Law(row) => scene.law_names.get(row).cloned().unwrap_or_default(),
        };
        format!("{name} {}", self.problem)
    }
}

impl Unplanar {
    /// Refuses the scene at the first item that leaves the plane.
    pub(crate) fn refuse(&self, scene: &Scene, root: &Table<'_>) -> SceneError {
        let plane = &self.plane;
        let Some(first) = self.departures.first() else {
            return root.refuse_value(
                "planar",
                "fits no plane",
                "expected a scene that lies in a \
                                                                 plane",
            );
        };
        let more = match self.departures.len() - 1 {
            0 => String::new(),
            1 => "; 1 other item leaves it as well".into(),
            more => format!("; {more} other items leave it as well"),
        };
        let help = format!(
            "with `planar = true` the whole scene must lie and move in one plane, here {plane}; \
             move it there, or omit `planar`{more}"
        );
        let place = place(first.part, scene).and_then(|(kind, row)| {
            let tables = root.list(kind).ok()?;
            Some(tables.into_iter().nth(row)?.refuse_value(first.key, &first.problem, help.clone()))
        });
        place.unwrap_or_else(|| root.refuse_value(first.key, &first.problem, help))
    }
}

/// The kind of a part's table, and its row among them.
fn place(part: Part, scene: &Scene) -> Option<(&'static str, usize)> {
    let lines = &scene.file_lines;
    match part {
        Part::Gravity => None,
        Part::Body(row) if row < lines.bodies.len() => Some(("body", row)),
        Part::Body(row) => {
            let name = scene.body_names.get(row);
            let spider = scene.joints.iter().position(|joint| joint.spider.as_ref() == name);
            spider.map(|row| ("joint", row))
        }
        Part::Joint(row) => Some(("joint", row)),
        Part::Raw(row) => Some(match lines.raw_tsdas.get(row) {
            Some(row) => ("tsda", *row),
            None => ("point_on_line", row - lines.raw_tsdas.len()),
        }),
        Part::TorsionSpring(row) if row < lines.torsion_springs.len() => {
            Some(("torsion_spring", row))
        }
        Part::TorsionSpring(row) => {
            let counts = |readout: &Readout<dbd_kernel::F64>| {
                matches!(readout, Readout::JointAngle { spring, .. } | Readout::JointRate { spring }
                    if spring.row() == row)
            };
            let readout = scene.readouts.iter().position(|info| counts(&info.readout));
            readout.map(|row| ("readout", row))
        }
        Part::Load(row) => Some(("load", row)),
        Part::Input(row) => Some(("input", row)),
        Part::Law(row) => scene.law_places.get(row).copied(),
    }
}
