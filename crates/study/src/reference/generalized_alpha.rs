//! Generalised-α on Lie groups with one sparse solve, for nearly rigid joints.
//!
//! `(mechanism, state, step, ρ∞) => state` (Chung & Hulbert 1993; on Lie groups Brüls, Cardona & Arnold 2012), with
//! the residual at the predicted pose and one Newton step from there, which is all that second order takes. Per body
//! u the velocities, a the algorithmic and d the true accelerations, `ᾱ = (α_m, α_f)` of ρ∞:
//!
//! 1. `û = u + h·(1−γ)·a`, `q̂ = q ∘ exp(h·u + h²·(½−β)·a)`
//! 2. `((1−α_m)/(1−α_f)·M + γ·h·C + β·h²·K)·a⁺ = F(q̂, û) + M·(α_f·d − α_m·a)/(1−α_f)`
//! 3. `u⁺ = û + γ·h·a⁺`, `q⁺ = q̂ ∘ exp(β·h²·a⁺)`, `d⁺ = ((1−α_m)·a⁺ + α_m·a − α_f·d)/(1−α_f)`
//!
//! With dampers the stored a predicts the whole step: F is taken at û + γ·h·a and at the pose with β·h²·a, and the
//! solution is a⁺ − a, which the matrix's damping, one of lumped joints, multiplies to first order in h only.
//!
//! C and K as in [`crate::reference::implicit`], so that a factor exists for every step. They leave the gyroscopic
//! torque out, whose change within the step would be lost; F has it at û + γ·h·a, not at û: without that a tumbling
//! body is followed to first order only. Second order in the slow motion, and
//! whatever vibrates fast against the step is damped by ρ∞ in each. Loads and tables jump where a step begins.
//!
//! A first step has no accelerations. It uses one value for the whole step, that at which the joints close at its
//! fraction τ, `½·τ² = β·(1−α_f)/(1−α_m)`: with the same matrix from `q ∘ exp(τ·h·u)`, `a = d`.

use nalgebra::{DVector, Matrix6, Vector3, Vector6};

use crate::reference::blocks::{BlockMatrix, join, levers};
use crate::reference::mechanism::{Acceleration, Mechanism};
use crate::reference::signals::Clock;
use crate::reference::state::State;

/// A mechanism in time integration.
pub struct GeneralizedAlpha<'m> {
    mechanism: &'m Mechanism,
    /// The present state.
    pub state: State,
    step: f64,
    steps: u64,
    weights: Weights,
    /// Algorithmic and true acceleration of each body; none before the first step.
    memory: Vec<[Vector6<f64>; 2]>,
    matrix: BlockMatrix,
    /// Whether any spring has a damper.
    is_damped: bool,
}

/// The coefficients of a ρ∞.
#[derive(Clone, Copy)]
struct Weights {
    mass: f64,
    beta: f64,
    gamma: f64,
    alpha_m: f64,
    alpha_f: f64,
}

impl Weights {
    fn of(rho: f64) -> Self {
        let alpha_m = (2.0 * rho - 1.0) / (rho + 1.0);
        let alpha_f = rho / (rho + 1.0);
        let gamma = 0.5 - alpha_m + alpha_f;
        let beta = 0.25 * (gamma + 0.5) * (gamma + 0.5);
        Self { mass: (1.0 - alpha_m) / (1.0 - alpha_f), beta, gamma, alpha_m, alpha_f }
    }
}

impl<'m> GeneralizedAlpha<'m> {
    /// Default amplitude factor per step of an unresolved vibration.
    pub const RHO: f64 = 0.5;

