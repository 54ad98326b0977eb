//! The controller's end on a PC: opens the session, sends inputs, follows the plant with a model.
//!
//! Lost frames are requested again, a closed port is reopened, a plant that was switched off is restored to the model's
//! state, and a model that cannot follow takes the plant's state.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use thiserror::Error;

use crate::controller_end::{ControllerEnd, Unanswered, ask, outputs_at, welcome};
use crate::device::Device as _;
use crate::host::connection::Connection;
use crate::host::controller::{Controller, ControllerError, Shown};
use crate::host::follower::{Followed, Follower};
use crate::host::port::PortError;
use crate::host::report::{Latency, Report};
use crate::message::{
    Chunk, Hello, Identity, Inputs, MAX_CHUNK, Message, Mismatch, Mode, Outputs, Refusal, Settings,
    Statistics, Values,
};

/// Minimum number of questions of one kind, and minimum time, before the line is considered dead.
const TIMES: u32 = 10;
const DEAD: Duration = Duration::from_secs(2);
/// Maximum number of frames of inputs in flight in real time: a line slower than the ticks must not fill with old ones.
const WINDOW: usize = 3;

/// Options of a run.
#[derive(Clone, Debug)]
pub struct DriveOptions {
    /// Settings of the session.
    pub settings: Settings,
    /// Steps since t = 0 at which it ends.
    pub until: u64,
    /// Time limit for a plant that does not answer, and for a port that does not open.
    pub patience: Duration,
    /// Closes the port for this time when the plant has taken these steps, to test a broken line.
    pub silence: Option<(u64, Duration)>,
    /// The number of the first session.
    pub session: u16,
}

/// A frame of outputs and the inputs that answer it.
#[derive(Clone, Debug)]
pub struct Sample<'s> {
    /// Steps since t = 0.
    pub step: u64,
    /// Values of the sensors.
    pub sensors: &'s [f64],
    /// Values of the inputs from this step.
    pub inputs: &'s [f64],
    /// Comparison of the outputs with the model.
    pub followed: Followed,
}

