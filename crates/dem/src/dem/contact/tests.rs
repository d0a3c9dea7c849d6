//! Tests of the contact law and of the equations of a step.

use super::*;
use crate::dem::geometry::{Facing, Space};

/// A contact with a wall along which a body slides.
pub(in crate::dem) const CONTACT: Contact<f64> = Contact {
    counterpart: Counterpart::Wall,
    normal: [0.0, 1.0],
    overlap: 1.0,
    separation_speed: 0.0,
    sliding_speed: 0.5,
    spin: 0.0,
    friction: 0.5,
    time_step: 0.1,
};

fn law(coulomb_operand: CoulombOperand, sliding_spring: SlidingSpring) -> SpringDashpot<f64> {
    SpringDashpot {
        law: ContactLaw {
            normal_stiffness: 1.0,
            tangential_stiffness: 0.4,
            damping_normal: 0.2,
            damping_tangential: 0.1,
            ..ContactConvention::TURNING.law(2.5)
        },
        coulomb_operand,
        sliding_spring,
        ..SpringDashpot::like(1.0, &ContactConvention::TURNING, 2.5)
    }
}

fn paper() -> SpringDashpot<f64> {
    law(CoulombOperand::SpringAndDamping, SlidingSpring::Frozen)
}

fn stretched(length: f64) -> Spring<f64> {
    Spring {
        length,
        normal: CONTACT.normal,
    }
}

#[test]
fn normal_force_is_the_negative_slope_of_its_elastic_energy() {
    let energy = |overlap: f64| 0.5 * overlap * overlap;
    let (overlap, width) = (0.3, 1e-3);
    let slope = (energy(overlap + width) - energy(overlap - width)) / (2.0 * width);
    assert!((paper().normal_force(overlap, 0.0) - slope).abs() < 1e-12);
}

#[test]
fn sticking_contact_stores_the_displacement() {
    let mut memory = paper().initial(0.0);
    let force = paper().evaluate(&CONTACT, &mut memory);
    assert_eq!(memory.length, 0.05);
    assert!((force.tangential + 0.4 * 0.05 + 0.1 * 0.5).abs() < 1e-17);
}

#[test]
fn sliding_contact_is_capped_and_its_spring_frozen() {
    for sign in [1.0, -1.0] {
        let mut memory = stretched(2.0 * sign);
        let contact = Contact {
            sliding_speed: 0.5 * sign,
            ..CONTACT
        };
        let force = paper().evaluate(&contact, &mut memory);
        assert_eq!(memory.length, 2.0 * sign);
        assert_eq!(force.tangential, -0.5 * sign);
    }
}

#[test]
fn a_spring_that_follows_the_limit_is_at_it_when_the_contact_sticks_again() {
    use CoulombOperand::{Spring, SpringAndDamping};
    for (operand, length) in [(Spring, 0.5 / 0.4), (SpringAndDamping, 0.45 / 0.4)] {
        let mut memory = stretched(2.0);
        let law = law(operand, SlidingSpring::FollowsLimit);
        assert_eq!(law.evaluate(&CONTACT, &mut memory).tangential, -0.5);
        assert!((memory.length - length).abs() < 1e-15);
    }
}

#[test]
fn damping_may_lift_a_sticking_force_above_the_limit_where_the_spring_alone_counts() {
    let law = law(CoulombOperand::Spring, SlidingSpring::FollowsLimit);
    let force = law.evaluate(&CONTACT, &mut stretched(1.19));
    assert!((force.tangential + 0.4 * 1.24 + 0.05).abs() < 1e-15);
}

