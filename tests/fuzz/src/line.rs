//! The target `line`: what arrives at a plant's end of a serial line.
//!
//! `bytes => frames that are sent, damaged, repeated, late, mixed with noise => steps`. Every frame of inputs carries a
//! value that no other has, so that each step can say which frame caused it: only one that arrived whole, of the open
//! session and, in lockstep, of the plant's present step.

use arbitrary::Unstructured;
use dbd_link::controller_end::ControllerEnd;
use dbd_link::device::Device;
use dbd_link::message::{Chunk, Hello, Identity, Inputs, Message, Mode, Policy, Settings, Values};
use dbd_link::plant_end::PlantEnd;
use fastrand::Rng;

use crate::numbers::{below, byte};
use crate::stepper::bytes;
use crate::target::{Finding, Reach, Target};

/// Lines.
pub struct LineTarget;

impl Target for LineTarget {
    fn name(&self) -> &'static str {
        "line"
    }

    fn share(&self) -> f64 {
        0.1
    }

    fn block(&self) -> u64 {
        50_000
    }

    fn input(&self, random: &mut Rng) -> Vec<u8> {
        let most = if random.u8(..8) == 0 { 1200 } else { 80 };
        bytes(random, most)
    }

    fn execute(&self, input: &[u8]) -> Result<Reach, Finding> {
        let mut bytes = Unstructured::new(input);
        let settings = Settings {
            mode: if byte(&mut bytes).is_multiple_of(3) { Mode::RealTime } else { Mode::Lockstep },
            steps: u32::from(byte(&mut bytes) % 4),
            policy: [Policy::Hold, Policy::Zero, Policy::Stop][below(&mut bytes, 3)],
            timeout: u32::from(byte(&mut bytes) % 4),
        };
        let Some(mut line) = Line::new(settings) else {
            return Err(Finding::new("a plant's end", "of a device that works"));
        };
        while !bytes.is_empty() {
            line.act(&mut bytes)?;
        }
        Ok(if line.plant.device().step > 0 { Reach::Taken } else { Reach::Refused })
    }
}

/// A plant that keeps which value caused each step.
struct Counter {
    step: u64,
    value: f64,
    /// Step and value where steps began.
    done: Vec<(u64, f64)>,
}

impl Device for Counter {
    fn identity(&self) -> Identity {
        Identity { step: 1e-3, inputs: 1, outputs: 1, ..Identity::default() }
    }

    fn set(&mut self, input: usize, value: f64) -> bool {
        let accepted = input == 0 && value.is_finite();
        if accepted {
            self.value = value;
        }
        accepted
    }

    fn input(&self, _: usize) -> f64 {
        self.value
    }

    fn advance(&mut self, steps: u32) {
        self.done.push((self.step, self.value));
        self.step += u64::from(steps);
    }

    fn step(&self) -> u64 {
        self.step
    }

    fn running(&self) -> bool {
        true
    }

    fn hash(&self) -> u64 {
        self.step ^ self.value.to_bits()
    }

    fn read(&self, values: &mut Values) {
        _ = values.push(self.value);
    }

    fn save(&self, buffer: &mut [u8]) -> Option<usize> {
        let bytes = self.bytes();
        buffer.get_mut(..bytes.len())?.copy_from_slice(&bytes);
        Some(bytes.len())
    }

    fn restore(&mut self, bytes: &[u8]) -> bool {
        // Only the present state has these bytes: what else arrives is damage.
        bytes == self.bytes()
    }
}

impl Counter {
    fn bytes(&self) -> [u8; 300] {
        let mut bytes = [7; 300];
        bytes[20..28].copy_from_slice(&self.step.to_le_bytes());
        bytes[28..36].copy_from_slice(&self.value.to_bits().to_le_bytes());
        bytes
    }
}

/// A frame, and the step and value of one with inputs.
type Made = (Vec<u8>, Option<(u64, f64)>);

struct Line {
    plant: PlantEnd<Counter, 512>,
    controller: ControllerEnd,
    settings: Settings,
    /// Frames that were made.
    frames: Vec<Made>,
    /// Values that a frame with inputs carried.
    next: f64,
}

impl Line {
    fn new(settings: Settings) -> Option<Self> {
        let plant = PlantEnd::new(Counter { step: 0, value: 0.0, done: Vec::new() }, 1_000)?;
        let mut line = Self {
            plant,
            controller: ControllerEnd::new(9),
            settings,
            frames: Vec::new(),
            next: 1.0,
        };
        line.hello();
        Some(line)
    }

    fn hello(&mut self) {
        let identity = self.plant.identity().clone();
        self.make(&Message::Hello(Hello { identity, settings: self.settings }), None);
        let frame = self.frames.last().map(|(frame, _)| frame.clone()).unwrap_or_default();
        self.arrive(&frame);
    }

