//! The inertial measurement unit's registers, by both buses and by a driver from elsewhere.

#[allow(dead_code, reason = "each test program uses a part of the rotor")]
use std::cell::RefCell;

use crate::shaft::{IMU, Shaft};
use dbd_kernel::F32;
use dbd_node::{Errors, Fault, I2cEnd, ImuParameters, Mpu6000, Node, NodeDelay, SpiEnd};
use embedded_hal::i2c::{Error as _, ErrorKind, I2c, NoAcknowledgeSource, Operation};
use embedded_hal::spi::SpiDevice;

const ADDRESS: u8 = 0x68;

fn imu(parameters: ImuParameters) -> RefCell<Mpu6000<F32>> {
    RefCell::new(Mpu6000::new("imu", IMU, parameters))
}

/// A shaft that turns at 1.5 rad/s.
fn turning() -> Shaft {
    Shaft { rate: 1.5, ..Shaft::default() }
}

fn pairs(bytes: &[u8]) -> Vec<i16> {
    bytes.chunks_exact(2).map(|pair| i16::from_be_bytes([pair[0], pair[1]])).collect()
}

#[test]
fn registers_are_read_and_written_over_i2c() {
    let imu = imu(ImuParameters::default());
    let mut node = Node::new(turning(), &imu).unwrap();
    let mut bus = I2cEnd::new(&imu).unwrap();
    let mut identity = [0];
    bus.write_read(ADDRESS, &[0x75], &mut identity).unwrap();
    assert_eq!(identity, [0x68]);
    // Asleep it shows nothing.
    let mut data = [0xaa; 14];
    node.advance(4).unwrap();
    bus.write_read(ADDRESS, &[0x3b], &mut data).unwrap();
    assert_eq!(data, [0; 14]);
    bus.write(ADDRESS, &[0x6b, 0]).unwrap();
    node.step().unwrap();
    // Data are ready; reading that says so.
    let mut ready = [0; 2];
    bus.write_read(ADDRESS, &[0x3a], &mut ready).unwrap();
    assert_eq!(ready[0], 1);
    bus.write_read(ADDRESS, &[0x3a], &mut ready).unwrap();
    assert_eq!(ready[0], 0);
    bus.write_read(ADDRESS, &[0x3b], &mut data).unwrap();
    // 1, −2 and 9.80665 m/s² of 16384 per g; 25 °C; 1.5 rad/s of 131 per °/s.
    let force = |x: f64| (x / 9.80665 * 16_384.0).round() as i16;
    let rate = (1.5_f64.to_degrees() * 131.0).round() as i16;
    let expected = [force(1.0), force(-2.0), 16_384, -3_920, 0, 0, rate];
    assert_eq!(pairs(&data), expected);
    // Addresses count up over separate reads of a transaction, and in writes: both full scales.
    let (mut first, mut rest) = ([0; 1], [0; 3]);
    bus.transaction(
        ADDRESS,
        &mut [Operation::Write(&[0x3b]), Operation::Read(&mut first), Operation::Read(&mut rest)],
    )
    .unwrap();
    assert_eq!([first[0], rest[0], rest[1], rest[2]], data[..4]);
    bus.write(ADDRESS, &[0x1b, 3 << 3, 3 << 3]).unwrap();
    node.step().unwrap();
    bus.write_read(ADDRESS, &[0x3b], &mut data).unwrap();
    let expected = [
        force(1.0 / 8.0),
        force(-0.25),
        2_048,
        -3_920,
        0,
        0,
        (f64::from(rate) / 8.0).round() as i16,
    ];
    assert_eq!(pairs(&data), expected);
    // A register that cannot be written; a reset.
    bus.write(ADDRESS, &[0x75, 1]).unwrap();
    bus.write(ADDRESS, &[0x6b, 0x80]).unwrap();
    bus.write_read(ADDRESS, &[0x75], &mut identity).unwrap();
    assert_eq!(identity, [0x68]);
    bus.write_read(ADDRESS, &[0x6b], &mut identity).unwrap();
    assert_eq!(identity, [0x40]);
}