#[test]
fn transports_differ_by_the_square_of_the_turn() {
    let turn: f64 = 1e-3;
    let turned = [-turn.sin(), turn.cos()];
    let factor = |history_update| {
        let law: SpringDashpot<f64> = SpringDashpot {
            history_update,
            ..paper()
        };
        let normals = [CONTACT.normal, turned];
        <Plane as Geometry<f64>>::transport(law.history_update, 1.0, normals, 0.0)
    };
    let half_square = 0.5 * turn * turn;
    assert_eq!(factor(HistoryUpdate::Rotated), 1.0);
    assert!((factor(HistoryUpdate::Projected) - 1.0 + half_square).abs() < 1e-12);
    assert!((factor(HistoryUpdate::Linearised) - 1.0 - half_square).abs() < 1e-12);
}

#[test]
fn a_force_is_put_together_from_its_components_and_taken_apart_into_them() {
    let normal = [0.6, 0.8];
    let force = ContactForce::<f64>::new(2.0, 5.0, 1.0);
    // 2 n + 5 t with t = (-0.8, 0.6).
    let vector: [f64; 2] = force.as_vector(normal);
    assert!((vector[0] + 2.8).abs() < 1e-15 && (vector[1] - 4.6).abs() < 1e-15);
    assert!((Plane::along(normal, vector) - 2.0).abs() < 1e-15);
    assert!((Plane::tangential(normal, vector) - 5.0).abs() < 1e-15);
}

#[test]
fn damping_pulls_on_separating_surfaces_unless_that_is_excluded() {
    let never_pulls = SpringDashpot {
        tensile_force: TensileForce::NeverPulls,
        ..paper()
    };
    for (speed, may_pull, never) in [(-1.0, 0.7, 0.7), (1.0, 0.3, 0.3), (3.0, -0.1, 0.0)] {
        assert!((paper().normal_force(0.5, speed) - may_pull).abs() < 1e-15);
        assert!((never_pulls.normal_force(0.5, speed) - never).abs() < 1e-15);
    }
}

#[test]
fn the_torque_has_one_arm_and_the_surface_velocity_the_other() {
    let mut law = paper();
    law.arms.floor = ContactArms {
        torque: -1.0,
        kinematic: -0.5,
    };
    law.arms.pair.torque = -0.5;
    let mut contact = Contact {
        spin: 0.25,
        overlap: 0.5,
        friction: 10.0,
        ..CONTACT
    };
    let mut memory = law.initial(0.0);
    let force = law.evaluate(&contact, &mut memory);
    assert_eq!(force.arm, 0.5);
    // v_t = 0.5 - 0.75 * 0.25 for a time of 0.1.
    assert!((memory.length - 0.031_25).abs() < 1e-17);
    assert_eq!(force.normal, 0.5);
    contact.counterpart = Counterpart::Cylinder;
    assert_eq!(law.evaluate(&contact, &mut memory).arm, 0.75);
}

#[test]
fn friction_times_the_normal_force_is_the_limit_also_where_that_pulls() {
    let contact = Contact {
        separation_speed: 15.0,
        friction: 0.25,
        ..CONTACT
    };
    let force = paper().evaluate(&contact, &mut stretched(2.0));
    assert_eq!((force.normal, force.tangential), (-2.0, -0.5));
}

#[test]
fn a_projected_spring_is_shortened_in_the_step_in_which_the_contact_turns() {
    let law = SpringDashpot {
        history_update: HistoryUpdate::Projected,
        ..paper()
    };
    let turned = Contact {
        normal: [-0.6, 0.8],
        sliding_speed: 0.0,
        ..CONTACT
    };
    let mut memory = stretched(1.0);
    law.evaluate(&turned, &mut memory);
    assert_eq!((memory.length, memory.normal), (0.8, [-0.6, 0.8]));
}

/// The paper's law with a spring that does not turn.
fn fixed() -> SpringDashpot<f64> {
    SpringDashpot {
        history_update: HistoryUpdate::Fixed,
        ..paper()
    }
}

/// A pair whose tangent is (-0.8, -0.6).
const PAIR: Contact<f64> = Contact {
    counterpart: Counterpart::Cylinder,
    normal: [-0.6, 0.8],
    ..CONTACT
};

