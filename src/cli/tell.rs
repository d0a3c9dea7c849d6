//! Messages for the user.

/// Writes a line to standard error. A reader who has gone away is no reason to stop.
macro_rules! tell {
    ($($message:tt)*) => {{
        use std::io::Write as _;
        let _ = writeln!(std::io::stderr(), $($message)*);
    }};
}

pub(crate) use tell;
