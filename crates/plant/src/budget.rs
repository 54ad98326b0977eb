//! Upper bound of the energy of a run.
//!
//! `(model, sampled states) => mechanical energy | unexplained energy`. The bound sums the initial energy, the energy
//! released by gravity and springs, the work of loads, inputs and moved ground, and the effect of rounding: rounding
//! errors of coordinates and lever arms cause spring forces, which accelerate free bodies. Each term is an upper bound
//! computed from the sampled states. An energy a hundred times above their sum indicates the exponential growth of an
//! unstable step.

use dbd_kernel::elements::input::InputKind;
use dbd_kernel::energy::each_extension;
use dbd_kernel::model::{Group, Law};
use dbd_kernel::{BodyIndex, Energy, F64, Revolute, State, Vec3};
use dbd_scene::SceneModel;

/// Unexplained energy is a divergence once it exceeds this many times the energies of the run, far above the error of a
/// coarse run.
const GROWN: f64 = 100.0;

/// Extension of all springs, as a fraction of the scene's size, whose energy counts as an energy of the run: far above
/// the rounding errors of any precision.
const SHARE: f64 = 1e-4;

/// Number of roundings between a coordinate and a spring's force, all in the same direction.
const ROUNDINGS: f64 = 16.0;

type States = State<SceneModel<F64>>;

/// Bounds of the energy of a run.
pub(crate) struct Budget {
    /// \[J\] energies at t = 0, and of springs extended by [`SHARE`].
    held: f64,
    /// \[J\] potential and mechanical energy at t = 0.
    initial: [f64; 2],
    /// \[J\] the largest potential energy released so far.
    released: f64,
    /// \[J\] upper bound of the work of loads and inputs so far.
    supplied: f64,
    /// The relative rounding of a coordinate.
    unit: f64,
    /// Those of each group that stretch with the ground.
    reaches: Vec<Reach>,
    /// \[m\] largest distance of each body from the origin so far.
    distances: Vec<f64>,
    /// Last sampled state.
    before: Seen,
}

/// The size and the stiffness of a group.
struct Reach {
    /// The rows of its bodies, where they are bodies.
    bodies: [Option<usize>; 2],
    /// \[m\] the largest distance of a point from its body's centre of mass; of ground from the
    /// origin.
    arms: [f64; 2],
    /// \[m\] the largest free length.
    free_length: f64,
    /// \[N/m\] of all its elements.
    stiffness: f64,
    /// \[N·s/m\] likewise.
    damping: f64,
}

/// Speeds and signals of a state.
#[derive(Clone, Default)]
struct Seen {
    time: f64,
    /// \[m/s, rad/s\] of each body.
    speeds: Vec<[f64; 2]>,
    /// Value and rate of each input.
    signals: Vec<[f64; 2]>,
    /// \[m\] the largest extension of each group; only where ground moves.
    extensions: Vec<f64>,
}

impl Budget {
    /// The budget of a run from `start`, whose energy is `energy`, in a precision that rounds
    /// numbers by `unit`.
    pub(crate) fn new(
        model: &SceneModel<F64>,
        start: &States,
        energy: &Energy<f64>,
        unit: f64,
    ) -> Self {
        // Without `..`, so that a further kind of energy is not forgotten.
        let Energy { kinetic, gravity, tsda, bushing, line, torsion, law, load: _ } = *energy;
        let parts = [gravity, tsda, bushing, line, torsion, law];
        let reaches: Vec<Reach> =
            model.groups.iter().map(|group| Reach::of(model, group)).collect();
        let distances: Vec<f64> = start.bodies.iter().map(|body| length(body.position)).collect();
        let sizes = reaches.iter().map(|reach| reach.size(&distances));
        let size = sizes.chain(distances.iter().copied()).fold(0.0, f64::max);
        let stiffness: f64 = reaches.iter().map(|reach| reach.stiffness).sum();
        let turning: f64 =
            model.torsions.iter().map(|spring| spring.stiffness + spring.preload.abs()).sum();
        let held = kinetic
            + parts.iter().map(|part| part.abs()).sum::<f64>()
            + 0.5 * SHARE * SHARE * (stiffness * size * size + turning);
        let before = Seen::of(model, start, 0.0);
        let initial = [energy.potential(), energy.total()];
        Self { held, initial, released: 0.0, supplied: 0.0, unit, reaches, distances, before }
    }

