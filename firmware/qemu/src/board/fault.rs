//! A hard fault ends the program instead of hanging it.

use cortex_m_rt::{ExceptionFrame, exception};

use crate::console::exit;

// The runtime calls it from an exception, which its attribute makes unsafe to declare.
#[allow(unsafe_code)]
#[exception]
unsafe fn HardFault(frame: &ExceptionFrame) -> ! {
    defmt::error!("hard fault at {=u32:#010x}", frame.pc());
    exit(false)
}
