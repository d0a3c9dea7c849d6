//! Small cases and micro-tests, so that one execution takes microseconds.

use tristack::model::{
    Case, ContactConvention, ContactTest, InitialMotion, Preparation, Protocol, Sampling,
    Shortcuts, Stack,
};

/// 21 rows.
pub fn short_case() -> Case {
    Case {
        stack: Stack::paper(0.3, 100.0),
        convention: ContactConvention::TURNING,
        protocol: Protocol {
            preparation: Preparation::GravityRamp {
                ramp_time: 20.0,
                rest_time: 10.0,
            },
            time_step: 0.1,
            wall_speed: 1e-2,
            wall_travel: 0.6,
            sampling: Sampling {
                coarse_interval: 5.0,
                fine_from_travel: 0.4,
                fine_interval: 2.0,
            },
            shortcuts: None,
        },
    }
}

/// A case whose run ends when the force drops.
pub fn case_with_shortcuts() -> Case {
    let mut case = short_case();
    case.protocol.wall_speed = 5e-3;
    case.protocol.shortcuts = Some(Shortcuts {
        speed_factor: 2.0,
        fast_until_travel: 0.4,
        stop_at_drop: 0.02,
    });
    case
}

/// A cylinder that falls on the floor.
pub fn short_test() -> ContactTest {
    ContactTest {
        convention: ContactConvention::TURNING,
        stiffness_ratio: 2.5,
        floor_friction: 0.3,
        cylinder_friction: 0.7,
        time_step: 0.1,
        steps: 3,
        wall_height: 4.5,
        wall_speed: 0.0,
        initial_motions: [
            InitialMotion {
                vy: -0.01,
                spin: 0.001,
                ..InitialMotion::at(0.0, 0.99)
            },
            InitialMotion::at(6.0, 2.0),
        ],
        drive: None,
        space: None,
    }
}
