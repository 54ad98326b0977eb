//! Program `hash [STEPS [MILLION_INSTRUCTIONS]]`: hashes of all shipped models, see
//! [`firmware::hash`]. Without limits: 10,000 steps, 3,000 million instructions.
#![cfg_attr(target_os = "none", no_std, no_main)]

use firmware::console::{exit, numbers};
use firmware::hash::{InstructionCounter, Limits, run};

#[cfg_attr(target_os = "none", cortex_m_rt::entry)]
fn main() -> ! {
    let [steps, millions] = numbers();
    let limits = Limits {
        steps: steps.unwrap_or(10_000),
        instructions: millions.unwrap_or(3_000).saturating_mul(1_000_000),
    };
    exit(run(limits, &mut counter()))
}

#[cfg(target_os = "none")]
fn counter() -> impl InstructionCounter {
    firmware::board::Board::take().timer
}

#[cfg(not(target_os = "none"))]
fn counter() -> impl InstructionCounter {
    struct Nobody;
    impl InstructionCounter for Nobody {
        fn count(&mut self) -> u64 {
            0
        }
    }
    Nobody
}
