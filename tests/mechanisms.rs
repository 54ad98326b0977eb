//! Mechanisms at random: a tree of joints of every type and realisation, loops and single elements beside it, what
//! drives it.
//!
//! `(seed, kind) => text of a scene`. The same on every machine.

use std::fmt::Write as _;

/// Numbers by xorshift (Marsaglia 2003); the seed is not 0.
pub struct Random(pub u64);

impl Random {
    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Three in [−1, 1).
    pub fn vector(&mut self) -> [f64; 3] {
        [(); 3].map(|()| self.between(-1.0, 1.0))
    }

    /// In [`from`, `to`).
    pub fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.unit()
    }

    /// A whole number below `end`.
    pub fn below(&mut self, end: usize) -> usize {
        (self.unit() * end as f64) as usize
    }

    /// Whether one of `many` is drawn.
    pub fn one_in(&mut self, many: usize) -> bool {
        self.below(many) == 0
    }

    fn any<'a>(&mut self, of: &[&'a str]) -> &'a str {
        of[self.below(of.len())]
    }
}

/// What mechanisms at random are made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kind {
    /// Whether they lie in the plane z = 0 and step in it.
    pub planar: bool,
    /// The types of their joints; one of two revolute, spherical, universal and fixed joints is of bushings.
    pub joints: &'static [&'static str],
    /// \[1\] damping ratios of the joints, from and to, at the frequency of a joint's lighter body on it.
    pub damping: [f64; 2],
    /// Whether there are single elements, loads and inputs.
    pub driven: bool,
    /// Whether joints and points on lines have clearances.
    pub approximate: bool,
}

/// All types of joints.
pub const JOINTS: &[&str] =
    &["revolute", "spherical", "universal", "cylindrical", "translational", "fixed"];

/// \[s\] times of knots and windows are multiples of this.
pub const TICK: f64 = 0.01;

/// One in the making.
struct Mechanism {
    random: Random,
    kind: Kind,
    /// \[m\] and \[kg\] of the bodies.
    bodies: Vec<([f64; 3], f64)>,
    /// What comes after the bodies.
    joints: String,
    elements: String,
    drives: String,
}

/// The text of the scene with this seed, not 0.
#[must_use]
pub fn mechanism(seed: u64, kind: Kind) -> String {
    // The first numbers of small seeds are all small.
    let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let gravity = [random.between(-2.0, 2.0), -9.81, if kind.planar { 0.0 } else { 1.5 }];
    let mut text = format!("name = \"random {seed}\"\nduration = 1\ngravity = {gravity:?}\n");
    if kind.planar {
        text += "planar = true\n";
    }
    let [joints, elements, drives] = [(); 3].map(|()| String::new());
    let mut made = Mechanism { random, kind, bodies: Vec::new(), joints, elements, drives };
    for _ in 0..1 + made.random.below(4) {
        made.body(&mut text);
    }
    if made.bodies.len() > 1 && made.random.one_in(3) {
        made.joint(None, made.bodies.len() - 1);
    }
    if kind.driven {
        for _ in 0..1 + made.random.below(3) {
            made.element();
        }
        for _ in 0..made.random.below(3) {
            made.load();
        }
        for _ in 0..made.random.below(3) {
            made.push();
        }
    }
    text + &made.joints + &made.elements + &made.drives
}

