//! The energy balance of a run.
//!
//! `(scene, method, plan; steps done) => work of loads, inputs and moved ground, losses in dampers and memories of
//! laws, residual`.
//!
//! A second plant follows the run step by step, so that the timing of the first one's steps
//! is not affected. The powers at both ends of a step, each with the loads and signals of that step, give its
//! work by the trapezoidal rule; between jumps or kinks of loads and signals the ends are corrected by
//! differences (Gregory), which makes it of fourth order. A jump of the ground between two steps adds the jump of the
//! springs' energy, as does that of an input that moves springs of laws. A law with memory loses energy when its memory changes: the law's energy with the old memory minus
//! that with the new one. Events shorter than a step are not resolved, e.g. a damper that stops a body within it.

use dbd_kernel::elements::input::InputKind;
use dbd_kernel::energy::{energy, of_memories};
use dbd_kernel::power::power;
use dbd_kernel::schedule::{LoadWindow, Signal};
use dbd_kernel::{F64, State};
use dbd_plant::monitor::laws_dissipate;
use dbd_plant::{AnyPlant, Method, Named as _, Plan, PlantError, SchemeName, plant};
use dbd_scene::{Scene, SceneModel};
use serde::Serialize;

type States = State<SceneModel<F64>>;

/// The energy balance of a run: `E(t) − E(0) = loads + inputs + anchors − dampers − laws + remains`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct EnergyBalance {
    /// \[J\] work of the loads.
    pub loads: f64,
    /// \[J\] work of the inputs: forces, torques, actuators, drives, free lengths.
    pub inputs: f64,
    /// \[J\] work of ground that inputs move.
    pub anchors: f64,
    /// \[J\] losses in dampers, those of interactions included.
    pub dampers: f64,
    /// \[J\] losses of interactions when their memories changed, e.g. slipping dry friction.
    pub laws: f64,
    /// \[J\] the residual: errors of the scheme, of rounding and of
    /// this balance.
    pub remains: f64,
}

/// Accumulates the energy balance of a run.
pub struct Balance {
    plant: Box<dyn AnyPlant>,
    /// The model that steps, its numbers taken as exact.
    model: SceneModel<F64>,
    windows: Vec<LoadWindow>,
    initial: f64,
    work: EnergyBalance,
    /// Since the last jump or kink of loads and signals.
    piece: Piece,
}

/// Powers \[W\] of loads, inputs, moved ground and dampers.
type Powers = [f64; 4];

/// Steps with smooth loads and signals.
#[derive(Clone, Default)]
struct Piece {
    /// The first three powers, or as many as there are.
    first: Vec<Powers>,
    /// The last three, the latest last.
    last: Vec<Powers>,
}

impl Piece {
    fn push(&mut self, powers: Powers) {
        if self.first.len() < 3 {
            self.first.push(powers);
        }
        if self.last.len() == 3 {
            self.last.remove(0);
        }
        self.last.push(powers);
    }

    /// \[J\] end correction of the trapezoidal rule in steps of `h` \[s\]: Gregory's differences of first and
    /// second order.
    fn correction(&self, h: f64) -> Powers {
        let ([a0, a1, a2], [b2, b1, b0]) = (&self.first[..], &self.last[..]) else {
            return Powers::default();
        };
        std::array::from_fn(|i| {
            let slopes = (b0[i] - b1[i]) - (a1[i] - a0[i]);
            let bends = (b0[i] - 2.0 * b1[i] + b2[i]) + (a2[i] - 2.0 * a1[i] + a0[i]);
            -h * (slopes / 12.0 + bends / 24.0)
        })
    }
}

impl Balance {
    /// The balance of a new run; `None` for a scene without loads, inputs and dissipative interactions.
    ///
    /// # Errors
    /// Where there is no plant of the method with the plan's step.
    pub fn new(scene: &Scene, method: &Method, plan: &Plan) -> Result<Option<Self>, PlantError> {
        let is_driven = !(scene.model.loads.is_empty() && scene.model.inputs.is_empty());
        if !is_driven && !laws_dissipate(scene) {
            return Ok(None);
        }
        let plant = plant(scene, method, plan.step)?;
        let model = plant.model().clone();
        let windows =
            model.loads.iter().map(|load| LoadWindow::new(load.from, load.until, plan.step));
        let windows = windows.collect();
        let initial = plant.energy().total();
        let work = EnergyBalance::default();
        Ok(Some(Self { plant, model, windows, initial, work, piece: Piece::default() }))
    }

    /// Follows the run to this number of steps.
    pub fn advance(&mut self, steps: u64) {
        let mut state = self.plant.state();
        while state.step < steps && self.plant.status().is_ok() {
            state = self.step(&state);
        }
    }

