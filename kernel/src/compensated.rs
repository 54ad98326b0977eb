//! Single precision whose state does not forget: what an addition rounds off is kept for the next.
//!
//! `(sum, lost) + increment => (sum, lost)` for positions, orientations, velocities and angular
//! velocities (Kahan, *Comm. ACM* 8, 1965). Rotations, points and forces are those of
//! [`F32`](crate::geometry::F32): what these round is noise, never a sum. Half of what is stored is
//! what was lost, so a state has twice the words. Velocities of [`Fixed`](crate::fixed::Fixed) are stored like that,
//! too, and added to with more care.

use crate::attitude::Attitude;
use crate::geometry::{Geometry, Pose};
use crate::vector::{Quaternion, Rotation, Vec3};
use crate::words::{WordSource, WordVisitor, Words};

/// Single precision with compensated sums on the state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CompensatedF32;

/// A vector that is added to: its value is `sum − lost`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Kept {
    /// \[m, m/s, rad/s\] what the additions came to.
    pub sum: Vec3<f32>,
    /// \[m, m/s, rad/s\] what they rounded up.
    pub lost: Vec3<f32>,
}

/// An orientation that is added to: its value is `sum − lost`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct KeptTurn {
    /// \[1\] what the turns came to, unit to rounding.
    pub sum: Quaternion<f32>,
    /// \[1\] what they rounded up.
    pub lost: Quaternion<f32>,
}

/// Kahan's addition. The order is what makes it: no compiler of Rust changes that.
#[inline(always)]
fn add(sum: &mut f32, lost: &mut f32, increment: f32) {
    let owed = increment - *lost;
    let new = *sum + owed;
    *lost = (new - *sum) - owed;
    *sum = new;
}

/// An addition to a number of two words (Dekker, *Numer. Math.* 18, 1971): what is below the increment's last digit
/// stays in what is lost. Kahan's rounds that off, often the same way step after step.
#[inline(always)]
fn add_to_both(sum: &mut f32, lost: &mut f32, increment: f32) {
    let new = *sum + increment;
    let owed = ((new - *sum) - increment) + *lost;
    let nearest = new - owed;
    *lost = (nearest - new) + owed;
    *sum = nearest;
}

/// A number in two words, and back.
const fn split(value: f64) -> (f32, f32) {
    let sum = value as f32;
    let lost = (sum as f64 - value) as f32;
    // What is beyond single precision has lost everything, and is refused as such.
    (sum, if lost.is_nan() || lost.is_infinite() { 0.0 } else { lost })
}

const fn joined(sum: f32, lost: f32) -> f64 {
    sum as f64 - lost as f64
}

impl Kept {
    /// A vector rounded once to two words per component.
    #[must_use]
    pub const fn from_f64(v: [f64; 3]) -> Self {
        let [x, y, z] = [split(v[0]), split(v[1]), split(v[2])];
        Self { sum: Vec3::new(x.0, y.0, z.0), lost: Vec3::new(x.1, y.1, z.1) }
    }

    /// Its value in double precision.
    #[must_use]
    pub const fn to_f64(&self) -> [f64; 3] {
        let Self { sum, lost } = self;
        [joined(sum.x, lost.x), joined(sum.y, lost.y), joined(sum.z, lost.z)]
    }

    /// Adds to both words.
    #[inline(always)]
    pub(crate) fn add_to_both(&mut self, increment: Vec3<f32>) {
        self.add_to_both_across::<3>(increment);
    }

    /// The same but for component `AXIS`.
    #[inline(always)]
    pub(crate) fn add_to_both_across<const AXIS: usize>(&mut self, increment: Vec3<f32>) {
        let Self { sum, lost } = self;
        if AXIS != 0 {
            add_to_both(&mut sum.x, &mut lost.x, increment.x);
        }
        if AXIS != 1 {
            add_to_both(&mut sum.y, &mut lost.y, increment.y);
        }
        if AXIS != 2 {
            add_to_both(&mut sum.z, &mut lost.z, increment.z);
        }
    }

