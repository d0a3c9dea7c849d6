//! The result of one compression run.

use super::number::digits;
use super::table::{Columns, DataTable, Value};
use crate::code::Run;
use crate::model::{ContactConvention, Preparation, Protocol};
use crate::series::{Estimate, YieldEstimates};

/// One run and its yield force by both estimators.
pub(crate) struct Simulation<'a> {
    run: &'a Run,
    estimates: YieldEstimates,
}

impl<'a> Simulation<'a> {
    pub fn new(run: &'a Run) -> Self {
        Self {
            run,
            estimates: YieldEstimates::read(&run.series, &run.case.stack),
        }
    }

    fn convention(&self) -> &ContactConvention {
        &self.run.case.convention
    }

    fn protocol(&self) -> &Protocol {
        &self.run.case.protocol
    }

    fn ramp_time(&self) -> Option<f64> {
        match self.protocol().preparation {
            Preparation::GravityRamp { ramp_time, .. } => Some(ramp_time),
            Preparation::SideWalls(_) => None,
        }
    }

    fn rest_time(&self) -> f64 {
        match self.protocol().preparation {
            Preparation::GravityRamp { rest_time, .. } => rest_time,
            Preparation::SideWalls(walls) => walls.rest_time,
        }
    }

    fn push(&self) -> Option<f64> {
        match self.protocol().preparation {
            Preparation::GravityRamp { .. } => None,
            Preparation::SideWalls(walls) => Some(walls.push),
        }
    }
}

type SimulationColumns<'a> = Columns<'a, &'a Simulation<'a>>;

/// One row per run.
pub(crate) fn simulations<'a>(runs: &'a [Simulation<'a>]) -> DataTable<'a> {
    let force = |estimate: Option<Estimate>| estimate.map(|estimate| estimate.force);
    let peak = "largest wall force; absent if the force still rises at the end";
    let slip = "wall force when the floor first slips; absent if it does not";
    protocol(convention(subject()))
        .number("peak_force", "m g", peak, move |own| {
            force(own.estimates.peak)
        })
        .shown_as("peak", digits::<9>)
        .number("slip_force", "m g", slip, move |own| {
            force(own.estimates.slip)
        })
        .shown_as("slip onset", digits::<9>)
        .number("steps", "1", "steps in all", |own| own.run.provenance.steps)
        .shown("steps")
        .number("seconds", "s", "wall time", |own| {
            own.run.provenance.seconds
        })
        .shown_as("wall time", |seconds| format!("{seconds:.2}"))
        .rows(runs)
}

/// The code, the stack and the arms.
fn subject<'a>() -> SimulationColumns<'a> {
    let table = "A row is one compression run and what was read off it. The case file beside it (case.json) holds \
                 what is left out here.";
    Columns::new("simulation", table, "`tristack simulate` (summary.json)")
        .text("code", "the code that ran", |own: &&Simulation| {
            own.run.provenance.identity.code.clone()
        })
        .shown("code")
        .version(|own| &own.run.provenance.identity.version)
        .shown("version")
        .stack(|own| own.run.case.stack)
        .convention(|own| *own.convention())
}

/// The contact convention beyond the arms.
fn convention(columns: SimulationColumns) -> SimulationColumns {
    let operand = "force that Coulomb's limit is compared with";
    let sliding = "treatment of the tangential spring of a sliding contact";
    let history = "treatment of the tangential spring of a turning contact";
    let tensile = "normal force of a contact that separates";
    let inertia = "moment of inertia of a cylinder";
    columns
        .number("restitution", "1", "restitution coefficient", |own| {
            own.convention().restitution
        })
        .text("coulomb_operand", operand, |own| {
            Value::word(own.convention().coulomb_operand)
        })
        .text("sliding_spring", sliding, |own| {
            Value::word(own.convention().sliding_spring)
        })
        .text("history_update", history, |own| {
            Value::word(own.convention().history_update)
        })
        .text("tensile_force", tensile, |own| {
            Value::word(own.convention().tensile_force)
        })
        .number("moment_of_inertia", "m r²", inertia, |own| {
            own.convention().moment_of_inertia
        })
}

/// Preparation, compression and sampling.
fn protocol(columns: SimulationColumns) -> SimulationColumns {
    let time = "√(m/k_n)";
    let preparation = "how the stack is brought to rest: `gravity-ramp` or `side-walls`";
    let rest = "duration of the rest before the compression";
    let push = "A, how far each side wall is pushed in";
    let coarse = "time between rows of the series far from the yield";
    let from = "wall travel from which rows are taken finely";
    let fine = "time between rows near the yield";
    columns
        .text("preparation", preparation, |own| {
            own.protocol().preparation.as_str()
        })
        .number("ramp_time", time, "duration of the gravity ramp", |own| {
            own.ramp_time()
        })
        .number("rest_time", time, rest, |own| own.rest_time())
        .number("push", "r", push, |own| own.push())
        .number(
            "wall_speed",
            "r √(k_n/m)",
            "speed of the top wall",
            |own| own.protocol().wall_speed,
        )
        .shown_as("wall speed", |speed| format!("{speed:.3e}"))
        .number("time_step", time, "time step", |own| {
            own.protocol().time_step
        })
        .shown("time step")
        .number("wall_travel", "r", "how far the wall moves", |own| {
            own.protocol().wall_travel
        })
        .number("coarse_interval", time, coarse, |own| {
            own.protocol().sampling.coarse_interval
        })
        .number("fine_from_travel", "r", from, |own| {
            own.protocol().sampling.fine_from_travel
        })
        .number("fine_interval", time, fine, |own| {
            own.protocol().sampling.fine_interval
        })
        .text("shortcuts", "whether the run takes shortcuts", |own| {
            own.protocol().shortcuts.is_some()
        })
}
