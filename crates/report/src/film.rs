//! The film of a run: frames at evenly spread samples.
//!
//! `(samples of the run, size of a frame) => which are kept; frames => packed film`. How many depends
//! on the mechanism alone: a page stays small whatever the run's length.

use crate::picture::Mechanism;

use crate::data::{Film, Trace};
use crate::loading::Forces;
use crate::packed::{F32s, F64s, I16s};

/// \[bytes\] maximum base64 size of a film, unless a single frame is larger.
const ROOM: usize = 400_000;
/// Frames of a film at most, and those of a large mechanism that are kept whatever their size,
/// within \[bytes\].
const MAX: usize = 1200;
const FEWEST: usize = 24;
const MAX_ROOM: usize = 900_000;
/// More springs of joints are left out of a film.
const MAX_JOINT_SPRINGS: usize = 400;

/// Visible state of a mechanism at a sample.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// \[s\] its time.
    pub time: f64,
    /// Per body position \[m\] and unit quaternion, scalar first, body → world.
    pub poses: Vec<([f64; 3], [f64; 4])>,
    /// Per joint \[N\] the force on its second body and \[m\] the largest extension of its elements.
    pub joints: Vec<[f32; 2]>,
    /// All other forces.
    pub forces: Forces,
}

/// Which samples become frames, spread evenly, the first and the last among them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spread {
    samples: u64,
    frames: u64,
}

impl Spread {
    /// At most the given number of frames for the given number of samples.
    #[must_use]
    pub fn new(samples: u64, frames: u64) -> Self {
        Self { samples: samples.max(1), frames: frames.clamp(2, samples.max(2)) }
    }

    /// For runs of a mechanism with the given number of samples.
    #[must_use]
    pub fn of(mechanism: &Mechanism, samples: u64) -> Self {
        let words = |count: usize, bytes: usize| count * bytes;
        let mut frame = 8 + words(mechanism.bodies.len(), 14) + words(mechanism.springs.len(), 4);
        frame += words(mechanism.joints.len(), 8) + words(mechanism.forces.len(), 4);
        if has_joint_springs(mechanism) {
            frame += words(mechanism.joint_springs.len(), 4);
        }
        let text = frame.div_ceil(3) * 4;
        let fewest = FEWEST.min(MAX_ROOM / text);
        Self::new(samples, (ROOM / text).max(fewest).min(MAX) as u64)
    }

    /// Whether the sample of this number, from 0 on, is kept.
    #[must_use]
    pub fn keeps(&self, sample: u64) -> bool {
        let (last, frames) = (u128::from(self.samples - 1), u128::from(self.frames - 1));
        if last <= frames {
            return true;
        }
        // The frame with the nearest sample, and that sample, rounded up at halves.
        let sample = u128::from(sample);
        let frame = (2 * sample * frames + last) / (2 * last);
        (2 * frame * last + frames) / (2 * frames) == sample
    }
}

/// Whether a film shows the springs that joints are made of.
#[must_use]
pub fn has_joint_springs(mechanism: &Mechanism) -> bool {
    mechanism.joint_springs.len() <= MAX_JOINT_SPRINGS
}

/// Packs frames; `None` if there are none.
#[must_use]
pub fn packed(frames: &[Frame], mechanism: &Mechanism, traces: Vec<Trace>) -> Option<Film> {
    let first = frames.first()?;
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    let poses = || frames.iter().flat_map(|frame| &frame.poses);
    for (position, _) in poses() {
        for (axis, value) in position.iter().enumerate().filter(|(_, value)| value.is_finite()) {
            low[axis] = low[axis].min(*value);
            high[axis] = high[axis].max(*value);
        }
    }
    for axis in 0..3 {
        if low[axis] > high[axis] {
            (low[axis], high[axis]) = (0.0, 0.0);
        }
    }
    let mut words = Vec::with_capacity(frames.len() * first.poses.len() * 7);
    for (position, orientation) in poses() {
        words.extend([0, 1, 2].map(|axis| coordinate(position[axis], low[axis], high[axis])));
        words.extend(orientation.map(|component| (component * 32767.0).round() as i16));
    }
    let all = |of: fn(&Frame) -> &[f32]| F32s(frames.iter().flat_map(of).copied().collect());
    let joint_springs = match has_joint_springs(mechanism) {
        true => all(|frame| &frame.forces.joint_springs),
        false => F32s::default(),
    };
    Some(Film {
        times: F64s(frames.iter().map(|frame| frame.time).collect()),
        bodies: first.poses.len(),
        low,
        high,
        poses: I16s(words),
        springs: all(|frame| &frame.forces.springs),
        joints: all(|frame| frame.joints.as_flattened()),
        joint_springs,
        forces: all(|frame| &frame.forces.forces),
        traces,
    })
}

