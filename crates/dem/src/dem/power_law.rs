//! Contacts whose stiffness grows with the overlap. At each overlap they act like springs and dashpots.

use super::contact::{
    Contact, ContactForce, ContactModel, ConventionalModel, Counterpart, Spring, SpringDashpot,
};
use super::geometry::{Geometry, Plane};
use super::real::{Composite, Real, composite};
use crate::model::{ContactConvention, ContactLaw};

/// The contact law of any power, with the conventions in which codes differ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerLaw<R> {
    /// Contacts between cylinders, and the conventions of every contact.
    pub pair: SpringDashpot<R>,
    /// Contacts with walls.
    pub wall: ContactLaw<R>,
}

/// Memory of a [`PowerLaw`] contact.
#[derive(Debug, Clone, Copy)]
pub struct LoadedSpring<R: Real, G: Geometry<R> = Plane> {
    /// The spring. Its `length` is the displacement u, or k_t u if the spring remembers the force.
    pub spring: Spring<R, G>,
    /// Overlap in the last step; 0 for a new contact.
    pub overlap: R,
}

composite!(PowerLaw { pair, wall });

impl<R: Real, G: Geometry<R>> Composite<R> for LoadedSpring<R, G> {
    #[inline(always)]
    fn visit(&mut self, other: &Self, visit: &mut impl FnMut(&mut R, &R)) {
        self.spring.visit(&other.spring, visit);
        self.overlap.visit(&other.overlap, visit);
    }
}

impl<R: Real, G: Geometry<R>> ConventionalModel<R, G> for PowerLaw<R> {
    fn of_convention(number: R, convention: &ContactConvention, stiffness_ratio: f64) -> Self {
        let wall = convention.wall_law(stiffness_ratio);
        Self {
            pair: SpringDashpot::like(number, convention, stiffness_ratio),
            wall: wall.map(|coefficient| number.like(coefficient)),
        }
    }
}

impl<R: Real> PowerLaw<R> {
    fn law(&self, counterpart: Counterpart) -> &ContactLaw<R> {
        match counterpart {
            Counterpart::Cylinder => &self.pair.law,
            Counterpart::Wall => &self.wall,
        }
    }
}

impl<R: Real, G: Geometry<R>> ContactModel<R, G> for PowerLaw<R> {
    type Memory = LoadedSpring<R, G>;

    #[inline(always)]
    fn initial(&self, number: R) -> LoadedSpring<R, G> {
        LoadedSpring {
            spring: self.pair.initial(number),
            overlap: number.like(0.0),
        }
    }

