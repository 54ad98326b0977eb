//! Conformance tests for custom laws.
//!
//! `(law, ranges of the motion) => the first rule that it breaks`. The poses are random, in double precision, from a
//! fixed seed: a failure is the same on every machine.

use dbd_kernel::attitude::Attitude as _;
use dbd_kernel::laws::{ForcePair, Instant, Interaction, Law, Seen};
use dbd_kernel::schedule::Signal;
use dbd_kernel::words::Words as _;
use dbd_kernel::{BodyState, F64, Geometry as _, Quaternion, Vec3};

use crate::laws::Listed;

/// The motion in which a law is tested.
#[derive(Clone, Copy, Debug)]
pub struct Poses {
    /// Number of poses.
    pub count: usize,
    /// \[m\] largest distance of B's point from A's in each direction; large enough to cover every regime of the law.
    pub reach: f64,
    /// \[rad\] largest rotation of B in A in each direction.
    pub turn: f64,
    /// \[m/s, rad/s\] largest speed of the bodies.
    pub speed: f64,
    /// \[its unit\] value of the input with index 0.
    pub input: f64,
}

impl Default for Poses {
    fn default() -> Self {
        Self { count: 200, reach: 0.1, turn: 1.0, speed: 1.0, input: 0.0 }
    }
}

/// Largest allowed difference of two difference quotients, relative to the largest.
const NEAR: f64 = 1e-4;

/// A difference of coordinates \[m, rad\].
const STEP: f64 = 1e-6;

type State = [BodyState<F64>; 2];
type Twelve = [f64; 12];

/// Tests a law between two bodies: action equals reaction and angular momentum is conserved, force is minus the
/// gradient of the energy, the tangent bounds the change of the force, dampers dissipate power, and settling is
/// idempotent. A memory is settled at a pose and used there and at another one nearby.
///
/// `law` is a row of it between `BodyIndex(0)` and `BodyIndex(1)`, with points near the origins of both.
///
/// # Errors
/// The first rule that is broken, with the numbers.
pub fn hold<L: Law>(law: &L, poses: Poses) -> Result<(), String> {
    let mut random = Random(0x2545_f491_4f6c_dd1d);
    let mut met = false;
    for number in 0..poses.count {
        let state = random.state(poses);
        let [reach, turn] = [poses.reach, poses.turn].map(|most| 0.25 * most);
        let way = [[reach; 3], [turn; 3], [reach; 3], [turn; 3]];
        let way = way.as_flattened().iter().map(|most| random.between(*most));
        let way: Vec<f64> = way.collect();
        let later = moved(&state, &std::array::from_fn(|freedom| way[freedom]), 1.0);
        met |= at(law, [&state, &later], poses.input)
            .map_err(|why| format!("pose {number}: {why}"))?;
    }
    if met { Ok(()) } else { Err("the law has no effect at any pose: use another `reach`".into()) }
}

/// The memory of a law.
type Memory<L> = <L as Interaction<F64>>::State;

/// A memory with what it keeps of a pose.
fn kept<L: Law>(law: &L, seen: &Seen<'_, F64>, memory: &Memory<L>) -> Memory<L> {
    let mut memory = *memory;
    law.keep_pose(seen, &mut memory);
    memory
}

/// Checks the rules at a pose and, with its memory, at a later one; returns whether the law has an effect there.
fn at<L: Law>(law: &L, [state, later]: [&State; 2], input: f64) -> Result<bool, String> {
    let frames = frames(state);
    let signals = [Signal { value: input, rate: 0.0 }];
    let instant = Instant { frames: &frames, bodies: state, signals: &signals };
    let Some(seen) = instant.seen(law.bodies()) else {
        return Err("the law's bodies are not 0 and 1".into());
    };
    let mut memory = kept(law, &seen, &Memory::<L>::default());
    let unsettled = law.energy(&seen, &memory);
    law.settle(&seen, &mut memory);
    let lost = unsettled - law.energy(&seen, &memory);
    if lost.abs() > 1e-9 * unsettled.abs() && !<L as Interaction<F64>>::SLIPS {
        return Err(format!("settling loses {lost} J: such a law must set SLIPS"));
    }
    let words = |memory: &Memory<L>| {
        let mut list = Listed::default();
        memory.visit(&mut list);
        list.0
    };
    let once = words(&memory);
    law.settle(&seen, &mut memory);
    if words(&memory) != once {
        return Err(format!("settling is not idempotent: {once:?}, {:?}", words(&memory)));
    }
    if <L as Interaction<F64>>::ADVANCE_SETTLES {
        let mut advanced = memory;
        law.advance(&seen, STEP, &mut advanced);
        let once = words(&advanced);
        law.settle(&seen, &mut advanced);
        if words(&advanced) != once {
            let twice = words(&advanced);
            return Err(format!("advancing does not settle: {once:?}, {twice:?}"));
        }
    }
    let acts = with(law, (state, input), &memory)?;
    Ok(acts
        | with(law, (later, input), &memory).map_err(|why| format!("without settling: {why}"))?)
}

