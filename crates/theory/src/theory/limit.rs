//! The quasi-static limit as a result: the yield force, or what happens instead.

use super::events::{Event, Path, PathPoint, locate_until};
use crate::model::Stack;

/// The quasi-static limit of a stack. The default has no force, no event and no reason.
///
/// If contact 2–3 is closed when the floor starts to slide, the sliding relieves that contact, and the force rises
/// until it opens: onset and peak are then two forces. Where c = 0 at the onset they are the same.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Limit {
    /// The yield force F = f/(m g), which is the peak; absent when another event comes first.
    pub yield_force: Option<f64>,
    /// F at which the floor begins to slip under the wall.
    pub slip_onset: Option<f64>,
    /// The largest F.
    pub peak_force: Option<f64>,
    /// The first event on the path.
    pub event: Event,
    /// n, number of bodies on the floor.
    pub bodies: u8,
    /// F at which the floor slips if the other events are ignored. The closing of contact 2–3 is taken into account
    /// where the path beyond it was followed.
    pub floor_slip_force: Option<f64>,
    /// T = tan(ψ/2) where the floor slips.
    pub tangent: Option<f64>,
    /// y = x₂ − x₀, in r, where the floor slips.
    pub y: Option<f64>,
    /// z, how far cylinder 2 has sunk into the floor, in r, where the floor slips.
    pub z: Option<f64>,
    /// c, force between the bottom cylinders, in m g, where the floor slips.
    pub bottom_force: Option<f64>,
    /// Wall travel, in r, when the floor slips (docs/theory.md, Eq. 34).
    pub wall_travel: Option<f64>,
    /// Wall travel, in r, at the peak.
    pub peak_travel: Option<f64>,
    /// z at the peak.
    pub peak_z: Option<f64>,
    /// b/a where the floor slips, where b is the component along the tangent.
    pub pair_ratio: Option<f64>,
    /// The friction that the cylinders need until the floor slips: b/a, or |q|/a where springs do not turn, with q the
    /// whole force.
    pub pair_friction: Option<f64>,
    /// The stack at rest under its own weight: x₂, y₁ and y₂, in r; absent unless it stands without sliding.
    pub rest: Option<[f64; 3]>,
    /// √(m/k) of the stack at rest, in √(m/k_n), at least 1: how many times longer the stack takes to respond than
    /// with linear springs.
    pub time_scale: f64,
    /// Whether a run reaches this limit only if gravity was applied slowly. Either springs remember the loading path,
    /// and the limit is that of a gravity ramp on which all bodies gain weight together, or oscillations die away
    /// slowly.
    pub needs_slow_ramp: bool,
    /// Why there is no yield force.
    pub reason: Option<String>,
}

impl Limit {
    /// The limit of `stack` along `path` with c = 0, on which the floor slips at the parameter `slip`: under its
    /// own weight (docs/theory.md, Eq. 58) or under the wall, with F = n d/ε − (n + 1) (Eqs. 23 and 101).
    pub(super) fn of(path: &impl Path, slip: Option<f64>, stack: &Stack) -> Self {
        let others = [
            Event::CylinderSlip,
            Event::ContactCloses,
            Event::WallContact,
        ];
        Self::before(others, path, slip, stack)
    }

    /// The limit as by [`of`](Self::of), where `others` are the events that can end the path before the floor slips.
    pub(super) fn before<const N: usize>(
        others: [Event; N],
        path: &impl Path,
        slip: Option<f64>,
        stack: &Stack,
    ) -> Self {
        let settled = path.settled();
        let own_weight = slip.is_some_and(|slip| slip < settled);
        let ring = stack.ring();
        let force_at = |point: PathPoint| {
            ring.bodies * point.floor_force * stack.stiffness - stack.own_weight()
        };
        // A wall cannot pull: once its force has fallen below 0, it has left the stack.
        let slip = slip.filter(|&slip| own_weight || force_at(path.point(slip)) >= 0.0);
        let under_the_wall = slip.filter(|_| !own_weight);
        let event = first_event(others, path, slip, stack);
        let yields = under_the_wall.is_some() && event == Event::FloorSlip;
        let point = under_the_wall.map(|slip| path.point(slip));
        let force = point.map(force_at);
        let yield_force = force.filter(|_| yields);
        let wall_travel =
            point.map(|point| path.point(settled).wall_height() - point.wall_height());
        let z = point.map(|point| point.floor_overlap);
        Self {
            yield_force,
            slip_onset: yield_force,
            peak_force: yield_force,
            event,
            bodies: stack.bodies,
            floor_slip_force: force,
            tangent: point.map(|point| point.tangent),
            y: point.map(|point| point.outward),
            z,
            bottom_force: point.map(|point| point.bottom_force * stack.stiffness),
            wall_travel,
            peak_travel: wall_travel.filter(|_| yields),
            peak_z: z.filter(|_| yields),
            pair_ratio: point.map(|point| point.pair_ratio),
            pair_friction: point.map(|point| point.pair_friction),
            rest: (settled.is_finite() && !own_weight)
                .then(|| path.point(settled).positions(&ring)),
            time_scale: 1.0,
            needs_slow_ramp: false,
            reason: (!yields)
                .then(|| explanation(event, own_weight).replace("cylinders", stack.kind())),
        }
    }