/// Why a run ended early.
#[derive(Debug, Error)]
pub enum DriveError {
    /// The port does not open.
    #[error(transparent)]
    Port(#[from] PortError),
    /// The controller failed.
    #[error(transparent)]
    Controller(#[from] ControllerError),
    /// The plant does not match the model.
    #[error("the plant at the port does not match the model: its {} differs", .mismatch.name())]
    Identity {
        /// What differs first.
        mismatch: Mismatch,
        /// The plant's.
        plant: Box<Identity>,
        /// The model's.
        model: Box<Identity>,
    },
    /// The plant refused the settings.
    #[error("the plant refused the settings: it has no timer for real time, or a count is 0")]
    Settings,
    /// The plant refused the inputs.
    #[error("the plant refused the inputs {0:?}: they are not finite in its precision")]
    Inputs(Vec<f64>),
    /// The other end uses another version.
    #[error("the plant uses another protocol version than {}", crate::message::VERSION)]
    Version,
    /// No answer.
    #[error("no answer from the plant within {0} s")]
    Silent(f64),
    /// The plant and its model cannot be brought to the same state.
    #[error("cannot transfer the state of the plant: {0}")]
    State(&'static str),
    /// The trace was not written.
    #[error("cannot write the trace: {0}")]
    Trace(#[from] std::io::Error),
}

/// Drives a plant until the requested step; each frame is passed to `look`.
///
/// # Errors
/// [`DriveError`], with the statistics until then in `report`.
pub fn drive(
    connection: &mut Connection,
    follower: &mut Follower,
    controller: &mut Controller,
    options: &DriveOptions,
    report: &mut Report,
    look: &mut dyn FnMut(Sample<'_>) -> std::io::Result<()>,
) -> Result<(), DriveError> {
    let start = Instant::now();
    let end = ControllerEnd::new(options.session);
    let mut run = Run {
        end,
        connection,
        follower,
        controller,
        options,
        report,
        look,
        latencies: Vec::new(),
        silence: options.silence,
    };
    let outcome = run.all();
    let Run { end, latencies, .. } = run;
    report.note(follower);
    report.latency = Latency::of(&latencies);
    report.own = *end.statistics();
    report.reconnected = connection.opened.saturating_sub(1);
    report.disturbed = connection.disturbed();
    report.seconds = start.elapsed().as_secs_f64();
    outcome
}

struct Run<'r> {
    end: ControllerEnd,
    connection: &'r mut Connection,
    follower: &'r mut Follower,
    controller: &'r mut Controller,
    options: &'r DriveOptions,
    report: &'r mut Report,
    look: &'r mut dyn FnMut(Sample<'_>) -> std::io::Result<()>,
    latencies: Vec<Duration>,
    silence: Option<(u64, Duration)>,
}

impl Run<'_> {
    fn all(&mut self) -> Result<(), DriveError> {
        let mut outputs = self.open()?;
        match self.options.settings.mode {
            Mode::Lockstep => self.lockstep(&mut outputs)?,
            Mode::RealTime => self.real_time(&mut outputs)?,
        }
        self.report.plant = self.statistics();
        // A lost farewell is ignored.
        _ = self
            .asked(&Message::Goodbye, |answer| matches!(answer, Message::Farewell).then_some(()));
        Ok(())
    }

    /// Opens the port and a session, and brings plant and model to the same state; returns the plant's outputs.
    fn open(&mut self) -> Result<Outputs, DriveError> {
        let patience = self.options.patience;
        let end = Instant::now() + patience;
        loop {
            self.connection.open(end.saturating_duration_since(Instant::now()))?;
            self.end.renew();
            let model = identity(self.follower)?;
            let hello = Hello { identity: model.clone(), settings: self.options.settings };
            let hello = Message::Hello(hello);
            match self.asked(&hello, welcome) {
                Ok(welcome) => return self.meet(welcome.outputs),
                Err(Unanswered::Refused(Refusal::Identity(mismatch, plant))) => {
                    let (plant, model) = (Box::new(plant), Box::new(model));
                    return Err(DriveError::Identity { mismatch, plant, model });
                }
                Err(Unanswered::Refused(Refusal::Settings)) => return Err(DriveError::Settings),
                Err(_) if Instant::now() < end => {}
                Err(_) if self.end.statistics().version > 0 => return Err(DriveError::Version),
                Err(_) => return Err(DriveError::Silent(patience.as_secs_f64())),
            }
        }
    }

    /// Brings plant and model to the same state after a welcome.
    fn meet(&mut self, outputs: Outputs) -> Result<Outputs, DriveError> {
        let own = self.follower.model().step();
        let lockstep = self.options.settings.mode == Mode::Lockstep;
        if outputs.step == own && outputs.hash == self.follower.model().hash() {
            return Ok(outputs);
        }
        if outputs.step == own && own > 0 {
            // No one else drove it: a deviation now is a difference, not a new state to adopt.
            self.follower.follow(&outputs);
            return Ok(outputs);
        }
        if outputs.step < own {
            // It was switched off, and restarts at t = 0.
            return self.give();
        }
        if lockstep && own > 0 && outputs.step == own + u64::from(self.options.settings.steps) {
            // The last answer was lost with the port.
            if self.follower.follow(&outputs) == Followed::Equal {
                return Ok(outputs);
            }
        }
        if !lockstep && own > 0 && outputs.step > own {
            return Ok(outputs);
        }
        self.take()
    }

    /// Asks until an answer is accepted.
    #[allow(clippy::result_large_err)] // As `ask`.
    fn asked<T>(
        &mut self,
        message: &Message,
        accept: impl FnMut(Message) -> Option<T>,
    ) -> Result<T, Unanswered> {
        let times = DEAD.as_secs_f64() / self.connection.answer().as_secs_f64();
        // The conversion saturates.
        let times = TIMES.max(times as u32);
        ask(&mut self.end, self.connection, times, message, accept)
    }

    /// The model continues from the plant's state.
    fn take(&mut self) -> Result<Outputs, DriveError> {
        let mut bytes: Vec<u8> = Vec::new();
        loop {
            let offset = bytes.len() as u32;
            let chunk = self.asked(&Message::Save { offset }, |answer| match answer {
                Message::Saved(chunk) if chunk.offset == offset => Some(chunk),
                _ => None,
            });
            let chunk = chunk.map_err(|why| self.no_state(&why))?;
            bytes.extend_from_slice(&chunk.bytes);
            if bytes.len() as u32 >= chunk.total {
                break;
            }
        }
        if !self.follower.restore(&bytes) {
            return Err(DriveError::State("the model does not accept it"));
        }
        self.report.synchronised += 1;
        Ok(self.present())
    }

    /// The plant continues from the model's state.
    fn give(&mut self) -> Result<Outputs, DriveError> {
        let state = self.follower.save().ok_or(DriveError::State("the model has failed"))?;
        let total = state.len() as u32;
        for (number, bytes) in state.chunks(MAX_CHUNK).enumerate() {
            let offset = (number * MAX_CHUNK) as u32;
            let bytes = bytes.iter().copied().collect();
            let end = offset + chunk_length(&bytes);
            let message = Message::Restore(Chunk { total, offset, bytes });
            let received = self.asked(&message, |answer| match answer {
                Message::Restored { received } if received >= end => Some(()),
                _ => None,
            });
            received.map_err(|why| self.no_state(&why))?;
        }
        self.report.restored += 1;
        Ok(self.present())
    }

    fn no_state(&self, why: &Unanswered) -> DriveError {
        match why {
            Unanswered::Silent => DriveError::Silent(self.options.patience.as_secs_f64()),
            Unanswered::Refused(Refusal::Failed) => DriveError::State("the plant has failed"),
            Unanswered::Refused(_) => DriveError::State("the plant refused"),
        }
    }

    /// The outputs that the plant would send, from the model.
    fn present(&self) -> Outputs {
        let model = self.follower.model();
        let mut values = Values::new();
        model.read(&mut values);
        Outputs {
            step: model.step(),
            running: model.running(),
            hash: model.hash(),
            values,
            ..Outputs::default()
        }
    }

    fn statistics(&mut self) -> Option<Statistics> {
        self.asked(&Message::Count, |answer| match answer {
            Message::Counted(statistics) => Some(statistics),
            _ => None,
        })
        .ok()
    }

    /// The inputs that answer these outputs.
    fn inputs(&mut self, outputs: &Outputs) -> Result<Values, DriveError> {
        let model = self.follower.model();
        let shown = Shown {
            step: outputs.step,
            time: outputs.step as f64 * model.step_size(),
            sensors: &outputs.values,
        };
        Ok(self.controller.next(shown, model.inputs().len())?)
    }

    /// Breaks the line if requested at this step.
    fn be_silent(&mut self, step: u64) -> Result<bool, DriveError> {
        match self.silence {
            Some((at, duration)) if step >= at => {
                self.silence = None;
                self.connection.close();
                std::thread::sleep(duration);
                Ok(true)
            }
            _ => Ok(false),
        }
    }

    fn lockstep(&mut self, outputs: &mut Outputs) -> Result<(), DriveError> {
        let mut followed = Followed::Equal;
        let steps = u64::from(self.options.settings.steps);
        while outputs.step < self.options.until && outputs.running {
            if self.be_silent(outputs.step)? {
                *outputs = self.open()?;
            }
            let values = self.inputs(outputs)?;
            let (step, sensors, inputs) = (outputs.step, &outputs.values, &values);
            (self.look)(Sample { step, sensors, inputs, followed })?;
            // Keeps the same inputs until the plant has taken its steps, whatever happens to the line.
            loop {
                let message = Message::Inputs(Inputs { step, values: values.clone() });
                let (before, sent) = (self.end.sequence(), Instant::now());
                let answer = self.asked(&message, outputs_at(step + steps));
                for sequence in before + 1..=self.end.sequence() {
                    self.follower.note(sequence, &values);
                }
                match answer {
                    Ok(new) => {
                        self.latencies.push(sent.elapsed());
                        followed = self.follower.follow(&new);
                        *outputs = new;
                        if followed == Followed::Unknown {
                            *outputs = self.take()?;
                        }
                        break;
                    }
                    Err(Unanswered::Refused(Refusal::Values)) => {
                        return Err(DriveError::Inputs(values.to_vec()));
                    }
                    Err(Unanswered::Refused(Refusal::Failed)) => return Ok(()),
                    Err(Unanswered::Silent | Unanswered::Refused(_)) => {
                        let new = self.open()?;
                        if new.step != step {
                            *outputs = new;
                            break;
                        }
                    }
                }
            }
        }
        Ok(())
    }

    fn real_time(&mut self, outputs: &mut Outputs) -> Result<(), DriveError> {
        let mut followed = Followed::Equal;
        // Frames of inputs that are not answered yet.
        let mut pending: VecDeque<(u32, Instant)> = VecDeque::new();
        let patience = self.options.patience;
        // The inputs sent last.
        let mut values: Values = self.follower.model().inputs().iter().map(|_| 0.0).collect();
        loop {
            if self.be_silent(outputs.step)? {
                *outputs = self.open()?;
                pending.clear();
            }
            let step = outputs.step;
            let is_over = step >= self.options.until || !outputs.running;
            // Frames not answered in time are considered lost.
            let answer = self.connection.answer();
            while pending.front().is_some_and(|(_, sent)| sent.elapsed() > answer) {
                pending.pop_front();
            }
            // The controller gets every frame, and keeps its last values if the line is full.
            let new = self.inputs(outputs)?;
            if pending.len() < WINDOW && !is_over {
                let message = Message::Inputs(Inputs { step, values: new.clone() });
                let sequence = self.end.send(&message, self.connection);
                self.follower.note(sequence, &new);
                pending.push_back((sequence, Instant::now()));
                values = new;
            }
            let (sensors, inputs) = (&outputs.values, &values);
            (self.look)(Sample { step, sensors, inputs, followed })?;
            if is_over {
                return Ok(());
            }
            // The newest outputs: queued ones are followed, but not answered one by one.
            let mut end = Instant::now() + patience;
            let mut new = None;
            while let Some(message) = self.message_until(end) {
                match message {
                    Message::Outputs(outputs) => {
                        while pending.front().is_some_and(|first| first.0 <= outputs.received) {
                            if let Some((sequence, sent)) = pending.pop_front()
                                && sequence == outputs.received
                            {
                                self.latencies.push(sent.elapsed());
                            }
                        }
                        // In flight since before the model took the plant's state.
                        if outputs.step < self.follower.model().step() {
                            self.follower.unknown += 1;
                            continue;
                        }
                        followed = self.follower.follow(&outputs);
                        new = Some(outputs);
                        end = Instant::now();
                    }
                    Message::Refused(Refusal::Values) => {
                        return Err(DriveError::Inputs(values.to_vec()));
                    }
                    Message::Refused(Refusal::Session) => {
                        new = None;
                        break;
                    }
                    _ => {}
                }
            }
            match new {
                Some(_) if followed == Followed::Unknown => *outputs = self.take()?,
                Some(new) => *outputs = new,
                None => {
                    *outputs = self.open()?;
                    pending.clear();
                }
            }
        }
    }

    /// The next message until `end`.
    fn message_until(&mut self, end: Instant) -> Option<Message> {
        loop {
            let byte = self.connection.byte_until(end)?;
            if let Some(message) = self.end.receive(byte) {
                return Some(message);
            }
        }
    }
}

fn chunk_length(bytes: &heapless::Vec<u8, MAX_CHUNK>) -> u32 {
    bytes.len() as u32
}

/// The model's identity with its fingerprint.
fn identity(follower: &Follower) -> Result<Identity, DriveError> {
    let state = follower.save().ok_or(DriveError::State("the model has failed"))?;
    let mut identity = follower.model().identity();
    let head = state.get(4..18).and_then(|head| head.first_chunk());
    identity.fingerprint = *head.ok_or(DriveError::State("it has no fingerprint"))?;
    Ok(identity)
}
