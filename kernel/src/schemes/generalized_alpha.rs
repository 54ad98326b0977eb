//! Generalised-α: the joints' stiffness and damping are included in the step by one linear solve.
//!
//! Chung & Hulbert (1993), on Lie groups Brüls, Cardona & Arnold (2012), with the residual at the advanced pose and one
//! Newton step from there, which suffices for second order. Per body u are the velocities, a the algorithmic and d the
//! true accelerations, ρ∞ is the fraction of a vibration not resolved by the step that remains per step,
//! `α_m = (2ρ−1)/(ρ+1)`, `α_f = ρ/(ρ+1)`, `γ = ½ − α_m + α_f`, `β = ¼·(γ + ½)²`:
//!
//! 1. `û = u + h·(1−γ)·a`, `q̂ = q ∘ exp(h·u + h²·(½−β)·a)`
//! 2. `(μ·M + γ·h·C + β·h²·K)·a⁺ = F(q̂, û) + M·s`, `μ = (1−α_m)/(1−α_f)`, `s = (α_f·d − α_m·a)/(1−α_f)`
//! 3. `u⁺ = û + γ·h·a⁺`, `q⁺ = q̂ ∘ exp(β·h²·a⁺)`, `d⁺ = μ·a⁺ − s`
//!
//! C and K are the material tangents of dampers and springs ([`crate::solve`]), so that the matrix is positive definite
//! for every step; the gyroscopic torque, which they leave out, is that of `û + γ·h·a`: with û alone a tumbling body
//! would be of first order only. Second order in the slow motion, stable at any stiffness and damping as long as the
//! bodies rotate little in a step; it damps fast vibration, by design, and conserves only the linear momentum of free
//! bodies to rounding.
//!
//! With dampers the stored a predicts the whole step: forces are evaluated at `û + γ·h·a` and at the pose with
//! `β·h²·a`, and the matrix gives `a⁺ − a`. With û alone any difference of the matrix to the C of the pose, as with a
//! lumped joint's, would be an error of first order.
//!
//! The first step has no accelerations. Those of `M⁻¹·F` would be far off: nearly rigid joints hold the bodies only
//! once they have moved, and the motion until then excites vibrations for many steps. So forces are evaluated at
//! `q ∘ exp(τ·h·u)`, `½·τ² = β/μ`, where the same matrix closes the joints, and `(M + γ/μ·h·C + β/μ·h²·K)·a = F` is the
//! acceleration of the whole first step, `a = d`.
//!
//! External forces, of loads and inputs, may jump. Accelerations are therefore stored without them, and their value at
//! the start of a step is added. A jump of the ground by a table accelerates the bodies joined to it: such a step is
//! treated as a first one.

use crate::body::{Body, BodyState, Increment};
use crate::damping::Damping;
use crate::forces::{At, ExplicitDampers, Wrench};
use crate::geometry::Geometry;
use crate::keep::Matrix;
use crate::model::Terms;
use crate::real::{Constant, Real};
use crate::rotation;
use crate::schemes::Scheme;
use crate::solve::MatrixWeights;
use crate::space::{Moment as _, Space};
use crate::status::Cause;
use crate::step::Stepper;
use crate::words::{Word, WordSource, WordVisitor, Words as _};

/// One linear solve per step: for nearly rigid joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeneralizedAlpha {
    rho: f64,
    /// μ.
    mass: Constant,
    beta: Constant,
    gamma: Constant,
    /// ½ − β.
    rest_of_beta: Constant,
    /// 1 − γ.
    rest_of_gamma: Constant,
    /// `α_f/(1−α_f)`, factor of d in s.
    of_true: Constant,
    /// `α_m/(1−α_f)`, factor of −a in s.
    of_algorithmic: Constant,
    /// τ, the fraction of a first step at which forces are evaluated.
    first: Constant,
    /// 1 − τ.
    rest_of_first: Constant,
}

/// An invalid ρ∞: not from 0 to [`GeneralizedAlpha::MAX_RHO`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(all(feature = "defmt", target_os = "none"), derive(defmt::Format))]
pub struct RhoError(
    /// \[1\] the given value.
    pub f64,
);

impl core::fmt::Display for RhoError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "rho must be from 0 to {}, not {}", GeneralizedAlpha::MAX_RHO, self.0)
    }
}

impl core::error::Error for RhoError {}

impl GeneralizedAlpha {
    /// The default ρ∞.
    pub const RHO: f64 = 0.5;
    /// The scheme with [`Self::RHO`].
    pub const DEFAULT: Self = match Self::new(Self::RHO) {
        Ok(scheme) => scheme,
        Err(_) => unreachable!(),
    };
    /// The largest ρ∞: above it the error of a single Newton step is damped too little.
    pub const MAX_RHO: f64 = 0.8;

