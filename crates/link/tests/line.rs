//! Two ends over a line that does everything a line can do to frames.

use std::io::Write as _;
use std::time::Duration;

use dbd_link::controller_end::ControllerEnd;
use dbd_link::device::Device;
use dbd_link::frame::Frame;
use dbd_link::host::follower::Followed;
use dbd_link::host::{
    Address, Connection, Controller, Disturbance, DriveError, DriveOptions, Follower, HostPlant,
    Report, ServeOptions, Served, drive, serve,
};
use dbd_link::message::{
    Chunk, Header, Hello, Inputs, Message, Mismatch, Mode, Outputs, Policy, Refusal, Settings,
    Values,
};
use dbd_link::plant_end::PlantEnd;
use dbd_plant::{Method, PrecisionName, SchemeName};
use dbd_scene::Scene;

const STEP: f64 = 1e-3;

/// A cart on a spring with a pendulum that turns fast: cheap, and no state comes twice.
const SCENE: &str = r#"
name = "line"
gravity = [0.0, -9.81, 0.0]
duration = 1.0

[[body]]
name = "cart"
mass = 1.0
inertia = [0.01, 0.01, 0.01]
position = [0.0, 0.0, 0.0]
angular_velocity = [0.3, 0.2, 1.0]

[[tsda]]
between = ["world", "cart"]
points = [[-1.0, 0.1, 0.0], [0.0, 0.05, 0.02]]
stiffness = 200.0
free_length = 0.9
damping = 1.0

[[input]]
name = "push"
type = "force"
body = "cart"
axis = [1, 0, 0]

[[input]]
name = "lift"
type = "force"
body = "cart"
axis = [0, 1, 0]

[[readout]]
name = "place"
type = "point"
body = "cart"
"#;

fn plant_of(text: &str, precision: PrecisionName, step: f64) -> HostPlant {
    let scene = Scene::parse(text, "line.toml").unwrap();
    let method = Method::new(SchemeName::Leapfrog, None, precision).unwrap();
    let plant = dbd_plant::plant(&scene, &method, step).unwrap();
    HostPlant::new(&scene, plant).unwrap()
}

fn plant() -> HostPlant {
    plant_of(SCENE, PrecisionName::F32, STEP)
}

/// A plant's end and a controller's end in one thread: what one sends waits for the other.
struct Pair {
    plant: Box<PlantEnd<HostPlant, 4096>>,
    controller: ControllerEnd,
    to_plant: Vec<u8>,
    to_controller: Vec<u8>,
}

impl Pair {
    fn new() -> Self {
        let plant = Box::new(PlantEnd::new(plant(), 1_000).unwrap());
        let controller = ControllerEnd::new(7);
        Self { plant, controller, to_plant: Vec::new(), to_controller: Vec::new() }
    }

    fn open(settings: Settings) -> Self {
        let mut pair = Self::new();
        let answers = pair.hello(settings);
        assert!(matches!(answers[..], [Message::Welcome(_)]), "{answers:?}");
        pair
    }

    fn hello(&mut self, settings: Settings) -> Vec<Message> {
        let identity = self.plant.identity().clone();
        self.ask(&Message::Hello(Hello { identity, settings }))
    }

    /// Sends a message; what the plant answers.
    fn ask(&mut self, message: &Message) -> Vec<Message> {
        let mut sent = Vec::new();
        self.controller.send(message, &mut |frame: &[u8]| sent.extend_from_slice(frame));
        self.raw(&sent)
    }

    fn raw(&mut self, bytes: &[u8]) -> Vec<Message> {
        self.to_plant.extend_from_slice(bytes);
        let line = &mut self.to_controller;
        for byte in self.to_plant.drain(..) {
            self.plant.receive(byte, &mut |frame: &[u8]| line.extend_from_slice(frame));
        }
        self.answers()
    }

