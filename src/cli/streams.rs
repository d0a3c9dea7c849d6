//! Results on standard output, messages on standard error.

use super::{CliError, ExitStatus};
use crate::files::FileError;
use std::io::Write;
use std::path::Path;

/// Writes a line to standard error; a closed pipe is no reason to stop.
macro_rules! tell {
    ($($message:tt)*) => {{
        use std::io::Write as _;
        let _ = writeln!(std::io::stderr(), $($message)*);
    }};
}

pub(crate) use tell;

/// Writes results to standard output; a closed pipe is no error.
pub(crate) fn print(text: &str) -> Result<ExitStatus, CliError> {
    let mut output = std::io::stdout().lock();
    let written = output
        .write_all(text.as_bytes())
        .and_then(|()| output.flush());
    match written {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(FileError::writing(Path::new("standard output"))(error).into())
        }
        _ => Ok(ExitStatus::Success),
    }
}
