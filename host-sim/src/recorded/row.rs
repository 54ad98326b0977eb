//! A sample that was recorded.

use dbd_golden::subject::BodyNumbers;

/// A sample.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Row {
    /// \[s\] the time.
    pub time: f64,
    /// Steps since t = 0.
    pub step: u64,
    /// Per body position \[m\], quaternion (scalar first, body → world), velocity \[m/s\], angular velocity \[rad/s\].
    pub bodies: Vec<BodyNumbers>,
    /// \[J\] kinetic, potential and total energy, where they were recorded.
    pub energies: Option<[f64; 3]>,
    /// Read-outs and other recorded values, in the head's order.
    pub values: Vec<f64>,
    /// Revolution counts of the torsion springs, if recorded.
    pub turns: Option<Vec<i32>>,
    /// The hash of the state's stored words, where it is known.
    pub hash: Option<u64>,
}
