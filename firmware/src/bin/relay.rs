//! Program `relay PART`: 0 whole runs, 1 their first halves, 2 their second halves, see
//! [`firmware::relay`].
#![cfg_attr(target_os = "none", no_std, no_main)]

use firmware::console::{exit, numbers};
use firmware::relay::{Part, run};

#[cfg_attr(target_os = "none", cortex_m_rt::entry)]
fn main() -> ! {
    let [part] = numbers();
    let part = match part {
        Some(1) => Part::Begin,
        Some(2) => Part::End,
        _ => Part::Whole,
    };
    exit(run(part))
}
