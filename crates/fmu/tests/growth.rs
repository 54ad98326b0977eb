//! A thousand instances, one after the other: for `valgrind`, see docs/fmu.md.

mod host;

use dbd_fmu::Fmi;
use dbd_fmu::calls::OK;
use dbd_plant::instance::Settings;
use host::{scene, unpacked};

#[test]
#[ignore = "for valgrind"]
fn a_thousand_instances_leave_nothing() {
    let count = std::env::var("INSTANCES").map_or(1000, |count| count.parse().unwrap());
    for fmi in [Fmi::Two, Fmi::Three] {
        let fmu = unpacked(scene("cart-pendulum"), Settings::default(), fmi);
        for _ in 0..count {
            let host = fmu.stepping();
            assert_eq!(host.step(0.0, fmu.description.communication_step), OK);
            // Neither freed nor taken up: it goes with the instance.
            host.keep().unwrap();
            host.free();
        }
    }
}
