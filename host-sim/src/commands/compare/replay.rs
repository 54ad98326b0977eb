//! A recorded run, replayed for its page.
//!
//! `scene, rows => film, curves`; without a scene the curves of what was recorded alone. Where a table drives an
//! input, its value follows from the time; forces follow from poses and velocities.

use dbd_kernel::{BodyState, Energy, F64, State};
use dbd_plant::monitor::Monitor;
use dbd_plant::plan::Plan;
use dbd_plant::{
    AnyPlant, DampingName, Method, Named as _, OrientationName, PlantError, PrecisionName,
    SchemeName, plant,
};
use dbd_report::data::{Run, Section};
#[cfg(feature = "mcap")]
use dbd_report::mcap::Log;
use dbd_report::{Recording, Sample};
use dbd_scene::{Scene, SceneModel};

use crate::commands::compare::charts::ChartList;
use crate::comparison::run::End;
use crate::recorded::{Head, Recorded, Row, Unreadable};

/// The run of a scene, or why it cannot be shown.
///
/// # Errors
/// Where its rows cannot be read again.
pub fn of_scene(
    scene: &Scene,
    mut run: Recorded,
    end: End,
) -> Result<Result<Run, String>, Unreadable> {
    let (method, plan) = (method(&run.head).unwrap_or_default(), plan(&run.head, end));
    let columns = Columns::of(scene, &run.head);
    let (mut recording, plant) = match begun(scene, &method, &plan, &columns.others) {
        Ok(begun) => begun,
        Err(why) => return Ok(Err(why.to_string())),
    };
    replay(scene, plant, &columns, &mut run, |sample| recording.push(sample))?;
    Ok(Ok(recording.finish().run))
}

/// The samples of a scene's run as an MCAP file, or the reason why it cannot be written.
///
/// # Errors
/// As [`of_scene`].
#[cfg(feature = "mcap")]
pub fn log_of_scene(
    scene: &Scene,
    mut run: Recorded,
    end: End,
) -> Result<Result<Vec<u8>, String>, Unreadable> {
    let (method, plan) = (method(&run.head).unwrap_or_default(), plan(&run.head, end));
    let columns = Columns::of(scene, &run.head);
    let plant = match plant(scene, &method, plan.step) {
        Ok(plant) => plant,
        Err(why) => return Ok(Err(why.to_string())),
    };
    let mut bytes = Vec::new();
    let mut written = Log::new(std::io::Cursor::new(&mut bytes), scene, &columns.others);
    replay(scene, plant, &columns, &mut run, |sample| {
        if let Ok(log) = &mut written
            && let Err(error) = log.push(sample)
        {
            written = Err(error);
        }
    })?;
    let written = written.and_then(Log::finish);
    Ok(written.map(|()| bytes).map_err(|error| error.to_string()))
}

