//! The refusal to run a stack that does not yield.

use crate::model::{InvalidValue, Problem, Stack, exact};
use crate::theory::{Limit, quasistatic_limit};
use thiserror::Error;

/// Refusal to run a stack that does not yield at the floor.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("`--mu` is {}, but nothing yields there: {reason}{}", exact(stack.floor_friction), accepted(*range))]
pub struct NoYield {
    /// The stack.
    pub stack: Stack,
    /// The event that comes instead of the yield.
    pub reason: String,
    /// Lowest and highest floor friction at which such a stack yields, if there is any.
    pub range: Option<(f64, f64)>,
}

fn accepted(range: Option<(f64, f64)>) -> String {
    range.map_or_else(String::new, |(lowest, highest)| {
        format!("; at this stiffness it must be between {lowest:.4} and {highest:.4}")
    })
}

impl NoYield {
    /// The refusal as an error about the floor friction in a case file.
    pub fn as_value(&self) -> InvalidValue {
        let Self { reason, range, .. } = self;
        let accepted = format!(
            "one at which the stack yields: {reason}{}",
            accepted(*range)
        );
        InvalidValue::new("stack.floor_friction", self.stack.floor_friction, accepted)
    }
}

/// The refusal to run a stack that does not yield, with the accepted frictions.
pub fn no_yield(problem: &Problem, limit: &Limit) -> NoYield {
    NoYield {
        stack: *problem.stack(),
        reason: limit
            .reason
            .as_deref()
            .unwrap_or("no yield force")
            .to_owned(),
        range: yielding_frictions(problem),
    }
}

/// Lowest and highest floor friction at which a stack like this one yields by sliding on the floor, to
/// four digits; `None` if there is none.
fn yielding_frictions(problem: &Problem) -> Option<(f64, f64)> {
    const GRID: f64 = 0.01;
    let yields = |floor_friction: f64| {
        let other = problem.with_floor_friction(floor_friction);
        other.is_ok_and(|own| quasistatic_limit(&own).yield_force.is_some())
    };
    let grid: Vec<f64> = (1..=100).map(|index| GRID * f64::from(index)).collect();
    let first = grid.iter().position(|&friction| yields(friction))?;
    let last = grid.iter().rposition(|&friction| yields(friction))?;
    let border = |mut inside: f64, mut outside: f64| {
        while (inside - outside).abs() > 1e-5 {
            let middle = 0.5 * (inside + outside);
            if yields(middle) {
                inside = middle
            } else {
                outside = middle
            }
        }
        inside
    };
    Some((
        border(grid[first], grid[first] - GRID),
        border(grid[last], grid[last] + GRID),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{CRITICAL_FRICTION, ContactConvention};

    #[test]
    fn frictions_that_yield_lie_between_own_weight_and_wall_contact() {
        let problem = Problem::new(Stack::paper(0.05, 1e2), ContactConvention::TURNING);
        let (lowest, highest) = yielding_frictions(&problem.unwrap()).unwrap();
        assert!((lowest - CRITICAL_FRICTION / 3.0).abs() < 2e-3);
        // The wall reaches cylinder 2 first above 0.53994 (reference/golden, closed form).
        assert!((highest - 0.53994).abs() < 2e-5);
    }
}