/// Checks the rules at a pose with a memory.
fn with<L: Law>(
    law: &L,
    (state, input): (&State, f64),
    memory: &Memory<L>,
) -> Result<bool, String> {
    let frames = frames(state);
    let signals = [Signal { value: input, rate: 0.0 }];
    let instant = Instant { frames: &frames, bodies: state, signals: &signals };
    let Some(seen) = instant.seen(law.bodies()) else { return Ok(false) };
    let memory = &kept(law, &seen, memory);
    let Some(force_pair) = law.force_pair(&seen, memory) else { return Ok(false) };
    let forces = generalised(&force_pair);
    let size = forces.iter().fold(0.0, |most: f64, force| most.max(force.abs()));
    momentum(state, &force_pair)?;
    gradient(law, (state, input), memory, &forces, size)?;
    tangent(law, (state, input), memory, &seen)?;
    let mut acts = size > 0.0;
    let mut dampers = 0;
    let mut drawn = Ok(());
    law.dampers(&seen, memory, &mut |damper| {
        dampers += 1;
        let rate = seen.rate(&damper.direction);
        let tension = damper.tension(rate);
        acts |= tension != 0.0;
        if damper.rate == 0.0 && tension * rate < 0.0 {
            drawn = Err(format!("a damper supplies {} W", -tension * rate));
        }
        if <L as Interaction<F64>>::TURNS && damper.direction.along != Vec3::ZERO {
            drawn = Err(format!("damper {dampers} acts on translations, but the law sets TURNS"));
        }
        let pull = momentum(state, &seen.pull(&damper.direction, 1.0));
        drawn = drawn.clone().and(pull.map_err(|why| format!("damper {dampers}: {why}")));
    });
    drawn?;
    if dampers > <<L as Interaction<F64>>::Dampers as dbd_kernel::laws::Several>::COUNT {
        return Err(format!("the law visits {dampers} dampers, more than it declares"));
    }
    Ok(acts)
}

/// The forces conserve angular momentum.
fn momentum(state: &State, force_pair: &ForcePair<f64>) -> Result<(), String> {
    let size = generalised(force_pair).iter().fold(0.0, |most: f64, force| most.max(force.abs()));
    let whole =
        |body: &BodyState<F64>, torque: Vec3<f64>| body.position.cross(force_pair.force) + torque;
    let left = whole(&state[0], force_pair.torque_a) - whole(&state[1], force_pair.torque_b);
    let lever = state.iter().fold(1.0, |most: f64, body| most.max(length(body.position)));
    if length(left) > 1e-9 * size * lever {
        return Err(format!("angular momentum is not conserved: {left:?} N·m of {size} N"));
    }
    Ok(())
}

/// Force is minus the gradient of the energy, where the gradient exists.
fn gradient<L: Law>(
    law: &L,
    (state, input): (&State, f64),
    memory: &Memory<L>,
    forces: &Twelve,
    size: f64,
) -> Result<(), String> {
    let energy = |way: &Twelve, by: f64| {
        let moved = moved(state, way, by);
        look(law, (&moved, input), |seen| law.energy(seen, &kept(law, seen, memory)))
    };
    for freedom in 0..12 {
        let mut way = [0.0; 12];
        way[freedom] = 1.0;
        let slope = |h: f64| (energy(&way, h) - energy(&way, -h)) / (2.0 * h);
        let (wide, narrow) = (slope(2.0 * STEP), slope(STEP));
        let most = size.max(narrow.abs());
        let is_smooth = (wide - narrow).abs() <= NEAR * most;
        // Errors of the difference due to the last digits of the energy and of the positions.
        let (middle, [before, after]) =
            (energy(&way, 0.0), [-STEP, STEP].map(|by| energy(&way, by)));
        let stiffness = (before - 2.0 * middle + after) / (STEP * STEP);
        let rounding = 1e-15 * (middle.abs() / STEP + stiffness.abs());
        if is_smooth && (narrow + forces[freedom]).abs() > NEAR * most + 10.0 * rounding {
            return Err(format!(
                "force is not minus the energy gradient: {} and {} along degree of freedom \
                 {freedom}",
                forces[freedom], -narrow
            ));
        }
    }
    Ok(())
}

