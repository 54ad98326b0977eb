//! The plant's end of the line: reactions to frames, ticks and timeouts.
//!
//! `bytes, ticks => steps of the plant, frames`. A frame steps the plant only if it is complete, of the open session,
//! newer than the last one and, in lockstep, of the plant's present step. All others are counted and change nothing.
//! The end neither waits nor allocates: the program passes bytes and ticks as they arrive.

use heapless::Vec;

use crate::device::Device;
use crate::frame::{Frame, FrameError, Receiver};
use crate::message::{
    Change, Chunk, Header, Hello, Identity, Inputs, MAX_CHANGES, MAX_CHUNK, MAX_VALUES, Message,
    Mode, Outputs, Policy, Refusal, Settings, Statistics, Values, Welcome,
};

/// The line to the other end.
pub trait Line {
    /// Sends a whole frame, waiting at most for space in the line's buffer.
    fn send(&mut self, frame: &[u8]);

    /// The core's cycle counter, to time steps; 0 without one.
    fn cycles(&self) -> u32 {
        0
    }
}

impl<F: FnMut(&[u8])> Line for F {
    fn send(&mut self, frame: &[u8]) {
        self(frame);
    }
}

/// The plant's end. `N` is the size of its buffer for snapshots \[bytes\].
pub struct PlantEnd<D, const N: usize> {
    device: D,
    identity: Identity,
    /// \[µs\] period of ticks; 0 without a timer.
    period: u32,
    receiver: Receiver,
    frame: Frame,
    session: Option<Session>,
    sequence: u32,
    statistics: Statistics,
    changes: Vec<Change, MAX_CHANGES>,
    snapshot: [u8; N],
    /// \[bytes\] length of the taken snapshot in the buffer.
    saved: usize,
    /// \[bytes\] received so far of an incoming state.
    arrived: usize,
}

#[derive(Clone, Copy)]
struct Session {
    number: u16,
    settings: Settings,
    /// Sequence number of the newest frame.
    sequence: u32,
    /// Sequence number of the newest inputs.
    received: u32,
    /// Ticks since they arrived.
    silent: u32,
}

impl<D: Device, const N: usize> PlantEnd<D, N> {
    /// The end of a plant at the line, with a timer that ticks every `period` \[µs\]; 0 without a timer, which allows
    /// only lockstep.
    ///
    /// `None` if the plant has failed, a snapshot requires more than `N` bytes, or it has at least [`MAX_VALUES`]
    /// inputs or sensor values.
    pub fn new(device: D, period: u32) -> Option<Self> {
        let (mut identity, mut snapshot) = (device.identity(), [0; N]);
        device.save(&mut snapshot)?;
        identity.fingerprint = *snapshot.get(4..18)?.first_chunk()?;
        let inputs = usize::from(identity.inputs);
        if inputs >= MAX_VALUES || usize::from(identity.outputs) >= MAX_VALUES {
            return None;
        }
        Some(Self {
            device,
            identity,
            period,
            receiver: Receiver::default(),
            frame: Frame::default(),
            session: None,
            sequence: 0,
            statistics: Statistics::default(),
            changes: Vec::new(),
            snapshot,
            saved: 0,
            arrived: 0,
        })
    }

    /// The plant.
    pub const fn device(&self) -> &D {
        &self.device
    }

    /// Its identity, which the other end compares.
    pub const fn identity(&self) -> &Identity {
        &self.identity
    }

    /// Statistics since the start.
    pub const fn statistics(&self) -> &Statistics {
        &self.statistics
    }

    /// Whether a session is open.
    pub const fn is_open(&self) -> bool {
        self.session.is_some()
    }

    /// The receiver of the line lost bytes.
    pub fn lost(&mut self, bytes: u32) {
        self.statistics.lost = self.statistics.lost.saturating_add(bytes);
    }

    /// Processes a byte of the line.
    pub fn receive(&mut self, byte: u8, line: &mut impl Line) {
        match self.receiver.push(byte) {
            Ok(None) => {}
            Ok(Some((header, message))) => self.take(header, message, line),
            Err(FrameError::Version(_)) => add(&mut self.statistics.version, 1),
            Err(_) => add(&mut self.statistics.bad, 1),
        }
    }

