//! Levers: the dampers of a joint as at most six that do not act on one another.
//!
//! `(model, initial pose, step) => levers`. Seen from the joint's second body (from its first, where
//! the second is the ground) the points of a joint stay where they are but for its deflection, and
//! with them the 6×6 tensor `C = Σ c·n·nᵀ` of its dampers, n a damper's wrench. A lever is a wrench
//! of unit coefficient; levers have the same C and are at right angles in the inverse of the pair's
//! mass: an impulse along one gives no rate along another (one-sided Jacobi rotations, Hestenes
//! 1958). Joints between the same two bodies share theirs. Between a body and the ground they stay at
//! right angles for ever; between two bodies as far as the bodies' inertias do not turn.

use crate::body::BodyState;
use crate::damping::each_direction;
use crate::damping::pair::Direction;
use crate::elements::share::Share;
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::model::{Group, Law, ModelOwner, ModelRef, Terms};
use crate::pose::{Places, placed};
use crate::real::Real;
use crate::vector::Vec3;

/// One lever of a joint, and what it does in half a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lever<P: Geometry> {
    /// \[√(N·s/m)\] force on the joint's body, that body's axes.
    pub(super) along: Vec3<P::Real>,
    /// Moment about that body's centre of mass, its axes.
    pub(super) moment: Vec3<P::Real>,
    /// Moment of the same force and moment about the other body's centre of mass, that body's axes.
    pub(super) other: Vec3<P::Real>,
    /// \[1/s\] rate per impulse, without the other body's turning; 0 where there is no lever.
    pub(super) rate: P::Real,
    /// \[s\] impulse per rate.
    pub(super) impulse: P::Real,
    /// \[s\] impulse per rate that the kick gave, of the lever's own share.
    pub(super) told: P::Real,
}

impl<P: Geometry> Lever<P> {
    /// Whether there is a lever.
    #[inline(always)]
    pub(super) fn acts(&self) -> bool {
        self.rate > P::Real::ZERO
    }

    /// Makes ready for half a step `h` \[s\] with 1/μ = `rate`: of the rate it takes
    /// `1 − 1/(1 + x + x²/2)`, `x = h·rate`, and is told of a kick as any damper
    /// (`damping::pair::Damper`).
    #[inline(always)]
    pub(super) fn prepare(&mut self, share: &Share<P::Real>, rate: P::Real, h: P::Real) {
        let (half, one) = (P::Real::HALF, P::Real::ONE);
        let x = h * rate;
        let y = one + half * x;
        let part = h / (one + x * y);
        self.impulse = part * y;
        self.told = share.own * half * part;
    }

    /// Its direction, seen from the ends of its joint: of the body that sees it and the other one.
    pub(super) fn direction(
        &self,
        places: Places<'_, P>,
        [own, _]: [BodyIndex; 2],
        first: BodyIndex,
    ) -> Direction<P::Real> {
        let along = match places.frames.get(own.row()) {
            Some(frame) => P::to_world(frame, self.along),
            None => Vec3::ZERO,
        };
        let moments =
            if own == first { [self.moment, self.other] } else { [self.other, self.moment] };
        Direction { along, moments }
    }

    fn turned(&self, c: P::Real, other: &Self, s: P::Real) -> Self {
        Self {
            along: self.along * c + other.along * s,
            moment: self.moment * c + other.moment * s,
            other: self.other * c + other.other * s,
            ..*self
        }
    }

    fn scaled(&self, by: P::Real) -> Self {
        self.turned(by, self, P::Real::ZERO)
    }
}

/// Whether a scheme keeps levers in its plant.
pub trait Keep {
    /// Memory for a model's levers.
    type Memory<M: ModelOwner>: AsRef<[Lever<M::Precision>]> + AsMut<[Lever<M::Precision>]>;

    /// Memory without levers yet.
    fn memory<M: ModelOwner>(model: &M) -> Self::Memory<M>;
}

/// No levers: no memory.
#[derive(Clone, Copy, Debug)]
pub struct NoLevers;

impl Keep for NoLevers {
    type Memory<M: ModelOwner> = [Lever<M::Precision>; 0];

    #[inline]
    fn memory<M: ModelOwner>(_: &M) -> Self::Memory<M> {
        []
    }
}

/// Levers: twelve numbers per damper.
#[derive(Clone, Copy, Debug)]
pub struct Levers;

impl Keep for Levers {
    type Memory<M: ModelOwner> = M::PerDamper<Lever<M::Precision>>;

    #[inline]
    fn memory<M: ModelOwner>(model: &M) -> Self::Memory<M> {
        model.per_damper(Lever::default())
    }
}

