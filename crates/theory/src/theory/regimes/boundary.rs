//! Boundaries of the regime map in the floor friction, at given stiffness, stiffness ratio and cylinder
//! friction.

use super::super::events::Event;
use super::equilibrium_path::EquilibriumPath;
use crate::model::Stack;

/// A floor friction at which the outcome changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Boundary {
    /// The floor friction μ.
    pub floor_friction: f64,
    /// The event that ends the path at slightly less friction.
    pub below: Event,
    /// The event that ends the path at slightly more friction.
    pub above: Event,
}

impl Boundary {
    /// Returns every boundary in μ of stacks like `stack` on their `path`, lowest first.
    ///
    /// Up to the largest e/d along the gravity ramp, the floor slips under own weight. Above the largest e/d up to the
    /// next other event, that event comes before floor slip. There is no boundary where the cylinders slip under own
    /// weight: the stack then falls whatever the floor friction.
    pub fn in_friction(path: &EquilibriumPath, stack: &Stack) -> Vec<Self> {
        let slip = path.locate(Event::CylinderSlip, stack);
        let Some((above, end)) = earlier(slip, path.wall_contact()) else {
            return Vec::new();
        };
        let slips = |floor_friction, above| Self {
            floor_friction,
            below: Event::FloorSlip,
            above,
        };
        let settled = path.settled();
        if end <= settled {
            return Vec::new();
        }
        let needed = |until: f64| path.largest_until(until, |point| point.floor_ratio);
        vec![
            slips(needed(settled), Event::FloorSlip),
            slips(needed(end), above),
        ]
    }
}

/// Returns cylinder slip or wall contact, whichever comes first.
fn earlier(slip: Option<f64>, wall: Option<f64>) -> Option<(Event, f64)> {
    match (slip, wall) {
        (Some(slip), Some(wall)) if slip > wall => Some((Event::WallContact, wall)),
        (Some(slip), _) => Some((Event::CylinderSlip, slip)),
        (None, wall) => wall.map(|wall| (Event::WallContact, wall)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::HistoryUpdate;

    #[test]
    fn of_slip_and_wall_contact_the_first_counts_and_slip_if_both_come_at_once() {
        assert_eq!(
            earlier(Some(2.0), Some(1.0)),
            Some((Event::WallContact, 1.0))
        );
        assert_eq!(
            earlier(Some(1.0), Some(2.0)),
            Some((Event::CylinderSlip, 1.0))
        );
        assert_eq!(
            earlier(Some(1.0), Some(1.0)),
            Some((Event::CylinderSlip, 1.0))
        );
        assert_eq!(earlier(Some(1.0), None), Some((Event::CylinderSlip, 1.0)));
        assert_eq!(earlier(None, Some(1.0)), Some((Event::WallContact, 1.0)));
        assert_eq!(earlier(None, None), None);
    }

    #[test]
    fn cylinders_that_slip_under_own_weight_leave_no_boundary() {
        let stack = Stack {
            cylinder_friction: 0.26,
            ..Stack::paper(0.3, 1e2)
        };
        let path = EquilibriumPath::new(&stack, HistoryUpdate::Rotated);
        assert_eq!(Boundary::in_friction(&path, &stack), []);
    }
}
