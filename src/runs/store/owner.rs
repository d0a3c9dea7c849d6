//! The owner of a lock or a claim in a store.

use serde::{Deserialize, Serialize};

/// A running tristack.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LockOwner {
    /// Its process id.
    pub process: u32,
    /// The machine it runs on.
    pub host: String,
    /// Its command line.
    pub command: String,
    /// When it began, UTC.
    pub since: String,
}

impl LockOwner {
    pub(crate) fn this_program() -> Self {
        let host = std::fs::read_to_string("/proc/sys/kernel/hostname");
        let words = std::env::args_os().map(|word| word.to_string_lossy().into_owned());
        Self {
            process: std::process::id(),
            host: host.map_or_else(|_| "unknown".to_owned(), |host| host.trim().to_owned()),
            command: words.collect::<Vec<_>>().join(" "),
            since: jiff::Timestamp::now().to_string(),
        }
    }
}

impl std::fmt::Display for LockOwner {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            formatter,
            "process {} on {} (`{}`, since {})",
            self.process, self.host, self.command, self.since
        )
    }
}
