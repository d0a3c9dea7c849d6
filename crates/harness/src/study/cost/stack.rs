//! The cost of a stack of cylinders or spheres: a step, a start, and a yield force.

use super::statistics::median;
use super::target::{BenchError, BenchTarget, InstalledTarget, TimedRuns, convention};
use crate::code::{Code, RunContext, SettledCode};
use crate::model::{
    CRITICAL_FRICTION, Case, PAPER_BODIES, Power, Preparation, Protocol, Sampling, Stack,
};
use crate::runs::RunSummary;
use crate::series::YieldEstimates;
use crate::study::yield_force::{Measurement, extrapolate, plan};

/// Stiffness of all stacks, the middle one of the paper.
const STIFFNESS: f64 = 1e3;
/// Friction of the first stack of cylinders. For spheres it is scaled with their critical friction.
const FRICTION: f64 = 0.3;
/// Difference between the frictions of two neighbouring stacks.
const FRICTION_STEP: f64 = 1e-3;
/// Wall travel of the timed steps in r. It ends long before the yield, as nearly all steps of a measurement do.
const TRAVEL: f64 = 0.05;
/// Length of the long run in units of the short one.
pub(super) const LENGTHS: u64 = 8;
/// Time step, as in planned runs.
const TIME_STEP: f64 = 0.1;
/// Duration of gravity ramp and of rest, as in planned runs.
const RAMP_TIME: f64 = 100.0;
const FINE_INTERVAL: f64 = 10.0;

/// Steps of the compression in the longer one of the two runs whose difference is the cost of a step.
const STEPS: u64 = 400_000;
/// Native cases in each of these runs, since native steps are so much faster; external codes run one.
const NATIVE_CASES: usize = 64;
/// Stacks whose yield force is measured by the runs that a crosscheck plans, all in one call.
const STACKS: usize = 8;
/// Repeats of the whole measurement, if nothing else is wanted: a few minutes for all codes.
const REPEATS: usize = 5;

/// The cost of the stack for one target.
#[derive(Debug, Clone, PartialEq)]
pub struct StackCost {
    /// The target.
    pub target: BenchTarget,
    /// Its version.
    pub version: String,
    /// Timed steps of all cases together in each repeat.
    pub steps: u64,
    /// Wall time per step and case in nanoseconds, of each repeat in order: the difference between a long and a short
    /// run over the difference of their steps, so that time before the first step does not count.
    pub nanoseconds: Vec<f64>,
    /// Wall time of the short run beyond its steps, in seconds: start, preparation of files, end.
    pub start_up_seconds: Vec<f64>,
    /// Wall time per yield force in seconds, start included.
    pub seconds_per_yield_force: Vec<f64>,
    /// Largest distance of these yield forces from the exact limit, relative to F + n + 1.
    pub largest_error: f64,
    /// Largest resident memory, in bytes, of the processes that measured the yield forces (for native: this process).
    /// `None` where the system does not report it.
    pub peak_bytes: Option<u64>,
}

/// Returns the installed codes, each in its first variant and as declared: keys that a manifest leaves out do not
/// change the duration of a step.
pub fn installed_codes() -> Vec<SettledCode> {
    let codes = Code::with_power(Power::Linear).into_iter();
    let installed = codes.filter(|code| code.is_first_variant() && code.find().is_some());
    installed.map(|code| code.unmeasured("")).collect()
}

