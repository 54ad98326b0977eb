//! The model under construction: bodies first, then groups, torsion springs and loads.
//!
//! `checked elements => kernel model` in double precision. World points become points of their bodies by `Rᵀ·(P − x)`
//! with the rotation that the kernel uses for the inverse.

mod bushings;
mod driven;
mod moved;
mod resolved;
mod written;

pub(crate) use driven::NoAnchor;
pub(crate) use resolved::Resolved;

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::Arc;

use dbd_kernel::attitude::Attitude as _;
use dbd_kernel::energy::each_extension;
use dbd_kernel::index::{ClearanceIndex, DamperIndex};
use dbd_kernel::model::{Group, Law};
use dbd_kernel::{
    Body, BodyIndex, BodyState, F64, Geometry, Load, PointOnLine, Quaternion, State, TorsionSpring,
    Tsda, Vec3,
};

use crate::error::SceneError;
use crate::laws::{LawList, SourceRows};
use crate::pair::Pair;
use crate::runtime::SceneModel;
use crate::spring::Spring;
use crate::text::Table;

/// The name of the ground.
pub(crate) const WORLD: &str = "world";

/// A model under construction.
#[derive(Default)]
pub(crate) struct Assembly {
    model: SceneModel<F64>,
    frames: Vec<<F64 as Geometry>::Frame>,
    names: Vec<String>,
    rows: BTreeMap<String, BodyIndex>,
    /// Given states of the bodies that have been moved since.
    given: BTreeMap<usize, BodyState<F64>>,
    is_assembled: bool,
    /// Resolved values that the long form writes differently, by their position in the text.
    resolved: RefCell<BTreeMap<usize, Resolved>>,
    points: BTreeMap<String, Vec3<f64>>,
    /// \[m\] sizes of joints whose elements have no length, by group.
    sizes: BTreeMap<usize, f64>,
    /// \[kg\] masses of spiders that joints of bushings do not use, by group.
    left_out: BTreeMap<usize, f64>,
    /// Per body its own named points, from the centre of mass in body axes.
    ends: Vec<Vec<(String, Vec3<f64>)>>,
    /// Rows of the torsion springs between two bodies, ascending.
    torsions_between: BTreeMap<[u16; 2], Vec<usize>>,
    /// Per body the rotation from its principal axes to its given axes, if they differ.
    turns: Vec<Option<Quaternion<f64>>>,
}

/// Reasons why an element does not fit the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Defect {
    /// The number exceeds the index range.
    TooMany(&'static str),
    /// A derived number is out of range.
    OutOfRange,
    /// A clearance not below the free length \[m\] of its elements.
    Clearance(f64),
}

impl Defect {
    /// The error for the element.
    pub(crate) fn refuse(self, table: &Table<'_>) -> SceneError {
        match self {
            Self::TooMany(what) => {
                let problem = format!("exceeds the 16-bit index range for {what}");
                let most = if what == "bodies" { BodyIndex::FIRST_ANCHOR.into() } else { LIMIT };
                table.refuse(&problem, format!("a scene has at most {most} {what}"))
            }
            Self::OutOfRange => table.refuse(
                "has points or lengths out of the range of double precision",
                "use coordinates of at most 1e150 m and free lengths from 1e-150 to 1e150 m",
            ),
            Self::Clearance(free_length) => {
                let problem = format!("is not below the free length of {free_length:?} m");
                let help = "give a clearance in m, from 0 to below the free length of the joint's elements";
                table.refuse_value("clearance", &problem, help)
            }
        }
    }
}

/// Maximum number of bodies, points, elements or dampers: indices have 16 bits, and the last value means the world or
/// none.
const LIMIT: usize = u16::MAX as usize;

/// \[m\] Greatest coordinate and free length: squares of sums of a few of them stay finite.
const GREATEST_LENGTH: f64 = 1e150;

/// \[m\] Least free length: its square is not yet subnormal.
const LEAST_LENGTH: f64 = 1e-150;

