//! Carries out the same task for many items on several threads.

use rayon::prelude::*;

/// Returns the results of `task` for all `items`, in their order, on at most `threads` threads.
pub fn in_parallel<I: Sync, T: Send>(
    items: &[I],
    threads: usize,
    task: impl Fn(&I) -> T + Sync,
) -> Vec<T> {
    let threads = threads.min(items.len());
    if threads < 2 {
        return items.iter().map(task).collect();
    }
    match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
        // Tasks differ in length, so each is handed out by itself.
        Ok(pool) => pool.install(|| items.par_iter().with_max_len(1).map(&task).collect()),
        // The system refuses more threads.
        Err(_) => items.iter().map(task).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;
    use std::sync::{Barrier, Mutex};
    use std::thread;

    #[test]
    fn results_come_in_the_order_of_the_items() {
        let items: Vec<usize> = (0..100).collect();
        let squares = in_parallel(&items, 4, |item| item * item);
        let expected: Vec<usize> = items.iter().map(|item| item * item).collect();
        assert_eq!(squares, expected);
        assert!(in_parallel(&[], 4, |item: &usize| *item).is_empty());
    }

    #[test]
    fn as_many_threads_work_as_are_asked_for() {
        let seen = Mutex::new(BTreeSet::new());
        // Each of the first three tasks ends when all three have begun.
        let begun = Barrier::new(3);
        in_parallel(&[true, true, true], 3, |_| {
            begun.wait();
            seen.lock()
                .unwrap()
                .insert(format!("{:?}", thread::current().id()));
        });
        assert_eq!(seen.lock().unwrap().len(), 3);
        let own = in_parallel(&[0, 1, 2], 1, |_| thread::current().id());
        assert_eq!(own, [thread::current().id(); 3]);
    }
}
