//! Dampers as pairwise exact impulses: unconditionally stable, energy never added but by rounding.
//!
//! `(pose, velocities, h) => velocities`. For each damper along a direction u with rate `u·v_rel`
//! and effective mass μ, `1/μ = Σ_bodies (1/m + (r×u)ᵀ·I⁻¹·(r×u))`, the impulse
//! `p = μ·(1 − exp(−h·c/μ))·(u·v_rel)` pulls the two points together (compare Shardlow 2003).
//! One sweep goes through all dampers in ascending order before the conservative part of a step,
//! one in descending order after it, half a step each: second order. `exp(−x)` is replaced by
//! `1/(1 + x + x²/2)`: in (0, 1], second order, plain arithmetic.
//! A TSDA damps along its line, a torsion spring along its gradient, a point bushing along the
//! world's axes, a point on a line along the line's two normals, one after the other.
//! Velocities are rounded once per pair where [`Geometry::SUMS_APART`] (single precision), else once
//! per damper. Linear momentum is always kept. Angular momentum is kept by dampers of TSDAs with a
//! free length and of torsion springs; a damped bushing or point on a line has the law `c·v_rel`,
//! whose torque vanishes only with its deflection.

use crate::attitude::Attitude as _;
use crate::body::{Body, BodyState, Increment};
use crate::elements::clearance;
use crate::elements::torsion_spring::TorsionSpring;
use crate::geometry::Geometry;
use crate::index::BodyIndex;
use crate::model::{Group, Law, ModelRef, Terms};
use crate::pose::{End, MOST_ARMS, Placed, Places, Spot, placed};
use crate::real::Real;
use crate::vector::Vec3;

/// How a scheme treats dampers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Damping {
    /// Half a step of sweeps before and after the conservative part: of this module.
    Sweeps,
    /// Forces at the velocities of each evaluation: limits the step to about 2·m/c.
    Explicit,
}

impl Damping {
    /// The name users give: `sweeps`, `explicit`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Damping::Sweeps => "sweeps",
            Damping::Explicit => "explicit",
        }
    }
}

/// The impulse per relative velocity, `μ·s/(1 + s)` with `s = x + x²/2` and `x = h·c/μ`, from
/// `1/μ > 0`: a share of μ in \[0, 1\].
///
/// Written as `1/((1/μ)·(1 + 1/s))`, which neither cancels where x is small nor fails where s
/// overflows; a damper without a coefficient gives 0.
#[inline(always)]
fn impulse_per_rate<R: Real>(inverse: R, damping: R, h: R) -> R {
    let x = h * damping * inverse;
    let s = x + R::HALF * (x * x);
    R::ONE / (inverse * (R::ONE + R::ONE / s))
}

/// A pair's two bodies while its dampers push them. Where a precision sums impulses apart, each
/// velocity is rounded once per pair, not once per damper: a fast body's velocity in single
/// precision has no digits for what one damper of its joint takes away.
struct Pair<P: Geometry> {
    rows: [usize; 2],
    states: [BodyState<P>; 2],
    added: [Increment<P::Real>; 2],
}

impl<P: Geometry> Pair<P> {
    #[inline(always)]
    fn new(rows: [usize; 2], bodies: &[BodyState<P>]) -> Self {
        let states = rows.map(|row| bodies.get(row).copied().unwrap_or_default());
        Self { rows, states, added: [Increment::default(); 2] }
    }

    /// The rate `u·v + n·ω` of the end of a lever.
    #[inline(always)]
    fn rate(&self, end: usize, lever: &Lever<P::Real>) -> P::Real {
        let (Some(state), Some(added)) = (self.states.get(end), self.added.get(end)) else {
            return P::Real::ZERO;
        };
        let mut linear = P::velocity(&state.velocity);
        let mut angular = P::velocity(&state.angular_velocity);
        if P::SUMS_APART {
            linear = linear + added.linear;
            angular = angular + added.angular;
        }
        lever.linear.dot(linear) + lever.moment.dot(angular)
    }

