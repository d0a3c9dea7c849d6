//! The runs that measure the yield force after a preparation.

use crate::code::{Code, SettledCode};
use crate::model::{Case, Power, Preparation, Protocol, Sampling, SideWalls, Stack};
use crate::study::yield_force::{Measurement, SHORT_RAMP_RUN, plan};

/// Factor on the wall travel: a stack that starts with c > 0 yields later than after a gravity ramp.
const FURTHER: f64 = 1.3;
/// Factor on the travel from which rows are fine, to cover a yield that has moved.
const FINE_FROM: f64 = 0.5;
/// Factor on the time steps: withdrawn walls release stiff cylinders at once, and at a time step of 0.2 they slide
/// where they should not.
const FINER: f64 = 0.5;

/// Replaces the gravity ramp that `protocol` was planned for by a preparation between side walls, with a longer
/// travel and an earlier start of fine rows.
pub fn between_side_walls(protocol: &Protocol, walls: SideWalls) -> Protocol {
    Protocol {
        preparation: Preparation::SideWalls(walls),
        wall_travel: FURTHER * protocol.wall_travel,
        sampling: Sampling {
            fine_from_travel: FINE_FROM * protocol.sampling.fine_from_travel,
            ..protocol.sampling
        },
        ..*protocol
    }
}

/// The runs of one code for one stack and one preparation.
#[derive(Debug, Clone, PartialEq)]
pub struct PreparationPlan {
    /// The code.
    pub code: SettledCode,
    /// The code whose convention it has; if that is another code, it is a twin.
    pub convention_of: Code,
    /// A in r; `None` for the gravity ramp.
    pub push: Option<f64>,
    /// The measurement. Its limit is that of the gravity ramp; its cases are three wall speeds, then twice the
    /// time step, then half the rests, or half the gravity ramp: the order that
    /// [`crate::study::yield_force::extrapolate`] expects.
    pub measurement: Measurement,
}

impl PreparationPlan {
    /// The runs.
    pub fn cases(&self) -> &[Case] {
        &self.measurement.cases
    }
}

/// Plans the yield force of `stack` with `code`, under its own convention or, natively, as a twin of `convention_of`.
/// Side walls are pushed in by `push`; without one, gravity rises instead.
pub fn plan_preparation(
    code: &SettledCode,
    convention_of: &SettledCode,
    stack: &Stack,
    push: Option<f64>,
) -> PreparationPlan {
    let convention = convention_of.stack_convention(Power::Linear, stack.bodies);
    let mut measurement = plan(code, stack, convention);
    if let Some(push) = push {
        for (run, case) in measurement.cases.iter_mut().enumerate() {
            let mut walls = SideWalls::paper(push, stack.epsilon());
            if run == SHORT_RAMP_RUN {
                walls.settle_time *= 0.5;
                walls.rest_time *= 0.5;
            }
            case.protocol = between_side_walls(&case.protocol, walls);
            case.protocol.time_step *= FINER;
        }
    }
    PreparationPlan {
        code: code.clone(),
        convention_of: convention_of.name().clone(),
        push,
        measurement,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::ContactConvention;

    #[test]
    fn every_planned_case_is_valid() {
        for stiffness in [1e2, 1e4] {
            for push in [None, Some(0.0), Some(5.0 / stiffness)] {
                let stack = Stack::paper(0.3, stiffness);
                let yade = &SettledCode::named("yade");
                let plan = plan_preparation(yade, yade, &stack, push);
                assert_eq!(plan.cases().len(), SHORT_RAMP_RUN + 1);
                for case in plan.cases() {
                    assert_eq!(case.validate(), Ok(()));
                }
            }
        }
    }

    #[test]
    fn without_a_push_it_is_the_plan_of_the_crosscheck() {
        let stack = Stack::paper(0.3, 1e2);
        let native = &SettledCode::native();
        let own = plan_preparation(native, native, &stack, None);
        assert_eq!(
            own.measurement,
            plan(native, &stack, ContactConvention::PAPER)
        );
    }
}