/// The body that sees a group's points at rest and the other one, `None` where none does: raw
/// elements turn and slide, what has a clearance is not always there, moved ground moves them.
#[inline(always)]
pub(super) fn fixed<P: Geometry, T: Terms>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
) -> Option<[BodyIndex; 2]> {
    let Group { law, a, b, arms, .. } = *group;
    if group.damper.row().is_none() || (T::CLEARANCES && group.clearance.row().is_some()) {
        return None;
    }
    let moved = |end: BodyIndex| T::INPUTS && end.anchor_row().is_some();
    if moved(a) || moved(b) {
        return None;
    }
    let ground = |end: BodyIndex| model.bodies.get(end.row()).is_none();
    match law {
        Law::Tsda if T::TSDAS && arms == 3 => Some(if ground(b) { [a, b] } else { [b, a] }),
        // On a line that turns it is no wrench of both bodies. Six levers always have room.
        Law::PointOnLine if T::LINES && group.elements() >= 6 && ground(a) => Some([b, a]),
        _ => None,
    }
}

/// The rows of a group's levers.
#[inline(always)]
pub(super) fn rows(group: &Group) -> core::ops::Range<usize> {
    let first = group.damper.row().unwrap_or(0);
    first..first + group.elements()
}

/// Finds the levers of all joints at a pose, for half a step `h` \[s\].
pub(crate) fn find<P: Geometry, T: Terms>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    h: P::Real,
    levers: &mut [Lever<P>],
) {
    for (row, group) in model.groups.iter().enumerate() {
        let Some(ends) = fixed(model, group) else { continue };
        let metric = Metric::new(model, ends);
        let own = rows(group);
        let Some((before, here)) = levers.split_at_mut_checked(own.start) else { continue };
        let Some(here) = here.get_mut(..own.len()) else { continue };
        let head = model.groups.iter().take(row).find(|other| fixed(model, other) == Some(ends));
        let shared = head.map(rows).and_then(|rows| before.get_mut(rows)).unwrap_or_default();
        for i in 0..group.elements() {
            let (Some(element), Some(&coefficient)) =
                (placed(model, places, (0, group), i), model.dampers.get(own.start + i))
            else {
                continue;
            };
            let root = coefficient.sqrt();
            each_direction::<P, T, false>(model, places, &element, |direction| {
                let [a, b] = direction.moments;
                let (moment, other) = if ends[0] == group.b { (b, a) } else { (a, b) };
                let along = match places.frames.get(ends[0].row()) {
                    Some(frame) => P::to_body(frame, direction.along),
                    None => Vec3::ZERO,
                };
                let lever = Lever { along, moment, other, ..Lever::default() };
                metric.insert(shared, here, lever.scaled(root));
            });
        }
        metric.finish(shared, h);
        metric.finish(here, h);
    }
}

/// What the masses of a pair make of levers.
struct Metric<R> {
    inverse_mass: R,
    own: Vec3<R>,
    other: Vec3<R>,
}

/// Turns of a pair of levers towards right angles, at most: they converge in a few.
const SWEEPS: u32 = 40;

impl<R: Real> Metric<R> {
    fn new<P: Geometry<Real = R>, T: Terms>(
        model: &ModelRef<'_, P, T>,
        ends: [BodyIndex; 2],
    ) -> Self {
        let [own, other] = ends.map(|end| model.bodies.get(end.row()));
        let mass = |body: Option<&crate::body::Body<R>>| body.map_or(R::ZERO, |b| b.inverse_mass);
        let inertia = |body: Option<&crate::body::Body<R>>| {
            body.map_or(Vec3::ZERO, |body| body.inverse_inertia)
        };
        Self {
            inverse_mass: mass(own) + mass(other),
            own: inertia(own),
            other: inertia(other),
        }
    }

    /// \[1/s\] the rate along one per impulse along the other.
    fn rate<P: Geometry<Real = R>>(&self, a: &Lever<P>, b: &Lever<P>) -> R {
        a.along.dot(b.along) * self.inverse_mass
            + a.moment.dot(b.moment.scale(self.own))
            + a.other.dot(b.other.scale(self.other))
    }

    /// Turns two levers until they are at right angles, the stronger one first; whether they were
    /// not.
    fn turn<P: Geometry<Real = R>>(&self, a: &mut Lever<P>, b: &mut Lever<P>) -> bool {
        let (x, y, xy) = (self.rate(a, a), self.rate(b, b), self.rate(a, b));
        let least = R::from_f64(8.0) * epsilon::<R>();
        let crossed = xy.abs() > least * (x * y).sqrt();
        let (c, s) = if crossed {
            let slope = (y - x) / (xy + xy);
            let root = (R::ONE + slope * slope).sqrt();
            let t = R::ONE / if slope < R::ZERO { slope - root } else { slope + root };
            let c = R::ONE / (R::ONE + t * t).sqrt();
            (c, t * c)
        } else {
            (R::ONE, R::ZERO)
        };
        let (first, second) = (a.turned(c, b, -s), b.turned(c, a, s));
        let [x, y] = [&first, &second].map(|lever| self.rate(lever, lever));
        let (strong, weak, least) = if y > x {
            (second, first, least * y)
        } else {
            (first, second, least * x)
        };
        *a = strong;
        // What rounding leaves is none.
        let rest = self.rate(&weak, &weak);
        *b = if rest > R::from_f64(32.0) * epsilon::<R>() * least { weak } else { Lever::default() };
        crossed
    }

