//! What the schedule would do, without doing it.

use super::executor::Executor;
use super::{Reading, ScheduledTask, SelectedCode, Settings, Workload, requests::requests};
use crate::code::Code;
use crate::runs::Progress;
use std::fmt::Display;

/// The tasks of one code that workloads need.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CodeOutlook {
    /// The code.
    pub code: Code,
    /// Number of different tasks.
    pub tasks: usize,
    /// Number of those with a result in the store; for a code that is not installed, with a recorded one.
    pub there: usize,
    /// Number of those that are to be carried out.
    pub open: usize,
    /// Steps of those that are to be carried out.
    pub steps: u64,
}

/// Tasks that one call of a code would carry out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct PlannedCall {
    /// The code.
    pub(crate) code: Code,
    /// The steps of each task.
    pub(crate) steps: Vec<u64>,
}

/// What the schedule would do.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Outlook {
    /// The outlook of each code, in order.
    pub codes: Vec<CodeOutlook>,
    /// The calls, in the order in which they would begin.
    pub(crate) calls: Vec<PlannedCall>,
}

/// Returns what carrying out `workloads` would do. A result in the store counts as usable without being read.
pub(crate) fn outlook<R: Reading>(
    workloads: &[Workload<R::Task>],
    codes: &[SelectedCode],
    settings: &Settings,
) -> Outlook {
    let (requests, _) = requests(workloads);
    let executor = Executor::<R>::new(requests, settings, &Silent);
    let mut open = Vec::new();
    let mut rows = Vec::new();
    for selected in codes {
        let own = executor.requests_of(&selected.name);
        let tasks = own.len();
        let left: Vec<usize> = match selected.code.as_deref() {
            Some(code) => {
                let is_open = |&request: &usize| {
                    let address = executor.task(request).address(code);
                    settings.fresh || !settings.store.holds(R::Task::KIND, &address)
                };
                own.iter().copied().filter(is_open).collect()
            }
            None => Vec::new(),
        };
        let is_recorded = |&request: &usize| {
            let task = executor.task(request);
            R::recorded(task, &selected.name, &settings.recorded).is_ok()
        };
        let there = match selected.code {
            Some(_) => tasks - left.len(),
            None => own.iter().filter(|&request| is_recorded(request)).count(),
        };
        let steps = left.iter().map(|&request| executor.task(request).steps());
        rows.push(CodeOutlook {
            code: selected.name.clone(),
            tasks,
            there,
            open: left.len(),
            steps: steps.sum(),
        });
        open.extend(left);
    }
    let calls = executor.pack(&open, codes).into_iter().map(|job| {
        let steps = job
            .requests
            .iter()
            .map(|&request| executor.task(request).steps());
        PlannedCall {
            code: job.code.name().clone(),
            steps: steps.collect(),
        }
    });
    Outlook {
        codes: rows,
        calls: calls.collect(),
    }
}

/// Reports nothing, because nothing happens.
struct Silent;

impl Progress for Silent {
    fn planned(&self, _: &str, _: usize, _: usize, _: f64) {}
    fn advanced(&self, _: f64) {}
    fn finished(&self, _: &Code, _: &dyn Display, _: Result<Option<f64>, &crate::code::Failure>) {}
    fn warn(&self, _: &str) {}
}

impl Outlook {
    /// Returns the seconds until the last call ends, if `at_once` calls run at the same time and another begins
    /// whenever one ends. `seconds` gives the duration of a call.
    pub(crate) fn seconds(&self, at_once: usize, seconds: impl Fn(&PlannedCall) -> f64) -> f64 {
        let mut free = vec![0.0_f64; at_once.max(1)];
        for call in &self.calls {
            let first = free.iter_mut().min_by(|one, other| one.total_cmp(other));
            if let Some(first) = first {
                *first += seconds(call);
            }
        }
        free.into_iter().fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_call_begins_when_another_one_has_ended() {
        let call = |steps: u64| PlannedCall {
            code: Code::native(),
            steps: vec![steps],
        };
        let outlook = Outlook {
            codes: Vec::new(),
            calls: [5, 4, 3, 3, 3].map(call).to_vec(),
        };
        let seconds = |call: &PlannedCall| call.steps.iter().sum::<u64>() as f64;
        assert_eq!(outlook.seconds(1, seconds), 18.0);
        // 5 + 3, 4 + 3 + 3.
        assert_eq!(outlook.seconds(2, seconds), 10.0);
        assert_eq!(outlook.seconds(9, seconds), 5.0);
    }
}
