//! Who wants which run: however many workloads want the same, it is one order.

use super::{Progress, Workload};
use crate::engine::EngineName;
use crate::stack::Case;
use std::collections::HashMap;
use std::sync::atomic::{AtomicU64, Ordering};

/// One run: however many workloads want it, it is made once.
pub(super) struct Order<'a> {
    pub(super) engine: EngineName,
    pub(super) case: &'a Case,
    /// Steps of which [`Progress`] has been told.
    told: AtomicU64,
}

impl<'a> Order<'a> {
    fn new(engine: EngineName, case: &'a Case) -> Self {
        Self {
            engine,
            case,
            told: AtomicU64::new(0),
        }
    }

    /// What so many steps take, about.
    pub(super) fn seconds(&self, steps: u64) -> f64 {
        steps as f64 * self.engine.seconds_per_step()
    }

    /// Tells `progress` that so many steps are done in all.
    pub(super) fn advance(&self, steps: u64, progress: &dyn Progress) {
        let told = self.told.fetch_max(steps, Ordering::Relaxed);
        progress.advanced(self.seconds(steps.saturating_sub(told)));
    }
}

/// Every run that `workloads` want, once, and which of them every case of every workload is.
pub(super) fn orders<W: Workload>(workloads: &[W]) -> (Vec<Order<'_>>, Vec<Vec<usize>>) {
    let mut orders = Vec::new();
    let mut known: HashMap<(EngineName, String), usize> = HashMap::new();
    let wanted = workloads.iter().map(|workload| {
        let engine = workload.engine();
        let cases = workload.cases().iter().map(|case| {
            let key = (engine, case.content_hash());
            *known.entry(key).or_insert_with(|| {
                orders.push(Order::new(engine, case));
                orders.len() - 1
            })
        });
        cases.collect()
    });
    let wanted = wanted.collect();
    (orders, wanted)
}

/// The results of the orders that every workload wanted; copies only where several wanted the same.
pub(super) fn hand_out<R: Clone>(
    mut results: Vec<Option<R>>,
    wanted: Vec<Vec<usize>>,
) -> Vec<Vec<R>> {
    let mut uses = vec![0; results.len()];
    for &order in wanted.iter().flatten() {
        uses[order] += 1;
    }
    let mut result = |order: usize| {
        uses[order] -= 1;
        let result = match uses[order] {
            0 => results[order].take(),
            _ => results[order].clone(),
        };
        result.expect("nobody takes a result that somebody else still wants")
    };
    let mut of_workload = |wanted: Vec<usize>| wanted.into_iter().map(&mut result).collect();
    wanted.into_iter().map(&mut of_workload).collect()
}

#[cfg(test)]
mod tests {
    use super::super::super::{Load, plan};
    use super::*;
    use crate::stack::{Convention, Stack};

    #[test]
    fn what_two_workloads_want_both_get() {
        let results = ["a", "b", "c"].map(|name| Some(name.to_owned()));
        let handed = hand_out(results.to_vec(), vec![vec![0, 1], vec![], vec![1, 2, 1]]);
        assert_eq!(handed, [vec!["a", "b"], vec![], vec!["b", "c", "b"]]);
    }

    #[test]
    fn a_run_that_several_workloads_want_is_made_once() {
        let cases = |friction| {
            let stack = Stack::paper(friction, 1e2);
            plan(EngineName::Native, &stack, Convention::PAPER).cases
        };
        let (some, others) = (cases(0.2), cases(0.3));
        let load = |engine, cases: [&[Case]; 2]| Load {
            engine,
            cases: cases.concat(),
        };
        let workloads = [
            load(EngineName::Native, [&some, &some[1..]]),
            load(EngineName::Native, [&others, &some]),
            load(EngineName::Yade, [&some, &[]]),
        ];
        let (orders, wanted) = orders(&workloads);
        assert_eq!(orders.len(), some.len() + others.len() + some.len());
        for (workload, wanted) in workloads.iter().zip(&wanted) {
            assert_eq!(wanted.len(), workload.cases.len());
            for (case, &order) in workload.cases.iter().zip(wanted) {
                assert_eq!(orders[order].engine, workload.engine);
                assert_eq!(orders[order].case, case);
            }
        }
    }
}
