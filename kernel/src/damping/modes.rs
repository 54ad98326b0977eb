//! Damping modes (levers): the dampers of a joint as at most six mutually independent dampers.
//!
//! `(model, initial pose, step) => modes`. In the axes of the joint's second body (of its first, where the second is
//! the ground) the points of a joint are constant up to its deflection, and so is the 6×6 tensor `C = Σ c·n·nᵀ` of its
//! dampers, n a damper's wrench. A damping mode is a wrench of unit coefficient; the modes have the same C and are
//! orthogonal in the inverse of the pair's mass: an impulse along one causes no rate along another (one-sided Jacobi
//! rotations, Hestenes 1958). Joints between the same two bodies have common modes. Between a body and the ground the
//! modes stay orthogonal; between two bodies only up to the rotation of the bodies' inertias.

use crate::damping::mode::{DampingMode, Kind, Stop};
use crate::damping::{Direction, each_direction};
use crate::elements::share::Share;
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::model::{Group, Law, ModelRef, Terms};
use crate::pose::{Places, placed};
use crate::real::Real;
use crate::space::{Linear as _, Moment as _, Space as _};

/// The body in whose axes a group's points are constant and the other one, `None` where there is none: raw elements
/// rotate and slide, elements with a clearance act only at times, moved ground moves its points.
#[inline(always)]
pub(super) fn fixed<P: Geometry, T: Terms<P>>(group: &Group) -> Option<[BodyIndex; 2]> {
    let Group { law, a, b, arms, .. } = *group;
    let moved = |end: BodyIndex| T::INPUTS && end.anchor_row().is_some();
    if !whole::<P, T>(group) || moved(a) || moved(b) {
        return None;
    }
    let [few, _, all] = counts::<P>();
    let elements = group.elements();
    match law {
        Law::Tsda if T::TSDAS && arms > 1 && (elements == few || elements >= all) => {
            Some(seen(a, b))
        }
        // The second body slides along the line with its points.
        Law::PointOnLine if T::LINES && !b.is_world() && elements >= all => Some([b, a]),
        // The direction normal to a universal joint's axes is constant in neither body.
        Law::PointBushing if T::BUSHINGS => Some(seen(a, b)),
        Law::Revolute if T::REVOLUTES && !P::Space::PLANAR => Some(seen(a, b)),
        _ => None,
    }
}

/// The number of modes of a joint: those of a spherical joint, of a revolute joint, or the number of components of a
/// wrench, which always suffices.
pub(super) const fn counts<P: Geometry>() -> [usize; 3] {
    if P::Space::PLANAR { [2, 2, 3] } else { [3, 5, 6] }
}

/// The kind of a group's entry, and its bodies.
fn kind<P: Geometry, T: Terms<P>>(group: &Group) -> (Kind, [BodyIndex; 2]) {
    match fixed::<P, T>(group) {
        Some(ends) if ends[1].is_world() => (Kind::Ground, ends),
        Some(ends) => (Kind::Joint, ends),
        None => {
            let ends = seen(group.a, group.b);
            let raw = T::TSDAS && group.law == Law::Tsda && group.elements() == 1;
            let raw = raw && whole::<P, T>(group) && !ends[0].is_world();
            (if raw { Kind::Raw } else { Kind::Dampers }, ends)
        }
    }
}

/// Whether all dampers of a group act at all times.
#[inline(always)]
fn whole<P: Geometry, T: Terms<P>>(group: &Group) -> bool {
    group.damper.row().is_some() && !(T::CLEARANCES && group.clearance.row().is_some())
}

/// The second body first, unless it is the ground.
#[inline(always)]
fn seen(a: BodyIndex, b: BodyIndex) -> [BodyIndex; 2] {
    if b.is_world() { [a, b] } else { [b, a] }
}

/// The modes of a joint.
pub(super) fn held<'l, P: Geometry>(
    group: &Group,
    modes: &'l [DampingMode<P>],
) -> &'l [DampingMode<P>] {
    let modes = modes.get(rows::<P>(group)).unwrap_or_default();
    let count = modes.iter().take_while(|mode| mode.rate > P::Real::ZERO).count();
    modes.get(..count).unwrap_or_default()
}

