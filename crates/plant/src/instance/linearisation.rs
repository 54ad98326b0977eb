//! Linearisation: how a plant's motion answers to small changes of its state and inputs.
//!
//! `(model, state) => f, ∂f/∂x, ∂f/∂u, ∂y/∂x, ∂y/∂u` of ẋ = f(x, u), y = g(x, u), by central differences
//! of fourth order over the kernel's wrenches in double precision, dampers included. Twelve coordinates
//! per body: shift along the world's axes \[m\], turn about the body's \[rad\], and their rates
//! \[m/s, rad/s\], all shifts and turns before all rates. Newton and Euler; the turn φ from a turning body
//! changes as φ̇ = δω − ω × φ.

use dbd_kernel::forces::wrenches;
use dbd_kernel::{F64, Quaternion, State, Vec3};
use dbd_scene::SceneModel;

use crate::instance::blueprint::Blueprint;
use crate::instance::error::InstanceError;
use crate::instance::running::Instance;
use crate::instance::settings::Settings;

/// Weights of the differences at 1 and 2 probes.
const WEIGHTS: [f64; 2] = [8.0 / 12.0, -1.0 / 12.0];

type Bodies = State<SceneModel<F64>>;

/// The Jacobians of a state, rows one after another.
#[derive(Clone, Debug, PartialEq)]
pub struct Jacobians {
    /// How many coordinates.
    pub count: usize,
    /// \[m/s, rad/s, m/s², rad/s²\] ẋ itself.
    pub rate: Vec<f64>,
    /// \[units of `rate` over those of the coordinates\] ∂ẋ/∂x, count × count.
    pub a: Vec<f64>,
    /// \[units of `rate` over those of the inputs\] ∂ẋ/∂u, count × inputs.
    pub b: Vec<f64>,
    /// \[units of the outputs over those of the coordinates\] ∂y/∂x, outputs × count.
    pub c: Vec<f64>,
    /// \[units of the outputs over those of the inputs\] ∂y/∂u, outputs × inputs.
    pub d: Vec<f64>,
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
        let set = of.set().iter().map(|(path, value)| (path.as_str(), *value));
        instance.set_parameters(set)?;
        let mut state = instance.plant().state();
        let now = of.plant().state();
        state.bodies = now.bodies;
        state.signals = now.signals;
        state.step = now.step;
        if state.turns.len() == now.turns.len() {
            state.turns = now.turns;
        }
        let rates = state.bodies.iter().map(|body| body.angular_velocity).collect();
        Ok(Self { instance, state, rates })
    }

    /// Moves the state by so much of each coordinate \[m, rad, m/s, rad/s\].
    pub fn shift(&mut self, by: &[f64]) {
        for (coordinate, by) in by.iter().enumerate() {
            self.state = self.moved(coordinate, *by);
        }
        self.rates = self.state.bodies.iter().map(|body| body.angular_velocity).collect();
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

    /// ẋ in a state whose turns are small ones from the probe's.
    fn rate(
        &self,
        state: &Bodies,
        turned: Option<(usize, Vec3<f64>)>,
    ) -> Result<Vec<f64>, InstanceError> {
        let model = self.instance.plant().model();
        let forces = wrenches(model, state, self.instance.step_size())
            .map_err(|cause| InstanceError::Linearisation(self.instance.scene().fault(&cause)))?;
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
        let refused = |error| InstanceError::Linearisation(format!("{error}"));
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
        let (count, state) = (self.count(), self.state.clone());
        let mut rate = self.rate(&state, None)?;
        for (row, spin) in self.rates.iter().enumerate() {
            rate[6 * row + 3..6 * row + 6].copy_from_slice(&spin.to_f64());
        }
        let (mut a, mut c) = (vec![0.0; count * count], vec![0.0; outputs.len() * count]);
        for column in 0..count {
            let part = column % 6;
            let turned = |by: f64| {
                let turn = column < count / 2 && part >= 3;
                turn.then(|| ((column / 6), Vec3::axes()[part % 3] * by))
            };
            for (times, weight) in [1.0, 2.0].into_iter().zip(WEIGHTS) {
                for by in [times * probe, -times * probe] {
                    let weight = weight / probe * by.signum();
                    let moved = self.moved(column, by);
                    let rates = self.rate(&moved, turned(by))?;
                    add(&mut a, count, column, weight, &rates);
                    add(&mut c, count, column, weight, &self.outputs(&moved, outputs)?);
                }
            }
        }
        let width = inputs.len();
        let (mut b, mut d) = (vec![0.0; count * width], vec![0.0; outputs.len() * width]);
        for (column, input) in inputs.iter().enumerate() {
            let kind = self.instance.inputs().get(*input).map(|input| input.unit);
            let probe = if matches!(kind, Some("m" | "m/s")) { probe } else { 1.0 };
            let held = self.instance.input_value(*input).unwrap_or_default();
            for (times, weight) in [1.0, 2.0].into_iter().zip(WEIGHTS) {
                for by in [times * probe, -times * probe] {
                    let weight = weight / probe * by.signum();
                    self.instance.plant_mut().set_state(&state).ok();
                    self.instance.set_input(*input, held + by)?;
                    let driven = self.instance.plant().state();
                    let rates = self.rate(&driven, None)?;
                    add(&mut b, width, column, weight, &rates);
                    add(&mut d, width, column, weight, &self.outputs(&driven, outputs)?);
                }
            }
        }
        let finite = |all: &[f64]| all.iter().all(|entry| entry.is_finite());
        if finite(&rate) && [&a, &b, &c, &d].into_iter().all(|all| finite(all)) {
            Ok(Jacobians { count, rate, a, b, c, d })
        } else {
            let what = "an output or a force is undefined near this state";
            Err(InstanceError::Linearisation(what.to_owned()))
        }
    }
}

/// Adds a weighed column.
fn add(matrix: &mut [f64], width: usize, column: usize, weight: f64, values: &[f64]) {
    for (row, value) in values.iter().enumerate() {
        if let Some(entry) = matrix.get_mut(row * width + column) {
            *entry += weight * value;
        }
    }
}
