//! The contact law and the equations of a step, in the order in which the paper states them ("Numerical results"): the
//! motion of a contact, its normal and tangential force, the loads on both bodies, and the leapfrog step (supplement).
//!
//! Lengths are in r, masses in m and stiffnesses in k_n. Contacts of other powers act through the same springs and
//! dashpots, whose coefficients they choose at each overlap ([`PowerLaw`](super::PowerLaw)).

use super::body::{Body, Load, Touch};
use super::geometry::{Geometry, Linear, Plane, Tangential};
use super::real::{Composite, Real, composite};
use super::wall::PlaneWall;
use crate::model::{
    Arms, ContactArms, ContactConvention, ContactLaw, CoulombOperand, HistoryUpdate, SlidingSpring,
    TensileForce,
};

/// The second body of a contact; the first is a cylinder or sphere.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Counterpart {
    /// Another cylinder or sphere.
    Cylinder,
    /// A plane wall.
    Wall,
}

/// A contact between two bodies at one moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact<R: Real, G: Geometry<R> = Plane> {
    /// The second body.
    pub counterpart: Counterpart,
    /// Unit normal, towards the first body.
    pub normal: G::Vector,
    /// Overlap δ.
    pub overlap: R,
    /// Velocity along the normal of the first centre relative to the second body.
    pub separation_speed: R,
    /// Relative velocity in the tangent plane; in the plane, its component along t = (−n_y, n_x).
    pub sliding_speed: G::Tangent,
    /// Sum of the angular velocities of the two bodies.
    pub spin: G::Rotation,
    /// Friction coefficient.
    pub friction: R,
    /// Time step.
    pub time_step: R,
}

/// The force of a contact on its first body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactForce<R: Real, G: Geometry<R> = Plane> {
    /// Normal force, positive in compression.
    pub normal: R,
    /// Tangential force; in the plane, its component along t = (−n_y, n_x).
    pub tangential: G::Tangent,
    /// Torque arm R; the torque on either body is −R times n × the tangential force.
    pub arm: R,
}

impl<R: Real, G: Geometry<R>> Composite<R> for ContactForce<R, G> {
    #[inline(always)]
    fn visit(&mut self, other: &Self, visit: &mut impl FnMut(&mut R, &R)) {
        self.normal.visit(&other.normal, visit);
        self.tangential.visit(&other.tangential, visit);
        self.arm.visit(&other.arm, visit);
    }
}

impl<R: Real, G: Geometry<R>> ContactForce<R, G> {
    /// A force with these components and this torque arm.
    #[inline(always)]
    pub fn new(normal: R, tangential: G::Tangent, arm: R) -> Self {
        Self {
            normal,
            tangential,
            arm,
        }
    }

    /// Zero force, in numbers like `number`.
    #[inline(always)]
    pub fn none(number: R) -> Self {
        let zero = number.like(0.0);
        Self {
            normal: zero,
            tangential: G::no_tangent(zero),
            arm: zero,
        }
    }
}

/// A law that gives the force of a contact from its motion, step by step.
pub trait ContactModel<R: Real, G: Geometry<R> = Plane>: Copy {
    /// State of a contact that is carried from one step to the next.
    type Memory: Copy + Composite<R>;

    /// Memory of an undeformed contact, in numbers like `number`.
    fn initial(&self, number: R) -> Self::Memory;

    /// Returns the force of `contact` and advances its memory to the present.
    fn evaluate(&self, contact: &Contact<R, G>, memory: &mut Self::Memory) -> ContactForce<R, G>;
}

/// A contact law that can be built from a convention.
pub(super) trait ConventionalModel<R: Real, G: Geometry<R> = Plane>:
    ContactModel<R, G> + Composite<R>
{
    /// The law of `convention` at stiffness ratio κ, in numbers like `number`.
    fn of_convention(number: R, convention: &ContactConvention, stiffness_ratio: f64) -> Self;
}

impl<R: Real, G: Geometry<R>> ConventionalModel<R, G> for SpringDashpot<R> {
    fn of_convention(number: R, convention: &ContactConvention, stiffness_ratio: f64) -> Self {
        Self::like(number, convention, stiffness_ratio)
    }
}

/// The paper's contact law, with the variations in convention that occur in other codes.
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
    SpringDashpot { arms, law } beside {
        coulomb_operand,
        sliding_spring,
        history_update,
        tensile_force
    },
    Arms { pair, floor },
    ContactArms { torque, kinematic },
    ContactLaw {
        normal_stiffness,
        tangential_stiffness,
        damping_normal,
        damping_tangential
    } beside {
        power,
        stiffens,
        damping,
        history
    },
);

/// Memory of a [`SpringDashpot`] contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring<R: Real, G: Geometry<R> = Plane> {
    /// u, tangential displacement accumulated while the contact sticks.
    pub length: G::Tangent,
    /// Normal of the contact when u was last updated. For contacts between cylinders in the plane whose springs do not
    /// turn, this is u itself as a vector, in place of `length`, which is measured along a tangent that turns.
    pub normal: G::Vector,
}

impl<R: Real, G: Geometry<R>> Spring<R, G> {
    /// The spring of a new contact, in numbers like `number`.
    #[inline(always)]
    pub(super) fn unstretched(number: R) -> Self {
        Self {
            length: G::no_tangent(number),
            normal: G::vector([number.like(0.0); 3]),
        }
    }

    /// Applies `of` to every component of u, for a spring that follows `update`.
    #[inline(always)]
    pub(super) fn change(&mut self, update: HistoryUpdate, of: impl Fn(R) -> R) {
        self.length = self.length.with(self.length, |part, _| of(part));
        if update == HistoryUpdate::Fixed {
            self.normal = self.normal.with(self.normal, |part, _| of(part));
        }
    }
}

impl<R: Real, G: Geometry<R>> Composite<R> for Spring<R, G> {
    #[inline(always)]
    fn visit(&mut self, other: &Self, visit: &mut impl FnMut(&mut R, &R)) {
        self.length.visit(&other.length, visit);
        self.normal.visit(&other.normal, visit);
    }
}

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
}

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
pub(super) mod tests;
