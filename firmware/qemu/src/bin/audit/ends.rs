//! Roots of what drivers and timers call: every end of `dbd-node`, and the node's step.
//!
//! Cart and pendulum in single precision by leapfrog, with a motor, three encoders, an end stop and an
//! inertial unit in cells. An end touches its part alone, so no double precision is in its place
//! there; a node's step reads the plant, whose read-outs know the step in double precision.

use core::cell::RefCell;

use dbd_kernel::{F32, Leapfrog, Plant};
use dbd_node::spi::SpiPart;
use dbd_node::{
    As5047p, BridgePin, ChipSelect, DutyEnd, Encoder, EncoderPin, EndStop, Fault, I2cEnd, Ls7366r,
    Motor, Mpu6000, Node, NodeDelay, Shared, SpiEnd, SpiWires, SwitchPin,
};
use embedded_hal::delay::DelayNs;
use embedded_hal::digital::{InputPin, OutputPin};
use embedded_hal::i2c::{I2c, Operation as I2cOperation};
use embedded_hal::pwm::SetDutyCycle;
use embedded_hal::spi::{Operation, SpiBus, SpiDevice};
use firmware::controllers::ControlError;
use firmware::controllers::balance::{Balance, Seen};
use firmware::models::cart_pendulum::CartPendulumF32;

use crate::Keep;

type Drive = &'static RefCell<Motor<F32>>;
type Angle = &'static RefCell<As5047p<Encoder<F32, 2>>>;
type Count = &'static RefCell<Ls7366r<Encoder<F32>>>;
type Pins = &'static RefCell<Encoder<F32>>;
type Stop = &'static RefCell<EndStop<F32>>;
type Imu = &'static RefCell<Mpu6000<F32, 1>>;
type Cart = Node<Plant<&'static CartPendulumF32, Leapfrog>, (Drive, Angle, Count, Pins, Stop, Imu)>;

type Balancer = Balance<SpiEnd<Angle>, SpiEnd<Angle>, DutyEnd<Drive>, BridgePin<Drive>>;

macro_rules! root {
    ($keep:ident, $what:literal, ($($argument:ident: $type:ty),*) -> $result:ty { $body:expr }) => {{
        #[inline(never)]
        #[unsafe(export_name = concat!("audit.", $what, ".cart-pendulum.leapfrog.f32"))]
        fn root($($argument: $type),*) -> $result {
            $body
        }
        $keep(root as *const ());
    }};
}

/// Chip select by itself: what a driver's pin calls.
fn select(pin: &mut ChipSelect<impl Shared<Part: SpiPart>>, high: bool) -> Result<(), Fault> {
    if high { pin.set_high() } else { pin.set_low() }
}

pub fn keep(keep: Keep) {
    root!(keep, "node_step", (node: &mut Cart) -> Result<(), Fault> { node.step() });
    root!(keep, "delay_ns", (delay: &mut NodeDelay<&'static RefCell<Cart>>, time: u32) -> () {
        delay.delay_ns(time)
    });
    root!(keep, "duty", (end: &mut DutyEnd<Drive>, duty: u16) -> Result<(), Fault> {
        end.set_duty_cycle(duty)
    });
    root!(keep, "bridge_pin", (end: &mut BridgePin<Drive>, high: bool) -> Result<(), Fault> {
        if high { end.set_high() } else { end.set_low() }
    });
    root!(keep, "spi_as5047p",
    (end: &mut SpiEnd<Angle>, operations: &mut [Operation<'_, u8>]) -> Result<(), Fault> {
        end.transaction(operations)
    });
    root!(keep, "spi_ls7366r",
    (end: &mut SpiEnd<Count>, operations: &mut [Operation<'_, u8>]) -> Result<(), Fault> {
        end.transaction(operations)
    });
    root!(keep, "spi_mpu6000",
    (end: &mut SpiEnd<Imu>, operations: &mut [Operation<'_, u8>]) -> Result<(), Fault> {
        end.transaction(operations)
    });
    root!(keep, "spi_words",
    (end: &mut SpiEnd<Angle>, operations: &mut [Operation<'_, u16>]) -> Result<(), Fault> {
        end.transaction(operations)
    });
    root!(keep, "spi_bus",
        (bus: &mut SpiWires<(Angle, Count, Imu)>, seen: &mut [u8], sent: &[u8])
            -> Result<(), Fault> { bus.transfer(seen, sent) });
    root!(keep, "chip_select", (pin: &mut ChipSelect<Angle>, high: bool) -> Result<(), Fault> {
        select(pin, high)
    });
    root!(keep, "i2c_mpu6000",
        (end: &mut I2cEnd<Imu>, address: u8, operations: &mut [I2cOperation<'_>])
            -> Result<(), Fault> { end.transaction(address, operations) });
    // A controller upon them.
    root!(keep, "balance_tick", (controller: &mut Balancer) -> Result<Seen, ControlError> {
        controller.tick()
    });
    root!(keep, "encoder_pin", (end: &mut EncoderPin<Pins>) -> Result<bool, Fault> {
        end.is_high()
    });
    root!(keep, "switch_pin", (end: &mut SwitchPin<Stop>) -> Result<bool, Fault> {
        end.is_high()
    });
}
