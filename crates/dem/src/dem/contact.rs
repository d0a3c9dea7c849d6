//! What a contact law takes, gives and remembers, and the law of springs and dashpots; its forces are in
//! [`equations`](super::equations).

use super::geometry::{Geometry, Linear, Plane};
use super::real::{Composite, Real, composite};
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
