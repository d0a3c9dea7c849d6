//! The result of one compression run.

use super::number::significant;
use super::table::{Columns, DataTable, Value};
use crate::code::Run;
use crate::model::{Case, Preparation};
use crate::series::{Estimate, YieldEstimates};

/// One run, and what was read off it.
pub struct Simulation<'a> {
    run: &'a Run,
    estimates: YieldEstimates,
}

impl<'a> Simulation<'a> {
    /// The result of `run`.
    pub fn new(run: &'a Run) -> Self {
        Self {
            run,
            estimates: YieldEstimates::read(&run.series, &run.case.stack),
        }
    }
}

/// One row a run.
pub fn simulations<'a>(runs: &'a [Simulation<'a>]) -> DataTable<'a> {
    let force = |estimate: Option<Estimate>| estimate.map(|estimate| estimate.force);
    let columns = Columns::<&Simulation>::new(
            "simulation",
            "A row is one compression run and what was read off it. The case file beside it (case.json) holds \
             what is left out here.",
            "`tristack simulate` (summary.json)",
        )
        .text("code", "the code that ran", |own| own.run.provenance.identity.code.clone())
        .shown("code")
        .version(|own| &own.run.provenance.identity.version)
        .shown("version")
        .stack(|own| own.run.case.stack)
        .arms(|own| own.run.case.convention.arms);
    let columns = protocol(convention(columns, |own| own.run.case), |own| own.run.case);
    columns
        .number(
            "peak_force",
            "m g",
            "largest wall force; absent if the force still rises at the end",
            move |own| force(own.estimates.peak),
        )
        .shown_as("peak", |force| significant(force, 9))
        .number(
            "slip_force",
            "m g",
            "wall force when the floor first slips; absent if it does not",
            move |own| force(own.estimates.slip),
        )
        .shown_as("slip onset", |force| significant(force, 9))
        .number("steps", "1", "steps in all", |own| own.run.provenance.steps)
        .shown("steps")
        .number("seconds", "s", "wall time", |own| {
            own.run.provenance.seconds
        })
        .shown_as("wall time", |seconds| format!("{seconds:.2}"))
        .rows(runs)
}

/// The contact convention of `case` beyond its arms.
fn convention<'a, R: 'a>(
    columns: Columns<'a, R>,
    case: impl Fn(&R) -> Case + Copy + 'a,
) -> Columns<'a, R> {
    let own = move |row: &R| case(row).convention;
    columns
        .number("restitution", "1", "restitution coefficient", move |row| {
            own(row).restitution
        })
        .text(
            "coulomb_operand",
            "force that Coulomb's limit is compared with",
            move |row| Value::word(own(row).coulomb_operand),
        )
        .text(
            "sliding_spring",
            "treatment of the tangential spring of a sliding contact",
            move |row| Value::word(own(row).sliding_spring),
        )
        .text(
            "history_update",
            "treatment of the tangential spring of a turning contact",
            move |row| Value::word(own(row).history_update),
        )
        .text(
            "tensile_force",
            "normal force of a contact that separates",
            move |row| Value::word(own(row).tensile_force),
        )
        .number(
            "moment_of_inertia",
            "m r²",
            "moment of inertia of a cylinder",
            move |row| own(row).moment_of_inertia,
        )
}

/// How `case` is prepared and compressed.
fn protocol<'a, R: 'a>(
    columns: Columns<'a, R>,
    case: impl Fn(&R) -> Case + Copy + 'a,
) -> Columns<'a, R> {
    let own = move |row: &R| case(row).protocol;
    columns
        .text(
            "preparation",
            "how the stack is brought to rest: `gravity-ramp` or `side-walls`",
            move |row| own(row).preparation.as_str(),
        )
        .number(
            "ramp_time",
            "√(m/k_n)",
            "duration of the gravity ramp",
            move |row| match own(row).preparation {
                Preparation::GravityRamp { ramp_time, .. } => Some(ramp_time),
                Preparation::SideWalls(_) => None,
            },
        )
        .number(
            "rest_time",
            "√(m/k_n)",
            "duration of the rest before the compression",
            move |row| match own(row).preparation {
                Preparation::GravityRamp { rest_time, .. } => rest_time,
                Preparation::SideWalls(walls) => walls.rest_time,
            },
        )
        .number(
            "push",
            "r",
            "A, how far each side wall is pushed in",
            move |row| match own(row).preparation {
                Preparation::GravityRamp { .. } => None,
                Preparation::SideWalls(walls) => Some(walls.push),
            },
        )
        .number(
            "wall_speed",
            "r √(k_n/m)",
            "speed of the top wall",
            move |row| own(row).wall_speed,
        )
        .shown_as("wall speed", |speed| format!("{speed:.3e}"))
        .number("time_step", "√(m/k_n)", "time step", move |row| {
            own(row).time_step
        })
        .shown("time step")
        .number("wall_travel", "r", "how far the wall moves", move |row| {
            own(row).wall_travel
        })
        .number(
            "coarse_interval",
            "√(m/k_n)",
            "time between rows of the series far from the yield",
            move |row| own(row).sampling.coarse_interval,
        )
        .number(
            "fine_from_travel",
            "r",
            "wall travel from which rows are taken finely",
            move |row| own(row).sampling.fine_from_travel,
        )
        .number(
            "fine_interval",
            "√(m/k_n)",
            "time between rows near the yield",
            move |row| own(row).sampling.fine_interval,
        )
        .text("shortcuts", "whether the run takes shortcuts", move |row| {
            own(row).shortcuts.is_some()
        })
}