    /// A tick of the timer, after `missed` ticks that came too early: in real time the plant takes its steps and sends
    /// its outputs. Missed ticks are not made up for.
    pub fn tick(&mut self, missed: u32, line: &mut impl Line) {
        add(&mut self.statistics.ticks, 1);
        add(&mut self.statistics.overruns, missed);
        let Some(session) = &mut self.session else { return };
        if session.settings.mode != Mode::RealTime {
            return;
        }
        let Settings { steps, policy, timeout, .. } = session.settings;
        // 0 in the tick after inputs.
        let silent = session.silent;
        session.silent = silent.saturating_add(1);
        let late = silent > timeout;
        if silent == timeout.saturating_add(1) {
            add(&mut self.statistics.timeouts, 1);
            if policy == Policy::Zero {
                let count = usize::from(self.identity.inputs);
                self.set_all(&core::iter::repeat_n(0.0, count).collect());
                self.changed(0);
            }
        }
        if !(late && policy == Policy::Stop) {
            self.advance(steps, line);
        }
        self.send_outputs(line);
    }

    /// Processes a request.
    fn take(&mut self, header: Header, message: Message, line: &mut impl Line) {
        if let Message::Hello(hello) = message {
            return self.greet(header, &hello, line);
        }
        let Some(session) = self.session.as_mut().filter(|open| open.number == header.session)
        else {
            add(&mut self.statistics.foreign, 1);
            return self.send(header.session, &Message::Refused(Refusal::Session), line);
        };
        let ahead = header.sequence.wrapping_sub(session.sequence);
        if ahead == 0 || ahead > u32::MAX / 2 {
            return add(&mut self.statistics.late, 1);
        }
        session.sequence = header.sequence;
        add(&mut self.statistics.dropped, ahead - 1);
        add(&mut self.statistics.good, 1);
        let number = session.number;
        match message {
            Message::Inputs(inputs) => self.drive(header, &inputs, line),
            Message::Save { offset } => self.save(offset, line),
            Message::Restore(chunk) => self.restore(&chunk, line),
            Message::Count => {
                let message = Message::Counted(self.statistics);
                self.send(number, &message, line);
            }
            Message::Goodbye => {
                self.session = None;
                self.send(number, &Message::Farewell, line);
            }
            // A message of a plant, not of a controller: an echo of the line.
            _ => add(&mut self.statistics.refused, 1),
        }
    }

    /// Opens a session, or answers again if it is open.
    fn greet(&mut self, header: Header, hello: &Hello, line: &mut impl Line) {
        add(&mut self.statistics.good, 1);
        if let Some(open) = self.session.as_mut().filter(|open| open.number == header.session) {
            // A repeated question: the answer was lost, or the line repeated the question.
            let ahead = header.sequence.wrapping_sub(open.sequence);
            if ahead <= u32::MAX / 2 {
                open.sequence = header.sequence;
            }
        } else {
            let Settings { mode, steps, timeout, .. } = hello.settings;
            let refusal = if let Some(mismatch) = self.identity.mismatch(&hello.identity) {
                Some(Refusal::Identity(mismatch, self.identity.clone()))
            } else if header.session == 0
                || steps == 0
                || timeout == 0
                || (mode == Mode::RealTime && self.period == 0)
            {
                Some(Refusal::Settings)
            } else {
                None
            };
            if let Some(refusal) = refusal {
                add(&mut self.statistics.refused, 1);
                return self.send(header.session, &Message::Refused(refusal), line);
            }
            self.session = Some(Session {
                number: header.session,
                settings: hello.settings,
                sequence: header.sequence,
                received: 0,
                silent: 0,
            });
        }
        let welcome = Welcome {
            identity: self.identity.clone(),
            outputs: self.outputs(),
            period: self.period,
        };
        self.send(header.session, &Message::Welcome(welcome), line);
    }

    /// Sets inputs; in lockstep the plant also takes its steps.
    fn drive(&mut self, header: Header, inputs: &Inputs, line: &mut impl Line) {
        let Some(Session { settings, .. }) = self.session else { return };
        let step = self.device.step();
        if settings.mode == Mode::Lockstep && inputs.step != step {
            // The same question again: its answer was lost.
            if inputs.step.checked_add(u64::from(settings.steps)) == Some(step) {
                add(&mut self.statistics.repeated, 1);
                return self.send_outputs(line);
            }
            add(&mut self.statistics.late, 1);
            return self.refuse(Refusal::Step(step), line);
        }
        if !self.device.running() {
            return self.refuse(Refusal::Failed, line);
        }
        if !self.set_all(&inputs.values) {
            return self.refuse(Refusal::Values, line);
        }
        self.changed(header.sequence);
        if let Some(session) = &mut self.session {
            session.received = header.sequence;
            session.silent = 0;
        }
        if settings.mode == Mode::Lockstep {
            self.advance(settings.steps, line);
            self.send_outputs(line);
        }
    }