    /// The unexplained energy of a state at `time` \[s\], if it exceeds the bound.
    pub(crate) fn beyond(
        &mut self,
        model: &SceneModel<F64>,
        state: &States,
        energy: &Energy<f64>,
        time: f64,
    ) -> Option<f64> {
        let [potential, total] = self.initial;
        self.released = self.released.max(potential - energy.potential());
        for (distance, body) in self.distances.iter_mut().zip(&state.bodies) {
            *distance = distance.max(length(body.position));
        }
        let now = Seen::of(model, state, time);
        self.supplied += self.supply(model, &now);
        self.before = now;
        let growth = energy.total() - total;
        let measure = GROWN * (self.held + self.released + self.supplied);
        (growth > measure && growth > measure + self.rounding(model, time)).then_some(growth)
    }

    /// \[J\] upper bound of the energy from rounding until `time` \[s\]: in springs at the bodies' present distances,
    /// and in bodies that it accelerates in one direction all the time.
    fn rounding(&self, model: &SceneModel<F64>, time: f64) -> f64 {
        let mut pushed = vec![[0.0; 2]; model.bodies.len()];
        let mut stretched = 0.0;
        let mut push = |bodies: [Option<usize>; 2], force: f64, torques: [f64; 2]| {
            for (row, torque) in bodies.into_iter().zip(torques) {
                if let Some([f, t]) = row.and_then(|row| pushed.get_mut(row)) {
                    *f += force;
                    *t += torque;
                }
            }
        };
        for reach in &self.reaches {
            let deformation = ROUNDINGS * self.unit * reach.size(&self.distances);
            let force = reach.stiffness * deformation;
            stretched += 0.5 * force * deformation;
            push(reach.bodies, force, reach.arms.map(|arm| force * arm));
        }
        for spring in &model.torsions {
            let torque = ROUNDINGS * self.unit * (spring.stiffness + spring.preload.abs());
            push([body(spring.a), body(spring.b)], 0.0, [torque; 2]);
        }
        let moved = model.bodies.iter().zip(&pushed).filter(|(body, _)| !body.is_driven());
        let gathered = moved.map(|(body, [force, torque])| {
            let [linear, angular] = [force * time, torque * time];
            let inertia = body.inertia.to_f64().into_iter().fold(f64::INFINITY, f64::min);
            0.5 * (linear * linear / body.mass + angular * angular / inertia)
        });
        GROWN * stretched + gathered.sum::<f64>()
    }

