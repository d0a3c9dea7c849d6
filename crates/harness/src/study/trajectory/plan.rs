//! The runs of a comparison: a code at three time steps, and each of its twins at the same steps with two further
//! runs.

use crate::code::SettledCode;
use crate::model::{
    Case, ContactConvention, HistoryUpdate, PAPER_BODIES, Power, Preparation, Problem, Protocol,
    Sampling, Stack,
};
use crate::study::yield_force::{REST_TIME, ramp_time};
use crate::theory::{Limit, quasistatic_limit};
use serde::{Deserialize, Serialize};

/// Wall speed in r √(k_n/m): fast enough for inertia and damping to show, slow enough for a yield.
pub const WALL_SPEED: f64 = 1e-3;

/// Time steps, each half the one before. The finest is the largest power of two times 0.1 at which the effect of the
/// first touch of a YADE wall (see [`super::documented`]) is below 1e-6 of the peak.
const TIME_STEPS: [f64; 3] = [0.025, 0.0125, 0.00625];

/// The time steps for `stack`. For spheres, whose peak is lower, they are half as long for the same reason.
pub fn time_steps(stack: &Stack) -> [f64; 3] {
    match stack.bodies {
        PAPER_BODIES => TIME_STEPS,
        _ => TIME_STEPS.map(|time_step| 0.5 * time_step),
    }
}

/// Relative change of the wall speed by which the growth of a small disturbance is measured: small enough
/// to stay linear, and some hundred times the effect of rounding.
pub(super) const DISTURBANCE: f64 = 1e-9;

/// Time between rows, a multiple of every time step; 370 to 700 rows a run.
const INTERVAL: f64 = 2.0;
/// Time for which the wall moves on beyond the quasi-static yield: the force peaks some 10 later, the wall loses
/// cylinder 1 another 22 later, and cylinder 1 lands another 10 later.
const TIME_BEYOND_YIELD: f64 = 60.0;

/// Displacement of one sphere of a ring, so that no symmetry is left.
const DISPLACEMENT: f64 = 1e-3;

/// The stack whose trajectories are compared, with this many bodies on the floor and contacts of this power. Its
/// friction is above the critical one, where torque arms matter most, and it is soft enough for positions and angles
/// to move far. Its stiffness ratio is that of the law, because a code may accept no other.
pub fn trajectory_stack(bodies: u8, power: Power) -> Stack {
    let mut stack = Stack {
        bodies,
        stiffness_ratio: Stack::usual_stiffness_ratio(power),
        ..Stack::paper(0.3, 100.0)
    };
    if bodies != PAPER_BODIES {
        stack.arrangement.displacement = DISPLACEMENT;
    }
    stack
}

/// The part of the code's convention that a twin has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Twin {
    /// All of it.
    Full,
    /// All but the transport of the tangential spring: that of this twin turns with the contact. The distance to this
    /// twin is of first order in the time step, and large enough for the order to be seen.
    RotatedSpring,
}

impl Twin {
    /// The word in tables.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::RotatedSpring => "rotated-spring",
        }
    }
}

/// The runs of a native twin.
#[derive(Debug, Clone, PartialEq)]
pub struct TwinRuns {
    /// The part of the code's convention that it has.
    pub twin: Twin,
    /// One case per time step of the code, in the same order.
    pub cases: Vec<Case>,
    /// The finest of them with its time step halved, which shows the error of the time step.
    pub halved: Case,
    /// The coarsest of them with a slightly faster wall, which shows how rounding grows.
    pub disturbed: Case,
}

impl TwinRuns {
    /// Every case, those of the time steps first.
    pub fn all(&self) -> impl Iterator<Item = &Case> {
        self.cases.iter().chain([&self.halved, &self.disturbed])
    }
}

/// The planned comparison of a code with its twins.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    /// The code.
    pub code: SettledCode,
    /// The stack.
    pub stack: Stack,
    /// Its runs, one per time step.
    pub cases: Vec<Case>,
    /// Its twins.
    pub twins: Vec<TwinRuns>,
}

/// Plans the trajectories of `stack` by `code` and by native twins that adopt the convention `declared` for it.
/// Nothing is planned if the stack does not yield.
pub fn plan_trajectory(
    code: &SettledCode,
    stack: &Stack,
    declared: ContactConvention,
) -> Trajectory {
    let protocols = protocols(stack, &code.convention());
    let with = |convention: ContactConvention| {
        let convention = convention.of_bodies(stack);
        let cases = protocols.iter().map(|&protocol| Case {
            stack: *stack,
            convention,
            protocol,
        });
        cases.collect::<Vec<Case>>()
    };
    let rotated = ContactConvention {
        history_update: HistoryUpdate::Rotated,
        ..declared
    };
    let mut twins = vec![(Twin::Full, declared)];
    // No time step makes the difference small between a spring that turns with its contact and one that does not,
    // nor, in space, the difference from a spring turned by vector products, which also follows a common spin.
    let approaches_it = declared.history_update.turns() && stack.bodies == PAPER_BODIES;
    if declared != rotated && approaches_it {
        twins.push((Twin::RotatedSpring, rotated));
    }
    let twins = twins
        .into_iter()
        .filter_map(|(twin, convention)| twin_runs(twin, with(convention)));
    Trajectory {
        code: code.clone(),
        stack: *stack,
        cases: with(code.convention()),
        twins: twins.collect(),
    }
}