    /// Brings one more lever in. With as many places as levers, or with six, there is always one.
    fn insert<P: Geometry<Real = R>>(
        &self,
        shared: &mut [Lever<P>],
        own: &mut [Lever<P>],
        mut lever: Lever<P>,
    ) {
        let count = shared.len() + own.len();
        let mut crossed = true;
        for _ in 0..SWEEPS {
            if !crossed {
                break;
            }
            crossed = false;
            for i in 0..count {
                for j in i + 1..count {
                    if let Some([a, b]) = two(shared, own, i, j) {
                        crossed |= self.turn(a, b);
                    }
                }
                if let Some(a) = one(shared, own, i) {
                    crossed |= self.turn(a, &mut lever);
                }
            }
        }
    }

    /// Brings levers to the front, and takes the part of 1/μ that no pose changes. Beyond `LARGEST`
    /// of h/μ nothing changes any more.
    fn finish<P: Geometry<Real = R>>(&self, levers: &mut [Lever<P>], h: R) {
        let largest = R::from_f64(LARGEST);
        for lever in levers {
            let x = h * self.rate(lever, lever);
            if x > largest {
                *lever = lever.scaled((largest / x).sqrt());
            }
            let still = Lever { other: Vec3::ZERO, ..*lever };
            lever.rate = self.rate(&still, &still);
        }
    }
}

/// The largest h/μ of a lever: its square is a number in single precision.
const LARGEST: f64 = 1e12;

/// The spacing of numbers beside 1.
fn epsilon<R: Real>() -> R {
    let mut spacing = R::ONE;
    while R::ONE + R::HALF * spacing > R::ONE {
        spacing = R::HALF * spacing;
    }
    spacing
}

/// Element `i` of two slices after one another.
fn one<'s, L>(first: &'s mut [L], second: &'s mut [L], i: usize) -> Option<&'s mut L> {
    let before = first.len();
    if i < before { first.get_mut(i) } else { second.get_mut(i - before) }
}

/// Elements `i < j` of two slices after one another.
fn two<'s, L>(
    first: &'s mut [L],
    second: &'s mut [L],
    i: usize,
    j: usize,
) -> Option<[&'s mut L; 2]> {
    let before = first.len();
    if j < before {
        return first.get_disjoint_mut([i, j]).ok();
    }
    if i < before {
        return Some([first.get_mut(i)?, second.get_mut(j - before)?]);
    }
    second.get_disjoint_mut([i - before, j - before]).ok()
}

/// Makes the levers of joints to the ground ready, once and for all.
pub(crate) fn prepare_grounded<P: Geometry, T: Terms>(
    model: &ModelRef<'_, P, T>,
    shares: &[Share<P::Real>],
    h: P::Real,
    levers: &mut [Lever<P>],
) {
    for group in model.groups {
        if fixed(model, group).is_some_and(|[_, other]| model.bodies.get(other.row()).is_none())
            && let (Some(levers), Some(shares)) = (levers.get_mut(rows(group)), shares.get(rows(group)))
        {
            for (lever, share) in levers.iter_mut().zip(shares).filter(|(lever, _)| lever.acts()) {
                lever.prepare(share, lever.rate, h);
            }
        }
    }
}

/// Makes the levers of joints between two bodies ready at a pose.
#[inline]
pub(crate) fn prepare<P: Geometry, T: Terms>(
    model: &ModelRef<'_, P, T>,
    (places, bodies): (Places<'_, P>, &[BodyState<P>]),
    shares: &[Share<P::Real>],
    h: P::Real,
    levers: &mut [Lever<P>],
) {
    for group in model.groups {
        let Some([own, other]) = fixed(model, group) else { continue };
        let at = |end: BodyIndex| {
            let row = end.row();
            Some((model.bodies.get(row)?, bodies.get(row)?, places.frames.get(row)?))
        };
        let (Some((_, own, own_frame)), Some((body, other, frame))) = (at(own), at(other)) else {
            continue;
        };
        let (Some(levers), Some(shares)) = (levers.get_mut(rows(group)), shares.get(rows(group)))
        else {
            continue;
        };
        let between = P::position(&own.position) - P::position(&other.position);
        let between = P::to_body(own_frame, between);
        for (lever, share) in levers.iter_mut().zip(shares) {
            if !lever.acts() {
                break;
            }
            let moment = lever.moment + between.cross(lever.along);
            lever.other = P::to_body(frame, P::to_world(own_frame, moment));
            let rate = lever.rate + lever.other.dot(lever.other.scale(body.inverse_inertia));
            lever.prepare(share, rate, h);
        }
    }
}
