//! A ring buffer of states for going back.
//!
//! `(state, settings, changes) => mark; mark => session as it was`.

use crate::refused::Refused;
use crate::session::kept::Mark;
use crate::session::live::Session;

/// Maximum number of marks; the oldest is dropped first.
pub const MAX_MARKS: usize = 600;
/// \[byte\] total size, at least two marks.
const MAX_BYTES: usize = 64_000_000;

impl Session {
    /// Saves the present state; returns the number of marks and \[s\] the times of the oldest and the newest. A failed
    /// state is not saved.
    pub fn mark(&mut self) -> (usize, [f64; 2]) {
        if let Ok(snapshot) = self.instance.plant().snapshot() {
            let newest = self.marks.0.back().map(|mark| mark.time);
            let time = self.instance.time();
            if newest != Some(time) && self.run_failure.is_none() {
                let room =
                    (MAX_BYTES / (snapshot.len() + self.asked.text.len())).clamp(2, MAX_MARKS);
                while self.marks.0.len() >= room {
                    self.marks.0.pop_front();
                }
                self.marks.0.push_back(Mark {
                    time,
                    asked: self.asked.clone(),
                    snapshot,
                    disturbed: self.disturbed,
                    work: self.work,
                    inputs_set: self.inputs_set.len(),
                });
            }
        }
        let time = |mark: Option<&Mark>| mark.map_or(self.instance.time(), |mark| mark.time);
        (self.marks.0.len(), [time(self.marks.0.front()), time(self.marks.0.back())])
    }

    /// Goes back to a mark, 0 the oldest, with its settings and numbers; drops later ones and clears a failure.
    ///
    /// # Errors
    /// Where there is no such mark.
    pub fn rewind(&mut self, mark: usize) -> Result<(), Refused> {
        let count = self.marks.0.len();
        let Some(kept) = self.marks.0.get(mark).cloned() else {
            return Err(Refused::new(
                format!("there is no mark {mark}"),
                format!("there are {count} marks"),
            ));
        };
        if kept.asked != self.asked {
            let instance = kept.asked.instance()?;
            let old = std::mem::replace(self, Self::of(kept.asked, instance));
            if old.instance.outputs() == self.instance.outputs() {
                self.watched = old.watched;
            }
            (self.marks, self.inputs_set) = (old.marks, old.inputs_set);
            self.energy_at_start = old.energy_at_start;
        }
        self.instance.restore(&kept.snapshot)?;
        self.inputs_set.truncate(kept.inputs_set);
        (self.disturbed, self.work, self.run_failure, self.grab) =
            (kept.disturbed, kept.work, None, None);
        self.marks.0.truncate(mark + 1);
        Ok(())
    }

    /// The state as `Plant::restore` of firmware, `dbd.Plant.restore` of Python and [`Self::restore`] accept it.
    ///
    /// # Errors
    /// Where the plant has failed.
    pub fn save(&self) -> Result<Vec<u8>, Refused> {
        let failed =
            |error| Refused::new(format!("there is no state to keep: {error}"), "reset it first");
        self.instance.plant().snapshot().map_err(failed)
    }

    /// Continues from a saved state of any machine.
    ///
    /// # Errors
    /// Where it is of another scene, scheme, precision or step; nothing is changed then.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), Refused> {
        self.instance.restore(bytes)?;
        // Recorded inputs belong to the previous run.
        self.inputs_set.clear();
        (self.disturbed, self.run_failure, self.grab) = (true, None, None);
        Ok(())
    }
}
