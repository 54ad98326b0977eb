//! A plant as a linear system near its present state.
//!
//! `(instance, states, inputs, outputs) => A, B, C, D`. Bodies are held by springs, so the whole system is large
//! and stiff: twelve coordinates per body, most of them vibrations of joints. A controller moves the slow
//! motions. They span an invariant subspace of A; the fast motions are replaced by their quasi-static response.

use nalgebra::{Complex, DMatrix, DVector, SVD};

use crate::instance::error::InstanceError;
use crate::instance::linearisation::{Jacobians, Probe};
use crate::instance::running::Instance;
use crate::instance::spectrum::{Slow, eigenvalues, slowest};

/// The joints are loaded where the fast motions' residual has fallen to this fraction of the first one.
const SETTLED: f64 = 1e-9;
/// Iterations that load the joints.
const SETTLING_ROUNDS: usize = 20;
/// The states determine the slow motions up to this condition number.
const MAX_CONDITION: f64 = 1e6;

/// Options of a linearisation.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearOptions {
    /// Names of outputs that become the states; `None` for the twelve coordinates of each body.
    pub states: Option<Vec<String>>,
    /// Names of inputs; `None` for all.
    pub inputs: Option<Vec<String>>,
    /// Names of outputs; `None` for the states, without states for all read-outs.
    pub outputs: Option<Vec<String>>,
    /// \[m, rad, m/s, rad/s\] the displacement of the differences, which are of fourth order; above 0, below
    /// 0.1.
    pub perturb: f64,
}

impl Default for LinearOptions {
    fn default() -> Self {
        Self { states: None, inputs: None, outputs: None, perturb: 1e-5 }
    }
}

/// A plant near a state: ẋ = drift + A·x + B·u, y = y₀ + C·x + D·u, with x, u and y as differences from there.
///
/// With named states x are these outputs, restricted to the slow motions. Without, x are all coordinates of all bodies:
/// per body shifts along the world's axes \[m\] and rotations about the body's axes \[rad\], then in the same
/// order their rates \[m/s, rad/s\].
#[derive(Clone, Debug, PartialEq)]
pub struct Linear {
    /// \[unit of the row's state / (s · unit of the column's state)\] states × states.
    pub a: DMatrix<f64>,
    /// \[unit of the state / (s · unit of the input)\] states × inputs.
    pub b: DMatrix<f64>,
    /// \[unit of the output / unit of the state\] outputs × states.
    pub c: DMatrix<f64>,
    /// \[unit of the output / unit of the input\] outputs × inputs.
    pub d: DMatrix<f64>,
    /// \[unit of the state / s\] ẋ at the state itself, zero in an equilibrium.
    pub drift: DVector<f64>,
    /// Names of the states.
    pub states: Vec<String>,
    /// Names of the inputs.
    pub inputs: Vec<String>,
    /// Names of the outputs.
    pub outputs: Vec<String>,
    /// \[rad/s\] the slowest motion left out; infinite if none was.
    pub slowest_left_out: f64,
}

impl Linear {
    /// \[rad/s\] the eigenvalues of A in ascending order of their moduli.
    ///
    /// # Errors
    /// [`InstanceError::Linearisation`] where they cannot be computed.
    pub fn poles(&self) -> Result<Vec<Complex<f64>>, InstanceError> {
        eigenvalues(&self.a)
    }
}

