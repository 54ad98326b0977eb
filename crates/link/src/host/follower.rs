//! The local model of a remote plant: it takes the same steps with the same inputs and is compared bit for bit.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::device::Device;
use crate::host::plant::HostPlant;
use crate::message::{MAX_CHANGES, Outputs, Values};

/// The local model of a remote plant.
pub struct Follower {
    model: HostPlant,
    /// The inputs of sent frames, by sequence number.
    sent: BTreeMap<u32, Values>,
    /// Frames compared completely.
    pub compared: u64,
    /// Frames that could not be compared because the plant's inputs are unknown.
    pub unknown: u64,
    /// Frames that differ.
    pub different: u64,
    /// The first difference.
    pub first: Option<Difference>,
}

/// A difference between plant and model.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// Steps since t = 0.
    pub step: u64,
    /// The sensor's name, `hash` of the state or `status`.
    pub what: String,
    /// The plant's.
    pub plant: String,
    /// The model's.
    pub model: String,
}

/// The result of comparing a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Followed {
    /// All bits are equal.
    Equal,
    /// A bit differs.
    Different,
    /// The model cannot follow: it needs the plant's state.
    Unknown,
}

impl Follower {
    /// A follower with the present state of a model.
    #[must_use]
    pub fn new(model: HostPlant) -> Self {
        let sent = BTreeMap::new();
        Self { model, sent, compared: 0, unknown: 0, different: 0, first: None }
    }

    /// The model.
    #[must_use]
    pub fn model(&self) -> &HostPlant {
        &self.model
    }

    /// Stores the inputs of a sent frame.
    pub fn note(&mut self, sequence: u32, values: &Values) {
        self.sent.insert(sequence, values.clone());
    }

    /// Takes the steps up to a frame of outputs and compares.
    pub fn follow(&mut self, outputs: &Outputs) -> Followed {
        if !self.reach(outputs) {
            self.unknown += 1;
            return Followed::Unknown;
        }
        self.compared += 1;
        match self.difference(outputs) {
            None => Followed::Equal,
            Some(difference) => {
                self.different += 1;
                self.first.get_or_insert(difference);
                Followed::Different
            }
        }
    }

    /// Whether the model took the steps up to these outputs.
    fn reach(&mut self, outputs: &Outputs) -> bool {
        let start = self.model.step();
        if outputs.step < start {
            return false;
        }
        let oldest = outputs.changes.first();
        if outputs.changes.len() == MAX_CHANGES && oldest.is_some_and(|old| old.step > start) {
            return false;
        }
        let zero: Values = self.model.inputs().iter().map(|_| 0.0).collect();
        let new = outputs.changes.iter().filter(|change| {
            // Changes after these outputs apply from the next step.
            (start..outputs.step).contains(&change.step)
        });
        let mut changes = Vec::new();
        for change in new {
            let values =
                if change.sequence == 0 { Some(&zero) } else { self.sent.get(&change.sequence) };
            let Some(values) = values else { return false };
            changes.push((change.step, values.clone()));
        }
        for (step, values) in changes {
            self.advance_to(step);
            values.iter().enumerate().for_each(|(i, value)| _ = self.model.set(i, *value));
        }
        self.advance_to(outputs.step);
        if let Some(oldest) = oldest.filter(|oldest| oldest.sequence > 0) {
            self.sent = self.sent.split_off(&oldest.sequence);
        }
        true
    }

    fn advance_to(&mut self, step: u64) {
        while self.model.step() < step && self.model.running() {
            let left = step - self.model.step();
            self.model.advance(u32::try_from(left).unwrap_or(u32::MAX));
        }
    }

    fn difference(&self, outputs: &Outputs) -> Option<Difference> {
        let differing = |what: &str, plant: String, model: String| {
            Some(Difference { step: outputs.step, what: what.to_owned(), plant, model })
        };
        let status = |running: bool| if running { "running" } else { "failed" }.to_owned();
        if outputs.running != self.model.running() || outputs.step != self.model.step() {
            return differing("status", status(outputs.running), status(self.model.running()));
        }
        let hash = self.model.hash();
        if outputs.hash != hash {
            return differing("hash", format!("{:016x}", outputs.hash), format!("{hash:016x}"));
        }
        if self.model.compares_values() {
            let mut values = Values::new();
            self.model.read(&mut values);
            let pairs = outputs.values.iter().zip(&values).zip(self.model.sensors());
            for ((plant, model), name) in pairs {
                let same = plant.to_bits() == model.to_bits() || (plant.is_nan() && model.is_nan());
                if !same {
                    return differing(name, plant.to_string(), model.to_string());
                }
            }
        }
        None
    }

    /// The model's state; `None` if it has failed.
    #[must_use]
    pub fn save(&self) -> Option<Vec<u8>> {
        self.model.plant().snapshot().ok()
    }

    /// Continues from the plant's state; returns whether it was accepted.
    pub fn restore(&mut self, bytes: &[u8]) -> bool {
        self.model.restore(bytes)
    }
}