    #[inline(always)]
    fn push(&mut self, end: usize, lever: &Lever<P::Real>, impulse: P::Real) {
        let linear = lever.linear * (impulse * lever.inverse_mass);
        let angular = lever.moment.scale(lever.inverse_inertia) * impulse;
        let (Some(state), Some(added)) = (self.states.get_mut(end), self.added.get_mut(end)) else {
            return;
        };
        if P::SUMS_APART {
            added.linear = added.linear + linear;
            added.angular = added.angular + angular;
        } else {
            P::accelerate(&mut state.velocity, linear);
            P::accelerate(&mut state.angular_velocity, angular);
        }
    }

    #[inline(always)]
    fn store(self, bodies: &mut [BodyState<P>]) {
        for ((row, mut moved), added) in self.rows.into_iter().zip(self.states).zip(self.added) {
            if P::SUMS_APART {
                P::accelerate(&mut moved.velocity, added.linear);
                P::accelerate(&mut moved.angular_velocity, added.angular);
            }
            if let Some(state) = bodies.get_mut(row) {
                *state = moved;
            }
        }
    }
}

/// What a unit impulse does to one body: `u/m` and `I⁻¹·n`, n its moment in body axes.
struct Lever<R> {
    linear: Vec3<R>,
    moment: Vec3<R>,
    inverse_mass: R,
    inverse_inertia: Vec3<R>,
}

impl<R: Real> Lever<R> {
    #[inline(always)]
    fn new(body: Option<&Body<R>>, linear: Vec3<R>, moment: Vec3<R>) -> Option<Self> {
        body.map(|body| Self {
            linear,
            moment,
            inverse_mass: body.inverse_mass,
            inverse_inertia: body.inverse_inertia,
        })
    }

    /// `u·u/m + n·I⁻¹·n`.
    #[inline(always)]
    fn inverse_effective_mass(&self) -> R {
        self.linear.dot(self.linear) * self.inverse_mass
            + self.moment.dot(self.moment.scale(self.inverse_inertia))
    }
}

/// The impulse of one damper between two levers over the time `h`.
#[inline(always)]
fn damp<P: Geometry>(
    pair: &mut Pair<P>,
    levers: [Option<Lever<P::Real>>; 2],
    ground_rate: P::Real,
    damping: P::Real,
    h: P::Real,
) {
    let [a, b] = levers;
    let zero = P::Real::ZERO;
    let inverse = a.as_ref().map_or(zero, Lever::inverse_effective_mass)
        + b.as_ref().map_or(zero, Lever::inverse_effective_mass);
    // Without a direction (coincident points) nothing can be pushed.
    if inverse == zero {
        return;
    }
    let rate = b.as_ref().map_or(zero, |b| pair.rate(1, b))
        - a.as_ref().map_or(zero, |a| pair.rate(0, a))
        + ground_rate;
    let impulse = impulse_per_rate(inverse, damping, h) * rate;
    if let Some(a) = a {
        pair.push(0, &a, impulse);
    }
    if let Some(b) = b {
        pair.push(1, &b, -impulse);
    }
}

/// One pass over all dampers for the time `h`, ascending, or descending with `REVERSE`; groups
/// come before torsion springs in ascending order.
#[inline]
pub(crate) fn sweep<P: Geometry, T: Terms, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    h: P::Real,
    places: Places<'_, P>,
    bodies: &mut [BodyState<P>],
    turns: &[i32],
) {
    if REVERSE {
        if T::TORSIONS {
            for (spring, &turns) in model.torsions.iter().zip(turns).rev() {
                torsion(model, spring, turns, h, places, bodies);
            }
        }
        for group in model.groups.iter().rev() {
            sweep_group::<P, T, true>(model, group, h, places, bodies);
        }
    } else {
        for group in model.groups {
            sweep_group::<P, T, false>(model, group, h, places, bodies);
        }
        if T::TORSIONS {
            for (spring, &turns) in model.torsions.iter().zip(turns) {
                torsion(model, spring, turns, h, places, bodies);
            }
        }
    }
}

