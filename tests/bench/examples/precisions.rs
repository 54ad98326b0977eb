//! What rounding does to the energy of scenes, precision by precision: what `cargo xtask precisions` keeps in
//! `docs/results/precisions.csv`.
//!
//! `precisions [--steps N] [--product P] [SCENE…]`: a table of comma-separated values on standard output; at
//! most N steps, each P over the bound of the highest frequency. A run in a precision stands beside the begin of one in
//! double precision of the very same constants and start, and energies are computed in double precision from what is
//! stored, with the constants of the steps ([`as_stepped`]) and, once more, with the model's own (`model_max_j`). Where
//! dampers act, the energy itself is looked at.

use std::fmt::Write as _;
use std::process::ExitCode;
use std::str::FromStr;
use std::time::Instant;

use dbd_bench::kept::{Energies, Keeper, Kept};
use dbd_bench::stepped::as_stepped;
use dbd_kernel::index::DamperIndex;
use dbd_kernel::{
    BodyIndex, F32, F64, Fixed, Geometry, Leapfrog, Pefrl, Plant, Scheme, SemiImplicitEuler, State,
    Vec3, frequency,
};
use dbd_scene::{Scene, SceneModel, widen};

/// Columns of the table.
const HEADER: &str = "scene,scheme,stiffness,damped,from_origin_m,step_s,steps,precision,own_max_j,own_rms_j,\
                      kept_max_j,kept_rms_j,apart_max_j,apart_rms_j,slope_w,off_m,host_ns,model_max_j";

/// Scenes that are looked at.
const SCENES: [&str; 5] = ["hexagon", "four-bar", "3rrr", "3ruu", "double-wishbone"];
/// \[N/m\] stiffness of the springs of joints.
const STIFFNESSES: [f64; 3] = [1e5, 9e6, 5e8];
/// \[m\] how far from the origin a scene stands, along each axis with its sign.
const PLACES: [f64; 2] = [0.0, 10.0];
/// ω·h of the highest frequency's bound: 20 µs of the hexagon at 9 MN/m.
const PRODUCT: f64 = 0.12;
/// Steps of a run.
const STEPS: u64 = 1_000_000;
/// Of the hexagon's with semi-implicit Euler.
const LONG: u64 = 10_000_000;
/// Of a damped one, and at most of the one in double precision beside another.
const SHORT: u64 = 20_000;
/// Steps between samples.
const EACH: u64 = 1_000;
/// \[s\] when positions are compared.
const COMPARED: f64 = 1.0;
/// \[N·s/m\] at 5e8 N/m: some per cent of critical damping; with the root of the stiffness elsewhere.
const DAMPING: f64 = 2000.0;