fn twin_runs(twin: Twin, cases: Vec<Case>) -> Option<TwinRuns> {
    let mut halved = *cases.last()?;
    halved.protocol.time_step *= 0.5;
    let mut disturbed = *cases.first()?;
    disturbed.protocol.wall_speed *= 1.0 + DISTURBANCE;
    Some(TwinRuns {
        twin,
        cases,
        halved,
        disturbed,
    })
}

/// One protocol per time step; none where nothing yields.
fn protocols(stack: &Stack, convention: &ContactConvention) -> Vec<Protocol> {
    let Ok(problem) = Problem::new(*stack, *convention) else {
        return Vec::new();
    };
    let limit = quasistatic_limit(&problem);
    let Some(travel) = limit.yield_force.and(limit.peak_travel) else {
        return Vec::new();
    };
    // Whole rows: a plan must not see the last digits of the limit, which may differ between machines.
    let rows = ((travel / WALL_SPEED + TIME_BEYOND_YIELD) / INTERVAL).ceil();
    let preparation = preparation(&limit);
    let protocol = |time_step| Protocol {
        preparation,
        time_step,
        wall_speed: WALL_SPEED,
        wall_travel: (rows * INTERVAL).round() / (1.0 / WALL_SPEED).round(),
        sampling: Sampling {
            coarse_interval: INTERVAL,
            fine_from_travel: 0.0,
            fine_interval: INTERVAL,
        },
        shortcuts: None,
    };
    time_steps(stack).map(protocol).to_vec()
}

/// Ramp and rest of a yield force that is measured at this wall speed, as long as the law needs them: Hertz contacts
/// still move at the end of the ramp of linear springs. Both last a whole number of row intervals, so that they are
/// equally long at every time step.
fn preparation(limit: &Limit) -> Preparation {
    let whole_rows = |time: f64| (time / INTERVAL).ceil() * INTERVAL;
    Preparation::GravityRamp {
        ramp_time: whole_rows(ramp_time(limit, WALL_SPEED)),
        rest_time: whole_rows(REST_TIME * limit.time_scale),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::code::Code;

    fn planned(code: &SettledCode) -> Trajectory {
        let convention = code.convention();
        let stack = trajectory_stack(2, convention.law.power);
        plan_trajectory(code, &stack, convention)
    }

    #[test]
    fn every_planned_case_is_valid_and_has_rows_at_the_same_times() {
        for code in Code::built_in()
            .into_iter()
            .filter_map(|code| code.as_declared())
        {
            let plan = planned(&code);
            let all = plan.twins.iter().flat_map(TwinRuns::all);
            let code = code.name();
            assert!(!plan.cases.is_empty(), "{code}");
            code.check_stiffness_ratio(plan.stack.stiffness_ratio)
                .unwrap();
            for case in plan.cases.iter().chain(all) {
                case.validate().unwrap();
                let schedule = case.protocol.schedule();
                let interval = schedule.fine_every as f64 * case.protocol.time_step;
                assert!((interval - INTERVAL).abs() < 1e-12);
                assert_eq!(schedule.rows(), plan.cases[0].protocol.schedule().rows());
                assert!(schedule.rows() < 1000);
            }
        }
    }

    #[test]
    fn hertz_contacts_are_loaded_as_slowly_as_for_a_yield_force() {
        for code in Code::built_in()
            .into_iter()
            .filter_map(|code| code.as_declared())
        {
            let case = planned(&code).cases[0];
            let code = code.name();
            let Preparation::GravityRamp {
                ramp_time,
                rest_time,
            } = case.protocol.preparation
            else {
                panic!("{code}");
            };
            if case.convention.law.power == Power::Linear {
                // The recorded series depend on these values.
                assert_eq!([ramp_time, rest_time], [100.0, 100.0], "{code}");
                continue;
            }
            let limit = quasistatic_limit(&case.problem().unwrap());
            assert!(limit.time_scale > 1.5, "{code}");
            assert!(ramp_time >= 1000.0 * limit.time_scale, "{code}");
            assert!(rest_time >= 100.0 * limit.time_scale, "{code}");
        }
    }

    #[test]
    fn a_code_that_turns_its_springs_has_one_twin() {
        assert_eq!(planned(&SettledCode::native()).twins.len(), 1);
        let twins = planned(&SettledCode::named("liggghts")).twins;
        assert_eq!(
            [twins[0].twin, twins[1].twin],
            [Twin::Full, Twin::RotatedSpring]
        );
        assert_eq!(
            twins[0].cases,
            planned(&SettledCode::named("liggghts")).cases
        );
    }

    #[test]
    fn nothing_is_planned_where_nothing_yields() {
        let plan = plan_trajectory(
            &SettledCode::native(),
            &Stack::paper(0.05, 100.0),
            ContactConvention::TURNING,
        );
        assert!(plan.cases.is_empty() && plan.twins.is_empty());
    }
}
