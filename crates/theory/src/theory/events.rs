//! The four events that can end the path of equilibria, and which of them comes first (docs/theory.md, Eq. 43).

use super::root::bracketed_root;
use crate::model::{Ring, Stack};
use serde::{Deserialize, Serialize};

/// The first event of a stack under increasing load.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Event {
    /// The bottom cylinders slide on the floor, e = μ d: the paper's yield.
    FloorSlip,
    /// The top cylinder slides on the bottom ones, b = μ_d a.
    CylinderSlip,
    /// The bottom cylinders touch, x₂ = r: c = 0 no longer holds.
    ContactCloses,
    /// The top wall reaches the top of cylinder 2.
    WallContact,
    /// The path ends before any event.
    #[default]
    None,
}

impl std::fmt::Display for Event {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(match self {
            Self::FloorSlip => "floor-slip",
            Self::CylinderSlip => "cylinder-slip",
            Self::ContactCloses => "contact-closes",
            Self::WallContact => "wall-contact",
            Self::None => "none",
        })
    }
}

/// A state of equilibrium on the path, reduced to what the events need. Lengths in r, forces in k_n r.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathPoint {
    /// T = tan(ψ/2), where ψ is the angle between the line 2–1 and the vertical.
    pub tangent: f64,
    /// G, overlap of the contact 1–2.
    pub pair_overlap: f64,
    /// z, overlap of the floor contacts.
    pub floor_overlap: f64,
    /// d, normal force of the floor contacts.
    pub floor_force: f64,
    /// y = x₂ − x₀, how far cylinder 2 has moved outwards.
    pub outward: f64,
    /// b/a, tangential over normal force of the contact 1–2.
    pub pair_ratio: f64,
    /// The friction that this contact needs: b/a, or |q|/a where the spring does not turn, with q its whole force.
    pub pair_friction: f64,
    /// e/d, tangential over normal force of the floor contacts.
    pub floor_ratio: f64,
    /// c, force between the bottom cylinders.
    pub bottom_force: f64,
    /// Force of the top wall, ε F.
    pub wall_force: f64,
    /// Overlap of cylinder 1 and the top wall.
    pub wall_overlap: f64,
}

impl PathPoint {
    /// Height of the centre of cylinder 1 above that of cylinder 2, ρ cos ψ.
    fn rise(&self) -> f64 {
        let square = self.tangent * self.tangent;
        (2.0 - self.pair_overlap) * (1.0 - square) / (1.0 + square)
    }

    /// Height of the top wall, y₁ + r less its overlap, with the floor at 0 (docs/theory.md, Eq. 32).
    pub fn wall_height(&self) -> f64 {
        2.0 - self.floor_overlap + self.rise() - self.wall_overlap
    }

    /// Returns x₂, y₁ and y₂, with the floor at 0.
    pub(super) fn positions(&self, ring: &Ring) -> [f64; 3] {
        let height = 1.0 - self.floor_overlap;
        [ring.radius + self.outward, height + self.rise(), height]
    }

    /// Returns the distance to `event`, in the units of its criterion; negative once it has happened.
    pub(super) fn margin(&self, event: Event, stack: &Stack) -> f64 {
        match event {
            Event::FloorSlip => stack.floor_friction - self.floor_ratio,
            Event::CylinderSlip => stack.cylinder_friction - self.pair_friction,
            Event::ContactCloses => self.outward,
            Event::WallContact => self.rise() - self.wall_overlap,
            Event::None => f64::INFINITY,
        }
    }
}

/// A path of equilibria from the stress-free state (parameter 0) upwards, first along the gravity ramp,
/// then under the wall.
pub trait Path {
    /// Increasing parameters, without 0, at which the path is searched for events.
    fn stations(&self) -> Vec<f64>;
    /// The parameter at which gravity is complete and the wall just touches, F = 0.
    fn settled(&self) -> f64;
    /// The state at a parameter between 0 and the last station.
    fn point(&self, parameter: f64) -> PathPoint;
}

/// Returns the parameter at which `event` first happens on `path`; 0 if it has happened by the first station.
pub(crate) fn locate(path: &(impl Path + ?Sized), event: Event, stack: &Stack) -> Option<f64> {
    let [located] = locate_until(path, [event], stack, f64::INFINITY);
    located
}

/// Locates several events with one search of the stations. The search stops at the first station at or beyond `end`;
/// events found by then are returned.
pub(super) fn locate_until<const N: usize>(
    path: &(impl Path + ?Sized),
    events: [Event; N],
    stack: &Stack,
    end: f64,
) -> [Option<f64>; N] {
    let stations = path.stations();
    let mut passed = [None; N];
    for (index, &parameter) in stations.iter().enumerate() {
        let point = path.point(parameter);
        for (passed, event) in passed.iter_mut().zip(events) {
            if passed.is_none() && point.margin(event, stack) < 0.0 {
                *passed = Some(index);
            }
        }
        if parameter >= end || passed.iter().all(Option::is_some) {
            break;
        }
    }
    std::array::from_fn(|event| match passed[event]? {
        0 => Some(0.0),
        index => {
            let margin = |parameter: f64| path.point(parameter).margin(events[event], stack);
            bracketed_root(margin, stations[index - 1], stations[index])
        }
    })
}

