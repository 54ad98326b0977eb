//! Models assembled at run time in fixed capacity (feature `heapless`).
//!
//! `bodies, elements => model`: arguments are in double precision, each constant is rounded once. The builder is the
//! model: pass it to a [`crate::Plant`] when it is complete. It is stepped by the same code and with the same bits as a
//! const model with the same elements in the same order.

mod bushings;
mod error;
mod inputs;
mod owner;

pub use bushings::BushingLaw;
pub use error::{BuildError, Part, Quantity};

use heapless::Vec;

use crate::attitude::Attitude as _;
use crate::body::{Body, BodyState};
use crate::elements::input::{Input, Knot};
use crate::elements::load::Load;
use crate::elements::point_bushing::PointBushing;
use crate::elements::point_on_line::PointOnLine;
use crate::elements::revolute::Revolute;
use crate::elements::torsion_spring::TorsionSpring;
use crate::elements::tsda::Tsda;
use crate::elements::universal::Universal;
use crate::geometry::Geometry;
use crate::index::{BodyIndex, ClearanceIndex, DamperIndex};
use crate::model::{Group, Law};
use crate::real::Real;
use crate::space::{Linear as _, Space, Turn as _};
use crate::vector::Quaternion;

/// Spring triples of TSDAs between two bodies, into which a joint is expanded.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct Triples<'p> {
    /// First and second body.
    pub between: [BodyIndex; 2],
    /// \[m\] one point of the first body per triple, body axes (world for the ground).
    pub centres: &'p [[f64; 3]],
    /// \[m\] points of the second body: 1 or 3 shared by all triples, or 1 to 3 per triple; for point bushings one per
    /// triple.
    pub arms: &'p [[f64; 3]],
    /// \[N/m\] stiffness of each TSDA, ≥ 0.
    pub stiffness: f64,
    /// \[N·s/m\] damping of each TSDA, ≥ 0.
    pub damping: f64,
    /// \[m\] free length of each TSDA, ≥ 0; 0 makes point bushings.
    pub free_length: f64,
    /// \[m\] clearance of each TSDA, ≥ 0; 0 for none. Point bushings support no clearance.
    pub clearance: f64,
}

/// Constants of a point on a line.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct LineLaw {
    /// \[N/m\] stiffness normal to the line, ≥ 0.
    pub stiffness: f64,
    /// \[N·s/m\] damping normal to the line, ≥ 0.
    pub damping: f64,
    /// \[m\] free distance from the line, ≥ 0.
    pub free_length: f64,
    /// \[m\] clearance, ≥ 0; 0 for none.
    pub clearance: f64,
}

/// A model under construction, and the model itself once complete.
#[derive(Clone, Debug, Default)]
pub struct ModelBuilder<
    P: Geometry,
    const BODIES: usize,
    const GROUPS: usize = 0,
    const POINTS: usize = 0,
    const TSDAS: usize = 0,
    const BUSHINGS: usize = 0,
    const DAMPERS: usize = 0,
    const TORSIONS: usize = 0,
    const LOADS: usize = 0,
    const LINES: usize = 0,
    const INPUTS: usize = 0,
    const KNOTS: usize = 0,
    const REVOLUTES: usize = 0,
    const UNIVERSALS: usize = 0,
> {
    bodies: Vec<Body<P::Space>, BODIES>,
    initial: Vec<BodyState<P>, BODIES>,
    gravity: Vec<P::Vector, 1>,
    groups: Vec<Group, GROUPS>,
    points: Vec<P::Local, POINTS>,
    tsdas: Vec<Tsda<P::Real>, TSDAS>,
    bushings: Vec<PointBushing<P::Real>, BUSHINGS>,
    dampers: Vec<P::Real, DAMPERS>,
    torsions: Vec<TorsionSpring<P::Space>, TORSIONS>,
    loads: Vec<Load<P::Space>, LOADS>,
    lines: Vec<PointOnLine<P::Space>, LINES>,
    inputs: Vec<Input<P>, INPUTS>,
    knots: Vec<Knot<P::Real>, KNOTS>,
    // At most one per group.
    clearances: Vec<P::Real, GROUPS>,
    revolutes: Vec<Revolute<P::Space>, REVOLUTES>,
    universals: Vec<Universal<P::Space>, UNIVERSALS>,
}