/// Weights the modes of joints to the ground, whose 1/μ is independent of the pose.
pub(crate) fn weigh<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    shares: &[Share<P::Real>],
    h: P::Real,
    modes: &mut [DampingMode<P>],
) {
    for group in model.groups {
        if let (Some(modes), Some(shares)) =
            (modes.get_mut(rows::<P>(group)), shares.get(rows::<P>(group)))
            && fixed::<P, T>(group).is_some()
        {
            let held = modes.iter_mut().take_while(|mode| mode.rate > P::Real::ZERO);
            for (mode, share) in held.zip(shares) {
                mode.weigh(share, h, mode.rate, P::Real::ONE);
            }
        }
    }
}

/// The rows of a group's modes.
#[inline(always)]
pub(super) fn rows<P: Geometry>(group: &Group) -> core::ops::Range<usize> {
    let first = group.damper.row().unwrap_or(0);
    first..first + group.law.damper_rows(group.elements(), P::Space::PLANAR)
}

/// Joints further apart in the model have no common modes, which bounds the search.
const NEAR: usize = 64;

/// Finds the modes of all joints at a pose, for half a step `h` \[s\], and the entries of a damper pass; returns the
/// number of entries.
pub(crate) fn find<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    places: Places<'_, P>,
    h: P::Real,
    modes: &mut [DampingMode<P>],
) -> u16 {
    for (row, group) in model.groups.iter().enumerate() {
        let Some(ends) = fixed::<P, T>(group) else { continue };
        let metric = Metric::new(model, ends);
        let own = rows::<P>(group);
        let Some((before, here)) = modes.split_at_mut_checked(own.start) else { continue };
        let Some(here) = here.get_mut(..own.len()) else { continue };
        let near = model.groups.get(row.saturating_sub(NEAR)..row).unwrap_or_default();
        let head = near.iter().find(|other| fixed::<P, T>(other) == Some(ends));
        let shared = head.map(rows::<P>).and_then(|rows| before.get_mut(rows)).unwrap_or_default();
        for i in 0..group.elements() {
            let (Some(element), Some(&coefficient)) =
                (placed(model, places, (0, group), i), model.dampers.get(own.start + i))
            else {
                continue;
            };
            let root = coefficient.sqrt();
            let mut insert = |direction: &Direction<_>| {
                let [a, b] = direction.moments;
                let (moment, other) = if ends[0] == group.b { (b, a) } else { (a, b) };
                let along = match places.frames.get(ends[0].row()) {
                    Some(frame) => P::to_body(frame, direction.along),
                    None => P::Vector::ZERO,
                };
                let mode = DampingMode { along, moment, other, ..DampingMode::default() };
                metric.insert(shared, here, mode.scaled(root));
            };
            each_direction::<P, T, false>(model, places, &element, &mut insert);
        }
        metric.finish(shared, h);
        metric.finish(here, h);
    }
    stops(model, modes)
}

/// Writes the entries of all elements with dampers, groups before torsion springs; returns their number. A joint whose
/// modes are all part of another's has none.
fn stops<P: Geometry, T: Terms<P>>(
    model: &ModelRef<'_, P, T>,
    modes: &mut [DampingMode<P>],
) -> u16 {
    let mut number = 0;
    for (of, group) in model.groups.iter().enumerate() {
        let Some(row) = group.damper.row() else { continue };
        let (kind, ends) = kind::<P, T>(group);
        let count = match kind {
            Kind::Ground | Kind::Joint => match held(group, modes).len() {
                0 => 0,
                count => counts::<P>().into_iter().find(|&whole| whole >= count).unwrap_or(count),
            },
            _ => 1,
        };
        if count > 0 {
            number = add(modes, number, Stop::new(kind, ends, [of, row, count]));
        }
    }
    for (of, spring) in model.torsions.iter().enumerate() {
        if let (true, Some(row)) = (T::TORSIONS, spring.damper.row()) {
            let ends = seen(spring.a, spring.b);
            number = add(modes, number, Stop::new(Kind::Torsion, ends, [of, row, 1]));
        }
    }
    number
}

/// Writes one more entry.
fn add<P: Geometry>(modes: &mut [DampingMode<P>], number: u16, stop: Stop) -> u16 {
    let Some(mode) = modes.get_mut(usize::from(number)) else { return number };
    mode.stop = stop;
    number + 1
}

