//! Similar instances together, one per SIMD lane.
//!
//! `(instances of one structure, steps) => instances`. Leapfrog in double or single precision, each instance with its own
//! numbers, state and inputs, and the bits that it has alone, up to and including a failure.

use dbd_ensemble::{AnyEnsemble, InstructionSet, Number, ensemble_in_f32, ensemble_in_f64};

use crate::instance::error::InstanceError;
use crate::instance::running::Instance;
use crate::names::PrecisionName;

/// The registers in which similar instances advance together.
pub struct Lockstep {
    ensemble: Box<dyn AnyEnsemble>,
}

/// The widest instruction set of this machine with at most so many lanes for an instance, and their number; `None`
/// where lanes do not support its method, its laws, driven bodies or a planar scene.
fn registers(instance: &Instance, most: usize) -> Option<(InstructionSet, usize)> {
    let method = instance.plant().method();
    if !method.in_lanes()
        || instance.scene().planar.is_some()
        || !instance.scene().model.laws.is_empty()
        || instance.scene().model.bodies.iter().any(dbd_kernel::Body::is_driven)
    {
        return None;
    }
    let lanes = |set| match method.precision() {
        PrecisionName::F32 => <f32 as Number>::lanes(set),
        _ => <f64 as Number>::lanes(set),
    };
    let sets = InstructionSet::ALL.into_iter().filter(|set| set.is_there());
    sets.map(|set| (set, lanes(set))).rfind(|(_, lanes)| *lanes <= most)
}

impl Lockstep {
    /// Number of instances like this one that should advance together, at most `most`: the lanes of a full register, or
    /// 1 where it has to advance alone.
    #[must_use]
    pub fn lanes(instance: &Instance, most: usize) -> usize {
        registers(instance, most).map_or(1, |(_, lanes)| lanes)
    }

    /// Registers for these instances. `None` where they have to advance one by one: fewer than two, of different
    /// structure, method or step, or a method without lanes.
    #[must_use]
    pub fn new(instances: &[&mut Instance]) -> Option<Self> {
        let first = instances.first()?;
        let alike = |other: &&mut Instance| {
            other.plant().method() == first.plant().method()
                && other.step_size().to_bits() == first.step_size().to_bits()
                && other.scene().planar.is_none()
        };
        let (set, _) = registers(first, instances.len()).filter(|(_, lanes)| *lanes > 1)?;
        if !instances.iter().all(alike) {
            return None;
        }
        let models = instances.iter().map(|instance| instance.scene().model.clone()).collect();
        let new = match first.plant().method().precision() {
            PrecisionName::F32 => ensemble_in_f32,
            _ => ensemble_in_f64,
        };
        new(models, first.step_size(), set).ok().map(|ensemble| Self { ensemble })
    }

    /// Advances the instances that [`Self::new`] was given, in the same order, by the given number of steps with held
    /// inputs. An instance that fails stops at its failed step; the others go on.
    ///
    /// # Errors
    /// For each instance, as [`Instance::advance`].
    ///
    /// # Panics
    /// If there are more instances than it was made for.
    pub fn advance(
        &mut self,
        instances: &mut [&mut Instance],
        steps: u64,
    ) -> Vec<Result<(), InstanceError>> {
        for (lane, instance) in instances.iter().enumerate() {
            self.ensemble.resume(lane, &instance.plant().state());
        }
        self.ensemble.advance(steps);
        let lanes = instances.iter_mut().enumerate();
        lanes
            .map(|(lane, instance)| {
                let arrived = instance.plant().status().is_ok()
                    && self.ensemble.status(lane).is_ok()
                    && instance.plant_mut().set_state(&self.ensemble.state(lane)).is_ok();
                // A failure is found again where it was: alone, from the same state.
                if arrived { Ok(()) } else { instance.advance(steps) }
            })
            .collect()
    }
}
