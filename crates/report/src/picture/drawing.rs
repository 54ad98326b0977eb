//! One view of a mechanism, far parts first.
//!
//! `(mechanism, frame) => SVG`: bodies and springs by their depth, then ground, centres of mass,
//! joints and forces, names at last. A mechanism of many parts is drawn in thin lines without symbols, with an even
//! sample of its parts to limit the file's size.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use crate::output::label_positions::{LabelPositions, Rectangle};

use crate::picture::bodies::{Drawn, body};
use crate::picture::faces::{Face, solids};
use crate::picture::ink::{Point, begin, end, path, through};
use crate::picture::mechanism::{Bounds, ForceKind, Mechanism, Outline};
use crate::picture::names::{self, Label};
use crate::picture::paths::between;
use crate::picture::symbols::Symbols;
use crate::picture::view::Frame;

/// Parts that are drawn with symbols.
const SYMBOLS: usize = 220;
/// A body longer than this fraction of the whole is drawn behind others.
const AROUND: f64 = 0.6;
/// Maximum number each of bodies, joints and springs in thin lines.
pub(crate) const LINES: usize = 2000;

/// Whether a mechanism has too many parts for symbols.
pub(crate) fn crowded(mechanism: &Mechanism) -> bool {
    let Mechanism { bodies, joints, springs, guides, torsions, interactions, forces, .. } =
        mechanism;
    let elements =
        springs.len() + guides.len() + torsions.len() + interactions.len() + forces.len();
    bodies.len() + joints.len() + elements > SYMBOLS
}

/// An even sample of rows: one of each block, at varying offsets, because a regular pattern would lose whole columns of
/// a grid.
pub(crate) fn picked(count: usize, most: usize) -> impl Iterator<Item = usize> {
    let shown = count.min(most);
    (0..shown).map(move |n| {
        let (first, next) = (n * count / shown, (n + 1) * count / shown);
        // Multiples of the golden ratio, modulo 2^32: Knuth's multiplicative hash.
        let mixed = (n as u32).wrapping_mul(2_654_435_769) >> 16;
        first + mixed as usize % (next - first)
    })
}

/// A view of a mechanism.
pub(crate) struct Drawing<'d> {
    pub(crate) mechanism: &'d Mechanism,
    pub(crate) frame: &'d Frame,
    /// Of each body.
    pub(crate) colours: &'d [usize],
}

