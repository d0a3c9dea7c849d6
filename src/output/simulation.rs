//! The result of one compression run.

use super::number::digits;
use super::table::{Columns, DataTable};
use crate::code::Run;
use crate::model::{ContactConvention, Preparation, Protocol};
use crate::series::YieldEstimates;

/// A run, and its yield force by both estimators.
type Row<'a> = (&'a Run, YieldEstimates);

/// One row per run.
pub(crate) fn simulations(runs: &[Run]) -> DataTable<'_> {
    let rows = runs.iter().map(|run| {
        let estimates = YieldEstimates::read(&run.series, &run.case);
        (run, estimates)
    });
    protocol(convention(subject()))
        .number("peak_force", "m g", |(_, found)| Some(found.peak?.force))
        .means("largest wall force; absent if the force still rises at the end")
        .shown_as("peak", digits::<9>)
        .number("slip_force", "m g", |(_, found)| Some(found.slip?.force))
        .means("wall force when the floor first slips; absent if it does not")
        .shown_as("slip onset", digits::<9>)
        .number("steps", "1", |(run, _)| run.provenance.steps)
        .means("steps in all")
        .shown("steps")
        .number("seconds", "s", |(run, _)| run.provenance.seconds)
        .means("wall time")
        .shown_as("wall time", |seconds| format!("{seconds:.2}"))
        .rows(rows)
}

/// The code, the stack and the arms.
fn subject<'a>() -> Columns<'a, Row<'a>> {
    let table = "A row is one compression run and what was read off it. The case file beside it (case.json) holds \
                 what is left out here.";
    Columns::<Row>::new("simulation", table, "`tristack simulate` (summary.json)")
        .text("code", |(run, _)| run.provenance.identity.code.clone())
        .means("the code that ran")
        .shown("code")
        .version(|(run, _)| &run.provenance.identity.version)
        .shown("version")
        .stack(|(run, _)| run.case.stack)
        .convention(|(run, _)| run.case.convention)
}

/// The contact convention beyond the arms.
fn convention<'a>(columns: Columns<'a, Row<'a>>) -> Columns<'a, Row<'a>> {
    let own = |(run, _): &Row| -> ContactConvention { run.case.convention };
    columns
        .number("restitution", "1", move |row| own(row).restitution)
        .means("restitution coefficient")
        .word("coulomb_operand", move |row| own(row).coulomb_operand)
        .means("force that Coulomb's limit is compared with")
        .word("sliding_spring", move |row| own(row).sliding_spring)
        .means("treatment of the tangential spring of a sliding contact")
        .word("history_update", move |row| own(row).history_update)
        .means("treatment of the tangential spring of a turning contact")
        .word("tensile_force", move |row| own(row).tensile_force)
        .means("normal force of a contact that separates")
        .number("moment_of_inertia", "m r²", move |row| {
            own(row).moment_of_inertia
        })
        .means("moment of inertia of a cylinder")
        .law(move |row| own(row).law)
}

/// Preparation, compression and sampling.
fn protocol<'a>(columns: Columns<'a, Row<'a>>) -> Columns<'a, Row<'a>> {
    let time = "√(m/k_n)";
    let own = |(run, _): &Row| -> Protocol { run.case.protocol };
    let sampling = move |row: &Row| own(row).sampling;
    columns
        .text("preparation", move |row| own(row).preparation.as_str())
        .means("how the stack is brought to rest: `gravity-ramp` or `side-walls`")
        .number("ramp_time", time, move |row| match own(row).preparation {
            Preparation::GravityRamp { ramp_time, .. } => Some(ramp_time),
            Preparation::SideWalls(_) => None,
        })
        .means("duration of the gravity ramp")
        .number("rest_time", time, move |row| match own(row).preparation {
            Preparation::GravityRamp { rest_time, .. } => rest_time,
            Preparation::SideWalls(walls) => walls.rest_time,
        })
        .means("duration of the rest before the compression")
        .number("push", "r", move |row| match own(row).preparation {
            Preparation::GravityRamp { .. } => None,
            Preparation::SideWalls(walls) => Some(walls.push),
        })
        .means("A, how far each side wall is pushed in")
        .number("wall_speed", "r √(k_n/m)", move |row| own(row).wall_speed)
        .means("speed of the top wall")
        .shown_as("wall speed", |speed| format!("{speed:.3e}"))
        .number("time_step", time, move |row| own(row).time_step)
        .means("time step")
        .shown("time step")
        .number("wall_travel", "r", move |row| own(row).wall_travel)
        .means("how far the wall moves")
        .number("coarse_interval", time, move |row| {
            sampling(row).coarse_interval
        })
        .means("time between rows of the series far from the yield")
        .number("fine_from_travel", "r", move |row| {
            sampling(row).fine_from_travel
        })
        .means("wall travel from which rows are taken finely")
        .number("fine_interval", time, move |row| {
            sampling(row).fine_interval
        })
        .means("time between rows near the yield")
        .text("shortcuts", move |row| own(row).shortcuts.is_some())
        .means("whether the run takes shortcuts")
}
