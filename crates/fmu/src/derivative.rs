//! Directional derivatives of outputs with respect to inputs.
//!
//! `(outputs, inputs, seed) => ∂y/∂u · seed` at the present communication point: the direct effect of the inputs on the
//! outputs at constant time. Fourth-order differences on a plant in double precision, regardless of the component's
//! precision; it is built at the first call and again after a change of parameters.

use dbd_plant::instance::linearisation::Probe;

use crate::component::{Component, Mode, Refusal};
use crate::description::Role;

/// \[m, m/s\] displacement of an anchor for a difference; other inputs change by 1 in their unit.
const DISPLACEMENT: f64 = 1e-5;

impl Component {
    /// The directional derivatives of outputs with respect to inputs, both by value reference.
    ///
    /// # Errors
    /// Before initialisation, if an unknown is not an output or a known not an input, after a failed step, or if an
    /// output or a force is undefined.
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
                    return Err(Refusal::Error(format!("seed {seed:?} is not finite")));
                }
                _ => return Err(self.no_pair(known, "a known", "an input")),
            }
        }
        self.settle()?;
        // Reports a failed step again.
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
            "{name} is not {wanted} and cannot be {is}: only derivatives of outputs with respect to inputs exist"
        ))
    }
}
