//! The yield force without time stepping: the paper's theories, and the exact quasi-static limit.

mod events;
mod floor_slip;
mod limit;
mod overlap;
mod path;
mod predictions;
mod quasistatic;
mod regimes;
mod root;
mod side_walls;
mod small_displacement;

pub use events::Event;
pub use floor_slip::{floor_slip_force, floor_slip_forces};
pub use limit::Limit;
pub use overlap::pair_overlap;
pub use path::followed_limit;
pub use predictions::{Prediction, Predictions};
pub use quasistatic::closed_form_limit;
pub use regimes::{
    Across, Axis, Boundary, BoundaryPoint, CLOSING_STIFFNESS_RATIO, CriticalState, EquilibriumPath,
    FailureMode, Line, LoadingOutcome, LoadingPhase, Regime, RegimeMap, released_frictions,
};
pub use root::bracketed_root;
pub use side_walls::{critical_push, pushed_slip_force};
pub(crate) use small_displacement::{ElasticRoot, elastic_root, naive_load, perturbation_load};
pub use small_displacement::{RigidYield, rigid_yield};

use crate::model::{Arms, Stack};

/// The exact quasi-static limit of `stack` for the given arms: the closed form where all are 0,
/// the path follower otherwise.
pub fn quasistatic_limit(stack: &Stack, arms: &Arms) -> Limit {
    if *arms == Arms::PAPER {
        closed_form_limit(stack)
    } else {
        followed_limit(stack, arms)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_closed_form_is_taken_where_both_arms_are_0_and_only_there() {
        let stack = Stack::paper(0.3, 1e2);
        let limit = |arms| quasistatic_limit(&stack, &arms);
        assert_eq!(limit(Arms::PAPER), closed_form_limit(&stack));
        // The two agree to nine digits, not to the last.
        assert_ne!(limit(Arms::PAPER), followed_limit(&stack, &Arms::PAPER));
        for arms in [Arms::reciprocal(-0.5, 0.0), Arms::reciprocal(0.0, -0.5)] {
            assert_eq!(limit(arms), followed_limit(&stack, &arms));
        }
    }
}
