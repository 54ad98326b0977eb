//! `PROGRAM [NUMBER…]`: one image for all programs, selected by name.
//!
//! - `board`: every driver once, against the emulated hardware (target only).
//! - `hash [STEPS [MILLION_INSTRUCTIONS [fixed]]]`: hashes of all shipped models, or of those in fixed point, see
//!   [`firmware::hash`].
//!   Without limits: 10,000 steps, 3,000 million instructions.
//! - `relay [PART]`: 0 whole runs, 1 their first halves, 2 their second halves, see
//!   [`firmware::relay`].
//! - `root`: square roots in single precision, see [`firmware::root`].
//! - `sample`: what a step costs, of some models and schemes, see `firmware::cost` (target only).
//! - `sensors`: bits of sensors and motors, see [`firmware::sensors`].
//! - `trajectory`: a run as a golden file, see [`firmware::trajectory`].
#![cfg_attr(target_os = "none", no_std, no_main)]

use core::str::FromStr;

use firmware::console::{argument, exit};
use firmware::hash::Limits;
use firmware::relay::Part;
use firmware::{hash, relay, root, say, sensors, trajectory};

enum Program {
    Board,
    Hash,
    Relay,
    Root,
    Sample,
    Sensors,
    Trajectory,
}

impl FromStr for Program {
    type Err = ();

    fn from_str(name: &str) -> Result<Self, ()> {
        match name {
            "board" => Ok(Self::Board),
            "hash" => Ok(Self::Hash),
            "relay" => Ok(Self::Relay),
            "root" => Ok(Self::Root),
            "sample" => Ok(Self::Sample),
            "sensors" => Ok(Self::Sensors),
            "trajectory" => Ok(Self::Trajectory),
            _ => Err(()),
        }
    }
}

#[cfg_attr(target_os = "none", cortex_m_rt::entry)]
fn main() -> ! {
    exit(match argument(0) {
        Some(Program::Board) => machine::board(),
        Some(Program::Hash) => hash::run(limits(), &mut machine::counter()),
        Some(Program::Relay) => relay::run(part()),
        Some(Program::Root) => root::run(),
        Some(Program::Sample) => machine::sample(),
        Some(Program::Sensors) => sensors::run(),
        Some(Program::Trajectory) => trajectory::run(),
        None => {
            say!(
                "the first argument names a program: board, hash, relay, root, sample, sensors or trajectory"
            );
            false
        }
    })
}

fn limits() -> Limits {
    let millions: u64 = argument(2).unwrap_or(3_000);
    Limits {
        steps: argument(1).unwrap_or(10_000),
        instructions: millions.saturating_mul(1_000_000),
        which: argument(3).unwrap_or_default(),
    }
}

fn part() -> Part {
    match argument(1) {
        Some(1) => Part::Begin,
        Some(2) => Part::End,
        _ => Part::Whole,
    }
}

/// What needs the board.
#[cfg(target_os = "none")]
mod machine {
    use firmware::board::{Board, tried};
    use firmware::cost;
    use firmware::hash::InstructionCounter;
    use firmware::sample::for_each_sampled;

    pub fn board() -> bool {
        tried::run(Board::take())
    }

    pub fn counter() -> impl InstructionCounter {
        Board::take().timer
    }

    pub fn sample() -> bool {
        cost::run(&mut Board::take().systick, |costing| for_each_sampled(costing))
    }
}

/// What a host has in its place.
#[cfg(not(target_os = "none"))]
mod machine {
    use firmware::hash::{InstructionCounter, Uncounted};
    use firmware::say;

    pub fn board() -> bool {
        say!("the drivers are tested on the target: cargo xtask fw board");
        false
    }

    pub fn counter() -> impl InstructionCounter {
        Uncounted
    }

    pub fn sample() -> bool {
        say!("instructions are counted on the target: cargo xtask fw sample");
        false
    }
}