/// Measures all targets of `codes` on one core, each call in a directory of its own in that of `context`. The targets
/// take turns, so that other load on the machine slows down all of them.
///
/// # Errors
/// If a code is missing, a run fails, or its files cannot be written.
pub fn measure_stack(
    codes: &[SettledCode],
    bodies: u8,
    repeats: Option<usize>,
    context: &RunContext,
) -> Result<Vec<StackCost>, BenchError> {
    let targets = codes.iter().flat_map(|code| {
        let targets = BenchTarget::of(code.name().clone()).into_iter();
        targets.map(move |target| InstalledTarget::find(target, code))
    });
    let targets: Vec<_> = targets.collect::<Result<_, _>>()?;
    let mut costs: Vec<StackCost> = targets.iter().map(StackCost::nothing_yet).collect();
    for target in &targets {
        // The first start reads the program from disk.
        let short = timed_cases((&target.settled, bodies), 1, STEPS, 1);
        target.time(&short, context)?;
    }
    for _ in 0..repeats.unwrap_or(REPEATS) {
        for (target, cost) in targets.iter().zip(&mut costs) {
            time_steps(target, bodies, cost, context)?;
            time_yield_forces(target, bodies, cost, context)?;
        }
    }
    Ok(costs)
}

fn time_steps(
    target: &InstalledTarget,
    bodies: u8,
    cost: &mut StackCost,
    context: &RunContext,
) -> Result<(), BenchError> {
    cost.add_steps(short_and_long(target, bodies, STEPS, context)?);
    Ok(())
}

/// Times a short run and a long one with so many `steps`, and returns the steps and the seconds of each.
pub(super) fn short_and_long(
    target: &InstalledTarget,
    bodies: u8,
    steps: u64,
    context: &RunContext,
) -> Result<[(u64, f64); 2], BenchError> {
    let count = match target.code.name().is_native() {
        true => NATIVE_CASES,
        false => 1,
    };
    let [short, long] =
        [1, LENGTHS].map(|part| timed_cases((&target.settled, bodies), count, steps, part));
    let [few, many] = [&short, &long].map(|cases| cases.iter().map(Case::total_steps).sum());
    let short = target.time(&short, context)?.duration.as_secs_f64();
    let long = target.time(&long, context)?.duration.as_secs_f64();
    Ok([(few, short), (many, long)])
}

fn time_yield_forces(
    target: &InstalledTarget,
    bodies: u8,
    cost: &mut StackCost,
    context: &RunContext,
) -> Result<(), BenchError> {
    let plans = plans((&target.settled, bodies), STACKS);
    let cases: Vec<Case> = plans.iter().flat_map(|plan| plan.cases.clone()).collect();
    cost.add_yield_forces(&plans, target.time(&cases, context)?);
    Ok(())
}

/// Plans the measurements of the yield forces of so many `stacks`, as a crosscheck does for `code`.
pub(super) fn plans((code, bodies): (&SettledCode, u8), stacks: usize) -> Vec<Measurement> {
    let stacks = (0..stacks).map(|index| stack(index, bodies));
    stacks
        .map(|stack| plan(code, &stack, convention(code)))
        .collect()
}

/// Returns the stack of the case at `index`, each with its own friction.
fn stack(index: usize, bodies: u8) -> Stack {
    let mut stack = Stack {
        bodies,
        ..Stack::paper(FRICTION, STIFFNESS)
    };
    if bodies != PAPER_BODIES {
        stack.floor_friction *= stack.ring().critical_friction / CRITICAL_FRICTION;
    }
    stack.floor_friction += FRICTION_STEP * index as f64;
    stack
}

/// Returns `count` cases with `part` / [`LENGTHS`] of a compression of so many `steps`, and few rows.
pub(super) fn timed_cases(
    (code, bodies): (&SettledCode, u8),
    count: usize,
    steps: u64,
    part: u64,
) -> Vec<Case> {
    let case = |index| {
        let stack = stack(index, bodies);
        Case {
            convention: convention(code).of_bodies(&stack),
            stack,
            protocol: timed_protocol(steps, part),
        }
    };
    (0..count).map(case).collect()
}

fn timed_protocol(steps: u64, part: u64) -> Protocol {
    let long_time = TIME_STEP * steps as f64;
    let wall_travel = TRAVEL * part as f64 / LENGTHS as f64;
    Protocol {
        preparation: Preparation::GravityRamp {
            ramp_time: RAMP_TIME,
            rest_time: RAMP_TIME,
        },
        time_step: TIME_STEP,
        wall_speed: TRAVEL / long_time,
        wall_travel,
        sampling: Sampling {
            coarse_interval: long_time / LENGTHS as f64,
            fine_from_travel: wall_travel,
            fine_interval: FINE_INTERVAL,
        },
        shortcuts: None,
    }
}

