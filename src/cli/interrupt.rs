//! Interrupts by the user: Ctrl-C, `kill`, closing the terminal.

use super::{ExitStatus, complain};
use crate::code::{Interrupt, let_interrupt_questions};
use crate::files::system_text;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;

/// Set when the user interrupts the program.
pub(crate) static INTERRUPT: Interrupt = Interrupt::new();

/// Starts to listen for interrupts. The first one stops the codes; finished runs are printed and kept in the store.
/// A second one ends the program at once, and the guards of the codes with it.
pub(super) fn listen() {
    let_interrupt_questions(&INTERRUPT);
    match Signals::new(wanted()) {
        Ok(mut signals) => {
            std::thread::spawn(move || signals.forever().for_each(|_| interrupt()));
        }
        Err(error) => complain!("warning: interrupts will end the program at once: {error}"),
    }
}

/// Reports that a command ended with `done` of `planned` `subjects` complete.
pub(super) fn interrupted_after(done: usize, planned: usize, subjects: &str) -> ExitStatus {
    complain!(
        "interrupted with {done} of {planned} {subjects} complete; every finished run is kept, and the same \
         command goes on from here"
    );
    ExitStatus::Interrupted
}

fn interrupt() {
    if INTERRUPT.request() {
        std::process::exit(ExitStatus::Interrupted.code().into());
    }
    // From a thread of its own: writing may block, and a second interrupt must not wait for that.
    std::thread::spawn(|| {
        complain!(
            "interrupted: finished runs are kept; a second interrupt ends everything at once"
        );
    });
}

/// The signals that interrupt. SIGHUP is left alone if it was ignored at the start, as under `nohup`. SIGINT is not,
/// although shells start background jobs with it ignored: there it is only sent on purpose.
fn wanted() -> Vec<i32> {
    let status = system_text("/proc/self/status").unwrap_or_default();
    let stays = ignored(&status) >> (SIGHUP - 1) & 1 == 1;
    let mut signals = vec![SIGINT, SIGTERM];
    signals.extend((!stays).then_some(SIGHUP));
    signals
}

/// The mask of ignored signals in the `status` of a process.
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
