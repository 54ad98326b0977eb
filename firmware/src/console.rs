//! Where a program's arguments come from and its lines go.
//!
//! On the target: semihosting, with lines as defmt frames that the host decodes. On a host:
//! the command line and standard output.

#[cfg(target_os = "none")]
pub use target::{exit, numbers};

#[cfg(not(target_os = "none"))]
pub use host::{exit, numbers};

/// Prints one line.
#[cfg(target_os = "none")]
#[macro_export]
macro_rules! say {
    ($($line:tt)*) => { ::defmt::println!($($line)*) };
}

/// Prints one line.
#[cfg(not(target_os = "none"))]
#[macro_export]
macro_rules! say {
    ($($line:tt)*) => { ::std::println!($($line)*) };
}

#[cfg(target_os = "none")]
mod target {
    use defmt_semihosting as _;
    use semihosting::experimental::env;

    /// The program's arguments, as many as are numbers, in order.
    #[must_use]
    pub fn numbers<const N: usize>() -> [Option<u64>; N] {
        let mut numbers = [None; N];
        // The first is the name of the image.
        if let Ok(arguments) = env::args::<256>() {
            let values = arguments.skip(1).filter_map(|a| a.ok()?.parse().ok());
            for (number, value) in numbers.iter_mut().zip(values) {
                *number = Some(value);
            }
        }
        numbers
    }

    /// Ends the program; the emulator's exit status tells whether it went well.
    pub fn exit(well: bool) -> ! {
        semihosting::process::exit(i32::from(!well))
    }

    #[cfg(not(feature = "audit"))]
    #[panic_handler]
    fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
        defmt::error!("{}", defmt::Display2Format(info));
        exit(false)
    }
}

#[cfg(not(target_os = "none"))]
mod host {
    /// The program's arguments, as many as are numbers, in order.
    #[must_use]
    pub fn numbers<const N: usize>() -> [Option<u64>; N] {
        let mut numbers = [None; N];
        let values = std::env::args().skip(1).filter_map(|a| a.parse().ok());
        for (number, value) in numbers.iter_mut().zip(values) {
            *number = Some(value);
        }
        numbers
    }

    /// Ends the program with a status that tells whether it went well.
    pub fn exit(well: bool) -> ! {
        std::process::exit(i32::from(!well))
    }
}