fn is_near(found: [f64; 2], expected: [f64; 2]) -> bool {
    found
        .iter()
        .zip(expected)
        .all(|(found, expected)| (found - expected).abs() < 1e-15)
}

#[test]
fn a_fixed_spring_of_a_pair_grows_along_the_tangent_and_pushes_along_the_normal_too() {
    let mut memory = Spring {
        length: 0.0,
        normal: [0.3, 0.1],
    };
    let force = fixed().evaluate(&PAIR, &mut memory);
    // The spring grows by 0.05 t; the force is −0.4 u − 0.05 t = (−0.064, 0.002).
    assert!(is_near(memory.normal, [0.26, 0.07]), "{memory:?}");
    assert_eq!(memory.length, 0.0);
    assert!((force.normal - 1.0 - 0.04).abs() < 1e-15, "{force:?}");
    assert!((force.tangential - 0.05).abs() < 1e-15, "{force:?}");
}

#[test]
fn a_fixed_spring_of_a_pair_slides_at_the_limit_of_its_whole_force() {
    let mut memory = Spring {
        length: 0.0,
        normal: [-3.96, 0.03],
    };
    let force = fixed().evaluate(&PAIR, &mut memory);
    // The stretched spring would be (−4, 0), and the sticking force is (1.64, 0.03).
    let sticking: [f64; 2] = [1.64, 0.03];
    let size = libm::hypot(sticking[0], sticking[1]);
    let along = sticking.map(|part| 0.5 * part / size);
    let exerted = [
        -0.6 * (force.normal - 1.0) - 0.8 * force.tangential,
        0.8 * (force.normal - 1.0) - 0.6 * force.tangential,
    ];
    assert!(is_near(exerted, along), "{exerted:?} {along:?}");
    assert_eq!(memory.normal, [-3.96, 0.03]);
}

#[test]
fn a_vector_is_below_a_limit_by_its_size_and_has_a_direction_without_it() {
    let in_space = <Space as Geometry<f64>>::direction([2.0, 0.0, -4.0], 4.0);
    assert_eq!(in_space, [0.5, 0.0, -1.0]);
    assert!([3.0, 4.0].is_below(5.5) && ![3.0, 4.0].is_below(4.5));
}

#[test]
fn a_torque_turns_by_its_time_over_the_moment_of_inertia() {
    assert!((Plane::kick(3.0, 0.5, 0.25) - 1.5_f64).abs() < 1e-15);
    assert_eq!(Space::kick([3.0, 0.0, -1.0], 0.5, 0.25), [1.5, 0.0, -0.5]);
}

#[test]
fn a_fixed_spring_at_a_wall_is_a_length() {
    let [mut fixed_memory, mut turned_memory] = [stretched(0.3), stretched(0.3)];
    let force = fixed().evaluate(&CONTACT, &mut fixed_memory);
    let turned = paper().evaluate(&CONTACT, &mut turned_memory);
    assert_eq!(
        (force.normal, force.tangential),
        (turned.normal, turned.tangential)
    );
    assert_eq!(fixed_memory.length, 0.35);
    assert_eq!(fixed_memory.normal, CONTACT.normal);
}

#[test]
fn a_spring_is_changed_where_it_is_kept() {
    let changed = |update| {
        let mut memory = stretched(3.0);
        memory.change(update, |part| 2.0 * part);
        (memory.length, memory.normal)
    };
    assert_eq!(changed(HistoryUpdate::Rotated), (6.0, [0.0, 1.0]));
    assert_eq!(changed(HistoryUpdate::Fixed), (6.0, [0.0, 2.0]));
}