    #[inline(always)]
    fn add(&mut self, increment: Vec3<f32>) {
        add(&mut self.sum.x, &mut self.lost.x, increment.x);
        add(&mut self.sum.y, &mut self.lost.y, increment.y);
        add(&mut self.sum.z, &mut self.lost.z, increment.z);
    }
}

impl Words for Kept {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.sum.visit(visitor);
        self.lost.visit(visitor);
    }

    fn fill(&mut self, source: &mut impl WordSource) {
        self.sum.fill(source);
        self.lost.fill(source);
    }
}

impl Words for KeptTurn {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.sum.visit(visitor);
        self.lost.visit(visitor);
    }

    fn fill(&mut self, source: &mut impl WordSource) {
        self.sum.fill(source);
        self.lost.fill(source);
    }
}

/// Which share of an orientation's length beyond 1 a drift takes back: the length is known to
/// rounding only, and what is wrong about it would be noise.
const GENTLE: f32 = 1.0 / 64.0;
/// Beyond this it is no rounding, and goes at once.
const ROUNDING: f32 = 1e-5;

impl KeptTurn {
    #[inline(always)]
    fn add(&mut self, w: f32, v: Vec3<f32>) {
        add(&mut self.sum.w, &mut self.lost.w, w);
        add(&mut self.sum.v.x, &mut self.lost.v.x, v.x);
        add(&mut self.sum.v.y, &mut self.lost.v.y, v.y);
        add(&mut self.sum.v.z, &mut self.lost.v.z, v.z);
    }
}

/// cos − 1 of a turn whose sine has the square `square`: the difference itself would keep nothing
/// of a small turn.
#[inline(always)]
fn less_one(cos: f32, square: f32) -> f32 {
    -(square / (1.0 + cos))
}

impl Attitude for KeptTurn {
    type Real = f32;
    type Turn = Quaternion<f32>;

    const NAME: &'static str = "quaternion";

    #[inline(always)]
    fn rotation(&self) -> Rotation<f32> {
        self.sum.rotation()
    }
    #[inline(always)]
    fn quaternion(&self) -> Quaternion<f32> {
        self.sum
    }
    #[inline(always)]
    fn since_world(&self) -> Quaternion<f32> {
        self.sum
    }
    #[inline(always)]
    fn turn(&mut self, turn: Quaternion<f32>) {
        let less = less_one(turn.w, turn.v.dot(turn.v));
        let change = self.sum.product(Quaternion { w: less, v: turn.v });
        self.add(change.w, change.v);
    }
    #[inline(always)]
    fn turn_about<const AXIS: usize>(&mut self, cos: f32, sin: f32) {
        let less = less_one(cos, sin * sin);
        let (w, Vec3 { x, y, z }) = (self.sum.w, self.sum.v);
        let turned = |along: f32, across: f32| along * less + across;
        match AXIS {
            0 => self.add(
                turned(w, -(x * sin)),
                Vec3::new(turned(x, w * sin), turned(y, z * sin), turned(z, -(y * sin))),
            ),
            1 => self.add(
                turned(w, -(y * sin)),
                Vec3::new(turned(x, -(z * sin)), turned(y, w * sin), turned(z, x * sin)),
            ),
            _ => self.add(
                turned(w, -(z * sin)),
                Vec3::new(turned(x, y * sin), turned(y, -(x * sin)), turned(z, w * sin)),
            ),
        }
    }
    #[inline(always)]
    fn renormalise(&mut self) {
        let Quaternion { w, v } = self.sum;
        let beyond = (w * w - 1.0) + v.dot(v);
        let share = if !(-ROUNDING..=ROUNDING).contains(&beyond) { 0.5 } else { GENTLE };
        let back = -(share * beyond);
        self.add(w * back, v * back);
    }
    fn from_f64(orientation: [f64; 4]) -> Self {
        let [w, x, y, z] = orientation;
        let ((w, lost), v) = (split(w), Kept::from_f64([x, y, z]));
        Self { sum: Quaternion { w, v: v.sum }, lost: Quaternion { w: lost, v: v.lost } }
    }
    fn to_f64(&self) -> [f64; 4] {
        let Self { sum, lost } = self;
        let [x, y, z] = Kept { sum: sum.v, lost: lost.v }.to_f64();
        [joined(sum.w, lost.w), x, y, z]
    }
}

