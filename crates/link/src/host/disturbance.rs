//! A line that damages, loses, repeats and reorders frames, from a seed: tests a system with a bad cable.

use std::str::FromStr;

use fastrand::Rng;
use thiserror::Error;

/// Disturbances of frames, as fractions of all frames, 0 to 1.
#[derive(Clone, Debug)]
pub struct Disturbance {
    corrupt: f64,
    drop: f64,
    duplicate: f64,
    reorder: f64,
    random: Rng,
    /// A frame that waits for the next one.
    late: Option<Vec<u8>>,
    /// Numbers of disturbed frames: corrupted, dropped, repeated, reordered.
    pub done: [u32; 4],
}

/// An invalid disturbance.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("`{0}` is not a disturbance")]
pub struct DisturbanceError(String);

impl FromStr for Disturbance {
    type Err = DisturbanceError;

    /// Reads e.g. `corrupt=1%,drop=0.01,duplicate=1%,reorder=1%,seed=7`; missing keys are 0.
    fn from_str(text: &str) -> Result<Self, DisturbanceError> {
        let refused = |part: &str| DisturbanceError(part.to_owned());
        let [mut corrupt, mut drop, mut duplicate, mut reorder] = [0.0; 4];
        let mut seed = 0;
        for part in text.split(',') {
            let (key, value) = part.split_once('=').ok_or_else(|| refused(part))?;
            if key.trim() == "seed" {
                seed = value.trim().parse().map_err(|_| refused(part))?;
                continue;
            }
            let (number, scale) = match value.trim().strip_suffix('%') {
                Some(number) => (number, 0.01),
                None => (value.trim(), 1.0),
            };
            let fraction = number.parse::<f64>().map_err(|_| refused(part))? * scale;
            if !(0.0..=1.0).contains(&fraction) {
                return Err(refused(part));
            }
            match key.trim() {
                "corrupt" => corrupt = fraction,
                "drop" => drop = fraction,
                "duplicate" => duplicate = fraction,
                "reorder" => reorder = fraction,
                _ => return Err(refused(part)),
            }
        }
        let random = Rng::with_seed(seed);
        Ok(Self { corrupt, drop, duplicate, reorder, random, late: None, done: [0; 4] })
    }
}

impl Disturbance {
    /// The pieces that arrive for a frame, in order.
    pub fn pass(&mut self, frame: &[u8]) -> Vec<Vec<u8>> {
        let mut frame = frame.to_vec();
        let waited = self.late.take();
        let is_hit = |random: &mut Rng, fraction: f64| random.f64() < fraction;
        let mut passed = Vec::new();
        if is_hit(&mut self.random, self.drop) {
            self.done[1] += 1;
        } else {
            if is_hit(&mut self.random, self.corrupt) {
                self.done[0] += 1;
                damage(&mut frame, &mut self.random);
            }
            if is_hit(&mut self.random, self.duplicate) {
                self.done[2] += 1;
                passed.push(frame.clone());
            }
            if is_hit(&mut self.random, self.reorder) {
                self.done[3] += 1;
                self.late = Some(frame);
            } else {
                passed.push(frame);
            }
        }
        passed.extend(waited);
        passed
    }
}

/// Flips a bit, writes noise over some bytes, or cuts the end off.
fn damage(frame: &mut Vec<u8>, random: &mut Rng) {
    if frame.is_empty() {
        return;
    }
    let at = random.usize(..frame.len());
    match random.u8(..3) {
        0 => frame[at] ^= 1 << random.u8(..8),
        1 => {
            let end = (at + random.usize(1..16)).min(frame.len());
            // Bytes that differ from the original ones.
            frame[at..end].iter_mut().for_each(|byte| *byte ^= random.u8(1..));
        }
        _ => frame.truncate(at),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions_are_what_they_say() {
        let mut line: Disturbance =
            "corrupt=1%,drop=0.02,duplicate=3%,reorder=4%,seed=5".parse().unwrap();
        let mut arrived = 0;
        for _ in 0..100_000 {
            arrived += line.pass(b"\0frame\0").len();
        }
        for (count, percent) in line.done.into_iter().zip([1, 2, 3, 4]) {
            assert!(count.abs_diff(percent * 1_000) < 200, "{:?}", line.done);
        }
        assert!(arrived.abs_diff(100_000 - 2_000 + 3_000) < 500, "{arrived}");
        let mut quiet: Disturbance = "seed=1".parse().unwrap();
        assert_eq!(quiet.pass(b"x"), [b"x".to_vec()]);
    }

    #[test]
    fn what_is_not_a_disturbance_is_refused() {
        for text in ["", "drop", "drop=2", "drop=-1%", "lose=0.1", "seed=x", "drop=nan"] {
            assert!(text.parse::<Disturbance>().is_err(), "{text}");
        }
    }
}