#[test]
fn in_space_a_pair_turns_its_spring_unless_that_is_fixed_and_a_wall_has_none_to_turn() {
    let turned = |history_update, counterpart| {
        let law = SpringDashpot::<f64> {
            history_update,
            ..paper()
        };
        let contact = Contact {
            counterpart,
            normal: [0.6, 0.8, 0.0],
            sliding_speed: [0.0; 3],
            ..IN_SPACE
        };
        let mut memory: Spring<f64, Space> = Spring {
            length: [0.5, 0.0, 0.0],
            normal: IN_SPACE.normal,
        };
        law.evaluate(&contact, &mut memory);
        memory.length
    };
    let is_near = |found: [f64; 3], expected: [f64; 3]| {
        let mut pairs = found.iter().zip(expected);
        pairs.all(|(one, other)| (one - other).abs() < 1e-15)
    };
    let kept = [0.5, 0.0, 0.0];
    for (update, pair) in [
        (HistoryUpdate::Fixed, kept),
        (HistoryUpdate::Rotated, [0.4, -0.3, 0.0]),
        (HistoryUpdate::Projected, [0.32, -0.24, 0.0]),
    ] {
        let found = turned(update, Counterpart::Cylinder);
        assert!(is_near(found, pair), "{update:?}: {found:?}");
        assert_eq!(turned(update, Counterpart::Wall), kept);
    }
    let linearised = turned(HistoryUpdate::Linearised, Counterpart::Cylinder);
    assert!(!is_near(linearised, kept), "{linearised:?}");
}

const IN_SPACE: Contact<f64, Space> = Contact {
    counterpart: Counterpart::Wall,
    normal: [0.0, 1.0, 0.0],
    overlap: 1.0,
    separation_speed: 0.0,
    sliding_speed: [0.3, 0.0, -0.4],
    spin: [0.0; 3],
    friction: 0.5,
    time_step: 0.1,
};

#[test]
fn in_space_a_force_at_its_limit_is_along_the_motion_and_a_spin_adds_to_that_across_it() {
    let mut memory: Spring<f64, Space> = Spring {
        length: [0.0; 3],
        normal: IN_SPACE.normal,
    };
    let law = SpringDashpot::<f64> {
        arms: Arms::PAPER,
        ..paper()
    };
    // For a spin about x, ω × n is along z.
    let contact = Contact {
        sliding_speed: [30.0, 0.0, -20.0],
        spin: [20.0, 0.0, 0.0],
        ..IN_SPACE
    };
    let force = law.evaluate(&contact, &mut memory);
    let [x, y, z] = force.tangential;
    assert!((x + 0.5 * 0.6).abs() < 1e-15 && y == 0.0 && (z - 0.5 * 0.8).abs() < 1e-15);
    let torque = force.torque(contact.normal);
    assert!((torque[0] + 0.4).abs() < 1e-15 && (torque[2] - x).abs() < 1e-15);
}

#[test]
fn a_spring_in_space_turns_as_its_convention_says() {
    let turn: f64 = 1e-2;
    let (from, to) = ([0.0, 1.0, 0.0], [turn.sin(), turn.cos(), 0.0]);
    // One component of the spring lies in the plane of the turn, and one is normal to it.
    let spring = [3.0, 0.0, 4.0];
    let carried = |update, turned| Space::transport(update, spring, [from, to], turned);
    let size = |vector: [f64; 3]| Space::along(vector, vector).sqrt();
    let projected = carried(HistoryUpdate::Projected, [0.0; 3]);
    assert!((size(projected) - (9.0 * turn.cos().powi(2) + 16.0).sqrt()).abs() < 1e-14);
    let kept = carried(HistoryUpdate::Rotated, [0.0; 3]);
    assert!((size(kept) - 5.0).abs() < 1e-14 && Space::along(kept, to).abs() < 1e-15);
    let product = carried(HistoryUpdate::Linearised, [0.0; 3]);
    let along_turn = product[0] * turn.cos() - product[1] * turn.sin();
    let expected = 3.0 * (turn.cos() + turn.sin().powi(2));
    assert!((along_turn - expected).abs() < 1e-14 && product[2] == 4.0);
    // A twist about the normal, by half the sum of the angles.
    let twisted = carried(HistoryUpdate::Linearised, [0.0, 2e-3, 0.0]);
    assert!((twisted[0] - product[0] - 4.0 * 1e-3).abs() < 1e-14);
    assert!((twisted[2] - product[2] + 3.0 * 1e-3).abs() < 1e-6);
}