impl Drawing<'_> {
    /// Draws a view in thin lines.
    pub(crate) fn lines(&self, text: &mut String) {
        let mechanism = self.mechanism;
        let mut by_colour: Vec<String> = Vec::new();
        for row in picked(mechanism.bodies.len(), LINES) {
            let Some(drawn) = body(mechanism, row, self.frame) else { continue };
            let colour = self.colours[row];
            if by_colour.len() <= colour {
                by_colour.resize(colour + 1, String::new());
            }
            by_colour[colour].push_str(&drawn.short());
        }
        let ground = solids(mechanism, None, &mechanism.ground, self.frame);
        let data: String =
            picked(ground.len(), LINES).map(|row| Face::short(&ground[row])).collect();
        if !data.is_empty() {
            path(text, "thin", &data);
        }
        let springs = picked(mechanism.springs.len(), LINES).map(|row| {
            let ends = mechanism.springs[row].ends;
            self.rounded(&ends.map(|end| self.frame.at(mechanism.place(&end))))
        });
        let data: String = springs.collect();
        if !data.is_empty() {
            path(text, "thin", &data);
        }
        for (colour, data) in by_colour.iter().enumerate().filter(|(_, data)| !data.is_empty()) {
            path(text, &format!("edge k{colour}"), data);
        }
        let dots = picked(mechanism.joints.len(), LINES).map(|row| {
            let place = mechanism.joints[row].places[0];
            self.rounded(&[self.frame.at(mechanism.place(&place))])
        });
        let dots: BTreeSet<String> = dots.collect();
        let data: String = dots.into_iter().collect();
        if !data.is_empty() {
            path(text, "dots", &data);
        }
    }

    fn rounded(&self, points: &[Point]) -> String {
        let points: Vec<Point> =
            points.iter().map(|(x, y)| (libm::round(*x), libm::round(*y))).collect();
        through(&points, false)
    }

    /// Draws a view with symbols; with names within `room`, where there is one. Returns how many
    /// names were left out.
    pub(crate) fn symbols(&self, text: &mut String, room: Option<&Rectangle>) -> usize {
        let mechanism = self.mechanism;
        let symbols = Symbols { mechanism, frame: self.frame };
        let bodies: Vec<Option<Drawn>> =
            (0..mechanism.bodies.len()).map(|row| body(mechanism, row, self.frame)).collect();
        let strokes = match self.frame.symbols {
            0.8.. => "large",
            0.6..0.8 => "small",
            _ => "tiny",
        };
        let _ = writeln!(text, "<g class=\"{strokes}\">");
        let mut layer = Layer::new(text);
        // Sliders and blocks before parts that may lie on them.
        let mut joints: Vec<_> = mechanism.joints.iter().collect();
        joints.sort_by_key(|joint| joint.kind);
        let named = room.is_some();
        for face in solids(mechanism, None, &mechanism.ground, self.frame) {
            layer.add(|text| face.draw(text, "still", "stands"));
        }
        for part in self.by_depth(&bodies) {
            layer.add(|text| match part {
                Part::Body(row) => {
                    let Some(drawn) = &bodies[row] else { return };
                    drawn.draw(text, self.colours[row], &title(mechanism, row));
                }
                Part::Spring(row) => {
                    let spring = &mechanism.springs[row];
                    let name = spring.name.as_deref().unwrap_or_default();
                    titled(text, named, name, |text| symbols.spring(text, spring));
                }
                Part::Guide(row) => {
                    let guide = &mechanism.guides[row];
                    let name = guide.name.as_deref().unwrap_or_default();
                    titled(text, named, name, |text| symbols.guide(text, guide));
                }
            });
        }
        joints.iter().for_each(|joint| layer.add(|text| symbols.beneath(text, joint)));
        mechanism.torsions.iter().for_each(|t| layer.add(|text| symbols.torsion(text, t)));
        for interaction in &mechanism.interactions {
            let name = interaction.name.as_deref().unwrap_or_default();
            layer.add(|text| {
                titled(text, named, name, |text| symbols.interaction(text, interaction));
            });
        }
        for drawn in bodies.iter().flatten() {
            layer.add(|text| drawn.centre_of_mass(text, self.frame.symbols));
        }
        for joint in &joints {
            layer.add(|text| titled(text, named, &joint.name, |text| symbols.joint(text, joint)));
        }
        mechanism.forces.iter().for_each(|force| layer.add(|text| symbols.force(text, force)));
        text.push_str("</g>\n");
        match room {
            Some(room) => self.names(text, &bodies, room),
            None => 0,
        }
    }

    /// Bodies, springs and guides, the farthest first; at equal depth blocks, plates, bars.
    fn by_depth(&self, bodies: &[Option<Drawn>]) -> Vec<Part> {
        let mechanism = self.mechanism;
        let far = |place| self.frame.depth(mechanism.place(place));
        // Rounding within a plane does not affect the order.
        let step = 0.1 / self.frame.scale.max(1e-300);
        let mut parts: Vec<(bool, f64, usize, Part)> = Vec::new();
        let mut add = |near: bool, depth: f64, layer, part| {
            parts.push((near, libm::round(depth / step), layer, part));
        };
        // A body around the others does not hide them.
        let mut reach = Bounds::default();
        let corners = (0..bodies.len()).flat_map(|row| mechanism.corners(row));
        corners.for_each(|corner| reach.add(corner));
        let around = |row: usize| {
            let body = &mechanism.bodies[row];
            let bar = body.shapes.is_empty() && matches!(body.outline, Outline::Bar { .. });
            !bar && mechanism.size(row).is_some_and(|size| size > AROUND * reach.longest())
        };
        for (row, drawn) in bodies.iter().enumerate() {
            if let Some(drawn) = drawn {
                let layer = match mechanism.bodies[row].outline {
                    _ if !mechanism.bodies[row].shapes.is_empty() => 1,
                    Outline::Block { .. } => 0,
                    Outline::Plate { .. } => 1,
                    Outline::Bar { .. } | Outline::Spider => 2,
                };
                add(!around(row), drawn.depth, layer, Part::Body(row));
            }
        }
        for (row, guide) in mechanism.guides.iter().enumerate() {
            add(true, far(&guide.point), 3, Part::Guide(row));
        }
        for (row, spring) in mechanism.springs.iter().enumerate() {
            let [a, b] = [far(&spring.ends[0]), far(&spring.ends[1])];
            add(true, 0.5 * (a + b), 4, Part::Spring(row));
        }
        parts.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        parts.into_iter().map(|(.., part)| part).collect()
    }

    /// Names of bodies, inputs, joints and springs.
    fn names(&self, text: &mut String, bodies: &[Option<Drawn>], room: &Rectangle) -> usize {
        let mechanism = self.mechanism;
        let at = |place| self.frame.at(mechanism.place(place));
        let mut positions = LabelPositions::new(*room);
        let mut labels = Vec::new();
        for (row, drawn) in bodies.iter().enumerate() {
            let Some(drawn) = drawn else { continue };
            drawn.strokes.iter().for_each(|[from, to]| positions.stroke(*from, *to));
            positions.mark(drawn.centre);
            labels.push(Label {
                name: mechanism.bodies[row].name.clone(),
                anchor: drawn.anchor,
                class: format!("n{}", self.colours[row]),
                worst: 400.0,
            });
        }
        let mut drives: Vec<&str> = Vec::new();
        for force in &mechanism.forces {
            let from = at(&force.at);
            let tip = match force.kind {
                ForceKind::Force => {
                    let direction = mechanism.along(&force.direction);
                    self.frame.off(from, direction, 44.0)
                }
                ForceKind::Torque => from,
                ForceKind::Shift => (from.0, from.1 + 28.0),
            };
            positions.stroke(from, tip);
            if let Some(name) = force.input.as_deref().filter(|name| !drives.contains(name)) {
                drives.push(name);
                labels.push(Label {
                    name: name.into(),
                    anchor: tip,
                    class: "drive".into(),
                    worst: 300.0,
                });
            }
        }
        let quiet = |name: &str, anchor| Label {
            name: name.into(),
            anchor,
            class: "quiet".into(),
            worst: 170.0,
        };
        for joint in &mechanism.joints {
            let at = at(&joint.places[0]);
            positions.mark(at);
            if joint.places.iter().any(|place| place.body.is_none()) {
                let (x, y) = (at.0 - 14.0, at.1 + 6.0);
                positions.stroke((x, y + 12.0), (x + 28.0, y + 12.0));
            }
            labels.push(quiet(&joint.name, at));
        }
        for spring in &mechanism.springs {
            let [from, to] = [at(&spring.ends[0]), at(&spring.ends[1])];
            positions.stroke(from, to);
            if let Some(name) = &spring.name {
                let class = if spring.driven { "drive" } else { "quiet" };
                labels.push(Label { class: class.into(), ..quiet(name, between(from, to, 0.5)) });
            }
        }
        for guide in &mechanism.guides {
            let point = at(&guide.point);
            positions.mark(point);
            labels.extend(guide.name.iter().map(|name| quiet(name, point)));
        }
        for torsion in &mechanism.torsions {
            let (x, y) = at(&torsion.at);
            positions.stroke((x - 14.0, y), (x + 14.0, y));
            labels.extend(torsion.name.iter().map(|name| quiet(name, (x, y))));
        }
        for interaction in &mechanism.interactions {
            let point = match &interaction.ends {
                Some([_, end]) => at(end),
                None => at(&interaction.at),
            };
            positions.mark(point);
            labels.extend(interaction.name.iter().map(|name| quiet(name, point)));
        }
        names::write(text, &mut positions, &labels, self.frame.centre)
    }
}

