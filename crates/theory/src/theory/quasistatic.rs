//! The exact quasi-static limit of the paper's DEM (arms 0): the closed form with all its events.

use super::events::{Path, PathPoint};
use super::floor_slip::FloorSlip;
use super::limit::Limit;
use super::overlap::{HIGHEST_TANGENT, OverlapCurve};
use super::root::bracketed_root;
use crate::model::{Ring, Stack};

const STATIONS: usize = 256;
const EARLY_STATIONS: i32 = 24;

/// The path of equilibria, with T − μ_c as its parameter (docs/theory.md, Eqs. 14, 31 and 101; Eq. 10 on the gravity
/// ramp).
pub(super) struct ClosedForm {
    epsilon: f64,
    ring: Ring,
    curve: OverlapCurve,
    end: f64,
}

impl ClosedForm {
    /// The whole path, up to T = 1.
    pub(super) fn whole(stack: &Stack) -> Self {
        let curve = OverlapCurve::from_just_touching(stack);
        Self {
            epsilon: stack.epsilon(),
            ring: stack.ring(),
            curve,
            end: HIGHEST_TANGENT - curve.start,
        }
    }
}

impl Path for ClosedForm {
    /// Evenly spaced stations, and closer and closer ones towards the start: near κ = (2 + √3)/(2√3) the bottom
    /// cylinders touch for a short while before they part.
    fn stations(&self) -> Vec<f64> {
        let spacing = self.end / STATIONS as f64;
        let early = (1..=EARLY_STATIONS)
            .rev()
            .map(|halvings| spacing * 0.5f64.powi(halvings));
        let even = (1..=STATIONS).map(|index| spacing * index as f64);
        early.chain(even).collect()
    }

    fn settled(&self) -> f64 {
        let excess = |beyond| self.ring.bodies * self.curve.overlap(beyond) - self.epsilon;
        let widest = HIGHEST_TANGENT - self.curve.start;
        bracketed_root(excess, 0.0, widest).unwrap_or(widest)
    }

    fn point(&self, parameter: f64) -> PathPoint {
        let ring = &self.ring;
        let tangent = ring.critical_friction + parameter;
        let overlap = self.curve.overlap(parameter);
        let wall_force = (ring.bodies * overlap - self.epsilon).max(0.0);
        let floor_overlap = ((ring.bodies + 1.0) * overlap).min(overlap + self.epsilon);
        let geometric = ring.radius * parameter * (ring.critical_friction.recip() - tangent);
        PathPoint {
            tangent,
            pair_overlap: overlap,
            floor_overlap,
            floor_force: floor_overlap,
            outward: (geometric - 2.0 * overlap * tangent) / (1.0 + tangent * tangent),
            pair_ratio: tangent,
            pair_friction: tangent,
            floor_ratio: overlap * tangent / floor_overlap,
            bottom_force: 0.0,
            wall_force,
            wall_overlap: wall_force,
        }
    }
}

/// The exact limit of `stack` with the paper's arms.
pub fn closed_form_limit(stack: &Stack) -> Limit {
    let mut path = ClosedForm::whole(stack);
    let slip = FloorSlip::on(&path.curve, stack).map(|slip| slip.beyond);
    path.end = slip.unwrap_or(path.end);
    Limit::of(&path, slip, stack)
}

#[cfg(test)]
mod tests {
    use super::super::events::{Event, locate, locate_until};
    use super::*;

    #[test]
    fn centres_are_where_the_overlaps_leave_them() {
        let path = ClosedForm::whole(&Stack::paper(0.3, 1e2));
        let point = path.point(0.2);
        let [right, top, bottom] = point.positions(&path.ring);
        assert_eq!(bottom, 1.0 - point.floor_overlap);
        let distance = 2.0 - point.pair_overlap;
        assert!((libm::hypot(right, top - bottom) - distance).abs() < 1e-14);
        // T = tan(ψ/2) with the angle ψ of the line of centres to the vertical.
        let sine = 2.0 * point.tangent / (1.0 + point.tangent * point.tangent);
        assert!((right - distance * sine).abs() < 1e-14);
    }

    #[test]
    fn nothing_is_looked_for_beyond_the_stretch_of_the_end() {
        let stack = Stack::paper(0.3, 1e2);
        let path = ClosedForm::whole(&stack);
        let slip = locate(&path, Event::FloorSlip, &stack).unwrap();
        let until = |end| locate_until(&path, [Event::FloorSlip, Event::None], &stack, end);
        assert_eq!(until(0.5 * slip), [None; 2]);
        assert_eq!(until(2.0 * slip), [Some(slip), None]);
    }

    #[test]
    fn a_path_ends_where_the_angle_is_right_even_if_gravity_is_not_complete() {
        let path = ClosedForm::whole(&Stack::paper(0.3, 0.05));
        let widest = HIGHEST_TANGENT - path.curve.start;
        assert_eq!(path.stations().last(), Some(&widest));
        assert_eq!(path.settled(), widest);
        assert_eq!(path.point(widest).wall_force, 0.0);
    }

    #[test]
    fn bottom_cylinders_part_only_above_a_stiffness_ratio() {
        // dx₂/dT at T = μ_c vanishes for κ = 1/(1 − μ_c²) (docs/theory.md, Eqs. 53, 54 and 105).
        for bodies in 2..=5 {
            let outward = |nearness: f64| {
                let mut stack = Stack {
                    bodies,
                    ..Stack::paper(0.3, 1e6)
                };
                let critical = stack.ring().critical_friction;
                stack.stiffness_ratio = nearness / (1.0 - critical * critical);
                ClosedForm::whole(&stack).point(1e-9).outward
            };
            assert!(outward(1.001) > 0.0);
            assert!(outward(0.999) < 0.0);
        }
    }

    #[test]
    fn stations_are_even_and_crowd_towards_the_start() {
        let mut path = ClosedForm::whole(&Stack::paper(0.3, 1e2));
        path.end = 0.512;
        let stations = path.stations();
        assert_eq!(stations.len(), 280);
        assert!(stations.windows(2).all(|pair| pair[1] > pair[0]));
        assert_eq!((stations[0], stations[23]), (0.002 / 16_777_216.0, 0.001));
        assert_eq!((stations[24], stations[279]), (0.002, 0.512));
    }

    #[test]
    fn gravity_is_complete_where_cylinder_1_weighs_on_both_others() {
        let path = ClosedForm::whole(&Stack::paper(0.3, 1e2));
        let settled = path.point(path.settled());
        assert!(
            (settled.pair_overlap / 0.005 - 1.0).abs() < 1e-14,
            "a = m g/2"
        );
        assert!(settled.wall_force.abs() < 1e-16);
        assert!(
            (settled.floor_overlap / 0.015 - 1.0).abs() < 1e-14,
            "d = 3 m g/2"
        );
        // Half-way up the ramp the floor contact carries three times the force of the pair contact.
        let below = path.point(0.5 * path.settled());
        assert_eq!(below.wall_force, 0.0);
        assert_eq!(below.floor_overlap, 3.0 * below.pair_overlap);
        assert!((below.floor_ratio - below.tangent / 3.0).abs() < 1e-15);
        let above = path.point(2.0 * path.settled());
        assert_eq!(above.floor_overlap, above.pair_overlap + 0.01);
        assert_eq!(above.wall_force, 2.0 * above.pair_overlap - 0.01);
    }
}