    /// A run from `state` at t = 0 with a step \[s\]; `rho` is ρ∞, from 0 to 1.
    #[must_use]
    pub fn new(mechanism: &'m Mechanism, state: State, step: f64, rho: f64) -> Self {
        let weights = Weights::of(rho);
        let matrix = BlockMatrix::of(mechanism);
        let mut is_damped = false;
        let at = mechanism.at(&state, Clock::between(0.0, [0.0, step]));
        for element in &mechanism.elements {
            element.springs(&at, &mut |spring| is_damped |= spring.damping > 0.0);
        }
        drop(at);
        Self { mechanism, state, step, steps: 0, weights, memory: Vec::new(), matrix, is_damped }
    }

    /// Resets the accelerations to those of the present state in the coming step: the stored ones are invalid after a
    /// jump of a load or a table.
    fn begin(&mut self) {
        let clock = Clock::between(self.time(), self.piece());
        let at = self.mechanism.at(&self.state, clock);
        let responses = self.mechanism.respond(&at);
        self.memory = responses.iter().map(|response| [joined(response); 2]).collect();
    }

    /// \[s\] the times between which the coming step lies.
    fn piece(&self) -> [f64; 2] {
        [self.steps, self.steps + 1].map(|steps| steps as f64 * self.step)
    }

    /// Whether a load or a table jumps where the coming step begins.
    fn is_after_jump(&self) -> bool {
        let (now, near) = (self.time(), 0.5 * self.step);
        self.steps > 0 && !self.mechanism.jumps([now - near, now + near]).is_empty()
    }

    /// \[s\] the present time.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.steps as f64 * self.step
    }

    /// A step: one evaluation, one factorisation, one solve.
    ///
    /// # Panics
    /// Where the state is not finite; the matrix then has no factor.
    pub fn step(&mut self) {
        let (h, w) = (self.step, self.weights);
        if self.is_after_jump() {
            self.begin();
        }
        if self.memory.is_empty() {
            return self.first_step();
        }
        let piece = self.piece();
        let before: Vec<_> = self.velocities();
        let (near, far) = if self.is_damped { (0.5, 1.0) } else { (0.5 - w.beta, 1.0 - w.gamma) };
        self.state.set_velocities(&before, &self.memory, near * h);
        self.state.drift(h);
        self.state.set_velocities(&before, &self.memory, far * h);
        self.steps += 1;

        let solution = self.accelerations(piece);
        let predicted = self.velocities();
        for ([a, d], solution) in self.memory.iter_mut().zip(&solution) {
            let next = if self.is_damped { *a + solution } else { *solution };
            *d = (next * (1.0 - w.alpha_m) + *a * w.alpha_m - *d * w.alpha_f) / (1.0 - w.alpha_f);
            *a = next;
        }
        let rest = vec![Vector6::zeros(); predicted.len()];
        let solution: Vec<_> = solution.iter().map(|solution| [*solution; 2]).collect();
        self.state.set_velocities(&rest, &solution, w.beta * h);
        self.state.drift(h);
        self.state.set_velocities(&predicted, &solution, w.gamma * h);
        self.mechanism.settle(&mut self.state);
    }

    /// A step of one acceleration.
    fn first_step(&mut self) {
        let (h, w) = (self.step, self.weights);
        let piece = self.piece();
        let at = (2.0 * w.beta / w.mass).sqrt();
        self.memory = vec![[Vector6::zeros(); 2]; self.mechanism.bodies.len()];
        let before = self.velocities();
        self.state.drift(at * h);
        self.steps += 1;
        let next = self.accelerations(piece);
        self.memory = next.iter().map(|next| [next * w.mass; 2]).collect();
        let rest: Vec<_> = before.iter().map(|before| before * (1.0 - at)).collect();
        self.state.set_velocities(&rest, &self.memory, 0.5 * h);
        self.state.drift(h);
        self.state.set_velocities(&before, &self.memory, h);
        self.mechanism.settle(&mut self.state);
    }

    /// The solution at the present pose with the stored accelerations; the step lies in `piece` \[s\].
    fn accelerations(&mut self, piece: [f64; 2]) -> Vec<Vector6<f64>> {
        let (h, w) = (self.step, self.weights);
        let mut right = DVector::zeros(6 * self.mechanism.bodies.len());
        self.matrix.clear();
        let at = self.mechanism.at(&self.state, Clock::between(self.time(), piece));
        let responses = self.mechanism.respond(&at);
        for (row, (response, [a, d])) in responses.iter().zip(&self.memory).enumerate() {
            let body = &self.mechanism.bodies[row];
            let mass = join(Vector3::repeat(body.mass), body.inertia);
            // The matrix knows nothing of the gyroscopic torque, which then is that of u⁺ to second order.
            let rate = at.rate(row);
            let known_part = if self.is_damped { 0.0 } else { w.gamma * h };
            let coming = rate + a.fixed_rows::<3>(3) * known_part;
            let gyroscopic = |rate: Vector3<f64>| rate.cross(&body.inertia.component_mul(&rate));
            let change = gyroscopic(rate) - gyroscopic(coming);
            let change = join(Vector3::zeros(), change.component_div(&body.inertia));
            let mut known =
                joined(response) + change + (d * w.alpha_f - a * w.alpha_m) / (1.0 - w.alpha_f);
            if self.is_damped {
                known -= a * w.mass;
            }
            self.matrix.add(row, row, &Matrix6::from_diagonal(&(mass * w.mass)));
            self.matrix.add_right(&mut right, row, &mass.component_mul(&known));
        }
        let matrix = &mut self.matrix;
        for element in &self.mechanism.elements {
            element.springs(&at, &mut |spring| {
                let rows = levers(&at, &spring);
                let weight = w.gamma * h * spring.damping + w.beta * h * h * spring.stiffness;
                for (a, j_a) in rows.iter().flatten() {
                    for (b, j_b) in rows.iter().flatten() {
                        matrix.add(*a, *b, &(j_a * j_b.transpose() * weight));
                    }
                }
            });
        }
        drop(at);

        let solution = self.matrix.solve(&right);
        (0..self.memory.len()).map(|row| self.matrix.part(&solution, row)).collect()
    }

    fn velocities(&self) -> Vec<Vector6<f64>> {
        self.state.bodies.iter().map(|body| join(body.velocity, body.rate)).collect()
    }
}