impl Geometry for CompensatedF32 {
    type Real = f32;
    type Vector = Vec3<f32>;
    type Moment = Vec3<f32>;
    type Space = f32;
    type Position = Kept;
    type Orientation = KeptTurn;
    type Velocity = Kept;
    type Spin = Kept;
    type Local = Vec3<f32>;
    type Location = Vec3<f32>;
    type Frame = Pose<f32>;
    type Rest = ();
    type Apart = ();
    type PassSum = ();

    const NAME: &'static str = "f32-compensated";

    #[inline(always)]
    fn frame(position: &Kept, orientation: &KeptTurn) -> Pose<f32> {
        Pose { position: position.sum, rotation: orientation.rotation() }
    }
    #[inline(always)]
    fn place(frame: &Pose<f32>, local: &Vec3<f32>) -> (Vec3<f32>, Vec3<f32>) {
        let arm = frame.rotation.to_world(*local);
        (frame.position + arm, arm)
    }
    #[inline(always)]
    fn ground(local: &Vec3<f32>) -> Vec3<f32> {
        *local
    }
    #[inline(always)]
    fn shift(location: &Vec3<f32>, by: Vec3<f32>) -> Vec3<f32> {
        *location + by
    }
    #[inline(always)]
    fn displacement(from: &Vec3<f32>, to: &Vec3<f32>) -> Vec3<f32> {
        *to - *from
    }
    #[inline(always)]
    fn to_world(frame: &Pose<f32>, v: Vec3<f32>) -> Vec3<f32> {
        frame.rotation.to_world(v)
    }
    #[inline(always)]
    fn to_body(frame: &Pose<f32>, v: Vec3<f32>) -> Vec3<f32> {
        frame.rotation.to_body(v)
    }
    #[inline(always)]
    fn moment_to_world(frame: &Pose<f32>, m: Vec3<f32>) -> Vec3<f32> {
        frame.rotation.to_world(m)
    }
    #[inline(always)]
    fn moment_to_body(frame: &Pose<f32>, m: Vec3<f32>) -> Vec3<f32> {
        frame.rotation.to_body(m)
    }
    #[inline(always)]
    fn position(stored: &Kept) -> Vec3<f32> {
        stored.sum
    }
    #[inline(always)]
    fn velocity(stored: &Kept) -> Vec3<f32> {
        stored.sum
    }
    #[inline(always)]
    fn spin(stored: &Kept) -> Vec3<f32> {
        stored.sum
    }
    #[inline(always)]
    fn accelerate(stored: &mut Kept, increment: Vec3<f32>) {
        stored.add(increment);
    }
    #[inline(always)]
    fn spin_up(stored: &mut Kept, increment: Vec3<f32>) {
        stored.add(increment);
    }
    #[inline(always)]
    fn translate(position: &mut Kept, displacement: Vec3<f32>) {
        position.add(displacement);
    }
    fn position_from_f64(position: [f64; 3]) -> Kept {
        Kept::from_f64(position)
    }
    fn position_to_f64(position: &Kept) -> [f64; 3] {
        position.to_f64()
    }
    fn velocity_from_f64(velocity: [f64; 3]) -> Kept {
        Kept::from_f64(velocity)
    }
    fn velocity_to_f64(velocity: &Kept) -> [f64; 3] {
        velocity.to_f64()
    }
    fn spin_from_f64(spin: [f64; 3]) -> Kept {
        Kept::from_f64(spin)
    }
    fn spin_to_f64(spin: &Kept) -> [f64; 3] {
        spin.to_f64()
    }
    fn local_from_f64(local: [f64; 3]) -> Vec3<f32> {
        crate::geometry::F32::local_from_f64(local)
    }
    fn local_to_f64(local: &Vec3<f32>) -> [f64; 3] {
        local.to_f64()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Body, BodyState};
    use crate::geometry::{F32, F64};
    use crate::rotation::free_rotor;

