//! A line of a PC: a port that is reopened when it closes, with an optional disturbance.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use crate::controller_end::Wait;
use crate::host::disturbance::Disturbance;
use crate::host::port::{Address, Port, PortError};
use crate::plant_end::Line;

/// A line to the other end.
pub struct Connection {
    address: Address,
    port: Option<Port>,
    received: VecDeque<u8>,
    /// The bytes since the last zero, if frames are disturbed.
    piece: Vec<u8>,
    disturbance: Option<Disturbance>,
    /// Time limit for an answer.
    answer: Duration,
    deadline: Instant,
    /// Number of times the port was opened.
    pub opened: u32,
}

impl Connection {
    /// A line that is not open yet; `answer` is the time limit for an answer.
    #[must_use]
    pub fn new(address: Address, answer: Duration, disturbance: Option<Disturbance>) -> Self {
        Self {
            address,
            port: None,
            received: VecDeque::new(),
            piece: Vec::new(),
            disturbance,
            // A limit of 0 would repeat a question indefinitely.
            answer: answer.max(Duration::from_millis(1)),
            deadline: Instant::now(),
            opened: 0,
        }
    }

    /// Opens the port if it is closed, trying for up to `patience`.
    ///
    /// # Errors
    /// [`PortError::Open`].
    pub fn open(&mut self, patience: Duration) -> Result<(), PortError> {
        if self.port.is_none() {
            self.port = Some(Port::open(&self.address, patience)?);
            self.opened += 1;
            self.received.clear();
            self.piece.clear();
        }
        Ok(())
    }

    /// Time limit for an answer.
    #[must_use]
    pub const fn answer(&self) -> Duration {
        self.answer
    }

    /// Closes the port.
    pub fn close(&mut self) {
        self.port = None;
    }

    /// Whether the port is open, as far as is known.
    #[must_use]
    pub fn is_open(&self) -> bool {
        self.port.is_some()
    }

    /// Frames that were disturbed: corrupted, dropped, repeated, reordered.
    #[must_use]
    pub fn disturbed(&self) -> [u32; 4] {
        self.disturbance.as_ref().map_or([0; 4], |disturbance| disturbance.done)
    }

    /// The next byte until `end`.
    pub fn byte_until(&mut self, end: Instant) -> Option<u8> {
        loop {
            if let Some(byte) = self.received.pop_front() {
                return Some(byte);
            }
            let Some(bytes) = self.port.as_mut()?.read(end) else {
                self.port = None;
                return None;
            };
            if bytes.is_empty() {
                return None;
            }
            self.arrive(&bytes);
        }
    }

    fn arrive(&mut self, bytes: &[u8]) {
        let Some(disturbance) = &mut self.disturbance else {
            return self.received.extend(bytes);
        };
        for byte in bytes {
            self.piece.push(*byte);
            // A zero before a frame is a separate piece.
            if *byte == 0 && self.piece.len() > 1 {
                let piece = std::mem::take(&mut self.piece);
                self.received.push_back(0);
                self.received.extend(disturbance.pass(&piece).concat());
            } else if *byte == 0 {
                self.piece.clear();
                self.received.push_back(0);
            }
        }
    }
}

impl Line for Connection {
    fn send(&mut self, frame: &[u8]) {
        self.deadline = Instant::now() + self.answer;
        let Some(port) = &mut self.port else { return };
        let written = match &mut self.disturbance {
            Some(disturbance) => disturbance.pass(frame).iter().all(|frame| port.write(frame)),
            None => port.write(frame),
        };
        if !written {
            self.port = None;
        }
    }
}

impl Wait for Connection {
    fn byte(&mut self) -> Option<u8> {
        self.byte_until(self.deadline)
    }
}