    fn make(&mut self, message: &Message, inputs: Option<(u64, f64)>) {
        let mut frame = Vec::new();
        self.controller.send(message, &mut |bytes: &[u8]| frame.extend_from_slice(bytes));
        self.frames.push((frame, inputs));
    }

    /// Bytes at the plant; what it answers, the controller accepts or refuses.
    fn arrive(&mut self, bytes: &[u8]) {
        let mut answers = Vec::new();
        for byte in bytes {
            self.plant.receive(*byte, &mut |frame: &[u8]| answers.extend_from_slice(frame));
        }
        answers.into_iter().for_each(|byte| _ = self.controller.receive(byte));
    }

    /// One thing that happens.
    fn act(&mut self, bytes: &mut Unstructured<'_>) -> Result<(), Finding> {
        let done = self.plant.device().done.len();
        let (open, before) = (self.plant.is_open(), self.plant.device().step);
        let kind = byte(bytes);
        let mut arrived = None;
        match kind % 12 {
            0..=3 => {
                // Inputs of the present step, or of another.
                let off = if kind & 64 == 0 { 0 } else { u64::from(byte(bytes)) };
                let step = before.wrapping_add(off);
                self.next += 1.0;
                let value = if kind & 128 == 0 { self.next } else { f64::NAN };
                let message =
                    Message::Inputs(Inputs { step, values: [value].into_iter().collect() });
                self.make(&message, Some((step, value)));
                arrived = self.frames.last().cloned();
            }
            4 => {
                // A frame again.
                let at = below(bytes, self.frames.len());
                arrived = self.frames.get(at).cloned();
            }
            5 | 6 => {
                // A frame, damaged.
                let at = below(bytes, self.frames.len());
                if let Some((mut frame, inputs)) = self.frames.get(at).cloned() {
                    let place = below(bytes, frame.len());
                    match byte(bytes) % 3 {
                        0 => frame.truncate(place),
                        1 => frame[place] ^= byte(bytes).max(1),
                        _ => frame.insert(place, byte(bytes)),
                    }
                    // It ends here, and is whole where its own end alone was cut off.
                    frame.push(0);
                    arrived = Some((frame, inputs));
                }
            }
            7 => {
                let count = usize::from(byte(bytes)).min(bytes.len());
                let mut noise = bytes.bytes(count).unwrap_or_default().to_vec();
                noise.push(0);
                arrived = Some((noise, None));
            }
            8 => {
                let offset = u32::from(byte(bytes)) * 2;
                self.make(&Message::Save { offset }, None);
                arrived = self.frames.last().cloned();
            }
            9 => {
                let (offset, total) = (u32::from(byte(bytes)) * 2, u32::from(byte(bytes)) * 3);
                let count = usize::from(byte(bytes) % 129);
                let chunk =
                    Chunk { total, offset, bytes: core::iter::repeat_n(7, count).collect() };
                self.make(&Message::Restore(chunk), None);
                arrived = self.frames.last().cloned();
            }
            10 if kind & 128 == 0 => {
                self.controller.renew();
                self.hello();
            }
            10 => {
                let other = [Message::Goodbye, Message::Count, Message::Farewell];
                self.make(&other[below(bytes, other.len())], None);
                arrived = self.frames.last().cloned();
            }
            _ => {
                let mut answers = Vec::new();
                let missed = u32::from(byte(bytes) % 3);
                self.plant.tick(missed, &mut |frame: &[u8]| answers.extend_from_slice(frame));
                answers.into_iter().for_each(|byte| _ = self.controller.receive(byte));
            }
        }
        let caused = arrived.as_ref().and_then(|(_, inputs)| *inputs);
        if let Some((frame, _)) = &arrived {
            self.arrive(frame);
        }
        self.check(done, open, before, caused)
    }

    /// Whether the steps that were taken since are those that what arrived allows.
    fn check(
        &self,
        done: usize,
        open: bool,
        before: u64,
        caused: Option<(u64, f64)>,
    ) -> Result<(), Finding> {
        let device = self.plant.device();
        let new = &device.done[done..];
        let steps = u64::from(self.settings.steps);
        let promise = |holds, what| {
            Finding::unless(holds, what, || {
                format!("{new:?} after {caused:?}, {:?}", self.settings)
            })
        };
        promise(new.len() <= 1, "one frame or tick steps once")?;
        promise(device.step == before + steps * new.len() as u64, "steps are counted")?;
        promise(new.is_empty() || open, "no step without a session")?;
        if self.settings.mode == Mode::Lockstep {
            for (step, value) in new {
                let asked = caused.is_some_and(|(of, with)| of == *step && with == *value);
                promise(asked, "a step has the inputs of its own frame")?;
            }
        }
        let sent = |value: f64| {
            let zero = value == 0.0;
            zero || self.frames.iter().any(|(_, inputs)| inputs.is_some_and(|(_, v)| v == value))
        };
        promise(new.iter().all(|(_, value)| sent(*value)), "an input was sent")
    }
}