    #[test]
    fn additions_that_single_precision_forgets_are_kept() {
        let mut kept = CompensatedF32::position_from_f64([1.0, -2.0, 0.3]);
        let mut plain = F32::position_from_f64([1.0, -2.0, 0.3]);
        let step = Vec3::new(1e-9, 2e-9, -3e-9);
        for _ in 0..1_000_000 {
            CompensatedF32::translate(&mut kept, step);
            F32::translate(&mut plain, step);
        }
        assert_eq!(plain.x, 1.0);
        for (component, truth) in kept.to_f64().into_iter().zip([1.001, -1.998, 0.297]) {
            assert!((component - truth).abs() < 1e-9, "{component} {truth}");
        }
    }

    /// What a body falls by joins what is lost; the last digit of its pulls is above it.
    #[test]
    fn both_words_keep_what_is_below_the_last_digit_of_an_increment() {
        const STEPS: i64 = 100_000;
        let unit = (-60.0_f64).exp2();
        let (pulls, fall) =
            ([0x00ff_ffff_i64 << 26, 0x00c0_0001 << 26, -0x01bf_fffe << 26], 1_i64 << 19);
        let [mut both, mut kahan] = [Kept::from_f64([1.0; 3]); 2];
        let mut exact = 1_i128 << 60;
        for step in 0..STEPS {
            let pull = pulls[step as usize % 3];
            let increment = Vec3::from_f64([pull as f64 * unit; 3]);
            assert_eq!(f64::from(increment.x), pull as f64 * unit);
            for kept in [&mut both, &mut kahan] {
                kept.lost = kept.lost - Vec3::from_f64([fall as f64 * unit; 3]);
            }
            both.add_to_both(increment);
            kahan.add(increment);
            exact += i128::from(pull + fall);
            assert!(both.lost.x.abs() <= f32::EPSILON / 2.0 * both.sum.x.abs());
        }
        let off = |kept: &Kept| (kept.to_f64()[2] / unit) as i128 - exact;
        let fallen = i128::from(STEPS * fall);
        assert!(off(&both).abs() < fallen / 1_000, "{} of {fallen}", off(&both));
        assert!(off(&kahan).abs() > fallen / 10, "{} of {fallen}", off(&kahan));
    }

    #[test]
    fn two_words_hold_what_double_precision_has_down_to_their_digits() {
        let state = BodyState::<CompensatedF32>::from_f64(
            [1.0 / 3.0, -1e3 / 7.0, 0.0],
            [0.6, 0.0, -0.8, 0.0],
            [1e-9 / 3.0, 2.0, f64::from(f32::MAX)],
            [0.1, 0.2, -0.3],
        );
        let double = state.convert::<F64>();
        assert_eq!(double.convert::<CompensatedF32>(), state);
        assert!((double.position.x - 1.0 / 3.0).abs() < 1e-15);
        // What no number of single precision holds is infinite, and shows.
        assert!(CompensatedF32::velocity_from_f64([1e300; 3]).to_f64()[0].is_infinite());
    }

    /// How far a body is from where it ought to be after a million small turns, as a share of the way.
    fn turned_off<P: Geometry<Space = f32, Real = f32>>() -> f64 {
        let body = Body::<f32>::from_f64(1.0, [0.5, 0.7, 1.1]);
        let mut rate = P::spin_from_f64([0.0, 0.0, 1e-4]);
        let mut turned = P::Orientation::from_f64([1.0, 0.0, 0.0, 0.0]);
        for _ in 0..1_000_000 {
            free_rotor::<P>(&body, &mut turned, &mut rate, 1e-3);
        }
        let q = turned.to_f64();
        let norm: f64 = q.iter().map(|c| c * c).sum();
        assert!((norm - 1.0).abs() < 1e-6, "{norm}");
        (2.0 * libm::atan2(q[3], q[0]) / 0.1 - 1.0).abs()
    }

    #[test]
    fn turns_too_small_for_single_precision_add_up() {
        let (plain, kept) = (turned_off::<F32>(), turned_off::<CompensatedF32>());
        assert!(plain > 1e-2, "{plain}");
        assert!(kept < 1e-6, "{kept}");
    }
}