#[inline(always)]
fn sweep_group<P: Geometry, T: Terms, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    h: P::Real,
    places: Places<'_, P>,
    bodies: &mut [BodyState<P>],
) {
    let Some(dampers) = group.damper.row().and_then(|row| model.dampers.get(row..)) else {
        return;
    };
    if T::TSDAS && group.law == Law::Tsda && group.clearance.row().is_none() {
        return sweep_stars::<P, T, REVERSE>(model, group, dampers, h, places, bodies);
    }
    let elements = group.elements();
    let mut pair = Pair::new([group.a, group.b].map(BodyIndex::row), bodies);
    for i in 0..elements {
        let i = if REVERSE { elements - 1 - i } else { i };
        let (Some(element), Some(&whole)) = (placed(model, places, (0, group), i), dampers.get(i))
        else {
            continue;
        };
        let damping = engaged(model, &element, whole);
        if T::CLEARANCES && damping == P::Real::ZERO {
            continue;
        }
        let Some((mut directions, count)) = model.damped(group.law, &element.stretch) else {
            continue;
        };
        if REVERSE && count > 1 {
            directions.swap(0, count - 1);
        }
        for u in directions.into_iter().take(count) {
            let lever = |body: BodyIndex, arm: Vec3<P::Real>| {
                let (frame, row) = (places.frames.get(body.row())?, body.row());
                Lever::new(model.bodies.get(row), u, P::to_body(frame, arm.cross(u)))
            };
            let levers = [lever(group.a, element.arm_a), lever(group.b, element.arm_b)];
            damp(&mut pair, levers, u.dot(element.ground_rate), damping, h);
        }
    }
    pair.store(bodies);
}

/// The stars of a group without clearance: the two bodies' velocities are at hand until the last
/// element.
#[inline(always)]
fn sweep_stars<P: Geometry, T: Terms, const REVERSE: bool>(
    model: &ModelRef<'_, P, T>,
    group: &Group,
    dampers: &[P::Real],
    h: P::Real,
    places: Places<'_, P>,
    bodies: &mut [BodyState<P>],
) {
    // A number at run time, and one body of the loop: unrolled it takes more flash and is no faster.
    let arms = (group.arms as usize).clamp(1, MOST_ARMS);
    let end_a = End::new(model, places, group.a, None);
    let end_b = End::new(model, places, group.b, None);
    let ground_rate = end_b.velocity - end_a.velocity;
    let rows = [group.a, group.b].map(BodyIndex::row);
    let [body_a, body_b] = rows.map(|row| model.bodies.get(row));
    let mut pair = Pair::new(rows, bodies);
    let mut tips = [(P::Location::default(), Vec3::ZERO); MOST_ARMS];
    let stars = group.stars as usize;
    for i in 0..stars {
        let star = if REVERSE { stars - 1 - i } else { i };
        let (first, element) = (group.tips(star), star * arms);
        let (Some(centre), Some(points), Some(dampers)) = (
            model.points.get(group.centre(star)),
            model.points.get(first..first + arms),
            dampers.get(element..element + arms),
        ) else {
            break;
        };
        if i == 0 || !group.shared {
            for (tip, point) in tips.iter_mut().zip(points) {
                *tip = end_b.place(point);
            }
        }
        let (centre, arm_a) = end_a.place(centre);
        let mut element = |((tip, arm_b), damping): (&Spot<P>, &P::Real)| {
            let d = P::displacement(&centre, tip);
            let u = d * d.dot(d).sqrt().reciprocal_or_zero();
            let a = Lever::new(body_a, u, end_a.to_axes(arm_a.cross(u)));
            let b = Lever::new(body_b, u, end_b.to_axes(arm_b.cross(u)));
            damp(&mut pair, [a, b], u.dot(ground_rate), *damping, h);
        };
        let elements = tips.get(..arms).unwrap_or_default().iter().zip(dampers);
        if REVERSE {
            elements.rev().for_each(&mut element);
        } else {
            elements.for_each(&mut element);
        }
    }
    pair.store(bodies);
}

