//! The contact law: a damped normal spring, a damped and capped tangential one.

use super::real::{Composite, Real, composite};
use crate::model::{
    Arms, ContactArms, ContactConvention, ContactLaw, CoulombOperand, HistoryUpdate, SlidingSpring,
    TensileForce,
};

/// The second body of a contact; the first is a cylinder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Counterpart {
    /// Another cylinder.
    Cylinder,
    /// A plane wall.
    Wall,
}

/// A contact between two bodies as it is at one moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact<R> {
    /// The second body.
    pub counterpart: Counterpart,
    /// Unit normal, towards the first body.
    pub normal: [R; 2],
    /// Overlap δ.
    pub overlap: R,
    /// Velocity of the first centre relative to the second body along the normal.
    pub separation_speed: R,
    /// The same along t = (−n_y, n_x).
    pub sliding_speed: R,
    /// Sum of the angular velocities of the two bodies.
    pub spin: R,
    /// Friction coefficient.
    pub friction: R,
    /// Time step.
    pub time_step: R,
}

/// Force of a contact on its first body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactForce<R> {
    /// Normal force, positive in compression.
    pub normal: R,
    /// Tangential force along t = (−n_y, n_x).
    pub tangential: R,
    /// Torque arm R; the torque on either body is −R times the tangential force.
    pub arm: R,
}

composite!(ContactForce {
    normal,
    tangential,
    arm
});

impl<R: Real> ContactForce<R> {
    /// As a vector, the normal of the contact being `normal`.
    #[inline(always)]
    pub(super) fn in_the_plane(&self, normal: [R; 2]) -> [R; 2] {
        [
            self.normal * normal[0] - self.tangential * normal[1],
            self.normal * normal[1] + self.tangential * normal[0],
        ]
    }

    /// No force, in numbers like `number`.
    #[inline(always)]
    pub fn none(number: R) -> Self {
        let zero = number.like(0.0);
        Self {
            normal: zero,
            tangential: zero,
            arm: zero,
        }
    }
}

/// A law that gives the force of a contact from its motion, step by step.
pub trait ContactModel<R: Real>: Copy {
    /// State of a contact that lasts from one step to the next.
    type Memory: Copy + Composite<R>;

    /// Memory of an undeformed contact, in numbers like `number`.
    fn initial(&self, number: R) -> Self::Memory;

    /// The force of `contact`, whose memory is advanced to the present.
    fn evaluate(&self, contact: &Contact<R>, memory: &mut Self::Memory) -> ContactForce<R>;
}

/// A contact law that a convention describes.
pub(super) trait ConventionalModel<R: Real>: ContactModel<R> + Composite<R> {
    /// The law of `convention` at stiffness ratio κ, in numbers like `number`.
    fn of_convention(number: R, convention: &ContactConvention, stiffness_ratio: f64) -> Self;
}

impl<R: Real> ConventionalModel<R> for SpringDashpot<R> {
    fn of_convention(number: R, convention: &ContactConvention, stiffness_ratio: f64) -> Self {
        Self::like(number, convention, stiffness_ratio)
    }
}

/// The paper's contact law, with the conventions by which other codes differ from it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringDashpot<R> {
    /// Arm coefficients.
    pub arms: Arms<R>,
    /// Stiffness and damping.
    pub law: ContactLaw<R>,
    /// The force that Coulomb's limit is compared with.
    pub coulomb_operand: CoulombOperand,
    /// The spring of a sliding contact.
    pub sliding_spring: SlidingSpring,
    /// The spring of a turning contact.
    pub history_update: HistoryUpdate,
    /// The normal force of a separating contact.
    pub tensile_force: TensileForce,
}

composite!(
    SpringDashpot { arms, law },
    Arms { pair, floor },
    ContactArms { torque, kinematic },
    ContactLaw {
        normal_stiffness,
        tangential_stiffness,
        damping_normal,
        damping_tangential
    },
);

/// Memory of a [`SpringDashpot`] contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring<R> {
    /// u, tangential displacement accumulated while the contact sticks.
    pub length: R,
    /// Normal of the contact when u was last brought up to date.
    pub normal: [R; 2],
}

composite!(Spring { length, normal });

impl<R: Real> SpringDashpot<R> {
    /// The law of `convention` at stiffness ratio κ, in numbers like `number`.
    pub fn like(number: R, convention: &ContactConvention, stiffness_ratio: f64) -> Self {
        let law = convention.law(stiffness_ratio);
        Self {
            arms: convention.arms.map(|arm| number.like(arm)),
            law: law.map(|coefficient| number.like(coefficient)),
            coulomb_operand: convention.coulomb_operand,
            sliding_spring: convention.sliding_spring,
            history_update: convention.history_update,
            tensile_force: convention.tensile_force,
        }
    }

    /// h_n = k_n Δ − η_n v_n of a normal spring that exerts k_n Δ, the overlap Δ since k_n = 1, and a normal velocity
    /// v_n, positive when separating (paper, "Numerical results").
    ///
    /// ```
    /// use tristack::dem::SpringDashpot;
    /// use tristack::model::ContactConvention;
    /// let mut model = SpringDashpot::like(1.0, &ContactConvention::PAPER, 2.5);
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

