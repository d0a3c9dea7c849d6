//! The result of one compression run.

use super::number::{digits, relative, significant};
use super::table::{Columns, DataTable};
use crate::code::Run;
use crate::model::{Case, ContactConvention, Preparation, Protocol};
use crate::series::YieldEstimates;
use crate::theory::{Limit, quasistatic_limit};

/// A run, its yield force by both estimators, and the exact limit of both.
type Row<'a> = (&'a Run, YieldEstimates, Option<Limit>);

/// Wall travel, in units of the travel to the exact yield, below which a run may stop before it yields. Planned walls
/// move 1.05 times as far as to the exact yield.
const LEAST_TRAVEL: f64 = 1.04;
/// Wall travel, in the same units, that goes beyond the yield, whatever the speed of the wall adds.
const TRAVEL_BEYOND: f64 = 1.1;

/// Returns the table of runs, one row per run.
pub fn simulations(runs: &[Run]) -> DataTable<'_> {
    let rows = runs.iter().map(|run| {
        let estimates = YieldEstimates::read(&run.series, &run.case);
        let is_ramp = matches!(
            run.case.protocol.preparation,
            Preparation::GravityRamp { .. }
        );
        (
            run,
            estimates,
            is_ramp.then(|| exact_limit(&run.case)).flatten(),
        )
    });
    protocol(convention(subject()))
        .number("peak_force", "m g", |(_, found, _)| Some(found.peak?.force))
        .means("largest wall force; absent if the force still rises at the end")
        .shown_as("peak", digits::<9>)
        .number("slip_force", "m g", |(_, found, _)| Some(found.slip?.force))
        .means("wall force when the floor first slips; absent if it does not")
        .shown_as("slip onset", digits::<9>)
        .number("reference_force", "m g", |(.., limit)| limit.as_ref()?.yield_force)
        .means("exact limit of the peak at vanishing wall speed, under the convention of this run; absent between side walls, \
                whose push moves it")
        .shown_as("exact limit of the peak", digits::<9>)
        .number("reference_onset", "m g", |(.., limit)| limit.as_ref()?.slip_onset)
        .means("exact limit of the slip onset; below reference_force where contact 2–3 is closed then")
        .shown_as("exact limit of the onset", digits::<9>)
        .number("error", "1", error)
        .means("(slip_onset − reference_onset)/(reference_onset + n + 1): that of one run at a finite wall speed")
        .shown_as("error of the onset", relative)
        .number("steps", "1", |(run, ..)| run.provenance.steps)
        .means("steps in all")
        .shown("steps")
        .number("seconds", "s", |(run, ..)| run.provenance.seconds)
        .means("wall time")
        .shown_as("wall time", |seconds| format!("{seconds:.2}"))
        .rows(rows)
}

/// Returns the exact limit after a gravity ramp; `None` if a value of the stack or its convention is out of range.
fn exact_limit(case: &Case) -> Option<Limit> {
    Some(quasistatic_limit(&case.problem().ok()?))
}

fn error((run, found, limit): &Row) -> Option<f64> {
    let (onset, reference) = (found.slip?.force, limit.as_ref()?.slip_onset?);
    Some((onset - reference) / run.case.stack.floor_load(reference))
}

/// Says why a run shows no yield, and what to change. Returns `None` if the run shows one, or if theory gives no wall
/// travel to the yield.
pub fn unfinished(run: &Run) -> Option<String> {
    let found = YieldEstimates::read(&run.series, &run.case);
    let what = match (found.slip, found.peak) {
        (Some(_), Some(_)) => return None,
        (Some(_), None) => "the floor slips, but the force still rises at the end of the run",
        (None, _) => "the run ends before the floor slips, so that there is no yield force",
    };
    let (case, limit) = (&run.case, exact_limit(&run.case)?);
    let moved = case.protocol.wall_travel;
    let travels = limit.wall_travel.into_iter().chain(limit.peak_travel);
    let needed = travels.reduce(f64::max)?;
    let moved_so_far = format!("{what}: the wall moves {} r", significant(moved, 4));
    let comes = format!("the exact limit yields at {} r", significant(needed, 4));
    Some(match moved < LEAST_TRAVEL * needed {
        true => format!(
            "{moved_so_far}, and {comes}; let `protocol.wall_travel` be {} or more in the case file",
            significant(TRAVEL_BEYOND * needed, 4)
        ),
        false => format!(
            "{moved_so_far}, although {comes}; look at the series (--out), and try a slower wall (`protocol.wall_speed`, \
             --speed) or a smaller time step (`protocol.time_step`, --dt)"
        ),
    })
}

/// Starts the table with the columns of code, stack and arms.
fn subject<'a>() -> Columns<'a, Row<'a>> {
    let table = "A row is one compression run and what was read off it. The case file beside it (case.json) holds \
                 what is left out here.";
    Columns::<Row>::new("simulation", table, "`tristack simulate` (summary.json)")
        .text("code", |(run, ..)| run.provenance.identity.code.clone())
        .means("the code that ran")
        .shown("code")
        .version(|(run, ..)| &run.provenance.identity.version)
        .shown("version")
        .stack(|(run, ..)| run.case.stack)
        .convention(|(run, ..)| Some(run.case.convention.into()))
}

/// Adds the columns of the contact convention beyond the arms.
fn convention<'a>(columns: Columns<'a, Row<'a>>) -> Columns<'a, Row<'a>> {
    let own = |(run, ..): &Row| -> ContactConvention { run.case.convention };
    columns
        .number("restitution", "1", move |row| own(row).restitution)
        .means("restitution coefficient")
        .word("coulomb_operand", move |row| own(row).coulomb_operand)
        .means("force that Coulomb's limit is compared with")
        .word("sliding_spring", move |row| own(row).sliding_spring)
        .means("treatment of the tangential spring of a sliding contact")
        .word("tensile_force", move |row| own(row).tensile_force)
        .means("normal force of a contact that separates")
        .number("moment_of_inertia", "m r²", move |row| {
            own(row).moment_of_inertia
        })
        .means("moment of inertia of a cylinder")
        .law(move |row| Some(own(row).law))
}

/// Adds the columns of preparation, compression and sampling.
fn protocol<'a>(columns: Columns<'a, Row<'a>>) -> Columns<'a, Row<'a>> {
    let time = "√(m/k_n)";
    let own = |(run, ..): &Row| -> Protocol { run.case.protocol };
    let sampling = move |row: &Row| own(row).sampling;
    columns
        .text("preparation", move |row| own(row).preparation.as_str())
        .means("how the stack is brought to rest: `gravity-ramp`, `side-walls` or `rigid`")
        .number("ramp_time", time, move |row| match own(row).preparation {
            Preparation::GravityRamp { ramp_time, .. } => Some(ramp_time),
            Preparation::SideWalls(_) | Preparation::Rigid => None,
        })
        .means("duration of the gravity ramp")
        .number("rest_time", time, move |row| match own(row).preparation {
            Preparation::GravityRamp { rest_time, .. } => rest_time,
            Preparation::SideWalls(walls) => walls.rest_time,
            Preparation::Rigid => 0.0,
        })
        .means("duration of the rest before the compression")
        .number("push", "r", move |row| match own(row).preparation {
            Preparation::GravityRamp { .. } | Preparation::Rigid => None,
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