impl Instance {
    /// The plant as a linear system near its present state, in double precision and continuous time. The plant
    /// does not change.
    ///
    /// With n states the system is reduced to its n slowest motions. The joints are loaded first, because a preload
    /// stiffens them: the linear system is that of the pose with loaded joints. D contains the quasi-static
    /// contribution of the fast motions to the outputs.
    ///
    /// # Errors
    /// [`InstanceError::Unknown`] for an unknown name, [`InstanceError::Linearisation`] where the states do
    /// not determine the slow motions, the next motion is less than three times as fast, the joints do not
    /// settle, or a force or an output is undefined.
    pub fn linearise(&self, options: &LinearOptions) -> Result<Linear, InstanceError> {
        let LinearOptions { states, inputs, outputs, perturb } = options;
        if !(perturb.is_finite() && *perturb > 0.0 && *perturb < 0.1) {
            return Err(InstanceError::Linearisation {
                what: format!("perturb cannot be {perturb:?}"),
                remedy: "give a number between 0 and 0.1",
            });
        }
        // A sensor keeps its samples: it does not follow small changes of the state.
        let is_sensor = |name: &String| name.ends_with(".sensor");
        let asked = [states, outputs].into_iter().flatten().flatten();
        if let Some(name) = asked.into_iter().find(|name| is_sensor(name)) {
            return Err(InstanceError::Linearisation {
                what: format!("the output `{name}` is sampled by a sensor"),
                remedy: "use the read-out without `.sensor`",
            });
        }
        let all = || self.inputs().iter().map(|input| input.name.clone()).collect();
        let inputs: Vec<String> = inputs.clone().unwrap_or_else(all);
        let driven: Result<Vec<_>, _> = inputs.iter().map(|name| self.input(name)).collect();
        let driven = driven?;
        let places = |names: &[String]| self.places(names);
        let Some(states) = states.clone() else {
            let first = self.outputs().len() - self.readout_columns();
            let names = self.outputs()[first..].iter().map(|output| output.name.clone());
            let names = names.filter(|name| !is_sensor(name));
            let outputs = outputs.clone().unwrap_or_else(|| names.collect());
            let shown = places(&outputs)?;
            let Jacobians { rate, a, b, c, d } =
                Probe::new(self)?.jacobians(&driven, &shown, *perturb)?;
            let (states, slowest_left_out) = (coordinates(self), f64::INFINITY);
            return Ok(Linear {
                a,
                b,
                c,
                d,
                drift: rate,
                states,
                inputs,
                outputs,
                slowest_left_out,
            });
        };
        let outputs = outputs.clone().unwrap_or_else(|| states.clone());
        let [seen, shown] = [places(&states)?, places(&outputs)?];
        let mut probe = Probe::new(self)?;
        let count = states.len();
        check_states(&states, &probe)?;
        let settled = Settled::of(&mut probe, &driven, &[seen, shown].concat(), count, *perturb)?;
        let Settled { jacobians: Jacobians { rate, a, b, c, d }, slow, response } = settled;
        let Slow { basis, dual, slowest_left_out } = slow;
        let (seen, shown) = (c.rows(0, count), c.rows(count, outputs.len()));
        let see = seen * &basis;
        let back = read_back(&seen.into_owned(), &basis, &states)?;
        let shown_of_input = d.rows(count, outputs.len()) + shown * response;
        Ok(Linear {
            a: &see * (&dual * a * &basis) * &back,
            b: &see * (&dual * b),
            c: shown * basis * back,
            d: shown_of_input,
            drift: see * (dual * rate),
            states,
            inputs,
            outputs,
            slowest_left_out,
        })
    }

    /// The indices of outputs.
    pub(super) fn places(&self, names: &[String]) -> Result<Vec<usize>, InstanceError> {
        names.iter().map(|name| self.output(name)).collect()
    }

    /// How many of the outputs are columns of read-outs.
    fn readout_columns(&self) -> usize {
        self.scene().readouts.iter().map(|readout| readout.columns.len()).sum()
    }
}

/// The Jacobians with loaded joints.
struct Settled {
    jacobians: Jacobians,
    slow: Slow,
    /// Quasi-static response of the fast motions to the inputs, coordinates × inputs.
    response: DMatrix<f64>,
}

