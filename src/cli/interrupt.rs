//! What the user does to end it: Ctrl-C, `kill`, closing the terminal.

use super::{ExitStatus, tell};
use crate::engine::Interrupt;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;

/// The user's wish to stop.
pub(crate) static INTERRUPT: Interrupt = Interrupt::new();

/// An interrupt stops the engines; what is done is printed, and kept in the store. A second one ends the program
/// at once, and the guards of the engines with it.
pub(super) fn listen() {
    match Signals::new(wanted()) {
        Ok(mut signals) => {
            std::thread::spawn(move || signals.forever().for_each(|_| interrupt()));
        }
        Err(error) => tell!("warning: interrupts will end the program at once: {error}"),
    }
}

fn interrupt() {
    if INTERRUPT.request() {
        std::process::exit(ExitStatus::Interrupted.code().into());
    }
    // Whoever reads the messages may have stopped reading, and a second interrupt is not to wait for that.
    std::thread::spawn(|| {
        tell!("interrupted: finished runs are kept; a second interrupt ends everything at once");
    });
}

/// The signals that interrupt, without those that whoever started this program wants it to ignore, as `nohup` does.
fn wanted() -> Vec<i32> {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = ignored(&status);
    let signals = [SIGINT, SIGTERM, SIGHUP].into_iter();
    signals
        .filter(|signal| ignored >> (signal - 1) & 1 == 0)
        .collect()
}

/// The mask of ignored signals in what the system says of a process.
fn ignored(status: &str) -> u64 {
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok())
        .unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ignored_signals_are_known() {
        let status = "Name:\ttristack\nSigBlk:\t0000000000000007\nSigIgn:\t0000000000001001\n";
        assert_eq!(ignored(status), 0x1001);
        assert_eq!(ignored("Name:\ttristack\n"), 0);
        assert!(wanted().contains(&SIGTERM));
    }
}
