//! Program `plant [NAME [TICKS [PERIOD]]]`: controller and plant in one image, at the rate of the board's
//! timer; see [`firmware::closed_loop`].
//!
//! `cart-pendulum` is balanced, `delta-pick-and-place` led along a circle. PERIOD \[µs\] is the loop's own
//! where it is not given. A host runs the same ticks as fast as they go and prints the same lines but
//! the last one.
#![cfg_attr(target_os = "none", no_std, no_main)]

use firmware::closed_loop::{CartPendulum, Delta, Loop, run};
use firmware::console::{argument, exit};
use firmware::say;

#[cfg_attr(target_os = "none", cortex_m_rt::entry)]
fn main() -> ! {
    let known: Option<Name> = argument(0);
    exit(match known {
        Some(Name::CartPendulum) => paced(&CartPendulum),
        Some(Name::Delta) => paced(&Delta),
        None => {
            say!("the first argument names a loop: {} or {}", CartPendulum::NAME, Delta::NAME);
            false
        }
    })
}

enum Name {
    CartPendulum,
    Delta,
}

impl core::str::FromStr for Name {
    type Err = ();

    fn from_str(name: &str) -> Result<Self, ()> {
        match name {
            CartPendulum::NAME => Ok(Self::CartPendulum),
            Delta::NAME => Ok(Self::Delta),
            _ => Err(()),
        }
    }
}

/// Ticks where none are given.
const TICKS: u32 = 10_000;

#[cfg(target_os = "none")]
fn paced<L: Loop>(the_loop: &L) -> bool {
    let board = firmware::board::Board::take();
    let period = argument(2).unwrap_or(L::PERIOD);
    let mut ticks = board.delay.into_ticks(period);
    run(the_loop, argument(1).unwrap_or(TICKS), &mut ticks)
}

#[cfg(not(target_os = "none"))]
fn paced<L: Loop>(the_loop: &L) -> bool {
    let mut pace = firmware::closed_loop::Unpaced;
    run(the_loop, argument(1).unwrap_or(TICKS), &mut pace)
}
