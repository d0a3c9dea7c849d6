//! The yield force of a few series that were made without a plan.

use super::budget::Budget;
use super::judgement::YieldForce;
use super::plan::{Measurement, RAMP_TIME, REST_TIME, plan, speed_excess, speed_scale};
use super::runs::{MIDDLE_RUN, Method, RunRoles, SPEEDS};
use super::touch::is_gentle;
use crate::code::{Identity, Provenance, Run, SettledCode};
use crate::model::{
    Arms, Case, ContactConvention, ContactLaw, Preparation, Problem, Protocol, Sampling, Stack,
};
use crate::runs::RunSummary;
use crate::series::{Mechanics, Sample, Series};
use crate::study::{Grounds, Study};
use crate::theory::limit_uncertainty;

/// Time in which the touch of a wall has died away: overshoots come within 20.
const TOUCH: f64 = 20.0;

/// Role of the runs that differ in their wall speed.
const WALL_SPEED: &str = "wall speed";

/// A series with what is known of its run.
#[derive(Debug, Clone)]
pub struct SeriesInput {
    /// Its name in messages and tables.
    pub name: String,
    /// The series.
    pub series: Series,
    /// Time step, read off its times.
    pub time_step: f64,
    /// Wall speed.
    pub wall_speed: f64,
}

/// One of the series with what it shows.
#[derive(Debug, Clone)]
pub struct FoundSeries {
    /// Its name.
    pub name: String,
    /// What distinguishes it from the run at the middle speed: wall speed, time step or ramp.
    pub role: &'static str,
    /// What was read off it.
    pub summary: RunSummary,
}

/// Series of one stack, judged.
#[derive(Debug, Clone)]
pub struct JudgedSeries {
    /// The measurement that they are judged as.
    pub measurement: Measurement,
    /// The series that are extrapolated, and those that make parts of the budget known.
    pub used: Vec<FoundSeries>,
    /// Faster series, which are read but not extrapolated.
    pub faster: Vec<FoundSeries>,
    /// The yield force.
    pub finding: YieldForce,
    /// The grounds for the verdict.
    pub grounds: Grounds,
}

impl JudgedSeries {
    /// The parts of the uncertainty of the force that is judged.
    pub fn budget(&self) -> Option<&Budget> {
        let found = self.finding.slip.as_ref().or(self.finding.peak.as_ref());
        found.map(|found| &found.budget)
    }
}

/// Position of the run that `--coarse-step` and `--short-ramp` are compared with, among this many runs at different
/// wall speeds, fastest first: the middle one of the three slowest, or the slowest if there are fewer.
pub fn compared_run(speeds: usize) -> usize {
    match speeds.checked_sub(SPEEDS.len()) {
        Some(faster) => faster + MIDDLE_RUN,
        None => speeds.saturating_sub(1),
    }
}

/// Judges series of `stack` at different wall speeds, fastest first, under `convention`: extrapolates the three
/// slowest or, if there are fewer, reads the slowest alone, for which theory must know what its speed adds. `coarse`
/// is a run with twice the time step of [`compared_run`], `hastened` one with half the gravity ramp.
/// `arm_uncertainty` is that of measured arms. `None` if nothing yields, or if theory does not know what the speed
/// adds.
pub fn judge_series(
    stack: &Stack,
    convention: ContactConvention,
    arm_uncertainty: Option<Arms>,
    series: Vec<SeriesInput>,
    coarse: Option<SeriesInput>,
    hastened: Option<SeriesInput>,
) -> Option<JudgedSeries> {
    let found = |role: &'static str, ramp: f64| {
        move |input: SeriesInput| FoundSeries {
            summary: summary(stack, convention, &input, ramp),
            name: input.name,
            role,
        }
    };
    let at_speeds = series.into_iter().map(found(WALL_SPEED, RAMP_TIME));
    let mut faster: Vec<FoundSeries> = at_speeds.collect();
    let slowest = match faster.len() {
        few if few < SPEEDS.len() => 1,
        _ => SPEEDS.len(),
    };
    let mut used = faster.split_off(faster.len().checked_sub(slowest)?);
    let coarse_time_step = coarse.map(found("twice the time step", RAMP_TIME));
    let short_ramp = hastened.map(found("half the gravity ramp", 0.5 * RAMP_TIME));
    let mut further = |run: Option<FoundSeries>| {
        let position = run.is_some().then_some(used.len());
        used.extend(run);
        position
    };
    let positions = [further(coarse_time_step), further(short_ramp)];
    let mut measurement = measurement(stack, convention, &used, positions)?;
    let problem = Problem::new(*stack, convention).ok()?;
    measurement.convention_uncertainty =
        arm_uncertainty.and_then(|arms| limit_uncertainty(&problem, &arms));
    let runs = used.iter().map(|found| found.summary.clone()).collect();
    let evaluation = measurement.evaluate(vec![runs]);
    Some(JudgedSeries {
        measurement,
        used,
        faster,
        finding: evaluation.finding,
        grounds: evaluation.grounds,
    })
}

