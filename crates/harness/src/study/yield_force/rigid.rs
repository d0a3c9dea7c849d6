//! The yield force of rigid bodies: the wall force with which a stack gives way, at vanishing wall travel and time step.
//!
//! Where rigid bodies slide, their force is known at every place, not at the beginning alone. So the runs are not extrapolated
//! along the path: what they are above the exact force is, over a way that is much shorter than a radius.

use super::budget::Budget;
use super::extrapolate::{ConvergenceOrder, Extrapolation};
use super::judgement::{Reader, TWO_GRIDS};
use super::plan::Measurement;
use super::runs::{Method, RunRoles};
use crate::code::SettledCode;
use crate::model::{Case, ContactConvention, Preparation, Protocol, Sampling, Stack};
use crate::series::RigidReading;
use crate::study::{Ground, MAX_TOLERANCE, MIN_TOLERANCE};
use crate::theory::rigid_limit;

/// Stiffness of the stacks in tasks: with it, forces are in m g, times in √(r/g), and gravity is 1.
const UNIT: f64 = 1.0;
/// Wall speed in √(g r): inertia adds some 10⁻¹⁰ to the force.
const WALL_SPEED: f64 = 1e-5;
/// Time step in √(r/g). A force that belongs to the places of one end of a step is off by what the wall's way in it changes.
const TIME_STEP: f64 = 1e-3;
/// Steps of the slowest run; the wall moves by 10⁻⁵ r.
const STEPS: f64 = 1000.0;

/// Position of the run that is judged, with the slowest wall and the shortest step.
const JUDGED: usize = 0;
/// Position of the run with twice the wall speed.
const FAST: usize = 1;
/// Position of the run with twice the time step.
const COARSE: usize = 2;

/// Part of the way that cylinders 2 and 3 must go with the wall from which on they have given way.
const GAVE_WAY: f64 = 0.5;
/// The same from which on they go faster than the wall: nothing holds them.
pub(crate) const FELL: f64 = 2.0;
/// The same up to which they have not: of a problem without a solution, iterative solvers leave some percent.
pub(crate) const STOOD: f64 = 0.05;
/// Wall force in m g that shows a jam. With a floor friction of 0.005 below the critical one bodies give way under it.
pub(crate) const JAMMED: f64 = 100.0;
/// Part of its rotation by which a cylinder may turn more or less than one that rolls.
pub(crate) const ROLLS: f64 = 0.01;

/// The run of a rigid `stack` that is judged.
pub(crate) fn rigid_case(stack: &Stack) -> Case {
    Case {
        stack: Stack {
            stiffness: UNIT,
            ..*stack
        },
        convention: ContactConvention::default(),
        protocol: protocol(WALL_SPEED, TIME_STEP),
    }
}

fn protocol(wall_speed: f64, time_step: f64) -> Protocol {
    Protocol {
        preparation: Preparation::Rigid,
        time_step,
        wall_speed,
        wall_travel: STEPS * WALL_SPEED * TIME_STEP,
        sampling: Sampling {
            coarse_interval: time_step,
            fine_from_travel: 0.0,
            fine_interval: time_step,
        },
        shortcuts: None,
    }
}

/// Plans the measurement of `stack`, whose stiffness does not matter, with `code`, whose bodies are rigid.
pub(super) fn plan_rigid(code: &SettledCode, stack: &Stack) -> Measurement {
    let stack = Stack {
        stiffness: UNIT,
        ..*stack
    };
    let limit = rigid_limit(&stack);
    let jams = stack.floor_friction >= stack.ring().critical_friction;
    let stands = stack.cylinder_friction > stack.ring().critical_friction;
    let runs = limit.yield_force.is_some() || jams && stands;
    let protocols = [
        protocol(WALL_SPEED, TIME_STEP),
        protocol(2.0 * WALL_SPEED, TIME_STEP),
        protocol(WALL_SPEED, 2.0 * TIME_STEP),
    ];
    let cases = protocols.into_iter().filter(|_| runs).map(|protocol| Case {
        protocol,
        ..rigid_case(&stack)
    });
    Measurement {
        code: code.clone(),
        stack: Stack {
            stiffness: f64::INFINITY,
            ..stack
        },
        convention: code.convention(),
        limit,
        model_form: None,
        convention_uncertainty: None,
        speed_excess: None,
        method: Method::Rigid,
        is_gentle: true,
        cases: cases.collect(),
        roles: RunRoles {
            coarse_time_step: Some(COARSE),
            short_ramp: None,
            ..RunRoles::PLANNED
        },
        resolution: MAX_TOLERANCE,
    }
}

