//! Where the parts of a large model lie in lanes.
//!
//! `(ends of the joints, lanes) => order of the joints, rows that each register takes`. Only numbers of rows. Joints may
//! lie in any order, for each writes what it does to either body to a place of its own; a body then adds what the
//! joints did to it in the order of the joints. They are sorted so that neighbours take neighbours: rows that follow
//! one another are a load, others are gathered one by one.

/// What the lanes of a register take.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Rows {
    /// Rows that follow one another, from this one on.
    Run(u32),
    /// A row for each lane.
    Each(Box<[u32]>),
}

impl Rows {
    /// Of lanes of which the last may be `None`, and may take anything.
    fn new(rows: &[Option<u32>], none: u32) -> Self {
        let first = rows.first().copied().flatten().unwrap_or(none);
        if (first..).zip(rows).all(|(next, row)| row.is_none_or(|row| row == next)) {
            return Self::Run(first);
        }
        Self::Each(rows.iter().map(|row| row.unwrap_or(none)).collect())
    }
}

/// The places of a model's joints and bodies.
pub(super) struct Plan {
    /// The joint in each place, `None` where a lane has none; whole registers.
    pub(super) joints: Vec<Option<usize>>,
    /// The rows of the first and the second bodies, a register each.
    pub(super) ends: Vec<[Rows; 2]>,
    /// What is added to the bodies' wrenches, one of each register's bodies after the other.
    pub(super) added: Vec<Vec<Rows>>,
    /// Rows of bodies.
    pub(super) bodies: usize,
    /// Rows of what joints do: to all first bodies, to all second ones, and nothing.
    pub(super) done: usize,
}

impl Plan {
    /// Of joints between the ground, `None`, or a body and a body, of as many `bodies`.
    pub(super) fn new(joints: &[(Option<usize>, usize)], bodies: usize, lanes: usize) -> Self {
        // The ground is the row before the first body: a chain's first bodies are then a row before its second ones.
        let row = |body: Option<usize>| (body.map_or(lanes - 1, |body| lanes + body)) as u32;
        let rows = |joint: usize| [row(joints[joint].0), row(Some(joints[joint].1))];
        let mut order: Vec<usize> = (0..joints.len()).collect();
        order.sort_by_key(|&joint| {
            let [a, b] = rows(joint);
            (i64::from(b) - i64::from(a), a)
        });
        let places = joints.len().div_ceil(lanes) * lanes;
        let mut order: Vec<_> = order.into_iter().map(Some).collect();
        order.resize(places, None);
        let end = |registers: &[Option<usize>], end: usize| {
            let rows: Vec<_> = registers.iter().map(|joint| joint.map(|joint| rows(joint)[end])).collect();
            Rows::new(&rows, row(None))
        };
        let ends = order.chunks(lanes).map(|joints| [end(joints, 0), end(joints, 1)]).collect();

        // Idle lanes of the last register write as others do, and are never read as a run.
        let second = places + lanes;
        let nothing = 2 * second;
        let mut place = vec![0; joints.len()];
        order.iter().enumerate().for_each(|(at, joint)| {
            if let Some(joint) = *joint {
                place[joint] = at;
            }
        });
        let mut added = vec![Vec::new(); bodies];
        for (joint, &(a, b)) in joints.iter().enumerate() {
            if let Some(a) = a {
                added[a].push(place[joint] as u32);
            }
            added[b].push((second + place[joint]) as u32);
        }
        let added = added.chunks(lanes).map(|bodies| {
            let most = bodies.iter().map(Vec::len).max().unwrap_or(0);
            let of = |turn: usize| {
                let nothing = nothing as u32;
                let rows = |body: &Vec<u32>| Some(body.get(turn).copied().unwrap_or(nothing));
                let mut rows: Vec<_> = bodies.iter().map(rows).collect();
                rows.resize(lanes, None);
                Rows::new(&rows, nothing)
            };
            (0..most).map(of).collect()
        });
        let added = added.collect();
        let bodies = lanes + bodies.div_ceil(lanes) * lanes;
        Self { joints: order, ends, added, bodies, done: nothing + lanes }
    }
}
