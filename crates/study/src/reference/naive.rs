//! The same steps as a std user would write them: semi-implicit Euler and leapfrog.
//!
//! `(mechanism, state, step) => state`. Dampers are explicit forces, a tumbling body's rotation
//! is the exponential map of its rate; no care is taken of allocations or of the order of sums.

use crate::reference::mechanism::{Acceleration, Mechanism};
use crate::reference::state::State;

/// A mechanism in time integration.
pub struct Naive<'m> {
    mechanism: &'m Mechanism,
    /// The present state.
    pub state: State,
    step: f64,
    steps: u64,
    last: Option<Vec<Acceleration>>,
}

impl<'m> Naive<'m> {
    /// A run from `state` at t = 0 with a step \[s\].
    #[must_use]
    pub fn new(mechanism: &'m Mechanism, state: State, step: f64) -> Self {
        Self { mechanism, state, step, steps: 0, last: None }
    }

    /// \[s\] the present time.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.steps as f64 * self.step
    }

    /// A step of semi-implicit Euler: first order, one evaluation.
    pub fn semi_implicit_euler(&mut self) {
        let accelerations = self.mechanism.accelerations(&self.state, self.time());
        self.kick(&accelerations, self.step);
        self.state.drift(self.step);
        self.finish();
    }

    /// A step of kick–drift–kick: second order, one evaluation.
    pub fn leapfrog(&mut self) {
        let before = self.last.take();
        let before =
            before.unwrap_or_else(|| self.mechanism.accelerations(&self.state, self.time()));
        self.kick(&before, 0.5 * self.step);
        self.state.drift(self.step);
        self.finish();
        let after = self.mechanism.accelerations(&self.state, self.time());
        self.kick(&after, 0.5 * self.step);
        self.last = Some(after);
    }

    fn kick(&mut self, accelerations: &[Acceleration], time: f64) {
        for (body, acceleration) in self.state.bodies.iter_mut().zip(accelerations) {
            body.velocity += acceleration.linear * time;
            body.rate += acceleration.angular * time;
        }
    }

    fn finish(&mut self) {
        self.mechanism.settle(&mut self.state);
        self.steps += 1;
    }
}
