//! Table of planned runs.

use super::table::{Columns, DataTable};
use crate::code::{FailureKind, PlannedRun, PlannedTask};

/// Returns the table of the runs of a plan. `troubles` says for each run what is wrong with its result.
pub fn planned_runs<'a>(
    runs: &'a [PlannedRun],
    troubles: &'a [Option<FailureKind>],
) -> DataTable<'a> {
    Columns::<(&PlannedRun, &Option<FailureKind>)>::new(
        "plan",
        "A row is a run of a plan that is to be made elsewhere.",
        "`tristack plan`",
    )
    .text("directory", |(run, _)| run.directory.as_str())
    .means("its directory, relative to that of the plan")
    .text("task", |(run, _)| match run.task {
        PlannedTask::Stack(_) => "stack",
        PlannedTask::Motion(_) => "motion",
    })
    .means("`stack` for a compression, `motion` for a micro-test")
    .number("steps", "1", |(run, _)| run.steps)
    .means("time steps, preparation included")
    .number("seconds", "s", |(run, _)| run.seconds)
    .means("forecast of its duration by the manifest of the code")
    .text("deck_hash", |(run, _)| run.deck_hash.as_str())
    .means("SHA-256 of decks, parameters, command and environment")
    .text("result", |(_, trouble)| match trouble {
        None => "usable",
        Some(FailureKind::Awaited(_)) => "missing",
        Some(FailureKind::NoResult(_)) => "incomplete",
        Some(_) => "malformed",
    })
    .means(
        "`usable`, `missing`, `incomplete` (a part of a result, or one of other decks) or `malformed`",
    )
    .rows(runs.iter().zip(troubles))
}