fn main() -> ExitCode {
    match run(&std::env::args().skip(1).collect::<Vec<_>>()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("error: {why}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: &[String]) -> Result<(), String> {
    let mut names = arguments.to_vec();
    let longest = option(&mut names, "--steps", LONG)?;
    if longest < SHORT {
        return Err(format!("--steps takes a number of at least {SHORT}"));
    }
    let product = option(&mut names, "--product", PRODUCT)?;
    if !(0.0..1.0).contains(&product) || product == 0.0 {
        return Err("--product takes a number between 0 and 1".into());
    }
    if let Some(name) = names.iter().find(|name| !SCENES.contains(&name.as_str())) {
        return Err(format!("there is no scene {name:?} here, only {}", SCENES.join(", ")));
    }
    println!("{HEADER}");
    for scene in SCENES {
        if !names.is_empty() && !names.iter().any(|name| name == scene) {
            continue;
        }
        for stiffness in STIFFNESSES {
            for damped in [false, true] {
                for from_origin in PLACES {
                    let case = Case::new(scene, stiffness, damped, from_origin, product)?;
                    let most = if damped { SHORT } else { longest.min(STEPS) };
                    case.compare(Leapfrog, Kept::KickDriftKick, most)?;
                    if damped || from_origin > 0.0 {
                        continue;
                    }
                    if scene == "hexagon" {
                        case.compare(SemiImplicitEuler, Kept::KickDrift, longest)?;
                    }
                    if stiffness == STIFFNESSES[1] {
                        case.compare(Pefrl, Kept::Energy, most)?;
                    }
                }
            }
        }
    }
    Ok(())
}

/// The value of an option, taken out of the words.
fn option<T: FromStr>(words: &mut Vec<String>, name: &str, default: T) -> Result<T, String> {
    let Some(at) = words.iter().position(|word| word == name) else { return Ok(default) };
    let given = words.get(at + 1).and_then(|word| word.parse().ok());
    words.drain(at..(at + 2).min(words.len()));
    given.ok_or_else(|| format!("{name} takes a number"))
}

/// A scene with its joints' springs and dampers, at a place.
struct Case {
    scene: &'static str,
    stiffness: f64,
    damped: bool,
    from_origin: f64,
    model: SceneModel<F64>,
    /// \[s\].
    step: f64,
}

impl Case {
    fn new(
        scene: &'static str,
        stiffness: f64,
        damped: bool,
        from_origin: f64,
        product: f64,
    ) -> Result<Self, String> {
        let file = format!("scenes/{scene}.toml");
        let text = std::fs::read_to_string(&file).map_err(|why| format!("{file}: {why}"))?;
        let changes = [format!("joint.*.stiffness={stiffness:e}")];
        let mut scene_of =
            Scene::parse_with(&text, &file, &changes).map_err(|why| format!("{why:?}"))?;
        // Tables would do work.
        scene_of.release_all();
        let mut model = scene_of.model;
        for group in &mut model.groups {
            if !damped {
                group.damper = DamperIndex::NONE;
            }
        }
        if !damped {
            model.dampers.clear();
        }
        let damping = DAMPING * (stiffness / 5e8).sqrt();
        if damped {
            model.dampers = vec![damping; model.tsda_count()];
            let mut row = 0;
            for group in &mut model.groups {
                group.damper = DamperIndex(row as u16);
                row += group.elements();
            }
        }
        moved(&mut model, [from_origin, -from_origin, from_origin]);
        let bound = frequency::bound(&model, &State::initial(&model));
        Ok(Self { scene, stiffness, damped, from_origin, model, step: rounded(product / bound) })
    }

    /// The rows of all precisions for a scheme.
    fn compare<S: Scheme + Copy>(&self, scheme: S, kept: Kept, steps: u64) -> Result<(), String> {
        self.row::<F64, S>(scheme, kept, steps)?;
        self.row::<F32, S>(scheme, kept, steps)?;
        self.row::<Fixed, S>(scheme, kept, steps)
    }

    fn row<P: Geometry, S: Scheme + Copy>(
        &self,
        scheme: S,
        kept: Kept,
        steps: u64,
    ) -> Result<(), String> {
        let kept = if self.damped { Kept::Energy } else { kept };
        let name = format!("{} {} {}", self.scene, S::NAME, P::NAME);
        let of = |why: &dyn std::fmt::Debug| format!("{name}: {why:?}");
        let model: SceneModel<P> = self.model.convert();
        let (exact, models) = (as_stepped(&model, self.step), model.convert());
        let run = Run { scheme, step: self.step, steps, kept, exact: &exact, models: &models };
        let own = run.of(&model).map_err(|why| of(&why))?;
        let beside = Run { steps: steps.min(SHORT.max(run.compared_at())), ..run };
        let double = if P::NAME == F64::NAME { None } else { Some(beside.of(&exact)) };
        let double = double.transpose().map_err(|why| of(&why))?;
        let beside = double.as_ref().unwrap_or(&own);
        let start = own.energies[0];
        let from_start = |get: fn(&Energies) -> f64| {
            spread(own.energies.iter().map(|now| get(now) - get(&start)))
        };
        let [own_max, own_rms] = from_start(|energies| energies.own);
        let [kept_max, kept_rms] = from_start(|energies| energies.kept);
        let pairs = own.energies.iter().zip(&beside.energies);
        let [apart_max, apart_rms] = spread(pairs.map(|(a, b)| a.kept - b.kept));
        let off = distance(&own.compared, &beside.compared);
        let mut text = String::new();
        let _ = write!(
            text,
            "{},{},{:e},{},{},{:.1e},{steps},{}",
            self.scene,
            S::NAME,
            self.stiffness,
            self.damped,
            self.from_origin,
            self.step,
            P::NAME
        );
        for value in [own_max, own_rms, kept_max, kept_rms, apart_max, apart_rms, own.slope(), off]
        {
            let _ = write!(text, ",{value:.2e}");
        }
        let nanoseconds = own.seconds * 1e9 / steps as f64;
        let [by_model, _] = spread(own.by_model.iter().map(|now| now - own.by_model[0]));
        println!("{text},{nanoseconds:.0},{by_model:.2e}");
        Ok(())
    }
}

/// One run.
#[derive(Clone, Copy)]
struct Run<'m, S> {
    scheme: S,
    step: f64,
    steps: u64,
    kept: Kept,
    /// With the constants of the steps.
    exact: &'m SceneModel<F64>,
    /// With the model's own.
    models: &'m SceneModel<F64>,
}

/// What came of a run.
struct Outcome {
    /// \[s\] between samples.
    interval: f64,
    energies: Vec<Energies>,
    /// \[J\] the first of them with the model's own constants.
    by_model: Vec<f64>,
    /// At [`COMPARED`], or at the end of a shorter run.
    compared: State<SceneModel<F64>>,
    /// \[s\] of stepping.
    seconds: f64,
}

impl<S: Scheme + Copy> Run<'_, S> {
    /// After how many steps positions are compared.
    fn compared_at(&self) -> u64 {
        (COMPARED / self.step).round() as u64
    }

    fn of<P: Geometry>(&self, model: &SceneModel<P>) -> Result<Outcome, String> {
        let keeper = |model| Keeper::new(model, self.kept, self.step);
        let mut keeper_of_steps = keeper(self.exact).map_err(|why| format!("{why:?}"))?;
        let mut keeper_of_model = keeper(self.models).map_err(|why| format!("{why:?}"))?;
        let mut plant =
            Plant::new(model, self.scheme, self.step).map_err(|why| format!("{why:?}"))?;
        let (each, at) = (EACH, self.compared_at().min(self.steps));
        let (mut energies, mut by_model) = (Vec::new(), Vec::new());
        let (mut compared, mut seconds) = (None, 0.0);
        loop {
            let done = plant.state().step;
            if done == at && compared.is_none() {
                compared = Some(widen(plant.state()));
            }
            if done % each == 0 {
                let state = widen(plant.state());
                let none = || format!("no energy at step {done}");
                energies.push(keeper_of_steps.energies(&state).ok_or_else(none)?);
                by_model.push(keeper_of_model.energies(&state).ok_or_else(none)?.own);
            }
            if done >= self.steps {
                break;
            }
            let next = (done / each + 1) * each;
            let next = if done < at { next.min(at) } else { next };
            let start = Instant::now();
            let status = plant.advance(next - done);
            seconds += start.elapsed().as_secs_f64();
            status.map_err(|failure| format!("{failure:?}"))?;
        }
        let compared = compared.ok_or("nothing to compare")?;
        Ok(Outcome { interval: each as f64 * self.step, energies, by_model, compared, seconds })
    }
}

