//! Roots of what a program calls between two steps, with a model that has every kind of element.
//!
//! Numbers pass this boundary in double precision, whatever the model's: soft floating point is
//! in its place here.

use dbd_kernel::plant::{InputError, StateError};
use dbd_kernel::readouts::{Reading, Readout};
use dbd_kernel::snapshot::SnapshotError;
use dbd_kernel::{F32, F64, Failure, Geometry, InputIndex, Leapfrog, Plant, State};

use crate::Keep;
use crate::steps::EveryKind;

type Running<P> = Plant<&'static EveryKind<P>, Leapfrog>;

macro_rules! root {
    ($keep:ident, $what:literal $precision:literal,
        ($($argument:ident: $type:ty),*) -> $result:ty { $body:expr }) => {{
        #[inline(never)]
        #[unsafe(export_name = concat!("audit.", $what, ".every-kind.leapfrog.", $precision))]
        fn root($($argument: $type),*) -> $result {
            $body
        }
        $keep(root as *const ());
    }};
}

macro_rules! roots {
    ($keep:ident, $geometry:ty, $precision:literal) => {
        root!($keep, "advance" $precision, (plant: &mut Running<$geometry>, steps: u64) -> Result<(), Failure> {
            plant.advance(steps)
        });
        root!($keep, "set_input" $precision,
            (plant: &mut Running<$geometry>, input: InputIndex, value: f64)
                -> Result<(), InputError> { plant.set_input(input, value) });
        root!($keep, "set_input_real" $precision,
            (plant: &mut Running<$geometry>, input: InputIndex,
                value: <$geometry as Geometry>::Real)
                -> Result<(), InputError> { plant.set_input_real(input, value) });
        root!($keep, "set_signal" $precision,
            (plant: &mut Running<$geometry>, input: InputIndex, value: f64, rate: f64)
                -> Result<(), InputError> { plant.set_signal(input, value, rate) });
        root!($keep, "set_state" $precision,
            (plant: &mut Running<$geometry>, state: &State<EveryKind<$geometry>>)
                -> Result<(), StateError> { plant.set_state(*state) });
        root!($keep, "reset" $precision, (plant: &mut Running<$geometry>) -> () {
            plant.reset()
        });
        root!($keep, "read" $precision,
            (plant: &Running<$geometry>, readout: &Readout<$geometry>)
                -> Option<Reading<<$geometry as Geometry>::Real>> { plant.read(readout) });
        root!($keep, "snapshot" $precision,
            (plant: &Running<$geometry>, buffer: &mut [u8])
                -> Result<usize, SnapshotError> { plant.snapshot(buffer) });
        root!($keep, "restore" $precision,
            (plant: &mut Running<$geometry>, bytes: &[u8])
                -> Result<(), SnapshotError> { plant.restore(bytes) });
        root!($keep, "hash" $precision, (plant: &Running<$geometry>) -> u64 { plant.hash() });
    };
}

pub fn keep(keep: Keep) {
    roots!(keep, F32, "f32");
    roots!(keep, F64, "f64");
}