/// The points of a group, each in the axes of its body.
#[derive(Clone, Copy)]
pub(crate) struct Points<'p> {
    /// Points of the first body, one per spring triple.
    pub(crate) centres: &'p [Vec3<f64>],
    /// Endpoints on the second body.
    pub(crate) tips: &'p [Vec3<f64>],
    /// Whether all spring triples share the endpoints.
    pub(crate) shared: bool,
}

impl Points<'_> {
    /// Endpoints per spring triple.
    fn arms(&self) -> usize {
        let triples = if self.shared { 1 } else { self.centres.len().max(1) };
        self.tips.len() / triples
    }

    /// Elements: one per spring triple and leg.
    fn elements(&self) -> usize {
        self.centres.len() * self.arms()
    }
}

/// Common data of a group of points on parallel lines.
#[derive(Clone, Copy)]
pub(crate) struct Lines {
    /// Unit direction in the first body's axes.
    pub(crate) direction: Vec3<f64>,
    /// \[m\] distance of each point from its line at rest, ≥ 0.
    pub(crate) free_length: f64,
}

impl Assembly {
    /// The body of a name, or the world.
    pub(crate) fn body(&self, name: &str) -> Option<BodyIndex> {
        if name == WORLD { Some(BodyIndex::WORLD) } else { self.rows.get(name).copied() }
    }

    /// Names of the bodies in the model's order.
    pub(crate) fn body_names(&self) -> &[String] {
        &self.names
    }

    /// The state of a body, `None` for the world.
    pub(crate) fn state(&self, body: BodyIndex) -> Option<&BodyState<F64>> {
        self.model.initial.get(body.row())
    }

    /// A world point in body axes.
    pub(crate) fn point_in(&self, body: BodyIndex, point_w: Vec3<f64>) -> Vec3<f64> {
        match self.state(body) {
            Some(state) => self.vector_in(body, point_w - state.position),
            None => point_w,
        }
    }

    /// A world vector in body axes.
    pub(crate) fn vector_in(&self, body: BodyIndex, vector_w: Vec3<f64>) -> Vec3<f64> {
        match self.frames.get(body.row()) {
            Some(frame) => F64::to_body(frame, vector_w),
            None => vector_w,
        }
    }

    /// A body point in the world, as computed by the kernel.
    pub(crate) fn place(&self, body: BodyIndex, point_b: Vec3<f64>) -> Vec3<f64> {
        match self.frames.get(body.row()) {
            Some(frame) => F64::place(frame, &point_b).0,
            None => F64::ground(&point_b),
        }
    }

    /// Relative velocity that a unit impulse causes between two free bodies: \[1/kg\] along a line through both
    /// centres, \[1/(kg·m²)\] about a unit axis in the world.
    pub(crate) fn mobility(&self, ends: [BodyIndex; 2], about: Option<Vec3<f64>>) -> f64 {
        let of = |end: BodyIndex| match (self.model.bodies.get(end.row()), about) {
            (Some(body), Some(axis_w)) => {
                let [n, inverse] = [self.vector_in(end, axis_w), body.inverse_inertia];
                n.x * n.x * inverse.x + n.y * n.y * inverse.y + n.z * n.z * inverse.z
            }
            (Some(body), None) => body.inverse_mass,
            (None, _) => 0.0,
        };
        ends.map(of).iter().sum()
    }

    /// The velocity \[m/s\] of the point of a body that is at a world point, and its angular
    /// velocity \[rad/s\], both world.
    pub(crate) fn motion(&self, body: BodyIndex, point_w: Vec3<f64>) -> (Vec3<f64>, Vec3<f64>) {
        match (self.state(body), self.frames.get(body.row())) {
            (Some(state), Some(frame)) => {
                let spin = F64::to_world(frame, state.angular_velocity);
                (state.velocity + spin.cross(point_w - state.position), spin)
            }
            _ => (Vec3::ZERO, Vec3::ZERO),
        }
    }

    /// Sets the gravitational field \[m/s²\]; a field of 0 counts as no gravity.
    pub(crate) fn set_gravity(&mut self, gravity: [f64; 3]) {
        self.model.gravity =
            if gravity == [0.0; 3] { Vec::new() } else { vec![Vec3::from_f64(gravity)] };
    }

