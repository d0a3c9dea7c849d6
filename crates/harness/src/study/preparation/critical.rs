//! A*, the push up to which the bottom cylinders end without contact.

use super::plan::plan_preparation;
use crate::code::SettledCode;
use crate::model::Stack;
use crate::runs::{RunError, RunSummary, Workload};
use crate::study::Campaign;
use crate::study::yield_force::MIDDLE_RUN;
use serde::Serialize;

/// Spacing and end of the grid of pushes that is tried first, in units of ε.
const GRID: f64 = 0.25;
const LARGEST: f64 = 2.0;
/// Halvings of the interval in which c appears; it is then 3 × 10⁻⁵ ε wide.
const HALVINGS: usize = 13;

/// The push at which c appears in native runs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CriticalPush {
    /// A* in r, the largest push that was found to end with c = 0; c appears within `width` above it.
    pub push: f64,
    /// Width of the interval in which it appears, in r.
    pub width: f64,
}

/// Finds A* of each of `stacks`, the smallest push beyond which c appears, by bisection. Every step is a native run
/// under the paper's convention. The result is `None` where c > 0 already at A = 0, or c = 0 up to A = 2 ε.
pub fn critical_pushes(
    campaign: &Campaign,
    stacks: &[Stack],
) -> Result<Vec<Option<CriticalPush>>, RunError> {
    let mut intervals = first_contacts(campaign, stacks)?;
    for _ in 0..HALVINGS {
        let open = stacks.iter().zip(&intervals);
        let middles: Vec<(Stack, f64)> = open
            .filter_map(|(stack, interval)| {
                interval.map(|(low, high)| (*stack, 0.5 * (low + high)))
            })
            .collect();
        let answers = touching(campaign, &middles)?;
        let answered = middles.iter().zip(answers);
        for ((low, high), ((_, middle), touches)) in intervals.iter_mut().flatten().zip(answered) {
            *(if touches { high } else { low }) = *middle;
        }
    }
    let result = |(low, high): (f64, f64)| CriticalPush {
        push: low,
        width: high - low,
    };
    Ok(intervals
        .into_iter()
        .map(|interval| interval.map(result))
        .collect())
}

/// Returns the last push of the grid without contact and the first with it, for each stack.
fn first_contacts(
    campaign: &Campaign,
    stacks: &[Stack],
) -> Result<Vec<Option<(f64, f64)>>, RunError> {
    let count = (LARGEST / GRID) as usize + 1;
    let on_grid = |index: usize, stack: &Stack| GRID * index as f64 * stack.epsilon();
    let grid = stacks
        .iter()
        .flat_map(|stack| (0..count).map(move |index| (*stack, on_grid(index, stack))));
    let grid: Vec<(Stack, f64)> = grid.collect();
    let touching = touching(campaign, &grid)?;
    Ok(stacks
        .iter()
        .zip(touching.chunks(count))
        .map(|(stack, touching)| {
            let first = touching.iter().position(|&touches| touches)?;
            Some((on_grid(first.checked_sub(1)?, stack), on_grid(first, stack)))
        })
        .collect())
}

/// Whether the bottom cylinders of each stack touch at the beginning of the compression, after the given push.
fn touching(campaign: &Campaign, pushed: &[(Stack, f64)]) -> Result<Vec<bool>, RunError> {
    let native = SettledCode::native();
    let workloads = pushed.iter().map(|(stack, push)| {
        let plan = plan_preparation(&native, &native, stack, Some(*push));
        Workload {
            code: native.name().clone(),
            tasks: plan.cases().get(MIDDLE_RUN).copied().into_iter().collect(),
        }
    });
    let workloads: Vec<Workload> = workloads.collect();
    let touches = |summary: RunSummary| summary.contact_force.is_some_and(|force| force > 0.0);
    let results = campaign.read_native(&workloads);
    results
        .into_iter()
        .map(|results| {
            let first = results.into_iter().next();
            first.map_or(Ok(false), |summary| summary.map(touches))
        })
        .collect()
}