    fn step(&mut self, state: &States) -> States {
        let h = self.plant.step_size();
        if self.piece.last.is_empty() {
            self.piece.push(self.powers(state));
        }
        let signals = self.plant.signals_at_end();
        let _ = self.plant.step();
        let next = self.plant.state();
        // Loads and signals of the step, at its end.
        let end = State { step: state.step, signals, ..next.clone() };
        let (begun, ended) =
            (self.piece.last.last().copied().unwrap_or_default(), self.powers(&end));
        self.piece.push(ended);
        self.work.add(std::array::from_fn(|i| 0.5 * h * (begun[i] + ended[i])));
        let [anchors, inputs] = self.jumps(&end, &next);
        self.work.anchors += anchors;
        self.work.inputs += inputs;
        self.work.laws += self.forgotten(state, &next);
        let bends = end.signals != next.signals
            || self.windows.iter().any(|window| window.changes_at(next.step));
        if bends {
            self.work.add(self.piece.correction(h));
            self.piece = Piece::default();
        }
        next
    }

    fn powers(&self, state: &States) -> Powers {
        let powers = power(&self.model, state, self.plant.step_size()).unwrap_or_default();
        [powers.loads, powers.inputs, powers.ground, powers.dampers]
    }

    /// \[J\] losses of laws in a step when their memories changed.
    fn forgotten(&self, before: &States, after: &States) -> f64 {
        if before.laws == after.laws {
            return 0.0;
        }
        // The energy with the old memory minus that with the new one. The other schemes update memories at the
        // beginning of a step. These update them at its end, and only forces of updated memories act: the work of their
        // mean over a step is the mean of both poses.
        let at_end =
            [SchemeName::Leapfrog, SchemeName::GeneralizedAlpha, SchemeName::GeneralizedAlpha3]
                .map(|scheme| scheme.name());
        let with = |pose: &States, laws: &States| {
            let state = State { laws: laws.laws.clone(), ..pose.clone() };
            of_memories(&self.model, &state)
        };
        let lost = |pose| with(pose, before) - with(pose, after);
        match at_end.contains(&self.plant.method().scheme_name()) {
            true => 0.5 * (lost(before) + lost(after)),
            false => lost(before),
        }
    }

    /// \[J\] the changes of energy by jumps of the ground, and of inputs that move springs of laws.
    fn jumps(&self, before: &States, after: &States) -> [f64; 2] {
        let model = &self.model;
        let value = |signal: &Signal<f64>| signal.value;
        let pairs = before.signals.iter().zip(&after.signals);
        if pairs.clone().all(|(before, after)| value(before) == value(after)) {
            return [0.0; 2];
        }
        let of = |state: &States| energy(model, state, self.plant.step_size()).potential();
        let is_anchor = |row: usize| {
            model
                .inputs
                .get(row)
                .is_some_and(|input| matches!(input.kind, InputKind::Anchor { .. }))
        };
        let signals = pairs.enumerate().map(
            |(row, (before, after))| {
                if is_anchor(row) { *after } else { *before }
            },
        );
        let moved = State { signals: signals.collect(), ..before.clone() };
        let [first, second, last] = [of(before), of(&moved), of(after)];
        [second - first, last - second]
    }

    /// The balance so far.
    #[must_use]
    pub fn balance(&self) -> EnergyBalance {
        let mut work = self.work;
        work.add(self.piece.correction(self.plant.step_size()));
        let EnergyBalance { loads, inputs, anchors, dampers, laws, .. } = work;
        let change = self.plant.energy().total() - self.initial;
        EnergyBalance { remains: change - (loads + inputs + anchors - dampers - laws), ..work }
    }
}

impl EnergyBalance {
    fn add(&mut self, [loads, inputs, anchors, dampers]: Powers) {
        self.loads += loads;
        self.inputs += inputs;
        self.anchors += anchors;
        self.dampers += dampers;
    }
}

#[cfg(test)]
mod tests {
    use dbd_plant::plan::{Request, StepRequest, plan};

    use super::*;

    const SCENE: &str = r#"
name = "driven"
duration = 1
[[body]]
name = "b"
mass = 2
inertia = [0.1, 0.2, 0.2]
position = [1, 0.1, 0]
[[tsda]]
name = "mount"
between = ["world", "b"]
points = [[0, 0, 0], [0, 0.1, 0]]
stiffness = 400
damping = 8
free_length = 1
[[load]]
body = "b"
force = [10, 4, 0]
from = 0.25
until = 0.5
[[input]]
name = "push"
type = "force"
body = "b"
axis = [1, 1, 0]
table = [[0, 0], [0.5, 20], [0.75, -20]]
[[input]]
name = "shake"
type = "anchor"
target = "mount"
axis = [1, 0, 0]
sine = { amplitude = "2 cm", frequency = 6 }
[[input]]
name = "tilt"
type = "gravity"
axis = [1, 0, 0]
sine = { amplitude = 9, frequency = 2 }
"#;