fn name(body: Option<usize>) -> String {
    body.map_or_else(|| "world".into(), |row| format!("b{row}"))
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

impl Mechanism {
    /// A vector in the mechanism's plane, or any.
    fn vector(&mut self) -> [f64; 3] {
        let [x, y, z] = self.random.vector();
        [x, y, if self.kind.planar { 0.0 } else { z }]
    }

    /// A direction about which something turns.
    fn axis(&mut self) -> [f64; 3] {
        if self.kind.planar { [0.0, 0.0, 1.0] } else { self.direction() }
    }

    /// A direction in the mechanism's plane, or any, far from 0.
    fn direction(&mut self) -> [f64; 3] {
        loop {
            let v = self.vector();
            if v.iter().map(|c| c * c).sum::<f64>() > 0.1 {
                return v;
            }
        }
    }

    fn position(&self, body: Option<usize>) -> [f64; 3] {
        body.map_or([0.0; 3], |row| self.bodies[row].0)
    }

    /// A body on a joint to the ground or to an earlier one.
    fn body(&mut self, text: &mut String) {
        let row = self.bodies.len();
        let parent = self.random.below(row + 1).checked_sub(1);
        let (from, way) = (self.position(parent), self.direction());
        let position = [0, 1, 2].map(|i| from[i] + 0.5 * way[i]);
        let mass = self.random.between(0.5, 2.0);
        let [x, y, z] = self.random.vector().map(|c| mass * (0.004 + 0.006 * c.abs()));
        let inertia = [y + z, z + x, x + y];
        let (axis, angle) = (self.axis(), self.random.between(-2.0, 2.0));
        let (v, w) = (self.vector(), self.axis());
        let (velocity, turning) = (v.map(|c| 0.2 * c), w.map(|c| 0.5 * c));
        let _ = write!(
            text,
            "[[body]]\nname = \"b{row}\"\nmass = {mass:?}\ninertia = {inertia:?}\nposition = {position:?}\n\
             orientation = {{ axis = {axis:?}, angle = {angle:?} }}\nvelocity = {velocity:?}\n\
             angular_velocity = {turning:?}\n"
        );
        self.bodies.push((position, mass));
        self.joint(parent, row);
    }

    fn joint(&mut self, first: Option<usize>, second: usize) {
        let [a, b] = [first, Some(second)].map(|body| self.position(body));
        let share = self.random.between(0.3, 0.7);
        let at = [0, 1, 2].map(|i| a[i] + share * (b[i] - a[i]));
        let kind = self.random.any(self.kind.joints);
        let slides = matches!(kind, "cylindrical" | "translational");
        let axis = if slides && self.kind.planar { self.direction() } else { self.axis() };
        let span = self.random.between(0.06, 0.12);
        let offset = self.random.between(0.02, 0.05);
        let keys = match kind {
            "spherical" => format!("arm = {span:?}\n"),
            "universal" => format!(
                "span = {span:?}\naxes = [{axis:?}, {:?}]\n\
                 spider = {{ mass = 0.3, inertia = [4e-4, 5e-4, 6e-4] }}\n",
                cross(axis, self.direction())
            ),
            "fixed" => format!("axis = {axis:?}\nspan = {span:?}\narm = {offset:?}\n"),
            "cylindrical" => format!("axis = {axis:?}\nspan = {span:?}\noffset = {offset:?}\n"),
            "translational" => {
                let gauge = self.random.between(0.05, 0.1);
                let offsets = self.random.any(&["alike", "outward"]);
                format!(
                    "axis = {axis:?}\nspan = {span:?}\noffset = {offset:?}\ngauge = {gauge:?}\n\
                     offsets = \"{offsets}\"\n"
                )
            }
            _ => format!("axis = {axis:?}\nspan = {span:?}\n"),
        };
        let stiffness = 10_f64.powf(self.random.between(3.0, 4.3));
        let mass = first.map_or(f64::MAX, |row| self.bodies[row].1).min(self.bodies[second].1);
        let frequency = (2.0 * stiffness / mass).sqrt() / std::f64::consts::TAU;
        let [from, to] = self.kind.damping;
        let ratio = self.random.between(from, to);
        let number = self.joints.matches("[[joint]]").count();
        let _ = write!(
            self.joints,
            "[[joint]]\nname = \"j{number}\"\ntype = \"{kind}\"\nbetween = [\"{}\", \"b{second}\"]\n\
             at = {at:?}\nstiffness = {stiffness:?}\n{keys}",
            name(first)
        );
        if ratio > 0.0 {
            let _ = write!(self.joints, "damping_ratio = {ratio:?}\nfrequency = {frequency:?}\n");
        }
        if self.kind.approximate && matches!(kind, "revolute" | "spherical") {
            let _ = writeln!(self.joints, "clearance = {:?}", self.random.between(1e-4, 2e-3));
        } else if !slides && self.random.one_in(2) {
            self.joints += "realisation = \"bushing\"\n";
        }
        if self.kind.driven && kind == "revolute" && self.random.one_in(2) {
            let [spring, preload] =
                [self.random.between(5.0, 30.0), self.random.between(-1.0, 1.0)];
            let damping = 0.01 * ratio * spring;
            let _ = write!(
                self.elements,
                "[[torsion_spring]]\nbetween = [\"{}\", \"b{second}\"]\naxis = {axis:?}\n\
                 stiffness = {spring:?}\ndamping = {damping:?}\npreload = {preload:?}\n",
                name(first)
            );
        }
        if self.kind.driven && kind == "revolute" && self.random.one_in(3) {
            self.input("joint_torque", &format!("target = \"j{number}\"\n"), 2.0);
        }
        if self.kind.driven && first.is_none() && self.random.one_in(3) {
            let axis = self.direction();
            let keys = format!("target = \"j{number}\"\naxis = {axis:?}\n");
            self.input("anchor", &keys, 0.01);
        }
    }

    /// A TSDA or a point on a line between two bodies or a body and the ground.
    fn element(&mut self) {
        let second = self.random.below(self.bodies.len());
        let first = self.random.below(second + 1).checked_sub(1);
        let between = format!("[\"{}\", \"b{second}\"]", name(first));
        let points = [self.vector(), self.vector()].map(|v| v.map(|c| 0.3 * c));
        let stiffness = self.random.between(20.0, 100.0);
        let damping = self.random.between(0.0, 1.0) * self.kind.damping[1];
        let law = format!("stiffness = {stiffness:?}\ndamping = {damping:?}\n");
        let number = self.elements.matches("[[").count();
        let free_length = self.random.between(-0.2, 0.5).max(0.0);
        if self.random.one_in(3) {
            let direction = self.direction();
            let _ = write!(
                self.elements,
                "[[point_on_line]]\nname = \"e{number}\"\nbetween = {between}\nline_point = {:?}\n\
                 line_direction = {direction:?}\npoint = {:?}\n{law}free_length = {:?}\n",
                points[0],
                points[1],
                0.3 * free_length
            );
            if self.kind.approximate && free_length == 0.0 {
                let _ =
                    writeln!(self.elements, "clearance = {:?}", self.random.between(1e-3, 0.02));
            }
            return;
        }
        let _ = write!(
            self.elements,
            "[[tsda]]\nname = \"e{number}\"\nbetween = {between}\npoints = {points:?}\n{law}\
             free_length = {free_length:?}\n"
        );
        if free_length > 0.0 && self.random.one_in(2) {
            self.input("actuator", &format!("target = \"e{number}\"\n"), 5.0);
        }
    }

    fn load(&mut self) {
        let body = self.random.below(self.bodies.len());
        let (force, torque) = (self.vector().map(|c| 5.0 * c), self.axis().map(|c| 0.2 * c));
        let frame = self.random.any(&["world", "body"]);
        let from = TICK * self.random.below(4) as f64;
        let until = from + TICK * (1 + self.random.below(5)) as f64;
        let _ = write!(
            self.drives,
            "[[load]]\nbody = \"b{body}\"\nforce = {force:?}\ntorque = {torque:?}\nframe = \"{frame}\"\n\
             from = {from:?}\nuntil = {until:?}\n"
        );
    }

    /// A force or a torque on a body.
    fn push(&mut self) {
        let body = self.random.below(self.bodies.len());
        let frame = self.random.any(&["world", "body"]);
        let keys = format!("body = \"b{body}\"\nframe = \"{frame}\"\n");
        if self.random.one_in(2) {
            let axis = self.axis();
            self.input("torque", &format!("{keys}axis = {axis:?}\n"), 0.5);
        } else {
            let (point, axis) = (self.vector().map(|c| 0.2 * c), self.direction());
            self.input("force", &format!("{keys}point = {point:?}\naxis = {axis:?}\n"), 5.0);
        }
    }

    /// An input with a value or a table, of values up to `most`.
    fn input(&mut self, kind: &str, keys: &str, most: f64) {
        let number = self.drives.matches("[[input]]").count();
        let mut value = || most * self.random.between(-1.0, 1.0);
        let drive = if value() < 0.0 && kind != "anchor" {
            format!("value = {:?}\n", value())
        } else {
            let table = [0.0, 2.0, 3.0, 6.0].map(|tick| [tick * TICK, value()]);
            // Ground that jumps would throw what hangs from it.
            let held = kind != "anchor" && value() > 0.0;
            let interpolate = if held { "held" } else { "linear" };
            format!("table = {table:?}\ninterpolate = \"{interpolate}\"\n")
        };
        let _ = write!(
            self.drives,
            "[[input]]\nname = \"i{number}\"\ntype = \"{kind}\"\n{keys}{drive}"
        );
    }
}
