//! How threads hand each other the poses of guests, once in a step.
//!
//! `(poses of a share's bodies, what others wait for) => poses of its guests`. A thread that waits looks again and
//! again, for as long as a step of a few bodies takes, and then lets others have its core now and then.

use std::hint::spin_loop;
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::thread::yield_now;

use dbd_kernel::Real;

use super::share::Share;
use super::table::Table;

/// Looks before a core is let to others.
const LOOKS: u32 = 10_000;

/// Poses of some bodies, one after the other.
type Poses<N, const NUMBERS: usize> = Vec<[N; NUMBERS]>;

/// What a share hands to others, and takes from them.
pub(super) struct Links<N, const NUMBERS: usize> {
    /// To whom, and the bodies, counted from the share's first.
    to: Vec<(Sender<Poses<N, NUMBERS>>, Vec<usize>)>,
    /// From whom, and the guests, counted from the share's first.
    from: Vec<(Receiver<Poses<N, NUMBERS>>, Vec<usize>)>,
}

impl<N: Real, const NUMBERS: usize> Links<N, NUMBERS> {
    /// Links between all shares that have guests of each other.
    pub(super) fn all(shares: &[Share]) -> Vec<Self> {
        let none = || Self { to: Vec::new(), from: Vec::new() };
        let mut links: Vec<_> = shares.iter().map(|_| none()).collect();
        for (taker, takes) in shares.iter().enumerate() {
            for (giver, gives) in shares.iter().enumerate() {
                let guests = takes.guests.iter().enumerate();
                let guests = guests.filter(|(_, body)| gives.bodies.contains(body));
                let (rows, bodies): (Vec<_>, Vec<_>) =
                    guests.map(|(row, body)| (row, body - gives.bodies.start)).unzip();
                if !rows.is_empty() {
                    let (to, from) = channel();
                    links[giver].to.push((to, bodies));
                    links[taker].from.push((from, rows));
                }
            }
        }
        links
    }

    /// Hands over the poses of bodies, which begin at a row of a table, and waits for those of guests, which begin at
    /// another. Whether all came.
    pub(super) fn exchange(
        &self,
        poses: &mut Table<N, NUMBERS>,
        (bodies, guests): (usize, usize),
    ) -> bool {
        for (to, rows) in &self.to {
            let poses = rows.iter().map(|row| poses.row(bodies + row)).collect();
            // Who takes no more has broken off, which its thread tells.
            let _ = to.send(poses);
        }
        for (from, rows) in &self.from {
            let Some(taken) = wait(from) else { return false };
            for (row, pose) in rows.iter().zip(taken) {
                poses.set_row(guests + row, pose);
            }
        }
        true
    }
}

fn wait<T>(from: &Receiver<T>) -> Option<T> {
    let mut looks = 0;
    loop {
        match from.try_recv() {
            Ok(taken) => return Some(taken),
            Err(TryRecvError::Disconnected) => return None,
            Err(TryRecvError::Empty) if looks < LOOKS => {
                looks += 1;
                spin_loop();
            }
            Err(TryRecvError::Empty) => yield_now(),
        }
    }
}
