//! What happens where a program is told to end: Ctrl-C (SIGINT) or SIGTERM.
//!
//! `signal => files that are not complete are removed => the signal's own end`. The process then dies
//! of the signal, as if nobody had waited for it: shells see 130 or 143, and scripts stop, too.

/// From now on a signal that ends the program removes first what is not complete.
#[cfg(unix)]
pub fn clean_up_on_signals() {
    use dbd_output::file::give_up_all;
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    // Without it the program works all the same.
    let Ok(mut signals) = Signals::new([SIGINT, SIGTERM]) else { return };
    std::thread::spawn(move || {
        if let Some(signal) = signals.forever().next() {
            let _held = give_up_all();
            // Where the signal does not end the process, its code does.
            let _ = emulate_default_handler(signal);
            std::process::exit(128 + signal);
        }
    });
}

/// Elsewhere the system ends a program without asking.
#[cfg(not(unix))]
pub fn clean_up_on_signals() {}