impl<
    P: Geometry,
    const BODIES: usize,
    const GROUPS: usize,
    const POINTS: usize,
    const TSDAS: usize,
    const BUSHINGS: usize,
    const DAMPERS: usize,
    const TORSIONS: usize,
    const LOADS: usize,
    const LINES: usize,
    const INPUTS: usize,
    const KNOTS: usize,
    const REVOLUTES: usize,
    const UNIVERSALS: usize,
>
    ModelBuilder<
        P,
        BODIES,
        GROUPS,
        POINTS,
        TSDAS,
        BUSHINGS,
        DAMPERS,
        TORSIONS,
        LOADS,
        LINES,
        INPUTS,
        KNOTS,
        REVOLUTES,
        UNIVERSALS,
    >
{
    /// An empty model.
    #[must_use]
    pub fn new() -> Self {
        Self {
            bodies: Vec::new(),
            initial: Vec::new(),
            gravity: Vec::new(),
            groups: Vec::new(),
            points: Vec::new(),
            tsdas: Vec::new(),
            bushings: Vec::new(),
            dampers: Vec::new(),
            torsions: Vec::new(),
            loads: Vec::new(),
            lines: Vec::new(),
            inputs: Vec::new(),
            knots: Vec::new(),
            clearances: Vec::new(),
            revolutes: Vec::new(),
            universals: Vec::new(),
        }
    }

    /// Sets gravity \[m/s²\], world.
    ///
    /// # Errors
    /// [`Quantity::Gravity`] where it is not finite.
    pub fn set_gravity(&mut self, gravity: [f64; 3]) -> Result<(), BuildError> {
        check(finite(&gravity) && P::Vector::holds(gravity), Quantity::Gravity)?;
        self.gravity.clear();
        // The capacity is 1.
        let _ = self.gravity.push(P::Vector::from_f64(gravity));
        Ok(())
    }

    /// Adds a body of mass \[kg\] and principal inertia \[kg·m²\] in its initial state.
    ///
    /// # Errors
    /// [`BuildError::Full`], or a mass, inertia or state out of range.
    pub fn add_body(
        &mut self,
        mass: f64,
        inertia: [f64; 3],
        state: BodyState<P>,
    ) -> Result<BodyIndex, BuildError> {
        check(mass > 0.0 && mass.is_finite(), Quantity::Mass)?;
        let [x, y, z] = inertia;
        let plausible = |i: f64, j: f64, k: f64| i > 0.0 && i <= (j + k) * (1.0 + 1e-9);
        let triangle = plausible(x, y, z) && plausible(y, z, x) && plausible(z, x, y);
        check(finite(&inertia) && triangle, Quantity::Inertia)?;
        let known = P::position(&state.position).is_finite()
            && finite(&P::Orientation::to_f64(&state.orientation))
            && P::velocity(&state.velocity).is_finite()
            && P::spin(&state.angular_velocity).is_finite();
        check(known, Quantity::State)?;
        let index = BodyIndex(self.bodies.len() as u16);
        self.bodies
            .push(Body::from_f64(mass, inertia))
            .map_err(|_| BuildError::Full(Part::Bodies))?;
        self.initial.push(state).map_err(|_| BuildError::Full(Part::Bodies))?;
        Ok(index)
    }

    /// Adds one raw TSDA; points \[m\] in body axes, world for the ground. With a free length of 0 it is a point
    /// bushing.
    ///
    /// # Errors
    /// As [`Self::add_triples`].
    pub fn add_tsda(
        &mut self,
        between: [BodyIndex; 2],
        points: [[f64; 3]; 2],
        stiffness: f64,
        damping: f64,
        free_length: f64,
    ) -> Result<(), BuildError> {
        let [a, b] = points;
        let (centres, arms) = ([a], [b]);
        self.add_triples(Triples {
            between,
            centres: &centres,
            arms: &arms,
            stiffness,
            damping,
            free_length,
            clearance: 0.0,
        })
    }

    /// Adds the spring triples of one joint as one group.
    ///
    /// # Errors
    /// [`BuildError::Full`] for a capacity, an unknown body, a quantity out of range.
    pub fn add_triples(&mut self, triples: Triples<'_>) -> Result<(), BuildError> {
        self.check_pair(triples.between)?;
        let not_negative = |x: f64| x >= 0.0 && x.is_finite();
        check(not_negative(triples.stiffness), Quantity::Stiffness)?;
        check(not_negative(triples.damping), Quantity::Damping)?;
        check(not_negative(triples.free_length), Quantity::FreeLength)?;
        let dead = triples.clearance != 0.0;
        let bushing = triples.free_length == 0.0;
        check(not_negative(triples.clearance) && !(bushing && dead), Quantity::Clearance)?;
        let points = triples.centres.iter().chain(triples.arms);
        check(points.clone().all(|p| finite(p) && P::Vector::holds(*p)), Quantity::Point)?;
        let (count, arms) = (triples.centres.len(), triples.arms.len());
        let shared = !bushing && count > 1 && (arms == 1 || arms == 3);
        let per_triple = if shared { arms } else { arms / count.max(1) };
        let whole = shared || per_triple * count == arms;
        check(count <= 255 && whole && (1..=3).contains(&per_triple), Quantity::Arms)?;
        let elements = count * per_triple;
        check(!bushing || per_triple == 1, Quantity::Arms)?;

        room(&self.groups, 1, Part::Groups)?;
        room(&self.points, count + arms, Part::Points)?;
        if bushing {
            room(&self.bushings, elements, Part::Bushings)?;
        } else {
            room(&self.tsdas, elements, Part::Tsdas)?;
        }
        let law = if bushing { Law::PointBushing } else { Law::Tsda };
        let rows = law.damper_rows(elements, P::Space::PLANAR);
        let damper = self.add_dampers(triples.damping, elements, rows)?;
        let clearance = self.add_clearance(triples.clearance)?;
        let element = if bushing { self.bushings.len() } else { self.tsdas.len() } as u16;
        let group = Group {
            law,
            a: triples.between[0],
            b: triples.between[1],
            triples: count as u8,
            arms: per_triple as u8,
            shared,
            point: self.points.len() as u16,
            element,
            damper,
            clearance,
        };
        // The capacity was checked above.
        let _ = self.groups.push(group);
        for point in points {
            let _ = self.points.push(P::local_from_f64(*point));
        }
        for _ in 0..elements {
            if bushing {
                let _ = self.bushings.push(PointBushing::from_f64(triples.stiffness));
            } else {
                let _ = self.tsdas.push(Tsda::from_f64(triples.stiffness, triples.free_length));
            }
        }
        Ok(())
    }

    /// Adds a group of one or two points \[m\] of the second body on a line of the first: the line through `line_point`
    /// \[m\] along `direction`, in the first body's axes.
    ///
    /// # Errors
    /// [`BuildError::Full`] for a capacity, an unknown body, a quantity out of range.
    pub fn add_points_on_line(
        &mut self,
        between: [BodyIndex; 2],
        line_point: [f64; 3],
        direction: [f64; 3],
        points: &[[f64; 3]],
        law: LineLaw,
    ) -> Result<(), BuildError> {
        self.check_pair(between)?;
        let norm = length(direction);
        let held = P::Vector::holds(direction);
        check(held && norm > 0.0 && norm.is_finite(), Quantity::Axis)?;
        let not_negative = |x: f64| x >= 0.0 && x.is_finite();
        check(not_negative(law.stiffness), Quantity::Stiffness)?;
        check(not_negative(law.damping), Quantity::Damping)?;
        check(not_negative(law.free_length), Quantity::FreeLength)?;
        check(not_negative(law.clearance), Quantity::Clearance)?;
        let known = |p: &[f64; 3]| finite(p) && P::Vector::holds(*p);
        check(known(&line_point) && points.iter().all(known), Quantity::Point)?;
        check(points.len() == 1 || points.len() == 2, Quantity::Arms)?;
        room(&self.groups, 1, Part::Groups)?;
        room(&self.points, 1 + points.len(), Part::Points)?;
        room(&self.lines, points.len(), Part::Lines)?;
        let damper = self.add_dampers(law.damping, points.len(), points.len())?;
        let clearance = self.add_clearance(law.clearance)?;
        let group = Group {
            law: Law::PointOnLine,
            a: between[0],
            b: between[1],
            triples: 1,
            arms: points.len() as u8,
            shared: false,
            point: self.points.len() as u16,
            element: self.lines.len() as u16,
            damper,
            clearance,
        };
        let _ = self.groups.push(group);
        let _ = self.points.push(P::local_from_f64(line_point));
        for point in points {
            let _ = self.points.push(P::local_from_f64(*point));
            let unit = direction.map(|c| c / norm);
            let _ = self.lines.push(PointOnLine::from_f64(unit, law.stiffness, law.free_length));
        }
        Ok(())
    }

    /// Adds a torsion spring about `axis` (first body's axes), with torsion angle 0 in the initial pose; stiffness
    /// \[N·m/rad\], damping \[N·m·s/rad\], preload \[N·m\] on the second body.
    ///
    /// # Errors
    /// [`BuildError::Full`], an unknown body, a quantity out of range.
    pub fn add_torsion_spring(
        &mut self,
        between: [BodyIndex; 2],
        axis: [f64; 3],
        stiffness: f64,
        damping: f64,
        preload: f64,
    ) -> Result<(), BuildError> {
        self.check_pair(between)?;
        let norm = length(axis);
        let held = P::Moment::holds(axis);
        check(held && norm > 0.0 && norm.is_finite(), Quantity::Axis)?;
        check(stiffness >= 0.0 && stiffness.is_finite(), Quantity::Stiffness)?;
        check(damping >= 0.0 && damping.is_finite(), Quantity::Damping)?;
        check(preload.is_finite(), Quantity::Load)?;
        room(&self.torsions, 1, Part::Torsions)?;
        let orientation = |body: BodyIndex| match self.initial.get(body.row()) {
            Some(state) => Quaternion::<f64>::from_f64(P::Orientation::to_f64(&state.orientation)),
            None => Quaternion::IDENTITY,
        };
        let [a, b] = between;
        let reference = orientation(b).conjugate().product(orientation(a));
        let damper = self.add_dampers(damping, 1, 1)?;
        let _ = self.torsions.push(TorsionSpring {
            a,
            b,
            axis: P::Moment::from_f64(axis.map(|c| c / norm)),
            reference: <P::Space as Space>::Turn::from_f64(reference.to_f64()),
            stiffness: P::Real::from_f64(stiffness),
            preload: P::Real::from_f64(preload),
            damper,
        });
        Ok(())
    }

    /// Adds a load.
    ///
    /// # Errors
    /// [`BuildError::Full`], an unknown body, a force, torque or window out of range.
    pub fn add_load(&mut self, load: Load<P::Space>) -> Result<(), BuildError> {
        if load.body.row() >= self.bodies.len() {
            return Err(BuildError::UnknownBody(load.body));
        }
        check(load.force.is_finite() && load.torque.is_finite(), Quantity::Load)?;
        check(load.from.is_finite() && load.from <= load.until, Quantity::Window)?;
        self.loads.push(load).map_err(|_| BuildError::Full(Part::Loads))
    }

    fn check_pair(&self, between: [BodyIndex; 2]) -> Result<(), BuildError> {
        for body in between {
            if !body.is_world() && body.row() >= self.bodies.len() {
                return Err(BuildError::UnknownBody(body));
            }
        }
        if between[0] == between[1] || between.iter().all(|body| body.is_world()) {
            return Err(BuildError::SameBody(between[0]));
        }
        Ok(())
    }

    fn add_clearance(&mut self, clearance: f64) -> Result<ClearanceIndex, BuildError> {
        if clearance == 0.0 {
            return Ok(ClearanceIndex::NONE);
        }
        let index = ClearanceIndex(self.clearances.len() as u16);
        self.clearances
            .push(P::Real::from_f64(clearance))
            .map_err(|_| BuildError::Full(Part::Groups))?;
        Ok(index)
    }

    /// Adds the coefficient of each element, padded with zeros to the given number of rows; nothing for a coefficient
    /// of 0.
    fn add_dampers(
        &mut self,
        damping: f64,
        elements: usize,
        rows: usize,
    ) -> Result<DamperIndex, BuildError> {
        if damping == 0.0 {
            return Ok(DamperIndex::NONE);
        }
        room(&self.dampers, rows, Part::Dampers)?;
        let first = DamperIndex(self.dampers.len() as u16);
        for row in 0..rows {
            let damping = if row < elements { damping } else { 0.0 };
            let _ = self.dampers.push(P::Real::from_f64(damping));
        }
        Ok(first)
    }
}

fn length(v: [f64; 3]) -> f64 {
    libm::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
}

fn finite(values: &[f64]) -> bool {
    values.iter().all(|value| value.is_finite())
}

fn check(holds: bool, quantity: Quantity) -> Result<(), BuildError> {
    if holds { Ok(()) } else { Err(BuildError::OutOfRange(quantity)) }
}

/// Whether `more` items fit; the largest index represents "none" and is never assigned.
fn room<T, const N: usize>(items: &Vec<T, N>, more: usize, part: Part) -> Result<(), BuildError> {
    let fits = items.len() + more <= N.min(usize::from(u16::MAX));
    if fits { Ok(()) } else { Err(BuildError::Full(part)) }
}
