//! Plants by name, and read-outs of plants of either kind.
//!
//! `plant => moment, identity; (plant, read-out) => reading`, in double precision.

use core::ops::Deref;

use dbd_kernel::fingerprint::model_hash;
use dbd_kernel::readouts::{Reading, Readout};
use dbd_kernel::{F64, ModelOwner, Plant, Real, Scheme, Vec3};
use dbd_plant::AnyPlant;
use dbd_plant::number_format::Digits as StoredDigits;

use crate::head::{Identity, NumberFormat, PrecisionTag, SchemeTag};
use crate::number::Digits;
use crate::subject::{BodyNumbers, Moment, Subject, numbers};

/// A plant whose read-outs the recording reads.
pub trait Readable: Subject {
    /// The present value of a read-out of the scene, widened exactly.
    fn reading(&self, readout: &Readout<F64>) -> Option<Reading<f64>>;
}

impl Moment for dyn AnyPlant + '_ {
    fn steps_done(&self) -> u64 {
        self.steps()
    }

    fn state_hash(&self) -> u64 {
        AnyPlant::hash(self)
    }

    fn body_numbers(&self, row: usize) -> Option<BodyNumbers> {
        self.state().bodies.get(row).map(numbers)
    }

    fn turn_count(&self, spring: usize) -> Option<i32> {
        self.state().turns.get(spring).copied()
    }
}

impl Subject for dyn AnyPlant + '_ {
    fn identity(&self) -> Identity<'static> {
        let (method, number_format) = (self.method(), self.number_format());
        let digits = |stored| match stored {
            StoredDigits::Single => Digits::Single,
            StoredDigits::Double => Digits::Double,
        };
        Identity {
            scheme: SchemeTag {
                name: method.scheme_name(),
                damping: method.damping().name(),
                evaluations: method.evaluations(),
            },
            precision: PrecisionTag {
                name: method.precision_name(),
                orientation: method.orientation_name(),
            },
            number_format: NumberFormat {
                position: digits(number_format.position),
                orientation: digits(number_format.orientation),
                velocity: digits(number_format.velocity),
                value: digits(number_format.reading),
            },
            step_size: self.step_size(),
            model: model_hash(self.model()),
            bodies: self.model().bodies.len(),
            turns: self.model().torsions.len(),
        }
    }
}

impl Readable for dyn AnyPlant + '_ {
    fn reading(&self, readout: &Readout<F64>) -> Option<Reading<f64>> {
        self.read(readout)
    }
}

impl<H, S> Readable for Plant<H, S>
where
    H: Deref<Target: ModelOwner + Sized>,
    S: Scheme,
{
    fn reading(&self, readout: &Readout<F64>) -> Option<Reading<f64>> {
        self.read(&readout.convert()).map(|reading| match reading {
            Reading::Scalar(value) => Reading::Scalar(value.to_f64()),
            Reading::Vector(value) => Reading::Vector(Vec3::from_f64(value.to_f64())),
            Reading::Imu { specific_force, rate } => Reading::Imu {
                specific_force: Vec3::from_f64(specific_force.to_f64()),
                rate: Vec3::from_f64(rate.to_f64()),
            },
        })
    }
}
