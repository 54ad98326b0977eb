//! Program `hil plant SCENE [PERIOD_US [once]]` or `hil controller [TICKS [SESSION]]`: hardware in the loop over UART 0;
//! see [`firmware::hil`].
//!
//! A plant `cart-pendulum` or `four-bar` is stepped by the frames of a controller, or by a timer every PERIOD_US
//! \[µs\]; the program ends after a session where `once` is given. A controller balances the cart-pendulum at the far
//! end for TICKS; SESSION is another number than that of a session that was not ended.
#![cfg_attr(target_os = "none", no_std, no_main)]

use firmware::console::exit;

#[cfg(target_os = "none")]
#[cortex_m_rt::entry]
fn main() -> ! {
    exit(firmware::hil::run())
}

#[cfg(not(target_os = "none"))]
fn main() {
    firmware::say!("this program runs on the target only");
    exit(false)
}
