//! Linearisation: response of a plant to small changes of its state and inputs.
//!
//! `(model, state) => f, ∂f/∂x, ∂f/∂u, ∂y/∂x, ∂y/∂u` of ẋ = f(x, u), y = g(x, u), by central differences
//! of fourth order over the kernel's wrenches in double precision, dampers included. Twelve coordinates
//! per body: translation along the world's axes \[m\], rotation about the body's \[rad\], and their rates \[m/s,
//! rad/s\], all positions before all rates. Newton and Euler; the rotation φ relative to a rotating body changes as φ̇
//! = δω − ω × φ.

use dbd_kernel::forces::wrenches;
use dbd_kernel::laws::{Laws as _, Need};
use dbd_kernel::{Body, F64, Quaternion, State, Vec3};
use dbd_scene::SceneModel;
use nalgebra::{DMatrix, DVector};

use crate::instance::blueprint::Blueprint;
use crate::instance::error::InstanceError;
use crate::instance::running::Instance;
use crate::instance::settings::Settings;

/// Weights of the differences at 1 and 2 probes.
const WEIGHTS: [f64; 2] = [8.0 / 12.0, -1.0 / 12.0];

type Bodies = State<SceneModel<F64>>;

/// The Jacobians of a state.
#[derive(Clone, Debug, PartialEq)]
pub struct Jacobians {
    /// \[m/s, rad/s, m/s², rad/s²\] ẋ itself.
    pub rate: DVector<f64>,
    /// \[units of `rate` over those of the coordinates\] ∂ẋ/∂x.
    pub a: DMatrix<f64>,
    /// \[units of `rate` over those of the inputs\] ∂ẋ/∂u.
    pub b: DMatrix<f64>,
    /// \[units of the outputs over those of the coordinates\] ∂y/∂x.
    pub c: DMatrix<f64>,
    /// \[units of the outputs over those of the inputs\] ∂y/∂u.
    pub d: DMatrix<f64>,
}

/// A plant of the scene in double precision and in space, and the state that it is looked at in.
pub struct Probe {
    instance: Instance,
    state: Bodies,
    rates: Vec<Vec3<f64>>,
}

impl Probe {
    /// The plant of an instance as it is now.
    ///
    /// # Errors
    /// Those of [`Instance::new`], where the scene is refused in space or in double precision.
    pub fn new(of: &Instance) -> Result<Self, InstanceError> {
        let mut blueprint: Blueprint = of.blueprint().clone();
        // A plane's model has no stiffness across it.
        if of.scene().planar.is_some() {
            blueprint = blueprint.with("planar=false");
        }
        let step = Some(of.step_size());
        let mut instance = Instance::new(blueprint, Settings { step, ..Settings::default() })?;
        let memory = instance.plant().model().laws.memory();
        if let Some((law, Need::Passes)) = memory {
            return Err(InstanceError::Linearisation {
                what: format!(
                    "the rotor of the law `{law}` is a degree of freedom outside the bodies"
                ),
                remedy: "use a drive without a rotor and add its inertia to a body",
            });
        }
        if let Some(law) =
            instance.plant().model().laws.names().find(|law| law.ends_with("-actuator"))
        {
            return Err(InstanceError::Linearisation {
                what: format!("the signal chain of the law `{law}` has a state outside the bodies"),
                remedy: "use an input without `lag`, `delay`, `limits`, `rate_limit` and `period`",
            });
        }
        if let Some(row) = instance.plant().model().bodies.iter().position(Body::is_driven) {
            return Err(InstanceError::Linearisation {
                what: format!("inputs move the driven body `{}`", of.scene().body_names[row]),
                remedy: "remove `driven` and hold the body by joints or springs",
            });
        }
        let set = of.set().iter().map(|(path, value)| (path.as_str(), *value));
        instance.set_parameters(set)?;
        let state = instance.plant().state();
        let mut probe = Self { instance, state, rates: Vec::new() };
        probe.follow(of);
        Ok(probe)
    }

