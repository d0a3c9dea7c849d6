//! Waiting for runs that other programs are making at the same store.

use super::executor::Executor;
use super::{Reading, ScheduledTask, SelectedCode};
use crate::runs::LockOwner;
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

/// First interval between two looks at the runs of other programs; it doubles as long as none of them ends.
const FIRST_INTERVAL: Duration = Duration::from_millis(200);
/// Longest interval: a hundred waiting programs must not keep others from the lock of the store.
const LONGEST_INTERVAL: Duration = Duration::from_secs(5);

impl<'a, R: Reading> Executor<'a, R> {
    /// Takes over the results that other programs finish, and makes those that they abandon.
    pub(super) fn wait_for_others(&self, codes: &'a [SelectedCode]) {
        let mut announced = BTreeMap::new();
        let mut interval = FIRST_INTERVAL;
        let mut last = usize::MAX;
        loop {
            let waiting = std::mem::take(&mut *self.elsewhere());
            if waiting.is_empty() {
                return;
            }
            interval = match waiting.len() < last {
                true => FIRST_INTERVAL,
                false => LONGEST_INTERVAL.min(2 * interval),
            };
            last = waiting.len();
            self.announce(&waiting, &mut announced);
            self.pause(interval);
            let requests = match self.settings.interrupt.requested() {
                true => waiting.into_iter().map(|(request, _)| request).collect(),
                false => self.released(waiting, codes),
            };
            self.work_off(&self.pack(&requests, codes));
        }
    }

    /// Returns the requests in `waiting` that no other program is making any more; asks for all of them at once.
    /// Fills the slots of finished ones.
    fn released(&self, waiting: Vec<(usize, LockOwner)>, codes: &'a [SelectedCode]) -> Vec<usize> {
        let known = waiting.into_iter().filter_map(|(request, _)| {
            let code = self.code_of(request, codes)?;
            Some((request, code, self.task(request).address(code)))
        });
        let known: Vec<_> = known.collect();
        let addresses: Vec<String> = known.iter().map(|(.., address)| address.clone()).collect();
        let Ok(owners) = self.settings.store.claim(&addresses) else {
            // The error occurs again, and is reported, when the jobs are claimed.
            return known.into_iter().map(|(request, ..)| request).collect();
        };
        let mut released = Vec::new();
        for ((request, code, _), owner) in known.into_iter().zip(owners) {
            match owner {
                None => released.push(request),
                // Finished by a program that is still working on other runs of its claim.
                Some(_) if self.is_made(code, request, |_| ()) => {}
                Some(owner) => self.elsewhere().push((request, owner)),
            }
        }
        released
    }

    /// Waits for the `interval`, or until an interrupt.
    fn pause(&self, interval: Duration) {
        let start = Instant::now();
        while start.elapsed() < interval && !self.settings.interrupt.requested() {
            std::thread::sleep(FIRST_INTERVAL);
        }
    }

    /// Warns once, for each other program, how many of its results are waited for.
    fn announce(&self, waiting: &[(usize, LockOwner)], announced: &mut BTreeMap<String, usize>) {
        let mut counts = BTreeMap::new();
        for (_, owner) in waiting {
            *counts.entry(owner.to_string()).or_insert(0) += 1;
        }
        let name = R::Task::KIND.name();
        for (owner, count) in counts {
            if announced.insert(owner.clone(), count).is_none() {
                self.progress.warn(&format!(
                    "waiting for {count} {name}s that {owner} is making"
                ));
            }
        }
    }
}