/// A coordinate as a fraction between `low` and `high`.
fn coordinate(value: f64, low: f64, high: f64) -> i16 {
    let way = high - low;
    if way <= 0.0 {
        return i16::MIN + 1;
    }
    ((value - low) / way * 65534.0 - 32767.0).round() as i16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_spread_evenly_from_the_first_to_the_last_sample() {
        for (samples, frames) in [(1, 2), (2, 2), (3, 2), (501, 1200), (1201, 1200), (10_007, 300)]
        {
            let spread = Spread::new(samples, frames);
            let kept: Vec<u64> = (0..samples).filter(|sample| spread.keeps(*sample)).collect();
            assert_eq!(kept.len() as u64, samples.min(frames), "{samples} {frames}");
            assert_eq!((kept[0], kept[kept.len() - 1]), (0, samples - 1));
            let gaps = kept.windows(2).map(|pair| pair[1] - pair[0]);
            let (least, most) = (gaps.clone().min(), gaps.max());
            assert!(least.zip(most).is_none_or(|(least, most)| most - least <= 1));
        }
    }

    /// Positions within half a 65534th of the range, attitudes within a 20,000th of a radian.
    #[test]
    fn poses_are_packed_within_their_rounding() {
        let mut random = 1_u64;
        let mut next = || {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (random >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let mut frames = Vec::new();
        for frame in 0..50 {
            let mut pose = || {
                let q = [next(), next(), next(), next()];
                let size = q.iter().map(|c| c * c).sum::<f64>().sqrt();
                ([10.0 * next(), 7.0, 1e-6 * next()], q.map(|c| c / size))
            };
            let poses = vec![pose(), pose()];
            frames.push(Frame { time: f64::from(frame), poses, ..Frame::default() });
        }
        let scene = dbd_scene::Scene::parse(
            "name = \"n\"\nduration = 1\n[[body]]\nname = \"b\"\nmass = 1\ninertia = [1, 1, 1]\n\
             position = [0, 0, 0]\n",
            "n.toml",
        );
        let mechanism = Mechanism::of(&scene.unwrap());
        let film = packed(&frames, &mechanism, Vec::new()).unwrap();
        let poses = frames.iter().flat_map(|frame| &frame.poses);
        for (words, (position, orientation)) in film.poses.0.chunks(7).zip(poses) {
            for axis in 0..3 {
                let way = film.high[axis] - film.low[axis];
                let back = film.low[axis] + (f64::from(words[axis]) + 32767.0) / 65534.0 * way;
                assert!((back - position[axis]).abs() <= way / 65534.0 * 0.501, "{axis}");
            }
            let back: Vec<f64> = words[3..].iter().map(|word| f64::from(*word) / 32767.0).collect();
            let size = back.iter().map(|c| c * c).sum::<f64>().sqrt();
            let apart = orientation.iter().zip(&back).map(|(a, b)| (a - b / size).powi(2));
            // The angle is twice that of the quaternions.
            assert!(2.0 * apart.sum::<f64>().sqrt() < 7e-5);
        }
        assert_eq!(packed(&[], &mechanism, Vec::new()), None);
        // NaN does not affect other values.
        frames[3].poses[0].0[0] = f64::NAN;
        let film = packed(&frames, &mechanism, Vec::new()).unwrap();
        assert!(film.low[0].is_finite() && film.high[0].is_finite());
    }
}
