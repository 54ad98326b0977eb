//! Symbols of joints, springs, ground and forces in a view.
//!
//! `(mark, frame) => SVG`. Their size is the paper's; axes and directions are the mechanism's.

use std::f64::consts::TAU;

use dbd_kernel::Vec3;

use crate::picture::ink::{Point, circle, line, path, through};
use crate::picture::mechanism::{ForceKind, ForceMark, GuideMark, JointKind, JointMark, Mechanism};
use crate::picture::mechanism::{InteractionMark, SpringMark, TorsionMark};
use crate::picture::paths::{directions, ground, head, offset, zigzag};
use crate::picture::view::Frame;

/// A direction that shows less of itself than this leads out of the paper.
const OUT_OF_PAPER: f64 = 0.12;

/// One view's symbols.
pub(crate) struct Symbols<'s> {
    pub(crate) mechanism: &'s Mechanism,
    pub(crate) frame: &'s Frame,
}

impl Symbols<'_> {
    fn size(&self) -> f64 {
        self.frame.symbols
    }

    /// A direction on paper of unit length; `None` where it leads out of it.
    fn shown(&self, direction: Vec3<f64>) -> Option<Point> {
        let (x, y) = self.frame.on_paper(direction);
        let length = libm::hypot(x, y);
        (length > OUT_OF_PAPER).then(|| (x / length, y / length))
    }

    /// A joint's axes, and its ground where it has one.
    pub(crate) fn beneath(&self, text: &mut String, joint: &JointMark) {
        let (at, s) = (self.frame.at(self.mechanism.place(&joint.places[0])), self.size());
        let axis = joint.axes.first().map(|axis| self.mechanism.along(axis));
        let shown = axis.and_then(|axis| self.shown(axis));
        if joint.places.iter().any(|place| place.body.is_none()) {
            self.support(text, at, joint.kind, shown);
        }
        if joint.kind == JointKind::Universal {
            return;
        }
        if let Some(axis) = axis.filter(|_| shown.is_some()) {
            let reach = if joint.kind == JointKind::Revolute { 18.0 } else { 26.0 };
            let ends = [-reach, reach].map(|pixels| self.frame.off(at, axis, pixels * s));
            line(text, "axis", &ends);
        }
    }

    /// The ground of a joint.
    fn support(&self, text: &mut String, at: Point, kind: JointKind, axis: Option<Point>) {
        let s = self.size();
        let sliding = matches!(kind, JointKind::Translational | JointKind::Cylindrical);
        let lines = match axis.filter(|_| sliding) {
            Some((x, y)) => {
                // Below the slider, or to its right where it slides upwards.
                let (x, y) = if (x, -y) > (0.0, 0.0) { (x, y) } else { (-x, -y) };
                let foot = offset(at, ((x, y), (-y, x)), 0.0, 9.0 * s);
                ground(foot, (x, y), 30.0 * s, s)
            }
            None if kind == JointKind::Fixed || sliding => {
                ground((at.0, at.1 + 8.0 * s), (1.0, 0.0), 14.0 * s, s)
            }
            None => {
                let below = at.1 + 15.0 * s;
                let corners = [(at.0 - 8.0 * s, below), at, (at.0 + 8.0 * s, below)];
                path(text, "joint", &through(&corners, true));
                ground((at.0, below), (1.0, 0.0), 14.0 * s, s)
            }
        };
        hatched(text, &lines);
    }

    /// The symbol of a joint.
    pub(crate) fn joint(&self, text: &mut String, joint: &JointMark) {
        let at = self.frame.at(self.mechanism.place(&joint.places[0]));
        let axes: Vec<Vec3<f64>> =
            joint.axes.iter().map(|axis| self.mechanism.along(axis)).collect();
        let shown: Vec<Option<Point>> = axes.iter().map(|axis| self.shown(*axis)).collect();
        joint_symbol(text, at, joint.kind, shown.first().copied().flatten(), self.size());
        if joint.kind == JointKind::Universal {
            for axis in axes {
                let ends = [-8.5, 8.5].map(|reach| self.frame.off(at, axis, reach * self.size()));
                line(text, "ink", &ends);
            }
        }
    }

    /// A spring, with the ground where an end has it.
    pub(crate) fn spring(&self, text: &mut String, spring: &SpringMark) {
        let [from, to] = spring.ends.map(|end| self.frame.at(self.mechanism.place(&end)));
        let s = self.size();
        let class = if spring.driven { "force" } else { "ink" };
        for (end, other, place) in [(from, to, spring.ends[0]), (to, from, spring.ends[1])] {
            if place.body.is_none() {
                let outward = directions(other, end).map_or((0.0, 1.0), |(along, _)| along);
                // The hatching lies to the right of the line's direction.
                hatched(text, &ground(end, (outward.1, -outward.0), 12.0 * s, s));
            } else {
                circle(text, "full", end, 2.4 * s);
            }
        }
        match zigzag(from, to, s) {
            Some(points) => line(text, class, &points),
            // Bushings have no length.
            None => bushing(text, from, class, s),
        }
    }

    /// A point on a line.
    pub(crate) fn guide(&self, text: &mut String, guide: &GuideMark) {
        let [foot, point] =
            [guide.line, guide.point].map(|place| self.frame.at(self.mechanism.place(&place)));
        let direction = self.mechanism.along(&guide.direction);
        let s = self.size();
        let ends = [-34.0, 34.0].map(|pixels| self.frame.off(foot, direction, pixels * s));
        line(text, "guide", &ends);
        if let Some((along, _)) = directions(ends[1], ends[0]).filter(|_| guide.line.body.is_none())
        {
            hatched(text, &ground(ends[0], (along.1, -along.0), 9.0 * s, s));
        }
        line(text, "thin", &[foot, point]);
        path(text, "joint", &through(&diamond(point, 4.5 * s), true));
    }

    /// A torsion spring as a spiral about its axis.
    pub(crate) fn torsion(&self, text: &mut String, torsion: &TorsionMark) {
        let centre = self.frame.at(self.mechanism.place(&torsion.at));
        let axis = self.mechanism.along(&torsion.axis);
        let s = self.size();
        let points = self.around(centre, axis, 0.6, 2.1 * TAU, &|share| (7.0 + 5.0 * share) * s);
        line(text, "ink", &points);
    }

    /// An interaction: a dashed line between its points, with a bar for a plane, or an arc about its axis.
    pub(crate) fn interaction(&self, text: &mut String, interaction: &InteractionMark) {
        let s = self.size();
        if let Some(ends) = &interaction.ends {
            let [from, to] = ends.map(|end| self.frame.at(self.mechanism.place(&end)));
            line(text, "guide", &[from, to]);
            circle(text, "full", to, 2.4 * s);
            match interaction.normal.map(|normal| self.shown(self.mechanism.along(&normal))) {
                // The hatching lies behind the plane.
                Some(Some((x, y))) => {
                    let lines = ground(from, (-y, x), 16.0 * s, s);
                    let shown = if ends[0].body.is_none() { lines.len() } else { 1 };
                    hatched(text, lines.get(..shown).unwrap_or_default());
                }
                Some(None) => circle(text, "ink", from, 7.0 * s),
                None => circle(text, "full", from, 2.4 * s),
            }
        }
        if let Some(axis) = &interaction.axis {
            let centre = self.frame.at(self.mechanism.place(&interaction.at));
            let axis = self.mechanism.along(axis);
            line(text, "ink", &self.around(centre, axis, -0.6, 0.6 * TAU, &|_| 15.0 * s));
        }
    }

    /// Points about an axis, by their final angle and their radius \[pixels\].
    fn around(
        &self,
        (x, y): Point,
        axis: Vec3<f64>,
        begin: f64,
        turn: f64,
        radius: &dyn Fn(f64) -> f64,
    ) -> Vec<Point> {
        let [e1, e2] = axis.normals();
        let count = (turn.abs() * 24.0 / TAU).ceil().max(2.0) as u32;
        let point = |n: u32| {
            let share = f64::from(n) / f64::from(count);
            let angle = begin + share * turn;
            let arm = e1 * libm::cos(angle) + e2 * libm::sin(angle);
            let (right, down) = self.frame.on_paper(arm);
            (x + radius(share) * right, y + radius(share) * down)
        };
        (0..=count).map(point).collect()
    }

    /// A load or an input.
    pub(crate) fn force(&self, text: &mut String, force: &ForceMark) {
        let at = self.frame.at(self.mechanism.place(&force.at));
        let direction = self.mechanism.along(&force.direction);
        let s = self.size();
        match force.kind {
            ForceKind::Force => self.arrow(text, at, direction, (10.0 * s, 44.0 * s), "force"),
            ForceKind::Shift => {
                let below = (at.0, at.1 + 28.0 * s);
                self.arrow(text, below, direction, (0.0, 18.0 * s), "force");
                self.arrow(text, below, -direction, (0.0, 18.0 * s), "force");
            }
            ForceKind::Torque => {
                let points = self.around(at, direction, 0.3, 0.75 * TAU, &|_| 18.5 * s);
                line(text, "force", &points);
                let last = points.len() - 1;
                let back = points[last.saturating_sub(2)];
                if let Some((along, _)) = directions(back, points[last]) {
                    let tip = offset(points[last], (along, (0.0, 0.0)), 5.0 * s, 0.0);
                    path(text, "head", &through(&head(tip, along, 9.0 * s), true));
                }
            }
        }
    }

    /// An arrow between two distances from a point; an arrow out of the paper is a circle with its head or its tail.
    pub(crate) fn arrow(
        &self,
        text: &mut String,
        at: Point,
        direction: Vec3<f64>,
        (begin, end): (f64, f64),
        class: &str,
    ) {
        let s = self.size();
        let Some(along) = self.shown(direction) else {
            let toward = direction.dot(self.frame.view.toward) > 0.0;
            return out_of_paper(text, at, toward, class, 6.0 * s);
        };
        let (x, y) = self.frame.on_paper(direction);
        let length = libm::hypot(x, y).max(0.35);
        let reach = |pixels: f64| offset(at, (along, (0.0, 0.0)), pixels * length, 0.0);
        let size = 9.0 * s;
        line(text, class, &[reach(begin), offset(reach(end), (along, along), -0.7 * size, 0.0)]);
        let solid = if class == "force" { "head" } else { "full" };
        path(text, solid, &through(&head(reach(end), along, size), true));
    }
}

