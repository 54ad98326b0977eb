//! What each thread has of a large model.
//!
//! `(ends of the joints, bodies, threads) => bodies, joints and guests of each thread`. A thread has bodies that follow
//! one another, and every joint that acts on one of them: a joint across a border is two threads' and does the same
//! in both, so that only poses cross it. The bodies of others at the ends of such joints are a thread's guests.

use std::ops::Range;

/// The ends of a joint: a body or the ground, and a body.
pub(super) type Ends = (Option<usize>, usize);

/// The bodies of a model as joints come to them, one joint after the other; those without joints last.
pub(super) fn along_joints(joints: &[Ends], bodies: usize) -> Vec<usize> {
    let mut is_new = vec![true; bodies];
    let ends = joints.iter().flat_map(|&(a, b)| a.into_iter().chain([b])).chain(0..bodies);
    ends.filter(|&body| std::mem::take(&mut is_new[body])).collect()
}

/// Joints between bodies by their places in an order.
pub(super) fn in_order(joints: &[Ends], order: &[usize]) -> Vec<Ends> {
    let mut places = vec![0; order.len()];
    order.iter().enumerate().for_each(|(place, &body)| places[body] = place);
    joints.iter().map(|&(a, b)| (a.map(|a| places[a]), places[b])).collect()
}

/// A thread's part of a model.
#[derive(Debug, PartialEq)]
pub(super) struct Share {
    /// The bodies that it moves.
    pub(super) bodies: Range<usize>,
    /// The joints that act on them, in ascending order.
    pub(super) joints: Vec<usize>,
    /// The bodies of others that these joints act on, in ascending order.
    pub(super) guests: Vec<usize>,
}

impl Share {
    /// The shares of a model: as many as there are threads, none without a body.
    pub(super) fn all(joints: &[Ends], bodies: usize, threads: usize) -> Vec<Self> {
        let threads = threads.clamp(1, bodies.max(1));
        let border = |thread: usize| bodies * thread / threads;
        (0..threads).map(|thread| Self::new(joints, border(thread)..border(thread + 1))).collect()
    }

    fn new(all: &[Ends], bodies: Range<usize>) -> Self {
        let is_own = |body: &usize| bodies.contains(body);
        let acts = |(a, b): &Ends| a.as_ref().is_some_and(is_own) || is_own(b);
        let joints: Vec<_> = (0..all.len()).filter(|&joint| acts(&all[joint])).collect();
        let ends = joints.iter().flat_map(|&joint| all[joint].0.into_iter().chain([all[joint].1]));
        let mut guests: Vec<_> = ends.filter(|body| !is_own(body)).collect();
        guests.sort_unstable();
        guests.dedup();
        Self { bodies, joints, guests }
    }
}
