//! Results on standard output, messages on standard error.

use super::ExitStatus;
use std::io::Write;

/// Writes a line to standard error; a closed pipe is no reason to stop.
macro_rules! tell {
    ($($message:tt)*) => {{
        use std::io::Write as _;
        let _ = writeln!(std::io::stderr(), $($message)*);
    }};
}

pub(crate) use tell;

/// Writes results to standard output; a closed pipe is no error, and any other one is told.
pub(crate) fn print(text: &str) -> ExitStatus {
    let mut output = std::io::stdout().lock();
    let written = output
        .write_all(text.as_bytes())
        .and_then(|()| output.flush());
    match written {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            tell!("error: cannot write standard output: {error}");
            ExitStatus::NotWritten
        }
        _ => ExitStatus::Success,
    }
}