    fn tick(&mut self) -> Vec<Message> {
        let line = &mut self.to_controller;
        self.plant.tick(0, &mut |frame: &[u8]| line.extend_from_slice(frame));
        self.answers()
    }

    fn answers(&mut self) -> Vec<Message> {
        let bytes: Vec<u8> = self.to_controller.drain(..).collect();
        bytes.into_iter().filter_map(|byte| self.controller.receive(byte)).collect()
    }

    fn step(&self) -> u64 {
        self.plant.device().step()
    }
}

fn inputs(step: u64, values: &[f64]) -> Message {
    Message::Inputs(Inputs { step, values: values.iter().copied().collect() })
}

fn outputs(answers: Vec<Message>) -> Outputs {
    match answers.into_iter().next_back() {
        Some(Message::Outputs(outputs)) => outputs,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_frame_steps_once_and_a_repeated_question_is_answered_again() {
    let mut pair = Pair::open(Settings { steps: 3, ..Settings::default() });
    let first = outputs(pair.ask(&inputs(0, &[1.0, 0.0])));
    assert_eq!((first.step, pair.step()), (3, 3));
    // The answer was lost: asked again, other inputs change nothing any more.
    let again = outputs(pair.ask(&inputs(0, &[9.0, 9.0])));
    assert_eq!((again.hash, pair.step()), (first.hash, 3));
    // Of another step.
    for step in [1, 2, 4, 6, u64::MAX] {
        assert_eq!(pair.ask(&inputs(step, &[0.0; 2])), [Message::Refused(Refusal::Step(3))]);
    }
    assert_eq!(pair.step(), 3);
    let counted = pair.plant.statistics();
    assert_eq!((counted.repeated, counted.late, counted.refused), (1, 5, 5));
}

#[test]
fn values_that_are_none_change_nothing() {
    let mut pair = Pair::open(Settings::default());
    let first = outputs(pair.ask(&inputs(0, &[2.0, 3.0])));
    for values in [&[1.0][..], &[1.0; 3], &[1.0, f64::NAN], &[1.0, 1e300], &[f64::INFINITY, 0.0]] {
        assert_eq!(pair.ask(&inputs(1, values)), [Message::Refused(Refusal::Values)], "{values:?}");
        assert_eq!([0, 1].map(|i| pair.plant.device().input(i)), [2.0, 3.0], "{values:?}");
    }
    assert_eq!((pair.step(), pair.plant.device().hash()), (1, first.hash));
}

#[test]
fn old_and_foreign_frames_are_counted() {
    let mut pair = Pair::open(Settings::default());
    let frame = |session, sequence, message: &Message| {
        let mut frame = Frame::default();
        frame.encode(Header { session, sequence }, message);
        frame.bytes().to_vec()
    };
    let good = frame(7, 10, &inputs(0, &[0.0; 2]));
    let _ = pair.raw(&good);
    assert_eq!(pair.step(), 1);
    // Twice, older, of another session, of nobody, and what only a plant says.
    for (bytes, answers) in [
        (good, 0),
        (frame(7, 9, &inputs(1, &[0.0; 2])), 0),
        (frame(8, 11, &inputs(1, &[0.0; 2])), 0),
        (frame(0, 11, &inputs(1, &[0.0; 2])), 0),
        (frame(7, 12, &Message::Outputs(Outputs::default())), 0),
    ] {
        assert_eq!(pair.raw(&bytes).len(), answers);
        assert_eq!(pair.step(), 1);
    }
    let counted = *pair.plant.statistics();
    assert_eq!((counted.late, counted.foreign, counted.refused), (2, 2, 1));
    // 2 to 9, and 11.
    assert_eq!(counted.dropped, 9);
    // Of the session alone that is open an answer is accepted.
    assert_eq!(pair.controller.statistics().foreign, 2);
}

#[test]
fn models_that_differ_do_not_talk() {
    let other = |change: fn(String) -> String, precision, step| {
        let mut pair = Pair::new();
        let text = change(SCENE.to_owned());
        let end = Box::new(PlantEnd::<_, 4096>::new(plant_of(&text, precision, step), 0).unwrap());
        let hello = Hello { identity: end.identity().clone(), settings: Settings::default() };
        match pair.ask(&Message::Hello(hello)).pop() {
            Some(Message::Refused(Refusal::Identity(mismatch, own))) => {
                assert_eq!(&own, pair.plant.identity());
                assert!(!pair.plant.is_open());
                Some(mismatch)
            }
            Some(Message::Welcome(_)) => None,
            other => panic!("{other:?}"),
        }
    };
    let (same, f32) = ((|text| text) as fn(String) -> String, PrecisionName::F32);
    assert_eq!(other(same, f32, STEP), None);
    assert_eq!(other(same, PrecisionName::F64, STEP), Some(Mismatch::Precision));
    assert_eq!(other(same, f32, 2e-3), Some(Mismatch::Step));
    assert_eq!(other(|text| text.replace("200.0", "200.001"), f32, STEP), Some(Mismatch::Model));
    let fewer = |text: String| {
        text.replace("name = \"place\"\ntype = \"point\"", "name = \"place\"\ntype = \"imu\"")
    };
    assert_eq!(other(fewer, f32, STEP), Some(Mismatch::Outputs));
    for settings in [
        Settings { steps: 0, ..Settings::default() },
        Settings { timeout: 0, ..Settings::default() },
    ] {
        let answers = Pair::new().hello(settings);
        assert_eq!(answers, [Message::Refused(Refusal::Settings)]);
    }
}

#[test]
fn a_state_is_saved_and_given_back_and_damage_is_refused() {
    let mut pair = Pair::open(Settings::default());
    for step in 0..20 {
        let _ = pair.ask(&inputs(step, &[1.0, 0.5]));
    }
    let (hash, mut state, mut total) = (pair.plant.device().hash(), Vec::new(), 1);
    while state.len() < total {
        match pair.ask(&Message::Save { offset: state.len() as u32 }).pop() {
            Some(Message::Saved(chunk)) => {
                total = chunk.total as usize;
                state.extend_from_slice(&chunk.bytes);
            }
            other => panic!("{other:?}"),
        }
    }
    let far = pair.ask(&Message::Save { offset: total as u32 });
    assert_eq!(far, [Message::Refused(Refusal::State)]);
    let _ = pair.ask(&inputs(20, &[0.0, 0.0]));
    let chunk = |offset: usize, total: usize, bytes: &[u8]| {
        let bytes = bytes.iter().copied().collect();
        Message::Restore(Chunk { total: total as u32, offset: offset as u32, bytes })
    };
    let before = pair.plant.device().hash();
    // Out of order, too long, damaged.
    assert_eq!(pair.ask(&chunk(64, total, &state[64..96])), [Message::Refused(Refusal::State)]);
    assert_eq!(pair.ask(&chunk(0, 9_999, &state[..64])), [Message::Refused(Refusal::State)]);
    let mut damaged = state.clone();
    damaged[total / 2] ^= 1;
    let mut last = Vec::new();
    for (number, bytes) in damaged.chunks(64).enumerate() {
        last = pair.ask(&chunk(64 * number, total, bytes));
    }
    assert_eq!(last, [Message::Refused(Refusal::State)]);
    assert_eq!((pair.step(), pair.plant.device().hash()), (21, before));
    for (number, bytes) in state.chunks(64).enumerate() {
        // A piece that is repeated is accepted again.
        let _ = pair.ask(&chunk(64 * number, total, bytes));
        if number > 0 {
            let answers = pair.ask(&chunk(64 * number, total, bytes));
            assert!(matches!(answers[..], [Message::Restored { .. }]), "{answers:?}");
        }
    }
    assert_eq!((pair.step(), pair.plant.device().hash()), (20, hash));
}

/// 60 s of ticks without a frame, by each policy; then the controller returns and the model follows.
#[test]
fn a_silence_is_borne_by_each_policy() {
    for (policy, steps_in_silence) in
        [(Policy::Hold, 60_000), (Policy::Zero, 60_000), (Policy::Stop, 20)]
    {
        let settings =
            Settings { mode: Mode::RealTime, policy, timeout: 20, ..Settings::default() };
        let mut pair = Pair::open(settings);
        let mut model = Follower::new(plant());
        let values: Values = [0.5, -0.25].into_iter().collect();
        let send = |pair: &mut Pair, model: &mut Follower| {
            let answers = pair.ask(&inputs(pair.step(), &values));
            assert_eq!(answers, []);
            model.note(pair.controller.sequence(), &values);
        };
        for _ in 0..50 {
            send(&mut pair, &mut model);
            assert_eq!(model.follow(&outputs(pair.tick())), Followed::Equal);
        }
        let mut heard = Outputs::default();
        for _ in 0..60_000 {
            heard = outputs(pair.tick());
        }
        assert_eq!(heard.step, 50 + steps_in_silence, "{policy:?}");
        assert_eq!(pair.plant.statistics().timeouts, 1, "{policy:?}");
        let zero = policy == Policy::Zero;
        assert_eq!(pair.plant.device().input(0), if zero { 0.0 } else { 0.5 }, "{policy:?}");
        // It heard the last frame alone, and knows what the plant did.
        assert_eq!(model.follow(&heard), Followed::Equal, "{policy:?}");
        for _ in 0..50 {
            send(&mut pair, &mut model);
            assert_eq!(model.follow(&outputs(pair.tick())), Followed::Equal, "{policy:?}");
        }
        assert_eq!(pair.step(), 100 + steps_in_silence, "{policy:?}");
    }
}

/// In real time with every kind of damage in both directions: whatever arrives is equal or known to be unknown.
#[test]
fn real_time_on_a_bad_line_never_differs() {
    let mut pair = Pair::open(Settings { mode: Mode::RealTime, ..Settings::default() });
    let mut model = Follower::new(plant());
    let line = |seed| format!("corrupt=5%,drop=5%,duplicate=5%,reorder=5%,seed={seed}");
    let [mut there, mut back] = [1, 2].map(|seed| line(seed).parse::<Disturbance>().unwrap());
    let mut noise = Controller::noise(5.0, 3);
    let (mut taken, mut step) = (0, 0);
    for _ in 0..20_000 {
        let shown = dbd_link::host::Shown { step, time: 0.0, sensors: &[] };
        let values = noise.next(shown, 2).unwrap();
        let mut sent = Vec::new();
        let message = Message::Inputs(Inputs { step, values: values.clone() });
        let sequence =
            pair.controller.send(&message, &mut |frame: &[u8]| sent.extend_from_slice(frame));
        model.note(sequence, &values);
        let arrived = there.pass(&sent).concat();
        let _ = pair.raw(&arrived);
        let mut line = Vec::new();
        pair.plant.tick(0, &mut |frame: &[u8]| line.extend(back.pass(frame).concat()));
        pair.to_controller.extend(line);
        for answer in pair.answers() {
            if let Message::Outputs(outputs) = answer {
                step = outputs.step;
                if model.follow(&outputs) == Followed::Unknown {
                    assert!(model.restore(&saved(&pair)));
                    taken += 1;
                }
            }
        }
    }
    assert_eq!(model.different, 0, "{:?}", model.first);
    assert!(model.compared > 17_000 && taken < 100, "{} {taken}", model.compared);
    let counted = pair.plant.statistics();
    assert_eq!((counted.ticks, pair.step()), (20_000, 20_000));
    assert!(counted.bad > 500 && counted.dropped > 1_000 && counted.late > 500, "{counted:?}");
}

fn saved(pair: &Pair) -> Vec<u8> {
    let mut state = vec![0; 4096];
    let length = pair.plant.device().save(&mut state).unwrap();
    state.truncate(length);
    state
}

/// A pair of processes, as threads of one, over TCP.
struct Ends {
    served: Served,
    driven: Result<(), DriveError>,
    report: Report,
}

fn options(mode: Mode, until: u64) -> DriveOptions {
    DriveOptions {
        settings: Settings { mode, steps: 2, ..Settings::default() },
        until,
        patience: Duration::from_secs(20),
        silence: None,
        session: 3,
    }
}

fn free_port() -> String {
    let listener = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    listener.local_addr().unwrap().to_string()
}

fn ends(disturbance: &str, options: &DriveOptions, serving: ServeOptions) -> Ends {
    let host = free_port();
    let listen: Address = format!("tcp-listen:{host}").parse().unwrap();
    let connect: Address = format!("tcp:{host}").parse().unwrap();
    let line =
        |seed: u32| Some(format!("{disturbance},seed={seed}").parse::<Disturbance>().unwrap());
    let answer = Duration::from_millis(20);
    std::thread::scope(|scope| {
        let served = scope.spawn(move || {
            let mut connection = Connection::new(listen, answer, None);
            serve(plant(), &mut connection, &serving).unwrap()
        });
        let mut connection = Connection::new(connect, answer, line(4));
        let (mut model, mut report) = (Follower::new(plant()), Report::default());
        let mut noise = Controller::noise(3.0, 9);
        let driven =
            drive(&mut connection, &mut model, &mut noise, options, &mut report, &mut |_| Ok(()));
        Ends { served: served.join().unwrap(), driven, report }
    })
}

const SERVING: ServeOptions =
    ServeOptions { period: None, patience: Some(Duration::from_secs(30)), forever: false };

/// The same inputs without a line.
fn alone(frames: u64) -> String {
    let (mut plant, mut noise) = (plant(), Controller::noise(3.0, 9));
    for _ in 0..frames {
        let shown = dbd_link::host::Shown { step: 0, time: 0.0, sensors: &[] };
        let values = noise.next(shown, 2).unwrap();
        values.iter().enumerate().for_each(|(i, value)| assert!(plant.set(i, *value)));
        plant.advance(2);
    }
    format!("{:016x}", plant.hash())
}

#[test]
fn lockstep_has_the_bits_of_a_run_without_a_line() {
    let Ends { served, driven, report } = ends("drop=0", &options(Mode::Lockstep, 2_000), SERVING);
    driven.unwrap();
    assert_eq!((report.steps, report.compared, report.different), (2_000, 1_000, 0));
    assert_eq!((&report.hash, &served.hash), (&alone(1_000), &alone(1_000)));
    assert_eq!(report.plant.unwrap().bad + report.own.bad, 0);
    assert_eq!(report.latency.count, 1_000);
}

#[test]
fn lockstep_on_a_bad_line_and_after_a_break_has_them_too() {
    let mut options = options(Mode::Lockstep, 2_000);
    options.silence = Some((600, Duration::from_millis(300)));
    let Ends { served, driven, report } =
        ends("corrupt=1%,drop=1%,duplicate=1%,reorder=1%", &options, SERVING);
    driven.unwrap();
    assert_eq!((report.steps, report.different), (2_000, 0), "{report:?}");
    assert_eq!((&report.hash, &served.hash), (&alone(1_000), &alone(1_000)));
    assert!(report.own.repeated > 0 && report.reconnected >= 1, "{report:?}");
    assert!(report.disturbed.iter().all(|count| *count > 0), "{report:?}");
}

#[test]
fn real_time_is_followed_bit_for_bit() {
    let serving = ServeOptions { period: Some(Duration::from_millis(1)), ..SERVING };
    let mut options = options(Mode::RealTime, 1_000);
    options.silence = Some((400, Duration::from_millis(100)));
    let Ends { driven, report, .. } = ends("corrupt=1%,drop=1%", &options, serving);
    driven.unwrap();
    assert!(report.steps >= 1_000 && report.different == 0 && report.compared > 100, "{report:?}");
    assert_eq!(report.reconnected, 1, "{report:?}");
}

/// A plant that is switched off and on begins at t = 0; it gets its state back.
#[test]
fn a_plant_that_lost_its_state_gets_it_back() {
    let host = free_port();
    let answer = Duration::from_millis(50);
    let listen: Address = format!("tcp-listen:{host}").parse().unwrap();
    let connect: Address = format!("tcp:{host}").parse().unwrap();
    let serving = ServeOptions { forever: false, ..SERVING };
    let served = std::thread::spawn(move || {
        // It says goodbye after 500 steps, which ends the plant; the second one knows nothing.
        [(); 2].map(|()| {
            let mut connection = Connection::new(listen.clone(), answer, None);
            serve(plant(), &mut connection, &serving).unwrap()
        })
    });
    let (mut model, mut noise) = (Follower::new(plant()), Controller::noise(3.0, 9));
    for until in [500, 1_000] {
        let mut connection = Connection::new(connect.clone(), answer, None);
        let (mut report, options) = (Report::default(), options(Mode::Lockstep, until));
        let run =
            drive(&mut connection, &mut model, &mut noise, &options, &mut report, &mut |_| Ok(()));
        run.unwrap();
        assert_eq!((report.steps, report.restored), (until, u32::from(until > 500)));
        assert_eq!(report.different, 0);
    }
    assert_eq!(served.join().unwrap()[1].hash, alone(500));
}

/// A plant of a later version answers with frames of its own.
#[test]
fn another_version_is_named() {
    let listener = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let connect: Address = format!("tcp:{}", listener.local_addr().unwrap()).parse().unwrap();
    let served = std::thread::spawn(move || {
        let (mut stream, _) = listener.accept().unwrap();
        // Version 2, three bytes, their CRC-32; the line closes with the other end.
        let later = [0, 9, 2, 1, 1, 1, 0x77, 0x7c, 0x93, 0xe4, 0];
        while stream.write_all(&later).is_ok() {
            std::thread::sleep(Duration::from_millis(5));
        }
    });
    let mut connection = Connection::new(connect, Duration::from_millis(20), None);
    let (mut model, mut report) = (Follower::new(plant()), Report::default());
    let options =
        DriveOptions { patience: Duration::from_millis(300), ..options(Mode::Lockstep, 10) };
    let run = drive(
        &mut connection,
        &mut model,
        &mut Controller::Zero,
        &options,
        &mut report,
        &mut |_| Ok(()),
    );
    let said = run.unwrap_err().to_string();
    assert!(said.contains("another protocol version"), "{said}");
    assert!(report.own.version > 0);
    drop(connection);
    served.join().unwrap();
}

#[test]
fn another_plant_is_named() {
    let host = free_port();
    let connect: Address = format!("tcp:{host}").parse().unwrap();
    let listen: Address = format!("tcp-listen:{host}").parse().unwrap();
    let answer = Duration::from_millis(50);
    let served = std::thread::spawn(move || {
        let other = plant_of(&SCENE.replace("200.0", "300.0"), PrecisionName::F32, STEP);
        let mut connection = Connection::new(listen, answer, None);
        let serving = ServeOptions { patience: Some(Duration::from_millis(500)), ..SERVING };
        serve(other, &mut connection, &serving).map(drop)
    });
    let mut connection = Connection::new(connect, answer, None);
    let (mut model, mut report) = (Follower::new(plant()), Report::default());
    let options = options(Mode::Lockstep, 10);
    let run = drive(
        &mut connection,
        &mut model,
        &mut Controller::Zero,
        &options,
        &mut report,
        &mut |_| Ok(()),
    );
    let said = run.unwrap_err().to_string();
    assert!(said.contains("its model (constants or initial state) differs"), "{said}");
    drop(connection);
    assert!(served.join().unwrap().is_err());
}
