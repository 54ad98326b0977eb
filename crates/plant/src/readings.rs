//! Read-outs in double precision, whatever precision computed them.
//!
//! `reading => reading in f64 => one number per column of a trace`.

use dbd_kernel::readouts::Reading;
use dbd_kernel::{Real, Vec3};

/// The same reading in double precision, exactly.
pub(crate) fn widened<R: Real>(reading: Reading<R>) -> Reading<f64> {
    let vector = |v: Vec3<R>| Vec3::from_f64(v.to_f64());
    match reading {
        Reading::Scalar(value) => Reading::Scalar(value.to_f64()),
        Reading::Vector(value) => Reading::Vector(vector(value)),
        Reading::Imu { specific_force, rate } => {
            Reading::Imu { specific_force: vector(specific_force), rate: vector(rate) }
        }
    }
}

/// Appends a reading's numbers, one per column; the same number of NaN if there is no reading, for example for an
/// undefined torsion angle.
pub fn append(reading: Option<Reading<f64>>, columns: usize, values: &mut Vec<f64>) {
    match reading {
        Some(Reading::Scalar(value)) => values.push(value),
        Some(Reading::Vector(vector)) => values.extend(vector.to_f64()),
        Some(Reading::Imu { specific_force, rate }) => {
            values.extend(specific_force.to_f64());
            values.extend(rate.to_f64());
        }
        None => values.extend(std::iter::repeat_n(f64::NAN, columns)),
    }
}
