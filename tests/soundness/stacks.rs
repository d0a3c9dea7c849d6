//! Whatever numbers a stack and a protocol are made of: they are refused, or every theory and every plan
//! copes with them.

use super::Seed;
use tristack::code::{Code, Task};
use tristack::model::{Arms, Case, ContactArms, ContactConvention, Problem, Stack};
use tristack::study::yield_force::protocol_at_speed;
use tristack::theory::{Predictions, quasistatic_limit};

const NUMBERS: usize = 10;

/// Of the domain over which the theories are tested (crates/theory/tests/theory/domain.rs).
const SMALLEST_RATIO: f64 = 1e-3;

/// Ten numbers: friction, cylinder friction, stiffness, stiffness ratio, wall speed, time step, four arms.
pub fn check(data: &[u8]) {
    let mut numbers = [0.3, 0.7, 1e4, 2.5, 1e-5, 0.1, 0.0, 0.0, 0.0, 0.0];
    for (number, bytes) in numbers.iter_mut().zip(data.chunks_exact(size_of::<f64>())) {
        *number = f64::from_le_bytes(bytes.try_into().expect("eight bytes"));
    }
    let [
        floor_friction,
        cylinder_friction,
        stiffness,
        stiffness_ratio,
        speed,
        step,
        arms @ ..,
    ] = numbers;
    let [pair, floor] = [[arms[0], arms[1]], [arms[2], arms[3]]]
        .map(|[torque, kinematic]| ContactArms { torque, kinematic });
    let arms = Arms { pair, floor };
    let stack = Stack {
        cylinder_friction,
        stiffness_ratio,
        ..Stack::paper(floor_friction, stiffness)
    };
    let convention = ContactConvention::with_arms(arms);
    // Below, the equations of the path are stiff, and a path takes a tenth of a second, here much longer.
    if stiffness_ratio < SMALLEST_RATIO {
        return;
    }
    let Ok(problem) = Problem::new(stack, convention) else {
        return;
    };
    Predictions::new(&problem);
    let limit = quasistatic_limit(&problem);
    assert!(limit.yield_force.is_none_or(f64::is_finite));
    let Some(protocol) = protocol_at_speed(&limit, speed, step) else {
        return;
    };
    let case = Case {
        stack,
        convention,
        protocol,
    };
    if case.validate().is_ok() {
        assert!(
            case.parameters()
                .as_object()
                .is_some_and(|named| named.values().all(|one| one.is_number()))
        );
        assert_eq!(Code::native().deck_hash(&case).len(), 64);
    }
}

pub fn seeds() -> Vec<Seed> {
    let stacks: [[f64; NUMBERS]; 5] = [
        [0.3, 0.7, 1e4, 2.5, 1e-5, 0.1, 0.0, 0.0, 0.0, 0.0],
        [0.12, 0.7, 1e2, 2.5, 1e-3, 0.1, -0.5, 0.0, -0.5, -0.5],
        [0.5, 1.0, 1e8, 1.0, 1e-7, 0.01, -0.5, -0.5, -1.0, -1.0],
        [
            0.267_949_192_431_122_7,
            0.1,
            1.0,
            50.0,
            1e-2,
            0.2,
            0.0,
            0.0,
            0.0,
            0.0,
        ],
        [1e3, 1e3, 1e3, 1e6, 1e-4, 1e-6, 1.0, -1.0, 1.0, -1.0],
    ];
    let seed = |(index, stack): (usize, [f64; NUMBERS])| {
        let bytes = stack.iter().flat_map(|number| number.to_le_bytes());
        (format!("stack-{index}"), bytes.collect())
    };
    stacks.into_iter().enumerate().map(seed).collect()
}
