//! Every hardware number of the board, with its source.
//!
//! - AN386: Arm application note 386, "ARM Cortex-M4 SMM on V2M-MPS2"; memory map of section 3.
//! - CMSDK: Arm Cortex-M System Design Kit Technical Reference Manual (DDI 0479), chapter 4,
//!   APB components.

/// \[Hz\] main clock, also the peripherals' and SysTick's (AN386, clocks: 25 MHz).
pub const CLOCK_HZ: u32 = 25_000_000;

/// Timer 0 (AN386, APB peripherals; CMSDK APB timer).
pub const TIMER0: usize = 0x4000_0000;
/// Timer 1.
pub const TIMER1: usize = 0x4000_1000;
/// Interrupt of timer 1 (AN386, interrupt assignments).
pub const TIMER1_INTERRUPT: u16 = 9;
/// UART 0 (AN386, APB peripherals; CMSDK APB UART).
pub const UART0: usize = 0x4000_4000;
/// Interrupt of UART 0: a byte was received (AN386, interrupt assignments).
pub const UART0_RX_INTERRUPT: u16 = 0;
/// Interrupt of UART 0: the transmit buffer was emptied.
pub const UART0_TX_INTERRUPT: u16 = 1;
/// FPGA system control and I/O (AN386, section "FPGA system control and I/O").
pub const FPGAIO: usize = 0x4002_8000;

/// Registers of the CMSDK APB timer and their bits.
pub mod timer {
    /// Control.
    pub const CTRL: usize = 0x0;
    /// Control: count.
    pub const CTRL_ENABLE: u32 = 1 << 0;
    /// Control: interrupt when the count reaches 0.
    pub const CTRL_INTERRUPT: u32 = 1 << 3;
    /// The present count, downwards.
    pub const VALUE: usize = 0x4;
    /// What follows a count of 0.
    pub const RELOAD: usize = 0x8;
    /// Write 1: the interrupt is served.
    pub const INTERRUPT_CLEAR: usize = 0xc;
    /// The longest period in clock ticks.
    pub const MAX_PERIOD: u32 = u32::MAX;
}

/// Registers of the CMSDK APB UART and their bits.
pub mod uart {
    /// One byte, either direction.
    pub const DATA: usize = 0x0;
    /// State of the two buffers of one byte.
    pub const STATE: usize = 0x4;
    /// State: the transmit buffer is full.
    pub const STATE_TX_FULL: u32 = 1 << 0;
    /// State: the receive buffer holds a byte.
    pub const STATE_RX_FULL: u32 = 1 << 1;
    /// State: a byte arrived while the receive buffer was full; written as 1 to clear.
    pub const STATE_RX_OVERRUN: u32 = 1 << 3;
    /// Control.
    pub const CTRL: usize = 0x8;
    /// Control: transmit.
    pub const CTRL_TX_ENABLE: u32 = 1 << 0;
    /// Control: receive.
    pub const CTRL_RX_ENABLE: u32 = 1 << 1;
    /// Control: interrupt when the transmit buffer gets empty.
    pub const CTRL_TX_INTERRUPT: u32 = 1 << 2;
    /// Control: interrupt when a byte was received.
    pub const CTRL_RX_INTERRUPT: u32 = 1 << 3;
    /// Write 1 to a bit: that interrupt is served.
    pub const INTERRUPT_CLEAR: usize = 0xc;
    /// The interrupt of the transmit buffer.
    pub const INTERRUPT_TX: u32 = 1 << 0;
    /// The interrupt of the receive buffer.
    pub const INTERRUPT_RX: u32 = 1 << 1;
    /// Clock over bit rate, ≥ 16.
    pub const BAUD_DIVISOR: usize = 0x10;
    /// Smallest divisor.
    pub const BAUD_DIVISOR_MIN: u32 = 16;
}

/// Registers of the FPGA's I/O and their bits.
pub mod fpgaio {
    /// The user LEDs, one bit each.
    pub const LED0: usize = 0x0;
    /// Bits of the two user LEDs.
    pub const USER_LEDS: [u32; 2] = [1 << 0, 1 << 1];
}
