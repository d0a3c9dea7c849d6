//! Work of a closed cycle in overlap and tangential displacement, which shows whether a contact returns more energy
//! than it received.

use crate::model::ContactLaw;

/// What comes first in a cycle between two overlaps: the shear or the pressing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CycleOrder {
    /// Sheared at the lower overlap, pressed, sheared back at the higher one, released.
    ShearedFirst,
    /// Pressed, sheared at the higher overlap, released, sheared back at the lower one.
    PressedFirst,
}

impl CycleOrder {
    /// Both orders.
    pub const ALL: [Self; 2] = [Self::ShearedFirst, Self::PressedFirst];
}

/// Returns the work done on a contact of `law` in a cycle between the overlaps `low` and `high`, divided by the energy
/// k_t u²/2 of its spring at the higher overlap. The shear is so small that the contact neither slides nor turns.
/// Positive work is lost; negative work is energy created from nothing.
///
/// W = (k_1 + k_2)u²/2 − Q u, where Q is the force of the spring after the change of the overlap (docs/theory.md,
/// section 11.6).
pub fn cycle_work(law: &ContactLaw, [low, high]: [f64; 2], order: CycleOrder) -> f64 {
    let [soft, stiff] = [low, high].map(|overlap| law.at(overlap).tangential_stiffness);
    let shrunk = match law.history.is_rescaled() {
        true => (low / high).sqrt(),
        false => 1.0,
    };
    let force = match (order, law.history.keeps_force()) {
        (CycleOrder::ShearedFirst, true) => soft,
        (CycleOrder::ShearedFirst, false) => stiff,
        (CycleOrder::PressedFirst, true) => stiff * shrunk,
        (CycleOrder::PressedFirst, false) => soft * shrunk,
    };
    (soft + stiff - 2.0 * force) / stiff
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ContactConvention, Law, TangentialHistory};

    #[test]
    fn only_a_rescaled_force_makes_no_energy_in_either_order() {
        for history in TangentialHistory::ALL {
            let law = Law {
                history,
                ..Law::HERTZ
            };
            let law = ContactConvention::with_law(law).law(1.25);
            let work = CycleOrder::ALL.map(|order| cycle_work(&law, [0.05, 0.2], order));
            // k_t doubles from the lower overlap to the higher.
            let expected = match history {
                TangentialHistory::Displacement => [-0.5, 0.5],
                TangentialHistory::Force => [0.5, -0.5],
                TangentialHistory::DisplacementRescaled => [-0.5, 1.0],
                TangentialHistory::ForceRescaled => [0.5, 0.5],
            };
            for (work, expected) in work.into_iter().zip(expected) {
                assert!((work - expected).abs() < 1e-15, "{history} {work}");
            }
        }
    }

    #[test]
    fn a_spring_of_constant_stiffness_gives_back_what_it_was_given() {
        let law = ContactConvention::TURNING.law(2.5);
        for order in CycleOrder::ALL {
            assert_eq!(cycle_work(&law, [0.05, 0.2], order), 0.0);
        }
    }
}
