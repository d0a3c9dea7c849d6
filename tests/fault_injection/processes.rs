//! The processes of a round, found by the place that their environment names.

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

/// A running process.
#[derive(Debug, Clone)]
pub struct Process {
    pub number: i32,
    pub command: String,
}

impl Process {
    pub fn is_guard(&self) -> bool {
        self.command.starts_with("/proc/self/exe guard ")
    }

    /// Whether it is neither tristack nor a guard.
    pub fn is_foreign(&self) -> bool {
        let is_tristack = self.command.contains("/tristack ");
        !is_tristack && !self.command.starts_with("/proc/self/exe ")
    }

    pub fn signal(&self, signal: Signal) {
        // It may have ended.
        let _ = kill(Pid::from_raw(self.number), signal);
    }
}

/// All running processes with `place` in their environment.
pub fn of(place: &Path) -> Vec<Process> {
    let place = place.as_os_str().as_encoded_bytes();
    let processes = fs::read_dir("/proc")
        .expect("a list of processes")
        .flatten();
    let found = processes.filter_map(|entry| {
        let number = entry.file_name().to_str()?.parse().ok()?;
        let environment = fs::read(entry.path().join("environ")).ok()?;
        let mentioned = environment.windows(place.len()).any(|part| part == place);
        let command = fs::read(entry.path().join("cmdline")).ok()?;
        let command = String::from_utf8_lossy(&command).replace('\0', " ");
        (mentioned && !command.is_empty()).then_some(Process { number, command })
    });
    found.collect()
}

/// Waits until nothing of `place` runs any more; says what does if it takes too long.
pub fn all_ended(place: &Path) -> Result<(), String> {
    let start = Instant::now();
    loop {
        let left = of(place);
        if left.is_empty() {
            return Ok(());
        }
        if start.elapsed() > Duration::from_secs(5) {
            left.iter()
                .for_each(|process| process.signal(Signal::SIGKILL));
            return Err(format!("left running: {left:?}"));
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}