impl Reader<'_> {
    /// Judges whether the bodies give way, and under which force.
    pub(super) fn judge_rigid(&mut self) {
        let runs = &self.finding.runs;
        if let Some(run) = runs.iter().find(|run| !run.absent.is_empty()) {
            self.grounds.doubt_what_is_not_tested(&run.absent);
        }
        let readings: Option<Vec<RigidReading>> = runs.iter().map(|run| run.rigid).collect();
        let slid = readings.as_ref().and_then(|readings| {
            let slid: Option<Vec<f64>> = readings.iter().map(|reading| reading.slid).collect();
            slid
        });
        let (Some(readings), Some(slid)) = (readings, slid) else {
            return self.grounds.add(Ground::Undecidable(
                "the places of cylinders 2 and 3 are not reported, so that nothing shows whether they give way".to_owned(),
            ));
        };
        let last = self.finding.runs.iter().map(|run| run.last_force);
        let last = last.fold(f64::INFINITY, f64::min);
        let stands = slid.iter().all(|slid| slid.abs() < STOOD);
        let gives_way = slid.iter().all(|slid| *slid > GAVE_WAY);
        match self.measurement.limit.yield_force {
            None if stands && last >= JAMMED => {
                let reason = self.measurement.limit.reason.clone();
                self.grounds.add(Ground::NoYield(reason));
            }
            None if gives_way => self.grounds.add(Ground::Violation(format!(
                "it gives way, with a wall force of {last:.6} at the end, and rigid bodies jam with the floor friction {}",
                self.measurement.stack.floor_friction
            ))),
            None => self.grounds.add(Ground::Undecidable(format!(
                "rigid bodies jam here: cylinders 2 and 3 stand (they have gone {:.1} % of the way of the wall), but the wall \
                 force ends at {last:.6}, where a jam shows from {JAMMED} on",
                100.0 * slid.iter().copied().fold(0.0, f64::max)
            ))),
            Some(_) if slid.iter().all(|slid| *slid > FELL) => {
                let least = slid.iter().copied().fold(f64::INFINITY, f64::min);
                self.grounds.add(Ground::Violation(format!(
                    "it falls under its own weight, which it must bear: cylinders 2 and 3 go {least:.1} times as far as the wall \
                     makes them go"
                )));
            }
            Some(_) if !gives_way => self.grounds.add(Ground::NoYield(Some(format!(
                "it does not give way: cylinders 2 and 3 go {:.1} % of the way that the wall makes them go, and the wall force \
                 ends at {last:.6}",
                100.0 * slid.iter().copied().fold(f64::INFINITY, f64::min)
            )))),
            Some(reference) => self.compare_rigid(&readings, reference),
        }
    }

    /// Compares the force with which the bodies give way with the `reference`.
    fn compare_rigid(&mut self, readings: &[RigidReading], reference: f64) {
        let excess: Option<Vec<f64>> = readings.iter().map(|reading| reading.excess).collect();
        let Some(excess) = excess else {
            return self.grounds.add(Ground::Undecidable(
                "the wall has moved so far that no exact force is known".to_owned(),
            ));
        };
        self.hold_to_balances(readings, reference);
        let judged = readings[JUDGED];
        let force = reference + excess[JUDGED];
        let printed = self
            .finding
            .runs
            .iter()
            .filter_map(|run| run.estimates.printed);
        let budget = Budget {
            wall_speed: TWO_GRIDS * (excess[FAST] - excess[JUDGED]).abs(),
            time_step: Some(TWO_GRIDS * (excess[COARSE] - excess[JUDGED]).abs()),
            preparation: Some(0.0),
            sampling: judged.scatter,
            round_off: 0.0,
            print_precision: printed.map(|printed| printed.half_unit).fold(0.0, f64::max),
            shortcuts: 0.0,
            convention: None,
        };
        self.finding.slip = Some(Extrapolation {
            force,
            first_order: force,
            budget,
            order: ConvergenceOrder::NOT_OBSERVED,
        });
        self.compare(force, budget.total(), reference);
    }

    /// Adds what the forces and rotations show beside the force of the wall, in the mean over the rows.
    fn hold_to_balances(&mut self, readings: &[RigidReading], reference: f64) {
        let load = self.measurement.stack.floor_load(reference);
        let allowed = self.measurement.resolution;
        let asked = self.measurement.stack.floor_friction;
        for (number, reading) in (1..).zip(readings) {
            for (size, what) in [
                (reading.unbalanced, "floor and wall are out of balance"),
                (
                    reading.asymmetry,
                    "the normal forces of the floor on cylinders 2 and 3 differ",
                ),
            ] {
                if size.abs() > allowed * load {
                    self.grounds.add(Ground::Violation(format!(
                        "run {number}: {what} by {size:.1e} m g, in the mean over its rows; {:.1e} is allowed",
                        allowed * load
                    )));
                }
            }
            if let Some(turned) = reading.turned.filter(|turned| (turned - 1.0).abs() > ROLLS) {
                self.grounds.add(Ground::Violation(format!(
                    "run {number}: the cylinders at the floor do not roll on the upper one: they turn by {turned:.4} times as much"
                )));
            }
            let off = (reading.friction / asked - 1.0).abs();
            if off > allowed.max(MIN_TOLERANCE) {
                self.doubt(format!(
                    "run {number}: the floor slides at |t|/n = {:.9}, not at mu = {asked}",
                    reading.friction
                ));
            }
        }
    }
}
