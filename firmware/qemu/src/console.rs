//! Where a program's arguments come from, its lines go and its files lie.
//!
//! On the target: semihosting, with lines as defmt frames that the host decodes. On a host:
//! the command line and standard output. Files are the host's either way.

#[cfg(target_os = "none")]
pub use target::{argument, exit, load, save};

#[cfg(not(target_os = "none"))]
pub use host::{argument, exit, load, save};

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

/// Logs one line at a level: `info`, `warn` or `error`. On the target those of the levels that the image
/// was built with (`DEFMT_LOG`); on a host on standard error.
#[cfg(target_os = "none")]
#[macro_export]
macro_rules! log {
    ($level:ident, $($line:tt)*) => { ::defmt::$level!($($line)*) };
}

/// Logs one line at a level: `info`, `warn` or `error`. On the target those of the levels that the image
/// was built with (`DEFMT_LOG`); on a host on standard error.
#[cfg(not(target_os = "none"))]
#[macro_export]
macro_rules! log {
    ($level:ident, $($line:tt)*) => {
        ::std::eprintln!("{}: {}", stringify!($level), ::std::format_args!($($line)*))
    };
}

#[cfg(target_os = "none")]
mod target {
    use core::ffi::CStr;
    use core::str::FromStr;
    use defmt_semihosting as _;

    use semihosting::experimental::env;
    use semihosting::fs;
    use semihosting::io::Read as _;

    /// The argument at a position, counted from 0; `None` if it is missing or of another kind.
    #[must_use]
    pub fn argument<T: FromStr>(position: usize) -> Option<T> {
        // The first is the name of the image.
        let arguments = env::args::<256>().ok()?;
        (&arguments).nth(position + 1)?.ok()?.parse().ok()
    }

    /// Ends the program; the emulator's exit status tells whether it went well.
    pub fn exit(well: bool) -> ! {
        semihosting::process::exit(i32::from(!well))
    }

    /// Writes a file; whether it is complete.
    pub fn save(path: &CStr, bytes: &[u8]) -> bool {
        fs::write(path, bytes).is_ok()
    }

    /// Reads a file; `None` if it is missing or does not fit.
    pub fn load<'b>(path: &CStr, buffer: &'b mut [u8]) -> Option<&'b [u8]> {
        let mut file = fs::File::open(path).ok()?;
        let mut filled = 0;
        while let Some(rest @ [_, ..]) = buffer.get_mut(filled..) {
            match file.read(rest).ok()? {
                0 => return buffer.get(..filled),
                count => filled += count,
            }
        }
        None
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
    use core::ffi::CStr;
    use core::str::FromStr;

    /// The argument at a position, counted from 0; `None` if it is missing or of another kind.
    #[must_use]
    pub fn argument<T: FromStr>(position: usize) -> Option<T> {
        std::env::args().nth(position + 1)?.parse().ok()
    }

    /// Writes a file; whether it is complete.
    pub fn save(path: &CStr, bytes: &[u8]) -> bool {
        path.to_str().is_ok_and(|path| std::fs::write(path, bytes).is_ok())
    }

    /// Reads a file; `None` if it is missing or does not fit.
    pub fn load<'b>(path: &CStr, buffer: &'b mut [u8]) -> Option<&'b [u8]> {
        let bytes = std::fs::read(path.to_str().ok()?).ok()?;
        let buffer = buffer.get_mut(..bytes.len())?;
        buffer.copy_from_slice(&bytes);
        Some(buffer)
    }

    /// Ends the program with a status that tells whether it went well.
    pub fn exit(well: bool) -> ! {
        std::process::exit(i32::from(!well))
    }
}
