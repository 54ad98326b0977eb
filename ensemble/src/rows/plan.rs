//! Where the parts of a large model lie in lanes.
//!
//! `(ends of the joints, share, lanes) => order of the joints, rows that each register takes`. Only numbers of rows. Joints may
//! lie in any order, for each writes what it does to either body to a row of its own; a body then adds what the joints
//! did to it in the order of the joints. They are sorted so that neighbours take neighbours: rows that follow one
//! another are a load. Others are copied first to rows that do.

use std::ops::Range;

use super::share::{Ends, Share};

/// The rows of a table, and which of them are copies.
pub(super) struct Layout {
    /// The rows that are written.
    pub(super) written: usize,
    /// The rows whose copies follow those that are written.
    pub(super) copied: Vec<u32>,
    lanes: usize,
}

impl Layout {
    fn new(written: usize, lanes: usize) -> Self {
        Self { written, copied: Vec::new(), lanes }
    }

    /// The first of the rows that a register takes; what is `None` may be any row.
    fn take(&mut self, rows: &[Option<u32>], none: u32) -> u32 {
        let first = rows.first().copied().flatten().unwrap_or(none);
        if (first..).zip(rows).all(|(next, row)| row.is_none_or(|row| row == next)) {
            return first;
        }
        let first = self.written + self.copied.len();
        self.copied.extend(rows.iter().map(|row| row.unwrap_or(none)));
        first as u32
    }

    /// All rows, and a register beyond: where some lanes take any row there may be none.
    pub(super) fn rows(&self) -> usize {
        self.written + self.copied.len() + self.lanes
    }
}

/// Registers of joints, and those of bodies on which no joint is left to act once these have: they may move while
/// what acted on them is at hand.
pub(super) struct Batch {
    /// Registers of joints.
    pub(super) joints: Range<usize>,
    /// The copies that these joints take.
    pub(super) poses: Range<usize>,
    /// Registers of bodies.
    pub(super) bodies: Range<usize>,
    /// The copies that these bodies take.
    pub(super) done: Range<usize>,
}

/// Registers of joints of a batch.
const BATCH: usize = 16;

/// The batches of registers of joints and bodies: the last register of joints that acts on each register of bodies,
/// and of both kinds the copies before each.
fn batches(last: &[usize], poses: &[usize], done: &[usize]) -> Vec<Batch> {
    let (joints, bodies) = (poses.len() - 1, done.len() - 1);
    let mut next = 0;
    let batch = |first: usize| {
        let end = joints.min(first + BATCH);
        let begin = next;
        let ready = last[begin..].iter().take_while(|&&last| last < end || end == joints);
        next += ready.count();
        Batch {
            joints: first..end,
            poses: poses[first]..poses[end],
            bodies: begin..next,
            done: done[begin]..done[next],
        }
    };
    debug_assert_eq!(last.len(), bodies);
    (0..joints.max(1)).step_by(BATCH).map(batch).collect()
}

/// The places of a model's joints and bodies.
pub(super) struct Plan {
    /// The joint in each place, `None` where a lane has none; whole registers.
    pub(super) joints: Vec<Option<usize>>,
    /// The first rows of the first and of the second bodies, of each register of joints.
    pub(super) ends: Vec<[u32; 2]>,
    /// The first rows of what is added to bodies, one after the other, of each register of bodies.
    pub(super) added: Vec<Box<[u32]>>,
    /// Poses: idle rows, the last of which is the ground, then those of the bodies and, from `guests` on, of guests.
    pub(super) poses: Layout,
    pub(super) guests: usize,
    /// What joints do to their first bodies, to their second ones, and nothing.
    pub(super) done: Layout,
    pub(super) batches: Vec<Batch>,
}

impl Plan {
    /// How many rows are copied in a step of a model on one thread.
    pub(super) fn copies(joints: &[Ends], bodies: usize, lanes: usize) -> usize {
        let copies = |share| {
            let plan = Self::new(joints, share, lanes);
            plan.poses.copied.len() + plan.done.copied.len()
        };
        Share::all(joints, bodies, 1).iter().map(copies).sum()
    }

    /// Of a share of a model's joints and bodies.
    pub(super) fn new(all: &[Ends], share: &Share, lanes: usize) -> Self {
        let bodies = share.bodies.len();
        let guests = lanes + bodies.div_ceil(lanes) * lanes;
        let own = |body: usize| share.bodies.contains(&body).then(|| body - share.bodies.start);
        // The ground is the row before the first body: a chain's first bodies are then a row before its second ones.
        let row = |body: Option<usize>| {
            let guest = |body: usize| guests + share.guests.partition_point(|&guest| guest < body);
            let of = |body: usize| own(body).map_or_else(|| guest(body), |row| lanes + row);
            body.map_or(lanes - 1, of) as u32
        };
        let rows = |joint: usize| [row(all[joint].0), row(Some(all[joint].1))];
        let mut order = share.joints.clone();
        order.sort_by_key(|&joint| {
            let [a, b] = rows(joint);
            (i64::from(b) - i64::from(a), a)
        });
        let places = order.len().div_ceil(lanes) * lanes;
        // In idle lanes joints write, too.
        let second = places + lanes;
        let nothing = 2 * second;
        let mut added = vec![Vec::new(); bodies];
        let mut last = vec![0; bodies.div_ceil(lanes)];
        let mut place: Vec<_> = order.iter().copied().zip(0_u32..).collect();
        place.sort_unstable();
        for (joint, place) in place {
            let (a, b) = all[joint];
            for (body, row) in [(a, place), (Some(b), second as u32 + place)] {
                if let Some(body) = body.and_then(own) {
                    added[body].push(row);
                    let last = &mut last[body / lanes];
                    *last = (*last).max(place as usize / lanes);
                }
            }
        }

        let mut poses = Layout::new(guests + share.guests.len(), lanes);
        let mut order: Vec<_> = order.into_iter().map(Some).collect();
        order.resize(places, None);
        let mut copies_of_joints = vec![0];
        let ends = order.chunks(lanes).map(|joints| {
            let ends = [0, 1].map(|end| {
                let rows = joints.iter().map(|joint| joint.map(|joint| rows(joint)[end]));
                poses.take(&rows.collect::<Vec<_>>(), row(None))
            });
            copies_of_joints.push(poses.copied.len());
            ends
        });
        let ends = ends.collect();
        let mut done = Layout::new(nothing + lanes, lanes);
        let mut copies_of_bodies = vec![0];
        let added = added.chunks(lanes).map(|bodies| {
            let most = bodies.iter().map(Vec::len).max().unwrap_or(0);
            let of = |turn: usize| {
                let nothing = nothing as u32;
                let row = |body: &Vec<u32>| Some(body.get(turn).copied().unwrap_or(nothing));
                let mut rows: Vec<_> = bodies.iter().map(row).collect();
                rows.resize(lanes, None);
                done.take(&rows, nothing)
            };
            let added = (0..most).map(of).collect();
            copies_of_bodies.push(done.copied.len());
            added
        });
        let added = added.collect();
        let batches = batches(&last, &copies_of_joints, &copies_of_bodies);
        Self { joints: order, ends, added, poses, guests, done, batches }
    }
}
