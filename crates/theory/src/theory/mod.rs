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
pub use small_displacement::{ElasticRoot, RigidYield, rigid_yield};
pub(crate) use small_displacement::{naive_load, perturbation_load};

use crate::model::{ContactConvention, Stack};

/// Returns the exact quasi-static limit of `stack` under `convention`. See [`LimitCurve`] for many stacks.
pub fn quasistatic_limit(stack: &Stack, convention: &ContactConvention) -> Limit {
    LimitCurve::new(stack, convention).limit(stack)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Arms;

    #[test]
    fn the_closed_form_is_taken_where_both_arms_are_0_and_only_there() {
        let stack = Stack::paper(0.3, 1e2);
        let closed = closed_form_limit(&stack);
        assert_eq!(
            quasistatic_limit(&stack, &ContactConvention::TURNING),
            closed
        );
        // The two agree to nine digits, but not to the last bit.
        assert_ne!(followed_limit(&stack, &ContactConvention::TURNING), closed);
        for arms in [Arms::reciprocal(-0.5, 0.0), Arms::reciprocal(0.0, -0.5)] {
            let convention = ContactConvention::with_arms(arms);
            let followed = followed_limit(&stack, &convention);
            assert_eq!(quasistatic_limit(&stack, &convention), followed);
        }
    }
}