/// Shows the samples of a run in order.
fn replay(
    scene: &Scene,
    mut plant: Box<dyn AnyPlant>,
    columns: &Columns,
    run: &mut Recorded,
    mut show: impl FnMut(&Sample<'_>),
) -> Result<(), Unreadable> {
    let mut monitor = Monitor::new(scene, plant.as_ref());
    let initial = plant.state();
    let (mut readings, mut others) = (Vec::new(), Vec::new());
    while let Some(row) = run.next_row()? {
        let state = state_of(&initial, row);
        // A plant in this state evaluates its tables at this time.
        let state = match plant.set_state(&state) {
            Ok(()) => plant.state(),
            Err(_) => state,
        };
        let state = columns.with_inputs(state, row);
        let judged = monitor.check(&state);
        let energy = match (row.energies, judged) {
            (Some([kinetic, potential, _]), _) => {
                Energy { kinetic, gravity: potential, ..Energy::default() }
            }
            (None, Ok(verdict)) => verdict.energy,
            (None, Err(_)) => Energy::default(),
        };
        columns.fill(row, &mut readings, &mut others);
        show(&Sample {
            time: row.time,
            state: &state,
            readings: &readings,
            energy,
            extensions: monitor.extensions(),
            others: &others,
        });
    }
    Ok(())
}

fn begun(
    scene: &Scene,
    method: &Method,
    plan: &Plan,
    others: &[(String, String)],
) -> Result<(Recording, Box<dyn AnyPlant>), PlantError> {
    Ok((Recording::with_others(scene, method, plan, others)?, plant(scene, method, plan.step)?))
}

/// Which of a run's recorded values are sensors, inputs and other numbers, by name.
struct Columns {
    /// One per column of the scene's sensors.
    readings: Vec<Option<usize>>,
    /// One per input.
    inputs: Vec<Option<usize>>,
    /// The other values, with their rows.
    others: Vec<(String, String)>,
    rows: Vec<usize>,
}

impl Columns {
    fn of(scene: &Scene, head: &Head) -> Self {
        let row_of = |name: &str| head.values.iter().position(|value| value.name == name);
        let sensors = scene.readouts.iter().flat_map(|readout| {
            readout.columns.iter().map(move |(suffix, _)| format!("{}{suffix}", readout.name))
        });
        let readings: Vec<_> = sensors.map(|name| row_of(&name)).collect();
        let inputs: Vec<_> = scene.inputs.iter().map(|input| row_of(&input.name)).collect();
        let known = |row: &usize| readings.contains(&Some(*row)) || inputs.contains(&Some(*row));
        let rows: Vec<usize> = (0..head.values.len()).filter(|row| !known(row)).collect();
        let others = rows.iter().map(|row| {
            let value = &head.values[*row];
            (value.name.clone(), value.unit.clone().unwrap_or_default())
        });
        Self { others: others.collect(), readings, inputs, rows }
    }

    /// The state with the inputs' recorded values.
    fn with_inputs(&self, mut state: State<SceneModel<F64>>, row: &Row) -> State<SceneModel<F64>> {
        for (signal, place) in state.signals.iter_mut().zip(&self.inputs) {
            if let Some(value) = place.and_then(|place| row.values.get(place)) {
                signal.value = *value;
            }
        }
        state
    }

    fn fill(&self, row: &Row, readings: &mut Vec<f64>, others: &mut Vec<f64>) {
        let value = |place: usize| row.values.get(place).copied().unwrap_or(f64::NAN);
        readings.clear();
        readings.extend(self.readings.iter().map(|place| place.map_or(f64::NAN, value)));
        others.clear();
        others.extend(self.rows.iter().map(|place| value(*place)));
    }
}

/// The method of a run; `None` if this program does not include it.
fn method(head: &Head) -> Option<Method> {
    let scheme = SchemeName::of_name(&head.scheme)?;
    let precision = PrecisionName::of_name(&head.precision)?;
    let method = Method::new(scheme, head.newton, precision).ok()?;
    let method = match head.rho {
        Some(rho) => method.with_rho(rho).ok()?,
        None => method,
    };
    let method = match &head.damping {
        Some(damping) => method.with_damping(DampingName::of_name(damping)?).ok()?,
        None => method,
    };
    let method = method.with_orientation(OrientationName::of_name(&head.orientation)?);
    method.check_built().ok().map(|()| method)
}

/// A plan with the given number of samples.
fn plan(head: &Head, end: End) -> Plan {
    let steps = |time: f64| (time / head.step).round() as u64;
    let stride = steps(end.every.unwrap_or(head.step)).max(1);
    Plan { step: head.step, duration: end.until, steps: steps(end.until - end.from).max(1), stride }
}

fn state_of(initial: &State<SceneModel<F64>>, row: &Row) -> State<SceneModel<F64>> {
    let mut state = initial.clone();
    for (body, numbers) in state.bodies.iter_mut().zip(&row.bodies) {
        let [x, y, z, qw, qx, qy, qz, vx, vy, vz, wx, wy, wz] = *numbers;
        *body = BodyState::from_f64([x, y, z], [qw, qx, qy, qz], [vx, vy, vz], [wx, wy, wz]);
    }
    if let Some(turns) = row.turns.as_ref().filter(|turns| turns.len() == state.turns.len()) {
        state.turns.clone_from(turns);
    }
    state.step = row.step;
    state
}

/// The curves of a run without a known scene.
///
/// # Errors
/// Where its rows cannot be read again.
pub fn of_rows(mut run: Recorded, end: End) -> Result<Run, Unreadable> {
    let head = run.head.clone();
    let mut list = ChartList::default();
    let energies = head.kind == crate::recorded::Kind::Run;
    if energies {
        list.add(Section::Energy, ["Energy", "energy", "J"], &["kinetic", "potential"]);
        list.add(Section::Energy, ["Change of the total energy", "change", "J"], &[""]).deviation();
    }
    for value in &head.values {
        let unit = value.unit.as_deref().unwrap_or_default();
        list.add(Section::Readouts, [&value.name, "value", unit], &[""]);
    }
    for (body, name) in head.bodies.iter().enumerate() {
        let texts = [&*format!("{name}: position"), "position", "m"];
        list.add(Section::Motion, texts, &["x", "y", "z"]).of_body(body).deviation();
        let texts = [&*format!("{name}: speed"), "speed", "m/s"];
        list.add(Section::Motion, texts, &[""]).of_body(body);
        let texts = [&*format!("{name}: rate"), "rate", "rad/s"];
        list.add(Section::Motion, texts, &[""]).of_body(body);
    }
    let mut curves = list.curves(end.samples);
    let mut values = Vec::new();
    let length = |of: &[f64]| of.iter().map(|c| c * c).sum::<f64>().sqrt();
    while let Some(row) = run.next_row()? {
        values.clear();
        values.extend(row.energies.iter().flatten());
        values.extend(&row.values);
        for body in &row.bodies {
            values.extend(&body[..3]);
            values.extend([length(&body[7..10]), length(&body[10..])]);
        }
        curves.push(row.time, &values);
    }
    let drawn = list.finish(curves);
    Ok(Run {
        label: String::new(),
        mechanism: None,
        film: None,
        times: drawn.times,
        thinned: drawn.thinned,
        bodies_left_out: drawn.bodies_left_out,
        joints_left_out: 0,
        charts: drawn.charts,
    })
}
