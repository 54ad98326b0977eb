//! Static equilibrium and inverse dynamics of a plant.
//!
//! `(instance, held inputs) => poses at rest; (instance, accelerations) => inputs`.

use nalgebra::{DMatrix, DVector, SVD};

use crate::instance::error::InstanceError;
use crate::instance::linear::{LinearOptions, check_states, read_back};
use crate::instance::linearisation::{Jacobians, Probe};
use crate::instance::running::Instance;
use crate::instance::spectrum::{Slow, slowest};

/// Accelerations are reached within this fraction of their largest change.
const REACHED: f64 = 1e-6;
/// \[m, rad\] the largest motion over which the change of the slow motions is taken.
const FORESEEN: f64 = 1e-3;
/// Singular values below this fraction of the largest one count as zero.
const SINGULAR: f64 = 1e-9;

impl Instance {
    /// Moves the bodies to the static equilibrium with the held inputs, downhill from the present pose, without
    /// velocities. Time, inputs and revolution counts are kept; a failure is cleared.
    ///
    /// # Errors
    /// [`InstanceError::Restless`] where there is no equilibrium; nothing is changed then.
    pub fn settle(&mut self) -> Result<(), InstanceError> {
        let probe = Probe::new(self)?;
        let (scene, model) = (probe.instance().scene(), probe.instance().plant().model());
        let rest = dbd_scene::relaxed_state(&scene.body_names, model, probe.state())?;
        let mut state = self.plant().state();
        state.bodies = rest.bodies;
        self.plant_mut().set_state(&state).map_err(|error| InstanceError::Linearisation {
            what: format!("the equilibrium cannot be set: {error}"),
            remedy: "use a scene in space, or double precision",
        })
    }

    /// The inputs \[their units\] that give velocities the wanted accelerations \[their units / s\] in the present state,
    /// as computed-torque control needs them.
    ///
    /// The bodies move along the slow motions, v = N(q)·s, where s are the velocities among the states. Newton's and
    /// Euler's equations are projected onto these, which removes the forces of the joints: Nᵀ·M·(N·ṡ + Ṅ·s) = Nᵀ·f(u)
    /// (Kane 1961). Of several solutions it is the one with the smallest sum of squared changes in SI units.
    ///
    /// # Errors
    /// As [`Self::linearise`], whose `states` must be given, a position and its rate for each degree of freedom;
    /// [`InstanceError::Unknown`] for a name that is not one of them; [`InstanceError::Linearisation`] where the inputs
    /// cannot give the accelerations.
    pub fn inverse_dynamics(
        &self,
        options: &LinearOptions,
        wanted: &[(String, f64)],
    ) -> Result<Vec<(String, f64)>, InstanceError> {
        let refused = |what: String, remedy| InstanceError::Linearisation { what, remedy };
        if let Some((name, value)) = wanted.iter().find(|(_, value)| !value.is_finite()) {
            let what = format!("the acceleration of `{name}` cannot be {value:?}");
            return Err(refused(what, "give finite numbers"));
        }
        let states = options.states.clone().unwrap_or_default();
        let motion = Motion::of(self, &states, options.perturb)?;
        let place = |name: &String| {
            let place = motion.velocities.iter().position(|row| states[*row] == *name);
            if place.is_none() && states.contains(name) {
                let what = format!("`{name}` is a position, which no input accelerates at once");
                return Err(refused(what, "name its rate"));
            }
            place.ok_or_else(|| self.unknown("state", name, states.iter().map(String::as_str)))
        };
        let rows: Vec<usize> =
            wanted.iter().map(|(name, _)| place(name)).collect::<Result<_, _>>()?;
        let all = || self.inputs().iter().map(|input| input.name.clone()).collect();
        let inputs: Vec<String> = options.inputs.clone().unwrap_or_else(all);
        let driven: Vec<usize> =
            inputs.iter().map(|name| self.input(name)).collect::<Result<_, _>>()?;
        let Accelerations { drift, gain } = motion.accelerations(&driven, options.perturb)?;
        let gain =
            DMatrix::from_fn(rows.len(), driven.len(), |row, column| gain[(rows[row], column)]);
        let change = DVector::from_fn(rows.len(), |row, _| wanted[row].1 - drift[rows[row]]);
        let by = solved(&gain, &change).filter(|by| {
            let size = change.amax() + drift.amax();
            gain.nrows() == 0 || (&gain * by - &change).amax() <= REACHED * size
        });
        let Some(by) = by else {
            let names: Vec<_> = wanted.iter().map(|(name, _)| format!("`{name}`")).collect();
            let (inputs, names) = (inputs.join(", "), names.join(", "));
            let what = format!("the inputs {inputs} cannot give {names} these accelerations");
            return Err(refused(what, "name at most as many velocities as inputs that move them"));
        };
        let held = inputs.iter().zip(&driven).zip(&by).map(|((name, input), by)| {
            (name.clone(), self.input_value(*input).unwrap_or_default() + by)
        });
        Ok(held.collect())
    }
}

