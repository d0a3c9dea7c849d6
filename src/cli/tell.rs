//! Messages on standard error.

/// Writes a line to standard error; a closed pipe is no reason to stop.
macro_rules! tell {
    ($($message:tt)*) => {{
        use std::io::Write as _;
        let _ = writeln!(std::io::stderr(), $($message)*);
    }};
}

pub(crate) use tell;
