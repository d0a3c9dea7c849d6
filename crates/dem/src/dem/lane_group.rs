//! Stacks that advance in lockstep, one in each lane, each at its own step of its own case.

use super::loading::LoadingProgram;
use super::real::{Real, Work};
use super::stack_scene::LoadedStack;
use crate::model::Case;
use crate::series::{DropWatch, Sample};

/// Steps between two calls of `wanted`, which take some milliseconds.
const STEPS_BETWEEN_QUESTIONS: u64 = 1 << 16;

/// The run of one lane.
#[derive(Debug, Clone)]
pub(super) struct Lane {
    /// Index of the case.
    pub(super) index: usize,
    pub(super) case: Case,
    /// Steps completed, from the start of the preparation.
    pub(super) step: u64,
    /// Rows taken so far.
    pub(super) samples: Vec<Sample>,
    program: LoadingProgram,
    next_event: Option<u64>,
    /// The drop of the wall force that ends the run early, and the step of the compression from which it counts.
    drop: (DropWatch, u64),
    is_over: bool,
}

impl Lane {
    /// Starts a run of `case`, after `step` steps and with the `samples` taken so far.
    pub(super) fn new(index: usize, case: Case, step: u64, samples: Vec<Sample>) -> Self {
        let program = LoadingProgram::new(&case);
        let mut lane = Self {
            index,
            case,
            step,
            samples: Vec::new(),
            program,
            next_event: program.event_from(step),
            drop: program.drop_watch(),
            is_over: false,
        };
        samples.into_iter().for_each(|sample| lane.take(sample));
        lane
    }

    /// Adds a row; a drop of the force ends the run.
    fn take(&mut self, sample: Sample) {
        let (watch, from) = &mut self.drop;
        if sample.step >= *from && watch.has_dropped(sample.wall_force) {
            self.is_over = true;
        }
        self.samples.push(sample);
    }

    fn has_event(&self) -> bool {
        self.next_event == Some(self.step)
    }

    fn is_complete(&self) -> bool {
        self.is_over || self.next_event.is_none()
    }
}

/// Supplies the lanes with runs, and receives the results.
pub(super) trait Supervisor<Stack> {
    /// Puts the next run into a lane, if there is one.
    fn fill(&mut self, stack: &mut Stack, lane: usize) -> Option<Lane>;
    /// Whether to continue; called every few milliseconds.
    fn wanted(&mut self, stack: &Stack, lanes: &[Option<Lane>]) -> bool;
    /// Called when a row has been taken.
    fn sampled(&mut self, _stack: &Stack) {}
    /// Receives the run of a lane at its end, which may be early.
    fn ended(&mut self, lane: Lane);
}

/// A group of stacks, one per lane.
pub(super) struct LaneGroup<Stack: LoadedStack> {
    stack: Stack,
    lanes: Vec<Option<Lane>>,
}

impl<Stack: LoadedStack> LaneGroup<Stack> {
    /// Creates empty lanes that share the properties of `stack`.
    pub(super) fn new(stack: Stack) -> Self {
        Self {
            stack,
            lanes: vec![None; Stack::Number::LANES],
        }
    }

    /// Runs everything that `supervisor` supplies, until nothing is left or the supervisor stops it.
    pub(super) fn run(&mut self, supervisor: &mut impl Supervisor<Stack>) {
        for lane in 0..self.lanes.len() {
            self.lanes[lane] = supervisor.fill(&mut self.stack, lane);
        }
        let mut unasked = 0;
        while let Some(quiet) = self.quiet_steps() {
            let steps = quiet.min(STEPS_BETWEEN_QUESTIONS - unasked);
            self.advance(steps);
            unasked += steps;
            if unasked >= STEPS_BETWEEN_QUESTIONS {
                unasked = 0;
                if !supervisor.wanted(&self.stack, &self.lanes) {
                    break;
                }
            } else {
                self.eventful_step(supervisor);
                unasked += 1;
            }
        }
        for lane in self.lanes.iter_mut().filter_map(Option::take) {
            supervisor.ended(lane);
        }
    }

    /// Returns the steps until the next action or row in any lane; `None` if all lanes are empty.
    fn quiet_steps(&self) -> Option<u64> {
        let lanes = self.lanes.iter().flatten();
        lanes
            .filter_map(|lane| Some(lane.next_event? - lane.step))
            .min()
    }

    fn advance(&mut self, steps: u64) {
        self.carry_out(Part::Steps(steps));
        for lane in self.lanes.iter_mut().flatten() {
            lane.step += steps;
        }
    }

    fn carry_out(&mut self, part: Part) {
        let stack = &mut self.stack;
        stack.number().vectorize(Stepping { stack, part });
    }

    /// Carries out one step with an action or a row.
    fn eventful_step(&mut self, supervisor: &mut impl Supervisor<Stack>) {
        for (index, lane) in eventful(&mut self.lanes) {
            let case = lane.case;
            let mut act = |action| self.stack.act(index, &case, action);
            lane.program.actions_at(lane.step, &mut act);
        }
        self.carry_out(Part::Forces);
        for (index, lane) in eventful(&mut self.lanes) {
            if let Some(row) = lane.program.row_at(lane.step) {
                lane.take(self.stack.sample(index, &lane.case, row));
                supervisor.sampled(&self.stack);
            }
        }
        self.carry_out(Part::Motion);
        for index in 0..self.lanes.len() {
            self.step_on(index, supervisor);
        }
    }

    /// Counts the step, and replaces the run if it is complete.
    fn step_on(&mut self, index: usize, supervisor: &mut impl Supervisor<Stack>) {
        let slot = &mut self.lanes[index];
        let Some(lane) = slot else { return };
        lane.step += 1;
        if lane.next_event.is_some_and(|event| event < lane.step) {
            lane.next_event = lane.program.event_from(lane.step);
        }
        if let Some(lane) = slot.take_if(|lane| lane.is_complete()) {
            supervisor.ended(lane);
            *slot = supervisor.fill(&mut self.stack, index);
        }
    }
}

/// Work on all lanes at once.
enum Part {
    /// Evaluate the forces.
    Forces,
    /// Advance velocities, positions and walls.
    Motion,
    /// Both, for this number of steps.
    Steps(u64),
}

struct Stepping<'a, Stack> {
    stack: &'a mut Stack,
    part: Part,
}

impl<Stack: LoadedStack> Work for Stepping<'_, Stack> {
    #[inline(always)]
    fn carry_out(self) {
        match self.part {
            Part::Forces => self.stack.evaluate_forces(),
            Part::Motion => self.stack.advance(),
            Part::Steps(steps) => self.stack.steps(steps),
        }
    }
}

/// The lanes with an action or a row at this step.
fn eventful(lanes: &mut [Option<Lane>]) -> impl Iterator<Item = (usize, &mut Lane)> {
    let lanes = lanes.iter_mut().enumerate();
    let lanes = lanes.filter_map(|(index, lane)| Some((index, lane.as_mut()?)));
    lanes.filter(|(_, lane)| lane.has_event())
}
