//! Requests: a run that several workloads need is requested once.

use super::{Progress, ScheduledTask, Workload};
use crate::code::Code;
use std::collections::HashMap;
use std::sync::atomic::{AtomicU64, Ordering};

/// A task that at least one workload needs.
pub(super) struct RunRequest<'a, T> {
    pub(super) code: Code,
    pub(super) task: &'a T,
    /// Steps reported to [`Progress`].
    reported: AtomicU64,
}

impl<'a, T: ScheduledTask> RunRequest<'a, T> {
    fn new(code: Code, task: &'a T) -> Self {
        Self {
            code,
            task,
            reported: AtomicU64::new(0),
        }
    }

    /// Estimated duration of `steps` in seconds.
    pub(super) fn seconds(&self, steps: u64) -> f64 {
        steps as f64 * self.task.seconds_per_step(&self.code)
    }

    /// Reports to `progress` that `steps` are done in all.
    pub(super) fn advance(&self, steps: u64, progress: &dyn Progress) {
        let reported = self.reported.fetch_max(steps, Ordering::Relaxed);
        progress.advanced(self.seconds(steps.saturating_sub(reported)));
    }
}

/// Returns the distinct tasks of `workloads`, and for each workload the positions of its tasks among them.
pub(super) fn requests<T: ScheduledTask>(
    workloads: &[Workload<T>],
) -> (Vec<RunRequest<'_, T>>, Vec<Vec<usize>>) {
    let mut requests = Vec::new();
    let mut known: HashMap<(Code, String), usize> = HashMap::new();
    let wanted = workloads.iter().map(|workload| {
        let code = workload.code.clone();
        let tasks = workload.tasks.iter().map(|task| {
            let key = (code.clone(), task.content_hash());
            *known.entry(key).or_insert_with(|| {
                requests.push(RunRequest::new(code.clone(), task));
                requests.len() - 1
            })
        });
        tasks.collect()
    });
    let wanted = wanted.collect();
    (requests, wanted)
}

/// Hands out the results to each workload; only results that several tasks share are cloned.
pub(super) fn hand_out<R: Clone>(
    mut results: Vec<Option<R>>,
    wanted: Vec<Vec<usize>>,
) -> Vec<Vec<R>> {
    let mut uses = vec![0; results.len()];
    for &request in wanted.iter().flatten() {
        uses[request] += 1;
    }
    let mut result = |request: usize| {
        uses[request] -= 1;
        let result = match uses[request] {
            0 => results[request].take(),
            _ => results[request].clone(),
        };
        result.expect("the last use takes the result")
    };
    let mut of_workload = |wanted: Vec<usize>| wanted.into_iter().map(&mut result).collect();
    wanted.into_iter().map(&mut of_workload).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Case, ContactConvention, Preparation, Protocol, Sampling, Stack};

    #[test]
    fn what_two_workloads_want_both_get() {
        let results = ["a", "b", "c"].map(|name| Some(name.to_owned()));
        let handed = hand_out(results.to_vec(), vec![vec![0, 1], vec![], vec![1, 2, 1]]);
        assert_eq!(handed, [vec!["a", "b"], vec![], vec!["b", "c", "b"]]);
    }

    fn case(friction: f64, wall_speed: f64) -> Case {
        Case {
            stack: Stack::paper(friction, 1e2),
            convention: ContactConvention::TURNING,
            protocol: Protocol {
                preparation: Preparation::GravityRamp {
                    ramp_time: 100.0,
                    rest_time: 100.0,
                },
                time_step: 0.1,
                wall_speed,
                wall_travel: 0.01,
                sampling: Sampling {
                    coarse_interval: 1.0,
                    fine_from_travel: 0.01,
                    fine_interval: 1.0,
                },
                shortcuts: None,
            },
        }
    }

    #[test]
    fn a_run_that_several_workloads_want_is_made_once() {
        let cases = |friction: f64| [2e-4, 1e-4].map(|wall_speed| case(friction, wall_speed));
        let (some, others) = (cases(0.2), cases(0.3));
        let load = |code, cases: [&[Case]; 2]| Workload {
            code,
            tasks: cases.concat(),
        };
        let workloads = [
            load(Code::native(), [&some, &some[1..]]),
            load(Code::native(), [&others, &some]),
            load(Code::named("yade").unwrap(), [&some, &[]]),
        ];
        let (requests, wanted) = requests(&workloads);
        assert_eq!(requests.len(), some.len() + others.len() + some.len());
        for (workload, wanted) in workloads.iter().zip(&wanted) {
            assert_eq!(wanted.len(), workload.tasks.len());
            for (case, &request) in workload.tasks.iter().zip(wanted) {
                assert_eq!(requests[request].code, workload.code);
                assert_eq!(requests[request].task, case);
            }
        }
    }
}
