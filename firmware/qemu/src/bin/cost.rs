//! Program `cost`: what a step of every shipped model and every charted one in single precision costs, see
//! `firmware::cost` (target only). An image of its own: nobody who runs the other programs waits for so many steps.
#![cfg_attr(target_os = "none", no_std, no_main)]

use firmware::console::exit;

#[cfg(target_os = "none")]
#[cortex_m_rt::entry]
fn main() -> ! {
    exit(firmware::cost::run_single(&mut firmware::board::Board::take().systick))
}

#[cfg(not(target_os = "none"))]
fn main() -> ! {
    firmware::say!("instructions are counted on the target: cargo xtask cost");
    exit(false)
}
