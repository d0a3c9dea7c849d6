//! The native DEM as physics: what a contact must do, for any number of cylinders, and the same bits
//! everywhere.

use crate::at_rest::{onset_and_peak, three_speeds};
use tristack::code::SettledCode;
use tristack::dem::{Cylinder, Facing, PlaneWall, Scene, SpringDashpot, compress_stack};
use tristack::model::{
    Arms, ContactArms, ContactConvention, Law, PAPER_RESTITUTION, Power, Problem, Stack, sha256_hex,
};
use tristack::study::yield_force::{Measurement, plan};
use tristack::theory::LimitCurve;

fn law() -> SpringDashpot<f64> {
    SpringDashpot::like(0.0, &ContactConvention::TURNING, 2.5)
}

fn floor(friction: f64) -> PlaneWall {
    PlaneWall {
        facing: Facing::Up,
        offset: 0.0,
        speed: 0.0,
        friction,
    }
}

fn advance<const N: usize, const W: usize>(scene: &mut Scene<N, W>, steps: usize) {
    for _ in 0..steps {
        scene.evaluate_forces();
        scene.advance();
    }
}

#[test]
fn a_cylinder_bounces_off_a_wall_with_the_restitution_of_the_paper() {
    let restitution = |time_step: f64| {
        let mut ball = Cylinder::at(0.0, 1.0);
        ball.velocity = [0.0, -1e-3];
        let mut scene = Scene::new([ball], [floor(0.5)], law(), time_step);
        advance(&mut scene, (10.0 / time_step) as usize);
        scene.cylinders[0].velocity[1] / 1e-3
    };
    let (coarse, fine) = (restitution(1e-3), restitution(5e-4));
    assert!((fine - PAPER_RESTITUTION).abs() < 1e-3, "{fine}");
    assert!((fine - PAPER_RESTITUTION).abs() < 0.7 * (coarse - PAPER_RESTITUTION).abs());
}

#[test]
fn a_collision_of_two_conserves_momentum() {
    let (mut left, mut right) = (Cylinder::at(0.0, 0.0), Cylinder::at(1.99, 0.3));
    left.velocity = [0.02, 0.01];
    right.velocity = [-0.01, 0.0];
    left.spin = 0.02;
    let mut scene = Scene::new([left, right], [], law(), 0.01);
    scene.cylinder_friction = 0.7;
    advance(&mut scene, 2000);
    for axis in 0..2 {
        let total: f64 = scene.cylinders.iter().map(|body| body.velocity[axis]).sum();
        assert!((total - [0.01, 0.01][axis]).abs() < 1e-16);
    }
    assert_ne!(scene.cylinders[1].spin, 0.0, "friction turns the other one");
}

#[test]
fn a_cylinder_that_slides_ends_up_rolling() {
    let mut body = Cylinder::at(0.0, 1.0 - 1e-3);
    body.velocity = [0.1, 0.0];
    let mut scene = Scene::new([body], [floor(0.5)], law(), 0.05);
    scene.gravity = 1e-3;
    advance(&mut scene, 100_000);
    let body = &scene.cylinders[0];
    // Angular momentum about the line of contact is conserved: v falls to 2/3.
    assert!(
        (body.velocity[0] - 0.1 * 2.0 / 3.0).abs() < 1e-4,
        "{}",
        body.velocity[0]
    );
    assert!(
        (body.velocity[0] + body.spin).abs() < 1e-6,
        "v = -r omega when rolling to the right"
    );
}