    /// Takes the present state of an instance with the same parameters.
    pub fn follow(&mut self, of: &Instance) {
        let now = of.plant().state();
        self.state.bodies = now.bodies;
        self.state.signals = now.signals;
        self.state.step = now.step;
        if self.state.turns.len() == now.turns.len() {
            self.state.turns = now.turns;
        }
        // A plane's laws have memories of another shape.
        if of.scene().planar.is_none() {
            self.state.laws = now.laws;
        }
        self.note_rates();
    }

    fn note_rates(&mut self) {
        self.rates = self.state.bodies.iter().map(|body| body.angular_velocity).collect();
    }

    /// The scene's plant in double precision and in space.
    #[must_use]
    pub fn instance(&self) -> &Instance {
        &self.instance
    }

    /// The state that it is looked at in.
    #[must_use]
    pub fn state(&self) -> &Bodies {
        &self.state
    }

    /// Moves the state by the given displacement of each coordinate \[m, rad, m/s, rad/s\].
    pub fn shift(&mut self, by: &DVector<f64>) {
        for (coordinate, by) in by.iter().enumerate() {
            self.state = self.moved(coordinate, *by);
        }
        self.note_rates();
    }

    /// How many coordinates: twelve per body.
    #[must_use]
    pub fn count(&self) -> usize {
        12 * self.state.bodies.len()
    }

    fn moved(&self, coordinate: usize, by: f64) -> Bodies {
        let mut state = self.state.clone();
        let half = 6 * state.bodies.len();
        let (body, part) = ((coordinate % half) / 6, coordinate % 6);
        let body = &mut state.bodies[body];
        let axis = Vec3::axes()[part % 3];
        match (coordinate < half, part < 3) {
            (true, true) => body.position = body.position + axis * by,
            (true, false) => {
                let v = axis * (0.5 * by).sin();
                let turn = Quaternion::new((0.5 * by).cos(), v.x, v.y, v.z);
                body.orientation = body.orientation.product(turn);
            }
            (false, true) => body.velocity = body.velocity + axis * by,
            (false, false) => body.angular_velocity = body.angular_velocity + axis * by,
        }
        state
    }

    /// ẋ \[m/s, rad/s, m/s², rad/s²\] here.
    ///
    /// # Errors
    /// [`InstanceError::Linearisation`] where a force is undefined.
    pub fn rates(&self) -> Result<DVector<f64>, InstanceError> {
        let mut rate = self.rate(&self.state, None)?;
        for (row, spin) in self.rates.iter().enumerate() {
            rate[6 * row + 3..6 * row + 6].copy_from_slice(&spin.to_f64());
        }
        Ok(DVector::from_vec(finite(rate)?))
    }

    /// ẋ in a state with small rotations relative to that of the probe.
    fn rate(
        &self,
        state: &Bodies,
        turned: Option<(usize, Vec3<f64>)>,
    ) -> Result<Vec<f64>, InstanceError> {
        let model = self.instance.plant().model();
        let forces = wrenches(model, state, self.instance.step_size())
            .map_err(|cause| undefined(dbd_scene::fault(self.instance.scene(), &cause)))?;
        let mut rates = Vec::with_capacity(self.count());
        for (row, body) in state.bodies.iter().enumerate() {
            rates.extend(body.velocity.to_f64());
            let mut turning = body.angular_velocity - self.rates[row];
            if let Some((_, turn)) = turned.filter(|(turned, _)| *turned == row) {
                turning = turning - self.rates[row].cross(turn);
            }
            rates.extend(turning.to_f64());
        }
        for ((body, of), wrench) in state.bodies.iter().zip(&model.bodies).zip(&forces) {
            let [fx, fy, fz] = wrench.force.to_f64();
            rates.extend([fx / of.mass, fy / of.mass, fz / of.mass]);
            let (inertia, spin) = (of.inertia, body.angular_velocity);
            let momentum = Vec3::new(inertia.x * spin.x, inertia.y * spin.y, inertia.z * spin.z);
            let [tx, ty, tz] = (wrench.torque - spin.cross(momentum)).to_f64();
            rates.extend([tx / inertia.x, ty / inertia.y, tz / inertia.z]);
        }
        Ok(rates)
    }

