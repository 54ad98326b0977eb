//! Plants on an STM32F405 with the community's HAL: the same steps as on a PC, paced by a timer.
//!
//! `scenes => const models => steps, one per tick => lines over the UART`. The programs differ in who calls
//! [`runs::Run::tick`]: a loop (`plain`), an interrupt's task (`rtic`) or an async task (`embassy`).
//!
//! # Modules
//!
//! Each uses only those before it:
//!
//! - [`board`]: clock, console and timer.
//! - [`panic`]: the panic handler.
//! - [`models`]: the scenes' models.
//! - [`runs`]: the runs of every program.
#![no_std]

pub mod board;
pub mod models;
pub mod panic;
pub mod runs;