    /// Sets all inputs or none; returns whether they were accepted.
    fn set_all(&mut self, values: &Values) -> bool {
        if values.len() != usize::from(self.identity.inputs) {
            return false;
        }
        let held: Values = (0..values.len()).map(|input| self.device.input(input)).collect();
        let mut accepted = 0;
        while values.get(accepted).is_some_and(|value| self.device.set(accepted, *value)) {
            accepted += 1;
        }
        if accepted == values.len() {
            return true;
        }
        held.iter()
            .enumerate()
            .take(accepted)
            .for_each(|(i, value)| _ = self.device.set(i, *value));
        false
    }

    /// Records that the inputs come from another frame from the present step on.
    fn changed(&mut self, sequence: u32) {
        let change = Change { step: self.device.step(), sequence };
        match self.changes.last_mut() {
            // Two frames before one step: the newer one applies.
            Some(last) if last.step == change.step => *last = change,
            _ => {
                if self.changes.is_full() {
                    self.changes.remove(0);
                }
                // There is space now.
                _ = self.changes.push(change);
            }
        }
    }

    fn advance(&mut self, steps: u32, line: &impl Line) {
        let before = line.cycles();
        self.device.advance(steps);
        let took = line.cycles().wrapping_sub(before);
        self.statistics.slowest = self.statistics.slowest.max(took);
    }

    fn outputs(&self) -> Outputs {
        let mut values = Values::new();
        self.device.read(&mut values);
        Outputs {
            step: self.device.step(),
            running: self.device.running(),
            hash: self.device.hash(),
            received: self.session.map_or(0, |session| session.received),
            values,
            changes: self.changes.clone(),
        }
    }

    fn send_outputs(&mut self, line: &mut impl Line) {
        if let Some(Session { number, .. }) = self.session {
            let message = Message::Outputs(self.outputs());
            self.send(number, &message, line);
        }
    }

    /// A piece of the state; at offset 0 a new snapshot is taken.
    fn save(&mut self, offset: u32, line: &mut impl Line) {
        if offset == 0 {
            self.arrived = 0;
            match self.device.save(&mut self.snapshot) {
                Some(length) => self.saved = length,
                None => return self.refuse(Refusal::Failed, line),
            }
        }
        let (start, total) = (offset as usize, self.saved);
        let end = start.saturating_add(MAX_CHUNK).min(total);
        let Some(piece) = self.snapshot.get(start..end).filter(|piece| !piece.is_empty()) else {
            return self.refuse(Refusal::State, line);
        };
        let bytes = piece.iter().copied().collect();
        let chunk = Chunk { total: total as u32, offset, bytes };
        self.reply(&Message::Saved(chunk), line);
    }

    /// Receives a piece of a state; the plant continues from it after the last piece.
    fn restore(&mut self, chunk: &Chunk, line: &mut impl Line) {
        let (start, total) = (chunk.offset as usize, chunk.total as usize);
        if start == 0 {
            (self.saved, self.arrived) = (0, 0);
        }
        let end = start.saturating_add(chunk.bytes.len());
        // A repeated piece is answered again; one too early is not.
        let place = if total <= N && end <= total && start <= self.arrived {
            self.snapshot.get_mut(start..end)
        } else {
            None
        };
        let Some(place) = place else { return self.refuse(Refusal::State, line) };
        place.copy_from_slice(&chunk.bytes);
        self.arrived = self.arrived.max(end);
        if end == total {
            let whole = self.snapshot.get(..total).unwrap_or_default();
            if !self.device.restore(whole) {
                self.arrived = 0;
                return self.refuse(Refusal::State, line);
            }
            // The inputs are now those of the snapshot.
            self.changes.clear();
        }
        let received = end as u32;
        self.reply(&Message::Restored { received }, line);
    }

    fn refuse(&mut self, refusal: Refusal, line: &mut impl Line) {
        add(&mut self.statistics.refused, 1);
        self.reply(&Message::Refused(refusal), line);
    }

    fn reply(&mut self, message: &Message, line: &mut impl Line) {
        let number = self.session.map_or(0, |session| session.number);
        self.send(number, message, line);
    }

    fn send(&mut self, session: u16, message: &Message, line: &mut impl Line) {
        self.sequence = self.sequence.wrapping_add(1);
        self.frame.encode(Header { session, sequence: self.sequence }, message);
        add(&mut self.statistics.sent, 1);
        line.send(self.frame.bytes());
    }
}

/// Adds to a counter, which saturates.
fn add(counter: &mut u32, count: u32) {
    *counter = counter.saturating_add(count);
}
