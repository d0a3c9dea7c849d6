//! The equations of a step, in the order in which the paper states them ("Numerical results"): the motion of a contact,
//! its normal and tangential force, the loads on both bodies, and the leapfrog step (supplement).
//!
//! Lengths are in r, masses in m and stiffnesses in k_n. Contacts of other powers act through the same springs and
//! dashpots, whose coefficients they choose at each overlap ([`PowerLaw`](super::PowerLaw)).

use super::body::{Body, Load};
use super::contact::{Contact, ContactForce, ContactModel, Counterpart, Spring, SpringDashpot};
use super::contact_state::Touch;
use super::geometry::{Geometry, Linear, Tangential};
use super::real::Real;
use super::wall::PlaneWall;
use crate::model::{CoulombOperand, HistoryUpdate, SlidingSpring, TensileForce};

/// The motion of a contact: Δ_ij, n_ij, v_ij and ω_i + ω_j.
impl<R: Real, G: Geometry<R>> Contact<R, G> {
    /// Two bodies i and j: Δ = 2 r − r_ij, n = r_ij/|r_ij|, (v_i − v_j) · n, (v_i − v_j) · t and ω_i + ω_j, from the
    /// difference r_ij of their positions and its square.
    #[inline(always)]
    pub(super) fn of_pair(
        [i, j]: [&Body<R, G>; 2],
        (apart, square): (G::Vector, R),
        friction: R,
        time_step: R,
    ) -> Self {
        let distance = square.sqrt();
        let normal = G::direction(apart, distance);
        let velocity = i.velocity.minus(j.velocity);
        Self {
            counterpart: Counterpart::Cylinder,
            normal,
            overlap: distance.like(2.0) - distance,
            separation_speed: G::along(normal, velocity),
            sliding_speed: G::tangential(normal, velocity),
            spin: i.spin.plus(j.spin),
            friction,
            time_step,
        }
    }

    /// A body and a wall, which has a velocity along its normal and no spin.
    #[inline(always)]
    pub(super) fn with_wall(
        body: &Body<R, G>,
        plane: &PlaneWall<R>,
        overlap: R,
        time_step: R,
    ) -> Self {
        Self {
            counterpart: Counterpart::Wall,
            normal: plane.facing.normal::<R, G>(overlap),
            overlap,
            separation_speed: G::along_wall(plane.facing, body.velocity) - plane.speed,
            sliding_speed: G::tangential_to_wall(plane.facing, body.velocity),
            spin: body.spin,
            friction: plane.friction,
            time_step,
        }
    }
}

/// The forces of a contact.
impl<R: Real> SpringDashpot<R> {
    /// Returns h_n = k_n Δ − η_n v_n, where `elastic` is k_n Δ (the overlap Δ, as k_n = 1), and the normal velocity
    /// v_n is positive when separating (paper, "Numerical results").
    ///
    /// ```
    /// use tristack_dem::dem::SpringDashpot;
    /// use tristack_dem::model::ContactConvention;
    /// let mut model = SpringDashpot::like(1.0, &ContactConvention::TURNING, 2.5);
    /// model.law.damping_normal = 0.25;
    /// assert_eq!(model.normal_force(0.5, -1.0), 0.75);
    /// ```
    #[inline(always)]
    pub fn normal_force(&self, elastic: R, separation_speed: R) -> R {
        let force = elastic - self.law.damping_normal * separation_speed;
        match self.tensile_force {
            TensileForce::MayPull => force,
            TensileForce::NeverPulls => {
                let zero = force.like(0.0);
                R::select(force.less(zero), zero, force)
            }
        }
    }

