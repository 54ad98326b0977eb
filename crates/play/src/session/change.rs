//! Changes of a running plant.
//!
//! `(old plant, new plant) => transferred state, or reason`.

use dbd_plant::instance::Instance;
use dbd_scene::Scene;

use crate::refused::Refused;
use crate::session::asked::Change;
use crate::session::live::Session;

impl Session {
    /// Applies a request. State, time and inputs are kept if the scene's parts and its pose at t = 0 are unchanged:
    /// stiffness, damping, mass, gravity, scheme, precision and step may change during a run. Otherwise the run
    /// restarts at t = 0 and the reason is returned.
    ///
    /// # Errors
    /// Where the scene or the settings are refused; nothing is changed then.
    pub fn change(&mut self, asked: Change) -> Result<Option<String>, Refused> {
        let other = asked.instance()?;
        match self.carried(other) {
            Ok(instance) => {
                let old = std::mem::replace(self, Self::of(asked, instance));
                if old.instance.outputs() == self.instance.outputs() {
                    self.watched = old.watched;
                }
                self.disturbed = true;
                self.energy_at_start = old.energy_at_start;
                (self.grab, self.work) = (old.grab, old.work);
                (self.marks, self.inputs_set) = (old.marks, old.inputs_set);
                Ok(None)
            }
            Err((instance, why)) => {
                *self = Self::of(asked, *instance);
                Ok(Some(why))
            }
        }
    }

    /// Transfers this plant's state to the other one.
    fn carried(&self, mut other: Instance) -> Result<Instance, (Box<Instance>, String)> {
        let no = |other: Instance, why: &str| Err((Box::new(other), why.to_owned()));
        if self.run_failure.is_some() {
            return no(other, "the previous run failed");
        }
        if let Some(why) = differs(self.instance.scene(), other.scene()) {
            return no(other, why);
        }
        let mut state = self.instance.plant().state();
        state.step = (self.instance.time() / other.step_size()).round() as u64;
        match other.plant_mut().set_state(&state) {
            Ok(()) => Ok(other),
            Err(error) => {
                other.reset();
                let why = format!("the state cannot be continued: {error}");
                Err((Box::new(other), why))
            }
        }
    }
}

/// Reason why a state of one scene does not fit another.
fn differs(a: &Scene, b: &Scene) -> Option<&'static str> {
    let inputs =
        |scene: &Scene| scene.inputs.iter().map(|input| input.name.clone()).collect::<Vec<_>>();
    let joints =
        |scene: &Scene| scene.joints.iter().map(|joint| joint.name.clone()).collect::<Vec<_>>();
    if a.body_names != b.body_names || joints(a) != joints(b) {
        return Some("it has other bodies or joints");
    }
    if a.torsion_names != b.torsion_names
        || a.law_names() != b.law_names()
        || inputs(a) != inputs(b)
    {
        return Some("it has other springs, interactions or inputs");
    }
    if a.model.initial != b.model.initial {
        return Some("its pose at t = 0 differs");
    }
    if a.model.points != b.model.points || a.model.groups != b.model.groups {
        return Some("its points are at other positions");
    }
    None
}