    /// Adds a body whose name is new and returns its index.
    pub(crate) fn add_body(
        &mut self,
        name: &str,
        body: Body<f64>,
        state: BodyState<F64>,
    ) -> Result<BodyIndex, Defect> {
        let row = index(self.model.bodies.len(), 1, "bodies")?;
        if row >= BodyIndex::FIRST_ANCHOR {
            return Err(Defect::TooMany("bodies"));
        }
        self.model.bodies.push(body);
        self.model.initial.push(state);
        self.frames.push(F64::frame(&state.position, &state.orientation));
        self.names.push(name.to_owned());
        self.ends.push(Vec::new());
        self.turns.push(None);
        self.rows.insert(name.to_owned(), BodyIndex(row));
        Ok(BodyIndex(row))
    }

    /// Adds a group of TSDAs, each of `free_length` \[m\]: every centre joined to its endpoints.
    pub(crate) fn add_tsdas(
        &mut self,
        pair: &Pair,
        points: Points<'_>,
        free_length: f64,
        spring: Spring,
    ) -> Result<(), Defect> {
        if !(LEAST_LENGTH..=GREATEST_LENGTH).contains(&free_length) {
            return Err(Defect::OutOfRange);
        }
        let count = points.elements();
        let element = index(self.model.tsdas.len(), count, "TSDAs")?;
        if spring.clearance >= free_length {
            return Err(Defect::Clearance(free_length));
        }
        self.add_group(Law::Tsda, pair, points, element, spring)?;
        let tsda = Tsda::from_f64(spring.stiffness, free_length);
        self.model.tsdas.extend(std::iter::repeat_n(tsda, count));
        Ok(())
    }

    /// Adds a group of points on parallel lines: every centre lies on the line of its endpoints.
    pub(crate) fn add_lines(
        &mut self,
        pair: &Pair,
        points: Points<'_>,
        Lines { direction, free_length }: Lines,
        spring: Spring,
    ) -> Result<(), Defect> {
        if free_length != 0.0 && !(LEAST_LENGTH..=GREATEST_LENGTH).contains(&free_length) {
            return Err(Defect::OutOfRange);
        }
        let count = points.elements();
        let element = index(self.model.lines.len(), count, "points on lines")?;
        if free_length > 0.0 && spring.clearance >= free_length {
            return Err(Defect::Clearance(free_length));
        }
        self.add_group(Law::PointOnLine, pair, points, element, spring)?;
        let line = PointOnLine::from_f64(direction.to_f64(), spring.stiffness, free_length);
        self.model.lines.extend(std::iter::repeat_n(line, count));
        Ok(())
    }

    fn add_group(
        &mut self,
        law: Law,
        pair: &Pair,
        points: Points<'_>,
        element: u16,
        spring: Spring,
    ) -> Result<(), Defect> {
        let all = || points.centres.iter().chain(points.tips);
        let within = |body, points: &[Vec3<f64>]| points.iter().all(|p| self.in_range(body, *p));
        if !(within(pair.a, points.centres) && within(pair.b, points.tips)) {
            return Err(Defect::OutOfRange);
        }
        let point = index(self.model.points.len(), all().count(), "points")?;
        let elements = points.elements();
        let rows = law.damper_rows(elements, false);
        let damper = self.add_dampers(spring.damping, elements, rows)?;
        let (triples, arms) = (points.centres.len() as u8, points.arms() as u8);
        let (a, b, shared) = (pair.a, pair.b, points.shared);
        let clearance = self.add_clearance(spring.clearance)?;
        let group = Group { law, a, b, triples, arms, shared, point, element, damper, clearance };
        self.model.groups.push(group);
        self.model.points.extend(all().map(|p| F64::local_from_f64(p.to_f64())));
        Ok(())
    }

    /// Whether the squares of the coordinates of a point can be summed, in its body and in the world.
    fn in_range(&self, body: BodyIndex, point_b: Vec3<f64>) -> bool {
        let coordinates = [point_b, self.place(body, point_b)].map(Vec3::to_f64);
        coordinates.as_flattened().iter().all(|c| c.abs() <= GREATEST_LENGTH)
    }

