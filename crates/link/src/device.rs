//! The interface of a plant for its end of the line, and its implementation by the kernel's plant.

use core::ops::Deref;

use dbd_kernel::model::ModelOwner;
use dbd_kernel::readouts::{Reading, Readout};
use dbd_kernel::{Geometry, InputIndex, Plant, Real as _, Scheme};

use crate::message::{Identity, Name, Values};

/// A plant with inputs and sensors.
pub trait Device {
    /// Its identity, without the fingerprint, which a snapshot contains.
    fn identity(&self) -> Identity;

    /// Sets an input \[N, N·m or m\], counted from 0; returns whether it was accepted. An input that was not accepted
    /// keeps its value.
    fn set(&mut self, input: usize, value: f64) -> bool;

    /// The value of an input, 0 if there is no such input.
    fn input(&self, input: usize) -> f64;

    /// Takes steps with the present inputs, or as many as succeed.
    fn advance(&mut self, steps: u32);

    /// Steps since t = 0.
    fn step(&self) -> u64;

    /// Whether it has not failed.
    fn running(&self) -> bool;

    /// The hash of the state's stored words.
    fn hash(&self) -> u64;

    /// Appends the values of all sensors, [`f64::NAN`] for undefined ones.
    fn read(&self, values: &mut Values);

    /// Writes a snapshot; returns its length \[bytes\], `None` if the plant has failed or it does not fit.
    fn save(&self, buffer: &mut [u8]) -> Option<usize>;

    /// Restores a snapshot; returns whether it was accepted. Otherwise nothing is changed.
    fn restore(&mut self, bytes: &[u8]) -> bool;
}

/// A name, truncated to the available space.
#[must_use]
pub fn cut(name: &str) -> Name {
    let mut cut = Name::new();
    for character in name.chars() {
        if cut.push(character).is_err() {
            break;
        }
    }
    cut
}

/// A sensor of a plant whose model `H` points to.
pub type SensorOf<H> = Readout<<<H as Deref>::Target as ModelOwner>::Precision>;

/// The kernel's plant with `I` inputs and `O` sensors.
pub struct KernelPlant<H, S, const I: usize, const O: usize>
where
    H: Deref<Target: ModelOwner + Sized>,
    S: Scheme,
{
    plant: Plant<H, S>,
    scene: &'static str,
    inputs: [InputIndex; I],
    sensors: [SensorOf<H>; O],
}

impl<H, S, const I: usize, const O: usize> KernelPlant<H, S, I, O>
where
    H: Deref<Target: ModelOwner + Sized>,
    S: Scheme,
{
    /// A plant, the name of its scene, its inputs and its sensors. They match the other end if they are the scene's
    /// read-outs in order, and its inputs in order without those driven by tables.
    #[must_use]
    pub const fn new(
        plant: Plant<H, S>,
        scene: &'static str,
        inputs: [InputIndex; I],
        sensors: [SensorOf<H>; O],
    ) -> Self {
        Self { plant, scene, inputs, sensors }
    }

    /// The plant.
    pub const fn plant(&self) -> &Plant<H, S> {
        &self.plant
    }
}

impl<H, S, const I: usize, const O: usize> Device for KernelPlant<H, S, I, O>
where
    H: Deref<Target: ModelOwner + Sized>,
    S: Scheme,
{
    fn identity(&self) -> Identity {
        let mut values = Values::new();
        self.read(&mut values);
        let [inputs, outputs] = [I, values.len()].map(|count| count.min(255) as u8);
        Identity {
            scene: cut(self.scene),
            scheme: cut(S::NAME),
            precision: cut(<H::Target as ModelOwner>::Precision::NAME),
            step: self.plant.step_size(),
            inputs,
            outputs,
            ..Identity::default()
        }
    }

    fn set(&mut self, input: usize, value: f64) -> bool {
        let input = self.inputs.get(input);
        input.is_some_and(|input| self.plant.set_input(*input, value).is_ok())
    }

    fn input(&self, input: usize) -> f64 {
        let index = self.inputs.get(input).map(|input| usize::from(input.0));
        let signal = index.and_then(|index| self.plant.state().signals.as_ref().get(index));
        signal.map_or(0.0, |signal| signal.value.to_f64())
    }

    fn advance(&mut self, steps: u32) {
        // A failure latches, and `running` shows it.
        let _ = self.plant.advance(u64::from(steps));
    }

    fn step(&self) -> u64 {
        self.plant.state().step
    }

    fn running(&self) -> bool {
        self.plant.status().is_ok()
    }

    fn hash(&self) -> u64 {
        self.plant.hash()
    }

    fn read(&self, values: &mut Values) {
        for sensor in &self.sensors {
            let (numbers, count) = match self.plant.read(sensor) {
                Some(Reading::Scalar(value)) => ([value.to_f64(), 0.0, 0.0, 0.0, 0.0, 0.0], 1),
                Some(Reading::Vector(vector)) => {
                    let [x, y, z] = vector.to_f64();
                    ([x, y, z, 0.0, 0.0, 0.0], 3)
                }
                Some(Reading::Imu { specific_force, rate }) => {
                    let ([x, y, z], [a, b, c]) = (specific_force.to_f64(), rate.to_f64());
                    ([x, y, z, a, b, c], 6)
                }
                None => ([f64::NAN; 6], numbers_of(sensor)),
            };
            // Excess values are omitted at both ends, and the host refuses such scenes.
            numbers.iter().take(count).for_each(|number| _ = values.push(*number));
        }
    }

    fn save(&self, buffer: &mut [u8]) -> Option<usize> {
        self.plant.snapshot(buffer).ok()
    }

    fn restore(&mut self, bytes: &[u8]) -> bool {
        self.plant.restore(bytes).is_ok()
    }
}

/// Number of values of a sensor.
#[must_use]
pub const fn numbers_of<P: Geometry>(sensor: &Readout<P>) -> usize {
    match sensor {
        Readout::Point { .. } | Readout::PointVelocity { .. } | Readout::JointForce { .. } => 3,
        Readout::Imu { .. } => 6,
        _ => 1,
    }
}
