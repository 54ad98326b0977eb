//! The reference solution: two integrators of high order at tight tolerances.
//!
//! `(mechanism, state, times) => states`. DOP853 (Hairer, Nørsett & Wanner 1993) is the reference solution, the pair
//! 9(8) of Verner (2010) the second integrator. Both end a step at every sample and at every jump of a load or table, so
//! that no sample is interpolated and no step straddles a jump.

use differential_equations::control::ControlFlag;
use differential_equations::error::Error;
use differential_equations::interpolate::Interpolation;
use differential_equations::ivp::IVP;
use differential_equations::methods::ExplicitRungeKutta;
use differential_equations::ode::ODE;
use differential_equations::solout::Solout;
use differential_equations::solution::Solution;
use miette::Diagnostic;
use thiserror::Error;

use crate::reference::equations::{Equations, pack, unpack};
use crate::reference::mechanism::Mechanism;
use crate::reference::spectrum::eigenfrequencies;
use crate::reference::state::State;

/// Relative and absolute tolerance of a step of DOP853, SI units.
pub const TOLERANCE: f64 = 1e-12;

/// Tolerances of the second integrator, whose measure of an error is the largest component, not the mean:
/// at 1e-12 the rounding of light bodies' accelerations would drive its step.
pub const SECOND_TOLERANCE: f64 = 1e-11;

/// Maximum steps of an integrator: a constant, plus a number per radian of the highest frequency at the start. A
/// mechanism that reaches a pose with an undefined direction has no reference solution beyond it, however short the
/// steps.
const MAX_STEPS: [f64; 2] = [2e5, 100.0];

/// Which integrator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Integrator {
    /// Dormand & Prince's 8(5,3).
    Dop853,
    /// Verner's 9(8).
    Verner98,
}

/// Missing reference solution.
#[derive(Clone, Debug, PartialEq, Error, Diagnostic)]
#[error("no reference solution beyond {time} s: {reason}")]
#[diagnostic(help(
    "use a shorter window that ends before a torsion angle is undefined or a spring's \
                   points coincide"
))]
pub struct NoReferenceSolution {
    /// \[s\] where the integrator stopped, or the start of the piece.
    pub time: f64,
    /// The integrator's message.
    pub reason: String,
}

/// The states at ascending `times` \[s\] from `start` at t = 0.
///
/// # Errors
/// If the integrator fails.
pub fn integrate(
    integrator: Integrator,
    mechanism: &Mechanism,
    start: &State,
    times: &[f64],
) -> Result<Vec<State>, NoReferenceSolution> {
    let bodies = mechanism.bodies.len();
    let mut states = Vec::with_capacity(times.len());
    let end = times.last().copied().unwrap_or_default();
    let highest = eigenfrequencies(mechanism, start, 0.0).last().map_or(0.0, |rate| rate.max(0.0));
    let [least, each] = MAX_STEPS;
    let left = (least + each * highest * end) as usize;
    let mut piece = Piece { y: pack(start, 0.0), time: 0.0, step: 0.0, left };
    let mut jumps = mechanism.jumps([0.0, end]).into_iter().peekable();
    for &time in times {
        while let Some(jump) = jumps.next_if(|jump| *jump < time) {
            piece.advance(integrator, mechanism, jump)?;
        }
        piece.advance(integrator, mechanism, time)?;
        states.push(unpack(&piece.y, bodies));
    }
    Ok(states)
}

/// Progress of an integration.
struct Piece {
    y: Vec<f64>,
    time: f64,
    /// \[s\] a step that was accepted, 0 before the first.
    step: f64,
    /// Steps that may still be taken.
    left: usize,
}

impl Piece {
    fn advance(
        &mut self,
        integrator: Integrator,
        mechanism: &Mechanism,
        end: f64,
    ) -> Result<(), NoReferenceSolution> {
        if end <= self.time {
            return Ok(());
        }
        let equations = Equations::new(mechanism, [self.time, end]);
        let (steps, y) = self.solve(integrator, &equations, end)?;
        self.step = steps.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        self.left = self.left.saturating_sub(steps.len());
        self.y = y;
        self.time = end;
        Ok(())
    }

    /// The times of the steps and the values at the last.
    fn solve(
        &self,
        integrator: Integrator,
        equations: &Equations<'_>,
        end: f64,
    ) -> Result<(Vec<f64>, Vec<f64>), NoReferenceSolution> {
        let problem = IVP::ode(equations, self.time, end, self.y.clone()).solout(Latest);
        let first = self.step.min(end - self.time);
        let solution = match integrator {
            Integrator::Dop853 => {
                let method = ExplicitRungeKutta::dop853().rtol(TOLERANCE).atol(TOLERANCE);
                problem.method(method.h0(first).max_steps(self.left)).solve()
            }
            Integrator::Verner98 => {
                let method = ExplicitRungeKutta::rkv988e();
                let method = method.rtol(SECOND_TOLERANCE).atol(SECOND_TOLERANCE);
                problem.method(method.h0(first).max_steps(self.left)).solve()
            }
        };
        match solution {
            Ok(mut solution) => self.finite(solution.y.pop()).map(|y| (solution.t, y)),
            Err(Error::StepSize { t, .. } | Error::Stiffness { t, .. }) => {
                Err(NoReferenceSolution { time: t, reason: "no step size is small enough".into() })
            }
            Err(Error::MaxSteps { t, .. }) => {
                Err(NoReferenceSolution { time: t, reason: "the step size tends to zero".into() })
            }
            Err(_) => Err(NoReferenceSolution { time: self.time, reason: "no solution".into() }),
        }
    }

    fn finite(&self, y: Option<Vec<f64>>) -> Result<Vec<f64>, NoReferenceSolution> {
        y.filter(|y| y.iter().all(|value| value.is_finite())).ok_or(NoReferenceSolution {
            time: self.time,
            reason: "the state is not finite".into(),
        })
    }
}

/// Stores the times of all steps but only the last values: a stiff scene needs millions of steps.
struct Latest;

impl Solout<f64, Vec<f64>> for Latest {
    fn solout<I: Interpolation<f64, Vec<f64>> + ?Sized>(
        &mut self,
        time: f64,
        _: f64,
        y: &Vec<f64>,
        _: &Vec<f64>,
        _: &mut I,
        solution: &mut Solution<f64, Vec<f64>>,
    ) -> ControlFlag<f64, Vec<f64>> {
        solution.t.push(time);
        match solution.y.last_mut() {
            Some(last) => last.clone_from(y),
            None => solution.y.push(y.clone()),
        }
        ControlFlag::Continue
    }
}

impl ODE<f64, Vec<f64>> for Equations<'_> {
    fn diff(&self, _: f64, y: &Vec<f64>, derivative: &mut Vec<f64>) {
        self.derivative(y, derivative);
    }
}