/// The solution of least norm, by singular values; `None` without a solution.
fn solved(gain: &DMatrix<f64>, change: &DVector<f64>) -> Option<DVector<f64>> {
    if gain.is_empty() {
        return (gain.nrows() == 0).then(|| DVector::zeros(gain.ncols()));
    }
    let parts = SVD::try_new(gain.clone(), true, true, f64::EPSILON, 10_000)?;
    let smallest = SINGULAR * parts.singular_values.max();
    parts.solve(change, smallest).ok()
}

/// The slow motions at a state.
struct Motion {
    probe: Probe,
    /// Rows of the states that are velocities.
    velocities: Vec<usize>,
    /// \[kg, kg·m²\] of each coordinate of the bodies.
    inertia: DVector<f64>,
    /// N: bodies' velocities of each of the velocities.
    basis: DMatrix<f64>,
    /// \[m/s², rad/s²\] Ṅ·s: accelerations of the bodies at constant velocities s.
    curved: DVector<f64>,
}

/// ṡ = drift + gain·δu.
struct Accelerations {
    drift: DVector<f64>,
    gain: DMatrix<f64>,
}

impl Motion {
    fn of(instance: &Instance, states: &[String], perturb: f64) -> Result<Self, InstanceError> {
        let seen = instance.places(states)?;
        let is_velocity = |row: &usize| instance.outputs()[seen[*row]].unit.ends_with("/s");
        let velocities: Vec<usize> = (0..states.len()).filter(is_velocity).collect();
        if 2 * velocities.len() != states.len() || states.is_empty() {
            return Err(InstanceError::Linearisation {
                what: format!(
                    "{} of the {} states of inverse dynamics are velocities",
                    velocities.len(),
                    states.len()
                ),
                remedy: "give a position and its rate for each degree of freedom",
            });
        }
        let mut probe = Probe::new(instance)?;
        check_states(states, &probe)?;
        let half = probe.count() / 2;
        let basis_at = |probe: &mut Probe| {
            let Jacobians { a, c, .. } = probe.jacobians(&[], &seen, perturb)?;
            let Slow { basis, .. } = slowest(&a, states.len())?;
            let back = read_back(&c, &basis, states)?;
            let columns = back.select_columns(&velocities);
            Ok::<_, InstanceError>((basis * columns).rows(half, half).into_owned())
        };
        let basis = basis_at(&mut probe)?;
        let bodies = &probe.state().bodies;
        let moving = bodies
            .iter()
            .flat_map(|body| [body.velocity.to_f64(), body.angular_velocity.to_f64()].concat());
        let moving = DVector::from_iterator(half, moving);
        let values: Vec<f64> = velocities.iter().map(|row| instance.value(seen[*row])).collect();
        let fastest = moving.amax();
        let curved = if fastest > 0.0 {
            let time = FORESEEN / fastest;
            let mut along = DVector::zeros(2 * half);
            let mut move_by = |probe: &mut Probe, time: f64| {
                along.rows_mut(0, half).copy_from(&(&moving * time));
                probe.shift(&along);
            };
            move_by(&mut probe, time);
            let ahead = basis_at(&mut probe)?;
            move_by(&mut probe, -2.0 * time);
            let behind = basis_at(&mut probe)?;
            probe.follow(instance);
            (ahead - behind) * DVector::from_vec(values) / (2.0 * time)
        } else {
            DVector::zeros(half)
        };
        let bodies = &probe.instance().plant().model().bodies;
        let inertia = bodies.iter().flat_map(|body| {
            let [x, y, z] = body.inertia.to_f64();
            [body.mass, body.mass, body.mass, x, y, z]
        });
        let inertia = DVector::from_iterator(half, inertia);
        Ok(Self { probe, velocities, inertia, basis, curved })
    }

    fn accelerations(
        mut self,
        inputs: &[usize],
        perturb: f64,
    ) -> Result<Accelerations, InstanceError> {
        let half = self.probe.count() / 2;
        let rate = self.probe.rates()?;
        let (b, _) = self.probe.input_jacobians(inputs, &[], perturb)?;
        let mut projected = self.basis.transpose();
        for (mut column, inertia) in projected.column_iter_mut().zip(&self.inertia) {
            column *= *inertia;
        }
        let mass = (&projected * &self.basis).cholesky();
        let mass = mass.ok_or_else(|| InstanceError::Linearisation {
            what: "the velocities among the states are not independent".into(),
            remedy: "give a position and its rate for each degree of freedom",
        })?;
        let free = rate.rows(half, half) - &self.curved;
        Ok(Accelerations {
            drift: mass.solve(&(&projected * free)),
            gain: mass.solve(&(&projected * b.rows(half, half))),
        })
    }
}
