//! The limits of stacks that share one path of equilibria.

use super::closing::closing_limit;
use super::events::Event;
use super::limit::Limit;
use super::path::{BottomContact, FollowedPath, SpeedExcess, followed_path, limit_on};
use super::quasistatic::closed_form_limit;
use crate::model::{ContactConvention, Stack};
use std::cell::OnceCell;

/// The exact limits of all stacks that differ from one another in their frictions alone. The path of equilibria
/// depends on neither friction, so it is followed only once.
///
/// ```
/// use tristack_theory::model::{ContactConvention, Stack};
/// use tristack_theory::theory::LimitCurve;
/// let curve = LimitCurve::new(&Stack::paper(0.3, 100.0), &ContactConvention::PAPER);
/// let forces = [0.2, 0.3, 0.4].map(|mu| curve.limit(&Stack::paper(mu, 100.0)).yield_force.unwrap());
/// assert!((forces[1] - 30.112_860_1).abs() < 1e-7);
/// ```
pub struct LimitCurve {
    stack: Stack,
    convention: ContactConvention,
    /// The path with c = 0; followed where there is no closed form.
    open: OnceCell<FollowedPath>,
    /// The path on which contact 2–3 closes.
    closing: OnceCell<FollowedPath>,
}

impl LimitCurve {
    /// The curve through `stack` under `convention`.
    pub fn new(stack: &Stack, convention: &ContactConvention) -> Self {
        Self {
            stack: *stack,
            convention: *convention,
            open: OnceCell::new(),
            closing: OnceCell::new(),
        }
    }

    /// Whether `stack` under `convention` is on this curve.
    pub fn holds(&self, stack: &Stack, convention: &ContactConvention) -> bool {
        let alike = Stack {
            floor_friction: self.stack.floor_friction,
            cylinder_friction: self.stack.cylinder_friction,
            ..*stack
        };
        alike == self.stack && *convention == self.convention
    }

    /// Returns the limit of `stack`, which must be on the curve: by the closed form where there is one, by the path
    /// follower otherwise. Both assume c = 0; where the bottom cylinders touch before the floor slips, the path is
    /// followed with c > 0.
    pub fn limit(&self, stack: &Stack) -> Limit {
        let convention = &self.convention;
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

    /// Returns what a finite wall speed adds to the `limit` of `stack`, which must be on the curve, to first order in
    /// the speed. `None` unless the floor slips first and with c = 0, where springs are rescaled, where Coulomb's
    /// limit applies to frozen springs alone, and where the sliding stack does not give way.
    ///
    /// ```
    /// use tristack_theory::model::{ContactConvention, Stack};
    /// use tristack_theory::theory::LimitCurve;
    /// let stack = Stack::paper(0.2, 1e4);
    /// let curve = LimitCurve::new(&stack, &ContactConvention::TURNING);
    /// let excess = curve.speed_excess(&stack, &curve.limit(&stack)).unwrap();
    /// // At the wall speed 1e-6 the force peaks 0.5 % of the load above the limit.
    /// assert!((1e-6 * excess.peak - 0.0418).abs() < 1e-4);
    /// ```
    pub fn speed_excess(&self, stack: &Stack, limit: &Limit) -> Option<SpeedExcess> {
        if limit.event != Event::FloorSlip || limit.yield_force.is_none() {
            return None;
        }
        self.path(BottomContact::Ignored)
            .speed_excess(stack, &self.convention)
    }

    fn path(&self, bottom: BottomContact) -> &FollowedPath {
        let path = match bottom {
            BottomContact::Ignored => &self.open,
            BottomContact::Followed => &self.closing,
        };
        path.get_or_init(|| followed_path(&self.stack, &self.convention, bottom))
    }
}
