//! The state: plain data, one visitor over its words, one hash.
//!
//! Per body position, orientation, velocity (world) and angular velocity (body axes), then the
//! torsion springs' turn counts, then the step counter. Nothing here is a cache.

use crate::geometry::Geometry;
use crate::model::ModelOwner;
use crate::words::{Fnv1a, Word, WordSource, WordVisitor, Words};

/// The state of one body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyState<P: Geometry> {
    /// \[m\] position of the centre of mass, world.
    pub position: P::Position,
    /// Orientation, body → world.
    pub orientation: P::Orientation,
    /// \[m/s\] velocity of the centre of mass, world.
    pub velocity: P::Velocity,
    /// \[rad/s\] angular velocity, body axes.
    pub angular_velocity: P::Velocity,
}

impl<P: Geometry> BodyState<P> {
    /// A state rounded once from double precision: position \[m\], unit quaternion (scalar first,
    /// body → world), velocity \[m/s\] (world), angular velocity \[rad/s\] (body axes).
    pub fn from_f64(
        position: [f64; 3],
        orientation: [f64; 4],
        velocity: [f64; 3],
        angular_velocity: [f64; 3],
    ) -> Self {
        Self {
            position: P::position_from_f64(position),
            orientation: P::orientation_from_f64(orientation),
            velocity: P::velocity_from_f64(velocity),
            angular_velocity: P::velocity_from_f64(angular_velocity),
        }
    }

    /// The same state in another precision.
    pub fn convert<Q: Geometry>(&self) -> BodyState<Q> {
        BodyState::from_f64(
            P::position_to_f64(&self.position),
            P::orientation_to_f64(&self.orientation),
            P::velocity_to_f64(&self.velocity),
            P::velocity_to_f64(&self.angular_velocity),
        )
    }
}

impl<P: Geometry> Words for BodyState<P> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.position.visit(visitor);
        self.orientation.visit(visitor);
        self.velocity.visit(visitor);
        self.angular_velocity.visit(visitor);
    }

    fn fill(&mut self, source: &mut impl WordSource) {
        self.position.fill(source);
        self.orientation.fill(source);
        self.velocity.fill(source);
        self.angular_velocity.fill(source);
    }
}

/// The state of a plant, owned in the shape of its model; `Copy` where the model's sizes are
/// const generics.
pub struct State<M: ModelOwner> {
    /// Per body, in the model's order.
    pub bodies: M::PerBody<BodyState<M::Precision>>,
    /// Half windings per torsion spring, see [`crate::elements::torsion_spring`].
    pub turns: M::PerTorsion,
    /// Steps done: time is `step·h`.
    pub step: u64,
    /// The inputs' signals; no words of the hash.
    pub signals: M::PerInput,
}

impl<M: ModelOwner> Clone for State<M> {
    fn clone(&self) -> Self {
        Self {
            bodies: self.bodies.clone(),
            turns: self.turns.clone(),
            step: self.step,
            signals: self.signals.clone(),
        }
    }
}

impl<M: ModelOwner> Copy for State<M>
where
    M::PerBody<BodyState<M::Precision>>: Copy,
    M::PerTorsion: Copy,
    M::PerInput: Copy,
{
}

impl<M: ModelOwner> State<M> {
    /// The state at t = 0.
    pub fn initial(model: &M) -> Self {
        let mut bodies = model.per_body(BodyState::default());
        for (state, initial) in bodies.as_mut().iter_mut().zip(model.initial()) {
            *state = *initial;
        }
        let mut signals = model.per_input();
        for (signal, input) in signals.as_mut().iter_mut().zip(model.view().inputs) {
            signal.value = input.value;
        }
        Self { bodies, turns: model.per_torsion(), step: 0, signals }
    }

    /// FNV-1a 64 over the state's words: the same on every target for the same scene, scheme,
    /// precision and step.
    #[must_use]
    pub fn hash(&self) -> u64 {
        let mut hash = Fnv1a::new();
        self.visit(&mut hash);
        hash.finish()
    }
}

impl<M: ModelOwner> Words for State<M> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        for body in self.bodies.as_ref() {
            body.visit(visitor);
        }
        for &turns in self.turns.as_ref() {
            visitor.word(Word::I32(turns));
        }
        visitor.word(Word::U64(self.step));
    }

    fn fill(&mut self, source: &mut impl WordSource) {
        for body in self.bodies.as_mut() {
            body.fill(source);
        }
        for turns in self.turns.as_mut() {
            *turns = source.take(4) as i32;
        }
        self.step = source.take(8);
    }
}
