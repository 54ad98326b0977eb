//! What happens at the extremes of mechanics, and what is promised there: the section "Mechanics" of
//! docs/extremes.md.

mod loops;
mod oscillators;
mod points;
mod sizes;

use dbd_kernel::{BodyState, F64, State};
use dbd_plant::monitor::Monitor;
use dbd_plant::{DampingName, Method, PrecisionName, SchemeName, plant};
use dbd_scene::{Scene, SceneModel};
use dbd_tests::page::{block, table};

type States = State<SceneModel<F64>>;

/// What came of a run, as the command line would say it.
#[derive(Clone, Copy, Debug, PartialEq)]
enum End {
    /// It went on to its end, status ok: the largest of what was measured.
    Right(f64),
    /// It went on to its end, and was warned of: a joint opened by more than a quarter.
    Opened(f64),
    /// Energy came from nowhere: exit 1.
    Diverged,
    /// The plant failed at a step, a number being infinite: exit 1.
    Failed,
}

impl End {
    /// Whether it is right to `bound`, without a warning.
    fn is_within(self, bound: f64) -> bool {
        matches!(self, End::Right(error) if error <= bound)
    }

    /// Whether exit 1 said that it is not right.
    fn is_reported(self) -> bool {
        matches!(self, End::Diverged | End::Failed)
    }

    /// Whether it is right to `bound`, warned of or not.
    fn is_loosely_within(self, bound: f64) -> bool {
        matches!(self, End::Right(error) | End::Opened(error) if error <= bound)
    }

    fn text(self) -> String {
        match self {
            // One digit: the next ones say nothing.
            End::Right(error) if error.abs() == 0.0 => "0".into(),
            End::Right(error) => format!("{error:.0e}"),
            End::Opened(error) => format!("{error:.0e}, opened"),
            End::Diverged => "diverged".into(),
            End::Failed => "failed".into(),
        }
    }
}

/// A scheme's column.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Way {
    Leapfrog,
    LeapfrogExplicit,
    Pefrl,
    Rk4,
    Dbd,
}

/// Where nothing is damped, both ways of damping are one.
const UNDAMPED: [Way; 4] = [Way::Leapfrog, Way::Pefrl, Way::Rk4, Way::Dbd];
const DAMPED: [Way; 5] = [Way::Leapfrog, Way::LeapfrogExplicit, Way::Pefrl, Way::Rk4, Way::Dbd];
const PRECISIONS: [PrecisionName; 2] = [PrecisionName::F64, PrecisionName::F32];

impl Way {
    fn method(self, precision: PrecisionName) -> Method {
        let scheme = match self {
            Way::Leapfrog | Way::LeapfrogExplicit => SchemeName::Leapfrog,
            Way::Pefrl => SchemeName::Pefrl,
            Way::Rk4 => SchemeName::Rk4,
            Way::Dbd => SchemeName::Dbd,
        };
        let method = Method::new(scheme, None, precision).unwrap();
        match self {
            Way::LeapfrogExplicit => method.with_damping(DampingName::Explicit).unwrap(),
            _ => method,
        }
    }

    fn title(self) -> String {
        match self {
            Way::LeapfrogExplicit => "leapfrog, explicit".into(),
            _ => self.method(PrecisionName::F64).scheme_name().into(),
        }
    }

    /// The error of an undamped vibration over its amplitude after `phase` \[rad\] in steps of `z`
    /// \[rad\], from above.
    fn error(self, z: f64, phase: f64) -> f64 {
        match self {
            Way::Leapfrog | Way::LeapfrogExplicit => z * z * (phase / 24.0 + 0.25),
            Way::Pefrl => 1e-3 * z.powi(4) * (phase + 1.0) + 1e-12,
            Way::Rk4 => z.powi(4) * (phase / 120.0 + 1.0) + 1e-12,
            Way::Dbd => z * (0.6 + 0.05 * z * phase),
        }
    }
}