    /// \[J\] upper bound of the work of loads and inputs since the last sampled state.
    fn supply(&self, model: &SceneModel<F64>, now: &Seen) -> f64 {
        let (from, until) = (self.before.time, now.time);
        let span = (until - from).max(0.0);
        // The higher of the two speeds of a body between two samples.
        let speed = |row: Option<usize>| {
            let of = |seen: &Seen| seen.speeds.get(row?).copied();
            let [one, other] = [&self.before, now].map(|seen| of(seen).unwrap_or_default());
            [one[0].max(other[0]), one[1].max(other[1])]
        };
        let mut work = 0.0;
        for load in &model.loads {
            let acts = load.until.min(until) - load.from.max(from);
            let [linear, angular] = speed(body(load.body));
            // Windows consist of whole steps and may differ slightly at their ends.
            if acts > -span {
                work += (length(load.force) * linear + length(load.torque) * angular) * span;
            }
        }
        for (row, input) in model.inputs.iter().enumerate() {
            let signal = |seen: &Seen| seen.signals.get(row).copied().unwrap_or_default();
            let ends = [signal(&self.before), signal(now)];
            let first = usize::from(input.knot);
            let knots = model.knots.get(first..first + usize::from(input.knots));
            let knots = knots.unwrap_or_default();
            let passed = knots.partition_point(|knot| knot.time < from)
                ..knots.partition_point(|knot| knot.time <= until);
            let passed = knots.get(passed).unwrap_or_default();
            let values = passed.iter().map(|knot| knot.value);
            // The largest value of a source.
            let mut sources = model.sources.iter().filter(|s| usize::from(s.input.0) == row);
            let source = sources.next().map_or([0.0; 2], |source| source.most(&model.knots));
            let most =
                values.chain(ends.map(|end| end[0])).fold(source[0], |m: f64, v| m.max(v.abs()));
            work += match input.kind {
                InputKind::Force { body: on, point, .. } => {
                    let [linear, angular] = speed(body(on));
                    most * (linear + angular * length(point)) * span
                }
                InputKind::Torque { body: on, .. } => most * speed(body(on))[1] * span,
                InputKind::JointTorque { a, b, .. } => {
                    most * (speed(body(a))[1] + speed(body(b))[1]) * span
                }
                InputKind::JointForce { a, b, point, .. } => {
                    let distance = |row: Option<usize>| {
                        row.and_then(|row| self.distances.get(row)).copied().unwrap_or(0.0)
                    };
                    let ([v_a, w_a], [v_b, w_b]) = (speed(body(a)), speed(body(b)));
                    // The lever arm on A is at most the distance of the centres and that of the point.
                    let (arm, apart) = (length(point), distance(body(a)) + distance(body(b)));
                    most * (v_a + w_a * (apart + arm) + v_b + w_b * arm) * span
                }
                InputKind::Actuator { group, .. } => {
                    let reach = self.reaches.get(group.row());
                    reach.map_or(0.0, |reach| {
                        let ends = reach.bodies.into_iter().zip(reach.arms);
                        let speeds = ends.map(|(row, arm)| speed(row)[0] + speed(row)[1] * arm);
                        most * speeds.sum::<f64>() * span
                    })
                }
                InputKind::Gravity { .. } => {
                    let bodies = model.bodies.iter().enumerate();
                    let rates = bodies.map(|(row, body)| body.mass * speed(Some(row))[0]);
                    most * rates.sum::<f64>() * span
                }
                // The work of a driven body has no bound that is known here either.
                InputKind::Velocity { .. } | InputKind::AngularVelocity { .. } => f64::INFINITY,
                // The energy of a drive has no bound that is known here.
                InputKind::Signal => f64::INFINITY,
                InputKind::Anchor { .. } => {
                    let rates = passed.iter().map(|knot| knot.slope);
                    let rates = rates.chain(ends.map(|end| end[1]));
                    let rate = rates.fold(source[1], |most: f64, rate| most.max(rate.abs()));
                    // Jumps, from value to value on.
                    let values = passed.iter().map(|knot| knot.value);
                    let places = std::iter::once(ends[0][0]).chain(values).chain([ends[1][0]]);
                    let places: Vec<f64> = places.collect();
                    let jumps: f64 = places.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
                    self.moved_ground(model, row, (rate * span).max(jumps), span, now)
                }
            };
        }
        work
    }

    /// \[J\] upper bound of the work of ground that input `row` moves by `way` \[m\] within `span` \[s\].
    fn moved_ground(
        &self,
        model: &SceneModel<F64>,
        row: usize,
        way: f64,
        span: f64,
        now: &Seen,
    ) -> f64 {
        let mut work = 0.0;
        for (i, (group, reach)) in model.groups.iter().zip(&self.reaches).enumerate() {
            if ![group.a, group.b].iter().any(|end| end.anchor_row() == Some(row)) {
                continue;
            }
            let extension = |seen: &Seen| seen.extensions.get(i).copied().unwrap_or(0.0);
            let deformation = extension(&self.before).max(extension(now)) + way;
            let rate = if span > 0.0 { way / span } else { 0.0 };
            work += (reach.stiffness * deformation + reach.damping * rate) * way;
        }
        work
    }
}

impl Reach {
    fn of(model: &SceneModel<F64>, group: &Group) -> Self {
        let points = usize::from(group.point)..usize::from(group.point) + group.points();
        let (ones, others) = model.points[points].split_at(usize::from(group.triples));
        let furthest =
            |points: &[Vec3<f64>]| points.iter().copied().map(length).fold(0.0, f64::max);
        let rows = usize::from(group.element)..usize::from(group.element) + group.elements();
        let stiffness = match group.law {
            Law::Tsda => model.tsdas[rows].iter().map(|tsda| tsda.stiffness).sum(),
            Law::PointOnLine => model.lines[rows].iter().map(|line| line.stiffness).sum(),
            Law::PointBushing => model.bushings[rows].iter().map(|on| on.stiffness).sum(),
            Law::Revolute => {
                let stiffest = |on: &Revolute<f64>| {
                    on.stiffness * (1.0 + on.along.max(0.0) * on.levers[0].dot(on.levers[0]))
                };
                model.revolutes[rows].iter().map(stiffest).sum()
            }
            Law::Universal => model.universals[rows].iter().map(|on| on.stiffness).sum(),
        };
        let dampers = group.damper.row().map(|row| row..row + group.elements());
        let dampers = dampers.and_then(|rows| model.dampers.get(rows)).unwrap_or_default();
        Self {
            bodies: [body(group.a), body(group.b)],
            arms: [furthest(ones), furthest(others)],
            free_length: free_length(model, group),
            stiffness,
            damping: dampers.iter().sum(),
        }
    }

