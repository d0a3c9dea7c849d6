//! A stack under a convention, both checked.

use super::stack::HIGHEST_STIFFNESS_OF_THEORY;
use super::{ContactConvention, InvalidValue, Stack};

/// A stack under a contact convention, whose values have all been checked. Whatever follows a path of equilibria takes
/// it, so that a program which forgets the check does not compile.
///
/// ```
/// use tristack_theory::model::{ContactConvention, Problem, Stack};
///
/// let problem = Problem::new(Stack::paper(0.3, 1e4), ContactConvention::PAPER)?;
/// assert_eq!(problem.stack().floor_friction, 0.3);
/// let refused = Problem::new(Stack::paper(0.3, -1.0), ContactConvention::PAPER).unwrap_err();
/// assert_eq!(refused.to_string(), "`stack.stiffness` is -1, but must be a number from 1 to 1e16");
/// # Ok::<(), tristack_theory::model::InvalidValue>(())
/// ```
///
/// ```compile_fail
/// use tristack_theory::model::{ContactConvention, Stack};
/// use tristack_theory::theory::quasistatic_limit;
///
/// quasistatic_limit(&Stack::paper(0.3, 1e4), &ContactConvention::PAPER);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Problem {
    stack: Stack,
    convention: ContactConvention,
}

impl Problem {
    /// Checks every value of `stack` and of `convention`: frictions μ and μ_d above 0, at most 1000; stiffness 1/ε
    /// from 1 to 10¹⁶, of which a run takes 10⁸ ([`Stack::validate`]); stiffness ratio κ above 0, at most 10⁶; 2 to 5
    /// bodies; arms from −1 to 1.
    ///
    /// # Errors
    /// The first value that is out of range, with its key and what is accepted.
    pub fn new(stack: Stack, convention: ContactConvention) -> Result<Self, InvalidValue> {
        stack.validate_up_to(HIGHEST_STIFFNESS_OF_THEORY)?;
        convention.validate()?;
        Ok(Self { stack, convention })
    }

    /// A problem whose values the caller has checked, within ranges that may be wider.
    pub(crate) fn checked(stack: Stack, convention: ContactConvention) -> Self {
        Self { stack, convention }
    }

    /// The stack.
    pub fn stack(&self) -> &Stack {
        &self.stack
    }

    /// The contact convention.
    pub fn convention(&self) -> &ContactConvention {
        &self.convention
    }

    /// The same problem with the floor friction μ.
    ///
    /// # Errors
    /// If it is not above 0 and at most 1000.
    pub fn with_floor_friction(self, floor_friction: f64) -> Result<Self, InvalidValue> {
        let stack = Stack {
            floor_friction,
            ..self.stack
        };
        stack.validate_floor_friction()?;
        Ok(Self { stack, ..self })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Arms;

    fn refused_key(stack: Stack, convention: ContactConvention) -> String {
        Problem::new(stack, convention).unwrap_err().key
    }

    #[test]
    fn stack_and_convention_are_both_checked() {
        let (stack, convention) = (Stack::paper(0.3, 1e4), ContactConvention::PAPER);
        let problem = Problem::new(stack, convention).unwrap();
        assert_eq!(
            (problem.stack(), problem.convention()),
            (&stack, &convention)
        );
        for (stack, key) in [
            (Stack::paper(f64::NAN, 1e4), "stack.floor_friction"),
            (Stack::paper(0.3, f64::INFINITY), "stack.stiffness"),
        ] {
            assert_eq!(refused_key(stack, convention), key);
        }
        let long = ContactConvention::with_arms(Arms::reciprocal(0.0, 150.0));
        assert_eq!(refused_key(stack, long), "convention.floor.torque_arm");
    }

    #[test]
    fn another_friction_is_checked_as_well() {
        let problem = Problem::new(Stack::paper(0.3, 1e4), ContactConvention::PAPER).unwrap();
        let other = Problem::new(Stack::paper(0.2, 1e4), ContactConvention::PAPER);
        assert_eq!(problem.with_floor_friction(0.2), other);
        let refused = problem.with_floor_friction(0.0).unwrap_err();
        assert_eq!(refused.key, "stack.floor_friction");
    }
}
