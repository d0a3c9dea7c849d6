//! Limits that the system sets to this process: no further thread, no longer file.

use super::{ExitStatus, complain};
use signal_hook::consts::SIGXFSZ;
use std::panic::PanicHookInfo;
use std::sync::Arc;

/// Lets a limit of the system end the program with a sentence and a status from now on.
pub(super) fn explain() {
    // Without a handler the signal would kill the program; with one the write fails, and the file is named. Programs that
    // are started do not inherit a handler.
    if let Err(error) = signal_hook::flag::register(SIGXFSZ, Arc::default()) {
        complain!("warning: a limit on the size of files will end the program at once: {error}");
    }
    let otherwise = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if !is_without_threads(panic) {
            return otherwise(panic);
        }
        complain!(
            "error: the system starts no further thread for this user; accepted is a higher limit of processes (ulimit -u, \
             pids.max of the control group) or of memory, or fewer --jobs"
        );
        std::process::exit(ExitStatus::CodeFailed.code().into());
    }));
}

/// Whether the standard library or rayon has panicked since the system starts no thread: neither returns that error
/// everywhere.
fn is_without_threads(panic: &PanicHookInfo) -> bool {
    let message = panic.payload().downcast_ref::<String>();
    message.is_some_and(|message| {
        let starts = message.contains("failed to spawn thread")
            || message.contains("thread pool has not been initialized");
        starts && message.contains("kind: WouldBlock")
    })
}
