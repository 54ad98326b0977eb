//! Program `elements`: what a step of a plain scene costs, and of it with each element of `firmware/qemu/elements`, see
//! `firmware::cost` (target only).
#![cfg_attr(target_os = "none", no_std, no_main)]

use firmware::console::exit;

#[cfg(target_os = "none")]
#[cortex_m_rt::entry]
fn main() -> ! {
    let systick = &mut firmware::board::Board::take().systick;
    exit(firmware::cost::run(systick, |costing| firmware::elements::for_each(costing)))
}

#[cfg(not(target_os = "none"))]
fn main() -> ! {
    firmware::say!("instructions are counted on the target: cargo xtask cost --elements");
    exit(false)
}
