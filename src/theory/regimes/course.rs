//! The path of equilibria that all stacks of one stiffness and one stiffness ratio share.

use super::super::events::{Event, Path, PathPoint, locate};
use super::super::path::{BottomContact, FollowedPath, LinearSprings, followed_path};
use super::super::quasistatic::ClosedForm;
use super::outcome::{Happening, Stage};
use crate::stack::Stack;

/// The path of equilibria, with c > 0 where the bottom cylinders touch. Floor friction and cylinder
/// friction decide how far a stack gets on it, and nothing else.
pub struct Course {
    path: CoursePath,
    closes: bool,
    epsilon: f64,
    /// The parameter at which the top wall reaches the bottom cylinders.
    wall_contact: Option<f64>,
}

enum CoursePath {
    /// c = 0 all the way: the closed form.
    Open(ClosedForm),
    /// Contact 2–3 closes somewhere: followed.
    Closing(FollowedPath<LinearSprings>),
}

impl Course {
    /// The path that `stack` takes, whatever its frictions.
    pub fn new(stack: &Stack) -> Self {
        let open = ClosedForm::whole(stack);
        let closes = locate(&open, Event::ContactCloses, stack).is_some();
        let path = if closes {
            let followed = followed_path(stack, 0.0, 0.0, BottomContact::Followed);
            CoursePath::Closing(followed)
        } else {
            CoursePath::Open(open)
        };
        let wall_contact = locate(path.as_path(), Event::WallContact, stack);
        Self {
            path,
            closes,
            epsilon: stack.epsilon(),
            wall_contact,
        }
    }

    /// Whether contact 2–3 closes on the way.
    pub fn closes(&self) -> bool {
        self.closes
    }

    /// b/a when the stack rests under its own weight: the cylinder friction that this takes.
    pub fn settled_pair_ratio(&self) -> f64 {
        self.point(self.settled()).pair_ratio
    }

    /// b/a when the top wall reaches the bottom cylinders: with more cylinder friction than this it gets
    /// that far. `None` if the path ends before.
    pub fn wall_contact_pair_ratio(&self) -> Option<f64> {
        Some(self.point(self.wall_contact?).pair_ratio)
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

    /// The first parameter at which `event` happens to `stack`; 0 if from the start.
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

    /// The first station, at which the path has its initial ratios.
    pub(super) fn beginning(&self) -> f64 {
        self.path.as_path().stations()[0]
    }

    /// The largest of `value` between the beginning and `end`.
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
                inside.max(values[index])
            }
            Some(index) => values[index],
            None => f64::NEG_INFINITY,
        }
    }

    /// What `event` at `parameter` amounts to.
    pub(super) fn happening(&self, event: Event, parameter: f64) -> Happening {
        let parameter = parameter.max(self.beginning());
        let point = self.point(parameter);
        let stage = if parameter <= self.settled() {
            Stage::OwnWeight
        } else {
            Stage::Wall
        };
        Happening {
            event,
            stage,
            force: point.wall_force / self.epsilon,
            tangent: point.tangent,
            floor_overlap: point.floor_overlap,
            bottom_force: if self.closes {
                (-2.0 * point.outward).max(0.0)
            } else {
                0.0
            },
            wall_travel: match stage {
                Stage::OwnWeight => 0.0,
                Stage::Wall => self.settled_height() - point.wall_height(),
            },
        }
    }
}

impl CoursePath {
    fn as_path(&self) -> &dyn Path {
        match self {
            Self::Open(path) => path,
            Self::Closing(path) => path,
        }
    }
}

/// The maximum of a function with a single one between `low` and `high`, by golden sections; its error is of
/// second order in the width that is left.
fn maximum_between(function: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    const SECTIONS: usize = 40;
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    for _ in 0..SECTIONS {
        let width = golden * (high - low);
        if function(high - width) < function(low + width) {
            low = high - width;
        } else {
            high = low + width;
        }
    }
    function(0.5 * (low + high))
}