impl Outcome {
    /// \[W\] the slope of the line through the energies that the scheme keeps, by least squares.
    fn slope(&self) -> f64 {
        let middle = (self.energies.len() - 1) as f64 / 2.0;
        let (mut above, mut below) = (0.0, 0.0);
        for (row, energies) in self.energies.iter().enumerate() {
            let x = row as f64 - middle;
            above += x * (energies.kept - self.energies[0].kept);
            below += x * x;
        }
        above / below / self.interval
    }
}

/// The largest and the root of the mean square.
fn spread(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let (mut most, mut sum, mut count) = (0.0_f64, 0.0, 0);
    for value in values {
        most = most.max(value.abs());
        sum += value * value;
        count += 1;
    }
    [most, (sum / f64::from(count)).sqrt()]
}

/// \[m\] the root of the mean square of the bodies' distances.
fn distance(a: &State<SceneModel<F64>>, b: &State<SceneModel<F64>>) -> f64 {
    let pairs = a.bodies.iter().zip(&b.bodies);
    let squares = pairs.map(|(a, b)| (a.position - b.position).dot(a.position - b.position).sqrt());
    spread(squares)[1]
}

/// To two digits, and to single precision: in every precision it is the same step.
fn rounded(value: f64) -> f64 {
    f64::from(format!("{value:.1e}").parse().unwrap_or(value as f32))
}

/// Moves a whole model: its bodies, and the points of the ground.
fn moved(model: &mut SceneModel<F64>, by: [f64; 3]) {
    let by = Vec3::from_f64(by);
    for body in &mut model.initial {
        body.position = body.position + by;
    }
    for group in &model.groups {
        let first = usize::from(group.point);
        let middle = first + usize::from(group.triples);
        let end = first + group.points();
        // Anchors are ends of the ground, too.
        let ground = |end: BodyIndex| usize::from(end.0) >= model.bodies.len();
        for (is_ground, rows) in [(ground(group.a), first..middle), (ground(group.b), middle..end)]
        {
            if is_ground {
                for point in &mut model.points[rows] {
                    *point = *point + by;
                }
            }
        }
    }
}
