//! What the program `hil` does, by its arguments.

use heapless::String;

use super::controller::RemoteCartPendulum;
use super::line::BoardLine;
use super::plant::serve;
use super::plants;
use crate::board::Board;
use crate::closed_loop::{Unpaced, run as run_loop};
use crate::console::argument;
use crate::say;

/// A word of the arguments.
type Word = String<32>;

/// \[µs\] from tick to tick where it is not given.
const PERIOD: u32 = 1_000;
/// Ticks of a controller where they are not given.
const TICKS: u32 = 10_000;

/// Runs one end as the program's arguments say; whether all went well.
// Compiled with the program that calls it, not with the library, which the other images link too.
#[must_use]
#[inline]
pub fn run() -> bool {
    let role: Option<Word> = argument(0);
    match role.as_deref() {
        Some("plant") => plant(),
        Some("controller") => controller(),
        _ => {
            say!(
                "the arguments are: plant SCENE [PERIOD_US [once]], or controller [TICKS [SESSION]]"
            );
            false
        }
    }
}

#[inline]
fn plant() -> bool {
    let scene: Option<Word> = argument(1);
    let last: Option<Word> = argument(3);
    let once = last.as_deref() == Some("once");
    let mut line = BoardLine::new(Board::take(), argument(2).unwrap_or(PERIOD));
    let period = line.period();
    let served = match scene.as_deref() {
        Some(plants::CART_PENDULUM) => plants::cart_pendulum(period)
            .map(|end| serve(plants::CART_PENDULUM, end, &mut line, once)),
        Some(plants::FOUR_BAR) => {
            plants::four_bar(period).map(|end| serve(plants::FOUR_BAR, end, &mut line, once))
        }
        _ => None,
    };
    if served.is_none() {
        say!("the scene is one of: {}, {}", plants::CART_PENDULUM, plants::FOUR_BAR);
    }
    served.is_some()
}

#[inline]
fn controller() -> bool {
    let line = BoardLine::new(Board::take(), PERIOD);
    let the_loop = RemoteCartPendulum::new(line, argument(2).unwrap_or(1));
    let well = run_loop(&the_loop, argument(1).unwrap_or(TICKS), &mut Unpaced);
    let (mut line, seen) = the_loop.into_parts();
    line.finish();
    say!(
        "hil controller {} frames sent {} good {} bad {} late {} dropped {} foreign {} refused {} repeated {}, \
         bytes lost {}",
        plants::CART_PENDULUM,
        seen.sent,
        seen.good,
        seen.bad,
        seen.late,
        seen.dropped,
        seen.foreign,
        seen.refused,
        seen.repeated,
        line.lost()
    );
    well
}
