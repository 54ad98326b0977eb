//! The controller's end of the line: frames to send and accepted answers.
//!
//! `settings, inputs => frames; bytes => messages of the open session, each newer than the last`. The end neither waits
//! nor allocates; [`ask`] waits for an answer and repeats the question without one.

use crate::frame::{Frame, FrameError, Receiver};
use crate::message::{Header, Message, Outputs, Refusal, Statistics, Welcome};
use crate::plant_end::Line;

/// The controller's end.
#[derive(Clone, Debug)]
pub struct ControllerEnd {
    session: u16,
    sequence: u32,
    /// Sequence number of the plant's newest frame; `None` before the first one of a session.
    newest: Option<u32>,
    receiver: Receiver,
    frame: Frame,
    statistics: Statistics,
}

impl ControllerEnd {
    /// An end whose first session has this number, which must differ from that of an earlier program, so that its
    /// frames are rejected.
    #[must_use]
    pub fn new(session: u16) -> Self {
        Self {
            session: session.max(1),
            sequence: 0,
            newest: None,
            receiver: Receiver::default(),
            frame: Frame::default(),
            statistics: Statistics::default(),
        }
    }

    /// Statistics since the start.
    pub const fn statistics(&self) -> &Statistics {
        &self.statistics
    }

    /// The sequence number of the newest sent frame.
    #[must_use]
    pub const fn sequence(&self) -> u32 {
        self.sequence
    }

    /// Changes the session number: a plant that lost the last session opens a new one.
    pub fn renew(&mut self) {
        self.session = self.session.checked_add(1).unwrap_or(1);
        self.newest = None;
    }

    /// Sends a message; returns its sequence number.
    pub fn send(&mut self, message: &Message, line: &mut impl Line) -> u32 {
        // No frame of inputs has number 0.
        self.sequence = self.sequence.checked_add(1).unwrap_or(1);
        self.frame.encode(Header { session: self.session, sequence: self.sequence }, message);
        self.statistics.sent = self.statistics.sent.saturating_add(1);
        line.send(self.frame.bytes());
        self.sequence
    }

    /// Processes a byte of the line; returns the message that it completes.
    pub fn receive(&mut self, byte: u8) -> Option<Message> {
        let counts = &mut self.statistics;
        let (header, message) = match self.receiver.push(byte) {
            Ok(received) => received?,
            Err(FrameError::Version(_)) => {
                counts.version = counts.version.saturating_add(1);
                return None;
            }
            Err(_) => {
                counts.bad = counts.bad.saturating_add(1);
                return None;
            }
        };
        if header.session != self.session {
            counts.foreign = counts.foreign.saturating_add(1);
            return None;
        }
        if let Some(newest) = self.newest {
            let ahead = header.sequence.wrapping_sub(newest);
            if ahead == 0 || ahead > u32::MAX / 2 {
                // A plant that was switched off counts from 1 again, and reports that no session is open.
                if matches!(message, Message::Refused(Refusal::Session)) {
                    return Some(message);
                }
                counts.late = counts.late.saturating_add(1);
                return None;
            }
            counts.dropped = counts.dropped.saturating_add(ahead - 1);
        }
        self.newest = Some(header.sequence);
        counts.good = counts.good.saturating_add(1);
        if matches!(message, Message::Refused(_)) {
            counts.refused = counts.refused.saturating_add(1);
        }
        Some(message)
    }

    /// Counts a repeated question.
    pub fn repeated(&mut self) {
        self.statistics.repeated = self.statistics.repeated.saturating_add(1);
    }
}

/// A line with a blocking read.
pub trait Wait: Line {
    /// The next byte; `None` after the time limit for an answer to the last sent frame.
    fn byte(&mut self) -> Option<u8>;
}

/// Why a question was not answered.
#[derive(Clone, Debug, PartialEq)]
pub enum Unanswered {
    /// The plant refused it.
    Refused(Refusal),
    /// No answer came to any of the questions.
    Silent,
}

/// Asks until `accept` accepts an answer, at most `times`; answers to earlier questions are skipped.
///
/// # Errors
/// [`Unanswered`].
// The refusal contains the other model's identity; there is no heap to box it.
#[allow(clippy::result_large_err)]
pub fn ask<T>(
    end: &mut ControllerEnd,
    line: &mut impl Wait,
    times: u32,
    message: &Message,
    mut accept: impl FnMut(Message) -> Option<T>,
) -> Result<T, Unanswered> {
    for time in 0..times {
        if time > 0 {
            end.repeated();
        }
        end.send(message, line);
        while let Some(byte) = line.byte() {
            match end.receive(byte) {
                Some(Message::Refused(refusal)) => return Err(Unanswered::Refused(refusal)),
                Some(answer) => {
                    if let Some(accepted) = accept(answer) {
                        return Ok(accepted);
                    }
                }
                None => {}
            }
        }
    }
    Err(Unanswered::Silent)
}

/// The welcome of an answer.
pub fn welcome(answer: Message) -> Option<Welcome> {
    match answer {
        Message::Welcome(welcome) => Some(welcome),
        _ => None,
    }
}

/// The outputs of an answer at this step.
pub fn outputs_at(step: u64) -> impl Fn(Message) -> Option<Outputs> {
    move |answer| match answer {
        Message::Outputs(outputs) if outputs.step == step => Some(outputs),
        // A plant that failed before that step reports where.
        Message::Outputs(outputs) if !outputs.running => Some(outputs),
        _ => None,
    }
}