/// No displacement of one body changes its force by more than the tangent.
fn tangent<L: Law>(
    law: &L,
    (state, input): (&State, f64),
    memory: &Memory<L>,
    seen: &Seen<'_, F64>,
) -> Result<(), String> {
    let forces = |way: &Twelve, by: f64| {
        let moved = moved(state, way, by);
        look(law, (&moved, input), |seen| {
            let memory = kept(law, seen, memory);
            law.force_pair(seen, &memory).map(|force_pair| generalised(&force_pair))
        })
    };
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    for body in 0..2 {
        for _ in 0..4 {
            let mut way = [0.0; 12];
            way[6 * body..6 * body + 6].fill_with(|| random.between(1.0));
            let slope = |h: f64| {
                let (Some(after), Some(before)) = (forces(&way, h), forces(&way, -h)) else {
                    return 0.0;
                };
                let pairs = after.iter().zip(before).zip(way);
                pairs.fold(0.0, |sum, ((after, before), way)| {
                    sum - (after - before) / (2.0 * h) * way
                })
            };
            let found = slope(STEP);
            if (found - slope(2.0 * STEP)).abs() > NEAR * found.abs() {
                continue;
            }
            let (along, about) = (vector(&way[6 * body..]), vector(&way[6 * body + 3..]));
            let mut most = 0.0;
            let turned = law.tangent(seen, memory, &mut |stiffness, direction| {
                let end = if body == 0 { &seen.a } else { &seen.b };
                let moment = end.moment_to_world(direction.moments[body]);
                let rate = direction.along.dot(along) + moment.dot(about);
                most += stiffness * rate * rate;
            });
            most += turned[body] * about.dot(about);
            if found > most * (1.0 + NEAR) + 1e-6 * most.abs().max(found.abs()) {
                return Err(format!(
                    "the tangent is too small: moving body {body} gives {found} N/m, the law \
                     declares {most}"
                ));
            }
        }
    }
    Ok(())
}

/// Evaluates a law at a pose.
fn look<L: Law, A>(
    law: &L,
    (state, input): (&State, f64),
    look: impl FnOnce(&Seen<'_, F64>) -> A,
) -> A
where
    A: Default,
{
    let frames = frames(state);
    let signals = [Signal { value: input, rate: 0.0 }];
    let instant = Instant { frames: &frames, bodies: state, signals: &signals };
    instant.seen(law.bodies()).map_or_else(A::default, |seen| look(&seen))
}

fn frames(state: &State) -> [<F64 as dbd_kernel::Geometry>::Frame; 2] {
    state.map(|body| F64::frame(&body.position, &body.orientation))
}

/// Forces and torques on A and on B, world axes.
fn generalised(force_pair: &ForcePair<f64>) -> Twelve {
    let parts = [force_pair.force, force_pair.torque_a, -force_pair.force, -force_pair.torque_b];
    let mut all = [0.0; 12];
    for (three, part) in all.chunks_mut(3).zip(parts) {
        three.copy_from_slice(&part.to_f64());
    }
    all
}

/// The bodies moved along a direction in configuration space; rotations are about the world's axes.
fn moved(state: &State, way: &Twelve, by: f64) -> State {
    let mut moved = *state;
    for (body, way) in moved.iter_mut().zip(way.chunks(6)) {
        body.position = body.position + vector(way) * by;
        body.orientation = turned(&body.orientation, vector(&way[3..]) * by);
    }
    moved
}

/// An orientation rotated about a world axis by the length of the vector \[rad\].
fn turned(q: &Quaternion<f64>, turn: Vec3<f64>) -> Quaternion<f64> {
    let angle = length(turn);
    let (sin, cos) = libm::sincos(angle / 2.0);
    let v = turn * if angle > 0.0 { sin / angle } else { 0.5 };
    let mut turned = Quaternion::new(cos, v.x, v.y, v.z).product(*q);
    turned.renormalise();
    turned
}

fn vector(numbers: &[f64]) -> Vec3<f64> {
    Vec3::new(numbers[0], numbers[1], numbers[2])
}

fn length(v: Vec3<f64>) -> f64 {
    libm::sqrt(v.dot(v))
}

/// Numbers from a seed (Marsaglia 2003, xorshift64).
struct Random(u64);

impl Random {
    /// A number between −`most` and `most`.
    fn between(&mut self, most: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        ((self.0 >> 11) as f64 / (1u64 << 53) as f64 * 2.0 - 1.0) * most
    }

    fn vector(&mut self, most: f64) -> Vec3<f64> {
        Vec3::new(self.between(most), self.between(most), self.between(most))
    }

    fn state(&mut self, poses: Poses) -> State {
        let Poses { reach, turn, speed, .. } = poses;
        let first = turned(&Quaternion::IDENTITY, self.vector(1.5));
        let place = self.vector(1.0);
        let away = self.vector(reach);
        let relative = turned(&Quaternion::IDENTITY, self.vector(turn));
        let second = first.product(relative);
        let rotation = first.rotation();
        let mut body = |position: Vec3<f64>, q: Quaternion<f64>| {
            let (velocity, spin) = (self.vector(speed), self.vector(speed));
            let q = [q.w, q.v.x, q.v.y, q.v.z];
            BodyState::from_f64(position.to_f64(), q, velocity.to_f64(), spin.to_f64())
        };
        [body(place, first), body(place + rotation.to_world(away), second)]
    }
}

#[cfg(test)]
mod bushings;
#[cfg(test)]
mod drives;
#[cfg(test)]
mod springs;
#[cfg(test)]
mod stops;
#[cfg(test)]
mod tests;