/// An arrow out of the paper, by its head, or into it, by its tail.
pub(crate) fn out_of_paper(text: &mut String, at: Point, toward: bool, class: &str, radius: f64) {
    let fill = if class == "force" { "head" } else { "full" };
    circle(text, class, at, radius);
    if toward {
        circle(text, fill, at, 0.35 * radius);
    } else {
        let (x, y) = at;
        let r = 0.7 * radius;
        let (x, y) = ((x - r, x + r), (y - r, y + r));
        line(text, class, &[(x.0, y.0), (x.1, y.1)]);
        line(text, class, &[(x.0, y.1), (x.1, y.0)]);
    }
}

fn hatched(text: &mut String, lines: &[[Point; 2]]) {
    let [base, hatching @ ..] = lines else { return };
    line(text, "ink", base);
    let data: String = hatching.iter().map(|line| through(line, false)).collect();
    path(text, "thin", &data);
}

fn diamond((x, y): Point, half: f64) -> [Point; 4] {
    [(x - half, y), (x, y - half), (x + half, y), (x, y + half)]
}

/// A spring without length.
pub(crate) fn bushing(text: &mut String, at: Point, class: &str, symbols: f64) {
    circle(text, class, at, 7.0 * symbols);
    circle(text, class, at, 2.5 * symbols);
}