    /// The balance of a run by a slightly different model.
    fn balance(wrong: impl FnOnce(&mut SceneModel<F64>)) -> EnergyBalance {
        let scene = Scene::parse(SCENE, "driven.toml").unwrap();
        let request = Request { step: StepRequest::Given(1e-3), duration: 1.0, every: Some(0.1) };
        let plan = plan(&request).unwrap();
        let mut balance = Balance::new(&scene, &Method::default(), &plan).unwrap().unwrap();
        wrong(&mut balance.model);
        balance.advance(plan.steps);
        balance.balance()
    }

    #[test]
    fn a_wrong_sign_remains() {
        let right = balance(|_| {});
        let least = [right.loads, right.inputs, right.anchors, right.dampers]
            .into_iter()
            .fold(f64::INFINITY, |least, part| least.min(part.abs()));
        assert!(right.remains.abs() < 1e-3 * least, "{right:?}");
        type Change = fn(&mut SceneModel<F64>);
        let wrong: [(&str, Change); 5] = [
            ("load", |model| model.loads[0].force = -model.loads[0].force),
            ("damper", |model| model.dampers[0] = -model.dampers[0]),
            ("input", |model| {
                let InputKind::Force { direction, .. } = &mut model.inputs[0].kind else { return };
                *direction = -*direction;
            }),
            ("anchor", |model| {
                let InputKind::Anchor { direction } = &mut model.inputs[1].kind else { return };
                *direction = -*direction;
            }),
            ("gravity", |model| {
                let InputKind::Gravity { direction } = &mut model.inputs[2].kind else { return };
                *direction = -*direction;
            }),
        ];
        for (name, wrong) in wrong {
            let found = balance(wrong);
            assert!(found.remains.abs() > 0.1 * least, "{name}: {found:?}, right: {right:?}");
        }
    }

    /// A rope whose free length is a sine, damped and slack at times, jumps once; a motor with friction turns a wheel.
    const WINCH: &str = r#"
name = "winch"
duration = 1
gravity = [0, -9.81, 0]
[[body]]
name = "load"
mass = 5
inertia = [0.1, 0.2, 0.2]
position = [0, -2, 0]
[[tsda]]
name = "rope"
between = ["world", "load"]
points = [[0, 0, 0], [0, 0, 0]]
stiffness = 1500
damping = 20
acts = "tension"
[[input]]
name = "winch"
type = "free_length"
target = "rope"
sine = { amplitude = "3 cm", frequency = 2, offset = 2 }
[[tsda]]
name = "band"
between = ["world", "load"]
points = [[0, -4, 0], [0, 0, 0]]
stiffness = 40
[[input]]
name = "hook"
type = "free_length"
target = "band"
table = [[0, 1.5], [0.4, 1.2]]
[[body]]
name = "wheel"
mass = 1
inertia = [0.02, 0.02, 0.02]
position = [1, 0, 0]
[[joint]]
name = "pivot"
type = "revolute"
between = ["world", "wheel"]
at = [1, 0, 0]
axis = [0, 0, 1]
span = 0.1
stiffness = 1e5
[[input]]
name = "motor"
type = "drive"
target = "pivot"
mode = "velocity"
kd = 2
rotor = 0.01
gear = { stiffness = 500, damping = 0.2 }
friction = { coulomb = 0.4, viscous = 0.05 }
table = [[0, 0], [0.3, 6], [0.7, -3]]
interpolate = "linear"
"#;

    /// Springs that inputs move and friction of a motor's shaft leave no remainder.
    #[test]
    fn what_free_lengths_give_and_shafts_lose_is_counted() {
        let remains = |step: f64| {
            let scene = Scene::parse(WINCH, "winch.toml").unwrap();
            let request =
                Request { step: StepRequest::Given(step), duration: 1.0, every: Some(0.1) };
            let plan = plan(&request).unwrap();
            let mut balance = Balance::new(&scene, &Method::default(), &plan).unwrap().unwrap();
            balance.advance(plan.steps);
            balance.balance()
        };
        let [coarse, fine] = [2e-4, 5e-5].map(remains);
        let least = [fine.inputs, fine.dampers].into_iter().fold(f64::INFINITY, f64::min);
        assert!(least > 1.0 && fine.anchors == 0.0, "{fine:?}");
        assert!(fine.remains.abs() < 2e-3 * least, "{fine:?}");
        assert!(fine.remains.abs() < coarse.remains.abs(), "{coarse:?} {fine:?}");
    }
}
