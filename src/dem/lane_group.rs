//! Stacks that advance in lockstep, one in each lane, each at its own step of its own case.

use super::contact::ContactModel;
use super::loading::LoadingProgram;
use super::real::{Real, Work};
use super::stack_scene::StackScene;
use crate::model::Case;
use crate::series::{DropWatch, Sample};

/// Some milliseconds.
const STEPS_BETWEEN_QUESTIONS: u64 = 1 << 16;

/// How far one lane is.
#[derive(Debug, Clone)]
pub(super) struct Lane {
    /// Which case it is, to those who have put it there.
    pub(super) index: usize,
    pub(super) case: Case,
    /// Steps done, from the start of the preparation.
    pub(super) step: u64,
    /// Rows so far.
    pub(super) samples: Vec<Sample>,
    program: LoadingProgram,
    next_event: Option<u64>,
    /// What ends the run early, and the step of the compression from which it counts.
    drop: (DropWatch, u64),
    is_over: bool,
}

impl Lane {
    /// A run of `case` of which `step` steps are done and `samples` taken.
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

    /// Takes in a row; nothing happens any more after the last one.
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

/// Fills lanes, and takes out what is in them.
pub(super) trait Supervisor<R: Real, Model: ContactModel<R>> {
    /// Puts the next run into a lane, if there is one.
    fn fill(&mut self, stack: &mut StackScene<R, Model>, lane: usize) -> Option<Lane>;
    /// Whether to go on; asked every few milliseconds.
    fn wanted(&mut self, stack: &StackScene<R, Model>, lanes: &[Option<Lane>]) -> bool;
    /// A row has been taken.
    fn sampled(&mut self, _stack: &StackScene<R, Model>) {}
    /// The run of a lane has ended, early if no longer wanted.
    fn ended(&mut self, lane: Lane);
}

/// As many stacks as there are lanes.
pub(super) struct LaneGroup<R: Real, Model: ContactModel<R>> {
    stack: StackScene<R, Model>,
    lanes: Vec<Option<Lane>>,
}

impl<R: Real, Model: ContactModel<R>> LaneGroup<R, Model> {
    /// Lanes without runs; `stack` says what all their stacks have in common.
    pub(super) fn new(stack: StackScene<R, Model>) -> Self {
        Self {
            stack,
            lanes: vec![None; R::LANES],
        }
    }

    /// Fills the lanes again and again, until nothing is left or wanted.
    pub(super) fn run(&mut self, supervisor: &mut impl Supervisor<R, Model>) {
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

    /// Steps until something happens in some lane; `None` if all are empty.
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
        let scene = &mut self.stack;
        scene.time_step.vectorize(Stepping { scene, part });
    }

    /// One step in which something happens.
    fn eventful_step(&mut self, supervisor: &mut impl Supervisor<R, Model>) {
        for (index, lane) in eventful(&mut self.lanes) {
            let mut act = |action| self.stack.act(index, action);
            lane.program.actions_at(lane.step, &mut act);
        }
        self.carry_out(Part::Forces);
        for (index, lane) in eventful(&mut self.lanes) {
            if let Some(row) = lane.program.row_at(lane.step) {
                let time = row as f64 * lane.case.protocol.time_step;
                lane.take(self.stack.sample(index, row, time));
                supervisor.sampled(&self.stack);
            }
        }
        self.carry_out(Part::Motion);
        for index in 0..self.lanes.len() {
            self.step_on(index, supervisor);
        }
    }

    /// Counts the step, and takes the run out if it was its last.
    fn step_on(&mut self, index: usize, supervisor: &mut impl Supervisor<R, Model>) {
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

/// What is done in all lanes at once.
enum Part {
    /// The forces are evaluated.
    Forces,
    /// Velocities, positions and walls are moved by them.
    Motion,
    /// Both, so many times.
    Steps(u64),
}

struct Stepping<'a, R: Real, Model: ContactModel<R>> {
    scene: &'a mut StackScene<R, Model>,
    part: Part,
}

impl<R: Real, Model: ContactModel<R>> Work for Stepping<'_, R, Model> {
    #[inline(always)]
    fn carry_out(self) {
        match self.part {
            Part::Forces => self.scene.evaluate_forces(),
            Part::Motion => self.scene.advance(),
            Part::Steps(steps) => {
                for _ in 0..steps {
                    self.scene.step();
                }
            }
        }
    }
}

/// The lanes in which something happens now.
fn eventful(lanes: &mut [Option<Lane>]) -> impl Iterator<Item = (usize, &mut Lane)> {
    let lanes = lanes.iter_mut().enumerate();
    let lanes = lanes.filter_map(|(index, lane)| Some((index, lane.as_mut()?)));
    lanes.filter(|(_, lane)| lane.has_event())
}