/// The symbol of a joint; `axis` on paper where it does not lead out of it.
pub(crate) fn joint_symbol(
    text: &mut String,
    at: Point,
    kind: JointKind,
    axis: Option<Point>,
    s: f64,
) {
    let sleeve = |text: &mut String, (x, y): Point, half: (f64, f64)| {
        let frame = ((x, y), (-y, x));
        let (along, across) = (half.0 * s, half.1 * s);
        let corners = [(-along, -across), (along, -across), (along, across), (-along, across)];
        let corners = corners.map(|(u, v)| offset(at, frame, u, v));
        path(text, "joint", &through(&corners, true));
    };
    match (kind, axis) {
        (JointKind::Fixed, _) => {
            let half = 5.5 * s;
            let (x, y) = at;
            let corners = [
                (x - half, y - half),
                (x + half, y - half),
                (x + half, y + half),
                (x - half, y + half),
            ];
            path(text, "full", &through(&corners, true));
        }
        (JointKind::Translational, axis) => {
            let half = if axis.is_some() { (13.0, 7.5) } else { (7.5, 7.5) };
            sleeve(text, axis.unwrap_or((1.0, 0.0)), half);
        }
        (JointKind::Cylindrical, Some(axis)) => {
            sleeve(text, axis, (13.0, 7.0));
            circle(text, "full", at, 2.5 * s);
        }
        (JointKind::Cylindrical, None) => {
            circle(text, "joint", at, 7.5 * s);
            circle(text, "joint", at, 3.5 * s);
        }
        (JointKind::Revolute, axis) => {
            circle(text, "joint", at, 5.5 * s);
            if axis.is_none() {
                circle(text, "full", at, 1.8 * s);
            }
        }
        (JointKind::Universal, _) => circle(text, "joint", at, 5.5 * s),
        (JointKind::Spherical, _) => {
            circle(text, "joint", at, 6.5 * s);
            circle(text, "full", at, 3.8 * s);
        }
        (JointKind::Other, _) => path(text, "joint", &through(&diamond(at, 6.5 * s), true)),
    }
}
