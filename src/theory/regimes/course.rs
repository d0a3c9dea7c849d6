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

    pub(super) fn point(&self, parameter: f64) -> PathPoint {
        self.path.as_path().point(parameter)
    }

    /// The first station, at which the path has its initial ratios.
    pub(super) fn beginning(&self) -> f64 {
        self.path.as_path().stations()[0]
    }

    /// The largest of `value` between the beginning and `end`, over the stations and both ends.
    pub(super) fn largest_until(&self, end: f64, value: impl Fn(&PathPoint) -> f64) -> f64 {
        let stations = self.path.as_path().stations().into_iter();
        let on_the_way = stations.filter(|&station| station < end).chain([end]);
        let values = on_the_way.map(|parameter| value(&self.point(parameter)));
        values.fold(f64::NEG_INFINITY, f64::max)
    }

    /// What `event` at `parameter` amounts to.
    pub(super) fn happening(&self, event: Event, parameter: f64) -> Happening {
        let parameter = parameter.max(self.beginning());
        let point = self.point(parameter);
        let settled = self.point(self.settled());
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
            wall_travel: match stage {
                Stage::OwnWeight => 0.0,
                Stage::Wall => settled.wall_height() - point.wall_height(),
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