#[test]
fn a_pyramid_of_ten_between_walls_rests_on_the_floor_with_its_whole_weight() {
    let mut cylinders = Vec::new();
    for row in 0..4 {
        for column in 0..4 - row {
            let x = f64::from(2 * column + row);
            cylinders.push(Cylinder::at(x, 1.0 + f64::from(row) * 3f64.sqrt()));
        }
    }
    let cylinders: [Cylinder; 10] = cylinders.try_into().expect("ten");
    let side_wall = |facing, offset| PlaneWall {
        facing,
        offset,
        ..floor(0.0)
    };
    let walls = [
        floor(0.7),
        side_wall(Facing::Right, -1.0),
        side_wall(Facing::Left, -7.0),
    ];
    let mut scene = Scene::new(cylinders, walls, law(), 0.1);
    scene.cylinder_friction = 0.7;
    scene.gravity = 1e-4;
    advance(&mut scene, 200_000);
    let weight: f64 = (0..10).map(|body| scene.wall_force(0, body).normal).sum();
    assert!((weight - 10.0 * 1e-4).abs() < 1e-9, "{weight:e}");
    let fastest = scene
        .cylinders
        .iter()
        .map(|body| body.velocity[0].abs())
        .fold(0.0, f64::max);
    assert!(fastest < 1e-9, "{fastest:e}");
}

#[test]
fn preparation_ends_without_contact_between_the_bottom_cylinders_and_without_sliding() {
    for stack in [Stack::paper(0.12, 1e2), Stack::paper(0.3, 1e4)] {
        let case = plan(&SettledCode::native(), &stack, ContactConvention::TURNING).cases[1];
        let series = compress_stack(&case, || true).expect("a finite series");
        let start = series.samples()[0];
        assert!(start.bodies[1].position[0] - start.bodies[2].position[0] > 2.0);
        let weight = 3.0 * stack.epsilon();
        assert!((start.floor[1][1] + start.floor[2][1] - weight).abs() < 1e-6 * weight);
        assert!(start.floor[1][0].abs() < stack.floor_friction * start.floor[1][1]);
        // In equilibrium e/d = T/3, hardly more than mu_c/3 under gravity alone.
        assert!((start.floor[1][0].abs() / start.floor[1][1] - 0.0893).abs() < 2e-3);
    }
}

#[test]
fn left_and_right_stay_mirror_images_up_to_the_yield() {
    let case = plan(
        &SettledCode::native(),
        &Stack::paper(0.3, 1e2),
        ContactConvention::TURNING,
    )
    .cases[0];
    let series = compress_stack(&case, || true).expect("a finite series");
    for sample in series.samples() {
        assert!(
            (sample.bodies[1].position[0] + sample.bodies[2].position[0]).abs() < 1e-12,
            "{}",
            sample.step
        );
        assert!((sample.bodies[1].rotation[2] + sample.bodies[2].rotation[2]).abs() < 1e-12);
        assert!(sample.bodies[0].position[0].abs() < 1e-12);
    }
}

/// Pinned on x86-64 Linux, release build of version 0.1.0; it must be the same on every machine and in
/// every build, because the stepping uses correctly rounded operations alone.
#[test]
fn series_has_the_same_bits_everywhere() {
    let case = plan(
        &SettledCode::native(),
        &Stack::paper(0.3, 1e3),
        ContactConvention::TURNING,
    )
    .cases[0];
    let series = compress_stack(&case, || true).expect("a finite series");
    let expected = "e6cc20d5f6a4a7b490bb97ce43d018c8d16891bc8b95aea61806c44e40aba7be";
    assert_eq!(sha256_hex(&series.to_csv()), expected);
}

/// Two and three bodies on the floor, any arms, closed bottom contacts, Hertz's law.
#[test]
fn onset_with_a_spring_that_nothing_turns_is_the_limit() {
    let stack = |mu, stiffness, stiffness_ratio| Stack {
        stiffness_ratio,
        ..Stack::paper(mu, stiffness)
    };
    let paper = ContactConvention::PAPER;
    let arm = |torque, kinematic| ContactArms { torque, kinematic };
    let with_arms = ContactConvention {
        arms: Arms {
            pair: arm(-0.5, -0.2),
            floor: arm(-0.8, 0.3),
        },
        ..paper
    };
    let hertz = ContactConvention {
        law: Law {
            floor_ratio: 1.3,
            ..Law::of_power(Power::Hertz)
        },
        ..paper
    };
    let three = Stack {
        bodies: 3,
        ..stack(0.37, 137.0, 2.3)
    };
    for (stack, convention) in [
        (stack(0.3, 100.0, 2.5), paper),
        (stack(0.27, 137.0, 2.3), with_arms),
        (stack(0.23, 137.0, 0.62), paper),
        (three, paper),
        (stack(0.31, 137.0, 4.3), hertz),
    ] {
        let stack = Stack {
            cylinder_friction: 0.7,
            ..stack
        };
        let measurement = plan(&SettledCode::native(), &stack, convention);
        let [at_rest, _] = onset_and_peak(&measurement);
        let exact = measurement.limit.slip_onset.unwrap();
        let apart = (at_rest - exact).abs() / (exact + f64::from(stack.bodies) + 1.0);
        assert!(apart < 1e-6, "{stack:?}: {at_rest} {exact} {apart:e}");
    }
}

