//! Series are held to the laws of mechanics before anything is concluded from them.

use super::verdict::{Ground, Grounds};
use crate::series::{Deviation, Law, Mechanics};

impl Grounds {
    /// Adds what `mechanics` says of the series of each run, in order; absent where a run was recorded without it.
    pub(super) fn hold_to_mechanics<'a>(
        &mut self,
        mechanics: impl IntoIterator<Item = Option<&'a Mechanics>>,
    ) {
        for (run, mechanics) in (1..).zip(mechanics) {
            match mechanics {
                Some(mechanics) => {
                    let violations = mechanics.violations();
                    let notes = violations.map(|(law, deviation)| violation(run, law, deviation));
                    notes.for_each(|note| self.add(Ground::Violation(note)));
                }
                None => self.add(Ground::Doubt(format!(
                    "run {run} was recorded before series were held to mechanics"
                ))),
            }
        }
    }
}

fn violation(run: usize, law: Law, deviation: &Deviation) -> String {
    let side = |side: Option<f64>| side.unwrap_or(f64::NAN);
    format!(
        "run {run} breaks {}: at step {} it is {:.9}, and must be {:.9} m g; {:.1e} apart where {:.1e} is allowed",
        law.as_str(),
        deviation.step,
        side(deviation.found),
        side(deviation.expected),
        deviation.size,
        deviation.bound
    )
}