    #[inline(always)]
    fn evaluate(
        &self,
        contact: &Contact<R, G>,
        memory: &mut LoadedSpring<R, G>,
    ) -> ContactForce<R, G> {
        let (law, overlap) = (self.law(contact.counterpart), contact.overlap);
        let two = overlap.like(2.0);
        let own = law.coefficients(overlap, R::sqrt, |overlap| two / (two - overlap));
        let springs = SpringDashpot {
            law: ContactLaw {
                tangential_stiffness: own.tangential_stiffness,
                damping_normal: own.damping_normal,
                damping_tangential: own.damping_tangential,
                ..*law
            },
            ..self.pair
        };
        let LoadedSpring {
            spring,
            overlap: last,
        } = memory;
        if law.history.is_rescaled() {
            let shrinks = overlap.less(*last);
            let one = overlap.like(1.0);
            let factor = R::select(shrinks, (overlap / *last).sqrt(), one);
            spring.change(self.pair.history_update, |part| part * factor);
            *last = overlap;
        }
        if !law.history.keeps_force() {
            return springs.exert(contact, own.secant * overlap, spring);
        }
        // The remembered force grows by k_t du: it is converted to a displacement at the present stiffness, and back.
        spring.change(self.pair.history_update, |part| {
            part / own.tangential_stiffness
        });
        let force = springs.exert(contact, own.secant * overlap, spring);
        spring.change(self.pair.history_update, |part| {
            part * own.tangential_stiffness
        });
        force
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::contact::tests::CONTACT;
    use crate::model::{Law, Power, TangentialHistory, TangentialStiffening};

    const TIME_STEP: f64 = 0.1;

    fn of(law: Law) -> PowerLaw<f64> {
        let convention = ContactConvention::with_law(law);
        ConventionalModel::<f64>::of_convention(0.0, &convention, 2.0)
    }

    fn contact(overlap: f64, sliding_speed: f64) -> Contact<f64> {
        Contact {
            overlap,
            sliding_speed,
            friction: 10.0,
            time_step: TIME_STEP,
            ..CONTACT
        }
    }

    /// Returns the tangential force at rest at each further overlap, after the surfaces have moved by `moved` at the
    /// first one.
    fn forces(law: Law, moved: f64, overlaps: &[f64]) -> Vec<f64> {
        let model = of(law);
        let mut memory = model.initial(0.0);
        model.evaluate(&contact(overlaps[0], moved / TIME_STEP), &mut memory);
        let further = overlaps[1..].iter();
        further
            .map(|&overlap| {
                model
                    .evaluate(&contact(overlap, 0.0), &mut memory)
                    .tangential
            })
            .collect()
    }

    #[test]
    fn the_linear_law_as_a_power_has_the_bits_of_springs_and_dashpots() {
        let linear = of(Law::LINEAR);
        let (mut own, mut springs) = (linear.initial(0.0), linear.pair.initial(0.0));
        for (overlap, speed) in [(0.1, 0.2), (0.17, -0.3), (0.05, 1.7)] {
            let contact = Contact {
                separation_speed: 0.3,
                ..contact(overlap, speed)
            };
            let force = linear.evaluate(&contact, &mut own);
            assert_eq!(force, linear.pair.evaluate(&contact, &mut springs));
        }
        assert_eq!(own.spring, springs);
    }

    #[test]
    fn normal_forces_are_those_of_the_model_at_every_power() {
        for power in Power::ALL {
            let law = Law {
                floor_ratio: 1.3,
                ..Law::of_power(power)
            };
            let convention = ContactConvention::with_law(law);
            let model = of(law);
            for overlap in [1e-5, 0.07, 0.3] {
                let mut touching = contact(overlap, 0.0);
                let wall = model.evaluate(&touching, &mut model.initial(0.0)).normal;
                touching.counterpart = Counterpart::Cylinder;
                let pair = model.evaluate(&touching, &mut model.initial(0.0)).normal;
                assert_eq!(wall, convention.wall_law(2.0).force(overlap));
                assert_eq!(pair, convention.law(2.0).force(overlap));
            }
        }
    }

    #[test]
    fn histories_differ_in_what_a_change_of_the_overlap_does() {
        // From 0.1 to 0.19 the stiffness grows by √1.9; from there to 0.05 the contact radius falls by √(0.05/0.19).
        let stiffness = |overlap: f64| 1.5 * std::f64::consts::SQRT_2 * overlap.sqrt() / 2.0;
        let (moved, overlaps) = (0.01, [0.1, 0.19, 0.05]);
        let released = (0.05f64 / 0.19).sqrt();
        let begun = -stiffness(0.1) * moved;
        let stretched = |overlap| -stiffness(overlap) * moved;
        for (history, expected) in [
            (
                TangentialHistory::Displacement,
                [stretched(0.19), stretched(0.05)],
            ),
            (TangentialHistory::Force, [begun, begun]),
            (
                TangentialHistory::DisplacementRescaled,
                [stretched(0.19), stretched(0.05) * released],
            ),
            (TangentialHistory::ForceRescaled, [begun, begun * released]),
        ] {
            let law = Law {
                history,
                ..Law::HERTZ
            };
            for (found, expected) in forces(law, moved, &overlaps).into_iter().zip(expected) {
                assert!(
                    (found / expected - 1.0).abs() < 1e-15,
                    "{history} {found} {expected}"
                );
            }
        }
    }

    #[test]
    fn a_stiffened_spring_is_stiffer_by_the_distance_of_the_centres() {
        let stiffened = Law {
            tangential_stiffening: TangentialStiffening::Every,
            ..Law::HERTZ
        };
        let [plain, stiff] = [Law::HERTZ, stiffened].map(|law| forces(law, 0.01, &[0.1, 0.1])[0]);
        assert!((stiff / plain - 2.0 / 1.9).abs() < 1e-15);
    }

    #[test]
    fn a_force_that_is_remembered_ends_at_the_limit_while_the_contact_slides() {
        use crate::model::{CoulombOperand, SlidingSpring};
        let law = Law {
            history: TangentialHistory::Force,
            ..Law::HERTZ
        };
        let mut model = of(law);
        model.pair.coulomb_operand = CoulombOperand::Spring;
        model.pair.sliding_spring = SlidingSpring::FollowsLimit;
        let mut memory = model.initial(0.0);
        let sliding = Contact {
            friction: 0.1,
            ..contact(0.1, 5.0)
        };
        let force = model.evaluate(&sliding, &mut memory);
        assert!((force.tangential + 0.1 * force.normal).abs() < 1e-17);
        assert!((memory.spring.length - 0.1 * force.normal).abs() < 1e-17);
    }
}
