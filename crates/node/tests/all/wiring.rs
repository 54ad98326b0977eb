//! What is wired to nothing ends the start with its name; what fails later is told to every driver.

#[allow(dead_code, reason = "each test program uses a part of the rotor")]
use std::cell::RefCell;

use crate::shaft::{ANGLE, IMU, POINT, RATE, Shaft, TORQUE};
use dbd_kernel::plant::InputError;
use dbd_kernel::readouts::Readout;
use dbd_kernel::{BodyIndex, F32, InputIndex, TorsionIndex};
use dbd_node::{
    Active, As5047p, BridgePin, Channel, DutyEnd, Encoder, EncoderParameters, EndStop, Errors,
    Fault, I2cEnd, ImuParameters, Motor, MotorParameters, Mpu6000, Node, NodeDelay, Part, Probe,
    Problem, Shared as _, Side, SpiEnd, Supply, SwitchPin, WiringError,
};
use embedded_hal::delay::DelayNs as _;
use embedded_hal::digital::{InputPin as _, OutputPin as _};
use embedded_hal::i2c::I2c as _;
use embedded_hal::pwm::SetDutyCycle as _;
use embedded_hal::spi::SpiDevice;

const IDEAL: MotorParameters = MotorParameters::ideal(1.0, 100);

fn encoder(probe: Probe<F32>) -> Encoder<F32> {
    Encoder::new(probe, EncoderParameters::at_joint(16_384))
}

/// Why a node refuses a part.
fn refused(part: impl Part<Shaft>) -> WiringError {
    match Node::new(Shaft::default(), (part,)) {
        Ok(_) => panic!("it was wired"),
        Err(error) => error,
    }
}

fn error(name: &'static str, problem: Problem) -> WiringError {
    WiringError { name, problem }
}

#[test]
fn a_part_that_is_wired_to_nothing_ends_the_start_with_its_name() {
    let nowhere = InputIndex(3);
    let motor = refused(Motor::<F32>::new("lift", nowhere, IDEAL));
    assert_eq!(motor, error("lift", Problem::Input(InputError::Unknown(nowhere))));
    assert_eq!(motor.to_string(), "`lift`: the model has no input 3");
    let gone = Readout::JointAngle { spring: TorsionIndex(9), offset: 0.0 };
    let seen = refused(encoder(Probe::scalar("elbow", gone)));
    assert_eq!(seen, error("elbow", Problem::NoReadout));
    assert_eq!(seen.to_string(), "`elbow`: the model has no such read-out");
    let body = Readout::Imu { body: BodyIndex(4), point: Default::default() };
    let chip = refused(Mpu6000::<F32>::new("flyer", body, ImuParameters::default()));
    assert_eq!(chip, error("flyer", Problem::NoReadout));
    let stop = refused(EndStop::new(Probe::scalar("left", gone), Side::Above, 1.0, 0.0));
    assert_eq!(stop, error("left", Problem::NoReadout));
}

#[test]
fn a_readout_of_another_kind_ends_the_start() {
    let kind = |wanted, found| Problem::Kind { wanted, found };
    let vector = refused(encoder(Probe::scalar("cart", POINT)));
    assert_eq!(vector, error("cart", kind("a number", "a vector")));
    let text = "`cart`: the read-out is a vector, expected a number";
    assert_eq!(vector.to_string(), text);
    let number = refused(encoder(Probe::along("angle", ANGLE, [1.0, 0.0, 0.0])));
    assert_eq!(number, error("angle", kind("a vector", "a number")));
    let imu = refused(encoder(Probe::scalar("imu", IMU)));
    assert_eq!(imu, error("imu", kind("a number", "specific force and angular rate")));
    let angle = refused(Mpu6000::<F32>::new("imu", ANGLE, ImuParameters::default()));
    assert_eq!(angle, error("imu", kind("specific force and angular rate", "a number")));
    let speed = Motor::new("m", TORQUE, IDEAL).with_speed(Probe::scalar("speed", POINT));
    assert_eq!(refused(speed), error("speed", kind("a number", "a vector")));
}

#[test]
fn two_motors_cannot_drive_one_input() {
    let [first, second] = ["first", "second"].map(|name| Motor::<F32>::new(name, TORQUE, IDEAL));
    let error = Node::new(Shaft::default(), (first, second)).err();
    let expected = WiringError { name: "second", problem: Problem::Shared(TORQUE) };
    assert_eq!(error, Some(expected));
}

