//! Program `cost-double`: what a step of every charted model in double precision costs, see `firmware::cost`
//! (target only). One image of 4 MB does not hold them all.
#![cfg_attr(target_os = "none", no_std, no_main)]

use firmware::console::exit;

#[cfg(target_os = "none")]
#[cortex_m_rt::entry]
fn main() -> ! {
    exit(firmware::cost::run_double(&mut firmware::board::Board::take().systick))
}

#[cfg(not(target_os = "none"))]
fn main() -> ! {
    firmware::say!("instructions are counted on the target: cargo xtask cost");
    exit(false)
}
