//! The limits of stacks that share one path of equilibria.

use super::closing::closing_limit;
use super::events::Event;
use super::limit::Limit;
use super::path::{BottomContact, FollowedPath, SpeedExcess, followed_path, limit_on};
use super::quasistatic::closed_form_limit;
use crate::model::{Problem, Stack};
use std::cell::OnceCell;

/// The exact limits of all stacks that differ from one another in their frictions alone. The path of equilibria
/// depends on neither friction, so it is followed only once.
///
/// ```
/// use tristack_theory::model::{ContactConvention, Problem, Stack};
/// use tristack_theory::theory::LimitCurve;
/// let problem = Problem::new(Stack::paper(0.3, 100.0), ContactConvention::PAPER)?;
/// let curve = LimitCurve::new(&problem);
/// let problems = [0.2, 0.3, 0.4].map(|mu| problem.with_floor_friction(mu).unwrap());
/// let forces = problems.map(|own| curve.limit(&own).yield_force.unwrap());
/// assert!((forces[1] - 30.112_860_1).abs() < 1e-7);
/// # Ok::<(), tristack_theory::model::InvalidValue>(())
/// ```
pub struct LimitCurve {
    problem: Problem,
    /// The path with c = 0; followed where there is no closed form.
    open: OnceCell<FollowedPath>,
    /// The path on which contact 2–3 closes.
    closing: OnceCell<FollowedPath>,
}

impl LimitCurve {
    /// The curve through `problem`.
    pub fn new(problem: &Problem) -> Self {
        Self {
            problem: *problem,
            open: OnceCell::new(),
            closing: OnceCell::new(),
        }
    }

    /// Whether `problem` is on this curve.
    pub fn holds(&self, problem: &Problem) -> bool {
        let own = self.problem.stack();
        let alike = Stack {
            floor_friction: own.floor_friction,
            cylinder_friction: own.cylinder_friction,
            ..*problem.stack()
        };
        alike == *own && problem.convention() == self.problem.convention()
    }

    /// Returns the limit of `problem`, which must be on the curve: by the closed form where there is one, by the path
    /// follower otherwise. Both assume c = 0; where the bottom cylinders touch before the floor slips, the path is
    /// followed with c > 0.
    pub fn limit(&self, problem: &Problem) -> Limit {
        let (stack, convention) = (problem.stack(), self.problem.convention());
        let limit = match convention.has_closed_form() {
            true => closed_form_limit(stack),
            false => limit_on(self.path(BottomContact::Ignored), stack, convention),
        };
        match limit.event {
            Event::ContactCloses => {
                closing_limit(self.path(BottomContact::Followed), stack, convention)
            }
            _ => limit,
        }
    }

    /// Returns what a finite wall speed adds to the `limit` of `problem`, which must be on the curve, to first order in
    /// the speed. `None` unless the floor slips first and with c = 0, where springs are rescaled, where Coulomb's
    /// limit applies to frozen springs alone, and where the sliding stack does not give way.
    ///
    /// ```
    /// use tristack_theory::model::{ContactConvention, Problem, Stack};
    /// use tristack_theory::theory::LimitCurve;
    /// let problem = Problem::new(Stack::paper(0.2, 1e4), ContactConvention::TURNING)?;
    /// let curve = LimitCurve::new(&problem);
    /// let excess = curve.speed_excess(&problem, &curve.limit(&problem)).unwrap();
    /// // At the wall speed 1e-6 the force peaks 0.5 % of the load above the limit.
    /// assert!((1e-6 * excess.peak - 0.0418).abs() < 1e-4);
    /// # Ok::<(), tristack_theory::model::InvalidValue>(())
    /// ```
    pub fn speed_excess(&self, problem: &Problem, limit: &Limit) -> Option<SpeedExcess> {
        if limit.event != Event::FloorSlip || limit.yield_force.is_none() {
            return None;
        }
        self.path(BottomContact::Ignored)
            .speed_excess(problem.stack(), self.problem.convention())
    }

    fn path(&self, bottom: BottomContact) -> &FollowedPath {
        let path = match bottom {
            BottomContact::Ignored => &self.open,
            BottomContact::Followed => &self.closing,
        };
        let (stack, convention) = (self.problem.stack(), self.problem.convention());
        path.get_or_init(|| followed_path(stack, convention, bottom))
    }
}