    /// The scheme with the given `rho`, ρ∞, the fraction of an unresolved vibration that remains per step.
    ///
    /// # Errors
    /// [`RhoError`] where it is not from 0 to [`Self::MAX_RHO`].
    pub const fn new(rho: f64) -> Result<Self, RhoError> {
        if !(rho >= 0.0 && rho <= Self::MAX_RHO) {
            return Err(RhoError(rho));
        }
        let alpha_m = (2.0 * rho - 1.0) / (rho + 1.0);
        let alpha_f = rho / (rho + 1.0);
        let gamma = 0.5 - alpha_m + alpha_f;
        let beta = 0.25 * (gamma + 0.5) * (gamma + 0.5);
        let first = root(2.0 * beta * (1.0 - alpha_f) / (1.0 - alpha_m));
        Ok(Self {
            rho,
            mass: Constant::new((1.0 - alpha_m) / (1.0 - alpha_f)),
            beta: Constant::new(beta),
            gamma: Constant::new(gamma),
            rest_of_beta: Constant::new(0.5 - beta),
            rest_of_gamma: Constant::new(1.0 - gamma),
            of_true: Constant::new(alpha_f / (1.0 - alpha_f)),
            of_algorithmic: Constant::new(alpha_m / (1.0 - alpha_f)),
            first: Constant::new(first),
            rest_of_first: Constant::new(1.0 - first),
        })
    }

    /// ρ∞.
    #[must_use]
    pub const fn rho(&self) -> f64 {
        self.rho
    }
}

impl Default for GeneralizedAlpha {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// The memory of [`GeneralizedAlpha`] for one body: accelerations for the next step, without those of loads and inputs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GeneralizedAlphaMemory<P: Geometry> {
    /// \[m/s², rad/s²\] a.
    algorithmic: Increment<P::Space>,
    /// d.
    real: Increment<P::Space>,
}

/// A scheme's memory per body that contains that of [`GeneralizedAlpha`].
pub trait Remembers<P: Geometry> {
    /// The memory of the current step.
    fn accelerations(&mut self) -> &mut GeneralizedAlphaMemory<P>;
}

impl<P: Geometry> Remembers<P> for GeneralizedAlphaMemory<P> {
    #[inline(always)]
    fn accelerations(&mut self) -> &mut Self {
        self
    }
}

/// A step of [`GeneralizedAlpha`] as part of a plant's step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part<R> {
    /// \[s\] its duration.
    pub(super) h: R,
    /// \[1\] the elapsed fraction of the plant's step at its end.
    pub(super) end: R,
    /// Whether it is half of the plant's step.
    pub(super) half: bool,
    /// Whether the stored accelerations are invalid.
    pub(super) begins: bool,
    /// The position of its evaluation.
    pub(super) at: At,
}

impl Scheme for GeneralizedAlpha {
    const NAME: &'static str = "generalized-alpha";
    const ORDER: u32 = 2;
    const ORDER_DAMPED: u32 = 2;
    const DAMPING: Damping = Damping::Implicit;
    const REMEMBERS: bool = true;
    // One Newton step is not accurate for larger rotations.
    const MAX_TURN: Constant = Constant::new(0.5);
    // Rounding errors in the matrix grow with its condition, the square of this: in single precision free motion is
    // accurate to 1e-5 m up to this limit, and is slowed down beyond. The bound exceeds ω by up to √2.
    const MAX_VIBRATION: Option<Constant> = Some(Constant { double: 1e7, single: 700.0 });
    type Memory<P: Geometry> = GeneralizedAlphaMemory<P>;
    type Storage = Matrix;

    fn evaluations(&self) -> u32 {
        1
    }

    fn stability_limit(&self) -> f64 {
        f64::INFINITY
    }

    fn visit_parameters(&self, visitor: &mut impl WordVisitor) {
        visitor.word(Word::F64(self.rho));
    }

    #[inline(always)]
    fn matrix_weights<R: Real>(&self, h: R) -> MatrixWeights<R> {
        let Self { mass, gamma, beta, .. } = *self;
        let [mass, gamma, beta] = [mass, gamma, beta].map(R::constant);
        MatrixWeights { mass, damping: h * gamma, stiffness: h * h * beta }
    }

    fn visit_memory<P: Geometry>(memory: &Self::Memory<P>, visitor: &mut impl WordVisitor) {
        for Increment { linear, angular } in [&memory.algorithmic, &memory.real] {
            linear.visit(visitor);
            angular.visit(visitor);
        }
    }