    /// Returns f_n and f_t of `contact`, whose normal spring exerts `elastic`, and advances its memory to the present.
    ///
    /// The surfaces move at v_t = (v_i − v_j) · t − R̃ (ω_i + ω_j), with the kinematic arm R̃ = r + r₁ Δ. The torque has
    /// an arm R of the same form; the paper's simulations have r₁ = 0, so that both are r.
    #[inline(always)]
    pub(super) fn exert<G: Geometry<R>>(
        &self,
        contact: &Contact<R, G>,
        elastic: R,
        memory: &mut Spring<R, G>,
    ) -> ContactForce<R, G> {
        let one = contact.overlap.like(1.0);
        let arms = match contact.counterpart {
            Counterpart::Cylinder => self.arms.pair,
            Counterpart::Wall => self.arms.floor,
        };
        let kinematic_arm = one + arms.kinematic * contact.overlap;
        let rolling = G::rolling(contact.normal, contact.spin);
        let velocity = contact.sliding_speed.minus(rolling.times(kinematic_arm));
        let normal = self.normal_force(elastic, contact.separation_speed);
        let limit = contact.friction * normal.abs();
        let time_step = contact.time_step;
        let arm = one + arms.torque * contact.overlap;
        if self.history_update == HistoryUpdate::Fixed
            && G::IS_SMALL
            && contact.counterpart == Counterpart::Cylinder
        {
            // In the plane, only this spring does not lie along the tangent, so it is stored and limited as a vector.
            let velocity = G::put_together(contact.normal, one.like(0.0), velocity);
            let force = self.tangential_force(&mut memory.normal, limit, velocity, time_step);
            return ContactForce {
                normal: normal + G::along(contact.normal, force),
                tangential: G::tangential(contact.normal, force),
                arm,
            };
        }
        self.transport(contact, memory);
        ContactForce {
            normal,
            tangential: self.tangential_force(&mut memory.length, limit, velocity, time_step),
            arm,
        }
    }

    /// Turns the spring with its contact from the last normal to the present one.
    #[inline(always)]
    fn transport<G: Geometry<R>>(&self, contact: &Contact<R, G>, memory: &mut Spring<R, G>) {
        // In space, tracking the normal of a wall costs as much as that of a pair, and it never turns.
        let is_kept = match self.history_update {
            HistoryUpdate::Fixed => true,
            HistoryUpdate::Rotated if G::IS_SMALL => true,
            HistoryUpdate::Rotated | HistoryUpdate::Projected => {
                !G::IS_SMALL && contact.counterpart == Counterpart::Wall
            }
            HistoryUpdate::Linearised => false,
        };
        if !is_kept {
            memory.length = G::transport(
                self.history_update,
                memory.length,
                [memory.normal, contact.normal],
                contact.spin.times(contact.time_step),
            );
            memory.normal = contact.normal;
        }
    }

    /// Advances the spring by one step in which the surfaces move at v_t, and returns the tangential force
    /// h_t = −k_t u − η_t v_t, limited to μ |f_n| (paper, "Numerical results").
    #[inline(always)]
    fn tangential_force<T: Tangential<R>>(
        &self,
        spring: &mut T,
        limit: R,
        velocity: T,
        time_step: R,
    ) -> T {
        let stiffness = self.law.tangential_stiffness;
        let stretched = spring.plus(velocity.times(time_step));
        let elastic = stretched.times(-stiffness);
        let damping = velocity.times(self.law.damping_tangential);
        let sticking = elastic.minus(damping);
        let operand = match self.coulomb_operand {
            CoulombOperand::SpringAndDamping => sticking,
            CoulombOperand::Spring => elastic,
        };
        let sticks = operand.is_below(limit);
        if limit.all(sticks) {
            *spring = stretched;
            return sticking;
        }
        let sliding = operand.of_length(limit);
        let length = match (self.sliding_spring, self.coulomb_operand) {
            (SlidingSpring::Frozen, _) => *spring,
            (SlidingSpring::FollowsLimit, CoulombOperand::Spring) => {
                sliding.negated().over(stiffness)
            }
            (SlidingSpring::FollowsLimit, CoulombOperand::SpringAndDamping) => {
                sliding.plus(damping).negated().over(stiffness)
            }
        };
        *spring = stretched.or_where_not(sticks, &length);
        sticking.or_where_not(sticks, &sliding)
    }
}