    /// Advances the spring by one step in which the surfaces move at v_t, and returns the tangential force
    /// h_t = −k_t u − η_t v_t, limited to μ |f_n| (paper, "Numerical results").
    #[inline(always)]
    fn tangential_force(&self, spring: &mut R, limit: R, velocity: R, time_step: R) -> R {
        let zero = limit.like(0.0);
        let stretched = *spring + velocity * time_step;
        let elastic = -(self.law.tangential_stiffness * stretched);
        let damping = self.law.damping_tangential * velocity;
        let sticking = elastic - damping;
        let (operand, damping_in_operand) = match self.coulomb_operand {
            CoulombOperand::SpringAndDamping => (sticking, damping),
            CoulombOperand::Spring => (elastic, zero),
        };
        let sticks = operand.abs().less(limit);
        if operand.all(sticks) {
            *spring = stretched;
            return sticking;
        }
        let sliding = R::select(operand.less(zero), -limit, limit);
        let length = match self.sliding_spring {
            SlidingSpring::Frozen => *spring,
            SlidingSpring::FollowsLimit => {
                -(sliding + damping_in_operand) / self.law.tangential_stiffness
            }
        };
        *spring = R::select(sticks, stretched, length);
        R::select(sticks, sticking, sliding)
    }

    /// The factor by which the spring's length changes while the normal turns.
    #[inline(always)]
    fn transport(&self, from: [R; 2], to: [R; 2]) -> R {
        let cosine = along(from, to);
        match self.history_update {
            HistoryUpdate::Rotated => cosine.like(1.0),
            HistoryUpdate::Projected => cosine,
            HistoryUpdate::Linearised => {
                let sine = tangential(from, to);
                cosine + sine * sine
            }
        }
    }
}

impl<R: Real> ContactModel<R> for SpringDashpot<R> {
    type Memory = Spring<R>;

    #[inline(always)]
    fn initial(&self, number: R) -> Spring<R> {
        let zero = number.like(0.0);
        Spring {
            length: zero,
            normal: [zero; 2],
        }
    }

    #[inline(always)]
    fn evaluate(&self, contact: &Contact<R>, memory: &mut Spring<R>) -> ContactForce<R> {
        self.exert(contact, contact.overlap, memory)
    }
}

impl<R: Real> SpringDashpot<R> {
    /// The force of `contact`, whose normal spring exerts `elastic`, and whose memory is advanced to the present.
    #[inline(always)]
    pub(super) fn exert(
        &self,
        contact: &Contact<R>,
        elastic: R,
        memory: &mut Spring<R>,
    ) -> ContactForce<R> {
        let one = contact.overlap.like(1.0);
        let arms = match contact.counterpart {
            Counterpart::Cylinder => self.arms.pair,
            Counterpart::Wall => self.arms.floor,
        };
        let kinematic_arm = one + arms.kinematic * contact.overlap;
        let velocity = contact.sliding_speed - kinematic_arm * contact.spin;
        let normal = self.normal_force(elastic, contact.separation_speed);
        let limit = contact.friction * normal.abs();
        if self.history_update != HistoryUpdate::Rotated {
            memory.length *= self.transport(memory.normal, contact.normal);
            memory.normal = contact.normal;
        }
        let time_step = contact.time_step;
        ContactForce {
            normal,
            tangential: self.tangential_force(&mut memory.length, limit, velocity, time_step),
            arm: one + arms.torque * contact.overlap,
        }
    }
}

/// Component of `vector` along `normal`.
#[inline(always)]
pub(super) fn along<R: Real>(normal: [R; 2], vector: [R; 2]) -> R {
    normal[0] * vector[0] + normal[1] * vector[1]
}

/// Component of `vector` along t = (−n_y, n_x).
#[inline(always)]
pub(super) fn tangential<R: Real>(normal: [R; 2], vector: [R; 2]) -> R {
    normal[0] * vector[1] - normal[1] * vector[0]
}

#[cfg(test)]
mod tests {
    use super::*;

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
                ..ContactConvention::PAPER.law(2.5)
            },
            coulomb_operand,
            sliding_spring,
            ..SpringDashpot::like(1.0, &ContactConvention::PAPER, 2.5)
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
            law.transport(CONTACT.normal, turned)
        };
        let half_square = 0.5 * turn * turn;
        assert_eq!(factor(HistoryUpdate::Rotated), 1.0);
        assert!((factor(HistoryUpdate::Projected) - 1.0 + half_square).abs() < 1e-12);
        assert!((factor(HistoryUpdate::Linearised) - 1.0 - half_square).abs() < 1e-12);
    }

    #[test]
    fn a_force_is_put_together_from_its_components_and_taken_apart_into_them() {
        let normal = [0.6, 0.8];
        let force = ContactForce {
            normal: 2.0,
            tangential: 5.0,
            arm: 1.0,
        };
        // 2 n + 5 t with t = (-0.8, 0.6).
        let vector: [f64; 2] = force.in_the_plane(normal);
        assert!((vector[0] + 2.8).abs() < 1e-15 && (vector[1] - 4.6).abs() < 1e-15);
        assert!((along(normal, vector) - 2.0).abs() < 1e-15);
        assert!((tangential(normal, vector) - 5.0).abs() < 1e-15);
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
}
