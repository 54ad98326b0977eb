//! Handling of termination: Ctrl-C (SIGINT), SIGTERM, a closed terminal (SIGHUP), SIGQUIT.
//!
//! `signal => incomplete files are removed => default action of the signal`. The process then ends
//! by the signal as without a handler: shells report 130 or 143, for example, and scripts stop.

/// Installs a handler that removes incomplete files before a signal ends the program.
#[cfg(unix)]
pub fn clean_up_on_signals() {
    use dbd_report::output::file::give_up_all;
    use signal_hook::consts::{SIGHUP, SIGINT, SIGQUIT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    // The program also works without it.
    let mut handled = vec![SIGINT, SIGQUIT, SIGTERM];
    // A handler would end a run under nohup, which ignores SIGHUP, with its terminal.
    if ignored_signals().is_some_and(|ignored| ignored & (1 << (SIGHUP - 1)) == 0) {
        handled.push(SIGHUP);
    }
    let Ok(mut signals) = Signals::new(handled) else { return };
    std::thread::spawn(move || {
        if let Some(signal) = signals.forever().next() {
            let _held = give_up_all();
            // If the signal does not end the process, its exit code does.
            let _ = emulate_default_handler(signal);
            std::process::exit(128 + signal);
        }
    });
}

/// The mask of the signals that are ignored, bit 0 for signal 1; `None` where the system has no `/proc`.
#[cfg(unix)]
fn ignored_signals() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"))?;
    u64::from_str_radix(mask.trim(), 16).ok()
}

/// Elsewhere the system ends a program without a handler.
#[cfg(not(unix))]
pub fn clean_up_on_signals() {}