#[test]
fn another_address_is_not_acknowledged() {
    let low = imu(ImuParameters::default());
    let high = imu(ImuParameters { address: 0x69, ..ImuParameters::default() });
    let _node = Node::new(turning(), (&low, &high)).unwrap();
    let mut one = I2cEnd::new(&low).unwrap();
    let mut byte = [0];
    let error = one.read(0x69, &mut byte).unwrap_err();
    assert_eq!(error, Fault::Address(0x69));
    assert_eq!(error.kind(), ErrorKind::NoAcknowledge(NoAcknowledgeSource::Address));
    // Both on one bus: each by its own.
    let mut both = I2cEnd::new((&low, &high)).unwrap();
    both.write(0x69, &[0x19, 7]).unwrap();
    for (address, value) in [(0x68, 0), (0x69, 7)] {
        both.write_read(address, &[0x19], &mut byte).unwrap();
        assert_eq!(byte, [value]);
    }
    assert_eq!(both.read(0x6a, &mut byte), Err(Fault::Address(0x6a)));
    // Once its I2C is switched off, it is SPI's alone.
    both.write(0x69, &[0x6a, 1 << 4]).unwrap();
    assert_eq!(both.read(0x69, &mut byte), Err(Fault::Address(0x69)));
}

#[test]
fn registers_are_read_and_written_over_spi() {
    let imu = imu(ImuParameters::default());
    let mut node = Node::new(turning(), &imu).unwrap();
    let mut spi = SpiEnd::new(&imu).unwrap();
    SpiDevice::<u8>::write(&mut spi, &[0x6b, 0]).unwrap();
    node.step().unwrap();
    let mut words = [0x80_u8 | 0x75, 0];
    spi.transfer_in_place(&mut words).unwrap();
    assert_eq!(words, [0, 0x68]);
    let mut data = [0_u8; 6];
    let mut operations = [
        embedded_hal::spi::Operation::Write(&[0x80 | 0x43]),
        embedded_hal::spi::Operation::Read(&mut data),
    ];
    spi.transaction(&mut operations).unwrap();
    assert_eq!(pairs(&data)[2], (1.5_f64.to_degrees() * 131.0).round() as i16);
}

#[test]
fn samples_come_at_the_rate_of_the_registers() {
    let imu = imu(ImuParameters::default());
    let mut node = Node::new(Shaft::default(), &imu).unwrap();
    let mut bus = I2cEnd::new(&imu).unwrap();
    bus.write(ADDRESS, &[0x6b, 0]).unwrap();
    // 1 kHz by the filter, divided by 8: 8 ms, of 1/1024 s each, are 8.19 steps.
    for (registers, steps) in [([7, 1], 8), ([0, 1], 1), ([255, 0], 33), ([255, 3], 262)] {
        bus.write(ADDRESS, &[0x19, registers[0], registers[1]]).unwrap();
        let mut ready = [0];
        let mut samples = Vec::new();
        for step in 0..3 * steps {
            node.step().unwrap();
            bus.write_read(ADDRESS, &[0x3a], &mut ready).unwrap();
            if ready[0] == 1 {
                samples.push(step);
            }
        }
        let apart: Vec<_> = samples.windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert!(
            !apart.is_empty() && apart.iter().all(|apart| *apart == steps),
            "{steps}: {samples:?}"
        );
    }
}

#[test]
fn what_is_beyond_the_full_scale_is_at_its_end_and_standby_holds() {
    let accelerometer = Errors { bias: 30.0, ..Errors::NONE };
    let imu = imu(ImuParameters { accelerometer, ..ImuParameters::default() });
    let mut node = Node::new(Shaft { rate: -5.0, ..Shaft::default() }, &imu).unwrap();
    let mut bus = I2cEnd::new(&imu).unwrap();
    bus.write(ADDRESS, &[0x6b, 0]).unwrap();
    // The z axes of the accelerometer is in standby.
    bus.write(ADDRESS, &[0x6c, 1 << 3]).unwrap();
    node.step().unwrap();
    let mut data = [0; 14];
    bus.write_read(ADDRESS, &[0x3b], &mut data).unwrap();
    assert_eq!(pairs(&data), [i16::MAX, i16::MAX, 0, -3_920, 0, 0, i16::MIN]);
}

#[test]
fn a_driver_from_elsewhere_reads_the_plant() {
    let imu = imu(ImuParameters::default());
    let node = RefCell::new(Node::new(turning(), &imu).unwrap());
    let mut delay = NodeDelay::new(&node);
    let bus = I2cEnd::new(&imu).unwrap();
    let mut driver =
        mpu6050_dmp::sensor::Mpu6050::new(bus, mpu6050_dmp::address::Address(ADDRESS)).unwrap();
    driver.set_gyro_full_scale(mpu6050_dmp::gyro::GyroFullScale::Deg500).unwrap();
    embedded_hal::delay::DelayNs::delay_ms(&mut delay, 10);
    let force = driver.accel().unwrap();
    let rate = driver.gyro().unwrap();
    assert_eq!(force.z(), 16_384);
    assert_eq!(rate.z(), (1.5_f64.to_degrees() * 65.5).round() as i16);
}
