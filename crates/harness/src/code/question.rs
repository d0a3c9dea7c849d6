//! Questions to programs, whose answer is what they print.

use super::failure::FailureKind;
use super::interrupt::Interrupt;
use super::manifest::Environment;
use super::process::{Job, run};
use crate::files::Scratch;
use std::ffi::OsString;
use std::sync::OnceLock;
use std::time::Duration;

/// Attempts at a question if a signal ends the program or its guard: the answer becomes part of the address of every run.
const TRIES: usize = 3;

static NEVER: Interrupt = Interrupt::new();
static INTERRUPT: OnceLock<&Interrupt> = OnceLock::new();

/// Lets `interrupt` end questions from now on.
pub fn let_interrupt_questions(interrupt: &'static Interrupt) {
    let _ = INTERRUPT.set(interrupt);
}

/// Returns the interrupt that ends questions.
pub(super) fn interrupt() -> &'static Interrupt {
    INTERRUPT.get().copied().unwrap_or(&NEVER)
}

/// Runs `command` and returns its standard output; `None` if it ends with an error status.
///
/// The program gets an empty directory as its home and working directory, which is removed afterwards, because some
/// programs write to one of the two.
///
/// # Errors
/// If it cannot be started, takes longer than `time_limit`, or is ended by a signal at every attempt.
pub(super) fn answer(
    command: &[OsString],
    environment: &Environment,
    time_limit: Duration,
) -> Result<Option<String>, FailureKind> {
    let home = Scratch::new()?;
    let job = Job {
        command,
        directory: home.path(),
        home: home.path(),
        environment,
        time_limit,
        interrupt: interrupt(),
    };
    let mut tries = 0;
    loop {
        tries += 1;
        let (status, text) = match run(&job, Vec::new(), std::io::sink(), || false) {
            // Whatever killed the guard may have been passing.
            Err(FailureKind::Unguarded) if tries < TRIES => continue,
            ended => ended?,
        };
        if status.code().is_some() {
            let text = String::from_utf8_lossy(&text.unwrap_or_default()).into_owned();
            return Ok(status.success().then_some(text));
        }
        if tries == TRIES {
            return Err(FailureKind::Ended(status));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ask(command: &[&str]) -> Result<Option<String>, FailureKind> {
        let command: Vec<OsString> = command.iter().map(OsString::from).collect();
        answer(&command, &Environment::new(), Duration::from_secs(1))
    }

    #[test]
    fn only_a_program_that_ends_by_itself_has_answered() {
        assert_eq!(ask(&["echo", "1.2"]).unwrap().as_deref(), Some("1.2\n"));
        assert_eq!(ask(&["false"]).unwrap(), None);
        assert!(matches!(
            ask(&["sleep", "60"]),
            Err(FailureKind::TimedOut(_))
        ));
    }
}