    fn outputs(&mut self, state: &Bodies, outputs: &[usize]) -> Result<Vec<f64>, InstanceError> {
        let refused = |error| undefined(format!("{error}"));
        self.instance.plant_mut().set_state(state).map_err(refused)?;
        let mut values = Vec::with_capacity(outputs.len());
        self.instance.values_of(outputs, &mut values);
        Ok(values)
    }

    /// The Jacobians here, by differences of `probe` \[m, rad, m/s, rad/s\] in the state and of
    /// 1 \[its unit\] in inputs, but as small as in the state in displacements.
    ///
    /// # Errors
    /// [`InstanceError::Linearisation`] where a force or an output is undefined here or nearby,
    /// [`InstanceError::Input`] where an input cannot be moved.
    pub fn jacobians(
        &mut self,
        inputs: &[usize],
        outputs: &[usize],
        probe: f64,
    ) -> Result<Jacobians, InstanceError> {
        let count = self.count();
        let rate = self.rates()?;
        let mut a = DMatrix::zeros(count, count);
        let mut c = DMatrix::zeros(outputs.len(), count);
        for column in 0..count {
            let part = column % 6;
            let turned = |by: f64| {
                let turn = column < count / 2 && part >= 3;
                turn.then(|| ((column / 6), Vec3::axes()[part % 3] * by))
            };
            for (by, weight) in probes(probe) {
                let moved = self.moved(column, by);
                add(&mut a, column, weight, &self.rate(&moved, turned(by))?);
                add(&mut c, column, weight, &self.outputs(&moved, outputs)?);
            }
        }
        let (b, d) = self.input_jacobians(inputs, outputs, probe)?;
        Ok(Jacobians { rate, a: finite(a)?, b, c: finite(c)?, d })
    }

    /// ∂ẋ/∂u and ∂y/∂u here, by differences as in [`Self::jacobians`].
    ///
    /// # Errors
    /// As [`Self::jacobians`].
    pub fn input_jacobians(
        &mut self,
        inputs: &[usize],
        outputs: &[usize],
        probe: f64,
    ) -> Result<(DMatrix<f64>, DMatrix<f64>), InstanceError> {
        let (width, state) = (inputs.len(), self.state.clone());
        let mut b = DMatrix::zeros(self.count(), width);
        let mut d = DMatrix::zeros(outputs.len(), width);
        let refused = |error| undefined(format!("{error}"));
        for (column, input) in inputs.iter().enumerate() {
            let kind = self.instance.inputs().get(*input).map(|input| input.unit);
            let probe = if matches!(kind, Some("m" | "m/s")) { probe } else { 1.0 };
            self.instance.plant_mut().set_state(&state).map_err(refused)?;
            let held = self.instance.input_value(*input).unwrap_or_default();
            for (by, weight) in probes(probe) {
                self.instance.plant_mut().set_state(&state).map_err(refused)?;
                self.instance.set_input(*input, held + by)?;
                let driven = self.instance.plant().state();
                add(&mut b, column, weight, &self.rate(&driven, None)?);
                add(&mut d, column, weight, &self.outputs(&driven, outputs)?);
            }
        }
        Ok((finite(b)?, finite(d)?))
    }
}

/// Displacements of a central difference of fourth order, with their weights.
fn probes(probe: f64) -> impl Iterator<Item = (f64, f64)> {
    let both = [(1.0, WEIGHTS[0]), (2.0, WEIGHTS[1])].into_iter();
    both.flat_map(move |(times, weight)| {
        [times * probe, -times * probe].map(|by| (by, weight / probe * by.signum()))
    })
}

/// Adds a weighed column.
fn add(matrix: &mut DMatrix<f64>, column: usize, weight: f64, values: &[f64]) {
    for (entry, value) in matrix.column_mut(column).iter_mut().zip(values) {
        *entry += weight * value;
    }
}

fn undefined(what: String) -> InstanceError {
    InstanceError::Linearisation { what, remedy: "use other outputs or another pose" }
}

fn finite<M: AsRef<[f64]>>(all: M) -> Result<M, InstanceError> {
    if all.as_ref().iter().all(|entry| entry.is_finite()) {
        Ok(all)
    } else {
        Err(undefined("an output or a force is undefined near this state".into()))
    }
}