impl<R: Real, G: Geometry<R>> ContactModel<R, G> for SpringDashpot<R> {
    type Memory = Spring<R, G>;

    #[inline(always)]
    fn initial(&self, number: R) -> Spring<R, G> {
        Spring::unstretched(number)
    }

    #[inline(always)]
    fn evaluate(&self, contact: &Contact<R, G>, memory: &mut Spring<R, G>) -> ContactForce<R, G> {
        self.exert(contact, contact.overlap, memory)
    }
}

/// Action and reaction.
impl<R: Real, G: Geometry<R>> ContactForce<R, G> {
    /// Returns the force as a vector, where `normal` is the normal of the contact.
    #[inline(always)]
    pub(super) fn as_vector(&self, normal: G::Vector) -> G::Vector {
        G::put_together(normal, self.normal, self.tangential)
    }

    /// Returns the torque on either body, −R n × f_t.
    #[inline(always)]
    pub(super) fn torque(&self, normal: G::Vector) -> G::Rotation {
        G::torque(normal, self.tangential).times(-self.arm)
    }

    /// Adds the force and its torque to the loads of the two bodies of a contact with this normal.
    #[inline(always)]
    pub(super) fn act_on_pair(
        &self,
        normal: G::Vector,
        touches: Touch<R>,
        [first, second]: [&mut Load<R, G>; 2],
    ) {
        let (force, torque) = (self.as_vector(normal), self.torque(normal));
        first.add(touches, force, torque);
        second.react(touches, force, torque);
    }
}

impl<R: Real, G: Geometry<R>> Load<R, G> {
    /// The weight of a body.
    #[inline(always)]
    pub(super) fn weight(gravity: R) -> Self {
        let zero = gravity.like(0.0);
        Self {
            force: G::vector([zero, -gravity, zero]),
            torque: G::rotation([zero; 3]),
        }
    }

    /// Adds a force and a torque where bodies touch.
    #[inline(always)]
    pub(super) fn add(&mut self, touches: Touch<R>, force: G::Vector, torque: G::Rotation) {
        let sum = Self {
            force: self.force.plus(force),
            torque: self.torque.plus(torque),
        };
        *self = touches.choose(sum, *self);
    }

    /// Adds the opposite force and the same torque where bodies touch.
    #[inline(always)]
    fn react(&mut self, touches: Touch<R>, force: G::Vector, torque: G::Rotation) {
        let sum = Self {
            force: self.force.minus(force),
            torque: self.torque.plus(torque),
        };
        *self = touches.choose(sum, *self);
    }
}

/// The leapfrog step.
impl<R: Real, G: Geometry<R>> Body<R, G> {
    /// Kicks v and ω, which belong to the half step before, over a whole step, then drifts the positions with them.
    #[inline(always)]
    pub(super) fn advance(&mut self, load: &Load<R, G>, moment_of_inertia: R, time_step: R) {
        self.velocity = self.velocity.plus(load.force.times(time_step));
        self.position = self.position.plus(self.velocity.times(time_step));
        let kick = G::kick(load.torque, moment_of_inertia, time_step);
        self.spin = self.spin.plus(kick);
        self.angle = self.angle.plus(self.spin.times(time_step));
    }

    /// Returns the difference of two centres, and its square.
    #[inline(always)]
    pub(super) fn apart([i, j]: [&Self; 2]) -> (G::Vector, R) {
        let apart = i.position.minus(j.position);
        (apart, G::along(apart, apart))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::geometry::{Plane, Space};
    use crate::model::{Arms, ContactArms, ContactConvention, ContactLaw};

    const CONTACT: Contact<f64> = Contact {
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
        let force = ContactForce::<f64> {
            normal: 2.0,
            tangential: 5.0,
            arm: 1.0,
        };
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
}