impl StackCost {
    fn nothing_yet(target: &InstalledTarget) -> Self {
        Self {
            target: target.target.clone(),
            version: target.code.identity().version.clone(),
            steps: 0,
            nanoseconds: Vec::new(),
            start_up_seconds: Vec::new(),
            seconds_per_yield_force: Vec::new(),
            largest_error: 0.0,
            peak_bytes: None,
        }
    }

    /// Adds the steps and seconds of a short and a long run.
    fn add_steps(&mut self, [(few, short), (many, long)]: [(u64, f64); 2]) {
        self.steps = many - few;
        let seconds_per_step = (long - short) / self.steps as f64;
        self.nanoseconds.push(1e9 * seconds_per_step);
        let start_up = short - seconds_per_step * few as f64;
        self.start_up_seconds.push(start_up.max(0.0));
    }

    /// Adds the runs of all `plans` together.
    fn add_yield_forces(&mut self, plans: &[Measurement], timed: TimedRuns) {
        let seconds = timed.duration.as_secs_f64() / plans.len() as f64;
        self.seconds_per_yield_force.push(seconds);
        self.peak_bytes = self.peak_bytes.max(timed.peak_bytes);
        let mut runs = timed.runs.into_iter();
        for plan in plans {
            let own = runs.by_ref().take(plan.cases.len());
            let error = yield_force_error(plan, own.map(RunSummary::new));
            self.largest_error = self.largest_error.max(error);
        }
    }

    /// Wall time per step and case in nanoseconds: the median of the repeats.
    pub fn median(&self) -> f64 {
        median(&self.nanoseconds)
    }

    /// Start and end in seconds: the median of the repeats.
    pub fn start_up(&self) -> f64 {
        median(&self.start_up_seconds)
    }

    /// Yield forces per second, to [`Self::largest_error`]: the median of the repeats.
    pub fn yield_forces_per_second(&self) -> f64 {
        1.0 / median(&self.seconds_per_yield_force)
    }
}

/// Returns the distance of the slip onset that `summaries` give from the exact one, relative to F + n + 1; infinite
/// if one of them is missing.
fn yield_force_error(plan: &Measurement, summaries: impl Iterator<Item = RunSummary>) -> f64 {
    let estimates: Vec<YieldEstimates> = summaries.map(|summary| summary.estimates).collect();
    let steps: Vec<u64> = plan.cases.iter().map(Case::total_steps).collect();
    let slip = extrapolate(&estimates, &steps, plan.stack.stiffness, |run| run.slip);
    let error = slip.zip(plan.limit.slip_onset);
    error.map_or(f64::INFINITY, |(slip, exact)| {
        (slip.force - exact).abs() / plan.stack.floor_load(exact)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_and_long_runs_are_valid_and_differ_in_their_steps_alone() {
        let [short, long] =
            [1, LENGTHS].map(|part| timed_cases((&SettledCode::named("yade"), 2), 2, 8000, part));
        for (short, long) in short.iter().zip(&long) {
            assert_eq!([short.validate(), long.validate()], [Ok(()), Ok(())]);
            assert_eq!(long.total_steps() - short.total_steps(), 7000);
            assert_eq!(short.protocol.wall_speed, long.protocol.wall_speed);
        }
        assert_ne!(short[0].stack, short[1].stack);
    }

    #[test]
    fn what_comes_before_the_first_step_does_not_count() {
        let target =
            InstalledTarget::find(BenchTarget::NativeScalar, &SettledCode::native()).unwrap();
        let mut cost = StackCost::nothing_yet(&target);
        cost.add_steps([(1000, 3.001), (9000, 3.009)]);
        assert!((cost.median() - 1000.0).abs() < 1e-6);
        assert!((cost.start_up() - 3.0).abs() < 1e-9);
    }
}
