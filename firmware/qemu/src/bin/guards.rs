//! Program `guards`: what guards cost beside their step, of the models of `sample`, see
//! `firmware::guards` (target only). An image of its own: in that of the sample they would change how
//! its steps are compiled.
#![cfg_attr(target_os = "none", no_std, no_main)]

use firmware::console::exit;

#[cfg(target_os = "none")]
#[cortex_m_rt::entry]
fn main() -> ! {
    let systick = &mut firmware::board::Board::take().systick;
    exit(firmware::guards::run(systick, |guarding| firmware::sample::for_each_sampled(guarding)))
}

#[cfg(not(target_os = "none"))]
fn main() -> ! {
    firmware::say!("instructions are counted on the target: cargo xtask cost --guards");
    exit(false)
}
