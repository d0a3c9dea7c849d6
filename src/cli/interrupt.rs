//! Early stops: interrupts by the user (Ctrl-C, `kill`, closing the terminal), and the time limit of a command.

use super::{ExitStatus, complain, tell};
use crate::code::{Interrupt, let_interrupt_questions};
use crate::files::system_text;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGUSR1};
use signal_hook::iterator::Signals;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

/// Longest time that is kept back for the end: killing programs takes at most five seconds, keeping results far less.
const LONGEST_RESERVE: Duration = Duration::from_secs(30);
/// The time is divided by this for the part that is kept back, up to [`LONGEST_RESERVE`].
const RESERVE: u32 = 10;

/// Set when the user interrupts the program, or its time is up.
pub(crate) static INTERRUPT: Interrupt = Interrupt::new();
/// When the program began.
static START: LazyLock<Instant> = LazyLock::new(Instant::now);

/// Starts to listen for interrupts. The first one stops the codes; finished runs are printed and kept in the store.
/// A second one ends the program at once, and the guards of the codes with it.
pub(super) fn listen() {
    LazyLock::force(&START);
    let_interrupt_questions(&INTERRUPT);
    match Signals::new(wanted()) {
        Ok(mut signals) => {
            std::thread::spawn(move || signals.forever().for_each(receive));
        }
        Err(error) => complain!("warning: interrupts will end the program at once: {error}"),
    }
}

/// Reports that a command ended with `done` of `planned` `subjects` complete.
pub(super) fn interrupted_after(done: usize, planned: usize, subjects: &str) -> ExitStatus {
    let ended = match INTERRUPT.is_for_time() {
        true => "out of time",
        false => "interrupted",
    };
    complain!(
        "{ended} with {done} of {planned} {subjects} complete; every finished run is kept, and the same \
         command goes on from here"
    );
    ExitStatus::Interrupted
}

/// Ends everything before the time `left` has passed since the program began. A tenth of it is kept back, at most
/// half a minute.
pub(super) fn end_within(left: Duration) {
    let usable = left - LONGEST_RESERVE.min(left / RESERVE);
    if INTERRUPT.limit(*START, usable) {
        std::thread::spawn(move || {
            std::thread::sleep(usable.saturating_sub(START.elapsed()));
            end_time();
        });
    }
}

fn receive(signal: i32) {
    match signal {
        SIGUSR1 => end_time(),
        _ => interrupt(),
    }
}

/// Stops everything because the time is up, which batch systems announce with SIGUSR1.
fn end_time() {
    if !INTERRUPT.end_time() {
        notify(|| {
            tell!("out of time: finished runs are kept, and what native runs have done so far")
        });
    }
}

fn interrupt() {
    if INTERRUPT.request() {
        std::process::exit(ExitStatus::Interrupted.code().into());
    }
    notify(|| {
        complain!("interrupted: finished runs are kept; a second interrupt ends everything at once")
    });
}

/// Writes a note from a thread of its own: writing may block, and a second interrupt must not wait for that. Where the
/// system starts no thread, there is no note.
fn notify(write: impl FnOnce() + Send + 'static) {
    let _ = std::thread::Builder::new().spawn(write);
}

/// Returns the signals that interrupt. SIGHUP is left alone if it was ignored at the start, as under `nohup`. SIGINT
/// is not, although shells start background jobs with it ignored: there it is only sent on purpose.
fn wanted() -> Vec<i32> {
    let status = system_text("/proc/self/status").unwrap_or_default();
    let stays = ignored(&status) >> (SIGHUP - 1) & 1 == 1;
    let mut signals = vec![SIGINT, SIGTERM, SIGUSR1];
    signals.extend((!stays).then_some(SIGHUP));
    signals
}

/// Returns the mask of ignored signals in the `status` of a process.
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