/// A part ordered by depth.
#[derive(Clone, Copy)]
enum Part {
    Body(usize),
    Spring(usize),
    Guide(usize),
}

/// Text without duplicates: identical elements behind each other are drawn once.
struct Layer<'t> {
    text: &'t mut String,
    seen: BTreeSet<String>,
}

impl<'t> Layer<'t> {
    fn new(text: &'t mut String) -> Self {
        Self { text, seen: BTreeSet::new() }
    }

    fn add(&mut self, draw: impl FnOnce(&mut String)) {
        let mut part = String::new();
        draw(&mut part);
        if !self.seen.contains(&part) {
            self.text.push_str(&part);
            self.seen.insert(part);
        }
    }
}

/// Tooltip of a part with a name, in the view with names.
fn titled(text: &mut String, named: bool, name: &str, draw: impl FnOnce(&mut String)) {
    if !named || name.is_empty() {
        return draw(text);
    }
    begin(text, &dbd_scene::shortened(name).replace(char::is_control, " "));
    draw(text);
    end(text);
}

/// Tooltip of a body.
fn title(mechanism: &Mechanism, row: usize) -> String {
    let body = &mechanism.bodies[row];
    let name = dbd_scene::shortened(&body.name).replace(char::is_control, " ");
    format!("{name}, {} kg", body.mass)
}
