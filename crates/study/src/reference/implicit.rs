//! Linearly implicit Euler with one sparse solve, as in real-time models of suspensions.
//!
//! `(mechanism, state, step) => state`:
//! `(M + h·C + h²·K)·Δv = h·F(q, v) − h²·K·v`, `v ← v + Δv`, `q ← q ∘ h·v` (Baraff & Witkin 1998).
//! K and C are the elements' analytic tangents without the geometric stiffness, symmetric and positive semidefinite in
//! any pose, so that a Cholesky factor exists for every step; the pattern and its order of elimination are computed
//! once. First order; damps vibrations that the step does not resolve.

use nalgebra::{DVector, Matrix6, Vector3};

use crate::reference::blocks::{BlockMatrix, join, levers};
use crate::reference::elements::Spring;
use crate::reference::instant::Instant;
use crate::reference::mechanism::Mechanism;
use crate::reference::signals::Clock;
use crate::reference::state::State;

/// A mechanism in time integration.
pub struct Implicit<'m> {
    mechanism: &'m Mechanism,
    /// The present state.
    pub state: State,
    step: f64,
    steps: u64,
    matrix: BlockMatrix,
}

impl<'m> Implicit<'m> {
    /// A run from `state` at t = 0 with a step \[s\].
    #[must_use]
    pub fn new(mechanism: &'m Mechanism, state: State, step: f64) -> Self {
        Self { mechanism, state, step, steps: 0, matrix: BlockMatrix::of(mechanism) }
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
        let h = self.step;
        let mut right = DVector::zeros(6 * self.mechanism.bodies.len());
        self.matrix.clear();
        let at = self.mechanism.at(&self.state, Clock::at(self.time()));
        for (row, acceleration) in self.mechanism.respond(&at).iter().enumerate() {
            let body = &self.mechanism.bodies[row];
            let mass = join(Vector3::repeat(body.mass), body.inertia);
            let change = join(acceleration.linear, acceleration.angular) * h;
            self.matrix.add(row, row, &Matrix6::from_diagonal(&mass));
            self.matrix.add_right(&mut right, row, &mass.component_mul(&change));
        }
        let matrix = &mut self.matrix;
        for element in &self.mechanism.elements {
            element.springs(&at, &mut |spring| implicit(matrix, &mut right, &at, &spring, h));
        }
        drop(at);
        let change = self.matrix.solve(&right);
        for (row, body) in self.state.bodies.iter_mut().enumerate() {
            let change = self.matrix.part(&change, row);
            body.velocity += change.fixed_rows::<3>(0);
            body.rate += change.fixed_rows::<3>(3);
        }
        self.state.drift(h);
        self.mechanism.settle(&mut self.state);
        self.steps += 1;
    }
}

/// Adds a spring's `(h·c + h²·k)·j·jᵀ` and `−h²·k·rate·j`.
fn implicit(
    matrix: &mut BlockMatrix,
    right: &mut DVector<f64>,
    at: &Instant<'_>,
    spring: &Spring,
    h: f64,
) {
    let rows = levers(at, spring);
    let weight = h * spring.damping + h * h * spring.stiffness;
    for (a, j_a) in rows.iter().flatten() {
        matrix.add_right(right, *a, &(j_a * (-h * h * spring.stiffness * spring.rate)));
        for (b, j_b) in rows.iter().flatten() {
            matrix.add(*a, *b, &(j_a * j_b.transpose() * weight));
        }
    }
}
