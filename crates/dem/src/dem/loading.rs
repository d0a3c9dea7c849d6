//! The actions on a stack during preparation and compression, and the steps at which they occur.

use crate::model::{Case, PreparationSteps, Protocol, Schedule, SideWallSteps, smooth_step};
use crate::series::DropWatch;

/// An action that precedes the evaluation of the forces in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Action {
    /// Set gravity.
    SetGravity(f64),
    /// Move the side walls inwards at this speed.
    MoveSideWalls(f64),
    /// Remove the side walls.
    RemoveSideWalls,
    /// Put the top cylinder at x = 0.
    PlaceTop {
        /// Height of its centre.
        height: f64,
        /// Its velocity, upwards.
        velocity: f64,
    },
    /// Put the top wall onto the top cylinder, and move it at this speed.
    StartTopWall(f64),
    /// Change the speed of the top wall.
    MoveTopWall(f64),
}

/// The program of preparation and compression of one case.
#[derive(Debug, Clone, Copy)]
pub(super) struct LoadingProgram {
    schedule: Schedule,
    gravity: f64,
    protocol: Protocol,
}

impl LoadingProgram {
    /// The program of `case`.
    pub(super) fn new(case: &Case) -> Self {
        Self {
            schedule: case.protocol.schedule(),
            gravity: case.stack.epsilon(),
            protocol: case.protocol,
        }
    }

    /// Number of steps before the compression.
    fn preparation(&self) -> u64 {
        self.schedule.preparation.total()
    }

    /// Returns the step of the compression at `step` if a row is taken there.
    pub(super) fn row_at(&self, step: u64) -> Option<u64> {
        let step = step.checked_sub(self.preparation())?;
        (self.schedule.row_from(step) == Some(step)).then_some(step)
    }

    /// The watch on a drop of the wall force that ends the run, and the step of the compression from which rows count.
    pub(super) fn drop_watch(&self) -> (DropWatch, u64) {
        let watch = DropWatch::new(self.schedule.stop_at_drop);
        (watch, self.schedule.fine_from_step)
    }

    /// Returns the first step at or after `step` with an action or a row; `None` after the last row.
    pub(super) fn event_from(&self, step: u64) -> Option<u64> {
        let compression = self.preparation();
        if step >= compression {
            let done = step - compression;
            let row = self.schedule.row_from(done)?;
            let slower = self.slower_from(done);
            return Some(compression + slower.map_or(row, |slower| row.min(slower)));
        }
        let next = match &self.schedule.preparation {
            PreparationSteps::GravityRamp { ramp, .. } => Some(step).filter(|step| step <= ramp),
            PreparationSteps::SideWalls(walls) => SideWallPhases::of(walls).event_from(step),
            PreparationSteps::Rigid => None,
        };
        Some(next.unwrap_or(compression))
    }

    /// Returns the first step of the compression at or after `step` at which the wall slows down.
    fn slower_from(&self, step: u64) -> Option<u64> {
        let (start, steps) = (self.schedule.fast_steps, self.schedule.slowing_steps);
        Some(step.max(start)).filter(|&next| steps > 0 && next <= start + steps)
    }

    /// Calls `act` for every action at `step`, in order.
    pub(super) fn actions_at(&self, step: u64, act: &mut impl FnMut(Action)) {
        let compression = self.preparation();
        if step == compression {
            act(Action::SetGravity(self.gravity));
            act(Action::StartTopWall(self.protocol.fast_speed()));
        }
        if step >= compression {
            let done = step - compression;
            if self.slower_from(done) == Some(done) {
                act(Action::MoveTopWall(
                    self.protocol.speed_at(&self.schedule, done),
                ));
            }
            return;
        }
        match &self.schedule.preparation {
            PreparationSteps::GravityRamp { ramp, .. } => {
                if step <= *ramp {
                    act(Action::SetGravity(self.gravity * smooth_step(step, *ramp)));
                }
            }
            PreparationSteps::SideWalls(walls) => {
                SideWallPhases::of(walls).actions_at(step, self.gravity, act);
            }
            PreparationSteps::Rigid => {}
        }
    }
}

/// First steps of the phases of the preparation between side walls (see [`crate::model::SideWalls`]).
struct SideWallPhases<'a> {
    steps: &'a SideWallSteps,
    hold: u64,
    fall: u64,
    settle: u64,
    withdrawal: u64,
    rest: u64,
}

impl<'a> SideWallPhases<'a> {
    fn of(steps: &'a SideWallSteps) -> Self {
        let hold = steps.push_steps;
        let fall = hold + steps.hold_steps;
        let settle = fall + steps.fall_steps;
        let withdrawal = settle + steps.settle_steps;
        Self {
            steps,
            hold,
            fall,
            settle,
            withdrawal,
            rest: withdrawal + steps.withdrawal_steps,
        }
    }

    /// Returns the next step with an action; until its release, the top cylinder is held at every step.
    fn event_from(&self, step: u64) -> Option<u64> {
        if step <= self.settle {
            return Some(step);
        }
        [self.withdrawal, self.rest]
            .into_iter()
            .find(|&start| start >= step)
    }

    fn actions_at(&self, step: u64, gravity: f64, act: &mut impl FnMut(Action)) {
        let walls = &self.steps.walls;
        if step == 0 {
            act(Action::MoveSideWalls(self.steps.push_speed));
        }
        if step == self.hold {
            act(Action::MoveSideWalls(0.0));
        }
        if step < self.settle {
            let height = self.held_height(step, gravity);
            act(Action::PlaceTop {
                height,
                velocity: 0.0,
            });
        }
        if step == self.settle {
            act(Action::PlaceTop {
                height: self.steps.landing_height(gravity),
                velocity: -walls.landing_speed,
            });
        }
        if step == self.withdrawal {
            act(Action::MoveSideWalls(-walls.withdrawal_speed));
        }
        if step == self.rest {
            act(Action::RemoveSideWalls);
        }
    }

    fn held_height(&self, step: u64, gravity: f64) -> f64 {
        let steps = self.steps;
        let start = steps.landing_height(gravity) + steps.fall;
        let fallen = step.saturating_sub(self.fall);
        start - steps.fall * (fallen as f64 / steps.fall_steps as f64)
    }
}
