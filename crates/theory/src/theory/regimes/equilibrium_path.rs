//! The path of equilibria shared by all stacks with one stiffness and one stiffness ratio.

use super::super::events::{Event, Path, PathPoint, locate};
use super::super::path::{BottomContact, FollowedPath, followed_path};
use super::super::quasistatic::ClosedForm;
use super::super::root::maximum_between;
use super::critical_state::{CriticalState, LoadingPhase};
use crate::model::{ContactConvention, HistoryUpdate, Stack};

/// The path of equilibria with the paper's arms and linear springs, with c > 0 where the bottom cylinders touch. Floor
/// friction and cylinder friction only decide how far a stack gets on it.
pub struct EquilibriumPath {
    path: PathKind,
    convention: ContactConvention,
    epsilon: f64,
    /// Whether contact 2–3 closes on the way.
    closes: bool,
    /// The parameter at which the top wall reaches the bottom cylinders.
    wall_contact: Option<f64>,
}

enum PathKind {
    /// The closed form: c = 0 all the way, and springs turn.
    Open(ClosedForm),
    /// The followed path: contact 2–3 closes somewhere, or springs do not turn.
    Followed(FollowedPath),
}

impl EquilibriumPath {
    /// The path of `stack`, whatever its frictions, with springs that follow the rule `history_update`.
    pub fn new(stack: &Stack, history_update: HistoryUpdate) -> Self {
        let convention = ContactConvention {
            history_update,
            ..ContactConvention::TURNING
        };
        let followed =
            || PathKind::Followed(followed_path(stack, &convention, BottomContact::Followed));
        let closes = |path: &dyn Path| locate(path, Event::ContactCloses, stack).is_some();
        let (path, closes) = match history_update.turns() {
            true => {
                let open = ClosedForm::whole(stack);
                match closes(&open) {
                    true => (followed(), true),
                    false => (PathKind::Open(open), false),
                }
            }
            false => {
                let followed = followed();
                let closes = closes(followed.as_path());
                (followed, closes)
            }
        };
        let wall_contact = locate(path.as_path(), Event::WallContact, stack);
        Self {
            path,
            convention,
            epsilon: stack.epsilon(),
            closes,
            wall_contact,
        }
    }

    /// Whether contact 2–3 closes on the way.
    pub fn closes(&self) -> bool {
        self.closes
    }

    /// The followed path and its convention if springs do not turn, so that they remember how their contacts have
    /// turned.
    pub(super) fn remembering(&self) -> Option<(&FollowedPath, &ContactConvention)> {
        match &self.path {
            PathKind::Followed(path) if !self.convention.history_update.turns() => {
                Some((path, &self.convention))
            }
            _ => None,
        }
    }

    /// The cylinder friction that the contact 1–2 needs when the stack rests under its own weight.
    pub fn settled_pair_ratio(&self) -> f64 {
        self.point(self.settled()).pair_friction
    }

    /// The cylinder friction that the contact 1–2 needs when the top wall reaches the bottom cylinders; with more, the
    /// stack gets that far. `None` if the path ends before.
    pub fn wall_contact_pair_ratio(&self) -> Option<f64> {
        Some(self.point(self.wall_contact?).pair_friction)
    }

    /// y when gravity is complete; negative where contact 2–3 is closed then.
    pub fn settled_outward(&self) -> f64 {
        self.point(self.settled()).outward
    }

    /// y when the top wall reaches the bottom cylinders, if it does.
    pub fn wall_contact_outward(&self) -> Option<f64> {
        Some(self.point(self.wall_contact?).outward)
    }

    pub(super) fn wall_contact(&self) -> Option<f64> {
        self.wall_contact
    }

    /// The first parameter at which `event` happens to `stack`; 0 if it has happened by the first station.
    pub(super) fn locate(&self, event: Event, stack: &Stack) -> Option<f64> {
        locate(self.path.as_path(), event, stack)
    }

    pub(super) fn settled(&self) -> f64 {
        self.path.as_path().settled()
    }

    /// Height of the top wall where it first touches cylinder 1.
    pub(super) fn settled_height(&self) -> f64 {
        self.point(self.settled()).wall_height()
    }

    pub(super) fn point(&self, parameter: f64) -> PathPoint {
        self.path.as_path().point(parameter)
    }

    /// The first station, where the path has its initial ratios.
    pub(super) fn beginning(&self) -> f64 {
        self.path.as_path().stations()[0]
    }

    /// Returns the largest `value` between the beginning and `end`.
    pub(super) fn largest_until(&self, end: f64, value: impl Fn(&PathPoint) -> f64) -> f64 {
        let at = |parameter: f64| value(&self.point(parameter));
        let stations = self.path.as_path().stations().into_iter();
        let stations: Vec<f64> = stations
            .filter(|&station| station < end)
            .chain([end])
            .collect();
        let values: Vec<f64> = stations.iter().map(|&station| at(station)).collect();
        let highest = (0..values.len()).max_by(|&i, &j| values[i].total_cmp(&values[j]));
        match highest {
            Some(index) if index > 0 && index + 1 < values.len() => {
                let inside = maximum_between(at, stations[index - 1], stations[index + 1]);
                at(inside).max(values[index])
            }
            Some(index) => values[index],
            None => f64::NEG_INFINITY,
        }
    }

