//! Writes finished runs to the store while others are being computed.

use super::Progress;
use crate::code::{Code, Run};
use crate::runs::Store;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};

/// Threads that write: the disk syncs many files in hardly more time than one.
const WRITERS: usize = 8;
/// Most finished runs held in memory.
const CAPACITY: usize = 64;

/// The claim of this program to the runs of a job, released when the last of them is settled.
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
        if let Err(error) = self.store.session.release(&self.addresses) {
            let message = format!("other programs may wait for this one to end: {error}");
            self.progress.warn(&message);
        }
    }
}

/// A finished run on its way into the store.
pub(super) struct FinishedRun<'a> {
    pub(super) code: Code,
    pub(super) request: usize,
    pub(super) run: Run,
    pub(super) claim: Arc<Claim<'a>>,
}

/// The queue of finished runs.
pub(super) type StoreWriter<'a> = SyncSender<FinishedRun<'a>>;

/// Calls `work` with a store writer. Every run sent to it is written and then passed to `kept` before this returns.
pub(super) fn with_store_writer<'a>(
    kept: impl Fn(FinishedRun<'a>) + Sync,
    work: impl FnOnce(&StoreWriter<'a>) + Send,
) {
    let (store_writer, inbox) = sync_channel(CAPACITY);
    // Owned by the writing threads alone: if they are gone, sending fails instead of blocking.
    let inbox = Arc::new(Mutex::new(inbox));
    let kept = &kept;
    std::thread::scope(|threads| {
        for _ in 0..WRITERS {
            let inbox = Arc::clone(&inbox);
            threads.spawn(move || {
                while let Some(finished_run) = next(&inbox) {
                    keep(&finished_run);
                    kept(finished_run);
                }
            });
        }
        drop(inbox);
        work(&store_writer);
        drop(store_writer);
    });
}

fn next<'a>(inbox: &Mutex<Receiver<FinishedRun<'a>>>) -> Option<FinishedRun<'a>> {
    let inbox = inbox.lock().unwrap_or_else(PoisonError::into_inner);
    inbox.recv().ok()
}

pub(super) fn keep(finished_run: &FinishedRun) {
    let Claim {
        store, progress, ..
    } = finished_run.claim.as_ref();
    if let Err(error) = store.put(&finished_run.run) {
        progress.warn(&format!("a finished run could not be kept: {error}"));
    }
}
