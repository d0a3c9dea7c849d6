//! The theories over everything the command line accepts: no panic, no number that is not one, and the
//! relations that must hold between them.

use proptest::prelude::*;
use tristack_theory::model::{Arms, ContactArms, ContactConvention, HistoryUpdate, Problem, Stack};
use tristack_theory::theory::{
    LoadingOutcome, Predictions, closed_form_limit, critical_push, elastic_root, floor_slip_force,
    followed_limit, pushed_slip_force, quasistatic_limit, rigid_yield,
};

/// Values spread evenly over the logarithm.
fn logarithmic(lowest: f64, highest: f64) -> impl Strategy<Value = f64> {
    (lowest.ln()..highest.ln()).prop_map(move |log| log.exp().clamp(lowest, highest))
}

prop_compose! {
    fn any_stack()(
        floor_friction in logarithmic(1e-3, 1e3),
        cylinder_friction in logarithmic(1e-3, 1e3),
        stiffness in logarithmic(1.0, 1e8),
        stiffness_ratio in logarithmic(1e-3, 1e6),
        bodies in 2u8..=5,
    ) -> Stack {
        Stack {
            cylinder_friction,
            stiffness_ratio,
            bodies,
            ..Stack::paper(floor_friction, stiffness)
        }
    }
}

prop_compose! {
    fn usual_stack()(
        floor_friction in 0.1..0.7,
        stiffness in logarithmic(10.0, 1e6),
        stiffness_ratio in 0.5..10.0,
        bodies in 2u8..=5,
    ) -> Stack {
        Stack { stiffness_ratio, bodies, ..Stack::paper(floor_friction, stiffness) }
    }
}

prop_compose! {
    fn any_arms()(arms in prop::array::uniform4(-100.0..100.0)) -> Arms {
        let [pair, floor] = [[arms[0], arms[1]], [arms[2], arms[3]]]
            .map(|[torque, kinematic]| ContactArms { torque, kinematic });
        Arms { pair, floor }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_force_is_a_number_or_has_a_reason(
        stack in any_stack(),
        arms in any_arms(),
    ) {
        let problem = Problem::new(stack, ContactConvention::with_arms(arms)).unwrap();
        let predictions = Predictions::new(&problem);
        let forces = [
            (predictions.naive.yield_force, predictions.naive.reason.is_some()),
            (predictions.perturbation.yield_force, predictions.perturbation.reason.is_some()),
            (predictions.elastic.yield_force, predictions.elastic.reason.is_some()),
            (predictions.quasistatic.yield_force, predictions.quasistatic.reason.is_some()),
        ];
        for (force, reason) in forces {
            prop_assert_eq!(force.is_none(), reason);
            prop_assert!(force.is_none_or(|force| force.is_finite() && force >= 0.0));
        }
    }

    #[test]
    fn follower_and_closed_form_are_the_same_for_arms_0(stack in usual_stack()) {
        let closed = closed_form_limit(&stack);
        let problem = Problem::new(stack, ContactConvention::TURNING).unwrap();
        let followed = followed_limit(&problem);
        prop_assert_eq!(closed.event, followed.event);
        match (closed.floor_slip_force, followed.floor_slip_force) {
            (Some(closed), Some(followed)) => {
                prop_assert!((closed - followed).abs() < 1e-9 * closed.abs().max(1e-3));
            }
            (closed, followed) => prop_assert_eq!(closed, followed),
        }
    }

    #[test]
    fn the_limit_satisfies_its_own_slip_condition(stack in usual_stack()) {
        let limit = closed_form_limit(&stack);
        let (Some(force), Some(tangent)) = (limit.floor_slip_force, limit.tangent) else {
            return Ok(());
        };
        // T (F + 1) = mu (F + n + 1): the horizontal force that the stack needs is all that the floor gives.
        let needed = tangent * (force + 1.0);
        let given = stack.floor_friction * (force + stack.own_weight());
        prop_assert!((needed - given).abs() < 1e-9 * given);
    }

    #[test]
    fn more_friction_needs_more_force(stack in usual_stack()) {
        let rougher = Stack { floor_friction: 1.01 * stack.floor_friction, ..stack };
        let forces = [stack, rougher].map(|stack| closed_form_limit(&stack).floor_slip_force);
        if let [Some(smooth), Some(rough)] = forces {
            let tangents = [stack, rougher].map(|stack| closed_form_limit(&stack).tangent);
            prop_assert!(tangents[1] > tangents[0]);
            // The force itself may fall again beyond T = 0.7, where the stack softens.
            prop_assert!(rough > smooth || tangents[0] > Some(0.7), "{smooth} {rough}");
        }
    }
}

/// What takes a stack alone, without a check, ends whatever its numbers are: two wrong values at once.
#[test]
fn formulas_of_a_stack_end_with_any_numbers() {
    const WRONG: [f64; 5] = [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e300];
    let values: [fn(&mut Stack) -> &mut f64; 4] = [
        |stack| &mut stack.floor_friction,
        |stack| &mut stack.cylinder_friction,
        |stack| &mut stack.stiffness,
        |stack| &mut stack.stiffness_ratio,
    ];
    for (index, first) in values.iter().enumerate() {
        for second in &values[index..] {
            for (one, other) in WRONG
                .iter()
                .flat_map(|one| WRONG.map(|other| (*one, other)))
            {
                let mut stack = Stack::paper(0.3, 1e3);
                *first(&mut stack) = one;
                *second(&mut stack) = other;
                rigid_yield(&stack);
                elastic_root(&stack);
                floor_slip_force(&stack);
                closed_form_limit(&stack);
                critical_push(&stack);
                for rule in [HistoryUpdate::Fixed, HistoryUpdate::Rotated] {
                    pushed_slip_force(&stack, 1e-3, rule);
                    LoadingOutcome::of(&stack, rule);
                }
            }
        }
    }
}

/// Theory takes stiffnesses beyond those of runs: below μ_c the force is the rigid one, to the order of ε, and above it
/// grows as 1/ε, under every convention.
#[test]
fn the_stiffest_stacks_have_the_rigid_limit_and_its_exponent() {
    let force = |friction, stiffness, convention| {
        let problem = Problem::new(Stack::paper(friction, stiffness), convention).unwrap();
        quasistatic_limit(&problem).yield_force.unwrap()
    };
    let rigid = rigid_yield(&Stack::paper(0.2, 1e4)).yield_force.unwrap();
    for convention in [
        ContactConvention::PAPER,
        ContactConvention::TURNING,
        ContactConvention::with_arms(Arms::reciprocal(-0.5, -1.0)),
    ] {
        // The rounding of an overlap ε beside coordinates of order 1 is 1e-16/ε of it.
        assert!((force(0.2, 1e12, convention) - rigid).abs() < 1e-4 * rigid);
        let slope = force(0.3, 1e12, convention) / force(0.3, 1e11, convention);
        assert!((slope - 10.0).abs() < 1e-3, "{slope}");
    }
}