/// What acts of an element's damper beyond its clearance; without one all of it.
#[inline(always)]
fn engaged<P: Geometry, T: Terms>(
    model: &ModelRef<'_, P, T>,
    element: &Placed<'_, P::Real>,
    damping: P::Real,
) -> P::Real {
    let clearance = model.clearance(element.group);
    if clearance.is_none() {
        return damping;
    }
    let Some(law) = model.element(element.group.law, element.index) else { return damping };
    let extension = law.extension(element.stretch.displacement);
    clearance::engaged(damping, extension, clearance)
}

/// A torsion spring's damper, along the gradient of its twist. An undefined twist is left to the
/// next evaluation, which reports it.
#[inline(always)]
fn torsion<P: Geometry, T: Terms>(
    model: &ModelRef<'_, P, T>,
    spring: &TorsionSpring<P::Real>,
    turns: i32,
    h: P::Real,
    places: Places<'_, P>,
    bodies: &mut [BodyState<P>],
) {
    let Some(&damping) = spring.damper.row().and_then(|row| model.dampers.get(row)) else {
        return;
    };
    let (row_a, row_b) = (spring.a.row(), spring.b.row());
    let relative = P::Orientation::relative(
        bodies.get(row_a).map(|s| &s.orientation),
        bodies.get(row_b).map(|s| &s.orientation),
    );
    let Some(since) = spring.since_start(relative) else {
        return;
    };
    let twist = spring.twist(&since, turns);
    let (frame_a, frame_b) = (places.frames.get(row_a), places.frames.get(row_b));
    let world = End::new(model, places, spring.a, None).to_world(twist.gradient);
    let lever = |row: usize, frame: Option<&P::Frame>| {
        frame.and_then(|f| Lever::new(model.bodies.get(row), Vec3::ZERO, P::to_body(f, world)))
    };
    let mut pair = Pair::new([row_a, row_b], bodies);
    let levers = [lever(row_a, frame_a), lever(row_b, frame_b)];
    damp(&mut pair, levers, P::Real::ZERO, damping, h);
    pair.store(bodies);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The share of a relative velocity that a damper takes away.
    fn removed<R: Real>(x: f64, inverse: f64) -> f64 {
        let inverse = R::from_f64(inverse);
        let x = R::from_f64(x);
        (impulse_per_rate(inverse, x / inverse, R::ONE) * inverse).to_f64()
    }

    #[test]
    fn light_and_strong_dampers_lose_no_digits() {
        for exponent in -12..=12 {
            let x = 10_f64.powi(exponent);
            let exact = (x + 0.5 * x * x) / (1.0 + x + 0.5 * x * x);
            for inverse in [1e-6, 0.7, 1e6] {
                let (double, single) = (removed::<f64>(x, inverse), removed::<f32>(x, inverse));
                assert!((double / exact - 1.0).abs() < 1e-15, "{x}: {double} of {exact}");
                assert!((single / exact - 1.0).abs() < 5e-7, "{x}: {single} of {exact}");
            }
        }
    }

    #[test]
    fn no_coefficient_takes_nothing_and_none_more_than_all() {
        assert_eq!(removed::<f32>(0.0, 0.7), 0.0);
        assert_eq!(removed::<f64>(0.0, 0.7), 0.0);
        // Beyond 1e19 the square overflows in single precision, beyond 1e154 in double.
        for x in [1e15, 1e19, 1e25, 1e30, 3e38] {
            assert!((removed::<f32>(x, 1.0) - 1.0).abs() < 1e-6, "{x}");
        }
        for x in [1e100, 1e160, 1e300] {
            assert_eq!(removed::<f64>(x, 1.0), 1.0);
        }
    }
}
