//! The plant's end: sleeps until a byte or a tick is there, and gives it to the plant.

use dbd_link::message::Statistics;
use dbd_link::{Device, PlantEnd};

use super::line::BoardLine;
use crate::say;

/// Serves a plant indefinitely, or with `once` until a session has ended.
pub fn serve<D: Device, const N: usize>(
    scene: &str,
    mut end: PlantEnd<D, N>,
    line: &mut BoardLine,
    once: bool,
) {
    line.restart_ticks();
    loop {
        // No more than there are now: a tick must not wait for a line that is never silent.
        for _ in 0..line.waiting() {
            let (byte, open) = (line.received(), end.is_open());
            if let Some(byte) = byte {
                end.receive(byte, line);
            }
            if open && !end.is_open() {
                end.lost(line.lost());
                let device = end.device();
                report(scene, end.statistics(), device.step(), device.hash());
                if once {
                    return line.finish();
                }
                // The report's time is not the plant's.
                line.restart_ticks();
            }
        }
        end.lost(line.lost());
        if let Some(missed) = line.tick() {
            end.tick(missed, line);
        }
        line.sleep();
    }
}

/// One line with the counts since the start.
fn report(scene: &str, seen: &Statistics, step: u64, hash: u64) {
    say!(
        "hil plant {} frames good {} bad {} late {} dropped {} foreign {} refused {} repeated {}, bytes lost {}, \
         ticks {} overruns {} timeouts {}, slowest step {} cycles, at step {} hash {:016x}",
        scene,
        seen.good,
        seen.bad,
        seen.late,
        seen.dropped,
        seen.foreign,
        seen.refused,
        seen.repeated,
        seen.lost,
        seen.ticks,
        seen.overruns,
        seen.timeouts,
        seen.slowest,
        step,
        hash
    );
}