    /// Wall travel to the slip onset, or to the peak if the stack began to slide under its own weight.
    pub fn travel_to_watch(&self) -> Option<f64> {
        self.wall_travel.or(self.peak_travel)
    }

    /// Whether the force rises further after the floor has begun to slip.
    pub fn rises_after_onset(&self) -> bool {
        self.slip_onset != self.peak_force
    }
}

fn first_event<const N: usize>(
    others: [Event; N],
    path: &impl Path,
    slip: Option<f64>,
    stack: &Stack,
) -> Event {
    let located = locate_until(path, others, stack, slip.unwrap_or(f64::INFINITY));
    let located = located.into_iter().zip(others);
    let candidates = located.chain([(slip, Event::FloorSlip)]);
    candidates
        .filter_map(|(parameter, event)| parameter.map(|parameter| (parameter, event)))
        .min_by(|left, right| left.0.total_cmp(&right.0))
        .map_or(Event::None, |(_, event)| event)
}

fn explanation(event: Event, own_weight: bool) -> String {
    let text = match event {
        Event::FloorSlip if own_weight => "the stack slides on the floor under its own weight",
        Event::FloorSlip => "the floor slips",
        Event::CylinderSlip => {
            "the cylinders slip on each other before the floor does (|q| = mu_d a)"
        }
        Event::ContactCloses => {
            "the bottom cylinders touch before the floor slips, so that c = 0 does not hold"
        }
        Event::WallContact => "the top wall reaches the bottom cylinders before the floor slips",
        Event::None => {
            "the path of equilibria, or the force of the wall, ends before the floor slips"
        }
    };
    text.to_owned()
}

#[cfg(test)]
mod tests {
    use super::super::root::bracketed_root;
    use super::super::{closed_form_limit, followed_limit, pair_overlap};
    use super::*;
    use crate::model::{Arms, CRITICAL_FRICTION, ContactConvention, Problem};

    #[test]
    fn a_limit_without_a_yield_force_says_why() {
        let stack = |mu, cylinder_friction, stiffness_ratio| Stack {
            cylinder_friction,
            stiffness_ratio,
            ..Stack::paper(mu, 1e2)
        };
        let reason = |stack: Stack| closed_form_limit(&stack).reason.unwrap();
        for (stack, part) in [
            (stack(0.05, 0.7, 2.5), "under its own weight"),
            (stack(0.5, 0.4, 2.5), "the cylinders slip on each other"),
            (stack(0.3, 0.7, 0.5), "the bottom cylinders touch"),
            (stack(0.6, 0.7, 2.5), "the top wall reaches"),
        ] {
            let reason = reason(stack);
            assert!(reason.contains(part), "{reason}");
        }
        let limit = closed_form_limit(&stack(0.3, 0.7, 2.5));
        assert_eq!(limit.reason, None);
        assert!(limit.rest.is_some() && !limit.rises_after_onset());
        assert_eq!(limit.travel_to_watch(), limit.wall_travel);
        assert!(limit.wall_travel.is_some_and(|travel| travel > 0.0));
        assert_eq!(closed_form_limit(&stack(0.05, 0.7, 2.5)).rest, None);
        assert!(explanation(Event::None, false).contains("the force of the wall, ends"));
        assert_eq!(explanation(Event::FloorSlip, false), "the floor slips");
    }

    #[test]
    fn a_stack_that_the_wall_has_left_before_the_floor_slips_has_no_yield_force() {
        // Found by a random search: hardly any tangential stiffness, and cylinders that do not slip.
        let stack = Stack {
            stiffness_ratio: 741.0,
            cylinder_friction: 127.0,
            ..Stack::paper(0.315, 230.0)
        };
        let convention = ContactConvention::with_arms(Arms::reciprocal(0.496, 0.824));
        let limit = followed_limit(&Problem::new(stack, convention).unwrap());
        assert_eq!(limit.event, Event::None);
        assert_eq!([limit.yield_force, limit.floor_slip_force], [None; 2]);
        assert!(
            limit
                .reason
                .is_some_and(|reason| reason.contains("the force of the wall"))
        );
    }

    #[test]
    fn the_wall_travels_from_the_settled_stack_to_the_slip() {
        let stack = Stack::paper(0.3, 1e2);
        let limit = closed_form_limit(&stack);
        // Top of cylinder 1, less its indentation by the wall: 1 − z + ρ cos ψ + 1 − ε F.
        let height = |tangent: f64, force: f64| {
            let overlap = pair_overlap(tangent - CRITICAL_FRICTION, stack.stiffness_ratio);
            let rise = (2.0 - overlap) * (2.0 * tangent.atan()).cos();
            2.0 - 0.5 * (force + 3.0) * stack.epsilon() + rise - force * stack.epsilon()
        };
        let excess = |beyond| 2.0 * pair_overlap(beyond, stack.stiffness_ratio) - stack.epsilon();
        let settled = CRITICAL_FRICTION + bracketed_root(excess, 0.0, 0.5).unwrap();
        let travel =
            height(settled, 0.0) - height(limit.tangent.unwrap(), limit.yield_force.unwrap());
        assert!((limit.wall_travel.unwrap() / travel - 1.0).abs() < 1e-12);
    }
}