/// Contact points many overlaps inside and outside of the bodies, where levers are from a tenth of the radius to nine of it.
/// Springs on long levers need shorter time steps.
#[test]
fn onset_with_contact_points_far_from_the_surfaces_is_the_limit() {
    let usual_step = plan(
        &SettledCode::native(),
        &Stack::paper(0.3, 1e2),
        ContactConvention::TURNING,
    )
    .cases[0]
        .protocol
        .time_step;
    for (mu, pair, floor, needs_shorter_steps) in [
        (0.3, 0.0, -1.5, false),
        (0.3, -8.0, -8.0, false),
        (0.4, 10.0, -10.0, false),
        (0.35, 30.0, 30.0, true),
    ] {
        let convention = ContactConvention::with_arms(Arms::reciprocal(pair, floor));
        let stack = Stack::paper(mu, 1e2);
        let measurement = plan(&SettledCode::native(), &stack, convention);
        let time_step = measurement.cases[0].protocol.time_step;
        assert_eq!(
            time_step < usual_step,
            needs_shorter_steps,
            "{pair} {floor}"
        );
        let [at_rest, _] = onset_and_peak(&measurement);
        let exact = measurement.limit.slip_onset.unwrap();
        let apart = (at_rest - exact).abs() / (exact + 3.0);
        assert!(apart < 1e-6, "{pair} {floor}: {at_rest} {exact} {apart:e}");
    }
}

/// What a wall speed adds to onset and peak, per speed, by the slower two of three speeds, with short time steps and rows.
fn added_per_speed(measurement: &Measurement) -> [f64; 2] {
    let mut finer = measurement.clone();
    for case in &mut finer.cases {
        case.protocol.time_step *= 0.125;
        case.protocol.sampling.fine_interval = 0.2;
    }
    let fastest = measurement.cases[0].protocol.wall_speed;
    three_speeds(&finer).map(|[_, middle, slow]| 4.0 * (middle - slow) / fastest)
}

/// What a speed adds is what theory says, for springs that turn and one that does not, any arms, Hertz's law and spheres.
#[test]
fn a_wall_speed_adds_to_onset_and_peak_what_theory_says() {
    let stack = |mu, stiffness, stiffness_ratio| Stack {
        stiffness_ratio,
        ..Stack::paper(mu, stiffness)
    };
    let with_arms = ContactConvention::with_arms(Arms::reciprocal(-0.5, -0.5));
    let hertz = ContactConvention {
        law: Law::of_power(Power::Hertz),
        ..ContactConvention::PAPER
    };
    let three = Stack {
        bodies: 3,
        ..stack(0.37, 137.0, 2.3)
    };
    for (stack, convention) in [
        (stack(0.2, 100.0, 2.5), ContactConvention::PAPER),
        (stack(0.3, 137.0, 2.3), with_arms),
        (stack(0.31, 137.0, 4.3), hertz),
        (three, ContactConvention::TURNING),
    ] {
        let measurement = plan(&SettledCode::native(), &stack, convention);
        let problem = Problem::new(measurement.stack, measurement.convention).unwrap();
        let curve = LimitCurve::new(&problem);
        let added = curve.speed_excess(&problem, &measurement.limit).unwrap();
        let found = added_per_speed(&measurement);
        for (expected, found) in [added.onset, added.peak].into_iter().zip(found) {
            // A peak is known to some steps of load in each run, and the second order is left.
            let apart = (found / expected - 1.0).abs();
            assert!(apart < 0.02, "{stack:?}: {found} in place of {expected}");
        }
    }
}