impl State {
    /// Velocities that are `base` and algorithmic accelerations for a time \[s\].
    fn set_velocities(&mut self, base: &[Vector6<f64>], memory: &[[Vector6<f64>; 2]], time: f64) {
        for (body, (base, [a, _])) in self.bodies.iter_mut().zip(base.iter().zip(memory)) {
            let velocities = base + a * time;
            body.velocity = velocities.fixed_rows::<3>(0).into();
            body.rate = velocities.fixed_rows::<3>(3).into();
        }
    }
}

fn joined(acceleration: &Acceleration) -> Vector6<f64> {
    join(acceleration.linear, acceleration.angular)
}

#[cfg(test)]
mod tests {
    use dbd_scene::Scene;

    use super::*;

    /// Without a new beginning at either jump the accelerations of before would act for another step.
    #[test]
    fn a_force_that_begins_and_ends_has_its_whole_effect_and_no_more() {
        let text = r#"
name = "pushed"
duration = 0.5
[[body]]
name = "weight"
mass = 2.0
inertia = [0.01, 0.01, 0.01]
position = [0, 0, 0]
[[load]]
body = "weight"
force = [4, 0, 0]
from = 0.1
until = 0.3
"#;
        let scene = Scene::parse(text, "pushed.toml").unwrap();
        let (mechanism, start) = Mechanism::of(&scene);
        let mut run = GeneralizedAlpha::new(&mechanism, start, 0.01, GeneralizedAlpha::RHO);
        (0..50).for_each(|_| run.step());
        // ½·2 m/s²·(0.2 s)², then 0.4 m/s for 0.2 s.
        assert!((run.state.bodies[0].position.x - 0.12).abs() < 1e-12, "{:?}", run.state.bodies);
    }
}