/// The inverse masses of a pair, as a metric of modes.
struct Metric<P: Geometry> {
    inverse_mass: P::Real,
    own: P::Moment,
    other: P::Moment,
}

/// The largest number of Jacobi sweeps over a pair's modes; a few suffice.
const SWEEPS: u32 = 40;

impl<P: Geometry> Metric<P> {
    fn new<T: Terms<P>>(model: &ModelRef<'_, P, T>, ends: [BodyIndex; 2]) -> Self {
        let none = (P::Real::ZERO, P::Moment::ZERO);
        let [own, other] = ends.map(|end| {
            model
                .bodies
                .get(end.row())
                .map_or(none, |body| (body.inverse_mass, body.inverse_inertia))
        });
        Self { inverse_mass: own.0 + other.0, own: own.1, other: other.1 }
    }

    /// \[1/s\] the rate along one per impulse along the other.
    fn rate(&self, a: &DampingMode<P>, b: &DampingMode<P>) -> P::Real {
        a.along.dot(b.along) * self.inverse_mass
            + a.moment.dot(b.moment.scale(self.own))
            + a.other.dot(b.other.scale(self.other))
    }

    /// Rotates two modes until they are orthogonal, the stronger one first; returns whether they were not.
    fn turn(&self, a: &mut DampingMode<P>, b: &mut DampingMode<P>) -> bool {
        let (x, y, xy) = (self.rate(a, a), self.rate(b, b), self.rate(a, b));
        let least = P::Real::from_f64(8.0) * P::Real::epsilon();
        let crossed = xy.abs() > least * (x * y).sqrt();
        let (c, s) = if crossed {
            let slope = (y - x) / (xy + xy);
            let root = (P::Real::ONE + slope * slope).sqrt();
            let t = P::Real::ONE / if slope < P::Real::ZERO { slope - root } else { slope + root };
            let c = P::Real::ONE / (P::Real::ONE + t * t).sqrt();
            (c, t * c)
        } else {
            (P::Real::ONE, P::Real::ZERO)
        };
        let (first, second) = (a.turned(c, b, -s), b.turned(c, a, s));
        let [x, y] = [&first, &second].map(|mode| self.rate(mode, mode));
        let (strong, weak, least) =
            if y > x { (second, first, least * y) } else { (first, second, least * x) };
        *a = strong;
        // A remainder of the size of rounding counts as 0.
        let rest = self.rate(&weak, &weak);
        *b = if rest > P::Real::from_f64(32.0) * P::Real::epsilon() * least {
            weak
        } else {
            DampingMode::default()
        };
        crossed
    }

    /// Inserts one more mode. With as many slots as modes, or with six, there is always a free one.
    fn insert(
        &self,
        shared: &mut [DampingMode<P>],
        own: &mut [DampingMode<P>],
        mut mode: DampingMode<P>,
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
                    crossed |= self.turn(a, &mut mode);
                }
            }
        }
    }

    /// Sets the rates that are independent of the pose. Beyond `LARGEST` of h/μ the result is constant.
    fn finish(&self, modes: &mut [DampingMode<P>], h: P::Real) {
        let largest = P::Real::from_f64(LARGEST);
        for i in 0..modes.len() {
            let Some((before, [mode, ..])) = modes.split_at_mut_checked(i) else { break };
            let x = h * self.rate(mode, mode);
            if x > largest {
                *mode = mode.scaled((largest / x).sqrt());
            }
            let still = DampingMode { other: P::Moment::ZERO, ..*mode };
            mode.rate = self.rate(&still, &still);
            for (rate, earlier) in mode.still.iter_mut().zip(before) {
                *rate = self.rate(&still, earlier);
            }
        }
    }
}

/// The largest h/μ of a mode: its square is finite in single precision.
pub(super) const LARGEST: f64 = 1e12;

/// Element `i` of two concatenated slices.
fn one<'s, L>(first: &'s mut [L], second: &'s mut [L], i: usize) -> Option<&'s mut L> {
    let before = first.len();
    if i < before { first.get_mut(i) } else { second.get_mut(i - before) }
}

/// Elements `i < j` of two concatenated slices.
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
