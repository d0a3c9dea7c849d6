//! `--mu` and `--stiffness`: the two quantities in which stacks differ.

use super::values::Quantity;
use crate::model::Stack;

/// The help of lists of frictions.
pub(in crate::cli) const FRICTIONS: &str =
    "Floor frictions: numbers, ranges A:B:STEP, and the word `critical`, separated by commas";
/// The help of lists of stiffnesses.
pub(in crate::cli) const STIFFNESSES: &str = "Stiffnesses k_n r/(m g), of a law of power p K r^p/(m g): numbers and ranges \
    A:B:STEP or A:B:xFACTOR, separated by commas";
/// The help of a single friction.
pub(in crate::cli) const FRICTION: &str = "Floor friction; a number or the word `critical`";
/// The help of a single stiffness.
pub(in crate::cli) const STIFFNESS: &str = "Stiffness k_n r/(m g), of a law of power p K r^p/(m g)";

/// A floor friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::cli) enum Friction {
    /// This number.
    Number(f64),
    /// The rigid critical friction of the stack.
    Critical,
}

impl Quantity for Friction {
    const ACCEPTED: &'static str = "a number above 0, or the word `critical` (also `mu_c`)";

    fn of_number(number: f64) -> Self {
        Self::Number(number)
    }

    fn named(word: &str) -> Option<Self> {
        ["critical", "mu_c"]
            .contains(&word)
            .then_some(Self::Critical)
    }
}

impl Friction {
    /// Returns the friction for this stack.
    pub fn of(self, stack: &Stack) -> f64 {
        match self {
            Self::Number(number) => number,
            Self::Critical => match stack.validate_bodies() {
                Ok(()) => stack.ring().critical_friction,
                Err(_) => f64::NAN,
            },
        }
    }

    /// Returns the friction for cylinders.
    pub fn of_cylinders(self) -> f64 {
        self.of(&Stack::paper(f64::NAN, f64::NAN))
    }
}

/// A stiffness k_n r/(m g), of a law of power p K r^p/(m g).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::cli) struct Stiffness(pub f64);

impl Quantity for Stiffness {
    const ACCEPTED: &'static str = "a number from 1 to 1e8";

    fn of_number(number: f64) -> Self {
        Self(number)
    }

    fn named(_: &str) -> Option<Self> {
        None
    }
}