    fn fill_memory<P: Geometry>(memory: &mut Self::Memory<P>, source: &mut impl WordSource) {
        for Increment { linear, angular } in [&mut memory.algorithmic, &mut memory.real] {
            linear.fill(source);
            angular.fill(source);
        }
    }

    #[inline]
    fn step<P: Geometry, T: Terms<P>>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, Self::Memory<P>>,
    ) -> Result<(), Cause> {
        // The stored accelerations are invalid where the ground jumps.
        let begins = !stepper.cache.begun || stepper.ground_jumps();
        let (h, end) = (stepper.h, P::Real::ONE);
        self.advance(stepper, Part { h, end, half: false, begins, at: At::Boundary })?;
        stepper.cache.begun = true;
        Ok(())
    }
}

/// √x by Newton's iteration, usable in a `const`.
const fn root(x: f64) -> f64 {
    let (mut y, mut i) = (1.0, 0);
    while i < 8 {
        y = 0.5 * (y + x / y);
        i += 1;
    }
    y
}

impl GeneralizedAlpha {
    /// One step of the given part.
    #[inline(always)]
    pub(super) fn advance<P: Geometry, T: Terms<P>, S: Remembers<P>>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, S>,
        part: Part<P::Real>,
    ) -> Result<(), Cause> {
        let Part { h, begins, .. } = part;
        if begins {
            stepper
                .memory
                .iter_mut()
                .for_each(|memory| *memory.accelerations() = Default::default());
        } else if stepper.is_pushed() {
            stepper.place_all();
            stepper.push();
            stepper.each_pushed(P::Real::ONE);
        }
        let constant = P::Real::constant;
        // With dampers the stored a predicts the whole step, without them the known part of it.
        let predicted = stepper.has_dampers();
        let (near, far) = if predicted {
            (h * P::Real::HALF, h)
        } else {
            (h * constant(self.rest_of_beta), h * constant(self.rest_of_gamma))
        };
        let drift = if begins { h * constant(self.first) } else { h };
        let rows = stepper.workspace.bodies.iter_mut().zip(stepper.memory.iter_mut());
        for (state, memory) in rows {
            let Increment { linear, angular } = memory.accelerations().algorithmic;
            let velocity = P::velocity(&state.velocity) + linear * near;
            let spin = P::spin(&state.angular_velocity) + angular * near;
            P::translate(&mut state.position, velocity * drift);
            rotation::turn_by::<P>(&mut state.orientation, spin * (P::Real::HALF * drift));
            P::accelerate(&mut state.velocity, linear * far);
            P::spin_up(&mut state.angular_velocity, angular * far);
        }
        stepper.sample_inputs(part.end);
        stepper.evaluate_once::<ExplicitDampers>(part.at, false)?;
        let matrix_weights = self.matrix_weights(h);
        self.right_sides(stepper, matrix_weights, predicted);
        stepper.solve(matrix_weights, part.half)?;
        if begins {
            self.end_first(stepper, h);
        } else {
            self.end(stepper, matrix_weights, predicted);
        }
        if stepper.is_pushed() {
            stepper.push();
            stepper.each_pushed(-P::Real::ONE);
        }
        Ok(())
    }

    /// The end of a step from the solution.
    #[inline(always)]
    fn end<P: Geometry, T: Terms<P>, S: Remembers<P>>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, S>,
        MatrixWeights { mass, damping: change, stiffness: elongation }: MatrixWeights<P::Real>,
        predicted: bool,
    ) {
        stepper.correct(|state, memory, mut next| {
            let memory = memory.accelerations();
            let known = self.known::<P>(memory);
            P::translate(&mut state.position, next.linear * elongation);
            let half = next.angular * (P::Real::HALF * elongation);
            rotation::turn_by::<P>(&mut state.orientation, half);
            P::accelerate(&mut state.velocity, next.linear * change);
            P::spin_up(&mut state.angular_velocity, next.angular * change);
            if predicted {
                next.linear = next.linear + memory.algorithmic.linear;
                next.angular = next.angular + memory.algorithmic.angular;
            }
            memory.real = Increment {
                linear: next.linear * mass - known.linear,
                angular: next.angular * mass - known.angular,
            };
            memory.algorithmic = next;
        });
    }

    /// The end of a first step from the solution: the remaining motion, at one acceleration.
    fn end_first<P: Geometry, T: Terms<P>, S: Remembers<P>>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, S>,
        h: P::Real,
    ) {
        let constant = P::Real::constant;
        let (mass, half) = (constant(self.mass), P::Real::HALF);
        let (rest, elongation) = (h * constant(self.rest_of_first), half * h * h);
        stepper.correct(|state, memory, next| {
            let a = Increment { linear: next.linear * mass, angular: next.angular * mass };
            let way = P::velocity(&state.velocity) * rest + a.linear * elongation;
            let turn = P::spin(&state.angular_velocity) * rest + a.angular * elongation;
            P::translate(&mut state.position, way);
            rotation::turn_by::<P>(&mut state.orientation, turn * half);
            P::accelerate(&mut state.velocity, a.linear * h);
            P::spin_up(&mut state.angular_velocity, a.angular * h);
            *memory.accelerations() = GeneralizedAlphaMemory { algorithmic: a, real: a };
        });
    }

    /// s.
    #[inline(always)]
    fn known<P: Geometry>(&self, memory: &GeneralizedAlphaMemory<P>) -> Increment<P::Space> {
        let (d, a) = (P::Real::constant(self.of_true), P::Real::constant(self.of_algorithmic));
        let GeneralizedAlphaMemory { algorithmic, real } = memory;
        Increment {
            linear: real.linear * d - algorithmic.linear * a,
            angular: real.angular * d - algorithmic.angular * a,
        }
    }

    /// `F + M·s` in place of the wrenches, `F + M·(s − μ·a)` where a predicts the step, torques in world axes.
    #[inline(always)]
    fn right_sides<P: Geometry, T: Terms<P>, S: Remembers<P>>(
        &self,
        stepper: &mut Stepper<'_, '_, P, T, S>,
        MatrixWeights { mass, damping: change, .. }: MatrixWeights<P::Real>,
        predicted: bool,
    ) {
        let Stepper { workspace, memory } = stepper;
        let field = workspace.field();
        let rows = workspace.bodies.iter().zip(workspace.model.bodies);
        let rows = rows.zip(workspace.frames.iter()).zip(workspace.wrenches.iter_mut());
        for ((((state, body), frame), wrench), memory) in rows.zip(memory.iter_mut()) {
            let memory = memory.accelerations();
            let mut known = self.known::<P>(memory);
            let mut w = P::spin(&state.angular_velocity);
            if predicted {
                known.linear = known.linear - memory.algorithmic.linear * mass;
                known.angular = known.angular - memory.algorithmic.angular * mass;
            } else {
                w = w + memory.algorithmic.angular * change;
            }
            if let Some(field) = field {
                known.linear = known.linear + field;
            }
            let gyroscopic = w.commutator(body.inertia.scale(w));
            let torque = wrench.torque - gyroscopic + body.inertia.scale(known.angular);
            wrench.force = wrench.force + known.linear * body.mass;
            wrench.torque = P::moment_to_world(frame, torque);
        }
    }
}

