//! What the user does to end it: Ctrl-C, `kill`, closing the terminal.

use super::{ExitStatus, tell};
use crate::code::Interrupt;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;

/// The user's wish to stop.
pub(crate) static INTERRUPT: Interrupt = Interrupt::new();

/// An interrupt stops the codes; what is done is printed, and kept in the store. A second one ends the program
/// at once, and the guards of the codes with it.
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
    // Whoever reads the messages may have stopped summary, and a second interrupt is not to wait for that.
    std::thread::spawn(|| {
        tell!("interrupted: finished runs are kept; a second interrupt ends everything at once");
    });
}

/// The signals that interrupt. Closing the terminal does not, if whoever started this program wants that, as `nohup`
/// does. (Shells also let what they start in the background ignore Ctrl-C, but whoever sends it there means it.)
fn wanted() -> Vec<i32> {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let stays = ignored(&status) >> (SIGHUP - 1) & 1 == 1;
    let mut signals = vec![SIGINT, SIGTERM];
    signals.extend((!stays).then_some(SIGHUP));
    signals
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
    }
}