#[test]
fn an_end_of_a_part_that_no_node_steps_is_refused() {
    let motor = RefCell::new(Motor::<F32>::new("drive", TORQUE, IDEAL));
    let chip = RefCell::new(As5047p::new(encoder(Probe::scalar("angle", ANGLE))));
    let stop =
        RefCell::new(EndStop::<F32>::new(Probe::scalar("stop", ANGLE), Side::Above, 1.0, 0.0));
    let imu = RefCell::new(Mpu6000::<F32>::new("imu", IMU, ImuParameters::default()));
    let none = |name| Some(error(name, Problem::NoNode));
    assert_eq!(DutyEnd::new(&motor, Channel::Forwards).err(), none("drive"));
    assert_eq!(BridgePin::enable(&motor).err(), none("drive"));
    assert_eq!(SpiEnd::new(&chip).err(), none("angle"));
    assert_eq!(SwitchPin::new(&stop, Active::Low).err(), none("stop"));
    assert_eq!(I2cEnd::new(&imu).err(), none("imu"));
    // A node that was refused leaves them loose; one that is taken apart, too.
    let wrong = RefCell::new(Motor::<F32>::new("wrong", InputIndex(1), IDEAL));
    assert!(Node::new(Shaft::default(), (&motor, &chip, &wrong)).is_err());
    assert_eq!(SpiEnd::new(&chip).err(), none("angle"));
    let node = Node::new(Shaft::default(), (&motor, &chip)).unwrap();
    let mut spi = SpiEnd::new(&chip).unwrap();
    let twice = Node::new(Shaft::default(), &motor).err();
    assert_eq!(twice, Some(error("drive", Problem::Twice)));
    let _taken_apart = node.release();
    assert_eq!(SpiDevice::<u8>::write(&mut spi, &[0, 0]), Err(Fault::NotWired));
}