/// y = ρ sin ψ − x₀ at an angle `turned` beyond ψ₀, free of cancellation for small angles (docs/theory.md,
/// Eqs. 30 and 100).
pub(super) fn outward_displacement(ring: &Ring, turned: f64, pair_overlap: f64) -> f64 {
    let half_sine = libm::sin(0.5 * turned);
    let sine = libm::sin(turned);
    let geometric = ring.rise * sine - ring.radius * 2.0 * half_sine * half_sine;
    geometric - 0.5 * pair_overlap * (ring.radius + geometric)
}

/// T = tan((ψ₀ + turned)/2) at an angle `turned` beyond ψ₀ (docs/theory.md, Eq. 30).
pub(super) fn half_angle_tangent(ring: &Ring, turned: f64) -> f64 {
    let half = libm::tan(0.5 * turned);
    (ring.critical_friction + half) / (1.0 - ring.critical_friction * half)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rings() -> impl Iterator<Item = Ring> {
        let stack = |bodies| Stack {
            bodies,
            ..Stack::paper(0.3, 1e2)
        };
        (2..=5).map(move |bodies| stack(bodies).ring())
    }

    #[test]
    fn outward_displacement_is_the_geometry_it_abbreviates() {
        let (turned, overlap) = (0.37, 0.21);
        for ring in rings() {
            let direct = (2.0 - overlap) * (ring.angle + turned).sin() - ring.radius;
            let outward = outward_displacement(&ring, turned, overlap);
            assert!((outward - direct).abs() < 1e-15);
        }
    }

    #[test]
    fn tangent_of_the_undeformed_stack_is_the_critical_friction() {
        for ring in rings() {
            assert_eq!(half_angle_tangent(&ring, 0.0), ring.critical_friction);
            let angle = ring.angle + 0.3;
            assert!((half_angle_tangent(&ring, 0.3) - (angle / 2.0).tan()).abs() < 1e-15);
        }
    }

    /// A path on which the floor ratio is half the parameter.
    struct Straight;

    impl Path for Straight {
        fn stations(&self) -> Vec<f64> {
            vec![1.0, 2.0, 4.0]
        }

        fn settled(&self) -> f64 {
            1.0
        }

        fn point(&self, parameter: f64) -> PathPoint {
            PathPoint {
                floor_ratio: 0.5 * parameter,
                ..POINT
            }
        }
    }

    const POINT: PathPoint = PathPoint {
        tangent: 0.3,
        pair_overlap: 0.02,
        floor_overlap: 0.03,
        floor_force: 0.03,
        outward: 0.04,
        pair_ratio: 0.5,
        pair_friction: 0.5,
        floor_ratio: 0.25,
        bottom_force: 0.0,
        wall_force: 0.01,
        wall_overlap: 0.01,
    };

    #[test]
    fn the_wall_lies_on_the_top_of_cylinder_1() {
        let angle = 2.0 * 0.3f64.atan();
        let (centre_2, rise) = (1.0 - 0.03, (2.0 - 0.02) * angle.cos());
        let top_of_cylinder_1 = centre_2 + rise + 1.0;
        assert!((POINT.wall_height() - (top_of_cylinder_1 - 0.01)).abs() < 1e-15);
        // The wall reaches cylinder 2 when it is as high as the top of that cylinder.
        let stack = Stack::paper(0.3, 1e2);
        let margin = POINT.margin(Event::WallContact, &stack);
        assert!((POINT.wall_height() - (centre_2 + 1.0) - margin).abs() < 1e-15);
    }

    #[test]
    fn a_friction_that_is_just_needed_leaves_no_margin() {
        let stack = Stack {
            cylinder_friction: 0.625,
            ..Stack::paper(0.5, 1e2)
        };
        let margin = |event| POINT.margin(event, &stack);
        assert_eq!(margin(Event::FloorSlip), 0.25);
        assert_eq!(margin(Event::CylinderSlip), 0.125);
        assert_eq!(margin(Event::ContactCloses), 0.04);
        assert_eq!(margin(Event::None), f64::INFINITY);
    }

    #[test]
    fn events_are_found_between_stations_and_from_the_start() {
        let with = |friction| locate(&Straight, Event::FloorSlip, &Stack::paper(friction, 1e2));
        assert_eq!(with(0.75), Some(1.5));
        assert_eq!(with(1.5), Some(3.0));
        assert_eq!(with(2.5), None);
        assert_eq!(with(0.4), Some(0.0));
        // An event that is just reached at the first station has not happened from the start.
        assert_eq!(with(0.5), Some(1.0));
    }

    #[test]
    fn the_name_of_an_event_is_the_same_in_tables_and_files() {
        for (event, name) in [
            (Event::FloorSlip, "floor-slip"),
            (Event::CylinderSlip, "cylinder-slip"),
            (Event::ContactCloses, "contact-closes"),
            (Event::WallContact, "wall-contact"),
            (Event::None, "none"),
        ] {
            assert_eq!(event.to_string(), name);
            assert_eq!(serde_json::to_value(event).unwrap(), name);
        }
    }
}