    /// Adds the coefficient of each element and zeros up to `rows`; nothing if it is 0.
    fn add_dampers(
        &mut self,
        damping: f64,
        elements: usize,
        rows: usize,
    ) -> Result<DamperIndex, Defect> {
        if damping == 0.0 {
            return Ok(DamperIndex::NONE);
        }
        let first = index(self.model.dampers.len(), rows, "dampers")?;
        self.model.dampers.extend(std::iter::repeat_n(damping, elements));
        self.model.dampers.resize(usize::from(first) + rows, 0.0);
        Ok(DamperIndex(first))
    }

    /// Adds the clearance of all elements of a group; nothing if it is 0.
    fn add_clearance(&mut self, clearance: f64) -> Result<ClearanceIndex, Defect> {
        if clearance == 0.0 {
            return Ok(ClearanceIndex::NONE);
        }
        let row = index(self.model.clearances.len(), 1, "clearances")?;
        self.model.clearances.push(clearance);
        Ok(ClearanceIndex(row))
    }

    /// Adds a torsion spring about the unit axis `axis_w` \[world\], fixed in the first body.
    pub(crate) fn add_torsion_spring(
        &mut self,
        pair: &Pair,
        axis_w: Vec3<f64>,
        spring: Spring,
        preload: f64,
    ) -> Result<(), Defect> {
        index(self.model.torsions.len(), 1, "torsion springs")?;
        let orientation = |body| self.state(body).map(|state| &state.orientation);
        let relative = Quaternion::relative(orientation(pair.a), orientation(pair.b));
        let axis = self.vector_in(pair.a, axis_w);
        let damper = self.add_dampers(spring.damping, 1, 1)?;
        let between = self.torsions_between.entry([pair.a.0, pair.b.0]).or_default();
        between.push(self.model.torsions.len());
        self.model.torsions.push(TorsionSpring {
            a: pair.a,
            b: pair.b,
            axis,
            reference: relative.conjugate(),
            stiffness: spring.stiffness,
            preload,
            damper,
        });
        Ok(())
    }

    /// Sets the laws.
    pub(crate) fn set_laws(&mut self, sources: &[Arc<dyn SourceRows>]) {
        self.model.laws = LawList::of(sources);
    }

    /// Adds a load.
    pub(crate) fn add_load(&mut self, load: Load<f64>) {
        self.model.loads.push(load);
    }

    /// The groups added so far.
    pub(crate) fn groups(&self) -> &[Group] {
        &self.model.groups
    }

    /// \[m\] size of a group: the free length of its elements or, for bushings, the size of their joint.
    pub(crate) fn size(&self, number: usize) -> f64 {
        let Some(group) = self.model.groups.get(number) else { return 0.0 };
        let row = usize::from(group.element);
        let length = match group.law {
            Law::Tsda => self.model.tsdas.get(row).map(|tsda| tsda.free_length),
            Law::PointBushing | Law::Revolute | Law::Universal => self.sizes.get(&number).copied(),
            Law::PointOnLine => self.model.lines.get(row).map(|line| line.free_length),
        };
        length.unwrap_or(0.0)
    }

    /// The largest |L − L0| \[m\] of each group at the initial pose.
    pub(crate) fn largest_extensions(&self) -> Vec<f64> {
        let mut largest = vec![0.0; self.model.groups.len()];
        each_extension(&self.model, &State::initial(&self.model), |group, extension| {
            if extension.abs() > largest[group] {
                largest[group] = extension.abs();
            }
        });
        largest
    }

    /// The model and the names of its bodies.
    pub(crate) fn finish(self) -> (SceneModel<F64>, Vec<String>) {
        (self.model, self.names)
    }
}

/// The 16-bit index of the first of `count` further rows.
fn index(first: usize, count: usize, what: &'static str) -> Result<u16, Defect> {
    if first + count > LIMIT {
        return Err(Defect::TooMany(what));
    }
    u16::try_from(first).map_err(|_| Defect::TooMany(what))
}