impl Settled {
    /// Moves the fast motions to equilibrium by Newton's method.
    fn of(
        probe: &mut Probe,
        inputs: &[usize],
        outputs: &[usize],
        count: usize,
        perturb: f64,
    ) -> Result<Self, InstanceError> {
        let restless = || InstanceError::Linearisation {
            what: "the joints do not reach equilibrium under their loads near this state".into(),
            remedy: "use a pose closer to equilibrium",
        };
        let mut first = None;
        for _ in 0..SETTLING_ROUNDS {
            let jacobians = probe.jacobians(inputs, outputs, perturb)?;
            let Jacobians { rate, a, b, .. } = &jacobians;
            let slow = slowest(a, count)?;
            let Slow { basis, dual, slowest_left_out } = &slow;
            let fast = |of: &DMatrix<f64>| of - basis * (dual * of);
            // Invertible on the fast motions: the slow ones are replaced by decays that are as fast.
            let replaced = (fast(a) - basis * dual * *slowest_left_out).lu();
            let at_rest = |of: &DMatrix<f64>| {
                let settled = replaced.solve(&-fast(of)).ok_or_else(restless)?;
                Ok::<_, InstanceError>(fast(&settled))
            };
            let shift = at_rest(&DMatrix::from_column_slice(rate.len(), 1, rate.as_slice()))?;
            let residual = shift.norm();
            if residual <= SETTLED * first.get_or_insert(residual).max(1e-3) {
                let response = at_rest(b)?;
                return Ok(Self { slow, response, jacobians });
            }
            if residual.is_nan() || residual > 1.0 {
                return Err(restless());
            }
            probe.shift(&shift.column(0).into_owned());
        }
        Err(restless())
    }
}

/// Refuses states that are no reduction.
pub(super) fn check_states(states: &[String], probe: &Probe) -> Result<(), InstanceError> {
    let (count, whole) = (states.len(), probe.count());
    let is_twice = |(row, name)| states[..row].contains(name);
    if (1..whole).contains(&count) && !states.iter().enumerate().any(is_twice) {
        return Ok(());
    }
    Err(InstanceError::Linearisation {
        what: format!("cannot reduce a system of {whole} coordinates to {count} states"),
        remedy: "name each output once, at least one and fewer than the coordinates",
    })
}

/// The parts of a basis of the slowest motions for given values of the states, whose gradients are `seen`.
pub(super) fn read_back(
    seen: &DMatrix<f64>,
    basis: &DMatrix<f64>,
    states: &[String],
) -> Result<DMatrix<f64>, InstanceError> {
    inverse(&(seen * basis), &(seen.abs() * basis.abs())).ok_or_else(|| {
        InstanceError::Linearisation {
            what: format!(
                "the outputs {} do not distinguish the {} slowest motions",
                states.join(", "),
                states.len()
            ),
            remedy: "give a position and its rate for each degree of freedom",
        }
    })
}

/// The inverse of a square matrix whose entries are sums of terms of the given magnitudes; `None` where it is
/// singular, or nearly.
fn inverse(matrix: &DMatrix<f64>, magnitudes: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let mut scaled = matrix.clone();
    for (row, magnitudes) in magnitudes.row_iter().enumerate() {
        let largest = magnitudes.max();
        scaled.row_mut(row).unscale_mut(if largest > 0.0 { largest } else { 1.0 });
    }
    for mut column in scaled.column_iter_mut() {
        let norm = column.norm().max(1e-300);
        column.unscale_mut(norm);
    }
    let values = SVD::try_new(scaled, false, false, f64::EPSILON, 10_000)?.singular_values;
    let is_regular = values.max() <= MAX_CONDITION * values.min();
    if is_regular { matrix.clone().try_inverse() } else { None }
}

/// Names of the twelve coordinates of each body.
fn coordinates(of: &Instance) -> Vec<String> {
    let parts =
        [["x", "y", "z", "turn.x", "turn.y", "turn.z"], ["vx", "vy", "vz", "wx", "wy", "wz"]];
    let bodies = &of.scene().body_names;
    let of_bodies = parts.iter().flat_map(|parts| {
        bodies.iter().flat_map(move |body| parts.iter().map(move |part| format!("{body}.{part}")))
    });
    of_bodies.collect()
}