/// Steps a scene as the command line does, judging `samples` of its states. As long as the status is
/// "running" all numbers of a state are finite; what is measured of them must be, too.
fn follow(
    scene: &Scene,
    method: &Method,
    step: f64,
    steps: u64,
    samples: u64,
    mut measure: impl FnMut(f64, &States) -> f64,
) -> End {
    let mut plant = plant(scene, method, step).unwrap();
    let mut monitor = Monitor::new(scene, plant.as_ref());
    let mut worst = 0.0_f64;
    for _ in 0..samples {
        let status = plant.advance(steps / samples);
        if status.is_err() {
            let steps = plant.steps();
            assert_eq!((plant.step(), plant.steps()), (status, steps), "a failure latches");
            return End::Failed;
        }
        let state = plant.state();
        assert!(state.bodies.iter().all(is_finite), "{method:?} {step}: {:?}", state.bodies);
        if monitor.check(&state).is_err() {
            return End::Diverged;
        }
        let measured = measure(plant.time(), &state);
        assert!(measured.is_finite(), "{method:?} {step}: {measured}");
        worst = worst.max(measured);
    }
    match monitor.openings().iter().any(|opening| opening.since.is_some()) {
        true => End::Opened(worst),
        false => End::Right(worst),
    }
}

fn is_finite(body: &BodyState<F64>) -> bool {
    let quaternion = [body.orientation.w];
    let vectors = [body.position, body.velocity, body.angular_velocity, body.orientation.v];
    let vectors = vectors.map(|vector| vector.to_f64());
    vectors.as_flattened().iter().chain(&quaternion).all(|number| number.is_finite())
}

fn single(method: &Method) -> bool {
    method.precision() == PrecisionName::F32
}

/// A body at rest on the x axis, of the inertia of a ball of 0.16 m.
fn body(name: &str, mass: f64, x: f64) -> String {
    let inertia = 0.01 * mass;
    format!(
        "[[body]]\nname = \"{name}\"\nmass = {mass:?}\ninertia = [{inertia:?}, {inertia:?}, \
         {inertia:?}]\nposition = [{x:?}, 0, 0]\n"
    )
}

/// A raw element between the centres of mass of two bodies, or of one and the origin.
fn spring(between: [&str; 2], stiffness: f64, damping: f64, free_length: f64) -> String {
    format!(
        "[[tsda]]\nbetween = {between:?}\npoints = [[0, 0, 0], [0, 0, 0]]\n\
         stiffness = {stiffness:?}\ndamping = {damping:?}\nfree_length = {free_length:?}\n"
    )
}

fn scene_of(parts: &[String]) -> Scene {
    let text = format!("name = \"extreme\"\nduration = 1\n{}", parts.concat());
    Scene::parse(&text, "extreme.toml").unwrap_or_else(|why| panic!("{why}\n{text}"))
}

/// Writes a table whose rows hold a title and what came of each way, f64 and f32.
struct Rows {
    head: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Rows {
    fn new(titles: &[&str], ways: &[Way]) -> Self {
        let titles = titles.iter().map(|title| (*title).to_owned());
        let head = titles.chain(ways.iter().map(|way| way.title())).collect();
        Self { head, rows: Vec::new() }
    }

    fn push(&mut self, titles: Vec<String>, ends: &[[End; 2]]) {
        let cells = ends.iter().map(|[double, single]| {
            let [double, single] = [double, single].map(|end| end.text());
            if double == single { double } else { format!("{double} / {single}") }
        });
        self.rows.push(titles.into_iter().chain(cells).collect());
    }

    fn write(&self, name: &str) {
        let head: Vec<&str> = self.head.iter().map(String::as_str).collect();
        block("docs/extremes.md", name, &table(&head, &self.rows));
    }
}

/// What comes of each way in both precisions.
fn each(ways: &[Way], mut run: impl FnMut(Way, &Method) -> End) -> Vec<[End; 2]> {
    let both = |way: &Way| PRECISIONS.map(|precision| run(*way, &way.method(precision)));
    ways.iter().map(both).collect()
}
