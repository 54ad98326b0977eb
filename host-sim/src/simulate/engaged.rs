//! Engagements of stops, ropes and contacts in a run.
//!
//! `(scene; plant at each look) => engagements`. An interaction is engaged while its quantity `depth` is above 0.
//! Engagements between two checks are not detected.

use dbd_kernel::laws::Laws as _;
use dbd_kernel::readouts::{Reading, Readout};
use dbd_kernel::{F64, LawIndex};
use dbd_plant::AnyPlant;
use dbd_plant::digits::significant;
use dbd_plant::time::{display, rounded};
use dbd_scene::Scene;
use serde::Serialize;

/// The engagements of an interaction with a depth, checked at the samples and about a thousand times per run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Engagement {
    /// Its name in messages: ``limits `hinge.limits` (world–leaf)``.
    pub interaction: String,
    /// \[s\] when it was first engaged.
    pub first: f64,
    /// Number of engagements, the start included.
    pub times: u32,
    /// \[1\] the fraction of the checks at which it was engaged.
    pub share: f64,
    /// \[`unit`\] the largest depth.
    pub depth: f64,
    /// `m` or `rad`.
    pub unit: &'static str,
    /// \[s\] when it was deepest.
    pub time: f64,
    /// \[s\] since when it is free; `None` where it is engaged at the end.
    pub free_since: Option<f64>,
}

impl Engagement {
    /// The report for people.
    #[must_use]
    pub fn words(&self) -> String {
        let time = |time: f64| display(rounded(time, 6));
        let times = match self.times {
            1 => format!("once, at t = {}", time(self.first)),
            times => format!("{times} times, first at t = {}", time(self.first)),
        };
        let free = self.free_since.map_or_else(
            || "engaged at the end".to_owned(),
            |since| format!("free since t = {}", time(since)),
        );
        format!(
            "{}: {times}, for {} % of the run, up to {} {} deep at t = {}; {free}",
            self.interaction,
            significant(100.0 * self.share, 3),
            significant(self.depth, 4),
            self.unit,
            time(self.time),
        )
    }
}

/// Monitors the depths of a scene's interactions.
pub(super) struct Engagements {
    watched: Vec<Watched>,
    looks: u32,
}

struct Watched {
    readout: Readout<F64>,
    looks: u32,
    engaged: bool,
    /// The engagements so far.
    seen: Engagement,
}

impl Engagements {
    /// Those of a scene, before its run.
    pub(super) fn new(scene: &Scene) -> Self {
        let labels = dbd_scene::interactions(scene);
        let mut watched = Vec::new();
        let laws = &scene.stepped().laws;
        laws.look_at_all(&laws.states(), &mut |row, law| {
            let mut quantities = law.quantities().iter().enumerate();
            let depth = quantities.find(|(_, quantity)| quantity.name == "depth");
            watched.extend(depth.map(|(place, quantity)| Watched {
                readout: Readout::Law { law: LawIndex(row as u16), quantity: place as u8 },
                looks: 0,
                engaged: false,
                seen: Engagement {
                    interaction: labels.get(row).map(|info| info.label.clone()).unwrap_or_default(),
                    first: 0.0,
                    times: 0,
                    share: 0.0,
                    depth: 0.0,
                    unit: quantity.unit,
                    time: 0.0,
                    free_since: None,
                },
            }));
        });
        Self { watched, looks: 0 }
    }

    /// Records a check of the plant.
    pub(super) fn look(&mut self, plant: &dyn AnyPlant) {
        self.looks += 1;
        let time = plant.time();
        for Watched { readout, looks, engaged, seen } in &mut self.watched {
            let Some(Reading::Scalar(depth)) = plant.read(readout) else { continue };
            let before = std::mem::replace(engaged, depth > 0.0);
            if *engaged {
                *looks += 1;
                if seen.times == 0 {
                    seen.first = time;
                }
                if !before {
                    seen.times += 1;
                    seen.free_since = None;
                }
                if depth > seen.depth {
                    (seen.depth, seen.time) = (depth, time);
                }
            } else if before {
                seen.free_since = Some(time);
            }
        }
    }

    /// The interactions that were engaged, in the order of the scene.
    pub(super) fn found(&self) -> Vec<Engagement> {
        let engaged = self.watched.iter().filter(|one| one.seen.times > 0);
        let share = |looks: u32| f64::from(looks) / f64::from(self.looks);
        engaged.map(|one| Engagement { share: share(one.looks), ..one.seen.clone() }).collect()
    }
}
