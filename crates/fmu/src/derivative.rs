//! Directional derivatives of outputs with respect to inputs.
//!
//! `(outputs, inputs, seed) => ∂y/∂u · seed` at the present communication point: what a change of the inputs
//! makes of the outputs before time goes on. Differences of fourth order over a plant in double precision, whatever the
//! precision of the component; it is built at the first call and again where parameters have changed.

use dbd_plant::instance::linearisation::Probe;

use crate::component::{Component, Mode, Refusal};
use crate::description::Role;

/// \[m, m/s\] how far an anchor is moved for a difference; other inputs by 1 of their units.
const DISPLACEMENT: f64 = 1e-5;

impl Component {
    /// The derivatives of outputs along a change of inputs, both by their value references.
    ///
    /// # Errors
    /// Before initialisation, where an unknown is no output or a known no input, after a failed step, or
    /// where an output or a force is undefined.
    pub fn directional_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
    ) -> Result<Vec<f64>, Refusal> {
        self.expect(&[Mode::Initializing, Mode::Stepping, Mode::Terminated])?;
        let mut outputs = Vec::with_capacity(unknowns.len());
        for &unknown in unknowns {
            match self.role(unknown)? {
                Role::Output(place, _) => outputs.push(*place),
                _ => return Err(self.no_pair(unknown, "an unknown", "an output")),
            }
        }
        let (mut inputs, mut seeds) = (Vec::with_capacity(knowns.len()), Vec::new());
        for (&known, &seed) in knowns.iter().zip(seed) {
            match self.role(known)? {
                Role::Input(place) if seed.is_finite() => {
                    inputs.push(*place);
                    seeds.push(seed);
                }
                Role::Input(_) => {
                    return Err(Refusal::Error(format!("a seed of {seed:?} is not finite")));
                }
                _ => return Err(self.no_pair(known, "a known", "an input")),
            }
        }
        self.settle()?;
        // A failed step is said again.
        self.instance.advance(0)?;
        let mut probe = match self.probe.take() {
            Some(probe) => probe,
            None => Probe::new(&self.instance)?,
        };
        probe.follow(&self.instance);
        let found = probe.input_jacobians(&inputs, &outputs, DISPLACEMENT);
        self.probe = Some(probe);
        let (_, d) = found?;
        let along = |row: usize| {
            seeds.iter().enumerate().map(|(column, seed)| d[(row, column)] * seed).sum()
        };
        Ok((0..outputs.len()).map(along).collect())
    }

    fn no_pair(&self, reference: u32, is: &str, wanted: &str) -> Refusal {
        let name = &self.description.variables[reference as usize].name;
        Refusal::Error(format!(
            "{name} is not {wanted} and cannot be {is}: there are only derivatives of outputs with respect to inputs"
        ))
    }
}
