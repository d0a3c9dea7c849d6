//! The yield force without time stepping: the paper's theories, and the exact quasi-static limit.

mod arms;
mod closing;
mod curve;
mod cycle;
mod events;
mod floor_slip;
mod impact;
mod limit;
mod overlap;
mod path;
mod predictions;
mod quasistatic;
mod regimes;
mod root;
mod side_walls;
mod sliding;
mod small_displacement;

pub use arms::limit_uncertainty;
pub use curve::LimitCurve;
pub use cycle::{CycleOrder, cycle_work};
pub use events::Event;
pub use floor_slip::{floor_slip_force, floor_slip_forces};
pub use impact::{NormalImpact, SlidingChange, integrated_impact, normal_impact, sliding_change};
pub use impact::{damping_exponent, has_closed_form};
pub use limit::Limit;
pub use overlap::pair_overlap;
pub use path::{SpeedExcess, followed_limit};
pub use predictions::{MovingWall, Prediction, Predictions};
pub use quasistatic::closed_form_limit;
pub use regimes::{
    Across, Axis, Boundary, BoundaryPoint, CLOSING_STIFFNESS_RATIO, CriticalState, EquilibriumPath,
    FailureMode, Line, LoadingOutcome, LoadingPhase, Regime, RegimeMap, released_frictions,
};
pub use root::bracketed_root;
pub use side_walls::{critical_push, pushed_slip_force};
pub use small_displacement::elastic_root;
pub use small_displacement::{ElasticRoot, RigidYield, rigid_force, rigid_limit, rigid_yield};
pub(crate) use small_displacement::{naive_load, perturbation_load};

use crate::model::Problem;

/// Returns the exact quasi-static limit of `problem`. See [`LimitCurve`] for many stacks.
pub fn quasistatic_limit(problem: &Problem) -> Limit {
    LimitCurve::new(problem).limit(problem)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Arms, ContactConvention, Stack};

    #[test]
    fn the_closed_form_is_taken_where_both_arms_are_0_and_only_there() {
        let stack = Stack::paper(0.3, 1e2);
        let closed = closed_form_limit(&stack);
        let turning = Problem::new(stack, ContactConvention::TURNING).unwrap();
        assert_eq!(quasistatic_limit(&turning), closed);
        // The two agree to nine digits, but not to the last bit.
        assert_ne!(followed_limit(&turning), closed);
        for arms in [Arms::reciprocal(-0.5, 0.0), Arms::reciprocal(0.0, -0.5)] {
            let problem = Problem::new(stack, ContactConvention::with_arms(arms)).unwrap();
            assert_eq!(quasistatic_limit(&problem), followed_limit(&problem));
        }
    }
}
