//! Writes results to the store while others are being computed.

use super::{Progress, ScheduledTask};
use crate::code::InstalledCode;
use crate::runs::Store;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};

/// Number of threads that write: the disk syncs many files in hardly more time than one.
const WRITERS: usize = 8;
/// Most results held in memory.
const CAPACITY: usize = 64;

/// The claim of this program to the runs of a job. It is released when the last of them is settled.
pub(super) struct Claim<'a> {
    pub(super) store: &'a Store,
    pub(super) progress: &'a dyn Progress,
    pub(super) addresses: Vec<String>,
}

impl Drop for Claim<'_> {
    fn drop(&mut self) {
        if self.addresses.is_empty() {
            return;
        }
        if let Err(error) = self.store.release(&self.addresses) {
            let message = format!("other programs may wait for this one to end: {error}");
            self.progress.warn(&message);
        }
    }
}

/// A result on its way into the store.
pub(super) struct Finished<'a, T: ScheduledTask> {
    pub(super) code: &'a dyn InstalledCode,
    pub(super) request: usize,
    pub(super) task: &'a T,
    pub(super) outcome: T::Outcome,
    pub(super) claim: Arc<Claim<'a>>,
}

/// The queue of results.
pub(super) type StoreWriter<'a, T> = SyncSender<Finished<'a, T>>;

/// Calls `work` with a store writer. Every result sent to it is written and then passed to `kept` before this returns.
pub(super) fn with_store_writer<'a, T: ScheduledTask>(
    kept: impl Fn(Finished<'a, T>) + Sync,
    work: impl FnOnce(&StoreWriter<'a, T>) + Send,
) {
    let (store_writer, inbox) = sync_channel(CAPACITY);
    // Only the writing threads own it: if they are gone, sending fails instead of blocking.
    let inbox = Arc::new(Mutex::new(inbox));
    let kept = &kept;
    std::thread::scope(|threads| {
        for _ in 0..WRITERS {
            let inbox = Arc::clone(&inbox);
            threads.spawn(move || {
                while let Some(finished) = next(&inbox) {
                    keep(&finished);
                    kept(finished);
                }
            });
        }
        drop(inbox);
        work(&store_writer);
        drop(store_writer);
    });
}

fn next<T>(inbox: &Mutex<Receiver<T>>) -> Option<T> {
    let inbox = inbox.lock().unwrap_or_else(PoisonError::into_inner);
    inbox.recv().ok()
}

pub(super) fn keep<T: ScheduledTask>(finished: &Finished<T>) {
    let Claim {
        store, progress, ..
    } = finished.claim.as_ref();
    if !store.is_kept(|message| progress.warn(message)) {
        return;
    }
    let kept = finished.task.keep(finished.code, &finished.outcome, store);
    if let Err(error) = kept {
        let name = T::KIND.name();
        progress.warn(&format!("a finished {name} could not be kept: {error}"));
    }
}
