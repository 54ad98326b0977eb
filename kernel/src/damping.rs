//! Dampers as pairwise exact impulses: unconditionally stable, momentum kept, energy never added.
//!
//! `(pose, velocities, h) => velocities`. For each damper along a direction u with rate `u·v_rel`
//! and effective mass μ, `1/μ = Σ_bodies (1/m + (r×u)ᵀ·I⁻¹·(r×u))`, the impulse
//! `p = μ·(1 − exp(−h·c/μ))·(u·v_rel)` pulls the two points together (compare Shardlow 2003).
//! One sweep goes through all dampers in ascending order before the conservative part of a step,
//! one in descending order after it, half a step each: second order. `exp(−x)` is replaced by
//! `1/(1 + x + x²/2)`: in (0, 1], second order, plain arithmetic.
//! A TSDA damps along its line, a torsion spring along its gradient, a point bushing along the
//! world's axes, a point on a line along the line's two normals, one after the other.

use crate::elements::clearance;
use crate::elements::torsion_spring::TorsionSpring;
use crate::geometry::Geometry;
use crate::groups::{self, End, Placed, Places};
use crate::model::{Body, BodyIndex, Group, Law, ModelRef, Terms};
use crate::real::Real;
use crate::state::BodyState;
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

/// The fraction of a relative velocity that a damper removes, in \[0, 1), for `x = h·c/μ`.
#[inline(always)]
fn removed<R: Real>(x: R) -> R {
    R::ONE - R::ONE / (R::ONE + x + R::HALF * (x * x))
}

/// What a unit impulse does to one body: `u/m` and `I⁻¹·n`, n its moment in body axes.
struct Lever<R> {
    row: usize,
    linear: Vec3<R>,
    moment: Vec3<R>,
    inverse_mass: R,
    inverse_inertia: Vec3<R>,
}

impl<R: Real> Lever<R> {
    #[inline(always)]
    fn new(row: usize, body: Option<&Body<R>>, linear: Vec3<R>, moment: Vec3<R>) -> Option<Self> {
        body.map(|body| Self {
            row,
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

    /// `u·v + n·ω`.
    #[inline(always)]
    fn rate<P: Geometry<Real = R>>(&self, bodies: &[BodyState<P>]) -> R {
        match bodies.get(self.row) {
            Some(state) => {
                self.linear.dot(P::velocity(&state.velocity))
                    + self.moment.dot(P::velocity(&state.angular_velocity))
            }
            None => R::ZERO,
        }
    }

    #[inline(always)]
    fn push<P: Geometry<Real = R>>(&self, bodies: &mut [BodyState<P>], impulse: R) {
        if let Some(state) = bodies.get_mut(self.row) {
            let linear = self.linear * (impulse * self.inverse_mass);
            let angular = self.moment.scale(self.inverse_inertia) * impulse;
            P::accelerate(&mut state.velocity, linear);
            P::accelerate(&mut state.angular_velocity, angular);
        }
    }
}

/// The impulse of one damper between two levers over the time `h`.
#[inline(always)]
fn damp<P: Geometry>(
    bodies: &mut [BodyState<P>],
    a: Option<Lever<P::Real>>,
    b: Option<Lever<P::Real>>,
    ground_rate: P::Real,
    damping: P::Real,
    h: P::Real,
) {
    let zero = P::Real::ZERO;
    let inverse = a.as_ref().map_or(zero, Lever::inverse_effective_mass)
        + b.as_ref().map_or(zero, Lever::inverse_effective_mass);
    // Without a direction (coincident points) nothing can be pushed.
    if inverse == zero {
        return;
    }
    let rate = b.as_ref().map_or(zero, |b| b.rate(bodies))
        - a.as_ref().map_or(zero, |a| a.rate(bodies))
        + ground_rate;
    let impulse = removed(h * damping * inverse) / inverse * rate;
    if let Some(a) = a {
        a.push(bodies, impulse);
    }
    if let Some(b) = b {
        b.push(bodies, -impulse);
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
    let elements = group.elements();
    for i in 0..elements {
        let i = if REVERSE { elements - 1 - i } else { i };
        let (Some(element), Some(&whole)) =
            (groups::placed(model, places, (0, group), i), dampers.get(i))
        else {
            continue;
        };
        let d = element.displacement;
        let damping = engaged(model, &element, whole);
        if T::CLEARANCES && damping == P::Real::ZERO {
            continue;
        }
        // The directions, and how many of them the law damps.
        let (mut directions, count) = match group.law {
            Law::Tsda if T::TSDAS => {
                let along = d * d.dot(d).sqrt().reciprocal_or_zero();
                ([along, Vec3::ZERO, Vec3::ZERO], 1)
            }
            Law::PointBushing if T::BUSHINGS => (Vec3::axes(), 3),
            Law::PointOnLine if T::LINES => {
                let [n, m] = element.direction.normals();
                ([n, m, Vec3::ZERO], 2)
            }
            _ => continue,
        };
        if REVERSE && count > 1 {
            directions.swap(0, count - 1);
        }
        for u in directions.into_iter().take(count) {
            let lever = |body: BodyIndex, arm: Vec3<P::Real>| {
                let (frame, row) = (places.frames.get(body.row())?, body.row());
                Lever::new(row, model.bodies.get(row), u, P::to_body(frame, arm.cross(u)))
            };
            let (a, b) = (lever(group.a, element.arm_a), lever(group.b, element.arm_b));
            damp(bodies, a, b, u.dot(element.ground_rate), damping, h);
        }
    }
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
    let d = element.displacement;
    let extension = match element.group.law {
        Law::Tsda => model.tsdas.get(element.index).map(|tsda| tsda.extension(d)),
        Law::PointOnLine => model.lines.get(element.index).map(|line| line.extension(d)),
        Law::PointBushing => None,
    };
    extension.map_or(damping, |extension| clearance::engaged(damping, extension, clearance))
}

/// A torsion spring's damper, along the gradient of its twist. An undefined twist is left to the
/// next evaluation, which reports it.
#[inline(always)]
fn torsion<P: Geometry, T: Terms>(
    model: &ModelRef<'_, P, T>,
    spring: &TorsionSpring<P::Real>,
    mut turns: i32,
    h: P::Real,
    places: Places<'_, P>,
    bodies: &mut [BodyState<P>],
) {
    let Some(&damping) = spring.damper.row().and_then(|row| model.dampers.get(row)) else {
        return;
    };
    let (row_a, row_b) = (spring.a.row(), spring.b.row());
    let relative = P::relative(
        bodies.get(row_a).map(|s| &s.orientation),
        bodies.get(row_b).map(|s| &s.orientation),
    );
    let Some(twist) = spring.twist(relative, &mut turns, false) else {
        return;
    };
    let (frame_a, frame_b) = (places.frames.get(row_a), places.frames.get(row_b));
    let world = End::new(model, places, spring.a, None).to_world(twist.gradient);
    let lever = |row: usize, frame: Option<&P::Frame>| {
        frame.and_then(|f| Lever::new(row, model.bodies.get(row), Vec3::ZERO, P::to_body(f, world)))
    };
    let zero = P::Real::ZERO;
    damp(bodies, lever(row_a, frame_a), lever(row_b, frame_b), zero, damping, h);
}
