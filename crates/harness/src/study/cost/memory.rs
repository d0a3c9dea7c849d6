//! Largest resident memory of processes during some work, from `/proc`.

use crate::files::system_text;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

const SAMPLING_INTERVAL: Duration = Duration::from_millis(5);

/// The processes whose memory is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Processes {
    /// This process, sampled.
    Own,
    /// Its descendants together, each at its own peak so far.
    Children,
}

/// Runs `work`, and samples the memory of `processes` every few milliseconds meanwhile. The peak is in bytes; `None`
/// where there is no `/proc`, or no sample found a process.
pub(super) fn with_peak<T>(processes: Processes, work: impl FnOnce() -> T) -> (T, Option<u64>) {
    let done = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let watch = scope.spawn(|| {
            let mut peak = sample(processes);
            while !done.load(Ordering::Relaxed) {
                std::thread::sleep(SAMPLING_INTERVAL);
                peak = peak.max(sample(processes));
            }
            peak
        });
        let result = work();
        done.store(true, Ordering::Relaxed);
        (result, watch.join().unwrap_or(None))
    })
}

fn sample(processes: Processes) -> Option<u64> {
    let own = Path::new("/proc/self");
    match processes {
        Processes::Own => status_bytes(own, "VmRSS:"),
        Processes::Children => descendants(own)
            .iter()
            .filter_map(|process| status_bytes(process, "VmHWM:"))
            .reduce(|sum, bytes| sum + bytes),
    }
}

/// Returns a size in the `status` of the process at `directory`, in bytes.
fn status_bytes(directory: &Path, key: &str) -> Option<u64> {
    let status = system_text(directory.join("status"))?;
    let line = status.lines().find_map(|line| line.strip_prefix(key))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024 * kibibytes)
}

/// Returns the descendants of the process at `directory`.
fn descendants(directory: &Path) -> Vec<PathBuf> {
    let threads = fs::read_dir(directory.join("task")).into_iter().flatten();
    let lists = threads.flatten();
    let lists = lists.filter_map(|thread| system_text(thread.path().join("children")));
    let mut found = Vec::new();
    for list in lists {
        for process in list.split_whitespace() {
            let child = Path::new("/proc").join(process);
            found.extend(descendants(&child));
            found.push(child);
        }
    }
    found
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn own_memory_that_is_held_for_a_while_is_seen() {
        const BYTES: usize = 64 << 20;
        let ((), peak) = with_peak(Processes::Own, || {
            let held = vec![1_u8; BYTES];
            // Even on a busy machine one of so many samples is taken in time.
            std::thread::sleep(200 * SAMPLING_INTERVAL);
            drop(std::hint::black_box(held));
        });
        assert!(peak.is_some_and(|peak| peak > BYTES as u64));
    }
}