impl<P: Geometry, T: Terms<P>, S: Remembers<P>> Stepper<'_, '_, P, T, S> {
    /// Visits every body with its solution, whose torques are in world axes.
    #[inline(always)]
    pub(super) fn correct(
        &mut self,
        mut visit: impl FnMut(&mut BodyState<P>, &mut S, Increment<P::Space>),
    ) {
        let Stepper { workspace, memory } = self;
        let rows = workspace.bodies.iter_mut().zip(memory.iter_mut());
        let rows = rows.zip(workspace.frames.iter()).zip(workspace.wrenches.iter());
        for (((state, memory), frame), wrench) in rows {
            let angular = P::moment_to_body(frame, wrench.torque);
            visit(state, memory, Increment { linear: wrench.force, angular });
        }
    }

    /// Adds to the stored accelerations `sign` times those of the external forces.
    #[inline(always)]
    fn each_pushed(&mut self, sign: P::Real) {
        let Stepper { workspace, memory } = self;
        let rows = workspace.wrenches.iter().zip(workspace.model.bodies);
        for ((wrench, body), memory) in rows.zip(memory.iter_mut()) {
            let more = pushed_by(wrench, body, sign);
            let memory = memory.accelerations();
            for own in [&mut memory.algorithmic, &mut memory.real] {
                own.linear = own.linear + more.linear;
                own.angular = own.angular + more.angular;
            }
        }
    }
}

/// The acceleration of one body by a wrench, body axes.
#[inline(always)]
fn pushed_by<S: Space>(wrench: &Wrench<S>, body: &Body<S>, sign: S::Real) -> Increment<S> {
    Increment {
        linear: wrench.force * (sign * body.inverse_mass),
        angular: wrench.torque.scale(body.inverse_inertia) * sign,
    }
}