#[test]
fn parameters_out_of_range_are_named() {
    let motor = |change: &dyn Fn(&mut MotorParameters)| {
        let mut parameters = IDEAL;
        change(&mut parameters);
        refused(Motor::<F32>::new("m", TORQUE, parameters)).problem
    };
    let supply = |full, resistance, back_emf| Supply::Voltage { full, resistance, back_emf };
    type Change<'c> = &'c dyn Fn(&mut MotorParameters);
    let cases: [(Change<'_>, &str); 10] = [
        (&|p| p.lag = -1.0, "the lag"),
        (&|p| p.most_duty = 0, "the maximum duty"),
        (&|p| p.ratio = 0.0, "the ratio"),
        (&|p| p.most_current = 0.0, "the maximum current"),
        (&|p| p.torque_constant = f64::NAN, "the torque constant"),
        (&|p| p.friction_speed = 0.0, "the friction speed"),
        (&|p| p.supply = supply(12.0, 0.0, 0.0), "the resistance"),
        (&|p| p.supply = supply(0.0, 1.0, 0.0), "the voltage"),
        (&|p| p.supply = supply(12.0, 1.0, 0.1), "the speed (required for back-EMF)"),
        (&|p| p.friction = 0.1, "the speed (required for friction)"),
    ];
    for (change, which) in cases {
        assert_eq!(motor(change), Problem::Parameter(which));
    }
    let sensor = |errors| {
        let parameters = EncoderParameters { errors, ..EncoderParameters::at_joint(16_384) };
        refused(Encoder::<F32>::new(Probe::scalar("e", ANGLE), parameters)).problem
    };
    let none = Errors::NONE;
    for (errors, which) in [
        (Errors { noise: -1.0, ..none }, "the noise"),
        (Errors { walk: f64::INFINITY, ..none }, "the random walk"),
        (Errors { resolution: f64::NAN, ..none }, "the resolution"),
        (Errors { bias: f64::NAN, ..none }, "the bias"),
        (Errors { range: [1.0, 1.0], ..none }, "the range"),
    ] {
        assert_eq!(sensor(errors), Problem::Parameter(which));
    }
    let still = EncoderParameters { turn: 0.0, ..EncoderParameters::at_joint(100) };
    let encoder = |parameters| Encoder::<F32>::new(Probe::scalar("e", ANGLE), parameters);
    assert_eq!(refused(encoder(still)).problem, Problem::Parameter("the turn"));
    let chip = refused(As5047p::new(encoder(EncoderParameters::at_joint(4_096))));
    assert_eq!(chip.problem, Problem::Parameter("the number of counts (fixed at 16384)"));
    let address = ImuParameters { address: 0x78, ..ImuParameters::default() };
    let imu = refused(Mpu6000::<F32>::new("imu", IMU, address));
    assert_eq!(imu.problem, Problem::Parameter("the address"));
    let stop = EndStop::<F32>::new(Probe::scalar("s", ANGLE), Side::Above, 1.0, -0.1);
    assert_eq!(refused(stop).problem, Problem::Parameter("the hysteresis"));
}

#[test]
fn a_plant_that_fails_is_told_to_every_driver() {
    let motor = RefCell::new(Motor::new("m", TORQUE, IDEAL).with_speed(Probe::scalar("w", RATE)));
    let chip = RefCell::new(As5047p::new(encoder(Probe::scalar("angle", ANGLE))));
    let stop = RefCell::new(EndStop::new(Probe::scalar("stop", ANGLE), Side::Above, 1.0, 0.0));
    let imu = RefCell::new(Mpu6000::<F32>::new("imu", IMU, ImuParameters::default()));
    let shaft = Shaft { breaks_at: Some(5), ..Shaft::default() };
    let node = RefCell::new(Node::new(shaft, (&motor, &chip, &stop, &imu)).unwrap());
    let mut duty = DutyEnd::new(&motor, Channel::Forwards).unwrap();
    let mut direction = BridgePin::direction(&motor).unwrap();
    let mut spi = SpiEnd::new(&chip).unwrap();
    let mut pin = SwitchPin::new(&stop, Active::High).unwrap();
    let mut bus = I2cEnd::new(&imu).unwrap();
    let mut delay = NodeDelay::new(&node);
    delay.delay_ms(3);
    duty.set_duty_cycle(1).unwrap();
    assert_eq!(delay.fault(), None);
    delay.delay_ms(3);
    let fault = node.borrow().fault().unwrap();
    assert!(matches!(fault, Fault::Plant(failure) if failure.step == 5));
    assert_eq!(delay.fault(), Some(fault));
    assert_eq!(duty.set_duty_cycle(2), Err(fault));
    assert_eq!(direction.set_high(), Err(fault));
    assert_eq!(SpiDevice::<u8>::write(&mut spi, &[0, 0]), Err(fault));
    assert_eq!(pin.is_high(), Err(fault));
    assert_eq!(bus.write(0x68, &[0]), Err(fault));
    // It latches: nothing goes on.
    assert_eq!(node.borrow_mut().advance(10), Err(fault));
    assert_eq!(node.borrow().machine().steps, 5);
}

#[test]
fn an_input_that_is_not_finite_stops_the_node() {
    // A current of 1e38 A times a ratio of 1e3 is beyond single precision.
    let wild = MotorParameters { supply: Supply::Current { full: 1e38 }, ratio: 1e3, ..IDEAL };
    let motor = RefCell::new(Motor::<F32>::new("m", TORQUE, wild));
    let mut node = Node::new(Shaft::default(), &motor).unwrap();
    DutyEnd::new(&motor, Channel::Forwards).unwrap().set_duty_cycle_fully_on().unwrap();
    assert_eq!(node.step(), Err(Fault::Input(InputError::NotFinite(TORQUE))));
}

#[test]
fn what_is_in_use_elsewhere_is_busy_and_not_a_panic() {
    let motor = RefCell::new(Motor::<F32>::new("m", TORQUE, IDEAL));
    let node = RefCell::new(Node::new(Shaft::default(), &motor).unwrap());
    let mut duty = DutyEnd::new(&motor, Channel::Forwards).unwrap();
    let mut delay = NodeDelay::new(&node);
    {
        let _held = motor.borrow_mut();
        assert_eq!(duty.set_duty_cycle(1), Err(Fault::Busy));
    }
    {
        let _held = node.borrow_mut();
        delay.delay_ms(1);
    }
    assert_eq!(delay.fault(), Some(Fault::Busy));
    duty.set_duty_cycle(1).unwrap();
}

#[cfg(feature = "critical-section")]
mod with_interrupts {
    use super::*;
    use critical_section::Mutex;
    use dbd_node::Slot;

    type Drive = Slot<Motor<F32>>;
    type Chip = Slot<As5047p<Encoder<F32>>>;

    static MOTOR: Drive = Slot::new();
    static CHIP: Chip = Slot::new();
    static NODE: Slot<Node<Shaft, (&Drive, &Chip)>> = Slot::new();

    #[test]
    fn parts_in_statics_are_reached_from_an_interrupt() {
        let empty = Node::new(Shaft::default(), &MOTOR).err().map(|error| error.problem);
        assert_eq!(empty, Some(Problem::Busy));
        assert!(MOTOR.put(Motor::new("m", TORQUE, IDEAL)).unwrap().is_none());
        assert!(CHIP.put(As5047p::new(encoder(Probe::scalar("angle", ANGLE)))).unwrap().is_none());
        let node = Node::new(Shaft::default(), (&MOTOR, &CHIP)).unwrap();
        assert!(NODE.put(node).unwrap().is_none());
        // The interrupt steps; the program drives and reads.
        let interrupt = || NODE.with(|node| node.step()).unwrap();
        let mut duty = DutyEnd::new(&MOTOR, Channel::Forwards).unwrap();
        duty.set_duty_cycle_fully_on().unwrap();
        let steps = std::thread::spawn(move || (0..1_024).try_for_each(|_| interrupt()));
        steps.join().unwrap().unwrap();
        let mut words = [0xffff_u16];
        let mut spi = SpiEnd::new(&CHIP).unwrap();
        spi.transfer_in_place(&mut words).unwrap();
        spi.transfer_in_place(&mut words).unwrap();
        // Half a radian of 1 N·m over a second.
        let angle = f64::from(words[0] & 0x3fff) / 16_384.0 * std::f64::consts::TAU;
        assert!((angle - 0.5).abs() < 1e-3, "{angle}");
    }

    #[test]
    fn a_cell_behind_a_critical_section_serves_as_well() {
        let motor = Mutex::new(RefCell::new(Motor::<F32>::new("m", TORQUE, IDEAL)));
        let mut node = Node::new(Shaft::default(), &motor).unwrap();
        DutyEnd::new(&motor, Channel::Backwards).unwrap().set_duty_cycle(50).unwrap();
        node.step().unwrap();
        assert_eq!(node.machine().torque, -0.5);
    }
}