/// A normal; the tangent is (−0.8, 0.6).
const NORMAL: [f64; 2] = [0.6, 0.8];

#[test]
fn a_pair_overlaps_parts_and_slides_as_its_bodies_lie_and_move() {
    let mut bodies = [Body::at(0.9, 1.2), Body::at(0.0, 0.0)];
    bodies[0].velocity = [1.0, 0.0];
    bodies[1].velocity = [0.0, 0.5];
    (bodies[0].spin, bodies[1].spin) = (0.25, 0.5);
    let [i, j] = &bodies;
    let contact = Contact::<f64>::of_pair([i, j], Body::apart([i, j]), 0.3, 0.1);
    assert_eq!(contact.counterpart, Counterpart::Cylinder);
    assert!(is_near(contact.normal, NORMAL));
    assert!(is_near([contact.overlap, contact.spin], [0.5, 0.75]));
    let found = [contact.separation_speed, contact.sliding_speed];
    assert!(is_near(found, [0.2, -1.1]), "{found:?}");
    assert_eq!([contact.friction, contact.time_step], [0.3, 0.1]);
}

#[test]
fn a_body_parts_from_a_wall_by_its_speed_beyond_that_of_the_wall() {
    let mut body: Body = Body::at(0.0, 0.9);
    (body.velocity, body.spin) = ([0.5, 1.0], 0.125);
    let floor = PlaneWall {
        facing: Facing::Up,
        offset: 0.0,
        speed: 0.25,
        friction: 0.3,
    };
    let contact = Contact::with_wall(&body, &floor, 0.1, 0.05);
    assert_eq!(contact.counterpart, Counterpart::Wall);
    assert_eq!(contact.normal, [0.0, 1.0]);
    assert_eq!([contact.overlap, contact.separation_speed], [0.1, 0.75]);
    // The tangent is (−1, 0).
    assert_eq!([contact.sliding_speed, contact.spin], [-0.5, 0.125]);
    assert_eq!([contact.friction, contact.time_step], [0.3, 0.05]);
}

/// Opposite forces, and equal torques, since the force along the tangent has opposite arms too.
#[test]
fn a_force_acts_on_both_bodies_where_they_touch() {
    let force = ContactForce::<f64>::new(2.0, 5.0, 0.5);
    let weight = Load::<f64>::weight(0.5);
    assert_eq!((weight.force, weight.torque), ([0.0, -0.5], 0.0));
    let [mut first, mut second] = [weight; 2];
    force.act_on_pair(NORMAL, Touch::Everywhere, [&mut first, &mut second]);
    assert!(is_near(first.force, [-2.8, 4.1]), "{first:?}");
    assert!(is_near(second.force, [2.8, -5.1]), "{second:?}");
    assert_eq!([first.torque, second.torque], [-2.5; 2]);
    let [mut first, mut second] = [weight; 2];
    force.act_on_pair(NORMAL, Touch::Where(false), [&mut first, &mut second]);
    assert_eq!([first, second], [weight; 2]);
}

#[test]
fn a_step_kicks_velocities_and_drifts_with_them() {
    let mut body: Body = Body::at(0.0, 1.0);
    let load = Load {
        force: [1.0, -2.0],
        torque: 3.0,
    };
    body.advance(&load, 0.5, 0.1);
    assert!(is_near(body.velocity, [0.1, -0.2]));
    assert!(is_near(body.position, [0.01, 0.98]));
    assert!(is_near([body.spin, body.angle], [0.6, 0.06]));
}