    /// \[m\] the largest number that its extension is computed from.
    fn size(&self, distances: &[f64]) -> f64 {
        let far = |row: Option<usize>| row.and_then(|row| distances.get(row)).copied();
        let ends = self.bodies.into_iter().zip(self.arms);
        let size: f64 = ends.map(|(row, arm)| far(row).unwrap_or(0.0) + arm).sum();
        size + self.free_length
    }
}

impl Seen {
    fn of(model: &SceneModel<F64>, state: &States, time: f64) -> Self {
        if model.loads.is_empty() && model.inputs.is_empty() {
            return Self { time, ..Self::default() };
        }
        let speeds = state.bodies.iter();
        let speeds = speeds.map(|body| [length(body.velocity), length(body.angular_velocity)]);
        let signals = state.signals.iter().map(|signal| [signal.value, signal.rate]).collect();
        let mut extensions = Vec::new();
        if model.inputs.iter().any(|input| matches!(input.kind, InputKind::Anchor { .. })) {
            extensions.resize(model.groups.len(), 0.0_f64);
            each_extension(model, state, |group, extension| {
                extensions[group] = extensions[group].max(extension.abs());
            });
        }
        Self { time, speeds: speeds.collect(), signals, extensions }
    }
}

/// \[m\] the largest free length of a group's elements.
pub(crate) fn free_length(model: &SceneModel<F64>, group: &Group) -> f64 {
    let first = usize::from(group.element);
    let rows = first..first + group.elements();
    match group.law {
        Law::Tsda => model.tsdas[rows].iter().map(|tsda| tsda.free_length).fold(0.0, f64::max),
        Law::PointOnLine => model.lines[rows].iter().map(|on| on.free_length).fold(0.0, f64::max),
        Law::PointBushing | Law::Revolute | Law::Universal => 0.0,
    }
}

/// The row of a body that moves.
fn body(index: BodyIndex) -> Option<usize> {
    (!index.is_world()).then(|| index.row())
}

fn length(v: Vec3<f64>) -> f64 {
    v.dot(v).sqrt()
}

#[cfg(test)]
mod tests {
    use dbd_kernel::energy::energy;
    use dbd_scene::Scene;

    use super::*;

    fn scene(elements: &str) -> Scene {
        let text = format!(
            "name = \"s\"\nduration = 1\n[[body]]\nname = \"b\"\nmass = 1\ninertia = [1, 1, 1]\n\
             position = [0, 0, 0]\n{elements}"
        );
        Scene::parse(&text, "s.toml").unwrap_or_else(|error| panic!("{error:?}"))
    }

    fn budget(scene: &Scene) -> Budget {
        let start = State::initial(&scene.model);
        Budget::new(&scene.model, &start, &energy(&scene.model, &start, 1e-3), f64::EPSILON)
    }

    #[test]
    fn released_energy_is_no_growth_and_energy_from_nowhere_is() {
        let scene = scene("");
        let start = State::initial(&scene.model);
        let mut budget = Budget { held: 1.0, initial: [10.0, 10.0], ..budget(&scene) };
        let mut beyond = |kinetic, gravity| {
            let energy = Energy { kinetic, gravity, ..Energy::default() };
            budget.beyond(&scene.model, &start, &energy, 0.0)
        };
        assert_eq!(beyond(1000.0, -990.0), None);
        // Released energy may return, and an error of that size is tolerated.
        assert_eq!(beyond(1000.0, 10.0), None);
        assert_eq!(beyond(2e5, 10.0), Some(2e5));
    }

    #[test]
    fn a_stretched_line_is_an_energy_of_the_run() {
        let held = |offset: f64| {
            let line = format!(
                "[[point_on_line]]\nbetween = [\"world\", \"b\"]\nline_point = [1, 0, 0]\n\
                 line_direction = [1, 0, 0]\npoint = [0, {offset}, 0]\nstiffness = 1e4\n\
                 free_length = 0\n"
            );
            budget(&scene(&line)).held
        };
        // At rest the energy of an extension by the fraction of the scene's size; extended by 0.1 m, 50 J more.
        let least = 0.5 * 1e4 * SHARE * SHARE;
        assert!((held(0.0) - least).abs() < 1e-12);
        assert!((held(0.1) - 50.0 - least * 1.1 * 1.1).abs() < 1e-9);
    }
}