/// The measurement that `used` are judged as. Its code is the native one, which accepts every convention.
fn measurement(
    stack: &Stack,
    convention: ContactConvention,
    used: &[FoundSeries],
    [coarse_time_step, short_ramp]: [Option<usize>; 2],
) -> Option<Measurement> {
    let planned = plan(&SettledCode::native(), stack, convention);
    let scale = speed_scale(&planned.limit, stack, &convention)?;
    let cases: Vec<Case> = used.iter().map(|found| found.summary.case).collect();
    let at_one_speed = used.iter().filter(|found| found.role == WALL_SPEED).count() == 1;
    let speed = |run: usize| cases.get(run).map(|case| case.protocol.wall_speed);
    let speeds = match at_one_speed {
        true => [speed(0)?; 3],
        false => [speed(0)?, speed(1)?, speed(2)?],
    };
    let excess = at_one_speed.then(|| speed_excess(stack, &convention, &planned.limit));
    let speed_excess = match excess {
        Some(excess) => Some(excess?),
        None => None,
    };
    Some(Measurement {
        method: match at_one_speed {
            true => Method::AtOneSpeed,
            false => Method::Extrapolated,
        },
        speed_excess,
        is_gentle: is_gentle(speeds[0], stack, &convention),
        roles: RunRoles {
            speeds: speeds.map(|speed| speed / scale),
            coarse_and_fast: None,
            plain: None,
            coarse_time_step,
            short_ramp,
            has_slow_ramps: planned.limit.needs_slow_ramp,
        },
        cases,
        ..planned
    })
}

/// The summary of `input`, a run whose beginning is not known.
fn summary(
    stack: &Stack,
    convention: ContactConvention,
    input: &SeriesInput,
    ramp_time: f64,
) -> RunSummary {
    let case = Case {
        stack: *stack,
        convention,
        protocol: protocol(input, ramp_time),
    };
    let identity = Identity {
        code: input.name.clone(),
        ..Identity::native().clone()
    };
    let steps = case.total_steps();
    let mut summary = RunSummary::new(Run {
        case,
        series: input.series.clone(),
        provenance: Provenance::now(identity, String::new(), Vec::new(), steps, 0.0),
    });
    // A wall that touches in the first row has already moved the stack.
    let touches = input.series.samples().first();
    if touches.is_some_and(|row| row.wall_force > 0.0) {
        summary.start = None;
    }
    summary.mechanics = Some(Mechanics::read_without_beginning(&input.series, &case));
    summary
}

/// The protocol as far as the series shows it, with the preparation of a planned run.
fn protocol(input: &SeriesInput, ramp_time: f64) -> Protocol {
    let samples = input.series.samples();
    let last = samples.last().map_or(0.0, |last| last.time);
    let intervals = samples.windows(2).map(|two| two[1].time - two[0].time);
    let interval = intervals.fold(last, f64::min);
    Protocol {
        preparation: Preparation::GravityRamp {
            ramp_time,
            rest_time: REST_TIME,
        },
        time_step: input.time_step,
        wall_speed: input.wall_speed,
        wall_travel: input.wall_speed * last,
        sampling: Sampling {
            coarse_interval: interval,
            fine_from_travel: 0.0,
            fine_interval: interval,
        },
        shortcuts: None,
    }
}

impl SeriesInput {
    /// The wall speed that the series shows, with its uncertainty, from the growth of the overlap with the `wall` of
    /// this law and from the motion of cylinder 1. `None` if it shows none.
    pub fn shown_speed(&self, wall: &ContactLaw, stack: &Stack) -> Option<(f64, f64)> {
        let samples = self.series.samples();
        let touching = samples.iter().position(|row| row.wall_force > 0.0)?;
        let touched = samples.get(touching)?.time;
        let rows = samples.get(touching..)?.iter();
        let force = |row: &&Sample| row.wall_force;
        let highest = rows.max_by(|one, other| force(one).total_cmp(&force(other)))?;
        let settled = samples.iter().find(|row| row.time >= touched + TOUCH)?;
        let duration = highest.time - settled.time;
        let height = |row: &Sample| row.top(stack)[1];
        let overlap = |row: &Sample| wall.overlap(row.wall_force);
        let travel = (overlap(highest) - overlap(settled)) - (height(highest) - height(settled));
        let speed = travel / duration;
        // The uncertainty is what damping and ringing do to the force at either end: at most the travel in the time
        // of a touch.
        let known = duration > 0.0 && speed.is_finite();
        known.then_some((speed, TOUCH / duration * self.wall_speed))
    }
}