    /// The state at `parameter`, where `event` happens.
    pub(super) fn critical_state(&self, event: Event, parameter: f64) -> CriticalState {
        let parameter = parameter.max(self.beginning());
        let point = self.point(parameter);
        let stage = if parameter <= self.settled() {
            LoadingPhase::OwnWeight
        } else {
            LoadingPhase::Wall
        };
        self.state_at(event, &point, stage, self.settled_height())
    }

    /// The state `point`, in which `event` happens; `settled_height` is the height of the top wall when it first
    /// touches.
    pub(super) fn state_at(
        &self,
        event: Event,
        point: &PathPoint,
        stage: LoadingPhase,
        settled_height: f64,
    ) -> CriticalState {
        CriticalState {
            event,
            stage,
            force: point.wall_force / self.epsilon,
            tangent: point.tangent,
            floor_overlap: point.floor_overlap,
            bottom_force: point.bottom_force,
            wall_travel: match stage {
                LoadingPhase::OwnWeight => 0.0,
                LoadingPhase::Wall => settled_height - point.wall_height(),
            },
        }
    }
}

impl PathKind {
    fn as_path(&self) -> &dyn Path {
        match self {
            Self::Open(path) => path,
            Self::Followed(path) => path,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::overlap::pair_overlap;
    use super::super::super::root::bracketed_root;
    use super::super::CLOSING_STIFFNESS_RATIO;
    use super::*;
    use crate::model::CRITICAL_FRICTION;

    fn path(stiffness_ratio: f64) -> EquilibriumPath {
        let stack = Stack {
            stiffness_ratio,
            ..Stack::paper(0.3, 1e2)
        };
        EquilibriumPath::new(&stack, HistoryUpdate::Rotated)
    }

    /// The state of `path` at T.
    fn at_tangent(path: &EquilibriumPath, tangent: f64) -> PathPoint {
        let last = path.path.as_path().stations().into_iter().last().unwrap();
        let excess = |parameter: f64| path.point(parameter).tangent - tangent;
        path.point(bracketed_root(excess, 0.0, last).unwrap())
    }

    /// The overlap G at T, by summing ∫ρ dψ in `steps` trapezia and solving
    /// ∫ρ dψ + y = 2 κ b, b = a T + c/(1 + cos ψ), c = max(0, −2y) at each of them.
    fn summed_overlap(kappa: f64, tangent: f64, steps: usize) -> f64 {
        let start = std::f64::consts::FRAC_PI_6;
        let width = (2.0 * tangent.atan() - start) / steps as f64;
        let (mut integral, mut distance) = (0.0, 2.0);
        for step in 1..=steps {
            let angle = start + width * step as f64;
            let (sine, cosine, half) = (angle.sin(), angle.cos(), (0.5 * angle).tan());
            let residual = |next: f64| {
                let outward = next * sine - 1.0;
                let bottom = (-2.0 * outward).max(0.0);
                let shear = (2.0 - next) * half + bottom / (1.0 + cosine);
                let sum = integral + 0.5 * width * (distance + next);
                sum + outward - 2.0 * kappa * shear
            };
            let next = bracketed_root(residual, 1.0, 2.0).unwrap();
            integral += 0.5 * width * (distance + next);
            distance = next;
        }
        2.0 - distance
    }

    #[test]
    fn path_with_a_closed_contact_is_the_sum_over_its_springs() {
        for (kappa, tangent) in [(0.3, 0.3), (0.6, 0.32), (1.0, 0.35)] {
            let [coarse, fine] = [500, 1000].map(|steps| summed_overlap(kappa, tangent, steps));
            let summed = fine + (fine - coarse) / 3.0;
            let followed = at_tangent(&path(kappa), tangent).pair_overlap;
            assert!(
                (followed - summed).abs() < 1e-7,
                "{kappa}: {followed} {summed}"
            );
        }
    }

    #[test]
    fn forces_balance_with_a_closed_contact() {
        let path = path(0.4);
        let stations = path.path.as_path().stations();
        for parameter in stations.into_iter().skip(1) {
            let point = path.point(parameter);
            let angle = 2.0 * point.tangent.atan();
            let c = (-2.0 * point.outward).max(0.0);
            let shear = point.pair_overlap * point.tangent + c / (1.0 + angle.cos());
            let scale = point.pair_overlap;
            assert!((point.pair_ratio * point.pair_overlap - shear).abs() < 1e-10 * scale);
            assert!((point.floor_ratio * point.floor_overlap - shear).abs() < 1e-10 * scale);
            let load = 2.0 * point.pair_overlap + 2.0 * c * point.tangent;
            let floor = if parameter <= path.settled() {
                1.5 * load
            } else {
                0.5 * load + path.epsilon
            };
            assert!((point.floor_overlap - floor).abs() < 1e-10 * scale);
        }
    }

    #[test]
    fn path_is_continuous_where_the_contact_opens_and_its_slope_is_not() {
        let path = path(1.0);
        let last = path.path.as_path().stations().into_iter().last().unwrap();
        let outward = |parameter: f64| path.point(parameter).outward;
        let opening = bracketed_root(outward, path.settled(), last).unwrap();
        let at = |offset: f64| path.point(opening + offset).pair_overlap;
        let width = 1e-4;
        assert!((at(1e-9) - at(-1e-9)).abs() < 1e-8);
        let (left, right) = (at(0.0) - at(-width), at(width) - at(0.0));
        assert!((left - right).abs() > 1e-2 * left, "{left} {right}");
    }

    #[test]
    fn contact_closes_below_the_closing_stiffness_ratio_only() {
        assert!(path(CLOSING_STIFFNESS_RATIO * (1.0 - 1e-4)).closes());
        assert!(!path(CLOSING_STIFFNESS_RATIO * (1.0 + 1e-4)).closes());
        let defined = (2.0 + 3f64.sqrt()) / (2.0 * 3f64.sqrt());
        assert!((CLOSING_STIFFNESS_RATIO - defined).abs() < 1e-15);
    }

    #[test]
    fn the_largest_value_on_the_way_may_lie_between_stations_or_at_the_end() {
        // κ = 10: the load has a maximum on the way.
        let path = path(10.0);
        let stations = path.path.as_path().stations();
        let last = stations[stations.len() - 1];
        let load = |point: &PathPoint| point.pair_overlap;
        let overlap = |tangent: f64| pair_overlap(tangent - CRITICAL_FRICTION, 10.0);
        // G′ = 0, docs/theory.md, Eq. 17.
        let slope = |tangent: f64| {
            let square = 1.0 + tangent * tangent;
            4.0 / square - overlap(tangent) * (2.0 / square + 10.0 * square)
        };
        let exact = overlap(bracketed_root(slope, 0.3, 1.0).unwrap());
        let highest = path.largest_until(last, load);
        assert!((highest / exact - 1.0).abs() < 1e-12);
        assert!(stations.iter().all(|&at| load(&path.point(at)) < highest));
        for end in [0.3 * last, 0.123 * last] {
            assert_eq!(path.largest_until(end, load), load(&path.point(end)));
        }
        assert_eq!(path.beginning(), stations[0]);
    }

    #[test]
    fn the_largest_value_is_found_on_both_sides_of_the_highest_station_and_at_the_beginning() {
        let path = path(10.0);
        let stations = path.path.as_path().stations();
        let (middle, last) = (stations.len() / 2, stations[stations.len() - 1]);
        let near = stations[middle];
        for towards in [stations[middle - 1], stations[middle + 1]] {
            let place = near + 0.3 * (towards - near);
            let aim = path.point(place).tangent;
            let closeness = |point: &PathPoint| -(point.tangent - aim).powi(2);
            assert!(closeness(&path.point(near)) < -1e-9);
            assert!(path.largest_until(last, closeness) > -1e-15);
        }
        let falling = |point: &PathPoint| -point.tangent;
        let first = falling(&path.point(stations[0]));
        assert_eq!(path.largest_until(last, falling), first);
    }

    #[test]
    fn a_critical_state_has_force_stage_and_travel() {
        let path = path(2.5);
        let settled = path.settled();
        let at_rest = path.critical_state(Event::FloorSlip, settled);
        assert_eq!(
            (at_rest.stage, at_rest.wall_travel),
            (LoadingPhase::OwnWeight, 0.0)
        );
        assert!(at_rest.force.abs() < 1e-12);
        let later = path.critical_state(Event::WallContact, 2.0 * settled);
        let point = path.point(2.0 * settled);
        assert_eq!(
            (later.event, later.stage),
            (Event::WallContact, LoadingPhase::Wall)
        );
        assert!((later.force - 100.0 * point.wall_force).abs() < 1e-12);
        assert_eq!(
            (later.tangent, later.floor_overlap),
            (point.tangent, point.floor_overlap)
        );
        assert_eq!(
            later.wall_travel,
            path.point(settled).wall_height() - point.wall_height()
        );
        assert!(later.wall_travel > 0.0 && later.bottom_force == 0.0);
        let from_the_start = path.critical_state(Event::FloorSlip, 0.0);
        assert_eq!(from_the_start.tangent, path.point(path.beginning()).tangent);
    }

    #[test]
    fn a_closed_contact_bears_twice_the_inward_displacement() {
        let path = path(0.4);
        let settled = path.settled();
        let outward = path.point(settled).outward;
        assert!(outward < 0.0);
        let critical_state = path.critical_state(Event::CylinderSlip, settled);
        assert_eq!(critical_state.bottom_force, -2.0 * outward);
        assert_eq!(path.settled_outward(), outward);
    }
}
